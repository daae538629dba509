"""Mutants and cover lists: bugs are found, an equivalent mutant alone is proved equal, a verdict nobody ran is told."""

import dataclasses
import re
from collections import Counter
from pathlib import Path
from types import SimpleNamespace

import pytest
from quadrance import arms
from quadrance.arm import switches
from quadrance.cores import Core, all_cores, at, find

from ci import cache, checks, cover, coverage, equivalence, mutants, mutate, programs
from tb.lib import legal, program, suite, tools
from tb.lib.simulate import available, simulate
from tb.lib.test_bench_bites import altered

# Each mutant of the smallest core breaks what it says

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


def test_a_proof_is_given_up_after_its_processor_time():
    with pytest.raises(tools.ToolError):
        tools.run("perl", "-e", "1 while 1", processor=1)


@pytest.mark.full
def test_proof_without_multipliers_and_memories():
    made = mutate.make(find("vector_fk1"), 12, SEED)
    prover = equivalence.Prover(made, seconds=5)
    killed = [one for one in made.every[::3] if mutants.killed_in_bulk(made, one, SEED, 200)]
    assert killed
    for facts in (False, True):
        graph = prover._of_command(False, facts)
        assert prover._proved(graph, mutate.Mutant(0, "mutate -mode none"))
        assert not any(prover._proved(graph, one) for one in killed), "what a product is given is compared too"
        assert graph.size[-1] < 4500, "the multipliers are in it"
    mutants.clear(made.core)


@pytest.mark.slow
@pytest.mark.parametrize(("core", "word", "bit", "same"), [
    ("engine_quaternion_gd_n", 32, 27, True),  # a factor of a product with the register that is 0
    ("engine_quaternion_gd_n", 32, 33, False),
    ("vector_fk6", 2, 14, True),  # a factor of a product that the line leaves out
    ("vector_fk6", 50, 20, True),  # a line behind the last
    ("vector_fk6", 2, 33, False)])
def test_proof_knows_what_a_line_of_a_program_uses(core, word, bit, same):
    made = mutate.make(find(core), 1, SEED)
    name = next(name for name, _ in (mutate.place(one[1]) for one in mutate.WORD.finditer(
        (made.netlist.parent / "gold.v").read_text())) if name.endswith(".lines"))
    assert equivalence.Prover(made).equivalent(mutate.Mutant(1, word=1, name=f"{name} [{word}]", bit=bit)) == same


def test_a_memory_that_is_written_keeps_its_words_or_has_one_that_nothing_reads():
    cell = {"type": "$mem_v2", "parameters": {
        "RD_PORTS": "1", "WR_PORTS": "1", "ABITS": "10", "WIDTH": "100", "SIZE": "100", "OFFSET": "0",
        "RD_CLK_ENABLE": "0", "INIT": "xxxx0101xxxxxxxx"},
        "port_directions": {"RD_ADDR": "input", "RD_DATA": "output", "WR_ADDR": "input", "WR_DATA": "input",
                            "WR_EN": "input"},
        "connections": {"RD_ADDR": [2, 3], "RD_DATA": [4, 5, 6, 7], "WR_ADDR": [8, 9], "WR_DATA": [10] * 4,
                        "WR_EN": [11] * 4}}

    def text(init: str, facts: bool) -> str:
        design = {"modules": {"core": {"cells": {"file": cell | {"parameters": cell["parameters"] | {"INIT": init}}},
                                       "ports": {}}}}
        (one,) = equivalence.cut_out(design, set(), {"file"})
        return one.results(facts) + "\n".join(one.watched(facts))

    kept, nil = text("xxxx0101xxxxxxxx", True), text("x", True)
    assert "g_cut0_RD_ADDR[0 +: 2] == 2'd2 ? 4'd5" in kept and "g_cut0_WR_ADDR == 2)" in kept
    assert "~(| g_cut0_RD_ADDR" in nil and "(| {g_cut0_WR_ADDR, m_cut0_WR_ADDR})" in nil
    assert text("x", False) == text("xxxx0101xxxxxxxx", False)
    assert not any(sign in text("x", False) for sign in ("4'd5", "~(|", "(| {"))


