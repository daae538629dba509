"""This module finds the cores that compute a function on an arm as well, as often and on as fast a clock as asked.

Area and clock come from the rows of the committed report: its cores and the parts of its verdict. A row says them at
its own W and joint word. F changes no logic, so F is as fine as W leaves room for the arm's reach. Another joint word
has an estimated area.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cache

import numpy as np

from quadrance import accuracy, cores
from quadrance import arm as arm_model
from quadrance.accuracy import cases, of_core, pose
from quadrance.arms import Arm, ArmError
from quadrance.cli import check, verilog, words
from quadrance.cli.around import around
from quadrance.cli.catalogue import WORDS, Refused, find, functions, report, title
from quadrance.cli.tables import Column, console, grid
from quadrance.cli.tip import SERVED
from quadrance.cores import Core

# What the columns of the report's area are called on each chip, and how much of each a small device of it has
DEVICE = {"ecp5": "an LFE5U-25", "cyclonev": "a 5CEBA4", "ice40": "an iCE40 HX8K"}
CHIPS = {"ecp5": {"lut": ("LUT", 24288), "dsp": ("MULT18X18", 28), "mem": ("EBR", 56)},
         "cyclonev": {"lut": ("ALUT", 36960), "dsp": ("DSP", 66), "mem": ("M10K", 308)},
         "ice40": {"lut": ("LC", 7680), "mem": ("RAM4K", 32)}}
PARAMETER = {"angle": "A", "vector": "U", "spread": "S", "half_tangent": "T"}  # whose bits a joint word has
SIGN = {"measured": "", "about": "~", "at most": "<="}  # before an area
SAME_BITS = ("MODE", "PIPE", "MULTIPLY", "PRODUCTS", "MARGINS")  # ways to build a core of the same words
MULTIPLIER = 18  # bits of a multiplier's input: a longer unit vector takes two
GROWTH = 0.005  # of the LUTs, for each bit of a joint word: what it is over all rows


@dataclass(frozen=True)
class Row:
    """A measured set of parameters: area by flow, clock on ECP5 in MHz."""

    core: Core
    area: dict[str, dict[str, int]]
    mhz: float


@dataclass
class Wish:
    """What is asked for; `chip` is a key of `CHIPS`, `mm`, `rate` (results a second) and `clock` (MHz) may be None."""

    function: str
    arm: Arm
    word: words.Word
    chip: str
    mm: float | None = None
    rate: float | None = None
    clock: float | None = None
    runs: int = 0  # of bit-true models
    known: dict = field(default_factory=dict)  # the errors that they had


@dataclass
class Answer:
    """A core at parameters that serve the arm, and what it does there; `misses`: (share of the wish, sentence)."""

    core: Core
    row: Row
    area: dict[str, int]
    estimate: str  # "" where the area is measured, else "about" or "at most"
    mhz: float
    rate: float
    error: pose.Worst | None = None
    misses: list[tuple[float, str]] = field(default_factory=list)

    @property
    def ns(self) -> float:
        """Latency in nanoseconds."""
        return self.core.latency * 1000 / self.mhz


# Rows


@cache
def rows() -> tuple[Row, ...]:
    """Every measured set of a core of an arm."""
    listed = {}
    for core in cores.all_cores():
        listed.setdefault(core.name, core)
    found = []
    for row in [*report().get("cores", ()), *report().get("verdict", {}).get("parts", {}).values()]:
        core = listed.get(row["core"])
        if core is None or not verilog.takes_an_arm(core) or set(row["params"]) != set(core.params):
            continue
        mhz = row["fmax_mhz"]
        found.append(Row(cores.at(core, row["params"]), row["area"], mhz["ecp5"] if isinstance(mhz, dict) else mhz))
    return tuple({(row.core.name, *row.core.params.items()): row for row in found[::-1]}.values())[::-1]


def _built(params: dict[str, int], *free: str) -> dict[str, int]:
    return {key: value for key, value in params.items() if key not in ("F", *free)}


def estimated(core: Core, flow: str, key: str) -> tuple[dict[str, int], Row, bool] | None:
    """Area of a core in a flow, the row that it follows from, and whether that is the core's own; `key` is the
    parameter of its joint words.

    Between two rows whose joint words alone differ the LUTs grow in proportion; beyond them by `GROWTH` a bit, or with
    the length of unit vectors where a chip without multipliers multiplies by them. None without a row that has all
    other parameters, or where a unit vector takes more multipliers than in such a row.
    """
    bits, switches = core.params[key], arm_model.SWITCHES if core.family == "arm" else ()

    def wide(value: int) -> bool:
        return key == "U" and core.family != "six" and value + 2 > MULTIPLIER

    near = {row.core.params[key]: row for row in rows()
            if row.core.name == core.name and flow in row.area and wide(row.core.params[key]) == wide(bits)
            and _built(row.core.params, key, *switches) == _built(core.params, key, *switches)}
    if not near:
        return None
    row = near[min(near, key=lambda one: (abs(one - bits), one))]
    own = bits in near and _built(row.core.params) == _built(core.params)
    if bits in near:
        return row.area[flow], row, own
    known = sorted(near)
    luts = np.interp(bits, known, [near[one].area[flow]["lut"] for one in known])
    end = min(max(bits, known[0]), known[-1])
    products = key == "U" and "dsp" not in CHIPS[flow] and core.function.removeprefix("arm_").startswith("fk")
    growth = (bits + 1) / (end + 1) if products and core.family != "six" else 1 + GROWTH * (bits - end)
    return row.area[flow] | {"lut": round(luts * growth)}, row, False


def share(area: dict[str, int], chip: str) -> float:
    """How much of the chip an area takes, its LUTs, multipliers and memories added up."""
    return sum(area[key] / there for key, (_, there) in CHIPS[chip].items())


# Cores at their parameters


def _reach(core: Core, arm: Arm) -> float:
    """The greatest coordinate that the core meets on the arm, mm."""
    if core.family in ("arm", "six"):
        return max(check.spans(arm).values())
    return arm.l1 if core.function in ("fk1", "ik1") else arm.l1 + arm.l2


def _fraction(core: Core, arm: Arm) -> int:
    """The most fraction bits with which the core's coordinates hold the arm; negative where none do."""
    return math.floor(math.log2((2 ** (core.params["W"] - 1) - 1) / (_reach(core, arm) / arm.mm_per_unit)))


