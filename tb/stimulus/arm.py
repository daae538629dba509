"""Corners of rtl/arm: arms with every constant at its ends, targets at every border, both elbows, both shoulders."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from quadrance import arm, arm_keep, kernel_vector_wide
from quadrance.cores import Core
from quadrance.fixed import to_fixed

from tb.lib import stimulus
from tb.lib.stimulus import Vectors
from tb.stimulus import edges, rational, targets, vector
from tb.stimulus.vector import directions


def configs(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """Lengths and constants: none, the greatest of both signs, ordinary ones."""
    if core.function == "keep2":
        found = [*vector.configs(replace(core, function="ik2"), rng)[5:12], *_shifts(core)]
    elif core.function in ("arm_ik3", "keep3"):
        found = edges.joined(core, rng, _inverse(core, rng))
    else:
        found = _forward(core, rng)
    if core.function == "keep3":  # every sample is four of the kernel; the last one has the shortest links
        found = [*found[-7:], found[3]]
    if "keep" in core.function:
        found = [_limited(core, cfg, i, rng) for i, cfg in enumerate(found)]
    if core.function == "keep2":  # joint 2 of the longest links anywhere but folded, to the last word of its cosine
        one = 1 << core.params["U"]
        found[7] |= {"cfg_mc2": one, "cfg_mn2": 0, "cfg_h2": -one}
    if "keep" in core.function:
        found += _bordered(core, found[4])
    return [{port.name: cfg[port.name] for port in core.cfg} for cfg in found]


def draw(core: Core, rng: np.random.Generator) -> dict[str, int]:
    """Any words of a forward core; any links, offsets and limits of an inverse one."""
    p, half = core.params, 1 << core.params["W"] - 1
    if "cfg_q" not in {port.name for port in core.cfg}:
        return {port.name: int(rng.integers(port.low, port.high, endpoint=True)) for port in core.cfg}
    cfg = {f"cfg_l{i}": stimulus.length(rng, p["W"]) for i in (1, 2)}
    if core.function == "keep2":
        cfg |= kernel_vector_wide.config(p, **cfg)
    else:
        turn = rng.uniform(-np.pi, np.pi)
        ends = {"cfg_base": half, "cfg_shoulder": half // 4, "cfg_lateral": half}
        cfg |= arm.config(p, **cfg, **{name: int(rng.integers(1 - end, end)) for name, end in ends.items()},
                          cfg_ce=int(to_fixed(np.cos(turn), p["U"])), cfg_ne=int(to_fixed(-np.sin(turn), p["U"])))
        cfg |= edges.drawn(core, rng, cfg["cfg_l2"])
    return _limited(core, cfg, int(rng.integers(0, 9)), rng) if "keep" in core.function else cfg


def _shifts(core: Core) -> list[dict[str, int]]:
    """Links with the cfg_e that others leave out: 1, 5, 9, 13; and two of more than 2^(W-1) LSB that reach targets."""
    lengths = np.array([(40000, 30000), (33000, 9000), (1500, 1200), (100, 90), (6, 5)])
    more = core.params["W"] - 16
    lengths = lengths << more if more > 0 else lengths >> -more
    pairs = [{"cfg_l1": l1, "cfg_l2": l2} for l1, l2 in np.maximum(lengths, 1).tolist()]
    return [pair | kernel_vector_wide.config(core.params, **pair) for pair in pairs]


def _bends(core: Core, cfg: dict[str, int], rng: np.random.Generator) -> Vectors:
    """Targets that bend two long links by every segment of the table that the root of v = 1 - c2^2 comes from."""
    half, l1, l2 = 1 << core.params["W"] - 1, cfg["cfg_l1"], cfg["cfg_l2"]
    v = (np.arange(512) + 0.5) / 512
    shifts = kernel_vector_wide.SHIFTS if core.params["W"] > 16 else (0, 5)
    v = np.concatenate([v * 2.0**-shift for shift in shifts])
    c = np.sqrt(1 - v) * rng.choice([-1, 1], v.size)
    radius = np.sqrt(l1**2 + l2**2 + 2 * l1 * l2 * c)
    folded = np.sqrt(l1**2 + l2**2 - 2 * l1 * l2 * abs(c))
    radius = np.minimum(np.where(radius < 1.4 * half, radius, folded), 1.4 * half)
    least = np.arccos(np.minimum(half / radius, 1))  # from an axis: the words end there
    turn = rng.uniform(least, np.pi / 2 - least) + np.pi / 2 * rng.integers(0, 4, v.size)
    x, y = (np.clip(np.rint(radius * one(turn)), -half, half - 1).astype(np.int64) for one in (np.cos, np.sin))
    return {"in_x": x, "in_y": y}


def _limited(core: Core, cfg: dict[str, int], i: int, rng: np.random.Generator) -> dict[str, int]:
    """The configuration with limits of every joint: none, narrow ones, so narrow that no branch is within them."""
    cfg = dict(cfg)
    for joint in range(1, int(core.function[-1]) + 1):
        low, room = rng.uniform(-np.pi, np.pi), rng.uniform(0.5, 1.2) * 2 * np.pi if i % 3 else 7.0
        cfg |= arm_keep.limit(core.params, joint, low, low + (0.3 if i == 5 else room))
    return cfg


def _bordered(core: Core, cfg: dict[str, int]) -> list[dict[str, int]]:
    """Limits that one answer keeps by the last unit in every joint, then those that it misses by it in one of them.

    A limit of 1/2 is kept; limits of 1/2 and a unit, and of 1/2 less a unit, are missed. Below the first bit these are
    all zeros or all ones, so with one bit stuck in the core some answer is on the other side.
    """
    number, half = int(core.function[-1]), 1 << core.params["U"] - 1
    free = cfg | {name: word for i in range(1, number + 1) for name, word in
                  arm_keep.limit(core.params, i, -np.pi, np.pi).items()}
    free = {port.name: free[port.name] for port in core.cfg}
    answer = core.model(core.params, **corners(core, free), **free)
    joint = np.array([[answer[f"out_{letter}{i}"] for letter in "cn"] for i in range(1, number + 1)])
    clear = np.where(answer["out_status"] == 0, np.abs(joint).min(axis=(0, 1)), 0)  # the farthest from every axis
    farthest = joint[:, :, np.argmax(clear)].tolist()
    kept = free | {name: word for i, words in enumerate(farthest, 1)
                   for name, word in _limit(core, i, *words, half + 1, half).items()}
    return [kept, *(kept | _limit(core, i, *words, limit, limit) for limit in (half + 1, half - 1)
                    for i, words in enumerate(farthest, 1))]


def _limit(core: Core, joint: int, c: int, n: int, cosine: int, limit: int) -> dict[str, int]:
    """A limit of a joint, and a middle of its range whose cosine with the word (c, n) is `cosine` to the last unit."""
    u = core.params["U"]
    angle = np.arctan2(n, c) + np.arccos(cosine / (1 << u))
    middle = {"c": int(to_fixed(np.cos(angle), u)), "n": int(to_fixed(np.sin(angle), u))}
    # A unit more of the middle changes a product by one at most, so one of the two words reaches every cosine
    solved, by, rest = ("c", c, n * middle["n"] >> u) if abs(c) > abs(n) else ("n", n, c * middle["c"] >> u)
    wanted = cosine - rest << u
    middle[solved] = -(-wanted // by) if by > 0 else wanted // by
    return {f"cfg_m{name}{joint}": word for name, word in middle.items()} | {f"cfg_h{joint}": limit}


def _forward(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    rows = [[port.high for port in core.cfg], [port.low for port in core.cfg], [0] * len(core.cfg)]
    for scale in (1, 4, 4, 16):
        rows.append([int(rng.integers(port.low // scale, port.high // scale, endpoint=True)) for port in core.cfg])
    rows.append([{"cfg_sine": 0, "cfg_radius": 0}.get(port.name, port.high // 8) for port in core.cfg])  # no threshold
    found = [dict(zip((port.name for port in core.cfg), row)) for row in rows]
    long = found[2] | {"cfg_l1": core.cfg[0].high}, found[2] | {"cfg_l2": core.cfg[1].high, "cfg_l1": 7}
    return [*found, *long, *(_divisors(core) if "cfg_sine" in found[0] else [])]


def _divisors(core: Core) -> list[dict[str, int]]:
    """Nothing, and behind it almost no threshold, so that a flag that stays is seen; then lengths and thresholds that
    are powers of two, of which a divisor has one bit alone.
    """
    w, u = core.params["W"], core.params["U"]
    rows = [(0, 0, 0, 0), ((1 << w) - 1, (1 << w) - 1, 16, 16)]
    rows += [(1 << i, 1 << w - 1, 2 << min(i, u - 1), 2 << min(i, w - 2)) for i in range(0, w, 2)]
    names = ("cfg_l1", "cfg_l2", "cfg_sine", "cfg_radius")
    return [{port.name: dict(zip(names, row))[port.name] for port in core.cfg} for row in rows]


def _inverse(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    p, f = core.params, core.params["F"]
    high, half = (1 << p["W"]) - 1, 1 << p["W"] - 1
    links = [(high, high), (0, 0), (high, 1), (1, 1), (3 << f, 2 << f), (256 & high, 256 & high),
             (half // 4, half // 5), (half // 4, half // 4), *rng.integers(1, half // 2, (4, 2)).tolist(),
             (high, half // 3), (half // 3, high)]
    ends = {"cfg_base": half, "cfg_shoulder": half // 4, "cfg_lateral": half}
    found = []
    for i, (l1, l2) in enumerate(np.minimum(links, high).tolist()):
        reach = 4 * half if i in (0, 2) else min(l1 + l2 + 4, half)
        more = {name: int(np.clip(rng.integers(-reach, reach) // 2, 1 - end, end - 1)) for name, end in ends.items()}
        if i in (1, 4):
            more = {name: 0 for name in ends}
        turn = rng.uniform(-np.pi, np.pi) * (i != 4)
        more |= {"cfg_ce": int(to_fixed(np.cos(turn), p["U"])), "cfg_ne": int(to_fixed(-np.sin(turn), p["U"]))}
        found.append({"cfg_l1": l1, "cfg_l2": l2} | arm.config(p, cfg_l1=l1, cfg_l2=l2, **more))
    return found


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Directed inputs of one core; samples without a direction follow and precede regular ones, and come first."""
    rng = np.random.default_rng(1)
    if core.function == "arm_fk3":
        return stimulus.joined(directions(core, rng), stimulus.saturation(core, cfg))
    if core.function == "keep2":
        found = {name: words for name, words in targets.corners(core, cfg, rng).items() if name != "in_elbow"}
        long = min(cfg["cfg_l1"], cfg["cfg_l2"]) >> core.params["W"] - 2
        return stimulus.joined(found, _bends(core, cfg, rng)) if long else found
    if core.function == "keep3":
        found = _targets(core, cfg, rng)
        return {name: found[name] for name in ("in_x", "in_y", "in_z")}
    if core.function == "arm_ik3":
        return _targets(core, cfg, rng)
    found = _motions(core, rng)
    found = stimulus.joined(found, stimulus.saturation(core, cfg, found))
    if core.function.startswith("rates") and core.params["W"] > 16:  # divided by a small n2: a step is many LSB there
        found = stimulus.joined(found, stimulus.saturation(core, cfg, _motions(core, rng)))
    return found


