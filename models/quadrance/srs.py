"""Bit-true model of rtl/srs: seven axes with a spherical shoulder and a spherical wrist, by the program of its core.

A word carries 1.0 as 2^25; 1.0 of a length is 2^W LSB of a coordinate.
"""

from __future__ import annotations

from quadrance.cores import RTL
from quadrance.fixed import Ints
from quadrance.program import meaning, parser
from quadrance.program.meaning import MORE
from quadrance.six import to_angles, triangle

Params = dict[str, int]
INVERSE = RTL / "program" / "vector_srs_ik.kin"


def config(p: Params, *, d: float, l1: float, l2: float, l4: float, margin: float = 0.0,
           slack: float = 0.0) -> dict[str, int]:
    """Configuration words of vector_srs_ik, from lengths (`truth_srs.Srs`), margin and slack in coordinate units."""
    words = {f"cfg_{name}": round(value * 2.0 ** (p["F"] + MORE)) for name, value in
             (("d", d), ("l1", l1), ("l2", l2), ("l4", l4))}
    return words | {f"cfg_{name}": round(value * 2.0 ** p["F"]) for name, value in
                    (("margin", margin), ("slack", slack))} | triangle(p, words["cfg_l1"], words["cfg_l2"])


def ik(p: Params, **ports: Ints) -> dict[str, Ints]:
    """One branch of a pose, for one swivel."""
    return meaning.answer(parser.load(INVERSE), p, **ports)


def table_ik(p: Params, **ports: Ints) -> dict[str, Ints]:
    """`ik` to binary angles."""
    return to_angles(parser.load(INVERSE), p, **ports)
