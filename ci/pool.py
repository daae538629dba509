"""This module runs jobs on worker processes with a progress bar. It returns every answer and every failure, and leaves
no process when the run ends.

The workers are Dask's (ci/farm.py): of this machine, or of FARM=tcp://scheduler:8786.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable, Hashable

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from ci import farm
from tb.lib import tools

LOGS = tools.BUILD


def run(work: Callable, jobs: list[tuple[Hashable, ...]], since: float = 0.0,
        name: str = "report") -> dict[tuple, object]:
    """The answers of ``work(*job)`` by job, the first jobs first.

    Parameters
    ----------
    since : kept results that are older (seconds of the epoch) are computed again.
    name : printed before the progress bar; what the jobs print goes to ``build/<name>.log``.

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
    ended = farm.run(where, work, jobs, log, since)
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
