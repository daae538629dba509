"""Is an arm file right, and is its scale the one to take?"""

from __future__ import annotations

import math

from quadrance import arms
from quadrance.arms import REACH, Arm, ArmError
from quadrance.cli.catalogue import Refused, choose

STEPS = (1.0, 1.25, 2.0, 2.5, 4.0, 5.0, 8.0, 10.0)
F = 8  # fraction bits of the cores' first sets


def load(name_or_path: str) -> Arm:
    """The arm of that name or file; Refused with the reason, and with the names that are near."""
    if "." not in name_or_path and "/" not in name_or_path:
        choose("arm", name_or_path, arms.known())
    try:
        return arms.load(name_or_path)
    except ArmError as error:
        raise Refused(str(error)) from None


def scale(arm: Arm) -> float:
    """The smallest plain mm_per_unit at which the whole reach fits Q7.8: the finest LSB of the first sets."""
    least = (arm.l1 + arm.l2) / REACH
    tens = 10.0 ** math.floor(math.log10(least))
    return next(round(tens * step, 12) for step in STEPS if tens * step >= least)


def check(arm: Arm) -> dict:
    """What an arm file says, in the words of the cores."""
    best = scale(arm)
    advice = [] if arm.mm_per_unit <= best else [
        f"mm_per_unit = {best:g} would do: an LSB of {best / 2**F * 1000:.4g} um in place of "
        f"{arm.mm_per_unit / 2**F * 1000:.4g} um"]
    if len(arm.limits) == 2 and arm.base:
        advice.append("base is given and limits.yaw is not: a SCARA has no use for the shoulder's height")
    if any(high - low > 360 for low, high in arm.limits):
        advice.append("a joint turns by more than 360 degrees: its words are modulo a turn, count the turns outside")
    return {"arm": arm.id, "name": arm.name, "source": arm.source, "joints": len(arm.limits),
            "l1_mm": arm.l1, "l2_mm": arm.l2, "reach_mm": [abs(arm.l1 - arm.l2), arm.l1 + arm.l2],
            "limits_degrees": [list(pair) for pair in arm.limits], "mm_per_unit": arm.mm_per_unit,
            "units": {"l1": arm.links[0], "l2": arm.links[1], "reach": sum(arm.links), "largest": REACH},
            "lsb_mm": arm.mm_per_unit / 2**F, "best_mm_per_unit": best,
            "functions": ["fk2", "ik2"] if len(arm.limits) == 2 else ["fk3", "ik3"], "advice": advice}
