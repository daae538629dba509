"""The choice among eight branches in joint words of the machine, from its page; and in float64 on many poses."""

from __future__ import annotations

import math
import random

import numpy as np
import pytest
from quadrance import arms, cores, keep, six, truth_six, truth_ur, ur
from quadrance.cli import around
from quadrance.cli.verilog import config

from models.test.oracles import Row, ask, oracle
from tb.stimulus import keep as stimulus

KEEPS = ("keep.six_keep", "keep.ur_keep")
JOINTS = range(1, 7)
WORDS = [f"{name}{i}" for name in ("z", "low", "high", "w") for i in JOINTS]


def chosen(branches: list[tuple[list[int], int]], cfg: Row, a: int, last: list[int]) -> tuple[Row, list[int]]:
    """The answer to a sample from the angles and the reach of its branches, every turn of every joint tried."""
    turn, keys = 1 << a, []
    for number, (angles, far) in enumerate(branches):
        words, fits, cost = [], True, 0
        for i in JOINTS:
            angle = angles[i - 1] + (angles[i - 2] if i > 1 and cfg["coupled"] >> i - 2 & 1 else 0)
            word = (-angle if cfg["turned"] >> i - 1 & 1 else angle) + cfg[f"z{i}"]
            all_turns = [word % turn + n * turn for n in range(-12, 12)]
            nearest = min(all_turns, key=lambda one, at=last[i - 1]: (abs(one - at), one))
            low, high = (cfg[f"{name}{i}"] * 2.0 ** (a - 12) for name in ("low", "high"))
            inside = [one for one in (nearest, nearest - turn, nearest + turn) if low <= one <= high]
            fits &= bool(inside)
            words.append(inside[0] if inside else nearest)
            cost += cfg[f"w{i}"] * abs(words[-1] - last[i - 1])
        keys.append((not fits, far, cost, number, words))
    beyond, far, _, number, words = min(keys)
    answer = {f"j{i}": word for i, word in zip(JOINTS, words)} | {"branch": number, "beyond": int(beyond)}
    return answer, last if beyond else words


def turned_over(core: cores.Core, branch: int) -> tuple[set[int], set[int]]:
    """Joints of a branch whose sine is negated, and those whose vector is, from the pages of the inverses."""
    other = branch >> 2
    if core.function == "six_keep":
        return {5} if other else set(), {4, 6} if other else set()
    return ({3} if branch >> 1 & 1 else set()) | ({5} if other else set()), {6} if other else set()


def angles_of(core: cores.Core, rows: list[Row], cfg: Row) -> tuple[list[Row], list[list[list[int]]]]:
    """Answers of the core with all branches, and each row's angles by branch and joint.

    A vector is the engine's, rounded down, and half a unit more. Rounded to nearest it is that of the answer.
    """
    p, (_, inverse) = core.params, stimulus.all_branches(core)
    own = {port.name[4:]: cfg[port.name[4:]] for port in inverse.cfg}
    ports = {f"in_{name}": np.array([row[name] for row in rows]) for name in rows[0]}
    ports |= {f"cfg_{name}": word for name, word in own.items()}
    solver = six if core.function == "six_keep" else ur
    found = solver.solved(p, **ports)
    everything, u, vectors, halves = ask(inverse, rows, own), min(p["U"], 17), [], []
    for number, answer in enumerate(everything):
        for branch in range(8):
            mirrored, opposite = turned_over(core, branch)
            for i in JOINTS:
                c, n = (int(found.words[f"{letter}{i}{solver.named(branch)[i - 1]}"][number]) for letter in "cn")
                signs = -1 if i in opposite else 1, -1 if i in opposite | mirrored else 1
                nearest = [(sign * word + (1 << 24 - p["U"])) >> 25 - p["U"] for sign, word in zip(signs, (c, n))]
                assert all((one - answer[f"{letter}{i}{branch}"]) % (4 << p["U"]) == 0
                           for letter, one in zip("cn", nearest))
                sine = 2 * (n >> 25 - u) + 1
                vectors.append({"c": 2 * (c >> 25 - u) + 1, "n": -sine if i in mirrored else sine})
                halves.append(1 << p["A"] - 1 if i in opposite else 0)
    codec = cores.at(cores.find("vector_to_angle"), {"U": u + 1, "A": p["A"], "PIPE": 0})
    angles = iter([one["j"] + half for one, half in zip(ask(codec, vectors), halves)])
    return everything, [[[next(angles) for _ in JOINTS] for _ in range(8)] for _ in rows]


