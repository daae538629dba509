"""Models of rtl/arm: all ten arms end to end, forward and inverse, the choice of a branch, velocities and rates."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from quadrance import arm, arm_keep, arm_velocity, arms, bounds, kernel_vector_solve, truth, truth_arm, workspaces
from quadrance.arms import ArmError
from quadrance.bounds import arm as limits
from quadrance.kernel_vector_wide import form

from models.test.claims import distinct

W16 = {"W": 16, "F": 8, "U": 16}
ALL = {name: 1 for name in arm.SWITCHES}
SETS = {core.id: core.params for core in distinct() if core.family == "arm" and core.function[-3:] in ("fk3", "ik3")}
FORWARD = [p for name, p in SETS.items() if "fk3" in name]
INVERSE = [p for name, p in SETS.items() if "ik3" in name]
CASES = [pytest.param(W16 | arm.switches(arms.load(name)), arms.load(name), id=name) for name in arms.known()]
BUILT = replace(arms.load("kr6_r700"), id="all", lateral=-70.0, absolute_elbow=True)  # has all five
CASES.append(pytest.param(W16 | ALL, BUILT, id="all"))
COARSE = {"mm_per_unit": 30.0}  # fits the coordinates of W = 12, F = 6


def _joints(count: int, seed: int) -> np.ndarray:
    return np.random.default_rng(seed).uniform(-np.pi, np.pi, (3, count))


def _vectors(p: dict[str, int], theta: np.ndarray) -> dict[str, np.ndarray]:
    one = 1 << p["U"]
    return {f"in_{letter}{i}": np.rint(part * one).astype(np.int64) for i, angle in enumerate(theta, 1)
            for letter, part in (("c", np.cos(angle)), ("n", np.sin(angle)))}


def _seen(p: dict[str, int], words: dict[str, int], inverse: bool) -> tuple[float, float, truth_arm.Frame]:
    """Links and frame that the words stand for, in LSB."""
    used = {name: words[f"cfg_{name.lower()}"] * p[name] for name in ("BASE", "SHOULDER", "LATERAL")}
    l1, l2, turn = words["cfg_l1"], words["cfg_l2"], 0.0
    if p["ELBOW"] and inverse:
        turn = math.atan2(-words["cfg_ne"], words["cfg_ce"])
    elif p["ELBOW"]:
        turn, l2 = math.atan2(words["cfg_elbow"], l2), math.hypot(words["cfg_elbow"], l2)
    return l1, l2, truth_arm.Frame(used["BASE"], used["SHOULDER"], used["LATERAL"], turn, bool(p["ABSOLUTE"]))


def _targets(p: dict[str, int], built: arms.Arm, count: int = 30_000) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Targets (3, N) all over the reach and a little beyond it, a quarter within 8 LSB of its borders."""
    words, rng = arm.words(p, built, True), np.random.default_rng(5)
    l1, l2, frame = _seen(p, words, True)
    back, turn, yaw = rng.integers(0, 2, count), rng.uniform(-np.pi, np.pi, count), rng.uniform(-np.pi, np.pi, count)
    near, far = abs(l1 - l2), l1 + l2
    radius = rng.uniform(0.7 * near, 1.1 * far, count)
    radius[::4] = np.where(rng.random(count) < 0.5, near, far)[::4] + rng.uniform(-8, 8, count)[::4]
    rho, z = radius * np.cos(turn) + frame.shoulder, radius * np.sin(turn) + frame.base
    x, y = rho * np.cos(yaw) - frame.lateral * np.sin(yaw), rho * np.sin(yaw) + frame.lateral * np.cos(yaw)
    if frame.lateral:  # nearer than the plane ever comes, and next to it
        shrink = rng.uniform(0, 1.02, count) * abs(frame.lateral) / np.hypot(x, y)
        x, y = (np.where(np.arange(count) % 7 == 0, word * shrink, word) for word in (x, y))
    found = np.rint(np.stack([x, y, z])).astype(np.int64)
    high = 1 << p["W"] - 1
    inside = np.all(np.abs(found) < high, axis=0) & (found[0] ** 2 + found[1] ** 2 > 0)
    return found[:, inside], rng.integers(0, 2, count)[inside], back[inside]


