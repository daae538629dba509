"""`make lint`: what passed is kept, what fails is not; one core alone; progress; new cores that lack something."""

import subprocess
import sys
from dataclasses import replace
from types import SimpleNamespace

import pytest
from quadrance import cores

from ci import cache, lint
from tb.lib import tools


@pytest.fixture
def asked(monkeypatch, tmp_path):
    """The tools stand still: what each was asked about, and what `asked.answers` lets it find."""
    monkeypatch.setattr(cache, "FOLDER", tmp_path)
    calls, answers = [], {}

    def tool(name):
        def ask(core, params):
            calls.append((name, core.id, params == core.params))
            return answers.get(name, (0, "")) if params == core.params else (1, "needs_needs_")
        ask.__name__ = name
        return ask

    for name in ("verilator", "icarus", "slang", "yosys"):
        monkeypatch.setattr(lint, name, tool(name))
    monkeypatch.setattr(lint, "ports", lint.contract)
    return SimpleNamespace(calls=calls, answers=answers)


CORE = cores.find("vector_fk1-U16")


def test_what_passed_is_kept_until_something_changes(asked, monkeypatch, tmp_path):
    assert lint.kept(CORE) == [] and {"verilator", "slang", "yosys"} <= {name for name, *_ in asked.calls}
    asked.calls.clear()
    assert lint.kept(CORE) == [] and asked.calls == []
    source = tmp_path / "vector_fk1.v"
    source.write_text(CORE.sources[0].read_text() + "\n")
    assert lint.kept(replace(CORE, sources=(source, *CORE.sources[1:]))) == [] and asked.calls
    asked.calls.clear()
    monkeypatch.setattr(lint, "_tools", lambda: ["another version"])
    assert lint.kept(CORE) == [] and asked.calls


def test_what_fails_is_not_kept(asked):
    asked.answers["verilator"] = (0, "%Warning-WIDTH: x")
    for _ in range(2):
        assert lint.kept(CORE) == ["vector_fk1-U16: verilator: %Warning-WIDTH: x"]
    del asked.answers["verilator"]
    assert lint.kept(CORE) == []


def test_the_first_illegal_set_stops_every_tool_and_each_one_slang(asked):
    lint.check_core(CORE)
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


def test_progress_is_a_line_now_and_then(monkeypatch, capsys):
    monkeypatch.setattr(lint, "EVERY", -1.0)
    assert sorted(lint._progress({lambda: ["b: bad"]: "b", lambda: []: "a"})) == ["b: bad"]
    lines = capsys.readouterr().err.splitlines()
    assert [line[:14] for line in lines] == ["lint: 1 of 2  ", "lint: 2 of 2  "]


def test_one_core_alone():
    def run(*words):
        return subprocess.run([sys.executable, "-m", "ci.lint", *words], cwd=tools.ROOT, capture_output=True, text=True)

    done = run("--core", "isqrt_comb-W16")
    assert done.returncode == 0 and done.stdout.startswith("lint: 1 cores and parameter sets without a warning\n")
    done = run("--core", "isqrt_com")
    assert done.returncode == 1 and done.stderr.startswith("lint: no core 'isqrt_com'; did you mean isqrt_comb")
    assert "--core CORE" in run("--help").stdout

