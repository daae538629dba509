"""Inverse after forward and forward after inverse, along paths and past singular points, in all three families.

The models are the cores bit by bit (tb/ shows it), so what holds here holds for the Verilog. No bound is measured: a
core's own is its page's, and the rest is what half an LSB of a word moves the tip.
"""

from __future__ import annotations

import numpy as np
import pytest
from claims import CLAIMS
from quadrance import accuracy, bounds, codecs, truth
from quadrance.cores import Core, all_cores, joints

UNREACHABLE, SINGULAR = 1, 2
ARMS = [(32.5, 27.5), (20.0, 20.0), (15.0, 30.0)]  # units: L1 > L2, L1 = L2, L1 < L2


def pairs() -> list[tuple[Core, Core]]:
    """(forward, inverse) cores of two and three joints, Q7.8, of one family and one length of joint words."""
    cores = [core for core in all_cores() if (core.params.get("W"), core.params.get("F")) == (16, 8)]
    found: dict[tuple, tuple[Core, Core]] = {}
    for forward in cores:
        for inverse in cores:
            if (forward.function, inverse.function) in (("fk2", "ik2"), ("fk3", "ik3")) \
                    and forward.family == inverse.family and forward.inputs[0].width == inverse.outputs[0].width:
                found.setdefault((forward.model_name, forward.inputs[0].width), (forward, inverse))
    return list(found.values())


PAIRS = pytest.mark.parametrize("forward, inverse", pairs(), ids=lambda core: core.id)
LINKS = pytest.mark.parametrize("l1, l2", ARMS)


def run(core: Core, l1: float, l2: float, **inputs: np.ndarray) -> dict[str, np.ndarray]:
    """The core's model at link lengths in units."""
    words = accuracy.configure(core, cfg_l1=round(256 * l1), cfg_l2=round(256 * l2))
    return core.model(core.params, **inputs, **words)


def angles(core: Core, words: dict[str, np.ndarray]) -> list[np.ndarray]:
    """Joint angles of an inverse core's answer."""
    return [codecs.decode(joint, words) for joint in joints(core.outputs)]


def tip_of(theta: list[np.ndarray], l1: float, l2: float) -> np.ndarray:
    """Tip (N, 2 or 3) of two or three joints in LSB."""
    return np.stack((truth.fk2 if len(theta) == 2 else truth.fk3)(*theta, 256 * l1, 256 * l2), axis=-1)


def half_word(core: Core, words: dict[str, np.ndarray], l1: float, l2: float) -> np.ndarray:
    """How far half an LSB of every joint word moves the tip at most, LSB."""
    theta = angles(core, words)
    home, moved = tip_of(theta, l1, l2), 0.0
    for i, joint in enumerate(joints(core.outputs)):
        cells = [codecs.within_cell(joint, words, theta[i] + side * 4 * codecs.half_step(joint)) for side in (-1, 1)]
        steps = [tip_of([*theta[:i], end, *theta[i + 1:]], l1, l2) for end in cells]
        moved = moved + np.max([np.linalg.norm(step - home, axis=-1) for step in steps], axis=0)
    return moved


def targets(joints: int, l1: float, l2: float, inset: float, count: int = 20_000) -> tuple[np.ndarray, np.ndarray]:
    """Words (N, axes) all over the annulus but `inset` units at its rims, a third near the axes; and the elbow."""
    rng = np.random.default_rng(7)
    radius = rng.uniform(abs(l1 - l2) + inset, l1 + l2 - inset, count)
    turn = rng.uniform(-np.pi, np.pi, (2, count))
    near = rng.integers(0, 4, (2, count)) * np.pi / 2 + rng.normal(size=(2, count)) * 2.0 ** -rng.integers(2, 16, count)
    turn = np.where(rng.random((2, count)) < 1 / 3, near, turn)
    c, n = truth.unit(turn)
    tip = [c[0], n[0]] if joints == 2 else [c[0] * c[1], c[0] * n[1], n[0]]
    return np.rint(256 * radius * np.stack(tip)).T.astype(np.int64), rng.integers(0, 2, count)


