"""The stream codecs against float64 at every listed parameter set: their derived bounds, the axes, held words."""

import numpy as np
import pytest
from quadrance import bounds, codecs, conversion, cores, truth
from quadrance.cores import Core, joints

CODECS = [core for core in cores.all_cores() if core.model_name.startswith("conversion.") and not core.params["PIPE"]]
TO_VECTOR = {"angle_to_vector": bounds.codec.angle_to_vector, "spread_to_vector": bounds.codec.spread_to_vector,
             "half_tangent_to_vector": bounds.codec.half_tangent_to_vector}
FROM_VECTOR = {"vector_to_angle": bounds.codec.vector_to_angle, "vector_to_spread": bounds.codec.unit_to_spread,
               "vector_to_half_tangent": bounds.codec.vector_to_half_tangent}


def some(names):
    """One test a core and parameter set."""
    return pytest.mark.parametrize("core", [core for core in CODECS if core.name in names], ids=lambda core: core.id)


def every_word(joint: cores.Joint) -> dict[str, np.ndarray]:
    """All words of a short type of one word, or border words and 200000 others."""
    port = joint[0]
    if port.width <= 18:
        return {port.name: np.arange(1 << port.width)}
    rest = np.random.default_rng(1).integers(0, 1 << port.width, 200_000)
    return {port.name: np.append(codecs.border_words(joint)[port.name], rest)}


