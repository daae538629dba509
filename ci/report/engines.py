"""Engines that iterate, in the report: what a pass costs, how many clocks they take, and the closed form beside them.

`convergence.ENTRIES` is the list; report["engines"] has what models and Verilog say, with digests of the sources.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from quadrance.cores import STATUS_BITS, Core
from quadrance.iterative import convergence

from ci import cache
from ci.cache import digest
from ci.report import code
from ci.report.tables import Row, Table, leading, number
from tb.lib import bulk, program, tools

MODELS = [Path(convergence.__file__)]
NOT_CONVERGED = 1 << STATUS_BITS["not_converged"]
MHZ = 50
HEAD = ("task", "core", "LUT", "MULT18X18", "EBR", "MHz", "cycles an iteration", "iterations", "cycles: median", "95 %",
        "max", f"us at {MHZ} MHz: median", "95 %", "max", "converged, %")
NOTE = f"""\
Iterations are those of the bit-true models, cycles are measured on the Verilog, over a grid of starts: joints 1 and 2
all round in steps of {convergence.STEP}° (twice that where the model takes long), others at 0; one target, the
examples of the papers; of the starts that converge within {convergence.LIMIT} iterations. Cycles have every pass: the
iterations, the one that finds the answer, and those that only change the range of a word. Under each engine stand the
cores that answer the same in one pass, which need no start. Area, and the clock in MHz, are those of the tables above;
the times are at {MHZ} MHz."""


def found(core: Core) -> dict:
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

    key = ["engines", _source(core), [word.tolist() for word in inputs.values()], cfg, code.digests(MODELS)]
    return {"task": entry.task, "closed": list(entry.closed), "pass": entry.clocks} | cache.cached(key, compute)


def put_together(listed: tuple[Core, ...]) -> dict:
    """report["engines"]: what every listed engine takes, by the name of the core at its first parameter set."""
    rows = {core.name: found(core) for core in chosen(listed)}
    return {"rows": rows, "sources": sources(listed), "figures": digest(rows)}


def chosen(listed: tuple[Core, ...]) -> list[Core]:
    """The listed engines at their first parameter sets."""
    return [core for core in listed if core.first_set and core.name in convergence.ENTRIES]


def _source(core: Core) -> str:
    texts = cache.meanings((*core.sources, *program.SOURCES))
    return digest([core.name, core.params, texts, tools.versions()["verilator"]])[:16]


def sources(listed: tuple[Core, ...]) -> dict[str, str]:
    """What the figures follow from: the code of starts and models, and the Verilog of the engines."""
    return code.digests(code.closure(MODELS)) | {core.name: _source(core) for core in chosen(listed)}


def check(report: dict | None, listed: tuple[Core, ...]) -> list[str]:
    """Why the table of a report no longer follows from the sources; nothing where there is none yet."""
    made = (report or {}).get("engines")
    if not made:
        return []
    then, now = made["sources"], sources(listed)
    problems = [f"engines: {key} changed" for key in sorted(then.keys() | now) if then.get(key) != now.get(key)]
    return problems + ["engines: a figure was changed by hand"] * (made["figures"] != digest(made["rows"]))


def table(report: dict) -> Table:
    """An engine a line, and below it the cores that answer in one pass; engines without a synthesis are left out."""
    costs = {row["core"]: row for row in leading(report["cores"])}
    lines = []
    for core, found in report.get("engines", {"rows": {}})["rows"].items():
        if core not in costs:
            continue
        share = 100 * found["converged"] / found["starts"]
        lines.append((found["task"], *_cost(costs[core]), str(found["pass"]), str(found["iterations"][0]),
                      *_times(found["cycles"]), number(share)))
        for row in (costs[name] for name in found["closed"] if name in costs):
            lines.append(("in one pass", *_cost(row), "–", "–", *_times([row["latency_cycles"]] * 3), "100"))
    return Table("Engines that iterate, and the closed form, on ECP5", HEAD, tuple(lines), text=2)


def _cost(row: Row) -> tuple[str, ...]:
    area = row["area"]["ecp5"]
    return f"`{row['core']}`", *(str(area[key]) for key in ("lut", "dsp", "mem")), number(row["fmax_mhz"]["ecp5"])


def _times(cycles: list[int]) -> tuple[str, ...]:
    return (*map(str, cycles), *(number(clocks / MHZ) for clocks in cycles))


def section(report: dict) -> list[str]:
    """The section of report.md; empty where no engine has figures yet."""
    made = table(report)
    return [f"## {made.title}", NOTE, made.markdown()] if made.rows else []
