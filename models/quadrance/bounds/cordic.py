"""Error bounds of rtl/cordic."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from quadrance import cordic as model
from quadrance.fixed import Ints, wrap
from quadrance.truth import Floats

Params = dict[str, int]


SLICE = 1 << 17  # residual angles at a time


def micro_rotations(p: Params) -> Iterator[tuple[Floats, Floats, Floats]]:
    """`cordic.turn` at every residual angle: angle (rad), what it multiplies with, radix-4 digits that are not 0.

    They come in slices of `SLICE` words. The second has the shape (rotations + 1, words), complex: the product of all
    that is still to come before each micro-rotation, and after the last.
    """
    half = 1 << p["A"] - 3
    for first in range(-half, half, SLICE):
        yield _micro_rotations(p, np.arange(first, min(first + SLICE, half)))


def _micro_rotations(p: Params, words: Ints) -> tuple[Floats, Floats, Floats]:
    rotations, digits = model.sizes(p["W"])
    bits, low = p["W"] + 4, max(rotations - 2, 0)
    z = (words << p["W"] + 5 - p["A"]) + 2
    steps = []
    for i in range(1, rotations + 1):
        d, cut = np.where(z >= 0, 1, -1), max(i - 3, 0)
        steps.append(1 + 1j * d * 2.0**-i)
        z = wrap(z + ((model.angle(i, bits) >> cut ^ -(d > 0).astype(np.int64)) << cut) << 1, bits)
    tangent, rows = np.zeros(words.shape), np.zeros(words.shape)
    for k in range(digits):
        d = np.where(z >= 0, 1, -1)
        size = np.digitize((z ^ -(d < 0).astype(np.int64)) >> bits - 4, [1, 4])
        tangent, rows = tangent + d * size * 2.0 ** -(rotations + 1 + 2 * k), rows + (size > 0)
        term = model.angle(9, bits) << (size == 2) >> low ^ -(d > 0).astype(np.int64)
        z = wrap(z + np.where(size > 0, term << low, 0) << 2, bits)
    rest = np.stack([*np.cumprod(steps[::-1], axis=0)[::-1], np.ones(words.shape)]) * (1 + 1j * tangent)
    return 2 * math.pi * words / 2 ** p["A"], rest, rows


def rotate(p: Params) -> float:
    """A coordinate of cordic_rotate, the greatest over every angle word and every input: 1.55 at every W and A.

    For each word the digits are found, and with them the factor it really multiplies with; its distance from
    exp(j theta), along and across, times a full-scale output is the first part. The second: every shift and every
    minus is between 0 and 1 unit low (a unit is 2^-GUARD LSB), times the rotations that follow it. Rounding is 1/2.
    """
    return max(_rotate(p, *one) for one in micro_rotations(p))


def _rotate(p: Params, theta: Floats, rest: Floats, rows: Floats) -> float:
    """That of some angle words."""
    shifts = [shift for shift, _ in model.GAIN_DIGITS if shift < 10 or shift <= p["W"]]
    gain = sum((-1.0) ** minus * 2.0**-shift for shift, minus in model.GAIN_DIGITS if shift in shifts)
    sources = [gain * rest[0], *[rest[0]] * (len(shifts) - 1), *rest[1:]]  # complement, inexact digits, steps
    low_x = sum(-0.5 * (1 + 1j) * source for source in sources) - 0.5 * (1 + 1j) * rows  # the mean of all that is low
    spread = sum(0.5 * (np.abs(source.real) + np.abs(source.imag)) for source in sources) + 0.5 * rows
    drift = np.maximum(np.abs(low_x.real + model.ROUND - 16), np.abs(low_x.imag + model.ROUND - 16))
    off = gain * rest[0] / np.exp(1j * theta) - 1
    linear = 2.0 ** (p["W"] - 1) * (np.abs(off.real) + np.abs(off.imag))
    return float(np.max(0.5 + (spread + drift) / 2**model.GUARD + linear))


def magnitude(p: Params) -> float:
    """Length by cordic_vector; 0.97 LSB at W = 16, 1.13 at every W.

    Rounding 1/2. The constant 1.214509 against the growth of C + 1 micro-rotations, k, less the growth of the residual
    angle 2^-C, which is not made. In units of 2^-5 LSB: C shifts and the mirror are 0 to 1 low, times the constant, and
    the shifts of the constant's digits 1.36 together; 5 units make up for them.
    """
    half = (p["W"] + 1) // 2
    v = 1.0
    for shift, minus in model.HORNER:
        v = 1 + (-1) ** minus * v * 2.0**-shift
    k = v / 2 * math.prod(math.sqrt(1 + 4.0**-i) for i in range(half + 1)) - 1
    growth = max(abs(k), abs(k - 2.0 ** -(2 * half + 1))) * math.sqrt(2) * 2 ** (p["W"] - 1)
    low = (half + 1) * v + 1.36
    return 0.5 + growth + max(5, low - 5) / 32


def angle(p: Params, guard: int, magnitude: bool) -> tuple[float, float]:
    """Angle of a vectoring engine: (LSB of 2^-A turn, LSB times length); the bound at a length is a + b / length.

    Rounding 1/2; the residual atan 2^-last; the constants' rounding; the complements, 1/2 a step, of which 8 units are
    centred; where x stops growing early (no magnitude), what is left to turn times its relative lack. Times 1/length:
    x mirrored 1 unit high or low, y's minus 1/2 unit a step (halved each step), x rounded down 1/2 unit a step (weighed
    with the angle left), the bits the division drops.
    """
    turn = 2 ** p["A"] / (2 * math.pi)
    half = (p["W"] + 1) // 2
    last = half + 8 if magnitude else p["W"]
    unit = 2.0**-model.ANGLE_GUARD
    bits = p["A"] + model.ANGLE_GUARD
    constants = sum(abs((model.angle(i, bits) >> i) + 0.5 - math.atan(2.0**-i) * turn / unit) for i in range(last + 1))
    grows = half if magnitude else (p["W"] + 1) // 3
    early = sum(2.0**-i * 4.0**-i for i in range(grows + 1, last + 1)) * turn
    fixed = 0.5 + 2.0**-last * turn + (constants + abs(8 - (last + 1) / 2)) * unit + early
    dropped = 2.0 ** (half // 2 - half)  # of the division: two words cut at 2^(half / 2) LSB, scaled by 2^half
    return fixed, turn * (2.5 * 2.0**-guard + 2 * dropped / 1.6468)


GAIN = 1.646760
"""What vectoring lengthens a vector by."""
