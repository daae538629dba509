"""Models of the inverse vector cores against the float64 truth: tip error, flags, length of the words, held words."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from quadrance import accuracy, arms, bounds, kernel_vector_solve, kernel_vector_wide, vector
from quadrance.cores import all_cores, at, find

LINKS = [(8192, 8192), (8320, 7040), (12000, 4384), (4384, 12000), (16000, 300), (300, 16000), (768, 512), (30, 20),
         (5, 2), (1, 1), (100, 100), (16384, 16384), (30000, 2000), (20000, 25000), (60000, 60000)]
SETS = {core.id: core.params for core in all_cores() if core.model_name == "vector.ik2"}
P = {"W": 16, "F": 8, "U": 16}
SHORT = {"W": 18, "F": 8, "U": 12}  # words shorter than their kernel's
CASES = [pytest.param(p, *((length << p["W"]) >> 16 for length in pair), id=f"{name}-{pair[0]}-{pair[1]}")
         for name, p in (SETS | {"short": SHORT}).items() for pair in LINKS]


def _targets(p: dict[str, int], l1: int, l2: int, count: int = 60_000) -> tuple[np.ndarray, ...]:
    """Targets from folded to stretched, a quarter of them at the borders of reach; both elbows."""
    rng = np.random.default_rng(l1 + 3 * l2)
    turn, radius = rng.uniform(-np.pi, np.pi, count), rng.uniform(abs(l1 - l2), l1 + l2, count)
    near = rng.exponential(4, count // 4)
    radius[::4] = np.where(rng.random(near.size) < 0.5, abs(l1 - l2) + near, l1 + l2 - near)
    x, y = (np.rint(radius * part).astype(np.int64) for part in (np.cos(turn), np.sin(turn)))
    high = 1 << p["W"] - 1
    inside = (np.abs(x) < high) & (np.abs(y) < high)
    return x[inside], y[inside], rng.integers(0, 2, count)[inside]


def _answer(p: dict[str, int], l1: int, l2: int, x: np.ndarray, y: np.ndarray, elbow: object) -> dict[str, np.ndarray]:
    return vector.ik2(p, in_x=x, in_y=y, in_elbow=elbow, cfg_l1=l1, cfg_l2=l2,
                            **kernel_vector_wide.config(p, cfg_l1=l1, cfg_l2=l2))


def _tip(p: dict[str, int], out: dict[str, np.ndarray], l1: int, l2: int) -> tuple[np.ndarray, ...]:
    c1, n1, c2, n2 = (out[f"out_{name}"] / 2 ** p["U"] for name in ("c1", "n1", "c2", "n2"))
    a, b = l1 + l2 * c2, l2 * n2
    return a * c1 - b * n1, a * n1 + b * c1


def _in_reach(l1: int, l2: int, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    q = x * x + y * y
    return (q > 0) & (q <= (l1 + l2) ** 2) & (q >= (l1 - l2) ** 2)


def _sine(l1: int, l2: int, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    q = x * x + y * y  # exact in integers, for next to the borders the difference is small
    return np.sqrt(((l1 + l2) ** 2 - q) * (q - (l1 - l2) ** 2.0)) / max(2 * l1 * l2, 1)


@pytest.mark.parametrize(("p", "l1", "l2"), CASES)
def test_ik2_puts_the_tip_within_its_bound(p: dict[str, int], l1: int, l2: int) -> None:
    x, y, elbow = (word[_in_reach(l1, l2, *_targets(p, l1, l2)[:2])] for word in _targets(p, l1, l2))
    out, rho, n2 = _answer(p, l1, l2, x, y, elbow), np.hypot(x, y), _sine(l1, l2, x, y)
    assert not out["out_status"].any()  # nothing in reach is flagged, borders included
    tip = _tip(p, out, l1, l2)
    error = np.hypot(tip[0] - x, tip[1] - y)
    assert np.all(error <= bounds.vector.ik2(p, l1, l2, rho, n2))
    if p["W"] == 16 and l1 + l2 <= 16384:  # 64 units of Q7.8
        assert np.max(error[rho >= 256], initial=0) <= 0.6
    assert np.all(out["out_n2"] * (1 - 2 * elbow) >= 0)  # the elbow asked for
    length2 = np.hypot(out["out_c2"], out["out_n2"]) - (1 << p["U"])
    assert np.max(np.abs(length2)[n2 > 2**-6], initial=0) <= 1.5
    aligned = rho * 2.0 ** (kernel_vector_wide.form(p).bits - p["W"])
    far = aligned**2 > 4 * bounds.vector.quadrance(p, l1, l2, n2) + 4
    length1 = np.abs(np.hypot(out["out_c1"], out["out_n1"]) - (1 << p["U"]))
    assert np.all(length1[far] <= bounds.vector.ik2_length(p, l1, l2, rho, n2)[far])


def test_ik2_keeps_joint_1_a_unit_vector() -> None:
    """Cobra's links: within 2 words from a quarter of the reach on, within 9 down to the inner circle at 1280 LSB."""
    x, y, elbow = _targets(P, 8320, 7040)
    keep = _in_reach(8320, 7040, x, y)
    out, rho = _answer(P, 8320, 7040, x[keep], y[keep], elbow[keep]), np.hypot(x, y)[keep]
    away, n2 = np.abs(np.hypot(out["out_c1"], out["out_n1"]) - 65536), _sine(8320, 7040, x[keep], y[keep])
    assert np.max(away[rho > 3840]) <= 2
    assert np.max(away[n2 > 2**-6]) <= 3.5
    assert np.max(away) <= 9


