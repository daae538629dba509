"""Bit-true models of rtl/six: six axes in unit vectors, every step a sum of products of 27-bit words.

A word carries 1.0 as 2^25; 1.0 of a length is 2^W LSB of a coordinate.
"""

from __future__ import annotations

import math

import numpy as np

from quadrance import conversion
from quadrance.fixed import Ints, hold_last, ints, round_shift, saturate, wrap
from quadrance.product_engine import ONE, G, H, N, dot, fold, root, rounded, sum_of, term, unit

Params = dict[str, int]
MORE = 4  # fraction bits of a configured length below the LSB of a coordinate
AXES = [f"{row}{column}" for row in "123" for column in "123"]


# Forward


def _length(p: Params, word: Ints) -> Ints:
    return ints(word) << H - p["W"] - MORE


def fk6(p: Params, **ports: Ints) -> dict[str, Ints]:
    """R = R03 R36, tip = wrist centre + c4 R z; column 2 is the cross product of columns 3 and 1."""
    c, n = ([None] + [ints(ports[f"in_{letter}{i}"]) << H - p["U"] for i in range(1, 7)] for letter in "cn")
    a1, a2, b, c1, c2, c3, c4 = (_length(p, ports[f"cfg_{name}"]) for name in ("a1", "a2", "b", "c1", "c2", "c3", "c4"))
    down = wrap(-n[5], N)
    c23, n23 = dot((c[3], c[2]), (n[2], n[3], -1)), dot((c[3], n[2]), (c[2], n[3]))
    t, s = dot((c[5], c[4])), dot((c[5], n[4]))
    e1, e2, e3 = dot((c[6], t), (n[4], n[6], -1)), dot((c[6], s), (c[4], n[6])), dot((c[6], down))
    u1, r31 = dot((c23, e1), (n23, e3)), dot((c23, e3), (n23, e1, -1))
    r11, r21 = dot((c[1], u1), (n[1], e2, -1)), dot((n[1], u1), (c[1], e2))
    f1, f2 = dot((n[5], c[4])), dot((n[5], n[4]))
    u3, r33 = dot((c[5], n23), (c23, f1)), dot((c[5], c23), (n23, f1, -1))
    r13, r23 = dot((c[1], u3), (n[1], f2, -1)), dot((n[1], u3), (c[1], f2))
    r12, r22 = dot((r23, r31), (r33, r21, -1)), dot((r33, r11), (r13, r31, -1))
    r32 = dot((r13, r21), (r23, r11, -1))
    x1 = dot((a1, ONE), (c2, n[2]), (c3, n23), (a2, c23))
    x = dot((x1, c[1]), (b, n[1], -1), (c4, r13))
    y = dot((x1, n[1]), (b, c[1]), (c4, r23))
    z = dot((c1, ONE), (c2, c[2]), (c3, c23), (a2, n23, -1), (c4, r33))
    answer, overflow = {}, ints(0)
    for axis, word in zip("xyz", (x, y, z)):
        answer[f"out_{axis}"], over = saturate(round_shift(word, H - p["W"]), p["W"])
        overflow = overflow | over
    matrix = zip(AXES, (r11, r12, r13, r21, r22, r23, r31, r32, r33))
    return answer | {f"out_r{name}": _rounded(p, word) for name, word in matrix} | {"out_status": 4 * overflow}


def _rounded(p: Params, word: Ints) -> Ints:
    return wrap(round_shift(word, H - p["U"]), p["U"] + 2)


# Inverse


def config(p: Params, *, a1: float, a2: float, b: float, c1: float, c2: float, c3: float, c4: float) -> dict[str, int]:
    """Configuration words of vector_ik6 from the seven parameters, in coordinate units.

    Lengths in 2^-4 LSB; `cfg_k` is the length of (a2, c3) and (`cfg_cp`, `cfg_np`) its direction; `cfg_r` and `cfg_e`,
    a power of two, multiply to 1 / 2 c2 k, with c2 and k as rounded.
    """
    words = {f"cfg_{name}": round(value * 2.0 ** (p["F"] + MORE)) for name, value in
             (("a1", a1), ("b", b), ("c1", c1), ("c2", c2), ("c4", c4), ("k", math.hypot(a2, c3)))}
    double = max(2 * words["cfg_c2"] * words["cfg_k"] * 2.0 ** (-2 * p["W"] - 2 * MORE), 2.0**-20)
    e = max(math.floor(-math.log2(double)) + 1, 1)
    psi = math.atan2(a2, c3)
    return words | {"cfg_cp": round(ONE * math.cos(psi)), "cfg_np": round(ONE * math.sin(psi)),
                    "cfg_r": min(math.floor(ONE / double / 2**e), ONE - 1), "cfg_e": 1 << e}


