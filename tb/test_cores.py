"""The tests of every core: bench, bulk run, long bulk run; at random parameters, in pairs, on a day of real arms.

tb/stimulus has the corners of each family.
"""

from __future__ import annotations

import contextlib
import functools
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from quadrance import accuracy, arms, bounds
from quadrance.cores import Core, all_cores, at, find

from tb.lib import bulk, chain, legal
from tb.lib.simulate import UNKNOWN, kept, simulate
from tb.lib.suite import LONG_SAMPLES, SEED, bulk_run, bulk_samples, simulators

# The tests of tb/lib/bench.py that a core runs in the second simulator, Verilator, too: what its bulk runs have less of
AGAIN = r"\.(idle_and_back_pressure|stalled_output_loses_nothing)$"
CORES, USABLE = all_cores(), simulators()


@contextlib.contextmanager
def repeated(command: str) -> Iterator[None]:
    """A failure inside names the command that repeats it."""
    try:
        yield
    except AssertionError as error:
        raise AssertionError(f"{error}\nrepeat it with: {command}") from None


@functools.cache
def _both() -> set[str]:
    """The first clocked core of each family, of fixed latency and of varying one."""
    clocked = [core for core in reversed(CORES) if core.clocked]
    return set({(core.family, core.latency is None): core.name for core in clocked}.values())


def _marks(core: Core, simulator: str) -> list[pytest.MarkDecorator]:
    """The first set of every MODE in the first simulator, and of a core of each family in the second; `make cover` has
    the first sets of a further PIPE and those without a clock, the long run the rest.
    """
    first = simulator == USABLE[0]
    if not core.first_set or not first and not (core.name in _both() and legal.daily(core)):
        return [pytest.mark.slow]
    daily = legal.daily(core) and (core.clocked or not kept(core))
    return [pytest.mark.full, *[pytest.mark.smoke if daily else pytest.mark.further] * first]


@pytest.mark.parametrize(("simulator", "core"), [
    pytest.param(simulator, core, id=f"{simulator}-{core.id}", marks=_marks(core, simulator))
    for simulator in USABLE for core in CORES])
def test_bench(core: Core, simulator: str, request: pytest.FixtureRequest) -> None:
    simulate(core, simulator, tests=chosen_tests(core, simulator, request.config.getoption("--core")), seed=SEED)


def chosen_tests(core: Core, simulator: str, asked_for: str | None) -> str | None:
    """Which tests of the bench are run: all of a further set, and of a core that --core asks for."""
    if not core.clocked or not core.first_set:
        return None
    if simulator != USABLE[0]:
        return AGAIN
    return UNKNOWN if legal.daily(core) and kept(core) and not asked_for else None


def test_a_core_of_long_samples_has_its_whole_bench_where_it_is_asked_for():
    long, short, comb = map(find, ("arm_keep3", "vector_ik2", "isqrt_comb"))
    assert chosen_tests(long, USABLE[0], None) == UNKNOWN
    assert chosen_tests(long, USABLE[0], "arm_keep3") is chosen_tests(short, USABLE[0], None) is None
    assert chosen_tests(comb, USABLE[0], None) is chosen_tests(find("vector_ik1-W12U10"), USABLE[0], None) is None
    assert chosen_tests(short, "verilator", None) == ("verilator" in USABLE[1:] and AGAIN or None)


@pytest.mark.full
@pytest.mark.parametrize("core", [
    pytest.param(core, id=core.id, marks=pytest.mark.smoke if legal.daily(core) else pytest.mark.further)
    for core in CORES])
def test_bulk(core: Core) -> None:
    with repeated(f"make test CORE={core.id} SEED={SEED}"):
        assert bulk_run(core, bulk_samples(core), SEED) > 0


@pytest.mark.slow
@pytest.mark.parametrize("core", CORES, ids=[core.id for core in CORES])
def test_exhaustive(core: Core) -> None:
    with repeated(f"make exhaustive CORE={core.id} SEED={SEED}"):
        assert bulk_run(core, LONG_SAMPLES, SEED + 1) > 0


# The long run: two random legal parameter sets, another two with every seed

WITH_PARAMETERS = [core for core in all_cores() if core.first_set and core.params]


