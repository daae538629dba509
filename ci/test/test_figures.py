"""Claims of pages and pictures must be what the models give, and a missing block is an error."""

import numpy as np
import pytest
from quadrance import accuracy, arms, cores, truth

from ci.figures import diagrams, fill, front, gradient, newton
from tb.lib.simulate import available


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
    for core, _, boxes, _ in shown.rows:
        inside = {path.stem for path in cores.sources_of(core)}
        assert {module for module, _ in boxes if module} <= inside, core
