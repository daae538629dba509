"""engine_quaternion_dls at every parameter set: its step, where it ends, beside plain descent, flags, bad inputs."""

from __future__ import annotations

import numpy as np
import pytest
from quadrance import cores, truth
from quadrance.bounds import iterative as bounds
from quadrance.iterative import fixed, gradient, newton, newton_fixed

from models.test.claims import distinct

CORES = [core for core in distinct() if core.name == "engine_quaternion_dls"]
EACH = pytest.mark.parametrize("core", CORES, ids=lambda core: core.id)
PLAIN = next(core for core in cores.all_cores() if core.name == "engine_quaternion_gd")


def words(p: dict[str, int], theta: np.ndarray) -> np.ndarray:
    return np.rint(theta / truth.TURN * 2 ** p["A"]).astype(np.int64) & 2 ** p["A"] - 1


def arm(p: dict[str, int], damping: float = 2**-8, second: float = 1.0) -> dict[str, int]:
    """Link 1 an eighth of a word; a tolerance of one unit."""
    l1, l2 = 1 << p["W"] - 3, round(second * (1 << p["W"] - 3))
    return {"cfg_l1": l1, "cfg_l2": l2, "cfg_tol": 256, "cfg_limit": 200} \
        | newton_fixed.config(p, cfg_l1=l1, cfg_l2=l2, damping=damping)


def run(core: cores.Core, goal: np.ndarray, theta: np.ndarray, cfg: dict[str, int], warm: object = 0) -> dict:
    start = words(core.params, theta)
    return core.model(core.params, in_x=goal[..., 0], in_y=goal[..., 1], in_j1=start[..., 0], in_j2=start[..., 1],
                      in_warm=warm, **cfg)


def kinematics(cfg: dict[str, int]) -> gradient.Kinematics:
    return gradient.planar(cfg["cfg_l1"], cfg["cfg_l2"])


def joints(core: cores.Core, answer: dict) -> np.ndarray:
    return np.stack([answer["out_j1"], answer["out_j2"]], axis=-1) * truth.TURN / 2 ** core.params["A"]


def reachable(cfg: dict[str, int], count: int = 300) -> np.ndarray:
    rng = np.random.default_rng(1)
    theta = np.stack([rng.uniform(-np.pi, np.pi, count), rng.uniform(0.4, 2.6, count)], axis=-1)
    return np.rint(kinematics(cfg)(theta)[0]).astype(np.int64)


START = np.radians([-100, 30])


def test_the_float_step_is_damped_least_squares() -> None:
    """Against a solver of linear equations, J by the turns of link 1 and of both joints, in units of their lengths."""
    rng, lengths = np.random.default_rng(2), np.array([1.0, 0.7])
    for damping in (2**-8, 0.3):
        theta, goal = rng.uniform(-3, 3, (50, 2)), rng.normal(size=(50, 2))
        tip, jacobian = gradient.planar(*lengths)(theta)
        unit = np.stack([jacobian[..., 0] - jacobian[..., 1], jacobian[..., 1]], axis=-1) / lengths
        square = np.swapaxes(unit, -1, -2) @ unit + damping * np.eye(2)
        turns = np.linalg.solve(square, np.swapaxes(unit, -1, -2) @ (goal - tip)[..., None])[..., 0] / lengths
        step = newton.wrist_step(theta, goal, lengths, damping)[0]
        assert np.abs(np.cumsum(step, axis=-1) - turns).max() < 1e-9


@EACH
@pytest.mark.parametrize("damping", [0.0, 2**-8, 2**-5, 0.25])
def test_ends_within_its_bound_as_soon_as_float64(core: cores.Core, damping: float) -> None:
    for second in (1.0, 0.8):
        cfg = arm(core.params, damping, second)
        goal = reachable(cfg)
        answer = run(core, goal, np.tile(START, (300, 1)), cfg)
        done = answer["out_status"] == 0
        assert done.mean() > 0.98 and not answer["out_coarse"][done].any() and np.all(answer["out_error"][done] < 256)
        off = np.linalg.norm(kinematics(cfg)(joints(core, answer))[0] - goal, axis=-1)
        law = bounds.newton_tip(core.params, (cfg["cfg_l1"], cfg["cfg_l2"]), answer["out_error"])
        assert np.all(off[done] <= law[done])
        exact = newton.wrist_solve(START, goal, 0.0, (cfg["cfg_l1"], cfg["cfg_l2"], 0), damping=damping,
                                   tolerance=4.0 ** (core.params["W"] - 16), limit=200)
        assert abs(np.median(answer["out_iters"]) - np.median(exact.iterations)) <= 1


@EACH
def test_an_undamped_step_is_newtons_within_the_bound(core: cores.Core) -> None:
    p, rng, near = core.params, np.random.default_rng(3), []
    cfg = arm(p, 0.0) | {"cfg_tol": 0, "cfg_limit": 1}
    unit = 2 ** (16 - p["W"])
    links = (cfg["cfg_l1"] * unit, cfg["cfg_l2"] * unit, 0)
    start = np.stack([rng.uniform(-3, 3, 300), rng.uniform(0.6, 2.5, 300)], axis=-1)
    theta = words(p, start) * truth.TURN / 2 ** p["A"]
    goal = np.rint(kinematics(cfg)(theta)[0] + rng.normal(size=(300, 2)) * 0.01 * cfg["cfg_l1"]).astype(np.int64)
    answer = run(core, goal, theta, cfg)
    exact = newton.wrist_step(theta, goal * unit, links)[0]
    step = np.stack([answer["out_d1"], answer["out_d2"]], axis=-1) * truth.TURN / 2 ** p["A"]
    for i in range(300):
        near.append(np.abs(step[i] - exact[i]).max() / bounds.newton_step(p, theta[i], goal[i] * unit, links))
    assert 0.1 < max(near) <= 1


