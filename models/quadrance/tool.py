"""Bit-true models of rtl/tool: axes of machine tools, by the programs in rtl/program that their cores play."""

from __future__ import annotations

from quadrance.cores import RTL
from quadrance.fixed import Ints
from quadrance.program import meaning, parser

Params = dict[str, int]
XYZAC, XYZBC = (RTL / "program" / f"vector_{name}.kin" for name in ("xyzac", "xyzbc"))


def config(p: Params, *, x_rot: float, y_rot: float, z_rot: float, offset: float, z_offset: float,
           tool: float) -> dict[str, int]:
    """Configuration words from the pins of LinuxCNC's xyzac-trt and xyzbc-trt, in coordinate units.

    Parameters
    ----------
    x_rot, y_rot, z_rot : `x-rot-point` and its like, a point of the axis of table C.
    offset : `y-offset` of xyzac-trt, `x-offset` of xyzbc-trt: of the tilting axis.
    z_offset, tool : `z-offset`, `tool-offset`. They and z_rot count together.
    """
    found = {"xr": x_rot, "yr": y_rot, "d": offset, "zs": z_rot + z_offset + tool}
    return {f"cfg_{name}": round(value * 2.0 ** p["F"]) for name, value in found.items()}


def xyzac(p: Params, **ports: Ints) -> dict[str, Ints]:
    """A table that turns about z on one that tilts about x."""
    return meaning.answer(parser.load(XYZAC), p, **ports)


def xyzbc(p: Params, **ports: Ints) -> dict[str, Ints]:
    """A table that turns about z on one that tilts about y."""
    return meaning.answer(parser.load(XYZBC), p, **ports)
