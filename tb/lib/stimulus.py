"""What to feed a core: its own corners (tb/stimulus/<family>.py), or the extremes of every port."""

from __future__ import annotations

import importlib
import itertools
from functools import cache
from importlib.util import find_spec
from types import ModuleType

import numpy as np
from quadrance.cores import Core, Port
from quadrance.fixed import wrap

Vectors = dict[str, np.ndarray]


def _family(core: Core) -> ModuleType | None:
    name = f"tb.stimulus.{core.family}"
    return importlib.import_module(name) if find_spec(name) else None


def extremes(port: Port) -> list[int]:
    """Lowest, highest, zero, one, middle and their neighbours."""
    span = {port.low, port.low + 1, -1, 0, 1, port.high // 2, port.high // 2 + 1, port.high - 1, port.high}
    return sorted(value for value in span if port.low <= value <= port.high)


Config = dict[str, int]
SMALL = 5  # bits of a configuration word of which every value is tried; of a longer one each bit at 0 and at 1
DRAWS = 400


def configs(core: Core, rng: np.random.Generator) -> list[Config]:
    """Legal configuration words, extremes first; at the end those that have what the others lack (`facts`)."""
    family = _family(core)
    if family and hasattr(family, "configs"):
        found = family.configs(core, rng)
        return found + _lacking(core, found)
    if not core.cfg:
        return [{}]
    low, high = ({port.name: edge(port) for port in core.cfg} for edge in (lambda p: p.low, lambda p: p.high))
    return [high, low, *({p.name: int(rng.integers(p.low, p.high + 1)) for p in core.cfg} for _ in range(2))]


def facts(core: Core, cfg: Config) -> set[tuple[str, int, int]]:
    """What a configuration tries: (port, bits, value) of every bit, and of every small word as a whole."""
    found = set()
    for port in core.cfg:
        word = cfg[port.name] & (1 << port.width) - 1
        found |= {(port.name, 1 << bit, word & 1 << bit) for bit in range(port.width)}
        if port.width <= SMALL:
            found.add((port.name, (1 << port.width) - 1, word))
    return found


def drawn(core: Core, rng: np.random.Generator) -> Config:
    """A configuration as a user may have it: the family's `draw`, or any words where it has none."""
    family = _family(core)
    if family and hasattr(family, "draw"):
        cfg = family.draw(core, rng)
        return {port.name: cfg[port.name] for port in core.cfg}
    return {port.name: int(rng.integers(port.low, port.high, endpoint=True)) for port in core.cfg}


def _lacking(core: Core, found: list[Config]) -> list[Config]:
    """As few of many drawn configurations as try all that `found` does not."""
    rng = np.random.default_rng(1)
    seen = set().union(*(facts(core, cfg) for cfg in found))
    pool = [(cfg, facts(core, cfg)) for cfg in (drawn(core, rng) for _ in range(DRAWS if core.cfg else 0))]
    more: list[Config] = []
    while pool:
        pool = [(cfg, news) for cfg, tried in pool if (news := tried - seen)]
        cfg, news = max(pool, key=lambda one: len(one[1]), default=({}, set()))
        seen |= news
        more += [cfg] if news else []
    return more


def length(rng: np.random.Generator, bits: int) -> int:
    """A link of any length up to a word's, none among them: log-uniform."""
    return min(int(2 ** rng.uniform(-2, bits)), (1 << bits) - 1)


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Directed inputs: borders, extremes, every status bit; of a short word what its bits hold of them."""
    family = _family(core)
    if family and hasattr(family, "corners"):
        words = family.corners(core, cfg)
        return {port.name: wrap(np.asarray(words[port.name], dtype=np.int64), port.width, port.signed)
                for port in core.inputs}
    rows = list(itertools.islice(itertools.product(*map(extremes, core.inputs)), 400))
    return {port.name: np.array(column, dtype=np.int64) for port, column in zip(core.inputs, zip(*rows))}


def uniform(core: Core, rng: np.random.Generator, count: int) -> Vectors:
    """Random words, and one in four of random length, so that small values occur too.

    Joint words are short from a border of a quadrant: log-uniform on all eight sides of the four.
    """
    vectors = {}
    for port in core.inputs:
        words = rng.integers(port.low, port.high, count, endpoint=True, dtype=np.int64)
        if port.type:
            quadrant, length = words >> port.width - 2, rng.integers(0, port.width - 1, count)
            off = (words & (1 << port.width - 2) - 1) >> length
            side = -(words & 1)  # -1: below the border, counted from the word before it
            short = wrap((quadrant << port.width - 2) + (off ^ side), port.width, port.signed)
        else:
            short = words >> rng.integers(0, port.width, count)
        vectors[port.name] = np.where(rng.random(count) < 0.25, short, words)
    return vectors


def saturation(core: Core, cfg: dict[str, int], starts: Vectors | None = None) -> Vectors:
    """Inputs at the edge of overflow, of each coordinate and each end: the last that fits and the first that does not.

    Found on lines from samples that saturate this coordinate to samples that saturate none: the two are next to each
    other on the line. No samples where nothing saturates. `starts` are samples from which the lines begin and end,
    besides those in eighths of a turn or next to them and random words.
    """
    names, more = [port.name for port in core.inputs], starts or {}
    extra = tuple(tuple(np.asarray(more[name]).tolist()) for name in names) if more else ((),) * len(names)
    return {name: np.array(words, dtype=np.int64)
            for name, words in zip(names, _edges(core, tuple(sorted(cfg.items())), extra))}


LINES, KEPT = 24, 3  # lines of each end that are searched; of them those whose last result is nearest to the end


def ends(core: Core, port: Port) -> tuple[int, int]:
    """The words to which a coordinate saturates."""
    return (-port.high if core.family == "paper" and core.function != "mff" else port.low), port.high


def coordinates(core: Core) -> list[Port]:
    """The outputs that saturate, each on its own: coordinates, velocities, rates."""
    return [port for port in core.outputs if port.name[4] in "xyzvw" and not port.type]


@cache
def _edges(core: Core, cfg: tuple[tuple[str, int], ...],
           starts: tuple[tuple[int, ...], ...]) -> tuple[tuple[int, ...], ...]:
    """Columns of `saturation`."""
    rng = np.random.default_rng(1)
    rows = []
    for port, begin in zip(core.inputs, starts):
        wild = rng.integers(port.low, port.high, 600, endpoint=True)
        if port.type:
            eighths = (rng.integers(0, 8, 400) << port.width - 3) + rng.integers(-2, 3, 400)
            wild[:400] = wrap(eighths, port.width, port.signed)
            if port.type == "vector":
                one = 1 << port.width - 2
                wild = np.where(rng.random(600) < 0.8, rng.choice([-one, 0, one], 600), wild >> rng.integers(0, 3, 600))
        else:
            wild >>= rng.integers(0, port.width // 2, 600)
        rows.append(np.append(wild, np.array(begin, dtype=np.int64)))
    table = np.array(rows)

    def answer(rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Values (coordinates, N) and of the status overflow (4) and singular (2), which may show the sample before."""
        words = dict(zip((port.name for port in core.inputs), rows))
        found = core.model(core.params, **words, **dict(cfg))
        values = [np.broadcast_to(found[port.name], rows.shape[1:]) for port in coordinates(core)]
        return np.array(values), np.broadcast_to(found["out_status"] & 6, rows.shape[1:])

    values, status = answer(table)
    inside, found = np.flatnonzero(status == 0), []
    for index, port in enumerate(coordinates(core)):
        for end in ends(core, port):
            at_end = np.flatnonzero((status == 4) & (values[index] == end))
            if not at_end.size or not inside.size:
                continue
            first = table[:, rng.choice(at_end, LINES)]
            way = table[:, rng.choice(inside, LINES)] - first
            low, high = np.zeros(LINES, dtype=np.int64), np.full(LINES, 1 << 20)
            while np.any(high - low > 1):
                middle = low + high >> 1
                there, flag = answer(first + (way * middle >> 20))
                same = (flag == 4) & (there[index] == end)
                low, high = np.where(same, middle, low), np.where(same, high, middle)
            pair = first + (way * low >> 20), first + (way * high >> 20)
            there, flag = answer(pair[1])
            off = np.where(flag > 0, 1 << 40, np.abs(there[index] - end))
            best = np.argsort(off, kind="stable")[:KEPT]
            found += [rows[:, best] for rows in pair]
    if not found:
        return ((),) * len(core.inputs)
    return tuple(tuple(column.tolist()) for column in np.concatenate(found, axis=1))


def joined(first: Vectors, second: Vectors) -> Vectors:
    """The samples of one after those of the other."""
    return {name: np.concatenate([words, second[name]]) for name, words in first.items()}


def exhaustive(core: Core) -> Vectors:
    """Every input there is, first port slowest."""
    ranges = [np.arange(port.low, port.high + 1, dtype=np.int64) for port in core.inputs]
    grid = np.meshgrid(*ranges, indexing="ij")
    return {port.name: axis.ravel() for port, axis in zip(core.inputs, grid)}


def input_bits(core: Core) -> int:
    """Width of one input sample."""
    return sum(port.width for port in core.inputs)
