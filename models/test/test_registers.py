"""`quadrance registers`: what it writes and what it refuses; the driver, on a bus of Python; the C headers."""

import dataclasses
import json
import math
import os
import re
import subprocess

import numpy as np
import pytest
from peakrdl_cheader.exporter import CHeaderExporter
from peakrdl_html import HTMLExporter
from quadrance import arms, codecs, cores, device, fixed, truth_six, truth_ur
from quadrance.arms import ArmError
from quadrance.cli import c, catalogue, main, registers, verilog
from quadrance.cli.catalogue import Refused
from quadrance.program import assembler, image
from quadrance.program.language import Wrong
from systemrdl import RDLCompiler

from models.test import frames


@pytest.fixture
def command(capsys):
    """Run `quadrance registers`; its output, or its one line of refusal where `code` is 2."""
    def run(*arguments, code=0):
        ended = main(["registers", *arguments])
        out, err = capsys.readouterr()
        assert ended == code, err
        if code:
            assert out == "" and err.count("\n") == 1
        return err if code else out
    return run


def test_a_folder_has_everything_and_nothing_is_overwritten(command, tmp_path):
    out = tmp_path / "hw"
    words = ["table_ik2", "--arm", "cobra600", "-p", "A=20", "--core-clock", "--out", str(out)]
    command(*words)
    found = {path.name: path.read_text() for path in out.iterdir()}
    assert {"axil_table_ik2.v", "axil_face.v", "register_control.v", "register_crossing.v", "table_ik2.v",
            "table_ik2.json", "table_ik2.rdl", "axil_table_ik2.xdc", "axil_table_ik2.sdc"} <= found.keys()
    core = catalogue.find("table_ik2", {"A": 20})
    about = json.loads(found["table_ik2.json"])
    assert about["cfg"] == verilog.config(core, arms.load("cobra600"))
    assert f"32'h{about['id']:08x}" in found["axil_table_ik2.v"] and ".A(20)" in found["axil_table_ik2.v"]
    assert f"0x{about['id']:08x}" in found["table_ik2.rdl"]
    command(*words)  # the same again is no loss
    (out / "table_ik2.json").write_text("mine")
    before = {path: path.stat().st_mtime_ns for path in out.iterdir()}
    assert "is another file" in command(*words, code=2)
    assert before == {path: path.stat().st_mtime_ns for path in out.iterdir()}


@pytest.mark.parametrize("arguments, said", [
    (["isqrt_comb"], "isqrt_comb is combinational"), (["table_ik"], "did you mean"),
    (["table_ik2", "--bus", "apb"], "no bus 'apb'; there are axil, wishbone"),
    (["table_ik2", "-p", "A=99"], "it needs"), (["table_ik2", "--arm", "nobody"], "nobody"),
    (["isqrt", "--arm", "cobra600"], "takes no arm"),
    (["table_ik2", "--out", __file__], "is a file, not a folder"),
    (["table_ik2", "--out", "/proc/none/there"], "cannot be written")])
def test_what_cannot_be_made_is_refused_in_a_line(arguments, said, command):
    assert said in command(*arguments, code=2)


def test_constraints_name_registers_that_exist(command, tmp_path):
    command("table_ik2", "--core-clock", "--out", str(tmp_path))
    text = "".join((tmp_path / name).read_text() for name in ("axil_table_ik2.v", "register_crossing.v"))
    for file in ("axil_table_ik2.xdc", "axil_table_ik2.sdc"):
        lists = re.findall(r"(?:get_cells|get_registers) \{(.*?)\}", (tmp_path / file).read_text())
        names = [re.sub(r"(_reg)?\*$", "", re.split(r"[/|]", one)[-1]) for some in lists for one in some.split()]
        assert sorted(names) == ["bus_answer", "bus_clear", "cfg_", "clear", "go", "in_", "out_"]
        for name in names:
            assert re.search(rf"^ .*\breg\b.*\b{name}", text, re.M), name


