"""The commands of the workflow exist, its shards are all tests once, and the summary of its results is right."""

import re
import subprocess
import sys

import yaml
from quadrance.cores import ROOT

from ci import summary

WORKFLOW = ROOT / ".github" / "workflows" / "regression.yml"
MAKEFILE = (ROOT / "Makefile").read_text()
FLOW = yaml.safe_load(WORKFLOW.read_text())


def test_every_command_of_the_workflow_is_a_target():
    text = WORKFLOW.read_text()
    targets = set(re.findall(r"^([a-z-]+):", MAKEFILE, re.M))
    used = set(re.findall(r"make ([a-z-]+)", text)) | {
        name for job in FLOW["jobs"].values() for name in job["strategy"]["matrix"].get("what", ())}
    assert {"test", "setup", "lint", "formal", "exhaustive"} <= used <= targets
    for path in re.findall(r"(?:ci|models|tb)/[\w/]+\.py", text):
        assert (ROOT / path).exists(), path


def test_the_shards_are_all_tests_once(pytester):
    pytester.copy_example(str(ROOT / "conftest.py"))
    pytester.makepyfile("import pytest\n@pytest.mark.parametrize('i', range(7))\ndef test(i): pass\n")
    shards = FLOW["jobs"]["test"]["strategy"]["matrix"]["shard"]
    texts = [pytester.runpytest("--collect-only", "-q", "--shard", shard).stdout.str() for shard in shards]
    kept = [name for text in texts for name in re.findall(r"::test\[(\d)\]", text)]
    assert sorted(kept) == list("0123456")
    assert "it is K/N" in pytester.runpytest("--shard", "7/6").stderr.str()


def test_the_summary(tmp_path):
    file = tmp_path / "test.xml"
    assert "was not written" in summary.summary(file)
    file.write_text('<testsuite><testcase classname="a" name="b" time="2"/><testcase classname="a" name="c" time="3">'
                    '<failure message="no">line\nlast</failure></testcase>'
                    '<testcase classname="a" name="d" time="0"><skipped/></testcase></testsuite>')
    text = summary.summary(file)
    assert "**1 passed, 1 failed, 1 skipped**" in text and "`a::c`" in text and "  last" in text
    assert text.index("| `a::c` | 3.0 |") < text.index("| `a::b` | 2.0 |")
    done = subprocess.run([sys.executable, "-S", summary.__file__, file], capture_output=True, text=True)
    assert done.stdout == text
