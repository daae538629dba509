"""Fixed-point rules against exact rational and integer arithmetic."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from quadrance import fixed

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