class Registers:
    """A bus with a device on it that answers by the core's model after two reads of STATE."""

    def __init__(self, core):
        self.core, self.about, self.waits = core, registers.described(core, {}), 0
        self.words = {0x000: self.about["id"], 0x004: 0x10000, 0x00C: 0}

    def read(self, address):
        if address == 0x00C and self.waits:
            self.waits -= 1
            return 1
        return self.words[address]

    def write(self, address, word):
        assert 0 <= word < 1 << 32
        self.words[address] = word
        if address == 0x008:
            ports = {}
            for one in self.about["words"]:
                if one["kind"] != "out":
                    bits = self.words[one["address"]] & (1 << one["width"]) - 1
                    ports[one["port"]] = ports.get(one["port"], 0) | bits << one["low"]
            for port in (*self.core.cfg, *self.core.inputs):
                ports[port.name] = port.low + (ports[port.name] - port.low) % (1 << port.width)
            found = self.core.model(self.core.params, **{name: [value] for name, value in ports.items()})
            for one in self.about["words"]:
                if one["kind"] == "out":
                    self.words[one["address"]] = int(found[one["port"]][0]) >> one["low"] & 0xFFFFFFFF
            self.words[0x00C], self.waits = 2 | int(found["out_status"][0]) << 8, 2


@pytest.mark.parametrize("name", ["table_ik2", "vector_ik2"])
def test_a_device_answers_as_the_model_does(name):
    core = cores.find(name)
    cfg = verilog.config(core, arms.load("cobra600"))
    bus = Registers(core)
    one = device.Device(bus, registers.described(core, cfg))
    one.configure()
    for x, y, elbow in ((19200, -7680, 0), (-9000, 30, 1), (32767, 32767, 0), (1, -32768, 1)):
        want = core.model(core.params, in_x=[x], in_y=[y], in_elbow=[elbow], **cfg)
        assert one.run(x=x, y=y, elbow=elbow) == {key[4:]: int(value[0]) for key, value in want.items()}
    with pytest.raises(ValueError, match="in_x: 40000 does not fit its 16 bits"):
        one.run(x=40000, y=0, elbow=0)
    bus.words[0x00C], bus.write = 1, lambda *_: None
    with pytest.raises(TimeoutError, match="no result after 5 reads of STATE, which is 0x1"):
        one.run(polls=5, x=0, y=0, elbow=0)
    with pytest.raises(device.WrongDevice, match="answers, table_ik3 with"):
        device.Device(bus, registers.described(cores.find("table_ik3"), {}))


def test_memory_is_read_and_written_by_words(tmp_path):
    path = tmp_path / "memory"
    path.write_bytes(bytes(0x5000))
    with device.Memory(path, 0x1040, 0x1000) as bus:
        bus.write(0x008, 0xDEADBEEF)
        assert bus.read(0x008) == 0xDEADBEEF
    assert path.read_bytes()[0x1048:0x104C] == bytes.fromhex("efbeadde")


@pytest.mark.parametrize("readback", [True, False])
@pytest.mark.parametrize("name", ["table_ik2", "vector_to_spread", "engine_quaternion_gd_plane-N100", "rotation_check"])
def test_peakrdl_reads_the_description(name, readback, tmp_path):
    core = catalogue.find(name)
    path = tmp_path / "map.rdl"
    path.write_text(registers.rdl(core, readback))
    compiler = RDLCompiler()
    compiler.compile_file(str(path))
    top = compiler.elaborate().top
    found = {(one.inst_name, one.absolute_address, tuple((field.inst_name, field.low, field.width)
                                                         for field in one.fields())) for one in top.registers()}
    want = {(word.name, word.address, (("value", 0, word.width),)) for word in registers.words(core)}
    want |= {("START", 8, (("start", 0, 1),)), ("IRQ_ENABLE", 16, (("done", 0, 1),)), ("ID", 0, (("id", 0, 32),)),
             ("VERSION", 4, (("version", 0, 32),))}
    state = [("busy", 0, 1), ("done", 1, 1), ("refused", 2, 1), ("outside", 3, 1)]
    state += [(bit, 8 + cores.STATUS_BITS[bit], 1) for bit in sorted(core.status or (), key=cores.STATUS_BITS.get)]
    assert found == want | {("STATE", 12, tuple(state))}
    HTMLExporter().export(top, str(tmp_path / "html"))
    assert (tmp_path / "html" / "index.html").is_file()
    CHeaderExporter().export(top.parent, str(tmp_path / "map.h"))
    assert re.search(r"uint32_t ID;", (tmp_path / "map.h").read_text())


# The C headers: they compile, and answer as Python does

