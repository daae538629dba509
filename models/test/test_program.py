"""Programs of equations: what a text means, what is refused and why, ranges, lines and their order."""

import contextlib
import importlib
import io
import json
import re
import tempfile
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from quadrance import six, truth_six, ur
from quadrance.cli import main
from quadrance.cores import ROOT, RTL, find
from quadrance.fixed import wrap
from quadrance.kinematics_engine import READ, RUN, kinematics_engine
from quadrance.program import assembler, image, lines, meaning, parser, ranges, schedule, table
from quadrance.program.language import Wrong

PROGRAMS = sorted((RTL / "program").glob("*.kin"))
EACH = pytest.mark.parametrize("path", PROGRAMS, ids=lambda path: path.stem)
P = {"W": 16, "F": 8, "U": 16}
SMALL = (ROOT / "docs" / "programs.md").read_text().split("```")[1].lstrip()  # the page's example


def read(text):
    return parser.parse(text, Path("my.kin"))


def refusal(text):
    with pytest.raises(Wrong) as caught:
        program = read(text)
        ranges.proved(program)
        assembler.assemble(program, seconds=1)
    message = str(caught.value)
    assert "\n" not in message and message.startswith("my.kin")
    return message


# What is refused

ERRORS = {
    "an undefined name": (("u = x - a", "u = x - b"), "my.kin:5: b is not defined"),
    "a word before it is there": (("u = x - a", "u = c - a"), "my.kin:5: c is not defined"),
    "a word that is never used": (("u = x - a", "u = x - a\nv = x + a"), "my.kin:6: v is never used"),
    "an input that is never used": (("cfg length a", "cfg length a b"), "b is never used"),
    "a word given twice": (("u = x - a", "u = x - a\nu = x + a"), "my.kin:6: u is given twice"),
    "an input declared twice": (("coordinate x y", "coordinate x y x"), "my.kin:2: x is declared twice"),
    "a result without a statement": (("out vector c n", "out vector c n w"), "w is a result, and no statement"),
    "no result": (("out vector c n\n", ""), "c is never used"),
    "a range that is not proved": (("u = x - a", "u = x - a + x + x + y"),
                                   "my.kin:5: the range of u is not proved: -2.500 to 2.500"),
    "a root of what may be negative": (("u = x - a", "v = x - a\nu = root v"),
                                       "the range of v is not proved: -1.000 to 1.000, and an argument of a root"),
    "an unknown format": (("coordinate", "integer"), "my.kin:2: vector or coordinate or velocity or length"),
    "a symbol": (("x - a", "x % a"), "my.kin:5: '%' has no meaning here"),
    "a call": (("x - a", "exit(1)"), "my.kin:5: '(' is too much"),
    "a name that is none": (("u = x - a", "U = x - a"), "my.kin:5: 'U' is no name"),
    "a long name": (("u = x - a", f"{'u' * 13} = x - a"), "is no name"),
    "a word of the language": (("u = x - a", "root = x - a"), "'root' is a word of the language and no name"),
    "a name of the table": (("u = x - a", "low = x - a\nu = low"), "low is a name of the printed table"),
    "an end too soon": (("u = x - a", "u = x -"), "my.kin:5: more is expected at the end"),
    "one word of a direction": (("c, n = unit", "c = unit"), "my.kin:6: unit gives two words, cosine and sine"),
    "two words of a sum": (("u = x - a", "u, v = x - a"), "one name is expected before = of a sum"),
    "a sign too many": (("u = x - a", "u = x - a\nw = root u + -"), "1 names and 2 signs of a root"),
    "a norm of a word": (("u = x - a", "u = x - a\nnorm u <= 1"), "norm speaks of inputs alone"),
    "four argued words": (("u = x - a", "u = x - a\nargue u c n y <= 1"), "more than 3 words are argued"),
    "a loop without lines": (("u = x - a", "for s in a b:\nu = x - a"), "my.kin:5: a loop without lines"),
    "a loop that is none": (("u = x - a", "for s = 1 to 8:\n    u = x - a"), "my.kin:5: a loop is 'for NAME in VALUE"),
    "a name that no loop gives": (("u = x - a", "u{s} = x - a"), "my.kin:5: no loop gives {s}"),
    "a tab": (("u = x - a", "\tu = x - a"), "my.kin:5: a tab: lines are indented by spaces"),
    "a long line": (("u = x - a", f"u = x - a # {'-' * 160}"), "my.kin:5: more than 160 columns"),
    "a long sum": (("u = x - a", f"u = x {'- a' * 12}"), "my.kin:5: a sum of more than 12 terms"),
    "a second reach": (("u = x - a", "reach v = x*x\nreach w = a*a\nu = root v\nm = root w\ncheck m"),
                       "my.kin:6: a second reach: the status bit"),
    "a quotient by a sum": (("u = x - a", "u = (x) / a*x"), "'*' is too much"),
    "a quotient beside a reach": (("u = x - a", "reach q = x*x\nw = root q\nu = (w) / a"),
                                  "my.kin:7: a quotient beside reach or clamp"),
    "a clamp without a power": (("u = x - a", "u = clamp (x*x) * a * a"), "a is no input of format fraction"),
    "a reach that a sum reads": (("u = x - a", "reach u = x*a"), "my.kin:5: u is of reach: one root reads it"),
    "an input that is emitted": (("out vector c n\n", "emit x\n"), "x is an input, and a word of a statement"),
    "a minus beside signs": (("u = x - a", "sign s\nw = x*a\nu, v = root w s -\ncheck v"),
                             "my.kin:7: a minus beside sign inputs"),
    "a direction held twice": (("u = x - a", "u = x - a\nd, m = unit (y, u) hold c\ncheck d*m"),
                               "my.kin:8: a second direction of c: the status bit"),
    "a power as a factor": (("cfg length a", "cfg power a"), "a is a power of two, which clamp alone multiplies by"),
    "out and emit": (("u = x - a", "u = x - a\nemit u"), "results are held in registers or given one after the other"),
    "held words apart": (("out vector c n", "out vector n c"), "my.kin: c and n are held"),
}


