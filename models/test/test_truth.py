"""The truth itself: against 50-digit arithmetic, independent closed forms and printed golden numbers."""

import mpmath
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from quadrance import truth
from quadrance.truth import TURN

ANGLES = np.linspace(-2 * TURN, 2 * TURN, 97)
angles = st.floats(-10, 10)
lengths = st.floats(0.5, 64)
elbows = st.integers(0, 1)


def rotation(theta):
    """Plane rotation matrix, an independent way to turn a link."""
    return np.array([[np.cos(theta), -np.sin(theta)], [np.sin(theta), np.cos(theta)]])


# Forward kinematics


def test_fk_equals_50_digits():
    rng = np.random.default_rng(1)
    joints, links = rng.uniform(-7, 7, (60, 3)), rng.uniform(0.1, 64, (60, 2))
    x, y, z = truth.fk3(*joints.T, *links.T)
    with mpmath.workdps(50):
        for i, ((t1, t2, t3), (l1, l2)) in enumerate(zip(joints, links)):
            t1, t2, t3, l1, l2 = map(mpmath.mpf, map(float, (t1, t2, t3, l1, l2)))
            rho = l1 * mpmath.cos(t1) + l2 * mpmath.cos(t1 + t2)
            exact = (rho * mpmath.cos(t3), rho * mpmath.sin(t3), l1 * mpmath.sin(t1) + l2 * mpmath.sin(t1 + t2))
            assert max(abs(a - b) for a, b in zip((x[i], y[i], z[i]), exact)) < 1e-12


@given(angles, angles, lengths, lengths)
def test_fk2_is_two_complex_exponentials(t1, t2, l1, l2):
    z = l1 * np.exp(1j * t1) + l2 * np.exp(1j * (t1 + t2))
    assert truth.fk2(t1, t2, l1, l2) == pytest.approx((z.real, z.imag), abs=1e-12)
    assert truth.fk1(t1, l1) == pytest.approx((l1 * rotation(t1) @ [1, 0]).tolist(), abs=1e-12)


@given(angles, angles, angles, lengths, lengths)
def test_fk3_is_a_product_of_matrices(t1, t2, t3, l1, l2):
    plane = rotation(t1) @ ([l1, 0] + rotation(t2) @ [l2, 0])
    horizontal = rotation(t3) @ [plane[0], 0]
    assert truth.fk3(t1, t2, t3, l1, l2) == pytest.approx((*horizontal, plane[1]), abs=1e-12)


def test_worked_example_of_the_paper():
    """Section III-D, row 2 of Table II: joint 2 turns clockwise into its second quadrant."""
    q1, q2, s1, s2, s3 = 9, 4, 0.5, 0.6, 0.3
    theta = np.arcsin(np.sqrt(s1)), -(np.pi - np.arcsin(np.sqrt(s2))), np.arcsin(np.sqrt(s3))
    x, y, z = truth.fk3(*theta, 3, 2)
    assert (x, y, z) == pytest.approx((1.9430075965662645, 1.2719970553055894, 0.13144803754939447), rel=1e-13)
    q3 = x * x + y * y + z * z
    assert q3 == pytest.approx(5.4105336155958896, rel=1e-13)
    assert q3 == pytest.approx(q1 + q2 - 2 * np.sqrt(q1 * q2 * (1 - s2)), rel=1e-13)
    spread = s2 * q2 / q3
    assert spread == pytest.approx(0.44357916806615678, rel=1e-13)
    s_a = (np.sqrt(s1 * (1 - spread)) - np.sqrt(spread * (1 - s1))) ** 2
    assert s_a == pytest.approx(0.0031935087743991476, rel=1e-12)
    assert z * z / q3 == pytest.approx(s_a, rel=1e-10)
    assert (x * x, y * y, z * z) == pytest.approx(
        (3.7752785203142118, 1.6179765087060908, 0.017278586575587018), rel=1e-12)
    third = truth.fk3(theta[0], theta[1], theta[2] + np.pi, 3, 2)
    assert third == pytest.approx((-x, -y, z), rel=1e-12)


@pytest.mark.parametrize("octant", range(1, 9))
def test_mff_octants_are_spherical_coordinates(octant):
    """Every octant by an angle pair in it; theta from the y axis, phi from +z."""
    signs = truth.OCTANT_SIGNS[octant - 1]
    theta = np.arctan2(signs[0] * 0.6, signs[1] * 0.8)
    phi = 0.7 if signs[2] > 0 else np.pi - 0.7
    expected = 5 * np.array([np.sin(phi) * np.sin(theta), np.sin(phi) * np.cos(theta), np.cos(phi)])
    one = truth.mff([np.sin(theta) ** 2], [np.sin(phi) ** 2], [octant], [25])
    assert one == pytest.approx(expected[None], abs=1e-12)


