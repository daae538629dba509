"""This module reads ``rtl/cores.toml``, the list of functions, their cores, ports, parameter sets and latencies."""

from __future__ import annotations

import ast
import importlib
import operator
import re
import tomllib
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent
ROOT = PACKAGE.parent.parent
RTL = ROOT / "rtl" if (ROOT / "rtl" / "cores.toml").exists() else PACKAGE / "rtl"  # a checkout, or as pip installs it
STATUS_BITS = {"unreachable": 0, "singular": 1, "overflow": 2, "not_converged": 3, "no_rotation": 3}
FAMILIES = ("arith", "codec", "cordic", "vector", "table", "rational", "classic", "paper", "engine", "arm", "six",
            "program", "ur", "srs", "keep", "tool")
# Joint words by type: the letters of their ports, bits of a word beside those of its parameter, two's complement or not
TYPES = {"spread": ("j", 2, False), "angle": ("j", 0, False), "vector": ("cn", 2, True),
         "half_tangent": ("j", 2, False)}
PORTS = ("cfg", "in", "out")
FUNCTION_KEYS = {"model", *PORTS, "status"}
VARIES = "varies"  # the latency of a core that stops when it is done
CORE_KEYS = {"architecture", "latency", "ii", "illegal", "sets", "checks"}
MODES = {"iter": 0, "pipe": 1, "comb": 1}  # architectures of one module: the value of its parameter MODE


@dataclass(frozen=True)
class Port:
    """One data port: its Verilog name, width in bits, whether it is two's complement, and the type of a joint word.

    type : "spread" (turn-spread), "angle" (binary angle), "vector" (cosine or sine of a unit vector), "half_tangent",
    or None for a plain word; `quadrance.codecs` reads them.
    """

    name: str
    width: int
    signed: bool
    type: str | None = None

    @property
    def low(self) -> int:
        """Smallest value the port can carry."""
        return -(1 << self.width - 1) if self.signed else 0

    @property
    def high(self) -> int:
        """Largest value the port can carry."""
        return (1 << self.width - self.signed) - 1


Joint = tuple[Port, ...]  # the ports of one joint word: one, or the cosine's and the sine's of a vector


@dataclass(frozen=True)
class Core:
    """One core at one parameter set, as `rtl/cores.toml` declares it."""

    name: str
    family: str
    function: str
    architecture: str
    set_id: str
    params: dict[str, int]
    latency: int | None  # None: it varies from sample to sample
    ii: int | None
    sources: tuple[Path, ...]
    cfg: tuple[Port, ...]
    inputs: tuple[Port, ...]
    outputs: tuple[Port, ...]
    status: tuple[str, ...] | None
    model_name: str
    first_set: bool
    illegal: tuple[dict[str, int], ...] = ()
    reported: bool = True  # False: simulated and linted, but not synthesised for the report

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


# Formulas

_BINARY = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.FloorDiv: operator.floordiv}
_COMPARE = {ast.Lt: operator.lt, ast.LtE: operator.le, ast.Gt: operator.gt, ast.GtE: operator.ge, ast.Eq: operator.eq,
            ast.NotEq: operator.ne}
_CALLS = {"max": max, "min": min}


def formula(text: str | int, params: dict[str, int], where: str) -> int:
    """Value of an integer formula in the parameters.

    Parameters
    ----------
    text : str or int
        ``+ - * //``, one comparison (0 or 1), ``max()``, ``min()``, parentheses, integers and names of `params`.
    params : dict
        Values of the names.
    where : str
        What an error names: the file, the core and the key.

    Raises
    ------
    ValueError
        Naming `where`, the formula and what is wrong with it.
    """
    def fail(reason: str):
        raise ValueError(f"{where}: '{text}' {reason}")

    def value(node: ast.expr) -> int:
        match node:
            case ast.Constant(value=int(number)) if not isinstance(number, bool):
                return number
            case ast.Name(id=name):
                return params[name] if name in params else fail(f"names {name}; parameters are {', '.join(params)}")
            case ast.UnaryOp(op=ast.USub(), operand=one):
                return -value(one)
            case ast.BinOp(left=left, op=op, right=right) if type(op) in _BINARY:
                left, right = value(left), value(right)
                if isinstance(op, ast.FloorDiv) and right == 0:
                    fail(f"divides by 0 at {params}")
                return _BINARY[type(op)](left, right)
            case ast.Compare(left=left, ops=[op], comparators=[right]) if type(op) in _COMPARE:
                return int(_COMPARE[type(op)](value(left), value(right)))
            case ast.Call(func=ast.Name(id=name), args=[_, *_] as args, keywords=[]) if name in _CALLS:
                return _CALLS[name]([value(one) for one in args])
        return fail("is not a formula of + - * // < <= > >= == != max min in the parameters")

    if isinstance(text, bool) or not isinstance(text, int | str):
        fail("is neither an integer nor a formula")
    try:
        return value(ast.parse(str(text).strip(), mode="eval").body)
    except SyntaxError:
        return fail("is not a formula of + - * // < <= > >= == != max min in the parameters")


