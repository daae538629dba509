"""What a verdict of `make cover` follows from: every function that runs, and no other file's text."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from ci import cache, cover
from tb.lib import stimulus, tools

FAMILIES = list({core.family: core for core in cover.cores()}.values())
ENGINES = list({core.model_name: core for core in cover.cores() if core.family == "engine"}.values())
LONG = "kinematics_engine", "ur_keep"
OURS = tuple(str(tools.ROOT / folder) for folder in ("models", "tb"))


def _runs(core) -> set[tuple[Path, str]]:
    """What samples and model of a core run: (file, function, class or constant at its top)."""
    ran = set()

    def note(frame, event, _):
        code = frame.f_code
        if event == "call" and code.co_filename.startswith(OURS):
            ran.add((Path(code.co_filename), code.co_qualname.split(".")[0], code.co_firstlineno))

    rng = np.random.default_rng(1)
    sys.setprofile(note)
    try:
        cfg = stimulus.configs(core, rng)[0]
        stimulus.drawn(core, rng)
        words = stimulus.joined(stimulus.corners(core, cfg), stimulus.uniform(core, rng, 20))
        core.model(core.params, **words, **cfg)
    finally:
        sys.setprofile(None)
    return {(path, _top(path, line) if name.startswith("<") else name) for path, name, line in ran}


def _top(path: Path, line: int) -> str:
    """Name of the constant in whose text a lambda or a comprehension stands; nothing of the file's own run."""
    return next((name for name, nodes in cache.source(path).named.items()
                 if any(node.lineno <= line <= node.end_lineno for node in nodes)), "")


@pytest.mark.parametrize("core", [pytest.param(core, id=core.id, marks=[pytest.mark.slow] * (core.name in LONG))
                                  for core in (*FAMILIES, *ENGINES)])
def test_every_function_that_runs_is_followed(core):
    followed = cover.python(core)
    ran = {one for one in _runs(core) if str(one[0].relative_to(tools.ROOT)) not in cover.LIST and one[1]}
    family = Path(cache.stimulus(core)[0])
    missing = {one for one in ran - set(followed) if one[0] != family or "MODELS" not in cache.source(family).named}
    assert len(ran) > 5 and not missing


def test_only_what_is_used_is_followed(tmp_path, monkeypatch):
    """A function, a constant, a class, through aliases, packages and chains; a module as a value is all of it."""
    monkeypatch.setattr(cache, "PLACES", {"here": tmp_path})
    (tmp_path / "here/inner").mkdir(parents=True)
    files = {
        "__init__.py": "",
        "inner/__init__.py": "from here.inner.deep import one as first\n",
        "inner/deep.py": "LEFT = 1\ndef one():\n    return LEFT\ndef two():\n    return RIGHT\nRIGHT = LEFT\n",
        "top.py": "from here import inner, other as o\nfrom here.inner import deep, first\nSIDE = effect()\n"
                  "effect()\ndef a():\n    return deep.two()\ndef b():\n    return first() + inner.deep.one()\n"
                  "@o.wrap\ndef c():\n    from here.other import late\n    return late\ndef d():\n    return run(o)\n",
        "other.py": "from math import floor as near\nimport json\ndef wrap(f):\n    'How.'\n    return f\n"
                    "late = near(3)\nclass Alone:\n    'Why.'\n"}
    for name, text in files.items():
        (tmp_path / "here" / name).write_text(text)
    top, deep, other = (tmp_path / "here" / name for name in ("top.py", "inner/deep.py", "other.py"))

    def names(start: str | None) -> set[str]:
        return {f"{path.stem}.{name}" for path, name in cache.reached([(top, start)]) if name}

    assert names("a") == {"top.a", "deep.two", "deep.RIGHT", "deep.LEFT"}
    assert names("b") == {"top.b", "deep.one", "deep.LEFT"}
    assert names("c") == {"top.c", "other.wrap", "other.late", "other.near"}
    assert names("d") == {"top.d"} | {f"other.{name}" for name in ("wrap", "late", "near", "json", "Alone")}
    found = cache.reached([(top, "c")])
    assert found[top, ""] == "effect()" and found[top, "c"].startswith("@o.wrap\ndef c")
    assert found[other, "near"] == "from math import floor as near"
    assert found[other, "wrap"] == "def wrap(f):\n    return f"
    assert set(cache.reached([(top, "a")], {deep})) == {(top, ""), (top, "a")}


def test_the_digest_is_that_of_what_is_used(monkeypatch):
    core = next(core for core in cover.cores() if core.name == "rational_fk2")
    found, before, path = cover.python(core), cover._follows(core), tools.ROOT / "models/quadrance/rational.py"
    assert (path, "_turn") in found and (path, "ik2") not in found
    monkeypatch.setattr(cover, "python", lambda _: found | {(path, "_turn"): "def _turn(): pass"})
    assert cover._follows(core) != before


def asks(core) -> bool:
    """Whether the model of a core names PIPE or MULTIPLY, in what it reaches."""
    start = Path(sys.modules[core.model.__module__].__file__), core.model.__name__
    texts = cache.reached([start], {tools.ROOT / name for name in cover.LIST})
    return any('"PIPE"' in text or '"MULTIPLY"' in text for text in texts.values())


def test_models_of_programs_alone_ask_how_a_core_is_built():
    """So every other model is tested at one set of those that `claims.distinct` takes for the same."""
    wrong = {core.name for core in cover.cores() if asks(core) and core.family != "program"}
    assert not wrong and any(asks(core) for core in cover.cores() if core.family == "program")
