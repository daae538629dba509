"""Corners of rtl/ur: poses of the robots on all branches, every singularity, out of reach, matrices that are none."""

from __future__ import annotations

import numpy as np
from quadrance import codecs, truth_ur, ur
from quadrance.cores import Core, joints
from quadrance.product_engine import H
from quadrance.program import meaning
from quadrance.six import AXES
from quadrance.truth_ur import Ur

from tb.lib import stimulus
from tb.lib.stimulus import Vectors
from tb.stimulus import edges
from tb.stimulus.six import angles


def arms(core: Core) -> list[Ur]:
    """The robots of the library as large as the word, offsets of either sign, lengths of zero and of a word's range."""
    units = 2.0 ** (core.params["W"] - 1 - core.params["F"])
    found = [Ur(*(length / mm * units / 128 for length in arm)) for arm, mm in map(truth_ur.load, truth_ur.known())]
    share = [(0, 0, 0, 0.1, 0.25, 0.25), (-0.1, -0.05, 0.1, -0.125, 0.2, 0.3), (0.3, 0.1, -0.1, 0, 0.4, 0.1),
             (0, 0, 0, 0, 0, 0), (0.01, 0.01, 0, 0.01, 0.01, 0.005), (0, 0, 0, 0, 0.99, 0.99)]
    return found + [Ur(*(units * part for part in one)) for one in share]


def _words(core: Core, arm: Ur) -> dict[str, int]:
    if core.function.startswith("ur_fk"):
        return ur.forward_config(core.params, **arm._asdict())
    return ur.config(core.params, **arm._asdict())


def configs(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """Words of `arms`; then the extremes of every length."""
    found = [_words(core, arm) for arm in arms(core)]
    found = [found[0], *found]
    if "cfg_margin" in found[0]:
        found = edges.with_words(core, rng, found)
    lengths = {port.name: (port.low, port.high) for port in core.cfg if port.signed}
    return [*found, *(found[0] | {name: both[way] for name, both in lengths.items()} for way in (0, 1))]


def draw(core: Core, rng: np.random.Generator) -> dict[str, int]:
    """Words of an arm of any lengths, offsets of either sign."""
    units = 2.0 ** (core.params["W"] - 1 - core.params["F"])
    sizes = units * 2.0 ** -rng.uniform(0.01, 12, 6) * rng.choice([-1, 1], 6)
    found = _words(core, Ur(*sizes[:4], *np.abs(sizes[4:])))
    return found | edges.any_words(core, rng) if "cfg_margin" in found else found


def _arm(core: Core, cfg: dict[str, int]) -> Ur:
    """The arm of configuration words."""
    return Ur(*(cfg[f"cfg_{name}"] * 2.0 ** -(core.params["F"] + ur.MORE) for name in Ur._fields))


def poses(core: Core, arm: Ur, q: np.ndarray, rng: np.random.Generator) -> Vectors:
    """Words of the poses of joints, each on a random branch; tips beyond the word are at its end."""
    p = core.params
    rotation, tip = truth_ur.fk(q, arm)
    end = (1 << p["W"] - 1) - 1
    words = {f"in_r{axis}": row for axis, row in zip(AXES, np.rint(rotation.reshape(-1, 9).T * 2.0 ** p["U"]))}
    words |= {f"in_{axis}": np.clip(np.rint(tip[:, i] * 2.0 ** p["F"]), -end - 1, end) for i, axis in enumerate("xyz")}
    branch = {port.name: rng.integers(0, 8, len(q)) for port in core.inputs if port.name == "in_branch"}
    return {name: word.astype(np.int64) for name, word in words.items()} | branch


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Forward: all borders and vectors of any length. Inverse: poses, half of them disturbed in one way or another."""
    rng = np.random.default_rng(1)
    if core.function.startswith("ur_fk"):
        q, found = angles(400, rng), {}
        for i, joint in enumerate(joints(core.inputs)):
            found |= codecs.encode(joint, q[:, i])
        wild = stimulus.uniform(core, rng, 200)
        extreme = {port.name: rng.choice(stimulus.extremes(port), 100) for port in core.inputs}
        ends = stimulus.saturation(core, cfg, found)
        return stimulus.joined(stimulus.joined(stimulus.joined(found, wild), extreme), ends)
    count = 150 if core.function == "ur_ik_all" else 600  # eight answers a pose
    q, arm = angles(count, rng), _arm(core, cfg)
    q[::5, 4] = np.pi * rng.integers(0, 2, q[::5, 4].shape)  # joint 6 has no direction
    q[1::9, 2] = rng.choice([0, np.pi], q[1::9, 2].shape) + rng.normal(size=q[1::9, 2].shape) * 0.01
    q[2::9, 2] = np.pi / 2 * rng.choice([-1, 1], q[2::9, 2].shape)  # elbow at a right angle: 1 - cos^2 is 1.0
    found = poses(core, arm, q, rng)
    own = rng.random(count) < 0.5
    for axis in "xyz":  # another tip: out of reach, near axis 1
        other = rng.integers(-(1 << core.params["W"] - 1), 1 << core.params["W"] - 1, count) >> rng.integers(
            0, core.params["W"], count)
        found[f"in_{axis}"] = np.where(own | (rng.random(count) < 0.3), found[f"in_{axis}"], other)
    slack = meaning.slack(core.params) - H + core.params["U"]  # of 2^-U
    for axis in AXES:  # matrices just within the threshold, just beyond, and none at all
        off = rng.integers(-1, 2, count) << rng.integers(0, slack + 3, count)
        found[f"in_r{axis}"] = found[f"in_r{axis}"] + np.where(rng.random(count) < 0.04, off, 0)
    for port in core.inputs:
        extreme = rng.choice(stimulus.extremes(port), count)
        found[port.name] = np.where(rng.random(count) < 0.003, extreme, found[port.name])
    # first of all a sample with no direction of joint 6, nor of joint 1 where d4 is 0: the flange above axis 1
    straight, one = poses(core, arm, np.zeros((2, 6)), rng), 1 << core.params["U"]
    first = straight | dict.fromkeys(("in_x", "in_y"), np.zeros(2, np.int64)) | {
        f"in_r{axis}": np.full(2, one * (axis in ("11", "23")) - one * (axis == "32")) for axis in AXES}
    half = 1 << core.params["W"] - 1
    first["in_y"] = np.full(2, np.clip(round(arm.d6 * 2.0 ** core.params["F"]), -half, half - 1))
    # a matrix whose columns are as long as sqrt(5): every sum that tests it is 0 or 4
    rows = ((2, 0, 1), (1, 0, -2), (0, 1, 0))
    long = {f"in_r{i + 1}{j + 1}": np.full(2, min(value * one, 2 * one - 1)) for i, row in enumerate(rows)
            for j, value in enumerate(row)}
    near = edges.Joints(2, 4, 0, arm.l3, "l2", arm.d4, arm.d6)
    bordered = edges.poses(core, cfg, rng, arm, near, angles(count // 3, rng), lambda q, arm: poses(core, arm, q, rng))
    return stimulus.joined(stimulus.joined(stimulus.joined(first, first | long), found), bordered)
