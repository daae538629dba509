"""What the long runs share: the cores that a command line names, and the page of what they found, reports/checks.md."""

from __future__ import annotations

import re
from collections.abc import Iterable

from quadrance.cli import catalogue
from quadrance.cores import Core

from tb.lib import tools

PAGE = tools.ROOT / "reports" / "checks.md"


def put(title: str, lines: list[str]) -> None:
    """Replace the section of that title, or add it at the end."""
    text = PAGE.read_text() if PAGE.exists() else "# What the long runs found\n"
    parts = re.split(r"^(?=## )", text, flags=re.M)
    section = "\n".join([f"## {title}", "", *lines]) + "\n"
    at = next((i for i, part in enumerate(parts) if part.startswith(f"## {title}\n")), len(parts))
    parts[at:at + 1] = [section]
    PAGE.write_text("\n".join(part.rstrip("\n") + "\n" for part in parts))


def named(tool: str, names: Iterable[str]) -> list[Core]:
    """The cores of these names or ids; `tool` ends with one line where there is none of a name."""
    try:
        return [catalogue.find(name) for name in names]
    except catalogue.Refused as error:
        raise SystemExit(f"{tool}: {error}") from None
