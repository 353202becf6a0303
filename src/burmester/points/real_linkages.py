"""The real linkages among all that meet an Alt-Burmester problem, with cognates, as four-bars."""

from __future__ import annotations

from typing import Final, NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.linkage_batch import DIMENSIONS, LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ComplexArray, FloatArray, complex_of, concatenate, take
from burmester.points.alt_burmester import UNKNOWNS, Positions, cognates, distinct, point_turns
from burmester.points.path_tracking import ACCURACY, polished, tracked
from burmester.points.start_systems import CASES, Case, start_system
from burmester.progress import goes_on, step

REAL: Final = 1e-6  # relative; a linkage that is its own conjugate up to this is real
MET: Final = 1e-7  # relative; a real linkage is kept if its Newton steps end below this
SIZE: Final = 1.2  # root mean square distance of positions from the base: that of solved problems
LEAST_LINK: Final = 1e-9  # of that size; a shorter link is none


STEPS: Final = 30  # of Newton's, at most
SOLVED: Final = 1e-10  # of an equation, in lengths of about 1; less is rounding
FLAT: Final = 1e-6  # relative; a singular value below this vanishes
ALONG: Final = 0.05  # length of the step, in the linkage's numbers
MOST: Final = 1e3  # a linkage with greater numbers is on its way to infinity

SETTLED: Final = 1e-7  # relative; Newton's last step on a linkage
FINER: Final = 1e-2  # share of the accuracy with which lost paths are followed again
HUNDRED: Final = 100  # parts of the way that progress is told in
FAR: Final = 100.0  # sizes of the problem; a path that stops farther leads to infinity
MOST_TRIED: Final = 20  # ends of paths that are looked at for families


@final
class PointLinkages(NamedTuple):
    """The four-bars (k,) that meet poses and points.

    batch: of pins, in the frames of the task; places: (k, N, 3), x, y and angle at all positions.
    classes, followed, found, lost: of the solve, complex linkages too; systems: of the solve.
    real: how many classes have a real linkage.
    family: whether infinitely many linkages, complex ones too, are left beside them.
    """

    batch: LinkageBatch
    places: FloatArray
    classes: int
    followed: int
    found: int
    real: int
    systems: int
    family: bool

    @property
    def lost(self) -> int:
        """How many were followed and not found: lost, or not there, in special positions."""
        return max(0, self.followed - self.found)


def linkages_through(
    poses: Displacement, is_point: NDArray[np.bool_], pivots: FloatArray | None = None
) -> PointLinkages:
    """All four-bars through positions (N,) of the body's origin, with the angle or without.

    is_point: (N,), where the angle is free; all of nine, or 2 (M - 1) + points = 8 for M poses.
    pivots: (k, 2), fixed pivots that are given; each is two conditions.  Points alone have no angle
    to begin with: at the first one it is 0.
    """
    base = int(np.argmin(is_point))  # the first pose, or the first point
    others = np.flatnonzero(np.arange(len(is_point)) != base)
    order = np.concatenate([others[~is_point[others]], others[is_point[others]]])
    d = complex_of(poses.translation)
    turn = 1.0 if is_point[base] else np.exp(1j * poses.angle[base])
    away = (d[order] - d[base]) / turn
    unit = float(np.sqrt((np.abs(away) ** 2).mean())) / SIZE or 1.0
    fixed = complex_of(np.reshape(() if pivots is None else pivots, (-1, 2)))
    P, G = away[None] / unit, (fixed - d[base])[None] / turn / unit
    posed = order[~is_point[order]]
    T = np.exp(1j * poses.angle[posed])[None] / turn
    positions = Positions(P, P.conj(), T, G, G.conj())
    every = all_linkages(positions)
    x, turns, real = _real(every, positions)
    u, z = x[:, [0, 4]], x[:, [2, 6]]
    G, z = d[base] + turn * unit * (u + z), unit * z
    rows = np.zeros((len(x), 2, DIMENSIONS))
    rows[..., 0], rows[..., 1], rows[..., 2], rows[..., 3] = G.real, G.imag, z.real, z.imag
    rows[..., 4] = unit * np.abs(u)
    places = np.empty((len(x), len(is_point), 3))
    places[..., :2] = poses.translation
    places[:, base, 2] = np.angle(turn)
    places[:, order, 2] = np.angle(turns * turn)
    places[..., 2] = np.where(is_point, places[..., 2], poses.angle)
    batch = LinkageBatch(np.zeros((len(x), 2), dtype=np.int8), rows)
    return PointLinkages(
        batch,
        places,
        every.classes,
        every.followed,
        len(every.x),
        real,
        every.systems,
        every.family,
    )


