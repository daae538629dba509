"""reports/checks.md: what long runs found, a section each, written by the run that found it."""

from __future__ import annotations

import re

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
