"""Mutants of the smallest core: each choice breaks what it says, and only what behaves alike is proved so."""

import dataclasses
import re

import pytest
from quadrance.cores import find

from ci import equivalence, mutants, mutate
from tb.lib.simulate import available, simulate

SEED = 5


@pytest.fixture(scope="module")
def made():
    """The first dozen mutants of the skid buffer."""
    return mutate.make(find("skid_buffer"), 12, SEED)


@pytest.mark.full
@pytest.mark.skipif(not available("icarus"), reason="unknown registers need Icarus")
def test_whole_core_passes_and_mutants_are_killed(made):
    assert not mutants.killed_in_bulk(made, None, SEED), "without a plusarg the netlist is the core"
    assert not mutants.killed_by_bench(made, None, SEED)
    lives = [one for one in made.every if not mutants.killed_in_bulk(made, one, SEED)]
    assert len(lives) < len(made.every) // 2
    mutants.clear(made.core)


@pytest.mark.full
def test_a_missing_tool_is_no_kill(made, monkeypatch):
    def missing(*_, **__):
        raise SystemExit("iverilog is missing: install it from your system's packages")

    monkeypatch.setattr(mutants, "simulate", missing)
    with pytest.raises(SystemExit, match="iverilog is missing"):
        mutants.killed_by_bench(made, made.every[0], SEED)


@pytest.mark.parametrize(("core", "simulators"), [("skid_buffer", ["verilator", "icarus"]),
                                                  ("isqrt_comb", ["verilator"])])
def test_a_core_without_registers_has_no_unknown_ones_to_show(made, monkeypatch, core, simulators):
    """Icarus would have no test to run, which counts as a failure of the whole bench."""
    asked = []
    monkeypatch.setattr(mutants, "simulate", lambda core, simulator, **_: asked.append(simulator))
    assert not mutants.killed_by_bench(dataclasses.replace(made, core=find(core)), None, SEED)
    assert asked == simulators


@pytest.mark.full
def test_proof_knows_equal_from_different(made):
    prover = equivalence.Prover(made)
    same = mutate.Mutant(0, "mutate -mode none")
    assert prover.equivalent(same), "the number of no mutant leaves the core as it is"
    killed = next(one for one in made.every if mutants.killed_in_bulk(made, one, SEED))
    assert not prover.equivalent(killed)


@pytest.mark.full
def test_proof_without_multipliers_and_memories():
    made = mutate.make(find("vector_fk1"), 12, SEED)
    prover = equivalence.Prover(made)
    graph = prover._without
    assert prover._proved(graph, mutate.Mutant(0, "mutate -mode none"))
    killed = [one for one in made.every[::3] if mutants.killed_in_bulk(made, one, SEED, 200)]
    assert killed and not any(prover._proved(graph, one) for one in killed), "what a product is given is compared too"
    assert graph.size[-1] < 4000, "the multipliers are in it"
    mutants.clear(made.core)


def test_words_that_are_never_read():
    for name in (r"\\kernel.path.slopes.slope [1575]", "slopes.slope[1663]"):
        assert "never read" in mutants.reason(f"memory {name} bit 11")
    for mutation in (r"memory \\kernel.path.slopes.slope [1664] bit 0", r"memory \\other.slope [1575] bit 1",
                     "mutate -mode inv -cell slopes.slope -port RD_ADDR -portbit 0"):
        assert not mutants.reason(mutation)
    verdict = mutants.Verdict("vector_ik2-U16", killed=98, survivors=["memory slopes.slope[1600] bit 0", "mutate x"])
    assert verdict.alive == ["mutate x"] and verdict.rate == 98 / 99


@pytest.mark.slow
@pytest.mark.skipif(not available("icarus"), reason="undefined words need Icarus")
@pytest.mark.parametrize("words", mutants.UNREAD, ids=lambda one: one["core"])
def test_words_that_are_never_read_may_be_undefined(words):
    """Undefined for the bench in Icarus, all bits the other way round for the bulk run: nothing changes."""
    made = mutate.make(find(words["core"]), 1, SEED)
    text = (made.netlist.parent / "mutants.v").read_text()
    first, last = words["words"]
    picked = {number: int(word[2]) for number, word in enumerate(mutate.WORD.finditer(text))
              for name, index in [mutate.place(word[1])] if re.search(words["memory"], name) and first <= index <= last}
    assert len(picked) == last - first + 1, "some of these words have no value, or there is no such memory"
    whole = made.netlist.read_text()

    def masked(bit: str) -> None:
        masks = {number: f"{{{width}{{1'b{bit}}}}}" for number, width in picked.items()}
        made.netlist.write_text(whole.replace(text, mutate.flipped(text, masks)))

    masked("1")
    assert not mutants.killed_in_bulk(made, None, SEED)
    masked("x")
    simulate(dataclasses.replace(made.core, sources=(made.netlist,)), "icarus", seed=SEED, parameters=False,
             label=mutants.LABEL)
    mutants.clear(made.core)


def test_nobody_mutates_the_clock_of_a_memory_without_one():
    cell = {"type": "$mem_v2", "parameters": {"RD_CLK_ENABLE": "0"}}
    clocked = {"type": "$mem_v2", "parameters": {"RD_CLK_ENABLE": "1"}}
    design = {"modules": {"core": {"cells": {"a.slope": cell, "b": clocked, "c": {"type": "$mul", "parameters": {}}}}}}
    assert mutate.memories_without_clock(design) == {"a.slope"}
    assert mutate.CONTROL.search("mutate -mode inv -cell a.slope -port RD_EN -portbit 0")[1] == "a.slope"
    assert not mutate.CONTROL.search("mutate -mode inv -cell a.slope -port RD_ADDR -portbit 0")


def test_memory_words_are_flipped_one_by_one():
    text = "  initial begin\n    \\a.rom [0] = 4'h3;\n    \\a.rom [1] = 4'hc;\n  end\n"
    assert mutate.flipped(text, {1: "4'h8"}) == text.replace("4'hc;", "4'hc ^ (4'h8);")
