"""docs/soc/litex_core.py: a core in a SoC of LiteX, driven over a simulated serial line as a PC drives it."""

import importlib.util
import io
import json
import subprocess
from contextlib import redirect_stdout

import numpy as np
import pytest
from quadrance import arms, cli, cores
from quadrance.cli import verilog
from quadrance.device import Device, WrongDevice

from ci import soc

pytest.importorskip("migen", reason="migen is not installed: pip install litex migen")
pytest.importorskip("litex", reason="litex is not installed: pip install litex migen")
BASE = 0x8000_0000
CLOCKS = 8  # a bit
MAIN = """
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
    top.add_uartbone(baudrate=1e6 / CLOCKS)
    top.ik = module.Registers(platform, folder)
    top.bus.add_slave("ik", top.ik.bus, SoCRegion(origin=BASE, size=0x1000, cached=False))
    top.finalize()
    path = work / "bridge.v"
    path.write_text(str(platform.get_verilog(top, name="bridge")))
    return module, [path, *(folder / source[0] for source in platform.sources)]


@pytest.mark.parametrize("bus", ("axil", "wishbone"))
def test_a_core_behind_the_serial_bridge(bus, tmp_path):
    """Its joints are those of the model, and a map of other parameters is refused."""
    core, hw = cores.find("table_ik2"), tmp_path / "hw"
    with redirect_stdout(io.StringIO()):
        assert not cli.main(["registers", core.name, "--arm", soc.ARM, "--bus", bus, "--out", str(hw)])
    module, files = bridge(hw, tmp_path)
    run = soc.verilated("bridge", "bridge", files, f"#define CLOCKS {CLOCKS}\n{MAIN}")
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


def test_a_folder_without_a_core_is_refused(tmp_path):
    with pytest.raises(ValueError, match="has 0 maps"):
        bridge(tmp_path, tmp_path)