def test_a_verdict_hangs_on_what_its_stimulus_imports():
    def names(core: str) -> set[str]:
        return {path.name for path in cache.stimulus(find(core))}

    assert names("engine_rus_fk") == {"engine.py", "rus_fk.py"}
    assert names("engine_delta_fk") == {"engine.py", "delta.py"}
    assert {"vector.py", "chains.py", "targets.py"} <= names("vector_ik2") and names("isqrt_comb") == {"arith.py"}
    assert "edges.py" in names("table_ik2") & names("six_keep")  # not imported by their families themselves


@pytest.fixture
def four(monkeypatch):
    """Four mutants of the skid buffer that nobody has to make; only number 2 can be proved equal."""
    every = tuple(mutate.Mutant(number, f"mutate {number}") for number in range(4))
    made = mutate.Mutants(find("skid_buffer"), mutate.WORK / "none" / "netlist.v", 3, every)
    monkeypatch.setattr(mutate, "make", lambda core, count, seed: made)
    prover = SimpleNamespace(equivalent=lambda one, whole=True: one.number == 2)
    monkeypatch.setattr(equivalence, "Prover", lambda *_: prover)
    return made


def test_survivors_of_a_verdict_that_stands_are_tried_again(four):
    standing = mutants.Verdict(four.core.id, "digest", "bench", SEED, 90, 5, survivors=["mutate 1", "mutate 2"])
    assert mutants.proved(four.core, 4, standing) == dataclasses.replace(
        standing, equivalent=6, survivors=["mutate 1"])


@pytest.mark.parametrize(("kills", "bench", "long", "survivors", "equivalent"), [
    ({0, 1, 2, 3}, [0, 1, 2, 3], [], [], 5),
    ({0}, [0], [3], [1, 2], 5),  # as it was
    (set(), [], [3], [0, 1, 2], 5),  # a kill is lost
    ({0, 1}, [0, 1], [3], [2], 5)])
def test_where_the_bench_alone_has_changed(four, monkeypatch, kills, bench, long, survivors, equivalent):
    """Only what the cocotb bench could decide is decided again."""
    def names(numbers):
        return [f"mutate {number}" for number in numbers]

    monkeypatch.setattr(mutants, "killed_by_bench", lambda _, one, seed: one is not None and one.number in kills)
    monkeypatch.setattr(mutants, "killed_in_bulk", lambda *_: False)
    standing = mutants.Verdict(four.core.id, "digest", "an older bench", SEED, 90, 5, names([0]), names([3]),
                               names([1, 2]))
    assert mutants.benched(four.core, 4, standing) == dataclasses.replace(
        standing, cocotb=mutants.cocotb(), bench=names(bench), long=names(long), survivors=names(survivors),
        equivalent=equivalent)


@pytest.mark.parametrize("run", ["killed_in_bulk", "killed_by_bench"])
def test_a_bench_that_fails_on_the_core_itself_kills_nothing(four, monkeypatch, run):
    for name in ("killed_in_bulk", "killed_by_bench"):
        monkeypatch.setattr(mutants, name, lambda *_, name=name: name == run)
    with pytest.raises(RuntimeError, match="unmutated"):
        mutants.benched(four.core, 4, mutants.Verdict(four.core.id, survivors=["mutate 1"]))


def test_words_that_are_never_read():
    for name in (r"\\kernel.path.slopes.slope [1575]", "slopes.slope[1663]"):
        assert "never read" in mutants.reason(f"memory {name} bit 11", "vector_ik2-U16")
    for mutation in (r"memory \\kernel.path.slopes.slope [1664] bit 0", r"memory \\other.slope [1575] bit 1",
                     "mutate -mode inv -cell slopes.slope -port RD_ADDR -portbit 0"):
        assert not mutants.reason(mutation, "vector_ik2-U16")
    divides = r"memory \\engine.datapath.g_roots.roots.reciprocal.slopes [844] bit 11"
    assert mutants.reason(divides, "vector_rates6-PIPE2") and not mutants.reason(divides, "vector_ik6-U16")
    verdict = mutants.Verdict("vector_ik2-U16", killed=98, survivors=["memory slopes.slope[1600] bit 0", "mutate x"])
    assert verdict.alive == ["mutate x"] and verdict.rate == 98 / 99


