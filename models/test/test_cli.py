"""The command `quadrance`: what it prints, what it computes, what fits on an arm, and how it refuses."""

import json
import re
import subprocess
import sys
import time
from types import SimpleNamespace

import numpy as np
import pytest
from quadrance import accuracy, arms, codecs, cores, truth_arm
from quadrance.accuracy import of_core, pose
from quadrance.cli import catalogue, check, choose, main, tables, verilog, words
from quadrance.cli.catalogue import Refused

KINEMATIC = [core for core in cores.all_cores() if core.first_set and core.function in accuracy.JOINTS]


@pytest.fixture
def quadrance(capsys):
    """Run the command; its output, or its one line of refusal where `code` is 2."""
    def run(*arguments, code=0):
        try:
            ended = main(arguments)
        except SystemExit as end:
            ended = end.code
        out, err = capsys.readouterr()
        assert ended == code, err
        if code:
            assert out == "" and err.count("\n") == 1 and err.startswith("quadrance")
        return err if code else out
    return run


def test_the_table_of_cores(quadrance):
    rows = json.loads(quadrance("cores", "--json"))
    assert [row["id"] for row in rows] == [core.id for core in cores.all_cores() if core.first_set]
    assert len(json.loads(quadrance("cores", "--all", "--json"))) == len(cores.all_cores())
    text = quadrance("cores", "--function", "ik2", "--word", "angle")
    assert "table_ik2" in text and "vector_ik2" not in text and "rational_ik2" not in text
    row = next(row for row in catalogue.rows() if row["core"] == "table_ik2")
    assert str(row["figures"]["ecp5"]["lut"]) in next(line for line in text.splitlines() if "table_ik2" in line)


def test_every_name_of_the_table_is_one_core_that_show_finds(quadrance):
    rows, text = catalogue.rows(), quadrance("cores")
    for row in rows:
        assert catalogue.find(row["title"]).id == row["id"]
        assert re.search(rf"^{row['title']} ", text, re.M)


def test_a_narrow_table_leaves_columns_out_and_cuts_no_figure():
    columns = [tables.Column("core", True), tables.Column("ALUT"), tables.Column("MHz", rank=2),
               tables.Column("II", rank=1)]
    rows = [["a_core", "123456", "98.7", "5"]]
    for width, heads in ((80, ["core", "ALUT", "MHz", "II"]), (28, ["core", "ALUT", "II"]), (20, ["core", "ALUT"])):
        grid = tables.grid(columns, rows, width)
        assert [column.header for column in grid.columns] == heads
        assert (grid.caption is None) == (width == 80)
        out = tables.Console(width=200)
        with out.capture() as text:
            out.print(grid)
        assert max(map(len, text.get().splitlines()[:3])) <= width and "123456" in text.get()


def test_show_names_every_port(quadrance):
    core = cores.find("vector_ik3")
    text = quadrance("show", "vector_ik3")
    for port in (*core.cfg, *core.inputs, *core.outputs):
        assert re.search(rf"^{port.name} .*\b{port.width}\b", text, re.M)
    about = json.loads(quadrance("show", "vector_ik3", "--json"))
    assert about["latency"] == core.latency and about["status"] == {"unreachable": 0, "singular": 1}
    assert about["header"][0].startswith("Inverse kinematics of three joints")
    other = json.loads(quadrance("show", "vector_ik3", "-p", "U=14", "--json"))
    assert [port["width"] for port in other["ports"] if port["name"] == "out_c1"] == [16]


@pytest.mark.parametrize(("mhz", "told"), [(28.44, "28.44 MHz"), (None, "it does not fit")])
def test_show_has_a_line_of_the_small_chip_where_it_was_measured(quadrance, monkeypatch, mhz, told):
    rows = {"vector_ik2-U16": {"lut": 700, "ff": 551, "dsp": 8, "mem": 10, "mhz": mhz}}
    whole = catalogue.report() | {"up5k": {"rows": rows}}
    monkeypatch.setattr(catalogue, "report", lambda: whole)
    assert f"\niCE40 UP5K  700 LC, 551 FF, 8 MAC16, 10 RAM4K; {told}\n" in quadrance("show", "vector_ik2")
    assert "UP5K" not in quadrance("show", "vector_ik2", "-p", "PIPE=1")


@pytest.mark.parametrize("name", sorted({core.name for core in cores.all_cores()}))
def test_files_come_after_what_they_instantiate(name):
    core = cores.find(name)
    order = catalogue.compile_order(core)
    assert order[-1] == core.sources[0] and sorted(order) == sorted(core.sources)
    for i, path in enumerate(order):
        assert set(cores.sources_of(path.stem)[1:]) <= set(order[:i])


def test_files_in_every_form(quadrance, tmp_path):
    listed = quadrance("files", "rational_fk1").split()
    dotted = quadrance("files", "rational_fk1", "-f").splitlines()
    assert dotted[0].startswith("// top module rational_fk1") and dotted[1:] == listed
    assert quadrance("files", "rational_fk1", "--relative", str(cores.RTL)).split()[-1] == "rational/rational_fk1.v"
    quadrance("files", "rational_fk1", "--copy", str(tmp_path / "new"))
    assert len(list((tmp_path / "new").iterdir())) == len(listed)
    (tmp_path / "new" / "rational_fk1.v").write_text("mine")
    assert "is another file" in quadrance("files", "rational_fk1", "--copy", str(tmp_path / "new"), code=2)
    assert (tmp_path / "new" / "rational_fk1.v").read_text() == "mine"


