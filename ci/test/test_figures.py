"""Claims of pages and pictures must be what the models give, and a missing block is an error."""

import re

import numpy as np
import pytest
from PIL import Image
from quadrance import accuracy, arms, cores, truth

from ci.figures import FOLDER, diagrams, fill, front, gradient, newton
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
