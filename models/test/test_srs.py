"""Seven axes: truth and text against a chain of matrices, the bit-true model against chain and bounds."""

from __future__ import annotations

import numpy as np
import pytest
from quadrance import srs, truth_six, truth_srs
from quadrance.bounds import srs as bounds
from quadrance.cores import all_cores
from quadrance.program import meaning, parser
from quadrance.six import AXES
from quadrance.truth_srs import Srs

INVERSE = pytest.mark.parametrize("core", [core for core in all_cores() if core.function == "srs_ik"
                                           and not core.params["PIPE"]], ids=lambda core: core.id)
# KUKA LBR iiwa 7 R800 and 14 R820: base to shoulder, to elbow, to wrist, to flange, mm
MAKER = {"iiwa7": (340, 400, 400, 126), "iiwa14": (360, 420, 400, 126)}
ROBOTS = pytest.mark.parametrize("robot", MAKER)


def chain(robot: str, q: np.ndarray) -> np.ndarray:
    """(N, 7, 4, 4), mm: a product of Denavit-Hartenberg matrices, and nothing of the library."""
    d, l1, l2, l4 = MAKER[robot]
    frame, found = np.eye(4), []
    for i, (along, alpha) in enumerate(((d, -90), (0, 90), (l1, 90), (0, -90), (l2, -90), (0, 90), (l4, 0))):
        c, s, zero = np.cos(q[:, i]), np.sin(q[:, i]), np.zeros(len(q))
        cos, sin = np.cos(np.radians(alpha)), np.sin(np.radians(alpha))
        rows = ((c, -s * cos, s * sin, zero), (s, c * cos, -c * sin, zero),
                (zero, zero + sin, zero + cos, zero + along), (zero, zero, zero, zero + 1))
        frame = frame @ np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
        found.append(frame)
    return np.stack(found, axis=1)


def _unit(core) -> float:
    """Millimetres in a coordinate unit: 10 at Q7.8, else as large as the word."""
    return 10 * 2.0 ** (8 - core.params["W"] + core.params["F"])


def _arm(core, robot: str) -> Srs:
    """The arm in LSB."""
    return Srs(*(length / _unit(core) * 2.0 ** core.params["F"] for length in MAKER[robot]))


def _config(core, robot: str, **more: float) -> dict[str, int]:
    """Configuration words; margin and slack in LSB."""
    lsb = 2.0 ** -core.params["F"]
    return srs.config(core.params, **{name: length * lsb for name, length in _arm(core, robot)._asdict().items()},
                      **{name: value * lsb for name, value in more.items()})


