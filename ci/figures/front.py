"""The picture on the front page: a target, the core, its joint words by family, and the arm that follows them.

Every number in it is computed: the words by the bit-true models, the drawn arm from the words of the first family.
"""

from __future__ import annotations

import numpy as np
from matplotlib import pyplot
from matplotlib.patches import Arc, FancyBboxPatch
from quadrance import accuracy, arms, codecs, cores
from quadrance.accuracy.arm import joint_ports

from ci.figures import write

ARM = "cobra600"
TARGET = (210.0, 400.0)  # mm
CORES = ("vector_ik2", "table_ik2", "classic_ik2", "rational_ik2")
COLOURS = {"vector": "tab:red", "table": "tab:purple", "rational": "tab:green", "classic": "tab:blue"}
CODINGS = {"vector": "unit vector", "angle": "binary angle", "spread": "turn-spread"}


def answers() -> list[tuple[cores.Core, dict[str, int], list[float]]]:
    """(core, words of its ports, joint angles in rad) of `CORES` for `TARGET` on `ARM`."""
    arm, found = arms.load(ARM), []
    for name in CORES:
        core = cores.find(name)
        x, y = (round(mm / accuracy.mm_per_lsb(core, arm)) for mm in TARGET)
        words = accuracy.config(core, arm) | {"in_x": x, "in_y": y, "in_elbow": 0}
        answer = core.model(core.params, **{key: np.array([value]) for key, value in words.items()})
        theta = [float(codecs.decode(joint, answer)[0]) for joint in joint_ports(core)]
        found.append((core, words | {key: int(value[0]) for key, value in answer.items()}, theta))
    return found


def _box(axis: pyplot.Axes, low: float, high: float, middle: float, width: float, colour: str) -> None:
    axis.add_patch(FancyBboxPatch((middle - width / 2, low), width, high - low, facecolor=colour,
                                  boxstyle="round,pad=0,rounding_size=0.02", alpha=0.14, edgecolor=colour,
                                  linewidth=1.5))


def _arm(axis: pyplot.Axes, theta: list[float]) -> None:
    one, two = arms.load(ARM).links
    scale = arms.load(ARM).mm_per_unit
    elbow = one * scale * np.array([np.cos(theta[0]), np.sin(theta[0])])
    tip = elbow + two * scale * np.array([np.cos(sum(theta)), np.sin(sum(theta))])
    for start, end in ((np.zeros(2), elbow), (elbow, tip)):
        axis.plot(*np.stack([start, end]).T, color="0.45", linewidth=11, solid_capstyle="round", zorder=1)
    for place in (np.zeros(2), elbow):
        axis.plot(*place, "o", color="white", markeredgecolor="0.25", markersize=8, zorder=3)
    axis.plot(*tip, "+", color="black", markersize=16, markeredgewidth=2.5, zorder=4)
    degrees = np.degrees(theta)
    axis.plot([0, 190], [0, 0], ":", color="0.5")
    axis.plot(*np.stack([elbow, elbow * 1.5]).T, ":", color="0.5")
    axis.add_patch(Arc((0, 0), 260, 260, theta1=0, theta2=degrees[0], color="black"))
    axis.add_patch(Arc(elbow, 170, 170, theta1=degrees[0], theta2=degrees[0] + degrees[1], color="black"))
    axis.annotate(f"$θ_1$ = {degrees[0]:.2f}°", (140, 22), fontsize=12)
    axis.annotate(f"$θ_2$ = {degrees[1]:.2f}°", elbow + [15, 95], fontsize=12)
    axis.annotate(f"({TARGET[0]:g}, {TARGET[1]:g}) mm", tip + [20, 12], fontsize=12)
    axis.set(xlim=(-60, 420), ylim=(-50, 470), aspect="equal")
    axis.text(40, 455, arms.load(ARM).name, fontsize=12)
    axis.axis("off")


def picture() -> pyplot.Figure:
    """Target, core, words, arm."""
    found = answers()
    figure, (axis, robot) = pyplot.subplots(1, 2, figsize=(13, 4.6), gridspec_kw={"width_ratios": [2.1, 1]})
    axis.set(xlim=(0, 1), ylim=(0, 1))
    axis.axis("off")
    for row, (core, words, _) in enumerate(found):
        colour, middle = COLOURS[core.family], 0.86 - 0.235 * row
        _box(axis, middle - 0.085, middle + 0.085, 0.36, 0.25, colour)
        axis.text(0.36, middle, f"{core.name}\n{core.latency} cycles", ha="center", va="center", fontsize=12)
        axis.annotate("", (0.232, middle), (0.16, middle), arrowprops={"arrowstyle": "->"})
        axis.annotate("", (0.56, middle), (0.488, middle), arrowprops={"arrowstyle": "->"})
        axis.text(0.15, middle, f"in_x  {words['in_x']}\nin_y  {words['in_y']}", ha="right", va="center", fontsize=12,
                  family="monospace")
        lines = ["  ".join(f"{port.name} {words[port.name]}" for port in joint) for joint in joint_ports(core)]
        axis.text(0.575, middle + 0.03, "\n".join(lines), ha="left", va="center", fontsize=12, family="monospace")
        coding = CODINGS[joint_ports(core)[0][0].type]
        axis.text(0.575, middle - 0.115, coding, ha="left", va="bottom", fontsize=10, color=colour, style="italic")
    _arm(robot, found[0][2])
    figure.tight_layout()
    return figure


def shows() -> str:
    """What the picture says: names, cycles and words."""
    return "; ".join(f"{core.name} {core.latency} {words}" for core, words, _ in answers())


def main() -> None:
    """Draw it."""
    write(picture(), "front.png", shows=shows())
