"""Manifests: they follow from the list, and FuseSoC builds and simulates from them outside the repository."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from quadrance import cores
from quadrance.cli import verilog

from ci import packages
from tb.lib import stimulus, tools
from tb.lib.simulate import available

FAMILIES = list(dict.fromkeys(core.family for core in cores.all_cores()))
SHOWN = "vector"  # in the regression; the other families in the long run and in CI


def clocked(family):
    """The first core of a family that has a clock."""
    return next(core for core in cores.all_cores() if core.family == family and core.clocked)


def test_the_manifests_that_are_checked_in_are_fresh():
    assert packages.stale() == []


def test_a_changed_a_missing_and_an_odd_manifest_are_stale(monkeypatch, tmp_path):
    wanted = {"Bender.yml": "right\n", "rtl/lists/gone.f": "x\n"}
    monkeypatch.setattr(packages.tools, "ROOT", tmp_path)
    monkeypatch.setattr(packages, "manifests", lambda: wanted)
    monkeypatch.setattr(packages, "present", lambda: {"rtl/lists/old.f"})
    (tmp_path / "Bender.yml").write_text("wrong\n")
    names = [line.partition(":")[0] for line in packages.stale()]
    assert names == ["Bender.yml", "rtl/lists/gone.f", "rtl/lists/old.f"]


def test_every_file_has_one_owner_and_comes_after_what_it_needs():
    everything = packages.folders()
    files = [path for some, _ in everything.values() for path in some]
    assert sorted(files) == sorted(cores.RTL.rglob("*.v"))
    bender = re.findall(r"^  - (.*)", packages.bender(everything), re.M)
    assert [tools.ROOT / name for name in bender] == files
    seen = []
    for folder, (_, needs) in everything.items():
        assert set(needs) <= set(seen)
        seen.append(folder)


def test_folders_that_need_each_other_are_refused(monkeypatch):
    monkeypatch.setattr(packages.cores, "sources_of", lambda name: tuple(packages.cores.RTL.rglob("*.v")))
    with pytest.raises(ValueError, match="need each other"):
        packages.folders()


def test_a_file_list_leads_to_files(tmp_path):
    listed = [line for line in packages.listing(cores.find("rational_ik2")).splitlines() if not line.startswith("//")]
    paths = [(tools.ROOT / packages.LISTS / line).resolve() for line in listed]
    assert set(paths) == set(cores.sources_of("rational_ik2"))


def bench(core, sample, cfg):
    """A test bench without anything of ours: one sample in, its result printed."""
    words = {port.name: verilog.literal(port, int(value)) for port, value in
             ((port, ({**sample, **cfg})[port.name]) for port in (*core.cfg, *core.inputs))}
    outs = "".join(f"wire {'signed ' * port.signed}[{port.width - 1}:0] {port.name};\n" for port in core.outputs)
    pins = "".join(f", .{name}({word})" for name, word in words.items())
    pins += "".join(f", .{port.name}({port.name})" for port in core.outputs)
    shown = ", ".join(port.name for port in core.outputs)
    params = ", ".join(f".{key}({value})" for key, value in core.params.items())
    return f"""module bench;
reg clk = 0, rst = 1, valid = 0; wire ready, done;
always #5 clk = !clk;
{outs}{core.name} #({params}) core (.clk(clk), .rst(rst), .in_valid(valid), .in_ready(ready),
    .out_valid(done), .out_ready(1'b1){pins});
initial begin
    @(negedge clk); @(negedge clk) rst = 0; valid = 1;
    while (!ready) @(negedge clk);
    @(negedge clk) valid = 0;
    while (!done) @(negedge clk);
    $display("RESULT{' %0d' * len(core.outputs)}", {shown});
    $finish;
end
initial #1000000 $finish;
endmodule
"""


@pytest.mark.skipif(not available("icarus"), reason="Icarus Verilog is not installed")
@pytest.mark.parametrize("family", [pytest.param(one, marks=[pytest.mark.slow] * (one != SHOWN)) for one in FAMILIES])
def test_fusesoc_builds_and_simulates_a_core_of_a_family(family, tmp_path):
    core = clocked(family)
    cfg = stimulus.configs(core, np.random.default_rng(3))[0]
    words = stimulus.uniform(core, np.random.default_rng(4), 1)
    (tmp_path / "bench.v").write_text(bench(core, {name: column[0] for name, column in words.items()}, cfg))
    folder = core.sources[0].parent.name
    (tmp_path / "mine.core").write_text(
        f"CAPI=2:\nname: mine:test:bench:1\nfilesets:\n  own:\n    files: [bench.v]\n    file_type: verilogSource\n"
        f"    depend: [quadrance:rtl:{folder}]\ntargets:\n  sim:\n    filesets: [own]\n    toplevel: bench\n"
        f"    flow: sim\n    flow_options: {{tool: icarus}}\n")
    done = subprocess.run([Path(sys.executable).parent / "fusesoc", "--cores-root", cores.RTL, "--cores-root", ".",
                           "run", "--target", "sim", "mine:test:bench"], cwd=tmp_path, capture_output=True, text=True,
                          env=tools.environment() | {"HOME": str(tmp_path)})
    assert done.returncode == 0, done.stdout + done.stderr
    found = re.search(r"^RESULT (.*)$", done.stdout + done.stderr, re.M)
    assert found, done.stdout + done.stderr
    answer = core.model(core.params, **words, **cfg)
    assert [int(word) for word in found[1].split()] == [int(np.ravel(answer[port.name])[0]) for port in core.outputs]
    assert not any(path.is_relative_to(cores.RTL) for path in tmp_path.resolve().parents)
