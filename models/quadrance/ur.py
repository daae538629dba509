"""Bit-true models of rtl/ur: six axes of which 2, 3 and 4 are parallel, by the programs that the cores play.

A word carries 1.0 as 2^25; 1.0 of a length is 2^W LSB of a coordinate.
"""

from __future__ import annotations

import numpy as np

from quadrance.cores import RTL
from quadrance.fixed import Ints, ints
from quadrance.program import meaning, parser
from quadrance.program.meaning import MORE
from quadrance.six import to_angles, triangle, vectors_of

Params = dict[str, int]
FORWARD, INVERSE, ALL = (RTL / "program" / f"vector_ur_{name}.kin" for name in ("fk", "ik", "ik_all"))


def forward_config(p: Params, *, d1: float, d4: float, d5: float, d6: float, l2: float, l3: float) -> dict[str, int]:
    """Configuration words of vector_ur_fk, 2^-4 LSB, from lengths in coordinate units (`truth_ur.Ur`)."""
    return {f"cfg_{name}": round(value * 2.0 ** (p["F"] + MORE)) for name, value in
            (("d1", d1), ("d4", d4), ("d5", d5), ("d6", d6), ("l2", l2), ("l3", l3))}


def config(p: Params, *, margin: float = 0.0, slack: float = 0.0, **lengths: float) -> dict[str, int]:
    """Configuration words of vector_ur_ik, from lengths, margin and slack in coordinate units."""
    words = forward_config(p, **lengths)
    return words | {f"cfg_{name}": round(value * 2.0 ** p["F"]) for name, value in
                    (("margin", margin), ("slack", slack))} | triangle(p, words["cfg_l2"], words["cfg_l3"])


def fk(p: Params, **ports: Ints) -> dict[str, Ints]:
    """Six joints to a pose."""
    return meaning.answer(parser.load(FORWARD), p, **ports)


def ik(p: Params, **ports: Ints) -> dict[str, Ints]:
    """One branch of a pose."""
    return meaning.answer(parser.load(INVERSE), p, **ports)


def table_fk(p: Params, **ports: Ints) -> dict[str, Ints]:
    """`fk` of binary angles."""
    return fk(p, **vectors_of(p, ports))


def table_ik(p: Params, **ports: Ints) -> dict[str, Ints]:
    """`ik` to binary angles."""
    return to_angles(parser.load(INVERSE), p, **ports)


def ik_all(p: Params, **ports: Ints) -> dict[str, Ints]:
    """All branches of a pose."""
    ports = dict(zip(ports, np.broadcast_arrays(*map(np.atleast_1d, ports.values()))))
    outcome = meaning.fixed(parser.load(ALL), p, **ports)
    words, none, near = outcome.words, outcome.none, outcome.near
    answer, far, held = {}, ints(0), ints(0)
    for branch in range(8):
        back, down, flip = (branch >> i & 1 for i in range(3))
        s, w, t = "fb"[back], "pm"[flip], "ud"[down]
        for i, name, minus in ((1, s, 0), (2, t + w + s, 0), (3, w + s, down), (4, t + w + s, 0), (5, s, flip),
                               (6, s, flip)):
            for letter in "cn":
                turned = minus and not (letter == "c" and i in (3, 5))
                word = words[f"{letter}{i}{name}"]
                answer[f"out_{letter}{i}{branch}"] = meaning.near_vector(p, -word if turned else word)
        far = far | ints(outcome.beyond["q"] | outcome.beyond[f"c3{w}{s}"]) << branch
        singular = (none[f"c1{s}"] | none[f"c6{s}"] | none[f"c2{t}{w}{s}"] | near["c1"][0] | near["c6"][back]
                    | near["c2"][2 * back + flip])
        held = held | ints(singular) << branch
    status = ints(far != 0) + 2 * ints(held != 0) + 8 * ints(outcome.wrong)
    return answer | {"out_far": far, "out_held": held, "out_status": status}
