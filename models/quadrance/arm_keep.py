"""These are the bit-true models of arm_keep2 and arm_keep3, which choose the branch of an inverse that is within the
limits and nearest to the last answer."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from quadrance import arm, kernel_vector_solve, kernel_vector_wide
from quadrance.fixed import Ints, ints

Params = dict[str, int]


def limit(p: Params, joint: int, low: float, high: float) -> dict[str, int]:
    """Words of the limits of a joint (radians): the direction in the middle, the cosine of half the room either side.

    A direction is within them where its cosine with the middle, cut twice to a unit, is greater than the word. A room
    of a turn and more is no limit.
    """
    one, middle, room = 1 << p["U"], (low + high) / 2, (high - low) / 2
    word = -2 * one if room >= math.pi else math.floor(math.cos(room) * one) - 3
    return {f"cfg_mc{joint}": round(math.cos(middle) * one), f"cfg_mn{joint}": round(math.sin(middle) * one),
            f"cfg_h{joint}": word}


def config(p: Params, **lengths: int) -> dict[str, int]:
    """Derived words without limits: `arm.config`, or `kernel_vector_wide.config` of two joints."""
    derive = arm.config if "LATERAL" in p else kernel_vector_wide.config
    joints = (1, 2, 3) if "LATERAL" in p else (1, 2)
    return {name: word for joint in joints for name, word in limit(p, joint, -math.pi, math.pi).items()} | derive(
        p, **lengths)


def _dot(p: Params, a: tuple[Ints, Ints], b: tuple[Ints, Ints]) -> Ints:
    """Cosine between two directions, each product truncated."""
    return (ints(a[0]) * b[0] >> p["U"]) + (ints(a[1]) * b[1] >> p["U"])


def _choose(p: Params, joints: int, branches: list[dict[str, Ints]], cfg: dict[str, int]) -> dict[str, Ints]:
    """The best branch of every sample in turn: within the limits, in reach, nearest to the last answer; else the first.

    An answer out of the limits is not remembered. A joint without a direction has that of the last answer.
    """
    one, u, count = 1 << p["U"], p["U"], branches[0]["c1"].size
    numbers = range(1, joints + 1)

    room = [tuple(np.broadcast_to(ints(cfg[f"cfg_{name}{i}"]), count) for name in ("mc", "mn", "h")) for i in numbers]

    def allowed(pose: list[tuple[Ints, Ints]]) -> Ints:
        return np.all([_dot(p, joint, (mc, mn)) > h for joint, (mc, mn, h) in zip(pose, room)], axis=0)

    limits = [[words.tolist() for words in joint] for joint in room]

    def within(pose: list[tuple[int, int]], k: int) -> bool:
        """The same of one sample."""
        return all((c * mc[k] >> u) + (n * mn[k] >> u) > h[k] for (c, n), (mc, mn, h) in zip(pose, limits))

    def together(pose: list[tuple[Ints, Ints]]) -> list[tuple[Ints, Ints]]:
        """Joint 2 as the machine measures it."""
        return [pose[0], arm.turn(p, *map(ints, (*pose[1], *pose[0]))), *pose[2:]] if p.get("ABSOLUTE") else pose

    columns = []
    for found in branches:
        raw = [(np.broadcast_to(found[f"c{i}"], count), np.broadcast_to(found[f"n{i}"], count)) for i in numbers]
        pose = together(raw)
        none = [np.broadcast_to(found.get(f"none{i}", False), count).tolist() for i in numbers]
        words = np.stack([word for joint in pose for word in joint], axis=1)
        columns.append((words.tolist(), allowed(pose).tolist(),
                        np.broadcast_to(found["status"], count).tolist(), none, raw))
    last, answers = [one, 0] * joints, []
    for k in range(count):
        best = None
        for number, (poses, fits, states, none, raw) in enumerate(columns):
            pose, fit, status = poses[k], fits[k], states[k]
            if status & 2:  # some joint has no direction
                held = [tuple(last[2 * i:2 * i + 2]) if none[i][k] else (raw[i][0][k], raw[i][1][k])
                        for i in range(joints)]
                held = [tuple(map(int, joint)) for joint in together(held)]
                pose, fit = [word for joint in held for word in joint], within(held, k)
            score = sum((pose[i] * last[i] >> u) for i in range(2 * joints))
            key = fit, not status & 1, score
            if best is None or key > best[0]:
                best = key, pose, status, number
        (fit, _, _), pose, status, number = best
        if fit:
            last = pose
        answers.append([*pose, number & 1, number >> 1, not fit, status])
    names = [f"out_{letter}{i}" for i in numbers for letter in "cn"]
    names += ["out_elbow", "out_back", "out_beyond", "out_status"]
    return dict(zip(names, ints(answers).reshape(-1, len(names)).T))


def keep2(p: Params, *, in_x: ArrayLike, in_y: ArrayLike, **cfg: Ints) -> dict[str, Ints]:
    """Joints of the tip (x, y) for the better elbow."""
    x, y = np.broadcast_arrays(ints(in_x), ints(in_y))
    kernel = kernel_vector_solve if kernel_vector_wide.form(p).bits == 16 else kernel_vector_wide
    branches = []
    for elbow in (0, 1):
        c1, n1, c2, n2, clamped, zero, _ = kernel.plane(
            p, x, y, ints(elbow), *(cfg[f"cfg_{name}"] for name in ("l1", "l2", "q", "r", "e")))
        words = (kernel_vector_wide.unit_word(p, product) for product in (c1, n1, c2, n2))
        branches.append(dict(zip(("c1", "n1", "c2", "n2"), words)) | {
            "none1": zero, "status": ints(clamped) + 2 * ints(zero)})
    answer = _choose(p, 2, branches, cfg)
    del answer["out_back"]
    return answer


def keep3(p: Params, *, in_x: ArrayLike, in_y: ArrayLike, in_z: ArrayLike, **cfg: Ints) -> dict[str, Ints]:
    """Joints of the tip (x, y, z) for the best of both elbows and both sides of the shoulder."""
    x, y, z = np.broadcast_arrays(ints(in_x), ints(in_y), ints(in_z))
    branches = [arm.branch(p, x, y, z, ints(number & 1), ints(number >> 1), cfg) for number in range(4)]
    return _choose(p, 3, branches, cfg)
