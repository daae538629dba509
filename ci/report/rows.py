"""Rows of the report: picked, named and read."""

from __future__ import annotations

from collections.abc import Callable, Iterable

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


def primitives(report: dict) -> list[Row]:
    """Rows of everything that is no kinematic core."""
    return [row for row in report["cores"] if row["function"] not in KINEMATIC]


def q7_8(rows: Iterable[Row]) -> list[Row]:
    """Rows with the paper's coordinates, Q7.8: others do less work and are not compared."""
    return [row for row in rows if (row["params"].get("W"), row["params"].get("F")) == (16, 8)]


def leading(rows: Iterable[Row]) -> list[Row]:
    """The first parameter set of each core, which is the one that is compared."""
    return list({row["core"]: row for row in reversed(list(rows))}.values())[::-1]


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
    """Cyclone V ALUTs, DSP and memory blocks not counted."""
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
