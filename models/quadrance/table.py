"""Bit-true models of rtl/table: binary joint angles, 2^A to the turn, by tables and products."""

from __future__ import annotations

from functools import cache

import numpy as np

from quadrance import codec_wide, codecs, kernel_vector_wide, vector
from quadrance.fixed import Ints, hold_last, ints, round_shift, saturate, wrap
from quadrance.kernel_vector_wide import form
from quadrance.vector import config

# config: words of the inverse cores beside the lengths
__all__ = ["config", "fk1", "fk2", "fk3", "ik1", "ik2", "ik3", "ik3r"]

Params = dict[str, int]

GUARD = 4  # fraction bits of a sum below a coordinate's LSB


# Forward


def sizes(p: Params, joints: int) -> tuple[int, int]:
    """(K, T): fraction bits of a sine, address bits of its table."""
    address = (p["W"] - 1) // 2 if p["W"] > 20 else (p["W"] + (5 if joints == 3 else 3)) // 2
    return p["W"] + 1, min(address, p["A"] - 1)


def root(k: int, t: int, a: int, word: Ints, cosine: bool) -> Ints:
    """Sine or cosine of an a-bit word, units of 2^-k: of a straight segment, above k = 21 of a parabola."""
    return (codec_wide.sine if k > 21 else codecs.angle_chord)(k, t, a, word, cosine)


def _unit(p: Params, joints: int, word: Ints) -> tuple[Ints, Ints]:
    """(cos, sin) of a joint word, units of 2^-K."""
    return tuple(root(*sizes(p, joints), p["A"], word, cosine) for cosine in (True, False))


def fk1(p: Params, *, in_j1: Ints, cfg_l1: Ints) -> dict[str, Ints]:
    """``x = L1 cos j1, y = L1 sin j1``, nearest (ties upward) and saturated."""
    exact = [root * ints(cfg_l1) for root in _unit(p, 1, in_j1)]
    return _coordinates(p, "xy", exact, p["W"] + 1)


def _sums(p: Params, joints: int, j1: Ints, j2: Ints, l1: Ints, l2: Ints) -> list[Ints]:
    """L1 cos j1 + L2 cos(j1 + j2), then with sines; GUARD fraction bits, every product truncated."""
    cut = p["W"] + 1 - GUARD
    return [(ints(l1) * first >> cut) + (ints(l2) * second >> cut)
            for first, second in zip(_unit(p, joints, j1), _unit(p, joints, ints(j1) + ints(j2)))]


def _coordinates(p: Params, axes: str, exact: list[Ints], fraction: int) -> dict[str, Ints]:
    """Nearest coordinates (ties upward), saturated, and the overflow bit."""
    pairs = [saturate(round_shift(value, fraction), p["W"]) for value in exact]
    over = np.any(np.broadcast_arrays(*(over for _, over in pairs)), axis=0)
    return {f"out_{axis}": value for axis, (value, _) in zip(axes, pairs)} | {"out_status": 4 * ints(over)}


def fk2(p: Params, *, in_j1: Ints, in_j2: Ints, cfg_l1: Ints, cfg_l2: Ints) -> dict[str, Ints]:
    """``x = L1 cos j1 + L2 cos(j1 + j2)``, y with sines, nearest and saturated."""
    return _coordinates(p, "xy", [value + 1 for value in _sums(p, 2, in_j1, in_j2, cfg_l1, cfg_l2)], GUARD)


def fk3(p: Params, *, in_j1: Ints, in_j2: Ints, in_j3: Ints, cfg_l1: Ints, cfg_l2: Ints) -> dict[str, Ints]:
    """`fk2` in the plane of the arm, (rho, z), then ``x = rho cos j3, y = rho sin j3``; rho keeps its fraction."""
    rho, z = (value + 1 for value in _sums(p, 3, in_j1, in_j2, cfg_l1, cfg_l2))
    x, y = ((rho * root >> p["W"] + 1) + 1 for root in _unit(p, 3, in_j3))
    return _coordinates(p, "xyz", [x, y, z], GUARD)


# Inverse