def forward_config(p: Params, *, a1: float, a2: float, b: float, c1: float, c2: float, c3: float,
                   c4: float) -> dict[str, int]:
    """Configuration words of vector_fk6 from the seven parameters, in coordinate units."""
    return {f"cfg_{name}": round(value * 2.0 ** (p["F"] + MORE)) for name, value in
            (("a1", a1), ("a2", a2), ("b", b), ("c1", c1), ("c2", c2), ("c3", c3), ("c4", c4))}


def floor(p: Params) -> int:
    """The bit below which (M13, M23) is taken for nothing: eight units of the matrix words."""
    return H - p["U"] + 3


def slack(p: Params) -> int:
    """The bit from which an error of orthonormality counts: 16 units of the matrix words."""
    return H - p["U"] + 4


def _off(p: Params, *pairs: tuple) -> Ints:
    return fold(dot(*pairs)) >> slack(p) != 0


def no_rotation(p: Params, r: dict[str, Ints]) -> Ints:
    """Columns 1 and 2 of length 1 and at right angles, column 3 their cross product, each to `slack`."""
    wrong = ints(0) != 0
    for column in "12":
        c1, c2, c3 = (r[row + column] for row in "123")
        wrong = wrong | _off(p, (c1, c1), (c2, c2), (c3, c3), (-ONE, ONE))
    wrong = wrong | _off(p, (r["11"], r["12"]), (r["21"], r["22"]), (r["31"], r["32"]))
    for one, two, three in ("123", "231", "312"):
        cross = (r[two + "1"], r[three + "2"]), (r[three + "1"], r[two + "2"], -1)
        wrong = wrong | _off(p, (-ONE, r[one + "3"]), *cross)
    return wrong


def _held(c: Ints, n: Ints, none: Ints) -> tuple[Ints, Ints]:
    return hold_last(c, ~none, ONE), hold_last(n, ~none)


def _alike(ports: dict[str, Ints]) -> dict[str, Ints]:
    """All ports as long as the longest."""
    return dict(zip(ports, (ints(word) for word in np.broadcast_arrays(*ports.values()))))


def _branch(p: Params, **ports: Ints) -> tuple[list[tuple[Ints, Ints]], Ints, Ints, Ints]:
    """Words of the six vectors; where the pose is out of reach, which joints are held (bit j - 1), R is no rotation."""
    branch = ports["in_branch"]
    back, down, flip = (branch >> i & 1 for i in range(3))
    r = {axis: ports[f"in_r{axis}"] << H - p["U"] for axis in AXES}
    x, y, z = (ports[f"in_{axis}"] << H - p["W"] for axis in "xyz")
    a1, b, c1, c2, c4, k = (_length(p, ports[f"cfg_{name}"]) for name in ("a1", "b", "c1", "c2", "c4", "k"))
    wrong = no_rotation(p, r)
    px, py = dot((x, ONE), (c4, r["13"], -1)), dot((y, ONE), (c4, r["23"], -1))
    pz = dot((z, ONE), (c4, r["33"], -1), (c1, -ONE))
    total = sum_of(term(px, px), ~term(b, b), term(py, py))
    inside = total < 0
    x1 = root(np.where(inside, 0, rounded(total)), back)
    cosine, sine, g, no1 = unit(dot((x1, px), (b, py)), dot((x1, py), (b, px, -1)))
    c_1, n_1 = _held(dot((cosine, g)), dot((sine, g)), no1)
    x = dot((a1, -ONE), (x1, ONE))
    total = sum_of(term(x, x), ~term(c2, c2), term(pz, pz), ~term(k, k))
    far = total >> G >= 1 << N - 1
    t = dot((rounded(total), ports["cfg_r"]))
    product = t * ports["cfg_e"]
    outside = far | (product < -ONE) | (product >= ONE)
    c_e = np.where(outside, np.where((product < 0) & ~far, -ONE, ONE), wrap(product, N))
    n_e = root(dot((ints(ONE), ONE), (c_e, c_e, -1)), down)
    k1, k2 = dot((c2, ONE), (k, c_e)), dot((k, n_e))
    cosine, sine, g, no2 = unit(dot((k1, pz), (k2, x)), dot((k1, x), (k2, pz, -1)))
    c_2, n_2 = _held(dot((cosine, g)), dot((sine, g)), no2)
    cp, np_ = ports["cfg_cp"], ports["cfg_np"]
    c_3, n_3 = dot((cp, c_e), (n_e, np_)), dot((cp, n_e), (c_e, np_, -1))
    c23, n23 = dot((c_2, c_3), (n_2, n_3, -1)), dot((n_2, c_3), (c_2, n_3))
    u3, m23 = dot((c_1, r["13"]), (n_1, r["23"])), dot((c_1, r["23"]), (n_1, r["13"], -1))
    m13, c_5 = dot((c23, u3), (n23, r["33"], -1)), dot((n23, u3), (c23, r["33"]))
    cosine, sine, g, no4 = unit(m13, m23, floor(p), flip)
    c_4, n_4 = _held(dot((cosine, g)), dot((sine, g)), no4)
    n_5 = dot((c_4, m13), (n_4, m23))
    t = dot((n_4, c23, -1))
    w1, w2, w3 = dot((t, c_1), (c_4, n_1, -1)), dot((t, n_1), (c_4, c_1)), dot((n_4, n23))
    n_6 = dot((w1, r["11"]), (w2, r["21"]), (w3, r["31"]))
    c_6 = dot((w1, r["12"]), (w2, r["22"]), (w3, r["32"]))
    vectors = [(c_1, n_1), (c_2, n_2), (c_3, n_3), (c_4, n_4), (c_5, n_5), (c_6, n_6)]
    return vectors, ints(inside | outside), no1 + 2 * ints(no2) + 8 * ints(no4), ints(wrong)


