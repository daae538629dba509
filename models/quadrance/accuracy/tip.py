"""Errors of kinematic cores at the tip of the arm, in LSB of a coordinate (2^-F units).

**arithmetic**, what the core computes less well than its words allow:

* forward: distance from the answered tip to the float64 tip of the *quantised* joints and links;
* inverse: distance from the float64 tip of the true solution (of the *quantised* target) to the tip of the solution
  that the answered words represent. A word represents every direction that rounds to it, so a correctly rounded
  answer has arithmetic error 0 and the half LSB of the word belongs to the quantisation. Of these directions, joint
  by joint the nearest to the true one, or the words' own: where the arm is stretched or folded one joint makes good
  for the other, and the nearest one by one would tear them apart.

**quantisation**, what an exact core of the same words would still lose: rounding of joints, targets, links and, for
inverse cores, of the answered joints.

**total**, both together:

* forward: distance from the answered tip to the float64 tip of the unquantised joints and links;
* inverse: distance from the float64 tip of the answered words, on the unquantised links, to the unquantised target, or
  to the nearest point in reach.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from quadrance import codecs, truth
from quadrance.accuracy import primitives
from quadrance.accuracy.arm import AXES, JOINTS, joint_ports, links
from quadrance.accuracy.cases import Case
from quadrance.arms import Arm
from quadrance.cores import Core
from quadrance.fixed import Ints, to_float
from quadrance.truth import Floats


@dataclass(frozen=True)
class Errors:
    """Errors (N,) of the samples in LSB; the last two are None for primitives. Undefined samples are left out."""

    arithmetic: Floats
    quantisation: Floats | None = None
    total: Floats | None = None


def summary(error: Floats | None, scale: float = 1.0) -> dict[str, float] | None:
    """Greatest and root-mean-square error, times `scale`; None where there is nothing to summarise."""
    if error is None or not error.size:
        return None
    return {"max": float(np.max(error)) * scale, "rms": float(np.sqrt(np.mean(error * error))) * scale}


def errors(core: Core, arm: Arm, case: Case, outputs: dict[str, Ints], every: bool = False) -> Errors | None:
    """Errors of the answers of `core` to `case`.

    Parameters
    ----------
    core, arm, case
        As the case was made.
    outputs : dict
        Words (N,) of every output port.
    every : bool
        Samples without a truth stay, as NaN.

    Returns
    -------
    Errors or None
        In LSB of a coordinate; of a primitive, in LSB of its output. None for a function that has no truth here.
    """
    if core.function in primitives.PRIMITIVES:
        return Errors(primitives.error(core, case.inputs, outputs))
    if core.function not in JOINTS:
        return None
    forward = core.function.startswith("fk")
    valid, *found = (_forward if forward else _inverse)(core, arm, case, outputs)
    lsb = 2.0 ** core.params["F"]
    return Errors(*(np.where(valid, error, np.nan) * lsb if every else error[valid] * lsb for error in found))


def _forward(core: Core, arm: Arm, case: Case, outputs: dict[str, Ints]) -> tuple[Floats, ...]:
    """Where there is a truth, and the three errors in units."""
    f = core.params["F"]
    quantised = np.stack([codecs.decode(joint, case.inputs) for joint in joint_ports(core)], axis=-1)
    exact = truth.tip(quantised, *links(core, arm))
    answer = np.zeros_like(exact)
    for i, axis in enumerate(AXES[core.function]):
        answer[:, i] = to_float(outputs[f"out_{axis}"], f)
    limit = 2.0 ** (core.params["W"] - 1 - f)
    valid = np.all(np.abs(exact) < limit - 2.0**-f, axis=-1)  # saturation is flagged, not an arithmetic error
    return valid, _distance(answer, exact), _distance(exact, case.tip), _distance(answer, case.tip)


def _inverse(core: Core, arm: Arm, case: Case, outputs: dict[str, Ints]) -> tuple[Floats, ...]:
    """Where there is a truth, and the three errors in units."""
    joints, words = joint_ports(core), links(core, arm)
    exact = _solution(core, case.inputs, words)
    valid = np.all(np.isfinite(exact), axis=-1)
    for port in core.inputs:  # a target that the word cannot hold is not the core's error
        valid &= (case.inputs[port.name] >= port.low) & (case.inputs[port.name] <= port.high)
    exact = np.where(valid[:, None], exact, 0)

    def of(angle) -> Floats:
        return np.stack([angle(joint, theta) for joint, theta in zip(joints, exact.T)], axis=-1)

    within = of(lambda joint, theta: codecs.within_cell(joint, outputs, theta))
    rounded = of(lambda joint, theta: codecs.decode(joint, codecs.encode(joint, theta)))
    answered = of(lambda joint, theta: codecs.decode(joint, outputs))
    solution, reached = truth.tip(exact, *words), truth.tip(answered, *words)
    arithmetic = np.minimum(_distance(truth.tip(within, *words), solution), _distance(reached, solution))
    nearest = truth.nearest(case.tip, *(arm.links if len(joints) > 1 else (arm.links[0], 0.0)))
    return (valid, arithmetic, _distance(truth.tip(rounded, *arm.links), case.tip),
            _distance(truth.tip(answered, *arm.links), nearest))


def _solution(core: Core, inputs: dict[str, Ints], lengths: tuple[float, float]) -> Floats:
    """True joints (N, joints) of the quantised target."""
    target = [to_float(inputs[f"in_{axis}"], core.params["F"]) for axis in AXES[core.function]]
    elbow = inputs.get("in_elbow", 0)
    solved = (truth.ik1(*target),) if core.function == "ik1" else \
        truth.ik2(*target, *lengths, elbow) if core.function == "ik2" else \
        truth.ik3(*target, *lengths, elbow, inputs.get("in_back", 0))
    return np.stack(solved, axis=-1)


def _distance(a: Floats, b: Floats) -> Floats:
    return np.linalg.norm(a - b, axis=-1)
