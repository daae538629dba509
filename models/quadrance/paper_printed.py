"""The paper's forward kinematics in float64: as it is printed, and with each correction.

    python -m quadrance.paper_printed      writes rtl/paper/as_printed.png and prints the shares

Joint words are real turn-spreads in [0, 4) (quadrant + fraction, see `truth.spread_word_to_angle`), coordinates and
quadrances have the unit of the links and its square; arrays broadcast. Equation numbers are the paper's.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from quadrance import truth
from quadrance.truth import Floats, floats

PICTURE = Path(__file__).resolve().parents[2] / "rtl" / "paper" / "as_printed.png"
CORRECTIONS = ("mirror", "conditions", "sum", "rho")


def difference(a: Floats, b: Floats) -> Floats:
    """Spread difference ``a (-) b`` (eq. 15): the spread of the difference of two angles in the first quadrant."""
    return (np.sqrt(a * (1 - b)) - np.sqrt(b * (1 - a))) ** 2


def plus(a: Floats, b: Floats) -> Floats:
    """Spread sum ``a (+) b`` (eq. 22): the spread of the sum of two angles in the first quadrant."""
    return (np.sqrt(a * (1 - b)) + np.sqrt(b * (1 - a))) ** 2


def spread(word: ArrayLike) -> tuple[Floats, Floats]:
    """Quadrant 0...3 and spread of a joint word: 1 - f in odd quadrants, or the tip would jump at every border."""
    quadrant = np.floor(floats(word))
    fraction = word - quadrant
    return quadrant, np.where(quadrant % 2 == 1, 1 - fraction, fraction)


def signs(quadrant: Floats) -> tuple[Floats, Floats]:
    """Signs of the cosine and of the sine in a quadrant (Table I)."""
    return np.where((quadrant == 1) | (quadrant == 2), -1.0, 1.0), np.where(quadrant >= 2, -1.0, 1.0)


def table_two(j1: ArrayLike, j2: ArrayLike, l1: float, l2: float,
              corrections: tuple[str, ...] = CORRECTIONS) -> tuple[Floats, Floats]:
    """Tip (x, y) of two links by Table II, eqs. 53-60.

    `corrections` are some of `CORRECTIONS`: "mirror" takes row 5 - i in the paper's quadrants 1 and 3 of joint 1;
    "conditions" corrects the conditions of rows 1 and 4; "sum" takes the spread sum in rows 2 and 3 where
    Q2 (1 - s2) > Q1; "rho" is used by `fk3` alone.
    """
    (k1, s1), (k2, s2) = (spread(word) for word in np.broadcast_arrays(floats(j1), floats(j2)))
    q1, q2 = l1 * l1, l2 * l2
    row = k2 + 1
    if "mirror" in corrections:
        row = np.where(k1 % 2 == 0, 5 - row, row)  # quadrants are counted from 1 in the paper
    outer = (row == 1) | (row == 4)
    low = (row == 3) | (row == 4)
    q3 = np.maximum(q1 + q2 + np.where(outer, 2, -2) * np.sqrt(q1 * q2 * (1 - s2)), 0)
    base = np.clip(s2 * q2 / np.where(q3 == 0, 1, q3), 0, 1)
    a = np.where(low, 1 - s1, s1)
    s = np.clip(difference(a, base), 0, 1)
    holds = a >= base
    if "conditions" not in corrections:
        height = (1 - difference(s2, 1 - s1) ** 2) * q2
        holds = np.where(outer, s1 * q1 >= height, holds)
    major, minor = np.sqrt(q3 * (1 - s)), np.where(holds, 1, -1) * np.sqrt(q3 * s)
    if "sum" in corrections:
        folded = ~outer & (q2 * (1 - s2) > q1)
        s = np.clip(plus(a, base), 0, 1)
        major = np.where(folded, -np.sign(1 - a - base) * np.sqrt(q3 * (1 - s)), major)
        minor = np.where(folded, -np.sqrt(q3 * s), minor)
    sign_x, sign_y = signs(k1)
    return sign_x * np.where(low, minor, major), sign_y * np.where(low, major, minor)


def fk3(j1: ArrayLike, j2: ArrayLike, j3: ArrayLike, l1: float, l2: float,
        corrections: tuple[str, ...] = CORRECTIONS) -> tuple[Floats, Floats, Floats]:
    """Tip (x, y, z) by eqs. 24-31; "rho" restores the sign that the squares of x and y lose."""
    rho, z = table_two(j1, j2, l1, l2, corrections)
    k3, s3 = spread(j3)
    qa = rho * rho
    sign = np.where(rho < 0, -1, 1) if "rho" in corrections else 1
    sign_x, sign_y = signs(k3)
    return sign * sign_x * np.sqrt(qa * (1 - s3)), sign * sign_y * np.sqrt(qa * s3), z


def wrong(joints: int, l1: float, l2: float, corrections: tuple[str, ...], steps: int = 50) -> Floats:
    """Tip error over reach, (joint 1 words, joint 2 words): `steps` words a quadrant, none on a border.

    With three joints, joint 1 is in [0, 2] as in the paper, and joint 3 is fixed: the signs of x and y that it gives
    are right as printed.
    """
    words = (np.arange(4 * steps) + 0.5) / steps
    j1, j2 = np.meshgrid(words[:2 * steps] if joints == 3 else words, words, indexing="ij")
    t1, t2, t3 = (truth.spread_word_to_angle(floats(j) * 2.0**40, 40) for j in (j1, j2, 0.3))
    if joints == 2:
        tip, exact = table_two(j1, j2, l1, l2, corrections), truth.fk2(t1, t2, l1, l2)
    else:
        tip, exact = fk3(j1, j2, 0.3, l1, l2, corrections), truth.fk3(t1, t2, t3, l1, l2)
    return np.sqrt(sum((a - b) ** 2 for a, b in zip(tip, exact))) / (l1 + l2)


def share_right(joints: int, l1: float, l2: float, corrections: tuple[str, ...]) -> float:
    """Share of the joint words (joint 1 in [0, 2] in 3 DOF) whose tip is right."""
    return float(np.mean(wrong(joints, l1, l2, corrections, 200) < 1e-6))


def main() -> None:
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    steps = [CORRECTIONS[:n] for n in range(len(CORRECTIONS) + 1)]
    names = ["as printed", "row 5 \u2212 i", "conditions", "spread sum", "sign of \u03c1"]
    links = [(3, 2), (2, 3)]
    figure, axes = plt.subplots(2, 5, figsize=(11, 7.6), sharex=True, sharey=True, layout="constrained")
    for row, (l1, l2) in zip(axes, links):
        for panel, name, corrections in zip(row, names, steps):
            image = panel.imshow(wrong(3, l1, l2, corrections).T, origin="lower", extent=(0, 2, 0, 4), vmin=0, vmax=1,
                                 cmap="magma_r", interpolation="nearest")
            right = 100 * share_right(3, l1, l2, corrections)
            panel.set_title(f"{'' if name == names[0] else '+ '}{name}\n{right:.0f} % right")
            panel.set(xticks=range(3), yticks=range(5))
        row[0].set_ylabel(f"links {l1}, {l2}\njoint 2, turn-spread")
    axes[1][2].set_xlabel("joint 1, turn-spread")
    figure.colorbar(image, ax=axes, label="tip error / reach", shrink=0.6)
    figure.savefig(PICTURE, dpi=80)
    for l1, l2 in (*links, (2.5, 2.5)):
        for joints in (2, 3):
            print(f"links {l1}, {l2}, {joints} joints:",
                  ", ".join(f"{100 * share_right(joints, l1, l2, one):.1f} %" for one in steps))


if __name__ == "__main__":
    main()
