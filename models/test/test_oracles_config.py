"""Configuration words from the pages, in integers and mpmath; the functions under test are the models' `config`."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction

import mpmath
import pytest
from quadrance import (
    arm,
    arm_keep,
    arms,
    classic,
    cordic,
    engine_delta,
    engine_rus,
    kernel_vector_solve,
    rational,
    six,
    table,
    tool,
    vector,
)
from quadrance.cores import Core
from quadrance.iterative import newton_fixed
from quadrance.parallel import geometry

from models.test.oracles import oracle

DERIVE = {"vector": vector.config, "table": table.config, "rational": rational.config}


def pairs(width: int) -> list[tuple[int, int]]:
    """Link lengths: ordinary, longest, none, very unlike, at each power of two, at random."""
    rng, top = random.Random(1), (1 << width) - 1
    some = [(top, top), (0, 0), (0, 5), (1, 1), (top, 1), (1, top), (top // 8, top // 9)]
    some += [(1 << i, 1 << j) for i in range(width) for j in (0, i, width - 1)]
    return some + [(rng.randrange(1 << rng.randint(1, width)), rng.randrange(1 << rng.randint(1, width)))
                   for _ in range(200)]


FRACTION = {16: 25, 20: 25, 24: 29}  # of the words of a kernel, by the bits of its coordinates


def aligned_bits(core: Core) -> int:
    """Bits of the coordinates of a core's kernel."""
    return min(bits for bits in FRACTION if bits >= core.params["W"])


def gap_words(l1: int, l2: int, bits: int = 16) -> dict[str, int]:
    """Of lengths aligned to that many bits. The gap q - L1^2 - L2^2 is shifted left by 2 e - 7 (15 of 20 bits, 19 of
    24), so that 2 L1 L2, its greatest in reach, has 2 bits or one more; a shift to the right is rounded. 1 / 2 L1 L2 is
    rounded down: what is in reach, the border included, never seems out of it.
    """
    double, e, drop = 2 * l1 * l2, bits - 1, 2 * bits - FRACTION[bits]
    while double * 4**e >= 2 ** (2 * bits + 1):
        e -= 1
    half = 2 ** (drop - 2 * e) // 2 if 2 * e < drop else 0
    r = 0
    for bit in range(FRACTION[bits] + 1, -1, -1):  # the greatest with r (2 L1 L2 + half) below 2^(56 - 2 e), or so
        if (r | 1 << bit) * max(double + half, 1) < 2 ** (2 * FRACTION[bits] - 1 + drop - 2 * e):
            r |= 1 << bit
    return {"cfg_q": half - l1**2 - l2**2 + (l1 == l2 == 0), "cfg_r": r, "cfg_e": e}


@oracle(*(f"{family}.{function}" for family in DERIVE for function in ("ik2", "ik3")), "table.ik3r",
        cfg=("q", "r", "e"))
def test_words_of_the_gap(core):
    bits = aligned_bits(core)
    up = bits - core.params["W"]
    for l1, l2 in pairs(core.params["W"]):
        words = DERIVE[core.family](core.params, cfg_l1=l1, cfg_l2=l2)
        gap = gap_words(l1 << up, l2 << up, bits)
        assert {name: words[name] for name in gap} == gap, (l1, l2)
        assert all(words[port.name] in range(port.low, port.high + 1) for port in core.cfg if port.name in words)


def test_words_of_the_gap_on_the_page():
    """The instance that rtl/vector/README.md prints."""
    words = {"cfg_q": -118783999, "cfg_r": 9611115, "cfg_e": 3}
    assert gap_words(8320, 7040) == words == kernel_vector_solve.config({"W": 16}, cfg_l1=8320, cfg_l2=7040)


@oracle("arm.arm_ik3", "arm.keep2", "arm.keep3", cfg=("q", "r", "e"))
def test_words_of_the_gap_of_an_arm(core):
    bits = aligned_bits(core)
    up = bits - core.params["W"]
    derive = arm.config if core.function == "arm_ik3" else arm_keep.config
    for l1, l2 in pairs(core.params["W"])[::3]:
        found = derive(core.params, cfg_l1=l1, cfg_l2=l2)
        assert {name: found[name] for name in ("cfg_q", "cfg_r", "cfg_e")} == gap_words(l1 << up, l2 << up, bits)


