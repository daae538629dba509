"""Bit-true models of the iterative solvers of rtl/engine, and their configuration words."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from quadrance import codecs
from quadrance.fixed import Ints, ints, saturate, wrap

Params = dict[str, int]
# samples, their range (1: fine), joints (n, samples) -> squared error in its range, joints and steps of the next pass
Pass = Callable[[Ints, Ints, Ints], tuple[Ints, Ints, Ints]]
GUARD = 4  # bits of a unit vector inside beyond those of its port
TURN = 2 * np.pi


def _unit(p: Params) -> float:
    """The alpha of cfg_alpha = 1 and cfg_shift = 0, in 1 / LSB^2."""
    return TURN / 2.0 ** (3 * p["W"] - 2)


def _unit_vector(p: Params) -> float:
    return 2.0 ** (6 - 3 * p["W"])


def _alpha_of(cfg_l1: int, cfg_l2: int, gain: float) -> float:
    longest = max(cfg_l1, cfg_l2)
    if longest <= 0 or gain <= 0:
        raise ValueError("a step needs a link and a gain above 0")
    return gain / longest**2


def config(p: Params, *, cfg_l1: int, cfg_l2: int, gain: float = 1.0) -> dict[str, int]:
    """Words of the step for alpha = gain / max(L1, L2)^2, lengths in LSB; the paper's examples have a gain of 0.33.

    Stable in reach below a gain of 2 / (1 + (1 + L2 / L1)^2) at full stretch with L1 >= L2: 0.4 with equal links.
    Raises ValueError where the arm is too short for its word: its longer link is to be 2^(W-3) LSB at gain 0.78.
    """
    return step_words(p, _alpha_of(cfg_l1, cfg_l2, gain), shifts=2)


def config_vector(p: Params, *, cfg_l1: int, cfg_l2: int, gain: float = 1.0) -> dict[str, int]:
    """As `config`, for the engine of unit vectors, whose steps are in radians."""
    return step_words(p, _alpha_of(cfg_l1, cfg_l2, gain), shifts=2, unit=_unit_vector(p))


def step_words(p: Params, alpha: float, shifts: int, unit: float | None = None) -> dict[str, int]:
    """cfg_alpha and cfg_shift of `alpha` in 1 / LSB^2, with the greatest of so many shifts that fits.

    `unit`: the alpha of the words 1 and 0. Raises ValueError where none fits, or less than one unit is left.
    """
    for shift in range(shifts)[::-1]:
        word = round(alpha * 4.0**shift / (_unit(p) if unit is None else unit))
        if 0 < word < 1 << p["W"] + 1:
            return {"cfg_alpha": word, "cfg_shift": shift}
    raise ValueError(f"no word for a step of {alpha:g} / LSB^2: take a finer unit of length where it is too long, "
                     "a coarser one where it is too short")


def alpha(p: Params, cfg_alpha: int, cfg_shift: int) -> float:
    """What the words of `config` mean, in 1 / LSB^2."""
    return cfg_alpha * _unit(p) / 4.0**cfg_shift


def alpha_vector(p: Params, cfg_alpha: int, cfg_shift: int) -> float:
    """What the words of `config_vector` mean, in 1 / LSB^2."""
    return cfg_alpha * _unit_vector(p) / 4.0**cfg_shift


def _seen(w: int, fine: Ints, error: Ints) -> Ints:
    """The operand of an error in 1/64 LSB: as it is in the fine range, in 1/4 LSB in the coarse one, saturated."""
    return saturate(np.where(fine, error, error >> 4), w + 2)[0]


def levels(warm: Ints) -> Iterator[Ints]:
    """Indices of samples that start by themselves; then of those after them that start from their answers; and so on.
    """
    index = np.arange(warm.size)
    depth = index - np.maximum.accumulate(np.where(warm == 0, index, -1))
    for level in range(int(depth.max(initial=-1)) + 1):
        yield np.flatnonzero(depth == level)


def _descend(p: Params, start: Ints, home: Ints, warm: Ints, tol: Ints, limit: Ints, one_pass: Pass, steps: int
             ) -> tuple[Ints, Ints, dict[str, Ints]]:
    """Joints (n, samples) of the answers, their last steps (steps, samples), and the other words.

    Every sample from its own start (n, samples), or from the answer before it where warm, `home` (n,) before the first.
    """
    size = warm.size
    joints, moved, out = np.zeros_like(start), np.zeros((steps, size), np.int64), np.zeros((4, size), np.int64)
    for at in levels(warm):
        before = np.where(at > 0, joints[:, at - 1], home[:, None])
        now = np.where(warm[at] == 0, start[:, at], before)
        fine, count, last = np.ones_like(at), np.zeros_like(at), np.zeros((steps, at.size), np.int64)
        while at.size:
            square, new, step = one_pass(at, fine, now)
            wide = (fine == 1) & (square >> 2 * p["W"] - 3 != 0)
            done = (fine == 1) & (square < tol[at])
            stop = done | (count == limit[at]) & ~wide
            where = at[stop]
            joints[:, where], moved[:, where] = now[:, stop], last[:, stop]
            out[:, where] = count[stop], square[stop], 1 - fine[stop], 8 * ~done[stop]
            now, last = np.where(wide, now, new), np.where(wide, last, step)
            count = count + ~wide
            fine = ints(~wide & ((fine == 1) | (square >> 2 * p["W"] - 13 == 0)))
            at, now, last, fine, count = at[~stop], now[:, ~stop], last[:, ~stop], fine[~stop], count[~stop]
    return joints, moved, dict(zip(("out_iters", "out_error", "out_coarse", "out_status"), out))


def _together(*words: Ints) -> tuple[Ints, ...]:
    return tuple(np.atleast_1d(*np.broadcast_arrays(*map(ints, words))))


def gd(p: Params, *, in_x: Ints, in_y: Ints, in_j1: Ints, in_j2: Ints, in_warm: Ints, cfg_l1: Ints, cfg_l2: Ints,
       cfg_alpha: Ints, cfg_shift: Ints, cfg_tol: Ints, cfg_limit: Ints) -> dict[str, Ints]:
    """Gradient descent of the planar arm of two joints: every sample by itself, or from the one before it if warm."""
    shape = np.broadcast_shapes(*map(np.shape, (in_x, in_j1, in_warm, cfg_l1)))
    j1, j2, warm, tol, limit, *cfg = _together(in_j1, in_j2, in_warm, cfg_tol, cfg_limit, in_x, in_y, cfg_l1, cfg_l2,
                                               cfg_alpha, cfg_shift)
    w, a = p["W"], p["A"]

    def one_pass(at: Ints, fine: Ints, joints: Ints) -> tuple[Ints, Ints, Ints]:
        x, y, l1, l2, step, shift = (column[at] for column in cfg)
        th1, th2 = joints
        roots = [codecs.angle_chord(w + 1, (w + 4) // 2, a, word, cosine)
                 for word in (th1, th1 + th2) for cosine in (True, False)]
        links = [root * length for root, length in zip(roots, (l1, l1, l2, l2))]
        seen = [_seen(w, fine, (goal << 6) - (first >> w - 5) - (second >> w - 5))
                for goal, first, second in ((x, links[0], links[2]), (y, links[1], links[3]))]
        ax, ay = (step * error >> w + 1 for error in seen)
        x1, y1, x2, y2 = (link >> w for link in links)
        e1, e2 = ((u * ay >> 2 * w - a) - (v * ax >> 2 * w - a) >> 2 * shift + 4 * fine
                  for u, v in ((x1, y1), (x2, y2)))
        square = sum(error * error >> 4 for error in seen)
        return square, np.stack([th1 + e1 + e2, th2 + e2]) & (1 << a) - 1, wrap(np.stack([e1, e2]), a)

    joints, steps, out = _descend(p, np.stack([j1, j2]), np.zeros(2, np.int64), warm, tol, limit, one_pass, 2)
    out |= {"out_j1": joints[0], "out_j2": joints[1], "out_d1": steps[0], "out_d2": steps[1]}
    return {name: row.reshape(shape) for name, row in out.items()}


def no_unit(w: int, c: Ints, n: Ints) -> Ints:
    """Whether a start of s2.w is far from length 1, as the engine looks at it."""
    u, v = ((word ^ word >> w + 1) >> w - 3 & 15 for word in (c, n))
    return ints((u > 8) | (v > 8) | (u > 7) & (v > 3) | (v > 7) & (u > 3) | (u > 5) & (v > 5) | (u < 4) & (v < 4))


def gd_vector(p: Params, *, in_x: Ints, in_y: Ints, in_c1: Ints, in_n1: Ints, in_c12: Ints, in_n12: Ints,
              in_warm: Ints, cfg_l1: Ints, cfg_l2: Ints, cfg_alpha: Ints, cfg_shift: Ints, cfg_tol: Ints,
              cfg_limit: Ints) -> dict[str, Ints]:
    """As `gd`, with the direction of each link as a unit vector: turned by multiplication, then brought to length 1."""
    shape = np.broadcast_shapes(*map(np.shape, (in_x, in_c1, in_warm, cfg_l1)))
    c1, n1, c2, n2, warm, tol, limit, *cfg = _together(in_c1, in_n1, in_c12, in_n12, in_warm, cfg_tol, cfg_limit, in_x,
                                                       in_y, cfg_l1, cfg_l2, cfg_alpha, cfg_shift)
    w = p["W"]
    size, half = w + GUARD + 2, 1 << GUARD - 1  # half: the upper bits are the rounded word

    def one_pass(at: Ints, fine: Ints, joints: Ints) -> tuple[Ints, Ints, Ints]:
        x, y, l1, l2, step, shift = (column[at] for column in cfg)
        links = (joints >> GUARD) * np.stack([l1, l1, l2, l2])
        seen = [_seen(w, fine, wrap((goal << 6) - (links[i] >> w - 6) - (links[i + 2] >> w - 6), w + 9))
                for i, goal in enumerate((x, y))]
        ax, ay = (step * error >> w + 1 for error in seen)
        x1, y1, x2, y2 = wrap(links >> w - 1, w + 2)
        e1, e2 = ((u * ay >> w - 8) - (v * ax >> w - 8) >> 2 * shift + 4 * fine for u, v in ((x1, y1), (x2, y2)))
        turns = saturate(np.stack([e1 + e2, e1 + 2 * e2]), w + GUARD)[0]
        new = []
        for (c, n), turn in zip(joints.reshape(2, 2, -1), turns):
            c, n = wrap(np.stack([c - ((n >> GUARD) * turn >> w), n - (~(c >> GUARD) * turn >> w)]), size)
            gain = wrap(((c >> GUARD) ** 2 >> 4) + ((n >> GUARD) ** 2 >> 4) >> w - 7, w + GUARD, signed=False)
            gain = gain - (1 << w + GUARD - 1)
            new += [c - ((c >> GUARD) * gain >> w), n - ((n >> GUARD) * gain >> w)]
        square = sum(error * error >> 4 for error in seen)
        return square, wrap(np.stack(new), size), turns

    start = (np.stack([c1, n1, c2, n2]) << GUARD) + half
    home = (np.array([1, 0, 1, 0]) << w + GUARD) + half
    joints, steps, out = _descend(p, start, home, warm, tol, limit, one_pass, 2)
    # the flag of a start remains for the warm samples after it
    far = no_unit(w, c1, n1) | no_unit(w, c2, n2)
    cold = np.maximum.accumulate(np.where(warm == 0, np.arange(warm.size), -1))
    out["out_status"] |= 2 * np.where(cold >= 0, far[cold], 0)
    out |= dict(zip(("out_c1", "out_n1", "out_c12", "out_n12"), joints >> GUARD))
    out |= {"out_d1": steps[0], "out_d12": steps[1]}
    return {name: row.reshape(shape) for name, row in out.items()}


def gd_touch(p: Params, *, in_x: Ints, in_y: Ints, in_z: Ints, in_j1: Ints, in_j2: Ints, in_j3: Ints, in_warm: Ints,
             cfg_l1: Ints, cfg_l2: Ints, cfg_alpha: Ints, cfg_shift: Ints, cfg_tol: Ints, cfg_limit: Ints
             ) -> dict[str, Ints]:
    """As `gd`, of the Geomagic Touch: three joints in space, the third absolute."""
    shape = np.broadcast_shapes(*map(np.shape, (in_x, in_j1, in_warm, cfg_l1)))
    j1, j2, j3, warm, tol, limit, *cfg = _together(in_j1, in_j2, in_j3, in_warm, cfg_tol, cfg_limit, in_x, in_y, in_z,
                                                   cfg_l1, cfg_l2, cfg_alpha, cfg_shift)
    w, a = p["W"], p["A"]
    mask, half = (1 << a) - 1, 1 << a - 1

    def one_pass(at: Ints, fine: Ints, joints: Ints) -> tuple[Ints, Ints, Ints]:
        x, y, z, l1, l2, step, shift = (column[at] for column in cfg)
        words = (joints[0] + half, joints[0], joints[1], joints[2], joints[1], joints[2] + half)
        back, s1, c2, s3, s2, down = (codecs.angle_chord(w + 1, (w + 4) // 2, a, word & mask, cosine)
                                      for word, cosine in zip(words, (True, False, True, False, False, True)))
        links = [root * length for root, length in ((c2, l1), (s3, l2), (s2, l1), (down, l2))]
        v = -(back * z >> w - 5) - (s1 * x >> w - 5) - (links[0] >> w - 5) - (links[1] >> w - 5)
        up = (y << 6) - (links[2] >> w - 5) - (links[3] >> w - 5)
        u = (back * x >> w - 5) - (s1 * z >> w - 5)
        seen = [_seen(w, fine, error) for error in (v, up, u)]
        av, au, aw = (step * seen[i] >> w + 1 for i in (0, 2, 1))
        out, rise, lift, drop = (link >> w for link in links)
        cut = 2 * w - a
        e = [wrap(out + rise, w + 2) * au >> cut, (out * aw >> cut) - (lift * av >> cut),
             (rise * aw >> cut) - (drop * av >> cut)]
        steps = np.stack([one >> 2 * shift + 4 * fine for one in e])
        square = sum(error * error >> 4 for error in seen)
        return square, joints + steps & mask, wrap(steps, a)

    joints, steps, out = _descend(p, np.stack([j1, j2, j3]), np.zeros(3, np.int64), warm, tol, limit, one_pass, 3)
    out |= {f"out_{kind}{i + 1}": row for kind, rows in (("j", joints), ("d", steps)) for i, row in enumerate(rows)}
    return {name: row.reshape(shape) for name, row in out.items()}


def degrees(p: Params, word: Ints) -> np.ndarray:
    """A joint word in degrees, [-180, 180)."""
    return wrap(word, p["A"]) * 360.0 / (1 << p["A"])
