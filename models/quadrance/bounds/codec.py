"""Error bounds of rtl/codec and of the parts that its cores share with others."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
from numpy.typing import ArrayLike

from quadrance import codec_wide, codecs, conversion, truth
from quadrance.fixed import Ints, ints
from quadrance.truth import Floats, floats

Params = dict[str, int]


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


def spread_chord(u: int) -> float:
    """Error of cos and sin of a turn-spread as `rational_fk2` reads them (odd integers of 2^-(U+1)), in units of 2^-U.

    Half the spacing of odd words 0.5, half the greatest sag (2^-18.5 of 1), one unit of knot and cut 1/8, the offset's
    cut 0.022 at U = 16. 0.824 at U = 16, 1.023 at U = 17. Above U = 18 the greater one of `spread_roots`.
    """
    if u > 18:
        return max(spread_roots(u))
    return 0.5 + 2.0 ** (u - 18.5) + 0.125 + 0.022 * 2.0 ** (u - 16)


@cache
def spread_roots(u: int) -> tuple[float, float]:
    """Error of the minor and of the major root of spread_parabolas, in units of 2^-U.

    Half the spacing of odd words 0.5; and the segments with all that is truncated, at both ends of each 512th of every
    one, whose hump is constant; between these a product is cut by an eighth at most. The spread may be a place more
    than the one that is read. Segments 8 to 31 are those of ranges whose root is shifted by 6 and more.
    """
    at = np.arange(512) << codec_wide.PLACE - 9
    place = np.append(at, at + (1 << codec_wide.PLACE - 9) - 1)

    def worst(h: int, a: Ints, step: int) -> Floats:
        root = codec_wide.root(*codec_wide.root_segments(u, h), a[:, None], step, place)
        exact = [np.sqrt((a[:, None] + step * (place + more) / 2.0**codec_wide.PLACE) * 2.0**-h) * 2.0 ** (u + 3)
                 for more in (0, 1)]
        return np.max([np.abs(root - one) for one in exact], axis=(0, 2)) / 8 + 0.125

    minor, major = worst(10, np.arange(8, 512), 1), worst(9, np.arange(257, 513), -1)
    return 0.5 + float(max(minor[24:].max(), minor[:24].max() / 2**6)), 0.5 + float(major.max())


def _chords(knots: ArrayLike, exact: ArrayLike) -> float:
    """Greatest error of a root from chords, in units of the knots, its truncation by less than a unit included.

    `exact` are the values (..., chords, places) of the function at equally spaced places of each chord, ends included.
    """
    knots, place = floats(knots), np.linspace(0, 1, np.shape(exact)[-1])
    error = knots[..., :-1, None] + np.diff(knots)[..., None] * place - exact
    return float(max(error.max(), 1 - error.min()))


PLACES = np.linspace(0, 1, 33)
"""The error of a chord is taken here."""


@cache
def sine(k: int, t: int) -> float:
    """Error of a sine or cosine from a table of 2^t chords a turn with knots of k fraction bits, by every chord.

    A chord errs by half its sag, (2 pi / 2^t)^2 / 16, either way; next to +-1, where no knot can lie outside the curve,
    by 1.5 of that. Knots are rounded up by less than a unit of 2^-k, and the completed root is truncated by less than
    one.

    Above k = 21 by every 128th of a parabola, whose bend is that of its middle, and two truncations: 3.9 units.
    """
    if k > 21:
        return _bent_sine(k, t)
    exact = np.sin(2 * np.pi / 2**t * (np.arange(2**t)[:, None] + PLACES)) * 2**k
    return _chords(codecs.sine_knots(k, t), exact) / 2**k


def _bent_sine(k: int, t: int) -> float:
    """`sine` of parabolas. Within a 128th the line is 0.003 units from the curve."""
    knots, bends = map(floats, codec_wide.sine_segments(k, t))
    place = np.arange(128)
    fold = np.minimum(place, 127 - place)
    hump = (2 * fold + 1) * (255 - 2 * fold) >> 7
    lifted = knots[:-1, None] + bends[:, None] * hump / 2 ** (11 - k + 2 * t)
    error = [lifted + np.diff(knots)[:, None] * at - np.sin(2 * np.pi / 2**t * (np.arange(2**t)[:, None] + at)) * 2**k
             for at in (place / 128, (place + 1) / 128)]
    return float(max(np.max(error), 2 - np.min(error)) + 0.003) / 2**k


def angle_to_vector(p: Params) -> float:
    """A coordinate, LSB of 2^-U, by every chord of the table.

    Half its sag, (2 pi / 2^T)^2 / 16, either way, 1.5 of that next to +-1; knots to an eighth of an LSB, as the
    truncation. Rounding 1/2.
    """
    k, t = conversion.sizes(p)
    exact = np.sin(2 * np.pi / 2**t * (np.arange(2**t)[:, None] + PLACES)) * 2**k
    return 0.5 + _chords(codecs.sine_knots(k, t, 3) - 4, exact) / 8


def spread_to_vector(p: Params) -> float:
    """A coordinate, LSB of 2^-U: `root_product` with slopes of 20 bits, and rounding 1/2."""
    return 0.5 + root_product(20) * 2 ** p["U"]


def half_tangent_to_vector(p: Params) -> float:
    """A coordinate, LSB of 2^-U, by every chord of both functions, knots and truncation to an eighth of an LSB.

    A negative t is taken 2^-20 nearer to 0, which moves the sine, whose slope is 2 at most. Rounding 1/2.
    """
    k = p["U"] + 3
    exact = np.stack(truth.half_tangent_to_unit((np.arange(256)[:, None] + PLACES) / 256))[:, None] * 2**k
    return 0.5 + (_chords(conversion.half_tangent_knots(k) - 4, exact * [[[[1]], [[-1]]]]) + 2.0 ** (k - 19)) / 8


def _minor() -> Floats:
    """Sines (chords, places) that a unit vector's minor coordinate reaches, and on to the end of a chord."""
    return (np.arange(-187, 187)[:, None] + PLACES) / 256


