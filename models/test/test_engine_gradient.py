"""engine_quaternion_gd at every parameter set: golden iterates, where it ends, flags, bad inputs."""

from __future__ import annotations

import numpy as np
import pytest
from quadrance import cores, truth
from quadrance.bounds import iterative as bounds
from quadrance.iterative import fixed, gradient

CORES = [core for core in cores.all_cores() if core.name == "engine_quaternion_gd"]
EACH = pytest.mark.parametrize("core", CORES, ids=lambda core: core.id)


def words(p: dict[str, int], degrees: np.ndarray) -> np.ndarray:
    return np.rint(np.asarray(degrees) / 360 * 2 ** p["A"]).astype(np.int64) & 2 ** p["A"] - 1


def arm(p: dict[str, int], gain: float = 0.33, bits: int = 3) -> dict[str, int]:
    """Equal links, an eighth of a word each: 0.1 m of the paper, whose first error is 0.32 m, then fits."""
    length = 1 << p["W"] - bits
    return {"cfg_l1": length, "cfg_l2": length} | fixed.config(p, cfg_l1=length, cfg_l2=length, gain=gain)


def run(p: dict[str, int], goal: np.ndarray, start: np.ndarray, cfg: dict[str, int], warm: int = 0) -> dict:
    return fixed.gd(p, in_x=goal[..., 0], in_y=goal[..., 1], in_j1=start[..., 0], in_j2=start[..., 1], in_warm=warm,
                    **cfg)


def off_target(p: dict[str, int], answer: dict, goal: np.ndarray, cfg: dict[str, int]) -> np.ndarray:
    """Distance of the answered tip from the target, LSB."""
    theta = np.stack([answer["out_j1"], answer["out_j2"]], axis=-1) * truth.TURN / 2 ** p["A"]
    return np.linalg.norm(truth.tip(theta, cfg["cfg_l1"], cfg["cfg_l2"])[..., :2] - goal, axis=-1)


def reachable(p: dict[str, int], cfg: dict[str, int], count: int, seed: int) -> np.ndarray:
    rng = np.random.default_rng(seed)
    theta = np.stack([rng.uniform(-np.pi, np.pi, count), rng.uniform(0.4, 2.6, count)], axis=-1)
    return np.rint(truth.tip(theta, cfg["cfg_l1"], cfg["cfg_l2"])[:, :2]).astype(np.int64)


@EACH
@pytest.mark.parametrize("start", [(-100, 30), (-50, -50)])
def test_golden_iterates(core: cores.Core, start: tuple[int, int]) -> None:
    """The paper's iterates within the derived bound: all thirty at 16 bits, ten at 14, where it then runs away."""
    p = core.params
    cfg, first = arm(p), words(p, start)
    goal = np.rint(np.array([0.0292, 0.1267]) / 0.1 * cfg["cfg_l1"]).astype(np.int64)
    far, last = [], 30 if p["W"] >= 16 else 10
    path, off = bounds.drift(p, first, goal, cfg, last)
    for limit in (*range(1, 11), 20, 30)[:None if last == 30 else -2]:
        answer = run(p, goal, first, cfg | {"cfg_tol": 0, "cfg_limit": limit})
        theta = np.array([answer["out_j1"], answer["out_j2"]]) * truth.TURN / 2 ** p["A"]
        assert answer["out_iters"] == limit and answer["out_status"] == 8
        far.append(np.linalg.norm(truth.difference(theta, path[limit])) / off[limit])
    assert 0 < max(far) <= 1
    assert np.degrees(off[last]) < 0.5 * 2.0 ** (16 - p["W"])


@EACH
def test_ends_within_the_bound_of_its_own_error(core: cores.Core) -> None:
    p = core.params
    for gain, bits, tol in ((0.33, 3, 16), (0.3, 2, 400), (0.2, 2, 4096)):
        cfg = arm(p, gain, bits) | {"cfg_tol": tol, "cfg_limit": 1000}
        goal = reachable(p, cfg, 300, 1)
        answer = run(p, goal, np.tile(words(p, (-100, 30)), (300, 1)), cfg)
        done = answer["out_status"] == 0
        bound = bounds.tip(p, cfg["cfg_l1"], cfg["cfg_l2"], square=answer["out_error"])
        assert done.mean() > 0.97 and not answer["out_coarse"][done].any() and np.all(answer["out_error"][done] < tol)
        assert np.all(off_target(p, answer, goal, cfg)[done] <= bound[done])


@EACH
def test_takes_as_many_iterations_as_float64(core: cores.Core) -> None:
    p = core.params
    cfg = arm(p) | {"cfg_tol": 256, "cfg_limit": 1000}
    goal, start = reachable(p, cfg, 300, 2), np.tile(words(p, (-100, 30)), (300, 1))
    exact = gradient.solve(gradient.planar(cfg["cfg_l1"], cfg["cfg_l2"]), start * truth.TURN / 2 ** p["A"], goal,
                           alpha=fixed.alpha(p, cfg["cfg_alpha"], cfg["cfg_shift"]), tolerance=1.0, limit=1000)
    median = np.median(exact.iterations)
    assert abs(np.median(run(p, goal, start, cfg)["out_iters"]) - median) <= 0.05 * median


