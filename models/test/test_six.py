"""Six axes: the truth against products of rotation matrices and itself, the bit-true models against their bounds."""

from __future__ import annotations

import importlib
import re

import numpy as np
import pytest
from quadrance import product_engine, six, truth_six, truth_srs
from quadrance.bounds import six as bounds
from quadrance.cores import RTL, all_cores, find, joints
from quadrance.program import meaning, parser, table
from quadrance.truth_six import Six

from models.test import frames
from models.test.claims import distinct
from tb.lib import stimulus

CORES = [core for core in distinct() if core.family == "six" and core.name.startswith("vector")]
FORWARD = [core for core in CORES if core.function == "fk6"]
INVERSE = [core for core in CORES if core.function == "ik6"]
ALL = [core for core in CORES if core.function == "ik6_all"]
ANGLES = [core for core in distinct() if core.function.endswith("_to_angles")]
ROBOTS = pytest.mark.parametrize("robot", truth_six.known())


def cores(choice):
    return pytest.mark.parametrize("core", choice, ids=lambda core: core.id)


def _about(axis: str, angle: np.ndarray) -> np.ndarray:
    c, s, zero = np.cos(angle), np.sin(angle), 0 * angle
    rows = {"z": [[c, -s, zero], [s, c, zero], [zero, zero, zero + 1]],
            "y": [[c, zero, s], [zero, zero + 1, zero], [-s, zero, c]]}[axis]
    return np.moveaxis(np.array(rows), -1, 0)


def _arm(robot: str, core) -> tuple[Six, Six]:
    """The robot as large as the core's word: in units, in LSB."""
    arm, mm = truth_six.load(robot)
    units = 2.0 ** (core.params["W"] - 1 - core.params["F"])
    unit = Six(*(length / mm * units / 128 for length in arm))
    return unit, Six(*(length * 2.0 ** core.params["F"] for length in unit))


def _joints(count: int, arm: Six, seed: int) -> np.ndarray:
    """Joints anywhere; of every third the elbow near its ends, of every seventh the wrist nearly straight."""
    rng = np.random.default_rng(seed)
    q = rng.uniform(-np.pi, np.pi, (count, 6))
    near = rng.choice([-1, 1], (2, count)) * 2.0 ** -rng.uniform(0, 18, (2, count))
    q[::3, 2] = (np.pi * rng.integers(0, 2, count) + near[0] - arm.psi)[::3]
    q[::7, 4] = (np.pi * rng.integers(0, 2, count) + near[1])[::7]
    return q


def _words(core, rotation: np.ndarray, tip: np.ndarray) -> tuple[dict, np.ndarray, np.ndarray]:
    """Pose words of tips within the word, and what they stand for: matrix, tip in LSB."""
    p = core.params
    matrix, place = np.rint(rotation * 2.0 ** p["U"]), np.rint(tip)
    fits = np.all(np.abs(place) < 1 << p["W"] - 1, axis=-1)
    matrix, place = matrix[fits], place[fits]
    words = dict(zip((f"in_r{axis}" for axis in six.AXES), matrix.reshape(-1, 9).T.astype(np.int64)))
    words |= dict(zip(("in_x", "in_y", "in_z"), place.T.astype(np.int64)))
    return words, matrix / 2.0 ** p["U"], place


def _angles(answer: dict, count: int = 6) -> np.ndarray:
    return np.stack([np.arctan2(answer[f"out_n{i}"], answer[f"out_c{i}"]) for i in range(1, count + 1)], axis=-1)


# Truth


@ROBOTS
def test_forward_truth_is_a_product_of_rotations(robot):
    """Rotations and translations one after the other: Rz q1, Ry q2, Ry q3, Rz q4, Ry q5, Rz q6."""
    arm, _ = truth_six.load(robot)
    q = _joints(2000, arm, 1)
    rotation, tip = truth_six.fk6(q, arm)
    frame, place = np.eye(3)[None], np.zeros((len(q), 3))
    steps = [("z", (0, 0, arm.c1)), ("y", (0, 0, arm.c2)), ("y", (arm.a2, 0, arm.c3)), ("z", (0, 0, 0)),
             ("y", (0, 0, 0)), ("z", (0, 0, arm.c4))]
    for i, (axis, link) in enumerate(steps):
        frame = frame @ _about(axis, q[:, i])
        place = place + frame @ np.array(link)
        if i == 0:
            place = place + frame @ np.array((arm.a1, arm.b, 0))
    assert np.abs(rotation - frame).max() < 1e-13 and np.abs(tip - place).max() < 1e-9


