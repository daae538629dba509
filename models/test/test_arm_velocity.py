"""Models of the velocity cores of rtl/arm against complex arithmetic in float64, near and at the singular poses too."""

from __future__ import annotations

import numpy as np
import pytest
from quadrance.bounds import arm as limits
from quadrance.cores import all_cores

LINKS = [(0.5, 0.42), (0.3, 0.6), (0.9, 0.05)]  # of the coordinate's range, halved
SETS = {core.id: core for core in all_cores() if core.family == "arm" and core.function[:-1] in ("velocity", "rates")}
CASES = [pytest.param(core, *links, id=f"{name}-{links[0]}") for name, core in SETS.items() for links in LINKS]


def _case(core, share1: float, share2: float, count: int = 40_000):
    """Joint words with their complex vectors, rates with their words, and the lengths, LSB."""
    p, joints, rng = core.params, int(core.function[-1]), np.random.default_rng(4)
    one, half = 1 << p["U"], 1 << p["W"] - 2
    theta = rng.uniform(-np.pi, np.pi, (joints, count))
    words = {f"in_{letter}{i}": np.rint(part * one).astype(np.int64) for i, angle in enumerate(theta, 1)
             for letter, part in (("c", np.cos(angle)), ("n", np.sin(angle)))}
    vectors = [(words[f"in_c{i}"] + 1j * words[f"in_n{i}"]) / one for i in range(1, joints + 1)]
    return p, words, vectors, int(share1 * half), int(share2 * half), rng


def _exact(vectors, rates, l1: int, l2: int) -> tuple[np.ndarray, np.ndarray]:
    """Velocity (axes, N) and rho."""
    upper, fore = l1 * vectors[0], l2 * vectors[0] * vectors[1]
    plane = 1j * (rates[0] * (upper + fore) + rates[1] * fore)
    if len(vectors) == 2:
        return np.stack([plane.real, plane.imag]), (upper + fore).real
    flat = (plane.real + 1j * rates[2] * (upper + fore).real) * vectors[2]
    return np.stack([flat.real, flat.imag, plane.imag]), (upper + fore).real


def _axes(out: dict[str, np.ndarray], count: int) -> np.ndarray:
    return np.stack([out[f"out_{axis}"] for axis in "xyz"[:count]])


@pytest.mark.parametrize(("core", "share1", "share2"), [one for one in CASES if "velocity" in one.id])
def test_velocity_of_the_tip(core, share1, share2):
    p, words, vectors, l1, l2, rng = _case(core, share1, share2)
    joints, half = len(vectors), 1 << p["W"] - 1
    rates = rng.integers(-half, half, (joints, words["in_c1"].size)) >> rng.integers(0, p["W"], words["in_c1"].size)
    out = core.model(p, **words, **{f"in_w{i}": word for i, word in enumerate(rates, 1)}, cfg_l1=l1, cfg_l2=l2)
    real = rates / 2.0 ** p["V"]
    exact, _ = _exact(vectors, real, l1, l2)
    held = np.all(np.abs(exact) < half - 4, axis=0)
    assert held.sum() > 5000 and not out["out_status"][held].any()
    limit = limits.velocity2(*real) if joints == 2 else limits.velocity3(*real)
    limit = limit + np.abs(exact).max(axis=0) * 1e-9
    assert np.all(np.abs(_axes(out, joints) - exact)[:, held] <= limit[held])
    over = np.any(np.abs(exact) > half + 4, axis=0)
    assert over.any() and np.all(out["out_status"][over] == 4)


