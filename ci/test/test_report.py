"""Tables, sentences, documents and plots of the report, on made-up figures: no tool runs."""

import copy
import json
from dataclasses import replace

import pytest
from quadrance import cores

from ci.report import README, REPORTS, comparison, documents, figures, measure, run, tables

FRONT = """# Title
<!-- report:headline -->
old
<!-- /report:headline -->
text
"""


def test_plots_carry_the_digest_of_their_figures(tmp_path, made):
    figures.draw(made, {("fk2", "paper"): {"arithmetic": [[0.5]], "words": [[2.0]]}}, tmp_path)
    for plot in figures.plots(made):
        png = (tmp_path / plot).read_bytes()
        assert png.startswith(b"\x89PNG") and figures.stamp(made).encode() in png and len(png) > 10000


def collisions(figure):
    """Pairs of names in one panel that overlap, and names that leave it."""
    found = []
    for axis in figure.axes:
        boxes = [(text.get_text(), text.get_window_extent()) for text in axis.texts]
        found += [(a, b) for i, (a, one) in enumerate(boxes) for b, other in boxes[:i] if one.overlaps(other)]
        found += [text for text, box in boxes if not all(map(axis.bbox.contains, *zip(box.min, box.max)))]
    return found


def test_names_in_the_plots_do_not_collide():
    report = json.loads((REPORTS / "report.json").read_text())
    rows = tables.q7_8(tables.pick(report, tables.KINEMATIC))
    crowded = [row | {"set": row["set"] + "PIPE1", "latency_ns": row["latency_ns"] * 0.95} for row in rows
               if row["family"] in ("vector", "table")]
    assert collisions(figures._area(rows + crowded)) == []
    assert collisions(figures._verdict(report["verdict"])) == []
    figure, axis = figures.pyplot.subplots()
    axis.plot([0, 1], [0, 1])
    for x in (0.3, 0.31):
        axis.annotate("a name", (x, 0.5))
    assert collisions(figure), "this test can fail"
    figures.pyplot.close("all")


def test_plots_are_stale_when_figures_arm_or_drawing_change(made, monkeypatch):
    before = figures.stamp(made)
    for change in ({"arm": "other"}, {"simulation": {"a.py": "1"}}, {"cores": {"a": "1"}}):
        assert figures.stamp(made | {"sources": made["sources"] | change}) != before
    other = copy.deepcopy(made)
    other["cores"][0]["latency_ns"] += 1
    assert figures.stamp(other) != before
    monkeypatch.setattr(figures, "CODE", figures.CODE[1:])
    assert figures.stamp(made) != before


@pytest.mark.parametrize("text", ["no marks", "<!-- report:headline -->\n", FRONT + FRONT,
                                  FRONT + "<!-- report:speed -->\n<!-- /report:speed -->"])
def test_wrong_marks_in_the_readme(made, text, tmp_path):
    with pytest.raises(ValueError, match="README.md: marks are .* are wanted, once"):
        documents.readme(text, made)
    (tmp_path / "README.md").write_text(text)
    assert len(documents.wrong_marks(tmp_path / "README.md")) == 1, "found before minutes of measuring"


def test_the_headline_is_replaced_and_nothing_else(made):
    once = documents.readme(FRONT, made)
    assert once == documents.readme(once, made)
    assert "old" not in once and once.startswith("# Title\n<!-- report:headline -->\n| on ECP5 | unit vector")
    assert once.endswith("|\n<!-- /report:headline -->\ntext\n") and documents.wrong_marks(README) == []


def test_the_readme_has_a_row_a_function(made, small):
    made["cores"].insert(2, small)
    table = tables.headline_table(made)
    assert table.rows == (
        ("`fk1` forward, 1 joint", "–", "–", "430/1/0; 18 (180); 0.0586",
         "270/1/0; 2 (20); 0.0977"),
        ("`ik1` inverse, 1 joint", "–", "–", "420/1/0; 17 (170); 0.0977",
         "450/1/0; 9 (90); 0.0977"))
    del made["cores"][1]
    assert tables.headline_table(made).rows[0][4] == "–"


def test_markdown_has_every_core_and_well_formed_tables(made):
    text = documents.markdown(made)
    for one in made["cores"]:
        assert f"`{tables.name(one)}`" in text
    for block in text.split("\n\n"):
        if block.startswith("|"):
            assert len({line.count("|") for line in block.splitlines()}) == 1
    assert "| `paper_fk1-S24` | 2 | 2 | 30 | 66.7 | 490 | 100 | 1 |" in text
    assert "| `paper_fk1-S24` | 340 | 100 | 1 | 540 |" in text and "| `paper_fk1-S24` | 740 |" in text
    assert "| `paper_fk1-S24` | 0.7 | 0.35 | 600 | 600 | 23.5 |" in text
    assert "| `isqrt_iter-S24` | 0.99 | 0.5 |" in text


def test_every_column_is_explained(made):
    kinematic = tables.pick(made, tables.KINEMATIC)
    for table, words in (*((one, documents.COST_COLUMNS) for one in tables.cost_tables("", kinematic)),
                         (tables.accuracy_table("", kinematic), documents.ERROR_COLUMNS)):
        for head in table.head:
            word = head.removesuffix(" LSB").removesuffix(" mm")
            assert word == "core" or f"**{word}**" in words, head


def test_blocks_that_no_core_takes_have_no_column(made):
    def heads():
        return [table.head for table in tables.cost_tables("", made["cores"])]

    assert "MULT18X18" in heads()[0] and not {"EBR", "LUTRAM"} & set(heads()[0]) and "M10K" not in heads()[1]
    made["cores"][-1]["area"]["ecp5"]["lutram"] = 4
    assert "| 211 (4 LUTRAM) |" in tables.cost_tables("", made["cores"])[0].markdown()


