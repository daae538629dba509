"""Cores behind registers elaborate, stay small, do what docs/registers.md says, and answer a PC through LiteX."""

import importlib.util
import io
import json
import struct
import subprocess
from contextlib import redirect_stdout
from importlib.util import find_spec

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pyslang.driver import Driver
from quadrance import arms, cli, cores
from quadrance.cli import registers, verilog
from quadrance.device import Device, WrongDevice

from ci import lint, soc
from ci.synth.__main__ import registers_of
from tb.registers import page

# What `quadrance registers` writes

CLOCKED = [core for core in cores.all_cores() if core.clocked]


@pytest.mark.slow
@pytest.mark.timeout(3600)
def test_registers_are_small_and_as_fast():
    """Beside table_ik2: ALUT with and without read-back, no multiplier or memory; a clock within 3 %."""
    found = registers_of(cores.find("table_ik2"), "axil")
    assert found["read"]["cyclonev"]["lut"] <= 150 and found["write"]["cyclonev"]["lut"] <= 50, found
    assert found["read"]["clock"] >= 0.97 and found["write"]["clock"] >= 0.97, found
    assert not any(area.get(key) for one in found.values() for area in one.values() if isinstance(area, dict)
                   for key in ("dsp", "mem"))


@pytest.mark.parametrize("bus, core_clock", [("axil", False), ("wishbone", True)])
def test_every_core_elaborates(bus, core_clock, tmp_path):
    """Every core at every set behind both faces: slang sees no width that does not fit."""
    files, tops = dict.fromkeys(registers.sources(bus, core_clock)), {}
    for core in CLOCKED:
        name, text = f"top_{len(tops)}", registers.wrapper(core, bus, core_clock, readback=not core_clock)
        assert max(map(len, text.splitlines())) <= 120
        tops[name] = text.replace(f"module {registers.top(core, bus)} (", f"module {name} (")
        files |= dict.fromkeys(core.sources)
    path = tmp_path / "tops.v"
    path.write_text("".join(tops.values()))
    assert complaints([*files, path], tops) == ""
    path.write_text(path.read_text().replace("core_clk" if core_clock else "[11:0] s_axil_awaddr", "[10:0] s", 1))
    assert complaints([*files, path], tops) != ""


def complaints(files, tops):
    driver = Driver()
    driver.addStandardArgs()
    words = ["slang", "--std", "1364-2005", "-Wno-shift-count-overflow", "-Wport-width-expand", "-Wport-width-trunc",
             *(f"--top {name}" for name in tops), *(f'"{path}"' for path in files)]
    assert driver.parseCommandLine(" ".join(words)) and driver.processOptions() and driver.parseAllSources()
    return lint.complaints(driver, driver.createCompilation())[1]


# Any accesses, against the page (`tb.registers.page`)

