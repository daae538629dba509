"""Parallel robots: golden values, closure, velocity and acceleration against differentiation, and bad inputs."""

from __future__ import annotations

import numpy as np
import pytest
from quadrance.parallel import delta, geometry, motion, position, reconfiguration, singularity
from quadrance.parallel.geometry import PoseError, RobotError, rotation

ROBOT = geometry.load("rus_2x3")
POSE = np.array([[.9623, -.1306, -.2388], [.0842, .9771, -.1952], [.2588, .1677, .9513]])  # as the paper prints it
PLACE = np.array([0.0, -350.0, 0.0])
TILT = rotation(("z", 5), ("y", 10), ("x", 10))
SPIRAL = np.array([[.9811, -.0558, .1855], [.0858, .9837, -.1581], [-.1736, .1710, .9698]])
EYE = np.eye(3)


def spiral() -> np.ndarray:
    """The paper's 101 places."""
    s = np.linspace(0, 1, 101)
    return np.stack([25 * np.cos(2 * np.pi * s), -250 - 100 * s, 25 * np.sin(2 * np.pi * s)], axis=-1)


def poses(count: int, seed: int = 1) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Poses of the paper's robot with link angles, all in reach."""
    rng = np.random.default_rng(seed)
    turn = np.array([rotation(*zip("zyx", rng.uniform(-15, 15, 3))) for _ in range(4 * count)])
    place = rng.uniform((-40, -370, -40), (40, -240, 40), (4 * count, 3))
    beta = rng.uniform(-0.5, 0.5, 4 * count)
    reach = position.inverse(ROBOT, turn, place, beta).reachable.all(axis=-1)
    assert reach.sum() >= count
    return turn[reach][:count], place[reach][:count], beta[reach][:count]


# Golden values


def test_rotations_are_those_the_paper_prints():
    assert np.array_equal(rotation(("z", 5), ("y", -15), ("x", 10)).round(4), POSE)
    assert np.array_equal(TILT.round(4), SPIRAL)


def test_feasible_links_begin_at_59_degrees():
    low, high = np.degrees(reconfiguration.feasible(ROBOT, POSE, PLACE))
    assert round(low, 4) == -59.2263 and high == 90


@pytest.mark.parametrize("measure, beta, value", [("rotation", -11.4506, "4588.395"),
                                                  ("translation", -11.9366, "1.77597e+10")])
def test_best_links_at_the_pose(measure, beta, value):
    found = reconfiguration.best(ROBOT, POSE, PLACE, measure)
    assert round(float(np.degrees(found.beta)), 4) == beta
    assert f"{float(found.value):.{len(value) - 1 if 'e' not in value else 6}g}" == value


def test_the_optimum_is_nearly_the_worst_conditioned_posture():
    beta = np.radians(np.arange(-59, 91))
    cond, low = singularity.condition(ROBOT, POSE, PLACE, beta)
    at = dict(zip(range(-59, 91), cond))
    assert (round(at[-11]), round(at[90])) == (397, 55)
    assert np.argmax(cond) - 59 == -18 and round(cond.max()) == 408
    assert np.argmin(low) - 59 == pytest.approx(-18, abs=1)


def test_spiral():
    turn, place = TILT, spiral()
    both = [np.degrees(reconfiguration.best(ROBOT, turn, place, one).beta) for one in reconfiguration.MEASURES]
    assert [round(float(one[i]), 2) for one in both for i in (0, -1)] == [1.87, -13.79, 4.47, -12.40]
    assert [round(float(f(one)), 2) for one in both for f in (np.max, np.min)] == [1.87, -13.79, 4.47, -12.40]
    assert round(float(np.abs(both[0] - both[1]).max()), 3) == 2.595
    assert np.abs(np.diff(both[0])).max() < 1, "without a jump"


