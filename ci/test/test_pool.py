"""All jobs are answered, on this machine and on a farm, whichever worker dies; no worker is left behind."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import dask
import pytest

from ci import cache, farm, pool
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


# The farm

JOBS = [(f"job{i}", i) for i in range(12)]


def work(name, number, folder=None):
    """A job that takes a while and says which worker does it."""
    folder = Path(os.environ["FARM_TEST"])
    (folder / f"{name}.{os.getppid()}").touch()
    time.sleep(0.3)
    return {"name": name, "value": number ** 3}


def fails(number):
    if number == 2:
        raise ValueError("two is wrong")
    return number


def secured():
    """The lines of the head of ci/farm.py that make certificates; a machine's environment after them."""
    lines = [line.strip() for line in farm.__doc__.split("\n") if line.startswith("    ")]
    first = next(i for i, line in enumerate(lines) if line.startswith("openssl"))
    assert lines[first + 2] == "dask scheduler --protocol tls"
    env = subprocess.run(["bash", "-c", "\n".join(["set -e", *lines[first:first + 2], "env -0"])], check=True,
                         capture_output=True, text=True).stdout
    return {key: value for key, _, value in (one.partition("=") for one in env.split("\0")) if key.startswith("DASK_")}


@pytest.fixture
def cluster(request, tmp_path, monkeypatch):
    """A scheduler and three workers, each a process of its own; their address and the workers."""
    monkeypatch.setenv("FARM_TEST", str(tmp_path))
    protocol = getattr(request, "param", "tcp")
    if protocol == "tls":
        monkeypatch.chdir(tmp_path)
        for key, value in secured().items():
            monkeypatch.setenv(key, value)
        monkeypatch.setattr(dask.config, "global_config", dask.config.merge(dask.config.global_config,
                                                                            dask.config.collect_env()))
    monkeypatch.setattr(pool, "LOGS", tmp_path)
    env = os.environ | {"PYTHONPATH": f"{tools.ROOT}:{tools.ROOT / 'models'}", "FARM_TEST": str(tmp_path)}
    address = tmp_path / "scheduler.json"

    def start(*words):
        return subprocess.Popen([sys.executable, "-m", *words, "--scheduler-file", str(address)], cwd=tools.ROOT,
                                env=env, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    started = [start("distributed.cli.dask_scheduler", "--port", "0", "--no-dashboard", "--host", "127.0.0.1",
                     "--protocol", protocol)]
    while not address.exists():
        time.sleep(0.1)
    workers = [start("distributed.cli.dask_worker", "--nthreads", "1", "--no-nanny", "--no-dashboard",
                     "--name", f"w{i}") for i in range(3)]
    import json

    url = json.loads(address.read_text())["address"]
    from distributed import Client

    with Client(url) as client:
        client.wait_for_workers(3, timeout=120)
    yield url, workers
    for process in workers + started:
        process.kill()
        process.wait()


@pytest.mark.slow
def test_a_worker_killed_in_the_middle_loses_nothing(cluster, tmp_path, monkeypatch):
    url, workers = cluster
    local = pool.run(work, JOBS)
    here = {path.name for path in tmp_path.glob("job*")}
    monkeypatch.setenv("FARM", url)
    killed = []

    def kill_when_some_are_done(*arguments, **named):
        for i, one in enumerate(original(*arguments, **named)):
            if i == 2:
                victim = workers[0]
                victim.send_signal(signal.SIGKILL)
                victim.wait()
                killed.append(victim.pid)
            yield one

    original = farm.run
    monkeypatch.setattr(farm, "run", kill_when_some_are_done)
    assert pool.run(work, JOBS) == local
    ran = [path.name.split(".") for path in tmp_path.glob("job*") if path.name not in here]
    assert killed and {name for name, _ in ran} == {name for name, _ in JOBS}
    assert {int(pid) for _, pid in ran} <= {process.pid for process in workers}
    assert len({pid for _, pid in ran}) > 1, "the farm used one worker alone"


@pytest.mark.slow
def test_errors_and_another_checkout_are_named(cluster, monkeypatch):
    url, _ = cluster
    monkeypatch.setenv("FARM", url)
    with pytest.raises(RuntimeError, match="1 jobs failed\n2: two is wrong"):
        pool.run(fails, [(1,), (2,)])
    monkeypatch.setattr(farm, "_odd", lambda client: ["tcp://elsewhere:1"])
    with pytest.raises(RuntimeError, match="another checkout or other tools on tcp://elsewhere:1"):
        pool.run(fails, [(1,)])


@pytest.mark.slow
@pytest.mark.parametrize("cluster", ["tls"], indirect=True)
def test_a_farm_with_certificates_answers_those_alone_who_have_one(cluster, monkeypatch, capsys):
    url, _ = cluster
    assert url.startswith("tls://")
    monkeypatch.setenv("FARM", url)
    assert pool.run(half, [(2,), (6,)]) == {(2,): 1, (6,): 3} and "whoever" not in capsys.readouterr().err
    subprocess.run(["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-subj", "/CN=farm", "-keyout", "other",
                    "-out", "other"], check=True, capture_output=True)
    monkeypatch.setattr(farm, "CONNECT", 3)
    with dask.config.set({f"distributed.comm.tls.{key}": "other" for key in ("ca-file", "client.cert", "client.key")}):
        with pytest.raises(RuntimeError, match="no scheduler answers"):
            pool.run(half, [(2,)])
    with pytest.raises(RuntimeError, match="no scheduler answers"):
        monkeypatch.setenv("FARM", url.replace("tls", "tcp"))
        pool.run(half, [(2,)])


@pytest.mark.parametrize(("where", "open_"), [
    ("tcp://10.0.0.7:8786", True), ("farm.example:8786", True), ("tcp://0.0.0.0:8786", True), ("ws://farm:8786", True),
    ("tcp://[2001:db8::1]:8786", True), ("tls://10.0.0.7:8786", False), ("tcp://127.0.0.1:8786", False),
    ("localhost:8786", False), ("tcp://[::1]:8786", False)])
def test_a_farm_in_the_clear_is_told_of(where, open_):
    assert bool(farm.warning(where)) == open_
    said = subprocess.run([sys.executable, "-m", "ci.farm", where], cwd=tools.ROOT, capture_output=True, text=True)
    assert ("whoever reaches this port can run code" in said.stderr) == open_ and not said.returncode


def test_no_scheduler_is_a_sentence(monkeypatch, tmp_path):
    monkeypatch.setattr(pool, "LOGS", tmp_path)
    monkeypatch.setattr(farm, "CONNECT", 1)
    monkeypatch.setenv("FARM", "tcp://127.0.0.1:9")
    with pytest.raises(RuntimeError, match="FARM=tcp://127.0.0.1:9: no scheduler answers"):
        pool.run(fails, [(1,)])


def test_the_fingerprint_follows_the_sources(monkeypatch, tmp_path):
    for name in ("rtl/a.v", "models/a.py"):
        (tmp_path / name).parent.mkdir()
        (tmp_path / name).write_text("one")
    monkeypatch.setattr(tools, "ROOT", tmp_path)
    before = farm.fingerprint()
    assert farm.fingerprint() == before
    (tmp_path / "rtl/a.v").write_text("two")
    assert farm.fingerprint() != before
