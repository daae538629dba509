"""Models of the inverse rational cores against the float64 truth: tip error, flags, held words, symmetry."""

from __future__ import annotations

import numpy as np
import pytest
from quadrance import bounds, codecs, rational, truth
from quadrance.cores import Port

P = {"W": 16, "F": 8, "S": 24}
JOINTS = [(Port(f"out_j{i}", 26, False, "spread"),) for i in (1, 2, 3)]
LINKS = [(8192, 8192), (8320, 7040), (12000, 4384), (4384, 12000), (16000, 300), (300, 16000), (768, 512), (30, 20),
         (5, 2), (1, 1), (16384, 16384), (30000, 2000), (60000, 60000)]


def _targets(l1: int, l2: int, count: int = 60_000) -> tuple[np.ndarray, ...]:
    """Targets from folded to stretched, a quarter of them at the borders of reach; both elbows."""
    rng = np.random.default_rng(l1 + 3 * l2)
    turn = rng.uniform(-np.pi, np.pi, count)
    radius = rng.uniform(abs(l1 - l2), l1 + l2, count)
    near = rng.exponential(4, count // 4)
    radius[::4] = np.where(rng.random(near.size) < 0.5, abs(l1 - l2) + near, l1 + l2 - near)
    x, y = (np.rint(radius * part).astype(np.int64) for part in (np.cos(turn), np.sin(turn)))
    inside = (np.abs(x) < 32768) & (np.abs(y) < 32768)
    return x[inside], y[inside], rng.integers(0, 2, count)[inside]


def _answer(l1: int, l2: int, x: np.ndarray, y: np.ndarray, elbow: np.ndarray) -> dict[str, np.ndarray]:
    return rational.ik2(P, in_x=x, in_y=y, in_elbow=elbow, cfg_l1=l1, cfg_l2=l2,
                        **rational.config(P, cfg_l1=l1, cfg_l2=l2))


@pytest.mark.parametrize(("l1", "l2"), LINKS)
def test_ik2_puts_the_tip_within_its_bound(l1: int, l2: int) -> None:
    x, y, elbow = _targets(l1, l2)
    rho = np.hypot(x, y)
    keep = (rho > 0) & (rho <= l1 + l2) & (rho >= abs(l1 - l2))
    x, y, elbow, rho = x[keep], y[keep], elbow[keep], rho[keep]
    out, exact = _answer(l1, l2, x, y, elbow), truth.ik2(x, y, l1, l2, elbow)
    assert not out["out_status"].any()  # nothing in reach is flagged, borders included
    tip = truth.fk2(*(codecs.within_cell(joint, out, theta) for joint, theta in zip(JOINTS, exact)), l1, l2)
    error = np.hypot(tip[0] - x, tip[1] - y)
    assert np.all(error <= bounds.rational.ik2(P, l1, l2, rho))
    if l1 + l2 <= 16384:  # 64 units of Q7.8
        away = (rho >= 256) & (np.abs(np.sin(exact[1])) > 2**-8)
        assert np.max(error[away], initial=0) <= 1.0


@pytest.mark.parametrize(("l1", "l2"), LINKS)
def test_ik2_out_of_reach_answers_the_nearest_point(l1: int, l2: int) -> None:
    rng = np.random.default_rng(5)
    x, y, elbow = rng.integers(-32768, 32768, 40_000), rng.integers(-32768, 32768, 40_000), rng.integers(0, 2, 40_000)
    hole = rng.uniform(0, abs(l1 - l2), 10_000) + 1
    x[:10_000] = np.clip(np.rint(hole * np.cos(x[:10_000])), -32768, 32767)
    y[:10_000] = np.clip(np.rint(np.sqrt(np.maximum(hole**2 - x[:10_000] ** 2.0, 0))), 0, 32767)
    q, edge = x * x + y * y, bounds.rational.gap(P, l1, l2)
    far, near = q > (l1 + l2) ** 2 + edge, q < (l1 - l2) ** 2 - edge
    out = _answer(l1, l2, x, y, elbow)
    assert np.all(out["out_status"][far | near] & 1)
    x, y, rho = x[far | near], y[far | near], np.sqrt(q[far | near])
    keep = rho > 0
    exact = truth.ik2(x, y, l1, l2)
    assert np.all(np.isin(out["out_j2"][far | near], (0, 2 << 24)))
    theta = [codecs.within_cell(JOINTS[0], {"out_j1": out["out_j1"][far | near]}, np.nan_to_num(exact[0])),
             np.where(near[far | near], np.pi, 0)]
    reached, nearest = truth.fk2(*theta, l1, l2), np.where(near[far | near], abs(l1 - l2), l1 + l2) / np.maximum(rho, 1)
    error = np.hypot(reached[0] - x * nearest, reached[1] - y * nearest)
    assert np.all((error <= bounds.rational.nearest(P, l1, l2, np.stack([x, y])))[keep])


@pytest.mark.parametrize(("l1", "l2"), LINKS)
def test_ik3_puts_the_tip_within_its_bound(l1: int, l2: int) -> None:
    rng = np.random.default_rng(l1 + 7 * l2)
    radius, z, elbow = _targets(l1, l2)
    turn = rng.uniform(-np.pi, np.pi, radius.size)
    x, y = (np.rint(radius * part).astype(np.int64) for part in (np.cos(turn), np.sin(turn)))
    rho, length = np.hypot(x, y), np.sqrt(x * x + y * y + z * z)
    keep = (rho > 0) & (length <= l1 + l2) & (length >= abs(l1 - l2))
    x, y, z, elbow, rho, length = (word[keep] for word in (x, y, z, elbow, rho, length))
    out = rational.ik3(P, in_x=x, in_y=y, in_z=z, in_elbow=elbow, cfg_l1=l1, cfg_l2=l2,
                       **rational.config(P, cfg_l1=l1, cfg_l2=l2))
    assert not out["out_status"].any()
    exact = truth.ik3(x, y, z, l1, l2, elbow)
    tip = truth.fk3(*(codecs.within_cell(joint, out, theta) for joint, theta in zip(JOINTS, exact)), l1, l2)
    error = np.sqrt(sum((a - b) ** 2 for a, b in zip(tip, (x, y, z))))
    n2 = np.abs(np.sin(exact[1]))
    assert np.all(error <= bounds.rational.ik3(P, l1, l2, np.array([x, y, z])))
    if l1 + l2 <= 16384:
        away = (length >= 256) & (n2 > 2**-8)
        assert np.max(error[away], initial=0) <= 1.0


def test_ik3_agrees_with_ik2_in_the_plane_and_holds_on_the_axis() -> None:
    x, y, z = np.array([0, 0, 6000, 0, 0, -6000]), np.array([0, 0, 0, 0, 0, 0]), np.array([0, 5000, 3000, -4000, 0, 1])
    words = rational.config(P, cfg_l1=8192, cfg_l2=8192)
    out = rational.ik3(P, in_x=x, in_y=y, in_z=z, in_elbow=0, cfg_l1=8192, cfg_l2=8192, **words)
    assert out["out_status"].tolist() == [2, 2, 0, 2, 2, 0]
    assert out["out_j3"].tolist() == [0, 0, 0, 0, 0, 2 << 24]
    assert out["out_j1"][4] == out["out_j1"][3] and out["out_j1"][0] == 0
    flat = rational.ik2(P, in_x=np.abs(x), in_y=z, in_elbow=0, cfg_l1=8192, cfg_l2=8192, **words)
    assert np.array_equal(flat["out_j2"], out["out_j2"])
    turned = truth.difference(*(truth.spread_word_to_angle(words["out_j1"][1:4], 24) for words in (flat, out)))
    assert np.max(np.abs(turned)) <= 2**-12


def test_ik2_holds_joint_1_at_the_shoulder() -> None:
    x, y = np.array([0, 0, 5000, 0, 0]), np.array([0, 3000, 0, 0, 0])
    out = _answer(8192, 8192, x, y, np.zeros(5, dtype=np.int64))
    assert out["out_status"].tolist() == [2, 0, 0, 2, 2]
    assert out["out_j1"][0] == 0 and out["out_j1"][3] == out["out_j1"][4] == out["out_j1"][2]
    assert abs(int(out["out_j2"][0]) - (2 << 24)) <= 2**5  # folded


def test_ik2_elbows_mirror_joint_2_exactly() -> None:
    x, y, _ = _targets(8320, 7040)
    up, down = (_answer(8320, 7040, x, y, np.full(x.shape, elbow))["out_j2"] for elbow in (0, 1))
    assert np.all(up + down & (4 << 24) - 1 == 0)


@pytest.mark.parametrize(("l1", "l2"), [(0, 0), (0, 8192), (8192, 0), (65535, 65535), (65535, 0)])
def test_ik2_degenerate_links_still_point_at_the_target(l1: int, l2: int) -> None:
    x, y, elbow = _targets(9000, 9000)
    x = np.where((x == 0) & (y == 0), 1, x)
    out = _answer(l1, l2, x, y, elbow)
    theta = [truth.spread_word_to_angle(out[f"out_j{i}"], 24) for i in (1, 2)]
    reached = truth.fk2(*theta, l1, l2)
    if l1 == 0 or l2 == 0:
        turned = truth.difference(np.arctan2(reached[1], reached[0]), np.arctan2(y, x))
        assert l1 == l2 or np.max(np.abs(turned)) <= 6e-4
    if l1 != l2:
        rho = np.hypot(x, y)
        assert np.all((out["out_status"] & 1)[np.abs(rho - max(l1, l2)) > 1])
