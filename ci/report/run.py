"""Put a report together: take what still follows from the committed one, measure the rest, write."""

from __future__ import annotations

import json
import time
from pathlib import Path

from quadrance import arms, cores
from quadrance.cores import Core

from ci import pool, synth
from ci.report import DEFAULT_ARM, OTHERS, REPORTS, documents, figures, freshness, measure
from ci.report.tables import MAPPED, Row, name
from tb.lib import tools


def job(what: str, core_id: str, arm_name: str) -> object:
    """One measurement, in a worker process: "area", "clock", "simulate" or "map"."""
    core = cores.find(core_id)
    if what == "area":
        return synth.core_area(core)
    if what == "clock":
        return synth.core_fmax(core)
    if what == "map":
        return measure.tip_map(core, arm_name, measure.modelled)  # a picture needs no Verilog to be built
    answers = measure.stream if is_default(arm_name) else measure.modelled  # another arm: the bit-true models
    return measure.simulate(core, arm_name, answers)


def mapped(listed: tuple[Core, ...]) -> dict[tuple[str, str], str]:
    """(function, family) -> id of the core that stands for it in the map of the workspace: the first of Q7.8."""
    return {(core.function, core.family): core.id for core in reversed(listed)
            if core.function in MAPPED and (core.params.get("W"), core.params.get("F")) == (16, 8)}


def _rounded(value: object) -> object:
    """Floats to 6 digits, significant and behind the point: more would change with the last bit of a cosine."""
    if isinstance(value, float):
        return round(float(f"{value:.6g}"), 6)
    if isinstance(value, dict):
        return {key: _rounded(one) for key, one in value.items()}
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
    return _rounded({
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
    now = freshness.sources(arm_name, listed)
    kept: dict[str, dict[str, Row]] = {concern: {} if fresh else freshness.kept(committed, now, concern)
                                       for concern in freshness.CONCERNS}
    shown = mapped(listed)
    jobs = [(what, core.id, arm_name) for what, concern in (  # the long ones first
        ("clock", "clock"), ("area", "area"), ("simulate", "simulation"))
            for core in listed if core.id not in kept[concern]]
    jobs += [("map", core_id, arm_name) for core_id in shown.values()]
    found = pool.run(job, jobs, since)
    found |= {("area", core_id, arm_name): row["area"] for core_id, row in kept["area"].items()}
    found |= {("clock", core_id, arm_name): row["fmax_mhz"]["ecp5"] for core_id, row in kept["clock"].items()}
    found |= {("simulate", core_id, arm_name): row for core_id, row in kept["simulation"].items()}
    report = {
        "tools": tools.versions(), "arm": arm_name,
        "trajectory": {"name": arm.name, "l1_mm": arm.l1, "l2_mm": round(arm.l2, 4), "mm_per_unit": arm.mm_per_unit,
                       "yaw": len(arm.limits) == 3, "samples": measure.SAMPLES, "workspace": measure.WORKSPACE},
        "cores": [row_of(core, *(found[what, core.id, arm_name] for what in ("area", "clock", "simulate")))
                  for core in listed]}
    report["sources"] = now | {"figures": freshness.rows_digest(report)}
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
