"""The three tests of every core: cocotb bench, bulk run, long bulk run. tb/stimulus has the corners of each family."""

import contextlib
import functools
from collections.abc import Iterator

import pytest
from quadrance.cores import Core, all_cores

from tb.lib import legal
from tb.lib.simulate import simulate
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
    the first sets of a further PIPE, the long run the rest.
    """
    first = simulator == USABLE[0]
    if not core.first_set or not first and not (core.name in _both() and legal.daily(core)):
        return [pytest.mark.slow]
    return [pytest.mark.full, *[pytest.mark.smoke if legal.daily(core) else pytest.mark.further] * first]


@pytest.mark.parametrize(("simulator", "core"), [
    pytest.param(simulator, core, id=f"{simulator}-{core.id}", marks=_marks(core, simulator))
    for simulator in USABLE for core in CORES])
def test_bench(core: Core, simulator: str) -> None:
    again = core.clocked and core.first_set and simulator != USABLE[0]
    simulate(core, simulator, tests=AGAIN if again else None, seed=SEED)


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
