"""The parallel robot's core: its model against float64, within derived bounds, on every robot file."""

from __future__ import annotations

import numpy as np
import pytest
from quadrance import cores, engine_rus
from quadrance.bounds import engine as bounds
from quadrance.parallel import geometry, position
from quadrance.parallel.geometry import PoseError

from models.test.claims import distinct
from tb.engine.rotation import matrices, quaternions
from tb.engine.rus_ik import SCALE, spiral, workspace

CORES = [core for core in distinct() if core.name == "engine_rus_ik"]
EVERY = pytest.mark.parametrize("core", CORES, ids=lambda core: core.id)
ROBOTS = pytest.mark.parametrize("name", sorted(SCALE))


def run(core, name: str, poses: tuple, near: float = 0.0) -> tuple[dict, dict, geometry.Robot, float]:
    """The core's answer and what the same words say in float64, arrays (N, legs), poses alone."""
    robot, scale = geometry.load(name), SCALE[name]
    loads = engine_rus.geometry(core.params, robot, scale)
    columns = engine_rus.stream(loads, engine_rus.poses(core.params, robot, scale, *poses))
    cfg = engine_rus.config(core.params, robot, scale, near)
    out = core.model(core.params, **columns, **cfg)
    keep, legs = slice(len(loads), None), range(robot.legs)
    cosine, sine, root = (np.stack([out[f"out_{what}{leg + 1}"][keep] for leg in legs], axis=-1) for what in "cns")
    found = {"cosine": cosine, "sine": sine, "angle": np.arctan2(sine, cosine), "root": root / bounds.FINE,
             "far": np.stack([out["out_far"][keep] >> leg & 1 for leg in legs], axis=-1) == 1,
             "status": out["out_status"][keep]}
    exact = engine_rus.exact(core.params, columns, cfg["cfg_k"], cfg["cfg_c"])
    return found, {key: words[keep] for key, words in exact.items()}, robot, scale


