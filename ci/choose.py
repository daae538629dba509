"""Folders of tests for the jobs of the workflow: those named, or with `rest` all that the workflow does not name.

    python3 ci/choose.py "tb/vector tb/table"
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
WORKFLOW = ROOT / ".github" / "workflows" / "regression.yml"


def folders() -> list[str]:
    """Every folder of benches."""
    return sorted({str(path.parent.relative_to(ROOT)) for path in (ROOT / "tb").rglob("test_*.py")})


def rest() -> list[str]:
    """Folders of benches that have no job of their own."""
    named = set(re.findall(r"tb/\w+", WORKFLOW.read_text()))
    return [name for name in folders() if name not in named]


if __name__ == "__main__":
    given = sys.argv[1].split()
    print(*(rest() or ["ci/test_summary.py"] if given == ["rest"] else given))
