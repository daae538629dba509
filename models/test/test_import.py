"""`quadrance import`: what it makes of a robot, against the robot's own chain; what it refuses; that nobody gets in.

The oracle of a URDF is Pinocchio where it is installed, else a chain of matrices straight from the XML. The arm file
that comes out is read by `arms.load` and put together from the page's words, joint by joint.
"""

import contextlib
import importlib.util
import io
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
from dataclasses import replace
from functools import cache
from pathlib import Path
from xml.etree import ElementTree
from xml.sax.saxutils import quoteattr

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from quadrance import arms, codecs, cores
from quadrance.cli import catalogue, main
from quadrance.cli import urdf as cli_urdf

X, Y, Z = np.eye(3)
MM, RAD = 0.01, 1e-6
XACRO = pytest.mark.skipif(not importlib.util.find_spec("xacro"), reason="xacro is not installed")


def run(*arguments):
    """Exit code, output and errors of the command; a refusal is one line and prints nothing else."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            code = main([str(one) for one in arguments])
        except SystemExit as end:
            code = end.code
    if code:
        assert code == 2 and not out.getvalue() and err.getvalue().count("\n") == 1, err.getvalue()
        assert err.getvalue().startswith("quadrance")
    return code, out.getvalue(), err.getvalue()


def refused(*arguments):
    code, _, err = run(*arguments)
    assert code == 2
    return err


# Matrices


def move(x=0.0, y=0.0, z=0.0):
    found = np.eye(4)
    found[:3, 3] = x, y, z
    return found


def turn(axis, angle):
    """Rotation about an axis of any direction, right-handed (Rodrigues)."""
    x, y, z = np.array(axis, dtype=float) / np.linalg.norm(axis)
    cross, found = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]]), np.eye(4)
    found[:3, :3] += math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
    return found


@cache
def rpy(roll, pitch, yaw):
    return turn(Z, yaw) @ turn(Y, pitch) @ turn(X, roll)


def product(*some):
    found = np.eye(4)
    for one in some:
        found = found @ one
    return found


# The two sides


def chain_of(text, base, tip):
    """The joints' elements from base to tip."""
    above = {joint.find("child").get("link"): joint for joint in ElementTree.fromstring(text).findall("joint")}
    found = []
    while tip != base:
        found.append(above[tip])
        tip = above[tip].find("parent").get("link")
    return found[::-1]


def by_matrices(text, base, tip, q):
    """Pose (m) of the tip seen from the base at the joints' values by name, straight from the XML."""
    found = np.eye(4)
    for joint in chain_of(text, base, tip):
        numbers = {"xyz": "0 0 0", "rpy": "0 0 0"} | dict((joint.find("origin") if joint.find("origin") is not None
                                                           else ElementTree.Element("origin")).items())
        xyz, angles = ([float(one) for one in numbers[key].split()] for key in ("xyz", "rpy"))
        axis = [float(one) for one in joint.find("axis").get("xyz").split()] if joint.find("axis") is not None else X
        value, kind = q.get(joint.get("name"), 0.0), joint.get("type")
        found = found @ move(*xyz) @ rpy(*angles)
        found = found @ (move(*value * np.array(axis) / np.linalg.norm(axis)) if kind == "prismatic" else
                         np.eye(4) if kind == "fixed" else turn(axis, value))
    return found


def by_pinocchio(text, base, tip, samples):
    """The same by Pinocchio, for many values."""
    pinocchio = pytest.importorskip("pinocchio")
    model = pinocchio.buildModelFromXML(text)
    data = model.createData()
    for q in samples:
        joints = []
        for name in model.names[1:]:
            index, value = model.getJointId(name), q.get(name, 0.0)
            joints += [value] if model.joints[index].nq == 1 else [math.cos(value), math.sin(value)]
        pinocchio.framesForwardKinematics(model, data, np.array(joints))
        one, other = (data.oMf[model.getFrameId(link, pinocchio.FrameType.BODY)] for link in (base, tip))
        yield one.actInv(other).homogeneous


def oracle(text, base, tip, samples):
    """Poses (n, 4, 4), m, of the tip."""
    if importlib.util.find_spec("pinocchio"):
        return np.array(list(by_pinocchio(text, base, tip, samples)))
    return np.array([by_matrices(text, base, tip, q) for q in samples])


def frames_of(text, mark):
    """Frames (4, 4), mm, of base and tip, and the joints beside the arm, that lines with this mark say."""
    frames = {"base": np.eye(4), "tip": np.eye(4)}
    for name, xyz, angles in re.findall(rf"^{mark}(base|tip): .* = \[(.*)\] mm, rpy = \[(.*)\] degrees$", text,
                                        re.M):
        frames[name] = move(*map(float, xyz.split(","))) @ rpy(*np.radians([float(one) for one in angles.split(",")]))
    joint = rf"^{mark}joint '(.*)' \(.*\) (moves|turns) .* sign = (-?1), zero = (.*); no core"
    return frames, re.findall(joint, text, re.M)


def of_file(path, samples):
    """Poses (n, 4, 4), mm, that an imported file says, its table [frames] included."""
    arm, said = arms.load(path), tomllib.loads(Path(path).read_text()).get("frames", {})
    frames = {name: move(*said[name]["xyz"]) @ rpy(*np.radians(said[name]["rpy"])) if name in said else np.eye(4)
              for name in ("base", "tip")}
    rest = [(one["name"], {"along": "moves", "about": "turns"}[one["moves"]], one["sign"], one["zero"])
            for one in said.get("beside", ())]
    lean = math.radians(arm.elbow_angle)
    found = []
    for q in samples:
        at = {one.key: one.sign * q[one.name] + math.radians(one.zero) for one in arm.joints}
        if arm.yaws:  # about z, then upwards: about -y; the elbow's offset is to the left of the forearm
            pose = turn(Z, at["yaw"]) @ move(arm.shoulder, arm.lateral, arm.base) @ turn(-Y, at["shoulder"]) \
                @ turn(X, at.get("upper", 0.0)) \
                @ move(arm.l1) @ turn(-Y, at["elbow"]) @ move(arm.l2 * math.cos(lean), 0, arm.l2 * math.sin(lean))
            if arm.flange is not None:
                one, two, three = (at[key] for key in (("j5", "j6", "j7") if "upper" in at else ("j4", "j5", "j6")))
                pose = pose @ turn(Y, math.pi / 2) @ turn(Z, one) @ turn(Y, two) @ turn(Z, three) @ move(z=arm.flange)
            if arm.d6 is not None:  # frame 3 of the makers' table: x back along the forearm, z to the left
                pose = pose @ turn(Y, math.pi) @ turn(X, -math.pi / 2) @ turn(Z, at["j4"]) @ turn(X, math.pi / 2) \
                    @ turn(Z, at["j5"]) @ move(z=arm.d5) @ turn(X, -math.pi / 2) @ turn(Z, at["j6"]) @ move(z=arm.d6)
        else:
            pose = turn(Z, at["shoulder"]) @ move(arm.l1) @ turn(Z, at["elbow"]) @ move(arm.l2)
            pose = pose @ turn(Z, at["tool"]) @ move(arm.l3) if arm.l3 else pose
        for name, how, sign, zero in rest:
            pose = pose @ (move(z=1000 * int(sign) * q[name]) if how == "moves" else
                           turn(Z, int(sign) * q[name] + math.radians(float(zero))))
        found.append(frames["base"] @ pose @ frames["tip"])
    return np.array(found)


def off(one, other):
    """Largest distance, mm, and angle between poses in mm; of small angles the sine by the antisymmetric part."""
    between = np.swapaxes(one[:, :3, :3], 1, 2) @ other[:, :3, :3]
    sine = np.linalg.norm(between - np.swapaxes(between, 1, 2), axis=(1, 2)) / math.sqrt(8)
    angle = np.arctan2(sine, (np.trace(between, axis1=1, axis2=2) - 1) / 2)
    return np.linalg.norm(one[:, :3, 3] - other[:, :3, 3], axis=1).max(), angle.max()


def values(text, base, tip, count, seed=4):
    """Random values, rad or m, of the chain's joints by name."""
    rng = np.random.default_rng(seed)
    moving = [joint for joint in chain_of(text, base, tip) if joint.get("type") != "fixed"]
    return [{joint.get("name"): rng.uniform(-0.4, 0.4) if joint.get("type") == "prismatic" else
             rng.uniform(-math.pi, math.pi) for joint in moving} for _ in range(count)]


def difference(file, text, base, tip, count=1000):
    samples = values(text, base, tip, count)
    want = oracle(text, base, tip, samples)
    want[:, :3, 3] *= 1000
    return off(of_file(file, samples), want)


# Robots


def joint_(name, parent, child, kind="revolute", xyz=(0, 0, 0), angles=(0, 0, 0), axis=(0, 0, 1), limit=(-2.5, 2.0),
           more=""):
    """A joint of a URDF; numbers are written in full, a text as it is."""
    def text(some):
        return some if isinstance(some, str) else " ".join(repr(float(one)) for one in some)

    inside = "" if kind == "fixed" else f'<axis xyz="{text(axis)}"/>'
    inside += f'<limit lower="{limit[0]}" upper="{limit[1]}" effort="1" velocity="1"/>' \
        if kind in ("revolute", "prismatic") and limit else ""
    return f'<joint name={quoteattr(name)} type="{kind}"><parent link={quoteattr(parent)}/><child link=' \
           f'{quoteattr(child)}/><origin xyz="{text(xyz)}" rpy="{text(angles)}"/>{inside}{more}</joint>\n'


