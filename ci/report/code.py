"""What a Python file reaches, and the digests of files."""

from __future__ import annotations

import ast
from collections.abc import Iterable
from functools import cache
from pathlib import Path

from ci.cache import digest, meaning
from tb.lib import tools

ROOT = tools.ROOT
PLACES = {"quadrance": ROOT / "models", "ci": ROOT, "tb": ROOT}  # top-level package -> its folder


def _file(module: str) -> Path | None:
    """The file of a module of this project, None for any other module."""
    folder = PLACES.get(module.split(".")[0])
    if folder is None:
        return None
    path = folder.joinpath(*module.split("."))
    return next((one for one in (path.with_suffix(".py"), path / "__init__.py") if one.exists()), None)


@cache
def _imports(text: str) -> list[Path]:
    """Files of this project that a source imports, at its top or inside a function."""
    names = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            names += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            names += [node.module, *(f"{node.module}.{alias.name}" for alias in node.names)]
    return [found for one in names if (found := _file(one))]


def closure(starts: Iterable[Path]) -> list[Path]:
    """`starts` and every file of this project that they import, directly or not, in the order of their names."""
    found = list(starts)
    for path in found:
        found += [one for one in dict.fromkeys(_imports(path.read_text())) if one not in found]
    return sorted(found)


def digests(files: Iterable[Path]) -> dict[str, str]:
    """Path in the repository -> digest of what the file means."""
    return {str(path.relative_to(ROOT)): digest(meaning(path))[:16] for path in files}
