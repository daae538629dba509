"""The check of the schedules finds each fault that it is there for, and leaves no table out."""

import functools
from dataclasses import replace

import pytest
from quadrance.cores import RTL, all_cores, find

from ci import dataflow, schedules


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
    said = broken("vector_ik1", "vector_ik1", [
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
    assert not any("kernel_chain.v" in line for line in left)


def test_a_table_without_a_player_is_found():
    texts = {path: path.read_text() for path in RTL.rglob("*.v")}
    assert schedules.loose(texts) == []
    path = next(one for one in texts if one.stem == "kernel_chain")
    said = schedules.loose({path: texts[path].replace("schedule #(", "player #(")})
    assert said == ["rtl/kernel/kernel_chain.v: it has a table of control words, and nothing says what plays it"]
    assert sum(bool(schedules.TABLE.search(text)) for text in texts.values()) > 30


def test_a_core_with_a_switch_turned_plays_the_table_that_no_set_plays():
    at = {one.at for core in schedules.turned(find("arm_ik3")) for one in schedules.played((core,))[core]}
    assert len(at) == 3


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
