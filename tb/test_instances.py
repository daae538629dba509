"""What `quadrance instance CORE --arm ARM` prints, built as it stands and followed to the letter, is that arm.

Parameters and words are read from the text; where the parameters are not those of a listed set, for which there is a
program, the text itself is pasted into a bench of Icarus, all arms of a core in one. The formulas of the comments are
computed around the core, and the machine's own joints, velocities and poses are held to a chain of 4 x 4 matrices made
of nothing but the arm file. An answer is within the core's derived bound and what the rounding of the arm's lengths and
of the target adds.
"""

from __future__ import annotations

import contextlib
import io
import math
import re
import tomllib
from dataclasses import dataclass

import numpy as np
import pytest
from quadrance import arms, bounds, codecs, truth_arm, truth_six, truth_srs, truth_ur
from quadrance.bounds import arm as arm_bounds
from quadrance.bounds import six as six_bounds
from quadrance.bounds import srs as srs_bounds
from quadrance.bounds import ur as ur_bounds
from quadrance.cli import main
from quadrance.cli.words import number
from quadrance.cores import Core, all_cores, at, find, joints

from models.test.claims import CLAIMS
from tb.lib import bulk, simulate, tools

Floats = np.ndarray
NEVER = ("chain", "mff", "fk5")  # kinematics whose lengths are not an arm file's
PLANE = ("fk1", "fk2", "ik1", "ik2", "ik3r", "keep2", "velocity2", "rates2")
CLEAR, FEW = 12.0, 60  # degrees from the stretched and the folded arm; samples an arm
CORES = [core if core.family != "paper" else find(f"{core.name}-S24") for core in all_cores()
         if core.first_set and core.family in ("vector", "table", "rational", "classic", "paper", "arm", "six", "ur",
                                               "srs", "keep")
         and core.function not in (*NEVER, "root", "sign", "quotient")]

# The arm, from its file alone


def moved(x: float = 0, y: float = 0, z: float = 0) -> Floats:
    """A translation."""
    found = np.eye(4)
    found[:3, 3] = x, y, z
    return found


def turned(axis: str, degrees: Floats) -> Floats:
    """Rotations (N, 4, 4) about an axis, right-handed."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    i, k = {"z": (0, 1), "x": (1, 2), "y": (2, 0)}[axis]
    found = np.tile(np.eye(4), (len(c), 1, 1))
    found[:, i, i] = found[:, k, k] = c
    found[:, i, k], found[:, k, i] = -s, s
    return found


@dataclass(frozen=True)
class Machine:
    """An arm file as it stands, and its joints by the names that it gives them."""

    id: str
    file: dict

    def key(self, table: str, key: str, default: float = 0.0) -> float:
        return self.file.get(table, {}).get(key, default)

    @property
    def psi(self) -> float:
        return math.degrees(math.atan2(self.key("constants", "elbow"), self.key("links", "l2")))

    def seen(self, angles: dict[str, Floats]) -> dict[str, Floats]:
        """The joints by the keys of the file, from those by the machine's names; the elbow against link 1."""
        joints = self.file["joints"].items()
        found = {key: joint["sign"] * angles[joint["name"]] + joint["zero"] for key, joint in joints}
        if self.key("constants", "absolute_elbow", False):
            found["elbow"] = found["elbow"] - found["shoulder"]
        return found

    def named(self, seen: dict[str, Floats]) -> dict[str, Floats]:
        """The other way round."""
        if self.key("constants", "absolute_elbow", False):
            seen = seen | {"elbow": seen["elbow"] + seen["shoulder"]}
        joints = self.file["joints"].items()
        return {joint["name"]: joint["sign"] * (seen[key] - joint["zero"]) for key, joint in joints}

    def chain(self, angles: dict[str, Floats], plane: bool = False, links: int = 2) -> Floats:
        """Frames (N, 4, 4), mm, of the end of link 1 or of the forearm, or of the last one that the file has.

        `plane`: the yaw stands at 0.
        """
        q, l1, l2 = self.seen(angles), self.key("links", "l1"), self.key("links", "l2")
        if "yaw" not in self.file["limits"]:
            found = turned("z", q["shoulder"]) @ moved(l1)
            found = found @ turned("z", q["elbow"]) @ moved(l2, self.key("constants", "elbow")) if links > 1 else found
            return found @ turned("z", q["tool"]) @ moved(self.key("links", "l3")) if links > 2 else found
        base, a, b = (self.key("constants", key) for key in ("base", "shoulder", "lateral"))
        found = moved(z=base) @ turned("z", q["yaw"] * (not plane)) @ moved(a, b)
        found = found @ turned("y", -q["shoulder"])
        found = (found @ turned("x", q["upper"]) if "upper" in q else found) @ moved(l1)
        if links > 1:
            found = found @ turned("y", -q["elbow"]) @ moved(l2, 0, self.key("constants", "elbow"))
        if links > 3:  # the wrist, whose z axis is along the forearm
            wrist = self.file["wrist"]
            if wrist.get("parallel"):  # frame 3 of the makers' table: x back along the forearm, z to the left
                found = found @ turned("y", np.full(len(found), 180.0)) @ turned("x", np.full(len(found), -90.0))
                found = found @ turned("z", q["j4"]) @ turned("x", np.full(len(found), 90.0)) @ turned("z", q["j5"])
                found = found @ moved(z=wrist["offset"]) @ turned("x", np.full(len(found), -90.0))
                return found @ turned("z", q["j6"]) @ moved(z=wrist["flange"])
            one, two, three = (q[key] for key in (("j5", "j6", "j7") if "upper" in q else ("j4", "j5", "j6")))
            found = found @ turned("y", np.full(len(found), 90.0)) @ turned("z", one) @ turned("y", two)
            found = found @ turned("z", three) @ moved(z=self.key("wrist", "flange"))
        return found

    def sample(self, count: int, rng: np.random.Generator, anywhere: bool = False) -> dict[str, Floats]:
        """Joints within the limits, clear of the stretched and the folded arm; `anywhere`: limits left aside."""
        limits = self.file["limits"]
        room = {key: (-180.0, 180.0) if anywhere else ends for key, ends in limits.items()}
        size = 60 * count
        seen = {key: rng.uniform(low + 1, high - 1, size) for key, (low, high) in room.items() if key != "forearm"}
        for key in ("j4", "j5", "j6", "j7", "tool"):
            if joint := self.file["joints"].get(key):
                ends = sorted(joint["sign"] * end + joint["zero"] for end in joint.get("limits", (-150, 150)))
                seen[key] = rng.uniform(max(ends[0], -150), min(ends[1], 150), size)
        line = seen["elbow"]
        fine = np.abs(np.sin(np.radians(line))) > math.sin(math.radians(CLEAR))
        seen["elbow"] = line - self.psi
        if "forearm" in limits and not anywhere:
            low, high = limits["forearm"]
            forearm = seen["elbow"] + seen["shoulder"]
            fine &= (forearm > low + 1) & (forearm < high - 1)
        if "j5" in seen:
            fine &= np.abs(np.sin(np.radians(seen["j6" if "upper" in seen else "j5"]))) > 0.2
        return self.named({key: angle[fine][:count] for key, angle in seen.items()})