WRITE, READ, WAIT, RESET, END = range(5)
BUSY, DONE, REFUSED, OUTSIDE = 1, 2, 4, 8
CLOCKS = 12  # most of one access, pauses of the master included
MAIN = """
#include <cstdint>
#include <cstdio>
#include <memory>
#include "Vtop.h"
#include "verilated.h"
#include "pins.h"
struct Order { uint8_t kind, bytes; uint16_t address; uint32_t data; uint8_t early, late, pause, none; };
struct Answer { uint32_t data; uint16_t clocks; uint8_t wrong, irq; };
auto top = std::make_unique<Vtop>();
int now = 0;
static void clock_edge() {
    for (int level : {1, 0})
        for (int i = 0; i < 5; i++) {
            if (i == 0) CLK = level;
            CORE_CLK(now++ / CORE_HALF & 1);
            top->eval();
        }
}
static Answer access(const Order &one) {
    Answer answer = {0, 0, 0, 0};
#ifdef AXIL
    bool first = true, second = one.kind == 0, last = true;
    for (; first || second || last; answer.clocks++) {
        int at = answer.clocks;
        if (at > 100) { answer.wrong = 2; break; }
        auto &valid = one.kind == 0 ? top->s_axil_awvalid : top->s_axil_arvalid;
        auto &ready = one.kind == 0 ? top->s_axil_bready : top->s_axil_rready;
        (one.kind == 0 ? top->s_axil_awaddr : top->s_axil_araddr) = first ? one.address : ~one.address;
        valid = first && at >= one.early;
        top->s_axil_wvalid = second && at >= one.late;
        top->s_axil_wdata = second ? one.data : ~one.data;
        top->s_axil_wstrb = one.bytes;
        ready = at >= one.pause;
        top->eval();
        bool taken = valid && (one.kind == 0 ? top->s_axil_awready : top->s_axil_arready);
        bool data = top->s_axil_wvalid && top->s_axil_wready;
        bool given = ready && (one.kind == 0 ? top->s_axil_bvalid : top->s_axil_rvalid);
        if (given && (first || second)) answer.wrong = 3;
        if (given) {
            answer.data = one.kind == 0 ? 0 : top->s_axil_rdata;
            answer.wrong |= one.kind == 0 ? top->s_axil_bresp : top->s_axil_rresp;
        }
        clock_edge();
        first &= !taken;
        second &= !data;
        last &= !given;
        valid = top->s_axil_wvalid = 0;
    }
    top->s_axil_bready = top->s_axil_rready = 0;
#else
    top->cyc_i = top->stb_i = 1;
    top->we_i = one.kind == 0;
    top->adr_i = one.address >> 2;
    top->dat_i = one.data;
    top->sel_i = one.bytes;
    for (bool given = false; !given; answer.clocks++) {
        if (answer.clocks > 100) { answer.wrong = 2; break; }
        top->eval();
        given = top->ack_o;
        answer.data = one.kind == 0 ? 0 : top->dat_o;
        clock_edge();
    }
    top->cyc_i = top->stb_i = 0;
    for (int i = 0; i < one.early; i++) clock_edge();
#endif
    return answer;
}
int main() {
    Order one;
    RESET(1);
    for (int i = 0; i < 50; i++) clock_edge();
    RESET(0);
    while (fread(&one, sizeof one, 1, stdin) == 1) {
        Answer answer = {0, 0, 0, 0};
        if (one.kind < 2) answer = access(one);
        for (uint32_t i = 0; one.kind == 2 && i < one.data; i++) clock_edge();
        if (one.kind == 3) {
            RESET(1);
            clock_edge();
            RESET(0);
        }
        top->eval();
        answer.irq = top->irq;
        fwrite(&answer, sizeof answer, 1, stdout);
        if (one.kind == 4) fflush(stdout);
    }
}
"""


class Dut:
    """A core behind registers, Verilated, as a process that takes lists of accesses."""

    def __init__(self, core, bus, folder, core_clock=False, readback=True, broken=lambda text: text):
        self.core, self.readback = core, readback
        files = []
        for path in (*registers.sources(bus, core_clock), *core.sources):
            files.append(folder / path.name)
            files[-1].write_text(broken(path.read_text()) if path.parent.name == "bus" else path.read_text())
        files.append(folder / "top.v")
        text = registers.wrapper(core, bus, core_clock, readback)
        text = text.replace(f"module {registers.top(core, bus)} (", "module top (")
        files[-1].write_text(broken(text))
        axil = bus == "axil"
        pins = ["#define AXIL"] * axil + [
            f"#define CLK top->{'aclk' if axil else 'clk_i'}", "#define CORE_HALF 13",
            f"#define CORE_CLK(x) {'top->core_clk = (x)' if core_clock else '(void)(x)'}",
            f"#define RESET(x) {'top->aresetn = !(x)' if axil else 'top->rst_i = (x)'}"]
        run = soc.verilated("writes", "top", files, MAIN.replace('#include "pins.h"', "\n".join(pins)))
        self.process = subprocess.Popen([run], stdin=subprocess.PIPE, stdout=subprocess.PIPE)

    def __call__(self, orders):
        """(data, clocks, wrong, irq) of each (kind, bytes, address, data, pauses of address, data and answer)."""
        data = b"".join(struct.pack("<BBHIBBBx", *one) for one in [*orders, (END, 0, 0, 0, 0, 0, 0)])
        self.process.stdin.write(data)
        self.process.stdin.flush()
        found = self.process.stdout.read(8 * (len(orders) + 1))
        return list(struct.iter_unpack("<IHBB", found))[:-1]


