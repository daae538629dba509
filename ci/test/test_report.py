"""Tables, sentences, documents and plots of the report, on made-up figures: no tool runs."""

import copy
import json
from dataclasses import replace

import pytest
from quadrance import cores
from quadrance.cli.catalogue import Refused

from ci import accuracy
from ci.report import README, blocks, comparison, documents, figures, measure, paper, rows, run, tables, terminal

FRONT = """# Title
<!-- report:headline -->
old
<!-- /report:headline -->
text
<!-- report:paper -->
<!-- /report:paper -->
<!-- report:smaller -->
<!-- /report:smaller -->
"""
PAGE = """# Page
<!-- figures:rational_fk1 classic_fk1_iter-S24 -->
old
<!-- /figures -->
text
<!-- figures:isqrt_iter -->
<!-- /figures -->
"""


def test_plots_carry_the_digest_of_their_figures(tmp_path, made):
    figures.draw(made, {("fk2", "paper"): {"arithmetic": [[0.5]], "words": [[2.0]]}}, tmp_path)
    for plot in figures.plots(made):
        png = (tmp_path / plot).read_bytes()
        assert png.startswith(b"\x89PNG") and figures.stamp(made).encode() in png and len(png) > 10000


def test_plots_are_stale_when_figures_arm_or_drawing_change(made, monkeypatch):
    before = figures.stamp(made)
    for change in ({"arm": "other"}, {"simulation": {"a.py": "1"}}, {"cores": {"a": "1"}}):
        assert figures.stamp(made | {"sources": made["sources"] | change}) != before
    other = copy.deepcopy(made)
    other["cores"][0]["latency_ns"] += 1
    assert figures.stamp(other) != before
    monkeypatch.setattr(figures, "CODE", figures.CODE[1:])
    assert figures.stamp(made) != before


@pytest.mark.parametrize("text, message", [
    ("no blocks", "has no <!-- report:headline -->"),
    ("<!-- report:headline -->\n", "open as \\['headline'\\] and close as \\[\\]"),
    ("<!-- report:speed -->\n<!-- /report:speed -->",
     "no report block is called 'speed'; there are headline, smaller, paper, pareto"),
])
def test_wrong_markers_in_the_readme(made, text, message):
    with pytest.raises(ValueError, match=message):
        blocks.readme(text, made)


def test_readme_blocks_are_replaced_and_nothing_else(made):
    once = blocks.readme(FRONT, made)
    assert once == blocks.readme(once, made)
    assert "old" not in once and once.startswith("# Title\n<!-- report:headline -->\n|  | unit vector")
    assert "\ntext\n" in once and "Table III" in once and "Iterative CORDIC is smaller than `rational_*`" in once


def test_the_readme_has_a_row_a_function(made, small):
    made["cores"].insert(2, small)
    table = tables.headline_table(made)
    assert table.rows == (
        ("`fk1` forward, 1 joint", "–", "–", "280 + 1 DSP; 18 cycles, 180 ns; 0.0586 mm",
         "120 + 1 DSP; 2 cycles, 20 ns; 0.0977 mm"),
        ("`ik1` inverse, 1 joint", "–", "–", "270 + 1 DSP; 17 cycles, 170 ns; 0.0977 mm",
         "300 + 1 DSP; 9 cycles, 90 ns; 0.0977 mm"))
    del made["cores"][1]
    assert tables.headline_table(made).rows[0][4] == "–"


def test_figures_on_pages_are_filled(made, small):
    made["cores"].append(small)
    once = blocks.page(PAGE, made["cores"], "rtl/a/README.md")
    assert once == blocks.page(once, made["cores"], "rtl/a/README.md")
    assert once.startswith("# Page\n<!-- figures:rational_fk1 classic_fk1_iter-S24 -->\n| core | ALUT |")
    assert "| `rational_fk1-S24` | 120 | 100 | 1 | 0 | 320 | 2 | 2 | 100 | 0.7 |\n| `classic_fk1_iter-S24` |" in once
    assert "\ntext\n" in once and "| `isqrt_iter-S24` | 61 | 100 | 1 | 0 | 261 | 9 | 9 | 100 | 0.99 |" in once
    assert "W12" not in once, "name-set is one parameter set"
    both = blocks.page(PAGE.replace("_iter-S24", "_iter"), made["cores"], "rtl/a/README.md")
    assert "`classic_fk1_iter-S24`" in both and "`classic_fk1_iter-W12`" in both, "a name is all of its sets"


