"""The constants of the CORDIC models against mpmath: bounds count what a constant is off, so none may be off by more.

`bounds.cordic_angle` adds up how far each constant of the model is from the angle it stands for. A wrong one would
widen its own bound; here they are held to the exact value.
"""

import mpmath
import pytest
from mpmath import mp, mpf
from quadrance import classic, cordic


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
