"""Bit-true model of rational_fk1: `rational.fk1` up to W = 18, above it a chain whose second link has no length.

Source: rational-trigonometry paper, Table I and eqs. 51 and 52. Shapes and formats: `rational`.
"""

from __future__ import annotations

from quadrance import rational
from quadrance.fixed import Ints

Params = dict[str, int]


def fk1(p: Params, *, in_j1: Ints, cfg_l1: Ints) -> dict[str, Ints]:
    """``x = L1 cos, y = L1 sin``, nearest (ties upward) and saturated; within `bounds.rational.fk1` LSB."""
    if p["W"] <= 18:
        return rational.fk1(p, in_j1=in_j1, cfg_l1=cfg_l1)
    return rational.fk2(p | {"U": p["W"]}, in_j1=in_j1, in_j2=0, cfg_l1=cfg_l1, cfg_l2=0)
