"""Bit-true models of rtl/six: six axes in unit vectors, by the programs in rtl/program that their cores play.

A word carries 1.0 as 2^25; 1.0 of a length is 2^W LSB of a coordinate.
"""

from __future__ import annotations

import math

import numpy as np

from quadrance import conversion
from quadrance.cores import RTL
from quadrance.fixed import Ints, hold_last, ints
from quadrance.product_engine import ONE, H, fold
from quadrance.program import meaning, parser
from quadrance.program.language import Program
from quadrance.program.meaning import MORE

Params = dict[str, int]
AXES = [f"{row}{column}" for row in "123" for column in "123"]
FORWARD, INVERSE, NEAR, ALL, VELOCITY, RATES = (RTL / "program" / f"vector_{name}.kin" for name in
                                                ("fk6", "ik6", "ik6_near", "ik6_all", "velocity6", "rates6"))


def fk6(p: Params, **ports: Ints) -> dict[str, Ints]:
    """Six joints to a pose."""
    return meaning.answer(parser.load(FORWARD), p, **ports)


# Inverse


def config(p: Params, *, a1: float, a2: float, b: float, c1: float, c2: float, c3: float, c4: float,
           margin: float = 0.0, slack: float = 0.0) -> dict[str, int]:
    """Configuration words of vector_ik6 from the seven parameters, `margin` and `slack`, all in coordinate units.

    Lengths in 2^-4 LSB; `cfg_k` is the length of (a2, c3) and (`cfg_cp`, `cfg_np`) its direction; `cfg_r` and `cfg_e`,
    a power of two, multiply to 1 / 2 c2 k, with c2 and k as rounded.

    Raises
    ------
    ValueError
        Where the core has MARGINS = 0 and either is given.
    """
    if (margin or slack) and p.get("MARGINS") == 0:
        raise ValueError("margin and slack need MARGINS = 1")
    words = {f"cfg_{name}": round(value * 2.0 ** (p["F"] + MORE)) for name, value in
             (("a1", a1), ("b", b), ("c1", c1), ("c2", c2), ("c4", c4), ("k", math.hypot(a2, c3)))}
    words |= {f"cfg_{name}": round(value * 2.0 ** p["F"]) for name, value in (("margin", margin), ("slack", slack))}
    psi = math.atan2(a2, c3)
    return words | {"cfg_cp": round(ONE * math.cos(psi)), "cfg_np": round(ONE * math.sin(psi))} | triangle(
        p, words["cfg_c2"], words["cfg_k"])


def triangle(p: Params, one: int, two: int) -> dict[str, int]:
    """`cfg_r` and `cfg_e` of two links in 2^-4 LSB: their product is the reciprocal of twice that of the links."""
    double = max(2 * one * two * 2.0 ** (-2 * p["W"] - 2 * MORE), 2.0**-20)
    e = max(math.floor(-math.log2(double)) + 1, 1)
    return {"cfg_r": min(math.floor(ONE / double / 2**e), ONE - 1), "cfg_e": 1 << e}


def forward_config(p: Params, *, a1: float, a2: float, b: float, c1: float, c2: float, c3: float,
                   c4: float) -> dict[str, int]:
    """Configuration words of vector_fk6 from the seven parameters, in coordinate units."""
    return {f"cfg_{name}": round(value * 2.0 ** (p["F"] + MORE)) for name, value in
            (("a1", a1), ("a2", a2), ("b", b), ("c1", c1), ("c2", c2), ("c3", c3), ("c4", c4))}


def inverse(p: Params) -> Program:
    """The program of one branch, with margin and slack where the core has them."""
    return parser.load(NEAR if p.get("MARGINS") else INVERSE)


def ik6(p: Params, **ports: Ints) -> dict[str, Ints]:
    """One branch of a pose."""
    return meaning.answer(inverse(p), p, **ports)


def solved(p: Params, **ports: Ints) -> meaning.Outcome:
    """What the program of all branches finds for a pose."""
    ports = dict(zip(ports, np.broadcast_arrays(*map(np.atleast_1d, ports.values()))))
    return meaning.fixed(parser.load(ALL), p, **ports)


def named(branch: int) -> list[str]:
    """How the words of joints 1 to 6 of a branch end in the program of all branches."""
    s, e = "fb"[branch & 1], "ud"[branch >> 1 & 1]
    return [s] + [e + s] * 5


def flags(outcome: meaning.Outcome, branch: int) -> tuple[Ints, Ints]:
    """Where a branch is out of reach, and where it is singular."""
    (s, bent, *_), back, down = named(branch), branch & 1, branch >> 1 & 1
    far = outcome.beyond["q"] | outcome.beyond[f"ce{s}"]
    near, none = outcome.near, outcome.none
    held = np.any(np.broadcast_arrays(none[f"c1{s}"], none[f"c2{bent}"], none[f"c4{bent}"], near["c1"][0],
                                      near["c2"][back], near["c4"][2 * back + down]), axis=0)
    return ints(far), ints(held)


