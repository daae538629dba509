"""This module gives the lines of a program their places in time, by a list scheduler; `solver` finds shorter orders.

An order is a list of line numbers, one a clock, None for a clock without a line. What it has to keep stands in `Rules`,
from which `faults` judges any order. `Timing` says how soon a line can use what another has made.
"""

from __future__ import annotations

import random
from collections import defaultdict
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

from quadrance.program.language import Program, Wrong
from quadrance.program.lines import Line

Order = Sequence[int | None]
TRIES = 60  # of the list scheduler
LONGEST = 1000  # clocks of a program


@dataclass(frozen=True)
class Timing:
    """Lines between one that makes something and the first that can use it.

    Attributes
    ----------
    last : the one line that finds the word as LAST.
    power : FOLD or MORE and a power of two.
    root : ROOT and the table; `flags`: ROOT or FAR and HOLD or CLAMP.
    drain : clocks after the last line until its word is there.
    """

    register: int = 3
    last: int = 1
    power: int = 2
    root: int = 3
    flags: int = 2
    drain: int = 3


def timing(pipe: int = 0) -> Timing:
    """The distances of an engine with that PIPE (rtl/program/README.md)."""
    return (Timing(), Timing(4, 2, 3, 3, 3, 4), Timing(4, 3, 4, 4, 4, 6))[pipe]


@dataclass(frozen=True)
class Window:
    """A time in which one group of lines has a unit for itself: from its first maker to its last use.

    makers : lines that change the unit; the next group's come after them.
    uses : lines that use it, and the lines before them at which another group may change it already.
    """

    title: str
    makers: tuple[int, ...]
    uses: tuple[tuple[int, int], ...]

    @property
    def lines(self) -> set[int]:
        return {*self.makers, *(line for line, _ in self.uses)}


@dataclass
class Rules:
    """What an order has to keep.

    Attributes
    ----------
    edges : (i, j, distance): line j comes at least so many lines after line i.
    last : (i, j): or exactly `timing.last` after it, as LAST, which a line has once.
    joined : (i, j): j is the line after i.
    windows : of each shared unit.
    trailing : lines that are not the last one; `inner`: not the first one, which is played while the program is idle.
    """

    timing: Timing
    edges: list[tuple[int, int, int]] = field(default_factory=list)
    last: set[tuple[int, int]] = field(default_factory=set)
    joined: list[tuple[int, int]] = field(default_factory=list)
    windows: dict[str, list[Window]] = field(default_factory=dict)
    trailing: list[int] = field(default_factory=list)
    inner: set[int] = field(default_factory=set)


def _takes_last(user: Line, name: str) -> bool:
    """A line can have a word as LAST, which is operand A: it needs it once, and its products can be exchanged."""
    if user.registers.count(name) != 1 or user.source != "REG":
        return False
    return name == user.a or not user.by and (name == user.b or not user.minus)


def rules(program: Program, lines: Sequence[Line], at: Timing) -> Rules:
    """The rules for the lines of a program."""
    found, writer = Rules(at), {line.dest: i for i, line in enumerate(lines) if line.dest}
    results = {port.name for port in program.results}
    found.inner = {i for i, line in enumerate(lines) if line.keep or line.emit or line.dest in results
                   or line.acts - {"FOLD", "WRIST", "ABOVE", "ROOT"}}
    groups: dict[str, dict[int, list[int]]] = {unit: defaultdict(list) for unit in ("fold", "root", "far")}
    for i, line in enumerate(lines):
        for name in dict.fromkeys(line.registers):
            found.edges.append((writer[name], i, at.register))
            if _takes_last(line, name) and "HOLD" not in lines[writer[name]].acts:
                found.last.add((writer[name], i))
        if line.after >= 0:
            found.joined.append((line.after, i))
        for unit, members in groups.items():
            if (group := getattr(line, unit)) >= 0:
                members[group].append(i)
    for members in groups["fold"].values():
        _fold(found, lines, members)
    for members in groups["root"].values():
        _root(found, lines, members)
    for first, wide, clamp, *over in groups["far"].values():
        found.edges += [(first, wide, 1), (wide, clamp, at.flags), *((clamp, i, 1) for i in over)]
        found.windows.setdefault("FAR", []).append(Window(lines[clamp].label, (first, wide, *over),
                                                          ((clamp, at.flags - 1),)))
    _holds(found, program, lines, writer)
    for before, then in zip(program.order, program.order[1:]):
        found.edges += [(writer[a], writer[b], 2) for a in before for b in then]
    return found


