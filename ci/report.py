"""Measure every core on a real arm and write what it costs: `reports/` and the README's tables.

    python -m ci.report --arm cobra600     simulate, synthesise, place, compare; write reports/ and the README
    python -m ci.report --check            does the committed report still follow from the sources? (seconds)
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import sys
import time
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path

from quadrance import arms, cores
from quadrance.cores import Core

from ci import cache, render, synth
from tb.lib import tools

REPORTS = tools.ROOT / "reports"
README = tools.ROOT / "README.md"
LOG = tools.BUILD / "report.log"
DEFAULT_ARM = "cobra600"
SAMPLES = 1000
SWEEP = 4096
MAP = 121  # points a side of the map of the workspace
REFRESH = "run `make report` and commit reports/ and README.md"

# What a figure depends on besides the core's own sources
CODE = (*(f"models/quadrance/{name}.py" for name in ("truth", "accuracy", "trajectory", "fixed", "cores",
                                                     "arms/__init__")),
        "ci/report.py", "ci/render.py", "ci/synth/__init__.py", "ci/synth/flows.py", "tb/lib/bulk.py",
        "tb/lib/bulk.cpp")


# Measuring (each of these runs in a worker process)


def _simulate(core: Core, inputs: dict, cfg: dict[str, int]) -> dict:
    """Outputs, latency and II of the Verilog for these words, cached by everything they depend on."""
    from tb.lib import bulk

    lists = {port: [int(word) for word in words] for port, words in inputs.items()}
    texts = [path.read_text() for path in (*core.sources, bulk.SOURCE)]

    def compute() -> dict:
        result = bulk.stream(core, inputs, cfg)
        return {"outputs": {port: [int(word) for word in words] for port, words in result.outputs.items()},
                "latency": sorted({int(cycles) for cycles in result.latency}), "ii": result.ii}

    return cache.cached(["stream", core.name, core.params, texts, tools.versions()["verilator"], lists, cfg], compute)


def simulate(core: Core, arm_name: str) -> dict:
    """Latency, II and errors of one core on the arm's trajectory and in the sweep."""
    import numpy as np
    from quadrance import accuracy

    arm = arms.load(arm_name)
    row: dict = dict.fromkeys(("error_lsb", "error_mm", "input_error_lsb", "sweep_error_lsb"))
    day, sweep = accuracy.trajectory_case(core, arm, SAMPLES), accuracy.sweep_case(core, arm, SWEEP)
    timed = None
    for case, is_day in ((day, True), (sweep, False)):
        if case is None:
            continue
        result = _simulate(core, case.inputs, case.cfg)
        timed = timed or result
        outputs = {port: np.array(words, dtype=np.int64) for port, words in result["outputs"].items()}
        errors = accuracy.errors(core, arm, case, outputs)
        if errors is None:
            continue
        if is_day:
            row |= {"error_lsb": accuracy.summary(errors.arithmetic),
                    "error_mm": accuracy.summary(errors.arithmetic, accuracy.mm_per_lsb(core, arm)),
                    "input_error_lsb": accuracy.summary(errors.quantisation)}
        else:
            row["sweep_error_lsb"] = accuracy.summary(errors.arithmetic)
    if core.function not in accuracy.JOINTS:
        row["error_lsb"] = row["sweep_error_lsb"]
    if timed is None:  # a function without a truth here: its timing on its own corners
        from tb.lib import stimulus

        cfg = stimulus.configs(core, np.random.default_rng(1))[0]
        timed = _simulate(core, stimulus.corners(core, cfg), cfg)
    cycles, ii = (timed["latency"][-1], timed["ii"]) if core.clocked else (0, 0)
    for what, measured, listed in (("latency", cycles, core.latency), ("ii", ii, core.ii)):
        if listed is not None and measured is not None and measured != listed:
            raise ValueError(f"{core.id}: {what} is {measured} in simulation and {listed} in rtl/cores.toml")
    return row | {"latency_cycles": cycles, "ii": ii}


def tip_map(core: Core, arm_name: str) -> dict[str, list]:
    """Arithmetic error and rounding of the words over the workspace, LSB: (MAP, MAP) each, NaN out of reach."""
    import numpy as np
    from quadrance import accuracy

    arm = arms.load(arm_name)
    case, inside = accuracy.map_case(core, arm, MAP)
    outputs = _simulate(core, case.inputs, case.cfg)["outputs"]
    found = accuracy.errors(core, arm, case, {port: np.array(words) for port, words in outputs.items()}, every=True)
    maps = {}
    for what, error in (("arithmetic", found.arithmetic), ("words", found.quantisation)):
        grid = np.full(inside.shape, np.nan)
        grid[inside] = error
        maps[what] = grid.tolist()
    return maps


def _quiet() -> None:
    """Send what the tools of a worker process say to a log, away from the progress bar."""
    LOG.parent.mkdir(parents=True, exist_ok=True)
    log = os.open(LOG, os.O_WRONLY | os.O_CREAT | os.O_APPEND)
    os.dup2(log, 1)
    os.dup2(log, 2)