STRICT = ("-Wall", "-Wextra", "-Wpedantic", "-Werror", "-O1", "-ffp-contract=off")
STANDARDS = {"c": ("gcc", "-std=c99"), "cpp": ("g++", "-std=c++17", "-xc++")}
ARMED = [core for core in cores.all_cores() if core.clocked and core.first_set and core.cfg and c.shares(core)]
SHAPES = list({(core.function if core.family in ("arm", "six") else "", core.family,
                tuple(port.name for port in core.cfg)): core for core in reversed(ARMED)}.values())
FIELDS = ("mm_per_unit", "l1", "l2", "l3", "base", "shoulder", "lateral", "elbow", "flange", "offset",
          "singular_elbow", "singular_axis")


def drawn(rng, absolute):
    """A random arm, and its second link: extremes, zero offsets and scales at which words do not fit among them."""
    def some(most, chance=0.7):
        return float(rng.uniform(-most, most)) if rng.random() < chance else 0.0

    l1, forearm, offset = *np.exp(rng.uniform(math.log(0.5), math.log(2000), 2)).tolist(), some(60)
    flange = float(rng.uniform(0, 300))
    ends = [sorted(rng.uniform(-400, 400, 2).tolist()) for _ in range(4)]
    return dataclasses.replace(
        arms.load("ur5"), id="drawn", mm_per_unit=float(np.exp(rng.uniform(math.log(2), math.log(40)))), l1=l1,
        l2=math.hypot(forearm, offset), base=some(300), shoulder=some(100), lateral=some(100), elbow=offset,
        elbow_angle=math.degrees(math.atan2(offset, forearm)), absolute_elbow=absolute,
        limits=tuple(map(tuple, ends[:3])), forearm_limit=tuple(ends[3]), l3=float(rng.uniform(1, 300)), spherical=True,
        flange=flange, d5=some(300), d6=flange,
        singular=(float(rng.uniform(0.1, 30)), float(rng.uniform(0.1, 30)))), forearm


def numbers(arm, forearm):
    """An arm as the C program reads it: what its file would say."""
    return [arm.mm_per_unit, arm.l1, forearm, arm.l3, arm.base, arm.shoulder, arm.lateral, arm.elbow, arm.flange,
            arm.d5, *arm.singular, *(end for limit in arm.limits for end in limit), *arm.forearm_limit]


def compiled(folder, text, headers, standard="c"):
    """A program of C with these headers."""
    for name, header in {**headers, "quadrance.h": c.SHARED.read_text()}.items():
        (folder / name).write_text(header)
    (folder / "main.c").write_text(text)
    compiler, *options = STANDARDS[standard]
    subprocess.run([compiler, *options, *STRICT, "main.c", "-o", f"main-{standard}", "-lm"], cwd=folder, check=True)
    return folder / f"main-{standard}"


def program(some):
    """A program that reads arms and prints the words of some cores, x where one does not fit."""
    reads = " || ".join([f"fread(&arm.{name}, 8, 1, stdin) != 1" for name in FIELDS] + [
        f"fread(arm.{name}_limit, 8, 2, stdin) != 2" for name in ("shoulder", "elbow", "yaw", "forearm")])
    lines = ["#include <stdio.h>", "#include <inttypes.h>", *(f'#include "{core.name}.h"' for core in some),
             "int main(void) {", "    quadrance_arm arm;", "    for (;;) {", f"        if ({reads}) return 0;"]
    for core in some:
        words = " ".join('%" PRId64 "' for _ in core.cfg)
        values = ", ".join(f"(int64_t)cfg.{port.name[4:]}" for port in core.cfg)
        lines += [f'        {{ {core.name}_cfg cfg; if ({core.name}_of_arm(&cfg, &arm)) printf("x;");',
                  f'          else printf("{words};", {values}); }}']
    return "\n".join([*lines, '        printf("\\n");', "    }", "}"]) + "\n"


def fitting(some, absolute):
    """Cores with the switch that an absolute elbow wants."""
    return [catalogue.at(core, {"ABSOLUTE": int(absolute)}) if "ABSOLUTE" in core.params else core for core in some]


