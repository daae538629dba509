"""The plots of the report."""

from __future__ import annotations

from pathlib import Path

import matplotlib
import numpy

from ci.cache import digest
from ci.report import PLOTS, code, designs, verdict
from ci.report.labels import label
from ci.report.paper import PAPER, SOURCE
from ci.report.rows import FAMILIES, KINEMATIC, MAPPED, Row, area_of, greatest_error, name, number, pick, q7_8

matplotlib.use("Agg")

from matplotlib import pyplot  # noqa: E402
from matplotlib.colors import LogNorm  # noqa: E402

COLOUR = {"vector": "tab:red", "table": "tab:purple", "rational": "tab:green", "classic": "tab:blue",
          "paper": "tab:orange"}
BLOCKS = {(False, False): "o", (True, False): "^", (False, True): "s", (True, True): "D"}  # has DSP, has memory blocks
CODE = [Path(__file__), SOURCE, designs.SOURCE,
        *(Path(__file__).with_name(name) for name in ("labels.py", "paper.py", "rows.py", "verdict.py"))]
FLOOR = 1e-3  # LSB: smaller errors are drawn as this


def stamp(report: dict) -> str:
    """Digest of what the plots show and of how; written into the PNG so that a stale plot is found."""
    then = report["sources"]
    return digest([report["cores"], report["trajectory"], [then[key] for key in ("cores", "arm", "simulation")],
                   report.get("verdict"), code.digests(CODE)])


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
    """x (ns), y, text, colour, marker and fill of our cores and of the paper's."""
    points = []
    for row in rows:
        blocks = [(row["area"]["cyclonev"][key], what) for key, what in (("dsp", "DSP"), ("mem", "mem"))]
        text = ", ".join(f"{count} {what}" for count, what in blocks if count)
        points.append((row["latency_ns"], area_of(row), name(row) + (f" ({text})" if text else ""),
                       COLOUR[row["family"]], BLOCKS[tuple(count > 0 for count, _ in blocks)], "full"))
    for function in sorted({row["function"] for row in rows} & set(PAPER["cycles"])):
        points += [(PAPER["cycles"][function][which] * 1000 / PAPER["clock_mhz"],
                    PAPER["logic_elements"][function][which], f"printed {text}", COLOUR[family], "P", "none")
                   for which, text, family in (("rational", "rational", "paper"), ("cordic", "CORDIC*", "classic"))]
    return points


