"""Bit-true model of engine_rus_ik, a pose to the cranks of six RUS legs, and its words for a robot.

The core's y is the axis that all cranks share at 90 degrees (`up` of the robot file), its x and z are the other two.
Lengths are in LSB of 18 bits: the position's LSB at W = 18, a quarter of it at W = 16.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from quadrance.conversion import vector_to_angle
from quadrance.fixed import Ints, hold_last, ints, round_shift, wrap
from quadrance.kernel_vector_solve import slopes
from quadrance.parallel.geometry import Floats, PoseError, Robot, check_pose

Params = dict[str, int]
LEGS = 6
ONE = 1 << 16  # 1.0 of rotations, link vectors and answers
FINE = 4  # fraction bits of G and S
JOINT = 8  # fraction bits of the ball joint: x, y, z, e, f, h
LOST = 2  # of cfg_k, on the average, by truncating the sum of squares
ROWS = "132"  # rows of the pose as a leg takes them: x, z, y
SHORTEST = 1 << 12  # LSB, of a crank: below it cfg_c does not fit


# The core


def _window(value: Ints, shift: Ints) -> Ints:
    """`value` times 2^(2 shift - 19), truncated, in 27 bits."""
    coarse = wrap(wrap(value, 46) << 8 * (shift >> 2) >> 13, 33)
    return wrap(coarse << 2 * (shift & 3) >> 6, 27)


def _spare(value: Ints) -> Ints:
    """Pairs of 44 bits that a value can spare, by bytes and then by pairs, at most 11."""
    coarse = np.select([value >> low & 0xFF != 0 for low in (36, 28)], [0, 1], 2)
    top = _window(value, 4 * coarse)
    return 4 * coarse + np.select([top >> low & 3 != 0 for low in (23, 21, 19)], [0, 1, 2], 3)


def _table(word: Ints, divide: bool) -> Ints:
    """sqrt or a quarter of the reciprocal of word / 2^25 (from 1/4 to 1) as a product with 49 fraction bits."""
    flip = 0x7FF if divide else 0
    low = ((~word >> 15 & 1) << 11) + ((word >> 4 & 0x7FF) ^ flip)
    w = ((word >> 16 & 0x1FF) << 12 if divide else (word >> 15 & 0x3FF) << 12) + low
    return ((w << 4) + 8) * (slopes()[1024 * divide + (word >> 16 & 0x1FF)] << 6)


def _word(product: Ints) -> Ints:
    """A coordinate of the answer, nearest (ties upward)."""
    return wrap(wrap(product >> 33, 18) + (product >> 32 & 1), 18)


def leg(row: dict[str, Ints], words: dict[str, Ints], cb: Ints, nb: Ints, cfg_k: Ints, cfg_c: Ints,
        cfg_near: Ints) -> dict[str, Ints]:
    """One leg: cosine, sine, root, and the flags far, none, near, over.

    row : "11" to "33" and "1" to "3" (position, 18 bits) of the pose; words : the leg's geometry in the same places.
    """
    over: list[Ints] = []

    def place(total: Ints) -> Ints:
        over.append(total != wrap(total, 26))
        return wrap(total, 26)

    joint, across, turn = ([words[f"{i}{j}"] for j in (1, 2, 3)] for i in ROWS)
    x, z, y = (place((row[f"{i}1"] * joint[0] + row[f"{i}2"] * joint[1] >> 8) + (row[f"{i}3"] * joint[2] >> 8)
                     + ((row[i] + words[i]) << JOINT) + 1) for i in ROWS)
    e = place((x * turn[0] + z * turn[1] >> 16) + (cb * turn[2] >> 8) + 1)
    f = place(y + (nb * turn[2] >> 8))
    h = place((x * across[0] + z * across[1] >> 16) + 1)
    square = e * e + f * f
    q = square >> 8
    product = wrap((square >> 16) + (h * h >> 16) + (cfg_k << 8) >> 10, 27) * cfg_c
    g, wide, minus = wrap(product >> 25, 23), product != wrap(product, 48), product < 0
    gap = wrap(q - g * g, 46)
    beyond = (gap < 0) | wide
    radicand = np.where(beyond, q, gap)
    shift = _spare(radicand)
    root = (_table(_window(radicand, shift), False) >> 27 & 0x3FFFFF) >> shift
    signed = [root ^ -ints(np.where(beyond, minus, (words[f"{ROWS[1]}3"] & 1) ^ first))
              for first in (1, 0)]
    g = np.where(beyond, 0, g)
    numerators = [one >> 4 for one in (e * g + np.where(beyond, e, f) * signed[0],
                                       f * g + np.where(beyond, f, e) * signed[1])]
    shift = _spare(q)
    divisor = _window(q, shift)
    reciprocal = wrap(_table(divisor, True) >> 23, 27)
    none = divisor >> 23 & 3 == 0
    cosine, sine = (_word(_window(one, shift) * reciprocal) for one in numerators)
    return {"cosine": cosine, "sine": sine, "root": root, "far": beyond | none, "none": none,
            "near": ~beyond & (root >> 10 < cfg_near), "over": np.any(over, axis=0)}


def ik(p: Params, *, in_load: Ints, in_leg: Ints, cfg_k: Ints, cfg_c: Ints, cfg_near: Ints, in_cb: Ints, in_nb: Ints,
       **pose: Ints) -> dict[str, Ints]:
    """The stream of poses and of legs' geometry, in its order; nothing is loaded before it."""
    load, to = (np.atleast_1d(ints(one)) for one in (in_load, in_leg))
    load, to = np.broadcast_arrays(load != 0, to)
    row = {name[4:]: ints(pose[name]) for name in pose if name.startswith("in_r")}
    row |= {i: ints(pose[f"in_p{axis}"]) << 18 - p["W"] for i, axis in zip("123", "xyz")}
    row = {name: np.broadcast_to(words, load.shape) for name, words in row.items()}
    cb, nb = (np.broadcast_to(ints(one), load.shape) for one in (in_cb, in_nb))
    answer, some = {}, {"far": ints(0), "near": ints(0), "over": ints(0)}
    mask = np.zeros(load.shape, dtype=np.int64)
    for number in range(LEGS):
        last = np.maximum.accumulate(np.where(load & (to == number), np.arange(load.size), -1))
        found = leg(row, {name: words[np.maximum(last, 0)] for name, words in row.items()}, cb, nb, ints(cfg_k),
                    ints(cfg_c), ints(cfg_near))
        dead = load | (last < 0)
        answer[f"out_c{number + 1}"] = np.where(dead | found["none"], ONE, found["cosine"])
        answer[f"out_n{number + 1}"] = np.where(dead | found["none"], 0, found["sine"])
        answer[f"out_s{number + 1}"] = np.where(dead | found["far"], 0, found["root"])
        far = ~load & ((last < 0) | found["far"])
        mask |= ints(far) << number
        some = {"far": some["far"] | far, "near": some["near"] | ~dead & found["near"],
                "over": some["over"] | ~dead & found["over"]}
    return answer | {"out_far": mask, "out_status": ints(some["far"]) + 2 * some["near"] + 4 * some["over"]}


