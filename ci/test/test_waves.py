"""A core broken on purpose is recorded, with the time of the fault and a command that repeats it."""

import re
from dataclasses import replace
from types import SimpleNamespace

import pytest
from quadrance import cores

import conftest
from ci import waves
from tb.lib import simulate, tools
from tb.lib.suite import simulators


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
