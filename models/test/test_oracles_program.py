"""Status bits and configuration words of kinematics_engine, seven axes and three parallel axes, from their pages."""

from __future__ import annotations

import math
import random
from fractions import Fraction
from pathlib import Path

import numpy as np
from quadrance import srs, ur
from quadrance.program import assembler, image
from quadrance.truth_srs import Srs, swivel
from quadrance.truth_srs import fk as srs_fk
from quadrance.truth_ur import Ur
from quadrance.truth_ur import fk as ur_fk

from models.test.oracles import ask, flags, near, oracle, turned

# kinematics_engine

UNIT = 1 << 25  # a word of 1.0
TEXT = """# One statement for each flag
in  word a b c n
sign back
out word c1 n1 r
norm a b <= 0.9
norm c n <= 1.4
reach q = a*a - b*b
r = root q back
c1, n1 = unit (a, b) hold
check c*c + n*n - one
"""


@oracle("program.kinematics", status=("unreachable", "singular", "no_rotation"))
def test_a_run_tells_what_a_line_has_found(core, tmp_path):
    """A negative `reach`, no direction, a `check` of 16 units of 2^-U or more; commands beside RUN have no status."""
    file = Path(tmp_path / "flags.kin")
    file.write_text(TEXT)
    made = image.image(assembler.assembled(file, core.params["PIPE"]), start=20)
    unit = UNIT >> core.params["U"]
    commands, wanted = image.load(made), []
    for context in (0, 1):
        for a, b, c, n, status in ((0.4, 0.1, 1, 0, 0), (0.1, 0.4, 1, 0, 1), (0, 0, 0, 1, 2), (0.4, 0.1, 0, 0, 8),
                                   (0.1, 0.2, 0.5, 0.5, 9), (0, 0, 0.5, 0, 10), (0.4, 0.1, 0, -1, 0)):
            commands += image.inputs(made, context, {"in_a": round(a * UNIT), "in_b": round(b * UNIT),
                                                     "in_c": round(c * UNIT), "in_n": round(n * UNIT)})
            commands += [image.run(made, context), (3, context, made["start"], 0), *image.outputs(made, context)]
            wanted.append(status)
    for off in (-20, -17, -15, 0, 15, 17, 20):  # units of 2^-U of the square of the length
        commands += image.inputs(made, 0, {"in_c": UNIT + off * unit // 2, "in_n": 0}) + [image.run(made, 0)]
        wanted.append(8 if abs(off) > 16 else 0)
    found = ask(core, [dict(zip(("kind", "context", "at", "data"), command)) for command in commands])
    assert [row["status"] for row, (kind, *_) in zip(found, commands) if kind == 2] == wanted
    assert not any(row["status"] for row, (kind, *_) in zip(found, commands) if kind != 2)


# Seven axes

SRS_LENGTHS = ("d", "l1", "l2", "l4")
SRS_INVERSE = ("srs.srs_ik", "srs.srs_ik_to_angles")


@oracle(*SRS_INVERSE, cfg=(*SRS_LENGTHS, "margin", "slack", "r", "e"))
def test_words_of_seven_axes(core):
    """Lengths in 2^-4 LSB, margin and slack in LSB; r e = 1 / 2 l1 l2, never more."""
    p, rng = core.params, random.Random(4)
    reach = 2 ** (p["W"] - 1 - p["F"])
    for _ in range(100):
        lengths = {name: rng.uniform(-1, 1) * reach / 4 for name in SRS_LENGTHS}
        lengths |= {name: abs(lengths[name]) + reach / 50 for name in ("l1", "l2")}
        edges = {name: rng.uniform(0, 1) * reach / 4 for name in ("margin", "slack")}
        found = srs.config(p, **lengths, **edges)
        assert all(abs(found[f"cfg_{name}"] - value * 2 ** (p["F"] + 4)) <= 0.5 for name, value in lengths.items())
        assert all(abs(found[f"cfg_{name}"] - value * 2 ** p["F"]) <= 0.5 for name, value in edges.items())
        exact = Fraction(2 ** (2 * p["W"] + 8), 2 * found["cfg_l1"] * found["cfg_l2"])
        product = Fraction(found["cfg_r"] * found["cfg_e"], 2**25)
        assert 0 <= exact - product < Fraction(found["cfg_e"], 2**25)
        assert found["cfg_e"] & found["cfg_e"] - 1 == 0 and 2**24 <= found["cfg_r"] < 2**25


@oracle(*SRS_INVERSE, status=("unreachable", "singular", "no_rotation"), cfg=("margin", "slack"))
def test_where_seven_axes_have_no_answer(core):
    """Beyond l1 + l2 of the shoulder and the slack; the wrist's centre on axis 1, the wrist straight; within the margin
    of both and of the stretched arm; a matrix and a swivel that are off."""
    p = core.params
    lsb, size, one = 2 ** p["F"], 2 ** (p["W"] - 1 - p["F"]) / 8, 1 << p["U"]
    arm = Srs(d=0.4 * size, l1=2.4 * size, l2=1.4 * size, l4=0.5 * size)

    def words(**more: float) -> dict:
        return {name[4:]: word for name, word in srs.config(p, **arm._asdict(), **{
            name: value / lsb for name, value in more.items()}).items()}

    def pose(q: list[float], off: float = 0) -> dict:
        matrix, tip = srs_fk(np.array(q), arm)
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
    upright |= {"z": round((arm.d + arm.l4 + 3 * size) * lsb)}
    for beside, edge, close in ((0, 0, True), (0.3, 0, False), (0.3, 0.4, True), (0.5, 0.4, False)):
        at = {"x": round(0.6 * beside * size * lsb), "y": round(-0.8 * beside * size * lsb)}
        assert told(upright | at, 2, margin=edge * size * lsb) == close, (beside, edge)
    row = pose(plain)
    for name in ("r11", "r12", "r23", "r33"):
        assert flags(core, [row | {name: row[name] + 48}], words(), "no_rotation") == [True]
        assert flags(core, [row | {name: row[name] + 3}], words(), "no_rotation") == [False]
    assert flags(core, [row | {"cs": row["cs"] // 2, "ns": row["ns"] // 2}], words(), "no_rotation") == [True]


# Three parallel axes

UR_LENGTHS = ("d1", "d4", "d5", "d6", "l2", "l3")
UR_FORWARD = ("ur.ur_fk", "ur.ur_fk_of_angles")
UR_INVERSE = ("ur.ur_ik", "ur.ur_ik_all", "ur.ur_ik_to_angles")


@oracle(*UR_FORWARD, cfg=UR_LENGTHS)
def test_words_of_three_parallel_axes_forward(core):
    """Lengths in 2^-4 LSB."""
    lengths = dict(zip(UR_LENGTHS, (1.3, -0.77, 0.111, 2.5, 3.25, 2.9)))
    found = ur.forward_config(core.params, **lengths)
    assert found.keys() == {f"cfg_{name}" for name in lengths}
    assert all(abs(found[f"cfg_{name}"] - value * 2 ** (core.params["F"] + 4)) <= 0.5
               for name, value in lengths.items())


@oracle(*UR_INVERSE, "keep.ur_keep", cfg=(*UR_LENGTHS, "margin", "slack", "r", "e"))
def test_words_of_three_parallel_axes(core):
    """Lengths in 2^-4 LSB, margin and slack in LSB; r e = 1 / 2 l2 l3, never more."""
    p, rng = core.params, random.Random(4)
    reach = 2 ** (p["W"] - 1 - p["F"])
    for _ in range(100):
        lengths = {name: rng.uniform(-1, 1) * reach / 4 for name in UR_LENGTHS}
        lengths |= {name: abs(lengths[name]) + reach / 50 for name in ("l2", "l3")}
        edges = {name: rng.uniform(0, 1) * reach / 4 for name in ("margin", "slack")}
        found = ur.config(p, **lengths, **edges)
        assert all(abs(found[f"cfg_{name}"] - value * 2 ** (p["F"] + 4)) <= 0.5 for name, value in lengths.items())
        assert all(abs(found[f"cfg_{name}"] - value * 2 ** p["F"]) <= 0.5 for name, value in edges.items())
        exact = Fraction(2 ** (2 * p["W"] + 8), 2 * found["cfg_l2"] * found["cfg_l3"])
        product = Fraction(found["cfg_r"] * found["cfg_e"], 2**25)
        assert 0 <= exact - product < Fraction(found["cfg_e"], 2**25)
        assert found["cfg_e"] & found["cfg_e"] - 1 == 0 and 2**24 <= found["cfg_r"] < 2**25


@oracle(*UR_FORWARD, status=("overflow",))
def test_the_edge_of_a_tip_of_three_parallel_axes(core):
    """At joints of 0 the tip is (-l2 - l3, -d4 - d6, d1 - d5), ties upward, then saturated."""
    half = 1 << core.params["W"] - 1
    row = {port.name[3:]: (port.name[3] == "c") << core.params["U"] for port in core.inputs}
    zero = dict.fromkeys(UR_LENGTHS, 0)
    for sixteenths in (16 * half - 24, 16 * half - 9, 16 * half - 8, 16 * half + 40, -16 * half + 5, -16 * half - 8,
                       -16 * half - 9, -16 * half - 30):
        want, part = math.floor(Fraction(sixteenths, 16) + Fraction(1, 2)), sixteenths // 2
        for (one, two), axis in ((("l2", "l3"), "x"), (("d4", "d6"), "y"), (("d1", "d5"), "z")):
            words = {one: part, two: part - sixteenths} if axis == "z" else {one: -part, two: part - sixteenths}
            found = ask(core, [row], zero | words)[0]
            assert bool(found["status"]) == (not -half <= want < half), (sixteenths, words)
            assert found[axis] == min(max(want, -half), half - 1)


@oracle(*UR_INVERSE, status=("unreachable", "singular", "no_rotation"), cfg=("margin", "slack"))
def test_where_three_parallel_axes_have_no_answer(core):
    """Beyond l2 + l3 of axis 2 and the slack; nearer to axis 1 than d4; joint 6 without a direction; within the margin
    of x1, l3 sin q3 and l3 sin q5; a matrix 16 units off."""
    p, all_of_them = core.params, core.function == "ur_ik_all"
    end = "0" if all_of_them else ""
    lsb, size = 2 ** p["F"], 2 ** (p["W"] - 1 - p["F"]) / 8
    arm = Ur(d1=0.4 * size, d4=0.5 * size, d5=0.3 * size, d6=0.35 * size, l2=2.2 * size, l3=1.6 * size)

    def words(**more: float) -> dict:
        return {name[4:]: word for name, word in ur.config(p, **arm._asdict(), **{
            name: value / lsb for name, value in more.items()}).items()}

    def pose(q: list[float], more: tuple[float, ...] = (0, 0, 0)) -> dict:
        matrix, tip = ur_fk(np.array(q), arm)
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
    matrix, tip = ur_fk(np.array(forward), arm)
    centre = (tip - arm.d6 * matrix[:, 2]) * lsb
    lift = 1.5 * size * lsb  # axis 4 is farther from axis 2 than l2 - l3
    for rim, inside in ((-8, True), (8, False)):
        away = (arm.d4 * lsb + rim) / math.hypot(centre[0], centre[1]) - 1
        aside = centre[0] * away, centre[1] * away, lift
        assert told(forward, "unreachable", aside) == inside
        assert told(forward, "singular", aside, margin=arm.d4 * lsb / 2)
    # margins
    margin = 0.1 * arm.l3 * lsb
    for share, close in ((0.8, True), (1.2, False)):  # x1, the centre's distance ahead in the arm's plane
        away = math.hypot(arm.d4 * lsb, share * margin) / math.hypot(centre[0], centre[1]) - 1
        aside = centre[0] * away, centre[1] * away, lift
        assert told(forward, "singular", aside, margin=margin) == close and not told(forward, "singular", aside), share
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
