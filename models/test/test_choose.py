"""`quadrance choose`, `accuracy`, `cores --arm`: what fits on an arm, by rows of the report and the bit-true models."""

import json
import re
import time

import numpy as np
import pytest
from quadrance import accuracy, arms, cores
from quadrance.accuracy import of_core, pose
from quadrance.cli import catalogue, choose, main, verilog, words

COMMITTED = json.loads((cores.ROOT / "reports" / "report.json").read_text())


@pytest.fixture
def quadrance(capsys, monkeypatch):
    """Run the command with few samples; its output, and its one line of refusal where `code` is 2."""
    monkeypatch.setattr(of_core, "WORKSPACE", 2048)

    def run(*arguments, code=0):
        try:
            ended = main(arguments)
        except SystemExit as end:
            ended = end.code
        out, err = capsys.readouterr()
        assert ended == code, err
        assert err.count("\n") == (code == 2)
        return (out, err) if code else out
    return run


def _ask(function="ik2", arm="cobra600", word="angle:18", **more):
    return ["choose", "--function", function, "--arm", arm, "--word", word,
            *(text for key, value in more.items() for text in (f"--{key}", str(value)))]


def test_what_fits_has_the_error_that_the_model_has(quadrance):
    """Worked out again here, from inputs to tip; the smallest is the first, and the joint word is the one asked for."""
    fit = json.loads(quadrance(*_ask("fk2", mm=0.09, rate=1e6), "--json"))["fit"]
    assert {"table_fk2", "classic_fk2"} <= {one["core"] for one in fit}
    assert [one["share"] for one in fit] == sorted(one["share"] for one in fit)
    slow = quadrance(*_ask("fk2", rate=5e6))
    assert re.search("^not .*classic_fk2-iter: too slow: ", slow, re.M) and slow.startswith("core")
    arm = arms.load("cobra600")
    for one in fit:
        core = catalogue.find(one["core"], one["params"])
        case = accuracy.workspace_case(core, arm, 2048, np.random.default_rng(1))
        errors = accuracy.errors(core, arm, case, core.model(core.params, **case.inputs, **case.cfg))
        assert one["error_mm"] == errors.total.max() * accuracy.mm_per_lsb(core, arm) <= 0.09
        assert one["params"]["A"] == 18 and one["results_per_second"] >= 1e6
        name, *given = one["instance"].split()
        assert catalogue.find(name, {key: int(value) for key, value in re.findall(r"(\w+)=(\d+)", " ".join(given))}
                              ).params == one["params"]


def test_an_answer_that_the_model_does_not_confirm_is_not_printed(quadrance, monkeypatch):
    right = of_core.modelled

    def wrong(core, inputs, cfg):
        return {port: word + 512 * (port == "out_x") for port, word in right(core, inputs, cfg).items()}

    assert "table_fk2 " in quadrance(*_ask("fk2", mm=0.09))
    monkeypatch.setattr(of_core, "modelled", wrong)
    out, refusal = quadrance(*_ask("fk2", mm=0.09), code=2)
    assert "too coarse: " in refusal and re.search("^not table_fk2: too coarse", out, re.M)


@pytest.mark.parametrize("asked", [_ask(word="angle:21", mm=0.1), _ask("ik6", "kr6_r700", "vector:15", mm=0.1)])
def test_an_answer_takes_less_than_half_a_minute(asked, capsys):
    since = time.process_time()
    assert main(asked) == 0 and time.process_time() - since < 30


def test_few_models_run(monkeypatch):
    """One for each set of words, whatever ways there are to build them."""
    monkeypatch.setattr(of_core, "WORKSPACE", 512)
    wish = choose.Wish("ik6", arms.load("kr6_r700"), words.word("vector:16"), "ecp5", mm=1e-6, clock=1000.0)
    fit, out, near = choose.choose(wish)
    assert not fit and len([name for name in out if name.startswith("vector")]) == 6 and wish.runs == 2
    assert {text.partition(":")[0] for _, text in near[1].misses} == {"does not meet the clock", "too coarse"}


