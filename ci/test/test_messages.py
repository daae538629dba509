"""What a failed test says, in the JUnit file and in its summary: reason, sample, the command that repeats it.

A core broken on purpose is recorded, with the time of the fault and a command that repeats it.
"""

import os
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from xml.etree import ElementTree

import numpy as np
import pytest
import yaml
from quadrance import cores
from quadrance.cores import ROOT, Port

import conftest
from ci import coverage, mutants, netlist, summary, waves
from tb.lib import blame, simulate, tools
from tb.lib.suite import simulators

BENCH = """
from dataclasses import replace
from pathlib import Path
import numpy as np
import pytest
from quadrance import cores
from tb.lib.simulate import simulate
from tb.lib.suite import SEED, simulators

CORE = cores.find("vector_fk1")
FILE = Path(__file__).with_name("vector_fk1.v")
TEXT = CORE.sources[0].read_text()
assert TEXT.count("out_x  <= out_y;") == 1
FILE.write_text(TEXT.replace("out_x  <= out_y;", "out_x  <= out_y ^ 1'b1;"))
BROKEN = replace(CORE, sources=(FILE, *CORE.sources[1:]), set_id="broken")

@pytest.mark.parametrize(("simulator", "core"), [pytest.param(simulators()[0], BROKEN, id="broken")])
def test_bench(core, simulator):
    simulate(core, simulator, seed=SEED)
"""
MODEL = """
import numpy as np

def test_words():
    for axis in "xy":
        words = {"in_j1": np.arange(9), "in_j2": np.arange(9) * 2}
        found = {"out_x": words["in_j1"] + 1, "out_y": words["in_j2"] + (words["in_j1"] == 7)}
        assert np.all(found[f"out_{axis}"] == words[f"in_j{1 + (axis == 'y')}"] + (axis == "x"))
"""
CUT = """
import os, signal, time

signal.signal(signal.SIGINT, signal.default_int_handler)    # a shell ignores it for what runs behind it

def test_passes():
    pass

def test_is_cut():
    os.kill(os.getpid(), signal.{signal})
    time.sleep(9)
"""


def run(folder: Path, text: str, *options: str) -> tuple[int, ElementTree.Element | None, str]:
    """Pytest in the repository on a file of its own: exit code, JUnit, its summary in Markdown."""
    (folder / "test_made.py").write_text(text)
    file = folder / "test.xml"
    done = subprocess.run([sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-c", tools.ROOT /
                           "pyproject.toml", "--rootdir", tools.ROOT, "--confcutdir", tools.ROOT, "-p", "conftest",
                           folder / "test_made.py", "--junitxml", file, *options], cwd=tools.ROOT,
                          capture_output=True, text=True, env=os.environ | {"PYTHONPATH": f"{tools.ROOT}:"
                                                                           f"{tools.ROOT / 'models'}"})
    return done.returncode, ElementTree.parse(file) if file.exists() else None, summary.summary(file) + done.stdout


@pytest.mark.full
def test_a_failed_bench_says_sample_ports_waveform_and_command(tmp_path):
    code, found, text = run(tmp_path, BENCH)
    assert code == 1
    reason = next(found.iter("failure"))
    for said in (reason.get("message") + reason.text, text):
        assert "one_clock_of_reset at " in said and "sample 0 {" in said and "out_x" in said and "model {" in said
        assert "waveform: build/waves/" in said and "again:    make waves CORE=vector_fk1-broken SIM=" in said


def test_a_model_test_says_sample_port_and_what_went_in(tmp_path):
    code, found, text = run(tmp_path, MODEL)
    assert code == 1
    reason = next(found.iter("failure"))
    for said in (reason.text, text):
        for line in ("sample 7 is the first of 1 (of 9) that break found[f'out_{axis}'] ==", "words[in_j2] there: 14",
                     "found[out_y] there: 15", "axis: 'y'"):
            assert line in said


@pytest.mark.parametrize(("by", "codes"), [("SIGINT", (2,)), ("SIGKILL", (-9,))])
def test_a_run_that_is_cut_does_not_read_green(by, codes, tmp_path):
    (tmp_path / "test.xml").write_text("<testsuite><testcase classname='a' name='of an earlier run'/></testsuite>")
    code, found, text = run(tmp_path, CUT.format(signal=by))
    assert code in codes and int(next(found.iter("testsuite")).get("errors")) == 1
    assert "`pytest::the whole run`" in text and "earlier" not in text and " 1 failed" in text


