"""This module puts a core behind registers on a bus: their map, the Verilog, and a description in SystemRDL.

The map is the same for every core: control words first, configuration from 0x100, a sample from 0x200, its result from
0x300. A word of more than 32 bits takes two or more registers, the lowest bits first.
"""

from __future__ import annotations

import json
import textwrap
import zlib
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

from quadrance.cli.catalogue import Refused, compile_order
from quadrance.cores import STATUS_BITS, Core, Port, module

VERSION = 0x0001_0000  # of the map: major, minor
CONTROL = {"ID": 0x000, "VERSION": 0x004, "START": 0x008, "STATE": 0x00C, "IRQ_ENABLE": 0x010}
BLOCKS = {"cfg": 0x100, "in": 0x200, "out": 0x300}  # byte address of the first word
ROOM = {"cfg": 64, "in": 64, "out": 256}  # words
SIZE = 0x1000  # bytes that the face decodes
BUSSES = {"axil": "AXI4-Lite", "wishbone": "Wishbone B4"}
STATE = {"busy": 0, "done": 1, "refused": 2, "outside": 3}  # bits; those of the status begin at 8
STATUS_LOW = 8


@dataclass(frozen=True)
class Word:
    """A register that holds bits of a port: ``low`` is the port's bit that stands at bit 0, of ``width`` bits."""

    name: str
    port: str
    kind: str  # of `BLOCKS`
    address: int
    low: int
    width: int
    signed: bool


def _data(core: Core) -> dict[str, tuple[Port, ...]]:
    """The ports that have registers, by block; the status stands in STATE."""
    return {"cfg": core.cfg, "in": core.inputs, "out": tuple(p for p in core.outputs if p.name != "out_status")}


def words(core: Core) -> list[Word]:
    """The registers of a core's ports, in port order.

    Raises
    ------
    Refused
        For a combinational core, which has no handshake, and for one with more words than a block has room for.
    """
    if not core.clocked:
        raise Refused(f"{core.name} is combinational: it has no handshake to start; connect its ports, "
                      f"quadrance instance {core.name}")
    found = []
    for kind, ports in _data(core).items():
        address = BLOCKS[kind]
        for port in ports:
            for low in range(0, port.width, 32):
                suffix = f"_{low // 32}" if port.width > 32 else ""
                found.append(Word(port.name + suffix, port.name, kind, address, low, min(32, port.width - low),
                                  port.signed))
                address += 4
        if address > BLOCKS[kind] + 4 * ROOM[kind]:
            raise Refused(f"{core.id}: its {kind} words take {(address - BLOCKS[kind]) // 4} registers, and the map "
                          f"has room for {ROOM[kind]}")
    return found


def identity(core: Core) -> int:
    """CRC-32 of the core's name, its parameters and its registers: a driver of another core or map finds another."""
    text = json.dumps([core.name, core.params, VERSION, core.status, [asdict(word) for word in words(core)]],
                      sort_keys=True)
    return zlib.crc32(text.encode())


def top(core: Core, bus: str) -> str:
    """The name of the module around the core."""
    return f"{bus}_{core.name}"


def _bits(high: int) -> str:
    return f"[{high - 1}:0] " if high > 1 else ""


def _slice(name: str, word: Word, width: int) -> str:
    """The bits of a port that a register holds."""
    return name if width == 1 else f"{name}[{word.low + word.width - 1}:{word.low}]"


def _extended(name: str, word: Word, width: int) -> str:
    """A register's 32 bits: those of the port, signed ones sign-extended, others with zeros above."""
    if word.width == 32:
        return _slice(name, word, width)
    above = f"{name}[{width - 1}]" if word.signed and width > 1 else name if word.signed else "1'b0"
    return f"{{{{{32 - word.width}{{{above}}}}}, {_slice(name, word, width)}}}"


AXIL = ("input  wire aclk", "input  wire aresetn", "input  wire s_axil_awvalid", "output wire s_axil_awready",
        "input  wire [11:0] s_axil_awaddr", "input  wire [2:0] s_axil_awprot", "input  wire s_axil_wvalid",
        "output wire s_axil_wready", "input  wire [31:0] s_axil_wdata", "input  wire [3:0] s_axil_wstrb",
        "output wire s_axil_bvalid", "input  wire s_axil_bready", "output wire [1:0] s_axil_bresp",
        "input  wire s_axil_arvalid", "output wire s_axil_arready", "input  wire [11:0] s_axil_araddr",
        "input  wire [2:0] s_axil_arprot", "output wire s_axil_rvalid", "input  wire s_axil_rready",
        "output wire [31:0] s_axil_rdata", "output wire [1:0] s_axil_rresp")