def test_a_bit_of_a_line_that_selects_nothing_needs_no_proof():
    for pipe, line, bit in ((0, 42, 22), (1, 60, 14), (1, 5, 15)):
        word = rf"memory \control.g_pipe{pipe}.control.lines [{line}] bit {bit}"
        assert mutants.reason(word, f"vector_ur_fk-{'PIPE1' if pipe else 'U16'}")
        assert not mutants.reason(word, "vector_fk6-PIPE2"), "another memory"
    assert not mutants.reason(r"memory \control.g_pipe1.control.lines [5] bit 3", "vector_ur_fk-PIPE1"), "its DEST"


def test_a_run_ends_well_with_enough_kills_and_an_argument_for_each_survivor():
    argued = r"mutate -cell $flatten\aim.\micro.$shiftx$rtl/cordic/cordic_aim_step.v:42$91 -port A -portbit 1085"
    good = mutants.Verdict("classic_ik1-iter-A16", killed=99, survivors=[argued])
    assert mutants.enough([good]) and not mutants.unexplained(good)
    assert not mutants.enough([dataclasses.replace(good, killed=98)])
    assert not mutants.enough([dataclasses.replace(good, killed=198, survivors=[argued, "mutate x"])])


@pytest.mark.slow
@pytest.mark.skipif(not available("icarus"), reason="undefined words need Icarus")
@pytest.mark.parametrize("words", mutants.KNOWN["words"], ids=lambda one: one["core"])
def test_words_that_are_never_read_may_be_undefined(words):
    first, last = words["words"]
    undefined(find(words["core"]), lambda name, index, width: (1 << width) - 1
              if re.search(words["memory"], name) and first <= index <= last else 0, last - first + 1)


@pytest.mark.slow
@pytest.mark.skipif(not available("icarus"), reason="undefined words need Icarus")
@pytest.mark.parametrize("name", ["vector_ur_fk-U16", "vector_ur_fk-PIPE2", "vector_ik6-U16", "vector_ur_ik-PIPE1",
                                  "vector_ik6_all-PIPE2", "engine_delta_fk-PIPE1", "vector_ur_ik_all-U16"])
def test_bits_of_a_program_that_nothing_reads_may_be_undefined(name):
    core = find(name)
    ((memory, masks),) = programs.unread(core).items()
    undefined(core, lambda at, index, width: masks[index] if at == memory else 0, sum(map(bool, masks)))


def undefined(core, mask, count):
    """Bits that are undefined for the bench in Icarus, and the other way round for the bulk run: nothing changes.

    `mask(name, index, width)`: the bits of a word of a memory, in `count` words.
    """
    made = mutate.make(core, 1, SEED)
    text = (made.netlist.parent / "mutants.v").read_text()
    picked = {number: (width, bits) for number, word in enumerate(mutate.WORD.finditer(text))
              for width, (name, index) in [(int(word[2]), mutate.place(word[1]))]
              if (bits := mask(name, index, width))}
    assert len(picked) == count, "some of these words have no value, or there is no such memory"
    whole = made.netlist.read_text()

    def masked(bit: str) -> None:
        masks = {number: f"{width}'b" + f"{bits:0{width}b}".replace("1", bit)
                 for number, (width, bits) in picked.items()}
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


def test_a_mutant_has_the_number_of_its_command():
    """One that is left out must not shift those behind it: they would be broken under another's name."""
    commands = [f"mutate -ctrl mutant 7 {number} -mode inv -cell {cell} -port {port} -portbit 0"
                for number, cell, port in ((1, "b", "Y"), (2, "a.slope", "RD_EN"), (3, "c", "A"))]
    assert [(one.number, one.plusarg) for one in mutate.commanded(commands, {"a.slope"})] == [
        (1, "+mutant=1"), (3, "+mutant=3")]


