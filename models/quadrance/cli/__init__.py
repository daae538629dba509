"""The command `quadrance`: which cores there are, how to instantiate one, what a word means, is an arm file right.

Every answer comes from a plain function of a module beside this one; here they are parsed for and printed.
"""

from __future__ import annotations

import argparse
import difflib
import json
import os
import sys
from collections.abc import Sequence
from pathlib import Path

from quadrance import arms
from quadrance.cli import (
    assemble,
    axis,
    c,
    catalogue,
    check,
    choose,
    importing,
    registers,
    tables,
    tip,
    urdf,
    verilog,
    vhdl,
    words,
)
from quadrance.cli.catalogue import Refused
from quadrance.cli.tables import Column
from quadrance.cores import Core
from quadrance.iterative import track


class Parser(argparse.ArgumentParser):
    """A parser whose errors are one line and say what was meant."""

    def error(self, message: str):
        for action in self._actions:
            if isinstance(action, argparse._SubParsersAction) and "invalid choice" in message:
                given = message.split("'")[1]
                near = difflib.get_close_matches(given, action.choices, 1, 0.5)
                message = f"no command '{given}'; " + (f"did you mean {near[0]}?" if near else
                                                       f"there are {', '.join(action.choices)}")
        print(f"{self.prog}: {message}", file=sys.stderr)
        raise SystemExit(2)


def _params(pairs: Sequence[str] | None) -> dict[str, int]:
    found = {}
    for pair in pairs or ():
        key, equals, value = pair.partition("=")
        if not equals or not value.lstrip("-").isdecimal():
            raise Refused(f"-p {pair}: a parameter is NAME=INTEGER, such as -p S=20")
        found[key] = int(value)
    return found


def _json(value: object) -> None:
    print(json.dumps(value, indent=1))


PLANT = """\
A circle of 35 mm at pi/4 rad/s, a target every millisecond; root mean squares over a turn.
Lag: the tip asked for behind the target that its words give. Words: their rounding. Servo: the tip reached behind the
one asked for, by the paper's PID. The paper moves a real Geomagic Touch; here the plant is a model: 45 g at the end of
every link, friction of 0.26 N at the circle's speed, gravity compensated, torque without limit."""

# Commands


def _figure(value: float | None, digits: int = 3) -> str:
    return "–" if value is None else f"{value:.{digits}g}" if abs(value) < 1000 else f"{value:.0f}"


def _cores(args: argparse.Namespace) -> None:
    rows, refused = catalogue.rows(args.family, args.function, args.word, args.all), {}
    if args.arm:
        rows, refused = check.served(rows, check.load(args.arm))
    if args.json:
        return _json({"cores": rows, "refused": refused} if args.arm else rows)
    columns = [Column("core", True), Column("function", True), Column("joint word", True, 5), Column("LUT"),
               Column("MULT18X18", rank=2), Column("EBR", rank=2), Column("cycles"), Column("II", rank=4),
               Column("ns", rank=1), Column("MHz", rank=6), Column("error mm", rank=1), Column("error LSB", rank=7)]
    lines = []
    for row in rows:
        f = row["figures"] or {}
        here = f.get("ecp5", {})
        lines.append((row["id" if args.all else "title"], row["function"],
                      ", ".join(catalogue.WORDS[kind] for kind in row["word"]),
                      *(here.get(key, "–") for key in ("lut", "mult18x18", "ebr")), row["latency"], row["ii"],
                      *(_figure(value) for value in (here.get("ns"), here.get("mhz"), f.get("error_mm"),
                                                     f.get("error_lsb")))))
    out = tables.console()
    out.print(tables.grid(columns, lines, out.width))
    if catalogue.report():
        out.print(f"Area and clock: ECP5 by Yosys and nextpnr; error: worst at the tip on "
                  f"{catalogue.report()['arm']}, rounding of the words included, for other functions in LSB.")
    else:
        out.print("There is no report at hand: no measured figures.")
    for reason, names in refused.items():
        print(f"not {', '.join(dict.fromkeys(names))}: {reason}")


