"""Cores beside each other and beside what others say: the tables that compare.

- The verdict at equal accuracy: the shortest words of every core for each target, and what they cost. It follows from
  report["verdict"], which `search` puts together; on no other than the default arm there is one.
- What the paper prints (`paper.toml`) beside ours, and chains of any number of links beside fixed cores.
- Engines that iterate beside the cores that answer in one pass.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterable
from itertools import groupby
from pathlib import Path

import numpy as np
from quadrance import arms

from ci.report.designs import METRE, OUTSIDE, RULES
from ci.report.tables import (
    FAMILIES,
    KINEMATIC,
    Row,
    Table,
    area_of,
    best,
    blocks,
    kind,
    leaders,
    leading,
    number,
    pick,
    without_dsp,
)

TARGETS = tuple(RULES["target"])
Figures = dict  # of one set of a design: what `figures` gives


def figures(verdict: dict, design: dict, pick: dict) -> Figures:
    """What a set costs: a codec at every joint, codecs and core one after the other, at the slowest clock of them."""
    parts = [(verdict["parts"][part], copies) for part, copies in pick["parts"]]

    def area(flow: str, column: str) -> int:
        return sum(part["area"][flow][column] * copies for part, copies in parts)

    clocks, cycles = [part["fmax_mhz"] for part, _ in parts], sum(part["cycles"] for part, _ in parts)
    return {"id": named(design, pick["values"]), "core": design["core"], "codec": design["codec"],
            "family": design["family"], "values": pick["values"], "bits": pick["bits"], "total": pick["total_lsb"],
            "lut": area("ecp5", "lut"), "dsp": area("ecp5", "dsp"), "mem": area("ecp5", "mem"),
            "alut": area("cyclonev", "lut"), "alut_dsp": area("cyclonev", "dsp"), "m10k": area("cyclonev", "mem"),
            "nodsp": area("cyclonev_nodsp", "lut"), "cycles": cycles, "ii": max(part["ii"] for part, _ in parts),
            "ns": None if None in clocks else cycles * 1000 / min(clocks)}


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


def plain(verdict: dict, function: str, metre: bool = False) -> list[dict]:
    """Those without a codec: the cores with their own words, on the arm of the report or on the SCARA of 1 m."""
    return [design for design in in_order(verdict, function)
            if design["codec"] is None and design.get("metre", False) == metre]


def reaching(verdict: dict, function: str, target: str, metre: bool = False) -> list[Figures]:
    """The figures of every core that reaches a target with its own words."""
    return [found for design in plain(verdict, function, metre) if (found := chosen(verdict, design, target))]


# Tables


def named(design: dict, values: dict[str, int]) -> str:
    """A core at these parameters, as a set of the list is named."""
    mode = f"{design['architecture']}-" if "MODE" in values else ""
    return f"`{design['core']}-{mode}" + "".join(
        f"{key}{value}" for key, value in values.items() if key not in ("MODE", OUTSIDE)) + "`"


def _cost(found: Figures) -> tuple[str, ...]:
    """Area on ECP5, cycles and time."""
    return *(str(found[key]) for key in ("lut", "dsp", "mem", "cycles")), number(found["ns"])


COST = ("LUT", "MULT18X18", "EBR", "cycles", "ns")


def _limits(targets: Iterable[str]) -> str:
    """The targets in one cell of the column "at most LSB"."""
    return ", ".join(target.removesuffix(" LSB") for target in targets)


def _reached(verdict: dict) -> list[tuple[str, Figures]]:
    """Every set and the targets for which it is the shortest, function by function, the widest target first."""
    sets: dict[str, tuple[list[str], Figures]] = {}
    for function in KINEMATIC:
        for target in TARGETS:
            for found in reaching(verdict, function, target):
                sets.setdefault(found["id"], ([], found))[0].append(target)
    return [(_limits(targets), found) for targets, found in sets.values()]


def target_table(verdict: dict) -> Table:
    """Every core at every target that it reaches, on ECP5."""
    lines = tuple((target, found["id"], number(found["total"]), *_cost(found)) for target, found in _reached(verdict))
    return Table("The words and what they cost on ECP5", ("at most LSB", "core", "total LSB", *COST), lines, text=2)


def cyclonev_table(verdict: dict) -> Table:
    """The same sets on Cyclone V."""
    lines = tuple((found["id"], *(str(found[key]) for key in ("alut", "alut_dsp", "m10k", "nodsp")))
                  for _, found in _reached(verdict))
    return Table("The same words on Cyclone V", ("core", "ALUT", "DSP", "M10K", "ALUT, no DSP"), lines)


def missed_table(verdict: dict) -> Table:
    """The least error of every core that misses a target."""
    lines = tuple((f"`{design['core']}`", number(design["best_lsb"]))
                  for function in KINEMATIC for design in plain(verdict, function)
                  if not all(map(design["picks"].get, TARGETS)))
    return Table("Cores that miss a target, at any length of word", ("core", "least total LSB"), lines)


def metre_table(verdict: dict) -> Table:
    """Every core at every target that it reaches on the SCARA of 1 m, on ECP5."""
    micrometres = 1000 * arms.load(METRE).mm_per_unit / 256  # of an LSB of Q7.8
    lines = [(target, found["id"], number(found["total"] * micrometres), *_cost(found))
             for function in KINEMATIC for target in RULES["metre"]["target"]
             for found in reaching(verdict, function, target, metre=True)]
    return Table("A SCARA of 1 m, on ECP5", ("at most", "core", "total µm", *COST), tuple(lines), text=2)


def scenario_table(verdict: dict) -> Table:
    """Whole tasks, codecs included, at the scenarios' target, on ECP5: those of one task one below the other."""
    lines = []
    for way in ("fk", "ik"):
        for word in RULES["longest"]:
            for function in (one for one in KINEMATIC if one.startswith(way)):
                for design in in_order(verdict, function):
                    if design["word"] == word and (found := chosen(verdict, design, RULES["scenario"])):
                        codec = f"`{design['codec']}`" if design["codec"] else "–"
                        lines.append((word, found["id"], codec, str(found["values"].get(OUTSIDE, "–")), *_cost(found)))
    return Table("Tasks on ECP5, codecs included", ("joint word", "core", "codec", "word", *COST), tuple(lines), text=3)


