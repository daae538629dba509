"""Status bits and configuration words of the core with seven axes, from its page."""

from __future__ import annotations

import math
import random
from fractions import Fraction

import numpy as np
from quadrance import srs
from quadrance.truth_srs import Srs, fk, swivel

from models.test.oracles import ask, flags, near, oracle

LENGTHS = ("d", "l1", "l2", "l4")
INVERSE = ("srs.srs_ik", "srs.srs_ik_to_angles")


@oracle(*INVERSE, cfg=(*LENGTHS, "margin", "slack", "r", "e"))
def test_words_of_seven_axes(core):
    """Lengths in 2^-4 LSB, margin and slack in LSB; r e = 1 / 2 l1 l2, never more."""
    p, rng = core.params, random.Random(4)
    reach = 2 ** (p["W"] - 1 - p["F"])
    for _ in range(100):
        lengths = {name: rng.uniform(-1, 1) * reach / 4 for name in LENGTHS}
        lengths |= {name: abs(lengths[name]) + reach / 50 for name in ("l1", "l2")}
        edges = {name: rng.uniform(0, 1) * reach / 4 for name in ("margin", "slack")}
        found = srs.config(p, **lengths, **edges)
        assert all(abs(found[f"cfg_{name}"] - value * 2 ** (p["F"] + 4)) <= 0.5 for name, value in lengths.items())
        assert all(abs(found[f"cfg_{name}"] - value * 2 ** p["F"]) <= 0.5 for name, value in edges.items())
        exact = Fraction(2 ** (2 * p["W"] + 8), 2 * found["cfg_l1"] * found["cfg_l2"])
        product = Fraction(found["cfg_r"] * found["cfg_e"], 2**25)
        assert 0 <= exact - product < Fraction(found["cfg_e"], 2**25)
        assert found["cfg_e"] & found["cfg_e"] - 1 == 0 and 2**24 <= found["cfg_r"] < 2**25


@oracle(*INVERSE, status=("unreachable", "singular", "no_rotation"), cfg=("margin", "slack"))
def test_where_seven_axes_have_no_answer(core):
    """Beyond l1 + l2 of the shoulder and the slack; the wrist's centre on axis 1, the wrist straight; within the margin
    of both and of the stretched arm; a matrix and a swivel that are off."""
    p = core.params
    lsb, size, one = 2 ** p["F"], 2 ** (p["W"] - 1 - p["F"]) / 8, 1 << p["U"]
    arm = Srs(d=0.4 * size, l1=2 * size, l2=1.8 * size, l4=0.5 * size)

    def words(**more: float) -> dict:
        return {name[4:]: word for name, word in srs.config(p, **arm._asdict(), **{
            name: value / lsb for name, value in more.items()}).items()}

    def pose(q: list[float], off: float = 0) -> dict:
        matrix, tip = fk(np.array(q), arm)
        out = [math.cos(q[0]) * math.sin(q[1]), math.sin(q[0]) * math.sin(q[1]), math.cos(q[1])]  # the upper arm
        turn = float(swivel(np.array(q), arm)) if abs(math.sin(q[3])) > 1e-6 else 0.7
        row = {f"r{r + 1}{s + 1}": round(float(matrix[r][s]) * one) for r in range(3) for s in range(3)}
        row |= {axis: round(float(at) * lsb + off * way) for axis, at, way in zip("xyz", tip, out)}
        return row | {"cs": round(math.cos(turn) * one), "ns": round(math.sin(turn) * one), "branch": 0}

    def told(row: dict, bit: int, **edges: float) -> bool:
        return bool(ask(core, [row], words(**edges))[0]["status"] & bit)

    plain = [0.3, 0.5, -0.4, 1.0, 0.7, 0.9, 0.2]
    found = ask(core, [pose(plain)], words())[0]
    assert found["status"] == 0 and near(core, found, plain)
    stretched = [*plain[:3], 0.0, *plain[4:]]
    for off, slack, far in ((-40, 0, False), (-6, 0, False), (6, 0, True), (40, 0, True), (6, 12, False),
                            (20, 12, True), (-6, 12, False), (40, 60, False)):
        assert told(pose(stretched, off), 1, slack=slack) == far, (off, slack)
    margin = 0.1 * arm.l2 * lsb
    for joint in (3, 5):
        for share, close in ((0.8, True), (1.2, False)):
            q = list(plain)
            q[joint] = math.asin(share * 0.1)
            assert told(pose(q), 2, margin=margin) == close and not told(pose(q), 2), (joint, share)
    upright = pose(plain) | {f"r{r}{s}": one * (r == s) for r in "123" for s in "123"}
    upright |= {"y": 0, "z": round((arm.d + arm.l4 + 3 * size) * lsb)}
    for x, edge, close in ((0, 0, True), (0.3, 0, False), (0.3, 0.4, True), (0.5, 0.4, False)):
        assert told(upright | {"x": round(x * size * lsb)}, 2, margin=edge * size * lsb) == close, (x, edge)
    row = pose(plain)
    for name in ("r11", "r12", "r23", "r33"):
        assert flags(core, [row | {name: row[name] + 48}], words(), "no_rotation") == [True]
        assert flags(core, [row | {name: row[name] + 3}], words(), "no_rotation") == [False]
    assert flags(core, [row | {"cs": row["cs"] // 2, "ns": row["ns"] // 2}], words(), "no_rotation") == [True]
