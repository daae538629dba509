"""The sets that tests of models go through, and what a kinematic core claims: bounds, the integers behind its flags.

No tests here. A new family is one more class in `CLAIMS`; `test_truth_of_cores.py` holds every core of rtl/cores.toml
to it at every parameter set. Targets and tips are (axes, N), lengths and errors in LSB of a coordinate.
"""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np
from quadrance import bounds, codecs
from quadrance.cores import Core, all_cores, joints
from quadrance.fixed import Ints
from quadrance.kernel_vector_wide import form
from quadrance.truth import Floats


def distinct() -> list[Core]:
    """Those of `all_cores` that may differ in a bit of an answer: of sets that PIPE or MULTIPLY tells apart the first.

    The model of the programs asks for PIPE.
    """
    def bits(core: Core) -> tuple:
        built = () if core.family == "program" else ("PIPE", "MULTIPLY")
        return core.model_name, core.name, *((key, word) for key, word in core.params.items() if key not in built)

    return list({bits(core): core for core in reversed(all_cores())}.values())[::-1]


class Claim(ABC):
    """A core at one pair of links."""

    symmetric = False  # saturates at +-(2^(W-1) - 1)
    words_in_law = False  # the bound of a tip holds for the words, not for the nearest angles that round to them

    def __init__(self, core: Core, l1: int, l2: int) -> None:
        self.core, self.p, self.l1, self.l2 = core, core.params, l1, l2
        self.joints = int(core.function[-1])

    # Integers

    def quadrances(self, target: Ints) -> Ints:
        """Squared coordinates as the core sees them."""
        return target * target

    def unreachable(self, target: Ints) -> tuple[Ints, Ints]:
        """Where the flag must be, and where it may be."""
        q = self.quadrances(target).sum(axis=0)
        out = (q > (self.l1 + self.l2) ** 2) | (q < (self.l1 - self.l2) ** 2)
        return out, out

    # Bounds

    @abstractmethod
    def coordinate(self) -> float:
        """Error of a forward core in one coordinate."""

    def overflow(self, tip: Floats) -> tuple[Ints, Ints]:
        """Where the flag must be, and where it may be: the rounded coordinate is off by what is not rounding."""
        high, band = (1 << self.p["W"] - 1) - 1, self.coordinate() - 0.5
        low = -high if self.symmetric else -high - 1
        beyond = np.max(np.maximum(tip - (high + 0.5), low - 0.5 - tip), axis=0)
        return beyond > band, beyond >= -band

    @abstractmethod
    def direction(self, r: Floats) -> Floats:
        """Angle of ik1 at distance r, rad."""

    @abstractmethod
    def reached(self, target: Ints) -> Floats:
        """Tip of ik2 and ik3 in reach."""

    @abstractmethod
    def nearest(self, target: Ints) -> Floats:
        """Tip from the nearest point, where flagged."""

    def folded(self) -> float:
        """Joint 2 of a target out of reach, LSB from straight or folded."""
        return 0.0


class Rational(Claim):
    """rtl/rational."""

    def unreachable(self, target: Ints) -> tuple[Ints, Ints]:
        """Never flagged in reach; always where the quadrance is out by more than `rational.gap`.

        W above 16: as rtl/vector.
        """
        if form(self.p).bits > 16:
            return Vector.unreachable(self, target)
        q, gap = self.quadrances(target).sum(axis=0), bounds.rational.gap(self.p, self.l1, self.l2)
        far, near = (self.l1 + self.l2) ** 2, (self.l1 - self.l2) ** 2
        return (q > far + gap) | (q < near - gap), (q > far) | (q < near)

    def coordinate(self) -> float:
        if self.joints == 1:
            return bounds.rational.fk1(self.p, self.l1)
        return bounds.rational.chain(self.p, self.joints, self.l1, self.l2)

    def direction(self, r: Floats) -> Floats:
        return bounds.rational.direction(self.p) + 0 * r

    def reached(self, target: Ints) -> Floats:
        if self.joints == 2:
            return bounds.rational.ik2(self.p, self.l1, self.l2, np.hypot(*target))
        return bounds.rational.ik3(self.p, self.l1, self.l2, target)

    def nearest(self, target: Ints) -> Floats:
        return bounds.rational.nearest(self.p, self.l1, self.l2, target)


