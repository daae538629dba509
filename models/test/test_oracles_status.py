"""Status bits, ties and held words of the closed-form cores, from the pages."""

from __future__ import annotations

import math
import random
from collections import Counter
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from quadrance import arm, arm_keep, classic, cores, rational, table, vector

from models.test.oracles import ask, flags, oracle
from tb.lib import stimulus

FAMILIES = ("vector", "table", "rational", "classic", "paper")
DERIVE = {"arm": arm.config, "vector": vector.config, "table": table.config, "rational": rational.config,
          "classic": classic.config}


def words_of(core, l1: int, l2: int = 0) -> dict[str, int]:
    """Configuration of a core of two links, lengths in LSB; without cfg_."""
    words = {"l1": l1, "l2": l2, "l3": 0, "margin": 0, "slack": 0}
    if {"cfg_q", "cfg_far", "cfg_s1", "cfg_c1"} & {port.name for port in core.cfg}:
        words |= {name[4:]: word for name, word in DERIVE[core.family](core.params, cfg_l1=l1, cfg_l2=l2).items()}
    return {port.name[4:]: words[port.name[4:]] for port in core.cfg}


def joint_words(core, quarters: tuple[int, ...]) -> dict[str, int]:
    """Joints at multiples of a quarter turn."""
    row = {}
    for i, quarter in enumerate(quarters, 1):
        quarter %= 4
        port = next(port for port in core.inputs if port.name[3:] in (f"j{i}", f"c{i}"))
        if port.type == "vector":
            one = 1 << port.width - 2
            row |= {f"c{i}": (one, 0, -one, 0)[quarter], f"n{i}": (0, one, 0, -one)[quarter]}
        else:
            row[f"j{i}"] = quarter << port.width - 2
    return row


def target(core, x: int, y: int, z: int, elbow: int = 0) -> dict[str, int]:
    """A target of an inverse core, in the ports that it has."""
    row = {"x": x, "y": y, "z": z, "elbow": elbow, "back": 0, "phi": 0}
    return {port.name[3:]: row[port.name[3:]] for port in core.inputs}


# Overflow: a tip along an axis is a sum of whole words


@oracle(*(f"{family}.{function}" for family in FAMILIES for function in ("fk1", "fk2", "fk3")), status=("overflow",))
def test_overflow_of_a_stretched_arm(core):
    """2^(W-1) - 1 fits, 2^(W-1) does not; -2^(W-1) fits but in rtl/paper, whose words end at +-(2^(W-1) - 1).

    Along an axis vectors and tables are exact, so is one root; CORDIC and products of roots are within 2 LSB.
    """
    half, number = 1 << core.params["W"] - 1, int(core.function[-1])
    near = 4 if core.family == "classic" or core.family == "rational" and number > 1 else 0
    for more in (-1 - near, near, 1 + near):
        l1 = half + more if number == 1 else (half + more) * 5 // 8
        cfg = words_of(core, l1, half + more - l1)
        for quarter in range(4):
            for yaw in range(4) if number == 3 else (0,):
                row = joint_words(core, (quarter, 0, yaw)[:number])
                direction = [(1, 0), (0, 1), (-1, 0), (0, -1)][quarter]
                along = (half + more) * direction[0] * (-1 if yaw in (2, 3) else 1)
                plane = (half + more) * direction[1]
                low = -half + 1 if core.family == "paper" and core.function != "mff" else -half
                found = ask(core, [row], cfg)[0]
                beyond = not (low <= along < half and low <= plane < half)
                assert bool(found["status"] & 4) == beyond, (cfg, row, found)
                if beyond and core.family != "paper":
                    x, y = (along, plane) if number < 3 else (along if yaw % 2 == 0 else 0, along if yaw % 2 else 0)
                    place = [x, y] + [plane] * (number == 3)
                    for name, value in zip("xyz", place):
                        assert abs(found[name] - min(max(value, -half), half - 1)) <= near // 2


@oracle("vector.chain", "table.chain", "paper.mff", status=("overflow",))
def test_overflow_of_a_chain(core):
    """Only the coordinate is saturated: a chain that comes back is right again. A link behind the N-th is flagged."""
    half = 1 << core.params["W"] - 1
    frame = core.function == "mff"  # a direction of its own for each link, from roots that are 2 LSB short at most
    near = 3 if frame else 0
    zero, back = joint_words(core, (0, 0)[:1 + frame]), joint_words(core, (0, 2) if frame else (2,))
    yaw = [zero | {"l": 7, "last": 0}] * core.params.get("SPACE", 0)

    def links(*some: tuple[dict, int]) -> list[bool]:
        chain = [*yaw, *(joint | {"l": length, "last": 0} for joint, length in some)]
        chain[-1]["last"] = 1
        return flags(core, chain)[len(yaw):]

    assert links((zero, half - 3), (zero, 1), (zero, 1), (zero, 1 + near), (back, 5 + 2 * near)) == [
        False, False, False, True, False]
    assert links((back, half - near), (back if frame else zero, 1 + 2 * near)) == [False, True]
    most = core.params["N"] + core.params.get("SPACE", 0)
    rows = [zero | {"l": 1, "last": int(i == most + 1)} for i in range(most + 2)] + [zero | {"l": 1, "last": 1}]
    assert flags(core, rows) == [False] * most + [True, True, False]


