"""The haptic circle in cocotb: some samples of every engine that can follow it every day, a turn in the long run.

And the clocks that the report counts, by passes of the model, against the Verilog.
"""

import numpy as np
import pytest
from quadrance.cores import all_cores
from quadrance.iterative import convergence, engines, track

from tb.lib import bulk
from tb.lib.simulate import simulate
from tb.lib.suite import SEED, simulators

CORES = [core for core in all_cores() if core.name in engines.EXAMPLES]
EACH = pytest.mark.parametrize("core", CORES, ids=lambda core: core.id)
TURN = round(2 * np.pi / track.OMEGA / track.PERIOD)


def run(core, simulator: str, counts, samples: int) -> None:
    simulate(core, simulator, module="tb.engine.track", seed=SEED,
             plusargs=[f"+counts={','.join(map(str, counts))}", f"+samples={samples}"])


@pytest.mark.full
@pytest.mark.parametrize("simulator", simulators())
@EACH
def test_some_samples(core, simulator):
    run(core, simulator, track.COUNTS, 8)


@pytest.mark.slow
@pytest.mark.parametrize("count", track.COUNTS)
@EACH
def test_a_turn(core, count):
    run(core, "verilator", [count], TURN)


@pytest.mark.full
@EACH
def test_clocks_of_the_report(core):
    """From starts of the whole grid, changes of range included."""
    pick = np.random.default_rng(1).choice(8100, 60)
    inputs, cfg = convergence.samples(core)
    inputs = {port: words[pick] for port, words in inputs.items()}
    _, clocks, done = (column[pick] for column in convergence.by_example(core))
    result = bulk.stream(core, inputs, cfg)
    bulk.compare(core, inputs, cfg, result)
    assert np.array_equal(result.latency, clocks) and done.any()
