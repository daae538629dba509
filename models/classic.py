"""Bit-true models of rtl/classic: kinematics by CORDIC, binary joint angles, 2^A to the turn."""

from __future__ import annotations

import math

import numpy as np
from quadrance.cordic import OVERFLOW, SINGULAR, aim, turn
from quadrance.fixed import Ints, hold_last, ints, saturate, wrap

GUARD = 4  # fraction bits below a coordinate LSB
ROUND = 14  # half an LSB, and 6 units for what rounds down
AIM_GUARD = 3
SHRINK = math.prod((1 + 4.0**-i) ** -0.5 for i in range(40))  # 0.607252935: what all micro-rotations lengthen, undone


def config(p: dict[str, int], *, cfg_l1: int, cfg_l2: int = 0) -> dict[str, int]:
    """Start vectors of link lengths u(W-F).F: `cfg_c1` as classic_fk1 wants it.

    It stops 3 LSB below the longest word, where rounding could no longer tell plus from minus.
    """
    longest = (1 << p["W"]) - 3
    return {"cfg_c1": math.floor(min(cfg_l1, longest) * SHRINK * 2**GUARD)}


def fk1(p: dict[str, int], *, in_j1, cfg_c1) -> dict[str, Ints]:
    """``x = L1 cos j1, y = L1 sin j1``: from the middle of the quadrant; error at most 1 LSB up to L1 = 2^(W-2)."""
    width, turn_bits = p["W"], p["A"]
    in_j1, cfg_c1 = np.broadcast_arrays(ints(in_j1), ints(cfg_c1))
    top, next_bit = in_j1 >> turn_bits - 1 & 1, in_j1 >> turn_bits - 2 & 1
    x, y = cfg_c1 ^ -(top ^ next_bit), cfg_c1 ^ -top
    z = wrap(in_j1 + (1 << turn_bits - 3), turn_bits - 2) << width + 5 - turn_bits
    x, y = turn(width, x, y, z + 2, ROUND)
    (out_x, over_x), (out_y, over_y) = (saturate(v >> GUARD, width) for v in (x, y))
    return {"out_x": out_x, "out_y": out_y, "out_status": OVERFLOW * (over_x | over_y)}


def ik1(p: dict[str, int], *, in_x, in_y) -> dict[str, Ints]:
    """``j1 = atan2(y, x)``; at the origin the last angle stays (0 before there was one)."""
    in_x, in_y = np.broadcast_arrays(ints(in_x), ints(in_y))
    origin = (in_x == 0) & (in_y == 0)
    _, angle = aim(p["W"], p["A"], AIM_GUARD, in_x, in_y, False)
    return {"out_j1": hold_last(angle, ~origin), "out_status": SINGULAR * origin.astype(np.int64)}