class Classic(Claim):
    """rtl/classic."""

    words_in_law = True

    def coordinate(self) -> float:
        if self.joints == 1:
            return bounds.classic.fk1(self.p, self.l1)
        return bounds.classic.chain(self.p, self.joints, self.l1, self.l2)

    def direction(self, r: Floats) -> Floats:
        fixed, slope = bounds.cordic.angle(self.p, 3, False)
        return (fixed + slope / r) * (2 * np.pi / 2 ** self.p["A"])

    def reached(self, target: Ints) -> Floats:
        r = np.sqrt((target.astype(float) ** 2).sum(axis=0))
        return bounds.classic.ik(self.p, self.joints, self.l1, self.l2, r)

    nearest = reached

    def folded(self) -> float:
        return bounds.classic.elbow(self.p, self.joints, self.l1, self.l2)


class Paper(Claim):
    """rtl/paper."""

    symmetric = True

    def quadrances(self, target: Ints) -> Ints:
        return target * target >> max(2 * self.p["F"] - self.p["S"], 0)

    def unreachable(self, target: Ints) -> tuple[Ints, Ints]:
        """|q3 - Q1 - Q2| > 2 L1 L2, each of them cut to G bits: exactly there."""
        q, (q1, q2) = self.quadrances(target).sum(axis=0), self.quadrances(np.array([self.l1, self.l2]))
        out = np.abs(q - q1 - q2) > 2 * self.l1 * self.l2 >> max(2 * self.p["F"] - self.p["S"], 0)
        return out, out

    def coordinate(self) -> float:
        return 0.5 if self.joints == 1 else bounds.paper.forward(self.p, self.joints, self.l1, self.l2)

    def overflow(self, tip: Floats) -> tuple[Ints, Ints]:
        """One joint: where the coordinate rounds out of the word. More: where the tip is at 2^I units or beyond."""
        if self.joints == 1:
            return super().overflow(tip)
        full, band = 1 << self.p["W"] - 1, bounds.paper.reach(self.p)
        reach = np.sqrt((tip * tip).sum(axis=0))
        return reach > full + band, reach >= full - 0.5 - band

    def direction(self, r: Floats) -> Floats:
        return 1e-9 + 0 * r  # float64, at a border of a quadrant

    def reached(self, target: Ints) -> Floats:
        return bounds.paper.inverse(self.p, self.joints, self.l1, self.l2) + np.zeros(target.shape[1])

    def nearest(self, target: Ints) -> Floats:
        r = np.sqrt((target.astype(float) ** 2).sum(axis=0))
        radius = np.where(r > self.l1 + self.l2, self.l1 + self.l2, abs(self.l1 - self.l2))
        u = 2.0 ** (self.p["F"] - min(self.p["S"], 2 * self.p["F"]) / 2)
        far = np.hypot(*target[:2].astype(float))
        yaw = bounds.paper.turned(2.0 ** -bounds.paper.share(self.p)) + 2 * u / np.maximum(far, 1)
        yaw = yaw if self.joints == 3 else 0
        return np.minimum(radius * (bounds.paper.nearest(self.p, self.joints, r) + yaw), 2 * radius) + 1e-6


