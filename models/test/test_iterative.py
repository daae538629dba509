"""The recursions of the two iterative papers against their golden iterates, their laws, and bad inputs;

the haptic circle: golden lags, bit-true engines beside float64, and the plant against its differential equation.
"""

from __future__ import annotations

import numpy as np
import pytest
from quadrance import cores, truth
from quadrance.iterative import engines, gradient, newton, track

PLANAR, ALPHA = gradient.planar(0.1, 0.1), 33.0
GOAL = (0.0292, 0.1267)
TOUCH = gradient.touch(0.135, 0.135, (0.0, 0.025, -0.17))
UNIT = (1.0, 1.0, 1.0)
ENDS = {(-100, 30): ((27.190065213, 99.465932289), (27.57151755659676, 98.9007605172044)),
        (-50, -50): ((125.890990469, -98.029218267), (126.47227807380115, -98.9007605172044))}


def jacobian(kinematics: gradient.Kinematics, theta: np.ndarray) -> np.ndarray:
    """By central differences."""
    h = 1e-6
    columns = [(kinematics(theta + h * way)[0] - kinematics(theta - h * way)[0]) / (2 * h)
               for way in np.eye(theta.shape[-1])]
    return np.stack(columns, axis=-1)


@pytest.mark.parametrize("start", ENDS)
def test_planar_iterates(start: tuple[int, int]) -> None:
    """Thirty iterations of the paper's example, and where they lead."""
    after, exact = ENDS[start]
    theta = gradient.path(PLANAR, np.radians(start), GOAL, ALPHA, 3000)
    assert np.abs(np.degrees(theta[30]) - after).max() < 1e-9
    assert np.abs(np.degrees(theta[-1]) - exact).max() < 1e-9


def test_planar_error_after_thirty_iterations() -> None:
    theta = gradient.path(PLANAR, np.radians([-100, 30]), GOAL, ALPHA, 30)[-1]
    error = np.linalg.norm(gradient.step(PLANAR, theta, GOAL, ALPHA)[1])
    assert abs(error - 0.7837e-3) < 5e-8 and error ** 2 / 2 < 1e-6


def test_the_start_as_printed_ends_at_the_other_elbow() -> None:
    theta = gradient.path(PLANAR, np.radians([-100, -30]), GOAL, ALPHA, 3000)[-1]
    assert np.degrees(theta[1]) == pytest.approx(-98.9007605172044, abs=1e-9)


def test_touch_iterates() -> None:
    theta = gradient.path(TOUCH, [1.0, -1.0, 0.0], [0.0, 0.0, 0.0], 19.0, 2000)
    assert np.linalg.norm(gradient.step(TOUCH, theta[30], np.zeros(3), 19.0)[1]) == pytest.approx(13.334e-6, abs=5e-10)
    assert np.abs(theta[-1] - (0, 0.7349599929948536, 0.543811818377492)).max() < 1e-9


