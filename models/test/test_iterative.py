"""The recursions of the two iterative papers, the haptic circle that they follow, and engine_newton_3r."""

from __future__ import annotations

import numpy as np
import pytest
from quadrance import bounds, cores, table, truth
from quadrance.bounds import iterative as laws
from quadrance.iterative import engines, gradient, newton, newton_fixed, track

# The recursions against their golden iterates and laws, bad inputs; golden lags of the circle, bit-true engines beside
# float64, and the plant against its differential equation

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
        assert row["clocks"] == example.clocks(core)[0] * (row["iterations"] + 1)


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


# engine_newton_3r at every parameter set, table_ik3r beside it: both solutions, flags, bounds, bad inputs

CORES = [core for core in cores.all_cores() if core.name == "engine_newton_3r"]
EACH = pytest.mark.parametrize("core", CORES, ids=lambda core: core.id)
DIRECT = [core for core in cores.all_cores() if core.name == "table_ik3r"]


def words(p: dict[str, int], theta: np.ndarray) -> np.ndarray:
    return np.rint(np.asarray(theta) / truth.TURN * 2 ** p["A"]).astype(np.int64) & 2 ** p["A"] - 1


def angles(p: dict[str, int], answer: dict) -> np.ndarray:
    return np.stack([answer[f"out_j{i}"] for i in (1, 2, 3)], axis=-1) * truth.TURN / 2 ** p["A"]


def orientation(p: dict[str, int], answer: dict) -> np.ndarray:
    return sum(answer[f"out_j{i}"] for i in (1, 2, 3)) % 2 ** p["A"]


def arm(p: dict[str, int], damping: float = 0.0) -> dict[str, int]:
    """Unit links, an eighth of a word each; a tolerance of one unit."""
    length = 1 << p["W"] - 3
    return {"cfg_l1": length, "cfg_l2": length, "cfg_l3": length, "cfg_tol": 256, "cfg_limit": 100} \
        | newton_fixed.config(p, cfg_l1=length, cfg_l2=length, damping=damping)


def lengths(cfg: dict[str, int]) -> np.ndarray:
    return np.array([cfg["cfg_l1"], cfg["cfg_l2"], cfg["cfg_l3"]])


def run(p: dict[str, int], goal: np.ndarray, phi: np.ndarray, start: np.ndarray, cfg: dict, warm: int = 0) -> dict:
    return newton_fixed.solve(p, in_x=goal[..., 0], in_y=goal[..., 1], in_phi=phi, in_j1=start[..., 0],
                              in_j2=start[..., 1], in_warm=warm, **cfg)


def tips(theta: np.ndarray, links: np.ndarray) -> np.ndarray:
    turn = np.cumsum(theta, axis=-1)
    return np.stack([np.cos(turn) @ links, np.sin(turn) @ links], axis=-1)


def on_ray(p: dict[str, int], cfg: dict, goal: list[float]) -> tuple[np.ndarray, np.ndarray]:
    """A target in links, rounded, and the orientation of the paper's third equation."""
    word = np.rint(np.array(goal) * cfg["cfg_l1"]).astype(np.int64)
    return word, words(p, np.arctan2(word[..., 1], word[..., 0]))


def starts() -> np.ndarray:
    """The 8100 starts: theta1 and theta2 in steps of 4 degrees."""
    axis = np.radians(np.arange(0, 360, 4))
    return np.stack([one.ravel() for one in np.meshgrid(axis, axis, indexing="ij")], axis=-1)


@EACH
@pytest.mark.parametrize("damping", [0.0, 2**-8])
def test_grid_of_starts(core: cores.Core, damping: float) -> None:
    """All 8100 converge to one of the two solutions, about as fast as float64; none is wrong without a flag."""
    p = core.params
    cfg, start = arm(p, damping), words(p, starts())
    for goal in ([1.5, 0.0], [-2.2, 0.9], [2.95, 0.0]):
        point, phi = on_ray(p, cfg, goal)
        answer = run(p, point, phi, start, cfg)
        off = np.linalg.norm(tips(angles(p, answer), lengths(cfg)) - point, axis=-1)
        assert not answer["out_status"].any() and not answer["out_coarse"].any()
        assert np.all(answer["out_error"] < 256)
        assert np.all(off <= laws.newton_tip(p, tuple(lengths(cfg)), answer["out_error"]))
        assert np.all(orientation(p, answer) == phi)
        exact = newton.wrist_solve(starts(), point, phi * truth.TURN / 2 ** p["A"], lengths(cfg), damping=damping,
                                   tolerance=4.0 ** (p["W"] - 16), limit=100)
        assert exact.converged.mean() > 0.98
        assert abs(np.median(answer["out_iters"]) - np.median(exact.iterations)) <= 1
        assert np.percentile(answer["out_iters"], 95) <= np.percentile(exact.iterations, 95) + 2