@oracle("arm.arm_ik3", "arm.keep3", cfg=("bb", "ce", "ne"))
def test_words_of_an_arms_constants(core):
    """-b^2 of b aligned to 16, 20 or 24 bits; cos psi and -sin psi, psi = atan2(e, l2), of every arm of the library."""
    p = core.params
    for lateral in (0, 1, -1, 77, -(1 << p["W"] - 1) + 1, (1 << p["W"] - 1) - 1):
        aligned = lateral * 2 ** (aligned_bits(core) - p["W"])
        assert arm.config(p, cfg_l1=9, cfg_l2=8, cfg_lateral=lateral)["cfg_bb"] == -aligned**2
    seen = set()
    for name in arms.known():
        robot = arms.load(name)
        words = arm.words(p, replace(robot, mm_per_unit=4 * robot.mm_per_unit), inverse=True)
        psi = mpmath.atan2(robot.elbow, mpmath.sqrt(mpmath.mpf(robot.l2) ** 2 - mpmath.mpf(robot.elbow) ** 2))
        assert words["cfg_ce"] == int(mpmath.floor(mpmath.cos(psi) * 2 ** p["U"] + 0.5))
        assert words["cfg_ne"] == int(mpmath.floor(-mpmath.sin(psi) * 2 ** p["U"] + 0.5))
        seen.add(words["cfg_ne"] < 0)
    assert seen == {True, False}  # an elbow offset and none


@oracle("arm.keep2", "arm.keep3", cfg=[f"{word}{joint}" for joint in (1, 2, 3) for word in ("mc", "mn", "h")])
def test_words_of_limits(core):
    """The middle, to nearest; the cosine of half the room, rounded down, less 3 units; -2 where a turn is free."""
    one, rng = 2 ** core.params["U"], random.Random(2)
    for i in range(100):
        low = rng.uniform(-7, 7)
        room = rng.uniform(0.01, 6.2) if i % 4 else rng.uniform(6.2832, 9)
        words = arm_keep.limit(core.params, 2, low, low + room)
        assert abs(words["cfg_mc2"] - mpmath.cos(low + mpmath.mpf(room) / 2) * one) <= 0.5001
        assert abs(words["cfg_mn2"] - mpmath.sin(low + mpmath.mpf(room) / 2) * one) <= 0.5001
        least = int(mpmath.floor(mpmath.cos(mpmath.mpf(room) / 2) * one)) - 3
        assert words["cfg_h2"] == (least if i % 4 else -2 * one)


# CORDIC: the lengths of vectors that micro-rotations change


def grown(first: int) -> mpmath.mpf:
    """What all micro-rotations from 2^-first on lengthen a vector by."""
    return mpmath.nprod(lambda i: mpmath.sqrt(1 + mpmath.mpf(4) ** -i), [first, 60])


@oracle(*(f"classic.{name}" for name in ("fk1", "fk2", "fk3", "ik2", "ik3")),
        cfg=("c1", "s1", "s2", "far", "near", "f"))
def test_words_of_classic(core):
    """Start vectors floor(L 0.607252935 2^4 or 2^5), of the second link 0.521499916; the longest words as 2^W - 3."""
    w = core.params["W"]
    gain = 1 / grown(0)
    assert abs(gain - 0.607252935) < 1e-9 and abs(gain**2 * mpmath.sqrt(2) - 0.521499916) < 1e-9
    for l1, l2 in pairs(w):
        short1, short2 = min(l1, 2**w - 3), min(l2, 2**w - 3)
        want = {"cfg_c1": int(mpmath.floor(short1 * gain * 16)), "cfg_s1": int(mpmath.floor(short1 * gain * 32)),
                "cfg_s2": int(mpmath.floor(short2 * gain**2 * mpmath.sqrt(2) * 32)),
                "cfg_far": (l1 + l2) ** 2, "cfg_near": (l1 - l2) ** 2,
                "cfg_f": Fraction((l2 - l1) * 2 ** (w + 2), l1 + l2).__floor__() if l1 + l2 else 0}
        assert classic.config(core.params, cfg_l1=l1, cfg_l2=l2) == want


def test_gain_words_of_cordic():
    """The digits of 1/1.16443, rotation without i = 0, and 2 / 1.646760 of the vectoring; angles rounded down."""
    digits = sum((-1) ** minus * Fraction(1, 2**shift) for shift, minus in cordic.GAIN_DIGITS)
    assert abs(float(digits) * grown(1) - 1) < 1.2e-5
    v = Fraction(1)
    for shift, minus in cordic.HORNER:
        v = 1 + (-1) ** minus * v / 2**shift
    assert abs(float(v) * grown(0) / 2 - 1) < 5e-6
    for bits in (12, 16, 23):
        for i in range(12):
            exact = mpmath.atan(mpmath.mpf(2) ** -min(i, 9)) / (2 * mpmath.pi) * 2 ** (min(i, 9) + bits)
            assert cordic.angle(i, bits) == int(mpmath.floor(exact))


