"""The bounds themselves: they hold along a day of real arms, and give the figures that the pages of the cores print."""

import re
from importlib import import_module
from importlib.util import find_spec

import numpy as np
import pytest
from quadrance import accuracy, arms, bounds, classic, cordic, cores

W16 = {"W": 16, "F": 8, "A": 16}
CORES = {(one.model_name, one.set_id): one for one in cores.all_cores()
         if one.function in accuracy.JOINTS and (one.params["W"], one.params["F"]) == (16, 8)}


@pytest.mark.parametrize("one", CORES.values(), ids=lambda one: one.id)
def test_the_tip_stays_within_its_bound_on_every_arm(one):
    share = 0.0
    for arm in map(arms.load, arms.known()):
        lengths = [round(256 * length) for length in arm.links]
        if sum(lengths) > 1 << 14:
            continue
        case = accuracy.trajectory_case(one, arm, 600)
        found = accuracy.errors(one, arm, case, one.model(one.params, **case.inputs, **case.cfg))
        bound = bounds.tip(one, *lengths)
        assert found.arithmetic.max() <= bound + 1e-6, arm.id
        share = max(share, found.arithmetic.max() / max(bound, 1e-6))
    assert share > 0.01 or one.function == "ik1", "a bound that nothing comes near"


@pytest.mark.parametrize("s, r, forward, inverse", [
    (8, 4, (120, 884, 1825), (252, 1301, 2649)), (24, 3, (11, 17, 25), (4.9, 12, 21.5))])
def test_figures_that_the_paper_s_page_prints(s, r, forward, inverse):
    p = W16 | {"S": s, "R": r}
    links = [(256 * l1, 256 * l2) for l1, l2 in ((3, 2), (32.5, 27.5), (63.9, 63.9))]
    assert [bounds.paper.forward(p, 2, *pair) for pair in links] == pytest.approx(forward, abs=0.5)
    assert [bounds.paper.inverse(p, 2, *pair) for pair in links] == pytest.approx(inverse, abs=0.5)


def test_figures_that_the_other_pages_print():
    """To the digit printed, rounded or rounded up."""
    aim = [part for magnitude, guard in ((True, cordic.AIM_GUARD), (False, classic.AIM_GUARD))
           for part in bounds.cordic.angle(W16, guard, magnitude)]
    turn = 2 * np.pi / 65536
    half, full = 1 << 13, 65532
    for bound, printed, digit in (
            (bounds.cordic.rotate(W16), 1.47, 0.01), (aim[0], 0.84, 0.01), (aim[1] * turn, 0.24, 0.01),
            (aim[2], 0.88, 0.01), (aim[3] * turn, 0.39, 0.01),
            (bounds.codec.spread_chord(16), 0.83, 0.01), (bounds.rational.turn(16) * 2**16, 1.06, 0.01),
            (bounds.rational.fk1(1 << 14), 0.83, 0.01), (bounds.rational.gap(W16 | {"S": 24}, half, half), 16, 1),
            (bounds.classic.chain(W16, 2, 0, 2 * half), 2, 0.1), (bounds.classic.chain(W16, 3, 0, 2 * half), 2.9, 0.1),
            (bounds.classic.chain(W16, 2, full, full), 3.5, 0.1), (bounds.classic.chain(W16, 3, full, full), 5.4, 0.1)):
        assert printed - digit <= bound <= printed + digit / 2, (bound, printed)


def test_every_bound_that_a_page_or_a_header_names_is_there():
    paths = [*cores.RTL.rglob("*.md"), *cores.RTL.rglob("*.v")]
    named = {(path.name, name) for path in paths for name in re.findall(r"\bbounds\.(\w+(?:\.\w+)*)", path.read_text())}

    def there(name: str) -> bool:
        module, _, function = name.rpartition(".")
        return bool(find_spec(f"quadrance.bounds.{name}" if not module else f"quadrance.bounds.{module}")) and \
            (not module or hasattr(import_module(f"quadrance.bounds.{module}"), function))

    assert len(named) > 30 and not [one for one in sorted(named) if not there(one[1])]
