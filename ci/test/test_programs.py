"""The readers of programs and schedules find each fault that they are there for, and leave no table out."""

import functools
import re
from dataclasses import replace

import pytest
from quadrance.cores import RTL, all_cores, find
from quadrance.program import checker, product_engine
from quadrance.program.checker import Line, Program, Read, Write, soundness, straight

from ci import dataflow, programs, schedules

# Programs, in a copy of the table of each machine

CORES = {"vector_ik6_program": "vector_ik6", "vector_ik6_two_program": "vector_ik6_two",
         "vector_ik6_near_program": "vector_ik6", "vector_ik6_near_two_program": "vector_ik6_two",
         "vector_ik6_all_program": "vector_ik6_all",
         "vector_fk6_program": "vector_fk6", "vector_velocity6_program": "vector_velocity6",
         "vector_rates6_program": "vector_rates6", "vector_xyzac_program": "vector_xyzac",
         "vector_xyzbc_program": "vector_xyzbc", "vector_ur_fk_program": "vector_ur_fk",
         "vector_ur_ik_program": "vector_ur_ik", "vector_ur_ik_all_program": "vector_ur_ik_all",
         "vector_srs_ik_program": "vector_srs_ik",
         "engine_delta_program": "engine_delta_fk",
         "engine_gd_n_program": "engine_quaternion_gd_n", "engine_rus_fk_program": "engine_rus_fk"}


@functools.cache
def sound(module, pipe=0):
    """The program of a module as a core plays it, and its text."""
    if module.endswith("two_program"):
        pipe = pipe or 2
    name = f"PIPE{pipe}" * (pipe > 0) + "EDGES" * ("_near_" in module)
    core = f"{CORES[module]}-{name}" if name else CORES[module]
    one = next(one for one in programs.played(find(core)) if one.module == module)
    return one, one.text()


def found(module, change, pipe=0):
    """Problems of a program whose text has been changed, and whose words with it."""
    one, text = sound(module, pipe)
    text = change(text)
    words = tuple(programs.value(text, row) for row in programs.rows(text))
    return "\n".join(programs.problems(replace(one, words=words), text))


def swapped(first, second):
    """Exchange the two lines of a table that begin so."""
    def change(text):
        lines = text.splitlines(keepends=True)
        i, j = (next(n for n, line in enumerate(lines) if line.split("*/")[-1].startswith(words) or
                     re.match(rf"\s*/\* {re.escape(words)} +\*/", line)) for words in (first, second))
        lines[i], lines[j] = lines[j], lines[i]
        return "".join(lines)

    return change


def edited(old, new):
    def change(text):
        assert old in text
        return text.replace(old, new, 1)

    return change


def test_every_program_is_read_and_sound():
    assert set(CORES) == set(programs.MACHINES)
    for module in CORES:
        two = "engine_gd_n_program", "engine_rus_fk_program"
        for pipe in range(3 if module.startswith("vector") else 2 if module in two else 1):
            one, text = sound(module, pipe)
            assert len(programs.rows(text)) == len(one.words) and programs.problems(one) == [], (module, pipe)


@pytest.mark.parametrize("module, first, second, says", [
    ("vector_ik6_program", "x1 = X1g * X1t", "C1v = x1*px + b*py", "is read"),
    ("vector_ik6_program", "n4 = C4g * N4u", "c4 = C4g * C4u", "read"),
    ("vector_ik6_all_program", "N2UFu = N2UFv 2^s", "N2UFv = k1f*xxf - k2uf*pz", "is read"),
    ("vector_fk6_program", "c23 = c3*c2 - n2*n3", "u3 = c5*n23 + c23*f1", "is read"),
    ("vector_ik6_near_program", "k5 = n5*k", "near c4 k5*k5 - m*m", "is read"),
    ("vector_ik6_program/1", "x1 = X1g * X1t", "C1v = x1*px + b*py", "is read"),
    ("vector_ik6_program/2", "n4 = C4g * N4u", "c4 = C4g * C4u", "read"),
    ("engine_delta_program", "|b|^2", "|b|^2 up", "read"),
    ("engine_gd_n_program", "its square", "Newton", "read"),
    ("engine_gd_n_program/1", "t", "Q", "q2 is read"),
    ("engine_gd_n_program/1", "t", " WAIT,\n", "v': r1 is read while"),  # one line too late
    ("engine_rus_fk_program", "|q|^2", "Newton", "read"),
    ("engine_rus_fk_program/1", "|q|^2", "Newton", "read"),
    ("engine_rus_fk_program/1", "R c x d", " {ay,  R3, az,", "line 52 '52': J3 is read while the word of line 50"),
])
def test_two_lines_swapped_are_found_in_each_player(module, first, second, says):
    module, _, pipe = module.partition("/")
    assert says in found(module, swapped(first, second), int(pipe or 0))