WISHBONE = ("input  wire clk_i", "input  wire rst_i", "input  wire cyc_i", "input  wire stb_i", "input  wire we_i",
            "input  wire [11:2] adr_i", "input  wire [31:0] dat_i", "input  wire [3:0] sel_i", "output wire ack_o",
            "output wire stall_o", "output wire [31:0] dat_o")
REGISTER_BUS = ("write", "whole", "waddr", "raddr", ("reg_wdata", "wdata"), ("reg_rdata", "rdata"))
FACES = {  # ports, clock, reset active high, pins of the face beside those of the register bus
    "axil": (AXIL, "aclk", "!aresetn", [(name.removeprefix("s_axil_"), name) for name in (
        port.split()[-1] for port in AXIL) if not name.endswith("prot")]),
    "wishbone": (WISHBONE, "clk_i", "rst_i", [
        ("clk", "clk_i"), ("rst", "rst_i"), ("cyc", "cyc_i"), ("stb", "stb_i"), ("we", "we_i"), ("adr", "adr_i"),
        ("dat_w", "dat_i"), ("sel", "sel_i"), ("ack", "ack_o"), ("stall", "stall_o"), ("dat_r", "dat_o")])}


def _select(name: str, addresses: list[int]) -> tuple[str, Callable[[int], str]]:
    """Few bits of a word's address that tell these apart, as an expression, and their value at each as a literal."""
    bits = list(range(9, -1, -1))
    for bit in range(9, -1, -1):
        fewer = sum(1 << one + 2 for one in bits if one != bit)
        if len({address & fewer for address in addresses}) == len(addresses):
            bits.remove(bit)

    def label(address: int) -> str:
        return f"{len(bits)}'b{''.join(str(address >> 2 + bit & 1) for bit in bits)}"

    return f"{{{', '.join(f'{name}[{bit}]' for bit in bits)}}}", label


def _instance(name: str, label: str, pins: list[tuple[str, str]], params: dict[str, int] | None = None) -> list[str]:
    """An instantiation, as lines of at most 120 characters."""
    values = ", ".join(f".{key}({value})" for key, value in (params or {}).items())
    lines = textwrap.wrap(f"{name} {f'#({values}) ' if values else ''}{label} (", 120, initial_indent="    ",
                          subsequent_indent="        ")
    line = "       "
    for i, (pin, signal) in enumerate(pins):
        text = f" .{pin}({signal}){',' if i + 1 < len(pins) else ');'}"
        if len(line) + len(text) > 120:
            lines.append(line)
            line = "       "
        line += text
    return [*lines, line]


def sources(bus: str, core_clock: bool = False) -> list[Path]:
    """The handwritten modules that stand around a core."""
    return [module(f"{bus}_face"), module("register_control"),
            module("register_crossing" if core_clock else "register_link")]


def _map_lines(core: Core) -> Iterator[str]:
    """The words of the map, one a line."""
    for word in words(core):
        bits = f": {word.low + word.width - 1}:{word.low} of {word.port}" if word.name != word.port else ""
        yield f"0x{word.address:03x} {word.name}, {'signed' if word.signed else 'unsigned'}, {word.width} bits{bits}"


