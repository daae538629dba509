"""Jobs on worker processes that die with their parent, with a progress bar.

A worker leads a process group of its own, so that what it started (Yosys, nextpnr, a compiler) dies with it. It is
told to end by SIGTERM, or finds that its parent is gone; then the whole group is killed. FARM=tcp://scheduler:8786
(or FARM=local) sends the jobs to Dask instead: ci/farm.py.
"""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import signal
import threading
import time
from collections.abc import Callable, Hashable, Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from ci import cache, farm
from tb.lib import tools

LOGS = tools.BUILD
WATCH = 0.5  # seconds between two looks for the parent


def _end(*_: object) -> None:
    os.killpg(0, signal.SIGKILL)


def _watch(parent: int) -> None:
    while os.getppid() == parent:
        time.sleep(WATCH)
    _end()


def _worker(log: Path, since: float) -> None:
    """Begin a worker: its group, its end, its log (away from the progress bar), the age of results that it takes."""
    os.setpgid(0, 0)
    signal.signal(signal.SIGTERM, _end)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the terminal's Ctrl-C is for the parent, which ends the workers
    threading.Thread(target=_watch, args=(os.getppid(),), daemon=True).start()
    log.parent.mkdir(parents=True, exist_ok=True)
    file = os.open(log, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o644)
    os.dup2(file, 1)
    os.dup2(file, 2)
    cache.SINCE = since


def run(work: Callable, jobs: list[tuple[Hashable, ...]], since: float = 0.0,
        name: str = "report") -> dict[tuple, object]:
    """The answers of ``work(*job)`` by job, the first jobs first.

    Parameters
    ----------
    since : kept results that are older (seconds of the epoch) are computed again.
    name : stands before the progress bar; what the jobs print goes to ``build/<name>.log``.

    Raises
    ------
    RuntimeError
        Names every job that failed. The others are done all the same: they are in the cache next time.
    """
    if not jobs:
        return {}
    columns = (TextColumn(name), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn(),
               TextColumn("{task.description}"))
    log = LOGS / f"{name}.log"
    log.unlink(missing_ok=True)
    answers, failures = {}, []
    where = os.environ.get("FARM")
    ended = farm.run(where, work, jobs, since) if where else _here(work, jobs, since, log)
    with contextlib.closing(ended), Progress(*columns, console=Console(stderr=True)) as progress:
        task = progress.add_task("", total=len(jobs))
        try:
            for job, answer, error in ended:
                if error:
                    told = "on the farm" if where else f"log: {tools.local(log)}"
                    failures.append(f"{' '.join(map(str, job))}: {error} ({told})")
                else:
                    answers[job] = answer
                progress.update(task, advance=1, description=" ".join(map(str, job)))
        except KeyboardInterrupt:
            raise KeyboardInterrupt(f"{len(answers)} of {len(jobs)}") from None
    if failures:
        raise RuntimeError("\n".join([f"{len(failures)} jobs failed", *failures]))
    return answers


def _here(work: Callable, jobs: list[tuple[Hashable, ...]], since: float,
          log: Path) -> Iterator[tuple[tuple, object, BaseException | None]]:
    """(job, answer, error) as they end on processes of this machine, which end with the generator."""
    with ProcessPoolExecutor(min(8, os.cpu_count() or 1), initializer=_worker, initargs=(log, since)) as pool:
        running = {pool.submit(work, *job): job for job in jobs}
        try:
            for done in as_completed(running):
                error = done.exception()
                yield running[done], None if error else done.result(), error
        except BaseException:
            for worker in multiprocessing.active_children():
                worker.terminate()
            pool.shutdown(wait=False, cancel_futures=True)
            raise
