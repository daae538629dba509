"""Status bits of the engines, the parallel robots and six axes, and the steps of a descent, from the pages."""

from __future__ import annotations

import math
import random
from fractions import Fraction

import numpy as np
from quadrance import six
from quadrance.iterative import fixed, plane
from quadrance.truth_six import Six, fk6

from models.test.oracles import ask, flags, oracle

TURN = 2 * math.pi


# Descents


def planar(core, row: dict, cfg: dict) -> tuple[float, float, list[tuple[float, float]]]:
    """E of a start in LSB, and the two links as vectors."""
    a, b = (row[f"j{i}"] * TURN / 2 ** core.params["A"] for i in (1, 2))
    links = [(cfg["l1"] * math.cos(a), cfg["l1"] * math.sin(a)),
             (cfg["l2"] * math.cos(a + b), cfg["l2"] * math.sin(a + b))]
    return row["x"] - links[0][0] - links[1][0], row["y"] - links[0][1] - links[1][1], links


def start(core, j1: float, j2: float, ahead: float, aside: float, length: float) -> dict:
    """A sample that starts at joints in radians, with its target `ahead` and `aside` of the tip, in LSB."""
    a = 2 ** core.params["A"]
    x = length * (math.cos(j1) + math.cos(j1 + j2)) + ahead
    y = length * (math.sin(j1) + math.sin(j1 + j2)) + aside
    return {"x": round(x), "y": round(y), "j1": round(j1 / TURN * a) % a, "j2": round(j2 / TURN * a) % a, "warm": 0}


