"""C programs: on the CPU of docs/soc, whose answers are the models', and of docs/why-not-c.md, which are right."""

import math
import struct

import numpy as np
import pytest
from quadrance import truth, truth_six

from ci import soc, whynot
from ci.whynot import ROWS
from tb.lib import tools

# The system of docs/soc: a CPU's answers are those of the models, and what is wrong is said

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


def test_the_memory_of_a_program_is_that_of_its_loaded_parts():
    """Parts in any order, a gap between them, and one that has no bytes in the file."""
    head = bytearray(52)
    struct.pack_into("<I", head, 28, 52)
    struct.pack_into("<HH", head, 42, 32, 4)
    at = len(head) + 4 * 32
    parts = [(1, at + 8, 0, 0x108, 2, 2), (1, at, 0, 0x100, 4, 4), (1, at, 0, 0x10, 0, 8), (2, at, 0, 0x20, 4, 4)]
    elf = bytes(head) + b"".join(struct.pack("<8I", *part, 0, 0) for part in parts)
    assert soc.loaded(elf + b"abcdefghXY") == b"abcd\0\0\0\0XY"


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
    tools.run("verilator", "--lint-only", "-Wall", "-Wno-TIMESCALEMOD", "--top-module", "ulx3s", waiver,
              soc.SOC / "ulx3s.v", soc.SOC / "soc.v", soc.picorv32(), *files)


@pytest.mark.slow
@pytest.mark.parametrize("device", soc.DEVICES)
def test_it_fits_the_board(device):
    """Placed at the board's 25 MHz and packed."""
    found = soc.placed(device)
    assert found.mhz > 25 and all(used <= there for used, there in found.cells.values())
    assert found.bitstream.stat().st_size > 10_000
    assert soc.DEVICES[device] in soc.board_table({device: found})


# The C program of docs/why-not-c.md: its tips, directions and branches against float64, in both forms

COUNT = 4000
HALF = {"vector": math.sqrt(0.5) * 2.0**-16, "angle": math.pi / 2**18}  # rad that rounding turns a joint by
MATRIX = 3 * 2.0**-17  # rad: of the words of a matrix
STRAIGHT = math.sqrt(2) * 8 * 2.0**-16  # rad: of a wrist that is taken as straight
WELL = 0.1  # sines and distances (share of the reach) from which on a joint's direction is compared


def program(fixed, source):
    """The C program, of another source where one is given."""
    return whynot.library(fixed, source=source or whynot.SOURCE)


def tip_bound(row, fixed):
    """Greatest tip error (mm): rounding of every joint at its lever, of coordinates, and 0.0005 mm of arithmetic."""
    step = HALF["angle" if row.angles else "vector"] * fixed
    if row.name.startswith("fk"):
        return math.sqrt(0.5) / 25.6 * fixed + (0 if row.angles else 600 * 2.0**-16) + 0.0005
    if row.six:
        six, _ = truth_six.load(row.arm.id)
        reach = six.k + six.c4
        plane, across = reach + six.c2 + reach + six.c4, six.a1 + six.c2 + reach + six.c4
        return step * math.hypot(plane, across) + six.c4 * (MATRIX + STRAIGHT) + 0.0005
    reach = row.arm.l1 + row.arm.l2
    return step * math.hypot(reach + row.arm.l2, reach * row.name.startswith("ik3")) + 0.0005