@pytest.mark.slow
@pytest.mark.parametrize("core", WITH_PARAMETERS, ids=lambda core: core.name)
def test_random_sets(core):
    chosen = legal.legal(core, 2, SEED)
    assert len(chosen) == 2
    for params in chosen:
        print(core.name, params)
        one = at(core, params)
        simulate(one, "verilator", seed=SEED)
        assert bulk_run(one, 100_000, SEED) > 0


@pytest.mark.full
def test_a_draw_is_legal_and_another_one_is_not():
    core = find("rational_ik1")
    assert legal.ranges(core) == {"W": (4, 24), "F": (0, 23), "S": (2, 40), "PIPE": (0, 0), "MULTIPLY": (18, 27)}
    first, = legal.legal(core, 1, 7)
    assert not legal.verdict(core, first) and legal.legal(core, 1, 7) == [first] != legal.legal(core, 1, 8)
    assert at(core, first).params == first and at(core, first).latency == (10 if first["W"] > 16 else 5)
    for params in core.illegal:
        assert legal.verdict(core, core.params | params) == "illegal"


# A core behind a core on one reset: the bench of every core, on the pair

PAIRS = chain.pairs()


@pytest.mark.full
@pytest.mark.parametrize("first, second, tests", [
    ("classic_ik2", "classic_fk2", "one_clock|stalled"), ("rational_fk1", "rational_ik1", None),
    ("rational_fk2", "rational_ik2", "one_clock")])
def test_pair(first, second, tests):
    simulate(chain.chain(find(first), find(second)), simulators()[0], tests=tests, seed=SEED)


@pytest.mark.slow
@pytest.mark.parametrize("first, second", PAIRS, ids=lambda core: core.id)
def test_every_pair(first, second):
    both = chain.chain(first, second)
    simulate(both, "verilator", seed=SEED)
    assert bulk_run(both, 100_000, SEED) > 0


@pytest.mark.full
def test_a_pair_that_a_reset_does_not_reach_is_seen():
    """The reset of the second core alone is tied off: what is in flight there survives."""
    both = chain.chain(find("rational_fk1"), find("rational_ik1"))
    wrapper = both.sources[0]
    text = wrapper.read_text()
    at = text.index(" two (")
    broken = wrapper.with_name("broken.v")
    broken.write_text(text[:at] + text[at:].replace(".rst(rst)", ".rst(1'b0)"))
    with pytest.raises(SystemExit, match="FAILED"):
        simulate(replace(both, sources=(broken, *both.sources[1:])), simulators()[0], tests="one_clock|reset_in",
                 seed=SEED, label="-unreset")


# A day of four real arms through the Verilog: bit-true, and its tip in millimetres beside float64

SAMPLES = 2000
ARMS = ("cobra600", "linuxcnc_scara", "staubli_tx40", "geomagic_touch")


def kinematic() -> list[Core]:
    """The first parameter set of every kinematic core, all of Q7.8; a further PIPE has the same bits."""
    return [core for core in all_cores() if core.function in accuracy.JOINTS and legal.daily(core)]


@pytest.mark.full
@pytest.mark.parametrize("core", kinematic(), ids=lambda core: core.name)
def test_a_day_of_the_arm(core: Core, record_property) -> None:
    for name in ARMS:
        arm = arms.load(name)
        case = accuracy.trajectory_case(core, arm, SAMPLES)
        result = bulk.stream(core, case.inputs, case.cfg)
        bulk.compare(core, case.inputs, case.cfg, result)
        assert result.outputs.keys() == {port.name for port in core.outputs}
        errors = accuracy.errors(core, arm, case, result.outputs)
        assert errors.arithmetic.size == SAMPLES
        worst = float(np.max(errors.arithmetic))
        millimetres = worst * accuracy.mm_per_lsb(core, arm)
        record_property(f"{name}_mm", millimetres)
        if core.family != "paper":  # its bound depends on the links, and eight bits see a pole near the yaw axis
            assert not np.any(result.outputs["out_status"]), f"{name} raised a status bit"
            limit = bounds.tip(core, *(round(length * 2 ** core.params["F"]) for length in arm.links))
            assert worst <= limit, f"{name}: {worst:.2f} LSB at the tip, {millimetres:.3f} mm"
