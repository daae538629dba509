"""Does this result still follow from these sources? Results are kept by the digest of all that they follow from.

A source counts by its meaning: comments, docstrings and white space change no result.
`build/cache/<digest>.json` holds what was computed.
"""

from __future__ import annotations

import ast
import functools
import hashlib
import io
import json
import re
import tokenize
import tomllib
import uuid
from collections.abc import Callable, Iterable
from pathlib import Path

from tb.lib import tools

FOLDER = tools.BUILD / "cache"
SINCE = 0.0  # seconds of the epoch: what is older is made again


C_COMMENT = re.compile(r"(\"(?:\\.|[^\"\\])*\")|//[^\n]*|/\*.*?\*/", re.S)
# Words and signs of Verilog; signs as long as they can be, for `& &a` is not `&&a`
VERILOG = re.compile(r'"(?:\\.|[^"\\])*"|\\\S+|[\w$`\']+|<<<|>>>|===|!==|<<|>>|<=|>=|==|!=|&&|\|\||\*\*|~&|~\||~\^|'
                     r"\^~|->|\+:|-:|\(\*|\*\)|::|\S")
DOCUMENTED = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)


def _python(text: str) -> str:
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


def _plain(text: str) -> str:
    """Text of a language with comments as in C."""
    return C_COMMENT.sub(lambda match: match[1] or " ", text)


@functools.cache
def bare(text: str, kind: str) -> str:
    """What a source means, by the suffix of its file: any other text means what it says."""
    if kind == ".py":
        return _python(text)
    if kind in (".v", ".sv"):
        return " ".join(VERILOG.findall(_plain(text)))
    if kind in (".cpp", ".h"):
        return "\n".join(" ".join(line.split()) for line in _plain(text).splitlines() if line.strip())
    if kind == ".toml":
        return json.dumps(tomllib.loads(text))
    return text


def meaning(path: Path) -> str:
    """What a file means."""
    return bare(path.read_text(), path.suffix)


def meanings(paths: Iterable[Path]) -> list[str]:
    """What files mean, in their order."""
    return [meaning(path) for path in paths]


def digest(key: object) -> str:
    """Name of a result: the content of all that it depends on."""
    return hashlib.sha256(json.dumps(key, sort_keys=True).encode()).hexdigest()[:24]


def current(path: Path) -> bool:
    """Whether `path` is there and not older than `SINCE`."""
    return path.exists() and path.stat().st_mtime >= SINCE


def cached(key: object, compute: Callable[[], dict], keep: Callable[[dict], bool] | None = None) -> dict:
    """The JSON result of `compute()`, computed once for each content of `key` (if `keep` says so of it).

    The file appears whole or not at all, however many processes compute it.
    """
    path = FOLDER / f"{digest(key)}.json"
    if current(path):
        return json.loads(path.read_text())
    result = compute()
    if keep and not keep(result):
        return result
    FOLDER.mkdir(parents=True, exist_ok=True)
    partial = path.with_suffix(f".{uuid.uuid4().hex}")
    partial.write_text(json.dumps(result))
    partial.replace(path)
    return result
