"""What the benches are fed: all sides of all quadrants, the edge of saturation of every axis, over-long links."""

import numpy as np
import pytest
from quadrance.cores import all_cores, find

from tb.lib import stimulus

FORWARD = [core for core in all_cores() if core.function in ("fk1", "fk2", "fk3") and core.first_set]


@pytest.mark.full
@pytest.mark.parametrize("name", ["rational_fk3", "classic_fk2", "cordic_rotate"])
def test_joint_words_are_dense_on_all_eight_sides(name):
    core = find(name)
    for port in (port for port in core.inputs if port.type):
        words = stimulus.uniform(core, np.random.default_rng(1), 40_000)[port.name]
        quarter = 1 << port.width - 2
        assert port.low <= words.min() and words.max() <= port.high
        for border in range(4):
            for side in (1, -1):
                off = (side * (words - border * quarter) - (side < 0)) % (1 << port.width)
                for scale in range(0, port.width - 2, 3):  # each length has its share, of 1250 or so a side
                    assert ((off < 2 << scale) & (off >= (1 << scale) // 2)).sum() > 30, (border, side, scale)


@pytest.mark.full
@pytest.mark.parametrize("core", FORWARD, ids=lambda core: core.id)
def test_corners_stand_on_both_sides_of_saturation(core):
    """Every axis and sign: a word that is just saturated; one word of a joint from a sample that is not."""
    high, seen = (1 << core.params["W"] - 1) - 1, set()
    for cfg in stimulus.configs(core, np.random.default_rng(1)):
        words = stimulus.saturation(core, cfg)
        if not next(iter(words.values())).size:
            continue
        answer = core.model(core.params, **words, **cfg)
        over = answer["out_status"] > 0
        assert np.any(over) and not np.all(over)
        for axis in ("out_x", "out_y", "out_z")[:len(core.outputs) - 1]:
            for limit in (high, -high if core.family == "paper" else -high - 1):
                if np.any(over & (answer[axis] == limit)):
                    seen.add((axis, limit > 0))
        corners = stimulus.corners(core, cfg)
        assert all(set(words[name].tolist()) <= set(corners[name].tolist()) for name in words)
    assert len(seen) == 2 * (len(core.outputs) - 1)


@pytest.mark.full
@pytest.mark.parametrize("core", [core for core in all_cores() if core.first_set and
                                  [port.name for port in core.cfg[:2]] == ["cfg_l1", "cfg_l2"]],
                         ids=lambda core: core.id)
def test_either_link_alone_is_too_long(core):
    half = 1 << core.params["W"] - 1
    pairs = [(cfg["cfg_l1"], cfg["cfg_l2"]) for cfg in stimulus.configs(core, np.random.default_rng(1))]
    assert any(l1 >= half > l2 for l1, l2 in pairs) and any(l2 >= half > l1 for l1, l2 in pairs)
