"""The paper family against the float64 truth: bounds of rtl/paper/README.md, borders, holds, saturation, any word."""

from __future__ import annotations

import numpy as np
import pytest
from quadrance import bounds, codecs, paper, paper_printed, truth
from quadrance.cores import Port

SETS = [{"W": 16, "F": 8, "S": s} for s in (8, 24)]
UNREACHABLE, SINGULAR, OVERFLOW = 1, 2, 4


def words(p: dict[str, int], rng: np.random.Generator, count: int) -> np.ndarray:
    """Joint words: uniform, and each border with its neighbours."""
    near = (np.arange(4)[:, None] << p["S"]) + np.arange(-40, 41)
    return np.concatenate([near.ravel(), rng.integers(0, 4 << p["S"], count)]) % (4 << p["S"])


@pytest.mark.parametrize("p", SETS, ids=lambda p: f"S{p['S']}")
def test_fk1_is_the_nearest_word(p):
    rng = np.random.default_rng(1)
    joint = words(p, rng, 20_000)
    length = rng.integers(0, 1 << 15, joint.size)
    out = paper.fk1(p, in_j1=joint, cfg_l1=length)
    for axis, exact in zip("xy", truth.fk1(truth.spread_word_to_angle(joint, p["S"]), length)):
        assert np.max(np.abs(out[f"out_{axis}"] - exact)) <= 0.5 + 1e-9
    assert not np.any(out["out_status"][length < (1 << 15) - 1])


@pytest.mark.parametrize("p", SETS, ids=lambda p: f"S{p['S']}")
def test_fk1_saturates_and_says_so(p):
    border = np.arange(4) << p["S"]
    out = paper.fk1(p, in_j1=border, cfg_l1=(1 << 16) - 1)
    assert np.array_equal(out["out_x"], [32767, 0, -32767, 0]) and np.array_equal(out["out_y"], [0, 32767, 0, -32767])
    assert np.all(out["out_status"] == OVERFLOW)
    assert not np.any(paper.fk1(p, in_j1=border, cfg_l1=(1 << 15) - 1)["out_status"])


@pytest.mark.parametrize("p", SETS, ids=lambda p: f"S{p['S']}")
def test_ik1_is_the_nearest_word(p):
    rng = np.random.default_rng(2)
    x, y = (rng.integers(-(1 << 15), 1 << 15, 20_000) >> rng.integers(0, 16, 20_000) for _ in "xy")
    exact = truth.angle_to_spread(truth.ik1(x, y), p["S"])
    out = paper.ik1(p, in_x=x, in_y=y)
    seen = (x != 0) | (y != 0)
    error = np.mod(out["out_j1"] - exact + (2 << p["S"]), 4 << p["S"]) - (2 << p["S"])
    assert np.max(np.abs(error[seen])) <= 0.5 + 2.0 ** (p["S"] - 40)
    assert np.array_equal(out["out_status"] == SINGULAR, ~seen) and not np.all(seen)


@pytest.mark.parametrize("p", SETS, ids=lambda p: f"S{p['S']}")
def test_ik1_axes_are_the_quadrant_borders(p):
    out = paper.ik1(p, in_x=np.array([5, 0, -5, 0, 32767, -32768]), in_y=np.array([0, 5, 0, -5, -1, 0]))
    border = np.array([0, 1, 2, 3, 0, 2]) << p["S"]  # the fifth is 2^-30 of spread before the full turn
    assert np.array_equal(out["out_j1"], border)


def test_ik1_holds_the_last_word_at_the_origin():
    out = paper.ik1(SETS[0], in_x=np.array([0, 3, 0, 0, -3]), in_y=np.array([0, 3, 0, 0, 3]))
    assert out["out_j1"].tolist() == [0, 128, 128, 128, 384]
    assert out["out_status"].tolist() == [SINGULAR, 0, SINGULAR, SINGULAR, 0]


def test_ik1_undoes_fk1_within_the_resolution():
    p = SETS[1]
    joint = np.arange(0, 4 << 24, 99_991)
    tip = paper.fk1(p, in_j1=joint, cfg_l1=64 << 8)
    back = paper.ik1(p, in_x=tip["out_x"], in_y=tip["out_y"])["out_j1"]
    turn = truth.difference(truth.spread_word_to_angle(back, 24), truth.spread_word_to_angle(joint, 24))
    # half an LSB in x and in y seen from 64 units, and the word's own resolution at a border, asin(2^-12.5)
    assert np.max(np.abs(turn)) <= np.hypot(0.5, 0.5) / (64 << 8) * 1.001 + np.arcsin(2.0**-12.5)