def robot(*joints, name="a robot"):
    links = dict.fromkeys(one for joint in joints for one in re.findall(r'link="([^"]*)"', joint))
    declared = "".join(f'<link name="{one}"/>\n' for one in links)
    return f'<?xml version="1.0"?>\n<robot name={quoteattr(name)}>\n{declared}{"".join(joints)}</robot>\n'


def grown(text, more):
    """The robot with more joints, and the links at their ends."""
    links = "".join(f'<link name="{one}"/>' for one in re.findall(r'child link="([^"]*)"', more))
    return text.replace("</robot>", more + links + "</robot>")


def scara(angles="0 0 0"):
    """A SCARA on a column that is turned by 45 degrees, the quill upside down behind a hidden fixed joint."""
    return robot(
        joint_("stand", "world", "column", "fixed", (0.3, -0.2, 0.1), (0, 0, math.pi / 4)),
        joint_("a", "column", "arm", xyz=(0, 0, 0.35)),
        joint_("hidden", "arm", "sleeve", "fixed", (0.125, 0.02, 0.01), (0.3, 0, 0)),
        joint_("b", "sleeve", "fore", xyz=(0.125, 0.0, 0.0), angles=(-0.3, 0, 0)),
        joint_("flip", "fore", "turned", "fixed", angles=angles),
        joint_("c", "turned", "quill", "prismatic", (0.18, 0, 0), limit=(0, 0.15)),
        joint_("d", "quill", "tool0", "continuous", (0, 0, 0.05)))


KR6 = robot(  # as kuka_experimental has it
    joint_("joint_a1", "base_link", "link_1", xyz=(0, 0, 0.4), axis=(0, 0, -1), limit=(-2.967, 2.967)),
    joint_("joint_a2", "link_1", "link_2", xyz=(0.025, 0, 0), axis=(0, 1, 0), limit=(-3.316, 0.785)),
    joint_("joint_a3", "link_2", "link_3", xyz=(0.315, 0, 0), axis=(0, 1, 0), limit=(-2.094, 2.722)),
    joint_("joint_a4", "link_3", "link_4", xyz=(0, 0, 0.035), axis=(-1, 0, 0), limit=(-3.228, 3.228)),
    joint_("joint_a5", "link_4", "link_5", xyz=(0.365, 0, 0), axis=(0, 1, 0), limit=(-2.094, 2.094)),
    joint_("joint_a6", "link_5", "link_6", xyz=(0.08, 0, 0), axis=(-1, 0, 0), limit=(-6.108, 6.108)),
    joint_("joint_a6-tool0", "link_6", "tool0", "fixed", angles=(0, math.pi / 2, 0)),
    joint_("base_link-base", "base_link", "base", "fixed"))

PUMA = robot(  # standard Denavit and Hartenberg of Corke's Puma560, a joint behind the fixed part of the one before
    joint_("q1", "b", "l1", xyz=(0, 0, 0.67183)),
    joint_("q2", "l1", "l2", angles=(math.pi / 2, 0, 0)),
    joint_("q3", "l2", "l3", xyz=(0.4318, 0, 0)),
    joint_("q4", "l3", "l4", xyz=(0.0203, 0, 0.15005), angles=(-math.pi / 2, 0, 0)),
    joint_("q5", "l4", "l5", xyz=(0, 0, 0.4318), angles=(math.pi / 2, 0, 0)),
    joint_("q6", "l5", "tip", angles=(-math.pi / 2, 0, 0)))

PLANAR = robot(  # in an upright plane, across a table
    joint_("one", "rail", "first", xyz=(0.1, 0.2, 0.3), axis=(0, -2, 0)),
    joint_("two", "first", "second", xyz=(0.2, 0.05, 0), axis=(0, 1, 0)),
    joint_("three", "second", "third", xyz=(0, 0.01, 0.15), axis=(0, 1, 0)),
    joint_("nose", "third", "point", "fixed", (0.05, 0, 0.05)))

LEG = robot(
    joint_("hip", "trunk", "h", "continuous", (0.18, 0.047, 0), axis=(1, 0, 0)),
    joint_("thigh", "h", "t", xyz=(0, 0.08, 0), axis=(0, 1, 0), limit=(-0.69, 4.5)),
    joint_("calf", "t", "c", xyz=(0, 0, -0.213), axis=(0, 1, 0), limit=(-2.8, -0.9)),
    joint_("foot", "c", "f", "fixed", (0, 0, -0.213)))

UR = robot(
    joint_("pan", "base_link", "s", xyz=(0, 0, 0.089159)), joint_("lift", "s", "u", xyz=(0, 0.13585, 0),
                                                                  angles=(0, math.pi / 2, 0), axis=(0, 1, 0)),
    joint_("elbow", "u", "f", xyz=(0, -0.1197, 0.425), axis=(0, 1, 0)),
    joint_("w1", "f", "v", xyz=(0, 0, 0.39225), angles=(0, math.pi / 2, 0), axis=(0, 1, 0)),
    joint_("w2", "v", "w", xyz=(0, 0.093, 0)), joint_("w3", "w", "ee", xyz=(0, 0, 0.09465), axis=(0, 1, 0)))
IIWA = robot(  # as iiwa_stack has it; the axes 5 and 7 are drawn beside the wrist's centre
    joint_("base", "world", "link_0", "fixed"), *(
        joint_(f"A{i}", f"link_{i - 1}", f"link_{i}", xyz=xyz, angles=np.multiply(quarters, math.pi / 2),
               limit=(-math.radians(most), math.radians(most))) for i, (xyz, quarters, most) in enumerate((
                   ((0, 0, 0.15), (0, 0, 0), 170), ((0, 0, 0.19), (1, 0, 2), 120), ((0, 0.21, 0), (1, 0, 2), 170),
                   ((0, 0, 0.19), (1, 0, 0), 120), ((0, 0.21, 0), (-1, 2, 0), 170), ((0, 0.0607, 0.19), (1, 0, 0), 120),
                   ((0, 0.081, 0.0607), (-1, 2, 0), 175)), 1)),
    joint_("flange", "link_7", "ee", "fixed", (0, 0, 0.045)))


def turned_round(text, *numbers):
    """Some axes in the other sense."""
    for i in numbers:
        before, name, after = text.partition(f'name="A{i}"')
        text = before + name + after.replace('xyz="0.0 0.0 1.0"', 'xyz="0 0 -1"', 1)
    return text


def mounted(text, xyz=(0, 0, 0), angles=(0, 0, 0)):
    """The iiwa on a base that is moved and turned."""
    def numbers(some):
        return " ".join(repr(float(one)) for one in some)

    return text.replace('xyz="0.0 0.0 0.0" rpy="0.0 0.0 0.0"', f'xyz="{numbers(xyz)}" rpy="{numbers(angles)}"', 1)


MOUNT = joint_("mount", "floor", "base_link", "fixed", (0.3, -0.1, 0.2), (0.3, 1.2, -2))
GRIP = joint_("grip", "tool0", "pen", "fixed", (0.02, -0.03, 0.1), (0.1, 0.2, 0.3))
LEAN = joint_("lean", "tool0", "pen", "fixed", angles=(0.7, 0, 0))
ROBOTS = {"scara": (scara((math.pi, 0, 0)), "world", "tool0", "a SCARA"),
          "leaning scara": (grown(scara(), LEAN), "world", "pen", "a SCARA"),
          "kr6": (KR6, "base_link", "tool0", "an ortho-parallel arm with a spherical wrist"),
          "mounted kr6": (grown(KR6.replace("</robot>", MOUNT + '<link name="floor"/></robot>'), GRIP), "floor", "pen",
                          "an ortho-parallel arm with a spherical wrist"),
          "puma": (PUMA, "b", "tip", "an ortho-parallel arm with a spherical wrist"),
          "planar": (PLANAR, "rail", "point", "a planar arm"),
          "leg": (LEG, "trunk", "f", "a yaw with two links"),
          "ur": (UR, "base_link", "ee", "an arm with three parallel axes"),
          "leaning": (UR.replace('rpy="0.0 0.0 0.0"', 'rpy="0.2 0.1 -0.3"', 1).replace("0.093", "-0.093").replace(
              '<axis xyz="0.0 0.0 1.0"/>', '<axis xyz="0 0 -1"/>'), "base_link", "ee",
                      "an arm with three parallel axes"),
          "iiwa": (IIWA, "world", "ee", "an S-R-S arm"),
          "hanging iiwa": (mounted(IIWA, (0.1, 0.2, 1.5), (math.pi, 0, 0)), "world", "ee", "an S-R-S arm"),
          "iiwa on a wall": (mounted(IIWA, (0, 0.3, 1), (0, math.pi / 2, math.pi / 4)), "world", "ee", "an S-R-S arm"),
          # turned by 45 degrees, bent at zero, axes 2, 3 and 6 the other way round, a hidden joint, the tip aside
          "odd iiwa": (mounted(turned_round(IIWA, 2, 3, 6), (0.4, 0, 0), (0, 0, math.pi / 4)).replace(
              'link="link_3"/><origin xyz="0.0 0.0 0.19" rpy="1.5707963267948966 0.0 0.0"',
              'link="link_3"/><origin xyz="0.0 0.0 0.19" rpy="1.5707963267948966 0.0 0.8"').replace(
              '<parent link="link_6"/>', '<parent link="hidden"/>').replace('xyz="0.0 0.0 0.045"',
                                                                           'xyz="0.01 0.02 0.045"').replace(
              "</robot>", joint_("more", "link_6", "hidden", "fixed") + '<link name="hidden"/></robot>'),
                       "world", "ee", "an S-R-S arm")}


