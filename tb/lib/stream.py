"""This module has the driver, sink, monitors and scoreboard of the AXI-Stream contract.

All of them sample just after the rising edge, where a signal still has the value that the edge saw.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

import cocotb
import numpy as np
from cocotb.triggers import RisingEdge
from quadrance.cores import Core, Port

Sample = tuple[int, ...]


def to_word(port: Port, value: int) -> int:
    """`value` as the unsigned word that is put on the port."""
    assert port.low <= value <= port.high, f"{port.name}: {value} does not fit"
    return int(value) & (1 << port.width) - 1


def bits(handle) -> str:
    """What is on a port, a character a bit.

    `str(handle.value)` gives the same text, but builds an object for each bit. `_handle` is private to cocotb, whose
    version requirements.lock fixes.
    """
    return handle._handle.get_signal_val_binstr()


def read(handle, port: Port) -> int:
    """The value on a port; an X or Z there is an error."""
    text = bits(handle)
    assert not text.strip("01"), f"{port.name} is {text}"
    return int(text, 2) - (1 << port.width if port.signed and text[0] == "1" else 0)


def bit(handle) -> bool:
    """A control bit; an X there is an error."""
    text = bits(handle)
    assert text in ("0", "1"), f"{handle._name} is {text}"
    return text == "1"


@dataclass
class Scoreboard:
    """What went in and what came out since the last reset; the model decides what is right."""

    core: Core
    accepted: list[Sample] = field(default_factory=list)
    results: list[Sample] = field(default_factory=list)
    accept_cycle: list[int] = field(default_factory=list)
    valid_cycle: list[int] = field(default_factory=list)

    def expected(self) -> list[Sample]:
        """The model's answer to every accepted sample, in order."""
        ports = [*self.core.cfg, *self.core.inputs]
        columns = np.array(self.accepted, dtype=np.int64).reshape(-1, len(ports)).T
        answer = self.core.model(self.core.params, **{p.name: c for p, c in zip(ports, columns)})
        missing = {p.name for p in self.core.outputs} ^ set(answer)
        assert not missing, f"model and core disagree on the ports {sorted(missing)}"
        shape = (len(self.accepted),)
        return list(zip(*(np.broadcast_to(answer[p.name], shape).tolist() for p in self.core.outputs)))

    def check(self, complete: bool = True) -> None:
        """Every result as the model says; with `complete`, one for each accepted sample and at least one."""
        if complete:
            assert len(self.results) == len(self.accepted) > 0, \
                f"{len(self.results)} results for {len(self.accepted)} accepted samples"
        assert len(self.results) <= len(self.accepted), "more results than accepted samples"
        if not self.accepted:
            return
        for index, (got, want) in enumerate(zip(self.results, self.expected())):
            assert got == want, self._difference(index, got, want)

    def _difference(self, index: int, got: Sample, want: Sample) -> str:
        ins = dict(zip((p.name for p in (*self.core.cfg, *self.core.inputs)), self.accepted[index]))
        names = [p.name for p in self.core.outputs]
        return f"sample {index} {ins}: core {dict(zip(names, got))}, model {dict(zip(names, want))}"