def _inverse(p: dict[str, int], built: arms.Arm) -> tuple[np.ndarray, ...]:
    target, elbow, back = _targets(p, built)
    words = arm.words(p, built, True)
    out = arm.ik3(p, in_x=target[0], in_y=target[1], in_z=target[2], in_elbow=elbow, in_back=back, **words)
    return target, elbow, back, words, out


def _angles(out: dict[str, np.ndarray]) -> list[np.ndarray]:
    return [np.arctan2(out[f"out_n{i}"], out[f"out_c{i}"]) for i in (1, 2, 3)]


def _claims(p: dict[str, int], built: arms.Arm) -> None:
    """Tip within the bound in reach, flags where they belong, the branch asked for."""
    target, elbow, back, words, out = _inverse(p, built)
    l1, l2, frame = _seen(p, words, True)
    tip = np.stack(truth_arm.fk3(*_angles(out), l1, l2, frame))
    error = np.linalg.norm(tip - target, axis=0)
    radius, height, _ = truth_arm.plane(*target, back, frame)
    far, inside = np.hypot(radius, height), truth_arm.reachable(target.T, l1, l2, frame, back)
    sine = np.sqrt(np.maximum(((l1 + l2) ** 2 - far**2) * (far**2 - (l1 - l2) ** 2), 0)) / (2 * l1 * l2)
    rho = np.abs(radius + frame.shoulder)
    limit, regular = limits.ik3(p, l1, l2, rho, height, far, sine), (inside >= 0) & (out["out_status"] & 1 == 0)
    assert regular.sum() > 5000
    assert np.all(error[regular] <= limit[regular])
    away = regular & (far >= 1 << p["F"])
    if p["W"] == 16:
        assert np.max(error[away]) <= 2  # LSB, all over the workspace, a unit and more from the shoulder axis
    off = limits.radius(p, rho)
    # always flagged out of reach, never in reach, but for what rho errs and the gap that vector_reach allows
    gap = bounds.vector.gap(p, l1, l2) * 4.0 ** (p["W"] - form(p).bits)
    allowed = 1.1 * off + (gap + 2) / np.maximum(2 * far, 1) + 1e-6
    assert np.all(out["out_status"][inside < -allowed] & 1 == 1)
    assert np.all(out["out_status"][inside > allowed] & 1 == 0)
    beyond = (inside < -2) & (far > 16)
    if beyond.any():
        found = np.linalg.norm(tip.T - truth_arm.nearest(target.T, l1, l2, frame, back), axis=1)
        assert np.all(found[beyond] <= limits.ik3_nearest(p, l1, l2, rho, far, np.hypot(*target[:2]), sine)[beyond])
    second = _angles(out)[1] + frame.turn - (_angles(out)[0] if frame.absolute else 0)
    assert np.all((np.sin(second) * (1 - 2 * elbow))[regular & (sine > 0.01)] > 0)  # the elbow asked for


@pytest.mark.parametrize(("p", "built"), CASES)
def test_inverse_of_every_arm(p, built):
    _claims(p, built)


@pytest.mark.parametrize("p", INVERSE, ids=[name for name in SETS if "ik3" in name])
def test_inverse_at_every_listed_set(p):
    _claims(p, replace(BUILT, **COARSE) if p["W"] < 16 else BUILT)


@pytest.mark.parametrize(("p", "built"), [*CASES, *[pytest.param(p, replace(BUILT, **COARSE), id=f"W{p['W']}")
                                                    for p in FORWARD]])
