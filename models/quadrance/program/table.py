"""This module prints an assembled program as a Verilog module: one line of the table a clock, with its equation."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Sequence
from pathlib import Path

from quadrance.program.assembler import FIELDS, NIL, Assembled, assembled, orders
from quadrance.program.language import ONE, Wrong
from quadrance.program.parser import load
from quadrance.program.ranges import proved

WIDTH = 120
_HEAD = """\
// SPDX-License-Identifier: Apache-2.0
// Assembled from {origin}; do not edit.
//   {title}
// Line: word = A * B [+- C * D], DEST, and what else is done with it; one line a clock. I_ begins the name of an input;
// a word of capitals and a small letter is one that the assembler has added.{emitted}
// {of}: {clocks}. Model: quadrance.program.meaning
`default_nettype none
module {name}_program #(
    parameter PIPE = {pipe}  // registers behind the products of product_engine: {pipes}
) (
    input  wire        {gap}clk,
    input  wire        {gap}rst,
    input  wire        {gap}in_start,
    output wire        {gap}out_idle,
    output wire        {gap}out_done,
    output wire [46:0] {gap}out_op{places}
);
    generate
"""

_EMITTED = """
// out_places: the number of each emitted word among the results; the first word of the text has the lowest bits."""
_PLACES = """,
    output wire [{}:0] out_places"""


def _list(names: Iterable[str]) -> str:
    """A localparam of 6-bit numbers."""
    body = textwrap.wrap(", ".join(names), WIDTH - 8, initial_indent=" " * 8, subsequent_indent=" " * 8)
    return "    localparam [5:0]\n" + "\n".join(body).replace("~", " ") + ";"


def _numbers(one: Assembled) -> list[str]:
    """The names of the cells that are used, as localparams."""
    used = {name for _, cells in one.rows for cell in cells for name in cell.split(" | ")}
    lines = []
    for key, bits, names in FIELDS:
        if shown := [f"{name} = {bits}'d{number}" for name, number in names.items() if name in used and (
                one.roots or key not in ("align", "act"))]:
            if key == "b":
                shown.insert(0, f"{NIL} = {bits}'d0")
            width = f"[{bits - 1}:0] " if bits > 1 else ""
            lines += textwrap.wrap(f"localparam {width}{', '.join(shown)};", WIDTH - 4, initial_indent=" " * 4,
                                   subsequent_indent=" " * 8)
    ports = [f"I_{name.upper()}" for name in (*one.program.inputs, ONE)]
    registers = sorted(used & one.numbers.keys() - set(ports) - {NIL}, key=lambda name: (one.numbers[name], name))
    return [*lines, *(_list(f"{name}~=~6'd{one.numbers[name]}" for name in names if name in used)
                      for names in (registers, ports))]


def _row(label: str, cells: Iterable[str], widths: list[int], comment: int) -> str:
    padded = [f"{cell},".ljust(width + 2) for cell, width in zip(cells, widths)]
    body = f"*/ {{{''.join(padded).rstrip().rstrip(',')}}}"
    return f"    /* {label.ljust(min(comment, WIDTH - len(body) - 9))} {body}"


def _branch(one: Assembled) -> str:
    """The table of one PIPE and its player, for the block that bears its name."""
    at = one.rules.timing
    kept = range(11) if one.roots else [i for i, (key, _, _) in enumerate(FIELDS) if key not in ("align", "act")]
    rows = [(label, [cells[i] for i in kept]) for label, cells in one.rows]
    widths = [max(len(cells[i]) for _, cells in rows) for i in range(len(kept))]
    comment = max(len(label) for label, _ in rows)
    bits = sum(FIELDS[i][1] for i in kept)
    table = ",\n".join(_row(label, cells, widths, comment) for label, cells in rows)
    if long := [label for label, row in zip((row[0] for row in rows), table.split("\n")) if len(row) > WIDTH]:
        raise Wrong(f"{one.program.path.name}: the line '{long[0]}' is printed in more than {WIDTH} columns: take "
                    "shorter names")
    drain = ("", ".DRAIN({}), ", ".DRAIN({}), .REGISTER(1), ")[one.pipe].format(at.drain)
    table = "\n".join(_numbers(one)) + f"\n    localparam [{len(rows)}*{bits}-1:0] LINES = {{\n{table}}};\n"
    op = "out_op"
    if not one.roots:  # no ALIGN and no ACT
        op, table = "op", table + f"    wire [{bits - 1}:0] op;\n"
    table += f"    engine_program #(.LINES({len(rows)}), {drain}.BITS({bits}), .TABLE(LINES)) control (\n"
    table += "        .clk(clk), .rst(rst), .in_start(in_start), .out_idle(out_idle), .out_done(out_done), .out_op("
    table += f"{op}));\n"
    if one.program.streamed:  # the first word's lowest
        places = ", ".join(f"6'd{place}" for place in reversed(one.places))
        table += "\n".join(textwrap.wrap(f"assign out_places = {{{places}}};", WIDTH, initial_indent=" " * 4,
                                         subsequent_indent=" " * 8)) + "\n"
    if not one.roots:
        table += f"    assign out_op = {{op[{bits - 1}:6], 2'b00, op[5:0], 9'd0}};\n"
    return f"{_block(one.pipe)}\n{table}"


def _block(pipe: int) -> str:
    """The first line of the block of a PIPE."""
    return f"    if (PIPE == {pipe}) begin : g_pipe{pipe}"


def branch(text: str, pipe: int) -> str:
    """What stands in the block of a PIPE; the whole text where it has no such blocks."""
    parts = text.split(_block(pipe) + "\n")
    return parts[1].split("\n    end\n")[0] + "\n" if len(parts) == 2 else text


def verilog(program: Sequence[Assembled], origin: str = "", of: str = "Latency of a core that plays it") -> str:
    """The module NAME_program of a program that was assembled for one PIPE or more.

    Parameters
    ----------
    origin : what it is made from and how; the text of that name by default.
    of : what the clocks in its header are of.

    Raises
    ------
    Wrong
        Where a line of it would be too long.
    """
    name, pipes = program[0].program.name, [str(one.pipe) for one in program]
    origin = origin or f"{name}.kin by `quadrance assemble`"
    extra = dict.fromkeys(("gap", "emitted", "places"), "")
    if program[0].program.streamed:
        extra = {"gap": " ", "emitted": _EMITTED, "places": _PLACES.format(6 * len(program[0].places) - 1)}
    head = _HEAD.format(**extra, name=name, origin=origin, of=of, title=program[0].program.title[:WIDTH - 7],
                        pipe=pipes[0], pipes=" or ".join(pipes) + f" (default {pipes[0]})" * (len(pipes) > 1),
                        clocks=", ".join(f"{one.clocks} at PIPE {one.pipe}" for one in program))
    wrong = " && ".join(f"PIPE != {pipe}" for pipe in pipes)
    return (head + "".join(f"{_branch(one)}    end\n" for one in program) + f"    if ({wrong}) begin : g_illegal\n"
            f"        {name}_program_needs_PIPE_{'_or_'.join(pipes)} rule ();\n    end\n    endgenerate\n"
            "endmodule\n`default_nettype wire\n")


def table_path(path: Path) -> Path:
    """The file of the module of a program, NAME_program.v."""
    return path.with_name(f"{path.stem}_program.v")


def stale(folder: Path) -> list[str]:
    """A line for each program of a folder whose table is not what its text gives."""
    wrong = []
    for path in sorted(folder.glob("*.kin")):
        try:
            proved(load(path))
            if not (pipes := orders(load(path))):
                wrong.append(f"{path.name}: no order is committed: quadrance assemble {path.name} --write")
            elif not (at := table_path(path)).exists() or at.read_text() != verilog(
                    [assembled(path, pipe) for pipe in pipes]):
                wrong.append(f"{at.name}: stale: quadrance assemble {path.name} --pipe {pipes[0]} --write")
        except Wrong as error:
            wrong.append(str(error))
    return wrong
