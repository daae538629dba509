"""Error bounds as functions of the parameters, each with its derivation: what tests show, pages and reports quote.

`p` are the Verilog parameters of a core. Lengths and errors are in LSB of a coordinate, 2^-F units, where nothing else
is said. Errors of forward cores include half an LSB of rounding in each coordinate; errors of inverse cores are at the
tip, the float64 arm at the answered joints, beyond the rounding of the joint words themselves unless they say so.
Where a figure was found by search instead of derived, the docstring says "found".
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from quadrance import classic, codecs, cordic, paper, rational, table
from quadrance.cores import Core
from quadrance.fixed import wrap
from quadrance.truth import Floats, floats

Params = dict[str, int]


# A core at the tip


def tip(core: Core, l1: int, l2: int) -> float:
    """Greatest tip error of a kinematic core, LSB.

    Parameters
    ----------
    core : Core
        Of one to three joints.
    l1, l2 : int
        Link lengths in LSB, together at most 2^(W-2) (64 units of Q7.8); one joint moves the first link.

    Returns
    -------
    float
        Forward: distance of the answered point, rounding included. Inverse: see the module. The inverse cores of two
        and three joints of `rational` and `classic` keep 2 LSB a unit and more from the shoulder and from the stretched
        and the folded arm (found; next to these see `rational_ik2` and `classic_ik`); forward, the coordinate's bound
        is cut at what was found over all links of the tests.
    """
    p, (family, function) = core.params, core.model_name.split(".")
    joints = int(function[-1])
    forward = function.startswith("fk")
    if family == "paper" and joints == 1:
        return math.sqrt(0.5) if forward else 0.0
    if family == "paper":
        return paper_forward(p, joints, l1, l2) if forward else paper_inverse(p, l1, l2)
    if family == "table":
        return math.sqrt(joints + (joints == 1)) * table_forward(p, joints, l1, l2) if forward else \
            table_direction(p) * l1
    if joints == 1:
        if forward:
            return 1.0 if family == "rational" else classic_fk1(p, l1)
        return RATIONAL_DIRECTION * l1 if family == "rational" else classic_ik1(p, l1)
    if not forward:
        return 2.0
    axis = min(rational_chain(p, joints, l1, l2), 1.0) if family == "rational" else \
        min(classic_chain(p, joints, l1, l2), {2: 2.0, 3: 2.8}[joints])
    return math.sqrt(joints) * axis


# Codecs and their parts


def vector_to_spread(s: int, u: int, theta: ArrayLike) -> Floats:
    """How far (LSB of 2^-S) the turn-spread of a unit vector rounded to `u` fraction bits is from that of `theta`.

    Half an LSB on both coordinates turns the vector by d <= sqrt(1/2) 2^-u, so sin^2 moves by at most
    |sin 2 theta| d + d^2; the word itself is the nearest, 1/2.
    """
    turn = math.sqrt(0.5) * 2.0**-u / (1 - 2.0**-u)
    return (np.abs(np.sin(2 * floats(theta))) * turn + turn * turn) * 2.0**s + 0.5


def root_product(bits: int = 17) -> float:
    """|sqrt(v) - w slope / 2^(B + 17)| of `root_product` with slopes of B = `bits` bits, v <= 1 with 24 bits.

    Half the sag of the tangent in the middle of a segment, the cut of the offset to 2^-9 of it, and at B = 17 half a
    unit of the slope, 2^-17, times w < 2. The sum is found over all words: 0.515 / 2^15 at B = 17, 0.305 / 2^15 above.
    """
    return (0.52 if bits == 17 else 0.31) / 2**15


def reciprocal_product(q: ArrayLike) -> Floats:
    """Relative error of `arith.reciprocal_product` at q, 1/4 to 4, which is taken in the middle of its last bit.

    Half of what the tangent loses at a border of a segment, half a unit of the slope, half a unit of q, the cut of the
    product. 2^-17 at 1/4 and up to 2, 2^-15 at 4.
    """
    q = floats(q)
    return 2**-17 / (16 * q**2) + q**2 * 2**-19 + 2**-20 / q + q * 2**-24


def spread_chord(u: int) -> float:
    """Error of cos and sin of a turn-spread as `rational_fk2` reads them (odd integers of 2^-(U+1)), in units of 2^-U.

    Half the spacing of odd words 0.5, half the greatest sag (2^-18.5 of 1), one unit of knot and cut 1/8, the offset's
    cut 0.022 at U = 16. 0.824 at U = 16, 1.023 at U = 17.
    """
    return 0.5 + 2.0 ** (u - 18.5) + 0.125 + 0.022 * 2.0 ** (u - 16)


# rational: one joint


def rational_fk1(l1: float) -> float:
    """A coordinate: rounding 1/2, the cut of L1 w to 2^-5 times a slope of at most 2, and the root.

    As a distance at most 1 up to L1 = 2^14 (found: 0.95 over all 2^24 spreads there).
    """
    return 0.5 + 1 / 16 + root_product() * l1


RATIONAL_DIRECTION = 0.6 * 2.0**-14
"""Angle (rad) from a target to the nearest direction that rounds to the word of rational_ik1.

