"""Arm files: what they say, every way they can be wrong, and the trajectories made from them."""

import math

import numpy as np
import pytest
from quadrance import arms, truth
from quadrance.arms import ArmError
from quadrance.trajectory import limits, smooth, trajectory

MATHS = {  # L1, L2 (mm) of the table of real arms
    "cobra600": (325, 275), "linuxcnc_scara": (340, 250), "staubli_tx40": (225, 225),
    "puma560": (431.8, math.hypot(20.3, 431.8)), "kr6_r700": (315, math.hypot(35, 365)), "ur5": (425, 392.25),
    "uarm_swift_pro": (142.07, 158.81), "dobot_magician": (135, 147), "geomagic_touch": (135, 135),
    "phantomx_leg": (66.2, 132.7)}

GOOD = """
name = "Test"
source = "here"
mm_per_unit = 10.0
[links]
l1 = 325
l2 = 275.0
[constants]
base = 1
elbow = 20.0
absolute_elbow = true
[limits]
shoulder = [-105, 105]
elbow = [-150, 150.5]
"""


@pytest.mark.parametrize("name", arms.known())
def test_known_arms(name):
    arm = arms.load(name)
    assert (arm.l1, arm.l2) == pytest.approx(MATHS[name])
    assert arm.source and arm.id == name
    assert arm.links == pytest.approx((arm.l1 / 10, arm.l2 / 10))
    assert arm.absolute_elbow == (name in ("uarm_swift_pro", "dobot_magician", "geomagic_touch"))


def test_every_arm_of_the_table_is_there():
    assert set(arms.known()) == set(MATHS)


def test_cobra_is_60_units_of_10_mm():
    arm = arms.load("cobra600")
    assert sum(arm.links) == pytest.approx(60) and len(arm.limits) == 2


def test_load_by_path(tmp_path):
    file = tmp_path / "mine.toml"
    file.write_text(GOOD)
    arm = arms.load(file)
    assert arm == arms.load(str(file))
    assert arm.l2 == pytest.approx(math.hypot(275, 20)) and arm.l1 == 325
    assert arm.elbow_angle == pytest.approx(math.degrees(math.atan2(20, 275)))
    assert (arm.base, arm.lateral, arm.absolute_elbow) == (1, 0, True)
    assert arm.limits == ((-105, 105), (-150, 150.5))


@pytest.mark.parametrize("old, new, key, reason", [
    ('name = "Test"\n', "", "name", "is missing"),
    ("l2 = 275.0\n", "", "links.l2", "is missing"),
    ("elbow = [-150, 150.5]\n", "", "limits.elbow", "is missing"),
    ("[limits]", "[limit]", "limit", "not a key of an arm file"),
    ("l1 = 325", "length1 = 325", "links.length1", "known here: l1, l2"),
    ("base = 1", "hight = 1", "constants.hight", "not a key"),
    ("shoulder =", "joint1 =", "limits.joint1", "not a key"),
    ("l1 = 325", 'l1 = "325"', "links.l1", "must be a number"),
    ("l1 = 325", "l1 = true", "links.l1", "must be a number"),
    ("l1 = 325", "l1 = nan", "links.l1", "must be finite"),
    ("l1 = 325", "l1 = -325", "links.l1", "must be positive"),
    ("l2 = 275.0", "l2 = 0", "links.l2", "must be positive"),
    ("mm_per_unit = 10.0", "mm_per_unit = -1", "mm_per_unit", "must be positive"),
    ("mm_per_unit = 10.0", "mm_per_unit = 4.6", "links", "Q7.8 ends at 127.996; raise mm_per_unit above 4.69"),
    ("mm_per_unit = 10.0", "mm_per_unit = 100000", "links", "less than one LSB"),
    ('source = "here"', "source = 7", "source", "must be a string"),
    ("absolute_elbow = true", "absolute_elbow = 1", "constants.absolute_elbow", "must be true or false"),
    ("[-105, 105]", "[105, -105]", "limits.shoulder", "lower limit 105 must be below the upper limit -105"),
    ("[-105, 105]", "[5, 5]", "limits.shoulder", "must be below"),
    ("[-105, 105]", "[-105]", "limits.shoulder", "two numbers"),
    ("[-105, 105]", '["a", 105]', "limits.shoulder", "two numbers"),
    ("[-105, 105]", "[-400, 105]", "limits.shoulder", "within -360 and 360"),
    ("[-105, 105]", "105", "limits.shoulder", "must be a list"),
    ("[-105, 105]", "[-105, 105", "not TOML", "line"),
])
def test_a_wrong_file_names_file_key_and_reason(tmp_path, old, new, key, reason):
    assert GOOD.count(old) == 1
    file = tmp_path / "wrong.toml"
    file.write_text(GOOD.replace(old, new))
    with pytest.raises(ArmError) as error:
        arms.load(file)
    assert str(error.value).startswith(f"{file}: {key}: ") and reason in str(error.value)