def shared(name, other):
    """Give a word the register of another one."""
    def change(text):
        number = re.search(rf"\b{other} = 6'd(\d+)", text)[1]
        return re.sub(rf"\b{name} = 6'd\d+", f"{name} = 6'd{number}", text, count=1)

    return change


def test_a_word_that_another_name_has_replaced_is_found():
    def change(text):
        text = re.sub(r"(/\* k1 .*BY, PLUS, +)K,", r"\1L4,", text)  # long after pz has taken the register of l4
        return shared("L4", "PZ")(text)

    assert re.search(r"L4 is read, but line \d+ 'pz = .. - l1' has put PZ in its place", found(
        "vector_ik6_program", change))


def test_a_register_given_to_two_living_words_is_found():
    assert re.search(r"PX is read, but line \d+ 'pz = .. - l1' has put PZ in its place", found(
        "vector_ik6_program", shared("PX", "PZ")))


@pytest.mark.parametrize("change, says", [
    (swapped("< c4 = C4g * C4u", "< n5 = c4*m13 + n4*m23"), "C4 of pose 1 is read"),
    (swapped("R13s = r13", "b"), "R13s of pose 1 is read, but line .* has put R13s of pose 2 in its place"),
    (swapped("< C2g = 1 / root", "X1t = q 2^j"), "HOLD asks for another root than its word's"),
    (shared("R33s", "R33"), "R33s of pose 1 is read, but line .* has put R33 of pose 2 in its place"),
    (shared("L4", "R33s"), "R33s of pose 3 is read.* has put L4 between runs in its place"),
    (edited("/* < c3 = cp*ce", "/* c3 = cp*ce"), "the second half's sign, flag or result in the first"),
    (edited("PORT,  I_NP, ", "PORT,  I_X,  "), "the second half reads a port of the pose, which is the next one's"),
    (swapped("l4", "k1 = l2 + k*ce"), "it is played between runs too")])
def test_two_poses_that_meet_are_found(change, says):
    assert re.search(says, found("vector_ik6_two_program", change, 2)), found("vector_ik6_two_program", change, 2)


def test_a_comment_that_names_another_word_is_found():
    assert re.search(r"line \d+ 'py = x - l4\*r13': it writes PX", found("vector_ik6_program", edited(
        "/* px = x", "/* py = x")))


def test_a_text_that_is_not_what_is_played_is_found():
    one, text = sound("vector_ik6_program")
    assert "names do not give its word" in programs.problems(one, re.sub(r"C3, +OTHER", "N3, OTHER", text))[0]
    lines = len(one.words)
    assert f"{lines - 1} lines are read, the design plays {lines}" in programs.problems(one, re.sub(
        r" +/\* k  .*\n", "", text, count=1))[0]


def test_a_program_that_nothing_describes_is_an_error():
    one, _ = sound("vector_ik6_program")
    assert "nothing says" in programs.problems(replace(one, module="seven_program"))[0]


@pytest.mark.parametrize("pipe", range(2))
def test_jumps_are_those_of_the_steps(pipe):
    _, text = sound("engine_rus_fk_program", pipe)
    titles = {row.label.split(":")[0]: n for n, row in reversed(list(enumerate(programs.rows(text))))
              if re.match("[A-Z]{3}", row.label)}
    steps = programs._steps(pipe)
    assert titles == {name: line for name, line in steps.items() if name not in ("SIZE", "END")} | {
        "MOVE": titles["MOVE"]}
    assert len(programs.rows(text)) == steps["END"]


