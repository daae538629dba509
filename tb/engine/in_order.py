"""cocotb bench of the engines whose samples build on each other: corners from the first on, none left out."""

from __future__ import annotations

import itertools

import cocotb
import numpy as np

from tb.lib import stimulus
from tb.lib.bench import CORE, _chance, _fresh, _rng

SAMPLES = 130 if CORE.name == "engine_rus_fk" else 60  # of each configuration: a chain or two, solved a few times
PATIENCE = 20_000  # clocks of a solution


@cocotb.test()
async def chains_in_order(dut):
    """Chains that are loaded word by word and solved, under gaps and stalls, with a reset in a solution of each."""
    bench = await _fresh(dut)
    rng = _rng()
    for cfg in stimulus.configs(CORE, rng)[:3]:
        bench.configure(cfg)
        samples = {name: words[:SAMPLES] for name, words in stimulus.corners(CORE, cfg).items()}
        solves = np.flatnonzero(samples["in_op"] == 0)
        for size in (int(rng.choice(solves[solves > 20])) + 1, SAMPLES):
            bench.pressure = _chance(0.4)
            gaps = itertools.cycle((0, 0, 1, 5))
            await bench.send({name: words[:size] for name, words in samples.items()}, lambda gaps=gaps: next(gaps),
                             PATIENCE)
            if size < SAMPLES:
                for _ in range(int(rng.integers(0, rng.choice([60, 900])))):
                    await bench.edge
                await bench.reset(1)
        await bench.drain(PATIENCE)
        iters = [port.name for port in CORE.outputs].index("out_iters")
        assert np.any(np.array(bench.board.results)[:, iters] > 0) or not cfg["cfg_limit"], "no joint was moved"
        await bench.reset(1)