def maxima(values: np.ndarray) -> int:
    """How many maxima a measure has over beta, NaN (out of reach) left out."""
    step = np.sign(np.diff(values[~np.isnan(values)]))
    return int(np.sum(np.diff(step) < 0) + (step[-1] > 0) + (step[0] < 0))


GRID = np.radians(np.arange(-90, 91))


def test_measure_has_one_maximum_on_the_spiral():
    place = np.vstack([spiral()[::10], PLACE])
    turn = np.array([TILT] * 11 + [POSE])
    for one in reconfiguration.manipulability(ROBOT, turn, place, np.repeat(GRID[:, None], 12, axis=1)):
        assert [maxima(column) for column in one.T] == [1] * 12


def test_measure_may_have_poles_elsewhere():
    """Elsewhere the measure may have poles in beta: as a rule the determinant of J_x changes its sign there."""
    turn, place, _ = poses(60)
    beta = np.repeat(GRID[:, None], 60, axis=1)
    measure, _ = reconfiguration.manipulability(ROBOT, turn, place, beta)
    rows, _, reach = reconfiguration._jacobian(ROBOT, turn, place, beta)
    sign = np.sign(np.linalg.det(rows))
    several = np.array([maxima(column) > 1 for column in measure.T])
    crossed = np.array([np.ptp(sign[reach[:, k], k]) > 0 for k in range(60)])
    assert several.sum() > 5 and np.sum(crossed & several) > 5
    worst = turn[crossed][0], place[crossed][0]
    assert reconfiguration.best(ROBOT, *worst).condition > 1e4, "the unguarded search runs into the pole"
    assert reconfiguration.best(ROBOT, *worst, greatest_condition=500.0).condition <= 500


def test_guarded_search_keeps_its_condition():
    free = reconfiguration.best(ROBOT, POSE, PLACE)
    kept = reconfiguration.best(ROBOT, POSE, PLACE, greatest_condition=200.0)
    assert free.condition > 390 and 195 < kept.condition <= 200 and kept.value < free.value
    with pytest.raises(PoseError, match="with that condition"):
        reconfiguration.best(ROBOT, POSE, PLACE, greatest_condition=10)


# Position


@pytest.mark.parametrize("name", geometry.known())
def test_rods_fit(name):
    robot, rng = geometry.load(name), np.random.default_rng(3)
    middle = {"rus_2x3": (0, -320, 0), "rotary_stewart": (0, 0, 135), "klipper_delta": (0, 0, 80),
              "linuxcnc_delta": (0, 0, -330)}[name]
    place = middle + rng.uniform(-1, 1, (500, 3)) * robot.la[0] / 6
    turn = np.array([rotation(*zip("zyx", rng.uniform(-4, 4, 3))) for _ in place]) if robot.legs == 6 else EYE
    found = position.inverse(robot, turn, place, 0.1)
    assert found.reachable.all()
    assert np.abs(position.rods(robot, turn, place, found.alpha, 0.1)).max() <= 1e-9
    other = position.inverse(robot, turn, place, 0.1, -robot.branch)
    assert np.abs(position.rods(robot, turn, place, other.alpha, 0.1)).max() <= 1e-9
    assert np.all(position.branches(robot, turn, place, found.alpha, 0.1) == robot.branch)
    assert np.all(position.branches(robot, turn, place, other.alpha, 0.1) == -robot.branch)
    assert np.hypot(found.cosine, found.sine) == pytest.approx(1)


