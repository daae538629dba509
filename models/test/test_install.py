"""The package as pip installs it, away from the checkout: the command, the list, the Verilog and the figures."""

import json
import os
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

import pytest
from quadrance import cores

SHIPPED = ("models", "rtl", "reports", "pyproject.toml", "README.md")


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """A function that runs `quadrance` of a fresh virtual environment in an empty folder."""
    top = tmp_path_factory.mktemp("in stalled")
    source, venv, empty = top / "source", top / "venv", top / "empty"
    empty.mkdir()
    for name in SHIPPED:  # a copy: an installation leaves files beside what it installs
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
    subprocess.run([sys.executable, "-m", "pip", "--python", str(venv / "bin" / "python"), "install", "--quiet",
                    "--ignore-installed", "--no-index", "--no-deps", "--no-build-isolation", str(source)], check=True,
                   env=env | {"PIP_DISABLE_PIP_VERSION_CHECK": "1", "PYTHONPATH": str(library)}, cwd=empty)
    (site / "dependencies.pth").write_text(f"{library}\n")  # numpy and rich, without a network

    def run(*arguments, code=0):
        done = subprocess.run([venv / "bin" / "quadrance", *arguments], cwd=empty, env=env, capture_output=True,
                              text=True)
        assert done.returncode == code, done.stderr
        return done.stdout if code == 0 else done.stderr

    run.site = site
    return run


def test_the_package_has_all_of_the_verilog(installed):
    """The same files with the same text, found inside the environment and not in the checkout."""
    there = installed.site / "quadrance" / "rtl"
    assert {path.relative_to(there) for path in there.rglob("*.v")} == \
        {path.relative_to(cores.RTL) for path in cores.RTL.rglob("*.v")}
    package = cores.PACKAGE
    assert {path.relative_to(package) for path in package.rglob("*.py")} == \
        {path.relative_to(there.parent) for path in there.parent.rglob("*.py")}, "packages of pyproject.toml"
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
    assert "did you mean rational_ik2" in installed("show", "rational_ik22", code=2)