def apart(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.abs(np.angle(np.exp(1j * (a - b))))


@EVERY
@ROBOTS
def test_angles_roots_and_flags_keep_their_bounds(core, name):
    found, exact, robot, scale = run(core, name, workspace(name, 3000, np.random.default_rng(5)))
    la, lb = robot.la[0] / scale, robot.lb[0] / scale
    band = bounds.rus_band(exact["distance"], la, exact["flat"])
    sure = np.abs(exact["gap"]) > band
    assert sure.mean() > 0.99 and np.array_equal(found["far"][sure], exact["gap"][sure] < 0)
    reach = ~found["far"] & (exact["gap"] > 4 * band)
    assert reach.mean() > 0.3
    root, flat = np.where(reach, exact["root"], la), exact["flat"]
    limit = bounds.rus_angle(la, lb, root, flat)
    assert np.all(apart(found["angle"], exact["angle"])[reach] <= limit[reach])
    off = band / root + bounds.ROOT * exact["root"] + 2 / bounds.FINE
    assert np.all(np.abs(found["root"] - exact["root"])[reach] <= off[reach])
    length = np.hypot(found["cosine"], found["sine"])
    assert np.abs(length / engine_rus.ONE - 1).max() < 1e-4, "unit vectors, out of reach too"


@ROBOTS
def test_degrees_that_the_page_claims(name):
    """S of a tenth of the crank and more, W = 18, the words of the inputs given: measured, and derived anywhere."""
    found, exact, robot, scale = run(CORES[0], name, workspace(name, 6000, np.random.default_rng(6)))
    reach = ~found["far"] & (exact["root"] * scale >= robot.la[0] / 10)
    worst = np.degrees(apart(found["angle"], exact["angle"])[reach].max())
    la, lb = robot.la[0] / scale, robot.lb[0] / scale
    limit = bounds.rus_worst(la, lb, 0.1)
    assert bounds.rus_angle(la, lb, exact["root"][reach], exact["flat"][reach]).max() <= limit
    assert worst <= 0.0015 and np.degrees(limit) <= 0.01


def test_nearest_crank_out_of_reach():
    poses = (np.eye(3), np.array([[0, -900, 0], [0, -750, 30], [90, -800, 20], [0, 750.0, 0]]), 0.3)
    found, exact, robot, _ = run(CORES[0], "rus_2x3", poses)
    assert found["far"].all() and np.all(found["root"] == 0) and np.all(found["status"] & 1)
    assert apart(found["angle"], exact["angle"]).max() < np.radians(0.01)
    misses = np.abs(position.rods(robot, np.eye(3), poses[1], found["angle"], 0.3))
    for turn in (-0.01, 0.01):
        assert np.all(np.abs(position.rods(robot, np.eye(3), poses[1], found["angle"] + turn, 0.3)) > misses)


def test_spiral_closes_its_rods():
    """The paper's 101 poses with the best link angles: cranks of the core against the robot's inverse and rods."""
    turn, place, beta = spiral()
    found, _, robot, _ = run(CORES[0], "rus_2x3", (turn, place, beta))
    true = position.inverse(robot, turn, place, beta)
    assert true.reachable.all() and not found["status"].any()
    assert np.degrees(apart(found["angle"], true.alpha)).max() < 0.005, "rounded inputs included"
    assert np.abs(position.rods(robot, turn, place, found["angle"], beta)).max() < 0.01, "mm"


def test_singular_flag_is_the_root_below_its_limit():
    poses = workspace("rus_2x3", 4000, np.random.default_rng(8))
    found, exact, _, scale = run(CORES[0], "rus_2x3", poses, near=60.0)
    root = np.where(found["far"], np.inf, exact["root"] * scale)
    near = (root < 60).any(axis=1)
    clear = (np.abs(root - 60) > 1).all(axis=1)
    assert near.sum() > 20 and np.array_equal((found["status"][clear] & 2) > 0, near[clear])


@EVERY
def test_legs_answer_from_their_last_geometry(core):
    robot, scale = geometry.load("rus_2x3"), SCALE["rus_2x3"]
    loads = engine_rus.geometry(core.params, robot, scale)
    cfg = engine_rus.config(core.params, robot, scale)
    pose = engine_rus.poses(core.params, robot, scale, np.eye(3), np.array([[0, -320.0, 0]]))
    rows = [{name: int(words[0]) for name, words in pose.items()}]
    every = [*rows, loads[0], *rows, loads[3], *rows, {**loads[3], "in_leg": 0}, *rows, {**loads[0], "in_leg": 6},
             *rows]
    out = core.model(core.params, **{name: np.array([row[name] for row in every]) for name in every[0]}, **cfg)
    assert out["out_far"].tolist() == [63, 0, 62, 0, 54, 0, 54, 0, 54]
    assert out["out_status"].tolist() == [1, 0] * 4 + [1]
    assert [out["out_c1"][i] for i in (0, 1, 3, 5)] == [engine_rus.ONE] * 4 and out["out_n1"][3] == 0
    assert out["out_c1"][6] == out["out_c4"][4] != out["out_c1"][4] == out["out_c1"][2]
    assert out["out_c1"][8] == out["out_c1"][6], "leg 7 and 8 do not exist"


def test_words_that_do_not_fit():
    """... and matrices that are no rotation."""
    p, robot = CORES[0].params, geometry.load("rus_2x3")
    for scale, reason in ((1.0, "4097 LSB and more"), (1 / 512, "less than 2.17")):
        with pytest.raises(PoseError, match=reason):
            engine_rus.config(p, robot, scale)
    with pytest.raises(PoseError, match="position: does not fit 18 bits"):
        engine_rus.poses(p, robot, 1 / 128, np.eye(3), np.array([[0, -1100.0, 0]]))
    with pytest.raises(PoseError, match="leg 4: does not fit|position: does not fit"):
        engine_rus.geometry(p, robot, 1 / 400)
    for matrix, reason in ((1.01 * np.eye(3), "no rotation"), (-np.eye(3), "reflection")):
        with pytest.raises(PoseError, match=reason):
            engine_rus.poses(p, robot, 1 / 128, matrix, np.array([[0, -320.0, 0]]))


def test_angles_are_those_of_the_vectors():
    """Within 0.89 LSB, the bound of vector_to_angle, and what a vector costs whose length is not 1."""
    found = {}
    for core in (CORES[0], cores.find("engine_rus_ik_angle")):
        robot, scale = geometry.load("rus_2x3"), SCALE["rus_2x3"]
        columns = engine_rus.stream(engine_rus.geometry(core.params, robot, scale), engine_rus.poses(
            core.params, robot, scale, *workspace("rus_2x3", 1000, np.random.default_rng(9))))
        cfg = engine_rus.config(core.params, robot, scale)
        found[core.name] = core.model(core.params, **columns, **cfg)
    vector, angle = found["engine_rus_ik"], found["engine_rus_ik_angle"]
    for leg in range(1, 7):
        c, n = vector[f"out_c{leg}"], vector[f"out_n{leg}"]
        long = np.abs(np.hypot(c, n) / engine_rus.ONE - 1)
        off = apart(angle[f"out_j{leg}"] * 2 * np.pi / 2**18, np.arctan2(n, c))
        assert np.all(off < 2 * np.pi * 0.89 / 2**18 + 1.06 * long) and long.max() < 1e-4


def every_u(name):
    """The core at every legal U."""
    core = cores.find(name)
    return pytest.mark.parametrize("core", [cores.at(core, core.params | {"U": u}) for u in range(8, 17)],
                                   ids=lambda core: core.id)


@every_u("quaternion_to_matrix")
def test_matrices_of_quaternions(core):
    """Within 5/8 LSB of the words' own matrix; what is beyond the limit of length is flagged, and holds."""
    one = 1 << core.params["U"]
    words = quaternions(core, np.random.default_rng(3))
    out = core.model(core.params, **words)
    q = np.stack([words[f"in_{name}"] for name in "wxyz"], axis=-1) / one
    length = np.sum(q * q, axis=-1)  # exact
    bad = out["out_status"] == 2
    limit = bounds.quaternion_length(core.params)[1]
    assert not bad[(length - 1 >= -limit - 0.25 / one) & (length - 1 < limit - 0.5 / one)].any()
    assert bad[(length - 1 < -limit - 0.5 / one) | (length - 1 >= limit - 0.25 / one)].all()
    assert 0.2 < bad.mean() < 0.65
    w, x, y, z = q.T
    exact = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
             [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
             [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
    for i in range(3):
        for j in range(3):
            found = out[f"out_r{i + 1}{j + 1}"]
            assert np.abs(found - np.array(exact[i][j]) * one)[~bad].max() <= 0.625
            assert found[0] == found[1] == (i == j) * one
            held = np.flatnonzero(bad[2:]) + 2
            assert np.array_equal(found[held], found[held - 1])


@every_u("quaternion_to_matrix")
def test_no_unit_quaternion_is_flagged(core):
    """Rounded to the words, whatever the signs of the rounding errors; the bound of |q|^2 is reached within 10 %."""
    bits = core.params["U"]
    rng, one = np.random.default_rng(5), 1 << bits
    q = rng.normal(size=(20_000, 4))
    q[:8_000] = rng.choice([-1, 1], (8_000, 4)) + rng.normal(size=(8_000, 4)) * 4 / one
    q[:2] = np.full(4, one // 2), one // 2 + np.array([0.5, 0.5, -0.5, -0.5])  # errors of half a unit in all words
    words = np.rint(q / np.linalg.norm(q, axis=1, keepdims=True) * one).astype(np.int64)
    out = core.model(core.params, **dict(zip((port.name for port in core.inputs), words.T)))
    off = (words**2).sum(axis=1) / one**2 - 1
    most = bounds.quaternion_length(core.params)[0]
    assert not out["out_status"].any() and off[0] == 0 and 0.9 * most < np.abs(off).max() <= most


@every_u("quaternion_to_matrix")
def test_corners_of_length_are_both_sides_of_the_border(core):
    """At every U the corners have the last quaternions that pass and the first that do not, too long and too short."""
    bits = core.params["U"]
    words = np.stack(list(quaternions(core, np.random.default_rng(1)).values()), axis=-1)
    off = [sum(int(word) ** 2 // 2 ** (bits - 4) for word in row) + 8 - 2 ** (bits + 4) for row in words]
    limit = round(bounds.quaternion_length(core.params)[1] * 2 ** (bits + 4))
    assert {-limit - 1, -limit, limit - 1, limit} <= set(off)


CHECKS = every_u("rotation_check")


def told(core, words: np.ndarray) -> np.ndarray:
    """Which of the matrices (N, 3, 3) raise bit 3; the words pass."""
    ports = dict(zip((port.name for port in core.inputs), words.reshape(-1, 9).T))
    out = core.model(core.params, **ports)
    assert all(np.array_equal(out["out" + name[2:]], word) for name, word in ports.items())
    return out["out_status"] == 8


@CHECKS
def test_no_rotation_is_told_to_the_unit(core):
    """Each of the six sums against float64, which holds them exactly; what passes is near a rotation."""
    one = 1 << core.params["U"]
    words = np.stack(list(matrices(core, np.random.default_rng(4)).values()), axis=-1).reshape(-1, 3, 3)
    a, b, c = np.moveaxis(words / one, -1, 0)
    sums = [(a * a).sum(-1) - 1, (b * b).sum(-1) - 1, (a * b).sum(-1),
            *(np.cross(a, b) - c - np.roll(b, -1, axis=-1) / one).T]
    low, high = np.min(sums, axis=0) * one, np.max(sums, axis=0) * one
    off = (low < -16) | (high >= 16)
    found = told(core, words)
    assert np.array_equal(found, off) and 0.3 < off.mean() < 0.7
    assert all(np.any((np.array(sums)[i] * one >= 16) & (np.delete(sums, i, axis=0) * one < 16).all(0))
               for i in range(6))
    u, _, v = np.linalg.svd(words[~found] / one)
    assert np.all(np.linalg.det(u @ v) > 0)
    apart = np.linalg.norm(words[~found] / one - u @ v, axis=(1, 2))
    assert apart.max() <= bounds.rotation_apart(core.params) < 51 / one


@CHECKS
def test_rotations_are_not_told_and_others_are(core):
    """Rounded rotations and matrices of rounded unit quaternions pass; a word 48 units off, a mirror image, a stretched
    matrix, a shear of length sqrt(3), nothing do not."""
    p, rng = core.params, np.random.default_rng(6)
    one = 1 << p["U"]
    q = rng.normal(size=(4000, 4))
    q[:1000] *= 10.0 ** rng.uniform(-6, 0, (1000, 4))
    q = np.rint(q / np.linalg.norm(q, axis=1, keepdims=True) * one).astype(int)
    made = engine_rus.quaternion_to_matrix(p, in_w=q[:, 0], in_x=q[:, 1], in_y=q[:, 2], in_z=q[:, 3])
    assert np.all(made.pop("out_status") == 0)
    of_words = np.stack([made[f"out_r{i}{j}"] for i in "123" for j in "123"], axis=-1).reshape(-1, 3, 3)
    turns = np.array([geometry.rotation(*zip("zyx", angles)) for angles in rng.uniform(-180, 180, (1000, 3))])
    words = np.rint(turns * one).astype(int)
    assert not told(core, of_words).any() and not told(core, words).any()
    for i in range(9):
        assert told(core, words + 48 * np.eye(9, dtype=int)[i].reshape(3, 3)).all()
    assert told(core, -words).all() and told(core, 0 * words).all()
    assert told(core, words * [1, 1, -1]).all() and told(core, words * 105 // 100).all()
    e = 0.1
    shear = np.array([[1, e, 0], [0, np.sqrt(1 - e * e), 0], [0, 0, 1]])
    assert np.isclose(np.linalg.norm(shear), np.sqrt(3)) and told(core, np.rint(turns @ shear * one).astype(int)).all()
