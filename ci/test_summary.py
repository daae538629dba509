"""The workflow: its commands exist, every folder of benches has a job; the summary of its results."""

import re
import subprocess
import sys

import yaml

from ci import choose, summary

MAKEFILE = (choose.ROOT / "Makefile").read_text()
FLOW = yaml.safe_load(choose.WORKFLOW.read_text())


def test_every_command_of_the_workflow_is_a_target():
    text = choose.WORKFLOW.read_text()
    targets = set(re.findall(r"^([a-z-]+):", MAKEFILE, re.M))
    used = set(re.findall(r"make ([a-z-]+)", text)) | {
        name for job in FLOW["jobs"].values() for name in job["strategy"]["matrix"].get("what", ())}
    assert {"test", "setup", "lint", "formal", "exhaustive"} <= used <= targets
    for path in re.findall(r"(?:ci|models|tb)/[\w/]+\.py", text):
        assert (choose.ROOT / path).exists(), path


def test_every_folder_of_benches_has_a_job():
    matrix = FLOW["jobs"]["test"]["strategy"]["matrix"]
    paths = [*matrix["paths"], *(one["paths"] for one in matrix["include"])]
    named = [name for one in paths for name in one.split() if one != "rest"]
    assert "rest" in paths and all((choose.ROOT / name).exists() for name in named)
    assert set(choose.folders()) <= {*named, *choose.rest()}
    assert not set(choose.rest()) & set(named)


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
