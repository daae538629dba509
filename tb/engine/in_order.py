"""cocotb bench of the engines whose samples build on each other: corners from the first on, none left out."""

from __future__ import annotations

import itertools

import cocotb
import numpy as np

from tb.lib import stimulus
from tb.lib.bench import CORE, _chance, _fresh, _rng

SAMPLES = 60  # of each configuration: a chain or two, solved a few times


@cocotb.test()
async def chains_in_order(dut):
    """Chains that are loaded word by word and solved, under gaps and stalls, with a reset in the middle of each."""
    bench = await _fresh(dut)
    rng = _rng()
    for cfg in stimulus.configs(CORE, rng)[:3]:
        bench.configure(cfg)
        samples = {name: words[:SAMPLES] for name, words in stimulus.corners(CORE, cfg).items()}
        for size in (int(rng.integers(20, SAMPLES)), SAMPLES):
            bench.pressure = _chance(0.4)
            gaps = itertools.cycle((0, 0, 1, 5))
            await bench.send({name: words[:size] for name, words in samples.items()}, lambda gaps=gaps: next(gaps))
            if size < SAMPLES:
                for _ in range(int(rng.integers(0, 60))):
                    await bench.edge
                await bench.reset(1)
        await bench.drain()
        iters = [port.name for port in CORE.outputs].index("out_iters")
        assert np.any(np.array(bench.board.results)[:, iters] > 0) or not cfg["cfg_limit"], "no joint was moved"
        await bench.reset(1)
