"""Error bound of rtl/tool, in LSB of a coordinate."""

from __future__ import annotations

import math

from quadrance.product_engine import H
from quadrance.truth import Floats, floats


def coordinate(p: dict[str, int], reach: Floats) -> Floats:
    """A coordinate of vector_xyzac and vector_xyzbc against the directions of the vectors.

    Half an LSB; two sums on the way to it and its own, each off by half of 2^-25 and an eighth for each of its products
    on either side, the first of them turned once more: 4 units. `reach` (LSB) is the distance of the point from
    (xr, yr, zs) and the offset d, together, which two vectors turn.
    """
    return 0.5 + 4 * 2.0 ** (p["W"] - H) + 2 * math.sqrt(0.5) * 1.001 * 2.0 ** -p["U"] * floats(reach)