def _real(every: AllLinkages, positions: Positions) -> tuple[ComplexArray, ComplexArray, int]:
    """Real linkages (k, 8) with their turns, cognates too, and how many classes they are of."""
    with np.errstate(all="ignore"):
        x = cognates(every.x) if positions.has_cognates else every.x[:, None]
    own, _ = np.indices(x.shape[:2]).reshape(2, -1)
    x = x.reshape(-1, x.shape[-1])
    size = 1 + np.abs(x).max(axis=1)
    gap = np.abs(x[:, 1::2] - x[:, ::2].conj()).max(axis=1)
    index = np.flatnonzero(gap < REAL * size)
    x, own = x[index], own[index]
    x[:, ::2] = (x[:, ::2] + x[:, 1::2].conj()) / 2
    x[:, 1::2] = x[:, ::2].conj()
    x, turns, miss = polished(x, point_turns(x, positions), positions)
    links = np.abs(x[:, [0, 4]]).min(axis=1)
    coupler = np.abs(x[:, 2] - x[:, 6])
    unit = np.abs(np.abs(turns) - 1).max(axis=1) if turns.shape[1] else np.zeros(len(x))
    sound = (miss < MET) & (unit < REAL) & (np.minimum(links, coupler) > LEAST_LINK)
    return x[sound], turns[sound], len(np.unique(own[sound]))


@final
class AllLinkages(NamedTuple):
    """The linkages that meet a problem, one of each class, real and complex.

    x: (n, 8); turns: (n, J), at the positions beside the base.
    classes: how many there are of a problem in general position; n were found.
    followed: how many of them were followed to the task; fewer where a time limit ended it.
    systems: from how many solved problems they were looked for.
    family: whether linkages are left that are not alone: infinitely many meet the problem.
    """

    x: ComplexArray
    turns: ComplexArray
    classes: int
    followed: int
    systems: int
    family: bool = False


def case_of(positions: Positions) -> Case:
    """The case of a problem (leading axis 1)."""
    return Case(positions.further_poses + 1, positions.points, positions.pivots)


def all_linkages(positions: Positions) -> AllLinkages:
    """The linkages of a problem of one of the CASES, its base at 0, its size about 1."""
    case = case_of(positions)
    classes = CASES[case]
    x, turns, followed, others, other_turns = _ends(case, positions, 0)
    stopped = zip(others[:MOST_TRIED], other_turns[:MOST_TRIED], strict=True)
    systems, family = 1, any(is_in_family(*each, positions) for each in stopped)
    while len(x) < followed == classes and systems < case.systems:
        again = _ends(case, positions, systems)
        x, turns = concatenate([(x, turns), (again.x, again.turns)])
        x, turns = take((x, turns), distinct(x, positions))
        systems += 1
    return AllLinkages(x, turns, classes, followed, systems, family)


class _Ends(NamedTuple):
    """The ends x (n, 8) with turns (n, J) of so many paths, each of them once.

    others: (k, 8), where paths stopped that did not arrive, with their turns (k, J).
    """

    x: ComplexArray
    turns: ComplexArray
    followed: int
    others: ComplexArray
    other_turns: ComplexArray


