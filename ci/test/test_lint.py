"""`make lint`: what passed is kept, what fails is not; one core alone; progress; "Add a core" of tb/README.md."""

import os
import re
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from textwrap import dedent
from types import SimpleNamespace

import pytest
from quadrance import cores

from ci import cache, dataflow, elaborate, lint
from tb.lib import tools

# What it finds and keeps


@pytest.fixture
def asked(monkeypatch, tmp_path):
    """The tools stand still: what each was asked about, and what `asked.answers` lets it find."""
    monkeypatch.setattr(cache, "FOLDER", tmp_path)
    calls, answers = [], {}

    def tool(name):
        def ask(core, *sets):
            legal = core.params in sets
            calls.append((name, core.id, legal))
            return answers.get(name, (0, "")) if legal else (1, "needs_needs_")
        ask.__name__ = name
        return ask

    for name in ("verilator", "icarus", "slang", "yosys"):
        monkeypatch.setattr(elaborate if name == "yosys" else lint, name, tool(name))
    monkeypatch.setattr(lint, "ports", lint.contract)
    return SimpleNamespace(calls=calls, answers=answers)


CORE = cores.find("vector_fk1-U16")


@pytest.mark.parametrize(("check", "tools"), [(lint.check_core, {"verilator", "slang"}),
                                              (elaborate.check_sets, {"yosys"})])
def test_what_passed_is_kept_until_something_changes(asked, monkeypatch, tmp_path, check, tools):
    assert lint.kept(check, CORE) == [] and tools <= {name for name, *_ in asked.calls}
    asked.calls.clear()
    assert lint.kept(check, CORE) == [] and asked.calls == []
    source = tmp_path / "vector_fk1.v"
    source.write_text(CORE.sources[0].read_text() + "\n")
    assert lint.kept(check, replace(CORE, sources=(source, *CORE.sources[1:]))) == [] and asked.calls
    asked.calls.clear()
    monkeypatch.setattr(lint, "_tools", lambda: ["another version"])
    assert lint.kept(check, CORE) == [] and asked.calls


def test_what_fails_is_not_kept(asked):
    asked.answers["verilator"] = (0, "%Warning-WIDTH: x")
    for _ in range(2):
        assert lint.kept(lint.check_core, CORE) == ["vector_fk1-U16: verilator: %Warning-WIDTH: x"]
    del asked.answers["verilator"]
    assert lint.kept(lint.check_core, CORE) == []


def test_the_first_illegal_set_stops_every_tool_and_each_one_slang(asked):
    assert lint.check_core(CORE) == elaborate.check_sets(CORE) == []
    wrong = [name for name, _, legal in asked.calls if not legal]
    assert len(CORE.illegal) > 1 and wrong.count("slang") == len(CORE.illegal)
    assert wrong.count("verilator") == wrong.count("yosys") == 1


def test_an_illegal_set_that_is_accepted_is_said(asked, monkeypatch):
    def accepts(core, params):
        return 0, ""

    accepts.__name__ = "slang"
    monkeypatch.setattr(lint, "slang", accepts)
    assert len([one for one in lint.check_core(CORE) if "slang accepts illegal" in one]) == len(CORE.illegal)


def test_the_ports_are_the_contract_s(asked, monkeypatch):
    monkeypatch.setattr(lint, "ports", lambda core: lint.contract(core)[:-1])
    assert "are not the contract's" in lint.check_core(CORE)[0]


TABLE = """module squares #(parameter N = 4) (input wire [1:0] in_at, output wire [3:0] out_square);
    reg [3:0] words [0:N-1];
    integer i;
    initial begin
        for (i = 0; i < N; i = i + 1)
            words[i] = i * i;
    end
    assign out_square = words[in_at];
endmodule
"""
TOP = """module top (input wire [1:0] in_at, output wire [3:0] out_square);
    squares #(.N(4)) table_of_squares (.in_at(in_at), .out_square(out_square));
endmodule
"""


def test_yosys_elaborates_a_table_once_and_finds_what_is_wrong_in_it(monkeypatch, tmp_path):
    monkeypatch.setattr(cache, "FOLDER", tmp_path / "cache")
    folder = tools.BUILD / "test_lint" / tmp_path.name
    folder.mkdir(parents=True, exist_ok=True)
    asked, run = [], elaborate._yosys
    monkeypatch.setattr(elaborate, "_yosys", lambda work, name, *more: asked.append(name) or run(work, name, *more))

    def said(table):
        for name, text in (("top", TOP), ("squares", table)):
            (folder / f"{name}.v").write_text(text)
        return elaborate.yosys(replace(CORE, name="top", sources=(folder / "top.v", folder / "squares.v")), {})

    assert said(TABLE) == said(TABLE) == (0, "") and asked == ["top", "squares", "top"]
    assert "none' is implicitly declared" in said(TABLE.replace("i * i", "none"))[1]
    assert "used but has no driver" in said(TABLE.replace("[in_at]", "[none]"))[1]