def test_a_line_that_does_not_wait_for_a_register_is_found():
    """Each single wait of PIPE in the program of engine_rus_fk, but two: behind qz it is for the next line but one, and
    in SCALE for one behind a jump.
    """
    one, text = sound("engine_rus_fk_program", 1)
    lines = text.splitlines(keepends=True)
    waits = [n for n, line in enumerate(one.path.read_text().splitlines()) if "{PIPE{" in line]
    texts = ["".join([*lines[:n], lines[n].replace("NOP", "", 1), lines[n + 1], "/* */ NOP,\n", *lines[n + 2:]])
             for n in waits]
    early = ["is on its way" in found("engine_rus_fk_program", lambda _, text=text: text, 1) for text in texts]
    assert sum(early) == len(waits) - 2 == 16


# Words alone, as an assembler gives them


def word(a=(product_engine.PORT, 0), b=(1, 32), c=None, d=0, keep=0, align=0, dest=0, act=0, subtract=0):
    made = a[0] << 45 | a[1] << 39 | b[0] << 38 | b[1] << 32 | keep << 17 | align << 15 | dest << 9 | act
    return made | (c << 26 | d << 20 | 1 << 19 | subtract << 18 if c is not None else 0)


def reg(number):
    return product_engine.REGISTER, number


IDLE = word(b=(1, 4))
ROOT = [word(dest=1, act=product_engine.FOLD), IDLE, IDLE,
        word(reg(1), (1, 2), align=1, act=product_engine.ROOT), word(reg(1), (1, 3), align=1, dest=2), IDLE,
        word((product_engine.TABLE, 0), (1, 0), align=2, dest=3), word((product_engine.LAST, 0), (0, 2), dest=4,
                                                                      act=product_engine.HOLD)]


def said(words, **more):
    return "\n".join(product_engine.check(words, results=frozenset({4}), **more))


def test_a_root_is_sound():
    assert said(ROOT) == ""


@pytest.mark.parametrize("name, words, says", [
    ("too early", [*ROOT[:2], *ROOT[3:]], "line 3 '': register 1 is read while the word of line 1"),
    ("power too early", [ROOT[0], word(b=(1, 1), align=1, dest=4)], "the power is read"),
    ("root too early", [*ROOT[:5], *ROOT[6:]], "the root is read"),
    ("root taken over", [*ROOT[:4], ROOT[3], *ROOT[4:]], "line 4 '': the root is written, and no line reads it"),
    ("another root in between", [*ROOT[:7], word(reg(1), (1, 2), align=1, act=product_engine.ROOT), IDLE,
                                 word(reg(3), (0, 2), dest=4, act=product_engine.HOLD)], "asks for another root"),
    ("a power that is not whole", [ROOT[0], IDLE, word(b=(1, 1), align=1, dest=4),
                                   word(act=product_engine.MORE)], "before line 4 joins it"),
    ("last of a part", [word(keep=1), word((product_engine.LAST, 0), dest=4)], "LAST is a part of a sum"),
    ("a sum that is cut", [word(keep=1), word(align=1, dest=4)], "keeps its sum"),
    ("a sum without end", [word(keep=1)], "no line goes on"),
    ("the register of no word", [word(), IDLE, IDLE, word(reg(0), dest=4)], "register 0 is an operand"),
    ("clobbered", [word(dest=1), word(dest=1), IDLE, IDLE, word(reg(1), dest=4)], "line 1 '': register 1 is written"),
    ("never written", [word(reg(9), dest=4)], "register 9 is read, but no line before it has written it"),
    ("held after a part of the loop", [word(reg(1), dest=4), word(dest=1)], "no line before it"),
])
def test_faults_of_words_are_found(name, words, says):
    assert says in said(words)


# Lines between one and the next, by PIPE: register, LAST, power, root, flags
APART = {0: (3, 1, 2, 3, 2), 1: (4, 2, 3, 3, 3), 2: (4, 3, 4, 4, 4)}


def placed(*lines):
    """A program of (line number, word), and idle lines between them."""
    at = dict(lines)
    return [at.get(number, IDLE) for number in range(max(at) + 1)]