def test_mff_octants_are_all_different_and_positions_add_up():
    assert len({tuple(row) for row in truth.OCTANT_SIGNS}) == 8
    chain = truth.mff([0.2, 0.5, 1.0], [0.5, 0.9, 1.0], [1, 7, 4], [4, 9, 16])
    alone = np.concatenate([truth.mff([s], [p], [o], [q]) for s, p, o, q in
                            zip([0.2, 0.5, 1.0], [0.5, 0.9, 1.0], [1, 7, 4], [4, 9, 16])])
    assert chain == pytest.approx(np.cumsum(alone, axis=0))
    assert np.linalg.norm(alone, axis=1) == pytest.approx([2, 3, 4])


# Inverse kinematics


@given(angles, lengths)
def test_ik1_inverts_fk1(t1, l1):
    assert truth.difference(truth.ik1(*truth.fk1(t1, l1)), t1) == pytest.approx(0, abs=1e-12)


@given(st.floats(-100, 100), st.floats(-100, 100), lengths, lengths, elbows)
def test_ik2_reaches_the_target_or_the_nearest_point(x, y, l1, l2, elbow):
    radius = np.hypot(x, y)
    assume(radius > 1e-3)
    t1, t2 = truth.ik2(x, y, l1, l2, elbow)
    nearest = np.clip(radius, abs(l1 - l2), l1 + l2) / radius
    assert truth.fk2(t1, t2, l1, l2) == pytest.approx((x * nearest, y * nearest), abs=1e-6)
    assert t2 <= 0 if elbow else t2 >= 0
    assert abs(truth.reach(x, y, l1, l2)) == pytest.approx(radius * abs(nearest - 1), abs=1e-9)


@given(st.floats(-3, 3), st.floats(0.05, 3.05), lengths, lengths, elbows)
def test_ik2_returns_the_joints_it_came_from(t1, t2, l1, l2, elbow):
    t2 = -t2 if elbow else t2
    assume(np.hypot(*truth.fk2(t1, t2, l1, l2)) > 0.1)
    back = truth.ik2(*truth.fk2(t1, t2, l1, l2), l1, l2, elbow)
    assert truth.difference(back, (t1, t2)) == pytest.approx((0, 0), abs=1e-7)


def test_ik2_equals_50_digits():
    """The law of cosines and atan2 in 50 digits, away from the border cases that have their own tests."""
    rng = np.random.default_rng(2)
    l1, l2 = rng.uniform(1, 64, 50), rng.uniform(1, 64, 50)
    x, y = truth.fk2(rng.uniform(-3, 3, 50), rng.uniform(0.1, 3, 50), l1, l2)
    got = np.stack(truth.ik2(x, y, l1, l2), axis=-1)
    with mpmath.workdps(50):
        for i in range(50):
            px, py, a, b = (mpmath.mpf(float(v[i])) for v in (x, y, l1, l2))
            q3 = px * px + py * py
            t2 = mpmath.acos((q3 - a * a - b * b) / (2 * a * b))
            t1 = mpmath.atan2(py, px) - mpmath.acos((a * a + q3 - b * b) / (2 * a * mpmath.sqrt(q3)))
            assert truth.difference(got[i], (float(t1), float(t2))) == pytest.approx((0, 0), abs=1e-10)


@pytest.mark.parametrize("elbow", (0, 1))
def test_ik2_borders(elbow):
    sign = -1 if elbow else 1
    for at in ANGLES:
        stretched = truth.ik2(5 * np.cos(at), 5 * np.sin(at), 3, 2, elbow)
        assert truth.difference(stretched, (at, 0)) == pytest.approx((0, 0), abs=1e-7)
        folded = truth.ik2(np.cos(at), np.sin(at), 3, 2, elbow)
        assert truth.difference(folded, (at, sign * np.pi)) == pytest.approx((0, 0), abs=1e-6)
        short = truth.ik2(0.5 * np.cos(at), 0.5 * np.sin(at), 2, 3, elbow)  # inside the hole, L1 < L2
        assert truth.difference(short, (at + np.pi, sign * np.pi)) == pytest.approx((0, 0), abs=1e-12)
    assert np.isnan(truth.ik2(0, 0, 3, 3, elbow)[0]) and np.isnan(truth.ik1(0, 0))


@given(angles, angles, angles, lengths, lengths, elbows, elbows)
def test_ik3_every_branch_reaches_the_target(t1, t2, t3, l1, l2, elbow, back):
    x, y, z = truth.fk3(t1, t2, t3, l1, l2)
    assume(np.hypot(x, y) > 1e-2)
    joints = truth.ik3(x, y, z, l1, l2, elbow, back)
    assert truth.fk3(*joints, l1, l2) == pytest.approx((x, y, z), abs=1e-6)
    rho, _ = truth.fk2(joints[0], joints[1], l1, l2)
    assert rho < 0 if back else rho > 0
    assert joints[1] <= 0 if elbow else joints[1] >= 0


