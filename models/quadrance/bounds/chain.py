"""Bounds of the streamed chains, whose positions add up link by link: vector_chain, table_chain, paper_mff."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from quadrance import chain
from quadrance.bounds import codec, table
from quadrance.truth import Floats, floats

Params = dict[str, int]

SUM = 0.5 + 1 / 16
"""Rounding, and the products of a sum: each of k <= N <= 2^D is truncated by less than 2^-G, G = D + 3, and the sum
starts 2^(D - 1) of these high."""


def table_sine(p: Params) -> float:
    """Error of a sine or cosine of table_chain: it has the table of table_fk2, in space that of table_fk3."""
    return table.sine(p, 2 + p["SPACE"])


def table_chain(p: Params, lengths: ArrayLike) -> Floats:
    """A coordinate after each link of a chain (n,), LSB: the directions are exact sums, each has its sine's error."""
    return SUM + table_sine(p) * np.cumsum(floats(lengths))


def table_chain_space(p: Params, lengths: ArrayLike) -> tuple[Floats, Floats]:
    """x or y, and z, of table_chain in space after each link (n,), LSB.

    Products have one guard bit more than in the plane, so a sum of them has half of `SUM`'s 1/16. In x and y the factor
    d, itself truncated by less than 2^-(G+1), adds up to 2^-(G+1) a link; the yaw's root errs once more by its own.
    """
    roots = table_sine(p) * np.cumsum(floats(lengths))
    return SUM + 1 / 32 + 2 * roots, SUM - 1 / 32 + roots


def vector_chain(p: Params, lengths: ArrayLike) -> Floats:
    """A coordinate after each link of a chain (n,), LSB, against the product of the vectors as they are given.

    Units of 2^-(U+G): a turn truncates two products of C and two of N, each sum starts a unit high, and C is low by N
    for the one's complement of n. So C is off by up to 2, N by up to 1, together by sqrt(5); later turns carry that
    along without enlarging it, but for the length of a rounded vector. The error of a direction grows with the links
    before it, that of a position with their number times the length.
    """
    links = np.arange(1, np.size(lengths) + 1)
    turned = math.sqrt(5) * 2.0 ** -(p["U"] + chain.sizes(p)[1]) * links * (1 + vector_word(p)) ** links
    return SUM + np.cumsum(floats(lengths) * turned)


def vector_word(p: Params) -> float:
    """How far the length of a rounded unit vector is from 1, at most."""
    return math.sqrt(0.5) * 2.0 ** -p["U"]


def vector_chain_directions(p: Params, lengths: ArrayLike) -> Floats:
    """A coordinate of vector_chain against the vectors' directions: their lengths multiply, link by link."""
    links = np.arange(1, np.size(lengths) + 1)
    return vector_chain(p, lengths) + np.cumsum(floats(lengths) * ((1 + vector_word(p)) ** links - 1))


def vector_chain_space(p: Params, lengths: ArrayLike) -> tuple[Floats, Floats]:
    """x or y, and z, of vector_chain in space against the vectors' directions, after each link (n,), LSB.

    As in `table_chain_space` z has half of `SUM`'s 1/16, x and y have 1/16 more of d; the yaw's length stretches d.
    """
    z = vector_chain_directions(p, lengths) - 1 / 32
    off = vector_word(p)
    return 0.5 + (z - 0.5 + 1 / 16) * (1 + off) + off * np.cumsum(floats(lengths)), z


def mff(p: Params, lengths: ArrayLike) -> tuple[Floats, Floats]:
    """x or y, and z, of paper_mff after each link of a chain (n,), LSB.

    `SUM`, and a root's error times the length; x and y have a second root. Their product has been truncated twice, so a
    positive one loses up to two units of 2^-G, a negative one up to one and gains up to one: three times `SUM`'s part.
    """
    root = codec.spread_chord(p["U"]) * 2.0 ** -p["U"] * np.cumsum(floats(lengths))
    return 0.5 + 3 / 16 + 2 * root, SUM + root
