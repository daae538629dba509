"""The measures of error: what an ideal core scores, what cores are fed, the errors of primitives; and the bounds."""

from __future__ import annotations

import re
from importlib import import_module
from importlib.util import find_spec

import numpy as np
import pytest
from quadrance import accuracy, arms, bounds, classic, codecs, cordic, cores, truth
from quadrance.accuracy import Case
from quadrance.accuracy.arm import joint_ports
from quadrance.accuracy.cases import case_of
from quadrance.accuracy.primitives import PRIMITIVES
from quadrance.cores import Core, joints
from quadrance.fixed import Ints, to_fixed

from models.test.claims import distinct

PORTS = {"fk1": ("j1", "x y"), "fk2": ("j1 j2", "x y"), "fk3": ("j1 j2 j3", "x y z"),
         "ik1": ("x y", "j1"), "ik2": ("x y", "j1 j2"), "ik3": ("x y z", "j1 j2 j3")}
JOINT = {"spread": "spread S", "angle": "angle A", "vector": "vector U"}


def core(function: str, joint: str = "spread", **params: int) -> Core:
    """A core of that function with joints of that type, Q7.8, S = 24, A = U = 16 unless `params` say otherwise."""
    spec = {**{f"j{i}": JOINT[joint] for i in (1, 2, 3)}, **dict.fromkeys("xyz", "sW")}
    ins, outs = ({name: spec[name] for name in names.split()} for names in PORTS[function])
    if function in ("ik2", "ik3"):
        ins["elbow"] = "u1"
    shared = {"model": "fixed.isqrt", "cfg": {"l1": "uW", "l2": "uW"}, "in": ins, "out": outs}
    own = {"architecture": "comb", "latency": 1, "sets": {"t": {"W": 16, "F": 8, "S": 24, "A": 16, "U": 16} | params}}
    return cores.expand("rational", function, shared, f"specimen_{function}", own)[0]


def ideal(one: Core, case: Case) -> dict[str, Ints]:
    """The correctly rounded answer to a case, computed the plain way."""
    f = one.params["F"]
    l1, l2 = (case.cfg[f"cfg_l{i}"] / 2**f for i in (1, 2))
    ins = case.inputs
    if one.function.startswith("fk"):
        angles = [codecs.decode(joint, ins) for joint in cores.joints(one.inputs)]
        tip = {1: lambda t: truth.fk1(t, l1), 2: lambda *t: truth.fk2(*t, l1, l2),
               3: lambda *t: truth.fk3(*t, l1, l2)}[len(angles)](*angles)
        return {f"out_{axis}": to_fixed(value, f) for axis, value in zip("xyz", tip)}
    target = [ins[f"in_{axis}"] / 2**f for axis in "xyz" if f"in_{axis}" in ins]
    joints = {"ik1": lambda: (truth.ik1(*target),), "ik2": lambda: truth.ik2(*target, l1, l2, ins["in_elbow"]),
              "ik3": lambda: truth.ik3(*target, l1, l2, ins["in_elbow"])}[one.function]()
    answer: dict[str, Ints] = {}
    for joint, angle in zip(cores.joints(one.outputs), joints):
        answer |= codecs.encode(joint, np.nan_to_num(angle))
    return answer


# At the tip

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


# What the cores are fed: the arm's day, the sweep, the workspace with its worst words, their configuration

KINEMATIC = [one for one in distinct() if one.function in accuracy.JOINTS and one.params["W"] == 16]
MODELS = list({(one.model_name, one.set_id): one for one in KINEMATIC}.values())


def worst(one, name="cobra600", count=4096):
    """Errors of a listed core's model over the workspace of an arm."""
    arm = arms.load(name)
    case = accuracy.workspace_case(one, arm, count, np.random.default_rng(1))
    return accuracy.errors(one, arm, case, one.model(one.params, **case.inputs, **case.cfg))