def test_a_clock_that_no_row_meets_names_the_nearest(quadrance):
    out, refusal = quadrance(*_ask("ik6", "kr6_r700", "vector:16", clock=500), code=2)
    best = max((row for row in COMMITTED["cores"] if row["core"] in ("vector_ik6", "vector_ik6_all")),
               key=lambda row: row["fmax_mhz"]["ecp5"])
    assert f"nothing fits; {best['core']}-PIPE{best['params']['PIPE']} is the nearest: does not meet the clock: " \
           f"{best['fmax_mhz']['ecp5']:g} of 500 MHz" in refusal
    assert out.count("does not meet the clock") >= 6
    clock = best["fmax_mhz"]["ecp5"]
    fit = json.loads(quadrance(*_ask("ik6", "kr6_r700", "vector:16", clock=clock), "--json"))["fit"]
    assert [(one["core"], one["params"]["PIPE"]) for one in fit][0] == (best["core"], best["params"]["PIPE"])
    assert fit[0]["results_per_second"] == round(clock * 1e6 / fit[0]["ii"])


@pytest.mark.parametrize(("arguments", "reason"), [
    (_ask(chip="ecp6"), "no chip 'ecp6'; did you mean ecp5"), (_ask("ik22"), "no function 'ik22'; did you mean ik2"),
    (_ask("isqrt"), "no error in mm is defined for isqrt; there are fk1"),
    (_ask(word="coordinate:16.8"), "a joint word is angle"), (_ask(word="angle:x"), "the bits of angle"),
    (_ask(mm=0), "--mm 0: it must be positive"), (_ask(rate="often"), "'often' is no number"),
    (_ask(arm="cobra60"), "no arm 'cobra60'; did you mean cobra600?"),
    (["accuracy", "isqrt", "--arm", "cobra600"], "isqrt takes no arm"),
    (["accuracy", "arm_velocity2", "--arm", "cobra600"], "no error in mm is defined for velocity2"),
    (["accuracy", "table_ik3", "--arm", "cobra600"], "limits.yaw: is missing"),
    (["cores", "--function", "ik6", "--arm", "ur5"], "none of these cores serves ur5: wrist.spherical: is false"),
    (["decode", "--signed", "coordinate", "1"], "--signed is for joint words")])
def test_what_cannot_be_asked_is_refused_in_one_line(quadrance, arguments, reason):
    out, refusal = quadrance(*arguments, code=2)
    assert reason in refusal and not out


def test_an_arm_that_no_core_serves(quadrance):
    out, refusal = quadrance(*_ask("ik6", "ur5"), code=2)
    assert "no core of ik6 with angle:18 serves ur5" in refusal
    assert re.search(r"^not vector_ik6, .*table_ik6.*: wrist.spherical: is false", out, re.M)


def test_a_robot_of_three_parallel_axes_gets_its_core(quadrance):
    fit = json.loads(quadrance(*_ask("ur_ik", "ur5e", "vector:16", mm=0.1), "--json"))["fit"]
    assert {one["core"] for one in fit} == {"vector_ur_ik", "vector_ur_ik_all"}
    out, refusal = quadrance(*_ask("ur_ik", "kr6_r700", "vector:16", mm=0.1), code=2)
    assert "no core of ur_ik with vector:16 serves kr6_r700" in refusal and "parallel = true" in out


def test_a_robot_of_seven_axes_gets_its_core(quadrance):
    fit = json.loads(quadrance(*_ask("srs_ik", "iiwa7", "vector:16", mm=0.1), "--json"))["fit"]
    assert "vector_srs_ik" in {one["core"] for one in fit} <= {"vector_srs_ik", "table_srs_ik"}
    out, refusal = quadrance(*_ask("srs_ik", "kr6_r700", "vector:16", mm=0.1), code=2)
    assert "no core of srs_ik with vector:16 serves kr6_r700" in refusal and "limits.upper: is missing" in out
    assert "no core of ik6 with vector:16 serves iiwa7" in quadrance(*_ask("ik6", "iiwa7", "vector:16"), code=2)[1]


