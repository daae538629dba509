"""The package of a release: a source distribution, the wheel that pip makes of it alone, installed where nothing is.

The command, the list, the Verilog, the arms and the figures are then found away from the checkout.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tomllib
from pathlib import Path

import pytest
from quadrance import cores

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
