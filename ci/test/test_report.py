"""Tables, sentences, documents and plots of the report on made-up figures, and the pictures of pages: no tool runs."""

import copy
import json
import re
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image
from quadrance import accuracy, arms, cores, truth

from ci.cache import digest
from ci.figures import FOLDER, diagrams, fill, front, gradient, newton
from ci.report import README, REPORTS, comparison, documents, figures, measure, run, tables
from tb.lib.simulate import available

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
    crowded = [row | {"set": row["set"] + "PIPE2", "latency_ns": row["latency_ns"] * 0.95} for row in rows
               if row["family"] in ("vector", "table") and not row["params"].get("PIPE")]
    assert collisions(figures._area(rows)) == []
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
        if "\n:--" in block:
            assert len({line.count("|") for line in block.splitlines()}) == 1
    assert "\n`paper_fk1-S24` | 2 | 2 | 30 | 66.7 | 490 | 100 | 1\n" in text
    assert "\n`paper_fk1-S24` | 340 | 100 | 1 | 540\n" in text and "\n`paper_fk1-S24` | 740\n" in text
    assert "\n`paper_fk1-S24` | 0.7 | 0.35 | 600 | 600 | 23.5\n" in text
    assert "\n`isqrt_iter-S24` | 0.99 | 0.5\n" in text


def test_every_column_is_explained(made):
    kinematic = tables.pick(made, tables.KINEMATIC)
    for table, words in (*((one, documents.COST_COLUMNS) for one in tables.cost_tables("", kinematic)),
                         (tables.up5k_table(made), documents.COST_COLUMNS),
                         (tables.accuracy_table("", kinematic), documents.ERROR_COLUMNS)):
        for head in table.head:
            word = head.removesuffix(" LSB").removesuffix(" mm")
            assert word == "core" or f"**{word}**" in words, head


def test_the_small_chip_has_a_row_a_core_of_the_headline(made):
    row = {"lut": 700, "ff": 551, "dsp": 8, "mem": 10, "mhz": 30.0}
    made["up5k"] = {"rows": {"rational_fk1-S24": row, "rational_ik1-S24": row | {"mhz": None}}}
    text = documents.markdown(made)
    for line in ("`rational_fk1-S24` | 700 | 8 | 10 | 30 | 66.7", "`rational_ik1-S24` | 700 | 8 | 10 | – | –"):
        assert f"\n{line}\n" in text
    assert tables.mixed(text, "x") == []


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
    assert table.head == ("figure", "fk1", "ik1", "CORDIC has less in")
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
    for head, cell in (("| core | ALUT | ns |", "| a | 1 | 2 |"), ("core | ALUT | ns", "a | 1 | 2"),
                       ("| core | ALUT |", "| a | 3, 12 ns |"),
                       ("|  | area |", "| a | 380 LUT + 2 DSP |"), ("| MHz | LC |", "| 1 | 2 |"),
                       ("| LUT | UP5K MHz |", "| 1 | 2 |")):
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


# Cores beside each other: the verdict, chains, engines, their tables

TARGET = "1 LSB"


@pytest.fixture(autouse=True)
def targets(monkeypatch):
    """Whatever targets the list has: these."""
    monkeypatch.setattr(comparison, "TARGETS", ("0.1 mm", "2 LSB", "1 LSB", "1/2 LSB"))


def part(lut, dsp=0, mem=0, nodsp=None, cycles=2, ii=None, mhz=100.0):
    """A part with plain figures; without DSP blocks 500 ALUTs more for each."""
    area = {"lut": lut, "ff": 10, "dsp": dsp, "mem": mem}
    return {"core": "x", "params": {}, "digest": "", "cycles": cycles, "ii": ii or cycles, "fmax_mhz": mhz,
            "area": {"ecp5": area | {"lut": lut + 9, "lutram": 0}, "cyclonev": area,
                     "cyclonev_nodsp": area | {"dsp": 0, "lut": nodsp or lut + 500 * dsp}}}


def design(core, family, function, picks, word="angle", codec=None, best=0.3):
    """A design with a pick (target, bits of the word, total, [part, copies] ...) for each target it reaches."""
    made = {target: None for target in comparison.TARGETS} | {
        target: {"values": {"W": 16, "F": 8, "A": bits}, "total_lsb": total, "bits": bits, "parts": parts}
        for target, bits, total, *parts in picks}
    return {"core": core, "codec": codec, "family": family, "function": function, "architecture": "", "word": word,
            "best_lsb": best, "picks": made, "digest": ""}