def _accuracy(args: argparse.Namespace) -> None:
    core, arm, _ = _around(args)
    about = tip.measured(core, arm)
    if args.json:
        return _json(about)
    print("\n".join(tip.lines(core, arm, about)))


def _positive(name: str, text: str | None) -> float | None:
    if text is None:
        return None
    if not 0 < (value := _float(text)) < float("inf"):
        raise Refused(f"--{name} {text}: it must be positive and finite")
    return value


def _choose(args: argparse.Namespace) -> None:
    chip = catalogue.choose("chip", args.chip, choose.CHIPS)
    word = words.word(args.word)
    if not word.joint:
        raise Refused(f"--word {args.word}: a joint word is angle, vector or spread and its bits, such as angle:18")
    wish = choose.Wish(args.function, check.load(args.arm), word, chip,
                       *(_positive(name, getattr(args, name)) for name in ("mm", "rate", "clock")))
    fit, out, near = choose.choose(wish)
    entries = [choose.entry(*one, wish) for one in fit]
    if args.json:
        _json({"fit": entries, "not": out, "nearest": choose.entry(*near, wish) if near else None})
    else:
        print("\n".join(choose.lines(entries, out, wish)))
    if near:
        misses = " and ".join(text for _, text in near[1].misses)
        raise Refused(f"nothing fits; {choose.pasted(near[1].core)} is the nearest: {misses}")
    if not fit:
        raise Refused(f"no core of {args.function} with {args.word} serves {wish.arm.id}; each has its reason above")


def _show(args: argparse.Namespace) -> None:
    core = catalogue.find(args.core, _params(args.param))
    about = catalogue.describe(core)
    if args.json:
        return _json(about)
    out = tables.console()
    out.print(f"{core.id}: {core.family}, {core.function}, {core.architecture}")
    for line in about["header"]:
        out.print(f"  {line}")
    out.print(f"parameters  {', '.join(f'{key}={value}' for key, value in core.params.items()) or 'none'}"
              f"  (sets: {', '.join(about['sets'])})")
    out.print(f"timing      {catalogue.timing(core)}")
    if f := about["figures"]:
        out.print("ECP5        {lut} LUT, {ff} FF, {mult18x18} MULT18X18, {ebr} EBR, {lutram} LUTRAM; "
                  "{mhz:.4g} MHz, {ns:.4g} ns".format(**f["ecp5"]))
        out.print("Cyclone V   {alut} ALUT, {ff} FF, {dsp} DSP, {m10k} M10K; {alut_no_dsp} ALUT without DSP".format(
            **f["cyclonev"]))
        out.print("iCE40       {lc} LC, {ff} FF, {ram4k} RAM4K".format(**f["ice40"]))
        if small := f.get("up5k"):
            clock = f"{small['mhz']:.4g} MHz" if small["mhz"] else "it does not fit"
            out.print("iCE40 UP5K  {lc} LC, {ff} FF, {mac16} MAC16, {ram4k} RAM4K; ".format(**small) + clock)
        error = [text.format(**f) for key, text in (("error_lsb", "{error_lsb:.3g} LSB"),
                                                    ("error_mm", "{error_mm:.3g} mm on {arm}")) if f[key] is not None]
        if not error and core.function in tip.pose.FUNCTIONS:
            asked = " ".join([args.core, *(f"-p {param}" for param in args.param or ())])
            out.print(f"worst error of an arm: quadrance accuracy {asked} --arm ARM", soft_wrap=True)
        else:
            out.print(f"worst error {', '.join(error) or 'not measured'}")
    out.print()
    control = [("clk", "input", 1, ""), ("rst", "input", 1, "synchronous, active high; one clock is enough")]
    rows = control if core.clocked else []
    before = {"in": ("in_valid", "in_ready"), "out": ("out_valid", "out_ready")}
    for port in about["ports"]:
        side = port["name"].partition("_")[0]
        for name in before.pop(side, ()) if core.clocked else ():
            rows.append((name, "input" if name in ("in_valid", "out_ready") else "output", 1, "handshake"))
        rows.append((port["name"], port["direction"], port["width"], port["format"]))
    out.print(tables.grid([Column("port", True), Column("direction", True, 1), Column("bits"),
                           Column("format", True)], rows, out.width))
    out.print(f"\nfiles ({len(about['files'])}): quadrance files {core.id}")


