"""This module writes a core's C header: its registers, a driver, and the configuration words of an arm."""

from __future__ import annotations

import re
from pathlib import Path

from quadrance import classic, kinematics_engine, six
from quadrance.arms import Arm
from quadrance.cli import frames, registers, verilog
from quadrance.cli.around import KEEPS, folded
from quadrance.cli.catalogue import Refused
from quadrance.cores import STATUS_BITS, Core, Port
from quadrance.cores import joints as joints_of
from quadrance.kernel_vector_wide import form
from quadrance.product_engine import ONE

SHARED = Path(__file__).with_name("quadrance.h")
LENGTHS = {  # of arms whose lengths are the words of the core
    "ur": {"d1": "arm->base", "d4": "arm->lateral", "d5": "arm->offset", "d6": "arm->flange", "l2": "arm->l1",
           "l3": "quadrance_line(arm)"},
    "srs": {"d": "arm->base", "l1": "arm->l1", "l2": "quadrance_line(arm)", "l4": "arm->flange"}}


def shares(core: Core) -> bool:
    """Whether the core's configuration follows from a quadrance_arm of the shared header."""
    return verilog.takes_an_arm(core) and core.function not in KEEPS


def _type(port: Port) -> str:
    return f"{'' if port.signed else 'u'}int{64 if port.width > 32 else 32}_t"


def _formulas(core: Core) -> tuple[list[str], dict[str, str]]:
    """Local variables, and the formula of every configuration word, of an `arm`."""
    p, function = core.params, core.function
    names = [port.name[4:] for port in core.cfg]
    if core.family == "six":
        fraction = p["F"] + six.MORE
        of = {"a1": "arm->shoulder", "a2": "-arm->elbow", "b": "arm->lateral", "c1": "arm->base", "c2": "arm->l1",
              "c3": "quadrance_forearm(arm)", "c4": "arm->flange"}
        found = {name: f"quadrance_fine(arm, {mm}, {fraction})" for name, mm in of.items()}
        found |= {name: f"six.{name}" for name in ("k", "cp", "np", "r", "e")}
        sine = "sin(quadrance_radians(arm->singular_elbow))"
        found |= {"radius": f"quadrance_fine(arm, arm->singular_axis, {p['F']})", "slack": "0",
                  "sine": f"quadrance_word(rint({sine} * {1 << p['U']}.0))",
                  "elbow": f"quadrance_fine(arm, hypot(arm->elbow, quadrance_forearm(arm)) * {sine}, {p['F']})"}
        found["margin"] = found["radius"] if p.get("MARGINS", 1) else "0"
        local = [f"const quadrance_six six = quadrance_six_of(arm, {p['W']}, {fraction}, {six.MORE}, {ONE}.0);"]
        return local if "k" in names else [], {name: found[name] for name in names}
    if core.family in LENGTHS:
        fraction, of = p["F"] + six.MORE, LENGTHS[core.family]
        found = {name: f"quadrance_fine(arm, {mm}, {fraction})" for name, mm in of.items()}
        found |= {"margin": f"quadrance_fine(arm, arm->singular_axis, {p['F']})", "slack": "0", "r": "triangle.r",
                  "e": "triangle.e"}
        one, two = list(of)[-2:] if core.family == "ur" else ("l1", "l2")
        local = [f"const quadrance_triangle triangle = quadrance_triangle_of({p['W']}, {six.MORE}, {ONE}.0, "
                 f"{found[one]}, {found[two]});"]
        return local if "r" in names else [], {name: found[name] for name in names}
    if not names:
        return [], {}
    f, w, u = p.get("F"), p.get("W"), p.get("U", 0)

    def length(mm: str) -> str:
        return f"quadrance_length(arm, {mm}, {f})"

    second = "quadrance_forearm(arm)" if function == "arm_fk3" else "quadrance_line(arm)"
    local = [f"const int64_t l1 = {length('arm->l1')};"]
    local += [f"const int64_t l2 = {length(second)};"] * bool({"l2", "s2", "far", "q"} & set(names))
    local += [f"const quadrance_gap gap = quadrance_gap_of({w}, l1, l2);"] * ("q" in names)
    absolute = 0 if core.family != "arm" else p.get("ABSOLUTE", 0)
    for i, name in enumerate(("shoulder", "elbow", "yaw")):
        if f"h{i + 1}" in names:
            less = "quadrance_elbow_angle(arm)" if i == 1 and function == "keep3" and not absolute \
                else "0.0"
            key = "forearm" if i == 1 and absolute else name
            local.append(f"const quadrance_limit limit{i + 1} = quadrance_limit_of(arm->{key}_limit[0], "
                         f"arm->{key}_limit[1], {less}, {u});")
    longest = (1 << (w or 1)) - 3
    shrink = [f"floor((double)quadrance_least({name}, {longest}) * {classic.SHRINK!r}" for name in ("l1", "l2")]
    turn = f"quadrance_fixed({{}}(quadrance_radians(quadrance_elbow_angle(arm))), {u})"
    found = {"l1": "l1", "l2": "l2", "l3": length("arm->l3"), "q": "gap.q", "r": "gap.r", "e": "gap.e",
             "margin": length("arm->singular_axis") if p.get("MARGINS") else "0", "slack": "0",
             "c1": f"quadrance_word({shrink[0]} * {2**classic.GUARD}.0))",
             "s1": f"quadrance_word({shrink[0]} * {2**classic.CHAIN_GUARD}.0))",
             "s2": f"quadrance_word({shrink[1]} * {classic.SHRINK!r} * sqrt(2.0) * {2**classic.CHAIN_GUARD}.0))",
             "far": "quadrance_square(l1 + l2)", "near": "quadrance_square(l1 - l2)",
             "f": f"quadrance_tangent({w}, l1, l2)",
             **{name: length(f"arm->{name}") for name in ("base", "shoulder", "lateral", "elbow")},
             "bb": f"-quadrance_square({length('arm->lateral')} * {1 << (form(p).bits - w if w else 0)})",
             "ce": turn.format("cos"), "ne": turn.format("-sin"),
             "sine": f"quadrance_fixed(sin(quadrance_radians(arm->singular_elbow)), {u})",
             "radius": length("arm->singular_axis"),
             **{f"{part}{i}": f"limit{i}.{part}" for i in (1, 2, 3) for part in ("mc", "mn", "h")}}
    return local, {name: found[name] for name in names}


