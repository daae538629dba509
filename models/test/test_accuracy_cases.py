"""What the cores are fed: the arm's day, the sweep, the workspace with its worst words, and their configuration."""

import numpy as np
import pytest
from quadrance import accuracy, arms, codecs, cores, truth
from quadrance.accuracy.arm import joint_ports

from models.test.specimen import JOINT, PORTS, core, ideal

ARM = arms.load("cobra600")
KINEMATIC = [one for one in cores.all_cores() if one.function in accuracy.JOINTS and one.params["W"] == 16]
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
    assert list(derived) == ["cfg_l1", "cfg_l2", "cfg_q", "cfg_r", "cfg_e"]


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