def judged(row, fixed, source=None):
    """What is wrong with the answers to some thousand poses: a list of words, empty where nothing is."""
    words, way = whynot.poses(row, COUNT)
    loaded = program(fixed, source)
    got, flags = whynot.answered(row, fixed, words, way, loaded)
    errors, wrong = whynot.tip_error(row, words, way, got), []
    if np.nanmax(errors) > tip_bound(row, fixed):
        wrong.append(f"tip {np.nanmax(errors):.4f} mm, more than {tip_bound(row, fixed):.4f}")
    batch, _ = whynot.batched(loaded, row, whynot.given_to(row, fixed, words), way)
    batch = whynot.real(row, batch, True) if fixed else batch
    if np.abs(batch - got[:whynot.BATCH]).max() > (0 if fixed else 2e-4):
        wrong.append("the batch answers otherwise")
    if row.name.startswith("fk"):
        return wrong
    given = whynot.real(row, words, False) * 256 * row.arm.mm_per_unit
    if row.six:
        six, _ = truth_six.load(row.arm.id)
        rotation, tip = whynot.real(row, words[:, :9], False).reshape(-1, 3, 3), given[:, 9:]
        if row.name == "ik6_all":
            rotation, tip, way, got = rotation[:, None], tip[:, None], np.arange(8), got.reshape(-1, 8, 12)
        want, out = truth_six.ik6(rotation, tip, six, way)
        theta = got if row.angles else whynot.directions(got)
        turned = np.where(out, 0, truth_six.turned(truth_six.fk6(theta, six)[0], rotation))
        most = 6 * HALF["angle" if row.angles else "vector"] * fixed + 2 * MATRIX + STRAIGHT
        if turned.max() > most:
            wrong.append(f"turned by {turned.max():.2e} rad, more than {most:.2e}")
        near = np.abs(np.sin(want[..., 2] + six.psi)) < WELL
        near |= np.abs(np.sin(want[..., 4])) < WELL
        centre = tip - six.c4 * rotation[..., 2]
        near |= np.hypot(centre[..., 0], centre[..., 1]) < WELL * (six.c2 + six.k)
        told = (flags & 1 != 0) != (out.any(-1) if out.ndim > 1 else out)
    else:
        solve = truth.ik3 if row.name.startswith("ik3") else truth.ik2
        want, out = np.stack(solve(*given.T, row.arm.l1, row.arm.l2, way), -1), np.False_
        theta = got if row.angles else whynot.directions(got)
        near = np.abs(np.sin(want[..., 1])) < WELL
        told = (flags & 1 != 0) != (truth.reach(np.linalg.norm(given, axis=1), 0, row.arm.l1, row.arm.l2) != 0)
    if told.sum() > COUNT / 1000:  # rounding decides at the border
        wrong.append(f"{told.sum()} poses with the wrong flag")
    off = np.where((near | out)[..., None], 0, np.abs(truth.difference(theta, want)))
    if off.max() > 5e-4:
        wrong.append(f"a joint is off by {off.max():.2e} rad")
    return wrong


@pytest.mark.parametrize("fixed", [False, True], ids=["float", "fixed"])
@pytest.mark.parametrize("row", ROWS, ids=[row.name for row in ROWS])
def test_the_c_program_is_right(row, fixed):
    assert judged(row, fixed) == []


FAULTS = {"Newton": ("3u << 28", "7u << 27"), "knot": ("i = 32; i", "i = 33; i"), "root": ("& ~1) - 2", "& ~1) - 1"),
          "elbow": ("s = down ? -s : s;", "s = down ? s : -s;"), "axis 6": ("w2 = mul(n4, n23)", "w2 = mul(n4, c23)"),
          "flipped": ("flipped[7] = -o[7]", "flipped[7] = o[7]"), "arc": ("0.166959334", "0.1669"),
          "sine": ("-0.166666546", "-0.1666"), "batch": ("o[outs]; \\", "o[outs]; if (i == 7) continue; \\")}


@pytest.mark.slow
@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_is_seen(fault, tmp_path):
    old, new = FAULTS[fault]
    text = whynot.SOURCE.read_text()
    assert text.count(old) == 1
    source = tmp_path / "kinematics.c"
    source.write_text(text.replace(old, new))
    assert any(judged(row, True, source) for row in ROWS)


@pytest.mark.slow
def test_the_soft_cpu_answers_the_same(monkeypatch):
    monkeypatch.setattr(whynot, "SIMULATED", {True: 20})
    assert all(worst >= mean > 0 for mean, _, worst in whynot.there(True))
