"""Cores beside each other and beside what others say: the tables that compare.

- The verdict at equal accuracy: the shortest words of every core for each target, and what they cost. It follows from
  report["verdict"], which `search` puts together; on no other than the default arm there is one.
- What the paper prints (`paper.toml`) beside ours, and chains of any number of links beside fixed cores.
- Engines that iterate beside the cores that answer in one pass.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterable
from pathlib import Path

import numpy as np
from quadrance.iterative import convergence

from ci.report.designs import RULES
from ci.report.tables import (
    FAMILIES,
    KINEMATIC,
    Row,
    Table,
    area_of,
    best,
    cyclonev,
    kind,
    leaders,
    leading,
    number,
    pick,
    without_dsp,
)

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


# What the paper says beside ours: Tables III, IV and V

PAPER = tomllib.loads(Path(__file__).with_name("paper.toml").read_text())


def _smallest(rows: list[Row], figure: str) -> str:
    """The smallest area, or latency, of some rows with what belongs to it."""
    row = best(rows, area_of if figure == "logic_elements" else lambda one: one["latency_cycles"])
    if row is None:
        return "–"
    if figure == "logic_elements":
        return f"{cyclonev(row)} ({without_dsp(row)})"
    mhz = row["fmax_mhz"]["ecp5"]
    slow = f", {number(mhz)} MHz" if mhz < PAPER["clock_mhz"] else ""
    return f"{row['latency_cycles']} ({number(row['latency_ns'])} ns{slow})"


def paper_table(report: dict, title: str, functions: Iterable[str], figure: str) -> Table:
    """One of the paper's tables (`paper.toml`) with the paper's columns and ours, one flow.

    Where a family has several cores the smallest figure stands in the cell.
    """
    lines = []
    for function in functions:
        rows = leading(pick(report, [function]))
        if not rows:
            continue
        rational, cordic = (str(PAPER[figure][function][which]) for which in ("rational", "cordic"))
        of = {column: _smallest([row for row in rows if kind(row) == column], figure)
              for column in ("paper", "rational", "parallel", "iterative")}
        theirs = (cordic, "–") if figure == "logic_elements" else ("–", cordic)
        lines.append((function.upper(), rational, of["paper"], of["rational"], theirs[0], of["parallel"],
                      theirs[1], of["iterative"]))
    return Table(title, ("", "rational, printed", "`paper_*`", "`rational_*`", "parallel CORDIC, printed",
                         "`classic_*` parallel", "iterative CORDIC, printed", "`classic_*` iterative"), tuple(lines))


def paper_tables(report: dict) -> list[Table]:
    """Tables III, IV and V with the rows that exist."""
    tables = [paper_table(report, **table) for table in PAPER["table"]]
    return [table for table in tables if table.rows]


# Chains of any number of links beside the fixed cores, and where they cross

CHAINS = {"vector": "vector_chain", "table": "table_chain", "paper": "paper_mff"}
FIXED = tuple(function for function in KINEMATIC if function.startswith("fk"))  # of 1, 2, 3 joints
JOINTS = (1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 24, 32)
CROSSING = 10  # degrees of freedom beyond which the paper says that fixed frames save logic elements
CHAIN_NOTE = """\
A chain takes a link after the other, so its area stays and its clocks grow; the cores fk1 to fk3 have a fixed number of
joints. Of more than three joints there is no fixed core: what stands there with ≈ lies on the straight line through
the three (least squares). Clocks are those from the first link to the tip; a chain also gives every joint before it.
`paper_mff` takes directions in the fixed frame, no joint words, and its roots from tables, `paper_fk*` from digits."""


def clocks(chain: Row, joints: int) -> int:
    """From the edge that accepts the first link to the tip."""
    return chain["latency_cycles"] + (joints - 1) * chain["ii"]


def line(values: list[float], joints: int) -> float:
    """The value of a fixed core: measured to three joints, beyond on the line through these."""
    if joints <= len(values):
        return values[joints - 1]
    slope, start = np.polyfit(np.arange(1, len(values) + 1), values, 1)
    return float(start + slope * joints)


def chains(report: dict) -> dict[str, tuple[Row, list[Row]]]:
    """By family: the chain and the fixed cores of one, two and three joints, where all are there."""
    rows = {row["core"]: row for row in leading(report["cores"])}
    parts = {family: (rows.get(chain), [rows.get(f"{family}_{function}") for function in FIXED])
             for family, chain in CHAINS.items()}
    return {family: (chain, fixed) for family, (chain, fixed) in parts.items() if chain and all(fixed)}


def crossing(chain: Row, fixed: list[Row], most: int = 64) -> int | None:
    """The least number of joints from which on a chain is no larger than a fixed core; None up to `most`."""
    areas = list(map(area_of, fixed))
    larger = [joints for joints in range(1, most + 1) if area_of(chain) > line(areas, joints)]
    return max(larger, default=0) + 1 if most not in larger else None


def chain_table(report: dict) -> Table:
    """ALUT and clocks of each chain and of the fixed cores of its family, by the number of joints."""
    pairs = chains(report)

    def cells(chain: Row, fixed: list[Row], joints: int) -> tuple[str, str]:
        about = "" if joints <= len(fixed) else "≈ "
        of = [line([get(row) for row in fixed], joints) for get in (area_of, lambda row: row["latency_cycles"])]
        return f"{area_of(chain)}; {clocks(chain, joints)}", f"{about}{of[0]:.0f}; {of[1]:.0f}"

    head = [text for family, (chain, _) in pairs.items() for text in (f"`{chain['core']}`", f"`{family}_fk*`")]
    lines = tuple((str(joints), *(cell for pair in pairs.values() for cell in cells(*pair, joints)))
                  for joints in JOINTS)
    return Table("Any number of joints: ALUTs of Cyclone V; clocks", ("joints", *head), lines)


def chain_sentences(report: dict) -> list[str]:
    """Where each chain crosses the fixed cores, beside what the paper says."""
    said = []
    for chain, fixed in chains(report).values():
        joints = crossing(chain, fixed)
        where = f"is no larger than a fixed core from n = {joints} on" if joints else "stays larger than fixed cores"
        beside = ", ".join(f"`{row['core']}` {cyclonev(row)}" for row in fixed)
        said.append(f"`{chain['core']}` ({cyclonev(chain)}, {chain['ii']} clocks a link) {where}; the paper says "
                    f"beyond {CROSSING}. Fixed: {beside}.")
    return said


def chain_section(report: dict) -> list[str]:
    """The section of report.md about chains; empty where no chain has figures yet."""
    if not chains(report):
        return []
    made = chain_table(report)
    return [f"## {made.title}", CHAIN_NOTE, made.markdown(),
            "\n".join(f"- {sentence}" for sentence in chain_sentences(report))]


# Engines that iterate, and the closed form beside them

MHZ = 50
ENGINE_HEAD = ("task", "core", "LUT", "MULT18X18", "EBR", "MHz", "cycles an iteration", "iterations",
               "cycles: median", "95 %", "max", f"us at {MHZ} MHz: median", "95 %", "max", "converged, %")
ENGINE_NOTE = f"""\
Iterations are those of the bit-true models, cycles are measured on the Verilog, over a grid of starts: joints 1 and 2
all round in steps of {convergence.STEP}° (twice that where the model takes long), others at 0; one target, the
examples of the papers; of the starts that converge within {convergence.LIMIT} iterations. Cycles have every pass: the
iterations, the one that finds the answer, and those that only change the range of a word. Under each engine stand the
cores that answer the same in one pass, which need no start. Area, and the clock in MHz, are those of the tables above;
the times are at {MHZ} MHz."""


def engine_table(report: dict) -> Table:
    """An engine a line, and below it the cores that answer in one pass; engines without a synthesis are left out."""
    costs = {row["core"]: row for row in leading(report["cores"])}
    lines = []
    for core, found in report.get("engines", {"rows": {}})["rows"].items():
        if core not in costs:
            continue
        share = 100 * found["converged"] / found["starts"]
        lines.append((found["task"], *_of_engine(costs[core]), str(found["pass"]), str(found["iterations"][0]),
                      *_times(found["cycles"]), number(share)))
        for row in (costs[name] for name in found["closed"] if name in costs):
            lines.append(("in one pass", *_of_engine(row), "–", "–", *_times([row["latency_cycles"]] * 3), "100"))
    return Table("Engines that iterate, and the closed form, on ECP5", ENGINE_HEAD, tuple(lines), text=2)


def _of_engine(row: Row) -> tuple[str, ...]:
    area = row["area"]["ecp5"]
    return f"`{row['core']}`", *(str(area[key]) for key in ("lut", "dsp", "mem")), number(row["fmax_mhz"]["ecp5"])


def _times(cycles: list[int]) -> tuple[str, ...]:
    return (*map(str, cycles), *(number(clocks / MHZ) for clocks in cycles))


def engine_section(report: dict) -> list[str]:
    """The section of report.md; empty where no engine has figures yet."""
    made = engine_table(report)
    return [f"## {made.title}", ENGINE_NOTE, made.markdown()] if made.rows else []
