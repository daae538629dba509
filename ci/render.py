"""From report.json to what people read: tables, Markdown, README blocks, plots. Pure but for the plots."""

from __future__ import annotations

import hashlib
import json
import math
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

Row = dict  # one element of report["cores"]

KINEMATIC = ("fk1", "fk2", "fk3", "ik1", "ik2", "ik3")
FAMILIES = ("paper", "rational", "classic")
PAPER_LE = {"fk1": (359, 1573), "fk2": (582, 1657), "fk3": (918, 1796),  # Tables III and IV: rational, CORDIC
            "ik1": (317, 1569), "ik2": (671, 1673), "ik3": (1023, 1787)}
PAPER_CYCLES = {"fk1": (2, 22), "fk2": (10, 25), "fk3": (15, 52)}  # Table V, at 50 MHz
PAPER_MHZ = 50
PLOTS = ("area_latency.png", "accuracy.png", "tip_error_map.png")
MAPPED = ("fk2", "ik2")  # functions with a map of the workspace


@dataclass(frozen=True)
class Table:
    """A titled grid of strings; the first `text` columns are text, the others numbers."""

    title: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    text: int = 1

    def markdown(self) -> str:
        """As a Markdown table, without its title."""
        rule = [":--" if i < self.text else "--:" for i in range(len(self.head))]
        lines = [self.head, tuple(rule), *self.rows]
        return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def number(value: float | None, digits: int = 3) -> str:
    """`digits` significant digits without an exponent; a dash for None."""
    if value is None:
        return "–"
    if value == 0:
        return "0"
    if abs(value) < 10.0**-digits:
        return f"< {10.0**-digits:.{digits}f}"
    text = f"{value:.{digits}g}"
    return text if "e" not in text else f"{value:.0f}"


def name(row: Row) -> str:
    """Core and parameter set."""
    return f"{row['core']}-{row['set']}"


def pick(report: dict, functions: Iterable[str], families: Iterable[str] = FAMILIES) -> list[Row]:
    """Rows of those functions and families: function first, then family, then the order of cores.toml."""
    functions, families = list(functions), list(families)
    rows = [row for row in report["cores"] if row["function"] in functions and row["family"] in families]
    return sorted(rows, key=lambda row: (functions.index(row["function"]), families.index(row["family"])))


def q7_8(rows: Iterable[Row]) -> list[Row]:
    """Rows with the paper's coordinates, Q7.8: others do less work and are not compared."""
    return [row for row in rows if (row["params"].get("W"), row["params"].get("F")) == (16, 8)]


def leading(rows: Iterable[Row]) -> list[Row]:
    """The first parameter set of each core, which is the one that is compared."""
    return list({row["core"]: row for row in reversed(list(rows))}.values())[::-1]


def _part(row: Row, key: str, part: str) -> float | None:
    return row[key][part] if row[key] else None


def _cycles(row: Row) -> str:
    return "comb." if row["latency_cycles"] == 0 else str(row["latency_cycles"])


# Tables


def cost_table(title: str, rows: list[Row]) -> Table:
    """Latency, II, area in every flow and clock."""
    def line(row: Row) -> tuple[str, ...]:
        area = row["area"]
        alm = area["cyclonev"]
        return (f"`{name(row)}`", row["architecture"], _cycles(row), "–" if row["ii"] in (0, None) else str(row["ii"]),
                number(row["fmax_mhz"]["ecp5"], 4), number(row["latency_ns"]), str(alm["lut"]), str(alm["ff"]),
                str(alm["dsp"]), str(alm["mem"]), str(area["cyclonev_nodsp"]["lut"]), str(area["ice40"]["lut"]),
                str(area["ecp5"]["lut"]))

    return Table(title, ("core", "architecture", "cycles", "II", "MHz", "ns", "ALUT", "FF", "DSP", "mem",
                         "ALUT, no DSP", "iCE40 LC", "ECP5 LUT"), tuple(map(line, rows)), text=2)


def accuracy_table(title: str, rows: list[Row]) -> Table:
    """Arithmetic error on the trajectory and in the sweep, and the words' own error apart."""
    def line(row: Row) -> tuple[str, ...]:
        return (f"`{name(row)}`", *(number(_part(row, key, part)) for key, part in (
            ("error_lsb", "max"), ("error_lsb", "rms"), ("error_mm", "max"), ("error_mm", "rms"),
            ("sweep_error_lsb", "max"), ("sweep_error_lsb", "rms"),
            ("input_error_lsb", "max"), ("input_error_lsb", "rms"))))

    return Table(title, ("core", "max LSB", "rms LSB", "max mm", "rms mm", "sweep max", "sweep rms",
                         "words max LSB", "words rms LSB"), tuple(map(line, rows)))