@pytest.fixture
def found():
    """Three families of fk1, one of them too coarse for 1 LSB; fk2 in two; ik1 in two."""
    designs = [
        design("table_fk1", "table", "fk1", [(TARGET, 16, 0.9, ["t", 1]), ("2 LSB", 15, 1.9, ["t", 1])]),
        design("classic_fk1_iter", "classic", "fk1", [(TARGET, 16, 0.95, ["c", 1])]),
        design("rational_fk1", "rational", "fk1", [("2 LSB", 26, 1.5, ["r", 1])], word="spread", best=1.4),
        design("table_fk2", "table", "fk2", [(TARGET, 18, 0.9, ["t2", 1])]),
        design("rational_fk2", "rational", "fk2", [(TARGET, 30, 0.9, ["r2", 1])], word="spread"),
        design("table_ik1", "table", "ik1", [(TARGET, 18, 0.9, ["ti", 1])]),
        design("rational_ik1", "rational", "ik1", [(TARGET, 28, 0.9, ["ri", 1])], word="spread"),
        design("vector_fk2", "vector", "fk2", [("0.1 mm", 18, 2.0, ["v", 1], ["av", 2])], codec="angle_to_vector")]
    designs[-1]["picks"]["0.1 mm"]["values"]["word"] = 16
    return {"designs": {one["core"]: one for one in designs}, "open": [], "figures": "", "parts": {
        "t": part(70, 2, 2, cycles=3, mhz=50.0), "c": part(300, cycles=15),
        "r": part(120, 2, 4), "t2": part(120, 2, 2, cycles=5, ii=4), "r2": part(320, 2, 7, cycles=6),
        "ti": part(130, 3, 3, cycles=4), "ri": part(180, 2, 2, cycles=4), "v": part(130, 2, cycles=4, mhz=80.0),
        "av": part(60, 1, 1, cycles=2, mhz=40.0)}}


def sets(found, function="fk1", target=TARGET):
    return {one["core"]: one for one in comparison.reaching(found, function, target)}


def report(found, *rows):
    return {"cores": list(rows), "verdict": found}


def winners(found, device="ECP5"):
    table = comparison.winners_table(found, device)
    return {(line[0], target): dict(zip(table.head[2:], line[2:]))
            for line in table.rows for target in line[1].split(", ")}


def test_an_infeasible_core_is_not_among_the_winners(found):
    assert list(sets(found)) == ["table_fk1", "classic_fk1_iter"]
    assert list(sets(found, target="2 LSB")) == ["table_fk1", "rational_fk1"]
    assert sets(found, target="1/2 LSB") == {}
    assert set(winners(found)["fk1", "1/2"].values()) == {"–"}
    assert "rational" not in " ".join(winners(found)["fk1", "1"].values())


def test_every_block_has_its_price(found):
    one = sets(found)["table_fk1"]
    assert [one[key] for key in ("lut", "dsp", "mem", "alut", "nodsp")] == [79, 2, 2, 70, 1070]
    price = comparison.RULES["price"]
    assert comparison.price(one) == 79 + 2 * price["dsp"] + 2 * price["mem"]
    assert comparison.price(one | {"mem": 3}) == comparison.price(one) + price["mem"]


def test_every_figure_has_its_own_winner(found):
    assert winners(found)["fk1", "1"] == {
        "LUT": "table", "LUT, blocks counted": "classic", "cycles": "table", "ns": "table"}
    assert winners(found, "Cyclone V")["fk1", "1"] == {"ALUT": "table", "ALUT, no DSP": "classic"}
    found["parts"]["c"] |= {"cycles": 3, "fmax_mhz": 200.0}
    now = winners(found)["fk1", "1"]
    assert (now["cycles"], now["ns"]) == ("table,classic", "classic")


def test_targets_with_the_same_winners_share_a_row(found):
    rows = [line[1] for line in comparison.winners_table(found, "Cyclone V").rows if line[0] == "fk2"]
    assert rows == ["0.1 mm, 2", "1", "1/2"], "no core reaches the first two here, nor the last"


def test_a_clock_that_is_not_known_is_no_figure(found):
    found["parts"]["t"]["fmax_mhz"] = None
    assert sets(found)["table_fk1"]["ns"] is None
    assert winners(found)["fk1", "1"]["ns"] == "classic"
    assert "| 79 | 2 | 2 | 3 | –\n" in comparison.target_table(found).markdown()


