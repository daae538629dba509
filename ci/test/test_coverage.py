"""The coverage page names what nothing reaches, and only that."""

from collections import Counter

from quadrance.cores import find

from ci import checks, coverage


def record(file: str, line: int, kind: str, what: str, count: int) -> str:
    """A line of coverage.dat as Verilator writes it."""
    fields = {"f": f"/somewhere/rtl/{file}", "l": line, "n": 9, "t": kind, "page": f"v_{kind}/x", "o": what}
    return "C '" + "".join(f"\x01{key}\x02{value}" for key, value in fields.items()) + f"' {count}\n"


def test_points_of_two_instances_add_up() -> None:
    text = "# SystemC::Coverage-3\n" + "".join(record("arith/a.v", 7, "branch", "if", count) for count in (0, 3))
    assert coverage.points(text) == Counter({("arith/a.v", 7, "branch", "if"): 3})


def test_what_one_core_reaches_is_no_hole_of_the_other() -> None:
    one, two = ("arith/a.v", 7, "branch", "if"), ("arith/a.v", 9, "line", "block")
    found = {"a": Counter({one: 0, two: 0}), "b": Counter({one: 5, two: 0})}
    assert coverage.table(found) == ["a: 0 of 2 lines and branches, 0 of 0 toggles",
                                     "b: 1 of 2 lines and branches, 0 of 0 toggles"]
    text = "\n".join(coverage.section(found))
    assert "- `arith/a.v:9 block`: **open**" in text and "a.v:7" not in text and "It ran 2 sets; 0 of them" in text


def test_a_section_of_the_page_replaces_itself_alone(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(checks, "PAGE", tmp_path / "checks.md")
    checks.put("Coverage", ["one"])
    checks.put("Netlists", ["two"])
    checks.put("Coverage", ["three"])
    assert checks.PAGE.read_text() == "# What the long runs found\n\n## Coverage\n\nthree\n\n## Netlists\n\ntwo\n"


def test_reasons_belong_to_lines_that_exist() -> None:
    for one in coverage.REASONS:
        lines = (coverage.RTL / one["file"]).read_text().splitlines()
        number = next(number for number, line in enumerate(lines, 1) if one["text"] in line)
        assert coverage.explained(f"{one['file']}:{number} case").endswith(one["why"])


def test_absent_status_bits_and_constant_functions_are_left_out() -> None:
    core = find("rational_fk1")
    file = "arith/root_product.v"
    lines = (coverage.RTL / file).read_text().splitlines()
    inside = next(i for i, line in enumerate(lines, 1) if "function" in line) + 1
    points = Counter({("rational/rational_fk1.v", 25, "toggle", "out_status[0]:0->1"): 0,
                      ("rational/rational_fk1.v", 25, "toggle", "out_status[2]:0->1"): 0,
                      (file, inside, "line", "block"): 0, (file, 1, "line", "block"): 0})
    left = set(coverage.counted(core, points))
    assert left == {("rational/rational_fk1.v", 25, "toggle", "out_status[2]:0->1"), (file, 1, "line", "block")}