def test_takes_a_tenth_of_the_iterations_of_plain_descent() -> None:
    core = CORES[0]
    cfg = arm(core.params)
    goal, start = reachable(cfg), words(core.params, START)
    assert PLAIN.params | {"MULTIPLY": 18} == core.params
    plain = PLAIN.model(PLAIN.params, in_x=goal[:, 0], in_y=goal[:, 1], in_j1=start[0], in_j2=start[1], in_warm=0,
                        cfg_l1=cfg["cfg_l1"], cfg_l2=cfg["cfg_l2"], cfg_tol=256, cfg_limit=1000,
                        **fixed.config(PLAIN.params, cfg_l1=cfg["cfg_l1"], cfg_l2=cfg["cfg_l2"], gain=0.33))
    answer = run(core, goal, np.tile(START, (300, 1)), cfg)
    assert np.median(answer["out_iters"]) * 10 < np.median(plain["out_iters"])
    assert np.percentile(answer["out_iters"], 95) * 30 < np.percentile(plain["out_iters"], 95)


@EACH
def test_out_of_reach_it_ends_at_the_nearest_point(core: cores.Core) -> None:
    """A damping of half the gap and more, in links; without it the arm wanders. Flagged in every case."""
    turn = np.linspace(0.1, 6.1, 40)
    way = np.stack([np.cos(turn), np.sin(turn)], axis=-1)
    for gap, damping, low, high in ((0.1, 2**-4, 0, 0.002), (0.3, 0.25, 0, 0.002), (0.3, 2**-6, 0.01, 4)):
        cfg = arm(core.params, damping)
        goal = np.rint((2 + gap) * cfg["cfg_l1"] * way).astype(np.int64)
        answer = run(core, goal, np.stack([turn + 0.7, np.full(40, 0.5)], axis=-1), cfg)
        assert np.all(answer["out_status"] & 8) and np.all(answer["out_iters"] == 200)
        near = kinematics(cfg)(joints(core, answer))[0] - 2 * cfg["cfg_l1"] * way
        assert low <= np.linalg.norm(near, axis=-1).max() / cfg["cfg_l1"] < high


@EACH
def test_the_last_step_is_what_moved_the_joints(core: cores.Core) -> None:
    """From the answer of one limit to that of the next, warm samples among them; nothing where no step was taken."""
    cfg = arm(core.params) | {"cfg_tol": 0}
    goal = reachable(cfg, 20)
    answers = [run(core, goal, np.tile(START, (20, 1)), cfg | {"cfg_limit": limit}) for limit in range(5)]
    assert not answers[0]["out_d1"].any() and not answers[0]["out_d2"].any()
    mask = 2 ** core.params["A"] - 1
    for old, new in zip(answers, answers[1:]):
        for i in (1, 2):
            assert new[f"out_d{i}"].any() and np.all(old[f"out_j{i}"] + new[f"out_d{i}"] & mask == new[f"out_j{i}"])
    once = run(core, goal, np.tile(START, (20, 1)), cfg | {"cfg_limit": 1}, np.arange(20) > 0)
    for i in (1, 2):
        assert np.all(once[f"out_j{i}"][:-1] + once[f"out_d{i}"][1:] & mask == once[f"out_j{i}"][1:])


@EACH
def test_bad_inputs_and_the_sample_behind_them(core: cores.Core) -> None:
    """Tolerance 0, limit 0, links of 0: flagged at the limit; the next sample, cold or warm, is as ever."""
    cfg = arm(core.params)
    goal = reachable(cfg, 1)
    for change, status in (({"cfg_tol": 0, "cfg_limit": 7}, 8), ({"cfg_limit": 0}, 8), ({"cfg_l1": 0}, 10),
                           ({"cfg_l2": 0}, 10), ({"cfg_l1": 0, "cfg_l2": 0}, 10)):
        answer = run(core, goal, START[None], cfg | change)
        assert answer["out_status"] == status and answer["out_iters"] == (cfg | change)["cfg_limit"]
    stuck = run(core, goal, np.array([[0.3, 0.0]]), cfg | {"cfg_limit": 0})
    assert stuck["out_status"] == 10  # stretched: singular where it did not converge
    far = np.array([[3 * cfg["cfg_l1"], 0]])
    both = run(core, np.concatenate([far, goal, goal]), np.tile(START, (3, 1)), cfg, np.array([0, 0, 1]))
    assert both["out_status"][0] & 8 and not both["out_status"][1:].any() and both["out_iters"][2] == 0
    assert all(both[f"out_{name}"][1] == run(core, goal, START[None], cfg)[f"out_{name}"][0]
               for name in ("j1", "j2", "iters", "d1", "d2"))
