"""What else the product engine plays: seven axes, machine tools, and programs that are loaded while it runs."""

from __future__ import annotations

import json
from functools import cache

import numpy as np
import pytest
from quadrance import srs, tool, truth_six, truth_srs
from quadrance.bounds import srs as srs_bounds
from quadrance.bounds import tool as tool_bounds
from quadrance.cores import ROOT, RTL
from quadrance.fixed import wrap
from quadrance.kinematics_engine import ENDS, INFO, LINE, READ, RUN, SEAL, WRITE, crc16, kinematics_engine
from quadrance.product_engine import ONE
from quadrance.program import assembler, image, meaning, parser
from quadrance.program.language import Wrong
from quadrance.six import AXES
from quadrance.truth_srs import Srs

from models.test import frames
from models.test.claims import distinct

# Seven axes: truth and text against a chain of matrices, the bit-true model against chain and bounds

INVERSE = pytest.mark.parametrize("core", [core for core in distinct() if core.function == "srs_ik"
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
    clear_of_the_shoulder = np.linalg.norm(centre, axis=1) > srs_bounds.folded(p)
    for branch in range(8):
        answer = core.model(p, **words, **_config(core, robot), in_branch=np.int64(branch))
        assert not np.any(answer["out_status"] & 12)
        held = answer["out_status"] & 2 > 0
        joints, ok = _angles(answer, "out_"), (answer["out_status"] & 1 == 0) & clear_of_the_shoulder
        place, turned = _off(core, robot, joints, rotation, tip)
        law, limit = srs_bounds.position(p, arm, rotation, tip, held), srs_bounds.orientation(p, held)
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
    assert np.all(turned[clear & (answer["out_status"] & 2 == 0)] <= srs_bounds.orientation(p))
    assert np.all(place[clear] < 4)


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
    assert turned.max() <= srs_bounds.orientation(p, True)
    assert np.all(place <= srs_bounds.position(p, _arm(core, robot), rotation, tip, True))
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


# Machine tools: the bit-true models against LinuxCNC's formulas, and these against a chain of frames

TOOLS = [core for core in distinct() if core.family == "tool"]
MODELS = pytest.mark.parametrize("kind", ["xyzac", "xyzbc"])
EACH_TOOL = pytest.mark.parametrize("core", TOOLS, ids=lambda core: core.id)


def linuxcnc(kind, tilt, turn, place, point, offset, z_offset, length):
    """Axes x, y, z by the formulas of xyzac-trt and xyzbc-trt (LinuxCNC, src/emc/kinematics/trtfuncs.c), any unit.

    place : of the tool's tip on the workpiece, (N, 3). point : x-rot-point, y-rot-point, z-rot-point.
    """
    (x, y, z), dz = (place - point).T, z_offset + length
    ct, st, cc, sc = np.cos(tilt), np.sin(tilt), np.cos(turn), np.sin(turn)
    if kind == "xyzac":
        found = (cc * x - sc * y, sc * ct * x + cc * ct * y - st * z - ct * offset + st * dz + offset,
                 sc * st * x + cc * st * y + ct * z - st * offset - ct * dz + dz)
    else:
        found = (cc * ct * x - sc * ct * y + st * z - ct * offset - st * dz + offset, sc * x + cc * y,
                 -cc * st * x + sc * st * y + ct * z + st * offset - ct * dz + dz)
    return np.stack(found, axis=-1) + point


def drawn(count, seed, size):
    """Angles, places, and the words of a machine, of a size."""
    rng = np.random.default_rng(seed)
    angles = rng.uniform(-np.pi, np.pi, (2, count))
    return angles[0], angles[1], rng.uniform(-size, size, (count, 3)), rng.uniform(-size, size, 3) / 4, *(
        rng.uniform(-size, size, 3) / 8)


@MODELS
def test_linuxcnc_is_two_tables_in_a_chain(kind):
    """The workpiece turns about z through the point, both tilt about the axis that is off by the offsets."""
    tilt, turn, place, point, offset, z_offset, length = drawn(1000, 1, 100.0)
    axis = (0, offset) if kind == "xyzac" else (offset, 0)
    x, y, z = point + (*axis, z_offset + length)
    away = frames.shift(*point) @ frames.turn("z", turn) @ frames.shift(*-point)
    away = frames.shift(x, y, z) @ frames.turn(kind[3].replace("a", "x").replace("b", "y"), tilt) @ frames.shift(
        -x, -y, -z) @ away
    found = (away @ np.append(place, np.ones((1000, 1)), axis=1)[..., None])[:, :3, 0]
    assert np.abs(found - linuxcnc(kind, tilt, turn, place, point, offset, z_offset, length)).max() < 1e-9


@EACH_TOOL
@pytest.mark.parametrize("count", [2000, pytest.param(100_000, marks=pytest.mark.slow)])
def test_axes(core, count):
    """Within the law of LinuxCNC's formulas at the directions of the words; saturated where these are beyond."""
    p, kind = core.params, core.function
    unit, end = 2.0 ** -p["F"], 2.0 ** (p["W"] - 1)
    tilt, turn, place, point, offset, z_offset, length = drawn(count, count, end * unit * 0.8)
    cfg = tool.config(p, x_rot=point[0], y_rot=point[1], z_rot=point[2], offset=offset, z_offset=z_offset, tool=length)
    words = {f"in_{axis}": np.rint(place[:, i] / unit).astype(np.int64) for i, axis in enumerate("xyz")}
    for name, angle in ((kind[3], tilt), ("c", turn)):
        words |= {f"in_{letter}{name}": np.rint(part(angle) * 2.0 ** p["U"]).astype(np.int64)
                  for letter, part in (("c", np.cos), ("n", np.sin))}
    tilt, turn = (np.arctan2(words[f"in_n{name}"], words[f"in_c{name}"]) for name in (kind[3], "c"))
    held = np.array([cfg["cfg_xr"], cfg["cfg_yr"], 0])  # zs is z_rot, z_offset and the tool's length together
    place = np.stack([words[f"in_{axis}"] for axis in "xyz"], axis=-1)
    exact = linuxcnc(kind, tilt, turn, place, held, cfg["cfg_d"], cfg["cfg_zs"], 0)
    answer = core.model(p, **words, **cfg)
    found = np.stack([answer[f"out_{axis}"] for axis in "xyz"], axis=-1)
    law = tool_bounds.coordinate(p, np.linalg.norm(place - held - [0, 0, cfg["cfg_zs"]], axis=-1) + abs(cfg["cfg_d"]))
    over = answer["out_status"] == 4
    off = np.abs(found - exact).max(axis=-1)
    assert np.all(off[~over] <= law[~over]) and off[~over].max() > 0.5 and 0.5 < (~over).mean() < 1
    beyond = np.abs(exact + 0.5).max(axis=-1) - end
    assert np.all(over[beyond > law]) and not np.any(over[beyond < -law])
    rounding = linuxcnc(kind, tilt, turn, place * unit, point, offset, z_offset, length) - exact * unit
    assert np.abs(rounding).max() <= 4 * unit


# kinematics_engine: images of programs, what it answers against what their texts say, loads that it refuses

P = {"N": 10, "CONTEXTS": 4, "U": 16, "PIPE": 1}
FLAGGED = {"reach", "clamp", "quotient", "check"}  # statements of a text that set a flag
PROGRAMS = [path for path in sorted((RTL / "program").glob("*.kin")) if not parser.load(path).streamed]


@cache
def assembled(name, pipe):
    return assembler.assembled(RTL / "program" / f"{name}.kin", pipe)


def answers(commands, p=P):
    return kinematics_engine(p, **image.columns(commands))


def tiny():
    """Five lines that write one input to registers 2 to 6."""
    line = 1 << 45 | 0b1100000 << 32
    lines = [line | register << 9 for register in range(2, 7)]
    lines[-1] |= ENDS
    header = 7 << 16 | image.binascii.crc_hqx((7).to_bytes(4, "big"), image.crc(lines))
    return {"start": 9, "header": f"{header:012x}", "lines": [f"{word:012x}" for word in lines]}


# Programs


@pytest.mark.parametrize("pipe", (0, 1, 2))
@pytest.mark.parametrize("path", PROGRAMS, ids=lambda path: path.stem)
def test_a_program_computes_what_its_text_says(path, pipe):
    """Any words within the norms of the text, in two contexts in turn, every sign: results and status, bit by bit."""
    rng, one = np.random.default_rng(5), assembled(path.stem, pipe)
    program, made = one.program, image.image(one, start=64, version=3)
    count, p = 24, P | {"PIPE": pipe}
    inputs = {port.port: rng.uniform(-0.25, 0.25, count) * 2**25 for port in program.inputs.values()}
    inputs = {name: np.rint(words).astype(np.int64) for name, words in inputs.items()}
    inputs |= {port.port: rng.integers(0, 1 << 8, count) for port in program.inputs.values() if port.format == "power"}
    for port in program.inputs.values():
        if port.format == "fraction":
            inputs[port.port] = np.abs(inputs[port.port])
    inputs = {name: np.where(np.arange(count) % 8 == 2, 0, words) for name, words in inputs.items()}  # no directions
    signs = rng.integers(0, 8, count)
    commands = image.load(made)
    for i in range(count):
        commands += [*image.inputs(made, i % 2, {name: words[i] for name, words in inputs.items()}),
                     image.run(made, i % 2, int(signs[i])), *image.outputs(made, i % 2)]
    found = answers(commands, p)
    assert not np.any(found["out_refused"])
    kinds = np.array([command[0] for command in commands])
    read = found["out_word"][kinds == READ].reshape(count, -1)
    status = found["out_status"][kinds == RUN]
    for context in (0, 1):
        mine = np.arange(count) % 2 == context
        names = {port.port: name for name, port in program.inputs.items()}
        words = {names[port]: value[mine] for port, value in inputs.items()}
        said = meaning.walked(program, meaning.Fixed(meaning.floor(p), meaning.slack(p)), words,
                              {name: signs[mine] >> i & 1 for i, name in enumerate(program.signs)})
        for column, port in enumerate(program.results):
            np.testing.assert_array_equal(read[mine, column], wrap(said.words[port.name], 27), err_msg=port.name)
        assert np.all(status[mine] == said.status)
    assert status.any() == any(one.hold or one.kind in FLAGGED for one in program.statements)


def test_a_program_of_the_page_is_read_back():
    """Version and CRC of the header; the CRC of lines and header together is 0."""
    made = image.image(assembled("vector_fk6", 1), start=100, version=0xDEADBEEF)
    found = answers([*image.load(made), (INFO, 0, 100, 0)])
    assert (found["out_version"][-1], found["out_crc"][-1], found["out_refused"][-1]) == (0xDEADBEEF,
                                                                                         int(made["crc"], 16), 0)
    words = [int(word, 16) for word in (*made["lines"], made["header"])]
    crc = 0
    for word in words:
        crc = crc16(crc, word)
    assert image.crc(words) == crc == 0
    assert json.loads(json.dumps(made)) == made


def test_programs_share_the_memory():
    """Every program of the library that is not streamed, one behind the other in 1024 lines; each still runs."""
    start, commands, starts = 0, [], []
    for path in PROGRAMS:
        made = image.image(assembled(path.stem, 1), start)
        commands += image.load(made)
        starts.append(start)
        start += len(made["lines"]) + 1
    assert start <= 1 << P["N"]
    found = answers([*commands, *((RUN, 0, at, 0) for at in starts)])
    assert not np.any(found["out_refused"])


# What is refused

HEADER = int(tiny()["header"], 16)
LOADED = image.load(tiny())
BAD = {
    "a line is missing": [*LOADED[:2], *LOADED[3:]],
    "the last line is missing": [*LOADED[:-2], LOADED[-1]],
    "no line": [LOADED[0], (SEAL, 0, 9, 0)],
    "a bit of a line": [*LOADED[:3], (LINE, 0, 0, LOADED[3][3] ^ 2), *LOADED[4:]],
    "a bit of the version": [*LOADED[:-1], (SEAL, 0, 9, HEADER ^ 1 << 20)],
    "a bit of the CRC": [*LOADED[:-1], (SEAL, 0, 9, HEADER ^ 1)],
    "lines in another order": [LOADED[0], LOADED[2], LOADED[1], *LOADED[3:]],
    "a command in between": [*LOADED[:3], (READ, 0, 0, 0), *LOADED[3:]],
    "the seal alone": [LOADED[-1]],
}


@pytest.mark.parametrize("commands", BAD.values(), ids=BAD.keys())
def test_a_program_that_is_not_whole_does_not_run(commands):
    """The seal is refused, and so is the run; what was loaded there before does not run either."""
    check = [(RUN, 0, 9, 0), (INFO, 0, 9, 0)]
    for before in ([], LOADED):
        found = answers([*before, *commands, *check])
        kept = before and len(commands) == 1  # a seal without a load changes nothing
        assert found["out_refused"][-3:].tolist() == ([1, 0, 0] if kept else [1, 1, 1])
    found = answers([*commands, *LOADED, *check])  # and it can be loaded again
    assert found["out_refused"][-3:].tolist() == [0, 0, 0]


def test_a_line_is_no_start():
    found = answers([*LOADED, *((RUN, 0, at, 0) for at in (8, 10, 11, 14, 15))])
    assert found["out_refused"][len(LOADED):].all()


def test_a_run_ends_where_another_program_begins():
    """A program that a later one has cut ends there, refused; it never plays lines of the other."""
    other = tiny() | {"start": 12}
    before = [(WRITE, 0, 0, 5), (RUN, 0, 9, 0), (WRITE, 0, 0, 77)]
    found = answers([*LOADED, *before, *image.load(other), (RUN, 0, 9, 0), *((READ, 0, at, 0) for at in range(2, 7)),
                     (RUN, 0, 12, 0), (READ, 0, 6, 0)])
    assert found["out_refused"][-8:].tolist() == [1, 0, 0, 0, 0, 0, 0, 0]
    assert found["out_word"][-7:-2].tolist() == [77, 77, 5, 5, 5] and found["out_word"][-1] == 77


def test_contexts_do_not_meet():
    """Ports, registers and held directions of one context are the same whatever the others do."""
    made = image.image(assembled("vector_ik6", 1), 0)
    rng = np.random.default_rng(3)

    def visit(context, zero):
        values = {port["name"]: 0 if zero else int(rng.integers(0, 1 << 23)) for port in made["inputs"]
                  if "word" not in port}
        return [*image.inputs(made, context, values), image.run(made, context), *image.outputs(made, context)]

    mine = [visit(1, zero) for zero in (True, False, True, False, True)]  # the third holds what the second found
    others = [visit(context, False) for context in (0, 2, 3, 0, 2)]
    alone = answers([*image.load(made), *sum(mine, [])])
    mixed = answers([*image.load(made), *sum((a + b for a, b in zip(others, mine)), [])])
    at, picks = len(made["lines"]) + 2, []
    for a, b in zip(others, mine):
        picks += range(at + len(a), at + len(a) + len(b))
        at += len(a) + len(b)
    for name in ("out_word", "out_status"):
        np.testing.assert_array_equal(mixed[name][picks], alone[name][len(made["lines"]) + 2:])
    assert alone["out_word"][len(made["lines"]) + 2:].any()


def test_an_unread_context_is_empty():
    """No register can be read before the first run of its context."""
    found = answers([*LOADED, (WRITE, 0, 0, 5), (RUN, 0, 9, 0), (READ, 0, 2, 0), (READ, 1, 2, 0)])
    assert found["out_word"][-2:].tolist() == [5, 0]


def test_forgetting():
    """A run that forgets answers (1, 0) where there is no direction, as the first one of a context does."""
    made = image.image(assembled("vector_ik6", 0), 0)
    p = P | {"PIPE": 0}
    c1, n1 = ((READ, 0, port["at"], 0) for port in made["outputs"][:2])
    zero = image.inputs(made, 0, {port["name"]: 0 for port in made["inputs"] if "word" not in port})
    some = image.inputs(made, 0, {"in_x": 1 << 22, "in_y": 1 << 22, "cfg_r": 1 << 20})
    commands = [*image.load(made), *zero, image.run(made, 0), c1, n1, *some, image.run(made, 0), c1, n1, *zero,
                image.run(made, 0), c1, n1, image.run(made, 0, forget=True), c1, n1]
    found = answers(commands, p)["out_word"][[i for i, one in enumerate(commands) if one[0] == READ]].tolist()
    assert found[:2] == found[6:] == [ONE, 0] and found[2:4] == found[4:6] and abs(found[2] - found[3]) < 2000


# Images


def test_a_streamed_program_has_no_image():
    with pytest.raises(Wrong, match="its results are emitted"):
        image.image(assembled("vector_ik6_all", 0))
    with pytest.raises(Wrong, match="a version is from 0"):
        image.image(assembled("vector_fk6", 0), version=1 << 32)


def test_an_image_names_its_words():
    made = image.image(assembled("vector_ik6", 0))
    assert [port["name"] for port in made["inputs"][:2]] == ["in_r11", "in_r12"]
    assert made["inputs"][-1] == {"name": "one", "at": 22, "format": "constant", "word": ONE}
    assert [port["at"] for port in made["outputs"]] == list(range(2, 14)) and made["signs"] == ["back", "down", "flip"]
    assert (ROOT / "rtl" / "program" / f"{made['program']}.kin").exists()