@pytest.mark.parametrize(("name", "timing"), [
    ("isqrt_comb", "combinational"), ("skid_buffer", "latency 1, a sample every 1 clocks"),
    ("vector_fk6", "latency 45, a sample every 45 clocks"),
    ("engine_quaternion_gd", "one sample at a time, some 200 clocks each: it depends on the sample")])
def test_timing_is_shown_of_cores_whose_error_nothing_measures_too(quadrance, name, timing):
    text = quadrance("show", name)
    assert re.search(rf"^timing +{re.escape(timing)}$", text, re.M) and "None" not in text
    assert quadrance("instance", name).startswith(f"// {cores.find(name).id}: {timing}\n")


@pytest.mark.parametrize("asked", ["arm_keep3-W20U20", "vector_ik6", "table_ik6", "vector_ik6_all -p PIPE=2"])
def test_an_error_that_depends_on_the_arm_has_its_command(sampled, asked):
    """It is for the parameters that were shown; the switches of rtl/arm are those of the arm."""
    shown = ("show", *asked.split())
    command, = re.findall(r"^worst error of an arm: quadrance (accuracy .+ --arm )ARM$", sampled(*shown), re.M)
    about = json.loads(sampled(*command.split(), "puma560", "--json"))
    params = json.loads(sampled(*shown, "--json"))["params"]
    assert about["total_mm"] > 0 and all(about["params"][key] == params[key] for key in ("W", "F", "PIPE"))


def test_instances_elaborate_with_the_computed_words(tmp_path):
    """Every kinematic core as printed; two of them, declared, in one top without a warning of a width."""
    from tb.lib import tools

    arm = arms.load("ur5")
    for core in KINEMATIC:
        text = verilog.instance(core, arm)
        for port, value in accuracy.config(core, arm).items():
            width = next(one.width for one in core.cfg if one.name == port)
            assert re.search(rf"\.{port}\({'-' * (value < 0)}{width}'s?d{abs(value)}\)", text), (core.id, port)
    some = [core for core in KINEMATIC if core.name in ("rational_ik2", "vector_fk2")]
    text = "\n".join(verilog.instance(core, arm, f"u_core{i}", declare=True) for i, core in enumerate(some))
    top = tmp_path / "top.v"
    top.write_text(f"module top (input wire clk, input wire rst);\n{text}\nendmodule\n")
    files = dict.fromkeys(path for core in some for path in core.sources)
    tools.run("verilator", "--lint-only", "-Wall", "-Wno-UNUSEDSIGNAL", "-Wno-UNDRIVEN", "-Wno-DECLFILENAME",
              "--top-module", "top", *files, top)
    top.write_text(top.read_text().replace(".cfg_l1(16'd", ".cfg_l1(15'd"))
    with pytest.raises(tools.ToolError, match="WIDTH"):
        tools.run("verilator", "--lint-only", "-Wall", "-Wno-UNUSEDSIGNAL", "-Wno-UNDRIVEN", "--top-module", "top",
                  *files, top)


def test_an_instance_without_an_arm_leaves_its_words_to_signals(quadrance):
    text = quadrance("instance", "vector_fk1", "--name", "u_a", "-p", "W=12", "-p", "F=4", "--declare")
    assert "wire [11:0] a_cfg_l1;" in text and ".cfg_l1(a_cfg_l1)" in text
    assert "vector_fk1 #(.W(12), .F(4), .U(16)) u_a (" in text
    assert "no name of a Verilog instance" in quadrance("instance", "vector_fk1", "--name", "1a", code=2)
    assert "12 bits end at 4095" in quadrance("instance", "vector_fk1", "-p", "W=12", "--arm", "cobra600", code=2)


def test_an_instance_in_every_format(quadrance, tmp_path):
    """VHDL has each port with its width, and the words of JSON; C has the words, and compiles."""
    for name, arm in (("table_ik2", "cobra600"), ("arm_ik3", "ur5"), ("engine_quaternion_dls", None)):
        more = ["--arm", arm] if arm else []
        about = json.loads(quadrance("instance", name, *more, "--format", "json"))
        core = catalogue.find(about["core"].partition("-")[0], about["params"])
        text = quadrance("instance", name, *more, "--format", "vhdl")
        ports = dict(re.findall(r"^    (\w+) : (?:in|out) (std_logic(?:_vector\(\d+ downto 0\))?)\)?;$", text, re.M))
        mapped = dict(re.findall(r"^    (\w+) => (.*?)(?:,|\);?)$", text, re.M))
        data = (*core.cfg, *core.inputs, *core.outputs)
        assert ports.keys() - {port.name for port in data} == {"clk", "rst", "in_valid", "in_ready", "out_valid",
                                                               "out_ready"}
        for port in data:
            assert ports[port.name] in ((f"std_logic_vector({port.width - 1} downto 0)",) if port.width > 1 else
                                        ("std_logic", "std_logic_vector(0 downto 0)"))
        for port in core.cfg if arm else ():
            bits = mapped[port.name].strip("'\"")
            assert len(bits) == port.width
            value = int(bits, 2)
            assert (value - (1 << port.width) if port.signed and value >> port.width - 1 else value) == \
                about["cfg"][port.name]
        assert {key: mapped[key] for key in core.params} == {key: str(value) for key, value in core.params.items()}
    text = quadrance("instance", "table_ik2", "--arm", "cobra600", "--format", "c")
    (tmp_path / "words.c").write_text(f"#include <stdint.h>\n{text}\nint64_t q = TABLE_IK2_CFG_Q;\n"
                                      "char a[TABLE_IK2_CFG_Q == -118783999 ? 1 : -1];\n")
    subprocess.run(["gcc", "-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-c", "words.c"], cwd=tmp_path,
                   check=True)
    for wrong, said in ((["--format", "ada"], "no format 'ada'; there are verilog, vhdl, c, json"),
                        (["--format", "c"], "give --arm"), (["--format", "vhdl", "--name", "signal"], "no name"),
                        (["--format", "vhdl", "--name", "u__a"], "no name")):
        assert said in quadrance("instance", "table_ik2", *wrong, code=2)