@EACH
def test_out_of_reach_is_flagged_at_the_nearest_point(core: cores.Core) -> None:
    p = core.params
    cfg = arm(p, 0.2) | {"cfg_tol": 256, "cfg_limit": 1000}
    turn = np.random.default_rng(3).uniform(-np.pi, np.pi, 100)
    goal = np.rint(2.3 * cfg["cfg_l1"] * np.stack([np.cos(turn), np.sin(turn)], axis=-1)).astype(np.int64)
    start = words(p, np.stack([np.degrees(turn) + 40, np.full(100, 30)], axis=-1))
    answer = run(p, goal, start, cfg)
    near = truth.nearest(np.concatenate([goal, 0 * goal[:, :1]], axis=1), cfg["cfg_l1"], cfg["cfg_l2"])[:, :2]
    assert np.all(answer["out_status"] == 8) and np.all(answer["out_iters"] == 1000)
    assert off_target(p, answer, near, cfg).max() < 4


@EACH
def test_never_converged_while_far(core: cores.Core) -> None:
    """Errors of every size up to the greatest there is: none that a saturated or wrapped square calls converged."""
    p = core.params
    rng, high = np.random.default_rng(4), (1 << p["W"]) - 1
    size = 1 << p["W"] - 1
    for length in (high, size, size >> 1, 0):
        cfg = {"cfg_l1": length, "cfg_l2": length, "cfg_alpha": 2 * high + 1, "cfg_shift": 0, "cfg_tol": 2**22 - 1,
               "cfg_limit": 0}
        goal = np.concatenate([rng.integers(-size, size, (4000, 2)), [[-size, -size], [size - 1, -size]]])
        answer = run(p, goal, rng.integers(0, 2 ** p["A"], goal.shape), cfg)
        far = off_target(p, answer, goal, cfg) > 2**22**0.5 / 16 + 4 + length * 2.0 ** (2 - p["W"])
        assert far.sum() > 1000 and np.all(answer["out_status"][far] == 8)


@EACH
def test_bad_inputs_and_the_sample_behind_them(core: cores.Core) -> None:
    """Tolerance 0, limit 0, a start along the arm, a step too long: flagged at the limit; a warm start goes on."""
    p = core.params
    cfg = arm(p)
    goal, start = reachable(p, cfg, 1, 5), words(p, [[-100, 30]])
    long = arm(p, 0.2, 2) | {"cfg_alpha": (2 << p["W"]) - 1, "cfg_shift": 0}  # a gain of 3.1
    for change, iterations in (({"cfg_tol": 0, "cfg_limit": 7}, 7), ({"cfg_tol": 64, "cfg_limit": 0}, 0),
                               (long | {"cfg_tol": 64, "cfg_limit": 50}, 50)):
        answer = run(p, goal, start, cfg | change)
        assert answer["out_status"] == 8 and answer["out_iters"] == iterations
    line = np.array([[cfg["cfg_l1"], 0]])
    assert run(p, line, np.zeros((1, 2), dtype=np.int64), cfg | {"cfg_tol": 64, "cfg_limit": 3})["out_status"] == 8
    rule = cfg | {"cfg_tol": 64, "cfg_limit": 600}
    twice = run(p, np.repeat(goal, 2, axis=0), np.repeat(start, 2, axis=0), rule, np.array([0, 1]))
    assert twice["out_status"].tolist() == [0, 0] and twice["out_iters"][0] > 20 and twice["out_iters"][1] == 0
    assert twice["out_j1"][0] == twice["out_j1"][1] and twice["out_j2"][0] == twice["out_j2"][1]


@EACH
def test_the_last_step_is_what_moved_the_joints(core: cores.Core) -> None:
    """From the answer of one limit to that of the next; nothing where no step was taken."""
    p = core.params
    cfg = arm(p) | {"cfg_tol": 0}
    goal, start = reachable(p, cfg, 20, 6), np.tile(words(p, (-100, 30)), (20, 1))
    answers = [run(p, goal, start, cfg | {"cfg_limit": limit}) for limit in range(6)]
    assert not answers[0]["out_d1"].any() and not answers[0]["out_d2"].any()
    for old, new in zip(answers, answers[1:]):
        mask, both = 2 ** p["A"] - 1, new["out_d1"] + new["out_d2"]
        assert np.all(old["out_j1"] + both & mask == new["out_j1"]) and both.any()
        assert np.all(old["out_j2"] + new["out_d2"] & mask == new["out_j2"])


def test_an_arm_too_short_for_its_word_is_refused() -> None:
    p = CORES[0].params
    with pytest.raises(ValueError, match="finer unit"):
        fixed.config(p, cfg_l1=1000, cfg_l2=1000)
    with pytest.raises(ValueError, match="above 0"):
        fixed.config(p, cfg_l1=0, cfg_l2=0)