def _ends(case: Case, positions: Positions, number: int) -> _Ends:
    """The ends of all paths from one of the solved problems of a case."""
    again = ", from another solved problem" if number else ""
    step(f"following {CASES[case]:,} linkages to the task{again}", whole=False)

    def watch(share: float) -> bool:
        return goes_on(1 + int((HUNDRED - 1) * share), HUNDRED, "part")

    start = start_system(case, number).nearest_to(positions)
    paths = tracked(start.x, start.turns, start.positions, positions, watch=watch)
    begun = paths.steps > 0
    x, turns, miss = polished(paths.x, paths.turns, positions)
    good = paths.arrived & (miss < SETTLED)
    index = np.flatnonzero(good)[distinct(x[good], positions)]
    missing = np.setdiff1d(np.flatnonzero(begun), index)
    stopped = begun & ~paths.arrived & (np.abs(paths.x).max(axis=1, initial=0.0) < FAR)
    others = paths.x[stopped], paths.turns[stopped]
    if begun.all() and len(missing):
        finer = tracked(
            *take((start.x, start.turns), missing),
            start.positions,
            positions,
            accuracy=ACCURACY * FINER,
            watch=watch,
        )
        more, more_turns, miss = polished(finer.x, finer.turns, positions)
        some = finer.arrived & (miss < SETTLED)
        x, turns = concatenate([(x[good], turns[good]), take((more, more_turns), some)])
        index = distinct(x, positions)
    return _Ends(x[index], turns[index], int(begun.sum()), *others)


def is_in_family(x: ComplexArray, turns: ComplexArray, positions: Positions) -> bool:
    """Whether a linkage near x (8,), turns (J,) is one of infinitely many that meet a problem."""
    free = positions.further_poses
    own = _met(np.concatenate([x, turns[free:]]), positions, np.empty(0, dtype=complex), 0.0)
    if own is None:
        return False
    _, rows = _equations(own, positions)
    values, directions = np.linalg.svd(rows)[1:]
    if len(values) == len(own) and values[-1] > FLAT * values[0]:
        return False
    direction = directions[-1].conj()
    other = _met(own + ALONG * direction, positions, direction, own @ direction.conj() + ALONG)
    return other is not None and float(np.abs(other - own).max()) < 1.0


def _met(
    start: ComplexArray, positions: Positions, direction: ComplexArray, at: complex
) -> ComplexArray | None:
    """The solution that Newton's least steps lead to, or None; direction: kept `at`, or empty."""
    own = start
    for _ in range(STEPS):
        miss, rows = _equations(own, positions)
        if direction.size:
            miss = np.append(miss, own @ direction.conj() - at)
            rows = np.vstack([rows, direction.conj()])
        if not (np.isfinite(rows).all() and np.abs(own).max() < MOST):
            return None
        step = np.linalg.lstsq(rows, -miss, rcond=FLAT / 10)[0]
        own = own + step / max(1.0, float(np.abs(step).max()))
    return own if np.abs(_equations(own, positions)[0]).max() < SOLVED else None


def _equations(own: ComplexArray, positions: Positions) -> tuple[ComplexArray, ComplexArray]:
    """The equations of `alt_burmester` (2 J + given,), and their derivatives (*, 8 + points)."""
    P, Pb, poses = positions.P[0], positions.Pb[0], positions.further_poses
    T = np.concatenate([positions.T[0], own[UNKNOWNS:]])
    number = np.arange(len(P))
    misses, every = [], []
    for dyad in (0, 4):
        u, ub, z, zb = own[dyad : dyad + 4]
        v, w = P + (T - 1) * z, Pb + (1 / T - 1) * zb
        rows = np.zeros((len(P), UNKNOWNS + len(P)), dtype=np.complex128)
        rows[:, dyad], rows[:, dyad + 1] = -w, -v
        rows[:, dyad + 2], rows[:, dyad + 3] = (w - ub) * (T - 1), (v - u) * (1 / T - 1)
        rows[number, UNKNOWNS + number] = (w - ub) * z - (v - u) * zb / T**2
        misses.append(v * w - v * ub - w * u)
        every.append(np.delete(rows, UNKNOWNS + number[:poses], axis=1))
    for k in range(positions.pivots):  # u + z is the fixed pivot
        row = np.zeros((2, every[0].shape[1]), dtype=np.complex128)
        row[0, [4 * k, 4 * k + 2]] = row[1, [4 * k + 1, 4 * k + 3]] = 1.0
        u, ub, z, zb = own[4 * k : 4 * k + 4]
        misses.append(np.array([u + z - positions.G[0, k], ub + zb - positions.Gb[0, k]]))
        every.append(row)
    return np.concatenate(misses), np.concatenate(every)