@oracle(*KEEPS, status=("unreachable", "singular", "no_rotation"), cfg=("turned", "coupled", *WORDS))
def test_the_best_of_eight(core):
    """Order, ties, turns and memory of the choice, sample behind sample, at limits that cut and at none.

    The branches are those of the core that answers all of them; their joints become angles by vector_to_angle.
    """
    rng, seen = random.Random(8), set()
    for words in stimulus.configs(core, np.random.default_rng(3))[:10]:
        cfg = {name[4:]: word for name, word in words.items()}
        if any(cfg[f"low{i}"] > min(0, cfg[f"high{i}"]) for i in JOINTS):
            continue
        columns = stimulus.corners(core, words)
        size = next(iter(columns.values())).size
        rows = [{name[3:]: int(column[i]) for name, column in columns.items()} for i in rng.sample(range(size), 90)]
        last = [0] * 6
        for answer, one, angles in zip(ask(core, rows, cfg), *angles_of(core, rows, cfg)):
            branches = [(angles[b], one["far"] >> b & 1) for b in range(8)]
            want, last = chosen(branches, cfg, core.params["A"], last)
            branch = want["branch"]
            want["status"] = (one["far"] >> branch & 1) + 2 * (one["held"] >> branch & 1) + (one["status"] & 8)
            assert answer == want
            seen.add((answer["beyond"], answer["status"] & 1))
    assert len(seen) >= 3


@oracle(*KEEPS, cfg=("turned", "coupled", *WORDS))
def test_a_limit_that_is_met_exactly_is_kept(core):
    """Limits are inclusive, in the turn of a joint and in the next one; a joint that misses one by 2^-12 turn does not
    fit.
    """
    fits, start = [], stimulus.configs(core, np.random.default_rng(3))[0]
    for words in stimulus.edges(core, start):
        cfg = {name[4:]: word for name, word in words.items()}
        assert all(cfg[f"low{i}"] <= 0 <= cfg[f"high{i}"] for i in JOINTS)
        row = {name[3:]: int(column[0]) for name, column in stimulus.corners(core, words).items()}
        (every,), (angles,) = angles_of(core, [row], cfg)
        branches = [(angles[b], every["far"] >> b & 1) for b in range(8)]
        want, _ = chosen(branches, cfg, core.params["A"], [0] * 6)
        answer, = ask(core, [row], cfg)
        assert {name: answer[name] for name in want} == want
        fits.append((want["branch"], want["beyond"]) == (0, 0))
    assert fits == [True] * 2 + [False] * 6


@oracle(*KEEPS, cfg=("turned", "coupled", *WORDS))
def test_words_of_a_machine(core):
    """A bit a joint; zeros modulo a turn, to nearest; limits inwards to 2^-12 turn; the largest weight is 63."""
    a, turn = core.params["A"], 2 * math.pi
    found = keep.machine(core.params, turned=[1, 0, 0, 1, 0, 0], coupled=[0, 0, 1, 0, 0, 1],
                        zeros=[0.1, -0.1, 3.0, -3.0, 7.0, 0], weights=[1, 2, 4, 3, 0, 0.5],
                        limits=[(-1, 1), (-turn, turn), (0, 0.3), (-turn / 2, turn / 4), (-9, 9), (-0.001, 0.001)])
    assert (found["cfg_turned"], found["cfg_coupled"]) == (0b001001, 0b10010)
    for i, zero in enumerate([0.1, -0.1, 3.0, -3.0, 7.0, 0], 1):
        assert abs(math.remainder(found[f"cfg_z{i}"] / 2**a * turn - zero, turn)) <= turn / 2 ** (a + 1)
        assert 0 <= found[f"cfg_z{i}"] < 2**a
    assert [found[f"cfg_low{i}"] for i in JOINTS] == [-651, -4096, 0, -2048, -5867, 0]
    assert [found[f"cfg_high{i}"] for i in JOINTS] == [651, 4096, 195, 1024, 5867, 0]
    assert [found[f"cfg_w{i}"] for i in JOINTS] == [16, 32, 63, 47, 0, 8]


TURN = 2 * math.pi
# Limits (degrees) and speeds (degrees a second) of the makers' data sheets; those of the IRB 2400 and its lengths as in
# ROS-Industrial's abb_irb2400_support (12/1.55) and opw_kinematics
MACHINES = {
    "kr6_r700": ([(-170, 170), (-190, 45), (-120, 156), (-185, 185), (-120, 120), (-350, 350)],
                 [360, 300, 360, 381, 388, 615]),
    "staubli_tx40": ([(-180, 180), (-125, 125), (-138, 138), (-270, 270), (-120, 133.5), (-270, 270)],
                     [555, 475, 585, 1035, 1135, 1575]),
    "ur5e": ([(-360, 360)] * 6, [180] * 6),
    "irb2400": ([(-180, 180), (-100, 110), (-60, 65), (-200, 200), (-120, 120), (-400, 400)],
                      [150, 150, 150, 360, 360, 450]),
}


IRB2400 = truth_six.Six(a1=100, a2=-135, b=0, c1=615, c2=705, c3=755, c4=85)


