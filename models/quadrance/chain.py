"""Bit-true models of the streamed chains, vector_chain, table_chain and paper_mff: a link a sample; and of paper_fk5.

The samples of one call are links in the order of the stream, from a reset on; `in_last` ends a chain, and the next
sample is the first link of the next one.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from quadrance import codecs, paper, table
from quadrance.fixed import Ints, ints, saturate, wrap
from quadrance.truth import Floats, floats

Params = dict[str, int]


def positions(theta: ArrayLike, lengths: ArrayLike) -> tuple[Floats, Floats]:
    """Float64 truth of one chain, (n,): where link k ends, ``sum over i <= k of L_i (cos, sin)(theta_1 + ... + i)``."""
    direction, lengths = np.cumsum(floats(theta)), floats(lengths)
    return np.cumsum(lengths * np.cos(direction)), np.cumsum(lengths * np.sin(direction))


def space_positions(yaw: float, theta: ArrayLike, lengths: ArrayLike) -> tuple[Floats, Floats, Floats]:
    """`positions` in a plane that is upright and yaws: (rho cos, rho sin, z)."""
    rho, z = positions(theta, lengths)
    return rho * np.cos(yaw), rho * np.sin(yaw), z


def fixed_positions(theta: ArrayLike, phi: ArrayLike, lengths: ArrayLike) -> tuple[Floats, Floats, Floats]:
    """Float64 truth of one chain of links in the fixed frame, (n,): theta from the y axis to x, phi from the z axis."""
    theta, phi, lengths = floats(theta), floats(phi), floats(lengths)
    parts = np.sin(phi) * np.sin(theta), np.sin(phi) * np.cos(theta), np.cos(phi)
    return tuple(np.cumsum(lengths * part) for part in parts)


# The stream


def first_links(last: Ints) -> Ints:
    """(N,) index of the first link of every sample's chain."""
    index = np.arange(last.size)
    return np.maximum.accumulate(np.where(np.append(1, last[:-1]) > 0, index, 0))


def sums(values: Ints, first: Ints) -> Ints:
    """Sum of `values` over a sample's chain up to the sample, modulo 2^64."""
    total = np.cumsum(values)
    return total - (total - values)[first]


def sizes(p: Params) -> tuple[int, int]:
    """(D, G): bits of a count below N, guard bits of sums and directions."""
    d = int(p["N"] - 1).bit_length()
    return d, d + 3


def _answer(p: Params, words: dict[str, Ints], last: Ints, flag: Ints) -> dict[str, Ints]:
    """Coordinates saturated, and the overflow of any of them or `flag`."""
    pairs = {axis: saturate(word, p["W"]) for axis, word in words.items()}
    overflow = np.any([over for _, over in pairs.values()], axis=0) | flag
    return {f"out_{axis}": value for axis, (value, _) in pairs.items()} | {
        "out_last": last, "out_status": 4 * ints(overflow)}


def _positions(p: Params, parts: tuple[Ints, ...], first: Ints, whole: int, more: int = 0) -> dict[str, Ints]:
    """Coordinates from the links' parts, G + `more` fraction bits; sums of `whole` bits before the point wrap.

    A sum starts from half an LSB and half of what N products lose.
    """
    d, g = sizes(p)
    g, half = g + more, (1 << g + more - 1) + (1 << d - 1)
    return {axis: wrap(sums(part, first) + half, whole + g) >> g for axis, part in zip("xyz", parts)}


def _stream(p: Params, *words: ArrayLike, more: int = 0) -> tuple[Ints, ...]:
    """The words as arrays, the length 0 beyond N links and `more`; then every sample's first link, and what is beyond.
    """
    *joints, length, last = (np.atleast_1d(word) for word in np.broadcast_arrays(*map(ints, words)))
    first = first_links(last)
    beyond = np.arange(last.size) - first >= p["N"] + more
    return *joints, np.where(beyond, 0, length), last, first, beyond


def table_chain(p: Params, *, in_j1: Ints, in_l: Ints, in_last: Ints) -> dict[str, Ints]:
    """``(x, y) + L (cos, sin)`` of the sum of the joint words; a product is truncated to G bits.

    In space that is (d, z), with one guard bit more, and the first word is the yaw: ``(x, y) + d (cos, sin)`` of it.
    """
    j, length, last, first, beyond = _stream(p, in_j1, in_l, in_last, more=p["SPACE"])
    k, t = table.sizes(p, 2 + p["SPACE"])
    yaw = (np.arange(last.size) == first) & (p["SPACE"] > 0)
    word, (d, g) = wrap(sums(np.where(yaw, 0, j), first), p["A"], signed=False), sizes(p)
    g = g + p["SPACE"]
    length = np.where(yaw, 0, length)
    parts = [table.root(k, t, p["A"], word, cosine) * length >> k - g for cosine in (True, False)]
    whole = p["W"] + d + 1
    if not p["SPACE"]:
        return _answer(p, _positions(p, parts, first, whole), last, beyond) | {"out_z": 0 * last}
    along = tuple(parts[0] * table.root(k, t, p["A"], j[first], cosine) >> k for cosine in (True, False))
    return _answer(p, _positions(p, (*along, parts[1]), first, whole, more=1), last, beyond)


