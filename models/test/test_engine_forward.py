"""engine_rus_fk and engine_delta_fk against float64, within derived bounds; flags, bad inputs."""

from __future__ import annotations

import numpy as np
import pytest
from quadrance import cores, engine_delta, engine_rus
from quadrance import engine_rus_fk as fk
from quadrance.bounds import engine as delta_bounds
from quadrance.bounds import rus_fk as rus_bounds
from quadrance.parallel import delta, geometry, position
from quadrance.parallel.geometry import PoseError

from models.test.claims import distinct
from tb.engine.delta import MM, scale, words, workspace
from tb.engine.rus_fk import UNIT, assembled, poses
from tb.engine.rus_ik import spiral

# Six rods: engine_rus_fk

CORES = [core for core in distinct() if core.name == "engine_rus_fk"]
EVERY = pytest.mark.parametrize("core", CORES, ids=lambda core: core.id)
ROBOTS = pytest.mark.parametrize("name", sorted(UNIT))
SOLUTION = 8  # samples: solve, and seven that read


def run(p: dict, rows: list, tol: int, limit: int = 20) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Status, steps and pose words (N, 7) of the solutions that are read."""
    out = fk.fk(p, **fk.columns(rows), cfg_tol=tol, cfg_limit=limit)
    at = np.flatnonzero(np.array([row["in_op"] for row in rows]) == fk.SOLVE)
    words = np.array([out["out_word"][i + 1:i + SOLUTION] for i in at])
    return out["out_status"][at], out["out_iters"][at], words


def answer() -> list:
    return fk.solve() + fk.reads()


def pose_of(p: dict, name: str, words: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rotations and positions in mm of the words (N, 7); the quaternion made unit."""
    frame, value = engine_rus.frame(geometry.load(name)), words / 2.0 ** (p["W"] - 2)
    q = value[:, :4] / np.linalg.norm(value[:, :4], axis=1, keepdims=True)
    return frame.T @ geometry.of_quaternion(q) @ frame, value[:, 4:] @ frame * UNIT[name]


def near(turn: np.ndarray, place: np.ndarray, degrees: float, mm: float, rng: np.random.Generator):
    return (geometry.rotation(*zip("zyx", rng.uniform(-degrees, degrees, 3))) @ turn,
            place + rng.uniform(-mm, mm, 3))


def quantised(p: dict, robot: geometry.Robot, name: str, alpha: np.ndarray, beta: float):
    """(elbows, ball joints, LB) in mm as the words of a robot say them."""
    turn, unit = engine_rus.frame(robot), UNIT[name]
    one = 2.0 ** (p["W"] - 2)

    def word(value):
        return np.floor(np.asarray(value) * one + 0.5) / one

    c, n = word(np.cos(alpha)), word(np.sin(alpha))
    foot, joint = word(robot.foot @ turn.T / unit), word(robot.joint @ turn.T / unit)
    radial, link, la, lb = word(robot.radial @ turn.T), *(word(one / unit) for one in (robot.link, robot.la, robot.lb))
    e, f = la * c + link * word(np.cos(beta)), la * n + link * word(np.sin(beta))
    elbow = foot + np.stack([e * radial[:, 0], f, e * radial[:, 2]], axis=-1)
    return elbow @ turn * unit, joint @ turn * unit, lb * unit


def jacobian(turn: np.ndarray, place: np.ndarray, joint: np.ndarray, elbow: np.ndarray) -> np.ndarray:
    """Rows ((R c) x w, w) in mm, w the unit vectors of the rods."""
    arm = joint @ turn.T
    w = arm + place - elbow
    w /= np.linalg.norm(w, axis=1, keepdims=True)
    return np.hstack([np.cross(arm, w), w])