class Page:
    """What the page says of each access; `busy` is known from reads of STATE before and after it."""

    def __init__(self, core, readback=True):
        self.core, self.readback = core, readback
        self.places = {address: (port, low, width) for address, port, low, width in page.places(core)}
        self.words = {address: 0 for address, (port, *_) in self.places.items() if not port.name.startswith("out_")}
        self.results = None  # words of the last result by address: undefined before the first
        self.sample, self.samples = None, []
        self.state, self.irq, self.status = 0, 0, 0

    def ports(self, kind):
        found = {}
        for address, (port, low, _) in self.places.items():
            if port.name.startswith(kind):
                found[port.name] = found.get(port.name, 0) | self.words[address] << low
        return {port.name: port.low + (found[port.name] - port.low) % (1 << port.width)
                for port in (*self.core.cfg, *self.core.inputs) if port.name in found}

    def finished(self):
        """The result of the sample that was inside, by the core's model, held words of earlier ones included.

        Not of links that together are longer than coordinates can be: there a core may wrap in its own way.
        """
        self.samples.append(self.sample)
        if any(abs(self.sample[port.name]) >> port.width - 2 - port.signed for port in self.core.cfg):
            self.results, self.status = None, None
            return
        columns = {name: np.array([one[name] for one in self.samples]) for name in self.sample}
        answer = {name: int(np.broadcast_to(column, (len(self.samples),))[-1])
                  for name, column in self.core.model(self.core.params, **columns).items()}
        self.results = {address: page.register(port, answer[port.name], low, width)
                        for address, (port, low, width) in self.places.items() if port.name in answer}
        self.status = answer.get("out_status", 0)

    def reset(self, busy):
        """The sample that is inside is dropped; its words may be in the registers of the result already."""
        self.state, self.irq, self.status, self.samples, self.sample = 0, 0, 0, [], None
        self.results = self.results if busy is False else None

    def write(self, address, whole, data, busy):
        """State after a write, but for `busy` and what a result brings; whether it starts a sample."""
        address &= 0xFFC
        if not whole or address not in (*self.words, page.START, page.STATE, page.IRQ_ENABLE):
            self.state |= OUTSIDE | (REFUSED if busy else 0)
        elif address == page.STATE:
            self.state &= ~(data & (DONE | REFUSED | OUTSIDE))
        elif address == page.IRQ_ENABLE:
            self.irq = data & 1
        elif busy:
            self.state |= REFUSED
        elif address == page.START:
            self.state &= ~DONE
            self.sample = self.ports("cfg") | self.ports("in")
            return True
        else:
            self.words[address] = data & (1 << self.places[address][2]) - 1
        return False

    def read(self, address):
        """What a register reads; None where the page does not say."""
        address &= 0xFFC
        if not self.readback and address in (*self.words, page.IRQ_ENABLE):
            return None
        if address in self.words:
            port, low, width = self.places[address]
            return page.register(port, self.words[address] << low, low, width)
        if address in self.places:
            return self.results and self.results[address]
        return {page.ID: registers.identity(self.core), page.VERSION: page.MAP_VERSION,
                page.IRQ_ENABLE: self.irq}.get(address)


def accesses(core):
    """A list of accesses: samples that are run, and words, controls and anything else; parts of words; pauses; resets.
    """
    known = [address for address, *_ in page.places(core)]
    controls = (page.ID, page.VERSION, page.START, page.START, page.STATE, page.STATE, page.IRQ_ENABLE, page.IRQ_ENABLE)
    address = st.one_of(st.sampled_from(known), st.sampled_from(controls), st.integers(0, 0xFFF),
                        st.sampled_from([one for one, _ in page.outside(core)]))
    data = st.one_of(st.integers(0, (1 << 32) - 1), st.sampled_from((0, 1, 2, 14, 0x7FFF, 0x8000, 0xFFFFFFFF)))
    pauses = [st.sampled_from((0, 0, 0, 1, 3))] * 3
    whole = st.sampled_from([15] * 9 + [0, 7, 8, 1])
    one = st.tuples(st.sampled_from([WRITE] * 8 + [READ] * 2 + [WAIT] * 2 + [RESET]), whole, address, data, *pauses)
    word = st.tuples(st.just(WRITE), st.just(15), st.sampled_from(known), data, *pauses)
    run = st.tuples(st.lists(word, max_size=6), st.integers(0, 400)).map(
        lambda some: [*some[0], (WRITE, 15, page.START, 1, 0, 0, 0), (WAIT, 0, 0, some[1], 0, 0, 0)])
    return st.lists(st.one_of(one.map(lambda some: [some]), one.map(lambda some: [some]), run), max_size=30).map(
        lambda some: sum(some, []))


def planned(said, some):
    """The accesses from a reset and known words on, each with a read of STATE and of the word that was written.

    REFUSED is cleared before a start, and before each write where none can be read: with it, STATE would not say
    whether the write was refused.
    """
    free = (0, 0, 0)
    yield from [(RESET, 0, 0, 0, *free), (WAIT, 0, 0, 30, *free)]
    for address in said.words:
        yield WRITE, 15, address, 0, *free
    yield READ, 15, page.STATE, 0, *free
    for kind, whole, address, data, *pauses in some:
        if kind == WRITE and (address & 0xFFC == page.START or not said.readback):
            yield from [(WRITE, 15, page.STATE, REFUSED, *free), (READ, 15, page.STATE, 0, *free)]
        yield kind, whole, address, data % 401 if kind == WAIT else data, *pauses
        yield READ, 15, page.STATE, 0, *free
        if kind == WRITE and address & 0xFFC in said.words:
            yield READ, 15, address & 0xFFC, 0, *free
    yield WAIT, 0, 0, 6000, *free
    for address in (page.STATE, *said.places, page.ID, page.VERSION, page.IRQ_ENABLE, page.STATE):
        yield READ, 15, address, 0, *free


