"""rational_* models against float64, one joint and forward: derived error bounds, borders, symmetries, status."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from quadrance import arith, bounds, codecs, rational, truth
from quadrance.cores import Port

ONE = {"W": 16, "F": 8, "S": 24}
LENGTHS = (1, 100, 4095, 8320, 11111, 16383, 16384)  # LSB; 16384 is 64 units of Q7.8


# One joint


def _words(s: int) -> np.ndarray:
    """Every word of a format up to 16 bits of spread; else both ends and middle of every table segment, and a rest."""
    if s <= 16:
        return np.arange(4 << s)
    edges = [np.arange(arith.SEGMENTS)[:, None] << width for width in arith.SEGMENT_BITS]
    near = np.concatenate([edge + (np.array([0, 1, 2, 3]) << width >> 1) + step
                           for edge, width in zip(edges, arith.SEGMENT_BITS) for step in (-1, 0, 1)], axis=None)
    rest = np.random.default_rng(2).integers(0, 1 << s, 30000)
    spread = np.concatenate([near, -near, rest]) & (1 << s) - 1
    return np.unique(np.arange(4)[:, None] * (1 << s) + spread)


@pytest.mark.parametrize("s", [8, 16, 24])
@pytest.mark.parametrize("length", LENGTHS)
def test_fk1_error(s, length):
    word = _words(s)
    answer = rational.fk1(ONE | {"S": s}, in_j1=word, cfg_l1=length)
    x, y = truth.fk1(truth.spread_word_to_angle(word, s), length)
    dx, dy = answer["out_x"] - x, answer["out_y"] - y
    assert max(np.abs(dx).max(), np.abs(dy).max()) <= bounds.rational.fk1(length)
    assert np.hypot(dx, dy).max() <= 1.0
    assert not answer["out_status"].any()


def test_fk1_is_exact_on_every_border():
    """Spread 0 gives the whole length and nothing, from either side of the border."""
    length = np.arange(1 << 15)
    for k, (c, n) in enumerate([(1, 0), (0, 1), (-1, 0), (0, -1)]):
        answer = rational.fk1(ONE, in_j1=np.full(length.shape, k << 24), cfg_l1=length)
        assert (answer["out_x"] == c * length).all() and (answer["out_y"] == n * length).all()


@pytest.mark.parametrize("length", LENGTHS)
def test_fk1_never_steps_back_by_more_than_one_lsb(length):
    """Segments of the table join within 0.84 / 2^15, so the rounded coordinates within one LSB."""
    word = _words(24)
    answer = rational.fk1(ONE, in_j1=word, cfg_l1=length)
    quadrant = word >> 24
    for k, (rise_x, rise_y) in enumerate([(-1, 1), (-1, -1), (1, -1), (1, 1)]):
        here = quadrant == k
        assert (np.diff(answer["out_x"][here]) * rise_x).min() >= -1
        assert (np.diff(answer["out_y"][here]) * rise_y).min() >= -1


@given(st.integers(0, (4 << 24) - 1), st.integers(0, 65535))
def test_fk1_half_a_turn_negates(word, length):
    opposite = word + (2 << 24) & (4 << 24) - 1
    here, there = (rational.fk1(ONE, in_j1=np.array([w]), cfg_l1=length) for w in (word, opposite))
    saturated = here["out_status"] | there["out_status"]
    for port in ("out_x", "out_y"):  # ties go upward, and -32768 has no opposite: one LSB at most
        assert saturated[0] or abs(int(here[port][0]) + int(there[port][0])) <= 1


def test_fk1_saturates_with_a_flag():
    word = _words(24)
    answer = rational.fk1(ONE, in_j1=word, cfg_l1=65535)
    x, y = truth.fk1(truth.spread_word_to_angle(word, 24), 65535)
    away = bounds.rational.fk1(65535)
    for port, exact in (("out_x", x), ("out_y", y)):
        assert (np.abs(answer[port] - np.clip(exact, -32768, 32767)) <= away).all()
    outside = np.maximum.reduce([x - 32767, -32768 - x, y - 32767, -32768 - y])
    assert (answer["out_status"][outside > away] == 4).all()
    assert (answer["out_status"][outside < -away] == 0).all()


def _cell_error(x: np.ndarray, y: np.ndarray, word: np.ndarray, s: int) -> np.ndarray:
    """Angle (rad) from (x, y) to the nearest direction that rounds to `word`."""
    theta = np.arctan2(y, x)
    within = codecs.within_cell((Port("j", 2 + s, False, "spread"),), {"j": word}, theta)
    return np.abs(truth.difference(within, theta))


@pytest.mark.parametrize("s", [8, 16, 24])
def test_ik1_error(s):
    rng = np.random.default_rng(4)
    angle, size = rng.uniform(-np.pi, np.pi, 200000), np.exp(rng.uniform(0, np.log(46000), 200000))
    x, y = (np.clip(np.round(size * f(angle)), -32768, 32767).astype(np.int64) for f in (np.cos, np.sin))
    x[:50000] = rng.integers(-90, 91, 50000)  # near the border, where the spread is flat
    keep = (x != 0) | (y != 0)
    x, y = x[keep], y[keep]
    word = rational.ik1(ONE | {"S": s}, in_x=x, in_y=y)["out_j1"]
    assert _cell_error(x, y, word, s).max() <= bounds.rational.DIRECTION


def test_ik1_error_of_every_short_point():
    x, y = (grid.ravel() for grid in np.meshgrid(np.arange(-128, 128), np.arange(-128, 128)))
    answer = rational.ik1({"W": 8, "F": 4, "S": 24}, in_x=x, in_y=y)
    zero = (x == 0) & (y == 0)
    assert (answer["out_status"] == np.where(zero, 2, 0)).all()
    assert _cell_error(x[~zero], y[~zero], answer["out_j1"][~zero], 24).max() <= bounds.rational.DIRECTION


def test_ik1_error_first_words_past_the_borders():
    """Every m up to 40 beside every long coordinate: here one spread LSB is most of an LSB of the tip."""
    m, long = (grid.ravel() for grid in np.meshgrid(np.arange(-40, 41), np.arange(8192, 32768, 7)))
    for x, y in ((long, m), (m, long), (-long, m), (m, -long)):
        word = rational.ik1(ONE, in_x=x, in_y=y)["out_j1"]
        assert _cell_error(x, y, word, 24).max() <= bounds.rational.DIRECTION


def test_ik1_is_exact_on_every_axis():
    length = np.arange(1, 1 << 15)
    for k, (c, n) in enumerate([(1, 0), (0, 1), (-1, 0), (0, -1)]):
        assert (rational.ik1(ONE, in_x=c * length, in_y=n * length)["out_j1"] == k << 24).all()
    corner = rational.ik1(ONE, in_x=np.array([-32768, -1, 32767]), in_y=np.array([-32768, -1, 32767]))["out_j1"]
    assert corner[:2].tolist() == [(2 << 24) + (1 << 23)] * 2


@given(st.integers(-8191, 8191), st.integers(-8191, 8191), st.integers(1, 2))
def test_ik1_depends_on_the_direction_alone(x, y, shift):
    short, long = (rational.ik1(ONE, in_x=np.array([x << k]), in_y=np.array([y << k])) for k in (0, shift))
    assert short["out_j1"] == long["out_j1"] and short["out_status"] == long["out_status"]


def test_ik1_holds_the_last_word_where_there_is_no_direction():
    answer = rational.ik1(ONE, in_x=np.array([0, 0, 0, -5, 0]), in_y=np.array([0, 7, 0, 0, 0]))
    assert answer["out_j1"].tolist() == [0, 1 << 24, 1 << 24, 2 << 24, 2 << 24]
    assert answer["out_status"].tolist() == [2, 0, 2, 0, 2]


@pytest.mark.parametrize("length", LENGTHS[3:])
def test_one_joint_there_and_back(length):
    """ik1 of fk1 returns the direction within both bounds: the tip's distance, 1 LSB, and ik1's own."""
    word = _words(24)
    tip = rational.fk1(ONE, in_j1=word, cfg_l1=length)
    back = rational.ik1(ONE, in_x=tip["out_x"], in_y=tip["out_y"])["out_j1"]
    turned = _cell_error(*truth.fk1(truth.spread_word_to_angle(word, 24), length), back, 24)
    assert turned.max() <= 1.0 / (length - 1) + bounds.rational.DIRECTION


# Two and three joints

ARM = {"W": 16, "F": 8, "S": 24, "U": 16}
FINE = {"W": 16, "F": 8, "S": 28, "U": 17}
LINKS = [(8192, 8192), (8320, 7040), (12000, 4384), (4384, 12000), (16384, 0), (0, 16384), (768, 512), (1, 1)]


def _angles(rng: np.random.Generator, s: int, count: int) -> np.ndarray:
    """Uniform words, and words about every quadrant border at every scale of the spread."""
    words = rng.integers(0, 4 << s, count)
    near = rng.integers(0, 1 << s, count // 2) >> rng.integers(0, s, count // 2)
    words[::2] = (rng.integers(0, 4, count // 2) << s) + rng.choice([-1, 1], count // 2) * near
    return words & (4 << s) - 1


@pytest.mark.parametrize("p", [ARM, FINE], ids=["S24", "S28U17"])
def test_roots_are_within_their_bound_in_every_quadrant(p: dict[str, int]) -> None:
    borders = (np.arange(4)[:, None] * (1 << p["S"]) + np.arange(-4096, 4096)).ravel() & (4 << p["S"]) - 1
    words = np.append(_angles(np.random.default_rng(1), p["S"], 200_000), borders)
    theta = truth.spread_word_to_angle(words, p["S"])
    for root, exact in zip(codecs.spread_chords(p, words), truth.unit(theta)):
        assert np.max(np.abs(root / 2.0 ** (p["U"] + 1) - exact)) * 2.0 ** p["U"] <= bounds.codec.spread_chord(p["U"])


@pytest.mark.parametrize(("l1", "l2"), LINKS)
def test_fk2_is_within_its_bound(l1: int, l2: int) -> None:
    rng = np.random.default_rng(2)
    j1, j2 = _angles(rng, ARM["S"], 100_000), _angles(rng, ARM["S"], 100_000)
    out = rational.fk2(ARM, in_j1=j1, in_j2=j2, cfg_l1=l1, cfg_l2=l2)
    exact = truth.fk2(*(truth.spread_word_to_angle(j, ARM["S"]) for j in (j1, j2)), l1, l2)
    error = [out[f"out_{axis}"] - value for axis, value in zip("xy", exact)]
    assert np.max(np.abs(error)) <= min(bounds.rational.chain(ARM, 2, l1, l2), 0.85)
    assert np.max(np.hypot(*error)) <= 1.02
    assert not out["out_status"].any()


@pytest.mark.parametrize(("l1", "l2"), LINKS)
def test_fk3_is_within_its_bound(l1: int, l2: int) -> None:
    rng = np.random.default_rng(3)
    words = [_angles(rng, ARM["S"], 100_000) for _ in range(3)]
    out = rational.fk3(ARM, in_j1=words[0], in_j2=words[1], in_j3=words[2], cfg_l1=l1, cfg_l2=l2)
    exact = truth.fk3(*(truth.spread_word_to_angle(j, ARM["S"]) for j in words), l1, l2)
    error = [out[f"out_{axis}"] - value for axis, value in zip("xyz", exact)]
    assert np.max(np.abs(error)) <= min(bounds.rational.chain(ARM, 3, l1, l2), 1.0)
    assert not out["out_status"].any()


def test_overflow_is_flagged_exactly_where_a_coordinate_leaves_the_word() -> None:
    rng = np.random.default_rng(4)
    words = [_angles(rng, ARM["S"], 50_000) for _ in range(3)]
    out = rational.fk3(ARM, in_j1=words[0], in_j2=words[1], in_j3=words[2], cfg_l1=40_000, cfg_l2=30_000)
    exact = np.array(truth.fk3(*(truth.spread_word_to_angle(j, ARM["S"]) for j in words), 40_000, 30_000))
    bound = bounds.rational.chain(ARM, 3, 40_000, 30_000)
    beyond = np.max(np.maximum(exact - 32767.5, -32768.5 - exact), axis=0)  # what rounds to a word that is too long
    told = np.abs(beyond) > bound - 0.5
    assert np.array_equal((out["out_status"] == 4)[told], (beyond > 0)[told])
    for axis, value in zip("xyz", exact):
        assert np.max(np.abs(out[f"out_{axis}"] - np.clip(value, -32768, 32767))) <= bound
