"""`quadrance registers`: what it writes and what it refuses; the driver, on a bus of Python."""

import json
import re

import pytest
from peakrdl_cheader.exporter import CHeaderExporter
from peakrdl_html import HTMLExporter
from quadrance import arms, cores, device
from quadrance.cli import catalogue, main, registers, verilog
from systemrdl import RDLCompiler


@pytest.fixture
def command(capsys):
    """Run `quadrance registers`; its output, or its one line of refusal where `code` is 2."""
    def run(*arguments, code=0):
        ended = main(["registers", *arguments])
        out, err = capsys.readouterr()
        assert ended == code, err
        if code:
            assert out == "" and err.count("\n") == 1
        return err if code else out
    return run


def test_a_folder_has_everything_and_nothing_is_overwritten(command, tmp_path):
    out = tmp_path / "hw"
    words = ["table_ik2", "--arm", "cobra600", "-p", "A=20", "--core-clock", "--out", str(out)]
    command(*words)
    found = {path.name: path.read_text() for path in out.iterdir()}
    assert {"axil_table_ik2.v", "axil_face.v", "register_control.v", "register_crossing.v", "table_ik2.v",
            "table_ik2.json", "table_ik2.rdl", "axil_table_ik2.xdc", "axil_table_ik2.sdc"} <= found.keys()
    core = catalogue.find("table_ik2", {"A": 20})
    about = json.loads(found["table_ik2.json"])
    assert about["cfg"] == verilog.config(core, arms.load("cobra600"))
    assert f"32'h{about['id']:08x}" in found["axil_table_ik2.v"] and ".A(20)" in found["axil_table_ik2.v"]
    assert f"0x{about['id']:08x}" in found["table_ik2.rdl"]
    command(*words)  # the same again is no loss
    (out / "table_ik2.json").write_text("mine")
    before = {path: path.stat().st_mtime_ns for path in out.iterdir()}
    assert "is another file" in command(*words, code=2)
    assert before == {path: path.stat().st_mtime_ns for path in out.iterdir()}


@pytest.mark.parametrize("arguments, said", [
    (["isqrt_comb"], "isqrt_comb is combinational"), (["table_ik"], "did you mean"),
    (["table_ik2", "--bus", "apb"], "no bus 'apb'; there are axil, wishbone"),
    (["table_ik2", "-p", "A=99"], "it needs"), (["table_ik2", "--arm", "nobody"], "nobody"),
    (["isqrt", "--arm", "cobra600"], "takes no arm"),
    (["table_ik2", "--out", __file__], "is a file, not a folder"),
    (["table_ik2", "--out", "/proc/none/there"], "cannot be written")])
def test_what_cannot_be_made_is_refused_in_a_line(arguments, said, command):
    assert said in command(*arguments, code=2)


def test_constraints_name_registers_that_exist(command, tmp_path):
    command("table_ik2", "--core-clock", "--out", str(tmp_path))
    text = "".join((tmp_path / name).read_text() for name in ("axil_table_ik2.v", "register_crossing.v"))
    for file in ("axil_table_ik2.xdc", "axil_table_ik2.sdc"):
        lists = re.findall(r"(?:get_cells|get_registers) \{(.*?)\}", (tmp_path / file).read_text())
        names = [re.sub(r"(_reg)?\*$", "", re.split(r"[/|]", one)[-1]) for some in lists for one in some.split()]
        assert sorted(names) == ["bus_answer", "bus_clear", "cfg_", "clear", "go", "in_", "out_"]
        for name in names:
            assert re.search(rf"^ .*\breg\b.*\b{name}", text, re.M), name


