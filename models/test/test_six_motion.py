"""Velocities of six axes: the bit-true models against numerical Jacobians of a chain of frames, flags and factors."""

from __future__ import annotations

import numpy as np
import pytest
from quadrance import six, truth_six
from quadrance.bounds import six as bounds
from quadrance.cores import all_cores, find
from quadrance.truth_six import Six

from models.test import frames

TIP = "vx", "vy", "vz", "wx", "wy", "wz"
FORWARD, INVERSE = ([core for core in all_cores() if core.name == name and not core.params["PIPE"]]
                    for name in ("vector_velocity6", "vector_rates6"))
ROBOTS = pytest.mark.parametrize("robot", truth_six.known())


def cores(choice):
    return pytest.mark.parametrize("core", choice, ids=lambda core: core.id)


class Motion:
    """Joints anywhere of a robot as large as the word, as words; the chain's Jacobian at the directions of these."""

    def __init__(self, p: dict, robot: str, count: int, seed: int) -> None:
        arm, mm = truth_six.load(robot)
        self.p, self.rng = p, np.random.default_rng(seed)
        share = 2.0 ** (p["W"] - 1 - p["F"]) / 128 / mm
        self.unit = {name: length * share for name, length in arm._asdict().items()}
        self.arm = Six(**{name: length * 2.0 ** p["F"] for name, length in self.unit.items()})
        self.lengths = {name: length for name, length in self.unit.items() if name != "c1"}
        self.scale = 2.0 ** np.repeat([p["F"], p["V"]], 3)  # LSB of a velocity and of a turn
        q = self.rng.uniform(-np.pi, np.pi, (count, 6))
        self.words = {f"in_{letter}{i + 1}": np.rint(part(q[:, i]) * 2.0 ** p["U"]).astype(np.int64)
                      for i in range(5) for letter, part in (("c", np.cos), ("n", np.sin))}
        self.q = np.stack([np.arctan2(self.words[f"in_n{i}"], self.words[f"in_c{i}"]) for i in range(1, 6)] + [q[:, 5]],
                          axis=-1)
        self.jacobian = frames.jacobian(lambda one: frames.wrist_arm(one, **self.unit), self.q)
        self.end = 2.0 ** (p["W"] - 1 - p["V"])  # of the rates

    def rates(self, share: float) -> np.ndarray:
        """Random rates up to a share of their word."""
        return self.rng.uniform(-share, share, self.q.shape) * self.end

    def tip(self, rates: np.ndarray) -> np.ndarray:
        """Words of velocity and turn for rates."""
        return np.rint((self.jacobian @ rates[..., None])[..., 0] * self.scale).astype(np.int64)

    def ask(self, core, tip: np.ndarray, thresholds: dict | None = None) -> dict:
        """What vector_rates6 answers; without thresholds by default."""
        return core.model(self.p, **self.words, **{f"in_{name}": tip[:, i] for i, name in enumerate(TIP)},
                          **six.motion_config(self.p, **self.lengths),
                          **(thresholds or dict.fromkeys(("cfg_radius", "cfg_elbow", "cfg_sine"), 0)))


@ROBOTS
@cores(FORWARD)
def test_velocity(core, robot):
    """Within its law of the Jacobian of the chain; saturated where that is beyond the word, and never unflagged."""
    p, one = core.params, Motion(core.params, robot, 2000, 1)
    rates = np.rint(one.rates(0.4) * 2.0 ** p["V"]).astype(np.int64)
    answer = core.model(p, **one.words, **{f"in_w{i + 1}": rates[:, i] for i in range(6)},
                        **six.motion_config(p, **one.lengths))
    exact = (one.jacobian @ (rates * 2.0 ** -p["V"])[..., None])[..., 0] * one.scale
    linear, turn = bounds.velocity(p, one.arm, rates * 2.0 ** -p["V"])
    law = np.stack([linear] * 3 + [turn] * 3, axis=-1)
    found, flag = np.stack([answer[f"out_{name}"] for name in TIP], axis=-1), answer["out_status"] == 4
    assert np.all(np.abs(found - exact)[~flag] <= law[~flag])
    assert np.all((np.abs(found - exact) / law)[~flag].max(axis=0) > 0.05) and 0.5 < (~flag).mean() < 0.999
    beyond = np.abs(exact + 0.5).max(axis=-1) - 2 ** (p["W"] - 1)
    assert np.all(flag[beyond > law.max(axis=-1)]) and not np.any(flag[beyond < -law.max(axis=-1)])


