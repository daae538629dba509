"""The reader of rtl/cores.toml: what it expands, how it reads formulas, and how it refuses a wrong entry."""

import copy
import re

import pytest
from quadrance import cores
from quadrance.cores import Port

TEXT = """
[rational.fk1]
model = "fixed.isqrt"
cfg = { l1 = "uW" }
in = { j1 = "spread S", j2 = "angle S+1" }
out = { x = "sW", y = "smax(W, S)" }
status = ["overflow"]

[rational.fk1.isqrt_iter]
architecture = "table"
latency = "(S - 8) // 5"
ii = 1
illegal = [{ S = 25 }]
sets.S24 = { W = 16, S = 24 }
sets.S8 = { W = 16, S = 8 }
"""


def expand(text=TEXT, **changes):
    """The first core of a list, keys of the core (``own_x``) and of its function changed; None takes one out."""
    family, function, shared, name, own = cores.listed(text)[0]
    shared, own = copy.deepcopy(shared), copy.deepcopy(own)
    for key, value in changes.items():
        table, key = (own, key[4:]) if key.startswith("own_") else (shared, key.rstrip("_"))
        table.pop(key, None)
        if value is not None:
            table[key] = value
    return cores.expand(family, function, shared, name, own)


def test_expansion_of_one_entry():
    first, second = expand()
    assert (first.id, second.id) == ("isqrt_iter-S24", "isqrt_iter-S8")
    assert first.inputs == (Port("in_j1", 26, False, "spread"), Port("in_j2", 25, False, "angle"))
    assert [port.width for port in second.inputs] == [10, 9]
    assert first.cfg == (Port("cfg_l1", 16, False),)
    assert first.outputs == (Port("out_x", 16, True), Port("out_y", 24, True), Port("out_status", 4, False))
    assert second.outputs[1].width == 16
    assert first.first_set and not second.first_set
    assert (first.latency, first.ii, second.latency, second.ii) == (3, 1, 0, 1)
    assert first.clocked and not second.clocked
    assert first.illegal == ({"S": 25},) and first.sources == ()
    assert first.model([9])[0] == 3
    assert len({first, second, first}) == 2


def test_each_pipe_has_a_first_set():
    sets = {name: {"W": 16, "S": size, "PIPE": pipe} for name, size, pipe in
            (("a", 24, 0), ("b", 8, 0), ("c", 24, 1), ("d", 8, 1))}
    assert [core.set_id for core in expand(own_sets=sets) if core.first_set] == ["a", "c"]


def test_a_vector_has_two_ports():
    core = expand(in_={"j1": "vector S", "z": "sW", "j2": "vector 9"})[0]
    assert core.inputs == (Port("in_c1", 26, True, "vector"), Port("in_n1", 26, True, "vector"), Port("in_z", 16, True),
                           Port("in_c2", 11, True, "vector"), Port("in_n2", 11, True, "vector"))
    assert cores.joints(core.inputs) == (core.inputs[:2], core.inputs[3:])
    assert cores.joints(expand()[0].inputs) == tuple((port,) for port in expand()[0].inputs)


def test_the_interval_is_the_latency_where_nothing_else_is_said():
    assert [core.ii for core in expand(own_ii=None)] == [3, 0]


def test_an_entry_without_status_has_no_status_port():
    core = expand(status=None, cfg=None)[0]
    assert core.status is None and core.cfg == () and core.outputs[-1].name == "out_y"


@pytest.mark.parametrize("port, low, high", [
    (Port("a", 8, True), -128, 127), (Port("a", 8, False), 0, 255), (Port("a", 1, False), 0, 1)])
def test_range_of_a_port(port, low, high):
    assert (port.low, port.high) == (low, high)


@pytest.mark.parametrize("text, value", [
    (7, 7), ("7", 7), (" W ", 16), ("W // 2 * 3 - 1", 23), ("-(W - 20)", 4), ("max(W, S, 30) + min(W, S)", 46),
    ("3 + (W > 10) + (W > 16) + (W >= 16) + (W == 16) + (W != S) + (W <= 1) + (W < 17)", 8)])
def test_a_formula(text, value):
    assert cores.formula(text, {"W": 16, "S": 24}, "here") == value


@pytest.mark.parametrize("text, reason", [
    ("W +", "is not a formula of"), ("W * 1.5", "is not a formula of"), ("W / 2", "is not a formula of"),
    ("W ** W ** W", "is not a formula of"), ("__import__('os')", "is not a formula of"), ("abs(W)", "is not a formula"),
    ("max()", "is not a formula of"), ("W.real", "is not a formula of"), ("1 < W < 3", "is not a formula of"),
    ("[W][0]", "is not a formula of"), ("True", "is not a formula of"), ("", "is not a formula of"),
    ("Q + 1", "names Q; parameters are W, S"), ("W // (S - 24)", "divides by 0 at {'W': 16, 'S': 24}"),
    (True, "is neither an integer nor a formula"), (2.0, "is neither an integer nor a formula")])
def test_what_is_not_a_formula_is_refused(text, reason):
    with pytest.raises(ValueError) as error:
        cores.formula(text, {"W": 16, "S": 24}, "cores.toml: a_core: latency")
    assert f"cores.toml: a_core: latency: '{text}' {reason}" in str(error.value)