def test_literals_have_the_size_and_the_sign_of_their_port():
    port = cores.Port("cfg_q", 4, True)
    assert [verilog.literal(port, value) for value in (-8, -7, 7)] == ["4'sh8", "-4'sd7", "4'sd7"]
    assert verilog.literal(cores.Port("cfg_l1", 4, False), 15) == "4'd15"
    with pytest.raises(Refused, match="8 does not fit its 4 bits"):
        verilog.literal(port, 8)


@pytest.mark.parametrize("kind, bits", [("angle", 18), ("angle", 9), ("spread", 24), ("vector", 16),
                                        ("half_tangent", 16)])
def test_degrees_there_and_back(quadrance, kind, bits):
    angles = [0, 33.3, -10, 90, 180.004, 359.99, 725]
    out = json.loads(quadrance("encode", f"{kind}:{bits}", *map(str, angles), "--json"))
    step = np.degrees(codecs.half_step(codecs.joint_of(kind, bits)))
    for angle, entry in zip(angles, out):
        words_ = ",".join(str(one["value"]) for one in entry["words"])
        back = json.loads(quadrance("decode", f"{kind}:{bits}", words_, "--json"))[0]
        assert abs((back["degrees"] - angle + 180) % 360 - 180) <= step * (1 + 1e-9)
        assert [one["value"] for one in back["words"]] == [one["value"] for one in entry["words"]]
        hexed = ",".join(one["hex"] for one in entry["words"])
        assert json.loads(quadrance("decode", f"{kind}:{bits}", hexed, "--json"))[0]["degrees"] == back["degrees"]


def test_the_words_of_the_pages(quadrance):
    assert "5057090 (26'h04d2a42)" in quadrance("encode", "rational_fk1.j1", "33.3")
    assert "6062 " in quadrance("encode", "angle:16", "33.3")
    assert "c = 54775" in quadrance("encode", "vector:16", "33.3")
    assert "8320 (16'h2080)" in quadrance("encode", "table_ik2.x", "325", "--arm", "cobra600")
    assert "-32.500000 units, -325.0000 mm" in quadrance("decode", "coordinate", "-8320", "--mm-per-unit", "10")
    assert "16 fraction bits" in quadrance("show", "vector_fk1")
    assert json.loads(quadrance("encode", "vector_fk2.j2", "90", "--json"))[0]["words"][1]["port"] == "in_n2"


def test_encoder_counts_are_exact(quadrance):
    counts = 1 << 20
    for count in (0, 1, counts - 1, -1, 5 * counts + 7):
        out = json.loads(quadrance("encode", "angle:20", str(count), "--counts", str(counts), "--json"))[0]
        assert out["words"][0]["value"] == count % counts == out["count"]
    assert json.loads(quadrance("decode", "angle:18", "65536", "--counts", "4000", "--json"))[0]["count"] == 1000


@pytest.mark.parametrize("arguments, reason", [
    (("sho",), "no command 'sho'; did you mean show?"),
    (("show", "rational_ik22"), "no core 'rational_ik22'; did you mean rational_ik2"),
    (("show", "qqq"), "no core 'qqq'; there are isqrt_comb"),
    (("show", "classic_ik2_iter"), "classic_ik2_iter is now classic_ik2 with MODE = 0: classic_ik2-iter-A16"),
    (("files", "divide_pipe-8by8R3"), "divide_pipe-8by8R3 is now divide with MODE = 1: divide-pipe-16by16"),
    (("show", "classic_ik2-com"), "did you mean classic_ik2-comb-A16"),
    (("show", "rational_ik2-S3"), "did you mean rational_ik2-S24"),
    (("show", "rational_ik2", "-p", "Z=1"), "no parameter of rational_ik2 'Z'; there are W, F, S"),
    (("show", "rational_ik2", "-p", "W=x"), "a parameter is NAME=INTEGER"),
    (("show", "rational_ik2", "-p", "W=40"), "is not supported: it needs W 4 to 24"),
    (("cores", "--family", "rationale"), "no family 'rationale'; did you mean rational"),
    (("cores", "--family", "arith", "--function", "fk1"), "leave one of them out"),
    (("instance", "table_ik2", "--arm", "cobra60"), "no arm 'cobra60'; did you mean cobra600?"),
    (("instance", "table_ik2", "--arm", "none.toml"), "none.toml: cannot be read"),
    (("encode", "angel", "3"), "no word 'angel'; did you mean angle?"),
    (("encode", "angle:x", "3"), "the bits of angle are a number from 2 to 40"),
    (("encode", "angle", "x"), "'x' is no number"),
    (("encode", "angle", "nan"), "nan is no finite number"),
    (("encode", "angle", "1.5", "--counts", "100"), "a whole number"),
    (("encode", "angle", "1", "--counts", "0"), "at least one count"),
    (("encode", "coordinate", "128"), "holds -128 to 127.996 units"),
    (("encode", "coordinate", "1", "--mm-per-unit", "-1"), "must be positive"),
    (("encode", "table_ik2.w", "1"), "no port of table_ik2 'w'; there are l1"),
    (("encode", "table_ik2.elbow", "1"), "neither a joint word nor a coordinate"),
    (("encode", "vector_ik6.c1", "1"), "vector_ik6.c1 is cfg_c1 and out_c1: give the port's whole name"),
    (("decode", "vector", "1"), "a vector is 2 words (c, n), not 1"),
    (("decode", "vector", "0,0"), "is no direction"),
    (("decode", "angle:8", "256"), "256 does not fit the 8 bits"),
    (("decode", "angle", "12z"), "is no integer"),
    (("track", "tuch"), "no solver 'tuch'; did you mean touch?"),
    (("track", "touch", "--iterations", "0"), "a sample has 1 to 1023"),
    (("check", "none.toml"), "cannot be read")])
