"""Names beside the marks of a plot."""

from __future__ import annotations

import math

Box = tuple[float, float, float, float]  # left, low, right, high in pixels

PLACES = sorted(((dx, dy) for dx in range(-90, 91, 15) for dy in range(-96, 97, 8)),
                key=lambda at: (math.hypot(*at), -at[0]))  # points from the mark, the nearest first


def label(axis, points: list[tuple]) -> None:
    """Name every point beside its mark: at the nearest place that hides no mark and no other name.

    Parameters
    ----------
    axis : matplotlib's, with its limits set.
    points : x, y, text and whatever else of each mark.
    """
    taken = [(x - 6, y - 6, x + 6, y + 6) for x, y in axis.transData.transform([point[:2] for point in points])]
    scale = 72 / axis.figure.dpi
    for x, y, text, *_ in points:
        px, py = axis.transData.transform((x, y))
        width, height = 3.9 * len(text) / scale, 9 / scale

        def box(dx: float, dy: float, px=px, py=py, width=width, height=height) -> Box:
            left = px + dx / scale if dx > 0 else px + dx / scale - width if dx < 0 else px - width / 2
            return left, py + dy / scale - height / 2, left + width, py + dy / scale + height / 2

        def clash(at: tuple[float, float], box=box) -> float:
            left, low, right, high = box(*at)
            inside = axis.bbox.x0 < left and right < axis.bbox.x1 and axis.bbox.y0 < low and high < axis.bbox.y1
            return (not inside) + sum(left < b[2] and b[0] < right and low < b[3] and b[1] < high for b in taken)

        dx, dy = min(PLACES, key=clash)
        taken.append(box(dx, dy))
        axis.annotate(text, (x, y), xytext=(dx, dy), textcoords="offset points", fontsize=7, va="center",
                      ha="left" if dx > 0 else "right" if dx < 0 else "center",
                      arrowprops={"arrowstyle": "-", "lw": 0.4, "color": "grey"} if math.hypot(dx, dy) > 16 else None)