def _job(what: str, core_id: str, arm_name: str) -> tuple[str, object]:
    core = cores.find(core_id)
    try:
        if what == "area":
            return what, synth.core_area(core)
        if what == "map":
            return what, tip_map(core, arm_name)
        return what, synth.core_fmax(core) if what == "clock" else simulate(core, arm_name)
    except (Exception, SystemExit) as error:
        raise RuntimeError(f"{core_id}, {what}: {error} (log: {LOG.relative_to(tools.ROOT)})") from None


def _rounded(value: object) -> object:
    """Floats to 6 digits, significant and behind the point: more would change with the last bit of a cosine."""
    if isinstance(value, float):
        return round(float(f"{value:.6g}"), 6)
    if isinstance(value, dict):
        return {key: _rounded(one) for key, one in value.items()}
    return value


def row_of(core: Core, area: dict, clock: float, simulated: dict) -> dict:
    """One element of report["cores"]."""
    periods = max(simulated["latency_cycles"], 1)
    return _rounded({
        "core": core.name, "set": core.set_id, "family": core.family, "function": core.function,
        "architecture": core.architecture, "params": core.params,
        "latency_cycles": simulated["latency_cycles"], "ii": simulated["ii"],
        "area": area, "fmax_mhz": {"ecp5": clock}, "latency_ns": periods * 1000 / clock,
        **{key: simulated[key] for key in ("error_lsb", "error_mm", "input_error_lsb", "sweep_error_lsb")}})


def mapped(listed: tuple[Core, ...]) -> dict[tuple[str, str], Core]:
    """The core that stands for (function, family) in the map of the workspace: the first of Q7.8."""
    return {(core.function, core.family): core for core in reversed(listed)
            if core.function in render.MAPPED and (core.params.get("W"), core.params.get("F")) == (16, 8)}


def measure(arm_name: str, listed: tuple[Core, ...]) -> tuple[dict, dict]:
    """The whole report of `listed` cores on an arm, with a progress bar, and the maps of the workspace."""
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

    arm = arms.load(arm_name)
    found: dict[str, dict[str, object]] = {core.id: {} for core in listed}
    failures: list[str] = []
    columns = (TextColumn("measuring"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn(),
               TextColumn("{task.description}"))
    LOG.unlink(missing_ok=True)
    with ProcessPoolExecutor(min(8, os.cpu_count() or 1), initializer=_quiet) as pool, \
            Progress(*columns, console=Console(stderr=True)) as progress:
        shown = mapped(listed)
        task = progress.add_task("", total=3 * len(listed) + len(shown))
        jobs = {pool.submit(_job, what, core.id, arm_name): core.id
                for what in ("clock", "area", "simulate") for core in listed}  # the long ones first
        jobs |= {pool.submit(_job, "map", core.id, arm_name): core.id for core in shown.values()}
        try:
            for job in as_completed(jobs):
                try:
                    what, value = job.result()
                    found[jobs[job]][what] = value
                    progress.update(task, advance=1, description=f"{jobs[job]} {what}")
                except RuntimeError as error:  # measure the others all the same: they are in the cache next time
                    failures.append(str(error))
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    if failures:
        raise RuntimeError("\n".join([f"{len(failures)} measurements failed", *failures]))
    rows = [row_of(core, *(found[core.id][what] for what in ("area", "clock", "simulate"))) for core in listed]
    maps = {key: found[core.id]["map"] for key, core in shown.items()}
    return {
        "tools": tools.versions(), "arm": arm_name,
        "trajectory": {"name": arm.name, "l1_mm": arm.l1, "l2_mm": round(arm.l2, 4), "mm_per_unit": arm.mm_per_unit,
                       "yaw": len(arm.limits) == 3, "samples": SAMPLES},
        "cores": rows, "sources": sources(arm_name, listed)}, maps


# Checking


def _digest(*parts: object) -> str:
    return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()[:16]


def sources(arm_name: str, listed: tuple[Core, ...]) -> dict:
    """Digests of all that the figures follow from: each core, the arm, the code that measures."""
    def of(core: Core) -> str:
        texts = [(str(path.relative_to(cores.RTL)), path.read_text()) for path in core.sources]
        ports = [(port.name, port.width, port.signed) for port in (*core.cfg, *core.inputs, *core.outputs)]
        return _digest(texts, core.name, core.family, core.function, core.architecture, core.params, ports,
                       core.latency, core.ii)

    package = tools.ROOT / "models" / "quadrance"
    files = [tools.ROOT / name for name in CODE] + [  # models that derive configuration words from the arm's links
        path for family in sorted({core.family for core in listed if core.cfg})
        if (path := package / f"{family}.py").exists() and "\ndef config(" in path.read_text()]
    return {"cores": {core.id: of(core) for core in listed}, "arm": _digest(arms.path_of(arm_name).read_text()),
            "code": {str(path.relative_to(tools.ROOT)): _digest(path.read_text()) for path in files}}


def _changes(old: dict, new: dict, what: str) -> list[str]:
    return [f"{what} {key} " + ("is not in the report" if key not in old else
                                "is in the report but gone" if key not in new else "changed")
            for key in sorted(set(old) | set(new)) if old.get(key) != new.get(key)]


def check(folder: Path = REPORTS, readme: Path = README, listed: tuple[Core, ...] | None = None) -> list[str]:
    """Why the report in `folder` no longer follows from the sources; empty when it does."""
    listed = cores.all_cores() if listed is None else listed
    try:
        report = json.loads((folder / "report.json").read_text())
        recorded, made = report["sources"], report["tools"]
        now = sources(report["arm"], listed)
        text = render.markdown(report)
        stamp = render.stamp(report)
    except FileNotFoundError as error:
        return [f"{error.filename} is missing"]
    except (KeyError, TypeError, json.JSONDecodeError, arms.ArmError) as error:
        return [f"report.json: {type(error).__name__}: {error}"]
    problems = _changes(recorded["cores"], now["cores"], "core") + _changes(recorded["code"], now["code"], "file")
    if recorded["arm"] != now["arm"]:
        problems.append(f"arm {report['arm']} changed")
    problems += [f"tool {name}: {made.get(name)} in the report, {version} here"
                 for name, version in tools.versions().items() if made.get(name) != version]
    if recorded.get("figures") != stamp:
        problems.append("report.json: a figure was changed by hand")
    if not (folder / "report.md").exists() or (folder / "report.md").read_text() != text:
        problems.append("report.md is not what report.json generates")
    for plot in render.PLOTS:
        if not (folder / plot).exists() or stamp.encode() not in (folder / plot).read_bytes():
            problems.append(f"{plot} does not show the figures of report.json")
    try:
        if readme.read_text() != render.readme(readme.read_text(), report):
            problems.append(f"{readme.name}: a report block is not what report.json generates")
    except (FileNotFoundError, ValueError) as error:
        problems.append(f"{readme.name} is missing" if isinstance(error, FileNotFoundError) else str(error))
    return problems


# Writing


def write(report: dict, maps: dict, folder: Path = REPORTS, readme: Path = README) -> None:
    """report.json, report.md, the plots, and the README's blocks where there is a README."""
    report["sources"]["figures"] = render.stamp(report)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "report.json").write_text(json.dumps(report, indent=1) + "\n")
    (folder / "report.md").write_text(render.markdown(report))
    render.plots(report, maps, folder)
    if readme.exists():
        readme.write_text(render.readme(readme.read_text(), report))