def ik_angle(p: Params, **columns: Ints) -> dict[str, Ints]:
    """`ik` with binary angles of A bits; one codec takes the legs in their order."""
    answer = ik(p, **columns)
    c, n = (np.stack([answer.pop(f"out_{what}{leg + 1}") for leg in range(LEGS)], axis=-1) for what in "cn")
    angles = vector_to_angle({"U": 16, "A": p["A"]}, in_c=c.ravel(), in_n=n.ravel())["out_j"].reshape(c.shape)
    return {f"out_j{leg + 1}": angles[:, leg] for leg in range(LEGS)} | answer


# A pose's rotation as a quaternion


def quaternion_to_matrix(p: Params, *, in_w: Ints, in_x: Ints, in_y: Ints, in_z: Ints) -> dict[str, Ints]:
    """Rotation matrix of a unit quaternion; the last one, at first the unit matrix, where it is none."""
    u = p["U"]
    w, *q = np.broadcast_arrays(*map(ints, (in_w, in_x, in_y, in_z)))

    def cut(a: Ints, b: Ints) -> Ints:
        return a * b >> u - 4

    low = max(u - 5, 6)  # bit of 2^-9, or of 4 units of 2^-U where they are more: |q|^2 has U + 4 fraction bits
    off = cut(w, w) + sum(cut(one, one) for one in q) + 8 - (1 << u + 4) >> low
    unit = (off == 0) | (off == -1)
    answer = {}
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        across, along = cut(q[i], q[j]), cut(w, q[k])
        answer[i, i] = (1 << u) - (cut(q[j], q[j]) + cut(q[k], q[k]) + 4 >> 3)
        answer[i, j], answer[j, i] = across - along + 4 >> 3, across + along + 4 >> 3
    held = {f"out_r{i + 1}{j + 1}": hold_last(wrap(word, u + 2), unit, (i == j) << u)
            for (i, j), word in answer.items()}
    return held | {"out_status": 2 * ints(~unit)}


