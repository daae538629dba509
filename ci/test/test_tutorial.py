"""What a user does first: setup, which says in a sentence what is missing, and the steps of the pages."""

import json
import math
import os
import re
import shutil
import subprocess
import sys

import pytest
from quadrance import truth

from tb.lib import tools
from tb.lib.simulate import available

# On a machine that lacks something, `ci/setup.sh` and the Makefile print one sentence and make nothing

NEEDED = ("sh", "make", "perl", "git", "rm", "tail", "mkdir", "touch", "grep", "sed", "expand", "date", "id")


@pytest.fixture
def checkout(tmp_path):
    """A folder with what setup needs, a PATH of a few programs, and a function that runs it there."""
    folder, programs = tmp_path / "checkout", tmp_path / "programs"
    for name in ("ci/setup.sh", "Makefile", "requirements.lock", "pyproject.toml"):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(tools.ROOT / name, folder / name)
    programs.mkdir()
    for name in NEEDED:
        (programs / name).symlink_to(shutil.which(name))

    def program(name, text):
        (programs / name).write_text(f"#!{shutil.which('sh')}\n{text}\n")
        (programs / name).chmod(0o755)

    def run(*command, **env):
        done = subprocess.run(command, cwd=folder, env={"PATH": str(programs), "HOME": str(tmp_path), **env},
                              capture_output=True, text=True)
        return done.returncode, done.stdout + done.stderr

    def setup(**env):
        return run("sh", "ci/setup.sh", ".venv", **env)

    setup.run, setup.folder, setup.program = run, folder, program
    program("g++", "exit 0")
    return setup


def refused(answer, words):
    code, text = answer
    assert code and words in text and text.startswith("setup: ") and text.count("\n") == 1, text


@pytest.mark.parametrize("python, words", [
    ("no_such_python", "there is no 'no_such_python'"), ("grep", "'grep' is no Python 3"), ("old", "is python 3 9")])
def test_a_wrong_python_gets_a_sentence(checkout, python, words):
    checkout.program("old", "echo python 3 9")
    refused(checkout(PYTHON=python), words)
    assert not (checkout.folder / ".venv").exists()


def test_a_missing_compiler_gets_a_sentence_and_any_name_of_it_will_do(checkout):
    checkout.program("python3", "case $1 in -c) echo python 3 11;; *) exit 1;; esac")
    for name in ("g++", "c++", "clang++"):
        refused(checkout(), "'python3 -m venv' does not work")  # the compiler was accepted
        (checkout.folder.parent / "programs" / name).unlink()
        following = {"g++": "c++", "c++": "clang++"}.get(name)
        if following:
            checkout.program(following, "exit 0")
    refused(checkout(), "a C++ compiler (g++, c++ or clang++) is missing")


def test_packages_that_cannot_be_fetched_get_a_sentence(checkout):
    checkout.program("python3", "case $1 in -c) echo python 3 11;; *) mkdir -p .venv/bin; "
                                "printf '#!/bin/sh\\ncase \"$*\" in *lock*) echo gone >&2; exit 1;; esac\\n' "
                                "> .venv/bin/python; chmod +x .venv/bin/python;; esac")
    (checkout.folder.parent / "programs" / "chmod").symlink_to(shutil.which("chmod"))
    code, text = checkout()
    assert code and text == ("gone\nsetup: packages of requirements.lock could not be installed (build/setup.log); "
                             "the first time needs the network\n")


