"""This module finds the registers of a core that a memory word reaches; a contract proof knows nothing about those.

The registers of a program in a memory have one value for each age of a sample, as control has, but follow from words
that the proof leaves free. What was observed of them is left out. The proof then has fewer lemmas, but proves the same.
"""

from __future__ import annotations

import json
import re
from pathlib import Path

from quadrance.cores import Core

BLOCK = re.compile(r"    \(\* hierconn \*\) wire \[\d+:0\] \\dut\.(\S+) ;\n    always @\* if \(live\) case \(age\)\n"
                   r".*?    endcase\n", re.S)


def reached(module: dict) -> set[str]:
    """Names of the nets that hold a bit which a memory word reaches, through logic and registers; clocks apart."""
    users: dict[int, list[dict]] = {}
    for cell in module["cells"].values():
        for port, bits in cell["connections"].items():
            if cell["port_directions"][port] == "input" and port != "CLK":
                for bit in bits:
                    users.setdefault(bit, []).append(cell)
    todo = [cell for cell in module["cells"].values() if cell["type"].startswith("$mem")]
    seen, known = set(), set(map(id, todo))
    while todo:
        cell = todo.pop()
        for port, bits in cell["connections"].items():
            if cell["port_directions"][port] == "output":
                seen |= set(bits)
                fresh = [user for bit in bits for user in users.get(bit, ()) if id(user) not in known]
                known |= set(map(id, fresh))
                todo += {id(user): user for user in fresh}.values()
    return {name for name, net in module["netnames"].items() if not seen.isdisjoint(net["bits"])}


def leave_out(core: Core, work: Path) -> None:
    """Rewrite the module to prove without what was observed of registers that a memory word reaches."""
    module = json.loads((work / "nets.json").read_text())["modules"][core.name]
    names, top = reached(module), work / "top.sv"
    top.write_text(BLOCK.sub(lambda block: "" if block[1] in names else block[0], top.read_text()))
