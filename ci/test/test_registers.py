"""What `quadrance registers` writes: it elaborates for every core, and stays small."""

import pytest
from pyslang.driver import Driver
from quadrance import cores
from quadrance.cli import registers

from ci import lint
from ci.synth.__main__ import registers_of

CLOCKED = [core for core in cores.all_cores() if core.clocked]


@pytest.mark.slow
@pytest.mark.timeout(3600)
@pytest.mark.parametrize("bus", registers.BUSSES)
def test_registers_are_small_and_as_fast(bus):
    """Beside table_ik2: ALUT with and without read-back, no multiplier or memory, a clock within 3 %."""
    found = registers_of(cores.find("table_ik2"), bus)
    for name, most in (("read", 150), ("write", 50)):
        more = found[name]
        assert more["cyclonev"]["lut"] <= most and more["clock"] >= 0.97, more
        assert all(not area.get(key) for area in more.values() if isinstance(area, dict) for key in ("dsp", "mem"))


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
