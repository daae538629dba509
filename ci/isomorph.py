"""A netlist without its names: two that differ in the names of modules, instances, signals and files have one text.

Ports keep their names. Cells are numbered in the order in which a walk from the outputs towards the inputs meets them,
and written with their type, their parameters and the numbers of what they are wired to. The text says all of the
netlist, so two netlists of one text are the same circuit. Two netlists of one circuit may have two texts where cells
without outputs, assertions, cannot be told apart by what is around them: that costs a run, never a wrong result.
"""

from __future__ import annotations

import hashlib
import json

NAMES = {"MEMID", "FORMAT"}  # parameters that hold a name
LEFT_OUT = {"$scopeinfo"}
ROUNDS = 6  # of the neighbourhood that orders cells without outputs

Bit = int | str


def _short(text: object) -> str:
    return hashlib.sha256(repr(text).encode()).hexdigest()[:16]


def _pins(cell: dict, way: str) -> list[tuple[str, list[Bit]]]:
    ways = cell["port_directions"]
    return [(pin, bits) for pin, bits in sorted(cell["connections"].items()) if (ways[pin] == way)]


def _own(cell: dict) -> str:
    """What a cell is, whatever it is wired to."""
    params = {key: value for key, value in sorted(cell["parameters"].items()) if key not in NAMES}
    return json.dumps([cell["type"], params])


def text(module: dict) -> str:
    """A module of Yosys' JSON, flattened, without its names.

    Raises
    ------
    ValueError
        Where a cell has no directions: Yosys does not know its module.
    """
    cells = [cell for cell in module["cells"].values() if cell["type"] not in LEFT_OUT]
    for cell in cells:
        if missing := cell["connections"].keys() - cell.get("port_directions", {}).keys():
            raise ValueError(f"a cell {cell['type']} has no direction for {sorted(missing)[0]}")
    driver = {bit: (number, pin, i) for number, cell in enumerate(cells) for pin, bits in _pins(cell, "output")
              for i, bit in enumerate(bits)}
    ports = sorted(module["ports"].items())
    known: dict[Bit, str] = {bit: f"{name}[{i}]" for name, port in reversed(ports) if port["direction"] != "output"
                             for i, bit in enumerate(port["bits"])}
    first = {bit: value for net in module["netnames"].values() if "init" in net.get("attributes", {})
             for bit, value in zip(net["bits"], reversed(str(net["attributes"]["init"])))}
    number_of: dict[int, int] = {}
    order: list[int] = []

    def walk(bits: list[Bit]) -> None:
        stack = list(reversed(bits))
        while stack:
            bit = stack.pop()
            if isinstance(bit, str) or bit in known or bit not in driver:
                continue
            number = driver[bit][0]
            if number not in number_of:
                number_of[number] = len(order)
                order.append(number)
                stack += [one for _, wired in reversed(_pins(cells[number], "input")) for one in reversed(wired)]

    for _, port in ports:
        if port["direction"] != "input":
            walk(port["bits"])
    # what no output needs: assertions, and what is behind them
    rest = [number for number in range(len(cells)) if number not in number_of]
    if rest:
        label = [_own(cell) for cell in cells]
        for _ in range(ROUNDS):
            label = [_short([_own(cell), [[pin, [known.get(bit) or (bit if isinstance(bit, str) else (
                (label[driver[bit][0]], *driver[bit][1:]) if bit in driver else "open")) for bit in bits]]
                for pin, bits in _pins(cell, "input")]]) for cell in cells]
        for number in sorted(rest, key=lambda one: (bool(_pins(cells[one], "output")), label[one])):
            if number not in number_of:
                number_of[number] = len(order)
                order.append(number)
                walk([bit for _, wired in _pins(cells[number], "input") for bit in wired])
    loose: dict[Bit, str] = {}

    def wire(bit: Bit) -> str:
        if isinstance(bit, str):
            return bit
        start = f"={first[bit]}" if bit in first else ""
        if bit in known:
            return known[bit] + start
        if bit in driver:
            number, pin, i = driver[bit]
            return f"{number_of[number]}.{pin}[{i}]{start}"
        return loose.setdefault(bit, f"open{len(loose)}") + start  # driven by nothing

    lines = [json.dumps([name, port["direction"], [wire(bit) for bit in port["bits"]]]) for name, port in ports]
    lines += [json.dumps([_own(cells[number]), [[pin, [wire(bit) for bit in bits]] for pin, bits in
                                                _pins(cells[number], "input") + _pins(cells[number], "inout")],
                          [[pin, len(bits), [first.get(bit, "") for bit in bits]]
                           for pin, bits in _pins(cells[number], "output")]]) for number in order]
    return "\n".join(lines)


def digest(module: dict) -> str:
    """Digest of `text`."""
    return hashlib.sha256(text(module).encode()).hexdigest()[:24]
