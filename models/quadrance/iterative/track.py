"""This module sends the haptic circle through an iterative solver and a servo, and measures how far each lags behind.

Paper three, section 4.3: a circle of 35 mm at pi / 4 rad/s, a target every millisecond, some iterations for each, and a
PID at every joint (eqs. 32, 33). The paper's plant is a real Geomagic Touch. Here it is a model, `advance`: every joint
by itself is an inertia with viscous friction, gravity is compensated, and the torque has no limit. Its figures are
assumed, of the order of that device's data sheet; they were identified on no device. The solver never sees the plant.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from quadrance import truth
from quadrance.cores import Core, find
from quadrance.iterative import engines, gradient
from quadrance.truth import Floats, floats

RADIUS, OMEGA, PERIOD = 0.035, np.pi / 4, 1e-3  # m, rad/s, s
COUNTS = (1, 2, 5, 30)  # iterations a sample
MOST = 1023  # as cfg_limit of the engines
GOLDEN = {1: 37.6, 2: 14.4, 5: 2.52, 30: 0.002}  # rms lag of the Touch in float64, micrometres (MATHS, section 3)
GAINS = floats([[7, 5.5, 12.2], [0.07, 0.08, 0.06], [0.007, 0.008, 0.009]])  # Kp, Ki, Kd of the joints
MASS = 0.045  # kg at the end of a link
DRAG = 0.26 / (RADIUS * OMEGA)  # N s/m there: 0.26 N at the speed of the circle
PHASES, SETTLE, SHOWN = 64, 150, 125  # loops side by side, samples before their measurement, samples of it: one turn

Solve = Callable[[np.ndarray, Floats, np.ndarray], np.ndarray]  # state (k, n), targets (k, d), counts (k) -> state


@dataclass(frozen=True)
class Follower:
    """A solver on its circle: centre + RADIUS (cos u + sin v).

    start : joints near those of the centre, radians. solve : a sample's iterations from the state before.
    state, theta : joints in radians to a state, and back. seen : the target that the solver's words represent.
    clocks : of an engine's pass, 0 of float64.
    """

    name: str
    arm: gradient.Kinematics
    lengths: tuple[float, ...]
    centre: tuple[float, ...]
    ways: tuple[tuple[float, ...], tuple[float, ...]]
    start: tuple[float, ...]
    solve: Solve
    state: Callable[[Floats], np.ndarray] = floats
    theta: Callable[[np.ndarray], Floats] = floats
    seen: Callable[[Floats], Floats] = floats
    clocks: int = 0

    def circle(self, time: Floats) -> Floats:
        """Targets at times (...) in seconds, (..., d) metres."""
        u, v = floats(self.ways)
        turn = OMEGA * floats(time)[..., None]
        return self.centre + RADIUS * (np.cos(turn) * u + np.sin(turn) * v)


@dataclass(frozen=True)
class Servo:
    """Plant and controller between two samples, (..., n): joints, their rates, and the integral of the error."""

    theta: Floats
    rate: Floats
    integral: Floats


@dataclass(frozen=True)
class Trace:
    """What happened, samples first, (samples, ..., n or d): times, targets, what the solver saw, states, joints asked
    for and reached, in seconds, metres and radians."""

    time: Floats
    goal: Floats
    seen: Floats
    state: np.ndarray
    asked: Floats
    reached: Floats


def advance(servo: Servo, error: Floats, asked_rate: Floats, lengths: Sequence[float]) -> Servo:
    """A period of J w' + b w = u, exactly, with the PID's torque u held; error and rate (..., n) of the sample."""
    kp, ki, kd = GAINS[:, :error.shape[-1]]
    length = np.resize(floats(lengths), error.shape[-1])
    inertia, friction = MASS * length**2, DRAG * length**2
    integral = servo.integral + error * PERIOD
    torque = kp * error + ki * integral + kd * (asked_rate - servo.rate)
    lag = inertia / friction
    stays = np.exp(-PERIOD / lag)
    final = torque / friction
    theta = servo.theta + final * PERIOD + (servo.rate - final) * lag * (1 - stays)
    return Servo(theta, final + (servo.rate - final) * stays, integral)


def exact(follower: Follower, time: Floats) -> Floats:
    """Joints of the circle at times (...), radians, (..., n)."""
    goal = follower.circle(time)
    answer = gradient.solve(follower.arm, follower.start, goal, damping=1e-9, tolerance=1e-24, limit=60)
    return answer.theta


def begin(follower: Follower, time: Floats) -> tuple[np.ndarray, Servo]:
    """On the circle, moving with it: the state and the plant at times (...)."""
    theta, before = exact(follower, time), exact(follower, time - PERIOD)
    return follower.state(before), Servo(theta, truth.difference(theta, before) / PERIOD, np.zeros_like(theta))


def loop(follower: Follower, counts: Sequence[int], phases: int,
         samples: int) -> Generator[tuple[np.ndarray, Floats, np.ndarray], np.ndarray, Trace]:
    """As `follow`, for a solver of the caller's: yields what a `Solve` takes, is sent what it gives."""
    start = np.repeat(np.arange(phases) * (2 * np.pi / OMEGA / phases), len(counts))
    iterations = np.tile(np.asarray(counts), phases)
    state, servo = begin(follower, start)
    rows, asked_before = [], follower.theta(state)
    for k in range(samples):
        time = start + k * PERIOD
        goal = follower.circle(time)
        state = yield state, goal, iterations
        asked = follower.theta(state)
        rows.append((time, goal, follower.seen(goal), state, asked, servo.theta))
        servo = advance(servo, truth.difference(asked, servo.theta),
                        truth.difference(asked, asked_before) / PERIOD, follower.lengths)  # eqs. 19 and 33
        asked_before = asked
    shape = (samples, phases, len(counts))
    return Trace(*(np.stack(column).reshape(shape + column[0].shape[1:]) for column in zip(*rows)))