def _arc(knots: ArrayLike, exact: ArrayLike, slope: float) -> float:
    """LSB of a word of 4 units, whose half is in the knots, as are half of a truncation and of a rounding.

    Rounding 1/2, the chord, and the one's complement of the sine, 2^-20, times `slope`, LSB.
    """
    return 0.5 + _chords(ints(knots)[..., 256 - 187:256 + 188] - 2, exact) / 4 + slope * 2**-20


def vector_to_angle(p: Params) -> float:
    """LSB of 2^-A turn, for the angle whose sine from the nearer axis is the minor coordinate as it is given.

    Half the sag of a chord of the arc sine, 2^-20 sin / cos^3; knots and truncation a unit of 2^-(A+2) either way.
    The angle is that of a rounded unit vector within 0.73 2^-U rad: half an LSB of the minor coordinate, divided by
    cos >= 0.687. It is that of a vector of length 1 + e within e tan.
    """
    turn = 2 ** p["A"] / (2 * math.pi)
    return _arc(conversion.arcsine_knots(p["A"] + 2), np.arcsin(_minor()) * 4 * turn, 1.46 * turn)


def vector_to_half_tangent(p: Params) -> float:
    """LSB of 2^-T, for the minor coordinate m as it is given; otherwise as `vector_to_angle`.

    Beside the x axis t = tan(asin(m) / 2), beside the y axis tan(pi / 4 + asin(m) / 2) up to 1, and from -1 on; slopes
    up to 1. Half a sag is 2^-20 times the curvature, up to 1.9.
    """
    half, axis = np.arcsin(_minor()) / 2, np.pi / 4
    beyond = np.where(half < 0, np.tan(half + axis) - 1, np.tan(half - axis) + 1)
    knots = np.stack([conversion.half_tangent_steps(p["T"] + 2, y) for y in (False, True)])
    return _arc(knots, np.stack([np.tan(half), beyond]) * 4 * 2 ** p["T"], 2 ** p["T"])


