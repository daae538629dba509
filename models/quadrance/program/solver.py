"""This module finds the shortest order of a program's lines by constraint programming (OR-Tools, for development)."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence

from quadrance.program.schedule import Order, Rules

Pool = tuple[int, list[tuple[int, list[int]]]]


def solved(found: Rules, count: int, hint: Order, seconds: float,
           pools: Sequence[Pool] = ()) -> tuple[list[int | None], bool] | None:
    """The shortest order within a time, and whether none is shorter; None without OR-Tools.

    Parameters
    ----------
    hint : a sound order, to begin with.
    pools : registers that are few, with the lines that write them and the readers of each.
    """
    try:
        from ortools.sat.python import cp_model
    except ImportError:
        return None
    model, horizon = cp_model.CpModel(), len(hint)
    at = [model.new_int_var(0, horizon - 1, f"line {i}") for i in range(count)]
    model.add_all_different(at)
    lasts = defaultdict(list)
    for i, j, least in found.edges:
        if (i, j) in found.last and least == found.timing.register:
            last = model.new_bool_var("")
            lasts[j].append(last)
            model.add(at[j] == at[i] + found.timing.last).only_enforce_if(last)
            model.add(at[j] >= at[i] + least).only_enforce_if(~last)
        else:
            model.add(at[j] >= at[i] + least)
    for every in lasts.values():
        model.add_at_most_one(every)
    for i in found.inner:
        model.add(at[i] >= 1)
    for i, j in found.joined:
        model.add(at[j] == at[i] + 1)
    for windows in found.windows.values():
        intervals = []
        for window in windows:
            start, end = (model.new_int_var(0, horizon, "") for _ in range(2))
            model.add_min_equality(start, [at[i] for i in window.makers])
            for bound in (*(at[i] + 1 for i in window.makers), *(at[i] - slack for i, slack in window.uses)):
                model.add(end >= bound)
            intervals.append(model.new_interval_var(start, model.new_int_var(0, horizon, ""), end, ""))
        model.add_no_overlap(intervals)
    for registers, words in pools:
        intervals = []
        for maker, readers in words:
            end = model.new_int_var(1, horizon, "")
            for bound in (at[maker] + 1, *(at[i] for i in readers)):
                model.add(end >= bound)
            intervals.append(model.new_interval_var(at[maker], model.new_int_var(0, horizon, ""), end, ""))
        model.add_cumulative(intervals, [1] * len(intervals), registers)
    length = model.new_int_var(count, horizon, "length")
    model.add_max_equality(length, [one + 1 for one in at] + [at[i] + 2 for i in found.trailing])
    model.minimize(length)
    for clock, i in enumerate(hint):
        if i is not None:
            model.add_hint(at[i], clock)
    solver = cp_model.CpSolver()
    solver.parameters.max_time_in_seconds = seconds
    solver.parameters.num_workers = 2
    state = solver.solve(model)
    if state not in (cp_model.OPTIMAL, cp_model.FEASIBLE):
        return list(hint), False
    order: list[int | None] = [None] * solver.value(length)
    for i, one in enumerate(at):
        order[solver.value(one)] = i
    return order, state == cp_model.OPTIMAL