def test_printed_equations_miss_the_rod():
    """(15) as printed, with its two errors and with either mended: only both mended fit."""
    turn, place, beta = poses(300)
    c = ROBOT.joints(turn, place)
    theta = np.radians([35, 155, 275, 25, 145, 265])
    la, lb = ROBOT.la, ROBOT.lb
    height, radius = ROBOT.shoulders(beta) @ ROBOT.up, np.einsum("...ni,ni->...n", ROBOT.shoulders(beta), ROBOT.radial)
    miss = {}
    for twice in (False, True):
        for cosines in (False, True):
            q = 2 * c[..., 0] * np.cos(theta) - 2 * c[..., 2] * (np.cos(theta) if cosines else np.sin(theta))
            s = (lb**2 - la**2 - radius**2 - height**2 + 2 * height * c[..., 1] - np.sum(c * c, axis=-1)) / la
            inner = 4 * (height - (2 if twice else 1) * c[..., 1]) ** 2 + 4 * radius**2 - s * s \
                - q * (4 * radius + 2 * s * radius / la) + q * q * (1 - radius**2 / la**2)
            lower = -2 * radius - s - q * (radius / la - 1)
            upper = 2 * c[..., 1] - 2 * height
            alpha = [2 * np.arctan((upper + sign * np.sqrt(np.maximum(inner, 0))) / lower) for sign in (1, -1)]
            miss[twice, cosines] = max(float(np.abs(position.rods(ROBOT, turn, place, one, beta)).max())
                                       for one in alpha)
    assert miss.pop((False, False)) < 1e-9
    assert min(miss.values()) > 10


def test_every_branch_fits():
    signs, alpha = position.all_branches(ROBOT, POSE, PLACE)
    assert signs.shape == alpha.shape == (64, 6) and len(np.unique(alpha.round(9), axis=0)) == 64
    assert np.abs(position.rods(ROBOT, POSE, PLACE, alpha)).max() <= 1e-9
    with pytest.raises(PoseError, match="leg 1 does not reach"):
        position.all_branches(ROBOT, POSE, PLACE, np.radians(-60))


def test_unreachable_legs_come_as_near_as_they_can():
    place = np.array([[0, -350, 0], [0, -900, 0], [0, 700, 0], [600, -350, 0.0]])
    found = position.inverse(ROBOT, EYE, place)
    assert found.reachable[0].all() and not found.reachable[1:].all(axis=-1).any()
    here = np.abs(position.rods(ROBOT, EYE, place, found.alpha))
    for turn in (-0.01, 0.01):
        there = np.abs(position.rods(ROBOT, EYE, place, found.alpha + turn))
        assert np.all((there >= here) | found.reachable)
    assert np.all(found.root[~found.reachable] == 0)


def test_forward_inverts_inverse():
    turn, place, beta = poses(40)
    rng = np.random.default_rng(2)
    for one, at, link in zip(turn, place, beta):
        alpha = position.inverse(ROBOT, one, at, link).alpha
        start = rotation(("x", rng.uniform(-.2, .2)), ("y", rng.uniform(-.2, .2))) @ one
        found = position.forward(ROBOT, alpha, link, start, at + rng.uniform(-.2, .2, 3))
        assert np.abs(found.position - at).max() < 1e-7 and np.abs(found.rotation - one).max() < 1e-9
        assert found.steps < 12 and found.misfit < 1e-9


def test_far_starts_mostly_succeed():
    rng = np.random.default_rng(5)
    good = 0
    turn, place, beta = poses(60, seed=4)
    for one, at, link in zip(turn, place, beta):
        alpha = position.inverse(ROBOT, one, at, link).alpha
        way = rng.normal(size=(2, 3))
        way /= np.linalg.norm(way, axis=1, keepdims=True)
        try:
            found = position.forward(ROBOT, alpha, link, position._turned(one, np.radians(2) * way[0]), at + 5 * way[1])
            good += np.abs(found.position - at).max() < 1e-6
        except PoseError:
            pass
    assert 0.75 < good / 60 < 1, "about nine in ten from 2 degrees and 5 mm; a warm start is nearer"


def test_two_assemblies_millimetres_apart():
    alpha = position.inverse(ROBOT, POSE, PLACE).alpha
    found = position.assemblies(ROBOT, alpha, 0.0, POSE, PLACE)
    near = [np.linalg.norm(one.position - PLACE) for one in found]
    assert len(found) >= 2 and near[0] < 0.01 and 0.5 < near[1] < 5
    assert all(one.misfit < 1e-9 for one in found)