def test_a_whole_run_has_no_such_error(tmp_path):
    code, found, text = run(tmp_path, "def test_passes():\n    pass\n")
    assert code == 0 and not list(found.iter("error")) and "**1 passed, 0 failed, 0 skipped**" in text
    code, found, text = run(tmp_path, "import numpy as np\ndef test_x():\n    assert np.array_equal([1, 2], [1, 3])\n")
    assert code == 1 and not list(found.iter("error")) and "sample 1 is the first of 1 (of 2)" in text


def reason_of(check) -> str:
    try:
        check()
    except AssertionError as error:
        return "\n".join(blame.failed(error.__traceback__))
    raise ValueError("it passed")


def test_forms_of_an_assertion():
    one, other = np.arange(6), np.array([0, 1, 2, 9, 4, 5])
    pairs, rows = {"out_x": one, "out_y": other}, np.stack([one, other])

    def equal_each():
        assert all(np.array_equal(pairs[port], one) for port in pairs)

    def method():
        assert (one <= 9).all() and (other - one == 0).all()

    def flags():
        bad = one == 4
        assert np.all(~bad)

    def shapes():
        assert np.array_equal(one, other[:3])

    def matrix():
        assert np.all(rows < 9)

    assert "with port = 'out_y'" in reason_of(equal_each) and "sample 3 is the first of 1" in reason_of(equal_each)
    assert "other - one == 0" in reason_of(method) and "other there: 9" in reason_of(method)
    assert "sample 4 is the first of 1 (of 6) that break ~bad" in reason_of(flags)
    assert "has the shape (3,)" in reason_of(shapes)
    assert "sample 1, 3 is the first" in reason_of(matrix)


def test_a_new_core_without_configuration_words_is_named():
    core = cores.find("vector_ik2")
    assert simulate.incomplete(core) == ""
    new = replace(core, name="vector_new", cfg=(*core.cfg, Port("cfg_mu", 8, False)))
    line = "vector_new: configs() in tb/stimulus/vector.py gives no word for "
    assert simulate.incomplete(new).startswith(line) and "cfg_mu" in simulate.incomplete(new)
    with pytest.raises(RuntimeError, match="vector_new: configs"):
        simulate.simulate(new, simulators()[0])


# The workflow: its commands, its shards, the summary of its results

WORKFLOW = ROOT / ".github" / "workflows" / "regression.yml"
MAKEFILE = (ROOT / "Makefile").read_text()
FLOW = yaml.safe_load(WORKFLOW.read_text())


@pytest.mark.parametrize("tool", [coverage, mutants, netlist], ids=lambda tool: tool.__name__)
def test_a_core_that_is_not_listed_ends_a_long_run_in_one_line(tool, monkeypatch):
    monkeypatch.setattr(sys, "argv", ["run", "vector_ik22"])
    with pytest.raises(SystemExit, match=r"^\w+: .*'vector_ik22'.*vector_ik2"):
        tool.main()


def test_every_command_of_the_workflow_is_a_target():
    text = WORKFLOW.read_text()
    targets = set(re.findall(r"^([a-z-]+):", MAKEFILE, re.M))
    used = set(re.findall(r"make ([a-z-]+)", text)) | {
        name for job in FLOW["jobs"].values() for name in job["strategy"]["matrix"].get("what", ())}
    assert {"test", "setup", "lint", "formal", "exhaustive"} <= used <= targets
    for path in re.findall(r"(?:ci|models|tb)/[\w/]+\.py", text):
        assert (ROOT / path).exists(), path


def test_the_shards_are_all_tests_once(pytester):
    pytester.copy_example(str(ROOT / "conftest.py"))
    pytester.makepyfile("import pytest\n@pytest.mark.parametrize('i', range(7))\ndef test(i): pass\n")
    shards = FLOW["jobs"]["test"]["strategy"]["matrix"]["shard"]
    texts = [pytester.runpytest("--collect-only", "-q", "--shard", shard).stdout.str() for shard in shards]
    kept = [name for text in texts for name in re.findall(r"::test\[(\d)\]", text)]
    assert sorted(kept) == list("0123456")
    assert "it is K/N" in pytester.runpytest("--shard", "7/6").stderr.str()


def test_the_summary(tmp_path):
    file = tmp_path / "test.xml"
    assert "was not written" in summary.summary(file)
    file.write_text('<testsuite><testcase classname="a" name="b" time="2"/><testcase classname="a" name="c" time="3">'
                    '<failure message="no">line\nlast</failure></testcase>'
                    '<testcase classname="a" name="d" time="0"><skipped/></testcase></testsuite>')
    text = summary.summary(file)
    assert "**1 passed, 1 failed, 1 skipped**" in text and "`a::c`" in text and "  last" in text
    assert text.index("| `a::c` | 3.0 |") < text.index("| `a::b` | 2.0 |")
    done = subprocess.run([sys.executable, "-S", summary.__file__, file], capture_output=True, text=True)
    assert done.stdout == text


