"""This module draws figures 2, 8, 9, 11, 12 of paper three (quaternion gradient descent) and compares its claims."""

from __future__ import annotations

import numpy as np
from quadrance import truth
from quadrance.cores import ROOT
from quadrance.iterative import gradient, track

from ci.figures import fill, pyplot, table, write

PAGE = ROOT / "models" / "quadrance" / "iterative" / "README.md"
PLANAR, ALPHA, GOAL = gradient.planar(0.1, 0.1), 33.0, np.array([0.0292, 0.1267])
STARTS = {(-100, 30): "tab:red", (-50, -50): "tab:blue"}
PRINTED_START = (-100, -30)
TOUCH, TOUCH_ALPHA = gradient.touch(0.135, 0.135, (0.0, 0.025, -0.17)), 19.0
TOUCH_START, ORIGIN = (1.0, -1.0, 0.0), np.zeros(3)
ENDS = {(-100, 30): (27.5634, 98.9129), (-50, -50): (126.4531, -98.9089)}  # degrees, as printed
ITERATIONS = 30


def printed(theta: truth.Floats) -> tuple[truth.Floats, truth.Floats]:
    """The tip of the Touch, and its Jacobian as the paper prints it below (29), with s23 and c23."""
    s1, c1, s2, c2 = np.sin(theta[0]), np.cos(theta[0]), np.sin(theta[1]), np.cos(theta[1])
    s23, c23, l1, l2 = np.sin(theta[1] + theta[2]), np.cos(theta[1] + theta[2]), 0.135, 0.135
    rho = l1 * c2 + l2 * s23
    return TOUCH(theta)[0], np.array([[-s1 * rho, -c1 * (l1 * s2 + l2 * c23), c1 * (l1 * c2 + l2 * c23)],
                                      [0, rho, l1 * s2 + l2 * s23],
                                      [c1 * rho, -s1 * (l1 * s2 + l2 * c23), s1 * rho]])


def error(arm: gradient.Kinematics, theta: truth.Floats, goal: truth.Floats) -> truth.Floats:
    """Distance of the tip from the target, metres."""
    return np.linalg.norm(goal - arm(truth.floats(theta))[0], axis=-1)


def ends(degrees: truth.Floats) -> truth.Floats:
    """Where the descent from starts (..., 2) in degrees leads, radians."""
    return gradient.solve(PLANAR, np.radians(degrees), GOAL, alpha=ALPHA, tolerance=1e-22, limit=3000).theta


def basins(count: int) -> tuple[truth.Floats, truth.Floats, np.ndarray, np.ndarray]:
    """(theta1, theta2) of a grid over the turn in degrees, E_c there, and the elbow that the descent ends with."""
    axis = np.linspace(-180, 180, count)
    start = np.stack(np.meshgrid(axis, axis), axis=-1)
    theta = gradient.solve(PLANAR, np.radians(start), GOAL, alpha=ALPHA, tolerance=1e-8, limit=1000).theta
    return start[..., 0], start[..., 1], error(PLANAR, np.radians(start), GOAL) ** 2 / 2, np.sin(theta[..., 1]) > 0


def figure_2() -> pyplot.Figure:
    """Phase plane: level curves of E_c, its gradient, both basins, and the iterates from the two starts."""
    one, two, cost, elbow = basins(181)
    figure, axis = pyplot.subplots(figsize=(7.5, 6.2))
    axis.contourf(one, two, elbow, levels=[-0.5, 0.5, 1.5], colors=["#dbe7f5", "#f8dfdc"])
    axis.contour(one, two, cost, levels=np.geomspace(1e-5, 4e-2, 12), colors="grey", linewidths=0.6)
    thin = np.s_[::9, ::9]
    move = gradient.step(PLANAR, np.radians(np.stack([one[thin], two[thin]], axis=-1)), GOAL, ALPHA)[0]
    move /= np.maximum(np.linalg.norm(move, axis=-1, keepdims=True), 1e-9)
    axis.quiver(one[thin], two[thin], move[..., 0], move[..., 1], color="#999999", angles="xy", scale=45, width=0.002)
    for start, colour in [*STARTS.items(), (PRINTED_START, "black")]:
        path = np.degrees(gradient.path(PLANAR, np.radians(start), GOAL, ALPHA, ITERATIONS))
        label = f"{start}: 30 iterations" if start in STARTS else f"{start}, as printed: the other elbow"
        axis.plot(*path.T, "--" if start not in STARTS else "-", marker=".", color=colour, linewidth=1, label=label)
    for start in STARTS:
        axis.plot(*np.degrees(ends(np.array(start))), "*", color="black", markersize=11)
    axis.set(xlabel="θ1, degrees", ylabel="θ2, degrees", xlim=(-180, 180), ylim=(-180, 180),
             title="Level curves of $E_c$, and the basin of each elbow at α = 33")
    axis.legend(loc="upper left", fontsize=8)
    figure.tight_layout()
    return figure