def test_what_cannot_be_answered_is_refused_in_one_line(quadrance, arguments, reason):
    assert reason in quadrance(*arguments, code=2)


def test_an_arm_is_checked_and_its_scale_judged(quadrance, tmp_path):
    assert "mm_per_unit = 5 would do" in quadrance("check", "cobra600")
    file = tmp_path / "mine.toml"
    file.write_text(arms.path_of("cobra600").read_text().replace("mm_per_unit = 10.0", "mm_per_unit = 5.0"))
    assert "advice" not in quadrance("check", str(file))
    file.write_text(file.read_text().replace("5.0", "4.0"))
    assert "raise mm_per_unit above 4.6" in quadrance("check", str(file), code=2)
    assert [one["arm"] for one in json.loads(quadrance("arms", "--json"))] == arms.known()


@pytest.mark.parametrize("name", arms.known())
def test_the_scale_holds_every_coordinate_of_the_arm(quadrance, name):
    """Tips all over, the arm stretched among them: none beyond the spans, each span reached, a shipped scale holds."""
    arm = arms.load(name)
    theta = np.random.default_rng(2).uniform(-np.pi, np.pi, (3, 20_000))
    theta[1, ::2] = 0
    frame = truth_arm.Frame(arm.base, arm.shoulder, arm.lateral)
    reach = np.abs(truth_arm.fk3(*theta, arm.l1, arm.l2, frame)).max(axis=1)
    reach = reach + sum(abs(length or 0) for length in (arm.flange, arm.d5, arm.d6))
    spans = check.spans(arm)
    if arm.l3 is None:
        flat = reach[:2].max() if arm.yaws else arm.l1 + arm.l2
        for found, span in zip((flat, reach[2]), spans.values()):
            assert found <= span + 1e-9 and found > 0.98 * span
    best = check.scale(arm)
    assert max(spans.values()) / best <= arms.REACH and arm.mm_per_unit >= best
    assert "raise" not in quadrance("check", name) and f"joints   {arm.axes};" in quadrance("check", name)


def test_a_scale_at_which_base_and_shoulder_overflow_is_not_advised(quadrance, tmp_path):
    file = tmp_path / "kr6.toml"
    file.write_text(arms.path_of("kr6_r700").read_text().replace("mm_per_unit = 10.0", "mm_per_unit = 8.0"))
    assert "raise mm_per_unit to 10: at 8 the arm takes z to 145.2 of 128 units" in quadrance("check", str(file))
    assert "advice" not in quadrance("check", "kr6_r700")


def test_a_wrist_that_is_not_spherical_is_no_six_axes(quadrance):
    text = quadrance("check", "ur5")
    assert re.search(r"^  not +fk6, ik6, ik6_all.*: wrist.spherical: is false", text, re.M)
    assert "fk6" in json.loads(quadrance("check", "puma560", "--json"))["functions"]
    assert [one["axes"] for one in json.loads(quadrance("arms", "--json"))].count(6) == 7
    assert "wrist.spherical: is false" in quadrance("instance", "vector_ik6", "--arm", "ur5", code=2)


def test_seven_axes_are_served_by_their_cores_alone(quadrance, tmp_path):
    text, served = quadrance("check", "iiwa7"), json.loads(quadrance("check", "iiwa7", "--json"))["functions"]
    assert served == ["srs_ik", "srs_ik_to_angles"] and "yaw -170 to 170, upper -170 to 170 degrees" in text
    assert re.search(r"^  not +fk6, .*ur_ik, .*arm_ik3, .*ik2, .*ik1: limits.upper: is given, and", text, re.M)
    assert "not " not in "".join(line for line in quadrance("check", "kr6_r700").splitlines() if "srs_ik" in line)
    assert [one["axes"] for one in json.loads(quadrance("arms", "--json"))].count(7) == 2
    for core in ("vector_ik6", "table_fk6", "vector_ur_ik", "arm_ik3", "table_ik2"):
        assert "limits.upper: is given" in quadrance("instance", core, "--arm", "iiwa14", code=2)
    for arm in ("kr6_r700", "ur5e", "uarm_swift_pro"):
        assert "limits.upper: is missing, and this core" in quadrance("instance", "vector_srs_ik", "--arm", arm, code=2)
    for word, value, found in (("cfg_l4", "126", "51610 (20'h0c99a)  =  12.600098 units, 126.0010 mm"),
                               ("cfg_d", "340", "139264 (20'h22000)"), ("cfg_margin", "20", "512 (16'h0200)"),
                               ("cs", "-0.5", "-32768 (18'h38000)  =  -0.500000"), ("x", "400", "10240 (16'h2800)")):
        assert found in quadrance("encode", f"vector_srs_ik.{word}", value, "--arm", "iiwa7")
    file = tmp_path / "long.toml"
    file.write_text(arms.path_of("iiwa7").read_text().replace("flange = 126.0", "flange = 1e9"))
    assert "  cores    none serves it\n" in quadrance("check", str(file))