@pytest.fixture
def urdf(tmp_path):
    """Write a robot; its path."""
    def write(text, name="robot.urdf"):
        (tmp_path / name).write_text(text)
        return tmp_path / name
    return write


@pytest.mark.parametrize("name", ROBOTS)
def test_an_imported_arm_is_the_robot(urdf, tmp_path, name):
    text, base, tip, kind = ROBOTS[name]
    file = tmp_path / "arm.toml"
    assert kind in run("import", urdf(text), "--base", base, "--tip", tip, "--out", file)[1]
    assert file.read_text().startswith(f"# {kind}: within") and 'name = "a robot"' in file.read_text()
    mm, rad = difference(file, text, base, tip)
    assert mm < MM and rad < RAD
    printed = run("import", urdf(text), "--base", base, "--tip", tip)[1]
    assert printed == file.read_text() == run("import", urdf(text))[1], "one root, one end that moves"


@pytest.mark.parametrize("name", ROBOTS)
def test_the_matrices_are_pinocchio(name):
    text, base, tip, _ = ROBOTS[name]
    samples = values(text, base, tip, 50)
    own = np.array([by_matrices(text, base, tip, q) for q in samples])
    assert np.allclose(own, list(by_pinocchio(text, base, tip, samples)), atol=1e-12)


@pytest.mark.parametrize(("name", "cores"), [
    ("scara", ("table_ik2", "rational_fk2")), ("kr6", ("vector_ik6", "table_fk6", "arm_ik3")),
    ("puma", ("vector_ik6_all", "arm_fk3")), ("planar", ("table_ik3r", "vector_ik2")),
    ("leg", ("arm_ik3", "table_ik3")), ("ur", ("vector_ur_ik", "vector_ur_fk", "vector_ur_ik_all", "arm_ik3")),
    ("iiwa", ("vector_srs_ik", "table_srs_ik")), ("odd iiwa", ("vector_srs_ik",))])
def test_an_imported_arm_goes_through_the_commands(urdf, tmp_path, name, cores):
    file = tmp_path / "arm.toml"
    run("import", urdf(ROBOTS[name][0]), "--out", file)
    assert run("check", file)[1].startswith("a robot: right\n") and "raise" not in run("check", file)[1]
    assert "advice   mm_per_unit" not in run("check", file)[1]
    for core in cores:
        assert f"{core} #(" in run("instance", core, "--arm", file)[1]
    assert "units, 100.0000 mm" in run("encode", "coordinate:32.20", "100", "--arm", file)[1]


def followed(text, where, known):
    """The names of `known` after the assignments in front of the core or behind it, angles in degrees."""
    steps = ";  ".join(re.findall(rf"^//   {where} +(.*)$", text, re.M)).split(";  ")
    functions = {"cos": lambda x: np.cos(np.radians(x)), "sin": lambda x: np.sin(np.radians(x)), "sqrt": np.sqrt,
                 "hypot": np.hypot, "atan2": lambda y, x: np.degrees(np.arctan2(y, x))}
    for name, formula in (step.split(" = ") for step in steps if step):
        known = known | {name: eval(formula, {"__builtins__": {}}, functions | known)}
    return known


def as_said(text, robot, own, q):
    """The robot's pose (4, 4) as the instance says it, and the core's, its joints beside the arm at q (degrees, m)."""
    said, rest = frames_of(text, "//   frame  ")
    joints = product(*(move(z=1000 * int(sign) * q[name]) if how == "moves" else
                       turn(Z, math.radians(int(sign) * q[name] + float(zero))) for name, how, sign, zero in rest))
    parts = {"base": said["base"], "tip": said["tip"], "(the joints above)": joints, "(the core's)": own,
             "(the robot's)": robot}
    rule = re.search(r"^//   frame  the (?:robot's pose|core's target) = (.*)$", text, re.M)[1].split(" * ")
    return product(*(np.linalg.inv(parts[one[:-3]]) if one.endswith("^-1") else parts[one] for one in rule))


