"""The report as a page, as the headline of the README (the one table written into a page of ours), on the terminal."""

from __future__ import annotations

import re
from pathlib import Path

from quadrance.cli.tables import Column, console, grid
from quadrance.iterative import convergence
from rich.table import Table as Grid

from ci.report import comparison, designs
from ci.report.tables import (
    KINEMATIC,
    Table,
    accuracy_table,
    cordic_table,
    cost_tables,
    headline_table,
    leading,
    number,
    pick,
    primitive_table,
    primitives,
    up5k_table,
)

SHOWN = """\
The page shows each core at its first parameter set, and a core with modes at the first set of each mode. `make report`
prints every set, `quadrance cores --all` their costs on ECP5, and `quadrance show CORE-SET` one set on every device;
report.json has all that was measured. A table is of one device."""

COST_COLUMNS = """\
ECP5 (`synth_ecp5`, nextpnr):

- **cycles**: rising edges from the one that accepts a sample to the first with its result valid, measured in simulation
  of the Verilog (*comb.*: a combinational part, without a clock). **II**: cycles between two accepted samples.
- **MHz**: nextpnr's clock for ECP5-25k, speed grade 6, all ports registered: the median of three seeds, or the mean of
  the first two where these agree within 3 % (the median lies between them).
- **ns**: the latency at that clock (of a combinational part: one period).
- **LUT**: four-input tables as nextpnr counts them: two for each carry cell, six for each small memory. **FF**:
  registers. **MULT18X18**: multipliers of 18 x 18 bits; a product of 27 x 27 bits takes four.
- **EBR**: memories of 18 kbit. LUTRAM: small memories of 16 words of 4 bits (`TRELLIS_DPR16X4`), in LUTs.

Cyclone V (`synth_intel_alm`):

- **ALUT**: a proxy for logic elements, every `MISTRAL_ALUT*` cell; registers pack beside them. **FF**: registers.
- **DSP**: blocks, each a product of up to 27 x 27 bits. **M10K**: memories of 10 kbit.
- **ALUT, no DSP**: with multipliers in logic, mapped by a short ABC script, at most 8 % above the default on the
  one-joint cores and 18 % on the smallest primitive.

iCE40 (`synth_ice40`), with multipliers in logic, at `PIPE` = 0:

- **LC**: logic cells with plain `abc -lut 4`, within 20 % of its default, either way; cells that hold a register alone
  come on top. **RAM4K**: memories of 4 kbit.

iCE40 UP5K (`synth_ice40 -dsp`, nextpnr): the cores of the README's headline.

- **MAC16**: multipliers of 16 x 16 bits, of which the chip has eight; products are split. **UP5K MHz**, **UP5K ns**: as
  for ECP5; a dash where the core does not fit."""

ERROR_COLUMNS = """\
Errors are distances at the tip of the arm; one LSB is 2^-F units. Modes and PIPE have the same bits: one row a core.

- **arithmetic**: the greatest error against float64 on the same input words, along the trajectory and over random and
  border inputs. **rms**: the root mean square of that error along the trajectory.
- **words**: the greatest error over the arm's workspace, borders of the words included, of an exact core of the same
  words: what rounding joints, targets and links costs, for inverse cores also the answered joint words.
- **total**: the greatest error of words and arithmetic together over the same samples. Both errors have a direction:
  at the sample where rounding costs an exact core most, the arithmetic error may point the other way, or make the core
  answer the neighbouring word, which is nearer. A total below its words is right."""

MAP_NOTE = """\
The map has one random point in each of its cells. The greatest errors lie on lines as thin as a word, which the table's
samples seek: each panel says the greatest error of both. Bounds are on the cores' pages."""

PAPER_NOTE = """\
The paper counts Cyclone V logic elements (Quartus 16.0) and cycles at 50 MHz. Ours are ALUT/DSP/M10K (in brackets: ALUT
without DSP blocks) and, in Table V, measured cycles with the time at the core's own ECP5 clock. The paper compares area
with the parallel CORDIC alone and latency with the iterative one alone; here both are beside both, at the first sets:
8 spread bits in `paper_*`, 24 in `rational_*`, 16 angle bits in `classic_*`. Each cell is the family's smallest figure,
so the area and the cycles of one column may come from two cores."""

