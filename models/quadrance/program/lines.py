"""This module turns the statements of a program into lines of product_engine, one sum of two products each.

A line takes one input from a port, as operand A; every other operand is a register. An input that some line needs in a
register is loaded by a line of its own. Lines have no place in time yet: `schedule` gives them one.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from quadrance.program.language import ONE, Program, Statement, Sum, Term

LIMIT = 512  # lines of a program
REG, PORT, TABLE = "REG", "PORT", "TABLE"  # sources of A


@dataclass
class Line:
    """One line: word = A * B [+- C * D] [+ the sum of the line before].

    Attributes
    ----------
    label : what a reader of the table sees.
    source, a : where A comes from, and its name.
    by : B is a constant or a factor of the root unit, of that name; else register `b`.
    cd, minus : the second product, and whether it is subtracted.
    after : number of the line whose sum this one continues.
    dest : the word that it writes; "" for none.
    acts : names of ACT bits; FOLD stands for FOLD and MORE.
    fold, root, far, hold : groups of lines that use one unit of the engine; -1 for none.
    near : the held direction whose flag it sets, as in `hold`.
    own : without a direction it writes its register's own word.
    emit : the word is given as a result, "plain", with the "flags", or "both": it and its negative.
    """

    label: str
    source: str
    a: str
    b: str = ""
    by: str = ""
    cd: tuple[str, str] | None = None
    minus: bool = False
    after: int = -1
    dest: str = ""
    align: str = "HIGH"
    acts: set[str] = field(default_factory=set)
    fold: int = -1
    root: int = -1
    far: int = -1
    hold: int = -1
    near: int = -1
    own: bool = False
    keep: bool = False
    emit: str = ""

    @property
    def registers(self) -> list[str]:
        """Names of the words that it reads from registers, each as often as it does."""
        first = [self.a] if self.source == REG else []
        return [*first, *([] if self.by else [self.b]), *(self.cd or ())]


def _text(terms: Iterable[Term | None], more: bool = False) -> str:
    """Terms as they stand in a text; `more`: they are added to others."""
    parts = [("- " if term.minus else "+ ") + "*".join(term.names) for term in terms if term]
    if more:
        return " ".join(["..", *parts])
    return " ".join([parts[0].replace("+ ", "").replace("- ", "-"), *parts[1:]])


def added(name: str, part: str) -> str:
    """The name of a word that a statement needs on the way to its own: in capitals, and a letter."""
    return name.upper() + part


class _Lowering:
    """Lines of a program whose inputs `loaded` are in registers; `fewer`: more are wanted there, to save lines."""

    def __init__(self, program: Program, loaded: tuple[str, ...], fewer: bool) -> None:
        self.program, self.loaded, self.wanted, self.fewer = program, set(loaded), list(loaded), fewer
        self.lines: list[Line] = []
        self.writer: dict[str, int] = {}
        self.groups = {"fold": 0, "root": 0, "far": 0}
        self.holds: list[str] = []
        for name in loaded:
            self.add(Line(name, PORT, name, by="PLUS", dest=name))
        for one in program.statements:
            getattr(self, "_" + one.kind)(one)
            if len(self.lines) > LIMIT:
                raise program.wrong(one.line, f"more than {LIMIT} lines of the engine")

    def add(self, line: Line) -> int:
        self.lines.append(line)
        if line.dest:
            self.writer[line.dest] = len(self.lines) - 1
        return len(self.lines) - 1

    def group(self, unit: str) -> int:
        self.groups[unit] += 1
        return self.groups[unit] - 1

    def port(self, name: str) -> bool:
        return name == ONE or name in self.program.inputs

    def register(self, name: str) -> str:
        """A name that has to be in a register: an input is loaded, next time."""
        if self.port(name) and name not in self.wanted:
            self.wanted.append(name)
        return name

    # Sums

    def sum(self, terms: Sum, dest: str, label: str) -> int:
        """The lines of a sum; the number of the last one.

        A single word and a product with an input of no register have to be a first product (A * B); a first product
        is not negative. What has no choice comes first; the others fill the lines. Where a sum takes fewer lines with
        an input in a register, the last one is loaded.
        """
        first = [term for term in terms if term.b is None]
        fresh = [term for term in terms if term.b and self.fresh(term) and not term.minus]
        second = sorted((term for term in terms if term.b and term not in fresh), key=lambda term: not term.minus)
        count = max(len(first), -(-len(terms) // 2))
        while self.fewer and len(first) + len(fresh) > count and fresh:
            if len(first) + len(fresh) <= len(second):
                break
            second.append(fresh.pop())
        first += fresh
        at = -1
        while first or second:
            positive = [term for term in second if not term.minus]
            if first:
                one = first.pop(0)
            elif positive:
                one = positive[0]
                second.remove(one)
            else:
                one = None
            two = second.pop(0) if second else None
            done = not first and not second
            says = f"{label}{' =' if done and dest else '' if at >= 0 else ':'} {_text((one, two), at >= 0)}"
            at = self.add(Line(says, *self.first(one), after=at, keep=not done, dest=dest if done else "",
                               cd=(self.register(two.a), self.register(two.b)) if two else None,
                               minus=bool(two and two.minus)))
        return at

    def fresh(self, term: Term) -> bool:
        """A product that needs an input from its port."""
        return any(self.port(name) and name not in self.loaded for name in term.names)

    def first(self, term: Term | None) -> tuple[str, str, str, str]:
        """Source, A, B and BY of a first product; without a term it is 0."""
        if term is None:
            return PORT, ONE, "", "NOUGHT"
        if term.b is None:
            return PORT if self.port(term.a) else REG, term.a, "", "MINUS" if term.minus else "PLUS"
        a, b = term.a, term.b
        if self.port(b) and (not self.port(a) or a in self.loaded and b not in self.loaded):
            a, b = b, a
        if self.port(a) and (a not in self.loaded or a == ONE):
            return PORT, a, self.register(b), ""
        return REG, a, self.register(b), ""

    def _sum(self, one: Statement) -> None:
        self.sum(one.sums[0], one.names[0], one.names[0])

    def _reach(self, one: Statement) -> None:
        at = self.sum(one.sums[0], one.names[0], one.names[0])
        self.lines[at].acts.add("ABOVE")

    def _check(self, one: Statement) -> None:
        self.lines[self.sum(one.sums[0], "", "check")].acts.add("CHECK")

    def _near(self, one: Statement) -> None:
        line = self.lines[self.sum(one.sums[0], added(one.of, "m"), f"near {one.of}")]
        line.label = line.label.replace(" =", "")
        line.acts.add("NEAR")
        line.near = self.held(one.of)

    def _far(self, one: Statement) -> None:
        line = self.lines[self.sum(one.sums[0], "", f"far {one.of}")]
        line.acts.add("OVER")
        line.emit = "far" if self.program.streamed else ""
        line.far = self.lines[self.writer[one.of]].far

    def _emit(self, one: Statement) -> None:
        for (term,) in one.sums:
            at = self.writer[term.a]
            if self.lines[at].hold >= 0 and not self.lines[at].own or self.lines[at].emit:
                at = self.add(Line(f"emit {term.a}", REG, term.a, by="PLUS"))
            self.lines[at].emit = one.how or "plain"

    # Roots and directions

    def folded(self, terms: Sum, name: str, fold: int, wrist: bool = False) -> str:
        """A word whose magnitude joins a group of powers of two: its writer does it, or a line that copies it."""
        only, at = terms[0], self.writer.get(terms[0].a, -1)
        free = at >= 0 and self.lines[at].fold < 0 and self.lines[at].align == "HIGH" and self.lines[at].hold < 0
        if len(terms) > 1 or only.b or only.minus or not free:
            at = self.sum(terms, name, name)
        line = self.lines[at]
        line.acts |= {"FOLD", "WRIST"} if wrist else {"FOLD"}
        line.fold = fold
        return line.dest

    def _root(self, one: Statement) -> None:
        fold, root = self.group("fold"), self.group("root")
        y = self.folded((Term(False, one.source[0]),), added(one.names[0], "y"), fold)
        wide = added(one.names[0], "t")
        self.add(Line(f"{y} 4^j", REG, y, by="FOUR", align="LOW", acts={"ROOT"}, fold=fold, root=root))
        self.add(Line(f"{wide} = {y} 2^j", REG, y, by="TWICE", align="LOW", dest=wide, fold=fold))
        for name, sign in zip(one.names, one.signs):
            g = self.reciprocal(name, sign, root)
            self.add(Line(f"{name} = {g} * {wide}", REG, g, wide, dest=name))

    def reciprocal(self, name: str, sign: str, root: int) -> str:
        """The line of 1 / (2 sqrt); its word."""
        signs = {"+": "SLOPE", "-": "BACK"} | dict(zip(self.program.signs, ("BACK", "DOWN", "FLIP")))
        g = added(name, "g")
        self.add(Line(f"{g} = 1 / root", TABLE, "", by=signs[sign], align="MID", dest=g, root=root))
        return g

    def held(self, name: str) -> int:
        """The number of a held direction."""
        if name not in self.holds:
            self.holds.append(name)
        return self.holds.index(name)

    def _unit(self, one: Statement) -> None:
        fold, root = self.group("fold"), self.group("root")
        words = [self.folded(terms, added(name, "v"), fold, one.wrist) for name, terms in zip(one.names, one.sums)]
        up = [added(name, "u") for name in one.names]
        for word, name in zip(words, up):
                        self.add(Line(f"{name} = {word} 2^s", REG, word, by="POWER", align="LOW", dest=name, fold=fold))
        self.add(Line(f"|{up[0]}, {up[1]}|^2", REG, up[0], up[0], cd=(up[1], up[1]), acts={"ROOT"},
                      fold=fold, root=root))
        g = self.reciprocal(one.names[0], one.signs[0], root)
        hold = self.held(one.hold) if one.hold else -1
        for name, word in zip(one.names, up):
            self.add(Line(f"{name} = {g} * {word}", REG, g, word, dest=name, hold=hold,
                          acts={"HOLD"} if one.hold else set(), root=root if one.hold else -1, own=one.keep))

    def _quotient(self, one: Statement) -> None:
        fold, root, first = self.group("fold"), self.group("root"), one.names[0]
        up, g, sign, inverse = (added(first, part) for part in "xgsi")
        x = self.folded((Term(False, one.source[0]),), added(first, "d"), fold)
        self.add(Line(f"{up} = {x} 2^s", REG, x, by="POWER", align="LOW", dest=up, fold=fold))
        self.add(Line(f"{up}^2", REG, up, up, acts={"ROOT"}, fold=fold, root=root))
        self.add(Line(f"{g} = 1 / root", TABLE, "", by="SLOPE", align="MID", dest=g, root=root))
        self.add(Line(f"{sign} = {g} * {up}", REG, g, up, dest=sign))
        self.add(Line(f"{inverse} = {sign} * {g}", REG, sign, g, dest=inverse))
        for name, terms in zip(one.names, one.sums):
            far, (dividend, whole, kept) = self.group("far"), (added(name, part) for part in "nwc")
            at = self.sum(terms, dividend, dividend)
            self.lines[at].acts.add("FAR")
            self.lines[at].far = far
            self.add(Line(f"{whole} = {dividend} 2^s", REG, dividend, by="POWER", align="LOW", dest=whole,
                          acts={"FAR"}, fold=fold, far=far))
            self.add(Line(f"{kept} = limit {whole}", REG, whole, by="PLUS", acts={"CLAMP"}, dest=kept, far=far))
            self.add(Line(f"{name} = {inverse} * {kept}", REG, inverse, kept, dest=name))

    def _clamp(self, one: Statement) -> None:
        name, far = one.names[0], self.group("far")
        gap, scaled, product = (added(name, part) for part in "drp")
        at = self.sum(one.sums[0], gap, gap)
        self.lines[at].acts.add("FAR")
        self.lines[at].far = far
        fraction, power = one.source
        self.add(Line(f"{scaled} = {gap} * {fraction}", PORT, fraction, gap, dest=scaled))
        self.add(Line(f"{product} = {scaled} * {power}", PORT, power, scaled, align="LOW", acts={"FAR"},
                      far=far, dest=product))
        self.add(Line(f"{name} = clamp {product}", REG, product, by="PLUS", acts={"CLAMP"}, dest=name, far=far))


def lines(program: Program) -> list[Line]:
    """The lines of a program, in the order of its text, with one for each input that has to be loaded."""
    made = _Lowering(program, (), False)
    for fewer in (False, True):
        while made.fewer != fewer or len(made.wanted) > len(made.loaded):
            made = _Lowering(program, tuple(made.wanted), fewer)
    return made.lines