PLACES, TURNS = ("x", "y", "z"), [f"r{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)]


@pytest.mark.parametrize(("name", "core"), [
    ("scara", "table_fk2"), ("leaning scara", "vector_fk2"), ("leg", "table_fk3"), ("mounted kr6", "vector_fk6"),
    ("mounted kr6", "arm_fk3"), ("leaning", "vector_ur_fk")])
def test_what_an_instance_says_of_frames_is_the_chain(urdf, tmp_path, name, core):
    """Forward: joints of the robot, through the formulas and the core's model, and its frames: the robot's pose."""
    text, base, tip, _ = ROBOTS[name]
    run("import", urdf(text), "--base", base, "--tip", tip, "--out", tmp_path / "arm.toml")
    said = json.loads(run("instance", core, "--arm", tmp_path / "arm.toml", "--json")[1])
    core, arm = catalogue.find(core, said["params"]), arms.load(tmp_path / "arm.toml")
    lsb, samples = arm.mm_per_unit / 2 ** core.params["F"], values(text, base, tip, 40)
    want = oracle(text, base, tip, samples)
    for q, robot in zip(samples, want):
        robot[:3, 3] *= 1000
        q = {key: value if key == "c" else math.degrees(value) for key, value in q.items()}
        seen = followed(said["verilog"], "before", q)
        words = {}
        for i, ports in enumerate(cores.joints(core.inputs), 1):
            kind, bits = ports[0].type, ports[0].width - 2 * (ports[0].type != "angle")
            words |= zip((port.name for port in ports), np.atleast_2d(codecs.from_degrees(kind, bits, [seen[f"j{i}"]])))
        out = core.model(core.params, **words, **said["cfg"])
        own = np.eye(4)
        place = {one: float(out[f"out_{one}"][0]) * lsb for one in PLACES if f"out_{one}" in out}
        place = followed(said["verilog"], "after", seen | place)
        own[:3, 3] = [place.get(one, 0.0) for one in PLACES]
        turned = "out_r11" in out
        if turned:
            own[:3, :3] = np.reshape([float(out[f"out_{one}"][0]) for one in TURNS], (3, 3)) / 2 ** core.params["U"]
        if core.name == "arm_fk3":
            assert "this core ends at the wrist, and tip is behind it" in said["verilog"]
            robot = robot @ np.linalg.inv(frames_of(said["verilog"], "//   frame  ")[0]["tip"]) @ move(z=-arm.flange)
        found = as_said(said["verilog"], robot, own, q)
        assert np.linalg.norm(found[:3, 3] - robot[:3, 3]) < 8 * lsb
        assert not turned or np.abs(found[:3, :3] - robot[:3, :3]).max() < 1e-3


@pytest.mark.parametrize(("name", "core"), [
    ("scara", "table_ik2"), ("leaning scara", "vector_ik2"), ("planar", "table_ik3r"), ("leg", "table_ik3"),
    ("mounted kr6", "vector_ik6"), ("leaning", "vector_ur_ik"), ("odd iiwa", "vector_srs_ik"),
    ("iiwa on a wall", "table_srs_ik")])
def test_a_target_of_the_robot_is_reached_as_an_instance_says(urdf, tmp_path, name, core):
    """Inverse: a pose of the robot, its frames taken off, through the core's model: joints that are there again."""
    text, base, tip, _ = ROBOTS[name]
    run("import", urdf(text), "--base", base, "--tip", tip, "--out", tmp_path / "arm.toml")
    said = json.loads(run("instance", core, "--arm", tmp_path / "arm.toml", "--json")[1])
    core, scale, off_by = catalogue.find(core, said["params"]), arms.load(tmp_path / "arm.toml").mm_per_unit, []
    samples = values(text, base, tip, 40)
    want = oracle(text, base, tip, samples)
    want[:, :3, 3] *= 1000
    for q, robot in zip(samples, want):
        degrees = {key: value if key == "c" else math.degrees(value) for key, value in q.items()}
        own = as_said(said["verilog"], robot, None, degrees)
        place = followed(said["verilog"], "before", dict(zip(PLACES, own[:3, 3])))
        words = {f"in_{one}": [round(place[one] / scale * 2 ** core.params["F"])] for one in PLACES}
        words |= {f"in_{one}": [round(value * 2 ** core.params.get("U", 16))] for one, value in zip(
            TURNS, own[:3, :3].ravel())}
        turn_of = math.degrees(math.atan2(own[1, 0], own[0, 0]))
        words |= {"in_cs": [1 << 16], "in_ns": [0], "in_elbow": [0], "in_branch": [0],
                  "in_phi": codecs.from_degrees("angle", core.params.get("A", 16), [turn_of])}
        out = core.model(core.params, **{port.name: words[port.name] for port in core.inputs}, **said["cfg"])
        joints = {}
        for i, ports in enumerate(cores.joints(core.outputs), 1):
            kind, bits = ports[0].type, ports[0].width - 2 * (ports[0].type != "angle")
            found = [out[port.name] for port in ports]
            joints[f"j{i}"] = float(codecs.to_degrees(kind, bits, found if len(found) > 1 else found[0])[0])
        machine = followed(said["verilog"], "after", place | joints)
        again = q | {key: math.radians(machine[key]) for key in q if key in machine}
        again = by_matrices(text, base, tip, again)
        off_by.append(np.linalg.norm(1000 * again[:3, 3] - robot[:3, 3]))
    assert np.quantile(off_by, 0.8) < 6 * scale / 2 ** core.params["F"], sorted(off_by)


def test_frames_of_a_file_are_said_and_wrong_ones_refused(urdf, tmp_path):
    """`check`, the header in C and VHDL say the table [frames]; a wrong key or value is refused by all; comments say
    nothing.
    """
    run("import", urdf(scara((math.pi, 0, 0))), "--out", file := tmp_path / "arm.toml")
    good = file.read_text()
    assert len(re.findall(r"^  frame    (?:base|tip|joint '[cd]')", run("check", file)[1], re.M)) == 4
    assert json.loads(run("check", file, "--json")[1])["frames"][0].startswith("base: the cores' frame seen from '")
    for form, start in (("c", "/*"), ("vhdl", "--")):
        assert f"{start}   frame  base: " in run("instance", "table_ik2", "--arm", file, "--format", form)[1]
    run("registers", "table_ik2", "--arm", file, "--out", tmp_path / "hw")
    assert "/* base: the cores' frame seen from 'world': xyz = [300" in (tmp_path / "hw" / "table_ik2.h").read_text()
    head, _, table = good.partition("[frames]\n")
    file.write_text(head + "# base frame: the cores' frame seen from 'world': xyz = [1.0, 0.0, 0.0] mm, "
                    "rpy = [0.0, 0.0, 0.0] degrees\n")
    assert "  frame" not in run("check", file)[1] and table
    assert "name = \"c\", moves = \"along\"" in good and "name = \"d\", moves = \"about\"" in good
    for old, new, why in (
            ("[300.0,", "[true,", "frames.base.xyz: must be three numbers of at most 1e+09, not [True"),
            ("[300.0,", "[nan,", "frames.base.xyz: must be three numbers"),
            ("[300.0,", "[", "frames.base.xyz: must be three numbers"),
            ("[300.0,", "[1e300,", "frames.base.xyz: must be three numbers"),
            ("xyz = [300.0", "xy = [300.0", "frames.base.xy: is not a key"),
            ('"world"', '""', "frames.base.link: must not be empty"),
            ('"world"', '"a\\nb"', "frames.base.link: must be one line of text"),
            ("base = {", "foot = {", "frames.foot: is not a key"),
            ('"along"', '"across"', 'frames.beside[1].moves: must be "along" or "about", of z, not \'across\''),
            ('name = "d", moves', 'name = "d", sort', "frames.beside[0].sort: is not a key"),
            ("beside = [", "beside = [1, ", "frames.beside[0]: must be a table, not 1"),
            ("sign = -1, zero", "sign = -2, zero", "must be 1 or -1, not -2")):
        assert old in table, old
        file.write_text(head + "[frames]\n" + table.replace(old, new, 1))
        for command in (("check", file), ("instance", "table_ik2", "--arm", file)):
            assert "arm.toml: " in refused(*command) and why in refused(*command), why


def test_kr6_is_the_arm_of_the_library(urdf, tmp_path):
    """But for the joints that the makers of the two files named otherwise, and for limits in whole degrees."""
    run("import", urdf(KR6), "--out", tmp_path / "kr6.toml")
    ours, theirs = arms.load(tmp_path / "kr6.toml"), arms.load("kr6_r700")
    for key in ("l1", "l2", "base", "shoulder", "lateral", "elbow", "flange", "mm_per_unit"):
        assert getattr(ours, key) == pytest.approx(getattr(theirs, key), abs=1e-6), key
    assert [(one.key, one.sign, one.zero) for one in ours.joints] == [(one.key, one.sign, one.zero) for one in
                                                                      theirs.joints]
    assert np.allclose(ours.limits[0::2], theirs.limits[0::2], atol=0.1)
    assert ours.limits[1] == pytest.approx((-155.96 + 5.477, 119.98 + 5.477), abs=0.01), "to the line of L2"


def same(ours, theirs):
    """Two arms are equal but for their names."""
    for key in ("l1", "l2", "base", "shoulder", "lateral", "elbow", "flange", "d5", "d6", "mm_per_unit", "spherical"):
        assert getattr(ours, key) == pytest.approx(getattr(theirs, key), abs=1e-6), key
    for one, other in zip(ours.joints, theirs.joints, strict=True):  # a file of the library may leave limits out
        assert replace(one, limits=None) == replace(other, limits=None, speed=None)
        assert other.limits is None or one.limits == pytest.approx(other.limits)
    assert np.allclose(ours.limits, theirs.limits) and ours.upper_limit == pytest.approx(theirs.upper_limit)


@pytest.mark.parametrize("pi", ("3.141592653589793", "3.1416", "3.14159"))
def test_iiwa_is_the_arm_of_the_library(urdf, tmp_path, pi):
    text = IIWA.replace("3.141592653589793", pi).replace("1.5707963267948966", f"{round(float(pi) / 2, len(pi) - 2)}")
    said = run("import", urdf(text), "--out", tmp_path / "iiwa.toml")[1]
    same(arms.load(tmp_path / "iiwa.toml"), arms.load("iiwa7"))
    assert ("# rounded: " in (tmp_path / "iiwa.toml").read_text()) == (len(pi) < 10), said


def test_ur5e_is_the_arm_of_the_library(urdf, tmp_path):
    """By its maker's table; a full turn is kept of two."""
    rows = ((162.5, 0, 90), (0, -425, 0), (0, -392.2, 0), (133.3, 0, 90), (99.7, 0, -90), (99.6, 0, 0))
    table = 'convention = "standard"\n' + "".join(
        f'[[joint]]\nname = "{one}"\nd = {d}\na = {a}\nalpha = {alpha}\nlimits = [-360, 360]\n'
        for one, (d, a, alpha) in zip(("base", "shoulder", "elbow", "wrist1", "wrist2", "wrist3"), rows))
    run("import", "--dh", urdf(table, "table.toml"), "--out", tmp_path / "ur.toml")
    same(arms.load(tmp_path / "ur.toml"), arms.load("ur5e"))


@pytest.mark.parametrize("pi", ("3.1416", "3.14159", "3.1415", "3.141592654", "-3.1416"))
def test_a_rounded_pi_is_meant(urdf, tmp_path, pi):
    """Right against the robot that was meant; the file says how far the robot as it is written is from that."""
    file, exact = tmp_path / "arm.toml", scara((math.copysign(math.pi, float(pi)), 0, 0))
    run("import", urdf(scara(f"{pi} 0 0")), "--out", file)
    mm, rad = difference(file, exact, "world", "tool0")
    assert mm < MM and rad < RAD
    note = re.search(rf"^# rounded: {pi} stand.* (\S+) mm and (\S+) rad elsewhere$", file.read_text(), re.M)
    assert bool(note) == (len(pi) < 10)
    mm, rad = difference(file, scara(f"{pi} 0 0"), "world", "tool0")
    if note:
        assert float(note[2]) == pytest.approx(abs(float(pi)) - math.pi if float(pi) > 3.1416 else
                                               abs(abs(float(pi)) - math.pi), rel=0.05)
        assert mm <= 1.2 * float(note[1]) and rad <= 1.2 * float(note[2])
    else:
        assert mm < MM and rad < RAD


@pytest.mark.parametrize(("angles", "reason"), [
    ("3.14 0 0", "not a SCARA: axes 1 and 4 are 0.09125 degrees from parallel"),
    ("3.1415000001 0 0", "nearly a SCARA, but not within 0.01 mm and 1e-06 rad"),  # is no rounded pi
    ("3.14159665 0 0", "axes 1 and 4 are 0.0002"),
    ("1.5708 0 0", "not a SCARA: axes 1 and 4 are 90 degrees from parallel")])
def test_what_is_not_quite_a_kind_is_refused_with_the_distance(urdf, angles, reason):
    assert reason in refused("import", urdf(scara(angles)))


def wrist(offset=(0.0, 0.0, 0.0), tilt=0.0):
    return KR6.replace('"0.365 0.0 0.0"', f'"0.365 {offset[1]!r} {offset[2]!r}"').replace(
        'xyz="0.08 0.0 0.0" rpy="0.0 0.0 0.0"', f'xyz="0.08 {offset[0]!r} 0.0" rpy="0.0 0.0 {tilt!r}"')


def aside(joint, offset=0.0, tilt=0.0):
    """The iiwa with a joint's axis moved, m, across itself and the one before, or leaning towards that one, rad."""
    before, name, after = IIWA.partition(f'name="A{joint}"')
    xyz, angles = (tuple(map(float, re.search(key + r'="([^"]*)"', after)[1].split())) for key in ("xyz", "rpy"))
    roll = math.copysign(abs(angles[0]) - tilt, angles[0])
    return before + name + re.sub('xyz="[^"]*" rpy="[^"]*"', f'xyz="{xyz[0] + offset!r} {xyz[1]!r} {xyz[2]!r}" '
                                  f'rpy="{roll!r} {angles[1]!r} {angles[2]!r}"', after, count=1)


@pytest.mark.parametrize(("text", "reason"), [
    (wrist((0.0, 0.0, 0.0531)), "is not an ortho-parallel arm with a spherical wrist: axes 4, 5 and 6 miss a common "
                                "point by 53.1 mm"),
    (wrist((0.0005, 0.0, 0.0)), "nearly an ortho-parallel arm with a spherical wrist, but not within 0.01 mm and 1e-06 "
     "rad: the tip would be off by"),
    (wrist((0.00003, 0.0, 0.0)), "axes 4, 5 and 6 miss a common point by 0.03 mm"),
    (wrist(tilt=0.01), "is not an ortho-parallel arm with a spherical wrist: axes 5 and 6 are 0.573 degrees from"),
    (wrist(tilt=1e-5), "would be off by 0.0"),
    (UR.replace('xyz="0.0 0.093 0.0"', 'xyz="0.02 0.093 0.0"'),
     "it is not an arm with three parallel axes: axes 4 and 5 miss each other by 20 mm"),
    (aside(4, 0.0825), "it is not an S-R-S arm: axes 3, 4 and 5 miss a common point by 82.5 mm"),  # as Panda's elbow
    (aside(7, 0.088), "it is not an S-R-S arm: axes 5, 6 and 7 miss a common point by 88 mm"),  # as Panda's wrist
    (aside(2, 0.05), "it is not an S-R-S arm: axes 1, 2 and 3 miss a common point by 50 mm"),
    (aside(4, 0.0003), "nearly an S-R-S arm, but not within 0.01 mm and 1e-06 rad: the tip would be off by"),
    (aside(4, 0.0003), "axes 3, 4 and 5 miss a common point by 0.3 mm"),
    *((aside(i, tilt=0.01), f"it is not an S-R-S arm: axes {i - 1} and {i} are 0.573 degrees from right angles")
      for i in range(2, 8)),
    (aside(5, tilt=1e-5), "would be off by 0.0"),
    (KR6.replace('joint_a6" type="revolute', 'joint_a6" type="prismatic'),
     "6 joints move (RRRRRP; R turns, P slides), and cores are for RR, RRR"),
    (scara().replace('"b" type="revolute"', '"b" type="prismatic"'), "4 joints move (RPPR"),
    (KR6.replace('<axis xyz="0.0 1.0 0.0"/>', '<axis xyz="0.0 1.0 0.0"/><mimic joint="joint_a1"/>', 1),
     "joint 'joint_a2' follows 'joint_a1' (mimic): it is no joint of its own"),
    (KR6.replace('joint_a3" type="revolute', 'joint_a3" type="floating'), "joint 'joint_a3' is 'floating'"),
    (KR6.replace('<axis xyz="0.0 1.0 0.0"/>', '<axis xyz="0 0 0"/>', 1), "its axis has no direction"),
    (KR6.replace('<axis xyz="0.0 1.0 0.0"/>', '<axis yz="0.0 1.0 0.0"/>', 1), "its axis has no xyz"),
    (KR6.replace('" rpy="', '" ryp="', 1), "its origin has 'ryp', and xyz and rpy alone are read"),
    (KR6.replace('lower="-2.967"', 'lower="3"'), "its lower limit 3 is not below its upper limit 2.967"),
    (KR6.replace("0.315 ", "nan ", 1), "xyz must be 3 finite numbers of a robot's size, not 'nan 0.0 0.0'"),
    (KR6.replace("0.315 0.0", "1e4 0.0", 1), "of a robot's size, not '1e4 0.0 0.0'"),
    (KR6.replace("0.315 0.0 ", "0.3_15 0.0 ", 1), "of a robot's size"),
    (KR6.replace("0.315 0.0 ", "0.315 ", 1), "3 finite numbers"),
    (KR6.replace('name="joint_a3"', 'name="joint_a2"'), "two joints have one name"),
    (KR6.replace('name="joint_a3"', 'name="a&#10;3"'), r"'a\n3' cannot be the name of a joint"),
    (KR6.replace("link_4", " "), "' ' cannot be the name of a link"),
    (KR6.replace('child link="tool0"', 'child link="link_2"'), "'link_2' is the child of two joints"),
    (KR6.replace('parent link="base_link"', 'parent link="link_6"'), "give --base; there are no joints"),
    (KR6.replace("</robot>", joint_("more", "link_6", "gripper", "fixed") + "</robot>"),
     "give --tip; there are tool0, gripper"),
    (robot(joint_("f", "a", "b", "fixed")), "give --tip; there are no joints"),
    (PLANAR.replace("0.2 0.05 0.0", "0 0 0"), "links.l1: must be positive, not 0"),
    ("<sdf/>", "is no URDF: its root is 'sdf', not 'robot'"), ("", "not XML: no element found"),
    ("<robot><joint>", "not XML"), ("<robot/>", "give --base; there are no joints")])
def test_a_robot_without_a_core_or_without_sense_is_refused(urdf, text, reason):
    assert reason in refused("import", urdf(text))


def test_a_branching_tree_has_the_chain_that_is_asked_for(urdf, tmp_path):
    """The mimic joint and the slide are beside the chain; a nearer tip leaves the wrist out."""
    text = grown(KR6, joint_("left", "link_6", "l", "prismatic", limit=(0, 1)) + joint_(
        "right", "link_6", "r", "prismatic", limit=(0, 1), more='<mimic joint="left"/>') + joint_(
        "head", "link_1", "camera"))
    assert "give --tip; there are tool0, l, r, camera" in refused("import", urdf(text))
    file = tmp_path / "three.toml"
    assert "4 joints move (RRRR;" in refused("import", urdf(text), "--tip", "link_4", "--out", file)
    text = grown(text, joint_("end", "link_3", "wrist", "fixed", (0.365, 0, 0.035)))
    run("import", urdf(text), "--tip", "wrist", "--out", file)
    assert arms.load(file).axes == 3 and max(difference(file, text, "base_link", "wrist")) < RAD
    assert arms.load(file).l2 == pytest.approx(math.hypot(365, 35))


@pytest.mark.parametrize(("arguments", "reason"), [
    (("--tip", "tool"), "no link 'tool'; did you mean tool0"), (("--base", "lnk_1"), "no link 'lnk_1'; did you mean"),
    (("--base", "tool0"), "give --tip; there are no joints"), (("--base", ""), "no link ''"),
    (("--base", "link_3", "--tip", "link_2"), "no chain of joints leads from 'link_3' to 'link_2'"),
    (("--base", "link_1"), "5 joints move (RRRRR"), (("--dh", "x.toml"), "import takes one robot"),
    (("--out", "x.urdf"), "the name of an arm file ends in .toml"),
    (("--out", "no/such/folder/x.toml"), "cannot be written: No such file")])
def test_wrong_arguments_are_refused(urdf, arguments, reason):
    assert reason in refused("import", urdf(KR6), *arguments)


def test_no_robot_or_no_file_is_refused(tmp_path):
    assert "import takes one robot" in refused("import")
    assert "cannot be read: No such file" in refused("import", tmp_path / "none.urdf")
    assert "belong to a URDF" in refused("import", "--dh", "x", "--tip", "y")
    assert "a b.urdf: cannot be read" in refused("import", "a\nb.urdf"), "one line, whatever it was called with"


def test_nothing_is_overwritten(urdf, tmp_path):
    file = tmp_path / "arm.toml"
    file.write_text("mine")
    assert "arm.toml exists and is not overwritten" in refused("import", urdf(KR6), "--out", file)
    assert file.read_text() == "mine"
    (tmp_path / "there.toml").symlink_to(tmp_path / "new")
    refused("import", urdf(KR6), "--out", tmp_path / "there.toml")
    assert not (tmp_path / "new").exists()


def test_limits_are_those_of_the_cores(urdf, tmp_path):
    """The joint's own ends, through sign and zero, their middle within half a turn; a joint without has a turn."""
    for name, (text, base, tip, _) in ROBOTS.items():
        file = tmp_path / f"{name}.toml"
        run("import", urdf(text), "--out", file)
        arm = arms.load(file)
        own = {joint.get("name"): joint.find("limit") for joint in chain_of(text, base, tip)}
        for key, pair in zip(("shoulder", "elbow", "yaw", "upper"), (*arm.limits, arm.upper_limit)):
            joint = arm.joint(key)
            if pair is None:
                continue
            if own[joint.name] is None:
                assert pair == (-180, 180)
                continue
            ends = sorted(joint.sign * math.degrees(float(own[joint.name].get(end))) + joint.zero
                          + arm.elbow_angle * (key == "elbow") for end in ("lower", "upper"))
            if ends[1] - ends[0] < 360:
                assert pair == pytest.approx(ends, abs=1e-5) and abs(sum(pair)) <= 360


# Denavit and Hartenberg

DH = {"standard": """
convention = "standard"
name = "p"
joint = [{name = "q1", d = 671.83, alpha = 90, limits = [-160, 160]}, {name = "q2", a = 431.8},
  {name = "q3", a = 20.3, d = 150.05, alpha = -90}, {name = "q4", d = 431.8, alpha = 90}, {name = "q5", alpha = -90},
  {name = "q6"}]
""", "modified": """
convention = "modified"
[[joint]]
name = "J1"
d = 320
[[joint]]
name = "J2"
alpha = -90
theta = -90
d = 35.0
[[joint]]
name = "J3"
a = 225
theta = -90
[[joint]]
name = "J4"
alpha = -90
d = 225
[[joint]]
name = "J5"
alpha = 90
[[joint]]
name = "J6"
alpha = -90
theta = 180
d = 65
""", "slides": """
convention = "standard"
joint = [{name = "a", a = 250}, {name = "b", a = 150, alpha = 180}, {name = "c", slides = true, limits = [0, 120]},
  {name = "d"}]
"""}
ROWS = {"standard": [(671.83, 0, 90, 0), (0, 431.8, 0, 0), (150.05, 20.3, -90, 0), (431.8, 0, 90, 0), (0, 0, -90, 0),
                     (0, 0, 0, 0)],
        "modified": [(320, 0, 0, 0), (35, 0, -90, -90), (0, 225, 0, -90), (225, 0, -90, 0), (0, 0, 90, 0),
                     (65, 0, -90, 180)],
        "slides": [(0, 250, 0, 0), (0, 150, 180, 0), (0, 0, 0, 0), (0, 0, 0, 0)]}


@pytest.mark.parametrize("name", DH)
def test_a_table_of_denavit_and_hartenberg(urdf, tmp_path, name):
    table, file = urdf(DH[name], "table.toml"), tmp_path / "arm.toml"
    run("import", "--dh", table, "--out", file)
    names = re.findall(r'name = "(\w\d?)"[,}\n]', DH[name].replace('name = "p"', ""))
    rng, want, samples = np.random.default_rng(5), [], []
    for _ in range(1000):
        q = rng.uniform(-math.pi, math.pi, len(names))
        found = np.eye(4)
        for one, (d, a, alpha, theta), value in zip(names, ROWS[name], q):
            slides = (name, one) == ("slides", "c")
            screw = move(z=d + 1000 * value * slides) @ turn(Z, math.radians(theta) + value * (not slides))
            twist = turn(X, math.radians(alpha)) @ move(a)
            found = found @ (twist @ screw if name == "modified" else screw @ twist)
        want.append(found)
        samples.append(dict(zip(names, q)))
    mm, rad = off(of_file(file, samples), np.array(want))
    assert mm < MM and rad < RAD
    assert "right\n" in run("check", file)[1]


@pytest.mark.parametrize(("old", "new", "reason"), [
    ('"standard"', '"other"', 'it has convention = "standard" or'), ("d = 431.8", "e = 4", "its keys are"),
    ("d = 431.8", 'd = "431.8"', "joint 4: slides is true or false"), ("d = 431.8", "d = nan", "finite numbers"),
    ("d = 431.8", "d = 1e300", "of a robot's size"), ('"q4"', '"q3"', "two joints have one name"),
    ("[-160, 160]", "[160]", "limits are two numbers"), ("[-160, 160]", "[1, -1]", "is not below its upper limit"),
    ('name = "q6"', "slides = 1", "joint 6: slides is"), ('{name = "q6"}', "7", "joint 6: its keys"),
    ('name = "q6"', "a = 1", "'' cannot be the name of a joint"), ('name = "p"', "base = 1", "it has convention"),
    ("alpha = 90", "alpha = 80", "axes 1 and 2 are 10 degrees from right angles"), ("joint =", "joint", "not TOML")])
def test_a_wrong_table_is_refused(urdf, old, new, reason):
    assert reason in refused("import", "--dh", urdf(DH["standard"].replace(old, new, 1), "table.toml"))


# Real robots

SIX, FIVE, NO_WRIST = "an ortho-parallel arm with a spherical wrist", "5 joints move (RRRRR", "miss a common point by "
EE = "/ee_gripper_link"
REAL = {  # a file of the package rtb-data, the tip, what it is or why it is refused
    "abb_irb140_description/urdf/irb140.xacro": ("tool0", SIX),
    "abb_irb140_description/urdf/irb140.urdf": ("tool0", NO_WRIST + "20 mm"),
    **{f"kuka_description/kuka_{name}/urdf/{file}": ("tool0", SIX) for name, file in (
        ("kr3", "kr3r540.xacro"), ("kr5", "kr5_arc.xacro"), ("kr6", "kr6r700sixx.xacro"), ("kr6", "kr6r900sixx.xacro"),
        ("kr10", "kr10r1100sixx.xacro"), ("kr16", "kr16_2.urdf"), ("kr120", "kr120r2500pro.urdf"),
        ("kr150", "kr150_2.xacro"), ("kr210", "kr210l150.urdf"))},
    "kuka_description/kuka_lbr_iiwa/urdf/lbr_iiwa_14_r820.urdf": ("tool0", "an S-R-S arm"),
    "lynxmotion_al5d_description/urdf/al5d_robot.urdf": ("link4", "4 joints move (RRRR;"),
    "qut_frankie_description/robots/panda_arm.urdf.xacro": ("panda_link8", NO_WRIST + "88 mm"),
    "qut_frankie_description/robots/frankie_arm.urdf.xacro": ("panda_link8", "9 joints move (RPRRRRRRR"),
    "trossen_descriptions/urdf/px100.urdf.xacro": (EE, "4 joints move (RRRR;"),
    **{f"trossen_descriptions/urdf/{name}.urdf.xacro": (EE, FIVE) for name in
       ("px150", "rx150", "rx200", "vx250", "vx300", "wx200", "wx250")},
    **{f"trossen_descriptions/urdf/{name}.urdf.xacro": (EE, SIX) for name in ("vx300s", "wx250s")},
    "trossen_descriptions/urdf/pxxls.urdf.xacro": ("/surface_link", "axes 1 and 2 are 90 degrees from parallel"),
    "unimation_puma560_description/urdf/puma560_robot.urdf": ("link7", SIX),
    "xarm6/xarm6.xacro": ("link_eef", NO_WRIST + "76 mm")}


@pytest.mark.slow
@XACRO
@pytest.mark.parametrize("name", REAL)
def test_a_real_robot_is_right_or_refused(tmp_path, name):
    """As its makers published it; the packages are put under the names by which they ask for one another."""
    data = Path(pytest.importorskip("rtbdata").__file__).parent
    package = re.sub(r"(/urdf|/robots)?/[^/]*$", "", name)
    called = package.partition("_description")[0] if package.startswith("abb") else package
    if package.startswith("kuka"):
        called = package.partition("/")[2] + "_support"
        shutil.copytree(data / "xacro/kuka_description/kuka_resources", tmp_path / "kuka_resources")
    source = data / ("xacro" if package != "xarm6" else "armer_xarm/data/xacro/robots") / package
    shutil.copytree(source, tmp_path / called)
    path, (tip, what), file = tmp_path / (called + name.removeprefix(package)), REAL[name], tmp_path / "arm.toml"
    code, _, err = run("import", path, "--tip", tip, "--packages", tmp_path, "--out", file)
    if code:
        assert what in err and what != SIX
        return
    assert file.read_text().startswith(f"# {what}: within") and ": right\n" in run("check", file)[1]
    text = path.read_bytes() if path.suffix == ".urdf" else cli_urdf._expanded(path, str(tmp_path))
    text = re.sub(r"<(visual|collision)\b.*?</\1>", "", text.decode(), flags=re.DOTALL)
    mm, rad = difference(file, text, re.search(r'^source = ".*, (\S+) to', file.read_text(), re.M)[1], tip)
    assert mm < MM and rad < RAD


# Nobody gets in

SECRET = "0.777"


@pytest.mark.parametrize(("text", "reason"), [
    ('<!DOCTYPE robot [<!ENTITY a "b">]>' + KR6.partition("?>")[2], "document type"),
    ('<!DOCTYPE robot SYSTEM "file:///etc/passwd">' + KR6.partition("?>")[2], "document type"),
    (KR6.replace("0.315", "&a;"), "not XML: undefined entity"),
    ("<robot>" + "<a>" * 100_000, "more than 64 deep"),
    ("<robot>" + "<joint/>" * 2000 + "</robot>", "more than 1000 joints"),
    ('<?xml version="1.0" encoding="nothing"?><robot/>', "not XML"),
    (KR6 + " " * (16 << 20), "it has more than 16 MiB")])
def test_foreign_xml_has_bounds(urdf, text, reason):
    assert reason in refused("import", urdf(text))


def test_what_is_no_file_is_not_read(tmp_path):
    os.mkfifo(tmp_path / "pipe.urdf")
    assert "cannot be read: Not a file" in refused("import", tmp_path / "pipe.urdf")
    assert "Not a file" in refused("import", "--dh", "/dev/zero")
    (tmp_path / "pipe.toml").symlink_to("/dev/zero")
    assert "Not a file" in refused("check", tmp_path / "pipe.toml")
    (tmp_path / "large.toml").write_text(" " * (2 << 20))
    assert "more than 1 MiB" in refused("check", tmp_path / "large.toml")


def test_no_file_that_a_robot_names_is_opened(urdf, tmp_path):
    mesh = '<visual><geometry><mesh filename="{}"/></geometry></visual>'
    (tmp_path / "mesh.stl").write_text("solid")
    text = KR6.replace('<link name="link_3"/>', '<link name="link_3">' + mesh.format("mesh.stl") + mesh.format(
        "file:///etc/passwd") + mesh.format("package://a/../../x") + "</link>")
    program = "import sys\nfrom quadrance.cli import main\nsys.addaudithook(lambda e, a: e == 'open' and print(" \
              "'OPENED', a[0], file=sys.stderr))\nsys.exit(main(['import', sys.argv[1]]))"
    done = subprocess.run([sys.executable, "-c", program, urdf(text)], capture_output=True, text=True,
                          env=os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, sys.path))})
    opened = [line for line in done.stderr.splitlines() if str(tmp_path) in line or "passwd" in line or "mesh" in line]
    assert done.returncode == 0 and opened == [f"OPENED {tmp_path / 'robot.urdf'}"]


