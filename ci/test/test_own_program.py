"""This test runs every shell block of docs/own-program.md, unchanged, in an empty folder."""

import json
import math
import re
import subprocess
import sys

import pytest

from tb.lib import tools
from tb.lib.simulate import available

PAGE = tools.ROOT / "docs" / "own-program.md"


@pytest.mark.skipif(not available("icarus"), reason="Icarus Verilog is not installed")
def test_the_steps_do_what_they_say(tmp_path):
    programs, work = tmp_path / "bin", tmp_path / "work"
    programs.mkdir()
    work.mkdir()
    for name, more in (("quadrance", " -m quadrance"), ("python3", "")):
        command = programs / name
        command.write_text(f'#!/bin/sh\nexec "{sys.executable}"{more} "$@"\n')
        command.chmod(0o755)
    env = tools.environment()
    env |= {"PATH": f"{programs}:{env['PATH']}", "PYTHONPATH": str(tools.ROOT / "models")}
    page, said = PAGE.read_text(), []
    steps = re.findall(r"^## (\d+)\. [^#]*?```sh\n(.*?)```", page, re.S | re.M)
    assert [int(number) for number, _ in steps] == list(range(1, 7))
    for number, text in steps:
        done = subprocess.run(["sh", "-ec", text], cwd=work, env=env, capture_output=True, text=True)
        assert done.returncode == 0, f"step {number}: {done.stdout}{done.stderr}"
        said.append(done)
    assert said[2].stderr.startswith("quadrance: wide.kin:6: the range of k is not proved")
    assert "refused" not in (work / "answers").read_text()
    answers = said[-1].stdout.splitlines()
    assert answers.pop(0) == f"version 3 crc {json.loads((work / 'pan.json').read_text())['crc']}"
    wanted, pans = [], [0.0, 0.0]
    for x, y, z in ((1200, 500, 1800), (0, 0, 1800), (-300, 400, 100)):
        for head, (d, h) in enumerate(((100, 1000), (40, 1500))):
            pans[head] = math.atan2(y, x) if (x, y) != (0, 0) else pans[head]
            tilt = math.atan2(z - h, math.cos(pans[head]) * x + math.sin(pans[head]) * y - d)
            wanted.append((math.degrees(pans[head]), math.degrees(tilt), 2 * ((x, y) == (0, 0))))
    found = [tuple(map(float, re.findall(r"-?[\d.]+", line))) for line in answers]
    assert len(found) == len(wanted)
    for one, other in zip(found, wanted):
        assert one == pytest.approx(other, abs=0.01)
    assert f"pans to {wanted[0][0]:.2f} degrees and tilts to {wanted[0][1]:.2f} degrees" in page