def test_forward_of_every_arm(p, built):
    words, vectors = arm.words(p, built, False), _vectors(p, _joints(30_000, 3))
    out = arm.fk3(p, **vectors, **words)
    given = {name: word / 2 ** p["U"] for name, word in vectors.items()}
    v1, v2, v3 = (given[f"in_c{i}"] + 1j * given[f"in_n{i}"] for i in (1, 2, 3))
    link = (words["cfg_l2"] + 1j * words["cfg_elbow"] * p["ELBOW"]) * v2
    plane = words["cfg_l1"] * v1 + (link if p["ABSOLUTE"] else link * v1)
    plane = plane + words["cfg_shoulder"] * p["SHOULDER"] + 1j * words["cfg_base"] * p["BASE"]
    flat = (plane.real + 1j * words["cfg_lateral"] * p["LATERAL"]) * v3
    exact = np.stack([flat.real, flat.imag, plane.imag])
    got = np.stack([out[f"out_{axis}"] for axis in "xyz"])
    held = np.all(np.abs(exact) < (1 << p["W"] - 1) - 1, axis=0) & (np.max(np.abs(np.abs([v1, v2, v3]))) < 2)
    assert held.sum() > 5000 and not np.any(out["out_status"][held])
    assert np.max(np.abs(got - exact)[:, held]) <= limits.fk3() + (words["cfg_l1"] + words["cfg_l2"]) * 1e-9
    over = np.any(np.abs(exact) > (1 << p["W"] - 1) + 1, axis=0)
    assert np.all(out["out_status"][over] == 4)
    l1, l2, frame = _seen(p, words, False)
    tip = np.stack(truth_arm.fk3(*[np.angle(v) for v in (v1, v2, v3)], l1, l2, frame))
    around = abs(frame.shoulder) + abs(frame.lateral)
    assert np.max(np.linalg.norm(got - tip, axis=0)[held]) <= limits.fk3_tip(p, l1, l2, around)
    if p["W"] == 16:
        assert np.max(np.linalg.norm(got - tip, axis=0)[held]) <= 2


@pytest.mark.parametrize(("p", "built"), CASES)
def test_there_and_back(p, built):
    """Forward of the inverse's words: within 2 LSB and the rounding of the words of the target in reach."""
    target, _, _, _, out = _inverse(p, built)
    back = arm.fk3(p, **{f"in_{name[4:]}": word for name, word in out.items() if name != "out_status"},
                   **arm.words(p, built, False))
    tip = np.stack([back[f"out_{axis}"] for axis in "xyz"])
    reached = (out["out_status"] == 0) & (back["out_status"] == 0)
    l1, l2, frame = _seen(p, arm.words(p, built, True), True)
    radius, height, _ = truth_arm.plane(*target, 0, frame)
    reached &= np.hypot(np.abs(radius) - abs(frame.shoulder), height) > 2 << p["F"]
    words = (2 * l1 + 3 * l2) * 2.0 ** -p["U"] + 1.5  # of the joints, of the links and of the elbow offset
    assert reached.sum() > 5000 and np.max(np.linalg.norm(tip - target, axis=0)[reached]) <= 2 + words