@pytest.mark.parametrize("text, message", [
    ("<!-- figures:rational_fk9 -->\n<!-- /figures -->", "p.md: figures of 'rational_fk9': there is no such core"),
    ("<!-- figures:rational_fk1-S9 -->\n<!-- /figures -->", "p.md: figures of 'rational_fk1-S9': there is no such"),
    ("<!-- figures:rational_fk1 -->\n", "p.md: a figures block is not"),
    ("<!-- /figures -->\n", "p.md: a figures block is not"),
    ("<!-- figures -->\n<!-- /figures -->", "p.md: a figures block is not"),
    ("<!-- figures:rational_fk1 -->\n<!-- figures:isqrt_iter -->\n<!-- /figures -->", "p.md: a figures block is not"),
    ("<!-- figures: -->\n<!-- /figures -->", "p.md: a figures block names no core"),
])
def test_wrong_figures_blocks_on_pages(made, text, message):
    with pytest.raises(ValueError, match=message):
        blocks.page(text, made["cores"], "p.md")


def test_wrong_markers_are_found_before_anything_is_measured(tmp_path):
    readme, page = tmp_path / "README.md", tmp_path / "rtl" / "rational" / "README.md"
    page.parent.mkdir(parents=True)
    readme.write_text(FRONT)
    core = cores.find("rational_fk1")
    page.write_text(f"<!-- figures:{core.name} {core.id} -->\n<!-- /figures -->\n")
    assert blocks.wrong(readme, tmp_path / "rtl", [core]) == []
    page.write_text("<!-- figures:rational_fk9 -->\n<!-- /figures -->\n")
    readme.write_text("<!-- report:headline -->\n")
    assert blocks.wrong(readme, tmp_path / "rtl", [core]) == [
        "README.md: report blocks open as ['headline'] and close as []",
        "rtl/rational/README.md: figures of 'rational_fk9': there is no such core"]


def test_the_house_has_no_wrong_marker():
    assert blocks.wrong(README, cores.RTL, cores.all_cores()) == []


def test_markdown_has_every_core_and_well_formed_tables(made):
    text = documents.markdown(made)
    for one in made["cores"]:
        assert f"`{rows.name(one)}`" in text
    for block in text.split("\n\n"):
        if block.startswith("|"):
            assert len({line.count("|") for line in block.splitlines()}) == 1
    assert "| `paper_fk1-S24` | comb | 2 | 2 | 30 | 66.7 | 340 | 100 | 1 | 0 | 540 | 740 | 490 |" in text
    assert "| `paper_fk1-S24` | 0.7 | 0.35 | 0.0273 | 0.0137 | 0.7 | 0.35 | 600 | 23.4 | 600 | 23.5 |" in text
    assert "| `isqrt_iter-S24` | 0.99 | 0.5 |" in text


def test_every_column_is_explained(made):
    kinematic = rows.pick(made, rows.KINEMATIC)
    for table, words in ((tables.cost_table("", kinematic), documents.COST_COLUMNS),
                         (tables.accuracy_table("", kinematic), documents.ERROR_COLUMNS)):
        for head in table.head:
            word = head.removesuffix(" LSB").removesuffix(" mm").split(" max")[0].split(" rms")[0]
            assert word in ("core", "architecture", "rms") or f"**{word}" in words, head


def test_paper_tables_show_both_axes_against_both_architectures(made):
    le, ik, cycles = paper.paper_tables(made)
    assert le.rows == (("FK1", "359", "340 + 1 DSP (540)", "120 + 1 DSP (320)", "1573", "1400 + 1 DSP (1600)", "–",
                        "280 + 1 DSP (480)"),)
    assert ik.rows == (("IK1", "317", "–", "300 + 1 DSP (500)", "1569", "–", "–", "270 + 1 DSP (470)"),)
    assert cycles.rows == (("FK1", "2", "2 (66.7 ns, 30 MHz)", "2 (20 ns)", "–", "1 (40 ns, 25 MHz)", "22",
                            "18 (180 ns)"),)


def test_sentences_say_where_cordic_wins(made):
    wins = comparison.cordic_wins(made)
    assert "FK1, latency in cycles: `classic_fk1_comb-S24` 1 against 2 of `rational_fk1-S24`." in wins
    assert "IK1, ALUT with DSP blocks: `classic_ik1_iter-S24` 270 against 300 of `rational_ik1-S24`." in wins
    assert ("FK1, greatest error of the words: `classic_fk1_iter-S24` 0.9 LSB against 2 LSB of `rational_fk1-S24`."
            in wins)
    assert "FK1, greatest total error: `classic_fk1_iter-S24` 1.5 LSB against 2.5 LSB of `rational_fk1-S24`." in wins
    assert not any(sentence.startswith("FK1, ALUT") for sentence in wins)