s = m^2 r: d theta = (dr / r) t / 2, t = m / M <= 1 but at near ties, q = M^2 (1 + t^2):

* sag of the chord h^2 / (8 q^2) t / 2, h = 2^-8: 0.65 * 2^-19;
* cut of q, 2^-17 around its middle, / q * t / 2: 0.87 * 2^-17;
* knot and product of the chord, 3 * 2^-17 (one is a cut), * q t / 2: 3 * 2^-17;
* cut of m^2 (at most 4/8 of 2^-27, times r): below 2^-15 at the first words past a border, where t is near 0.
"""


# rational: two and three joints


def rational_turn(u: int) -> float:
    """Error of a turn, by the length turned: a joint's two roots err like a vector, the wide one without its sag."""
    return math.hypot(spread_chord(u), spread_chord(u) - 0.16 * 2.0 ** (u - 16)) / 2**u


def rational_chain(p: Params, joints: int, l1: float, l2: float) -> float:
    """A coordinate of rational_fk2 and rational_fk3.

    Rounding 1/2. The joint that carries the whole length errs twice, as it is turned by both joints: L1 + 2 L2. The
    cuts of A and B, then of two products, are 2^-5 each. The third joint: one root more, two more cuts.
    At L1 + L2 = 2^14 found: 0.85 with two joints, 1.0 with three, and 1.02 as a distance with two.
    """
    bound = 0.5 + rational_turn(p["U"]) * (l1 + 2 * l2) + (2**0.5 + 2) / 32
    return bound if joints == 2 else bound + spread_chord(p["U"]) / 2 ** p["U"] * (l1 + l2) + 2 / 32


def rational_gap(p: Params, l1: int, l2: int) -> float:
    """Error of the quadrance (LSB^2) that cos theta2 of rational_ik2 and rational_ik3 stands for.

    The bits of the gap q - Q1 - Q2 that are shifted out and their half, 2 * 64 for long links; the rounding of cfg_r;
    the cut of c2 to 20 bits, both times 2 L1 L2.
    """
    words, double = rational.config(p, cfg_l1=l1, cfg_l2=l2), 2 * l1 * l2
    return (128 if words["cfg_e"] == 0 else 0) + double / words["cfg_r"] + double / 2**20


def rational_aim(rho: ArrayLike) -> Floats:
    """Tip error by the direction at distance `rho`: a and b to 2^-20 of q' >= 1/4, and u; 1/q' to 2^-17, with the cut
    of q' half more, times tan <= 2."""
    return floats(rho) * (1.5 * 2**-17 + 2 * 1.5 * 2**-17)


