"""What there is: cores at listed or other parameters, their formats, files and measured figures."""

from __future__ import annotations

import difflib
import json
import re
from collections.abc import Iterable
from functools import cache
from pathlib import Path

from quadrance import cores, six
from quadrance.cli.around import WRISTED
from quadrance.cores import STATUS_BITS, Core, Port
from quadrance.rules import rule_of

WORDS = {"spread": "turn-spread", "angle": "binary angle", "vector": "unit vector", "half_tangent": "half-tangent"}


class Refused(ValueError):
    """What was asked for cannot be answered: one line that names the thing, the reason and what exists instead."""


def timing(core: Core) -> str:
    """Latency and interval in words; where they vary, `ii` is a round number of the clocks that a sample takes."""
    if not core.clocked:
        return "combinational"
    if core.latency is None:
        return f"one sample at a time, some {core.ii} clocks each: it depends on the sample"
    return f"latency {core.latency}, a sample every {core.ii} clocks"


def choose(what: str, name: str, known: Iterable[str]) -> str:
    """`name`, where it is one of `known`; else Refused, with the nearest names or all of them."""
    known = list(dict.fromkeys(known))
    if name in known:
        return name
    near = difflib.get_close_matches(name, known, 4, 0.55)
    near = near or [one for one in known if len(name) > 2 and name in one][:4]
    raise Refused(f"no {what} '{name}'; " + (f"did you mean {', '.join(near)}?" if near else
                                             f"there are {', '.join(known)}" if known else "there is none"))


def successor(name: str) -> Core | None:
    """The core that has a MODE for what was a module of its own, such as classic_ik2 for classic_ik2_iter."""
    base, _, mode = name.partition("-")[0].rpartition("_")
    return next((core for core in cores.all_cores() if core.name == base and core.architecture == mode), None)


def title(core: Core) -> str:
    """Its name, with that of its mode where it has a MODE, and with its PIPE where that is not 0."""
    pipe = f"-PIPE{core.params['PIPE']}" if core.params.get("PIPE") else ""
    return f"{core.name}-{core.architecture}" if "MODE" in core.params else f"{core.name}{pipe}"


def find(name: str, params: dict[str, int] | None = None) -> Core:
    """The core of that name, `title` or ``name-set`` id, at other parameters where `params` names some.

    Raises
    ------
    Refused
        For a name that is not listed, a parameter that the core has not, values that its Verilog refuses.
    """
    listed = cores.all_cores()
    ids = {name: core for core in reversed(listed) for name in (core.id, title(core), core.name)}
    if name not in ids and name.partition("-")[0] in ids:  # the core is known, the set is not
        name = choose(f"parameter set of {name.partition('-')[0]}", name,
                      (core.id for core in listed if core.name == name.partition("-")[0]))
    if name not in ids and (now := successor(name)):
        raise Refused(f"{name} is now {now.name} with MODE = {now.params['MODE']}: {now.id}")
    core = ids[choose("core", name, (core.name for core in listed) if "-" not in name else ids)]
    return at(core, params) if params else core


def at(core: Core, params: dict[str, int]) -> Core:
    """`core` with some parameters changed; a listed set where they are one's."""
    for key in params:
        choose(f"parameter of {core.name}", key, core.params)
    values = core.params | params
    for one in cores.all_cores():
        if one.name == core.name and one.params == values:
            return one
    if (rule := rule_of(core)).broken(values):
        raise Refused(f"{core.name}: {', '.join(f'{k}={v}' for k, v in values.items())} is not supported: "
                      f"it needs {rule.needs}")
    return cores.at(core, values)


# Figures


@cache
def report() -> dict:
    """The committed report, empty where it is not at hand."""
    for folder in (cores.ROOT / "reports", cores.PACKAGE / "reports"):
        if cores.RTL.parent in (folder.parent, cores.ROOT) and (path := folder / "report.json").is_file():
            try:
                return json.loads(path.read_text())
            except json.JSONDecodeError:
                return {}
    return {}


def figures(core: Core) -> dict | None:
    """Measured figures of a core: area by device, clock and latency on ECP5, errors; None where there is no row.

    ``up5k``, area and clock on an iCE40 UP5K, is there for the cores of the README's headline; its ``mhz`` is None
    where the core does not fit.
    """
    for row in report().get("cores", ()):
        if (row["core"], row["params"]) == (core.name, core.params):
            area = row["area"]
            ecp5 = dict(zip(("lut", "ff", "mult18x18", "ebr", "lutram"),
                            (area["ecp5"][key] for key in ("lut", "ff", "dsp", "mem", "lutram"))))
            alm = {"alut": area["cyclonev"]["lut"], "ff": area["cyclonev"]["ff"], "dsp": area["cyclonev"]["dsp"],
                   "m10k": area["cyclonev"]["mem"], "alut_no_dsp": area["cyclonev_nodsp"]["lut"]}
            small = report().get("up5k", {}).get("rows", {}).get(core.id)
            up5k = {"up5k": dict(zip(("lc", "ff", "mac16", "ram4k", "mhz"),
                                     (small[key] for key in ("lut", "ff", "dsp", "mem", "mhz"))))} if small else {}
            return up5k | {"ecp5": ecp5 | {"mhz": row["fmax_mhz"]["ecp5"], "ns": row["latency_ns"]}, "cyclonev": alm,
                    "ice40": {"lc": area["ice40"]["lut"], "ff": area["ice40"]["ff"], "ram4k": area["ice40"]["mem"]},
                    "error_mm": row["total_mm"],
                    "error_lsb": (row["total_lsb"] if row["total_lsb"] is not None else
                                  (row["error_lsb"] or {}).get("max")), "arm": report()["arm"]}
    return None


