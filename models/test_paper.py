"""The paper family against the float64 truth: bounds of rtl/paper/README.md, borders, holds, saturation."""

from __future__ import annotations

import numpy as np
import pytest
from quadrance import paper, truth

SETS = [{"W": 16, "F": 8, "S": s} for s in (8, 24)]
OVERFLOW, SINGULAR = 4, 2


def words(p: dict[str, int], rng: np.random.Generator, count: int) -> np.ndarray:
    """Joint words: uniform, and each border with its neighbours."""
    near = (np.arange(4)[:, None] << p["S"]) + np.arange(-40, 41)
    return np.concatenate([near.ravel(), rng.integers(0, 4 << p["S"], count)]) % (4 << p["S"])


@pytest.mark.parametrize("p", SETS, ids=lambda p: f"S{p['S']}")
def test_fk1_is_the_nearest_word(p):
    rng = np.random.default_rng(1)
    joint = words(p, rng, 20_000)
    length = rng.integers(0, 1 << 15, joint.size)
    out = paper.fk1(p, in_j1=joint, cfg_l1=length)
    for axis, exact in zip("xy", truth.fk1(truth.spread_word_to_angle(joint, p["S"]), length)):
        assert np.max(np.abs(out[f"out_{axis}"] - exact)) <= 0.5 + 1e-9
    assert not np.any(out["out_status"][length < (1 << 15) - 1])


@pytest.mark.parametrize("p", SETS, ids=lambda p: f"S{p['S']}")
def test_fk1_saturates_and_says_so(p):
    border = np.arange(4) << p["S"]
    out = paper.fk1(p, in_j1=border, cfg_l1=(1 << 16) - 1)
    assert np.array_equal(out["out_x"], [32767, 0, -32767, 0]) and np.array_equal(out["out_y"], [0, 32767, 0, -32767])
    assert np.all(out["out_status"] == OVERFLOW)
    assert not np.any(paper.fk1(p, in_j1=border, cfg_l1=(1 << 15) - 1)["out_status"])


@pytest.mark.parametrize("p", SETS, ids=lambda p: f"S{p['S']}")
def test_ik1_is_the_nearest_word(p):
    rng = np.random.default_rng(2)
    x, y = (rng.integers(-(1 << 15), 1 << 15, 20_000) >> rng.integers(0, 16, 20_000) for _ in "xy")
    exact = truth.angle_to_spread(truth.ik1(x, y), p["S"])
    out = paper.ik1(p, in_x=x, in_y=y)
    seen = (x != 0) | (y != 0)
    error = np.mod(out["out_j1"] - exact + (2 << p["S"]), 4 << p["S"]) - (2 << p["S"])
    assert np.max(np.abs(error[seen])) <= 0.5 + 2.0 ** (p["S"] - 40)
    assert np.array_equal(out["out_status"] == SINGULAR, ~seen) and not np.all(seen)


@pytest.mark.parametrize("p", SETS, ids=lambda p: f"S{p['S']}")
def test_ik1_axes_are_the_quadrant_borders(p):
    out = paper.ik1(p, in_x=np.array([5, 0, -5, 0, 32767, -32768]), in_y=np.array([0, 5, 0, -5, -1, 0]))
    border = np.array([0, 1, 2, 3, 0, 2]) << p["S"]  # the fifth is 2^-30 of spread before the full turn
    assert np.array_equal(out["out_j1"], border)


def test_ik1_holds_the_last_word_at_the_origin():
    out = paper.ik1(SETS[0], in_x=np.array([0, 3, 0, 0, -3]), in_y=np.array([0, 3, 0, 0, 3]))
    assert out["out_j1"].tolist() == [0, 128, 128, 128, 384]
    assert out["out_status"].tolist() == [SINGULAR, 0, SINGULAR, SINGULAR, 0]


def test_ik1_undoes_fk1_within_the_resolution():
    p = SETS[1]
    joint = np.arange(0, 4 << 24, 99_991)
    tip = paper.fk1(p, in_j1=joint, cfg_l1=64 << 8)
    back = paper.ik1(p, in_x=tip["out_x"], in_y=tip["out_y"])["out_j1"]
    turn = truth.difference(truth.spread_word_to_angle(back, 24), truth.spread_word_to_angle(joint, 24))
    # half an LSB in x and in y seen from 64 units, and the word's own resolution at a border, asin(2^-12.5)
    assert np.max(np.abs(turn)) <= np.hypot(0.5, 0.5) / (64 << 8) * 1.001 + np.arcsin(2.0**-12.5)


def test_what_eight_fraction_bits_cost():
    """The paper's word: 3.58 degrees between the first two joint words, 2.53 degrees of rounding at worst."""
    step = np.degrees(truth.spread_word_to_angle(1, 8) - truth.spread_word_to_angle(0, 8))
    worst = np.degrees(truth.spread_word_to_angle(0.5, 8) - truth.spread_word_to_angle(0, 8))
    assert (round(step, 2), round(worst, 2)) == (3.58, 2.53)
