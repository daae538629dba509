"""These are the bit-true models of rtl/arm: two links and a yaw with the offsets of a real arm. Joints are unit
vectors.

The five constants, all of them words of a coordinate: base height, shoulder offset a (radial), lateral offset b, elbow
offset e (across the forearm), absolute elbow (joint 2 is measured from the base). A switch that is 0 (`BASE`,
`SHOULDER`, `LATERAL`, `ELBOW`, `ABSOLUTE`) makes the core ignore its words.

    rho = L1 c1 + forearm along link 2 + a, z likewise + base;  x + i y = (rho + i b) (c3 + i n3)
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from quadrance import arm_solve_wide, kernel_vector_solve, kernel_vector_wide
from quadrance.arms.error import ArmError
from quadrance.fixed import Ints, hold_last, ints, saturate, to_fixed, wrap
from quadrance.kernel_vector_solve import SUM
from quadrance.vector import GUARD

if TYPE_CHECKING:
    from quadrance.arms import Arm

Params = dict[str, int]
SWITCHES = ("BASE", "SHOULDER", "LATERAL", "ELBOW", "ABSOLUTE")


# Configuration


def config(p: Params, *, cfg_l1: int, cfg_l2: int, cfg_lateral: int = 0, margin: float = 0.0, slack: float = 0.0,
           **rest: int) -> dict[str, int]:
    """Derived words of arm_ik3: those of two links, and minus the squared lateral offset, of aligned words.

    `margin` and `slack` in coordinate units.
    """
    more = {"cfg_base": 0, "cfg_shoulder": 0, "cfg_lateral": cfg_lateral, "cfg_ce": 1 << p["U"], "cfg_ne": 0} | rest
    bits = kernel_vector_wide.form(p).bits
    lateral = int(cfg_lateral) << bits - p["W"]
    found = kernel_vector_wide.config(p, cfg_l1=cfg_l1, cfg_l2=cfg_l2)
    edges = kernel_vector_solve.edge_words(p, found, cfg_l1=cfg_l1, cfg_l2=cfg_l2, margin=margin, slack=slack,
                                           bits=bits)
    return found | edges | {"cfg_bb": -lateral * lateral} | more


def switches(arm: Arm) -> dict[str, int]:
    """The parameters of arm_fk3 and arm_ik3 that leave of them what this arm needs."""
    return {"BASE": int(arm.base != 0), "SHOULDER": int(arm.shoulder != 0), "LATERAL": int(arm.lateral != 0),
            "ELBOW": int(arm.elbow != 0), "ABSOLUTE": int(arm.absolute_elbow)}


def words(p: Params, arm: Arm, inverse: bool) -> dict[str, int]:
    """Configuration words of arm_fk3, or of arm_ik3 if `inverse`, for an arm.

    Raises
    ------
    ArmError
        Naming the key whose word does not fit.
    """
    w, f = p["W"], p["F"]

    def word(key: str, millimetres: float, low: int, high: int) -> int:
        found = int(to_fixed(millimetres / arm.mm_per_unit, f))
        if not low <= found <= high:
            raise ArmError(f"{arm.id}: {key}: {millimetres:g} mm is {found} LSB and the word ends at "
                           f"{high if found > high else low}; raise mm_per_unit")
        return found

    unsigned, half = (0, (1 << w) - 1), 1 << w - 1
    radial = half // 4 if inverse else half
    found = {"cfg_l1": word("links.l1", arm.l1, *unsigned),
             "cfg_l2": word("links.l2", arm.l2 if inverse else arm.forearm, *unsigned),
             "cfg_base": word("constants.base", arm.base, -half, half - 1),
             "cfg_shoulder": word("constants.shoulder", arm.shoulder, -radial, radial - 1),
             "cfg_lateral": word("constants.lateral", arm.lateral, 1 - half, half - 1)}
    if not inverse:
        return found | {"cfg_elbow": word("constants.elbow", arm.elbow, -half, half - 1)}
    turn = math.radians(arm.elbow_angle)
    return found | config(p, **found, cfg_ce=int(to_fixed(math.cos(turn), p["U"])),
                          cfg_ne=int(to_fixed(-math.sin(turn), p["U"])))


# Forward


def fk3(p: Params, *, in_c1: Ints, in_n1: Ints, in_c2: Ints, in_n2: Ints, in_c3: Ints, in_n3: Ints, cfg_l1: Ints,
        cfg_l2: Ints, cfg_base: Ints, cfg_shoulder: Ints, cfg_lateral: Ints, cfg_elbow: Ints) -> dict[str, Ints]:
    """Tip of the arm; products truncated to GUARD bits, a product of -e, -B or -b is that of the one's complement."""
    bits = p["W"] + 3 + GUARD
    l1, l2, base, shoulder, lateral, elbow = (
        ints(word) * on << GUARD for word, on in
        ((cfg_l1, 1), (cfg_l2, 1), (cfg_base, p["BASE"]), (cfg_shoulder, p["SHOULDER"]), (cfg_lateral, p["LATERAL"]),
         (cfg_elbow, p["ELBOW"])))

    def turned(a: Ints, b: Ints, c: Ints, n: Ints, a0: Ints, b0: Ints) -> tuple[Ints, Ints]:
        """(a0, b0) and (a, b) turned by (c, n)."""
        c, n = ints(c), ints(n)

        def cut(word: Ints, factor: Ints) -> Ints:
            return wrap(word * factor >> p["U"], bits)

        return wrap(cut(a, c) + cut(~b, n) + a0, bits), wrap(cut(a, n) + cut(b, c) + b0, bits)

    if p["ABSOLUTE"]:
        a, b = turned(l2, elbow, in_c2, in_n2, shoulder, base)
        rho, z = wrap((l1 * ints(in_c1) >> p["U"]) + a, bits), wrap((l1 * ints(in_n1) >> p["U"]) + b, bits)
    else:
        a, b = turned(l2, elbow, in_c2, in_n2, l1, ints(0))
        rho, z = turned(a, b, in_c1, in_n1, shoulder, base)
    x, y = turned(rho, lateral, in_c3, in_n3, ints(0), ints(0))
    answer, overflow = {}, ints(0)
    for axis, word in zip("xyz", (x, y, z)):  # the half can make it wrap
        answer[f"out_{axis}"], over = saturate(wrap(word + (1 << GUARD - 1), bits) >> GUARD, p["W"])
        overflow = overflow | over
    return answer | {"out_status": 4 * overflow}