def _served(row: Row, wish: Wish, word: dict[str, int]) -> Core:
    """The core of a row with another joint word, the arm's switches and the finest F whose words hold the arm."""
    width = row.core.params["W"]
    params = word | {"F": min(_fraction(row.core, wish.arm), width - 1)}
    if params["F"] < 0:
        raise Refused(f"{width} bits of a coordinate do not hold {_reach(row.core, wish.arm):g} mm at "
                      f"{wish.arm.mm_per_unit:g} mm a unit: raise mm_per_unit")
    while True:
        core = verilog.fitted(row.core, wish.arm, params)
        try:
            verilog.config(core, wish.arm)
            return core
        except Refused:
            if params["F"] == 0:
                raise
            params["F"] -= 1


def error(core: Core, wish: Wish) -> pose.Worst:
    """Greatest error of the core's bit-true model at the tip of the arm, words included; each worked out once."""
    same = (core.model_name, *(pair for pair in core.params.items() if pair[0] not in SAME_BITS))
    if same not in wish.known:
        wish.runs += 1
        if core.function in pose.FUNCTIONS:
            wish.known[same] = pose.worst(core, wish.arm, of_core.WORKSPACE)
        else:
            if "motion" not in wish.known:  # the same for all: it follows from arm, function and joint word
                wish.known["motion"] = accuracy.workspace_case(core, wish.arm, of_core.WORKSPACE,
                                                               np.random.default_rng(1))
            motion = wish.known["motion"]
            case = cases.case_of(core, wish.arm, motion.angles, motion.tip)
            found = accuracy.errors(core, wish.arm, case, of_core.modelled(core, case.inputs, case.cfg))
            wish.known[same] = pose.Worst(float(np.max(found.total)) * accuracy.mm_per_lsb(core, wish.arm))
    return wish.known[same]


def _figured(core: Core, wish: Wish, key: str) -> Answer | None:
    """The core with its area, clock and rate, and what it misses of these."""
    if (found := estimated(core, wish.chip, key)) is None:
        return None
    area, row, own = found
    about = "" if own else "at most" if core.family == "arm" and core.params[key] == row.core.params[key] else "about"
    mhz = wish.clock if wish.clock and wish.clock <= row.mhz else row.mhz
    answer = Answer(core, row, area, about, mhz, mhz * 1e6 / core.ii)
    if wish.clock and row.mhz < wish.clock:
        answer.misses.append((row.mhz / wish.clock, f"does not meet the clock: {row.mhz:g} of {wish.clock:g} MHz"))
    if wish.rate and answer.rate < wish.rate:
        answer.misses.append((answer.rate / wish.rate,
                              f"too slow: {answer.rate:.3g} of {wish.rate:.3g} results a second"))
    if len(off := [name for name, (_, there) in CHIPS[wish.chip].items() if area[name] > there]):
        answer.misses.append((0.01, f"is larger than the chip: {area[off[0]]} {CHIPS[wish.chip][off[0]][0]}"))
    return answer


