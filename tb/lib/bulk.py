"""Bulk runs: vectors by the hundred thousand through a verilated core, files in and files out."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from quadrance.cores import Core
from quadrance.fixed import Ints, wrap

from tb.lib import tools
from tb.lib.program import build
from tb.lib.stimulus import Vectors

REFUSED = 3  # its exit code where the core made up a result or gives none


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
    AssertionError when a result is made up or does not come.
    """
    program = build(core, label)
    columns = [np.asarray(inputs[port.name], dtype=np.int64) for port in core.inputs]
    count = columns[0].size
    words = np.stack([wrap(column, port.width, signed=False) for column, port in zip(columns, core.inputs)], axis=1)
    values = ",".join(str(int(cfg[port.name]) & (1 << port.width) - 1) for port in core.cfg) if cfg else ""
    with tempfile.TemporaryDirectory(dir=program.parent) as scratch:
        source, target = Path(scratch, "in"), Path(scratch, "out")
        np.ascontiguousarray(words).tofile(source)
        try:
            tools.run(str(program), values, source, target, str(count), str(seed), *plusargs)
        except tools.ToolError as error:
            if error.code == REFUSED:
                raise AssertionError(f"{core.id} {cfg}: {error}") from None
            raise
        table = np.fromfile(target, dtype=np.int64).reshape(count, len(core.outputs) + 2)
    outputs = {port.name: wrap(table[:, i], port.width, port.signed) for i, port in enumerate(core.outputs)}
    return Result(outputs, table[:, -2], table[:, -1])


def compare(core: Core, inputs: Vectors, cfg: dict[str, int], result: Result) -> None:
    """Assert that the RTL equals the bit-true model on every sample; name the first that does not."""
    answer = core.model(core.params, **inputs, **cfg)
    for port in core.outputs:
        wrong = np.flatnonzero(np.broadcast_to(answer[port.name], result.latency.shape) != result.outputs[port.name])
        if wrong.size:
            i = int(wrong[0])
            sample = {name: int(values[i]) for name, values in inputs.items()}
            want = int(np.broadcast_to(answer[port.name], result.latency.shape)[i])
            raise AssertionError(f"{core.id} {cfg} {sample}: {port.name} = {int(result.outputs[port.name][i])}, model "
                                 f"{want} ({wrong.size} of {result.latency.size} samples differ)")


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