# Inverse


def _radius(q: Ints, back: Ints) -> Ints:
    """The root of q with the sign of the shoulder's side, 4 fraction bits; 0 where q is negative."""
    q = np.maximum(q, 0)
    s = kernel_vector_solve.spare_pairs(q)
    root = kernel_vector_solve.reciprocal(kernel_vector_solve.inverse_product(q << 2 * s >> 7, np.True_))
    product = kernel_vector_solve.shifted(q << SUM, s >> 1) * root
    return wrap(product >> np.where(s & 1, 29, 30), 22) ^ -ints(back != 0)


def _yaw(x: Ints, y: Ints, lateral: Ints, square: Ints, back: Ints) -> tuple[Ints, ...]:
    """Joint 3 as products with 49 fraction bits, rho with 4, and whether the point is nearer than b.

    Joint 3 is the point seen from (rho, b), whose length is the point's own. Nearer than b rho is 0, and a direction is
    all that matters: a power of two replaces b, and the products are with 2 / sqrt(q') instead of 1/q'.
    """
    q = x * x + y * y
    near, s = q < square, kernel_vector_solve.spare_pairs(q)
    power = kernel_vector_solve.direction_power(s) * np.where(lateral < 0, -1, 1)
    k1 = np.where(near, 0, _radius(q - square, back))
    k2 = np.where(near, power, lateral << kernel_vector_solve.GUARD)
    r = kernel_vector_solve.reciprocal(kernel_vector_solve.inverse_product(q << 2 * s >> 7, near))
    b, a = kernel_vector_solve.seen(2 * k1 + 1, 2 * k2 + 1, x, y, 0, np.where(near, s >> 1, s))
    return b * r, a * r, k1, near


def _plain_yaw(x: Ints, y: Ints, shoulder: Ints, switch: int, back: Ints) -> tuple[Ints, ...]:
    """`kernel_vector_solve.yaw` without lateral offset; the shoulder offset takes the place of rho's rounding."""
    q = x * x + y * y
    s = kernel_vector_solve.spare_pairs(q)
    power = kernel_vector_solve.direction_power(s) * np.where(back != 0, -1, 1)
    b, a = kernel_vector_solve.seen(2 * power + 1, ints(1), x, y, 0, s >> 1)
    r = kernel_vector_solve.reciprocal(kernel_vector_solve.inverse_product(q << 2 * s >> 7, np.True_))
    total = kernel_vector_solve.turned(2 * (b * r >> 31) + 1, 2 * (a * r >> 31) + 1, x, y)
    place = 17
    addend = (~shoulder << place) + (1 << place) - 8 if switch else 1 << place - 5
    return b * r, a * r, wrap(total + addend >> place - 4, 21), np.zeros(np.shape(x), dtype=bool)


