"""An arm as a core sees it: its joints and axes, its link lengths in words, the configuration words of the core."""

from __future__ import annotations

import importlib
import inspect

from quadrance.arms import Arm
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
        ``cfg_l1`` and ``cfg_l2``. A family whose cores need more has ``config(p, *, cfg_l1, cfg_l2) -> dict`` beside
        its models.

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
        try:
            inspect.signature(derive).bind(core.params, **lengths)
        except TypeError:
            raise ValueError(f"{core.id}: {missing} follow from more than two links; see quadrance.{module}.config"
                             ) from None
        words |= {name: int(word) for name, word in derive(core.params, **lengths).items()}
    if missing := sorted(set(names) - set(words)):
        raise ValueError(f"{core.id}: no arm of two links says what {missing} are")
    return {name: words[name] for name in names}


def config(core: Core, arm: Arm) -> dict[str, int]:
    """Configuration words of `core` for `arm`, its links rounded to LSB."""
    if "F" not in core.params:
        return configure(core)
    lengths = to_fixed(arm.links, core.params["F"])
    return configure(core, **{f"cfg_l{i}": int(length) for i, length in enumerate(lengths, 1)})
