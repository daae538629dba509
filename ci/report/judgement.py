"""The verdict in sentences: who wins where, and what rational trigonometry itself saves and costs."""

from __future__ import annotations

from collections.abc import Iterable

from ci.report.comparison import leaders
from ci.report.rows import KINEMATIC, Row, number
from ci.report.verdict import TARGETS, Figures, plain, price, reaching

FIGURES = (("alut", "fewest ALUTs beside DSP and memory blocks", ""),
           ("price", "least area with every block as ALUTs", ""),
           ("nodsp", "fewest ALUTs without DSP blocks", ""), ("cycles", "fewest cycles", ""),
           ("ns", "shortest latency", " ns"))


def joined(parts: Iterable[str]) -> str:
    """"a, b and c"."""
    *head, last = parts
    return f"{', '.join(head)} and {last}" if head else last


def least(found: list[Figures], key: str) -> str:
    """The cores with the least of a figure, and that figure; empty where none is known."""
    known = [one for one in found if one[key] is not None]
    if not known:
        return ""
    low = min(one[key] for one in known)
    leaders = [f"`{one['core']}`" for one in known if one[key] == low]
    return f"{joined(leaders)} {number(low, 3 if key == 'ns' else 5)}"


def who_wins(verdict: dict, function: str, target: str) -> str:
    """One sentence: the cores with the least of every figure, and those that do not reach the target."""
    found = [one | {"price": price(one)} for one in reaching(verdict, function, target)]
    reached = {one["core"] for one in found}
    missed = [f"`{design['core']}` ({number(design['best_lsb'])} LSB at best)" for design in plain(verdict, function)
              if design["core"] not in reached]
    if not found:
        return f"{function}, {target}: no core reaches it."
    clauses = [f"{text}: {leader}{unit}" for key, text, unit in FIGURES if (leader := least(found, key))]
    return f"{function}, {target}: {'; '.join(clauses)}." + (f" Not reached by {joined(missed)}." if missed else "")


def wins(verdict: dict) -> list[str]:
    """`who_wins` of every function that has a core, target by target."""
    return [who_wins(verdict, function, target) for function in KINEMATIC if plain(verdict, function)
            for target in TARGETS]


def families(verdict: dict, target: str) -> list[str]:
    """For every figure, which function goes to which family at one target: the README's sentences."""
    sentences = []
    for key, text, _ in FIGURES:
        of: dict[str, list[str]] = {}
        for function in KINEMATIC:
            found = [one | {"price": price(one)} for one in reaching(verdict, function, target)]
            known = [one for one in found if one[key] is not None]
            for one in known:
                if one[key] == min(other[key] for other in known):
                    of.setdefault(one["family"], []).append(function)
        if of:
            sentences.append(f"{text[0].upper()}{text[1:]}: " + "; ".join(
                f"`{family}_*` in {joined(dict.fromkeys(functions))}" for family, functions in of.items()) + ".")
    return sentences


# What rational trigonometry itself changes: spreads against angles, both with tables and products

ITSELF = (("mem", "memory blocks"), ("dsp", "DSP blocks"), ("alut", "ALUTs"), ("cycles", "cycles"),
          ("ii", "cycles between samples"), ("bits", "bits of a joint word"))
REASON = {  # (figure, way, sign of spread - angle): why
    ("mem", "fk", 1): "the square root of a spread needs four ranges of table where a sine needs one",
    ("mem", "ik", -1): "a spread is a quotient of squared lengths, so no table of an arc is needed",
    ("ii", "fk", 1): "spreads do not add, so two joints take six products where added angles take four",
    ("bits", "fk", 1): "a spread is flat at a quadrant border, where two of its bits are worth one of an angle",
    ("bits", "ik", 1): "a spread is flat at a quadrant border, where two of its bits are worth one of an angle"}


def _of_row(row: Row) -> Figures:
    """The figures that are compared, of a row of the report."""
    area, params = row["area"]["cyclonev"], row["params"]
    return {"alut": area["lut"], "dsp": area["dsp"], "mem": area["mem"], "cycles": row["latency_cycles"],
            "ii": row["ii"], "bits": params["S"] + 2 if "S" in params else params["A"]}


def pairs(report: dict) -> dict[str, tuple[str, Figures, Figures]]:
    """Function -> where a spread and an angle are compared, and their figures there.

    At the tightest target that `rational_*` and `table_*` both reach; without such a target, at their first sets.
    """
    found, first = {}, leaders(report)
    for function in KINEMATIC:
        ours, theirs = (first.get(function, {}).get(family) for family in ("rational", "table"))
        if ours and theirs:
            errors = f"{number(ours['total_lsb'])} and {number(theirs['total_lsb'])} LSB"
            found[function] = f"no common target (first sets: {errors})", _of_row(ours), _of_row(theirs)
        for target in TARGETS:
            of = {one["family"]: one for one in reversed(reaching(report["verdict"], function, target))}
            if {"rational", "table"} <= set(of):
                found[function] = target, of["rational"], of["table"]
    return found


def itself(report: dict) -> list[str]:
    """What a spread saves and costs against a binary angle with the same means."""
    found, sentences = pairs(report), []
    for key, text in ITSELF:
        for way, sign in ((way, sign) for sign in (-1, 1) for way in ("fk", "ik")):
            cases = [f"{function} ({ours[key]} against {theirs[key]})" for function, (_, ours, theirs) in found.items()
                     if function.startswith(way) and (ours[key] - theirs[key]) * sign > 0]
            if cases:
                why = f": {REASON[key, way, sign]}" if (key, way, sign) in REASON else ""
                sentences.append(f"It {'saves' if sign < 0 else 'costs'} {text} in {joined(cases)}{why}.")
        equal = [function for function, (_, ours, theirs) in found.items() if ours[key] == theirs[key]]
        if equal:
            sentences.append(f"It takes as many {text} in {joined(equal)}.")
    return sentences


def itself_at(report: dict) -> str:
    """Where `itself` compares."""
    found = pairs(report)
    if not found:
        return "No function has both `rational_*` and `table_*` yet."
    where = joined(f"{function} at {target}" for function, (target, *_) in found.items())
    return ("A turn-spread (`rational_*`) against a binary angle (`table_*`), both with tables and products, each at "
            f"the tightest target that both reach: {where}.")