def functions(name: str) -> list[str]:
    """The functions that a user means by a name: of real arms too, of six axes all branches and other joint words."""
    known = [core.function for core in cores.all_cores()]
    choose("function", name, known)
    return [one for one in dict.fromkeys(known) if re.fullmatch(f"(arm_)?{name}(_all|_of_angles|_to_angles)?", one)]


def kinds(ports: Iterable[Port]) -> list[str]:
    """Types of joint word among `ports`."""
    return list(dict.fromkeys(port.type for port in ports if port.type))


def row(core: Core) -> dict:
    """A line of the table of cores, as `quadrance cores --json` prints it."""
    return {"core": core.name, "title": title(core), "set": core.set_id, "id": core.id, "family": core.family,
            "function": core.function, "architecture": core.architecture,
            "word": kinds([*core.inputs, *core.outputs]), "params": core.params, "latency": core.latency,
            "ii": core.ii, "figures": figures(core)}


def rows(family: str | None = None, function: str | None = None, word: str | None = None,
         every: bool = False) -> list[dict]:
    """Lines of the table of cores: those of a family, function and joint word; first sets, or every set."""
    listed = cores.all_cores()
    if family is not None:
        choose("family", family, (core.family for core in listed))
    wanted = [core.function for core in listed] if function is None else functions(function)
    if word is not None:
        choose("joint word", word, cores.TYPES)
    found = [row(core) for core in listed
             if (every or core.first_set) and family in (None, core.family) and core.function in wanted
             and (word is None or word in kinds([*core.inputs, *core.outputs]))]
    if not found:
        raise Refused("no core has this family, function and joint word together; leave one of them out")
    return found


# Formats


def format_of(core: Core, port: Port) -> str:
    """What a port's word means, in the words of the pages."""
    if port.name == "out_status":
        return "bits: " + ", ".join(f"{STATUS_BITS[name]} {name.replace('_', ' ')}" for name in core.status or ())
    sign = "signed" if port.signed else "unsigned"
    if port.type == "angle":
        return f"binary angle: a full turn is 2^{port.width}"
    if port.type == "vector":
        what = "cosine" if "_c" in port.name else "sine"
        return f"{what}, signed, {port.width - 2} fraction bits"
    if port.type:
        return f"{WORDS[port.type]}, 2 + {port.width - 2} bits"
    if port.name == "in_phi":
        return f"binary angle of the last link: a full turn is 2^{port.width}"
    if port.name == "in_elbow":
        return "0: theta2 >= 0, 1: theta2 <= 0"
    if (scale := scale_of(core, port)) is not None:
        fraction, unit = scale
        more = {"units": "coordinate units", "rad": "radians", "1": f"1.0 is 2^{fraction}"}[unit]
        return f"{sign} Q{port.width - fraction - port.signed}.{fraction}, {more}"
    return f"{sign} integer" if not port.name.startswith("cfg_") else f"{sign}, from `quadrance instance`"


def scale_of(core: Core, port: Port) -> tuple[int, str] | None:
    """Fraction bits and unit of a word that is no joint: "units" (a coordinate or length), "rad" (a rate), "1" (an
    element of a matrix); None for any other word."""
    side, _, plain = port.name.partition("_")
    p = core.params
    if core.family in (*WRISTED, "keep") and side == "cfg" and plain in ("margin", "slack"):
        return p["F"], "units"
    if core.family == "keep" and side == "cfg":
        return None
    if core.family in ("ur", "srs") and side == "cfg" and re.fullmatch(r"[dl]\d?", plain):
        return p["F"] + six.MORE, "units"
    if "F" in p and re.fullmatch(r"[xyz][45]?|l[123]?|d[45]", plain):
        return p["F"], "units"
    if core.family == "six" and side == "cfg" and re.fullmatch(r"[abc]\d?|k", plain):
        return p["F"] + six.MORE, "units"
    if core.family == "six" and (plain in ("vx", "vy", "vz", "d1", "d3") or side == "cfg" and plain in (
            "radius", "elbow")):
        return p["F"], "units"
    if core.family == "arm" and side == "cfg" and plain in ("base", "shoulder", "lateral", "elbow", "radius"):
        return p["F"], "units"
    if "V" in p and re.fullmatch(r"w[\dxyz]", plain):
        return p["V"], "rad"
    if "U" in p and re.fullmatch(r"r\d\d|[cn]s", plain):
        return p["U"], "1"
    return None


def header(core: Core) -> list[str]:
    """The comment at the head of the core's own file, without the licence line."""
    lines = []
    for line in core.sources[0].read_text().splitlines()[1:]:
        if not line.startswith("//"):
            break
        lines.append(line[2:].strip())
    return lines


def compile_order(core: Core) -> list[Path]:
    """The files of a core, each after those of the modules that it instantiates; the top is the last."""
    found: list[Path] = []

    def add(path: Path) -> None:
        if path in found:
            return
        for below in cores.sources_of(path.stem)[1:]:
            if path not in cores.sources_of(below.stem):
                add(below)
        found.append(path)

    add(core.sources[0])
    return found


def describe(core: Core) -> dict:
    """All of one core, as `quadrance show --json` prints it."""
    ports = [{"name": port.name, "direction": "output" if port.name.startswith("out_") else "input",
              "width": port.width, "signed": port.signed, "type": port.type, "format": format_of(core, port)}
             for port in (*core.cfg, *core.inputs, *core.outputs)]
    return row(core) | {"header": header(core), "ports": ports, "clocked": core.clocked,
                        "status": {name: STATUS_BITS[name] for name in core.status or ()},
                        "sets": {one.set_id: one.params for one in cores.all_cores() if one.name == core.name},
                        "files": [str(path) for path in compile_order(core)]}