WINS = {"ECP5": (("lut", "LUT"), ("price", "LUT, blocks counted"), ("cycles", "cycles"), ("ns", "ns")),
        "Cyclone V": (("alut", "ALUT"), ("nodsp", "ALUT, no DSP"))}


def _least(found: list[Figures], key: str) -> str:
    """The families with the least of a figure; a dash where none is known."""
    known = [one for one in found if one[key] is not None]
    low = min((one[key] for one in known), default=None)
    return ",".join(dict.fromkeys(one["family"] for one in known if one[key] == low)) or "–"


def winners_table(verdict: dict, device: str) -> Table:
    """Who has the least of every figure, for every function and target; targets with the same answer share a row."""
    lines = []
    for function in KINEMATIC:
        least = {}
        for target in TARGETS if plain(verdict, function) else ():
            found = [one | {"price": price(one)} for one in reaching(verdict, function, target)]
            least[target] = tuple(_least(found, key) for key, _ in WINS[device])
        lines += [(function, _limits(targets), *wins) for wins, targets in groupby(least, key=least.get)]
    return Table(f"The family with the least, on {device}",
                 ("function", "at most LSB", *(text for _, text in WINS[device])),
                 tuple(lines), text=2 + len(WINS[device]))


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
            lines.append((function, where.removesuffix(" LSB"),
                          *(f"{pair[0][key]}/{pair[1][key]}" for key, _ in ITSELF)))
    return Table("Turn-spread (`rational_*`) / binary angle (`table_*`), on ECP5",
                 ("function", "at most LSB", *(text for _, text in ITSELF)), tuple(lines), text=2)