def show(report: dict) -> None:
    """The tables of the report on the terminal."""
    from rich.console import Console
    from rich.table import Table

    console = Console(width=None if sys.stdout.isatty() else 160)
    kinematic = render.pick(report, render.KINEMATIC)
    others = [row for row in report["cores"] if row["function"] not in render.KINEMATIC]
    tables = [render.cost_table("Kinematic cores", kinematic), render.accuracy_table("Accuracy at the tip", kinematic),
              render.cost_table("Primitives", others), render.primitive_table(others), *render.paper_tables(report)]
    console.print(render.trajectory_note(report), markup=False)
    for one in (table for table in tables if table.rows):
        grid = Table(title=one.title, title_justify="left")
        for i, head in enumerate(one.head):
            grid.add_column(head.replace("`", ""), justify="left" if i < one.text else "right", no_wrap=i == 0)
        for line in one.rows:
            grid.add_row(*(cell.replace("`", "") for cell in line))
        console.print(grid)
    for title, sentences in (("Rational against iterative CORDIC", render.pareto(report)),
                             ("Where CORDIC wins", render.cordic_wins(report))):
        if sentences:
            console.print(f"[bold]{title}[/bold]")
            for sentence in sentences:
                console.print("  " + sentence.replace("`", ""), markup=False, highlight=False)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--arm", default=DEFAULT_ARM, help="name of models/quadrance/arms or path of a TOML file")
    parser.add_argument("--check", action="store_true", help="only check that the committed report is fresh")
    args = parser.parse_args()
    started = time.monotonic()
    if args.check:
        if problems := check():
            raise SystemExit("\n".join(["The committed report no longer follows from the sources:",
                                        *(f"  {problem}" for problem in problems), f"To refresh: {REFRESH}."]))
        print("The committed report follows from the sources.")
        return
    try:
        arms.load(args.arm)
        report, maps = measure(args.arm, cores.all_cores())
        write(report, maps)
    except (arms.ArmError, RuntimeError, ValueError) as error:
        raise SystemExit(f"report: {error}") from None
    show(report)
    where = REPORTS.relative_to(tools.ROOT)
    print(f"Written to {where}/report.json, {where}/report.md and plots in {time.monotonic() - started:.0f} s.")


if __name__ == "__main__":
    main()