def _judged(answer: Answer, wish: Wish) -> Answer:
    """The answer with its error, by the model."""
    answer.error = error(answer.core, wish)
    if wish.mm is not None and answer.error.mm > wish.mm:
        answer.misses.append((wish.mm / answer.error.mm,
                              f"too coarse: {answer.error.mm:.3g} of {wish.mm:g} mm"))
    return answer


def _word(core: Core, wish: Wish) -> str | None:
    """Why the core's joint words are not those asked for."""
    kinds = dict.fromkeys(port.type for port in (*core.inputs, *core.outputs) if port.type)
    asked = wish.word.ports[0].type
    if asked in kinds:
        return None
    kind = next(iter(kinds))
    pair = (asked, kind) if core.function.startswith(("fk", "arm_fk")) else (kind, asked)
    codec = next((one.name for one in cores.all_cores() if one.function == "{}_to_{}".format(*pair)), None)
    return f"its joints are {WORDS[kind]}s, not {WORDS[asked]}s" + (f"; {codec} converts them" * bool(codec))


def _one(group: list[Row], wish: Wish) -> Answer | str:
    """The smallest that fits of the sets of one core that differ in their words alone; else the nearest, or a reason.
    """
    joint = wish.word.ports[0]
    key, bits = PARAMETER[joint.type], joint.width - cores.TYPES[joint.type][1]
    found, reason = [], ""
    for row in group:
        try:
            core = _served(row, wish, {key: bits})
        except Refused as refusal:
            rule = str(refusal).partition(" is not supported: ")[2]
            reason = f"{key} = {bits} is not supported: {rule}" if rule else str(refusal)
            continue
        if answer := _figured(core, wish, key):
            found.append(answer)
        else:
            reason = f"no row of the report is near {key} = {core.params[key]}, so its area is not known"
    found.sort(key=lambda one: (len(one.misses), share(one.area, wish.chip), -one.core.params["W"]))
    for answer in found:
        if not _judged(answer, wish).misses:
            return answer
    return min(found, key=_far, default=reason)


def _far(answer: Answer) -> tuple[int, float]:
    """How far an answer is from the wish: how much it misses, and the worst of that."""
    return len(answer.misses), -min(miss[0] for miss in answer.misses)


def _groups(wish: Wish) -> Iterator[tuple[str, Core, list[Row]]]:
    """(name, core, rows) of every core of the function, one a way to build it."""
    for core in cores.all_cores():
        if core.function in functions(wish.function) and core.first_set:
            built = {key: core.params[key] for key in ("MODE", "PIPE") if key in core.params}
            group: dict[tuple, list[Row]] = {}
            for row in rows():
                if row.core.name == core.name and built.items() <= row.core.params.items():
                    ways = tuple(f"{key}={row.core.params[key]}" for key in ("MULTIPLY", "PRODUCTS")
                                 if row.core.params.get(key) != core.params.get(key))
                    group.setdefault(ways, []).append(row)
            for ways, some in (group or {(): []}).items():
                yield " ".join([title(core), *ways]), core, some


def choose(wish: Wish) -> tuple[list[tuple[str, Answer]], dict[str, str], tuple[str, Answer] | None]:
    """The cores that fit, smallest share of the chip first, and why each other one falls out.

    The last is, where none fits, the one that is nearest to the wish; None where none serves the arm.
    """
    if not rows():
        raise Refused("there is no report at hand: no area and no clock is known")
    known = [one for one in functions(wish.function) if one in (*accuracy.JOINTS, *pose.FUNCTIONS)]
    if not known:
        raise Refused(f"no error in mm is defined for {wish.function}; there are {', '.join(SERVED)}")
    fit, out, near = [], {}, []
    for name, core, group in _groups(wish):
        try:
            verilog.fitted(core, wish.arm, {})
            if core.family == "six":
                _ = wish.arm.six
        except (Refused, ArmError) as refusal:
            out[name] = str(refusal)
            continue
        found = _word(core, wish) or (_one(group, wish) if group else "no row of the report: area and clock unknown")
        if isinstance(found, str):
            out[name] = found
        elif found.misses:
            near.append((name, found))
            out[name] = " and ".join(text for _, text in found.misses)
        else:
            fit.append((name, found))
    fit.sort(key=lambda one: (share(one[1].area, wish.chip), one[1].ns))
    near.sort(key=lambda one: _far(one[1]))
    return fit, out, None if fit or not near else near[0]


