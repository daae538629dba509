"""Two cores in series on one reset, as one core: the bench of every core then tests the pair.

What one core hands to the next is nobody's choice: it comes when the first has it, and waits while the second is busy.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np
from quadrance.cores import Core, Port, all_cores

from tb.lib import tools
from tb.lib.program import locked

WRAPPERS = tools.BUILD / "chain"


@dataclass(frozen=True)
class Chain(Core):
    """`first` feeds `second`, output ports to the input ports of their names; an input that nothing feeds is 0.

    Configuration ports of one name are one port. The stimuli are in tb/stimulus/pair.py.
    """

    first: Core | None = None
    second: Core | None = None

    @property
    def model(self) -> Callable[..., dict]:
        """The second model of the first one's answers."""
        def both(params: dict[str, int], **words: np.ndarray) -> dict:
            def ask(core: Core, known: dict[str, np.ndarray]) -> dict:
                ports = [port.name for port in (*core.cfg, *core.inputs)]
                return core.model(core.params, **{name: known.get(name, 0) for name in ports})

            between = {name.replace("out_", "in_", 1): word for name, word in ask(self.first, words).items()}
            return ask(self.second, {name: word for name, word in words.items() if name.startswith("cfg_")} | between)
        return both

    __hash__ = Core.__hash__


def _range(port: Port) -> str:
    return f"{'signed ' if port.signed else ''}[{port.width - 1}:0] {port.name}"


def _instance(core: Core, name: str, wires: dict[str, str]) -> str:
    parameters = ", ".join(f".{key}({value})" for key, value in core.params.items())
    ports = ", ".join(f".{port}({wire})" for port, wire in wires.items())
    return f"    {core.name} #({parameters}) {name} ({ports});\n"


def _verilog(name: str, first: Core, second: Core, cfg: tuple[Port, ...]) -> str:
    """The wrapper. Its parameters are those of the first core, for the stimulus: their values are fixed."""
    ports = ["input wire clk", "input wire rst", *(f"input wire {_range(port)}" for port in cfg), "input wire in_valid",
             "output wire in_ready", *(f"input wire {_range(port)}" for port in first.inputs), "output wire out_valid",
             "input wire out_ready", *(f"output wire {_range(port)}" for port in second.outputs)]
    common = {"clk": "clk", "rst": "rst"}
    own = [{port.name: port.name for port in core.cfg} for core in (first, second)]
    links = {port.name: f"between_{port.name}" for port in first.outputs}
    wires = "".join(f"    wire [{port.width - 1}:0] between_{port.name};\n" for port in first.outputs)
    feed = {port.name: links.get(port.name.replace("in_", "out_", 1), f"{port.width}'d0") for port in second.inputs}
    one = common | own[0] | {port.name: port.name for port in first.inputs} | links | {
        "in_valid": "in_valid", "in_ready": "in_ready", "out_valid": "between", "out_ready": "ready"}
    two = common | own[1] | feed | {port.name: port.name for port in second.outputs} | {
        "in_valid": "between", "in_ready": "ready", "out_valid": "out_valid", "out_ready": "out_ready"}
    parameters = ", ".join(f"parameter {key} = {value}" for key, value in first.params.items())
    return (f"`default_nettype none\nmodule {name} #({parameters}) (\n    " + ",\n    ".join(ports) + "\n);\n"
            + "    wire between, ready;\n" + wires + _instance(first, "one", one) + _instance(second, "two", two)
            + "endmodule\n`default_nettype wire\n")


def chain(first: Core, second: Core) -> Chain:
    """`first` into `second`; their wrapper is written below build/."""
    names = {port.name: port for port in (*first.cfg, *second.cfg)}
    for port in (*first.cfg, *second.cfg):
        assert names[port.name] == port, f"{first.id} and {second.id} differ in {port.name}"
    widths = {port.name.replace("out_", "in_", 1): port.width for port in first.outputs}
    for port in second.inputs:
        assert widths.get(port.name, port.width) == port.width, f"{first.id} and {second.id} differ in {port.name}"
    name, cfg = f"{first.name}_to_{second.name}", tuple(names.values())
    text = _verilog(name, first, second, cfg)
    with locked(WRAPPERS / f"{first.id}-{second.id}") as folder:
        wrapper: Path = folder / f"{name}.v"
        if not wrapper.exists() or wrapper.read_text() != text:
            wrapper.write_text(text)
    values = {part.name: getattr(first, part.name) for part in fields(Core)} | {
        "name": name, "family": "pair", "set_id": f"{first.set_id}-{second.set_id}", "latency": None,
        "ii": max(first.ii or 1, second.ii or 1), "cfg": cfg, "outputs": second.outputs, "architecture": "chain",
        "status": tuple(bit for bit in second.status if bit != "singular"),  # no corner of a forward core need be at 0
        "sources": tuple(dict.fromkeys((wrapper, *first.sources, *second.sources)))}
    return Chain(**values, first=first, second=second)


def pairs() -> list[tuple[Core, Core]]:
    """Every core that solves with every one that moves, and the other way round: a family's, of the same words."""
    cores = [core for core in all_cores() if core.function in ("ik1", "ik2", "ik3", "fk1", "fk2", "fk3")]
    return [(first, second) for first in cores for second in cores
            if first.family == second.family and first.function[-1] == second.function[-1]
            and first.function[0] != second.function[0] and _same_words(first, second)]


def _same_words(first: Core, second: Core) -> bool:
    """Of the same word lengths and of the same MODE."""
    shared = set(first.params) & set(second.params)
    return all(first.params[key] == second.params[key] for key in shared - {"R"})