def refused(said, busy, after, write, found, read):
    """Whether a write was while busy: as STATE says, or by the word, read after it, where REFUSED was set before."""
    address, whole, data = write
    control = address & 0xFFC
    if whole and control in (page.STATE, page.IRQ_ENABLE):
        return False
    if said.state & REFUSED:
        return busy and not (control in said.words and read != said.read(control))
    held = bool(found & REFUSED)
    assert not held or busy is not False, "a write was refused while nothing was busy"
    assert held or not (busy and after) or control == page.START, "a write while busy was not refused"
    return held


def check(dut, some):
    """Play accesses, and compare every answer with the page; `busy` is None where it is not known."""
    said = Page(dut.core, dut.readback)
    plan = list(planned(said, some))
    answers = dut(plan)
    busy, write = False, None
    for i, (order, (found, clocks, wrong, irq)) in enumerate(zip(plan, answers)):
        kind, whole, address, data, *_ = order
        word, at = address & 0xFFC, f"access {i}, {order}"
        assert not wrong and clocks <= CLOCKS, f"{at}: {wrong}, {clocks} clocks"
        if kind == RESET:
            said.reset(busy)
            busy, write = None, None  # a core in its own clock is busy for a while
        elif kind == WRITE:
            write = address, whole == 15, data
        elif kind == READ and word == page.STATE:
            after = bool(found & BUSY)
            held = write is not None and refused(said, busy, after, write, found, answers[min(i + 1, len(plan) - 1)][0])
            starts = write is not None and not held and write[1] and write[0] & 0xFFC == page.START
            cleared = write is not None and write[0] & 0xFFC == page.STATE and write[1] and write[2] & DONE
            ends = said.sample is not None and busy and (not after or starts)
            if ends:
                said.finished()
            if write is not None:
                said.write(*write, held)
            if starts and not after:  # it has ended again
                said.finished()
                ends = True
            elif not starts and not busy and busy is not None:
                assert not after, f"{at}: busy without a start"
            if ends and not (starts and after):
                said.state |= found & DONE if cleared else DONE
            busy, write = after, None
            want = said.state | after | (said.status or 0) << 8
            # the status of the next result may be there before it is done
            mask = 0xFFFFF0FF if after or said.status is None else 0xFFFFFFFF
            assert found & mask == want & mask, f"{at}: STATE is {found:#x}, not {want:#x}"
            assert busy or irq == (bool(said.state & DONE) and said.irq), f"{at}: irq is {irq}"
        elif kind == READ and (want := said.read(word)) is not None and (not busy or word in said.words):
            assert found == want, f"{at}: {found:#x}, not {want:#x}"
    assert not busy


VARIANTS = {"axil": ("classic_fk3", "axil"), "wishbone": ("vector_fk6", "wishbone"),
            "clock": ("classic_fk3", "axil", True), "wide": ("arm_ik3-W12", "axil"),
            "write-only": ("arm_ik3-W12", "wishbone", True, False)}
LONG = [pytest.mark.slow, pytest.mark.timeout(7200)]


@pytest.mark.parametrize(("name", "examples"), [
    ("axil", 150), ("wishbone", 50), *(pytest.param(name, 10_000, marks=LONG) for name in VARIANTS)])
def test_any_accesses_do_what_the_page_says(name, examples, tmp_path):
    core, *how = VARIANTS[name]
    dut = Dut(cores.find(core), how[0], tmp_path, *how[1:])
    settings(max_examples=examples, deadline=None)(given(accesses(dut.core))(lambda some: check(dut, some)))()
    dut.process.kill()


# docs/soc/litex_core.py: a core in a SoC of LiteX, driven over a simulated serial line as a PC drives it

litex = pytest.mark.skipif(not (find_spec("migen") and find_spec("litex")),
                           reason="litex or migen is not installed: pip install litex migen")