@pytest.mark.parametrize("name", ["klipper_delta", "linuxcnc_delta"])
def test_delta_forward_inverts_inverse(name):
    robot, rng = geometry.load(name), np.random.default_rng(6)
    middle = (0, 0, 80) if name == "klipper_delta" else (0, 0, -330)
    place = middle + rng.uniform(-1, 1, (2000, 3)) * robot.la[0] / 4
    found = position.inverse(robot, EYE, place)
    assert found.reachable.all()
    assert np.abs(delta.forward(robot, found.alpha) - place).max() < 1e-9
    other = delta.forward(robot, found.alpha, below=False)
    assert np.abs(position.rods(robot, EYE, other, found.alpha)).max() < 1e-9 and np.all(other[:, 2] > place[:, 2])
    knees = np.linalg.norm(robot.elbows(found.alpha)[..., :2], axis=-1)
    opposite = position.inverse(robot, EYE, place, 0, -robot.branch).alpha
    assert np.all(knees > np.linalg.norm(robot.elbows(opposite)[..., :2], axis=-1) - 1e-9), "the knees are outside"


def test_linuxcnc_home():
    """A pose on the axis: all cranks alike; LinuxCNC's formula for joint 0, in inches and degrees."""
    robot = geometry.load("linuxcnc_delta")
    alpha = position.inverse(robot, EYE, [0, 0, -12 * 25.4]).alpha
    assert np.ptp(alpha) < 1e-12
    j = alpha[0]  # knee 10 + 10 cos j from the axis and 10 sin j below, foot at 6 and 12 below
    assert (4 + 10 * np.cos(j)) ** 2 + (12 - 10 * np.sin(j)) ** 2 == pytest.approx(14**2)
    assert robot.foot[0] == pytest.approx([0, -254, 0])


# Velocity and acceleration


def derivative(f, order: int, h: float = 0.02) -> np.ndarray:
    """First or second derivative at 0 by central differences of order 8."""
    weights = {1: [4 / 5, -1 / 5, 4 / 105, -1 / 280], 2: [8 / 5, -1 / 5, 8 / 315, -1 / 560]}[order]
    if order == 1:
        return sum(w * (f(k * h) - f(-k * h)) for k, w in enumerate(weights, 1)) / h
    return (sum(w * (f(k * h) + f(-k * h)) for k, w in enumerate(weights, 1)) - 205 / 72 * f(0)) / h**2


def turn_at(t: float) -> np.ndarray:
    return position._turned(POSE_EXACT, 0.2 * np.array([0.3 * t + 0.1 * t * t, -0.4 * t, 0.2 * t + 0.3 * t * t]))


POSE_EXACT = rotation(("z", 5), ("y", -15), ("x", 10))


def place_at(t: float) -> np.ndarray:
    return PLACE + np.array([20 * np.sin(t), -15 * t + 6 * t * t, 10 * np.cos(t) - 10])


def link_at(t: float) -> float:
    return 0.1 + 0.3 * t - 0.2 * t * t


def vee(matrix: np.ndarray) -> np.ndarray:
    return np.array([matrix[2, 1] - matrix[1, 2], matrix[0, 2] - matrix[2, 0], matrix[1, 0] - matrix[0, 1]]) / 2


def rates() -> tuple:
    """omega, omega', v, a, beta', beta'' of the motion at t = 0."""
    first, second = derivative(turn_at, 1), derivative(turn_at, 2)
    omega = vee(first @ POSE_EXACT.T)
    more = vee(second @ POSE_EXACT.T + first @ first.T)
    return omega, more, derivative(place_at, 1), derivative(place_at, 2), 0.3, -0.4


def alpha_at(t: float) -> np.ndarray:
    return position.inverse(ROBOT, turn_at(t), place_at(t), link_at(t)).alpha


