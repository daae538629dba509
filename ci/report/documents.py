"""report.md: the whole report as one page."""

from __future__ import annotations

from ci.report import chains, designs, engines, judgement, verdict
from ci.report.comparison import cordic_wins, pareto, smaller
from ci.report.paper import paper_tables
from ci.report.rows import KINEMATIC, number, pick, primitives
from ci.report.tables import Table, accuracy_table, cost_table, glance_table, primitive_table

COST_COLUMNS = """\
- **cycles**: rising edges from the one that accepts a sample to the first with its result valid, measured in simulation
  of the Verilog (*comb.*: a combinational part, without a clock).
- **II**: cycles between two accepted samples, measured in the same run.
- **MHz**: nextpnr's clock for ECP5-25k, speed grade 6, all ports registered: the median of three seeds, or the mean of
  the first two where these agree within 3 % (that median lies between them).
- **ns**: the latency at that clock (of a combinational part: one period).
- **ALUT**: a proxy for logic elements, every `MISTRAL_ALUT*` cell of Yosys' Cyclone V flow; registers pack beside them.
- **FF**, **DSP**, **mem**: registers, DSP blocks and memory blocks of the same flow.
- **ALUT, no DSP**: the same with multipliers in logic, mapped by a short ABC script (the default one takes minutes on
  larger cores), at most 8 % above the default on the one-joint cores and 18 % on the smallest primitive.
- **iCE40 LC**: logic cells of `synth_ice40` with plain `abc -lut 4`, within 20 % of its default, either way.
- **ECP5 LUT**: four-input tables of `synth_ecp5`, with the multipliers in DSP blocks."""

ERROR_COLUMNS = """\
Errors are distances at the tip of the arm; one LSB is 2^-F units.

- **max, rms** (LSB and mm): arithmetic alone, against float64 on the same input words, along the trajectory.
- **sweep**: the same over random and border inputs. The greater of both is *arithmetic* above,
  and what is compared below.
- **words**: the greatest error over the arm's workspace, borders of the words included, of an exact core of the same
  words: what rounding joints, targets and links costs, for inverse cores also the answered joint words.
- **total**: the greatest error of words and arithmetic together over the same samples: where the tip of the real core
  is, against where it was meant to be. Both errors have a direction. At the sample where rounding costs an exact core
  most, the arithmetic error of the real core may point the other way, or make it answer the neighbouring word, which
  is nearer: a total below its words is right."""

MAP_NOTE = """\
The map has one random point in each of its cells. The greatest errors lie on lines as thin as a word (borders of the
words, the stretched and the folded arm), which few of these points meet and which the table's samples seek: each panel
says the greatest error of both. Neither is a bound; the bounds are on the cores' pages."""

PAPER_NOTE = """\
The paper counts Cyclone V logic elements (Quartus 16.0) and cycles at 50 MHz; ours are the ALUT proxy with DSP blocks
and memory blocks beside it (in brackets: without DSP blocks) and measured cycles with the time at the core's own ECP5
clock. It compares area with the parallel CORDIC alone and latency with the iterative one alone; here both stand against
both. Every core stands with its first parameter set (Q7.8; `paper_*` at the paper's 8 spread bits, `rational_*` at 24
spread bits, `classic_*` at 16 angle bits). Each cell is the family's smallest figure, so the area and the cycles of one
column may come from two cores."""


VERDICT_NOTE = """\
Each core stands with the shortest words whose *total* error at the tip (words and arithmetic, the greatest over the
arm's workspace, borders of the words included) is at most the target; LSB are those of Q7.8, whatever the core's own
words are. Coordinates have as few bits before the point as the arm's reach needs. Of CORDIC the iterative cores stand;
the parallel ones are in the tables above.

- **words**: the parameters with the fewest bits in all, of as many bits the sharpest; other parameters are those of the
  core's first set.
- **total LSB**: the error that is reached.
- **ALUT + DSP + memory**, **cycles**, **ns**, **ALUT, no DSP**: as above. *Every block as ALUTs* counts a DSP block as
  {dsp} ALUTs and a memory block as {mem}: their share of a Cyclone V 5CEA4."""

SCENARIO_NOTE = """\
Rows of whole tasks at {target}: a codec at every joint in front of a forward core or behind an inverse one, where its
own words are others; the core has the words that it has at one of the targets above, and `word` is the parameter of the
joint word outside. Areas are the sum of the parts, cycles one after the other, times at the slowest clock of them; the
parts were not synthesised together. A core that is absent has no codec yet, or does not reach the target."""