# Waveforms


@pytest.fixture
def broken(tmp_path):
    """A core whose model does not agree with it in one bit of x."""
    core = cores.find("vector_fk1")
    file = tmp_path / "vector_fk1.v"
    text = core.sources[0].read_text()
    assert text.count("out_x  <= out_y;") == 1
    file.write_text(text.replace("out_x  <= out_y;", "out_x  <= out_y ^ 1'b1;"))
    return replace(core, sources=(file, *core.sources[1:]), set_id="broken")


def test_a_failure_is_recorded_with_its_time_and_a_command(broken, monkeypatch, tmp_path):
    monkeypatch.setattr(waves, "FOLDER", tmp_path)
    simulator = simulators()[0]
    first, where, again, *others = waves.explain(broken, simulator, 5)
    found = re.match(r"one_clock_of_reset fails at ([\d.]+) ns: .*out_x", first)
    assert found and float(found[1]) > 50 and float(found[1]) % 5 == 0  # on an edge of the clock of 10 ns
    wave = tools.ROOT / where.partition(": ")[2]
    assert wave.parent.resolve() == tmp_path and wave.stat().st_size > 1000
    assert again == f"again:    make waves CORE=vector_fk1-broken SIM={simulator} TEST=one_clock_of_reset SEED=5"
    assert "also fails: corners_back_to_back" in others


def test_the_tests_of_a_core_are_named():
    clocked = waves.tests_of(cores.find("vector_fk1"))
    assert clocked[0] == "one_clock_of_reset" and "corners_and_random_combinational" not in clocked
    assert waves.tests_of(cores.find("isqrt_comb")) == ["corners_and_random_combinational"]


def test_without_icarus_the_waveform_is_a_vcd(monkeypatch, tmp_path):
    monkeypatch.setattr(simulate.Verilator, "build_command",
                        lambda self: [["verilator", "--trace-fst"], ["make"], ["./top"]])
    run = simulate.Traced(toplevel="top", module="none", verilog_sources=["a.v"], sim_build=str(tmp_path))
    verilate, make, start = run.build_command()
    assert verilate == ["verilator", "--trace-vcd"] and start == ["./top", "--trace", "--trace-file", "top.vcd"]


def test_sim_leaves_icarus_out(monkeypatch):
    monkeypatch.setenv("SIM", "verilator")
    assert not simulate.available("icarus") and simulate.available("verilator")


def test_core_and_sim_choose_the_tests():
    def item(core, simulator=None, keywords=()):
        params = {"core": core} | ({"simulator": simulator} if simulator else {})
        return SimpleNamespace(callspec=SimpleNamespace(params=params), nodeid="tb/test_x.py::x", keywords=keywords)

    def chosen(**options):
        left, config = list(items), SimpleNamespace(getoption=lambda name: options.get(name[2:]),
                                                    hook=SimpleNamespace(pytest_deselected=lambda items: None))
        conftest.pytest_collection_modifyitems(config, left)
        return [items.index(one) for one in left]

    one, other = cores.find("vector_fk1-U16"), cores.find("vector_fk2-U16")
    items = [item(one, "icarus"), item(one, "verilator"), item(one), item(other, "icarus"), item("a string"),
             SimpleNamespace(keywords=()), item(one, keywords=("further",))]
    assert chosen() == [0, 1, 2, 3, 4, 5]
    assert chosen(core="vector_fk1") == chosen(core="vector_fk1-U16") == [0, 1, 2, 6]
    assert chosen(core="vector_fk1", sim="verilator") == [1, 2, 6]  # a bulk run is Verilator's
    assert chosen(sim="icarus") == [0, 3, 4, 5]  # and what simulates no core


def test_a_core_that_is_not_there_is_refused():
    config = SimpleNamespace(getoption={"--core": "vector_fk9"}.get)
    with pytest.raises(pytest.UsageError, match="no core 'vector_fk9'; did you mean"):
        conftest.pytest_configure(config)


def test_progress_has_names(capsys):
    names = conftest.Names()
    names.last, names.live = -1e9, False
    names.pytest_collection_finish(SimpleNamespace(items=[1, 2]))
    names.pytest_runtest_logreport(SimpleNamespace(failed=True, when="call", nodeid="a.py::b"))
    names.pytest_runtest_logreport(SimpleNamespace(failed=False, when="teardown", nodeid="a.py::b"))
    assert capsys.readouterr().err == "FAILED a.py::b\n1 of 2  a.py::b\n"