def primitive_table(rows: list[Row]) -> Table:
    """Error of the primitives that have a real-valued truth."""
    lines = tuple((f"`{name(row)}`", number(row["sweep_error_lsb"]["max"]), number(row["sweep_error_lsb"]["rms"]))
                  for row in rows if row["sweep_error_lsb"])
    return Table("Error against the real-valued function in LSB of the output, over random and border inputs",
                 ("primitive", "max LSB", "rms LSB"), lines)


def headline_table(report: dict, functions: Iterable[str] = KINEMATIC) -> Table:
    """The numbers of the README: every kinematic core at its first parameter set."""
    def line(row: Row) -> tuple[str, ...]:
        area = row["area"]["cyclonev"]
        return (f"`{name(row)}`", _cycles(row), number(row["latency_ns"]), number(row["fmax_mhz"]["ecp5"], 4),
                str(area["lut"]), str(area["dsp"]), str(area["mem"]), str(row["area"]["cyclonev_nodsp"]["lut"]),
                number(_part(row, "error_lsb", "max")), number(_part(row, "error_mm", "max")),
                number(_part(row, "input_error_lsb", "max")))

    rows = leading(q7_8(pick(report, functions)))
    return Table("Kinematics", ("core", "cycles", "ns", "MHz", "ALUT", "DSP", "mem", "ALUT, no DSP", "error LSB",
                               "error mm", "words LSB"), tuple(map(line, rows)))


def kind(row: Row) -> str:
    """Column of the paper's comparison that a row belongs to; empty for none (a pipeline)."""
    if row["family"] != "classic":
        return row["family"]
    return {"comb": "parallel", "parallel": "parallel", "iter": "iterative"}.get(row["architecture"].split("_")[0], "")


def best(rows: list[Row], measure: Callable[[Row], float | None]) -> Row | None:
    """The row with the smallest measure; the first of equals."""
    known = [row for row in rows if measure(row) is not None]
    return min(known, key=measure) if known else None


def area_of(row: Row) -> float:
    return row["area"]["cyclonev"]["lut"]


def paper_table(report: dict, functions: tuple[str, ...], title: str, measured: str) -> Table:
    """One of Tables III, IV (`measured` = "LE") or V ("cycles"): the paper's columns and ours, one flow.

    Where a family has several cores the smallest figure stands in the cell.
    """
    def cell(rows: list[Row]) -> str:
        if measured == "LE":
            row = best(rows, area_of)
            if row is None:
                return "–"
            dsp = row["area"]["cyclonev"]["dsp"]
            memory = row["area"]["cyclonev"]["mem"]
            extra = "".join(f" + {count} {what}" for count, what in ((dsp, "DSP"), (memory, "mem")) if count)
            return f"{area_of(row):.0f}{extra} ({row['area']['cyclonev_nodsp']['lut']})"
        row = best(rows, lambda one: one["latency_cycles"])
        if row is None:
            return "–"
        slow = f", {number(row['fmax_mhz']['ecp5'])} MHz" if row["fmax_mhz"]["ecp5"] < PAPER_MHZ else ""
        return f"{row['latency_cycles']} ({number(row['latency_ns'])} ns{slow})"

    lines = []
    for function in functions:
        rows = leading(pick(report, [function]))
        if not rows:
            continue
        figures = PAPER_LE if measured == "LE" else PAPER_CYCLES
        rational, cordic = map(str, figures[function])
        of = {column: cell([row for row in rows if kind(row) == column])
              for column in ("paper", "rational", "parallel", "iterative")}
        theirs = (cordic, "–") if measured == "LE" else ("–", cordic)
        lines.append((function.upper(), rational, of["paper"], of["rational"], theirs[0], of["parallel"],
                      theirs[1], of["iterative"]))
    return Table(title, ("", "rational, printed", "`paper_*`", "`rational_*`", "parallel CORDIC, printed",
                         "`classic_*` parallel", "iterative CORDIC, printed", "`classic_*` iterative"), tuple(lines))


