"""The CORDIC models against float64, within bounds derived from their quantisation. No simulator."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from quadrance import cordic
from quadrance.fixed import wrap

W16 = {"W": 16, "A": 16}
LSB = 2 * math.pi / 65536  # of a 16-bit angle, in radians


def _turned(p, words, x, y):
    """True rotation of (x, y) by angle words."""
    theta = 2 * math.pi * words / 2 ** p["A"]
    return x * np.cos(theta) - y * np.sin(theta), x * np.sin(theta) + y * np.cos(theta)


def rotation_bound(p: dict[str, int]) -> float:
    """Derived error of `cordic.rotate` in LSB, the greatest over every angle word and every input.

    For each word the digits are found, and with them the factor it really multiplies with; its distance from
    exp(j theta), along and across, times a full-scale output is the first part. The second: every shift and every
    minus is between 0 and 1 unit low (a unit is 2^-GUARD LSB), times the rotations that follow it. Rounding is 1/2.
    """
    rotations, digits = cordic.sizes(p["W"])
    bits = p["W"] + 4
    words = np.arange(1 << p["A"] - 2) - (1 << p["A"] - 3)
    z = (words << p["W"] + 5 - p["A"]) + 2
    steps, low = [], max(rotations - 2, 0)
    for i in range(1, rotations + 1):
        d = np.where(z >= 0, 1, -1)
        steps.append(1 + 1j * d * 2.0**-i)
        cut = max(i - 3, 0)
        z = wrap(z + ((cordic.angle(i, bits) >> cut ^ -(d > 0).astype(np.int64)) << cut) << 1, bits)
    tangent, rows = np.zeros(words.shape), np.zeros(words.shape)
    for k in range(digits):
        d = np.where(z >= 0, 1, -1)
        size = np.digitize((z ^ -(d < 0).astype(np.int64)) >> bits - 4, [1, 4])
        tangent, rows = tangent + d * size * 2.0 ** -(rotations + 1 + 2 * k), rows + (size > 0)
        term = cordic.angle(9, bits) << (size == 2) >> low ^ -(d > 0).astype(np.int64)
        z = wrap(z + np.where(size > 0, term << low, 0) << 2, bits)
    rest = np.stack([*np.cumprod(steps[::-1], axis=0)[::-1], np.ones(words.shape)]) * (1 + 1j * tangent)
    shifts = [shift for shift, _ in cordic.GAIN_DIGITS if shift < 10 or shift <= p["W"]]
    gain = sum((-1.0) ** minus * 2.0**-shift for shift, minus in cordic.GAIN_DIGITS if shift in shifts)
    sources = [gain * rest[0], *[rest[0]] * (len(shifts) - 1), *rest[1:]]  # complement, inexact digits, steps
    low_x = sum(-0.5 * (1 + 1j) * source for source in sources) - 0.5 * (1 + 1j) * rows  # the mean of all that is low
    spread = sum(0.5 * (np.abs(source.real) + np.abs(source.imag)) for source in sources) + 0.5 * rows
    drift = np.maximum(np.abs(low_x.real + cordic.ROUND - 16), np.abs(low_x.imag + cordic.ROUND - 16))
    off = gain * rest[0] / np.exp(2j * math.pi * words / 2 ** p["A"]) - 1
    linear = 2.0 ** (p["W"] - 1) * (np.abs(off.real) + np.abs(off.imag))
    return float(np.max(0.5 + (spread + drift) / 2**cordic.GUARD + linear))


def test_the_derived_bound_of_a_rotation_is_the_promise():
    assert rotation_bound(W16) <= 1.5


@pytest.mark.parametrize("p", [W16, {"W": 11, "A": 9}, {"W": 16, "A": 19}, {"W": 8, "A": 5}, {"W": 15, "A": 14}],
                         ids=lambda p: f"W{p['W']}A{p['A']}")
def test_rotation_over_the_whole_circle(p):
    """Every angle word, vectors of every length: at most 1.5 LSB (1.05 at 16 bits) where the output is in range."""
    words = np.arange(1 << p["A"])
    full = 1 << p["W"] - 1
    rng = np.random.default_rng(2)
    lengths = [full, full * 1.41, *(full * 1.41 * 2.0 ** -rng.uniform(0, p["W"], 12))]
    bound = rotation_bound(p)
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


def angle_bound(p: dict[str, int], guard: int, magnitude: bool) -> tuple[float, float]:
    """Derived error of the vectoring's angle: (LSB, LSB times length).

    Rounding 1/2; the residual atan 2^-last; the constants' rounding; where x stops growing early (no magnitude), what
    is left to turn times its relative lack. Times 1/length: x mirrored 1 unit high or low, y's minus 1/2 unit a step
    (halved each step), x rounded down 1/2 unit a step (weighed with the angle left), the bits the division drops.
    """
    turn = 2 ** p["A"] / (2 * math.pi)
    half = (p["W"] + 1) // 2
    last = half + 8 if magnitude else p["W"]
    unit = 2.0**-cordic.ANGLE_GUARD
    bits = p["A"] + cordic.ANGLE_GUARD
    constants = sum(abs((cordic.angle(i, bits) >> i) + 0.5 - math.atan(2.0**-i) * turn / unit) for i in range(last + 1))
    grows = half if magnitude else (p["W"] + 1) // 3
    early = sum(2.0**-i * 4.0**-i for i in range(grows + 1, last + 1)) * turn
    fixed = 0.5 + 2.0**-last * turn + (constants + 0.5) * unit + early
    dropped = 2.0 ** (half // 2 - half)  # of the division: two words cut at 2^(half / 2) LSB, scaled by 2^half
    return fixed, turn * (2.5 * 2.0**-guard + 2 * dropped / 1.6468)


@pytest.mark.parametrize("p", [W16, {"W": 11, "A": 9}, {"W": 16, "A": 12}, {"W": 8, "A": 4}, {"W": 15, "A": 15}],
                         ids=lambda p: f"W{p['W']}A{p['A']}")
def test_vectoring(p):
    """Length within 1 LSB, angle within the law, every direction and length."""
    full = 1 << p["W"] - 1
    rng = np.random.default_rng(3)
    length, phi = full * 1.41 * 2.0 ** -rng.uniform(0, p["W"], 400_000), rng.uniform(0, 2 * math.pi, 400_000)
    x, y = (np.clip(np.round(length * f(phi)), -full, full - 1).astype(np.int64) for f in (np.cos, np.sin))
    x, y = x[(x != 0) | (y != 0)], y[(x != 0) | (y != 0)]
    out = cordic.vector(p, in_x=x, in_y=y)
    true = np.hypot(x, y)
    error = np.abs(out["out_magnitude"] - true)
    assert error.max() <= 1.0
    assert error.max() > 0.5
    off = wrap(np.zeros(1), 1) + out["out_angle"] - np.arctan2(y, x) * 2 ** p["A"] / (2 * math.pi)
    off = np.abs((off + 2 ** (p["A"] - 1)) % 2 ** p["A"] - 2 ** (p["A"] - 1))
    fixed, slope = angle_bound(p, cordic.AIM_GUARD, True)
    assert fixed < 1.0
    assert np.all(off <= fixed + slope / true)
    assert not out["out_status"].any()
    if p == W16:
        assert off[true > 9000].max() <= 1.0


def test_the_origin_is_singular_and_has_no_length():
    out = cordic.vector(W16, in_x=[0, 1, 0], in_y=[0, 0, -1])
    assert out["out_status"].tolist() == [2, 0, 0]
    assert out["out_magnitude"].tolist() == [0, 1, 1]