# Entries


def _ports(kind: str, name: str, spec: str, params: dict[str, int], where: str) -> Joint:
    """The ports that `spec` describes: ``sW`` or ``u2*W+2`` (plain), ``spread S``, ``angle A``, ``vector U``,
    ``half_tangent T`` (joints).

    A vector takes two ports, a letter each in place of the j of its name: c1 and n1 for j1.
    """
    where = f"{where}: {kind}.{name}"
    plain, joint = re.fullmatch(r"([us])(\S.*)", spec), re.fullmatch(r"(\w+) +(\S.*)", spec)
    names = [name]
    if joint and joint[1] in TYPES:
        letters, more, signed = TYPES[joint[1]]
        width, of = formula(joint[2], params, where) + more, joint[1]
        if len(letters) > 1:
            if name[0] != "j":
                raise ValueError(f"{where}: the name of a joint of two ports begins with j")
            names = [letter + name[1:] for letter in letters]
    elif plain:
        width, signed, of = formula(plain[2], params, where), plain[1] == "s", None
    else:
        raise ValueError(f"{where}: '{spec}' is neither u or s and a width nor one of {', '.join(TYPES)} and its bits")
    if width < 1:
        raise ValueError(f"{where}: the width of '{spec}' is {width} at {params}")
    return tuple(Port(f"{kind}_{one}", width, signed, of) for one in names)


def joints(ports: tuple[Port, ...]) -> tuple[Joint, ...]:
    """The joints among `ports`, in their order; the ports of one joint are next to each other."""
    words, found = iter([port for port in ports if port.type]), []
    for port in words:
        found.append((port, *(next(words) for _ in TYPES[port.type][0][1:])))
    return tuple(found)


def _check_keys(where: str, entry: dict, known: set[str], wanted: set[str]) -> None:
    if extra := set(entry) - known:
        raise ValueError(f"{where}: unknown key {sorted(extra)[0]}")
    if missing := wanted - set(entry):
        raise ValueError(f"{where}: missing key {sorted(missing)[0]}")


def expand(family: str, function: str, shared: dict, name: str, own: dict,
           sources: tuple[Path, ...] = ()) -> tuple[Core, ...]:
    """One core at each of its parameter sets.

    Parameters
    ----------
    family, function : str
        The tables that contain the core's.
    shared : dict
        What all cores of the function share: keys `FUNCTION_KEYS`.
    name : str
        Of the core's top module.
    own : dict
        The core's own table: keys `CORE_KEYS`.
    sources : tuple of Path
        Its Verilog files; none for a core that needs none (in tests).

    Raises
    ------
    ValueError
        Naming cores.toml, the core and the key.
    """
    where = f"cores.toml: {name}"
    _check_keys(where, shared, FUNCTION_KEYS, {"model", "in", "out"})
    _check_keys(where, own, CORE_KEYS, {"architecture", "latency"})
    sets = own.get("sets", {})
    if not (every := sets | own.get("checks", {})):
        raise ValueError(f"{where}: 'sets' is missing")
    if family not in FAMILIES:
        raise ValueError(f"{where}: family '{family}' is not one of {', '.join(FAMILIES)}")
    status = shared.get("status")
    if unknown := set(status or ()) - set(STATUS_BITS):
        raise ValueError(f"{where}: status: unknown bit {sorted(unknown)[0]}")
    cores = []
    for set_id, params in every.items():
        ports = {kind: tuple(port for key, spec in shared.get(kind, {}).items()
                             for port in _ports(kind, key, spec, params, where)) for kind in PORTS}
        if status is not None:
            ports["out"] += (Port("out_status", 4, False),)
        first = params.get("PIPE", 0) not in [one.params.get("PIPE", 0) for one in cores]
        latency = None if own["latency"] == VARIES else formula(own["latency"], params, f"{where}: latency")
        cores.append(Core(
            name=name, family=family, function=function, architecture=own["architecture"], set_id=set_id, params=params,
            latency=latency, ii=formula(own["ii"], params, f"{where}: ii") if "ii" in own else latency,
            sources=sources, cfg=ports["cfg"], inputs=ports["in"], outputs=ports["out"],
            status=None if status is None else tuple(status), model_name=shared["model"], first_set=first,
            illegal=tuple(own.get("illegal", ())), reported=set_id in sets))
    return tuple(cores)


