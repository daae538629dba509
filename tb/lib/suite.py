"""The bulk runs of a core: every corner and random words, with stalls and with resets."""

from __future__ import annotations

import os
import warnings
from collections.abc import Sequence

import numpy as np
from quadrance.cores import Core

from tb.lib import bulk, stimulus
from tb.lib.simulate import SIMULATORS, available

SEED = int(os.environ.get("SEED") or 2026)
EXHAUSTIVE_BITS = 16
BULK_SAMPLES = 50_000
BULK_CLOCKS = 1_000_000  # a core of many clocks gets fewer samples; the long run has a million of every core
LONG_SAMPLES = 1_000_000
STALLED, FEW = 8, 2000  # one sample in so many goes through again with idle cycles and stalls, and that many at least
RESETS = 300  # at most, and each at another clock of a sample: at every clock of all but the longest
ROUNDS = 120  # at least, where a sample is short
VARYING = 1000  # clocks of a sample that meet a reset, where their number varies
MEMORY = 6  # samples looked at behind a reset: more than any core takes to answer from what it holds
CONFIGS = 4  # beside the first one that meet resets; fewer of a core of many clocks
IN_ORDER = 128  # samples
STARTS, FEWER = 16, 6  # different ones, for each is a run of the model; fewer where a sample takes many iterations


def simulators() -> list[str]:
    """Both simulators, or Verilator alone, and then it says so."""
    usable = [name for name in SIMULATORS if available(name)]
    if "icarus" not in usable:
        warnings.warn("Icarus Verilog is not installed: the benches run on Verilator alone", stacklevel=1)
    return usable


def bulk_samples(core: Core) -> int:
    """Random words of the bulk run of every day."""
    return min(BULK_SAMPLES, BULK_CLOCKS // (core.ii or 1))


def _again(core: Core, rng: np.random.Generator, result: bulk.Result, few: int) -> np.ndarray:
    """Indices of samples for the run with stalls; half of them have every status alike: flags change often.

    Where samples may build on each other, some as they follow each other as well: what a stall loses is seen later.
    """
    size = result.latency.size
    pick = rng.integers(0, size, max(size // STALLED, few))
    status = result.outputs.get("out_status", np.zeros(size, int))
    kinds = [np.flatnonzero(status == kind) for kind in np.unique(status)]
    kind = np.where(rng.random(pick.size) < 0.5, rng.integers(0, len(kinds), pick.size), -1)
    for index, alike in enumerate(kinds):
        pick[kind == index] = rng.choice(alike, np.count_nonzero(kind == index))
    if core.latency is None:
        runs = rng.integers(0, max(size - IN_ORDER, 1), (2, 1)) + np.arange(min(IN_ORDER, size))
        pick = np.concatenate([pick, runs.ravel()])
    return pick


def _rounds(core: Core, rng: np.random.Generator) -> np.ndarray:
    """Clocks and flags of resets as `bulk.resets` takes them, in any order: at each clock of a sample, from the one
    that would accept it to two behind its result, with and without a word at the input and a result that waits.
    """
    span = (core.latency or VARYING) + 3
    clocks = np.arange(span) if span <= RESETS else rng.choice(span, RESETS, replace=False)
    clocks = np.tile(clocks, -(-ROUNDS // clocks.size))
    flags = rng.integers(0, 4, clocks.size) + 4 * (rng.random(clocks.size) < 0.25)
    idle = [[0, 1]] * 4  # a word offered to the idle core
    return rng.permutation(np.concatenate([np.stack([clocks, flags], axis=1), idle]))


def _starts(core: Core, cfg: dict[str, int], corners: stimulus.Vectors, rng: np.random.Generator) -> np.ndarray:
    """(starts, MEMORY) corners to follow a reset: the first one and half of the others without a direction, where
    there are such, so that they show what is held. Where samples build on each other, half of the starts are in order.
    """
    size = next(iter(corners.values())).size
    picks = rng.integers(0, size, (STARTS if core.latency else FEWER, MEMORY))
    if core.status and "singular" in core.status:
        none = np.flatnonzero(bulk.expected(core, corners, cfg)["out_status"] & 2)
        if none.size:
            held = rng.random(picks.shape) < 0.5
            held[:, 0] = True
            picks = np.where(held, rng.choice(none, picks.shape), picks)
    if core.latency is None:
        picks[::2] = np.minimum(picks[::2, :1] + np.arange(MEMORY), size - 1)
    return picks


def reset_run(core: Core, cfg: dict[str, int], seed: int, built: Core | None = None, **options) -> int:
    """Resets at every clock of a sample, each followed by samples that must answer as those of a core just started."""
    rng = np.random.default_rng(seed)
    rounds, corners = _rounds(core, rng), stimulus.corners(core, cfg)
    starts = [{name: words[pick] for name, words in corners.items()} for pick in _starts(core, cfg, corners, rng)]
    answers = [bulk.expected(core, start, cfg) for start in starts]
    which = rng.integers(0, len(starts), len(rounds))

    def follow(parts: list[stimulus.Vectors]) -> stimulus.Vectors:
        return {name: np.concatenate([parts[i][name] for i in which]) for name in parts[0]}

    later = {name: words[:400] for name, words in corners.items()}  # in order: they may build on each other
    if core.latency is not None:
        later = stimulus.joined(stimulus.uniform(core, rng, 200), later)
        order = rng.permutation(next(iter(later.values())).size)
        later = {name: words[order] for name, words in later.items()}

    def about(i: int) -> str:
        clock, flags = rounds[i // MEMORY - 1]
        return (f"sample {i % MEMORY + 1} behind reset {i // MEMORY} (at clock {clock} of a sample, flags {flags})" if
                i >= MEMORY else f"sample {i + 1} of the run")

    result = bulk.resets(built or core, follow(starts), later, rounds, cfg, seed=seed, **options)
    bulk.compare(core, follow(starts), cfg, result, follow(answers), about)
    return result.latency.size


def bulk_run(core: Core, samples: int, seed: int, *, built: Core | None = None, label: str = "",
             plusargs: Sequence[str] = ()) -> int:
    """Corners and random words (all words of a narrow input) at every configuration; how many were compared.

    `built` is what is compiled in place of `core`, in folders that bear `label`: the same ports from other sources,
    which may read `plusargs`. AssertionError, with the seed, where they differ or the core breaks its contract.
    """
    try:
        return _bulk_run(core, samples, seed, built or core, {"label": label, "plusargs": plusargs})
    except AssertionError as error:
        raise AssertionError(f"{error} [seed {seed} of the bulk run]") from None


def _bulk_run(core: Core, samples: int, seed: int, built: Core, options: dict) -> int:
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
        result = bulk.stream(built, inputs, cfg, **options)
        bulk.compare(core, inputs, cfg, result)
        total += result.latency.size
        if not core.clocked:
            continue
        if core.latency is not None:
            bulk.timing(core, result)
        pick = _again(core, rng, result, few)
        picked = {name: words[pick] for name, words in inputs.items()}
        result = bulk.stream(built, picked, cfg, seed=seed + index + 1, **options)
        bulk.compare(core, picked, cfg, result)
        if core.ii == core.latency > 1:  # one sample at a time: a stall delays the next one, never the one inside
            bulk.timing(core, result, stalled=True)
        total += result.latency.size
    if core.clocked:
        some = max(1, min(CONFIGS, BULK_CLOCKS // (RESETS * MEMORY * (core.ii or 1))))
        for cfg in [configs[0], *rng.permutation(configs[1:])[:some]]:
            total += reset_run(core, cfg, seed, built, **options)
    return total
