"""The laws of the inverse rational cores where they depend on the parameters: at the circles, in the hole, short words.

Targets are sought where the law is at its worst: the lattice points closest to the circles of the stretched and the
folded arm, where random targets hardly come, and those next to the base of an arm with a hole.
"""

from __future__ import annotations

import numpy as np
import pytest
from quadrance import bounds, codecs, rational, truth
from quadrance.cores import Port

SETS = [{"W": 16, "F": 8, "S": s} for s in (16, 20, 24)] + [{"W": 12, "F": 6, "S": 16}]
LINKS = [(8192, 8192), (8320, 7040), (5000, 11384), (304, 16000), (320, 208)]
SET = pytest.mark.parametrize("p", SETS, ids=lambda p: f"W{p['W']}S{p['S']}")


def _links(p: dict[str, int], l1: int, l2: int) -> tuple[int, int]:
    return l1 >> 16 - p["W"], l2 >> 16 - p["W"]


def _tip(p: dict[str, int], out: dict[str, np.ndarray], exact, l1: int, l2: int) -> np.ndarray:
    """Tip (2 or 3, N) of the angles nearest to `exact` that round to the answered words."""
    joint = (Port("j", p["S"] + 2, False, "spread"),)
    near = [codecs.within_cell(joint, {"j": out[f"out_j{i}"]}, np.nan_to_num(theta))
            for i, theta in enumerate(exact, 1)]
    return np.stack((truth.fk2 if len(near) == 2 else truth.fk3)(*near, l1, l2))


def _beside(radius: int, width: int) -> tuple[np.ndarray, np.ndarray]:
    """Lattice points next to a circle, inside and outside, in two quadrants."""
    x = np.arange(min(radius + 1, 1 << width - 1))
    y = np.sqrt(np.maximum(radius * radius - x * x, 0)).astype(np.int64)
    x, y = np.concatenate([x, x, -x]), np.concatenate([y, y + 1, y])
    inside = y < 1 << width - 1
    return x[inside], y[inside]


def _near_circles(p: dict[str, int], l1: int, l2: int) -> tuple[np.ndarray, ...]:
    """Targets in reach beside both circles, and which elbow."""
    x, y = np.concatenate([_beside(radius, p["W"]) for radius in (l1 + l2, abs(l1 - l2))], axis=1)
    q = x * x + y * y
    keep = (q > 0) & (q <= (l1 + l2) ** 2) & (q >= (l1 - l2) ** 2)
    return x[keep], y[keep], np.arange(keep.sum()) % 2


@SET
@pytest.mark.parametrize(("l1", "l2"), LINKS)
def test_ik2_beside_the_circles(p: dict[str, int], l1: int, l2: int) -> None:
    l1, l2 = _links(p, l1, l2)
    x, y, elbow = _near_circles(p, l1, l2)
    out = rational.ik2(p, in_x=x, in_y=y, in_elbow=elbow, cfg_l1=l1, cfg_l2=l2,
                       **rational.config(p, cfg_l1=l1, cfg_l2=l2))
    assert not out["out_status"].any()
    error = np.hypot(*(_tip(p, out, truth.ik2(x, y, l1, l2, elbow), l1, l2) - np.stack([x, y])))
    assert np.all(error <= bounds.rational.ik2(p, l1, l2, np.hypot(x, y)))


def test_coarse_words_cost_most_beside_the_circles() -> None:
    """The figures of the page: at S = 16 and 20 joint 2 is off by more than its word at S = 24 would let it."""
    worst = {}
    for p in SETS[:3]:
        x, y, elbow = _near_circles(p, 5000, 11384)
        out = rational.ik2(p, in_x=x, in_y=y, in_elbow=elbow, cfg_l1=5000, cfg_l2=11384,
                           **rational.config(p, cfg_l1=5000, cfg_l2=11384))
        error = np.hypot(*(_tip(p, out, truth.ik2(x, y, 5000, 11384, elbow), 5000, 11384) - np.stack([x, y])))
        worst[p["S"]] = float(error.max())
    assert worst[24] < 0.6 < 4 < worst[20] < 5 and 4 < worst[16] < 5


