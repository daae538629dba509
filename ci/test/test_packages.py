"""Manifests and the package of a release: they follow from the sources, and work outside the repository."""

import json
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tomllib
from pathlib import Path

import numpy as np
import pytest
from quadrance import cores
from quadrance.cli import verilog

from ci import packages
from tb.lib import stimulus, tools
from tb.lib.simulate import available

# Manifests follow from the Verilog, and FuseSoC builds and simulates from them


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


# A source distribution, the wheel that pip makes of it alone, installed where nothing is: the command, the list, the
# Verilog, the arms and the figures are then found away from the checkout

SOURCE = ("models", "rtl", "reports", "pyproject.toml", "README.md", "LICENSE")
PROJECT = tomllib.loads((cores.ROOT / "pyproject.toml").read_text())["project"]
SDIST = "import sys; from setuptools import build_meta; build_meta.build_sdist(sys.argv[1])"


def shipped(folder):
    """Files of a folder of packages that run without a checkout, by their path in it: no pages, pictures or caches."""
    return {path.relative_to(folder) for path in folder.rglob("*")
            if path.is_file() and path.suffix not in (".md", ".png", ".svg", ".pyc")}


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """A function that runs `quadrance` of a fresh virtual environment in an empty folder."""
    top = tmp_path_factory.mktemp("in stalled")
    source, venv, empty = top / "source", top / "venv", top / "empty"
    empty.mkdir()
    for name in SOURCE:  # a copy: an installation leaves files beside what it installs
        here, there = cores.ROOT / name, source / name
        if here.is_dir():
            shutil.copytree(here, there, ignore=shutil.ignore_patterns("__pycache__", "*.egg-info"))
        else:
            source.mkdir(exist_ok=True)
            shutil.copy(here, there)
    env = {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "COLUMNS")}
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", venv], check=True)
    library = Path(sysconfig.get_path("purelib"))
    site = next(venv.glob("lib/python*/site-packages"))
    env |= {"PIP_DISABLE_PIP_VERSION_CHECK": "1"}
    subprocess.run([sys.executable, "-c", SDIST, top], check=True, env=env, cwd=source, stdout=subprocess.DEVNULL)
    shutil.rmtree(source)  # what follows has the distribution alone
    subprocess.run([sys.executable, "-m", "pip", "--python", str(venv / "bin" / "python"), "install", "--quiet",
                    "--ignore-installed", "--no-index", "--no-deps", "--no-build-isolation",
                    str(top / f"quadrance-{PROJECT['version']}.tar.gz")], check=True,
                   env=env | {"PYTHONPATH": str(library)}, cwd=empty)
    (site / "dependencies.pth").write_text(f"{library}\n")  # numpy and rich, without a network

    def run(*arguments, code=0):
        done = subprocess.run([venv / "bin" / "quadrance", *arguments], cwd=empty, env=env, capture_output=True,
                              text=True)
        assert done.returncode == code, done.stderr
        return done.stdout if code == 0 else done.stderr

    run.site = site
    return run


def test_the_package_has_all_of_its_files(installed):
    """The same files, the Verilog with the same text, found inside the environment and not in the checkout."""
    package = installed.site / "quadrance"
    there = package / "rtl"
    assert shipped(there) == shipped(cores.RTL), "package-data of pyproject.toml"
    assert {path for path in shipped(package) if path.parts[0] not in ("rtl", "reports")} == shipped(cores.PACKAGE), \
        "packages and package-data of pyproject.toml"
    about = installed.site / f"quadrance-{PROJECT['version']}.dist-info"
    assert (about / "licenses" / "LICENSE").read_text() == (cores.ROOT / "LICENSE").read_text()
    found = json.loads(installed("files", "rational_ik2", "--json"))["files"]
    for path in map(Path, found):
        assert path.is_relative_to(there)
        assert path.read_text() == (cores.RTL / path.relative_to(there)).read_text()
    assert {Path(path).name for path in found} == {path.name for path in cores.sources_of("rational_ik2")}


def test_the_package_has_the_figures_and_the_arms(installed):
    figures = next(row["figures"] for row in json.loads(installed("cores", "--json")) if row["core"] == "rational_ik2")
    report = json.loads((cores.ROOT / "reports" / "report.json").read_text())
    area = next(row["area"]["ecp5"]["lut"] for row in report["cores"]
                if (row["core"], row["set"]) == ("rational_ik2", "S24"))
    assert figures["ecp5"]["lut"] == area
    assert ".cfg_l1(16'd8320)" in installed("instance", "rational_ik2", "--arm", "cobra600")
    assert "files written to hw" in installed("registers", "table_ik2", "--arm", "cobra600", "--out", "hw")
    assert re.search("^table_fk1 ", installed("choose", "--function", "fk1", "--arm", "cobra600", "--word", "angle:18"),
                     re.M)
    assert "did you mean rational_ik2" in installed("show", "rational_ik22", code=2)
