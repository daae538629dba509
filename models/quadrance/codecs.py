"""Joint words: what the words of each port type mean, and the bit-true models of rtl/codec.

A joint has one port, or two: cosine and sine of a vector. Its type (`rtl/cores.toml`) says how its words are encoded
and decoded and what rounding to them costs, here and nowhere else. Words go in and out by the names of the ports, as
they do in the models of the cores; `from_degrees`, `from_counts`, `convert` and their like take and give plain arrays.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import cache
from math import isqrt

import numpy as np
from numpy.typing import ArrayLike

from quadrance import fixed, truth
from quadrance.cores import TYPES, Joint, Port
from quadrance.fixed import Ints, ints
from quadrance.truth import Floats, floats

Params = dict[str, int]

# Joint words by port type: what a word stands for, in float64

QUARTER = truth.TURN / 4


def _vector_place(theta: Floats, width: int) -> Floats:
    border = np.rint(theta / QUARTER)
    return 2.0 ** (width - 1) * border + 2.0 ** (width - 2) * np.tan(theta - border * QUARTER)


def _vector_at(place: Floats, width: int) -> Floats:
    border = np.rint(place / 2.0 ** (width - 1))
    off = np.arctan((place - 2.0 ** (width - 1) * border) / 2.0 ** (width - 2))
    return np.mod(border * QUARTER + off, truth.TURN)


def _half_tangent_place(theta: Floats, width: int) -> Floats:
    half = np.rint(theta / np.pi)
    return 2.0 ** (width - 1) * half + 2.0 ** (width - 2) * np.tan((theta - half * np.pi) / 2)


def _half_tangent_at(place: Floats, width: int) -> Floats:
    half = np.rint(place / 2.0 ** (width - 1))
    return np.mod(half * np.pi + 2 * np.arctan((place - 2.0 ** (width - 1) * half) / 2.0 ** (width - 2)), truth.TURN)


Coding = tuple[Callable[[Floats, int], Floats], Callable[[Floats, int], Floats]]
# type: (place of an angle, angle of a place); both take the width of the port. A place is a real number that grows with
# the angle. Of a type of one word it is the word before rounding; of a vector it is where the direction leaves the
# square |c|, |n| <= 1, in LSB along its sides, from (1, 0) on: n beside the x axis, -c beside the y axis.
CODINGS: dict[str, Coding] = {
    "spread": (lambda theta, width: truth.angle_to_spread(theta, width - 2),
               lambda word, width: truth.spread_word_to_angle(word, width - 2)),
    "angle": (lambda theta, width: theta * (2.0**width / truth.TURN), truth.binary_word_to_angle),
    "vector": (_vector_place, _vector_at),
    "half_tangent": (_half_tangent_place, _half_tangent_at),
}


def _coding(joint: Joint) -> Coding:
    if (port := joint[0]).type not in CODINGS:
        raise ValueError(f"{port.name}: a port of type {port.type} is no joint word; types are {', '.join(CODINGS)}")
    return CODINGS[port.type]


def place(joint: Joint, theta: ArrayLike) -> Floats:
    """Places of angles (radians), real numbers modulo four `quadrant`; of a type of one word, the word unrounded."""
    return _coding(joint)[0](floats(theta), joint[0].width)


def at(joint: Joint, place: ArrayLike) -> Floats:
    """Angles (radians, in [0, 2 pi)) of places; the shape is kept."""
    return _coding(joint)[1](floats(place), joint[0].width)


def quadrant(joint: Joint) -> int:
    """Places from one quadrant border to the next."""
    return 1 << joint[0].width - (1 if len(joint) == 2 else 2)


def encode(joint: Joint, theta: ArrayLike) -> dict[str, Ints]:
    """Joint words nearest to angles.

    Parameters
    ----------
    joint : Joint
    theta : float array
        Radians, any turn.

    Returns
    -------
    int64 arrays of that shape by port name
        Words of the ports, signed where they are; error at most `half_step` radians.
    """
    if len(joint) == 1:
        return words_at(joint, np.floor(place(joint, theta) + 0.5))
    one = 2.0 ** (joint[0].width - 2)
    return {port.name: np.floor(one * part + 0.5).astype(np.int64) for port, part in zip(joint, truth.unit(theta))}


def words_at(joint: Joint, place: ArrayLike) -> dict[str, Ints]:
    """Joint words nearest to whole places, by port name."""
    if len(joint) == 2:
        return encode(joint, at(joint, place))
    return {port.name: fixed.wrap(place, port.width, port.signed) for port in joint}


def decode(joint: Joint, words: Mapping[str, ArrayLike]) -> Floats:
    """Angles (radians, in [0, 2 pi)) of joint words by port name, or of real numbers of their LSB; the shape is kept.

    A vector may have any length.
    """
    if len(joint) == 1:
        return at(joint, words[joint[0].name])
    c, n = (floats(words[port.name]) for port in joint)
    return np.mod(np.arctan2(n, c), truth.TURN)


def within_cell(joint: Joint, words: Mapping[str, ArrayLike], theta: ArrayLike) -> Floats:
    """The angle nearest to `theta` (in words) among those that round to these words: what of an answer is not rounding.

    A vector rounds half an LSB in each coordinate, whatever its length: it stands for all directions of its cell.
    """
    if len(joint) == 1:
        turn, word = 4.0 * quadrant(joint), floats(words[joint[0].name])
        off = np.mod(place(joint, theta) - word + turn / 2, turn) - turn / 2
        return at(joint, word + np.clip(off, -0.5, 0.5))
    c, n = (floats(words[port.name]) for port in joint)
    centre = np.arctan2(n, c)
    corners = [truth.difference(np.arctan2(n + dn, c + dc), centre) for dc in (-0.5, 0.5) for dn in (-0.5, 0.5)]
    off = np.clip(truth.difference(theta, centre), np.min(corners, axis=0), np.max(corners, axis=0))
    return np.mod(centre + off, truth.TURN)


def half_step(joint: Joint) -> float:
    """The most that rounding to words of this joint turns it, in radians.

    Half an LSB beside a quadrant border, where a type of one word is as coarse as it gets: asin 2^(-(S + 1) / 2) of a
    turn-spread, whose sin^2 is flat there (0.0099 degrees at S = 24), pi / 2^A of a binary angle, everywhere; 2 arctan
    2^-(T + 1) of a half-tangent, beside the x axis, and half of that beside the y axis (0.0009 degrees at T = 16). A
    vector loses half an LSB of both coordinates on the diagonals: asin (sqrt(1/2) 2^-U), 0.0006 degrees at U = 16.
    """
    return math.asin(math.sqrt(0.5) / 2.0 ** (joint[0].width - 2)) if len(joint) == 2 else float(at(joint, 0.5))


def coarsest(joint: Joint, off: Floats) -> Floats:
    """Places `off` of an LSB before and behind those words whose rounding turns the joint most; off < 1/2.

    Every quadrant border, of a half-tangent every second one; of a vector beside each diagonal a word (a, b) of nearly
    unit length, (a + off, b - off) and (a - off, b + off).
    """
    if len(joint) == 1:
        borders = (np.arange(4.0) * quadrant(joint))[::2 if joint[0].type == "half_tangent" else 1, None]
        return np.concatenate([borders - off, borders + off], axis=None)
    one = 2.0 ** (joint[0].width - 2)
    a = np.rint(one * math.sqrt(0.5)) + np.arange(-int(one) // 16, int(one) // 16 + 1)
    b = np.rint(np.sqrt(one**2 - (a + 0.5) ** 2) + 0.5)
    gap = np.abs(np.hypot(a + 0.5, b - 0.5) - one)
    best = np.argmin(gap)
    off = np.minimum(off, 0.5 - gap[best])
    clockwise = np.arctan2(b[best] - off, a[best] + off)
    turns = (np.arange(4) * QUARTER)[:, None]
    return np.mod(place(joint, np.concatenate([turns + clockwise, turns + QUARTER - clockwise], axis=None)),
                  4.0 * quadrant(joint))


def border_words(joint: Joint) -> dict[str, Ints]:
    """Words at every quadrant border, every power of two before and behind it, and two neighbours either way."""
    border = quadrant(joint)
    steps = np.array([0, *(1 << i for i in range(border.bit_length()))])
    near = np.concatenate([steps, -steps])[:, None] + np.arange(-2, 3)
    places = np.unique((np.arange(4)[:, None] * border + near.ravel()) % (4 * border))
    return words_at(joint, places)


# Plain words: an encoder's count, degrees or radians, and the words of any two types

Words = Ints | tuple[Ints, Ints]  # of a vector the pair (c, n)


def joint_of(kind: str, bits: int) -> Joint:
    """The ports of a joint word, as a core would have them.

    Parameters
    ----------
    kind : str
        "angle", "spread", "vector" or "half_tangent".
    bits : int
        A, S, U or T: the width of an angle, the fraction bits of the others.
    """
    if kind not in TYPES:
        raise ValueError(f"{kind} is no type of joint word; types are {', '.join(TYPES)}")
    letters, more, signed = TYPES[kind]
    return tuple(Port(letter, bits + more, signed, kind) for letter in letters)


def from_radians(kind: str, bits: int, theta: ArrayLike) -> Words:
    """Joint words nearest to angles; within `half_step(joint_of(kind, bits))` of them.

    Parameters
    ----------
    kind, bits
        As of `joint_of`.
    theta : float array
        Radians, any turn.

    Returns
    -------
    int64 array of that shape; of a vector the pair (c, n) of such arrays
    """
    words = tuple(encode(joint_of(kind, bits), theta).values())
    return words if len(words) > 1 else words[0]


def to_radians(kind: str, bits: int, words: ArrayLike | tuple[ArrayLike, ArrayLike]) -> Floats:
    """Angles in [0, 2 pi) of joint words, of a vector the pair (c, n), whose length does not matter."""
    joint = joint_of(kind, bits)
    return decode(joint, dict(zip((port.name for port in joint), words if len(joint) > 1 else (words,))))


def from_degrees(kind: str, bits: int, degrees: ArrayLike) -> Words:
    """As `from_radians`, from degrees of any turn."""
    return from_radians(kind, bits, np.radians(np.mod(floats(degrees), 360)))


def to_degrees(kind: str, bits: int, words: ArrayLike | tuple[ArrayLike, ArrayLike]) -> Floats:
    """As `to_radians`, in degrees, [0, 360)."""
    return np.degrees(to_radians(kind, bits, words))


def from_counts(kind: str, bits: int, count: ArrayLike, counts: int) -> Words:
    """Joint words nearest to an encoder's counts.

    Parameters
    ----------
    kind, bits
        As of `joint_of`.
    count : int array
        Of any turn and sign, 0 at the joint's zero.
    counts : int
        Counts of a full turn of the joint: four times the lines of a quadrature encoder, times the ratio of the gear.

    Returns
    -------
    As `from_radians`. An angle is exact in integers (ties upward): where `counts` is 2^A it is the count modulo a turn.
    """
    count = np.mod(ints(count), counts)
    if kind == "angle":
        return ints((count << bits + 1) + counts) // (2 * counts) & (1 << bits) - 1
    return from_radians(kind, bits, count * (truth.TURN / counts))


def to_counts(kind: str, bits: int, words: ArrayLike | tuple[ArrayLike, ArrayLike], counts: int) -> Ints:
    """An encoder's counts in [0, counts) nearest to joint words; as `from_counts`."""
    return np.floor(to_radians(kind, bits, words) * (counts / truth.TURN) + 0.5).astype(np.int64) % counts