def test_memory_words_are_flipped_one_by_one():
    text = "  initial begin\n    \\a.rom [0] = 4'h3;\n    \\a.rom [1] = 4'hc;\n  end\n"
    assert mutate.flipped(text, {1: "4'h8"}) == text.replace("4'hc;", "4'hc ^ (4'h8);")


def test_the_section_says_which_verdicts_are_stale_and_does_not_count_them(monkeypatch):
    one, two, three = (find(name) for name in ("isqrt_comb", "isqrt", "divide_comb"))
    monkeypatch.setattr(mutants, "digest", lambda core, count: f"now {core.id}")
    verdicts = {one.id: mutants.Verdict(one.id, f"now {one.id}", mutants.cocotb(), 1, 99, survivors=["mutate x"]),
                two.id: mutants.Verdict(two.id, "before", mutants.cocotb(), 1, 77, survivors=["mutate y"])}
    old = mutants.stale(verdicts, [one, two, three])
    assert old == {two.id}
    text = "\n".join(mutants.section([*verdicts.values()], [one, two, three], old))
    assert "1 of 3 cores: 99 killed by the bulk run, 0 by" in text and "1 survived.\n99.00% of those that" in text
    assert f"`ci/survivors.toml`: none yet for 1, in {one.id}." in text
    assert f"Never broken, or changed since and left out above: {two.id}, {three.id}." in text
    assert "mutate y" not in text and mutants.together(["a-1", "b-2", "a-3"]) == ["a-1/3", "b-2"]
    text = "\n".join(mutants.section([*verdicts.values()], [one, two], {one.id, two.id}))
    assert "No verdict follows" in text and "%" not in text


def test_the_section_names_cores_whose_survivors_have_no_argument(monkeypatch):
    monkeypatch.setattr(mutants, "explained", lambda core, mutation: {"m": "why"}.get(mutation[0], ""))
    whole = mutants.Verdict("isqrt_comb-W16", "", mutants.cocotb(), 1, 90, 5, ["b1", "b2"], ["l1"])
    some = mutants.Verdict("skid_buffer-W16", "", mutants.cocotb(), 1, 97, survivors=["m1", "x", "m2"])
    text = "\n".join(mutants.section([whole, some], [find("isqrt_comb"), find("skid_buffer")], set()))
    assert "187 killed by the bulk run, 2 by the cocotb bench alone, 1 in the long run alone; 5 proved equal" in text
    assert "3 survived.\n98.45% of those that differ are killed; in 1 cores all of them are." in text
    assert "none yet for 1, in skid_buffer-W16." in text
    assert "isqrt" not in text and "b1" not in text and "Never broken" not in text
    monkeypatch.setattr(mutants, "explained", lambda core, mutation: "why")
    assert "each has one." in "\n".join(mutants.section([some], [find("skid_buffer")], set()))


def test_survivors_whose_lines_have_moved_are_judged_anew(monkeypatch):
    core = find("isqrt_comb")
    made = mutate.Mutants(core, None, 1, (mutate.Mutant(1, "mutate -cell a.v:9"),))
    standing = mutants.Verdict(core.id, seed=7, killed=1, survivors=["mutate -cell a.v:8"])
    monkeypatch.setattr(mutate, "make", lambda *_: made)
    monkeypatch.setattr(mutants, "judge", lambda *given: given)
    assert mutants.benched(core, 4, standing) == mutants.proved(core, 4, standing) == (core, 4, 7)


@pytest.mark.parametrize(("was", "bench", "left"), [("this", "today's", "stands"), ("this", "older", "benched"),
                                                    ("another", "today's", "judged"), ("", "today's", "judged")])
