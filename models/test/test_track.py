"""The haptic circle: golden lags, bit-true engines beside float64, and the plant against its differential equation."""

from __future__ import annotations

import numpy as np
import pytest
from quadrance import cores
from quadrance.iterative import engines, track

ALL = track.followers()


def test_golden_lags_of_the_touch() -> None:
    for row, digit in zip(track.summary(ALL["touch"]), (0.1, 0.1, 0.01, 0.001)):
        assert abs(row["lag_um"] - row["golden_um"]) <= digit / 2
        assert abs(row["tip_um"] - row["servo_um"]) <= row["lag_um"] and row["words_um"] == 0


def test_the_settling_is_long_enough() -> None:
    """Twice the samples before the measurement change no lag by more than a fifth of a percent."""
    planar = ALL["planar"]
    trace = track.follow(planar, (1, 5), samples=2 * track.SETTLE + track.SHOWN)
    late = np.linalg.norm(trace.goal - planar.arm(trace.asked)[0], axis=-1)[-track.SHOWN:]
    lag = [row["lag_um"] for row in track.summary(planar, (1, 5))]
    assert np.sqrt((late**2).mean(axis=(0, 1))) * 1e6 == pytest.approx(lag, rel=0.002)


@pytest.mark.parametrize("core", [core for core in cores.all_cores() if core.name in engines.EXAMPLES],
                         ids=lambda core: core.id)
def test_an_engine_lags_as_float64_does(core: cores.Core) -> None:
    """Within what ends its descent: an LSB at 16 bits of coordinates and 24 of joints, of coarser words as much."""
    follower = track.engine(core)
    example = engines.EXAMPLES[core.name]
    exact = track.summary(ALL[{2: "planar", 3: "touch"}[len(example.origin)]], (1, 5))
    unit = example.lsb(core, 2) * 1e6
    for row, same in zip(track.summary(follower, (1, 5)), exact):
        assert abs(row["lag_um"] - same["lag_um"]) < 0.5 * unit + 0.5 * unit * (core.params["A"] < 24)
        # a coordinate that stands still has one rounding error for all samples
        assert row["words_um"] == pytest.approx(unit * np.sqrt(len(example.origin) / 12), rel=0.3)
        assert row["clocks"] == example.clocks * (row["iterations"] + 1)


def test_the_plant_is_its_equation() -> None:
    """A period against J w' + b w = u in a thousand small steps, three joints with their own gains."""
    rng = np.random.default_rng(1)
    theta, rate, integral, error, asked = rng.normal(size=(5, 3))
    lengths = (0.135, 0.135, 0.135)
    after = track.advance(track.Servo(theta, rate, integral), error, asked, lengths)
    kp, ki, kd = np.array([7, 5.5, 12.2]), np.array([0.07, 0.08, 0.06]), np.array([0.007, 0.008, 0.009])
    torque = kp * error + ki * (integral + error / 1000) + kd * (asked - rate)
    inertia, friction = 0.045 * 0.135**2, 0.26 / (0.035 * np.pi / 4) * 0.135**2
    for _ in range(1000):
        middle = rate + (torque - friction * rate) / inertia * 5e-7
        theta, rate = theta + middle * 1e-6, rate + (torque - friction * middle) / inertia * 1e-6
    assert np.abs(after.theta - theta).max() < 1e-9 and np.abs(after.rate - rate).max() < 1e-6
    assert np.array_equal(after.integral, integral + error / 1000)


def test_the_servo_holds_a_point() -> None:
    servo = track.Servo(*np.zeros((3, 2)))
    for _ in range(2000):
        servo = track.advance(servo, np.array([0.1, -0.2]) - servo.theta, np.zeros(2), (0.1, 0.1))
    assert np.abs(servo.theta - (0.1, -0.2)).max() < 1e-3 and np.abs(servo.rate).max() < 1e-3