# Engines


@oracle("engine.rus_ik", "engine.rus_ik_angle", cfg=("k", "c", "near"))
def test_words_of_six_legs(core):
    """1/LA as 2^38/LA; LA^2 - LB^2 in 2^8 LSB^2, and what truncation loses; the root in 64 LSB, rounded up."""
    robot = geometry.load("rus_2x3")
    for mm in (1 / 128, 1 / 100, 1 / 64):
        la, lb = Fraction(float(robot.la[0])) / Fraction(mm), Fraction(float(robot.lb[0])) / Fraction(mm)
        for near, word in ((0, 0), (20, -int(-20 / mm // 64)), (1e9, 4095)):
            found = engine_rus.config(core.params, robot, mm, near)
            assert abs(found["cfg_c"] - 2**38 / la) <= Fraction(1, 2) and found["cfg_near"] == word
            assert abs(found["cfg_k"] - (la**2 - lb**2) / 256 - 2 - la / 4096) <= Fraction(1, 2)


@oracle("engine.delta_fk", "engine.delta_fk_angle",
        cfg=("base", "la", "lb", "c1", "n1", "c2", "n2", "c3", "n3", "above"))
def test_words_of_a_delta(core):
    """Lengths in 2^-4 LSB, azimuths in 2^-25; the lower point of the robot is above where its z points down."""
    for name, mm in (("klipper_delta", 1 / 40), ("linuxcnc_delta", 1 / 30)):
        robot, mm = geometry.load(name), mm * 2 ** (16 - core.params["W"])
        azimuth = [mpmath.atan2(float(one[1]), float(one[0])) for one in robot.radial]
        base = sum((float(f) - float(j)) * float(r) for f, j, r in zip(robot.foot[0], robot.joint[0], robot.radial[0]))
        for below in (True, False):
            found = engine_delta.config(core.params, robot, mm, below)
            want = {"cfg_base": base / mm * 16, "cfg_la": robot.la[0] / mm * 16, "cfg_lb": robot.lb[0] / mm * 16}
            want |= {f"cfg_c{i}": mpmath.cos(one) * 2**25 for i, one in enumerate(azimuth, 1)}
            want |= {f"cfg_n{i}": mpmath.sin(one) * 2**25 for i, one in enumerate(azimuth, 1)}
            assert found.pop("cfg_above") == (1 if (robot.up[2] > 0) != below else 0)
            assert found.keys() == want.keys()
            assert all(abs(found[key] - value) <= 0.501 for key, value in want.items())


@oracle("engine.newton_3r", "engine.quaternion_dls", cfg=("r1", "r2", "lambda", "mu"))
def test_words_of_newton(core):
    """2^31 / 2 pi L of lengths in 16 bits, saturated; lambda in 2^-17, and lambda (2 + lambda) rounded down."""
    up = 2 ** (16 - core.params["W"])
    for damping in (0, 2**-9, 2**-8, 0.0123, 1 / 16, 0.25, 0.3333, 0.41):
        for l1, l2 in pairs(core.params["W"])[::5]:
            found = newton_fixed.config(core.params, cfg_l1=l1, cfg_l2=l2, damping=damping)
            for word, length in (("cfg_r1", l1), ("cfg_r2", l2)):
                exact = 2**31 / (2 * mpmath.pi * length * up) if length else mpmath.mpf(1 << 40)
                assert abs(found[word] - min(exact, 65535)) <= 0.5
            exact = Fraction(found["cfg_lambda"], 2**17)
            assert abs(exact - Fraction(damping)) <= Fraction(1, 2**18)
            assert found["cfg_mu"] == (exact * (2 + exact) * 2**17).__floor__()


@oracle("six.fk6", "six.fk6_of_angles", cfg=("a1", "a2", "b", "c1", "c2", "c3", "c4"))
def test_words_of_six_axes_forward(core):
    """Lengths in 2^-4 LSB."""
    lengths = {"a1": 1.3, "a2": -0.77, "b": 0.111, "c1": 2.5, "c2": 3.25, "c3": 2.9, "c4": -0.6}
    found = six.forward_config(core.params, **lengths)
    assert found.keys() == {f"cfg_{name}" for name in lengths}
    assert all(abs(found[f"cfg_{name}"] - value * 2 ** (core.params["F"] + 4)) <= 0.5
               for name, value in lengths.items())


@oracle("tool.xyzac", "tool.xyzbc", cfg=("xr", "yr", "d", "zs"))
def test_words_of_machine_tools(core):
    """Lengths in LSB; the height of the axis, its offset and the tool's length are added before the rounding."""
    p = core.params
    found = tool.config(p, x_rot=1.2345, y_rot=-2.71, z_rot=3.3, offset=0.123, z_offset=-7.7, tool=20.004)
    exact = {"cfg_xr": 1.2345, "cfg_yr": -2.71, "cfg_d": 0.123, "cfg_zs": 15.604}
    assert found.keys() == exact.keys()
    assert all(abs(word - exact[name] * 2 ** p["F"]) <= 0.5 for name, word in found.items())


@oracle("six.velocity6", "six.rates6", cfg=("a1", "a2", "b", "c2", "c3", "c4", "radius", "elbow", "sine"))
def test_words_of_six_rates(core):
    """Lengths in 2^-4 LSB; thresholds: a distance in LSB, k times the sine of an angle in LSB, that sine in 2^-U."""
    p = core.params
    lengths = {"a1": 0.13, "a2": -0.077, "b": 0.111, "c2": 0.325, "c3": 0.29, "c4": -0.06}
    lengths = {name: value * 2 ** (p["W"] - 1 - p["F"]) for name, value in lengths.items()}
    if core.function == "velocity6":
        found = six.motion_config(p, **lengths)
    else:
        radius, angle = lengths["c2"] / 7, 0.0731
        found = six.rates_config(p, **lengths, radius=radius, angle=angle)
        k = mpmath.hypot(lengths["a2"], lengths["c3"])
        for name, value in (("radius", radius * 2 ** p["F"]), ("elbow", k * mpmath.sin(angle) * 2 ** p["F"]),
                            ("sine", mpmath.sin(angle) * 2 ** p["U"])):
            assert abs(found.pop(f"cfg_{name}") - value) <= 0.5
    assert found.keys() == {f"cfg_{name}" for name in lengths}
    assert all(abs(found[f"cfg_{name}"] - value * 2 ** (p["F"] + 4)) <= 0.5 for name, value in lengths.items())


@oracle("six.ik6", "six.ik6_all", "six.ik6_to_angles", "keep.six_keep",
        cfg=("a1", "b", "c1", "c2", "c4", "k", "cp", "np", "r", "e", "margin", "slack"))
def test_words_of_six_axes(core):
    """Lengths in 2^-4 LSB, k = sqrt(a2^2 + c3^2) in the direction psi = atan2(a2, c3); r e = 1 / 2 c2 k, never more;
    margin and slack in LSB.
    """
    p, rng = core.params, random.Random(3)
    reach = 2 ** (p["W"] - 1 - p["F"])
    for _ in range(100):
        a1, a2, b, c1, c2, c3, c4 = (rng.uniform(-1, 1) * reach / 4 for _ in range(7))
        c2, c3 = abs(c2) + reach / 50, abs(c3) + reach / 50
        edges = {name: p.get("MARGINS", 1) * rng.uniform(0, 1) * reach / 4 for name in ("margin", "slack")}
        found = six.config(p, a1=a1, a2=a2, b=b, c1=c1, c2=c2, c3=c3, c4=c4, **edges)
        assert all(abs(found[f"cfg_{name}"] - value * 2 ** p["F"]) <= 0.5 for name, value in edges.items())
        k, psi = mpmath.hypot(a2, c3), mpmath.atan2(a2, c3)
        for name, value in (("a1", a1), ("b", b), ("c1", c1), ("c2", c2), ("c4", c4), ("k", k)):
            assert abs(found[f"cfg_{name}"] - value * 2 ** (p["F"] + 4)) <= 0.5
        assert abs(found["cfg_cp"] - mpmath.cos(psi) * 2**25) <= 0.51
        assert abs(found["cfg_np"] - mpmath.sin(psi) * 2**25) <= 0.51
        unit = 2 ** (p["W"] + 4)  # 1.0 of a length in words
        exact = Fraction(unit**2, 2 * found["cfg_c2"] * found["cfg_k"])
        product = Fraction(found["cfg_r"] * found["cfg_e"], 2**25)
        assert 0 <= exact - product < Fraction(found["cfg_e"], 2**25)
        assert found["cfg_e"] & found["cfg_e"] - 1 == 0 and 2**24 <= found["cfg_r"] < 2**25


def test_a_damping_beyond_its_word_is_refused():
    for damping in (-0.1, 2**-9 - 1e-6, 0.411):
        with pytest.raises(ValueError, match="damping is 0, or from"):
            newton_fixed.config({"W": 16}, cfg_l1=9, cfg_l2=9, damping=damping)
