"""Corners of rtl/srs: poses of the robots on all branches, every singularity, out of reach, matrices that are none."""

from __future__ import annotations

import numpy as np
from quadrance import srs, truth_srs
from quadrance.cores import Core
from quadrance.product_engine import H
from quadrance.program import meaning
from quadrance.six import AXES
from quadrance.truth_srs import Srs

from tb.lib import stimulus
from tb.lib.stimulus import Vectors
from tb.stimulus import edges


def arms(core: Core) -> list[Srs]:
    """Robots as large as the word, lengths of either sign, of zero and of a word's range."""
    units = 2.0 ** (core.params["W"] - 1 - core.params["F"])
    share = [(0, 0.1, 0.2, 0), (-0.1, 0.3, 0.3, -0.125), (0.3, 0.4, 0.1, 0.25), (0, 0, 0, 0), (0.01, 0.01, 0.01, 0.01),
             (0, 0.99, 0.99, 0.2)]
    found = [Srs(*(length / mm * units / 128 for length in one)) for one, mm in map(truth_srs.load, truth_srs.known())]
    return found + [Srs(*(units * part for part in one)) for one in share]


def configs(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """Words of `arms`; a slack below 0; then the extremes of every length."""
    found = [srs.config(core.params, **arm._asdict()) for arm in arms(core)]
    found = edges.with_words(core, rng, [found[0], *found])
    lengths = {port.name: (port.low, port.high) for port in core.cfg if port.signed}
    extremes = [{name: both[way] for name, both in lengths.items()} for way in (0, 1)]
    return [*found, *(found[0] | more for more in ({"cfg_slack": lengths["cfg_slack"][0]}, *extremes))]


def draw(core: Core, rng: np.random.Generator) -> dict[str, int]:
    """Words of an arm of any lengths."""
    units = 2.0 ** (core.params["W"] - 1 - core.params["F"])
    sizes = units * 2.0 ** -rng.uniform(0.01, 12, 4) * rng.choice([-1, 1], 4)
    found = srs.config(core.params, **Srs(sizes[0], *np.abs(sizes[1:3]), sizes[3])._asdict())
    return found | edges.any_words(core, rng)


def poses(core: Core, arm: Srs, q: np.ndarray, rng: np.random.Generator) -> Vectors:
    """Words of the poses of joints, each on a random branch with a random swivel; tips beyond the word at its end."""
    p, end = core.params, (1 << core.params["W"] - 1) - 1
    rotation, tip = truth_srs.fk(q, arm)
    turn = rng.uniform(-np.pi, np.pi, len(q))
    turn[::4] = np.pi / 2 * rng.integers(0, 4, turn[::4].shape)
    words = {f"in_r{axis}": row for axis, row in zip(AXES, np.rint(rotation.reshape(-1, 9).T * 2.0 ** p["U"]))}
    words |= {f"in_{axis}": np.clip(np.rint(tip[:, i] * 2.0 ** p["F"]), -end - 1, end) for i, axis in enumerate("xyz")}
    words |= {"in_cs": np.rint(np.cos(turn) * 2.0 ** p["U"]), "in_ns": np.rint(np.sin(turn) * 2.0 ** p["U"])}
    return {name: word.astype(np.int64) for name, word in words.items()} | {"in_branch": rng.integers(0, 8, len(q))}


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Poses, half of them disturbed in one way or another."""
    rng, count = np.random.default_rng(1), 600
    p = core.params
    arm = Srs(*(cfg[f"cfg_{name}"] * 2.0 ** -(p["F"] + srs.MORE) for name in Srs._fields))
    anywhere = rng.uniform(-np.pi, np.pi, (count, 7))
    quarter = rng.random(anywhere.shape) < 0.1
    q = np.where(quarter, np.pi / 2 * rng.integers(-2, 3, anywhere.shape), anywhere)
    for first, joint in ((0, 1), (1, 3), (2, 5)):  # upper arm along axis 1, arm stretched or folded, wrist straight
        some = slice(first, None, 7)
        q[some, joint] = np.pi * rng.integers(0, 2, q[some, joint].shape) + rng.normal(size=q[some, joint].shape) \
            * rng.choice([0, 0.01], q[some, joint].shape)
    found = poses(core, arm, q, rng)
    own = rng.random(count) < 0.5
    for axis in "xyz":  # another tip: out of reach, near axis 1
        other = rng.integers(-(1 << p["W"] - 1), 1 << p["W"] - 1, count) >> rng.integers(0, p["W"], count)
        found[f"in_{axis}"] = np.where(own | (rng.random(count) < 0.3), found[f"in_{axis}"], other)
    slack = meaning.slack(p) - H + p["U"]  # of 2^-U
    for name in [f"in_r{axis}" for axis in AXES] + ["in_cs", "in_ns"]:  # just within the threshold, just beyond, none
        off = rng.integers(-1, 2, count) << rng.integers(0, slack + 3, count)
        found[name] = found[name] + np.where(rng.random(count) < 0.04, off, 0)
    for port in core.inputs:
        extreme = rng.choice(stimulus.extremes(port), count)
        found[port.name] = np.where(rng.random(count) < 0.003, extreme, found[port.name])
    # first of all the arm upright, its wrist straight: no joint has a direction
    one, half = 1 << p["U"], 1 << p["W"] - 1
    top = sum(cfg[f"cfg_{name}"] for name in Srs._fields) >> srs.MORE
    first = {port.name: np.zeros(2, np.int64) for port in core.inputs} | {
        name: np.full(2, one) for name in ("in_r11", "in_r22", "in_r33", "in_cs")}
    first["in_z"] = np.full(2, np.clip(top, -half, half - 1))
    # a matrix whose columns are as long as sqrt(5), a swivel of 2: every sum that tests them is 0 or 4
    rows = ((2, 0, 1), (1, 0, -2), (0, 1, 0))
    long = {f"in_r{i + 1}{j + 1}": np.full(2, min(value * one, 2 * one - 1)) for i, row in enumerate(rows)
            for j, value in enumerate(row)}
    wide = {"in_cs": np.full(2, one), "in_ns": np.full(2, 2 * one - 1)}
    near = edges.Joints(3, 5, 0, arm.l2, "l1", 0, arm.l4)
    bordered = edges.poses(core, cfg, rng, arm, near, anywhere[::3], lambda q, arm: poses(core, arm, q, rng))
    found = stimulus.joined(stimulus.joined(stimulus.joined(first, first | long), first | wide), found)
    return stimulus.joined(found, bordered)