def _around(args: argparse.Namespace) -> tuple[Core, arms.Arm | None, dict[str, int]]:
    """The core that the command line names, as the arm wants it, the arm, and the configuration words for it."""
    params = _params(args.param)
    if not args.arm:
        return catalogue.find(args.core, params), None, {}
    listed, arm = catalogue.find(args.core), check.load(args.arm)
    core = verilog.fitted(listed, arm, params)
    return core, arm, verilog.config(core, arm)


def _instance(args: argparse.Namespace) -> None:
    core, arm, cfg = _around(args)
    form = catalogue.choose("format", "json" if args.json else args.format, ("verilog", "vhdl", "c", "json"))
    if form in ("vhdl", "c"):
        return print(vhdl.instance(core, arm, args.name) if form == "vhdl" else c.words(core, arm, args.name), end="\n")
    text = verilog.instance(core, arm, args.name, args.declare)
    if form == "json":
        return _json({"core": core.id, "params": core.params, "arm": arm and arm.id, "cfg": cfg, "verilog": text})
    print(text)


def _files(args: argparse.Namespace) -> None:
    core = catalogue.find(args.core)
    if args.copy:
        return _copy(args.copy, catalogue.compile_order(core))
    paths = verilog.file_list(core, Path(args.relative) if args.relative else None)
    if args.json:
        return _json({"core": core.id, "top": core.name, "files": paths})
    print(verilog.dot_f(core, paths) if args.f else "\n".join(paths))


def _axis(args: argparse.Namespace) -> None:
    core = catalogue.find(args.core)
    text = axis.wrapper(core)
    if args.json:
        return _json({"core": core.name, "top": f"axis_{core.name}", "verilog": text})
    print(text, end="")


def _registers(args: argparse.Namespace) -> None:
    core, arm, cfg = _around(args)
    bus = catalogue.choose("bus", args.bus, registers.BUSSES)
    own = (args.core_clock, not args.no_readback)
    if args.out:
        texts = {f"{core.name}.h": c.header(core, arm), c.SHARED.name: c.SHARED.read_text()}
        return _fill(args.out, registers.files(core, bus, cfg, *own) | texts, "written")
    if args.json:
        return _json(registers.described(core, cfg) | {"verilog": registers.wrapper(core, bus, *own)})
    print(registers.wrapper(core, bus, *own), end="")


def _copy(folder: str, paths: list[Path]) -> None:
    _fill(folder, {path.name: path.read_text() for path in paths}, "copied")


def _fill(folder: str, texts: dict[str, str], done: str) -> None:
    """New files in a folder; where one is there with another text, none is written."""
    target = Path(folder)
    if target.exists() and not target.is_dir():
        raise Refused(f"{target} is a file, not a folder")
    try:
        for name, text in texts.items():
            there = target / name
            if there.exists() and (not there.is_file() or there.read_bytes() != text.encode()):
                raise Refused(f"{there} exists and is another file; nothing was {done}")
        target.mkdir(parents=True, exist_ok=True)
        for name, text in texts.items():
            (target / name).write_text(text, encoding="utf-8")
    except OSError as error:
        raise Refused(f"{target} cannot be written: {error.strerror}") from None
    print(f"{len(texts)} file{'s' * (len(texts) != 1)} {done} to {target}")


