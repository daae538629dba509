"""Bit-true model of engine_newton_3r, its configuration words, and what they mean."""

from __future__ import annotations

import numpy as np

from quadrance import codecs, rational
from quadrance.fixed import Ints, ints
from quadrance.iterative.fixed import levels

Params = dict[str, int]

ROOT = (17, 10)  # fraction bits of a sine or cosine, address bits of its table
GUARD = 1 << 13  # 2^-4 as a sine: where |sin theta2| is less, this is added to it
LEAST = 1 << 9  # the least cfg_mu, 2^-8, that does without the guard
STEP = 2**31 / (2 * np.pi)  # cfg_r of a link is this divided by its length, lengths aligned to 16 bits


def config(p: Params, *, cfg_l1: int, cfg_l2: int, damping: float = 0.0) -> dict[str, int]:
    """Words of the step, lengths in LSB, `damping` lambda: 0 (Newton) or 2^-9 to 0.41, in squares of the link lengths.

    A link shorter than 5216 / 2^(16 - W) LSB gets shorter steps than Newton's, for the word is saturated.
    """
    if not (damping == 0 or 2**-9 <= damping <= 0.41):
        raise ValueError("damping is 0, or from 2^-9 to 0.41")
    word = round(damping * 2**17)
    lengths = {"cfg_r1": cfg_l1 << 16 - p["W"], "cfg_r2": cfg_l2 << 16 - p["W"]}
    rates = {name: min(round(STEP / max(length, 1)), 65535) for name, length in lengths.items()}
    return rates | {"cfg_lambda": word, "cfg_mu": word * 2 + (word * word >> 17)}


def _sum(a: Ints, b: Ints, c: Ints, d: Ints) -> Ints:
    """a b + c d, each product truncated by 4 bits."""
    return (a * b >> 4) + (c * d >> 4)


def _errors(a: int, th1: Ints, th2: Ints, phi: Ints, x: Ints, y: Ints, lengths: tuple[Ints, ...]) -> tuple:
    """(c1, n1, c12, n12), sin theta2, and the wrist's error in 1/64 LSB."""
    roots = [codecs.angle_chord(*ROOT, a, word, cosine) for word in (phi, th1, th1 + th2) for cosine in (True, False)]
    ex, ey = x << 6, y << 6
    for i, length in enumerate(lengths):
        ex, ey = ex - (roots[2 * i] * length >> 11), ey - (roots[2 * i + 1] * length >> 11)
    return roots[2:], codecs.angle_chord(*ROOT, a, th2, False), ex, ey


def _step(a: int, roots: list[Ints], n2: Ints, fine: Ints, ex: Ints, ey: Ints, rates: tuple[Ints, Ints], damp: Ints,
          mu: Ints) -> tuple[Ints, Ints]:
    """What joint 1 goes back, and links 1 and 2 together go on, in words; errors in their range."""
    c1, n1, c12, n12 = roots
    near = (n2 >= -GUARD) & (n2 < GUARD) & (mu < LEAST)
    n2 = n2 + np.where(near, np.where(n2 < 0, -GUARD, GUARD), 0)
    # 1 / (n2^2 + mu) = 4^j r
    det = (n2 * n2 >> 11) + (mu << 6)
    j = ints(det < 1 << 21) + (det < 1 << 19) + (det < 1 << 17)
    w, slope = rational.reciprocal_pair(det << 2 * j >> 6)
    r = w * slope >> 17
    u1, u2 = _sum(c1, ex, n1, ey) >> 14, _sum(c12, ex, n12, ey) >> 14
    p1, p2 = _sum(~c1, ey, n1, ex) >> 14, _sum(c12, ey, ~n12, ex) >> 14
    moves = [(_sum(~n2, u, damp, p) >> 6) * (r * rate >> 15) for u, p, rate in ((u2, p1, rates[0]), (u1, p2, rates[1]))]
    # the whole step is shifted until both of its joints fit in a quarter turn
    size = np.maximum(*(move ^ move >> 63 for move in moves))
    room = sum(ints(size < 1 << k) for k in (31, 33, 35, 37, 39))
    i = np.minimum(room, np.where(fine, j, j + 2))
    return tuple(move >> 43 - a - 2 * i for move in moves)


def solve(p: Params, *, in_x: Ints, in_y: Ints, in_phi: Ints, in_j1: Ints, in_j2: Ints, in_warm: Ints, cfg_l1: Ints,
          cfg_l2: Ints, cfg_l3: Ints, cfg_r1: Ints, cfg_r2: Ints, cfg_lambda: Ints, cfg_mu: Ints, cfg_tol: Ints,
          cfg_limit: Ints) -> dict[str, Ints]:
    """Newton's method for the planar arm of three joints: every sample by itself, or from the one before it if warm."""
    columns = np.broadcast_arrays(*map(ints, (
        in_x, in_y, in_phi, in_j1, in_j2, in_warm, cfg_l1, cfg_l2, cfg_l3, cfg_r1, cfg_r2, cfg_lambda, cfg_mu, cfg_tol,
        cfg_limit)))
    x, y, phi, j1, j2, warm, l1, l2, l3, r1, r2, damp, mu, tol, limit = (np.atleast_1d(column) for column in columns)
    x, y, l1, l2, l3 = (column << 16 - p["W"] for column in (x, y, l1, l2, l3))
    a, mask = p["A"], (1 << p["A"]) - 1
    joints, out = np.zeros((2, x.size), dtype=np.int64), np.zeros((4, x.size), dtype=np.int64)
    for at in levels(warm):
        own = warm[at] == 0
        th1, th2 = (np.where(own, given[at], np.where(at > 0, answer[at - 1], 0))
                    for given, answer in ((j1, joints[0]), (j2, joints[1])))
        count = 0
        while at.size:
            roots, n2, ex, ey = _errors(a, th1, th2, phi[at], x[at], y[at], (l3[at], l1[at], l2[at]))
            fine = np.maximum(ex ^ ex >> 63, ey ^ ey >> 63) < 1 << 17
            ex, ey = (np.where(fine, e, np.clip(e >> 4, -(1 << 17), (1 << 17) - 1)) for e in (ex, ey))
            square = _sum(ex, ex, ey, ey)
            done = fine & (square < tol[at])
            stop = done | (count == limit[at])
            singular = (n2 >= -GUARD) & (n2 < GUARD) | (l1[at] == 0) | (l2[at] == 0)
            joints[:, at[stop]] = th1[stop], th2[stop]
            out[:, at[stop]] = (np.full(stop.sum(), count), square[stop], 1 - fine[stop],
                                np.where(done, 0, 8 + 2 * singular)[stop])
            back, on = _step(a, roots, n2, fine, ex, ey, (r1[at], r2[at]), damp[at], mu[at])
            th1, th2 = th1 - back & mask, th2 + back + on & mask
            at, th1, th2, count = at[~stop], th1[~stop], th2[~stop], count + 1
    third = phi - joints.sum(axis=0) & mask
    shape = columns[0].shape
    names = ("j1", "j2", "j3", "iters", "error", "coarse", "status")
    return {f"out_{name}": row.reshape(shape) for name, row in zip(names, (*joints, third, *out))}
