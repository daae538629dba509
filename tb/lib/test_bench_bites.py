"""The bench on cores broken on purpose: a check that never failed is not yet a check."""

import signal
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from quadrance.cores import Core, Port, find

from tb.lib import bulk, program, stimulus
from tb.lib.simulate import simulate
from tb.lib.suite import SEED, bulk_run, bulk_samples, reset_run, simulators

FAULTS = {1: "out_valid_stuck_at_0", 2: "drops_a_sample_under_back_pressure", 3: "one_lsb_off_on_some_words",
          4: "result_changes_while_it_waits", 5: "late_after_some_words", 6: "survives_a_reset", 7: "sends_twice",
          8: "valid_waits_for_ready", 9: "takes_a_word_in_a_reset", 10: "needs_two_clocks_of_reset",
          11: "not_ready_after_some_words", 12: "drops_what_waits_for_more_than_64_clocks",
          13: "drops_what_waits_for_more_than_1000_clocks"}
RARE = (3, 5, 11, 13)  # on one word in 256, or in a long stall: the number of clocks finds them, and that is in bulk
FALLS = "(out_valid && !out_ready)", "(out_valid && !out_ready && !(PRODUCTS == 2 && in_valid))"
UNSEEN = 8,  # in bulk: where a sample takes one clock a result that comes late looks like one


class Specimen(Core):
    """A register stage; its model is the identity."""

    @property
    def model(self):
        """``out_data = in_data``."""
        return lambda params, in_data: {"out_data": in_data}

    __hash__ = Core.__hash__


def specimen(fault: int) -> Specimen:
    """The register stage with that fault."""
    return Specimen(
        name="specimen", family="specimen", function="register", architecture="pipe", set_id=str(fault),
        params={"W": 8, "FAULT": fault}, latency=1, ii=1, sources=(Path(__file__).parent / "specimens/specimen.v",),
        cfg=(), inputs=(Port("in_data", 8, False),), outputs=(Port("out_data", 8, False),), status=None,
        model_name="", first_set=True)


def altered(name: str, module: str, old: str, new: str, folder: Path) -> Core:
    """A core of the list with another text in one of its modules."""
    core = find(name)
    text = next(path for path in core.sources if path.stem == module).read_text()
    assert old in text
    (folder / f"{module}.v").write_text(text.replace(old, new))
    return replace(core, sources=tuple(folder / path.name if path.stem == module else path for path in core.sources))


@pytest.mark.smoke
@pytest.mark.full
@pytest.mark.parametrize("simulator", simulators())
def test_sound_core_passes(simulator):
    simulate(specimen(0), simulator, seed=SEED)


@pytest.mark.full
@pytest.mark.parametrize("fault", [fault for fault in FAULTS if fault not in RARE], ids=FAULTS.get)
def test_broken_core_fails(fault):
    with pytest.raises(SystemExit, match="FAILED"):
        simulate(specimen(fault), simulators()[0], seed=SEED)


@pytest.mark.full
@pytest.mark.parametrize("fault", [fault for fault in FAULTS if fault not in UNSEEN], ids=FAULTS.get)
def test_broken_core_fails_in_bulk(fault):
    with pytest.raises(AssertionError, match=rf"sample \d+.*seed {SEED}"):
        bulk_run(specimen(fault), 100_000, SEED)


@pytest.mark.full
@pytest.mark.parametrize("unless", ["in_valid", "(out_valid && !out_ready)"])
def test_a_reset_that_leaves_a_result_standing_fails(unless, tmp_path):
    """In a core of 27 clocks few resets meet a result that waits, unless the bench waits for one."""
    core = altered("rotation_check", "rotation_check", "if (rst)\n            out_valid",
                   f"if (rst && !{unless})\n            out_valid", tmp_path)
    with pytest.raises(SystemExit, match="FAILED"):
        simulate(core, simulators()[0], tests=r"\.reset_in_flight$", seed=SEED)