@pytest.mark.parametrize(("word", "value", "found"), [
    ("vector_fk6.r11", "0.5", "32768 (18'h08000)  =  0.500000"), ("vector_ik6.r23", "-1", "-65536 (18'h30000)"),
    ("vector_ik6.cfg_c1", "400", "163840 (20'h28000)  =  40.000000 units, 400.0000 mm"),
    ("table_ik6.j6", "90", "65536 (18'h10000)"), ("vector_fk6.x", "400", "10240 (16'h2800)"),
    ("arm_ik3.base", "400", "10240 (16'h2800)"), ("arm_rates3.w1", "1.5", "6144 (16'h1800)  =  1.500000 rad")])
def test_words_of_six_axes_and_of_built_arms(quadrance, word, value, found):
    assert found in quadrance("encode", word, value, "--arm", "kr6_r700")


def test_show_says_what_encode_takes(quadrance):
    text = quadrance("show", "vector_ik6")
    assert re.search(r"^in_r11 .*1\.0 is 2\^16", text, re.M) and re.search(r"^cfg_c1 .*Q7\.12, coordinate", text, re.M)


@pytest.mark.parametrize(("arguments", "reason"), [
    (("arm_ik3", "kr6_r700", "BASE=0"), "-p BASE=0 contradicts constants.base = 400.0 of kr6_r700"),
    (("arm_fk3", "kr6_r700", "ABSOLUTE=1"), "-p ABSOLUTE=1 contradicts constants.absolute_elbow = false"),
    (("arm_keep3", "uarm_swift_pro", "ABSOLUTE=0"), "contradicts constants.absolute_elbow = true"),
    (("arm_keep3", "geomagic_touch"), "arm_keep3 on arm geomagic_touch: limits.forearm: is missing"),
    (("arm_ik3", "cobra600"), "arm_ik3 on arm cobra600: limits.yaw: is missing"),
    (("vector_ik6", "uarm_swift_pro"), "vector_ik6 on arm uarm_swift_pro: wrist: is missing"),
    (("table_ik3r", "ur5"), "table_ik3r on arm ur5: links.l3: is missing"),
    (("vector_chain", "ur5"), "vector_chain takes no arm: its link lengths come with the samples"),
    (("isqrt", "ur5"), "isqrt takes no arm"), (("angle_to_vector", "ur5"), "takes no arm"),
    (("arm_ik3-W12", "puma560"), "constants.base: 671.83 mm is 3440 LSB and the word ends at 2047")])
def test_an_instance_is_the_arm_or_refused(quadrance, arguments, reason):
    core, arm, *params = arguments
    given = [one for param in params for one in ("-p", param)]
    assert reason in quadrance("instance", core, "--arm", arm, *given, code=2)


@pytest.mark.parametrize(("core", "arm"), [("vector_ik2", "cobra600"), ("table_ik2", "cobra600"),
                                           ("rational_ik2", "cobra600"), ("arm_ik3", "puma560")])
def test_the_margin_of_a_core_is_that_of_the_arm_file(quadrance, tmp_path, core, arm):
    file = tmp_path / "mine.toml"
    text = re.sub(r"^axis = .*\n", "", arms.path_of(arm).read_text(), flags=re.M)
    text = text.replace("elbow = 5.0", "{0}\nelbow = 5")
    file.write_text(text.replace("{0}", "axis = 20"))
    word = round(20 * 256 / arms.load(arm).mm_per_unit)
    found = quadrance("instance", core, "--arm", str(file), "-p", "MARGINS=1")
    assert re.search(rf"\.cfg_margin\(15'd{word}\), +// 20 mm, singular\.axis$", found, re.M)
    without = quadrance("instance", core, "--arm", str(file))
    assert re.search(r"\.cfg_margin\(15'd0\), +// not built: MARGINS is 0$", without, re.M)
    file.write_text(text.replace("{0}", "axis = 20000"))
    refusal = quadrance("instance", core, "--arm", str(file), "-p", "MARGINS=1", code=2)
    assert f"cfg_margin would be {20000 * 256 / arms.load(arm).mm_per_unit:.0f}, its 15 bits end at 32767" in refusal
    file.write_text(text.replace("{0}", ""))
    assert "cfg_margin(15'd0), " in quadrance("instance", core, "--arm", str(file), "-p", "MARGINS=1")