# Is a pose's matrix a rotation?


def rotation_check(p: Params, **ports: Ints) -> dict[str, Ints]:
    """The words of a matrix, and whether |a| = |b| = 1, a . b = 0, a x b = c of its columns, each to 16 units."""
    u = p["U"]
    r = {name[4:]: ints(words) for name, words in ports.items()}
    a, b, c = ([r[row + column] for row in "123"] for column in "123")
    sums = [sum(x * y for x, y in zip(*pair)) for pair in ((a, a), (b, b), (a, b))]
    sums[:2] = (total - (1 << 2 * u) for total in sums[:2])
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        sums.append(a[j] * b[k] + ~a[k] * b[j] - (c[i] << u))
    wrong = np.any([wrap(total, u + 5) != total for total in sums], axis=0)
    return {f"out_r{name}": words for name, words in r.items()} | {"out_status": 8 * ints(wrong)}


# Words for a robot


def frame(robot: Robot) -> Floats:
    """(3, 3): rows are the core's x, y, z in the robot's frame."""
    x = np.eye(3)[2 if robot.up[0] else 0]
    return np.array([x, robot.up, np.cross(x, robot.up)])


def _check(words: np.ndarray, bits: int, what: str) -> Ints:
    found = ints(np.floor(words + 0.5))
    if np.any(found != wrap(found, bits)):
        raise PoseError(f"{what}: does not fit {bits} bits at this mm_per_lsb")
    return found


def config(p: Params, robot: Robot, mm_per_lsb: float, near: float = 0.0) -> dict[str, int]:
    """The cfg words of a robot whose cranks and rods are alike; `near` is the root in mm below which a leg is singular.

    mm_per_lsb : millimetres in an LSB of 18 bits, whatever W is.

    Raises
    ------
    PoseError
        Where legs differ, or a word does not fit.
    """
    la, lb = robot.la[0] / mm_per_lsb, robot.lb[0] / mm_per_lsb
    if np.any(robot.la != robot.la[0]) or np.any(robot.lb != robot.lb[0]):
        raise PoseError(f"{robot.id}: the core wants legs of equal cranks and rods")
    if la < SHORTEST + 1 or max(la, lb) >= 1 << 17:
        raise PoseError(f"{robot.id}: a crank has {SHORTEST + 1} LSB and more, crank and rod less than 2^17; "
                        f"they have {la:.0f} and {lb:.0f}")
    lost = LOST + la * 2.0 ** (FINE - 16)  # by truncating the squares and G
    return {"cfg_k": round((la * la - lb * lb) * 2.0 ** (2 * FINE - 16) + lost),
            "cfg_c": round(2.0 ** (42 - FINE) / la),
            "cfg_near": min(math.ceil(near / mm_per_lsb / 64), 0xFFF)}


def _sample(load: int, leg_number: int, rows: np.ndarray, position: np.ndarray, p: Params, cb: float = 0,
            nb: float = 0) -> dict[str, int]:
    words = {f"in_r{i + 1}{j + 1}": int(rows[i, j]) for i in range(3) for j in range(3)}
    down = _check(position / 2.0 ** (18 - p["W"]), p["W"], "position")
    return {"in_load": load, "in_leg": leg_number, **words,
            **{f"in_p{axis}": int(one) for axis, one in zip("xyz", down)}, "in_cb": int(cb), "in_nb": int(nb)}


def geometry(p: Params, robot: Robot, mm_per_lsb: float) -> list[dict[str, int]]:
    """One load sample a leg: input words by port name."""
    turn = frame(robot)
    samples = []
    for number in range(robot.legs):
        joint, foot, radial = (turn @ one[number] for one in (robot.joint, robot.foot, robot.radial))
        rows = np.array([joint / mm_per_lsb, [radial[0] * ONE, radial[2] * ONE, -robot.link[number] / mm_per_lsb],
                         [radial[2] * ONE, -radial[0] * ONE, robot.branch[number] < 0]])
        samples.append(_sample(1, number, _check(rows, 18, f"leg {number + 1}"), -foot / mm_per_lsb, p))
    return samples


