"""Bit-true models of rtl/arith: square root, division, reciprocal, rounding with saturation, skid buffer.

comb, iter and pipe of one function are the same function, so they share one model. Every model takes the
Verilog parameters and the input words by port name and returns every output word by port name.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from quadrance import fixed
from quadrance.fixed import Ints, ints

Params = dict[str, int]


def isqrt(p: Params, *, in_d: Ints) -> dict[str, Ints]:
    """``root = floor(sqrt(d * 4^F))`` and the exact ``rem = d * 4^F - root^2``, 0 <= rem <= 2 root.

    Needs W + 2 F <= 62.
    """
    radicand = ints(in_d) << 2 * p["F"]
    root = fixed.isqrt(radicand)
    return {"out_root": root, "out_rem": radicand - root * root}


def divide(p: Params, *, in_n: Ints, in_d: Ints) -> dict[str, Ints]:
    """``n * 2^F = q * d + r``, 0 <= r < d; d = 0 gives q all ones and ``r = n * 2^F mod 2^WD``.

    Needs WN + F <= 62.
    """
    n, d = np.broadcast_arrays(ints(in_n) << p["F"], ints(in_d))
    zero = d == 0
    q, r = np.divmod(n, np.where(zero, 1, d))
    return {"out_q": np.where(zero, (1 << p["WN"] + p["F"]) - 1, q),
            "out_r": np.where(zero, fixed.wrap(n, p["WD"], signed=False), r),
            "out_div_by_zero": zero.astype(np.int64)}


@cache
def _reciprocal_slopes() -> Ints:
    """2^18 / q^2 in the middle of q = a / 512 to (a + 1) / 512, raised as reciprocal_product.v says.

    Below 1/4 such that 1 / q stays just below 4.
    """
    below = [(1 << 29) // (max(a, 64) + 1) for a in range(128)]
    return ints(below + [((((2 * b * b + 1) * (1024 * b + 1) << 16) // b**3 << 12) // (b * b) + 1) >> 1
                         for b in range(257, 4096, 2)])


def reciprocal_product(qs: Ints) -> Ints:
    """``2^24 / q``, q = qs / 2^19 from 1/4 to 4, as a tangent's product; relative error 2^-17 up to 2, 2^-15 at 4."""
    return (qs ^ 0x3FF) * _reciprocal_slopes()[qs >> 10] >> 13


def round_saturate(p: Params, *, in_x: Ints) -> dict[str, Ints]:
    """``floor(x / 2^SHIFT + 1/2)`` clamped to WO signed bits, and whether it was clamped."""
    x, overflow = fixed.saturate(fixed.round_shift(in_x, p["SHIFT"]), p["WO"])
    return {"out_x": x, "out_overflow": overflow.astype(np.int64)}


def skid_buffer(p: Params, *, in_d: Ints) -> dict[str, Ints]:
    """The word itself: only the handshake is registered."""
    return {"out_d": ints(in_d)}
