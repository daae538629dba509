"""Bit-true models of rtl/vector: joint words are unit vectors (c, n), 1.0 is 2^U; products only, no angle anywhere."""

from __future__ import annotations

from types import ModuleType

import numpy as np

from quadrance import kernel_vector_solve, kernel_vector_wide
from quadrance.fixed import Ints, hold_last, ints, round_shift, saturate, wrap
from quadrance.kernel_vector_wide import form, unit_word

__all__ = ["config", "fk1", "fk2", "fk3", "ik1", "ik2", "ik3"]  # config: words of the inverse cores beside the lengths

Params = dict[str, int]
GUARD = 5  # bits of A, B and rho below the LSB of a coordinate


# Forward


def _coordinates(p: Params, axes: str, words: tuple[Ints, ...], guard: int) -> dict[str, Ints]:
    """Coordinates to nearest, ties upward, saturated, and the overflow of any; beyond 2^(W + 1) LSB they wrap."""
    answer, overflow = {}, ints(0)
    for axis, word in zip(axes, words):
        answer[f"out_{axis}"], over = saturate(wrap(round_shift(word, guard), p["W"] + 2), p["W"])
        overflow = overflow | over
    return answer | {"out_status": 4 * overflow}


def config(p: Params, *, cfg_l1: int, cfg_l2: int, margin: float = 0.0, slack: float = 0.0) -> dict[str, int]:
    """Words of the inverse cores beside the lengths; margin and slack in coordinate units."""
    words = kernel_vector_wide.config(p, cfg_l1=cfg_l1, cfg_l2=cfg_l2)
    return words | kernel_vector_solve.edge_words(p, words, cfg_l1=cfg_l1, cfg_l2=cfg_l2, margin=margin, slack=slack,
                                                  bits=form(p).bits)


def fk1(p: Params, *, in_c1: Ints, in_n1: Ints, cfg_l1: Ints) -> dict[str, Ints]:
    """``x = L1 c1, y = L1 n1``, nearest (ties upward) and saturated: within 1/2 LSB of the vector as it is given."""
    l1 = ints(cfg_l1)
    return _coordinates(p, "xy", (l1 * ints(in_c1), l1 * ints(in_n1)), p["U"])


def _plane(p: Params, c1: Ints, n1: Ints, c2: Ints, n2: Ints, l1: Ints, l2: Ints) -> tuple[Ints, Ints]:
    """(x, y) of two joints with GUARD bits: every product is truncated, and -B is the one's complement."""
    bits = p["W"] + 2 + GUARD

    def cut(word: Ints, factor: Ints) -> Ints:
        return wrap(word * ints(factor) >> p["U"], bits)

    l1, l2 = ints(l1) << GUARD, ints(l2) << GUARD
    a, b = wrap(cut(l2, c2) + l1, bits), cut(l2, n2)
    return wrap(cut(a, c1) + cut(~b, n1), bits), wrap(cut(a, n1) + cut(b, c1), bits)


def fk2(p: Params, *, in_c1: Ints, in_n1: Ints, in_c2: Ints, in_n2: Ints, cfg_l1: Ints,
        cfg_l2: Ints) -> dict[str, Ints]:
    """``x = A c1 - B n1, y = A n1 + B c1`` with ``A = L1 + L2 c2, B = L2 n2``."""
    return _coordinates(p, "xy", _plane(p, in_c1, in_n1, in_c2, in_n2, cfg_l1, cfg_l2), GUARD)


def fk3(p: Params, *, in_c1: Ints, in_n1: Ints, in_c2: Ints, in_n2: Ints, in_c3: Ints, in_n3: Ints, cfg_l1: Ints,
        cfg_l2: Ints) -> dict[str, Ints]:
    """`fk2` in the plane of the arm, (rho, z), then ``x = rho c3, y = rho n3``; rho keeps its sign and its fraction."""
    rho, z = _plane(p, in_c1, in_n1, in_c2, in_n2, cfg_l1, cfg_l2)
    x, y = (wrap(rho * ints(factor) >> p["U"], p["W"] + 2 + GUARD) for factor in (in_c3, in_n3))
    return _coordinates(p, "xyz", (x, y, z), GUARD)


# Inverse


def ik1(p: Params, *, in_x: Ints, in_y: Ints) -> dict[str, Ints]:
    """``(x, y) / sqrt(x^2 + y^2)``, each coordinate nearest (ties upward); the last vector where x = y = 0."""
    f = form(p)
    x, y = (ints(word) << f.bits - p["W"] for word in np.broadcast_arrays(in_x, in_y))
    zero = (x == 0) & (y == 0)
    if f.bits == 16:
        c, n = (word + (1 << 16 - p["U"]) >> 17 - p["U"] for word in kernel_vector_solve.aim(x, y))
    else:
        c, n = (unit_word(p, word) for word in kernel_vector_wide.aim(f, x, y))
    return {"out_c1": hold_last(c, ~zero, 1 << p["U"]), "out_n1": hold_last(n, ~zero), "out_status": 2 * ints(zero)}


def _held(p: Params, joint: int, c: Ints, n: Ints, undefined: Ints) -> dict[str, Ints]:
    """The words of a joint, the last ones where it has no direction."""
    return {f"out_c{joint}": hold_last(unit_word(p, c), ~undefined, 1 << p["U"]),
            f"out_n{joint}": hold_last(unit_word(p, n), ~undefined)}


def kernel(p: Params) -> ModuleType:
    """The kernel of these coordinates."""
    return kernel_vector_solve if form(p).bits == 16 else kernel_vector_wide


def ik2(p: Params, *, in_x: Ints, in_y: Ints, in_elbow: Ints, cfg_l1: Ints, cfg_l2: Ints, cfg_q: Ints, cfg_r: Ints,
        cfg_e: Ints, cfg_margin: Ints = 0, cfg_slack: Ints = 0) -> dict[str, Ints]:
    """Joints of the tip (x, y), of the nearest point of the annulus where it is out of reach."""
    c1, n1, c2, n2, clamped, zero, near = kernel(p).plane(
        p, in_x, in_y, in_elbow, cfg_l1, cfg_l2, cfg_q, cfg_r, cfg_e,
        limits=(cfg_margin, cfg_slack) if p.get("MARGINS") else None)
    return {**_held(p, 1, c1, n1, zero), "out_c2": unit_word(p, c2), "out_n2": unit_word(p, n2),
            "out_status": ints(clamped) + 2 * ints(zero | near)}


def ik3(p: Params, *, in_x: Ints, in_y: Ints, in_z: Ints, in_elbow: Ints, cfg_l1: Ints, cfg_l2: Ints, cfg_q: Ints,
        cfg_r: Ints, cfg_e: Ints, cfg_margin: Ints = 0, cfg_slack: Ints = 0) -> dict[str, Ints]:
    """Joint 3 has the direction of (x, y); then `ik2` on (rho, z), rho with GUARD fraction bits."""
    c1, n1, c2, n2, clamped, zero, near, c3, n3, on_axis = kernel(p).space(
        p, in_x, in_y, in_z, in_elbow, cfg_l1, cfg_l2, cfg_q, cfg_r, cfg_e,
        limits=(cfg_margin, cfg_slack) if p.get("MARGINS") else None)
    return {**_held(p, 1, c1, n1, zero), "out_c2": unit_word(p, c2), "out_n2": unit_word(p, n2),
            **_held(p, 3, c3, n3, on_axis), "out_status": ints(clamped) + 2 * ints(on_axis | near)}
