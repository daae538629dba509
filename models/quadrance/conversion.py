"""Bit-true models of the stream codecs of rtl/codec: joint words of one type to those of another.

`codecs` says what the words mean and converts them in float64, to nearest; these are the circuits, integer by integer.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from quadrance import arith, codecs
from quadrance.fixed import Ints, hold_last, ints, wrap

Params = dict[str, int]


# To a unit vector


def sizes(p: Params) -> tuple[int, int]:
    """(K, T) of angle_to_vector: fraction bits of a root, address bits of its table."""
    return p["U"] + 3, min((p["U"] + 5) // 2, p["A"] - 1)


def angle_to_vector(p: Params, *, in_j: Ints) -> dict[str, Ints]:
    """``c = cos j, n = sin j`` by chords, nearest."""
    k, t = sizes(p)
    c, n = (codecs.angle_chord(k, t, p["A"], in_j, cosine, drop=3) >> 3 for cosine in (True, False))
    return {"out_c": c, "out_n": n}


def spread_to_vector(p: Params, *, in_j: Ints) -> dict[str, Ints]:
    """``|c| = sqrt(1 - s), |n| = sqrt(s)``, each root a product, nearest (ties away from 0)."""
    word, s, u = ints(in_j), p["S"], p["U"]
    quadrant, v = word >> s, word & (1 << s) - 1
    answer = {}
    odd, below = quadrant & 1, quadrant >> 1
    for name, swap, negative in (("c", 1 - odd, odd ^ below), ("n", odd, below)):
        root = arith.root_product({"S": s, "B": 20}, in_v=v, in_not=swap)
        size = (root["out_w"] * root["out_slope"] >> 36 - u) + 1 >> 1
        answer[f"out_{name}"] = np.where(negative, -size, size)
    return answer


@cache
def half_tangent_knots(k: int) -> Ints:
    """(sine or cosine, sign, 257) knots of half_tangent_to_vector.v, operation by operation; 2^-k."""
    table = np.zeros((2, 2, 257), dtype=np.int64)
    for i in range(257):
        q = 65536 + i * i
        cube = q**3 >> 32
        sine = (i << 39) // q + (i * (196608 - i * i) << 4) // cube
        lift = (abs(65536 - 3 * i * i) << 12) // cube
        cosine = (65536 - i * i << 30) // q + (lift if 3 * i * i < 65536 else -lift)
        for kind, value in enumerate((cosine, sine)):
            for sign, signed in enumerate((min(value, 1 << 30), -min(value, 1 << 30))):
                table[kind, sign, i] = (signed + (1 << 30 - k) - 1 >> 30 - k) + 4
    return table


def half_tangent_to_vector(p: Params, *, in_j: Ints) -> dict[str, Ints]:
    """``c = +-(1 - t^2) / (1 + t^2), n = +-2 |t| / (1 + t^2)`` by chords, nearest."""
    word, t = ints(in_j), p["T"]
    below, half = word >> t & 1, word >> t + 1 & 1
    size = ((word & (1 << t) - 1) << 20 - t ^ -below) & 0xFFFFF
    i, place, knots = size >> 12, size & 0xFFF, half_tangent_knots(p["U"] + 3)
    answer = {}
    for kind, (name, negative) in enumerate((("c", half ^ below), ("n", half))):
        knot = knots[kind, negative, i]
        answer[f"out_{name}"] = knot + ((knots[kind, negative, i + 1] - knot) * place >> 12) >> 3
    return answer


# From a unit vector


def nearest_axis(u: int, extra: int, c: Ints, n: Ints) -> tuple[Ints, Ints, Ints, Ints]:
    """(none, axis, minor, sine) of nearest_axis.v; the sine has `extra` further bits."""
    size = wrap(n ^ n >> 63, u + 1, signed=False) >> u - 4
    near_x = size < 11
    none = near_x & ((c >> u - 1 == 0) | (c >> u - 1 == -1))
    axis = np.where(near_x, 2 * (c < 0), 1 + 2 * (n < 0))
    minor, turned = np.where(near_x, n, c), np.where(near_x, c < 0, n >= 0)
    return none, axis, minor, minor << extra ^ -ints(turned)


def _held(word: Ints, none: Ints) -> dict[str, Ints]:
    return {"out_j": hold_last(word, ~none), "out_status": 2 * ints(none)}


def vector_to_spread(p: Params, *, in_c: Ints, in_n: Ints) -> dict[str, Ints]:
    """Axis and the signed square of the minor coordinate, nearest (ties upward)."""
    u, s, extra = p["U"], p["S"], 26 - p["U"]
    none, axis, minor, sine = nearest_axis(u, extra, *np.broadcast_arrays(ints(in_c), ints(in_n)))
    sine, minor = wrap(sine, 27), wrap(minor, u + 1)
    square = minor * wrap(minor << extra ^ sine >> 63, 27)
    word = (axis << s) + ((wrap(square, 2 * u + extra + 1) >> 2 * u + extra - s - 1) + 1 >> 1)
    return _held(word & (4 << s) - 1, none)


LAST = 190  # in 1/256: a unit vector's minor coordinate is below 0.727


@cache
def _cosines() -> list[tuple[int, int]]:
    """(i, 2^30 sqrt(1 - (i / 256)^2)), i = 0 ... 190, each by four steps of Newton's rule from the one before.

    Then the last, as far as the table goes.
    """
    root, found = 1 << 30, []
    for i in range(LAST + 1):
        square = 65536 - i * i << 44
        for _ in range(4):
            root = root + square // root >> 1
        found.append((i, root))
    return found + [found[-1]] * (256 - LAST)


def _odd(half: list[int], shift: int) -> Ints:
    """Knots -256 ... 256 of an odd function, cut by `shift` bits, with half a word of 4 units and half a truncation."""
    return ints([(3 << shift) + part >> shift for part in [-part for part in half[:0:-1]] + half])


@cache
def arcsine_knots(d: int) -> Ints:
    """``arcsin(i / 256)`` in 2^-d turn, i = -256 ... 256, half a sag inside the curve; as arcsine_chords.v."""
    half = []
    for i, root in _cosines():
        t = (i << 52) // ((1 << 30) + root)
        arc = 0
        for k in range(27, 0, -2):
            arc = (1 << 30) // k - ((t * t >> 30) * arc >> 30)
        arc = (t * arc >> 29) - (i << 32) // ((root * root >> 30) * root >> 30)
        half.append(arc * 683565276)
    return _odd(half, 62 - d)


@cache
def half_tangent_steps(d: int, y: bool) -> Ints:
    """What ``arcsin(i / 256)`` adds to the half-tangent of an axis, in 2^-d, i = -256 ... 256; as
    vector_to_half_tangent.v."""
    half = [0]
    for i, root in _cosines()[1:]:
        cube = (root * root >> 30) * root >> 30
        if y:
            cube = cube * (256 + i) >> 8
            lift = (abs(256 - 2 * i) << 32) // cube
            half.append((1 << 30) - (root << 8) // (256 + i) + (lift if i < 128 else -lift))
        else:
            t = (i << 52) // ((1 << 30) + root)
            half.append(t - (t >> 20) * ((1 << 30) + 2 * root) // (cube * ((1 << 30) + root) >> 30))
    return _odd(half, 30 - d)


def _about_axis(bits: int, axis: Ints, sine: Ints, pick: Ints, knots: Ints) -> Ints:
    """Word of `bits` from the chord of `sine` (u12 below its address) in the table `knots[pick]`."""
    i = (wrap(sine, 21) >> 12) + 256
    knot = knots[pick, i]
    part = knot + ((knots[pick, i + 1] - knot) * (sine & 0xFFF) >> 12)
    return (axis << bits) + part >> 2 & (1 << bits) - 1


def vector_to_angle(p: Params, *, in_c: Ints, in_n: Ints) -> dict[str, Ints]:
    """Axis and the arc sine of the minor coordinate, nearest."""
    none, axis, _, sine = nearest_axis(p["U"], 20 - p["U"], *np.broadcast_arrays(ints(in_c), ints(in_n)))
    return _held(_about_axis(p["A"], axis, sine, 0 * axis, arcsine_knots(p["A"] + 2)[None]), none)


def vector_to_half_tangent(p: Params, *, in_c: Ints, in_n: Ints) -> dict[str, Ints]:
    """Axis and what the minor coordinate adds to its half-tangent, nearest."""
    none, axis, _, sine = nearest_axis(p["U"], 20 - p["U"], *np.broadcast_arrays(ints(in_c), ints(in_n)))
    knots = np.stack([half_tangent_steps(p["T"] + 2, y) for y in (False, True)])
    return _held(_about_axis(p["T"] + 2, axis, sine, axis & 1, knots), none)


def vector_normalise(p: Params, *, in_c: Ints, in_n: Ints) -> dict[str, Ints]:
    """``(c, n) (3 - c^2 - n^2) / 2``, nearest for vectors of nearly unit length."""
    u = p["U"]
    c, n = np.broadcast_arrays(ints(in_c), ints(in_n))
    cut = u - 3
    g = (3 << u + 3) - (c * c >> cut) - (n * n >> cut) - 1
    none = (c == 0) & (n == 0) | (g < 0)
    c, n = ((2 * part + 1) * g >> u + 5 for part in (c, n))
    return {"out_c": hold_last(c, ~none, 1 << u), "out_n": hold_last(n, ~none), "out_status": 2 * ints(none)}


# Between two words


@cache
def spread_sine_knots() -> Ints:
    """``sin(2 pi i / 2048)``, i = -256 ... 256, in 2^-18, half a sag outside the curve, rounded up; as
    angle_to_spread.v."""
    half = []
    for i in range(257):
        x = i * 3373259426 >> 10
        square, s = x * x >> 30, (1 << 30) - (x * x >> 30) // 72
        for divisor in (42, 20, 6):
            s = (1 << 30) - (square * s >> 30) // divisor
        s = x * s >> 30
        half.append(s + (s * 646814 >> 40))
    return ints([s + 4095 >> 12 for s in [-s for s in half[:0:-1]] + half])


def angle_to_spread(p: Params, *, in_j: Ints) -> dict[str, Ints]:
    """Axis and the signed square of the sine from there, nearest (ties upward)."""
    a, s = p["A"], p["S"]
    j, knots = ints(in_j), spread_sine_knots()
    axis = (j >> a - 3) + 1 >> 1 & 3
    off, bits = wrap(j, a - 2), a - 11
    i = (off >> bits) + 256
    sine = knots[i] + ((knots[i + 1] - knots[i]) * (off & (1 << bits) - 1) >> bits)
    square = sine * (sine << 8 ^ sine >> 63)
    return {"out_j": (axis << s) + ((square >> 43 - s) + 1 >> 1) & (4 << s) - 1}
