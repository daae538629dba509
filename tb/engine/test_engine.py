"""Benches of engines beyond those of every core: samples in order, chains of a hundred joints."""

import numpy as np
import pytest
from quadrance.cores import all_cores, find
from quadrance.iterative import gradient, plane, space

from tb.engine.space import chain
from tb.lib import bulk, suite
from tb.lib.simulate import simulate

IN_ORDER = "engine_quaternion_gd_plane", "engine_quaternion_gd_n", "engine_rus_fk"
CHAINS = [core for core in all_cores() if core.name in IN_ORDER]


@pytest.mark.full
@pytest.mark.parametrize("core", [core for core in CHAINS if core.first_set], ids=lambda core: core.id)
def test_chains_in_order(core):
    """Samples that build on each other: the bulk run has them all, the benches that know X leave most of them out."""
    simulate(core, suite.simulators()[0], module="tb.engine.in_order", seed=suite.SEED)


def _hundred(name, rows, cfg):
    """Steps and clocks of the solution among the samples of a chain of 100 joints, core and model alike."""
    core = find(name)
    inputs = {port.name: np.array([row[port.name] for row in rows]) for port in core.inputs}
    result = bulk.stream(core, inputs, cfg)
    bulk.compare(core, inputs, cfg, result)
    at = int(np.flatnonzero(inputs["in_op"] == 0)[0])
    assert result.outputs["out_status"][at] == 0
    return int(result.outputs["out_iters"][at]), int(result.latency[at])


@pytest.mark.slow
def test_a_hundred_joints_in_the_plane():
    """An arc to another arc, to 8 LSB of a reach of 2^17."""
    core, n = find("engine_quaternion_gd_plane-N100"), 100
    links = np.full(n, 1310)
    theta = np.full(n, np.pi / 200)
    cfg = plane.config(core.params, 1.6 / (np.cumsum(links) ** 2).sum()) | {"cfg_tol": 16384, "cfg_limit": 1000}
    goal = np.rint(gradient.planar(*links)(theta * 1.3)[0]).astype(int)
    words = np.rint(theta / (2 * np.pi) * 2 ** core.params["A"]).astype(int)
    iters, clocks = _hundred(core.id, plane.loads(core.params, links, words) + plane.solve(n, *goal), cfg)
    assert iters < 500 and clocks % (3 * n + 6) == 4


@pytest.mark.slow
def test_a_hundred_joints_in_space():
    """Any axes and links, to 2^-15 of the unit of length on each axis."""
    n, rng = 100, np.random.default_rng(8)
    joints, theta = chain(n, rng), rng.uniform(-1, 1, n)
    kinematics = gradient.spatial(joints)
    goal = kinematics(theta + rng.normal(size=n) * 0.2)[0]
    alpha = 0.8 / np.linalg.norm(kinematics(theta)[1], ord=2) ** 2
    rows = space.loads(joints, theta, alpha, goal) + space.solve(n)
    iters, clocks = _hundred("engine_quaternion_gd_n-N100", rows, {"cfg_tol": 1024, "cfg_limit": 1000})
    assert iters < 500 and clocks == 14 + (iters + 1) * (30 * n + 11)
