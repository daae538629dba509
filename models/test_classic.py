"""The CORDIC kinematics against float64, within derived bounds. No simulator."""

from __future__ import annotations

import math

import numpy as np
import pytest
from quadrance import classic, cordic
from quadrance.test_cordic import angle_bound

P = {"W": 16, "F": 8, "A": 16}


@pytest.mark.parametrize("length", [0, 1, 77, 1000, 8191, 16384, 32767, 65532])
def test_fk1_at_every_angle(length):
    """At most 1 LSB a coordinate and at the tip up to 64 units, 1.6 at any length."""
    words = np.arange(65536)
    theta = 2 * math.pi * words / 65536
    out = classic.fk1(P, in_j1=words, **classic.config(P, cfg_l1=length))
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
        tip = classic.fk1(P, in_j1=words, **classic.config(P, cfg_l1=length))
        back = classic.ik1(P, in_x=tip["out_x"], in_y=tip["out_y"])["out_j1"]
        off = np.abs((back - words + 32768) % 65536 - 32768)
        assert off.max() <= 1 + 1.2 * 65536 / (2 * math.pi) / length