@EACH
def test_the_papers_example(core: cores.Core) -> None:
    """From (60, 30) degrees to (1.5, 0): Table 2 or its mirror image, the third joint by the orientation."""
    p = core.params
    cfg = arm(p) | {"cfg_tol": 16}
    point, phi = on_ray(p, cfg, [1.5, 0.0])
    answer = run(p, point, phi, words(p, np.radians([60, 30])), cfg)
    theta = np.degrees(truth.difference(angles(p, answer), np.zeros(3)))
    table2 = np.array([-75.52248781407, 151.04497562814, -75.52248781407])
    assert answer["out_status"] == 0 and min(np.abs(theta - table2).max(), np.abs(theta + table2).max()) < 0.02


@EACH
def test_every_step_is_newtons_within_the_bound(core: cores.Core) -> None:
    p, near = core.params, []
    cfg, rng = arm(p) | {"cfg_tol": 0, "cfg_limit": 1}, np.random.default_rng(1)
    unit = 2 ** (16 - p["W"])
    links = lengths(cfg) * unit
    for size in (0.0003, 0.01, 0.2):
        theta = np.stack([rng.uniform(-3, 3, 300), rng.uniform(0.6, 2.5, 300) * rng.choice([-1, 1], 300)], axis=-1)
        start, phi = words(p, theta), rng.integers(0, 2 ** p["A"], 300)
        theta, turn = start * truth.TURN / 2 ** p["A"], phi * truth.TURN / 2 ** p["A"]
        third = turn - theta.sum(axis=-1)
        goal = np.rint(tips(np.concatenate([theta, third[:, None]], axis=1), lengths(cfg))
                       + rng.normal(size=(300, 2)) * size * cfg["cfg_l1"]).astype(np.int64)
        answer = run(p, goal, phi, start, cfg)
        wrist = goal * unit - links[2] * np.stack([np.cos(turn), np.sin(turn)], axis=-1)
        exact = theta + newton.wrist_step(theta, wrist, links)[0]
        for i in range(300):
            if np.abs(exact[i] - theta[i]).max() < 1.4:
                off = np.abs(truth.difference(angles(p, answer)[i, :2], exact[i])).max()
                near.append(off / laws.newton_step(p, theta[i], wrist[i], tuple(links)))
    assert len(near) > 700 and 0.1 < max(near) <= 1


@EACH
def test_warm_start_takes_four(core: cores.Core) -> None:
    """A circle of 400 targets, every one from the answer before it."""
    p = core.params
    cfg, turn = arm(p), np.linspace(0, truth.TURN, 400)
    point, phi = on_ray(p, cfg, np.stack([1.5 + 0.2 * np.cos(turn), 0.3 * np.sin(turn)], axis=-1))
    start = words(p, newton.closed([1.7, 0.0], (1, 1, 1))[0])
    answer = run(p, point, phi, np.tile(start, (400, 1)), cfg, np.arange(400) > 0)
    assert not answer["out_status"].any() and answer["out_iters"].max() <= 4 and answer["out_iters"].sum() > 300


