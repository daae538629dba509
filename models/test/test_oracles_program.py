"""Status bits of the kinematics engine, from its page and from the language's."""

from __future__ import annotations

from pathlib import Path

from quadrance.program import assembler, image

from models.test.oracles import ask, oracle

UNIT = 1 << 25  # a word of 1.0
TEXT = """# One statement for each flag
in  word a b c n
sign back
out word c1 n1 r
norm a b <= 0.9
norm c n <= 1.4
reach q = a*a - b*b
r = root q back
c1, n1 = unit (a, b) hold
check c*c + n*n - one
"""


@oracle("program.kinematics", status=("unreachable", "singular", "no_rotation"))
def test_a_run_tells_what_a_line_has_found(core, tmp_path):
    """A negative `reach`, no direction, a `check` of 16 units of 2^-U or more; commands beside RUN have no status."""
    file = Path(tmp_path / "flags.kin")
    file.write_text(TEXT)
    made = image.image(assembler.assembled(file, core.params["PIPE"]), start=20)
    unit = UNIT >> core.params["U"]
    commands, wanted = image.load(made), []
    for context in (0, 1):
        for a, b, c, n, status in ((0.4, 0.1, 1, 0, 0), (0.1, 0.4, 1, 0, 1), (0, 0, 0, 1, 2), (0.4, 0.1, 0, 0, 8),
                                   (0.1, 0.2, 0.5, 0.5, 9), (0, 0, 0.5, 0, 10), (0.4, 0.1, 0, -1, 0)):
            commands += image.inputs(made, context, {"in_a": round(a * UNIT), "in_b": round(b * UNIT),
                                                     "in_c": round(c * UNIT), "in_n": round(n * UNIT)})
            commands += [image.run(made, context), (3, context, made["start"], 0), *image.outputs(made, context)]
            wanted.append(status)
    for off in (-20, -17, -15, 0, 15, 17, 20):  # units of 2^-U of the square of the length
        commands += image.inputs(made, 0, {"in_c": UNIT + off * unit // 2, "in_n": 0}) + [image.run(made, 0)]
        wanted.append(8 if abs(off) > 16 else 0)
    found = ask(core, [dict(zip(("kind", "context", "at", "data"), command)) for command in commands])
    assert [row["status"] for row, (kind, *_) in zip(found, commands) if kind == 2] == wanted
    assert not any(row["status"] for row, (kind, *_) in zip(found, commands) if kind != 2)