@pytest.mark.parametrize("change, message", [
    ({"modell": "x"}, "unknown key modell"),
    ({"model": None}, "missing key model"),
    ({"own_latency": None}, "missing key latency"),
    ({"own_sources": ["a.v"]}, "unknown key sources"),
    ({"status": ["late"]}, "status: unknown bit late"),
    ({"in_": {"j1": "W"}}, "in.j1: 'W' is neither u or s and a width nor one of spread, angle, vector"),
    ({"in_": {"j1": "tangent S"}}, "in.j1: 'tangent S' is neither u or s and a width nor one of spread, angle, vector"),
    ({"in_": {"j1": "u__import__('os')"}}, "in.j1: '__import__('os')' is not a formula"),
    ({"in_": {"angle": "vector S"}}, "in.angle: the name of a joint of two ports begins with j"),
    ({"in_": {"j1": "angle W + Z"}}, "in.j1: 'W + Z' names Z; parameters are W, S"),
    ({"in_": {"j1": "uW-16"}}, "in.j1: the width of 'uW-16' is 0"),
    ({"own_latency": "W //"}, "latency: 'W //' is not a formula"),
    ({"own_ii": "Q"}, "ii: 'Q' names Q; parameters are W, S"),
])
def test_a_wrong_entry_is_refused_with_its_name(change, message):
    with pytest.raises(ValueError) as error:
        expand(**change)
    assert f"cores.toml: isqrt_iter: {message}" in str(error.value)


@pytest.mark.parametrize("text, message", [
    (TEXT.replace("rational", "matrix"), "cores.toml: isqrt_iter: family 'matrix' is not one of arith"),
    (TEXT.split("[rational.fk1.isqrt")[0], "cores.toml: rational.fk1 has no core"),
    ("[rational]\nmodel = 'x.y'", "cores.toml: rational.model is not a table of a function")])
def test_a_list_out_of_shape_is_refused(text, message):
    with pytest.raises(ValueError, match=message.replace(".", r"\.")):
        expand(text)


def test_the_list_itself():
    listed = cores.all_cores()
    assert listed and len({core.id for core in listed}) == len(listed)
    for core in listed:
        assert all(path.is_file() for path in core.sources), core.id
        assert core.sources[0].stem == core.name, f"{core.id}: the first source is the top"
        assert core.architecture and core.function
        assert cores.find(core.id) is core
    assert cores.find(listed[0].name) is listed[0]
    with pytest.raises(KeyError, match="no core 'nothing'"):
        cores.find("nothing")


def test_the_list_is_in_order():
    """By family, then function; a joint port says its type."""
    listed = cores.all_cores()
    families = list(dict.fromkeys(core.family for core in listed))
    assert families == sorted(families, key=cores.FAMILIES.index)
    groups = [(core.family, core.function) for core in listed]
    assert len(set(groups)) == sum(one != other for one, other in zip(groups, [None, *groups]))
    for core in listed:
        axes = {"tool": "[cn][abc]", "keep": "-"}.get(core.family, r"j|angle|[jcn]\d+")  # c12: of both; keep has turns
        for port in (*core.inputs, *core.outputs):
            joint = re.fullmatch(f"(in|out)_({axes})", port.name) is not None
            if port.name[-2:] not in ("_c", "_n"):  # of a codec: a unit vector, or one of any length, two plain words
                assert (port.type is not None) == joint, core.id


def test_latencies_follow_the_parameters():
    """What the formulas give where they are not plain numbers, as the benches measure it."""
    found = {core.id: (core.latency, core.ii) for core in cores.all_cores()}
    assert {name: cycles for name, cycles in found.items() if name in MEASURED} == MEASURED


MEASURED = {
    "isqrt-iter-W16R4": (2, 2), "isqrt-iter-W15F1R2": (5, 5), "isqrt-pipe-W16": (8, 1), "divide-iter-6by10F3R2": (5, 5),
    "divide-pipe-8by8R3": (3, 1), "vector_to_spread_iter-W18S24": (10, 10), "vector_to_spread_iter-W8S13": (15, 15),
    "vector_to_spread_iter-PIPE1": (15, 15), "quaternion_to_matrix-PIPE1": (10, 10),
    "cordic_rotate-iter-W16": (21, 21), "cordic_rotate-iter-W11A9": (16, 16), "cordic_rotate-pipe-W16": (20, 1),
    "cordic_rotate-pipe-W11A9": (16, 1), "cordic_vector-iter-W11A9": (16, 16), "cordic_vector-pipe-W16": (17, 1),
    "classic_fk1-iter-A16": (15, 15), "classic_fk2-iter-W12A10": (24, 24), "classic_fk3-iter-A16": (53, 53),
    "classic_ik1-iter-W12A10": (14, 14), "classic_ik2-iter-A16": (64, 64), "classic_ik3-iter-W12A10": (58, 58),
    "paper_ik1-S24": (10, 10), "paper_fk2-S8": (10, 10), "paper_fk3-S24": (17, 17), "paper_ik2-S8": (17, 17),
    "paper_ik3-S24": (45, 45)}


def test_sources_follow_the_instances():
    assert cores.sources_of("isqrt_comb") == tuple(cores.RTL / f"arith/isqrt_{part}.v" for part in ("comb", "digits"))
    with pytest.raises(ValueError, match="cores.toml: nothing: there is no nothing.v"):
        cores.sources_of("nothing")