def printed(theta: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The tip of the Touch with J as the paper prints it: s23, c23."""
    s1, s2, _ = np.sin(theta)
    c1, c2, _ = np.cos(theta)
    s23, c23 = (0.135 * fn(theta[1] + theta[2]) for fn in (np.sin, np.cos))
    along, up = 0.135 * c2 + s23, 0.135 * s2 + c23
    return TOUCH(theta)[0], np.array([[-s1 * along, -c1 * up, c1 * (0.135 * c2 + c23)],
                                      [0, along, 0.135 * s2 + s23], [c1 * along, -s1 * up, s1 * along]])


@pytest.mark.parametrize("start", [(1.0, -1.0, 0.0), (1.0, 0.0, -1.0)])
def test_the_printed_jacobian_stalls(start: tuple[float, float, float]) -> None:
    """0.17 m off the target, from the start whose tip the paper prints and from the one that it prints."""
    off = np.linalg.norm(TOUCH(gradient.path(printed, start, np.zeros(3), 19.0, 2000))[0], axis=-1)
    assert np.abs(off[200:] - 0.1696).max() < 5e-5 and off[1:].min() > 0.169


@pytest.mark.parametrize(("iterations", "lag"), [(1, 37.6), (2, 14.4), (5, 2.52), (30, 0.002)])
def test_lag_on_the_circle(iterations: int, lag: float) -> None:
    """The haptic circle at 1 kHz, rms behind the target once the start is forgotten, micrometres."""
    time = np.arange(-150, 125)[:, None] * 1e-3 + np.arange(64) / 8  # 64 eighths of a second: one turn
    goal = 0.035 * np.stack([np.cos(np.pi / 4 * time), 0 * time, np.sin(np.pi / 4 * time)], axis=-1)
    theta, far = np.tile([0.0, 0.735, 0.544], (64, 1)), []
    for point in goal:
        for _ in range(iterations):
            theta = theta + gradient.step(TOUCH, theta, point, 19.0)[0]
        far.append(np.linalg.norm(point - TOUCH(theta)[0], axis=-1))
    assert np.sqrt(np.mean(np.square(far[150:]))) * 1e6 == pytest.approx(lag, rel=0.02, abs=6e-4)


@pytest.mark.parametrize("joints", [1, 2, 3, 7, 20])
def test_jacobians(joints: int) -> None:
    rng = np.random.default_rng(joints)
    theta = rng.uniform(-3, 3, joints)
    axes, links = rng.normal(size=(2, joints, 3))
    axes /= np.linalg.norm(axes, axis=-1, keepdims=True)
    chain = [gradient.Joint(tuple(axis), tuple(link)) for axis, link in zip(axes, links)]
    for kinematics in (gradient.planar(*rng.uniform(0.1, 1, joints)), gradient.spatial(chain)):
        assert np.abs(kinematics(theta)[1] - jacobian(kinematics, theta)).max() < 1e-7 * joints
    angles = rng.uniform(-3, 3, 3)
    assert np.abs(TOUCH(angles)[1] - jacobian(TOUCH, angles)).max() < 1e-8


def test_a_plane_in_space_is_the_plane() -> None:
    """Quaternions about z and the plane's own cosines agree, joint by joint."""
    lengths, rng = (0.3, 0.2, 0.4), np.random.default_rng(2)
    chain = gradient.spatial([gradient.Joint((0, 0, 1), (length, 0, 0)) for length in lengths])
    theta = rng.uniform(-3, 3, (50, 3))
    tip, columns = chain(theta)
    flat, flat_columns = gradient.planar(*lengths)(theta)
    assert np.abs(tip[:, :2] - flat).max() < 1e-14 and np.abs(columns[:, :2] - flat_columns).max() < 1e-14
    assert np.abs(tip[:, 2]).max() == 0


def test_stability_bound() -> None:
    """2 / (L1^2 + (L1 + L2)^2) is reached at full stretch: 40 in the example, where 33 stands and 41 does not."""
    theta = np.stack([np.zeros(721), np.linspace(-np.pi, np.pi, 721)], axis=-1)
    assert gradient.stable_below(PLANAR, theta).min() == pytest.approx(40)
    start, goal = np.array([0.01, 1e-4]), np.array([0.2, 0.0])  # stretched: the tip moves across the arm alone
    across = [abs(gradient.path(PLANAR, start, goal, alpha, 200)[-1] @ [2, 1]) for alpha in (38.0, 42.0)]
    assert across[0] < 1e-3 < across[1]


def test_damped_steps_converge_in_fewer() -> None:
    rng = np.random.default_rng(3)
    goal = truth.tip(rng.uniform(-2.5, 2.5, (200, 2)), 0.1, 0.1)[:, :2]
    goal = goal[(np.linalg.norm(goal, axis=-1) > 0.04) & (np.linalg.norm(goal, axis=-1) < 0.19)]
    rule = {"tolerance": 1e-14, "limit": 2000}
    slow = gradient.solve(PLANAR, [0.3, 0.8], goal, alpha=ALPHA, **rule)
    fast = gradient.solve(PLANAR, [0.3, 0.8], goal, damping=2e-3, **rule)
    assert slow.converged.all() and fast.converged.all()
    assert np.median(fast.iterations) < np.median(slow.iterations) / 3
    for answer in (slow, fast):
        assert np.abs(truth.tip(answer.theta, 0.1, 0.1)[:, :2] - goal).max() < 1.1e-7


def test_bad_inputs_of_the_descent() -> None:
    """Out of reach, a step too long, tolerance 0, limit 0, a singular start: flagged within the limit, never wrong."""
    far = gradient.solve(PLANAR, [0.2, 0.5], [0.3, 0.1], alpha=15.0, tolerance=1e-12, limit=2000)
    tip = truth.tip(far.theta, 0.1, 0.1)[:2]
    assert not far.converged and np.abs(tip - 0.2 * np.array([0.3, 0.1]) / np.hypot(0.3, 0.1)).max() < 1e-6
    fast = gradient.solve(PLANAR, [0.2, 0.5], [0.3, 0.1], alpha=ALPHA, tolerance=1e-12, limit=2000)
    assert not fast.converged  # beyond reach the error bends the valley too: the bound is lower there, 33 is above it
    wild = gradient.solve(PLANAR, [0.2, 0.5], GOAL, alpha=400.0, tolerance=1e-12, limit=500)
    assert not wild.converged and wild.iterations == 500
    exact = gradient.solve(PLANAR, [0.2, 0.5], GOAL, alpha=ALPHA, tolerance=0, limit=10)
    assert not exact.converged and exact.iterations == 10
    none = gradient.solve(PLANAR, [0.2, 0.5], GOAL, alpha=ALPHA, tolerance=1e-6, limit=0)
    assert not none.converged and none.iterations == 0 and np.all(none.theta == [0.2, 0.5])
    stuck = gradient.solve(PLANAR, [0.0, 0.0], [0.1, 0.0], alpha=ALPHA, tolerance=1e-6, limit=50)
    assert not stuck.converged and np.all(stuck.theta == 0)  # along the arm: the gradient is 0
    for wrong in ({"alpha": 0}, {"damping": 0}, {"alpha": 1, "limit": -1}, {"alpha": 1, "tolerance": -1}):
        with pytest.raises(ValueError, match="positive|negative"):
            gradient.solve(PLANAR, [0.2, 0.5], GOAL, **{"tolerance": 1e-6, "limit": 5} | wrong)
    for chain in (gradient.planar, lambda: gradient.spatial([])):
        with pytest.raises(ValueError, match="without a"):
            chain()
    with pytest.raises(ValueError, match="length 1"):
        gradient.spatial([gradient.Joint((0, 0, 2), (1, 0, 0))])


# Newton-Raphson


def test_newton_iterates() -> None:
    """Table 2 of the paper: eight iterations, several turns round."""
    theta = newton.path([np.pi / 3, np.pi / 6, np.pi / 6], [1.5, 0.0], UNIT, 8)[-1]
    assert np.abs(theta - (-7.601301378832405, 15.20260275766481, -7.601301378832405)).max() < 1e-9
    angles = np.degrees(newton.wrapped(theta))
    assert np.abs(angles - (-75.52248781407, 151.04497562814, -75.52248781407)).max() < 1e-9


def test_newton_step_is_that_of_the_matrix() -> None:
    rng = np.random.default_rng(4)
    theta, lengths, target = rng.uniform(-3, 3, 3), np.array([0.9, 0.7, 0.4]), np.array([-0.8, 0.6])
    turn = np.cumsum(theta)
    columns = np.cumsum(np.stack([-lengths * np.sin(turn), lengths * np.cos(turn)])[:, ::-1], axis=1)[:, ::-1]
    matrix = np.concatenate([columns, np.ones((1, 3))])
    move, gap, n2 = newton.step(theta, target, lengths)
    assert np.abs(matrix @ move - gap).max() < 1e-12
    assert np.linalg.det(matrix) == pytest.approx(lengths[0] * lengths[1] * n2)


def grid() -> np.ndarray:
    """The 8100 starts: theta1 and theta2 in steps of 4 degrees, theta3 = 0."""
    axis = np.radians(np.arange(0, 360, 4))
    one, two = np.meshgrid(axis, axis, indexing="ij")
    return np.stack([one.ravel(), two.ravel(), np.zeros(one.size)], axis=-1)


def test_newton_grid_converges_or_is_flagged() -> None:
    """Every start ends at one of the two solutions, or says that it did not."""
    answer = newton.solve(grid(), [1.5, 0.0], UNIT, tolerance=1e-18, limit=100)
    exact = np.stack([newton.closed([1.5, 0.0], UNIT, elbow)[0] for elbow in (0, 1)])
    off = np.abs(truth.difference(answer.theta[:, None], exact)).max(axis=-1).min(axis=-1)
    assert np.all(off[answer.converged] < 1e-8)
    assert answer.converged.all() and not answer.singular.any()
    assert np.all(np.percentile(answer.iterations, [50, 95, 100]) <= [9, 15, 60])
    short = newton.solve(grid(), [1.5, 0.0], UNIT, tolerance=1e-18, limit=12)
    assert np.all(short.iterations[~short.converged] == 12) and 0 < (~short.converged).sum() < 2000


def test_newton_warm_start_takes_four() -> None:
    time = np.linspace(0, 2 * np.pi, 400)
    goal = np.stack([1.5 + 0.2 * np.cos(time), 0.3 * np.sin(time)], axis=-1)
    theta = newton.closed(goal[0], UNIT)[0]
    for point in goal:
        answer = newton.solve(theta, point, UNIT, tolerance=1e-18, limit=20)
        assert answer.converged and answer.iterations <= 4
        theta = answer.theta


@pytest.mark.parametrize("elbow", [0, 1])
def test_closed_form_solves_the_equations(elbow: int) -> None:
    rng = np.random.default_rng(5)
    lengths, radius, ray = (0.9, 0.7, 0.4), rng.uniform(0.7, 1.9, 500), rng.uniform(-np.pi, np.pi, 500)
    goal = np.stack([radius * np.cos(ray), radius * np.sin(ray)], axis=-1)
    theta, far = newton.closed(goal, lengths, elbow)
    assert np.abs(newton.residual(theta, goal, lengths)).max() < 1e-9 and np.abs(far).max() < 1e-12
    assert np.all(np.sin(theta[:, 1]) * (1 - 2 * elbow) >= 0)


def test_bad_inputs_of_newton() -> None:
    stuck = newton.solve([0.0, 0.0, 0.0], [3.5, 0.0], UNIT, tolerance=1e-12, limit=50)
    assert not stuck.converged and stuck.iterations == 50 and np.all(np.isfinite(stuck.theta))
    origin = newton.solve([0.1, 0.2, 0.3], [0.0, 0.0], UNIT, tolerance=1e-12, limit=50)
    assert np.all(np.isfinite(origin.theta))
    for wrong in ({"limit": -1}, {"clamp": 0}, {"guard": -1}, {"tolerance": -1}):
        with pytest.raises(ValueError, match="positive"):
            newton.solve([0.1, 0.2, 0.3], [1.5, 0.0], UNIT, **{"tolerance": 1e-12, "limit": 5} | wrong)
    with pytest.raises(ValueError, match="positive"):
        newton.solve([0.1, 0.2, 0.3], [1.5, 0.0], (1.0, 0.0, 1.0), tolerance=1e-12, limit=5)


# The haptic circle

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

