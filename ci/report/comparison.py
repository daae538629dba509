"""Who is better in what: rational against CORDIC, in sentences."""

from __future__ import annotations

from collections.abc import Callable

from ci.report.rows import (
    KINEMATIC,
    Row,
    area_of,
    best,
    greatest_error,
    kind,
    leading,
    name,
    number,
    pick,
    q7_8,
    without_dsp,
)

METRICS: tuple[tuple[str, str, Callable[[Row], float | None]], ...] = (
    ("ALUT with DSP blocks", "", area_of),
    ("ALUT without DSP blocks", "", without_dsp),
    ("iCE40 logic cells", "", lambda row: row["area"]["ice40"]["lut"]),
    ("ECP5 LUTs", "", lambda row: row["area"]["ecp5"]["lut"]),
    ("DSP blocks", "", lambda row: row["area"]["cyclonev"]["dsp"]),
    ("memory blocks", "", lambda row: row["area"]["cyclonev"]["mem"]),
    ("latency in cycles", "", lambda row: row["latency_cycles"]),
    ("latency in ns", " ns", lambda row: row["latency_ns"]),
    ("clock", " MHz", lambda row: -row["fmax_mhz"]["ecp5"]),
    ("throughput", " ns a sample", lambda row: row["ii"] * 1000 / row["fmax_mhz"]["ecp5"] if row["ii"] else None),
    ("greatest arithmetic error", " LSB", greatest_error),
    ("greatest error of the words", " LSB", lambda row: row["words_lsb"]),
    ("greatest total error", " LSB", lambda row: row["total_lsb"]),
)


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


def where_cordic_is_smaller(report: dict, family: str) -> str:
    """One sentence: in which area columns, for which functions, iterative CORDIC is smaller than a family's cores."""
    pairs = {function: (of[family], of["classic"]) for function, of in leaders(report).items()
             if family in of and "classic" in of}
    clauses = []
    for label, measure in (("logic when there are no DSP blocks", without_dsp), ("logic beside DSP blocks", area_of),
                           ("DSP blocks", lambda row: row["area"]["cyclonev"]["dsp"]),
                           ("memory blocks", lambda row: row["area"]["cyclonev"]["mem"])):
        ours, theirs = ({function: measure(pair[i]) for function, pair in pairs.items()} for i in (0, 1))
        smaller = [function for function in pairs if theirs[function] < ours[function]]
        if smaller:
            which = "for every function" if len(smaller) == len(pairs) and len(pairs) > 1 else \
                f"for {', '.join(smaller)}"
            clauses.append(f"in {label} {which} ({_range(theirs, smaller)} against {_range(ours, smaller)})")
    if not pairs:
        return f"No function has both `{family}_*` and iterative CORDIC yet."
    if not clauses:
        return f"Iterative CORDIC is nowhere smaller than `{family}_*`."
    return f"Iterative CORDIC is smaller than `{family}_*` {_join(clauses)}."


def smaller(report: dict) -> list[str]:
    """Where CORDIC is smaller than the tables, with which it shares its joint word, and than the spreads."""
    return [where_cordic_is_smaller(report, family) for family in ("table", "rational")]


def _range(values: dict[str, float], functions: list[str]) -> str:
    low, high = min(values[one] for one in functions), max(values[one] for one in functions)
    return number(low, 6) if low == high else f"{number(low, 6)} to {number(high, 6)}"


def _join(clauses: list[str]) -> str:
    return clauses[0] if len(clauses) == 1 else f"{', '.join(clauses[:-1])} and {clauses[-1]}"


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


def _excess(row: Row, rival: Row) -> tuple[float, float, float]:
    """How much worse than the rival: ALUTs, cycles, greatest arithmetic error in LSB (0 or less: not worse)."""
    ours, theirs = (greatest_error(one) or 0.0 for one in (row, rival))
    return (area_of(row) - area_of(rival) + 1, row["latency_cycles"] - rival["latency_cycles"] + 1, ours - theirs)


def _misses(area: float, cycles: float, error: float) -> str:
    """What a core that does not win is short of."""
    def more(value: float, unit: str) -> str:
        return f"{value:.0f} {unit} more" if value > 0 else f"as many {unit}"

    texts = [text for value, text in ((area, more(area - 1, "ALUTs")), (cycles, more(cycles - 1, "cycles")),
                                      (error, f"a {number(error)} LSB larger error")) if value > 0]
    return " and ".join(texts)


def pareto(report: dict) -> list[str]:
    """For each function: does a rational core take less area and fewer cycles than every iterative CORDIC core,
    at no larger arithmetic error? If not, by how much it misses."""
    sentences = []
    for function in KINEMATIC:
        rational = leading(pick(report, [function], ["rational"]))
        for rival in (row for row in leading(pick(report, [function], ["classic"])) if kind(row) == "iterative"):
            excess = {name(row): _excess(row, rival) for row in rational}
            winners = [core for core, by in excess.items() if max(by) <= 0]
            if winners:
                sentences.append(f"{function.upper()}: `{winners[0]}` takes fewer ALUTs and fewer cycles than "
                                 f"`{name(rival)}` at no larger arithmetic error.")
            elif excess:
                closest = min(excess, key=lambda core: (sum(one > 0 for one in excess[core]), max(excess[core][0], 0)))
                sentences.append(f"{function.upper()}: no rational core beats `{name(rival)}` in area and cycles at no "
                                 f"larger error; the closest, `{closest}`, has {_misses(*excess[closest])}.")
    return sentences