def test_a_verdict_stands_where_the_netlist_has_not_changed(monkeypatch, was, bench, left):
    core = find("isqrt_comb")
    for name in ("digest", "circuit"):
        monkeypatch.setattr(mutants, name, lambda *_, name=name: {"digest": "new", "circuit": "this"}[name])
    monkeypatch.setattr(mutants, "cocotb", lambda: "today's")
    monkeypatch.setattr(mutants, "benched", lambda core, count, standing: dataclasses.replace(standing, bench=["m"]))
    monkeypatch.setattr(mutants, "judged", lambda core, count, seed: {"core": core, "seed": seed})
    standing = mutants.Verdict(core.id, "old", bench, 7, 90, survivors=["m"], circuit=was)
    renewed = mutants.renewed(core, 4, standing, 8)
    assert renewed == (mutants.Verdict(core.id, seed=8) if left == "judged" else
                       dataclasses.replace(standing, digest="new", bench=["m"] if left == "benched" else []))


def test_the_netlist_that_is_mutated_has_no_names(tmp_path):
    """Another name leaves it as it is, and another operator does not."""
    core = find("skid_buffer")
    folder = tools.BUILD / "test_mutants"
    folder.mkdir(parents=True, exist_ok=True)
    (source,) = core.sources

    def circuit(old: str, new: str) -> str:
        path, text = folder / f"{tmp_path.name}.v", source.read_text()
        assert old in text
        path.write_text(text.replace(old, new))
        return mutate.circuit(dataclasses.replace(core, sources=(path,)))

    whole = circuit("module", "module")
    assert circuit("move", "ahead") == whole and circuit("&&", "||") != whole


# Cover lists: what is in them, that a bug at one value is found, and that a verdict that nobody ran is; the coverage
# page names what nothing reaches, and only that


@pytest.mark.full
def test_a_list_has_ends_neighbours_an_odd_middle_and_all_pairs_of_switches():
    core = find("arm_ik3")
    sets = legal.cover(core)
    every = [*sets, *(one.params for one in legal.sets(core))]
    assert sets == legal.cover(core) and len(sets) > legal.MOST and not any(map(legal.rule_of(core).broken, sets))
    for name, (low, high) in legal.ranges(core).items():
        for other in (one.params for one in legal.sets(core)):  # with the switches of a listed set
            tops = {key: other[key] for key in ("BASE", "SHOULDER", "LATERAL", "ELBOW", "ABSOLUTE", "MARGINS")}
            here = {one[name] for one in every if tops.items() <= one.items()}
            assert name in tops or {one for one in (low, high) if legal.near(core, tops | {name: one})} <= here
        ends = {one for one in (low, low + 1, high - 1, high) if low <= one <= high and legal.near(core, {name: one})}
        assert {low, high} <= ends <= {one[name] for one in [*sets, core.params]}
    assert any(one["W"] % 2 and one["W"] not in (9, 15) for one in sets)
    tops = ("BASE", "SHOULDER", "LATERAL", "ELBOW", "ABSOLUTE")
    for i, one in enumerate(tops):
        for other in tops[:i]:
            assert len({(each[one], each[other]) for each in [*sets, core.params]}) == 4
    for name in arms.known():
        assert any(switches(arms.load(name)).items() <= each.items() for each in [*sets, core.params])


@pytest.mark.full
def test_a_further_pipe_has_its_own_ends():
    core = find("vector_ik2-PIPE1")
    sets = legal.cover(core)
    assert len(sets) == legal.MOST and {one["PIPE"] for one in sets} == {1}
    assert len(legal.cover(find("vector_fk6-PIPE1"))) == legal.MOST // 3  # the engine's words have one width
    listed = [one.params for one in all_cores() if one.name == core.name and one.params["PIPE"] == 1]
    for name, ends in legal.ranges(core).items():
        assert set(ends) <= {one[name] for one in [*sets, *listed]}
    names = [(one.name, one.set_id) for each in cover.cores() for one in (at(each, row) for row in legal.cover(each))]
    assert len(names) == len(set(names))


