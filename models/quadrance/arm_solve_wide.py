"""Bit-true model of arm_solve_wide: joint 3 of a real arm, and its distance from the yaw axis, in words of more than 16
bits. The other joints are those of `kernel_vector_wide`.
"""

from __future__ import annotations

import numpy as np

from quadrance.fixed import Ints, ints, wrap
from quadrance.kernel_vector_solve import GUARD, SUM, turned
from quadrance.kernel_vector_wide import Format, _direction_power, _reciprocal, _shifted, _spare_pairs


def yaw(f: Format, x: Ints, y: Ints, shoulder: Ints | None, back: Ints) -> tuple[Ints, Ints, Ints]:
    """`kernel_vector_wide.yaw` for either side of the shoulder. Its offset, where there is one, is subtracted from the
    length and takes the place of what rounds it.
    """
    q = x * x + y * y
    s = _spare_pairs(f, q)
    power, one = 2 * _direction_power(f, s) * np.where(back != 0, -1, 1) + 1, ints(1)
    r = _reciprocal(f, q << SUM, s, np.True_)
    c, n = (_shifted(f, turned(*k, x, y), s >> 1) * r for k in ((power, one), (-one, power)))
    cut = 2 * f.fraction - 3 - f.bits  # cosines keep bits + 2 fraction bits, the sum has bits + 1
    total = turned(2 * (c >> cut) + 1, 2 * (n >> cut) + 1, x, y)
    more = 1 << f.bits - GUARD if shoulder is None else -(shoulder << f.bits + 1) - (1 << SUM)
    return c, n, total + more >> f.bits + 1 - GUARD


def _radius(f: Format, q: Ints, back: Ints) -> Ints:
    """The root of q with the sign of the shoulder's side, GUARD fraction bits; 0 where q is negative."""
    q = np.maximum(q, 0)
    s = _spare_pairs(f, q)
    product = _shifted(f, q << SUM, s >> 1) * _reciprocal(f, q << SUM, s, np.True_)
    return wrap(product >> 2 * f.fraction - f.bits - GUARD - (s & 1), f.bits + 6) ^ -ints(back != 0)


def beside(f: Format, x: Ints, y: Ints, lateral: Ints, square: Ints, back: Ints) -> tuple[Ints, ...]:
    """`yaw` of an arm whose plane passes beside the axis, and whether the point is nearer to it than that.

    Joint 3 is the point seen from (rho, b), whose length is the point's own. Nearer than b rho is 0, and a direction is
    all that matters: a power of two replaces b, and the products are with 2 / sqrt(q') instead of 1/q'.
    """
    q = x * x + y * y
    near, s = q < square, _spare_pairs(f, q)
    k1 = 2 * np.where(near, 0, _radius(f, q - square, back)) + 1
    k2 = 2 * np.where(near, _direction_power(f, s) * np.where(lateral < 0, -1, 1), lateral << GUARD) + 1
    r = _reciprocal(f, q << SUM, s, near)
    c, n = (_shifted(f, turned(*k, x, y), np.where(near, s >> 1, s)) * r for k in ((k1, k2), (-k2, k1)))
    return c, n, k1 >> 1, near
