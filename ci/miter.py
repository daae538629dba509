"""This module puts core and mutant into one netlist with an output that is 1 where they differ; ci/equivalence.py
proves that it is 0.

Multipliers and memories are cut out of both. What they give is an input instead, whatever it is: the same one for the
mutant where it gives the cell the same, and any other where it does not. What is written to a memory may not differ.
With `facts` three facts about them are used, which cost a proof time: a product with 0 is 0; a memory keeps the words
it begins with (a write to one of them would be a difference); and in one that begins with none what is written to
word 0 does not count, since what is read there may be anything.
"""

from __future__ import annotations

from dataclasses import dataclass

from quadrance.cores import Core

from ci import mutate

Ports = list[tuple[str, int]]  # name and width
CONTROL = 12_288  # bits of a memory that stays when nothing writes it: what a program never asks for cannot show
KEPT = 16  # words, at most, that a memory which is written may begin with


def module(design: dict) -> dict:
    """The one module with cells of Yosys' JSON."""
    (one,) = (one for one in design["modules"].values() if one["cells"])
    return one


def number(cell: dict, name: str) -> int:
    """A parameter of a cell."""
    return int(cell["parameters"][name], 2)


def to_cut(design: dict) -> set[str]:
    """The cells that make most of a graph, and that most mutants leave alone."""
    return {name for name, cell in module(design)["cells"].items() if cell["type"] == "$mul"
            or cell["type"] == "$mem_v2"
            and (number(cell, "WR_PORTS") or number(cell, "SIZE") * number(cell, "WIDTH") > CONTROL)}


@dataclass(frozen=True)
class Cell:
    """A cell that is cut out: the numbered ports `cut<number>_<port>` in its place, and how its results follow.

    taken, given : widths of what it takes and gives, by the cell's name of the port.
    reads : bits of an address and of a word, and whether it is clocked, of each read port of a memory.
    words : address and value of those that a memory begins with and keeps.
    """

    number: int
    taken: dict[str, int]
    given: dict[str, int]
    reads: tuple[tuple[int, int, bool], ...] = ()
    words: tuple[tuple[int, int], ...] = ()

    def port(self, name: str) -> str:
        return f"cut{self.number}_{name}"

    def ports(self, which: dict[str, int]) -> Ports:
        return [(self.port(name), width) for name, width in which.items()]

    def _differ(self, name: str, part: str = "") -> str:
        """Expression: the mutant gives the cell something else at this port than the core does."""
        return f"(g_{self.port(name)}{part} != m_{self.port(name)}{part})" if name in self.taken else "1'b0"

    def results(self, facts: bool) -> str:
        """Verilog of g_<port> and m_<port>, what the cell gives core and mutant; any_ and other_<port> are inputs."""
        ((name, width),) = self.given.items()
        out = self.port(name)
        text = f"  wire [{width - 1}:0] g_{out}, m_{out};\n"
        if self.reads:
            return text + "".join(self._read(out, index, facts) for index in range(len(self.reads)))
        other = f"{self._differ('A')} | {self._differ('B')}"
        for side, value in (("g", f"any_{out}"), ("m", f"{other} ? other_{out} : any_{out}")):
            if facts:
                a, b = (f"{side}_{self.port(one)}" for one in "AB")
                value = f"~(| {a}) | ~(| {b}) ? {width}'d0 : {value}"
            text += f"  assign {side}_{out} = {value};\n"
        return text

    def _read(self, out: str, index: int, facts: bool) -> str:
        """Verilog of one read port. A clocked one gives what was read last."""
        abits, bits, clocked = self.reads[index]
        at, place = f"[{bits * index} +: {bits}]", f"[{abits * index} +: {abits}]"
        part = f"[{index}]" if self.taken.get("RD_EN", 1) > 1 else ""
        enable = "{}_" + self.port("RD_EN") + part if "RD_EN" in self.taken else "1'b1"
        other = self._differ("RD_ADDR", place)
        if facts and "WR_DATA" in self.taken and not self.words:
            other = f"({other} | ~(| g_{self.port('RD_ADDR')}{place}))"
        text = ""
        if clocked:
            text += (f"  reg off_{out}_{index} = 0; always @(posedge clk) if ({enable.format('g')} | "
                     f"{enable.format('m')}) off_{out}_{index} <= {other} | {self._differ('RD_EN', part)};\n")
            other = f"off_{out}_{index}"
        for side, value in (("g", f"any_{out}{at}"), ("m", f"{other} ? other_{out}{at} : any_{out}{at}")):
            address, known = f"{side}_{self.port('RD_ADDR')}{place}", "1'b1"
            if clocked and facts and self.words:
                last, known = f"{side}_at_{out}_{index}", f"{side}_was_{out}_{index}"
                text += (f"  reg [{abits - 1}:0] {last} = 0; reg {known} = 0; always @(posedge clk) "
                         f"if ({enable.format(side)}) {{{known}, {last}}} <= {{1'b1, {address}}};\n")
                address = last
            for word, kept in self.words if facts else ():
                value = f"{known} & {address} == {abits}'d{word} ? {bits}'d{kept} : {value}"
            text += f"  assign {side}_{out}{at} = {value};\n"
        return text

    def watched(self, facts: bool) -> list[str]:
        """Expressions that may never be true, so that a memory has the same words in both."""
        if not self.reads:
            return []
        write, read = ("WR_ADDR", "WR_DATA"), ("RD_ADDR", "RD_EN")
        found = [self._differ(name) for name in self.taken if name not in (*write, *read)]
        if "WR_DATA" in self.taken:
            enable, address = (f"g_{self.port(name)}" for name in ("WR_EN", "WR_ADDR"))
            beside = f"(| {{{address}, m_{self.port('WR_ADDR')}}})" if facts and not self.words else "1'b1"
            found.append(f"((| {enable}) & {beside} & ({' | '.join(map(self._differ, write))}))")
            found += [f"((| {enable}) & {address} == {word})" for word, _ in self.words if facts]
        return found