@pytest.mark.full
def test_ranges_are_those_of_the_rule_wherever_it_is():
    assert legal.ranges(find("rational_ik1")) == {"W": (4, 24), "F": (0, 23), "S": (2, 40), "PIPE": (0, 0),
                                                   "MULTIPLY": (18, 27)}
    assert legal.ranges(find("cordic_rotate")) == {"MODE": (0, 0), "W": (8, 16), "A": (5, 19)}
    assert legal.ranges(find("vector_fk2-PIPE1")) == {"W": (4, 24), "F": (0, 23), "U": (4, 24), "PIPE": (1, 1),
                                                      "MULTIPLY": (18, 27)}
    assert legal.ranges(find("vector_chain")) == {"SPACE": (0, 1), "W": (4, 24), "F": (0, 23), "U": (4, 24),
                                                  "N": (2, 64), "PIPE": (0, 0), "MULTIPLY": (18, 27)}
    assert legal.ranges(find("paper_ik2"))["S"] == (4, 24)  # in paper_solve_path
    for core in cover.cores():
        for params in legal.cover(core):
            assert not legal.rule_of(core).broken(params) and set(params) == set(core.params)


def _broken_at(name: str, condition: str, folder: Path) -> Core:
    """A core whose first status bit is wrong where the parameters fulfil a condition."""
    text = find(name).sources[0].read_text()
    line = re.search(r"( *)assign +out_status *= *(.*);", text)
    assert line, name
    return altered(name, name, line[0], f"{line[1]}assign out_status = ({line[2]}) ^ {{3'b0, {condition}}};", folder)


@pytest.mark.full
@pytest.mark.parametrize(("name", "condition", "where"), [
    ("vector_fk1", "W == 21", lambda p: p["W"] == 21),
    ("arm_fk3", "LATERAL == 0 && ABSOLUTE == 1", lambda p: not p["LATERAL"] and p["ABSOLUTE"]),
], ids=("W21", "LATERAL0ABSOLUTE1"))
def test_a_bug_at_one_value_is_found(name, condition, where, tmp_path):
    """The sets of the list that have the value fail, and the next one does not."""
    core = _broken_at(name, condition, tmp_path)
    sets = legal.cover(find(name))
    hit = next(params for params in sets if where(params))
    with pytest.raises(AssertionError, match="out_status"):
        cover.run(at(core, hit))
    cover.run(at(core, next(params for params in sets if not where(params))))


@pytest.mark.full
def test_every_listed_set_has_a_whole_bulk_run(tmp_path, monkeypatch):
    """Here, or in `make test`; a bug that only resets or a random word of the bulk run shows is found."""
    asked = {name for name in cover.wanted(cover.cores())}
    assert {(core.name, core.set_id) for core in all_cores() if not legal.daily(core)} <= asked
    core = find("vector_fk1-W12U10")
    assert not legal.daily(core) and cover.verdict(core.name, core.set_id, core.params) == ""
    broken = dataclasses.replace(core, sources=_broken_at(core.name, "1'b1", tmp_path).sources)
    monkeypatch.setattr(cover, "listed", lambda name: {core.set_id: broken})
    assert "bulk run" in cover.verdict(core.name, core.set_id, core.params)


@pytest.mark.full
@pytest.mark.parametrize("name", ["vector_fk2-PIPE1", "engine_quaternion_gd_n-N8"])
def test_the_first_set_of_a_further_pipe_and_a_core_of_long_samples_have_a_bench(tmp_path, monkeypatch, name):
    """What the bulk run would not find is found by the bench, and a sound core passes it."""
    core = find(name)
    assert core.first_set and legal.daily(core) != bool(core.params.get("PIPE"))
    monkeypatch.setattr(suite, "bulk_run", lambda *_, **__: 1)
    assert cover.verdict(core.name, core.set_id, core.params) == ""
    broken = dataclasses.replace(core, sources=_broken_at(core.name, "1'b1", tmp_path).sources)
    monkeypatch.setattr(cover, "listed", lambda name: {core.set_id: broken})
    assert "FAILED" in cover.verdict(core.name, core.set_id, core.params)