@ROBOTS
def test_inverse_truth_gives_eight_branches(robot):
    """Every branch gives the pose; one of the eight is where it came from; no two are the same."""
    arm, _ = truth_six.load(robot)
    q = np.random.default_rng(2).uniform(-np.pi, np.pi, (2000, 6))
    rotation, tip = truth_six.fk6(q, arm)
    found = []
    for branch in range(8):
        angles, out = truth_six.ik6(rotation, tip, arm, branch)
        again = truth_six.fk6(angles, arm)
        assert np.abs(again[0] - rotation)[~out].max() < 1e-10 and np.abs(again[1] - tip)[~out].max() < 1e-8
        assert out.mean() < 0.2
        found.append(np.where(out[:, None], np.nan, angles))
    off = np.abs(np.angle(np.exp(1j * (np.array(found) - q)))).max(axis=-1)
    assert np.all(np.nanmin(off, axis=0) < 1e-5)
    apart = np.nanmin([np.abs(np.exp(1j * a) - np.exp(1j * b)).max(axis=-1)
                       for i, a in enumerate(found) for b in found[:i]], axis=0)
    assert np.median(apart) > 0.1


# Bit-true models


def test_reciprocal_root_of_every_argument():
    q = np.arange(1 << 16, 1 << 19, dtype=np.int64)
    word = product_engine.reciprocal(q) / 2.0 ** (product_engine.H - 1)
    low, high = word * np.sqrt(q / 2.0**18) - 1, word * np.sqrt((q + 1) / 2.0**18) - 1
    assert 0.6 * 2.0**-16 < max(np.abs(low).max(), np.abs(high).max()) <= bounds.ROOT
    word = -product_engine.reciprocal(q, np.ones_like(q)) / 2.0 ** (product_engine.H - 1)
    off = np.maximum(np.abs(word * np.sqrt(q / 2.0**18) - 1), np.abs(word * np.sqrt((q + 1) / 2.0**18) - 1))
    assert 0.8 * 2.0**-16 < off[q < 1 << 18].max() <= bounds.MINUS
    assert 1.9 * 2.0**-16 < off.max() <= bounds.MINUS_TO_2


@ROBOTS
@cores(FORWARD)
def test_forward(core, robot):
    unit, arm = _arm(robot, core)
    q, p, words = _joints(20_000, arm, 3), core.params, {}
    for i in range(6):
        words |= {f"in_{letter}{i + 1}": np.rint(part(q[:, i]) * 2.0 ** p["U"]).astype(np.int64)
                  for letter, part in (("c", np.cos), ("n", np.sin))}
    answer = core.model(p, **words, **six.forward_config(p, **unit._asdict()))
    angles = np.stack([np.arctan2(words[f"in_n{i}"], words[f"in_c{i}"]) for i in range(1, 7)], axis=-1)
    rotation, tip = truth_six.fk6(angles, arm)
    end, limit = 1 << p["W"] - 1, bounds.forward_coordinate(p, arm)
    held = np.clip(tip, -end, end - 1)
    error = np.abs(np.stack([answer[f"out_{axis}"] for axis in "xyz"], axis=-1) - held).max()
    assert 0.4 < error <= limit < 1.4
    matrix = np.stack([answer[f"out_r{axis}"] for axis in six.AXES], axis=-1).reshape(-1, 3, 3)
    error = np.abs(matrix - rotation * 2.0 ** p["U"]).max()
    assert 1 < error <= bounds.forward_matrix(p)
    over, flag = np.abs(tip - (-0.5)).max(axis=-1) - end, answer["out_status"] == 4
    assert np.all(flag[over > limit]) and not np.any(flag[over < -limit])


def _to_border(arm: Six, rotation: np.ndarray, tip: np.ndarray, branch: int) -> np.ndarray:
    """Distance (LSB) of the wrist's centre from the nearest border of what the arm reaches on that side."""
    x, y, z = np.moveaxis(tip - arm.c4 * rotation[..., 2], -1, 0)
    x1 = np.sqrt(np.maximum(x * x + y * y - arm.b**2, 0)) * (-1 if branch & 1 else 1)
    r = np.hypot(x1 - arm.a1, z - arm.c1)
    borders = r - arm.c2 - arm.k, r - abs(arm.c2 - arm.k), np.hypot(x, y) - abs(arm.b)
    return np.min(np.abs(borders), axis=0)


@ROBOTS
@cores(INVERSE)
@pytest.mark.parametrize("branch", range(8))
def test_inverse(core, robot, branch):
    """Tip and orientation within their laws, everywhere in reach; 2 LSB and 0.02 degrees where the law says so."""
    unit, arm = _arm(robot, core)
    p = core.params
    words, rotation, tip = _words(core, *truth_six.fk6(_joints(12_000, arm, 4), arm))
    answer = core.model(p, **words, in_branch=np.int64(branch), **six.config(p, **unit._asdict()))
    status = answer["out_status"]
    _, out = truth_six.ik6(rotation, tip, arm, branch)
    ok = (status & 1 == 0) & ~out
    again = truth_six.fk6(_angles(answer), arm)
    off = np.linalg.norm(again[1] - tip, axis=-1)
    law = bounds.position(p, arm, rotation, tip, branch & 1)
    assert np.all(off[ok] <= law[ok]) and np.any(off[ok] > 0.08 * law[ok])
    near = ok & (law <= 2)
    assert near.mean() > 0.5 and off[near].max() <= 2
    turned, limit = truth_six.turned(again[0], rotation), bounds.orientation(p, status & 2 > 0)
    assert np.all(turned[ok] <= limit[ok]) and turned[ok].max() > 0.25 * limit.min()
    if p["U"] >= 16:
        assert np.degrees(limit.max()) <= 0.02
    assert not np.any(status & 8)
    differs = out != (status & 1 > 0)
    assert not np.any(differs & (_to_border(arm, rotation, tip, branch) > 1)), "rounding decides within an LSB alone"