@EVERY
@ROBOTS
def test_converged_rods_and_poses_keep_their_bounds(core, name):
    p, robot, unit, rng = core.params, geometry.load(name), UNIT[name], np.random.default_rng(4)
    tol, close = 16, 0
    for turn, place, beta, alpha in zip(*poses(name, 30, rng)):
        rows = fk.loads(p, robot, unit, *near(turn, place, 0.5, 1, rng), alpha, beta) + answer()
        status, steps, words = run(p, rows, tol)
        if status[0]:
            continue
        turns, places = pose_of(p, name, words)
        elbow, joint, lb = quantised(p, robot, name, alpha, beta)
        rods = np.linalg.norm(joint @ turns[0].T + places[0] - elbow, axis=1) - lb
        limit = rus_bounds.rod(tol, lb / unit, np.linalg.norm(joint, axis=1) / unit, p["W"]) * unit
        assert np.all(np.abs(rods) <= limit)
        if p["W"] < 27:  # cranks are rounded: that is no error of the core
            continue
        rows6 = jacobian(turn, place, joint, elbow)
        shift, angle = rus_bounds.pose(rows6, limit + 2.0**-26 * unit * 4)
        if shift < 0.01:  # mm: to the first order
            close += 1
            assert np.linalg.norm(places[0] - place) <= 1.1 * shift
            assert np.linalg.norm(turns[0] - turn) / np.sqrt(2) <= 1.1 * angle
    assert close > 20 or p["W"] < 27


@EVERY
def test_the_spiral_from_pose_to_pose(core):
    """Two steps a pose at most; at W = 27 the paper's robot to 0.001 mm and 0.002 degrees."""
    p, robot, (turn, place, beta) = core.params, geometry.load("rus_2x3"), spiral()
    alpha, wide = position.inverse(robot, turn, place, beta).alpha, p["W"] < 27
    rows = fk.loads(p, robot, 512.0, turn[0], place[0], alpha[0], beta[0])
    for angles, link in zip(alpha, beta):
        rows += fk.link(p, link) + fk.cranks(p, angles) + answer()
    status, steps, words = run(p, rows, 256 if wide else 16)
    turns, places = pose_of(p, "rus_2x3", words)
    assert not status.any() and steps.max() <= 2
    assert np.linalg.norm(places - place, axis=1).max() < (0.1 if wide else 0.001)
    assert np.degrees(np.linalg.norm(turns - turn, axis=(1, 2)).max() / np.sqrt(2)) < (0.2 if wide else 0.002)


def test_forward_of_the_inverse_core():
    """Cranks by engine_rus_ik, 18 bits, into words of 18 bits: what they are off by is what their rounding makes."""
    p, robot, (turn, place, beta) = {"W": 18}, geometry.load("rus_2x3"), spiral()
    pick = slice(0, 101, 5)
    loads = engine_rus.geometry(p, robot, 1 / 128)
    columns = engine_rus.stream(loads, engine_rus.poses(p, robot, 1 / 128, turn[pick], place[pick], beta[pick]))
    found = engine_rus.ik(p, **columns, **engine_rus.config(p, robot, 1 / 128))
    rows = []
    for i in range(turn[pick].shape[0]):
        start = (turn[0], place[pick][i] + [1, -1, 1], np.zeros(6))
        load = fk.start(p, robot, 512.0, *start[:2]) if rows else fk.loads(p, robot, 512.0, *start)
        rows += load + fk.link(p, beta[pick][i])
        rows += [{"in_op": fk.WRITE, "in_n": leg, "in_k": k, "in_word": int(found[f"out_{what}{leg}"][len(loads) + i])}
                 for leg in range(1, 7) for k, what in ((11, "c"), (12, "n"))] + answer()
    status, _, words = run(p, rows, 256)
    turns, places = pose_of(p, "rus_2x3", words)
    assert not status.any()
    assert np.linalg.norm(places - place[pick], axis=1).max() < 0.1
    assert np.degrees(np.linalg.norm(turns - turn[pick], axis=(1, 2)).max() / np.sqrt(2)) < 0.2


@EVERY
def test_steps_are_newtons(core):
    """From 1 degree and 2 mm away, as many steps as float64 to the same tolerance, or one more or less."""
    p, robot, rng = core.params, geometry.load("rus_2x3"), np.random.default_rng(6)
    same = 0
    for turn, place, beta, alpha in zip(*poses("rus_2x3", 12, rng)):
        start = near(turn, place, 1, 2, rng)
        status, steps, _ = run(p, fk.loads(p, robot, 512.0, *start, alpha, beta) + answer(), 256)
        given = position.forward(robot, alpha, beta, *start, tolerance=256 * rus_bounds.WORD * 512**2 / 800,
                                 same_branch=False)
        same += status[0] == 0 and abs(steps[0] - given.steps) <= 1
    assert same >= 11