def ik6(p: Params, **ports: Ints) -> dict[str, Ints]:
    """One branch of a pose."""
    vectors, far, none, wrong = _branch(p, **_alike(ports))
    answer = {}
    for i, (c, n) in enumerate(vectors, 1):
        answer |= {f"out_c{i}": _rounded(p, c), f"out_n{i}": _rounded(p, n)}
    return answer | {"out_status": _status(far, none, wrong)}


def _status(far: Ints, none: Ints, wrong: Ints) -> Ints:
    return far + 2 * (none != 0) + 8 * wrong


SOLVED = (0, 2, 1, 3)  # branches of ik6_all in the order in which they hold directions; the others mirror them


def ik6_all(p: Params, **ports: Ints) -> dict[str, Ints]:
    """All branches of a pose: of `SOLVED`, and those whose wrist is turned over, joints 4 and 6 by half a turn."""
    ports = {name: np.repeat(np.atleast_1d(word), len(SOLVED)) for name, word in _alike(ports).items()}
    order = np.resize(SOLVED, len(ports["in_x"]))
    vectors, far, none, wrong = _branch(p, **ports, in_branch=order)
    held = ints(none != 0)
    answer, bits = {}, {"far": 0, "held": 0}
    for at, branch in enumerate(SOLVED):
        for i, (c, n) in enumerate(vectors, 1):
            c, n = c[at::len(SOLVED)], n[at::len(SOLVED)]
            over = (c if i == 5 else -c, -n) if i > 3 else (c, n)
            for number, (cosine, sine) in ((branch, (c, n)), (branch + 4, over)):
                answer |= {f"out_c{i}{number}": _rounded(p, cosine), f"out_n{i}{number}": _rounded(p, sine)}
        for name, flag in (("far", far), ("held", held)):
            bits[name] = bits[name] + (17 * flag[at::len(SOLVED)] << branch)
    bits = {f"out_{name}": word for name, word in bits.items()}
    status = ints(bits["out_far"] != 0) + 2 * ints(bits["out_held"] != 0) + 8 * wrong[::len(SOLVED)]
    return answer | bits | {"out_status": status}


# With the angle codec


def table_fk6(p: Params, **ports: Ints) -> dict[str, Ints]:
    """`fk6` of binary angles, each by angle_to_vector."""
    words = {name: word for name, word in ports.items() if name.startswith("cfg_")}
    for i in range(1, 7):
        vectors = conversion.angle_to_vector(p, in_j=ports[f"in_j{i}"])
        words |= {f"in_{letter}{i}": vectors[f"out_{letter}"] for letter in "cn"}
    return fk6(p, **words)


FORMED = (1, 3, 2, 4, 5, 6)  # joints of table_ik6 in the order in which its codec takes their vectors


def table_ik6(p: Params, **ports: Ints) -> dict[str, Ints]:
    """`ik6` to binary angles: one vector_to_angle takes the vectors of a sample in turn.

    A held joint has its last word, and the codec does not take it again unless it never had a direction.
    """
    vectors, far, none, wrong = _branch(p, **_alike(ports))
    c, n = (np.stack([_rounded(p, vectors[joint - 1][i]) for joint in FORMED], axis=-1) for i in (0, 1))
    held = np.stack([none >> joint - 1 & 1 > 0 for joint in FORMED], axis=-1)
    taken = ~(held & np.logical_or.accumulate(~held))
    words = np.zeros_like(c)
    words[taken] = conversion.vector_to_angle(p, in_c=c[taken], in_n=n[taken])["out_j"]
    angles = {f"out_j{joint}": hold_last(words[:, i], taken[:, i]) for i, joint in enumerate(FORMED)}
    return angles | {"out_status": _status(far, none, wrong)}