def _range(core: Core, port: Port) -> tuple[int, int]:
    """What a configuration word may be: what the port holds, or less where the model says so."""
    return port.low + (core.family == "arm" and port.name == "cfg_lateral"), port.high


def _literal(value: int) -> str:
    return f"INT64_C({value})" if value > -(1 << 63) else "INT64_MIN"


def header(core: Core, arm: Arm | None = None) -> str:
    """The text of ``<core>.h``; `arm` gives the constants of an arm."""
    if any(port.width > 64 for port in (*core.cfg, *core.inputs, *core.outputs)):
        raise Refused(f"{core.id} has a word of more than 64 bits, which is no type of C")
    n, big = core.name, core.name.upper()
    words = registers.words(core)
    of = {word.port: [one for one in words if one.port == word.port] for word in words}
    outs = [port for port in core.outputs if port.name != "out_status"]
    shared = shares(core)
    lines = ["/* SPDX-License-Identifier: Apache-2.0 */",
             f"/* {core.name} behind registers; generated by `quadrance registers`, do not edit. C99 or C++11. */",
             f"#ifndef QUADRANCE_{big}_H", f"#define QUADRANCE_{big}_H", "#include <stdint.h>",
             '#include "quadrance.h"', "",
             f"#define {big}_IDENTITY UINT32_C(0x{registers.identity(core):08x})"]
    lines += [f"#define {big}_PARAMETER_{key} {value}" for key, value in core.params.items()]
    lines += ["", "/* byte addresses */",
              *(f"#define {big}_{name} 0x{at:03x}" for name, at in registers.CONTROL.items()),
              *(f"#define {big}_{word.name.upper()} 0x{word.address:03x}" for word in words), "", "/* bits of STATE */",
              *(f"#define {big}_{name.upper()} (UINT32_C(1) << {bit})" for name, bit in registers.STATE.items()),
              *(f"#define {big}_{name.upper()} (UINT32_C(1) << {registers.STATUS_LOW + STATUS_BITS[name]})"
                for name in core.status or ()), ""]
    if core.cfg:
        lines += ["/* configuration */", "typedef struct {",
                  *(f"    {_type(port)} {port.name[4:]};" for port in core.cfg), f"}} {n}_cfg;", ""]
    lines += ["/* a result; status as the core has it */", "typedef struct {",
              *(f"    {_type(port)} {port.name[4:]};" for port in outs), "    uint32_t status;", f"}} {n}_out;", "",
              f"static inline uint32_t {n}_read(const volatile uint32_t *core, unsigned at) {{",
              "    return core[at / 4];", "}",
              f"static inline void {n}_write(volatile uint32_t *core, unsigned at, uint32_t word) {{",
              "    core[at / 4] = word;", "}", "",
              "/* 1 where this core, at these parameters and with this map, answers */",
              f"static inline int {n}_probe(const volatile uint32_t *core) {{",
              f"    return {n}_read(core, {big}_ID) == {big}_IDENTITY;", "}"]

    def put(port: Port, value: str) -> list[str]:
        whole = f"(uint64_t){value}" if port.width > 32 else f"(uint32_t){value}"
        parts = {0: f"(uint32_t)({whole} & UINT32_MAX)" if port.width > 32 else whole, 32: f"(uint32_t)({whole} >> 32)"}
        return [f"    {n}_write(core, {big}_{word.name.upper()}, {parts[word.low]});" for word in of[port.name]]

    if core.cfg:
        lines += [f"static inline void {n}_configure(volatile uint32_t *core, const {n}_cfg *cfg) {{",
                  *(line for port in core.cfg for line in put(port, f"cfg->{port.name[4:]}")), "}"]
    arguments = "".join(f", {_type(port)} {port.name[3:]}" for port in core.inputs)
    names = "".join(f", {port.name[3:]}" for port in core.inputs)
    lines += [f"static inline void {n}_start(volatile uint32_t *core{arguments}) {{",
              *(line for port in core.inputs for line in put(port, port.name[3:])),
              f"    {n}_write(core, {big}_START, 1);", "}",
              f"static inline int {n}_done(const volatile uint32_t *core) {{",
              f"    return ({n}_read(core, {big}_STATE) & {big}_DONE) != 0;", "}",
              f"static inline void {n}_result(const volatile uint32_t *core, {n}_out *out) {{",
              f"    out->status = {n}_read(core, {big}_STATE) >> {registers.STATUS_LOW} & 15;"]
    for port in outs:
        parts = [f"{n}_read(core, {big}_{word.name.upper()})" for word in of[port.name]]
        value = parts[0] if len(parts) == 1 else f"((uint64_t){parts[1]} << 32 | {parts[0]})"
        lines.append(f"    out->{port.name[4:]} = ({_type(port)}){value};")
    lines += ["}", "/* one sample: start, poll, read */",
              f"static inline void {n}_run(volatile uint32_t *core{arguments}, {n}_out *out) {{",
              f"    {n}_start(core{names});", f"    while (!{n}_done(core)) {{ }}", f"    {n}_result(core, out);", "}",
              "/* by interrupt: enable it, start, and in its handler read the result and acknowledge */",
              f"static inline void {n}_interrupt(volatile uint32_t *core, int on) {{",
              f"    {n}_write(core, {big}_IRQ_ENABLE, on != 0);", "}",
              f"static inline void {n}_acknowledge(volatile uint32_t *core) {{",
              f"    {n}_write(core, {big}_STATE, {big}_DONE);", "}",
              "/* the flags refused and outside, which it clears */",
              f"static inline uint32_t {n}_flags(volatile uint32_t *core) {{",
              f"    const uint32_t found = {n}_read(core, {big}_STATE) & ({big}_REFUSED | {big}_OUTSIDE);",
              f"    {n}_write(core, {big}_STATE, found);", "    return found;", "}"]
    return "\n".join([*lines, *_joints(core), *(_arm(core) if shared else []), *_constants(core, arm),
                      *(_engine() if n == "kinematics_engine" else []), "#endif"]) + "\n"


