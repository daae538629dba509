"""Cover lists: what is in them, that a bug at one value is found, and that a verdict that nobody ran is."""

import re
from pathlib import Path

import pytest
from quadrance import arms
from quadrance.arm import switches
from quadrance.cores import Core, all_cores, at, find

from ci import cover
from tb.lib import legal, program
from tb.lib.test_bench_bites import altered


@pytest.mark.full
def test_a_list_has_ends_neighbours_an_odd_middle_and_all_pairs_of_switches():
    core = find("arm_ik3")
    sets = legal.cover(core)
    assert sets == legal.cover(core) and len(sets) == legal.MOST and not any(map(legal.rule_of(core).broken, sets))
    for name, (low, high) in legal.ranges(core).items():
        values = {one[name] for one in [*sets, core.params]}
        assert {low, low + 1, high - 1, high} <= values
    assert any(one["W"] % 2 and one["W"] not in (9, 15) for one in sets)
    tops = ("BASE", "SHOULDER", "LATERAL", "ELBOW", "ABSOLUTE")
    for i, one in enumerate(tops):
        for other in tops[:i]:
            assert len({(each[one], each[other]) for each in [*sets, core.params]}) == 4
    for name in arms.known():
        assert any(switches(arms.load(name)).items() <= each.items() for each in [*sets, core.params])


@pytest.mark.full
def test_a_further_pipe_has_its_own_ends():
    core = find("vector_fk2-PIPE1")
    sets = legal.cover(core)
    assert len(sets) == legal.MOST and {one["PIPE"] for one in sets} == {1}
    assert len(legal.cover(find("vector_ik6-PIPE1"))) == legal.MOST // 3  # the engine's words have one width
    listed = [one.params for one in all_cores() if one.name == core.name and one.params["PIPE"] == 1]
    for name, ends in legal.ranges(core).items():
        assert set(ends) <= {one[name] for one in [*sets, *listed]}
    names = [(one.name, one.set_id) for each in cover.cores() for one in (at(each, row) for row in legal.cover(each))]
    assert len(names) == len(set(names))


@pytest.mark.full
def test_ranges_are_those_of_the_rule_wherever_it_is():
    assert legal.ranges(find("rational_ik1")) == {"W": (4, 16), "F": (0, 15), "S": (2, 24)}
    assert legal.ranges(find("cordic_rotate")) == {"MODE": (0, 0), "W": (8, 16), "A": (5, 19)}
    assert legal.ranges(find("vector_fk2-PIPE1")) == {"W": (4, 20), "F": (0, 19), "U": (4, 24), "PIPE": (1, 1),
                                                      "MULTIPLY": (18, 27)}
    assert legal.ranges(find("vector_chain")) == {"SPACE": (0, 1), "W": (4, 20), "F": (0, 19), "U": (4, 20),
                                                  "N": (2, 64)}
    assert legal.ranges(find("paper_ik2"))["S"] == (4, 24)  # in paper_solve_path
    for core in cover.cores():
        for params in legal.cover(core):
            assert not legal.rule_of(core).broken(params) and set(params) == set(core.params)


def _broken_at(name: str, condition: str, folder: Path) -> Core:
    """A core whose first status bit is wrong where the parameters fulfil a condition."""
    text = find(name).sources[0].read_text()
    line = re.search(r"( *)assign +out_status *= *(.*);", text)
    assert line, name
    return altered(name, name, line[0], f"{line[1]}assign out_status = ({line[2]}) ^ {{3'b0, {condition}}};", folder)


@pytest.mark.full
@pytest.mark.parametrize(("name", "condition", "where"), [
    ("vector_fk1", "W == 21", lambda p: p["W"] == 21),
    ("arm_fk3", "LATERAL == 0 && ABSOLUTE == 1", lambda p: not p["LATERAL"] and p["ABSOLUTE"]),
], ids=("W21", "LATERAL0ABSOLUTE1"))
def test_a_bug_at_one_value_is_found(name, condition, where, tmp_path):
    """The sets of the list that have the value fail, and the next one does not."""
    core = _broken_at(name, condition, tmp_path)
    sets = legal.cover(find(name))
    hit = next(params for params in sets if where(params))
    with pytest.raises(AssertionError, match="out_status"):
        cover.run(at(core, hit))
    cover.run(at(core, next(params for params in sets if not where(params))))


@pytest.mark.full
def test_every_listed_set_has_a_whole_bulk_run(tmp_path, monkeypatch):
    """Here, or in `make test`; a bug that only resets or a random word of the bulk run shows is found."""
    asked = {name for name in cover.wanted(cover.cores())}
    assert {(core.name, core.set_id) for core in all_cores() if not legal.daily(core)} <= asked
    core = find("vector_ik1-W12U10")
    assert not legal.daily(core) and cover.verdict(core.name, core.set_id, core.params) == ""
    monkeypatch.setattr(cover, "listed", lambda name: {core.set_id: _broken_at(core.name, "1'b1", tmp_path)})
    assert "bulk run" in cover.verdict(core.name, core.set_id, core.params)


@pytest.mark.full
def test_a_verdict_that_is_missing_stale_or_was_never_run_is_found(tmp_path, monkeypatch):
    monkeypatch.setattr(cover, "STORE", tmp_path / "cover.json")
    flags = program._flags()
    monkeypatch.setattr(program, "_flags", lambda: flags)  # the benches' run-time: one less to compile
    sets = cover.wanted([find("isqrt_comb")])
    assert f"{len(sets)} sets have no verdict" in cover.check(sets)[0]
    rows = {label: digest for (_, label), (_, digest) in sets.items()}
    cover.keep({"isqrt_comb": rows})
    monkeypatch.setattr(cover, "DRAWN", 1)
    assert cover.check(sets) == []

    def wrong(*_):  # what a run would have found
        raise AssertionError("a warning")

    monkeypatch.setattr(cover, "run", wrong)
    monkeypatch.setattr(cover, "_whole", wrong)  # of a listed set
    assert "a warning" in cover.check(sets)[0]
    first = next(iter(rows))
    cover.keep({"isqrt_comb": rows | {first: "stale"}})
    assert "1 sets have no verdict" in cover.check(sets)[0]
    cover.keep({"isqrt_comb": rows | {"W99F0": "of another list"}})
    assert "1 verdicts are of no set" in cover.check(sets)[0]
