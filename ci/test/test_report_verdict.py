"""The verdict at equal accuracy on small made-up figures: winners, tables, sentences, picture. No tool runs."""

import copy

import pytest

from ci.report import blocks, documents, figures, judgement, terminal, verdict

TARGET = "1 LSB"


@pytest.fixture(autouse=True)
def targets(monkeypatch):
    """Whatever targets the list has: these."""
    for module in (verdict, judgement):
        monkeypatch.setattr(module, "TARGETS", ("0.1 mm", "2 LSB", "1 LSB", "1/2 LSB"))


def part(lut, dsp=0, mem=0, nodsp=None, cycles=2, ii=None, mhz=100.0):
    """A part with plain figures; without DSP blocks 500 ALUTs more for each."""
    area = {"lut": lut, "ff": 10, "dsp": dsp, "mem": mem}
    return {"core": "x", "params": {}, "digest": "", "cycles": cycles, "ii": ii or cycles, "fmax_mhz": mhz,
            "area": {"cyclonev": area, "cyclonev_nodsp": area | {"dsp": 0, "lut": nodsp or lut + 500 * dsp}}}


def design(core, family, function, picks, word="angle", codec=None, best=0.3):
    """A design with a pick (target, bits of the word, total, [part, copies] ...) for each target it reaches."""
    made = {target: None for target in verdict.TARGETS} | {
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
    return {"designs": {one["core"]: one for one in designs}, "open": [], "figures": "", "parts": {
        "t": part(70, 2, 2, cycles=3, mhz=50.0), "c": part(300, cycles=15),
        "r": part(120, 2, 4), "t2": part(120, 2, 2, cycles=5, ii=4), "r2": part(320, 2, 7, cycles=6),
        "ti": part(130, 3, 3, cycles=4), "ri": part(180, 2, 2, cycles=4), "v": part(130, 2, cycles=4, mhz=80.0),
        "av": part(60, 1, 1, cycles=2, mhz=40.0)}}


def sets(found, function="fk1", target=TARGET):
    return {one["core"]: one for one in verdict.reaching(found, function, target)}


def report(found, *rows):
    return {"cores": list(rows), "verdict": found}


def test_an_infeasible_core_is_not_among_the_winners(found):
    assert list(sets(found)) == ["table_fk1", "classic_fk1_iter"]
    assert list(sets(found, target="2 LSB")) == ["table_fk1", "rational_fk1"]
    assert sets(found, target="1/2 LSB") == {}
    assert "Not reached by `rational_fk1` (1.4 LSB at best)." in judgement.who_wins(found, "fk1", TARGET)
    assert judgement.who_wins(found, "fk1", "1/2 LSB") == "fk1, 1/2 LSB: no core reaches it."


def test_every_block_has_its_price(found):
    one = sets(found)["table_fk1"]
    assert (one["alut"], one["dsp"], one["mem"], one["nodsp"], one["values"]["A"]) == (70, 2, 2, 1070, 16)
    assert verdict.price(one) == 70 + 2 * 560 + 2 * 120 and verdict.price(one | {"mem": 3}) == verdict.price(one) + 120


def test_every_figure_has_its_own_winner(found):
    sentence = judgement.who_wins(found, "fk1", TARGET)
    assert sentence == (
        "fk1, 1 LSB: fewest ALUTs beside DSP and memory blocks: `table_fk1` 70; least area with every block as ALUTs: "
        "`classic_fk1_iter` 300; fewest ALUTs without DSP blocks: `classic_fk1_iter` 300; fewest cycles: `table_fk1` "
        "3; shortest latency: `table_fk1` 60 ns. Not reached by `rational_fk1` (1.4 LSB at best).")
    found["parts"]["c"] |= {"cycles": 3, "fmax_mhz": 200.0}
    assert "fewest cycles: `table_fk1` and `classic_fk1_iter` 3; shortest latency: `classic_fk1_iter` 15 ns" in \
        judgement.who_wins(found, "fk1", TARGET), "the winner follows from the figures"


def test_a_clock_that_is_not_known_is_no_figure(found):
    found["parts"]["t"]["fmax_mhz"] = None
    assert sets(found)["table_fk1"]["ns"] is None
    assert "shortest latency: `classic_fk1_iter` 150 ns" in judgement.who_wins(found, "fk1", TARGET)
    assert "| 70 + 2 DSP + 2 mem | 3 | – |" in verdict.target_table(found, "fk1").markdown()


def test_the_readme_names_families(found):
    assert judgement.families(found, TARGET) == [
        "Fewest ALUTs beside DSP and memory blocks: `table_*` in fk1, fk2 and ik1.",
        "Least area with every block as ALUTs: `classic_*` in fk1; `table_*` in fk2; `rational_*` in ik1.",
        "Fewest ALUTs without DSP blocks: `classic_*` in fk1; `table_*` in fk2; `rational_*` in ik1.",
        "Fewest cycles: `table_*` in fk1, fk2 and ik1; `rational_*` in ik1.",
        "Shortest latency: `table_*` in fk1, fk2 and ik1; `rational_*` in ik1."]


# What a spread changes


def test_what_a_spread_saves_and_costs(found):
    assert judgement.itself_at(report(found)).endswith("fk1 at 2 LSB, fk2 at 1 LSB and ik1 at 1 LSB.")
    sentences = judgement.itself(report(found))
    assert ("It saves memory blocks in ik1 (2 against 3): a spread is a quotient of squared lengths, so no table of an "
            "arc is needed.") in sentences
    assert ("It costs memory blocks in fk1 (4 against 2) and fk2 (7 against 2): the square root of a spread needs four "
            "ranges of table where a sine needs one.") in sentences
    assert "It takes as many cycles in ik1." in sentences
    assert any(one.startswith("It costs cycles between samples in fk2 (6 against 4): spreads do not add")
               for one in sentences)


def test_a_sentence_turns_with_its_figures(found):
    found["parts"]["ri"]["area"]["cyclonev"]["mem"] = 5
    found["parts"]["r2"] |= {"ii": 3}
    sentences = judgement.itself(report(found))
    assert "It costs memory blocks in ik1 (5 against 3)." in sentences, "no reason that is none"
    assert "It saves cycles between samples in fk1 (2 against 3) and fk2 (3 against 4)." in sentences
    assert not any("saves memory" in one or "do not add" in one for one in sentences)
    found["parts"]["ri"]["area"]["cyclonev"]["mem"] = 3
    assert "It takes as many memory blocks in ik1." in judgement.itself(report(found))


def test_without_a_common_target_the_first_sets_are_compared(made, found):
    ours = theirs = next(one for one in made["cores"] if one["core"] == "rational_ik1")
    area = {"cyclonev": {"lut": 420, "ff": 1, "dsp": 3, "mem": 6}}
    spread = ours | {"core": "rational_ik2", "function": "ik2", "params": {"W": 16, "F": 8, "S": 24}, "total_lsb": 3.1,
                     "area": {"cyclonev": area["cyclonev"] | {"mem": 4}}}
    angle = theirs | {"core": "table_ik2", "family": "table", "function": "ik2", "total_lsb": 0.8, "area": area,
                      "params": {"W": 16, "F": 8, "A": 18}}
    rows = report(found, spread, angle)
    assert "ik2 at no common target (first sets: 3.1 and 0.8 LSB)" in judgement.itself_at(rows)
    sentences = judgement.itself(rows)
    assert ("It saves memory blocks in ik1 (2 against 3) and ik2 (4 against 6): a spread is a quotient of squared "
            "lengths, so no table of an arc is needed.") in sentences
    assert any(one.startswith("It costs bits of a joint word in ik1 (28 against 18) and ik2 (26 against 18): a spread")
               for one in sentences)
    spread["area"]["cyclonev"]["mem"] = 7
    assert "It costs memory blocks in ik2 (7 against 6)." in judgement.itself(rows)
    both = [one | {"core": f"{one['family']}_ik1", "function": "ik1"} for one in (spread, angle)]
    assert "ik1 at 1 LSB" in judgement.itself_at(report(found, spread, angle, *both)), "a target comes first"


def test_without_both_families_nothing_is_compared(found):
    for core in ("rational_fk1", "rational_fk2", "rational_ik1"):
        found["designs"][core]["picks"] = {}
    assert judgement.itself(report(found)) == []
    assert judgement.itself_at(report(found)).startswith("No function has both")


# Tasks with codecs


def test_codecs_add_to_area_and_time(found):
    table = verdict.scenario_table(found, "fk", "angle")
    assert table.rows == (("fk2", "2 `angle_to_vector` + `vector_fk2`", "W=16 F=8 A=18", "2", "250 + 4 DSP + 2 mem",
                           "6", "150", "2250 + 2 mem"),)
    assert "vector_fk2" not in verdict.target_table(found, "fk2").markdown().replace("`vector_fk2` | not built", "")


# Pages and picture


def test_tables_have_every_core_target_and_family(found):
    text = verdict.target_table(found, "fk1").markdown()
    assert "| 1 LSB | `rational_fk1` | not reached: 1.4 LSB at best | – |" in text
    assert "|  | `vector_fk1` | not built | – |" in text and "|  | `paper_fk1` | not built |" in text
    assert len({line.count("|") for line in text.splitlines()}) == 1


def test_the_pages_have_the_verdict(made, found):
    assert "verdict at equal accuracy" not in documents.markdown(made)
    assert blocks.made(made)["verdict"] == (
        "The verdict at equal accuracy was not searched yet: `make verdict`.")
    assert "verdict.png" not in figures.plots(made)
    made["verdict"] = found
    assert "verdict.png" in figures.plots(made) and "verdict.png" in blocks.made(made)["verdict"]
    text = documents.markdown(made)
    assert "## The verdict at equal accuracy" in text and "fk1, 1 LSB: fewest ALUTs" in text
    assert "a DSP block as 560 ALUTs and a memory block as 120" in " ".join(text.split())
    assert "No core reaches it with what is built." in text and "It saves memory blocks in ik1" in text
    for block in text.split("\n\n"):
        if block.startswith("|"):
            assert len({line.count("|") for line in block.splitlines()}) == 1
    assert "- Fewest cycles: `table_*` in fk1, fk2 and ik1" in blocks.made(made)["verdict"]


def test_the_verdict_is_printed(made, found, capsys):
    terminal.show(made | {"verdict": found})
    printed = " ".join(capsys.readouterr().out.split())
    assert "The verdict at equal accuracy" in printed and "fk1, 1/2 LSB: no core reaches it." in printed
    assert "It saves memory blocks in ik1 (2 against 3)" in printed


def test_the_picture_shows_who_is_dominated(found):
    table, cordic = sets(found)["table_fk1"], sets(found)["classic_fk1_iter"]
    assert not figures.dominated(table, [table, cordic]) and not figures.dominated(cordic, [table, cordic])
    better = table | {"alut": table["alut"] - 1}
    assert figures.dominated(table, [better, cordic]) and not figures.dominated(better, [table])
    assert not figures.dominated(table, [better | {"mem": 9}]), "a memory block more is a cost"


def test_a_changed_verdict_makes_the_plots_stale(made, found):
    made["verdict"] = found
    before, other = figures.stamp(made), copy.deepcopy(made)
    other["verdict"]["parts"]["c"]["fmax_mhz"] = 101.0
    assert figures.stamp(other) != before
