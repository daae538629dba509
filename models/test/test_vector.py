"""Models of the vector cores against float64, at every listed set: bounds, flags, ties, holds."""

from __future__ import annotations

import numpy as np
import pytest
from quadrance import accuracy, arith, arms, bounds, codecs, cores, truth
from quadrance.cores import Core, joints


def listed(*functions: str) -> pytest.MarkDecorator:
    """Every set of every vector core of these functions."""
    found = [core for core in cores.all_cores() if core.family == "vector" and core.function in functions]
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
    tight, bound = 1e-9, bounds.vector.length()
    assert np.all(low <= high + tight)
    assert np.all(low <= 1 + bound + tight) and np.all(high >= 1 - bound - tight)
    theta = np.arctan2(y, x)
    assert truth.difference(codecs.within_cell(core.outputs[:2], answer, theta), theta) == pytest.approx(0, abs=1e-9)
    assert not answer["out_status"].any()


@listed("ik1")
def test_axes_and_diagonals(core):
    """On an axis one word is 0 and the other 1.0 within an LSB; on a diagonal both are equal."""
    one, length = 1 << core.params["U"], np.arange(1, 1 << core.params["W"] - 1)
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