def test_without_xacro_a_line_says_what_to_install(urdf, monkeypatch):
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    for text in (KR6.replace("0.315", "${length}"), KR6.replace("</robot>", "<xacro:arm/></robot>")):
        assert "robot.urdf needs xacro, which is not installed: pip install xacro" in refused("import", urdf(text))


def macros(*lines, length="${length}"):
    return KR6.replace("0.315", length).replace("<robot ", '<robot xmlns:xacro="http://ros.org/wiki/xacro" ').replace(
        "</robot>", "".join(lines) + "</robot>")


@XACRO
def test_xacro_is_expanded(urdf, tmp_path):
    (tmp_path / "inside").mkdir()
    (tmp_path / "inside" / "more.xacro").write_text('<robot xmlns:xacro="http://ros.org/wiki/xacro">'
                                                    '<xacro:property name="length" value="${0.3 + 0.015}"/></robot>')
    (tmp_path / "lengths.yaml").write_text("length: 0.315")
    for line in ('<xacro:include filename="inside/more.xacro"/>',
                 '<xacro:property name="length" value="${xacro.load_yaml(\'lengths.yaml\')[\'length\']}"/>'):
        text = macros().replace("<link", line + "<link", 1)
        assert run("import", urdf(text, "robot.xacro"))[1].partition("\n")[2].replace("xacro", "urdf") == \
            run("import", urdf(KR6))[1].partition("\n")[2]


