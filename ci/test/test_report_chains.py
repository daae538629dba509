"""Chains beside fixed cores in the report: clocks, the line beyond three joints, where they cross."""

import pytest

from ci.report import paper


def row(core, alut, latency, ii=None):
    return {"core": core, "set": "S", "latency_cycles": latency, "ii": ii or latency,
            "area": {"cyclonev": {"lut": alut, "dsp": 2, "mem": 0}}}


FIXED = [row("table_fk1", 70, 3, 2), row("table_fk2", 110, 5, 4), row("table_fk3", 150, 7, 6)]
REPORT = {"cores": [*FIXED, row("table_chain", 200, 3, 2), row("vector_chain", 9, 4, 3)]}


def test_clocks_to_the_tip():
    assert paper.clocks(row("x", 1, 4, 3), 1) == 4 and paper.clocks(row("x", 1, 4, 3), 5) == 16


def test_measured_to_three_joints_and_a_line_beyond():
    assert [paper.line([70, 110, 150], n) for n in (1, 2, 3)] == [70, 110, 150]
    assert paper.line([70, 110, 150], 10) == pytest.approx(430)
    assert paper.line([60, 110, 130], 3) == 130


@pytest.mark.parametrize("alut, joints", [(70, 1), (71, 2), (200, 5), (230, 5), (231, 6), (431, 11)])
def test_where_a_chain_crosses(alut, joints):
    assert paper.crossing(row("c", alut, 3), FIXED) == joints


def test_a_chain_that_never_crosses():
    assert paper.crossing(row("c", 20, 3), [row("f", 10, 1)] * 3) is None


def test_a_family_without_all_its_cores_is_left_out():
    assert list(paper.chains(REPORT)) == ["table"]
    assert paper.chain_section({"cores": FIXED}) == []


def test_the_section_says_what_the_rows_say():
    title, note, table, said = paper.chain_section(REPORT)
    lines = table.splitlines()
    assert lines[0] == "| joints | `table_chain` | `table_fk*` |" and len(lines) == 2 + len(paper.JOINTS)
    assert lines[4] == "| 3 | 200; 7 | 150; 7 |" and lines[5] == "| 4 | 200; 9 | ≈ 190; 9 |"
    assert "from n = 5 on" in said and "beyond 10" in said and note == paper.CHAIN_NOTE and title.startswith("## ")
