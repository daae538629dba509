"""Jobs on worker processes that die with their parent, with a progress bar.

A worker leads a process group of its own, so that what it started (Yosys, nextpnr, a compiler) dies with it. It is
told to end by SIGTERM, or finds that its parent is gone; then the whole group is killed.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
import time
from collections.abc import Callable, Hashable
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from ci import cache
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
    with ProcessPoolExecutor(min(8, os.cpu_count() or 1), initializer=_worker, initargs=(log, since)) as pool:
        running = {pool.submit(work, *job): job for job in jobs}
        try:
            with Progress(*columns, console=Console(stderr=True)) as progress:
                task = progress.add_task("", total=len(running))
                for done in as_completed(running):
                    job = running[done]
                    if error := done.exception():
                        failures.append(f"{' '.join(map(str, job))}: {error} (log: {tools.local(log)})")
                    else:
                        answers[job] = done.result()
                    progress.update(task, advance=1, description=" ".join(map(str, job)))
        except BaseException as stop:
            for worker in multiprocessing.active_children():
                worker.terminate()
            pool.shutdown(wait=False, cancel_futures=True)
            if isinstance(stop, KeyboardInterrupt):
                raise KeyboardInterrupt(f"{len(answers)} of {len(jobs)}") from None
            raise
    if failures:
        raise RuntimeError("\n".join([f"{len(failures)} jobs failed", *failures]))
    return answers