def trajectory_note(report: dict) -> str:
    """What was run, in one paragraph."""
    arm = report["trajectory"]
    yaw = "" if arm["yaw"] else " The arm has no yaw: three-joint cores see its two links stood on a turntable."
    links = f"{number(arm['l1_mm'], 5)} and {number(arm['l2_mm'], 5)} mm"
    return (f"Arm `{report['arm']}`, {arm['name']}: links of {links}, "
            f"{number(arm['mm_per_unit'], 5)} mm a unit (1 LSB of Q7.8 is {number(arm['mm_per_unit'] / 256)} mm). "
            f"{arm['samples']} samples of a circle, a line and a pick-and-place within the joint limits, and "
            f"{arm['workspace']} of the whole workspace. One-joint cores move the first link alone.{yaw}")


def listed(sentences: list[str], none: str) -> str:
    """Sentences as a Markdown list, `none` where there are none."""
    return "\n".join(f"- {sentence}" for sentence in sentences) if sentences else none


def _titled(table: Table, *after: str) -> list[str]:
    return [f"## {table.title}", table.markdown(), *after]


def open_note(verdict: dict) -> list[str]:
    """What of the verdict is not that of today's cores; nothing where all of it is."""
    return [f"**Not searched since: {'; '.join(one.removeprefix('verdict: ') for one in verdict['open'])}.** Figures "
            "of what changed are those of before; `make verdict` searches it."] if verdict["open"] else []


def _verdict(report: dict) -> list[str]:
    """The verdict at equal accuracy: tables, picture, scenarios, sentences."""
    found = report["verdict"]
    parts = ["## The verdict at equal accuracy", *open_note(found), VERDICT_NOTE.format(**designs.RULES["price"])]
    for function in KINEMATIC:
        if verdict.plain(found, function):
            table = verdict.target_table(found, function)
            parts += [f"### {table.title}", table.markdown(), listed(
                [judgement.who_wins(found, function, target) for target in verdict.TARGETS], "")]
    parts += ["![Area against latency at equal accuracy](verdict.png)", "### Tasks, codecs included",
              SCENARIO_NOTE.format(target=designs.RULES["scenario"])]
    for way, word in verdict.SCENARIOS:
        table = verdict.scenario_table(found, way, word)
        parts += [f"**{table.title[0].upper()}{table.title[1:]}**",
                  table.markdown() if table.rows else "No core reaches it with what is built."]
    return [*parts, "### What rational trigonometry itself changes", judgement.itself_at(report),
            listed(judgement.itself(report), "")]


def markdown(report: dict) -> str:
    """The whole of report.md."""
    kinematic, others = pick(report, KINEMATIC), primitives(report)
    parts = ["<!-- Generated by `make report` from report.json: do not edit. -->", "# What the cores cost",
             trajectory_note(report)]
    if kinematic:
        parts += [*_titled(glance_table(report), "The columns are explained below."),
                  *_titled(cost_table("Kinematic cores", kinematic), COST_COLUMNS,
                           "![Area against latency](area_latency.png)"),
                  *_titled(accuracy_table("Accuracy at the tip", kinematic), ERROR_COLUMNS, "![Accuracy](accuracy.png)",
                           "Over the workspace of two joints (elbow 0), the same scale everywhere:",
                           "![Tip error over the workspace](tip_error_map.png)", MAP_NOTE)]
    if report.get("verdict"):
        parts += _verdict(report)
    if others:
        parts += _titled(cost_table("Primitives", others))
        table = primitive_table(others)
        if table.rows:
            parts += [f"{table.title}:", table.markdown()]
    parts += chains.section(report) + engines.section(report)
    parts += ["## Beside the paper", PAPER_NOTE]
    for table in paper_tables(report):
        parts += [f"### {table.title}", table.markdown()]
    parts += ["## Rational against iterative CORDIC", listed(pareto(report), "No function has both yet."),
              *smaller(report)]
    parts += ["## Where CORDIC wins", "Best classic core against best rational core, figure by figure:",
              listed(cordic_wins(report), "In none of the figures.")]
    versions = ", ".join(f"{tool} {version}" for tool, version in report["tools"].items())
    parts += ["## Tools", versions]
    return "\n\n".join(parts) + "\n"