def poses(p: Params, robot: Robot, mm_per_lsb: float, rotation: ArrayLike, position: ArrayLike,
          beta: ArrayLike = 0.0) -> dict[str, Ints]:
    """Pose samples (N) as columns by port name, from rotations (N, 3, 3), positions (N, 3) in mm and beta (N).

    Raises
    ------
    PoseError
        For a matrix that is no rotation, or a word that does not fit.
    """
    turn = frame(robot)
    rotation, position = check_pose(rotation, position)
    position, beta = np.broadcast_arrays(position, np.asarray(beta, dtype=np.float64)[..., None])
    rotation = np.broadcast_to(rotation, (*position.shape[:-1], 3, 3))
    words = _check(turn @ rotation @ turn.T * ONE, 18, "rotation")
    place = _check(position @ turn.T / mm_per_lsb / 2.0 ** (18 - p["W"]), p["W"], "position")
    link = beta[..., 0]
    return {"in_load": ints(np.zeros(link.shape)), "in_leg": ints(np.zeros(link.shape)),
            **{f"in_r{i + 1}{j + 1}": words[..., i, j] for i in range(3) for j in range(3)},
            **{f"in_p{axis}": place[..., i] for i, axis in enumerate("xyz")},
            "in_cb": round_shift(ints(np.floor(np.cos(link) * 2 * ONE)), 1),
            "in_nb": round_shift(ints(np.floor(np.sin(link) * 2 * ONE)), 1)}


def stream(loads: list[dict[str, int]], samples: dict[str, Ints]) -> dict[str, Ints]:
    """Load samples, then poses, as columns."""
    return {name: np.concatenate([ints([one[name] for one in loads]), words]) for name, words in samples.items()}


# The truth of words


def exact(p: Params, columns: dict[str, Ints], cfg_k: int, cfg_c: int) -> dict[str, Floats]:
    """What the words of poses say, in float64: arrays (N, legs) of angle, and in LSB of 18 bits of root, gap S^2, flat
    sqrt(e^2 + f^2) and distance |d|.

    The last geometry of each leg in `columns` holds for all of them.
    """
    value = {name: ints(words).astype(np.float64) for name, words in columns.items()}
    load = ints(columns["in_load"]) == 1
    la = 2.0 ** (42 - FINE) / cfg_c
    found: dict[str, list[Floats]] = {"angle": [], "root": [], "gap": [], "flat": [], "distance": []}
    for number in range(LEGS):
        at = np.flatnonzero(load & (columns["in_leg"] == number))
        if not at.size:
            continue
        of = {name: words[at[-1]] for name, words in value.items()}
        scale = 2.0 ** (18 - p["W"])
        x, y, z = (sum(value[f"in_r{i}{j}"] / ONE * of[f"in_r1{j}"] for j in (1, 2, 3))
                   + (value[f"in_p{axis}"] + of[f"in_p{axis}"]) * scale for i, axis in zip((1, 2, 3), "xyz"))
        ct, st, link = of["in_r21"] / ONE, of["in_r22"] / ONE, of["in_r23"]
        e, f = x * ct + z * st + link * value["in_cb"] / ONE, y + link * value["in_nb"] / ONE
        h = x * of["in_r31"] / ONE + z * of["in_r32"] / ONE
        g = (e * e + f * f + h * h + (cfg_k - LOST - la * 2.0 ** (FINE - 16)) * 2.0 ** (16 - 2 * FINE)) / (2 * la)
        gap = e * e + f * f - g * g
        root = np.sqrt(np.maximum(gap, 0))
        g = np.where(gap < 0, np.copysign(np.hypot(e, f), g), g)
        s = -root if int(of["in_r33"]) & 1 else root
        found["angle"].append(np.arctan2(f * g + e * s, e * g - f * s))
        found["root"].append(root)
        found["gap"].append(gap)
        found["flat"].append(np.hypot(e, f))
        found["distance"].append(np.sqrt(e * e + f * f + h * h))
    return {name: np.stack(rows, axis=-1) for name, rows in found.items()}
