"""This script summarises pytest's JUnit file in Markdown: counts, failures with their reasons, the longest tests.

    python3 ci/summary.py build/test.xml

It is plain Python, so that it also runs where the tests could not be set up.
"""

from __future__ import annotations

import sys
from pathlib import Path
from xml.etree import ElementTree

SLOWEST, LINES = 5, 12


def _name(case: ElementTree.Element) -> str:
    return f"{case.get('classname')}::{case.get('name')}"


def summary(path: Path) -> str:
    """The Markdown text; a sentence where there is no result."""
    if not path.exists():
        return f"No result: {path} was not written.\n"
    cases = list(ElementTree.parse(path).iter("testcase"))
    failed = [(case, reason) for case in cases for reason in (*case.iter("failure"), *case.iter("error"))]
    skipped = sum(1 for case in cases if case.find("skipped") is not None)
    lines = [f"**{len(cases) - len(failed) - skipped} passed, {len(failed)} failed, {skipped} skipped**", ""]
    for case, reason in failed:
        text = (reason.text or reason.get("message") or "").strip().splitlines()[-LINES:]
        lines += [f"- `{_name(case)}`", "", "  ```", *(f"  {line}" for line in text), "  ```"]
    slow = sorted(cases, key=lambda case: -float(case.get("time") or 0))[:SLOWEST]
    lines += ["", "| slowest | s |", "|---|---:|",
              *(f"| `{_name(case)}` | {float(case.get('time') or 0):.1f} |" for case in slow)]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    print(summary(Path(sys.argv[1])), end="")
