"""This module checks an arm file and recommends its scale."""

from __future__ import annotations

import math
from dataclasses import asdict

from quadrance import arms
from quadrance.arms import REACH, Arm, ArmError
from quadrance.cli import frames
from quadrance.cli.around import PLANE, WRISTED, inverse
from quadrance.cli.catalogue import Refused, choose, find
from quadrance.cli.verilog import config, fitted, takes_an_arm
from quadrance.cores import all_cores

STEPS = (1.0, 1.25, 2.0, 2.5, 4.0, 5.0, 8.0, 10.0)
F = 8  # fraction bits of the cores' first sets
STRUCTURE = ("limits.yaw", "links.l3", "wrist", "limits.upper: is missing")  # of an arm that is built otherwise


def load(name_or_path: str) -> Arm:
    """The arm of that name or file; Refused with the reason, and with the names that are near."""
    if "." not in name_or_path and "/" not in name_or_path:
        choose("arm", name_or_path, arms.known())
    try:
        return arms.load(name_or_path)
    except ArmError as error:
        raise Refused(str(error)) from None


def spans(arm: Arm) -> dict[str, float]:
    """Greatest magnitude of every coordinate, mm: of the tip with all that the file says, joint limits left aside."""
    far = arm.l1 + arm.l2 + (arm.l3 or 0)
    if not arm.yaws:
        return {"x and y": far}
    wrist = (arm.flange or 0) + abs(arm.d5 or 0) + abs(arm.d6 or 0)
    return {"x and y": math.hypot(far + abs(arm.shoulder), arm.lateral) + wrist, "z": abs(arm.base) + far + wrist}


def scale(arm: Arm) -> float:
    """The smallest plain mm_per_unit at which all coordinates and constants fit Q7.8: the finest LSB of the first sets.
    """
    least = max(*spans(arm).values(), 4 * abs(arm.shoulder)) / REACH  # a shoulder's word has a quarter of the range
    tens = 10.0 ** math.floor(math.log10(least))
    return next(round(tens * step, 12) for step in STEPS if tens * step >= least)


def functions(arm: Arm) -> tuple[list[str], dict[str, list[str]]]:
    """Functions whose cores serve the arm, those of all its joints first; those that could but do not, by the reason.
    """
    found, refused = [], {}
    listed = {core.function: core for core in all_cores() if core.first_set and takes_an_arm(core)}
    for function, core in sorted(listed.items(), key=lambda one: (
            inverse(one[1]).family not in WRISTED, one[0] in PLANE, one[0] in ("fk1", "ik1"))):
        try:
            config(fitted(core, arm, {}), arm)
            found.append(function)
        except Refused as error:
            reason = str(error).partition(f"{arm.id}: ")[2]
            if reason.partition(":")[0] not in STRUCTURE and reason.partition(",")[0] not in STRUCTURE:
                refused.setdefault(reason, []).append(function)
    return found, refused


def served(rows: list[dict], arm: Arm) -> tuple[list[dict], dict[str, list[str]]]:
    """Of lines of the table of cores those that the arm can use, and the names of the others by the reason."""
    kept, refused = [], {}
    for row in rows:
        try:
            config(fitted(find(row["id"]), arm, {}), arm)
            kept.append(row)
        except Refused as error:
            reason = str(error).partition(f"{arm.id}: ")[2] or str(error).partition(": ")[2]
            refused.setdefault(reason, []).append(row["title"])
    if not kept:
        raise Refused(f"none of these cores serves {arm.id}: {'; '.join(refused)}")
    return kept, refused


def check(arm: Arm) -> dict:
    """What an arm file says, in the words of the cores."""
    best, found, advice = scale(arm), spans(arm), []
    over = {axis: length / arm.mm_per_unit for axis, length in found.items() if length / arm.mm_per_unit > REACH}
    if over:
        needs = " and ".join(f"{axis} to {length:.4g}" for axis, length in over.items())
        advice.append(f"raise mm_per_unit to {best:g}: at {arm.mm_per_unit:g} the arm takes {needs} of "
                      f"{REACH + 2**-F:g} units, and a core saturates there and flags overflow")
    elif arm.mm_per_unit > best:
        advice.append(f"mm_per_unit = {best:g} would do: an LSB of {best / 2**F * 1000:.4g} um in place of "
                      f"{arm.mm_per_unit / 2**F * 1000:.4g} um")
    if not arm.yaws and arm.base:
        advice.append("base is given and limits.yaw is not: a SCARA has no use for the shoulder's height")
    limits = [*arm.limits, *[arm.upper_limit] * (arm.upper_limit is not None)]
    if any(high - low > 360 for low, high in limits):
        advice.append("a joint turns by more than 360 degrees: its words are modulo a turn, count the turns outside")
    if not arm.joints:
        advice.append("joints is not given: the machine's joints are taken for the cores' own")
    serving, refused = functions(arm)
    return {"arm": arm.id, "name": arm.name, "source": arm.source, "joints": len(arm.limits),
            "axes": arm.axes,
            "l1_mm": arm.l1, "l2_mm": arm.l2, "reach_mm": [abs(arm.l1 - arm.l2), arm.l1 + arm.l2],
            "limits_degrees": [list(pair) for pair in limits], "mm_per_unit": arm.mm_per_unit,
            "machine": [asdict(one) for one in arm.joints], "frames": frames.lines(arm),
            "units": {"l1": arm.links[0], "l2": arm.links[1], "reach": sum(arm.links), "largest": REACH}
            | {axis: length / arm.mm_per_unit for axis, length in found.items()},
            "lsb_mm": arm.mm_per_unit / 2**F, "best_mm_per_unit": best,
            "functions": serving, "refused": refused, "advice": advice}
