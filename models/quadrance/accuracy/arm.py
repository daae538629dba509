"""This module turns an arm into what a core gets: joints and axes, link lengths in words, configuration words."""

from __future__ import annotations

import importlib
import inspect
import math

from quadrance import arm as arm_model
from quadrance import arm_keep, six, srs, ur
from quadrance.arms import Arm, ArmError
from quadrance.cores import Core, Joint, joints
from quadrance.fixed import to_fixed, to_float

JOINTS = {"fk1": 1, "fk2": 2, "fk3": 3, "ik1": 1, "ik2": 2, "ik3": 3}
AXES = {"fk1": "xy", "fk2": "xy", "fk3": "xyz", "ik1": "xy", "ik2": "xy", "ik3": "xyz"}


def joint_ports(core: Core) -> list[Joint]:
    """The ports of joints 1, 2 ... : inputs of a forward core, outputs of an inverse one."""
    ports = {joint[0].name[-1]: joint for joint in joints(core.inputs if core.function.startswith("fk")
                                                          else core.outputs)}
    return [ports[f"{i + 1}"] for i in range(JOINTS[core.function])]


def mm_per_lsb(core: Core, arm: Arm) -> float:
    """Millimetres in one coordinate LSB."""
    return arm.mm_per_unit * 2.0 ** -core.params["F"]


def links(core: Core, arm: Arm) -> tuple[float, float]:
    """Link lengths as the core's words hold them, in units."""
    f = core.params["F"]
    return tuple(float(to_float(to_fixed(link, f), f)) for link in arm.links)


def configure(core: Core, **lengths: int) -> dict[str, int]:
    """Configuration words of `core` for link lengths in LSB.

    Parameters
    ----------
    core : Core
    **lengths : int
        ``cfg_l1``, ``cfg_l2`` and what else of its words is given; `margin` and `slack`, in coordinate units, of a core
        with MARGINS = 1. A family whose cores need more has ``config(p, *, cfg_l1, cfg_l2) -> dict`` beside its models.

    Returns
    -------
    dict
        A word for every ``cfg_*`` port of the core.
    """
    words, names = dict(lengths), [port.name for port in core.cfg]
    if missing := sorted(set(names) - set(words)):
        module = core.model_name.rpartition(".")[0]
        derive = getattr(importlib.import_module(f"quadrance.{module}"), "config", None)
        if derive is None:
            raise ValueError(f"{core.id}: quadrance.{module} has no config() for {missing}")
        links = {name: word for name, word in lengths.items() if name in ("cfg_l1", "cfg_l2", "margin", "slack")}
        try:
            inspect.signature(derive).bind(core.params, **links)
        except TypeError:
            raise ValueError(f"{core.id}: {missing} follow from more than two links; see quadrance.{module}.config"
                             ) from None
        words = {name: int(word) for name, word in derive(core.params, **links).items()} | words
    if missing := sorted(set(names) - set(words)):
        raise ValueError(f"{core.id}: no arm of two links says what {missing} are")
    return {name: words[name] for name in names}


def config(core: Core, arm: Arm) -> dict[str, int]:
    """Configuration words of `core` for `arm`, its lengths rounded to LSB.

    The switches of a core of rtl/arm are to be those of the arm (`quadrance.arm.switches`).

    Raises
    ------
    ArmError
        Naming the key of the arm file that is missing, or whose word does not fit.
    ValueError
        For a core with words that no arm file says.
    """
    p, function = core.params, core.function
    margin = (arm.singular[1] or 0.0) / arm.mm_per_unit
    if core.family == "srs":
        lengths = {name: length / arm.mm_per_unit for name, length in arm.srs.items()}
        return srs.config(p, **lengths, margin=margin)
    if core.family == "six" and function in ("velocity6", "rates6"):
        lengths = {name: length / arm.mm_per_unit for name, length in arm.six.items() if name != "c1"}
        if function == "velocity6":
            return six.motion_config(p, **lengths)
        angle, radius = (_said(arm, f"singular.{key}", value) for key, value in zip(("elbow", "axis"), arm.singular))
        return six.rates_config(p, **lengths, radius=radius / arm.mm_per_unit, angle=math.radians(angle))
    if core.family == "six":
        derive = six.forward_config if function.startswith("fk6") else six.config
        edges = {"margin": margin} if function == "ik6_all" or p.get("MARGINS") else {}
        return derive(p, **{name: length / arm.mm_per_unit for name, length in arm.six.items()}, **edges)
    if core.family == "ur":
        lengths = {name: length / arm.mm_per_unit for name, length in arm.ur.items()}
        if function.startswith("ur_fk"):
            return ur.forward_config(p, **lengths)
        return ur.config(p, **lengths, margin=margin)
    if function in ("arm_fk3", "arm_ik3"):
        found = arm_model.words(p, arm, inverse=function == "arm_ik3")
        return found | ({"cfg_margin": int(to_fixed(margin, p["F"]))} if p.get("MARGINS") else {})
    if function == "keep3":
        return arm_model.words(p, arm, inverse=True) | _limits(core, arm)
    if "F" not in p:
        return configure(core)
    lengths = {f"cfg_l{i}": int(length) for i, length in enumerate(to_fixed(arm.links, p["F"]), 1)}
    names = [port.name for port in core.cfg]
    if "cfg_l3" in names:
        lengths["cfg_l3"] = int(to_fixed(_said(arm, "links.l3", arm.l3) / arm.mm_per_unit, p["F"]))
    if "cfg_sine" in names:
        sine = math.sin(math.radians(_said(arm, "singular.elbow", arm.singular[0])))
        lengths["cfg_sine"] = int(to_fixed(sine, p["U"]))
    if "cfg_radius" in names:
        lengths["cfg_radius"] = int(to_fixed(_said(arm, "singular.axis", arm.singular[1]) / arm.mm_per_unit, p["F"]))
    edges = {"margin": margin} if p.get("MARGINS") else {}
    return configure(core, **lengths, **edges, **(_limits(core, arm) if function == "keep2" else {}))


def _said(arm: Arm, key: str, value):
    if value is None:
        raise ArmError(f"{arm.id}: {key}: is missing")
    return value


def limits(core: Core, arm: Arm) -> list[tuple[str, float, float]]:
    """(key, low, high), degrees, of the joints of arm_keep2 and arm_keep3 as these measure them."""
    shoulder, elbow, *yaw = arm.limits
    joints = [("shoulder", *shoulder), ("elbow", *elbow)]
    if core.function == "keep2":
        return joints
    if arm.absolute_elbow:
        joints[1] = ("forearm", *_said(arm, "limits.forearm", arm.forearm_limit))
    else:
        joints[1] = ("elbow", elbow[0] - arm.elbow_angle, elbow[1] - arm.elbow_angle)
    return [*joints, ("yaw", *_said(arm, "limits.yaw", yaw[0] if yaw else None))]


def _limits(core: Core, arm: Arm) -> dict[str, int]:
    return {name: word for i, (_, *ends) in enumerate(limits(core, arm), 1)
            for name, word in arm_keep.limit(core.params, i, *map(math.radians, ends)).items()}
