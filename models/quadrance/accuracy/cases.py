"""This module makes a core's inputs: an arm's working day, samples of the whole domain, a workspace, a map of it."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np

from quadrance import codecs, truth
from quadrance.accuracy import arm as seen
from quadrance.accuracy import primitives
from quadrance.accuracy.arm import AXES, JOINTS, joint_ports
from quadrance.arms import Arm
from quadrance.cores import Core, Joint
from quadrance.fixed import Ints, ints, to_fixed
from quadrance.trajectory import trajectory
from quadrance.truth import Floats


@dataclass(frozen=True)
class Case:
    """What to feed a core, and the float64 motion that it represents.

    inputs : words a port (N,); cfg : words; angles (N, joints) rad and tip (N, 3) units before quantisation,
    None for primitives.
    """

    inputs: dict[str, Ints]
    cfg: dict[str, int]
    angles: Floats | None = None
    tip: Floats | None = None


def case_of(core: Core, arm: Arm, angles: Floats, tip: Floats, words: dict[str, Ints] | None = None) -> Case:
    """Quantise a motion (N, joints), (N, 3) to the core's words; `words` by port name override the joint words."""
    if core.function.startswith("fk"):
        inputs = words or {}
        for joint, theta in zip(joint_ports(core), angles.T) if words is None else ():
            inputs |= codecs.encode(joint, theta)
    else:
        f = core.params["F"]
        inputs = {f"in_{axis}": to_fixed(tip[:, i], f) for i, axis in enumerate(AXES[core.function])}
        for port in core.inputs:
            if port.name == "in_elbow":
                inputs[port.name] = ints(truth.difference(angles[:, 1], 0) < 0)
            elif port.name not in inputs:
                inputs[port.name] = np.zeros(len(angles), dtype=np.int64)
    return Case(inputs, seen.config(core, arm), angles, tip)


def trajectory_case(core: Core, arm: Arm, samples: int = 1000) -> Case | None:
    """The arm's trajectory in the core's words; None for a primitive."""
    if core.function not in JOINTS:
        return None
    return case_of(core, arm, *trajectory(arm, JOINTS[core.function], samples))