def rooted(pipe, table=0, again=0, hold=None):
    """A root and what uses it, as early as it can; `table`: so many lines earlier; another root `again` lines after
    the table, or `hold` lines after HOLD."""
    _, last, power, root, _ = APART[pipe]
    first = 2 + power
    at = first + root - table
    lines = [(0, word(dest=5)), (1, word(act=product_engine.FOLD)),
             (1 + power, word(b=(1, 1), align=1, dest=3)), (first, word(act=product_engine.ROOT)),
             (at, word((product_engine.TABLE, 0), (1, 0), align=2)),
             (at + last, word((product_engine.LAST, 0), (0, 5), dest=4, act=product_engine.HOLD if hold else 0))]
    if again or hold:
        other = at + last + hold if hold else at + again
        lines += [(other, word(act=product_engine.ROOT)),
                  (other + root, word((product_engine.TABLE, 0), (1, 0), align=2, dest=6))]
    return placed(*lines, (60, word(reg(3), dest=4)), (61, word(reg(6), dest=4) if again or hold else IDLE))


@pytest.mark.parametrize("pipe", APART)
def test_distances_by_pipe(pipe):
    register, last, power, _, flags = APART[pipe]
    for least, after, says in (
            (register, lambda n: placed((0, word(dest=1)), (n, word(reg(1), dest=4))), "register 1"),
            (last, lambda n: placed((0, word(dest=1)), (n, word((product_engine.LAST, 0), dest=4))), "register 1"),
            (power, lambda n: placed((0, word(act=product_engine.FOLD)), (n, word(b=(1, 1), align=1, dest=4))),
             "the power")):
        assert said(after(least), pipe=pipe) == ""
        assert says in said(after(least - 1) if least > 1 else after(least + 1), pipe=pipe)

    def clamped(after):
        far = word(dest=1, act=product_engine.FAR)
        return said(placed((0, IDLE), (1, far), (1 + after, word(reg(1), dest=4, act=product_engine.CLAMP))), pipe=pipe)

    assert clamped(register) == "" and "FAR's flag" not in clamped(flags) and "FAR's flag" in clamped(flags - 1)


@pytest.mark.parametrize("pipe", APART)
def test_windows_of_a_root_by_pipe(pipe):
    _, last, *_ = APART[pipe]
    assert said(rooted(pipe), pipe=pipe) == ""
    assert "the root is read" in said(rooted(pipe, table=1), pipe=pipe)
    assert said(rooted(pipe, -1, again=-last), pipe=pipe) == ""
    says = "the root is written, and no line reads it" if pipe else "sign of another root"
    assert says in said(rooted(pipe, -1, again=-last - 1), pipe=pipe)
    assert said(rooted(pipe, hold=1), pipe=pipe) == ""
    assert "asks for another root" in said(rooted(pipe, hold=-1), pipe=pipe)


@pytest.mark.parametrize("name, word, says", [
    ("kept", word(keep=1), "played while"), ("checked", word(act=product_engine.CHECK), "played while"),
    ("a result", word(dest=4), "played while"),
    ("above of a shifted word", word(align=1, act=product_engine.ABOVE), "take a sum"),
    ("root of a MID word", word(align=2, act=product_engine.ROOT), "take a sum"),
])
def test_faults_of_a_first_line_and_of_acts(name, word, says):
    assert says in said([word, IDLE, IDLE])


def test_an_engine_without_roots_has_none():
    assert "no root unit" in said([word(dest=4, act=product_engine.FOLD)], roots=False)


def test_the_operand_c_of_a_hold_is_its_own_word_where_the_engine_has_margins():
    held = [*ROOT[:-1], word((product_engine.LAST, 0), (0, 2), c=1, d=1, dest=4, act=product_engine.HOLD)]
    assert "another register's word" in said(held) and "another register's word" not in said(held, margins=False)
    assert "no MARGINS" in said([IDLE, word(dest=4, act=product_engine.CHECK | product_engine.FAR)], margins=False)


def test_a_clamp_asks_for_the_far_of_its_own_word():
    far = [IDLE, word(dest=1, act=product_engine.FAR), IDLE, IDLE]
    assert said([*far, word(reg(1), dest=4, act=product_engine.CLAMP)]) == ""
    other = [word(dest=2), *far, word(reg(2), dest=4, act=product_engine.CLAMP), word(reg(1), dest=4)]
    assert "another FAR than its word's" in said(other)


def test_reads_of_what_was_before():
    old, new = Line("old", (Read("r", old=True),), ()), Line("new", (), (Write("r", 3),))
    given, results = frozenset("r"), frozenset("r")

    def wrong(*lines):
        return "\n".join(soundness(Program(lines, straight(lines), given, results)))

    idle = Line("idle")
    assert wrong(new, old) == ""
    assert "on its way" in wrong(new, idle, old)
    assert "nothing changes it" in wrong(new, idle, idle, old)