def wrapper(core: Core, bus: str, core_clock: bool = False, readback: bool = True) -> str:
    """The text of ``<bus>_<core>.v``: a core at its parameters, its registers and the face of a bus.

    Parameters
    ----------
    bus : a key of `BUSSES`.
    core_clock : the core has a clock of its own, `core_clk`.
    readback : cfg and in can be read.
    """
    found = words(core)
    ports, clk, rst, face = FACES[bus]
    data = _data(core)
    values = ", ".join(f"{key}={value}" for key, value in core.params.items())
    lines = ["// SPDX-License-Identifier: Apache-2.0",
             f"// {core.name} behind {BUSSES[bus]}, 32 bits, 4 KB; generated by `quadrance registers`, do not edit."]
    lines += [f"// {values}"] * bool(values)
    lines += [f"// 0x{address:03x} {name}" for name, address in CONTROL.items()]
    lines += [f"// {line}" for line in _map_lines(core)]
    lines += ["`default_nettype none", f"module {top(core, bus)} ("]
    ports = [*ports, *["input  wire core_clk"] * core_clock, "output wire irq"]
    lines += [f"    {port}{',' if i + 1 < len(ports) else ''}" for i, port in enumerate(ports)] + [");"]
    held = [*data["out"], *(port for port in core.outputs if port.name == "out_status")]
    lines += [f"    reg  {_bits(port.width)}{port.name};" for port in (*data["cfg"], *data["in"], *held)]
    lines += [f"    wire {_bits(port.width)}new_{port.name[4:]};" for port in held]
    lines += ["    wire write, whole, put, start, busy, capture, finished, done, refused, outside, irq_enable;",
              "    wire in_valid, in_ready, out_valid, out_ready;", "    wire [9:0] waddr, raddr;",
              "    wire [31:0] wdata;", "    reg  [31:0] rdata;", f"    wire clk = {clk};", f"    wire rst = {rst};"]
    lines += ["    wire core_rst;"] * core_clock
    lines += _instance(f"{bus}_face", "face", [*face, *(
        one if isinstance(one, tuple) else (one, one) for one in REGISTER_BUS)])
    counts = {kind: sum(word.kind == kind for word in found) for kind in BLOCKS}
    k = max(3, (max(counts["cfg"], counts["in"]) - 1).bit_length())
    pins = ["clk", "rst", "write", "whole", "waddr", "busy", "finished", "start", "put", "done", "refused", "outside",
            "irq_enable", "irq"]
    lines += _instance("register_control", "control", [*((name, name) for name in pins), ("wdata", "wdata[3:1]"),
                                                       ("enable", "wdata[0]")],
                       {"CFG": counts["cfg"], "IN": counts["in"], "K": k})
    link = ["clk", "rst", "start", "busy", "capture", "finished", *["core_clk", "core_rst"] * core_clock, "in_valid",
            "in_ready", "out_valid", "out_ready"]
    lines += _instance("register_crossing" if core_clock else "register_link", "link", [(one, one) for one in link])
    widths = {port.name: port.width for port in (*core.cfg, *core.inputs, *core.outputs)}
    taken = [word for word in found if word.kind != "out"]
    lines += ["    always @(posedge clk) begin", "        if (put)",
              f"            case ({{waddr[7:6], waddr[{k - 1}:0]}})"]
    lines += [f"                {{2'd{word.address >> 8}, {k}'d{word.address >> 2 & (1 << k) - 1}}}: "
              f"{_slice(word.port, word, widths[word.port])} <= "
              f"wdata[{word.width - 1}:0];".replace("[0:0]", "[0]") for word in taken]
    lines += ["                default: ;", "            endcase", "        if (capture) begin"]
    lines += [f"            {port.name} <= new_{port.name[4:]};" for port in held]
    lines += ["        end", *["        if (rst) out_status <= 4'd0;"] * (core.status is not None), "    end"]
    status = "20'd0, out_status, 4'd0" if core.status is not None else "28'd0"
    rows = [(CONTROL["STATE"], f"{{{status}, outside, refused, done, busy}}")]
    rows += [(word.address, _extended(word.port, word, widths[word.port])) for word in found
             if readback or word.kind == "out"]
    rows += [(CONTROL["IRQ_ENABLE"], "{31'd0, irq_enable}")] * readback
    rows += [(CONTROL["ID"], f"32'h{identity(core):08x}"), (CONTROL["VERSION"], f"32'h{VERSION:08x}")]
    bits = (len(rows) - 1).bit_length()
    select, label = _select("raddr", [address for address, _ in rows])
    lines += [f"    reg  [{bits - 1}:0] chosen;", "    always @*", f"        case ({select})"]
    lines += [f"            {label(address)}: chosen = {bits}'d{i};" for i, (address, _) in enumerate(rows)]
    lines += [f"            default: chosen = {bits}'d{len(rows) - 1};", "        endcase"]
    lines += ["    always @*", "        case (chosen)"]
    lines += [f"            {bits}'d{i}: rdata = {text};" for i, (_, text) in enumerate(rows[:-1])]
    lines += [f"            default: rdata = {rows[-1][1]};", "        endcase"]
    lines += _instance(core.name, "core", [
        ("clk", "core_clk" if core_clock else "clk"), ("rst", "core_rst" if core_clock else "rst"),
        *((port.name, port.name) for port in core.cfg), ("in_valid", "in_valid"), ("in_ready", "in_ready"),
        *((port.name, port.name) for port in core.inputs), ("out_valid", "out_valid"), ("out_ready", "out_ready"),
        *((port.name, f"new_{port.name[4:]}") for port in core.outputs)], core.params)
    unused = ["waddr, raddr, wdata, irq_enable", *(["s_axil_awprot", "s_axil_arprot"] if bus == "axil" else [])]
    return "\n".join([*lines, f"    wire unused = &{{1'b0, {', '.join(unused)}}};", "endmodule",
                      "`default_nettype wire"]) + "\n"


def described(core: Core, cfg: dict[str, int]) -> dict:
    """The map as `quadrance.device` reads it, with the configuration words of an arm where there are some."""
    return {"core": core.name, "params": core.params, "id": identity(core), "version": VERSION, "size": SIZE,
            "control": CONTROL, "status": {name: STATUS_BITS[name] for name in core.status or ()},
            "words": [asdict(word) for word in words(core)], "cfg": cfg}


