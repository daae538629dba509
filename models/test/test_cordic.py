"""The CORDIC models against float64, their constants against mpmath, within bounds derived from their quantisation."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp, mpf
from quadrance import bounds, classic, cordic
from quadrance.fixed import wrap

W16 = {"W": 16, "A": 16}
LSB = 2 * math.pi / 65536  # of a 16-bit angle, in radians


def _turned(p, words, x, y):
    """True rotation of (x, y) by angle words."""
    theta = 2 * math.pi * words / 2 ** p["A"]
    return x * np.cos(theta) - y * np.sin(theta), x * np.sin(theta) + y * np.cos(theta)


def test_the_derived_bounds_are_the_promise_at_every_parameter():
    """The figures of the page, over all that the cores accept."""
    rotations = {(w, a): bounds.cordic.rotate({"W": w, "A": a}) for w in range(8, 17) for a in range(5, w + 4)}
    assert 1.54 < max(rotations.values()) <= 1.55 and rotations[16, 16] <= 1.48
    lengths = [bounds.cordic.magnitude({"W": w}) for w in range(8, 17)]
    assert 1.12 < max(lengths) <= 1.13 and lengths[-1] <= 0.98
    angles = [bounds.cordic.angle({"W": w, "A": a}, cordic.AIM_GUARD, True) for w in range(8, 17)
              for a in range(4, w + 1)]
    assert 0.83 < max(fixed for fixed, _ in angles) <= 0.84
    assert bounds.cordic.angle(W16, cordic.AIM_GUARD, True)[1] * LSB <= 0.24


def legal(low: int, above: int) -> list[dict[str, int]]:
    """Every W, with the least A, W and the most."""
    return [{"W": w, "A": a} for w in range(8, 17) for a in sorted({low, w, w + above})]


@pytest.mark.parametrize("p", [*legal(5, 3), {"W": 11, "A": 9}, {"W": 15, "A": 14}],
                         ids=lambda p: f"W{p['W']}A{p['A']}")
def test_rotation_over_the_whole_circle(p):
    """Every angle word, vectors of every length: within the law where the output is in range."""
    rng = np.random.default_rng(2)
    words = np.arange(1 << p["A"]) if p["A"] <= 16 else rng.integers(0, 1 << p["A"], 1 << 16)
    full = 1 << p["W"] - 1
    lengths = [full, full * 1.41, *(full * 1.41 * 2.0 ** -rng.uniform(0, p["W"], 12))]
    bound = bounds.cordic.rotate(p)
    worst = 0.0
    for length in lengths:
        phi = rng.uniform(0, 2 * math.pi)
        x, y = (int(np.clip(round(length * f(phi)), -full, full - 1)) for f in (math.cos, math.sin))
        out = cordic.rotate(p, in_angle=words, in_x=x, in_y=y)
        for word, true in zip((out["out_x"], out["out_y"]), _turned(p, words, x, y), strict=True):
            worst = max(worst, float(np.max(np.abs(word - np.clip(true, -full, full - 1)))))
    assert worst <= bound
    assert worst > 0.5  # the search finds more than the rounding: it can fail


def test_rotation_saturates_and_says_so():
    out = cordic.rotate(W16, in_angle=[8192, 40960, 0, 32768], in_x=[32767, 32767, -32768, -32768],
                        in_y=[32767, 32767, 0, 0])
    assert out["out_y"].tolist()[:2] == [32767, -32768]
    assert out["out_status"].tolist() == [4, 4, 0, 4]
    assert out["out_x"].tolist()[2:] == [-32768, 32767]


@given(st.integers(0, 65535), st.integers(-32768, 32767), st.integers(-32768, 32767))
def test_quarter_turns_are_exact_to_the_rounding(word, x, y):
    """A quarter turn more exchanges the outputs; only the one's complement's unit may differ."""
    one = cordic.rotate(W16, in_angle=[word], in_x=[x], in_y=[y])
    two = cordic.rotate(W16, in_angle=[(word + 16384) % 65536], in_x=[x], in_y=[y])
    if not (one["out_status"] | two["out_status"])[0]:
        assert abs(two["out_y"] - one["out_x"])[0] <= 1
        assert abs(two["out_x"] + one["out_y"])[0] <= 1


@pytest.mark.parametrize("p", [*legal(4, 0), {"W": 11, "A": 9}, {"W": 16, "A": 12}],
                         ids=lambda p: f"W{p['W']}A{p['A']}")
def test_vectoring(p):
    """Length and angle within their laws, every direction and length."""
    full = 1 << p["W"] - 1
    rng = np.random.default_rng(3)
    length, phi = full * 1.41 * 2.0 ** -rng.uniform(0, p["W"], 50_000), rng.uniform(0, 2 * math.pi, 50_000)
    x, y = (np.clip(np.round(length * f(phi)), -full, full - 1).astype(np.int64) for f in (np.cos, np.sin))
    x, y = x[(x != 0) | (y != 0)], y[(x != 0) | (y != 0)]
    out = cordic.vector(p, in_x=x, in_y=y)
    true = np.hypot(x, y)
    error = np.abs(out["out_magnitude"] - true)
    assert error.max() <= bounds.cordic.magnitude(p)
    assert error.max() > 0.5
    off = wrap(np.zeros(1), 1) + out["out_angle"] - np.arctan2(y, x) * 2 ** p["A"] / (2 * math.pi)
    off = np.abs((off + 2 ** (p["A"] - 1)) % 2 ** p["A"] - 2 ** (p["A"] - 1))
    fixed, slope = bounds.cordic.angle(p, cordic.AIM_GUARD, True)
    assert fixed < 1.0
    assert np.all(off <= fixed + slope / true)
    assert not out["out_status"].any()
    if p == W16:
        assert off[true > 9000].max() <= 1.0


def test_the_origin_is_singular_and_has_no_length():
    out = cordic.vector(W16, in_x=[0, 1, 0], in_y=[0, 0, -1])
    assert out["out_status"].tolist() == [2, 0, 0]
    assert out["out_magnitude"].tolist() == [0, 1, 1]


# Constants. `bounds.cordic.angle` adds up how far each is from its angle: a wrong one would widen its own bound


@pytest.fixture(autouse=True)
def digits():
    with mp.workdps(60):
        yield


def gain(first: int, last: int) -> mpf:
    """What micro-rotations `first` to `last` lengthen a vector by."""
    return mpmath.fprod(mpmath.sqrt(1 + mpf(4) ** -i) for i in range(first, last + 1))


@pytest.mark.parametrize("bits", [9, 12, 15, 20, 21, 22, 24])
def test_angles_of_the_micro_rotations(bits):
    """atan 2^-i as a turn, times 2^(i + bits), cut; from i = 9 on its limit, which is within 2^-2i / 3 of it."""
    for i in range(24):
        exact = mpmath.atan(mpf(2) ** -min(i, 9)) / (2 * mp.pi) * mpf(2) ** (min(i, 9) + bits)
        assert cordic.angle(i, bits) == int(mpmath.floor(exact)), i
    assert 1 - mpmath.atan(mpf(2) ** -9) * 2**9 < mpf(4) ** -9 / 3


def test_the_gain_of_the_rotations():
    assert abs(classic.SHRINK - 1 / gain(0, 200)) < mpf(2) ** -50
    assert abs(classic.GROWTH / mpf(2) ** 30 - gain(0, 200)) < mpf(2) ** -29


@pytest.mark.parametrize("width", [8, 11, 12, 14, 15, 16])
def test_the_gain_digits_of_a_rotation(width):
    """Of cordic_rotate: the product of its micro-rotations, 1 to C, undone, to half an LSB of the word."""
    digits = [(shift, minus) for shift, minus in cordic.GAIN_DIGITS if shift < 10 or shift <= width]
    found = sum((-1) ** minus * mpf(2) ** -shift for shift, minus in digits)
    assert abs(found * gain(1, cordic.sizes(width)[0]) - 1) < mpf(2) ** -width


def test_the_gain_of_a_length():
    """Of cordic_vector: nested shifts, 1.214509, twice what undoes the gain of vectoring."""
    value = mpf(1)
    for shift, minus in cordic.HORNER:
        value = 1 + (-1) ** minus * value * mpf(2) ** -shift
    assert abs(value * gain(0, 200) / 2 - 1) < mpf(2) ** -17


def test_the_gain_of_the_third_rotation():
    """Of classic_fk3: shifts whose product is twice SHRINK to a 2^-18."""
    value = mpf(1)
    for shift, minus in classic.YAW_FACTORS:
        value *= 1 + (-1) ** minus * mpf(2) ** -shift
    assert abs(value * gain(0, 200) / 2 - 1) < mpf(2) ** -18


@pytest.mark.parametrize("l1, l2", [(1, 1), (8192, 8192), (16000, 300), (65533, 65533)])
def test_start_words(l1, l2):
    words = classic.config({"W": 16}, cfg_l1=l1, cfg_l2=l2)
    shrink = 1 / gain(0, 200)
    assert words["cfg_c1"] == int(mpmath.floor(l1 * shrink * 2**4))
    assert words["cfg_s1"] == int(mpmath.floor(l1 * shrink * 2**5))
    assert words["cfg_s2"] == int(mpmath.floor(l2 * shrink * shrink * mpmath.sqrt(2) * 2**5))