def test_velocity_is_the_derivative_of_the_position():
    omega, _, v, _, link, _ = rates()
    twist = motion.twist(POSE_EXACT, PLACE, omega, v)
    cranks = motion.crank_rates(ROBOT, POSE_EXACT, PLACE, 0.1, twist, link)
    assert np.abs(cranks - derivative(alpha_at, 1)).max() < 4e-11
    assert motion.platform_twist(ROBOT, POSE_EXACT, PLACE, 0.1, cranks, link) == pytest.approx(twist, abs=1e-9)


def test_the_printed_link_jacobian_is_wrong():
    """{S^r; S^6} in place of {S^r; S^6} - {S^1; S^6}: half of the link's motion goes astray."""
    found = motion.jacobians(ROBOT, POSE_EXACT, PLACE, 0.1)
    printed = found.links + found.cranks * (ROBOT.link > 0)
    missed = (printed - found.links) * 0.5
    assert np.abs(missed).max() > 10, "mm/s at 0.5 rad/s"


def test_acceleration_is_the_second_derivative():
    omega, more, v, a, link, link2 = rates()
    twist = motion.twist(POSE_EXACT, PLACE, omega, v)
    state = motion.reduced(a, omega, PLACE, v, more)
    cranks = motion.crank_accelerations(ROBOT, POSE_EXACT, PLACE, 0.1, twist, state, link, link2)
    assert np.abs(cranks - derivative(alpha_at, 2)).max() < 1e-8


def test_root_is_the_crank_jacobian():
    turn, place, beta = poses(50)
    found = position.inverse(ROBOT, turn, place, beta)
    cranks = motion.jacobians(ROBOT, turn, place, beta).cranks
    assert cranks == pytest.approx(-ROBOT.la / ROBOT.lb * found.root, rel=1e-9), "-LA / 2 LB of the paper's root"


# Singularities


def test_stretched_leg_is_type_one():
    robot = geometry.load("klipper_delta")
    alpha = np.array([-0.9, -0.9, -0.9])
    e = robot.radial[0] * np.cos(-0.9) + robot.up * np.sin(-0.9)
    place = robot.foot[0] + (robot.la[0] + robot.lb[0]) * e - robot.joint[0]
    found = position.inverse(robot, EYE, place * (1 - 1e-13))
    assert found.root[0] < 1e-3 and abs(found.alpha[0] - alpha[0]) < 1e-5
    lowest = robot.foot[0, 2] - np.sqrt((robot.la[0] + robot.lb[0])**2 - np.hypot(*robot.foot[0, :2])**2) + 5e-12
    with pytest.raises(PoseError, match="J_q is singular"):
        motion.crank_rates(robot, EYE, [0, 0, lowest], 0, np.ones(6))
    turn, at, link = poses(1)
    kinds = singularity.types(ROBOT, turn[0], at[0], link[0])
    assert not (kinds.inverse.any() or kinds.forward or kinds.combined or kinds.link.any())
    kinds = singularity.types(ROBOT, turn[0], at[0], link[0], near=10)
    assert kinds.inverse.all() and kinds.forward and kinds.combined and kinds.link[:3].all()


def test_link_jacobian_vanishes_on_a_bent_leg():
    """det J'_q = 0 does not mean det J_q = 0: the link along the rod's own direction in the plane of the crank."""
    turn, place, _ = poses(1)
    sweep = np.radians(np.linspace(-90, 90, 3601))
    reach = position.inverse(ROBOT, turn[0], place[0], sweep).reachable.all(axis=-1)
    found = motion.jacobians(ROBOT, turn[0], place[0], sweep[reach])
    changes = np.diff(np.sign(found.links[:, :3]), axis=0) != 0
    assert changes.any()
    at, leg = np.argwhere(changes)[0]
    assert abs(found.links[at, leg]) < 0.2 and abs(found.cranks[at, leg]) > 20


