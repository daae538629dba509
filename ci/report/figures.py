"""The plots of the report."""

from __future__ import annotations

import math
from pathlib import Path

import matplotlib
import numpy

from ci.cache import digest, digests
from ci.report import PLOTS, comparison, designs
from ci.report.tables import FAMILIES, KINEMATIC, MAPPED, Row, greatest_error, name, number, pick, q7_8

matplotlib.use("Agg")

from matplotlib import pyplot  # noqa: E402
from matplotlib.colors import LogNorm  # noqa: E402
from matplotlib.ticker import LogLocator, MaxNLocator, NullFormatter  # noqa: E402

COLOUR = {"vector": "tab:red", "table": "tab:purple", "rational": "tab:green", "classic": "tab:blue",
          "paper": "tab:orange"}
BLOCKS = {(False, False): "o", (True, False): "^", (False, True): "s", (True, True): "D"}  # has multipliers, has EBR
CODE = [Path(__file__), designs.SOURCE,
        *(Path(__file__).with_name(name) for name in ("tables.py", "comparison.py"))]
FLOOR = 1e-3  # LSB: smaller errors are drawn as this
SHADE = 0.01  # LSB: the same in the map


def stamp(report: dict) -> str:
    """Digest of what the plots show and of how; written into the PNG so that a stale plot is found."""
    then = report["sources"]
    return digest([report["cores"], report["trajectory"], [then[key] for key in ("cores", "arm", "simulation")],
                   report.get("verdict"), digests(CODE)])


def plots(report: dict) -> tuple[str, ...]:
    """Which of `PLOTS` a report has: the last one shows a verdict."""
    return PLOTS if report.get("verdict") else PLOTS[:-1]


def draw(report: dict, maps: dict[tuple[str, str], dict[str, list]], folder: Path) -> None:
    """Write the `plots` of the kinematic cores; one that the report does not have goes.

    Parameters
    ----------
    maps : (function, family) -> "arithmetic" or "words" -> grid of LSB over the workspace, NaN out of reach.
    """
    rows = q7_8(pick(report, KINEMATIC))
    drawn = [_area(rows), _accuracy([row for row in rows if row["error_lsb"]]), _map(report["trajectory"], maps, rows)]
    drawn += [_verdict(report["verdict"])] if report.get("verdict") else []
    for plot in PLOTS:
        (folder / plot).unlink(missing_ok=True)
    for figure, plot in zip(drawn, plots(report)):
        figure.savefig(folder / plot, dpi=90 if "map" in plot else 110,
                       metadata={"Software": None, "Description": stamp(report)})
        pyplot.close(figure)


def _points(rows: list[Row]) -> list[tuple]:
    """x (ns), y (LUT), text, colour and marker of every core, on ECP5."""
    points = []
    for row in rows:
        blocks = [(row["area"]["ecp5"][key], what) for key, what in (("dsp", "mult."), ("mem", "EBR"))]
        text = ", ".join(f"{count} {what}" for count, what in blocks if count)
        points.append((row["latency_ns"], row["area"]["ecp5"]["lut"], name(row) + (f" ({text})" if text else ""),
                       COLOUR[row["family"]], BLOCKS[tuple(count > 0 for count, _ in blocks)]))
    return points


def _legend(figure: pyplot.Figure, marks: list[tuple[str, str, str]]) -> None:
    """Below the figure: (text, colour, marker) of every kind of mark."""
    lines = [pyplot.Line2D([], [], color=colour, marker=shape, linestyle="", label=text)
             for text, colour, shape in marks]
    figure.legend(handles=lines, loc="lower center", ncol=5, frameon=False)


