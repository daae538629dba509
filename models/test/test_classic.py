"""CORDIC and the kinematics on it against float64, within bounds derived from their quantisation. No simulator."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp, mpf
from quadrance import bounds, classic, cordic, truth
from quadrance.fixed import ints, wrap

# Rotation and vectoring; their constants against mpmath

W16 = {"W": 16, "A": 16}
LSB = 2 * math.pi / 65536  # of a 16-bit angle, in radians


def _turned(p, words, x, y):
    """True rotation of (x, y) by angle words."""
    theta = 2 * math.pi * words / 2 ** p["A"]
    return x * np.cos(theta) - y * np.sin(theta), x * np.sin(theta) + y * np.cos(theta)


def test_the_derived_bounds_are_the_promise_at_every_parameter():
    """The figures of the page, over all that the cores accept."""
    rotations = {(w, a): bounds.cordic.rotate({"W": w, "A": a}) for w in range(8, 17) for a in range(5, w + 4)}
    assert 1.54 < max(rotations.values()) <= 1.55 and rotations[16, 16] <= 1.48
    lengths = [bounds.cordic.magnitude({"W": w}) for w in range(8, 17)]
    assert 1.12 < max(lengths) <= 1.13 and lengths[-1] <= 0.98
    angles = [bounds.cordic.angle({"W": w, "A": a}, cordic.AIM_GUARD, True) for w in range(8, 17)
              for a in range(4, w + 1)]
    assert 0.83 < max(fixed for fixed, _ in angles) <= 0.84
    assert bounds.cordic.angle(W16, cordic.AIM_GUARD, True)[1] * LSB <= 0.24


def legal(low: int, above: int) -> list[dict[str, int]]:
    """Every W, with the least A, W and the most."""
    return [{"W": w, "A": a} for w in range(8, 17) for a in sorted({low, w, w + above})]


@pytest.mark.parametrize("p", [*legal(5, 3), {"W": 11, "A": 9}, {"W": 15, "A": 14}],
                         ids=lambda p: f"W{p['W']}A{p['A']}")
def test_rotation_over_the_whole_circle(p):
    """Every angle word, vectors of every length: within the law where the output is in range."""
    rng = np.random.default_rng(2)
    words = np.arange(1 << p["A"]) if p["A"] <= 16 else rng.integers(0, 1 << p["A"], 1 << 16)
    full = 1 << p["W"] - 1
    lengths = [full, full * 1.41, *(full * 1.41 * 2.0 ** -rng.uniform(0, p["W"], 12))]
    bound = bounds.cordic.rotate(p)
    worst = 0.0
    for length in lengths:
        phi = rng.uniform(0, 2 * math.pi)
        x, y = (int(np.clip(round(length * f(phi)), -full, full - 1)) for f in (math.cos, math.sin))
        out = cordic.rotate(p, in_angle=words, in_x=x, in_y=y)
        for word, true in zip((out["out_x"], out["out_y"]), _turned(p, words, x, y), strict=True):
            worst = max(worst, float(np.max(np.abs(word - np.clip(true, -full, full - 1)))))
    assert worst <= bound
    assert worst > 0.5  # the search finds more than the rounding: it can fail


def test_rotation_saturates_and_says_so():
    out = cordic.rotate(W16, in_angle=[8192, 40960, 0, 32768], in_x=[32767, 32767, -32768, -32768],
                        in_y=[32767, 32767, 0, 0])
    assert out["out_y"].tolist()[:2] == [32767, -32768]
    assert out["out_status"].tolist() == [4, 4, 0, 4]
    assert out["out_x"].tolist()[2:] == [-32768, 32767]


@given(st.integers(0, 65535), st.integers(-32768, 32767), st.integers(-32768, 32767))
def test_quarter_turns_are_exact_to_the_rounding(word, x, y):
    """A quarter turn more exchanges the outputs; only the one's complement's unit may differ."""
    one = cordic.rotate(W16, in_angle=[word], in_x=[x], in_y=[y])
    two = cordic.rotate(W16, in_angle=[(word + 16384) % 65536], in_x=[x], in_y=[y])
    if not (one["out_status"] | two["out_status"])[0]:
        assert abs(two["out_y"] - one["out_x"])[0] <= 1
        assert abs(two["out_x"] + one["out_y"])[0] <= 1


@pytest.mark.parametrize("p", [*legal(4, 0), {"W": 11, "A": 9}, {"W": 16, "A": 12}],
                         ids=lambda p: f"W{p['W']}A{p['A']}")
def test_vectoring(p):
    """Length and angle within their laws, every direction and length."""
    full = 1 << p["W"] - 1
    rng = np.random.default_rng(3)
    length, phi = full * 1.41 * 2.0 ** -rng.uniform(0, p["W"], 50_000), rng.uniform(0, 2 * math.pi, 50_000)
    x, y = (np.clip(np.round(length * f(phi)), -full, full - 1).astype(np.int64) for f in (np.cos, np.sin))
    x, y = x[(x != 0) | (y != 0)], y[(x != 0) | (y != 0)]
    out = cordic.vector(p, in_x=x, in_y=y)
    true = np.hypot(x, y)
    error = np.abs(out["out_magnitude"] - true)
    assert error.max() <= bounds.cordic.magnitude(p)
    assert error.max() > 0.5
    off = wrap(np.zeros(1), 1) + out["out_angle"] - np.arctan2(y, x) * 2 ** p["A"] / (2 * math.pi)
    off = np.abs((off + 2 ** (p["A"] - 1)) % 2 ** p["A"] - 2 ** (p["A"] - 1))
    fixed, slope = bounds.cordic.angle(p, cordic.AIM_GUARD, True)
    assert fixed < 1.0
    assert np.all(off <= fixed + slope / true)
    assert not out["out_status"].any()
    if p == W16:
        assert off[true > 9000].max() <= 1.0


def test_the_origin_is_singular_and_has_no_length():
    out = cordic.vector(W16, in_x=[0, 1, 0], in_y=[0, 0, -1])
    assert out["out_status"].tolist() == [2, 0, 0]
    assert out["out_magnitude"].tolist() == [0, 1, 1]


# Constants. `bounds.cordic.angle` adds up how far each is from its angle: a wrong one would widen its own bound


@pytest.fixture(autouse=True)
def digits():
    with mp.workdps(60):
        yield


def gain(first: int, last: int) -> mpf:
    """What micro-rotations `first` to `last` lengthen a vector by."""
    return mpmath.fprod(mpmath.sqrt(1 + mpf(4) ** -i) for i in range(first, last + 1))


@pytest.mark.parametrize("bits", [9, 12, 15, 20, 21, 22, 24])
def test_angles_of_the_micro_rotations(bits):
    """atan 2^-i as a turn, times 2^(i + bits), cut; from i = 9 on its limit, which is within 2^-2i / 3 of it."""
    for i in range(24):
        exact = mpmath.atan(mpf(2) ** -min(i, 9)) / (2 * mp.pi) * mpf(2) ** (min(i, 9) + bits)
        assert cordic.angle(i, bits) == int(mpmath.floor(exact)), i
    assert 1 - mpmath.atan(mpf(2) ** -9) * 2**9 < mpf(4) ** -9 / 3


def test_the_gain_of_the_rotations():
    assert abs(classic.SHRINK - 1 / gain(0, 200)) < mpf(2) ** -50
    assert abs(classic.GROWTH / mpf(2) ** 30 - gain(0, 200)) < mpf(2) ** -29


@pytest.mark.parametrize("width", [8, 11, 12, 14, 15, 16])
def test_the_gain_digits_of_a_rotation(width):
    """Of cordic_rotate: the product of its micro-rotations, 1 to C, undone, to half an LSB of the word."""
    digits = [(shift, minus) for shift, minus in cordic.GAIN_DIGITS if shift < 10 or shift <= width]
    found = sum((-1) ** minus * mpf(2) ** -shift for shift, minus in digits)
    assert abs(found * gain(1, cordic.sizes(width)[0]) - 1) < mpf(2) ** -width


def test_the_gain_of_a_length():
    """Of cordic_vector: nested shifts, 1.214509, twice what undoes the gain of vectoring."""
    value = mpf(1)
    for shift, minus in cordic.HORNER:
        value = 1 + (-1) ** minus * value * mpf(2) ** -shift
    assert abs(value * gain(0, 200) / 2 - 1) < mpf(2) ** -17


def test_the_gain_of_the_third_rotation():
    """Of classic_fk3: shifts whose product is twice SHRINK, to a 2^-18 for 16 bits and to a 2^-27 for 24."""
    for width, least in ((16, 18), (24, 27)):
        value = mpf(1)
        for shift, minus in classic.yaw_factors(width):
            value *= 1 + (-1) ** minus * mpf(2) ** -shift
        assert abs(value * gain(0, 200) / 2 - 1) < mpf(2) ** -least


@pytest.mark.parametrize("l1, l2", [(1, 1), (8192, 8192), (16000, 300), (65533, 65533)])
def test_start_words(l1, l2):
    words = classic.config({"W": 16}, cfg_l1=l1, cfg_l2=l2)
    shrink = 1 / gain(0, 200)
    assert words["cfg_c1"] == int(mpmath.floor(l1 * shrink * 2**4))
    assert words["cfg_s1"] == int(mpmath.floor(l1 * shrink * 2**5))
    assert words["cfg_s2"] == int(mpmath.floor(l2 * shrink * shrink * mpmath.sqrt(2) * 2**5))


# Kinematics

P = {"W": 16, "F": 8, "A": 16}


def test_the_law_of_fk1_is_the_promise_at_every_parameter():
    """The figures of the page, over all that the cores accept; fewer angles are some of these."""
    for length, promise, words in (
            (lambda w: 1 << w - 2, 1.6, [(w, w + 3) for w in range(8, 17)]),
            (lambda w: (1 << w) - 3, 2.01, [(w, w + 3) for w in range(8, 17)]),
            (lambda w: 1 << w - 2, 1.89, LONG), (lambda w: (1 << w) - 3, 2.31, LONG)):
        laws = [bounds.classic.fk1({"W": w, "A": a}, length(w)) for w, a in words]
        assert promise - 0.03 < max(laws) <= promise


LONG = [(17, 20), (18, 21), (19, 19), (20, 20), (21, 21), (22, 20), (23, 20), (24, 24)]  # W above 16, A


@pytest.mark.parametrize("w", range(8, 25))
def test_fk1_at_every_width(w):
    """The tip and each coordinate within the law, angles of W and of W + 3 bits, links about both ends of its range."""
    half = 1 << w - 1
    for a in (w, w + 3) if w < 17 else (dict(LONG)[w],):
        p = {"W": w, "F": 0, "A": a}
        words = np.arange(1 << a)[::max(1 << a - 14, 1) if a > 14 else 1]
        for length in ((1 << w - 2) - 9, 1 << w - 2, (1 << w) - 12, (1 << w) - 3):
            out = classic.fk1(p, in_j1=words, cfg_c1=classic.config(p, cfg_l1=length)["cfg_c1"])
            tip = length * np.exp(2j * math.pi * words / (1 << a))
            off = np.maximum(np.abs(out["out_x"] - np.clip(tip.real, -half, half - 1)),
                             np.abs(out["out_y"] - np.clip(tip.imag, -half, half - 1)))
            inside = np.maximum(np.abs(tip.real), np.abs(tip.imag)) < half - 1
            apart = np.abs(out["out_x"] + 1j * out["out_y"] - tip)[inside].max(initial=0)
            assert 0.5 < max(off.max(), apart) <= bounds.classic.fk1(p, length)


@pytest.mark.parametrize("length", [0, 1, 77, 1000, 8191, 16384, 32767, 65532])
def test_fk1_at_every_angle(length):
    """Tip and coordinates within the law."""
    words = np.arange(65536)
    theta = 2 * math.pi * words / 65536
    out = classic.fk1(P, in_j1=words, cfg_c1=classic.config(P, cfg_l1=length)["cfg_c1"])
    x, y = length * np.cos(theta), length * np.sin(theta)
    clip = lambda v: np.clip(v, -32768, 32767)  # noqa: E731
    error = np.maximum(np.abs(out["out_x"] - clip(x)), np.abs(out["out_y"] - clip(y)))
    assert error.max() <= bounds.classic.fk1(P, length)
    assert (length == 0) or error.max() > 0.5
    inside = (np.abs(x) < 32767) & (np.abs(y) < 32767)
    assert np.hypot(out["out_x"] - x, out["out_y"] - y)[inside].max(initial=0) <= bounds.classic.fk1(P, length)
    beyond = np.max([x - 32767.5, y - 32767.5, -32768.5 - x, -32768.5 - y], axis=0)  # of the last word's cell
    told = np.abs(beyond) > bounds.classic.fk1(P, length) - 0.5
    assert np.array_equal(out["out_status"][told], np.where(beyond > 0, cordic.OVERFLOW, 0)[told])


def test_fk1_start_vector_stays_in_its_word():
    assert classic.config(P, cfg_l1=65535)["cfg_c1"] < 1 << 20
    assert classic.config(P, cfg_l1=0)["cfg_c1"] == 0


CHAINS = [(P, 8192, 8192), (P, 16384, 0), (P, 0, 16384), (P, 10000, 6384), (P, 65535, 65535), (P, 300, 100),
          ({"W": 12, "F": 4, "A": 10}, 700, 324), ({"W": 16, "F": 8, "A": 19}, 9000, 7000),
          ({"W": 17, "F": 9, "A": 20}, 16384, 16384), ({"W": 18, "F": 10, "A": 5}, 65000, 20),
          ({"W": 19, "F": 11, "A": 19}, 65536, 65536), ({"W": 20, "F": 12, "A": 20}, 1 << 17, 1 << 17),
          ({"W": 21, "F": 13, "A": 21}, 300000, 220000), ({"W": 22, "F": 14, "A": 22}, 3 << 20, 1 << 20),
          ({"W": 23, "F": 15, "A": 20}, 1 << 20, 1 << 20), ({"W": 24, "F": 16, "A": 24}, 1 << 21, 1 << 21),
          ({"W": 24, "F": 16, "A": 24}, (1 << 24) - 1, (1 << 24) - 1)]


@pytest.mark.parametrize(("p", "l1", "l2"), CHAINS)
def test_fk2_and_fk3(p, l1, l2):
    """Within the derived bound; saturated and flagged where the tip leaves the word."""
    rng = np.random.default_rng(5)
    words = rng.integers(0, 1 << p["A"], (3, 200_000))
    eighths = rng.integers(0, 8, (3, 4096)) << p["A"] - 3
    words[:, :4096] = eighths + rng.integers(-1, 2, (3, 4096)) & (1 << p["A"]) - 1
    cfg = {name: classic.config(p, cfg_l1=l1, cfg_l2=l2)[name] for name in ("cfg_s1", "cfg_s2")}
    l1, l2 = (min(length, (1 << p["W"]) - 3) for length in (l1, l2))
    t1, t2, t3 = 2 * math.pi * words / 2 ** p["A"]
    rho, z = l1 * np.cos(t1) + l2 * np.cos(t1 + t2), l1 * np.sin(t1) + l2 * np.sin(t1 + t2)
    full = 1 << p["W"] - 1
    two = classic.fk2(p, in_j1=words[0], in_j2=words[1], **cfg)
    three = classic.fk3(p, in_j1=words[0], in_j2=words[1], in_j3=words[2], **cfg)
    for joints, out, tip in ((2, two, (rho, z)), (3, three, (rho * np.cos(t3), rho * np.sin(t3), z))):
        bound = bounds.classic.chain(p, joints, l1, l2)
        answer = np.stack([out[f"out_{axis}"] for axis in "xyz"[:joints]])
        error = np.abs(answer - np.clip(tip, -full, full - 1))
        assert 0.5 < error.max() <= bound
        assert bound <= ((2.0, 2.9) if p["W"] <= 16 else (2.42, 3.49))[joints - 2] or l1 + l2 > full // 2
        assert bound <= ((3.6, 5.5) if p["W"] <= 16 else (4.2, 6.4))[joints - 2]
        beyond = np.max(np.maximum(np.array(tip) - (full - 0.5), -full - 0.5 - np.array(tip)), axis=0)
        told = np.abs(beyond) > bound - 0.5
        assert np.array_equal(out["out_status"][told], np.where(beyond > 0, cordic.OVERFLOW, 0)[told])


def test_ik1():
    """The angle within the derived law: for short targets a quarter of an LSB at the tip besides the word's own."""
    rng = np.random.default_rng(4)
    length, phi = 46000 * 2.0 ** -rng.uniform(0, 15, 400_000), rng.uniform(0, 2 * math.pi, 400_000)
    x, y = (np.clip(np.round(length * f(phi)), -32768, 32767).astype(np.int64) for f in (np.cos, np.sin))
    x, y = x[(x != 0) | (y != 0)], y[(x != 0) | (y != 0)]
    off = classic.ik1(P, in_x=x, in_y=y)["out_j1"] - np.arctan2(y, x) * 65536 / (2 * math.pi)
    off = np.abs((off + 32768) % 65536 - 32768)
    fixed, slope = bounds.cordic.angle(P, classic.AIM_GUARD, False)
    assert fixed < 1.0
    assert np.all(off <= fixed + slope / np.hypot(x, y))