@XACRO
@pytest.mark.parametrize("line", [
    '<xacro:include filename="../secret.xacro"/>', '<xacro:include filename="{}/secret.xacro"/>',
    '<xacro:include filename="link.xacro"/>', '<xacro:include filename="../secr*.xacro"/>',
    "<xacro:property name=\"length\" value=\"${{xacro.load_yaml('../secret.yaml')['length']}}\"/>"])
def test_xacro_reads_nothing_outside_the_folder(tmp_path, line):
    """Unless --packages opens the folder."""
    (tmp_path / "secret.xacro").write_text('<robot xmlns:xacro="http://ros.org/wiki/xacro"><xacro:property '
                                           f'name="length" value="{SECRET}"/></robot>')
    (tmp_path / "secret.yaml").write_text(f"length: {SECRET}")
    (folder := tmp_path / "robot").mkdir()
    (folder / "link.xacro").symlink_to(tmp_path / "secret.xacro")
    (folder / "robot.xacro").write_text(macros().replace("<link", line.format(tmp_path) + "<link", 1))
    assert "outside the file's folder; --packages DIR opens one more" in refused("import", folder / "robot.xacro")
    assert "l1 = 777.0\n" in run("import", folder / "robot.xacro", "--packages", tmp_path)[1]


@XACRO
def test_a_package_is_a_folder_of_packages(tmp_path):
    (package := tmp_path / "all" / "arm_description").mkdir(parents=True)
    (package / "length.xacro").write_text('<robot xmlns:xacro="http://ros.org/wiki/xacro"><xacro:property '
                                          f'name="length" value="{SECRET}"/></robot>')
    line = '<xacro:include filename="$(find arm_description)/length.xacro"/>'
    (tmp_path / "robot.xacro").write_text(macros().replace("<link", line + "<link", 1))
    assert "l1 = 777.0\n" in run("import", tmp_path / "robot.xacro", "--packages", tmp_path / "all")[1]


