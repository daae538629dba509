"""Jobs on Dask workers: a scheduler's (FARM=tcp://host:8786), or a cluster on this machine (FARM=local).

A job is a function of the house and plain arguments; its answer follows from these and the checkout alone, so it may
run anywhere, twice as well. A worker that dies gives its jobs to the others. Workers have the same checkout and the
same tools, or the run is refused before it begins. To start some:

    dask scheduler                                        on one machine
    make worker FARM=tcp://scheduler:8786                 on the others, in a checkout each; N=4: four processes
"""

from __future__ import annotations

import uuid
from collections.abc import Callable, Hashable, Iterator

from ci import cache
from tb.lib import tools

CONNECT = 15  # seconds to find a scheduler, and for its first worker to appear
RETRIES = 5  # workers that may die under one job before it counts as failed (of FARM=local; 3 by Dask's default)
PLACES = {"rtl": ("*.v", "cores.toml"), "models": ("*.py", "*.toml"), "ci": ("*.py", "*.toml"),
          "tb": ("*.py", "*.cpp", "*.v", "*.sv")}


def fingerprint() -> str:
    """Digest of all that answers follow from: sources, models, benches and tools of this checkout."""
    files = [path for folder, names in PLACES.items() for name in names
             for path in sorted((tools.ROOT / folder).rglob(name)) if "__pycache__" not in path.parts]
    return cache.digest([tools.versions(), [(tools.local(path), path.read_text()) for path in files]])


def call(work: Callable, job: tuple, since: float) -> object:
    """A job on a worker, whose kept results are taken where they are not older than `since`."""
    cache.SINCE = since
    return work(*job)


def _odd(client) -> list[str]:
    """Workers whose checkout or tools are not those of here."""
    mine = fingerprint()
    return sorted(worker for worker, theirs in client.run(fingerprint).items() if theirs != mine)


def run(where: str, work: Callable, jobs: list[tuple[Hashable, ...]],
        since: float = 0.0) -> Iterator[tuple[tuple, object, BaseException | None]]:
    """(job, answer, error) as they end on the farm; the jobs that are left are cancelled with the generator.

    Raises
    ------
    RuntimeError
        Where there is no scheduler, no worker, or a worker with another checkout or other tools.
    """
    import dask  # seconds: not for those who have no farm
    import distributed

    dask.config.set({"distributed.scheduler.allowed-failures": RETRIES})
    try:
        client = distributed.Client(timeout=CONNECT, processes=True, threads_per_worker=1, dashboard_address=None) \
            if where == "local" else distributed.Client(where, timeout=CONNECT)
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
        name = uuid.uuid4().hex[:8]  # a scheduler that lives long gives no answer of an older checkout
        running = {client.submit(call, work, job, since, key=f"{work.__name__}-{name}-{i}"): job
                   for i, job in enumerate(jobs)}
        try:
            for done in distributed.as_completed(list(running)):
                error = done.exception()
                yield running[done], None if error else done.result(), error
        except BaseException:
            client.cancel(list(running), force=True)
            raise
