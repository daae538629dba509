"""AXI-Stream wrappers, as `quadrance axis` prints them, against the cores' models.

Every port kind at widths that are not whole bytes goes through Icarus with beats packed from the page's words
(`tb.axis.beats`); the handshake is driven by cocotbext-axi as well.
"""

import re
from dataclasses import replace

import numpy as np
import pytest
from quadrance import cores
from quadrance.cli import axis, main
from quadrance.cli.catalogue import Refused, at

from tb.axis import beats
from tb.lib import stimulus, tools
from tb.lib.simulate import available, simulate
from tb.lib.suite import SEED

ICARUS = pytest.mark.skipif(not available("icarus"), reason="Icarus Verilog is not installed")
ODD = {  # every port kind of the library at 8 k + 1 bits, by `test_every_port_kind_is_wrapped`
    "arm_fk3": {"W": 9, "F": 1, "U": 15}, "table_ik3r": {"W": 9, "F": 4, "A": 17},
    "rational_ik2": {"W": 9, "F": 4, "S": 15}, "rational_fk2": {"W": 17, "S": 15},
    "half_tangent_to_vector": {"T": 15, "U": 15}, "vector_to_half_tangent": {"T": 15, "U": 15},
    "divide": {"WN": 17, "WD": 9}, "rotation_check": {"U": 15}, "angle_to_vector": {"A": 17, "U": 15}}
SETS = [at(cores.find(name), params) for name, params in ODD.items()]


@pytest.fixture
def printed(capsys):
    """What `quadrance axis CORE` prints."""
    def text(core):
        assert not main(["axis", core.name])
        return capsys.readouterr().out
    return text


def wrapped(core, folder, text):
    """The wrapper of a core as a top of its own; ports and model stay the core's."""
    (folder / f"axis_{core.name}.v").write_text(text)
    return replace(core, name=f"axis_{core.name}", sources=(folder / f"axis_{core.name}.v", *core.sources))


def samples(core, cfg):
    """Corners, among them all statuses that they have, and random words; and the model's answer, by port."""
    rng, corners = np.random.default_rng(SEED), stimulus.corners(core, cfg)
    status = np.atleast_1d(core.model(core.params, **corners, **cfg).get("out_status", 0))
    kinds = [np.flatnonzero(status == kind)[:4] for kind in np.unique(status)]
    pick = np.sort(np.concatenate([rng.integers(0, next(iter(corners.values())).size, 20), *kinds]))
    words = stimulus.joined({name: column[pick] for name, column in corners.items()},
                            stimulus.uniform(core, rng, 20))
    answer = core.model(core.params, **words, **cfg)
    count = next(iter(words.values())).size
    rows = [{name: int(column[i]) for name, column in words.items()} for i in range(count)]
    wants = [{port.name: int(np.broadcast_to(answer[port.name], count)[i]) for port in core.outputs}
             for i in range(count)]
    return rows, wants


def check_beats(core, text, folder):
    """The wrapper's text answers every sample as the model does, field by field of the page's description."""
    rng = np.random.default_rng(SEED)
    configs = stimulus.configs(core, rng)
    cfg = next((one for one in configs if any(port.signed and one[port.name] < 0 for port in core.cfg)), configs[0])
    rows, wants = samples(core, cfg)
    for port in core.outputs:
        if port.signed and port.width % 8:
            assert any(want[port.name] < 0 for want in wants), f"no negative {port.name}: no sign to extend"
    if core.status is not None:
        assert any(f"{want['out_status']:04b}" != f"{want['out_status']:04b}"[::-1] for want in wants)
    sent = [beats.sample(core.inputs, row, rng) for row in rows]
    got = beats.through(core, text, folder, sent, cfg)
    bits = beats.size(core.outputs)
    expected = [(f"{beats.result(core.outputs, want):0{bits}b}",
                 f"{want['out_status']:04b}" if core.status is not None else "-") for want in wants]
    assert len(got) == len(expected), f"{len(got)} results for {len(expected)} samples"
    for i, (found, want) in enumerate(zip(got, expected)):
        assert found == want, f"sample {i} {rows[i]}: {core.name} answers {found}, the page says {want}: {wants[i]}"


@ICARUS
@pytest.mark.parametrize("core", SETS, ids=lambda core: core.id)
def test_beats_are_as_the_page_says(core, printed, tmp_path):
    check_beats(core, printed(core), tmp_path)