def test_what_eight_fraction_bits_cost():
    """The paper's word: 3.58 degrees between the first two joint words, 2.53 degrees of rounding at worst."""
    step = np.degrees(truth.spread_word_to_angle(1, 8) - truth.spread_word_to_angle(0, 8))
    worst = np.degrees(truth.spread_word_to_angle(0.5, 8) - truth.spread_word_to_angle(0, 8))
    assert (round(step, 2), round(worst, 2)) == (3.58, 2.53)


# Two and three joints

LINKS = [(3.0, 2.0), (2.0, 3.0), (2.5, 2.5), (32.5, 27.5), (20.0, 30.0), (63.9, 63.9), (0.0, 5.0), (5.0, 0.0)]


@pytest.mark.parametrize("l1, l2", [(3, 2), (2, 3), (2.5, 2.5)])
def test_table_two_corrected_is_the_truth_in_every_cell(l1, l2):
    words = (np.arange(4)[:, None] + (np.arange(12) + 0.5) / 12).ravel()
    j1, j2, j3 = np.meshgrid(words, words, words, indexing="ij")
    angles = [truth.spread_word_to_angle(j * 2.0**40, 40) for j in (j1, j2, j3)]
    for tip, exact in ((paper_printed.table_two(j1, j2, l1, l2), truth.fk2(*angles[:2], l1, l2)),
                       (paper_printed.fk3(j1, j2, j3, l1, l2), truth.fk3(*angles, l1, l2))):
        assert max(np.max(np.abs(a - b)) for a, b in zip(tip, exact)) < 1e-7


def test_as_printed_six_percent_of_three_joints_are_right():
    assert round(100 * paper_printed.share_right(3, 3, 2, ())) == 6
    steps = [paper_printed.share_right(3, 2, 3, paper_printed.CORRECTIONS[:n]) for n in range(5)]
    assert all(np.diff(steps) > 0) and steps[-1] == 1, "every correction is needed"


def test_the_paper_s_worked_example():
    """Section III-D: Q1 = 9, Q2 = 4, s = 0.5, 0.6, 0.3; the paper prints y = 1.281."""
    x, y, z = paper_printed.fk3(0.5, 2.6, 0.3, 3, 2)  # its second configuration, measured clockwise
    assert np.allclose([x, y, z], [1.9430075965662645, 1.2719970553055894, 0.13144803754939447], atol=1e-12)


@pytest.mark.parametrize("l1, l2", LINKS)
@pytest.mark.parametrize("p", SETS, ids=lambda p: f"S{p['S']}")
def test_forward_within_the_bound_in_every_cell(p, l1, l2):
    rng = np.random.default_rng(3)
    joints = [rng.permutation(words(p, rng, 8000)) for _ in range(3)]
    assert len(np.unique(sum((j >> p["S"]) << 2 * i for i, j in enumerate(joints)))) == 64
    links = [round(256 * length) for length in (l1, l2)]
    cfg = {"cfg_l1": links[0], "cfg_l2": links[1]}
    angles = [truth.spread_word_to_angle(j, p["S"]) for j in joints]
    for answer, exact in ((paper.fk2(p, in_j1=joints[0], in_j2=joints[1], **cfg), truth.fk2(*angles[:2], *links)),
                          (paper.fk3(p, in_j1=joints[0], in_j2=joints[1], in_j3=joints[2], **cfg),
                           truth.fk3(*angles, *links))):
        error = np.sqrt(sum((answer[f"out_{axis}"] - tip) ** 2 for axis, tip in zip("xyz", exact)))
        assert np.max(error) <= bounds.paper.forward(p, len(exact), *links)
        assert not np.any(answer["out_status"])


@pytest.mark.parametrize("p", SETS, ids=lambda p: f"S{p['S']}")
def test_forward_flags_a_tip_out_of_range(p):
    rng = np.random.default_rng(4)
    j1, j2 = words(p, rng, 5000), rng.permutation(words(p, rng, 5000))
    answer = paper.fk2(p, in_j1=j1, in_j2=j2, cfg_l1=100 << 8, cfg_l2=90 << 8)
    reach = np.hypot(*truth.fk2(*(truth.spread_word_to_angle(j, p["S"]) for j in (j1, j2)), 100, 90))
    flag = answer["out_status"] == OVERFLOW
    band = bounds.paper.reach(p) / 256
    assert np.all(flag[reach > 128 + band]) and not np.any(flag[reach < 128 - 0.5 / 256 - band])
    assert np.all(np.abs(answer["out_x"][flag]) == 32767) and np.all(np.abs(answer["out_y"][flag]) == 32767)
    assert np.all(paper.fk2(p, in_j1=j1, in_j2=j2, cfg_l1=1 << 15, cfg_l2=0)["out_status"] == OVERFLOW)


