"""This module draws figures 3 and 4 of paper four (Newton-Raphson of three joints) and compares its claims."""

from __future__ import annotations

import numpy as np
from quadrance import truth
from quadrance.cores import ROOT
from quadrance.iterative import convergence, newton

from ci.figures import fill, pyplot, table, write

PAGE = ROOT / "models" / "quadrance" / "iterative" / "README.md"
UNIT, GOAL = (1.0, 1.0, 1.0), np.array([1.5, 0.0])
START = np.pi / np.array([3, 6, 6])
TABLES = {1: (-99.0, 115.83, -331.18), 2: (-75.0, 150.98, -75.0)}  # degrees
FOUND = (-7.6013, 15.2026, -7.6013)  # radians, by Mathematica


def places(degrees: tuple[float, ...]) -> truth.Floats:
    """Base, elbows and tip, (4, 2)."""
    turn = np.cumsum(np.radians(degrees))
    return np.concatenate([np.zeros((1, 2)), np.cumsum(np.stack([np.cos(turn), np.sin(turn)], axis=-1), axis=0)])


def orientation(degrees: tuple[float, ...]) -> float:
    """The residual of the third equation of (14) in degrees: the angle of the last link against the target's ray."""
    return float(np.degrees(truth.difference(np.radians(sum(degrees)), np.arctan2(GOAL[1], GOAL[0]))))


def figures_3_4() -> pyplot.Figure:
    """The arms of both tables, the ray to the target, and how far the last link turns away from it."""
    figure, axes = pyplot.subplots(1, 2, figsize=(11, 4.6))
    ours = np.degrees(newton.path(START, GOAL, UNIT, 30)[-1])
    for axis, (number, joints) in zip(axes, TABLES.items()):
        axis.axhline(0, color="grey", linewidth=0.8, linestyle=":")
        for degrees, colour, label in ((ours, "#bbbbbb", "solves all three equations"),
                                       (joints, "tab:blue", f"as table {number} prints it")):
            axis.plot(*places(degrees).T, "-o", color=colour, linewidth=3, label=label)
        elbow, tip = places(joints)[2:]
        axis.annotate("", tip + 0.6 * (tip - elbow), tip, arrowprops={"arrowstyle": "->", "color": "tab:red"})
        axis.plot(*GOAL, "x", color="black", markersize=9)
        axis.set(xlim=(-0.8, 2.4), ylim=(-1.4, 1.4), aspect="equal",
                 title=f"Figure {number + 2}, table {number}: the last link {orientation(joints):.2f}° off the ray")
        axis.legend(fontsize=8, loc="upper left")
        axis.grid(True, alpha=0.25)
    figure.tight_layout()
    return figure


def claims() -> str:
    """What the paper says, and what the models give, as a table."""
    path = newton.path(START, GOAL, UNIT, 30)
    steps = int(np.argmax(np.abs(path - path[-1]).max(axis=-1) < 1e-13))
    both = [np.degrees(newton.closed(GOAL, UNIT, elbow)[0]) for elbow in (0, 1)]

    def degrees(values: np.ndarray) -> str:
        return "(" + ", ".join(f"{value:.4f}°" for value in values) + ")"

    rows = [("joints for (1.5, 0) from (π/3, π/6, π/6), rad", f"{FOUND}, by FindRoot",
             f"({', '.join(f'{value:.9f}' for value in path[-1])}), after {steps} iterations"),
            ("the same within a turn", "not converted", degrees(both[0]) + f"; the mirror image {degrees(both[1])}")]
    for number, joints in TABLES.items():
        off = np.linalg.norm(places(joints)[-1] - GOAL)
        rows.append((f"table {number}: {degrees(np.array(joints))}", "a solution",
                     f"tip {off:.4f} off; third equation of (14): {orientation(joints):.2f}° in place of 0"))
    starts = convergence.grid(3)
    answer = newton.solve(starts, GOAL, UNIT, tolerance=1e-18, limit=100)
    median, late, most = np.percentile(answer.iterations, [50, 95, 100])
    rows += [("starts that converge, of a grid of 4°", "needs an initial estimate",
              f"{int(answer.converged.sum())} of {len(starts)} with clamp and guard: median {median:.0f} iterations, "
              f"95 % {late:.0f}, at most {most:.0f}"),
             ("target (-1.5, 0) in the third equation", "arctan(y / x) = 0°: the arm would point away",
              "atan2: 180°"),
             ("inverse of the Jacobian", "takes much of the computer's time", "closed: det J = l1 l2 sin θ2"),
             ("number of solutions", "more than one", "two, the elbow up or down; the closed form gives both")]
    return table(rows)


def main() -> None:
    """Draw and fill the page."""
    write(figures_3_4(), "newton_3_4.png")
    fill(PAGE, "claims of Newton", claims())