def rational_ik2(p: Params, l1: int, l2: int, rho: ArrayLike, n2: ArrayLike) -> Floats:
    """Tip of rational_ik2 for a target in reach.

    Parameters
    ----------
    p, l1, l2
        W = 16; links in LSB.
    rho, n2 : float arrays
        Distance of the target from the shoulder, LSB; |sin theta2|.

    Notes
    -----
    * The gap moves the tip by gap / (2 rho) along rho, and as much across: an error e of (k1, k2) turns the tip by e
      across and, since the spread takes the length of k for that of the tip, by tan <= 3^(1/2) times e along: 2 e
      together. Below rho^2 = 4 gap, near the shoulder, the direction is lost: the tip is within
      2 rho + gap^(1/2).
    * The root: twice `root_product` at 20 bits times L2; near the circles 1 - c2^2 has 24 bits for k2, and half a unit
      of joint 2's word no longer fits joint 1: at most L2 2^-11.5.
    * k1 and k2 have 3 fraction bits and a constant half behind them, and a one's complement, all of it twice.
    * `rational_aim`.
    """
    rho, gap = floats(rho), rational_gap(p, l1, l2)
    answered = np.sqrt(np.maximum(floats(n2) ** 2 - gap / (l1 * l2), 1e-18))
    root = l2 * (2 * root_product(20) + np.minimum(2**-11.5, 2**-24 / answered))
    cut = 2 * (2**0.5 / 16 + 1 / 16)
    return np.where(rho**2 < 4 * gap, 2 * rho + math.sqrt(gap), gap / rho) + root + cut + rational_aim(rho)


def rational_ik3(p: Params, l1: int, l2: int, target: ArrayLike, n2: ArrayLike) -> Floats:
    """Tip of rational_ik3 for targets (3, N) in reach: `rational_ik2` in the plane of the arm, rho and the yaw.

    rho: the chord of v <= 1/2, the cut of v to 24 bits, of rho to 3 fraction bits about a half, and to one after the
    shift by the target's redundant sign bits; it turns (rho, z) and stretches it, so it counts twice.
    """
    x, y, z = floats(target)
    rho, longest = np.hypot(x, y), np.max(np.abs([x, y, z]), axis=0)
    large = rho >= 4096
    off = 0.26 * np.where(large, 2, 1 / 8) + np.where(large, 1 / 32, 0) + 1 / 16
    off += 2.0 ** (np.ceil(np.log2(longest + 1)) - 16)
    return rational_ik2(p, l1, l2, np.sqrt(rho * rho + z * z), n2) + 2 * off + rational_aim(rho)


RATIONAL_NEAREST = 1.2 / 2**14
"""Tip of rational_ik2 from the nearest point of a target out of reach, by L1 + L2: the direction alone."""


# cordic


def _micro_rotations(p: Params) -> tuple[Floats, Floats, Floats]:
    """`cordic.turn` at every residual angle: angle (rad), what it multiplies with, radix-4 digits that are not 0.

    The second has the shape (rotations + 1, words), complex: the product of all that is still to come before each
    micro-rotation, and after the last.
    """
    rotations, digits = cordic.sizes(p["W"])
    bits, low = p["W"] + 4, max(rotations - 2, 0)
    words = np.arange(-1 << p["A"] - 3, 1 << p["A"] - 3)
    z = (words << p["W"] + 5 - p["A"]) + 2
    steps = []
    for i in range(1, rotations + 1):
        d, cut = np.where(z >= 0, 1, -1), max(i - 3, 0)
        steps.append(1 + 1j * d * 2.0**-i)
        z = wrap(z + ((cordic.angle(i, bits) >> cut ^ -(d > 0).astype(np.int64)) << cut) << 1, bits)
    tangent, rows = np.zeros(words.shape), np.zeros(words.shape)
    for k in range(digits):
        d = np.where(z >= 0, 1, -1)
        size = np.digitize((z ^ -(d < 0).astype(np.int64)) >> bits - 4, [1, 4])
        tangent, rows = tangent + d * size * 2.0 ** -(rotations + 1 + 2 * k), rows + (size > 0)
        term = cordic.angle(9, bits) << (size == 2) >> low ^ -(d > 0).astype(np.int64)
        z = wrap(z + np.where(size > 0, term << low, 0) << 2, bits)
    rest = np.stack([*np.cumprod(steps[::-1], axis=0)[::-1], np.ones(words.shape)]) * (1 + 1j * tangent)
    return 2 * math.pi * words / 2 ** p["A"], rest, rows


