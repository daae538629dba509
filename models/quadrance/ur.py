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


def solved(p: Params, **ports: Ints) -> meaning.Outcome:
    """What the program of all branches finds for a pose."""
    ports = dict(zip(ports, np.broadcast_arrays(*map(np.atleast_1d, ports.values()))))
    return meaning.fixed(parser.load(ALL), p, **ports)


def named(branch: int) -> list[str]:
    """How the words of joints 1 to 6 of a branch end in the program of all branches."""
    s, t, w = (letters[branch >> i & 1] for i, letters in enumerate(("fb", "ud", "pm")))
    return [s, t + w + s, w + s, t + w + s, s, s]


def flags(outcome: meaning.Outcome, branch: int) -> tuple[Ints, Ints]:
    """Where a branch is out of reach, and where it is singular."""
    s, bent, turned, *_ = named(branch)
    near, back, flip = outcome.near, branch & 1, branch >> 2
    far = outcome.beyond["q"] | outcome.beyond[f"c3{turned}"]
    held = np.any(np.broadcast_arrays(*(outcome.none[f"c{name}"] for name in (f"1{s}", f"6{s}", f"2{bent}")),
                                      near["c1"][0], near["c6"][back], near["c2"][2 * back + flip]), axis=0)
    return ints(far), ints(held)


def ik_all(p: Params, **ports: Ints) -> dict[str, Ints]:
    """All branches of a pose."""
    outcome = solved(p, **ports)
    answer, far, held = {}, ints(0), ints(0)
    for branch in range(8):
        down, flip = branch >> 1 & 1, branch >> 2
        for i, name in enumerate(named(branch), 1):
            for letter in "cn":
                minus = letter == "n" and (i == 3 and down or i == 5 and flip) or i == 6 and flip
                word = outcome.words[f"{letter}{i}{name}"]
                answer[f"out_{letter}{i}{branch}"] = meaning.near_vector(p, -word if minus else word)
        far, held = (bits | one << branch for bits, one in zip((far, held), flags(outcome, branch)))
    status = ints(far != 0) + 2 * ints(held != 0) + 8 * ints(outcome.wrong)
    return answer | {"out_far": far, "out_held": held, "out_status": status}