@pytest.mark.parametrize(("p", "l1", "l2"), CASES)
def test_ik2_out_of_reach_answers_the_nearest_point(p: dict[str, int], l1: int, l2: int) -> None:
    rng, high = np.random.default_rng(5), 1 << p["W"] - 1
    x, y, elbow = *rng.integers(-high, high, (2, 40_000)), rng.integers(0, 2, 40_000)
    hole = rng.uniform(0, abs(l1 - l2), 10_000) + 1
    turn = rng.uniform(-np.pi, np.pi, 10_000)
    x[:10_000] = np.clip(np.rint(hole * np.cos(turn)), -high, high - 1)
    y[:10_000] = np.clip(np.rint(hole * np.sin(turn)), -high, high - 1)
    q, edge = x * x + y * y, bounds.vector.gap(p, l1, l2) / 4.0 ** (kernel_vector_wide.form(p).bits - p["W"])
    far, near = q > (l1 + l2) ** 2 + edge, q < (l1 - l2) ** 2 - edge
    out = _answer(p, l1, l2, x, y, elbow)
    assert np.all(out["out_status"][far | near] & 1)
    one = 1 << p["U"]
    assert np.all(out["out_c2"][far] == one) and np.all(out["out_c2"][near] == -one)
    assert not out["out_n2"][far | near].any()
    keep = (far | near) & (q > 0)
    nearest = np.where(near, abs(l1 - l2), l1 + l2)[keep] / np.sqrt(q[keep])
    tip = [part[keep] for part in _tip(p, out, l1, l2)]
    error = np.hypot(tip[0] - x[keep] * nearest, tip[1] - y[keep] * nearest)
    assert np.max(error, initial=0) <= bounds.vector.NEAREST * (l1 + l2) / 2 ** p["U"]


@pytest.mark.parametrize(("l1", "l2"), [(0, 0), (0, 8192), (8192, 0), (65535, 0), (65535, 1), (1, 65535)])
def test_ik2_degenerate_links_still_point_at_the_target(l1: int, l2: int) -> None:
    x, y, elbow = _targets(P, 9000, 9000)
    x = np.where((x == 0) & (y == 0), 1, x)
    out = _answer(P, l1, l2, x, y, elbow)
    length = np.hypot(out["out_c1"], out["out_n1"])
    assert np.max(np.abs(length - 65536)) <= 2
    if max(l1, l2) > 1000:
        tip, scale = _tip(P, out, l1, l2), max(l1, l2) / np.hypot(x, y)
        assert np.max(np.hypot(tip[0] - x * scale, tip[1] - y * scale)) <= min(l1, l2) + 2.5 * max(l1, l2) / 65536


def test_ik2_holds_joint_1_at_the_shoulder() -> None:
    x, y = np.array([0, 0, 5000, 0, 0]), np.array([0, 3000, 0, 0, 0])
    out = _answer(P, 8192, 8192, x, y, np.zeros(5, dtype=np.int64))
    assert out["out_status"].tolist() == [2, 0, 0, 2, 2]
    assert (out["out_c1"][0], out["out_n1"][0]) == (65536, 0)
    for name in ("out_c1", "out_n1"):
        assert out[name][3] == out[name][4] == out[name][2]
    assert out["out_c2"][0] == -65536


def test_ik2_elbows_mirror_joint_2() -> None:
    """The sine changes its sign: ties go upward, so within one word."""
    x, y, _ = _targets(P, 8320, 7040)
    up, down = (_answer(P, 8320, 7040, x, y, np.full(x.shape, elbow)) for elbow in (0, 1))
    assert np.array_equal(up["out_c2"], down["out_c2"])
    assert np.max(np.abs(up["out_n2"] + down["out_n2"])) <= 1


@pytest.mark.parametrize(("w", "near"), [(18, (0.42, 0.8, 1.6)), (20, (1.2, 2.2, 4.6)), (22, (0.42, 0.8, 1.6)),
                                         (24, (1.2, 2.3, 4.8))])