def _thresholds(core, l1: int, l2: int) -> dict[str, int]:
    found = {"cfg_l1": l1, "cfg_l2": l2, "cfg_sine": (1 << core.params["U"]) // 16}
    return found | ({"cfg_radius": (l1 + l2) // 16} if core.function == "rates3" else {})


@pytest.mark.parametrize(("core", "share1", "share2"), [one for one in CASES if "rates" in one.id])
def test_rates_give_the_velocity_asked_for(core, share1, share2):
    p, words, vectors, l1, l2, rng = _case(core, share1, share2)
    joints, cfg, count = len(vectors), _thresholds(core, l1, l2), words["in_c1"].size
    speed = (1 << p["W"] - 1) // 40
    asked = rng.integers(-speed, speed, (joints, count))
    out = core.model(p, **words, **{f"in_{axis}": word for axis, word in zip("xyz", asked)}, **cfg)
    rates = np.stack([out[f"out_w{i}"] for i in range(1, joints + 1)]) / 2.0 ** p["V"]
    got, rho = _exact(vectors, rates, l1, l2)
    near = np.abs(words["in_n2"]) < cfg["cfg_sine"]
    if joints == 3:
        band = np.abs(np.abs(rho) - cfg["cfg_radius"]) < 2
        near = near | (np.abs(rho) < cfg["cfg_radius"])
        assert np.array_equal((out["out_status"] & 2 > 0)[~band], near[~band])
    else:
        assert np.array_equal(out["out_status"] & 2 > 0, near)
    regular = out["out_status"] == 0
    assert regular.sum() > 5000
    error, size = np.linalg.norm(got - asked, axis=0), np.linalg.norm(asked, axis=0)
    s = rates[0] + rates[1]
    limit = limits.rates2(p, l1, l2, s, size) if joints == 2 else limits.rates3(p, l1, l2, s, rates[2], rho, size)
    assert np.all(error[regular] <= limit[regular])


def test_a_straight_arm_gives_what_it_can_and_bounded_rates():
    """n2 = 0: the velocity across the arm comes out, that along it does not; the rates are those of the threshold."""
    core = SETS["arm_rates2-U16"]
    one, l1, l2 = 65536, 8000, 7000
    angle = np.linspace(-3, 3, 601)
    words = {"in_c1": np.rint(np.cos(angle) * one).astype(int), "in_n1": np.rint(np.sin(angle) * one).astype(int),
             "in_c2": np.full(601, one), "in_n2": np.zeros(601, int)}
    out = core.model(core.params, **words, in_x=np.full(601, 300), in_y=np.full(601, -120), cfg_l1=l1, cfg_l2=l2,
                     cfg_sine=2048)
    assert np.all(out["out_status"] == 2)
    rates = np.stack([out["out_w1"], out["out_w2"]]) / 4096
    v1 = (words["in_c1"] + 1j * words["in_n1"]) / one
    got, _ = _exact([v1, np.ones(601)], rates, l1, l2)
    across = 1j * v1 * np.real((300 - 120j) * np.conj(1j * v1))  # the nearest velocity that the arm can give
    assert np.max(np.abs(got[0] + 1j * got[1] - across)) < limits.rates2(core.params, l1, l2, 2.0, 323)
    assert np.max(np.abs(rates[0] + rates[1])) <= 324 / (l2 * 2048 / one) + 0.001


def test_no_determinant_at_all_stands_still_and_says_so():
    core = SETS["arm_rates3-U16"]
    words = {"in_c1": 65536, "in_n1": 0, "in_c2": np.array([-65536, -65536, 50000]), "in_n2": np.array([0, 0, 40000]),
             "in_c3": 65536, "in_n3": 0,
             "in_x": 500, "in_y": np.array([400, -400, 400]), "in_z": 300}
    out = core.model(core.params, **words, cfg_l1=5000, cfg_l2=5000, cfg_sine=0, cfg_radius=0)
    assert np.array_equal(out["out_status"] & 2, [2, 2, 0])
    assert np.array_equal(out["out_w3"][:2], [0, 0])
    still = core.model(core.params, **words, cfg_l1=0, cfg_l2=0, cfg_sine=0, cfg_radius=0)
    assert all(np.all(still[f"out_w{i}"] == 0) for i in (1, 2, 3)) and np.all(still["out_status"] == 2)
