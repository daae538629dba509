"""The verdict at equal accuracy: the shortest words of every core for each target, and what they cost.

Everything follows from report["verdict"], which `search` puts together; on no other than the default arm there is one.
"""

from __future__ import annotations

from ci.report.designs import RULES
from ci.report.tables import FAMILIES, KINEMATIC, Row, Table, leaders, number

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
            "bits": pick["bits"], "total": pick["total_lsb"], "lut": area("ecp5", "lut"), "dsp": area("ecp5", "dsp"),
            "mem": area("ecp5", "mem"), "alut": area("cyclonev", "lut"), "alut_dsp": area("cyclonev", "dsp"),
            "m10k": area("cyclonev", "mem"), "nodsp": area("cyclonev_nodsp", "lut"), "cycles": cycles,
            "ii": max(part["ii"] for part, _ in parts), "ns": None if None in clocks else cycles * 1000 / min(clocks)}


def price(found: Figures) -> float:
    """Area in LUTs of ECP5, blocks by their share of a device."""
    return found["lut"] + RULES["price"]["dsp"] * found["dsp"] + RULES["price"]["mem"] * found["mem"]


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
    """Error, area on ECP5, cycles and time."""
    return (number(found["total"]), *(str(found[key]) for key in ("lut", "dsp", "mem", "cycles")), number(found["ns"]))


COST = ("total LSB", "LUT", "MULT18X18", "EBR", "cycles", "ns")


def target_table(verdict: dict, function: str) -> Table:
    """Every core of a function at every target, on ECP5; a family without a core is "not built"."""
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


def cyclonev_table(verdict: dict) -> Table:
    """The same cores and words on Cyclone V."""
    lines = [(function, target, f"`{found['core']}`", words(found["values"]),
              *(str(found[key]) for key in ("alut", "alut_dsp", "m10k", "nodsp", "cycles")))
             for function in KINEMATIC for target in TARGETS for found in reaching(verdict, function, target)]
    return Table("The same words on Cyclone V", ("", "at most", "core", "words", "ALUT", "DSP", "M10K", "ALUT, no DSP",
                                                 "cycles"), tuple(lines), text=4)


def scenario_table(verdict: dict, way: str, word: str) -> Table:
    """Rows of one type of joint words outside, codecs included, at the scenarios' target, on ECP5."""
    lines = []
    for function in (one for one in KINEMATIC if one.startswith(way)):
        for design in in_order(verdict, function):
            if design["word"] == word and (found := chosen(verdict, design, RULES["scenario"])):
                codec = f"{function[-1]} `{design['codec']}`" if design["codec"] else ""
                cores = [codec, f"`{design['core']}`"] if way == "fk" else [f"`{design['core']}`", codec]
                lines.append((function, " + ".join(filter(None, cores)), words(found["values"]), *_cost(found)))
    return Table(SCENARIOS[way, word], ("", "cores", "words", *COST), tuple(lines), text=3)


WINS = {"ECP5": (("lut", "fewest LUTs beside blocks"), ("price", "fewest LUTs, blocks counted as LUTs"),
                 ("cycles", "fewest cycles"), ("ns", "least ns")),
        "Cyclone V": (("alut", "fewest ALUTs beside blocks"), ("nodsp", "fewest ALUTs, no DSP"))}


def _least(found: list[Figures], key: str) -> str:
    """The cores with the least of a figure, and that figure; a dash where none is known."""
    known = [one for one in found if one[key] is not None]
    if not known:
        return "–"
    low = min(one[key] for one in known)
    leading = ", ".join(f"`{one['core']}`" for one in known if one[key] == low)
    return f"{leading} {number(low, 3 if key == 'ns' else 5)}"


def winners_table(verdict: dict, device: str) -> Table:
    """Who has the least of every figure, for every function and target."""
    lines = []
    for function in KINEMATIC:
        for target in TARGETS if plain(verdict, function) else ():
            found = [one | {"price": price(one)} for one in reaching(verdict, function, target)]
            lines.append((function, target, *(_least(found, key) for key, _ in WINS[device])))
    return Table(f"Who wins on {device}", ("", "at most", *(text for _, text in WINS[device])), tuple(lines),
                 text=2 + len(WINS[device]))


# What rational trigonometry itself changes: spreads against angles, both with tables and products

ITSELF = (("mem", "EBR"), ("dsp", "MULT18X18"), ("lut", "LUT"), ("cycles", "cycles"), ("ii", "II"),
          ("bits", "bits of a joint word"))


def _of_row(row: Row) -> Figures:
    """The figures that are compared, of a row of the report."""
    area, params = row["area"]["ecp5"], row["params"]
    return {"lut": area["lut"], "dsp": area["dsp"], "mem": area["mem"], "cycles": row["latency_cycles"],
            "ii": row["ii"], "bits": params["S"] + 2 if "S" in params else params["A"]}


def itself_table(report: dict) -> Table:
    """What a spread takes and what a binary angle takes with the same means, function by function.

    At the tightest target that `rational_*` and `table_*` both reach; without such a target, at their first sets.
    """
    first, lines = leaders(report), []
    for function in KINEMATIC:
        pair = [first.get(function, {}).get(family) for family in ("rational", "table")]
        where, pair = "first sets", [_of_row(row) for row in pair] if all(pair) else None
        for target in TARGETS:
            of = {one["family"]: one for one in reversed(reaching(report["verdict"], function, target))}
            if {"rational", "table"} <= set(of):
                where, pair = target, [of["rational"], of["table"]]
        if pair:
            lines.append((function, where, *(f"{pair[0][key]} / {pair[1][key]}" for key, _ in ITSELF)))
    return Table("Turn-spread (`rational_*`) / binary angle (`table_*`), on ECP5",
                 ("", "at most", *(text for _, text in ITSELF)), tuple(lines), text=2)
