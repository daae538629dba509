"""Joint words by type, and the codecs against float64: error bounds, monotone over every quadrant border."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from quadrance import bounds, codecs, truth
from quadrance.cores import Port


def _sweep(s: int, count: int = 20000) -> np.ndarray:
    """Every word of a short format; of a long one every border with 2000 neighbours either side and a random rest."""
    if s <= 14:
        return np.arange(4 << s)
    near = np.concatenate([(k << s) + np.arange(-2000, 2001) for k in range(4)])
    rest = np.random.default_rng(5).integers(0, 4 << s, count)
    return np.unique(np.concatenate([near, rest]) % (4 << s))


PORTS = [Port("in_j1", width, signed, of) for of, width, signed in (
    ("spread", 26, False), ("spread", 10, False), ("spread", 32, False), ("angle", 16, False), ("angle", 10, False),
    ("angle", 16, True))]
ANY_PORT = pytest.mark.parametrize("port", PORTS, ids=lambda port: f"{port.type}{port.width}{'s' * port.signed}")


@ANY_PORT
def test_a_word_means_the_angle_it_was_made_of(port):
    theta = np.append(np.random.default_rng(6).uniform(-10, 10, 5000), np.arange(-8, 9) * np.pi / 4)
    word = codecs.encode(port, theta)
    assert word.min() >= port.low and word.max() <= port.high
    assert np.abs(truth.difference(codecs.decode(port, word), theta)).max() <= codecs.half_step(port) + 1e-9
    every = np.random.default_rng(7).integers(port.low, port.high, 5000, endpoint=True)
    if port.width < 30:  # a float64 angle beside a border is not fine enough for every word of more
        assert np.array_equal(codecs.encode(port, codecs.decode(port, every)), every)


@ANY_PORT
def test_words_rise_with_the_angle_and_meet_the_axes(port):
    angle = codecs.decode(port, np.arange(1 << min(port.width, 16)) * 2.0 ** (port.width - min(port.width, 16)))
    assert angle[0] == 0 and np.all(np.diff(angle) > 0) and angle[-1] < truth.TURN
    quadrant = 1 << port.width - 2
    assert codecs.encode(port, np.arange(4) * np.pi / 2).tolist() \
        == [k * quadrant if not port.signed or k < 2 else (k - 4) * quadrant for k in range(4)]


@ANY_PORT
def test_a_cell_ends_half_an_lsb_from_its_word(port):
    word = np.array([(1 << port.width) // 8])
    theta = codecs.decode(port, word)
    for off in (-3, 2):
        border = codecs.decode(port, word + off - 0.5 * np.sign(off))
        assert codecs.within_cell(port, word + off, theta) == pytest.approx(border, abs=1e-12)


@ANY_PORT
def test_a_tie_is_no_error(port):
    """The word before the true one, at a direction just past their common border: nearly no error."""
    turn = 1 << port.width
    theta = codecs.decode(port, np.array([turn // 8 + 0.5 + 1e-4]))
    before, after = (codecs.within_cell(port, np.array([turn // 8 + i]), theta) for i in (0, 1))
    assert abs(before - theta) < 1e-4 * truth.TURN / turn * 8 and after == pytest.approx(theta, abs=1e-12)


@ANY_PORT
def test_cells_wrap_round_the_full_turn(port):
    for theta in (1e-5, -1e-5):
        at = codecs.within_cell(port, np.array([0]), np.array([theta]))
        assert abs(truth.difference(at, theta)) <= max(1e-5 - codecs.half_step(port), 0) + 1e-9
    last = codecs.within_cell(port, np.array([-1 if port.signed else (1 << port.width) - 1]), np.array([0.0]))
    assert abs(truth.difference(last, 0)) <= codecs.half_step(port) * (1 + 1e-9)


def test_half_a_step_is_what_the_pages_say():
    assert np.degrees(codecs.half_step(PORTS[0])) == pytest.approx(0.0099, abs=5e-5)
    assert codecs.half_step(PORTS[3]) == pytest.approx(np.pi / 65536)


def test_signed_angles_are_words_of_their_port():
    port = Port("in_j1", 16, True, "angle")
    assert codecs.encode(port, np.array([-np.pi / 2, 3 * np.pi / 2])).tolist() == [-16384, -16384]
    assert codecs.decode(port, np.array([-16384])) == pytest.approx(3 * np.pi / 2)


def test_a_plain_word_is_no_joint():
    with pytest.raises(ValueError, match="in_x: a port of type None is no joint word; types are spread, angle"):
        codecs.encode(Port("in_x", 16, True), 0.0)


@ANY_PORT
def test_border_words_are_about_every_border(port):
    words = set(codecs.border_words(port).tolist())
    for k in range(4):
        for step in (0, 1, -1, 2, -2, 1 << port.width - 4, -(1 << port.width - 4), 1 << port.width - 3):
            assert int(codecs.fixed.wrap((k << port.width - 2) + step, port.width, port.signed)) in words


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
    theta = codecs.decode(Port("j", 2 + s, False, "spread"), word)
    c, n = (np.floor(part * 2**u + 0.5).astype(np.int64) for part in truth.unit(theta))
    back = codecs.vector_to_spread({"W": u + 2, "S": s}, in_c=c, in_n=n)["out_j"]
    size = 4 << s
    away = np.abs((back - word + size // 2) % size - size // 2)
    assert (away <= bounds.vector_to_spread(s, u, theta) + 1e-6).all()


def test_no_direction_holds_the_last_word():
    answer = codecs.vector_to_spread({"W": 8, "S": 13}, in_c=np.array([0, 5, 0, -5]), in_n=np.array([0, 5, 0, 0]))
    assert answer["out_j"].tolist() == [0, 1 << 12, 1 << 12, 2 << 13]
    assert answer["out_status"].tolist() == [2, 0, 2, 0]
