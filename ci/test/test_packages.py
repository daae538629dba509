"""Manifests follow from the Verilog, and FuseSoC builds and simulates from them outside the repository."""

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


def test_the_manifests_that_are_checked_in_are_fresh():
    assert packages.stale() == []


def test_a_changed_and_a_missing_manifest_are_stale(monkeypatch, tmp_path):
    monkeypatch.setattr(packages.tools, "ROOT", tmp_path)
    (tmp_path / "Bender.yml").write_text("wrong\n")  # and rtl/quadrance.core is missing
    assert [line.partition(":")[0] for line in packages.stale()] == ["rtl/quadrance.core", "Bender.yml"]


def test_every_file_comes_once_and_after_the_folders_that_it_needs():
    paths = packages.files()
    assert sorted(paths) == sorted(cores.RTL.rglob("*.v"))
    for at, path in enumerate(paths):
        others = [one for one in cores.sources_of(path.stem) if one.parent != path.parent]
        assert all(paths.index(one) < at for one in others), path


def test_folders_that_need_each_other_are_refused(monkeypatch):
    monkeypatch.setattr(packages.cores, "sources_of", lambda name: tuple(packages.cores.RTL.rglob("*.v")))
    with pytest.raises(ValueError, match="need each other"):
        packages.files()


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
def test_fusesoc_builds_and_simulates_a_core(tmp_path):
    core = cores.find("vector_fk2")
    cfg = stimulus.configs(core, np.random.default_rng(3))[0]
    words = stimulus.uniform(core, np.random.default_rng(4), 1)
    (tmp_path / "bench.v").write_text(bench(core, {name: column[0] for name, column in words.items()}, cfg))
    (tmp_path / "mine.core").write_text(
        "CAPI=2:\nname: mine:test:bench:1\nfilesets:\n  own:\n    files: [bench.v]\n    file_type: verilogSource\n"
        "    depend: [quadrance:rtl:quadrance]\ntargets:\n  sim:\n    filesets: [own]\n    toplevel: bench\n"
        "    flow: sim\n    flow_options: {tool: icarus}\n")
    done = subprocess.run([Path(sys.executable).parent / "fusesoc", "--cores-root", cores.RTL, "--cores-root", ".",
                           "run", "--target", "sim", "mine:test:bench"], cwd=tmp_path, capture_output=True, text=True,
                          env=tools.environment() | {"HOME": str(tmp_path)})
    assert done.returncode == 0, done.stdout + done.stderr
    found = re.search(r"^RESULT (.*)$", done.stdout + done.stderr, re.M)
    assert found, done.stdout + done.stderr
    answer = core.model(core.params, **words, **cfg)
    assert [int(word) for word in found[1].split()] == [int(np.ravel(answer[port.name])[0]) for port in core.outputs]
    assert not any(path.is_relative_to(cores.RTL) for path in tmp_path.resolve().parents)
