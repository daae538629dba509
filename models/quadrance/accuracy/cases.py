"""What to feed a core: an arm's working day, samples over all it can be asked, its workspace, a map of it."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np

from quadrance import codecs, truth
from quadrance.accuracy import arm as seen
from quadrance.accuracy import primitives
from quadrance.accuracy.arm import AXES, JOINTS, joint_ports
from quadrance.arms import Arm
from quadrance.cores import Core, Port
from quadrance.fixed import Ints, ints, to_fixed, wrap
from quadrance.trajectory import trajectory
from quadrance.truth import Floats


@dataclass(frozen=True)
class Case:
    """What to feed a core, and the float64 motion it stands for.

    inputs : words a port (N,); cfg : words; angles (N, joints) rad and tip (N, 3) units before quantisation,
    None for primitives.
    """

    inputs: dict[str, Ints]
    cfg: dict[str, int]
    angles: Floats | None = None
    tip: Floats | None = None


def case_of(core: Core, arm: Arm, angles: Floats, tip: Floats, words: Ints | None = None) -> Case:
    """Quantise a motion (N, joints), (N, 3) to the core's words; `words` (N, joints) overrides the joint words."""
    if core.function.startswith("fk"):
        inputs = {port.name: codecs.encode(port, angles[:, i]) if words is None else words[:, i]
                  for i, port in enumerate(joint_ports(core))}
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
        ports = joint_ports(core)
        words = np.stack([codecs.encode(port, angles[:, i]) for i, port in enumerate(ports)], axis=-1)
        for i, port in enumerate(ports):
            words[count // 2:, i] = rng.integers(port.low, port.high, count - count // 2, endpoint=True)
            words[-64:, i] = wrap((rng.integers(0, 4, 64) << port.width - 2) + rng.integers(-2, 3, 64),
                                  port.width, port.signed)
            angles[:, i] = codecs.decode(port, words[:, i])
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

    A rounded word is worst beside a quadrant border, just before it becomes the next word, and a tip is worst where
    every joint is so, both errors add up and the arm is stretched. So the poses are, in this order:

    * every combination of the joints' border cells: each border within the limits, half an LSB before and behind it;
    * a third of the rest: the same at random, a quarter to half an LSB from the borders, since the rounded target of an
      inverse core is not where the pose was;
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
    ports = joint_ports(core)
    ranges = [np.radians(limit) for limit in (*arm.limits, (-180.0, 180.0))[:len(ports)]]
    cells = [_near_borders(port, limit, np.array([EDGE])) for port, limit in zip(ports, ranges)]
    corners = np.array(list(itertools.product(*cells)))[:count]
    rest = count - len(corners)
    turns = np.stack([_turns(port, limit, rest, rng) for port, limit in zip(ports, ranges)], axis=-1)
    if len(ports) > 1:
        turns[::4, 1] = _near_singular(ports[1], ranges[1], len(turns[::4]), rng)
    third = rest // 3
    for i, (port, limit) in enumerate(zip(ports, ranges)):
        turns[:third, i] = rng.choice(_near_borders(port, limit, EDGE * rng.uniform(0.5, 1, third + 1)), third)
    angles = np.concatenate([corners, turns])
    return case_of(core, arm, angles, truth.tip(angles, *arm.links))


def _within(words: Floats, port: Port, limit: Floats) -> Floats:
    """Angles of those real-valued words that lie within the limits, as angles from the lower one on."""
    low, high = limit
    theta = low + np.mod(codecs.decode(port, words) - low, truth.TURN)
    return theta[theta <= high]


def _near_borders(port: Port, limit: Floats, off: Floats) -> Floats:
    """Angles `off` LSB before and behind every quadrant border within the limits; without a border, the limits."""
    borders = (np.arange(4) * 2.0 ** (port.width - 2))[:, None]
    found = _within(np.concatenate([borders - off, borders + off], axis=None), port, limit)
    return found if found.size else limit


def _draw(words: Floats, port: Port, limit: Floats, count: int, rng: np.random.Generator) -> Floats:
    """`count` of the angles of `words` within the limits; where there are none, uniform angles."""
    found = _within(words, port, limit)
    return rng.choice(found, count) if found.size else rng.uniform(*limit, count)


def _turns(port: Port, limit: Floats, count: int, rng: np.random.Generator) -> Floats:
    """Angles of one joint: thirds of them log-uniform about the borders, at ends of such words' cells, and uniform."""
    turn, quadrant = 2.0**port.width, 2.0 ** (port.width - 2)
    pool = 16 * count + 256
    off = 2.0 ** rng.uniform(-4, port.width - 2, pool) * rng.choice([-1, 1], pool)
    near = quadrant * rng.integers(0, 4, pool) + off
    ends = np.rint(near) + EDGE * rng.choice([-1, 1], pool)
    kinds = np.stack([_draw(words, port, limit, count, rng) for words in (near, ends, rng.uniform(0, turn, pool))])
    return kinds[rng.integers(0, 3, count), np.arange(count)]


def _near_singular(port: Port, limit: Floats, count: int, rng: np.random.Generator) -> Floats:
    """Elbow angles about the stretched and the folded arm, log-uniform on both sides, as far as the limits let them."""
    pool = 16 * count + 256
    turned = np.pi * rng.integers(0, 2, pool) + rng.choice([-1, 1], pool) * np.pi * 2.0 ** -rng.uniform(
        1, port.width + 6, pool)
    theta = limit[0] + np.mod(turned - limit[0], truth.TURN)
    theta = theta[theta <= limit[1]]
    return rng.choice(theta, count) if theta.size else rng.uniform(*limit, count)
