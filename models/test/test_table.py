"""table_* models against float64: derived error bounds at every listed parameter set, borders, status."""

import numpy as np
import pytest
from quadrance import bounds, codec_wide, codecs, cores, table, truth

from models.test.claims import distinct

LISTED = {core.id: core for core in distinct() if core.family == "table"}
FINE = {"W": 18, "F": 8, "A": 20}
SHARES = [(0.5, 0.5), (1.0, 0.0), (0.0, 1.0), (0.62, 0.38), (0.05, 0.03)]
DEFAULT = {"W": 16, "F": 8, "A": 18}
LONG = [{"W": 21, "F": 13, "A": 11}, {"W": 22, "F": 14, "A": 20}, {"W": 23, "F": 15, "A": 19},
        {"W": 24, "F": 16, "A": 12}, {"W": 24, "F": 16, "A": 20}]


def _sets(function: str) -> list:
    """Parameters of the listed sets of one function, and one that is not listed."""
    return [pytest.param(core.params, id=core.set_id) for core in LISTED.values() if core.function == function] \
        + [pytest.param(FINE, id="W18A20")]


def _words(rng: np.random.Generator, a: int, count: int) -> np.ndarray:
    """Uniform words, and words about every quadrant border at every scale."""
    words = rng.integers(0, 1 << a, count)
    near = rng.integers(0, 1 << a - 2, count // 2) >> rng.integers(0, a - 2, count // 2)
    words[::2] = (rng.integers(0, 4, count // 2) << a - 2) + rng.choice([-1, 1], count // 2) * near
    return words & (1 << a) - 1


def _angle(p: dict[str, int], word: np.ndarray) -> np.ndarray:
    return truth.TURN / 2 ** p["A"] * word


# Forward


@pytest.mark.parametrize("joints", [1, 2, 3])
@pytest.mark.parametrize("p", [DEFAULT, FINE, {"W": 15, "F": 7, "A": 12}, {"W": 19, "F": 0, "A": 10}, *LONG],
                         ids=lambda p: f"W{p['W']}A{p['A']}")
def test_sines_are_within_their_bound_and_never_step_back(p, joints):
    """A parabola may step back by two units, of which an LSB of a coordinate has eight or more."""
    words = np.arange(1 << p["A"])
    for root, exact in zip(table._unit(p, joints, words), truth.unit(_angle(p, words))):
        error = np.abs(root / 2.0 ** (p["W"] + 1) - exact).max()
        least = 0.5 if p["W"] <= 20 or p["A"] > 12 else 0.3  # two places in each parabola meet no worst one
        assert least * bounds.table.sine(p, joints) < error <= bounds.table.sine(p, joints)
        assert (np.diff(root) * np.sign(np.diff(exact)) >= (0 if p["W"] <= 20 else -2)).all()
        assert -(1 << p["W"] + 1) <= root.min() and root.max() < 1 << p["W"] + 1


@pytest.mark.parametrize("p", _sets("fk1"))
@pytest.mark.parametrize("share", [1.0, 0.51, 0.01, 2.0])
def test_fk1_error(p, share):
    length = int(share * 2 ** (p["W"] - 2))
    words = np.arange(1 << p["A"]) if p["A"] <= 18 else _words(np.random.default_rng(1), p["A"], 300_000)
    answer = table.fk1(p, in_j1=words, cfg_l1=length)
    exact = truth.fk1(_angle(p, words), length)
    high = 2 ** (p["W"] - 1)
    error = np.abs([answer[f"out_{axis}"] - np.clip(value, -high, high - 1) for axis, value in zip("xy", exact)])
    assert 0.499 <= error.max() <= bounds.table.forward(p, 1, length, 0)
    if share <= 1 and p["A"] >= p["W"]:
        assert error.max() <= 0.8 and np.hypot(*error).max() <= 1.0
    assert answer["out_status"].any() == (share == 2.0)  # 1.0 does not fit the word


@pytest.mark.parametrize("joints", [2, 3])
@pytest.mark.parametrize("share", SHARES)
@pytest.mark.parametrize("p", [DEFAULT, FINE, {"W": 20, "F": 10, "A": 24}, {"W": 15, "F": 7, "A": 12}, *LONG,
                               {"W": 24, "F": 16, "A": 24}],
                         ids=lambda p: f"W{p['W']}A{p['A']}")
def test_fk2_and_fk3_error(p, share, joints):
    rng = np.random.default_rng(2)
    l1, l2 = (int(part * 2 ** (p["W"] - 2)) for part in share)
    words = {f"in_j{i + 1}": _words(rng, p["A"], 200_000) for i in range(joints)}
    answer = (table.fk2 if joints == 2 else table.fk3)(p, **words, cfg_l1=l1, cfg_l2=l2)
    exact = (truth.fk2 if joints == 2 else truth.fk3)(*(_angle(p, word) for word in words.values()), l1, l2)
    error = np.abs([answer[f"out_{axis}"] - value for axis, value in zip("xyz", exact)])
    assert 0.5 < error.max() <= bounds.table.forward(p, joints, l1, l2)
    assert error.max() <= (1.0 if p["W"] <= 20 else 1.3)
    assert not answer["out_status"].any()


@pytest.mark.parametrize("p", [DEFAULT, FINE, *LONG[1:]], ids=lambda p: f"W{p['W']}A{p['A']}")
def test_borders_are_exact(p):
    length = np.arange(0, 1 << p["W"] - 1, 1 if p["W"] == 16 else 5 if p["W"] < 20 else 101)
    half = length // 2
    for k, (c, n) in enumerate([(1, 0), (0, 1), (-1, 0), (0, -1)]):
        word = np.full(length.shape, k << p["A"] - 2)
        one = table.fk1(p, in_j1=word, cfg_l1=length)
        assert (one["out_x"] == c * length).all() and (one["out_y"] == n * length).all()
        two = table.fk2(p, in_j1=word, in_j2=0 * word, cfg_l1=half, cfg_l2=half)
        assert (two["out_x"] == 2 * c * half).all() and (two["out_y"] == 2 * n * half).all()


def test_overflow_is_flagged_exactly_where_a_coordinate_leaves_the_word():
    rng = np.random.default_rng(4)
    words = [_words(rng, 18, 100_000) for _ in range(3)]
    angles = [_angle(DEFAULT, word) for word in words]
    cases = ((table.fk1(DEFAULT, in_j1=words[0], cfg_l1=40_000), truth.fk1(angles[0], 40_000)),
             (table.fk2(DEFAULT, in_j1=words[0], in_j2=words[1], cfg_l1=40_000, cfg_l2=30_000),
              truth.fk2(*angles[:2], 40_000, 30_000)),
             (table.fk3(DEFAULT, in_j1=words[0], in_j2=words[1], in_j3=words[2], cfg_l1=40_000, cfg_l2=30_000),
              truth.fk3(*angles, 40_000, 30_000)))
    for answer, exact in cases:
        exact = np.array(exact)
        over = np.any((exact > 32767.5) | (exact < -32768.5), axis=0)
        clear = np.min(np.minimum(np.abs(exact - 32767.5), np.abs(exact + 32768.5)), axis=0) > 5  # not on the edge
        assert over.any() and np.array_equal((answer["out_status"] == 4)[clear], over[clear])
        assert set(np.unique(answer["out_status"])) == {0, 4}
        for axis, value in zip("xyz", exact):
            assert np.max(np.abs(answer[f"out_{axis}"] - np.clip(value, -32768, 32767))) <= 5


def test_an_arm_that_leans_back_lands_behind_the_yaw_axis():
    answer = table.fk3(DEFAULT, in_j1=np.array([3 << 15]), in_j2=np.array([0]), in_j3=np.array([0]), cfg_l1=1000,
                       cfg_l2=1000)
    assert answer["out_x"][0] == -1414 and answer["out_y"][0] == 0 and answer["out_z"][0] == 1414


# Inverse


def _cell_error(a: int, x: np.ndarray, y: np.ndarray, word: np.ndarray) -> np.ndarray:
    """Angle (rad) from (x, y) to the nearest direction that rounds to `word`."""
    theta = np.arctan2(y, x)
    within = codecs.within_cell((cores.Port("j", a, False, "angle"),), {"j": word}, theta)
    return np.abs(truth.difference(within, theta))


@pytest.mark.parametrize("a", [10, 16, 18, 24])
def test_ik1_error(a):
    """Of all lengths, half of them with a coordinate where the tables' error is largest; 0.42 LSB at 2^14 at A = 18."""
    p = DEFAULT | {"A": a}
    rng = np.random.default_rng(4)
    angle, size = rng.uniform(-np.pi, np.pi, 400_000), np.exp(rng.uniform(0, np.log(46000), 400_000))
    x, y = (np.clip(np.round(size * f(angle)), -32768, 32767).astype(np.int64) for f in (np.cos, np.sin))
    x[:100_000] = rng.choice([-1, 1], 100_000) * rng.integers(16384, 16600, 100_000)
    keep = (x != 0) | (y != 0)
    x, y = x[keep], y[keep]
    found = _cell_error(a, x, y, table.ik1(p, in_x=x, in_y=y)["out_j1"]).max()
    assert found <= bounds.table.direction(p)
    assert a < 18 or 0.2 < found * 2**14 < 0.42


@pytest.mark.parametrize("p", [LISTED["table_ik1-W8A24"].params, {"W": 8, "F": 4, "A": 18}], ids=["A24", "A18"])
def test_ik1_error_of_every_short_point(p):
    x, y = (grid.ravel() for grid in np.meshgrid(np.arange(-128, 128), np.arange(-128, 128)))
    answer = table.ik1(p, in_x=x, in_y=y)
    zero = (x == 0) & (y == 0)
    assert (answer["out_status"] == np.where(zero, 2, 0)).all()
    assert _cell_error(p["A"], x[~zero], y[~zero], answer["out_j1"][~zero]).max() <= bounds.table.direction(p)


@pytest.mark.parametrize(("w", "a"), [(17, 10), (17, 24), (20, 18), (20, 22), (20, 24), (23, 24), (24, 22), (24, 24)])
def test_ik1_error_of_long_words(w, a):
    """Of all lengths, half of them short or next to an axis."""
    p, rng, high = {"W": w, "F": 8, "A": a}, np.random.default_rng(a), 1 << w - 1
    angle, size = rng.uniform(-np.pi, np.pi, 300_000), np.exp(rng.uniform(0, np.log(1.4 * high), 300_000))
    x, y = (np.clip(np.round(size * f(angle)), -high, high - 1).astype(np.int64) for f in (np.cos, np.sin))
    x[::4], y[1::4] = rng.integers(-9, 10, (2, 75_000))
    keep = (x != 0) | (y != 0)
    x, y = x[keep], y[keep]
    found, law = _cell_error(a, x, y, table.ik1(p, in_x=x, in_y=y)["out_j1"]).max(), bounds.table.direction(p)
    assert 0.25 * law < found <= law


def test_ik1_error_where_the_tangent_is_longest():
    """M one bit longer than its half, m all of it: the tangent comes next to -2 and 2 and may not go beyond."""
    edge = np.append(np.arange(32700, 32768), -32768)
    m, long = (grid.ravel() for grid in np.meshgrid(edge, np.arange(16384, 16450)))
    for x, y in ((m, long), (long, m), (-m, long), (long, -m), (m, -long), (-long, m), (-m, -long), (-long, -m)):
        x, y = np.clip(x, -32768, 32767), np.clip(y, -32768, 32767)
        word = table.ik1(DEFAULT, in_x=x, in_y=y)["out_j1"]
        assert _cell_error(18, x, y, word).max() <= bounds.table.direction(DEFAULT)


def test_ik1_is_exact_on_every_axis():
    length = np.arange(1, 1 << 15)
    for k, (c, n) in enumerate([(1, 0), (0, 1), (-1, 0), (0, -1)]):
        assert (table.ik1(DEFAULT, in_x=c * length, in_y=n * length)["out_j1"] == k << 16).all()


def test_ik1_holds_the_last_word_where_there_is_no_direction():
    answer = table.ik1(DEFAULT, in_x=np.array([0, 0, 0, -5, 0]), in_y=np.array([0, 7, 0, 0, 0]))
    assert answer["out_j1"].tolist() == [0, 1 << 16, 1 << 16, 2 << 16, 2 << 16]
    assert answer["out_status"].tolist() == [2, 0, 2, 0, 2]


@pytest.mark.parametrize("length", [1000, 8320, 16384])
def test_one_joint_there_and_back(length):
    """ik1 of fk1 returns the direction within both bounds: the tip's distance, 1 LSB, and ik1's own."""
    word = np.arange(1 << 18)
    tip = table.fk1(DEFAULT, in_j1=word, cfg_l1=length)
    back = table.ik1(DEFAULT, in_x=tip["out_x"], in_y=tip["out_y"])["out_j1"]
    turned = _cell_error(18, *truth.fk1(_angle(DEFAULT, word), length), back)
    assert turned.max() <= 1.0 / (length - 1) + bounds.table.direction(DEFAULT)


# Inverse, two and three joints: as rtl/vector but for the codec; models/test/test_vector.py has the kernel's law

LINKS = [(8192, 8192), (8320, 7040), (12000, 4384), (16000, 300), (300, 16000), (768, 512), (30, 20), (5, 2),
         (16384, 16384), (30000, 2000)]


def _angle_of_vector(a: int, c: np.ndarray, n: np.ndarray, fraction: int) -> np.ndarray:
    """The codec behind the kernel whose words have these fraction bits."""
    return codecs.angle_of_vector(a, c, n) if fraction == 20 else codec_wide.angle_of_vector(a, c, n, fraction)


@pytest.mark.parametrize("fraction", [20, 22, 26])
@pytest.mark.parametrize("a", [10, 11, 14, 18, 21, 24])
def test_the_angle_of_a_vector(a, fraction):
    rng = np.random.default_rng(a)
    theta = rng.uniform(0, truth.TURN, 300_000)
    near = rng.choice([-1, 1], 100_000) * 2.0 ** rng.uniform(-22, 0, 100_000)
    theta[::3] = np.pi / 2 * rng.integers(0, 4, 100_000) + near
    theta[1::3] = rng.choice([1, -1], 100_000) * np.arccos(rng.choice([1, -1], 100_000) * 0.75) \
        + rng.normal(size=100_000) * 1e-5
    c, n = (np.floor(part * 2.0**fraction).astype(np.int64) for part in truth.unit(theta))
    word, law = _angle_of_vector(a, c, n, fraction), bounds.codec.angle_of_vector(a, fraction=fraction)
    error = np.abs(truth.difference(word * truth.TURN / 2**a, theta)) - np.pi / 2**a
    assert 0.55 * law < error.max() <= law


@pytest.mark.parametrize("fraction", [20, 22])
@pytest.mark.parametrize("a", [10, 18, 24])
def test_the_angle_of_a_vector_follows_every_cosine(a, fraction):
    """All of m, from one end to the other and on to the sine: the angle falls, by no more than a unit beside it."""
    one = 1 << fraction
    c = np.arange(-one, one + 1)
    n = np.floor(np.sqrt(float(one) ** 2 - c.astype(float) ** 2)).astype(np.int64)
    word = _angle_of_vector(a, c, n, fraction).astype(np.int64)
    exact = np.arccos(c / one) * 2**a / truth.TURN
    inside, law = np.abs(c) < one, bounds.codec.angle_of_vector(a, fraction=fraction)
    assert np.all(np.abs(word - exact)[inside] <= 0.5 + (law + 1.6 / one) * 2**a / truth.TURN)
    small = np.abs(c) < 3 * one // 4
    assert np.all(np.diff(word[small]) <= (1 if a > 20 or fraction > 20 else 0))


def test_the_angle_of_a_long_vector_is_that_of_every_segment():
    """At both ends of every segment and of every step of its slope, m with 26 fraction bits."""
    steps = np.arange(-192 << 8, 192 << 8) << 10
    c = np.concatenate([steps, steps + 1, steps - 1, steps + 511])
    n = np.rint(np.sqrt(2.0**52 - c.astype(float) ** 2)).astype(np.int64)
    for sign in (1, -1):
        word = _angle_of_vector(24, c, sign * n, 26)
        off = truth.difference(word * truth.TURN / 2**24, np.arctan2(sign * n, c))
        assert np.abs(off).max() <= np.pi / 2**24 + bounds.codec.angle_of_vector(24, fraction=26)


@pytest.mark.parametrize("joints", [2, 3])
@pytest.mark.parametrize(("w", "a"), [(16, 18), (16, 24), (18, 24), (20, 22), (22, 24), (24, 24)])
@pytest.mark.parametrize(("l1", "l2"), LINKS)
def test_inverse_puts_the_tip_within_its_bound(l1, l2, w, a, joints):
    p, rng, count = {"W": w, "F": 8, "A": a}, np.random.default_rng(l1 + a + w - 16), 40_000 if w == 16 else 10_000
    l1, l2 = l1 << w - 16, l2 << w - 16
    way = rng.normal(size=(joints, count))
    radius = rng.uniform(abs(l1 - l2), l1 + l2, count)
    near = rng.exponential(4, count // 4)
    radius[::4] = np.where(rng.random(near.size) < 0.5, abs(l1 - l2) + near, l1 + l2 - near)
    target = np.rint(way / np.linalg.norm(way, axis=0) * radius).astype(np.int64)
    q = (target * target).sum(axis=0)
    keep = (q <= (l1 + l2) ** 2) & (q >= (l1 - l2) ** 2) & (np.abs(target) < 1 << w - 1).all(axis=0) & (q > 0) \
        & (target[:2] != 0).any(axis=0)
    target, q, elbow = target[:, keep], q[keep], rng.integers(0, 2, count)[keep]
    solve, forward = (table.ik2, truth.fk2) if joints == 2 else (table.ik3, truth.fk3)
    out = solve(p, **dict(zip(("in_x", "in_y", "in_z"), target)), in_elbow=elbow, cfg_l1=l1, cfg_l2=l2,
                **table.config(p, cfg_l1=l1, cfg_l2=l2))
    theta = [_angle(p, out[f"out_j{joint + 1}"]) for joint in range(joints)]
    error = np.linalg.norm(np.stack(forward(*theta, l1, l2)) - target, axis=0)
    n2 = np.sqrt(((l1 + l2) ** 2 - q) * (q - (l1 - l2) ** 2.0)) / (2 * l1 * l2)
    law = bounds.table.ik2(p, l1, l2, np.sqrt(q), n2) if joints == 2 else bounds.table.ik3(p, l1, l2, target, n2)
    answered = out["out_status"] == 0
    assert answered.mean() > 0.95 and np.all((error <= law)[answered])
    if w == 16 and l1 + l2 <= 16384 and a == 24:  # 64 units of Q7.8; of the words half a step is 0.002 LSB
        assert np.max(error[q >= 256**2], initial=0) <= 0.3
    bend = truth.difference(theta[1], 0 * theta[1])
    assert np.all((bend * (1 - 2 * elbow) >= -truth.TURN / 2 ** min(a, 21)) | (np.abs(np.abs(bend) - np.pi) < 1e-6))


def test_the_laws_of_long_words_are_those_of_the_page():
    """Links that take a reach of a quarter of the word, from a quarter of it on; all pitches of the plane."""
    half, pitch = np.meshgrid(np.linspace(0, np.arccos(0.25), 400), np.linspace(0, np.pi / 2, 60))
    n2, worst = np.abs(np.sin(2 * half.ravel())), []
    for w in (20, 22):
        p, length = {"W": w, "F": 8, "A": 24}, 1 << w - 3
        away = 2 * length * np.cos(half.ravel())
        target = np.stack([away * np.cos(pitch.ravel()), 0 * away, away * np.sin(pitch.ravel())])
        worst += [bounds.table.ik2(p, length, length, away, n2).max(),
                  bounds.table.ik3(p, length, length, target, n2).max()]
    two, two_longer, three, three_longer = np.round([worst[0], worst[2], worst[1], worst[3]], 2)
    page = (cores.RTL / "table" / "README.md").read_text()
    assert f"bound of table_ik2 is {two} LSB at W = 20 and {two_longer} at W = 22" in page
    assert f"that of table_ik3 {three} and {three_longer}." in page


def test_inverse_is_straight_or_folded_out_of_reach():
    x, y = np.array([30000, 100, -30000, 5]), np.array([0, 0, 20000, -90])
    out = table.ik2(DEFAULT, in_x=x, in_y=y, in_elbow=np.array([0, 1, 1, 0]), cfg_l1=9000, cfg_l2=8000,
                    **table.config(DEFAULT, cfg_l1=9000, cfg_l2=8000))
    assert out["out_status"].tolist() == [1, 1, 1, 1]
    assert out["out_j2"].tolist() == [0, 1 << 17, 0, 1 << 17]
    off = truth.difference(_angle(DEFAULT, out["out_j1"]), np.arctan2(y, x))
    assert np.abs(off).max() <= np.pi / 2**18 + 2 * bounds.codec.angle_of_vector(18)
