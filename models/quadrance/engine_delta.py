"""Bit-true model of engine_delta_fk, three cranks of a rotary delta to its tip, and its words for a robot.

Words have 25 fraction bits, as on every program of the product engine, and 1.0 of a length is 2^(W + 2) LSB: what is
formed of lengths then stays within a word. The frame: origin in the middle of the crank axes' plane, z along `up`.
"""

from __future__ import annotations

import numpy as np

from quadrance import conversion
from quadrance.fixed import Ints, hold_last, ints, round_shift, saturate
from quadrance.parallel.geometry import Floats, PoseError, Robot
from quadrance.product_engine import ONE, H, dot, fold, low, power_of, reciprocal, root, rounded, sum_of, term
from quadrance.six import MORE

Params = dict[str, int]
Vector = list[Ints]
UP = 2  # 1.0 is 2^(W + UP) LSB
FLOOR = 7  # bit of |Q|^2 below which it is taken for nothing


def _cross(a: Vector, b: Vector) -> Vector:
    return [dot((a[i - 2], b[i - 1]), (a[i - 1], b[i - 2], -1)) for i in range(3)]


def _square(a: Vector) -> Ints:
    return dot(*zip(a, a))


def fk(p: Params, **ports: Ints) -> dict[str, Ints]:
    """The tip lies on three spheres of radius LB about the shifted elbows E1, E1 + a, E1 + b.

    With N = a x b, V = |a|^2 b - |b|^2 a and D = 4 LB^2 N^2 - V^2 it is E1 + LB Q / |Q|, Q = V x N -+ N sqrt(D); D < 0:
    the spheres do not meet. V, N, D are scaled up as |a|^2, |b|^2 allow.
    """
    ports = dict(zip(ports, (ints(word) for word in np.broadcast_arrays(*map(np.atleast_1d, ports.values())))))
    length = {name: ports[f"cfg_{name}"] << H - p["W"] - UP - MORE for name in ("base", "la", "lb")}
    c, n = ([ports[f"in_{letter}{i}"] << H - p["U"] for i in (1, 2, 3)] for letter in "cn")
    rx, ry = ([ports[f"cfg_{letter}{i}"] for i in (1, 2, 3)] for letter in "cn")
    radius = [dot((one, length["la"]), (length["base"], ONE)) for one in c]
    first = [dot((rx[0], radius[0])), dot((ry[0], radius[0])), dot((n[0], length["la"]))]
    a, b = ([dot((rx[i], radius[i]), (first[0], ONE, -1)), dot((ry[i], radius[i]), (first[1], ONE, -1)),
             dot((n[i], length["la"]), (first[2], ONE, -1))] for i in (1, 2))
    aa, bb, normal = _square(a), _square(b), _cross(a, b)
    power = power_of(fold(aa) | fold(bb))
    up = [low(one, power) for one in normal]
    aa, bb = low(aa, power), low(bb, power)
    v = [dot((aa, one), (bb, other, -1)) for one, other in zip(b, a)]
    reach = [dot((length["lb"] << 1, one)) for one in up]
    total = sum_of(*(term(one, one) for one in reach), *(~term(one, one) for one in v))
    far = total < 0
    h = root(np.where(far, 0, rounded(total)), (normal[2] >= 0) ^ (ports["cfg_above"] != 0))
    q = [dot((h, one), (other, ONE)) for one, other in zip(up, _cross(v, up))]
    square = _square(q)
    seen = fold(square) >> FLOOR << FLOOR
    none, power = seen == 0, power_of(seen)
    s = np.ceil(np.log2(np.maximum(power, 1) + 0.5)).astype(np.int64) - 1
    shift = np.maximum(s - 1, 0) // 2
    argument = low(square, np.where(none, 0, 1 << 2 * shift)) >> 7
    rod = dot((reciprocal(argument, power == 1), length["lb"]))  # the engine's sign of a root of 1.0 and more
    answer, overflow, never = {}, ints(0), np.logical_and.accumulate(none, axis=-1)
    for name, one, elbow in zip("xyz", q, first):
        word = hold_last(dot((rod, low(one, 2 << shift)), (elbow, ONE)), ~none)
        answer[f"out_{name}"], over = saturate(round_shift(np.where(never, elbow, word), H - p["W"] - UP), p["W"])
        overflow = overflow | over
    far = far | (total >> 3 >= ONE * 2)
    return answer | {"out_status": ints(far) + 2 * ints(none) + 4 * ints(overflow)}


