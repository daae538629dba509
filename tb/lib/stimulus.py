"""What to feed a core: its own corners (tb/<family>/stimulus.py), or the extremes of every port."""

from __future__ import annotations

import importlib
import itertools
from importlib.util import find_spec
from types import ModuleType

import numpy as np
from quadrance.cores import Core, Port

Vectors = dict[str, np.ndarray]


def _family(core: Core) -> ModuleType | None:
    name = f"tb.{core.family}.stimulus"
    return importlib.import_module(name) if find_spec(f"tb.{core.family}") and find_spec(name) else None


def extremes(port: Port) -> list[int]:
    """Lowest, highest, zero, one, middle and their neighbours."""
    span = {port.low, port.low + 1, -1, 0, 1, port.high // 2, port.high // 2 + 1, port.high - 1, port.high}
    return sorted(value for value in span if port.low <= value <= port.high)


def configs(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """Legal configuration words, extremes first."""
    family = _family(core)
    if family and hasattr(family, "configs"):
        return family.configs(core, rng)
    if not core.cfg:
        return [{}]
    low, high = ({port.name: edge(port) for port in core.cfg} for edge in (lambda p: p.low, lambda p: p.high))
    return [high, low, *({p.name: int(rng.integers(p.low, p.high + 1)) for p in core.cfg} for _ in range(2))]


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Directed inputs: borders, extremes, every status bit."""
    family = _family(core)
    if family and hasattr(family, "corners"):
        return {name: np.asarray(values, dtype=np.int64) for name, values in family.corners(core, cfg).items()}
    rows = list(itertools.islice(itertools.product(*map(extremes, core.inputs)), 400))
    return {port.name: np.array(column, dtype=np.int64) for port, column in zip(core.inputs, zip(*rows))}


def uniform(core: Core, rng: np.random.Generator, count: int) -> Vectors:
    """Random words, and one in four of random length, so that small values occur too."""
    vectors = {}
    for port in core.inputs:
        words = rng.integers(port.low, port.high, count, endpoint=True, dtype=np.int64)
        short = words >> rng.integers(0, port.width, count)
        vectors[port.name] = np.where(rng.random(count) < 0.25, short, words)
    return vectors


def exhaustive(core: Core) -> Vectors:
    """Every input there is, first port slowest."""
    ranges = [np.arange(port.low, port.high + 1, dtype=np.int64) for port in core.inputs]
    grid = np.meshgrid(*ranges, indexing="ij")
    return {port.name: axis.ravel() for port, axis in zip(core.inputs, grid)}


def input_bits(core: Core) -> int:
    """Width of one input sample."""
    return sum(port.width for port in core.inputs)
