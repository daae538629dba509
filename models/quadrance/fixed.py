"""Fixed-point formats, rounding and saturation, as every core does them, on int64 arrays.

A signed word of W bits with F fraction bits carries v / 2^F, v in [-2^(W-1), 2^(W-1)).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Ints = NDArray[np.int64]


def ints(value: ArrayLike) -> Ints:
    """`value` as an int64 array (shape kept)."""
    return np.asarray(value, dtype=np.int64)


def round_shift(value: ArrayLike, bits: int) -> Ints:
    """``floor(value / 2^bits + 1/2)``: nearest, ties upward. Error at most half a result LSB."""
    value = ints(value)
    return value if bits == 0 else (value + (1 << bits - 1)) >> bits


def saturate(value: ArrayLike, width: int) -> tuple[Ints, NDArray[np.bool_]]:
    """`value` clamped to a signed word of `width` bits, and where that changed it."""
    value = ints(value)
    clamped = np.clip(value, -(1 << width - 1), (1 << width - 1) - 1)
    return clamped, clamped != value


def wrap(value: ArrayLike, width: int, signed: bool = True) -> Ints:
    """The low `width` bits of `value`, read as two's complement if `signed`."""
    value = ints(value) & ((1 << width) - 1)
    return value - ((value >> width - 1) << width) if signed else value


def hold_last(value: ArrayLike, valid: ArrayLike, reset: int = 0) -> Ints:
    """`value` where `valid`; elsewhere the last valid value before it, `reset` where there is none.

    The model of a register that keeps its word while a joint direction is undefined.
    Works along the last axis, which is the order of the stream.
    """
    value, valid = ints(value), np.asarray(valid, dtype=bool)
    last = np.maximum.accumulate(np.where(valid, np.arange(value.shape[-1]), -1), axis=-1)
    return np.where(last < 0, reset, np.take_along_axis(value, np.maximum(last, 0), axis=-1))


def isqrt(value: ArrayLike) -> Ints:
    """``floor(sqrt(value))`` for 0 <= value < 2^62, exact."""
    value = ints(value)
    root = np.sqrt(value.astype(np.float64)).astype(np.int64)
    root = root - (root * root > value)
    return root + ((root + 1) * (root + 1) <= value)


def to_fixed(value: ArrayLike, fraction: int) -> Ints:
    """`value` (float) to the nearest multiple of 2^-fraction, as an integer."""
    return np.floor(np.asarray(value, dtype=np.float64) * 2.0**fraction + 0.5).astype(np.int64)


def to_float(value: ArrayLike, fraction: int) -> NDArray[np.float64]:
    """Integer word of `fraction` fraction bits to float64."""
    return ints(value).astype(np.float64) * 2.0**-fraction
