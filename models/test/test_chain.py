"""The streamed chains against the truth: every position of chains of every number of links, at every parameter set."""

import numpy as np
import pytest
from quadrance import chain, codecs, truth
from quadrance.bounds import chain as bounds
from quadrance.bounds import paper
from quadrance.cores import joints

from models.test.claims import distinct

SPACE = [pytest.param(core, id=core.id) for core in distinct() if core.params.get("SPACE")]
CORES = [pytest.param(core, id=core.id) for core in distinct() if core.function == "chain"
         and not core.params.get("SPACE")]
FIXED = [pytest.param(core, id=core.id) for core in distinct() if core.function == "mff"]
VECTORS = [core for core in CORES if core.values[0].name == "vector_chain"]
OVERFLOW = 4


def words(core, theta):
    """Words of one chain and the angles that they stand for."""
    joint, = joints(core.inputs)
    found = codecs.encode(joint, theta)
    return found, codecs.decode(joint, found)


def run(core, chains):
    """Answers to a stream of chains of (words, lengths), one dictionary a chain."""
    sizes = np.cumsum([np.size(length) for _, length in chains])
    last = np.zeros(sizes[-1], dtype=np.int64)
    last[sizes - 1] = 1
    inputs = {name: np.concatenate([word[name] for word, _ in chains]) for name in chains[0][0]}
    answer = core.model(core.params, **inputs, in_l=np.concatenate([length for _, length in chains]), in_last=last)
    assert np.array_equal(answer["out_last"], last)
    return [{name: column[end - np.size(length):end] for name, column in answer.items()}
            for end, (_, length) in zip(sizes, chains)]


def random_chains(core, rng, reach, count=120):
    """Chains of 1 to N links, together as long as `reach` LSB, joints anywhere, at quadrant borders or all alike."""
    found = []
    for i in range(count):
        links = int(rng.integers(1, core.params["N"], endpoint=True)) if i % 3 else core.params["N"]
        theta = rng.uniform(-np.pi, np.pi, links)
        if i % 4 == 1:
            theta = rng.integers(-2, 3, links) * np.pi / 2 + rng.normal(0, 1e-4, links)
        if i % 4 == 2:
            theta = np.full(links, rng.uniform(-0.3, 0.3))
        share = rng.exponential(1, links)
        found.append((theta, np.floor(reach * share / share.sum()).astype(np.int64)))
    return found


def bound(core, lengths):
    return (bounds.table_chain if core.family == "table" else bounds.vector_chain_directions)(core.params, lengths)


