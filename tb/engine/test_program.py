"""Any program of equations: its words from the engine's Verilog are those of its model, in every bit."""

from __future__ import annotations

import random
from pathlib import Path

import numpy as np
import pytest
from quadrance.cores import ROOT, RTL, sources_of
from quadrance.program import assembler, meaning, parser, schedule, table
from quadrance.program.language import ONE
from quadrance.program.lines import lines
from quadrance.program.registers import FIRST

from tb.lib import tools
from tb.lib.simulate import available

P = {"W": 16, "F": 8, "U": 16}
EXAMPLE = (ROOT / "docs" / "programs.md").read_text().split("```")[1].lstrip()
TOP = """\
`timescale 1ns/1ps
module top;
    reg          clk = 1'b0, rst = 1'b1, start = 1'b0;
    reg  [2:0]   signs;
    reg  [{count}*27-1:0] words;
    reg  [{count}*27+2:0] samples[0:{samples}-1];
    reg  [26:0]  held[0:63];
    wire [46:0]  op;
    wire [26:0]  port, word;
    wire [5:0]   dest;
    wire [3:0]   status;
    wire         idle, done;
    integer      i, j;
    always #1 clk = !clk;
    {module} control (.clk(clk), .rst(rst), .in_start(start), .out_idle(idle), .out_done(done), .out_op(op));
    engine_ports #(.COUNT({count})) ports (.clk(clk), .in_words(words), .in_select(op[43:39]), .out_word(port));
    product_engine #(.PIPE({pipe}), .ROOTS({roots})) engine (.clk(clk), .rst(rst), .in_start(start),
        .in_run(!idle),
        .in_op(op), .in_port(port), .in_signs(signs), .out_word(word), .out_dest(dest), .out_status(status));
    always @(posedge clk)
        held[dest] <= word;
    initial begin
        $readmemh("samples.hex", samples);
        repeat (2) @(negedge clk);
        rst = 1'b0;
        for (i = 0; i < {samples}; i = i + 1) begin
            {{signs, words}} = samples[i];
            start = 1'b1;
            @(negedge clk) start = 1'b0;
            while (!done)
                @(negedge clk);
            @(negedge clk);
            for (j = {first}; j < {last}; j = j + 1)
                $write("%h ", held[j]);
            $display("%b", status);
        end
        $finish;
    end
endmodule
"""


def played(program, inputs, branch, folder, pipe):
    """Result words and status of an assembled program, by the engine in Icarus."""
    found = schedule.rules(program, lines(program), schedule.timing(pipe))
    one = assembler.assemble(program, pipe, order=schedule.listed(program, found, len(lines(program)), 3))
    assert assembler.problems(one) == []
    count, samples = len(program.inputs) + 1, len(branch)
    module = table.table_path(program.path).stem
    (folder / f"{module}.v").write_text(table.verilog([one]))
    (folder / "top.v").write_text(TOP.format(count=count, samples=samples, module=module, pipe=pipe,
                                             roots=int(one.roots), first=FIRST, last=FIRST + len(program.results)))
    columns = [np.broadcast_to(inputs[name], samples) for name in program.inputs] + [np.full(samples, 1 << 25)]
    rows = []
    for i, sign in enumerate(branch):
        row = int(sign)
        for column in columns[::-1]:
            row = row << 27 | int(column[i]) & (1 << 27) - 1
        rows.append(f"{row:x}")
    (folder / "samples.hex").write_text("\n".join(rows))
    sources = {*sources_of("product_engine"), *sources_of("engine_ports"), *sources_of("engine_program")}
    tools.run("iverilog", "-g2005", "-s", "top", "-o", folder / "top.vvp", folder / "top.v",
              folder / f"{module}.v", *sorted(sources))
    out = tools.run("vvp", "top.vvp", cwd=folder)
    rows = [row.split() for row in out.split("\n") if row.count(" ")]
    words = np.array([[int(word, 16) for word in row[:-1]] for row in rows])
    return (words ^ 1 << 26) - (1 << 26), np.array([int(row[-1], 2) for row in rows])


