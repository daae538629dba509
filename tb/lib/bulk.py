"""Bulk runs: vectors by the hundred thousand through a verilated core, files in and files out."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from quadrance.cores import Core
from quadrance.fixed import Ints, wrap

from tb.lib import tools
from tb.lib.program import build
from tb.lib.stimulus import Vectors

REFUSED = 3  # its exit code where the core breaks its contract


@dataclass(frozen=True)
class Result:
    """What came out: one int64 array a port, and the cycles of every sample.

    latency : (N,) edges from the accepting one to the first with out_valid high.
    ii : most frequent distance between two accepted samples, None for fewer than two.
    """

    outputs: dict[str, Ints]
    latency: Ints
    accepted: Ints

    @property
    def ii(self) -> int | None:
        steps = np.diff(self.accepted)
        return int(np.bincount(steps).argmax()) if steps.size else None


def stream(core: Core, inputs: Vectors, cfg: dict[str, int] | None = None, *, seed: int = 0,
           label: str = "", plusargs: Sequence[str] = ()) -> Result:
    """Run `inputs` (one array a port) through the RTL at one configuration, from reset.

    `seed` 0 streams back to back with out_ready high; any other draws idle cycles and stalls. `plusargs` are for the
    Verilog ("+name=value").
    AssertionError when a result is made up, changes or falls while it waits, or does not come.
    """
    return _run(core, inputs, cfg, seed, label, plusargs)


def resets(core: Core, first: Vectors, later: Vectors, rounds: np.ndarray, cfg: dict[str, int], *, seed: int,
           label: str = "", plusargs: Sequence[str] = ()) -> Result:
    """Run rounds that each end with a clock of reset; what comes out of the samples that are first in each.

    Parameters
    ----------
    first : the samples behind every reset, all rounds one after the other, as many in each.
    later : the samples that follow them until the reset, in a circle.
    rounds : (N, 2) clock of the reset behind the first offer of a later sample, and flags: see resets() in bulk.cpp.
    """
    few = next(iter(first.values())).size // len(rounds)
    plan = np.concatenate([[[len(rounds), few]], rounds]).astype(np.int64)
    inputs = {name: np.concatenate([words, later[name]]) for name, words in first.items()}
    result = _run(core, inputs, cfg, seed, label, plusargs, plan)
    size = few * len(rounds)
    return Result({name: words[:size] for name, words in result.outputs.items()}, result.latency[:size],
                  result.accepted[:size])


def _run(core: Core, inputs: Vectors, cfg: dict[str, int] | None, seed: int, label: str, plusargs: Sequence[str],
         plan: np.ndarray | None = None) -> Result:
    program = build(core, label)
    columns = [np.asarray(inputs[port.name], dtype=np.int64) for port in core.inputs]
    count = columns[0].size
    words = np.stack([wrap(column, port.width, signed=False) for column, port in zip(columns, core.inputs)], axis=1)
    values = ",".join(str(int(cfg[port.name]) & (1 << port.width) - 1) for port in core.cfg) if cfg else ""
    with tempfile.TemporaryDirectory(dir=program.parent) as scratch:
        source, target, rounds = (Path(scratch, name) for name in ("in", "out", "plan"))
        np.ascontiguousarray(words).tofile(source)
        if plan is not None:
            plan.tofile(rounds)
        try:
            tools.run(str(program), values, source, target, str(count), str(seed), *[rounds] * (plan is not None),
                      *plusargs)
        except tools.ToolError as error:
            if error.code == REFUSED:
                said = str(error).rpartition("bulk: ")[2]
                raise AssertionError(f"{core.id} {cfg}: {said}; stalls of seed {seed}") from None
            raise
        table = np.fromfile(target, dtype=np.int64).reshape(count, len(core.outputs) + 2)
    outputs = {port.name: wrap(table[:, i], port.width, port.signed) for i, port in enumerate(core.outputs)}
    return Result(outputs, table[:, -2], table[:, -1])


def expected(core: Core, inputs: Vectors, cfg: dict[str, int]) -> dict[str, Ints]:
    """The bit-true model's answer to samples that follow a reset: an array a port."""
    size = next(iter(inputs.values())).size
    answer = core.model(core.params, **inputs, **cfg)
    return {port.name: np.broadcast_to(answer[port.name], (size,)) for port in core.outputs}


def compare(core: Core, inputs: Vectors, cfg: dict[str, int], result: Result,
            answer: dict[str, Ints] | None = None, about: Callable[[int], str] = "sample {}".format) -> None:
    """Assert that the RTL equals the bit-true model, or `answer`, on every sample; name the first that does not.

    `about` says in words which sample has an index.
    """
    answer = answer or expected(core, inputs, cfg)
    wrong = {port.name: np.flatnonzero(answer[port.name] != result.outputs[port.name]) for port in core.outputs}
    name, at = min(wrong.items(), key=lambda item: item[1][0] if item[1].size else result.latency.size)
    if at.size:
        i = int(at[0])
        sample = {port: int(words[i]) for port, words in inputs.items()}
        raise AssertionError(f"{core.id} {cfg} {about(i)} {sample}: {name} = {int(result.outputs[name][i])}, model "
                             f"{int(answer[name][i])} ({at.size} of {result.latency.size} samples differ)")


def timing(core: Core, result: Result, stalled: bool = False) -> None:
    """Assert that latency, and interval at the full rate, are those of cores.toml on every sample."""
    late = np.flatnonzero(result.latency != core.latency)
    assert not late.size, f"{core.id}: latency {result.latency[late[0]]} of sample {late[0]}, " \
                          f"cores.toml says {core.latency} ({late.size} samples differ)"
    if stalled:
        return
    steps = np.diff(result.accepted)
    odd = np.flatnonzero(steps != core.ii)
    assert not odd.size, f"{core.id}: sample {odd[0] + 1} accepted {steps[odd[0]]} clocks after the one before it, " \
                         f"cores.toml says {core.ii} ({odd.size} samples differ)"