def test_the_elbow_follows_the_arm():
    for name, elbow in (("cobra600", 0), ("geomagic_touch", 1)):
        words = accuracy.trajectory_case(core("ik2"), arms.load(name)).inputs["in_elbow"]
        assert np.all(words == elbow)


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
    derived = accuracy.configure(cores.find("rational_ik2"), cfg_l1=8320, cfg_l2=7040)
    assert list(derived) == ["cfg_l1", "cfg_l2", "cfg_q", "cfg_r", "cfg_e", "cfg_margin", "cfg_slack"]


# The workspace


def test_the_worst_word_of_rational_fk2_is_found():
    """Both joints half a word from a border of the stretched arm: asin 2^-12.5 of 60 and of 27.5 units, 0.151 mm."""
    one = cores.find("rational_fk2-S24")
    found = worst(one)
    half = codecs.half_step(one.inputs[:1])
    assert half == pytest.approx(2**-12.5, rel=1e-6)
    assert 3.8 < found.quantisation.max() < 4.0
    assert found.quantisation.max() == pytest.approx(256 * half * (60 + 27.5), rel=1e-3)
    assert found.quantisation.max() * accuracy.mm_per_lsb(one, ARM) == pytest.approx(0.151, abs=5e-4)
    day = accuracy.trajectory_case(one, ARM)
    lucky = accuracy.errors(one, ARM, day, one.model(one.params, **day.inputs, **day.cfg))
    assert lucky.quantisation.max() < 0.2, "the trajectory alone does not see it"


@pytest.mark.parametrize("one", MODELS, ids=lambda one: one.id)
def test_the_total_is_made_of_its_parts(one):
    """Forward exactly, sample by sample. Inverse: an answer one word off is rounded otherwise than the true joints are,
    so only the greatest ones compare, and the lower one within the share of a coarse word."""
    found = worst(one)
    parts = found.arithmetic.max(), found.quantisation.max()
    assert found.total.max() <= sum(parts)
    if one.function.startswith("fk"):
        assert np.all(found.total <= found.arithmetic + found.quantisation + 1e-9)
        assert np.all(found.total >= np.abs(found.arithmetic - found.quantisation) - 1e-9)
        # words of a vector cost so little that the greatest parts need not meet in one sample
        assert found.total.max() >= max(parts) - (min(parts) if one.family == "vector" else 1e-9)
    else:
        # three coarse words rarely reach their worst in one sample
        coarse = one.params.get("S") == 8 or (one.family, one.function) == ("table", "ik3")
        assert found.total.max() >= (0.9 if coarse else 0.99) * max(parts)


@pytest.mark.parametrize("joint", JOINT)
@pytest.mark.parametrize("function", PORTS)
def test_the_workspace_is_within_the_limits_and_rounding_never_beyond_half_a_word(function, joint):
    one = core(function, joint)
    for name in ("cobra600", "dobot_magician", "phantomx_leg", "ur5"):
        arm = arms.load(name)
        case = accuracy.workspace_case(one, arm, 3000, np.random.default_rng(2))
        assert case.angles.shape == (3000, accuracy.JOINTS[function]) and case.tip.shape == (3000, 3)
        for theta, limit, joint in zip(case.angles.T, (*arm.limits, (-180, 180)), joint_ports(one)):
            low, high = np.radians(limit)
            assert theta.min() >= low and theta.max() <= high and np.ptp(theta) > 0.8 * min(high - low, truth.TURN)
            off = np.abs(truth.difference(codecs.decode(joint, codecs.encode(joint, theta)), theta))
            assert off.max() <= codecs.half_step(joint) * (1 + 1e-6)
        found = accuracy.errors(one, arm, case, ideal(one, case))
        if function.startswith("fk"):  # every joint half a word off, on the longest lever
            l1, l2 = (256 * length for length in arm.links)
            lever = {"fk1": l1, "fk2": l1 + 2 * l2, "fk3": 2 * l1 + 3 * l2}[function]
            assert found.quantisation.max() <= codecs.half_step(joint) * lever + 0.5 * accuracy.JOINTS[function]