def test_the_page_has_the_first_set_of_each_mode(made):
    iterative = made["cores"][2]
    made["cores"][2:3] = [iterative | {"set": key, "params": {"MODE": mode, "W": 16, "F": 8, "A": bits}}
                          for key, mode, bits in (("iter", 0, 16), ("iter-A12", 0, 12), ("comb", 1, 16))]
    text = documents.markdown(made)
    assert text.count("_iter-iter`") == 3 + 1 and "_iter-A12`" not in text
    assert text.count("_iter-comb`") == 3, "a table each device, none of errors: they have the same bits"


def test_paper_tables_show_both_axes_against_both_architectures(made):
    le, ik, cycles = comparison.paper_tables(made)
    assert le.rows == (("FK1", "359", "340/1/0 (540)", "120/1/0 (320)", "1573", "1400/1/0 (1600)", "–",
                        "280/1/0 (480)"),)
    assert ik.rows == (("IK1", "317", "–", "300/1/0 (500)", "1569", "–", "–", "270/1/0 (470)"),)
    assert cycles.rows == (("FK1", "2", "2 (66.7 ns, 30 MHz)", "2 (20 ns)", "–", "1 (40 ns, 25 MHz)", "22",
                            "18 (180 ns)"),)


def test_where_cordic_has_less(made):
    table = tables.cordic_table(made)
    assert table.head == ("", "fk1", "ik1", "CORDIC has less in")
    lines = {line[0]: line[1:] for line in table.rows}
    assert lines["Cyclone V ALUT"] == ("120/280", "300/270", "ik1")
    assert lines["cycles"] == ("2/1", "9/17", "fk1") and lines["words LSB"] == ("2/0.9", "2/2", "fk1")
    assert lines["total LSB"] == ("2.5/1.5", "2.5/2.5", "fk1")
    assert lines["ECP5 MULT18X18"] == ("1/1", "1/1", "–")
    made["cores"] = [one for one in made["cores"] if one["family"] != "classic"]
    assert tables.cordic_table(made).rows == ()


def test_a_row_speaks_of_one_device(made):
    for text in (documents.markdown(made), README.read_text()):
        assert tables.mixed(text, "x") == []
    for head, cell in (("| core | ALUT | ns |", "| a | 1 | 2 |"), ("| core | ALUT |", "| a | 3, 12 ns |"),
                       ("|  | area |", "| a | 380 LUT + 2 DSP |"), ("| MHz | LC |", "| 1 | 2 |")):
        text = f"text\n\n{head}\n|---|---|\n{cell}\n"
        assert any("x:5: one row, one device: " in one for one in tables.mixed(text, "x")), head
    assert tables.mixed("| core | `ns` | ALUT, no DSP |\n|--|--|--|\n| a | 1 | 2 |", "x") == []


def test_smaller_parameter_sets_are_not_compared(made, small, capsys):
    """A twelve-bit CORDIC must not stand for the family against a sixteen-bit rational core."""
    def compared():
        return comparison.paper_tables(made), tables.cordic_table(made), tables.headline_table(made)

    before = compared()
    made["cores"].insert(3, small)
    assert before == compared()
    documents.show(made)
    assert "classic_fk1_iter-W12" in capsys.readouterr().out, "every set is printed"


@pytest.mark.parametrize("value, text", [(None, "–"), (0, "0"), (0.00004, "<0.001"), (0.01234, "0.0123"),
                                         (123.4, "123"), (1234.5, "1234"), (12345.6, "12346"), (2.0, "2")])
def test_numbers(value, text):
    assert tables.number(value) == text


def test_rows_are_complete_androunded(made):
    core = replace(cores.find("isqrt_comb"), latency=0)
    simulated = dict.fromkeys(measure.FIGURES) | {"latency_cycles": 0, "ii": 0,
                                                  "error_lsb": {"max": 0.123456789, "rms": 0.1}}
    row = run.row_of(core, {"ecp5": made["cores"][0]["area"]["ecp5"]}, 80.0, simulated)
    assert row["latency_ns"] == 12.5 and row["error_lsb"]["max"] == 0.123457
    assert set(row) == set(made["cores"][0]), "rows have one shape"
    assert json.loads(json.dumps(row)) == row


def test_the_report_prints(made, capsys):
    documents.show(made)
    printed = capsys.readouterr().out
    assert "rational_fk1-S24" in printed and "CORDIC has less in" in printed and "Table III" in printed


@pytest.mark.parametrize("name", ["classic_fk1", "engine_quaternion_gd"])  # the latency of the second varies
def test_the_models_give_the_figures_of_the_committed_report(name):
    """What another arm's report is made by: on the committed arm the same figures as the simulation."""
    committed = json.loads((run.REPORTS / "report.json").read_text())
    core = cores.find(name)
    row = next(one for one in committed["cores"] if (one["core"], one["set"]) == (core.name, core.set_id))
    found = measure.simulate(core, committed["arm"], measure.modelled)
    assert run.rounded({key: found[key] for key in measure.FIGURES}) == {key: row[key] for key in measure.FIGURES}


def test_where_the_report_of_another_arm_goes(tmp_path):
    assert run.folder_of("ur5") == run.OTHERS / "ur5" and run.folder_of("ur5", str(tmp_path)) == tmp_path
    for arm, out in (("cobra600", str(tmp_path)), ("ur5", str(run.REPORTS))):
        with pytest.raises(ValueError, match="OUT="):
            run.folder_of(arm, out)