def fk_angle(p: Params, **ports: Ints) -> dict[str, Ints]:
    """`fk` of binary angles, each by angle_to_vector."""
    words = {name: word for name, word in ports.items() if name.startswith("cfg_")}
    for i in (1, 2, 3):
        vectors = conversion.angle_to_vector(p, in_j=ports[f"in_j{i}"])
        words |= {f"in_{letter}{i}": vectors[f"out_{letter}"] for letter in "cn"}
    return fk(p, **words)


def config(p: Params, robot: Robot, mm_per_lsb: float, below: bool = True) -> dict[str, int]:
    """The cfg words of a delta; `below`: of the two points where the spheres meet the lower one of the robot's z.

    Raises
    ------
    PoseError
        For a robot that is no symmetric delta, or lengths that do not fit.
    """
    side = np.einsum("ni,ni->n", robot.foot - robot.joint, robot.radial)
    flat = robot.foot - robot.joint - side[:, None] * robot.radial
    if robot.legs != 3 or any(np.ptp(one) > 1e-9 for one in (side, robot.la, robot.lb, *flat.T)) \
            or np.abs(flat[:, :2]).max() > 1e-9:
        raise PoseError(f"{robot.id}: the core wants three cranks alike, their axes across the rays from the middle")
    base, la, lb = (float(one[0]) / mm_per_lsb for one in (side, robot.la, robot.lb))
    if abs(base) + la >= 1 << p["W"] - 1 or lb >= 1 << p["W"] - 1:
        raise PoseError(f"{robot.id}: base + crank and rod must be below 2^{p['W'] - 1} LSB; they are "
                        f"{abs(base) + la:.0f} and {lb:.0f}")
    words = {f"cfg_{name}": round(value * 2.0**MORE) for name, value in (("base", base), ("la", la), ("lb", lb))}
    for i, radial in enumerate(robot.radial, 1):
        words |= {f"cfg_{letter}{i}": round(float(one) * ONE) for letter, one in zip("cn", radial)}
    return words | {"cfg_above": int(below == (robot.up[2] < 0))}


def tip(robot: Robot, mm_per_lsb: float, answer: dict[str, Ints]) -> Floats:
    """(N, 3) millimetres in the robot's frame of the core's words."""
    place = np.stack([answer[f"out_{axis}"] for axis in "xyz"], axis=-1) * mm_per_lsb
    return place * (1, 1, robot.up[2]) + (0, 0, (robot.foot - robot.joint)[0, 2])


def exact(p: Params, columns: dict[str, Ints], cfg: dict[str, int]) -> dict[str, Floats]:
    """What the words of crank vectors say, in float64 LSB: `elbows` (N, 3, 3), shifted by the platform, `tip` (N, 3)
    and `gap` (N), 4 LB^2 N^2 - V^2 of `fk`, below 0 where the spheres do not meet (the tip is none there).
    """
    base, la, lb = (cfg[f"cfg_{name}"] * 2.0**-MORE for name in ("base", "la", "lb"))
    elbows = []
    for i in (1, 2, 3):
        c, n = (ints(columns[f"in_{letter}{i}"]) * 2.0 ** -p["U"] for letter in "cn")
        rx, ry = (cfg[f"cfg_{letter}{i}"] / ONE for letter in "cn")
        elbows.append(np.stack([rx * (base + la * c), ry * (base + la * c), la * n], axis=-1))
    a, b = elbows[1] - elbows[0], elbows[2] - elbows[0]
    normal = np.cross(a, b)
    v = np.sum(a * a, axis=-1, keepdims=True) * b - np.sum(b * b, axis=-1, keepdims=True) * a
    gap = 4 * lb**2 * np.sum(normal**2, axis=-1) - np.sum(v * v, axis=-1)
    root = np.sqrt(np.maximum(gap, 0)) * np.where((normal[..., 2] >= 0) ^ (cfg["cfg_above"] == 1), -1, 1)
    q = np.cross(v, normal) + normal * root[..., None]
    with np.errstate(all="ignore"):
        tip = elbows[0] + lb * q / np.linalg.norm(q, axis=-1, keepdims=True)
    return {"elbows": np.stack(elbows, axis=-2), "tip": tip, "gap": gap}
