"""Corners of rtl/six: poses of both robots on all branches, every singularity, out of reach, matrices that are none."""

from __future__ import annotations

import numpy as np
from quadrance import codecs, six, truth_six
from quadrance.cores import Core, joints
from quadrance.product_engine import H
from quadrance.program import meaning
from quadrance.truth_six import Six

from tb.lib import stimulus
from tb.lib.stimulus import Vectors
from tb.stimulus import edges

EIGHTH = np.pi / 4
MOTIONS = "velocity6", "rates6"


def arms(core: Core) -> list[Six]:
    """The robots of the library as large as the word, a plain arm, offsets of either sign, lengths of zero, and of a
    word's range.
    """
    units = 2.0 ** (core.params["W"] - 1 - core.params["F"])
    found = []
    for name in truth_six.known():
        arm, mm = truth_six.load(name)
        found.append(Six(*(length / mm * units / 128 for length in arm)))
    share = [(0, 0, 0, 0.1, 0.25, 0.25, 0.1), (-0.05, 0.1, -0.125, -0.1, 0.2, 0.3, -0.2), (0.1, 0, 0.3, 0, 0.4, 0.1, 0),
             (0, 0, 0, 0, 0, 0, 0), (0.01, 0, 0.01, 0.01, 0.01, 0.005, 0.01),
             (0, 0, 0, 0, 0.99, 0.99, 0)]
    return found + [Six(*(units * part for part in one)) for one in share]


def _edged(core: Core) -> bool:
    """Whether margin and slack are built."""
    return core.function == "ik6_all" or core.params.get("MARGINS") == 1


def _words(core: Core, arm: Six, rng: np.random.Generator) -> dict[str, int]:
    """Configuration words of an arm; thresholds of any size."""
    if core.function.startswith("fk6"):
        return six.forward_config(core.params, **arm._asdict())
    if core.function not in MOTIONS:
        return six.config(core.params, **arm._asdict())
    lengths = {name: length for name, length in arm._asdict().items() if name != "c1"}
    if core.function == "velocity6":
        return six.motion_config(core.params, **lengths)
    units = 2.0 ** (core.params["W"] - core.params["F"])
    return six.rates_config(core.params, **lengths, angle=np.pi / 2 * 2.0 ** -rng.uniform(0, 12),
                            radius=units * 2.0 ** -rng.uniform(0.01, 14))


