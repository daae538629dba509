"""Joint codecs against float64: error bounds, monotone and continuous over every quadrant border."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from quadrance import codecs, truth


def _sweep(s: int, count: int = 20000) -> np.ndarray:
    """Every word of a short format; of a long one every border with 2000 neighbours either side and a random rest."""
    if s <= 14:
        return np.arange(4 << s)
    near = np.concatenate([(k << s) + np.arange(-2000, 2001) for k in range(4)])
    rest = np.random.default_rng(5).integers(0, 4 << s, count)
    return np.unique(np.concatenate([near, rest]) % (4 << s))


def _vector(word: np.ndarray, s: int, u: int) -> tuple[np.ndarray, np.ndarray]:
    answer = codecs.spread_to_vector({"S": s, "U": u}, in_j=word)
    return answer["out_c"], answer["out_n"]


@pytest.mark.parametrize(("s", "u"), [(24, 16), (14, 5), (8, 14), (16, 8), (30, 20), (1, 1)])
def test_spread_to_vector_within_half_an_lsb(s, u):
    word = _sweep(s)
    angle = truth.spread_word_to_angle(word, s)
    c, n = _vector(word, s, u)
    slack = 2.0**u * 1e-9  # sin and cos of an angle near a border keep 9 digits of a root
    assert np.abs(c - np.cos(angle) * 2**u).max() <= 0.5 + slack
    assert np.abs(n - np.sin(angle) * 2**u).max() <= 0.5 + slack


@pytest.mark.parametrize(("s", "u"), [(24, 16), (14, 5), (8, 14), (16, 8)])
def test_spread_to_vector_monotone_and_continuous(s, u):
    word = _sweep(s)
    c, n = _vector(word, s, u)
    quadrant = word >> s
    for k, (dc, dn) in enumerate([(-1, 1), (-1, -1), (1, -1), (1, 1)]):
        here = quadrant == k
        # over the border too: the first word of the next quadrant belongs to the run
        first = (k + 1) % 4 << s
        c_run = np.append(c[here], c[word == first])
        n_run = np.append(n[here], n[word == first])
        assert (np.diff(c_run) * dc >= 0).all()
        assert (np.diff(n_run) * dn >= 0).all()
        # the last word and the border are one spread LSB apart: 2^-S in the square, so 2^(-S/2) in the root, rounded
        step = np.sqrt(2.0**-s) * 2**u + 1
        assert abs(int(c_run[-1]) - int(c_run[-2])) <= step
        assert abs(int(n_run[-1]) - int(n_run[-2])) <= step
    one = 1 << u
    assert [(int(c[word == k << s][0]), int(n[word == k << s][0])) for k in range(4)] \
        == [(one, 0), (0, one), (-one, 0), (0, -one)]


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


@pytest.mark.parametrize(("s", "u"), [(24, 16), (8, 14)])
def test_there_and_back(s, u):
    """Half an LSB on both coordinates turns the vector by d <= sqrt(1/2) 2^-u: ds <= |sin 2 theta| d + d^2, and 1/2."""
    word = _sweep(s)
    c, n = _vector(word, s, u)
    back = codecs.vector_to_spread({"W": u + 2, "S": s}, in_c=c, in_n=n)["out_j"]
    size = 4 << s
    away = np.abs((back - word + size // 2) % size - size // 2)
    turn = np.sqrt(0.5) * 2.0**-u / (1 - 2.0**-u)
    twice = np.abs(np.sin(2 * truth.spread_word_to_angle(word, s)))
    assert (away <= (twice * turn + turn**2) * 2.0**s + 0.5 + 1e-6).all()


def test_no_direction_holds_the_last_word():
    answer = codecs.vector_to_spread({"W": 8, "S": 13}, in_c=np.array([0, 5, 0, -5]), in_n=np.array([0, 5, 0, 0]))
    assert answer["out_j"].tolist() == [0, 1 << 12, 1 << 12, 2 << 13]
    assert answer["out_status"].tolist() == [2, 0, 2, 0]
