"""Status bits and configuration words of the cores with three parallel axes, from their page."""

from __future__ import annotations

import math
import random
from fractions import Fraction

import numpy as np
from quadrance import ur
from quadrance.truth_ur import Ur, fk

from models.test.oracles import ask, flags, near, oracle, turned

LENGTHS = ("d1", "d4", "d5", "d6", "l2", "l3")
FORWARD = ("ur.ur_fk", "ur.ur_fk_of_angles")
INVERSE = ("ur.ur_ik", "ur.ur_ik_all", "ur.ur_ik_to_angles")


@oracle(*FORWARD, cfg=LENGTHS)
def test_words_of_three_parallel_axes_forward(core):
    """Lengths in 2^-4 LSB."""
    lengths = dict(zip(LENGTHS, (1.3, -0.77, 0.111, 2.5, 3.25, 2.9)))
    found = ur.forward_config(core.params, **lengths)
    assert found.keys() == {f"cfg_{name}" for name in lengths}
    assert all(abs(found[f"cfg_{name}"] - value * 2 ** (core.params["F"] + 4)) <= 0.5
               for name, value in lengths.items())


@oracle(*INVERSE, "program.ur_keep", cfg=(*LENGTHS, "margin", "slack", "r", "e"))
def test_words_of_three_parallel_axes(core):
    """Lengths in 2^-4 LSB, margin and slack in LSB; r e = 1 / 2 l2 l3, never more."""
    p, rng = core.params, random.Random(4)
    reach = 2 ** (p["W"] - 1 - p["F"])
    for _ in range(100):
        lengths = {name: rng.uniform(-1, 1) * reach / 4 for name in LENGTHS}
        lengths |= {name: abs(lengths[name]) + reach / 50 for name in ("l2", "l3")}
        edges = {name: rng.uniform(0, 1) * reach / 4 for name in ("margin", "slack")}
        found = ur.config(p, **lengths, **edges)
        assert all(abs(found[f"cfg_{name}"] - value * 2 ** (p["F"] + 4)) <= 0.5 for name, value in lengths.items())
        assert all(abs(found[f"cfg_{name}"] - value * 2 ** p["F"]) <= 0.5 for name, value in edges.items())
        exact = Fraction(2 ** (2 * p["W"] + 8), 2 * found["cfg_l2"] * found["cfg_l3"])
        product = Fraction(found["cfg_r"] * found["cfg_e"], 2**25)
        assert 0 <= exact - product < Fraction(found["cfg_e"], 2**25)
        assert found["cfg_e"] & found["cfg_e"] - 1 == 0 and 2**24 <= found["cfg_r"] < 2**25


@oracle(*FORWARD, status=("overflow",))
def test_the_edge_of_a_tip_of_three_parallel_axes(core):
    """At joints of 0 the tip is (-l2 - l3, -d4 - d6, d1 - d5), ties upward, then saturated."""
    half = 1 << core.params["W"] - 1
    row = {port.name[3:]: (port.name[3] == "c") << core.params["U"] for port in core.inputs}
    zero = dict.fromkeys(LENGTHS, 0)
    for sixteenths in (16 * half - 24, 16 * half - 9, 16 * half - 8, 16 * half + 40, -16 * half + 5, -16 * half - 8,
                       -16 * half - 9, -16 * half - 30):
        want, part = math.floor(Fraction(sixteenths, 16) + Fraction(1, 2)), sixteenths // 2
        for (one, two), axis in ((("l2", "l3"), "x"), (("d4", "d6"), "y"), (("d1", "d5"), "z")):
            words = {one: part, two: part - sixteenths} if axis == "z" else {one: -part, two: part - sixteenths}
            found = ask(core, [row], zero | words)[0]
            assert bool(found["status"]) == (not -half <= want < half), (sixteenths, words)
            assert found[axis] == min(max(want, -half), half - 1)