def turn(p: Params, c: Ints, n: Ints, by_c: Ints, by_n: Ints) -> tuple[Ints, Ints]:
    """(c, n) turned by (by_c, by_n), U fraction bits; the one's complement replaces -by_n."""
    u = p["U"]

    def rounded(first: Ints, second: Ints) -> Ints:
        return wrap((first >> u - 1) + (second >> u - 1) + 1 >> 1, u + 2)

    return rounded(c * by_c, n * ~by_n), rounded(c * by_n, n * by_c)


def branch(p: Params, x: Ints, y: Ints, z: Ints, elbow: Ints, back: Ints, cfg: dict[str, Ints]) -> dict[str, Ints]:
    """Words of one branch, joint 2 without joint 1; `none1`, `none3`: joint 1, joint 3 has no direction."""
    f = kernel_vector_wide.form(p)
    up, narrow = f.bits - p["W"], f.bits == 16
    x, y, z, l1, l2, base, shoulder, lateral = (
        ints(word) << up for word in (x, y, z, *(cfg[f"cfg_{name}"] for name in
                                                 ("l1", "l2", "base", "shoulder", "lateral"))))
    z, over = saturate(z - base * p["BASE"], f.bits)
    if p["LATERAL"]:
        place = (x, y, lateral, -ints(cfg["cfg_bb"]), back)
        c3, n3, rho, inside = _yaw(*place) if narrow else arm_solve_wide.beside(f, *place)
        rho = wrap(rho - (shoulder * p["SHOULDER"] << 4), f.bits + 5)
    elif narrow:
        c3, n3, rho, inside = _plain_yaw(x, y, shoulder, p["SHOULDER"], back)
    else:
        c3, n3, rho = arm_solve_wide.yaw(f, x, y, shoulder if p["SHOULDER"] else None, back)
        inside = np.False_
    limits = (ints(cfg["cfg_margin"]) << up, ints(cfg["cfg_slack"])) if p.get("MARGINS") else None
    words = (rho, z, kernel_vector_solve.GUARD, elbow, l1, l2, *(ints(cfg[f"cfg_{name}"]) for name in "qre"))
    c1, n1, c2, n2, clamped, zero, near = (kernel_vector_solve.elbow_plane(*words, limits=limits) if narrow else
                                           kernel_vector_wide._elbow(f, *words, limits))
    if limits:  # of the yaw axis, too
        distance = wrap((rho >> kernel_vector_solve.GUARD) + shoulder * p["SHOULDER"], f.bits + 1) ^ -ints(back != 0)
        near = near | (distance & (1 << f.bits + 1) - 1 < limits[0])
    c1, n1, c2, n2, c3, n3 = (kernel_vector_wide.unit_word(p, product) for product in (c1, n1, c2, n2, c3, n3))
    if p["ELBOW"]:
        c2, n2 = turn(p, c2, n2, ints(cfg["cfg_ce"]), ints(cfg["cfg_ne"]))
    on_axis = (x == 0) & (y == 0)
    return {"c1": c1, "n1": n1, "c2": c2, "n2": n2, "c3": c3, "n3": n3, "none1": zero, "none3": on_axis,
            "status": ints(clamped | inside) + 2 * ints(on_axis | zero | near) + 4 * ints(over)}


def ik3(p: Params, *, in_x: Ints, in_y: Ints, in_z: Ints, in_elbow: Ints, in_back: Ints,
        **cfg: Ints) -> dict[str, Ints]:
    """Joints of the tip (x, y, z) for the elbow and the shoulder asked for."""
    found = branch(p, *(ints(word) for word in np.broadcast_arrays(in_x, in_y, in_z, in_elbow, in_back)), cfg)
    one = 1 << p["U"]
    answer = {f"out_{letter}{i}": hold_last(found[f"{letter}{i}"], ~found[f"none{i}"], one * (letter == "c"))
              for i in (1, 3) for letter in "cn"}
    c2, n2 = found["c2"], found["n2"]
    if p["ABSOLUTE"]:
        c2, n2 = turn(p, c2, n2, answer["out_c1"], answer["out_n1"])
    return {**answer, "out_c2": c2, "out_n2": n2, "out_status": found["status"]}