def test_a_switch_that_the_arm_does_not_need_may_be_built(quadrance):
    text = quadrance("instance", "arm_ik3", "--arm", "kr6_r700", "-p", "LATERAL=1", "-p", "U=14")
    assert ".U(14), .BASE(1), .SHOULDER(1), .LATERAL(1), .ELBOW(1), .ABSOLUTE(0)" in text
    assert re.search(r"\.cfg_lateral\(16'sd0\), +// 0 mm, constants.lateral", text)


def test_a_rule_is_asked_with_the_switches_of_the_arm(quadrance, sampled, monkeypatch):
    """A rule that allows long words without a lateral offset alone: the arm that has none is served, the other is not.
    """
    rule = SimpleNamespace(broken=lambda values: values.get("LATERAL") and values["F"] > 8, needs="LATERAL 0 above F 8")
    monkeypatch.setattr(catalogue, "rule_of", lambda core: rule)
    assert ".F(9), " in quadrance("instance", "arm_fk3", "--arm", "kr6_r700", "-p", "F=9")
    assert "it needs LATERAL 0" in quadrance("instance", "arm_fk3", "-p", "F=9", code=2)
    assert "it needs LATERAL 0" in quadrance("instance", "arm_fk3", "--arm", "kr6_r700", "-p", "F=9", "-p", "LATERAL=1",
                                             code=2)
    row = next(row for row in choose.rows() if row.core.name == "arm_fk3" and row.core.params["LATERAL"])
    wish = choose.Wish("arm_fk3", arms.load("kr6_r700"), words.word("vector:14"), "ecp5")
    monkeypatch.setattr(choose, "_fraction", lambda core, arm: 9)
    served = choose._served(row, wish, {"U": 14})
    assert (served.params["LATERAL"], served.params["F"], served.params["U"]) == (0, 9, 14)


def test_rates_want_their_thresholds(quadrance, tmp_path):
    file = tmp_path / "mine.toml"
    file.write_text(re.sub(r"\[singular\]\nelbow = .*\n", "", arms.path_of("cobra600").read_text()))
    refusal = quadrance("instance", "arm_rates2", "--arm", str(file), code=2)
    assert "arm_rates2 on arm mine: singular.elbow: is missing" in refusal
    assert "not      rates2: singular.elbow: is missing" in quadrance("check", str(file))


def test_the_circle_of_an_engine(quadrance):
    row = json.loads(quadrance("track", "engine_quaternion_gd", "--iterations", "2", "--json"))[0]
    assert row["iterations"] == 2 and row["clocks"] == 36 and row["golden_um"] is None
    assert f"{row['lag_um']:.3g}" in quadrance("track", "engine_quaternion_gd", "--iterations", "2").splitlines()[2]


def test_figures_are_those_of_the_report():
    report = json.loads((cores.ROOT / "reports" / "report.json").read_text())
    row = next(row for row in report["cores"] if (row["core"], row["set"]) == ("classic_ik2", "iter-A16"))
    found = catalogue.figures(cores.find("classic_ik2"))
    assert found["ecp5"] == {"lut": (area := row["area"]["ecp5"])["lut"], "ff": area["ff"], "mult18x18": area["dsp"],
                             "ebr": area["mem"], "lutram": area["lutram"], "mhz": row["fmax_mhz"]["ecp5"],
                             "ns": row["latency_ns"]}
    assert found["cyclonev"]["alut"] == row["area"]["cyclonev"]["lut"] and found["error_mm"] == row["total_mm"]
    assert catalogue.figures(catalogue.find("classic_ik2", {"A": 15})) is None


def test_a_closed_pipe_is_no_error():
    done = subprocess.run(f"{sys.executable} -m quadrance cores --all | head -1", shell=True, capture_output=True,
                          text=True)
    assert done.stderr == "" and done.stdout.startswith("core")


# `choose`, `accuracy`, `cores --arm`: what fits on an arm, by rows of the report and the bit-true models

COMMITTED = json.loads((cores.ROOT / "reports" / "report.json").read_text())


@pytest.fixture
def sampled(capsys, monkeypatch):
    """Run the command with few samples; its output, and its one line of refusal where `code` is 2."""
    monkeypatch.setattr(of_core, "WORKSPACE", 2048)

    def run(*arguments, code=0):
        try:
            ended = main(arguments)
        except SystemExit as end:
            ended = end.code
        out, err = capsys.readouterr()
        assert ended == code, err
        assert err.count("\n") == (code == 2)
        return (out, err) if code else out
    return run


def _ask(function="ik2", arm="cobra600", word="angle:18", **more):
    return ["choose", "--function", function, "--arm", arm, "--word", word,
            *(text for key, value in more.items() for text in (f"--{key}", str(value)))]


def test_what_fits_has_the_error_that_the_model_has(sampled):
    """Worked out again here, from inputs to tip; the smallest is the first, and the joint word is the one asked for."""
    fit = json.loads(sampled(*_ask("fk2", mm=0.09, rate=1e6), "--json"))["fit"]
    assert {"table_fk2", "classic_fk2"} <= {one["core"] for one in fit}
    assert [one["share"] for one in fit] == sorted(one["share"] for one in fit)
    slow = sampled(*_ask("fk2", rate=5e6))
    assert re.search("^not .*classic_fk2-iter: too slow: ", slow, re.M) and slow.startswith("core")
    arm = arms.load("cobra600")
    for one in fit:
        core = catalogue.find(one["core"], one["params"])
        case = accuracy.workspace_case(core, arm, 2048, np.random.default_rng(1))
        errors = accuracy.errors(core, arm, case, core.model(core.params, **case.inputs, **case.cfg))
        assert one["error_mm"] == errors.total.max() * accuracy.mm_per_lsb(core, arm) <= 0.09
        assert one["params"]["A"] == 18 and one["results_per_second"] >= 1e6
        name, *given = one["instance"].split()
        assert catalogue.find(name, {key: int(value) for key, value in re.findall(r"(\w+)=(\d+)", " ".join(given))}
                              ).params == one["params"]