def unit_to_spread(p: Params) -> float:
    """LSB of 2^-S, for the square of the minor coordinate as it is given: rounding 1/2, and the one's complement of a
    factor, 2^-26, times the other one, 0.727."""
    return 0.5 + 0.727 * 2.0 ** (p["S"] - 26)


def angle_to_spread_turn(p: Params) -> float:
    """How far (rad) the angle whose spread is rounded is from the word of angle_to_spread.

    The sine by every chord, knots and truncation to 2^-18; the angle is off by that over cos 45 degrees.
    """
    exact = np.sin(2 * np.pi / 2048 * (np.arange(-256, 256)[:, None] + PLACES)) * 2**18
    return _chords(conversion.spread_sine_knots(), exact) * 2**-18 * math.sqrt(2)


def angle_to_spread(p: Params, theta: ArrayLike) -> Floats:
    """LSB of 2^-S at the angle of the word.

    `angle_to_spread_turn`, d, moves sin^2 by |sin 2 theta| d + d^2 at most; rounding and a one's complement as in
    `unit_to_spread`.
    """
    turn = angle_to_spread_turn(p)
    return (np.abs(np.sin(2 * floats(theta))) * turn + turn * turn) * 2.0 ** p["S"] + unit_to_spread(p)


def normalised(length: ArrayLike) -> Floats:
    """Length after one Newton step, y (3 - y^2) / 2: of 1 + e, 1 - 3/2 e^2 - 1/2 e^3."""
    y = floats(length)
    return y * (3 - y * y) / 2


def vector_normalise(length: ArrayLike) -> Floats:
    """A coordinate of vector_normalise, LSB of 2^-U, against c (3 - c^2 - n^2) / 2, for a vector of that length.

    Half a unit is put behind c, not behind the product, so rounding is 1/2 + |g - 1| / 2, g = (3 - c^2 - n^2) / 2. Both
    squares are cut to 2^-(U + 3), so g is off by half of that either way, times c.
    """
    y = floats(length)
    return 0.5 + np.abs(1 - y * y) / 4 + y / 16


@cache
def _arcsine(fraction: int) -> float:
    """Greatest error of the segments of the arc sine, rad: at 17 places of each where |m| <= 3/4, of a parabola at both
    ends of every step of its slope."""
    t = codec_wide.AHEAD.get(fraction, 5)
    i, steps = np.arange(-192, 192)[:, None] + 256, np.arange(1 << t - 1)
    place = np.append(steps, steps + 1) / steps.size
    if fraction in codec_wide.AHEAD:
        knots, bends = codec_wide.segments(40, fraction)
        ahead = (steps.size - 0.5 - np.append(steps, steps)) / steps.size
        moved = np.where(i < 256, -1, 1) * bends[i] * 2.0**14 * ahead
    else:
        knots, moved = codecs.arcsine_knots(40), 0 * place
    slope = knots[i + 1] - knots[i] - moved
    arc = (knots[i] + slope * place) * 2 * math.pi / 2.0**40
    return float(np.abs(arc - np.arcsin((i - 256 + place) / 256)).max())


def angle_of_vector(a: int, length: ArrayLike = 0.0, fraction: int = 20) -> Floats:
    """Angle (rad) by which angle_of_vector is off before rounding to a word, `length` what the vector's is off 1.

    The segments, half a sag of 2^-18 at most of straight ones; the last bit of m about a half, 2^-(fraction + 1), times
    the slope 1.52; knot and rise, each truncated by less than a unit of 2^-(a + 3) turn: half a unit either way, for
    their sum is whole; as much for the slope of a parabola. The arc sine takes the length for 1: tan <= 1.14 times it.
    """
    cut = math.pi / 2.0 ** (a + 3) * (2 if fraction in codec_wide.AHEAD else 1)
    return _arcsine(fraction) + 1.52 * 2.0 ** -(fraction + 1) + cut + 1.14 * floats(length)