def cordic_rotate(p: Params) -> float:
    """A coordinate of cordic_rotate, the greatest over every angle word and every input; 1.47 at W = A = 16.

    For each word the digits are found, and with them the factor it really multiplies with; its distance from
    exp(j theta), along and across, times a full-scale output is the first part. The second: every shift and every
    minus is between 0 and 1 unit low (a unit is 2^-GUARD LSB), times the rotations that follow it. Rounding is 1/2.
    """
    theta, rest, rows = _micro_rotations(p)
    shifts = [shift for shift, _ in cordic.GAIN_DIGITS if shift < 10 or shift <= p["W"]]
    gain = sum((-1.0) ** minus * 2.0**-shift for shift, minus in cordic.GAIN_DIGITS if shift in shifts)
    sources = [gain * rest[0], *[rest[0]] * (len(shifts) - 1), *rest[1:]]  # complement, inexact digits, steps
    low_x = sum(-0.5 * (1 + 1j) * source for source in sources) - 0.5 * (1 + 1j) * rows  # the mean of all that is low
    spread = sum(0.5 * (np.abs(source.real) + np.abs(source.imag)) for source in sources) + 0.5 * rows
    drift = np.maximum(np.abs(low_x.real + cordic.ROUND - 16), np.abs(low_x.imag + cordic.ROUND - 16))
    off = gain * rest[0] / np.exp(1j * theta) - 1
    linear = 2.0 ** (p["W"] - 1) * (np.abs(off.real) + np.abs(off.imag))
    return float(np.max(0.5 + (spread + drift) / 2**cordic.GUARD + linear))


CORDIC_MAGNITUDE = 1.0
"""Length by cordic_vector: rounding 1/2; growth of the residual angle 2^-C and the constant 1.214509, 5e-6 of 46341;
nine shifts and the mirror, 7 units of 32."""


