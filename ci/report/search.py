"""The figures of the verdict at equal accuracy: who reaches it with which words (`reach`), and what that costs.

A search that still follows from its sources is taken from the committed report, and so is every area and clock.
"""

from __future__ import annotations

import re
import time
from dataclasses import replace
from pathlib import Path

from quadrance import arms, cores
from quadrance.cores import ROOT, Core

from ci import cache, pool, synth
from ci.report import code, designs, freshness, reach
from ci.report.designs import Design
from tb.lib import legal, tools

CODE = [Path(reach.__file__)]
FLOWS = ("cyclonev", "cyclonev_nodsp")


def source(design: Design, arm_name: str) -> str:
    """Digest of all that the search of a design follows from."""
    names = [design.core, *([design.codec] if design.codec else [])]
    models = {ROOT / "models" / "quadrance" / f"{cores.find(name).model_name.split('.')[0]}.py" for name in names}
    entries = [[*entry, designs.rule(name), legal.ranges(cores.find(name))]
               for name in names for entry in cores.listed((cores.RTL / "cores.toml").read_text()) if entry[3] == name]
    rules = {key: rule for key, rule in designs.RULES.items() if key != "price"}
    return cache.digest([entries, code.digests(code.closure([*CODE, *sorted(models)])), design.word,
                         cache.meaning(arms.path_of(arm_name)), rules, tools.versions()["numpy"]])[:16]


def named(name: str, params: dict[str, int]) -> str:
    """Id of a part: `reach.at` gives the core of that id."""
    return f"{name}-{''.join(f'{key}{value}' for key, value in params.items())}"


def searched(design: Design, arm_name: str) -> dict:
    """What the report keeps of the search of a design."""
    def compute() -> dict:
        arm = arms.load(arm_name)
        if design.codec:
            alone = searched(replace(design, codec=None, word=designs.word_type(cores.find(design.core))), arm_name)
            sets = [pick["values"] for pick in alone["picks"].values() if pick]
            found = reach.outside(design, [one for i, one in enumerate(sets) if one not in sets[:i]], arm)
        else:
            found = reach.search(design, arm)
        core = cores.find(design.core)
        copies = (1, designs.JOINTS[core.function])
        picks = {}
        for target, pick in found["picks"].items():
            if pick is None:
                picks[target] = None
                continue
            made = designs.parts(design, pick[0])
            seen = designs.seen(design, *(*made, None)[:2])
            picks[target] = {
                "values": pick[0], "total_lsb": round(pick[1], 6), "bits": designs.joint_ports(seen)[0][0].width,
                "parts": [[named(one.name, one.params), count] for one, count in zip(made, copies)]}
        return {"core": core.name, "codec": design.codec, "family": core.family, "function": core.function,
                "architecture": core.architecture, "word": design.word, "best_lsb": round(found["best"], 6),
                "picks": picks}

    key = source(design, arm_name)
    return cache.cached(["reach", key], compute) | {"digest": key}


def of_id(part: str) -> Core:
    """The core of a part's id."""
    name, _, params = part.partition("-")
    return designs.at(name, {key: int(value) for key, value in re.findall(r"([A-Z]+)(\d+)", params)})


def job(what: str, subject: Design | str, arm_name: str) -> object:
    """One measurement, in a worker process: "reach" of a design, "area" or "clock" of a part."""
    if what == "reach":
        return searched(subject, arm_name)
    core = of_id(subject)
    if what == "clock":
        return synth.core_fmax(core)
    with_dsp, without = FLOWS
    area = synth.area(with_dsp, core.name, core.params, core.sources)
    return {with_dsp: area,  # a core without a product is not synthesised twice
            without: synth.area(without, core.name, core.params, core.sources) if area["dsp"] else area}


def everything() -> list[Design]:
    """All that is searched."""
    return [*designs.plain(), *designs.coded()]


def standing(arm_name: str, committed: dict | None) -> dict:
    """The committed verdict: as ``verdict`` where all of it stands, else as ``earlier_verdict``, which is not shown.

    A part of it would name winners among those that happen to stand.
    """
    found = (committed or {}).get("verdict") or (committed or {}).get("earlier_verdict")
    if not found:
        return {}
    return {"earlier_verdict" if stale({"arm": arm_name, "verdict": found}) else "verdict": found}