# What a spread changes


def test_what_a_spread_takes_and_what_an_angle_takes(found):
    table = comparison.itself_table(report(found))
    assert table.rows == (("fk1", "2", "4/2", "2/2", "129/79", "2/3", "2/3", "26/15"),
                          ("fk2", "1", "7/2", "2/2", "329/129", "6/5", "6/4", "30/18"),
                          ("ik1", "1", "2/3", "2/3", "189/139", "4/4", "4/4", "28/18"))


def test_without_a_common_target_the_first_sets_are_compared(made, found):
    one = next(row for row in made["cores"] if row["core"] == "rational_ik1")
    spread = one | {"core": "rational_ik2", "function": "ik2", "params": {"W": 16, "F": 8, "S": 24}}
    angle = one | {"core": "table_ik2", "family": "table", "function": "ik2", "params": {"W": 16, "F": 8, "A": 18}}
    assert comparison.itself_table(report(found, spread, angle)).rows[-1] == (
        "ik2", "first sets", "0/0", "1/1", "450/450", "9/9", "9/9", "26/18")
    both = [row | {"core": f"{row['family']}_ik1", "function": "ik1"} for row in (spread, angle)]
    assert comparison.itself_table(report(found, *both)).rows[-1][:2] == ("ik1", "1"), "a target comes first"
    for core in ("rational_fk1", "rational_fk2", "rational_ik1"):
        found["designs"][core]["picks"] = {}
    assert comparison.itself_table(report(found)).rows == ()


# Tasks with codecs


def test_codecs_add_to_area_and_time(found):
    table = comparison.scenario_table(found)
    assert table.rows == (("angle", "`vector_fk2-W16F8A18`", "`angle_to_vector`", "16", "277", "4", "2", "6", "150"),)
    assert "vector_fk2" not in comparison.target_table(found).markdown()
    found["designs"]["table_fk2"]["picks"]["0.1 mm"] = found["designs"]["table_fk2"]["picks"][TARGET]
    assert comparison.scenario_table(found).rows[1][:4] == ("angle", "`table_fk2-W16F8A18`", "–", "–")


# Pages and picture


def test_a_set_is_named_with_its_mode(found):
    one = found["designs"]["classic_fk1_iter"] | {"core": "classic_fk1", "architecture": "iter"}
    assert comparison.named(one, {"MODE": 0, "W": 16, "F": 9, "A": 16}) == "`classic_fk1-iter-W16F9A16`"
    assert comparison.named(one, {"W": 16, "word": 12}) == "`classic_fk1-W16`"


def test_tables_have_every_core_and_target(found):
    text = comparison.target_table(found).markdown()
    assert "\n2 | `rational_fk1-W16F8A26` | 1.5 |" in text and "\n1 | `rational_fk1" not in text
    assert "\n`rational_fk1` | 1.4" in comparison.missed_table(found).markdown()
    for target in comparison.TARGETS:
        found["designs"]["rational_fk1"]["picks"][target] = found["designs"]["rational_fk1"]["picks"]["2 LSB"]
    assert "rational_fk1" not in comparison.missed_table(found).markdown()
    assert len({line.count("|") for line in text.splitlines()}) == 1
    found["designs"]["table_fk1"]["picks"]["0.1 mm"] = found["designs"]["table_fk1"]["picks"]["2 LSB"]
    assert "\n0.1 mm, 2 | `table_fk1-W16F8A15` | 1.9 |" in comparison.target_table(found).markdown()
    once = [line[0] for line in comparison.cyclonev_table(found).rows]
    assert len(once) == len(set(once)) and "`rational_fk1-W16F8A26`" in once


def test_the_scara_of_1_m_has_a_table_of_its_own(made, found):
    fine = design("vector_fk1", "vector", "fk1", [("2 µm", 20, 0.05, ["v", 1])], word="vector") | {"metre": True}
    text = [comparison.target_table(found).markdown(), comparison.missed_table(found).markdown()]
    found["designs"]["vector_fk1 on 1 m"] = fine
    assert comparison.metre_table(found).rows == (
        ("2 µm", "`vector_fk1-W16F8A20`", "1.53", "139", "2", "0", "4", "50"),)
    assert text == [comparison.target_table(found).markdown(), comparison.missed_table(found).markdown()]
    assert "## A SCARA of 1 m" in documents.markdown(made | {"verdict": found})


