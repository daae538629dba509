"""engine_quaternion_gd_plane at every parameter set: golden iterates, one step, where it ends, flags, bad inputs."""

from __future__ import annotations

import numpy as np
import pytest
from quadrance import cores, truth
from quadrance.bounds import iterative as bounds
from quadrance.iterative import fixed, gradient, plane

from models.test.claims import distinct

CORES = [core for core in distinct() if core.name == "engine_quaternion_gd_plane"]
EACH = pytest.mark.parametrize("core", CORES, ids=lambda core: core.id)
LIMIT = 1000


def words(p: dict[str, int], theta: np.ndarray) -> np.ndarray:
    return np.rint(np.asarray(theta) / truth.TURN * 2 ** p["A"]).astype(np.int64) & 2 ** p["A"] - 1


def angles(p: dict[str, int], joints: np.ndarray) -> np.ndarray:
    return np.asarray(joints) * truth.TURN / 2 ** p["A"]


def alpha(links: np.ndarray, share: float = 0.8) -> float:
    """A share of the greatest step that is stable at full stretch."""
    return share * 2 / (np.cumsum(links[::-1]) ** 2).sum()


def arm(p: dict[str, int], n: int, share: float = 0.8, bits: int = 2) -> tuple[np.ndarray, dict[str, int]]:
    """Equal links that reach 2^(W - bits) LSB, and the words of the step."""
    links = np.full(n, (1 << p["W"] - bits) // n)
    return links, plane.config(p, alpha(links, share)) | {"cfg_tol": 256, "cfg_limit": LIMIT}


def run(p: dict[str, int], rows: list[dict[str, int]], cfg: dict[str, int]) -> dict[str, np.ndarray]:
    return plane.gd(p, **{name: np.array([row[name] for row in rows]) for name in rows[0]}, **cfg)


def solved(p: dict[str, int], links: np.ndarray, start: np.ndarray, goal: np.ndarray,
           cfg: dict[str, int]) -> dict[str, np.ndarray]:
    """Answers from the starts (m, n) to the goals (m, 2): joints (m, n), iters, error, coarse, status."""
    m, n = start.shape
    rows = plane.loads(p, links, start[0])
    for one, end in zip(start, goal):
        rows += plane.sets(one) + plane.solve(n, *end)
    out = {name[4:]: words[n:].reshape(m, 2 * n + 1) for name, words in run(p, rows, cfg).items()}
    assert not out["status"][:, :n].any() and np.array_equal(out["j"][:, n], out["j"][:, n + 1])
    return {name: words[:, n] for name, words in out.items()} | {"j": out["j"][:, n + 1:]}


def off_target(p: dict[str, int], links: np.ndarray, joints: np.ndarray, goal: np.ndarray) -> np.ndarray:
    return np.linalg.norm(gradient.planar(*links)(angles(p, joints))[0] - goal, axis=-1)


def reachable(links: np.ndarray, count: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Starts and targets, of arms bent by 0.2 to 1.2 in every joint but the first."""
    rng = np.random.default_rng(seed)
    start, theta = (rng.uniform(0.2, 1.2, (count, links.size)) * 2.2 / max(links.size, 2) for _ in range(2))
    start[:, 0], theta[:, 0] = rng.uniform(-np.pi, np.pi, (2, count))
    theta[:, 0] = start[:, 0] + rng.uniform(-1, 1, count)
    return start, np.rint(gradient.planar(*links)(theta)[0]).astype(np.int64)


@EACH
@pytest.mark.parametrize("start", [(-100, 30), (-50, -50)])
def test_golden_iterates(core: cores.Core, start: tuple[int, int]) -> None:
    """The paper's iterates of two joints within the derived bound: thirty from 16 bits on, ten at 14."""
    p = core.params
    links = np.full(2, 1 << p["W"] - 3)
    cfg = plane.config(p, 0.33 / links[0] ** 2) | {"cfg_tol": 0}
    first, goal = words(p, np.radians(start)), np.rint(np.array([0.0292, 0.1267]) / 0.1 * links[0]).astype(np.int64)
    last, far = 30 if p["W"] >= 16 else 10, []
    path, off = bounds.plane_drift(p, links, first, goal, cfg, last)
    for limit in (1, 2, 3, 5, 10, 20, 30)[:None if last == 30 else -2]:
        answer = solved(p, links, first[None], goal[None], cfg | {"cfg_limit": limit})
        assert answer["iters"] == limit and answer["status"] == plane.NOT_CONVERGED
        far.append(np.linalg.norm(truth.difference(angles(p, answer["j"][0]), path[limit])) / off[limit])
    assert 0 < max(far) <= 1


@EACH
def test_one_step_is_within_its_bound(core: cores.Core) -> None:
    """Any joints, targets and links whose error fits the coarse range: against alpha E J in float64."""
    p, rng, worst = core.params, np.random.default_rng(3), []
    for n in {1, 2, 3, min(7, p["N"]), p["N"]}:
        for near in (True, False):
            links = np.floor(rng.dirichlet(np.full(n, 3.0)) * (1 << p["W"] - 2)).astype(np.int64)
            cfg = plane.config(p, alpha(links, 0.5)) | {"cfg_tol": 0, "cfg_limit": 1}
            start = words(p, rng.uniform(-np.pi, np.pi, (5, n)))
            goal = gradient.planar(*links)(angles(p, start))[0] + rng.normal(size=(5, 2)) * 2.0 ** (p["W"] - 8) \
                if near else rng.uniform(-0.9, 0.9, (5, 2)) * 2.0 ** (p["W"] - 2)
            goal = np.rint(goal).astype(np.int64)
            answer = solved(p, links, start, goal, cfg)
            moved, error = gradient.step(gradient.planar(*links), angles(p, start), goal,
                                         fixed.alpha(p, cfg["cfg_alpha"], cfg["cfg_shift"]))
            for joints, first, move, gap in zip(answer["j"], start, moved, error):
                fine = np.abs(gap).max() < 2.0 ** (p["W"] - 5) - 8
                bound = bounds.plane_step(p, links, cfg, gap, 1 / 64 if fine else 1 / 4)
                off = truth.difference(angles(p, joints - first), move)
                assert np.all(np.abs(off) <= bound)
                worst.append(np.max(np.abs(off) / bound))
    assert max(worst) > 0.02  # the bound is not idle


@EACH
@pytest.mark.parametrize("n", [2, 3, 6, 7])
def test_takes_as_many_iterations_as_float64_and_ends_within_the_bound(core: cores.Core, n: int) -> None:
    p = core.params
    if n > p["N"]:
        return
    links, cfg = arm(p, n)
    cfg["cfg_tol"] = 1024
    start, goal = reachable(links, 24, n)
    first = words(p, start)
    answer = solved(p, links, first, goal, cfg)
    exact = gradient.solve(gradient.planar(*links), angles(p, first), goal, tolerance=4.0, limit=LIMIT,
                           alpha=fixed.alpha(p, cfg["cfg_alpha"], cfg["cfg_shift"]))
    done = answer["status"] == 0
    assert done.mean() > 0.9 and not answer["coarse"][done].any() and np.all(answer["error"][done] < 1024)
    bound = bounds.tip(p, *links, square=answer["error"], cut=n + 1 >> 1)
    assert np.all(off_target(p, links, answer["j"], goal)[done] <= bound[done])
    median = np.median(exact.iterations)
    assert abs(np.median(answer["iters"]) - median) <= 0.05 * median + 0.5


@EACH
def test_out_of_reach_is_flagged_at_the_nearest_point(core: cores.Core) -> None:
    p = core.params
    links, cfg = arm(p, 3, 0.3)
    start, _ = reachable(links, 6, 8)
    goal = np.rint(1.2 * links.sum() * np.stack([np.cos(start[:, 0] + 0.5), np.sin(start[:, 0] + 0.5)], axis=-1))
    answer = solved(p, links, words(p, start), goal.astype(np.int64), cfg)
    assert np.all(answer["status"] == plane.NOT_CONVERGED) and np.all(answer["iters"] == LIMIT)
    assert off_target(p, links, answer["j"], goal / 1.2).max() < 8


@EACH
def test_never_converged_while_far(core: cores.Core) -> None:
    """Errors of every size up to the greatest there is: none that saturates or wraps is called converged."""
    p, rng = core.params, np.random.default_rng(4)
    size, cfg = 1 << p["W"] - 1, {"cfg_alpha": 1, "cfg_shift": 0, "cfg_tol": 2**22 - 1, "cfg_limit": 0}
    for n in (1, p["N"]):
        for length in (2 * size - 1, size, size // n, 0):
            links = np.full(n, length)
            start = rng.integers(0, 2 ** p["A"], (300 // n, n))
            start[::2, 1:] = 0
            goal = rng.integers(-size, size, (len(start), 2))
            answer = solved(p, links, start, goal, cfg)
            far = off_target(p, links, answer["j"], goal) > 2**22**0.5 / 16 + 4 + n * (1 + length * 2.0 ** (2 - p["W"]))
            assert far.any() and np.all(answer["status"][far] == plane.NOT_CONVERGED)


@EACH
def test_bad_inputs_and_the_sample_behind_them(core: cores.Core) -> None:
    """Links that are not there, tolerance 0, limit 0, a start along the arm, a step too long: flagged."""
    p = core.params
    links, cfg = arm(p, 3)
    start, goal = reachable(links, 1, 5)
    first, most = words(p, start[0]), p["N"]
    good = plane.loads(p, links, first) + plane.solve(3, *goal[0])
    bad = [plane.solve(2, 1, 1)[0], plane.loads(p, [5], [5], 2)[0]]  # nothing is loaded yet
    again = plane.sets(first) + plane.solve(3, *goal[0])
    between = [plane.solve(n, 5, 5)[0] for n in (0, 4, most + 1, 255)] + plane.loads(p, [9], [9], most + 1) \
        + plane.loads(p, [9], [9], 0) + plane.sets(np.zeros(4, dtype=int))[3:]
    out = run(p, bad + good + between + again, cfg)
    flags = out["out_status"]
    assert np.all(flags[:2] == plane.NO_LINK) and not flags[2:9].any()
    assert np.all(flags[9:9 + len(between)] == plane.NO_LINK) and not out["out_j"][9:9 + len(between)].any()
    for name, found in out.items():
        assert np.array_equal(found[5:9], found[-4:]), name
    for change, steps in (({"cfg_tol": 0, "cfg_limit": 7}, 7), ({"cfg_limit": 0}, 0),
                          ({"cfg_alpha": (2 << p["W"]) - 1, "cfg_shift": 0, "cfg_limit": 50}, 50)):
        answer = solved(p, links, words(p, start), goal, cfg | change)
        assert answer["status"] == plane.NOT_CONVERGED and answer["iters"] == steps
    line = solved(p, links, np.zeros((1, 3), dtype=int), np.array([[links[0], 0]]), cfg | {"cfg_limit": 5})
    assert line["status"] == plane.NOT_CONVERGED


def test_a_step_without_a_word_is_refused() -> None:
    for wrong in (1.0, 1e-18):
        with pytest.raises(ValueError, match="unit of length"):
            plane.config(CORES[0].params, wrong)
