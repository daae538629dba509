"""Bit-true models of rtl/rational: turn-spreads in and out, unit vectors inside."""

from __future__ import annotations

from functools import cache

import numpy as np

from quadrance import arith, codecs
from quadrance.fixed import Ints, hold_last, ints, round_shift, saturate, wrap

Params = dict[str, int]


# One joint


def fk1(p: Params, *, in_j1: Ints, cfg_l1: Ints) -> dict[str, Ints]:
    """``x = L1 cos, y = L1 sin``, nearest (ties upward) and saturated.

    Each coordinate is within 1/2 + 1/16 + 0.52 L1 / 2^15 LSB, L1 in LSB.
    """
    s, spread = p["S"], ints(in_j1) & (1 << p["S"]) - 1
    odd, lower = ints(in_j1) >> s & 1, ints(in_j1) >> s + 1 & 1

    def coordinate(complement: Ints, negative: Ints) -> tuple[Ints, Ints]:
        root = arith.root_product(p, in_v=spread, in_not=complement)
        n = (ints(cfg_l1) * root["out_w"] >> 14) * 2 + 1
        value, over = saturate(round_shift(np.where(negative, -n, n) * root["out_slope"], 21), p["W"])
        return value, over

    x, over_x = coordinate(1 - odd, odd ^ lower)
    y, over_y = coordinate(odd, lower)
    return {"out_x": x, "out_y": y, "out_status": 4 * ints(over_x | over_y)}


