"""Why an assertion about arrays failed: the first sample that breaks it, both sides there, and what went in."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path
from types import TracebackType

import numpy as np

MOST = 24  # values that are shown beside the two sides
OPERATORS = {ast.Eq: "==", ast.NotEq: "!=", ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">="}
COMPARE = {"==": np.equal, "!=": np.not_equal, "<": np.less, "<=": np.less_equal, ">": np.greater,
           ">=": np.greater_equal}


def failed(trace: TracebackType | None) -> list[str]:
    """Lines about the assertion in which a test ended; none where it compares no arrays.

    The expression is worked out once more with the names that the test had.
    """
    frames = []
    while trace is not None:
        frames.append((trace.tb_frame, trace.tb_lineno))
        trace = trace.tb_next
    for frame, line in reversed(frames):
        file = Path(frame.f_code.co_filename)
        if not file.is_file() or "site-packages" in file.parts:
            continue
        found = [node for node in ast.walk(ast.parse(file.read_text())) if isinstance(node, ast.Assert)
                 and node.lineno <= line <= node.end_lineno]
        if found:
            scope = {**frame.f_globals, **frame.f_locals}
            try:
                return _reason(found[-1].test, scope, dict(frame.f_locals))
            except Exception as error:  # the words of the assertion itself are there anyway
                return [f"the assertion cannot be worked out again: {type(error).__name__}: {error}"]
    return []


def _value(node: ast.expr, scope: dict) -> object:
    return eval(compile(ast.Expression(node), "<assertion>", "eval"), scope)


def _reason(node: ast.expr, scope: dict, names: dict) -> list[str]:
    """Of an expression that should be true of every element: where it is not."""
    if isinstance(node, ast.BoolOp) and isinstance(node.op, ast.And):
        return next((_reason(one, scope, names) for one in node.values if not np.all(_value(one, scope))), [])
    if isinstance(node, ast.Call) and node.args and isinstance(node.args[0], ast.GeneratorExp):
        return _among(node.args[0], scope, names)
    called = ast.unparse(node.func).rpartition(".")[2] if isinstance(node, ast.Call) else ""
    if called == "all":
        return _reason(node.args[0] if node.args else node.func.value, scope, names)
    if called == "array_equal":
        return _compared(*node.args[:2], "==", scope, names)
    if isinstance(node, ast.Compare) and len(node.ops) == 1 and type(node.ops[0]) in OPERATORS:
        if not any(isinstance(_value(side, scope), np.ndarray) for side in (node.left, *node.comparators)):
            return []  # pytest shows where plain values differ
        return _compared(node.left, node.comparators[0], OPERATORS[type(node.ops[0])], scope, names)
    mask = np.asarray(_value(node, scope))
    return [_first(mask == 0, ast.unparse(node)), *_beside(mask == 0, names)] if mask.ndim and not mask.all() else []


def _among(made: ast.GeneratorExp, scope: dict, names: dict) -> list[str]:
    """Of ``all(... for name in ...)``: the first that is false, with its name."""
    targets = sorted({one.id for clause in made.generators for one in ast.walk(clause.target)
                      if isinstance(one, ast.Name)})
    pairs = ast.Tuple([ast.Name(one, ast.Load()) for one in targets], ast.Load())
    listed = ast.fix_missing_locations(ast.ListComp(ast.Tuple([pairs, made.elt], ast.Load()), made.generators))
    for bound, answer in _value(listed, scope):
        if not np.all(answer):
            more = dict(zip(targets, bound))
            return [f"with {', '.join(f'{key} = {value!r:.80}' for key, value in more.items())}:",
                    *_reason(made.elt, scope | more, names)]
    return []


def _compared(left: ast.expr, right: ast.expr, operator: str, scope: dict, names: dict) -> list[str]:
    sides = [np.asarray(_value(one, scope)) for one in (left, right)]
    try:
        one, other = np.broadcast_arrays(*sides)
    except ValueError:
        return [f"{ast.unparse(side)} has the shape {values.shape}" for side, values in zip((left, right), sides)]
    wrong = ~COMPARE[operator](one, other)
    if not wrong.ndim or not wrong.any():
        return []
    at = tuple(int(i) for i in np.argwhere(wrong)[0])
    return [_first(wrong, f"{ast.unparse(left)} {operator} {ast.unparse(right)}"),
            f"  {ast.unparse(left)}: {one[at]}", f"  {ast.unparse(right)}: {other[at]}", *_beside(wrong, names)]


def _first(wrong: np.ndarray, text: str) -> str:
    at = ", ".join(map(str, np.argwhere(wrong)[0]))
    return f"sample {at} is the first of {int(wrong.sum())} (of {wrong.size}) that break {text}"


def _arrays(names: dict) -> Iterator[tuple[str, object]]:
    """Names of a test with what they stand for; the words of a port as ``name[port]``."""
    for name, value in names.items():
        if isinstance(value, dict):
            yield from ((f"{name}[{key}]", one) for key, one in value.items())
        elif not name.startswith("@"):
            yield name, value


def _beside(wrong: np.ndarray, names: dict) -> list[str]:
    """The values of every array as long as the compared one at that sample, and of short plain names."""
    at = int(np.argwhere(wrong)[0][-1])
    lines = []
    for name, value in _arrays(names):
        if isinstance(value, np.ndarray) and value.ndim and value.shape[-1] == wrong.shape[-1]:
            lines.append(f"  {name} there: {value[..., at]}")
        elif isinstance(value, int | float | str) and len(str(value)) < 40:
            lines.append(f"  {name}: {value!r}")
    return lines[:MOST]