def test_nothing_is_silently_wrong():
    """One solution near its pose tells the side of the singularities. Then from 4 degrees and 10 mm away: what counts
    as converged fits and is on that side; what does not leaves the start as it was."""
    p, robot, rng, bad = {"W": 27}, geometry.load("rus_2x3"), np.random.default_rng(3), 0
    for turn, place, beta, alpha in zip(*poses("rus_2x3", 60, rng)):
        start = near(turn, place, 4, 10, rng)
        written = fk.start(p, robot, 512.0, *start)
        first = near(turn, place, 0.01, 0.02, rng)
        status, _, words = run(p, fk.loads(p, robot, 512.0, *first, alpha, beta) + answer() + written + answer(), 16)
        elbow, joint, lb = quantised(p, robot, "rus_2x3", alpha, beta)
        turns, places = pose_of(p, "rus_2x3", words)
        if status[0]:
            continue
        if status[1]:
            bad += 1
            assert status[1] & fk.NOT_CONVERGED
            assert words[1].tolist() == [row["in_word"] for row in written]
            continue
        rods = np.linalg.norm(joint @ turns[1].T + places[1] - elbow, axis=1) - lb
        assert np.abs(rods).max() < 0.001
        signs = [np.sign(np.linalg.det(jacobian(*one, joint, elbow))) for one in zip(turns, places)]
        assert signs[0] == signs[1]
    assert 2 < bad < 15


@EVERY
def test_bad_inputs_and_the_sample_behind_them(core):
    p, robot = core.params, geometry.load("rus_2x3")
    alpha = position.inverse(robot, np.eye(3), np.array([0, -300.0, 0]), 0.0).alpha
    load = fk.loads(p, robot, 512.0, np.eye(3), [1, -301, 1], alpha)
    good = fk.start(p, robot, 512.0, np.eye(3), [1, -301, 1]) + answer()

    def one(rows: list, tol: int = 300, limit: int = 9) -> tuple[int, int]:
        """Status of the bad solution; the good one behind it is unharmed."""
        status, steps, words = run(p, load + answer() + rows + answer() + good, tol, limit)
        if limit:
            assert status[0] == status[2] == 0 and words[0].tolist() == words[2].tolist()
        return int(status[1]), int(steps[1])

    early = fk.fk(p, **fk.columns(fk.solve() + load[:5] + fk.solve() + fk.reads()[4:]), cfg_tol=9, cfg_limit=9)
    assert early["out_status"].tolist() == [1] + [0] * 5 + [1, 0, 1, 1] and not early["out_word"][-2:].any()
    far = fk.start(p, robot, 512.0, np.eye(3), [900, 900, 900])
    assert one(far) == (fk.NOT_CONVERGED + fk.OVERFLOW, 0)
    none = [{**row, "in_word": 0} for row in good[:4]]
    assert one(none)[0] & fk.NOT_CONVERGED
    short = [{**good[0], "in_word": (1 << p["W"] - 2) - (1 << p["W"] - 8)}]
    assert run(p, load + short + answer(), (1 << 22) - 1, 0)[0][0] == fk.NOT_CONVERGED
    assert run(p, load + answer(), 300, 1)[0][0] == fk.NOT_CONVERGED
    leg = [row for row in load if row["in_n"] == 1]
    alike = [{**row, "in_n": 2} for row in leg]
    status, _, words = run(p, load + alike + answer() + [row for row in load if row["in_n"] == 2] + answer(), 300)
    assert status.tolist() == [fk.NOT_CONVERGED + fk.SINGULAR, 0]
    assert words[0].tolist() == [row["in_word"] for row in load[:7]]