def _motions(core: Core, rng: np.random.Generator) -> Vectors:
    """Directions as of rtl/vector with extreme, small and no rates or velocities; stretched and folded arms."""
    found = directions(core, rng)
    count, one = found["in_c1"].size, 1 << core.params["U"]
    straight = rng.random(count) < 0.3
    found["in_c2"][straight] = rng.choice([one, -one], straight.sum())
    found["in_n2"][straight] = rng.integers(-3, 4, straight.sum())
    for port in core.inputs:
        if port.type is None:
            words = np.where(rng.random(count) < 0.3, rng.choice(stimulus.extremes(port), count),
                             rng.integers(port.low, port.high, count, endpoint=True))
            found[port.name] = words >> np.where(rng.random(count) < 0.4, rng.integers(0, port.width, count), 0)
    if core.function.startswith("rates"):  # almost straight: a quotient by n2 is long
        straight = rng.random(count) < 0.1
        found["in_c2"][straight] = rng.choice([one, -one], straight.sum())
        found["in_n2"][straight] = rng.choice([one, -one], straight.sum()) * 2.0 ** -rng.uniform(3, 12, straight.sum())
    return found


def _targets(core: Core, cfg: dict[str, int], rng: np.random.Generator) -> Vectors:
    """Targets of `tb.rational`, as they are and about the shoulder; the yaw axis, the circle of the lateral offset."""
    p, half = core.params, 1 << core.params["W"] - 1
    found = rational.targets(core, cfg, rng)
    if p.get("MARGINS"):
        found = stimulus.joined(found, edges.targets(core, cfg, rng))
    x, y, z = (found[f"in_{axis}"] for axis in "xyz")
    base, shoulder, lateral = (cfg[f"cfg_{name}"] for name in ("base", "shoulder", "lateral"))
    back, yaw = rng.integers(0, 2, x.size), rng.uniform(-np.pi, np.pi, x.size)
    radius = np.hypot(x, y) * np.where(back, -1, 1) + shoulder * p["SHOULDER"]
    far = np.hypot(radius, lateral * p["LATERAL"])
    circle = np.abs(lateral) + rng.integers(-2, 3, x.size)  # next to the circle nearer than which nothing is reached
    far = np.where(rng.random(x.size) < 0.2, circle, far)
    if p.get("MARGINS"):
        close = np.hypot(cfg["cfg_margin"], lateral * p["LATERAL"]) + rng.integers(-2, 3, x.size)
        far = np.where(rng.random(x.size) < 0.1, close, far)
    moved = [np.rint(far * np.cos(yaw)), np.rint(far * np.sin(yaw)), z + base * p["BASE"]]
    moved = [np.clip(word, -half, half - 1).astype(np.int64) for word in moved]
    axis = rng.random(x.size) < 0.05
    moved[0][axis], moved[1][axis] = 0, 0
    if p["BASE"]:  # z - base at both ends of its word, inside and outside
        moved[2][:40] = np.clip(base + np.resize([half - 1, half, -half, -half - 1], 40), -half, half - 1)
    joined = [np.concatenate(pair) for pair in zip((x, y, z), moved)]
    return {"in_x": joined[0], "in_y": joined[1], "in_z": joined[2], "in_elbow": rng.integers(0, 2, 2 * x.size),
            "in_back": np.concatenate([rng.integers(0, 2, x.size), back])}
