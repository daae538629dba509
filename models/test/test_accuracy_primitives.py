"""Errors of the primitives: in LSB of their output, and the real-valued truths on the right ports and scales."""

import numpy as np
import pytest
from quadrance import accuracy, arms, bounds, cores
from quadrance.accuracy.primitives import PRIMITIVES

ARM = arms.load("cobra600")


@pytest.mark.parametrize("function, params, answer, worst", [
    ("isqrt", {"W": 16, "F": 0}, lambda i: {"out_root": np.floor(np.sqrt(i["in_d"]))}, 1),
    ("divide", {"WN": 16, "WD": 16, "F": 4}, lambda i: {"out_q": (i["in_n"] << 4) // np.maximum(i["in_d"], 1)}, 1),
])
def test_primitives_in_lsb_of_their_output(function, params, answer, worst):
    ports = {"isqrt": {"d": "uW"}, "divide": {"n": "uWN", "d": "uWD"}}[function]
    out = {"isqrt": {"root": "u20"}, "divide": {"q": "u20"}}[function]
    one = cores.expand("arith", function, {"model": "fixed.isqrt", "in": ports, "out": out}, function,
                       {"architecture": "comb", "latency": 0, "sets": {"t": params}})[0]
    case = accuracy.sweep_case(one, ARM)
    out = {name: value.astype(np.int64) for name, value in answer(case.inputs).items()}
    found = accuracy.errors(one, ARM, case, out)
    assert 0.9 < found.arithmetic.max() < worst and found.quantisation is None and found.total is None
    off = {name: value + 2 for name, value in out.items()}
    assert accuracy.errors(one, ARM, case, off).arithmetic.max() == pytest.approx(2, abs=0.001)
    assert accuracy.trajectory_case(one, ARM) is None
    assert accuracy.workspace_case(one, ARM, 10, np.random.default_rng(1)) is None


@pytest.mark.parametrize("one", [one for one in cores.all_cores() if one.function in PRIMITIVES],
                         ids=lambda one: one.id)
def test_bit_true_models_of_the_primitives_are_near_their_functions(one):
    """And an answer one LSB off is farther away: the real-valued truths stand on the right ports and scales."""
    case = accuracy.sweep_case(one, ARM)
    answer = one.model(one.params, **case.inputs)
    exact = PRIMITIVES[one.function][1](one, case.inputs)
    most = 1.5  # LSB; a spread of 24 bits is much finer than an angle of 18
    if one.function == "angle_to_spread":
        most = bounds.codec.angle_to_spread(one.params, np.pi / 4)
    assert 0 <= accuracy.errors(one, ARM, case, answer).arithmetic.max() <= most
    shifted = {name: words + 2 * (name in exact) for name, words in answer.items()}
    assert accuracy.errors(one, ARM, case, shifted).arithmetic.max() >= 1.5