def machine(name: str) -> Machine:
    return Machine(name, tomllib.loads(arms.path_of(name).read_text()))


# What is printed


@dataclass(frozen=True)
class Printed:
    """An instance: its Verilog, and the assignments in front of the core and behind it."""

    text: str
    params: dict[str, int]
    words: dict[str, int]
    before: tuple[str, ...]
    after: tuple[str, ...]


def printed(core: Core, arm: str) -> Printed | str:
    """What the command prints; its refusal."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = main(["instance", core.id, "--arm", arm, "--name", "u_dut", "--declare"])
    if code:
        assert out.getvalue() == "" and err.getvalue().count("\n") == 1
        return err.getvalue()
    text = out.getvalue()
    steps = {}
    for where in ("before", "after"):
        lines = re.findall(rf"^//   {where} +(.*)$", text, re.M)
        steps[where] = tuple(step for line in lines for step in line.split(";  "))
    params = {key: int(value) for key, value in re.findall(r"\.([A-Z]\w*)\((\d+)\)", text)}
    words = {name: number(literal) for name, literal in re.findall(r"\.(cfg_\w+)\(([^)]*)\)", text)}
    assert words.keys() == {port.name for port in core.cfg}
    return Printed(text, params, words, steps["before"], steps["after"])


def followed(steps: tuple[str, ...], known: dict[str, Floats]) -> dict[str, Floats]:
    """The names of `known` after these assignments, angles in degrees."""
    def degrees(function):
        return lambda value: function(np.radians(value))

    functions = {"sin": degrees(np.sin), "cos": degrees(np.cos), "sqrt": np.sqrt, "hypot": np.hypot,
                 "atan2": lambda y, x: np.degrees(np.arctan2(y, x))}
    names = {re.sub(r"rate\((\w+)\)", r"rate_\1", name): value for name, value in known.items()}
    for step in steps:
        target, _, formula = re.sub(r"rate\((\w+)\)", r"rate_\1", step).partition(" = ")
        names[target] = eval(formula, {"__builtins__": {}}, functions | names)
    return names


# The core, as it was pasted

BENCH = """\
`timescale 1ns/1ps
module bench_{arm};
    reg clk = 0, rst = 1;
    integer clocks = 0, at = 0, got = 0;
    initial while (got < {count} && clocks < {most}) #5 clk = !clk;
{text}
    reg [{width}-1:0] samples [0:{count}-1];
    initial begin
        $readmemh("{arm}.hex", samples);
        @(negedge clk) rst <= 0;
    end
    assign dut_in_valid = !rst && at < {count};
    assign dut_out_ready = 1'b1;
    assign {{{inputs}}} = samples[at < {count} ? at : 0];
    always @(posedge clk) begin
        clocks <= clocks + 1;
        if (dut_in_valid && dut_in_ready) at <= at + 1;
        if (dut_out_valid) begin
            got <= got + 1;
            $display("{arm}{formats}", {outputs});
        end
    end
endmodule
"""


def run(core: Core, runs: dict[str, tuple[Printed, dict[str, Floats]]]) -> dict[str, dict[str, Floats]]:
    """Answers by arm of what was printed to the words of its samples."""
    found, rest = {}, {}
    for arm, (text, words) in runs.items():
        if text.params == core.params or not simulate.available("icarus"):
            one = core if text.params == core.params else at(core, text.params)
            found[arm] = bulk.stream(one, words, text.words).outputs
        else:
            rest[arm] = text.text, words
    return found | (pasted(core, rest) if rest else {})


def pasted(core: Core, runs: dict[str, tuple[str, dict[str, Floats]]]) -> dict[str, dict[str, Floats]]:
    """The same of the texts as they are, all of them in one simulation of Icarus."""
    folder = tools.BUILD / "instances" / core.name
    folder.mkdir(parents=True, exist_ok=True)
    benches, width = [], sum(port.width for port in core.inputs)
    for arm, (text, words) in runs.items():
        count = len(next(iter(words.values())))
        rows = [sum((int(words[port.name][i]) & (1 << port.width) - 1) << sum(one.width for one in core.inputs[k + 1:])
                    for k, port in enumerate(core.inputs)) for i in range(count)]
        (folder / f"{arm}.hex").write_text("\n".join(f"{row:x}" for row in rows))
        benches.append(BENCH.format(
            arm=arm, count=count, most=4 * count * (core.ii or 1) + 1000, text=text, width=width,
            inputs=", ".join(f"dut_{port.name}" for port in core.inputs), formats=" %0d" * len(core.outputs),
            outputs=", ".join(f"dut_{port.name}" for port in core.outputs)))
    (folder / "bench.v").write_text("\n".join(benches))
    said = tools.run("iverilog", "-g2005", "-Wall", "-Wno-timescale", *(f"-sbench_{arm}" for arm in runs), "-o",
                     folder / "bench.vvp", folder / "bench.v", *core.sources)
    assert not re.search(r"bench\.v.*(port|width|implicit)", said), said
    lines = [line.split() for line in tools.run("vvp", "-n", "bench.vvp", cwd=folder, timeout=300).splitlines()]
    found = {}
    for arm, (_, words) in runs.items():
        rows = [row[1:] for row in lines if row[0] == arm]
        assert len(rows) == len(next(iter(words.values()))), f"{core.name} on {arm}: {len(rows)} answers"
        assert not any("x" in word for row in rows for word in row)
        found[arm] = {port.name: np.array([int(row[i]) for row in rows]) for i, port in enumerate(core.outputs)}
    return found


# Words


def lsb(core: Core, arm: Machine) -> float:
    """Millimetres in an LSB of a coordinate."""
    return arm.file["mm_per_unit"] * 2.0 ** -core.params["F"]


def joint_words(core: Core, names: dict[str, Floats]) -> dict[str, Floats]:
    """Words of j1, j2 ... (degrees) for the inputs of a core."""
    found = {}
    for joint in joints(core.inputs):
        found |= codecs.encode(joint, np.radians(names[f"j{joint[0].name[-1]}"]))
    return found


def answered(core: Core, out: dict[str, Floats], branch: Floats | None = None) -> dict[str, Floats]:
    """j1, j2 ... (degrees) of the outputs; of a core with all branches those of `branch`."""
    if branch is None:
        return {f"j{joint[0].name[-1]}": np.degrees(codecs.decode(joint, out)) for joint in joints(core.outputs)}
    rows = np.arange(len(branch))
    words = {f"{letter}{i}": np.stack([out[f"out_{letter}{i}{b}"] for b in range(8)], axis=-1)[rows, branch]
             for i in range(1, 7) for letter in "cn"}
    return {f"j{i}": np.degrees(np.arctan2(words[f"n{i}"], words[f"c{i}"])) for i in range(1, 7)}


def exact(text: Printed, core: Core, angles: dict[str, Floats]) -> dict[str, Floats]:
    """The machine's joints next to `angles` at which the core's words are exact: its formulas are linear in them."""
    names, numbers = list(angles), [joint[0].name[-1] for joint in joints(core.inputs)]

    def core_joints(of: dict[str, Floats]) -> Floats:
        zero = {f"rate({name})": np.zeros_like(angle) for name, angle in of.items()} | {
            axis: np.zeros_like(next(iter(of.values()))) for axis in "xyz"}
        found = followed(text.before, of | zero)
        return np.stack([found[f"j{i}"] for i in numbers])

    here = core_joints(angles)
    slope = np.stack([core_joints(angles | {name: angles[name] + 1}) - here for name in names])[:, :, 0].T
    words = joint_words(core, {f"j{i}": angle for i, angle in zip(numbers, here)})
    there = np.stack([np.degrees(codecs.decode(joint, words)) for joint in joints(core.inputs)])
    away = np.linalg.lstsq(slope, (there - here + 180) % 360 - 180, rcond=None)[0]
    return {name: angles[name] + step for name, step in zip(names, away)}


# The bounds, in LSB


def lengths(core: Core, arm: Machine) -> tuple[int, int]:
    """L1 and L2 as words."""
    line = math.hypot(arm.key("links", "l2"), arm.key("constants", "elbow"))
    return round(arm.key("links", "l1") / lsb(core, arm)), round(line / lsb(core, arm))


def inverse_law(core: Core, arm: Machine, place: Floats, tip: Floats) -> Floats:
    """Tip of an inverse core: its law where `place` (2 or 3, N) is the target in front of it and `tip` the machine's,
    mm; half a word of every joint where the law has none."""
    l1, l2 = lengths(core, arm)
    p, target = core.params, np.rint(place / lsb(core, arm)).astype(np.int64)
    far = np.sqrt((target.astype(float) ** 2).sum(axis=0))
    words = codecs.half_step(joints(core.outputs)[0]) * (2 * far + l2)
    if core.function == "ik1":
        return CLAIMS[core.family](core, l1, 0).direction(far) * l1 + codecs.half_step(joints(core.outputs)[0]) * l1
    if core.family in CLAIMS and core.function != "ik3r":
        return CLAIMS[core.family](core, l1, l2).reached(target) + words

    def sine(far: Floats) -> Floats:
        room = ((l1 + l2) ** 2 - far**2) * (far**2 - (l1 - l2) ** 2)
        return np.sqrt(np.maximum(room, 0)) / (2 * l1 * l2)

    if core.function == "ik3r":
        return bounds.table.ik3r(p, l1, l2, round(arm.key("links", "l3") / lsb(core, arm)), far, sine(far))
    if core.function == "keep2":
        return CLAIMS["vector"](find("vector_ik2"), l1, l2).reached(target)
    x, y, z = tip / lsb(core, arm)
    base, a, b = (arm.key("constants", key) / lsb(core, arm) for key in ("base", "shoulder", "lateral"))
    rho = np.sqrt(np.maximum(x * x + y * y - b * b, 0))
    best = [arm_bounds.ik3(p, l1, l2, rho, z - base, far, sine(far))
            for far in (np.hypot(rho - a, z - base), np.hypot(rho + a, z - base))]
    return np.maximum(*best)


def rounding(core: Core, arm: Machine) -> float:
    """What half an LSB of every length does to a tip."""
    constants = [arm.key("constants", key) for key in ("base", "shoulder", "lateral", "elbow")]
    inside = core.function in ("arm_fk3", "arm_ik3", "keep3")
    return 0.5 * (2 + (core.function == "ik3r") + inside * sum(one != 0 for one in constants))


# A core on all arms


def takes(core: Core, arm: Machine) -> str:
    """The key that is missing for this core, or nothing."""
    yaws, upper = "yaw" in arm.file["limits"], "upper" in arm.file["limits"]
    if upper != (core.family == "srs"):
        return "limits.upper" if upper or yaws else "limits.yaw"
    if core.family == "six" or core.function == "six_keep":
        wrist = arm.file.get("wrist", {})
        return "" if "flange" in wrist and "parallel" not in wrist else "wrist" if yaws else "limits.yaw"
    if core.family == "ur" or core.function == "ur_keep":
        return "" if "parallel" in arm.file.get("wrist", {}) else "wrist" if yaws else "limits.yaw"
    if core.function not in PLANE and not yaws:
        return "limits.yaw"
    if core.family == "srs":
        return ""
    if core.function == "ik3r" and "l3" not in arm.file["links"]:
        return "links.l3"
    absolute = arm.key("constants", "absolute_elbow", False)
    return "limits.forearm" if core.function == "keep3" and absolute and "forearm" not in arm.file["limits"] else ""


@pytest.mark.full
@pytest.mark.parametrize("core", [
    pytest.param(core, id=core.id, marks=[pytest.mark.slow] * bool(core.params.get("PIPE")))  # the same words and bits
    for core in CORES])
def test_the_printed_instance_is_the_arm(core: Core) -> None:
    rng, runs = np.random.default_rng([7, *core.name.encode()]), {}
    for name in arms.known():
        arm, found = machine(name), printed(core, name)
        if key := takes(core, arm):
            assert isinstance(found, str) and key in found and name in found
            continue
        assert isinstance(found, Printed), found
        case = CASES[kind(core)](core, arm, found, rng)
        runs[name] = arm, found, case
    assert runs
    answers = run(core, {name: (text, case["words"]) for name, (_, text, case) in runs.items()})
    for name, (arm, text, case) in runs.items():
        worst, limit = JUDGES[kind(core)](core, arm, text, case, answers[name])
        wrong = np.flatnonzero(~(worst <= limit))
        assert not wrong.size, f"{core.name} on {name}: {worst[wrong[0]]:.3f} LSB, {limit[wrong[0]]:.3f} allowed, " \
                               f"sample {wrong[0]} ({wrong.size} of {worst.size})"


def kind(core: Core) -> str:
    """Which case and judge a core has."""
    if core.function.startswith(("velocity", "rates")):
        return "six_" * (core.family == "six") + core.function[:-1]
    if core.function.endswith("_keep"):
        return core.function
    if core.family == "six":
        return "six_" + core.function[:2]
    if core.family in ("ur", "srs"):
        return "_".join(core.function.split("_")[:2])
    return "keep" if core.function.startswith("keep") else "fk" if "fk" in core.function else "ik"


def places(core: Core, arm: Machine, angles: dict[str, Floats]) -> dict[str, Floats]:
    """The names of the machine's tip in the formulas, mm: x, y, z; in the plane of an arm that yaws rho and z."""
    links = {"1": 1, "2": 2, "r": 3, "3": 2}[core.function[-1]]
    plane = core.function in PLANE and "yaw" in arm.file["limits"]
    x, y, z = arm.chain(angles, plane, links)[:, :3, 3].T
    return {"rho": x, "z": z} if plane else {"x": x, "y": y, "z": z}


def distance(core: Core, arm: Machine, one: dict[str, Floats], other: dict[str, Floats]) -> Floats:
    """Between two places of `places`, LSB; of a core in a plane in that plane."""
    axes = [axis for axis in ("x", "y", "z", "rho") if axis in one and not (axis == "z" and "x" in one
                                                                          and core.function in PLANE)]
    return np.sqrt(sum((one[axis] - other[axis]) ** 2 for axis in axes)) / lsb(core, arm)


# Forward


def forward_case(core: Core, arm: Machine, text: Printed, rng: np.random.Generator) -> dict:
    angles = exact(text, core, arm.sample(FEW, rng))
    return {"angles": angles, "words": joint_words(core, followed(text.before, angles))}


def forward_judge(core: Core, arm: Machine, text: Printed, case: dict, out: dict) -> tuple[Floats, Floats]:
    step = lsb(core, arm)
    core_joints = followed(text.before, case["angles"])
    given = {axis: out[f"out_{axis}"] * step for axis in "xyz" if f"out_{axis}" in out}
    found = followed(text.after, core_joints | given)
    l1, l2 = lengths(core, arm)
    if core.function == "arm_fk3":
        around = (abs(arm.key("constants", "shoulder")) + abs(arm.key("constants", "lateral"))) / step
        law = arm_bounds.fk3_tip(core.params, l1, l2, around)
    else:
        axes = 3 if core.function == "fk3" else 2
        law = CLAIMS[core.family](core, l1, l2).coordinate() * math.sqrt(axes)
    assert not out["out_status"].any(), f"{core.name} on {arm.id}: a status bit"
    off = distance(core, arm, places(core, arm, case["angles"]), found)
    return off, np.full(len(off), law + rounding(core, arm))


# Inverse


def inverse_case(core: Core, arm: Machine, text: Printed, rng: np.random.Generator) -> dict:
    keeps, space = core.function.startswith("keep"), core.function[-1] == "3"
    angles = arm.sample(6 * FEW, rng)
    if keeps:  # half of them anywhere
        wild = arm.sample(6 * FEW, rng, anywhere=True)
        angles = {name: np.where(np.arange(6 * FEW) % 2, wild[name], angle) for name, angle in angles.items()}
    q, place = arm.seen(angles), places(core, arm, angles)
    l1, line = arm.key("links", "l1"), q["elbow"] + arm.psi
    l2 = math.hypot(arm.key("links", "l2"), arm.key("constants", "elbow"))
    along = l1 * np.cos(np.radians(q["shoulder"])) + l2 * np.cos(np.radians(q["shoulder"] + line))
    rho = along + arm.key("constants", "shoulder")
    step, target = lsb(core, arm), followed(text.before, place)
    end = step * (2 ** (core.params["W"] - 1) - 2)
    fine = np.ones(len(rho), dtype=bool)
    if core.function == "ik1":
        fine &= np.hypot(target["x"], target["y"]) > 30 * step
    else:
        fine &= np.hypot(along, l1 * np.sin(np.radians(q["shoulder"])) + l2 * np.sin(np.radians(
            q["shoulder"] + line))) > 4 * arm.file["mm_per_unit"]  # from the shoulder
    if space:
        fine &= np.abs(rho) > 3 * arm.file["mm_per_unit"]
        fine &= (rho > 0) & (along > 3 * arm.file["mm_per_unit"]) if core.function == "ik3" else True
    axes = "xyz" if space else "xy"
    for axis in axes:
        fine &= np.abs(target[axis]) < end
    pick = np.flatnonzero(fine)[:FEW // 2 if space else FEW]
    assert len(pick) > FEW // 3, (core.name, arm.id, len(pick))
    angles = {name: angle[pick] for name, angle in angles.items()}
    target = {name: np.broadcast_to(value, len(rho))[pick] for name, value in target.items()}
    words = {f"in_{axis}": np.rint(target[axis] / step).astype(np.int64) for axis in axes}
    words |= {"in_elbow": (np.sin(np.radians(line[pick])) < 0).astype(int), "in_back": (rho[pick] < 0).astype(int)}
    if core.function == "ik3r":
        phi = (q["shoulder"] + q["elbow"] + q["tool"])[pick]
        words["in_phi"] = np.rint(phi / 360 * 2 ** core.params["A"]).astype(np.int64)
    return {"angles": angles, "target": target, "words": {port.name: words[port.name] for port in core.inputs}}


def inverse_judge(core: Core, arm: Machine, text: Printed, case: dict, out: dict) -> tuple[Floats, Floats]:
    given = case["target"] | answered(core, out)
    found = followed(text.after, given)
    names = {joint["name"] for joint in arm.file["joints"].values()}
    angles = case["angles"] | {name: angle for name, angle in found.items() if name in names}
    want = places(core, arm, case["angles"])
    tip = np.stack(list(want.values()))
    front = np.stack([case["target"][axis] for axis in "xyz" if f"in_{axis}" in case["words"]])
    law = inverse_law(core, arm, front, tip if len(tip) == 3 else np.zeros((3, tip.shape[1])))
    off = distance(core, arm, want, places(core, arm, angles))
    if not core.function.startswith("keep"):
        assert not out["out_status"].any(), f"{core.name} on {arm.id}: a status bit"
        asked = {step.partition(" = ")[0] for step in text.after}
        away = np.max([np.abs((angles[name] - case["angles"][name] + 180) % 360 - 180) for name in asked], axis=0)
        assert away.max() < CLEAR, f"{core.name} on {arm.id}: another branch than asked for"
    turn = 2 * math.sqrt(0.5) * 2.0 ** -core.params["U"] * sum(lengths(core, arm)) if core.family == "arm" else 0
    phi = math.pi / 2 ** core.params["A"] * arm.key("links", "l3") / lsb(core, arm) if core.function == "ik3r" else 0
    return off, law + rounding(core, arm) + math.sqrt(len(front)) / 2 + turn + phi


def within(core: Core, arm: Machine, angles: dict[str, Floats]) -> Floats:
    """How deep (degrees) within the limits of the file the machine's joints are, least of all joints."""
    q, limits = arm.seen(angles), arm.file["limits"]
    rows = [(q["shoulder"], limits["shoulder"])]
    if core.function == "keep3":
        rows.append((q["yaw"], limits["yaw"]))
    if core.function == "keep3" and arm.key("constants", "absolute_elbow", False):
        rows.append((q["elbow"] + q["shoulder"], limits["forearm"]))
    else:
        rows.append((q["elbow"] + arm.psi, limits["elbow"]))
    deep = [(high - low) / 2 - np.abs((angle - (low + high) / 2 + 180) % 360 - 180) for angle, (low, high) in rows
            if high - low < 360]
    return np.min(deep, axis=0) if deep else np.full(len(q["shoulder"]), 180.0)


def keep_judge(core: Core, arm: Machine, text: Printed, case: dict, out: dict) -> tuple[Floats, Floats]:
    """As an inverse; and an answer is within the limits where any branch is."""
    built = arms.load(arm.id)
    frame = truth_arm.frame(built) if core.function == "keep3" else truth_arm.Frame(
        truth_arm.frame(built).base, truth_arm.frame(built).shoulder, 0.0, math.radians(arm.psi))
    x, y, z = (np.zeros(len(out["out_beyond"])) for _ in range(3))
    place = places(core, arm, case["angles"])
    if core.function == "keep3":
        x, y, z = place["x"], place["y"], place["z"]
    elif "rho" in place:
        x, z = place["rho"], place["z"]
    else:
        x, z = place["x"], place["y"]
        frame = truth_arm.Frame(turn=math.radians(arm.psi))
    deep = []
    for branch in range(4 if core.function == "keep3" else 2):
        unit = arm.file["mm_per_unit"]
        if core.function == "keep3":
            one, two, three = truth_arm.ik3(x / unit, y / unit, z / unit, *built.links, frame, branch & 1, branch >> 1)
        else:
            one, two = truth_arm.truth.ik2(x / unit - frame.shoulder, z / unit - frame.base, *built.links, branch)
            two, three = two - frame.turn, 0 * one
        seen = {"shoulder": np.degrees(one), "elbow": np.degrees(two), "yaw": np.degrees(three), "tool": 0 * one,
                "j4": 0 * one, "j5": 0 * one, "j6": 0 * one}
        if built.absolute_elbow and core.function == "keep3":
            seen["elbow"] = seen["elbow"] - seen["shoulder"]
        deep.append(within(core, arm, arm.named({key: seen[key] for key in arm.file["joints"]})))
    best = np.max(deep, axis=0)
    told = np.all(out["out_beyond"][best > 0.1] == 0) and np.all(out["out_beyond"][best < -0.1] == 1)
    assert told, f"{core.name} on {arm.id}: out_beyond is not what the limits say"
    angles = followed(text.after, case["target"] | answered(core, out))
    names = [joint["name"] for joint in arm.file["joints"].values()]
    angles = case["angles"] | {name: angles[name] for name in names if name in angles}
    kept = within(core, arm, angles)[out["out_beyond"] == 0]
    assert np.all(kept > -0.1), f"{core.name} on {arm.id}: an answer is {-kept.min():.1f} degrees out of the limits"
    return inverse_judge(core, arm, text, case, out)


# Six axes


def seven(core: Core, arm: Machine) -> truth_six.Six:
    """The parameters of the bounds, LSB."""
    step = lsb(core, arm)
    return truth_six.Six(*(value / step for value in (
        arm.key("constants", "shoulder"), -arm.key("constants", "elbow"), arm.key("constants", "lateral"),
        arm.key("constants", "base"), arm.key("links", "l1"), arm.key("links", "l2"), arm.key("wrist", "flange"))))


def six_forward_judge(core: Core, arm: Machine, text: Printed, case: dict, out: dict) -> tuple[Floats, Floats]:
    frame, step = arm.chain(case["angles"], links=6), lsb(core, arm)
    p, size = core.params, sum(map(abs, seven(core, arm)))
    u = p.get("U", 16)
    codec = 6 * math.sqrt(2) * bounds.codec.angle_to_vector(p | {"U": u}) * 2.0**-u if "A" in p else 0.0
    tip = np.stack([out[f"out_{axis}"] for axis in "xyz"], axis=-1)
    off = np.abs(tip - frame[:, :3, 3] / step).max(axis=1)
    matrix = np.stack([out[f"out_r{i}{k}"] for i in "123" for k in "123"], axis=-1).reshape(-1, 3, 3) * 2.0**-u
    turned_by = np.abs(matrix - frame[:, :3, :3]).max(axis=(1, 2))
    assert np.all(turned_by <= six_bounds.forward_matrix(p | {"U": u}) * 2.0**-u + codec)
    return off, np.full(len(off), six_bounds.forward_coordinate(p | {"U": u}, seven(core, arm)) + codec * size)


def six_inverse_case(core: Core, arm: Machine, text: Printed, rng: np.random.Generator) -> dict:
    angles, step = arm.sample(6 * FEW, rng), lsb(core, arm)
    frame, q = arm.chain(angles, links=6), arm.seen(angles)
    l1, l2 = (length * step for length in lengths(core, arm))
    line = q["elbow"] + arm.psi
    rho = l1 * np.cos(np.radians(q["shoulder"])) + l2 * np.cos(np.radians(q["shoulder"] + line)) \
        + arm.key("constants", "shoulder")
    tip, u = frame[:, :3, 3], core.params.get("U", 16)
    fine = np.all(np.abs(tip) < step * 32760, axis=1) & (np.abs(rho) > 5 * arm.file["mm_per_unit"])
    fine &= six_bounds.position(core.params | {"U": u}, seven(core, arm), frame[:, :3, :3], tip / step, rho < 0) < 3
    pick = np.flatnonzero(fine)[:FEW // 2]
    assert len(pick) > FEW // 4
    branch = ((rho < 0) + 2 * (np.sin(np.radians(line)) > 0) + 4 * (np.sin(np.radians(q["j5"])) < 0))[pick]
    words = {f"in_{axis}": np.rint(tip[pick, i] / step).astype(np.int64) for i, axis in enumerate("xyz")}
    words |= {f"in_r{i + 1}{k + 1}": np.rint(frame[pick, i, k] * 2.0**u).astype(np.int64)
              for i in range(3) for k in range(3)}
    return {"angles": {name: angle[pick] for name, angle in angles.items()}, "branch": branch,
            "words": {port.name: (words | {"in_branch": branch})[port.name] for port in core.inputs}}


def six_inverse_judge(core: Core, arm: Machine, text: Printed, case: dict, out: dict) -> tuple[Floats, Floats]:
    branch = case["branch"] if core.function == "ik6_all" else None
    found = followed(text.after, answered(core, out, branch))
    step, p = lsb(core, arm), core.params | {"U": core.params.get("U", 16)}
    want, got = (arm.chain({name: angles[name] for name in case["angles"]}, links=6) for angles in
                 (case["angles"], found))
    codec = 6 * 0.89 * 2 * math.pi / 2 ** p["A"] if "A" in p else 0.0
    turn = truth_six.turned(want[:, :3, :3], got[:, :3, :3])
    assert np.all(turn <= six_bounds.orientation(p) + codec + 3 * 2.0 ** -p["U"])
    for name, angle in case["angles"].items():
        assert np.abs((found[name] - angle + 180) % 360 - 180).max() < CLEAR, f"{name}: another branch"
    law = six_bounds.position(p, seven(core, arm), want[:, :3, :3], want[:, :3, 3] / step, case["branch"] & 1)
    off = np.linalg.norm(want[:, :3, 3] - got[:, :3, 3], axis=1) / step
    return off, law + math.sqrt(3) / 2 + codec * sum(map(abs, seven(core, arm))) + 2.0 ** -p["U"] * abs(
        seven(core, arm).c4)


# Six axes, three of them parallel


def lengths_of_ur(core: Core, arm: Machine) -> truth_ur.Ur:
    """The parameters of the bounds, LSB."""
    keys = (("constants", "base"), ("constants", "lateral"), ("wrist", "offset"), ("wrist", "flange"), ("links", "l1"),
            ("links", "l2"))
    return truth_ur.Ur(*(arm.key(*key) / lsb(core, arm) for key in keys))


def ur_forward_judge(core: Core, arm: Machine, text: Printed, case: dict, out: dict) -> tuple[Floats, Floats]:
    frame = arm.chain(case["angles"], links=6)
    p, size = core.params, lengths_of_ur(core, arm)
    codec = 6 * math.sqrt(2) * bounds.codec.angle_to_vector(p) if "A" in p else 0.0
    tip = np.stack([out[f"out_{axis}"] for axis in "xyz"], axis=-1)
    off = np.abs(tip - frame[:, :3, 3] / lsb(core, arm)).max(axis=1)
    matrix = np.stack([out[f"out_r{i}{k}"] for i in "123" for k in "123"], axis=-1).reshape(-1, 3, 3)
    turned_by = np.abs(matrix - frame[:, :3, :3] * 2.0 ** p["U"]).max(axis=(1, 2))
    assert np.all(turned_by <= ur_bounds.forward_matrix(p) + codec)
    return off, np.full(len(off), ur_bounds.forward_coordinate(p, size) + codec * 2.0 ** -p["U"] * sum(map(abs, size)))


def ur_inverse_case(core: Core, arm: Machine, text: Printed, rng: np.random.Generator) -> dict:
    angles, step, size = arm.sample(6 * FEW, rng), lsb(core, arm), lengths_of_ur(core, arm)
    frame, q, scale = arm.chain(angles, links=6), arm.seen(angles), 2.0 ** core.params["U"]
    elbow, wrist = (np.radians(q[key]) for key in ("elbow", "j5"))
    centre = (frame[:, :3, 3] - arm.key("wrist", "flange") * frame[:, :3, 2]) / step
    ahead = centre[:, 0] * np.cos(np.radians(q["yaw"])) + centre[:, 1] * np.sin(np.radians(q["yaw"]))
    fine = np.all(np.abs(frame[:, :3, 3]) < step * 32760, axis=1) & (np.abs(ahead) > 0.1 * size.l2)
    pick = np.flatnonzero(fine)[:FEW // 2]
    assert len(pick) > FEW // 4
    branch = ((ahead > 0) + 2 * (np.sin(elbow) > 0) + 4 * (np.sin(wrist) < 0))[pick]  # the makers' arm looks back
    words = {f"in_{axis}": np.rint(frame[pick, i, 3] / step).astype(np.int64) for i, axis in enumerate("xyz")}
    words |= {f"in_r{i + 1}{k + 1}": np.rint(frame[pick, i, k] * scale).astype(np.int64)
              for i in range(3) for k in range(3)}
    return {"angles": {name: angle[pick] for name, angle in angles.items()}, "branch": branch, "elbow": elbow[pick],
            "words": {port.name: (words | {"in_branch": branch})[port.name] for port in core.inputs}}


def ur_inverse_judge(core: Core, arm: Machine, text: Printed, case: dict, out: dict) -> tuple[Floats, Floats]:
    found = followed(text.after, answered(core, out, case["branch"] if core.function == "ur_ik_all" else None))
    step, p, size = lsb(core, arm), core.params, lengths_of_ur(core, arm)
    want, got = (arm.chain({name: angles[name] for name in case["angles"]}, links=6) for angles in
                 (case["angles"], found))
    codec = 6 * 0.89 * 2 * math.pi / 2 ** p["A"] if "A" in p else 0.0
    turn = truth_six.turned(want[:, :3, :3], got[:, :3, :3])
    assert np.all(turn <= ur_bounds.orientation(p) + codec + 3 * 2.0 ** -p["U"])
    for name, angle in case["angles"].items():
        assert np.abs((found[name] - angle + 180) % 360 - 180).max() < CLEAR, f"{name}: another branch"
    exact = np.stack([case["elbow"]] * 6, axis=-1)
    law = ur_bounds.position(p, size, want[:, :3, :3], want[:, :3, 3] / step, exact)
    off = np.linalg.norm(want[:, :3, 3] - got[:, :3, 3], axis=1) / step
    return off, law + math.sqrt(3) / 2 + codec * sum(map(abs, size)) + 2.0 ** -p["U"] * abs(size.d6)


# Six axes, the branch chosen


def eight_judge(core: Core, arm: Machine, text: Printed, case: dict, out: dict) -> tuple[Floats, Floats]:
    """The pose of the answered joints; they are within the limits, and no farther from the last ones than the pose's
    own joints are, in any turn."""
    step, p = lsb(core, arm), core.params
    found = followed(text.after, {f"j{i}": out[f"out_j{i}"] * 360 / 2 ** p["A"] for i in range(1, 7)})
    names = list(case["angles"])
    assert not (out["out_status"] & 9).any() and not out["out_beyond"].any()
    answer, own = (np.stack([angles[name] for name in names], axis=1) for angles in (found, case["angles"]))
    seen_joints, joints = arm.seen(dict(zip(names, answer.T))), arm.file["joints"]
    for key, name in ((key, joint["name"]) for key, joint in joints.items()):
        if "limits" in joints[key]:
            low, high, seen = *joints[key]["limits"], answer[:, names.index(name)]
        else:
            low, high = arm.file["limits"].get(key, (-180, 180))
            low, high = (low - arm.psi, high - arm.psi) if key == "elbow" else (low, high)
            whole = high - low == 360
            seen = seen_joints[key] if key in arm.file["limits"] and not whole else answer[:, names.index(name)]
            low, high = (-180, 180) if whole else (low, high)
            own[:, names.index(name)] = (own[:, names.index(name)] + 180) % 360 - 180 if whole else own[
                :, names.index(name)]
        assert np.all((seen > low - 0.1) & (seen < high + 0.1)), f"{name} is beyond its limits"
    weights = np.array([1 / joint.get("speed", 1.0) for name in names for joint in joints.values()
                        if joint["name"] == name])
    weights = np.rint(63 * weights / weights.max())
    last = np.concatenate([np.zeros((1, 6)), answer[:-1]])
    reached = (weights * np.abs(answer - last)).sum(1)
    assert np.all(reached <= (weights * np.abs(own - last)).sum(1) + 0.1 * weights.sum()), "another branch is nearer"
    want, got = (arm.chain(dict(zip(names, angles.T)), links=6) for angles in (own, answer))
    codec = 6 * 0.89 * 2 * math.pi / 2 ** p["A"]
    parallel = core.function == "ur_keep"
    size = lengths_of_ur(core, arm) if parallel else seven(core, arm)
    law = (ur_bounds if parallel else six_bounds).orientation(p)
    held = out["out_status"] & 2 != 0
    assert np.all((truth_six.turned(want[:, :3, :3], got[:, :3, :3]) <= law + codec + 3 * 2.0 ** -p["U"]) | held)
    off = np.linalg.norm(want[:, :3, 3] - got[:, :3, 3], axis=1) / step
    return off, np.full(len(off), 4.0 + codec * sum(map(abs, size)))


# Seven axes


def lengths_of_srs(core: Core, arm: Machine) -> truth_srs.Srs:
    """The parameters of the bounds, LSB."""
    keys = (("constants", "base"), ("links", "l1"), ("links", "l2"), ("wrist", "flange"))
    return truth_srs.Srs(*(arm.key(*key) / lsb(core, arm) for key in keys))


def srs_case(core: Core, arm: Machine, text: Printed, rng: np.random.Generator) -> dict:
    """Poses away from axis 1, with the swivel as the core's page defines it."""
    angles, step, scale = arm.sample(6 * FEW, rng), lsb(core, arm), 2.0 ** core.params["U"]
    frame, q = arm.chain(angles, links=6), {key: np.radians(angle) for key, angle in arm.seen(angles).items()}
    shoulder = np.array([0, 0, arm.key("constants", "base")])
    elbow = arm.chain(angles, links=1)[:, :3, 3] - shoulder
    centre = frame[:, :3, 3] - arm.key("wrist", "flange") * frame[:, :3, 2] - shoulder
    line = centre / np.linalg.norm(centre, axis=1, keepdims=True)
    above = np.array([0, 0, 1]) - line[:, 2:] * line
    above = above / np.linalg.norm(above, axis=1, keepdims=True)
    side = np.where(np.sin(q["elbow"]) > 0, -1, 1)  # that elbow counts from straight below the line
    swivel = np.arctan2(side * (elbow * np.cross(line, above)).sum(1), side * (elbow * above).sum(1))
    clear = 0.2 * arm.key("links", "l1")
    fine = np.all(np.abs(frame[:, :3, 3]) < step * 32760, axis=1) & (np.hypot(*centre[:, :2].T) > clear)
    fine &= np.hypot(*elbow[:, :2].T) > clear
    pick = np.flatnonzero(fine)[:FEW // 2]
    assert len(pick) > FEW // 4
    branch = ((np.cos(q["shoulder"]) < 0) + 2 * (np.sin(q["elbow"]) < 0) + 4 * (np.sin(q["j6"]) < 0))[pick]
    words = {f"in_{axis}": np.rint(frame[pick, i, 3] / step) for i, axis in enumerate("xyz")}
    words |= {f"in_r{i + 1}{k + 1}": np.rint(frame[pick, i, k] * scale) for i in range(3) for k in range(3)}
    words |= {"in_cs": np.rint(np.cos(swivel[pick]) * scale), "in_ns": np.rint(np.sin(swivel[pick]) * scale)}
    words |= {"in_branch": branch}
    return {"angles": {name: angle[pick] for name, angle in angles.items()},
            "words": {port.name: words[port.name].astype(np.int64) for port in core.inputs}}


def srs_judge(core: Core, arm: Machine, text: Printed, case: dict, out: dict) -> tuple[Floats, Floats]:
    found = followed(text.after, answered(core, out))
    step, p, size = lsb(core, arm), core.params, lengths_of_srs(core, arm)
    want, got = (arm.chain({name: angles[name] for name in case["angles"]}, links=6) for angles in
                 (case["angles"], found))
    codec = 7 * 0.89 * 2 * math.pi / 2 ** p["A"] if "A" in p else 0.0
    turn = truth_six.turned(want[:, :3, :3], got[:, :3, :3])
    assert np.all(turn <= srs_bounds.orientation(p) + codec + 3 * 2.0 ** -p["U"])
    for name, angle in case["angles"].items():
        assert np.abs((found[name] - angle + 180) % 360 - 180).max() < CLEAR, f"{name}: another branch"
    law = srs_bounds.position(p, size, want[:, :3, :3], want[:, :3, 3] / step)
    off = np.linalg.norm(want[:, :3, 3] - got[:, :3, 3], axis=1) / step
    return off, law + math.sqrt(3) / 2 + codec * sum(map(abs, size)) + 2.0 ** -p["U"] * abs(size.l4)


# Velocities


def speed(core: Core, arm: Machine, angles: dict[str, Floats], rates: dict[str, Floats]) -> dict[str, Floats]:
    """The rates (mm) of the machine's place for rates of its joints (radians), by a central difference."""
    step = 1e-4
    ends = [places(core, arm, {name: angle + sign * np.degrees(rates[name]) * step for name, angle in angles.items()})
            for sign in (1, -1)]
    found = {axis: (ends[0][axis] - ends[1][axis]) / (2 * step) for axis in ends[0]}
    return {"x": found["rho"], "y": found["z"]} if "rho" in found else found


def velocity_case(core: Core, arm: Machine, text: Printed, rng: np.random.Generator) -> dict:
    angles = arm.sample(FEW, rng)
    turns = joints_of_the_core(core, arm)
    rates = {name: rng.uniform(-0.25, 0.25, FEW) * (name in turns) for name in angles}
    forward = core.function.startswith("velocity")
    angles = exact(text, core, angles)
    known = angles | {f"rate({name})": rate for name, rate in rates.items()} | speed(core, arm, angles, rates)
    names = followed(text.before, known)
    words = joint_words(core, names)
    if forward:
        words |= {f"in_w{i}": np.rint(names[f"w{i}"] * 2.0 ** core.params["V"]).astype(np.int64)
                  for i in range(1, len(turns) + 1)}
    else:
        words |= {f"in_{axis}": np.rint(names[axis] / lsb(core, arm)).astype(np.int64) for axis in "xyz"
                  if f"in_{axis}" in {port.name for port in core.inputs}}
    return {"angles": angles, "rates": rates, "names": names, "words": words}


def joints_of_the_core(core: Core, arm: Machine) -> list[str]:
    keys = ["shoulder", "elbow"] + ["yaw"] * (core.function[-1] == "3")
    return [arm.file["joints"][key]["name"] for key in keys]


def velocity_judge(core: Core, arm: Machine, text: Printed, case: dict, out: dict) -> tuple[Floats, Floats]:
    p, step, axes = core.params, lsb(core, arm), core.function[-1] == "3"
    around = abs(arm.key("constants", "shoulder")) + abs(arm.key("constants", "lateral"))
    reach = sum(lengths(core, arm)) + around / step
    words = 2.0 ** -(p["V"] + 1) * reach * (3 if axes else 2)  # half a unit of every rate
    want = speed(core, arm, case["angles"], case["rates"])
    names = case["names"]
    if core.function.startswith("velocity"):
        given = {axis: out[f"out_{axis}"] * step for axis in "xyz" if f"out_{axis}" in out}
        found = followed(text.after, names | given)
        w = [np.abs(names[f"w{i}"]) for i in range(1, 4 if axes else 3)]
        law = arm_bounds.velocity3(*w) if axes else arm_bounds.velocity2(*w)
        law = law * math.sqrt(3) + np.sum(w, axis=0)
    else:
        found = followed(text.after, names | {f"w{i}": out[f"out_w{i}"] * 2.0 ** -p["V"] for i in (1, 2, 3)
                                              if f"out_w{i}" in out})
        rates = {name: found.get(f"rate_{name}", 0 * rate) for name, rate in case["rates"].items()}
        found, fast = speed(core, arm, case["angles"], rates), np.linalg.norm(list(want.values()), axis=0) / step
        s = np.abs(out["out_w1"] + out["out_w2"]) * 2.0 ** -p["V"]
        w3 = np.abs(out.get("out_w3", 0 * s)) * 2.0 ** -p["V"]
        l1, l2 = lengths(core, arm)
        law = arm_bounds.rates3(p, l1, l2, s, w3, l1 + l2, fast) if axes else arm_bounds.rates2(p, l1, l2, s, fast)
        law = law + math.sqrt(3) / 2 + s + w3
        near = arm.file["singular"]  # no sample is so near: the thresholds by themselves
        assert abs(text.words["cfg_sine"] - math.sin(math.radians(near["elbow"])) * 2 ** p["U"]) <= 0.5
        assert not axes or abs(text.words["cfg_radius"] - near["axis"] / step) <= 0.5
        regular = out["out_status"] == 0
        assert regular.mean() > 0.5
        law = np.where(regular, law, np.inf)
    off = np.sqrt(sum((found[axis] - want[axis]) ** 2 for axis in want if axis in found and (
        axes or axis != "z"))) / step
    return off, law + words


# Velocities of six axes


def jacobian(arm: Machine, angles: dict[str, Floats]) -> Floats:
    """(N, 6, 6) velocity (mm) and turn (radians) of the flange for a rate of each joint of the machine."""
    step, columns = 1e-4, []
    here = arm.chain(angles, links=6)[:, :3, :3]
    for name, angle in angles.items():
        ahead, behind = (arm.chain(angles | {name: angle + sign * math.degrees(step)}, links=6) for sign in (1, -1))
        change = (ahead - behind)[:, :3] / (2 * step)
        spin = change[:, :, :3] @ np.swapaxes(here, 1, 2)
        columns.append(np.concatenate([change[:, :, 3], np.stack([spin[:, 2, 1], spin[:, 0, 2], spin[:, 1, 0]], 1)], 1))
    return np.stack(columns, axis=2)


def six_motion_case(core: Core, arm: Machine, text: Printed, rng: np.random.Generator) -> dict:
    unit = 2.0 ** -core.params["V"]
    angles = exact(text, core, arm.sample(FEW // 2, rng))
    rates = {name: np.rint(rng.uniform(-0.5, 0.5, FEW // 2) / unit) * unit for name in angles}
    names = followed(text.before, angles | {f"rate({name})": rate for name, rate in rates.items()})
    matrix, words = jacobian(arm, angles), joint_words(core, names)
    scale = np.repeat([lsb(core, arm), unit], 3)
    tip = (matrix @ np.stack(list(rates.values()), axis=1)[..., None])[..., 0]
    if core.function == "velocity6":
        words |= {f"in_w{i}": np.rint(names[f"w{i}"] / unit).astype(np.int64) for i in range(1, 7)}
    else:
        tip = np.rint(tip / scale) * scale
        words |= {f"in_{axis}": np.rint(tip[:, i] / scale[i]).astype(np.int64)
                  for i, axis in enumerate(("vx", "vy", "vz", "wx", "wy", "wz"))}
    q = np.radians(np.stack([names[f"j{i}"] for i in range(1, 6)] + [0 * names["j1"]], axis=1))
    return {"rates": rates, "tip": tip, "matrix": matrix, "q": q, "scale": scale, "words": words}


def six_velocity_judge(core: Core, arm: Machine, text: Printed, case: dict, out: dict) -> tuple[Floats, Floats]:
    found = np.stack([out[f"out_{axis}"] for axis in ("vx", "vy", "vz", "wx", "wy", "wz")], axis=1)
    rates = np.stack([case["words"][f"in_w{i}"] for i in range(1, 7)], axis=1) * 2.0 ** -core.params["V"]
    laws = six_bounds.velocity(core.params, seven(core, arm), rates)
    assert not out["out_status"].any()
    return (np.abs(found - case["tip"] / case["scale"]) / np.repeat(np.stack(laws, axis=1), 3, axis=1)).max(axis=1), \
        np.ones(len(found))


def six_rates_judge(core: Core, arm: Machine, text: Printed, case: dict, out: dict) -> tuple[Floats, Floats]:
    p, step = core.params, case["scale"][0]
    given = {f"w{i}": out[f"out_w{i}"] * 2.0 ** -p["V"] for i in range(1, 7)}
    known = followed(text.after, given)
    found = np.stack([known[f"rate_{name}"] for name in case["rates"]], axis=1)
    want = np.linalg.solve(case["matrix"], case["tip"][..., None])[..., 0]
    motion = case["tip"] / np.repeat([step, 1.0], 3)
    law = six_bounds.rates(p, seven(core, arm), case["q"], motion, np.abs(want))
    off = (np.abs(found - want) * 2.0 ** p["V"] / law).max(axis=1)
    near, k = arm.file["singular"], math.hypot(arm.key("links", "l2"), arm.key("constants", "elbow"))
    sine = math.sin(math.radians(near["elbow"]))
    for word, value in (("radius", near["axis"] / step), ("elbow", k * sine / step), ("sine", sine * 2 ** p["U"])):
        assert abs(text.words[f"cfg_{word}"] - value) <= 0.5
    regular = out["out_status"] == 0
    assert regular.mean() > 0.5
    return np.where(regular, off, 0), np.ones(len(off))


CASES = {"fk": forward_case, "ik": inverse_case, "keep": inverse_case, "six_fk": forward_case,
         "six_ik": six_inverse_case, "ur_fk": forward_case, "ur_ik": ur_inverse_case, "srs_ik": srs_case,
         "six_keep": six_inverse_case, "ur_keep": ur_inverse_case,
         "velocity": velocity_case, "rates": velocity_case,
         "six_velocity": six_motion_case, "six_rates": six_motion_case}
JUDGES = {"fk": forward_judge, "ik": inverse_judge, "keep": keep_judge, "six_fk": six_forward_judge,
          "six_ik": six_inverse_judge, "ur_fk": ur_forward_judge, "ur_ik": ur_inverse_judge, "srs_ik": srs_judge,
          "six_keep": eight_judge, "ur_keep": eight_judge,
          "velocity": velocity_judge, "rates": velocity_judge,
          "six_velocity": six_velocity_judge, "six_rates": six_rates_judge}


def test_every_other_core_refuses_an_arm() -> None:
    served = {core.name for core in CORES}
    for core in all_cores():
        if core.first_set and core.name not in served:
            found = printed(core, "kr6_r700")
            assert isinstance(found, str) and f"{core.name} takes no arm: " in found
