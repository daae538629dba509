"""The report as a page, as the headline of the README (the one table written into a page of ours), on the terminal."""

from __future__ import annotations

import re
from pathlib import Path

from quadrance.cli.tables import Column, console, grid
from rich.table import Table as Grid

from ci.report import comparison, designs
from ci.report.tables import (
    KINEMATIC,
    Table,
    accuracy_table,
    cordic_table,
    cost_tables,
    glance_table,
    headline_table,
    number,
    pick,
    primitive_table,
    primitives,
)

COST_COLUMNS = """\
Every table is of one device: blocks of one and the time of another do not belong together.

ECP5 (`synth_ecp5`, nextpnr):

- **cycles**: rising edges from the one that accepts a sample to the first with its result valid, measured in simulation
  of the Verilog (*comb.*: a combinational part, without a clock).
- **II**: cycles between two accepted samples, measured in the same run.
- **MHz**: nextpnr's clock for ECP5-25k, speed grade 6, all ports registered: the median of three seeds, or the mean of
  the first two where these agree within 3 % (that median lies between them).
- **ns**: the latency at that clock (of a combinational part: one period).
- **LUT**: four-input tables as nextpnr counts them: two for each carry cell, six for each small memory.
- **FF**: registers. **MULT18X18**: multipliers of 18 x 18 bits; a product of 27 x 27 bits takes four.
- **EBR**: memory blocks of 18 kbit. **LUTRAM**: small memories of 16 words of 4 bits (`TRELLIS_DPR16X4`), in LUTs.

Cyclone V (`synth_intel_alm`):

- **ALUT**: a proxy for logic elements, every `MISTRAL_ALUT*` cell; registers pack beside them.
- **FF**: registers. **DSP**: blocks, each a product of up to 27 x 27 bits. **M10K**: memory blocks of 10 kbit.
- **ALUT, no DSP**: the same with multipliers in logic, mapped by a short ABC script (the default one takes minutes on
  larger cores), at most 8 % above the default on the one-joint cores and 18 % on the smallest primitive.

iCE40 (`synth_ice40`):

- **LC**: logic cells with plain `abc -lut 4`, within 20 % of its default, either way. **FF**: registers.
- **RAM4K**: memory blocks of 4 kbit."""

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
and M10K blocks beside it (in brackets: without DSP blocks) and, in Table V, measured cycles with the time at the core's
own ECP5 clock. The paper compares area with the parallel CORDIC alone and latency with the iterative one alone; here
both are beside both. Every core has its first parameter set (Q7.8; `paper_*` at the paper's 8 spread bits, `rational_*`
at 24 spread bits, `classic_*` at 16 angle bits). Each cell is the family's smallest figure, so the area and the cycles
of one column may come from two cores."""

CORDIC_NOTE = "The first figure is that of the best rational core of Q7.8, the second that of the best CORDIC core."

VERDICT_NOTE = """\
Each core has the shortest words whose *total* error at the tip (words and arithmetic, the greatest over the arm's
workspace, borders of the words included) is at most the target; LSB are those of Q7.8, whatever the core's own words
are. Coordinates have as few bits before the point as the arm's reach needs. Of CORDIC the iterative cores are compared;
the parallel ones are in the tables above.

- **words**: the parameters with the fewest bits in all, of as many bits the sharpest; other parameters are those of the
  core's first set.
- **total LSB**: the error that is reached.
- **LUT**, **MULT18X18**, **EBR**, **cycles**, **ns**: as above. *Blocks counted as LUTs* takes a MULT18X18 as {dsp}
  LUTs and an EBR as {mem}: their share of an ECP5 LFE5U-25."""

ITSELF_NOTE = """\
Both have tables and products, each at the tightest target that both reach (where there is none, at their first sets);
the first figure is the spread's. Forward, the square root of a spread needs four ranges of table where a sine needs
one, and spreads do not add, so two joints take more products than added angles. Inverse, a spread is a quotient of
squared lengths, so no table of an arc is needed. A spread is flat at a quadrant border, where two of its bits are worth
one of an angle."""

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


def _titled(table: Table, *after: str) -> list[str]:
    return [f"## {table.title}", table.markdown(), *after]


def _costs(title: str, rows: list) -> list[str]:
    """The tables of every device below one heading."""
    return [f"## {title}", *(text for table in cost_tables(title, rows)
                             for text in (f"**{table.title}**", table.markdown()))]


def open_note(verdict: dict) -> list[str]:
    """What of the verdict is not that of today's cores; nothing where all of it is."""
    return [f"**Not searched since: {'; '.join(one.removeprefix('verdict: ') for one in verdict['open'])}.** Figures "
            "of what changed are those of before; `make verdict` searches it."] if verdict["open"] else []


