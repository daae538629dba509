"""Bit-true models of six_keep and ur_keep: the nearest of eight branches within limits, in the words of a machine."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from quadrance import conversion, six, ur
from quadrance.fixed import Ints, ints, wrap

Params = dict[str, int]

TURNS = 3  # bits of a joint word above a turn's, the sign included
LIMIT = 12  # fraction bits of a limit in turns
WEIGHT = 63  # the largest weight


def machine(p: Params, *, turned: Sequence[bool], coupled: Sequence[bool], zeros: Sequence[float],
            limits: Sequence[tuple[float, float]], weights: Sequence[float]) -> dict[str, int]:
    """Configuration words of the machine's joints, which are +-(angle [+ angle of the joint before]) + zero.

    Parameters
    ----------
    turned, coupled : of each joint, whether it counts against the core's angle, and together with the joint before.
    zeros, limits : of the machine's joints, radians. A limit is rounded inwards to 2^-12 turn.
    weights : of a radian of each joint, in any unit.
    """
    words = {"cfg_turned": sum(bool(one) << i for i, one in enumerate(turned)),
             "cfg_coupled": sum(bool(one) << i for i, one in enumerate(coupled[1:]))}
    for i, (zero, (low, high), weight) in enumerate(zip(zeros, limits, weights), 1):
        turn = 2 * math.pi
        words |= {f"cfg_z{i}": round(zero / turn * 2 ** p["A"]) % 2 ** p["A"],
                  f"cfg_low{i}": math.ceil(round(low / turn * 2**LIMIT, 6)),
                  f"cfg_high{i}": math.floor(round(high / turn * 2**LIMIT, 6)),
                  f"cfg_w{i}": round(WEIGHT * weight / max(weights))}
    return words


def choose(p: Params, answers: dict[str, Ints], ports: dict[str, Ints]) -> dict[str, Ints]:
    """The best branch of every sample in turn: within the limits, in reach, nearest to the last answer; else the first.

    Parameters
    ----------
    answers : of `six.ik6_all` or `ur.ik_all`, an array a port.
    ports : the words of `machine`.
    """
    a, count = p["A"], len(answers["out_status"])
    turn = 1 << a
    shape = [(joint, branch) for branch in range(8) for joint in range(1, 7)]
    c, n = (np.stack([answers[f"out_{letter}{joint}{branch}"] for joint, branch in shape], axis=1).ravel()
            for letter in "cn")
    angles = conversion.vector_to_angle(p, in_c=c, in_n=n)["out_j"].reshape(count, 8, 6)
    cfg = {name: np.stack([np.broadcast_to(ints(ports[f"cfg_{name}{i}"]), count) for i in range(1, 7)], axis=-1)
           for name in ("z", "low", "high", "w")}
    turned, coupled = (np.broadcast_to(ints(ports[f"cfg_{name}"]), count)[:, None] >> np.arange(bits) & 1
                       for name, bits in (("turned", 6), ("coupled", 5)))
    angles[..., 1:] += angles[..., :-1].copy() * coupled[:, None]
    words = np.where(turned[:, None] == 1, -angles, angles) + cfg["z"][:, None] & turn - 1
    low, high = (cfg[name] << a - LIMIT for name in ("low", "high"))
    far, held = (answers[f"out_{name}"][:, None] >> np.arange(8) & 1 for name in ("far", "held"))
    last, rows = np.zeros(6, np.int64), []
    for k in range(count):
        step = wrap(words[k] - last, a)
        near = wrap(last + step, a + TURNS)
        under, over = near < low[k], near > high[k]
        up, down = (under & ~over & (near + turn <= high[k])), (over & ~under & (near - turn >= low[k]))
        move = ints(up) - ints(down)
        fit = np.all(up | down | ~under & ~over, axis=1)
        cost = np.sum(np.abs(step + move * turn) * cfg["w"][k], axis=1)
        best = np.lexsort((np.arange(8), cost, far[k], ~fit))[0]
        answer = wrap(near[best] + move[best] * turn, a + TURNS)
        if fit[best]:
            last = answer
        rows.append([*answer, best, not fit[best], far[k][best] + 2 * held[k][best]])
    names = [*(f"out_j{i}" for i in range(1, 7)), "out_branch", "out_beyond", "out_status"]
    found = dict(zip(names, ints(rows).reshape(-1, len(names)).T))
    return found | {"out_status": found["out_status"] + (answers["out_status"] & 8)}


MACHINE = ("cfg_turned", "cfg_coupled", *(f"cfg_{name}{i}" for name in ("z", "low", "high", "w") for i in range(1, 7)))


def apart(ports: dict[str, Ints]) -> tuple[dict[str, Ints], dict[str, Ints]]:
    """Ports of a core that chooses: those of the inverse, and those of the machine's joints."""
    pose = {name: word for name, word in ports.items() if name not in MACHINE}
    return pose, {name: ports[name] for name in MACHINE}


def six_keep(p: Params, **ports: Ints) -> dict[str, Ints]:
    """A pose to the joint words of the best branch of `six.ik6_all`."""
    pose, joints = apart(ports)
    return choose(p, six.ik6_all(p, **pose), joints)


def ur_keep(p: Params, **ports: Ints) -> dict[str, Ints]:
    """A pose to the joint words of the best branch of `ur.ik_all`."""
    pose, joints = apart(ports)
    return choose(p, ur.ik_all(p, **pose), joints)