def _held(p: dict[str, int], branch: int, **ports: np.ndarray) -> np.ndarray:
    """Which joints vector_ik6 holds, bit i - 1 for joint i."""
    none = meaning.fixed(parser.load(six.INVERSE), p, **ports, in_branch=np.int64(branch)).none
    return sum(none[f"c{joint}"].astype(int) << joint - 1 for joint in (1, 2, 4))


def _near_axes(arm: Six, count: int, area: float, axis: int, rng: np.random.Generator) -> np.ndarray:
    """(N, 3) wrist centres within three roots of the area unit of axis 1, or of axis 2 in front of axis 1."""
    off, turn, yaw = rng.uniform(0, 3 * np.sqrt(area), count), *rng.uniform(-np.pi, np.pi, (2, count))
    if axis == 1:
        return np.stack([off * np.cos(yaw), off * np.sin(yaw), arm.c1 + rng.uniform(-1, 1, count) * arm.c2], axis=-1)
    far = np.hypot(arm.a1 + off * np.cos(turn), arm.b)
    return np.stack([far * np.cos(yaw), far * np.sin(yaw), arm.c1 + off * np.sin(turn)], axis=-1)


@cores(INVERSE)
def test_the_zones_in_which_joints_1_and_2_are_held(core):
    """A held joint 1 or 2 has the wrist within its zone, and the tip within its law."""
    p, rng, area = core.params, np.random.default_rng(11), 2.0 ** (2 * core.params["W"] - product_engine.H)
    half, found, tips = 1 << p["W"] - 1, {1: [0.0], 2: [0.0]}, {1: [0.0], 2: [0.0]}
    for trial in range(24):
        link = rng.uniform(0.15, 0.4) * half
        b = rng.uniform(-1.7, 1.7) * np.sqrt(area) * (trial % 2)
        arm = Six(rng.uniform(-0.1, 0.1) * half * (trial % 3 > 0), 0, b, rng.uniform(-0.2, 0.2) * half, link,
                  link * (1 if trial % 4 < 3 else 0.7), rng.uniform(0, 0.1) * half)
        cfg = six.config(p, **{name: length / 2.0 ** p["F"] for name, length in arm._asdict().items()})
        matrix, _ = truth_six.fk6(rng.uniform(-np.pi, np.pi, (3000, 6)), arm)
        matrix = np.rint(matrix * 2.0 ** p["U"]) / 2.0 ** p["U"]
        axis = 1 + trial // 2 % 2
        words, rotation, tip = _words(core, matrix, _near_axes(arm, 3000, area, axis, rng) + arm.c4 * matrix[..., 2])
        px, py, square, x, z = bounds._wrist(arm, rotation, tip, False)
        rho, r, x1 = np.hypot(px, py), np.hypot(x, z), np.sqrt(np.maximum(square, 1e-9))
        for branch in (0, 2):
            answer = core.model(p, **words, in_branch=np.int64(branch), **cfg)
            none = _held(p, branch, **words, **cfg)
            for joint, distance in ((1, rho), (2, r)):
                held = none >> joint - 1 & 1 > 0
                assert np.all(distance[held] <= bounds.zone(p, joint, x1[held]))
                found[joint].append(distance[held].max(initial=0))
            ok = (answer["out_status"] & 1 == 0) & (square > 0) & (none & 3 > 0)
            off = np.linalg.norm(truth_six.fk6(_angles(answer), arm)[1] - tip, axis=-1)
            law = bounds.position(p, arm, rotation, tip, False, none)
            assert np.all(off[ok] <= law[ok])
            for joint in (1, 2):
                tips[joint].append(off[ok & (none & 3 == joint)].max(initial=0))
    for joint, share in ((1, 0.9), (2, 0.65)):
        assert max(found[joint]) > share * bounds.zone(p, joint, half / 4)
        assert max(tips[joint]) > 0.5 * bounds.held(p, joint)


