"""engine_quaternion_gd_n: one step, where it ends, drift, flags, bad inputs. N changes none of the arithmetic."""

from __future__ import annotations

import numpy as np
import pytest
from quadrance import cores, truth
from quadrance.bounds import iterative as bounds
from quadrance.iterative import gradient, space
from quadrance.iterative.gradient import Joint

from models.test.claims import distinct

CORES = [core for core in distinct() if core.name == "engine_quaternion_gd_n"]
FIRST = pytest.mark.parametrize("core", CORES[:1], ids=lambda core: core.id)
EACH = pytest.mark.parametrize("core", CORES, ids=lambda core: core.id)
TOL = 512  # 2^-16 of the unit of length: one LSB of a coordinate of 16 bits


def chain(n: int, seed: int, reach: float = 0.5) -> list[Joint]:
    """Axes and links of any direction, links of one length; words that are exact."""
    parts = np.random.default_rng(seed).normal(size=(2, n, 3))
    axes, links = parts / np.linalg.norm(parts, axis=-1, keepdims=True)
    return [Joint(tuple(axis), tuple(np.rint(link * reach / n * 2**24) / 2**24)) for axis, link in zip(axes, links)]


def run(p: dict[str, int], rows: list[dict[str, int]], tol: int = TOL, limit: int = 1000) -> dict[str, np.ndarray]:
    return space.gd(p, **{name: np.array([row[name] for row in rows]) for name in rows[0]}, cfg_tol=tol,
                    cfg_limit=limit)


def solved(p: dict[str, int], joints: list[Joint], theta: np.ndarray, goal: np.ndarray, alpha: float, *,
           tol: int = TOL, limit: int = 1000) -> tuple[np.ndarray, dict[str, int], np.ndarray]:
    """Joints in radians, the answer of the solution, and (c, s)."""
    n = len(joints)
    out = run(p, space.loads(joints, theta, alpha, goal) + space.solve(n) + space.reads(n), tol, limit)
    pairs = out["out_word"][-2 * n:].reshape(n, 2) / space.ONE
    return 2 * np.arctan2(pairs[:, 1], pairs[:, 0]), {name: int(x[-2 * n - 1]) for name, x in out.items()}, pairs


def problem(n: int, seed: int, spread: float = 0.5) -> tuple[list[Joint], np.ndarray, np.ndarray, float]:
    """A chain, a start, a target that is a word, 0.8 of the greatest alpha that is stable there."""
    joints, rng = chain(n, seed), np.random.default_rng(seed)
    theta = rng.uniform(-2, 2, n)
    kinematics = gradient.spatial(joints)
    goal = np.rint(kinematics(theta + rng.uniform(-spread, spread, n))[0] * space.ONE) / space.ONE
    return joints, theta, goal, min(0.8 / np.linalg.norm(kinematics(theta)[1], ord=2) ** 2, 1000.0)


@EACH
def test_one_step_is_within_its_bound(core: cores.Core) -> None:
    """Against the float64 recursion, which the core's words of joints and alpha begin."""
    worst = []
    for n in {1, 2, 3, 6, 7, min(core.params["N"], 30)}:
        joints, theta, goal, alpha = problem(n, n, 0.1)
        alpha = np.rint(alpha / 512 * space.ONE) / space.ONE * 512
        first, _, _ = solved(core.params, joints, theta, goal, alpha, limit=0)
        second, answer, _ = solved(core.params, joints, theta, goal, alpha, limit=1, tol=0)
        move, error = space.step(joints, first, goal, alpha)
        assert answer["out_iters"] == 1
        if np.abs(move).max() > 0.45 or np.abs(error).max() * alpha / 32 > 0.24:
            continue
        tip, levers = gradient.spatial(joints)(first)[0], []
        for i in range(n):
            levers.append(np.linalg.norm(goal - gradient.spatial(joints[:i])(first[:i])[0]) if i else
                          np.linalg.norm(goal))
        bound = bounds.space_step(joints, alpha, float(np.linalg.norm(goal - tip)), np.array(levers))
        off = np.abs(truth.difference(second - first, move))
        assert np.all(off <= bound)
        worst.append(np.max(off / bound))
    assert len(worst) > 2 and max(worst) > 0.01


@FIRST
@pytest.mark.parametrize("n", [2, 3, 6, 7])
def test_ends_within_the_bound_after_as_many_iterations_as_float64(core: cores.Core, n: int) -> None:
    ended, tol, limit = 0, 8 * TOL, 150
    for seed in range(6):
        joints, theta, goal, alpha = problem(n, 10 * n + seed)
        found, answer, _ = solved(core.params, joints, theta, goal, alpha, tol=tol, limit=limit)
        count = 0
        while count <= limit and np.abs((given := space.step(joints, theta, goal, alpha))[1]).max() >= tol / space.ONE:
            theta, count = theta + given[0], count + 1
        if answer["out_status"] == 0:
            ended += 1
            assert abs(answer["out_iters"] - count) <= 0.05 * count + 1
            assert np.linalg.norm(gradient.spatial(joints)(found)[0] - goal) <= bounds.space_end(joints, tol)
        else:
            assert answer["out_status"] == space.NOT_CONVERGED and answer["out_iters"] == limit < count + 3
    assert ended > 0


