"""Rows of report.json, picked and read, and the tables made of them: titled grids of strings.

A row of a table speaks of one device: `mixed` finds one that does not.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass

Row = dict  # one element of report["cores"]; see `run.row_of`

KINEMATIC = {"fk1": "forward, 1 joint", "fk2": "forward, 2 joints", "fk3": "forward, 3 joints",
             "ik1": "inverse, 1 joint", "ik2": "inverse, 2 joints", "ik3": "inverse, 3 joints"}
FAMILIES = ("vector", "table", "rational", "classic", "paper")
MAPPED = ("fk2", "ik2")  # functions with a map of the workspace


def number(value: float | None, digits: int = 3) -> str:
    """`digits` significant digits without an exponent; a dash for None."""
    if value is None:
        return "–"
    if value == 0:
        return "0"
    if abs(value) < 10.0**-digits:
        return f"<{10.0**-digits:.{digits}f}"
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


def primitives(report: dict) -> list[Row]:
    """Rows of everything that is no kinematic core."""
    return [row for row in report["cores"] if row["function"] not in KINEMATIC]


def q7_8(rows: Iterable[Row]) -> list[Row]:
    """Rows with the paper's coordinates, Q7.8, without margin and slack: others do other work and are not compared."""
    return [row for row in rows if (row["params"].get("W"), row["params"].get("F")) == (16, 8)
            and not row["params"].get("MARGINS")]


def leading(rows: Iterable[Row], apart: Iterable[str] = ("MODE", "PIPE")) -> list[Row]:
    """The first parameter set of each core and of each MODE and PIPE of it, which is the one that is compared."""
    return list({(row["core"], *map(row["params"].get, apart)): row for row in reversed(list(rows))}.values())[::-1]


def leaders(report: dict) -> dict[str, dict[str, Row]]:
    """Function -> family -> its first core of Q7.8, of CORDIC the iterative one; families that have one."""
    found = {}
    for function in KINEMATIC:
        of: dict[str, Row] = {}
        for row in leading(q7_8(pick(report, [function]))):
            if row["family"] != "classic" or kind(row) == "iterative":
                of.setdefault(row["family"], row)
        if of:
            found[function] = of
    return found


def kind(row: Row) -> str:
    """Column of the paper's comparison that a row belongs to; empty for none (a pipeline)."""
    if row["family"] != "classic":
        return row["family"]
    return {"comb": "parallel", "parallel": "parallel", "iter": "iterative"}.get(row["architecture"].split("_")[0], "")


def best(rows: list[Row], measure: Callable[[Row], float | None]) -> Row | None:
    """The row with the smallest measure; the first of equals."""
    known = [row for row in rows if measure(row) is not None]
    return min(known, key=measure) if known else None


def area_of(row: Row) -> int:
    """Cyclone V ALUTs, the proxy for logic elements, DSP and memory blocks not counted."""
    return row["area"]["cyclonev"]["lut"]


def without_dsp(row: Row) -> int:
    """Cyclone V ALUTs with every multiplier in logic."""
    return row["area"]["cyclonev_nodsp"]["lut"]


def part(row: Row, key: str, which: str) -> float | None:
    """"max" or "rms" of an error; None where the core has none."""
    return row[key][which] if row[key] else None


def greatest_error(row: Row) -> float | None:
    """Greatest arithmetic error found, on the trajectory and in the sweep, in LSB of the output."""
    found = [part(row, key, "max") for key in ("error_lsb", "sweep_error_lsb")]
    return max((error for error in found if error is not None), default=None)


# Tables

HEADLINE = {"vector": "unit vector: `vector_*`", "table": "binary angle: `table_*`",
            "classic": "binary angle, CORDIC: `classic_*`", "rational": "spread: `rational_*`"}

DEVICES = {  # words of a head or a cell that belong to one device: our times are those of ECP5
    "ECP5": r"LUT|LUTs|LUTRAM|MULT18X18|EBR|(?<!UP5K )(?:MHz|ns)", "Cyclone V": r"ALUT|ALUTs|DSP|M10K|MLAB",
    "iCE40": r"LC|RAM4K|MAC16|UP5K"}
