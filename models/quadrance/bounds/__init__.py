"""This package has the error bounds as functions of the parameters, each with its derivation. Tests show them, pages
and reports quote them.

A family has a module, and the bound of the model `rational.ik2` is `bounds.rational.ik2`; the bounds of rtl/codec are
in `codec`. `tip` is the bound of any core of one to three joints.

`p` are the Verilog parameters of a core. Lengths and errors are in LSB of a coordinate, 2^-F units, where nothing else
is said. Errors of forward cores include half an LSB of rounding in each coordinate; errors of inverse cores are at the
tip, the float64 arm at the answered joints, beyond the rounding of the joint words themselves unless they say so.
Where a figure was found by search instead of derived, the docstring says "found".
"""

from __future__ import annotations

import math

from quadrance.bounds import classic, paper, rational, table, vector
from quadrance.cores import Core


def tip(core: Core, l1: int, l2: int) -> float:
    """Greatest tip error of a kinematic core, LSB.

    Parameters
    ----------
    core : Core
        Of one to three joints.
    l1, l2 : int
        Link lengths in LSB, together at most 2^(W-2) (64 units of Q7.8); one joint moves the first link.

    Returns
    -------
    float
        Forward: distance of the answered point, rounding included. Inverse: see the module. The inverse cores of two
        and three joints of `rational` and `classic` keep 2 LSB a unit and more from the shoulder and from the stretched
        and the folded arm (found; next to these see `rational.ik2` and `classic.ik`); forward, the coordinate's bound
        is cut at what was found over all links of the tests.
    """
    p, family, function = core.params, core.family, core.function
    joints = int(function[-1])
    forward = function.startswith("fk")
    if family == "paper" and joints == 1:
        return math.sqrt(0.5) if forward else 0.0
    if family == "paper":
        return paper.forward(p, joints, l1, l2) if forward else paper.inverse(p, joints, l1, l2)
    if family == "table" and (forward or joints == 1):
        return math.sqrt(joints + (joints == 1)) * table.forward(p, joints, l1, l2) if forward else \
            table.direction(p) * l1
    if family == "vector":
        return vector.tip(p, joints, l1, l2) if forward else 1e-9 * l1 if joints == 1 else 2.0  # ik1: float64 alone
    if joints == 1:
        if forward:
            return rational.fk1_tip(p, l1) if family == "rational" else classic.fk1(p, l1)
        return rational.direction(p) * l1 if family == "rational" else classic.ik1(p, l1)
    if not forward:
        return 2.0
    axis = min(rational.chain(p, joints, l1, l2), 1.0) if family == "rational" else \
        min(classic.chain(p, joints, l1, l2), {2: 2.0, 3: 2.8}[joints])
    return math.sqrt(joints) * axis