def _counts(text: str | None) -> int | None:
    if text is None:
        return None
    if (value := words.number(text)) < 1:
        raise Refused(f"--counts {text}: a turn has at least one count")
    return value


def _scale(args: argparse.Namespace) -> float | None:
    if args.arm and args.mm_per_unit is not None:
        raise Refused("--arm and --mm-per-unit say the same thing: give one of them")
    if args.mm_per_unit is not None and not args.mm_per_unit > 0:
        raise Refused(f"--mm-per-unit {args.mm_per_unit:g}: it must be positive")
    return check.load(args.arm).mm_per_unit if args.arm else args.mm_per_unit


def _say(found: dict, means: dict[str, float]) -> str:
    unit = {"degrees": "{:.6f} degrees", "count": "count {:d}", "units": "{:.6f} units", "mm": "{:.4f} mm",
            "rad": "{:.6f} rad", "number": "{:.6f}"}
    named = len(found["words"]) > 1
    return "  ".join([*(f"{one['port']} = " * named + f"{one['value']} ({one['hex']})" for one in found["words"]), "=",
                      ", ".join(unit[key].format(value) for key, value in means.items())])


def _encode(args: argparse.Namespace) -> None:
    one, counts, scale = words.word(args.word, _params(args.param)), _counts(args.counts), _scale(args)
    found = [words.encode(one, _float(value), counts, scale) for value in args.value]
    if args.json:
        return _json(found)
    for entry in found:
        print(f"{entry['given']:g} -> " + _say(entry, {key: value for key, value in entry.items()
                                                      if key not in ("given", "words")}))


def _decode(args: argparse.Namespace) -> None:
    one, counts, scale = words.word(args.word, _params(args.param)), _counts(args.counts), _scale(args)
    found = [words.decode(one, tuple(words.number(part) for part in value.split(",")), counts, scale, args.signed)
             for value in args.value]
    if args.json:
        return _json([{"words": entry["words"], **entry["means"]} for entry in found])
    for entry in found:
        print(_say(entry, entry["means"]))