def test_ik1_holds_the_last_angle_at_the_origin():
    out = classic.ik1(P, in_x=[0, 0, 0, -32000, 0], in_y=[0, 32000, 0, 0, 0])
    assert out["out_j1"].tolist() == [0, 16384, 16384, 32768, 32768]
    assert out["out_status"].tolist() == [2, 0, 2, 0, 2]


def test_ik1_undoes_fk1():
    """Every sixteenth angle at three lengths, within the half LSBs of both words."""
    words = np.arange(0, 65536, 16)
    for length in (32000, 10000, 500):
        tip = classic.fk1(P, in_j1=words, cfg_c1=classic.config(P, cfg_l1=length)["cfg_c1"])
        back = classic.ik1(P, in_x=tip["out_x"], in_y=tip["out_y"])["out_j1"]
        off = np.abs((back - words + 32768) % 65536 - 32768)
        assert off.max() <= 1 + 1.2 * 65536 / (2 * math.pi) / length


ARMS = [(P, 8192, 8192), (P, 10000, 6384), (P, 5000, 11384), (P, 14000, 2384), (P, 400, 500), (P, 20000, 18000),
        ({"W": 12, "F": 4, "A": 10}, 600, 424), ({"W": 16, "F": 8, "A": 12}, 9000, 7000), (P, 1, 16383), (P, 16383, 1),
        (P, 16000, 100), (P, 50, 40), (P, 1, 1), ({"W": 8, "F": 4, "A": 8}, 1, 60),
        ({"W": 16, "F": 8, "A": 20}, 9000, 7000), ({"W": 17, "F": 8, "A": 17}, 20000, 12000),
        ({"W": 18, "F": 10, "A": 21}, 65000, 60000), ({"W": 19, "F": 11, "A": 20}, 140000, 120000),
        ({"W": 21, "F": 13, "A": 23}, 524288, 524287), ({"W": 24, "F": 0, "A": 4}, 3000000, 5000000),
        ({"W": 20, "F": 12, "A": 20}, 150000, 112000), ({"W": 22, "F": 14, "A": 24}, 300000, 748000),
        ({"W": 23, "F": 15, "A": 22}, 1 << 20, 1 << 20), ({"W": 24, "F": 16, "A": 24}, 1 << 21, 1 << 21),
        ({"W": 24, "F": 16, "A": 24}, 6 << 20, 1 << 20)]


