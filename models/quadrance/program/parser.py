"""This module reads the text of a program, NAME.kin, in the language that docs/programs.md defines.

A text is parsed and never evaluated. `LIMITS` bound its length, its names and its loops, so that a text that is made to
be slow is refused at once. Every error is one line: file, line, reason.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path

from quadrance.program import consistency
from quadrance.program.language import FORMATS, ONE, Port, Program, Statement, Sum, Term, Wrong

LIMITS = {"characters": 100_000, "columns": 160, "statements": 1000, "loops": 4, "values": 16, "name": 12, "terms": 12,
          "texts": 4}
RESERVED = set("""use in cfg sign norm argue out order reach check near far emit flags both for root unit clamp wrist
    hold keep one""".split())
SIGNS = 3  # bits of in_signs
ARGUED = 3  # words of a program whose range may be argued

_TOKEN = re.compile(r"\s*(?:([A-Za-z_]\w*)|(\d+(?:\.\d*)?|\.\d+)|(<=|[-+*/=(),]))")
_NAME = re.compile(rf"[a-z][a-z0-9]{{0,{LIMITS['name'] - 1}}}")
_FILE = re.compile(r"[A-Za-z]\w*")
_LOOP = re.compile(r"for ([a-z][a-z0-9]*) in ([a-z0-9+\- ]+):")


class _Tokens:
    """The tokens of one line, taken one after the other."""

    def __init__(self, program: Program, line: int, text: str) -> None:
        self.program, self.line, self.at, self.tokens = program, line, 0, []
        while text.strip():
            match = _TOKEN.match(text)
            if not match:
                raise self.wrong(f"'{text.strip()[0]}' has no meaning here")
            self.tokens.append(match[0].strip())
            text = text[match.end():]

    def wrong(self, reason: str) -> Wrong:
        return self.program.wrong(self.line, reason)

    @property
    def next(self) -> str:
        return self.tokens[self.at] if self.at < len(self.tokens) else ""

    def take(self, *wanted: str) -> str:
        """The next token; where `wanted` is given, one of those."""
        token = self.next
        if wanted and token not in wanted or not token:
            raise self.wrong(f"{' or '.join(wanted) or 'more'} is expected {f'at {token}' if token else 'at the end'}")
        self.at += 1
        return token

    def name(self) -> str:
        """A name of a word."""
        token = self.take()
        if not _NAME.fullmatch(token):
            raise self.wrong(f"'{token}' is no name: a letter, then letters and digits, all small, at most "
                             f"{LIMITS['name']} characters")
        if token in RESERVED - {ONE}:
            raise self.wrong(f"'{token}' is a word of the language and no name")
        return token

    def names(self) -> Iterator[str]:
        """The names up to the end of the line or up to a symbol."""
        while self.next and (self.next[0].isalpha() or self.next[0] == "_"):
            yield self.name()

    def number(self) -> float:
        token = self.take()
        if not re.fullmatch(r"[\d.]+", token):
            raise self.wrong(f"a number is expected at {token}")
        return float(token)

    def sum(self) -> Sum:
        """Terms with their signs."""
        terms, minus = [], self.next == "-"
        if minus:
            self.take()
        while True:
            a = self.name()
            b = None
            if self.next == "*":
                self.take()
                b = self.name()
            terms.append(Term(minus, a, b))
            if len(terms) > LIMITS["terms"]:
                raise self.wrong(f"a sum of more than {LIMITS['terms']} terms")
            if self.next not in ("+", "-"):
                return tuple(terms)
            minus = self.take() == "-"

    def end(self) -> None:
        if self.next:
            raise self.wrong(f"'{self.next}' is too much")


def _expanded(program: Program, lines: Sequence[tuple[int, str]], depth: int, count: list[int]) -> Iterator[
        tuple[int, str]]:
    """The lines with every loop written out."""
    at = 0
    while at < len(lines):
        number, text = lines[at]
        at += 1
        if not text.strip().startswith("for "):
            count[0] += 1
            if count[0] > LIMITS["statements"]:
                raise program.wrong(number, f"more than {LIMITS['statements']} statements, loops written out")
            yield number, text
            continue
        match = _LOOP.fullmatch(text.strip())
        if not match:
            raise program.wrong(number, "a loop is 'for NAME in VALUE ...:'")
        values, indent, body = match[2].split(), len(text) - len(text.lstrip()), []
        while at < len(lines) and len(lines[at][1]) - len(lines[at][1].lstrip()) > indent:
            body.append(lines[at])
            at += 1
        if not body or not values:
            raise program.wrong(number, "a loop without lines: they are indented below it" if values else
                                "a loop without values")
        if depth >= LIMITS["loops"] or len(values) > LIMITS["values"]:
            raise program.wrong(number, f"at most {LIMITS['loops']} loops in one another, of {LIMITS['values']} values")
        for value in values:
            yield from _expanded(program, [(n, one.replace(f"{{{match[1]}}}", value)) for n, one in body], depth + 1,
                                 count)


def _ports(tokens: _Tokens, prefix: str) -> Iterator[Port]:
    """FORMAT NAME or NAME = PORT, some times."""
    format = tokens.take(*FORMATS)
    while tokens.next:
        name = tokens.name()
        if tokens.next == "=":
            tokens.take()
            yield Port(name, f"{prefix}_{tokens.name()}", format)
        else:
            yield Port(name, f"{prefix}_{name}", format)


def _declare(program: Program, tokens: _Tokens) -> bool:
    """A line that declares something; False where it is a statement."""
    word = tokens.next
    if word in ("in", "cfg"):
        tokens.take()
        for port in _ports(tokens, word):
            if port.name in program.inputs or port.name == ONE:
                raise tokens.wrong(f"{port.name} is declared twice" if port.name != ONE else "one is the constant 1.0")
            program.inputs[port.name] = port
    elif word == "sign":
        tokens.take()
        program.signs += tuple(tokens.names())
        if len(program.signs) > SIGNS:
            raise tokens.wrong(f"more than {SIGNS} signs")
    elif word in ("norm", "argue"):
        tokens.take()
        names = tuple(tokens.names())
        tokens.take("<=")
        limit = tokens.number()
        if word == "norm":
            if not names or set(names) - set(program.inputs):
                raise tokens.wrong("norm speaks of inputs alone: the ranges of other words are proved")
            program.norms.append((names, limit))
        else:
            program.argued |= dict.fromkeys(names, limit)
            if len(program.argued) > ARGUED:
                raise tokens.wrong(f"more than {ARGUED} words are argued")
    elif word == "out":
        tokens.take()
        program.results += _ports(tokens, "out")
    elif word == "order":
        tokens.take()
        groups = [tuple(tokens.names())]
        while tokens.next == ",":
            tokens.take()
            groups.append(tuple(tokens.names()))
        program.order += tuple(groups)
    else:
        return False
    tokens.end()
    return True


def _sign(program: Program, tokens: _Tokens) -> str | None:
    """A sign, where one is next: +, - or a sign input."""
    if tokens.next in ("+", "-", *program.signs):
        return tokens.take()
    return None


def _statement(program: Program, tokens: _Tokens, text: str) -> Statement:
    """An equation, or a check."""
    line = tokens.line
    if tokens.next == "check":
        tokens.take()
        return Statement(line, text, "check", sums=(tokens.sum(),))
    if tokens.next in ("near", "far"):
        kind, of = tokens.take(), tokens.name()
        tokens.take("(")
        one = tokens.sum()
        tokens.take(")")
        return Statement(line, text, kind, sums=(one,), of=of)
    if tokens.next == "emit":
        tokens.take()
        return _emit(tokens, text)
    kind = tokens.take() if tokens.next == "reach" else "sum"
    names = [tokens.name()]
    while tokens.next == ",":
        tokens.take()
        names.append(tokens.name())
    tokens.take("=")
    if tokens.next in ("root", "unit", "clamp") and kind == "sum":
        return {"root": _root, "unit": _unit, "clamp": _clamp}[tokens.take()](program, tokens, text, tuple(names))
    if tokens.next == "(" and kind == "sum":
        return _quotient(tokens, text, tuple(names))
    if len(names) > 1:
        raise tokens.wrong("one name is expected before = of a sum")
    return Statement(line, text, kind, tuple(names), (tokens.sum(),))


def _root(program: Program, tokens: _Tokens, text: str, names: tuple[str, ...]) -> Statement:
    source, signs = tokens.name(), []
    while (sign := _sign(program, tokens)) is not None:
        signs.append(sign)
    if len(signs or ["+"]) != len(names):
        raise tokens.wrong(f"{len(names)} names and {len(signs)} signs of a root")
    return Statement(tokens.line, text, "root", names, source=(source,), signs=tuple(signs or ["+"]))


def _unit(program: Program, tokens: _Tokens, text: str, names: tuple[str, ...]) -> Statement:
    if len(names) != 2:
        raise tokens.wrong("unit gives two words, cosine and sine")
    tokens.take("(")
    first = tokens.sum()
    tokens.take(",")
    second = tokens.sum()
    tokens.take(")")
    sign, hold, how = _sign(program, tokens) or "+", "", ""
    if wrist := tokens.next == "wrist":
        tokens.take()
    if tokens.next in ("hold", "keep"):
        how = tokens.take()
        hold = tokens.name() if tokens.next else names[0]
    return Statement(tokens.line, text, "unit", names, (first, second), signs=(sign,), wrist=wrist, hold=hold,
                     keep=how == "keep")


def _quotient(tokens: _Tokens, text: str, names: tuple[str, ...]) -> Statement:
    sums = []
    for before in ("(", *"," * (len(names) - 1)):
        tokens.take(before)
        sums.append(tokens.sum())
    tokens.take(")")
    tokens.take("/")
    return Statement(tokens.line, text, "quotient", names, tuple(sums), source=(tokens.name(),))


def _emit(tokens: _Tokens, text: str) -> Statement:
    terms = []
    while tokens.next not in ("", "flags", "both"):
        terms.append((Term(False, tokens.name()),))
    how = tokens.take() if tokens.next else ""
    if not terms or how == "flags" and len(terms) > 1:
        raise tokens.wrong("emit is followed by words, by words and both, or by one word and flags")
    return Statement(tokens.line, text, "emit", sums=tuple(terms), how=how)


def _clamp(program: Program, tokens: _Tokens, text: str, names: tuple[str, ...]) -> Statement:
    if len(names) != 1:
        raise tokens.wrong("clamp gives one word")
    tokens.take("(")
    one = tokens.sum()
    tokens.take(")")
    factors = []
    for format in ("fraction", "power"):
        tokens.take("*")
        factors.append(tokens.name())
        if factors[-1] not in program.inputs or program.inputs[factors[-1]].format != format:
            raise tokens.wrong(f"{factors[-1]} is no input of format {format}: clamp (...) * fraction * power")
    return Statement(tokens.line, text, "clamp", names, (one,), source=tuple(factors))


def _used(program: Program, line: int, text: str, users: tuple[Path, ...]) -> None:
    """Begin a program with all that another text of its folder says; an error in it is one of this line."""
    name = text.split()[1:]
    if len(name) != 1 or not _FILE.fullmatch(name[0]):
        raise program.wrong(line, "the name of one text is expected after use: that of NAME.kin beside this one")
    path = program.path.with_name(f"{name[0]}.kin")
    if path in users:
        raise program.wrong(line, f"{path.name} uses itself")
    if len(users) >= LIMITS["texts"]:
        raise program.wrong(line, f"more than {LIMITS['texts']} texts that use one another")
    try:
        other = _read(path, users)
    except Wrong as error:
        raise program.wrong(line, f"use: {error}") from None
    program.inputs |= other.inputs
    program.signs, program.order = other.signs, other.order
    program.norms += other.norms
    program.argued |= other.argued
    program.results += other.results
    program.statements += [replace(one, line=line) for one in other.statements]


def parse(text: str, path: Path, users: tuple[Path, ...] = ()) -> Program:
    """The program of a text; `users`: the texts that use it.

    Raises
    ------
    Wrong
        One line: file, line and reason.
    """
    program, lines = Program(path), []
    if not _FILE.fullmatch(path.stem):
        raise program.wrong(1, "the name of the file is the module's: a letter, then letters, digits and _")
    if len(text) > LIMITS["characters"]:
        raise program.wrong(1, f"more than {LIMITS['characters']} characters")
    for number, line in enumerate(text.splitlines(), 1):
        if len(line) > LIMITS["columns"]:
            raise program.wrong(number, f"more than {LIMITS['columns']} columns")
        if "\t" in line:
            raise program.wrong(number, "a tab: lines are indented by spaces")
        if number == 1 and line.startswith("#"):
            program.title = line.strip("# ")
        if line.split("#")[0].strip():
            lines.append((number, line.split("#")[0].rstrip()))
    for at, (number, line) in enumerate(_expanded(program, lines, 0, [0])):
        if "{" in line:
            raise program.wrong(number, f"no loop gives {line[line.index('{'):].split('}')[0]}}}")
        if line.split()[0] == "use":
            if at:
                raise program.wrong(number, "use comes before all else, once")
            _used(program, number, line, (*users, path))
            continue
        tokens = _Tokens(program, number, line)
        if not _declare(program, tokens):
            program.statements.append(_statement(program, tokens, line.strip()))
            tokens.end()
    consistency.check(program)
    return program


@cache
def load(path: Path) -> Program:
    """The program of a file."""
    return _read(path)


def _read(path: Path, users: tuple[Path, ...] = ()) -> Program:
    try:
        return parse(path.read_text(), path, users)
    except (OSError, UnicodeDecodeError) as error:
        raise Wrong(f"{path}: cannot be read: {getattr(error, 'strerror', None) or 'it is no text'}") from None
