"""Corners of quaternion_to_matrix and rotation_check: unit quaternions and rotations, and what is nearly none."""

from __future__ import annotations

import itertools

import numpy as np
from quadrance.cores import Core

from tb.lib import stimulus
from tb.lib.stimulus import Vectors


def configs(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """They have no configuration."""
    return [{}]


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Quaternions of the one, matrices of the other."""
    return (quaternions if core.function == "quaternion_to_matrix" else matrices)(core, np.random.default_rng(1))


def length_off(words: np.ndarray, bits: int) -> np.ndarray:
    """|q|^2 - 1 of words (N, 4) as quaternion_to_matrix forms it, in 2^-(U + 4): truncated squares and half a unit."""
    return (words * words >> bits - 4).sum(axis=-1) + 8 - (1 << bits + 4)


def length_borders(bits: int, rng: np.random.Generator) -> np.ndarray:
    """(N, 4) words on both sides of both borders of length: the last that pass and the first that do not."""
    one, limit = 1 << bits, max(1 << bits - 5, 64)
    found = []
    for border in (-limit, limit):
        q = rng.normal(size=(20_000, 4))
        q *= np.sqrt(1 + border / 16 / one) / np.linalg.norm(q, axis=1, keepdims=True)
        words = np.rint(q * one).astype(np.int64)
        off = length_off(words, bits)
        found += [words[off == value][:15] for value in (border - 1, border)]
    return np.concatenate(found)


def quaternions(core: Core, rng: np.random.Generator) -> Vectors:
    """Unit quaternions anywhere, beside the axes and next to the border of length; words at their ends; the first two
    are none, so that the unit matrix of a reset shows."""
    bits = core.params["U"]
    one = 1 << bits
    q = rng.normal(size=(600, 4)) * np.where(rng.random((600, 4)) < 0.3, 1e-3, 1)
    q /= np.linalg.norm(q, axis=1, keepdims=True)
    q[300:] *= np.sqrt(1 + rng.choice([-1, 1], (300, 1)) * (max(2.0**-9, 4 / one) + rng.uniform(-4, 4, (300, 1)) / one))
    edge = np.array([rng.choice(stimulus.extremes(port), 100) for port in core.inputs]).T
    halves = np.array(list(itertools.product((-1, 1), repeat=4))) * one // 2
    words = np.concatenate([[[0] * 4] * 2, np.floor(q * one + 0.5).astype(int), edge, halves, length_borders(bits, rng),
                            np.vstack([np.eye(4, dtype=int), -np.eye(4, dtype=int)]) * one])
    words[2:] = rng.permutation(words[2:])
    return {port.name: words[:, i] for i, port in enumerate(core.inputs)}


def total(words: np.ndarray, one: int, kind: int) -> np.ndarray:
    """What rotation_check compares with 16 units, the first to the sixth sum of (N, 3, 3) words, in 2^-2U."""
    a, b, c = words.transpose(2, 1, 0)
    if kind < 3:
        return ((b if kind == 1 else a) * (a if kind == 0 else b)).sum(axis=0) - (one**2 if kind < 2 else 0)
    i, j, k = (kind - 2) % 3, (kind - 1) % 3, kind - 3
    return a[i] * b[j] + ~a[j] * b[i] - c[k] * one


def borders(one: int, rng: np.random.Generator) -> np.ndarray:
    """(N, 3, 3) words of rotations but for one sum, which is within 8 of its border in 2^-2U: the last that passes, and
    the first that does not, to the low bits of the sum."""
    steps = np.stack(np.meshgrid(*[np.arange(-8, 9)] * 3), axis=-1).reshape(-1, 3)
    found = []
    for kind in range(6):
        some: list[np.ndarray] = []
        i, j, k = (kind - 2) % 3, (kind - 1) % 3, kind % 3
        at = [(i, 0), (j, 0), (i, 1)] if kind > 2 else [(row, int(kind == 1)) for row in range(3)]
        for turn in np.linalg.qr(rng.normal(size=(150, 3, 3)))[0]:
            turn *= np.linalg.det(turn)
            side = 16 * rng.choice([-1, 1]) / one
            if kind < 2:
                turn[:, kind] *= np.sqrt(1 + side)
            elif kind == 2:
                turn[:, 0] += side * turn[:, 1]
            else:
                turn[k, 2] += side
            words = np.tile(np.rint(turn * one).astype(np.int64), (len(steps), 1, 1))
            for (row, column), step in zip(at, steps.T):
                words[:, row, column] += step
            off = total(words, one, kind)
            words = words[np.abs(np.where(off < 0, ~off, off) - 16 * one + 0.5) < 8]
            others = np.array([total(words, one, other) for other in range(6) if other != kind])
            some += list(words[np.all((others >= -16 * one) & (others < 16 * one), axis=0)][:4])
        found += some[:40]
    return np.array(found)


def matrices(core: Core, rng: np.random.Generator) -> Vectors:
    """Rotations, each of the six sums next to its slack, alone; borders to the unit at the axes; ends of words."""
    one = 1 << core.params["U"]
    turns = np.linalg.qr(rng.normal(size=(700, 3, 3)))[0]
    turns *= np.linalg.det(turns)[:, None, None]
    near = turns.copy()
    off = rng.choice([-1, 1], 700) * (16 + rng.uniform(-4, 4, 700)) / one
    for i in range(100, 700):
        kind, e = i % 6, off[i]
        if kind < 2:
            near[i, :, kind] *= np.sqrt(1 + e)
            near[i, :, 2] *= np.sqrt(1 + e)
        elif kind == 2:
            near[i, :, 0] += e * near[i, :, 1]
        else:
            near[i, kind - 3, 2] += e
    axes = np.tile(np.eye(3, dtype=int) * one, (66, 1, 1))
    for i, axis in enumerate(axes):
        axis[:] = axis[rng.permutation(3)]
        axis[:, 2] = np.cross(axis[:, 0] // one, axis[:, 1] // one) * one
        axis[i % 3, rng.integers(3)] += [0, *range(14, 19), *range(-18, -13)][i % 11]
    edge = np.array([rng.choice(stimulus.extremes(port), 100) for port in core.inputs]).T.reshape(-1, 3, 3)
    mirror = turns[:20] * [1, 1, -1]
    words = np.concatenate([np.rint(near * one).astype(int), axes, borders(one, rng),
                            np.rint(mirror * one).astype(int), edge, np.zeros((1, 3, 3), dtype=int)]).reshape(-1, 9)
    return dict(zip((port.name for port in core.inputs), rng.permutation(words).T))
