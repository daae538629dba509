"""cocotb bench of the reset: one clock is enough, from any state, and a word offered in that clock is not taken.

Runs inside the simulator like `tb.lib.bench`; for sequential cores whose model holds nothing that a reset clears.
"""

from __future__ import annotations

import random

import cocotb
import numpy as np
from cocotb.clock import Clock
from cocotb.triggers import RisingEdge

from tb.lib import stimulus
from tb.lib.bench import CORE
from tb.lib.stream import Bench, to_word


async def _bench(dut) -> Bench:
    bench = Bench(dut, CORE)
    bench.configure(stimulus.configs(CORE, np.random.default_rng(random.getrandbits(32)))[-1])
    Clock(dut.clk, 10, unit="ns").start()
    return bench


def _offer(dut, vectors: stimulus.Vectors) -> None:
    """A word on the input ports, with in_valid."""
    for port in CORE.inputs:
        getattr(dut, port.name).value = to_word(port, int(vectors[port.name][0]))
    dut.in_valid.value = 1


@cocotb.test()
async def one_clock_from_power_up(dut):
    """After one clock of reset, where nothing had a value before, the core answers, and rightly."""
    bench = await _bench(dut)
    await bench.reset(cycles=1)
    bench.start()
    await bench.send(stimulus.uniform(CORE, np.random.default_rng(1), 3), patience=400)
    await bench.drain(patience=400)


@cocotb.test()
async def word_offered_in_reset_is_not_taken(dut):
    """in_valid is high in all of the reset: only the words after it are answered, the first of them rightly too."""
    bench = await _bench(dut)
    rng = np.random.default_rng(random.getrandbits(32))
    await bench.reset(cycles=3)
    bench.start()
    for cycles in (1, 2, 3, 1, 2, 3):
        dut.rst.value = 1
        for _ in range(cycles):
            _offer(dut, stimulus.uniform(CORE, rng, 1))
            await RisingEdge(dut.clk)
        dut.rst.value = 0
        bench.board = type(bench.board)(CORE)
        await bench.send(stimulus.uniform(CORE, rng, 3), patience=400)
        await bench.drain(patience=400)