def paper_tables(report: dict) -> list[Table]:
    """Tables III, IV and V with the rows that exist."""
    tables = [
        paper_table(report, ("fk1", "fk2", "fk3"), "Table III: logic elements, forward kinematics", "LE"),
        paper_table(report, ("ik1", "ik2", "ik3"), "Table IV: logic elements, inverse kinematics", "LE"),
        paper_table(report, ("fk1", "fk2", "fk3"), "Table V: clock cycles at 50 MHz, forward kinematics", "cycles")]
    return [table for table in tables if table.rows]


# Sentences

METRICS: tuple[tuple[str, str, Callable[[Row], float | None]], ...] = (
    ("ALUT with DSP blocks", "", area_of),
    ("ALUT without DSP blocks", "", lambda row: row["area"]["cyclonev_nodsp"]["lut"]),
    ("iCE40 logic cells", "", lambda row: row["area"]["ice40"]["lut"]),
    ("ECP5 LUTs", "", lambda row: row["area"]["ecp5"]["lut"]),
    ("DSP blocks", "", lambda row: row["area"]["cyclonev"]["dsp"]),
    ("memory blocks", "", lambda row: row["area"]["cyclonev"]["mem"]),
    ("latency in cycles", "", lambda row: row["latency_cycles"]),
    ("latency in ns", " ns", lambda row: row["latency_ns"]),
    ("clock", " MHz", lambda row: -row["fmax_mhz"]["ecp5"]),
    ("throughput", " ns a sample", lambda row: row["ii"] * 1000 / row["fmax_mhz"]["ecp5"] if row["ii"] else None),
    ("greatest arithmetic error", " LSB", lambda row: _part(row, "error_lsb", "max")),
    ("greatest error of the words", " LSB", lambda row: _part(row, "input_error_lsb", "max")),
)


def cordic_wins(report: dict) -> list[str]:
    """One sentence for each function and figure in which the best classic core beats the best rational one."""
    sentences = []
    for function in KINEMATIC:
        classic, rational = (leading(pick(report, [function], [family])) for family in ("classic", "rational"))
        for label, unit, measure in METRICS:
            one, other = best(classic, measure), best(rational, measure)
            if one and other and measure(one) < measure(other):
                sentences.append(f"{function.upper()}, {label}: `{name(one)}` {number(abs(measure(one)), 4)}{unit} "
                                 f"against {number(abs(measure(other)), 4)}{unit} of `{name(other)}`.")
    return sentences


def pareto(report: dict) -> list[str]:
    """For each function: does a rational core take less area and fewer cycles than every iterative CORDIC core,
    at no larger arithmetic error? If not, by how much it misses."""
    sentences = []
    for function in KINEMATIC:
        rational = leading(pick(report, [function], ["rational"]))
        for rival in (row for row in leading(pick(report, [function], ["classic"])) if kind(row) == "iterative"):
            if not rational:
                continue

            def excess(row: Row, rival: Row = rival) -> tuple[float, float, float]:
                """How much worse than the rival: ALUTs, cycles, greatest error in LSB (0 or less: not worse)."""
                ours, theirs = (_part(one, "error_lsb", "max") or 0.0 for one in (row, rival))
                return (area_of(row) - area_of(rival) + 1, row["latency_cycles"] - rival["latency_cycles"] + 1,
                        ours - theirs)

            winners = [row for row in rational if max(excess(row)) <= 0]
            if winners:
                sentences.append(f"{function.upper()}: `{name(winners[0])}` takes fewer ALUTs and fewer cycles than "
                                 f"`{name(rival)}` at no larger arithmetic error.")
            else:
                closest = min(rational, key=lambda row: (sum(one > 0 for one in excess(row)), max(excess(row)[0], 0)))
                area, cycles, error = excess(closest)
                misses = [text for value, text in (
                    (area, f"{area - 1:.0f} ALUTs more"), (cycles, f"{cycles - 1:.0f} cycles more"),
                    (error, f"a {number(error)} LSB larger error")) if value > 0]
                misses = [text.replace("0 ALUTs more", "as many ALUTs") if text.startswith("0 ") and "ALUT" in text else
                          text.replace("0 cycles more", "as many cycles") if text.startswith("0 ") and "cycles" in text
                          else text for text in misses]
                sentences.append(f"{function.upper()}: no rational core beats `{name(rival)}` in area and cycles at no "
                                 f"larger error; the closest, `{name(closest)}`, has {' and '.join(misses)}.")
    return sentences