def _engine() -> list[str]:
    """The commands of kinematics_engine, and what loads a program."""
    k = kinematics_engine
    return f"""
/* a program, as `quadrance assemble --image FILE.h` writes it */
typedef struct {{
    uint64_t header;
    const uint64_t *lines;
    unsigned count;
    uint32_t start;
    int one;    /* the input that has to be 1.0, or -1 */
}} kinematics_engine_program;
/* one command by polling: 0, or -1 where the core has refused it */
static inline int kinematics_engine_command(volatile uint32_t *core, uint32_t kind, uint32_t context, uint32_t at,
                                            uint64_t data) {{
    kinematics_engine_start(core, kind, context, at, data);
    while (!kinematics_engine_done(core)) {{ }}
    return kinematics_engine_read(core, KINEMATICS_ENGINE_OUT_REFUSED) ? -1 : 0;
}}
/* a word of s2.25 to an input of the program; the word of a result */
static inline void kinematics_engine_put(volatile uint32_t *core, uint32_t context, uint32_t input, int32_t word) {{
    kinematics_engine_command(core, {k.WRITE}, context, input, (uint32_t)word);
}}
static inline int32_t kinematics_engine_get(volatile uint32_t *core, uint32_t context, uint32_t output) {{
    kinematics_engine_command(core, {k.READ}, context, output, 0);
    return (int32_t)kinematics_engine_read(core, KINEMATICS_ENGINE_OUT_WORD);
}}
/* loads a program: 0, or -1 where it is not whole */
static inline int kinematics_engine_load(volatile uint32_t *core, const kinematics_engine_program *program) {{
    unsigned i;
    kinematics_engine_command(core, {k.LOAD}, 0, program->start, program->header);
    for (i = 0; i < program->count; i++) kinematics_engine_command(core, {k.LINE}, 0, 0, program->lines[i]);
    return kinematics_engine_command(core, {k.SEAL}, 0, program->start, program->header);
}}
/* before the first run of a context */
static inline void kinematics_engine_prepare(volatile uint32_t *core, uint32_t context,
                                             const kinematics_engine_program *program) {{
    if (program->one >= 0) kinematics_engine_put(core, context, (uint32_t)program->one, {ONE});
}}
/* a run: its start alone, for the interrupt, and by polling: 0, or -1 where the core has refused it */
static inline void kinematics_engine_begin(volatile uint32_t *core, uint32_t context,
                                           const kinematics_engine_program *program, uint32_t signs) {{
    kinematics_engine_start(core, {k.RUN}, context, program->start, signs);
}}
static inline int kinematics_engine_play(volatile uint32_t *core, uint32_t context,
                                         const kinematics_engine_program *program, uint32_t signs, uint32_t *status) {{
    const int refused = kinematics_engine_command(core, {k.RUN}, context, program->start, signs);
    *status = kinematics_engine_read(core, KINEMATICS_ENGINE_STATE) >> {registers.STATUS_LOW} & 15;
    return refused;
}}""".split("\n")


