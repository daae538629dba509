"""What pytest learns from the house: --core and --sim choose tests, --names shows them, a failed bench is recorded."""

from __future__ import annotations

import sys
import time

import pytest
from quadrance.cli.catalogue import Refused, choose, find
from quadrance.cores import Core

RECORDED = 3  # failed benches of a run that are recorded: each is simulated once or twice more
EVERY = 20.0  # seconds between two lines of progress where there is no terminal


def pytest_addoption(parser: pytest.Parser) -> None:
    house = parser.getgroup("quadrance")
    house.addoption("--core", help="only tests of this core: a name, or name-set")
    house.addoption("--sim", help="no test in another simulator: icarus or verilator (bulk runs are Verilator's)")
    house.addoption("--names", action="store_true", help="names of tests and their number in place of dots")


def pytest_configure(config: pytest.Config) -> None:
    try:
        if name := config.getoption("--core"):
            find(name)
        if name := config.getoption("--sim"):
            choose("simulator", name, ("icarus", "verilator"))
    except Refused as error:
        raise pytest.UsageError(str(error)) from None
    if config.getoption("--names") and not hasattr(config, "workerinput"):
        config.pluginmanager.register(Names(), "names")


def _core(item: pytest.Item) -> Core | None:
    core = getattr(item, "callspec", None) and item.callspec.params.get("core")
    return core if isinstance(core, Core) else None


def _simulator(item: pytest.Item) -> str | None:
    """The simulator of a bench, Verilator of a bulk run, None of what simulates no core."""
    named = getattr(item, "callspec", None) and item.callspec.params.get("simulator")
    return named or ("verilator" if _core(item) and item.nodeid.startswith("tb/") else None)


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Keep the tests that --core and --sim ask for."""
    name, simulator = config.getoption("--core"), config.getoption("--sim")

    def wanted(item: pytest.Item) -> bool:
        core = _core(item)
        return (not name or core is not None and name in (core.id, core.name)) and \
            (not simulator or _simulator(item) in (None, simulator))

    if name or simulator:
        config.hook.pytest_deselected(items=[item for item in items if not wanted(item)])
        items[:] = [item for item in items if wanted(item)]


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(item: pytest.Item, call: pytest.CallInfo):
    """Below a failed cocotb bench of a listed core: the waveform, the time, the command that repeats it."""
    report = (yield).get_result()
    core = _core(item)
    if not (report.when == "call" and report.failed and core and "simulator" in item.callspec.params
            and isinstance(call.excinfo.value, SystemExit)):
        return
    count = item.config.stash.get(_COUNT, 0)
    item.config.stash[_COUNT] = count + 1
    if count < RECORDED:
        from ci import waves

        try:
            lines = waves.explain(core, item.callspec.params["simulator"])
        except (RuntimeError, SystemExit) as error:
            lines = [f"no waveform: {error}"]
        report.sections.append(("how to look at it", "\n".join(lines)))


_COUNT = pytest.StashKey[int]()


class Names:
    """Progress of a long run: the number of tests that ended and the name of the last; failures at once."""

    def __init__(self) -> None:
        self.total = self.done = 0
        self.last = time.monotonic()
        self.live = sys.stderr.isatty()

    def pytest_collection_finish(self, session: pytest.Session) -> None:
        self.total = self.total or len(session.items)

    @pytest.hookimpl(optionalhook=True)
    def pytest_xdist_node_collection_finished(self, node, ids) -> None:
        self.total = len(ids)

    @pytest.hookimpl(tryfirst=True)
    def pytest_report_teststatus(self, report: pytest.TestReport):
        if report.passed:
            return ("passed" if report.when == "call" else ""), "", ""
        return None

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if report.failed:
            self._line(f"FAILED {report.nodeid}", end="\n")
        if report.when != "teardown":
            return
        self.done += 1
        if self.live or time.monotonic() - self.last > EVERY:
            self.last = time.monotonic()
            self._line(f"{self.done} of {self.total}  {report.nodeid}", end="" if self.live else "\n")

    def pytest_sessionfinish(self) -> None:
        if self.live:
            self._line("", end="")

    def _line(self, text: str, end: str) -> None:
        sys.stderr.write((f"\r\x1b[K{text[:118]}" if self.live else text) + end)
        sys.stderr.flush()
