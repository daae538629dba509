"""Bit-true model of kinematics_engine: commands, program memory, contexts, and each clock of the engine that plays.

The engine is modelled clock by clock, so that it answers as the hardware does for any line that can be loaded, sound or
not. What a sound program computes is `quadrance.program.meaning`; tests compare the two.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from quadrance.arith import root_slopes
from quadrance.fixed import Ints
from quadrance.program.product_engine import (
    ABOVE,
    CHECK,
    CLAMP,
    FAR,
    FOLD,
    HOLD,
    LAST,
    MORE,
    PORT,
    REGISTER,
    ROOT,
    WRIST,
    fields,
)

Params = dict[str, int]
WRITE, READ, RUN, INFO, LOAD, SEAL, LINE = range(7)  # in_kind; 7 is LINE as well
FORGET = 8  # of in_data for RUN: no direction is held
ENDS = 1 << 47  # of a line: it is the last one
H, N = 25, 27
NOTHING = fields(1 << 38 | 1 << 34)
SLOPES = root_slopes().tolist()


def _signed(word: int, bits: int = N) -> int:
    return (word & (1 << bits) - 1) - ((word >> bits - 1 & 1) << bits)


def crc16(crc: int, word: int, bits: int = 48) -> int:
    """The CRC x^16 + x^12 + x^5 + 1 after a word, the highest bit first."""
    for i in reversed(range(bits)):
        crc = crc << 1 & 0xFFFF ^ (0x1021 if (crc >> 15 ^ word >> i) & 1 else 0)
    return crc


@dataclass
class _Unit:
    """The root unit and the flags: seen magnitudes, factors of the root, what the acts of lines have found."""

    seen: int = 0
    w: int = 0
    slope: int = 0
    asked: int | None = None  # PIPE 0: the root's argument, looked up in the next clock
    none: bool = False
    one: bool = False
    long: bool = False
    minus: bool = False
    below: bool = False
    held: bool = False
    off: bool = False
    check: bool = False
    beyond: bool = False

    @property
    def power(self) -> int:
        return 1 << 26 - self.seen.bit_length() if self.seen else 0

    @property
    def four(self) -> int:
        """2^2j, 0 without a magnitude."""
        s = self.power.bit_length() - 1
        return 0 if s < 0 else 1 << 2 * (max(s - 1, 0) // 2)

    def look(self, q: int) -> None:
        """The two factors of the reciprocal root of q."""
        low = q & 0x1FF
        self.w = (q >> 9 & 0x7FF) << 10 | (low >> 8 ^ 1) << 9 | low >> 8 << 8 | ~low & 0xFF
        self.slope = SLOPES[q >> 9 & 0x3FF]

    @property
    def status(self) -> int:
        return (self.below or self.long) + 2 * self.held + 8 * self.off


def play(p: Params, program: list[int], registers: list[int], ports: list[int], signs: int, forget: bool) -> int:
    """Play the lines of a program on the registers of a context, which change.

    Returns
    -------
    status : out_status.
    """
    pipe, wrist, slack = p["PIPE"], 28 - p["U"], 29 - p["U"]
    late = 2 + pipe
    ops = [fields(word) for word in program]
    unit, kept, last_word = _Unit(), 4, 0
    unit.look(0)
    read: tuple[int, ...] = (0, 0, 0, 0)
    newer: tuple[bool, ...] = (False,) * 4
    waiting: list[tuple[dict[str, int], tuple[int, int, int, int], bool]] = []  # chosen, the oldest last
    idle = (NOTHING, (0, 0, 0, 0), False)
    for clock in range(len(ops) + late + 2):
        # the line that computes
        op, (a, b, c, d), skip = waiting.pop() if len(waiting) == 1 + pipe else idle
        first, second = _signed(a) * _signed(b), _signed(c) * _signed(d)
        low, mid = op["align"] & 1, op["align"] >> 1
        added = (first >> 22) + (second >> 22 ^ -op["subtract"])
        aligned = _signed(first) if low else _signed(first >> 12)
        if pipe == 2 and (low or mid):
            total = (aligned & (1 << N) - 1) * 8 + kept & 0xFFFFFFFF
            word = total >> 3 & (1 << N) - 1
        else:
            total = added + kept & 0xFFFFFFFF
            word = aligned & (1 << N) - 1 if low or mid else total >> 3 & (1 << N) - 1
        # the operands of the line behind
        if clock >= 1:
            one = ops[clock - 1] if clock - 1 < len(ops) else NOTHING
            waiting.insert(0, _chosen(one, read, newer, last_word, ports, word, unit, signs, forget))
        # its registers are read by the next one; with PIPE 2 it finds a word that is written meanwhile
        if clock < len(ops):
            names = [ops[clock][key] for key in "abcd"]
            read = tuple(registers[name] for name in names)
            newer = tuple(pipe == 2 and not skip and name == op["dest"] for name in names)
        _acted(p, unit, op["act"], low, mid, first, total, word, last_word, wrist, slack)
        if not skip:
            registers[op["dest"]] = word
        kept = total if op["keep"] else 4
        last_word = word
    registers[0] = 0  # lines that do nothing follow
    return unit.status


def _chosen(op: dict[str, int], read: tuple[int, ...], newer: tuple[bool, ...], before: int, ports: list[int],
            word: int, unit: _Unit, signs: int, forget: bool) -> tuple[dict[str, int], tuple[int, int, int, int], bool]:
    """The operands of a line in the clock after it has read, and whether its register keeps its word."""
    registers = [before if new else value for value, new in zip(read, newer)]
    a = {REGISTER: registers[0], PORT: ports[op["a"]], LAST: word}.get(op["from"], unit.w)
    b = registers[1]
    if op["by"]:
        kind = op["b"]
        if kind >> 5:
            b = (kind >> 2 & 1) << 26 | 1 << H
        elif kind >> 2 & 1:
            b = 0
        else:
            turned = (kind >> 3 & 3 and signs >> (kind >> 3 & 3) - 1 & 1) ^ unit.one
            twice = unit.four and 2 << unit.four.bit_length() // 2
            b = (unit.slope ^ -turned & (1 << N) - 1, unit.power, unit.four, twice)[kind & 3]
    c, d = (registers[2], registers[3]) if op["add"] else (0, 0)
    bound, lost = op["act"] & CLAMP and unit.long, op["act"] & HOLD and unit.none
    if bound or lost and forget:
        a = (1 << 26 if bound and unit.minus else 0) | (1 << H if bound or not op["dest"] & 1 else 0)
        b = 1 << H
    return op, (a, b, c, d), bool(lost and not forget)


def _acted(p: Params, unit: _Unit, act: int, low: int, mid: int, first: int, total: int, word: int, before: int,
           wrist: int, slack: int) -> None:
    """What the acts of a line do to the root unit and the flags."""
    negative = total >> 31
    if unit.check:
        folded = before & (1 << 26) - 1 ^ (-(before >> 26) & (1 << 26) - 1)
        unit.off |= unit.beyond or folded >> slack != 0
    near, over = act & CHECK and act & WRIST, act & CHECK and act & FAR
    unit.check, unit.beyond = bool(act & CHECK and not near and not over), total >> 29 not in (0, 7)
    if unit.asked is not None:
        unit.look(unit.asked)
        unit.asked = None
    empty, power = not unit.seen, unit.power
    if act & (FOLD | MORE):
        folded = word & (1 << 26) - 1 ^ (-(word >> 26) & (1 << 26) - 1)
        folded = folded >> wrist << wrist if act & WRIST else folded
        unit.seen = 0 if act & ABOVE and negative else folded if act & FOLD else unit.seen | folded
    unit.held |= bool(unit.none if act & HOLD else near and negative)
    if act & ROOT:
        unit.none, unit.one = empty, bool(low and power & 1)
        q = (total >> 10 if p["PIPE"] == 2 else first >> 7) & 0xFFFFF if low else total >> 12 & 0xFFFFF
        if p["PIPE"]:
            unit.look(q)
        else:
            unit.asked = q
    if act & ABOVE:
        unit.below |= bool(negative)
    elif act & FAR and not low and not over:
        unit.below |= unit.long
    if over:
        unit.long = bool(unit.long and unit.minus or negative)
    elif act & FAR:
        wide = bool(low and not -(1 << H) <= first >> 0 < 1 << H)
        unit.long, unit.minus = (unit.long or wide if low else not negative and total >> 29 & 3 != 0,
                                 bool(low and first < 0 and not unit.long))


@dataclass
class _State:
    lines: list[tuple[bool, bool, int]]  # sealed, header, word
    registers: list[list[int]]
    words: list[list[int]]
    ran: list[bool]
    at: int = 0
    kind: int = 0
    data: int = 0
    crc: int = 0
    loading: bool = False


def _state(p: Params) -> _State:
    count = p["CONTEXTS"]
    return _State([(False, False, 0)] * (1 << p["N"]), [[0] * 64 for _ in range(count)],
                  [[0] * 64 for _ in range(count)], [False] * count)


def _command(p: Params, state: _State, kind: int, context: int, at: int, data: int) -> tuple[int, ...]:
    """One command; out_word, out_version, out_crc, out_refused, out_status."""
    mask, lines = (1 << p["N"]) - 1, state.lines
    line, seal = kind >= LINE, kind == SEAL
    last = state.loading and state.kind & 2 and state.data & ENDS
    refused = line and not state.loading or seal and not last
    state.loading = kind == LOAD or line and state.loading
    state.at, state.kind, state.data, status = state.at + 1 & mask if line else at, kind, data, 0
    if kind == WRITE:
        state.words[context][at & 63] = data & (1 << N) - 1
    elif kind == RUN:
        refused, status = _run(p, state, context, data)
    elif kind >= LOAD:
        if not refused:
            lines[state.at] = (False, not line, data)
        state.crc = 0 if kind == LOAD else crc16(state.crc, lines[state.at][2])
        if seal and not refused:
            refused = state.crc != 0
            lines[state.at] = (not refused, True, data)
    sealed, _, word = lines[state.at]
    register = state.at & 63 | kind >> 1 & 1
    return (_signed(state.registers[context][register]) if state.ran[context] and register else 0, word >> 16,
            word & 0xFFFF, int(refused or kind == INFO and not sealed), status)


def _run(p: Params, state: _State, context: int, data: int) -> tuple[bool, int]:
    """Play the program at `state.at`: is it refused, and its status."""
    mask = (1 << p["N"]) - 1
    sealed = state.lines[state.at][0]
    state.at = state.at + 1 & mask
    if not sealed:
        return True, 0
    program, head = [], False
    while True:
        _, head, word = state.lines[state.at]
        state.at = state.at + 1 & mask
        if not head:
            program.append(word & ENDS - 1)
        if head or word & ENDS:
            break
    state.at = state.at + 1 & mask
    status = play(p, program, state.registers[context], state.words[context], data & 7,
                  bool(data & FORGET) or not state.ran[context])
    state.ran[context] = True
    return head, status


def kinematics_engine(p: Params, *, in_kind: Ints, in_context: Ints, in_at: Ints, in_data: Ints) -> dict[str, Ints]:
    """Answers to commands in their order after a reset."""
    state = _state(p)
    columns = np.broadcast_arrays(in_kind, in_context, in_at, in_data)
    rows = [_command(p, state, *row) for row in zip(*(np.ravel(one).tolist() for one in columns))]
    names = ("out_word", "out_version", "out_crc", "out_refused", "out_status")
    return {name: np.array(column, dtype=np.int64) for name, column in zip(names, zip(*rows))}