def outside(core: Core, arm: Arm) -> bool:
    """Whether a driver has something to compute around the core, the machine's own zeros and signs left aside."""
    found = around(core, arm)
    places = (*found.before, *found.after)
    return any(one.split(" = ")[0] in ("x", "y", "z", "rho", "k", "r") for one in places)


def pasted(core: Core) -> str:
    """The core and its parameters as other commands take them: those that are not the first set's."""
    first = find(title(core))
    switches = arm_model.SWITCHES if core.family == "arm" else ()
    return " ".join([title(core), *(f"-p {key}={value}" for key, value in core.params.items()
                                    if value != first.params[key] and key not in switches)])


def entry(name: str, answer: Answer, wish: Wish) -> dict:
    """An answer as `quadrance choose --json` prints it."""
    area = {unit: answer.area[key] for key, (unit, _) in CHIPS[wish.chip].items()}
    return {"title": name, "core": answer.core.name, "params": answer.core.params, "area": area,
            "area_is": answer.estimate or "measured", "share": round(share(answer.area, wish.chip), 4),
            "latency": answer.core.latency, "ns": round(answer.ns, 1), "ii": answer.core.ii, "mhz": answer.mhz,
            "own_mhz": answer.row.mhz, "results_per_second": round(answer.rate),
            "error_mm": answer.error and answer.error.mm, "error_degrees": answer.error and answer.error.degrees,
            "beside_axis_mm": answer.error and answer.error.beside_mm,
            "offsets_outside": outside(answer.core, wish.arm), "instance": pasted(answer.core)}


def lines(entries: list[dict], out: dict[str, str], wish: Wish) -> list[str]:
    """The table of what fits and the reasons of the others, for a person."""
    found: list[str] = []
    if entries:
        units = [unit for unit, _ in CHIPS[wish.chip].values()]
        columns = [Column("core with its parameters", True), *map(Column, units), Column("share", rank=4),
                   Column("clocks", rank=3), Column("ns"), Column("MHz", rank=1), Column("results/s", rank=2),
                   Column("mm"), *([Column("degrees", rank=5)] * (entries[0]["error_degrees"] is not None))]
        rows = [(one["instance"], *(f"{SIGN[one['area_is']]}{one['area'][unit]}" if unit == units[0] else
                                    one["area"][unit] for unit in units), f"{one['share']:.1%}", one["latency"],
                 f"{one['ns']:.0f}", f"{one['mhz']:g}", f"{one['results_per_second']:.3g}", f"{one['error_mm']:.3g}",
                 *([f"{one['error_degrees']:.2g}"] if one["error_degrees"] is not None else [])) for one in entries]
        out_to = console()
        with out_to.capture() as text:
            out_to.print(grid(columns, rows, out_to.width))
        found += text.get().rstrip().split("\n")
        found += _remarks(entries, wish)
    reasons: dict[str, list[str]] = {}
    for name, reason in out.items():
        reasons.setdefault(reason.partition(f"{wish.arm.id}: ")[2] or reason, []).append(name)
    return [*found, *(f"not {', '.join(names)}: {reason}" for reason, names in reasons.items())]


def _remarks(entries: list[dict], wish: Wish) -> list[str]:
    """What the columns mean where it is not plain."""
    kinds = {one["area_is"] for one in entries}
    found = ["~ an estimate from rows of the report with other joint words"] * ("about" in kinds)
    found += ["<= the row has offsets that this arm does not need"] * ("at most" in kinds)
    found.append(f"share: {', '.join(unit for unit, _ in CHIPS[wish.chip].values())}, each as a part of "
                 f"{DEVICE[wish.chip]}, added up. mm: worst at the tip of {wish.arm.id}, by the model.")
    if wish.chip != "ecp5":
        found.append("The clock is that of an ECP5 (grade 6): the report measures no other.")
    if apart := [one for one in entries if one["beside_axis_mm"] is not None]:
        worst = max(one["beside_axis_mm"] for one in apart)
        found.append(f"Where the wrist is within {wish.arm.singular[1]:g} mm of axis 1 (singular.axis) the error is up "
                     f"to {worst:.2g} mm.")
    if names := [one["core"] for one in entries if one["offsets_outside"]]:
        found.append(f"Offsets of the arm are outside {', '.join(dict.fromkeys(names))}: `quadrance instance` has the "
                     "formulas.")
    return found
