"""A day of four real arms through the Verilog: bit-true, and its tip in millimetres beside float64."""

from __future__ import annotations

import numpy as np
import pytest
from quadrance import accuracy, arms, bounds
from quadrance.cores import Core, all_cores

from tb.lib import bulk, legal

SAMPLES = 2000
ARMS = ("cobra600", "linuxcnc_scara", "staubli_tx40", "geomagic_touch")


def kinematic() -> list[Core]:
    """The first parameter set of every kinematic core, all of Q7.8; a further PIPE has the same bits."""
    return [core for core in all_cores() if core.function in accuracy.JOINTS and legal.daily(core)]


@pytest.mark.full
@pytest.mark.parametrize("core", kinematic(), ids=lambda core: core.name)
def test_a_day_of_the_arm(core: Core, record_property) -> None:
    for name in ARMS:
        arm = arms.load(name)
        case = accuracy.trajectory_case(core, arm, SAMPLES)
        result = bulk.stream(core, case.inputs, case.cfg)
        bulk.compare(core, case.inputs, case.cfg, result)
        assert result.outputs.keys() == {port.name for port in core.outputs}
        errors = accuracy.errors(core, arm, case, result.outputs)
        assert errors.arithmetic.size == SAMPLES
        worst = float(np.max(errors.arithmetic))
        millimetres = worst * accuracy.mm_per_lsb(core, arm)
        record_property(f"{name}_mm", millimetres)
        if core.family != "paper":  # its bound depends on the links, and eight bits see a pole near the yaw axis
            assert not np.any(result.outputs["out_status"]), f"{name} raised a status bit"
            limit = bounds.tip(core, *(round(length * 2 ** core.params["F"]) for length in arm.links))
            assert worst <= limit, f"{name}: {worst:.2f} LSB at the tip, {millimetres:.3f} mm"
