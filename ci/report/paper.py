"""Our figures in the paper's Tables III, IV and V, beside the printed ones (`paper.toml`)."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable
from pathlib import Path

from ci.report.rows import Row, area_of, best, kind, leading, number, pick, without_dsp
from ci.report.tables import Table, area

SOURCE = Path(__file__).with_name("paper.toml")
PAPER = tomllib.loads(SOURCE.read_text())


def _smallest(rows: list[Row], figure: str) -> str:
    """The smallest area, or latency, of some rows with what belongs to it."""
    row = best(rows, area_of if figure == "logic_elements" else lambda one: one["latency_cycles"])
    if row is None:
        return "–"
    if figure == "logic_elements":
        return f"{area(row)} ({without_dsp(row)})"
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