@pytest.mark.parametrize("joint", JOINT)
def test_the_workspace_reaches_every_border_at_every_scale_on_both_sides(joint):
    one = core("fk3", joint)
    case = accuracy.workspace_case(one, arms.load("ur5"), 20_000, np.random.default_rng(3))
    for i, word in enumerate(joint_ports(one)):
        quadrant = codecs.quadrant(word)
        place = codecs.place(word, case.angles[:, i])
        border = np.rint(place / quadrant)
        off = place - border * quadrant
        for k in range(4):
            for side in (-1, 1):
                scales = np.log2(np.maximum(off * side, 2.0**-5))[border % 4 == k]
                seen = set(np.floor(scales[scales > -5]).astype(int).tolist())
                assert set(range(-4, quadrant.bit_length() - 2)) <= seen, (joint, i, k, side)
    elbow = np.abs(np.sin(case.angles[:, 1]))
    assert np.mean(elbow < 1e-3) > 0.05 and np.mean(elbow > 0.1) > 0.2


def test_the_workspace_starts_with_every_combination_of_border_cells():
    one = core("fk2")
    case = accuracy.workspace_case(one, arms.load("ur5"), 1000, np.random.default_rng(4))
    words = [codecs.place(joint, theta) for joint, theta in zip(joint_ports(one), case.angles.T)]
    words = np.stack(words, axis=-1)[:64]
    near = np.rint(np.mod(words, 1 << 26) * 4)  # quarters of an LSB
    assert len({tuple(row) for row in near.tolist()}) == 64
    assert {float(off) for off in np.abs(np.mod(words + (1 << 23), 1 << 24) - (1 << 23)).ravel().round(2)} == {0.5}


def test_the_workspace_follows_its_generator():
    one = core("ik3")
    cases = [accuracy.workspace_case(one, ARM, 2000, np.random.default_rng(seed)) for seed in (1, 1, 2)]
    assert np.array_equal(cases[0].angles, cases[1].angles) and not np.array_equal(cases[0].angles, cases[2].angles)
    assert set(cases[0].inputs["in_elbow"].tolist()) == {0, 1}


# Primitives