METRICS: tuple[tuple[str, Callable[[Row], float | None]], ...] = (
    ("ECP5 LUT", lambda row: row["area"]["ecp5"]["lut"]),
    ("ECP5 MULT18X18", lambda row: row["area"]["ecp5"]["dsp"]),
    ("ECP5 EBR", lambda row: row["area"]["ecp5"]["mem"]),
    ("ECP5 latency, ns", lambda row: row["latency_ns"]),
    ("ECP5 ns a sample", lambda row: row["ii"] * 1000 / row["fmax_mhz"]["ecp5"] if row["ii"] else None),
    ("Cyclone V ALUT", area_of),
    ("Cyclone V DSP", lambda row: row["area"]["cyclonev"]["dsp"]),
    ("Cyclone V M10K", lambda row: row["area"]["cyclonev"]["mem"]),
    ("Cyclone V ALUT, no DSP", without_dsp),
    ("iCE40 LC", lambda row: row["area"]["ice40"]["lut"]),
    ("cycles", lambda row: row["latency_cycles"]),
    ("arithmetic LSB", greatest_error),
    ("words LSB", lambda row: row["words_lsb"]),
    ("total LSB", lambda row: row["total_lsb"]))


@dataclass(frozen=True)
class Table:
    """A titled grid of strings; the first `text` columns are text, the others numbers."""

    title: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    text: int = 1

    def markdown(self, bars: bool = False) -> str:
        """As a Markdown table, without its title; with outer `bars` or without."""
        rule = "|".join(":--" if i < self.text else "--:" for i in range(len(self.head)))
        left, right = ("| ", " |") if bars else ("", "")
        head, *rows = (left + " | ".join(line) + right for line in (self.head, *self.rows))
        return "\n".join([head, left.strip() + rule + right.strip(), *rows])


def cycles(row: Row) -> str:
    """Latency in cycles."""
    return "comb." if row["latency_cycles"] == 0 else str(row["latency_cycles"])


def interval(row: Row) -> str:
    """Initiation interval in cycles."""
    return "–" if row["ii"] in (0, None) else str(row["ii"])


def blocks(row: Row, device: str) -> str:
    """LUTs, multipliers and memory blocks on a device, in one word."""
    return "/".join(str(row["area"][device][key]) for key in ("lut", "dsp", "mem"))


def cost_tables(title: str, rows: Iterable[Row]) -> list[Table]:
    """Area of every core, a table a device; cycles, clock and latency beside that of ECP5, whose clock it is.

    A kind of block that no core takes has no column.
    """
    rows = list(rows)

    def cell(row: Row, flow: str, key: str) -> str:
        small = row["area"]["ecp5"]["lutram"] if (flow, key) == ("ecp5", "lut") else 0
        return f"{row['area'][flow][key]}{f' ({small} LUTRAM)' if small else ''}"

    def table(device: str, columns: dict[str, str], more: dict[str, Callable[[Row], str]], flow: str) -> Table:
        cells = more | {head: lambda row, key=key: cell(row, flow, key) for key, head in columns.items()
                        if key in ("lut", "ff") or any(row["area"][flow][key] for row in rows)}
        cells |= {"ALUT, no DSP": lambda row: str(without_dsp(row))} if flow == "cyclonev" else {}
        return Table(f"{title}: {device}", ("core", *cells),
                     tuple((f"`{name(row)}`", *(cell(row) for cell in cells.values())) for row in rows))

    times = {"cycles": cycles, "II": interval, "MHz": lambda row: number(row["fmax_mhz"]["ecp5"], 4),
             "ns": lambda row: number(row["latency_ns"])}
    return [
        table("ECP5", {"lut": "LUT", "ff": "FF", "dsp": "MULT18X18", "mem": "EBR"}, times, "ecp5"),
        table("Cyclone V", {"lut": "ALUT", "ff": "FF", "dsp": "DSP", "mem": "M10K"}, {}, "cyclonev"),
        table("iCE40", {"lut": "LC", "mem": "RAM4K"}, {}, "ice40")]