def test_every_line_is_led_to():
    lines = [Line("one"), Line("two")]
    assert soundness(Program(lines, [(), ()])) == ["line 2 'two': no line leads to it"]
    assert checker.straight(lines) == [(1,), ()]


def test_the_player_of_every_program_in_rtl_is_known():
    texts = {path.stem: path.read_text() for path in RTL.rglob("*.v")}
    players = {name for name, text in texts.items() if re.search(r"^\s*engine_program\s*#", text, re.M)}
    own = {name for name in texts if name.endswith("_program") and re.search(r"reg .*lines\[", texts[name])}
    assert players | own - {"engine_program"} == set(programs.MACHINES)


# Schedules, on the elaborated core


@functools.cache
def tables():
    """The tables of the first parameter sets."""
    return schedules.played(tuple(core for core in all_cores() if core.first_set))


def broken(name, stem, changes, folder):
    """What is said of a core with one source changed."""
    core = find(name)
    source = next(one for one in core.sources if one.stem == stem)
    text = source.read_text()
    for old, new in changes:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    (folder / source.name).write_text(text)
    sources = tuple(folder / source.name if one == source else one for one in core.sources)
    return "\n".join(dataflow.play(replace(core, sources=sources)))


def test_a_sound_core_is_quiet_and_takes_its_latency():
    core = find("rational_fk3")
    assert dataflow.play(core) == []
    assert dataflow.play(replace(core, latency=core.latency + 1)) == [
        f"sample {n} takes {core.latency} clocks, cores.toml says {core.latency + 1}" for n in (1, 2)]


def test_two_lines_of_a_schedule_swapped_are_found(tmp_path):
    cosine, place = "{CHORD | ROOTS | COS | READ1}", "{PLACE | PLACED}"
    said = broken("rational_fk3", "kernel_chain", [
        (f"/* c2, n2       */ {cosine}", f"/* c2, n2       */ {place}"),
        (f"/* A, B         */ {place}", f"/* A, B         */ {cosine}")], tmp_path)
    assert "out_x is made of kernel.exact" in said and "which the sample has not written" in said


def test_two_lines_of_a_schedule_with_a_counter_swapped_are_found(tmp_path):
    said = broken("classic_fk2", "classic_chain_iter", [
        ("/* L2 to its quadrant */ {START, LINK_2}", "/* L2 to its quadrant */ {C{MICRO, STEP}}"),
        ("/* turn by j2         */ {C{MICRO, STEP}}", "/* turn by j2         */ {START, LINK_2}")], tmp_path)
    assert "which the sample has not written" in said


def test_two_lines_of_a_loop_swapped_are_found(tmp_path):
    said = broken("engine_quaternion_gd", "engine_quaternion_gd", [
        ("/* read c12; c1    */ {CHORD, L1,    COS12}", "/* read c12; c1    */ {CHORD, L1,    SIN12 | X}"),
        ("/* read s12; L1 c1 */ {CHORD, L1,    SIN12 | X}", "/* read s12; L1 c1 */ {CHORD, L1,    COS12}")], tmp_path)
    assert "which the sample has not written" in said


def test_a_result_at_another_clock_is_found(tmp_path):
    said = broken("vector_ik1", "kernel_vector_aim", [
        ("/* x root  */ {COS | LEFT | SECOND}", "/* x root  */ {SIN}"),
        ("/* y root  */ {SIN}", "/* y root  */ {COS | LEFT | SECOND}")], tmp_path)
    assert "sample 1 takes 7 clocks, cores.toml says 8" in said


@pytest.mark.parametrize("name", ["arm_fk3", "table_ik1"])
def test_what_a_core_may_hold_from_before_is_needed(name, monkeypatch):
    monkeypatch.setitem(dataflow.SETTINGS, name, dataflow.Before())
    assert "which the sample has not written" in "\n".join(dataflow.play(find(name)))