@SET
@pytest.mark.parametrize(("l1", "l2"), LINKS)
def test_ik3_beside_the_circles(p: dict[str, int], l1: int, l2: int) -> None:
    l1, l2 = _links(p, l1, l2)
    across, z, elbow = _near_circles(p, l1, l2)
    turn = np.random.default_rng(9).uniform(-np.pi, np.pi, across.size)
    turn[::2] = np.pi / 2 * np.round(turn[::2])  # on an axis rho is a whole number, so the circle is as near
    x, y = (np.rint(across * part).astype(np.int64) for part in (np.cos(turn), np.sin(turn)))
    q = x * x + y * y + z * z
    keep = (x * x + y * y > 0) & (q <= (l1 + l2) ** 2) & (q >= (l1 - l2) ** 2)
    x, y, z, elbow = x[keep], y[keep], z[keep], elbow[keep]
    out = rational.ik3(p, in_x=x, in_y=y, in_z=z, in_elbow=elbow, cfg_l1=l1, cfg_l2=l2,
                       **rational.config(p, cfg_l1=l1, cfg_l2=l2))
    assert not out["out_status"].any()
    target = np.stack([x, y, z])
    error = np.linalg.norm(_tip(p, out, truth.ik3(*target, l1, l2, elbow), l1, l2) - target, axis=0)
    assert np.all(error <= bounds.rational.ik3(p, l1, l2, target))


@SET
@pytest.mark.parametrize("joints", [2, 3])
@pytest.mark.parametrize(("l1", "l2"), [(12000, 4384), (4384, 12000), (16000, 304), (30000, 2000), (320, 208)])
def test_out_of_reach_and_in_the_hole_the_nearest_point(p: dict[str, int], joints: int, l1: int, l2: int) -> None:
    l1, l2 = _links(p, l1, l2)
    rng, full, hole = np.random.default_rng(3), 1 << p["W"] - 1, abs(l1 - l2)
    short = hole * 2.0 ** -rng.uniform(0, p["W"], 30_000)
    long = rng.uniform(l1 + l2, 2 * full, 8000)
    way = rng.normal(size=(joints, short.size + long.size))
    target = np.rint(np.append(short, long) * way / np.linalg.norm(way, axis=0))
    few = rng.integers(-3, 4, (joints, 4000))  # next to the base, where an error of rho turns the arm most
    target = np.clip(np.concatenate([target, few], axis=1), -full, full - 1).astype(np.int64)
    target = target[:, (target[:2] != 0).any(axis=0)]
    elbow = rng.integers(0, 2, target.shape[1])
    model, inverse = (rational.ik2, truth.ik2) if joints == 2 else (rational.ik3, truth.ik3)
    out = model(p, **dict(zip(("in_x", "in_y", "in_z"), target)), in_elbow=elbow, cfg_l1=l1, cfg_l2=l2,
                **rational.config(p, cfg_l1=l1, cfg_l2=l2))
    flagged = out["out_status"] == 1
    assert flagged.sum() > 3000
    exact = truth.nearest(target.T, l1, l2).T if joints == 3 else \
        target * np.clip(np.hypot(*target), hole, l1 + l2) / np.hypot(*target)
    error = np.linalg.norm(_tip(p, out, inverse(*target, l1, l2, elbow), l1, l2) - exact, axis=0)
    law = bounds.rational.nearest(p, l1, l2, target)
    assert np.all((error <= law)[flagged])
    if joints == 3 and (l1, l2) == (12000, 4384) and p["S"] == 24:  # the hole's own law is needed, and not idle
        assert error[flagged].max() > 80 and np.max((error / law)[flagged]) > 0.3