class Table(Claim):
    """rtl/table."""

    def coordinate(self) -> float:
        return bounds.table.forward(self.p, self.joints, self.l1, self.l2)

    def direction(self, r: Floats) -> Floats:
        return bounds.table.direction(self.p) + 0 * r

    @property
    def words_in_law(self) -> bool:
        """Of two and three joints, inverse."""
        return self.joints > 1

    def unreachable(self, target: Ints) -> tuple[Ints, Ints]:
        """As rtl/vector: the same kernel."""
        return Vector.unreachable(self, target)

    def reached(self, target: Ints) -> Floats:
        q, (near, far) = (target * target).sum(axis=0), ((self.l1 - self.l2) ** 2.0, (self.l1 + self.l2) ** 2)
        sine = np.sqrt(np.maximum((far - q) * (q - near), 0)) / max(2 * self.l1 * self.l2, 1)
        if self.joints == 2:
            return bounds.table.ik2(self.p, self.l1, self.l2, np.sqrt(q), sine)
        return bounds.table.ik3(self.p, self.l1, self.l2, target, sine)

    def nearest(self, target: Ints) -> Floats:
        return bounds.table.nearest(self.p, self.l1, self.l2, target)

    def folded(self) -> float:
        """The last bit of m at the ends of its arc sine, and half a word."""
        return 0.5 + 2.0 ** (self.p["A"] - 21) / (2 * np.pi)


class Vector(Claim):
    """rtl/vector. The tip is that of the words' directions: their lengths belong to the error."""

    words_in_law = True

    def coordinate(self) -> float:
        return bounds.vector.coordinate(self.p, self.joints, self.l1, self.l2)

    def direction(self, r: Floats) -> Floats:
        """The direction before both words are rounded is exact; of a rounded vector, sqrt(1/2) 2^-U and its length."""
        length = bounds.vector.length(form(self.p))
        return np.arcsin(np.sqrt(0.5) * 2.0 ** -self.p["U"] / (1 - 2 * length)) + 1e-9 + 0 * r

    def unreachable(self, target: Ints) -> tuple[Ints, Ints]:
        """Always where the quadrance is out by more than `vector_reach`; two joints: never in reach."""
        q, far, near = (target * target).sum(axis=0), (self.l1 + self.l2) ** 2, (self.l1 - self.l2) ** 2
        missed, mistaken = bounds.vector.reach(self.p, self.l1, self.l2, target)
        return (q > far + missed) | (q < near - missed), (q > far - mistaken) | (q < near + mistaken)

    def reached(self, target: Ints) -> Floats:
        """`vector_ik2`, `vector_ik3` are about the products of the words; their directions differ by the lengths of
        the vectors."""
        q, unit = (target * target).sum(axis=0), 2.0 ** -self.p["U"]
        near, far, rho = (self.l1 - self.l2) ** 2.0, (self.l1 + self.l2) ** 2, np.sqrt(q)
        sine = np.sqrt(np.maximum((far - q) * (q - near), 0)) / max(2 * self.l1 * self.l2, 1)
        if self.joints == 2:
            length = bounds.vector.ik2_length(self.p, self.l1, self.l2, rho, sine) * unit
            words = length * rho + self.l2 * 1.5 * unit
            return bounds.vector.ik2(self.p, self.l1, self.l2, rho, sine) + np.minimum(words, rho)
        length = bounds.vector.ik3_length(self.p, self.l1, self.l2, target, sine) * unit
        words = length * rho + self.l2 * 1.5 * unit
        return bounds.vector.ik3(self.p, self.l1, self.l2, target, sine) + np.minimum(words, 2 * rho)

    def nearest(self, target: Ints) -> Floats:
        """`VECTOR_NEAREST`, and the length of (c1, n1), two words; of (c3, n3) once more."""
        words = 2 * (self.l1 + self.l2) / 2 ** self.p["U"]
        if self.joints == 2:
            return bounds.vector.NEAREST * (self.l1 + self.l2) / 2 ** self.p["U"] + words + 0 * target[0]
        return bounds.vector.ik3_nearest(self.p, self.l1, self.l2, target) + 2 * words


CLAIMS: dict[str, type[Claim]] = {"rational": Rational, "classic": Classic, "paper": Paper,
                                 "table": Table, "vector": Vector}


def angles(claim: Claim, answer: dict[str, Ints], exact: list[Floats]) -> list[Floats]:
    """Joint angles that the bound is about: of the words, or the nearest to the exact ones that round to them."""
    found = joints(claim.core.outputs)
    if claim.words_in_law:
        return [codecs.decode(joint, answer) for joint in found]
    return [codecs.within_cell(joint, answer, np.nan_to_num(theta)) for joint, theta in zip(found, exact)]