@ROBOTS
@cores(INVERSE)
@pytest.mark.parametrize("branch", [0, 1])
def test_the_law_out_of_reach(core, robot, branch):
    """Anywhere out of reach of axis 2, next to axis 1 too: the tip is within its law of the nearest one."""
    unit, arm = _arm(robot, core)
    p, rng = core.params, np.random.default_rng(12)
    rotation, _ = truth_six.fk6(rng.uniform(-np.pi, np.pi, (6000, 6)), arm)
    tip = rng.uniform(-1, 1, (6000, 3)) * (1 << p["W"] - 1)
    near = rng.random(6000) < 0.5  # of axis 1, log-uniform
    aside = 2.0 ** rng.uniform(-1, p["W"] - 3, (6000, 1)) * rng.normal(size=(6000, 2))
    tip[near, :2] = (arm.c4 * rotation[:, :2, 2] + aside)[near]
    words, rotation, tip = _words(core, rotation, tip)
    answer = core.model(p, **words, in_branch=np.int64(branch), **six.config(p, **unit._asdict()))
    none = _held(p, branch, **words, **six.config(p, **unit._asdict()))
    _, _, square, x, z = bounds._wrist(arm, rotation, tip, branch)
    r = np.hypot(x, z)
    out = ((r > arm.c2 + arm.k + 2) | (r < abs(arm.c2 - arm.k) - 2)) & (none & 3 == 0) & (square > 0)
    assert out.sum() > 800 and np.all(answer["out_status"][out] & 1)
    off = np.linalg.norm(truth_six.fk6(_angles(answer), arm)[1]
                         - bounds.nearest(arm, rotation, tip, branch), axis=-1)[out]
    law = bounds.beyond(p, arm, rotation, tip, branch)[out]
    assert np.all(off <= law) and np.any(off > 0.06 * law)


@cores(INVERSE)
def test_the_elbow_asked_for_at_a_right_angle(core):
    """The cosine of the elbow within 2^-13 of 0."""
    unit, arm = _arm("kr6_r700", core)
    q = np.random.default_rng(9).uniform(-1, 1, (2000, 6))
    q[:, 2] = np.pi / 2 - arm.psi + q[:, 2] * 1e-4
    words, _, _ = _words(core, *truth_six.fk6(q, arm))
    cfg = six.config(core.params, **unit._asdict())
    for branch in (0, 2):
        answer = core.model(core.params, **words, in_branch=np.int64(branch), **cfg)
        assert np.all(np.sin(_angles(answer)[:, 2] + arm.psi) * (1 - branch) > 0)


@ROBOTS
@cores(INVERSE)
def test_unreachable_answers_the_nearest_point(core, robot):
    """Beyond the arm the wrist is on the line from axis 2 to its target, the arm stretched; the matrix is kept."""
    unit, arm = _arm(robot, core)
    p, rng = core.params, np.random.default_rng(5)
    q = rng.uniform(-np.pi, np.pi, (6000, 6))
    rotation, _ = truth_six.fk6(q, arm)
    tip = rng.uniform(-1, 1, (6000, 3)) * (1 << p["W"] - 1)
    words, rotation, tip = _words(core, rotation, tip)
    answer = core.model(p, **words, in_branch=np.int64(0), **six.config(p, **unit._asdict()))
    centre = tip - arm.c4 * rotation[..., 2]
    x = np.sqrt(np.maximum(centre[:, 0] ** 2 + centre[:, 1] ** 2 - arm.b**2, 0)) - arm.a1
    z = centre[:, 2] - arm.c1
    r, reach = np.hypot(x, z), arm.c2 + arm.k
    out = (r > reach + 2) & (np.hypot(*centre[:, :2].T) > abs(arm.b) + 40)
    assert out.sum() > 1000 and np.all(answer["out_status"][out] == 1)
    again = truth_six.fk6(_angles(answer), arm)
    wrist = again[1] - arm.c4 * again[0][..., 2]
    held = np.hypot(wrist[:, 0], wrist[:, 1])
    there = np.stack([np.sqrt(np.maximum(held**2 - arm.b**2, 0)) - arm.a1, wrist[:, 2] - arm.c1], axis=-1)
    nearest = np.stack([x, z], axis=-1) * (reach / r)[:, None]
    assert np.abs(there - nearest)[out & (nearest[:, 0] + arm.a1 > 40)].max() <= 2
    assert truth_six.turned(again[0], rotation)[out].max() <= bounds.orientation(p, True)


@cores(INVERSE)
def test_straight_wrist_keeps_joint_4(core):
    """A regular pose, then straight ones: joint 4 holds its word, joint 6 takes the rest, the orientation is right."""
    unit, arm = _arm("kr6_r700", core)
    p = core.params
    q = np.random.default_rng(6).uniform(-1, 1, (400, 6))
    q[:, 2] += 1.5
    q[:, 4] = 0
    q[::20, 4] = 1
    words, rotation, tip = _words(core, *truth_six.fk6(q, arm))
    answer = core.model(p, **words, in_branch=np.int64(0), **six.config(p, **unit._asdict()))
    straight = answer["out_status"] & 2 > 0
    bent = np.arange(400) % 20 == 0  # others are as straight as the rounding of the tip lets them be
    assert len(straight) == 400 and not straight[bent].any() and straight[~bent].mean() > 0.25
    for letter in "cn":
        word = answer[f"out_{letter}4"]
        assert np.array_equal(word[1:][straight[1:]], word[:-1][straight[1:]])
    again = truth_six.fk6(_angles(answer), arm)
    assert truth_six.turned(again[0], rotation).max() <= bounds.orientation(p, True)
    at = np.flatnonzero(straight)[0]
    after_reset = core.model(p, **{name: word[at:at + 1] for name, word in words.items()}, in_branch=np.int64(0),
                             **six.config(p, **unit._asdict()))
    assert (after_reset["out_c4"][0], after_reset["out_n4"][0]) == (1 << p["U"], 0)


