"""Tables of the report: titled grids of strings."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from ci.report.comparison import leaders
from ci.report.rows import KINEMATIC, Row, area_of, greatest_error, leading, name, number, part, pick, q7_8, without_dsp

HEADLINE = {"vector": "unit vector: `vector_*`", "table": "binary angle: `table_*`",
            "classic": "binary angle, CORDIC: `classic_*_iter`", "rational": "spread: `rational_*`"}


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


def cycles(row: Row) -> str:
    """Latency in cycles."""
    return "comb." if row["latency_cycles"] == 0 else str(row["latency_cycles"])


def interval(row: Row) -> str:
    """Initiation interval in cycles."""
    return "–" if row["ii"] in (0, None) else str(row["ii"])


def area(row: Row) -> str:
    """ALUTs with the DSP and memory blocks beside them."""
    extra = ((row["area"]["cyclonev"][key], what) for key, what in (("dsp", "DSP"), ("mem", "mem")))
    return str(area_of(row)) + "".join(f" + {count} {what}" for count, what in extra if count)


def cost_table(title: str, rows: Iterable[Row]) -> Table:
    """Latency, II, area in every flow and clock."""
    def line(row: Row) -> tuple[str, ...]:
        alm = row["area"]["cyclonev"]
        return (f"`{name(row)}`", row["architecture"], cycles(row), interval(row),
                number(row["fmax_mhz"]["ecp5"], 4), number(row["latency_ns"]), str(alm["lut"]), str(alm["ff"]),
                str(alm["dsp"]), str(alm["mem"]), str(without_dsp(row)), str(row["area"]["ice40"]["lut"]),
                str(row["area"]["ecp5"]["lut"]))

    return Table(title, ("core", "architecture", "cycles", "II", "MHz", "ns", "ALUT", "FF", "DSP", "mem",
                         "ALUT, no DSP", "iCE40 LC", "ECP5 LUT"), tuple(map(line, rows)), text=2)


def accuracy_table(title: str, rows: Iterable[Row]) -> Table:
    """Arithmetic error on the trajectory and in the sweep, words' and total error over the workspace."""
    def line(row: Row) -> tuple[str, ...]:
        return (f"`{name(row)}`", *(number(part(row, *which)) for which in (
            ("error_lsb", "max"), ("error_lsb", "rms"), ("error_mm", "max"), ("error_mm", "rms"),
            ("sweep_error_lsb", "max"), ("sweep_error_lsb", "rms"))),
            *(number(row[key]) for key in ("words_lsb", "words_mm", "total_lsb", "total_mm")))

    return Table(title, ("core", "max LSB", "rms LSB", "max mm", "rms mm", "sweep max LSB", "sweep rms LSB",
                         "words LSB", "words mm", "total LSB", "total mm"), tuple(map(line, rows)))


def primitive_table(rows: Iterable[Row]) -> Table:
    """Error of the primitives that have a real-valued truth."""
    lines = tuple((f"`{name(row)}`", number(row["sweep_error_lsb"]["max"]), number(row["sweep_error_lsb"]["rms"]))
                  for row in rows if row["sweep_error_lsb"])
    return Table("Error against the real-valued function in LSB of the output, over random and border inputs",
                 ("primitive", "max LSB", "rms LSB"), lines)


def glance_table(report: dict) -> Table:
    """Every kinematic core of Q7.8 at its first parameter set, a line each."""
    def line(row: Row) -> tuple[str, ...]:
        return (f"`{name(row)}`", cycles(row), number(row["latency_ns"]), number(row["fmax_mhz"]["ecp5"], 4),
                area(row), str(without_dsp(row)), number(greatest_error(row)), number(row["words_lsb"]),
                number(row["total_lsb"]), number(row["total_mm"]))

    return Table("At a glance: every core of Q7.8 at its first parameter set", (
        "core", "cycles", "ns", "MHz", "ALUT + DSP + memory", "ALUT, no DSP", "arithmetic LSB", "words LSB",
        "total LSB", "total mm"), tuple(map(line, leading(q7_8(pick(report, KINEMATIC))))))


def headline_table(report: dict) -> Table:
    """The README's six rows: what a function costs with each kind of joint word, and by iterative CORDIC."""
    def cell(row: Row | None) -> str:
        if row is None:
            return "–"
        return f"{area(row)}; {cycles(row)} cycles, {number(row['latency_ns'])} ns; {number(row['total_mm'])} mm"

    lines = tuple((f"`{function}` {KINEMATIC[function]}", *(cell(found.get(family)) for family in HEADLINE))
                  for function, found in leaders(report).items())
    return Table("Area, latency and worst error by joint word", ("", *HEADLINE.values()), lines)


def page_table(rows: Iterable[Row]) -> Table:
    """The figures of a core's page."""
    def line(row: Row) -> tuple[str, ...]:
        alm = row["area"]["cyclonev"]
        return (f"`{name(row)}`", *(str(alm[key]) for key in ("lut", "ff", "dsp", "mem")), str(without_dsp(row)),
                cycles(row), interval(row), number(row["fmax_mhz"]["ecp5"], 4), number(greatest_error(row)))

    return Table("Figures", ("core", "ALUT", "FF", "DSP", "memory", "ALUT, no DSP", "cycles", "II", "ECP5 MHz",
                             "arithmetic error, LSB"), tuple(map(line, rows)))
