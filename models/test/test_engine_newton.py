"""engine_newton_3r at every parameter set, and table_ik3r beside it: both solutions, flags, bounds, bad inputs."""

from __future__ import annotations

import numpy as np
import pytest
from quadrance import bounds, cores, table, truth
from quadrance.bounds import iterative as laws
from quadrance.iterative import newton, newton_fixed

CORES = [core for core in cores.all_cores() if core.name == "engine_newton_3r"]
EACH = pytest.mark.parametrize("core", CORES, ids=lambda core: core.id)
DIRECT = [core for core in cores.all_cores() if core.name == "table_ik3r"]


def words(p: dict[str, int], theta: np.ndarray) -> np.ndarray:
    return np.rint(np.asarray(theta) / truth.TURN * 2 ** p["A"]).astype(np.int64) & 2 ** p["A"] - 1


def angles(p: dict[str, int], answer: dict) -> np.ndarray:
    return np.stack([answer[f"out_j{i}"] for i in (1, 2, 3)], axis=-1) * truth.TURN / 2 ** p["A"]


def orientation(p: dict[str, int], answer: dict) -> np.ndarray:
    return sum(answer[f"out_j{i}"] for i in (1, 2, 3)) % 2 ** p["A"]


def arm(p: dict[str, int], damping: float = 0.0) -> dict[str, int]:
    """Unit links, an eighth of a word each; a tolerance of one unit."""
    length = 1 << p["W"] - 3
    return {"cfg_l1": length, "cfg_l2": length, "cfg_l3": length, "cfg_tol": 256, "cfg_limit": 100} \
        | newton_fixed.config(p, cfg_l1=length, cfg_l2=length, damping=damping)


def lengths(cfg: dict[str, int]) -> np.ndarray:
    return np.array([cfg["cfg_l1"], cfg["cfg_l2"], cfg["cfg_l3"]])


def run(p: dict[str, int], goal: np.ndarray, phi: np.ndarray, start: np.ndarray, cfg: dict, warm: int = 0) -> dict:
    return newton_fixed.solve(p, in_x=goal[..., 0], in_y=goal[..., 1], in_phi=phi, in_j1=start[..., 0],
                              in_j2=start[..., 1], in_warm=warm, **cfg)


def tips(theta: np.ndarray, links: np.ndarray) -> np.ndarray:
    turn = np.cumsum(theta, axis=-1)
    return np.stack([np.cos(turn) @ links, np.sin(turn) @ links], axis=-1)


def on_ray(p: dict[str, int], cfg: dict, goal: list[float]) -> tuple[np.ndarray, np.ndarray]:
    """A target in links, rounded, and the orientation of the paper's third equation."""
    word = np.rint(np.array(goal) * cfg["cfg_l1"]).astype(np.int64)
    return word, words(p, np.arctan2(word[..., 1], word[..., 0]))


def grid() -> np.ndarray:
    """The 8100 starts: theta1 and theta2 in steps of 4 degrees."""
    axis = np.radians(np.arange(0, 360, 4))
    return np.stack([one.ravel() for one in np.meshgrid(axis, axis, indexing="ij")], axis=-1)


@EACH
@pytest.mark.parametrize("damping", [0.0, 2**-8])
def test_grid_of_starts(core: cores.Core, damping: float) -> None:
    """All 8100 converge to one of the two solutions, about as fast as float64; none is wrong without a flag."""
    p = core.params
    cfg, start = arm(p, damping), words(p, grid())
    for goal in ([1.5, 0.0], [-2.2, 0.9], [2.95, 0.0]):
        point, phi = on_ray(p, cfg, goal)
        answer = run(p, point, phi, start, cfg)
        off = np.linalg.norm(tips(angles(p, answer), lengths(cfg)) - point, axis=-1)
        assert not answer["out_status"].any() and not answer["out_coarse"].any()
        assert np.all(answer["out_error"] < 256)
        assert np.all(off <= laws.newton_tip(p, tuple(lengths(cfg)), answer["out_error"]))
        assert np.all(orientation(p, answer) == phi)
        exact = newton.wrist_solve(grid(), point, phi * truth.TURN / 2 ** p["A"], lengths(cfg), damping=damping,
                                   tolerance=4.0 ** (p["W"] - 16), limit=100)
        assert exact.converged.mean() > 0.98
        assert abs(np.median(answer["out_iters"]) - np.median(exact.iterations)) <= 1
        assert np.percentile(answer["out_iters"], 95) <= np.percentile(exact.iterations, 95) + 2