def directions(core: Core, count: int = 200_000) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Angles, the axes and diagonals among them, and their unit vectors."""
    theta = np.append(np.random.default_rng(2).uniform(0, truth.TURN, count), np.arange(8) * (truth.TURN / 8))
    return theta, codecs.encode(joints(core.inputs)[0], theta)


def off(core: Core, words: dict[str, np.ndarray], theta: np.ndarray) -> np.ndarray:
    """LSB of the answered word from that of the angle."""
    joint = joints(core.outputs)[0]
    turn = 2.0 ** joint[0].width
    return np.abs(np.mod(words["out_j"] - codecs.place(joint, theta) + turn / 2, turn) - turn / 2)


def test_every_codec_has_a_test():
    assert {core.name for core in CODECS} == {*TO_VECTOR, *FROM_VECTOR, "angle_to_spread", "vector_normalise"}


@some(TO_VECTOR)
def test_a_vector_is_within_its_bound_of_the_word(core):
    joint, one = joints(core.inputs)[0], 1 << core.params["U"]
    words = every_word(joint)
    answer = core.model(core.params, **words)
    for name, part in zip(("out_c", "out_n"), truth.unit(codecs.decode(joint, words))):
        error = np.abs(answer[name] - one * part).max()
        assert 0.75 * TO_VECTOR[core.name](core.params) < error <= TO_VECTOR[core.name](core.params) + 1e-6
        assert np.abs(answer[name]).max() == one
    axes = core.model(core.params, in_j=np.arange(4) * codecs.quadrant(joint))
    assert axes["out_c"].tolist() == [one, 0, -one, 0] and axes["out_n"].tolist() == [0, one, 0, -one]


@some(FROM_VECTOR)
def test_a_word_is_within_its_bound_of_the_minor_coordinate(core):
    """And of the angle that was rounded to the vector, within what half an LSB of that coordinate turns it."""
    u, (theta, words) = core.params["U"], directions(core)
    answer, (c, n) = core.model(core.params, **words), words.values()
    assert not answer["out_status"].any()
    edge = one_of(core) * 11 // 16
    exact = np.where((n >= -edge) & (n < edge), np.where(c < 0, np.pi - np.arcsin(n / 2.0**u), np.arcsin(n / 2.0**u)),
                     np.where(n < 0, 3 * np.pi / 2 + np.arcsin(c / 2.0**u), np.pi / 2 - np.arcsin(c / 2.0**u)))
    bound = FROM_VECTOR[core.name](core.params)
    error = off(core, answer, exact).max()
    assert 0.7 * bound < error <= bound + 1e-5
    seen = np.abs(truth.difference(exact, theta)).max()
    assert 0.6 < seen * 2**u <= 0.5 / np.sqrt(1 - 0.727**2) * 1.001


def one_of(core: Core) -> int:
    return 1 << core.params["U"]


@some(FROM_VECTOR)
def test_a_length_turns_the_word_by_no_more_than_itself(core):
    """1 + e: e tan + 3 e^2, tan <= 1.06, beyond the bound of a rounded unit vector."""
    theta, _ = directions(core)
    u, joint = core.params["U"], joints(core.outputs)[0]
    for e in (-0.01, 0.01):
        c, n = (np.rint(2.0**u * (1 + e) * part).astype(np.int64) for part in truth.unit(theta))
        answer = core.model(core.params, in_c=c, in_n=n)
        turned = np.abs(truth.difference(codecs.within_cell(joint, answer, theta), theta))
        rest = 0.8 * 2.0**-u + truth.TURN * 2.0 ** -joint[0].width
        assert 0.5 * abs(e) < turned.max() <= 1.06 * abs(e) + 3 * e * e + rest


@some(FROM_VECTOR)
def test_no_unit_vector_holds_the_word(core):
    """|c| < 1/2 and |n| < 11/16, and nothing else; 0 after a reset."""
    one = one_of(core)
    half, edge = one // 2, one * 11 // 16
    c = np.array([0, 0, 0, half - 1, -half, half, -half, -half - 1, 0, 0])
    n = np.array([0, one, 0, edge - 1, edge - 1, 0, -edge, -edge, edge, -edge - 1])
    answer = core.model(core.params, in_c=c, in_n=n)
    assert answer["out_status"].tolist() == [2, 0, 2, 2, 2, 0, 2, 0, 0, 0]
    assert answer["out_j"][0] == 0 and np.all(answer["out_j"][2:5] == answer["out_j"][1])
    assert answer["out_j"][6] == answer["out_j"][5] == 0


@some(["angle_to_spread"])
def test_angle_to_spread(core):
    joint = joints(core.inputs)[0]
    words = every_word(joint)
    theta = codecs.decode(joint, words)
    answer = core.model(core.params, **words)
    error, bound = off(core, answer, theta), bounds.codec.angle_to_spread(core.params, theta)
    assert np.all(error <= bound + 1e-6) and (error / bound).max() > 0.7
    axes = core.model(core.params, in_j=np.arange(4) * codecs.quadrant(joint))["out_j"]
    assert axes.tolist() == [k << core.params["S"] for k in range(4)]
    if joint[0].width <= 18:  # the word never falls
        assert np.all(np.diff(answer["out_j"])[:-1] >= 0) or np.sum(np.diff(answer["out_j"]) < 0) == 1


@some(["vector_normalise"])
def test_one_newton_step(core):
    u, rng = core.params["U"], np.random.default_rng(4)
    theta, length = rng.uniform(0, truth.TURN, 100_000), rng.uniform(0.01, 3**0.5 - 0.01, 100_000)
    length[::2] = 1 + rng.uniform(-0.02, 0.02, 50_000)
    c, n = (np.rint(2.0**u * length * part).astype(np.int64) for part in truth.unit(theta))
    length = np.hypot(c, n) / 2.0**u
    answer = core.model(core.params, in_c=c, in_n=n)
    assert not answer["out_status"].any()
    factor, bound = (3 - length**2) / 2, bounds.codec.vector_normalise(length)
    error = np.maximum(np.abs(answer["out_c"] - c * factor), np.abs(answer["out_n"] - n * factor))
    assert np.all(error <= bound) and (error / bound).max() > 0.8
    after = np.hypot(answer["out_c"], answer["out_n"]) / 2.0**u
    assert np.all(np.abs(after - bounds.codec.normalised(length)) <= np.sqrt(2) * bound / 2**u)
    e = 0.02
    assert bounds.codec.normalised(1 + e) == pytest.approx(1 - 1.5 * e * e - 0.5 * e**3, abs=1e-12)


@some(["vector_normalise"])
def test_a_vector_that_cannot_be_normalised_is_held(core):
    one = one_of(core)
    c, n = np.array([0, one, 0, -2 * one, 7 * one // 4, one, 0]), np.array([0, 0, 0, 0, 0, 3 * one // 2, one])
    answer = core.model(core.params, in_c=c, in_n=n)
    assert answer["out_status"].tolist() == [2, 0, 2, 2, 2, 2, 0]
    assert answer["out_c"].tolist() == [one] * 6 + [0] and answer["out_n"].tolist() == [0] * 6 + [one]


def test_tables_never_fall_within_reach():
    """Knots of the arc sine and of the half-tangent rise with the sine."""
    for d in (12, 20, 26):
        assert np.all(np.diff(conversion.arcsine_knots(d)) >= 0)
    for d in (10, 18, 22):
        assert all(np.all(np.diff(conversion.half_tangent_steps(d, y)) >= 0) for y in (False, True))
