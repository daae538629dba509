"""The proofs bite: each of these cores is broken in one place, and sby must say FAIL or find no induction."""

import dataclasses
from pathlib import Path

import pytest

from ci import formal
from tb.lib import tools

FAULTS = [
    ("isqrt_comb-W15F1", "isqrt_digits.v", "~pair[0]} : {rem[D-1:0], pair}", "pair[0]} : {rem[D-1:0], pair}", "FAIL"),
    ("divide_comb-8by8", "divide_digits.v", "= |in_d[WD-1:B+1]", "= in_d[WD-1]", "FAIL"),
    ("isqrt_iter-W16R4", "isqrt_iter.v", "&& (!out_valid || out_ready)", "", "UNKNOWN"),
    ("skid_buffer-W16", "skid_buffer.v", "if (in_ready) skid <= in_d;", "skid <= in_d;", "UNKNOWN"),
    ("round_saturate-16to8by6", "round_saturate.v", "in_x[SHIFT-1]}", "1'b0}", "FAIL"),
]


def proof(name: str) -> formal.Proof:
    return next(one for one in formal.all_proofs() if one.name == name)


@pytest.mark.full
@pytest.mark.parametrize(("name", "file", "sound", "broken", "verdict"), FAULTS, ids=[fault[0] for fault in FAULTS])
def test_broken_core_is_refuted(name: str, file: str, sound: str, broken: str, verdict: str) -> None:
    one = proof(name)
    folder = tools.BUILD / "formal" / "broken" / name
    folder.mkdir(parents=True, exist_ok=True)
    sources = []
    for source in one.sources:
        if source.name == file:
            text = source.read_text()
            assert text.count(sound) == 1, f"{file} has changed: '{sound}' is not in it once"
            source = Path(folder / file)
            source.write_text(text.replace(sound, broken))
        sources.append(source)
    assert formal.prove(dataclasses.replace(one, name=f"{name}-broken", sources=tuple(sources)))[0] == verdict


@pytest.mark.full
def test_sound_core_is_proved() -> None:
    assert formal.prove(proof("skid_buffer-W16"))[0] == "PASS"