BASE = 0x8000_0000
BIT = 8  # clocks of a bit
SERIAL = """
#include <poll.h>
#include <unistd.h>
#include <memory>
#include "Vbridge.h"
#include "verilated.h"
int main() {    // bytes of the standard input to the serial line, and back, until the input ends
    auto top = std::make_unique<Vbridge>();
    int out = 1, outs = 0, in = 0, age = -1;
    for (unsigned clock = 0;; clock++) {
        if (clock % CLOCKS == 0 && clock > 64) {
            pollfd ready = {0, POLLIN, 0};
            unsigned char byte;
            if (!outs && poll(&ready, 1, 0) > 0) {
                if (read(0, &byte, 1) != 1) return 0;
                out = 0x200 | byte << 1;
                outs = 10;
            } else if (!outs) {
                out = 1;
            }
        }
        top->rst = clock < 8;
        top->serial_rx = out & 1;
        if (clock % CLOCKS == CLOCKS - 1 && outs) { out >>= 1; outs--; }
        top->clk = 0;
        top->eval();
        top->clk = 1;
        top->eval();
        if (clock < 64 || (age < 0 && top->serial_tx)) continue;
        if (++age % CLOCKS != CLOCKS / 2) continue;
        if (age / CLOCKS == 9) {
            unsigned char byte = in >> 1;
            if (write(1, &byte, 1) != 1) return 1;
            age = -1;
        } else {
            in = in >> 1 | top->serial_tx << 8;
        }
    }
}
"""


def bridge(folder, work):
    """The Verilog of a SoC without a CPU: LiteX's serial bridge and the core."""
    spec = importlib.util.spec_from_file_location("litex_core", soc.SOC / "litex_core.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    from litex.build.generic_platform import GenericPlatform, Pins, Subsignal
    from litex.gen import LiteXModule
    from litex.soc.integration.soc import SoCRegion
    from litex.soc.integration.soc_core import SoCMini
    from migen import ClockDomain

    class Clock(LiteXModule):
        def __init__(self, platform):
            self.cd_sys = ClockDomain()
            self.comb += [self.cd_sys.clk.eq(platform.request("clk")), self.cd_sys.rst.eq(platform.request("rst"))]

    platform = GenericPlatform("none", [("clk", 0, Pins(1)), ("rst", 0, Pins(1)),
                                        ("serial", 0, Subsignal("tx", Pins(1)), Subsignal("rx", Pins(1)))])
    top = SoCMini(platform, int(1e6))
    top.crg = Clock(platform)
    top.add_uartbone(baudrate=1e6 / BIT)
    top.ik = module.Registers(platform, folder)
    top.bus.add_slave("ik", top.ik.bus, SoCRegion(origin=BASE, size=0x1000, cached=False))
    top.finalize()
    path = work / "bridge.v"
    path.write_text(str(platform.get_verilog(top, name="bridge")))
    return module, [path, *(folder / source[0] for source in platform.sources)]


@litex
@pytest.mark.parametrize("bus", ("axil", "wishbone"))
def test_a_core_behind_the_serial_bridge(bus, tmp_path):
    """Its joints are those of the model, and a map of other parameters is refused."""
    core, hw = cores.find("table_ik2"), tmp_path / "hw"
    with redirect_stdout(io.StringIO()):
        assert not cli.main(["registers", core.name, "--arm", soc.ARM, "--bus", bus, "--out", str(hw)])
    module, files = bridge(hw, tmp_path)
    run = soc.verilated("bridge", "bridge", files, f"#define CLOCKS {BIT}\n{SERIAL}")
    rng = np.random.default_rng(3)
    points = rng.integers(-(1 << 14), 1 << 14, (20, 2)).tolist()
    with subprocess.Popen([run], stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0, cwd=hw) as process:
        stream = io.BufferedRWPair(process.stdout, process.stdin)
        about = json.loads((hw / "table_ik2.json").read_text())
        ik = Device(module.SerialBridge(stream, BASE), about)
        ik.configure()
        found = [ik.run(x=x, y=y, elbow=i & 1) for i, (x, y) in enumerate(points)]
        with pytest.raises(WrongDevice):
            Device(module.SerialBridge(stream, BASE), about | {"id": 1})
        process.stdin.close()
    x, y = np.array(points).T
    want = core.model(core.params, in_x=x, in_y=y, in_elbow=np.arange(20) & 1,
                      **verilog.config(core, arms.load(soc.ARM)))
    for name in ("j1", "j2", "status"):
        assert [one[name] for one in found] == want[f"out_{name}"].tolist()


@litex
def test_a_folder_without_a_core_is_refused(tmp_path):
    with pytest.raises(ValueError, match="has 0 maps"):
        bridge(tmp_path, tmp_path)
