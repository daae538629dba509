"""Models of the vector cores against float64: bounds, flags, ties, length of the words, held words."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from quadrance import (
    accuracy,
    arith,
    arms,
    bounds,
    codecs,
    cores,
    kernel_vector_solve,
    kernel_vector_wide,
    truth,
    vector,
)
from quadrance.cores import Core, at, find, joints

from models.test.claims import distinct

# One joint, and forward, at every listed set


def listed(*functions: str) -> pytest.MarkDecorator:
    """Every set of every vector core of these functions."""
    found = [core for core in distinct() if core.family == "vector" and core.function in functions]
    assert len(found) >= 2 * len(functions)
    return pytest.mark.parametrize("core", found, ids=lambda core: core.id)


def turned(core: Core, inputs: dict[str, np.ndarray], l1: int, l2: int) -> np.ndarray:
    """Tip (2 or 3, N) in LSB of the vectors as the words hold them, whatever their lengths."""
    one = 2.0 ** core.params["U"]
    v = [(inputs[c.name] + 1j * inputs[n.name]) / one for c, n in joints(core.inputs)]
    if len(v) == 1:
        return np.stack([l1 * v[0].real, l1 * v[0].imag])
    plane = v[0] * (l1 + l2 * v[1])
    if len(v) == 2:
        return np.stack([plane.real, plane.imag])
    return np.stack([plane.real * v[2].real, plane.real * v[2].imag, plane.imag])


def directions(core: Core, rng: np.random.Generator, count: int = 40_000) -> dict[str, np.ndarray]:
    """Unit vectors as words: anywhere, and half of them at the borders."""
    words: dict[str, np.ndarray] = {}
    for joint in joints(core.inputs):
        some, border = codecs.encode(joint, rng.uniform(-np.pi, np.pi, count)), codecs.border_words(joint)
        pick, near = rng.integers(0, border[joint[0].name].size, count), rng.random(count) < 0.5
        words |= {name: np.where(near, border[name][pick], some[name]) for name in some}
    return words


def run(core: Core, inputs: dict[str, np.ndarray], l1: int, l2: int) -> tuple[np.ndarray, np.ndarray]:
    """Coordinates (2 or 3, N) and status."""
    answer = core.model(core.params, **inputs, **accuracy.configure(core, cfg_l1=l1, cfg_l2=l2))
    return np.stack([answer[port.name] for port in core.outputs[:-1]]), answer["out_status"]


def lengths(core: Core) -> list[tuple[int, int]]:
    """Link lengths that together fill a coordinate and do not overflow."""
    reach = (1 << core.params["W"] - 1) - 2
    return [(reach // 2, reach - reach // 2), (reach - 1, 1), (1, reach - 1), (reach, 0), (0, reach), (0, 0),
            (reach // 3, reach // 7)]


# Forward


@listed("fk1")
def test_one_joint_is_to_nearest(core):
    """Ties go upward, at any length of the vector; what does not fit is the nearest word, and flagged."""
    rng, u, w = np.random.default_rng(1), core.params["U"], core.params["W"]
    inputs = {port.name: rng.integers(port.low, port.high, 40_000, endpoint=True) for port in core.inputs}
    half = {name: np.append(words, (1 << u - 1) * np.array([1, -1, 3, -3])) for name, words in inputs.items()}
    for l1 in (1, 3, (1 << w) - 1, 1 << w - 1, 1000):
        tip, status = run(core, half, l1, 0)
        exact = np.floor(turned(core, half, l1, 0) + 0.5)
        high = 1 << w - 1
        assert np.array_equal(tip, np.clip(exact, -high, high - 1))
        assert np.array_equal(status, 4 * np.any((exact < -high) | (exact >= high), axis=0))


@listed("fk2", "fk3")
def test_coordinates_are_within_their_bound(core):
    count, off = len(joints(core.inputs)), np.sqrt(0.5) * 2.0 ** -core.params["U"]
    worst = 0.0
    for l1, l2 in lengths(core):
        inputs = directions(core, np.random.default_rng(2))
        tip, status = run(core, inputs, l1, l2)
        exact = turned(core, inputs, l1, l2)
        clear = np.all(np.abs(exact) < (1 << core.params["W"] - 1) - 2, axis=0)  # a rounded vector may be longer than 1
        assert not status[clear].any() and clear.mean() > 0.5
        error = np.abs(tip - exact)[:, clear]
        assert error.max() <= bounds.vector.chain(count, 1 + off)
        worst = max(worst, error.max())
    assert worst > 0.5


@listed("fk1", "fk2", "fk3")
def test_the_tip_is_that_of_the_directions(core):
    count = len(joints(core.inputs))
    for l1, l2 in lengths(core):
        l1, l2 = l1 // 2, l2 // 2
        inputs = directions(core, np.random.default_rng(3))
        tip, status = run(core, inputs, l1, l2)
        theta = [codecs.decode(joint, inputs) for joint in joints(core.inputs)]
        exact = truth.fk1(*theta, l1) if count == 1 else (truth.fk2 if count == 2 else truth.fk3)(*theta, l1, l2)
        assert not status.any()
        assert np.linalg.norm(tip - np.stack(exact), axis=0).max() <= bounds.vector.tip(core.params, count, l1, l2)


@listed("fk2", "fk3")
def test_vectors_of_other_lengths_scale_the_tip(core):
    """To the end of the range, (L1 + L2 |v2|) |v1| |v3| below 2^(W + 1); what does not fit is flagged."""
    rng, high = np.random.default_rng(4), 1 << core.params["W"] - 1
    inputs = {port.name: rng.integers(port.low, port.high, 60_000, endpoint=True) for port in core.inputs}
    size = [np.hypot(*(inputs[port.name] / 2.0 ** core.params["U"] for port in joint)) for joint in joints(core.inputs)]
    seen = 0
    for l1, l2 in ((high // 2, high // 2), (high, high), (high // 9, high // 5)):
        plane = (l1 + l2 * size[1]) * size[0]
        inside = plane * np.maximum(1, size[2] if len(size) > 2 else 1) < 4 * high - 8
        tip, status = run(core, inputs, l1, l2)
        exact = turned(core, inputs, l1, l2)
        error = np.abs(tip - np.clip(exact, -high, high - 1))[:, inside]
        assert error.max() <= bounds.vector.chain(len(size), 2 * np.sqrt(2))
        sure = inside & np.all(np.abs(np.abs(exact) - high) > 2, axis=0)
        assert np.array_equal(status[sure] == 4, np.any((exact < -high) | (exact >= high), axis=0)[sure])
        seen += np.count_nonzero(status[sure])
    assert seen > 1000


# Inverse


def scales(core: Core, x: np.ndarray, y: np.ndarray, answer: dict[str, np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """The lengths of vectors along (x, y) that round to the answer: from the first to the second."""
    one, away = 2.0 ** core.params["U"], np.hypot(x, y)
    low, high = np.zeros(x.shape), np.full(x.shape, np.inf)
    for part, word in ((x / away * one, answer["out_c1"]), (y / away * one, answer["out_n1"])):
        none = part == 0
        assert np.all(word[none] == 0)
        ends = np.sort([(word + half) / np.where(none, 1, part) for half in (-0.5, 0.5)], axis=0)
        low, high = np.where(none, low, np.maximum(low, ends[0])), np.where(none, high, np.minimum(high, ends[1]))
    return low, high


@listed("ik1")
def test_the_direction_is_exact_and_the_length_within_its_bound(core):
    """Every answer is a vector exactly along (x, y), rounded; on the way, every redundant sign bit."""
    rng, w = np.random.default_rng(5), core.params["W"]
    x, y = (rng.integers(-1 << w - 1, 1 << w - 1, 200_000) >> rng.integers(0, w, 200_000) for _ in "xy")
    if w == 8:
        x, y = (grid.ravel() for grid in np.meshgrid(np.arange(-128, 128), np.arange(-128, 128)))
    least, most = -(1 << w - 1), (1 << w - 1) - 1
    x, y = np.append(x, [least, least, most, least, 1, -1]), np.append(y, [least, most, most, 0, 1, -1])
    x, y = x[(x != 0) | (y != 0)], y[(x != 0) | (y != 0)]
    answer = core.model(core.params, in_x=x, in_y=y)
    low, high = scales(core, x, y, answer)
    tight, bound = 1e-9, bounds.vector.length(kernel_vector_wide.form(core.params))
    assert np.all(low <= high + tight)
    assert np.all(low <= 1 + bound + tight) and np.all(high >= 1 - bound - tight)
    theta = np.arctan2(y, x)
    assert truth.difference(codecs.within_cell(core.outputs[:2], answer, theta), theta) == pytest.approx(0, abs=1e-9)
    assert not answer["out_status"].any()


@listed("ik1")
def test_axes_and_diagonals(core):
    """On an axis one word is 0 and the other 1.0 within an LSB; on a diagonal both are equal."""
    one, high = 1 << core.params["U"], (1 << core.params["W"] - 1) - 1
    length = np.unique(np.geomspace(1, high, 1 << 16).astype(np.int64)) if high >> 15 else np.arange(1, high + 1)
    for k, (c, n) in enumerate([(1, 0), (0, 1), (-1, 0), (0, -1)]):
        answer = core.model(core.params, in_x=c * length, in_y=n * length)
        assert np.abs(answer["out_c1"] - c * one).max() <= abs(c), k
        assert np.abs(answer["out_n1"] - n * one).max() <= abs(n), k
    both = core.model(core.params, in_x=length, in_y=length)
    assert np.array_equal(both["out_c1"], both["out_n1"])


@listed("ik1")
def test_the_last_vector_is_held_where_there_is_no_direction(core):
    one = 1 << core.params["U"]
    answer = core.model(core.params, in_x=np.array([0, 0, 0, -5, 0]), in_y=np.array([0, 7, 0, 0, 0]))
    assert answer["out_c1"].tolist()[:3] == [one, 0, 0] and answer["out_c1"][4] == answer["out_c1"][3] < 0
    assert answer["out_n1"][0] == 0 and answer["out_n1"][2] == answer["out_n1"][1] > 0 and answer["out_n1"][4] == 0
    assert answer["out_status"].tolist() == [2, 0, 2, 0, 2]


def test_reciprocal_root_at_every_word():
    """Within its share of the length's bound: all but what the squares lose."""
    q = np.arange(1 << 16, (1 << 19) + 2)
    relative = arith.reciprocal_root(q) / 2.0**19 * np.sqrt(q / 2.0**18) - 1
    assert np.abs(relative).max() <= bounds.vector.length()