def test_platform_in_the_plane_of_its_legs_is_type_two():
    """Cranks and ball joints coincident in azimuth: every rod meets the y axis, no rod holds a turn about it."""
    legs = "\n".join(f'[[leg]]\nfoot = {foot}\nazimuth = {angle}\njoint = {joint}\nla = 60\nlb = 150'
                     for radius, r, y in ((100, 40, 0.0), (160, 40, -30.0)) for angle in (30, 150, 270)
                     for foot, joint in [tuple([float(x * np.cos(np.radians(angle))), h,
                                                float(-x * np.sin(np.radians(angle)))]
                                               for x, h in ((radius, 0.0), (r, y)))])
    import tempfile
    from pathlib import Path
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "flat.toml")
        path.write_text(f'name = "flat"\nsource = "here"\nkind = "legs"\nup = [0, 1, 0]\n{legs}\n')
        robot = geometry.load(path)
    kinds = singularity.types(robot, EYE, np.array([0, -120.0, 0]), near=1e-9)
    assert kinds.forward and not kinds.inverse.any() and not kinds.combined
    cond, low = singularity.condition(robot, EYE, np.array([0, -120.0, 0]))
    assert cond > 1e12 and low < 1e-9
    with pytest.raises(PoseError, match="J_x is singular"):
        motion.platform_twist(robot, EYE, np.array([0, -120.0, 0]), 0, np.ones(6))
    alpha = position.inverse(robot, EYE, np.array([0, -120.0, 0])).alpha
    with pytest.raises(PoseError, match="the Jacobian is singular after 0 steps"):
        position.forward(robot, alpha + 0.01, 0, EYE, np.array([0, -120.0, 0]))


# Bad inputs


def test_quaternion_and_matrix_agree():
    half = np.radians(10) / 2
    assert geometry.of_quaternion([np.cos(half), np.sin(half), 0, 0]) == pytest.approx(rotation(("x", 10)))
    assert geometry.of_quaternion(np.full((5, 4), 0.5)).shape == (5, 3, 3)
    with pytest.raises(PoseError, match="of length 1"):
        geometry.of_quaternion([1, 0.1, 0, 0])


@pytest.mark.parametrize("matrix, place, reason", [
    (EYE * 1.01, PLACE, "is no rotation"), (np.diag([1, 1, -1]), PLACE, "reflection"),
    (EYE, [0, np.nan, 0], "not finite"), (EYE[:2], PLACE, "shapes"), (EYE, [0, 0], "shapes")])
def test_bad_poses(matrix, place, reason):
    with pytest.raises(PoseError, match=reason):
        position.inverse(ROBOT, matrix, place)


def test_bad_calls():
    alpha = position.inverse(ROBOT, POSE, PLACE).alpha
    for call, reason in [
            (lambda: position.inverse(ROBOT, POSE, PLACE, np.inf), "beta: a number is not finite"),
            (lambda: motion.jacobians(ROBOT, POSE, PLACE, -1.2), "leg 1 does not reach"),
            (lambda: motion.crank_rates(ROBOT, EYE, [0, -900, 0], 0, np.zeros(6)), "does not reach"),
            (lambda: reconfiguration.feasible(ROBOT, EYE, [0, 900, 0]), "no angle of the links"),
            (lambda: reconfiguration.best(ROBOT, EYE, [0, 900, 0]), "no angle of the links reaches the pose$"),
            (lambda: reconfiguration.best(ROBOT, POSE, PLACE, "speed"), "must be one of rotation, translation"),
            (lambda: reconfiguration.best(geometry.load("klipper_delta"), EYE, PLACE), "no reconfiguration links"),
            (lambda: position.forward(ROBOT, alpha, 0, rotation(("x", 120)), PLACE + 400), "no convergence|another"),
            (lambda: position.forward(ROBOT, alpha[:3], 0, EYE, PLACE), "six finite"),
            (lambda: position.forward(geometry.load("klipper_delta"), alpha, 0, EYE, PLACE), "see delta.forward"),
            (lambda: delta.forward(ROBOT, alpha), "needs three legs"),
            (lambda: delta.forward(geometry.load("klipper_delta"), [0, 0, np.nan]), "three finite"),
            (lambda: delta.forward(geometry.load("linuxcnc_delta"), [-1.5, 2.5, 1.2]), "do not meet"),
            (lambda: delta.forward(geometry.load("linuxcnc_delta"), [np.arccos(-0.4)] * 3), "lie in a line")]:
        with pytest.raises(PoseError, match=reason):
            call()
    assert np.isnan(reconfiguration.manipulability(ROBOT, POSE, PLACE, np.radians([-60.0]))[0]).all()


