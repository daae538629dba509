"""Jobs on Dask workers: processes of this machine, or those of a scheduler (FARM=tcp://host:8786).

A job is a function of this project and plain arguments; its answer follows from these and the checkout alone, so it may
run anywhere, twice as well. A worker that dies gives its jobs to the others. Workers of a scheduler have the same
checkout and the same tools, or the run is refused before it begins. To start some:

    dask scheduler                                        on one machine
    make worker FARM=tcp://scheduler:8786                 on the others, in a checkout each; N=4: four processes

Whoever reaches the port of a plain tcp:// scheduler can run code on every worker. Dask's certificates keep others out;
make one file, and export it on every machine (bash); then FARM=tls://scheduler:8786:

    openssl req -x509 -newkey rsa:3072 -nodes -days 365 -subj /CN=farm -keyout farm.pem -out farm.pem
    export DASK_DISTRIBUTED__COMM__TLS__{CA_FILE,{SCHEDULER,WORKER,CLIENT}__{CERT,KEY}}=$PWD/farm.pem
    dask scheduler --protocol tls
"""

from __future__ import annotations

import contextlib
import functools
import ipaddress
import logging
import multiprocessing
import os
import signal
import sys
import threading
import time
import uuid
from collections.abc import Callable, Hashable, Iterator
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from importlib import import_module
from pathlib import Path
from urllib.parse import urlsplit

from ci import cache
from tb.lib import tools

CONNECT = 15  # seconds to find a scheduler, and for its first worker to appear
WATCH = 0.5  # seconds between two looks of a job's process for its worker
RETRIES = 5  # workers of this machine that may die under one job before it counts as failed
PLACES = {"rtl": ("*.v", "cores.toml"), "models": ("*.py", "*.toml"), "ci": ("*.py", "*.toml"),
          "tb": ("*.py", "*.cpp", "*.v", "*.sv")}


def fingerprint() -> str:
    """Digest of all that answers follow from: sources, models, benches and tools of this checkout."""
    files = [path for folder, names in PLACES.items() for name in names
             for path in sorted((tools.ROOT / folder).rglob(name)) if "__pycache__" not in path.parts]
    return cache.digest([tools.versions(), [(tools.local(path), cache.meaning(path)) for path in files]])


def warning(where: str) -> str:
    """What to say of a scheduler's address: a line where it is in the clear and not of this machine, else nothing."""
    parts = urlsplit(where if "://" in where else f"tcp://{where}")
    try:
        here = ipaddress.ip_address(parts.hostname or "").is_loopback
    except ValueError:
        here = parts.hostname == "localhost"
    if here or parts.scheme in ("tls", "wss", "inproc"):
        return ""
    return (f"FARM={where}: whoever reaches this port can run code on every worker and here; "
            "head of ci/farm.py: tls:// with certificates")


def _end(*_: object) -> None:
    os.killpg(0, signal.SIGKILL)


def _bind() -> None:
    """Begin the process of a worker's jobs, which dies with the worker; what it starts (Yosys) dies with it."""
    def watch(parent: int) -> None:
        while os.getppid() == parent:
            time.sleep(WATCH)
        _end()

    os.setpgid(0, 0)
    signal.signal(signal.SIGTERM, _end)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=watch, args=(os.getppid(),), daemon=True).start()


@functools.cache
def _process() -> ProcessPoolExecutor:
    """The process of this worker's jobs: a worker runs them on a thread, and cocotb-test wants to be on the first."""
    return ProcessPoolExecutor(1, multiprocessing.get_context("spawn"), _bind)


def _done(work: Callable, job: tuple, since: float) -> object:
    cache.SINCE = since
    try:
        return work(*job)
    except tools.ToolError as error:  # of its message alone it cannot be made again on the other side: the pool broke
        raise RuntimeError(str(error)) from None


