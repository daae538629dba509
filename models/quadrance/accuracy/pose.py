"""Total errors of the cores that have a whole arm inside: those of rtl/arm (three joints), rtl/six, rtl/ur and rtl/srs.

As in `tip`, with words and arithmetic together: of a forward core the distance from the answered tip to the float64 tip
of the unrounded joints; of an inverse one from the float64 tip of the answered words to the unrounded tip. Six axes
have the angle between the two orientations too. The arm is the exact one, and the joints keep to its limits; those of a
wrist turn all round.

Joint 1 of six axes has no direction where the wrist's centre is in axis 1, and little of one beside it. So the poses of
an inverse core that are nearer to the axis than `singular.axis` of the arm file have a figure of their own. Where axes
2, 3 and 4 are parallel, the distance is that in the arm's plane, which passes beside axis 1; a pose that such an arm
does not reach with the joint 6 that the core holds has no error.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from quadrance import codecs, six, truth, truth_arm, truth_six, truth_srs, truth_ur
from quadrance.accuracy.arm import config
from quadrance.accuracy.of_core import modelled
from quadrance.arms import Arm
from quadrance.cores import Core, Joint, joints
from quadrance.fixed import Ints, to_fixed, to_float
from quadrance.truth import Floats

FUNCTIONS = {"arm_fk3": 3, "arm_ik3": 3, "keep2": 2, "keep3": 3,
             "fk6": 6, "fk6_of_angles": 6, "ik6": 6, "ik6_all": 6, "ik6_to_angles": 6,
             "ur_fk": 6, "ur_fk_of_angles": 6, "ur_ik": 6, "ur_ik_all": 6, "ur_ik_to_angles": 6,
             "srs_ik": 7, "srs_ik_to_angles": 7}
AT_ONCE = 8192  # samples: a model of six axes holds all its words


@dataclass(frozen=True)
class Worst:
    """Greatest error at the tip, mm; of six axes that of the orientation, degrees, and that at the tip beside axis 1.

    The last is None where no pose is left out.
    """

    mm: float
    degrees: float | None = None
    beside_mm: float | None = None


def motion(arm: Arm, count: int, rng: np.random.Generator) -> Floats:
    """Joints (N, 6) within the limits, radians: shoulder, elbow, yaw as the arm file has them, and a wrist.

    Of seven axes (N, 7): the turn of the upper arm is the last.

    Uniform; each joint of a third of them near a multiple of a right angle, the elbow and joint 5 of a quarter near
    straight or folded (log-uniform from 2^-20 rad, both sides).
    """
    ranges = np.radians([*arm.limits[:3], *[(-180.0, 180.0)] * 3, *[arm.upper_limit] * (arm.upper_limit is not None)])
    theta = rng.uniform(*ranges.T, (count, len(ranges)))

    def near(step: float, share: float) -> Floats:
        off = rng.choice([-1, 1], theta.shape) * 2.0 ** -rng.uniform(0, 20, theta.shape)
        found = step * np.rint(theta / step) + off
        kept = (found >= ranges[:, 0]) & (found <= ranges[:, 1]) & (rng.random(theta.shape) < share)
        return np.where(kept, found, theta)

    theta = near(np.pi / 2, 1 / 3)
    straight = near(np.pi, 1 / 4)
    theta[:, [1, 4]] = straight[:, [1, 4]]
    return theta


def worst(core: Core, arm: Arm, count: int, seed: int = 1) -> Worst:
    """Greatest errors of a core of `FUNCTIONS` on `arm`, by its bit-true model; a branch out of reach has none."""
    rng = np.random.default_rng(seed)
    parts = [(_three if core.family == "arm" else _six)(core, arm, motion(arm, min(AT_ONCE, count - at), rng))
             for at in range(0, count, AT_ONCE)]
    mm, degrees, beside = (np.concatenate(part) for part in zip(*parts))
    if core.family == "arm":
        return Worst(float(mm.max()))
    return Worst(float(mm[~beside].max()), float(degrees.max()), float(mm[beside].max()) if beside.any() else None)


def _encoded(core: Core, theta: Floats) -> dict[str, Ints]:
    words: dict[str, Ints] = {}
    for joint in joints(core.inputs):
        words |= codecs.encode(joint, theta[:, int(joint[0].name[-1]) - 1])
    return words


def _decoded(ports: list[Joint], words: dict[str, Ints]) -> Floats:
    return np.stack([codecs.decode(joint, words) for joint in ports], axis=-1)


def _place(core: Core, words: dict[str, Ints]) -> Floats:
    return np.stack([to_float(words[f"out_{axis}"], core.params["F"]) for axis in "xyz"], axis=-1)


def _target(core: Core, tip: Floats) -> dict[str, Ints]:
    return {f"in_{axis}": to_fixed(place, core.params["F"]) for axis, place in zip("xyz", tip.T)}


Errors = tuple[Floats, Floats, np.ndarray]  # mm, degrees, and which poses are beside axis 1


def _three(core: Core, arm: Arm, theta: Floats) -> Errors:
    """Errors of the cores of rtl/arm, which have no degrees.

    A core that chooses a branch may leave that of `theta`. What it calls out of reach, a straight arm whose words
    round to beyond its reach, has no error: with an offset of the shoulder it may take the other side.
    """
    frame, cfg = truth_arm.frame(arm), config(core, arm)
    shoulder, elbow, yaw = theta[:, :3].T
    if core.function == "keep2":
        def plane(angles: Floats) -> Floats:
            return np.stack(truth.fk2(*angles.T, *arm.links), axis=-1)
        tip = plane(theta[:, :2])
        words = modelled(core, _target(core, tip), cfg)
        return _off(plane(_decoded(list(joints(core.outputs)), words)), tip, arm, words["out_status"] & 1 == 0)
    machine = np.stack([shoulder, elbow - frame.turn + (shoulder if frame.absolute else 0), yaw], axis=-1)

    def reached(angles: Floats) -> Floats:
        return np.stack(truth_arm.fk3(*angles.T, *arm.links, frame), axis=-1)

    tip = reached(machine)
    if core.function == "arm_fk3":
        answer = _place(core, modelled(core, _encoded(core, machine), cfg))
    else:
        rho = arm.links[0] * np.cos(shoulder) + arm.links[1] * np.cos(shoulder + elbow) + frame.shoulder
        words = _target(core, tip)
        if core.function == "arm_ik3":
            words |= {"in_elbow": to_fixed(np.sin(elbow) < 0, 0), "in_back": to_fixed(rho < 0, 0)}
        words = modelled(core, words, cfg)
        answer = reached(_decoded(list(joints(core.outputs)), words))
        if core.function == "keep3":
            return _off(answer, tip, arm, words["out_status"] & 1 == 0)
    return _off(answer, tip, arm)


def _off(answer: Floats, tip: Floats, arm: Arm, kept: np.ndarray | slice = slice(None)) -> Errors:
    """The errors of places alone."""
    return np.linalg.norm(answer - tip, axis=-1)[kept] * arm.mm_per_unit, np.zeros(0), np.zeros(0, dtype=bool)


def _six(core: Core, arm: Arm, theta: Floats) -> Errors:
    """Errors of the cores of six and seven axes."""
    cfg, lengths, kind = config(core, arm), *{
        "six": lambda: (arm.six, truth_six.Six), "ur": lambda: (arm.ur, truth_ur.Ur),
        "srs": lambda: (arm.srs, truth_srs.Srs)}[core.family]()
    parameters = kind(**{name: length / arm.mm_per_unit for name, length in lengths.items()})
    shoulder, elbow, yaw = theta[:, :3].T
    if core.family == "ur":
        forward, branch_of, in_plane = truth_ur.fk, _branch_ur, _in_plane
        q = np.stack([yaw, shoulder + math.pi, elbow, *theta[:, 3:].T], axis=-1)
    elif core.family == "srs":
        forward, branch_of, in_plane = truth_srs.fk, _branch_srs, _from_axis
        q = np.stack([yaw, math.pi / 2 - shoulder, theta[:, 6], elbow, *theta[:, 3:6].T], axis=-1)
    else:
        forward, branch_of, in_plane = truth_six.fk6, _branch, _from_axis
        q = np.stack([yaw, math.pi / 2 - shoulder, -elbow - parameters.psi, *theta[:, 3:].T], axis=-1)
    rotation, tip = forward(q, parameters)
    scale = 2.0 ** core.params["U"]
    if core.function.startswith(("fk6", "ur_fk")):
        words = modelled(core, _encoded(core, q), cfg)
        matrix = np.stack([words[f"out_r{axis}"] for axis in six.AXES], axis=-1).reshape(-1, 3, 3) / scale
        found, beside = [(matrix, _place(core, words), np.full(len(q), True))], np.full(len(q), False)
    else:
        words = _target(core, tip) | dict(zip((f"in_r{axis}" for axis in six.AXES),
                                              to_fixed(rotation, core.params["U"]).reshape(-1, 9).T))
        if core.family == "srs":
            turn = truth_srs.swivel(q, parameters)
            c, n = to_fixed(np.array([np.cos(turn), np.sin(turn)]), core.params["U"])
            words |= {"in_cs": c, "in_ns": n}
        every, found = core.function.endswith("_all"), []
        if not every:
            words |= {"in_branch": branch_of(q, parameters)}
        answer = modelled(core, words, cfg)
        for branch in range(8 if every else 1):
            ports = [joint for joint in joints(core.outputs) if not every or joint[0].name.endswith(str(branch))]
            kept = answer["out_far"] >> branch & 1 == 0 if every else ~_held_out_of_reach(core, answer)
            found.append((*forward(_decoded(ports, answer), parameters), kept))
        beside = in_plane(rotation, tip, parameters) * arm.mm_per_unit < (arm.singular[1] or 0)
    mm = np.concatenate([np.linalg.norm(place - tip, axis=-1)[kept] for _, place, kept in found])
    turned = np.concatenate([truth_six.turned(matrix, rotation)[kept] for matrix, _, kept in found])
    return mm * arm.mm_per_unit, np.degrees(turned), np.concatenate([beside[kept] for *_, kept in found])


def _held_out_of_reach(core: Core, answer: dict[str, Ints]) -> np.ndarray:
    """Where joint 6 of a UR has no direction, and the one that it holds leaves joints 2 to 4 without an answer."""
    return (core.family == "ur") & (answer["out_status"] & 3 == 3)


def _from_axis(rotation: Floats, tip: Floats, arm: truth_six.Six | truth_srs.Srs) -> Floats:
    """Distance of the wrist's centre from axis 1."""
    flange = arm.l4 if isinstance(arm, truth_srs.Srs) else arm.c4
    return np.hypot(*np.moveaxis(tip - flange * rotation[..., 2], -1, 0)[:2])


