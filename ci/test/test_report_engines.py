"""Engines in the report: their lines beside the closed form, what makes them stale, and what the models say."""

import pytest
from quadrance import cores
from quadrance.iterative import convergence

from ci.cache import digest
from ci.report import documents, engines

FOUND = {"task": "2 joints", "closed": ["rational_ik1", "none"], "pass": 12, "starts": 400, "converged": 399,
         "iterations": [58, 80, 142], "cycles": [719, 983, 1727]}


@pytest.fixture
def iterated(made):
    """A report with an engine: one of its rows under that name."""
    rows = {"classic_ik1_iter": FOUND, "engine_absent": FOUND}
    return made | {"engines": {"rows": rows, "sources": {}, "figures": digest(rows)}}


def test_an_engine_and_what_answers_in_one_pass(iterated):
    table = engines.table(iterated)
    assert [line[1] for line in table.rows] == ["`classic_ik1_iter`", "`rational_ik1`"]
    assert all(len(line) == len(table.head) for line in table.rows)
    assert table.rows[0][2:8] == ("420", "1", "0", "100", "12", "58")
    assert table.rows[0][8:] == ("719", "983", "1727", "14.4", "19.7", "34.5", "99.8")
    assert table.rows[1][6:] == ("–", "–", "9", "9", "9", "0.18", "0.18", "0.18", "100")


def test_the_section_is_on_the_page_and_the_terminal(made, iterated, capsys):
    assert engines.section(made) == []
    text = documents.markdown(iterated)
    assert text.count("## Engines that iterate") == 1 and engines.NOTE in text and "| 2 joints | `classic" in text
    assert "Engines" not in documents.markdown(made)
    documents.show(iterated)
    assert "Engines that iterate" in capsys.readouterr().out


def test_what_makes_them_stale(made, monkeypatch):
    monkeypatch.setattr(engines, "found", lambda core: dict(FOUND))
    listed = cores.all_cores()
    report = made | {"engines": engines.put_together(listed)}
    found = report["engines"]
    assert engines.check(report, listed) == [] == engines.check(made, listed) == engines.check(None, listed)
    assert "engines: engine_quaternion_gd changed" in engines.check(
        report, tuple(core for core in listed if core.family != "engine"))
    found["sources"]["models/quadrance/iterative/fixed.py"] = "other"
    assert engines.check(report, listed) == ["engines: models/quadrance/iterative/fixed.py changed"]
    found["sources"] = engines.sources(listed)
    found["rows"]["engine_quaternion_gd"]["cycles"] = [1, 2, 3]
    assert engines.check(report, listed) == ["engines: a figure was changed by hand"]


@pytest.mark.parametrize("core", engines.chosen(cores.all_cores()), ids=lambda core: core.id)
def test_what_is_measured(core):
    found = engines.found(core)
    median, late, most = found["cycles"]
    assert 0 < median <= late <= most and found["converged"] > 0.99 * found["starts"] > 1000
    assert median >= found["pass"] * found["iterations"][0] and found["iterations"][2] <= convergence.LIMIT
    assert {one.name for one in cores.all_cores()} >= set(found["closed"])
