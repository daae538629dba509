"""Benches of the classic family; stimulus.py beside this file has its corners."""

import pytest
from quadrance.cores import Core, all_cores

from tb.lib import suite
from tb.lib.simulate import available, simulate

test_bench, test_bulk, test_exhaustive = suite.family("classic")


@pytest.mark.full
@pytest.mark.parametrize("core", [pytest.param(core, id=core.id) for core in all_cores()
                                  if core.family in ("classic", "cordic", "arith") and core.clocked])
def test_reset(core: Core) -> None:
    """Four-state simulation of a reset at power-up, and of one with in_valid high."""
    if not available("icarus"):
        pytest.skip("Verilator has two states")
    simulate(core, "icarus", module="tb.lib.reset", seed=suite.SEED, label="-reset")
