"""Does this result still follow from these sources? Results are kept by the digest of all that they follow from.

A source counts by its meaning: comments, docstrings and white space change no result. `closure` gives what a Python
file reaches, `of_bulk` and `of_cocotb` what the benches of a core follow from, and `changes` what is no longer as it
was. `build/cache/<digest>.json` holds what was computed.
"""

from __future__ import annotations

import ast
import functools
import hashlib
import importlib
import inspect
import io
import json
import re
import tokenize
import tomllib
import uuid
from collections.abc import Callable, Iterable
from pathlib import Path
from types import FunctionType, ModuleType

from quadrance.cores import Core

from tb.lib import tools

ROOT = tools.ROOT
FOLDER = tools.BUILD / "cache"
SINCE = 0.0  # seconds of the epoch: what is older is made again
PLACES = {"quadrance": ROOT / "models", "ci": ROOT, "tb": ROOT}  # top-level package -> its folder
BULK = ("tb/lib/stimulus.py", "tb/lib/suite.py", "tb/lib/bulk.py", "tb/lib/bulk.cpp", "tb/lib/program.py",
        "tb/lib/program.cpp")
COCOTB = ("tb/lib/bench.py", "tb/lib/stream.py")

# What a source means

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


def digests(files: Iterable[Path]) -> dict[str, str]:
    """Path in the repository -> digest of what the file means."""
    return {str(path.relative_to(ROOT)): digest(meaning(path))[:16] for path in files}


def changes(old: dict, new: dict, what: str) -> list[str]:
    """What was there, is there, or differs, by key."""
    return [f"{what} {key} " + ("is not in the report" if key not in old else
                                "is in the report but gone" if key not in new else "changed")
            for key in sorted(set(old) | set(new)) if old.get(key) != new.get(key)]


# What a result follows from


def _file(module: str) -> Path | None:
    """The file of a module of this project, None for any other module."""
    folder = PLACES.get(module.split(".")[0])
    if folder is None:
        return None
    path = folder.joinpath(*module.split("."))
    return next((one for one in (path.with_suffix(".py"), path / "__init__.py") if one.exists()), None)


@functools.cache
def _imports(text: str) -> list[Path]:
    """Files of this project that a source imports, at its top or inside a function; not those of types alone."""
    names, tree = [], ast.parse(text)
    typed = {one for node in ast.walk(tree) if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"
             for body in node.body for one in ast.walk(body)}
    for node in ast.walk(tree):
        if node in typed:
            continue
        if isinstance(node, ast.Import):
            names += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            names += [node.module, *(f"{node.module}.{alias.name}" for alias in node.names)]
    return [found for one in names if (found := _file(one))]


def closure(starts: Iterable[Path]) -> list[Path]:
    """`starts` and every file of this project that they import, directly or not, in the order of their names.

    This file is left out: it keeps results, and makes none.
    """
    found = list(starts)
    for path in found:
        found += [one for one in dict.fromkeys(_imports(path.read_text())) if one not in (*found, Path(__file__))]
    return sorted(found)


def stimulus(core: Core) -> list[Path]:
    """The files that a core's samples come from: of its family, of single models its own alone, and what these use."""
    family = importlib.import_module(f"tb.stimulus.{core.family}")
    used = {one if isinstance(one, ModuleType) else inspect.getmodule(one) for one in vars(family).values()
            if isinstance(one, ModuleType | FunctionType)} - {family}
    own = getattr(family, "MODELS", {})
    used = {one for one in used if one not in own.values()} | {own.get(core.model_name, family)} - {family}
    files = closure(Path(one.__file__) for one in used if one.__name__.startswith("tb."))
    return [Path(family.__file__), *(one for one in files if one.is_relative_to(ROOT / "tb")
                                     and not one.is_relative_to(ROOT / "tb" / "lib"))]


def of_samples(core: Core) -> list[str]:
    """What a bulk run of `core` follows from beside its RTL: its samples, the run."""
    return meanings((*stimulus(core), *(ROOT / name for name in BULK)))


def of_bulk(core: Core) -> list[str]:
    """What a bulk run of `core` follows from: its RTL, its samples, the run."""
    return meanings(core.sources) + of_samples(core)


def of_cocotb() -> list[str]:
    """What the cocotb bench follows from, beside the sources of the bulk run."""
    return meanings(ROOT / name for name in COCOTB)


# What is kept


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