def test_the_page_has_the_verdict(made, found):
    assert "verdict at equal accuracy" not in documents.markdown(made)
    assert "verdict.png" not in figures.plots(made)
    made["verdict"] = found
    assert "verdict.png" in figures.plots(made)
    text = documents.markdown(made)
    assert "## The verdict at equal accuracy" in text and "\nfk1 | 1 | table | classic" in text
    assert "a MULT18X18 as 867 LUTs and an EBR as 434" in " ".join(text.split())
    assert "\n1 | `table_fk1-W16F8A16` | 0.9 | 79 | 2 | 2 | 3 | 60\n" in text and "\nik1 | 1 | 2/3 |" in text
    assert "\n`table_fk1-W16F8A16` | 70 | 2 | 2 | 1070\n" in text
    for block in text.split("\n\n"):
        if "\n:--" in block:
            assert len({line.count("|") for line in block.splitlines()}) == 1
    assert tables.mixed(text, "report.md") == []
    assert "Not searched" not in text
    found["open"] = ["verdict: vector_fk9 is not in the report"]
    assert "**Not searched since: vector_fk9 is not in the report.**" in documents.markdown(made)


def test_the_verdict_is_printed(made, found, capsys):
    documents.show(made | {"verdict": found})
    printed = " ".join(capsys.readouterr().out.split())
    assert "The family with the least, on ECP5" in printed and "2/3" in printed


def test_the_picture_shows_who_is_dominated(found):
    table, cordic = sets(found)["table_fk1"], sets(found)["classic_fk1_iter"]
    assert not figures.dominated(table, [table, cordic]) and not figures.dominated(cordic, [table, cordic])
    better = table | {"lut": table["lut"] - 1}
    assert figures.dominated(table, [better, cordic]) and not figures.dominated(better, [table])
    assert not figures.dominated(table, [better | {"mem": 9}]), "a memory block more is a cost"


def test_a_changed_verdict_makes_the_plots_stale(made, found):
    made["verdict"] = found
    before, other = figures.stamp(made), copy.deepcopy(made)
    other["verdict"]["parts"]["c"]["fmax_mhz"] = 101.0
    assert figures.stamp(other) != before


# Chains of links


def chained(core, alut, latency, ii=None):
    return {"core": core, "set": "S", "params": {}, "latency_cycles": latency, "ii": ii or latency,
            "area": {"cyclonev": {"lut": alut, "dsp": 2, "mem": 0}}}


FIXED = [chained("table_fk1", 70, 3, 2), chained("table_fk2", 110, 5, 4), chained("table_fk3", 150, 7, 6)]
REPORT = {"cores": [*FIXED, chained("table_chain", 200, 3, 2), chained("vector_chain", 9, 4, 3)]}


def test_measured_to_three_joints_and_a_line_beyond():
    assert [comparison.line([70, 110, 150], n) for n in (1, 2, 3)] == [70, 110, 150]
    assert comparison.line([70, 110, 150], 10) == pytest.approx(430)
    assert comparison.line([60, 110, 130], 3) == 130


@pytest.mark.parametrize("alut, joints", [(70, 1), (71, 2), (200, 5), (230, 5), (231, 6), (431, 11)])
def test_where_a_chain_crosses(alut, joints):
    assert comparison.crossing(chained("c", alut, 3), FIXED) == joints


def test_a_chain_that_never_crosses():
    assert comparison.crossing(chained("c", 20, 3), [chained("f", 10, 1)] * 3) is None


def test_a_family_without_all_its_cores_is_left_out():
    assert comparison.chain_table(REPORT).rows == (
        ("`table_chain`", "3", "2", "200", "70", "110", "150", "5"),)
    assert comparison.chain_table({"cores": FIXED}).rows == ()


# Engines that iterate

FOUND = {"task": "2 joints", "closed": ["rational_ik1", "none"], "pass": 12, "starts": 400, "converged": 399,
         "iterations": [58, 80, 142], "cycles": [719, 983, 1727]}


@pytest.fixture
def iterated(made):
    """A report with an engine: one of its rows under that name."""
    rows = {"classic_ik1_iter": FOUND, "engine_absent": FOUND}
    return made | {"engines": {"rows": rows, "sources": {}, "figures": digest(rows)}}