def _words(core, pose: np.ndarray, turn: np.ndarray) -> tuple[dict, np.ndarray, np.ndarray, np.ndarray]:
    """Port words of poses (mm) and swivels that a word holds; matrix and tip (LSB) that they say; which those are."""
    p = core.params
    tip = np.rint(pose[:, :3, 3] / _unit(core) * 2.0 ** p["F"]).astype(int)
    held = np.all(np.abs(tip) < 1 << p["W"] - 1, axis=1)
    matrix, tip = np.rint(pose[held, :3, :3] * 2.0 ** p["U"]).astype(int), tip[held]
    words = {f"in_r{axis}": matrix[:, i // 3, i % 3] for i, axis in enumerate(AXES)}
    words |= {f"in_{axis}": tip[:, i] for i, axis in enumerate("xyz")}
    words |= {name: np.rint(of(turn[held]) * 2.0 ** p["U"]).astype(int) for name, of in (("in_cs", np.cos),
                                                                                       ("in_ns", np.sin))}
    return words, matrix * 2.0 ** -p["U"], tip.astype(float), held


def _off(core, robot: str, q: np.ndarray, rotation: np.ndarray, tip: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Distance (LSB) and angle of the pose of joints, by the chain, from a matrix and a tip."""
    pose = chain(robot, q)[:, -1]
    place = pose[:, :3, 3] / _unit(core) * 2.0 ** core.params["F"]
    return np.linalg.norm(place - tip, axis=-1), truth_six.turned(pose[:, :3, :3], rotation)


def _angles(words: dict, prefix: str = "") -> np.ndarray:
    return np.stack([np.arctan2(words[f"{prefix}n{i}"], words[f"{prefix}c{i}"]) for i in range(1, 8)], axis=-1)


def _real(robot: str, pose: np.ndarray, turn: np.ndarray, branch: int, text=None) -> meaning.Outcome:
    """The text in float64; 1.0 of a length is 2560 mm."""
    d, l1, l2, l4 = (length / 2560 for length in MAKER[robot])
    values = {f"r{axis}": pose[:, i // 3, i % 3] for i, axis in enumerate(AXES)}
    values |= {axis: pose[:, i, 3] / 2560 for i, axis in enumerate("xyz")}
    values |= {"d": d, "l1": l1, "l2": l2, "l4": l4, "m": 0.0, "slack": 1e-9, "cs": np.cos(turn), "ns": np.sin(turn),
               "r": 1 / (2 * l1 * l2) / 256, "e": 256.0}
    return meaning.real(text or parser.load(srs.INVERSE), values, branch)


@ROBOTS
def test_float64_of_the_text_is_the_chain(robot):
    """All branches give the pose, with the signs and the swivel asked for; the joints that made it are among them."""
    q = np.random.default_rng(4).uniform(-np.pi, np.pi, (1000, 7))
    pose, turn, nearest = chain(robot, q)[:, -1], truth_srs.swivel(q, Srs(*MAKER[robot])), np.full(len(q), 9.0)
    rotation, tip = truth_srs.fk(q, Srs(*MAKER[robot]))
    assert np.abs(rotation - pose[:, :3, :3]).max() < 1e-12 and np.abs(tip - pose[:, :3, 3]).max() < 1e-9
    for branch in range(8):
        one = _real(robot, pose, turn, branch)
        joints = _angles(one.words)
        assert not one.status.any() and np.abs(chain(robot, joints)[:, -1] - pose).max() < 1e-8
        for bit, joint in enumerate((1, 3, 5)):
            assert np.all(np.sin(joints[:, joint]) * (1 - 2 * (branch >> bit & 1)) > 0)
        # of a swivel, without the truth's: at 0 and sin q4 < 0 the elbow is highest among all
        assert np.abs(np.exp(1j * truth_srs.swivel(joints, Srs(*MAKER[robot]))) - np.exp(1j * turn)).max() < 1e-6
        nearest = np.minimum(nearest, np.abs(np.exp(1j * joints) - np.exp(1j * q)).max(axis=1))
    assert nearest.max() < 1e-6
    heights = [chain(robot, _angles(_real(robot, pose, 0 * turn + at, 2).words))[:, 2, 2, 3] for at in
               np.radians((0, 60, 120, 180, 240, 300))]
    assert np.all(np.argmax(heights, axis=0) == 0) and np.all(np.argmin(heights, axis=0) == 3)


def test_a_slip_in_the_text_is_seen_by_the_chain():
    text = srs.INVERSE.read_text()
    q = np.random.default_rng(5).uniform(-np.pi, np.pi, (200, 7))
    pose, turn = chain("iiwa14", q)[:, -1], np.random.default_rng(6).uniform(-np.pi, np.pi, 200)
    for old, new in (("g2 = ne*ns", "g2 = -ne*ns"), ("c3 = cs*ct + yr*nt", "c3 = cs*ct - yr*nt"),
                     ("px = x - l4*r13", "px = x - l2*r13"), ("t3 = -n4*n5", "t3 = n4*n5")):
        assert old in text
        words = _real("iiwa14", pose, turn, 0, parser.parse(text.replace(old, new), srs.INVERSE)).words
        assert np.median(np.abs(chain("iiwa14", _angles(words))[:, -1] - pose).max(axis=(1, 2))) > 0.01, new


ASKED = 0.03  # mm, of both robots at Q7.8, 10 mm a unit


@ROBOTS
@INVERSE
def test_inverse(core, robot):
    """Every branch within its laws against the chain and, at Q7.8, within what was asked for."""
    p, arm, rng = core.params, _arm(core, robot), np.random.default_rng(3)
    q, turn = rng.uniform(-np.pi, np.pi, (600, 7)), rng.uniform(-np.pi, np.pi, 600)
    for first, joint in enumerate((1, 3, 5)):
        q[first::6, joint] = 10 ** rng.uniform(-5, -1, 100) + np.pi * rng.integers(0, 2, 100)
    words, rotation, tip, _ = _words(core, chain(robot, q)[:, -1], turn)
    centre = tip - arm.l4 * rotation[..., 2] - (0, 0, arm.d)
    clear_of_the_shoulder = np.linalg.norm(centre, axis=1) > bounds.folded(p)
    for branch in range(8):
        answer = core.model(p, **words, **_config(core, robot), in_branch=np.int64(branch))
        assert not np.any(answer["out_status"] & 12)
        held = answer["out_status"] & 2 > 0
        joints, ok = _angles(answer, "out_"), (answer["out_status"] & 1 == 0) & clear_of_the_shoulder
        place, turned = _off(core, robot, joints, rotation, tip)
        law, limit = bounds.position(p, arm, rotation, tip, held), bounds.orientation(p, held)
        assert ok.mean() > 0.9 and np.all(place[ok] <= law[ok]) and np.all(turned[ok] <= limit[ok])
        assert np.any(place[ok] > 0.07 * law[ok]) and np.any(turned[ok] > 0.07 * limit[ok])
        clear = ok & ~held & (np.abs(np.sin(joints[:, [1, 3, 5]])).min(axis=1) > 1e-3)
        for bit, joint in enumerate((1, 3, 5)):
            assert np.all(np.sin(joints[clear, joint]) * (1 - 2 * (branch >> bit & 1)) > 0)
        if p["W"] == p["U"] == 16:
            assert place[ok & ~held].max() * _unit(core) * 2.0 ** -p["F"] <= ASKED


@INVERSE
def test_margin_and_slack(core):
    """Bit 1 within the margin of each singularity and not beyond; stretched poses within the slack are not refused."""
    p, robot, arm = core.params, "iiwa14", _arm(core, "iiwa14")
    rng, n = np.random.default_rng(6), 1500
    q, turn = rng.uniform(-np.pi, np.pi, (n, 7)), rng.uniform(-np.pi, np.pi, n)
    for part, joint in ((slice(0, None, 3), 3), (slice(1, None, 3), 5)):
        q[part, joint] = rng.uniform(-0.3, 0.3, len(q[part]))
    pose = chain(robot, q)[:, -1]
    words, rotation, tip, held = _words(core, pose, turn)
    margin, told = round(0.1 * arm.l2), {}
    for size in (0, margin):
        answer = core.model(p, **words, in_branch=np.int64(0), **_config(core, robot, margin=size))
        told[size] = answer["out_status"] & 2 > 0
    x, y, z = np.moveaxis(tip - arm.l4 * rotation[..., 2], -1, 0)
    c4 = (x * x + y * y + (z - arm.d) ** 2 - arm.l1**2 - arm.l2**2) / (2 * arm.l1 * arm.l2)
    nearest = np.min([np.hypot(x, y), arm.l2 * np.sqrt(np.maximum(1 - c4 * c4, 0)),
                      arm.l2 * np.abs(np.sin(_angles(answer, "out_")[:, 5]))], axis=0)
    slip, ok = 0.02 * margin + 3, answer["out_status"] & 1 == 0
    assert told[0][ok].mean() < 0.01
    assert told[margin][ok & (nearest < margin - slip)].all() and not told[margin][ok & (nearest > margin + slip)].any()
    assert min((ok & (nearest < margin - slip)).sum(), (ok & (nearest > margin + slip)).sum()) > 200
    # the arm stretched, its tip rounded to words, and up to 12 LSB farther out along the arm
    q[:, 3] = 0
    frames, away = chain(robot, q), rng.uniform(0, 12, n)
    pose = frames[:, -1].copy()
    pose[:, :3, 3] += frames[:, 2, :3, 1] * (away * _unit(core) * 2.0 ** -p["F"])[:, None]  # y is along the upper arm
    words, _, _, held = _words(core, pose, turn)
    away = away[held]
    for slack in (0, 6):
        answer = core.model(p, **words, in_branch=np.int64(0), **_config(core, robot, slack=slack))
        far = answer["out_status"] & 1 > 0
        assert not far[away < slack - 2].any() and far[away > slack + 2].all()
        assert np.all(answer["out_c4"][away > 3] == 1 << p["U"])


@INVERSE
def test_unreachable_answers_the_nearest_point(core):
    """Beyond the arm it is stretched on the line to the wrist's centre, too near it is folded; the matrix is kept."""
    p, robot, arm = core.params, "iiwa14", _arm(core, "iiwa14")
    rng, n = np.random.default_rng(7), 1000
    pose = chain(robot, rng.uniform(-np.pi, np.pi, (n, 7)))[:, -1]
    pose[:, :3, 3] = rng.uniform(-1, 1, (n, 3)) * 0.99 * _unit(core) * 2.0 ** (p["W"] - 1 - p["F"])
    near = pose[::4, :3, 2] * MAKER[robot][3] + (0, 0, MAKER[robot][0])
    pose[::4, :3, 3] = near + rng.uniform(-11, 11, near.shape)  # folded, its wrist is 20 mm from the shoulder
    words, rotation, tip, _ = _words(core, pose, rng.uniform(-np.pi, np.pi, n))
    answer = core.model(p, **words, in_branch=np.int64(0), **_config(core, robot))
    centre = tip - arm.l4 * rotation[..., 2] - (0, 0, arm.d)
    r = np.linalg.norm(centre, axis=1)
    low, high = abs(arm.l1 - arm.l2), arm.l1 + arm.l2
    out, told = (r > high + 2) | (r < low - 2), answer["out_status"] & 1 > 0
    assert told[out].all() and not told[(r < high - 2) & (r > low + 2)].any()
    assert (out & (r < low)).sum() > 50 and (out & (r > high)).sum() > 200
    want = tip + centre * (np.clip(r, low, high) / np.maximum(r, 1e-9) - 1)[:, None]
    place, turned = _off(core, robot, _angles(answer, "out_"), rotation, want)
    clear = out & (r > 3) & (np.hypot(centre[:, 0], centre[:, 1]) > 1)
    assert np.all(turned[clear & (answer["out_status"] & 2 == 0)] <= bounds.orientation(p)) and np.all(place[clear] < 4)


@INVERSE
def test_directions_are_held(core):
    """Regular poses, and ones without a direction between them: the wrist straight, the wrist's centre on axis 1."""
    p, robot, one = core.params, "iiwa14", 1 << core.params["U"]
    rng = np.random.default_rng(8)
    q = rng.uniform(0.5, 1.2, (400, 7))
    words, rotation, tip, _ = _words(core, chain(robot, q)[:, -1], rng.uniform(0.3, 1, 400))
    cfg = _config(core, robot)
    height = (cfg["cfg_d"] + cfg["cfg_l4"] >> 4) + (cfg["cfg_l1"] >> 4)
    top = {"in_r11": one, "in_r22": one, "in_r33": one, "in_z": height}  # above the shoulder, the flange along axis 1
    for name, word in words.items():
        if name[3] in "rxyz":
            word[1::2] = top.get(name, 0)
    answer = core.model(p, **words, in_branch=np.int64(0), **cfg)
    assert np.all(answer["out_status"][1::2] == 2) and not answer["out_status"][::2].any()
    rotation[1::2], tip[1::2] = np.eye(3), (0, 0, height)
    place, turned = _off(core, robot, _angles(answer, "out_"), rotation, tip)
    assert turned.max() <= bounds.orientation(p, True)
    assert np.all(place <= bounds.position(p, _arm(core, robot), rotation, tip, True))
    alone = core.model(p, **{name: word[1:2] for name, word in words.items()}, in_branch=np.int64(0), **cfg)
    # the azimuth was never known and is taken for 0
    assert alone["out_status"] == 2 and any(alone[f"out_c{i}"] != answer[f"out_c{i}"][1] for i in (1, 2, 3))


@INVERSE
def test_no_rotation_is_told(core):
    """A word 48 units off, a mirror image, none, a swivel that is no unit vector; rounded ones are not told."""
    p, cfg, rng = core.params, _config(core, "iiwa14"), np.random.default_rng(9)
    words, *_ = _words(core, chain("iiwa14", rng.uniform(-np.pi, np.pi, (300, 7)))[:, -1],
                       rng.uniform(-np.pi, np.pi, 300))

    def told(change: dict) -> np.ndarray:
        return core.model(p, **(words | change), in_branch=np.int64(0), **cfg)["out_status"] & 8 > 0

    assert not told({}).any()
    assert all(told({f"in_r{axis}": words[f"in_r{axis}"] + 48}).all() for axis in AXES)
    assert told({f"in_r{axis}": -words[f"in_r{axis}"] for axis in AXES}).all()
    assert told({f"in_r{axis}": 0 * words[f"in_r{axis}"] for axis in AXES}).all()
    assert told({"in_cs": words["in_cs"] // 2, "in_ns": words["in_ns"] // 2}).all()
