"""Bit-true models of the velocity cores of rtl/arm: tip velocity of joint rates, and joint rates of a tip velocity.

Joints are unit vectors, rates words of W bits with V fraction bits (radians in a unit of time), velocities words of a
coordinate in the same unit of time. In the plane of the arm, seen from link 1, with e + i f = L2 (c2 + i n2):

    v' = -f s + i ((L1 + e) s - L1 w2),  s = w1 + w2;   back: s = -v'x / f,  w1 = (v'y - e s) / L1,  w2 = s - w1

Integers of 64 bits are exact up to W = U = 24, although a product may have more bits: of it the `bits` above the U
lowest are kept, at most 39 + 24 = 63, and what is beyond 64 bits wraps. A numerator shifted for its quotient has
2 W + 7 bits, at most 55.
"""

from __future__ import annotations

import numpy as np

from quadrance.fixed import Ints, ints, round_shift, saturate, wrap

Params = dict[str, int]
GUARD = 4  # bits below the LSB of a coordinate to which products are truncated


def bits(p: Params) -> int:
    """Width of a velocity inside: the greatest that rates and links make, its sign, GUARD."""
    return 2 * p["W"] - p["V"] + 3 + GUARD


def _sum(p: Params, *products: tuple[Ints, Ints]) -> Ints:
    """Sum of products, each truncated by U bits."""
    return wrap(sum(ints(left) * ints(right) >> p["U"] for left, right in products), bits(p))


def _coordinates(p: Params, axes: str, *words: Ints) -> dict[str, Ints]:
    answer, overflow = {}, ints(0)
    for axis, word in zip(axes, words):
        answer[f"out_{axis}"], over = saturate(round_shift(word, GUARD), p["W"])
        overflow = overflow | over
    return answer | {"out_status": 4 * overflow}


def _plane(p: Params, c1: Ints, n1: Ints, c2: Ints, n2: Ints, w1: Ints, w2: Ints, l1: Ints,
           l2: Ints) -> tuple[Ints, ...]:
    """(x, y) of the velocity in the plane, and the same of the tip."""
    up = p["U"] - p["V"]
    l1, l2 = ints(l1) << GUARD, ints(l2) << GUARD
    s, w2 = ints(w1) + w2 << up, ints(w2) << up
    k, f = _sum(p, (c2, l2)) + l1, _sum(p, (n2, l2))
    g, h = _sum(p, (s, k), (w2, ~l1)), _sum(p, (s, ~f))
    return (_sum(p, (c1, h), (n1, ~g)), _sum(p, (n1, h), (c1, g)), _sum(p, (c1, k), (n1, ~f)))


def velocity2(p: Params, *, in_c1: Ints, in_n1: Ints, in_c2: Ints, in_n2: Ints, in_w1: Ints, in_w2: Ints, cfg_l1: Ints,
              cfg_l2: Ints) -> dict[str, Ints]:
    """Velocity of the tip of two joints in the plane."""
    x, y, _ = _plane(p, in_c1, in_n1, in_c2, in_n2, in_w1, in_w2, cfg_l1, cfg_l2)
    return _coordinates(p, "xy", x, y)


def velocity3(p: Params, *, in_c1: Ints, in_n1: Ints, in_c2: Ints, in_n2: Ints, in_c3: Ints, in_n3: Ints, in_w1: Ints,
              in_w2: Ints, in_w3: Ints, cfg_l1: Ints, cfg_l2: Ints) -> dict[str, Ints]:
    """The same of a plane that yaws."""
    x, z, rho = _plane(p, in_c1, in_n1, in_c2, in_n2, in_w1, in_w2, cfg_l1, cfg_l2)
    t = _sum(p, (ints(in_w3) << p["U"] - p["V"], rho))
    return _coordinates(p, "xyz", _sum(p, (in_c3, x), (in_n3, ~t)), _sum(p, (in_n3, x), (in_c3, t)), z)