def _in_plane(rotation: Floats, tip: Floats, arm: truth_ur.Ur) -> Floats:
    """The same in the plane of the links of a UR: of the point where axes 5 and 6 meet."""
    px, py, _ = np.moveaxis(tip - arm.d6 * rotation[..., 2], -1, 0)
    return np.sqrt(np.maximum(px * px + py * py - arm.d4**2, 0))


def _branch(q: Floats, arm: truth_six.Six) -> Ints:
    """The branch of vector_ik6 that the joints are on."""
    fore = q[:, 1] + q[:, 2]
    x1 = arm.a1 + arm.c2 * np.sin(q[:, 1]) + arm.a2 * np.cos(fore) + arm.c3 * np.sin(fore)
    return ((x1 < 0) * truth_six.BACK + (np.sin(q[:, 2] + arm.psi) < 0) * truth_six.DOWN
            + (np.sin(q[:, 4]) < 0) * truth_six.FLIP)


def _branch_ur(q: Floats, arm: truth_ur.Ur) -> Ints:
    """The branch of vector_ur_ik that the joints are on."""
    fore = q[:, 1] + q[:, 2]
    x1 = arm.d5 * np.sin(fore + q[:, 3]) - arm.l2 * np.cos(q[:, 1]) - arm.l3 * np.cos(fore)
    return (x1 < 0) * truth_ur.BACK + (np.sin(q[:, 2]) < 0) * truth_ur.DOWN + (np.sin(q[:, 4]) < 0) * truth_ur.FLIP


def _branch_srs(q: Floats, arm: truth_srs.Srs) -> Ints:
    """The branch of vector_srs_ik that the joints are on."""
    return sum((np.sin(q[:, 2 * bit + 1]) < 0) * (1 << bit) for bit in range(3))