CORDIC_NOTE = "The first figure is that of the best rational core of Q7.8, the second that of the best CORDIC core."

VERDICT_NOTE = """\
Each core has the shortest words whose *total* error at the tip is at most the target. Targets without a unit are in LSB
of Q7.8, whatever the core's own words are. Coordinates have as few bits before the point as the arm's reach needs.
Parameters that a name leaves out are those of the first set, or fixed in `ci/report/verdict.toml`. CORDIC is compared
by its iterative cores. *Blocks counted* takes a MULT18X18 as {dsp} LUTs and an EBR as {mem}: their share of an ECP5
LFE5U-25."""

METRE_NOTE = """\
Links of 500 mm; each core has the shortest words for a total error of 10 and of 2 µm. A core that is absent misses the
target at any length of word that it has."""

ITSELF_NOTE = """\
Both have tables and products, each at the tightest target that both reach (where there is none, at their first sets);
the first figure is the spread's. Forward, the square root of a spread needs four ranges of table where a sine needs
one, and spreads do not add, so two joints take more products than added angles. Inverse, a spread is a quotient of
squared lengths, so no table of an arc is needed. A spread is flat at a quadrant border, where two of its bits are worth
one of an angle."""

SCENARIO_NOTE = """\
Whole tasks at {target}, from or to one kind of joint word: *angle* is an encoder in or a motor out, *vector* a
resolver, *spread* a quotient of squared lengths. Where the core's own words are others, a codec is at every joint, and
*word* is the parameter of the joint word outside. The core has the words that it has at one of the targets above. Areas
are the sum of the parts, cycles one after the other, times at the slowest clock of them; the parts were not synthesised
together. A core that is absent has no codec, or does not reach the target."""

CHAIN_NOTE = f"""\
A chain takes one link after the other, so its area stays and its cycles grow. There is no fixed core of more than three
joints: its area is taken to lie on the straight line through the three (least squares). The last column is the number
of joints from which the chain is no larger; the paper says beyond {comparison.CROSSING}. `paper_mff` takes directions
in the fixed frame, no joint words, and its roots from tables, `paper_fk*` from digits."""

ENGINE_NOTE = f"""\
Iterations are counted in the bit-true models, cycles in the Verilog. The starts are a grid: joints 1 and 2 go all round
in steps of {convergence.STEP}° (twice that where the model is slow), the others are 0. The target is the example of the
engine's paper. Starts that do not converge within {convergence.LIMIT} iterations are left out, and show in the last
column. Cycles include every pass: the iterations, the one that finds the answer, and those that only change the range
of a word. The cores that answer in one pass need no start."""


def trajectory_note(report: dict) -> str:
    """What was run, in one paragraph."""
    arm = report["trajectory"]
    yaw = "" if arm["yaw"] else " The arm has no yaw: three-joint cores see its two links mounted on a turntable."
    links = f"{number(arm['l1_mm'], 5)} and {number(arm['l2_mm'], 5)} mm"
    return (f"Arm `{report['arm']}`, {arm['name']}: links of {links}, "
            f"{number(arm['mm_per_unit'], 5)} mm a unit (1 LSB of Q7.8 is {number(arm['mm_per_unit'] / 256)} mm). "
            f"{arm['samples']} samples of a circle, a line and a pick-and-place within the joint limits, and "
            f"{arm['workspace']} of the whole workspace. One-joint cores move the first link alone.{yaw}")


def _section(title: str, note: str, *tables: Table) -> list[str]:
    """A heading, a note and tables; nothing where no table has a row."""
    tables = tuple(table for table in tables if table.rows)
    captions = len(tables) > 1 or any(table.title != title for table in tables)
    return [f"## {title}", note, *(text for table in tables for text in (
        *([f"**{table.title}**"] if captions else []), table.markdown()))] if tables else []