def _float(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise Refused(f"'{text}' is no number") from None


def _check(args: argparse.Namespace) -> None:
    about = check.check(check.load(args.arm))
    if args.json:
        return _json(about)
    low, high = about["reach_mm"]
    names = ("shoulder", "elbow", "yaw", "upper")
    room = [f"{key} {a:g} to {b:g}" for key, (a, b) in zip(names, about["limits_degrees"])]
    takes = ", ".join(f"{axis} to {units:.4g}" for axis, units in about["units"].items() if axis in ("x and y", "z"))
    print(f"{about['name']}: right\n"
          f"  links    {about['l1_mm']:g} and {about['l2_mm']:g} mm, reach {low:g} to {high:g} mm\n"
          f"  joints   {about['axes']}; {', '.join(room)} degrees\n"
          f"  scale    {about['mm_per_unit']:g} mm a unit: {takes} of {about['units']['largest']:g} units, "
          f"one LSB of Q7.8 is {about['lsb_mm'] * 1000:.4g} um\n"
          "  cores    " + (f"{', '.join(about['functions'])}: quadrance cores --function {about['functions'][0]}"
                           if about["functions"] else "none serves it"))
    for reason, names in about["refused"].items():
        print(f"  not      {', '.join(names)}: {reason}")
    for line in about["frames"]:
        print(f"  frame    {line}")
    for line in about["advice"]:
        print(f"  advice   {line}")


def _arms(args: argparse.Namespace) -> None:
    found = [check.check(arms.load(name)) for name in arms.known()]
    if args.json:
        return _json(found)
    out = tables.console()
    out.print(tables.grid([Column("arm", True), Column("name", True, 3), Column("axes"), Column("l1 mm"),
                           Column("l2 mm"), Column("mm a unit", rank=1), Column("LSB um", rank=2)],
                          [(one["arm"], one["name"], one["axes"], f"{one['l1_mm']:g}", f"{one['l2_mm']:.5g}",
                            f"{one['mm_per_unit']:g}", f"{one['lsb_mm'] * 1000:.4g}") for one in found], out.width))


def _import(args: argparse.Namespace) -> None:
    if bool(args.urdf) == bool(args.dh):
        raise Refused("import takes one robot: a URDF, or a table with --dh")
    if args.dh and (args.base or args.tip or args.packages):
        raise Refused("--base, --tip and --packages belong to a URDF, and a table is a chain")
    if args.out and Path(args.out).suffix != ".toml":
        raise Refused(f"--out {args.out}: the name of an arm file ends in .toml")
    path = Path(args.urdf or args.dh)
    try:
        chain = urdf.read_dh(path) if args.dh else urdf.read_urdf(path, args.base, args.tip, args.packages)
        found = importing.arm_file(chain, f"{path.name}, {chain.base} to {chain.tip}")
    except arms.ArmError as error:
        raise Refused(str(error)) from None
    if args.out:
        _write(Path(args.out), found["text"])
    if args.json:
        return _json(found)
    print(f"{args.out}: {found['kind']}; now: quadrance check {args.out}\n" if args.out else found["text"], end="")


def _write(path: Path, text: str) -> None:
    """A new file; one that is there stays as it is."""
    try:
        with path.open("x", encoding="utf-8") as file:
            file.write(text)
    except FileExistsError:
        raise Refused(f"{path} exists and is not overwritten") from None
    except OSError as error:
        raise Refused(f"{path} cannot be written: {error.strerror}") from None


def _track(args: argparse.Namespace) -> None:
    known = track.followers()
    chosen = [known[catalogue.choose("solver", name, known)] for name in args.solver or known]
    counts = [words.number(text) for text in args.iterations] if args.iterations else track.COUNTS
    if not all(1 <= count <= track.MOST for count in counts):
        raise Refused(f"--iterations: a sample has 1 to {track.MOST}")
    rows = [row for one in chosen for row in track.summary(one, counts)]
    if args.json:
        return _json(rows)
    columns = [Column("solver", True), Column("iterations"), Column("lag um"), Column("golden um"),
               Column("words um", rank=3), Column("servo um", rank=2), Column("tip um", rank=1),
               Column("clocks", rank=4), Column("us at 50 MHz", rank=5)]
    lines = [(row["solver"], row["iterations"], *(_figure(row[key]) for key in (
        "lag_um", "golden_um", "words_um", "servo_um", "tip_um", "clocks")),
              _figure(row["clocks"] and row["clocks"] / 50)) for row in rows]
    out = tables.console()
    out.print(tables.grid(columns, lines, out.width))
    out.print(PLANT)


def _assemble(args: argparse.Namespace) -> None:
    path = Path(args.program)
    if args.poses == 2:
        if args.image or args.json:
            raise Refused("--poses 2 makes a table, no --image and no --json")
        return print(assemble.two_poses(path, args.pipe, args.seconds, args.write), end="")
    one, about = assemble.assemble(path, args.pipe, args.seconds, args.write)
    written = assemble.write(one, args.seconds) if args.write else []
    if args.image:
        about["image"] = assemble.image(one, Path(args.image), args.start, args.release)
        written.append(Path(args.image))
    if args.json:
        return _json(about)
    print(about["verilog"])
    out = tables.console()
    rows = [(name, f"{low:.3f}", f"{high:.3f}", "argued" * (name in about["argued"]))
            for name, (low, high) in about["ranges"].items()]
    out.print(tables.grid([Column("word", True), Column("from"), Column("to"), Column("", True)], rows, out.width))
    print(f"\n{about['program']}: {about['lines']} lines, {about['idle']} of them idle; {about['clocks']} clocks; "
          f"{about['registers']} registers; every word within its range")
    print("".join(f"written: {path}\n" for path in written), end="")


def parser() -> Parser:
    """The command line."""
    top = Parser(prog="quadrance", description="Cores for the kinematics of robot arms, in Verilog.")
    commands = top.add_subparsers(dest="command", metavar="COMMAND", required=True)

    def command(name: str, does, text: str) -> argparse.ArgumentParser:
        sub = commands.add_parser(name, help=text, description=text)
        sub.add_argument("--json", action="store_true", help="print JSON")
        sub.set_defaults(does=does)
        return sub

    sub = command("cores", _cores, "the cores there are, with area, latency and error")
    sub.add_argument("--family", help="vector, table, rational, classic ...")
    sub.add_argument("--function", help="fk1 to ik3, fk6, ik6, isqrt ...")
    sub.add_argument("--word", help="angle, spread, vector, half_tangent")
    sub.add_argument("--arm", help="name of an arm, or its TOML file: the cores that it can use")
    sub.add_argument("--all", action="store_true", help="every parameter set, not the first of each core alone")
    sub = command("choose", _choose, "the cores that serve an arm as asked, the best first, and why not the others")
    sub.add_argument("--function", required=True, help="fk1 to ik3, fk6, ik6, ur_ik, srs_ik")
    sub.add_argument("--arm", required=True, help="name of an arm, or its TOML file")
    sub.add_argument("--word", required=True, help="the joint word: angle:18, vector:16, spread:24")
    sub.add_argument("--mm", help="greatest error at the tip, rounding of all words included")
    sub.add_argument("--rate", help="results a second")
    sub.add_argument("--clock", help="MHz of the system that the core runs in")
    sub.add_argument("--chip", default="ecp5", help="ecp5, cyclonev or ice40")

    def core(sub: argparse.ArgumentParser, param: bool = True) -> argparse.ArgumentParser:
        sub.add_argument("core", metavar="CORE", help="name, or name-set")
        return _param(sub) if param else sub

    def _param(sub: argparse.ArgumentParser) -> argparse.ArgumentParser:
        sub.add_argument("-p", "--param", action="append", metavar="NAME=VALUE", help="another value of a parameter")
        return sub

    sub = core(command("accuracy", _accuracy, "errors of a core at the tip of an arm, by its bit-true model"))
    sub.add_argument("--arm", required=True, help="name of an arm, or its TOML file")
    core(command("show", _show, "ports, formats, latency, status and files of a core"))
    sub = core(command("instance", _instance, "a Verilog instance with every parameter and configuration word"))
    sub.add_argument("--arm", help="name of an arm, or its TOML file: computes cfg_*")
    sub.add_argument("--name", help="of the instance")
    sub.add_argument("--declare", action="store_true", help="declare the wires too")
    sub.add_argument("--format", default="verilog", metavar="FORMAT", help="verilog, vhdl, c (the words) or json")
    sub = core(command("files", _files, "the Verilog files of a core in compile order"), param=False)
    sub.add_argument("-f", action="store_true", help="as a command file (-f) of a simulator")
    sub.add_argument("--relative", metavar="DIR", help="paths seen from a folder")
    sub.add_argument("--copy", metavar="DIR", help="copy the files there")
    core(command("axis", _axis, "the Verilog of an AXI-Stream wrapper around a core"), param=False)
    sub = core(command("registers", _registers, "a core behind registers on a bus: Verilog, its map, C and SystemRDL"))
    sub.add_argument("--bus", default="axil", metavar="BUS", help="axil (AXI4-Lite) or wishbone")
    sub.add_argument("--arm", help="name of an arm, or its TOML file: its configuration words go with the map")
    sub.add_argument("--core-clock", action="store_true", help="the core has a clock of its own, core_clk")
    sub.add_argument("--no-readback", action="store_true", help="what is written cannot be read: a third of the logic")
    sub.add_argument("--out", metavar="DIR", help="write all files of a design there; overwrites nothing")
    for name, does, text, value in (
            ("encode", _encode, "degrees, encoder counts or millimetres into words", "degrees, counts, mm or units"),
            ("decode", _decode, "words into degrees, encoder counts or millimetres", "a word; of a vector C,N")):
        sub = _param(command(name, does, text))
        sub.add_argument("word", metavar="WORD", help=words.HELP)
        sub.add_argument("value", metavar="VALUE", nargs="+", help=value)
        sub.add_argument("--counts", help="counts of an encoder in a full turn of the joint")
        sub.add_argument("--arm", help="whose mm_per_unit scales coordinates")
        sub.add_argument("--mm-per-unit", type=float, help="millimetres in a coordinate unit")
        if name == "decode":
            sub.add_argument("--signed", action="store_true", help="joints from -180 to 180 degrees, counts likewise")
    sub = command("track", _track, "a circle at 1 kHz through the iterative solvers and a servo: what lags by how much")
    sub.add_argument("solver", metavar="SOLVER", nargs="*", help="touch and planar (float64), or an engine; all")
    sub.add_argument("--iterations", metavar="N", nargs="+", help="iterations a sample: 1 2 5 30")
    sub = command("import", _import, "the arm file of a URDF or of a table of Denavit and Hartenberg")
    sub.add_argument("urdf", metavar="ROBOT", nargs="?", help="URDF; a xacro file too, where xacro is installed")
    sub.add_argument("--base", metavar="LINK", help="where the arm begins; the root")
    sub.add_argument("--tip", metavar="LINK", help="where it ends; the only end")
    sub.add_argument("--dh", metavar="FILE", help="a TOML file: convention, and a [[joint]] a row")
    sub.add_argument("--packages", metavar="DIR", help="xacro may read below it; $(find NAME) is its folder NAME")
    sub.add_argument("--out", metavar="FILE", help="write a new file in place of printing it")
    command("check", _check, "is this arm file right, and which scale").add_argument("arm", metavar="ARM")
    sub = command("assemble", _assemble, "a program of equations as a table of the product engine, with its ranges")
    sub.add_argument("program", metavar="FILE.kin")
    sub.add_argument("--pipe", type=int, default=0, choices=range(3), help="registers after the engine's products")
    sub.add_argument("--poses", type=int, default=1, choices=(1, 2), help="2: a run ends one and begins the next")
    sub.add_argument("--seconds", type=float, default=60, help="time to look for the shortest order (default 60)")
    sub.add_argument("--write", action="store_true", help="write the order into FILE, and FILE_program.v")
    sub.add_argument("--image", metavar="FILE", help="write what kinematics_engine loads: C in FILE.h, else JSON")
    sub.add_argument("--start", type=int, default=0, help="address of the image in its memory (default 0)")
    sub.add_argument("--release", type=int, default=0, help="the version that it answers with (default 0)")
    command("arms", _arms, "the arms that come with the library")
    return top


def main(arguments: Sequence[str] | None = None) -> int:
    """Do what the command line says; 2 with one line on stderr where that cannot be done."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    if given[:1] in (["encode"], ["decode"]) and "--" not in given:  # a negative value is no option
        given = [given[0], *_negatives_last(given[1:])]
    args = parser().parse_args(given)
    try:
        args.does(args)
    except Refused as error:
        print("quadrance:", *str(error).splitlines(), file=sys.stderr)
        return 2
    except BrokenPipeError:  # `quadrance cores | head`
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return 0


def _negatives_last(given: list[str]) -> list[str]:
    """Values that begin with a minus sign and a digit behind ``--``, the options before it."""
    takes = ("-p", "--param", "--counts", "--arm", "--mm-per-unit")
    options, values = [], []
    rest = iter(given)
    for one in rest:
        if one in takes:
            options += [one, *[next(rest, None)]]
        elif one.startswith("-") and not one[1:2].isdigit() and not one.startswith("-."):
            options.append(one)
        else:
            values.append(one)
    return [*(one for one in options if one is not None), "--", *values]