@oracle(*INVERSE, status=("unreachable", "singular", "no_rotation"), cfg=("margin", "slack"))
def test_where_three_parallel_axes_have_no_answer(core):
    """Beyond l2 + l3 of axis 2 and the slack; nearer to axis 1 than d4; joint 6 without a direction; within the margin
    of x1, l3 sin q3 and l3 sin q5; a matrix 16 units off."""
    p, all_of_them = core.params, core.function == "ur_ik_all"
    end = "0" if all_of_them else ""
    lsb, size = 2 ** p["F"], 2 ** (p["W"] - 1 - p["F"]) / 8
    arm = Ur(d1=0.4 * size, d4=0.5 * size, d5=0.3 * size, d6=0.35 * size, l2=2 * size, l3=1.8 * size)

    def words(**more: float) -> dict:
        return {name[4:]: word for name, word in ur.config(p, **arm._asdict(), **{
            name: value / lsb for name, value in more.items()}).items()}

    def pose(q: list[float], more: tuple[float, ...] = (0, 0, 0)) -> dict:
        matrix, tip = fk(np.array(q), arm)
        row = {f"r{r + 1}{s + 1}": round(float(matrix[r][s]) * 2 ** p["U"]) for r in range(3) for s in range(3)}
        row |= {axis: round(float(one) * lsb + off) for axis, one, off in zip("xyz", tip, more)}
        # forward at these joints, sin q3 and sin q5 above 0
        return row | ({} if all_of_them else {"branch": 0})

    def told(q: list[float], bit: str, more: tuple[float, ...] = (0, 0, 0), **edges: float) -> bool:
        answer = ask(core, [pose(q, more)], words(**edges))[0]
        if all_of_them:
            return bool((answer["far"] if bit == "unreachable" else answer["held"]) & 1)
        return bool(answer["status"] & {"unreachable": 1, "singular": 2}[bit])

    forward = next(q for q in ([0.3, -0.5, 1.0, 0.4, 0.9, 0.2], [0.3, 2.6, 1.0, 0.4, 0.9, 0.2])
                   if near(core, ask(core, [pose(q)], words())[0], q, end))  # one of them looks forward
    assert not told(forward, "unreachable") and not told(forward, "singular")
    # stretched, and so many LSB along the arm
    stretched = [*forward[:2], 0.0, *forward[3:]]
    along = [-math.cos(stretched[1]) * math.cos(stretched[0]), -math.cos(stretched[1]) * math.sin(stretched[0]),
             -math.sin(stretched[1])]
    for off, slack, far in ((-40, 0, False), (-6, 0, False), (6, 0, True), (40, 0, True), (6, 12, False),
                            (20, 12, True), (-6, 12, False), (40, 60, False)):
        assert told(stretched, "unreachable", tuple(off * one for one in along), slack=slack) == far, (off, slack)
    # above axis 1, nearer to it than d4
    matrix, tip = fk(np.array(forward), arm)
    centre = (tip - arm.d6 * matrix[:, 2]) * lsb
    for rim, inside in ((-8, True), (8, False)):
        away = (arm.d4 * lsb + rim) / math.hypot(centre[0], centre[1]) - 1
        assert told(forward, "unreachable", (centre[0] * away, centre[1] * away, 0)) == inside
        assert told(forward, "singular", (centre[0] * away, centre[1] * away, 0), margin=arm.d4 * lsb / 2)
    # margins
    margin = 0.1 * arm.l3 * lsb
    for joint in (2, 4):
        for share, close in ((0.8, True), (1.2, False)):
            q = list(forward)
            q[joint] = math.asin(share * 0.1)
            assert told(q, "singular", margin=margin) == close and not told(q, "singular"), (joint, share)
    row = pose(forward) | {f"r{r}{s}": 0 for r in "123" for s in "123"}
    straight = row | {"r11": 1 << p["U"], "r23": 1 << p["U"], "r32": -(1 << p["U"]), "x": 0, "y": 0}
    # columns 1 and 2 at right angles to axis 2: the flange along it, the arm's plane along x
    plane = words() | {"d4": 0}
    straight |= {"x": round(2 * size * lsb), "y": round(arm.d6 * lsb)}
    held = ask(core, [straight], plane)[0]
    assert held["status"] & 2 and (all_of_them or abs(turned(core, held, 6)) < 1e-3)  # (1, 0) after a reset
    row = pose(forward)
    for name in ("r11", "r12", "r23", "r33"):
        assert flags(core, [row | {name: row[name] + 48}], words(), "no_rotation") == [True]
        assert flags(core, [row | {name: row[name] + 3}], words(), "no_rotation") == [False]
