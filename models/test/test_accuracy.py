"""The error measures: an ideal core scores what rounding alone costs, and every kind of fault is seen."""

import numpy as np
import pytest
from quadrance import accuracy, arms, cores, truth
from quadrance.fixed import to_fixed

ARM = arms.load("cobra600")
JOINT = {"classic": "uA", "rational": "u2+S", "paper": "u2+S"}
PORTS = {"fk1": ("j1", "x y"), "fk2": ("j1 j2", "x y"), "fk3": ("j1 j2 j3", "x y z"),
         "ik1": ("x y", "j1"), "ik2": ("x y", "j1 j2"), "ik3": ("x y z", "j1 j2 j3")}


def core(function, family="rational", **params):
    """A core of the list that needs no Verilog."""
    spec = {**{f"j{i}": JOINT[family] for i in (1, 2, 3)}, **dict.fromkeys("xyz", "sW")}
    ins, outs = ({name: spec[name] for name in names.split()} for names in PORTS[function])
    if function in ("ik2", "ik3"):
        ins["elbow"] = "u1"
    entry = {"family": family, "function": function, "architecture": "comb", "model": "fixed.isqrt", "sources": [],
             "cfg": {"l1": "uW", "l2": "uW"}, "in": ins, "out": outs, "sets": [
                 {"id": "t", "params": {"W": 16, "F": 8, "S": 24, "A": 16} | params, "latency": 1, "ii": 1}]}
    return cores._expand(f"{family}_{function}", entry)[0]


def ideal(one, case):
    """The correctly rounded answer to a case, computed the plain way."""
    f = one.params["F"]
    l1, l2 = (case.cfg[f"cfg_l{i}"] / 2**f for i in (1, 2))
    ins = case.inputs
    if one.function.startswith("fk"):
        angles = [accuracy.decode(port, one, ins[port.name]) for port in one.inputs]
        tip = {1: lambda t: truth.fk1(t, l1), 2: lambda *t: truth.fk2(*t, l1, l2),
               3: lambda *t: truth.fk3(*t, l1, l2)}[len(angles)](*angles)
        return {f"out_{axis}": to_fixed(value, f) for axis, value in zip("xyz", tip)}
    target = [ins[f"in_{axis}"] / 2**f for axis in "xyz" if f"in_{axis}" in ins]
    joints = {"ik1": lambda: (truth.ik1(*target),), "ik2": lambda: truth.ik2(*target, l1, l2, ins["in_elbow"]),
              "ik3": lambda: truth.ik3(*target, l1, l2, ins["in_elbow"])}[one.function]()
    return {port.name: accuracy.encode(port, one, np.nan_to_num(angle)) for port, angle in zip(one.outputs, joints)}


FUNCTIONS = pytest.mark.parametrize("function", PORTS)
FAMILIES = pytest.mark.parametrize("family", JOINT)


@FUNCTIONS
@FAMILIES
@pytest.mark.parametrize("make", (accuracy.trajectory_case, accuracy.sweep_case))
def test_an_ideal_core_loses_only_its_rounding(function, family, make):
    one = core(function, family)
    case = make(one, ARM)
    found = accuracy.errors(one, ARM, case, ideal(one, case))
    assert found.arithmetic.size > 900
    if function.startswith("fk"):  # half an LSB in each of two or three coordinates
        assert 0.4 < found.arithmetic.max() <= np.sqrt(len(one.outputs)) / 2
    else:
        assert found.arithmetic.max() < 1e-3
    assert found.quantisation.max() < (60 if family != "classic" else 4)


@FUNCTIONS
@FAMILIES
def test_errors_are_what_was_put_in(function, family):
    """An answer that is off by a known amount scores that amount."""
    one = core(function, family, S=30, A=30)
    case = accuracy.trajectory_case(one, ARM)
    answer = ideal(one, case)
    if function.startswith("fk"):
        answer["out_y"] = answer["out_y"] + 7
        expected = 7
    else:  # the base joint moved by a milliradian moves the tip by its distance from that joint
        port = one.outputs[-1 if function == "ik3" else 0]
        angle = accuracy.decode(port, one, answer[port.name])
        answer[port.name] = accuracy.encode(port, one, angle + 1e-3)
        expected = np.hypot(case.tip[:, 0], case.tip[:, 1]) * 1e-3 * 256
    found = accuracy.errors(one, ARM, case, answer)
    assert found.arithmetic == pytest.approx(np.broadcast_to(expected, 1000), abs=1)
    assert accuracy.mm_per_lsb(one, ARM) == pytest.approx(10 / 256)
    scaled = accuracy.summary(found.arithmetic, accuracy.mm_per_lsb(one, ARM))
    assert scaled["max"] == pytest.approx(found.arithmetic.max() * 10 / 256)


