"""The contract of every core as a waveform, and a block diagram a family, as SVG beside their pages.

The waveform is what Icarus simulates of a core; the boxes of a diagram name modules, which a test finds in the core.
"""

from __future__ import annotations

import subprocess
import tempfile
from dataclasses import dataclass
from html import escape
from pathlib import Path

from quadrance import cores
from quadrance.cores import RTL

from tb.lib import tools

CONTRACT = RTL / "contract.svg"
CORE, CLOCKS = "vector_fk2", 18
BENCH = """
module bench;
    reg clk = 0, rst = 1, in_valid = 0, out_ready = 1;
    reg signed [17:0] c1 = 0, n1 = 0, c2 = 0, n2 = 0;
    wire in_ready, out_valid;
    wire signed [15:0] x, y;
    wire [3:0] status;
    integer clock = 0;
    {core} dut (.clk(clk), .rst(rst), .cfg_l1(16'd8320), .cfg_l2(16'd7040), .in_valid(in_valid), .in_ready(in_ready),
        .in_c1(c1), .in_n1(n1), .in_c2(c2), .in_n2(n2), .out_valid(out_valid), .out_ready(out_ready), .out_x(x),
        .out_y(y), .out_status(status));
    always begin
        #4 $display("%b %b %b %b %b %0d", rst, in_valid, in_ready, out_valid, out_ready, x);
        #1 clk = 1;
        #1 if (rst === 0 && in_valid && ready) in_valid = 0;
        clock = clock + 1;
        rst = clock < 2;
        if (clock == 3) begin in_valid = 1; c1 = 65536; c2 = 65536; end
        if (clock == 5) begin in_valid = 1; c1 = 0; n1 = 65536; end
        out_ready = clock > 10;
        #4 clk = 0;
        if (clock == {clocks}) $finish;
    end
    reg ready;
    always @(posedge clk) ready <= in_ready;
endmodule
"""
STEP, ROW, LEFT = 40, 34, 96
STYLE = ("<style>text{font:13px sans-serif}.m{font-family:monospace}.l{stroke:#222;fill:none;stroke-width:1.4}"
         ".d{fill:#dbe7f5}.g{stroke:#bbb;stroke-dasharray:3 3}.t{stroke:#c33;stroke-width:1.4}.n{fill:#c33}</style>"
         '<defs><marker id="a" markerWidth="8" markerHeight="8" refX="7" refY="4" orient="auto">'
         '<path d="M0 1 7 4 0 7z"/></marker></defs>')


def svg(width: int, height: int, parts: list[str]) -> str:
    """A picture on white, so that it can be read on a dark page too."""
    return "\n".join([f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}">', STYLE,
                      f'<rect width="{width}" height="{height}" fill="white"/>', *parts, "</svg>", ""])


def simulated() -> list[tuple[list[int | None], int]]:
    """(rst, in_valid, in_ready, out_valid, out_ready; None: X) and out_x before every rising edge of `CORE`."""
    with tempfile.TemporaryDirectory() as folder:
        bench = Path(folder) / "bench.v"
        bench.write_text(BENCH.format(core=CORE, clocks=CLOCKS))
        program = bench.with_suffix(".vvp")
        subprocess.run(["iverilog", "-g2005", "-o", program, bench, *cores.sources_of(CORE)], check=True,
                       env=tools.environment())
        said = subprocess.run(["vvp", "-n", program], check=True, capture_output=True, text=True).stdout
    rows = [line.split() for line in said.splitlines() if line[:1] in "01"]
    return [([int(bit) if bit in "01" else None for bit in row[:5]], row[5]) for row in rows]


