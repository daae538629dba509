"""AXI-Stream wrappers against the cores' models, driven by cocotbext-axi."""

import re
from dataclasses import replace

import pytest
from quadrance import cores
from quadrance.cli import axis
from quadrance.cli.catalogue import Refused

from tb.lib.simulate import available, simulate
from tb.lib.suite import SEED

SHOWN = "rational_ik2-S24"  # in the regression; the others in the long run
SETS = [core for core in cores.all_cores() if core.name in axis.CHECKED_IN]


def wrapped(core, folder=cores.RTL / "axis"):
    """The wrapper of a core as a top of its own; ports and model stay the core's."""
    return replace(core, name=f"axis_{core.name}", sources=(folder / f"axis_{core.name}.v", *core.sources))


@pytest.mark.skipif(not available("icarus"), reason="Icarus Verilog is not installed")
@pytest.mark.parametrize("core", [pytest.param(
    core, id=core.id, marks=[pytest.mark.slow] * (core.id != SHOWN)) for core in SETS])
def test_wrapper(core):
    simulate(wrapped(core), "icarus", module="tb.axis.bench", seed=SEED)


@pytest.mark.slow
def test_wrapper_in_verilator():
    core = wrapped(cores.find(axis.CHECKED_IN[0]))
    simulate(core, "verilator", module="tb.axis.bench", seed=SEED, waves=True, label="-axis")


@pytest.mark.skipif(not available("icarus"), reason="Icarus Verilog is not installed")
@pytest.mark.parametrize("what, by", [
    pytest.param(r"I_Y = I_X \+", "I_Y = I_X + 1 +", id="field"),
    pytest.param(r"\.out_n2\(n2\)", ".out_n2(n1)", id="output", marks=pytest.mark.slow),
    pytest.param(r"out_ready\(m_axis_tready\)", "out_ready(1'b1)", id="stall", marks=pytest.mark.slow)])
def test_a_broken_wrapper_fails(what, by, tmp_path):
    core = cores.find("vector_ik2")
    text, count = re.subn(what, by, axis.wrapper(core))
    assert count == 1
    if "n1" in by:
        text = text.replace(".out_n1(n1)", ".out_n1()").replace("n2_extended = {{8{n2[", "n2_extended = {{8{n1[")
    (tmp_path / "axis_vector_ik2.v").write_text(text)
    with pytest.raises(SystemExit, match="FAILED"):
        simulate(wrapped(core, tmp_path), "icarus", module="tb.axis.bench", seed=SEED, label="-broken", failures=1)


def test_a_beat_is_packed_in_whole_bytes_and_port_order():
    core = cores.find("rational_ik2")
    words = {"in_x": -2, "in_y": 0x1234, "in_elbow": 1}
    assert axis.pack(core, "in", words) == bytes([0xFE, 0xFF, 0x34, 0x12, 1])
    assert axis.unpack(core, "in", axis.pack(core, "in", words)) == words
    out = {"out_j1": (1 << 26) - 1, "out_j2": 5}
    assert axis.unpack(core, "out", axis.pack(core, "out", out)) == out


@pytest.mark.parametrize("formula, expression", [
    ("W", "W"), ("2*W+2", "(2 * W) + 2"), ("(W+1)//2", "(W + 1) / 2"), ("max(W, S)", "W > S ? W : S"),
    ("3 + (W > 10)", "3 + (W > 10 ? 1 : 0)"), ("-W", "-W")])
def test_a_formula_in_verilog(formula, expression):
    assert axis.verilog_formula(formula).replace("(-W)", "-W") == expression


def test_a_combinational_core_has_no_stream():
    with pytest.raises(Refused, match="isqrt_comb is combinational"):
        axis.wrapper(cores.find("isqrt_comb"))