def test_yosys_leaves_tables_to_the_report_but_one_of_each_module(monkeypatch, tmp_path):
    monkeypatch.setattr(cache, "FOLDER", tmp_path)
    asked = []
    monkeypatch.setattr(elaborate, "_yosys",
                        lambda work, name, sets, sources: asked.append((name, list(sets))) or (0, ""))
    first, other = cores.find("angle_to_vector"), cores.find("table_fk1")
    for core, params in ((first, first.params), (other, other.params), (other, other.params | {"A": 20})):
        assert elaborate.yosys(core, params) == (0, "")
    assert [name for name, _ in asked] == ["angle_to_vector", "angle_chord", "table_fk1", "table_fk1", "angle_chord"]


def test_a_set_that_yosys_refuses_is_named_and_the_others_are_not(monkeypatch):
    sets = [core for core in cores.all_cores() if core.name == "vector_fk1"]
    bad = sets[-1]

    def yosys(core, *params):
        return (0, "Warning: x") if bad.params in params else (0, "") if core.params in params else (1, "needs_needs_")

    monkeypatch.setattr(elaborate, "yosys", yosys)
    assert len(sets) > 1 and elaborate.check_sets(*sets) == [f"{bad.id}: yosys: Warning: x"]
    monkeypatch.setattr(elaborate, "yosys", lambda core, *params: (0, "Warning: y" * (len(params) > 1)))
    assert elaborate.check_sets(*sets)[0] == "vector_fk1: yosys: Warning: y"
    assert "accepts illegal" in elaborate.check_sets(*sets)[1]


def test_a_verdict_stands_until_the_core_means_something_else(asked, monkeypatch, tmp_path):
    def run(*words):
        asked.calls.clear()
        shutil.rmtree(cache.FOLDER, ignore_errors=True)  # a fresh clone
        monkeypatch.setattr(sys, "argv", ["lint", "--core", CORE.name, *words])
        return lint.main(), {tool for tool, *_ in asked.calls}

    quick = {"verilator", "slang"} | ({"icarus"} if lint.available("icarus") else set())
    monkeypatch.setattr(cache, "FOLDER", tmp_path / "cache")
    monkeypatch.setattr(cache, "SINCE", 0.0)
    monkeypatch.setattr(elaborate, "STORE", tmp_path / "lint.json")
    monkeypatch.setattr(lint, "all_cores", lambda: (CORE,))
    for tool in quick | {"yosys"}:
        asked.answers[tool] = (0, "Warning: x")
        assert run() == (1, quick | {"yosys"}) and elaborate.standing() == {}
        del asked.answers[tool]
    monkeypatch.setattr(lint, "check_text", lambda cores, named: ["a line is too long"])  # no tool finds that
    assert run() == (1, quick | {"yosys"})
    kept = elaborate.standing()
    assert kept == {"yosys": {CORE.name: elaborate.follows(CORE)}, "others": kept["others"], "schedules": {}}
    assert run() == (1, set()) and run("--fresh") == (1, quick | {"yosys"})
    source = tmp_path / "vector_fk1.v"
    for text, again in ((CORE.sources[0].read_text() + "// a comment\n", False),
                        (CORE.sources[0].read_text().replace("endmodule", "wire more; endmodule"), True)):
        source.write_text(text)
        changed = replace(CORE, sources=(source, *CORE.sources[1:]))
        assert (elaborate.follows(changed) != elaborate.follows(CORE)) == again
        assert lint.follows(lint.check_core, changed) != lint.follows(lint.check_core, CORE)  # a comment hides warnings
    wider = replace(CORE, params=CORE.params | {"W": 15})
    assert len({elaborate.follows(CORE), elaborate.follows(wider), elaborate.follows(CORE, wider),
                elaborate.follows(replace(CORE, illegal=CORE.illegal[1:]))}) == 4


def test_a_schedule_is_played_until_its_core_means_something_else(asked, monkeypatch, tmp_path):
    def run(*chosen):
        calls.clear()
        return lint.check_tools((CORE,), chosen, alone=True, fresh=False), calls[:]

    calls, found = [], ["a register is read too early"]
    monkeypatch.setattr(elaborate, "STORE", tmp_path / "lint.json")
    monkeypatch.setattr(lint, "all_cores", lambda: (CORE,))
    monkeypatch.setattr(dataflow, "problems", lambda core: calls.append(core) or found)
    other = replace(CORE, latency=CORE.latency + 1)
    assert run(CORE) == run(CORE) == (found, [CORE])
    found = []
    assert run(CORE) == ([], [CORE]) and run(CORE) == ([], [])
    assert run(CORE, other) == ([], [CORE, other]) and run(other) == ([], [other])


