"""The workers return all answers and all failures, and none is left when the parent ends."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from ci import cache, pool
from tb.lib import tools


def half(number):
    if number == 0:
        tools.require("no-such-tool")
    if number == 4:
        raise tools.ToolError("yosys", 2, "ERROR: Assert")
    if number % 2:
        raise ValueError(f"{number} is odd")
    return number // 2


def nap(folder, number):
    """What a tool does: a child of a worker that runs for long."""
    child = subprocess.Popen(["sleep", "60"])
    Path(folder, f"{child.pid}.pid").touch()
    child.wait()


def dies_once(folder, number):
    done = Path(folder, str(number))
    if number == 1 and not done.exists():
        done.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return number, cache.SINCE


@pytest.fixture
def log(tmp_path, monkeypatch):
    monkeypatch.setattr(pool, "LOGS", tmp_path)


def test_every_failure_is_named_and_the_others_are_done(log):
    with pytest.raises(RuntimeError) as told:
        pool.run(half, [(2,), (3,), (0,), (5,), (4,)])
    first, *lines = str(told.value).replace(":\n", ": ").splitlines()
    assert first == "4 jobs failed"
    assert [line.split(" (log")[0] for line in sorted(lines)] == [
        "0: no-such-tool is missing: run `make setup`", "3: 3 is odd",
        "4: yosys failed (2): ERROR: Assert", "5: 5 is odd"]


def test_every_job_is_answered_that_of_a_worker_that_dies_by_another(log, tmp_path):
    jobs = [(str(tmp_path), i) for i in range(4)]
    assert pool.run(dies_once, jobs, since=5.0) == {job: (job[1], 5.0) for job in jobs}


@pytest.mark.parametrize("how", [signal.SIGTERM, signal.SIGINT, signal.SIGKILL])
def test_workers_and_their_tools_die_with_the_parent(how, tmp_path):
    program = (f"import signal, sys\nfrom ci import pool\nfrom ci.test import test_pool\n"
               f"from pathlib import Path\npool.LOGS = Path({str(tmp_path)!r})\n"
               f"signal.signal(signal.SIGINT, signal.default_int_handler)\n"
               f"signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))\n"
               f"pool.run(test_pool.nap, [({str(tmp_path)!r}, i) for i in range(9)])\n")
    parent = subprocess.Popen([sys.executable, "-c", program], cwd=tools.ROOT, stderr=subprocess.DEVNULL)

    def running() -> list[int]:
        return [int(path.stem) for path in tmp_path.glob("*.pid")
                if Path("/proc", path.stem).exists() and "Z (" not in Path("/proc", path.stem, "stat").read_text()
                and Path("/proc", path.stem, "stat").read_text().split()[2] != "Z"]

    def wait(done) -> bool:
        end = time.monotonic() + 20
        while not done() and time.monotonic() < end:
            time.sleep(0.05)
        return done()

    workers = min(8, os.cpu_count() or 1)
    assert wait(lambda: len(running()) == workers)
    parent.send_signal(how)
    assert wait(lambda: parent.poll() is not None), "the parent waits for its workers"
    assert wait(lambda: not running())
    assert len(list(tmp_path.glob("*.pid"))) == workers, "no other job was begun"