@pytest.mark.parametrize("count", [2_500, pytest.param(25_000, marks=pytest.mark.slow)])
@pytest.mark.parametrize("name", MACHINES)
def test_the_choice_is_that_of_a_selector_in_float64(name, count):
    """Poses on paths and jumps between them: the branch, and the joint words to a few LSB.

    The selector has the directions of the core's vectors in float64, tries every turn within the limits, and remembers
    its own answer. Where two branches cost the same to what the words resolve, either is right: they are few.
    """
    rng = np.random.default_rng(5)
    parallelogram = name == "irb2400"
    arm = arms.load("kr6_r700" if parallelogram else name)
    core = cores.find("ur_keep" if name == "ur5e" else "six_keep")
    truth, load = (truth_ur.fk, truth_ur.load) if name == "ur5e" else (truth_six.fk6, truth_six.load)
    lengths, mm = (IRB2400, 20.0) if parallelogram else load(arm.id)
    known = around.joints(core, arm)
    signs = np.array([joint.sign for joint, _ in known], float)
    zeros = np.radians([-joint.sign * joint.zero for joint, _ in known])
    coupled = np.array([0, 0, 1, 0, 0, 0]) if parallelogram else np.zeros(6, int)
    if parallelogram:
        signs, zeros = np.ones(6), np.radians([0, 0, -90, 0, 0, 0.0])
    limits, weights = np.radians(MACHINES[name][0]), 1 / np.array(MACHINES[name][1], float)
    words = config(core, arm) | keep.machine(core.params, turned=signs < 0, coupled=coupled, zeros=zeros,
                                             limits=limits, weights=weights)
    if parallelogram:
        words |= six.config(core.params, **{key: length / mm for key, length in lengths._asdict().items()}, margin=0.0,
                            slack=0.0)
    # joints of the core on a path, with jumps; then the poses as words
    q = np.cumsum(rng.normal(size=(count, 6)) * 0.02, axis=0) + np.repeat(rng.uniform(-3, 3, (count // 50, 6)), 50, 0)
    rotation, tip = truth(q, type(lengths)(*(length / mm for length in lengths)))
    p, far = core.params, 2.0 ** (core.params["W"] - 1) - 1
    ports = {f"in_r{i + 1}{k + 1}": np.rint(rotation[:, i, k] * 2 ** p["U"]) for i in range(3) for k in range(3)}
    ports |= {f"in_{axis}": np.clip(np.rint(tip[:, i] * 2 ** p["F"]), -far, far) for i, axis in enumerate("xyz")}
    ports = {key: word.astype(np.int64) for key, word in ports.items()}
    found = core.model(p, **ports, **words)
    _, inverse = stimulus.all_branches(core)
    every = inverse.model(inverse.params, **ports, **{port.name: words[port.name] for port in inverse.cfg})
    angles = np.stack([[np.arctan2(every[f"out_n{i}{b}"], every[f"out_c{i}{b}"]) for i in JOINTS] for b in range(8)])
    angles = np.moveaxis(angles, -1, 0)  # sample, branch, joint
    angles[..., 1:] += angles[..., :-1] * coupled[1:]
    theta = signs * angles + zeros
    low, high = (np.array([words[f"cfg_{end}{i}"] for i in JOINTS]) * TURN / 4096 for end in ("low", "high"))
    weight = np.array([words[f"cfg_w{i}"] for i in JOINTS], float)
    unreachable = every["out_far"][:, None] >> np.arange(8) & 1
    unit = TURN / 2 ** p["A"]
    turns, last, close = TURN * np.arange(-4, 5)[:, None, None], np.zeros(6), 0
    for k in range(count):
        nearest = theta[k] + TURN * np.rint((last - theta[k]) / TURN)
        tried = nearest + turns
        step = np.where((tried >= low - 1e-12) & (tried <= high + 1e-12), np.abs(tried - last), np.inf)
        at = step.argmin(0)
        fits = np.isfinite(step.min(0)).all(1)
        answer = np.where(np.isfinite(step.min(0)), np.take_along_axis(tried, at[None], 0)[0], nearest)
        cost = (np.abs(answer - last) * weight).sum(1)
        best = np.lexsort((np.arange(8), cost, unreachable[k], ~fits))[0]
        got = int(found["out_branch"][k])
        words_of = np.array([found[f"out_j{i}"][k] for i in JOINTS]) * unit
        # what a word resolves: the rounding of the codec, of this answer and of the last one
        room = 6 * unit * weight.sum()
        edge = np.abs(np.stack([nearest - low, nearest - high, *(np.abs(nearest - last) - TURN / 2,)])).min() < 4 * unit
        if got != best or fits[best] == bool(found["out_beyond"][k]):
            assert edge or (fits[got], unreachable[k][got]) == (fits[best], unreachable[k][best]) and abs(
                cost[got] - cost[best]) < room, k
            close += 1
        else:
            off = np.abs(words_of - answer[best])
            assert edge or off.max() < 3 * unit, k
        if not found["out_beyond"][k]:
            last = words_of
    assert close < count / 500, close
    assert len(np.unique(found["out_branch"])) == 8
    assert found["out_beyond"].mean() < 0.9 and found["out_beyond"].any() == (name != "ur5e")