@pytest.mark.parametrize("name", arms.known())
def test_one_joint_there_and_back(name):
    """fk1 of ik1 is the target, on its circle: half an LSB of the tip, half an LSB of the words, the length."""
    forward, inverse = cores.find("vector_fk1"), cores.find("vector_ik1")
    l1 = min(round(256 * arms.load(name).links[0]), 1 << 14)
    theta = np.random.default_rng(6).uniform(-np.pi, np.pi, 10_000)
    x, y = (np.rint(l1 * part).astype(np.int64) for part in truth.unit(theta))
    words = inverse.model(inverse.params, in_x=x, in_y=y)
    tip, status = run(forward, {"in_c1": words["out_c1"], "in_n1": words["out_n1"]}, l1, 0)
    away = np.abs(np.hypot(x, y) - l1)
    off = np.hypot(*(tip - np.stack([x, y]))) - away
    assert not status.any()
    assert off.max() <= np.sqrt(0.5) + l1 * (np.sqrt(0.5) * 2.0**-16 + bounds.vector.length())


# Inverse of two and three joints

LINKS = [(8192, 8192), (8320, 7040), (12000, 4384), (4384, 12000), (16000, 300), (300, 16000), (768, 512), (30, 20),
         (5, 2), (1, 1), (100, 100), (16384, 16384), (30000, 2000), (20000, 25000), (60000, 60000)]
