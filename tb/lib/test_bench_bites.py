"""The bench on cores broken on purpose: a check that never failed is not yet a check."""

import signal
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from quadrance.cores import Core, Port, find

from tb.lib import bulk, program
from tb.lib.simulate import simulate
from tb.lib.suite import SEED, bulk_run, simulators

FAULTS = {1: "out_valid_stuck_at_0", 2: "drops_a_sample_under_back_pressure", 3: "one_lsb_off_on_some_words",
          4: "result_changes_while_it_waits", 5: "late_after_some_words", 6: "survives_a_reset", 7: "sends_twice",
          8: "valid_waits_for_ready", 9: "takes_a_word_in_a_reset", 10: "needs_two_clocks_of_reset",
          11: "not_ready_after_some_words", 12: "drops_what_waits_for_more_than_64_clocks"}
RARE = (3, 5, 11)  # on one word in 256: the number of samples finds them, and that is in the bulk run


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
@pytest.mark.parametrize("fault", (*RARE, 2, 12), ids=FAULTS.get)
def test_broken_core_fails_in_bulk(fault):
    with pytest.raises(AssertionError):
        bulk_run(specimen(fault), 100_000, SEED)


@pytest.mark.full
@pytest.mark.parametrize("unless", ["in_valid", "(out_valid && !out_ready)"])
def test_a_reset_that_leaves_a_result_standing_fails(unless, tmp_path):
    """In a core of 27 clocks few resets meet a result that waits, unless the bench waits for one."""
    core = altered("rotation_check", "rotation_check", "if (rst)\n            out_valid",
                   f"if (rst && !{unless})\n            out_valid", tmp_path)
    with pytest.raises(SystemExit, match="FAILED"):
        simulate(core, simulators()[0], tests=r"\.reset_in_flight$", seed=SEED)


@pytest.mark.full
def test_a_line_of_before_a_reset_that_reaches_an_answer_fails(tmp_path):
    """It takes a reset in one of ten lines of a long program; this seed has one. The core had this fault once."""
    core = altered("engine_quaternion_gd_n", "engine_gd_n_products", "error0 && in_run", "error0", tmp_path)
    with pytest.raises(SystemExit, match="FAILED"):
        simulate(core, simulators()[0], tests=r"\.reset_in_flight$", seed=2026)


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