def configs(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """Words of `arms`; then the extremes of every length and of every threshold."""
    found = [_words(core, arm, rng) for arm in arms(core)]
    if _edged(core):
        found = edges.with_words(core, rng, [found[0], *found])
    for cfg in found[::2] if core.function == "rates6" else ():  # no threshold at all
        cfg |= {"cfg_radius": 0, "cfg_elbow": 0, "cfg_sine": 0}
    lengths = {port.name: (port.low, port.high) for port in core.cfg
               if port.signed and port.width < 27 or core.function == "rates6"}
    return found + [found[0] | {name: both[way] for name, both in lengths.items()} for way in (0, 1)]


def draw(core: Core, rng: np.random.Generator) -> dict[str, int]:
    """Words of an arm of any lengths, offsets of either sign."""
    units = 2.0 ** (core.params["W"] - 1 - core.params["F"])
    sizes = dict(zip(Six._fields, units * 2.0 ** -rng.uniform(0.01, 12, 7) * rng.choice([-1, 1], 7)))
    sizes |= {"c2": abs(sizes["c2"]), "a2": sizes["a2"] * 0.7, "c3": sizes["c3"] * 0.7}  # both together fit a word
    found = _words(core, Six(**sizes), rng)
    return found | edges.any_words(core, rng) if _edged(core) else found


def _arm(core: Core, cfg: dict[str, int]) -> Six:
    """The arm of configuration words."""
    lsb = 2.0 ** -(core.params["F"] + six.MORE)
    length = {name: cfg.get(f"cfg_{name}", 0) * lsb for name in ("a1", "a2", "b", "c1", "c2", "c3", "c4")}
    if "cfg_k" in cfg:
        length["a2"], length["c3"] = (cfg["cfg_k"] * lsb * cfg[f"cfg_{part}"] / six.ONE for part in ("np", "cp"))
    return Six(**length)


def angles(count: int, rng: np.random.Generator) -> np.ndarray:
    """Joints (count, 6): anywhere, in eighths of a turn, next to them log-uniform."""
    q = rng.uniform(-np.pi, np.pi, (count, 6))
    axis = EIGHTH * rng.integers(0, 8, q.shape)
    near = axis + rng.choice([-1, 1], q.shape) * 2.0 ** -rng.uniform(0, 20, q.shape)
    return np.choose(rng.integers(0, 3, q.shape), [q, axis, near])


def poses(core: Core, arm: Six, q: np.ndarray, rng: np.random.Generator) -> Vectors:
    """Words of the poses of joints, each on a random branch; tips beyond the word are at its end."""
    p = core.params
    rotation, tip = truth_six.fk6(q, arm)
    end = (1 << p["W"] - 1) - 1
    matrix = np.rint(rotation.reshape(-1, 9).T * 2.0 ** p["U"])
    words = {f"in_r{axis}": row for axis, row in zip(six.AXES, matrix)}
    words |= {f"in_{axis}": np.clip(np.rint(tip[:, i] * 2.0 ** p["F"]), -end - 1, end) for i, axis in enumerate("xyz")}
    branch = {port.name: rng.integers(0, 8, len(q)) for port in core.inputs if port.name == "in_branch"}
    return {name: word.astype(np.int64) for name, word in words.items()} | branch


def _motions(core: Core, cfg: dict[str, int], rng: np.random.Generator) -> Vectors:
    """Motions of any size, of joints anywhere; stretched and folded arms, straight wrists, the wrist on axis 1; wild
    vectors; extremes."""
    count, found, arm = 400, {}, _arm(core, cfg)
    q = angles(count, rng)
    small = rng.choice([-1, 1], (2, count)) * 2.0 ** -rng.uniform(2, 20, (2, count)) * rng.integers(0, 2, (2, count))
    q[::4, 2] = (np.pi * rng.integers(0, 2, count) + small[0] - np.arctan2(arm.a2, arm.c3))[::4]
    q[::5, 4] = (np.pi * rng.integers(0, 2, count) + small[1])[::5]
    for i, joint in enumerate(joints(core.inputs)):
        found |= codecs.encode(joint, q[:, i])
    for port in core.inputs:
        if port.type is None:
            words = rng.integers(port.low, port.high, count, endpoint=True)
            found[port.name] = words >> np.where(rng.random(count) < 0.7, rng.integers(0, port.width, count), 0)
    wild = stimulus.uniform(core, rng, 200)
    extreme = {port.name: rng.choice(stimulus.extremes(port), 100) for port in core.inputs}
    return stimulus.joined(stimulus.joined(found, wild), extreme)


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Forward: all borders and vectors of any length. Inverse: poses, half of them disturbed in one way or another."""
    rng = np.random.default_rng(1)
    if core.function in MOTIONS:
        found = _motions(core, cfg, rng)
        return stimulus.joined(found, stimulus.saturation(core, cfg, found))
    if core.function.startswith("fk6"):
        q, found = angles(400, rng), {}
        for i, joint in enumerate(joints(core.inputs)):
            found |= codecs.encode(joint, q[:, i])
        wild = stimulus.uniform(core, rng, 200)
        extreme = {port.name: rng.choice(stimulus.extremes(port), 100) for port in core.inputs}
        ends = stimulus.saturation(core, cfg, found)
        return stimulus.joined(stimulus.joined(stimulus.joined(found, wild), extreme), ends)
    count = 150 if core.function == "ik6_all" else 600  # eight answers a pose
    q, arm = angles(count, rng), _arm(core, cfg)
    q[::5, 4] = np.pi * rng.integers(0, 2, q[::5, 4].shape)  # straight wrist
    q[2::9, 2] = np.pi / 2 * rng.choice([-1, 1], q[2::9, 2].shape) - arm.psi  # a right angle: 1 - cos^2 is 1.0
    found = poses(core, arm, q, rng)
    own = rng.random(count) < 0.5
    for axis in "xyz":  # another tip: out of reach, near axis 1, the wrist's centre on the shoulder
        other = rng.integers(-(1 << core.params["W"] - 1), 1 << core.params["W"] - 1, count) >> rng.integers(
            0, core.params["W"], count)
        found[f"in_{axis}"] = np.where(own | (rng.random(count) < 0.3), found[f"in_{axis}"], other)
    slack = meaning.slack(core.params) - H + core.params["U"]  # of 2^-U
    for axis in six.AXES:  # matrices just within the threshold, just beyond, and none at all
        off = rng.integers(-1, 2, count) << rng.integers(0, slack + 3, count)
        found[f"in_r{axis}"] = found[f"in_r{axis}"] + np.where(rng.random(count) < 0.04, off, 0)
    for port in core.inputs:
        extreme = rng.choice(stimulus.extremes(port), count)
        found[port.name] = np.where(rng.random(count) < 0.003, extreme, found[port.name])
    # first of all a sample with no direction at all: the wrist's centre on the shoulder, a straight wrist
    first = poses(core, arm, np.zeros((2, 6)), rng)
    lsb = 2.0 ** core.params["F"]
    first |= {"in_x": first["in_x"] * 0, "in_y": first["in_y"] * 0,
              "in_z": np.full(2, np.clip(round((arm.c1 + arm.c4) * lsb), -(1 << core.params["W"] - 1),
                                         (1 << core.params["W"] - 1) - 1))}
    # a matrix whose columns are as long as sqrt(5): every sum that tests it is 0 or 4
    one, rows = 1 << core.params["U"], ((2, 0, 1), (1, 0, -2), (0, 1, 0))
    long = {f"in_r{i + 1}{j + 1}": np.full(2, min(value * one, 2 * one - 1)) for i, row in enumerate(rows)
            for j, value in enumerate(row)}
    found = stimulus.joined(stimulus.joined(first, first | long), found)
    if not _edged(core):
        return found
    near = edges.Joints(2, 4, -arm.psi, arm.k, "c2", arm.b, arm.c4)
    return stimulus.joined(found, edges.poses(core, cfg, rng, arm, near, angles(count // 3, rng),
                                              lambda q, arm: poses(core, arm, q, rng)))
