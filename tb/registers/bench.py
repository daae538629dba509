"""The cocotb bench of a core behind registers, answers by the core's own model.

Addresses, bits and formats are those of docs/registers.md (`tb.registers.page`); only samples go through the driver of
`quadrance.device`. AXI4-Lite is driven by cocotbext-axi, Wishbone by a master of our own.
"""

from __future__ import annotations

import logging
import os
import pickle
import random
from dataclasses import replace

import cocotb
import numpy as np
from cocotb.clock import Clock
from cocotb.triggers import ClockCycles, ReadOnly, RisingEdge
from cocotbext.axi import AxiLiteBus, AxiLiteMaster, AxiResp
from quadrance.cli import registers
from quadrance.cores import Core
from quadrance.device import BUSY, DONE, OUTSIDE, REFUSED, AsyncDevice

from tb.lib import stimulus
from tb.registers import page

with open(os.environ["QUADRANCE_CORE"], "rb") as _file:
    TOP: Core = pickle.load(_file)

BUS, _, NAME = TOP.name.partition("_")
CORE = replace(TOP, name=NAME)
SAMPLES = 12
# No write gets in while it is busy; a command of kinematics_engine mostly takes 2 clocks
QUICK = CORE.function == "kinematics" or CORE.latency is not None and CORE.latency < 12
FLAGS = REFUSED | OUTSIDE
LOST = {"timeout_time": 2, "timeout_unit": "ms"}  # an answer that is lost is waited for in vain


class Axil:
    """Reads and writes of words through cocotbext-axi; every answer has to be OKAY."""

    def __init__(self, dut) -> None:
        logging.getLogger(f"cocotb.{dut._name}.s_axil").setLevel(logging.WARNING)
        self.master = AxiLiteMaster(AxiLiteBus.from_prefix(dut, "s_axil"), dut.aclk, dut.aresetn, False)

    async def read(self, address: int) -> int:
        answer = await self.master.read(address, 4)
        assert answer.resp == AxiResp.OKAY, f"a read of {address:#x} answers {answer.resp}"
        return int.from_bytes(answer.data, "little")

    async def write(self, address: int, word: int, count: int = 4) -> None:
        answer = await self.master.write(address, word.to_bytes(4, "little")[:count])
        assert answer.resp == AxiResp.OKAY, f"a write of {address:#x} answers {answer.resp}"

    def pauses(self, on: bool) -> None:
        for end in (self.master.write_if, self.master.read_if):
            for name in ("aw_channel", "w_channel", "b_channel", "ar_channel", "r_channel"):
                if on and (channel := getattr(end, name, None)):
                    channel.set_pause_generator(iter(lambda: random.random() < 0.6, None))


class Wishbone:
    """Standard cycles, or pipelined ones, where `stall` is looked at and the next request is made at once."""

    def __init__(self, dut) -> None:
        self.dut, self.pipelined = dut, False
        for name in ("cyc_i", "stb_i", "we_i", "adr_i", "dat_i", "sel_i"):
            getattr(dut, name).value = 0

    async def many(self, requests: list[tuple]) -> list[int]:
        """(address, word or None, bytes) of each; what was read, one for each request."""
        dut, found, waits = self.dut, [], list(requests)
        dut.cyc_i.value = 1
        for _ in range(20 * len(requests) + 20):
            dut.stb_i.value = int(bool(waits))
            if waits:
                address, word, count = waits[0]
                dut.we_i.value, dut.adr_i.value = int(word is not None), address >> 2
                dut.dat_i.value, dut.sel_i.value = word or 0, (1 << count) - 1
            await ReadOnly()
            ack, stall, data = int(dut.ack_o.value), int(dut.stall_o.value), dut.dat_o.value
            offered = bool(waits)
            await RisingEdge(dut.clk_i)
            if ack:
                found.append(int(data) if requests[len(found)][1] is None else 0)
            if offered and (not stall if self.pipelined else ack):
                waits.pop(0)
            if len(found) == len(requests):
                break
        dut.cyc_i.value = dut.stb_i.value = 0
        await ClockCycles(dut.clk_i, 3)
        assert int(dut.ack_o.value) == 0 and len(found) == len(requests), f"{len(found)} of {len(requests)} acks"
        return found

    async def read(self, address: int) -> int:
        return (await self.many([(address, None, 4)]))[0]

    async def write(self, address: int, word: int, count: int = 4) -> None:
        await self.many([(address, word, count)])

    def pauses(self, on: bool) -> None:
        self.pipelined = on


def _pins(dut) -> tuple:
    """Clock, reset, and its active level."""
    return (dut.aclk, dut.aresetn, 0) if BUS == "axil" else (dut.clk_i, dut.rst_i, 1)


async def _reset(dut) -> None:
    """One clock of reset."""
    clk, reset, level = _pins(dut)
    reset.value = level
    await ClockCycles(clk, 1)
    reset.value = 1 - level
    await ClockCycles(clk, 1)