@pytest.mark.parametrize("function, params, answer, worst", [
    ("isqrt", {"W": 16, "F": 0}, lambda i: {"out_root": np.floor(np.sqrt(i["in_d"]))}, 1),
    ("divide", {"WN": 16, "WD": 16, "F": 4}, lambda i: {"out_q": (i["in_n"] << 4) // np.maximum(i["in_d"], 1)}, 1),
])
def test_primitives_in_lsb_of_their_output(function, params, answer, worst):
    ports = {"isqrt": {"d": "uW"}, "divide": {"n": "uWN", "d": "uWD"}}[function]
    out = {"isqrt": {"root": "u20"}, "divide": {"q": "u20"}}[function]
    one = cores.expand("arith", function, {"model": "fixed.isqrt", "in": ports, "out": out}, function,
                       {"architecture": "comb", "latency": 0, "sets": {"t": params}})[0]
    case = accuracy.sweep_case(one, ARM)
    out = {name: value.astype(np.int64) for name, value in answer(case.inputs).items()}
    found = accuracy.errors(one, ARM, case, out)
    assert 0.9 < found.arithmetic.max() < worst and found.quantisation is None and found.total is None
    off = {name: value + 2 for name, value in out.items()}
    assert accuracy.errors(one, ARM, case, off).arithmetic.max() == pytest.approx(2, abs=0.001)
    assert accuracy.trajectory_case(one, ARM) is None
    assert accuracy.workspace_case(one, ARM, 10, np.random.default_rng(1)) is None


@pytest.mark.parametrize("one", [one for one in cores.all_cores() if one.function in PRIMITIVES],
                         ids=lambda one: one.id)
def test_bit_true_models_of_the_primitives_are_near_their_functions(one):
    """And an answer one LSB off is farther away: the real-valued truths stand on the right ports and scales."""
    case = accuracy.sweep_case(one, ARM)
    answer = one.model(one.params, **case.inputs)
    exact = PRIMITIVES[one.function][1](one, case.inputs)
    most = 1.5  # LSB; a spread of 24 bits is much finer than an angle of 18
    if one.function == "angle_to_spread":
        most = bounds.codec.angle_to_spread(one.params, np.pi / 4)
    assert 0 <= accuracy.errors(one, ARM, case, answer).arithmetic.max() <= most
    shifted = {name: words + 2 * (name in exact) for name, words in answer.items()}
    assert accuracy.errors(one, ARM, case, shifted).arithmetic.max() >= 1.5


# Bounds hold along a day of real arms, and give the figures that the pages of the cores print

W16 = {"W": 16, "F": 8, "A": 16}
CORES = {(one.model_name, one.set_id): one for one in distinct()
         if one.function in accuracy.JOINTS and (one.params["W"], one.params["F"]) == (16, 8)}


@pytest.mark.parametrize("one", CORES.values(), ids=lambda one: one.id)
def test_the_tip_stays_within_its_bound_on_every_arm(one):
    share = 0.0
    for arm in map(arms.load, arms.known()):
        lengths = [round(256 * length) for length in arm.links]
        if sum(lengths) > 1 << 14:
            continue
        case = accuracy.trajectory_case(one, arm, 600)
        found = accuracy.errors(one, arm, case, one.model(one.params, **case.inputs, **case.cfg))
        bound = bounds.tip(one, *lengths)
        assert found.arithmetic.max() <= bound + 1e-6, arm.id
        share = max(share, found.arithmetic.max() / max(bound, 1e-6))
    assert share > 0.01 or one.function == "ik1", "a bound that nothing comes near"


@pytest.mark.parametrize("s, r, forward, inverse", [
    (8, 4, (120, 884, 1825), (252, 1301, 2649)), (24, 3, (11, 17, 25), (4.9, 12, 21.5))])
def test_figures_that_the_paper_s_page_prints(s, r, forward, inverse):
    p = W16 | {"S": s, "R": r}
    links = [(256 * l1, 256 * l2) for l1, l2 in ((3, 2), (32.5, 27.5), (63.9, 63.9))]
    assert [bounds.paper.forward(p, 2, *pair) for pair in links] == pytest.approx(forward, abs=0.5)
    assert [bounds.paper.inverse(p, 2, *pair) for pair in links] == pytest.approx(inverse, abs=0.5)


def test_figures_that_the_other_pages_print():
    """To the digit printed, rounded or rounded up."""
    aim = [part for magnitude, guard in ((True, cordic.AIM_GUARD), (False, classic.AIM_GUARD))
           for part in bounds.cordic.angle(W16, guard, magnitude)]
    turn = 2 * np.pi / 65536
    half, full = 1 << 13, 65532
    for bound, printed, digit in (
            (bounds.cordic.rotate(W16), 1.47, 0.01), (aim[0], 0.84, 0.01), (aim[1] * turn, 0.24, 0.01),
            (aim[2], 0.88, 0.01), (aim[3] * turn, 0.39, 0.01),
            (bounds.codec.spread_chord(16), 0.83, 0.01), (bounds.rational.turn(16) * 2**16, 1.06, 0.01),
            (bounds.rational.fk1(W16, 1 << 14), 0.83, 0.01), (bounds.rational.gap(W16 | {"S": 24}, half, half), 16, 1),
            (bounds.classic.chain(W16, 2, 0, 2 * half), 2, 0.1), (bounds.classic.chain(W16, 3, 0, 2 * half), 2.9, 0.1),
            (bounds.classic.chain(W16, 2, full, full), 3.5, 0.1), (bounds.classic.chain(W16, 3, full, full), 5.4, 0.1)):
        assert printed - digit <= bound <= printed + digit / 2, (bound, printed)


def test_every_bound_that_a_page_or_a_header_names_is_there():
    paths = [*cores.RTL.rglob("*.md"), *cores.RTL.rglob("*.v")]
    named = {(path.name, name) for path in paths for name in re.findall(r"\bbounds\.(\w+(?:\.\w+)*)", path.read_text())}

    def there(name: str) -> bool:
        module, _, function = name.rpartition(".")
        return bool(find_spec(f"quadrance.bounds.{name}" if not module else f"quadrance.bounds.{module}")) and \
            (not module or hasattr(import_module(f"quadrance.bounds.{module}"), function))

    assert len(named) > 30 and not [one for one in sorted(named) if not there(one[1])]