SETS = {core.id: core.params for core in distinct() if core.model_name == "vector.ik2"}
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


def test_the_laws_of_long_words_are_those_of_the_page() -> None:
    """Equal links that fill the coordinate, W = U, from a quarter of the reach on; all pitches of the plane."""
    worst = []
    for w in (20, 24):
        p, length = {"W": w, "F": 8, "U": w}, 1 << w - 2
        half, pitch = np.meshgrid(np.linspace(0, np.arccos(0.25), 400), np.linspace(0, np.pi / 2, 60))
        away, n2 = 2 * length * np.cos(half.ravel()), np.abs(np.sin(2 * half.ravel()))
        target = np.stack([away * np.cos(pitch.ravel()), 0 * away, away * np.sin(pitch.ravel())])
        worst.append([bounds.vector.ik2(p, length, length, away, n2).max(),
                      bounds.vector.ik3(p, length, length, target, n2).max()])
    page = (cores.RTL / "vector" / "README.md").read_text()
    assert "at most 1.9 LSB from a quarter of the reach on, 3.7 LSB for vector_ik3" in page
    assert np.max(worst, axis=0).round(1).tolist() == [1.9, 3.7]


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


SPACE = {core.id: core.params for core in distinct() if core.model_name == "vector.ik3"}
SPACE_CASES = [pytest.param(p, *((length << p["W"]) >> 16 for length in pair), id=f"{name}-{pair[0]}-{pair[1]}")
               for name, p in (SPACE | {"short": SHORT}).items() for pair in LINKS]
