"""Solved Alt-Burmester problems, from which others are followed.

`start_systems.npz` holds for each case two generic complex problems (one where a pivot is given)
with one linkage of each class, found by monodromy (`scripts/point_starts`).  When its positions are
carried over to those of a task, every isolated solution is reached with probability one.

The way is shorter from a problem like the task.  Positions of a kind may be exchanged, and lengths
multiplied by a complex number, their conjugates by another one: the linkages stay solutions.  Among
all of these problems the one nearest to the task is taken, which halves the steps of nine points.
"""

from __future__ import annotations

from functools import cache
from itertools import permutations, product
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import ComplexArray
from burmester.points.alt_burmester import Positions, point_turns
from burmester.points.path_tracking import polished


class Case(NamedTuple):
    """How many poses (the base is one of them), points and fixed pivots a problem gives.

    Points alone: the base is one of them, with the angle 0 there, so poses is 1.
    """

    poses: int
    points: int
    pivots: int = 0

    @property
    def positions(self) -> int:
        """How many there are beside the base."""
        return self.poses - 1 + self.points

    @property
    def name(self) -> str:
        """As in the file: "3-4", or "3-2-1" with a pivot."""
        return "-".join(map(str, self if self.pivots else self[:2]))

    @property
    def has_cognates(self) -> bool:
        """Whether linkages come in classes of three: only points are asked for."""
        return self.poses == 1 and not self.pivots

    @property
    def systems(self) -> int:
        """How many solved problems are kept."""
        return 1 if self.pivots else 2


# The cases, and how many linkages each has; those of (1, 8) are classes of three cognates.
CASES: Final = {
    Case(5, 0): 6,
    Case(4, 2): 30,
    Case(3, 4): 201,
    Case(2, 6): 1112,
    Case(1, 8): 1442,
    Case(1, 4, 2): 36,
    Case(2, 2, 2): 6,
    Case(3, 2, 1): 12,
    Case(2, 4, 1): 94,
    Case(1, 6, 1): 486,
}


class StartSystem(NamedTuple):
    """A solved problem: positions, and all linkages x (n, 8) with their turns (n, J) there."""

    positions: Positions
    x: ComplexArray
    turns: ComplexArray

    def nearest_to(self, task: Positions) -> StartSystem:
        """The one nearest to a task among those that follow from this one by symmetry."""
        here = self.positions
        orders = _orders(here.further_poses, here.points)
        turned = here.T[0][orders[:, : here.further_poses]] - task.T
        near = -(turned.real**2 + turned.imag**2).sum(axis=1)
        factors = []
        for own, pivots, asked, wanted in (
            (here.P, here.G, task.P, task.G),
            (here.Pb, here.Gb, task.Pb, task.Gb),
        ):
            inner = own[0][orders].conj() @ asked[0] + (pivots.conj() * wanted).sum()
            size = np.sqrt((_square(asked) + _square(wanted)) / (_square(own) + _square(pivots)))
            near = near + 2 * size * np.abs(inner)
            factors.append(size * np.exp(1j * np.angle(inner)))
        best = int(near.argmax())
        order, (one, two) = orders[best], (complex(each[best]) for each in factors)
        m = here.further_poses
        moved = Positions(
            one * here.P[:, order],
            two * here.Pb[:, order],
            here.T[:, order[:m]],
            one * here.G,
            two * here.Gb,
        )
        return StartSystem(moved, self.x * np.tile([one, two], 4), self.turns[:, order])


def _square(numbers: ComplexArray) -> float:
    return float((numbers.real**2 + numbers.imag**2).sum())


@cache
def _orders(poses: int, points: int) -> NDArray[np.intp]:
    """All orders (k, J) of positions in which poses stay before points."""
    ways = product(permutations(range(poses)), permutations(range(poses, poses + points)))
    return np.array([one + two for one, two in ways], dtype=np.intp)


@cache
def start_system(case: Case, number: int = 0) -> StartSystem:
    """The first or second solved problem of a case; its linkages are stored short and polished."""
    from importlib import resources  # noqa: PLC0415  few tasks need it

    with (
        resources.files("burmester.points").joinpath("start_systems.npz").open("rb") as file,
        np.load(file, allow_pickle=False) as table,
    ):
        here = f"{case.name}/{number}"
        positions = Positions(*(table[f"{here}/{part}"][None] for part in Positions._fields))
        x = table[f"{here}/x"].astype(np.complex128)
    x, turns, _ = polished(x, point_turns(x, positions), positions)
    return StartSystem(positions, x, turns)