def test_ik2_of_wide_words_as_the_page_says(w: int, near: tuple[float, ...]) -> None:
    """Equal links that fill the coordinate: from a quarter of the reach on; to 2, 1, 1/2 % of it from the shoulder."""
    p, link = {"W": w, "F": 8, "U": w}, 1 << w - 2
    rng = np.random.default_rng(w)
    for low, high, most in ((0.25, 1, 0.8), (0.02, 0.25, 0.9), *zip((0.01, 0.005, 0.002), (0.02, 0.01, 0.005), near)):
        rho, turn = rng.uniform(low, high, 100_000) * (2 * link - 2), rng.uniform(-np.pi, np.pi, 100_000)
        x, y = (np.rint(rho * part).astype(np.int64) for part in (np.cos(turn), np.sin(turn)))
        out = _answer(p, link, link, x, y, rng.integers(0, 2, 100_000))
        tip = _tip(p, out, link, link)
        assert np.max(np.hypot(tip[0] - x, tip[1] - y)) <= most
        law = bounds.vector.ik2(p, link, link, np.hypot(x, y), _sine(link, link, x, y))
        assert np.max(law) <= (1.31 if low == 0.25 else 4.5 * most)


@pytest.mark.parametrize(("w", "u", "enough"), [
    (18, 20, 10), (19, 17, 10), (21, 20, 2), (17, 20, None), (18, 19, None), (19, 16, None)])
def test_words_for_an_arm_of_1_m(w: int, u: int, enough: int | None) -> None:
    """Total error at the tip of an arm that fills the coordinate, micrometres; None: more than 10."""
    arm = arms.parse(Path("one_metre.toml"), b"""name = "1 m"\nsource = "test"\nmm_per_unit = 7.82\n[links]
l1 = 550.0\nl2 = 450.0\n[limits]\nshoulder = [-180, 180]\nelbow = [-150, 150]""")
    core = find("vector_ik2")
    worst = accuracy.of_core.figures(at(core, core.params | {"W": w, "F": w - 8, "U": u}), arm)["total_mm"] * 1000
    assert worst <= enough if enough else worst > 10


def test_the_reciprocal_of_wide_words_never_reaches_four() -> None:
    for one in kernel_vector_wide.FORMATS[1:]:
        q = (1 << one.fraction - 2) + np.arange(1 << 16)
        for root in (0, 1):
            product = kernel_vector_wide.inverse_product(one, q, np.full(q.shape, root))
            assert np.max(product >> one.fraction - 2) < 1 << one.fraction + 1


def test_the_reciprocal_never_reaches_four() -> None:
    """1/q' and 2 / sqrt(q') next to q' = 1/4, where the register of 1/q' ends."""
    q = np.arange(1 << 23, (1 << 23) + (1 << 17))
    for root in (0, 1):
        assert np.max(kernel_vector_solve.inverse_product(q, np.full(q.shape, root)) >> 23) < 1 << 26


SPACE = {core.id: core.params for core in all_cores() if core.model_name == "vector.ik3"}
SPACE_CASES = [pytest.param(p, l1 >> 16 - p["W"], l2 >> 16 - p["W"], id=f"{name}-{l1}-{l2}")
               for name, p in SPACE.items() for l1, l2 in LINKS]


def _answer3(p: dict[str, int], l1: int, l2: int, target: np.ndarray, elbow: object) -> dict[str, np.ndarray]:
    return vector.ik3(p, **dict(zip(("in_x", "in_y", "in_z"), target)), in_elbow=elbow, cfg_l1=l1, cfg_l2=l2,
                            **kernel_vector_wide.config(p, cfg_l1=l1, cfg_l2=l2))


def _upright(p: dict[str, int], l1: int, l2: int) -> tuple[np.ndarray, np.ndarray]:
    """`_targets` in a plane that is yawed: all directions, and a third of them near the axis or a coordinate plane."""
    rho, z, elbow = _targets(p, l1, l2)
    rng = np.random.default_rng(7)
    yaw = rng.uniform(-np.pi, np.pi, rho.size)
    yaw[::3] = np.pi / 2 * rng.integers(0, 4, yaw[::3].size) + rng.normal(size=yaw[::3].size) * 1e-3
    x, y = (np.rint(rho * part).astype(np.int64) for part in (np.cos(yaw), np.sin(yaw)))
    return np.stack([x, y, z]), elbow


def _tip3(p: dict[str, int], out: dict[str, np.ndarray], l1: int, l2: int) -> np.ndarray:
    rho, z = _tip(p, out, l1, l2)
    return np.stack([rho * out["out_c3"] / 2 ** p["U"], rho * out["out_n3"] / 2 ** p["U"], z])


