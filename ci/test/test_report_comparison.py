"""Cores beside each other on small made-up figures: the verdict, chains, engines, their tables. No tool runs."""

import copy

import pytest

from ci.cache import digest
from ci.report import comparison, documents, figures, tables

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
    assert "| 79 | 2 | 2 | 3 | – |" in comparison.target_table(found).markdown()


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
    assert "| 2 | `rational_fk1-W16F8A26` | 1.5 |" in text and "| 1 | `rational_fk1" not in text
    assert "| `rational_fk1` | 1.4 |" in comparison.missed_table(found).markdown()
    for target in comparison.TARGETS:
        found["designs"]["rational_fk1"]["picks"][target] = found["designs"]["rational_fk1"]["picks"]["2 LSB"]
    assert "rational_fk1" not in comparison.missed_table(found).markdown()
    assert len({line.count("|") for line in text.splitlines()}) == 1
    found["designs"]["table_fk1"]["picks"]["0.1 mm"] = found["designs"]["table_fk1"]["picks"]["2 LSB"]
    assert "| 0.1 mm, 2 | `table_fk1-W16F8A15` | 1.9 |" in comparison.target_table(found).markdown()
    once = [line[0] for line in comparison.cyclonev_table(found).rows]
    assert len(once) == len(set(once)) and "`rational_fk1-W16F8A26`" in once


def test_the_page_has_the_verdict(made, found):
    assert "verdict at equal accuracy" not in documents.markdown(made)
    assert "verdict.png" not in figures.plots(made)
    made["verdict"] = found
    assert "verdict.png" in figures.plots(made)
    text = documents.markdown(made)
    assert "## The verdict at equal accuracy" in text and "| fk1 | 1 | table | classic |" in text
    assert "a MULT18X18 as 867 LUTs and an EBR as 434" in " ".join(text.split())
    assert "| 1 | `table_fk1-W16F8A16` | 0.9 | 79 | 2 | 2 | 3 | 60 |" in text and "| ik1 | 1 | 2/3 |" in text
    assert "| `table_fk1-W16F8A16` | 70 | 2 | 2 | 1070 |" in text
    for block in text.split("\n\n"):
        if block.startswith("|"):
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
    assert "| 2 joints | `classic" in text and "Engines" not in documents.markdown(made)
    documents.show(iterated)
    assert "Engines that iterate" in capsys.readouterr().out
