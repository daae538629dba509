"""This module draws the tip error of arm_ik3 over a vertical section through the yaw axis of every arm.

    python -m quadrance.workspaces       writes rtl/arm/workspaces.png and prints the greatest error of each arm

Right of the axis the arm reaches forward, left of it over its shoulder (in_back = 1). Words are those of W = 16, F = 8,
U = 16; the error is that of the directions that the words represent.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from quadrance import arm, arms, truth_arm
from quadrance.truth import Floats

PICTURE = Path(__file__).resolve().parents[2] / "rtl" / "arm" / "workspaces.png"
P = {"W": 16, "F": 8, "U": 16}
YAW = 0.7  # of the section, radians: off the axes


def section(built: arms.Arm, places: int = 121, elbow: int = 0) -> tuple[Floats, Floats, Floats]:
    """(r, z, error), each (places, places): distance from the yaw axis and height, mm, and error at the tip, LSB.

    r < 0 is over the shoulder. The error is NaN out of reach.
    """
    p = P | arm.switches(built)
    lsb, frame = built.mm_per_unit / 256, truth_arm.frame(built)
    far = sum(built.links) + abs(frame.shoulder) + abs(frame.lateral)
    r, z = np.meshgrid(np.linspace(-far, far, places), np.linspace(-1, 1, places) * sum(built.links) + frame.base)
    back = (r < 0).astype(np.int64)
    target = [np.rint(np.abs(r) * 256 * np.cos(YAW)), np.rint(np.abs(r) * 256 * np.sin(YAW)), np.rint(z * 256)]
    words = [np.clip(word, -32768, 32767).astype(np.int64) for word in target]
    out = arm.ik3(p, **{f"in_{axis}": word.ravel() for axis, word in zip("xyz", words)}, in_elbow=elbow,
                  in_back=back.ravel(), **arm.words(p, built, True))
    theta = [np.arctan2(out[f"out_n{i}"], out[f"out_c{i}"]) for i in (1, 2, 3)]
    tip = np.stack(truth_arm.fk3(*theta, *built.links, frame)) * 256
    error = np.linalg.norm(tip - np.stack([word.ravel() for word in words]), axis=0)
    held = np.all([word == exact for word, exact in zip(words, target)], axis=0).ravel()
    regular = (out["out_status"] == 0) & held
    return r * 256 * lsb, z * 256 * lsb, np.where(regular, error, np.nan).reshape(r.shape)


def main() -> None:
    """Write the picture and print the greatest errors."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(2, 5, figsize=(15, 6), layout="constrained")
    for axis, name in zip(axes.ravel(), arms.known()):
        built = arms.load(name)
        r, z, error = section(built)
        shown = axis.pcolormesh(r, z, error, vmin=0, vmax=1, cmap="viridis", shading="nearest", rasterized=True)
        axis.set_title(built.name, fontsize=9)
        axis.set_aspect("equal")
        axis.tick_params(labelsize=7)
        print(f"{name:16} {np.nanmax(error):.2f} LSB at most, {np.nanmax(error) * built.mm_per_unit / 256:.3f} mm")
    figure.supxlabel("distance from the yaw axis, mm; left: over the shoulder", fontsize=9)
    figure.supylabel("height, mm", fontsize=9)
    figure.colorbar(shown, ax=axes, label="error at the tip, LSB", shrink=0.8)
    figure.savefig(PICTURE, dpi=60)


if __name__ == "__main__":
    main()