def cordic_angle(p: Params, guard: int, magnitude: bool) -> tuple[float, float]:
    """Angle of a vectoring engine: (LSB of 2^-A turn, LSB times length); the bound at a length is a + b / length.

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


# classic


def classic_fk1(p: Params, l1: float) -> float:
    """A coordinate and the distance of classic_fk1.

    Rounding 1/2; of L1, 0.17 * 2^-15 for the residual angle and the constants, 7.6e-6 for the tail's growth; twelve
    shifts and complements, 6 of 16 units at most beside their mean. 1 up to L1 = 2^(W-2), 1.6 at any length.
    """
    return 1.0 if l1 <= 1 << p["W"] - 2 else 1.6


def classic_ik1(p: Params, l1: float) -> float:
    """Tip of classic_ik1 on a link of `l1`: the law of `cordic_angle` without its half LSB of rounding to the word."""
    turn = 2 ** p["A"] / (2 * math.pi)
    fixed, slope = cordic_angle(p, classic.AIM_GUARD, False)
    return (fixed - 0.5) / turn * l1 + slope / turn


def _rotation(p: Params, factors: int = 0) -> tuple[float, Floats, float]:
    """Of `cordic.turn` from a start word, over every residual angle: relative error, mean and spread of the rounding.

    A start word, `factors` shifts of it, every micro-rotation and every digit leave x and y 0 to 1 unit low, times what
    still follows: the mean of that (complex, in units) and the most it may be off its mean in any direction.
    """
    theta, rest, rows = _micro_rotations(p)
    sources = rest[[0] * (1 + factors) + list(range(1, len(rest)))]
    mean = -0.5 * (1 + 1j) * (sources.sum(axis=0) + rows)
    spread = math.sqrt(0.5) * float(np.max(np.abs(sources).sum(axis=0) + rows))
    true = np.exp(1j * theta) / (math.sqrt(2) * classic.SHRINK)
    return np.abs(rest[0] / true - 1).max(), mean, spread


def classic_chain(p: Params, joints: int, l1: float, l2: float) -> float:
    """A coordinate of classic_fk2 or classic_fk3.

    A half for rounding; the relative errors of the rotations a link goes through; the roundings of all of them, those
    of the first turned by the second, off the mean that the constants take out; a unit for each start word.
    At most 2 (two joints) and 2.9 (three) up to L1 + L2 = 2^(W-2).
    """
    unit, gain = 2.0**-classic.CHAIN_GUARD, 1.1645
    off, mean, spread = _rotation(p)
    centre = mean.mean()
    turned = centre * gain * np.exp(2j * math.pi * np.linspace(-1, 1, mean.size) / 8) + mean
    drift = np.abs(turned + classic.CHAIN_ROUND[0] * (1 + 1j))
    drift = max(np.abs(drift.real).max(), np.abs(drift.imag).max()) + gain * np.abs(mean - centre).max()
    plane = off * (l1 + 2 * l2) + unit * (gain * spread + spread + drift + 4)
    if joints == 2:
        return float(plane + 0.5)
    off, mean, spread = _rotation(p, len(classic.YAW_FACTORS) + 1)
    flat = np.abs(mean + classic.CHAIN_ROUND[1] * (1 + 1j))
    return float(plane + off * (l1 + l2) + unit * (spread + flat.max()) + 0.5)


def _classic_passes(p: Params, grows: int, r: Floats, l1: int, l2: int) -> Floats:
    """Tip by the passes of the solver on a target at distance `r`, words included; see `classic_ik`."""
    turn = 2 ** p["A"] / (2 * math.pi)
    last, half, unit = p["W"] + 1, (p["W"] + 1) // 2, 2.0**-classic.SOLVE_ANGLE_GUARD
    bits = p["A"] + classic.SOLVE_ANGLE_GUARD
    angle = sum(abs((cordic.angle(i, bits) >> i) + 0.5 - math.atan(2.0**-i) * turn / unit) for i in range(last + 1))
    fixed = 2.0**-last + (angle + 1) * unit / turn + sum(8.0**-i for i in range(grows + 1, last + 1))
    slope = 2.5 * 2.0**-classic.SOLVE_GUARD + 2 * 2.0 ** (half // 2 - half) / 1.6468
    legs = slope + 2.0**-classic.SOLVE_GUARD
    at = np.clip(r, abs(l1 - l2), l1 + l2)
    stretch = (l1 + l2) / (2 * math.sqrt(l1 * l2))
    words = (0.5 / turn) * (at + l2)
    return words + fixed * (3 * at + 2 * l2) + slope * at / r + legs * (stretch + (at + 2 * l2) / (l1 + l2) * stretch)


def classic_ik(p: Params, joints: int, l1: int, l2: int, r: ArrayLike) -> Floats:
    """Tip of classic_ik2 or classic_ik3 from the nearest point in reach, half an LSB of rounding in each word included.

    Parameters
    ----------
    p, joints, l1, l2
        2 or 3 joints; links in LSB, neither 0.
    r : float array
        Distance of the target, > 0, reachable or not, LSB.

    Notes
    -----
    Every pass: residual angle, constants, early end of the growth, and rounding weighed by 1 / length, as in ik1. Half
    an LSB of a word acts at the tip by the distance (j1) and L2 (j2). phi and the yaw have the length of the target, h
    has 2 sqrt(L1 L2), d that times r / (L1 + L2); the roots are 1 unit low, which acts as a rounding does. Three
    joints: rounding of rho and K z, and the yaw's own pass and word.
    """
    r, half = floats(r), (p["W"] + 1) // 2
    if joints == 2:
        return _classic_passes(p, (p["W"] + 1) // 3 + 1, r, l1, l2)
    far = l1 + l2
    return _classic_passes(p, half, r, l1, l2) + _classic_passes(p, half, r, far // 2, far - far // 2) / 2 + 0.5


# table


def table_sine(p: Params, joints: int) -> float:
    """Error of a sine or cosine of table_fk1 to table_fk3, by every chord of their table.

    A chord errs by half its sag, (2 pi / 2^T)^2 / 16, either way; next to +-1, where no knot can lie outside the curve,
    by 1.5 of that. Knots are rounded up by less than a unit of 2^-K, and the completed root is truncated by less than
    one. Taken at 33 places of each chord.
    """
    k, t = table.sizes(p, joints)
    knots, place = codecs.sine_knots(k, t), np.linspace(0, 1, 33)[:, None]
    exact = np.sin(2 * np.pi / 2**t * (np.arange(2**t) + place)) * 2**k
    error = knots[:-1] + np.diff(knots) * place - exact
    return float(max(error.max(), 1 - error.min())) / 2**k


def table_forward(p: Params, joints: int, l1: float, l2: float) -> float:
    """A coordinate of table_fk1, table_fk2 and table_fk3; one joint moves the first link.

    Rounding 1/2 and a root for each link. Two joints: two products, each truncated by up to 2^-GUARD, and a constant
    2^-GUARD. Three: the same of rho, then a root of the yaw and one more product.
    """
    root = table_sine(p, joints)
    if joints == 1:
        return 0.5 + root * l1
    return 0.5 + (joints - 1) * (root * (l1 + l2) + 2.0 ** -table.GUARD)


def table_direction(p: Params) -> float:
    """Angle (rad) from a target to the nearest direction that rounds to the word of table_ik1.

    0.42 / 2^14 at A = 18. t = m / M errs by dt, the angle by dt / (1 + t^2):

    * half of what the tangent of 1/M loses at a border, t 2^-17: 2^-18;
    * half a unit of the slope s, 1 to 4: t 2^-16 / s / (1 + t^2), at most 2^-17 / s; the cut of m w to 19 bits,
      2^-19 s: together at most 1.25 * 2^-17, at either end of s;
    * half the sag of a chord of the arc tangent, 0.65 * 2^-18; the cut of its place, 2^-18;
    * rounding of a knot and the cut of the rise, a unit of 2^-(A+2) turn either way.
    """
    return 2.0**-18 * (1 + 2.5 + 0.65 + 1) + 2 * math.pi / 2.0 ** (p["A"] + 2)


# paper


def paper_forward(p: Params, joints: int, l1: float, l2: float) -> float:
    """Tip of paper_fk2 and paper_fk3, as a distance; shown at S = 8 and 24 of Q7.8.

    A spread that is off by e is an angle off by at most asin sqrt(e) (sin(a-b) sin(a+b) = e, and sin(a+b) >= sin(a-b)).
    s' is truncated by 2^-D; the complement 1 - s' by 2^-Q; d by less than 2^-N, so d^2 with its own truncation by
    3 * 2^-N. The quadrances Q2, acc^2 and (three joints) qa are each truncated by 2^-G, which moves a side by at most
    2^(-G/2) units; b is truncated by 2^(I-N) units. sqrt(n) for the coordinates' own truncation.
    """
    i = p["W"] - 1 - p["F"]
    n, g = max(p["S"] + 1, p["W"] - 1), min(p["S"], 27 - 2 * i)
    d, q = paper.DIGITS * -(-(p["S"] + 1) // paper.DIGITS), 2 * i + g
    share = 2.0 ** (-d / 2) + math.sqrt(3 * 2.0**-n) + 2.0 ** (-q / 2)
    units = (joints + 1) * 2.0 ** (-g / 2) + 2.0 ** (i - n)
    return (l1 + l2) * share + 2.0 ** p["F"] * units + math.sqrt(joints)


def paper_share(p: Params) -> int:
    """Digits D of a share (a quotient) in paper_ik2 and paper_ik3."""
    return p["R"] * -(-(p["S"] + 3) // p["R"])


def paper_inverse(p: Params, l1: float, l2: float) -> float:
    """Tip of paper_ik2 and paper_ik3; shown at S = 8 and 24 of Q7.8.

    By the rule of `paper_forward`: sa and s' are truncated by 2^-D, cos theta2 by 2^-D and so s2 by 2^(1-D), which
    turns joint 2 and beta alike; d as in the forward cores. Quadrances are cut to G bits (exact where G = 2F), Q2 to
    one DSP factor for its product.
    """
    i = p["W"] - 1 - p["F"]
    g, d = min(p["S"], 2 * p["F"]), paper_share(p)
    n, left = min(d, 26), min(2 * i + g, 27)
    cut = 0.0 if g == 2 * p["F"] else 2.0 ** (-g / 2)
    reach = l1 + l2
    spreads = (2 * reach + 2 * math.sqrt(2) * l2) * 2.0 ** (-d / 2) + math.sqrt(3) * reach * 2.0 ** (-n / 2)
    return spreads + 2.0 ** p["F"] * ((2 + 4 * math.sqrt(l2 / l1)) * cut + 2.0 ** ((2 * i - left) / 2))


def paper_nearest(p: Params) -> float:
    """Angle (rad) of joint 1 from the nearest point's, of a target out of reach: both shares and d by 2^-D or less."""
    return 4 * 2.0 ** (-paper_share(p) / 2)
