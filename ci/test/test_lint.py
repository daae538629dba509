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
    asked, run = [], lint._yosys
    monkeypatch.setattr(lint, "_yosys", lambda top, *more: asked.append(top) or run(top, *more))

    def said(table):
        for name, text in (("top", TOP), ("squares", table)):
            (folder / f"{name}.v").write_text(text)
        return lint.yosys(replace(CORE, name="top", sources=(folder / "top.v", folder / "squares.v")), {})

    assert said(TABLE) == said(TABLE) == (0, "") and asked == ["top", "squares", "top"]
    assert "none' is implicitly declared" in said(TABLE.replace("i * i", "none"))[1]
    assert "used but has no driver" in said(TABLE.replace("[in_at]", "[none]"))[1]


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

