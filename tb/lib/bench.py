"""The cocotb bench of every core: the same promises, so the same tests, fed by the core's own corners.

Runs inside the simulator; `tb.lib.simulate` starts it and hands the core over in QUADRANCE_CORE.
"""

from __future__ import annotations

import itertools
import os
import pickle
import random

import cocotb
import numpy as np
from cocotb.clock import Clock
from cocotb.triggers import RisingEdge, Timer
from quadrance.cores import Core

from tb.lib import stimulus
from tb.lib.stream import Bench, Scoreboard, bit, read, to_word

with open(os.environ["QUADRANCE_CORE"], "rb") as _file:
    CORE: Core = pickle.load(_file)

CLOCKED = CORE.clocked
FIXED = CLOCKED and CORE.latency is not None


def _rng() -> np.random.Generator:
    return np.random.default_rng(random.getrandbits(32))


def _cut(vectors: stimulus.Vectors, count: int) -> stimulus.Vectors:
    """At most `count` samples, evenly over all of them."""
    size = len(next(iter(vectors.values())))
    pick = np.unique(np.linspace(0, size - 1, min(size, count)).astype(int))
    return {name: values[pick] for name, values in vectors.items()}


def _chance(probability: float):
    return iter(lambda: random.random() < probability, None)


async def _fresh(dut) -> Bench:
    Clock(dut.clk, 10, unit="ns", impl="gpi").start(start_high=False)  # after the first values are written
    bench = Bench(dut, CORE)
    bench.configure(stimulus.configs(CORE, _rng())[0])
    bench.start()
    await bench.reset()
    return bench


@cocotb.test(skip=CLOCKED)
async def corners_and_random_combinational(dut):
    """A combinational primitive equals its model on corners and random words."""
    rng = _rng()
    for cfg in stimulus.configs(CORE, rng):
        board = Scoreboard(CORE)
        for port in CORE.cfg:
            getattr(dut, port.name).value = to_word(port, cfg[port.name])
        for vectors in (stimulus.corners(CORE, cfg), stimulus.uniform(CORE, rng, 500)):
            for row in zip(*(vectors[port.name].tolist() for port in CORE.inputs)):
                for port, value in zip(CORE.inputs, row):
                    getattr(dut, port.name).value = to_word(port, value)
                await Timer(1, "ns")
                board.accepted.append((*(cfg[port.name] for port in CORE.cfg), *row))
                board.results.append(tuple(read(getattr(dut, port.name), port) for port in CORE.outputs))
        board.check()


@cocotb.test(skip=not CLOCKED)
async def corners_back_to_back(dut):
    """Corners at every configuration, without a gap and without a reset between."""
    bench = await _fresh(dut)
    for cfg in stimulus.configs(CORE, _rng()):
        bench.configure(cfg)
        await bench.send(_cut(stimulus.corners(CORE, cfg), 120))  # the bulk run takes all of them
        await bench.drain()


@cocotb.test(skip=not CLOCKED)
async def idle_and_back_pressure(dut):
    """Random samples under every pair of input gaps and output stalls."""
    bench = await _fresh(dut)
    gaps = {"none": lambda: 0, "random": lambda: random.choice((0, 0, 1, 3)),
            "burst": lambda: 0 if random.random() < 0.8 else 2 * (CORE.latency or 8)}
    stalls = {"none": lambda: _chance(0.0), "half": lambda: _chance(0.5), "most": lambda: _chance(0.9),
              "burst": lambda: itertools.cycle([True] * (2 * (CORE.latency or 8) + 3) + [False] * 5)}
    rng = _rng()
    for cfg, (gap, stall) in zip(itertools.cycle(stimulus.configs(CORE, rng)),
                                 itertools.product(gaps.values(), stalls.values())):
        bench.configure(cfg)
        bench.pressure = stall()
        await bench.send(stimulus.uniform(CORE, rng, 24), gap)
        await bench.drain()


@cocotb.test(skip=not CLOCKED)
async def stalled_output_loses_nothing(dut):
    """With out_ready low for ever the core stops taking samples and keeps every one it took."""
    bench = await _fresh(dut)
    bench.pressure = _chance(1.0)
    sender = cocotb.start_soon(bench.send(stimulus.uniform(CORE, _rng(), 4 * (CORE.latency or 8) + 8)))
    for _ in range(12 * (CORE.latency or 8) + 20):
        await RisingEdge(dut.clk)
    assert not bench.board.results, "a result was taken although out_ready was low"
    assert bench.board.accepted, "nothing was accepted"
    assert bit(dut.out_valid), "out_valid waits for out_ready"
    assert not sender.done(), "a core without room accepted every sample"
    bench.pressure = _chance(0.0)
    await sender
    await bench.drain()


@cocotb.test(skip=not CLOCKED)
async def reset_in_flight(dut):
    """A reset at any moment drops what is in flight and nothing that comes after it."""
    bench = await _fresh(dut)
    rng = _rng()
    corner = _cut(stimulus.corners(CORE, bench.cfg), 6)
    for _ in range(12):
        bench.pressure = _chance(random.choice((0.0, 0.7)))
        sender = cocotb.start_soon(bench.send(stimulus.uniform(CORE, rng, 20)))
        for _ in range(random.randrange(1, 2 * (CORE.latency or 8) + 6)):
            await RisingEdge(dut.clk)
        sender.cancel()
        await bench.reset(cycles=random.choice((1, 2)))
        bench.pressure = _chance(0.0)
        await bench.send(corner)
        await bench.drain()


@cocotb.test(skip=not FIXED)
async def latency_and_interval(dut):
    """Latency and initiation interval are the ones of cores.toml, on every sample."""
    bench = await _fresh(dut)
    rng = _rng()
    await bench.send(stimulus.uniform(CORE, rng, 12), lambda: 2 * CORE.latency + 2)
    await bench.drain()
    seen = [valid - taken for taken, valid in zip(bench.board.accept_cycle, bench.board.valid_cycle)]
    assert set(seen) == {CORE.latency}, f"latency {sorted(set(seen))}, cores.toml says {CORE.latency}"
    first = len(bench.board.accepted)
    await bench.send(stimulus.uniform(CORE, rng, 40))
    await bench.drain()
    taken = bench.board.accept_cycle[first:]
    steps = {b - a for a, b in zip(taken[8:], taken[9:])}
    assert steps == {CORE.ii}, f"initiation interval {sorted(steps)}, cores.toml says {CORE.ii}"
