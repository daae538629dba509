"""The verdict at equal accuracy: the shortest words of every core for each target, and what they cost.

Everything follows from report["verdict"], which `search` puts together; on no other than the default arm there is one.
"""

from __future__ import annotations

from ci.report.designs import RULES
from ci.report.rows import FAMILIES, KINEMATIC, number
from ci.report.tables import Table

TARGETS = tuple(RULES["target"])
SCENARIOS = {  # (way, type of the joint words outside): what it is in a machine
    ("fk", "angle"): "encoder angle in, tip out", ("ik", "angle"): "tip in, motor angle out",
    ("fk", "vector"): "resolver (c, n) in, tip out", ("ik", "vector"): "tip in, unit vectors out",
    ("fk", "spread"): "spreads of squared lengths in, tip out", ("ik", "spread"): "tip in, spreads out"}
Figures = dict  # of one set of a design: what `figures` gives


def figures(verdict: dict, design: dict, pick: dict) -> Figures:
    """What a set costs: a codec at every joint, codecs and core one after the other, at the slowest clock of them."""
    parts = [(verdict["parts"][part], copies) for part, copies in pick["parts"]]

    def area(flow: str, column: str) -> int:
        return sum(part["area"][flow][column] * copies for part, copies in parts)

    clocks, cycles = [part["fmax_mhz"] for part, _ in parts], sum(part["cycles"] for part, _ in parts)
    return {"core": design["core"], "codec": design["codec"], "family": design["family"], "values": pick["values"],
            "bits": pick["bits"], "total": pick["total_lsb"], "alut": area("cyclonev", "lut"),
            "dsp": area("cyclonev", "dsp"), "mem": area("cyclonev", "mem"), "nodsp": area("cyclonev_nodsp", "lut"),
            "nodsp_mem": area("cyclonev_nodsp", "mem"), "cycles": cycles,
            "ii": max(part["ii"] for part, _ in parts), "ns": None if None in clocks else cycles * 1000 / min(clocks)}


def price(found: Figures) -> float:
    """Area in ALUTs, blocks by their share of a device."""
    return found["alut"] + RULES["price"]["dsp"] * found["dsp"] + RULES["price"]["mem"] * found["mem"]


def chosen(verdict: dict, design: dict, target: str) -> Figures | None:
    """The figures of a design at a target; None where it does not reach it."""
    pick = design["picks"].get(target)
    return pick and figures(verdict, design, pick)


def in_order(verdict: dict, function: str) -> list[dict]:
    """Designs of a function: by family, then as they are listed."""
    designs = [one for one in verdict["designs"].values() if one["function"] == function]
    return sorted(designs, key=lambda one: FAMILIES.index(one["family"]))


def plain(verdict: dict, function: str) -> list[dict]:
    """Those without a codec: the cores with their own words."""
    return [design for design in in_order(verdict, function) if design["codec"] is None]


def reaching(verdict: dict, function: str, target: str) -> list[Figures]:
    """The figures of every core that reaches a target with its own words."""
    return [found for design in plain(verdict, function) if (found := chosen(verdict, design, target))]


# Tables


def words(values: dict[str, int]) -> str:
    """Parameters as they are set; ``word``: fraction bits of the joint word outside a codec."""
    return " ".join(f"{key}={value}" for key, value in values.items())


def _cost(found: Figures) -> tuple[str, ...]:
    """Error, area with its blocks, cycles, time, and area without DSP blocks."""
    area = str(found["alut"]) + "".join(f" + {found[key]} {text}" for key, text in (("dsp", "DSP"), ("mem", "mem"))
                                        if found[key])
    logic = str(found["nodsp"]) + (f" + {found['nodsp_mem']} mem" if found["nodsp_mem"] else "")
    return number(found["total"]), area, str(found["cycles"]), number(found["ns"]), logic


COST = ("total LSB", "ALUT + DSP + memory", "cycles", "ns", "ALUT, no DSP")


def target_table(verdict: dict, function: str) -> Table:
    """Every core of a function at every target; a family without a core is "not built"."""
    lines, none = [], ("–",) * len(COST)
    for target in TARGETS:
        of = {found["core"]: found for found in reaching(verdict, function, target)}
        for design in plain(verdict, function):
            found = of.get(design["core"])
            line = (words(found["values"]), *_cost(found)) if found else \
                (f"not reached: {number(design['best_lsb'])} LSB at best", *none)
            lines.append((target, f"`{design['core']}`", *line))
    built = {design["family"] for design in plain(verdict, function)}
    lines += [("", f"`{family}_{function}`", "not built", *none) for family in FAMILIES if family not in built]
    return Table(f"{function}: {KINEMATIC[function]}", ("at most", "core", "words", *COST), tuple(lines), text=3)


def scenario_table(verdict: dict, way: str, word: str) -> Table:
    """Rows of one type of joint words outside, codecs included, at the scenarios' target."""
    lines = []
    for function in (one for one in KINEMATIC if one.startswith(way)):
        for design in in_order(verdict, function):
            if design["word"] == word and (found := chosen(verdict, design, RULES["scenario"])):
                codec = f"{function[-1]} `{design['codec']}`" if design["codec"] else ""
                cores = [codec, f"`{design['core']}`"] if way == "fk" else [f"`{design['core']}`", codec]
                lines.append((function, " + ".join(filter(None, cores)), words(found["values"]), *_cost(found)))
    return Table(SCENARIOS[way, word], ("", "cores", "words", *COST), tuple(lines), text=3)
