"""Error bounds of rtl/classic."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
from numpy.typing import ArrayLike

from quadrance import classic as model
from quadrance.bounds import cordic
from quadrance.cordic import angle as constant
from quadrance.truth import Floats, floats

Params = dict[str, int]


def fk1(p: Params, l1: float) -> float:
    """Distance of the tip of classic_fk1, and so a coordinate.

    At every A 1.6 up to L1 = 2^(W-2) and 2.01 at any length for W up to 16; 1.89 and 2.31 above.

    Half an LSB of rounding in both coordinates; for each angle word the relative error of its rotation, of L1, and what
    rounds down off the constant that makes up for its mean, in any direction: the start word, shifts and complements,
    times the micro-rotations that follow.
    """
    off, units = _one(p["W"], p["A"])
    return float(math.sqrt(0.5) + np.max(off * l1 + units / 2**model.GUARD))


@cache
def _one(width: int, turn_bits: int) -> tuple[Floats, Floats]:
    """Of classic_fk1 at every residual angle: relative error and units of the rounding."""
    parts = []
    for theta, rest, rows in cordic.micro_rotations({"W": width, "A": turn_bits}):
        mean = -0.5 * (1 + 1j) * (rest.sum(axis=0) + rows)
        spread = math.sqrt(0.5) * (np.abs(rest).sum(axis=0) + rows)
        off = np.abs(rest[0] * math.sqrt(2) * model.SHRINK / np.exp(1j * theta) - 1)
        parts.append((off, spread + np.abs(mean + (model.rounding(width) - 8) * (1 + 1j))))
    off, units = map(np.concatenate, zip(*parts))
    order = np.lexsort((units, off))[::-1]  # some length makes a word the worst only if no other has more of both
    units = units[order]
    worst = np.append(True, units[1:] > np.maximum.accumulate(units)[:-1])
    return off[order][worst], units[worst]


def ik1(p: Params, l1: float) -> float:
    """Tip of classic_ik1 on a link of `l1`: the law of `cordic.angle` without its half LSB of rounding to the word."""
    turn = 2 ** p["A"] / (2 * math.pi)
    fixed, slope = cordic.angle(p, model.AIM_GUARD, False)
    return (fixed - 0.5) / turn * l1 + slope / turn


def _rotation(width: int, turn_bits: int, factors: int = 0) -> tuple[float, Floats, Floats, float]:
    """Of `cordic.turn` from a start word, over every residual angle: relative error, mean and spread of the rounding.

    A start word, `factors` shifts of it, every micro-rotation and every digit leave x and y 0 to 1 unit low, times what
    still follows: the mean of that (complex, in units) and the most it may be off its mean in any direction. The signs
    of the quadrant may turn what the factors leave, in x or y; the third is how much a unit there is in the end.
    """
    parts = []
    for theta, rest, rows in cordic.micro_rotations({"W": width, "A": turn_bits}):
        sources = rest[[0] * (1 + factors) + list(range(1, len(rest)))]
        true = np.exp(1j * theta) / (math.sqrt(2) * model.SHRINK)
        parts.append((np.abs(rest[0] / true - 1).max(), -0.5 * (1 + 1j) * (sources.sum(axis=0) + rows), rest[0],
                      math.sqrt(0.5) * float(np.max(np.abs(sources).sum(axis=0) + rows))))
    off, mean, start, spread = zip(*parts)
    return max(off), np.concatenate(mean), np.concatenate(start), max(spread)


def chain(p: Params, joints: int, l1: float, l2: float) -> float:
    """A coordinate of classic_fk2 or classic_fk3.

    A half for rounding; the relative errors of the rotations a link goes through; the roundings of all of them, those
    of the first turned by the second, off the mean that the constants take out; a unit for each start word.
    Up to L1 + L2 = 2^(W-2) at most 2 (two joints) and 2.9 (three) for W up to 16, 2.42 and 3.49 above.
    """
    off, units = _plane(p["W"], p["A"])
    plane = off * (l1 + 2 * l2) + units
    if joints == 2:
        return float(plane + 0.5)
    off, units = _yaw(p["W"], p["A"])
    return float(plane + off * (l1 + l2) + units + 0.5)


@cache
def _plane(width: int, turn_bits: int) -> tuple[float, float]:
    """Of the two rotations in the plane of the arm: relative error of each, and the roundings of both, LSB."""
    gain, (taken, _) = 1.1645, model.chain_rounding(width)
    off, mean, _, spread = _rotation(width, turn_bits)
    centre = mean.mean()
    turned = centre * gain * np.exp(2j * math.pi * np.linspace(-1, 1, mean.size) / 8) + mean
    drift = np.abs(turned + taken * (1 + 1j))
    drift = max(np.abs(drift.real).max(), np.abs(drift.imag).max()) + gain * np.abs(mean - centre).max()
    return off, 2.0**-model.CHAIN_GUARD * (gain * spread + spread + drift + 4)


@cache
def _yaw(width: int, turn_bits: int) -> tuple[float, float]:
    """The same of the rotation about the yaw axis."""
    factors, (_, taken) = len(model.yaw_factors(width)) + 1, model.chain_rounding(width)
    off, mean, start, spread = _rotation(width, turn_bits, factors)
    flat = max(np.abs(mean + factors * turned * start + taken * (1 + 1j)).max() for turned in (0, 1, 1j, 1 + 1j))
    return off, 2.0**-model.CHAIN_GUARD * (spread + flat)


def _pass(p: Params, grows: int) -> tuple[float, float]:
    """Angle of one pass of the solver: (rad, rad LSB), the error being the first + the second / length of the vector.

    The first: residual angle, the constants' rounding, the early end of the growth. The second as of `cordic.angle`.
    """
    turn = 2 ** p["A"] / (2 * math.pi)
    last, half, unit = p["W"] + 1, (p["W"] + 1) // 2, 2.0**-model.SOLVE_ANGLE_GUARD
    bits = p["A"] + model.SOLVE_ANGLE_GUARD
    angle = sum(abs((constant(i, bits) >> i) + 0.5 - math.atan(2.0**-i) * turn / unit) for i in range(last + 1))
    fixed = 2.0**-last + (angle + 1) * unit / turn + sum(8.0**-i for i in range(grows + 1, last + 1))
    return fixed, 2.5 * 2.0**-model.SOLVE_GUARD + 2 * 2.0 ** (half // 2 - half) / cordic.GAIN


def _grows(p: Params, joints: int) -> int:
    return (p["W"] + 1) // 3 + 1 if joints == 2 else (p["W"] + 1) // 2


def elbow(p: Params, joints: int, l1: int, l2: int) -> float:
    """Joint 2 of classic_ik2 or classic_ik3, LSB of its word; links in LSB, neither 0.

    It is 2 h, h the direction of the legs (b, a), whose length is 2 sqrt(L1 L2) LSB whatever the target: a pass on this
    length, the roots' unit each low, sqrt(2) 2^-4 across, and half an LSB. So the word may be this much on the wrong
    side of the stretched or the folded arm, and is on the side of the elbow asked for where it is farther from both.
    At W = A = 16 this is 1.3 for links of 32 units each, 76 for 50 and 40 LSB, 3344 for 1 and 1 (found: 0, 16, 505).
    """
    fixed, slope = _pass(p, _grows(p, joints))
    legs = slope + math.sqrt(2) * 2.0**-model.SOLVE_GUARD
    return 0.5 + 2 ** p["A"] / (2 * math.pi) * 2 * (fixed + legs / (2 * math.sqrt(l1 * l2)))


def ik(p: Params, joints: int, l1: int, l2: int, r: ArrayLike) -> Floats:
    """Tip of classic_ik2 or classic_ik3 from the nearest point in reach, half an LSB of rounding in each word included.

    Parameters
    ----------
    p, joints, l1, l2
        2 or 3 joints; links in LSB, neither 0.
    r : float array
        Distance of the target, > 0, reachable or not, LSB; the nearest point has the distance R.

    Notes
    -----
    Every pass: residual angle, constants, early end of the growth, and rounding weighed by 1 / length, as in ik1. Half
    an LSB of a word acts at the tip by the distance (j1) and L2 (j2). phi has the length of the target, so that in the
    hole its rounding is magnified by R / r; h has 2 sqrt(L1 L2), d that times R / (L1 + L2) or more: with
    s = (L1 + L2) / (2 sqrt(L1 L2)), which is 64 for links of 1 and 16383 LSB, both are magnified by it. The roots are 1
    unit low, which acts as a rounding does.

    Three joints: the yaw is a pass on rho and a word at no more than R. phi is that of (K rho, K z):

    * K rho is low by a unit of 2^-4 LSB for the mirror and for each of the growing steps, and follows y, whose minuses
      are 4 units at most; K z is low by 1. A point that is off by this over K turns the arm by asin of it over r.
    * x stops growing early: 2/3 4^-grows of rho; K is cut to W + 2 bits. Of what rho and z differ in, half turns.
    """
    r, grows = floats(r), _grows(p, joints)
    turn = 2 ** p["A"] / (2 * math.pi)
    fixed, slope = _pass(p, grows)
    legs = slope + 2.0**-model.SOLVE_GUARD
    at = np.clip(r, abs(l1 - l2), l1 + l2)
    stretch = (l1 + l2) / (2 * math.sqrt(l1 * l2))
    plane = (0.5 / turn) * (at + l2) + fixed * (3 * at + 2 * l2) + slope * at / r
    plane = plane + legs * (stretch + (at + 2 * l2) / (l1 + l2) * stretch)
    if joints == 2:
        return plane
    yaw = (0.5 / turn + fixed) * at + slope * at / r
    off = math.hypot(grows + 6, 1) * 2.0**-model.SOLVE_GUARD / cordic.GAIN
    lack = 2 / 3 * 4.0**-grows + 2.0 ** -(p["W"] + 2) / cordic.GAIN
    return plane + yaw + at * (2 * np.sin(np.arcsin(np.minimum(off / r, 1)) / 2) + lack / 2)