def ik6_all(p: Params, **ports: Ints) -> dict[str, Ints]:
    """All branches of a pose; where the wrist is turned over, joints 4 and 6 are half a turn on."""
    outcome = solved(p, **ports)
    answer, far, held = {}, ints(0), ints(0)
    for branch in range(8):
        for i, name in enumerate(named(branch), 1):
            for letter in "cn":
                minus = branch >> 2 and (i in (4, 6) or i == 5 and letter == "n")
                word = outcome.words[f"{letter}{i}{name}"]
                answer[f"out_{letter}{i}{branch}"] = meaning.near_vector(p, -word if minus else word)
        far, held = (bits | one << branch for bits, one in zip((far, held), flags(outcome, branch)))
    status = ints(far != 0) + 2 * ints(held != 0) + 8 * ints(outcome.wrong)
    return answer | {"out_far": far, "out_held": held, "out_status": status}


# Velocities


def motion_config(p: Params, *, a1: float, a2: float, b: float, c2: float, c3: float, c4: float) -> dict[str, int]:
    """Configuration words of vector_velocity6 from the parameters, in coordinate units."""
    return {f"cfg_{name}": round(value * 2.0 ** (p["F"] + MORE)) for name, value in
            (("a1", a1), ("a2", a2), ("b", b), ("c2", c2), ("c3", c3), ("c4", c4))}


def rates_config(p: Params, *, radius: float, angle: float, **lengths: float) -> dict[str, int]:
    """Configuration words of vector_rates6: those of vector_velocity6, and where the arm is taken for singular.

    Parameters
    ----------
    radius : distance of the wrist's centre from axis 1, coordinate units.
    angle : of the elbow from stretched or folded, and of joint 5 from straight, radians.
    """
    reach = math.hypot(lengths["a2"], lengths["c3"])
    return motion_config(p, **lengths) | {"cfg_radius": round(radius * 2.0 ** p["F"]), "cfg_sine": round(
        math.sin(angle) * 2.0 ** p["U"]), "cfg_elbow": round(reach * math.sin(angle) * 2.0 ** p["F"])}


def velocity6(p: Params, **ports: Ints) -> dict[str, Ints]:
    """Rates of six joints to the tip's velocity and turn."""
    return meaning.answer(parser.load(VELOCITY), p, **ports)


def rates6(p: Params, **ports: Ints) -> dict[str, Ints]:
    """The tip's velocity and turn to rates of six joints; singular where a factor of the determinant is not above its
    threshold."""
    program = parser.load(RATES)
    outcome = meaning.fixed(program, p, **ports)
    words = outcome.words
    found, over = meaning.results(program, p, words)
    limits = {"d1": ints(ports["cfg_radius"]) << H - p["W"], "d3": ints(ports["cfg_elbow"]) << H - p["W"],
              "d5": ints(ports["cfg_sine"]) << H - p["U"]}
    near = np.any(np.broadcast_arrays(*(fold(words[name]) <= limit for name, limit in limits.items())), axis=0)
    return found | {"out_status": 2 * ints(near) + 4 * ints(over | outcome.far)}


# With the angle codec


def vectors_of(p: Params, ports: dict[str, Ints]) -> dict[str, Ints]:
    """Ports of an `fk` of unit vectors from those of one of binary angles: each joint by angle_to_vector."""
    words = {name: word for name, word in ports.items() if name.startswith("cfg_")}
    for i in range(1, 7):
        vectors = conversion.angle_to_vector(p, in_j=ports[f"in_j{i}"])
        words |= {f"in_{letter}{i}": vectors[f"out_{letter}"] for letter in "cn"}
    return words


def table_fk6(p: Params, **ports: Ints) -> dict[str, Ints]:
    """`fk6` of binary angles."""
    return fk6(p, **vectors_of(p, ports))


def to_angles(program: Program, p: Params, **ports: Ints) -> dict[str, Ints]:
    """One branch in binary angles: one vector_to_angle takes the vectors of a sample as the program forms them.

    A held joint has its last word, and the codec does not take it again unless it never had a direction.
    """
    outcome = meaning.fixed(program, p, **ports)
    vectors, _ = meaning.results(program, p, outcome.words)
    formed = [cosine for cosine, _ in program.order]
    c, n = (np.stack([vectors[f"out_{letter}{cosine[1:]}"] for cosine in formed], axis=-1) for letter in "cn")
    held = np.stack([np.broadcast_to(outcome.none.get(cosine, False), c.shape[:-1]) for cosine in formed], axis=-1)
    taken = ~(held & np.logical_or.accumulate(~held))
    words = np.zeros_like(c)
    words[taken] = conversion.vector_to_angle(p, in_c=c[taken], in_n=n[taken])["out_j"]
    angles = {f"out_j{cosine[1:]}": hold_last(words[:, i], taken[:, i]) for i, cosine in enumerate(formed)}
    return angles | {"out_status": outcome.status}


def table_ik6(p: Params, **ports: Ints) -> dict[str, Ints]:
    """`ik6` to binary angles."""
    return to_angles(inverse(p), p, **ports)
