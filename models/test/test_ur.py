"""Three parallel axes: truth and texts against a chain of matrices, the bit-true models against chain and bounds."""

from __future__ import annotations

import importlib
import math

import numpy as np
import pytest
from quadrance import arms, truth_six, truth_ur, ur
from quadrance.accuracy import pose
from quadrance.bounds import ur as bounds
from quadrance.cores import ROOT, find
from quadrance.program import assembler, image, meaning, parser
from quadrance.truth_ur import Ur

from models.test.claims import distinct

CORES = [core for core in distinct() if core.family == "ur"]
FORWARD, INVERSE, ALL = ([core for core in CORES if core.function == name] for name in ("ur_fk", "ur_ik", "ur_ik_all"))
AXES = [f"{row}{column}" for row in "123" for column in "123"]
POLISH = ROOT / "docs" / "polish.kin"
MARGIN = 60  # mm from a singular pose, where a robot off its table is polished
SMALL = 0.1  # joints 3 and 5 next to their singularities, radians

# Universal Robots, "DH parameters for calculations of kinematics and dynamics", e-Series; mm
MAKER = {"ur3e": ((151.85, -243.55, -213.2, 131.05, 85.35, 92.1), 8),
         "ur5e": ((162.5, -425, -392.2, 133.3, 99.7, 99.6), 10),
         "ur10e": ((180.7, -612.7, -571.55, 174.15, 119.85, 116.55), 20)}
ROBOTS = pytest.mark.parametrize("robot", MAKER)


def cores(of):
    return pytest.mark.parametrize("core", of, ids=lambda core: core.id)


def chain(robot: str, q: np.ndarray) -> np.ndarray:
    """(N, 4, 4), mm: the maker's table as a product of Denavit-Hartenberg matrices, and nothing of the library."""
    d1, a2, a3, d4, d5, d6 = MAKER[robot][0]
    found = np.eye(4)
    for i, (a, d, alpha) in enumerate(((0, d1, 90), (a2, 0, 0), (a3, 0, 0), (0, d4, 90), (0, d5, -90), (0, d6, 0))):
        c, s, zero = np.cos(q[:, i]), np.sin(q[:, i]), np.zeros(len(q))
        cos, sin = np.cos(np.radians(alpha)), np.sin(np.radians(alpha))
        rows = ((c, -s * cos, s * sin, a * c), (s, c * cos, -c * sin, a * s), (zero, zero + sin, zero + cos, zero + d),
                (zero, zero, zero, zero + 1))
        found = found @ np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
    return found


def _joints(count: int, seed: int) -> np.ndarray:
    """Anywhere; a third with joint 3 next to 0 or half a turn, or joint 5."""
    rng = np.random.default_rng(seed)
    q = rng.uniform(-np.pi, np.pi, (count, 6))
    near = 10 ** rng.uniform(-5, np.log10(SMALL), count) * rng.choice([-1, 1], count)
    for part, joint in ((slice(0, None, 6), 2), (slice(1, None, 6), 4)):
        q[part, joint] = near[part] + np.pi * rng.integers(0, 2, len(q[part]))
    return q


def _unit(core, robot: str) -> float:
    """Millimetres in a coordinate unit: as in the arm file at Q7.8, else as large as the word."""
    return MAKER[robot][1] * 2.0 ** (8 - core.params["W"] + core.params["F"])


def _arm(core, robot: str) -> Ur:
    """The arm in LSB."""
    d1, a2, a3, d4, d5, d6 = (length / _unit(core, robot) * 2.0 ** core.params["F"] for length in MAKER[robot][0])
    return Ur(d1, d4, d5, d6, -a2, -a3)


def _config(core, robot: str, **more: float) -> dict[str, int]:
    """Configuration words; margin and slack in LSB."""
    p, lsb = core.params, 2.0 ** -core.params["F"]
    lengths = {name: length * lsb for name, length in _arm(core, robot)._asdict().items()}
    if core.function == "ur_fk":
        return ur.forward_config(p, **lengths)
    return ur.config(p, **lengths, **{name: value * lsb for name, value in more.items()})