def up5k_table(report: dict) -> Table:
    """Area, clock and latency of the cores of the headline on an iCE40 UP5K."""
    rows, lines = report.get("up5k", {"rows": {}})["rows"], []
    for one in (one for of in leaders(report).values() for one in of.values() if name(one) in rows):
        row = rows[name(one)]
        took = max(one["latency_cycles"], 1) * 1000 / row["mhz"] if row["mhz"] else None
        lines.append((f"`{name(one)}`", *(str(row[key]) for key in ("lut", "dsp", "mem")), number(row["mhz"]),
                      number(took)))
    return Table("Kinematic cores: iCE40 UP5K", ("core", "LC", "MAC16", "RAM4K", "UP5K MHz", "UP5K ns"), tuple(lines))


def accuracy_table(title: str, rows: Iterable[Row]) -> Table:
    """Greatest arithmetic error, its rms along the trajectory, words' and total error over the workspace."""
    def line(row: Row) -> tuple[str, ...]:
        return (f"`{name(row)}`", number(greatest_error(row)), number(part(row, "error_lsb", "rms")),
                *(number(row[key]) for key in ("words_lsb", "total_lsb", "total_mm")))

    return Table(title, ("core", "arithmetic LSB", "rms LSB", "words LSB", "total LSB", "total mm"),
                 tuple(map(line, rows)))


def primitive_table(rows: Iterable[Row]) -> Table:
    """Error of the parts that have a real-valued truth."""
    lines = tuple((f"`{name(row)}`", number(row["sweep_error_lsb"]["max"]), number(row["sweep_error_lsb"]["rms"]))
                  for row in rows if row["sweep_error_lsb"])
    return Table("Error against the real-valued function, LSB of the output, over random and border inputs",
                 ("core", "max LSB", "rms LSB"), lines)


def headline_table(report: dict) -> Table:
    """The README's six rows: what a function costs on ECP5 with each kind of joint word, and by iterative CORDIC."""
    def cell(row: Row | None) -> str:
        if row is None:
            return "–"
        return f"{blocks(row, 'ecp5')}; {cycles(row)} ({number(row['latency_ns'])}); {number(row['total_mm'])}"

    lines = tuple((f"`{function}` {KINEMATIC[function]}", *(cell(found.get(family)) for family in HEADLINE))
                  for function, found in leaders(report).items())
    return Table("ECP5: area, latency and worst error by joint word", ("on ECP5", *HEADLINE.values()), lines)


def cordic_table(report: dict) -> Table:
    """The least of every figure that `rational_*` and `classic_*` have, a figure a row, and where CORDIC has less."""
    rivals = {function: [leading(q7_8(pick(report, [function], [family]))) for family in ("rational", "classic")]
              for function in KINEMATIC}
    rivals = {function: both for function, both in rivals.items() if all(both)}
    lines = []
    for label, measure in METRICS:
        cells, wins = [], []
        for function, both in rivals.items():
            found = [best(rows, measure) for rows in both]
            ours, theirs = (measure(row) if row else None for row in found)
            cells.append(f"{number(ours, 4)}/{number(theirs, 4)}")
            wins += [function] * (None not in (ours, theirs) and theirs < ours)
        lines.append((label, *cells, ", ".join(wins) or "–"))
    return Table("Least of `rational_*` / least of `classic_*` (CORDIC), figure by figure",
                 ("figure", *rivals, "CORDIC has less in"), tuple(lines) if rivals else ())


def mixed(text: str, where: str) -> list[str]:
    """Rows of Markdown tables, their heads included, that speak of more than one device."""
    problems, head = [], ""
    for number_, line in enumerate(text.splitlines(), 1):
        if "|" not in line:
            head = ""
            continue
        head = head or line
        words = re.sub(r"`[^`]*`|no DSP", "", f"{head} {line}")
        found = {device: sorted(set(re.findall(rf"\b(?:{pattern})\b", words))) for device, pattern in DEVICES.items()}
        found = {device: of for device, of in found.items() if of}
        if len(found) > 1:
            problems.append(f"{where}:{number_}: one row, one device: " + "; ".join(
                f"{device} ({', '.join(of)})" for device, of in found.items()))
    return problems
