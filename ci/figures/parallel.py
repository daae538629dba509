"""This module draws figures 7 to 10 of the paper on the reconfigurable robot and compares its claims with ours."""

from __future__ import annotations

import numpy as np
from quadrance.cores import ROOT
from quadrance.parallel import geometry, position, reconfiguration, singularity

from ci.figures import FOLDER, drawn, fill, pyplot, shrunk, table, write

PAGE = ROOT / "models" / "quadrance" / "parallel" / "README.md"
POSE = np.array([[.9623, -.1306, -.2388], [.0842, .9771, -.1952], [.2588, .1677, .9513]])
PLACE = np.array([0.0, -350.0, 0.0])
TILT = geometry.rotation(("z", 5), ("y", 10), ("x", 10))
COLOURS = {"rotation": "tab:red", "translation": "tab:blue"}
FRAMES = 51


def spiral(count: int = 101) -> np.ndarray:
    """The paper's places; its rotation is `TILT`."""
    s = np.linspace(0, 1, count)
    return np.stack([25 * np.cos(2 * np.pi * s), -250 - 100 * s, 25 * np.sin(2 * np.pi * s)], axis=-1)


def figure_7(robot: geometry.Robot) -> pyplot.Figure:
    """Manipulability over beta at the paper's pose, and what the paper does not show: the condition of J_x."""
    beta = np.radians(np.linspace(-60, 90, 601))
    measures = reconfiguration.manipulability(robot, POSE, PLACE, beta)
    reach = ~np.isnan(measures[0])
    cond, _ = singularity.condition(robot, POSE, PLACE, beta[reach])
    figure, axes = pyplot.subplots(1, 3, figsize=(13, 3.8))
    for axis, name, values in zip(axes, COLOURS, measures):
        found = reconfiguration.best(robot, POSE, PLACE, name)
        axis.plot(np.degrees(beta), values, color=COLOURS[name])
        axis.axvline(np.degrees(found.beta), color="black", linewidth=0.8, linestyle="--")
        axis.set_title(f"manipulability of {name}: best at {float(np.degrees(found.beta)):.4f}°", fontsize=10)
    axes[2].plot(np.degrees(beta[reach]), cond, color="tab:green")
    axes[2].set_title("cond of $J_x$ (lengths / 100 mm): worst where w is best", fontsize=10)
    for axis in axes:
        axis.set(xlabel="β, degrees", xlim=(-60, 90))
        axis.grid(True, alpha=0.25)
    figure.tight_layout()
    return figure


def _robot(axis, robot: geometry.Robot, turn: np.ndarray, place: np.ndarray, beta: float) -> None:
    """The robot in three dimensions; the paper's y is drawn upwards."""
    def line(points: np.ndarray, **style) -> None:
        axis.plot(points[:, 0], -points[:, 2], points[:, 1], **style)

    alpha = position.inverse(robot, turn, place, beta).alpha
    shoulders, elbows = robot.shoulders(beta), robot.elbows(alpha, beta)
    ends = robot.joints(turn, place)
    for leg in range(robot.legs):
        if robot.link[leg]:
            line(np.array([robot.foot[leg], shoulders[leg]]), color="tab:purple", linewidth=4)
        line(np.array([shoulders[leg], elbows[leg]]), color="tab:orange", linewidth=3)
        line(np.array([elbows[leg], ends[leg]]), color="tab:blue", linewidth=1.5)
    for part in (robot.foot[:3], robot.foot[3:]):
        line(np.vstack([part, part[:1]]), color="grey", linewidth=1)
    for part in (ends[:3], ends[3:]):
        line(np.vstack([part, part[:1]]), color="black", linewidth=1.5)
    for i in range(3):
        line(ends[[i, i + 3]], color="black", linewidth=1.5)
    axis.set(xlim=(-450, 450), ylim=(-450, 450), zlim=(-450, 250))
    axis.set_box_aspect((9, 9, 7), zoom=1.4)
    axis.set_axis_off()
    axis.view_init(elev=16, azim=-62)


def figure_8(robot: geometry.Robot) -> pyplot.Figure:
    """The posture of greatest manipulability."""
    figure = pyplot.figure(figsize=(6, 4.6))
    axis = figure.add_axes((-0.12, -0.12, 1.24, 1.16), projection="3d")
    beta = float(reconfiguration.best(robot, POSE, PLACE).beta)
    _robot(axis, robot, POSE, PLACE, beta)
    figure.text(0.03, 0.94, f"β = {np.degrees(beta):.2f}°; purple: reconfiguration links, orange: cranks, blue: rods",
                fontsize=9)
    return figure