def test_the_other_assembly_is_told():
    """At the paper's pose another assembly is 1 mm and 9 degrees away, across a singularity."""
    p, robot = {"W": 27}, geometry.load("rus_2x3")
    rows, other = (assembled(p, robot, right) for right in (True, False))
    status, steps, words = run(p, rows + answer() + other + answer() + rows[:7] + answer(), 16)
    assert status.tolist() == [0, fk.NOT_CONVERGED + fk.SINGULAR, 0] and steps.min() > 0
    turns, places = pose_of(p, "rus_2x3", words)
    assert np.linalg.norm(places - [0, -350, 0], axis=1)[[0, 2]].max() < 0.001
    status, _, words = run(p, rows + other + answer(), 16)  # nothing was known before
    assert status[0] == 0 and 0.9 < np.linalg.norm(pose_of(p, "rus_2x3", words)[1][0] - [0, -350, 0]) < 1


def test_words_that_do_not_fit_are_refused():
    robot, p = geometry.load("rus_2x3"), {"W": 27}
    with pytest.raises(PoseError, match="coarser unit"):
        fk.loads(p, robot, 200.0, np.eye(3), [0, -300, 0], np.zeros(6))
    with pytest.raises(PoseError, match="six legs"):
        fk.loads(p, geometry.load("klipper_delta"), 512.0, np.eye(3), [0, 0, 0], np.zeros(3))
    with pytest.raises(PoseError):
        fk.start(p, robot, 512.0, np.eye(3) * 1.1, [0, -300, 0])


# The delta on the product engine

DELTAS = [core for core in distinct() if core.name == "engine_delta_fk"]
EVERY_DELTA = pytest.mark.parametrize("core", DELTAS, ids=lambda core: core.id)
DELTA_ROBOTS = pytest.mark.parametrize("name", sorted(MM))


def run_delta(core, name: str, alpha: np.ndarray, below: bool = True) -> tuple[dict, np.ndarray, dict, float]:
    """Answer, its tip in LSB, what the words say, the rod in LSB."""
    columns, cfg = words(core, alpha), engine_delta.config(core.params, geometry.load(name), scale(core, name), below)
    answer = core.model(core.params, **columns, **cfg)
    place = np.stack([answer[f"out_{axis}"] for axis in "xyz"], axis=-1)
    return answer, place, engine_delta.exact(core.params, columns, cfg), cfg["cfg_lb"] * 2.0**-engine_delta.MORE


@EVERY_DELTA
@DELTA_ROBOTS
@pytest.mark.parametrize("below", [True, False])
def test_tip_and_reach_keep_their_bounds(core, name, below):
    """In the workspace, and with cranks anywhere."""
    rng = np.random.default_rng(3)
    alpha = np.concatenate([workspace(name, 3000, rng), rng.uniform(-np.pi, np.pi, (6000, 3))])
    answer, place, exact, lb = run_delta(core, name, alpha, below)
    law, band = delta_bounds.delta_tip(core.params, exact["elbows"], np.nan_to_num(exact["tip"]), lb)
    far, singular = (answer["out_status"] & bit > 0 for bit in (1, 2))
    sure = np.abs(exact["gap"]) > band
    assert sure.mean() > 0.99 and np.array_equal(far[sure], exact["gap"][sure] < 0)
    clear = sure & ~far & ~singular
    assert clear.mean() > 0.8
    held = 1 << core.params["W"] - 1
    off = np.abs(place - np.clip(exact["tip"], -held, held - 1)).max(axis=-1) - 0.5
    assert np.all(off[clear] <= law[clear])
    assert singular.mean() < 0.02 and law[:2500].max() < 25 and np.median(law[:2500]) < 1.7
    over = np.abs(exact["tip"] + 0.5).max(axis=-1) - held
    flag = answer["out_status"] & 4 > 0
    assert np.all(flag[clear & (over > law + 0.5)]) and not np.any(flag[clear & (over < -law - 0.5)])