class Bench:
    """Clocked core with its driver, sink and monitors; one per cocotb test."""

    def __init__(self, dut, core: Core) -> None:
        self.dut, self.core = dut, core
        self.board = Scoreboard(core)
        self.cfg: dict[str, int] = {}
        self.cycle = 0
        self.pressure: Iterable[bool] = iter(lambda: False, None)
        self.edge = RisingEdge(dut.clk)
        self.inputs = [(getattr(dut, port.name), port) for port in core.inputs]
        self.outputs = [(getattr(dut, port.name), port) for port in core.outputs]
        dut.in_valid.value = 0
        dut.out_ready.value = 0
        for port in (*core.cfg, *core.inputs):
            getattr(dut, port.name).value = 0

    async def reset(self, cycles: int = 2, offer: Callable[[], bool] = lambda: False) -> None:
        """Drop what is in flight; the results so far must still be a prefix of the right ones.

        `offer()` says clock by clock whether a random word is at the input meanwhile: it must not be taken.
        """
        self.dut.rst.value = 1
        for _ in range(cycles):
            offered = offer()
            self.dut.in_valid.value = int(offered)
            for handle, port in self.inputs if offered else ():
                handle.value = to_word(port, random.randint(port.low, port.high))
            await self.edge
        self.dut.rst.value = 0
        self.dut.in_valid.value = 0
        self.board.check(complete=False)
        self.board = Scoreboard(self.core)

    def configure(self, cfg: dict[str, int]) -> None:
        """Set the quasi-static words; only while nothing is in flight."""
        assert len(self.board.results) == len(self.board.accepted)
        self.cfg = cfg
        for port in self.core.cfg:
            getattr(self.dut, port.name).value = to_word(port, cfg[port.name])

    def start(self) -> None:
        """Let sink and monitors run until the test ends."""
        cocotb.start_soon(self._watch())

    async def _watch(self) -> None:
        """Sink and both monitors, a pass a clock: what every edge saw, then out_ready for the next one."""
        dut = self.dut
        rst, in_valid, in_ready = dut.rst, dut.in_valid, dut.in_ready
        out_valid, out_ready = dut.out_valid, dut.out_ready
        held: Sample | None = None
        shown = False
        ready = False
        while True:
            wanted = not next(self.pressure)
            if wanted != ready:
                out_ready.value = int(wanted)
                ready = wanted
            await self.edge
            self.cycle += 1
            if bit(rst):
                held, shown = None, False
                continue
            valid = bit(out_valid)
            assert valid or held is None, "out_valid fell before out_ready took the result"
            if valid:
                sample = tuple(read(handle, port) for handle, port in self.outputs)
                assert held in (None, sample), f"result changed while it waited: {held} to {sample}"
                if not shown:
                    self.board.valid_cycle.append(self.cycle)
                held, shown = (None, False) if ready else (sample, True)
                if ready:
                    self.board.results.append(sample)
            if bit(in_ready) and bit(in_valid):
                self.board.accepted.append((*(self.cfg[port.name] for port in self.core.cfg),
                                            *(read(handle, port) for handle, port in self.inputs)))
                self.board.accept_cycle.append(self.cycle)

    async def send(self, vectors: dict[str, np.ndarray], idle: Callable[[], int] = lambda: 0,
                   patience: int = 40_000) -> None:
        """Drive every sample; `idle()` cycles without valid before each."""
        in_valid, in_ready = self.dut.in_valid, self.dut.in_ready
        offered = False
        columns = [np.asarray(vectors[port.name]).tolist() for port in self.core.inputs]
        for row in zip(*columns):
            for _ in range(idle()):
                if offered:
                    in_valid.value = 0
                    offered = False
                await self.edge
            if not offered:
                in_valid.value = 1
                offered = True
            for (handle, port), value in zip(self.inputs, row):
                handle.value = to_word(port, value)
            for _ in range(patience):
                await self.edge
                if bit(in_ready):
                    break
            else:
                raise AssertionError(f"no in_ready for {patience} cycles")
        in_valid.value = 0

    async def result(self, patience: int = 40_000) -> None:
        """Wait until a result is offered."""
        for _ in range(patience):
            await self.edge
            if bit(self.dut.out_valid):
                return
        raise AssertionError(f"no out_valid for {patience} cycles")

    async def drain(self, patience: int = 40_000, after: int | None = None) -> None:
        """Wait until every accepted sample has its result, then `after` clocks, a latency by default, for one too many.
        """
        await self.edge
        for _ in range(patience):
            await self.edge
            if len(self.board.results) == len(self.board.accepted):
                break
        for _ in range(4 + (self.core.latency or 0) if after is None else after):
            await self.edge
        self.board.check()
