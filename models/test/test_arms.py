"""Arm files: what they say, every way they can be wrong, and the trajectories made from them."""

import math

import numpy as np
import pytest
from quadrance import arms, truth, truth_arm, truth_six, truth_srs, truth_ur
from quadrance.arms import ArmError
from quadrance.trajectory import limits, smooth, trajectory

MATHS = {  # L1, L2 (mm) of the table of real arms
    "cobra600": (325, 275), "linuxcnc_scara": (340, 250), "staubli_tx40": (225, 225),
    "puma560": (431.8, math.hypot(20.3, 431.8)), "kr6_r700": (315, math.hypot(35, 365)), "ur5": (425, 392.25),
    "irb2400": (705, math.hypot(135, 755)),
    "ur3e": (243.55, 213.2), "ur5e": (425, 392.2), "ur10e": (612.7, 571.55),
    "iiwa7": (400, 400), "iiwa14": (420, 400),
    "uarm_swift_pro": (142.07, 158.81), "dobot_magician": (135, 147), "geomagic_touch": (135, 135),
    "phantomx_leg": (66.2, 132.7)}

SHOULDER = "shoulder = { name = 'J1', sign = 1, zero = 0 }\n"
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
    assert arm.links == pytest.approx((arm.l1 / arm.mm_per_unit, arm.l2 / arm.mm_per_unit))
    assert arm.absolute_elbow == (name in (
        "irb2400", "uarm_swift_pro", "dobot_magician", "geomagic_touch"))


def test_the_truths_read_the_same_lengths():
    """They read the files of the library by themselves."""
    kinds = {truth_six: "six", truth_ur: "ur", truth_srs: "srs"}
    for module, kind in kinds.items():
        for name in arms.known():
            try:
                lengths = getattr(arms.load(name), kind)
            except arms.ArmError:
                assert name not in module.known()
                continue
            found, mm = module.load(name)
            assert found._asdict() == pytest.approx(lengths) and mm == arms.load(name).mm_per_unit
    assert sum(len(module.known()) for module in kinds) == sum(arms.load(name).axes > 3 for name in arms.known())


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
    ('name = "Test"', r'name = "a\nb"', "name", r"must be one line of text, not 'a\nb'"),
    ("base = 1", r'"a\nb" = 1', r"'constants.a\nb'", "not a key"),
    ("base = 1", "lateral = -1e308", "constants.lateral", "must lie within -1e+09 and 1e+09, not -1e+308"),
    ("base = 1", "base = 0x" + 5000 * "f", "not TOML", "an integer has more than 64 bits"),
    ("base = 1", "base = " + 3000 * "[", "not TOML", "it is nested too deeply"),
    ("base = 1", "base = 1\n[six]\na1 = 3", "six", "is not a key of an arm file"),
    ("[constants]", "[wrist]\nspherical = true\n[constants]", "wrist.flange", "is missing"),
    ("[constants]", "[wrist]\nflange = -1\n[constants]", "wrist.flange", "must not be negative"),
    ("[constants]", "[wrist]\nflange = 1\n[constants]", "limits.yaw", "is missing: an arm with a wrist yaws"),
    ("[constants]", "[wrist]\nspherical = false\nflange = 1\n[constants]", "wrist.flange", "spherical is false"),
    ("[constants]", "[singular]\nelbow = 90\n[constants]", "singular.elbow", "between 0 and 90 degrees, not 90"),
    ("[constants]", "[singular]\naxis = 0\n[constants]", "singular.axis", "must be positive"),
    ("true\n[limits]", "false\n[limits]\nforearm = [0, 9]", "limits.forearm", "is of an absolute elbow"),
    ("l2 = 275.0", "l2 = 275.0\nl3 = 0", "links.l3", "must be positive"),
    *[("[constants]", f"[joints]\n{SHOULDER}{wrong}\n[constants]", key, reason) for wrong, key, reason in (
        ("", "joints.elbow", "is missing"),
        ("elbow = 5", "joints.elbow", "must be a table"),
        ("elbow = { sign = 1, zero = 0 }", "joints.elbow.name", "is missing"),
        ("elbow = { name = ' ', sign = 1, zero = 0 }", "joints.elbow.name", "must not be empty"),
        ("elbow = { name = 'J1', sign = 1, zero = 0 }", "joints.elbow.name", "'J1' is the name of another joint"),
        ("elbow = { name = 'J2', sign = 2, zero = 0 }", "joints.elbow.sign", "must be 1 or -1, not 2"),
        ("elbow = { name = 'J2', sign = true, zero = 0 }", "joints.elbow.sign", "must be 1 or -1, not True"),
        ("elbow = { name = 'J2', sign = 1.0, zero = 0 }", "joints.elbow.sign", "must be 1 or -1, not 1.0"),
        ("elbow = { name = 'J2', sign = 1 }", "joints.elbow.zero", "is missing"),
        ("elbow = { name = 'J2', sign = 1, zero = 361 }", "joints.elbow.zero", "within -360 and 360"),
        ("elbow = { name = 'J2', sign = 1, zero = 0, limits = [3] }", "joints.elbow.limits", "two numbers"),
        ("elbow = { name = 'J2', sign = 1, zero = 0, limits = [3, 2] }", "joints.elbow.limits", "below the upper"),
        ("elbow = { name = 'J2', sign = 1, zero = 0, limits = [0, 1261] }", "joints.elbow.limits", "within -1260"),
        ("elbow = { name = 'J2', sign = 1, zero = 0, speed = 0 }", "joints.elbow.speed", "must be positive"),
        ("elbow = { name = 'J2', sign = 1, zero = 0, limit = 3 }", "joints.elbow.limit", "is not a key"),
        ("yaw = { name = 'J0', sign = 1, zero = 0 }", "joints.yaw", "is not a key"))],
])
def test_a_wrong_file_names_file_key_and_reason(tmp_path, old, new, key, reason):
    assert GOOD.count(old) == 1
    file = tmp_path / "wrong.toml"
    file.write_text(GOOD.replace(old, new))
    with pytest.raises(ArmError) as error:
        arms.load(file)
    assert str(error.value).startswith(f"{file}: {key}: ") and reason in str(error.value)