def test_unknown_and_absent_arms(tmp_path):
    with pytest.raises(ArmError, match="no arm 'cobra': known arms are cobra600, dobot_magician, "):
        arms.load("cobra")
    with pytest.raises(ArmError, match="nothere.toml: cannot be read: No such file"):
        arms.load(tmp_path / "nothere.toml")
    with pytest.raises(ArmError, match="cannot be read: Is a directory"):
        (tmp_path / "folder.toml").mkdir()
        arms.load(tmp_path / "folder.toml")


@pytest.mark.parametrize("joints", (1, 2, 3))
@pytest.mark.parametrize("name", arms.known())
def test_trajectory_keeps_the_limits_and_the_kinematics(name, joints):
    arm = arms.load(name)
    angles, tip = trajectory(arm, joints)
    assert angles.shape == (1000, joints) and tip.shape == (1000, 3)
    bounds = np.radians((*arm.limits, (-170, 170))[:joints])
    assert np.all(angles >= bounds[:, 0] - 1e-12) and np.all(angles <= bounds[:, 1] + 1e-12)
    l1, l2 = arm.links
    expected = [lambda t: truth.fk1(t, l1), lambda *t: truth.fk2(*t, l1, l2), lambda *t: truth.fk3(*t, l1, l2)]
    assert np.array_equal(tip[:, :max(joints, 2)], np.stack(expected[joints - 1](*angles.T), axis=-1))
    if joints > 1:
        assert np.unique(np.sign(angles[:, 1])).size == 1, "one side of the elbow"
        assert np.abs(np.sin(angles[:, 1])).min() > 0.15, "clear of the singular poses"


def test_trajectory_is_deterministic_smooth_and_wide():
    arm = arms.load("cobra600")
    angles, tip = trajectory(arm, 2, 3000)
    again, _ = trajectory(arm, 2, 3000)
    assert np.array_equal(angles, again)
    for part in (slice(0, 1000), slice(1000, 2000), slice(2000, 3000)):
        step = np.linalg.norm(np.diff(tip[part], axis=0), axis=1)
        assert step[0] < step.max() / 100 and step[-1] < step.max() / 100, "starts and ends at rest"
        assert np.abs(np.diff(step)).max() < step.max() / 30, "no jump of speed"
    circle, line = tip[:1000, :2], tip[1000:2000, :2]
    radius = np.linalg.norm(circle - (circle.max(0) + circle.min(0)) / 2, axis=1)
    assert np.ptp(radius) < 0.001 * radius.mean() and circle[0] == pytest.approx(circle[-1])
    direction = (line[-1] - line[0]) / np.linalg.norm(line[-1] - line[0])
    assert np.cross(np.append(direction, 0), np.c_[line - line[0], 0 * line[:, 0]])[:, 2] == pytest.approx(0, abs=1e-9)
    assert np.ptp(angles[:, 0]) > np.radians(190), "nearly the whole joint range, over quadrant borders"


def test_trajectory_refuses_what_it_cannot_do(tmp_path):
    arm = arms.load("cobra600")
    for joints, samples in ((0, 100), (4, 100), (2, 11)):
        with pytest.raises(ValueError, match="joints must be 1, 2 or 3"):
            trajectory(arm, joints, samples)
    assert trajectory(arm, 2, 12)[0].shape == (12, 2)
    file = tmp_path / "stiff.toml"
    file.write_text(GOOD.replace("[-150, 150.5]", "[-5, 5]"))
    with pytest.raises(ArmError, match=r"limits.elbow: \[-5, 5\] leaves no room"):
        limits(arms.load(file))


def test_smooth_profile():
    u = np.linspace(0, 1, 1001)
    assert smooth(u)[[0, 500, 1000]] == pytest.approx([0, 0.5, 1])
    slope = np.diff(smooth(u)) * 1000
    assert np.all(slope > 0) and slope[0] < 1e-4 and slope.max() == pytest.approx(1.875, abs=1e-3)
    assert np.abs(np.diff(slope)[[0, -1]]).max() * 1000 < 0.1