def _legend(figure: pyplot.Figure, marks: list[tuple[str, str, str, str]]) -> None:
    """Below the figure: (text, colour, marker, fill) of every kind of mark."""
    lines = [pyplot.Line2D([], [], color=colour, marker=shape, fillstyle=fill, linestyle="", label=text)
             for text, colour, shape, fill in marks]
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
        for x, y, _, colour, shape, fill in points:
            axis.plot([x], [y], marker=shape, color=colour, linestyle="", fillstyle=fill, markersize=8)
        axis.set(title=f"{function}: {KINEMATIC[function]}", xscale="log", yscale="log",
                 xlabel="latency, ns at the core's own ECP5 clock", ylabel="Cyclone V ALUT (proxy for LE)")
        axis.grid(True, which="both", alpha=0.25)
        axis.tick_params(axis="x", which="minor", labelsize=6, rotation=45)
        axis.margins(x=0.25, y=0.15)
        labels.append((axis, points))
    figure.suptitle("Area against latency; DSP and memory blocks beside the name, for they are not in the area")
    shown = {row["family"] for row in rows}
    _legend(figure, [*((family, colour, "o", "full") for family, colour in COLOUR.items() if family in shown),
                     *((text, "black", BLOCKS[which], "full") for which, text in (
                         ((False, False), "no blocks"), ((True, False), "DSP blocks"), ((False, True), "memory blocks"),
                         ((True, True), "both"))),
                     ("printed, at 50 MHz (*area of its parallel CORDIC, cycles of its iterative one)", "black", "P",
                      "none")])
    figure.tight_layout(rect=(0, 0.06, 1, 0.98))
    for axis, points in labels:
        label(axis, points)
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
    scale = LogNorm(0.01, 1000, clip=True)
    reach = (trajectory["l1_mm"] + trajectory["l2_mm"]) / trajectory["mm_per_unit"]
    image = pyplot.cm.ScalarMappable(scale, "viridis")
    for axes, (function, what) in zip(grid, panels):
        for axis, family in zip(axes, FAMILIES):
            if (function, family) in maps:
                shown = numpy.array(maps[function, family][what])
                axis.imshow(numpy.maximum(shown, 0.01), norm=scale, cmap="viridis", origin="lower",
                            interpolation="nearest", extent=[-reach, reach] * 2)
                here = number(float(numpy.nanmax(shown)))
                axis.set_title(f"{family}_{function}: {what}, LSB\nat most {here} here, "
                               f"{number(greatest.get((function, family, what)))} in the table", fontsize=9)
            else:
                axis.set_axis_off()
    figure.colorbar(image, ax=grid, shrink=0.5, label="error at the tip, LSB")
    figure.suptitle(f"Tip error over the workspace of {trajectory['name']}, units; elbow 0\n"
                    "arithmetic: the core's own; words: what rounding its words costs an exact core. One random point "
                    "a cell;\nthe table's samples seek the borders of words, the stretched and the folded arm")
    return figure



def dominated(one: verdict.Figures, others: list[verdict.Figures]) -> bool:
    """Whether another set is no worse in ALUTs, DSP blocks, memory blocks and time, and better in one of them."""
    def cost(found: verdict.Figures) -> list[float]:
        return [found[key] for key in ("alut", "dsp", "mem", "ns")]

    return any(cost(other) != cost(one) and all(a <= b for a, b in zip(cost(other), cost(one))) for other in others)


def _verdict(found: dict) -> pyplot.Figure:
    """Area against time at equal accuracy, a panel a function: the shortest words of every core for every target."""
    labels = []
    figure, grid = pyplot.subplots(2, 3, figsize=(19, 13))
    for axis, function in zip(grid.flat, KINEMATIC):
        axis.set(title=f"{function}: {KINEMATIC[function]}", xlabel="latency, ns at the core's own ECP5 clock",
                 ylabel="Cyclone V ALUT (proxy for LE)", xscale="log", yscale="log")
        axis.grid(True, which="both", alpha=0.25)
        points: dict[tuple, list] = {}
        for target in verdict.TARGETS:
            sets = [one for one in verdict.reaching(found, function, target) if one["ns"]]
            for one in sets:
                shape = BLOCKS[one["dsp"] > 0, one["mem"] > 0]
                fill = "none" if dominated(one, sets) else "full"
                at = one["ns"], one["alut"], one["core"], one["family"], shape
                points.setdefault(at, []).append((target, fill))
        for (x, y, _, family, shape), of in points.items():
            fill = "full" if any(kind == "full" for _, kind in of) else "none"
            axis.plot([x], [y], marker=shape, color=COLOUR[family], linestyle="", fillstyle=fill, markersize=8)
        if points:
            axis.margins(x=0.25, y=0.15)
            labels.append((axis, [(x, y, f"{core}: {', '.join(target for target, _ in of)}")
                                  for (x, y, core, *_), of in points.items()]))
    figure.suptitle("Area against latency at equal total error. Red: vector, purple: table, green: rational, blue: "
                    "CORDIC, orange: paper's circuits\nCircle: no blocks, triangle: DSP blocks, square: memory blocks, "
                    "diamond: both; hollow: at that target another core is no worse in ALUTs, both blocks and time")
    figure.tight_layout(rect=(0, 0, 1, 0.97))
    for axis, points in labels:
        label(axis, points)
    return figure
