"""Beats of an AXI-Stream wrapper, packed as the page of rtl/axis says, and a stream of them through Icarus.

Nothing here is the generator's: widths, places, extension and bit order are taken from the page and the core's ports.
"""

from __future__ import annotations

import subprocess
from collections.abc import Iterable
from pathlib import Path

import numpy as np
from quadrance.cores import Core, Port

from tb.lib import tools


def places(ports: Iterable[Port]) -> list[tuple[Port, int, int]]:
    """(port, its lowest bit, the bits it takes) of the fields of a beat: port order, whole bytes, from bit 0 on."""
    found, at = [], 0
    for port in ports:
        if port.name == "out_status":
            continue  # it is tuser
        bits = 8 * -(-port.width // 8)
        found.append((port, at, bits))
        at += bits
    return found


def size(ports: Iterable[Port]) -> int:
    """Bits of a beat."""
    return sum(bits for *_, bits in places(ports))


def sample(ports: tuple[Port, ...], words: dict[str, int], rng: np.random.Generator) -> int:
    """A beat of s_axis_tdata: the words, and anything in the bits that are not read."""
    beat = 0
    for port, at, bits in places(ports):
        unread = int(rng.integers(0, 1 << bits - port.width)) << port.width
        beat |= (int(words[port.name]) % (1 << port.width) | unread) << at
    return beat


def result(ports: tuple[Port, ...], words: dict[str, int]) -> int:
    """A beat of m_axis_tdata: two's complement over the whole bytes of a signed word, zeros above an unsigned one."""
    return sum(int(words[port.name]) % (1 << bits) << at for port, at, bits in places(ports))


BENCH = """
`timescale 1ns/1ps
module tb;
    reg aclk = 0, aresetn = 0, tvalid = 0, tready = 0;
    wire s_ready, m_valid;
    reg  [{n_in}-1:0] beats [0:{count}-1];
    wire [{n_out}-1:0] m_data;
    {user_wire}
    integer sent = 0, got = 0, clocks = 0, log;
    {top} #({params}) dut (.aclk(aclk), .aresetn(aresetn), {cfg}
        .s_axis_tvalid(tvalid), .s_axis_tready(s_ready), .s_axis_tdata(tvalid ? beats[sent] : {{{n_in}{{1'bx}}}}),
        .m_axis_tvalid(m_valid), .m_axis_tready(tready), .m_axis_tdata(m_data){user_pin});
    always #5 aclk = ~aclk;
    initial begin
        $readmemh("in.hex", beats);
        log = $fopen("out.txt");
    end
    always @(posedge aclk) begin
        clocks <= clocks + 1;
        aresetn <= clocks > 2;
        if (m_valid && tready) begin
            $fdisplay(log, "%b {user_format}", m_data{user_value});
            got = got + 1;
        end
        if (tvalid && s_ready) begin
            sent = sent + 1;
            tvalid <= 0;
        end
        if (aresetn && sent < {count} && (!tvalid || s_ready))
            tvalid <= $random % 4 != 0;
        tready <= $random % 3 != 0;
        if (got == {count} && clocks % 512 == 511 || clocks == {patience}) $finish;
    end
endmodule
"""


def through(core: Core, wrapper: str, folder: Path, beats: list[int], cfg: dict[str, int]) -> list[tuple[str, str]]:
    """tdata and tuser (bits as Icarus prints them) of every beat that the wrapper answers, with pauses at both ends."""
    folder.mkdir(parents=True, exist_ok=True)
    top = folder / f"axis_{core.name}.v"
    top.write_text(wrapper)
    n_in, user = size(core.inputs), core.status is not None
    (folder / "in.hex").write_text("\n".join(f"{beat:x}" for beat in beats))
    bench = folder / "tb.v"
    bench.write_text(BENCH.format(
        top=f"axis_{core.name}", n_in=n_in, n_out=size(core.outputs), count=len(beats),
        params=", ".join(f".{key}({value})" for key, value in core.params.items()),
        cfg="".join(f".{port.name}({port.width}'d{int(cfg[port.name]) % (1 << port.width)}), " for port in core.cfg),
        user_wire="wire [3:0] user;" if user else "", user_pin=", .m_axis_tuser(user)" if user else "",
        user_format="%b" if user else "-", user_value=", user" if user else "",
        patience=40 * (core.ii or 100) * len(beats)))
    said = tools.run("iverilog", "-g2005", "-Wall", "-s", "tb", "-o", folder / "tb.vvp", bench, top, *core.sources)
    assert "port" not in said.lower(), f"a port of {top.name} is not as wide as the page says:\n{said}"
    subprocess.run([tools.require("vvp"), "tb.vvp"], cwd=folder, check=True, env=tools.environment(),
                   stdout=subprocess.DEVNULL)
    return [tuple(line.split()) for line in (folder / "out.txt").read_text().splitlines()]
