"""Margin and slack of the inverse cores: words that try every bit of both, and targets and poses at these borders."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from quadrance.cores import Core

from tb.lib import stimulus
from tb.lib.stimulus import Vectors

Config = dict[str, int]


def word(rng: np.random.Generator, bits: int) -> int:
    """None, any word, one with all bits up to its highest set, or all bits."""
    one = stimulus.length(rng, bits)
    return (0, one, (1 << one.bit_length()) - 1, (1 << bits) - 1)[rng.integers(0, 4)]


# Two and three joints


def drawn(core: Core, rng: np.random.Generator, l2: int) -> Config:
    """Margin, most below the length of link 2, and slack, where the core has them."""
    return {port.name: word(rng, min(port.width, (l2 >> 1).bit_length()) if port.name == "cfg_margin" else port.width)
            for port in core.cfg if port.name in ("cfg_margin", "cfg_slack")}


def joined(core: Core, rng: np.random.Generator, found: list[Config]) -> list[Config]:
    """Configurations with margin and slack, the first one, of the longest links, with the greatest margin."""
    greatest = {port.name: port.high for port in core.cfg if port.name == "cfg_margin"}
    return [cfg | drawn(core, rng, cfg["cfg_l2"]) | ({} if i else greatest) for i, cfg in enumerate(found)]


def targets(core: Core, cfg: Config, rng: np.random.Generator) -> Vectors:
    """Targets whose elbow is as far from stretched or folded as the margin, and others as far beyond full reach as the
    slack; to a few LSB, half of them yaw.
    """
    axes = [port.name for port in core.inputs if port.name not in ("in_elbow", "in_back")]
    turn, yaw = rng.uniform(-np.pi, np.pi, (2, 1024))
    l1, l2, beyond = cfg["cfg_l1"], cfg["cfg_l2"], np.arange(1024) >= 512
    bend = np.arcsin(min(1.0, cfg["cfg_margin"] / max(l2, 1)))
    bend = np.where(rng.random(1024) < 0.5, bend, np.pi - bend)
    x, y = (l1 * part(turn) + l2 * part(turn + bend) for part in (np.cos, np.sin))
    slack = cfg["cfg_slack"] * 2.0 ** -next(port.width + 1 for port in core.cfg if port.name == "cfg_slack")  # of c2
    reach = (l1 * l1 + l2 * l2 + 2 * l1 * l2 * (1 + slack)) ** 0.5
    x, y = (np.where(beyond, reach * part(turn), word) for part, word in ((np.cos, x), (np.sin, y)))
    flat = rng.random(1024) < (0.5 if len(axes) == 3 else 1)
    words = np.where(flat, x, x * np.cos(yaw)), np.where(flat, y, x * np.sin(yaw)), np.where(flat, 0, y)
    high = 1 << core.params["W"] - 1
    near = [np.clip(np.rint(word).astype(np.int64) + rng.integers(-1, 2, 1024), -high, high - 1) for word in words]
    return dict(zip(axes, near)) | {"in_elbow": rng.integers(0, 2, 1024)}


# Six and seven axes


def any_words(core: Core, rng: np.random.Generator) -> Config:
    """Margin and slack, in LSB."""
    return {name: word(rng, core.params["W"] - 1) for name in ("cfg_margin", "cfg_slack")}


def with_words(core: Core, rng: np.random.Generator, found: list[Config]) -> list[Config]:
    """Configurations with margin and slack: none in the first one, an eighth of all in the next. The last two are of a
    small arm, with the greatest slack, and of the longest links, with the greatest margin.
    """
    high = (1 << core.params["W"] - 1) - 1
    found = [cfg | any_words(core, rng) for cfg in found]
    found[0] |= {"cfg_margin": 0, "cfg_slack": 0}
    found[1] |= {"cfg_margin": high >> 3, "cfg_slack": high >> 3}
    found[-2] |= {"cfg_slack": high}
    found[-1] |= {"cfg_margin": high}
    return found


class Joints(NamedTuple):
    """Where an arm of any kind is stretched, and how far it is from there."""

    elbow: int  # columns of the joints
    wrist: int
    straight: float  # joint of a stretched arm, radians
    forearm: float  # length that the sines of elbow and wrist are multiplied by
    upper: str  # name of the length of the upper arm
    lateral: float  # the arm's plane beside axis 1
    flange: float  # from the wrist's centre


def poses(core: Core, cfg: Config, rng: np.random.Generator, arm: NamedTuple, joints: Joints, q: np.ndarray,
          of: Callable[[np.ndarray, NamedTuple], Vectors]) -> Vectors:
    """Poses `of` the joints `q`, but that a fourth each has its elbow and its wrist as far from stretched and folded as
    the margin, is as far beyond full reach as the slack, and has the wrist's centre as far from axis 1 as the margin.
    """
    p, count, lsb = core.params, len(q), 2.0 ** -core.params["F"]
    bend = np.arcsin(min(1.0, abs(cfg["cfg_margin"]) * lsb / max(abs(joints.forearm), lsb)))
    bends = rng.choice([0, np.pi], count) + rng.choice([-1, 1], count) * bend
    q = q.copy()
    q[::4, joints.elbow] = (bends + joints.straight)[::4]
    q[1::4, joints.wrist] = bends[1::4]
    q[2::4, joints.elbow] = joints.straight
    longer = arm._replace(**{joints.upper: getattr(arm, joints.upper) + cfg["cfg_slack"] * lsb})
    found, beyond = of(q, arm), of(q, longer)
    found = {name: np.where(np.arange(count) % 4 == 2, beyond[name], words) for name, words in found.items()}
    far, high = np.hypot(cfg["cfg_margin"], joints.lateral / lsb), 1 << p["W"] - 1
    turn = rng.uniform(-np.pi, np.pi, count)
    for axis, row, part in (("in_x", "in_r13", np.cos), ("in_y", "in_r23", np.sin)):
        place = np.rint(far * part(turn) + joints.flange / lsb * found[row] * 2.0 ** -p["U"])
        found[axis][3::4] = np.clip(place, -high, high - 1)[3::4]
    return found
