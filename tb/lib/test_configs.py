"""Configurations of the daily bulk run: every value of small words, every bit of long ones, a limit that is reached."""

import numpy as np
import pytest
from quadrance.cores import all_cores, find

from tb.lib import stimulus
from tb.lib.suite import SEED, bulk_run, bulk_samples
from tb.lib.test_bench_bites import altered

CORES = [core for core in all_cores() if core.first_set and core.cfg]
SQUARE, NORMALISED = "no square has this bit", "the leading bit of a normalised word"
NEVER = {  # facts that no legal configuration has, by family and port: (bits, value) and the reason
    ("classic", "cfg_far"): {(2, 2): SQUARE}, ("classic", "cfg_near"): {(2, 2): SQUARE},
    ("six", "cfg_r"): {(1 << 24, 0): NORMALISED},
    ("six", "cfg_e"): {(1, 1): "links of half a unit at most: 2^-2 is the least", (2, 2): "as bit 0"}}


@pytest.mark.full
@pytest.mark.parametrize("core", CORES, ids=lambda core: core.name)
def test_every_value_and_every_bit_is_tried(core):
    configs = stimulus.configs(core, np.random.default_rng(2026))
    assert all(port.low <= cfg[port.name] <= port.high for cfg in configs for port in core.cfg)
    tried = set().union(*(stimulus.facts(core, cfg) for cfg in configs))
    wanted = {(port.name, 1 << bit, value << bit) for port in core.cfg for bit in range(port.width) for value in (0, 1)}
    wanted |= {(port.name, (1 << port.width) - 1, word) for port in core.cfg if port.width <= stimulus.SMALL
               for word in range(1 << port.width)}
    never = {(port.name, *fact) for port in core.cfg for fact in NEVER.get((core.family, port.name), {})}
    assert wanted - tried == never
    rng = np.random.default_rng(7)
    for _ in range(2000 if never else 0):
        assert not never & stimulus.facts(core, stimulus.drawn(core, rng))


@pytest.mark.full
@pytest.mark.parametrize("core", [core for core in CORES if "cfg_limit" in {port.name for port in core.cfg}],
                         ids=lambda core: core.name)
def test_a_limit_of_long_bits_is_reached(core):
    """A bit of the limit has an effect where a sample does not converge before: its iterations are the limit."""
    reached = 0
    for cfg in stimulus.configs(core, np.random.default_rng(2026)):
        if cfg["cfg_limit"] >= 1 << stimulus.SMALL:
            iters = core.model(core.params, **stimulus.corners(core, cfg), **cfg)["out_iters"]
            reached |= cfg["cfg_limit"] * bool(np.any(iters == cfg["cfg_limit"]))
    width = next(port.width for port in core.cfg if port.name == "cfg_limit")
    assert reached >> stimulus.SMALL == (1 << width - stimulus.SMALL) - 1


@pytest.mark.full
def test_a_bug_at_one_value_of_a_small_word_is_found(tmp_path):
    """cfg_e = 9 comes of a few pairs of links: no configuration that someone chose for its lengths had it."""
    core = find("vector_ik2")
    broken = altered("vector_ik2", "kernel_vector_path", "s <= cfg_e", "s <= cfg_e == 9 ? 4'd8 : cfg_e", tmp_path)
    with pytest.raises(AssertionError, match="'cfg_e': 9"):
        bulk_run(core, bulk_samples(core), SEED, built=broken)