async def _fresh(dut, core_period: float = 37.0) -> tuple[Axil | Wishbone, AsyncDevice]:
    """From registers that are unknown, after one clock of reset."""
    clk, reset, level = _pins(dut)
    cocotb.start_soon(Clock(clk, 10, unit="ns").start())
    if hasattr(dut, "core_clk"):
        cocotb.start_soon(Clock(dut.core_clk, round(core_period * 500) * 2, unit="ps").start())
    reset.value = level
    await ClockCycles(clk, 1)
    bus = (Axil if BUS == "axil" else Wishbone)(dut)
    reset.value = 1 - level
    await ClockCycles(clk, 1)
    device = AsyncDevice(bus, registers.described(CORE, {}))
    await device.open()
    for _ in range(100):
        if not await device.state() & BUSY:  # the core in its slower clock is still being reset
            break
    return bus, device


def _cfg(rng: np.random.Generator) -> dict[str, int]:
    """A configuration whose signed words are negative, where the core has such."""
    found = stimulus.configs(CORE, rng)
    return max(found, key=lambda one: sum(int(one[port.name]) < 0 for port in CORE.cfg))


def _samples(cfg: dict[str, int], rng: np.random.Generator, count: int = SAMPLES) -> list[dict[str, int]]:
    """Corners and random words, a row a sample."""
    corners = stimulus.corners(CORE, cfg)
    pick = rng.integers(0, next(iter(corners.values())).size, count // 2)
    words = stimulus.joined({name: column[pick] for name, column in corners.items()},
                            stimulus.uniform(CORE, rng, count - count // 2))
    return [{name: int(column[i]) for name, column in words.items()} for i in range(count)]


def _answer(cfg: dict[str, int], rows: list[dict[str, int]]) -> list[dict[str, int]]:
    """What the model answers in this order, by port."""
    columns = {name: np.array([row[name] for row in rows]) for name in rows[0]}
    answer = CORE.model(CORE.params, **columns, **cfg)
    return [{port.name: int(np.broadcast_to(answer[port.name], (len(rows),))[i]) for port in CORE.outputs}
            for i in range(len(rows))]


async def _run(device: AsyncDevice, row: dict[str, int]) -> dict[str, int]:
    found = await device.run(polls=3000, **{name[3:]: value for name, value in row.items()})
    return {f"out_{name}": value for name, value in found.items()}


async def _through(device: AsyncDevice, cfg: dict[str, int], rows: list[dict[str, int]]) -> None:
    for i, (row, want) in enumerate(zip(rows, _answer(cfg, rows))):
        found = await _run(device, row)
        assert found == want, f"sample {i} {row}: {found}, the model answers {want}"


def _irq(dut) -> int:
    return int(dut.irq.value)


@cocotb.test(**LOST)
async def results(dut):
    """The model's results and status, also where the bus pauses; what was written can be read."""
    rng = np.random.default_rng(random.getrandbits(32))
    bus, device = await _fresh(dut)
    assert await bus.read(page.ID) == registers.identity(CORE) and await bus.read(page.VERSION) == page.MAP_VERSION
    cfg = _cfg(rng)
    await device.configure(cfg)
    rows = _samples(cfg, rng)
    await _through(device, cfg, rows[:SAMPLES // 2])
    written = {**cfg, **rows[SAMPLES // 2 - 1]}
    for address, port, low, width in page.places(CORE):
        if not port.name.startswith("out_"):
            assert await bus.read(address) == page.register(port, int(written[port.name]), low, width), port.name
    if CORE.status is not None and "singular" in CORE.status:
        await _reset(dut)  # a held joint begins anew, and so does the model
        while await device.state() & BUSY:
            pass
    bus.pauses(True)
    await _through(device, cfg, rows[SAMPLES // 2:])


@cocotb.test(**LOST)
async def result_words(dut):
    """A result stands in its registers, sign-extended or with zeros above, until the next one."""
    rng = np.random.default_rng(random.getrandbits(32))
    bus, device = await _fresh(dut, 9.3)
    cfg = _cfg(rng)
    await device.configure(cfg)
    rows = _samples(cfg, rng, 4)
    for row, want in zip(rows, _answer(cfg, rows)):
        await _run(device, row)
        for _ in range(2):
            for address, port, low, width in page.places(CORE):
                if port.name in want:
                    assert await bus.read(address) == page.register(port, want[port.name], low, width), port.name
        state = await bus.read(page.STATE)
        assert state == DONE | want.get("out_status", 0) << 8, f"STATE is {state:#x}"


@cocotb.test(skip=QUICK, **LOST)
async def writes_while_busy(dut):
    """They change nothing, are answered, and raise bit 2, which a write of 1 clears; STATE and IRQ_ENABLE are free."""
    rng = np.random.default_rng(random.getrandbits(32))
    bus, device = await _fresh(dut)
    cfg = _cfg(rng)
    await device.configure(cfg)
    rows = [_samples(cfg, rng, 2)[1]] * (3 + sum(not port.name.startswith("out_") for _, port, *_ in page.places(CORE)))
    words = [(address, 0xFFFFFFFF) for address, port, *_ in page.places(CORE) if not port.name.startswith("out_")]
    for row, want, (address, word) in zip(rows, _answer(cfg, rows), [*words, (page.START, 1), (page.IRQ_ENABLE, 1),
                                                                     (page.STATE, FLAGS)]):
        await device.start(**{name[3:]: value for name, value in row.items()})
        await bus.write(address, word)
        state = await bus.read(page.STATE)
        assert state & (BUSY | DONE), "a sample is lost"
        flags = 0 if address in (page.IRQ_ENABLE, page.STATE) else REFUSED
        assert state & FLAGS == flags, f"after a write to {address:#x} STATE is {state:#x}"
        while not (state := await bus.read(page.STATE)) & DONE:
            pass
        found = {f"out_{name}": value for name, value in (await device.result(state)).items()}
        assert found == want, f"a write to {address:#x} changed the result {want} to {found}"
        for _ in range(30):
            assert not await bus.read(page.STATE) & BUSY, "a second sample was started"
        await bus.write(page.STATE, REFUSED)
        assert await bus.read(page.STATE) & (FLAGS | DONE) == DONE
    for address, port, low, width in page.places(CORE):
        if port.name in cfg:
            assert await bus.read(address) == page.register(port, int(cfg[port.name]), low, width), port.name
    assert await bus.read(page.IRQ_ENABLE) == 1 and _irq(dut) == 1


@cocotb.test(**LOST)
async def writes_outside(dut):
    """Where no word is, or one that can only be read, or not the whole of one: nothing changes but bit 3."""
    rng = np.random.default_rng(random.getrandbits(32))
    bus, device = await _fresh(dut)
    cfg = _cfg(rng)
    await device.configure(cfg)
    row = _samples(cfg, rng, 2)[1]
    want = await _run(device, row)
    known = {address: await bus.read(address) for address, *_ in page.places(CORE)}
    known |= {address: await bus.read(address) for address in (page.ID, page.VERSION, page.IRQ_ENABLE)}
    for address, count in page.outside(CORE):
        await bus.write(address, 0x5A5A5A5F, count)
        state = await bus.read(page.STATE)
        assert state == DONE | OUTSIDE | want.get("out_status", 0) << 8, f"{address:#x}: STATE is {state:#x}"
        await bus.write(page.STATE, REFUSED)
        assert await bus.read(page.STATE) == state
        await bus.write(page.STATE, OUTSIDE)
        assert await bus.read(page.STATE) == state - OUTSIDE
    for address, word in known.items():
        assert await bus.read(address) == word, f"{address:#x} has changed"
    assert _irq(dut) == 0


@cocotb.test(**LOST)
async def interrupts(dut):
    """irq is high while there is a result and IRQ_ENABLE; clearing done, disabling and the next start lower it."""
    rng = np.random.default_rng(random.getrandbits(32))
    bus, device = await _fresh(dut, 61.0)
    cfg = _cfg(rng)
    await device.configure(cfg)
    row = _samples(cfg, rng, 2)[1]
    await _run(device, row)
    assert _irq(dut) == 0
    await device.interrupt(True)
    assert _irq(dut) == 1
    await device.clear(DONE)
    assert _irq(dut) == 0 and await device.state() & (DONE | BUSY) == 0
    await _run(device, row)
    assert _irq(dut) == 1
    if not QUICK:
        await bus.write(page.START, 0)
        assert _irq(dut) == 0 and await device.state() & BUSY
        await RisingEdge(dut.irq)
        assert await device.state() & (DONE | BUSY) == DONE
    await device.interrupt(False)
    assert _irq(dut) == 0


@cocotb.test(skip=QUICK, **LOST)
async def reset_in_flight(dut):
    """One clock of reset at any moment: what is inside is dropped, and the next sample is right."""
    rng = np.random.default_rng(random.getrandbits(32))
    bus, device = await _fresh(dut)
    cfg = _cfg(rng)
    row = _samples(cfg, rng, 2)[1]
    await device.configure(cfg)
    for clocks in (0, 1, 5, 17, 40):
        await device.start(**{name[3:]: value for name, value in row.items()})
        await ClockCycles(_pins(dut)[0], clocks)
        await _reset(dut)
        while (state := await device.state()) & BUSY:
            assert not state & DONE
        assert state & (DONE | FLAGS) == 0
        await _through(device, cfg, [row])


@cocotb.test(skip=BUS != "axil", **LOST)
async def both_ways_at_once(dut):
    """Reads go on while writes are made, and none takes the answer of another."""
    bus, device = await _fresh(dut)
    bus.pauses(True)
    word = next(one for one in page.places(CORE) if one[1].name.startswith("in_"))
    address, port, low, width = word
    values = [random.getrandbits(width) for _ in range(16)]

    async def write():
        for value in values:
            await bus.write(address, value)
            assert await bus.read(address) == page.register(port, port.low + (value - port.low) % (1 << port.width)
                                                            if port.width <= 32 else value, low, width)

    for one in [cocotb.start_soon(bus.write(page.IRQ_ENABLE, i)) for i in range(8)]:  # no answer is lost
        await one
    writer = cocotb.start_soon(write())
    for _ in range(24):
        assert await bus.read(page.ID) == registers.identity(CORE)
        assert await bus.read(page.VERSION) == page.MAP_VERSION
    await writer
