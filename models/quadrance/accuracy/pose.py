"""Total errors of the cores that have a whole arm inside: those of rtl/arm (three joints) and of rtl/six.

As in `tip`, with words and arithmetic together: of a forward core the distance from the answered tip to the float64 tip
of the unrounded joints; of an inverse one from the float64 tip of the answered words to the unrounded tip. Six axes
have the angle between the two orientations too. The arm is the exact one, and the joints keep to its limits; those of a
wrist turn all round.

Joint 1 of six axes has no direction where the wrist's centre is in axis 1, and little of one beside it. So the poses of
an inverse core that are nearer to the axis than `singular.axis` of the arm file have a figure of their own.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from quadrance import codecs, six, truth_arm, truth_six
from quadrance.accuracy.arm import config
from quadrance.accuracy.of_core import modelled
from quadrance.arms import Arm
from quadrance.cores import Core, Joint, joints
from quadrance.fixed import Ints, to_fixed, to_float
from quadrance.truth import Floats

FUNCTIONS = {"arm_fk3": 3, "arm_ik3": 3, "fk6": 6, "fk6_of_angles": 6, "ik6": 6, "ik6_all": 6, "ik6_to_angles": 6}
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

    Uniform; each joint of a third of them near a multiple of a right angle, the elbow and joint 5 of a quarter near
    straight or folded (log-uniform from 2^-20 rad, both sides).
    """
    ranges = np.radians([*arm.limits[:3], *[(-180.0, 180.0)] * 3])
    theta = rng.uniform(*ranges.T, (count, 6))

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
    return {f"in_{axis}": to_fixed(tip[:, i], core.params["F"]) for i, axis in enumerate("xyz")}


Errors = tuple[Floats, Floats, np.ndarray]  # mm, degrees, and which poses are beside axis 1


def _three(core: Core, arm: Arm, theta: Floats) -> Errors:
    """Errors of arm_fk3 and arm_ik3, which have no degrees."""
    frame, cfg = truth_arm.frame(arm), config(core, arm)
    shoulder, elbow, yaw = theta[:, :3].T
    machine = np.stack([shoulder, elbow - frame.turn + (shoulder if frame.absolute else 0), yaw], axis=-1)

    def reached(angles: Floats) -> Floats:
        return np.stack(truth_arm.fk3(*angles.T, *arm.links, frame), axis=-1)

    tip = reached(machine)
    if core.function == "arm_fk3":
        answer = _place(core, modelled(core, _encoded(core, machine), cfg))
    else:
        rho = arm.links[0] * np.cos(shoulder) + arm.links[1] * np.cos(shoulder + elbow) + frame.shoulder
        words = _target(core, tip) | {"in_elbow": to_fixed(np.sin(elbow) < 0, 0), "in_back": to_fixed(rho < 0, 0)}
        answer = reached(_decoded(list(joints(core.outputs)), modelled(core, words, cfg)))
    return np.linalg.norm(answer - tip, axis=-1) * arm.mm_per_unit, np.zeros(0), np.zeros(0, dtype=bool)


def _six(core: Core, arm: Arm, theta: Floats) -> Errors:
    """Errors of the cores of six axes."""
    parameters, cfg = truth_six.Six(*(length / arm.mm_per_unit for length in arm.six.values())), config(core, arm)
    shoulder, elbow, yaw = theta[:, :3].T
    q = np.stack([yaw, math.pi / 2 - shoulder, -elbow - parameters.psi, *theta[:, 3:].T], axis=-1)
    rotation, tip = truth_six.fk6(q, parameters)
    scale = 2.0 ** core.params["U"]
    if core.function.startswith("fk6"):
        words = modelled(core, _encoded(core, q), cfg)
        matrix = np.stack([words[f"out_r{axis}"] for axis in six.AXES], axis=-1).reshape(-1, 3, 3) / scale
        found, beside = [(matrix, _place(core, words), np.full(len(q), True))], np.full(len(q), False)
    else:
        words = _target(core, tip) | dict(zip((f"in_r{axis}" for axis in six.AXES),
                                              to_fixed(rotation, core.params["U"]).reshape(-1, 9).T))
        every, found = core.function == "ik6_all", []
        answer = modelled(core, words if every else words | {"in_branch": _branch(q, parameters)}, cfg)
        for branch in range(8 if every else 1):
            ports = [joint for joint in joints(core.outputs) if not every or joint[0].name.endswith(str(branch))]
            kept = answer["out_far"] >> branch & 1 == 0 if every else np.full(len(q), True)
            found.append((*truth_six.fk6(_decoded(ports, answer), parameters), kept))
        centre = tip - parameters.c4 * rotation[..., 2]
        beside = np.hypot(centre[:, 0], centre[:, 1]) * arm.mm_per_unit < (arm.singular[1] or 0)
    mm = np.concatenate([np.linalg.norm(place - tip, axis=-1)[kept] for _, place, kept in found])
    turned = np.concatenate([truth_six.turned(matrix, rotation)[kept] for matrix, _, kept in found])
    return mm * arm.mm_per_unit, np.degrees(turned), np.concatenate([beside[kept] for *_, kept in found])


def _branch(q: Floats, arm: truth_six.Six) -> Ints:
    """The branch of vector_ik6 that the joints are on."""
    fore = q[:, 1] + q[:, 2]
    x1 = arm.a1 + arm.c2 * np.sin(q[:, 1]) + arm.a2 * np.cos(fore) + arm.c3 * np.sin(fore)
    return ((x1 < 0) * truth_six.BACK + (np.sin(q[:, 2] + arm.psi) < 0) * truth_six.DOWN
            + (np.sin(q[:, 4]) < 0) * truth_six.FLIP)
