"""These tests show what a source means, and what a file reaches."""

from ci.cache import bare, closure
from ci.report import run
from tb.lib import tools


def test_comments_and_docstrings_mean_nothing():
    text = '"""What."""\n\nimport os  # why\n\n\nclass A:\n    """That."""\n    b = "# not a comment"\n\n\n' \
           'def f():\n    """How.\n\n    Long.\n    """\n    return """kept\n    too"""\n'
    assert bare(text, ".py") == 'import os\nclass A:\n    b = "# not a comment"\n' \
                              'def f():\n    return """kept\n    too"""'
    assert bare(text.replace("Long", "Longer").replace("why", "whyever"), ".py") == bare(text, ".py")
    assert bare(text.replace("kept", "held"), ".py") != bare(text, ".py")
    assert bare('def f():\n    "Größe"  # ü\n    return "ü"\n', ".py") == 'def f():\n    return "ü"'


def test_what_judges_the_cores_is_all_reached():
    files = {str(path.relative_to(tools.ROOT)) for path in closure(run.SIMULATION)}
    assert {"models/quadrance/truth.py", "models/quadrance/trajectory.py", "models/quadrance/fixed.py",
            "models/quadrance/arms/__init__.py", "tb/lib/bulk.py"} <= files
    assert any("quadrance/accuracy" in file for file in files)
    assert not any(file.startswith("ci/synth") for file in files), "a changed flow is no reason to simulate"
    assert "ci/cache.py" not in files, "what keeps figures changes none"