def test_the_lock_names_every_package():
    """Setup installs those alone; what one of them needs and the lock forgot would be missing."""
    done = subprocess.run([sys.executable, "-m", "pip", "--disable-pip-version-check", "check"],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_a_path_with_a_space_is_refused(checkout):
    there = checkout.folder.parent / "with space"
    checkout.folder.rename(there)
    done = subprocess.run(["sh", "ci/setup.sh", ".venv"], cwd=there, capture_output=True, text=True)
    refused((done.returncode, done.stderr), "has a space")
    done = subprocess.run(["make", "lint"], cwd=there, capture_output=True, text=True)
    assert done.returncode and "has a space" in done.stderr and not (there / ".venv").exists()


def test_a_folder_that_cannot_be_written_to_gets_a_sentence(checkout):
    (checkout.folder / ".writable").mkdir()  # nobody can write a file of that name: root neither
    refused(checkout(), "cannot be written to")
    code, text = checkout.run("make", "lint")
    assert code and "cannot be written to" in text


def test_a_compiler_of_another_name_is_taken(monkeypatch, tmp_path):
    fake = tmp_path / "c++"
    fake.write_text("#!/bin/sh\n")
    fake.chmod(0o755)
    monkeypatch.setattr(tools, "environment", lambda: {"PATH": str(tmp_path)})
    assert tools.require("g++") == str(fake)
    fake.unlink()
    with pytest.raises(SystemExit, match=r"g\+\+ is missing: install a C\+\+ compiler"):
        tools.require("g++")


def test_a_user_without_a_home_keeps_compiled_tools_in_the_build(monkeypatch):
    monkeypatch.delenv("YOWASP_CACHE_DIR", raising=False)
    monkeypatch.setenv("HOME", os.devnull)
    assert tools.environment()["YOWASP_CACHE_DIR"] == str(tools.BUILD / "yowasp")


# Every shell block of the pages that have steps, unchanged, in an empty folder

DOCS = tools.ROOT / "docs"
STEPS = {"tutorial.md": 10, "my-arm.md": 9, "own-program.md": 6}
THETA = truth.ik2(300, 120, 250, 180, 0)  # the first two pages ask for this tip
icarus = pytest.mark.skipif(not available("icarus"), reason="Icarus Verilog is not installed")


def blocks(page):
    """(step, shell) of a page."""
    return [(int(number), text) for number, text in
            re.findall(r"^## (\d+)\. [^#]*?```sh\n(.*?)```", (DOCS / page).read_text(), re.S | re.M)]


@pytest.fixture
def steps(tmp_path):
    """A function that runs a page, and gives what each step said and the folder."""
    programs, work = tmp_path / "bin", tmp_path / "work"
    programs.mkdir()
    work.mkdir()
    for name, more in (("quadrance", " -m quadrance"), ("python3", "")):
        command = programs / name
        command.write_text(f'#!/bin/sh\nexec "{sys.executable}"{more} "$@"\n')
        command.chmod(0o755)
    env = tools.environment()
    env |= {"PATH": f"{programs}:{env['PATH']}", "PYTHONPATH": str(tools.ROOT / "models")}

    def run(page):
        said = {}
        for number, text in blocks(page):
            done = subprocess.run(["sh", "-ec", text], cwd=work, env=env, capture_output=True, text=True)
            assert done.returncode == 0, f"step {number}: {done.stdout}{done.stderr}"
            said[number] = done.stdout + done.stderr
        return said, work

    return run


def right(counts, status, page):
    """The counts of 20-bit encoders are those of `THETA`, and the page says these angles."""
    for count, angle in zip(counts, THETA):
        off = (count - float(angle) * 2**20 / (2 * math.pi) + 2**19) % 2**20 - 2**19
        assert abs(off) < 40, (count, float(angle))  # 0.014 degrees: the target's LSB and the core's error
    degrees = [f"{(math.degrees(float(angle)) + 180) % 360 - 180:.2f}" for angle in THETA]
    assert status == 0 and f"Joint 1 is {degrees[0]} degrees and joint 2 is {degrees[1]} degrees" in \
        (DOCS / page).read_text()


@pytest.mark.parametrize("page", STEPS)
def test_every_step_has_a_block(page):
    text = (DOCS / page).read_text()
    assert [number for number, _ in blocks(page)] == list(range(1, STEPS[page] + 1))
    assert text.count("```sh") == STEPS[page] == len(re.findall("^## ", text, re.M)), "a block that no test runs"
    for name in re.findall(r"\]\(([\w./-]+\.md)(?:#[\w-]+)?\)", text):
        assert (DOCS / name).exists()


@pytest.mark.slow
@icarus
def test_the_tutorial_does_what_it_says(steps):
    said, work = steps("tutorial.md")
    assert "mm_per_unit = 4 would do" in said[3]
    assert "19200 (16'h4b00)" in said[5] and "7680 (" in said[5] and "262144 (20'h40000)" in said[5]
    one, two, status = map(int, (work / "counts").read_text().split())
    right((one, two), status, "tutorial.md")
    assert json.loads((work / "report.json").read_text())["fmax"]


@icarus
def test_an_arm_gets_behind_a_bus(steps):
    said, work = steps("my-arm.md")
    assert "My SCARA: right" in said[2] and "4 mm a unit" in said[2]
    assert "table_ik2 #(.W(16), .F(8), .A(20), .PIPE(1)" in said[4]
    for name in ("axil_table_ik2.v", "axil_table_ik2.xdc", "axil_table_ik2.sdc", "table_ik2.h", "table_ik2.json"):
        assert name in said[5].split()
    assert "set_max_delay" in said[6]
    _, status, _, one, two = (work / "joints").read_text().split()
    right((int(one), int(two)), int(status), "my-arm.md")
    assert "module wishbone_table_ik2" in (work / "wishbone.v").read_text()


@icarus
def test_a_program_of_the_user_runs(steps):
    said, work = steps("own-program.md")
    assert said[3].startswith("quadrance: wide.kin:6: the range of k is not proved")
    assert "refused" not in (work / "answers").read_text()
    answers = said[6].splitlines()
    assert answers.pop(0) == f"version 3 crc {json.loads((work / 'pan.json').read_text())['crc']}"
    wanted, pans = [], [0.0, 0.0]
    for x, y, z in ((1200, 500, 1800), (0, 0, 1800), (-300, 400, 100)):
        for head, (d, h) in enumerate(((100, 1000), (40, 1500))):
            pans[head] = math.atan2(y, x) if (x, y) != (0, 0) else pans[head]
            tilt = math.atan2(z - h, math.cos(pans[head]) * x + math.sin(pans[head]) * y - d)
            wanted.append((math.degrees(pans[head]), math.degrees(tilt), 2 * ((x, y) == (0, 0))))
    found = [tuple(map(float, re.findall(r"-?[\d.]+", line))) for line in answers]
    assert len(found) == len(wanted)
    for one, other in zip(found, wanted):
        assert one == pytest.approx(other, abs=0.01)
    page = (DOCS / "own-program.md").read_text()
    assert f"pans to {wanted[0][0]:.2f} degrees and tilts to {wanted[0][1]:.2f} degrees" in page
