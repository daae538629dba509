"""Results kept by the content of all that they depend on: `build/cache/<digest>.json`."""

from __future__ import annotations

import hashlib
import json
import uuid
from collections.abc import Callable
from pathlib import Path

from tb.lib import tools

FOLDER = tools.BUILD / "cache"
SINCE = 0.0  # seconds of the epoch: what is older is made again


def digest(key: object) -> str:
    """Name of a result: the content of all that it depends on."""
    return hashlib.sha256(json.dumps(key, sort_keys=True).encode()).hexdigest()[:24]


def current(path: Path) -> bool:
    """Whether `path` is there and not older than `SINCE`."""
    return path.exists() and path.stat().st_mtime >= SINCE


def cached(key: object, compute: Callable[[], dict], keep: Callable[[dict], bool] | None = None) -> dict:
    """The JSON result of `compute()`, computed once for each content of `key` (if `keep` says so of it).

    The file appears whole or not at all, however many processes compute it.
    """
    path = FOLDER / f"{digest(key)}.json"
    if current(path):
        return json.loads(path.read_text())
    result = compute()
    if keep and not keep(result):
        return result
    FOLDER.mkdir(parents=True, exist_ok=True)
    partial = path.with_suffix(f".{uuid.uuid4().hex}")
    partial.write_text(json.dumps(result))
    partial.replace(path)
    return result
