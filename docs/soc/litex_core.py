"""A core behind registers as a module of LiteX, and LiteX's serial bridge as a bus of `quadrance.device`.

    quadrance registers table_ik2 --arm scara.toml --bus axil --out hw      (or --bus wishbone)

    soc.ik = Registers(soc.platform, "hw")
    soc.bus.add_slave("ik", soc.ik.bus, SoCRegion(origin=0x8000_0000, size=0x1000, cached=False))
    soc.irq.add("ik")                                                       where there is a CPU

    ik = Device(SerialBridge(serial.Serial("/dev/ttyUSB0", 115200, timeout=1), 0x8000_0000), "hw/table_ik2.json")

The second part, on a PC, needs `soc.add_uartbone()` and pyserial. Map and drivers are those of docs/registers.md.
"""

from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace
from typing import BinaryIO

from litex.gen import LiteXModule
from litex.soc.interconnect import axi, wishbone
from migen import ClockSignal, Instance, ResetSignal, Signal


class Registers(LiteXModule):
    """The core in a folder that `quadrance registers --out` has written, in the clock `sys`.

    Parameters
    ----------
    platform : takes the Verilog files.
    folder : of one core, without --core-clock.
    """

    def __init__(self, platform, folder: str | Path) -> None:
        maps, folder = sorted(Path(folder).glob("*.json")), Path(folder)
        if len(maps) != 1:
            raise ValueError(f"{folder} has {len(maps)} maps *.json, and one core makes one: quadrance registers --out")
        core = json.loads(maps[0].read_text())["core"]
        lite = (folder / f"axil_{core}.v").exists()
        self.irq = Signal()
        self.ev = SimpleNamespace(irq=self.irq)  # where LiteX looks for the interrupt of a module
        self.bus = axi.AXILiteInterface(data_width=32, address_width=32) if lite else wishbone.Interface()
        pins = self._axil(self.bus) if lite else self._wishbone(self.bus)
        self.specials += Instance(f"{'axil' if lite else 'wishbone'}_{core}", **pins, o_irq=self.irq)
        for path in sorted(folder.glob("*.v")):
            platform.add_source(str(path))

    @staticmethod
    def _axil(bus: axi.AXILiteInterface) -> dict:
        pins = {"i_aclk": ClockSignal(), "i_aresetn": ~ResetSignal()}
        for channel, (ready, valid) in {"aw": "oi", "w": "oi", "b": "io", "ar": "oi", "r": "io"}.items():
            words = {"aw": ("addr",), "w": ("data", "strb"), "b": ("resp",), "ar": ("addr",), "r": ("data", "resp")}
            for name in words[channel]:
                word = getattr(getattr(bus, channel), name)
                pins[f"{valid}_s_axil_{channel}{name}"] = word[:12] if name == "addr" else word
            pins[f"{ready}_s_axil_{channel}ready"] = getattr(bus, channel).ready
            pins[f"{valid}_s_axil_{channel}valid"] = getattr(bus, channel).valid
        return pins | {"i_s_axil_awprot": 0, "i_s_axil_arprot": 0}

    @staticmethod
    def _wishbone(bus: wishbone.Interface) -> dict:
        return {"i_clk_i": ClockSignal(), "i_rst_i": ResetSignal(), "i_cyc_i": bus.cyc, "i_stb_i": bus.stb,
                "i_we_i": bus.we, "i_adr_i": bus.adr[:10], "i_dat_i": bus.dat_w, "i_sel_i": bus.sel,
                "o_ack_o": bus.ack, "o_dat_o": bus.dat_r, "o_stall_o": Signal()}


class SerialBridge:
    """The bus behind LiteX's UARTBone, for `quadrance.device`: a stream of bytes that reads and writes."""

    def __init__(self, stream: BinaryIO, base: int = 0) -> None:
        self.stream, self.base = stream, base

    def _send(self, command: int, address: int, data: bytes = b"") -> None:
        self.stream.write(bytes([command, 1]) + (self.base + address >> 2).to_bytes(4, "big") + data)
        self.stream.flush()

    def read(self, address: int) -> int:
        """The word at a byte address."""
        self._send(2, address)
        answer = self.stream.read(4)
        if len(answer) != 4:
            raise OSError(f"the bridge has not answered a read of {self.base + address:#010x}")
        return int.from_bytes(answer, "big")

    def write(self, address: int, word: int) -> None:
        """Write the word at a byte address."""
        self._send(1, address, word.to_bytes(4, "big"))
