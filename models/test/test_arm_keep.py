"""Models of the cores that choose a branch: no jump along a path, limits, and what happens when none is within them."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from quadrance import arm, arm_keep, arms, kernel_vector_solve, truth, truth_arm

P2 = {"W": 16, "F": 8, "U": 16}
FREE = (-math.pi, math.pi)


def _angles(out: dict[str, np.ndarray], joints: int) -> np.ndarray:
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
    assert np.max(_steps(_angles(out, 3))) < 3 * np.max(_steps(theta)) + 0.003
    assert np.unique(out["out_elbow"][50:] + 2 * out["out_back"][50:]).size == 1
    assert not out["out_beyond"].any()


def test_an_elbow_is_kept_through_the_stretched_arm():
    """A straight line that leaves the reach and comes back: the elbow does not jump more than the border makes it."""
    x = np.concatenate([np.linspace(3000, 16500, 900), np.linspace(16500, 3000, 900)]).astype(np.int64)
    out = _keep2(8320, 7040, x, np.full(x.size, 1500))
    theta = _angles(out, 2)
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
    theta = _angles(out, 3)
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
    assert np.all(depth(_angles(out, 2))[inside] > -0.003)


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
