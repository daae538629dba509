"""The report on the terminal."""

from __future__ import annotations

import sys

from rich.console import Console
from rich.table import Table as Grid

from ci.report import judgement
from ci.report.comparison import cordic_wins, pareto, smaller
from ci.report.documents import trajectory_note
from ci.report.paper import paper_tables
from ci.report.rows import KINEMATIC, pick, primitives
from ci.report.tables import Table, accuracy_table, cost_table, headline_table, primitive_table


def _grid(table: Table) -> Grid:
    grid = Grid(title=table.title, title_justify="left")
    for i, head in enumerate(table.head):
        grid.add_column(head.replace("`", ""), justify="left" if i < table.text else "right", no_wrap=i == 0)
    for line in table.rows:
        grid.add_row(*(cell.replace("`", "") for cell in line))
    return grid


def show(report: dict) -> None:
    """The tables of the report and what follows from them."""
    console = Console(width=None if sys.stdout.isatty() else 160)
    kinematic, others = pick(report, KINEMATIC), primitives(report)
    tables = [cost_table("Kinematic cores", kinematic), accuracy_table("Accuracy at the tip", kinematic),
              cost_table("Primitives", others), primitive_table(others), *paper_tables(report), headline_table(report)]
    console.print(trajectory_note(report), markup=False)
    for table in tables:
        if table.rows:
            console.print(_grid(table))
    for title, sentences in (("Rational against iterative CORDIC", [*pareto(report), *smaller(report)]),
                             ("Where CORDIC wins", cordic_wins(report)),
                             ("The verdict at equal accuracy", judgement.wins(report["verdict"])
                              if report.get("verdict") else []),
                             ("What rational trigonometry itself changes", judgement.itself(report)
                              if report.get("verdict") else [])):
        if sentences:
            console.print(f"[bold]{title}[/bold]")
            for sentence in sentences:
                console.print("  " + sentence.replace("`", ""), markup=False, highlight=False)