@pytest.mark.parametrize("family", ("rational", "classic"))
def test_resolution_of_the_words_is_not_arithmetic_error(family):
    """Eight spread bits (the paper's) or eight angle bits cost much, and all of it counts as words."""
    one = core("fk1", family, S=8, A=8)
    case = accuracy.trajectory_case(one, ARM)
    found = accuracy.errors(one, ARM, case, ideal(one, case))
    assert found.arithmetic.max() < 0.71
    step = np.radians(2.54) if family == "rational" else np.pi / 256
    assert 0.5 * step < found.quantisation.max() / (32.5 * 256) <= step * 1.01


@FAMILIES
@pytest.mark.parametrize("function", ("ik1", "ik2", "ik3"))
def test_a_word_off_by_one_is_an_error_and_a_tie_is_not(function, family):
    one = core(function, family)
    case = accuracy.trajectory_case(one, ARM)
    answer = ideal(one, case)
    port = one.outputs[0]
    turn = 1 << port.width
    off = accuracy.errors(one, ARM, case, {**answer, port.name: (answer[port.name] + 1) % turn}).arithmetic
    far = accuracy.errors(one, ARM, case, {**answer, port.name: (answer[port.name] + 3) % turn}).arithmetic
    assert np.median(off) > 0 and np.all(far > off)
    # the word before the true one, at a direction just past their common border: nearly no error
    theta = accuracy.decode(port, one, np.array([turn // 8 + 0.5 + 1e-4]))
    before, after = (accuracy.within_cell(port, one, np.array([turn // 8 + i]), theta) for i in (0, 1))
    assert abs(before - theta) < 1e-4 * truth.TURN / turn * 8 and after == pytest.approx(theta, abs=1e-12)


@FAMILIES
def test_a_cell_ends_half_an_lsb_from_its_word(family):
    one = core("ik1", family)
    port = one.outputs[0]
    word = np.array([(1 << port.width) // 8])
    theta = accuracy.decode(port, one, word)
    for off in (-3, 2):
        border = accuracy.decode(port, one, word + off - 0.5 * np.sign(off))
        assert accuracy.within_cell(port, one, word + off, theta) == pytest.approx(border, abs=1e-12)


@FUNCTIONS
def test_the_words_lose_the_same_whatever_the_core_answers(function):
    one = core(function)
    case = accuracy.trajectory_case(one, ARM)
    answer = ideal(one, case)
    wrong = {name: words * 0 for name, words in answer.items()}
    good, bad = (accuracy.errors(one, ARM, case, outputs) for outputs in (answer, wrong))
    assert np.array_equal(good.quantisation, bad.quantisation) and bad.arithmetic.max() > 1000


def test_the_elbow_follows_the_arm():
    for name, elbow in (("cobra600", 0), ("geomagic_touch", 1)):
        words = accuracy.trajectory_case(core("ik2"), arms.load(name)).inputs["in_elbow"]
        assert np.all(words == elbow)


def test_cells_wrap_round_the_full_turn():
    for family in JOINT:
        one = core("ik1", family)
        port = one.outputs[0]
        for theta in (1e-5, -1e-5):
            at = accuracy.within_cell(port, one, np.array([0]), np.array([theta]))
            assert abs(truth.difference(at, theta)) < 1e-4
        last = accuracy.within_cell(port, one, np.array([(1 << port.width) - 1]), np.array([0.0]))
        assert abs(truth.difference(last, 0)) < 2e-4


def test_signed_angles_are_words_of_their_port():
    one = core("fk1", "classic")
    port = cores.Port("in_j1", 16, True)
    assert accuracy.encode(port, one, np.array([-np.pi / 2, 3 * np.pi / 2])).tolist() == [-16384, -16384]
    assert accuracy.decode(port, one, np.array([-16384])) == pytest.approx(3 * np.pi / 2)


def test_samples_without_a_truth_are_left_out():
    """x = y = 0 has no direction; a saturated coordinate is flagged, not measured."""
    one = core("ik1")
    zero = np.array([0, 256, 0])
    case = accuracy.Case({"in_x": zero, "in_y": 0 * zero}, {}, np.zeros((3, 1)), np.zeros((3, 3)))
    assert accuracy.errors(one, ARM, case, {"out_j1": 0 * zero}).arithmetic.tolist() == [0]
    wide = arms.Arm(**{**ARM.__dict__, "l1": 1275.0, "l2": 100.0})
    one = core("fk2")
    case = accuracy._case(one, wide, np.zeros((1, 2)), np.zeros((1, 3)))
    assert accuracy.errors(one, wide, case, {"out_x": [32767], "out_y": [0]}).arithmetic.size == 0
    assert accuracy.summary(np.array([])) is None and accuracy.summary(None) is None


def test_summary():
    assert accuracy.summary(np.array([3.0, 4.0]), 2) == pytest.approx({"max": 8, "rms": 2 * np.sqrt(12.5)})


def test_sweep_covers_borders_and_both_elbows():
    one = core("fk1")
    words = accuracy.sweep_case(one, ARM).inputs["in_j1"]
    assert {k << 24 for k in range(4)} <= set(words.tolist()) and (4 << 24) - 1 in words
    case = accuracy.sweep_case(core("ik2"), ARM)
    assert set(case.inputs["in_elbow"].tolist()) == {0, 1}
    again = accuracy.sweep_case(core("ik2"), ARM)
    assert all(np.array_equal(case.inputs[name], again.inputs[name]) for name in case.inputs)


def test_configuration_words():
    one = core("fk2")
    assert accuracy.config(one, ARM) == {"cfg_l1": 32.5 * 256, "cfg_l2": 27.5 * 256}
    odd = cores.Core(**{**one.__dict__, "cfg": (cores.Port("cfg_gain", 16, False),)})
    with pytest.raises(ValueError, match=r"has no config\(\) for \['cfg_gain'\]"):
        accuracy.config(odd, ARM)


@pytest.mark.parametrize("function, params, answer, worst", [
    ("isqrt", {"W": 16, "F": 0}, lambda i: {"out_root": np.floor(np.sqrt(i["in_d"]))}, 1),
    ("divide", {"WN": 16, "WD": 16, "F": 4}, lambda i: {"out_q": (i["in_n"] << 4) // np.maximum(i["in_d"], 1)}, 1),
])
def test_primitives_in_lsb_of_their_output(function, params, answer, worst):
    ports = {"isqrt": {"d": "uW"}, "divide": {"n": "uWN", "d": "uWD"}}[function]
    entry = {"family": "arith", "function": function, "architecture": "comb", "model": "fixed.isqrt", "sources": [],
             "in": ports, "out": {"q": "u20"}, "sets": [{"id": "t", "params": params, "latency": 0, "ii": 0}]}
    one = cores._expand(function, entry)[0]
    case = accuracy.sweep_case(one, ARM)
    out = {name: value.astype(np.int64) for name, value in answer(case.inputs).items()}
    found = accuracy.errors(one, ARM, case, out)
    assert 0.9 < found.arithmetic.max() < worst and found.quantisation is None
    off = {name: value + 2 for name, value in out.items()}
    assert accuracy.errors(one, ARM, case, off).arithmetic.max() == pytest.approx(2, abs=0.001)
    assert accuracy.trajectory_case(one, ARM) is None


@pytest.mark.parametrize("one", [one for one in cores.all_cores() if one.function in accuracy.PRIMITIVES],
                         ids=lambda one: one.id)
def test_bit_true_models_of_the_primitives_are_near_their_functions(one):
    """And an answer one LSB off is farther away: the real-valued truths stand on the right ports and scales."""
    case = accuracy.sweep_case(one, ARM)
    answer = one.model(one.params, **case.inputs)
    exact = accuracy.PRIMITIVES[one.function][1](one, case.inputs)
    assert 0 <= accuracy.errors(one, ARM, case, answer).arithmetic.max() <= 1.5
    shifted = {name: words + 2 * (name in exact) for name, words in answer.items()}
    assert accuracy.errors(one, ARM, case, shifted).arithmetic.max() >= 1.5


def test_an_unknown_function_has_no_truth():
    one = cores.Core(**{**core("fk1").__dict__, "function": "skid"})
    assert accuracy.trajectory_case(one, ARM) is None and accuracy.sweep_case(one, ARM) is None
    assert accuracy.errors(one, ARM, accuracy.Case({}, {}), {}) is None