def _fold(found: Rules, lines: Sequence[Line], members: list[int]) -> None:
    makers = tuple(i for i in members if "FOLD" in lines[i].acts)
    users = [i for i in members if lines[i].by in ("POWER", "FOUR", "TWICE")]
    roots = [i for i in members if "ROOT" in lines[i].acts]
    found.edges += [(maker, user, found.timing.power) for maker in makers for user in users]
    found.windows.setdefault("power", []).append(Window(lines[makers[0]].label, makers, (
        *((i, found.timing.power - 1) for i in users), *((i, 0) for i in roots))))


def _root(found: Rules, lines: Sequence[Line], members: list[int]) -> None:
    root = next(i for i in members if "ROOT" in lines[i].acts)
    tables = [i for i in members if lines[i].source == "TABLE"]
    holds = [i for i in members if "HOLD" in lines[i].acts]
    found.edges += [(root, i, found.timing.root) for i in tables]
    found.windows.setdefault("root", []).append(Window(lines[root].label, (root,), (
        *((i, found.timing.last) for i in tables), *((i, 0) for i in holds))))


def _holds(found: Rules, program: Program, lines: Sequence[Line], writer: dict[str, int]) -> None:
    """Directions that share a pair of registers come in the order of the text; flags are those of what came before."""
    readers: dict[int, list[int]] = defaultdict(list)
    for i, line in enumerate(lines):
        for name in line.registers:
            readers[writer[name]].append(i)
    pairs: dict[int, list[tuple[int, int]]] = defaultdict(list)
    holding = [i for i, line in enumerate(lines) if line.hold >= 0]
    for c, n in zip(holding[::2], holding[1::2]):
        pairs[lines[c].hold].append((c, n))
    for slot, every in pairs.items():
        if len(every) == 1:
            continue
        found.edges += [(a, b, found.timing.register if lines[b].own and which == other else 1) for one, two in
                        zip(every, every[1:]) for which, a in enumerate(one) for other, b in enumerate(two)]
        found.windows[f"held direction {slot + 1}"] = [Window(lines[c].label, (c, n), tuple(
            (i, 0) for i in readers[c] + readers[n])) for c, n in every]
    if program.streamed:
        found.windows["results"] = [Window(line.label, (i,), ((i, -2 if line.emit == "both" else -1),))
                                    for i, line in enumerate(lines) if line.emit]
        found.trailing = [i for i, line in enumerate(lines) if line.emit == "both"]
    told = {"HOLD", "NEAR"} if any(line.emit == "far" for line in lines) else {"HOLD", "FAR", "ABOVE"}
    changes = [i for i, line in enumerate(lines) if line.acts & told]
    for i, line in enumerate(lines):
        if line.emit == "flags":
            found.edges += [(j, i, 0) if j < i else (i, j, 1) for j in changes if j != i]


def ends(window: Window, at: Sequence[int]) -> int:
    """The first line at which another group may change the unit."""
    return max([at[i] + 1 for i in window.makers] + [at[i] - slack for i, slack in window.uses])


def faults(found: Rules, lines: Sequence[Line], order: Order) -> list[str]:
    """What an order does not keep, in words; empty for a sound one."""
    if sorted(i for i in order if i is not None) != list(range(len(lines))):
        return [f"the order is not one of these {len(lines)} lines"]
    at = [0] * len(lines)
    for clock, i in enumerate(order):
        if i is not None:
            at[i] = clock
    wrong = [f"'{lines[j].label}' comes {at[j] - at[i]} lines after '{lines[i].label}', {least} are needed"
             for i, j, least in found.edges if at[j] - at[i] < least
             and not ((i, j) in found.last and least == found.timing.register and at[j] - at[i] == found.timing.last)]
    wrong += [f"'{lines[j].label}' does not follow '{lines[i].label}' at once" for i, j in found.joined
              if at[j] != at[i] + 1]
    users = [j for i, j in found.last if at[j] - at[i] == found.timing.last]
    wrong += [f"'{lines[j].label}' needs LAST twice" for j in users if users.count(j) > 1]
    wrong += [f"'{lines[i].label}' is followed by its negative, and is the last line" for i in found.trailing
              if at[i] + 1 == len(order)]
    wrong += [f"'{lines[i].label}' is the first line, which is played while the program is idle"
              for i in found.inner if at[i] == 0]
    for unit, windows in found.windows.items():
        ordered = sorted(windows, key=lambda one: min(at[i] for i in one.makers))
        wrong += [f"'{two.title}' takes the {unit} while '{one.title}' needs it"
                  for one, two in zip(ordered, ordered[1:]) if min(at[i] for i in two.makers) < ends(one, at)]
    return wrong


