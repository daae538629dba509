"""The rule about its parameters that each module has in its Verilog: the condition of `g_illegal`."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from types import CodeType

from quadrance.cores import Core

Params = dict[str, int]


def _python(text: str) -> str:
    """A Verilog constant expression of `+ - * /`, comparisons, `?:` and `$clog2` in Python."""
    choice = re.fullmatch(r"([^?]*)\?([^?:]*):(.*)", text, re.S)
    if choice:
        return f"({_python(choice[2])} if {choice[1]} else {_python(choice[3])})"
    return re.sub(r"\$clog2\b", "clog2", text.replace("/", "//")).strip()


@dataclass(frozen=True)
class Rule:
    """What makes parameters illegal: clauses, and the constants of the module that they are written in; in Python."""

    constants: tuple[tuple[str, CodeType], ...]
    clauses: tuple[tuple[str, CodeType], ...]
    needs: str = ""  # what the name of the module that does not exist says

    def broken(self, params: Params) -> list[str]:
        """The clauses that `params` break."""
        known = {"__builtins__": {}, "clog2": lambda value: max(value - 1, 0).bit_length()}
        for name, value in self.constants:
            known[name] = params[name] if name in params else eval(value, known)
        return [text for text, clause in self.clauses if eval(clause, known)]


@cache
def _rule_in(path: Path) -> Rule | None:
    """The rule of one module, None where it has none."""
    text = re.sub(r"//[^\n]*", "", path.read_text())
    found = re.search(r"\bif\s*\(((?:(?!\bbegin\b|;).)*)\)\s*begin\s*:\s*g_illegal\s+(\w+)", text, re.S)
    if not found:
        return None

    def code(words: str) -> CodeType:
        return compile(f"({_python(words)})", str(path), "eval")

    clauses = [" ".join(clause.split()) for clause in found[1].split("||")]
    wanted, constants = " ".join(clauses), []
    listed = re.findall(r"\b(?:parameter|localparam)\s+(\w+)\s*=\s*(.*?)\s*(?:;|,\s*(?=parameter)|\)\s*\()",
                        text[:found.start()], re.S)
    for name, value in reversed(listed):  # those that the clauses need
        if re.search(rf"\b{name}\b", wanted):
            wanted += f" {value}"
            constants.append((name, code(value)))
    return Rule(tuple(reversed(constants)), tuple((clause, code(clause)) for clause in clauses),
                found[2].partition("_needs_")[2].replace("_", " "))


def rule_of(core: Core) -> Rule:
    """The first rule about the core's parameters: its own, or that of the module that it hands them on to."""
    for path in core.sources:
        rule = _rule_in(path)
        if rule and {name for name, _ in rule.constants} & set(core.params):
            return rule
    return Rule((), ())
