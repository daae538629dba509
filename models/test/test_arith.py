"""Fixed-point rules and the models of rtl/arith against rational and big-integer arithmetic."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from quadrance import arith, bounds, fixed

# Rounding, saturation and words

words = st.integers(-(2**40), 2**40)


@given(words, st.integers(0, 20))
def test_round_shift_is_nearest_ties_upward(value, bits):
    assert fixed.round_shift(value, bits) == math.floor(Fraction(value, 2**bits) + Fraction(1, 2))


@given(words, st.integers(2, 32))
def test_saturate_is_the_nearest_word_and_says_so(value, width):
    low, high = -(2 ** (width - 1)), 2 ** (width - 1) - 1
    clamped, changed = fixed.saturate(value, width)
    assert clamped == sorted((low, value, high))[1] and changed == (not low <= value <= high)


@given(words, st.integers(1, 32))
def test_wrap_is_the_residue_of_its_range(value, width):
    unsigned, signed = fixed.wrap(value, width, signed=False), fixed.wrap(value, width)
    assert 0 <= unsigned < 2**width and -(2 ** (width - 1)) <= signed < 2 ** (width - 1)
    assert (unsigned - value) % 2**width == 0 == (signed - value) % 2**width


@given(st.lists(st.tuples(st.integers(-9, 9), st.booleans()), min_size=1, max_size=30), st.integers(-5, 5))
def test_hold_last_is_a_register(stream, reset):
    held, expected = reset, []
    for value, valid in stream:
        held = value if valid else held
        expected.append(held)
    value, valid = zip(*stream)
    assert fixed.hold_last(value, valid, reset).tolist() == expected


def test_hold_last_works_along_the_last_axis():
    held = fixed.hold_last([[1, 2, 3], [4, 5, 6]], [[True, False, False], [False, True, False]])
    assert held.tolist() == [[1, 1, 1], [0, 5, 5]]


@given(st.integers(0, 2**62 - 1))
def test_isqrt(value):
    assert fixed.isqrt(value) == math.isqrt(value)


def test_isqrt_at_perfect_squares_and_their_neighbours():
    roots = np.unique(np.r_[1:3000, 2**np.arange(12, 31), 2**31 - 1 - np.arange(50)])
    for offset in (-1, 0, 1):
        value = roots * roots + offset
        assert np.array_equal(fixed.isqrt(value), [math.isqrt(int(one)) for one in value])


@given(st.floats(-1e5, 1e5), st.integers(0, 24))
def test_to_fixed_is_within_half_an_lsb(value, fraction):
    back = fixed.to_float(fixed.to_fixed(value, fraction), fraction)
    assert abs(back - value) <= 2.0 ** -(fraction + 1)


def test_to_fixed_rounds_ties_upward():
    assert fixed.to_fixed([0.5, 1.5, -0.5, -1.5], 0).tolist() == [1, 2, 0, -1]


def test_ints_keep_shape_and_type():
    assert fixed.ints([[1, 2]]).dtype == np.int64 and fixed.ints(3).shape == ()
    assert fixed.round_shift(7, 0) == 7
    with pytest.raises(OverflowError):
        fixed.ints(2**63)


# The models of rtl/arith against their defining inequalities


@pytest.mark.parametrize(("width", "fraction"), [(16, 0), (15, 1), (9, 3)])
def test_isqrt_of_every_word(width: int, fraction: int) -> None:
    d = np.arange(1 << width)
    out = arith.isqrt({"W": width, "F": fraction}, in_d=d)
    root, rem = out["out_root"], out["out_rem"]
    assert (root * root + rem == d << 2 * fraction).all()
    assert (rem >= 0).all() and (rem <= 2 * root).all()
    assert root.max() < 1 << (width + 1) // 2 + fraction


@given(st.integers(1, 32), st.integers(0, 15), st.data())
def test_isqrt_is_the_floor_of_the_root(width: int, fraction: int, data: st.DataObject) -> None:
    d = data.draw(st.integers(0, (1 << width) - 1))
    out = arith.isqrt({"W": width, "F": fraction}, in_d=np.array([d]))
    assert out["out_root"].item() == math.isqrt(d << 2 * fraction)


@given(st.integers(0, (1 << 31) - 1), st.integers(-1, 1))
def test_isqrt_at_squares_and_their_neighbours(root: int, offset: int) -> None:
    d = max(root * root + offset, 0)
    assert arith.isqrt({"W": 62, "F": 0}, in_d=np.array([d]))["out_root"].item() == math.isqrt(d)


@given(st.integers(1, 32), st.integers(1, 32), st.integers(0, 20), st.data())
def test_divide_is_euclid(wn: int, wd: int, fraction: int, data: st.DataObject) -> None:
    n = data.draw(st.integers(0, (1 << wn) - 1))
    d = data.draw(st.integers(0, (1 << wd) - 1))
    out = arith.divide({"WN": wn, "WD": wd, "F": fraction}, in_n=np.array([n]), in_d=np.array([d]))
    q, r = out["out_q"].item(), out["out_r"].item()
    assert out["out_div_by_zero"].item() == (d == 0)
    if d:
        assert n << fraction == q * d + r and 0 <= r < d
    else:
        assert q == (1 << wn + fraction) - 1 and r == (n << fraction) % (1 << wd)


@given(st.integers(4, 40), st.integers(2, 24), st.data())
def test_round_saturate_is_nearest_ties_upward(wi: int, wo: int, data: st.DataObject) -> None:
    shift = data.draw(st.integers(0, wi - 1))
    x = data.draw(st.integers(-(1 << wi - 1), (1 << wi - 1) - 1))
    out = arith.round_saturate({"WI": wi, "WO": wo, "SHIFT": shift}, in_x=np.array([x]))
    exact = Fraction(x, 1 << shift)
    nearest = math.floor(exact + Fraction(1, 2))
    low, high = -(1 << wo - 1), (1 << wo - 1) - 1
    assert out["out_x"].item() == min(max(nearest, low), high)
    assert out["out_overflow"].item() == (not low <= nearest <= high)
    if not out["out_overflow"].item():
        assert abs(out["out_x"].item() - exact) <= Fraction(1, 2)


@pytest.mark.parametrize(("bits", "bound"), [(17, 0.52), (20, 0.31)])
def test_chord_slopes_cover_every_read(bits, bound):
    """|sqrt(v) - w slope / 2^(B + 17)| <= bound / 2^15 over both readings of a 16-bit spread, and 0 at 0."""
    v = np.arange(1 << 16)
    assert bounds.codec.root_product(bits) == bound / 2**15
    for flip in (0, 1):
        parts = arith.root_product({"S": 16, "B": bits}, in_v=v, in_not=np.full(v.shape, flip))
        root = parts["out_w"] * parts["out_slope"] / 2.0 ** (bits + 17)
        exact = np.sqrt((65536 - v) / 65536 if flip else v / 65536)
        assert np.abs(root - exact).max() <= bounds.codec.root_product(bits) + 2.0**-24