@pytest.mark.parametrize(("p", "l1", "l2"), SPACE_CASES)
def test_ik3_puts_the_tip_within_its_bound(p: dict[str, int], l1: int, l2: int) -> None:
    target, elbow = _upright(p, l1, l2)
    q = (target * target).sum(axis=0)
    keep = (q > 0) & (q <= (l1 + l2) ** 2) & (q >= (l1 - l2) ** 2) & (target[:2] != 0).any(axis=0)
    target, elbow, q = target[:, keep], elbow[keep], q[keep]
    out, long = _answer3(p, l1, l2, target, elbow), np.sqrt(q)
    missed, mistaken = bounds.vector.reach(p, l1, l2, target)
    edge = (q > (l1 + l2) ** 2 - mistaken) | (q < (l1 - l2) ** 2 + mistaken)
    assert not out["out_status"][~edge].any()
    n2 = np.sqrt(((l1 + l2) ** 2 - q) * (q - (l1 - l2) ** 2.0)) / max(2 * l1 * l2, 1)
    error = np.linalg.norm(_tip3(p, out, l1, l2) - target, axis=0)
    answered = out["out_status"] == 0
    assert np.all((error <= bounds.vector.ik3(p, l1, l2, target, n2))[answered])
    if p["W"] == 16 and l1 + l2 <= 16384:  # 64 units of Q7.8, rounding of the six words included
        assert np.max(error[long >= 256], initial=0) <= 0.75
    assert np.all(out["out_n2"] * (1 - 2 * elbow) >= 0)
    yaw = np.abs(np.hypot(out["out_c3"], out["out_n3"]) - (1 << p["U"]))
    assert np.max(yaw, initial=0) <= 1.2
    off = np.abs(target[0] * out["out_n3"] - target[1] * out["out_c3"]) / np.hypot(*target[:2])
    assert np.max(off, initial=0) <= np.sqrt(0.5) + 2.0 ** (p["U"] - 19)
    assert np.all(target[0] * out["out_c3"] + target[1] * out["out_n3"] > 0)


def test_ik3_far_and_near_are_flagged_in_space() -> None:
    rng = np.random.default_rng(9)
    target, elbow = rng.integers(-32768, 32768, (3, 60_000)), rng.integers(0, 2, 60_000)
    target[:, :20_000] >>= rng.integers(1, 16, 20_000)
    for l1, l2 in ((8192, 8192), (12000, 4384), (4384, 12000), (300, 200)):
        q, (missed, mistaken) = (target * target).sum(axis=0), bounds.vector.reach(P, l1, l2, target)
        far, near = (l1 + l2) ** 2, (l1 - l2) ** 2
        flag = _answer3(P, l1, l2, target, elbow)["out_status"] & 1 > 0
        assert np.all(flag[(q > far + missed) | (q < near - missed)])
        assert not flag[(q < far - mistaken) & (q > near + mistaken)].any()


def test_ik3_holds_the_yaw_on_its_axis() -> None:
    x, z = np.array([0, 0, 5000, 0, 0, -7, 0]), np.array([0, 3000, 100, 0, 9000, 0, 0])
    out = _answer3(P, 8192, 8192, np.stack([x, 2 * x, z]), np.zeros(7, dtype=np.int64))
    assert out["out_status"].tolist() == [2, 2, 0, 2, 2, 0, 2]
    assert (out["out_c3"][:2] == 65536).all() and not out["out_n3"][:2].any() and out["out_c1"][0] == 65536
    for name in ("out_c3", "out_n3"):
        assert out[name][3] == out[name][4] == out[name][2] and out[name][6] == out[name][5]
    for name in ("out_c1", "out_n1"):
        assert out[name][3] == out[name][2] and out[name][6] == out[name][5]
    assert np.allclose(_tip(P, out, 8192, 8192)[1][[1, 4]], [3000, 9000], atol=0.5)


def test_rho_and_the_yaw_are_within_their_bounds() -> None:
    rng = np.random.default_rng(3)
    target = rng.integers(-32768, 32768, (2, 200_000)) >> rng.integers(0, 16, 200_000)
    target = target[:, (target != 0).any(axis=0)]
    exact = np.hypot(*target)
    b, a, r, rho = kernel_vector_solve.yaw(*target)
    assert np.all(np.abs(rho / 16 - exact) <= bounds.vector.radius(P, target))
    c3, n3, (length, turned) = b * r / 2**49, a * r / 2**49, bounds.vector.yaw(exact)
    assert np.all(np.abs(np.hypot(c3, n3) - 1) <= length)
    assert np.all(np.abs(target[0] * n3 - target[1] * c3) / exact <= turned)