def _quotient(p: Params, numerator: Ints, negative: Ints, divisor: Ints) -> tuple[Ints, Ints]:
    """Numerator / divisor with V fraction bits, nearest, the sign turned where `negative`; and where the divisor is 0,
    the quotient 0 then. Saturated to W + 2 bits."""
    numerator, divisor = ints(numerator), ints(divisor)
    sign = (numerator < 0) ^ negative
    size = np.where(numerator < 0, ~numerator, numerator)
    zero = divisor == 0
    q = (size << p["V"] + 1) // np.where(zero, 1, divisor) + 1 >> 1
    q = np.where(zero, 0, np.minimum(q, (1 << p["W"] + 1) - 1))
    return np.where(sign, -q, q), zero


def _rates(p: Params, x: Ints, y: Ints, c1: Ints, n1: Ints, c2: Ints, n2: Ints, l1: Ints, l2: Ints,
           cfg_sine: Ints) -> tuple[Ints, ...]:
    """(w1, w2, singular, rho) of the velocity (x, y) in the plane, GUARD bits below its LSB."""
    l1, l2, n2 = ints(l1) << GUARD, ints(l2) << GUARD, ints(n2)
    h, g = _sum(p, (c1, x), (n1, y)), _sum(p, (c1, y), (n1, ~ints(x)))
    size = np.abs(n2)
    near = size < cfg_sine
    e, f = _sum(p, (c2, l2)), _sum(p, (np.where(near, cfg_sine, size), l2))
    rho = _sum(p, (c1, l1), (c1, e), (n1, ~_sum(p, (n2, l2))))
    s, flat = _quotient(p, h, n2 >= 0, f)
    u = wrap(_sum(p, (s << p["U"] - p["V"], ~e)) + g, bits(p))
    w1, none = _quotient(p, u, np.False_, l1)
    return w1, s - w1, near | flat | none, rho


def _answer(p: Params, singular: Ints, *rates: Ints) -> dict[str, Ints]:
    answer, overflow = {}, ints(0)
    for i, rate in enumerate(rates, 1):
        answer[f"out_w{i}"], over = saturate(rate, p["W"])
        overflow = overflow | over
    return answer | {"out_status": 4 * overflow + 2 * ints(singular)}


def rates2(p: Params, *, in_c1: Ints, in_n1: Ints, in_c2: Ints, in_n2: Ints, in_x: Ints, in_y: Ints, cfg_l1: Ints,
           cfg_l2: Ints, cfg_sine: Ints) -> dict[str, Ints]:
    """Rates of two joints for a velocity of the tip in the plane."""
    x, y = ints(in_x) << GUARD, ints(in_y) << GUARD
    w1, w2, singular, _ = _rates(p, x, y, in_c1, in_n1, in_c2, in_n2, cfg_l1, cfg_l2, cfg_sine)
    return _answer(p, singular, w1, w2)


def rates3(p: Params, *, in_c1: Ints, in_n1: Ints, in_c2: Ints, in_n2: Ints, in_c3: Ints, in_n3: Ints, in_x: Ints,
           in_y: Ints, in_z: Ints, cfg_l1: Ints, cfg_l2: Ints, cfg_sine: Ints, cfg_radius: Ints) -> dict[str, Ints]:
    """The same of a plane that yaws."""
    x, y, z = (ints(word) << GUARD for word in (in_x, in_y, in_z))
    along, across = _sum(p, (in_c3, x), (in_n3, y)), _sum(p, (in_c3, y), (in_n3, ~x))
    w1, w2, singular, rho = _rates(p, along, z, in_c1, in_n1, in_c2, in_n2, cfg_l1, cfg_l2, cfg_sine)
    size, least = np.where(rho < 0, ~rho, rho), ints(cfg_radius) << GUARD
    w3, on_axis = _quotient(p, across, rho < 0, np.maximum(size, least))
    return _answer(p, singular | (size < least) | on_axis, w1, w2, w3)