GOOD = """
name = "Test"
source = "here"
kind = "delta"
up = [0, 0, 1]
[delta]
base = 100
platform = 40.0
height = 0
la = 80.0
lb = 200
azimuth = [30, 150, 270]
"""
LEG = "[[leg]]\nfoot = [1, 2, 3]\nazimuth = 0\njoint = [0, 0, 1]\nla = 2\nlb = 4\n"


@pytest.mark.parametrize("old, new, key, reason", [
    ('name = "Test"\n', "", "name", "is missing"), ('source = "here"', "source = 1", "source", "must be a string"),
    ('kind = "delta"', 'kind = "gamma"', "kind", "reconfigurable, legs, delta"),
    ("up = [0, 0, 1]", "up = [0, 1, 1]", "up", "an axis such as"), ("up = [0, 0, 1]", "up = [0, 1]", "up", "list of 3"),
    ("up = [0, 0, 1]", "up = [1, 0, 0]", "up", "for a delta"), ("[delta]", "[dleta]", "dleta", "not a key"),
    ("base = 100", "base = -1", "delta.base", "at least 0"), ("base = 100", 'base = "x"', "delta.base", "a number"),
    ("base = 100", "bose = 100", "delta.bose", "not a key"), ("la = 80.0", "la = 0", "delta.la", "must be positive"),
    ("lb = 200", "lb = inf", "delta.lb", "must be finite"), ("lb = 200", "lb = true", "delta.lb", "a number"),
    ("[30, 150, 270]", "[30, 150]", "delta.azimuth", "list of 3 finite numbers"),
    ("[30, 150, 270]", "[30, 150", "not TOML", ""), ("height = 0\n", "", "delta.height", "is missing")])
def test_a_wrong_file_names_file_key_and_reason(tmp_path, old, new, key, reason):
    assert GOOD.count(old) == 1
    file = tmp_path / "wrong.toml"
    file.write_text(GOOD.replace(old, new))
    with pytest.raises(RobotError) as error:
        geometry.load(file)
    assert str(error.value).startswith(f"{file}: {key}: ") and reason in str(error.value)


@pytest.mark.parametrize("legs, key, reason", [
    (LEG * 2, "leg", "three or six, not 2"), (LEG * 3 + 'branch = "x"\n', "leg 3.branch", 'must be "+" or "-"'),
    (LEG * 2 + LEG.replace("la = 2", "la = -2"), "leg 3.la", "positive"),
    (LEG * 2 + LEG.replace("foot", "feet"), "leg 3.feet", "not a key"), ("leg = [1, 2, 3]\n", "leg 1", "a table")])
def test_wrong_legs(tmp_path, legs, key, reason):
    file = tmp_path / "wrong.toml"
    file.write_text(f'name = "a"\nsource = "b"\nkind = "legs"\nup = [0, 0, 1]\n{legs}')
    with pytest.raises(RobotError) as error:
        geometry.load(file)
    assert str(error.value).startswith(f"{file}: {key}: ") and reason in str(error.value)


def test_unknown_robot(tmp_path):
    with pytest.raises(RobotError, match="no robot 'hexapod': known robots are klipper_delta, "):
        geometry.load("hexapod")
    with pytest.raises(RobotError, match="cannot be read"):
        geometry.load(tmp_path / "nothere.toml")
    assert geometry.load(geometry.HERE / "rus_2x3.toml").id == "rus_2x3"
