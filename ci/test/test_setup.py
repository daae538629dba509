"""On a machine that lacks something, `ci/setup.sh` and the Makefile print one sentence and make nothing."""

import os
import shutil
import subprocess
import sys

import pytest

from tb.lib import tools

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
