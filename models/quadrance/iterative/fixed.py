"""Bit-true models of the iterative solvers of rtl/engine, and their configuration words."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from quadrance import codecs
from quadrance.fixed import Ints, ints, wrap

Params = dict[str, int]


def config(p: Params, *, cfg_l1: int, cfg_l2: int, gain: float = 1.0) -> dict[str, int]:
    """Words of the step for alpha = gain / max(L1, L2)^2, lengths in LSB; the paper's examples have a gain of 0.33.

    Stable in reach below a gain of 2 / (1 + (1 + L2 / L1)^2) at full stretch with L1 >= L2: 0.4 with equal links.
    Raises ValueError where the arm is too short for its word: its longer link is to be 2^(W-3) LSB at gain 0.78.
    """
    w, longest = p["W"], max(cfg_l1, cfg_l2)
    if longest <= 0 or gain <= 0:
        raise ValueError("a step needs a link and a gain above 0")
    for shift in (1, 0):
        word = round(gain / longest**2 * 2.0 ** (3 * w - 2 + 2 * shift) / (2 * np.pi))
        if word < 1 << w + 1:
            return {"cfg_alpha": word, "cfg_shift": shift}
    raise ValueError(f"links of at most {longest} LSB at a gain of {gain:g}: take a finer unit of length")


def alpha(p: Params, cfg_alpha: int, cfg_shift: int) -> float:
    """What the words mean, in 1 / LSB^2."""
    return cfg_alpha * 2 * np.pi / 2.0 ** (3 * p["W"] - 2 + 2 * cfg_shift)


def levels(warm: Ints) -> Iterator[Ints]:
    """Indices of samples that start by themselves; then of those behind them that start from their answers; and so on.
    """
    index = np.arange(warm.size)
    depth = index - np.maximum.accumulate(np.where(warm == 0, index, -1))
    for level in range(int(depth.max(initial=-1)) + 1):
        yield np.flatnonzero(depth == level)


def _pass(p: Params, fine: Ints, th1: Ints, th2: Ints, x: Ints, y: Ints, l1: Ints, l2: Ints, step: Ints,
          shift: Ints) -> tuple[Ints, Ints, Ints]:
    """The squared error in its range, and what links 1 and 2 ask for, at joints th1, th2."""
    w, a = p["W"], p["A"]
    roots = [codecs.angle_chord(w + 1, (w + 4) // 2, a, word, cosine)
             for word in (th1, th1 + th2) for cosine in (True, False)]
    links = [root * length for root, length in zip(roots, (l1, l1, l2, l2))]
    ax_ay, square = [], np.zeros_like(th1)
    for goal, first, second in ((x, links[0], links[2]), (y, links[1], links[3])):
        error = (goal << 6) - (first >> w - 5) - (second >> w - 5)
        seen = np.clip(np.where(fine, error, error >> 4), -(1 << w + 1), (1 << w + 1) - 1)
        square = square + (seen * seen >> 4)
        ax_ay.append(step * seen >> w + 1)
    (ax, ay), cut = ax_ay, 2 * w - a
    x1, y1, x2, y2 = (link >> w for link in links)
    steps = [(u * ay >> cut) - (v * ax >> cut) >> 2 * shift + 4 * fine for u, v in ((x1, y1), (x2, y2))]
    return square, *steps


def gd(p: Params, *, in_x: Ints, in_y: Ints, in_j1: Ints, in_j2: Ints, in_warm: Ints, cfg_l1: Ints, cfg_l2: Ints,
       cfg_alpha: Ints, cfg_shift: Ints, cfg_tol: Ints, cfg_limit: Ints) -> dict[str, Ints]:
    """Gradient descent of the planar arm of two joints: every sample by itself, or from the one before it if warm."""
    columns = np.broadcast_arrays(*map(ints, (in_x, in_y, in_j1, in_j2, in_warm, cfg_l1, cfg_l2, cfg_alpha, cfg_shift,
                                              cfg_tol, cfg_limit)))
    x, y, j1, j2, warm, l1, l2, step, shift, tol, limit = (np.atleast_1d(column) for column in columns)
    size, mask = x.size, (1 << p["A"]) - 1
    joints, out = np.zeros((2, size), dtype=np.int64), np.zeros((6, size), dtype=np.int64)
    for at in levels(warm):
        own = warm[at] == 0
        th1, th2 = (np.where(own, given[at], np.where(at > 0, answer[at - 1], 0))
                    for given, answer in ((j1, joints[0]), (j2, joints[1])))
        fine, count = np.ones(at.size, dtype=np.int64), np.zeros(at.size, dtype=np.int64)
        last = np.zeros((2, at.size), dtype=np.int64)
        while at.size:
            square, e1, e2 = _pass(p, fine, th1, th2, *(column[at] for column in (x, y, l1, l2, step, shift)))
            wide = (fine == 1) & (square >> 2 * p["W"] - 3 != 0)
            done = (fine == 1) & (square < tol[at])
            stop = done | (count == limit[at]) & ~wide
            where = at[stop]
            joints[:, where] = th1[stop], th2[stop]
            out[:, where] = count[stop], square[stop], 1 - fine[stop], 8 * ~done[stop], *last[:, stop]
            moves = ~wide
            th1 = np.where(moves, th1 + e1 + e2, th1) & mask
            th2 = np.where(moves, th2 + e2, th2) & mask
            last = np.where(moves, wrap(np.stack([e1, e2]), p["A"]), last)
            count = count + moves
            fine = ints(~wide & ((fine == 1) | (square >> 2 * p["W"] - 13 == 0)))
            last = last[:, ~stop]
            at, th1, th2, fine, count = at[~stop], th1[~stop], th2[~stop], fine[~stop], count[~stop]
    shape = columns[0].shape
    names = ("j1", "j2", "iters", "error", "coarse", "status", "d1", "d2")
    return {f"out_{name}": row.reshape(shape) for name, row in zip(names, (*joints, *out))}


def degrees(p: Params, word: Ints) -> np.ndarray:
    """A joint word in degrees, [-180, 180)."""
    return wrap(word, p["A"]) * 360.0 / (1 << p["A"])