WIDE = [{"W": 20, "F": 12, "U": 20}, {"W": 22, "F": 14, "U": 21}, {"W": 24, "F": 16, "U": 24}]


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
    f, rho = kernel_vector_wide.form(p), np.hypot(*target[:2])
    length, turned = (part * 2.0 ** p["U"] + np.sqrt(0.5)
                      for part in bounds.vector.yaw(rho * 2.0 ** (f.bits - p["W"]), f))
    yaw = np.abs(np.hypot(out["out_c3"], out["out_n3"]) - (1 << p["U"]))
    assert np.all(yaw <= length)
    if p["W"] <= 16:
        assert np.max(yaw, initial=0) <= 1.2
    off = np.abs(target[0] * (out["out_n3"] / rho) - target[1] * (out["out_c3"] / rho))
    assert np.all(off <= turned)
    assert np.all(target[0] * out["out_c3"] + target[1] * out["out_n3"] > 0)


@pytest.mark.parametrize("p", [P, *WIDE], ids=lambda p: f"W{p['W']}")
def test_ik3_far_and_near_are_flagged_in_space(p: dict[str, int]) -> None:
    rng, high, more = np.random.default_rng(9), 1 << p["W"] - 1, p["W"] - 16
    target, elbow = rng.integers(-high, high, (3, 60_000)), rng.integers(0, 2, 60_000)
    target[:, :20_000] >>= rng.integers(1, p["W"], 20_000)
    for l1, l2 in ((8192 << more, 8192 << more), (12000 << more, 4384 << more), (4384, 12000 << more), (300, 200)):
        q, (missed, mistaken) = (target * target).sum(axis=0), bounds.vector.reach(p, l1, l2, target)
        far, near = (l1 + l2) ** 2, (l1 - l2) ** 2
        flag = _answer3(p, l1, l2, target, elbow)["out_status"] & 1 > 0
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


@pytest.mark.parametrize("p", WIDE, ids=lambda p: f"W{p['W']}")
def test_rho_and_the_yaw_of_wide_words_are_within_their_bounds(p: dict[str, int]) -> None:
    rng, high, f = np.random.default_rng(3), 1 << p["W"] - 1, kernel_vector_wide.form(p)
    target = rng.integers(-high, high, (2, 200_000)) >> rng.integers(0, p["W"], 200_000)
    target = target[:, (target != 0).any(axis=0)]
    exact, unit = np.hypot(*target), 2.0 ** (f.bits - p["W"])
    c3, n3, rho = kernel_vector_wide.yaw(f, *(target << f.bits - p["W"]))
    assert np.all(np.abs(rho / 16 / unit - exact) <= bounds.vector.radius(p, target))
    c3, n3, (length, turned) = *(word / 2.0 ** (2 * f.fraction - 1) for word in (c3, n3)), bounds.vector.yaw(
        exact * unit, f)
    assert np.all(np.abs(np.hypot(c3, n3) - 1) <= length)
    assert np.all(np.abs(target[0] * n3 - target[1] * c3) / exact <= turned)
    assert np.max(np.abs(np.hypot(c3, n3) - 1) / length) > 0.4  # a law that means something

