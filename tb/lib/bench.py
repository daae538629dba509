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
from cocotb.triggers import Timer
from quadrance.cores import Core

from tb.lib import stimulus
from tb.lib.stream import Bench, Scoreboard, bit, read, to_word

with open(os.environ["QUADRANCE_CORE"], "rb") as _file:
    CORE: Core = pickle.load(_file)

CLOCKED = CORE.clocked
FIXED = CLOCKED and CORE.latency is not None
LATENCY, II = CORE.latency or min(CORE.ii or 1, 100), CORE.ii or 1  # where the latency varies, a moment inside it
# A clock here costs as much as a thousand in the bulk run: here is every kind of sample, and registers that are unknown
# until they are written; there is their number, and a reset at every clock.
RESETS = 12 if FIXED else 24
LINKS = 200  # of a stream that are sent in order
WORK = 600  # clocks, where the latency varies: words are written, and some iterations run
CLOCKS = 1_000  # about as many for the corners of all configurations
SAMPLES = max(4, min(20, 1_000 // max(LATENCY, II)))


def _rng() -> np.random.Generator:
    return np.random.default_rng(random.getrandbits(32))


def _cut(vectors: stimulus.Vectors, count: int) -> stimulus.Vectors:
    """At most `count` samples, evenly over all of them."""
    size = len(next(iter(vectors.values())))
    pick = np.unique(np.linspace(0, size - 1, min(size, count)).astype(int))
    return {name: values[pick] for name, values in vectors.items()}


def _chance(probability: float):
    return iter(lambda: random.random() < probability, None)


async def _fresh(dut, cycles: int = 2) -> Bench:
    Clock(dut.clk, 10, unit="ns", impl="gpi").start(start_high=False)  # after the first values are written
    bench = Bench(dut, CORE)
    bench.configure(stimulus.configs(CORE, _rng())[0])
    bench.start()
    await bench.reset(cycles)
    return bench


def _undefined_first(cfg: dict[str, int], count: int) -> stimulus.Vectors:
    """Some corners, first one whose joint direction is undefined, where the core has such: it shows the held word."""
    corners = stimulus.corners(CORE, cfg)
    cut = _cut(corners, count)
    if not CORE.status or "singular" not in CORE.status:
        return cut
    status = CORE.model(CORE.params, **corners, **cfg)["out_status"]
    first = int(np.flatnonzero(status & 2)[0])
    return {name: np.insert(values, 0, corners[name][first]) for name, values in cut.items()}


@cocotb.test(skip=not CLOCKED)
async def one_clock_of_reset(dut):
    """One clock of reset is enough, from power-up (every register unknown) and from work."""
    bench = await _fresh(dut, cycles=1)
    await bench.send(_undefined_first(bench.cfg, 6))
    await bench.drain()


@cocotb.test(skip=CLOCKED)
async def corners_and_random_combinational(dut):
    """A combinational primitive equals its model on corners and random words."""
    rng = _rng()
    configs = stimulus.configs(CORE, rng)
    count = max(CLOCKS // 3 // len(configs), 6)  # the bulk run tries tens of thousands; this one sees X
    for cfg in configs:
        board = Scoreboard(CORE)
        for port in CORE.cfg:
            getattr(dut, port.name).value = to_word(port, cfg[port.name])
        corners = stimulus.corners(CORE, cfg)
        for vectors in (_cut(corners, 2 * count // 3), stimulus.uniform(CORE, rng, count // 3)):
            for row in zip(*(vectors[port.name].tolist() for port in CORE.inputs)):
                for port, value in zip(CORE.inputs, row):
                    getattr(dut, port.name).value = to_word(port, value)
                await Timer(1, "ns")
                board.accepted.append((*(cfg[port.name] for port in CORE.cfg), *row))
                board.results.append(tuple(read(getattr(dut, port.name), port) for port in CORE.outputs))
        board.check()


@cocotb.test(skip=not CLOCKED)
async def corners_back_to_back(dut):
    """Corners at every configuration, without a gap and without a reset between; at every other one in reverse order.

    The first corners are singular: their flags would hide a flag that stays from the configuration before.
    """
    bench = await _fresh(dut)
    configs = stimulus.configs(CORE, _rng())
    few = 3 if II <= 100 else 2  # of each at least; the bulk run takes all of them
    count = min(max(CLOCKS // (len(configs) * max(II, 10)), few), 120)
    for index, cfg in enumerate(configs):
        bench.configure(cfg)
        words = _cut(stimulus.corners(CORE, cfg), count)
        await bench.send({name: values[::-1] for name, values in words.items()} if index % 2 else words)
        await bench.drain()


@cocotb.test(skip=not CLOCKED)
async def idle_and_back_pressure(dut):
    """Random samples and corners, in a stream some that follow each other, under every pair of gaps and stalls."""
    bench = await _fresh(dut)
    gaps = {"none": lambda: 0, "random": lambda: random.choice((0, 0, 1, 3)),
            "burst": lambda: 0 if random.random() < 0.8 else 2 * LATENCY}
    long = 2 * max(LATENCY, 32) + 3  # clocks of one stall: more than any core takes, and more than 64
    stalls = {"none": lambda: _chance(0.0), "half": lambda: _chance(0.5), "most": lambda: _chance(0.9),
              "burst": lambda: itertools.cycle([True] * long + [False] * 5)}
    rng = _rng()
    for cfg, (gap, stall) in zip(itertools.cycle(stimulus.configs(CORE, rng)),
                                 itertools.product(gaps.values(), stalls.values())):
        bench.configure(cfg)
        bench.pressure = stall()
        samples, corners = stimulus.uniform(CORE, rng, SAMPLES // 2), stimulus.corners(CORE, cfg)
        size = next(iter(corners.values())).size
        if "in_last" in corners:  # links: what a stall loses of one shows where the others are those of its chain
            first = rng.integers(0, size - LINKS)
            await bench.send({name: words[first:first + LINKS] for name, words in corners.items()}, gap)
        pick = rng.integers(0, size, SAMPLES // 2)  # undefined, unreachable, saturating
        take = rng.random(SAMPLES // 2) < 0.5
        await bench.send({name: np.where(take, corners[name][pick], words) for name, words in samples.items()}, gap)
        await bench.drain()


@cocotb.test(skip=not CLOCKED)
async def stalled_output_loses_nothing(dut):
    """With out_ready low for ever the core stops taking samples and keeps every one it took."""
    bench = await _fresh(dut)
    bench.pressure = _chance(1.0)
    samples = stimulus.uniform(CORE, _rng(), 2 * (LATENCY // II) + 8)  # more than it has room for
    sender = cocotb.start_soon(bench.send(samples))
    for _ in range(12 * LATENCY + 100):
        await bench.edge
    assert not bench.board.results, "a result was taken although out_ready was low"
    assert bench.board.accepted, "nothing was accepted"
    assert bit(dut.out_valid), "out_valid waits for out_ready"
    assert not sender.done(), "a core without room accepted every sample"
    bench.pressure = _chance(0.0)
    await sender
    await bench.drain()


@cocotb.test(skip=not CLOCKED)
async def reset_in_flight(dut):
    """A reset at any moment drops what is in flight, takes nothing, and touches nothing that comes after it.

    Every other group of three resets, one with each of `offers`, meets a result that waits for out_ready. The bulk run
    has a reset at every clock; here every register is unknown until it is written.
    """
    bench = await _fresh(dut)
    rng = _rng()
    corners = _undefined_first(bench.cfg, 2)
    if LATENCY > 64:  # one of them a round
        corners = [{name: words[i:i + 1] for name, words in corners.items()} for i in range(2)]
    corner = itertools.cycle(corners if LATENCY > 64 else [corners])
    begin = {name: words[:400] for name, words in stimulus.corners(CORE, bench.cfg).items()}  # writes, then work
    offers = itertools.cycle((lambda: True, lambda: False, lambda: random.random() < 0.5))
    for index, offer in zip(range(RESETS), offers):
        waits = index // 3 % 2 == 1
        bench.pressure = _chance(1.0 if waits else random.choice((0.0, 0.7)))
        words = {name: values.repeat(4) for name, values in stimulus.uniform(CORE, rng, 5).items()}
        sender = cocotb.start_soon(bench.send(words if FIXED else begin))
        if waits:
            await bench.result()
        for _ in range(random.randrange(3) if waits else random.randrange(1, 2 * LATENCY + 6 if FIXED else WORK)):
            await bench.edge
        sender.cancel()
        await bench.reset(random.choice((1, 1, 2, 3)), offer)
        bench.pressure = _chance(0.0)
        await bench.send(next(corner))
        await bench.drain(after=0)  # one too many would come in the next round, and be seen there


@cocotb.test(skip=not FIXED)
async def latency_and_interval(dut):
    """Latency and initiation interval are the ones of cores.toml, on every sample, undefined ones included."""
    bench = await _fresh(dut)
    rng = _rng()
    samples = stimulus.uniform(CORE, rng, SAMPLES)
    directed = _undefined_first(bench.cfg, SAMPLES // 2)
    mixed = {name: np.concatenate([directed[name], words]) for name, words in samples.items()}
    await bench.send(mixed, lambda: 2 * CORE.latency + 2)
    await bench.drain()
    first = len(bench.board.accepted)
    await bench.send(mixed)
    await bench.drain()
    taken = bench.board.accept_cycle[first:]
    steps = {b - a for a, b in zip(taken, taken[1:])}
    assert steps == {CORE.ii}, f"initiation interval {sorted(steps)}, cores.toml says {CORE.ii}"
    if CORE.ii == CORE.latency > 1:  # one sample at a time: a stall delays the next one, never the one inside
        bench.pressure = _chance(0.7)
        await bench.send(mixed)
        await bench.drain()
    seen = {valid - taken for taken, valid in zip(bench.board.accept_cycle, bench.board.valid_cycle)}
    assert seen == {CORE.latency}, f"latency {sorted(seen)}, cores.toml says {CORE.latency}"