@pytest.mark.parametrize(("p", "l1", "l2"), ARMS)
def test_ik2_and_ik3(p, l1, l2):
    """The tip that the answer stands for, in float64: within the law, and 2 LSB for links of 64 units together.

    Targets everywhere in reach, crowded at both circles, and outside and in the hole, where it is the nearest point.
    """
    rng = np.random.default_rng(6)
    count, full = 30_000, 1 << p["W"] - 1
    near, far = abs(l1 - l2), l1 + l2
    crowd = (far - near) * 2.0 ** -rng.uniform(0, 14, count)
    r = np.concatenate([rng.uniform(near, far, count), near + crowd, far - crowd, rng.uniform(far, 2 * far, count // 8),
                        rng.uniform(near / 4, near, count // 8)])
    theta, tilt = rng.uniform(0, 2 * math.pi, r.size), rng.uniform(-math.pi / 2, math.pi / 2, r.size)
    elbow = rng.integers(0, 2, r.size)
    cfg = {name: classic.config(p, cfg_l1=l1, cfg_l2=l2)[name] for name in ("cfg_far", "cfg_near", "cfg_f")}
    turn = 2 * math.pi / 2 ** p["A"]
    for joints, flat in ((2, 1.0), (3, np.cos(tilt))):
        target = np.stack([r * flat * np.cos(theta), r * flat * np.sin(theta), r * np.sin(tilt)][:joints])
        target = np.clip(np.rint(target), -full, full - 1).astype(np.int64)
        target = target[:, (target[0] != 0) | (target[1] != 0)]
        bend = elbow[:target.shape[1]]
        solve = classic.ik2 if joints == 2 else classic.ik3
        out = solve(p, **{f"in_{axis}": word for axis, word in zip("xyz", target)}, in_elbow=bend, **cfg)
        angles = [out[f"out_j{i + 1}"] * turn for i in range(joints)]
        tip = np.stack((truth.fk2 if joints == 2 else truth.fk3)(*angles, l1, l2))
        length = np.linalg.norm(target, axis=0)
        error = np.linalg.norm(tip - target * (np.clip(length, near, far) / length), axis=0)
        law = bounds.classic.ik(p, joints, l1, l2, length)
        assert np.all(error <= law)
        if p["A"] >= p["W"] >= 16 and far <= full // 2 and max(l1, l2) < 4 * min(l1, l2):
            assert error[(length >= near) & (length <= far)].max() <= 2.0
        assert np.array_equal(out["out_status"] & 1, (length > far) | (length < near))
        signed = wrap(out["out_j2"], p["A"])
        aside = np.minimum(np.abs(signed), (1 << p["A"] - 1) - np.abs(signed))  # from straight and from folded
        assert np.all((signed < 0) == bend, where=aside > bounds.classic.elbow(p, joints, l1, l2))


def test_the_laws_grow_by_less_than_half_to_24_bits():
    """In LSB, from W = A = 16 on, links of equal length and together 2^(W-2)."""
    def laws(w: int) -> list[float]:
        p, half = {"W": w, "A": w}, 1 << w - 3
        return [bounds.classic.ik1(p, 2 * half), *(float(bounds.classic.ik(p, n, half, half, half)) for n in (2, 3))]

    for w in range(17, 25):
        assert np.all(np.array(laws(w)) < 1.2 * np.array(laws(16)))


def test_ik_at_the_singular_points():
    """The origin keeps j1, the yaw axis j3; links of no length answer all the same."""
    names = ("cfg_far", "cfg_near", "cfg_f")
    cfg = {name: classic.config(P, cfg_l1=8000, cfg_l2=8000)[name] for name in names}
    out = classic.ik2(P, in_x=[0, 5000, 0], in_y=[0, 5000, 0], in_elbow=0, **cfg)
    assert out["out_j1"].tolist() == [0, out["out_j1"][1], out["out_j1"][1]]
    assert out["out_status"].tolist() == [2, 0, 2]
    out = classic.ik3(P, in_x=[0, 5000, 0, 0], in_y=[0, 0, 0, 0], in_z=[0, 5000, 9000, 0], in_elbow=0, **cfg)
    assert out["out_status"].tolist() == [2, 0, 2, 2]
    assert out["out_j3"].tolist() == [0, *out["out_j3"][1:2].repeat(3).tolist()]
    assert out["out_j1"][3] == out["out_j1"][2] != out["out_j1"][1]
    for l1, l2 in ((0, 0), (0, 9000), (9000, 0)):
        cfg = {name: classic.config(P, cfg_l1=l1, cfg_l2=l2)[name] for name in names}
        x, y = ints([6000, -300, 20000]), ints([1000, -7000, 25000])
        out = classic.ik2(P, in_x=x, in_y=y, in_elbow=[0, 1, 0], **cfg)
        tip = np.stack(truth.fk2(*(out[f"out_j{i}"] * 2 * math.pi / 65536 for i in (1, 2)), l1, l2))
        assert np.allclose(tip, (l1 + l2) * np.stack([x, y]) / np.hypot(x, y), atol=4)
        assert np.all(out["out_status"] == 1)


def test_ik_undoes_fk():
    """Joints away from straight and folded come back, each elbow by its own."""
    rng = np.random.default_rng(7)
    words = classic.config(P, cfg_l1=10000, cfg_l2=6384)
    j1, j2, j3 = rng.integers(0, 65536, 20_000), rng.integers(3000, 29000, 20_000), rng.integers(0, 65536, 20_000)
    elbow = rng.integers(0, 2, j1.size)
    j2 = np.where(elbow, 65536 - j2, j2)
    tip = classic.fk3(P, in_j1=j1, in_j2=j2, in_j3=j3, **{name: words[name] for name in ("cfg_s1", "cfg_s2")})
    front = np.cos(j1 * 2 * math.pi / 65536) * 10000 + np.cos((j1 + j2) * 2 * math.pi / 65536) * 6384 > 300
    back = classic.ik3(P, **{f"in_{axis}": tip[f"out_{axis}"] for axis in "xyz"}, in_elbow=elbow,
                       **{name: words[name] for name in ("cfg_far", "cfg_near", "cfg_f")})
    for name, true, most in (("out_j1", j1, 20), ("out_j2", j2, 20), ("out_j3", j3, 60)):
        assert np.abs(wrap(back[name] - true, 16))[front].max() <= most
