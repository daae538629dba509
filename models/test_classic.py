"""The CORDIC kinematics against float64, within derived bounds. No simulator."""

from __future__ import annotations

import math

import numpy as np
import pytest
from quadrance import classic, cordic
from quadrance.fixed import wrap
from quadrance.test_cordic import angle_bound

P = {"W": 16, "F": 8, "A": 16}


@pytest.mark.parametrize("length", [0, 1, 77, 1000, 8191, 16384, 32767, 65532])
def test_fk1_at_every_angle(length):
    """At most 1 LSB a coordinate and at the tip up to 64 units, 1.6 at any length."""
    words = np.arange(65536)
    theta = 2 * math.pi * words / 65536
    out = classic.fk1(P, in_j1=words, cfg_c1=classic.config(P, cfg_l1=length)["cfg_c1"])
    x, y = length * np.cos(theta), length * np.sin(theta)
    clip = lambda v: np.clip(v, -32768, 32767)  # noqa: E731
    error = np.maximum(np.abs(out["out_x"] - clip(x)), np.abs(out["out_y"] - clip(y)))
    assert error.max() <= (1.0 if length <= 16384 else 1.6)
    assert (length == 0) or error.max() > 0.5
    inside = (np.abs(x) < 32767) & (np.abs(y) < 32767)
    assert np.hypot(out["out_x"] - x, out["out_y"] - y)[inside].max(initial=0) <= (1.0 if length <= 16384 else 1.6)
    beyond = (np.abs(x) > 32769) | (np.abs(y) > 32769)
    assert np.all(out["out_status"][beyond] == cordic.OVERFLOW)
    assert not out["out_status"][inside & (np.abs(x) < 32766) & (np.abs(y) < 32766)].any()


def test_fk1_start_vector_stays_in_its_word():
    assert classic.config(P, cfg_l1=65535)["cfg_c1"] < 1 << 20
    assert classic.config(P, cfg_l1=0)["cfg_c1"] == 0


def _rotation(p: dict[str, int], factors: int = 0) -> tuple[np.ndarray, np.ndarray, float]:
    """Of `cordic.turn` from a start word, over every residual angle: relative error, mean and spread of the rounding.

    A start word, `factors` shifts of it, every micro-rotation and every digit leave x and y 0 to 1 unit low, times what
    still follows: the mean of that (complex, in units) and the most it may be off its mean in any direction.
    """
    rotations, digits = cordic.sizes(p["W"])
    bits, low = p["W"] + 4, max(rotations - 2, 0)
    words = np.arange(-1 << p["A"] - 3, 1 << p["A"] - 3)
    z = (words << p["W"] + 5 - p["A"]) + 2
    steps = []
    for i in range(1, rotations + 1):
        d, cut = np.where(z >= 0, 1, -1), max(i - 3, 0)
        steps.append(1 + 1j * d * 2.0**-i)
        z = wrap(z + ((cordic.angle(i, bits) >> cut ^ -(d > 0).astype(np.int64)) << cut) << 1, bits)
    tangent, rows = np.zeros(words.shape), np.zeros(words.shape)
    for k in range(digits):
        d = np.where(z >= 0, 1, -1)
        size = np.digitize((z ^ -(d < 0).astype(np.int64)) >> bits - 4, [1, 4])
        tangent, rows = tangent + d * size * 2.0 ** -(rotations + 1 + 2 * k), rows + (size > 0)
        term = cordic.angle(9, bits) << (size == 2) >> low ^ -(d > 0).astype(np.int64)
        z = wrap(z + np.where(size > 0, term << low, 0) << 2, bits)
    rest = np.stack([*np.cumprod(steps[::-1], axis=0)[::-1], np.ones(words.shape)]) * (1 + 1j * tangent)
    sources = rest[[0] * (1 + factors) + list(range(1, rotations + 1))]
    mean = -0.5 * (1 + 1j) * (sources.sum(axis=0) + rows)
    spread = math.sqrt(0.5) * float(np.max(np.abs(sources).sum(axis=0) + rows))
    true = np.exp(2j * math.pi * words / 2 ** p["A"]) / (math.sqrt(2) * classic.SHRINK)
    return np.abs(rest[0] / true - 1).max(), mean, spread


def chain_bound(p: dict[str, int], joints: int, l1: int, l2: int) -> float:
    """Derived error of a coordinate of classic.fk2 or fk3 in LSB.

    A half for rounding; the relative errors of the rotations a link goes through; the roundings of all of them, those
    of the first turned by the second, off the mean that the constants take out; a unit for each start word.
    """
    unit, gain = 2.0**-classic.CHAIN_GUARD, 1.1645
    off, mean, spread = _rotation(p)
    centre = mean.mean()
    turned = centre * gain * np.exp(2j * math.pi * np.linspace(-1, 1, mean.size) / 8) + mean
    drift = np.abs(turned + classic.CHAIN_ROUND[0] * (1 + 1j))
    drift = max(np.abs(drift.real).max(), np.abs(drift.imag).max()) + gain * np.abs(mean - centre).max()
    plane = off * (l1 + 2 * l2) + unit * (gain * spread + spread + drift + 4)
    if joints == 2:
        return plane + 0.5
    off, mean, spread = _rotation(p, len(classic.YAW_FACTORS) + 1)
    flat = np.abs(mean + classic.CHAIN_ROUND[1] * (1 + 1j))
    return plane + off * (l1 + l2) + unit * (spread + flat.max()) + 0.5


CHAINS = [(P, 8192, 8192), (P, 16384, 0), (P, 0, 16384), (P, 10000, 6384), (P, 65535, 65535), (P, 300, 100),
          ({"W": 12, "F": 4, "A": 10}, 700, 324), ({"W": 16, "F": 8, "A": 19}, 9000, 7000)]


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
        bound = chain_bound(p, joints, l1, l2)
        answer = np.stack([out[f"out_{axis}"] for axis in "xyz"[:joints]])
        error = np.abs(answer - np.clip(tip, -full, full - 1))
        assert 0.5 < error.max() <= bound
        assert bound <= (2.0 if joints == 2 else 2.8) or l1 + l2 > full // 2
        beyond = (np.abs(tip) > full + 2).any(axis=0)
        assert np.all(out["out_status"][beyond] == cordic.OVERFLOW)
        assert not out["out_status"][(np.abs(tip) < full - 3).all(axis=0)].any()


def test_ik1():
    """The angle within the derived law: for short targets a quarter of an LSB at the tip besides the word's own."""
    rng = np.random.default_rng(4)
    length, phi = 46000 * 2.0 ** -rng.uniform(0, 15, 400_000), rng.uniform(0, 2 * math.pi, 400_000)
    x, y = (np.clip(np.round(length * f(phi)), -32768, 32767).astype(np.int64) for f in (np.cos, np.sin))
    x, y = x[(x != 0) | (y != 0)], y[(x != 0) | (y != 0)]
    off = classic.ik1(P, in_x=x, in_y=y)["out_j1"] - np.arctan2(y, x) * 65536 / (2 * math.pi)
    off = np.abs((off + 32768) % 65536 - 32768)
    fixed, slope = angle_bound(P, classic.AIM_GUARD, False)
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