def test_without_icarus_verdicts_of_the_other_tools_stay(asked, monkeypatch, tmp_path):
    monkeypatch.setattr(elaborate, "STORE", tmp_path / "lint.json")
    monkeypatch.setattr(lint, "all_cores", lambda: (CORE,))
    monkeypatch.setattr(lint, "available", lambda simulator: False)
    monkeypatch.setattr(elaborate, "drawn", lambda names: set())
    for name in ("check_wrapper", "check_registers"):
        monkeypatch.setattr(lint, name, lambda *printed: [])
    elaborate.keep({"others": {CORE.name: "before"}})
    assert lint.check_tools((CORE,), (), alone=False, fresh=False) == []
    assert elaborate.standing() == {"yosys": {CORE.name: elaborate.follows(CORE)}, "others": {CORE.name: "before"},
                                    "schedules": {}}


def test_what_the_commit_draws_is_asked_although_it_is_kept(asked, monkeypatch, tmp_path):
    monkeypatch.setattr(elaborate, "STORE", tmp_path / "lint.json")
    monkeypatch.setattr(lint, "all_cores", lambda: (CORE,))
    monkeypatch.setattr(elaborate, "drawn", lambda names: {CORE.name})
    for name in ("check_wrapper", "check_registers"):
        monkeypatch.setattr(lint, name, lambda *printed: [])
    for _ in range(2):
        asked.calls.clear()
        assert lint.check_tools((CORE,), (), alone=False, fresh=False) == []
        assert {"verilator", "slang", "yosys"} <= {tool for tool, *_ in asked.calls}


def test_the_commit_draws_cores_whose_verdict_stands(monkeypatch):
    names = [f"core_{i}" for i in range(50)]
    monkeypatch.setattr(cache, "commit", lambda: "a" * 40)
    one = elaborate.drawn(names)
    assert len(one) == elaborate.DRAWN and elaborate.drawn(reversed(names)) == one
    monkeypatch.setattr(cache, "commit", lambda: "b" * 40)
    assert elaborate.drawn(names) != one


def test_progress_is_a_line_now_and_then(monkeypatch, capsys):
    monkeypatch.setattr(lint, "EVERY", -1.0)
    assert sorted(lint._progress({lambda: ["b: bad"]: "b", lambda: []: "a"})) == ["b: bad"]
    lines = capsys.readouterr().err.splitlines()
    assert [line[:14] for line in lines] == ["lint: 1 of 2  ", "lint: 2 of 2  "]


def test_one_core_alone():
    def run(*words):
        return subprocess.run([sys.executable, "-m", "ci.lint", *words], cwd=tools.ROOT, capture_output=True, text=True)

    done = run("--core", "isqrt_comb-W16")
    assert done.returncode == 0 and "lint: 1 cores and parameter sets without a warning\n" in done.stdout
    done = run("--core", "isqrt_com")
    assert done.returncode == 1 and done.stderr.startswith("lint: no core 'isqrt_com'; did you mean isqrt_comb")
    assert "--core CORE" in run("--help").stdout


# The list "Add a core", followed to the letter in a copy of the tree, and with one step left out

PAGE = (tools.ROOT / "tb" / "README.md").read_text().partition("\n## Add a core\n")[2]
WRITE, _, RUN = PAGE.partition("\nMore is needed")[0].partition("\nThen run, in this order:\n")
STEPS = re.split(r"^\d\. ", WRITE, flags=re.M)[1:]
COMMANDS = re.findall(r"^\d\. `(make [^`]+)`", RUN, re.M)
NOT_RUN = {"make report": "it places the core", "make lint": "it checks all other cores"}
LESS = {"make test CORE=midpoint": "SIM=icarus PATHS=tb/test_cores.py"}  # `make cover` runs it in Verilator
MADE = {"reports/cover.json", "reports/lint.json", "reports/proofs.json"}  # by the commands
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


FILE = "// SPDX-License-Identifier: Apache-2.0\n// A part\n`default_nettype none\nmodule {name};\n{body}endmodule\n"


def test_a_file_that_people_write_is_short_and_a_table_is_as_long_as_its_program(tmp_path, monkeypatch):
    monkeypatch.setattr(lint, "ROOT", tmp_path)

    def wrong(name, lines):
        path = tmp_path / f"{name}.v"
        path.write_text(FILE.format(name=name, body="\n" * (lines - 5)))
        return lint.check_file(path)

    assert wrong("part", 350) == []
    assert wrong("part", 351) == ["part.v: 351 lines, at most 350 where nothing assembles it"]
    assert wrong("part_program", 351) != [], "by its name alone"
    (tmp_path / "part.kin").touch()
    assert wrong("part_program", 351) == []
