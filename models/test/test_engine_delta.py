"""The delta's forward kinematics on the product engine: its model against float64, within the derived bound."""

from __future__ import annotations

import numpy as np
import pytest
from quadrance import cores, engine_delta
from quadrance.bounds import engine as bounds
from quadrance.parallel import delta, geometry
from quadrance.parallel.geometry import PoseError

from tb.engine.delta import MM, scale, words, workspace

CORES = [core for core in cores.all_cores() if core.name == "engine_delta_fk" and not core.params["PIPE"]]
EVERY = pytest.mark.parametrize("core", CORES, ids=lambda core: core.id)
ROBOTS = pytest.mark.parametrize("name", sorted(MM))


def run(core, name: str, alpha: np.ndarray, below: bool = True) -> tuple[dict, np.ndarray, dict, float]:
    """Answer, its tip in LSB, what the words say, the rod in LSB."""
    columns, cfg = words(core, alpha), engine_delta.config(core.params, geometry.load(name), scale(core, name), below)
    answer = core.model(core.params, **columns, **cfg)
    place = np.stack([answer[f"out_{axis}"] for axis in "xyz"], axis=-1)
    return answer, place, engine_delta.exact(core.params, columns, cfg), cfg["cfg_lb"] * 2.0**-engine_delta.MORE


@EVERY
@ROBOTS
@pytest.mark.parametrize("below", [True, False])
def test_tip_and_reach_keep_their_bounds(core, name, below):
    """In the workspace, and with cranks anywhere."""
    rng = np.random.default_rng(3)
    alpha = np.concatenate([workspace(name, 3000, rng), rng.uniform(-np.pi, np.pi, (6000, 3))])
    answer, place, exact, lb = run(core, name, alpha, below)
    law, band = bounds.delta_tip(core.params, exact["elbows"], np.nan_to_num(exact["tip"]), lb)
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


@EVERY
@ROBOTS
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
    _, band = bounds.delta_tip(p, exact["elbows"], np.nan_to_num(exact["tip"]), lb)
    far = (exact["gap"] < -band) & (answer["out_status"] & 6 == 0)
    assert far.sum() > 100 and np.all(answer["out_status"][far] == 1)
    off = np.abs(np.stack([answer[f"out_{axis}"] for axis in "xyz"], axis=-1) - exact["tip"])[far].max(axis=-1) - 0.5
    law = bounds.delta_nearest(p, exact["elbows"][far], lb)
    assert np.all(off <= law) and np.any(off > 0.25 * law)


@ROBOTS
def test_it_is_the_robot(name):
    """Millimetres in the robot's frame against `delta.forward`, whose spheres are worked out another way."""
    core, robot = CORES[0], geometry.load(name)
    alpha = workspace(name, 2000, np.random.default_rng(4))
    alpha = alpha[np.abs(np.diff(alpha[:, [0, 1, 2, 0]])).max(axis=1) < 1.2]
    for below in (True, False):
        answer, *_ = run(core, name, alpha, below)
        assert not np.any(answer["out_status"])
        off = engine_delta.tip(robot, scale(core, name), answer) - delta.forward(robot, alpha, below)
        assert np.abs(off).max() < 0.05, "mm, the cranks' rounding included"


@EVERY
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
    p = CORES[0].params
    with pytest.raises(PoseError, match="must be below 2.15 LSB"):
        engine_delta.config(p, geometry.load("klipper_delta"), 1 / 200)
    with pytest.raises(PoseError, match="three cranks alike"):
        engine_delta.config(p, geometry.load("rotary_stewart"), 1 / 48)


def test_angles_are_their_vectors():
    core, name = cores.find("engine_delta_fk_angle"), "linuxcnc_delta"
    alpha = workspace(name, 1000, np.random.default_rng(5))
    cfg = engine_delta.config(core.params, geometry.load(name), scale(core, name))
    by_angle = core.model(core.params, **words(core, alpha), **cfg)
    by_vector = CORES[0].model(CORES[0].params, **words(CORES[0], alpha), **cfg)
    for axis in "xyz":
        assert np.abs(by_angle[f"out_{axis}"] - by_vector[f"out_{axis}"]).max() <= 3
