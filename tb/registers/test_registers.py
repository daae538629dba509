"""Cores behind registers, as `quadrance registers` writes them, against the cores' models and docs/registers.md."""

import re
from dataclasses import replace

import pytest
from quadrance import cores
from quadrance.cli import catalogue, registers

from tb.lib.simulate import available, simulate
from tb.lib.suite import SEED
from tb.registers import page

ICARUS = pytest.mark.skipif(not available("icarus"), reason="Icarus Verilog is not installed")
CLOCKED = [core for core in cores.all_cores() if core.clocked]
DAILY = ["arm_ik3-W12", "engine_quaternion_dls-W16A24", "rotation_check-U16", "classic_ik2-comb-A16",
         "vector_to_half_tangent-U16T16", "half_tangent_to_vector-T16U16", "spread_to_vector-S24U16",
         "vector_to_spread-U16S24", "rational_fk2-W20S36", "rational_ik1-W20S36", "kinematics_engine-N6"]
LONG = ["engine_quaternion_gd_plane-N100"]
ALL = [catalogue.find(name) for name in DAILY + LONG]


def wrapped(core, folder, bus, core_clock=False, broken=lambda text: text):
    """The core behind registers as a top of its own; ports and model stay the core's."""
    paths = []
    for path in (*registers.sources(bus, core_clock), *core.sources):
        paths.append(folder / path.name)
        paths[-1].write_text(broken(path.read_text()))
    path = folder / f"{registers.top(core, bus)}.v"
    path.write_text(broken(registers.wrapper(core, bus, core_clock)))
    return replace(core, name=path.stem, sources=(path, *paths))


def bench(top, label="", **options):
    simulate(top, options.pop("simulator", "icarus"), module="tb.registers.bench", seed=SEED, parameters=False,
             label=label, **options)


@ICARUS
@pytest.mark.parametrize("name", [*DAILY, *(pytest.param(name, marks=pytest.mark.slow) for name in LONG)])
def test_axil(name, tmp_path):
    bench(wrapped(catalogue.find(name), tmp_path, "axil"))


@ICARUS
@pytest.mark.parametrize("name, bus, core_clock", [("arm_ik3-W12", "wishbone", False), ("arm_ik3-W12", "axil", True)])
def test_other_bus_and_clock(name, bus, core_clock, tmp_path):
    bench(wrapped(catalogue.find(name), tmp_path, bus, core_clock), "-clock" * core_clock)


def test_every_kind_of_port_goes_through_a_bench():
    def kinds(some):
        return {(kind, port.type, port.signed, (port.width > 32) - (port.width < 32)) for core in some
                for kind, ports in (("cfg", core.cfg), ("in", core.inputs), ("out", core.outputs)) for port in ports
                if port.name != "out_status"}
    assert kinds(CLOCKED) == kinds(ALL)
    assert {bit for core in ALL for bit in core.status or ()} == set(cores.STATUS_BITS)
    assert any(core.status is None for core in ALL) and any(not core.cfg for core in ALL)


@pytest.mark.parametrize("core", CLOCKED, ids=lambda core: core.id)
def test_the_map_is_that_of_the_page(core):
    assert [(word.address, word.port, word.low, word.width) for word in registers.words(core)] == \
        [(address, port.name, low, width) for address, port, low, width in page.places(core)]


def test_every_map_has_its_own_identity():
    assert len({registers.identity(core) for core in CLOCKED}) == len(CLOCKED)


FAULTS = {  # in the face, the modules around the core and what is generated for arm_ik3: what, by
    "strobe": (r"&wstrb", "|wstrb"), "rdata": (r"if \(arready\) rdata", "rdata"),
    "bvalid": (r"\(!bvalid \|\| bready\)", "1'b1"), "rvalid": (r"rvalid \? !rready", "rvalid ? 1'b0"),
    "busy": (r"put = hit && !busy", "put = hit"), "done": (r"clears && wdata\[1\]", "1'b0"),
    "irq": ("irq = done && irq_enable", "irq = done"), "near": (r"waddr\[9:8\] == 2'd0", "waddr[9] == 1'b0"),
    "refused": (r"write && busy &&", "write && busy && at_start &&"), "last": (r"at < IN", "at <= IN"),
    "index": (r"waddr\[5:0\] >> K == 6'd0", "1'b1"), "clears": (r"clears && wdata\[3\]", "clears"),
    "only-read": (r"at_state \|\| at_irq;", "at_state || at_irq || at_control && at == 0;"),
    "start": (r"!start && ", ""),
    "held": (r"out_c1 <= new_c1", "out_c1 <= new_c2"),
    "high": (r"cfg_q\[33:32\] <= wdata\[1:0\]", "cfg_q[33:32] <= wdata[2:1]"),
    "sign": (r"\{\{(\d+)\{in_x\[\d+\]\}\}", r"{{\1{1'b0}}"), "place": (r"\.in_z\(in_z\)", ".in_z(in_y)"),
    "status": ("out_status, 4'd0", "out_status[3:1], 5'd0"), "version": ("32'h00010000", "32'h00010001")}


@ICARUS
@pytest.mark.slow
@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_is_found(name, tmp_path):
    what, by = FAULTS[name]
    count = 0

    def broken(text):
        nonlocal count
        if not re.search(r"^module (axil_|register_)", text, re.M):  # of the core itself
            return text
        text, here = re.subn(what, by, text)
        count += here
        return text

    top = wrapped(catalogue.find("arm_ik3-W12"), tmp_path, "axil", broken=broken)
    assert count
    with pytest.raises(SystemExit, match="FAILED"):
        bench(top, "-broken", failures=1)
