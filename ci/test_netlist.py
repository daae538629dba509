"""Netlists of small cores pass their benches, broken ones do not; our cells are Yosys' where inputs are known."""

import re

import pytest
from quadrance.cores import find

from ci import netlist
from ci.netlist import FAILED, LATE, PASSED, TESTS
from tb.lib import tools
from tb.lib.simulate import available
from tb.lib.suite import SEED

pytestmark = [pytest.mark.full, pytest.mark.skipif(not available("icarus"), reason="cell models need Icarus")]

VENDOR = netlist.SHARE / "intel_alm" / "common"
TABLES = (0xcafe_1234_9669_8000, 0x5a3c_0ff1_7fe0_1ead)  # a look-up table takes as many bits as it has
WIDTHS = {2: "BA", 3: "CBA", 4: "DCBA", 5: "EDCBA", 6: "FEDCBA"}


@pytest.mark.parametrize(("name", "target"), [("isqrt_iter", "ice40"), ("isqrt_iter", "cyclonev"),
                                              ("rational_fk1", "cyclonev"), ("classic_fk1_iter", "cyclonev")])
def test_netlist_keeps_reset_latency_and_results(name, target):
    core = find(name)
    made = netlist.synthesise(core, target)
    netlist.bench(core, made, target, f"({TESTS['reset']}|{TESTS['latency']})", SEED)


@pytest.mark.parametrize("target", netlist.TARGETS)
def test_an_inverted_bit_fails(target, tmp_path):
    """The output of one look-up table is inverted."""
    core = find("isqrt_iter")
    text = netlist.synthesise(core, target).read_text()
    found = re.search(r"\.LUT(?:_INIT)?\(16'h([0-9a-f]+)\)", text)
    broken = tmp_path / "broken.v"
    broken.write_text(f"{text[:found.start(1)]}{int(found[1], 16) ^ 0xffff:04x}{text[found.end(1):]}")
    with pytest.raises(SystemExit, match="FAILED"):
        netlist.bench(core, broken, target, TESTS["latency"], SEED)


@pytest.mark.parametrize("target", netlist.TARGETS)
def test_the_zero_at_power_up_is_no_reset(target, tmp_path):
    """A netlist whose control flip-flops have no reset: with theirs at 0 from power-up it would pass."""
    core = find("isqrt_iter")
    text = netlist.synthesise(core, target).read_text()
    broken = tmp_path / "broken.v"
    broken.write_text(re.sub(r"\.(R|SCLR)\(rst\)", r".\1(1'h0)", text))
    assert broken.read_text() != text
    with pytest.raises(SystemExit, match="FAILED"):
        netlist.bench(core, broken, target, TESTS["reset"], SEED)


def test_a_slow_netlist_is_named(monkeypatch):
    monkeypatch.setattr(netlist, "LIMIT", 1)
    verdict = netlist.judge("classic_fk1_iter", "cyclonev", SEED)
    assert list(verdict.results.values())[-1] == LATE and FAILED not in verdict.results.values()
    assert "more than 1 s of Icarus" in verdict.why
    assert set(list(verdict.results.values())[:-1]) <= {PASSED}


def _pairs() -> tuple[list[str], list[str]]:
    """Instances of each cell in both models, and the comparisons of their outputs."""
    cells, same = [], []
    words = {n: [f"{1 << n}'h{word & (1 << (1 << n)) - 1:x}" for word in TABLES] for n in WIDTHS}
    for n, names in WIDTHS.items():
        for i, word in enumerate(words[n]):
            plugs = ", ".join(f".{pin}(bits[{at}])" for at, pin in enumerate(reversed(names)))
            for model in ("MISTRAL", "VENDOR"):
                cells.append(f"wire {model}_{n}_{i}; {model}_ALUT{n} #(.LUT({word})) a_{model}_{n}_{i} "
                             f"({plugs}, .Q({model}_{n}_{i}));")
            same.append(f"MISTRAL_{n}_{i} !== VENDOR_{n}_{i}")
    for model in ("MISTRAL", "VENDOR"):
        cells += [f"wire {model}_s, {model}_c, {model}_q, {model}_n; {model}_ALUT_ARITH #(.LUT0({words[4][0]}), "
                  f".LUT1({words[4][1]})) b_{model} (.A(bits[0]), .B(bits[1]), .C(bits[2]), .D0(bits[3]), "
                  f".D1(bits[4]), .CI(bits[5]), .SO({model}_s), .CO({model}_c)); "
                  f"{model}_NOT d_{model} (.A(bits[0]), .Q({model}_n));",
                  f"{model}_FF e_{model} (.DATAIN(bits[0]), .CLK(clk), .ACLR(clear), .ENA(bits[1]), .SCLR(bits[2]), "
                  f".SLOAD(bits[3]), .SDATA(bits[4]), .Q({model}_q));"]
    return cells, same + [f"MISTRAL_{pin} !== VENDOR_{pin}" for pin in "scqn"]


def test_cyclone_cells_are_those_of_yosys():
    """Every defined input of the look-up tables and the adder, random ones of the flip-flop after a clear."""
    cells, same = _pairs()
    netlist.WORK.mkdir(parents=True, exist_ok=True)
    vendor, bench, program = (netlist.WORK / name for name in ("vendor.v", "cells_tb.v", "cells.vvp"))
    vendor.write_text("".join((VENDOR / name).read_text() for name in ("alm_sim.v", "dff_sim.v"))
                      .replace("MISTRAL_", "VENDOR_"))
    bench.write_text("\n".join([
        "`timescale 1ns/1ps", "module bench; reg [5:0] bits; reg clk, clear; integer i, wrong;", *cells,
        "initial begin wrong = 0; clk = 0; clear = 1; #1 clear = 0; #1 clear = 1;",
        "for (i = 0; i < 5000; i = i + 1) begin", "bits = i < 64 ? i : $random; #1 clk = 1; #1;",
        f"if ({' || '.join(same)}) wrong = wrong + 1;", "clk = 0; if (i % 7 == 0) clear = 0; #1 clear = 1; end",
        '$display("wrong %0d", wrong);',
        "bits = 6'b00xx00; #1; $display(\"undefined %b %b\", MISTRAL_4_0, VENDOR_4_0); end endmodule"]))
    tools.run("iverilog", "-g2012", "-s", "bench", "-o", program, bench, vendor, netlist.CELLS)
    assert tools.run("vvp", program).split("\n")[:2] == ["wrong 0", "undefined 0 x"]
