"""The report on the terminal."""

from __future__ import annotations

from quadrance.cli.tables import Column, console, grid
from rich.table import Table as Grid

from ci.report import engines, judgement
from ci.report.comparison import cordic_wins, pareto, smaller
from ci.report.documents import trajectory_note
from ci.report.paper import paper_tables
from ci.report.rows import KINEMATIC, pick, primitives
from ci.report.tables import Table, accuracy_table, cost_table, headline_table, primitive_table


def _grid(table: Table, width: int) -> Grid:
    """The table in that width: columns further to the right go first, but for the text at the left."""
    columns = [Column(head.replace("`", ""), i < table.text, 0 if i == 0 else i) for i, head in enumerate(table.head)]
    rows = [[cell.replace("`", "") for cell in line] for line in table.rows]
    return grid(columns, rows, width, table.title)


def show(report: dict) -> None:
    """The tables of the report and what follows from them."""
    out = console()
    kinematic, others = pick(report, KINEMATIC), primitives(report)
    tables = [cost_table("Kinematic cores", kinematic), accuracy_table("Accuracy at the tip", kinematic),
              cost_table("Primitives", others), primitive_table(others), engines.table(report), *paper_tables(report),
              headline_table(report)]
    out.print(trajectory_note(report))
    for table in tables:
        if table.rows:
            out.print(_grid(table, out.width))
    for title, sentences in (("Rational against iterative CORDIC", [*pareto(report), *smaller(report)]),
                             ("Where CORDIC wins", cordic_wins(report)),
                             ("The verdict at equal accuracy", judgement.wins(report["verdict"])
                              if report.get("verdict") else []),
                             ("What rational trigonometry itself changes", judgement.itself(report)
                              if report.get("verdict") else [])):
        if sentences:
            out.print(title, style="bold")
            for sentence in sentences:
                out.print("  " + sentence.replace("`", ""))
