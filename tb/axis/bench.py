"""The cocotb bench of an AXI-Stream wrapper: cocotbext-axi's source and sink, answers by the core's own model.

Nothing here drives or samples a handshake: source, sink and their pauses are those of cocotbext-axi.
"""

from __future__ import annotations

import itertools
import logging
import os
import pickle
import random

import cocotb
import numpy as np
from cocotb.clock import Clock
from cocotb.triggers import ClockCycles
from cocotbext.axi import AxiStreamBus, AxiStreamFrame, AxiStreamSink, AxiStreamSource
from quadrance.cores import Core

from tb.axis import beats
from tb.lib import stimulus

with open(os.environ["QUADRANCE_CORE"], "rb") as _file:
    CORE: Core = pickle.load(_file)

SAMPLES = 40


def _pauses(chance: float):
    return iter(lambda: random.random() < chance, None)


async def _start(dut, cfg: dict[str, int]) -> tuple[AxiStreamSource, AxiStreamSink]:
    cocotb.start_soon(Clock(dut.aclk, 10, unit="ns").start())
    for port in CORE.cfg:
        getattr(dut, port.name).value = int(cfg[port.name]) & (1 << port.width) - 1
    dut.aresetn.value = 0
    ends = []
    for kind, prefix in ((AxiStreamSource, "s_axis"), (AxiStreamSink, "m_axis")):
        bus = AxiStreamBus.from_prefix(dut, prefix)
        logging.getLogger(f"cocotb.{dut._name}.{prefix}").setLevel(logging.WARNING)  # not a line a beat
        ends.append(kind(bus, dut.aclk, dut.aresetn, reset_active_level=False, byte_lanes=len(bus.tdata) // 8))
    await ClockCycles(dut.aclk, 3)
    dut.aresetn.value = 1
    await ClockCycles(dut.aclk, 2)
    return tuple(ends)


async def _through(source: AxiStreamSource, sink: AxiStreamSink, words: dict, cfg: dict[str, int]) -> None:
    """Every sample through the wrapper; its fields and its tuser are the model's words."""
    count, rng = next(iter(words.values())).size, np.random.default_rng(1)
    sizes = beats.size(CORE.inputs) // 8, beats.size(CORE.outputs) // 8
    for i in range(count):
        beat = beats.sample(CORE.inputs, {name: column[i] for name, column in words.items()}, rng)
        await source.send(AxiStreamFrame(beat.to_bytes(sizes[0], "little")))
    answer = CORE.model(CORE.params, **words, **cfg)
    for i in range(count):
        frame = await sink.recv()
        want = {port.name: int(np.broadcast_to(answer[port.name], (count,))[i]) for port in CORE.outputs}
        assert bytes(frame.tdata) == beats.result(CORE.outputs, want).to_bytes(sizes[1], "little"), (i, frame, want)
        status = frame.tuser if isinstance(frame.tuser, int) else (frame.tuser or [0])[-1]
        if CORE.status is not None:
            assert status == want["out_status"], f"sample {i}: tuser {status}, model {want['out_status']}"
    assert sink.empty(), "a beat more than samples"


def _some(cfg: dict[str, int], rng: np.random.Generator) -> dict:
    """Corners, evenly, and random words."""
    corners = stimulus.corners(CORE, cfg)
    size = next(iter(corners.values())).size
    pick = np.unique(np.linspace(0, size - 1, SAMPLES // 2).astype(int))
    return stimulus.joined({name: words[pick] for name, words in corners.items()},
                           stimulus.uniform(CORE, rng, SAMPLES // 2))


@cocotb.test(timeout_time=500, timeout_unit="us")  # a beat that is lost is waited for in vain
async def back_to_back(dut):
    """Without a pause at either end."""
    rng = np.random.default_rng(random.getrandbits(32))
    cfg = stimulus.configs(CORE, rng)[0]
    await _through(*await _start(dut, cfg), _some(cfg, rng), cfg)


@cocotb.test(timeout_time=500, timeout_unit="us")  # a beat that is lost is waited for in vain
async def pauses(dut):
    """Source and sink pause at random."""
    rng = np.random.default_rng(random.getrandbits(32))
    cfg = stimulus.configs(CORE, rng)[-1]
    source, sink = await _start(dut, cfg)
    source.set_pause_generator(_pauses(0.5))
    sink.set_pause_generator(_pauses(0.5))
    await _through(source, sink, _some(cfg, rng), cfg)


@cocotb.test(timeout_time=500, timeout_unit="us")
async def long_stalls(dut):
    """The sink takes nothing for 70 clocks at a time: beats wait and none is lost."""
    rng = np.random.default_rng(random.getrandbits(32))
    cfg = stimulus.configs(CORE, rng)[0]
    source, sink = await _start(dut, cfg)
    sink.set_pause_generator(itertools.cycle([True] * 70 + [False] * 3))
    await _through(source, sink, stimulus.uniform(CORE, rng, 8), cfg)
