"""What `quadrance registers` writes: it elaborates for every core, and stays small."""

import pytest
from pyslang.driver import Driver
from quadrance import cores
from quadrance.cli import registers

from ci import lint, synth

CLOCKED = [core for core in cores.all_cores() if core.clocked]


@pytest.mark.slow
@pytest.mark.parametrize("readback, most", [(True, 150), (False, 50)])
def test_registers_are_small(readback, most):
    core, folder = cores.find("table_ik2"), synth.WORK / f"registers-{readback}"
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "axil_table_ik2.v"
    path.write_text(registers.wrapper(core, "axil", readback=readback))
    whole = synth.area("cyclonev", path.stem, {}, [path, *registers.sources("axil"), *core.sources])
    alone = synth.area("cyclonev", core.name, core.params, core.sources)
    assert whole["lut"] - alone["lut"] <= most and whole["dsp"] == alone["dsp"] and whole["mem"] == alone["mem"]


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
