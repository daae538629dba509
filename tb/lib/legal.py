"""Random legal parameters of a core: drawn within the rule of its g_illegal, and Verilator has the last word."""

from __future__ import annotations

import re
import tempfile
from pathlib import Path

import numpy as np
from quadrance.cores import Core, all_cores

from tb.lib import tools

WIDEST = 20  # bits, of a word that no rule limits: the models count in 64
LIMITS = {"R": 8, "F": 12, "N": 15, "SHIFT": 12}  # as far as it is worth going where the rule names no number


def ranges(core: Core) -> dict[str, tuple[int, int]]:
    """Lowest and highest value of every parameter, by the numbers in the first rule found in the core's sources.

    A rule that compares with an expression is left to `legal`.
    """
    rule = next((match[1] for source in core.sources
                 if (match := re.search(r"if \((.*?)\) begin : g_illegal", source.read_text(), re.S))), "")
    bounds = {}
    for name in core.params:
        if name == "MODE":
            bounds[name] = core.params[name], core.params[name]
            continue
        low = max([int(word) for word in re.findall(rf"\b{name} < (\d+)", rule)], default=1)
        high = min([int(word) for word in re.findall(rf"\b{name} > (\d+)", rule)], default=LIMITS.get(name, WIDEST))
        bounds[name] = low, max(low, high)
    return bounds


def verdict(core: Core, params: dict[str, int]) -> str:
    """What Verilator says of these parameters: nothing, "illegal", or its warnings."""
    with tempfile.TemporaryDirectory() as scratch:
        log = Path(scratch, "log")
        try:
            tools.run("verilator", "--lint-only", "-Wall", "--quiet", "--language", "1364-2005", "--top-module",
                      core.name, *(f"-G{key}={value}" for key, value in params.items()), *core.sources, log=log)
        except tools.ToolError as error:
            return "illegal" if "_needs_" in log.read_text() else str(error)
    return ""


def legal(core: Core, count: int, seed: int, tries: int = 400) -> list[dict[str, int]]:
    """`count` random legal parameter sets, other than those of cores.toml; all there are where these are fewer.

    AssertionError when a set that the rule accepts does not pass Verilator without a warning.
    """
    rng, box = np.random.default_rng([seed, *core.name.encode()]), ranges(core)
    found: list[dict[str, int]] = []
    seen = {tuple(one.params.items()) for one in all_cores() if one.name == core.name}
    for _ in range(tries):
        params = {name: int(rng.integers(low, high, endpoint=True)) for name, (low, high) in box.items()}
        if tuple(params.items()) in seen:
            continue
        seen.add(tuple(params.items()))
        said = verdict(core, params)
        assert said in ("", "illegal"), f"{core.name} {params}: {said}"
        if not said:
            found.append(params)
        if len(found) == count:
            break
    return found