@oracle("cordic.rotate", status=("overflow",))
def test_overflow_of_a_rotation(core):
    """Beyond 2^(W-1) by more than the error of 1.5 LSB, or inside by that."""
    half, eighth = 1 << core.params["W"] - 1, 1 << core.params["A"] - 3
    for length, beyond in ((half / math.sqrt(2) - 3, False), (half / math.sqrt(2) + 3, True)):
        for quarter in range(4):
            rows = [{"angle": (2 * quarter + 1) * eighth, "x": int(length), "y": int(length)}]
            assert flags(core, rows) == [beyond]


@oracle("paper.fk5", status=("overflow",))
def test_overflow_of_a_forearm(core):
    """The upper arm, or one of the two distances with it, along an axis."""
    half, near = 1 << core.params["W"] - 1, 4 + (1 << core.params["W"] >> core.params["S"])  # roots of S bits
    row = joint_words(core, (0, 0, 0))
    for l1, d4, d5, beyond in ((half // 2, half // 2 - near, 0, False), (half // 2, half // 2 + near, 0, True),
                               (half // 2, 0, half // 2 - near, False), (half // 2, 0, half // 2 + near, True),
                               (half - near, 0, 0, False), (half + near, 0, 0, True)):
        assert flags(core, [row], {"l1": l1, "d4": d4, "d5": d5}) == [beyond]


@oracle("arm.arm_fk3", status=("overflow",))
def test_overflow_of_an_arm_with_offsets(core):
    """Stretched along x: L1 + l2 + a; z the base and the elbow's offset, y the lateral one. Upright: z."""
    p, half = core.params, 1 << core.params["W"] - 1
    quarter = half // 4
    cfg = {"l1": quarter, "l2": quarter, "base": 0, "shoulder": 0, "lateral": 0, "elbow": 0}
    level, upright = joint_words(core, (0, 0, 0)), joint_words(core, (1, 1 * p["ABSOLUTE"], 0))
    for more in (-1, 0):
        if p["SHOULDER"]:
            assert flags(core, [level], cfg | {"shoulder": half + more - 2 * quarter}) == [more == 0]
        if p["BASE"]:
            assert flags(core, [upright], cfg | {"base": half + more - 2 * quarter}) == [more == 0]
            assert flags(core, [joint_words(core, (3, 3 * p["ABSOLUTE"], 0))],
                         cfg | {"base": -half - 1 - more + 2 * quarter}) == [more == 0]
        if p["LATERAL"]:
            turned = joint_words(core, (0, 0, 3))
            cfg_x = cfg | {"l1": 0, "l2": 0, "lateral": half - 1}
            assert flags(core, [turned], cfg_x | {"l1": 1}) == [False]
    if p["ELBOW"] and p["BASE"]:
        for more in (-1, 0):
            assert flags(core, [level], cfg | {"elbow": half // 2, "base": half // 2 + more}) == [more == 0]


@oracle("arm.velocity2", "arm.velocity3", status=("overflow",))
def test_overflow_of_a_velocity(core):
    """1 rad a unit of time turns a stretched arm: a velocity of L1 + L2 along y, or z; -1 rad the other way."""
    half, radian = 1 << core.params["W"] - 1, 1 << core.params["V"]
    number = int(core.function[-1])
    row = joint_words(core, (0,) * number) | {f"w{i}": 0 for i in range(1, number + 1)}
    axis = "y" if number == 2 else "z"
    for more in (-1, 0, 1):
        cfg = {"l1": half // 2, "l2": half // 2 + more}
        up, down = ask(core, [row | {"w1": radian}, row | {"w1": -radian}], cfg)
        assert bool(up["status"]) == (more >= 0) and up[axis] == half - 1
        assert bool(down["status"]) == (more > 0) and down[axis] == -half - min(more, 0)
        if number == 3:
            assert flags(core, [row | {"w3": radian}], cfg) == [more >= 0]


@oracle("arm.rates2", "arm.rates3", status=("singular", "overflow"))
def test_rates_of_an_arm_with_a_square_elbow(core):
    """Joint 1 at 0, joint 2 at a quarter turn: w1 = vy / L1, w1 + w2 = -vx / L2; w3 = vt / L1. In units of 2^-V.

    A threshold takes the place of a smaller divisor; below it, and where one is 0, the sample is singular.
    """
    w, v, u = (core.params[key] for key in "WVU")
    half, one, space = 1 << w - 1, 1 << u, core.function == "rates3"
    up = "z" if space else "y"
    row = joint_words(core, (0, 1, 0)[:3 if space else 2]) | dict.fromkeys("xyz"[:3 if space else 2], 0)
    l1 = half >> w - v
    while half * l1 >> v >= half - 2:
        l1 //= 2
    cfg = {"l1": l1, "l2": half // 4, "sine": 16, "radius": 1}
    cfg = {port.name[4:]: cfg[port.name[4:]] for port in core.cfg}
    edge = half * l1 >> v  # the velocity of 2^(W-1) units of w1

    def nearest(number: Fraction) -> int:
        size = math.floor(abs(number) + Fraction(1, 2))
        return size if number >= 0 else -size

    seen = set()
    for vy in range(edge - 3, edge + 3):
        for sign in (1, -1):
            found = ask(core, [row | {up: sign * vy}], cfg)[0]
            exact = nearest(Fraction(sign * vy << v, l1))
            beyond = not -half <= exact < half or not -half <= -exact < half  # w2 = -w1
            if sign < 0 and abs(exact - nearest(Fraction((sign * vy << v + 4) + (1 << v), l1 << 4))) > 0:
                continue  # a negative velocity is 1/16 LSB nearer to 0 inside: the quotient may round elsewhere
            assert bool(found["status"] & 4) == beyond, (vy, found, exact)
            assert found["w1"] == min(max(exact, -half), half - 1)
            seen.add(beyond)
    assert seen == {True, False}
    flat = row | {"c2": one, "n2": 0}
    for size, low in ((15, True), (16, False), (-15, True), (-16, False)):
        assert flags(core, [flat | {"n2": size}], cfg, "singular") == [low]
    found = ask(core, [row | {up: 5, "x": 5}], cfg | {"l1": 0})[0]
    assert found["status"] & 2 and found["w1"] == 0
    found = ask(core, [flat | {"x": 50, up: 5}], cfg | {"sine": 0})[0]
    assert found["status"] & 2 and found["w1"] == nearest(Fraction(5 << v, l1)) and found["w2"] == -found["w1"]
    if space:
        for radius, low in ((l1, False), (l1 + 1, True)):
            assert flags(core, [row], cfg | {"radius": radius}, "singular") == [low]
        found = ask(core, [row | {"y": 3}], cfg | {"radius": 4 * l1})[0]
        assert found["w3"] == nearest(Fraction(3 << v, 4 * l1))


# Singular: no direction, and the word that is held


@oracle("codec.vector_to_spread", "cordic.vector", *(f"{family}.ik1" for family in FAMILIES), status=("singular",))
def test_the_origin_alone_has_no_direction(core):
    """x = y = 0; the last word is held, after a reset 0 or (1, 0). cordic_vector alone holds nothing."""
    names = [port.name[3:] for port in core.inputs]
    high = core.inputs[0].high
    rows = [dict(zip(names, pair)) for pair in [(0, 0), *((x, y) for x in (0, 1, -1, high) for y in (0, -1, high)),
                                                (0, 0), (-high - 1, 1), (0, 0)]]
    found = ask(core, rows)
    before = {"c1": 1 << core.params.get("U", 0), "n1": 0, "j": 0, "j1": 0}
    for row, answer in zip(rows, found):
        none = not any(row.values())
        assert answer.pop("status") == 2 * none
        if none and core.family != "cordic":
            assert all(before[name] == word for name, word in answer.items())
        before |= answer


@oracle("codec.vector_to_angle", "codec.unit_to_spread", "codec.vector_to_half_tangent", status=("singular",))
def test_a_short_vector_has_no_direction(core):
    """|c| < 1/2 and |n| < 11/16, where -1/2 and -11/16 are short as well; the last word is held, 0 at first."""
    one = 1 << core.params["U"]
    edge_c, edge_n = one // 2, 11 * one // 16
    rows = [{"c": 0, "n": 0}]
    rows += [{"c": c, "n": n} for c in (0, edge_c - 1, edge_c, -edge_c, -edge_c - 1, one)
             for n in (0, edge_n - 1, edge_n, -edge_n, -edge_n - 1, one)]
    before = 0
    for row, answer in zip(rows, ask(core, rows)):
        none = -edge_c <= row["c"] < edge_c and -edge_n <= row["n"] < edge_n
        assert answer["status"] == 2 * none, row
        if none:
            assert answer["j"] == before
        before = answer["j"]


@oracle("codec.normalise", status=("singular",))
def test_no_vector_and_one_too_long_cannot_be_normalised(core):
    """0, and c^2 + n^2 of 3 and more: the factor (3 - c^2 - n^2) / 2 would turn it round."""
    one = 1 << core.params["U"]
    long = math.isqrt(3 * one * one)
    cases = [(0, 0, True), (1, 0, False), (0, -1, False), (long - 8, 0, False), (long + 1, 0, True),
             (-long - 8, 0, True), (one + one // 4, one + one // 8, False), (one + one // 4, one + one // 4, True)]
    for c, n, none in cases:
        assert flags(core, [{"c": c, "n": n}], bit="singular") == [none], (c, n)
    held = ask(core, [{"c": 0, "n": 0}, {"c": 0, "n": one}, {"c": 0, "n": 0}])
    assert [(row["c"], row["n"]) for row in held] == [(one, 0), (0, one), (0, one)]


# Reach


def near_a_circle(radius2: int, rng: random.Random, half: int, offs) -> list[tuple[int, int]]:
    """Points (x, y) with squares next to a squared radius, by each of the `offs`."""
    found = []
    for off in offs:
        square = radius2 + off
        if square < 0:
            continue
        root = math.isqrt(square)
        for _ in range(6):
            x = rng.randint(-min(root, half), min(root, half - 1))
            y = math.isqrt(square - x * x)
            y = rng.choice((-1, 1)) * (y + rng.choice((0, 1)))
            if -half <= y < half:
                found.append((x, y))
    return found


@oracle(*(f"{family}.ik2" for family in ("vector", "table", "rational", "classic")), "table.ik3r",
        status=("unreachable", "singular"))
def test_reach_of_two_links(core):
    """Never flagged in the annulus, its borders included; always beyond by the error of the gap; singular at 0 alone.

    Lengths aligned to 16, 20 or 24 bits. The gap is cut by its shift, 2^(7 - 2 e) of 16 bits, and 1 / 2 L1 L2 by a unit
    of its word, so that 2 L1 L2 / r is added: 16 LSB^2 at links of 2^13. Classic compares squares as they are.
    """
    w, rng, seen = core.params["W"], random.Random(4), set()
    bits = 16 if w <= 16 else 20 if w <= 20 else 24
    half, up, drop = 1 << w - 1, bits - w, {16: 7, 20: 15, 24: 19}[bits]
    for l1, l2 in ((1 << w - 3, 1 << w - 3), (half // 2, half // 3), (half // 30 + 3, half // 37), (half // 2, 1)):
        cfg = words_of(core, l1, l2)
        far, near = (l1 + l2) ** 2, (l1 - l2) ** 2
        slack = 0
        if core.family != "classic":
            double = 2 * (l1 << up) * (l2 << up)
            slack = double // cfg["r"] + 2 ** max(drop - 2 * cfg["e"], 0) + 1
            assert slack <= 20 << 2 * (bits - 16) or not l1 == l2 == 1 << w - 3
        points = [(l1 + l2, 0), (0, -l1 - l2), (-abs(l1 - l2), 0), (0, 0), (0, 0)]
        for radius2 in (far, near):
            points += near_a_circle(radius2, rng, half, (*range(-40, 60, 7), 0, 1, -1, 400, -400, 5000 << bits - 16))
        points = [(x, y) for x, y in points if -half <= x < half and -half <= y < half]
        rows = [target(core, x, y, 0, i % 2) for i, (x, y) in enumerate(points)]
        for (x, y), answer in zip(points, ask(core, rows, cfg)):
            q, flag = x * x + y * y, bool(answer["status"] & 1)
            assert bool(answer["status"] & 2) == (q == 0)
            if near <= q <= far:
                assert not flag, (l1, l2, x, y)
                seen.add(False)
            elif (q - far) * 4**up > slack or (near - q) * 4**up > slack:
                assert flag, (l1, l2, x, y)
                seen.add(True)
    assert seen == {True, False}


EDGED = ("vector.ik2", "vector.ik3", "table.ik2", "table.ik3", "table.ik3r", "rational.ik2", "rational.ik3")


def without_margins(core) -> bool:
    """Whether a core has no margin and no slack; then their words change nothing."""
    if core.params["MARGINS"]:
        return False
    rng, w = random.Random(9), core.params["W"]
    cfg = words_of(core, 1 << w - 3, 1 << w - 3)
    ends = {port.name[4:]: port.high for port in core.cfg if port.name in ("cfg_margin", "cfg_slack")}
    rows = [target(core, *(rng.randint(-1 << w - 2, 1 << w - 2) for _ in "xyz"), rng.randint(0, 1)) for _ in range(200)]
    assert len(ends) == 2 and ask(core, rows, cfg) == ask(core, rows, cfg | ends)
    return True


def turned_about_z(core, x: float, y: float, z: float, yaw: float) -> tuple[int, int, int]:
    """A target of the plane, rounded; of a core in space the plane's x and y are its rho and z, turned by `yaw`."""
    if core.function != "ik3":
        return round(x), round(y), 0
    return round(x * math.cos(yaw)), round(x * math.sin(yaw)), round(y + z)


@oracle(*EDGED, status=("singular",), cfg=("margin",))
def test_margin_of_two_links(core):
    """Bit 1 where L2 |sin j2|, or in space the distance from the yaw axis, is less LSB than the margin; both elbows,
    stretched, folded and beyond reach. A margin of 0 says nothing."""
    if without_margins(core):
        return
    w, rng, seen = core.params["W"], random.Random(7), []
    space, lsb = core.function == "ik3", 2.0 ** -core.params["F"]
    for l1, l2 in ((1 << w - 3, 1 << w - 3), ((1 << w - 1) // 2, (1 << w - 1) // 3), (1 << w - 4, (1 << w - 4) * 3)):
        margin = l2 // 5
        cfg = words_of(core, l1, l2) | {"margin": DERIVE[core.family](
            core.params, cfg_l1=l1, cfg_l2=l2, margin=margin * lsb)["cfg_margin"]}
        assert cfg["margin"] == margin
        rows, away = [], []
        while len(rows) < 600:
            j1, j2 = rng.uniform(-math.pi, math.pi), rng.choice((0, math.pi)) + rng.uniform(-0.5, 0.5)
            x, y = (l1 * trig(j1) + l2 * trig(j1 + j2) for trig in (math.cos, math.sin))
            x *= rng.choice((1, 1, 1, 1.01))
            x, y, z = turned_about_z(core, abs(x) if space else x, y, 0, rng.uniform(-math.pi, math.pi))
            if max(abs(x), abs(y), abs(z)) >= 1 << w - 1 or not (space or x or y):
                continue
            c2 = (x * x + y * y + z * z - l1 * l1 - l2 * l2) / (2 * l1 * l2)
            away.append(min(l2 * math.sqrt(max(0, 1 - c2 * c2)), math.hypot(x, y) if space else math.inf))
            rows.append(target(core, x, y, z, rng.randint(0, 1)))
        slip = 1 + l2 / 2048
        for distance, answer, none in zip(away, ask(core, rows, cfg), ask(core, rows, cfg | {"margin": 0})):
            assert not none["status"] & 2 or distance == 0
            assert {**answer, "status": 0} == {**none, "status": 0} and answer["status"] & 1 == none["status"] & 1
            if abs(distance - margin) > slip:
                assert bool(answer["status"] & 2) == (distance < margin), distance
                seen.append(distance < margin)
    assert min(seen.count(False), seen.count(True)) > 300


@oracle(*EDGED, status=("unreachable",), cfg=("slack",))
def test_slack_of_two_links(core):
    """Not flagged up to the slack beyond L1 + L2, flagged beyond it and nearer than |L1 - L2|; the same answers. The
    word is 2^14 of what c2 is above 1 at the slack, of words of 20 bits 2^18 and of 24 bits 2^22, rounded up."""
    if without_margins(core):
        return
    w, rng, seen = core.params["W"], random.Random(8), set()
    lsb = 2.0 ** -core.params["F"]
    for l1, l2, slack in ((1 << w - 3, 1 << w - 3, 6), ((1 << w - 1) // 3, (1 << w - 1) // 5, 20),
                          (1 << w - 3, 1 << w - 4, 1)):
        found = DERIVE[core.family](core.params, cfg_l1=l1, cfg_l2=l2, slack=slack * lsb)
        cfg = words_of(core, l1, l2) | {"slack": found["cfg_slack"]}
        above = Fraction((l1 + l2 + slack) ** 2 - (l1 + l2) ** 2, 2 * l1 * l2)
        assert cfg["slack"] == math.ceil(above * 2 ** max(14, (w + 3) // 4 * 4 - 2))
        points, away = [], []
        while len(points) < 400:
            off, turn, yaw = rng.uniform(-3, 3 * slack + 4), rng.uniform(-math.pi, math.pi), rng.uniform(0, 6)
            radius = l1 + l2 + off if rng.random() < 0.9 else abs(l1 - l2) * rng.random() / 2
            x = radius * math.cos(turn)
            x, y, z = turned_about_z(core, abs(x) if core.function == "ik3" else x, radius * math.sin(turn), 0, yaw)
            if max(abs(x), abs(y), abs(z)) < 1 << w - 1:
                points.append(target(core, x, y, z, rng.randint(0, 1)))
                away.append(math.sqrt(x * x + y * y + z * z))
        for r, answer, none in zip(away, ask(core, points, cfg), ask(core, points, cfg | {"slack": 0})):
            assert {**answer, "status": 0} == {**none, "status": 0} and answer["status"] & 2 == none["status"] & 2
            beyond = r - l1 - l2
            if r < abs(l1 - l2) - 2 or abs(beyond - slack) > 0.75:
                flag = beyond > slack or r < abs(l1 - l2) - 2
                assert bool(answer["status"] & 1) == flag, beyond
                seen.add((flag, beyond > 0.75, r < l1))
            if beyond > 0.75:
                assert none["status"] & 1
    assert seen >= {(True, True, False), (False, True, False), (False, False, False), (True, False, True)}


@oracle(*(f"{family}.ik3" for family in ("vector", "table", "rational", "classic")), status=("unreachable", "singular"))
def test_reach_of_two_links_that_yaw(core):
    """On the yaw axis, where rho is 0: |z| from |L1 - L2| to L1 + L2, exact. Off it by a quarter of a 16-bit LSB, of
    longer words by half an LSB of 20 or 24 bits."""
    w, rng, seen = core.params["W"], random.Random(5), set()
    half, off = 1 << w - 1, 0.25 / 2 ** (16 - w) if w <= 16 else 0.5 / 2 ** (-w % 4)
    for l1, l2 in ((1 << w - 3, 1 << w - 3), (half // 2, half // 3), (half // 30 + 3, half // 37)):
        cfg, far, near = words_of(core, l1, l2), l1 + l2, abs(l1 - l2)
        points = [(0, 0, sign * z) for z in (far - 1, far, far + 1, near - 1, near, near + 1) for sign in (1, -1)]
        points += [(x, 0, z) for radius2 in (far**2, near**2)
                   for x, z in near_a_circle(radius2, rng, half, (-4000, -400, 0, 400, 4000, 40_000))]
        points = [point for point in points if all(-half <= one < half for one in point)]
        for (x, y, z), answer in zip(points, ask(core, [target(core, *point) for point in points], cfg)):
            radius, flag = math.sqrt(x * x + z * z), bool(answer["status"] & 1)
            assert bool(answer["status"] & 2) == (x == y == 0)
            if x == 0 and core.family != "classic" and near <= abs(z) <= far:
                assert not flag
            elif near + off <= radius <= far - off or core.family == "classic" and near <= radius <= far:
                assert not flag, (l1, l2, x, z)
                seen.add(False)
            elif radius > far + off or radius < near - off:
                assert flag, (l1, l2, x, z)
                seen.add(True)
    assert seen == {True, False}


@oracle("paper.ik2", "paper.ik3", status=("unreachable", "singular", "overflow"))
def test_reach_of_the_paper(core):
    """Squares are cut to G = min(S, 2 F) fraction bits; singular where they are 0; a link of 2^(W-1) LSB overflows."""
    p, rng, seen = core.params, random.Random(6), set()
    half, f = 1 << p["W"] - 1, p["F"]
    cut = 4**f >> min(p["S"], 2 * f)  # of a square, LSB^2
    for l1, l2 in ((half // 4, half // 4), (half // 3, half // 5)):
        cfg, far, near = {"l1": l1, "l2": l2}, (l1 + l2) ** 2, (l1 - l2) ** 2
        points = [point for radius2 in (far, near)
                  for point in near_a_circle(radius2, rng, half, (0, *(sign * cut * k for sign in (-1, 1)
                                                                     for k in (1, 8, 50, 1000))))]
        rows = [target(core, x, 0, y) if core.function == "ik3" else target(core, x, y, 0) for x, y in points]
        for (x, y), answer in zip(points, ask(core, rows, cfg)):
            q, flag = x * x + y * y, bool(answer["status"] & 1)
            margin = 8 * cut if cut > 1 else 0
            if near + margin <= q <= far - margin:
                assert not flag
                seen.add(False)
            elif q > far + margin or q < near - margin:
                assert flag
                seen.add(True)
    assert seen == {True, False}
    short = math.isqrt(cut) if cut > 1 else 1  # below it a square is cut to 0
    cfg = {"l1": half // 4, "l2": half // 5}
    near = short - 1
    for x, y, z in ((0, 0, 0), (near, near, 0), (short, 0, 0), (0, -short, 0), (0, 0, short), (0, 0, half // 2)):
        flat = max(abs(x), abs(y)) < short
        assert flags(core, [target(core, x, y, z)], cfg, "singular") == [flat], (x, y, z)
    for l1, l2 in ((half - 1, half - 1), (half, 1), (1, half)):
        assert flags(core, [target(core, 5, 5, 5)], {"l1": l1, "l2": l2}) == [half in (l1, l2)]


@oracle("table.ik3r", status=("overflow",))
def test_a_wrist_beyond_the_word_is_saturated(core):
    """The last link points down: the wrist is L3 above the tip, at most 2^(W-1) - 1; the joints lead there."""
    w, a = core.params["W"], core.params["A"]
    half = 1 << w - 1
    l1, l2, l3 = half - 1, half - 2, half // 4
    cfg = words_of(core, l1, l2) | {"l3": l3}
    for y in (half - 1 - l3, half - l3, half - 1):
        for sign in (1, -1):
            x = half // 3
            tip = y if sign > 0 else -y - 1
            row = {"x": x, "y": tip, "phi": (3 if sign > 0 else 1) << a - 2, "elbow": 0}
            found = ask(core, [row], cfg)[0]
            wrist = tip + sign * l3
            assert bool(found["status"] & 4) == (not -half <= wrist < half)
            held = min(max(wrist, -half), half - 1)
            j1, j2 = (found[f"j{i}"] * 2 * math.pi / 2**a for i in (1, 2))
            place = (l1 * math.cos(j1) + l2 * math.cos(j1 + j2), l1 * math.sin(j1) + l2 * math.sin(j1 + j2))
            assert math.dist(place, (x, held)) <= 2 + 2 * l1 * math.pi / 2**a


@oracle("arm.arm_ik3", "arm.keep3", status=("unreachable", "singular", "overflow"))
def test_reach_of_an_arm_with_offsets(core):
    """Out of the annulus about the shoulder axis, or nearer to the yaw axis than b; z - base beyond its word."""
    p, half, rng = core.params, 1 << core.params["W"] - 1, random.Random(7)
    a, b, base = half // 16 * p["SHOULDER"], half // 8 * p["LATERAL"], half // 9 * p["BASE"]
    l1, l2 = half // 3, half // 5
    derive = arm_keep.config if core.function == "keep3" else arm.config
    cfg = {"cfg_l1": l1, "cfg_l2": l2, "cfg_base": base, "cfg_shoulder": a, "cfg_lateral": b}
    cfg = {name[4:]: word for name, word in (cfg | derive(p, **cfg)).items()}
    seen, points = set(), [[int(rng.uniform(-1, 1) * scale) for _ in range(3)]
                           for scale in 100 * [0.1 * half, 0.5 * half, half]]
    for (x, y, z), found in zip(points, ask(core, [target(core, *point) for point in points], cfg)):
        inside = math.hypot(x, y) - b
        rho = math.sqrt(max(x * x + y * y - b * b, 0))
        sides = [rho - a] + [-rho - a] * (core.function == "keep3")
        off = []
        for side in sides:
            radius = math.hypot(side, z - base)
            off.append(max(radius - l1 - l2, abs(l1 - l2) - radius, -inside))
        off = min(off)  # of the nearer branch
        over = not -half <= z - base < half
        assert bool(found["status"] & 4) == over
        if abs(off) > 1 and not over:
            assert bool(found["status"] & 1) == (off > 0), (x, y, z, found)
            seen.add(off > 0)
    assert seen == {True, False}
    assert flags(core, [target(core, 0, 0, 7)], cfg, "singular") == [True]
    assert flags(core, [target(core, 9, 1, 7)], cfg, "singular") == [False]
    if not p["LATERAL"] and core.function == "arm_ik3":
        assert flags(core, [target(core, a, 0, base)], cfg, "singular") == [True]
        assert flags(core, [target(core, a, 0, base + 1)], cfg, "singular") == [False]


@oracle("arm.arm_ik3", status=("unreachable", "singular"), cfg=("margin", "slack"))
def test_margin_and_slack_of_an_arm_with_offsets(core):
    """Bit 1 where L2 |sin| of the elbow, or the distance of the wrist from the yaw axis in the arm's plane, is less LSB
    than the margin, before and behind that axis; bit 0 from the slack beyond L1 + L2 on. The words of the joints stay.
    """
    if without_margins(core):
        return
    p, half, rng = core.params, 1 << core.params["W"] - 1, random.Random(7)
    a, b, base = half // 16 * p["SHOULDER"], half // 8 * p["LATERAL"], half // 9 * p["BASE"]
    l1, l2, margin, slack, lsb = half // 3, half // 5, half // 24, 5, 2.0 ** -p["F"]
    lengths = {"cfg_l1": l1, "cfg_l2": l2, "cfg_base": base, "cfg_shoulder": a, "cfg_lateral": b}
    cfg = {name[4:]: word for name, word in (lengths | arm.config(p, **lengths)).items()}
    own = {name[4:]: word for name, word in arm.config(p, **lengths, margin=margin * lsb, slack=slack * lsb).items()}
    assert own["margin"] == margin and cfg["margin"] == cfg["slack"] == 0
    rows, near, beyond = [], [], []
    while len(rows) < 1500:
        back, turn = rng.randint(0, 1), rng.uniform(-math.pi, math.pi)
        if rng.random() < 0.4:  # next to the yaw axis
            rho, height = rng.uniform(0, 2 * margin) * (1 - 2 * back), rng.uniform(-1, 1) * (l1 + l2)
        else:
            radius = rng.choice((l1 + l2 + rng.uniform(-slack, 3 * slack), rng.uniform(l1 - l2, l1 + l2)))
            rho, height = a + radius * math.cos(turn), radius * math.sin(turn)
        if (rho < 0) != bool(back):
            continue
        far, yaw = math.hypot(rho, b), rng.uniform(-math.pi, math.pi)
        x, y, z = round(far * math.cos(yaw)), round(far * math.sin(yaw)), round(height + base)
        rho = math.sqrt(max(x * x + y * y - b * b, 0)) * (1 - 2 * back)
        if max(abs(x), abs(y), abs(z)) >= half or math.hypot(x, y) < b + 1:
            continue
        radius = math.hypot(rho - a, z - base)
        c2 = (radius * radius - l1 * l1 - l2 * l2) / (2 * l1 * l2)
        rows.append(target(core, x, y, z, rng.randint(0, 1)) | {"back": back})
        near.append(min(l2 * math.sqrt(max(0, 1 - c2 * c2)), abs(rho)))
        beyond.append(radius - l1 - l2 if radius > l1 else 2 * slack if radius < l1 - l2 - 2 else None)
    seen = []
    for distance, over, answer, none in zip(near, beyond, ask(core, rows, cfg | own), ask(core, rows, cfg)):
        assert {**answer, "status": 0} == {**none, "status": 0} and (answer["status"] ^ none["status"]) & 12 == 0
        assert not none["status"] & 2 or distance < 2
        if abs(distance - margin) > 1 + l2 / 2048:
            assert bool(answer["status"] & 2) == (distance < margin), distance
            seen.append(("margin", distance < margin))
        if over is not None and abs(over - slack) > 1:
            assert bool(answer["status"] & 1) == (over > slack), over
            seen.append(("slack", over > slack, over > 1))
    assert all(seen.count(one) > 25 for one in (("margin", False), ("margin", True), ("slack", True, True),
                                               ("slack", False, True), ("slack", False, False))), Counter(seen)


# Choice of a branch


def choose(branches: list[list[dict]], joints: int, cfg: dict[str, int], u: int) -> list[dict]:
    """What arm_keep answers, from the branches of every sample: (c, n) a joint, None where it has no direction.

    In this order: within the limits of all joints, in reach, nearest to the answer before by the sum of the cosines,
    the first. A joint without a direction takes that of the last answer. What is out of limits is not remembered.
    """
    one, answers = 1 << u, []
    last = [(one, 0)] * joints

    def cosine(a: tuple[int, int], b: tuple[int, int]) -> int:
        return a[0] * b[0] // one + a[1] * b[1] // one

    for found in branches:
        best = None
        for number, branch in enumerate(found):
            pose = [held if word is None else word for word, held in zip(branch["pose"], last)]
            fits = all(cosine(word, (cfg[f"mc{i}"], cfg[f"mn{i}"])) > cfg[f"h{i}"] for i, word in enumerate(pose, 1))
            rank = (fits, not branch["status"] & 1, sum(map(cosine, pose, last)))
            if best is None or rank > best[0]:
                best = rank, pose, number, branch["status"]
        (fits, *_), pose, number, status = best
        if fits:
            last = pose
        answers.append({"pose": pose, "elbow": number % 2, "back": number // 2, "beyond": int(not fits),
                        "status": status})
    return answers


def _branches(core, rows: list[dict], cfg: dict[str, int]) -> list[list[dict | None]]:
    """Answers of vector_ik2 or arm_ik3, each branch of each sample from a reset. A joint without a direction is None;
    so is a branch of arm_ik3 whose target is in the shoulder axis, for that core does not say which joint it is.
    """
    space = core.function == "keep3"
    other = cores.find("arm_ik3" if space else "vector_ik2")
    other = replace(other, params=core.params | ({} if space else {"PRODUCTS": 3}))
    own = {port.name[4:]: cfg.get(port.name[4:], 0) for port in other.cfg}
    found = []
    for row in rows:
        some = []
        for number in range(4 if space else 2):
            sample = row | {"elbow": number % 2} | ({"back": number // 2} if space else {})
            answer = ask(other, [sample], own)[0]
            pose = [(answer[f"c{i}"], answer[f"n{i}"]) for i in range(1, 4 if space else 3)]
            if answer["status"] & 2:
                pose[2 if space else 0] = None
            unclear = space and answer["status"] & 2 and (row["x"] or row["y"] or not row["z"])
            some.append(None if unclear else {"pose": pose, "status": answer["status"]})
        found.append(some)
    return found


@oracle("arm.keep2", "arm.keep3", status=("unreachable", "singular"))
def test_the_best_branch(core):
    """Order and ties of the choice, sample behind sample, at limits that cut and at none."""
    rng = random.Random(8)
    configs = stimulus.configs(core, np.random.default_rng(3))
    ties, orders = 0, set()
    for words in configs[::2 if core.function == "keep2" else 3]:
        cfg = {name[4:]: word for name, word in words.items()}
        columns = stimulus.corners(core, words)
        size = next(iter(columns.values())).size
        rows = [{name[3:]: int(column[i]) for name, column in columns.items()} for i in rng.sample(range(size), 40)]
        rows = [{"x": 1000 >> 16 - core.params["W"], "y": 0} | ({"z": 0} if "z" in rows[0] else {}), *rows]
        branches = _branches(core, rows, cfg)
        clear = [all(branch is not None for branch in some) for some in branches]
        rows, branches = ([one for one, keep in zip(some, clear) if keep] for some in (rows, branches))
        if not rows:
            continue
        joints = len(branches[0][0]["pose"])
        want = choose(branches, joints, cfg, core.params["U"])
        for row, answer, best, some in zip(rows, ask(core, rows, cfg), want, branches):
            assert [(answer[f"c{i}"], answer[f"n{i}"]) for i in range(1, joints + 1)] == best["pose"], row
            assert {name: answer.get(name, 0) for name in ("elbow", "back", "beyond", "status")} == {
                name: best[name] for name in ("elbow", "back", "beyond", "status")}, row
            orders.add((best["beyond"], best["status"] & 1))
            ties += some[0]["pose"] == some[1]["pose"] or row["y"] == 0
    assert ties and len(orders) >= 3


# Arithmetic


@pytest.mark.parametrize("core", [core for core in cores.all_cores() if core.name == "divide"],
                         ids=lambda core: core.id)
def test_division_by_zero(core):
    """All ones, the remainder n 2^F modulo 2^WD, the flag; the next division is right again."""
    wn, wd, f = (core.params[name] for name in ("WN", "WD", "F"))
    rows = [{"n": n, "d": d} for n in (0, 1, 2**wn - 1, 2**wn // 3) for d in (0, 1, 2**wd - 1, 0)]
    for row, answer in zip(rows, ask(core, rows)):
        n, d = row["n"] << f, row["d"]
        want = (n // d, n % d, 0) if d else (2 ** (wn + f) - 1, n % 2**wd, 1)
        assert (answer["q"], answer["r"], answer["div_by_zero"]) == want
