"""What the benches are fed: all sides of all quadrants, every edge of saturation, every bit of a configuration."""

import numpy as np
import pytest
from quadrance.cores import all_cores, find

from tb.lib import bulk, legal, stimulus
from tb.lib.suite import SEED, bulk_run, bulk_samples
from tb.lib.test_bench_bites import altered


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


INSIDE = {  # cores whose overflow is that of a word inside, and where its edge is shown
    "arm_ik3": "here, z - base", "arm_keep3": "here, z - base", "table_ik3r": "here, the wrist",
    "paper_ik2": "no sample overflows: a link of 2^(W-1) LSB does", "paper_ik3": "as paper_ik2",
    **dict.fromkeys(("engine_rus_ik", "engine_rus_ik_angle", "engine_rus_fk", "engine_quaternion_gd_n"),
                    "both values of the flag are; its words are not seen outside")}


def _few(core) -> float:
    """How far below an end the greatest result that fits may be, LSB: words of a sample are not dense everywhere.

    A spread of S bits next to 0 is a cosine or a sine of 2^(-S / 2), each joint's of a tip that far away. A joint word
    of 10 bits next to an eighth of a turn moves a tip by whole LSB, and length words are whole. Where a coordinate has
    many bits more than a joint word, a step of the latter is 2 pi 2^(W - 1 - A) LSB; the nearest of the corners lies
    within a twelfth of that.
    """
    if core.family == "paper" and core.function != "mff":
        return max(len(core.inputs) * 2.0 ** (core.params["W"] - 1 - core.params["S"] / 2), 1)
    w, a = core.params["W"], core.params.get("A", 16)
    return 2 ** (w - 1 - a) / 2 if w > 16 and w - a > 1 else int(a <= 10)


def _alike(core) -> tuple:
    """Cores and sets that take the same words to the same results."""
    return core.model_name, *((key, value) for key, value in core.params.items()
                              if key not in ("R", "PRODUCTS", "PIPE", "MULTIPLY"))


OVERFLOWS = list({_alike(core): core for core in reversed(all_cores())
                  if "overflow" in (core.status or ()) and core.name not in INSIDE}.values())


AGAIN = "paper_fk5", "engine_delta_fk_angle", "table_fk6"  # others behind a codec, or twice


@pytest.mark.parametrize("core", [pytest.param(
    core, id=core.id, marks=pytest.mark.full if legal.daily(core) and core.name not in AGAIN else pytest.mark.slow)
    for core in OVERFLOWS])
def test_corners_have_both_sides_of_both_ends(core):
    """Every coordinate, rate or velocity, each sign: saturated while the others are not, and the last word that fits.

    The coordinates of rtl/paper saturate together. The z of a chain in the plane is 0.
    """
    ports = [port for port in stimulus.coordinates(core)
             if port.name != "out_z" or core.function != "chain" or core.params["SPACE"]]
    assert ports
    wanted = {(port.name, end) for port in ports for end in stimulus.ends(core, port)}
    over, inside = set(), dict.fromkeys(wanted, 1 << 40)
    w = core.params["W"]
    seeds = (1, 2, 3) if w > 16 and w >= core.params.get("A", w + 1) else (1,)  # a joint word steps over some LSB
    for cfg in (cfg for seed in seeds for cfg in stimulus.configs(core, np.random.default_rng(seed))):
        answer = core.model(core.params, **stimulus.corners(core, cfg), **cfg)
        flag = answer["out_status"] & 4 > 0
        at_end = {port.name: np.isin(answer[port.name], stimulus.ends(core, port)) for port in ports}
        for port in ports:
            alone = flag & ~np.any([0 * flag, *(at_end[one.name] for one in ports if one is not port)], axis=0)
            for end in stimulus.ends(core, port):
                if np.any((flag if core.family == "paper" else alone) & (answer[port.name] == end)):
                    over.add((port.name, end))
                off = np.abs(answer[port.name] - end)[~flag].min(initial=1 << 40)
                inside[port.name, end] = min(inside[port.name, end], int(off))
        if over == wanted and max(inside.values()) <= _few(core):  # no further configuration takes them back
            break
    assert over == wanted
    assert max(inside.values()) <= _few(core), inside


