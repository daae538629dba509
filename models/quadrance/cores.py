"""Reader of ``rtl/cores.toml``, the one list of cores, ports, parameter sets and latencies."""

from __future__ import annotations

import importlib
import re
import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
RTL = ROOT / "rtl"
STATUS_BITS = {"unreachable": 0, "singular": 1, "overflow": 2, "not_converged": 3}
FAMILIES = ("arith", "cordic", "codec", "paper", "rational", "classic", "engine")


@dataclass(frozen=True)
class Port:
    """One data port: its Verilog name, width in bits and whether it is two's complement."""

    name: str
    width: int
    signed: bool

    @property
    def low(self) -> int:
        """Smallest value the port can carry."""
        return -(1 << self.width - 1) if self.signed else 0

    @property
    def high(self) -> int:
        """Largest value the port can carry."""
        return (1 << self.width - self.signed) - 1


@dataclass(frozen=True)
class Core:
    """One core at one parameter set, as `rtl/cores.toml` declares it."""

    name: str
    family: str
    function: str
    architecture: str
    set_id: str
    params: dict[str, int]
    latency: int | None
    ii: int | None
    sources: tuple[Path, ...]
    cfg: tuple[Port, ...]
    inputs: tuple[Port, ...]
    outputs: tuple[Port, ...]
    status: tuple[str, ...] | None
    model_name: str
    first_set: bool
    illegal: tuple[dict[str, int], ...] = ()

    @property
    def id(self) -> str:
        """Readable name, unique over all cores and parameter sets."""
        return f"{self.name}-{self.set_id}"

    @property
    def clocked(self) -> bool:
        """False for a purely combinational primitive: no clock, no handshake."""
        return self.latency != 0

    @property
    def model(self) -> Callable[..., dict]:
        """The bit-true model: ``model(params, **ports) -> {out port: int64 array}``."""
        module, _, function = self.model_name.rpartition(".")
        return getattr(importlib.import_module(f"quadrance.{module}"), function)

    def __hash__(self) -> int:
        return hash(self.id)


def _port(prefix: str, name: str, spec: str, params: dict[str, int], where: str) -> Port:
    match = re.fullmatch(r"([us])(\S.*)", spec)
    if not match or re.search(r"[^\w\s+\-*/(),]", match[2]):
        raise ValueError(f"{where}: port {name}: '{spec}' is not u or s and a width in the parameters")
    width = int(eval(match[2], {"__builtins__": {}, "max": max, "min": min}, dict(params)))
    if width < 1:
        raise ValueError(f"{where}: port {name}: width '{spec}' is {width} at {params}")
    return Port(f"{prefix}_{name}", width, match[1] == "s")


def _expand(name: str, entry: dict) -> list[Core]:
    where = f"cores.toml: {name}"
    known = {"family", "function", "architecture", "cfg", "in", "out", "status", "model", "sets", "illegal"}
    if extra := set(entry) - known:
        raise ValueError(f"{where}: unknown key {sorted(extra)[0]}")
    if missing := {"family", "function", "architecture", "in", "out", "model", "sets"} - set(entry):
        raise ValueError(f"{where}: missing key {sorted(missing)[0]}")
    if entry["family"] not in FAMILIES:
        raise ValueError(f"{where}: family '{entry['family']}' is not one of {', '.join(FAMILIES)}")
    if unknown := set(entry.get("status", ())) - set(STATUS_BITS):
        raise ValueError(f"{where}: status: unknown bit {sorted(unknown)[0]}")
    cores = []
    for index, one in enumerate(entry["sets"]):
        if extra := set(one) - {"id", "params", "latency", "ii"}:
            raise ValueError(f"{where}: sets: unknown key {sorted(extra)[0]}")
        params = one["params"]
        status = entry.get("status")
        outputs = [_port("out", key, spec, params, where) for key, spec in entry["out"].items()]
        if status is not None:
            outputs.append(Port("out_status", 4, False))
        cores.append(Core(
            name=name, family=entry["family"], function=entry["function"],
            architecture=entry["architecture"], set_id=one["id"], params=params,
            latency=one["latency"], ii=one["ii"],
            sources=sources_of(name),
            cfg=tuple(_port("cfg", key, spec, params, where) for key, spec in entry.get("cfg", {}).items()),
            inputs=tuple(_port("in", key, spec, params, where) for key, spec in entry["in"].items()),
            outputs=tuple(outputs), status=None if status is None else tuple(status),
            model_name=entry["model"], first_set=index == 0,
            illegal=tuple(entry.get("illegal", ()))))
    return cores


@cache
def _modules() -> dict[str, Path]:
    """Every Verilog file of the house by the name of its module."""
    return {path.stem: path for path in sorted(RTL.rglob("*.v"))}


@cache
def _instances(name: str) -> tuple[str, ...]:
    """Modules of the house that module `name` instantiates, in the order of the text."""
    text = re.sub(r"//[^\n]*|/\*.*?\*/", "", _modules()[name].read_text(), flags=re.S)
    found = re.findall(r"^\s*(\w+)\s+(?:#\s*\(|\w+\s*\()", text, re.M)
    return tuple(dict.fromkeys(module for module in found if module in _modules() and module != name))


@cache
def sources_of(top: str) -> tuple[Path, ...]:
    """The Verilog files of core `top`: its own first, then those of all instances below it."""
    if top not in _modules():
        raise ValueError(f"cores.toml: {top}: there is no {top}.v below rtl/")
    names = [top]
    for name in names:
        names += [module for module in _instances(name) if module not in names]
    return tuple(_modules()[name] for name in names)


@cache
def all_cores() -> tuple[Core, ...]:
    """Every core at every parameter set, in the order of `rtl/cores.toml`."""
    with open(RTL / "cores.toml", "rb") as file:
        entries = tomllib.load(file)
    return tuple(core for name, entry in entries.items() for core in _expand(name, entry))


def find(name: str) -> Core:
    """The core of that name (its first parameter set) or of that ``name-set`` id."""
    for core in all_cores():
        if name == core.id or (name == core.name and core.first_set):
            return core
    names = ", ".join(dict.fromkeys(core.name for core in all_cores()))
    raise KeyError(f"no core '{name}' in rtl/cores.toml; there are {names}")
