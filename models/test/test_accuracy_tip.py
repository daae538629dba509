"""The error measures at the tip: an ideal core scores what rounding alone costs, and every kind of fault is seen."""

import numpy as np
import pytest
from quadrance import accuracy, arms, codecs
from quadrance.accuracy.cases import case_of
from quadrance.cores import Core, joints

from models.test.specimen import JOINT, PORTS, core, ideal

ARM = arms.load("cobra600")
FUNCTIONS = pytest.mark.parametrize("function", PORTS)
JOINTS = pytest.mark.parametrize("joint", JOINT)


@FUNCTIONS
@JOINTS
@pytest.mark.parametrize("make", (accuracy.trajectory_case, accuracy.sweep_case))
def test_an_ideal_core_loses_only_its_rounding(function, joint, make):
    one = core(function, joint)
    case = make(one, ARM)
    found = accuracy.errors(one, ARM, case, ideal(one, case))
    assert found.arithmetic.size > 900
    if function.startswith("fk"):  # half an LSB in each of two or three coordinates
        assert 0.4 < found.arithmetic.max() <= np.sqrt(len(one.outputs)) / 2
    else:
        assert found.arithmetic.max() < 1e-3
        assert found.total == pytest.approx(found.quantisation, abs=1e-9)
    assert found.quantisation.max() < (60 if joint == "spread" else 4)


@FUNCTIONS
@JOINTS
def test_errors_are_what_was_put_in(function, joint):
    """An answer that is off by a known amount scores that amount."""
    one = core(function, joint, S=30, A=30)
    case = accuracy.trajectory_case(one, ARM)
    answer = ideal(one, case)
    if function.startswith("fk"):
        answer["out_y"] = answer["out_y"] + 7
        expected = 7
    else:  # the base joint moved by a milliradian moves the tip by its distance from that joint
        base = joints(one.outputs)[-1 if function == "ik3" else 0]
        answer |= codecs.encode(base, codecs.decode(base, answer) + 1e-3)
        expected = np.hypot(case.tip[:, 0], case.tip[:, 1]) * 1e-3 * 256
    found = accuracy.errors(one, ARM, case, answer)
    assert found.arithmetic == pytest.approx(np.broadcast_to(expected, 1000), abs=1)
    assert found.total == pytest.approx(np.broadcast_to(expected, 1000), abs=2)
    assert accuracy.mm_per_lsb(one, ARM) == pytest.approx(10 / 256)
    scaled = accuracy.summary(found.arithmetic, accuracy.mm_per_lsb(one, ARM))
    assert scaled["max"] == pytest.approx(found.arithmetic.max() * 10 / 256)


@JOINTS
def test_resolution_of_the_words_is_not_arithmetic_error(joint):
    """Eight bits of spread (the paper's), angle or vector cost much, and all of it counts as words."""
    one = core("fk1", joint, S=8, A=8, U=8)
    case = accuracy.trajectory_case(one, ARM)
    found = accuracy.errors(one, ARM, case, ideal(one, case))
    assert found.arithmetic.max() < 0.71
    step = {"spread": np.radians(2.54), "angle": np.pi / 256, "vector": np.sqrt(0.5) / 255}[joint]
    assert 0.5 * step < found.quantisation.max() / (32.5 * 256) <= step * 1.01
    assert codecs.half_step(one.inputs[:1]) <= step


@JOINTS
@pytest.mark.parametrize("function", ("ik1", "ik2", "ik3"))
def test_a_word_off_by_one_is_an_error(function, joint):
    one = core(function, joint)
    case = accuracy.trajectory_case(one, ARM)
    answer = ideal(one, case)
    if joint == "vector":
        off, far = ({**answer, "out_c1": answer["out_c1"] - k * np.sign(answer["out_n1"]),
                     "out_n1": answer["out_n1"] + k * np.sign(answer["out_c1"])} for k in (1, 3))
    else:
        port = one.outputs[0]
        off, far = ({**answer, port.name: (answer[port.name] + k) % (1 << port.width)} for k in (1, 3))
    off, far = (accuracy.errors(one, ARM, case, wrong).arithmetic for wrong in (off, far))
    assert np.median(off) > 0 and np.all(far > off)


@FUNCTIONS
def test_the_words_lose_the_same_whatever_the_core_answers(function):
    one = core(function)
    case = accuracy.trajectory_case(one, ARM)
    answer = ideal(one, case)
    wrong = {name: words * 0 for name, words in answer.items()}
    good, bad = (accuracy.errors(one, ARM, case, outputs) for outputs in (answer, wrong))
    assert np.array_equal(good.quantisation, bad.quantisation) and bad.arithmetic.max() > 1000
    assert bad.total.max() > 1000


def test_samples_without_a_truth_are_left_out():
    """x = y = 0 has no direction; a saturated coordinate is flagged, not measured."""
    one = core("ik1")
    zero = np.array([0, 256, 0])
    case = accuracy.Case({"in_x": zero, "in_y": 0 * zero}, {}, np.zeros((3, 1)), np.zeros((3, 3)))
    assert accuracy.errors(one, ARM, case, {"out_j1": 0 * zero}).arithmetic.tolist() == [0]
    every = accuracy.errors(one, ARM, case, {"out_j1": 0 * zero}, every=True)
    assert np.isnan(every.arithmetic).tolist() == np.isnan(every.total).tolist() == [True, False, True]
    wide = arms.Arm(**{**ARM.__dict__, "l1": 1275.0, "l2": 100.0})
    one = core("fk2")
    case = case_of(one, wide, np.zeros((1, 2)), np.zeros((1, 3)))
    assert accuracy.errors(one, wide, case, {"out_x": [32767], "out_y": [0]}).arithmetic.size == 0
    assert accuracy.summary(np.array([])) is None and accuracy.summary(None) is None


def test_out_of_reach_the_total_is_from_the_nearest_point():
    one = core("ik2")
    angles, tip = np.zeros((2, 2)), np.array([[64.0, 0, 0], [0, 2.5, 0]])  # the arm reaches 60 and no nearer than 5
    case = case_of(one, ARM, angles, tip)
    found = accuracy.errors(one, ARM, case, {"out_j1": np.array([0, 3 << 24]), "out_j2": np.array([0, 2 << 24])})
    assert found.total.tolist() == pytest.approx([0, 10 * 256]), "j1 of the second points the wrong way"
    assert found.arithmetic.tolist() == pytest.approx([0, 10 * 256])


def test_summary():
    assert accuracy.summary(np.array([3.0, 4.0]), 2) == pytest.approx({"max": 8, "rms": 2 * np.sqrt(12.5)})


def test_an_unknown_function_has_no_truth():
    one = Core(**{**core("fk1").__dict__, "function": "skid"})
    assert accuracy.trajectory_case(one, ARM) is None and accuracy.sweep_case(one, ARM) is None
    assert accuracy.workspace_case(one, ARM, 10, np.random.default_rng(1)) is None
    assert accuracy.errors(one, ARM, accuracy.Case({}, {}), {}) is None