def test_an_engine_and_what_answers_in_one_pass(iterated):
    table = comparison.engine_table(iterated)
    assert table.rows == (("2 joints", "`classic_ik1_iter`", "`rational_ik1` 9", "12", "58", "719", "983", "1727",
                           "99.8"),)
    assert len(table.head) == len(table.rows[0])


def test_engines_are_on_the_page_and_the_terminal(made, iterated, capsys):
    text = documents.markdown(iterated)
    assert text.count("## Engines that iterate") == 1 and documents.ENGINE_NOTE in text
    assert "\n2 joints | `classic" in text and "Engines" not in documents.markdown(made)
    documents.show(iterated)
    assert "Engines that iterate" in capsys.readouterr().out


# Claims of pages and pictures must be what the models give, and a missing block is an error


def test_claims_of_newton():
    assert newton.claims() in newton.PAGE.read_text(encoding="utf-8")


@pytest.mark.slow
def test_claims_of_the_gradient():
    assert gradient.claims() in gradient.PAGE.read_text(encoding="utf-8")


def test_table_1_leaves_the_ray_and_table_2_does_not():
    assert newton.orientation(newton.TABLES[1]) == pytest.approx(45.65)
    assert abs(newton.orientation(newton.TABLES[2])) < 1


def test_a_block_is_filled_and_a_missing_one_named(tmp_path):
    page = tmp_path / "page.md"
    page.write_text("a\n<!-- b -->\nold\n<!-- /b -->\nz\n")
    fill(page, "b", "new\n")
    assert page.read_text() == "a\n<!-- b -->\nnew\n<!-- /b -->\nz\n"
    with pytest.raises(ValueError, match="page.md: no block c"):
        fill(page, "c", "")


def test_the_picture_of_the_front_page_shows_the_cores():
    with Image.open(FOLDER / "front.png") as picture:
        assert picture.text["Shows"] == front.shows(), "make figures"


def test_the_words_of_the_front_page_reach_the_target():
    arm = arms.load(front.ARM)
    for core, words, theta in front.answers():
        assert words["out_status"] == 0
        tip = np.array(truth.fk2(*theta, *(link * arm.mm_per_unit for link in arm.links))).ravel()
        assert np.hypot(*(tip - front.TARGET)) < 4 * accuracy.mm_per_lsb(core, arm), core.id


@pytest.mark.skipif(not available("icarus"), reason="Icarus Verilog is not installed")
def test_the_contract_is_drawn_as_it_is_simulated():
    assert diagrams.CONTRACT.read_text() == diagrams.contract(), "make figures"
    assert f"latency: {cores.find(diagrams.CORE).latency} edges" in diagrams.CONTRACT.read_text()
    assert f"]({diagrams.CONTRACT.name})" in diagrams.CONTRACT.with_name("README.md").read_text()


@pytest.mark.parametrize("shown", diagrams.DIAGRAMS, ids=lambda shown: shown.page)
def test_the_boxes_of_a_diagram_are_modules_of_its_core(shown):
    folder = cores.RTL / shown.page
    assert (folder / "blocks.svg").read_text() == diagrams.diagram(shown), "make figures"
    assert "](blocks.svg)" in (folder / "README.md").read_text()
    listed = {core.name for core in cores.all_cores()}
    for core, _, boxes, _ in shown.rows:
        assert core in listed
        inside = {path.stem for path in cores.sources_of(core)}
        assert {module for module, _ in boxes if module} <= inside, core


@pytest.mark.parametrize("family", [one for one in cores.FAMILIES if one not in ("arith", "codec", "cordic")])
def test_a_family_shows_its_modules(family):
    """A part, a codec or a CORDIC is one module."""
    page = (cores.RTL / family / "README.md").read_text()
    folder = next(iter(re.findall(r"!\[[^]]*\]\((?:\.\./)?(\w*?)/?blocks\.svg\)", page)), None)
    assert folder is not None, "no diagram"
    shown = next(one for one in diagrams.DIAGRAMS if one.page == (folder or family))
    assert family == "program" or family in {cores.find(core).family for core, *_ in shown.rows}


def test_texts_of_a_diagram_fit():
    """Letters are at most 7.9 wide in a box and beside it: nothing is cut off."""
    for shown in diagrams.DIAGRAMS:
        for core, before, boxes, after in shown.rows:
            assert len(core) < 28 and max(len(before), len(after)) <= 13, core
            assert all(len(module) <= 27 and len(text) <= 32 for module, text in boxes), core