def figures_8_9() -> pyplot.Figure:
    """The Geomagic Touch over thirty iterations: joints, E_c, tip."""
    path = gradient.path(TOUCH, TOUCH_START, ORIGIN, TOUCH_ALPHA, ITERATIONS)
    tips = TOUCH(path)[0]
    figure, axes = pyplot.subplots(1, 3, figsize=(13, 3.8))
    for i in range(3):
        axes[0].plot(path[:, i], label=f"θ{i + 1}")
        axes[2].plot(tips[:, i] * 1000, label="xyz"[i])
    axes[1].semilogy(error(TOUCH, path, ORIGIN) ** 2 / 2, color="black")
    for axis, title in zip(axes, ("joints, rad", "$E_c$, m²", "tip, mm")):
        axis.set(xlabel="iteration", title=title)
        axis.grid(True, alpha=0.25)
    axes[0].legend()
    axes[2].legend()
    figure.tight_layout()
    return figure


def turn(count: int) -> dict[str, truth.Floats]:
    """One turn of the haptic circle at `count` iterations a sample: time, target, joints and tips asked and reached."""
    trace = track.follow(track.followers()["touch"], [count])

    def joined(column: truth.Floats) -> truth.Floats:
        return np.moveaxis(column[track.SETTLE:, :, 0], 0, 1).reshape(-1, *column.shape[3:])

    found = {name: joined(getattr(trace, name)) for name in ("time", "goal", "asked", "reached")}
    return found | {f"tip_{name}": TOUCH(found[name])[0] for name in ("asked", "reached")}


def figures_11_12() -> pyplot.Figure:
    """The haptic circle: joints asked for and reached, the circle in space, and where the distance comes from."""
    found = turn(1)
    figure, axes = pyplot.subplots(1, 3, figsize=(13, 4.2))
    for i, colour in enumerate(("tab:blue", "tab:orange", "tab:green")):
        axes[0].plot(found["time"], found["asked"][:, i], color=colour, label=f"θ{i + 1} asked for")
        axes[0].plot(found["time"], found["reached"][:, i], "--", color="black", linewidth=0.8)
    axes[0].set(xlabel="s", title="joints, rad (dashed: reached)")
    axes[0].legend(fontsize=8)
    for name, style in (("goal", "-"), ("tip_reached", "--")):
        axes[1].plot(found[name][:, 0] * 1000, found[name][:, 2] * 1000, style, label=name.removeprefix("tip_"))
    axes[1].set(xlabel="x, mm", ylabel="z, mm", title="the circle in space (y = 0)", aspect="equal")
    axes[1].legend(fontsize=8, loc="center")
    servo = np.linalg.norm(found["tip_reached"] - found["tip_asked"], axis=-1) * 1e6
    axes[2].semilogy(found["time"], servo, color="black", label="servo, plant modelled")
    for count in track.COUNTS[:3]:
        more = found if count == 1 else turn(count)
        lag = np.linalg.norm(more["tip_asked"] - more["goal"], axis=-1) * 1e6
        axes[2].semilogy(more["time"], lag, label=f"solver, {count} iteration{'s' * (count > 1)} a sample")
    axes[2].set(xlabel="s", title="distance at the tip, µm")
    axes[2].legend(fontsize=8)
    for axis in axes:
        axis.grid(True, alpha=0.25)
    figure.tight_layout()
    return figure