@pytest.mark.parametrize("core", CORES)
def test_every_position_is_that_of_the_directions(core):
    rng, half, worst = np.random.default_rng(1), 1 << core.params["W"] - 1, 0.0
    for reach in (half - 2 - half // 500, half // 2, 100):
        chains = [(*words(core, theta), lengths) for theta, lengths in random_chains(core, rng, reach)]
        for (_, theta, lengths), answer in zip(chains, run(core, [(word, lengths) for word, _, lengths in chains])):
            exact = np.stack(chain.positions(theta, lengths))
            error = np.abs(np.stack([answer["out_x"], answer["out_y"]]) - exact)
            assert np.all(error <= bound(core, lengths))
            assert not answer["out_status"].any()
            worst = max(worst, error.max())
    assert worst > 0.5


@pytest.mark.parametrize("core", VECTORS)
def test_vectors_are_taken_as_they_are(core):
    """Against the product of the vectors themselves, of length 1 and of less."""
    rng, half = np.random.default_rng(2), 1 << core.params["W"] - 1
    joint, one, worst = joints(core.inputs)[0], 2.0 ** core.params["U"], 0.0
    for short in (1.0, 0.9):
        stream, exact = [], []
        for theta, lengths in random_chains(core, rng, half - 2 - half // 500):
            word = codecs.encode(joint, theta)
            word = {name: np.rint(values * short).astype(np.int64) for name, values in word.items()}
            direction = np.cumprod((word[joint[0].name] + 1j * word[joint[1].name]) / one)
            stream.append((word, lengths))
            exact.append(np.cumsum(lengths * direction))
        for (_, lengths), place, answer in zip(stream, exact, run(core, stream)):
            error = np.maximum(np.abs(answer["out_x"] - place.real), np.abs(answer["out_y"] - place.imag))
            assert np.all(error <= bounds.vector_chain(core.params, lengths))
            worst = max(worst, error.max())
    assert worst > 0.5


@pytest.mark.parametrize("core", VECTORS)
def test_the_direction_errs_as_its_law_says(core):
    """Against exact products of the integers, by the unit of a guard bit: some turn comes within half of the law."""
    p, rng = core.params, np.random.default_rng(3)
    joint, one, g = joints(core.inputs)[0], 2.0 ** core.params["U"], chain.sizes(core.params)[1]
    share = 0.0
    for _ in range(300):
        word = codecs.encode(joint, rng.uniform(-np.pi, np.pi, p["N"]))
        c, n = word[joint[0].name], word[joint[1].name]
        found = chain.vector_directions(p, c, n, np.zeros(p["N"], dtype=np.int64))
        exact = np.cumprod((c + 1j * n) / one)
        error = np.abs(found[0] + 1j * found[1] - exact * one * 2**g)
        law = np.sqrt(5) * np.arange(1, p["N"] + 1) * (1 + bounds.vector_word(p)) ** p["N"] + 1e-3
        assert np.all(error <= law)
        share = max(share, (error / law).max())
    assert share > 0.4


@pytest.mark.parametrize("core", CORES)
def test_overflow_is_exact_to_the_bound(core):
    """Beyond a word: the nearest word and the flag; a chain that comes back is right again, for the sum is kept."""
    half = 1 << core.params["W"] - 1
    links = core.params["N"]
    for turn in range(4):
        theta = np.zeros(links)
        theta[0], theta[links // 2] = turn * np.pi / 2, np.pi
        word, exact_theta = words(core, theta)
        lengths = np.full(links, 5 * half // 8)
        answer, = run(core, [(word, lengths)])
        exact = np.stack(chain.positions(exact_theta, lengths))
        found, off = np.stack([answer["out_x"], answer["out_y"]]), bound(core, lengths)
        assert np.all(np.abs(found - np.clip(exact, -half, half - 1)) <= off)
        out = np.maximum(exact.max(axis=0) - (half - 0.5), -half - 0.5 - exact.min(axis=0))
        flag = answer["out_status"] == OVERFLOW
        assert np.all(flag[out > off - 0.5]) and not np.any(flag[out < 0.5 - off])
        assert flag.any() and not flag.all()


@pytest.mark.parametrize("core", CORES)
def test_links_beyond_the_parameter_do_not_count(core):
    """They are flagged and answered by the position of link N; the next chain is not harmed, nor is one of one link."""
    rng, most = np.random.default_rng(4), core.params["N"]
    word, _ = words(core, rng.uniform(-1, 1, most + 5))
    short, _ = words(core, np.array([0.7]))
    lengths = rng.integers(1, (1 << core.params["W"] - 1) // (most + 6), most + 5)
    cut = {name: values[:most] for name, values in word.items()}
    long, one, again, same = run(core, [(word, lengths), (short, lengths[:1]), (cut, lengths[:most]),
                                        (short, lengths[:1])])
    for axis in ("out_x", "out_y"):
        assert np.array_equal(long[axis][:most], again[axis])
        assert np.all(long[axis][most:] == again[axis][-1])
        assert np.array_equal(one[axis], same[axis])
    assert np.array_equal(long["out_status"], np.where(np.arange(most + 5) < most, 0, OVERFLOW))
    assert not again["out_status"].any() and not one["out_status"].any()


@pytest.mark.parametrize("core", CORES)
def test_quarter_turns_are_exact(core):
    """Around a rectangle and back: whole coordinates, whose sums are exact where every direction is an axis."""
    word, _ = words(core, np.pi / 2 * np.array([0, 1, 1, 1, 1][:core.params["N"]]))
    lengths = np.array([100, 50, 100, 50, 7])
    answer, = run(core, [(word, lengths)])
    assert answer["out_x"].tolist() == [100, 100, 0, 0, 7] and answer["out_y"].tolist() == [0, 50, 50, 0, 0]


# In space


def yawed(core, rng, reach, count=60):
    """Chains whose first word is a yaw, in the form of `run`, and (yaw, angles, lengths of the links)."""
    found, truths = [], []
    for theta, lengths in random_chains(core, rng, reach, count):
        yaw = rng.choice([rng.uniform(-np.pi, np.pi), np.pi / 2 * rng.integers(4)])
        word, exact = words(core, np.append(yaw, theta))
        found.append((word, np.append(rng.integers(1 << core.params["W"]), lengths)))
        truths.append((exact[0], exact[1:], lengths))
    return found, truths


def space_bound(core, lengths):
    return (bounds.table_chain_space if core.family == "table" else bounds.vector_chain_space)(core.params, lengths)


@pytest.mark.parametrize("core", SPACE)
def test_every_position_in_space(core):
    rng, half, worst = np.random.default_rng(1), 1 << core.params["W"] - 1, 0.0
    for reach in (half - 2 - half // 500, half // 2, 100):
        chains, truths = yawed(core, rng, reach)
        for answer, (yaw, theta, lengths) in zip(run(core, chains), truths):
            assert [answer[f"out_{axis}"][0] for axis in "xyz"] == [0, 0, 0]
            across, upright = space_bound(core, lengths)
            for axis, place, law in zip("xyz", chain.space_positions(yaw, theta, lengths), (across, across, upright)):
                error = np.abs(answer[f"out_{axis}"][1:] - place)
                assert np.all(error <= law)
                worst = max(worst, error.max())
            assert not answer["out_status"].any()
    assert worst > 0.5


@pytest.mark.parametrize("core", SPACE)
def test_space_beyond_the_word_and_the_parameter(core):
    """Coordinates saturate, each by itself; links behind the N-th do not count, the yaw is none."""
    half, most = 1 << core.params["W"] - 1, core.params["N"]
    for yaw in (0.0, np.pi / 2, np.pi, 0.6):
        for lean in (0.0, np.pi / 2, np.pi, -np.pi / 2):
            word, exact = words(core, np.array([yaw, lean, 0, np.pi, 0, 0]))
            lengths = np.full(6, 5 * half // 8)
            answer, = run(core, [(word, lengths)])
            rho, z = chain.positions(exact[1:], lengths[1:])
            place = np.clip([rho * np.cos(exact[0]), rho * np.sin(exact[0]), z], -half, half - 1)
            found = np.stack([answer[f"out_{one}"][1:] for one in "xyz"])
            assert np.all(np.abs(found - place) <= space_bound(core, lengths[1:])[0] + 1)
            assert answer["out_status"].tolist() == [0, 0, OVERFLOW, 0, 0, 0]
    rng = np.random.default_rng(7)
    word, _ = words(core, rng.uniform(-1, 1, most + 4))
    lengths = np.full(most + 4, half // (most + 6))
    cut = {name: one[:most + 1] for name, one in word.items()}
    long, again = run(core, [(word, lengths), (cut, lengths[:most + 1])])
    assert long["out_status"].tolist() == [0] * (most + 1) + [OVERFLOW] * 3 and not again["out_status"].any()
    for axis in ("out_x", "out_y", "out_z"):
        assert np.array_equal(long[axis], np.append(again[axis], again[axis][-1:].repeat(3)))


@pytest.mark.parametrize("core", SPACE)
def test_joints_on_the_forearm(core):
    """Joints four and five of Fig. 11: after the upper arm links in one line, as long as the joints are apart."""
    rng = np.random.default_rng(8)
    upper, pieces = 900, np.array([400, 250, 150])
    for theta in rng.uniform(-np.pi, np.pi, (200, 3)):
        word, exact = words(core, np.array([theta[2], theta[0], theta[1], 0, 0]))
        answer, = run(core, [(word, np.array([0, upper, *pieces]))])
        for k, away in enumerate(np.cumsum(pieces)):
            tip = truth.fk3(exact[1], exact[2], exact[0], upper, away)
            for axis, place in zip("xyz", tip):
                law = space_bound(core, [upper, *pieces])[0][k + 1]
                assert abs(answer[f"out_{axis}"][k + 2] - place) <= law


# Fixed frames


def directed(core, theta, phi):
    """Words of one chain in the fixed frame and the angles that they stand for."""
    pairs = [(codecs.encode(joint, angle), joint) for joint, angle in zip(joints(core.inputs), (theta, phi))]
    return pairs[0][0] | pairs[1][0], *(codecs.decode(joint, word) for word, joint in pairs)


@pytest.mark.parametrize("core", FIXED)
def test_every_position_in_the_fixed_frame(core):
    rng, half, worst = np.random.default_rng(1), 1 << core.params["W"] - 1, 0.0
    for reach in (half - 2 - half // 500, half // 2, 100):
        chains = []
        for theta, lengths in random_chains(core, rng, reach, 40):
            phi = rng.permutation(theta) if rng.random() < 0.5 else rng.uniform(0, np.pi, theta.size)
            chains.append((*directed(core, theta, phi), lengths))
        answers = run(core, [(word, lengths) for word, *_, lengths in chains])
        for (_, theta, phi, lengths), answer in zip(chains, answers):
            exact = chain.fixed_positions(theta, phi, lengths)
            across, upright = bounds.mff(core.params, lengths)
            for axis, place, law in zip("xyz", exact, (across, across, upright)):
                error = np.abs(answer[f"out_{axis}"] - place)
                assert np.all(error <= law)
                worst = max(worst, error.max())
            assert not answer["out_status"].any()
    assert worst > 0.5


ROWS = {"I": (1, 1, 1), "II": (-1, 1, 1), "III": (-1, -1, 1), "IV": (1, -1, 1),
        "V": (1, 1, -1), "VI": (-1, 1, -1), "VII": (-1, -1, -1), "VIII": (1, -1, -1)}


@pytest.mark.parametrize("core", FIXED)
@pytest.mark.parametrize("row, signs", ROWS.items(), ids=ROWS)
def test_quadrants_are_the_octant_rows(core, row, signs):
    """The rows of the paper's matrix R, with the one it misses: signs from the quadrants, sizes from the spreads."""
    s, length, rng = core.params["S"], 20000, np.random.default_rng(5)
    theta, phi = {(1, 1): 0, (1, -1): 1, (-1, -1): 2, (-1, 1): 3}[signs[:2]], int(signs[2] < 0)
    f = rng.integers(1 << s - 4, 15 << s - 4, (2, 200))
    spread = [np.where(odd, (1 << s) - one, one) / 2.0**s for odd, one in ((theta % 2, f[0]), (phi % 2, f[1]))]
    ones = np.ones(200, dtype=np.int64)
    answer = core.model(core.params, in_j1=(theta << s) + f[0], in_j2=(phi << s) + f[1], in_l=length * ones,
                        in_last=ones)
    quadrance = float(length) ** 2
    exact = (np.sqrt(spread[0] * spread[1] * quadrance), np.sqrt((1 - spread[0]) * spread[1] * quadrance),
             np.sqrt((1 - spread[1]) * quadrance))
    for axis, sign, place in zip("xyz", signs, exact):
        assert np.abs(answer[f"out_{axis}"] - sign * place).max() <= bounds.mff(core.params, [length])[0]


@pytest.mark.parametrize("core", FIXED)
def test_fixed_frames_beyond_the_word_and_the_parameter(core):
    """Saturated and flagged along each axis, right again on the way back; links behind the N-th do not count."""
    half, most = 1 << core.params["W"] - 1, core.params["N"]
    quarter = np.pi / 2
    for angles, axis, sign in (((quarter, quarter), "x", 1), ((0, quarter), "y", 1), ((0, 0), "z", 1),
                               ((-quarter, quarter), "x", -1), ((np.pi, quarter), "y", -1), ((0, np.pi), "z", -1)):
        back = {"x": (-angles[0], angles[1]), "y": (np.pi - angles[0], angles[1]), "z": (0, np.pi - angles[1])}[axis]
        word, theta, phi = directed(core, *np.array([angles, angles, back, back, back]).T)
        lengths = np.full(5, 5 * half // 8)
        answer, = run(core, [(word, lengths)])
        exact = dict(zip("xyz", chain.fixed_positions(theta, phi, lengths)))[axis]
        law = bounds.mff(core.params, lengths)[0]
        assert np.all(np.abs(answer[f"out_{axis}"] - np.clip(exact, -half, half - 1)) <= law)
        assert answer["out_status"].tolist() == [0, OVERFLOW, 0, 0, 0]
        assert np.sign(answer[f"out_{axis}"][0]) == sign
    rng = np.random.default_rng(6)
    word, *_ = directed(core, rng.uniform(-1, 1, most + 3), rng.uniform(0, 3, most + 3))
    lengths = np.full(most + 3, half // (most + 6))
    long, again = run(core, [(word, lengths), ({name: one[:most] for name, one in word.items()}, lengths[:most])])
    assert long["out_status"].tolist() == [0] * most + [OVERFLOW] * 3 and not again["out_status"].any()
    for axis in ("out_x", "out_y", "out_z"):
        assert np.array_equal(long[axis], np.append(again[axis], again[axis][-1:].repeat(3)))


# Joints on the forearm


@pytest.mark.parametrize("core", [pytest.param(core, id=core.id) for core in distinct() if core.function == "fk5"])
def test_joints_four_and_five(core):
    """Each within paper_fk3's bound with its distance for L2; a joint out of range is flagged, the other is right."""
    p, rng = core.params, np.random.default_rng(9)
    theta = rng.uniform(-np.pi, np.pi, (3, 4000))
    inputs = {}
    for joint, angle in zip(joints(core.inputs), theta):
        inputs |= codecs.encode(joint, angle)
    exact = [codecs.decode(joint, inputs) for joint in joints(core.inputs)]
    full = 1 << p["W"] - 1
    for upper, near, far in ((full // 3, full // 6, full // 4), (full // 4, full // 3, 0), (full // 8, 5, full // 2)):
        answer = core.model(p, **inputs, cfg_l1=upper, cfg_d4=near, cfg_d5=far)
        for name, away in (("4", near), ("5", far)):
            error = np.stack([answer[f"out_{axis}{name}"] for axis in "xyz"]) - truth.fk3(*exact, upper, away)
            assert np.linalg.norm(error, axis=0).max() <= paper.forward(p, 3, upper, away)
        assert not answer["out_status"].any()
    for near, far in ((full, 40), (40, full)):
        answer = core.model(p, **inputs, cfg_l1=40, cfg_d4=near, cfg_d5=far)
        right = "5" if near > far else "4"
        error = np.stack([answer[f"out_{axis}{right}"] for axis in "xyz"]) - truth.fk3(*exact, 40, 40)
        assert np.linalg.norm(error, axis=0).max() <= paper.forward(p, 3, 40, 40)
        assert np.all(answer["out_status"] == OVERFLOW)