def check_arms(folder, count, seed, absolute, some=()):
    rng = np.random.default_rng(seed)
    some = some or fitting(SHAPES, absolute)
    run = compiled(folder, program(some), {f"{core.name}.h": c.header(core) for core in some})
    drew = [drawn(rng, absolute) for _ in range(count)]
    drew += [(dataclasses.replace(drew[0][0], mm_per_unit=8.0, l1=l1, l2=l2, base=-2.5 / 32, shoulder=1.5 / 32,
                                  lateral=0.0, elbow=0.0, elbow_angle=0.0), l2)  # ties, and links of some LSB or none
             for l1, l2 in ((100.5 / 32, 101.5 / 32), (1e-6, 1e-6), (1 / 32, 1e-6), (1 / 32, 1 / 32), (3 / 32, 1 / 32))]
    data = np.array([numbers(*one) for one in drew], dtype="<f8").tobytes()
    said = subprocess.run([run], input=data, capture_output=True, check=True).stdout.decode().splitlines()
    assert len(said) == len(drew)
    fits = dict.fromkeys((core.name for core in some), 0)
    for (arm, _), line in zip(drew, said):
        for core, found in zip(some, line.split(";")):
            try:
                seven = dataclasses.replace(arm, upper_limit=(-170.0, 170.0))
                words = verilog.config(core, seven if core.family == "srs" else arm)
                want = " ".join(str(words[port.name]) for port in core.cfg)
                fits[core.name] += 1
            except (Refused, ArmError):
                want = "x"
            assert found == want, f"{core.id}: C {found}, Python {want}: {arm}"
    assert all(len(drew) < 20 * one for one in fits.values()), fits
    print(len(drew), fits)
    odd = np.array([[value] * 20 for value in (math.nan, math.inf, -math.inf, 1e300, 0.0)], dtype="<f8")
    said = subprocess.run([run], input=odd.tobytes(), capture_output=True, check=True).stdout.decode().splitlines()
    assert set("".join(said[:3])) <= {"x", ";"} and len(said) == len(odd), said


@pytest.mark.parametrize("absolute", [False, True])
def test_words_of_random_arms_are_those_of_python(absolute, tmp_path):
    check_arms(tmp_path, 200, 2026, absolute)


@pytest.mark.parametrize("w", [17, 20, 21, 24])
def test_words_of_wide_coordinates_are_those_of_python(w, tmp_path):
    some = [catalogue.find(name) for name in ("vector_ik2", "rational_ik2", "table_ik3r", "arm_ik3", "arm_keep3")]
    some = [catalogue.at(core, core.params | {"W": w, "F": w - 8}) for core in some]
    check_arms(tmp_path, 200, 2026, False, fitting(some, False))


def test_words_of_margins_are_those_of_python(tmp_path):
    edged = {core.name: core for core in cores.all_cores() if core.params.get("MARGINS") and not core.params["PIPE"]}
    assert {"vector_ik3", "table_ik3r", "rational_ik2", "arm_ik3", "vector_ik6", "table_ik6"} <= edged.keys()
    check_arms(tmp_path, 200, 2026, False, list(edged.values()))


@pytest.mark.slow
@pytest.mark.timeout(3600)
def test_words_of_a_hundred_thousand_arms_are_those_of_python(tmp_path):
    seed = int(os.environ.get("SEED", 2026))
    print(f"SEED={seed}")
    some = {core.name: core for core in reversed(ARMED)}.values()
    assert {"ur", "srs", "six", "arm"} <= {core.family for core in some}
    for absolute in (False, True):
        check_arms(tmp_path, 50_000, seed, absolute, fitting(some, absolute))


def strictly(folder, some, standard):
    """Their headers, with the constants of an arm where one fits, included twice, in one program without a warning."""
    headers = {}
    for core in some:
        try:
            arm = arms.load({"six": "puma560", "ur": "ur5e", "srs": "iiwa7", "keep": "kr6_r700"}.get(
                "ur" if core.name == "ur_keep" else core.family, "cobra600"))
            verilog.config(core, arm)
        except (Refused, ArmError):
            arm = None
        headers[f"{core.name}.h"] = c.header(core, arm)
    includes = "".join(f'#include "{name}"\n#include "{name}"\n' for name in headers)
    compiled(folder, f"{includes}int main(void) {{ return 0; }}\n", headers, standard)


