"""What to feed a core: its own corners (tb/<family>/stimulus.py), or the extremes of every port."""

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
    name = f"tb.{core.family}.stimulus"
    return importlib.import_module(name) if find_spec(f"tb.{core.family}") and find_spec(name) else None


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


def saturation(core: Core, cfg: dict[str, int]) -> Vectors:
    """Inputs of a forward core at the edge of overflow: the last word inside and the first outside, and the next ones.

    Along joint 1, and along joint 2 where there is one, with the others at random, in eighths of a turn or next to
    them; no samples where nothing saturates. Both signs of every axis where the links are long enough.
    """
    return {name: np.array(words, dtype=np.int64)
            for name, words in zip((port.name for port in core.inputs), _edges(core, tuple(sorted(cfg.items()))))}


@cache
def _edges(core: Core, cfg: tuple[tuple[str, int], ...]) -> tuple[tuple[int, ...], ...]:
    """Columns of `saturation`."""
    lines = 16
    rng, names = np.random.default_rng(1), [port.name for port in core.inputs]

    def over(rows: np.ndarray) -> np.ndarray:
        words = {port.name: wrap(row, port.width, port.signed) for port, row in zip(core.inputs, rows)}
        answer = core.model(core.params, **words, **dict(cfg))
        return np.broadcast_to(answer["out_status"] & 4 > 0, rows.shape[1:])

    found = []
    for index, port in list(enumerate(core.inputs))[:2]:
        bits = port.width
        steps = min(32, 1 << bits)
        still = rng.integers(0, 1 << bits, (len(names), lines))
        still[:, ::2] = (rng.integers(0, 8, still[:, ::2].shape) << bits - 3) + rng.integers(-2, 3, still[:, ::2].shape)
        rows = np.repeat(still & (1 << bits) - 1, steps, axis=1)
        rows[index] = np.tile((np.arange(steps) << bits) // steps, lines) + int(rng.integers(0, (1 << bits) // steps))
        state = over(rows)
        toggles = np.flatnonzero((state[:-1] != state[1:]) & (np.arange(1, state.size) % steps != 0))
        if not toggles.size:
            continue
        low, high, first = rows[index, toggles], rows[index, toggles + 1], state[toggles]
        at = rows[:, toggles]
        while np.any(high - low > 1):
            at[index] = low + high >> 1
            same = over(at) == first
            low, high = np.where(same, at[index], low), np.where(same, high, at[index])
        for step in (-1, 0, 1, 2):
            at[index] = low + step & (1 << bits) - 1
            found.append(at.copy())
    if not found:
        return ((),) * len(names)
    return tuple(tuple(wrap(column, port.width, port.signed).tolist())
                 for port, column in zip(core.inputs, np.concatenate(found, axis=1)))


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
