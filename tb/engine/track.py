"""The haptic circle through the Verilog of an engine: solver, PID and plant sample by sample, as `quadrance track`.

Runs inside the simulator; test_engine.py starts it. +counts=1,2,5 are the iterations a sample, +samples=8 their number.
"""

from __future__ import annotations

import os
import pickle
import random

import cocotb
import numpy as np
from cocotb.clock import Clock
from quadrance.iterative import engines, track

from tb.lib.stream import Bench

with open(os.environ["QUADRANCE_CORE"], "rb") as _file:
    CORE = pickle.load(_file)


async def _solved(bench: Bench, ports: dict) -> dict:
    """The answer of the core to one sample, once it has come."""
    before = len(bench.board.results)
    await bench.send({name: word for name, word in ports.items() if name.startswith("in_")})
    while len(bench.board.results) == before:
        await bench.edge
    return {port.name: np.array([word]) for port, word in zip(CORE.outputs, bench.board.results[-1])}


async def _circle(bench: Bench, follower: track.Follower, count: int, samples: int) -> track.Trace:
    """The loop with the Verilog as its solver: from the start given, then warm with noise at the start's ports."""
    steps = track.loop(follower, [count], 1, samples)
    state, goal, counts = next(steps)
    for k in range(samples):
        start = state if k == 0 else np.array([[random.getrandbits(CORE.params["A"]) for _ in state[0]]])
        ports = track.ports(CORE, start, goal, int(counts[0]), warm=int(k > 0))
        if k == 0:
            bench.configure({name: word for name, word in ports.items() if name.startswith("cfg_")})
        answer = await _solved(bench, ports)
        assert answer["out_iters"][0] == count
        try:
            state, goal, counts = steps.send(engines.joints(answer))
        except StopIteration as end:
            return end.value


@cocotb.test()
async def circle(dut):
    """The trace is the one of the bit-true model, and every sample takes its clocks."""
    counts = [int(text) for text in cocotb.plusargs["counts"].split(",")]
    samples, follower = int(cocotb.plusargs["samples"]), track.engine(CORE)
    Clock(dut.clk, 10, unit="ns", impl="gpi").start(start_high=False)
    bench = Bench(dut, CORE)
    bench.start()
    await bench.reset()
    for count in counts:
        first = len(bench.board.accepted)
        ours, model = await _circle(bench, follower, count, samples), track.follow(follower, [count], 1, samples)
        for name in ("state", "asked", "reached"):
            assert np.array_equal(getattr(ours, name), getattr(model, name)), f"{name} at {count} iterations"
        latency = np.array(bench.board.valid_cycle[first:]) - bench.board.accept_cycle[first:]
        each, early = engines.EXAMPLES[CORE.name].clocks(CORE)
        assert np.all(latency == each * (count + 1) - early)
    await bench.drain()