@pytest.mark.parametrize("standard", STANDARDS)
def test_the_header_of_every_set_compiles_strictly(standard, tmp_path):
    """Of every clocked core: a program for the first sets, one for the second ones, and so on."""
    rounds = {}
    for core in cores.all_cores():
        if core.clocked:
            rounds.setdefault(sum(core.name in some for some in rounds.values()), {})[core.name] = core
    assert sum(map(len, rounds.values())) == sum(core.clocked for core in cores.all_cores())
    for some in rounds.values():
        strictly(tmp_path, some.values(), standard)


@pytest.mark.parametrize(("name", "core"), [("kr6_r700", "six_keep"), ("ur5e", "ur_keep"), ("iiwa7", "vector_srs_ik")])
def test_a_pose_of_the_tool_becomes_words_of_the_core(name, core, tmp_path):
    """Base and tip of the arm file are taken off; a pose out of the word is refused; without a table nothing is."""
    frames_said = ('[frames]\nbase = { link = "*/", xyz = [20, -30, 410], rpy = [10, 180, 75] }\n'
                   'tip = { link = "tool0", xyz = [3, 4, 55], rpy = [0, 90, -20] }\n')
    text, core = arms.path_of(name).read_text(), catalogue.find(core)
    rng, p = np.random.default_rng(3), core.params
    there = [frames.shift(*xyz) @ frames.turn("z", yaw) @ frames.turn("y", pitch) @ frames.turn("x", roll)
             for xyz, (roll, pitch, yaw) in (((20, -30, 410), np.radians((10, 180, 75))),
                                             ((3, 4, 55), np.radians((0, 90, -20))))]
    for said, (base, tip) in (("", [np.eye(4)] * 2), (frames_said, there)):
        file = tmp_path / "arm.toml"
        file.write_text(text + "\n" + said)
        arm = arms.load(file)
        run = compiled(tmp_path, "\n".join([
            "#include <stdio.h>", f'#include "{core.name}.h"', "int main(void) {", "    quadrance_frame pose;",
            "    int32_t w[12]; int i;", "    while (fread(&pose, sizeof pose, 1, stdin) == 1) {",
            f'        if ({core.name}_pose(w, &pose)) printf("x");',
            '        else for (i = 0; i < 12; ++i) printf("%ld ", (long)w[i]);', '        printf("\\n");', "    }",
            "    return 0;", "}"]) + "\n", {f"{core.name}.h": c.header(core, arm)})
        poses = [frames.shift(*rng.uniform(-900, 900, 3)) @ frames.turn("x", a) @ frames.turn("y", b) @ frames.turn(
            "z", a * b) for a, b in rng.uniform(-3, 3, (200, 2))]
        data = b"".join(np.concatenate([one[:3, :3].ravel(), one[:3, 3]]).tobytes() for one in poses)
        lines = subprocess.run([run], input=data, capture_output=True, check=True).stdout.decode().splitlines()
        refused = 0
        for one, line in zip(poses, lines, strict=True):
            own = np.linalg.inv(base) @ one @ np.linalg.inv(tip)
            place = own[:3, 3] / arm.mm_per_unit * 2 ** p["F"]
            if line == "x":
                assert np.abs(place).max() > 2 ** (p["W"] - 1) - 1
                refused += 1
                continue
            want = np.concatenate([own[:3, :3].ravel() * 2 ** p["U"], place])
            assert np.abs(np.array(line.split(), float) - want).max() < 0.5 + 1e-6
        assert refused < 100