def figures_9_10(robot: geometry.Robot) -> tuple[pyplot.Figure, pyplot.Figure, dict]:
    """Along the spiral: measures with and without reconfiguration, the best beta by either, and the conditions."""
    place, point = spiral(), np.arange(101)
    best = {name: reconfiguration.best(robot, TILT, place, name) for name in COLOURS}
    base = dict(zip(COLOURS, reconfiguration.manipulability(robot, TILT, place)))
    base_condition, _ = singularity.condition(robot, TILT, place)
    nine, axes = pyplot.subplots(1, 3, figsize=(13, 3.8))
    for axis, name in zip(axes, COLOURS):
        axis.plot(point, base[name], color="grey", label="base model, β = 0")
        axis.plot(point, best[name].value, color=COLOURS[name], label="best β")
        axis.set_title(f"manipulability of {name}", fontsize=10)
    axes[2].plot(point, base_condition, color="grey", label="base model, β = 0")
    for name in COLOURS:
        axes[2].plot(point, best[name].condition, color=COLOURS[name], label=f"best β, {name}")
    axes[2].set_title("cond of $J_x$ (lengths / 100 mm)", fontsize=10)
    for axis in axes:
        axis.set(xlabel="point of the spiral")
        axis.grid(True, alpha=0.25)
        axis.legend(fontsize=8)
    nine.tight_layout()
    ten, axis = pyplot.subplots(figsize=(6.5, 3.8))
    for name in COLOURS:
        axis.plot(point, np.degrees(best[name].beta), color=COLOURS[name], label=name)
    axis.set(xlabel="point of the spiral", ylabel="best β, degrees")
    axis.grid(True, alpha=0.25)
    axis.legend()
    ten.tight_layout()
    return nine, ten, best


def animation(robot: geometry.Robot) -> None:
    """The robot on its spiral with the best beta of rotation."""
    place = spiral(FRAMES)
    beta = reconfiguration.best(robot, TILT, place).beta
    frames = []
    for at, link in zip(place, beta):
        figure = pyplot.figure(figsize=(4, 3.1))
        axis = figure.add_axes((-0.15, -0.15, 1.3, 1.2), projection="3d")
        _robot(axis, robot, TILT, at, float(link))
        figure.text(0.03, 0.93, f"β = {np.degrees(link):6.2f}°", fontsize=9)
        frames.append(shrunk(drawn(figure, 80), 24))
    frames[0].save(FOLDER / "spiral.gif", save_all=True, append_images=frames[1:] + frames[-2:0:-1], duration=80,
                   loop=0, optimize=True)


def claims(robot: geometry.Robot, best: dict) -> str:
    """What the paper says, and what the models give, as a table."""
    low, _ = np.degrees(reconfiguration.feasible(robot, POSE, PLACE))
    there = {name: reconfiguration.best(robot, POSE, PLACE, name) for name in COLOURS}
    cond, _ = singularity.condition(robot, POSE, PLACE, np.radians(np.arange(-59, 91)))
    turns = {name: np.degrees(found.beta) for name, found in best.items()}
    apart = float(np.abs(turns["rotation"] - turns["translation"]).max())
    rows = [("lowest β that reaches the pose", "-60°", f"{low:.4f}°")]
    rows += [(f"best β at the pose, {name}", "about -11°",
              f"{float(np.degrees(found.beta)):.4f}° (w = {float(found.value):.7g})") for name, found in there.items()]
    rows += [(f"best β on the spiral, {name}", "not printed, a plot", f"{found[0]:.2f}° to {found[-1]:.2f}°")
             for name, found in turns.items()]
    rows += [("greatest difference of the two on the spiral", "about 2°", f"{apart:.3f}°"),
             ("cond of J_x at β = -11°, lengths / 100 mm", "not looked at", f"{cond[48]:.0f}"),
             (f"its greatest value over β, at {int(np.argmax(cond)) - 59}°", "not looked at", f"{cond.max():.0f}"),
             ("its value at β = +90°", "not looked at", f"{cond[-1]:.0f}")]
    return table(rows)


def main() -> None:
    """Draw all and fill the page."""
    robot = geometry.load("rus_2x3")
    write(figure_7(robot), "figure_7.png")
    write(figure_8(robot), "figure_8.png", 110)
    nine, ten, best = figures_9_10(robot)
    write(nine, "figure_9.png")
    write(ten, "figure_10.png")
    animation(robot)
    fill(PAGE, "claims", claims(robot, best))