def written(seed):
    """A text of random sums, directions and a root: inputs, later words, one; words wrap as they like."""
    chance = random.Random(seed)
    ports = [f"p{i}" for i in range(chance.randint(3, 9))]
    words, text = [*ports, ONE], [f"in word {' '.join(ports)}", "sign back down flip"]
    held = chance.sample((0, 1, 3), chance.randint(0, 3))  # directions whose results have flags of their own

    def sum_of(terms, squares=False):
        parts = []
        for _ in range(terms):
            a, b = (chance.choice(words) for _ in range(2))
            parts.append(f"{chance.choice('+-')} {a}" + f"*{a if squares else b}" * (chance.random() < 0.8 or squares))
        return " ".join(parts).removeprefix("+ ").replace("- ", "-", 1) if parts[0][0] == "-" else " ".join(parts)[2:]

    results = []
    for i in range(chance.randint(4, 10)):
        text.append(f"s{i} = {sum_of(chance.randint(1, 6))}")
        words.append(f"s{i}")
    text += ["reach q = p0*p0 - p1*p1", f"y = root q {chance.choice(('+', 'back', 'down'))}"]
    words.append("y")
    for i in range(4):
        kind = " hold" * (i in held)
        wrist = " wrist" * chance.randint(0, 1)
        sign = chance.choice(("", " flip", " down"))
        text.append(f"c{i}, n{i} = unit ({sum_of(chance.randint(1, 3))}, {sum_of(2)}){sign}{wrist}{kind}")
        results += [f"c{i}", f"n{i}"]
        words += results[-2:]
        text.append(f"t{i} = {sum_of(chance.randint(1, 5))}")
        words.append(f"t{i}")
    text += [f"check {sum_of(chance.randint(1, 4))}" for _ in range(chance.randint(0, 3))]
    alone = [word for word in (*ports, *(w for w in words if w not in results)) if word != ONE]
    for i in range(0, len(alone), 12):
        text.append(f"all{i} = {' + '.join(alone[i:i + 12])}")
        results.append(f"all{i}")
    text.append(f"out word {' '.join(results)}")
    return "\n".join(text)


def agree(program, inputs, branch, folder, pipe):
    words, status = played(program, inputs, branch, folder, pipe)
    outcome = meaning.walked(program, meaning.Fixed(12, 13), inputs, {
        name: branch >> i & 1 for i, name in enumerate(program.signs)})
    for at, port in enumerate(program.results):
        wrong = np.flatnonzero(words[:, at] != outcome.words[port.name])
        assert not len(wrong), f"{port.name}: {len(wrong)} samples, the first {wrong[0]}"
    assert np.array_equal(status, np.broadcast_to(outcome.status, status.shape))
    return outcome


@pytest.mark.skipif(not available("icarus"), reason="Icarus Verilog is not installed")
@pytest.mark.parametrize("pipe", range(3))
@pytest.mark.parametrize("seed", [*range(3), *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(3, 8))])
def test_random_programs(seed, pipe, tmp_path):
    program = parser.parse(written(seed), Path("random.kin"))
    rng, n = np.random.default_rng(seed), 60
    inputs = {name: rng.integers(-1 << 25, 1 << 25, n) >> rng.integers(0, 26, n) for name in program.inputs}
    inputs["p0"][::9] = inputs["p1"][::9] = 0
    agree(program, inputs, rng.integers(0, 8, n), tmp_path, pipe)


@pytest.mark.skipif(not available("icarus"), reason="Icarus Verilog is not installed")
@pytest.mark.parametrize("pipe", range(3))
def test_the_example_of_the_page(pipe, tmp_path):
    program, rng = parser.parse(EXAMPLE, Path("example.kin")), np.random.default_rng(1)
    inputs = {name: rng.integers(-1 << 24, 1 << 24, 100) for name in program.inputs}
    for name in program.inputs:  # the point is where the axis is
        inputs[name][::7] = 0
    outcome = agree(program, inputs, np.zeros(100, int), tmp_path, pipe)
    assert outcome.none["c"].sum() == 15 and RTL.exists()