@pytest.mark.parametrize(("name", "core"), [("kr6_r700", "six_keep"), ("ur5e", "ur_keep")])
def test_frames_along_axes_1_and_6_are_in_the_words(name, core, tmp_path):
    """The core answers a pose of the tool in the cell as it does that of the flange seen from the base."""
    core, text, rng = catalogue.find(core), arms.path_of(name).read_text(), np.random.default_rng(4)
    file, p, answers, found = tmp_path / "arm.toml", core.params, [], {}
    truth, load = (truth_six.fk6, truth_six.load) if name == "kr6_r700" else (truth_ur.fk, truth_ur.load)
    lengths, mm = load(name)
    q = rng.uniform(-0.8, 0.8, (1500, 6)) + [0, 0.3, 1.2, 0.2, 0.9, 0]
    rotation, tip = truth(q, lengths)
    own = np.tile(np.eye(4), (len(q), 1, 1))
    own[:, :3, :3], own[:, :3, 3] = rotation, tip
    there = [frames.shift(0, 0, z) @ frames.turn("z", np.radians(yaw)) for z, yaw in ((-90, 75), (120, -30))]
    said = ('[frames]\nbase = { link = "cell", xyz = [0, 0, -90], rpy = [0, 0, 75] }\n'
            'tip = { link = "gripper", xyz = [0, 0, 120], rpy = [0, 0, -30] }\n')
    for more, pose in (("", own), (said, there[0] @ own @ there[1])):
        file.write_text(f"{text}\n{more}")
        words = verilog.config(core, arms.load(file))
        ports = {f"in_r{i + 1}{k + 1}": np.rint(pose[:, i, k] * 2 ** p["U"]).astype(int) for i in range(3)
                 for k in range(3)}
        place = np.rint(pose[:, :3, 3] / mm * 2 ** p["F"]).astype(int)
        assert np.abs(place).max() < 1 << p["W"] - 1
        found = core.model(p, **ports, **{f"in_{axis}": place[:, i] for i, axis in enumerate("xyz")}, **words)
        answers.append(found)
    plain, tool = answers
    same = (plain["out_branch"] == tool["out_branch"]) & (plain["out_status"] | tool["out_status"] == 0)
    off = np.max([np.abs(plain[f"out_j{i}"] - tool[f"out_j{i}"]) for i in range(1, 7)], axis=0)
    assert same.mean() > 0.9 and np.mean(off[same] < 60) > 0.99  # one other choice may lead to others
    text = c.header(core, arms.load(file))
    assert "no_tip" not in text and "no_base" not in text and "gripper" in text
    file.write_text(file.read_text().replace("[0, 0, 120]", "[0, 1, 120]").replace("[0, 0, 75]", "[0, 1, 75]"))
    text = c.header(core, arms.load(file))
    assert "no_tip" in text and "no_base" in text
    file.write_text(file.read_text().replace("[0, 1, 120]", "[0, 0, 900]").replace("[0, 1, 75]", "[0, 0, 75]"))
    text = c.header(core, arms.load(file))  # a tool beyond what the core's program lets the flange be
    assert "no_tip" in text and "no_base" not in text


def joint_program(headers):
    return "\n".join(["#include <stdio.h>", *(f'#include "{name}"' for name in headers), "int main(void) {",
                      "    double degrees; int32_t c, n; uint32_t a, s;",
                      "    while (fread(&degrees, 8, 1, stdin) == 1) {",
                      "        quadrance_vector(degrees, 16, &c, &n);",
                      "        a = table_ik2_angle(degrees); s = rational_ik2_spread(degrees);",
                      '        printf("%ld %ld %lu %lu %.17g %.17g %.17g %ld\\n", (long)c, (long)n, (unsigned long)a,',
                      "            (unsigned long)s, table_ik2_degrees_of_angle(a), rational_ik2_degrees_of_spread(s),",
                      "            quadrance_vector_degrees(c, n), (long)TABLE_IK2_MM(degrees));", "    }", "}"]) + "\n"


@pytest.mark.parametrize("standard", STANDARDS)
@pytest.mark.parametrize("name", ("vector_ik6", "vector_xyzac"))
def test_a_program_of_the_engine_is_a_header(name, standard, tmp_path):
    """With a constant and without one: what the core loads, and where inputs and results are."""
    made = image.image(assembler.assembled(cores.RTL / "program" / f"{name}.kin", 0), start=700, version=9)
    ports = [port for port in (*made["inputs"], *made["outputs"]) if "word" not in port]
    values = ["(long long)one->header", "one->count", "one->start", "one->one",
              *(f"one->lines[{i}]" for i in range(len(made["lines"]))),
              *(f"{name.upper()}_{port['name'].upper()}" for port in ports)]
    prints = "".join(f'    printf("%lld\\n", (long long)({value}));\n' for value in values)
    text = (f'#include <stdio.h>\n#include "{name}.h"\nint main(void) {{\n'
            f"    const kinematics_engine_program *one = &{name};\n{prints}    return 0;\n}}\n")
    core = cores.find("kinematics_engine")
    headers = {"kinematics_engine.h": c.header(core), f"{name}.h": image.header(made)}
    run = compiled(tmp_path, text, headers, standard)
    found = list(map(int, subprocess.run([run], capture_output=True, check=True, text=True).stdout.split()))
    assert found == [int(made["header"], 16), len(made["lines"]), 700, 22 if name == "vector_ik6" else -1,
                     *(int(line, 16) for line in made["lines"]), *(port["at"] for port in ports)]
    headers["kinematics_engine.h"] = c.header(catalogue.at(core, {"PIPE": 1}))
    with pytest.raises(subprocess.CalledProcessError):
        compiled(tmp_path, text, headers, standard)


