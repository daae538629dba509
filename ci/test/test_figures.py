"""Claims of pages and pictures must be what the models give, and a missing block is an error."""

import numpy as np
import pytest
from quadrance import accuracy, arms, truth

from ci.figures import fill, front, gradient, newton


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
