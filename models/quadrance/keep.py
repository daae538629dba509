"""Bit-true models of six_keep and ur_keep: the nearest of eight branches within limits, in the words of a machine."""

from __future__ import annotations

import math
from collections.abc import Sequence
from types import ModuleType

import numpy as np

from quadrance import conversion, six, ur
from quadrance.fixed import Ints, ints, wrap
from quadrance.product_engine import H

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


def choose(p: Params, vectors: tuple[Ints, Ints], mirrored: Ints, opposite: Ints, far: Ints, held: Ints,
           ports: dict[str, Ints]) -> dict[str, Ints]:
    """The best branch of every sample in turn: within the limits, in reach, nearest to the last answer; else the first.

    Parameters
    ----------
    vectors : cosines and sines of the engine, by sample, branch and joint.
    mirrored, opposite : by branch and joint, whether the sine is negated, or the vector.
    far, held : by sample and branch, out of reach and singular.
    ports : the words of `machine`.
    """
    a, count = p["A"], len(far)
    turn = 1 << a
    # Words rounded down, and half a unit more: the negative of one is its one's complement
    u = min(p["U"], 17)
    c, n = (word >> H - u for word in vectors)
    halves = {f"in_{letter}": 2 * word.ravel() + 1 for letter, word in (("c", c), ("n", n ^ -ints(mirrored)))}
    angles = conversion.vector_to_angle(p | {"U": u + 1}, **halves)["out_j"].reshape(n.shape)
    angles = angles + (ints(opposite) << a - 1)
    cfg = {name: np.stack([np.broadcast_to(ints(ports[f"cfg_{name}{i}"]), count) for i in range(1, 7)], axis=-1)
           for name in ("z", "low", "high", "w")}
    turned, coupled = (np.broadcast_to(ints(ports[f"cfg_{name}"]), count)[:, None] >> np.arange(bits) & 1
                       for name, bits in (("turned", 6), ("coupled", 5)))
    angles[..., 1:] += angles[..., :-1].copy() * coupled[:, None]
    words = np.where(turned[:, None] == 1, -angles, angles) + cfg["z"][:, None] & turn - 1
    low, high = (cfg[name] << a - LIMIT for name in ("low", "high"))
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
    return dict(zip(names, ints(rows).reshape(-1, len(names)).T))


MACHINE = ("cfg_turned", "cfg_coupled", *(f"cfg_{name}{i}" for name in ("z", "low", "high", "w") for i in range(1, 7)))


def apart(ports: dict[str, Ints]) -> tuple[dict[str, Ints], dict[str, Ints]]:
    """Ports of a core that chooses: those of the inverse, and those of the machine's joints."""
    pose = {name: word for name, word in ports.items() if name not in MACHINE}
    return pose, {name: ports[name] for name in MACHINE}


def joints(*numbers: int) -> Ints:
    """A one for each of these joints."""
    return ints([i in numbers for i in range(1, 7)])


def kept(p: Params, solver: ModuleType, mirrored: Ints, opposite: Ints, ports: dict[str, Ints]) -> dict[str, Ints]:
    """`choose` from the branches of a module that has `solved`, `named` and `flags`."""
    pose, machine_words = apart(ports)
    outcome = solver.solved(p, **pose)
    vectors = tuple(np.stack([outcome.words[f"{letter}{i}{name}"] for branch in range(8)
                              for i, name in enumerate(solver.named(branch), 1)], axis=-1).reshape(-1, 8, 6)
                    for letter in "cn")
    far, held = (np.stack(flag, axis=-1) for flag in zip(*(solver.flags(outcome, branch) for branch in range(8))))
    found = choose(p, vectors, mirrored, opposite, far, held, machine_words)
    return found | {"out_status": found["out_status"] + 8 * ints(outcome.wrong)}


def six_keep(p: Params, **ports: Ints) -> dict[str, Ints]:
    """A pose to the joint words of the best branch of `six.ik6_all`; a wrist that is turned over by its angles."""
    over = np.arange(8)[:, None] >> 2
    return kept(p, six, over * joints(5), over * joints(4, 6), ports)


def ur_keep(p: Params, **ports: Ints) -> dict[str, Ints]:
    """A pose to the joint words of the best branch of `ur.ik_all`; joints 3, 5 and 6 by the angles of the other one."""
    down, flip = (np.arange(8)[:, None] >> i & 1 for i in (1, 2))
    return kept(p, ur, down * joints(3) + flip * joints(5), flip * joints(6), ports)
