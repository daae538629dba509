"""Every status bit and every computed configuration word has an oracle; slips put into the models turn them red."""

from __future__ import annotations

import inspect

import numpy as np
import pytest
from quadrance import arm_keep, arm_velocity, keep, kernel_vector_solve, table
from quadrance.cores import all_cores
from quadrance.iterative import newton_fixed
from quadrance.program import meaning

from models.test import (
    oracles,
    test_oracles_config,
    test_oracles_engine,
    test_oracles_keep,
    test_oracles_program,
    test_oracles_status,
)

JUDGES = (test_oracles_config, test_oracles_engine, test_oracles_keep, test_oracles_program, test_oracles_status)
PLAIN = {"l1", "l2", "l3", "base", "shoulder", "lateral", "elbow", "d4", "d5", "sine", "radius", "tol", "limit"}
"""Words that are a number of the user's in the port's format: lengths, thresholds, a tolerance, a limit of steps."""
FUNCTIONS = list(dict.fromkeys(f"{core.family}.{core.function}" for core in all_cores()))


@pytest.mark.parametrize("function", FUNCTIONS)
def test_every_bit_and_every_computed_word_has_an_oracle(function):
    wanted = [key for key in oracles.keys(function)
              if key.startswith("status.") or key.removeprefix("cfg.") not in PLAIN or (function, key) in oracles.TABLE]
    missing = [key for key in wanted if (function, key) not in oracles.TABLE]
    assert not missing, f"{function}: no oracle for {', '.join(missing)}: write one from its page in test_oracles_*.py"


def test_an_entry_without_an_oracle_is_told(monkeypatch):
    table = {key: tests for key, tests in oracles.TABLE.items() if key != ("arm.keep2", "cfg.h1")}
    monkeypatch.setattr(oracles, "TABLE", table)
    with pytest.raises(AssertionError, match=r"arm\.keep2: no oracle for cfg\.h1"):
        test_every_bit_and_every_computed_word_has_an_oracle("arm.keep2")


def test_oracles_run():
    """What the table names is a test of the files that pytest collects."""
    tests = {name for names in oracles.TABLE.values() for name in names}
    assert tests <= {name for module in JUDGES for name in vars(module) if name.startswith("test_")}


def slip(monkeypatch, module, function: str, what: str, by: str) -> None:
    """A function of a model with one place of its text changed."""
    text = inspect.getsource(getattr(module, function))
    assert text.count(what) == 1, f"{function} has no longer one '{what}'"
    names: dict = {}
    exec(compile(text.replace(what, by), f"<{function} with a slip>", "exec"), vars(module), names)
    monkeypatch.setattr(module, function, names[function])


SLIPS = {  # the same slip in model and core would leave every bench green
    "reach before limits": (arm_keep, "_choose", "key = fit, not status & 1, score", "key = not status & 1, fit, score",
                            test_oracles_status.test_the_best_branch, "arm.keep3"),
    "reach before limits of eight": (keep, "choose", "cost, far[k], ~fit", "cost, ~fit, far[k]",
                                     test_oracles_keep.test_the_best_of_eight, "keep.six_keep"),
    "remembered beyond the limits": (keep, "choose", "if fit[best]:", "if True:",
                                     test_oracles_keep.test_the_best_of_eight, "keep.six_keep"),
    "the last of equals": (arm_keep, "_choose", "key > best[0]", "key >= best[0]",
                           test_oracles_status.test_the_best_branch, "arm.keep2"),
    "a tie downward at the edge": (meaning, "results", "round_shift(words[port.name], shift(",
                                   "round_shift(words[port.name] - 1, shift(",
                                   test_oracles_engine.test_the_edge_of_a_tip_of_six_axes, "six.fk6"),
    "a wrist that wraps": (table, "ik3r", "x, y, over = wrist(p, x, y, phi, l3)",
                           "x, y, over = wrist(p, x, y, phi, l3); y = np.where(over, -y, y)",
                           test_oracles_status.test_a_wrist_beyond_the_word_is_saturated, "table.ik3r"),
    "Newton's 1/8": (newton_fixed, "solve", "singular = (n2 >= -GUARD) & (n2 < GUARD)",
                     "singular = (n2 >= -2 * GUARD) & (n2 < 2 * GUARD)",
                     test_oracles_engine.test_newton_is_singular_where_it_does_not_converge_near_a_straight_arm,
                     "engine.newton_3r"),
    "cfg_mu without its square": (newton_fixed, "config", "word * 2 + (word * word >> 17)", "word * 2",
                                  test_oracles_config.test_words_of_newton, "engine.newton_3r"),
    "cfg_r rounded up": (kernel_vector_solve, "config", "((1 << 56 - 2 * e) - 1) // max(double + half, 1)",
                         "((1 << 56 - 2 * e) - 1) // max(double + half, 1) + 1",
                         test_oracles_status.test_reach_of_two_links, "vector.ik2"),
    "a unit that is beyond is near": (arm_velocity, "_rates", "near = size < cfg_sine", "near = size <= cfg_sine",
                                      test_oracles_status.test_rates_of_an_arm_with_a_square_elbow, "arm.rates2"),
}


@pytest.mark.parametrize("name", SLIPS)
def test_a_slip_in_a_model_is_found(name, monkeypatch):
    module, function, what, by, judge, entry = SLIPS[name]
    slip(monkeypatch, module, function, what, by)
    if function == "config" and judge is test_oracles_status.test_reach_of_two_links:
        monkeypatch.setitem(test_oracles_status.DERIVE, "vector", module.config)
    with pytest.raises(AssertionError):
        judge(oracles.sets_of(entry)[0])


def test_oracles_ask_in_order():
    """Held words need the samples in their order: `ask` gives them at once."""
    core = oracles.sets_of("vector.ik1")[0]
    found = oracles.ask(core, [{"x": 5, "y": 0}, {"x": 0, "y": 0}])
    assert [row["status"] for row in found] == [0, 2] and found[0]["c1"] == found[1]["c1"]
    assert isinstance(found[0]["c1"], int) and not isinstance(found[0]["c1"], np.integer)