@EACH
def test_the_papers_example(core: cores.Core) -> None:
    """From (60, 30) degrees to (1.5, 0): Table 2 or its mirror image, the third joint by the orientation."""
    p = core.params
    cfg = arm(p) | {"cfg_tol": 16}
    point, phi = on_ray(p, cfg, [1.5, 0.0])
    answer = run(p, point, phi, words(p, np.radians([60, 30])), cfg)
    theta = np.degrees(truth.difference(angles(p, answer), np.zeros(3)))
    table2 = np.array([-75.52248781407, 151.04497562814, -75.52248781407])
    assert answer["out_status"] == 0 and min(np.abs(theta - table2).max(), np.abs(theta + table2).max()) < 0.02


@EACH
def test_every_step_is_newtons_within_the_bound(core: cores.Core) -> None:
    p, near = core.params, []
    cfg, rng = arm(p) | {"cfg_tol": 0, "cfg_limit": 1}, np.random.default_rng(1)
    unit = 2 ** (16 - p["W"])
    links = lengths(cfg) * unit
    for size in (0.0003, 0.01, 0.2):
        theta = np.stack([rng.uniform(-3, 3, 300), rng.uniform(0.6, 2.5, 300) * rng.choice([-1, 1], 300)], axis=-1)
        start, phi = words(p, theta), rng.integers(0, 2 ** p["A"], 300)
        theta, turn = start * truth.TURN / 2 ** p["A"], phi * truth.TURN / 2 ** p["A"]
        third = turn - theta.sum(axis=-1)
        goal = np.rint(tips(np.concatenate([theta, third[:, None]], axis=1), lengths(cfg))
                       + rng.normal(size=(300, 2)) * size * cfg["cfg_l1"]).astype(np.int64)
        answer = run(p, goal, phi, start, cfg)
        wrist = goal * unit - links[2] * np.stack([np.cos(turn), np.sin(turn)], axis=-1)
        exact = theta + newton.wrist_step(theta, wrist, links)[0]
        for i in range(300):
            if np.abs(exact[i] - theta[i]).max() < 1.4:
                off = np.abs(truth.difference(angles(p, answer)[i, :2], exact[i])).max()
                near.append(off / laws.newton_step(p, theta[i], wrist[i], tuple(links)))
    assert len(near) > 700 and 0.1 < max(near) <= 1


@EACH
def test_warm_start_takes_four(core: cores.Core) -> None:
    """A circle of 400 targets, every one from the answer before it."""
    p = core.params
    cfg, turn = arm(p), np.linspace(0, truth.TURN, 400)
    point, phi = on_ray(p, cfg, np.stack([1.5 + 0.2 * np.cos(turn), 0.3 * np.sin(turn)], axis=-1))
    start = words(p, newton.closed([1.7, 0.0], (1, 1, 1))[0])
    answer = run(p, point, phi, np.tile(start, (400, 1)), cfg, np.arange(400) > 0)
    assert not answer["out_status"].any() and answer["out_iters"].max() <= 4 and answer["out_iters"].sum() > 300


