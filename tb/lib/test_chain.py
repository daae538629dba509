"""A core behind a core on one reset: the bench of every core, on the pair."""

from dataclasses import replace

import pytest
from quadrance.cores import find

from tb.lib import chain
from tb.lib.simulate import simulate
from tb.lib.suite import SEED, bulk_run, simulators

PAIRS = chain.pairs()


@pytest.mark.full
@pytest.mark.parametrize("first, second, tests", [
    ("classic_ik2", "classic_fk2", "one_clock|stalled"), ("rational_fk1", "rational_ik1", None)])
def test_pair(first, second, tests):
    simulate(chain.chain(find(first), find(second)), simulators()[0], tests=tests, seed=SEED)


@pytest.mark.slow
@pytest.mark.parametrize("first, second", PAIRS, ids=lambda core: core.id)
def test_every_pair(first, second):
    both = chain.chain(first, second)
    simulate(both, "verilator", seed=SEED)
    assert bulk_run(both, 100_000, SEED) > 0


@pytest.mark.full
def test_a_pair_that_a_reset_does_not_reach_is_seen():
    """The reset of the second core alone is tied off: what is in flight there survives."""
    both = chain.chain(find("rational_fk1"), find("rational_ik1"))
    wrapper = both.sources[0]
    text = wrapper.read_text()
    at = text.index(" two (")
    broken = wrapper.with_name("broken.v")
    broken.write_text(text[:at] + text[at:].replace(".rst(rst)", ".rst(1'b0)"))
    with pytest.raises(SystemExit, match="FAILED"):
        simulate(replace(both, sources=(broken, *both.sources[1:])), simulators()[0], tests="one_clock|reset_in",
                 seed=SEED, label="-unreset")
