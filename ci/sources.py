"""What the result of a bench follows from, by its meaning: a core, the bulk run, the cocotb bench."""

from __future__ import annotations

import importlib
import inspect
from pathlib import Path
from types import FunctionType, ModuleType

from quadrance.cores import Core

from ci import cache
from tb.lib import tools

BULK = ("tb/lib/stimulus.py", "tb/lib/suite.py", "tb/lib/bulk.py", "tb/lib/bulk.cpp", "tb/lib/program.py",
        "tb/lib/program.cpp")
COCOTB = ("tb/lib/bench.py", "tb/lib/stream.py")


def stimulus(core: Core) -> list[Path]:
    """The files that a core's samples come from: of its family, and of single models its own alone."""
    family = importlib.import_module(f"tb.stimulus.{core.family}")
    used = {one if isinstance(one, ModuleType) else inspect.getmodule(one) for one in vars(family).values()
            if isinstance(one, ModuleType | FunctionType)} - {family}
    own = getattr(family, "MODELS", {})
    used = {one for one in used if one not in own.values()} | {own.get(core.model_name, family)} - {family}
    return [Path(family.__file__), *sorted(Path(one.__file__) for one in used if one.__name__.startswith("tb.")
                                           and not one.__name__.startswith("tb.lib"))]


def bulk(core: Core) -> list[str]:
    """Of a bulk run of `core`: its RTL, its samples, the run."""
    return cache.meanings((*core.sources, *stimulus(core), *(tools.ROOT / name for name in BULK)))


def cocotb() -> list[str]:
    """Of the cocotb bench, beside those of the bulk run."""
    return cache.meanings(tools.ROOT / name for name in COCOTB)
