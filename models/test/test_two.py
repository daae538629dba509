"""Programs for two poses: what the assembler refuses, and a table that follows from its text."""

import pytest
from quadrance.cores import RTL
from quadrance.program import halves, schedule, two
from quadrance.program.language import Wrong
from quadrance.program.parser import load, parse

PATH = RTL / "program" / "vector_ik6.kin"
NEAR = PATH.with_name("vector_ik6_near.kin")


def test_tables_follow_from_their_texts():
    assert two.orders(PATH).keys() == two.orders(NEAR).keys() == {1, 2} and two.stale(RTL / "program") == []


def test_margins_are_of_the_second_half_and_slack_of_the_first():
    """With the flags that they change: NEAR that of a held direction, OVER that of reach."""
    made, second = two.halved(load(NEAR))
    assert [i in second for i, line in enumerate(made) if line.near >= 0] == [True] * 3
    assert [i in second for i, line in enumerate(made) if "OVER" in line.acts] == [False]


@pytest.mark.parametrize("label", ["near c1", "far ce"])
def test_a_margin_in_the_other_half_is_refused(label):
    one = two.assemble(load(NEAR), 2, two.orders(NEAR)[2])
    labels = [f"{halves.MARK}{text}" if text.startswith(label) else text.removeprefix(
        halves.MARK) if label in text else text for text, _ in one.rows]
    names = [dict(zip(("a", "b", "c", "d", "dest"), (cells[i] for i in (1, 3, 4, 5, 9)))) for _, cells in one.rows]
    found = halves.check(one.words, labels, names, one.results, 2, range(12), True)
    assert any(label in text and "half's" in text for text in found), found
    assert two.problems(one) == []


@pytest.mark.parametrize("first, second, says", [
    ("X1t = q 2^j", "R13s = r13", "takes the power while"),
    ("C2g = 1 / root", "X1g = 1 / root", "takes the root while"),
    ("b", "R13s = r13", "'R13s = r13' comes -"), ("l4", "k1 = l2 + k*ce", "while the program is idle")])
def test_an_order_in_which_the_poses_meet_is_refused(first, second, says):
    program, order = load(PATH), list(two.orders(PATH)[2])
    made, later = two.halved(program)
    i, j = (order.index([line.label for line in made].index(label)) for label in (first, second))
    order[i], order[j] = order[j], order[i]
    assert says in "; ".join(schedule.faults(two.rules(program, made, later, schedule.timing(2)), made, order))
    with pytest.raises(Wrong, match="order of two poses"):
        two.assemble(program, 2, order)


def test_a_word_that_both_halves_need_for_longer_than_a_run_is_loaded_twice():
    made, second = two.halved(load(PATH))
    twice = {line.dest for line in made if line.dest.endswith("s")}
    assert twice == {"R13s", "R23s", "R33s"}
    for i, line in enumerate(made):
        assert not twice.intersection(line.registers) or i in second
        assert not {"r13", "r23"}.intersection(line.registers) or i not in second


def test_a_program_of_sums_alone_has_one_half():
    program = parse("in word a b\nout vector c\nnorm a b <= 1\nc = a*b\n", PATH)
    made, second = two.halved(program)
    assert second == {i for i, line in enumerate(made) if line.dest == "c"}
