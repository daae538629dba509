"""The figures of the verdict at equal accuracy: who reaches it with which words (`reach`), and what that costs.

A search that still follows from its sources is taken from the committed report, and so is every area and clock. A
search follows from its core (list entry, rule, model), the arm and the rules, and from the code that judges all cores
alike. Where only the latter changed, a new core's function for instance, the errors of the chosen words are worked out
again: where they are what they were, the search stands.
"""

from __future__ import annotations

import functools
import re
import time
from dataclasses import replace
from pathlib import Path

from quadrance import arms, cores
from quadrance.cores import ROOT, Core

from ci import cache, pool, synth
from ci.report import designs, reach, run
from ci.report.designs import Design
from tb.lib import legal, tools

CODE = [Path(reach.__file__)]
FLOWS = ("ecp5", "cyclonev", "cyclonev_nodsp")
_listed = functools.cache(cores.listed)  # one parse for all designs


def judge() -> str:
    """Digest of the code that searches and judges every design alike."""
    return cache.digest([cache.digests(cache.closure(CODE)), tools.versions()["numpy"]])[:16]


def flow() -> str:
    """Digest of how parts are synthesised and placed."""
    used = [tools.versions()[tool] for tool in run.CONCERNS["clock"][2]]
    return cache.digest([cache.digests(run.AREA), used])[:16]


def source(design: Design, arm_name: str) -> str:
    """Digest of what the search of a design follows from, but for `judge`."""
    names = [design.core, *([design.codec] if design.codec else [])]
    models = {ROOT / "models" / "quadrance" / f"{cores.find(name).model_name.split('.')[0]}.py" for name in names}
    entries = [[*entry, designs.rule(name), legal.ranges(cores.find(name))]
               for name in names for entry in _listed((cores.RTL / "cores.toml").read_text()) if entry[3] == name]
    rules = {key: rule for key, rule in designs.RULES.items() if key not in ("price", "metre")}
    if design.metre:
        rules |= design.rules
    judges = cache.closure(CODE)
    own = [path for path in cache.closure(sorted(models)) if path not in judges]
    arm = cache.meaning(arms.path_of(design.arm(arm_name)))
    return cache.digest([entries, cache.digests(own), design.word, arm, rules])[:16]


def named(name: str, params: dict[str, int]) -> str:
    """Id of a part: `reach.at` gives the core of that id."""
    return f"{name}-{cores.label(params)}"


def searched(design: Design, arm_name: str) -> dict:
    """What the report keeps of the search of a design."""
    def compute() -> dict:
        arm = arms.load(design.arm(arm_name))
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
                "picks": picks} | ({"metre": True} if design.metre else {})

    key = source(design, arm_name)
    return cache.cached(["reach", key, judge()], compute) | {"digest": key}


def confirmed(design: Design, arm_name: str, picks: dict) -> dict[str, bool]:
    """Whether every chosen set of words has the error again that the report says of it."""
    def compute() -> dict:
        arm, chosen = arms.load(design.arm(arm_name)), [pick for pick in picks.values() if pick]
        return {"same": all(round(designs.total(design, pick["values"], arm, designs.RULES["samples"]), 6)
                            == pick["total_lsb"] for pick in chosen)}

    return cache.cached(["confirmed", source(design, arm_name), judge(), picks], compute)


def of_id(part: str) -> Core:
    """The core of a part's id."""
    name, _, params = part.partition("-")
    return designs.at(name, cores.find(name).params | {key: int(value)
                                                       for key, value in re.findall(r"([A-Z]+)(\d+)", params)})


def job(what: str, subject: Design | str, arm_name: str) -> object:
    """One job, in a worker process: "reach" of a design or to "confirm" it, "area", "clock" or "circuit" of a part."""
    if what == "reach":
        return searched(subject, arm_name)
    if what == "confirm":
        return confirmed(subject, arm_name, run.committed()["verdict"]["designs"][subject.id]["picks"])["same"]
    core = of_id(subject)
    if what == "circuit":
        return run.circuit(core)
    if what == "clock":
        return synth.core_fmax(core)
    return synth.core_area(core, FLOWS)


def everything() -> list[Design]:
    """All that is searched."""
    return [*designs.plain(), *designs.coded(), *designs.metre()]


def standing(arm_name: str, committed: dict | None) -> dict:
    """The committed verdict as it stands, ``{}`` where there is none: nothing is searched and nothing is left out.

    Cores that are gone go. ``open`` says which designs and parts changed since, or are new: the page names them, and
    `make report-check` fails until `make verdict` has searched them.
    """
    found = (committed or {}).get("verdict")
    if not found:
        return {}
    if found["judge"] != judge() and found["figures"] == digest_of(found):
        found = found | {"designs": _judged_again(found["designs"], arm_name), "judge": judge()}
    known = {design.id for design in everything()}
    designs_left = {one: row for one, row in found["designs"].items() if one in known}
    used = {part for row in designs_left.values() for pick in row["picks"].values() if pick
            for part, _ in pick["parts"]}
    found = found | {"designs": designs_left,
                     "parts": {part: row for part, row in found["parts"].items() if part in used}}
    found["figures"] = found["figures"] if _altered(committed["verdict"]) else digest_of(found)
    return {"verdict": found | {"open": stale({"arm": arm_name, "verdict": found | {"open": []}})}}