def _verdict(report: dict) -> list[str]:
    """The verdict at equal accuracy: who wins, picture, tables, tasks, and what the spread itself changes."""
    found = report["verdict"]
    parts = ["## The verdict at equal accuracy", *open_note(found), VERDICT_NOTE.format(**designs.RULES["price"])]
    for device in comparison.WINS:
        table = comparison.winners_table(found, device)
        parts += [f"### {table.title}", table.markdown()]
    parts += ["![Area against latency at equal accuracy](verdict.png)"]
    for function in KINEMATIC:
        if comparison.plain(found, function):
            table = comparison.target_table(found, function)
            parts += [f"### {table.title}, on ECP5", table.markdown()]
    table = comparison.cyclonev_table(found)
    parts += [f"### {table.title}", table.markdown(), "### Tasks on ECP5, codecs included",
              SCENARIO_NOTE.format(target=designs.RULES["scenario"])]
    for way, word in comparison.SCENARIOS:
        table = comparison.scenario_table(found, way, word)
        parts += [f"**{table.title[0].upper()}{table.title[1:]}**",
                  table.markdown() if table.rows else "No core reaches it with what is built."]
    table = comparison.itself_table(report)
    return [*parts, "### What rational trigonometry itself changes", ITSELF_NOTE, f"**{table.title}**",
            table.markdown() if table.rows else "No function has both yet."]


def markdown(report: dict) -> str:
    """The whole of report.md."""
    kinematic, others = pick(report, KINEMATIC), primitives(report)
    parts = ["<!-- Generated by `make report` from report.json: do not edit. -->", "# What the cores cost",
             trajectory_note(report)]
    if kinematic:
        parts += [*_titled(glance_table(report), "The columns are explained below."),
                  *_costs("Kinematic cores", kinematic), COST_COLUMNS, "![Area against latency](area_latency.png)",
                  *_titled(accuracy_table("Accuracy at the tip", kinematic), ERROR_COLUMNS, "![Accuracy](accuracy.png)",
                           "Over the workspace of two joints (elbow 0), the same scale everywhere:",
                           "![Tip error over the workspace](tip_error_map.png)", MAP_NOTE)]
    if report.get("verdict"):
        parts += _verdict(report)
    if others:
        parts += _costs("Primitives", others)
        table = primitive_table(others)
        if table.rows:
            parts += [f"{table.title}:", table.markdown()]
    parts += comparison.chain_section(report) + comparison.engine_section(report)
    parts += ["## Beside the paper", PAPER_NOTE]
    for table in comparison.paper_tables(report):
        parts += [f"### {table.title}", table.markdown()]
    if (table := cordic_table(report)).rows:
        parts += ["## Where CORDIC wins", CORDIC_NOTE, table.markdown()]
    versions = ", ".join(f"{tool} {version}" for tool, version in report["tools"].items())
    parts += ["## Tools", versions]
    return "\n\n".join(parts) + "\n"


# The headline of the README

OPEN, CLOSE = "<!-- report:headline -->", "<!-- /report:headline -->"
MARK = re.compile(r"<!-- */?report\b[^>]*-->")


def readme(text: str, report: dict) -> str:
    """`text` with the headline of `report`.

    Raises
    ------
    ValueError
        Where the README has not the two marks and no other.
    """
    if problem := _wrong(text):
        raise ValueError(problem)
    head, _, rest = text.partition(f"{OPEN}\n")
    return f"{head}{OPEN}\n{headline_table(report).markdown()}\n{CLOSE}{rest.partition(CLOSE)[2]}"


def _wrong(text: str) -> str:
    marks = MARK.findall(text)
    return "" if marks == [OPEN, CLOSE] else f"README.md: marks are {marks}; {OPEN} and {CLOSE} are wanted, once"


def wrong_marks(readme_file: Path) -> list[str]:
    """Marks that no report could fill."""
    return [problem] if readme_file.exists() and (problem := _wrong(readme_file.read_text())) else []


def stale_headline(report: dict, readme_file: Path) -> list[str]:
    """Why the README does not show the headline of the report."""
    try:
        text = readme_file.read_text()
        return [] if text == readme(text, report) else ["README.md: its headline is not what report.json generates"]
    except FileNotFoundError:
        return ["README.md is missing"]
    except ValueError as error:
        return [str(error)]


def write_headline(report: dict, readme_file: Path) -> None:
    """Fill the headline of the README, where there is one."""
    if readme_file.exists():
        readme_file.write_text(readme(readme_file.read_text(), report))


# On the terminal


def _grid(table: Table, width: int) -> Grid:
    """The table in that width: columns further to the right go first, but for the text at the left."""
    columns = [Column(head.replace("`", ""), i < table.text, 0 if i == 0 else i) for i, head in enumerate(table.head)]
    rows = [[cell.replace("`", "") for cell in line] for line in table.rows]
    return grid(columns, rows, width, table.title)


def show(report: dict) -> None:
    """The tables of the report."""
    out = console()
    kinematic, others = pick(report, KINEMATIC), primitives(report)
    tables = [*cost_tables("Kinematic cores", kinematic), accuracy_table("Accuracy at the tip", kinematic),
              *cost_tables("Primitives", others), primitive_table(others), comparison.engine_table(report),
              *comparison.paper_tables(report), cordic_table(report)]
    if report.get("verdict"):
        tables += [*(comparison.winners_table(report["verdict"], device) for device in comparison.WINS),
                   comparison.itself_table(report)]
    out.print(trajectory_note(report))
    for table in [*tables, headline_table(report)]:
        if table.rows:
            out.print(_grid(table, out.width))
