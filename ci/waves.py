"""`make waves CORE=...`: record the bench of a core and say how to look at it."""

from __future__ import annotations

import sys

from quadrance import cores

from tb.lib import tools
from tb.lib.simulate import available, simulate
from tb.lib.suite import SEED


def main() -> None:
    try:
        core = cores.find(sys.argv[1])
    except KeyError as error:
        raise SystemExit(f"waves: {error.args[0]}") from None
    simulator = "icarus" if available("icarus") else "verilator"
    tests = "corners_back|latency_and" if core.clocked else "corners_and"
    folder = simulate(core, simulator, tests=tests, seed=SEED, waves=True, label="-waves")
    wave = max((p for p in folder.iterdir() if p.suffix in (".fst", ".vcd")), key=lambda p: p.stat().st_mtime)
    name = wave.relative_to(tools.ROOT)
    print(f"waves: {name} (SEED={SEED})\nopen it with: gtkwave {name}   (or: surfer {name})")


if __name__ == "__main__":
    main()