@pytest.mark.full
def test_every_core_that_overflows_is_looked_at():
    """A core with the overflow bit has coordinates at their ends, or says in `INSIDE` what overflows in it."""
    overflows = {core.name for core in all_cores() if "overflow" in (core.status or ())}
    assert set(INSIDE) <= overflows
    models = {core.model_name for core in OVERFLOWS}
    assert all(core.model_name in models for core in all_cores() if core.name in overflows - set(INSIDE))


@pytest.mark.full
@pytest.mark.parametrize("name", [name for name in INSIDE if not name.startswith("paper")])
def test_an_overflow_inside_is_seen_and_not_seen(name):
    core = find(name)
    flags = set()
    for cfg in stimulus.configs(core, np.random.default_rng(1)):
        flags |= set(core.model(core.params, **stimulus.corners(core, cfg), **cfg)["out_status"] & 4)
        if flags == {0, 4}:
            break
    assert flags == {0, 4}


@pytest.mark.full
@pytest.mark.parametrize("core", [core for core in all_cores() if core.name == "table_ik3r"], ids=lambda core: core.id)
def test_corners_have_both_edges_of_a_wrist(core):
    """Behind a link along an axis, where it is whole words: it alone decides the flag, at both ends of both axes."""
    half, seen = 1 << core.params["W"] - 1, {0: set(), 1: set()}
    for cfg in stimulus.configs(core, np.random.default_rng(1)):
        words = stimulus.corners(core, cfg)
        quarter, rest = np.divmod(words["in_phi"], 1 << core.params["A"] - 2)
        along = np.array([1, 0, -1, 0])[quarter], np.array([0, 1, 0, -1])[quarter]
        wrist = np.array([words[f"in_{axis}"] - cfg["cfg_l3"] * one for axis, one in zip("xy", along)])[:, rest == 0]
        flag = core.model(core.params, **words, **cfg)["out_status"][rest == 0] & 4 > 0
        assert np.array_equal(flag, np.any((wrist >= half) | (wrist < -half), axis=0))
        for axis in (0, 1):
            seen[axis] |= set(wrist[axis].tolist())
    assert {half - 1, half, -half, -half - 1} <= seen[0] & seen[1]


@pytest.mark.full
@pytest.mark.parametrize("core", [core for core in all_cores() if core.name in ("arm_ik3", "arm_keep3")
                                  and core.first_set], ids=lambda core: core.id)
def test_corners_have_both_edges_of_a_height(core):
    """z - base: the last that fits and the first that does not, at both ends, and it alone decides the flag."""
    half, seen = 1 << core.params["W"] - 1, set()
    for cfg in stimulus.configs(core, np.random.default_rng(1)):
        words = stimulus.corners(core, cfg)
        height = words["in_z"] - cfg["cfg_base"]
        flag = core.model(core.params, **words, **cfg)["out_status"] & 4 > 0
        assert np.array_equal(flag, (height >= half) | (height < -half))
        seen |= set(height.tolist())
    assert {half - 1, half, -half, -half - 1} <= seen


@pytest.mark.full
@pytest.mark.parametrize("core", [core for core in all_cores() if core.first_set and
                                  [port.name for port in core.cfg[:2]] == ["cfg_l1", "cfg_l2"]],
                         ids=lambda core: core.id)
def test_either_link_alone_is_too_long(core):
    half = 1 << core.params["W"] - 1
    pairs = [(cfg["cfg_l1"], cfg["cfg_l2"]) for cfg in stimulus.configs(core, np.random.default_rng(1))]
    assert any(l1 >= half > l2 for l1, l2 in pairs) and any(l2 >= half > l1 for l1, l2 in pairs)


# Configurations of the daily bulk run