def convert(kind: str, bits: int, words: ArrayLike | tuple[ArrayLike, ArrayLike], to: str, to_bits: int) -> Words:
    """Joint words of another type, nearest to what the words stand for.

    The codecs of rtl/codec answer the same within their bounds (`bounds.angle_to_vector` and so on), of them
    `vector_to_spread_iter` exactly but for ties; `conversion` has what each answers bit for bit. They take a vector for
    one of unit length; here it may have any length but 0.
    """
    return from_radians(to, to_bits, to_radians(kind, bits, words))


# Bit-true models of rtl/codec

@cache
def _knots(u: int, h: int) -> Ints:
    """``sqrt(a / 2^h)``, a = 0 ... 512, lifted by half the chord's sag (a >= 8), rounded up to a unit of 2^-(u+3)."""
    k, scale = u + 3, 2 * (u + 3) - h
    squares = [a << scale if a < 8 else ((32 * a * a + 1) << scale) // (32 * a) for a in range(1, 513)]
    return ints([0, *(min(isqrt(square) + 1, (1 << k) - 1) for square in squares)])


def spread_chords(p: Params, word: Ints) -> tuple[Ints, Ints]:
    """(cos, sin) of a turn-spread word as odd integers of 2^-(U+1), each within 0.83 / 2^U at U = 16.

    With f the fraction and v = min(f, 1 - f) the roots are those of v and 1 - v, on chords of 512 segments a
    range and of 256; 1 - f is the one's complement followed by ones.
    """
    s, u, d = p["S"], p["U"], 12
    word = ints(word)
    quadrant, f = word >> s, word & (1 << s) - 1
    fold = f >> s - 1
    v = ((f ^ -fold) & (1 << s - 1) - 1) << 54 - (s - 1) | -fold & (1 << 54 - (s - 1)) - 1  # 2 v, 54 bits
    minor, knots = np.zeros_like(v), _knots(u, 10)
    for shift in (0, 4, 8, 14, 20) if s > 24 else (0, 4, 8, 14):
        scaled = (v << shift | -fold & (1 << shift) - 1) & (1 << 54) - 1
        a, offset = scaled >> 45, scaled >> 45 - d & (1 << d) - 1
        root = knots[a] + ((knots[a + 1] - knots[a]) * offset >> d) >> 3 + shift // 2
        minor = np.where(v < 1 << 54 - shift, root, minor)
    knots, a, offset = _knots(u, 9), v >> 46, v >> 46 - d & (1 << d) - 1
    major = knots[512 - a] + ((knots[511 - a] - knots[512 - a]) * offset >> d) >> 3
    minor_n = fold == quadrant & 1
    c, n = 2 * np.where(minor_n, major, minor) + 1, 2 * np.where(minor_n, minor, major) + 1
    return np.where((quadrant ^ quadrant >> 1) & 1, -c, c), np.where(quadrant >> 1, -n, n)


def vector_to_spread(p: Params, *, in_c: Ints, in_n: Ints) -> dict[str, Ints]:
    """Turn-spread word of a direction, ``s = n^2 / (c^2 + n^2)`` to nearest; c = n = 0 holds the last word.

    Quadrant by the signs. Ties go up in the even quadrants and down in the odd ones, where 1 - s is the fraction.
    Error <= 1/2 LSB of the word (paper eq. 9).
    """
    c, n = np.broadcast_arrays(ints(in_c), ints(in_n))
    q, qn = c * c + n * n, n * n
    k = np.where(n < 0, np.where(c < 0, 2, 3), np.where(c < 0, 1, 0))
    most = (2 << p["S"]) - 1
    twice = np.minimum(quotient(qn, np.where(q == 0, 1, q), p["S"] + 1), most)
    twice = np.where(k % 2 == 1, most - twice, twice)
    word = (k << p["S"]) + (twice + 1 >> 1) & (4 << p["S"]) - 1
    return {"out_j": fixed.hold_last(word, q != 0), "out_status": (q == 0) * 2}


def quotient(numerator: Ints, divisor: Ints, bits: int) -> Ints:
    """``floor(numerator * 2^bits / divisor)`` for numerator <= divisor < 2^62, in steps that stay inside int64."""
    result, rem = numerator // divisor, numerator % divisor
    while bits:
        step = min(bits, 63 - int(np.max(divisor, initial=1)).bit_length())
        result = result << step | (rem << step) // divisor
        rem = (rem << step) % divisor
        bits -= step
    return result


@cache
def sine_knots(k: int, t: int, drop: int = 0) -> Ints:
    """``sin(2 pi i / 2^t)``, i = 0 ... 2^t, half a sag outside the curve, rounded up to a unit of 2^-k, 1 held.

    With `drop` 1 is 1, and half of 2^drop units are added. The integers of angle_chord.v, operation by operation.
    """
    one, quarter = 1 << 30, []
    for i in range((1 << t - 2) + 1):
        x = i * 3373259426 >> t - 1
        square = x * x >> 30
        s = one - square // 110
        for divisor in (72, 42, 20, 6):
            s = one - (square * s >> 30) // divisor
        s = x * s >> 30
        quarter.append(min(s + (s * 646814 >> 18 + 2 * t), one))
    rise = quarter + quarter[-2:0:-1]
    knots = ints([s + (1 << 30 - k) - 1 >> 30 - k for s in [*rise, *(-s for s in rise), 0]])
    return knots + (1 << drop - 1) if drop else np.minimum(knots, (1 << k) - 1)


def angle_chord(k: int, t: int, a: int, word: Ints, cosine: bool, drop: int = 0) -> Ints:
    """Sine or cosine of an a-bit binary angle in units of 2^-k, completed from one of the 2^t chords of a turn.

    With `drop` its lowest bits are to be dropped: half of the last bit kept is in it.
    """
    b, place = a - t, ints(word) + (cosine << a - 2) & (1 << a) - 1
    knots, i = sine_knots(k, t, drop), place >> b
    return knots[i] + ((knots[i + 1] - knots[i]) * (place & (1 << b) - 1) >> b)


@cache
def arc_knots(d: int) -> Ints:
    """``arctan(i / 128)`` in 2^-d turn, i = -256 ... 256, half a sag outside the curve; 3/4 of 4 units are half a word.

    The integers of angle_about_axis.v, operation by operation.
    """
    arc, found = 0, []
    for i in range(257):
        z = (i << 48) // (16384 + i * i) ** 2
        found.append((arc + z >> 14) * 683565276)
        z = (128 << 44) // (16384 + i * (i + 1))
        square = (z >> 14) * (z >> 14) >> 30
        arc += z - (z * square >> 30) // 3 + ((z * square >> 30) * square >> 30) // 5
    return ints([(3 << 62 - d) + s >> 62 - d for s in [-s for s in found[:0:-1]] + found])


def angle_about_axis(a: int, axis: Ints, tangent: Ints) -> Ints:
    """Binary angle of a bits: quarter turns and the arc tangent of tangent / 2^18, -2 to 2, nearest."""
    knots, i = arc_knots(a + 2), (tangent >> 11) + 256
    arc = knots[i] + ((knots[i + 1] - knots[i]) * (tangent & 0x7FF) >> 11)
    return (axis << a) + arc >> 2 & (1 << a) - 1


@cache
def arcsine_knots(d: int) -> Ints:
    """``arcsin(i / 256)`` in 2^-d turn, i = -256 ... 256, half a sag inside the curve, held beyond 224; with half a
    word of 8 units less half a unit, half of the two units that are truncated, half of the last bit of m.

    The integers of angle_of_vector.v, operation by operation.
    """
    arc, root, found = 0, 1 << 31, []
    for i in range(257):
        k = i if i < 224 else 223
        b = 2 * k + 1
        n = (1 << 18) - b * b
        for _ in range(3):
            root = root + (n << 44) // root >> 1
        rise = (1 << 63) // root << 4
        rise += (rise >> 8) * ((1 << 18) + 2 * b * b) // (6 * n) // n << 8
        found.append((arc - (k << 40) // ((65536 - k * k) * (root >> 23)) >> 14) * 683565276)
        arc += rise if i < 224 else 0
    half = (9 << 61 - d) + (683565276 << 9)
    return ints([half + s >> 62 - d for s in [-s for s in found[:0:-1]] + found])


def angle_of_vector(a: int, cosine: Ints, sine: Ints) -> Ints:
    """Binary angle of a bits of a unit vector of 20 fraction bits: of its sine, or of its cosine in [-3/4, 3/4)."""
    quarters = fixed.wrap(cosine >> 18, 4)
    far, back, under = (quarters < -3) | (quarters > 2), cosine < 0, sine < 0
    m = fixed.wrap(np.where(far, sine, cosine), 21)
    m = m ^ -ints(np.where(far, back, ~under))
    knots, i = arcsine_knots(a + 3), (m >> 12) + 256
    arc = knots[i] + ((knots[i + 1] - knots[i]) * (m & 0xFFF) >> 12)
    return (np.where(far, 2 * back, 1 + 2 * under) << a + 1) + arc >> 3 & (1 << a) - 1
