"""The haptic circle in cocotb: some samples of every engine that can follow it every day, a turn in the long run.

And the clocks of a pass, which `quadrance track` and the report name, against the Verilog.
"""

import numpy as np
import pytest
from quadrance.cores import all_cores
from quadrance.iterative import convergence, engines, track

from tb.lib import bulk
from tb.lib.simulate import simulate
from tb.lib.suite import SEED, simulators

EACH = pytest.mark.parametrize("core", [
    pytest.param(core, id=core.id, marks=pytest.mark.full if core.first_set else pytest.mark.slow)
    for core in all_cores() if core.name in engines.EXAMPLES])
TURN = round(2 * np.pi / track.OMEGA / track.PERIOD)


def run(core, simulator: str, counts, samples: int) -> None:
    simulate(core, simulator, module="tb.engine.track", seed=SEED,
             plusargs=[f"+counts={','.join(map(str, counts))}", f"+samples={samples}"])


@pytest.mark.parametrize("simulator", simulators())
@EACH
def test_some_samples(core, simulator):
    run(core, simulator, track.COUNTS, 8)


@pytest.mark.slow
@pytest.mark.parametrize("count", track.COUNTS)
@EACH
def test_a_turn(core, count):
    run(core, "verilator", [count], TURN)


@EACH
def test_clocks_of_a_pass(core):
    """From starts of the whole grid: some of them, or all, change the range of the error and take passes more."""
    pick = np.random.default_rng(1).choice(8100, 60)
    inputs, cfg = convergence.by_example(core)
    inputs = {port: words[pick] for port, words in inputs.items()}
    result = bulk.stream(core, inputs, cfg)
    bulk.compare(core, inputs, cfg, result)
    example = engines.EXAMPLES[core.name]
    passes, rest = np.divmod(result.latency - example.last, example.clocks)
    more = passes - result.outputs["out_iters"]
    assert not rest.any() and np.all(more >= 0) and np.any(more > 0)
