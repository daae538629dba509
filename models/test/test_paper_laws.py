"""The laws of the paper's inverse cores at every word: any S, W and F, short and unequal links, the hole."""

from __future__ import annotations

import numpy as np
import pytest
from quadrance import bounds, codecs, paper, truth
from quadrance.cores import Port

SETS = [{"W": w, "F": f, "S": s, "R": r} for w, f, s, r in (
    (16, 8, 8, 4), (16, 8, 16, 4), (16, 8, 24, 3), (12, 6, 16, 3), (18, 10, 16, 3), (24, 11, 24, 3))]
LINKS = [(0.5, 0.5), (0.45, 0.3), (0.05, 0.9), (0.002, 0.002), (1 / 32768, 0.3), (0.3, 1 / 32768)]
SET = pytest.mark.parametrize("p", SETS, ids=lambda p: f"W{p['W']}F{p['F']}S{p['S']}")
UNREACHABLE, SINGULAR = 1, 2


def _targets(joints: int, l1: int, l2: int, full: int) -> tuple[np.ndarray, ...]:
    """Targets (joints, N): anywhere in reach, crowded at both circles, in the hole to its middle, beyond; the elbow."""
    rng, n = np.random.default_rng(5), 1500
    near, far = abs(l1 - l2), l1 + l2
    crowd = (far - near) * 2.0 ** -rng.uniform(0, 24, n)
    r = np.concatenate([rng.uniform(near, far, n), near + crowd, far - crowd, near * 2.0 ** -rng.uniform(0, 24, n),
                        rng.uniform(far, 2 * far, n // 4)])
    way = rng.normal(size=(joints, r.size))
    way[:, ::3] *= 2.0 ** -rng.integers(0, 18, way[:, ::3].shape)  # close to axes and planes
    target = np.clip(np.rint(r * way / np.linalg.norm(way, axis=0)), -full, full - 1).astype(np.int64)
    return target, rng.integers(0, 2, r.size)


@SET
@pytest.mark.parametrize("joints", [2, 3])
@pytest.mark.parametrize("share", LINKS, ids=str)
def test_the_tip_in_reach_and_the_nearest_point_beyond(p, joints, share):
    full = 1 << p["W"] - 1
    l1, l2 = (max(round(full * part), 1) for part in share)
    target, elbow = _targets(joints, l1, l2, full)
    model, inverse, forward = ((paper.ik2, truth.ik2, truth.fk2), (paper.ik3, truth.ik3, truth.fk3))[joints - 2]
    out = model(p, **dict(zip(("in_x", "in_y", "in_z"), target)), in_elbow=elbow, cfg_l1=l1, cfg_l2=l2)
    exact = np.nan_to_num(inverse(*target, l1, l2, elbow))
    joint = (Port("j", p["S"] + 2, False, "spread"),)
    near = [codecs.within_cell(joint, {"j": out[f"out_j{i}"]}, theta) for i, theta in enumerate(exact, 1)]
    tip = np.stack(forward(*near, l1, l2))
    r = np.sqrt((target.astype(float) ** 2).sum(axis=0))
    defined = out["out_status"] & SINGULAR == 0
    inside = defined & (r >= abs(l1 - l2)) & (r <= l1 + l2) & (out["out_status"] == 0)
    error = np.linalg.norm(tip - target, axis=0)
    assert np.max(error[inside], initial=0) <= bounds.paper.inverse(p, joints, l1, l2)
    beyond = defined & ((r < abs(l1 - l2)) | (r > l1 + l2)) & (out["out_status"] & UNREACHABLE > 0)
    plane = target if joints == 2 else np.stack([np.hypot(*target[:2]), target[2]])
    theta = np.arctan2(plane[1], plane[0]) + np.where((r < abs(l1 - l2)) & (l2 > l1), np.pi, 0)
    off = np.abs(truth.difference(codecs.within_cell(joint, {"j": out["out_j1"]}, theta), theta))
    assert np.all((off <= bounds.paper.nearest(p, joints, r))[beyond])
    if p["S"] == 24 or p["S"] == 2 * p["F"]:
        assert beyond.sum() > 250 or share[0] == share[1] or min(share) < 1e-4