def contract() -> str:
    """Two samples: the first result waits for out_ready, the second sample for in_ready."""
    rows = simulated()
    names = ["clk", "rst", "in_valid", "in_ready", "in_*", "out_valid", "out_ready", "out_*"]
    lane = {name: 30 + ROW * i for i, name in enumerate(names)}
    parts = [f'<text class="m" x="8" y="{y + 16}">{name}</text>' for name, y in lane.items()]

    def edge(clock: int) -> int:  # the rising edge that ends a clock
        return LEFT + STEP * (clock + 1)

    clk = f"v-20h{STEP // 2}v20h{STEP // 2}" * len(rows)
    parts.append(f'<path class="l" d="M{LEFT} {lane["clk"] + 20}{clk}"/>')
    for i, name in enumerate(("rst", "in_valid", "in_ready", "out_valid", "out_ready")):
        levels = [bits[i] for bits, _ in rows]
        path = "".join(f"{'M' if k == 0 else 'L'}{LEFT + STEP * k + 3 * (k > 0)} {lane[name] + (0 if level else 20)}"
                       f"H{LEFT + STEP * (k + 1)}" for k, level in enumerate(levels) if level is not None)
        parts.append(f'<path class="l" d="M{path[1:]}"/>')
    takes = [k for k, (bits, _) in enumerate(rows) if bits[:3] == [0, 1, 1]]
    gives = [k for k, (bits, _) in enumerate(rows) if bits[3] == bits[4] == 1]
    for lane_name, valid, ends, letters in (("in_*", 1, takes, "ab"), ("out_*", 3, gives, "AB")):
        start = None
        for k, (bits, _) in enumerate(rows):
            start = k if bits[valid] and start is None else start
            if start is not None and k in ends:
                x, y, wide = LEFT + STEP * start, lane[lane_name], STEP * (k + 1 - start)
                parts += [f'<path class="l d" d="M{x} {y + 10}l4 -10h{wide - 8}l4 10l-4 10h-{wide - 8}z"/>',
                          f'<text class="m" x="{x + wide / 2 - 4}" y="{y + 15}">{letters[ends.index(k)]}</text>']
                start = None
    bottom = lane["out_*"] + 30
    for ends, first, text, y in ((takes, "in_valid", "accepted", lane["rst"] + 14),
                                 (gives, "out_valid", "taken", bottom + 4)):
        for k in ends:
            parts += [f'<path class="t" d="M{edge(k)} {lane[first] - 6}V{lane[first] + 3 * ROW - 8}"/>',
                      f'<text class="n" x="{edge(k) - 27}" y="{y}">{text}</text>']
    shown = next(k for k, (bits, _) in enumerate(rows) if bits[3])
    y = bottom + 22
    parts += [f'<path class="g" d="M{edge(k)} {lane["clk"] - 8}V{y}"/>' for k in (takes[0], shown)]
    parts += [f'<path class="l" marker-end="url(#a)" d="M{edge(takes[0])} {y}H{edge(shown)}"/>',
              f'<text x="{edge(takes[0])}" y="{y + 18}">latency: {shown - takes[0]} edges to the first with out_valid '
              "high; A and out_valid hold until out_ready</text>"]
    return svg(LEFT + STEP * len(rows) + 12, y + 30, parts)


@dataclass(frozen=True)
class Diagram:
    """Rows from left to right: the core, its input, (module or "", text) of each box, its output."""

    page: str
    rows: tuple[tuple[str, str, tuple[tuple[str, str], ...], str], ...]