def fed(forward: Core, words: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """An inverse core's answer as inputs of a forward one."""
    return {port.name: words[port.name.replace("in_", "out_")] for port in forward.inputs}


def solve(inverse: Core, tip: np.ndarray, elbow: np.ndarray, l1: float, l2: float) -> dict[str, np.ndarray]:
    return run(inverse, l1, l2, **{f"in_{axis}": tip[:, i] for i, axis in enumerate("xyz"[:tip.shape[1]])},
               in_elbow=elbow)


@LINKS
@PAIRS
def test_forward_of_inverse_is_the_target(forward: Core, inverse: Core, l1: float, l2: float) -> None:
    joints = accuracy.JOINTS[forward.function]
    there, back = (bounds.tip(core, 256 * l1, 256 * l2) for core in (forward, inverse))
    tip, elbow = targets(joints, l1, l2, inset=1.0)
    words = solve(inverse, tip, elbow, l1, l2)
    assert not np.any(words["out_status"] & (UNREACHABLE | 4))
    answer = run(forward, l1, l2, **fed(forward, words))
    error = np.linalg.norm(np.stack([answer[f"out_{axis}"] for axis in "xyz"[:tip.shape[1]]], axis=-1) - tip, axis=-1)
    defined = words["out_status"] == 0
    assert np.mean(defined) > 0.8
    assert np.all((error <= there + back + half_word(inverse, words, l1, l2))[defined])
    turned = np.sin(angles(inverse, words)[1])
    limit = 0.6 if inverse.params.get("S") == 8 else 0.2  # sin theta2 that no error of a word can turn round
    clear = np.abs(turned) > limit
    assert np.mean(clear) > 0.3 and np.all((turned < 0)[clear] == (elbow == 1)[clear])


@LINKS
@PAIRS
def test_inverse_of_forward_is_the_joints_up_to_the_elbow(forward: Core, inverse: Core, l1: float, l2: float) -> None:
    joints = accuracy.JOINTS[forward.function]
    there, back = (bounds.tip(core, 256 * l1, 256 * l2) for core in (forward, inverse))
    tip, elbow = targets(joints, l1, l2, inset=2.0, count=5000)
    words = solve(inverse, tip, elbow, l1, l2)  # joint words that reach all over the annulus
    asked = angles(inverse, words)
    answer = run(forward, l1, l2, **fed(forward, words))
    again = solve(inverse, np.stack([answer[f"out_{axis}"] for axis in "xyz"[:tip.shape[1]]], axis=-1), elbow, l1, l2)
    defined = (words["out_status"] | again["out_status"]) == 0
    assert np.mean(defined) > 0.8
    moved = np.linalg.norm(tip_of(angles(inverse, again), l1, l2) - tip_of(asked, l1, l2), axis=-1)
    assert np.all((moved <= there + back + half_word(inverse, again, l1, l2))[defined])


@PAIRS
def test_paths_through_every_border_and_past_the_singular_points(forward: Core, inverse: Core) -> None:
    """Steps of one LSB through all quadrants of the target, the stretched and the folded arm, and the base axis."""
    l1, l2 = 20.0, 20.0
    joints = accuracy.JOINTS[forward.function]
    back = bounds.tip(inverse, 256 * l1, 256 * l2)
    step = np.arange(-42 * 256, 42 * 256 + 1)
    circle = 256 * 25 * np.stack(truth.unit(np.linspace(0, 2 * np.pi, 40_000)))
    paths = [np.stack([step, 0 * step]), np.stack([0 * step, step]), np.stack([step, 0 * step + 3]), circle]
    for path in paths:
        plane = np.rint(path).astype(np.int64).T
        tip = plane if joints == 2 else np.stack([plane[:, 0], 0 * plane[:, 0] + 5, plane[:, 1]], axis=-1)
        for elbow in (0, 1):
            words = solve(inverse, tip, np.full(len(tip), elbow), l1, l2)
            status, reached = words["out_status"], tip_of(angles(inverse, words), l1, l2)
            radius = np.linalg.norm(tip, axis=-1)
            beyond = radius > 256 * (l1 + l2)
            must, may = CLAIMS[inverse.family](inverse, round(256 * l1), round(256 * l2)).unreachable(tip.T)
            assert np.all((status & UNREACHABLE > 0)[must]) and not np.any((status & UNREACHABLE > 0)[~may])
            nearest = tip * np.where(beyond, 256 * (l1 + l2) / np.maximum(radius, 1), 1.0)[:, None]
            undefined = status & SINGULAR > 0
            assert np.all(undefined[radius == 0])
            far = np.abs(radius - 256 * (l1 + l2)) > 256 * 1.0  # the singular circle has its own law
            error = np.linalg.norm(reached - nearest, axis=-1)
            assert np.all((error <= back + 1 + half_word(inverse, words, l1, l2))[~undefined & far & (radius > 512)])