def rdl(core: Core, readback: bool = True) -> str:
    """The map in SystemRDL 2.0, for documents and for other people's generators."""
    def field(name: str, high: int, low: int, access: str, reset: str = "") -> str:
        return f"field {{ {access} }} {name}[{high}:{low}]{f' = {reset}' if reset else ''};"

    def register(name: str, address: int, text: str, *fields: str) -> str:
        return f'    reg {{ desc = "{text}"; {" ".join(fields)} }} {name} @ 0x{address:03X};'

    reads, writes = "sw = r; hw = w;", f"sw = {'rw' if readback else 'w'}; hw = r;"
    clears = "sw = rw; hw = w; woclr;"
    state = [field("busy", 0, 0, reads), *(field(name, bit, bit, clears) for name, bit in STATE.items() if bit)]
    state += [field(name, STATUS_LOW + bit, STATUS_LOW + bit, reads)
              for name, bit in ((name, STATUS_BITS[name]) for name in core.status or ())]
    lines = [f"addrmap {core.name} {{", f'    name = "{core.id}";',
             '    desc = "One sample at a time: write in, write START, wait for done, read out.";',
             "    default regwidth = 32; default accesswidth = 32;",
             register("ID", CONTROL["ID"], "CRC-32 of core, parameters and map",
                      field("id", 31, 0, "sw = r; hw = na;", f"0x{identity(core):08x}")),
             register("VERSION", CONTROL["VERSION"], "of the map: major 31:16, minor 15:0",
                      field("version", 31, 0, "sw = r; hw = na;", f"0x{VERSION:08x}")),
             register("START", CONTROL["START"], "a write of any value starts a sample",
                      field("start", 0, 0, "sw = w; hw = r; singlepulse;", "0")),
             register("STATE", CONTROL["STATE"], "bits 1 to 3 are cleared by a write of 1", *state),
             register("IRQ_ENABLE", CONTROL["IRQ_ENABLE"], "irq is high while done and this are 1",
                      field("done", 0, 0, writes, "0"))]
    for word in words(core):
        text = f"{word.port}, bits {word.low + word.width - 1}:{word.low}, {'signed' if word.signed else 'unsigned'}"
        lines.append(register(word.name, word.address, text,
                              field("value", word.width - 1, 0, reads if word.kind == "out" else writes)))
    return "\n".join([*lines, "};"]) + "\n"


def constraints(core: Core, bus: str) -> dict[str, str]:
    """Timing constraints of `core_clk`, by the name of the file: for Vivado and for Quartus.

    No data path may take longer than one period of the clock that reads it; the crossing gives it two.
    """
    clk = FACES[bus][1]
    there = (["link/go", "link/clear", "in_*", *["cfg_*"] * bool(core.cfg)], "core_clk")
    back = (["out_*", "link/bus_clear", "link/bus_answer"], clk)
    head = f"# {top(core, bus)}: no path between {clk} and core_clk takes longer than a period of the clock that reads"

    def vivado(names: list[str]) -> str:
        return "[get_cells {" + " ".join(f"{name}{'' if name.endswith('*') else '_reg*'}" for name in names) + "}]"

    def quartus(names: list[str]) -> str:
        paths = (f"*{top(core, bus)}*|{name.replace('/', '|').rstrip('*')}*" for name in names)
        return f"[get_registers {{{' '.join(paths)}}}]"

    period = "[get_property -min PERIOD [get_clocks -of_objects [get_ports {}]]]"
    xdc = [head, f"# read_xdc -ref {top(core, bus)} {top(core, bus)}.xdc",
           f"set_max_delay -datapath_only -from {vivado(there[0])} -to [get_clocks -of_objects [get_ports core_clk]] "
           + period.format("core_clk"),
           f"set_max_delay -datapath_only -from [get_clocks -of_objects [get_ports core_clk]] -to {vivado(back[0])} "
           + period.format(clk)]
    sdc = [head, "# the two clocks stand in set_clock_groups -asynchronous of the design",
           f"# the name of the instance has {top(core, bus)} in it", *(
             f"set_net_delay -max -get_value_from_clock_period dst_clock_period -value_multiplier 0.8 {side} {names}"
             for side, names in (("-from", quartus(there[0])), ("-to", quartus(back[0]))))]
    return {f"{top(core, bus)}.xdc": "\n".join(xdc) + "\n", f"{top(core, bus)}.sdc": "\n".join(sdc) + "\n"}


def files(core: Core, bus: str, cfg: dict[str, int], core_clock: bool = False,
          readback: bool = True) -> dict[str, str]:
    """Everything a design needs, by the name of the file: the core's Verilog and that around it, and the map."""
    found = {path.name: path.read_text() for path in (*compile_order(core), *sources(bus, core_clock))}
    found |= {f"{top(core, bus)}.v": wrapper(core, bus, core_clock, readback), f"{core.name}.rdl": rdl(core, readback),
              f"{core.name}.json": json.dumps(described(core, cfg), indent=1) + "\n"}
    return found | (constraints(core, bus) if core_clock else {})
