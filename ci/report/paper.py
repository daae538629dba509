"""What the paper says beside ours: Tables III, IV and V (`paper.toml`), and chains of links beside fixed cores."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from ci.report.tables import (
    KINEMATIC,
    Row,
    Table,
    area_of,
    best,
    cyclonev,
    kind,
    leading,
    number,
    pick,
    without_dsp,
)

SOURCE = Path(__file__).with_name("paper.toml")
PAPER = tomllib.loads(SOURCE.read_text())


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
