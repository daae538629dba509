"""What a Python file means and reaches: digests that a comment or a docstring does not change."""

from __future__ import annotations

import ast
import io
import tokenize
from collections.abc import Iterable
from functools import cache
from pathlib import Path

from ci.cache import digest
from tb.lib import tools

ROOT = tools.ROOT
PLACES = {"quadrance": ROOT / "models", "ci": ROOT, "tb": ROOT}  # top-level package -> its folder
DOCUMENTED = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)


@cache
def bare(text: str) -> str:
    """Python source without comments, docstrings and empty lines."""
    lines = text.splitlines()
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT:
            row, column = token.start
            lines[row - 1] = lines[row - 1][:column]
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, DOCUMENTED) and ast.get_docstring(node, clean=False) is not None:
            doc = node.body[0]
            rest = lines[doc.end_lineno - 1].encode()[doc.end_col_offset:].decode()
            before = lines[doc.lineno - 1].encode()[:doc.col_offset].decode()
            lines[doc.lineno - 1:doc.end_lineno] = [before + rest, *[""] * (doc.end_lineno - doc.lineno)]
    return "\n".join(line.rstrip() for line in lines if line.strip())


def _file(module: str) -> Path | None:
    """The file of a module of the house, None for any other module."""
    folder = PLACES.get(module.split(".")[0])
    if folder is None:
        return None
    path = folder.joinpath(*module.split("."))
    return next((one for one in (path.with_suffix(".py"), path / "__init__.py") if one.exists()), None)


@cache
def _imports(text: str) -> list[Path]:
    """Files of the house that a source imports, at its top or inside a function."""
    names = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            names += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            names += [node.module, *(f"{node.module}.{alias.name}" for alias in node.names)]
    return [found for one in names if (found := _file(one))]


def closure(starts: Iterable[Path]) -> list[Path]:
    """`starts` and every file of the house that they import, directly or not, in the order of their names."""
    found = list(starts)
    for path in found:
        found += [one for one in dict.fromkeys(_imports(path.read_text())) if one not in found]
    return sorted(found)


def digests(files: Iterable[Path]) -> dict[str, str]:
    """Path in the repository -> digest of what the file means (Python), or of its text (any other)."""
    texts = {str(path.relative_to(ROOT)): path.read_text() for path in files}
    return {file: digest(bare(text) if file.endswith(".py") else text)[:16] for file, text in texts.items()}