class Registers:
    """A bus with a device on it that answers by the core's model after two reads of STATE."""

    def __init__(self, core):
        self.core, self.about, self.waits = core, registers.described(core, {}), 0
        self.words = {0x000: self.about["id"], 0x004: 0x10000, 0x00C: 0}

    def read(self, address):
        if address == 0x00C and self.waits:
            self.waits -= 1
            return 1
        return self.words[address]

    def write(self, address, word):
        assert 0 <= word < 1 << 32
        self.words[address] = word
        if address == 0x008:
            ports = {}
            for one in self.about["words"]:
                if one["kind"] != "out":
                    bits = self.words[one["address"]] & (1 << one["width"]) - 1
                    ports[one["port"]] = ports.get(one["port"], 0) | bits << one["low"]
            for port in (*self.core.cfg, *self.core.inputs):
                ports[port.name] = port.low + (ports[port.name] - port.low) % (1 << port.width)
            found = self.core.model(self.core.params, **{name: [value] for name, value in ports.items()})
            for one in self.about["words"]:
                if one["kind"] == "out":
                    self.words[one["address"]] = int(found[one["port"]][0]) >> one["low"] & 0xFFFFFFFF
            self.words[0x00C], self.waits = 2 | int(found["out_status"][0]) << 8, 2


@pytest.mark.parametrize("name", ["table_ik2", "vector_ik2"])
def test_a_device_answers_as_the_model_does(name):
    core = cores.find(name)
    cfg = verilog.config(core, arms.load("cobra600"))
    bus = Registers(core)
    one = device.Device(bus, registers.described(core, cfg))
    one.configure()
    for x, y, elbow in ((19200, -7680, 0), (-9000, 30, 1), (32767, 32767, 0), (1, -32768, 1)):
        want = core.model(core.params, in_x=[x], in_y=[y], in_elbow=[elbow], **cfg)
        assert one.run(x=x, y=y, elbow=elbow) == {key[4:]: int(value[0]) for key, value in want.items()}
    with pytest.raises(ValueError, match="in_x: 40000 does not fit its 16 bits"):
        one.run(x=40000, y=0, elbow=0)
    bus.words[0x00C], bus.write = 1, lambda *_: None
    with pytest.raises(TimeoutError, match="no result after 5 reads of STATE, which is 0x1"):
        one.run(polls=5, x=0, y=0, elbow=0)
    with pytest.raises(device.WrongDevice, match="answers, table_ik3 with"):
        device.Device(bus, registers.described(cores.find("table_ik3"), {}))


def test_memory_is_read_and_written_by_words(tmp_path):
    path = tmp_path / "memory"
    path.write_bytes(bytes(0x5000))
    with device.Memory(path, 0x1040, 0x1000) as bus:
        bus.write(0x008, 0xDEADBEEF)
        assert bus.read(0x008) == 0xDEADBEEF
    assert path.read_bytes()[0x1048:0x104C] == bytes.fromhex("efbeadde")


@pytest.mark.parametrize("readback", [True, False])
@pytest.mark.parametrize("name", ["table_ik2", "vector_to_spread", "engine_quaternion_gd_plane-N100", "rotation_check"])
def test_peakrdl_reads_the_description(name, readback, tmp_path):
    core = catalogue.find(name)
    path = tmp_path / "map.rdl"
    path.write_text(registers.rdl(core, readback))
    compiler = RDLCompiler()
    compiler.compile_file(str(path))
    top = compiler.elaborate().top
    found = {(one.inst_name, one.absolute_address, tuple((field.inst_name, field.low, field.width)
                                                         for field in one.fields())) for one in top.registers()}
    want = {(word.name, word.address, (("value", 0, word.width),)) for word in registers.words(core)}
    want |= {("START", 8, (("start", 0, 1),)), ("IRQ_ENABLE", 16, (("done", 0, 1),)), ("ID", 0, (("id", 0, 32),)),
             ("VERSION", 4, (("version", 0, 32),))}
    state = [("busy", 0, 1), ("done", 1, 1), ("refused", 2, 1), ("outside", 3, 1)]
    state += [(bit, 8 + cores.STATUS_BITS[bit], 1) for bit in sorted(core.status or (), key=cores.STATUS_BITS.get)]
    assert found == want | {("STATE", 12, tuple(state))}
    HTMLExporter().export(top, str(tmp_path / "html"))
    assert (tmp_path / "html" / "index.html").is_file()
    CHeaderExporter().export(top.parent, str(tmp_path / "map.h"))
    assert re.search(r"uint32_t ID;", (tmp_path / "map.h").read_text())