def _judged_again(rows: dict[str, dict], arm_name: str) -> dict[str, dict]:
    """Designs whose own sources did not change, judged by the code of today: without a digest where they fail."""
    every = {design.id: design for design in everything()}
    jobs = {("confirm", every[one], arm_name): one for one, row in rows.items()
            if one in every and row["digest"] == source(every[one], arm_name)}
    same = pool.run(job, list(jobs), 0.0, "verdict")
    failed = {one for key, one in jobs.items() if not same[key]}
    return {one: row | {"digest": "judged otherwise"} if one in failed else row for one, row in rows.items()}


def _altered(verdict: dict) -> bool:
    """Whether a figure was changed by hand."""
    return verdict["figures"] != digest_of(verdict)


def _kept(report: dict | None) -> tuple[dict, dict]:
    """Designs, and parts of the same tools and flow, of a committed report that was not changed by hand."""
    verdict = (report or {}).get("verdict")
    if not verdict or _altered(verdict):
        return {}, {}
    designs_kept = verdict["designs"] if verdict["judge"] == judge() else {}
    return designs_kept, verdict["parts"] if verdict["flow"] == flow() else {}


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
    digests = {part: run.synthesis(core) for part, core in made.items()}
    known = run.circuits({part: (row["digest"], row.get("circuit")) for part, row in parts.items()}, digests, job,
                         arm_name, "verdict")
    same = {part for part in made if part in parts and (
        parts[part]["digest"] == digests[part] or part in known and parts[part]["circuit"] == known[part])}
    measured = pool.run(job, [(what, part, arm_name) for what in ("clock", "area", "circuit") for part in made
                              if part not in same and not (what == "circuit" and part in known)], since, "verdict")
    known |= {part: answer for (what, part, _), answer in measured.items() if what == "circuit"}
    for part, core in made.items():
        row = parts[part] if part in same else {"area": measured["area", part, arm_name],
                                                "fmax_mhz": measured["clock", part, arm_name]}
        verdict["parts"][part] = {
            "core": core.name, "params": core.params, "digest": digests[part],
            **({"circuit": known[part]} if part in known else {}), "cycles": core.latency, "ii": core.ii,
            "area": row["area"], "fmax_mhz": row["fmax_mhz"]}
    return verdict | {"judge": judge(), "flow": flow(), "open": [], "figures": digest_of(verdict)}


def differences(old: dict | None, new: dict) -> list[str]:
    """Where a figure of the verdict `new` is not the one of `old`, for what both have."""
    lines = []
    for kind, keys in (("designs", ("picks",)), ("parts", ("area", "fmax_mhz"))):
        before = (old or {}).get(kind, {})
        lines += [f"verdict: {name} {key}: {before[name][key]} -> {row[key]}" for name, row in new[kind].items()
                  for key in keys if name in before and before[name][key] != row[key]]
    return lines


def check(report: dict | None = None) -> list[str]:
    """`stale` of a report, the committed one by default, whose verdict must be there and show what is searched.

    A report that cannot be read is `run.check`'s.
    """
    report = run.committed() if report is None else report
    if not report:
        return []
    if not report.get("verdict"):
        return ["report.json: the verdict at equal accuracy is missing (make verdict)"]
    try:
        problems = stale(report)
        return [f"{one} (make verdict)" for one in problems]
    except (KeyError, TypeError, AttributeError) as error:
        return [f"report.json: verdict: {type(error).__name__}: {error}"]


def stale(report: dict) -> list[str]:
    """Why report["verdict"] no longer follows from the sources."""
    verdict, arm_name = report["verdict"], report["arm"]
    now = {design.id: source(design, arm_name) for design in everything()}
    then = {name: design["digest"] for name, design in verdict["designs"].items()}
    problems = cache.changes(then, now, "verdict:")
    if verdict["judge"] != judge():
        problems.append("verdict: the code that judges every core changed")
    if verdict["flow"] != flow():
        problems.append("verdict: synthesis changed")
    for part, row in verdict["parts"].items():
        core = of_id(part) if row["core"] in {one.name for one in cores.all_cores()} else None
        if core is None or (core.latency, core.ii, run.synthesis(core)) != (row["cycles"], row["ii"],
                                                                                 row["digest"]):
            problems.append(f"verdict: part {part} changed")
    if _altered(verdict):
        problems.append("verdict: a figure was changed by hand")
    if not problems and verdict["open"]:
        problems.append("verdict: the page names designs as changed which are not")
    return problems