@oracle("engine.quaternion_gd", status=("not_converged",), cfg=("alpha", "shift"))
def test_a_step_of_descent(core):
    """theta += alpha J^T E with alpha = gain / max(L1, L2)^2: what one step moves the joints by."""
    length = 1 << core.params["W"] - 3
    for l2, gain in ((length, 0.33), (length // 2, 0.33), (length, 0.05)):
        words = fixed.config(core.params, cfg_l1=length, cfg_l2=l2, gain=gain)
        cfg = {"l1": length, "l2": l2, "tol": 0, "limit": 1} | {name[4:]: word for name, word in words.items()}
        row = start(core, 0.4, 1.1, 0, 0, length)
        ex, ey, _ = planar(core, row, cfg)
        row |= {"x": round(row["x"] - ex + length / 40), "y": round(row["y"] - ey - length / 50)}
        ex, ey, links = planar(core, row, cfg)
        found = ask(core, [row], cfg)[0]
        alpha = gain / length**2 / TURN * 2 ** core.params["A"]
        for i, (x, y) in enumerate(links, 1):
            exact = alpha * (x * ey - y * ex)
            assert abs(found[f"d{i}"] - exact) <= 0.002 * abs(exact) + 2
        assert found["status"] == 8 and found["iters"] == 1


@oracle("engine.quaternion_gd_vector", cfg=("alpha", "shift"))
def test_a_step_of_descent_of_vectors(core):
    """The same in radians, of directions of links; words of it in 2^-(W + 4)."""
    w = core.params["W"]
    length, one = 1 << w - 3, 1 << w
    words = fixed.config_vector(core.params, cfg_l1=length, cfg_l2=length, gain=0.33)
    cfg = {"l1": length, "l2": length, "tol": 0, "limit": 1} | {name[4:]: word for name, word in words.items()}
    a, b = 0.4, 1.5
    row = {"c1": round(one * math.cos(a)), "n1": round(one * math.sin(a)), "c12": round(one * math.cos(b)),
           "n12": round(one * math.sin(b)), "warm": 0}
    tip = length * (math.cos(a) + math.cos(b)), length * (math.sin(a) + math.sin(b))
    row |= {"x": round(tip[0] + length / 40), "y": round(tip[1] - length / 50)}
    ex, ey = row["x"] - tip[0], row["y"] - tip[1]
    found = ask(core, [row], cfg)[0]
    e1, e2 = (0.33 / length * (math.cos(t) * ey - math.sin(t) * ex) * 2 ** (w + 4) for t in (a, b))
    assert abs(found["d1"] - e1 - e2) <= 0.002 * abs(e1) + 8 and abs(found["d12"] - e1 - 2 * e2) <= 0.002 * abs(e1) + 8


@oracle("engine.quaternion_gd_touch", cfg=("alpha", "shift"))
def test_a_step_of_descent_of_the_touch(core):
    """tip = (-s1 rho, L1 s2 - L2 c3, c1 rho), rho = L1 c2 + L2 s3: each joint moves by alpha times E on its column."""
    p, length = core.params, 1 << core.params["W"] - 3
    words = fixed.config(p, cfg_l1=length, cfg_l2=length, gain=0.33)
    cfg = {"l1": length, "l2": length, "tol": 0, "limit": 1} | {name[4:]: word for name, word in words.items()}
    q = [0.3, 0.5, 0.4]

    def tip(q1: float, q2: float, q3: float) -> list[float]:
        rho = length * (math.cos(q2) + math.sin(q3))
        return [-math.sin(q1) * rho, length * (math.sin(q2) - math.cos(q3)), math.cos(q1) * rho]

    place, h = tip(*q), 1e-6
    row = {axis: round(one + off) for axis, one, off in zip("xyz", place, (length / 40, -length / 60, length / 50))}
    error = [row[axis] - one for axis, one in zip("xyz", place)]
    row |= {f"j{i}": round(one / TURN * 2 ** p["A"]) % 2 ** p["A"] for i, one in enumerate(q, 1)} | {"warm": 0}
    found = ask(core, [row], cfg)[0]
    for i in range(3):
        moved = tip(*(one + h * (k == i) for k, one in enumerate(q)))
        column = [(after - before) / h for after, before in zip(moved, place)]
        exact = 0.33 / length**2 * sum(c * e for c, e in zip(column, error)) / TURN * 2 ** p["A"]
        assert abs(found[f"d{i + 1}"] - exact) <= 0.003 * abs(exact) + 3


@oracle("engine.quaternion_gd_plane", cfg=("alpha", "shift"), status=("unreachable", "not_converged"))
def test_a_chain_in_the_plane(core):
    """One link: j += alpha (link x E). Links are loaded in order, up to N; else nothing is done, and 0 answered."""
    p = core.params
    a, length = p["A"], 1 << p["W"] - 3
    alpha = 0.3 / length**2
    cfg = {name[4:]: word for name, word in plane.config(p, alpha).items()} | {"tol": 0, "limit": 1}
    ex, ey, q = -length / 60, length / 50, 0.7
    x, y = length * math.cos(q), length * math.sin(q)
    none = {"x": 0, "y": 0, "j": 0}
    load = none | {"op": 1, "n": 1, "x": length, "j": round(q / TURN * 2**a)}
    goal = none | {"op": 0, "n": 1, "x": round(x + ex), "y": round(y + ey)}
    found = ask(core, [load, goal], cfg)[1]
    exact = alpha * (x * (goal["y"] - y) - y * (goal["x"] - x)) / TURN * 2**a
    assert abs(found["j"] - load["j"] - exact) <= 0.002 * abs(exact) + 2
    assert found["status"] == 8
    at_goal = goal | {"x": round(x), "y": round(y)}
    assert flags(core, [load, at_goal], cfg | {"tol": 2000}, "not_converged") == [False, False]
    rows = [none | {"op": op, "n": n, "j": 5, "x": 9} for op, n in
            ((0, 1), (1, 0), (1, 2), (1, 1), (3, 2), (2, 2), (1, 2), (3, 2), (2, 1), (1, 1), (0, 3), (3, 0),
             *((1, n) for n in range(3, p["N"] + 1)), (1, p["N"] + 1), (3, p["N"]))]
    answers = ask(core, rows, cfg | {"limit": 0})
    bad = [bool(row["status"] & 1) for row in answers]
    assert bad == [True, True, True, False, True, True, False, False, False, False, True, True,
                   *[False] * (p["N"] - 2), True, False]
    assert all(row["j"] == 0 for row, wrong in zip(answers, bad) if wrong)


@oracle("engine.quaternion_gd", "engine.quaternion_gd_touch", "engine.quaternion_dls", "engine.quaternion_gd_vector",
        "engine.newton_3r", status=("not_converged",))
def test_convergence_is_an_error_below_the_tolerance(core):
    """With no step allowed the start is judged: converged where out_error, |E|^2 in 1/256 unit, is below cfg_tol."""
    p = core.params
    unit = 2 ** (16 - p["W"]) if "newton" in core.name or "dls" in core.name else 1
    length, one = 1 << p["W"] - 3, 1 << p["W"]
    row = {port.name[3:]: 0 for port in core.inputs}
    for off in (0, 1, 3, 20):
        if "touch" in core.name:  # joints 0: tip (0, -L, L)
            row |= {"x": off, "y": -length, "z": length}
        else:  # joints 0: stretched along x
            row |= {"x": 2 * length + length * ("newton" in core.name) - off, "y": off}
            row |= {name: one for name in ("c1", "c12") if name in row}
        cfg = dict.fromkeys((port.name[4:] for port in core.cfg), 0) | {"l1": length, "l2": length, "alpha": 1}
        cfg |= {"l3": length} if "newton" in core.name else {}
        cfg = {port.name[4:]: cfg[port.name[4:]] for port in core.cfg}
        found = ask(core, [row], cfg)[0]
        square = (1 if "touch" in core.name else 2) * (off * unit) ** 2 * 256
        assert abs(found["error"] - square) <= 3 * 2 * 16 * math.sqrt(square) + 30, (found, square)
        assert found["status"] & 8 and not found["coarse"]
        for more, done in ((0, False), (1, True)):
            answer = ask(core, [row], cfg | {"tol": found["error"] + more})[0]
            assert bool(answer["status"] & 8) != done and answer["iters"] == 0


@oracle("engine.newton_3r", "engine.quaternion_dls", status=("singular",))
def test_newton_is_singular_where_it_does_not_converge_near_a_straight_arm(core):
    """|sin theta2| < 1/16 at the answer, or link 1 or 2 is 0; with not converged alone."""
    p, a = core.params, core.params["A"]
    length = 1 << p["W"] - 3
    cfg = dict.fromkeys((port.name[4:] for port in core.cfg), 0) | {"l1": length, "l2": length}
    row = {port.name[3:]: 0 for port in core.inputs} | {"x": length // 3, "y": 7}
    edge = math.asin(1 / 16)
    for middle in (0, math.pi):
        for j2, near in ((0.99 * edge, True), (1.01 * edge, False), (-0.99 * edge, True), (-1.01 * edge, False)):
            one = row | {"j2": round((middle + j2) / TURN * 2**a) % 2**a}
            assert flags(core, [one], cfg, "singular") == [near]
            assert flags(core, [one], cfg, "not_converged") == [True]
    bent = row | {"j2": 2**a // 4}
    for l1, l2, none in ((length, length, False), (0, length, True), (length, 0, True)):
        assert flags(core, [bent], cfg | {"l1": l1, "l2": l2}, "singular") == [none]
    straight = row | {"x": 2 * length + cfg.get("l3", 0), "y": 0, "j2": 0}
    assert ask(core, [straight], cfg | {"tol": 4000})[0]["status"] == 0  # it converges: nothing is singular


@oracle("engine.quaternion_gd_vector", status=("singular",))
def test_a_start_that_is_no_direction(core):
    """A start shorter than 1/2 or longer than 1.25; from 0.71 to 1.05 it is one. The flag stays for warm ones."""
    one, length = 1 << core.params["W"], 1 << core.params["W"] - 3
    cfg = {"l1": length, "l2": length, "alpha": 1, "shift": 0, "tol": 0, "limit": 0}

    def row(size: float, turn: float, which: int, warm: int = 0) -> dict:
        good, bad = (one, 0), (round(size * one * math.cos(turn)), round(size * one * math.sin(turn)))
        (c1, n1), (c2, n2) = (bad, good) if which == 1 else (good, bad)
        return {"x": 99, "y": 99, "c1": c1, "n1": n1, "c12": c2, "n12": n2, "warm": warm}

    for which in (1, 2):
        for k in range(16):
            turn = (k + 0.3) * TURN / 16
            for size, none in ((0.49, True), (1.26, True), (0.72, False), (1.04, False), (0.1, True), (1.0, False)):
                assert flags(core, [row(size, turn, which)], cfg, "singular") == [none], (size, turn)
    rows = [row(1, 0, 1), row(0.1, 0, 1), row(1, 0, 1, 1), row(1, 0, 2, 1), row(1, 0, 1), row(0.1, 0, 1, 1)]
    assert flags(core, rows, cfg, "singular") == [False, True, True, True, False, False]


@oracle("engine.quaternion_gd_n", status=("unreachable", "overflow", "not_converged"))
def test_a_chain_in_space(core):
    """Words in their order; E per coordinate below cfg_tol; a target beyond 2 units of a link's end overflows."""
    unit, n = 1 << 25, core.params["N"]

    def write(n: int, k: int, value: float) -> dict:
        return {"op": 1, "n": n, "k": k, "word": round(value * unit)}

    def chain(goal: tuple, link: tuple, turn: float = 0.0) -> list[dict]:
        rows = [write(0, k, one) for k, one in enumerate((*goal, 0.001))]
        words = (0, 0, 1, *(2 * one for one in link), math.cos(turn / 2), math.sin(turn / 2))
        return rows + [write(1, k, one) for k, one in enumerate(words)]

    solve = {"op": 0, "n": 1, "k": 7, "word": 0}
    cfg = {"tol": 1000, "limit": 0}
    for off, done in ((-1000, True), (999, True), (1001, False), (-1002, False)):
        rows = [*chain((0.5 + off / unit, 0, 0), (0.5, 0, 0)), solve]
        assert ask(core, rows, cfg)[-1]["status"] == 8 * (not done), off
    for x, link, over in ((1.5, -0.49, False), (1.5, -0.51, True), (-1.5, 0.49, False), (-1.5, 0.51, True)):
        status = ask(core, [*chain((0, x, 0), (0, link, 0)), solve], cfg | {"tol": 4_000_000})[-1]["status"]
        assert status == (12 if over else 8)
    good = chain((0.5, 0, 0), (0.5, 0, 0))
    wrong = [good[0] | {"op": 3}, good[1], good[0], good[2], good[1], solve, good[4] | {"n": 2}]
    assert [row["status"] for row in ask(core, wrong, cfg)] == [1, 1, 0, 1, 0, 1, 1]
    rows = [*good, solve | {"n": 2}, solve | {"n": 0}, solve]
    assert [row["status"] for row in ask(core, rows, cfg)][-3:] == [1, 1, 0]
    many = [write(i, k, 0) for i in range(1, n + 2) for k in range(8)]
    status = [row["status"] for row in ask(core, [*good[:4], *many], cfg)]
    assert status == [0] * (4 + 8 * n) + [1] * 8


# Parallel robots


@oracle("engine.rus_ik", "engine.rus_ik_angle", status=("unreachable", "singular", "overflow"))
def test_a_leg(core):
    """One crank in the plane of e and y, its joint d from the axis: S^2 = d^2 - G^2, G = (d^2 + LA^2 - LB^2) / 2 LA.

    Lengths in LSB of 18 bits. Bit 0 is of the legs that are not loaded, too, so all six are.
    """
    scale = 2 ** (18 - core.params["W"])
    la, lb, near = 20_000, 50_000, 100
    cfg = {"k": round((la**2 - lb**2) / 256 + 2 + la / 4096), "c": round(2**38 / la), "near": near}
    zero = {port.name[3:]: 0 for port in core.inputs}
    one = 1 << 16
    load = zero | {"load": 1, "r21": one, "r32": -one}  # the joint in the middle of the platform, azimuth along x
    turn = zero | {"r11": one, "r22": one, "r33": one, "cb": one}

    def status(px: int, foot: int = 0) -> int:
        rows = [load | {"leg": leg, "px": foot // scale} for leg in range(6)] + [turn | {"px": px // scale}]
        return ask(core, rows, cfg)[-1]["status"]

    seen = set()
    edge = [la + lb, lb - la]
    for d in [one + off for one in edge for off in (-400, -100, -40, -8, 8, 40, 100)] + [50_000, 40_000, 600, 110_000]:
        d = d // scale * scale
        g = (d * d + la * la - lb * lb) / (2 * la)
        reach, root = abs(d) >= abs(g), math.sqrt(max(d * d - g * g, 0))
        if abs(abs(d) - abs(g)) < 4 or reach and abs(root - 64 * near) < 64:
            continue
        want = 1 * (not reach) + 2 * (reach and root < 64 * near)
        assert status(d) == want, (d, root)
        seen.add(want)
    assert seen == {0, 1, 2}
    assert status(64) & 1  # no direction within 128 LSB of the axis
    end = 1 << 17
    for foot, px, over in ((60_000, end - 60_000 - 8, False), (60_000, end - 60_000 + 8, True),
                           (-60_000, -end + 60_000 + 8, False), (-60_000, -end + 60_000 - 8, True)):
        assert bool(status(px, foot) & 4) == over
    rows = [load | {"leg": leg} for leg in range(5)] + [turn | {"px": 50_000 // scale}]
    answer = ask(core, rows, cfg)[-1]
    assert answer["status"] == 1 and answer["far"] == 32


@oracle("engine.delta_fk", "engine.delta_fk_angle", status=("unreachable", "singular", "overflow"))
def test_a_delta_whose_cranks_are_alike(core):
    """Elbows at the radius R = base + LA c and the height LA n: the tip is sqrt(LB^2 - R^2) above or below them.

    It is out of reach where R > LB, and has no direction where R is 0.
    """
    p, lsb = core.params, 16
    half = 1 << p["W"] - 1
    azimuth = {f"{letter}{i + 1}": round(one(i * TURN / 3) * 2**25) for i in range(3)
               for letter, one in (("c", math.cos), ("n", math.sin))}

    def sample(quarter: int) -> dict:
        if "A" in p:
            return {f"j{i}": (quarter % 4) << p["A"] - 2 for i in (1, 2, 3)}
        c, n = [(1, 0), (0, 1), (-1, 0), (0, -1)][quarter % 4]
        return {f"{letter}{i}": part << p["U"] for i in (1, 2, 3) for letter, part in (("c", c), ("n", n))}

    unit = half // 16
    for quarter, lift in ((1, 1), (3, -1)):
        for above, side in ((1, 1), (0, -1)):
            cfg = azimuth | {"base": 3 * unit * lsb, "lb": 5 * unit * lsb, "la": 6 * unit * lsb, "above": above}
            answer = ask(core, [sample(quarter)], cfg)[0]
            assert answer["status"] == 0 and abs(answer["z"] - (6 * lift + 4 * side) * unit) <= 2
            for more, over in ((-4, False), (4, True)):  # of 16 unit: half the word's ends
                if lift == side:
                    longer = cfg | {"la": (12 * unit + more) * lsb}
                    assert flags(core, [sample(quarter)], longer) == [over]
    for base, far in ((4.96, False), (5.04, True)):
        assert flags(core, [sample(1)], cfg | {"base": round(base * unit * lsb)}, "unreachable") == [far]
    for base, none in ((0, True), (unit * lsb, False)):
        assert flags(core, [sample(1)], cfg | {"base": base}, "singular") == [none]
    rows = [sample(0), sample(1)]  # elbows in one point behind a regular sample: its tip is held
    held = ask(core, rows, cfg | {"base": 0, "la": 3 * unit * lsb})
    assert held[1]["status"] & 2 and [held[1][axis] for axis in "xyz"] == [held[0][axis] for axis in "xyz"]


@oracle("engine.quaternion_to_matrix", status=("singular",))
def test_a_quaternion_that_is_none(core):
    """The four squares, each cut to U + 4 fraction bits, and half a unit of 2^-U: from 1 - L up to below 1 + L."""
    u, rng = core.params["U"], random.Random(9)
    limit = max(Fraction(1, 2**9), Fraction(4, 2**u))
    rows, want = [{"w": 1 << u, "x": 0, "y": 0, "z": 0}], [False]
    for _ in range(3000):
        size = 1 + rng.choice((-1, 1)) * float(limit) / 2 * rng.choice((1, 1, 0, 3))
        q = [rng.gauss(0, 1) for _ in range(4)]
        words = [round(one * size / math.hypot(*q) * 2**u) for one in q]
        total = sum(Fraction(word * word // 2 ** (u - 4), 2 ** (u + 4)) for word in words) + Fraction(1, 2 ** (u + 1))
        rows.append(dict(zip("wxyz", words)))
        want.append(not 1 - limit <= total < 1 + limit)
    assert flags(core, rows, bit="singular") == want and 0.2 < sum(want) / 3000 < 0.8


@oracle("engine.rotation_check", status=("no_rotation",))
def test_a_matrix_that_is_no_rotation(core):
    """|a|^2 - 1, |b|^2 - 1, a . b and a x b - c less b_j units: from -16 units up to below 16."""
    u, rng = core.params["U"], random.Random(10)
    rows, want = [], []
    for number in range(1000):
        q, _ = fk6(np.array([[rng.uniform(-3, 3) for _ in range(6)]]), Six(0, 0, 0, 0, 0, 0, 0))
        words = [[round(float(one) * 2**u) for one in row] for row in q[0]]
        if number % 3:
            words[rng.randrange(3)][rng.randrange(3)] += rng.choice((-1, 1)) * rng.randint(6, 26)
        a, b, c = zip(*words)
        sums = [sum(x * x for x in a) - 4**u, sum(x * x for x in b) - 4**u, sum(x * y for x, y in zip(a, b))]
        for k in range(3):
            i, j = (k + 1) % 3, (k + 2) % 3
            sums.append(a[i] * b[j] - a[j] * b[i] - c[k] * 2**u - b[i])
        rows.append({f"r{r + 1}{s + 1}": words[r][s] for r in range(3) for s in range(3)})
        want.append(any(not -16 * 2**u <= total < 16 * 2**u for total in sums))
    assert flags(core, rows, bit="no_rotation") == want and 0.1 < sum(want) / 1000 < 0.9


@oracle("engine.rus_fk", status=("unreachable", "singular", "overflow", "not_converged"))
def test_a_pose_of_six_cranks(core):
    """At the pose each rod has its length: converged where every | |d|^2 - LB^2 | is at most cfg_tol, in 2^-25.

    d is the joint R J + p less the crank's end F + LA (ct cos a, sin a, st cos a). A length beyond 2 units overflows, a
    leg that another one repeats is singular, words out of their order are not taken.
    """
    one = 1 << core.params["W"] - 2
    place = (0.02, 0.6, -0.01)

    def words(rods: float = 0.0, miss: int = 0, alike: bool = False, foot: float = 0.0) -> list[dict]:
        rows = [(0, k, value) for k, value in enumerate((1, 0, 0, 0, *place, 1, 0))]
        for leg in range(1, 7):
            number = 2 if alike and leg == 3 else leg
            side = 1 if number % 2 else -1
            middle = number // 2 * TURN / 3  # feet in pairs, joints in other pairs
            turn, top = middle + 0.2 * side, middle + 0.8 * side
            joint = 0.3 * math.cos(top), 0.0, 0.3 * math.sin(top)
            base, crank, length = (0.5 * math.cos(turn), -foot, 0.5 * math.sin(turn)), turn, 0.1
            alpha = 0.1 * number
            end = (base[0] + length * math.cos(crank) * math.cos(alpha), base[1] + length * math.sin(alpha),
                   base[2] + length * math.sin(crank) * math.cos(alpha))
            d2 = sum((j + p - c) ** 2 for j, p, c in zip(joint, place, end))
            rod = math.sqrt(d2 - miss * 2.0**-25 * (leg == 4) + rods * number)
            if foot:
                rod = 0.5
            turns = math.cos(crank), math.sin(crank), 0, length, rod, math.cos(alpha), math.sin(alpha)
            rows += [(leg, k, value) for k, value in enumerate((*joint, *base, *turns))]
        return [{"op": 1, "n": n, "k": k, "word": round(value * one)} for n, k, value in rows]

    solve = {"op": 0, "n": 0, "k": 0, "word": 0}

    def status(rows: list[dict], tol: int, limit: int = 0) -> int:
        return ask(core, [*rows, solve], {"tol": tol, "limit": limit})[-1]["status"]

    fine = 3 if core.params["W"] == 27 else 1000  # what the rounding of the words moves a miss by, in 2^-25
    for miss in (0, 40 * fine, -40 * fine):
        for tol in (20 * fine, 36 * fine, 44 * fine):
            assert status(words(miss=miss), tol) == 8 * (tol < abs(miss)), (miss, tol)
    assert status(words(), 0) == 8  # cfg_tol 0 may be met by no miss alone
    assert status(words(foot=1.6), (1 << 22) - 1) & 12 == 12
    assert status(words(foot=0.3), (1 << 22) - 1) & 4 == 0
    assert status(words(rods=0.001), 10 * fine) == 8
    assert status(words(rods=0.001), 40 * fine, 20) == 0
    assert status(words(rods=0.001, alike=True), 10 * fine, 5) & 10 == 10
    good = words()
    wrong = [solve, good[1], good[0], good[2], good[1], good[1], good[0] | {"op": 2}, good[2] | {"op": 3}, *good[2:-1],
             solve, good[-1] | {"op": 2}, good[-1], solve]
    answers = ask(core, wrong, {"tol": 40 * fine, "limit": 0})
    assert [row["status"] for row in answers] == [1, 1, 0, 1, 0, 0, 0, 1, *[0] * (len(good) - 3), 1, 1, 0, 0]
    assert all(row["word"] == 0 for row in answers if row["status"] == 1)


# Six axes


@oracle("six.fk6", "six.fk6_of_angles", status=("overflow",))
def test_the_edge_of_a_tip_of_six_axes(core):
    """Upright z = c1 + c2 + c3 + c4 in 2^-4 LSB, rounded to nearest with ties upward, then saturated; x = a1 + a2."""
    p, half = core.params, 1 << core.params["W"] - 1
    row = {}
    for i in range(1, 7):
        row |= {f"j{i}": 0} if "A" in p else {f"c{i}": 1 << p["U"], f"n{i}": 0}
    zero = dict.fromkeys(("a1", "a2", "b", "c1", "c2", "c3", "c4"), 0)
    for sixteenths in (16 * half - 24, 16 * half - 9, 16 * half - 8, 16 * half - 1, 16 * half + 40, -16 * half + 5,
                       -16 * half - 8, -16 * half - 9, -16 * half - 30):
        place = math.floor(Fraction(sixteenths, 16) + Fraction(1, 2))
        part = sixteenths // 2
        for words, axis in (({"c1": part, "c3": sixteenths - part}, "z"), ({"c2": part, "c4": sixteenths - part}, "z"),
                            ({"a1": part, "a2": sixteenths - part}, "x"), ({"b": part}, "y")):
            want = place if axis != "y" else math.floor(Fraction(part, 16) + Fraction(1, 2))
            found = ask(core, [row], zero | words)[0]
            assert bool(found["status"]) == (not -half <= want < half), (sixteenths, words)
            assert found[axis] == min(max(want, -half), half - 1)


@oracle("tool.xyzac", "tool.xyzbc", status=("overflow",))
def test_the_edge_of_a_machine_tool(core):
    """Both tables at 0: the axes are the point's; with the tilt at a quarter of a turn they are exchanged."""
    p, half = core.params, 1 << core.params["W"] - 1
    one, tilt = 1 << p["U"], core.function[3]
    flat = {f"c{tilt}": one, f"n{tilt}": 0, "cc": one, "nc": 0}
    upright = flat | {f"c{tilt}": 0, f"n{tilt}": one}
    axis, sign = ("y", -1) if tilt == "a" else ("x", 1)
    cfg = {"xr": 5, "yr": -9, "d": half // 8, "zs": -sign * (half // 4)}
    point = {"x": half - 1, "y": -half, "z": half - 3}
    assert ask(core, [flat | point], cfg)[0] == point | {"status": 0}
    centre = cfg["d"] + cfg[f"{axis}r"]
    for off, over in ((0, False), (1, True)):
        high = upright | {"x": 0, "y": 0, "z": cfg["zs"] + sign * (half - 1 + off - centre)}
        answer = ask(core, [high], cfg)[0]
        assert abs(high["z"]) < half and (answer[axis], bool(answer["status"])) == (half - 1, over)
    low = upright | {"x": 0, "y": 0, "z": cfg["zs"]} | {axis: -half}
    rise = (-half - centre) * -sign  # the level of the point on the tilted table
    assert ask(core, [low], cfg)[0]["z"] == min(max(cfg["zs"] + rise, -half), half - 1)


@oracle("six.velocity6", "six.rates6", status=("singular", "overflow"))
def test_motions_of_an_arm_with_a_square_elbow(core):
    """q = (0, 0, 90, 0, 90) degrees, c2 = c3 = c, no offset and no flange: the wrist is at (c, 0, c), axis 5 along y.

    Rates: w1 = vy / c, w3 = -vz / c - w2 and w2 = vx / c, w5 = wy - w2 - w3; axes 4 and 6 look along x and -z, so w4 is
    wx and w6 is w1 - wz. The factors are c, c and 1.
    """
    p, half = core.params, 1 << core.params["W"] - 1
    one, c = 1 << p["U"], half // 4
    cfg = dict.fromkeys(("a1", "a2", "b", "c4"), 0) | {"c2": 16 * c, "c3": 16 * c}
    row = {f"{letter}{i}": one * (quarter == (letter == "n")) for i, quarter in enumerate((0, 0, 1, 0, 1), 1)
           for letter in "cn"}
    rad = 1 << p["V"]
    zero = dict.fromkeys(("w1", "w2", "w3", "w4", "w5", "w6") if core.function == "velocity6" else
                         ("vx", "vy", "vz", "wx", "wy", "wz"), 0)
    if core.function == "velocity6":
        for rate in (half // 3, -half // 3):  # |v| = c rate / 2^V
            found = ask(core, [row | zero | {"w2": rate // 2}], cfg)[0]
            exact = c * (rate // 2) / rad
            fits = abs(exact) < half
            assert bool(found["status"]) != fits and (not fits or abs(found["vx"] - exact) <= 1)
        for rate, over in ((half // 2 - 2, False), (half // 2 + 2, True)):
            turning = row | zero | {"w1": rate, "w2": 0}
            slow = cfg | {"c2": 0, "c3": 0}
            assert flags(core, [turning | {"w6": -rate}], slow) == [over]
            assert flags(core, [turning | {"w6": rate}], slow) == [False]
        return
    cfg |= dict.fromkeys(("radius", "elbow", "sine"), 0)
    for vx, vy, vz, wx, wy, wz in ((9, -5, 3, 40, -70, 11), (-7, 2, 8, 5, 60, -90)):
        v = [part * c // 100 for part in (vx, vy, vz)]
        w = [part * rad // 100 for part in (wx, wy, wz)]
        found = ask(core, [row | dict(zip(("vx", "vy", "vz", "wx", "wy", "wz"), (*v, *w)))], cfg)[0]
        w2, w23 = v[0] / c * rad, -v[2] / c * rad
        exact = (v[1] / c * rad, w2, w23 - w2, w[0], w[1] - w23, v[1] / c * rad - w[2])
        assert all(abs(found[f"w{i}"] - one) <= 1 + abs(one) * 1e-4 for i, one in enumerate(exact, 1)), (found, exact)
        assert found["status"] == 0 and (abs(found["d1"] - c), abs(found["d3"] - c), found["d5"]) <= (1, 1, one)
    for name, edge in (("radius", c), ("elbow", c), ("sine", one)):
        assert flags(core, [row | zero], cfg | {name: edge - 2}, "singular") == [False]
        assert flags(core, [row | zero], cfg | {name: edge}, "singular") == [True]
    end = half * c // rad  # of vy: the rate of joint 1 is at its end
    for vy, over in ((end - c // 200 - 2, False), (end + c // 200 + 2, True), (-end - c // 200 - 2, True)):
        if abs(vy) < half:
            assert flags(core, [row | zero | {"vy": vy}], cfg) == [over]
    assert flags(core, [row | zero | {"wy": half - 1}], cfg) == [False]


@oracle("six.ik6", "six.ik6_all", "six.ik6_to_angles", status=("unreachable", "singular", "no_rotation"),
        cfg=("margin", "slack"))
def test_where_six_axes_have_no_answer(core):
    """Beyond c2 + k of axis 2 and the slack; nearer to axis 1 than b; joint 1, 2 or 4 without a direction, or nearer to
    that than the margin; a matrix 16 units off.

    The arm: a2 = 0, so k = c3; poses are those of joints, by the truth's forward kinematics.
    """
    p, rng = core.params, random.Random(11)
    lsb = 2 ** p["F"]
    half = 1 << p["W"] - 1
    size = half / lsb / 8
    every = core.function == "ik6_all"
    edges = ("margin", "slack") if p.get("MARGINS", 1) else ()

    def words(arm: Six, **more: float) -> dict:
        return {name[4:]: word for name, word in six.config(p, **arm._asdict(), **{
            name: more.get(name, 0.0) / lsb for name in edges}).items()}

    def pose(matrix, tip) -> dict:
        row = {f"r{r + 1}{s + 1}": round(float(matrix[r][s]) * 2 ** p["U"]) for r in range(3) for s in range(3)}
        row |= {axis: round(float(one)) for axis, one in zip("xyz", tip)}
        return row | ({"branch": 0} if any(port.name == "in_branch" for port in core.inputs) else {})

    flange = 0.5 * size
    arm = Six(a1=0.2 * size, a2=0, b=0, c1=0.3 * size, c2=2.4 * size, c3=1.6 * size, c4=flange)
    cfg, tools = words(arm), np.diag([1.0, -1.0, -1.0])  # the flange points down
    for off in (-40, -6, 6, 40):
        turn = rng.uniform(-1.2, 1.2)
        radius = 4 * size * lsb + off
        centre = (0.2 * size * lsb + radius * math.cos(turn), 0, 0.3 * size * lsb + radius * math.sin(turn))
        tip = (centre[0], 0, centre[2] - flange * lsb)
        # branch 0 alone, or any of all: behind, the wrist is farther
        assert flags(core, [pose(tools, tip)], cfg, "unreachable")[0] == (off > 0 or every)
        for slack in (12, 60) if edges else ():
            answer = ask(core, [pose(tools, tip)], words(arm, slack=slack))[0]
            assert answer["far" if every else "status"] & 1 == (off > slack)
    aside = words(arm._replace(b=0.4 * size))
    for off, inside in ((-8, True), (8, False)):
        x = 0.4 * size * lsb + off
        assert flags(core, [pose(tools, (x, 0, size * lsb))], aside, "unreachable") == [inside]
    # singular: joint 1 on its axis, joint 2 on axis 2, joint 4 where the wrist is straight
    tilted = fk6(np.array([[0.3, 0.4, 1.0, 0.5, 0.9, 0.2]]), arm)
    place = [one * lsb for one in tilted[1][0]]
    assert flags(core, [pose(tilted[0][0], place)], cfg, "singular") == [False]
    assert flags(core, [pose(tools, (0, 0, 1.5 * size * lsb))], cfg, "singular") == [True]
    margin = 0.1 * arm.k * lsb
    for joint in (0, 2, 4) if edges else ():
        for share, close in ((0.8, True), (1.2, False)):
            q = [0.3, 0.4, 1.0, 0.5, 0.9, 0.2]
            q[joint] = math.asin(share * 0.1) if joint else q[0]
            matrix, tip = fk6(np.array([q]), arm)
            if not joint:  # the wrist's centre beside axis 1
                beside = share * 0.1 * arm.k
                tip = arm.c4 * matrix[..., 2] + [[0.6 * beside, -0.8 * beside, arm.c1 + arm.c2]]
            at = pose(matrix[0], tip[0] * lsb)
            for edge, held in ((margin, close), (0, False)):
                answer = ask(core, [at], words(arm, margin=edge))[0]
                assert (answer["held"] if every else answer["status"] >> 1) & 1 == held, (joint, share, edge)
    axis2 = words(arm._replace(a1=1.0 * size))
    shoulder = (size * lsb, 0, (0.3 - 0.5) * size * lsb)
    assert flags(core, [pose(tools, shoulder)], axis2, "singular")[0]
    assert not flags(core, [pose(tilted[0][0], fk6(np.array([[0.3, 0.4, 1.0, 0.5, 0.9, 0.2]]),
                                                    arm._replace(a1=size))[1][0] * lsb)], axis2, "singular")[0]
    for bent, none in ((3, True), (14, False)):  # 8 units of 2^-U in both coordinates
        q = np.array([[0.3, 0.4, 1.0, 0.7, bent * 2.0 ** -p["U"] * math.sqrt(2), 0.2]])
        matrix, tip = fk6(q, arm)
        status = flags(core, [pose(matrix[0], tip[0] * lsb)], cfg, "singular")[0]
        assert status == none or p["U"] < 16  # the tip's rounding turns the forearm by more than units of fewer bits
    row = pose(tilted[0][0], place)
    for name in ("r11", "r12", "r23", "r33"):
        assert flags(core, [row | {name: row[name] + 48}], cfg, "no_rotation") == [True]
        assert flags(core, [row | {name: row[name] + 3}], cfg, "no_rotation") == [False]
    straight = pose(np.eye(3), (0.2 * size * lsb + 10, 0, size * lsb))
    for off, wrong in ((15, False), (17, True), (-15, False), (-17, True)):
        assert flags(core, [straight | {"r12": off, "r21": 0}], cfg, "no_rotation") == [wrong], off
