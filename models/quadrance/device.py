"""This module drives a core behind registers, from a map that `quadrance registers --out` writes.

    with Memory("/dev/mem", 0x43C00000) as bus:
        ik = Device(bus, "table_ik2.json")       # another core, other parameters or another map are refused
        ik.configure()                           # the words of the arm that the map carries
        print(ik.run(x=19200, y=7680, elbow=0))  # {'j1': ..., 'j2': ..., 'status': 0}

A bus is anything with ``read(address)`` and ``write(address, word)``, such as PYNQ's MMIO; `AsyncDevice` awaits both.
"""

from __future__ import annotations

import json
import mmap
import os
from collections.abc import Generator
from pathlib import Path
from typing import Any

BUSY, DONE, REFUSED, OUTSIDE = 1, 2, 4, 8  # bits of STATE
STATUS_LOW = 8

Steps = Generator[tuple, Any, Any]  # ("read", address) takes a word, ("write", address, word) nothing


class WrongDevice(RuntimeError):
    """Another core, other parameters or another map answers."""


class Memory:
    """Physical memory, by aligned accesses of 32 bits."""

    def __init__(self, path: str | Path, base: int = 0, size: int = 0x1000) -> None:
        skip = base % mmap.ALLOCATIONGRANULARITY
        file = os.open(path, os.O_RDWR | os.O_SYNC)
        try:
            self._map = mmap.mmap(file, skip + size, offset=base - skip)
        finally:
            os.close(file)
        self._all = memoryview(self._map)
        self._words = self._all[skip:skip + size].cast("I")

    def read(self, address: int) -> int:
        """The word at a byte address."""
        return self._words[address // 4]

    def write(self, address: int, word: int) -> None:
        """Write the word at a byte address."""
        self._words[address // 4] = word

    def __enter__(self) -> Memory:
        return self

    def __exit__(self, *_: object) -> None:
        self._words.release()
        self._all.release()
        self._map.close()


class _Steps:
    """What a driver does, as the accesses to the bus one after the other."""

    def __init__(self, about: dict | str | Path) -> None:
        self.about = about if isinstance(about, dict) else json.loads(Path(about).read_text(encoding="utf-8"))
        self.ports: dict[str, list[dict]] = {}
        for word in self.about["words"]:
            self.ports.setdefault(word["port"], []).append(word)
        self.control = self.about["control"]

    def open(self) -> Steps:
        found = yield "read", self.control["ID"]
        if found != self.about["id"]:
            raise WrongDevice(f"ID {found:#010x} answers, {self.about['core']} with the map's parameters has "
                              f"{self.about['id']:#010x}")

    def put(self, port: str, value: int) -> Steps:
        words = self.ports[port]
        width = words[-1]["low"] + words[-1]["width"]
        low = -(1 << width - 1) if words[0]["signed"] else 0
        if not low <= value < low + (1 << width):
            raise ValueError(f"{port}: {value} does not fit its {width} bits ({low} to {low + (1 << width) - 1})")
        for word in words:
            yield "write", word["address"], value >> word["low"] & 0xFFFFFFFF

    def get(self, port: str) -> Steps:
        words, value = self.ports[port], 0
        for word in words:
            value |= ((yield "read", word["address"]) & (1 << word["width"]) - 1) << word["low"]
        width = words[-1]["low"] + words[-1]["width"]
        return value - (1 << width) if words[0]["signed"] and value >> width - 1 else value

    def configure(self, cfg: dict[str, int] | None = None) -> Steps:
        for port, value in (self.about["cfg"] if cfg is None else cfg).items():
            yield from self.put(port, int(value))

    def start(self, **words: int) -> Steps:
        for name, value in words.items():
            yield from self.put(f"in_{name}", int(value))
        yield "write", self.control["START"], 1

    def state(self) -> Steps:
        return (yield "read", self.control["STATE"])

    def result(self, state: int | None = None) -> Steps:
        found = {}
        for port in self.ports:
            if port.startswith("out_"):
                found[port[4:]] = yield from self.get(port)
        if self.about["status"]:
            found["status"] = ((yield from self.state()) if state is None else state) >> STATUS_LOW & 15
        return found

    def clear(self, bits: int) -> Steps:
        yield "write", self.control["STATE"], bits

    def interrupt(self, on: bool) -> Steps:
        yield "write", self.control["IRQ_ENABLE"], int(on)

    def run(self, polls: int = 1_000_000, **words: int) -> Steps:
        yield from self.start(**words)
        for _ in range(polls):
            if (state := (yield from self.state())) & DONE:
                return (yield from self.result(state))
        raise TimeoutError(f"{self.about['core']}: no result after {polls} reads of STATE, which is {state:#x}")


class Device:
    """A core behind registers. Words are integers, as the ports of the core have them.

    ``configure(cfg)`` writes configuration words by port (those of the map by default); ``run(x=..., y=...)`` writes a
    sample, starts it, waits and reads the result; ``start``, ``state``, ``result``, ``clear(bits)``, ``interrupt(on)``,
    ``put(port, value)`` and ``get(port)`` are its parts.
    """

    def __init__(self, bus: Any, about: dict | str | Path) -> None:
        self._bus, self._steps = bus, _Steps(about)
        self._do(self._steps.open())

    def _do(self, steps: Steps) -> Any:
        answer = None
        while True:
            try:
                kind, *words = steps.send(answer)
            except StopIteration as end:
                return end.value
            answer = getattr(self._bus, kind)(*words)

    def __getattr__(self, name: str) -> Any:
        steps = getattr(self._steps, name)
        return lambda *args, **words: self._do(steps(*args, **words))


class AsyncDevice:
    """`Device` on a bus whose ``read`` and ``write`` are awaited; ``await device.open()`` first."""

    def __init__(self, bus: Any, about: dict | str | Path) -> None:
        self._bus, self._steps = bus, _Steps(about)

    async def _do(self, steps: Steps) -> Any:
        answer = None
        while True:
            try:
                kind, *words = steps.send(answer)
            except StopIteration as end:
                return end.value
            answer = await getattr(self._bus, kind)(*words)

    def __getattr__(self, name: str) -> Any:
        steps = getattr(self._steps, name)
        return lambda *args, **words: self._do(steps(*args, **words))