@EACH
def test_bad_inputs_and_the_sample_behind_them(core: cores.Core) -> None:
    p = core.params
    cfg = arm(p)
    point, phi = on_ray(p, cfg, [1.5, 0.2])
    start = words(p, np.array([0.3, 0.9]))
    for change, status in (({"cfg_tol": 0, "cfg_limit": 7}, 8), ({"cfg_limit": 0}, 8), ({"cfg_l1": 0}, 10),
                           ({"cfg_l2": 0}, 10), ({"cfg_l1": 0, "cfg_l2": 0, "cfg_l3": 0}, 10)):
        answer = run(p, point, phi, start, cfg | change)
        assert answer["out_status"] == status and answer["out_iters"] == (cfg | change)["cfg_limit"]
    straight = run(p, point, phi, words(p, np.array([[0.3, 0.0], [0.1, np.pi]])), cfg)
    assert not straight["out_status"].any() and np.all(straight["out_iters"] > 1)
    still = run(p, point, phi, words(p, np.array([[0.3, 0.0]])), cfg | {"cfg_limit": 0})
    assert still["out_status"] == 10
    far = np.stack([[3 * cfg["cfg_l1"] + cfg["cfg_l1"] // 3, 0], point])
    both = run(p, far, np.array([0, phi]), np.tile(start, (2, 1)), cfg, np.array([0, 1]))
    assert both["out_status"][0] & 8 and both["out_status"][1] == 0 and both["out_iters"][0] == 100


@EACH
def test_damping_ends_at_the_nearest_point(core: cores.Core) -> None:
    """A tenth of a link out of reach: with damping it stands stretched towards the target; Newton wanders."""
    p = core.params
    turn = np.linspace(0.1, 6.1, 40)
    off = {}
    for damping in (0.0, 0.125):
        cfg = arm(p, damping)
        goal = np.rint(3.1 * cfg["cfg_l1"] * np.stack([np.cos(turn), np.sin(turn)], axis=-1)).astype(np.int64)
        start = words(p, np.stack([turn + 0.5, np.full(40, 0.7)], axis=-1))
        answer = run(p, goal, words(p, turn), start, cfg)
        assert np.all(answer["out_status"] & 8)
        near = 3 * cfg["cfg_l1"] * np.stack([np.cos(turn), np.sin(turn)], axis=-1)
        off[damping] = np.linalg.norm(tips(angles(p, answer), lengths(cfg)) - near, axis=-1).max() / cfg["cfg_l1"]
    assert off[0.125] < 0.002 < 0.1 < off[0.0]


def test_damping_out_of_range_is_refused() -> None:
    for wrong in (-1.0, 2**-10, 0.5):
        with pytest.raises(ValueError, match="damping"):
            newton_fixed.config(CORES[0].params, cfg_l1=9000, cfg_l2=9000, damping=wrong)


@pytest.mark.parametrize("core", DIRECT, ids=lambda core: core.id)
@pytest.mark.parametrize("elbow", [0, 1])
def test_one_pass_is_the_closed_form(core: cores.Core, elbow: int) -> None:
    """The tip is the target but for the errors of the wrist, of the kernel and of words; orientation exact."""
    p, rng = core.params, np.random.default_rng(2)
    length = 1 << p["W"] - 3
    links = np.array([length, length * 4 // 5, length // 2])
    theta = np.stack([rng.uniform(-np.pi, np.pi, 3000), rng.uniform(0.1, 3.0, 3000), rng.uniform(-3, 3, 3000)], axis=-1)
    goal = np.rint(tips(theta, links)).astype(np.int64)
    phi = words(p, theta.sum(axis=-1))
    cfg = table.config(p, cfg_l1=int(links[0]), cfg_l2=int(links[1]))
    answer = table.ik3r(p, in_x=goal[:, 0], in_y=goal[:, 1], in_phi=phi, in_elbow=elbow, cfg_l1=links[0],
                        cfg_l2=links[1], cfg_l3=links[2], **cfg)
    found = angles(p, answer)
    off = np.linalg.norm(tips(found, links) - goal, axis=-1)
    turn = phi * truth.TURN / 2 ** p["A"]
    rho = np.linalg.norm(goal - links[2] * np.stack([np.cos(turn), np.sin(turn)], axis=-1), axis=-1)
    c2 = (rho**2 - (links[:2].astype(float) ** 2).sum()) / (2 * links[0] * links[1])
    inside = (np.abs(c2) < 1) & (answer["out_status"] == 0)
    assert inside.mean() > 0.98 and not (answer["out_status"] & 6).any()
    assert np.all(np.sin(found[:, 1]) * (1 - 2 * elbow) >= -1e-3) and np.all(orientation(p, answer) == phi)
    share = off[inside] / bounds.table.ik3r(p, *links.tolist(), rho[inside], np.sqrt(1 - c2[inside] ** 2))
    assert 0.2 < share.max() <= 1


@pytest.mark.parametrize("core", DIRECT, ids=lambda core: core.id)
def test_one_pass_flags(core: cores.Core) -> None:
    p = core.params
    length, high = 1 << p["W"] - 3, 1 << p["W"] - 1
    cfg = {"cfg_l1": length, "cfg_l2": length, "cfg_l3": length} | table.config(p, cfg_l1=length, cfg_l2=length)
    half = 1 << p["A"] - 1
    answer = table.ik3r(p, in_x=np.array([length * 3 // 2, length, high - 1, high - 1]), in_y=0, in_elbow=0,
                        in_phi=np.array([0, 0, 0, half]), **cfg)
    assert answer["out_status"].tolist() == [0, 2, 1, 5]
