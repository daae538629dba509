"""Pytest here: which tests to run, progress by name, a reason for every failure, an error for a run that was cut."""

from __future__ import annotations

import sys
import time
from pathlib import Path
from xml.etree import ElementTree

import hypothesis
import pytest
from quadrance.cli.catalogue import Refused, choose, find
from quadrance.cores import Core

from tb.lib import blame

pytest_plugins = ["pytester"]  # for the tests of this file
hypothesis.settings.register_profile("loaded", suppress_health_check=[hypothesis.HealthCheck.too_slow])
hypothesis.settings.load_profile("loaded")  # on a machine that has other work, slow is not wrong
RECORDED = 3  # failed benches of a run that are recorded: each is simulated once or twice more
EVERY = 20.0  # seconds between two lines of progress where there is no terminal


def pytest_addoption(parser: pytest.Parser) -> None:
    options = parser.getgroup("quadrance")
    options.addoption("--core", help="only tests of this core: a name, or name-set")
    options.addoption("--sim", help="no test in another simulator: icarus or verilator (bulk runs are Verilator's)")
    options.addoption("--names", action="store_true", help="names of tests and their number in place of dots")
    options.addoption("--shard", metavar="K/N", help="every N-th test from the K-th on: one of N machines")


def pytest_configure(config: pytest.Config) -> None:
    try:
        if name := config.getoption("--core"):
            find(name)
        if name := config.getoption("--sim"):
            choose("simulator", name, ("icarus", "verilator"))
        _shard(config)
    except ValueError as error:  # Refused, and a list that cannot be read
        raise pytest.UsageError(str(error)) from None
    if config.getoption("--names") and not hasattr(config, "workerinput"):
        config.pluginmanager.register(Names(), "names")


def _shard(config: pytest.Config) -> slice:
    """The tests of --shard, all without it."""
    text = config.getoption("--shard") or "1/1"
    numbers = [int(part) if part.isdecimal() else 0 for part in text.split("/")]
    if len(numbers) != 2 or not 1 <= numbers[0] <= numbers[1]:
        raise Refused(f"--shard {text}: it is K/N, such as 2/6, K from 1 to N")
    return slice(numbers[0] - 1, None, numbers[1])


def _core(item: pytest.Item) -> Core | None:
    core = getattr(item, "callspec", None) and item.callspec.params.get("core")
    return core if isinstance(core, Core) else None


def _simulator(item: pytest.Item) -> str | None:
    """The simulator of a bench, Verilator of a bulk run, None of what simulates no core."""
    named = getattr(item, "callspec", None) and item.callspec.params.get("simulator")
    return named or ("verilator" if _core(item) and item.nodeid.startswith("tb/") else None)


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Keep the tests that --core, --sim and --shard ask for; without --core, no bulk run of which `make cover` keeps
    the verdict.
    """
    name, simulator = config.getoption("--core"), config.getoption("--sim")

    def wanted(item: pytest.Item) -> bool:
        core = _core(item)
        return (core is not None and name in (core.id, core.name) if name else "further" not in item.keywords) and \
            (not simulator or _simulator(item) in (None, simulator))

    kept = [item for item in items if wanted(item)][_shard(config)]
    if len(kept) < len(items):
        chosen = set(map(id, kept))
        config.hook.pytest_deselected(items=[item for item in items if id(item) not in chosen])
        items[:] = kept


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(item: pytest.Item, call: pytest.CallInfo):
    """Below a failed test, in the JUnit file too: where arrays differ; of a cocotb bench the waveform and a command."""
    report = (yield).get_result()
    if not (report.when == "call" and report.failed):
        return
    core = _core(item)
    if core and "simulator" in item.callspec.params and isinstance(call.excinfo.value, SystemExit):
        title, lines = "how to look at it", _recorded(item, core)
    elif isinstance(call.excinfo.value, AssertionError):
        title, lines = "where it differs", blame.failed(call.excinfo.tb)
    else:
        return
    if lines and hasattr(report.longrepr, "addsection"):
        report.longrepr.addsection(title, "\n".join(lines))


def _recorded(item: pytest.Item, core: Core) -> list[str]:
    """The waveform of a failed bench, the time, the command; beyond the first few of a run the command alone."""
    from ci import waves

    simulator = item.callspec.params["simulator"]
    count = item.config.stash[_COUNT] = item.config.stash.get(_COUNT, 0) + 1
    if count > RECORDED:
        return [f"again:    {waves.command(core, simulator, waves.tests_of(core))}"]
    try:
        return waves.explain(core, simulator)
    except (RuntimeError, SystemExit) as error:
        return [f"no waveform: {error}"]


def _junit(config: pytest.Config) -> Path | None:
    """The JUnit file of this run, None in a worker process or where none was asked for."""
    path = config.getoption("xmlpath", None)
    return Path(path) if path and not hasattr(config, "workerinput") else None


def _incomplete(path: Path, reason: str) -> None:
    """Put an error into the JUnit file, so that a run that was cut does not read green."""
    if path.exists():
        tree = ElementTree.parse(path)
        suite = next(tree.iter("testsuite"))
    else:
        path.parent.mkdir(parents=True, exist_ok=True)
        suite = ElementTree.Element("testsuite", name="pytest", errors="0", failures="0", skipped="0", tests="0")
        tree = ElementTree.ElementTree(suite)
    for key in ("errors", "tests"):
        suite.set(key, str(int(suite.get(key)) + 1))
    case = ElementTree.SubElement(suite, "testcase", classname="pytest", name="the whole run", time="0")
    ElementTree.SubElement(case, "error", message=reason).text = reason
    tree.write(path, encoding="utf-8", xml_declaration=True)


def pytest_sessionstart(session: pytest.Session) -> None:
    """The JUnit file of an earlier run goes; one of a run that is killed says so."""
    if path := _junit(session.config):
        path.unlink(missing_ok=True)
        _incomplete(path, "the run did not end: it was killed, or it is still at work")


@pytest.hookimpl(hookwrapper=True, tryfirst=True)
def pytest_sessionfinish(session: pytest.Session, exitstatus: int):
    """Pytest writes its JUnit file within; of a run that was cut it would hold what passed before."""
    yield
    if (path := _junit(session.config)) and exitstatus not in (pytest.ExitCode.OK, pytest.ExitCode.TESTS_FAILED):
        name = pytest.ExitCode(exitstatus).name.lower().replace("_", " ")
        _incomplete(path, f"the run was not complete: {name}")


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