@pytest.mark.parametrize("old, new, key, reason", [
    ("base = 340.0", "shoulder = 25", "constants.shoulder", "is not 0, and an arm with seven axes has none"),
    ("base = 340.0", "lateral = 1", "constants.lateral", "is not 0"),
    ("base = 340.0", "elbow = 1", "constants.elbow", "is not 0"),
    ("base = 340.0", "absolute_elbow = true", "constants.absolute_elbow", "is not 0"),
    ("spherical = true\nflange = 126.0", "spherical = false", "limits.upper", "have wrist.spherical = true"),
    ("upper = [-170, 170]", "upper = [170, -170]", "limits.upper", "must be below"),
    ("upper = [-170, 170]", "", "joints.j7", "is not a key"), ("j7 =", "j4 =", "joints.j4", "is not a key"),
    ('"A3"', '"A2"', "joints.upper.name", "'A2' is the name of another joint")])
def test_a_wrong_file_of_seven_axes(tmp_path, old, new, key, reason):
    text, file = arms.path_of("iiwa7").read_text(), tmp_path / "wrong.toml"
    assert text.count(old) == 1
    file.write_text(text.replace(old, new))
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


# The machines as their makers or others describe them, angles in degrees, lengths in mm


def _move(x=0.0, y=0.0, z=0.0):
    found = np.eye(4)
    found[:3, 3] = x, y, z
    return found


def _turn(axis, degrees):
    """Rotation about an axis of any direction, right-handed (Rodrigues)."""
    x, y, z = np.array(axis, dtype=float)
    cross, found = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]]), np.eye(4)
    angle = math.radians(degrees)
    found[:3, :3] += math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
    return found


X, Y, Z = np.eye(3)


def _dh(*rows):
    """Standard Denavit-Hartenberg rows (d, a, alpha) of joints q."""
    def pose(*q):
        found = np.eye(4)
        for (d, a, alpha), angle in zip(rows, q):
            found = found @ _turn(Z, angle) @ _move(a, 0, d) @ _turn(X, alpha)
        return found
    return pose


def _modified(*rows):
    """Modified Denavit-Hartenberg rows (alpha, a, theta, d)."""
    def pose(*q):
        found = np.eye(4)
        for (alpha, a, theta, d), angle in zip(rows, q):
            found = found @ _turn(X, alpha) @ _move(a) @ _turn(Z, theta + angle) @ _move(z=d)
        return found
    return pose


def _kuka(*q):
    """Joint origins and axes of kr6r700sixx.urdf of ROS-Industrial's kuka_experimental."""
    found = np.eye(4)
    for origin, axis, angle in zip([(0, 0, 400), (25, 0, 0), (315, 0, 0), (0, 0, 35), (365, 0, 0), (80, 0, 0)],
                                   (-Z, Y, Y, -X, Y, -X), q):
        found = found @ _move(*origin) @ _turn(axis, angle)
    return found