@ROBOTS
@cores(INVERSE)
def test_rates(core, robot):
    """Within their law of the chain's inverse Jacobian; never unflagged where that is beyond a rate's word."""
    p, one = core.params, Motion(core.params, robot, 2000, 2)
    tip = one.tip(one.rates(0.5) * 2.0 ** -one.rng.uniform(0, 6, (2000, 1)))
    tip[::3] = one.rng.integers(-2 ** (p["W"] - 2), 2 ** (p["W"] - 2), tip[::3].shape)  # any motion
    fits = np.all(np.abs(tip) < 2 ** (p["W"] - 1), axis=-1)
    answer = one.ask(core, np.where(fits[:, None], tip, 0))
    motion = np.where(fits[:, None], tip, 0) / one.scale
    exact = np.linalg.solve(one.jacobian, motion[..., None])[..., 0]
    found = np.stack([answer[f"out_w{i}"] for i in range(1, 7)], axis=-1) * 2.0 ** -p["V"]
    law = bounds.rates(p, one.arm, one.q, motion * 2.0 ** np.repeat([p["F"], 0], 3), exact)
    off, over = np.abs(found - exact) * 2.0 ** p["V"] / law, answer["out_status"] & 4 > 0
    assert np.all(off[fits & ~over] <= 1) and fits.mean() > 0.3
    assert np.all(off[fits & ~over].max(axis=0) > [0.3, 0.1, 0.1, 0.05, 0.05, 0.05])
    beyond = np.abs(exact).max(axis=-1) - law.max(axis=-1) * 2.0 ** -p["V"] > one.end
    assert np.all(over[beyond & fits]) and (beyond & fits).sum() > 20
    distances = {"d1": 2.0 ** p["F"], "d3": 2.0 ** p["F"], "d5": 2.0 ** p["U"]}
    d1, d3, d5 = (answer[f"out_{name}"] / lsb for name, lsb in distances.items())
    off = np.abs(np.abs(d1 * one.unit["c2"] * d3 * d5) - np.abs(np.linalg.det(one.jacobian)))
    size = sum(map(abs, one.unit.values()))
    assert off[np.abs(answer["out_d1"]) < 2 ** (p["W"] - 1) - 1].max() < 2 * size**2 * 2.0 ** -p["F"]


@ROBOTS
def test_rates_are_within_a_thousandth_of_the_largest(robot):
    """At U = 18, where |sin elbow sin q5| is 0.02 or more, 4 % of the range from axis 1, and rates fill their word."""
    core = find("vector_rates6")
    one = Motion(core.params | {"U": 18}, robot, 5000, 3)
    tip = one.tip(one.rates(0.4))
    exact = np.linalg.solve(one.jacobian, (tip / one.scale)[..., None])[..., 0]
    answer = one.ask(core, np.clip(tip, -32768, 32767))
    off = np.abs(np.stack([answer[f"out_w{i}"] for i in range(1, 7)], axis=-1) * 2.0**-12 - exact).max(axis=-1)
    largest = np.abs(exact).max(axis=-1)
    sines = np.abs(np.sin(one.q[:, 2] + one.arm.psi) * np.sin(one.q[:, 4]))
    regular = np.all(np.abs(tip) < 32768, axis=-1) & (answer["out_status"] == 0) & (sines >= 0.02)
    regular &= (np.abs(answer["out_d1"]) > 1310) & (largest > one.end / 8)
    assert regular.sum() > 1500
    share = (off - 2.0**-13)[regular] / largest[regular]
    assert 2e-4 < share.max() <= 1e-3


@cores(INVERSE)
def test_singular_is_a_factor_within_its_threshold(core):
    """Each alone decides; without thresholds nothing is singular but a factor of 0, whose rate is 0."""
    p, one = core.params, Motion(core.params, "kr6_r700", 1500, 4)
    tip = one.tip(one.rates(0.02))
    words = six.rates_config(p, **one.lengths, radius=one.unit["c2"] / 4, angle=0.2)
    factors = {"cfg_radius": "out_d1", "cfg_elbow": "out_d3", "cfg_sine": "out_d5"}
    zero = dict.fromkeys(factors, 0)
    assert not one.ask(core, tip)["out_status"].any()
    for name, factor in factors.items():
        answer = one.ask(core, tip, zero | {name: words[name]})
        off = np.abs(answer[factor]) - words[name]
        flag = answer["out_status"] & 2 > 0
        assert np.all(flag[off < -1]) and not np.any(flag[off > 1]) and 0.02 < flag.mean() < 0.6
    one.words |= {"in_c5": one.words["in_c5"] * 0 + 2 ** p["U"], "in_n5": one.words["in_n5"] * 0}
    answer = one.ask(core, tip)
    assert np.all(answer["out_status"] & 2) and np.all(answer["out_w6"] == 0) and np.mean(answer["out_w4"] != 0) > 0.9