def call(work: Callable, job: tuple, since: float) -> object:
    """A job on a worker, whose kept results are taken where they are not older than `since`."""
    try:
        return _process().submit(_done, work, job, since).result()
    except SystemExit as missing:  # a tool: the reason is the job's, the worker goes on
        raise RuntimeError(str(missing)) from None
    except BrokenProcessPool:  # killed: so is the worker, and Dask gives the job to another
        os.kill(os.getpid(), signal.SIGKILL)


def _begin(log: Path) -> None:
    """Begin a worker of this machine: what it prints goes to `log`; Ctrl-C is for the parent, which ends it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    file = os.open(log, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o644)
    os.dup2(file, 1)
    os.dup2(file, 2)


@contextlib.contextmanager
def _here(log: Path) -> Iterator:
    """A client of workers on this machine, which end with it at once, whatever they are at."""
    import distributed

    log.parent.mkdir(parents=True, exist_ok=True)
    with distributed.LocalCluster(
            n_workers=min(8, os.cpu_count() or 1), threads_per_worker=1, host="127.0.0.1",
            dashboard_address="127.0.0.1:0", memory_limit=0, local_directory=str(tools.BUILD / "dask"),
            silence_logs=logging.CRITICAL) as cluster, \
            distributed.Client(cluster) as client:
        client.register_worker_callbacks(functools.partial(_begin, log))  # of those that replace a dead one too
        workers = list(client.run(os.getpid).values())
        try:
            yield client
        except BaseException:
            for pid in workers:
                with contextlib.suppress(ProcessLookupError):
                    os.kill(pid, signal.SIGKILL)
            raise


@contextlib.contextmanager
def _there(where: str) -> Iterator:
    """A client of a scheduler, whose workers are as they should be."""
    import distributed

    if said := warning(where):
        print(said, file=sys.stderr)
    try:
        client = distributed.Client(where, timeout=CONNECT)
    except (OSError, ValueError, TimeoutError) as error:
        raise RuntimeError(f"FARM={where}: no scheduler answers ({type(error).__name__}); start one with "
                           "`dask scheduler`, or leave FARM out") from None
    with client:
        try:
            client.wait_for_workers(1, timeout=CONNECT)
        except TimeoutError:
            raise RuntimeError(f"FARM={where}: the scheduler has no worker; start some with "
                               f"`make worker FARM={where}`") from None
        if odd := _odd(client):
            raise RuntimeError(f"FARM={where}: another checkout or other tools on {', '.join(odd)}")
        yield client


def _odd(client) -> list[str]:
    """Workers whose checkout or tools are not those of here."""
    mine = fingerprint()
    return sorted(worker for worker, theirs in client.run(fingerprint).items() if theirs != mine)


def run(where: str | None, work: Callable, jobs: list[tuple[Hashable, ...]], log: Path,
        since: float = 0.0) -> Iterator[tuple[tuple, object, BaseException | None]]:
    """(job, answer, error) as they end; the jobs that are left are cancelled with the generator.

    where : address of a scheduler; None: workers of this machine, which print to `log`.

    Raises
    ------
    RuntimeError
        Where there is no scheduler, no worker, or a worker with another checkout or other tools.
    """
    import dask  # half a second: not for those who only look at what is kept
    import distributed

    dask.config.set({"distributed.scheduler.allowed-failures": RETRIES, "distributed.worker.daemon": False})
    if work.__module__ == "__main__":  # under the name that a worker can import
        work = getattr(import_module(sys.modules["__main__"].__spec__.name), work.__name__)
    with _there(where) if where else _here(log) as client:
        name = uuid.uuid4().hex[:8]  # a scheduler that lives long gives no answer of an older checkout
        running = {client.submit(call, work, job, since, key=f"{work.__name__}-{name}-{i}", priority=-i): job
                   for i, job in enumerate(jobs)}
        try:
            for done in distributed.as_completed(list(running)):
                error = done.exception()
                yield running[done], None if error else done.result(), error
        except BaseException:
            client.cancel(list(running), force=True)
            raise


if __name__ == "__main__":  # make worker
    if told := warning(sys.argv[1]):
        print(told, file=sys.stderr)
