"""The kinematics engine: images of programs, what it answers against what their texts say, loads that it refuses."""

import json
from functools import cache

import numpy as np
import pytest
from quadrance.cores import ROOT, RTL
from quadrance.fixed import wrap
from quadrance.kinematics_engine import ENDS, INFO, LINE, READ, RUN, SEAL, WRITE, crc16, kinematics_engine
from quadrance.product_engine import ONE
from quadrance.program import assembler, image, meaning, parser
from quadrance.program.language import Wrong

P = {"N": 10, "CONTEXTS": 4, "U": 16, "PIPE": 1}
FLAGGED = {"reach", "clamp", "quotient", "check"}  # statements of a text that set a flag
PROGRAMS = [path for path in sorted((RTL / "program").glob("*.kin")) if not parser.load(path).streamed]


@cache
def assembled(name, pipe):
    return assembler.assembled(RTL / "program" / f"{name}.kin", pipe)


def answers(commands, p=P):
    return kinematics_engine(p, **image.columns(commands))


def tiny():
    """Five lines that write one input to registers 2 to 6."""
    line = 1 << 45 | 0b1100000 << 32
    lines = [line | register << 9 for register in range(2, 7)]
    lines[-1] |= ENDS
    header = 7 << 16 | image.binascii.crc_hqx((7).to_bytes(4, "big"), image.crc(lines))
    return {"start": 9, "header": f"{header:012x}", "lines": [f"{word:012x}" for word in lines]}


# Programs


@pytest.mark.parametrize("pipe", (0, 1, 2))
@pytest.mark.parametrize("path", PROGRAMS, ids=lambda path: path.stem)
def test_a_program_computes_what_its_text_says(path, pipe):
    """Any words within the norms of the text, in two contexts in turn, every sign: results and status, bit by bit."""
    rng, one = np.random.default_rng(5), assembled(path.stem, pipe)
    program, made = one.program, image.image(one, start=64, version=3)
    count, p = 24, P | {"PIPE": pipe}
    inputs = {port.port: rng.uniform(-0.25, 0.25, count) * 2**25 for port in program.inputs.values()}
    inputs = {name: np.rint(words).astype(np.int64) for name, words in inputs.items()}
    inputs |= {port.port: rng.integers(0, 1 << 8, count) for port in program.inputs.values() if port.format == "power"}
    for port in program.inputs.values():
        if port.format == "fraction":
            inputs[port.port] = np.abs(inputs[port.port])
    inputs = {name: np.where(np.arange(count) % 8 == 2, 0, words) for name, words in inputs.items()}  # no directions
    signs = rng.integers(0, 8, count)
    commands = image.load(made)
    for i in range(count):
        commands += [*image.inputs(made, i % 2, {name: words[i] for name, words in inputs.items()}),
                     image.run(made, i % 2, int(signs[i])), *image.outputs(made, i % 2)]
    found = answers(commands, p)
    assert not np.any(found["out_refused"])
    kinds = np.array([command[0] for command in commands])
    read = found["out_word"][kinds == READ].reshape(count, -1)
    status = found["out_status"][kinds == RUN]
    for context in (0, 1):
        mine = np.arange(count) % 2 == context
        names = {port.port: name for name, port in program.inputs.items()}
        words = {names[port]: value[mine] for port, value in inputs.items()}
        said = meaning.walked(program, meaning.Fixed(meaning.floor(p), meaning.slack(p)), words,
                              {name: signs[mine] >> i & 1 for i, name in enumerate(program.signs)})
        for column, port in enumerate(program.results):
            np.testing.assert_array_equal(read[mine, column], wrap(said.words[port.name], 27), err_msg=port.name)
        assert np.all(status[mine] == said.status)
    assert status.any() == any(one.hold or one.kind in FLAGGED for one in program.statements)


def test_a_program_of_the_page_is_read_back():
    """Version and CRC of the header; the CRC of lines and header together is 0."""
    made = image.image(assembled("vector_fk6", 1), start=100, version=0xDEADBEEF)
    found = answers([*image.load(made), (INFO, 0, 100, 0)])
    assert (found["out_version"][-1], found["out_crc"][-1], found["out_refused"][-1]) == (0xDEADBEEF,
                                                                                         int(made["crc"], 16), 0)
    words = [int(word, 16) for word in (*made["lines"], made["header"])]
    crc = 0
    for word in words:
        crc = crc16(crc, word)
    assert image.crc(words) == crc == 0
    assert json.loads(json.dumps(made)) == made


def test_programs_share_the_memory():
    """Every program of the library that is not streamed, one behind the other in 1024 lines; each still runs."""
    start, commands, starts = 0, [], []
    for path in PROGRAMS:
        made = image.image(assembled(path.stem, 1), start)
        commands += image.load(made)
        starts.append(start)
        start += len(made["lines"]) + 1
    assert start <= 1 << P["N"]
    found = answers([*commands, *((RUN, 0, at, 0) for at in starts)])
    assert not np.any(found["out_refused"])


# What is refused

HEADER = int(tiny()["header"], 16)
LOADED = image.load(tiny())
BAD = {
    "a line is missing": [*LOADED[:2], *LOADED[3:]],
    "the last line is missing": [*LOADED[:-2], LOADED[-1]],
    "no line": [LOADED[0], (SEAL, 0, 9, 0)],
    "a bit of a line": [*LOADED[:3], (LINE, 0, 0, LOADED[3][3] ^ 2), *LOADED[4:]],
    "a bit of the version": [*LOADED[:-1], (SEAL, 0, 9, HEADER ^ 1 << 20)],
    "a bit of the CRC": [*LOADED[:-1], (SEAL, 0, 9, HEADER ^ 1)],
    "lines in another order": [LOADED[0], LOADED[2], LOADED[1], *LOADED[3:]],
    "a command in between": [*LOADED[:3], (READ, 0, 0, 0), *LOADED[3:]],
    "the seal alone": [LOADED[-1]],
}