@EACH
def test_bad_inputs_and_the_sample_behind_them(core: cores.Core) -> None:
    p = core.params
    cfg = arm(p)
    point, phi = on_ray(p, cfg, [1.5, 0.2])
    start = words(p, np.array([0.3, 0.9]))
    for change, status in (({"cfg_tol": 0, "cfg_limit": 7}, 8), ({"cfg_limit": 0}, 8), ({"cfg_l1": 0}, 10),
                           ({"cfg_l2": 0}, 10), ({"cfg_l1": 0, "cfg_l2": 0, "cfg_l3": 0}, 10)):
        answer = run(p, point, phi, start, cfg | change)
        assert answer["out_status"] == status and answer["out_iters"] == (cfg | change)["cfg_limit"]
    straight = run(p, point, phi, words(p, np.array([[0.3, 0.0], [0.1, np.pi]])), cfg)
    assert not straight["out_status"].any() and np.all(straight["out_iters"] > 1)
    still = run(p, point, phi, words(p, np.array([[0.3, 0.0]])), cfg | {"cfg_limit": 0})
    assert still["out_status"] == 10
    far = np.stack([[3 * cfg["cfg_l1"] + cfg["cfg_l1"] // 3, 0], point])
    both = run(p, far, np.array([0, phi]), np.tile(start, (2, 1)), cfg, np.array([0, 1]))
    assert both["out_status"][0] & 8 and both["out_status"][1] == 0 and both["out_iters"][0] == 100


@EACH
def test_damping_ends_at_the_nearest_point(core: cores.Core) -> None:
    """A tenth of a link out of reach: with damping it stands stretched towards the target; Newton wanders."""
    p = core.params
    turn = np.linspace(0.1, 6.1, 40)
    off = {}
    for damping in (0.0, 0.125):
        cfg = arm(p, damping)
        goal = np.rint(3.1 * cfg["cfg_l1"] * np.stack([np.cos(turn), np.sin(turn)], axis=-1)).astype(np.int64)
        start = words(p, np.stack([turn + 0.5, np.full(40, 0.7)], axis=-1))
        answer = run(p, goal, words(p, turn), start, cfg)
        assert np.all(answer["out_status"] & 8)
        near = 3 * cfg["cfg_l1"] * np.stack([np.cos(turn), np.sin(turn)], axis=-1)
        off[damping] = np.linalg.norm(tips(angles(p, answer), lengths(cfg)) - near, axis=-1).max() / cfg["cfg_l1"]
    assert off[0.125] < 0.002 < 0.1 < off[0.0]


def test_damping_out_of_range_is_refused() -> None:
    for wrong in (-1.0, 2**-10, 0.5):
        with pytest.raises(ValueError, match="damping"):
            newton_fixed.config(CORES[0].params, cfg_l1=9000, cfg_l2=9000, damping=wrong)


@pytest.mark.parametrize("core", DIRECT, ids=lambda core: core.id)
@pytest.mark.parametrize("elbow", [0, 1])
def test_one_pass_is_the_closed_form(core: cores.Core, elbow: int) -> None:
    """The tip is the target but for the errors of the wrist, of the kernel and of words; orientation exact."""
    p, rng = core.params, np.random.default_rng(2)
    length = 1 << p["W"] - 3
    links = np.array([length, length * 4 // 5, length // 2])
    theta = np.stack([rng.uniform(-np.pi, np.pi, 3000), rng.uniform(0.1, 3.0, 3000), rng.uniform(-3, 3, 3000)], axis=-1)
    goal = np.rint(tips(theta, links)).astype(np.int64)
    phi = words(p, theta.sum(axis=-1))
    cfg = table.config(p, cfg_l1=int(links[0]), cfg_l2=int(links[1]))
    answer = table.ik3r(p, in_x=goal[:, 0], in_y=goal[:, 1], in_phi=phi, in_elbow=elbow, cfg_l1=links[0],
                        cfg_l2=links[1], cfg_l3=links[2], **cfg)
    found = angles(p, answer)
    off = np.linalg.norm(tips(found, links) - goal, axis=-1)
    turn = phi * truth.TURN / 2 ** p["A"]
    rho = np.linalg.norm(goal - links[2] * np.stack([np.cos(turn), np.sin(turn)], axis=-1), axis=-1)
    c2 = (rho**2 - (links[:2].astype(float) ** 2).sum()) / (2 * links[0] * links[1])
    inside = (np.abs(c2) < 1) & (answer["out_status"] == 0)
    assert inside.mean() > 0.98 and not (answer["out_status"] & 6).any()
    assert np.all(np.sin(found[:, 1]) * (1 - 2 * elbow) >= -1e-3) and np.all(orientation(p, answer) == phi)
    share = off[inside] / bounds.table.ik3r(p, *links.tolist(), rho[inside], np.sqrt(1 - c2[inside] ** 2))
    assert 0.2 < share.max() <= 1


@pytest.mark.parametrize("core", DIRECT, ids=lambda core: core.id)
def test_one_pass_flags(core: cores.Core) -> None:
    p = core.params
    length, high = 1 << p["W"] - 3, 1 << p["W"] - 1
    cfg = {"cfg_l1": length, "cfg_l2": length, "cfg_l3": length} | table.config(p, cfg_l1=length, cfg_l2=length)
    half = 1 << p["A"] - 1
    answer = table.ik3r(p, in_x=np.array([length * 3 // 2, length, high - 1, high - 1]), in_y=0, in_elbow=0,
                        in_phi=np.array([0, 0, 0, half]), **cfg)
    assert answer["out_status"].tolist() == [0, 2, 1, 5]