def test_an_area_is_measured_or_said_to_be_an_estimate(quadrance):
    area = {one.core.params["A"]: one.area["ecp5"]["lut"] for one in choose.rows()
            if one.core.name == "classic_ik2" and one.core.params["MODE"] == 0 and one.core.params["W"] == 16}
    low, high = min(area), max(area)
    core = catalogue.find("classic_ik2", {"A": high, "F": 3})
    assert choose.estimated(core, "ecp5", "A")[0]["lut"] == area[high] and choose.estimated(core, "ecp5", "A")[2]
    shorter, _, own = choose.estimated(catalogue.find("classic_ik2", {"A": low - 3}), "ecp5", "A")
    assert 0.9 * area[low] < shorter["lut"] < area[low] and not own
    longer = catalogue.find("vector_fk3", {"U": 20})
    assert choose.estimated(longer, "ecp5", "U") is None, "of a word that takes two multipliers there is no row"
    text = quadrance(*_ask(word="angle:21"))
    assert re.search(r"^table_ik2 .*~\d+ ", text, re.M) and "~ an estimate" in text


def test_all_inverses_of_six_axes_are_found(quadrance):
    names = {row["core"] for row in json.loads(quadrance("cores", "--function", "ik6", "--json"))}
    assert names == {"vector_ik6", "vector_ik6_all", "table_ik6"}
    assert "table_fk6" in quadrance("cores", "--function", "fk6")


def test_the_cores_of_an_arm(quadrance):
    found = json.loads(quadrance("cores", "--arm", "cobra600", "--json"))
    names = {row["core"] for row in found["cores"]}
    assert {"table_ik2", "arm_rates2"} <= names and not names & {"table_ik3", "vector_ik6", "isqrt"}
    assert all("limits.yaw: is missing" in reason for reason, cores_ in found["refused"].items()
               if "vector_ik6" in cores_) and "isqrt-iter" in found["refused"]["it is no kinematics of an arm"]
    assert re.search("^not .*vector_ik6.*: limits.yaw: is missing", quadrance("cores", "--arm", "cobra600"), re.M)


def test_the_accuracy_of_one_core(quadrance):
    lines = quadrance("accuracy", "vector_fk1", "--arm", "cobra600").splitlines()
    assert lines[0].startswith("vector_fk1-U16 on Omron") and len(lines) == 5
    about = json.loads(quadrance("accuracy", "vector_ik6", "--arm", "kr6_r700", "--json"))
    assert about["total_mm"] < 0.1 < about["beside_axis_mm"] and about["total_degrees"] < 0.02
    assert "wrist within 20 mm of axis 1" in quadrance("accuracy", "vector_ik6", "--arm", "kr6_r700")


@pytest.mark.parametrize("name", ["arm_fk3", "arm_ik3", "vector_fk6", "table_fk6", "vector_ik6", "table_ik6",
                                  "vector_ik6_all"])
def test_the_error_of_whole_arms_is_that_of_their_words(name, monkeypatch):
    """About half an LSB a coordinate; a model that is off by 64 LSB in one port is seen."""
    arm = arms.load("kr6_r700")
    core = verilog.fitted(catalogue.find(name), arm, {})
    found = pose.worst(core, arm, 1024)
    assert 0.5 < found.mm / accuracy.mm_per_lsb(core, arm) < 2
    right = pose.modelled

    def off(core, inputs, cfg):
        words = right(core, inputs, cfg)
        port = next(one for one in words if re.fullmatch("out_(x|j2|n2|n20)", one))
        return words | {port: words[port] + 64}

    monkeypatch.setattr(pose, "modelled", off)
    assert pose.worst(core, arm, 1024).mm > 5 * found.mm


@pytest.mark.parametrize(("word", "value", "means"), [
    ("angle:8", "128", "-180.000000 degrees"), ("angle:8", "127", "178.593750 degrees"),
    ("angle:8", "255", "-1.406250 degrees"), ("vector:8", "0,-5", "-90.000000 degrees")])
def test_a_joint_may_be_signed(quadrance, word, value, means):
    assert means in quadrance("decode", word, value, "--signed")
    assert "count -250" in quadrance("decode", "angle:8", "192", "--signed", "--counts", "1000")
