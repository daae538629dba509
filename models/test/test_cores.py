"""The reader of rtl/cores.toml: what it expands, and how it refuses a wrong entry."""

import copy
import tomllib

import pytest
from quadrance import cores
from quadrance.cores import Port

ENTRY = tomllib.loads("""
family = "rational"
function = "fk1"
architecture = "table"
model = "fixed.isqrt"
cfg = { l1 = "uW" }
in = { j1 = "u2+S" }
out = { x = "sW", y = "smax(W, S)" }
status = ["overflow"]
sets = [ { id = "S24", params = { W = 16, S = 24 }, latency = 3, ii = 1 },
         { id = "S8", params = { W = 16, S = 8 }, latency = 0, ii = 0 } ]
""")


def test_expansion_of_one_entry():
    first, second = cores._expand("isqrt_iter", ENTRY)
    assert (first.id, second.id) == ("isqrt_iter-S24", "isqrt_iter-S8")
    assert first.inputs == (Port("in_j1", 26, False),) and second.inputs[0].width == 10
    assert first.cfg == (Port("cfg_l1", 16, False),)
    assert first.outputs == (Port("out_x", 16, True), Port("out_y", 24, True), Port("out_status", 4, False))
    assert second.outputs[1].width == 16
    assert [path.name for path in first.sources] == ["isqrt_iter.v", "isqrt_comb.v", "isqrt_digits.v"]
    assert first.first_set and not second.first_set
    assert first.clocked and not second.clocked
    assert first.model([9])[0] == 3
    assert len({first, second, first}) == 2


def test_an_entry_without_status_has_no_status_port():
    entry = {key: value for key, value in ENTRY.items() if key not in ("status", "cfg")}
    core = cores._expand("isqrt_iter", entry)[0]
    assert core.status is None and core.cfg == () and core.outputs[-1].name == "out_y"


@pytest.mark.parametrize("port, low, high", [
    (Port("a", 8, True), -128, 127), (Port("a", 8, False), 0, 255), (Port("a", 1, False), 0, 1)])
def test_range_of_a_port(port, low, high):
    assert (port.low, port.high) == (low, high)


@pytest.mark.parametrize("change, message", [
    ({"familly": "x"}, "cores.toml: isqrt_iter: unknown key familly"),
    ({"model": None}, "missing key model"),
    ({"family": "vector"}, "family 'vector' is not one of arith"),
    ({"status": ["late"]}, "status: unknown bit late"),
    ({"in": {"j1": "W"}}, "port j1: 'W' is not u or s and a width"),
    ({"in": {"j1": "u__import__('os')"}}, "port j1: 'u__import__"),
    ({"in": {"j1": "uW-16"}}, "port j1: width 'uW-16' is 0"),
    ({"sets": [{"id": "a", "params": {"W": 4, "S": 4}, "latency": 1, "ii": 1, "fast": 1}]}, "sets: unknown key fast"),
])
def test_a_wrong_entry_is_refused_with_its_name(change, message):
    entry = copy.deepcopy(ENTRY)
    entry.update(change)
    entry = {key: value for key, value in entry.items() if value is not None}
    with pytest.raises(ValueError) as error:
        cores._expand("isqrt_iter", entry)
    assert message in str(error.value) and "cores.toml: isqrt_iter" in str(error.value)


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


def test_sources_follow_the_instances():
    assert cores.sources_of("isqrt_comb") == tuple(cores.RTL / f"arith/isqrt_{part}.v" for part in ("comb", "digits"))
    with pytest.raises(ValueError, match="cores.toml: nothing: there is no nothing.v"):
        cores.sources_of("nothing")
