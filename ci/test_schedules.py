"""The reader of the cycle tables bites: each fault that it is there for is found in a small table."""

import dataclasses

from quadrance.cores import find

from ci import schedules

SOURCE = """
    // Schedule. start: x y <- in_x in_y
    localparam [1:0]   // the sum
        NONE = 2'b00,
        ADD  = 2'b01;  // sum <- x y: adds
    localparam [1:0]
        KEEP = 2'b10;  // z <- sum: moves on
    //                  left   right
    localparam [2*4-1:0] HEAD = {
        /* sum       */ {ADD,  NONE},
        /* some more */ {M{ADD, KEEP}}};
    localparam [2*2-1:0] TAIL = {
        /* last      */ {KEEP | ADD, NONE}};
    schedule #(.LINES(M + 2), .BITS(4), .TABLE({HEAD, TAIL})) control (
        .clk(clk));
"""


def wrong(text: str) -> str:
    return "\n".join(schedules.problems(schedules.read(text), "x.v"))


def test_a_correct_table_is_read_and_printed() -> None:
    assert wrong(SOURCE) == ""
    one = schedules.read(SOURCE)
    assert one.instances == (("HEAD", "TAIL"),) and one.start == {"x", "y"}
    printed = schedules.markdown(one)
    assert "| HEAD | the sum | operations |" in printed
    assert "| some more (M x) | ADD | KEEP |" in printed
    assert "| last | KEEP + ADD | NONE |" in printed
    assert "| KEEP | z | sum | moves on |" in printed


def test_use_before_write_is_found() -> None:
    assert "'sum': sum is read" in wrong(SOURCE.replace("{ADD,  NONE}", "{ADD | KEEP, NONE}"))
    assert "y is read" in wrong(SOURCE.replace("start: x y", "start: x"))
    assert "'last': sum is read" in wrong(SOURCE.replace("{HEAD, TAIL}", "TAIL"))


def test_unknown_names_are_found() -> None:
    assert "no operation ADDD" in wrong(SOURCE.replace("KEEP | ADD", "KEEP | ADDD"))
    assert "no table TALE" in wrong(SOURCE.replace("{HEAD, TAIL}", "{HEAD, TALE}"))


def test_a_stale_page_is_found() -> None:
    page = "a\n<!-- schedule:kernel_chain -->\nold\n<!-- /schedule -->\nb\n"
    fresh = schedules.filled(page)
    assert fresh != page and "UPRIGHT" in fresh and "old" not in fresh
    assert schedules.filled(fresh) == fresh


def test_latency_is_that_of_the_elaborated_table() -> None:
    core = find("rational_fk3")
    assert schedules.elaborated_lines(core) == {9}
    assert schedules.latency_problems(core, {9}) == []
    assert "latency 8" in schedules.latency_problems(dataclasses.replace(core, latency=8, ii=8), {9})[0]


def test_clocks_shared_with_the_sample_before_are_no_lines_of_the_table() -> None:
    core = find("table_fk3")
    assert core.ii < core.latency and schedules.elaborated_lines(core) == {5}
    assert schedules.latency_problems(core, {5}) == []
    assert "gives 6" in schedules.latency_problems(core, {4})[0]