def test_an_answer_that_the_model_does_not_confirm_is_not_printed(sampled, monkeypatch):
    right = of_core.modelled

    def wrong(core, inputs, cfg):
        off = 1 << core.params["W"] - 7
        return {port: word + off * (port == "out_x") for port, word in right(core, inputs, cfg).items()}

    assert "table_fk2 " in sampled(*_ask("fk2", mm=0.09))
    monkeypatch.setattr(of_core, "modelled", wrong)
    out, refusal = sampled(*_ask("fk2", mm=0.09), code=2)
    assert "too coarse: " in refusal and re.search("^not table_fk2,.*: too coarse", out, re.M)


@pytest.mark.parametrize("asked", [_ask(word="angle:21", mm=0.1), _ask("ik6", "kr6_r700", "vector:15", mm=0.1)])
def test_an_answer_takes_less_than_half_a_minute(asked, capsys):
    since = time.process_time()
    assert main(asked) == 0 and time.process_time() - since < 30


def test_few_models_run(monkeypatch):
    """One for each set of words, whatever ways there are to build them."""
    monkeypatch.setattr(of_core, "WORKSPACE", 512)
    wish = choose.Wish("ik6", arms.load("kr6_r700"), words.word("vector:16"), "ecp5", mm=1e-6, clock=1000.0)
    fit, out, near = choose.choose(wish)
    assert not fit and len([name for name in out if name.startswith("vector")]) == 8 and wish.runs == 2
    assert {text.partition(":")[0] for _, text in near[1].misses} == {"does not meet the clock", "too coarse"}


def test_a_clock_that_no_row_meets_names_the_nearest(sampled):
    out, refusal = sampled(*_ask("ik6", "kr6_r700", "vector:16", clock=500), code=2)
    best = max((row for row in COMMITTED["cores"] if row["core"] in ("vector_ik6", "vector_ik6_two", "vector_ik6_all")),
               key=lambda row: row["fmax_mhz"]["ecp5"])
    assert f"nothing fits; {best['core']}-PIPE{best['params']['PIPE']} is the nearest: does not meet the clock: " \
           f"{best['fmax_mhz']['ecp5']:g} of 500 MHz" in refusal
    assert out.count("does not meet the clock") >= 6
    clock = best["fmax_mhz"]["ecp5"]
    fit = json.loads(sampled(*_ask("ik6", "kr6_r700", "vector:16", clock=clock), "--json"))["fit"]
    assert [(one["core"], one["params"]["PIPE"]) for one in fit][0] == (best["core"], best["params"]["PIPE"])
    assert fit[0]["results_per_second"] == round(clock * 1e6 / fit[0]["ii"])


@pytest.mark.parametrize(("arguments", "reason"), [
    (_ask(chip="ecp6"), "no chip 'ecp6'; did you mean ecp5"), (_ask("ik22"), "no function 'ik22'; did you mean ik2"),
    (_ask("isqrt"), "no error in mm is defined for isqrt; there are fk1"),
    (_ask(word="coordinate:16.8"), "a joint word is angle"), (_ask(word="angle:x"), "the bits of angle"),
    (_ask(mm=0), "--mm 0: it must be positive"), (_ask(rate="often"), "'often' is no number"),
    (_ask(arm="cobra60"), "no arm 'cobra60'; did you mean cobra600?"),
    (["accuracy", "isqrt", "--arm", "cobra600"], "isqrt takes no arm"),
    (["accuracy", "arm_velocity2", "--arm", "cobra600"], "no error in mm is defined for velocity2"),
    (["accuracy", "table_ik3", "--arm", "cobra600"], "limits.yaw: is missing"),
    (["cores", "--function", "ik6", "--arm", "ur5"], "none of these cores serves ur5: wrist.spherical: is false"),
    (["decode", "--signed", "coordinate", "1"], "--signed is for joint words")])
def test_what_cannot_be_asked_is_refused_in_one_line(sampled, arguments, reason):
    out, refusal = sampled(*arguments, code=2)
    assert reason in refusal and not out


def test_an_arm_that_no_core_serves(sampled):
    out, refusal = sampled(*_ask("ik6", "ur5"), code=2)
    assert "no core of ik6 with angle:18 serves ur5" in refusal
    assert re.search(r"^not vector_ik6, .*table_ik6.*: wrist.spherical: is false", out, re.M)


def test_a_robot_of_three_parallel_axes_gets_its_core(sampled):
    fit = json.loads(sampled(*_ask("ur_ik", "ur5e", "vector:16", mm=0.1), "--json"))["fit"]
    assert {one["core"] for one in fit} == {"vector_ur_ik", "vector_ur_ik_all"}
    out, refusal = sampled(*_ask("ur_ik", "kr6_r700", "vector:16", mm=0.1), code=2)
    assert "no core of ur_ik with vector:16 serves kr6_r700" in refusal and "parallel = true" in out