def listed(text: str) -> list[tuple[str, str, dict, str, dict]]:
    """(family, function, shared, name, own) of every core in the text of a list, as `expand` takes them."""
    found = []
    for family, functions in tomllib.loads(text).items():
        for function, entry in functions.items():
            if not isinstance(entry, dict):
                raise ValueError(f"cores.toml: {family}.{function} is not a table of a function")
            cores = {key: value for key, value in entry.items() if key not in FUNCTION_KEYS and isinstance(value, dict)}
            shared = {key: value for key, value in entry.items() if key not in cores}
            if not cores:
                raise ValueError(f"cores.toml: {family}.{function} has no core")
            found += [(family, function, shared, name, one) for name, own in cores.items()
                      for one in _by_mode(name, own)]
    return found


def _by_mode(name: str, own: dict) -> list[dict]:
    """The table of a core for each of its modes, each with the keys of a core without modes; the ids name the mode."""
    modes = {key: value for key, value in own.items() if key in MODES and isinstance(value, dict)}
    if not modes:
        return [own]
    _check_keys(f"cores.toml: {name}", own, {*modes, "illegal"}, set())

    def sets(mode: str, table: dict) -> dict:
        return {f"{mode}-{key}": {"MODE": MODES[mode], **params} for key, params in table.items()}

    return [{**value, "architecture": mode, "illegal": [*own.get("illegal", []), *value.get("illegal", [])],
             **{key: sets(mode, value[key]) for key in ("sets", "checks") if key in value}}
            for mode, value in modes.items()]


@cache
def _modules() -> dict[str, Path]:
    """Every Verilog file by the name of its module."""
    return {path.stem: path for path in sorted(RTL.rglob("*.v"))}


def module(name: str) -> Path:
    """The Verilog file of that module."""
    return _modules()[name]


@cache
def _instances(name: str) -> tuple[str, ...]:
    """Modules of rtl/ that module `name` instantiates, in the order of the text."""
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
def _table() -> list[tuple[str, str, dict, str, dict]]:
    """`listed` of rtl/cores.toml."""
    return listed((RTL / "cores.toml").read_text())


@cache
def all_cores() -> tuple[Core, ...]:
    """Every core at every parameter set, in the order of `rtl/cores.toml`."""
    return tuple(core for *entry, name, own in _table() for core in expand(*entry, name, own, sources_of(name)))


def reported() -> tuple[Core, ...]:
    """Those of `all_cores` that the report has a row of."""
    return tuple(core for core in all_cores() if core.reported)


def label(params: dict[str, int]) -> str:
    """The name of a set that cores.toml does not list; without PIPE = 0 and a MULTIPLY that then changes nothing."""
    unnamed = () if params.get("PIPE") else (("PIPE", 0), ("MULTIPLY", 18))
    return "".join(f"{key}{value}" for key, value in params.items() if (key, value) not in unnamed)


def at(core: Core, params: dict[str, int]) -> Core:
    """`core` at another parameter set: every parameter, its MODE included where it has one."""
    *entry, own = next(one for one in _table() if one[3] == core.name and
                       ("MODE" not in params or params["MODE"] == MODES[one[4]["architecture"]]))
    named = own | {"sets": {label(params): params}, "checks": {}}
    return replace(expand(*entry, named, core.sources)[0], first_set=False)


def find(name: str) -> Core:
    """The core of that name (its first parameter set) or of that ``name-set`` id."""
    for core in all_cores():
        if name == core.id or (name == core.name and core.first_set):
            return core
    names = ", ".join(dict.fromkeys(core.name for core in all_cores()))
    raise KeyError(f"no core '{name}' in rtl/cores.toml; there are {names}")
