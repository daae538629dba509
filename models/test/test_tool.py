"""Machine tools: the bit-true models against LinuxCNC's formulas, and these against a chain of frames."""

from __future__ import annotations

import numpy as np
import pytest
from quadrance import tool
from quadrance.bounds import tool as bounds
from quadrance.cores import all_cores

from models.test import frames

CORES = [core for core in all_cores() if core.family == "tool" and not core.params["PIPE"]]
MODELS = pytest.mark.parametrize("kind", ["xyzac", "xyzbc"])
EACH = pytest.mark.parametrize("core", CORES, ids=lambda core: core.id)


def linuxcnc(kind, tilt, turn, place, point, offset, z_offset, length):
    """Axes x, y, z by the formulas of xyzac-trt and xyzbc-trt (LinuxCNC, src/emc/kinematics/trtfuncs.c), any unit.

    place : of the tool's tip on the workpiece, (N, 3). point : x-rot-point, y-rot-point, z-rot-point.
    """
    (x, y, z), dz = (place - point).T, z_offset + length
    ct, st, cc, sc = np.cos(tilt), np.sin(tilt), np.cos(turn), np.sin(turn)
    if kind == "xyzac":
        found = (cc * x - sc * y, sc * ct * x + cc * ct * y - st * z - ct * offset + st * dz + offset,
                 sc * st * x + cc * st * y + ct * z - st * offset - ct * dz + dz)
    else:
        found = (cc * ct * x - sc * ct * y + st * z - ct * offset - st * dz + offset, sc * x + cc * y,
                 -cc * st * x + sc * st * y + ct * z + st * offset - ct * dz + dz)
    return np.stack(found, axis=-1) + point


def drawn(count, seed, size):
    """Angles, places, and the words of a machine, of a size."""
    rng = np.random.default_rng(seed)
    angles = rng.uniform(-np.pi, np.pi, (2, count))
    return angles[0], angles[1], rng.uniform(-size, size, (count, 3)), rng.uniform(-size, size, 3) / 4, *(
        rng.uniform(-size, size, 3) / 8)


@MODELS
def test_linuxcnc_is_two_tables_in_a_chain(kind):
    """The workpiece turns about z through the point, both tilt about the axis that is off by the offsets."""
    tilt, turn, place, point, offset, z_offset, length = drawn(1000, 1, 100.0)
    axis = (0, offset) if kind == "xyzac" else (offset, 0)
    x, y, z = point + (*axis, z_offset + length)
    away = frames.shift(*point) @ frames.turn("z", turn) @ frames.shift(*-point)
    away = frames.shift(x, y, z) @ frames.turn(kind[3].replace("a", "x").replace("b", "y"), tilt) @ frames.shift(
        -x, -y, -z) @ away
    found = (away @ np.append(place, np.ones((1000, 1)), axis=1)[..., None])[:, :3, 0]
    assert np.abs(found - linuxcnc(kind, tilt, turn, place, point, offset, z_offset, length)).max() < 1e-9


@EACH
@pytest.mark.parametrize("count", [2000, pytest.param(100_000, marks=pytest.mark.slow)])
def test_axes(core, count):
    """Within the law of LinuxCNC's formulas at the directions of the words; saturated where these are beyond."""
    p, kind = core.params, core.function
    unit, end = 2.0 ** -p["F"], 2.0 ** (p["W"] - 1)
    tilt, turn, place, point, offset, z_offset, length = drawn(count, count, end * unit * 0.8)
    cfg = tool.config(p, x_rot=point[0], y_rot=point[1], z_rot=point[2], offset=offset, z_offset=z_offset, tool=length)
    words = {f"in_{axis}": np.rint(place[:, i] / unit).astype(np.int64) for i, axis in enumerate("xyz")}
    for name, angle in ((kind[3], tilt), ("c", turn)):
        words |= {f"in_{letter}{name}": np.rint(part(angle) * 2.0 ** p["U"]).astype(np.int64)
                  for letter, part in (("c", np.cos), ("n", np.sin))}
    tilt, turn = (np.arctan2(words[f"in_n{name}"], words[f"in_c{name}"]) for name in (kind[3], "c"))
    held = np.array([cfg["cfg_xr"], cfg["cfg_yr"], 0])  # zs is z_rot, z_offset and the tool's length together
    place = np.stack([words[f"in_{axis}"] for axis in "xyz"], axis=-1)
    exact = linuxcnc(kind, tilt, turn, place, held, cfg["cfg_d"], cfg["cfg_zs"], 0)
    answer = core.model(p, **words, **cfg)
    found = np.stack([answer[f"out_{axis}"] for axis in "xyz"], axis=-1)
    law = bounds.coordinate(p, np.linalg.norm(place - held - [0, 0, cfg["cfg_zs"]], axis=-1) + abs(cfg["cfg_d"]))
    over = answer["out_status"] == 4
    off = np.abs(found - exact).max(axis=-1)
    assert np.all(off[~over] <= law[~over]) and off[~over].max() > 0.5 and 0.5 < (~over).mean() < 1
    beyond = np.abs(exact + 0.5).max(axis=-1) - end
    assert np.all(over[beyond > law]) and not np.any(over[beyond < -law])
    rounding = linuxcnc(kind, tilt, turn, place * unit, point, offset, z_offset, length) - exact * unit
    assert np.abs(rounding).max() <= 4 * unit