# Documents

HOW_TO_READ = """\
**ALUT** is a proxy for logic elements: every `MISTRAL_ALUT*` cell of Yosys' Cyclone V flow (registers pack beside
them), DSP blocks and memory blocks in their own columns; *no DSP* repeats it with multipliers in logic, mapped by a
short ABC script, at most 8 % above the default one on the one-joint cores (which takes minutes on larger ones) and
18 % on the smallest primitive. **iCE40 LC** (`synth_ice40` with plain `abc -lut 4`, within 20 % of its default, either
way) and **ECP5 LUT** are the same source in two other flows. **MHz** is nextpnr's clock for ECP5-25k, speed grade 6,
all ports registered: the median of three seeds, or the mean of the first two where these agree within 3 % (that median
lies between them). **ns** is the latency at that clock (for combinational primitives: one period). **cycles** and
**II** are measured in simulation of the Verilog. Errors are distances at the tip, one LSB is 2^-F units: **error** is
arithmetic alone, against float64 on the same input words; **words** is what an exact core of the same word lengths
would lose by rounding the joints, targets and links (for inverse cores also the answered joint words). **sweep** is the
greatest error over random and border inputs instead of the trajectory."""


def trajectory_note(report: dict) -> str:
    """What was run, in one paragraph."""
    arm = report["trajectory"]
    yaw = "" if arm["yaw"] else " The arm has no yaw: three-joint cores see its two links stood on a turntable."
    links = f"{number(arm['l1_mm'], 5)} and {number(arm['l2_mm'], 5)} mm"
    return (f"Arm `{report['arm']}`, {arm['name']}: links of {links}, "
            f"{number(arm['mm_per_unit'], 5)} mm a unit (1 LSB of Q7.8 is {number(arm['mm_per_unit'] / 256)} mm). "
            f"{arm['samples']} samples of a circle, a line and a pick-and-place within the joint limits. "
            f"One-joint cores move the first link alone.{yaw}")


def markdown(report: dict) -> str:
    """The whole of report.md."""
    kinematic = pick(report, KINEMATIC)
    others = [row for row in report["cores"] if row["function"] not in KINEMATIC]
    parts = ["<!-- Generated by `make report` from report.json: do not edit. -->", "# What the cores cost",
             trajectory_note(report), HOW_TO_READ]
    if kinematic:
        parts += [f"## {(table := cost_table('Kinematic cores', kinematic)).title}", table.markdown(),
                  "![Area against latency](area_latency.png)",
                  f"## {(table := accuracy_table('Accuracy at the tip', kinematic)).title}", table.markdown(),
                  "![Accuracy](accuracy.png)",
                  "Over the workspace of two joints (elbow 0), the same scale everywhere:",
                  "![Tip error over the workspace](tip_error_map.png)"]
    if others:
        parts += [f"## {(table := cost_table('Primitives', others)).title}", table.markdown()]
        table = primitive_table(others)
        if table.rows:
            parts += [f"{table.title}:", table.markdown()]
    parts += ["## Beside the paper", PAPER_NOTE]
    for table in paper_tables(report):
        parts += [f"### {table.title}", table.markdown()]
    parts += ["## Rational against iterative CORDIC", _list(pareto(report), "No function has both yet.")]
    parts += ["## Where CORDIC wins", "Best classic core against best rational core, figure by figure:",
              _list(cordic_wins(report), "In none of the figures.")]
    versions = ", ".join(f"{tool} {version}" for tool, version in report["tools"].items())
    parts += ["## Tools", versions]
    return "\n\n".join(parts) + "\n"


PAPER_NOTE = """\
The paper counts Cyclone V logic elements (Quartus 16.0) and cycles at 50 MHz; ours are the ALUT proxy with DSP blocks
beside it (in brackets: without DSP blocks) and measured cycles with the time at the core's own ECP5 clock. It compares
area with the parallel CORDIC alone and latency with the iterative one alone; here both stand against both. Every
core stands with its first parameter set (Q7.8; `paper_*` at the paper's 8 spread bits, `rational_*` at 24 spread bits,
`classic_*` at 16 angle bits). Each cell is the family's smallest figure, so the area and the cycles of one column may
come from two cores."""


