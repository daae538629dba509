"""Bit-true model of engine_quaternion_dls: damped least squares for the planar arm of two joints.

It is engine_newton_3r without its third link, and the last step; `newton_fixed.config` makes its words. In float64 the
step is `newton.wrist_step` with the target for the wrist: (J^T J + lambda)^-1 J^T E of the turns of link 1 and of both
joints, each times its length.
"""

from __future__ import annotations

import numpy as np

from quadrance.fixed import Ints, ints, wrap
from quadrance.iterative import newton_fixed

Params = dict[str, int]


def _begin(warm: Ints, given: Ints, answers: Ints) -> Ints:
    """The word that each sample began with: its own, or the answer before it, 0 before the first."""
    before = np.roll(answers, 1)
    before.flat[:1] = 0
    return np.where(warm == 0, given, before)


def solve(p: Params, *, in_x: Ints, in_y: Ints, in_j1: Ints, in_j2: Ints, in_warm: Ints, cfg_limit: Ints,
          **cfg: Ints) -> dict[str, Ints]:
    """Every sample by itself, or from the one before it if warm; `cfg`: the other configuration words."""
    x, y, j1, j2, warm = np.broadcast_arrays(*map(ints, (in_x, in_y, in_j1, in_j2, in_warm)))
    same = {"in_x": x, "in_y": y, "in_phi": 0, "cfg_l3": 0} | cfg
    answer = newton_fixed.solve(p, in_j1=j1, in_j2=j2, in_warm=warm, cfg_limit=cfg_limit, **same)
    del answer["out_j3"]
    less = newton_fixed.solve(p, in_j1=_begin(warm, j1, answer["out_j1"]), in_j2=_begin(warm, j2, answer["out_j2"]),
                              in_warm=0, cfg_limit=np.maximum(answer["out_iters"] - 1, 0), **same)
    return answer | {f"out_d{i}": wrap(answer[f"out_j{i}"] - less[f"out_j{i}"], p["A"]) for i in (1, 2)}