GD_N, UNITS = "engine_quaternion_gd_n", "unit_vectors"
IF_RESET = "if (rst && i != 1) begin"
STALLED = "waited <= out_valid && !out_ready ? waited + 9'd1 : 9'd0;"
RESETS = {  # core, module, text, broken text; ci/test/test_formal.py has what the proof of resets says
    "a line of before a reset reaches an answer": (GD_N, "engine_gd_n_products", "error1 && in_run", "error1"),
    "a line of before a reset, with PIPE": (f"{GD_N}-PIPE1", "engine_gd_n_products", "error1 && in_run", "error1"),
    "a count of words is left": (GD_N, GD_N, "if (rst)\n", "if (rst && !accept)\n"),
    "a write is on its way": (GD_N, GD_N, "checks && !rst;", "checks;"),
    "a write is on its way, with PIPE": (f"{GD_N}-PIPE1", GD_N, "accept && !rst};", "accept};"),
    "a word that is written stays": ("vector_ik3", UNITS, IF_RESET, "if (rst && !in_sin[i] && i != 1) begin"),
    "the third sample sees the word of before": ("vector_ik2", UNITS, "always @(posedge clk) begin", """
            reg [U+1:0] left;
            reg [1:0] count;
            always @(posedge clk) begin
                if (rst) {count, left} <= {2'd0, out_c[J +: U+2]};
                else if (in_cos[i]) count <= count + {1'b0, count != 2'd3};
                if (in_cos[i] && in_none && count == 2'd2) out_c[J +: U+2] <= left;"""),
}


@pytest.mark.full
@pytest.mark.parametrize("fault", RESETS.values(), ids=RESETS)
def test_a_reset_that_leaves_something_fails(fault, tmp_path):
    """What a later sample sees of the time before a reset; the core had the first of these faults once."""
    core = altered(*fault, tmp_path)
    with pytest.raises(AssertionError, match="behind reset|without an accepted sample"):
        reset_run(core, stimulus.configs(core, np.random.default_rng(SEED))[0], SEED)


@pytest.mark.full
def test_words_lost_in_a_long_stall_fail(tmp_path):
    """The core forgets what was written to it when a result waits for 250 clocks: the stalled run sees it later."""
    core = altered(GD_N, GD_N, "        if (rst)\n            fill <= 11'd0;\n    end\n", f"""        {STALLED}
        if (rst || waited == 9'd250)
            fill <= 11'd0;
    end
    reg [8:0] waited;
""", tmp_path)
    with pytest.raises(AssertionError, match="sample .* model"):
        bulk_run(core, bulk_samples(core), SEED)


@pytest.mark.full
def test_valid_that_falls_with_two_multipliers_fails(tmp_path):
    """Only a further set of the core has the fault; ci/test/test_formal.py has its proof."""
    core = altered("vector_ik2-U16P2", "kernel_vector_solve", *FALLS, tmp_path)
    with pytest.raises(AssertionError, match="out_valid fell before out_ready took the result: sample"):
        bulk_run(core, bulk_samples(core), SEED)


@pytest.mark.full
def test_bulk_reports_latency_and_interval():
    result = bulk.stream(specimen(0), {"in_data": np.arange(256)})
    assert set(result.latency) == {1} and result.ii == 1
    assert np.array_equal(result.outputs["out_data"], np.arange(256))


@pytest.mark.full
def test_builds_of_other_sources_do_not_meet(tmp_path):
    """Two cores of one name: the sound one first, then a broken one, then the sound one again."""
    sound = specimen(0)
    text = sound.sources[0].read_text()
    words = {"in_data": np.arange(256)}
    assert "in_data" in text
    broken = tmp_path / "specimen.v"
    broken.write_text(text.replace("<= in_data", "<= ~in_data"))
    assert broken.read_text() != text
    bulk.compare(sound, words, {}, bulk.stream(sound, words))
    with pytest.raises(AssertionError, match="out_data"):
        bulk.compare(sound, words, {}, bulk.stream(replace(sound, sources=(broken,)), words))
    bulk.compare(sound, words, {}, bulk.stream(sound, words))


@pytest.mark.full
def test_a_truncated_build_is_made_again():
    core, words = specimen(0), {"in_data": np.arange(16)}
    built = program.build(core, "-torn")
    built.unlink()
    (built.parent / "core.partial").write_bytes(b"half")
    bulk.compare(core, words, {}, bulk.stream(core, words, label="-torn"))


@pytest.mark.full
def test_what_does_not_compile_is_no_failed_test(tmp_path):
    """A bench says FAILED of a core, and something else when it never ran."""
    (tmp_path / "specimen.v").write_text("module specimen (input wire clk; endmodule\n")
    torn = replace(specimen(0), sources=(tmp_path / "specimen.v",))
    for simulator in simulators():
        with pytest.raises(RuntimeError, match="specimen-0 in"):
            simulate(torn, simulator, seed=SEED)
    with pytest.raises(RuntimeError, match="verilator failed"):
        program.build(torn)


@pytest.mark.full
def test_a_bench_leaves_ctrl_c_and_term_alone():
    """Or a worker that is told to end takes its next job."""
    before = signal.getsignal(signal.SIGINT), signal.getsignal(signal.SIGTERM)
    simulate(specimen(0), simulators()[0], tests="one_clock_of_reset", seed=SEED)
    assert (signal.getsignal(signal.SIGINT), signal.getsignal(signal.SIGTERM)) == before