DIAGRAMS = (
    Diagram("vector", (
        ("vector_fk2", "c1 n1 c2 n2", (("kernel_vector_chain", "products, sums, rounding"),), "x y"),
        ("vector_ik2", "x y elbow", (("kernel_vector_solve", "products; tables of 1/q and √v"),
                                     ("unit_vectors", "words, held where undefined")), "c1 n1 c2 n2"))),
    Diagram("table", (
        ("table_fk2", "j1 j2", (("", "j1, j1 + j2"), ("angle_chord", "table of the sine"),
                                ("kernel_links", "products, sums, rounding")), "x y"),
        ("table_ik2", "x y elbow", (("kernel_vector_solve", "products; tables of 1/q and √v"),
                                    ("angle_of_vector", "table of the arc sine")), "j1 j2"))),
    Diagram("classic", (
        ("classic_fk2", "j1 j2", (("classic_chain_iter", "a link a rotation, by CORDIC"),
                                  ("round_saturate", "rounding")), "x y"),
        ("classic_ik2", "x y elbow", (("classic_legs", "two square roots"),
                                      ("classic_aim_iter", "three vectorings by CORDIC")), "j1 j2"))),
    Diagram("rational", (
        ("rational_fk2", "j1 j2", (("spread_chords", "table of the square root"),
                                   ("kernel_chain", "products, sums, rounding")), "x y"),
        ("rational_ik2", "x y elbow", (("kernel_solve", "products; tables of 1/q and √v"),
                                       ("spread_about_axis", "squares as turn-spreads")), "j1 j2"))),
    Diagram("paper", (
        ("paper_fk2", "j1 j2", (("paper_quadrant", "quadrant of a sum"), ("paper_root", "square roots"),
                                ("paper_quotient", "spreads, by division")), "x y"),
        ("paper_ik2", "x y elbow", (("paper_root", "square roots"), ("paper_quotient", "spreads, by division"),
                                    ("spread_word", "turn-spreads, by quadrant")), "j1 j2"))),
    Diagram("arm", (
        ("arm_fk3", "c1 n1 … n3", (("arm_chain", "products, sums, offsets"),), "x y z"),
        ("arm_ik3", "tip, branch", (("arm_operands", "offsets, multiplexers"),
                                      ("arm_solve", "products; tables of 1/q and √v"),
                                      ("arm_vectors", "words, held where undefined")), "c1 n1 … n3"),
        ("arm_rates2", "joints, ẋ ẏ", (("arm_inverse", "products of vectors and ẋ, ẏ"),
                                        ("arm_quotient", "division, rounding, saturation")), "rates"),
        ("arm_keep3", "x y z", (("arm_branch", "as arm_ik3, branch by branch"),
                                ("arm_choose", "limits, nearest to the last")), "c1 n1 … n3"))),
    Diagram("engine", (
        ("engine_quaternion_gd", "x y, start", (("angle_chord", "table of the sine"),
                                                 ("engine_gd_path", "tip, gradient, step"),
                                                 ("engine_gd_judge", "again, until near enough")), "j1 j2"),
        ("engine_newton_3r", "x y φ, start", (("angle_chord", "table of the sine"),
                                               ("engine_newton_path", "residual, Jacobian, step"),
                                               ("reciprocal_pair", "1 / determinant, again")), "j1 j2 j3"),
        ("engine_rus_ik", "pose", (("engine_rus_poses", "poses, geometry, order of legs"),
                                   ("engine_rus_path", "a leg after another: products"),
                                   ("engine_rus_root", "roots and divisors, by tables")), "six legs"),
        ("engine_rus_fk", "six legs", (("engine_rus_fk_steps", "selects the next line"),
                                       ("engine_rus_fk_program", "Newton's steps, line by line"),
                                       ("engine_rus_fk_products", "registers, two products a clock")), "pose"),
        ("engine_delta_fk", "three legs", (("engine_delta_program", "a table of lines"),
                                           ("engine_program", "plays it, a line a clock"),
                                           ("product_engine", "64 words, two products a clock")), "x y z"))),
    Diagram("program", tuple((core, before, (
        (program, "assembled from equations"), ("engine_program", "plays it, a line a clock"),
        ("product_engine", "64 words, two products a clock"), last), after)
        for core, before, program, last, after in (
            ("vector_ik6", "pose", "vector_ik6_program", ("engine_results", "words and status"), "six joints"),
            ("table_ur_ik", "pose", "vector_ur_ik_program", ("engine_angles", "vectors to angles, status"),
             "six joints"),
            ("vector_srs_ik", "pose, psi", "vector_srs_ik_program", ("engine_results", "words and status"),
             "seven joints"),
            ("six_keep", "pose", "vector_ik6_all_program", ("six_choose", "limits, nearest to the last"), "turns"),
            ("vector_xyzac", "tip, A, C", "vector_xyzac_program", ("engine_saturated", "rounding, saturation"),
             "x y z")))),
)


def diagram(shown: Diagram) -> str:
    """The rows of a family, one below the other."""
    widest = max(len(boxes) for _, _, boxes, _ in shown.rows)
    box, gap, side = 224, 30, 100
    parts = []
    for i, (core, before, boxes, after) in enumerate(shown.rows):
        y = 34 + 110 * i
        parts.append(f'<text class="m" x="8" y="{y - 12}" font-weight="bold">{core}</text>')
        parts.append(f'<text class="m" x="8" y="{y + 31}">{escape(before)}</text>')
        for k, (module, text) in enumerate(boxes):
            x = side + gap + k * (box + gap)
            parts += [f'<path class="l" marker-end="url(#a)" d="M{x - gap + 2} {y + 26}H{x}"/>',
                      f'<rect class="l d" x="{x}" y="{y}" width="{box}" height="52" rx="4"/>',
                      f'<text class="m" x="{x + 8}" y="{y + 21}">{module}</text>' if module else "",
                      f'<text x="{x + 8}" y="{y + (41 if module else 31)}">{escape(text)}</text>']
        x = side + len(boxes) * (box + gap)
        parts += [f'<path class="l" marker-end="url(#a)" d="M{x + 2} {y + 26}H{x + gap}"/>',
                  f'<text class="m" x="{x + gap + 6}" y="{y + 31}">{escape(after)}</text>']
    return svg(side + widest * (box + gap) + gap + 110, 110 * len(shown.rows), [part for part in parts if part])


def pictures() -> dict[Path, str]:
    """Every picture of this module, by its file."""
    return {CONTRACT: contract()} | {RTL / one.page / "blocks.svg": diagram(one) for one in DIAGRAMS}


def main() -> None:
    """Write them."""
    for path, text in pictures().items():
        path.write_text(text, encoding="utf-8")
