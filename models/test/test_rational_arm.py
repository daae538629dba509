"""Models of the two- and three-joint rational cores against the float64 truth: error bounds, flags, symmetry."""

from __future__ import annotations

import numpy as np
import pytest
from quadrance import bounds, codecs, rational, truth

P = {"W": 16, "F": 8, "S": 24, "U": 16}
FINE = {"W": 16, "F": 8, "S": 28, "U": 17}
LINKS = [(8192, 8192), (8320, 7040), (12000, 4384), (4384, 12000), (16384, 0), (0, 16384), (768, 512), (1, 1)]


def _words(rng: np.random.Generator, s: int, count: int) -> np.ndarray:
    """Uniform words, and words about every quadrant border at every scale of the spread."""
    words = rng.integers(0, 4 << s, count)
    near = rng.integers(0, 1 << s, count // 2) >> rng.integers(0, s, count // 2)
    words[::2] = (rng.integers(0, 4, count // 2) << s) + rng.choice([-1, 1], count // 2) * near
    return words & (4 << s) - 1


@pytest.mark.parametrize("p", [P, FINE], ids=["S24", "S28U17"])
def test_roots_are_within_their_bound_in_every_quadrant(p: dict[str, int]) -> None:
    borders = (np.arange(4)[:, None] * (1 << p["S"]) + np.arange(-4096, 4096)).ravel() & (4 << p["S"]) - 1
    words = np.append(_words(np.random.default_rng(1), p["S"], 200_000), borders)
    theta = truth.spread_word_to_angle(words, p["S"])
    for root, exact in zip(codecs.spread_chords(p, words), truth.unit(theta)):
        assert np.max(np.abs(root / 2.0 ** (p["U"] + 1) - exact)) * 2.0 ** p["U"] <= bounds.codec.spread_chord(p["U"])


@pytest.mark.parametrize(("l1", "l2"), LINKS)
def test_fk2_is_within_its_bound(l1: int, l2: int) -> None:
    rng = np.random.default_rng(2)
    j1, j2 = _words(rng, P["S"], 100_000), _words(rng, P["S"], 100_000)
    out = rational.fk2(P, in_j1=j1, in_j2=j2, cfg_l1=l1, cfg_l2=l2)
    exact = truth.fk2(*(truth.spread_word_to_angle(j, P["S"]) for j in (j1, j2)), l1, l2)
    error = [out[f"out_{axis}"] - value for axis, value in zip("xy", exact)]
    assert np.max(np.abs(error)) <= min(bounds.rational.chain(P, 2, l1, l2), 0.85)
    assert np.max(np.hypot(*error)) <= 1.02
    assert not out["out_status"].any()


@pytest.mark.parametrize(("l1", "l2"), LINKS)
def test_fk3_is_within_its_bound(l1: int, l2: int) -> None:
    rng = np.random.default_rng(3)
    words = [_words(rng, P["S"], 100_000) for _ in range(3)]
    out = rational.fk3(P, in_j1=words[0], in_j2=words[1], in_j3=words[2], cfg_l1=l1, cfg_l2=l2)
    exact = truth.fk3(*(truth.spread_word_to_angle(j, P["S"]) for j in words), l1, l2)
    error = [out[f"out_{axis}"] - value for axis, value in zip("xyz", exact)]
    assert np.max(np.abs(error)) <= min(bounds.rational.chain(P, 3, l1, l2), 1.0)
    assert not out["out_status"].any()


def test_overflow_is_flagged_exactly_where_a_coordinate_leaves_the_word() -> None:
    rng = np.random.default_rng(4)
    words = [_words(rng, P["S"], 50_000) for _ in range(3)]
    out = rational.fk3(P, in_j1=words[0], in_j2=words[1], in_j3=words[2], cfg_l1=40_000, cfg_l2=30_000)
    exact = np.array(truth.fk3(*(truth.spread_word_to_angle(j, P["S"]) for j in words), 40_000, 30_000))
    bound = bounds.rational.chain(P, 3, 40_000, 30_000)
    beyond = np.max(np.maximum(exact - 32767.5, -32768.5 - exact), axis=0)  # what rounds to a word that is too long
    told = np.abs(beyond) > bound - 0.5
    assert np.array_equal((out["out_status"] == 4)[told], (beyond > 0)[told])
    for axis, value in zip("xyz", exact):
        assert np.max(np.abs(out[f"out_{axis}"] - np.clip(value, -32768, 32767))) <= bound
