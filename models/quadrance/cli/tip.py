"""This module has the errors of one core at the tip of an arm, by its bit-true model."""

from __future__ import annotations

from quadrance import accuracy
from quadrance.accuracy import of_core, pose
from quadrance.arms import Arm
from quadrance.cli.catalogue import Refused, timing
from quadrance.cores import Core

# functions that have an error in mm, by the names that a user gives
SERVED = (*accuracy.JOINTS, *(name for name in pose.FUNCTIONS if not name.endswith(("_all", "_angles"))))


def measured(core: Core, arm: Arm) -> dict:
    """The errors as `quadrance accuracy --json` prints them, of a core that the arm can use."""
    if core.function not in (*accuracy.JOINTS, *pose.FUNCTIONS):
        raise Refused(f"no error in mm is defined for {core.function}; there are {', '.join(SERVED)}")
    about = {"core": core.id, "params": core.params, "arm": arm.id, "mm_per_lsb": accuracy.mm_per_lsb(core, arm)}
    if core.function in accuracy.JOINTS:
        return about | of_core.figures(core, arm)
    worst = pose.worst(core, arm, of_core.WORKSPACE)
    return about | {"total_mm": worst.mm, "total_lsb": worst.mm / about["mm_per_lsb"], "total_degrees": worst.degrees,
                    "beside_axis_mm": worst.beside_mm}


def lines(core: Core, arm: Arm, about: dict) -> list[str]:
    """The same for a person."""
    scale = about["mm_per_lsb"]

    def both(what: str, lsb: float, mm: float) -> str:
        return f"  {what:44s} {lsb:9.3f} LSB {mm:10.4f} mm"

    found = [f"{about['core']} on {arm.name}, one LSB is {scale:.5g} mm; {timing(core)}"]
    for key, what in (("error_lsb", "arithmetic, along the trajectory"),
                      ("sweep_error_lsb", "arithmetic, random and border inputs")):
        if error := about.get(key):
            found.append(both(f"{what}, worst", error["max"], error["max"] * scale))
    for key, what in (("words", "rounding of the words alone, worst"), ("total", "total at the tip, worst")):
        if about.get(f"{key}_lsb") is not None:
            found.append(both(what, about[f"{key}_lsb"], about[f"{key}_mm"]))
    if (mm := about.get("beside_axis_mm")) is not None:
        where = f"wrist within {arm.singular[1]:g} mm of axis 1{' in the plane' * core.function.startswith('ur_')}"
        found.append(both(f"{where}, worst", mm / scale, mm))
    if about.get("total_degrees") is not None:
        found.append(f"  {'orientation, worst':44s} {about['total_degrees']:9.4f} degrees")
    return found