def test_one_sentence_says_where_cordic_is_smaller(made):
    def sentence(report=made):
        return comparison.where_cordic_is_smaller(report, "rational")

    assert sentence() == (
        "Iterative CORDIC is smaller than `rational_*` in logic when there are no DSP blocks for ik1 (470 against 500) "
        "and in logic beside DSP blocks for ik1 (270 against 300).")
    for one in made["cores"]:
        one["area"]["cyclonev"] = one["area"]["cyclonev"] | {"mem": 4 if one["family"] == "rational" else 0}
    assert "and in memory blocks for every function (0 against 4)." in sentence()
    made["cores"][5]["area"]["cyclonev"] |= {"lut": 400, "mem": 4}
    made["cores"][5]["area"]["cyclonev_nodsp"] |= {"lut": 600}
    assert sentence() == \
        "Iterative CORDIC is smaller than `rational_*` in memory blocks for fk1 (0 against 4)."
    made["cores"][2]["area"]["cyclonev"] |= {"mem": 5}
    assert sentence() == "Iterative CORDIC is nowhere smaller than `rational_*`."
    assert sentence({"cores": []}) == "No function has both `rational_*` and iterative CORDIC yet."


def test_the_pareto_goal_is_judged_with_the_miss(made):
    fk1, ik1 = comparison.pareto(made)
    assert fk1 == ("FK1: no rational core beats `classic_fk1_iter-S24` in area and cycles at no larger error; the "
                   "closest, `rational_fk1-S24`, has a 0.1 LSB larger error.")
    assert ik1.endswith("the closest, `rational_ik1-S24`, has 30 ALUTs more.")
    made["cores"][1]["error_lsb"]["max"] = 0.6
    assert "has a 0.1 LSB larger error" in comparison.pareto(made)[0], "the sweep counts as the trajectory does"
    made["cores"][1]["sweep_error_lsb"]["max"] = 0.6
    assert comparison.pareto(made)[0] == ("FK1: `rational_fk1-S24` takes fewer ALUTs and fewer cycles than "
                                          "`classic_fk1_iter-S24` at no larger arithmetic error.")
    made["cores"][4] |= {"latency_cycles": 17}
    made["cores"][4]["area"]["cyclonev"]["lut"] = 270
    assert comparison.pareto(made)[1].endswith("`rational_ik1-S24`, has as many ALUTs and as many cycles.")


def test_smaller_parameter_sets_are_not_compared(made, small):
    """A twelve-bit CORDIC must not stand for the family against a sixteen-bit rational core."""
    def compared():
        return (paper.paper_tables(made), comparison.cordic_wins(made), comparison.pareto(made),
                comparison.where_cordic_is_smaller(made, "rational"), tables.headline_table(made),
                tables.glance_table(made))

    before = compared()
    made["cores"].insert(3, small)
    assert before == compared()
    assert "`classic_fk1_iter-W12`" in documents.markdown(made)


@pytest.mark.parametrize("value, text", [(None, "–"), (0, "0"), (0.00004, "< 0.001"), (0.01234, "0.0123"),
                                         (123.4, "123"), (1234.5, "1234"), (12345.6, "12346"), (2.0, "2")])
def test_numbers(value, text):
    assert rows.number(value) == text


def test_rows_are_complete_and_rounded(made):
    core = replace(cores.find("isqrt_comb"), latency=0)
    simulated = dict.fromkeys(measure.FIGURES) | {"latency_cycles": 0, "ii": 0,
                                                  "error_lsb": {"max": 0.123456789, "rms": 0.1}}
    row = run.row_of(core, {"ecp5": made["cores"][0]["area"]["ecp5"]}, 80.0, simulated)
    assert row["latency_ns"] == 12.5 and row["error_lsb"]["max"] == 0.123457
    assert set(row) == set(made["cores"][0]), "rows have one shape"
    assert json.loads(json.dumps(row)) == row


def test_the_report_prints(made, capsys):
    terminal.show(made)
    printed = capsys.readouterr().out
    assert "rational_fk1-S24" in printed and "Where CORDIC wins" in printed and "Table III" in printed


@pytest.mark.parametrize("name", ["classic_fk1_iter", "engine_quaternion_gd"])  # the latency of the second varies
def test_the_models_give_the_figures_of_the_committed_report(name):
    """What another arm's report is made by: on the committed arm the same figures as the simulation."""
    committed = json.loads((run.REPORTS / "report.json").read_text())
    core = cores.find(name)
    row = next(one for one in committed["cores"] if (one["core"], one["set"]) == (core.name, core.set_id))
    found = measure.simulate(core, committed["arm"], measure.modelled)
    assert run._rounded({key: found[key] for key in measure.FIGURES}) == {key: row[key] for key in measure.FIGURES}


def test_where_the_report_of_another_arm_goes(tmp_path):
    assert run.folder_of("ur5") == run.OTHERS / "ur5" and run.folder_of("ur5", str(tmp_path)) == tmp_path
    for arm, out in (("cobra600", str(tmp_path)), ("ur5", str(run.REPORTS))):
        with pytest.raises(ValueError, match="OUT="):
            run.folder_of(arm, out)


def test_the_accuracy_of_one_core():
    lines = accuracy.lines("cobra600", "vector_fk1")
    assert lines[0].startswith("vector_fk1-U16 on Omron") and len(lines) == 5
    with pytest.raises(Refused, match="is a part"):
        accuracy.lines("cobra600", "isqrt_iter")
