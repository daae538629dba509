"""Kinematic cores without Verilog, by the type of their joint words, and what a perfect one answers. No tests here."""

from __future__ import annotations

import numpy as np
from quadrance import codecs, cores, truth
from quadrance.accuracy import Case
from quadrance.cores import Core
from quadrance.fixed import Ints, to_fixed

PORTS = {"fk1": ("j1", "x y"), "fk2": ("j1 j2", "x y"), "fk3": ("j1 j2 j3", "x y z"),
         "ik1": ("x y", "j1"), "ik2": ("x y", "j1 j2"), "ik3": ("x y z", "j1 j2 j3")}
JOINT = {"spread": "spread S", "angle": "angle A", "vector": "vector U"}


def core(function: str, joint: str = "spread", **params: int) -> Core:
    """A core of that function with joints of that type, Q7.8, S = 24, A = U = 16 unless `params` say otherwise."""
    spec = {**{f"j{i}": JOINT[joint] for i in (1, 2, 3)}, **dict.fromkeys("xyz", "sW")}
    ins, outs = ({name: spec[name] for name in names.split()} for names in PORTS[function])
    if function in ("ik2", "ik3"):
        ins["elbow"] = "u1"
    shared = {"model": "fixed.isqrt", "cfg": {"l1": "uW", "l2": "uW"}, "in": ins, "out": outs}
    own = {"architecture": "comb", "latency": 1, "sets": {"t": {"W": 16, "F": 8, "S": 24, "A": 16, "U": 16} | params}}
    return cores.expand("rational", function, shared, f"specimen_{function}", own)[0]


def ideal(one: Core, case: Case) -> dict[str, Ints]:
    """The correctly rounded answer to a case, computed the plain way."""
    f = one.params["F"]
    l1, l2 = (case.cfg[f"cfg_l{i}"] / 2**f for i in (1, 2))
    ins = case.inputs
    if one.function.startswith("fk"):
        angles = [codecs.decode(joint, ins) for joint in cores.joints(one.inputs)]
        tip = {1: lambda t: truth.fk1(t, l1), 2: lambda *t: truth.fk2(*t, l1, l2),
               3: lambda *t: truth.fk3(*t, l1, l2)}[len(angles)](*angles)
        return {f"out_{axis}": to_fixed(value, f) for axis, value in zip("xyz", tip)}
    target = [ins[f"in_{axis}"] / 2**f for axis in "xyz" if f"in_{axis}" in ins]
    joints = {"ik1": lambda: (truth.ik1(*target),), "ik2": lambda: truth.ik2(*target, l1, l2, ins["in_elbow"]),
              "ik3": lambda: truth.ik3(*target, l1, l2, ins["in_elbow"])}[one.function]()
    answer: dict[str, Ints] = {}
    for joint, angle in zip(cores.joints(one.outputs), joints):
        answer |= codecs.encode(joint, np.nan_to_num(angle))
    return answer