# Inverse

INVERSE = [{"W": 16, "F": 8, "S": 8, "R": 4}, {"W": 16, "F": 8, "S": 24, "R": 3}]
ARMS = LINKS[:6]


def targets(rng: np.random.Generator, l1: float, l2: float, count: int = 20_000) -> tuple[np.ndarray, ...]:
    """Reachable words: all round, near both edges, near the axes; and which elbow."""
    t1, t2, t3 = rng.uniform(-np.pi, np.pi, (3, count))
    small = rng.normal(size=count) * 2.0 ** -rng.integers(2, 18, count)
    t2[:count // 4] = (rng.choice([0, np.pi], count) + small)[:count // 4]
    t1[count // 8:count // 2] = (rng.choice([0, 0.5, 1, 1.5], count) * np.pi + small)[count // 8:count // 2]
    tip = [np.rint(256 * axis).astype(np.int64) for axis in truth.fk3(t1, t2, t3, l1, l2)]
    flat = [np.rint(256 * axis).astype(np.int64) for axis in truth.fk2(t1, t2, l1, l2)]
    return *tip, *flat, rng.integers(0, 2, count)


def in_cell(word: np.ndarray, theta: np.ndarray, s: int) -> np.ndarray:
    """The direction nearest to `theta` among those that round to `word`."""
    return codecs.within_cell((Port("j", 2 + s, False, "spread"),), {"j": word}, theta)


@pytest.mark.parametrize("l1, l2", ARMS)
@pytest.mark.parametrize("p", INVERSE, ids=lambda p: f"S{p['S']}")
def test_inverse_within_the_bound_both_elbows(p, l1, l2):
    x, y, z, x2, y2, elbow = targets(np.random.default_rng(5), l1, l2)
    links = [round(256 * length) for length in (l1, l2)]
    cfg = {"cfg_l1": links[0], "cfg_l2": links[1]}
    for answer, exact, forward in (
            (paper.ik2(p, in_x=x2, in_y=y2, in_elbow=elbow, **cfg), truth.ik2(x2, y2, *links, elbow), truth.fk2),
            (paper.ik3(p, in_x=x, in_y=y, in_z=z, in_elbow=elbow, **cfg), truth.ik3(x, y, z, *links, elbow),
             truth.fk3)):
        defined = (answer["out_status"] & SINGULAR == 0) & np.all(np.isfinite(exact), axis=0)
        near = [in_cell(answer[f"out_j{i + 1}"], theta, p["S"]) for i, theta in enumerate(exact)]
        error = np.sqrt(sum((a - b) ** 2 for a, b in zip(forward(*near, *links), forward(*exact, *links))))
        assert np.max(error[defined]) <= bounds.paper.inverse(p, len(exact), *links) and np.mean(defined) > 0.7


@pytest.mark.parametrize("p", INVERSE, ids=lambda p: f"S{p['S']}")
def test_inverse_turns_joint_two_the_way_of_the_elbow(p):
    x, y = np.meshgrid(np.arange(-1200, 1201, 37), np.arange(-1200, 1201, 41))
    for elbow in (0, 1):
        answer = paper.ik2(p, in_x=x.ravel(), in_y=y.ravel(), in_elbow=elbow, cfg_l1=768, cfg_l2=512)
        joint = answer["out_j2"] * 2.0 ** -p["S"]
        assert np.all(joint <= 2) if elbow == 0 else np.all((joint >= 2) | (joint == 0))


@pytest.mark.parametrize("p", INVERSE, ids=lambda p: f"S{p['S']}")
def test_unreachable_is_the_nearest_point(p):
    turn = np.linspace(0, 2 * np.pi, 1000)
    for radius, stretched, straight in ((5.2, 0, True), (9.0, 0, True), (0.8, 2, True), (0.8, 2, False)):
        l1, l2 = (768, 512) if straight else (512, 768)
        x, y = (np.rint(256 * radius * f(turn)).astype(np.int64) for f in (np.cos, np.sin))
        answer = paper.ik2(p, in_x=x, in_y=y, in_elbow=0, cfg_l1=l1, cfg_l2=l2)
        assert np.all(answer["out_status"] == 1) and np.all(answer["out_j2"] == stretched << p["S"])
        exact = truth.ik2(x, y, l1, l2)[0]
        off = truth.difference(in_cell(answer["out_j1"], exact, p["S"]), exact)
        assert np.max(np.abs(off)) <= bounds.paper.nearest(p, 2, 256 * radius)
    inside = paper.ik2(p, in_x=np.rint(256 * 4.9 * np.cos(turn)).astype(np.int64),
                       in_y=np.rint(256 * 4.9 * np.sin(turn)).astype(np.int64), in_elbow=0, cfg_l1=768, cfg_l2=512)
    assert not np.any(inside["out_status"])


@pytest.mark.parametrize("p", INVERSE, ids=lambda p: f"S{p['S']}")
def test_inverse_holds_what_is_undefined(p):
    x, y, z = np.array([[512, 0, 0, 512], [512, 0, 0, -512], [256, 256, 0, 0]])
    answer = paper.ik3(p, in_x=x, in_y=y, in_z=z, in_elbow=0, cfg_l1=640, cfg_l2=640)
    assert answer["out_status"].tolist() == [0, SINGULAR, SINGULAR, 0]
    assert answer["out_j3"][0] == answer["out_j3"][1] == answer["out_j3"][2] == 1 << p["S"] - 1
    assert answer["out_j1"][1] == answer["out_j1"][2] != answer["out_j1"][0] and answer["out_j2"][2] == 2 << p["S"]
    flat = paper.ik2(p, in_x=np.array([0, 512, 0]), in_y=np.array([0, 0, 0]), in_elbow=0, cfg_l1=640, cfg_l2=640)
    assert flat["out_status"].tolist() == [SINGULAR, 0, SINGULAR] and flat["out_j1"][0] == 0
    assert flat["out_j1"][2] == flat["out_j1"][1]
    assert np.all(paper.ik2(p, in_x=x, in_y=y, in_elbow=0, cfg_l1=1 << 15, cfg_l2=1)["out_status"] & OVERFLOW)


# In the hole the answer is the nearest point

HOLE = {"S8": {"W": 16, "F": 8, "S": 8, "R": 4}, "S24": {"W": 16, "F": 8, "S": 24, "R": 3}}


def test_a_target_in_the_hole_turns_joint_one_to_it():
    answer = paper.ik2(HOLE["S24"], in_x=np.array([300]), in_y=np.array([100]), in_elbow=0, cfg_l1=4384, cfg_l2=12000)
    assert answer["out_status"].tolist() == [UNREACHABLE] and answer["out_j2"].tolist() == [2 << 24]
    assert abs(int(answer["out_j1"][0]) - 35232154) <= 1  # half a turn past the target: link 2 is the longer one


@pytest.mark.parametrize("l1, l2", [(4384, 12000), (12000, 4384), (0, 5000), (700, 30000), (16000, 15000)])
@pytest.mark.parametrize("p", HOLE.values(), ids=HOLE)
def test_the_hole_is_answered_by_its_nearest_point(p, l1, l2):
    rng = np.random.default_rng(6)
    hole, turn = abs(l1 - l2), rng.uniform(-np.pi, np.pi, 20_000)
    radius = np.maximum(1, (hole - 2) * 2.0 ** -rng.uniform(0, 12, turn.size))
    x, y = (np.rint(radius * f(turn)).astype(np.int64) for f in (np.cos, np.sin))
    answer = paper.ik2(p, in_x=x, in_y=y, in_elbow=rng.integers(0, 2, x.size), cfg_l1=l1, cfg_l2=l2)
    defined = answer["out_status"] & 2 == 0
    assert np.all(answer["out_status"] & UNREACHABLE) and np.mean(defined) > 0.3
    assert np.all(answer["out_j2"] == 2 << p["S"])
    exact = np.arctan2(y, x) + (np.pi if l2 > l1 else 0)
    off = np.mod(truth.angle_to_spread(exact, p["S"]) - answer["out_j1"] + (2 << p["S"]), 4 << p["S"]) - (2 << p["S"])
    near = truth.spread_word_to_angle(answer["out_j1"] + np.clip(off, -0.5, 0.5), p["S"])
    error = hole * 2 * np.abs(np.sin((near - exact) / 2))
    digits, root, lost = (12, 12, 2.0**-8) if p["S"] == 8 else (27, 26, 0.0)
    # README's law: sa truncated and its root; and quadrances truncated by `lost` units^2, seen from the target
    reached = hole / 256 * (2 * 2.0 ** (-digits / 2) + np.sqrt(3) * 2.0 ** (-root / 2))
    blurred = 2 * hole / np.maximum(np.hypot(x, y), 1) * np.sqrt(lost)
    assert np.all((error <= 256 * (reached + blurred) + 1e-6)[defined])


# The laws of the inverse cores at every word: any S, W and F, short and unequal links, the hole

WORDS = [{"W": w, "F": f, "S": s, "R": r} for w, f, s, r in (
    (16, 8, 8, 4), (16, 8, 16, 4), (16, 8, 24, 3), (12, 6, 16, 3), (18, 10, 16, 3), (24, 11, 24, 3))]
SHORT = [(0.5, 0.5), (0.45, 0.3), (0.05, 0.9), (0.002, 0.002), (1 / 32768, 0.3), (0.3, 1 / 32768)]
EACH = pytest.mark.parametrize("p", WORDS, ids=lambda p: f"W{p['W']}F{p['F']}S{p['S']}")


def _lattice(joints: int, l1: int, l2: int, full: int) -> tuple[np.ndarray, ...]:
    """Targets (joints, N): anywhere in reach, crowded at both circles, in the hole to its middle, beyond; the elbow."""
    rng, n = np.random.default_rng(5), 1500
    near, far = abs(l1 - l2), l1 + l2
    crowd = (far - near) * 2.0 ** -rng.uniform(0, 24, n)
    r = np.concatenate([rng.uniform(near, far, n), near + crowd, far - crowd, near * 2.0 ** -rng.uniform(0, 24, n),
                        rng.uniform(far, 2 * far, n // 4)])
    way = rng.normal(size=(joints, r.size))
    way[:, ::3] *= 2.0 ** -rng.integers(0, 18, way[:, ::3].shape)  # close to axes and planes
    target = np.clip(np.rint(r * way / np.linalg.norm(way, axis=0)), -full, full - 1).astype(np.int64)
    return target, rng.integers(0, 2, r.size)


@EACH
@pytest.mark.parametrize("joints", [2, 3])
@pytest.mark.parametrize("share", SHORT, ids=str)
def test_the_tip_in_reach_and_the_nearest_point_beyond(p, joints, share):
    full = 1 << p["W"] - 1
    l1, l2 = (max(round(full * part), 1) for part in share)
    target, elbow = _lattice(joints, l1, l2, full)
    model, inverse, forward = ((paper.ik2, truth.ik2, truth.fk2), (paper.ik3, truth.ik3, truth.fk3))[joints - 2]
    out = model(p, **dict(zip(("in_x", "in_y", "in_z"), target)), in_elbow=elbow, cfg_l1=l1, cfg_l2=l2)
    exact = np.nan_to_num(inverse(*target, l1, l2, elbow))
    joint = (Port("j", p["S"] + 2, False, "spread"),)
    near = [codecs.within_cell(joint, {"j": out[f"out_j{i}"]}, theta) for i, theta in enumerate(exact, 1)]
    tip = np.stack(forward(*near, l1, l2))
    r = np.sqrt((target.astype(float) ** 2).sum(axis=0))
    defined = out["out_status"] & SINGULAR == 0
    inside = defined & (r >= abs(l1 - l2)) & (r <= l1 + l2) & (out["out_status"] == 0)
    error = np.linalg.norm(tip - target, axis=0)
    assert np.max(error[inside], initial=0) <= bounds.paper.inverse(p, joints, l1, l2)
    beyond = defined & ((r < abs(l1 - l2)) | (r > l1 + l2)) & (out["out_status"] & UNREACHABLE > 0)
    plane = target if joints == 2 else np.stack([np.hypot(*target[:2]), target[2]])
    theta = np.arctan2(plane[1], plane[0]) + np.where((r < abs(l1 - l2)) & (l2 > l1), np.pi, 0)
    off = np.abs(truth.difference(codecs.within_cell(joint, {"j": out["out_j1"]}, theta), theta))
    assert np.all((off <= bounds.paper.nearest(p, joints, r))[beyond])
    if p["S"] == 24 or p["S"] == 2 * p["F"]:
        assert beyond.sum() > 250 or share[0] == share[1] or min(share) < 1e-4
