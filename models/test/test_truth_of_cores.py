"""Every kinematic core at every parameter set of rtl/cores.toml against float64 and exact integers, and there and back.

The models are the cores bit by bit (tb/ shows it). Errors are held to the derived bound of the set, flags to the
integers that the pages name, or to the band that the bound leaves; what a core claims stands in claims.py. Nothing
here is measured: beyond a core's own bound a round trip has what half an LSB of a word moves the tip.
"""

from __future__ import annotations

from dataclasses import fields

import numpy as np
import pytest
from quadrance import accuracy, bounds, classic, codecs, cordic, truth
from quadrance.cores import Core, all_cores, at, joints

from models.test.claims import CLAIMS, Claim, angles, distinct
from tb.lib import legal
from tb.lib.suite import SEED

UNREACHABLE, SINGULAR, OVERFLOW = 1, 2, 4
KINEMATIC = [core for core in distinct() if core.function in accuracy.JOINTS]
CORES = list({(core.model_name, core.set_id): core for core in KINEMATIC if core.family in CLAIMS}.values())
INVERSE = [core for core in CORES if core.function in ("ik2", "ik3")]
SHARES = [(0.25, 0.25), (0.3, 0.14), (0.1, 0.35), (0.02, 0.4)]  # of 2^(W - 1): equal, either longer, a large hole
LINKS = pytest.mark.parametrize("share", SHARES, ids=str)


def cores(choice: list[Core]):
    """One test a core and parameter set; architectures of one function share a model."""
    return pytest.mark.parametrize("core", choice, ids=lambda core: core.id)


def claim_of(core: Core, share: tuple[float, float]) -> Claim:
    """The core's claim at links of that share of a word."""
    return CLAIMS[core.family](core, *(max(1, round(part * (1 << core.params["W"] - 1))) for part in share))


def run(claim: Claim, **inputs: np.ndarray) -> dict[str, np.ndarray]:
    """The core's model at the claim's links."""
    cfg = accuracy.configure(claim.core, cfg_l1=claim.l1, cfg_l2=claim.l2) if claim.core.cfg else {}
    return claim.core.model(claim.core.params, **inputs, **cfg)


def near_borders(bits: int, count: int, rng: np.random.Generator) -> np.ndarray:
    """Words of a full turn, log-uniform about both sides of all four borders, every second one uniform."""
    off = np.floor(2.0 ** rng.uniform(0, bits - 2, count)).astype(np.int64) - 1
    words = (rng.integers(0, 4, count) << bits - 2) + rng.choice([-1, 1], count) * off
    words[::2] = rng.integers(0, 1 << bits, words[::2].size)
    return words & (1 << bits) - 1


def joint_words(core: Core, count: int, rng: np.random.Generator) -> dict[str, np.ndarray]:
    """Words of every joint of a forward core, near all borders."""
    return {name: words for joint in joints(core.inputs) for name, words in
            codecs.words_at(joint, near_borders((4 * codecs.quadrant(joint)).bit_length() - 1, count, rng)).items()}


def decoded(core: Core, words: dict[str, np.ndarray]) -> list[np.ndarray]:
    """The joints that the words stand for."""
    return [codecs.decode(joint, words) for joint in joints(core.inputs)]