@FIRST
def test_the_planar_example_of_the_paper(core: cores.Core) -> None:
    """Two joints about z, 0.1 m each, here 0.25 units: both of its ends, to a micrometre."""
    joints = [Joint((0.0, 0.0, 1.0), (0.25, 0.0, 0.0))] * 2
    for start, end in (((-100, 30), (27.57151755659676, 98.9007605172044)),
                       ((-50, -50), (126.47227808, -98.90076052))):
        found, answer, _ = solved(core.params, joints, np.radians(start), np.array([0.0292, 0.1267, 0]) * 2.5,
                                  0.33 / 0.25**2, tol=24, limit=1000)
        assert answer["out_status"] == 0
        assert np.abs(truth.difference(found, np.radians(end))).max() < 1e-5
        tip = gradient.spatial(joints)(found)[0] / 2.5
        assert np.linalg.norm(tip - [0.0292, 0.1267, 0]) < 1e-6


@FIRST
def test_joints_stay_unit_vectors(core: cores.Core) -> None:
    """After a thousand steps that never end, out of reach: each (c, s) within two words of length 1."""
    joints, theta, goal, alpha = problem(3, 4)
    alpha /= 8
    goal *= 0.7 / np.linalg.norm(goal)
    found, answer, pairs = solved(core.params, joints, theta, goal, alpha, tol=0)
    assert answer["out_status"] == space.NOT_CONVERGED
    assert np.abs(np.hypot(*pairs.T) - 1).max() * space.ONE < 2.5
    assert np.abs(space.step(joints, found, goal, alpha)[0]).max() < 1e-3  # at the nearest point, or on the way to it


@EACH
def test_never_converged_while_far(core: cores.Core) -> None:
    """Steps of any size, tips that overflow, joints that are no unit vectors: none is called converged that is not."""
    rng, bad = np.random.default_rng(5), 0
    for seed in range(40):
        n = int(rng.integers(1, 9))
        joints = chain(n, seed, 0.5 if n < 4 else 3.5)
        theta = rng.uniform(-3, 3, n)
        goal = gradient.spatial(joints)(theta + rng.normal(size=n) * 0.01)[0].clip(-1.9, 1.9)
        rows = space.loads(joints, theta, float(rng.choice([1, 30, 1000])), goal)
        if seed % 4 == 0:  # twice too long, or short
            rows[-1]["in_word"] >>= 1
        for limit in (0, 1, 3):
            out = run(core.params, rows + space.solve(n) + space.reads(n), 100000, limit)
            pairs = out["out_word"][-2 * n:].reshape(n, 2)
            tip = gradient.spatial(joints)(2 * np.arctan2(pairs[:, 1], pairs[:, 0]))[0]
            if np.linalg.norm(tip - goal) > bounds.space_end(joints, 100000):
                bad += 1
                assert out["out_status"][-2 * n - 1] & space.NOT_CONVERGED
    assert bad > 10


@EACH
def test_bad_inputs_and_the_sample_behind_them(core: cores.Core) -> None:
    """Words that are not there, out of order, above N; limit 0, a step too long: flagged; then as before."""
    p = core.params
    joints, theta, goal, alpha = problem(3, 1)
    load = space.loads(joints, theta, alpha, goal)
    early = space.solve(1) + load[1:2] + space.reads(1)
    good = space.solve(3) + space.reads(3)
    missing = space.solve(4) + space.solve(0) + space.solve(p["N"] + 1) + space.solve(255) + [
        {"in_op": space.WRITE, "in_n": n, "in_k": k, "in_word": 9}
        for n, k in ((0, 4), (4, 1), (p["N"] + 1, 0), (255, 7))]
    out = run(p, early + load + good + missing + space.sets(theta) + good, limit=50)
    status, n = out["out_status"], len(early) + len(load)
    assert np.all(status[:len(early)] == space.NO_JOINT) and not out["out_word"][:len(early)].any()
    assert not status[len(early):n].any() and np.all(status[n + 7:n + 7 + len(missing)] == space.NO_JOINT)
    for words in out.values():
        assert np.array_equal(words[n:n + 7], words[-7:])
    assert solved(p, joints, theta, goal, 1000.0, limit=50)[1]["out_status"] == space.NOT_CONVERGED
    assert solved(p, joints, theta, goal, alpha, limit=0)[1]["out_iters"] == 0


def test_words_that_do_not_fit_are_refused() -> None:
    joints, theta, goal, alpha = problem(2, 1)
    with pytest.raises(ValueError, match="coarser unit"):
        space.loads(joints, theta, 3000.0, goal)
    with pytest.raises(ValueError, match="length 1"):
        space.loads([Joint((1.0, 1.0, 0.0), (0.1, 0.0, 0.0))], theta[:1], alpha)
