"""This module writes the instance of a core in VHDL: its component, signals, and the map of ports."""

from __future__ import annotations

import re

from quadrance.arms import Arm
from quadrance.cli import verilog
from quadrance.cli.catalogue import Refused
from quadrance.cores import Core, Port

RESERVED = frozenset(  # words of VHDL that may be meant as the name of an instance
    "abs access after alias all and architecture array assert attribute begin block body buffer bus case component "
    "configuration constant context disconnect downto else elsif end entity exit file for force function generate "
    "generic group guarded if impure in inertial inout is label library linkage literal loop map mod nand new next nor "
    "not null of on open or others out package parameter port postponed procedure process protected pure range record "
    "register reject release rem report return rol ror select severity shared signal sla sll sra srl subtype then to "
    "transport type unaffected units until use variable wait when while with xnor xor".split())


def _kind(width: int) -> str:
    return f"std_logic_vector({width - 1} downto 0)"


def instance(core: Core, arm: Arm | None = None, name: str | None = None) -> str:
    """Component, signals and instantiation of a core, as they stand in an architecture; the words are those of
    `verilog.instance`. A port of one bit is a vector of one bit where the core declares it as one."""
    name = name or f"u_{core.name}"
    if not re.fullmatch(r"[A-Za-z](_?[A-Za-z0-9])*", name) or name.lower() in RESERVED:
        raise Refused(f"'{name}' is no name of an instance in VHDL: letters, digits and single _, a letter first")
    prefix = re.sub(r"^u_", "", name)
    words = verilog.config(core, arm) if arm is not None else {}
    ports: list[tuple[str, str, str]] = [("clk", "in", "std_logic"), ("rst", "in", "std_logic")] * core.clocked

    def add(way: str, group: tuple[Port, ...]) -> None:
        ports.extend((port.name, way, _type(core, port)) for port in group)

    add("in", core.cfg)
    for side, way, group in ((verilog.STREAM[:2], "in", core.inputs), (verilog.STREAM[2:], "out", core.outputs)):
        ports.extend((one, direction, "std_logic") for one, direction in side if core.clocked)
        add(way, group)
    component = [f"component {core.name}"]
    if core.params:
        values = [f"{key} : integer := {value}" for key, value in core.params.items()]
        component += ["  generic (", *_list(values)]
    component += ["  port (", *_list([f"{port} : {way} {kind}" for port, way, kind in ports]), "end component;"]
    signals = [f"signal {prefix}_{port} : {kind};" for port, _, kind in ports
               if port not in words and port not in ("clk", "rst")]
    widths = {port.name: port for port in core.cfg}
    joined = [f"{port} => {_literal(widths[port], words[port], kind)}" if port in words else
              f"{port} => {port if port in ('clk', 'rst') else f'{prefix}_{port}'}" for port, _, kind in ports]
    lines = [f"-- {line}".rstrip() for line in verilog.notes(core, arm)]
    lines += [*component, *signals, "", "-- behind begin:", f"{name} : {core.name}"]
    if core.params:
        lines += ["  generic map (", *_list([f"{key} => {value}" for key, value in core.params.items()], ",", ")")]
    return "\n".join([*lines, "  port map (", *_list(joined, ",")])


def _type(core: Core, port: Port) -> str:
    """A vector, but of a bit that the Verilog declares without a range."""
    plain = port.width == 1 and re.search(rf"\bwire +{port.name}\b|\breg +{port.name}\b",
                                          core.sources[0].read_text())
    return "std_logic" if plain else _kind(port.width)


def _literal(port: Port, value: int, kind: str) -> str:
    bits = f"{value & (1 << port.width) - 1:0{port.width}b}"
    return f"'{bits}'" if kind == "std_logic" else f'"{bits}"'


def _list(items: list[str], between: str = ";", end: str = ");") -> list[str]:
    return [f"    {item}{between if i + 1 < len(items) else end}" for i, item in enumerate(items)]