@EVERY_DELTA
@DELTA_ROBOTS
@pytest.mark.parametrize("rod", [1, 0.4])
def test_the_law_out_of_reach(core, name, rod):
    """LB from elbow 1 towards the middle of the circle through the elbows, cranks anywhere; with shorter rods, too."""
    p, rng = core.params, np.random.default_rng(6)
    columns = words(core, np.concatenate([rng.uniform(-np.pi, np.pi, (20_000, 3)),
                                          np.pi / 2 * rng.integers(0, 4, (2000, 3)) + rng.normal(size=(2000, 3)) / 50]))
    cfg = engine_delta.config(p, geometry.load(name), scale(core, name))
    cfg["cfg_lb"] = round(cfg["cfg_lb"] * rod)
    answer, exact = core.model(p, **columns, **cfg), engine_delta.exact(p, columns, cfg)
    lb = cfg["cfg_lb"] * 2.0**-engine_delta.MORE
    _, band = delta_bounds.delta_tip(p, exact["elbows"], np.nan_to_num(exact["tip"]), lb)
    far = (exact["gap"] < -band) & (answer["out_status"] & 6 == 0)
    assert far.sum() > 100 and np.all(answer["out_status"][far] == 1)
    off = np.abs(np.stack([answer[f"out_{axis}"] for axis in "xyz"], axis=-1) - exact["tip"])[far].max(axis=-1) - 0.5
    law = delta_bounds.delta_nearest(p, exact["elbows"][far], lb)
    assert np.all(off <= law) and np.any(off > 0.25 * law)


@DELTA_ROBOTS
def test_it_is_the_robot(name):
    """Millimetres in the robot's frame against `delta.forward`, whose spheres are worked out another way."""
    core, robot = DELTAS[0], geometry.load(name)
    alpha = workspace(name, 2000, np.random.default_rng(4))
    alpha = alpha[np.abs(np.diff(alpha[:, [0, 1, 2, 0]])).max(axis=1) < 1.2]
    for below in (True, False):
        answer, *_ = run_delta(core, name, alpha, below)
        assert not np.any(answer["out_status"])
        off = engine_delta.tip(robot, scale(core, name), answer) - delta.forward(robot, alpha, below)
        assert np.abs(off).max() < 0.05, "mm, the cranks' rounding included"


@EVERY_DELTA
def test_no_tip(core):
    """Spheres that do not meet: LB from elbow 1. Elbows in one point: the last tip, before there was one elbow 1."""
    name, lsb = "klipper_delta", 2.0 ** core.params["W"]
    robot = geometry.load(name)
    cfg = engine_delta.config(core.params, robot, scale(core, name)) | {"cfg_base": 0}
    cfg["cfg_lb"] >>= 2
    one = np.pi / 2
    columns = words(core, np.array([[one, one, one], [1.5, 1.6, 1.55], [0, 0, 0], [one, one, one], [-one, -one, -one]]))
    answer = core.model(core.params, **columns, **cfg)
    place = np.stack([answer[f"out_{axis}"] for axis in "xyz"], axis=-1)
    exact = engine_delta.exact(core.params, columns, cfg)
    assert [int(status) & 3 for status in answer["out_status"]] == [2, 2, 1, 2, 2]
    assert np.array_equal(place[0], np.rint(exact["elbows"][0, 0]))
    assert np.array_equal(place[3], place[2]) and np.array_equal(place[4], place[2])
    rod = np.linalg.norm(place[2] - exact["elbows"][2, 0])
    assert abs(rod - cfg["cfg_lb"] / 16) < 2 + lsb * 2.0**-15


def test_words_that_do_not_fit():
    p = DELTAS[0].params
    with pytest.raises(PoseError, match="must be below 2.15 LSB"):
        engine_delta.config(p, geometry.load("klipper_delta"), 1 / 200)
    with pytest.raises(PoseError, match="three cranks alike"):
        engine_delta.config(p, geometry.load("rotary_stewart"), 1 / 48)


def test_angles_are_their_vectors():
    core, name = cores.find("engine_delta_fk_angle"), "linuxcnc_delta"
    alpha = workspace(name, 1000, np.random.default_rng(5))
    cfg = engine_delta.config(core.params, geometry.load(name), scale(core, name))
    by_angle = core.model(core.params, **words(core, alpha), **cfg)
    by_vector = DELTAS[0].model(DELTAS[0].params, **words(DELTAS[0], alpha), **cfg)
    for axis in "xyz":
        assert np.abs(by_angle[f"out_{axis}"] - by_vector[f"out_{axis}"]).max() <= 3
