"""Generated blocks of pages that people write: the README's, and the figures on the cores' pages.

``<!-- report:NAME -->`` ... ``<!-- /report:NAME -->`` in the README holds one of `made`;
``<!-- figures:CORE CORE ... -->`` ... ``<!-- /figures -->`` in `rtl/*/README.md` holds a table of those cores (a
name: all its parameter sets; ``name-set``: that one).
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from quadrance.cores import Core

from ci.report import judgement
from ci.report.comparison import pareto, smaller
from ci.report.documents import listed, open_note
from ci.report.paper import paper_tables
from ci.report.rows import Row, name
from ci.report.tables import headline_table, page_table

VERDICT_MORE = ("[The report](reports/report.md#the-verdict-at-equal-accuracy) has the words, area and latency of "
                "every core at every accuracy, and whole tasks with their codecs; [verdict.png](reports/verdict.png) "
                "shows area against latency.")
BLOCKS = ("headline", "smaller", "paper", "pareto", "verdict")
NEEDED = "headline"
README_TARGET = "1 LSB"
FIGURES = re.compile(r"(<!-- figures:([^>]*?) -->\n).*?(<!-- /figures -->)", re.DOTALL)


def made(report: dict) -> dict[str, str]:
    """The README's blocks by name."""
    paper = "\n\n".join(f"**{table.title}**\n\n{table.markdown()}" for table in paper_tables(report))
    return dict(zip(BLOCKS, (headline_table(report).markdown(), "\n\n".join(smaller(report)),
                             paper or "No core of the paper's functions yet.",
                             listed(pareto(report), "No function has both families yet."), _verdict(report))))


def _verdict(report: dict) -> str:
    """Who wins what at one LSB, and what rational trigonometry itself changes."""
    if not report.get("verdict"):
        return "The verdict at equal accuracy was not searched yet: `make verdict`."
    found = report["verdict"]
    return "\n\n".join([*open_note(found), f"With a total error of at most {README_TARGET} of Q7.8 at the tip:",
                        listed(judgement.families(found, README_TARGET), ""), judgement.itself_at(report),
                        listed(judgement.itself(report), ""), VERDICT_MORE])


def _marked(text: str) -> None:
    """Raise ValueError unless the README's markers are known, closed and there."""
    opened = re.findall(r"<!-- report:(\S+) -->", text)
    closed = re.findall(r"<!-- /report:(\S+) -->", text)
    if unknown := [one for one in opened + closed if one not in BLOCKS]:
        raise ValueError(f"README.md: no report block is called '{unknown[0]}'; there are {', '.join(BLOCKS)}")
    if opened != closed:
        raise ValueError(f"README.md: report blocks open as {opened} and close as {closed}")
    if NEEDED not in opened:
        raise ValueError(f"README.md: has no <!-- report:{NEEDED} --> ... <!-- /report:{NEEDED} --> block")


def readme(text: str, report: dict) -> str:
    """`text` with every report block filled.

    Raises
    ------
    ValueError
        A marker of an unknown block, one that is not closed, or a README without the headline.
    """
    _marked(text)
    for block, content in made(report).items():
        text = re.sub(rf"(<!-- report:{block} -->\n).*?(<!-- /report:{block} -->)",
                      lambda match, content=content: f"{match[1]}{content}\n{match[2]}", text, flags=re.DOTALL)
    return text


def _named(text: str, where: str, known: Iterable[str]) -> None:
    """Raise ValueError unless every figures block of a page is closed and names cores of `known`."""
    marks = re.findall(r"<!-- (/?)figures\b[^>]*-->", text)
    blocks = FIGURES.findall(text)
    if marks != ["", "/"] * len(blocks):
        raise ValueError(f"{where}: a figures block is not <!-- figures:CORE ... --> ... <!-- /figures -->")
    for _, cores, _ in blocks:
        if not cores.split():
            raise ValueError(f"{where}: a figures block names no core")
        if unknown := [core for core in cores.split() if core not in known]:
            raise ValueError(f"{where}: figures of '{unknown[0]}': there is no such core")


def page(text: str, rows: list[Row], where: str) -> str:
    """`text` with every figures block filled.

    Raises
    ------
    ValueError
        Naming `where`: a block that is not closed, or a core that has no row.
    """
    _named(text, where, {one for row in rows for one in (row["core"], name(row))})

    def table(match: re.Match) -> str:
        shown = [row for core in match[2].split() for row in rows if core in (row["core"], name(row))]
        return f"{match[1]}{page_table(shown).markdown()}\n{match[3]}"

    return FIGURES.sub(table, text)


def pages(rtl: Path) -> dict[Path, str]:
    """The cores' pages and what they are called."""
    return {path: str(path.relative_to(rtl.parent)) for path in sorted(rtl.glob("*/README.md"))}


def wrong(readme_file: Path, rtl: Path, cores: Iterable[Core]) -> list[str]:
    """Markers that no report could fill."""
    known = {one for core in cores for one in (core.name, core.id)}
    problems = []
    checks = [(_marked, readme_file, ())] if readme_file.exists() else []
    checks += [(_named, path, (where, known)) for path, where in pages(rtl).items()]
    for check, path, args in checks:
        try:
            check(path.read_text(), *args)
        except ValueError as error:
            problems.append(str(error))
    return problems


def stale(report: dict, readme_file: Path, rtl: Path) -> list[str]:
    """Pages whose blocks are not what the report generates."""
    problems = []
    jobs = [(readme_file, readme_file.name, lambda text: readme(text, report), "report")]
    jobs += [(path, where, lambda text, where=where: page(text, report["cores"], where), "figures")
             for path, where in pages(rtl).items()]
    for path, where, filled, kind in jobs:
        try:
            if (text := path.read_text()) != filled(text):
                problems.append(f"{where}: a {kind} block is not what report.json generates")
        except FileNotFoundError:
            problems.append(f"{where} is missing")
        except ValueError as error:
            problems.append(str(error))
    return problems


def write(report: dict, readme_file: Path, rtl: Path) -> None:
    """Fill the blocks of the README, where there is one, and of the cores' pages."""
    if readme_file.exists():
        readme_file.write_text(readme(readme_file.read_text(), report))
    for path, where in pages(rtl).items():
        if (filled := page(text := path.read_text(), report["cores"], where)) != text:
            path.write_text(filled)
