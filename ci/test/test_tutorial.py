"""This test runs every shell block of docs/tutorial.md, unchanged, in an empty folder."""

import json
import math
import re
import subprocess
import sys

import pytest
from quadrance import truth

from tb.lib import tools
from tb.lib.simulate import available

PAGE = tools.ROOT / "docs" / "tutorial.md"


def blocks():
    """(step, shell) of the page."""
    return [(int(number), text) for number, text in
            re.findall(r"^## (\d+)\. [^#]*?```sh\n(.*?)```", PAGE.read_text(), re.S | re.M)]


def test_there_are_ten_steps_with_a_block_each():
    assert [number for number, _ in blocks()] == list(range(1, 11))
    for name in re.findall(r"\]\(([\w./]+\.md)\)", PAGE.read_text()):
        assert (PAGE.parent / name).exists()


@pytest.mark.slow
@pytest.mark.skipif(not available("icarus"), reason="Icarus Verilog is not installed")
def test_the_steps_do_what_they_say(tmp_path):
    programs, work = tmp_path / "bin", tmp_path / "work"
    programs.mkdir()
    work.mkdir()
    command = programs / "quadrance"
    command.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m quadrance "$@"\n')
    command.chmod(0o755)
    env = tools.environment()
    env |= {"PATH": f"{programs}:{env['PATH']}", "PYTHONPATH": str(tools.ROOT / "models")}
    said = {}
    for number, text in blocks():
        done = subprocess.run(["sh", "-ec", text], cwd=work, env=env, capture_output=True, text=True)
        assert done.returncode == 0, f"step {number}: {done.stdout}{done.stderr}"
        said[number] = done.stdout
    assert "mm_per_unit = 4 would do" in said[3]
    assert "19200 (16'h4b00)" in said[5] and "7680 (" in said[5] and "262144 (20'h40000)" in said[5]
    one, two, status = map(int, (work / "counts").read_text().split())
    theta = truth.ik2(300, 120, 250, 180, 0)
    for count, angle in zip((one, two), theta):
        off = (count - float(angle) * 2**20 / (2 * math.pi) + 2**19) % 2**20 - 2**19
        assert abs(off) < 40, (count, float(angle))  # 0.014 degrees: the target's LSB and the core's error
    degrees = [f"{(math.degrees(float(angle)) + 180) % 360 - 180:.2f}" for angle in theta]
    assert status == 0 and f"Joint 1 is {degrees[0]} degrees and joint 2 is {degrees[1]} degrees." in PAGE.read_text()
    assert json.loads((work / "report.json").read_text())["fmax"]
