"""Bit-true models of rtl/table: binary joint angles, 2^A to the turn, by tables and products."""

from __future__ import annotations

import numpy as np

from quadrance import codecs
from quadrance.fixed import Ints, ints, round_shift, saturate

Params = dict[str, int]

GUARD = 4  # fraction bits of a sum below a coordinate's LSB


# Forward


def sizes(p: Params, joints: int) -> tuple[int, int]:
    """(K, T): fraction bits of a sine, address bits of its table."""
    return p["W"] + 1, min((p["W"] + (5 if joints == 3 else 3)) // 2, p["A"] - 1)


def _unit(p: Params, joints: int, word: Ints) -> tuple[Ints, Ints]:
    """(cos, sin) of a joint word, units of 2^-K."""
    return tuple(codecs.angle_chord(*sizes(p, joints), p["A"], word, cosine) for cosine in (True, False))


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