def _joints(core: Core) -> list[str]:
    """Conversions of the core's joint words, one for a kind."""
    n, lines, seen = core.name, [], set()
    for joint in joints_of((*core.inputs, *core.outputs)):
        kind, bits = joint[0].type, joint[0].width - {"angle": 0}.get(joint[0].type, 2)
        if kind in seen or kind == "half_tangent":
            continue
        seen.add(kind)
        if kind == "vector":
            lines += [f"static inline void {n}_vector(double degrees, int32_t *c, int32_t *n) {{",
                      f"    quadrance_vector(degrees, {bits}, c, n);", "}"]
            continue
        lines += [f"static inline uint32_t {n}_{kind}(double degrees) {{ return quadrance_{kind}(degrees, {bits}); }}",
                  f"static inline double {n}_degrees_of_{kind}(uint32_t word) {{",
                  f"    return quadrance_{kind}_degrees(word, {bits});", "}"]
    return ["", "/* joints */", *lines] if lines else []


def _arm(core: Core) -> list[str]:
    """The function that computes the configuration of an arm."""
    n = core.name
    if not core.cfg:
        return []
    local, formulas = _formulas(core)
    lines = ["", "/* Configuration of an arm; 0, or -1 where a word does not fit and cfg stays as it was. */",
             f"static inline int {n}_of_arm({n}_cfg *cfg, const quadrance_arm *arm) {{",
             *(f"    {line}" for line in local)]
    refusals = ["    if (!quadrance_sound(arm)) return -1;"]
    for port in core.cfg:
        name = port.name[4:]
        if formulas[name] != name:
            lines.append(f"    const int64_t {name} = {formulas[name]};")
    for port in core.cfg:
        low, high = _range(core, port)
        refusals.append(f"    if (!quadrance_fits({port.name[4:]}, {_literal(low)}, {_literal(high)})) return -1;")
    lines += refusals
    lines += [f"    cfg->{port.name[4:]} = ({_type(port)}){port.name[4:]};" for port in core.cfg]
    return [*lines, "    return 0;", "}"]