def _area(rows: list[Row]) -> pyplot.Figure:
    """Area against latency in ns, a panel a function; the shape says which blocks a core has."""
    labels = []
    functions = [one for one in KINEMATIC if any(row["function"] == one for row in rows)]
    figure, grid = pyplot.subplots(max(-(-len(functions) // 3), 1), 3, squeeze=False,
                                   figsize=(19, 6.2 * max(-(-len(functions) // 3), 1)))
    for axis in grid.flat[len(functions):]:
        axis.set_axis_off()
    for axis, function in zip(grid.flat, functions):
        points = _points([row for row in rows if row["function"] == function])
        for x, y, _, colour, shape in points:
            axis.plot([x], [y], marker=shape, color=colour, linestyle="", markersize=8)
        axis.set(title=f"{function}: {KINEMATIC[function]}", xscale="log", yscale="log",
                 xlabel="latency, ns at the core's own ECP5 clock", ylabel="ECP5 LUT")
        axis.grid(True, which="both", alpha=0.25)
        axis.margins(x=0.25, y=0.15)
        labels.append((axis, points))
    figure.suptitle("Area against latency on ECP5; the blocks beside the name are not in the LUTs")
    shown = {row["family"] for row in rows}
    _legend(figure, [*((family, colour, "o") for family, colour in COLOUR.items() if family in shown),
                     *((text, "black", BLOCKS[which]) for which, text in (
                         ((False, False), "no blocks"), ((True, False), "mult. (MULT18X18)"), ((False, True), "EBR"),
                         ((True, True), "both")))])
    _named(figure, labels, (0, 0.06, 1, 0.98))
    return figure


def _accuracy(rows: list[Row]) -> pyplot.Figure:
    """A bar a core for its greatest arithmetic error, and one for its words over the workspace; 0 is no bar but 0."""
    figure, axis = pyplot.subplots(figsize=(14, 1.8 + 0.36 * max(len(rows), 1)))
    for i, row in enumerate(rows):
        for off, error, colour in ((0.2, greatest_error(row), COLOUR[row["family"]]),
                                   (-0.2, row["words_lsb"] or 0, "lightgrey")):
            if error > 0:
                axis.barh(i - off, max(error, FLOOR), 0.38, color=colour)
            else:
                axis.text(FLOOR, i - off, " 0", va="center", fontsize=7, color=colour if off > 0 else "grey")
    axis.set_yticks(range(len(rows)), [name(row) for row in rows], fontsize=8)
    axis.set(xscale="log", xlabel="greatest error at the tip, LSB", title="Accuracy at the tip", xlim=(FLOOR, None),
             ylim=(max(len(rows), 1) - 0.5, -0.5))
    axis.axvline(1, color="black", linewidth=0.8)
    axis.grid(True, axis="x", alpha=0.25)
    shown = {row["family"] for row in rows}
    bars = [pyplot.Rectangle((0, 0), 1, 1, color=colour) for family, colour in COLOUR.items() if family in shown]
    axis.legend([*bars, pyplot.Rectangle((0, 0), 1, 1, color="lightgrey")],
                [*(f"{family}: arithmetic" for family in COLOUR if family in shown),
                 "rounding of the words, over the workspace"], fontsize=8, loc="upper left", bbox_to_anchor=(1.01, 1))
    figure.tight_layout()
    return figure


def _map(trajectory: dict, maps: dict[tuple[str, str], dict[str, list]], rows: list[Row]) -> pyplot.Figure:
    """Error over the workspace of two joints, a panel for each function, kind of error and family.

    A panel says the greatest error of its points, and that of the table's samples.
    """
    greatest = {(row["function"], row["family"], what): value for row in reversed(rows) for what, value in (
        ("arithmetic", greatest_error(row)), ("words", row["words_lsb"]))}
    panels = [(function, what) for function in MAPPED for what in ("arithmetic", "words")]
    figure, grid = pyplot.subplots(len(panels), len(FAMILIES), figsize=(4 * len(FAMILIES), 15), layout="constrained")
    reach = (trajectory["l1_mm"] + trajectory["l2_mm"]) / trajectory["mm_per_unit"]
    scales = {}
    for group in (FAMILIES[:-1], FAMILIES[-1:]):  # the paper's circuits err by hundreds of LSB
        found = [numpy.nanmax(maps[key][what]) for key in maps for what in maps[key] if key[1] in group]
        if found:
            scale = LogNorm(SHADE, 10.0 ** max(math.ceil(math.log10(max(*found, SHADE))), 0))
            scales |= dict.fromkeys(group, scale)
            figure.colorbar(pyplot.cm.ScalarMappable(scale, "viridis"), shrink=0.5, extend="min",
                            ax=grid[:, [FAMILIES.index(family) for family in group]]).ax.set_title("LSB")
    for axes, (function, what) in zip(grid, panels):
        for axis, family in zip(axes, FAMILIES):
            if (function, family) in maps:
                shown = numpy.array(maps[function, family][what])
                axis.imshow(numpy.maximum(shown, SHADE), norm=scales[family], cmap="viridis", origin="lower",
                            interpolation="nearest", extent=[-reach, reach] * 2)
                here = number(float(numpy.nanmax(shown)))
                axis.set_title(f"{family}_{function}: {what}, LSB\nat most {here} here, "
                               f"{number(greatest.get((function, family, what)))} in the table", fontsize=9)
            else:
                axis.set_axis_off()
    figure.suptitle(f"Tip error over the workspace of {trajectory['name']}, units; elbow 0\n"
                    "arithmetic: the core's own; words: what rounding its words costs an exact core. One random point "
                    "a cell;\nthe table's samples seek the borders of words, the stretched and the folded arm")
    return figure


def dominated(one: comparison.Figures, others: list[comparison.Figures]) -> bool:
    """Whether another set is no worse in LUTs, multipliers, memory blocks and time, and better in one of them."""
    def cost(found: comparison.Figures) -> list[float]:
        return [found[key] for key in ("lut", "dsp", "mem", "ns")]

    return any(cost(other) != cost(one) and all(a <= b for a, b in zip(cost(other), cost(one))) for other in others)


def _verdict(found: dict) -> pyplot.Figure:
    """Area against time at equal accuracy, a panel a function: the shortest words of every core for every target."""
    labels = []
    figure, grid = pyplot.subplots(2, 3, figsize=(19, 13))
    for axis, function in zip(grid.flat, KINEMATIC):
        axis.set(title=f"{function}: {KINEMATIC[function]}", xlabel="latency, ns at the core's own ECP5 clock",
                 ylabel="ECP5 LUT", xscale="log", yscale="log")
        axis.grid(True, which="both", alpha=0.25)
        points: dict[tuple, list] = {}
        for target in comparison.TARGETS:
            sets = [one for one in comparison.reaching(found, function, target) if one["ns"]]
            for one in sets:
                shape = BLOCKS[one["dsp"] > 0, one["mem"] > 0]
                fill = "none" if dominated(one, sets) else "full"
                at = one["ns"], one["lut"], one["core"], one["family"], shape
                points.setdefault(at, []).append((target, fill))
        for (x, y, _, family, shape), of in points.items():
            fill = "full" if any(kind == "full" for _, kind in of) else "none"
            axis.plot([x], [y], marker=shape, color=COLOUR[family], linestyle="", fillstyle=fill, markersize=8)
        if points:
            axis.margins(x=0.25, y=0.15)
            labels.append((axis, [(x, y, f"{core}: {', '.join(target for target, _ in of)}")
                                  for (x, y, core, *_), of in points.items()]))
    figure.suptitle("Area against latency at equal total error, on ECP5. Red: vector, purple: table, green: rational, "
                    "blue: CORDIC, orange: paper's circuits\nCircle: no blocks, triangle: MULT18X18, square: EBR, "
                    "diamond: both; hollow: at that target another core is no worse in LUTs, both blocks and time")
    _named(figure, labels, (0, 0, 1, 0.97))
    return figure


# Names beside the marks

PLACES = numpy.array(sorted(((dx, dy) for dx in range(-238, 239, 14) for dy in range(-184, 185, 8)
                             if dx or abs(dy) > 8), key=lambda at: (math.hypot(*at), -at[0])))  # points, nearest first
LEADER = numpy.linspace(0, 1, 12)  # where the line from a mark to its name is looked at


def _named(figure: pyplot.Figure, labels: list[tuple], within: tuple[float, float, float, float]) -> None:
    """Ticks and names of every panel, (axis, points) each, and the layout."""
    for axis, _ in labels:
        for one in (axis.xaxis, axis.yaxis):
            low, high = one.get_view_interval()
            one.set_major_locator(LogLocator(subs=(1, 2, 5)) if high > 5 * low else MaxNLocator(5, steps=[1, 2, 5, 10]))
            one.set_major_formatter("{x:g}")
            one.set_minor_formatter(NullFormatter())
    figure.tight_layout(rect=within)
    for axis, points in labels:
        label(axis, points)


def label(axis: pyplot.Axes, points: list[tuple]) -> list:
    """Name every point beside its mark: at the nearest place that hides no mark, no other name and no line to one.

    Parameters
    ----------
    axis : with its limits set.
    points : x, y, text and whatever else of each mark.

    Returns
    -------
    Matplotlib's annotations, in the order of the points.
    """
    scale, edge, notes = axis.figure.dpi / 72, axis.bbox, []
    marks = axis.transData.transform([point[:2] for point in points])
    taken = numpy.concatenate([marks - 6 * scale, marks + 6 * scale], axis=1)  # left, low, right, high in pixels
    step = PLACES * scale
    clear = 7 / numpy.hypot(*PLACES.T)[:, None]  # of the mark and of the name
    lines = step[:, None] * (clear + (1 - 2 * clear) * LEADER)[..., None]
    for i, ((x, y, text, *_), mark) in enumerate(zip(points, marks)):
        note = axis.annotate(text, (x, y), xytext=(0, 0), textcoords="offset points", fontsize=7, va="center")
        size = note.get_window_extent().size + 6 * scale
        low = mark + step - size * numpy.stack([(1 - numpy.sign(step[:, 0])) / 2, numpy.full(len(step), 0.5)], axis=1)
        boxes = numpy.concatenate([low, low + size], axis=1)[:, None]
        clashes = ((boxes[..., :2] < taken[:, 2:]) & (taken[:, :2] < boxes[..., 2:])).all(axis=-1).sum(axis=1)
        outside = (low < edge.min).any(axis=1) | (low + size > edge.max).any(axis=1)
        others = numpy.delete(taken, i, axis=0)
        line = (mark + lines)[:, :, None]
        crossed = ((others[:, :2] < line) & (line < others[:, 2:])).all(axis=-1).any(axis=1).sum(axis=1)
        best = int(numpy.argmin(100 * (clashes + outside) + crossed))
        dx, dy = PLACES[best]
        note.set(position=(dx, dy), ha="left" if dx > 0 else "right" if dx < 0 else "center")
        taken = numpy.concatenate([taken, boxes[best]])
        if math.hypot(dx, dy) > 16:
            axis.plot(*axis.transData.inverted().transform([mark, line[best, -1, 0]]).T, color="grey", linewidth=0.4,
                      zorder=0, scalex=False, scaley=False)
            taken = numpy.concatenate([taken, numpy.concatenate([line[best, :, 0] - 1, line[best, :, 0] + 1], axis=1)])
        notes.append(note)
    return notes