class _Lister:
    """One try of the list scheduler: at each clock the most urgent line that can be placed."""

    def __init__(self, found: Rules, count: int, urgency: Callable[[int], float]) -> None:
        self.found, self.count = found, count
        self.before: dict[int, list[tuple[int, int]]] = defaultdict(list)
        for i, j, least in found.edges:
            self.before[j].append((i, least))
        after = dict(found.joined)
        self.chains = []
        for i in range(count):
            if i not in after.values():
                chain = [i]
                while chain[-1] in after:
                    chain.append(after[chain[-1]])
                self.chains.append(chain)
        self.chains.sort(key=lambda chain: -max(map(urgency, chain)))
        self.groups = {(unit, k): window for unit, windows in found.windows.items() for k, window in enumerate(windows)}
        self.makes = defaultdict(list)
        for key, window in self.groups.items():
            for i in window.makers:
                self.makes[i].append(key)
        self.needs = {key: self.others(key) for key in self.groups}
        alone = dict(self.needs)
        for (unit, k), window in self.groups.items():
            if unit == "power":  # its lines take the root unit, and must be able to
                self.needs[unit, k] = alone[unit, k].union(*(alone[other] for line in window.lines
                                                             for other in self.makes[line] if other[0] == "root"))

    def others(self, key: tuple[str, int]) -> set[int]:
        """Makers of other groups of the unit that lines of this group wait for."""
        seen, work = set(), list(self.groups[key].lines)
        while work:
            i = work.pop()
            for j, _ in self.before[i]:
                if j not in seen:
                    seen.add(j)
                    work.append(j)
        return {i for other, window in self.groups.items() if other[0] == key[0] and other != key
                for i in window.makers if i in seen}

    def ready(self, i: int, clock: int, at: dict[int, int]) -> bool:
        """Line i can be placed at a clock."""
        if clock == 0 and i in self.found.inner:
            return False
        lasts = 0
        for j, least in self.before[i]:
            if j not in at:
                return False
            if clock - at[j] < least:
                if (j, i) not in self.found.last or clock - at[j] != self.found.timing.last or lasts:
                    return False
                lasts = 1
        for key in self.makes[i]:
            if any(j in at for j in self.groups[key].makers):
                continue
            if not self.needs[key] <= at.keys():
                return False
            for other, window in self.groups.items():
                if other[0] == key[0] and other != key and any(j in at for j in window.makers) and (
                        not window.lines <= at.keys() or clock < ends(window, at)):
                    return False
        return True

    def run(self, within: int) -> list[int | None] | None:
        """An order of fewer than `within` clocks, or None."""
        at: dict[int, int] = {}
        taken: set[int] = set()
        waiting, clock = list(self.chains), 0
        while waiting and clock < within:
            for chain in waiting if clock not in taken else ():
                trial = dict(at)
                for k, i in enumerate(chain):
                    if clock + k in taken or not self.ready(i, clock + k, trial):
                        break
                    trial[i] = clock + k
                else:
                    at = trial
                    taken |= {clock + k for k in range(len(chain))}
                    waiting.remove(chain)
                    break
            clock += 1
        length = max([clock + 1 for clock in taken] + [at[i] + 2 for i in self.found.trailing if i in at])
        if waiting or length >= within:
            return None
        placed = {clock: i for i, clock in at.items()}
        return [placed.get(clock) for clock in range(length)]


def guided(found: Rules, order: Order) -> Rules:
    """The rules, with the groups of each unit one after the other as in an order at another PIPE."""
    at = {i: clock for clock, i in enumerate(order) if i is not None}
    edges = list(found.edges)
    for windows in found.windows.values():
        ordered = sorted(windows, key=lambda one: min(at[i] for i in one.makers))
        for one, two in zip(ordered, ordered[1:]):
            ended = [(i, 1) for i in one.makers] + [(i, -slack) for i, slack in one.uses]
            edges += [(i, j, least) for i, least in ended for j in two.makers]
    return replace(found, edges=edges, windows={})


def listed(program: Program, found: Rules, count: int, tries: int = TRIES) -> list[int | None]:
    """The shortest of some orders whose lines come by the longest way behind them, blurred by chance."""
    users, height = defaultdict(list), [0] * count
    for i, j, least in found.edges:
        users[i].append((j, 1 if (i, j) in found.last else least))
    for i, j in found.joined:
        users[i].append((j, 1))
    for _ in range(count):  # a line may stand before what it waits for
        new = [max((height[j] + least for j, least in users[i]), default=0) for i in range(count)]
        if new == height:
            break
        height = new
    else:
        raise program.wrong(1, "lines wait for one another in a circle")
    chance, best = random.Random(1), None
    for attempt in range(tries):
        blur = [1 + 0.3 * chance.random() * (attempt > 0) for _ in range(count)]
        one = _Lister(found, count, lambda i, blur=blur: height[i] * blur[i]).run(len(best) if best else LONGEST)
        best = one or best
    if best is None:
        raise Wrong(f"{program.path.name}: no order of its lines within {LONGEST} clocks was found")
    return best