# What the paper says beside ours: Tables III, IV and V

PAPER = tomllib.loads(Path(__file__).with_name("paper.toml").read_text())


def _smallest(rows: list[Row], figure: str) -> str:
    """The smallest area, or latency, of some rows with what belongs to it."""
    row = best(rows, area_of if figure == "logic_elements" else lambda one: one["latency_cycles"])
    if row is None:
        return "–"
    if figure == "logic_elements":
        return f"{blocks(row, 'cyclonev')} ({without_dsp(row)})"
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
    return Table(title, ("function", "rational, printed", "`paper_*`", "`rational_*`", "parallel CORDIC, printed",
                         "`classic_*` parallel", "iterative CORDIC, printed", "`classic_*` iterative"), tuple(lines))


def paper_tables(report: dict) -> list[Table]:
    """Tables III, IV and V with the rows that exist."""
    tables = [paper_table(report, **table) for table in PAPER["table"]]
    return [table for table in tables if table.rows]


# Chains of any number of links beside the fixed cores, and where they cross

CHAINS = {"vector": "vector_chain", "table": "table_chain", "paper": "paper_mff"}
CROSSING = 10  # degrees of freedom beyond which the paper says that fixed frames save logic elements
FIXED = tuple(function for function in KINEMATIC if function.startswith("fk"))  # of 1, 2, 3 joints


def line(values: list[float], joints: int) -> float:
    """The value of a fixed core: measured to three joints, beyond on the line through these (least squares)."""
    if joints <= len(values):
        return values[joints - 1]
    slope, start = np.polyfit(np.arange(1, len(values) + 1), values, 1)
    return float(start + slope * joints)


def crossing(chain: Row, fixed: list[Row], most: int = 64) -> int | None:
    """The least number of joints from which on a chain is no larger than a fixed core; None up to `most`."""
    areas = list(map(area_of, fixed))
    larger = [joints for joints in range(1, most + 1) if area_of(chain) > line(areas, joints)]
    return max(larger, default=0) + 1 if most not in larger else None


def chain_table(report: dict) -> Table:
    """Each chain, the fixed cores of its family, and from how many joints on the chain is no larger."""
    rows, lines = {row["core"]: row for row in reversed(leading(report["cores"]))}, []
    for family, name in CHAINS.items():
        chain, fixed = rows.get(name), [rows.get(f"{family}_{function}") for function in FIXED]
        if chain and all(fixed):
            lines.append((f"`{name}`", str(chain["latency_cycles"]), str(chain["ii"]),
                          *(str(area_of(row)) for row in (chain, *fixed)), str(crossing(chain, fixed) or "–")))
    return Table("Any number of joints, on Cyclone V",
                 ("chain", "cycles, one link", "each more", "ALUT", *(f"ALUT of {one}" for one in FIXED),
                  "no larger from"), tuple(lines))


# Engines that iterate, and the closed form beside them

ENGINE_HEAD = ("task", "core", "in one pass: cycles", "cycles an iteration", "iterations", "cycles: median", "95 %",
               "max", "converged, %")


def engine_table(report: dict) -> Table:
    """An engine a line, beside it the cores that answer in one pass; engines without a synthesis are left out."""
    costs, lines = {row["core"]: row for row in reversed(leading(report["cores"]))}, []
    for core, found in report.get("engines", {"rows": {}})["rows"].items():
        if core in costs:
            closed = ", ".join(f"`{one}` {costs[one]['latency_cycles']}" for one in found["closed"] if one in costs)
            lines.append((found["task"], f"`{core}`", closed or "–", str(found["pass"]), str(found["iterations"][0]),
                          *map(str, found["cycles"]), number(100 * found["converged"] / found["starts"])))
    return Table("Engines that iterate, and the closed form", ENGINE_HEAD, tuple(lines), text=3)