def _constants(core: Core, arm: Arm | None) -> list[str]:
    """The scale and the configuration words of an arm."""
    if arm is None:
        return []
    n, big, lines = core.name, core.name.upper(), ["", f"/* {_plain(arm.name)} */"]
    lines += [f"/* {_plain(one)} */" for one in frames.around(core, arm)]
    if "F" in core.params:
        w, f = core.params["W"], core.params["F"]
        lines += [f"#define {big}_MM_PER_UNIT {arm.mm_per_unit!r}",
                  "/* the coordinate nearest to millimetres, ties upward; folded where the argument is a constant */",
                  f"#define {big}_MM(mm) \\",
                  f"    ((int32_t)((int64_t)((mm) / {big}_MM_PER_UNIT * {1 << f}.0 + {1 << w + 4}.0 + 0.5) - "
                  f"INT64_C({1 << w + 4})))"]
    if {"in_r11", "in_x"} <= {port.name for port in core.inputs} and not arm.beside:
        lines += _pose(core, arm)
    if core.cfg:
        words = verilog.config(core, arm)
        lines += [f"static const {n}_cfg {n}_arm = {{",
                  *(f"    {words[port.name]}{'' if port.signed else 'U'}{'LL' if port.width > 32 else ''},"
                    f"  /* {port.name[4:]} */" for port in core.cfg), "};"]
    return lines


def _pose(core: Core, arm: Arm) -> list[str]:
    """The function that takes a pose of the robot's tool to the words of the core's target."""
    n, p, named = core.name, core.params, {"base": arm.base_frame, "tip": arm.tip_frame}
    seen = [_plain(frame.link) if frame else own for frame, own in zip(named.values(), ("the arm", "its tip"))]
    whole = folded(core, arm)[0]
    named = {"base": whole.base_frame, "tip": whole.tip_frame}
    lines = ["", f"/* words of a pose of {seen[1]} seen from {seen[0]}; 0, or -1 where one does not fit */",
             f"static inline int {n}_pose(int32_t words[12], const quadrance_frame *pose) {{",
             "    quadrance_frame own = *pose;"]
    for name, frame in named.items():
        if frame:
            numbers = ", ".join(map(repr, (*frame.xyz, *frame.rpy)))
            lines += [f"    const quadrance_frame {name} = quadrance_frame_of({numbers});",
                      f"    const quadrance_frame no_{name} = quadrance_inverse(&{name});"]
    lines += ["    own = quadrance_times(&no_base, &own);"] * bool(whole.base_frame)
    lines += ["    own = quadrance_times(&own, &no_tip);"] * bool(whole.tip_frame)
    return [*lines, f"    return quadrance_pose(words, &own, {arm.mm_per_unit!r}, {p['U']}, {p['W']}, {p['F']});", "}"]


def words(core: Core, arm: Arm | None, name: str | None = None) -> str:
    """The configuration words of an arm as constants of C, for a design with a register map of its own."""
    if arm is None:
        raise Refused("--format c prints the words of an arm: give --arm")
    name = name or core.name
    if not re.fullmatch(r"[A-Za-z]\w*", name):
        raise Refused(f"'{name}' is no name in C: letters, digits and _ alone, a letter first")
    lines = [f"/* {_plain(line)} */" for line in verilog.notes(core, arm)]
    found = verilog.config(core, arm)
    lines += [f"#define {name.upper()}_{key} {value}" for key, value in core.params.items()]
    return "\n".join([*lines, *(f"#define {name.upper()}_{port.name.upper()} {_literal(found[port.name])}"
                                for port in core.cfg)])


def _plain(text: str) -> str:
    """A text that ends no comment."""
    return re.sub(r"[^\x20-\x7e]|\*/|/\*|\\", "_", text)
