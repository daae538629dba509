"""The pytest side: which benches each core gets (tb/test_cores.py)."""

from __future__ import annotations

import os
import warnings
from collections.abc import Sequence

import numpy as np
import pytest
from quadrance.cores import Core, all_cores

from tb.lib import bulk, stimulus
from tb.lib.simulate import SIMULATORS, available, simulate

SEED = int(os.environ.get("SEED") or 2026)
EXHAUSTIVE_BITS = 16
BULK_SAMPLES = 50_000
BULK_CLOCKS = 1_000_000  # a core of many clocks gets fewer samples; the long run has a million of every core
LONG_SAMPLES = 1_000_000
STALLED, FEW = 8, 2000  # one sample in so many goes through again with idle cycles and stalls, and that many at least


def simulators() -> list[str]:
    """Both simulators, or Verilator alone, and then it says so."""
    usable = [name for name in SIMULATORS if available(name)]
    if "icarus" not in usable:
        warnings.warn("Icarus Verilog is not installed: the benches run on Verilator alone", stacklevel=1)
    return usable


def bulk_samples(core: Core) -> int:
    """Random words of the bulk run of every day."""
    return min(BULK_SAMPLES, BULK_CLOCKS // (core.ii or 1))


def _again(rng: np.random.Generator, result: bulk.Result, few: int) -> np.ndarray:
    """Indices of samples for the run with stalls; half of them have every status alike: flags change often."""
    size = result.latency.size
    pick = rng.integers(0, size, max(size // STALLED, few))
    status = result.outputs.get("out_status", np.zeros(size, int))
    kinds = [np.flatnonzero(status == kind) for kind in np.unique(status)]
    for place in np.flatnonzero(rng.random(pick.size) < 0.5):
        pick[place] = rng.choice(kinds[rng.integers(len(kinds))])
    return pick


def bulk_run(core: Core, samples: int, seed: int, *, built: Core | None = None, label: str = "",
             plusargs: Sequence[str] = ()) -> int:
    """Corners and random words (all words of a narrow input) at every configuration; how many were compared.

    `built` is what is compiled in place of `core`, in folders that bear `label`: the same ports from other sources,
    which may read `plusargs`.
    """
    rng = np.random.default_rng(seed)
    configs = stimulus.configs(core, rng)
    every = stimulus.input_bits(core) <= EXHAUSTIVE_BITS
    few = min(FEW, BULK_CLOCKS // (core.ii or 1) // len(configs))
    total = 0
    for index, cfg in enumerate(configs):
        inputs = stimulus.exhaustive(core) if every else stimulus.uniform(core, rng, samples // len(configs))
        corners = stimulus.corners(core, cfg)
        inputs = {name: np.concatenate([corners[name], words]) for name, words in inputs.items()}
        # every configuration at the full rate, and a part of it with idle cycles and stalls
        result = bulk.stream(built or core, inputs, cfg, label=label, plusargs=plusargs)
        bulk.compare(core, inputs, cfg, result)
        total += result.latency.size
        if not core.clocked:
            continue
        if core.latency is not None:
            bulk.timing(core, result)
        pick = _again(rng, result, few)
        picked = {name: words[pick] for name, words in inputs.items()}
        result = bulk.stream(built or core, picked, cfg, seed=seed + index + 1, label=label, plusargs=plusargs)
        bulk.compare(core, picked, cfg, result)
        if core.ii == core.latency > 1:  # one sample at a time: a stall delays the next one, never the one inside
            bulk.timing(core, result, stalled=True)
        total += result.latency.size
    return total


def _marks(core: Core, simulator: str, usable: list[str]) -> list[pytest.MarkDecorator]:
    """The first parameter set of every core in both simulators; further sets, which have bulk runs, in the long run."""
    if not core.first_set:
        return [pytest.mark.slow]
    return [pytest.mark.full] + [pytest.mark.smoke] * (simulator == usable[0])


def benches():
    """The three tests of every core: cocotb bench in both simulators, bulk run, long bulk run."""
    usable = simulators()
    cores = all_cores()
    ids = [core.id for core in cores]
    smoke = [pytest.param(core, id=core.id, marks=[pytest.mark.smoke] * core.first_set) for core in cores]
    benches = [pytest.param(simulator, core, id=f"{simulator}-{core.id}", marks=_marks(core, simulator, usable))
               for simulator in usable for core in cores]

    @pytest.mark.parametrize(("simulator", "core"), benches)
    def bench(core: Core, simulator: str) -> None:
        simulate(core, simulator, seed=SEED)

    @pytest.mark.full
    @pytest.mark.parametrize("core", smoke)
    def bulk_bench(core: Core) -> None:
        assert bulk_run(core, bulk_samples(core), SEED) > 0

    @pytest.mark.slow
    @pytest.mark.parametrize("core", cores, ids=ids)
    def exhaustive(core: Core) -> None:
        assert bulk_run(core, LONG_SAMPLES, SEED + 1) > 0

    return bench, bulk_bench, exhaustive
