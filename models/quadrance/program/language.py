"""This module says what a program of the product engine is: inputs, equations, results. `parser` reads one.

docs/programs.md defines the language.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

FORMATS = ("vector", "coordinate", "velocity", "length", "word", "fraction", "power")
ONE = "one"  # the constant 1.0


class Wrong(ValueError):
    """A text that is no program; the message is one line: file, line, reason."""


@dataclass(frozen=True)
class Term:
    """A word, or the product of two, with its sign."""

    minus: bool
    a: str
    b: str | None = None

    @property
    def names(self) -> tuple[str, ...]:
        return (self.a,) if self.b is None else (self.a, self.b)


Sum = tuple[Term, ...]


@dataclass(frozen=True)
class Statement:
    """One statement after loops are expanded.

    Attributes
    ----------
    kind : "sum", "reach", "check", "near", "far", "root", "unit", "quotient", "clamp" or "emit".
    names : words that it gives.
    sums : the sum; the two coordinates of `unit`; the dividends; that of `clamp`; for each word of `emit` one of a
        single term.
    source : the word under a root; the divisor; the two factors of `clamp`.
    signs : for each word of a root, or for a unit vector, "+", "-" or a sign input.
    hold : name of the direction that is held, empty for none.
    keep : without a direction its register is written with its own word, which can be emitted.
    of : the held direction of `near`, the clamped word of `far`.
    how : of `emit`: "flags", the word carries the flags of what has been solved; "both", its negative follows it.
    """

    line: int
    text: str
    kind: str
    names: tuple[str, ...] = ()
    sums: tuple[Sum, ...] = ()
    source: tuple[str, ...] = ()
    signs: tuple[str, ...] = ()
    wrist: bool = False
    hold: str = ""
    keep: bool = False
    of: str = ""
    how: str = ""

    @property
    def reads(self) -> tuple[str, ...]:
        """Names of the words that it reads, in the order of the text."""
        return tuple(dict.fromkeys([*(name for one in self.sums for term in one for name in term.names), *self.source]))


@dataclass(frozen=True)
class Port:
    """An input or a result: its name in the text, the port of the core, its format."""

    name: str
    port: str
    format: str


@dataclass
class Program:
    """A program as its text says it; `norms` are (names, limit), `order` groups of results in their order in time."""

    path: Path
    title: str = ""
    inputs: dict[str, Port] = field(default_factory=dict)
    signs: tuple[str, ...] = ()
    norms: list[tuple[tuple[str, ...], float]] = field(default_factory=list)
    argued: dict[str, float] = field(default_factory=dict)
    results: list[Port] = field(default_factory=list)
    order: tuple[tuple[str, ...], ...] = ()
    statements: list[Statement] = field(default_factory=list)

    @property
    def name(self) -> str:
        return self.path.stem

    @property
    def streamed(self) -> bool:
        """Results are given one after the other, with the flags of each part."""
        return any(one.kind == "emit" for one in self.statements)

    def wrong(self, line: int, reason: str) -> Wrong:
        """The error for a line of the text."""
        return Wrong(f"{self.path.name}:{line}: {reason}")
