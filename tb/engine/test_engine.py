"""Benches of engines beyond those of every core: samples in order, chains of a hundred joints, the haptic circle."""

import numpy as np
import pytest
from quadrance.cores import all_cores, find
from quadrance.iterative import convergence, engines, gradient, plane, space, track

from tb.engine.space import chain
from tb.lib import bulk, suite
from tb.lib.simulate import simulate
from tb.lib.suite import SEED, simulators

IN_ORDER = "engine_quaternion_gd_plane", "engine_quaternion_gd_n", "engine_rus_fk"
CHAINS = [core for core in all_cores() if core.name in IN_ORDER]


@pytest.mark.full
@pytest.mark.parametrize("core", [core for core in CHAINS if core.first_set], ids=lambda core: core.id)
def test_chains_in_order(core):
    """Samples that build on each other: the bulk run has them all, the benches that know X leave most of them out."""
    simulate(core, suite.simulators()[0], module="tb.engine.in_order", seed=suite.SEED)


@pytest.mark.full
@pytest.mark.parametrize("core", [core for core in CHAINS if core.name == "engine_quaternion_gd_n" and core.first_set],
                         ids=lambda core: core.id)
def test_words_written_behind_a_reset_in_a_solution_are_kept(core):
    """Lines that are on their way write in the same clocks, and a sample goes before them."""
    joints, pairs, cfg = chain(1, np.random.default_rng(5)), 32, {"cfg_tol": 0, "cfg_limit": 1000}
    reads = [space.reads(1)[0] | {"in_n": 0, "in_k": k} for k in range(3)]

    def columns(rows):
        return {port.name: np.array([row[port.name] for row in rows]) for port in core.inputs}

    starts = [columns(space.loads(joints, [1.0], 0.5, goal) + reads) for goal in ((0.3, -0.2, 0.1), (-0.1, 0.4, 0.2))]
    first = {name: np.tile(np.concatenate([start[name] for start in starts]), pairs) for name in starts[0]}
    rounds = np.stack([np.arange(2 * pairs) + 40, np.zeros(2 * pairs, int)], axis=1)
    result = bulk.resets(core, first, columns(space.solve(1)), rounds, cfg, seed=SEED)
    answers = np.concatenate([bulk.expected(core, start, cfg)["out_word"] for start in starts])
    assert np.array_equal(result.outputs["out_word"], np.tile(answers, pairs))


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
@pytest.mark.parametrize("name, begin, joint, judged", [("N100", 11, 30, 14), ("PIPE1N100", 42, 35, 12)])
def test_a_hundred_joints_in_space(name, begin, joint, judged):
    """Any axes and links, to 2^-15 of the unit of length on each axis."""
    n, rng = 100, np.random.default_rng(8)
    joints, theta = chain(n, rng), rng.uniform(-1, 1, n)
    kinematics = gradient.spatial(joints)
    goal = kinematics(theta + rng.normal(size=n) * 0.2)[0]
    alpha = 0.8 / np.linalg.norm(kinematics(theta)[1], ord=2) ** 2
    rows = space.loads(joints, theta, alpha, goal) + space.solve(n)
    iters, clocks = _hundred(f"engine_quaternion_gd_n-{name}", rows, {"cfg_tol": 1024, "cfg_limit": 1000})
    assert iters < 500 and clocks == judged + (iters + 1) * (joint * n + begin)


# The haptic circle; the clocks of a pass, which `quadrance track` and the report name

EACH = pytest.mark.parametrize("core", [
    pytest.param(core, id=core.id, marks=pytest.mark.full if core.first_set else pytest.mark.slow)
    for core in all_cores() if core.name in engines.EXAMPLES])
TURN = round(2 * np.pi / track.OMEGA / track.PERIOD)


def run(core, simulator: str, counts, samples: int) -> None:
    simulate(core, simulator, module="tb.engine.track", seed=SEED,
             plusargs=[f"+counts={','.join(map(str, counts))}", f"+samples={samples}"])


@pytest.mark.parametrize("simulator", simulators())
@EACH
def test_some_samples(core, simulator):
    run(core, simulator, track.COUNTS, 8)


@pytest.mark.slow
@pytest.mark.parametrize("count", track.COUNTS)
@EACH
def test_a_turn(core, count):
    run(core, "verilator", [count], TURN)


@EACH
def test_clocks_of_a_pass(core):
    """From starts of the whole grid: some of them, or all, change the range of the error and take passes more."""
    pick = np.random.default_rng(1).choice(8100, 60)
    inputs, cfg = convergence.by_example(core)
    inputs = {port: words[pick] for port, words in inputs.items()}
    result = bulk.stream(core, inputs, cfg)
    bulk.compare(core, inputs, cfg, result)
    each, early = engines.EXAMPLES[core.name].clocks(core)
    passes, rest = np.divmod(result.latency + early, each)
    more = passes - 1 - result.outputs["out_iters"]
    assert not rest.any() and np.all(more >= 0) and np.any(more > 0)


NEWTON = "engine_newton_3r", "engine_quaternion_dls"


@pytest.mark.parametrize("core", [core for core in all_cores() if core.name in NEWTON], ids=lambda core: core.id)
def test_clocks_of_a_newton_step(core):
    """Every pass but the first is a step, and all have the same clocks."""
    pick = np.random.default_rng(1).choice(8100, 60)
    inputs, cfg = convergence.ENTRIES[core.name].samples(core)
    inputs = {port: words[pick] for port, words in inputs.items()}
    result = bulk.stream(core, inputs, cfg)
    bulk.compare(core, inputs, cfg, result)
    assert np.array_equal(result.latency, (16 + 7 * core.params["PIPE"]) * (result.outputs["out_iters"] + 1) + 3)
