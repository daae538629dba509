"""`make cover`: every core at further parameters: listed sets, ends of ranges, their neighbours, switches, arms.

    python -m ci.cover                 the sets whose verdict no longer follows from their sources
    python -m ci.cover --core arm_ik3  those of one core
    python -m ci.cover --fresh         all of them again
    python -m ci.cover --check         fails on a verdict that is missing or stale, and runs 20 sets drawn by the commit

`tb/lib/legal.py` makes the list. A set passes where Verilator has no warning of it, and the core equals its bit-true
model at the full rate and under stalls, on every corner and some 500 random words, with the latency and the interval
of rtl/cores.toml. A set of rtl/cores.toml that `make test` leaves out gets the whole bulk run. The first set of a
further PIPE or of a core without a clock gets the cocotb bench, and so does that of a core of long samples, of whose
bench `make test` runs the resets alone.
reports/cover.json holds the digest of what each verdict follows from: sources, model, samples, harness and tools, but
no comment. It is written as the run goes: one that is cut goes on where it stopped.
"""

from __future__ import annotations

import argparse
import inspect
import json
import logging
import os
import shutil
import sys
import traceback
from collections import Counter
from collections.abc import Iterable
from concurrent.futures import ProcessPoolExecutor, as_completed
from importlib import metadata
from pathlib import Path

import numpy as np
from quadrance.cores import Core, all_cores, at

from ci import cache as store
from tb.lib import bulk, legal, program, stimulus, suite, tools
from tb.lib.simulate import BenchFailed, incomplete, kept, simulate

STORE = tools.ROOT / "reports" / "cover.json"
HARNESS = ("tb/lib/bulk.py", "tb/lib/bulk.cpp", "tb/lib/program.py", "tb/lib/stimulus.py")  # and `run`
ASKED = ("configs", "draw", "corners")  # what tb/lib/stimulus.py asks of the samples of a family
LIST = {"models/quadrance/cores.py", "tb/lib/tools.py"}  # read lists and start tools: no verdict follows from them
TOOLS = ("verilator", "numpy")
SUITE = tools.ROOT / "tb/lib/suite.py"
LABEL = "-cover"
CONFIGS = 3  # of those of the bulk run, others for every set
SAMPLES, CLOCKS = 500, 200_000  # random words of a set, fewer of a core of many clocks
DRAWN = 20

Verdicts = dict[str, dict[str, str]]  # core -> set -> digest


def cores() -> list[Core]:
    """Every core that has parameters, at its first set."""
    return [core for core in all_cores() if core.first_set and core.params]