def follow(follower: Follower, counts: Sequence[int], phases: int = PHASES, samples: int = SETTLE + SHOWN) -> Trace:
    """`phases` loops evenly round the circle, each at every count of iterations: (samples, phases, counts, ...)."""
    steps = loop(follower, counts, phases, samples)
    asked = next(steps)
    while True:
        try:
            asked = steps.send(follower.solve(*asked))
        except StopIteration as end:
            return end.value


def summary(follower: Follower, counts: Sequence[int] = COUNTS) -> list[dict]:
    """Over one turn, a row a count of iterations; distances are root mean squares at the tip, micrometres.

    lag_um : the target as the solver saw it, to the tip of the joints it asks for. words_um : the target to that.
    servo_um : the tip asked for to the tip reached. tip_um : the target to the tip reached.
    """
    trace = follow(follower, counts)
    goal, seen, asked, reached = (column[-SHOWN:] for column in (
        trace.goal, trace.seen, follower.arm(trace.asked)[0], follower.arm(trace.reached)[0]))
    pairs = {"lag_um": (seen, asked), "words_um": (goal, seen), "servo_um": (asked, reached), "tip_um": (goal, reached)}
    rms = {key: np.sqrt(((a - b) ** 2).sum(axis=-1).mean(axis=(0, 1))) * 1e6 for key, (a, b) in pairs.items()}
    golden = GOLDEN if follower.lengths == TOUCH else {}
    return [{"solver": follower.name, "iterations": count, "golden_um": golden.get(count),
             **{key: float(values[i]) for key, values in rms.items()},
             "clocks": follower.clocks * (count + 1) or None} for i, count in enumerate(counts)]


# Solvers


def _floating(arm: gradient.Kinematics, alpha: float) -> Solve:
    def solve(state: np.ndarray, goal: Floats, counts: np.ndarray) -> np.ndarray:
        for done in range(int(counts.max())):
            state = np.where((done < counts)[:, None], state + gradient.step(arm, state, goal, alpha)[0], state)
        return state
    return solve


PLANE = {"centre": (0.0292, 0.1267), "ways": ((1.0, 0.0), (0.0, 1.0)), "start": (0.4812, 1.7261)}
SPACE = {"centre": (0.0, 0.0, 0.0), "ways": ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)), "start": (0.0, 0.735, 0.544)}
ROUND = {2: PLANE, 3: SPACE}  # by the dimensions of the target; the plane's centre is the paper's target there
TOUCH = (0.135, 0.135)
_touch = gradient.touch(*TOUCH, origin=(0.0, 0.025, -0.17))
_planar = engines.EXAMPLES["engine_quaternion_gd"]
FLOATS = (Follower("touch", _touch, TOUCH, solve=_floating(_touch, 19.0), **SPACE),
          Follower("planar", _planar.arm, _planar.lengths, solve=_floating(_planar.arm, _planar.alpha), **PLANE))


def ports(core: Core, state: np.ndarray, goal: Floats, counts: ArrayLike, warm: int = 0) -> engines.Answer:
    """Input and configuration words of an engine for a sample of every loop; a tolerance of 0 takes all iterations."""
    example = engines.EXAMPLES[core.name]
    lsb = example.lsb(core, 2)
    return engines.inputs(core, example.goals(goal, lsb), state, warm) | example.config(core, lsb) | {
        "cfg_tol": 0, "cfg_limit": counts}


def engine(core: Core) -> Follower:
    """The bit-true model of an engine of `engines.EXAMPLES` on its circle, the longer link a quarter of a word."""
    example, a = engines.EXAMPLES[core.name], core.params["A"]
    lsb = example.lsb(core, 2)

    def solve(state: np.ndarray, goal: Floats, counts: np.ndarray) -> np.ndarray:
        return engines.joints(core.model(core.params, **ports(core, state, goal, counts)))

    return Follower(core.name, example.arm, example.lengths, solve=solve, clocks=example.clocks(core)[0],
                    state=lambda theta: truth.angle_to_binary_word(theta, a) & (1 << a) - 1,
                    theta=lambda state: truth.binary_word_to_angle(state, a),
                    seen=lambda goal: example.places(example.goals(goal, lsb), lsb), **ROUND[len(example.origin)])


def followers() -> dict[str, Follower]:
    """All by name: float64 first, then every listed engine at its first parameter set."""
    found = [*FLOATS, *(engine(find(name)) for name in engines.EXAMPLES)]
    return {one.name: one for one in found}