def _kept(report: dict | None) -> tuple[dict, dict]:
    """Designs, and parts of the same tools and flow, of a committed report that was not changed by hand."""
    verdict = (report or {}).get("verdict") or (report or {}).get("earlier_verdict") or {}
    if not verdict or verdict["figures"] != digest_of(verdict):
        return {}, {}
    same = report["sources"]["flow"] == code.digests(freshness.FLOW) and all(
        report["tools"].get(tool) == tools.versions()[tool] for tool in freshness.CONCERNS["synthesis"][1])
    return verdict["designs"], verdict["parts"] if same else {}


def digest_of(verdict: dict) -> str:
    """Digest of the figures: one that was changed by hand is found."""
    return cache.digest([verdict["designs"], verdict["parts"]])


def put_together(arm_name: str, committed: dict | None, fresh: bool = False) -> dict:
    """report["verdict"]: ``designs`` and ``parts`` by id, measured where the committed report does not have them."""
    since = time.time() if fresh else 0.0
    old, parts = _kept(None if fresh else committed)
    every = everything()
    kept = {one: old[one.id] for one in every if old.get(one.id, {}).get("digest") == source(one, arm_name)}
    found: dict = {}
    for coded in (False, True):  # a core with codecs has the words of the core alone
        found |= pool.run(job, [("reach", one, arm_name) for one in every
                                if one not in kept and bool(one.codec) == coded], since, "verdict")
    verdict: dict = {"designs": {one.id: kept.get(one) or found["reach", one, arm_name] for one in every}, "parts": {}}
    made = {part: of_id(part) for design in verdict["designs"].values() for pick in design["picks"].values() if pick
            for part, _ in pick["parts"]}
    digests = {part: freshness.synthesis(core) for part, core in made.items()}
    parts = {part: row for part, row in parts.items() if row["digest"] == digests.get(part)}
    measured = {(what, part, arm_name): parts[part][key] for part in parts for what, key in (
        ("area", "area"), ("clock", "fmax_mhz"))}
    measured |= pool.run(job, [(what, part, arm_name) for what in ("clock", "area") for part in made
                               if measured.get((what, part, arm_name)) is None], since, "verdict")
    for part, core in made.items():
        verdict["parts"][part] = {
            "core": core.name, "params": core.params, "digest": digests[part], "cycles": core.latency, "ii": core.ii,
            "area": measured["area", part, arm_name], "fmax_mhz": measured["clock", part, arm_name]}
    return verdict | {"figures": digest_of(verdict)}


def differences(old: dict | None, new: dict) -> list[str]:
    """Where a figure of the verdict `new` is not the one of `old`, for what both have."""
    lines = []
    for kind, keys in (("designs", ("picks",)), ("parts", ("area", "fmax_mhz"))):
        before = (old or {}).get(kind, {})
        lines += [f"verdict: {name} {key}: {before[name][key]} -> {row[key]}" for name, row in new[kind].items()
                  for key in keys if name in before and before[name][key] != row[key]]
    return lines


def check(report: dict | None = None) -> list[str]:
    """`stale` of a report, the committed one by default, or nothing where it shows no verdict.

    A report that cannot be read is `freshness.check`'s.
    """
    report = freshness.committed() if report is None else report
    if not report:
        return []
    try:
        return stale(report) if "verdict" in report else []
    except (KeyError, TypeError, AttributeError) as error:
        return [f"report.json: verdict: {type(error).__name__}: {error}"]


def stale(report: dict) -> list[str]:
    """Why report["verdict"] no longer follows from the sources."""
    verdict, arm_name = report["verdict"], report["arm"]
    now = {design.id: source(design, arm_name) for design in everything()}
    then = {name: design["digest"] for name, design in verdict["designs"].items()}
    problems = freshness.changes(then, now, "verdict:")
    for part, row in verdict["parts"].items():
        core = of_id(part) if row["core"] in {one.name for one in cores.all_cores()} else None
        if core is None or (core.latency, core.ii, freshness.synthesis(core)) != (row["cycles"], row["ii"],
                                                                                 row["digest"]):
            problems.append(f"verdict: part {part} changed")
    if verdict["figures"] != digest_of(verdict):
        problems.append("verdict: a figure was changed by hand")
    return problems