# a nested function passes xacro's own filter of names: from here on an expression has all of Python
OUT = "(lambda: [c for c in ().__class__.__base__.__subclasses__() if c.__name__ == '_wrap_close'][0].__init__" \
      ".__globals__"


@XACRO
@pytest.mark.parametrize(("expression", "reason"), [
    ("().__class__.__base__", "XacroException"), ("1/0", "division by zero"), ("'a' * 3 * 10**9", "when evaluating"),
    ("xacro.load_yaml('/etc/passwd')", "/etc/passwd is outside the file's folder"),
    (OUT + "['system']('touch pwned'))()", "asks for os.system"), (OUT + "['fork']())()", "asks for os.fork"),
    (OUT + "['mkdir']('pwned'))()", "asks for os.mkdir"), (OUT + "['remove']('robot.xacro'))()", "asks for os.remove"),
    (OUT + "['truncate']('robot.xacro', 0))()", "asks for os.truncate"),
    (OUT + "['open']('pwned', 65))()", "pwned would be written"),
    (OUT + "['open']('robot.xacro', 513))()", "robot.xacro would be written"),
    (OUT + "['listdir']('/'))()", "/ is outside the file's folder"),
    (OUT + "['sys'].modules['builtins'].open('/etc/passwd').read())()", "/etc/passwd is outside the file's folder"),
    (OUT + "['sys'].modules['builtins'].__import__('socket'))()", "asks for import"),
    (OUT + "['sys'].modules['builtins'].__import__('ctypes'))()", "asks for import"),
    (OUT + "['environ']['HOME'])()", "HOME"), (OUT + "['_exit'](0))()", "not XML"), ("", "$(env HOME)")])
def test_an_expression_of_xacro_gets_nowhere(tmp_path, monkeypatch, expression, reason):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("HOME", SECRET)
    text = macros(length="${" + expression + "}" if expression else reason)
    (tmp_path / "robot.xacro").write_text(text)
    said = refused("import", "robot.xacro")
    assert SECRET not in said and (reason in said or not expression)
    assert [path.name for path in tmp_path.iterdir()] == ["robot.xacro"]
    assert (tmp_path / "robot.xacro").read_text() == text


@XACRO
@pytest.mark.slow
def test_a_xacro_that_does_not_end_is_ended(urdf):
    """A sum of 10^11 numbers, and macros that double."""
    assert "xacro" in refused("import", urdf(macros(length="${sum(range(10**11))}")))
    doubling = [f'<xacro:macro name="m{i}"><xacro:m{i - 1}/><xacro:m{i - 1}/></xacro:macro>' for i in range(1, 60)]
    text = macros('<xacro:macro name="m0"><a/></xacro:macro>', *doubling, "<xacro:m59/>", length="1")
    assert "xacro" in refused("import", urdf(text))


# Fuzz

numbers = st.floats(0.05, 0.9).map(lambda value: round(value, 4))
signs = st.sampled_from((-1, 1))
angles_ = st.floats(-3.1, 3.1)
lines_ = st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda some: np.linalg.norm(some) > 0.1)
frames_ = st.builds(lambda axis, angle, x, y, z: move(x, y, z) @ turn(axis, angle), lines_, angles_,
                    *[st.floats(-0.5, 0.5)] * 3)


@st.composite
def ideal(draw):
    """Letters, frames before (m) and axes of an arm that a core has, in frames of its own, and the frame behind."""
    kind = draw(st.sampled_from(("planar", "scara", "three", "six", "ur", "srs")))
    a, b, c, d, e, f = (draw(numbers) * draw(signs) for _ in range(6))
    if kind in ("planar", "scara"):
        found = [("R", np.eye(4), Z), ("R", move(abs(a), 0, b), Z)]
        found += [("R", move(abs(c), 0, d), Z)] if draw(st.booleans()) else []
        if kind == "scara":
            found.insert(draw(st.integers(0, len(found))), ("P", np.eye(4), Z))
        return found, move(draw(st.sampled_from((abs(e), 0.0))) if len(found) > 2 and found[-1][0] == "R" and
                           sum(one[0] == "R" for one in found) > 2 else abs(e), 0, f)
    flange = draw(st.sampled_from((abs(b), 0.0)))
    if kind == "srs":
        return [("R", np.eye(4), Z), ("R", move(z=c), Y), ("R", np.eye(4), X), ("R", move(abs(d)), Y),
                ("R", np.eye(4), X), ("R", move(abs(e)), Y), ("R", np.eye(4), X)], move(flange)
    found = [("R", np.eye(4), Z), ("R", move(0 if kind == "ur" else a, b, c), -Y), ("R", move(abs(d)), -Y)]
    if kind == "ur":
        return found + [("R", move(abs(e), f), Y), ("R", np.eye(4), Z), ("R", move(z=a), Y)], move(y=flange)
    if kind == "three":
        return found, move(abs(e), 0, 0)
    return found + [("R", move(abs(e), 0, f), X), ("R", np.eye(4), Y), ("R", np.eye(4), X)], move(flange)