def _list(sentences: list[str], none: str) -> str:
    return "\n".join(f"- {sentence}" for sentence in sentences) if sentences else none


def blocks(report: dict) -> dict[str, str]:
    """The generated blocks of the README by name."""
    paper = "\n\n".join(f"**{table.title}**\n\n{table.markdown()}" for table in paper_tables(report))
    return {"headline": headline_table(report).markdown(), "paper": paper or "No core of the paper's functions yet.",
            "pareto": _list(pareto(report), "No function has both families yet.")}


def readme(text: str, report: dict) -> str:
    """`text` with every block between ``<!-- report:NAME -->`` and ``<!-- /report:NAME -->`` replaced.

    Raises
    ------
    ValueError
        A marker of an unknown block, one that is not closed, or a README without the headline block.
    """
    made = blocks(report)
    opened = re.findall(r"<!-- report:(\S+) -->", text)
    closed = re.findall(r"<!-- /report:(\S+) -->", text)
    if unknown := [one for one in opened + closed if one not in made]:
        raise ValueError(f"README.md: no report block is called '{unknown[0]}'; there are {', '.join(made)}")
    if opened != closed:
        raise ValueError(f"README.md: report blocks open as {opened} and close as {closed}")
    if "headline" not in opened:
        raise ValueError("README.md: has no <!-- report:headline --> ... <!-- /report:headline --> block")
    for block, content in made.items():
        text = re.sub(rf"(<!-- report:{block} -->\n).*?(<!-- /report:{block} -->)",
                      lambda match, content=content: f"{match[1]}{content}\n{match[2]}", text, flags=re.DOTALL)
    return text


# Plots


def stamp(report: dict) -> str:
    """Digest of the figures a plot shows; written into the PNG so that a stale plot is found."""
    return hashlib.sha256(json.dumps(report["cores"], sort_keys=True).encode()).hexdigest()[:24]