@pytest.mark.parametrize("name", ERRORS)
def test_each_error_names_file_line_and_reason(name):
    (old, new), says = ERRORS[name]
    assert old in SMALL
    assert says in refusal(SMALL.replace(old, new))


# What a text uses


def folder(path, **texts):
    """Texts of programs in a folder; the one of my.kin."""
    for name, text in texts.items():
        (path / f"{name}.kin").write_text(text)
    parser.load.cache_clear()
    return parser.load(path / "my.kin")


def test_a_text_begins_with_what_it_uses(tmp_path):
    """The same words, ports, order of results and lines as if it were one text."""
    more = "cfg coordinate m=margin\nnorm a <= 0.3\nnear c (u*u - m*m)\n"
    program = folder(tmp_path, base=SMALL, my=f"use base\n{more}")
    whole = read(SMALL + more)
    assert lines.lines(program) == lines.lines(whole) and program.inputs == whole.inputs
    assert (program.norms, program.results, program.order, program.signs) == (
        whole.norms, whole.results, whole.order, whole.signs)
    path = tmp_path / "my.kin"
    assert main(["assemble", str(path), "--seconds", "0.1", "--write"]) == 0
    (tmp_path / "base.kin").write_text(SMALL.replace("u = x - a", "u = x + a"))
    parser.load.cache_clear()
    assert "my_program.v: stale" in table.stale(tmp_path)[-1]
    parser.load.cache_clear()


def test_margins_change_no_word_of_what_their_text_uses():
    plain, edged = parser.load(six.INVERSE), parser.load(six.NEAR)
    assert [one.text for one in edged.statements[:len(plain.statements)]] == [one.text for one in plain.statements]
    assert {one.kind for one in edged.statements[len(plain.statements):]} == {"sum", "near", "far"}
    assert (edged.results, edged.order, edged.signs) == (plain.results, plain.order, plain.signs)


USES = {
    "use behind a statement": ({"my": f"{SMALL}use base\n", "base": SMALL}, "my.kin:7: use comes before all else"),
    **{f"use behind {line.split()[0]}": ({"my": f"{line}\nuse base\n", "base": SMALL}, "my.kin:2: use comes before")
       for line in ("sign back", "order a, b", "argue u <= 1", "in length z")},
    "use twice": ({"my": "use base\nuse base\n", "base": SMALL}, "my.kin:2: use comes before all else, once"),
    "a text that is not there": ({"my": "use none\n"}, "my.kin:1: use: .*none.kin: cannot be read: No such file"),
    "a path": ({"my": "use ../base\n"}, "my.kin:1: the name of one text is expected after use"),
    "two names": ({"my": "use base other\n"}, "my.kin:1: the name of one text is expected after use"),
    "no name": ({"my": "use\n"}, "my.kin:1: the name of one text is expected after use"),
    "itself": ({"my": "use my\n"}, "my.kin:1: my.kin uses itself"),
    "a circle": ({"my": "use base\n", "base": "use my\n"}, "my.kin:1: use: base.kin:1: my.kin uses itself"),
    "a text with an error": ({"my": "use base\n", "base": SMALL.replace("- a", "- b")},
                             "my.kin:1: use: base.kin:5: b is not defined"),
    "a word of the other text": ({"my": "use base\nu = x\n", "base": SMALL}, "my.kin:2: u is given twice"),
    "an input of the other text": ({"my": "use base\ncfg length a\n", "base": SMALL}, "my.kin:2: a is declared twice"),
    "five deep": ({"my": "use b\n", **{one: f"use {two}\n" for one, two in zip("bcde", "cdef")}, "f": SMALL},
                  "more than 4 texts that use one another"),
}


@pytest.mark.parametrize("name", USES)
def test_a_wrong_use_names_file_line_and_reason(name, tmp_path):
    texts, says = USES[name]
    with pytest.raises(Wrong, match=says) as caught:
        folder(tmp_path, **texts)
    parser.load.cache_clear()
    assert "\n" not in str(caught.value) and str(caught.value).startswith("my.kin:")


def test_a_range_of_what_is_used_is_an_error_of_the_line(tmp_path):
    program = folder(tmp_path, base=SMALL.replace("x - a", "x - a + x + x + y"), my="# more\nuse base\n")
    with pytest.raises(Wrong, match="my.kin:2: the range of u is not proved"):
        ranges.proved(program)
    parser.load.cache_clear()


