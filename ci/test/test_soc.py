"""The system of docs/soc: a CPU's answers are those of the models, and what is wrong is said."""

import numpy as np
import pytest

from ci import soc
from tb.lib import tools

pytestmark = pytest.mark.skipif(bool(soc.missing()), reason=soc.missing() or "complete")
FIRMWARE = (soc.SOC / "firmware.c").read_text()


@pytest.fixture(scope="module")
def sent():
    return soc.answered()


def edited(old, new):
    """A change of one file of the hardware."""
    def edit(text):
        edit.seen += text.count(old)
        return text.replace(old, new)

    edit.seen = 0
    return edit


def test_a_thousand_poses_of_every_core_equal_the_models(sent):
    taken = soc.compared(sent)
    assert [one.mode for one in taken] == ["poll"] * 4 + ["interrupt"] * 4
    for one in taken:
        least, middle, most = one.clocks
        assert (soc.cores.find(one.what.split()[0]).latency or 1) < least <= middle <= most
    statuses = sent.reshape(2, -1)[0][:4 * soc.POSES].reshape(-1, 4)[:, 2]
    assert {0, 1} <= set(statuses.tolist())  # points in reach and out of it


@pytest.mark.parametrize("old, new, said", [
    ("j12 <= in_j1 + in_j2;", "j12 <= in_j1 + in_j2 + 1'b1;", r"table_fk2 by poll: out_x of pose \d+ is"),
    ("known = ran[bank];", "known = ran != 0;", "kinematics_engine by poll: c1 of pose 1 is"),
    ("irq = done && irq_enable;", "irq = 1'b0;", "table_ik2: its interrupt has not come")])
def test_a_fault_of_the_hardware_is_found(old, new, said):
    edit = edited(old, new)
    with pytest.raises(soc.Differs, match=said):
        soc.compared(soc.answered(edit))
    assert edit.seen == 1


@pytest.mark.parametrize("old, new, said", [
    ("soc_send(joints.j1);\n        soc_send(joints.j2);", "soc_send(joints.j2);\n        soc_send(joints.j1);",
     "table_ik2 by poll: out_j1 of pose 0 is"),
    ("soc_send((uint32_t)n2);", "(void)n2;", "words were sent, and"),
    ("if (!table_fk2_probe(FORWARD))", "if (table_fk2_probe(FORWARD))", "table_fk2: it is not there"),
    ("kinematics_engine_load(ENGINE, &camera)", "0", "kinematics_engine: it refused")])
def test_a_fault_of_the_program_is_found(tmp_path, old, new, said):
    assert old in FIRMWARE
    path = tmp_path / "firmware.c"
    path.write_text(FIRMWARE.replace(old, new))
    with pytest.raises(soc.Differs, match=said):
        soc.compared(soc.answered(firmware=path))


@pytest.mark.parametrize("body, said", [
    ("for (;;) { }", "did not end within 20000 clocks"), ('__asm__ volatile (".word 0");', "stopped before its end")])
def test_a_program_that_does_not_end_is_stopped(tmp_path, body, said):
    path, system = tmp_path / "program.c", soc.system(soc.hardware(tmp_path))
    path.write_text(f"int main(void) {{ {body} return 0; }}\n")
    with pytest.raises(RuntimeError, match=said):
        soc.run(system, soc.compiled([path]), 20000)


def test_what_a_board_has_sent_is_compared(tmp_path, sent, capsys):
    path = tmp_path / "capture"
    path.write_bytes(sent.tobytes())
    assert soc.main(["--capture", str(path)]) == 0
    assert "| table_ik2 |" in capsys.readouterr().out
    changed = np.array(sent)
    changed[-3] ^= 8
    path.write_bytes(changed.tobytes())
    with pytest.raises(SystemExit, match="soc: kinematics_engine by interrupt: status of pose 999 is"):
        soc.main(["--capture", str(path)])
    path.write_bytes(b"abc")
    with pytest.raises(SystemExit, match="soc: 0 words were sent, and 30000 make 1000 poses of every core"):
        soc.main(["--capture", str(path)])


def test_a_missing_package_is_named(monkeypatch):
    monkeypatch.setattr(soc, "find_spec", lambda name: None)
    with pytest.raises(SystemExit, match="soc: ziglang and pythondata-cpu-picorv32 missing: pip install ziglang pyth"):
        soc.main([])


def test_the_verilog_has_no_warning(tmp_path):
    """The CPU's own are not ours; register_control compares with no words of configuration."""
    waiver = tmp_path / "cpu.vlt"
    waiver.write_text('`verilator_config\nlint_off -file "*picorv32.v"\n'
                      'lint_off -rule UNSIGNED -file "*register_control.v"\n')
    files = soc.hardware(tmp_path)
    tools.run("verilator", "--lint-only", "-Wall", "-Wno-TIMESCALEMOD", "--top-module", "ulx3s", waiver, soc.SOC / "ulx3s.v",
              soc.SOC / "soc.v", soc.picorv32(), *files)


@pytest.mark.slow
@pytest.mark.parametrize("device", soc.DEVICES)
def test_it_fits_the_board(device):
    """Placed at the board's 25 MHz and packed."""
    found = soc.placed(device)
    assert found.mhz > 25 and all(used <= there for used, there in found.cells.values())
    assert found.bitstream.stat().st_size > 10_000
    assert soc.DEVICES[device] in soc.board_table({device: found})