def test_a_robot_of_seven_axes_gets_its_core(sampled):
    fit = json.loads(sampled(*_ask("srs_ik", "iiwa7", "vector:16", mm=0.1), "--json"))["fit"]
    assert "vector_srs_ik" in {one["core"] for one in fit} <= {"vector_srs_ik", "table_srs_ik"}
    out, refusal = sampled(*_ask("srs_ik", "kr6_r700", "vector:16", mm=0.1), code=2)
    assert "no core of srs_ik with vector:16 serves kr6_r700" in refusal and "limits.upper: is missing" in out
    assert "no core of ik6 with vector:16 serves iiwa7" in sampled(*_ask("ik6", "iiwa7", "vector:16"), code=2)[1]


def test_an_area_is_measured_or_said_to_be_an_estimate(sampled):
    area = {one.core.params["A"]: one.area["ecp5"]["lut"] for one in choose.rows()
            if one.core.name == "classic_ik2" and one.core.params["MODE"] == 0 and one.core.params["W"] == 16}
    low, high = min(area), max(area)
    core = catalogue.find("classic_ik2", {"A": high, "F": 3})
    assert choose.estimated(core, "ecp5", "A")[0]["lut"] == area[high] and choose.estimated(core, "ecp5", "A")[2]
    shorter, _, own = choose.estimated(catalogue.find("classic_ik2", {"A": low - 3}), "ecp5", "A")
    assert 0.9 * area[low] < shorter["lut"] < area[low] and not own
    longer = catalogue.find("vector_fk3", {"U": 20})
    assert choose.estimated(longer, "ecp5", "U") is None, "of a word that takes two multipliers there is no row"
    text = sampled(*_ask(word="angle:21"))
    assert re.search(r"^table_ik2 .*~\d+ ", text, re.M) and "~ an estimate" in text


def test_all_inverses_of_six_axes_are_found(sampled):
    names = {row["core"] for row in json.loads(sampled("cores", "--function", "ik6", "--json"))}
    assert names == {"vector_ik6", "vector_ik6_two", "vector_ik6_all", "table_ik6"}
    assert "table_fk6" in sampled("cores", "--function", "fk6")


def test_the_cores_of_an_arm(sampled):
    found = json.loads(sampled("cores", "--arm", "cobra600", "--json"))
    names = {row["core"] for row in found["cores"]}
    assert {"table_ik2", "arm_rates2"} <= names and not names & {"table_ik3", "vector_ik6", "isqrt"}
    assert all("limits.yaw: is missing" in reason for reason, cores_ in found["refused"].items()
               if "vector_ik6" in cores_) and "isqrt-iter" in found["refused"]["it is no kinematics of an arm"]
    assert re.search("^not .*vector_ik6.*: limits.yaw: is missing", sampled("cores", "--arm", "cobra600"), re.M)


def test_the_accuracy_of_one_core(sampled):
    lines = sampled("accuracy", "vector_fk1", "--arm", "cobra600").splitlines()
    assert lines[0].startswith("vector_fk1-U16 on Omron") and len(lines) == 5
    about = json.loads(sampled("accuracy", "vector_ik6", "--arm", "kr6_r700", "--json"))
    assert about["total_mm"] < 0.1 < about["beside_axis_mm"] and about["total_degrees"] < 0.02
    assert "wrist within 20 mm of axis 1" in sampled("accuracy", "vector_ik6", "--arm", "kr6_r700")


@pytest.mark.parametrize("name", ["arm_fk3", "arm_ik3", "arm_keep2", "arm_keep3", "vector_fk6", "table_fk6",
                                  "vector_ik6", "table_ik6", "vector_ik6_all"])
def test_the_error_of_whole_arms_is_that_of_their_words(name, monkeypatch):
    """About half an LSB a coordinate; a model that is off by 64 LSB in one port is seen."""
    arm = arms.load("kr6_r700")
    core = verilog.fitted(catalogue.find(name), arm, {})
    found = pose.worst(core, arm, 1024)
    assert 0.5 < found.mm / accuracy.mm_per_lsb(core, arm) < 2
    right = pose.modelled

    def off(core, inputs, cfg):
        words = right(core, inputs, cfg)
        port = next(one for one in words if re.fullmatch("out_(x|j2|n2|n20)", one))
        return words | {port: words[port] + 64}

    monkeypatch.setattr(pose, "modelled", off)
    assert pose.worst(core, arm, 1024).mm > 5 * found.mm


@pytest.mark.parametrize(("word", "value", "means"), [
    ("angle:8", "128", "-180.000000 degrees"), ("angle:8", "127", "178.593750 degrees"),
    ("angle:8", "255", "-1.406250 degrees"), ("vector:8", "0,-5", "-90.000000 degrees")])
def test_a_joint_may_be_signed(sampled, word, value, means):
    assert means in sampled("decode", word, value, "--signed")
    assert "count -250" in sampled("decode", "angle:8", "192", "--signed", "--counts", "1000")


@pytest.mark.parametrize("core", {catalogue.title(core): core for core in reversed(cores.all_cores())}.values(),
                         ids=catalogue.title)
def test_parameters_that_the_verilog_refuses_are_refused(core):
    """Each illegal set of the list, also where a module below the core has the rule, or the rule has a constant."""
    for wrong in core.illegal:
        with pytest.raises(Refused, match="is not supported: it needs "):
            catalogue.at(core, wrong)
