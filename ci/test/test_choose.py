"""The areas that `quadrance choose` estimates, beside a fresh synthesis."""

import pytest
from quadrance.cli import catalogue, choose

from ci import synth


@pytest.mark.slow
@pytest.mark.parametrize(("name", "word"), [
    ("table_ik2", {"A": 13}), ("table_ik2", {"A": 22}), ("vector_fk2", {"U": 12}), ("vector_ik2", {"U": 12}),
    ("rational_fk1", {"S": 16}), ("classic_ik2-iter", {"A": 12}), ("classic_fk1-comb", {"A": 12})],
    ids=lambda one: one if isinstance(one, str) else "".join(f"{key}{value}" for key, value in one.items()))
def test_an_estimate_is_within_a_tenth_of_a_synthesis(name, word):
    core = catalogue.find(name, word)
    area, _, own = choose.estimated(core, "ecp5", *word)
    fresh = synth.core_area(core, ("ecp5",))["ecp5"]
    assert not own and abs(area["lut"] / fresh["lut"] - 1) < 0.1, (area, fresh)
    assert abs(choose.share(area, "ecp5") / choose.share(fresh, "ecp5") - 1) < 0.1
