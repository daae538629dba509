"""This fixture is a made-up report with rows of six kinematic cores and a primitive."""

import copy

import pytest

from tb.lib import tools

AREA = {"lut": 300, "ff": 100, "dsp": 1, "mem": 0, "lutram": 0}


def row(core, family, function, architecture, lut, cycles, mhz=100.0, error=0.7, words=2.0, total=2.5):
    """A row of the report with plain figures."""
    area = {target: AREA | {"lut": lut + extra} for target, extra in
            (("cyclonev", 0), ("cyclonev_nodsp", 200), ("ice40", 400), ("ecp5", 150))}
    def mm(lsb):
        return round(lsb / 25.6, 6)

    return {"core": core, "set": "S24", "family": family, "function": function, "architecture": architecture,
            "params": {"W": 16, "F": 8}, "area": area, "fmax_mhz": {"ecp5": mhz}, "latency_ns": cycles * 1000 / mhz,
            "latency_cycles": cycles, "ii": cycles, "error_lsb": {"max": error, "rms": error / 2},
            "error_mm": {"max": mm(error), "rms": mm(error / 2)}, "sweep_error_lsb": {"max": error, "rms": error / 2},
            "words_lsb": words, "words_mm": mm(words), "total_lsb": total, "total_mm": mm(total)}


ROWS = [row("paper_fk1", "paper", "fk1", "comb", 340, 2, mhz=30.0, words=600.0, total=600.5),
        row("rational_fk1", "rational", "fk1", "table", 120, 2),
        row("classic_fk1_iter", "classic", "fk1", "iter", 280, 18, error=0.6, words=0.9, total=1.5),
        row("classic_fk1_comb", "classic", "fk1", "comb", 1400, 1, mhz=25.0),
        row("rational_ik1", "rational", "ik1", "iter", 300, 9),
        row("classic_ik1_iter", "classic", "ik1", "iter", 270, 17),
        row("isqrt_iter", "arith", "isqrt", "iter", 61, 9)]
for one in ROWS:
    if one["family"] == "arith":
        one |= {"sweep_error_lsb": {"max": 0.99, "rms": 0.5}} | dict.fromkeys(
            ("error_mm", "words_lsb", "words_mm", "total_lsb", "total_mm"))


@pytest.fixture
def made():
    """The report without its sources."""
    return {"tools": tools.versions(), "arm": "cobra600", "cores": copy.deepcopy(ROWS),
            "trajectory": {"name": "Cobra", "l1_mm": 325.0, "l2_mm": 275.0, "mm_per_unit": 10.0, "yaw": False,
                           "samples": 1000, "workspace": 4096},
            "sources": {"cores": {}, "arm": "", "simulation": {}}}


@pytest.fixture
def small():
    """A row of twelve-bit words, which is not to be compared with the others."""
    return row("classic_fk1_iter", "classic", "fk1", "iter", 90, 1, error=0.1, words=0.1, total=0.1) | {
        "set": "W12", "params": {"W": 12, "F": 4}}
