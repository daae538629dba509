"""Bit-true models of rtl/rational: turn-spreads in and out, unit vectors inside."""

from __future__ import annotations

from functools import cache

import numpy as np

from quadrance import arith, codec_wide, codecs, kernel_vector_solve, kernel_vector_wide
from quadrance.fixed import Ints, hold_last, ints, round_shift, saturate, wrap
from quadrance.kernel_vector_wide import form
from quadrance.vector import config

# config: words of the inverse cores beside the lengths
__all__ = ["config", "fk1", "fk2", "fk3", "ik1", "ik2", "ik3", "reciprocal_pair"]

Params = dict[str, int]


# One joint


def fk1(p: Params, *, in_j1: Ints, cfg_l1: Ints) -> dict[str, Ints]:
    """``x = L1 cos, y = L1 sin``, nearest (ties upward) and saturated.

    Each coordinate is within 1/2 + 1/16 + 0.52 L1 / 2^15 LSB, L1 in LSB; with W above 18 see `bounds.rational.fk1`.
    """
    if p["W"] > 18:
        p = p | {"U": p["W"]}
        return _coordinates(p, "xy", _turn(p, ints(cfg_l1) << 5, ints(0), *_roots(p, in_j1)))
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


def _zeros(*words: Ints) -> Ints:
    """Sign bits that all of these 16-bit words can spare."""
    either = np.bitwise_or.reduce([word ^ word >> 63 for word in words])
    return 15 - np.ceil(np.log2(either + 1)).astype(np.int64)


