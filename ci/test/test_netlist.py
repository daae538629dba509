"""Netlists of small cores pass their benches and broken ones fail; our cells equal Yosys' where inputs are known."""

import re
import subprocess

import pytest
from quadrance.cores import find

from ci import cache, netlist
from ci.netlist import FAILED, LATE, LEFT, PASSED, TESTS, Verdict
from tb.lib import tools
from tb.lib.simulate import available
from tb.lib.suite import SEED

pytestmark = [pytest.mark.full, pytest.mark.skipif(not available("icarus"), reason="cell models need Icarus")]

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


@pytest.mark.parametrize(("name", "target"), [("isqrt", "ice40"), ("isqrt", "cyclonev"),
                                              ("rational_ik1", "cyclonev")])
def test_netlist_keeps_reset_latency_and_results(name, target):
    core = find(name)
    made = netlist.synthesise(core, target)
    netlist.bench(core, made, target, f"({TESTS['reset']}|{TESTS['latency']})", SEED)


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


def test_a_test_that_a_core_does_not_have_is_none_that_passed():
    assert list(netlist.tests(find("isqrt"))) == list(TESTS)
    assert list(netlist.tests(find("engine_newton_3r"))) == ["reset", "random"]
    assert list(netlist.tests(find("isqrt_comb"))) == ["random"]


def test_the_page_counts_tests():
    slow = Verdict("a", "ice40", {"lut": 7}, {"reset": PASSED, "random": LATE})
    text = "\n".join(netlist.section([slow, Verdict("b", "ice40", {}, {"reset": FAILED})]))
    assert "2 netlists: 1 tests passed, 1 tests FAILED, 1 tests too slow, 0 tests left out." in text
    assert text.endswith("left out: 1 of ice40.")


def test_cyclone_cells_are_those_of_yosys():
    """Every known input of the tables and the adder, random ones of the flip-flop; and why theirs are not taken."""
    netlist.WORK.mkdir(parents=True, exist_ok=True)
    theirs, bench, program = (netlist.WORK / name for name in ("theirs.v", "compare.v", "compare.vvp"))
    text = "".join((VENDOR / name).read_text() for name in ("alm_sim.v", "dff_sim.v"))
    theirs.write_text((text + BANK).replace("MISTRAL_", "VENDOR_"))
    bench.write_text("`default_nettype wire\n`timescale 1ns/1ps" + BANK + COMPARE)
    tools.run("iverilog", "-g2012", "-s", "compare", "-o", program, netlist.CELLS, theirs, bench)
    assert tools.run("vvp", program).startswith("0 wrong; x and 0 is 0, not x\n")
