"""The long run: every core at two random legal parameter sets, another two with every seed, bench and bulk run."""

import pytest
from quadrance.cores import all_cores, at, find

from tb.lib import legal
from tb.lib.simulate import simulate
from tb.lib.suite import SEED, bulk_run

CORES = [core for core in all_cores() if core.first_set and core.params]


@pytest.mark.slow
@pytest.mark.parametrize("core", CORES, ids=lambda core: core.name)
def test_random_sets(core):
    chosen = legal.legal(core, 2, SEED)
    assert len(chosen) == 2
    for params in chosen:
        print(core.name, params)
        one = at(core, params)
        simulate(one, "verilator", seed=SEED)
        assert bulk_run(one, 100_000, SEED) > 0


@pytest.mark.full
def test_a_draw_is_legal_and_another_one_is_not():
    core = find("rational_ik1")
    assert legal.ranges(core) == {"W": (4, 16), "F": (0, 15), "S": (2, 24), "PIPE": (0, 0), "MULTIPLY": (18, 27)}
    first, = legal.legal(core, 1, 7)
    assert not legal.verdict(core, first) and legal.legal(core, 1, 7) == [first] != legal.legal(core, 1, 8)
    assert at(core, first).params == first and at(core, first).latency == core.latency
    for params in core.illegal:
        assert legal.verdict(core, core.params | params) == "illegal"