@cache
def _reciprocal_slopes() -> Ints:
    """2^16 / t^2, t = (a + 1/2) / 256, as reciprocal_pair.v computes it; entry 0 is that of q = 2."""
    odd = (max(2 * a + 1, 129) for a in range(512))
    slopes = [((((2 * b * b + 1) * (512 * b - 1) << 22) // b**3 << 3) // (b * b) + 1) >> 1 for b in odd]
    return ints([1 << 15, *slopes[1:]])


def reciprocal_pair(q: Ints) -> tuple[Ints, Ints]:
    """Both factors of 1/q, by 2^32, of a word q of 17 fraction bits from 1/4 to 2, as reciprocal_pair.v has them."""
    return np.where(q >> 18, 1 << 16, (q >> 1) ^ 0xFF), _reciprocal_slopes()[q >> 9 & 0x1FF]  # q = 2 wraps to 0


def ik1(p: Params, *, in_x: Ints, in_y: Ints) -> dict[str, Ints]:
    """Turn-spread of the direction of (x, y), nearest; the last one where x = y = 0.

    Direction within `bounds.rational.direction` of those that round to the word.
    """
    f = form(p)
    x, y = (ints(word) << f.bits - p["W"] for word in np.broadcast_arrays(in_x, in_y))
    zero = (x == 0) & (y == 0)
    word = _short(p, x, y) if f.bits == 16 else _spread(p, *kernel_vector_wide.aim(f, x, y))
    return {"out_j1": hold_last(word, ~zero), "out_status": 2 * ints(zero)}


def _short(p: Params, x: Ints, y: Ints) -> Ints:
    """The direction of aligned words of 16 bits, by a quotient; ties anticlockwise."""
    s, zeros = p["S"], _zeros(x, y)
    x, y = x << zeros, y << zeros
    long = (x < -(1 << 14)) | (x >= 1 << 14)  # x is the longer one in bits: the nearer axis is that of x
    m = np.where(long, y, x)
    q = (x * x >> 13) + (y * y >> 13)
    w, slope = reciprocal_pair(q)
    u = m * np.where((x < 0) ^ (y < 0) ^ ~long, ~w, w) >> 7
    v = m * slope >> 7
    spread = (u * v >> 47 - s) + 1 >> 1
    axis = np.where(long, 2 * (x < 0), 1 + 2 * (y < 0))
    return (axis << s) + spread & (4 << s) - 1


def spread_of_vector(s: int, cosine: Ints, sine: Ints, fraction: int) -> Ints:
    """Turn-spread of s bits of a unit vector: by the square of its sine, or of its cosine in [-3/4, 3/4); ties towards
    the axis."""
    quarters = wrap(cosine >> fraction - 2, 4)
    far, back, under = (quarters < -3) | (quarters > 2), cosine < 0, sine < 0
    m = wrap(np.where(far, sine, cosine), fraction + 1)
    square = m * ~m ^ -ints(far == (back == under))  # less the square of the middle of m, or that square less one
    return (np.where(far, 2 * back, 1 + 2 * under) << s) + ((square >> 2 * fraction - 1 - s) + 1 >> 1) & (4 << s) - 1


def _spread(p: Params, c: Ints, n: Ints) -> Ints:
    """The word of a joint of kernel_vector_wide, of products for cosine and sine."""
    f = form(p)
    cut = 2 * f.fraction - 3 - f.bits
    return spread_of_vector(p["S"], c >> cut, n >> cut, f.bits + 2)


# Two and three joints


def _turn(p: Params, x: Ints, y: Ints, c: Ints, n: Ints) -> tuple[Ints, Ints]:
    """(x, y) turned by the direction (c, n); every product is cut to the fraction of x and y."""
    u = p["U"] + 1
    return (x * c >> u) + (y * -n >> u), (x * n >> u) + (y * c >> u)


def _roots(p: Params, word: Ints) -> tuple[Ints, Ints]:
    """(cos, sin) of a joint word, odd integers of 2^-(U + 1)."""
    return codecs.spread_chords(p, word) if p["U"] <= 18 else codec_wide.spread_roots(p["S"], p["U"], word)


def _chain(p: Params, words: tuple[Ints, ...], cfg_l1: Ints, cfg_l2: Ints) -> tuple[Ints, ...]:
    """Tip of the chain with 5 fraction bits below the coordinate's LSB: kernel_chain.v."""
    u, g = p["U"] + 1, 5
    l1, l2 = ints(cfg_l1) << g, ints(cfg_l2) << g
    c, n = _roots(p, words[1])
    x, y = _turn(p, l1 + (l2 * c >> u), l2 * n >> u, *_roots(p, words[0]))
    return (x, y) if len(words) == 2 else (*_turn(p, x, ints(0), *_roots(p, words[2])), y)


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


def _about_axis(s: int, axis: Ints, negative: Ints, product: Ints) -> Ints:
    """Turn-spread word of the axis plus or minus a spread of 40 fraction bits; nearest, ties away from the axis."""
    spread = ((product & (1 << 41) - 1) >> 39 - s) + 1 >> 1
    return (axis << s) + np.where(negative, -spread, spread) & (4 << s) - 1


def _square(product: Ints) -> Ints:
    """Square, 40 fraction bits, of a product with 49 fraction bits: 25 of them times 26."""
    return wrap(product >> 24, 27) * wrap(product >> 23, 27) >> 11


def _direction(p: Params, b: Ints, a: Ints, r: Ints) -> Ints:
    """Turn-spread word of the direction (b, a) r, a unit vector; by b where it is shorter than 3/4."""
    c = b * r
    far = ((c ^ c >> 63) >> 47 & 7) >= 3
    square = _square(np.where(far, a, b) * r)
    return _about_axis(p["S"], np.where(far, 2 * (c < 0), 1 + 2 * (a < 0)), (a < 0) ^ (c < 0) ^ ~far, square)


def _limits(p: Params, margin: Ints, slack: Ints) -> kernel_vector_solve.Limits:
    """Margin and slack of the kernel, where the core uses them."""
    return (ints(margin) << 16 - p["W"], ints(slack)) if p.get("MARGINS") else None


def _plane(p: Params, x: Ints, y: Ints, more: int, elbow: Ints, *words: Ints, limits: kernel_vector_solve.Limits,
           exact: Ints | None = None) -> tuple[Ints, ...]:
    """(j1, j2, unreachable, at the shoulder, near to singular) of the target (x, y), x with `more` fraction bits.

    The gap is that of the quadrance of the word x, or of the `exact` one.
    """
    found = kernel_vector_solve.solve(x, y, more, elbow, *words, spread=True, exact=exact)
    j1 = _direction(p, *kernel_vector_solve.seen(found.k1, found.k2, x, y, more, found.s), found.reciprocal)
    square = _square(found.cosine)
    bent = found.clamped | (square >> 39 != 0)  # n2^2 is less than c2^2
    upright = _about_axis(p["S"], 1 + 2 * elbow, found.short == (elbow != 0), square)
    straight = _about_axis(p["S"], 2 * found.short, found.short ^ (elbow != 0), _square(found.sine))
    far, near = found.clamped, np.False_
    if limits:  # k2 has the elbow's sign as its complement, so that neither elbow is nearer
        far, _ = kernel_vector_solve.edges(found, elbow, *limits)
        near = (found.k2 ^ found.k2 >> 63) >> 1 < limits[0] << kernel_vector_solve.GUARD
    return j1, np.where(bent, straight, upright), far, found.zero, near


def ik2(p: Params, *, in_x: Ints, in_y: Ints, in_elbow: Ints, cfg_l1: Ints, cfg_l2: Ints, cfg_q: Ints, cfg_r: Ints,
        cfg_e: Ints, cfg_margin: Ints = 0, cfg_slack: Ints = 0) -> dict[str, Ints]:
    """Joints of the tip (x, y), of the nearest point of the annulus where it is out of reach."""
    if form(p).bits > 16:
        c1, n1, c2, n2, far, zero, near = kernel_vector_wide.plane(
            p, in_x, in_y, in_elbow, cfg_l1, cfg_l2, cfg_q, cfg_r, cfg_e,
            limits=(cfg_margin, cfg_slack) if p.get("MARGINS") else None)
        return {"out_j1": hold_last(_spread(p, c1, n1), ~zero), "out_j2": _spread(p, c2, n2),
                "out_status": ints(far) + 2 * ints(zero | near)}
    x, y, elbow, l1, l2, cfg_q, cfg_r, cfg_e = (ints(word) for word in np.broadcast_arrays(
        in_x, in_y, in_elbow, cfg_l1, cfg_l2, cfg_q, cfg_r, cfg_e))
    x, y, l1, l2 = (word << 16 - p["W"] for word in (x, y, l1, l2))
    j1, j2, far, zero, near = _plane(p, x, y, 0, elbow, l1, l2, cfg_q, cfg_r, cfg_e,
                                     limits=_limits(p, cfg_margin, cfg_slack))
    return {"out_j1": hold_last(j1, ~zero), "out_j2": j2, "out_status": ints(far) + 2 * ints(zero | near)}


def ik3(p: Params, *, in_x: Ints, in_y: Ints, in_z: Ints, in_elbow: Ints, cfg_l1: Ints, cfg_l2: Ints, cfg_q: Ints,
        cfg_r: Ints, cfg_e: Ints, cfg_margin: Ints = 0, cfg_slack: Ints = 0) -> dict[str, Ints]:
    """Yaw of (x, y), then `ik2` on (rho, z), rho = sqrt(x^2 + y^2) with 4 fraction bits."""
    if form(p).bits > 16:
        c1, n1, c2, n2, far, zero, near, c3, n3, on_axis = kernel_vector_wide.space(
            p, in_x, in_y, in_z, in_elbow, cfg_l1, cfg_l2, cfg_q, cfg_r, cfg_e,
            limits=(cfg_margin, cfg_slack) if p.get("MARGINS") else None)
        return {"out_j1": hold_last(_spread(p, c1, n1), ~zero), "out_j2": _spread(p, c2, n2),
                "out_j3": hold_last(_spread(p, c3, n3), ~on_axis), "out_status": ints(far) + 2 * ints(on_axis | near)}
    x, y, z, elbow, l1, l2, cfg_q, cfg_r, cfg_e = (ints(word) for word in np.broadcast_arrays(
        in_x, in_y, in_z, in_elbow, cfg_l1, cfg_l2, cfg_q, cfg_r, cfg_e))
    x, y, z, l1, l2 = (word << 16 - p["W"] for word in (x, y, z, l1, l2))
    on_axis = (x == 0) & (y == 0)
    b, a, r, rho = kernel_vector_solve.yaw(x, y)
    limits = _limits(p, cfg_margin, cfg_slack)
    j1, j2, far, zero, near = _plane(p, rho, z, kernel_vector_solve.GUARD, elbow, l1, l2, cfg_q, cfg_r, cfg_e,
                                     limits=limits, exact=x * x + y * y + z * z)
    if limits:
        near = near | (rho >> kernel_vector_solve.GUARD < limits[0])
    return {"out_j1": hold_last(j1, ~zero), "out_j2": j2, "out_j3": hold_last(_direction(p, b, a, r), ~on_axis),
            "out_status": ints(far) + 2 * ints(on_axis | near)}
