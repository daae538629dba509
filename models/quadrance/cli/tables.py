"""This module fits tables to the terminal: it drops the least important columns first and never truncates a figure."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass

from rich import box
from rich.console import Console
from rich.table import Table


@dataclass(frozen=True)
class Column:
    """A column: its head, whether it holds text, and how soon it goes where there is no room (0: never)."""

    head: str
    text: bool = False
    rank: int = 0


def grid(columns: Sequence[Column], rows: Sequence[Sequence[str]], width: int, title: str | None = None) -> Table:
    """A table of at most `width` characters where leaving out ranked columns allows it; a note names those left out."""
    keep = list(range(len(columns)))
    sizes = [max(len(line) for cell in (column.head, *(str(row[i]) for row in rows)) for line in cell.split("\n"))
             for i, column in enumerate(columns)]

    def room() -> int:
        return sum(sizes[i] + 3 for i in keep)

    while room() > width and (ranked := [i for i in keep if columns[i].rank]):
        keep.remove(max(ranked, key=lambda i: (columns[i].rank, i)))
    gone = [columns[i].head.replace("\n", " ") for i in range(len(columns)) if i not in keep]
    table = Table(title=title, title_justify="left", box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False,
                  padding=(0, 2, 0, 0), caption=f"no room for: {', '.join(gone)}" if gone else None,
                  caption_justify="left")
    for i in keep:
        table.add_column(columns[i].head, justify="left" if columns[i].text else "right",
                         no_wrap=room() <= width or not columns[i].text, overflow="fold")
    for row in rows:
        table.add_row(*(str(row[i]) for i in keep))
    return table


def console() -> Console:
    """Where tables go: as wide as the terminal (or COLUMNS), 160 characters into a file or a pipe."""
    here = Console(highlight=False, markup=False, soft_wrap=False)
    return here if here.is_terminal or os.environ.get("COLUMNS") else Console(highlight=False, markup=False, width=160)