@pytest.mark.parametrize("commands", BAD.values(), ids=BAD.keys())
def test_a_program_that_is_not_whole_does_not_run(commands):
    """The seal is refused, and so is the run; what was loaded there before does not run either."""
    check = [(RUN, 0, 9, 0), (INFO, 0, 9, 0)]
    for before in ([], LOADED):
        found = answers([*before, *commands, *check])
        kept = before and len(commands) == 1  # a seal without a load changes nothing
        assert found["out_refused"][-3:].tolist() == ([1, 0, 0] if kept else [1, 1, 1])
    found = answers([*commands, *LOADED, *check])  # and it can be loaded again
    assert found["out_refused"][-3:].tolist() == [0, 0, 0]


def test_a_line_is_no_start():
    found = answers([*LOADED, *((RUN, 0, at, 0) for at in (8, 10, 11, 14, 15))])
    assert found["out_refused"][len(LOADED):].all()


def test_a_run_ends_where_another_program_begins():
    """A program that a later one has cut ends there, refused; it never plays lines of the other."""
    other = tiny() | {"start": 12}
    before = [(WRITE, 0, 0, 5), (RUN, 0, 9, 0), (WRITE, 0, 0, 77)]
    found = answers([*LOADED, *before, *image.load(other), (RUN, 0, 9, 0), *((READ, 0, at, 0) for at in range(2, 7)),
                     (RUN, 0, 12, 0), (READ, 0, 6, 0)])
    assert found["out_refused"][-8:].tolist() == [1, 0, 0, 0, 0, 0, 0, 0]
    assert found["out_word"][-7:-2].tolist() == [77, 77, 5, 5, 5] and found["out_word"][-1] == 77


def test_contexts_do_not_meet():
    """Ports, registers and held directions of one context are the same whatever the others do."""
    made = image.image(assembled("vector_ik6", 1), 0)
    rng = np.random.default_rng(3)

    def visit(context, zero):
        values = {port["name"]: 0 if zero else int(rng.integers(0, 1 << 23)) for port in made["inputs"]
                  if "word" not in port}
        return [*image.inputs(made, context, values), image.run(made, context), *image.outputs(made, context)]

    mine = [visit(1, zero) for zero in (True, False, True, False, True)]  # the third holds what the second found
    others = [visit(context, False) for context in (0, 2, 3, 0, 2)]
    alone = answers([*image.load(made), *sum(mine, [])])
    mixed = answers([*image.load(made), *sum((a + b for a, b in zip(others, mine)), [])])
    at, picks = len(made["lines"]) + 2, []
    for a, b in zip(others, mine):
        picks += range(at + len(a), at + len(a) + len(b))
        at += len(a) + len(b)
    for name in ("out_word", "out_status"):
        np.testing.assert_array_equal(mixed[name][picks], alone[name][len(made["lines"]) + 2:])
    assert alone["out_word"][len(made["lines"]) + 2:].any()


def test_an_unread_context_is_empty():
    """No register can be read before the first run of its context."""
    found = answers([*LOADED, (WRITE, 0, 0, 5), (RUN, 0, 9, 0), (READ, 0, 2, 0), (READ, 1, 2, 0)])
    assert found["out_word"][-2:].tolist() == [5, 0]


def test_forgetting():
    """A run that forgets answers (1, 0) where there is no direction, as the first one of a context does."""
    made = image.image(assembled("vector_ik6", 0), 0)
    p = P | {"PIPE": 0}
    c1, n1 = ((READ, 0, port["at"], 0) for port in made["outputs"][:2])
    zero = image.inputs(made, 0, {port["name"]: 0 for port in made["inputs"] if "word" not in port})
    some = image.inputs(made, 0, {"in_x": 1 << 22, "in_y": 1 << 22, "cfg_r": 1 << 20})
    commands = [*image.load(made), *zero, image.run(made, 0), c1, n1, *some, image.run(made, 0), c1, n1, *zero,
                image.run(made, 0), c1, n1, image.run(made, 0, forget=True), c1, n1]
    found = answers(commands, p)["out_word"][[i for i, one in enumerate(commands) if one[0] == READ]].tolist()
    assert found[:2] == found[6:] == [ONE, 0] and found[2:4] == found[4:6] and abs(found[2] - found[3]) < 2000


# Images


def test_a_streamed_program_has_no_image():
    with pytest.raises(Wrong, match="its results are emitted"):
        image.image(assembled("vector_ik6_all", 0))
    with pytest.raises(Wrong, match="a version is from 0"):
        image.image(assembled("vector_fk6", 0), version=1 << 32)


def test_an_image_names_its_words():
    made = image.image(assembled("vector_ik6", 0))
    assert [port["name"] for port in made["inputs"][:2]] == ["in_r11", "in_r12"]
    assert made["inputs"][-1] == {"name": "one", "at": 22, "format": "constant", "word": ONE}
    assert [port["at"] for port in made["outputs"]] == list(range(2, 14)) and made["signs"] == ["back", "down", "flip"]
    assert (ROOT / "rtl" / "program" / f"{made['program']}.kin").exists()