@cores(INVERSE)
def test_no_rotation_is_told(core):
    """A word 48 units off, a mirror image, a stretched matrix, a shear, none; rounded rotations are not told."""
    unit, arm = _arm("kr6_r700", core)
    p, cfg = core.params, six.config(core.params, **unit._asdict())
    words, *_ = _words(core, *truth_six.fk6(np.random.default_rng(7).uniform(-np.pi, np.pi, (500, 6)), arm))

    def told(change: dict) -> np.ndarray:
        return core.model(p, **(words | change), in_branch=np.int64(0), **cfg)["out_status"] & 8 > 0

    assert not told({}).any()
    for axis in six.AXES:
        assert told({f"in_r{axis}": words[f"in_r{axis}"] + 48}).all()
    one = 1 << p["U"]  # columns as long as sqrt(5), each sum 0 or 4, which wrapped to 0 as a word
    long = dict(zip(six.AXES, (2 * one - 1, 0, one, one, 0, -2 * one, 0, one, 0)))
    assert told({f"in_r{axis}": np.full(500, word) for axis, word in long.items()}).all()
    assert told({f"in_r{axis}": -words[f"in_r{axis}"] for axis in six.AXES}).all()
    assert told({f"in_r{axis}": 0 * words[f"in_r{axis}"] for axis in six.AXES}).all()
    assert told({f"in_r{axis}": words[f"in_r{axis}"] * 1001 // 1000 for axis in six.AXES}).all() or p["U"] < 16


@ROBOTS
@cores(ALL)
def test_all_branches(core, robot):
    """Branches 0 to 3 are those of vector_ik6, the others mirror them; all eight are the same pose within its laws."""
    unit, arm = _arm(robot, core)
    p, cfg = core.params, six.config(core.params, **unit._asdict())
    words, rotation, tip = _words(core, *truth_six.fk6(_joints(6000, arm, 8), arm))
    found = core.model(p, **words, **cfg)
    for branch in range(8):
        answer = {f"out_{letter}{i}": found[f"out_{letter}{i}{branch}"] for letter in "cn" for i in range(1, 7)}
        far, held = (found[name] >> branch & 1 > 0 for name in ("out_far", "out_held"))
        one = six.ik6(p, **words, in_branch=np.int64(branch), **cfg)
        differs = far != (one["out_status"] & 1 > 0)
        assert not np.any(differs & (_to_border(arm, rotation, tip, branch) > 1))  # within an LSB rounding decides
        assert np.array_equal(held, one["out_status"] & 2 > 0)
        if branch < 4:
            assert all(np.array_equal(word[~held], one[name][~held]) for name, word in answer.items())
        ok = ~far & ~truth_six.ik6(rotation, tip, arm, branch)[1]
        again = truth_six.fk6(_angles(answer), arm)
        law = bounds.position(p, arm, rotation, tip, branch & 1)
        assert np.all(np.linalg.norm(again[1] - tip, axis=-1)[ok] <= law[ok])
        assert np.all(truth_six.turned(again[0], rotation)[ok] <= bounds.orientation(p, held)[ok])


@cores(ALL)
def test_margin_and_slack(core):
    """Bit 1 within the margin of each singularity and not beyond; stretched poses within the slack are not refused."""
    unit, arm = _arm("kr6_r700", core)
    p, rng, n = core.params, np.random.default_rng(6), 3000
    q = rng.uniform(-np.pi, np.pi, (n, 6))
    for part, joint, at in ((slice(0, None, 3), 2, -arm.psi), (slice(1, None, 3), 4, 0)):
        q[part, joint] = at + rng.uniform(-0.3, 0.3, len(q[part]))
    words, rotation, tip = _words(core, *truth_six.fk6(q, arm))
    centre = tip - arm.c4 * rotation[..., 2]
    margin, told = round(0.1 * arm.k), {}
    for size in (0, margin):
        cfg = six.config(p, **unit._asdict(), margin=size * 2.0 ** -p["F"], slack=0.0)
        answer = core.model(p, **words, **cfg)
        told[size] = answer["out_held"][:, None] >> np.arange(8) & 1 > 0
    for branch in range(8):
        joints_of, out = truth_six.ik6(rotation, tip, arm, branch)
        nearest = np.min([np.sqrt(np.maximum(centre[:, 0] ** 2 + centre[:, 1] ** 2 - arm.b**2, 0)),
                          arm.k * np.abs(np.sin(joints_of[:, 2] + arm.psi)), arm.k * np.abs(np.sin(joints_of[:, 4]))],
                         axis=0)
        slip, ok = 0.02 * margin + 3, ~out & (answer["out_far"] >> branch & 1 == 0)
        inside, outside = ok & (nearest < margin - slip), ok & (nearest > margin + slip)
        assert told[0][ok, branch].mean() < 0.01
        assert told[margin][inside, branch].all() and not told[margin][outside, branch].any()
        assert min(inside.sum(), outside.sum()) > 200
    # the arm stretched, its tip rounded to words, and up to 12 LSB farther out along it
    q[:, 2], q[:, 4], away = -arm.psi, rng.uniform(0.3, 2.8, n), rng.uniform(0, 12, n)
    rotation, tip = truth_six.fk6(q, arm)
    shoulder = np.stack([arm.a1 * np.cos(q[:, 0]) - arm.b * np.sin(q[:, 0]),
                         arm.a1 * np.sin(q[:, 0]) + arm.b * np.cos(q[:, 0]), np.full(n, arm.c1)], axis=-1)
    arm_line = tip - arm.c4 * rotation[..., 2] - shoulder
    length = np.linalg.norm(arm_line, axis=-1)
    assert np.abs(length - arm.c2 - arm.k).max() < 1e-6 * length.max()
    words, _, moved = _words(core, rotation, tip + arm_line / length[:, None] * away[:, None])
    ahead = np.hypot(*(moved - arm.c4 * rotation[..., 2])[:, :2].T) > abs(arm.a1) + abs(arm.b) + 0.05 * arm.c2
    forward = (np.cos(q[:, 0]) * arm_line[:, 0] + np.sin(q[:, 0]) * arm_line[:, 1] > 0).astype(int)
    assert (ahead & (forward > 0)).mean() > 0.3
    for slack in (0, 6):
        cfg = six.config(p, **unit._asdict(), margin=0.0, slack=slack * 2.0 ** -p["F"])
        far = core.model(p, **words, **cfg)["out_far"] & 1 > 0  # branch 0 looks forward
        mine = ahead & (forward > 0)
        assert not far[mine & (away < slack - 2)].any() and far[mine & (away > slack + 2)].all()


@cores(ANGLES)
def test_angles_are_those_of_the_vectors(core):
    """Within 0.89 LSB and what the vector's length turns, held joints too."""
    p, rng = core.params, np.random.default_rng(9)
    samples = importlib.import_module(f"tb.stimulus.{core.family}")
    vectors = next(one.model for one in all_cores() if one.function == core.function.removesuffix("_to_angles"))
    named = joints(core.outputs)
    for cfg in stimulus.configs(core, rng)[:2]:
        q = rng.uniform(-np.pi, np.pi, (1500, len(named)))
        q[::9, 4:6] = 0  # one of them has no direction
        lengths = (cfg.get(f"cfg_{name}", 0) * 2.0 ** -(p["F"] + six.MORE) for name in truth_srs.Srs._fields)
        arm = truth_srs.Srs(*lengths) if core.family == "srs" else samples._arm(core, cfg)
        words = samples.poses(core, arm, q, rng)
        if core.family == "srs":  # with the swivel of these joints
            swivel = truth_srs.swivel(q, arm)
            words |= {"in_cs": np.rint(np.cos(swivel) * 2.0 ** p["U"]).astype(int),
                      "in_ns": np.rint(np.sin(swivel) * 2.0 ** p["U"]).astype(int)}
        answer, found = core.model(p, **words, **cfg), vectors(p, **words, **cfg)
        assert np.array_equal(answer["out_status"], found["out_status"])
        assert (found["out_status"] & 2).any() and not (found["out_status"] & 8).any()
        turn = 1 << p["A"]
        for i in range(1, len(named) + 1):
            c, n = (found[f"out_{letter}{i}"] * 2.0 ** -p["U"] for letter in "cn")
            off = (answer[f"out_j{i}"] - np.arctan2(n, c) * turn / (2 * np.pi) + turn / 2) % turn - turn / 2
            assert np.all(np.abs(off) <= 0.89 + 1.06 * np.abs(np.hypot(c, n) - 1) * turn / (2 * np.pi))


@ROBOTS
@cores([core for core in ANGLES if core.family == "six"])
def test_a_joint_without_a_vector_has_the_angle_formed_last(core, robot):
    unit, arm = _arm(robot, core)
    cfg = six.config(core.params, **unit._asdict())
    words, *_ = _words(core, *truth_six.fk6(_joints(2, arm, 9), arm))
    zero = {name: word * [1, 0] if name.startswith("in_r") else word for name, word in words.items()}
    none = core.model(core.params, **zero, in_branch=np.int64(0), **cfg)
    assert none["out_status"][1] == 8 | 2 | none["out_status"][1] & 1
    assert none["out_j4"][0] == none["out_j4"][1]  # held, so joint 2 was formed last
    assert none["out_j2"][1] == none["out_j5"][1] == none["out_j6"][1]


# Programs


@pytest.mark.parametrize("name", ["program/vector_fk6_program", "program/vector_ik6_program",
                                  "program/vector_ik6_all_program", "engine/delta/engine_delta_program"])
def test_program_reads_what_is_written(name):
    """No register is read before the third line behind its writer, LAST only behind a written word, NIL by none."""
    text = table.branch((RTL / f"{name}.v").read_text(), 0)
    lines = [[cell.strip() for cell in cells.split(",")] for cells in re.findall(r"/\* .*? \*/ \{(.*?)\}", text)]
    again = re.search(r"AGAIN\((\d+)\)", text)
    lines += lines[int(again[1]):] if again else []  # played twice
    address = {key: int(value) for key, value in re.findall(r"(\w+) = 6'd(\d+)", text)}
    written: dict[str, tuple[int, int]] = {}
    owner: dict[int, str] = {}
    act = {"HOLD"}
    for i, (a_from, a, b_from, b, c, d, total, _keep, *rest) in enumerate(lines):
        dest, held = (rest[1], rest[2]) if len(rest) == 3 else (rest[0], "")
        reads = [a] * (a_from == "REG") + [b] * (b_from == "OF") + [c, d] * (total != "LONE")
        for register in reads:
            assert register in written, f"line {i}: {register} is not written"
            assert written[register][0] <= i - 3, f"line {i}: {register} is read too early"
            assert owner[address[register]] == register, f"line {i}: {register} has been overwritten"
        if a_from == "LAST":
            assert lines[i - 1][-1 if len(rest) == 1 else -2] != "NIL" and not act & set(lines[i - 1][-1].split(" | "))
        if dest != "NIL":
            written[dest], owner[address[dest]] = (i, address[dest]), dest
    assert len(lines) > 30


# Velocities: the models against numerical Jacobians of a chain of frames, flags and factors

TIP = "vx", "vy", "vz", "wx", "wy", "wz"
VELOCITY, RATES = ([core for core in distinct() if core.name == name]
                    for name in ("vector_velocity6", "vector_rates6"))


class Motion:
    """Joints anywhere of a robot as large as the word, as words; the chain's Jacobian at the directions of these."""

    def __init__(self, p: dict, robot: str, count: int, seed: int) -> None:
        arm, mm = truth_six.load(robot)
        self.p, self.rng = p, np.random.default_rng(seed)
        share = 2.0 ** (p["W"] - 1 - p["F"]) / 128 / mm
        self.unit = {name: length * share for name, length in arm._asdict().items()}
        self.arm = Six(**{name: length * 2.0 ** p["F"] for name, length in self.unit.items()})
        self.lengths = {name: length for name, length in self.unit.items() if name != "c1"}
        self.scale = 2.0 ** np.repeat([p["F"], p["V"]], 3)  # LSB of a velocity and of a turn
        q = self.rng.uniform(-np.pi, np.pi, (count, 6))
        self.words = {f"in_{letter}{i + 1}": np.rint(part(q[:, i]) * 2.0 ** p["U"]).astype(np.int64)
                      for i in range(5) for letter, part in (("c", np.cos), ("n", np.sin))}
        self.q = np.stack([np.arctan2(self.words[f"in_n{i}"], self.words[f"in_c{i}"]) for i in range(1, 6)] + [q[:, 5]],
                          axis=-1)
        self.jacobian = frames.jacobian(lambda one: frames.wrist_arm(one, **self.unit), self.q)
        self.end = 2.0 ** (p["W"] - 1 - p["V"])  # of the rates

    def rates(self, share: float) -> np.ndarray:
        """Random rates up to a share of their word."""
        return self.rng.uniform(-share, share, self.q.shape) * self.end

    def tip(self, rates: np.ndarray) -> np.ndarray:
        """Words of velocity and turn for rates."""
        return np.rint((self.jacobian @ rates[..., None])[..., 0] * self.scale).astype(np.int64)

    def ask(self, core, tip: np.ndarray, thresholds: dict | None = None) -> dict:
        """What vector_rates6 answers; without thresholds by default."""
        return core.model(self.p, **self.words, **{f"in_{name}": tip[:, i] for i, name in enumerate(TIP)},
                          **six.motion_config(self.p, **self.lengths),
                          **(thresholds or dict.fromkeys(("cfg_radius", "cfg_elbow", "cfg_sine"), 0)))


@ROBOTS
@cores(VELOCITY)
def test_velocity(core, robot):
    """Within its law of the Jacobian of the chain; saturated where that is beyond the word, and never unflagged."""
    p, one = core.params, Motion(core.params, robot, 2000, 1)
    rates = np.rint(one.rates(0.4) * 2.0 ** p["V"]).astype(np.int64)
    answer = core.model(p, **one.words, **{f"in_w{i + 1}": rates[:, i] for i in range(6)},
                        **six.motion_config(p, **one.lengths))
    exact = (one.jacobian @ (rates * 2.0 ** -p["V"])[..., None])[..., 0] * one.scale
    linear, turn = bounds.velocity(p, one.arm, rates * 2.0 ** -p["V"])
    law = np.stack([linear] * 3 + [turn] * 3, axis=-1)
    found, flag = np.stack([answer[f"out_{name}"] for name in TIP], axis=-1), answer["out_status"] == 4
    assert np.all(np.abs(found - exact)[~flag] <= law[~flag])
    assert np.all((np.abs(found - exact) / law)[~flag].max(axis=0) > 0.05) and 0.5 < (~flag).mean() < 0.999
    beyond = np.abs(exact + 0.5).max(axis=-1) - 2 ** (p["W"] - 1)
    assert np.all(flag[beyond > law.max(axis=-1)]) and not np.any(flag[beyond < -law.max(axis=-1)])


@ROBOTS
@cores(RATES)
def test_rates(core, robot):
    """Within their law of the chain's inverse Jacobian; never unflagged where that is beyond a rate's word."""
    p, one = core.params, Motion(core.params, robot, 2000, 2)
    tip = one.tip(one.rates(0.5) * 2.0 ** -one.rng.uniform(0, 6, (2000, 1)))
    tip[::3] = one.rng.integers(-2 ** (p["W"] - 2), 2 ** (p["W"] - 2), tip[::3].shape)  # any motion
    fits = np.all(np.abs(tip) < 2 ** (p["W"] - 1), axis=-1)
    answer = one.ask(core, np.where(fits[:, None], tip, 0))
    motion = np.where(fits[:, None], tip, 0) / one.scale
    exact = np.linalg.solve(one.jacobian, motion[..., None])[..., 0]
    found = np.stack([answer[f"out_w{i}"] for i in range(1, 7)], axis=-1) * 2.0 ** -p["V"]
    law = bounds.rates(p, one.arm, one.q, motion * 2.0 ** np.repeat([p["F"], 0], 3), exact)
    off, over = np.abs(found - exact) * 2.0 ** p["V"] / law, answer["out_status"] & 4 > 0
    assert np.all(off[fits & ~over] <= 1) and fits.mean() > 0.3
    assert np.all(off[fits & ~over].max(axis=0) > [0.3, 0.1, 0.1, 0.05, 0.05, 0.05])
    beyond = np.abs(exact).max(axis=-1) - law.max(axis=-1) * 2.0 ** -p["V"] > one.end
    assert np.all(over[beyond & fits]) and (beyond & fits).sum() > 20
    distances = {"d1": 2.0 ** p["F"], "d3": 2.0 ** p["F"], "d5": 2.0 ** p["U"]}
    d1, d3, d5 = (answer[f"out_{name}"] / lsb for name, lsb in distances.items())
    off = np.abs(np.abs(d1 * one.unit["c2"] * d3 * d5) - np.abs(np.linalg.det(one.jacobian)))
    size = sum(map(abs, one.unit.values()))
    assert off[np.abs(answer["out_d1"]) < 2 ** (p["W"] - 1) - 1].max() < 2 * size**2 * 2.0 ** -p["F"]


@ROBOTS
def test_rates_are_within_a_thousandth_of_the_largest(robot):
    """At U = 18, where |sin elbow sin q5| is 0.02 or more, 4 % of the range from axis 1, and rates fill their word."""
    core = find("vector_rates6")
    one = Motion(core.params | {"U": 18}, robot, 5000, 3)
    tip = one.tip(one.rates(0.4))
    exact = np.linalg.solve(one.jacobian, (tip / one.scale)[..., None])[..., 0]
    answer = one.ask(core, np.clip(tip, -32768, 32767))
    off = np.abs(np.stack([answer[f"out_w{i}"] for i in range(1, 7)], axis=-1) * 2.0**-12 - exact).max(axis=-1)
    largest = np.abs(exact).max(axis=-1)
    sines = np.abs(np.sin(one.q[:, 2] + one.arm.psi) * np.sin(one.q[:, 4]))
    regular = np.all(np.abs(tip) < 32768, axis=-1) & (answer["out_status"] == 0) & (sines >= 0.02)
    regular &= (np.abs(answer["out_d1"]) > 1310) & (largest > one.end / 8)
    assert regular.sum() > 1500
    share = (off - 2.0**-13)[regular] / largest[regular]
    assert 2e-4 < share.max() <= 1e-3


@cores(RATES)
def test_singular_is_a_factor_within_its_threshold(core):
    """Each alone decides; without thresholds nothing is singular but a factor of 0, whose rate is 0."""
    p, one = core.params, Motion(core.params, "kr6_r700", 1500, 4)
    tip = one.tip(one.rates(0.02))
    words = six.rates_config(p, **one.lengths, radius=one.unit["c2"] / 4, angle=0.2)
    factors = {"cfg_radius": "out_d1", "cfg_elbow": "out_d3", "cfg_sine": "out_d5"}
    zero = dict.fromkeys(factors, 0)
    assert not one.ask(core, tip)["out_status"].any()
    for name, factor in factors.items():
        answer = one.ask(core, tip, zero | {name: words[name]})
        off = np.abs(answer[factor]) - words[name]
        flag = answer["out_status"] & 2 > 0
        assert np.all(flag[off < -1]) and not np.any(flag[off > 1]) and 0.02 < flag.mean() < 0.6
    one.words |= {"in_c5": one.words["in_c5"] * 0 + 2 ** p["U"], "in_n5": one.words["in_n5"] * 0}
    answer = one.ask(core, tip)
    assert np.all(answer["out_status"] & 2) and np.all(answer["out_w6"] == 0) and np.mean(answer["out_w4"] != 0) > 0.9