def vectors(axes: int, full: int, radii: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Integer vectors of those lengths: all directions, and log-uniform about every axis and plane on either side."""
    way = rng.normal(size=(axes, radii.size))
    way[:, ::2] *= 2.0 ** -rng.uniform(0, full.bit_length(), way[:, ::2].shape)
    return np.clip(np.rint(radii * way / np.linalg.norm(way, axis=0)), -full, full - 1).astype(np.int64)


def targets(claim: Claim, count: int = 2000) -> tuple[np.ndarray, np.ndarray]:
    """Targets (axes, N) without the axis of joint 3: in reach, log-uniform at both circles, in the hole, beyond."""
    rng, full = np.random.default_rng(11), 1 << claim.p["W"] - 1
    near, far = abs(claim.l1 - claim.l2), claim.l1 + claim.l2
    crowd = (far - near) * 2.0 ** -rng.uniform(0, claim.p["W"], (2, count))
    hole, beyond = near * 2.0 ** -rng.uniform(0, claim.p["W"], count), rng.uniform(far, max(far, 1.7 * full), count)
    radii = np.concatenate([rng.uniform(near, far, count), near + crowd[0], far - crowd[1], hole, beyond])
    found = vectors(claim.joints, full, radii, rng)
    found = found[:, (found[:2] != 0).any(axis=0)]
    return found, rng.integers(0, 2, found.shape[1])


def named(target: np.ndarray) -> dict[str, np.ndarray]:
    return dict(zip(("in_x", "in_y", "in_z"), target))


def solution(claim: Claim, target: np.ndarray, elbow: np.ndarray) -> list[np.ndarray]:
    """The exact joints."""
    return list((truth.ik2 if claim.joints == 2 else truth.ik3)(*target, claim.l1, claim.l2, elbow))


def tip_of(claim: Claim, theta: list[np.ndarray]) -> np.ndarray:
    """The exact tip."""
    if claim.joints == 1:
        return np.stack(truth.fk1(*theta, claim.l1))
    return np.stack((truth.fk2 if claim.joints == 2 else truth.fk3)(*theta, claim.l1, claim.l2))


def test_every_kinematic_family_has_its_claim() -> None:
    missing = sorted({core.family for core in KINEMATIC} - set(CLAIMS))
    assert not missing, f"models/test/claims.py says nothing of {missing}: its cores are held to no truth"


@LINKS
@cores([core for core in CORES if core.function.startswith("fk")])
def test_forward(core: Core, share: tuple[float, float]) -> None:
    claim, rng = claim_of(core, share), np.random.default_rng(12)
    words = joint_words(core, 10_000, rng)
    exact = tip_of(claim, decoded(core, words))
    answer = run(claim, **words)
    error = np.stack([answer[f"out_{axis}"] for axis in "xyz"[:len(exact)]]) - exact
    assert np.abs(error).max() <= claim.coordinate() + 1e-9
    assert np.abs(error).max() > 0.4 or core not in CORES  # a few words may all be exact
    assert not answer["out_status"].any()


@cores([core for core in CORES if core.function.startswith("fk")])
def test_forward_overflow_is_exact_to_the_bound(core: Core) -> None:
    """Links that saturate; words are sought whose coordinates come close to the end of the word."""
    claim, rng = claim_of(core, (1.06, 0.9) if core.function == "fk1" else (0.8, 0.7)), np.random.default_rng(13)
    words = joint_words(core, 30_000, rng)
    exact = tip_of(claim, decoded(core, words))
    answer = run(claim, **words)
    must, may = claim.overflow(exact)
    flag = answer["out_status"] == OVERFLOW
    assert np.all(flag[must]) and not np.any(flag[~may]) and must.sum() > 500 and (~may).sum() > 500
    high = (1 << core.params["W"] - 1) - 1
    word = np.stack([answer[f"out_{axis}"] for axis in "xyz"[:len(exact)]])
    held = np.clip(exact, -high - (not claim.symmetric), high)
    if core.family != "paper" or core.function == "fk1":
        assert np.abs(word - held).max() <= claim.coordinate() + 1e-9
    else:
        assert np.all(np.abs(word[:, must]) == high)


@cores([core for core in CORES if core.name == "paper_fk1"])
def test_paper_fk1_in_integers(core: Core) -> None:
    """The magnitude is the root of L1^2 s to nearest, ties away from zero; overflow exactly where it rounds so far."""
    s, w, rng = core.params["S"], core.params["W"], np.random.default_rng(14)
    joint, length = near_borders(2 + s, 40_000, rng), rng.integers(0, 1 << w, 40_000)
    joint[:2000], length[:2000] = (np.arange(2000) % 4 << s) + (1 << s - 2), rng.integers(0, 1 << w - 1, 2000) | 1
    answer = core.model(core.params, in_j1=joint, cfg_l1=length)
    quadrant, fraction = joint >> s, joint & (1 << s) - 1
    beyond = np.zeros(joint.shape, dtype=bool)
    for axis, fall, sign in (("x", quadrant % 2 == 0, np.where((quadrant == 1) | (quadrant == 2), -1, 1)),
                             ("y", quadrant % 2 == 1, np.where(quadrant >= 2, -1, 1))):
        square = length * length * np.where(fall, (1 << s) - fraction, fraction)  # of the magnitude, times 2^S
        size = answer[f"out_{axis}"] * sign
        over = 4 * square >= ((1 << w) - 1) ** 2 << s
        assert np.all(size[over] == (1 << w - 1) - 1)
        inside = ~over
        assert np.all(((2 * size - 1) ** 2 << s <= 4 * square)[inside & (size > 0)])  # a tie goes up: <=
        assert np.all((4 * square < (2 * size + 1) ** 2 << s)[inside])
        beyond |= over
    assert np.array_equal(answer["out_status"] == OVERFLOW, beyond)


@cores([core for core in CORES if core.function == "ik1"])
def test_direction(core: Core) -> None:
    claim, rng, full = claim_of(core, SHARES[0]), np.random.default_rng(15), 1 << core.params["W"] - 1
    target = vectors(2, full, 2.0 ** rng.uniform(0, core.params["W"] - 0.5, 40_000), rng)
    answer = run(claim, **named(target))
    seen = (target != 0).any(axis=0)
    assert np.array_equal(answer["out_status"], np.where(seen, 0, SINGULAR))
    exact = np.arctan2(target[1], target[0])
    off = np.abs(truth.difference(angles(claim, answer, [exact])[0], exact))[seen]
    assert np.all(off <= claim.direction(np.hypot(*target)[seen]))


@LINKS
@cores(INVERSE)
def test_inverse(core: Core, share: tuple[float, float]) -> None:
    """The tip in reach and its nearest point beyond; unreachable where the integers say so."""
    claim = claim_of(core, share)
    target, elbow = targets(claim)
    answer = run(claim, **named(target), in_elbow=elbow)
    exact, status = solution(claim, target, elbow), answer["out_status"]
    must, may = claim.unreachable(target)
    flag = status & UNREACHABLE > 0
    assert np.all(flag[must]) and not np.any(flag[~may])
    tip = tip_of(claim, angles(claim, answer, exact))
    length = np.sqrt((target.astype(float) ** 2).sum(axis=0))
    near, far = abs(claim.l1 - claim.l2), claim.l1 + claim.l2
    beyond = (length > far) | (length < near)
    defined = status & SINGULAR == 0
    inside = ~flag & ~beyond & defined
    assert np.all((np.linalg.norm(tip - target, axis=0) <= claim.reached(target))[inside])
    out = flag & beyond & defined
    error = np.linalg.norm(tip - target * np.clip(length, near, far) / length, axis=0)
    assert np.all((error <= claim.nearest(target))[out])
    assert inside.sum() > 600 and out.sum() > 600


@LINKS
@cores(INVERSE)
def test_held_words_at_the_base(core: Core, share: tuple[float, float]) -> None:
    """The origin: joint 1 (and the yaw) keeps its word, 0 after reset; joint 2 is folded, unreachable where there is a
    hole."""
    claim = claim_of(core, share)
    some = claim.l1 + claim.l2 >> 1
    x = np.array([0, 0, some, 0, 0, -some, 0])
    target = np.stack([x, np.where(x, some // 3, 0), np.where(x, some // 5, 0)][:claim.joints])
    answer = run(claim, **named(target), in_elbow=np.array([0, 1, 0, 0, 1, 1, 1]))
    base = x == 0
    assert np.array_equal(answer["out_status"] & SINGULAR > 0, base)
    assert np.array_equal((answer["out_status"] & UNREACHABLE > 0)[base], np.full(5, claim.l1 != claim.l2))
    found = joints(core.outputs)
    for joint in found[:1] + found[2:]:
        for name, zero in codecs.encode(joint, 0.0).items():
            word = answer[name]
            assert word[:2].tolist() == [zero, zero] and word[3] == word[4] == word[2] and word[6] == word[5]
    off = np.abs(truth.difference(codecs.decode(found[1], answer), np.pi))[base]
    if claim.l1 != claim.l2:
        assert off.max() <= claim.folded() * truth.TURN / (4 * codecs.quadrant(found[1])) + 1e-12


@LINKS
@cores([core for core in INVERSE if core.function == "ik3"])
def test_the_yaw_axis_at_every_height(core: Core, share: tuple[float, float]) -> None:
    """x = y = 0: the yaw is held, the arm still reaches its height, all z up to 12 bits, every fifth at 16, and as many
    of more bits.
    """
    claim, full = claim_of(core, share), 1 << core.params["W"] - 1
    z = np.arange(-full, full, 1 if full <= 2048 else max(5, full * 5 >> 15) | 1)
    z = np.unique(np.append(z, np.arange(max(-full, -40), min(full, 41))))
    rest = claim.l1 + claim.l2 >> 1
    target = np.zeros((3, z.size + 1), dtype=np.int64)
    target[0, 0], target[1, 0], target[2, 1:] = rest, -rest, z
    elbow = np.arange(z.size + 1) % 2
    answer = run(claim, **named(target), in_elbow=elbow)
    assert all(np.all(answer[port.name] == answer[port.name][0]) for port in joints(core.outputs)[2])
    assert np.all(answer["out_status"][1:] & SINGULAR)
    must, may = claim.unreachable(target)
    flag = answer["out_status"] & UNREACHABLE > 0
    assert np.all(flag[must]) and not np.any(flag[~may])
    exact = list(truth.ik2(np.abs(0.0 * target[2]), target[2], claim.l1, claim.l2, elbow))
    theta = angles(claim, answer, [*exact, 0 * exact[0]])[:2]
    tip = np.stack(truth.fk2(*theta, claim.l1, claim.l2))
    size = np.abs(target[2]).astype(float)
    near, far = abs(claim.l1 - claim.l2), claim.l1 + claim.l2
    wanted = np.sign(target[2]) * np.clip(size, near, far)
    error = np.hypot(tip[0], tip[1] - wanted)
    seen = claim.quadrances(target).sum(axis=0) > 0
    seen[0] = False
    beyond = (size > far) | (size < near)
    inside = seen & ~flag & ~beyond
    assert np.all(error[inside] <= claim.reached(target[:, inside]))
    out = seen & flag & beyond
    assert np.all(error[out] <= claim.nearest(target[:, out]))


@cores([core for core in INVERSE if core.family == "paper"])
def test_paper_singular_is_per_coordinate(core: Core) -> None:
    """Singular exactly where every coordinate by itself is cut to 0: shorter than u."""
    claim = claim_of(core, SHARES[1])
    u = 2.0 ** (core.params["F"] - min(core.params["S"], 2 * core.params["F"]) / 2)
    grid = np.stack([axis.ravel() for axis in np.meshgrid(*[np.arange(-24, 25, 3 if claim.joints == 3 else 1)] *
                                                          claim.joints)])
    answer = run(claim, **named(grid), in_elbow=np.zeros(grid.shape[1], dtype=np.int64))
    assert np.array_equal(answer["out_status"] & SINGULAR > 0, (np.abs(grid[:2]) < u).all(axis=0))
    if claim.joints == 3:  # joint 1 needs the height too
        held = answer["out_j1"] == np.append(0, answer["out_j1"][:-1])
        assert np.all(held[(np.abs(grid) < u).all(axis=0)])


@cores([core for core in INVERSE if core.family == "paper"])
def test_paper_overflow_is_a_link_out_of_range(core: Core) -> None:
    half = 1 << core.params["W"] - 1
    for l1, l2, flag in ((half - 1, half - 1, 0), (half, 5, 4), (5, half, 4), (2 * half - 1, 0, 4)):
        claim = CLAIMS[core.family](core, l1, l2)
        target, elbow = targets(claim, 50)
        assert np.all(run(claim, **named(target), in_elbow=elbow)["out_status"] & OVERFLOW == flag)


# That the tests can fail


class Broken(Core):
    """A core whose model is changed on purpose."""

    change = staticmethod(lambda model, p, **words: model(p, **words))

    @property
    def model(self):
        """The changed model."""
        return lambda p, **words: self.change(super(Broken, self).model, p, **words)

    __hash__ = Core.__hash__


def broken(core: Core, change) -> Core:
    """`core` with `change(model, p, **words)` for its model."""
    kind = type("Changed", (Broken,), {"change": staticmethod(change)})
    return kind(**{part.name: getattr(core, part.name) for part in fields(Core)})


def find(name: str) -> Core:
    return next(core for core in all_cores() if core.id == name)


def test_a_scaled_coordinate_of_a_short_word_is_seen() -> None:
    """x times 15/16 where W < 16."""
    scale = lambda model, p, **words: model(p, **words | {"in_x": words["in_x"] * 15 >> 4})  # noqa: E731
    for name in ("rational_ik2-W12S16", "classic_ik2-iter-W12A10", "classic_ik3-iter-W12A10"):
        with pytest.raises(AssertionError):
            test_inverse(broken(find(name), scale), SHARES[1])
    for name in ("rational_ik1-W8S16", "classic_ik1-iter-W12A10"):
        with pytest.raises(AssertionError):
            test_direction(broken(find(name), scale))
    for name in ("classic_fk1-iter-W12A10", "classic_fk2-iter-W12A10", "classic_fk3-iter-W12A10"):
        with pytest.raises(AssertionError):
            test_forward(broken(find(name), lambda model, p, **words: (answer := model(p, **words)) | {
                "out_x": answer["out_x"] * 15 >> 4}), SHARES[1])


def test_a_third_of_a_word_is_seen() -> None:
    """classic_ik1 at W = 12, A = 10, its angle 0.35 LSB high before it is rounded to a word."""
    def shifted(model, p, **words):
        aim = cordic.aim
        try:
            classic.aim = lambda w, a, *rest: (None, (aim(w, a + 5, *rest)[1] + round(0.35 * 32) + 16 >> 5) % (1 << a))
            high = model(p, **words)
        finally:
            classic.aim = aim
        return high

    for change, red in ((shifted, True), (lambda model, p, **words: model(p, **words), False)):
        core = broken(find("classic_ik1-iter-W12A10"), change)
        if red:
            with pytest.raises(AssertionError):
                test_direction(core)
        else:
            test_direction(core)


def test_flags_a_word_too_early_or_late_are_seen() -> None:
    for name in ("rational_ik2-S24", "classic_ik2-iter-A16", "paper_ik2-S24", "paper_ik2-S8"):
        with pytest.raises(AssertionError):
            test_inverse(broken(find(name), lambda model, p, **words: (answer := model(p, **words)) | {
                "out_status": np.roll(answer["out_status"], 1)}), SHARES[1])


def test_laws_hold_where_a_word_is_much_shorter_than_another() -> None:
    """Few bits of an angle for many of a coordinate; more bits of a spread than of a coordinate's fraction."""
    test_direction(at(find("classic_ik1-iter-A16"), {"W": 11, "F": 1, "A": 5}))
    for name in ("paper_fk2-S8", "paper_fk3-S8"):
        test_forward(at(find(name), {"W": 13, "F": 3, "S": 10}), SHARES[1])


# The long run


@pytest.mark.slow
@pytest.mark.parametrize("core", [core for core in CORES if core.first_set], ids=lambda core: core.name)
def test_random_sets_against_the_truth(core: Core) -> None:
    """Six random legal parameter sets of each core, other ones with every seed: the laws are laws of the parameters."""
    for params in legal.legal(core, 6, SEED):
        one = at(core, params)
        print(one.id)
        if core.function == "ik1":
            test_direction(one)
        elif core.function.startswith("fk"):
            test_forward(one, SHARES[1])
            test_forward_overflow_is_exact_to_the_bound(one)
        else:
            test_inverse(one, SHARES[1])
            test_inverse(one, SHARES[3])
            test_held_words_at_the_base(one, SHARES[2])


# Inverse after forward and forward after inverse, along paths and past singular points, in all three families

ARMS = [(32.5, 27.5), (20.0, 20.0), (15.0, 30.0)]  # units: L1 > L2, L1 = L2, L1 < L2


def pairs() -> list[tuple[Core, Core]]:
    """(forward, inverse) cores of two and three joints, Q7.8, of one family and one length of joint words."""
    cores = [core for core in all_cores() if (core.params.get("W"), core.params.get("F")) == (16, 8)]
    found: dict[tuple, tuple[Core, Core]] = {}
    for forward in cores:
        for inverse in cores:
            if (forward.function, inverse.function) in (("fk2", "ik2"), ("fk3", "ik3")) \
                    and forward.family == inverse.family and forward.inputs[0].width == inverse.outputs[0].width:
                found.setdefault((forward.model_name, forward.inputs[0].width), (forward, inverse))
    return list(found.values())


PAIRS = pytest.mark.parametrize("forward, inverse", pairs(), ids=lambda core: core.id)
LENGTHS = pytest.mark.parametrize("l1, l2", ARMS)


def run_at(core: Core, l1: float, l2: float, **inputs: np.ndarray) -> dict[str, np.ndarray]:
    """The core's model at link lengths in units."""
    words = accuracy.configure(core, cfg_l1=round(256 * l1), cfg_l2=round(256 * l2))
    return core.model(core.params, **inputs, **words)


def answered(core: Core, words: dict[str, np.ndarray]) -> list[np.ndarray]:
    """Joint angles of an inverse core's answer."""
    return [codecs.decode(joint, words) for joint in joints(core.outputs)]


def tip_at(theta: list[np.ndarray], l1: float, l2: float) -> np.ndarray:
    """Tip (N, 2 or 3) of two or three joints in LSB."""
    return np.stack((truth.fk2 if len(theta) == 2 else truth.fk3)(*theta, 256 * l1, 256 * l2), axis=-1)


def half_word(core: Core, words: dict[str, np.ndarray], l1: float, l2: float) -> np.ndarray:
    """How far half an LSB of every joint word moves the tip at most, LSB."""
    theta = answered(core, words)
    home, moved = tip_at(theta, l1, l2), 0.0
    for i, joint in enumerate(joints(core.outputs)):
        cells = [codecs.within_cell(joint, words, theta[i] + side * 4 * codecs.half_step(joint)) for side in (-1, 1)]
        steps = [tip_at([*theta[:i], end, *theta[i + 1:]], l1, l2) for end in cells]
        moved = moved + np.max([np.linalg.norm(step - home, axis=-1) for step in steps], axis=0)
    return moved


def reached(joints: int, l1: float, l2: float, inset: float, count: int = 20_000) -> tuple[np.ndarray, np.ndarray]:
    """Words (N, axes) all over the annulus but `inset` units at its rims, a third near the axes; and the elbow."""
    rng = np.random.default_rng(7)
    radius = rng.uniform(abs(l1 - l2) + inset, l1 + l2 - inset, count)
    turn = rng.uniform(-np.pi, np.pi, (2, count))
    near = rng.integers(0, 4, (2, count)) * np.pi / 2 + rng.normal(size=(2, count)) * 2.0 ** -rng.integers(2, 16, count)
    turn = np.where(rng.random((2, count)) < 1 / 3, near, turn)
    c, n = truth.unit(turn)
    tip = [c[0], n[0]] if joints == 2 else [c[0] * c[1], c[0] * n[1], n[0]]
    return np.rint(256 * radius * np.stack(tip)).T.astype(np.int64), rng.integers(0, 2, count)


def fed(forward: Core, words: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """An inverse core's answer as inputs of a forward one."""
    return {port.name: words[port.name.replace("in_", "out_")] for port in forward.inputs}


def solve(inverse: Core, tip: np.ndarray, elbow: np.ndarray, l1: float, l2: float) -> dict[str, np.ndarray]:
    return run_at(inverse, l1, l2, **{f"in_{axis}": tip[:, i] for i, axis in enumerate("xyz"[:tip.shape[1]])},
               in_elbow=elbow)


@LENGTHS
@PAIRS
def test_forward_of_inverse_is_the_target(forward: Core, inverse: Core, l1: float, l2: float) -> None:
    joints = accuracy.JOINTS[forward.function]
    there, back = (bounds.tip(core, 256 * l1, 256 * l2) for core in (forward, inverse))
    tip, elbow = reached(joints, l1, l2, inset=1.0)
    words = solve(inverse, tip, elbow, l1, l2)
    assert not np.any(words["out_status"] & (UNREACHABLE | 4))
    answer = run_at(forward, l1, l2, **fed(forward, words))
    error = np.linalg.norm(np.stack([answer[f"out_{axis}"] for axis in "xyz"[:tip.shape[1]]], axis=-1) - tip, axis=-1)
    defined = words["out_status"] == 0
    assert np.mean(defined) > 0.8
    assert np.all((error <= there + back + half_word(inverse, words, l1, l2))[defined])
    turned = np.sin(answered(inverse, words)[1])
    limit = 0.6 if inverse.params.get("S") == 8 else 0.2  # sin theta2 that no error of a word can turn round
    clear = np.abs(turned) > limit
    assert np.mean(clear) > 0.3 and np.all((turned < 0)[clear] == (elbow == 1)[clear])


@LENGTHS
@PAIRS
def test_inverse_of_forward_is_the_joints_up_to_the_elbow(forward: Core, inverse: Core, l1: float, l2: float) -> None:
    joints = accuracy.JOINTS[forward.function]
    there, back = (bounds.tip(core, 256 * l1, 256 * l2) for core in (forward, inverse))
    tip, elbow = reached(joints, l1, l2, inset=2.0, count=5000)
    words = solve(inverse, tip, elbow, l1, l2)  # joint words that reach all over the annulus
    asked = answered(inverse, words)
    answer = run_at(forward, l1, l2, **fed(forward, words))
    again = solve(inverse, np.stack([answer[f"out_{axis}"] for axis in "xyz"[:tip.shape[1]]], axis=-1), elbow, l1, l2)
    defined = (words["out_status"] | again["out_status"]) == 0
    assert np.mean(defined) > 0.8
    moved = np.linalg.norm(tip_at(answered(inverse, again), l1, l2) - tip_at(asked, l1, l2), axis=-1)
    assert np.all((moved <= there + back + half_word(inverse, again, l1, l2))[defined])


@PAIRS
def test_paths_through_every_border_and_past_the_singular_points(forward: Core, inverse: Core) -> None:
    """Steps of one LSB through all quadrants of the target, the stretched and the folded arm, and the base axis."""
    l1, l2 = 20.0, 20.0
    joints = accuracy.JOINTS[forward.function]
    back = bounds.tip(inverse, 256 * l1, 256 * l2)
    step = np.arange(-42 * 256, 42 * 256 + 1)
    circle = 256 * 25 * np.stack(truth.unit(np.linspace(0, 2 * np.pi, 40_000)))
    paths = [np.stack([step, 0 * step]), np.stack([0 * step, step]), np.stack([step, 0 * step + 3]), circle]
    for path in paths:
        plane = np.rint(path).astype(np.int64).T
        tip = plane if joints == 2 else np.stack([plane[:, 0], 0 * plane[:, 0] + 5, plane[:, 1]], axis=-1)
        for elbow in (0, 1):
            words = solve(inverse, tip, np.full(len(tip), elbow), l1, l2)
            status, reached = words["out_status"], tip_at(answered(inverse, words), l1, l2)
            radius = np.linalg.norm(tip, axis=-1)
            beyond = radius > 256 * (l1 + l2)
            must, may = CLAIMS[inverse.family](inverse, round(256 * l1), round(256 * l2)).unreachable(tip.T)
            assert np.all((status & UNREACHABLE > 0)[must]) and not np.any((status & UNREACHABLE > 0)[~may])
            nearest = tip * np.where(beyond, 256 * (l1 + l2) / np.maximum(radius, 1), 1.0)[:, None]
            undefined = status & SINGULAR > 0
            assert np.all(undefined[radius == 0])
            far = np.abs(radius - 256 * (l1 + l2)) > 256 * 1.0  # the singular circle has its own law
            error = np.linalg.norm(reached - nearest, axis=-1)
            assert np.all((error <= back + 1 + half_word(inverse, words, l1, l2))[~undefined & far & (radius > 512)])
