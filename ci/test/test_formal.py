"""Each of these cores is broken in one place, and the verdict must be FAIL, with the property."""

import dataclasses
import re
import subprocess
from pathlib import Path

import pytest
from quadrance import cores

from ci import contract, formal, reset
from tb.lib import tools
from tb.lib.simulate import available
from tb.lib.test_bench_bites import FALLS, RESETS, altered

ICARUS = pytest.mark.skipif(not available("icarus"), reason="a core's states are found by simulation in Icarus")
FAULTS = [
    ("isqrt_comb-W15F1", "isqrt_digits.v", "~pair[0]} : {rem[D-1:0], pair}", "pair[0]} : {rem[D-1:0], pair}", "FAIL"),
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