def vector_directions(p: Params, c: Ints, n: Ints, last: Ints) -> tuple[Ints, Ints]:
    """Direction of every link, U + G fraction bits: all products truncated, a constant 1 below each sum.

    -n is the one's complement with G ones below it, so that C is low by N 2^-(U+G) more.
    """
    u, g = p["U"], sizes(p)[1]
    high, mask = 1 << u + g + 1, (1 << u + g + 2) - 1
    cosine, sine, found = 1 << u + g, 0, []
    for along, across, end in zip(c.tolist(), n.tolist(), last.tolist()):
        turned = (cosine * along >> u) + (sine * (-(across << g) - 1) >> u + g) + 1
        sine = ((cosine * across >> u) + (sine * along >> u) + 1 + high & mask) - high
        cosine = (turned + high & mask) - high
        found.append((cosine, sine))
        if end:
            cosine, sine = 1 << u + g, 0
    return tuple(ints(found).reshape(-1, 2).T)


def vector_chain(p: Params, *, in_c1: Ints, in_n1: Ints, in_l: Ints, in_last: Ints) -> dict[str, Ints]:
    """``(C, N) <- (C c - N n, C n + N c)``, then ``(x, y) + L (C, N)``; a product is truncated to G bits.

    In space that is (d, z), as in `table_chain`, and the first word is the yaw; no direction is turned by it.
    """
    c, n, length, last, first, beyond = _stream(p, in_c1, in_n1, in_l, in_last, more=p["SPACE"])
    yaw = (np.arange(last.size) == first) & (p["SPACE"] > 0)
    d, g = sizes(p)
    g, whole, links = g + p["SPACE"], p["W"] + d + 2, ~yaw
    # a chain that is its yaw alone has no link that could end it, nor has it turned anything
    turned = np.zeros((2, last.size), dtype=np.int64)
    turned[:, links] = vector_directions(p, c[links], n[links], last[links])
    parts = tuple(wrap(part * np.where(yaw, 0, length) >> p["U"] - p["SPACE"], p["W"] + 2 + g) for part in turned)
    if not p["SPACE"]:
        return _answer(p, _positions(p, parts, first, whole), last, beyond) | {"out_z": 0 * last}
    along = tuple(wrap(parts[0] * turn[first] >> p["U"], p["W"] + 2 + g) for turn in (c, n))
    return _answer(p, _positions(p, (*along, parts[1]), first, whole, more=1), last, beyond)


def mff(p: Params, *, in_j1: Ints, in_j2: Ints, in_l: Ints, in_last: Ints) -> dict[str, Ints]:
    """``(x, y, z) + L (sin phi sin theta, sin phi cos theta, cos phi)``; products truncated to G bits, then signed.

    A sign is that of the one's complement.
    """
    theta, phi, length, last, first, beyond = _stream(p, in_j1, in_j2, in_l, in_last)
    u, (d, g) = p["U"] + 1, sizes(p)
    (cos_t, sin_t), (cos_p, sin_p) = codecs.spread_chords(p, theta), codecs.spread_chords(p, phi)
    across = (length << g) * np.abs(sin_p) >> u
    parts = (across * np.abs(sin_t) >> u, across * np.abs(cos_t) >> u, (length << g) * np.abs(cos_p) >> u)
    signs = ((sin_p < 0) ^ (sin_t < 0), (sin_p < 0) ^ (cos_t < 0), cos_p < 0)
    parts = tuple(part ^ -ints(sign) for part, sign in zip(parts, signs))
    return _answer(p, _positions(p, parts, first, p["W"] + d + 1), last, beyond)


# Joints on the forearm


def paper_fk5(p: Params, *, in_j1: Ints, in_j2: Ints, in_j3: Ints, cfg_l1: Ints, cfg_d4: Ints,
              cfg_d5: Ints) -> dict[str, Ints]:
    """`paper.fk3` at two distances from the elbow: joints four and five (Fig. 11)."""
    found, status = {}, ints(0)
    for joint, distance in ((4, cfg_d4), (5, cfg_d5)):
        answer = paper.fk3(p, in_j1=in_j1, in_j2=in_j2, in_j3=in_j3, cfg_l1=cfg_l1, cfg_l2=distance)
        status = status | answer.pop("out_status")
        found |= {f"{name}{joint}": value for name, value in answer.items()}
    return found | {"out_status": status}