def test_every_port_kind_is_wrapped():
    """Of all kinds of words in the library, those of configuration as well, one of 8 k + 1 bits is in `SETS`."""
    def kinds(some, odd):
        return {(kind, port.type, port.signed) for core in some if core.clocked
                for kind, ports in (("cfg", core.cfg), ("in", core.inputs), ("out", core.outputs)) for port in ports
                if port.name != "out_status" and (port.width % 8 == 1 and port.width > 1 or not odd)}
    assert kinds(cores.all_cores(), False) == kinds(SETS, True)
    bits = {cores.STATUS_BITS[name] for core in SETS for name in core.status or ()}
    assert bits == {0, 1, 2, 3} and any(core.status is None for core in SETS)


@ICARUS
@pytest.mark.parametrize("name, what, by", [
    pytest.param("arm_fk3", r"\{8\{y\[W - 1\]\}\}", "{8{1'b0}}", id="sign"),
    pytest.param("vector_to_half_tangent", r"\(T \+ 2 \+ 7\) / 8", "(T + 2 + 6) / 8", id="ninth-bit"),
    pytest.param("rotation_check", r"out_status\(m_axis_tuser\)",
                 "out_status({m_axis_tuser[0], m_axis_tuser[1], m_axis_tuser[2], m_axis_tuser[3]})", id="tuser"),
    pytest.param("arm_fk3", r"I_N2 = I_C2", "I_N2 = 8 + I_C2", id="place")])
def test_a_wrongly_packed_wrapper_fails(name, what, by, printed, tmp_path):
    core = next(core for core in SETS if core.name == name)
    text, count = re.subn(what, by, printed(core))
    assert count
    with pytest.raises(AssertionError, match="the page says"):
        check_beats(core, text, tmp_path)


@ICARUS
@pytest.mark.slow
@pytest.mark.parametrize("core", [core for core in cores.all_cores() if core.clocked and core.first_set],
                         ids=lambda core: core.id)
def test_every_wrapper_elaborates(core, printed, tmp_path):
    (tmp_path / "top.v").write_text(printed(core))
    tools.run("iverilog", "-g2005", "-t", "null", "-s", f"axis_{core.name}", tmp_path / "top.v", *core.sources)


@ICARUS
def test_wrapper(printed, tmp_path):
    core = cores.find("rational_ik2")
    simulate(wrapped(core, tmp_path, printed(core)), "icarus", module="tb.axis.bench", seed=SEED)


@pytest.mark.slow
def test_wrapper_in_verilator(printed, tmp_path):
    core = cores.find("vector_ik2")
    simulate(wrapped(core, tmp_path, printed(core)), "verilator", module="tb.axis.bench", seed=SEED, waves=True,
             label="-axis")


@ICARUS
@pytest.mark.parametrize("what, by", [
    pytest.param(r"I_Y = I_X \+", "I_Y = I_X + 1 +", id="field", marks=pytest.mark.slow),
    pytest.param(r"\.out_n2\(n2\)", ".out_n2(n1)", id="output", marks=pytest.mark.slow),
    pytest.param(r"out_ready\(m_axis_tready\)", "out_ready(1'b1)", id="stall", marks=pytest.mark.slow)])
def test_a_broken_wrapper_fails(what, by, tmp_path):
    core = cores.find("vector_ik2")
    text, count = re.subn(what, by, axis.wrapper(core))
    assert count == 1
    if "n1" in by:
        text = text.replace(".out_n1(n1)", ".out_n1()").replace("n2_extended = {{8{n2[", "n2_extended = {{8{n1[")
    with pytest.raises(SystemExit, match="FAILED"):
        simulate(wrapped(core, tmp_path, text), "icarus", module="tb.axis.bench", seed=SEED, label="-broken",
                 failures=1)


def test_the_example_of_the_page():
    """x in bits 15:0, y in 31:16, the elbow in bit 32."""
    ports = cores.find("rational_ik2").inputs
    assert [(port.name, at) for port, at, _ in beats.places(ports)] == [("in_x", 0), ("in_y", 16), ("in_elbow", 32)]
    assert beats.result(ports, {"in_x": -2, "in_y": 0x1234, "in_elbow": 1}) == 0x11234FFFE


@pytest.mark.parametrize("formula, expression", [
    ("W", "W"), ("2*W+2", "(2 * W) + 2"), ("(W+1)//2", "(W + 1) / 2"), ("max(W, S)", "W > S ? W : S"),
    ("3 + (W > 10)", "3 + (W > 10 ? 1 : 0)"), ("-W", "-W")])
def test_a_formula_in_verilog(formula, expression):
    assert axis.verilog_formula(formula).replace("(-W)", "-W") == expression


def test_a_combinational_core_has_no_stream():
    with pytest.raises(Refused, match="isqrt_comb is combinational"):
        axis.wrapper(cores.find("isqrt_comb"))