def test_the_yaw_axis_holds_joint_3_and_flags_it():
    p, words = W16 | ALL, arm.words(W16 | ALL, BUILT, True)
    x = np.array([0, 3000, 0, 0, -5000, 0])
    out = arm.ik3(p, in_x=x, in_y=x // 2, in_z=x + 9000, in_elbow=0, in_back=0, **words)
    assert np.array_equal(out["out_status"] & 3 == 3, x == 0)  # nearer than the lateral offset, and no direction
    assert (out["out_c3"][0], out["out_n3"][0]) == (65536, 0)
    for i in (2, 3, 5):
        assert out["out_c3"][i] == out["out_c3"][i - 1] and out["out_n3"][i] == out["out_n3"][i - 1]


def test_a_target_far_below_the_base_saturates_and_says_so():
    p, words = W16 | ALL, arm.words(W16 | ALL, BUILT, True)
    out = arm.ik3(p, in_x=np.array([9000, 9000]), in_y=0, in_z=np.array([-32768, 0]), in_elbow=0, in_back=0,
                  **(words | {"cfg_base": 10240}))
    assert np.array_equal(out["out_status"] & 4, [4, 0]) and out["out_status"][0] & 1


@pytest.mark.parametrize("name", arms.known())
def test_truth_there_and_back(name):
    built = arms.load(name)
    frame, links = truth_arm.frame(built), built.links
    theta = _joints(4000, 9)
    x, y, z = truth_arm.fk3(*theta, *links, frame)
    best = np.full(x.shape, np.inf)
    for elbow in (0, 1):
        for back in (0, 1):
            found = np.stack(truth_arm.ik3(x, y, z, *links, frame, elbow, back))
            assert np.max(np.abs(np.stack(truth_arm.fk3(*found, *links, frame)) - (x, y, z))
                          [:, truth_arm.reachable(np.stack([x, y, z], -1), *links, frame, back) > 1e-6]) < 1e-6
            away = np.abs(np.mod(found - theta + np.pi, 2 * np.pi) - np.pi).max(axis=0)
            best = np.minimum(best, away)
    assert np.quantile(best, 0.999) < 1e-6  # one of the four branches is the one that it came from


@pytest.mark.parametrize(("key", "change"), [
    ("constants.shoulder", {"shoulder": 900.0}), ("constants.base", {"base": -1300.0}),
    ("constants.lateral", {"lateral": 1281.0})])
def test_a_constant_that_does_not_fit_names_arm_key_and_reason(key, change):
    with pytest.raises(ArmError, match=rf"all: {key}: .* mm is -?\d+ LSB and the word ends at -?\d+; raise"):
        arm.words(W16, replace(BUILT, **change), True)


@pytest.mark.parametrize("name", ("dobot_magician", "ur5"))
def test_the_section_of_a_workspace(name):
    """What the picture of rtl/arm shows: both sides of the shoulder, 2 LSB at most, nothing nearer than the offset."""
    r, _, error = workspaces.section(arms.load(name), 41)
    for side in (r < 0, r > 0):
        assert np.isfinite(error[side]).sum() > 300 and np.nanmax(error[side]) <= 2
    assert np.all(np.isnan(error[np.abs(r) < arms.load(name).lateral - 1]))


# The cores that choose a branch: no jump along a path, limits, and what happens when none is within them

P2 = {"W": 16, "F": 8, "U": 16}
FREE = (-math.pi, math.pi)


def _kept(out: dict[str, np.ndarray], joints: int) -> np.ndarray:
    return np.stack([np.arctan2(out[f"out_n{i}"], out[f"out_c{i}"]) for i in range(1, joints + 1)])


def _steps(theta: np.ndarray) -> np.ndarray:
    return np.abs(truth.difference(theta[:, 1:], theta[:, :-1]))


def _keep3(built: arms.Arm, target: np.ndarray, room: tuple = (FREE, FREE, FREE)) -> dict[str, np.ndarray]:
    p = P2 | arm.switches(built)
    words = {name: word for i, ends in enumerate(room, 1) for name, word in arm_keep.limit(p, i, *ends).items()}
    return arm_keep.keep3(p, in_x=target[0], in_y=target[1], in_z=target[2], **words, **arm.words(p, built, True))


def _keep2(l1: int, l2: int, x: np.ndarray, y: np.ndarray, room: tuple = (FREE, FREE)) -> dict[str, np.ndarray]:
    words = {name: word for i, ends in enumerate(room, 1) for name, word in arm_keep.limit(P2, i, *ends).items()}
    return arm_keep.keep2(P2, in_x=x, in_y=y, **words, cfg_l1=l1, cfg_l2=l2,
                          **kernel_vector_solve.config(P2, cfg_l1=l1, cfg_l2=l2))


def _path(built: arms.Arm, low: tuple, high: tuple, count: int = 3000) -> tuple[np.ndarray, np.ndarray]:
    """A smooth path of the machine's joints between two poses, and its tips, LSB."""
    phase = np.sin(np.linspace(0, 4 * np.pi, count)[None] * np.array([[1.0], [1.5], [0.5]])) / 2 + 0.5
    theta = np.array(low)[:, None] + (np.array(high) - low)[:, None] * phase
    return theta, np.rint(np.stack(truth_arm.fk3(*theta, *built.links, truth_arm.frame(built))) * 256).astype(np.int64)


@pytest.mark.parametrize("name", arms.known())
def test_no_jump_along_a_path(name):
    """The joints that made the path come back, on one branch, within what rounding of the target does to them."""
    built = arms.load(name)
    frame = truth_arm.frame(built)
    middle = frame.turn if not frame.absolute else 0.0
    theta, target = _path(built, (0.2, -1.9 - middle, -0.8), (0.9, -0.8 - middle, 1.0))
    radius = truth_arm.plane(*target / 256, 0, frame)
    inside = np.hypot(radius[0], radius[1]) > 4
    assert inside.all()
    out = _keep3(built, target)
    assert np.max(_steps(_kept(out, 3))) < 3 * np.max(_steps(theta)) + 0.003
    assert np.unique(out["out_elbow"][50:] + 2 * out["out_back"][50:]).size == 1
    assert not out["out_beyond"].any()


def test_an_elbow_is_kept_through_the_stretched_arm():
    """A straight line that leaves the reach and comes back: the elbow does not jump more than the border makes it."""
    x = np.concatenate([np.linspace(3000, 16500, 900), np.linspace(16500, 3000, 900)]).astype(np.int64)
    out = _keep2(8320, 7040, x, np.full(x.size, 1500))
    theta = _kept(out, 2)
    assert np.any(out["out_status"] & 1) and np.max(_steps(theta)) < 0.16


def test_the_shoulder_holds_joint_1_at_the_last_answer():
    """Equal links through the shoulder itself: joint 1 is undefined there, holds, and the arm goes on."""
    x = np.arange(-60, 61) * 40
    out = _keep2(6000, 6000, x, np.zeros(x.size, dtype=np.int64))
    at = int(np.flatnonzero(x == 0)[0])
    assert out["out_status"][at] == 2
    assert (out["out_c1"][at], out["out_n1"][at]) == (out["out_c1"][at - 1], out["out_n1"][at - 1])


def test_the_yaw_axis_holds_joint_3_and_the_arm_goes_straight_through():
    """Over the axis the plane does not turn round: front becomes back."""
    built = replace(arms.load("uarm_swift_pro"), shoulder=0.0, absolute_elbow=False)
    x = np.arange(-80, 81) * 25
    out = _keep3(built, np.stack([x, 0 * x, np.full(x.size, 6500)]))
    theta = _kept(out, 3)
    assert out["out_status"][80] & 2 and np.unique(out["out_back"][5:75]).size == 1
    assert np.unique(out["out_back"][86:]).size == 1 and out["out_back"][70] != out["out_back"][90]
    assert np.max(_steps(theta)) < 0.05


def test_limits_choose_the_branch_and_say_when_none_is_within_them():
    rng = np.random.default_rng(3)
    theta = rng.uniform(-math.pi, math.pi, (2, 4000))
    x, y = (np.rint(word).astype(np.int64) for word in truth.fk2(*theta, 8320, 7040))
    room = (math.radians(-100), math.radians(100)), (math.radians(-140), math.radians(-10))
    out = _keep2(8320, 7040, x, y, room)
    found = [np.stack(truth.ik2(x, y, 8320, 7040, elbow)) for elbow in (0, 1)]

    def depth(pose: np.ndarray) -> np.ndarray:
        return np.min([(high - low) / 2 - np.abs(truth.difference(one, (low + high) / 2))
                       for one, (low, high) in zip(pose, room)], axis=0)

    deep = np.max([depth(pose) for pose in found], axis=0)
    assert np.all(out["out_beyond"][deep > 0.003] == 0) and np.all(out["out_beyond"][deep < -0.003] == 1)
    assert 500 < out["out_beyond"].sum() < 3500
    inside = out["out_beyond"] == 0
    assert np.all(depth(_kept(out, 2))[inside] > -0.003)


def test_an_answer_beyond_the_limits_is_not_remembered():
    """Out to a target that no branch reaches within the limits and back: as if it had not been."""
    room = (math.radians(-60), math.radians(60)), FREE
    x, y = np.array([9000, 9000, -9000, 9000]), np.array([2000, 2500, 100, 2500])
    out = _keep2(8320, 7040, x, y, room)
    assert np.array_equal(out["out_beyond"], [0, 0, 1, 0])
    assert all(out[name][3] == out[name][1] for name in out)


def test_a_room_of_a_turn_is_no_limit():
    word = arm_keep.limit(P2, 1, -math.pi, math.pi)["cfg_h1"]
    assert word == -131072  # less than any cosine of two directions


# Velocities and rates against complex arithmetic in float64, near and at the singular poses too

LINKS = [(0.5, 0.42), (0.3, 0.6), (0.9, 0.05)]  # of the coordinate's range, halved
RATED = {core.id: core for core in distinct() if core.family == "arm" and core.function[:-1] in ("velocity", "rates")}
RATED_CASES = [pytest.param(core, *links, id=f"{name}-{links[0]}") for name, core in RATED.items() for links in LINKS]


def _case(core, share1: float, share2: float, count: int = 40_000):
    """Joint words with their complex vectors, rates with their words, and the lengths, LSB."""
    p, joints, rng = core.params, int(core.function[-1]), np.random.default_rng(4)
    one, half = 1 << p["U"], 1 << p["W"] - 2
    theta = rng.uniform(-np.pi, np.pi, (joints, count))
    words = {f"in_{letter}{i}": np.rint(part * one).astype(np.int64) for i, angle in enumerate(theta, 1)
             for letter, part in (("c", np.cos(angle)), ("n", np.sin(angle)))}
    vectors = [(words[f"in_c{i}"] + 1j * words[f"in_n{i}"]) / one for i in range(1, joints + 1)]
    return p, words, vectors, int(share1 * half), int(share2 * half), rng


def _exact(vectors, rates, l1: int, l2: int) -> tuple[np.ndarray, np.ndarray]:
    """Velocity (axes, N) and rho."""
    upper, fore = l1 * vectors[0], l2 * vectors[0] * vectors[1]
    plane = 1j * (rates[0] * (upper + fore) + rates[1] * fore)
    if len(vectors) == 2:
        return np.stack([plane.real, plane.imag]), (upper + fore).real
    flat = (plane.real + 1j * rates[2] * (upper + fore).real) * vectors[2]
    return np.stack([flat.real, flat.imag, plane.imag]), (upper + fore).real


def _axes(out: dict[str, np.ndarray], count: int) -> np.ndarray:
    return np.stack([out[f"out_{axis}"] for axis in "xyz"[:count]])


def test_a_product_of_more_than_64_bits_keeps_the_bits_that_count():
    """The longest words there are, those of W = U = 24: their product has 73 bits."""
    p = {"W": 24, "U": 24, "V": 16}
    rng, n = np.random.default_rng(7), arm_velocity.bits(p)
    ends = (1 << 33, 1 << n - 1)
    left, right = (rng.integers(-end, end, 4000) for end in ends)
    left[:4], right[:4] = np.array([-1, -1, 1, 1]) * ends[0], np.array([-1, 1, -1, 1]) * ends[1]
    left[:4] -= left[:4] > 0
    right[:4] -= right[:4] > 0
    exact = [int(a) * int(b) >> 24 for a, b in zip(left, right)]
    assert max(map(abs, exact)) > 1 << 63 - 24
    exact = [(one + (1 << n - 1)) % (1 << n) - (1 << n - 1) for one in exact]
    assert arm_velocity._sum(p, (left, right)).tolist() == exact


@pytest.mark.parametrize(("core", "share1", "share2"), [one for one in RATED_CASES if "velocity" in one.id])
def test_velocity_of_the_tip(core, share1, share2):
    p, words, vectors, l1, l2, rng = _case(core, share1, share2)
    joints, half = len(vectors), 1 << p["W"] - 1
    rates = rng.integers(-half, half, (joints, words["in_c1"].size)) >> rng.integers(0, p["W"], words["in_c1"].size)
    out = core.model(p, **words, **{f"in_w{i}": word for i, word in enumerate(rates, 1)}, cfg_l1=l1, cfg_l2=l2)
    real = rates / 2.0 ** p["V"]
    exact, _ = _exact(vectors, real, l1, l2)
    held = np.all(np.abs(exact) < half - 4, axis=0)
    assert held.sum() > 5000 and not out["out_status"][held].any()
    limit = limits.velocity2(*real) if joints == 2 else limits.velocity3(*real)
    limit = limit + np.abs(exact).max(axis=0) * 1e-9
    assert np.all(np.abs(_axes(out, joints) - exact)[:, held] <= limit[held])
    over = np.any(np.abs(exact) > half + 4, axis=0)
    assert over.any() and np.all(out["out_status"][over] == 4)


def _thresholds(core, l1: int, l2: int) -> dict[str, int]:
    found = {"cfg_l1": l1, "cfg_l2": l2, "cfg_sine": (1 << core.params["U"]) // 16}
    return found | ({"cfg_radius": (l1 + l2) // 16} if core.function == "rates3" else {})


@pytest.mark.parametrize(("core", "share1", "share2"), [one for one in RATED_CASES if "rates" in one.id])
def test_rates_give_the_velocity_asked_for(core, share1, share2):
    p, words, vectors, l1, l2, rng = _case(core, share1, share2)
    joints, cfg, count = len(vectors), _thresholds(core, l1, l2), words["in_c1"].size
    speed = (1 << p["W"] - 1) // 40
    asked = rng.integers(-speed, speed, (joints, count))
    out = core.model(p, **words, **{f"in_{axis}": word for axis, word in zip("xyz", asked)}, **cfg)
    rates = np.stack([out[f"out_w{i}"] for i in range(1, joints + 1)]) / 2.0 ** p["V"]
    got, rho = _exact(vectors, rates, l1, l2)
    near = np.abs(words["in_n2"]) < cfg["cfg_sine"]
    if joints == 3:
        band = np.abs(np.abs(rho) - cfg["cfg_radius"]) < 2
        near = near | (np.abs(rho) < cfg["cfg_radius"])
        assert np.array_equal((out["out_status"] & 2 > 0)[~band], near[~band])
    else:
        assert np.array_equal(out["out_status"] & 2 > 0, near)
    regular = out["out_status"] == 0
    assert regular.sum() > 5000
    error, size = np.linalg.norm(got - asked, axis=0), np.linalg.norm(asked, axis=0)
    s = rates[0] + rates[1]
    limit = limits.rates2(p, l1, l2, s, size) if joints == 2 else limits.rates3(p, l1, l2, s, rates[2], rho, size)
    assert np.all(error[regular] <= limit[regular])


def test_a_straight_arm_gives_what_it_can_and_bounded_rates():
    """n2 = 0: the velocity across the arm comes out, that along it does not; the rates are those of the threshold."""
    core = RATED["arm_rates2-U16"]
    one, l1, l2 = 65536, 8000, 7000
    angle = np.linspace(-3, 3, 601)
    words = {"in_c1": np.rint(np.cos(angle) * one).astype(int), "in_n1": np.rint(np.sin(angle) * one).astype(int),
             "in_c2": np.full(601, one), "in_n2": np.zeros(601, int)}
    out = core.model(core.params, **words, in_x=np.full(601, 300), in_y=np.full(601, -120), cfg_l1=l1, cfg_l2=l2,
                     cfg_sine=2048)
    assert np.all(out["out_status"] == 2)
    rates = np.stack([out["out_w1"], out["out_w2"]]) / 4096
    v1 = (words["in_c1"] + 1j * words["in_n1"]) / one
    got, _ = _exact([v1, np.ones(601)], rates, l1, l2)
    across = 1j * v1 * np.real((300 - 120j) * np.conj(1j * v1))  # the nearest velocity that the arm can give
    assert np.max(np.abs(got[0] + 1j * got[1] - across)) < limits.rates2(core.params, l1, l2, 2.0, 323)
    assert np.max(np.abs(rates[0] + rates[1])) <= 324 / (l2 * 2048 / one) + 0.001


def test_no_determinant_at_all_stands_still_and_says_so():
    core = RATED["arm_rates3-U16"]
    words = {"in_c1": 65536, "in_n1": 0, "in_c2": np.array([-65536, -65536, 50000]), "in_n2": np.array([0, 0, 40000]),
             "in_c3": 65536, "in_n3": 0,
             "in_x": 500, "in_y": np.array([400, -400, 400]), "in_z": 300}
    out = core.model(core.params, **words, cfg_l1=5000, cfg_l2=5000, cfg_sine=0, cfg_radius=0)
    assert np.array_equal(out["out_status"] & 2, [2, 2, 0])
    assert np.array_equal(out["out_w3"][:2], [0, 0])
    still = core.model(core.params, **words, cfg_l1=0, cfg_l2=0, cfg_sine=0, cfg_radius=0)
    assert all(np.all(still[f"out_w{i}"] == 0) for i in (1, 2, 3)) and np.all(still["out_status"] == 2)


@pytest.mark.parametrize("u", [8, 16, 20])
def test_a_turn_is_rounded_from_products_of_one_bit_more(u):
    rng = np.random.default_rng(u)
    c, n, by_c, by_n = rng.integers(-1 << u, 1 << u, (4, 100_000), endpoint=True)
    cosine, sine = arm.turn({"U": u}, c, n, by_c, by_n)
    for found, exact in ((cosine, c * by_c - n * by_n - n), (sine, c * by_n + n * by_c)):
        off = np.asarray(found - exact / (1 << u), float)
        inside = np.abs(exact) < 1.9 * 4.0**u  # the word does not wrap
        # Each product loses less than a half, their sum is a multiple of a half and rounded to the next word
        assert -1 < off[inside].min() < -0.9 and 0.4 < off[inside].max() <= 0.5