@cache
def _reciprocal_slopes() -> Ints:
    """2^15 / t^2 in the middle of 128 segments of M from 1/2, then of 128 from -1, as kernel_tangent.v computes it."""
    pairs = [(257 + 2 * i, 1) for i in range(128)] + [(511 - 2 * i, -1) for i in range(128)]
    return ints([((((64 * b + sign) * (2 * b * b + 1) << 27) // b**3 // b**2) + 1) >> 1 for b, sign in pairs])


def ik1(p: Params, *, in_x: Ints, in_y: Ints) -> dict[str, Ints]:
    """``j1 = atan2(y, x)``, nearest; at the origin the last angle stays (0 before there was one)."""
    f = form(p)
    x, y = (ints(word) << f.bits - p["W"] for word in np.broadcast_arrays(in_x, in_y))
    zero = (x == 0) & (y == 0)
    word = _short(p, x, y) if f.bits == 16 else _angle(p, *kernel_vector_wide.aim(f, x, y))
    return {"out_j1": hold_last(word, ~zero), "out_status": 2 * ints(zero)}


def _short(p: Params, x: Ints, y: Ints) -> Ints:
    """The direction of aligned words of 16 bits, by a tangent."""
    bits = [np.ceil(np.log2((word ^ word >> 63) + 1)) for word in (x, y)]
    k = 15 - np.maximum(*bits).astype(np.int64)
    x_long = np.where(k < 15, bits[0] == 15 - k, x == -1)  # of 0 and -1 the latter is longer
    long, short = (np.where(pick, x, y) << k for pick in (x_long, ~x_long))
    slope = _reciprocal_slopes()[wrap(long >> 7, 7, signed=False) + 128 * (long < 0)]
    factor = wrap(short * (long ^ 0x7F) >> 11, 20)
    tangent = wrap(factor * np.where(x_long, slope, -slope) >> 16, 20)
    axis = np.where(x_long, 2 * (x < 0), 1 + 2 * (y < 0))
    return codecs.angle_about_axis(p["A"], axis, tangent)


def fraction(p: Params) -> int:
    """Fraction bits of cosine and sine, of which the inverse cores take the arc sine."""
    return 20 if form(p).bits == 16 else form(p).bits + 2


def _angle(p: Params, c: Ints, n: Ints) -> Ints:
    """The word of a joint of the kernel, of products for cosine and sine."""
    cut = 2 * form(p).fraction - 1 - fraction(p)
    c, n = c >> cut, n >> cut
    if form(p).bits == 16:
        return codecs.angle_of_vector(p["A"], c, n)
    return codec_wide.angle_of_vector(p["A"], c, n, fraction(p))


def ik2(p: Params, *, in_x: Ints, in_y: Ints, in_elbow: Ints, cfg_l1: Ints, cfg_l2: Ints, cfg_q: Ints, cfg_r: Ints,
        cfg_e: Ints, cfg_margin: Ints = 0, cfg_slack: Ints = 0) -> dict[str, Ints]:
    """Joints of the tip (x, y), of the nearest point of the annulus where it is out of reach."""
    c1, n1, c2, n2, clamped, zero, near = vector.kernel(p).plane(
        p, in_x, in_y, in_elbow, cfg_l1, cfg_l2, cfg_q, cfg_r, cfg_e,
        limits=(cfg_margin, cfg_slack) if p.get("MARGINS") else None)
    return {"out_j1": hold_last(_angle(p, c1, n1), ~zero), "out_j2": _angle(p, c2, n2),
            "out_status": ints(clamped) + 2 * ints(zero | near)}


def ik3(p: Params, *, in_x: Ints, in_y: Ints, in_z: Ints, in_elbow: Ints, cfg_l1: Ints, cfg_l2: Ints, cfg_q: Ints,
        cfg_r: Ints, cfg_e: Ints, cfg_margin: Ints = 0, cfg_slack: Ints = 0) -> dict[str, Ints]:
    """Joint 3 has the direction of (x, y); then `ik2` on (rho, z)."""
    c1, n1, c2, n2, clamped, zero, near, c3, n3, on_axis = vector.kernel(p).space(
        p, in_x, in_y, in_z, in_elbow, cfg_l1, cfg_l2, cfg_q, cfg_r, cfg_e,
        limits=(cfg_margin, cfg_slack) if p.get("MARGINS") else None)
    return {"out_j1": hold_last(_angle(p, c1, n1), ~zero), "out_j2": _angle(p, c2, n2),
            "out_j3": hold_last(_angle(p, c3, n3), ~on_axis), "out_status": ints(clamped) + 2 * ints(on_axis | near)}


def wrist(p: Params, x: Ints, y: Ints, phi: Ints, l3: Ints) -> tuple[Ints, Ints, Ints]:
    """The tip less its last link, nearest (ties upward) and saturated, of aligned words; whether one was saturated."""
    bits = form(p).bits
    roots = _unit(p | {"W": bits}, 2, phi)
    pairs = [saturate(2 * goal - (root * l3 >> bits) >> 1, bits) for goal, root in zip((x, y), roots)]
    return pairs[0][0], pairs[1][0], pairs[0][1] | pairs[1][1]


def ik3r(p: Params, *, in_x: Ints, in_y: Ints, in_phi: Ints, in_elbow: Ints, cfg_l1: Ints, cfg_l2: Ints, cfg_l3: Ints,
         cfg_q: Ints, cfg_r: Ints, cfg_e: Ints, cfg_margin: Ints = 0, cfg_slack: Ints = 0) -> dict[str, Ints]:
    """Three joints in the plane whose last link points along `in_phi`: `ik2` of the wrist, then the third joint."""
    x, y, phi, l1, l2, l3 = (ints(word) for word in np.broadcast_arrays(in_x, in_y, in_phi, cfg_l1, cfg_l2, cfg_l3))
    bits = form(p).bits
    more = bits - p["W"]
    x, y, l1, l2, l3 = (word << more for word in (x, y, l1, l2, l3))
    x, y, over = wrist(p, x, y, phi, l3)
    found = ik2(p | {"W": bits}, in_x=x, in_y=y, in_elbow=in_elbow, cfg_l1=l1, cfg_l2=l2, cfg_q=cfg_q, cfg_r=cfg_r,
                cfg_e=cfg_e, cfg_margin=ints(cfg_margin) << more, cfg_slack=cfg_slack)
    third = wrap(phi - found["out_j1"] - found["out_j2"], p["A"], signed=False)
    return found | {"out_j3": third, "out_status": found["out_status"] + 4 * ints(over)}
