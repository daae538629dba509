"""`make waves CORE=... TEST=... SEED=...`: record tests of the bench of a core; what failed, when, how to repeat it."""

from __future__ import annotations

import argparse
import ast
import re
import shutil
from pathlib import Path

from quadrance.cli.catalogue import Refused, choose, find
from quadrance.cores import Core

from tb.lib import program, tools
from tb.lib.simulate import SIMULATORS, BenchFailed, Failure, available, simulate
from tb.lib.suite import SEED

FOLDER = tools.BUILD / "waves"
BENCH = Path(program.__file__).with_name("bench.py")


def tests_of(core: Core) -> list[str]:
    """Names of the tests of the bench that a core runs: those of a clock, or the one of a combinational core."""
    found = [node.name for node in ast.parse(BENCH.read_text()).body if isinstance(node, ast.AsyncFunctionDef)
             and any("cocotb.test" in ast.unparse(one) for one in node.decorator_list)]
    return [name for name in found if ("combinational" in name) != core.clocked]


def record(core: Core, simulator: str, tests: list[str], seed: int = SEED) -> tuple[Path, list[Failure]]:
    """The waveform of tests of a core's bench, below build/waves, and which of them failed."""
    folder = program.build_folder(core, simulator, "-waves", True, True)
    for old in [*folder.glob("*.fst"), *folder.glob("*.vcd")]:
        old.unlink()
    failed: list[Failure] = []
    try:
        simulate(core, simulator, tests=rf"\.({'|'.join(tests)})$", seed=seed, waves=True, label="-waves")
    except BenchFailed as error:
        failed = error.failures
    made = next((path for path in folder.iterdir() if path.suffix in (".fst", ".vcd")), None)
    if made is None:
        raise RuntimeError(f"{core.id} in {simulator}: no waveform in {tools.local(folder)}")
    FOLDER.mkdir(parents=True, exist_ok=True)
    label = f"-{tests[0]}" if len(tests) == 1 else ""
    wave = FOLDER / f"{core.id}-{simulator}{label}-seed{seed}{made.suffix}"
    shutil.copyfile(made, wave)
    return wave, failed


def command(core: Core, simulator: str, tests: list[str], seed: int = SEED) -> str:
    """The command that records the same again."""
    test = f" TEST={'|'.join(tests)}" if len(tests) == 1 else f" TEST='{'|'.join(tests)}'"
    return f"make waves CORE={core.id} SIM={simulator}{test} SEED={seed}"


def explain(core: Core, simulator: str, seed: int = SEED) -> list[str]:
    """Lines about a bench that failed: the waveform of the tests that did, the time, the command that repeats it."""
    wave, failed = record(core, simulator, tests_of(core), seed)
    if not failed:
        return [f"the bench of {core.id} passes when it is recorded: {command(core, simulator, tests_of(core), seed)}"]
    first = failed[0]
    wave, again = record(core, simulator, [first.test], seed)
    return ([f"{first.test} fails at {again[0].time_ns:g} ns: {again[0].message}",
             f"waveform: {tools.local(wave)}", f"again:    {command(core, simulator, [first.test], seed)}"]
            if again else [f"waveform: {tools.local(wave)}"]) + [
        f"also fails: {one.test}" for one in failed[1:]]


def main() -> int:
    """Record, and say where the waveform is."""
    parser = argparse.ArgumentParser(prog="make waves", description=__doc__)
    parser.add_argument("core")
    parser.add_argument("--test", help="names of tests, or a regular expression of them")
    parser.add_argument("--sim", help="icarus or verilator")
    args = parser.parse_args()
    try:
        core = find(args.core)
        known = tests_of(core)
        tests = known[1:2] + [one for one in known if one.startswith("latency")] if core.clocked else known
        if args.test:
            tests = [one for one in known if re.search(args.test, one)] or [choose("test", args.test, known)]
        simulator = choose("simulator", args.sim, SIMULATORS) if args.sim else next(
            one for one in SIMULATORS if available(one))
        wave, failed = record(core, simulator, tests)
    except (Refused, RuntimeError, re.error) as error:
        raise SystemExit(f"waves: {error}") from None
    name = tools.local(wave)
    print(f"waves: {name} (SEED={SEED}; {', '.join(tests)})\nopen it with: gtkwave {name}   (or: surfer {name})")
    for one in failed:
        print(f"{one.test} FAILED at {one.time_ns:g} ns: {one.message}")
    return bool(failed)


if __name__ == "__main__":
    raise SystemExit(main())