def plots(report: dict, maps: dict[tuple[str, str], dict[str, list]], folder: Path) -> None:
    """Write the plots (`PLOTS`) of the kinematic cores; `maps` are (function, family) -> what -> grid of LSB."""
    import matplotlib

    matplotlib.use("Agg")
    import numpy
    from matplotlib import pyplot
    from matplotlib.colors import LogNorm

    rows = q7_8(pick(report, KINEMATIC))
    colour = {"paper": "tab:orange", "rational": "tab:green", "classic": "tab:blue"}
    marker = dict(zip(KINEMATIC, "os^DvP"))
    metadata = {"Software": None, "Description": stamp(report)}

    labels = []
    figure, grid = pyplot.subplots(2, 2, figsize=(15, 14), sharey="row")
    for axes, way in zip(grid, ("fk", "ik")):
        shown = [row for row in rows if row["function"].startswith(way)]
        for axis, unit, measure, clock in ((axes[0], "cycles", lambda row: row["latency_cycles"], 1),
                                           (axes[1], "ns at the core's own ECP5 clock", lambda row: row["latency_ns"],
                                            1000 / PAPER_MHZ)):
            points = [(measure(row), area_of(row), name(row), colour[row["family"]], marker[row["function"]], "full")
                      for row in shown]
            for function in sorted({row["function"] for row in shown} & set(PAPER_CYCLES)):
                points += [(PAPER_CYCLES[function][i] * clock, PAPER_LE[function][i], f"{what} {function.upper()}",
                            tint, marker[function], "none")
                           for i, (what, tint) in enumerate((("printed rational", "tab:orange"),
                                                             ("printed CORDIC*", "tab:blue")))]
            for x, y, _, tint, shape, fill in points:
                axis.plot([x], [y], marker=shape, color=tint, linestyle="", fillstyle=fill, markersize=8)
            axis.set(xscale="log", yscale="log", xlabel=f"latency, {unit}")
            axis.grid(True, which="both", alpha=0.25)
            axis.margins(x=0.2, y=0.12)
            labels.append((axis, points))
        axes[0].set_ylabel("Cyclone V ALUT (proxy for LE), DSP blocks not counted")
    figure.suptitle("Area against latency. Orange: paper's circuits, green: rational, blue: CORDIC; hollow: printed "
                    "at 50 MHz\n(*the area is that of its parallel CORDIC, the cycles are those of its iterative one)")
    figure.tight_layout(rect=(0, 0, 1, 0.98))
    for axis, points in labels:
        _label(axis, points)
    figure.savefig(folder / PLOTS[0], dpi=110, metadata=metadata)
    pyplot.close(figure)

    rows = [row for row in rows if row["error_lsb"]]
    figure, axis = pyplot.subplots(figsize=(11, 1.5 + 0.36 * max(len(rows), 1)))
    floor = 1e-3
    for i, row in enumerate(rows):
        axis.barh(i + 0.2, max(row["error_lsb"]["max"], floor), 0.38, color=colour[row["family"]])
        axis.barh(i - 0.2, max(_part(row, "input_error_lsb", "max") or 0, floor), 0.38, color="lightgrey")
    axis.set_yticks(range(len(rows)), [name(row) for row in rows], fontsize=8)
    axis.set(xscale="log", xlabel="greatest error at the tip on the trajectory, LSB "
             "(coloured: arithmetic; grey: rounding of the words)")
    axis.axvline(1, color="black", linewidth=0.8)
    axis.invert_yaxis()
    axis.grid(True, axis="x", alpha=0.25)
    figure.tight_layout()
    figure.savefig(folder / PLOTS[1], dpi=110, metadata=metadata)
    pyplot.close(figure)

    panels = [(function, what) for function in MAPPED for what in ("arithmetic", "words")]
    figure, grid = pyplot.subplots(len(panels), len(FAMILIES), figsize=(12, 15), layout="constrained")
    scale = LogNorm(0.01, 1000, clip=True)
    reach = (report["trajectory"]["l1_mm"] + report["trajectory"]["l2_mm"]) / report["trajectory"]["mm_per_unit"]
    image = pyplot.cm.ScalarMappable(scale, "viridis")
    for axes, (function, what) in zip(grid, panels):
        for axis, family in zip(axes, FAMILIES):
            if (function, family) in maps:
                shown = numpy.array(maps[function, family][what])
                axis.imshow(numpy.maximum(shown, 0.01), norm=scale, cmap="viridis", origin="lower",
                            interpolation="nearest", extent=[-reach, reach] * 2)
                axis.set_title(f"{family}_{function}: {what}, max {number(float(numpy.nanmax(shown)))} LSB", fontsize=9)
            else:
                axis.set_axis_off()
    figure.colorbar(image, ax=grid, shrink=0.5, label="error at the tip, LSB")
    figure.suptitle(f"Tip error over the workspace of {report['trajectory']['name']}, units; elbow 0\n"
                    "arithmetic: the core's own; words: what rounding its words costs an exact core")
    figure.savefig(folder / PLOTS[2], dpi=90, metadata=metadata)
    pyplot.close(figure)


def _label(axis, points: list[tuple]) -> None:
    """Name every point beside its mark: at the nearest place that hides no mark and no other name."""
    taken = [(x - 6, y - 6, x + 6, y + 6) for x, y in axis.transData.transform([point[:2] for point in points])]
    scale = 72 / axis.figure.dpi
    offsets = sorted(((dx, dy) for dx in range(-90, 91, 15) for dy in range(-96, 97, 8)),
                     key=lambda at: (math.hypot(*at), -at[0]))
    for x, y, text, *_ in points:
        px, py = axis.transData.transform((x, y))
        width, height = 3.9 * len(text) / scale, 9 / scale

        def box(dx: float, dy: float, px=px, py=py, width=width, height=height) -> tuple[float, float, float, float]:
            left = px + dx / scale if dx > 0 else px + dx / scale - width if dx < 0 else px - width / 2
            return left, py + dy / scale - height / 2, left + width, py + dy / scale + height / 2

        def clash(at: tuple[float, float], box=box) -> float:
            left, low, right, high = box(*at)
            inside = axis.bbox.x0 < left and right < axis.bbox.x1 and axis.bbox.y0 < low and high < axis.bbox.y1
            return (not inside) + sum(left < b[2] and b[0] < right and low < b[3] and b[1] < high for b in taken)

        dx, dy = min(offsets, key=clash)
        taken.append(box(dx, dy))
        axis.annotate(text, (x, y), xytext=(dx, dy), textcoords="offset points", fontsize=7, va="center",
                      ha="left" if dx > 0 else "right" if dx < 0 else "center",
                      arrowprops={"arrowstyle": "-", "lw": 0.4, "color": "grey"} if math.hypot(dx, dy) > 16 else None)