def test_ik3_four_branches_are_different():
    solutions = {tuple(np.round(truth.ik3(3, 1, 2, 3, 2.5, e, b), 6)) for e in (0, 1) for b in (0, 1)}
    assert len(solutions) == 4


def test_ik3_on_the_yaw_axis_keeps_the_plane_joints():
    t1, t2, t3 = truth.ik3(0, 0, 3, 3, 2)
    assert np.isnan(t3) and truth.fk2(t1, t2, 3, 2) == pytest.approx((0, 3), abs=1e-12)


# Codings


@pytest.mark.parametrize("s", (2, 8, 16, 24))
def test_spread_word_is_the_table_of_the_paper(s):
    """Spread and signs of Table I (MATHS reading): s = f in quadrants 1 and 3, 1 - f in 2 and 4."""
    word = np.unique(np.r_[0:min(4 << s, 4096), (np.arange(1, 5)[:, None] << s).ravel() - 1])
    theta = truth.spread_word_to_angle(word, s)
    k, f = word >> s, (word & (1 << s) - 1) / 2.0**s
    c, n = truth.unit(theta)
    assert n * n == pytest.approx(np.where(k % 2 == 0, f, 1 - f), abs=1e-14)
    inside = f > 0
    assert np.array_equal((c < 0)[inside], np.isin(k, (1, 2))[inside])
    assert np.array_equal((n < 0)[inside], np.isin(k, (2, 3))[inside])
    assert np.all(np.diff(theta) > 0) and theta[0] == 0 and theta[-1] < TURN
    assert np.array_equal(truth.angle_to_spread_word(theta, s), word)


def test_spread_word_equals_50_digits():
    with mpmath.workdps(50):
        for word in (0, 1, 2, 255, 256, 300, (1 << 24) - 1, 1 << 24, 3 << 23, (4 << 24) - 1):
            k, f = word >> 24, mpmath.mpf(word & (1 << 24) - 1) / (1 << 24)
            exact = k * mpmath.pi / 2 + mpmath.asin(mpmath.sqrt(f))
            assert abs(truth.spread_word_to_angle(word, 24) - exact) < 1e-15 * (1 + exact)


@given(angles, st.integers(2, 28))
def test_nearest_spread_word(theta, s):
    word = truth.angle_to_spread_word(theta, s)
    exact = truth.angle_to_spread(theta, s)
    off = (word - exact + (2 << s)) % (4 << s) - (2 << s)
    assert abs(off) <= 0.5 + 1e-6
    step = np.arcsin(2 ** (-s / 2))  # the law of MATHS: the coarsest step lies at a quadrant border
    assert abs(truth.difference(truth.spread_word_to_angle(word, s), theta)) <= step


def test_spread_step_at_the_border_is_what_the_mathematics_says():
    assert np.degrees(truth.spread_word_to_angle(1, 8)) == pytest.approx(3.58, abs=0.01)
    assert np.degrees(truth.spread_word_to_angle(1, 16)) == pytest.approx(0.22, abs=0.005)


@given(angles, st.integers(4, 30))
def test_nearest_binary_word(theta, a):
    word = truth.angle_to_binary_word(theta, a)
    assert 0 <= word < 1 << a
    assert abs(truth.difference(truth.binary_word_to_angle(word, a), theta)) <= np.pi * 2.0**-a + 1e-12


def test_binary_words_exact_and_signed():
    word = np.arange(1 << 10)
    theta = truth.binary_word_to_angle(word, 10)
    assert np.array_equal(truth.angle_to_binary_word(theta, 10), word)
    assert truth.binary_word_to_angle(-256, 10) == pytest.approx(1.5 * np.pi)
    assert theta[[128, 256, 512]] == pytest.approx([np.pi / 4, np.pi / 2, np.pi])


@given(angles)
def test_half_tangent_round_trip(theta):
    assume(abs(abs(truth.difference(theta, 0)) - np.pi) > 1e-6)
    t = truth.half_tangent(theta)
    assert t == pytest.approx(np.tan(theta / 2), rel=1e-9, abs=1e-12)
    assert truth.half_tangent_to_unit(t) == pytest.approx(truth.unit(theta), abs=1e-12)


def test_unit_and_angle():
    c, n = truth.unit(ANGLES)
    assert c + 1j * n == pytest.approx(np.exp(1j * ANGLES), abs=1e-12)
    assert truth.difference(truth.angle(c, n), ANGLES) == pytest.approx(0 * ANGLES, abs=1e-12)
    assert np.isnan(truth.angle(0, 0))