def run(core: Core) -> None:
    """One set through the simulator; AssertionError that says what is wrong with it."""
    said = legal.verdict(core, core.params)
    assert not said, f"{core.id}: the rule accepts it, Verilator does not: {said}"
    seed = int(store.digest(core.id)[:8], 16)
    rng = np.random.default_rng(seed)
    configs = stimulus.configs(core, rng)
    chosen = [configs[(seed + i * len(configs) // CONFIGS) % len(configs)] for i in range(min(CONFIGS, len(configs)))]
    words = min(SAMPLES, CLOCKS // (core.ii or 1)) // len(chosen) + 1
    folder = program.build(core, LABEL).parent
    try:
        for index, cfg in enumerate(chosen):
            inputs = stimulus.joined(stimulus.corners(core, cfg), stimulus.uniform(core, rng, words))
            for port in (port for port in core.cfg if not port.low <= cfg[port.name] <= port.high):
                raise AssertionError(f"{core.id}: {port.name} = {cfg[port.name]} does not fit its {port.width} bits")
            for stalls in (0, seed + index + 1) if core.clocked else (0,):
                result = bulk.stream(core, inputs, cfg, seed=stalls, label=LABEL)
                bulk.compare(core, inputs, cfg, result)
                if core.clocked and core.latency is not None and (not stalls or core.ii == core.latency > 1):
                    bulk.timing(core, result, stalled=bool(stalls))
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def listed(name: str) -> dict[str, Core]:
    """The sets of rtl/cores.toml of which `make test` has no bulk run, or not the whole bench."""
    return {core.set_id: core for core in all_cores() if core.name == name and _longer(core)}


def _longer(core: Core) -> bool:
    return not legal.daily(core) or kept(core)


def _whole(core: Core) -> None:
    """Of one listed set the bulk run, where `make test` has none, and of the first one of a PIPE the bench."""
    if not legal.daily(core):
        seed, folder = int(store.digest(core.id)[:8], 16), program.build(core, LABEL).parent
        try:
            suite.bulk_run(core, suite.bulk_samples(core), seed, label=LABEL)
        finally:
            shutil.rmtree(folder, ignore_errors=True)
    if core.first_set:
        logging.disable(logging.INFO)  # what fails is in the verdict
        try:
            shutil.rmtree(simulate(core, suite.simulators()[0], seed=suite.SEED, label=LABEL), ignore_errors=True)
        finally:
            logging.disable(logging.NOTSET)


def verdict(name: str, label: str, params: legal.Params) -> str:
    """Nothing where core `name` passes at the set of that label and these parameters, else the reason."""
    own = listed(name).get(label)
    program.BENCH = own is not None  # a long run is worth the compiler's optimisation
    try:
        if own:
            _whole(own)
        else:
            run(at(_core(name), params))
    except (AssertionError, BenchFailed) as error:
        return str(error)
    except Exception as error:  # a model or stimulus that cannot take these parameters has failed them too
        where = traceback.extract_tb(error.__traceback__)[-1]
        return f"{type(error).__name__}: {error} ({Path(where.filename).name}:{where.lineno})"
    return ""


def _core(name: str) -> Core:
    return next(core for core in cores() if core.name == name)


def python(core: Core) -> dict[tuple[Path, str], str]:
    """Texts of what model, samples and harness of a core use of Python, by file and name: functions, constants."""
    family, *more = store.stimulus(core)
    model, leave = sys.modules[core.model.__module__], {tools.ROOT / name for name in LIST}
    starts = [(Path(model.__file__), core.model.__name__)]
    starts += [(tools.ROOT / name, None) for name in HARNESS if name.endswith(".py")]
    if "MODELS" in store.source(family).named:  # an engine: the file of its model alone
        starts += [(path, None) for path in more]
        leave.add(family)
    else:
        starts += [(family, name) for name in ASKED if name in store.source(family).named]
    return store.reached(starts, leave)


def _follows(core: Core) -> str:
    """Digest of all that the verdicts of a core follow from, but the parameters."""
    files = [*core.sources, *(tools.ROOT / name for name in HARNESS), store.stimulus(core)[0]]
    found = {(str(path.relative_to(tools.ROOT)), name): text for (path, name), text in python(core).items()}
    texts = sorted({store.meaning(path) for path in files}), sorted([*one, text] for one, text in found.items())
    ports = [list(map(str, (port.name, port.width, port.signed, port.type)))
             for port in (*core.cfg, *core.inputs, *core.outputs)]
    return store.digest([texts, ports, core.model_name, store.bare(inspect.getsource(run), ".py"), CONFIGS, SAMPLES,
                         CLOCKS, [metadata.version(name) for name in TOOLS]])


def wanted(chosen: Iterable[Core]) -> dict[tuple[str, str], tuple[legal.Params, str]]:
    """(core, set) -> its parameters, and the digest of a verdict that follows from the sources as they are."""
    found = {}
    for core in chosen:
        follows = _follows(core)
        for params in legal.cover(core):
            one = at(core, params)
            found[core.name, one.set_id] = params, store.digest([follows, params, one.latency, one.ii])[:12]
        for one in legal.sets(core):
            if _longer(one):
                parts = [follows, one.params, one.latency, one.ii, store.meaning(SUITE),
                         *(store.of_cocotb() if one.first_set else ())]
                found[core.name, one.set_id] = one.params, store.digest(parts)[:12]
    return found


def standing() -> Verdicts:
    """The verdicts as committed."""
    return json.loads(STORE.read_text()) if STORE.exists() else {}


def keep(verdicts: Verdicts) -> None:
    """Write the verdicts, a core a line; the file appears whole or not at all."""
    lines = [f"{json.dumps(name)}: {json.dumps(dict(sorted(sets.items())))}" for name, sets in verdicts.items() if sets]
    partial = STORE.with_suffix(".partial")
    partial.write_text("{\n" + ",\n".join(lines) + "\n}\n")
    partial.replace(STORE)


def check(sets: dict[tuple[str, str], tuple[legal.Params, str]]) -> list[str]:
    """What is wrong with the committed verdicts: missing, stale, of a set that is none, or not what a run gives."""
    asked = {name for name, _ in sets}
    known = {(name, label): digest for name, rows in standing().items() if name in asked
             for label, digest in rows.items()}
    missing = Counter(name for (name, label), (_, digest) in sets.items() if known.get((name, label)) != digest)
    surplus = Counter(name for name, label in known if (name, label) not in sets)
    wrong = [f"{name}: {count} sets have no verdict that follows from the sources (make cover CORE={name})"
             for name, count in missing.items()]
    wrong += [f"{name}: {count} verdicts are of no set of its list (make cover CORE={name})"
              for name, count in surplus.items()]
    if wrong:
        return wrong
    rng = np.random.default_rng(int(store.digest(store.commit() or STORE.read_text())[:8], 16))
    names = sorted(sets)
    drawn = [names[i] for i in rng.permutation(len(names))[:DRAWN]]
    with ProcessPoolExecutor(os.cpu_count()) as pool:
        said = pool.map(verdict, *zip(*drawn), [sets[one][0] for one in drawn])
        return [f"{name}-{label}: {text}" for (name, label), text in zip(drawn, said) if text]


def cover(sets: dict[tuple[str, str], tuple[legal.Params, str]], every: bool) -> list[str]:
    """Run what does not stand, write what passes as it does; what failed."""
    verdicts = standing()
    for name in {name for name, _ in sets}:  # what is stale or no set of the list any more goes
        verdicts[name] = {label: digest for label, digest in verdicts.get(name, {}).items()
                          if not every and sets.get((name, label), ({}, ""))[1] == digest}
    verdicts = {core.name: verdicts.get(core.name, {}) for core in cores()}
    place = {one: at for name in verdicts for at, one in enumerate(one for one in sets if one[0] == name)}
    jobs = sorted((one for one in sets if one[1] not in verdicts[one[0]]), key=place.get)  # the ends of ranges first
    print(f"{len(sets) - len(jobs)} of {len(sets)} sets stand from before (FRESH=1 runs them again)", flush=True)
    wrong = []
    with ProcessPoolExecutor(os.cpu_count()) as pool:
        asked = {pool.submit(verdict, name, label, sets[name, label][0]): (name, label) for name, label in jobs}
        try:
            for count, job in enumerate(as_completed(asked), 1):
                (name, label), said = asked[job], job.result()
                if said:
                    wrong.append(f"{name}-{label}: {said}")
                    print(wrong[-1], flush=True)
                else:
                    verdicts[name][label] = sets[name, label][1]
                    keep(verdicts)
                if count % 50 == 0:
                    print(f"{count} of {len(jobs)}", flush=True)
        except KeyboardInterrupt:
            pool.shutdown(cancel_futures=True)
            raise SystemExit("cut: what passed is kept") from None
    return wrong


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--core", help="the sets of this core alone")
    parser.add_argument("--fresh", action="store_true", help="run what passed before with the same sources, too")
    parser.add_argument("--check", action="store_true", help="only say whether the verdicts stand, and draw some")
    args = parser.parse_args()
    try:
        chosen = [core for core in cores() if args.core in (None, core.name)]
    except ValueError as error:
        raise SystemExit(f"cover: {error}") from None
    if not chosen:
        raise SystemExit(f"cover: no core '{args.core}' with parameters in rtl/cores.toml")
    if wrong := [line for core in chosen if (line := incomplete(core))]:
        raise SystemExit("\n".join(wrong))
    sets = wanted(chosen)
    wrong = check(sets) if args.check else cover(sets, args.fresh)
    print("\n".join([*(wrong if args.check else ()), f"cover: {len(sets)} sets, {len(wrong)} of them wrong"]))
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