CORES = [core for core in all_cores() if legal.daily(core) and core.cfg]
SQUARE, NORMALISED = "no square has this bit", "the leading bit of a normalised word"
NEVER = {  # facts that no legal configuration has, by family and port: (bits, value) and the reason
    ("classic", "cfg_far"): {(2, 2): SQUARE}, ("classic", "cfg_near"): {(2, 2): SQUARE},
    **{(family, "cfg_r"): {(1 << 24, 0): NORMALISED} for family in ("six", "ur", "srs", "keep")},
    **{(family, "cfg_e"): {(1, 1): "links of half a unit at most: 2^-2 is the least", (2, 2): "as bit 0"}
       for family in ("six", "ur", "srs", "keep")}}


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


EDGED = [core for core in all_cores() if core.params.get("MARGINS") != 0 and not core.params.get("PIPE")
         and "cfg_slack" in {port.name for port in core.cfg} and core.family != "keep"]


@pytest.mark.full
@pytest.mark.parametrize("core", EDGED, ids=lambda core: core.id)
@pytest.mark.parametrize("name", ["cfg_margin", "cfg_slack"])
def test_corners_tell_every_bit_of_margin_and_slack(core, name):
    """The status of some sample is another one where the core leaves out a bit."""
    port = next(port for port in core.cfg if port.name == name)
    left = (1 << port.width) - 1
    for cfg in stimulus.configs(core, np.random.default_rng(SEED)):
        corners = stimulus.corners(core, cfg)
        status = bulk.expected(core, corners, cfg)["out_status"]
        for bit in (1 << i for i in range(port.width) if left & cfg[name] & 1 << i):
            cut = int(stimulus.wrap(np.array(cfg[name] ^ bit), port.width, port.signed))
            left -= bit * int((bulk.expected(core, corners, cfg | {name: cut})["out_status"] != status).any())
    assert left == 0, f"no corner tells bits {left:b} of {name}"


@pytest.mark.full
@pytest.mark.parametrize("core", [core for core in CORES if "cfg_limit" in {port.name for port in core.cfg}],
                         ids=lambda core: core.name)
def test_a_limit_of_long_bits_is_reached(core):
    """A bit of the limit has an effect where a sample does not converge before: its iterations are the limit."""
    reached = 0
    for cfg in stimulus.configs(core, np.random.default_rng(2026)):
        if (cfg["cfg_limit"] & ~reached) >> stimulus.SMALL:  # a bit that no limit before had
            iters = core.model(core.params, **stimulus.corners(core, cfg), **cfg)["out_iters"]
            reached |= cfg["cfg_limit"] * bool(np.any(iters == cfg["cfg_limit"]))
    width = next(port.width for port in core.cfg if port.name == "cfg_limit")
    assert reached >> stimulus.SMALL == (1 << width - stimulus.SMALL) - 1


@pytest.mark.full
def test_a_bug_at_one_value_of_a_small_word_is_found(tmp_path):
    """cfg_e = 9 comes of a few pairs of links: no configuration that someone chose for its lengths had it."""
    core = find("vector_ik2")
    broken = altered("vector_ik2", "kernel_vector_solve", "s <= cfg_e", "s <= cfg_e == 9 ? 4'd8 : cfg_e", tmp_path)
    with pytest.raises(AssertionError, match="'cfg_e': 9"):
        bulk_run(core, bulk_samples(core), SEED, built=broken)


EDGES = {  # of arm_inverse: a rate wraps at the first word beyond the end, or ends a word too soon
    "late": ("over2 = w2[W+2:W-1] != {4{w2[W+2]}}", "over2 = w2[W+2:W-1] != {4{w2[W+2]}} && w2 != 1 << W-1"),
    "soon": ("over1 = w1[W+1:W-1] != {3{w1[W+1]}}", "over1 = w1[W+1:W-1] != {3{w1[W+1]}} || w1 == (1 << W-1) - 1")}


@pytest.mark.full
@pytest.mark.parametrize("edge", EDGES)
def test_a_rate_that_is_not_saturated_exactly_is_found(edge, tmp_path):
    core = find("arm_rates2")
    broken = altered("arm_rates2", "arm_inverse", *EDGES[edge], tmp_path)
    with pytest.raises(AssertionError, match="sample .* model"):
        bulk_run(core, bulk_samples(core), SEED, built=broken)