def open_note(verdict: dict) -> str:
    """What of the verdict is not that of today's cores; nothing where all of it is."""
    return (f"**Not searched since: {'; '.join(one.removeprefix('verdict: ') for one in verdict['open'])}.** Figures "
            "of what changed are those of before; `make verdict` searches it.\n\n") if verdict["open"] else ""


def _verdict(report: dict) -> list[str]:
    """The verdict at equal accuracy: who wins, picture, tables, tasks, and what the spread itself changes."""
    found = report["verdict"]
    return [*_section("The verdict at equal accuracy", open_note(found) + VERDICT_NOTE.format(**designs.RULES["price"]),
                      *(comparison.winners_table(found, device) for device in comparison.WINS),
                      comparison.target_table(found), comparison.missed_table(found),
                      comparison.cyclonev_table(found)),
            "![Area against latency at equal accuracy](verdict.png)",
            *_section("A SCARA of 1 m", METRE_NOTE, comparison.metre_table(found)),
            *_section("Tasks at equal accuracy", SCENARIO_NOTE.format(target=designs.RULES["scenario"]),
                      comparison.scenario_table(found)),
            *_section("What rational trigonometry itself changes", ITSELF_NOTE, comparison.itself_table(report))]


def markdown(report: dict) -> str:
    """The whole of report.md: the first set of each core and mode."""
    kinematic, others = leading(pick(report, KINEMATIC)), leading(primitives(report))
    parts = ["<!-- Generated by `make report` from report.json: do not edit. -->", "# What the cores cost",
             trajectory_note(report), SHOWN]
    if kinematic:
        plain = [row for row in kinematic if not row["params"].get("PIPE")]
        parts += [*_section("Kinematic cores", COST_COLUMNS, *cost_tables("Kinematic cores", kinematic)[:2],
                            cost_tables("Kinematic cores", plain)[2], up5k_table(report)),
                  "![Area against latency](area_latency.png)",
                  *_section("Accuracy at the tip", ERROR_COLUMNS,
                            accuracy_table("Accuracy at the tip", leading(kinematic, ()))),
                  "![Accuracy](accuracy.png)",
                  "Over the workspace of two joints (elbow 0), the same scale everywhere:",
                  "![Tip error over the workspace](tip_error_map.png)", MAP_NOTE]
    if report.get("verdict"):
        parts += _verdict(report)
    parts += _section("Parts and further cores", "The columns are those above; `quadrance show` has iCE40.",
                      *cost_tables("Parts and further cores", others)[:2], primitive_table(leading(others, ())))
    parts += _section("Any number of joints", CHAIN_NOTE, comparison.chain_table(report))
    parts += _section("Engines that iterate, and the closed form", ENGINE_NOTE, comparison.engine_table(report))
    parts += _section("Beside the paper", PAPER_NOTE, *comparison.paper_tables(report))
    parts += _section("Where CORDIC wins", CORDIC_NOTE, cordic_table(report))
    versions = ", ".join(f"{tool} {version}" for tool, version in report["tools"].items())
    return "\n\n".join([*parts, "## Tools", versions]) + "\n"


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
    return f"{head}{OPEN}\n{headline_table(report).markdown(bars=True)}\n{CLOSE}{rest.partition(CLOSE)[2]}"


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
    """The tables of the report, those of cores with every set."""
    out = console()
    kinematic, others = pick(report, KINEMATIC), primitives(report)
    tables = [*cost_tables("Kinematic cores", kinematic), up5k_table(report),
              accuracy_table("Accuracy at the tip", kinematic), *cost_tables("Parts and further cores", others),
              primitive_table(others), comparison.engine_table(report), comparison.chain_table(report),
              *comparison.paper_tables(report), cordic_table(report)]
    if report.get("verdict"):
        tables += [*(comparison.winners_table(report["verdict"], device) for device in comparison.WINS),
                   comparison.itself_table(report)]
    out.print(trajectory_note(report))
    for table in [*tables, headline_table(report)]:
        if table.rows:
            out.print(_grid(table, out.width))
