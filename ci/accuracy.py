"""`make accuracy ARM=... CORE=...` prints the errors of one core on an arm, computed by its bit-true model."""

from __future__ import annotations

import sys

from quadrance import accuracy
from quadrance.cli import check
from quadrance.cli.catalogue import Refused, find

from ci.report import measure


def lines(arm_name: str, core_name: str) -> list[str]:
    """What is printed; Refused where arm and core do not go together."""
    core, arm = find(core_name), check.load(arm_name)
    if core.function not in accuracy.JOINTS:
        raise Refused(f"{core.name} is a part, no kinematic core: its error does not depend on an arm")
    row = measure.simulate(core, arm_name, measure.modelled)

    def both(what: str, lsb: float | None, mm: float | None) -> str:
        return f"  {what:44s} {lsb:9.3f} LSB {mm:10.4f} mm"

    scale = accuracy.mm_per_lsb(core, arm)
    found = [f"{core.id} on {arm.name}, one LSB is {scale:.5g} mm; latency {row['latency_cycles']}, "
             f"a sample every {row['ii']} clocks"]
    for what, error in (("arithmetic, along the trajectory", row["error_lsb"]),
                        ("arithmetic, random and border inputs", row["sweep_error_lsb"])):
        if error:
            found.append(both(f"{what}, worst", error["max"], error["max"] * scale))
    for key, what in (("words", "rounding of the words alone, worst"), ("total", "total at the tip, worst")):
        if row[f"{key}_lsb"] is not None:
            found.append(both(what, row[f"{key}_lsb"], row[f"{key}_mm"]))
    return found


def main() -> None:
    """Do what the command line says."""
    if len(sys.argv) != 3:
        raise SystemExit("accuracy: give an arm and a core: make accuracy ARM=mine.toml CORE=table_ik2")
    try:
        print("\n".join(lines(*sys.argv[1:])))
    except (Refused, ValueError) as error:
        raise SystemExit(f"accuracy: {error}") from None


if __name__ == "__main__":
    main()