def _words(core, robot: str, pose: np.ndarray) -> tuple[dict, np.ndarray, np.ndarray, np.ndarray]:
    """Port words of the poses (mm) that a word holds; matrix and tip (LSB) that they say; which poses those are."""
    p = core.params
    tip = np.rint(pose[:, :3, 3] / _unit(core, robot) * 2.0 ** p["F"]).astype(int)
    held = np.all(np.abs(tip) < 1 << p["W"] - 1, axis=1)
    matrix, tip = np.rint(pose[held, :3, :3] * 2.0 ** p["U"]).astype(int), tip[held]
    words = {f"in_r{axis}": matrix[:, i // 3, i % 3] for i, axis in enumerate(AXES)}
    words |= {f"in_{axis}": tip[:, i] for i, axis in enumerate("xyz")}
    return words, matrix * 2.0 ** -p["U"], tip.astype(float), held


def _off(core, robot: str, q: np.ndarray, rotation: np.ndarray, tip: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Distance (LSB) and angle of the pose of joints, by the maker's table, from a matrix and a tip."""
    pose = chain(robot, q)
    place = pose[:, :3, 3] / _unit(core, robot) * 2.0 ** core.params["F"]
    return np.linalg.norm(place - tip, axis=-1), truth_six.turned(pose[:, :3, :3], rotation)


def _angles(answer: dict, branch: str = "") -> np.ndarray:
    pairs = ((answer[f"out_n{i}{branch}"], answer[f"out_c{i}{branch}"]) for i in range(1, 7))
    return np.stack([np.arctan2(*pair) for pair in pairs], axis=-1)


# Truth and text


@ROBOTS
def test_the_arm_file_and_the_truth_are_the_makers_table(robot):
    """Forward the chain of matrices; inverse back to it on all branches, the joints among them."""
    arm, mm = truth_ur.load(robot)
    d1, a2, a3, d4, d5, d6 = MAKER[robot][0]
    assert (arm, mm) == (Ur(d1, d4, d5, d6, -a2, -a3), MAKER[robot][1])
    q = _joints(4000, 1)
    pose, (rotation, tip) = chain(robot, q), truth_ur.fk(q, arm)
    assert np.abs(rotation - pose[:, :3, :3]).max() < 1e-12 and np.abs(tip - pose[:, :3, 3]).max() < 1e-9
    nearest = np.full(len(q), 9.0)
    for branch in range(8):
        joints, far = truth_ur.ik(rotation, tip, arm, branch)
        again = chain(robot, joints)
        assert far.mean() < 0.3 and np.abs(again - pose)[~far].max() < 1e-5
        s3, s5 = np.sin(joints[:, 2]), np.sin(joints[:, 4])
        assert np.all(s3[~far] * (1 - (branch & 2)) > -1e-7) and np.all(s5[~far] * (1 - (branch & 4) / 2) > -1e-7)
        nearest = np.minimum(nearest, np.where(far, 9, np.abs(np.exp(1j * joints) - np.exp(1j * q)).max(axis=1)))
    assert np.quantile(nearest, 0.95) < 1e-6 and nearest.max() < 0.01  # rounding decides next to a singularity


def _values(robot: str, pose: np.ndarray, scale: float) -> dict:
    """Words of the texts as numbers, for a pose in mm; 1.0 of a length is `scale` mm."""
    d1, a2, a3, d4, d5, d6 = (length / scale for length in MAKER[robot][0])
    found = {f"r{axis}": pose[:, i // 3, i % 3] for i, axis in enumerate(AXES)}
    found |= {axis: pose[:, i, 3] / scale for i, axis in enumerate("xyz")} | {"m": 0.0, "slack": 1e-9, "sl": 1e-9}
    found |= {"d1": d1, "d4": d4, "d5": d5, "d6": d6, "l2": -a2, "l3": -a3}
    return found | {"r": 1 / (2 * a2 * a3) / 256, "e": 256.0}


@ROBOTS
def test_float64_of_the_texts_is_the_chain(robot):
    q, scale = np.random.default_rng(4).uniform(-np.pi, np.pi, (2000, 6)), 256.0 * MAKER[robot][1]
    pose = chain(robot, q)
    values = _values(robot, pose, scale)
    turns = {f"{letter}{i}": turn(q[:, i - 1]) for i in range(1, 7) for letter, turn in (("c", np.cos), ("n", np.sin))}
    program = parser.load(ur.FORWARD)
    found = meaning.real(program, {name: (values | turns)[name] for name in program.inputs}).words
    assert max(np.abs(found[f"r{axis}"] - values[f"r{axis}"]).max() for axis in AXES) < 1e-12
    assert max(np.abs(found[axis] - values[axis]).max() for axis in "xyz") < 1e-12
    every = meaning.real(parser.load(ur.ALL), values)
    best = np.full(len(q), 9.0)
    for branch in range(8):
        one = meaning.real(parser.load(ur.INVERSE), values, branch)
        angles = np.stack([np.arctan2(one.words[f"n{i}"], one.words[f"c{i}"]) for i in range(1, 7)], axis=-1)
        good = ~one.far
        assert good.sum() > 1400 and not one.wrong.any()
        again = chain(robot, angles[good])
        assert np.abs(again[:, :3, 3] - pose[good, :3, 3]).max() < 1e-5 * scale
        assert np.abs(again[:, :3, :3] - pose[good, :3, :3]).max() < 1e-6
        best = np.minimum(best, np.where(good, np.abs(np.exp(1j * angles) - np.exp(1j * q)).max(axis=1), 9))
        s, t, w = "fb"[branch & 1], "ud"[branch >> 1 & 1], "pm"[branch >> 2]
        assert np.abs(every.words[f"c4{t}{w}{s}"] - one.words["c4"])[good].max() < 1e-9
        assert np.array_equal(every.beyond[f"c3{w}{s}"] | every.beyond["q"], one.far)
    assert best.max() < 1e-6


def test_a_slip_in_a_text_is_seen_by_the_chain(monkeypatch):
    """The same slip in model and core, which both are the text."""
    text = ur.INVERSE.read_text()
    for old, new in (("u = -d5*mf - x1", "u = d5*mf - x1"), ("n4 = nh*c2 - ch*n2", "n4 = nh*c2 + ch*n2"),
                     ("px = x - d6*r13", "px = x - d5*r13"), ("c5 = n1*r13 - c1*r23", "c5 = n1*r13 + c1*r23")):
        assert old in text
        slipped = parser.parse(text.replace(old, new), ur.INVERSE)
        monkeypatch.setattr(importlib.import_module("quadrance.program.parser"), "load", lambda path, one=slipped: one)
        q = np.random.default_rng(5).uniform(-np.pi, np.pi, (200, 6))
        pose = chain("ur5e", q)
        words = meaning.real(parser.load(ur.INVERSE), _values("ur5e", pose, 2560.0)).words
        angles = np.stack([np.arctan2(words[f"n{i}"], words[f"c{i}"]) for i in range(1, 7)], axis=-1)
        assert np.median(np.abs(chain("ur5e", angles) - pose).max(axis=(1, 2))) > 0.01, new
        monkeypatch.undo()


# Bit-true models


@ROBOTS
@cores(FORWARD)
def test_forward(core, robot):
    p, arm = core.params, _arm(core, robot)
    q = np.random.default_rng(2).uniform(-np.pi, np.pi, (5000, 6))
    words = {f"in_{letter}{i}": np.rint(turn(q[:, i - 1]) * 2.0 ** p["U"]).astype(int) for i in range(1, 7)
             for letter, turn in (("c", np.cos), ("n", np.sin))}
    answer = core.model(p, **words, **_config(core, robot))
    q = np.stack([np.arctan2(words[f"in_n{i}"], words[f"in_c{i}"]) for i in range(1, 7)], axis=-1)
    pose = chain(robot, q)
    tip = pose[:, :3, 3] / _unit(core, robot) * 2.0 ** p["F"]
    ok = answer["out_status"] == 0
    assert np.array_equal(ok, np.all(np.abs(tip + 0.5) < 1 << p["W"] - 1, axis=1)) and ok.mean() > 0.9
    off = np.abs(np.stack([answer[f"out_{axis}"] for axis in "xyz"], axis=-1) - tip)[ok]
    assert 0.3 * bounds.forward_coordinate(p, arm) < off.max() <= bounds.forward_coordinate(p, arm)
    matrix = np.stack([answer[f"out_r{axis}"] for axis in AXES], axis=-1)
    off = np.abs(matrix - pose[:, :3, :3].reshape(-1, 9) * 2.0 ** p["U"])
    assert 0.2 * bounds.forward_matrix(p) < off.max() <= bounds.forward_matrix(p)


# Of a UR5e at Q7.8, 10 mm a unit: tip in mm, orientation in degrees, anywhere and next to singularities
ASKED = (0.02, 0.0025), (0.025, 0.01)


@ROBOTS
@cores(INVERSE + ALL)
def test_inverse(core, robot):
    """Every branch within its laws against the maker's table; where a robot has what was asked for, within that."""
    p, arm = core.params, _arm(core, robot)
    q = _joints(2500, 3)
    words, rotation, tip, _ = _words(core, robot, chain(robot, q))
    cfg, seen = _config(core, robot), []
    every = core.model(p, **words, **cfg) if core in ALL else None
    for branch in range(8):
        if every is None:
            answer = core.model(p, **words, **cfg, in_branch=np.int64(branch))
            joints, far, held = _angles(answer), answer["out_status"] & 1 > 0, answer["out_status"] & 2 > 0
            assert not np.any(answer["out_status"] & 12)
        else:
            joints, far, held = _angles(every, str(branch)), *(every[name] >> branch & 1 > 0 for name in
                                                               ("out_far", "out_held"))
        exact, out = truth_ur.ik(rotation, tip, arm, branch)
        ok = ~far & ~out
        place, turn = _off(core, robot, joints, rotation, tip)
        law, limit = bounds.position(p, arm, rotation, tip, exact), bounds.orientation(p, held)
        law = law + held * 8 * np.sqrt(2) * 2.0 ** -p["U"] * (abs(arm.d5) + abs(arm.d6))
        assert ok.mean() > 0.7 and np.all(place[ok] <= law[ok]) and np.all(turn[ok] <= limit[ok])
        assert np.any(place[ok] > 0.1 * law[ok]) and np.any(turn[ok] > 0.25 * limit[ok])
        x, y, _ = np.moveaxis(tip - arm.d6 * rotation[..., 2], -1, 0)
        size = np.sqrt(np.maximum(arm.l2**2 + arm.l3**2 + 2 * arm.l2 * arm.l3 * np.cos(exact[:, 2]), 0))
        rims = np.hypot(x, y) - abs(arm.d4), size - arm.l2 - arm.l3, size - abs(arm.l2 - arm.l3)
        edge = np.min(np.abs(rims), axis=0)
        clear = (edge > 2) & (np.abs(np.sin(exact[:, 4])) > 0.02)  # joint 6 moves axis 4
        assert not np.any((far != out) & clear), "rounding decides within two LSB alone"
        close = np.minimum(np.abs(np.sin(exact[:, 2])), np.abs(np.sin(exact[:, 4]))) < 2 * SMALL
        seen.append((place[ok] * _unit(core, robot) * 2.0 ** -p["F"], np.degrees(turn[ok]), close[ok]))
    place, turn, close = map(np.concatenate, zip(*seen))
    if robot == "ur5e" and p["W"] == p["U"] == 16:
        for part, (mm, degrees) in zip((~close, close), ASKED):
            assert place[part].max() <= mm and turn[part].max() <= degrees


@ROBOTS
def test_every_answer_of_eaik_is_found(robot):
    """Ten thousand poses. A joint is off by the rounding of the pose's words, over how far a singularity is: sines of
    joints 3 and 5, and axis 4 beside axis 1. A branch left out or answered twice would be off by radians.
    """
    eaik = pytest.importorskip("eaik.IK_DH")
    core, (d1, a2, a3, d4, d5, d6) = find("vector_ur_ik_all-U16"), MAKER[robot][0]
    other = eaik.DhRobot(np.radians([90, 0, 0, 90, -90, 0]), np.array([0, a2, a3, 0, 0, 0]),
                         np.array([d1, 0, 0, d4, d5, d6]))
    pose = chain(robot, np.random.default_rng(11).uniform(-np.pi, np.pi, (10_000, 6)))
    words, _, _, held = _words(core, robot, pose)
    answer = core.model(core.params, **words, **_config(core, robot))
    mine = np.exp(1j * np.stack([_angles(answer, str(branch)) for branch in range(8)], axis=1))
    found = 0
    for ours, one, solved in zip(mine, pose[held], other.IK_batched(pose[held], 1)):
        joints = np.array([q for q, approximate in zip(solved.Q, solved.is_LS) if not approximate]).reshape(-1, 6)
        x, y = one[:2, 3] - d6 * one[:2, 2]
        near = np.sqrt(max(x * x + y * y - d4 * d4, 0)) / -(a2 + a3) * np.abs(np.prod(np.sin(joints[:, 2::2]), axis=1))
        off = np.abs(ours - np.exp(1j * joints)[:, None]).max(axis=-1).min(axis=-1)
        assert np.all(off * near <= 2 * (_unit(core, robot) / 256 / -a3 + 2.0**-16))
        found += len(joints)
    assert found > 6 * len(mine) > 50_000


@cores(INVERSE + ALL)
def test_margin_and_slack(core):
    """Bit 1 within the margin of each singularity and not beyond; stretched poses within the slack are not refused."""
    p, robot, arm = core.params, "ur5e", _arm(core, "ur5e")
    rng, n = np.random.default_rng(6), 2000
    q = rng.uniform(-np.pi, np.pi, (n, 6))
    for part, joint in ((slice(0, None, 3), 2), (slice(1, None, 3), 4)):
        q[part, joint] = rng.uniform(-0.3, 0.3, len(q[part]))
    words, rotation, tip, _ = _words(core, robot, chain(robot, q))
    margin = round(0.1 * arm.l3)
    told = {}
    for size in (0, margin):
        answer = core.model(p, **words, **({"in_branch": np.int64(0)} if core in INVERSE else {}),
                            **_config(core, robot, margin=size))
        told[size] = (answer["out_held"] & 1 if core in ALL else answer["out_status"] >> 1 & 1) > 0
        far = (answer["out_far"] & 1 if core in ALL else answer["out_status"] & 1) > 0
    joints, out = truth_ur.ik(rotation, tip, arm, 0)
    x, y, _ = np.moveaxis(tip - arm.d6 * rotation[..., 2], -1, 0)
    nearest = np.min([np.sqrt(np.maximum(x * x + y * y - arm.d4**2, 0)), arm.l3 * np.abs(np.sin(joints[:, 2])),
                      arm.l3 * np.abs(np.sin(joints[:, 4]))], axis=0)
    slip, ok = 0.02 * margin + 3, ~far & ~out
    assert told[0][ok].mean() < 0.01
    assert told[margin][ok & (nearest < margin - slip)].all() and not told[margin][ok & (nearest > margin + slip)].any()
    assert min((ok & (nearest < margin - slip)).sum(), (ok & (nearest > margin + slip)).sum()) > 200
    # the arm stretched, its tip rounded to words, and up to 12 LSB farther out along the forearm
    q[:, 2], q[:, 4] = 0, rng.uniform(0.3, 2.8, n) * rng.choice([-1, 1], n)
    pose, away = chain(robot, q), rng.uniform(0, 12, n)
    lsb = _unit(core, robot) * 2.0 ** -p["F"]
    angle = q[:, 1] + q[:, 2]
    along = np.stack([-np.cos(angle) * np.cos(q[:, 0]), -np.cos(angle) * np.sin(q[:, 0]), -np.sin(angle)], axis=-1)
    pose[:, :3, 3] += along * (away * lsb)[:, None]
    words, rotation, tip, held = _words(core, robot, pose)
    exact = [truth_ur.ik(rotation, tip, arm, one)[0] for one in range(8)]
    mine = np.argmin([np.abs(np.exp(1j * one) - np.exp(1j * q[held])).max(axis=1) for one in exact], axis=0)
    x, y, _ = np.moveaxis(tip - arm.d6 * rotation[..., 2], -1, 0)
    fine, away = np.hypot(x, y) > abs(arm.d4) + 0.01 * arm.l2, away[held]  # axis 1 is not near
    assert fine.mean() > 0.8
    for slack in (0, 6):
        answer = core.model(p, **words, **({"in_branch": mine} if core in INVERSE else {}),
                            **_config(core, robot, slack=slack))
        far = (answer["out_far"] >> mine if core in ALL else answer["out_status"]) & 1 > 0
        assert not far[fine & (away < slack - 2)].any() and far[fine & (away > slack + 2)].all()
        c3 = np.stack([answer[f"out_c3{one}"] for one in range(8)])[mine, np.arange(len(mine))] if core in ALL \
            else answer["out_c3"]
        assert np.all(c3[fine & (away > 3)] == 1 << p["U"])


@cores(INVERSE)
def test_unreachable_answers_the_nearest_point(core):
    """Beyond the arm it is stretched on the line to axis 4, the matrix kept; the hole about axis 1 is left at d4."""
    p, robot, arm = core.params, "ur5e", _arm(core, "ur5e")
    rng, n = np.random.default_rng(7), 2000
    pose = chain(robot, rng.uniform(-np.pi, np.pi, (n, 6)))
    pose[:, :3, 3] = rng.uniform(-1, 1, (n, 3)) * 0.99 * _unit(core, robot) * 2.0 ** (p["W"] - 1 - p["F"])
    pose[::4, :2, 3] = (pose[:, :2, 2] * MAKER[robot][0][5] + rng.uniform(-0.6, 0.6, (n, 2)) * MAKER[robot][0][3])[::4]
    words, rotation, tip, _ = _words(core, robot, pose)
    answer = core.model(p, **words, in_branch=np.int64(0), **_config(core, robot))
    exact, out = truth_ur.ik(rotation, tip, arm, 0)
    joints, x = _angles(answer), tip - arm.d6 * rotation[..., 2]
    rho = np.hypot(x[:, 0], x[:, 1])
    clear = np.abs(rho - arm.d4) > 3
    want = truth_ur.fk(exact, arm)[1]  # the truth answers the nearest too
    place, turn = _off(core, robot, joints, rotation, want)
    told = answer["out_status"] & 1 > 0
    assert told[out].mean() > 0.99 and (out & (rho < arm.d4)).sum() > 50 and (out & (rho > arm.d4)).sum() > 500
    assert np.all(turn[answer["out_status"] & 2 == 0] <= bounds.orientation(p)) and np.all(place[out & clear] < 4)


@cores(INVERSE)
def test_joint_6_is_held_where_joint_5_is_straight(core):
    """A regular pose, then straight ones: joint 6 holds its word, joints 2 to 4 take the rest, the pose is right."""
    p, robot = core.params, "ur5e"
    q = np.random.default_rng(8).uniform(0.5, 1.2, (2000, 6))
    q[:, 4] = 0
    q[::20, 4] = 1
    words, rotation, tip, held = _words(core, robot, chain(robot, q))
    answer = core.model(p, **words, in_branch=np.int64(0), **_config(core, robot))
    straight, bent = answer["out_status"] & 2 > 0, np.arange(2000)[held] % 20 == 0
    assert not straight[bent].any() and straight[~bent].sum() > 15  # most are as bent as the tip's rounding makes them
    for letter in "cn":
        word = answer[f"out_{letter}6"]
        assert np.array_equal(word[1:][straight[1:]], word[:-1][straight[1:]])
    far = answer["out_status"] & 1 > 0
    assert _off(core, robot, _angles(answer), rotation, tip)[1][~far].max() <= bounds.orientation(p, True)
    at = np.flatnonzero(straight)[0]
    first = core.model(p, **{name: word[at:at + 1] for name, word in words.items()}, in_branch=np.int64(0),
                       **_config(core, robot))
    assert (first["out_c6"][0], first["out_n6"][0]) == (1 << p["U"], 0)


@cores(INVERSE + ALL)
def test_no_rotation_is_told(core):
    """A word 48 units off, a mirror image, none; rounded rotations are not told."""
    p, cfg = core.params, _config(core, "ur5e")
    words, *_ = _words(core, "ur5e", chain("ur5e", np.random.default_rng(9).uniform(-np.pi, np.pi, (300, 6))))

    def told(change: dict) -> np.ndarray:
        branch = {"in_branch": np.int64(0)} if core in INVERSE else {}
        return core.model(p, **(words | change), **branch, **cfg)["out_status"] & 8 > 0

    assert not told({}).any()
    assert all(told({f"in_r{axis}": words[f"in_r{axis}"] + 48}).all() for axis in AXES)
    assert told({f"in_r{axis}": -words[f"in_r{axis}"] for axis in AXES}).all()
    assert told({f"in_r{axis}": 0 * words[f"in_r{axis}"] for axis in AXES}).all()


@pytest.mark.parametrize("name", ["vector_ur_fk", "table_ur_fk", "vector_ur_ik", "table_ur_ik", "vector_ur_ik_all"])
def test_the_errors_that_a_user_reads(name):
    """`quadrance accuracy` on an arm: the rounding of the words, and no more than 0.03 mm beside it."""
    arm = arms.load("ur5e")
    worst = pose.worst(find(name), arm, 3000)
    rounded = 0.5 * math.sqrt(3) * arm.mm_per_unit * 2.0 ** -find(name).params["F"]
    assert 0.5 * rounded < worst.mm < rounded + 0.03 and 1e-3 < worst.degrees < 0.02
    assert worst.beside_mm is None if "fk" in name else worst.beside_mm < rounded + 0.03


# A calibrated robot


def _calibrated(robot: str, rng: np.random.Generator) -> list[tuple[float, float, float, float]]:
    """A table off the maker's by up to 0.5 mm, 0.05 degrees and 0.1 degrees of a zero: rows of a, d, alpha, zero."""
    d1, a2, a3, d4, d5, d6 = MAKER[robot][0]
    rows = ((0, d1, 90), (a2, 0, 0), (a3, 0, 0), (0, d4, 90), (0, d5, -90), (0, d6, 0))
    off = rng.uniform(-1, 1, (6, 4)) * (0.5, 0.5, np.radians(0.05), np.radians(0.1))
    off[5, [0, 2]] = 0
    return [(a + i[0], d + i[1], np.radians(alpha) + i[2], i[3]) for (a, d, alpha), i in zip(rows, off)]


def _by_table(rows, q: np.ndarray) -> np.ndarray:
    """(N, 4, 4), mm: `chain` by a table of its own."""
    found = np.eye(4)
    for i, (a, d, alpha, zero) in enumerate(rows):
        for turn, axes in ((q[:, i] + zero, (0, 1)), (np.full(len(q), alpha), (1, 2))):
            step = np.broadcast_to(np.eye(4), (len(q), 4, 4)).copy()
            for (m, n), value in zip(((0, 0), (0, 1), (1, 0), (1, 1)), (np.cos, lambda t: -np.sin(t), np.sin, np.cos)):
                step[:, axes[m], axes[n]] = value(turn)
            if axes == (0, 1):
                step[:, :3, 3] = 0, 0, d
            else:
                step[:, :3, 3] = a, 0, 0
            found = found @ step
    return found


def test_polish_is_an_image_for_the_kinematics_engine():
    """Every word within its range, every line accepted by the checker, and the inputs fit a context."""
    made = image.image(assembler.assembled(POLISH, 1))
    assert len(made["inputs"]) <= 64 and made["program"] == "polish", made.keys()


@ROBOTS
def test_a_calibrated_robot_is_polished(robot):
    """docs/polish.kin is the pose by the robot's own table; a target moved once leaves little beside the rounding."""
    core, rng = INVERSE[0], np.random.default_rng(11)
    p, unit = core.params, _unit(core, robot)
    lsb = unit * 2.0 ** -p["F"]
    rows, target = _calibrated(robot, rng), chain(robot, rng.uniform(-np.pi, np.pi, (4000, 6)))
    target = target[np.abs(target[:, :3, 3]).max(axis=1) < 127 * unit]
    branch = rng.integers(0, 8, len(target))
    arm = _config(core, robot, margin=MARGIN / lsb)

    def solved(pose: np.ndarray) -> dict[str, np.ndarray]:
        return ur.ik(p, **_words(core, robot, pose)[0], **arm, in_branch=branch)

    def off(answer: dict[str, np.ndarray]) -> tuple[float, float]:
        """Of what the robot does from the targets, at worst: mm and degrees."""
        pose = _by_table(rows, _angles(answer))
        return (np.linalg.norm(pose[:, :3, 3] - target[:, :3, 3], axis=1).max(),
                np.degrees(truth_six.turned(pose[:, :3, :3], target[:, :3, :3]).max()))

    plain = solved(target)["out_status"] == 0
    target, branch = target[plain], branch[plain]
    answer = solved(target)
    table = {}
    for i, (a, d, alpha, zero) in enumerate(rows, 1):
        words = {"k": np.cos(zero), "m": np.sin(zero), "g": np.cos(alpha), "h": np.sin(alpha)}
        table |= {f"cfg_{name}{i}": np.rint(value * 2.0**25).astype(int) for name, value in words.items()}
        table |= {f"cfg_{name}{i}": np.rint(16 * value / lsb).astype(int) for name, value in (("a", a), ("d", d))}
    program = parser.load(POLISH)
    ports = table | {f"in_{name[4:]}": word for name, word in answer.items()}
    known = {name: word for name, word in ports.items() if name.split("_")[1] in program.inputs}
    fixed = meaning.fixed(program, p, **known).words
    turned = np.stack([fixed[f"r{axis}"] for axis in AXES], axis=-1).reshape(-1, 3, 3) * 2.0**-25
    tip = np.stack([fixed[axis] for axis in "xyz"], axis=-1) * 2.0 ** (p["W"] - 25) * lsb
    pose = _by_table(rows, _angles(answer))
    assert np.abs(turned - pose[:, :3, :3]).max() < 12 * 2.0**-16 and np.abs(tip - pose[:, :3, 3]).max() < 0.7 * lsb
    moved = target.copy()
    moved[:, :3, :3] += target[:, :3, :3] - turned
    moved[:, :3, 3] += target[:, :3, 3] - tip
    (mm, degrees), (left, turned) = off(answer), off(solved(moved))
    assert len(target) > 2000 and mm > 2 and degrees > 0.2 and left < 0.007 * unit and turned < 0.006
