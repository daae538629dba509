"""Bit-true models of rtl/classic: kinematics by CORDIC, binary joint angles, 2^A to the turn."""

from __future__ import annotations

import math

import numpy as np

from quadrance.cordic import OVERFLOW, SINGULAR, aim, angle, turn
from quadrance.fixed import Ints, hold_last, ints, isqrt, saturate, wrap

GUARD = 4  # fraction bits below a coordinate LSB
UNREACHABLE = 1
AIM_GUARD = 3
SOLVE_GUARD = 4  # of two and three joints back
SOLVE_ANGLE_GUARD = 6
CHAIN_GUARD = 5  # of two and three rotations
GROWTH = 0x69648523  # 1.646760 * 2^30: what the vectoring lengthens rho by, and so z before they meet
YAW_FACTORS = ((2, 0), (5, 1), (9, 0), (10, 0), (16, 0), (23, 1))  # 1 +- 2^-n, together 1.21450587 = 2 * 0.60725293
SHRINK = math.prod((1 + 4.0**-i) ** -0.5 for i in range(40))  # 0.607252935: what all micro-rotations lengthen, undone


def config(p: dict[str, int], *, cfg_l1: int, cfg_l2: int = 0) -> dict[str, int]:
    """Words that the cores derive from the link lengths u(W-F).F.

    cfg_c1 : start vector of classic_fk1
    cfg_s1, cfg_s2 : start vectors of the links in a chain, one rotation before the tip and two
    cfg_far, cfg_near : (L1 + L2)^2 and (L1 - L2)^2, the squared radii of the reachable annulus
    cfg_f : (L2 - L1) / (L1 + L2), of the law of tangents, W + 2 fraction bits

    The start vectors stop 3 LSB below the longest word, where rounding could no longer tell plus from minus.
    """
    longest = (1 << p["W"]) - 3
    l1, l2 = min(cfg_l1, longest), min(cfg_l2, longest)
    return {"cfg_c1": math.floor(l1 * SHRINK * 2**GUARD),
            "cfg_s1": math.floor(l1 * SHRINK * 2**CHAIN_GUARD),
            "cfg_s2": math.floor(l2 * SHRINK * SHRINK * math.sqrt(2) * 2**CHAIN_GUARD),
            "cfg_far": (cfg_l1 + cfg_l2) ** 2,
            "cfg_near": (cfg_l1 - cfg_l2) ** 2,
            "cfg_f": ((cfg_l2 - cfg_l1) << p["W"] + 2) // max(cfg_l1 + cfg_l2, 1)}


def rounding(width: int) -> int:
    """Of classic_fk1: half an LSB, and the units that a rotation rounds down on the average; more of them above 16."""
    return 14 + 3 * max(width - 16, 0) // 8


def chain_rounding(width: int) -> tuple[int, int]:
    """Units that two rotations in the plane round down on the average, and those of the third."""
    return 13 + 3 * max(width - 16, 0) // 4, 6 + max(width - 15, 0) // 3


def yaw_factors(width: int) -> tuple[tuple[int, int], ...]:
    """(shift, minus) of the factors 1 +- 2^-shift that remove the gain of the third rotation."""
    return YAW_FACTORS if width > 16 else YAW_FACTORS[:5]


def fk1(p: dict[str, int], *, in_j1, cfg_c1) -> dict[str, Ints]:
    """``x = L1 cos j1, y = L1 sin j1``: from the middle of the quadrant; error: `bounds.classic_fk1`."""
    width, turn_bits = p["W"], p["A"]
    in_j1, cfg_c1 = np.broadcast_arrays(ints(in_j1), ints(cfg_c1))
    top, next_bit = in_j1 >> turn_bits - 1 & 1, in_j1 >> turn_bits - 2 & 1
    x, y = cfg_c1 ^ -(top ^ next_bit), cfg_c1 ^ -top
    z = wrap(in_j1 + (1 << turn_bits - 3), turn_bits - 2) << width + 5 - turn_bits
    x, y = turn(width, x, y, z + 2, rounding(width))
    (out_x, over_x), (out_y, over_y) = (saturate(v >> GUARD, width) for v in (x, y))
    return {"out_x": out_x, "out_y": out_y, "out_status": OVERFLOW * (over_x | over_y)}


def _signs(quarter: Ints) -> tuple[Ints, Ints]:
    """Masks (-1: minus) of x and y in the middle of a quadrant, counted from 0."""
    top, next_bit = quarter >> 1 & 1, quarter & 1
    return -(top ^ next_bit), -top


def _chain(p: dict[str, int], joints: tuple[Ints, ...], s1: Ints, s2: Ints) -> tuple[tuple[Ints, Ints], ...]:
    """((x, overflow), (y, overflow) ...) of two links: the one engine of classic_fk2 and classic_fk3.

    ``L2 exp(j j2)``, plus L1, times ``exp(j j1)``. The quarter turns of both rotations are signs of the two start
    vectors, so that nothing is exchanged on the way; the third rotation starts from (+-rho, +-rho) / 2.
    """
    width, turn_bits = p["W"], p["A"]
    eighth, up = 1 << turn_bits - 3, width + 5 - turn_bits
    j1, j2 = joints[:2]
    quarter1 = j1 >> turn_bits - 2
    sx, sy = _signs(quarter1 + (j2 + eighth >> turn_bits - 2))
    x, y = turn(width, s2 ^ sx, s2 ^ sy, (wrap(j2, turn_bits - 2) << up) + 2, 0)
    sx, sy = _signs(quarter1)
    z = (wrap(j1 + eighth, turn_bits - 2) << up) + 2
    x, y = turn(width, x + (s1 ^ sx), y + (s1 ^ sy), z, 0)
    half, (plane, yaw) = 1 << CHAIN_GUARD - 1, chain_rounding(width)
    height = saturate(y + plane + half >> CHAIN_GUARD, width)
    if len(joints) == 2:
        return saturate(x + plane + half >> CHAIN_GUARD, width), height
    rho = x + plane >> 1
    for shift, minus in yaw_factors(width):
        rho = rho + (rho >> shift ^ -minus)
    sx, sy = _signs(joints[2] >> turn_bits - 2)
    x, y = turn(width, rho ^ sx, rho ^ sy, (wrap(joints[2] + eighth, turn_bits - 2) << up) + 2, yaw + half)
    return saturate(x >> CHAIN_GUARD, width), saturate(y >> CHAIN_GUARD, width), height


def _coordinates(axes: tuple[tuple[Ints, Ints], ...]) -> dict[str, Ints]:
    """Ports of saturated coordinates."""
    over = sum(np.asarray(over, dtype=np.int64) for _, over in axes) > 0
    return {**{f"out_{name}": word for name, (word, _) in zip("xyz", axes)}, "out_status": OVERFLOW * over}


def fk2(p: dict[str, int], *, in_j1, in_j2, cfg_s1, cfg_s2) -> dict[str, Ints]:
    """``x = L1 cos j1 + L2 cos(j1 + j2)``, y with sines: two rotations."""
    in_j1, in_j2, s1, s2 = np.broadcast_arrays(*map(ints, (in_j1, in_j2, cfg_s1, cfg_s2)))
    return _coordinates(_chain(p, (in_j1, in_j2), s1, s2))


def fk3(p: dict[str, int], *, in_j1, in_j2, in_j3, cfg_s1, cfg_s2) -> dict[str, Ints]:
    """`fk2` in the plane of the arm, (rho, z); ``x = rho cos j3, y = rho sin j3``: three rotations."""
    in_j1, in_j2, in_j3, s1, s2 = np.broadcast_arrays(*map(ints, (in_j1, in_j2, in_j3, cfg_s1, cfg_s2)))
    return _coordinates(_chain(p, (in_j1, in_j2, in_j3), s1, s2))


def ik1(p: dict[str, int], *, in_x, in_y) -> dict[str, Ints]:
    """``j1 = atan2(y, x)``; at the origin the last angle stays (0 before there was one)."""
    in_x, in_y = np.broadcast_arrays(ints(in_x), ints(in_y))
    origin = (in_x == 0) & (in_y == 0)
    _, angle = aim(p["W"], p["A"], AIM_GUARD, in_x, in_y, False)
    return {"out_j1": hold_last(angle, ~origin), "out_status": SINGULAR * origin.astype(np.int64)}


def _aim(p: dict[str, int], grows: int, x: Ints, y: Ints, z: Ints, minus: Ints | int = 0) -> tuple[Ints, Ints]:
    """(x, y), SOLVE_GUARD bits below an LSB, turned onto the x axis in W + 2 micro-rotations: its x, and its angle
    added to `z` or, where `minus` is -1, subtracted."""
    half = (p["W"] + 1) // 2
    mirror = -(x < 0).astype(np.int64)
    bits = p["A"] + SOLVE_ANGLE_GUARD
    x, z = x ^ mirror, z + (mirror & 1 << bits - 1)
    for i in range(p["W"] + 2):
        sign = -(y < 0).astype(np.int64)
        low = 0 if i <= half else SOLVE_GUARD + half // 2
        grown = x + (y >> 2 * i ^ sign) if i <= grows else x
        y = y + ((x >> low ^ ~sign) << low) << 1
        x = grown
        z = z + (angle(i, bits) >> i ^ sign ^ mirror ^ minus)
    return x, z


def _solve(p: dict[str, int], x: Ints, y: Ints, z: Ints | None, elbow: Ints, far: Ints, near: Ints,
           f: Ints) -> dict[str, Ints]:
    """The engine of classic_ik2 and (with z) classic_ik3; see rtl/classic/README.md."""
    width, turn_bits, guard = p["W"], p["A"], SOLVE_GUARD
    half = (width + 1) // 2
    grows = (width + 1) // 3 + 1 if z is None else half
    mean = (width + 2) // 2
    word = lambda sum_z, low: wrap(sum_z >> low, turn_bits, signed=False)  # noqa: E731
    axis = (x == 0) & (y == 0)
    square = x * x + y * y + (0 if z is None else z * z)
    singular, out = SINGULAR * axis, {}
    x, y = x << guard, (y << guard) + 1
    if z is not None:
        x, yaw = _aim(p, grows, x, y, ints(32 + mean))
        out["out_j3"] = hold_last(word(yaw, 6), ~axis)
        y = (z << guard) * (GROWTH >> 28 - width) >> width + 2
        axis = axis & (z == 0)
    _, phi = _aim(p, grows, x, y, ints(48 + 2 * mean))
    a, b = (isqrt(np.maximum(value, 0) << 2 * guard) for value in (far - square, square - near))
    minus = (elbow != 0).astype(np.int64) - 1
    _, bend = _aim(p, grows, b, a, ints(mean - 16), minus)
    _, rest = _aim(p, grows, b, a * f >> width + 2, bend, minus)
    out["out_j1"] = hold_last(word(phi + rest, 6), ~axis)
    out["out_j2"] = word(~bend, 5)
    out["out_status"] = singular | UNREACHABLE * ((square > far) | (square < near))
    return out


def ik2(p: dict[str, int], *, in_x, in_y, in_elbow, cfg_far, cfg_near, cfg_f) -> dict[str, Ints]:
    """Joints of two links whose tip is (x, y), or the nearest point in reach; at the origin the last j1 stays."""
    x, y, elbow, far, near, f = np.broadcast_arrays(*map(ints, (in_x, in_y, in_elbow, cfg_far, cfg_near, cfg_f)))
    return _solve(p, x, y, None, elbow, far, near, f)


def ik3(p: dict[str, int], *, in_x, in_y, in_z, in_elbow, cfg_far, cfg_near, cfg_f) -> dict[str, Ints]:
    """`ik2` in the plane of the arm, (rho, z), rho >= 0, turned by j3; on the axis x = y = 0 the last j3 stays."""
    x, y, z, elbow, far, near, f = np.broadcast_arrays(
        *map(ints, (in_x, in_y, in_z, in_elbow, cfg_far, cfg_near, cfg_f)))
    return _solve(p, x, y, z, elbow, far, near, f)