def test_too_many_registers_are_refused():
    names = [f"v{i}" for i in range(70)]
    text = "in coordinate x y\nout vector c n\n" + "".join(f"{name} = x*y\n" for name in names)
    at = 0
    while len(names) > 1:  # a tree of sums: all first words live at once if the sums come last
        names, rest = [f"s{at}x{i}" for i in range(-(-len(names) // 12))], names
        text += "".join(f"{name} = {' + '.join(rest[12 * i:12 * i + 12])}\n" for i, name in enumerate(names))
        at += 1
    program = read(text + f"c, n = unit ({names[0]}, x)\n")
    made = lines.lines(program)
    order = list(range(len(made)))
    spread = [i for i in order for i in (i, None, None, None)]  # every line long after the one before it
    found = schedule.rules(program, made, schedule.timing())
    found.joined.clear()
    with pytest.raises(Wrong, match="too many registers"):
        assembler.allocated(program, made, spread)


SLOW = {
    "loops": "".join(f"{'    ' * i}for a{i} in {' '.join(map(str, range(16)))}:\n" for i in range(4)) + "    " * 4
             + "u{a0} = x\n",
    "many statements": "".join(f"u{i} = x\n" for i in range(1100)),
    "much text": "# more\n" * 20_000,
    "deep loops": "".join(f"{'    ' * i}for a{i} in b:\n" for i in range(9)) + "    " * 9 + "u = x\n",
    "many lines": "".join(f"u{i} = {' + '.join(['x'] * 12)}\n" for i in range(60)),
    "long proofs": "".join(
        f"u{i} = {' + '.join(f'u{j}*v{j}' for j in range(max(i - 12, 0), i)) or 'x'}\n"
        f"v{i} = {' + '.join(f'v{j}*u{j}' for j in range(max(i - 12, 0), i)) or 'y'}\n" for i in range(200)),
}


@pytest.mark.parametrize("name", SLOW)
@pytest.mark.timeout(60)
def test_a_text_made_to_be_slow_is_refused(name):
    refusal("in coordinate x y\nout vector c n\n" + SLOW[name] + "c, n = unit (x, y)\n")


def test_circles_and_programs_of_others_are_no_order():
    program = read(SMALL)
    made = lines.lines(program)
    found = schedule.rules(program, made, schedule.timing())
    order = assembler.assemble(program, seconds=1).order
    assert not schedule.faults(found, made, order)
    assert "is not one of these" in schedule.faults(found, made, order[:-1])[0]
    with pytest.raises(Wrong, match="my.kin: order: .* lines after"):
        assembler.assemble(program, order=order[::-1])


# What it means


def test_a_direction_in_both_arithmetics():
    """Bit-true words are those of the real numbers; where there is no direction the last one is held."""
    program = read(SMALL)
    x, y = np.array([0, 100, -300, 16, 7]), np.array([0, 100, 400, 0, -24])
    a = np.full(5, 16 << 4)
    found = meaning.answer(program, P, in_x=x, in_y=y, cfg_a=a)
    real = meaning.real(program, {"x": x / 2**16, "y": y / 2**16, "a": a / 2**20})
    assert np.array_equal(found["out_status"], [0, 0, 0, 2, 0])
    assert found["out_c"][3] == found["out_c"][2] and found["out_n"][3] == found["out_n"][2]
    for name in "cn":
        want = np.where([0, 0, 0, 1, 0], np.roll(real.words[name], 1), real.words[name])
        assert np.abs(found[f"out_{name}"] - want * 2**16).max() < 1.6
    assert real.none["c"].tolist() == [False, False, False, True, False]


def test_before_the_first_direction_it_is_1_0():
    found = meaning.answer(read(SMALL), P, in_x=np.array([16]), in_y=np.array([0]), cfg_a=np.array([256]))
    assert found["out_c"][0] == 1 << 16 and found["out_n"][0] == 0 and found["out_status"][0] == 2


@pytest.mark.parametrize("robot", truth_six.known())
def test_float64_of_the_six_axis_texts_is_the_chain_of_matrices(robot):
    """Forward against 4 x 4 matrices, inverse back to the pose on all branches, by values without words."""
    arm, mm = truth_six.load(robot)
    unit = type(arm)(*(length / mm for length in arm))
    q = np.random.default_rng(4).uniform(-np.pi, np.pi, (3000, 6))
    rotation, tip = truth_six.fk6(q, unit)
    scale = 2.0 ** -(P["W"] - P["F"])  # 1.0 of a word in units
    forward = {f"{letter}{i}": turn(q[:, i - 1]) for i in range(1, 7)
               for letter, turn in (("c", np.cos), ("n", np.sin))}
    forward |= {name: getattr(unit, name) * scale for name in ("a1", "a2", "b")}
    forward |= {f"l{i}": getattr(unit, f"c{i}") * scale for i in range(1, 5)}
    found = meaning.real(parser.load(six.FORWARD), forward).words
    for i in range(3):
        assert np.abs(found["xyz"[i]] / scale - tip[:, i]).max() < 1e-9 * np.abs(tip).max()
        assert all(np.abs(found[f"r{i + 1}{j + 1}"] - rotation[:, i, j]).max() < 1e-12 for j in range(3))
    k = np.hypot(unit.a2, unit.c3)
    inverse = {f"r{i + 1}{j + 1}": rotation[:, i, j] for i in range(3) for j in range(3)}
    inverse |= {axis: tip[:, i] * scale for i, axis in enumerate("xyz")}
    inverse |= {"a1": unit.a1 * scale, "b": unit.b * scale, "l1": unit.c1 * scale, "l2": unit.c2 * scale,
                "l4": unit.c4 * scale, "k": k * scale, "cp": unit.c3 / k, "np": unit.a2 / k,
                "r": 1 / (2 * unit.c2 * k * scale**2) / 64, "e": 64.0}
    for branch in range(8):
        outcome = meaning.real(parser.load(six.INVERSE), inverse, branch)
        words = outcome.words
        angles = np.stack([np.arctan2(words[f"n{i}"], words[f"c{i}"]) for i in range(1, 7)], axis=-1)
        good = ~outcome.far & ~np.any(list(outcome.none.values()), axis=0)
        again = truth_six.fk6(angles[good], unit)
        assert good.sum() > 1000 and not outcome.wrong.any()
        assert np.abs(again[1] - tip[good]).max() < 1e-5 * np.abs(tip).max()
        assert np.abs(again[0] - rotation[good]).max() < 1e-6


def test_the_eight_branches_are_those_of_the_program_of_one():
    """Each word of vector_ik6_all.kin in every bit, with the directions that its branches hold from one another."""
    rng, n = np.random.default_rng(8), 3000
    arm, mm = truth_six.load("kr6_r700")
    cfg = six.config(P, **{name: length / mm for name, length in arm._asdict().items()})
    q = rng.uniform(-np.pi, np.pi, (n, 6))
    q[::7, 4] = 0
    rotation, tip = truth_six.fk6(q, arm)
    ports = {f"in_r{i + 1}{j + 1}": np.rint(rotation[:, i, j] * 2**16).astype(int) for i in range(3) for j in range(3)}
    ports |= {f"in_{axis}": np.rint(tip[:, i] / mm * 256).astype(int) for i, axis in enumerate("xyz")}
    ports["in_x"][::11] = ports["in_y"][::11] = 0
    for axis in "xy":  # the wrist's centre on axis 1
        row = "xy".index(axis)
        ports[f"in_{axis}"][::5] = np.rint(arm.c4 / mm * 256 * rotation[::5, row, 2])
    found = six.ik6_all(P, **ports, **cfg)
    assert (found["out_held"] > 0).sum() > 100
    order = 0, 2, 1, 3  # in which they hold directions
    ports = {name: np.repeat(word, 4) for name, word in ports.items()}
    one = six.ik6(P, **ports, **cfg, in_branch=np.resize(order, 4 * n))
    for at, branch in enumerate(order):
        for i in range(1, 7):
            for letter in "cn":
                word = one[f"out_{letter}{i}"][at::4]
                assert np.array_equal(found[f"out_{letter}{i}{branch}"], word), (letter, i, branch)
                minus = i in (4, 6) or letter + str(i) == "n5"  # a word of n + 1/2 is rounded upward, its negative too
                assert np.abs(found[f"out_{letter}{i}{branch + 4}"] - (-word if minus else word)).max() <= minus
        for bit, name in enumerate(("far", "held")):
            told = one["out_status"][at::4] >> bit & 1
            assert all(np.array_equal(found[f"out_{name}"] >> mine & 1, told) for mine in (branch, branch + 4))


# Ranges


@EACH
def test_no_word_leaves_the_range_that_is_proved(path):
    """Float64 words of random inputs at the ends of their formats and norms, signs included."""
    program = parser.load(path)
    found, rng, n = ranges.proved(program), np.random.default_rng(6), 20_000
    inputs = {name: rng.choice([low, high, 0.0], n) if port.format != "vector" else None
              for name, port in program.inputs.items() for low, high in [found[name]]}
    inputs = {name: np.where(rng.random(n) < 0.5, rng.uniform(*found[name], n), value) if value is not None else None
              for name, value in inputs.items()}
    if "r11" in program.inputs:
        matrix = np.linalg.qr(rng.normal(size=(n, 3, 3)))[0]
        inputs |= {f"r{i + 1}{j + 1}": matrix[:, i, j] for i in range(3) for j in range(3)}
    for i in (*range(1, 7), "a", "b", "c", "s"):
        if f"c{i}" in program.inputs:
            angle = rng.choice(8, n) * np.pi / 4 + rng.normal(size=n) * rng.choice([0, 1], n)
            inputs |= {f"c{i}": np.cos(angle), f"n{i}": np.sin(angle)}
    for names, limit in program.norms:
        if not any(program.inputs[name].format == "vector" for name in names):
            length = np.sqrt(sum(inputs[name]**2 for name in names))
            inputs |= {name: inputs[name] / np.maximum(1, length / limit) for name in names}
    outcome = meaning.real(program, inputs, rng.integers(0, 8, n))
    words, regular = outcome.words, np.ones(n, bool)
    if program.argued:  # a range is argued for samples whose results fit their words
        regular = ~np.any([outcome.far | ~regular, *(np.abs(words[port.name]) > 0.5 for port in program.results
                                                     if port.format != "vector")], axis=0)
        assert regular.sum() > 100
    for name, (low, high) in found.items():
        if name in words:
            word = np.broadcast_to(words[name], n)[regular]
            assert np.all((word >= low - 1e-6) & (word <= high + 1e-6)), name
    widest = max(np.abs(words[name]).max() for name in found if name in words and name not in program.inputs)
    assert widest > 1.2  # the samples reach far


@pytest.mark.parametrize(("old", "new", "says"), [
    ("near c1 (", "near c4 (", "c4 is no direction that is held"),
    ("far c3 (", "far c5 (", "c5 is no word of clamp above this line"),
    ("near c2 (", "near c1 (", "a second near of c1"),
    ("near c2 (k2*k2 - m*m)", "near c2 k2*k2", "( is expected at k2")])
def test_what_margins_speak_of(old, new, says):
    text = ur.INVERSE.read_text()
    assert text.count(old) == 1 and says in refusal(text.replace(old, new))


def test_a_matrix_that_is_longer_than_its_norm_is_refused():
    text = six.INVERSE.read_text().replace("norm l4 <= 0.28", "norm l4 <= 0.5")
    assert "the range of q is not proved: 0.000 to 1.496, and an argument of a root" in refusal(text)


# Lines and their order


@EACH
def test_the_checker_accepts_what_is_assembled(path):
    one = assembler.assembled(path)
    assert assembler.problems(one) == []


@pytest.mark.parametrize("path", [
    pytest.param(path, id=path.stem, marks=[pytest.mark.slow] * path.stem.endswith("_all")) for path in PROGRAMS])
def test_an_order_that_the_rules_refuse_the_checker_refuses_too(path):
    """Lines moved by some places: what the rules allow the checker accepts, and what they forbid it refuses.

    It cannot see the order of results, of their flags and of directions that hold one another's word, of which root a
    factor is meant to be, and parts of a sum that are exchanged with one another.
    """
    one, found = assembler.assembled(path), [0, 0]
    for at in range(len(one.order)):
        for far in (1, 2, 7):
            order = [*one.order]
            order.insert(at + far, order.pop(at))
            bad = schedule.faults(one.rules, one.lines, order)
            unseen = [text for text in bad if "at once" in text or "the results while" in text or "last line" in text
                      or re.search("held direction|1 / root. comes|lines after .* [012] are needed", text)]
            numbers = {name: one.numbers[name] for name in one.numbers}
            moved = replace(one, order=order, numbers=numbers, rows=assembler._rows(one.lines, order, one.rules))
            if not bad:
                registers = assembler.allocated(one.program, one.lines, order)
                moved.numbers.update({assembler._cell(name): number for name, number in registers.items()})
            if not unseen:
                assert bool(bad) == bool(assembler.problems(moved)), (at, far, bad, assembler.problems(moved))
                found[bool(bad)] += 1
    assert min(found) > min(10, len(one.order) // 8)


@pytest.mark.parametrize("pipe", [0, 1, 2])
def test_without_ortools_the_list_scheduler_gives_an_order(pipe, monkeypatch):
    program = parser.load(six.INVERSE)
    monkeypatch.setattr(assembler, "solved", lambda *given: None)
    one = assembler.assemble(program, pipe)
    least = (89, 105, 125)[pipe]
    assert not schedule.faults(one.rules, one.lines, one.order) and least <= len(one.order) <= least * 1.25


def test_the_model_of_a_core_is_its_text(monkeypatch):
    """A slip in the text is one in the model: bench and truth would see it."""
    core = find("vector_fk6")
    text = six.FORWARD.read_text().replace("r32 = r13*r21 - r23*r11", "r32 = r13*r21 - r23*r12")
    monkeypatch.setattr(importlib.import_module("quadrance.six").parser, "load", lambda path: parser.parse(text, path))
    ports = {port.name: np.array([port.high // 3, port.high]) for port in (*core.cfg, *core.inputs)}
    slipped = core.model(core.params, **ports)
    monkeypatch.undo()
    right = core.model(core.params, **ports)
    assert [name for name in right if not np.array_equal(right[name], slipped[name])] == ["out_r32"]


# The command


def test_the_command_prints_and_writes(tmp_path, capsys):
    path = tmp_path / "my.kin"
    path.write_text(SMALL)
    assert main(["assemble", str(path), "--seconds", "1"]) == 0
    out = capsys.readouterr().out
    assert "module my_program" in out and "c = Cg * Cu" in out and "every word within its range" in out
    assert list(tmp_path.iterdir()) == [path]
    assert main(["assemble", str(path), "--seconds", "1", "--write"]) == 0
    assert table.stale(tmp_path) == []
    written = path.read_text()
    assert written.startswith(SMALL) and sorted(tmp_path.iterdir()) == [path, tmp_path / "my_program.v"]
    assert main(["assemble", str(path), "--write"]) == 0 and path.read_text() == written
    for odd in ("# pipe 0: 1 0 x", "# mine", "check c*c - n*n"):  # nobody's line is lost
        path.write_text(f"{written}{odd}\n")
        parser.load.cache_clear()
        for write in ([], ["--write"]):
            assert main(["assemble", str(path), *write]) == 2
            assert f"my.kin: '{odd}' stands behind the order" in capsys.readouterr().err
        assert path.read_text() == f"{written}{odd}\n"


@pytest.mark.parametrize("name", ["my_program.v"])
def test_a_table_replaces_a_table_alone(name, tmp_path, capsys):
    """Where it is another's file, the text is left as it is too."""
    path = tmp_path / "my.kin"
    path.write_text(SMALL)
    (tmp_path / name).write_text("# mine\n")
    for _ in range(2):
        assert main(["assemble", str(path), "--seconds", "1", "--write"]) == 2
        assert f"{name} is not of `quadrance assemble`, and is not overwritten" in capsys.readouterr().err
        assert sorted(tmp_path.iterdir()) == sorted([path, tmp_path / name])
        assert (tmp_path / name).read_text() == "# mine\n" and path.read_text() == SMALL
    (tmp_path / name).unlink()
    for _ in range(2):
        assert main(["assemble", str(path), "--seconds", "1", "--write"]) == 0
    assert table.stale(tmp_path) == []


def test_a_new_text_gets_new_orders(tmp_path, capsys):
    """An order of another text is refused, also where it only guides; --write looks for new ones, of every PIPE."""
    path = tmp_path / "my.kin"
    path.write_text(SMALL)
    for pipe in "012":
        assert main(["assemble", str(path), "--seconds", "0.1", "--pipe", pipe, "--write"]) == 0
    longer = path.read_text().replace("u = x - a", "u = x - a\nv = y*a\nw = v*a\nz = w*a").replace("(u, y)", "(u, z)")
    path.write_text(longer)
    parser.load.cache_clear()
    before = {one: one.read_bytes() for one in tmp_path.iterdir()}
    for pipe in "012":
        assert main(["assemble", str(path), "--seconds", "0.1", "--pipe", pipe]) == 2
        assert "my.kin: the order is not one of these 12 lines\n" in capsys.readouterr().err
    assert before == {one: one.read_bytes() for one in tmp_path.iterdir()}
    text = path.read_text()
    path.write_text(text.replace("8 - 7", "99 - 7", 1).partition("# pipe 1")[0])
    assert main(["assemble", str(path), "--seconds", "0.1", "--pipe", "1"]) == 2
    path.write_text(text)
    assert main(["assemble", str(path), "--seconds", "0.1", "--pipe", "1", "--write"]) == 0
    assert table.stale(tmp_path) == [] and assembler.orders(parser.load(path)) == [0, 1, 2]


def test_an_image_replaces_an_image_alone(tmp_path, capsys):
    """Not its own text, nor another file; a text that is no file, or has no end, is not read."""
    path = tmp_path / "my.kin"
    path.write_text(SMALL)
    for name in ("my.json", "my.h"):
        for _ in range(2):
            assert main(["assemble", str(path), "--image", str(tmp_path / name)]) == 0
        (tmp_path / name).write_text("[1]" if name == "my.json" else "/* mine */")
        assert main(["assemble", str(path), "--image", str(tmp_path / name)]) == 2
        assert f"{name} is no image, and is not overwritten" in capsys.readouterr().err
        assert (tmp_path / name).read_text() in ("[1]", "/* mine */")
    assert main(["assemble", str(path), "--image", str(path)]) == 2 and path.read_text() == SMALL
    for odd in ("/dev/zero", str(tmp_path)):
        assert main(["assemble", odd]) == 2 and "cannot be read: " in capsys.readouterr().err.split("\n")[-2]


def test_a_wrong_program_overwrites_nothing(tmp_path, capsys):
    path = tmp_path / "my.kin"
    path.write_text(SMALL.replace("- a", "- b"))
    (tmp_path / "my_program.v").write_text("mine")
    assert main(["assemble", str(path), "--write"]) == 2
    assert capsys.readouterr().err == "quadrance: my.kin:5: b is not defined\n"
    assert (tmp_path / "my_program.v").read_text() == "mine" and assembler.ORDER not in path.read_text()
    for name, says in (("none.kin", "cannot be read"), ("my-own.kin", "my-own.kin:1: the name of the file is the")):
        if "-" in name:
            (tmp_path / name).write_text(SMALL)
        assert main(["assemble", str(tmp_path / name)]) == 2
        assert says in capsys.readouterr().err


def test_a_changed_text_order_or_table_is_stale(tmp_path):
    for path in (six.FORWARD, table.table_path(six.FORWARD)):
        (tmp_path / path.name).write_text(path.read_text())
    assert table.stale(tmp_path) == []
    text, module = (tmp_path / name for name in ("vector_fk6.kin", "vector_fk6_program.v"))
    for path, change in ((text, lambda t: t.replace("e3 = c6*m5", "e3 = n6*m5")),
                         (module, lambda t: t.replace("U1, ", "E1, ", 1)),
                         (module, lambda t: swapped(t, "/* t = c5*c4", "/* s = c5*n4")),
                         (text, lambda t: t.replace("pipe 0: 3 4", "pipe 0: 4 3")),
                         (text, lambda t: t.replace("pipe 0: 3 4", "pipe 0: 41 4"))):
        before = path.read_text()
        assert change(before) != before
        path.write_text(change(before))
        parser.load.cache_clear()
        assert len(table.stale(tmp_path)) == 1, path
        path.write_text(before)
        parser.load.cache_clear()
    text.write_text(text.read_text().partition(assembler.ORDER)[0])
    assert "no order is committed" in table.stale(tmp_path)[0]


def swapped(text, one, two):
    rows = text.splitlines(keepends=True)
    i, j = (next(n for n, row in enumerate(rows) if row.strip().startswith(start)) for start in (one, two))
    rows[i], rows[j] = rows[j], rows[i]
    return "".join(rows)


# Fuzz

WORDS = (
    "in", "cfg", "sign", "norm", "argue", "out", "order", "reach", "check", "near", "far", "emit", "flags", "both",
    "for", "root", "unit", "clamp", "wrist", "hold", "keep", "one", "vector", "coordinate", "length", "word", "power",
    "fraction", "velocity", "x", "y", "p", "c0", "n0", "s0", "k0", "low", "+", "-", "*", "/", "=", "(", ")", ",", "<=",
    "{s}", "for s in x y:", "\n", "\n    ", "\t", "#", "1", "0.25", "9" * 400, ".", "1e9", "\0", "é", "٣", "\u2028",
    "x*" * 40, "x" * 200, "{", "}", ":", "--", "%s", "__import__('os')", "\\", "\r", "\ufeff")


@st.composite
def meant(draw):
    """A text that mostly is a program: sums, directions and a root, clamp or quotient; all words are read."""
    head = ["in coordinate x y z", "in vector c n", "norm c n <= 1.0001", "cfg length p q"]
    inputs, words, results, body = ["x", "y", "z", "p", "q", "c", "n"], [], [], ["e = p*q", "d = e*e"]

    def some(most):
        products = draw(st.lists(st.lists(st.sampled_from(inputs), min_size=1, max_size=2), min_size=1, max_size=most))
        parts = [f"{draw(st.sampled_from('+-'))} {'*'.join(one)}" for one in products]
        return " ".join(parts).removeprefix("+ ")

    if signed := draw(st.booleans()):
        head.append("sign u")
    for i in range(draw(st.integers(0, 4))):
        body.append(f"s{i} = {some(3)}")
        words.append(f"s{i}")
    kind = draw(st.sampled_from(("", "reach", "clamp", "quotient")))
    if kind == "clamp":
        head += ["cfg fraction f", "cfg power w"]
    body += {"": [], "reach": ["reach g = x*x - y*y", f"h = root g{' u' * signed}"],
             "clamp": [f"h = clamp ({some(2)}) * f * w"], "quotient": [f"h = ({some(2)}) / p"]}[kind]
    words += ["h"] * bool(kind)
    for i in range(draw(st.integers(1, 3))):
        how = draw(st.sampled_from(("", " wrist", " hold", " wrist hold")))
        body.append(f"c{i}, n{i} = unit ({some(3)}, {some(2)}){' u' * (signed and draw(st.booleans()))}{how}")
        results += [f"c{i}", f"n{i}"]
    body += [f"check {some(3)}" for _ in range(draw(st.integers(0, 1)))]
    if signed and " u" not in "".join(body):
        head.pop(4)
    out = f"out vector {' '.join(results)} t"
    return "\n".join([*head, out, *body, "t = " + " + ".join(f"d*{one}" for one in [*inputs, *words][:12]), ""])


@st.composite
def mangled(draw):
    """Such a text, one of the library or none at all, with some changes of its lines, words and bytes."""
    text = draw(st.one_of(meant(), st.sampled_from([SMALL, *(path.read_text() for path in PROGRAMS[-2:])])))
    for _ in range(draw(st.integers(0, 4))):
        rows, how = text.split("\n"), draw(st.integers(0, 5))
        at = draw(st.integers(0, max(len(rows) - 1, 0)))
        if how == 0:
            rows[at:at + 1] = [rows[at]] * draw(st.sampled_from((0, 2)))
        elif how == 1:
            rows.insert(draw(st.integers(0, len(rows))), rows.pop(at))
        elif how < 5 and (found := list(re.finditer(r"\w+|[^\w\s]", rows[at]))):
            spot = draw(st.sampled_from(found))
            new = draw(st.sampled_from(WORDS)) if draw(st.booleans()) else draw(st.sampled_from(found))[0]
            rows[at] = rows[at][:spot.start()] + new + rows[at][spot.end() if how < 4 else spot.start():]
        else:
            rows[at] = draw(st.text(max_size=12))
        text = "\n".join(rows)
    return text


def plays(program, made):
    """The kinematics engine answers an image as its text says, at random words, in every bit."""
    rng, count = np.random.default_rng(1), 4
    words = {}
    for name, port in program.inputs.items():
        any_ = rng.integers(-(1 << 23), 1 << 23, count)
        words[name] = {"power": rng.integers(0, 8, count), "fraction": np.abs(any_)}.get(port.format, any_)
        words[name][count // 2] = 0
    signs, commands = rng.integers(0, 8, count), image.load(made)
    for i in range(count):
        commands += [*image.inputs(made, 0, {port.port: words[name][i] for name, port in program.inputs.items()}),
                     image.run(made, 0, int(signs[i])), *image.outputs(made, 0)]
    p = {"N": 10, "CONTEXTS": 1, "U": 16, "PIPE": made["pipe"]}
    found = kinematics_engine(p, **image.columns(commands))
    kinds = np.array([command[0] for command in commands])
    said = meaning.walked(program, meaning.Fixed(meaning.floor(p), meaning.slack(p)), words,
                          {name: signs >> i & 1 for i, name in enumerate(program.signs)})
    want = np.array([np.broadcast_to(wrap(said.words[port.name], 27), count) for port in program.results]).T
    read = found["out_word"][kinds == READ].reshape(count, -1)
    return not found["out_refused"].any() and np.array_equal(read, want) and np.array_equal(
        found["out_status"][kinds == RUN], np.broadcast_to(said.status, count))


@st.composite
def orders(draw):
    """The order of SMALL with some words changed, put in or left out, or bytes of any kind."""
    rows = [assembler.ORDER, "# pipe 0: 2 0 1 - 4 3 - - 5 - - 6 8 - 7",
            "# pipe 1: 2 0 1 - - 4 3 - - - 5 - - 6 - 8 - 7", ""]
    if draw(st.integers(0, 5)) == 0:
        return draw(st.binary(max_size=40))
    words = [row.split(" ") for row in rows[:2] + rows[2 + draw(st.integers(0, 1)):]]
    for _ in range(draw(st.integers(0, 3))):
        row = draw(st.sampled_from(words))
        at = draw(st.integers(0, len(row)))
        new = draw(st.sampled_from(("-", "0", "3", "8", "9", "-1", "99", "9" * 5000, "pipe", "0:", "1:", "٣", "²", "",
                                    "#", "x", "\n", "\0", "1.", "0x1", "- " * 3000)))
        row[at:at + draw(st.integers(0, 1))] = draw(st.sampled_from(([new], [])))
    code = draw(st.sampled_from(("utf-8", "utf-8", "utf-8", "utf-16", "latin-1")))
    return "\n".join(" ".join(row) for row in words).encode(code, "replace")


def ordered(order, pipe, write):
    """An order behind a text is taken where it is right, or refused in a line, and then nothing is written."""
    with tempfile.TemporaryDirectory() as folder:
        path, out, err = Path(folder) / "my.kin", io.StringIO(), io.StringIO()
        path.write_bytes(before := SMALL.encode() + b"\n" + order)
        parser.load.cache_clear()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = main(["assemble", str(path), "--seconds", "0.01", "--pipe", str(pipe), *["--write"] * write])
        if code:
            assert code == 2 and not out.getvalue() and err.getvalue().count("\n") == 1
            assert err.getvalue().startswith("quadrance: ") and [*Path(folder).iterdir()] == [path]
            assert path.read_bytes() == before
        else:
            assert not write or table.stale(Path(folder)) == []
            assert re.search(r"^module my_program #\(", out.getvalue(), re.M)


@pytest.mark.parametrize("examples", [40, pytest.param(10_000, marks=[pytest.mark.slow, pytest.mark.timeout(7200)])])
def test_a_foreign_order_is_right_or_refused(examples):
    settings(max_examples=examples, deadline=None)(given(orders(), st.integers(0, 2), st.booleans())(ordered))()


def right_or_refused(text, pipe, accepted=None):
    """A text is refused in a line and nothing is written, or its image plays as the text says; neither takes long."""
    with tempfile.TemporaryDirectory() as folder:
        path, made = Path(folder) / "my.kin", Path(folder) / "my.json"
        path.write_bytes(text if isinstance(text, bytes) else text.encode("utf-8", "surrogatepass"))
        (path.with_name("my_program.v")).write_text("mine")
        before, out, err = path.read_bytes(), io.StringIO(), io.StringIO()
        since = time.process_time()
        parser.load.cache_clear()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = main(["assemble", str(path), "--seconds", "0.01", "--pipe", str(pipe), "--image", str(made)])
        assert time.process_time() - since < 20, "it is slow"
        assert path.read_bytes() == before and path.with_name("my_program.v").read_text() == "mine"
        assert code in (0, 2) and made.exists() == (code == 0)
        if code:
            assert not out.getvalue() and err.getvalue().startswith("quadrance: ") and err.getvalue().count("\n") == 1
        else:
            assert plays(parser.load(path), json.loads(made.read_text()))
        if accepted is not None:
            accepted.append(not code)


@st.composite
def torn(draw):
    """Bytes of any kind, or those of such a text, some changed, left out or put in, or its end torn off."""
    if draw(st.integers(0, 4)) == 0:
        return draw(st.binary(max_size=60))
    found = draw(meant()).encode(draw(st.sampled_from(("utf-8", "utf-8", "utf-8", "utf-8-sig", "utf-16"))))
    for _ in range(draw(st.integers(0, 2))):
        at, how = draw(st.integers(0, len(found))), draw(st.integers(0, 3))
        new = b"" if how == 0 else draw(st.sampled_from([*BYTES, *(bytes([one]) for one in b"+-*/=(),<.#09 xn\n")]))
        found = found[:at] + new + (b"" if how == 3 else found[at + (how < 2):])
    return found


BYTES = (b"\0", b"\xff", b"\xfe\xff", b"\xc3", b"\xed\xa0\x80", b"\xf4\x90\x80\x80", b"\x1b[2J", b"\r", b"\x0c",
         b"\x85", b"\xc2\x85", b"\x7f", b"\xe2\x80\xa8", b"\xd9\xa3", b"\xc2\xa0")


@pytest.mark.parametrize("examples", [40, pytest.param(10_000, marks=[pytest.mark.slow, pytest.mark.timeout(7200)])])
@pytest.mark.parametrize("strategy", [meant(), mangled(), torn()], ids=("meant", "mangled", "bytes"))
def test_a_foreign_text_is_right_or_refused(strategy, examples):
    accepted = []
    settings(max_examples=examples, deadline=None)(given(strategy, st.integers(0, 2))(
        lambda text, pipe: right_or_refused(text, pipe, accepted)))()
    print(f"{sum(accepted)} of {len(accepted)} accepted")