@pytest.mark.full
def test_a_verdict_that_is_missing_stale_or_was_never_run_is_found(tmp_path, monkeypatch):
    monkeypatch.setattr(cover, "STORE", tmp_path / "cover.json")
    flags = program._flags()
    monkeypatch.setattr(program, "_flags", lambda: flags)  # the benches' run-time: one less to compile
    sets = cover.wanted([find("isqrt_comb")])
    assert f"{len(sets)} sets have no verdict" in cover.check(sets)[0]
    rows = {label: digest for (_, label), (_, digest) in sets.items()}
    cover.keep({"isqrt_comb": rows})
    monkeypatch.setattr(cover, "DRAWN", 1)
    assert cover.check(sets) == []

    def wrong(*_):  # what a run would have found
        raise AssertionError("a warning")

    monkeypatch.setattr(cover, "run", wrong)
    monkeypatch.setattr(cover, "_whole", wrong)  # of a listed set
    assert "a warning" in cover.check(sets)[0]
    first = next(iter(rows))
    cover.keep({"isqrt_comb": rows | {first: "stale"}})
    assert "1 sets have no verdict" in cover.check(sets)[0]
    cover.keep({"isqrt_comb": rows | {"W99F0": "of another list"}})
    assert "1 verdicts are of no set" in cover.check(sets)[0]


# Coverage


def record(file: str, line: int, kind: str, what: str, count: int) -> str:
    """A line of coverage.dat as Verilator writes it."""
    fields = {"f": f"/somewhere/rtl/{file}", "l": line, "n": 9, "t": kind, "page": f"v_{kind}/x", "o": what}
    return "C '" + "".join(f"\x01{key}\x02{value}" for key, value in fields.items()) + f"' {count}\n"


def test_points_of_two_instances_add_up() -> None:
    text = "# SystemC::Coverage-3\n" + "".join(record("arith/a.v", 7, "branch", "if", count) for count in (0, 3))
    assert coverage.points(text) == Counter({("arith/a.v", 7, "branch", "if"): 3})


def test_what_one_core_reaches_is_no_hole_of_the_other() -> None:
    one, two = ("arith/a.v", 7, "branch", "if"), ("arith/a.v", 9, "line", "block")
    found = {"a": Counter({one: 0, two: 0}), "b": Counter({one: 5, two: 0})}
    assert coverage.table(found) == ["a: 0 of 2 lines and branches, 0 of 0 toggles",
                                     "b: 1 of 2 lines and branches, 0 of 0 toggles"]
    text = "\n".join(coverage.section(found))
    assert "- `arith/a.v:9 block`: **open**" in text and "a.v:7" not in text and "It ran 2 sets; 0 of them" in text


def test_a_section_of_the_page_replaces_itself_alone(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(checks, "PAGE", tmp_path / "checks.md")
    checks.put("Coverage", ["one"])
    checks.put("Netlists", ["two"])
    checks.put("Coverage", ["three"])
    assert checks.PAGE.read_text() == "# What the long runs found\n\n## Coverage\n\nthree\n\n## Netlists\n\ntwo\n"


def test_reasons_belong_to_lines_that_exist() -> None:
    for one in coverage.REASONS:
        lines = (coverage.RTL / one["file"]).read_text().splitlines()
        number = next(number for number, line in enumerate(lines, 1) if one["text"] in line)
        assert coverage.explained(f"{one['file']}:{number} case").endswith(one["why"])


def test_absent_status_bits_and_constant_functions_are_left_out() -> None:
    core = find("rational_fk1")
    file = "arith/root_product.v"
    lines = (coverage.RTL / file).read_text().splitlines()
    inside = next(i for i, line in enumerate(lines, 1) if "function" in line) + 1
    points = Counter({("rational/rational_fk1.v", 25, "toggle", "out_status[0]:0->1"): 0,
                      ("rational/rational_fk1.v", 25, "toggle", "out_status[2]:0->1"): 0,
                      (file, inside, "line", "block"): 0, (file, 1, "line", "block"): 0})
    left = set(coverage.counted(core, points))
    assert left == {("rational/rational_fk1.v", 25, "toggle", "out_status[2]:0->1"), (file, 1, "line", "block")}