def nearest_share(count: int = 90) -> float:
    """Share of the grid's starts that end at the solution which is nearer to them, the short way round."""
    one, two, _, elbow = basins(count + 1)
    start = np.radians(np.stack([one, two], axis=-1))
    off = [np.linalg.norm(truth.difference(start, ends(np.array(first))), axis=-1) for first in STARTS]
    return float(((off[0] < off[1]) == elbow).mean())


def _degrees(theta: truth.Floats) -> str:
    return "(" + ", ".join(f"{value:.4f}°" for value in np.degrees(truth.difference(theta, 0))) + ")"


def _vector(values: truth.Floats, digits: int = 4) -> str:
    return "(" + ", ".join(f"{value + 0.0:.{digits}f}" for value in np.round(values, digits)) + ")"


def claims() -> str:
    """What the paper says, and what the models give, as a table."""
    rows = [("start that leads to the first solution", "(-100°, 30°) in 3.3, (-100°, -30°) at figure 2",
             f"(-100°, 30°); (-100°, -30°) ends at {_degrees(ends(np.array(PRINTED_START)))}")]
    for start, said in ENDS.items():
        path = gradient.path(PLANAR, np.radians(start), GOAL, ALPHA, ITERATIONS)
        fine = gradient.solve(PLANAR, np.radians(start), GOAL, alpha=ALPHA, tolerance=1e-12, limit=3000)
        walked = np.linalg.norm(np.diff(path, axis=0), axis=-1).sum()
        rows += [(f"solution from {start}°", f"({said[0]}°, {said[1]}°)", _degrees(ends(np.array(start)))),
                 (f"after 30 iterations from {start}°", "converged", f"{_degrees(path[-1])}, "
                  f"{error(PLANAR, path[-1], GOAL) * 1000:.3f} mm off; 1 µm takes {int(fine.iterations)}"),
                 (f"its way in the joints, from {start}°", "the shortest",
                  f"{walked / np.linalg.norm(path[-1] - path[0]):.3f} times the straight one")]
    rows += [("a descent ends at the solution nearest to its start", "always",
              f"from {nearest_share():.1%} of a grid of starts"),
             ("α that is stable at full stretch", "33 taken, no bound given",
              f"below {float(gradient.stable_below(PLANAR, np.zeros(2))):.0f}"),
             ("Touch: tip at the start, m", "(-0.0614, -0.2236, -0.1306) from (1, 0, -1) rad",
              f"{_vector(TOUCH(np.array([1.0, 0, -1]))[0])}; the printed one from (1, -1, 0) rad: "
              f"{_vector(TOUCH(np.array(TOUCH_START))[0])}")]
    path = gradient.path(TOUCH, TOUCH_START, ORIGIN, TOUCH_ALPHA, 2000)
    wrong = error(TOUCH, gradient.path(printed, TOUCH_START, ORIGIN, TOUCH_ALPHA, 2000), ORIGIN)
    said = np.array([-0.3122, 1.0, 0.735])
    off = error(TOUCH, said, ORIGIN) * 1000
    rows += [("Touch: joints at the target 0, rad", f"{_vector(said)}, whose tip is {off:.0f} mm off",
              _vector(path[-1])),
             ("Touch: after 30 iterations", "converged", f"{error(TOUCH, path[30], ORIGIN) * 1e6:.3f} µm off"),
             ("Touch: with the Jacobian as printed", "converges",
              f"stalls: {wrong[30]:.2f} m off after 30 iterations, never nearer than {wrong.min():.2f} m in 2000"),
             ("Touch: on the haptic circle at 1 kHz", "follows (a picture; iterations a sample not said)",
              "; ".join(f"{row['iterations']}: {row['lag_um']:.3g} µm"
                        for row in track.summary(track.followers()["touch"])) + " (rms behind the target)"),
             ("Touch: reached by the PID", "a picture, a real device",
              f"{track.summary(track.followers()['touch'], [1])[0]['servo_um']:.0f} µm rms with the plant as modelled")]
    return table(rows)


def main() -> None:
    """Draw all and fill the page."""
    write(figure_2(), "gradient_2.png")
    write(figures_8_9(), "gradient_8_9.png")
    write(figures_11_12(), "gradient_11_12.png")
    fill(PAGE, "claims of the gradient", claims())