def sweep_case(core: Core, arm: Arm, count: int = 4096, seed: int = 1) -> Case | None:
    """Seeded random and border samples over all a core can be asked on `arm`; None for an unknown function.

    Forward: joint words, half uniform, half uniform in angle, and every quadrant border with its neighbours.
    Inverse: every direction and both elbows from folded to stretched. Primitives: see `primitives`.
    """
    rng = np.random.default_rng(seed)
    if core.function in primitives.PRIMITIVES:
        return Case(primitives.stimulus(core, rng, count), {})
    if core.function not in JOINTS:
        return None
    joints = JOINTS[core.function]
    angles = rng.uniform(-np.pi, np.pi, (count, joints))
    borders = np.pi / 2 * rng.integers(-2, 3, (count // 8, joints))
    angles[:len(borders)] = borders + rng.choice([-1, 0, 1], borders.shape) * 2.0 ** -rng.integers(4, 20, borders.shape)
    words = None
    if core.function.startswith("fk"):
        words = {}
        for i, joint in enumerate(joint_ports(core)):
            quadrant = codecs.quadrant(joint)
            places = rng.integers(0, 4 * quadrant, count - count // 2)
            places[-64:] = rng.integers(0, 4, 64) * quadrant + rng.integers(-2, 3, 64)
            for name, word in codecs.encode(joint, angles[:, i]).items():
                words[name] = np.append(word[:count // 2], codecs.words_at(joint, places)[name])
            angles[:, i] = codecs.decode(joint, words)
    return case_of(core, arm, angles, truth.tip(angles, *arm.links), words)


def map_case(core: Core, arm: Arm, side: int) -> tuple[Case, np.ndarray]:
    """A point in every cell of a `side` x `side` grid over the square of the arm's reach, elbow 0, in the core's words.

    Two-joint functions only. The points are seeded random within their cells: on whole units nothing would be rounded.
    Returns the case and the (side, side) mask of the cells whose point is in reach, row 0 lowest.
    """
    within = np.random.default_rng(1).random((2, side, side))
    x, y = sum(arm.links) * ((np.stack(np.meshgrid(np.arange(side), np.arange(side))) + within) * (2 / side) - 1)
    inside = truth.reach(x, y, *arm.links) == 0
    angles = np.stack(truth.ik2(x[inside], y[inside], *arm.links, 0), axis=-1)
    inside[inside] = defined = np.all(np.isfinite(angles), axis=-1)
    tip = np.stack([x[inside], y[inside], np.zeros(int(inside.sum()))], axis=-1)
    return case_of(core, arm, angles[defined], tip), inside


# The workspace

EDGE = 0.5 - 2.0**-12  # LSB from a word to where its cell ends


def workspace_case(core: Core, arm: Arm, count: int, rng: np.random.Generator) -> Case | None:
    """Joint poses over all of the arm's limits, with those where rounding a word costs most; None for a primitive.

    A rounded word is worst just before it becomes the next one, where its type is coarsest (beside a quadrant border; a
    vector beside a diagonal), and a tip is worst where every joint is so, both errors add up and the arm is stretched.
    So the poses are, in this order:

    * every combination of the joints' coarsest words (`codecs.coarsest`) within the limits, half an LSB before and
      behind them;
    * a third of the rest: the same at random, a quarter to half an LSB from these words, since the rounded target of
      an inverse core is not where the pose was;
    * poses whose joints lie, each by its own draw, near a border (log-uniform in the words from 1/16 LSB to a quadrant,
      both sides, all borders alike), at the end of the cell of such a word, or anywhere (uniform in the words), every
      fourth with an elbow near straight or folded (log-uniform from a hundredth of a word).

    Parameters
    ----------
    core : Core
        Of a kinematic function. An inverse core gets the tips of these poses, rounded to its coordinates.
    arm : Arm
        Its limits; a yaw that it lacks turns all round, and a joint of more than a turn keeps one.
    count : int
        Poses. The combinations alone are up to 8^joints; an inverse core wants some thousand more.
    rng : numpy Generator

    Returns
    -------
    Case
        Angles are not rounded to words.
    """
    if core.function not in JOINTS:
        return None
    joints = joint_ports(core)
    ranges = [np.radians(limit) for limit in (*arm.limits, (-180.0, 180.0))[:len(joints)]]
    cells = [_coarsest(joint, limit, np.array([EDGE])) for joint, limit in zip(joints, ranges)]
    corners = np.array(list(itertools.product(*cells)))[:count]
    rest = count - len(corners)
    turns = np.stack([_turns(joint, limit, rest, rng) for joint, limit in zip(joints, ranges)], axis=-1)
    if len(joints) > 1:
        turns[::4, 1] = _near_singular(joints[1], ranges[1], len(turns[::4]), rng)
    third = rest // 3
    for i, (joint, limit) in enumerate(zip(joints, ranges)):
        turns[:third, i] = rng.choice(_coarsest(joint, limit, EDGE * rng.uniform(0.5, 1, third + 1)), third)
    angles = np.concatenate([corners, turns])
    return case_of(core, arm, angles, truth.tip(angles, *arm.links))


def _within(places: Floats, joint: Joint, limit: Floats) -> Floats:
    """Angles of those places that lie within the limits, as angles from the lower one on."""
    low, high = limit
    theta = low + np.mod(codecs.at(joint, places) - low, truth.TURN)
    return theta[theta <= high]


def _coarsest(joint: Joint, limit: Floats, off: Floats) -> Floats:
    """Angles `off` LSB before and after the coarsest words within the limits; without such a word, the limits."""
    found = _within(codecs.coarsest(joint, off), joint, limit)
    return found if found.size else limit


def _draw(places: Floats, joint: Joint, limit: Floats, count: int, rng: np.random.Generator) -> Floats:
    """`count` of the angles of `places` within the limits; where there are none, uniform angles."""
    found = _within(places, joint, limit)
    return rng.choice(found, count) if found.size else rng.uniform(*limit, count)


def _turns(joint: Joint, limit: Floats, count: int, rng: np.random.Generator) -> Floats:
    """Angles of one joint: thirds of them log-uniform about the borders, at ends of such words' cells, and uniform."""
    quadrant = float(codecs.quadrant(joint))
    pool = 16 * count + 256
    off = 2.0 ** rng.uniform(-4, np.log2(quadrant), pool) * rng.choice([-1, 1], pool)
    near = quadrant * rng.integers(0, 4, pool) + off
    ends = np.rint(near) + EDGE * rng.choice([-1, 1], pool)
    kinds = np.stack([_draw(places, joint, limit, count, rng)
                      for places in (near, ends, rng.uniform(0, 4 * quadrant, pool))])
    return kinds[rng.integers(0, 3, count), np.arange(count)]


def _near_singular(joint: Joint, limit: Floats, count: int, rng: np.random.Generator) -> Floats:
    """Elbow angles about the stretched and the folded arm, log-uniform on both sides, as far as the limits let them."""
    pool = 16 * count + 256
    turned = np.pi * rng.integers(0, 2, pool) + rng.choice([-1, 1], pool) * np.pi * 2.0 ** -rng.uniform(
        1, np.log2(codecs.quadrant(joint)) + 8, pool)
    theta = limit[0] + np.mod(turned - limit[0], truth.TURN)
    theta = theta[theta <= limit[1]]
    return rng.choice(theta, count) if theta.size else rng.uniform(*limit, count)
