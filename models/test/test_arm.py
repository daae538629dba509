"""Models of rtl/arm: all ten arms end to end, forward and inverse, both elbows, both sides of the shoulder."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from quadrance import arm, arms, bounds, truth_arm, workspaces
from quadrance.arms import ArmError
from quadrance.bounds import arm as limits
from quadrance.cores import all_cores

W16 = {"W": 16, "F": 8, "U": 16}
ALL = {name: 1 for name in arm.SWITCHES}
SETS = {core.id: core.params for core in all_cores() if core.family == "arm" and core.function[-3:] in ("fk3", "ik3")}
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
    allowed = 1.1 * off + (bounds.vector.gap(p, l1, l2) * 4.0 ** (p["W"] - 16) + 2) / np.maximum(2 * far, 1) + 1e-6
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