def test_every_instance_of_a_player_is_read():
    placed = schedules.instances()
    assert {path.stem for path, _ in placed} >= {"vector_ik6_program", "classic_chain_iter", "kernel_chain"}
    assert len(placed) == sum(text.count(f"{player} #(") for path in RTL.rglob("*.v") for text in [path.read_text()]
                              for player in ("schedule", "schedule_counter", "engine_program")) - 3  # the modules
    few = {core: every for core, every in tables().items() if core.family != "paper"}
    left = schedules.unread(few, placed)
    assert any("paper_chain.v" in line and "no core of cores.toml plays this table" in line for line in left)
    assert not any("kernel_solve.v" in line for line in left)


def test_a_table_without_a_player_is_found():
    texts = {path: path.read_text() for path in RTL.rglob("*.v")}
    assert schedules.loose(texts) == []
    path = next(one for one in texts if one.stem == "kernel_chain")
    said = schedules.loose({path: texts[path].replace("schedule #(", "player #(")})
    assert said == ["rtl/kernel/kernel_chain.v: it has a table of control words, and nothing says what plays it"]
    assert sum(bool(schedules.TABLE.search(text)) for text in texts.values()) > 30


def test_a_core_with_a_switch_turned_plays_the_tables_that_no_set_plays():
    """The table of arm_solve depends on two switches, and stands in one place."""
    core = find("arm_ik3")
    listed = {one.words for other, every in tables().items() if other.name == core.name for one in every}
    more = {one.words for other in schedules.turned(core) for one in schedules.played((other,))[other]}
    assert len(more - listed) == 2
    assert {one.words for other in schedules.chosen(tables()) for one in tables()[other]} >= listed


def test_the_chosen_cores_play_every_schedule():
    chosen = schedules.chosen(tables())
    every = {(one.path, one.at) for tables_of in tables().values() for one in tables_of
             if one.player in schedules.SCHEDULES}
    assert {(one.path, one.at) for core in chosen for one in tables()[core]} >= every
    assert len(chosen) < len(tables())


def test_latency_is_that_of_the_elaborated_table() -> None:
    core = find("rational_fk3")
    assert {len(one.words) for one in tables()[core]} == {9}
    assert schedules.latency_problems(core, {9}) == []
    assert "latency 8" in schedules.latency_problems(replace(core, latency=8, ii=8), {9})[0]


def test_clocks_shared_with_the_sample_before_are_no_lines_of_the_table() -> None:
    core = find("table_fk3")
    assert core.ii < core.latency and {len(one.words) for one in tables()[core]} == {5}
    assert schedules.latency_problems(core, {5}) == []
    assert "gives 6" in schedules.latency_problems(core, {4})[0]


@pytest.mark.parametrize("kind, function", [("$add", int.__add__), ("$sub", int.__sub__), ("$mul", int.__mul__)])
def test_arithmetic_is_exact_for_constants_and_undefined_from_the_first_undefined_bit_on(kind, function):
    params = {key: f"{value:b}" for key, value in {"A_WIDTH": 4, "B_WIDTH": 4, "Y_WIDTH": 6, "A_SIGNED": 0,
                                                   "B_SIGNED": 0}.items()}
    compute = dataflow._arithmetic(kind, params)
    for a in range(16):
        for b in range(16):
            bits = [a >> i & 1 for i in range(4)] + [b >> i & 1 for i in range(4)]
            assert sum(bit << i for i, bit in enumerate(compute(bits))) == function(a, b) % 64
    found = compute([1, 0, dataflow.STALE, 0, 1, 1, 0, 0])
    assert found[:2] == [function(1, 3) >> i & 1 for i in range(2)] and found[2:] == [dataflow.STALE] * 4


def test_gates_let_a_stale_bit_through_only_where_it_decides():
    zero, one, defined, stale = dataflow.ZERO, dataflow.ONE, dataflow.DEFINED, dataflow.STALE
    assert dataflow.AND[4 * zero + stale] == zero and dataflow.AND[4 * one + stale] == stale
    assert dataflow.OR[4 * one + stale] == one and dataflow.OR[4 * defined + stale] == stale
    assert dataflow.XOR[4 * stale + zero] == stale and dataflow.NOT[defined] == defined
    assert dataflow.MUX[16 * zero + 4 * defined + stale] == defined  # select, then what it takes at 0 and at 1
    assert dataflow.MUX[16 * one + 4 * defined + stale] == stale == dataflow.MUX[16 * defined + 4 * defined + stale]
    assert dataflow.MUX[16 * stale + 4 * one + one] == one