def test_a_program_whose_name_is_none_in_c_is_refused():
    with pytest.raises(Wrong, match="^'my-pan' is no name in C"):
        image.header({"program": "my-pan"})


def test_joints_and_millimetres_are_those_of_python(tmp_path):
    arm = arms.load("cobra600")
    headers = {f"{name}.h": c.header(cores.find(name), arm) for name in ("table_ik2", "rational_ik2")}
    rng = np.random.default_rng(1)
    degrees = np.concatenate([rng.uniform(-800, 800, 4000), np.arange(-720, 721, 45), [359.9999999, -1e-9, 0.5 / 256]])
    run = compiled(tmp_path, joint_program(headers), headers)
    rows = subprocess.run([run], input=degrees.tobytes(), capture_output=True, check=True).stdout.decode().splitlines()
    found = np.array([[float(word) for word in row.split()] for row in rows]).T
    vector, angle, spread = (codecs.from_degrees(kind, bits, degrees)
                             for kind, bits in (("vector", 16), ("angle", 18), ("spread", 24)))
    for have, want in zip(found[:4], (*vector, angle, spread)):
        assert np.array_equal(have, want), degrees[have != want]
    for have, want in zip(found[4:7], (codecs.to_degrees("angle", 18, angle), codecs.to_degrees("spread", 24, spread),
                                       codecs.to_degrees("vector", 16, vector))):
        assert np.max(np.abs((have - want + 180) % 360 - 180)) < 1e-9
    assert np.array_equal(found[7], fixed.to_fixed(degrees / arm.mm_per_unit, 8))


def test_the_driver_drives_registers(tmp_path):
    """A device in memory: what the driver writes is where the map says, and a result is read with its sign."""
    arm, core = arms.load("cobra600"), catalogue.find("vector_ik2")
    words = {word.name: word for word in registers.words(core)}
    text = """#include <stdio.h>
#include "vector_ik2.h"
static uint32_t memory[1024];
int main(void) {
    vector_ik2_out out; unsigned i;
    memory[0] = VECTOR_IK2_IDENTITY;
    if (!vector_ik2_probe(memory)) return 1;
    memory[0] ^= 1;
    if (vector_ik2_probe(memory)) return 2;
    vector_ik2_configure(memory, &vector_ik2_arm);
    vector_ik2_interrupt(memory, 1);
    memory[3] = 0x302; memory[0x300 / 4] = 0xffff0001; memory[0x304 / 4] = 7;
    vector_ik2_run(memory, -5, 300, 1, &out);
    for (i = 0; i < 1024; i++) if (memory[i]) printf("%x %x ", 4 * i, memory[i]);
    printf("\\n%d %d %u\\n", (int)out.c1, (int)out.n1, (unsigned)out.status);
    vector_ik2_acknowledge(memory);
    if (memory[3] != 2) return 3;
    memory[3] = 0x30e;
    if (vector_ik2_flags(memory) != 12 || memory[3] != 12) return 4;
    return 0;
}
"""
    run = compiled(tmp_path, text.replace("\\\\n", "\\n"), {"vector_ik2.h": c.header(core, arm)})
    memory, result = subprocess.run([run], capture_output=True, text=True, check=True).stdout.splitlines()
    pairs = memory.split()
    found = {int(at, 16): int(word, 16) for at, word in zip(pairs[::2], pairs[1::2])}
    cfg = verilog.config(core, arm)
    want = {word.address: cfg[word.port] >> word.low & 0xFFFFFFFF for word in words.values() if word.kind == "cfg"}
    want |= {0x000: registers.identity(core) ^ 1, 0x008: 1, 0x00C: 0x302, 0x010: 1, 0x200: 0xFFFFFFFB, 0x204: 300,
             0x208: 1, 0x300: 0xFFFF0001, 0x304: 7}
    assert found == {at: word for at, word in want.items() if word} and result == "-65535 7 3"
