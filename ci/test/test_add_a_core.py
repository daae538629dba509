"""The list "Add a core" of tb/README.md, followed to the letter in a copy of the tree, and with one step left out."""

import os
import re
import shutil
import subprocess
from pathlib import Path
from textwrap import dedent

import pytest

from tb.lib import tools

PAGE = (tools.ROOT / "tb" / "README.md").read_text().partition("\n## Add a core\n")[2]
WRITE, _, RUN = PAGE.partition("\nMore is needed")[0].partition("\nThen run, in this order:\n")
STEPS = re.split(r"^\d\. ", WRITE, flags=re.M)[1:]
COMMANDS = re.findall(r"^\d\. `(make [^`]+)`", RUN, re.M)
NOT_RUN = {"make report": "it places the core", "make lint": "it checks all other cores"}
LESS = {"make test CORE=midpoint": "SIM=icarus PATHS=tb/test_cores.py"}  # `make cover` runs it in Verilator
MADE = {"reports/cover.json", "reports/proofs.json"}  # by the commands
PROSE = {"rtl/arith/README.md": "\n## midpoint\n\nThe mean of two words, rounded.\n", "CHANGELOG.md": "- `midpoint`\n"}


def files(step: str) -> list[str]:
    """The files that a step writes."""
    return re.findall(r"\*\*`([^`]+)`\*\*", step)


def with_step(name: str, text: str, step: str) -> str:
    """File `name` with what a step of the page puts into it."""
    found = re.search(r"```\w+\n(.*?)```", step, re.S)
    block = dedent("\n".join(line.removeprefix("   ") for line in found[1].splitlines())) if found else PROSE[name]
    if name == "rtl/cores.toml":
        end = text.index("\n[", text.rindex("\n[arith.") + 1)
        return f"{text[:end]}\n{block}{text[end:]}"
    if not name.startswith("tb/stimulus/"):
        return f"{text}\n\n{block.strip()}\n" if text else block + "\n"
    imports, function, entry = re.split(r"\n\n(?=def )|\n\n(?= )", block)
    text = re.sub(rf"^{imports.partition(' import ')[0]} import .*$", imports, text, flags=re.M)
    text = text.replace("\n\ndef corners(", f"\n\n{function}\n\n\ndef corners(")
    return re.sub(rf"^ +{entry.split()[0]}.*$", entry.rstrip(), text, flags=re.M)


class Copy:
    """A copy of the files in git, with the tools of this checkout."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        listed = subprocess.run(["git", "ls-files", "-z"], cwd=tools.ROOT, capture_output=True, text=True, check=True)
        self.before = {}
        for name in filter(None, listed.stdout.split("\0")):
            if (tools.ROOT / name).exists():
                (folder / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(tools.ROOT / name, folder / name)
                self.before[name] = (folder / name).read_bytes()
        (folder / ".venv").symlink_to((tools.ROOT / ".venv").resolve())
        (folder / "build").mkdir()
        (tools.BUILD / "verilator-runtime").mkdir(parents=True, exist_ok=True)
        (folder / "build" / "verilator-runtime").symlink_to(tools.BUILD / "verilator-runtime")  # compiled once for all

    def write(self, left_out: str = "") -> None:
        """Do what the page says, but for one file."""
        for step in STEPS:
            if step.startswith("`make packages`"):
                if left_out not in files(step):
                    assert self.make("make packages") == (0, "")
                continue
            name, = files(step)
            if name != left_out:
                path = self.folder / name
                path.write_text(with_step(name, path.read_text() if path.exists() else "", step))

    def changed(self) -> set[str]:
        """The files that are not as in git."""
        now = {str(path.relative_to(self.folder)): path for path in self.folder.rglob("*") if path.is_file()
               and not {"build", "__pycache__", ".pytest_cache"} & set(path.relative_to(self.folder).parts)}
        return {name for name in now.keys() | self.before.keys()
                if name not in now or self.before.get(name) != now[name].read_bytes()}

    def make(self, command: str) -> tuple[int, str]:
        """A command of the page: exit code and what it prints. Set-up is that of this checkout."""
        env = {key: value for key, value in os.environ.items()
               if not key.startswith("PYTEST") and key not in ("MAKEFLAGS", "MAKELEVEL", "MFLAGS")}
        done = subprocess.run([*command.split(), "N=0", "-o", ".venv/ready", "-s", "--no-print-directory"],
                              cwd=self.folder, env=env, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        return done.returncode, done.stdout


@pytest.fixture
def copy(tmp_path) -> Copy:
    return Copy(tmp_path / "copy")


def test_the_page_names_eight_files_at_most():
    named = [name for step in STEPS for name in files(step)]
    assert len(named) == len(set(named)) <= 8 and f"({len(named)})" in STEPS[-1]
    assert NOT_RUN.keys() | LESS.keys() < set(COMMANDS)


@pytest.mark.full
def test_the_list_of_the_page_adds_a_core(copy):
    copy.write()
    assert copy.changed() == {name for step in STEPS for name in files(step)}
    for command in COMMANDS:
        if command not in NOT_RUN:
            code, text = copy.make(f"{command} {LESS.get(command, '')}")
            assert code == 0, f"{command}\n{text}"
    assert copy.changed() <= {name for step in STEPS for name in files(step)} | MADE
    code, text = copy.make("make report-check")
    assert code and "core midpoint-W16 is not in the report" in text and "Traceback" not in text


LEFT_OUT = [
    ("rtl/arith/midpoint.v", "make lint CORE=midpoint", "lint: cores.toml: midpoint: there is no midpoint.v below"),
    ("rtl/arith/midpoint.v", "make test CORE=midpoint", "ERROR: cores.toml: midpoint: there is no midpoint.v below"),
    ("rtl/cores.toml", "make lint CORE=midpoint", "lint: rtl/arith/midpoint.v: rtl/cores.toml has no core of"),
    ("models/quadrance/arith.py", "make lint CORE=midpoint",
     "midpoint: models/quadrance/arith.py has no midpoint(), the model that rtl/cores.toml names"),
    ("models/quadrance/arith.py", "make cover CORE=midpoint",
     "midpoint: models/quadrance/arith.py has no midpoint(), the model that rtl/cores.toml names"),
    ("tb/stimulus/arith.py", "make lint CORE=midpoint",
     "midpoint: corners() in tb/stimulus/arith.py has no entry for midpoint; add it there"),
    ("tb/stimulus/arith.py", "make cover CORE=midpoint",
     "midpoint: corners() in tb/stimulus/arith.py has no entry for midpoint; add it there"),
    ("rtl/arith/README.md", "make lint CORE=midpoint", "midpoint: rtl/arith/README.md does not name it"),
    ("Bender.yml", "make lint CORE=midpoint", "Bender.yml: stale, run `make packages`")]


@pytest.mark.parametrize(("name", "command", "line"), LEFT_OUT, ids=[f"{name}-{how[5:9]}" for name, how, _ in LEFT_OUT])
def test_a_file_that_is_left_out_is_named_in_one_line(copy, name, command, line):
    copy.write(left_out=name)
    code, text = copy.make(command)
    assert code and "Traceback" not in text and "KeyError" not in text
    assert [one for one in text.splitlines() if one.startswith(line)]
