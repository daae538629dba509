"""Bit-true models of rtl/paper: spreads and quadrances all the way, as the paper computes, with its errors corrected.

R. Martinez et al., "Efficient FPGA Hardware Implementation for Robot Manipulator Kinematic Modeling Using
Rational Trigonometry"; equation numbers are the paper's. A joint word is a turn-spread: quadrant k above S fraction
bits f, spread f in even quadrants and 1 - f in odd ones. Every model takes the Verilog parameters (`p`) and integer
arrays of input words by port name, which broadcast, and returns every output word by port name. Formats, error bounds
and corrections: rtl/paper/README.md.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from quadrance import codecs
from quadrance.cores import STATUS_BITS
from quadrance.fixed import Ints, hold_last, ints, isqrt, round_shift

Params = dict[str, int]
Bools = NDArray[np.bool_]


# Parts


def root(p: Params, *, in_d: Ints) -> dict[str, Ints]:
    """``floor(sqrt(d))``."""
    return {"out_root": isqrt(in_d)}


def sign(p: Params, *, in_root: Ints, in_negative: Ints, in_over: Ints) -> dict[str, Ints]:
    """``+-root / 2^(N-W+1)`` to nearest, ties away from zero.

    The word is ``+-(2^(W-1) - 1)`` where `in_over` is set or the magnitude would round to ``2^(W-1)``.
    """
    high = (1 << p["W"] - 1) - 1
    shift = p["N"] - p["W"] + 1
    magnitude = round_shift(in_root, shift)
    over = magnitude > high
    magnitude = np.where(over | (ints(in_over) != 0), high, magnitude)
    return {"out_word": np.where(ints(in_negative) != 0, -magnitude, magnitude), "out_over": ints(over)}


def quotient(p: Params, *, in_rem: Ints, in_d: Ints) -> dict[str, Ints]:
    """R digits of rem / d by restoring division, row by row: exact for 0 <= rem <= d, bit-true for every word."""
    rem, d = np.broadcast_arrays(ints(in_rem), ints(in_d))
    digits, mask = np.zeros_like(rem), (1 << p["Q"]) - 1
    for _ in range(p["R"]):
        trial = 2 * rem - d
        less = trial >> p["Q"] & 1
        rem = np.where(less, 2 * rem, trial) & mask
        digits = 2 * digits + (1 - less)
    return {"out_rem": rem, "out_digits": digits}


def complement(fraction: Ints, fall: Bools, s: int) -> Ints:
    """1 - f where `fall`, else f: a word u1.S, for 1 - 0 is 1.0."""
    return np.where(fall, (1 << s) - ints(fraction), fraction)


# One joint


def status(**bits: Bools) -> Ints:
    """Status word with the named bits set."""
    return sum(ints(bit) << STATUS_BITS[name] for name, bit in bits.items())


def fk1(p: Params, *, in_j1: Ints, cfg_l1: Ints) -> dict[str, Ints]:
    """``x = +-sqrt(Q1 (1 - s1))``, ``y = +-sqrt(Q1 s1)``, Q1 = L1^2 (eqs. 51-52, Table I)."""
    w, s = p["W"], p["S"]
    fraction, k = ints(in_j1) & (1 << s) - 1, ints(in_j1) >> s
    quadrance = ints(cfg_l1) * ints(cfg_l1)
    out, over = {}, False
    for axis, fall, negative in (("x", k % 2 == 0, (k == 1) | (k == 2)), ("y", k % 2 == 1, k >= 2)):
        square = quadrance * complement(fraction, fall, s) >> s - 2  # of twice the result
        beyond = square >> 2 * w != 0
        signed = sign({"W": w, "N": w}, in_root=isqrt(square & (1 << 2 * w) - 1), in_negative=negative, in_over=beyond)
        out[f"out_{axis}"] = signed["out_word"]
        over = over | beyond | (signed["out_over"] != 0)
    return out | {"out_status": status(overflow=over)}


def ik1(p: Params, *, in_x: Ints, in_y: Ints) -> dict[str, Ints]:
    """``s1 = qy / (qx + qy)`` to nearest, quadrant by the signs (eq. 9, Table I); x = y = 0 holds the last word.

    Ties go up in the even quadrants and down in the odd ones, where 1 - s1 is the fraction.
    """
    answer = codecs.vector_to_spread(p, in_c=in_x, in_n=in_y)
    return {"out_j1": answer["out_j"], "out_status": answer["out_status"]}


# Two and three joints, forward


DIGITS = 3  # quotient digits a clock


def chain(p: Params, *, in_j1: Ints, in_j2: Ints, in_j3: Ints | None, cfg_l1: Ints, cfg_l2: Ints) -> dict[str, Ints]:
    """Cross law, spread of the base angle, spread difference, 1DOF (eqs. 11-17, 24-31, Table II corrected).

    Every word is the word of rtl/paper/paper_chain.v, also where the tip is out of range. `in_j3` is None in the plane.
    """
    w, f, s = p["W"], p["F"], p["S"]
    i = w - 1 - f
    n = max(s + 1, w - 1)
    g = min(s, 27 - 2 * i, 2 * n + 2 - 2 * i)
    q = 2 * i + g
    c = n - w + 1
    j1, j2, l1, l2 = np.broadcast_arrays(*map(ints, (in_j1, in_j2, cfg_l1, cfg_l2)))
    one = (1 << s) - 1
    f1, k1, f2, k2 = j1 & one, j1 >> s, j2 & one, j2 >> s
    short = (1 << w - 1) - 1

    def square(side: Ints) -> Ints:
        """Quadrance u(2I).G of a length with one bit below the root's LSB; above Q bits where out of range."""
        return side * side >> 2 * n + 2 - q

    def dof(left: Ints, right: Ints) -> tuple[Ints, Ints]:
        """Fig. 8a: product of a u0.Q or quadrance word with a u1.N spread, and the root of it."""
        product = left * right
        return product, isqrt(product >> q - n & (1 << 2 * n) - 1)

    # cross law, its square completed: q3 = (sqrt(Q1) +- sqrt(Q2 (1 - s2)))^2 + Q2 s2
    quad = square((l2 & short) << c + 1) & (1 << q) - 1
    product, b = dof(quad, complement(f2, k2 % 2 == 0, s) << n - s)
    plus = (k2 == 0) | (k2 == 3)
    side = (l1 & short) << c + 1
    acc = 2 * b - np.where(plus, ~side, side)
    h = quad - (product >> n)
    whole = (square(acc) & (4 << q) - 1)
    quad = (whole & (1 << q) - 1) + h
    beyond = (l1 > short) | (l2 > short) | (whole >> q != 0) | (quad >> q != 0)
    quad = quad & (1 << q) - 1
    obtuse = ~plus & (acc >= 0)

    # s' = s2 Q2 / q3, then the one difference that Table II comes down to
    digits = DIGITS * -(-(s + 1) // DIGITS)
    share = quotient({"Q": q, "R": digits}, in_rem=h, in_d=quad)["out_digits"] << q - digits
    add = k2 < 2
    rest = (1 << q) - 1 - share
    flipped = obtuse ^ add
    _, near = dof(np.where(flipped, share, rest), f1 << n - s)
    _, far = dof(np.where(flipped, rest, share), complement(f1, True, s) << n - s)
    difference = far - near
    borrow = difference >= 0
    k = k1 + np.where(add, 1 + obtuse, -ints(obtuse)) - borrow & 3
    spread = difference * difference >> n
    odd = (k1 + obtuse + add) % 2 == 1
    spread = np.where(odd, (1 << n) - 1 - spread, spread)
    behind = (k == 1) | (k == 2)

    product, top = dof(quad, spread)
    if in_j3 is None:
        _, other = dof(quad, (1 << n) - 1 - spread)
        roots = {"y": (top, k >= 2), "x": (other, behind)}
    else:
        f3, k3 = ints(in_j3) & one, ints(in_j3) >> s
        flat = quad - (product >> n)  # qa = q3 - qz
        _, y = dof(flat, complement(f3, k3 % 2 == 1, s) << n - s)
        _, x = dof(flat, complement(f3, k3 % 2 == 0, s) << n - s)
        roots = {"z": (top, k >= 2), "y": (y, behind ^ (k3 >= 2)), "x": (x, behind ^ ((k3 == 1) | (k3 == 2)))}
    out, over = {}, beyond
    for axis, (magnitude, negative) in roots.items():
        signed = sign({"W": w, "N": n}, in_root=magnitude, in_negative=negative, in_over=beyond)
        out[f"out_{axis}"] = signed["out_word"]
        over = over | (signed["out_over"] != 0)
    return out | {"out_status": status(overflow=over)}


def fk2(p: Params, *, in_j1: Ints, in_j2: Ints, cfg_l1: Ints, cfg_l2: Ints) -> dict[str, Ints]:
    """Two joints in the plane (eqs. 11-17, Table II corrected)."""
    return chain(p, in_j1=in_j1, in_j2=in_j2, in_j3=None, cfg_l1=cfg_l1, cfg_l2=cfg_l2)


def fk3(p: Params, *, in_j1: Ints, in_j2: Ints, in_j3: Ints, cfg_l1: Ints, cfg_l2: Ints) -> dict[str, Ints]:
    """Three joints: the plane of the two links turns (eqs. 24-31), the sign of rho restored."""
    return chain(p, in_j1=in_j1, in_j2=in_j2, in_j3=in_j3, cfg_l1=cfg_l1, cfg_l2=cfg_l2)


# Two and three joints, inverse


def solve(p: Params, *, in_x: Ints, in_y: Ints, in_z: Ints | None, in_elbow: Ints, cfg_l1: Ints,
          cfg_l2: Ints) -> dict[str, Ints]:
    """Spreads of a triangle from its quadrances, then a spread sum or difference (eqs. 18-23, 32-40).

    Every word is the word of rtl/paper/paper_solve.v, also with links out of range.
    """
    w, f, s, rows = p["W"], p["F"], p["S"], p["R"]
    i = w - 1 - f
    g = min(s, 2 * f)
    q = 2 * i + 2 + g
    digits = rows * -(-(s + 3) // rows)
    right = max(digits, w)
    left = min(2 * i + g, 27)
    squared = min(right, 26)
    n = min(digits, 26)
    x, y, elbow, l1, l2 = np.broadcast_arrays(*map(ints, (in_x, in_y, in_elbow, cfg_l1, cfg_l2)))
    short = (1 << w - 1) - 1
    quadrance = lambda side: side * side >> 2 * f - g  # noqa: E731 (a formula of one line)
    q1, q2, product = quadrance(l1 & short), quadrance(l2 & short), (l1 & short) * (l2 & short)
    whole = {"Q": q, "R": digits}

    def word(k: Ints, share: Ints, bits: int, fall: Bools) -> Ints:
        """The share (or its complement) to nearest in quadrant k."""
        top = share >> bits - s - 1 ^ np.where(fall, (2 << s) - 1, 0)
        return (k << s) + (top + 1 >> 1) & (4 << s) - 1

    # directions: of the yaw, then of the tip in the links' plane
    kr = np.where(y < 0, np.where(x < 0, 2, 3), np.where(x < 0, 1, 0))
    q3, rise, ka = quadrance(x) + quadrance(y), quadrance(y), kr
    out, still = {}, np.zeros(x.shape, dtype=bool)
    if in_z is not None:
        still = q3 == 0
        yaw = quotient(whole, in_rem=rise, in_d=q3)["out_digits"]
        out["out_j3"] = hold_last(word(kr, yaw, digits, kr % 2 == 1), ~still)
        z = np.broadcast_to(ints(in_z), x.shape)
        q3, rise, ka = q3 + quadrance(z), quadrance(z), np.where(z < 0, 3, 0)
    tip = quotient(whole, in_rem=rise, in_d=q3)["out_digits"]
    undefined = q3 == 0

    # the elbow by the cross law: v = 1 - |c| / (2 L1 L2), cos = +-(1 - v)
    c = q3 - q1 - q2
    obtuse = (c < 0) & (2 * q1 - np.abs(c) < 0)
    twice = product << 1 >> 2 * f - g
    slack = twice - np.abs(c)
    unreachable = slack < 0
    v = np.where(unreachable, 0, quotient(whole, in_rem=np.maximum(slack, 0), in_d=twice)["out_digits"])
    cosine = (1 << squared) - 1 - (v << right - digits >> right - squared)
    square = cosine * cosine
    k2 = np.where(elbow != 0, np.where(c < 0, 2, 3), np.where(c < 0, 1, 0))
    out["out_j2"] = word(k2, square, 2 * squared, k2 % 2 == 0)

    # the base angle by the spread law, and the difference that both elbows come down to
    s2 = (1 << right) - 1 - (square >> 2 * squared - right)
    h = (q2 >> 2 * i + g - left) * s2 >> left + right - 2 * i - g
    base = np.where(unreachable, 0, quotient(whole, in_rem=h, in_d=q3)["out_digits"]) << left - digits
    base = np.where(obtuse ^ (elbow != 0), base, (1 << left) - 1 - base)
    tip = tip << right - digits
    tip = np.where(ka % 2 == 1, (1 << right) - 1 - tip, tip)

    def root(a: Ints, b: Ints) -> Ints:
        return isqrt(a * b >> left + right - 2 * n)

    difference = root((1 << left) - 1 - base, (1 << right) - 1 - tip) - root(base, tip)
    borrow = difference >= 0
    k1 = ka + np.where(elbow != 0, 1 + obtuse, -ints(obtuse)) - borrow & 3
    out["out_j1"] = hold_last(word(k1, difference * difference, 2 * n, borrow), ~undefined)
    beyond = (l1 > short) | (l2 > short)
    return out | {"out_status": status(unreachable=unreachable, singular=undefined | still, overflow=beyond)}


def ik2(p: Params, *, in_x: Ints, in_y: Ints, in_elbow: Ints, cfg_l1: Ints, cfg_l2: Ints) -> dict[str, Ints]:
    """Two joints in the plane (eqs. 18-23), the elbow and every quadrant recovered."""
    return solve(p, in_x=in_x, in_y=in_y, in_z=None, in_elbow=in_elbow, cfg_l1=cfg_l1, cfg_l2=cfg_l2)


def ik3(p: Params, *, in_x: Ints, in_y: Ints, in_z: Ints, in_elbow: Ints, cfg_l1: Ints,
        cfg_l2: Ints) -> dict[str, Ints]:
    """Three joints (eqs. 32-40), the tip in front of the yaw axis (rho >= 0)."""
    return solve(p, in_x=in_x, in_y=in_y, in_z=in_z, in_elbow=in_elbow, cfg_l1=cfg_l1, cfg_l2=cfg_l2)
