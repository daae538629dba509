"""Mutants of the smallest core: each choice breaks what it says, and only what behaves alike is proved so."""

import dataclasses

import pytest
from quadrance.cores import find

from ci import equivalence, mutants, mutate
from tb.lib.simulate import available

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