def _abb(a1, a2, a3, *wrist):
    """Joint origins and axes of irb2400_12_155 of ROS-Industrial's abb; axis 3 from the horizontal (parallelogram)."""
    found = np.eye(4)
    for origin, axis, angle in zip([(0, 0, 0), (100, 0, 615), (0, 0, 705), (0, 0, 135), (755, 0, 0), (0, 0, 0)],
                                   (Z, Y, Y, X, Y, X), (a1, a2, a3 - a2, *wrist)):
        found = found @ _move(*origin) @ _turn(axis, angle)
    return found @ _move(85)


def _iiwa(base, upper):
    """KUKA's drawing: 126 mm to the flange; at 0 upright, A2 and A6 turn forward, A4 back, the others to the left."""
    def pose(*q):
        found = np.eye(4)
        for height, axis, angle in zip((0, base, 0, upper, 0, 400, 0), (Z, Y, Z, -Y, Z, Y, Z), q):
            found = found @ _move(z=height) @ _turn(axis, angle)
        return found @ _move(z=126)
    return pose


def _scara(a, b, c):
    """LinuxCNC, scarakins.c, forward: D2 = 340, D4 = 250, D6 = 50; joints 0, 1 and 3."""
    angles = np.radians([a, a + b, a + b + c])
    return _move(*(sum(length * part(angle) for length, angle in zip((340, 250, 50), angles)) for part in
                   (np.cos, np.sin)))


def _uarm(rot, left, right):
    """Firmware of the uArm Swift Pro, getXYZFromAngle without its end effector."""
    rot, left, right = np.radians([rot, left, right])
    stretch = 142.07 * math.cos(left) + 158.81 * math.cos(right) + 13.2
    return _move(stretch * math.sin(rot), -stretch * math.cos(rot), 142.07 * math.sin(left) - 158.81 * math.sin(right)
                 + 106.6)


def _dobot(j1, j2, j3):
    """Dobot Magician's manual: rear arm from the vertical, forearm below the horizontal."""
    return _turn(Z, j1) @ _move(z=139) @ (_move(*_polar(135, 90 - j2)) @ _move(*_polar(147, -j3)))


def _touch(j1, j2, j3):
    """Geomagic Touch: upper arm from the horizontal, forearm from the vertical, hanging down at 0."""
    return _turn(Z, j1) @ _move(*_polar(135, j2)) @ _move(*_polar(135, j3 - 90))


def _polar(length, degrees):
    return length * math.cos(math.radians(degrees)), 0, length * math.sin(math.radians(degrees))


def _leg(coxa, femur, tibia):
    """The drawings of the PhantomX leg, each servo straight at 0."""
    return _turn(Z, coxa) @ _move(53) @ _turn(-Y, femur) @ _move(66.2) @ _turn(-Y, tibia) @ _move(132.7)


UPRIGHT = _turn(Y, 90)  # a URDF's flange looks along x, that of rtl/six along z
CITED = {  # the joints' names in the order of the chain, the chain, what is behind it
    "cobra600": (("J1", "J2"), _dh((0, 325, 0), (0, 275, 180)), None),  # Corke, Robotics Toolbox, mdl_cobra600
    "linuxcnc_scara": (("J0", "J1", "J3"), _scara, None),
    "puma560": (("q1", "q2", "q3", "q4", "q5", "q6"), _dh(  # Corke, Robotics Toolbox, Puma560: d1 = 26.45 inch
        (671.83, 0, 90), (0, 431.8, 0), (150.05, 20.3, -90), (431.8, 0, 90), (0, 0, -90), (0, 0, 0)), np.eye(4)),
    "staubli_tx40": (("J1", "J2", "J3", "J4", "J5", "J6"), _modified(  # robotkinematicscatalogue, Staubli_TX40
        (0, 0, 0, 320), (-90, 0, -90, 35), (0, 225, -90, 0), (-90, 0, 0, 225), (90, 0, 0, 0), (-90, 0, 180, 65)),
        np.eye(4)),
    "kr6_r700": (("A1", "A2", "A3", "A4", "A5", "A6"), _kuka, UPRIGHT),
    "irb2400": (("A1", "A2", "A3", "A4", "A5", "A6"), _abb, UPRIGHT),
    **{name: (tuple(f"A{i}" for i in range(1, 8)), _iiwa(*lengths), None) for name, *lengths in (
        ("iiwa7", 340, 400), ("iiwa14", 360, 420))},
    "ur5": (("base", "shoulder", "elbow"), _dh(  # Universal Robots, UR5 series 3, wrist 1 at 0: it moves no place
        (89.159, 0, 90), (0, -425, 0), (0, -392.25, 0), (109.15, 0, 90)), None),
    **{name: (("base", "shoulder", "elbow", "wrist1", "wrist2", "wrist3"), _dh(  # Universal Robots, e-Series
        (d1, 0, 90), (0, a2, 0), (0, a3, 0), (d4, 0, 90), (d5, 0, -90), (d6, 0, 0)), None)
       for name, d1, a2, a3, d4, d5, d6 in (("ur3e", 151.85, -243.55, -213.2, 131.05, 85.35, 92.1),
                                            ("ur5e", 162.5, -425, -392.2, 133.3, 99.7, 99.6),
                                            ("ur10e", 180.7, -612.7, -571.55, 174.15, 119.85, 116.55))},
    "uarm_swift_pro": (("rot", "left", "right"), _uarm, None),
    "dobot_magician": (("J1", "J2", "J3"), _dobot, None),
    "geomagic_touch": (("J1", "J2", "J3"), _touch, None),
    "phantomx_leg": (("coxa", "femur", "tibia"), _leg, None)}


