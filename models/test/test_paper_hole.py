"""The paper's inverse for targets nearer to the base than the links can fold: the answer is the nearest point."""

from __future__ import annotations

import numpy as np
import pytest
from quadrance import paper, truth

SETS = {"S8": {"W": 16, "F": 8, "S": 8, "R": 4}, "S24": {"W": 16, "F": 8, "S": 24, "R": 3}}
UNREACHABLE = 1


def test_a_target_in_the_hole_turns_joint_one_to_it():
    answer = paper.ik2(SETS["S24"], in_x=np.array([300]), in_y=np.array([100]), in_elbow=0, cfg_l1=4384, cfg_l2=12000)
    assert answer["out_status"].tolist() == [UNREACHABLE] and answer["out_j2"].tolist() == [2 << 24]
    assert abs(int(answer["out_j1"][0]) - 35232154) <= 1  # half a turn past the target: link 2 is the longer one


@pytest.mark.parametrize("l1, l2", [(4384, 12000), (12000, 4384), (0, 5000), (700, 30000), (16000, 15000)])
@pytest.mark.parametrize("p", SETS.values(), ids=SETS)
def test_the_hole_is_answered_by_its_nearest_point(p, l1, l2):
    rng = np.random.default_rng(6)
    hole, turn = abs(l1 - l2), rng.uniform(-np.pi, np.pi, 20_000)
    radius = np.maximum(1, (hole - 2) * 2.0 ** -rng.uniform(0, 12, turn.size))
    x, y = (np.rint(radius * f(turn)).astype(np.int64) for f in (np.cos, np.sin))
    answer = paper.ik2(p, in_x=x, in_y=y, in_elbow=rng.integers(0, 2, x.size), cfg_l1=l1, cfg_l2=l2)
    defined = answer["out_status"] & 2 == 0
    assert np.all(answer["out_status"] & UNREACHABLE) and np.mean(defined) > 0.3
    assert np.all(answer["out_j2"] == 2 << p["S"])
    exact = np.arctan2(y, x) + (np.pi if l2 > l1 else 0)
    off = np.mod(truth.angle_to_spread(exact, p["S"]) - answer["out_j1"] + (2 << p["S"]), 4 << p["S"]) - (2 << p["S"])
    near = truth.spread_word_to_angle(answer["out_j1"] + np.clip(off, -0.5, 0.5), p["S"])
    error = hole * 2 * np.abs(np.sin((near - exact) / 2))
    digits, root, lost = (12, 12, 2.0**-8) if p["S"] == 8 else (27, 26, 0.0)
    # README's law: sa truncated and its root; and quadrances truncated by `lost` units^2, seen from the target
    reached = hole / 256 * (2 * 2.0 ** (-digits / 2) + np.sqrt(3) * 2.0 ** (-root / 2))
    blurred = 2 * hole / np.maximum(np.hypot(x, y), 1) * np.sqrt(lost)
    assert np.all((error <= 256 * (reached + blurred) + 1e-6)[defined])