@cache
def _reciprocal_slopes() -> Ints:
    """2^16 / t^2, t = (a + 1/2) / 256, as reciprocal_pair.v computes it; entry 0 is that of q = 2."""
    odd = (max(2 * a + 1, 129) for a in range(512))
    slopes = [((((2 * b * b + 1) * (512 * b - 1) << 22) // b**3 << 3) // (b * b) + 1) >> 1 for b in odd]
    return ints([1 << 15, *slopes[1:]])


def ik1(p: Params, *, in_x: Ints, in_y: Ints) -> dict[str, Ints]:
    """Turn-spread of the direction of (x, y), nearest (ties anticlockwise); the last one where x = y = 0.

    Direction within `bounds.RATIONAL_DIRECTION` of those that round to the word.
    """
    s = p["S"]
    x, y = (ints(word) << 16 - p["W"] for word in np.broadcast_arrays(in_x, in_y))
    zeros = _zeros(x, y)
    x, y = x << zeros, y << zeros
    long = (x < -(1 << 14)) | (x >= 1 << 14)  # x is the longer one in bits: the nearer axis is that of x
    m = np.where(long, y, x)
    q = (x * x >> 13) + (y * y >> 13)
    w = np.where(q >> 18, 1 << 16, (q >> 1) ^ 0xFF)
    u = m * np.where((x < 0) ^ (y < 0) ^ ~long, ~w, w) >> 7
    v = m * _reciprocal_slopes()[q >> 9 & 0x1FF] >> 7  # q = 2 wraps to 0
    spread = (u * v >> 47 - s) + 1 >> 1
    axis = np.where(long, 2 * (x < 0), 1 + 2 * (y < 0))
    word = (axis << s) + spread & (4 << s) - 1
    zero = (x == 0) & (y == 0)
    return {"out_j1": hold_last(word, ~zero), "out_status": 2 * ints(zero)}


# Two and three joints


def _turn(p: Params, x: Ints, y: Ints, c: Ints, n: Ints) -> tuple[Ints, Ints]:
    """(x, y) turned by the direction (c, n); every product is cut to the fraction of x and y."""
    u = p["U"] + 1
    return (x * c >> u) + (y * -n >> u), (x * n >> u) + (y * c >> u)


def _chain(p: Params, words: tuple[Ints, ...], cfg_l1: Ints, cfg_l2: Ints) -> tuple[Ints, ...]:
    """Tip of the chain with 5 fraction bits below the coordinate's LSB: kernel_chain.v."""
    u, g = p["U"] + 1, 5
    l1, l2 = ints(cfg_l1) << g, ints(cfg_l2) << g
    c, n = codecs.spread_chords(p, words[1])
    x, y = _turn(p, l1 + (l2 * c >> u), l2 * n >> u, *codecs.spread_chords(p, words[0]))
    return (x, y) if len(words) == 2 else (*_turn(p, x, ints(0), *codecs.spread_chords(p, words[2])), y)


def _coordinates(p: Params, axes: str, exact: tuple[Ints, ...]) -> dict[str, Ints]:
    """Nearest coordinates (ties upward), saturated, and the overflow bit."""
    pairs = [saturate(round_shift(value, 5), p["W"]) for value in exact]
    over = np.any(np.broadcast_arrays(*(over for _, over in pairs)), axis=0)
    return {f"out_{axis}": value for axis, (value, _) in zip(axes, pairs)} | {"out_status": 4 * ints(over)}


def fk2(p: Params, *, in_j1: Ints, in_j2: Ints, cfg_l1: Ints, cfg_l2: Ints) -> dict[str, Ints]:
    """``x = A c1 - B n1, y = A n1 + B c1`` with ``A = L1 + L2 c2, B = L2 n2``, nearest and saturated."""
    return _coordinates(p, "xy", _chain(p, (in_j1, in_j2), cfg_l1, cfg_l2))


def fk3(p: Params, *, in_j1: Ints, in_j2: Ints, in_j3: Ints, cfg_l1: Ints, cfg_l2: Ints) -> dict[str, Ints]:
    """`fk2` in the plane of the arm, (rho, z), then ``x = rho c3, y = rho n3``; rho keeps its sign and its fraction."""
    return _coordinates(p, "xyz", _chain(p, (in_j1, in_j2, in_j3), cfg_l1, cfg_l2))


# Two and three joints, inverse


def config(p: Params, *, cfg_l1: int, cfg_l2: int) -> dict[str, int]:
    """Words that the inverse cores want besides the lengths, all of lengths aligned to 16 bits.

    `cfg_e` says by how many bits the gap q - Q1 - Q2 is shifted, 7 - 8 e to the right; `cfg_q` is Q1 + Q2 less the
    half that rounds this shift; `cfg_r` is 2^(44 + 7 - 8 e) / (2 L1 L2 + half), always less: a point in reach,
    borders included, never seems out of it.
    """
    l1, l2 = (length << 16 - p["W"] for length in (cfg_l1, cfg_l2))
    double = 2 * l1 * l2
    e = 0 if double >= 1 << 25 else 1 if double >= 1 << 17 else 2 if double >= 1 << 9 else 3
    half = 64 if e == 0 else 0
    ratio = ((1 << 51 - 8 * e) - 1) // max(double + half, 1)
    return {"cfg_q": l1 * l1 + l2 * l2 - half, "cfg_r": min(ratio, (1 << 26) - 1), "cfg_e": e}


def _about_axis(s: int, axis: Ints, negative: Ints, product: Ints) -> Ints:
    """Turn-spread word of the axis plus or minus a spread of 40 fraction bits; nearest, ties away from the axis."""
    spread = ((product & (1 << 41) - 1) >> 39 - s) + 1 >> 1
    return (axis << s) + np.where(negative, -spread, spread) & (4 << s) - 1


def _zeros(*words: Ints) -> Ints:
    """Sign bits that all of these 16-bit words can spare."""
    either = np.bitwise_or.reduce([word ^ word >> 63 for word in words])
    return 15 - np.ceil(np.log2(either + 1)).astype(np.int64)


def _direction(p: Params, b: Ints, a: Ints, qs: Ints, halfway: Ints) -> Ints:
    """Turn-spread word of the direction (b, a), 1.0 is 2^20: (m / q)^2, m^2 / q where `halfway`; m the smaller one."""
    long = ((a ^ a >> 63) >> 14 & 0xFF) <= (qs >> 14 & 0x7F)
    m = np.where(long, a, b)
    u = wrap(m * arith.reciprocal_product(qs) >> 24, 27)
    axis = np.where(long, 2 * (b < 0), 1 + 2 * (a < 0))
    return _about_axis(p["S"], axis, (a < 0) ^ (b < 0) ^ ~long, u * np.where(halfway, m, u))


def _elbow(p: Params, x: Ints, y: Ints, more: int, k: Ints, qs: Ints, gap: Ints, elbow: Ints, l1: Ints, l2: Ints,
           cfg_r: Ints, cfg_e: Ints) -> tuple[Ints, Ints, Ints]:
    """(j1, j2, unreachable) of the target (x, y) with `more` fraction bits, already shifted by k."""
    n = np.where(cfg_e == 0, gap >> 7, gap << np.maximum(8 * cfg_e - 7, 0))
    far = (n < -(1 << 26)) | (n >= 1 << 26)
    c2 = np.where(far, 0, n) * cfg_r >> 24
    clamped = far | (c2 < -(1 << 20)) | (c2 >= 1 << 20)
    short = gap < 0
    c2 = np.where(clamped, np.where(short, -1, 1) << 20, c2)
    square = c2 * c2
    j2 = _about_axis(p["S"], 1 + 2 * elbow, short == (elbow != 0), square)

    root = arith.root_product({"S": 24, "B": 20}, in_v=square >> 16 & 0xFFFFFF, in_not=ints(1))
    k1 = (l1 << 3) + (c2 * l2 >> 17)
    k2 = (root["out_w"] * l2 >> 9) * root["out_slope"] >> 25
    one = np.where(k1 < 0, -1, 1) << 19
    k1, k2 = (wrap((2 * word + 1) << k, 21) for word in (k1, k2))
    k1, k2 = np.where(clamped, one, k1), np.where(square >> 40, 0, k2)
    b = wrap((k1 * x >> 4 + more) + ((k2 ^ -elbow) * y >> 4 + more), 33) >> 10
    a = wrap((k1 * y >> 4 + more) + ((k2 ^ elbow - 1) * x >> 4 + more), 33) >> 10
    return _direction(p, b, a, qs, clamped), j2, clamped


def ik2(p: Params, *, in_x: Ints, in_y: Ints, in_elbow: Ints, cfg_l1: Ints, cfg_l2: Ints, cfg_q: Ints, cfg_r: Ints,
        cfg_e: Ints) -> dict[str, Ints]:
    """Joints of the tip (x, y), of the nearest point of the annulus where it is out of reach."""
    x, y, elbow, l1, l2, cfg_q, cfg_r, cfg_e = (ints(word) for word in np.broadcast_arrays(
        in_x, in_y, in_elbow, cfg_l1, cfg_l2, cfg_q, cfg_r, cfg_e))
    x, y, l1, l2 = (word << 16 - p["W"] for word in (x, y, l1, l2))
    k, zero, gap = _zeros(x, y), (x == 0) & (y == 0), x * x + y * y - cfg_q
    x, y = x << k, y << k
    qs = x * x + y * y >> 11
    j1, j2, clamped = _elbow(p, x, y, 0, k, qs, gap, elbow, l1, l2, cfg_r, cfg_e)
    return {"out_j1": hold_last(j1, ~zero), "out_j2": j2, "out_status": ints(clamped) + 2 * ints(zero)}


def ik3(p: Params, *, in_x: Ints, in_y: Ints, in_z: Ints, in_elbow: Ints, cfg_l1: Ints, cfg_l2: Ints, cfg_q: Ints,
        cfg_r: Ints, cfg_e: Ints) -> dict[str, Ints]:
    """Yaw of (x, y), then `ik2` on (rho, z), rho = sqrt(x^2 + y^2)."""
    x, y, z, elbow, l1, l2, cfg_q, cfg_r, cfg_e = (ints(word) for word in np.broadcast_arrays(
        in_x, in_y, in_z, in_elbow, cfg_l1, cfg_l2, cfg_q, cfg_r, cfg_e))
    x, y, z, l1, l2 = (word << 16 - p["W"] for word in (x, y, z, l1, l2))
    square, near, k, zero = x * x + y * y, _zeros(x, y), _zeros(x, y, z), (x == 0) & (y == 0)
    gap, large = square + z * z - cfg_q, square >= 1 << 24
    x, y, z = x << near, y << near, z << k
    qs = x * x + y * y >> 11
    j3 = _direction(p, x << 5, y << 5, qs, ints(1))
    root = arith.root_product({"S": 24, "B": 20}, in_v=np.where(large, square >> 8, square), in_not=ints(0))
    rho = (root["out_w"] << np.where(large, 7, 3)) * (root["out_slope"] << 2) >> 27  # 3 fraction bits
    fine = (2 * rho + 1) << k
    rho = fine >> 3  # 1 fraction bit
    qs = (rho * fine >> 5) + z * z >> 11
    j1, j2, clamped = _elbow(p, rho, z << 1, 1, k, qs, gap, elbow, l1, l2, cfg_r, cfg_e)
    return {"out_j1": hold_last(j1, ~zero | (z != 0)), "out_j2": j2, "out_j3": hold_last(j3, ~zero),
            "out_status": ints(clamped) + 2 * ints(zero)}
