"""Does this result still follow from these sources? Results are kept by the digest of all that they follow from.

A source counts by its meaning: comments, docstrings and white space change no result. `closure` gives the files that a
Python file imports, `reached` of each file only the functions and constants that a call uses, `of_bulk` and `of_cocotb`
what the benches of a core follow from, and `changes` what is no longer as it was. `build/cache/<digest>.json` holds
what was computed.
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
import subprocess
import tokenize
import tomllib
import uuid
from collections.abc import Callable, Container, Iterable, Iterator
from pathlib import Path
from types import FunctionType, ModuleType
from typing import NamedTuple

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


def commit() -> str:
    """The commit of the checkout, which draws what a check runs again; "" where there is none."""
    done = subprocess.run(["git", "rev-parse", "HEAD"], cwd=ROOT, capture_output=True, text=True)
    return done.stdout.strip() if done.returncode == 0 else ""


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


class Source(NamedTuple):
    """A Python file by its statements; statements that name nothing always count."""

    always: list[ast.stmt]
    named: dict[str, list[ast.stmt]]
    imported: dict[str, tuple[Path, str | None]]  # name -> a file of this project and a name in it, None for all of it
    lines: list[str]

    def text(self, node: ast.stmt) -> str:
        """What a statement means, with its decorators."""
        first = min(one.lineno for one in (node, *getattr(node, "decorator_list", ())))
        return bare("\n".join(self.lines[first - 1:node.end_lineno]), ".py")


def _docstring(node: ast.stmt) -> bool:
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)


@functools.cache
def source(path: Path) -> Source:
    """The statements of a file at its top; imports inside a function count as imports at the top.

    An import from outside the project defines its name like a constant: another library under it is another meaning.
    """
    text = path.read_text()
    found = Source([], {}, {}, text.splitlines())
    statements = []
    for node in ast.parse(text).body:
        if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
            statements += node.orelse
        else:
            statements.append(node)
    for node in statements:
        if isinstance(node, DOCUMENTED):
            names = [node.name]
        elif isinstance(node, ast.Assign | ast.AnnAssign | ast.AugAssign):
            names = [one.id for one in ast.walk(node) if isinstance(one, ast.Name) and isinstance(one.ctx, ast.Store)]
        else:
            names = []
        for name in names:
            found.named.setdefault(name, []).append(node)
        if not names and not isinstance(node, ast.Import | ast.ImportFrom) and not _docstring(node):
            found.always.append(node)
        for one in ast.walk(node):
            if isinstance(one, ast.Import):
                places = [(alias.asname or alias.name.split(".")[0], alias.name if alias.asname else
                           alias.name.split(".")[0], None) for alias in one.names]
            elif isinstance(one, ast.ImportFrom) and one.module and not one.level:
                places = [(alias.asname or alias.name, f"{one.module}.{alias.name}", one.module) for alias in one.names]
            else:
                continue
            for name, whole, part in places:
                if file := _file(whole):
                    found.imported[name] = file, None
                elif part and (file := _file(part)):
                    found.imported[name] = file, whole.rpartition(".")[2]
                elif one is node:
                    found.named.setdefault(name, []).append(node)
    return found


def _chains(node: ast.AST) -> Iterator[list[str]]:
    """Names that a statement uses, each with the attributes that are taken of it: `a.b.c` is [a, b, c]."""
    chain, base = [], node
    while isinstance(base, ast.Attribute):
        chain, base = [base.attr, *chain], base.value
    if isinstance(base, ast.Name):
        yield [base.id, *chain]
        return
    for child in ast.iter_child_nodes(base):
        yield from _chains(child)


def _target(path: Path, chain: list[str]) -> tuple[Path, str | None] | None:
    """Where `chain` is defined: a file and a name at its top, None for all of the file; None: not in this project."""
    here = source(path)
    if chain[0] in here.named:
        return path, chain[0]
    if chain[0] not in here.imported:
        return None
    file, name = here.imported[chain[0]]
    if name is not None:
        return file, name
    if len(chain) == 1:
        return file, None
    part = file.parent / f"{chain[1]}.py" if file.name == "__init__.py" else file
    if chain[1] not in source(file).named and chain[1] not in source(file).imported and part != file and part.exists():
        return (part, chain[2]) if len(chain) > 2 else (part, None)
    return _target(file, chain[1:]) or (file, None)


@functools.cache
def _meant(path: Path, name: str) -> tuple[str, tuple[tuple[Path, str | None], ...]]:
    """Text of what defines a name at the top of a file, "" of what always counts, and where what it uses is defined."""
    here = source(path)
    nodes = here.named[name] if name else here.always
    used = (_target(path, chain) for node in nodes for chain in _chains(node))
    return "\n".join(map(here.text, nodes)), tuple(filter(None, used))


def reached(starts: Iterable[tuple[Path, str | None]], leave: Container[Path] = ()) -> dict[tuple[Path, str], str]:
    """(file, name) -> text of every function, class and constant that `starts` use, directly or not.

    A name of None is all of its file: a module that is passed on as a value, or an attribute that is defined nowhere.
    Files of `leave` are not looked into. What a class or a constant may use counts, whether it is called or not.
    """
    found, todo, seen = {}, list(starts), set()
    while todo:
        path, name = todo.pop()
        if (path, name) in seen or path in leave:
            continue
        seen.add((path, name))
        here = source(path)
        if (path, "") not in found:
            found[path, ""], used = _meant(path, "")
            todo += used
        if name is None:
            todo += [(path, one) for one in here.named]
        elif name in here.named:
            found[path, name], used = _meant(path, name)
            todo += used
        else:
            todo.append(_target(path, [name]) or (path, None))
    return found


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
