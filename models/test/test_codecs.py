"""Joint words by type, the codecs of the cores and the stream codecs against float64 within their bounds."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from quadrance import bounds, codecs, conversion, cores, truth
from quadrance.cores import Core, Port, joints

# Joint words, and the codecs inside of cores: error bounds, monotone over every quadrant border


def _sweep(s: int, count: int = 20000) -> np.ndarray:
    """Every word of a short format; of a long one every border with 2000 neighbours either side and a random rest."""
    if s <= 14:
        return np.arange(4 << s)
    near = np.concatenate([(k << s) + np.arange(-2000, 2001) for k in range(4)])
    rest = np.random.default_rng(5).integers(0, 4 << s, count)
    return np.unique(np.concatenate([near, rest]) % (4 << s))


WORDS = [(Port("in_j1", width, signed, of),) for of, width, signed in (
    ("spread", 26, False), ("spread", 10, False), ("spread", 32, False), ("angle", 16, False), ("angle", 10, False),
    ("angle", 16, True), ("half_tangent", 18, False), ("half_tangent", 10, False))]
VECTORS = [tuple(Port(f"in_{letter}1", u + 2, True, "vector") for letter in "cn") for u in (16, 10)]


def _id(joint: cores.Joint) -> str:
    return f"{joint[0].type}{joint[0].width}{'s' * joint[0].signed}"


ANY_WORD = pytest.mark.parametrize("joint", WORDS, ids=_id)
ANY_VECTOR = pytest.mark.parametrize("joint", VECTORS, ids=_id)
ANY_JOINT = pytest.mark.parametrize("joint", WORDS + VECTORS, ids=_id)


@ANY_JOINT
def test_a_word_means_the_angle_it_was_made_of(joint):
    theta = np.append(np.random.default_rng(6).uniform(-10, 10, 5000), np.arange(-8, 9) * np.pi / 4)
    words = codecs.encode(joint, theta)
    assert list(words) == [port.name for port in joint]
    for port in joint:
        assert words[port.name].min() >= port.low and words[port.name].max() <= port.high
    assert np.abs(truth.difference(codecs.decode(joint, words), theta)).max() <= codecs.half_step(joint) + 1e-9


@ANY_WORD
def test_every_word_is_that_of_its_angle(joint):
    port = joint[0]
    every = np.random.default_rng(7).integers(port.low, port.high, 5000, endpoint=True)
    if port.width < 30:  # a float64 angle beside a border is not fine enough for every word of more
        assert np.array_equal(codecs.encode(joint, codecs.decode(joint, {port.name: every}))[port.name], every)
    assert np.array_equal(codecs.words_at(joint, every)[port.name], every)


@ANY_JOINT
def test_places_rise_with_the_angle_and_meet_the_axes(joint):
    turn = 4 * codecs.quadrant(joint)
    places = np.arange(1 << 16) * (turn / 2.0**16)
    angle = codecs.at(joint, places)
    assert angle[0] == 0 and np.all(np.diff(angle) > 0) and angle[-1] < truth.TURN
    off = codecs.place(joint, angle) - places
    assert np.abs(np.mod(off + turn / 2, turn) - turn / 2).max() < (0.1 if joint[0].width > 30 else 1e-3)


@ANY_WORD
def test_words_meet_the_axes(joint):
    port = joint[0]
    quadrant = codecs.quadrant(joint)
    assert codecs.encode(joint, np.arange(4) * np.pi / 2)[port.name].tolist() \
        == [k * quadrant if not port.signed or k < 2 else (k - 4) * quadrant for k in range(4)]


@ANY_VECTOR
def test_vectors_are_rounded_coordinate_by_coordinate(joint):
    one = 1 << joint[0].width - 2
    words = codecs.encode(joint, np.append(np.arange(4) * np.pi / 2, np.pi / 6))
    assert words["in_c1"].tolist() == [one, 0, -one, 0, round(one * 0.75**0.5)]
    assert words["in_n1"].tolist() == [0, one, 0, -one, one // 2]


@ANY_WORD
def test_a_cell_ends_half_an_lsb_from_its_word(joint):
    word = np.array([(1 << joint[0].width) // 8])
    theta = codecs.at(joint, word)
    for off in (-3, 2):
        border = codecs.at(joint, word + off - 0.5 * np.sign(off))
        assert codecs.within_cell(joint, {"in_j1": word + off}, theta) == pytest.approx(border, abs=1e-12)


@ANY_VECTOR
def test_a_cell_of_a_vector_is_what_rounds_to_it(joint):
    """Angles in the cell stay what they are; any other comes to an end of the cell, a corner of the square."""
    rng = np.random.default_rng(8)
    theta = rng.uniform(0, truth.TURN, 3000)
    words = codecs.encode(joint, theta)
    assert codecs.within_cell(joint, words, theta) == pytest.approx(theta, abs=1e-12)
    far = theta + rng.choice([-1, 1], 3000) * 8 * codecs.half_step(joint)
    ends = codecs.within_cell(joint, words, far)
    c, n = (words[port.name] / 2.0 ** (port.width - 2) for port in joint)
    side = np.sign(truth.difference(far, theta))
    turn = (np.abs(c) + np.abs(n)) / 2.0 ** (joint[0].width - 1)  # half an LSB of both coordinates, across
    off = side * truth.difference(ends, codecs.decode(joint, words))
    assert off == pytest.approx(turn, rel=2.0 ** (4 - joint[0].width))


@ANY_WORD
def test_a_tie_is_no_error(joint):
    """The word before the true one, at a direction just past their common border: nearly no error."""
    turn = 1 << joint[0].width
    theta = codecs.at(joint, np.array([turn // 8 + 0.5 + 1e-4]))
    before, after = (codecs.within_cell(joint, {"in_j1": np.array([turn // 8 + i])}, theta) for i in (0, 1))
    assert abs(before - theta) < 1e-4 * truth.TURN / turn * 8 and after == pytest.approx(theta, abs=1e-12)


@ANY_WORD
def test_cells_wrap_round_the_full_turn(joint):
    port = joint[0]
    for theta in (1e-5, -1e-5):
        at = codecs.within_cell(joint, {"in_j1": np.array([0])}, np.array([theta]))
        assert abs(truth.difference(at, theta)) <= max(1e-5 - codecs.half_step(joint), 0) + 1e-9
    last = {"in_j1": np.array([-1 if port.signed else (1 << port.width) - 1])}
    assert abs(truth.difference(codecs.within_cell(joint, last, np.array([0.0])), 0)) \
        <= codecs.half_step(joint) * (1 + 1e-9)


def test_half_a_step_is_what_the_pages_say():
    assert np.degrees(codecs.half_step(WORDS[0])) == pytest.approx(0.0099, abs=5e-5)
    assert codecs.half_step(WORDS[3]) == pytest.approx(np.pi / 65536)
    assert np.degrees(codecs.half_step(VECTORS[0])) == pytest.approx(0.00062, abs=5e-6)


@ANY_JOINT
def test_the_coarsest_words_lose_half_a_step(joint):
    theta = codecs.at(joint, codecs.coarsest(joint, np.array([0.5 - 2.0**-12])))
    turned = np.abs(truth.difference(codecs.decode(joint, codecs.encode(joint, theta)), theta))
    assert theta.size == (4 if joint[0].type == "half_tangent" else 8) and turned.min() > 0.98 * codecs.half_step(joint)


def test_signed_angles_are_words_of_their_port():
    joint = (Port("in_j1", 16, True, "angle"),)
    assert codecs.encode(joint, np.array([-np.pi / 2, 3 * np.pi / 2]))["in_j1"].tolist() == [-16384, -16384]
    assert codecs.decode(joint, {"in_j1": np.array([-16384])}) == pytest.approx(3 * np.pi / 2)


def test_a_plain_word_is_no_joint():
    with pytest.raises(ValueError, match="in_x: a port of type None is no joint word; types are spread, angle, vector"):
        codecs.encode((Port("in_x", 16, True),), 0.0)


@ANY_JOINT
def test_border_words_are_about_every_border(joint):
    words = codecs.border_words(joint)
    found = set(zip(*(words[port.name].tolist() for port in joint)))
    quadrant = codecs.quadrant(joint)
    for k in range(4):
        for step in (0, 1, -1, 2, -2, quadrant // 4, -(quadrant // 4), quadrant // 2):
            at = codecs.words_at(joint, np.array(k * quadrant + step))
            assert tuple(int(at[port.name]) for port in joint) in found


# Plain words

KINDS = {"angle": 18, "spread": 24, "vector": 16, "half_tangent": 16}


def test_a_half_tangent_word_is_the_tangent_of_half_the_angle_and_a_half_turn():
    theta = np.radians([0, 30, 90, 150, 180, 210, 270, 330])
    word = codecs.from_radians("half_tangent", 16, theta)
    t, half = (word + (1 << 16) & 0x1FFFF) - (1 << 16), word + (1 << 16) >> 17 & 1
    assert half.tolist() == [0, 0, 1, 1, 1, 1, 0, 0]
    assert t == pytest.approx(2**16 * np.tan((theta - np.pi * half) / 2 - np.pi * (theta > 4.7)), abs=0.51)


@pytest.mark.parametrize("kind", KINDS)
def test_degrees_radians_and_counts_are_one_angle(kind):
    bits = KINDS[kind]
    degrees = np.arange(-720, 720) + 0.3
    words = codecs.from_degrees(kind, bits, degrees)
    assert np.array_equal(words, codecs.from_radians(kind, bits, np.radians(degrees % 360)))
    half = np.degrees(codecs.half_step(codecs.joint_of(kind, bits)))
    assert np.abs((codecs.to_degrees(kind, bits, words) - degrees + 180) % 360 - 180).max() <= half * (1 + 1e-9)
    counts = 4 * 500  # a word tells 2000 counts a turn apart
    count = np.arange(-3000, 3000)
    words = codecs.from_counts(kind, bits, count, counts)
    assert np.array_equal(codecs.to_counts(kind, bits, words, counts), count % counts)
    assert np.shape(words) == ((2, 6000) if kind == "vector" else (6000,))


def test_counts_become_angles_in_integers():
    assert codecs.from_counts("angle", 16, [0, 1, 65535, 65536, -1], 1 << 16).tolist() == [0, 1, 65535, 0, 65535]
    assert codecs.from_counts("angle", 10, [1, 2, 3, 4095], 4096).tolist() == [0, 1, 1, 0]  # ties upward, modulo a turn
    assert codecs.from_counts("angle", 24, 10**9 + 7, 10**6) == ((7 << 25) + 10**6) // (2 * 10**6)
    assert codecs.from_counts("vector", 16, 250, 1000) == (0, 1 << 16)
    with pytest.raises(ValueError, match="quaternion is no type of joint word; types are spread, angle, vector"):
        codecs.from_counts("quaternion", 16, 0, 1000)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("to", KINDS)
def test_conversion_there_and_back(kind, to):
    """Finer words come back as they were; and any word within both roundings."""
    theta = np.random.default_rng(9).uniform(0, truth.TURN, 3000)
    words = codecs.from_radians(kind, 8, theta)
    if kind != "vector":  # directions of its words are closer than its LSB
        assert np.array_equal(codecs.convert(to, 28, codecs.convert(kind, 8, words, to, 28), kind, 8), words)
    there = codecs.convert(kind, KINDS[kind], codecs.from_radians(kind, KINDS[kind], theta), to, KINDS[to])
    both = sum(codecs.half_step(codecs.joint_of(one, KINDS[one])) for one in (kind, to))
    assert np.abs(truth.difference(codecs.to_radians(to, KINDS[to], there), theta)).max() <= both


@given(st.integers(-131072, 131071), st.integers(-131072, 131071))
def test_vector_to_spread_is_the_nearest_word(c, n):
    if c == 0 and n == 0:
        return
    s = 24
    word = int(codecs.vector_to_spread({"W": 18, "S": s}, in_c=np.array([c]), in_n=np.array([n]))["out_j"][0])
    k = (2 if c < 0 else 3) if n < 0 else (1 if c < 0 else 0)
    part = n * n if k % 2 == 0 else c * c
    # |word - exact| <= 1/2 in exact integers, modulo the full circle
    twice = 2 * (c * c + n * n)
    error = (word - (k << s)) * twice - (part << s + 1)
    circle = (4 << s) * twice
    error = (error + circle // 2) % circle - circle // 2
    assert abs(error) <= twice // 2


def test_vector_to_spread_never_falls_with_the_angle():
    rng = np.random.default_rng(3)
    c, n = rng.integers(-2000, 2000, (2, 20000))
    keep = (c != 0) | (n != 0)
    c, n = c[keep], n[keep]
    order = np.argsort(np.arctan2(n, c) % (2 * np.pi), kind="stable")
    word = codecs.vector_to_spread({"W": 12, "S": 24}, in_c=c[order], in_n=n[order])["out_j"]
    wrapped = word[(word > 0) | (np.arange(word.size) < word.size // 2)]  # the last half LSB rounds to a full turn, 0
    assert (np.diff(wrapped) >= 0).all()


@pytest.mark.parametrize(("s", "u"), [(24, 16), (8, 14), (14, 5), (16, 8), (30, 20)])
def test_there_and_back(s, u):
    """The word of a direction, as a unit vector of u fraction bits, comes back within half an LSB of both."""
    word = _sweep(s)
    theta = codecs.decode((Port("j", 2 + s, False, "spread"),), {"j": word})
    c, n = (np.floor(part * 2**u + 0.5).astype(np.int64) for part in truth.unit(theta))
    back = codecs.vector_to_spread({"W": u + 2, "S": s}, in_c=c, in_n=n)["out_j"]
    size = 4 << s
    away = np.abs((back - word + size // 2) % size - size // 2)
    assert (away <= bounds.codec.vector_to_spread(s, u, theta) + 1e-6).all()


def test_no_direction_holds_the_last_word():
    answer = codecs.vector_to_spread({"W": 8, "S": 13}, in_c=np.array([0, 5, 0, -5]), in_n=np.array([0, 5, 0, 0]))
    assert answer["out_j"].tolist() == [0, 1 << 12, 1 << 12, 2 << 13]
    assert answer["out_status"].tolist() == [2, 0, 2, 0]


# The stream codecs at every listed parameter set: their derived bounds, the axes, held words

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