@st.composite
def robots(draw):
    """A URDF of such an arm: frames moved and turned along the axes, senses turned round, fixed joints put between."""
    joints, after = draw(ideal())
    rest, text, count = draw(frames_), [], 0

    def fixed(pose):
        roll = math.atan2(pose[2, 1], pose[2, 2])
        pitch = math.atan2(-pose[2, 0], math.hypot(pose[2, 1], pose[2, 2]))
        return {"xyz": pose[:3, 3], "angles": (roll, pitch, math.atan2(pose[1, 0], pose[0, 0]))}

    def between(pose):
        nonlocal count
        if draw(st.booleans()):
            part = draw(frames_)
            count += 1
            text.append(joint_(f"fixed {count}", f"n{count - 1}", f"n{count}", "fixed", **fixed(part)))
            pose = np.linalg.inv(part) @ pose
        return pose

    for letter, before, axis in joints:
        own = move(*(axis * draw(st.floats(-0.3, 0.3)))) @ draw(frames_.map(lambda pose: product(
            np.linalg.inv(move(*pose[:3, 3])), pose)))
        pose = between(rest @ before @ turn(axis, draw(angles_)) @ own)
        count += 1
        text.append(joint_(f"j{count}", f"n{count - 1}", f"n{count}", "prismatic" if letter == "P" else "revolute",
                           limit=draw(st.sampled_from(((-2.5, 2.0), (0.004, 0.009), (0, 6.0)))),
                           axis=draw(signs) * own[:3, :3].T @ axis, **fixed(pose)))
        rest = np.linalg.inv(own)
    pose = between(rest @ after @ draw(st.sampled_from((np.eye(4), turn(Y, math.pi / 2), turn(X, 1.0)))))
    count += 1
    return robot(*text, joint_("end", f"n{count - 1}", f"n{count}", "fixed", **fixed(pose))), "n0", f"n{count}"


def right_or_refused(text, accepted):
    """Import a text: the arm is the robot, or it is refused in a line; a file that is there stays."""
    with tempfile.TemporaryDirectory() as folder:
        path, file, other = (Path(folder) / name for name in ("r.urdf", "new.toml", "old.toml"))
        path.write_bytes(text if isinstance(text, bytes) else text.encode("utf-8", "surrogatepass"))
        other.write_text("mine")
        code, _, err = run("import", path, "--out", file)
        refused("import", path, "--out", other)
        assert other.read_text() == "mine" and file.exists() == (code == 0)
        assert code == 0 or not accepted, err
        if code:
            return
        base, tip = re.search(r'^source = "r.urdf, (.*) to (.*)"$', file.read_text(), re.M).groups()
        assert arms.load(file).shoulder >= 0, "the shoulder is in front of the yaw axis"
        if "# rounded" not in file.read_text():
            samples = values(path.read_bytes(), base, tip, 25)
            want = np.array([by_matrices(path.read_bytes(), base, tip, q) for q in samples])
            want[:, :3, 3] *= 1000
            mm, rad = off(of_file(file, samples), want)
            assert mm < MM and rad < RAD


NASTY = (
    "nan", "inf", "1e308", "-0", "1e-320", "0 0", "", " ", "0x10", "1_0 0 0", "٣ 0 0", "1 0 0", "0 0 1e-9",
    "99999", "'", "a&#10;b", "&lt;", "link_2", "tool0", "base_link", "joint_a1", "fixed", "prismatic", "continuous",
    "floating", "1e", "0.1 0.2 0.3", "0 1.5707963267948966 0", "--1", "é", "x" * 300, "0 0 0 0",
    "1e400 0 0")
PIECES = (
    "<!DOCTYPE robot>", "<!-- -->", "<?pi?>", "&lt;", "&x;", "<a>", "</a>", "<joint/>", "</robot>", "<robot>",
    "<link/>", "\0", "<![CDATA[x]]>", '<joint type="fixed"/>',
    '<mimic joint="joint_a1"/>', "\ufffe", "]]>", "<b " * 70)
VALUES = (
    "nan", "-inf", "1e308", "5e-324", "1e-300", "1e9", "-1", "0", "true", "[]", "[1, 2]", "[-180, 180]",
    "[-1e308, 1e308]", "{}", "{ a = 1 }", '""', '"a\\nb"', "'''a\nb'''", "1979-05-27", "9" * 400,
    "0x" + "f" * 5000, "[" * 2000, "1_0.0", '"é\\u0000"', "[[1], [2]]", "1e-5", "360", "[0x" + "f" * 5000 + ", 1]")


FRAMES = (
    'base = { link = "a b", xyz = [1.0, -2.5, 0.0], rpy = [0.0, 90.0, 0.0] }',
    'tip = { link = "tool", xyz = [0, 0.0, 5], rpy = [0.0, 9.0, 0.0] }',
    'beside = [{ name = "c", moves = "along", sign = -1, zero = 0.0, limits = [0, 150] }]',
    'beside = [{ name = "d", moves = "about", sign = 1, zero = -90.5 }, { name = "*/", moves = "along" }]')


@st.composite
def tables(draw):
    """An arm file with some values, keys and lines changed, and a table of its frames."""
    lines = arms.path_of(draw(st.sampled_from(arms.known()))).read_text().splitlines()
    for name in draw(st.lists(st.sampled_from(FRAMES), max_size=3, unique=True)):
        lines += ["[frames]"] * ("[frames]" not in lines)
        line = list(name)
        for _ in range(draw(st.integers(0, 2))):
            at = draw(st.integers(0, len(line)))
            new = draw(st.sampled_from((*VALUES, "'", "*/", "\\", "\u2028", "\t", ", ")))
            line[at:at + draw(st.integers(0, 3))] = new
        lines.append("".join(line))
    for _ in range(draw(st.integers(0, 3))):
        how, at = draw(st.integers(0, 5)), draw(st.integers(0, len(lines) - 1))
        key, equals, value = lines[at].partition("=")
        if how < 3 and equals:
            lines[at] = f"{key}= {draw(st.sampled_from(VALUES))}"
        elif how == 3:
            lines[at] = draw(st.sampled_from(('"a\\nb" = 1', "[a", "x" + ".a" * 3000 + " = 1", "[six]", "\0", key)))
        elif how == 4:
            lines[at] = draw(st.text(max_size=5)) + value
        else:
            lines = lines[:at] + lines[at + draw(st.integers(0, 1)) + 1:] + lines[at:at + 1] or [""]
    return "\n".join(lines)


def checked(text):
    """An arm file is checked, or refused in a line; what it says of words and instances too."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "arm.toml"
        path.write_bytes(text if isinstance(text, bytes) else text.encode("utf-8", "surrogatepass"))
        code, out, _ = run("check", path)
        assert code or ": right\n  links " in out
        for core in () if code else ("arm_ik3", "table_ik2"):
            code, out, _ = run("instance", core, "--arm", path)
            assert code or re.fullmatch(r"(//.*\n)+\w+ #\([^;]*\)\s+\w+ \(\n( +\..*\n)+\);\n", out)


@st.composite
def broken(draw):
    """A URDF with some changes: values, pieces put in, elements left out or doubled, bytes."""
    text = draw(st.sampled_from([one[0] for one in ROBOTS.values()]))
    for _ in range(draw(st.integers(1, 4))):
        how, at = draw(st.integers(-2, 4)), draw(st.integers(0, 10_000))
        if how < 1 and (found := list(re.finditer(r'"([^"]*)"', text))):
            spot = found[at % len(found)]
            text = text[:spot.start(1)] + draw(st.sampled_from(NASTY)) + text[spot.end(1):]
        elif how == 1:
            text = text[:at % len(text)] + draw(st.sampled_from(PIECES)) + text[at % len(text):]
        elif how in (2, 3) and (found := list(re.finditer(r"<\w+[^<>]*/>|<joint.*?</joint>", text))):
            spot = found[at % len(found)]
            text = text[:spot.start()] + spot[0] * (0, 2)[how - 2] + text[spot.end():]
        else:
            text = text[:at % len(text)] + draw(st.text(max_size=3)).replace("$", "") + text[at % len(text) + 1:]
        text = text or "<robot/>"
    return text


@st.composite
def torn(draw, texts):
    """Such a text in some encoding, with bytes put in, left out or doubled, or with its end torn off."""
    code = draw(st.sampled_from(("utf-8", "utf-8", "utf-8-sig", "utf-16", "latin-1")))
    found = draw(texts).encode(code, "replace")
    for _ in range(draw(st.integers(1, 4))):
        at, how = draw(st.integers(0, len(found))), draw(st.integers(0, 5))
        upto = at + draw(st.integers(1, 200 if how == 3 else 2))
        found = found[:at] + (b"" if how == 0 else found[at:upto] * 2 if how == 3 else draw(st.sampled_from(BYTES))) + \
            (b"" if how == 4 and draw(st.booleans()) else found[upto if how < 2 else at:])
    return found


BYTES = (b"\0", b"\xff", b"\xfe\xff", b"\xc3", b"\xed\xa0\x80", b"\xf4\x90\x80\x80", b"\x1b[2J", b"\r", b"\n", b"\x0c",
         b"\x85", b"\x7f", b'"', b"'", b"<", b"&", b"#", b"[", b"]", b"=", b"{", b"9", b"-", b".", b" ")


@pytest.mark.parametrize("examples", [40, pytest.param(10_000, marks=[pytest.mark.slow, pytest.mark.timeout(7200)])])
@pytest.mark.parametrize(("strategy", "body"), [
    (robots(), lambda found: right_or_refused(found[0], True)), (broken(), lambda text: right_or_refused(text, False)),
    (st.one_of(st.binary(max_size=60), torn(st.sampled_from([one[0] for one in ROBOTS.values()]))),
     lambda text: right_or_refused(text, False)), (tables(), lambda text: checked(text)),
    (st.one_of(st.binary(max_size=60), torn(st.sampled_from(arms.known()).map(lambda name: arms.path_of(
        name).read_text()))), lambda text: checked(text))],
    ids=("arms of every kind", "broken", "bytes", "arm files", "bytes of arm files"))
def test_a_foreign_file_is_right_or_refused(strategy, body, examples):
    settings(max_examples=examples, deadline=None)(given(strategy)(body))()