def cut(design: dict, unused: set[str], names: set[str]) -> list[Cell]:
    """Take these cells out of Yosys' JSON; what replaces them.

    `unused` learns the ports that nobody looks at: the undefined clock of a memory without one. What is mutated there
    does not count.
    """
    one = module(design)
    cells = []
    for place, name in enumerate(sorted(names)):
        cell = one["cells"].pop(name)
        found = Cell(place, {}, {}, *_memory(cell))
        for port, bits in cell["connections"].items():
            name = found.port(port)
            if set(bits) <= {"x"}:  # or none
                unused.add(name)
            if name not in unused:
                gives = cell["port_directions"][port] == "output"
                (found.given if gives else found.taken)[port] = len(bits)
                one["ports"][name] = {"direction": "input" if gives else "output", "bits": bits}
        cells.append(found)
    return cells


def _memory(cell: dict) -> tuple[tuple[tuple[int, int, bool], ...], tuple[tuple[int, int], ...]]:
    """`Cell.reads` and `Cell.words`."""
    if cell["type"] != "$mem_v2":
        return (), ()
    ports, abits, width, size = (number(cell, name) for name in ("RD_PORTS", "ABITS", "WIDTH", "SIZE"))
    clocked, start = cell["parameters"]["RD_CLK_ENABLE"][::-1], cell["parameters"]["INIT"].rjust(size * width, "x")
    words = [start[len(start) - width * (i + 1):len(start) - width * i] for i in range(size)]
    first = number(cell, "OFFSET")
    kept = tuple((first + i, int(word, 2)) for i, word in enumerate(words) if set(word) <= {"0", "1"})
    return (tuple((abits, width, clocked[index] == "1") for index in range(ports)),
            kept if number(cell, "WR_PORTS") == 1 and len(kept) <= KEPT else ())


def miter(core: Core, bits: int, cells: list[Cell], facts: bool) -> str:
    """Core `g` and mutant `m`; output `bad` is 1 where they differ. `bits` of the input `mutant`, or 0."""
    inputs, results = mutate.ports(core), mutate.results(core)
    taken = [port for cell in cells for port in cell.ports(cell.taken)]
    given = [port for cell in cells for port in cell.ports(cell.given)]
    wires = "".join(f"  wire [{width - 1}:0] g_{name}, m_{name};\n" for name, width in [*results, *taken])
    wires += "".join(cell.results(facts) for cell in cells)
    differ = " | ".join(f"(g_{p.name} != m_{p.name})" for p in core.outputs)
    if core.clocked:
        wires += "  reg seen = 0; always @(posedge clk) if (rst) seen <= 1;\n"
        differ = ("seen & ~rst & ((g_in_ready != m_in_ready) | (g_out_valid != m_out_valid) "
                  f"| (g_out_valid & ({differ})))")
    differ = " | ".join([differ, *(expression for cell in cells for expression in cell.watched(facts))])
    chosen = [("mutant", bits)] * bool(bits)
    free = [(f"{kind}_{name}", width) for name, width in given for kind in ("any", "other")]
    own = [*given, *results, *taken]
    return (f"module miter({mutate.declared('input', [*chosen, *inputs, *free])}, output wire bad);\n{wires}"
            f"  {core.name} g({mutate.plugs(inputs)}, {mutate.plugs(own, 'g_')});\n"
            f"  mutants m({mutate.plugs([*chosen, *inputs])}, {mutate.plugs(own, 'm_')});\n"
            f"  assign bad = {differ};\nendmodule\n")
