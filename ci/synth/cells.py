"""What a histogram of cells counts as, on the device of each flow.

ECP5: ``lut`` are four-input tables as nextpnr counts them: LUT4, two for each carry cell CCU2C and six for each
TRELLIS_DPR16X4, a small memory of 16 words of 4 bits (four tables hold it, two more of a slice write it);
``lutram`` are these small memories, ``dsp`` MULT18X18 multipliers, ``mem`` EBR blocks of 18 kbit.

Cyclone V: ``lut`` are all MISTRAL_ALUT* cells (a proxy for logic elements: registers pack beside them), ``dsp`` DSP
blocks, ``mem`` M10K blocks, ``lutram`` bits of memory in MLABs.

iCE40: ``lut`` are logic cells, SB_LUT4 and the carries that no table shares (an upper bound: Yosys' own estimate is
SB_LUT4), ``mem`` blocks of 4 kbit.
"""

from __future__ import annotations

import re

CYCLONEV = {"lut": {"MISTRAL_ALUT.*": 1}, "ff": {"MISTRAL_FF": 1}, "dsp": {"MISTRAL_MUL.*": 1},
            "mem": {"MISTRAL_M10K": 1}, "lutram": {"MISTRAL_MLAB": 1}}
COUNTS = {
    "ecp5": {"lut": {"LUT4": 1, "CCU2C": 2, "TRELLIS_DPR16X4": 6}, "ff": {"TRELLIS_FF": 1}, "dsp": {"MULT18X18D": 1},
             "mem": {"DP16KD|PDPW16KD": 1}, "lutram": {"TRELLIS_DPR16X4": 1}},
    "cyclonev": CYCLONEV, "cyclonev_nodsp": CYCLONEV,
    "ice40": {"lut": {"SB_LUT4": 1}, "ff": {"SB_DFF.*": 1}, "dsp": {"SB_MAC16": 1}, "mem": {"SB_RAM40.*": 1},
              "lutram": {}}}


def count(target: str, cells: dict[str, int]) -> dict[str, int]:
    """The columns of the report from a histogram of cells."""
    return {column: sum(weight * number for pattern, weight in weights.items() for cell, number in cells.items()
                        if re.fullmatch(pattern, cell)) for column, weights in COUNTS[target].items()}