def _cores_joints(arm, q):
    """The cores' joints by key, radians, of the machine's by name; the elbow against link 1, to the line of L2."""
    seen = {one.key: math.radians(one.sign * q[one.name] + one.zero) for one in arm.joints}
    if arm.absolute_elbow:
        seen["elbow"] -= seen["shoulder"]
    return seen | {"elbow": seen["elbow"] + math.radians(arm.elbow_angle)}


@pytest.mark.parametrize("name", arms.known())
def test_every_arm_is_the_machine_of_its_source(name):
    """The truths of the library, at the joints that the file makes of the machine's, against the cited chain."""
    arm, (names, pose, flange) = arms.load(name), CITED[name]
    assert {one.name for one in arm.joints} == set(names)
    for q in np.random.default_rng(3).uniform(-150, 150, (20, len(names))):
        seen = _cores_joints(arm, dict(zip(names, q)))
        want = pose(*q, *[0.0] * (name == "ur5"))
        if arm.axes == 7:
            rotation, tip = truth_srs.fk([seen["yaw"], math.pi / 2 - seen["shoulder"], *(
                seen[key] for key in ("upper", "elbow", *arms.WRIST_OF_SEVEN))], truth_srs.load(name)[0])
            assert tip == pytest.approx(want[:3, 3], abs=1e-6) and np.allclose(rotation, want[:3, :3], atol=1e-9)
            continue
        if flange is not None:
            six, _ = truth_six.load(name)
            rotation, tip = truth_six.fk6([seen["yaw"], math.pi / 2 - seen["shoulder"],
                                           math.radians(arm.elbow_angle) - seen["elbow"], *(
                                               seen[key] for key in arms.WRIST)], six)
            want = want @ flange
            assert tip == pytest.approx(want[:3, 3], abs=1e-6) and np.allclose(rotation, want[:3, :3], atol=1e-9)
            want = want @ _move(z=-arm.flange)
        if arm.d6 is not None:
            lengths, _ = truth_ur.load(name)
            rotation, tip = truth_ur.fk([seen["yaw"] - math.pi, -seen["shoulder"], -seen["elbow"], *(
                seen[key] for key in arms.WRIST)], lengths)
            assert tip == pytest.approx(want[:3, 3], abs=1e-6) and np.allclose(rotation, want[:3, :3], atol=1e-9)
            want = want @ _move(z=-arm.d6) @ _turn(Z, -q[5]) @ _turn(X, 90) @ _move(z=-arm.d5)
        if not arm.yaws:
            tip = list(truth.fk2(seen["shoulder"], seen["elbow"], arm.l1, arm.l2))
            if arm.l3:
                last = seen["shoulder"] + seen["elbow"] + seen["tool"]
                tip = [one + arm.l3 * part(last) for one, part in zip(tip, (math.cos, math.sin))]
            assert tip == pytest.approx(want[:2, 3], abs=1e-6)
            continue
        frame = truth_arm.Frame(arm.base, arm.shoulder, arm.lateral)
        tip = truth_arm.fk3(seen["shoulder"], seen["elbow"], seen["yaw"], arm.l1, arm.l2, frame)
        assert tip == pytest.approx(want[:3, 3], abs=1e-6)


@pytest.mark.parametrize("joints", (1, 2, 3))
@pytest.mark.parametrize("name", [name for name in arms.known() if arms.load(name).axes < 7])
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
    with pytest.raises(ArmError, match="iiwa7: limits.upper: is given"):
        trajectory(arms.load("iiwa7"), 2)
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
