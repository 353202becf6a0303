"""Where a spring attaches so that a hand moves a linkage with little force: a search.

Both ends are points, one in a region of the ground and one in a region of the body.  All places of
the motion, a grid of both ends and a list of springs are looked at in one computation; the best are
improved from there.  That no better spring exists is not proved.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import Final, NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.errors import InputError
from burmester.loads.load_figures import LoadFigures, load_figures, missed
from burmester.loads.loaded_motion import LoadedLinkage, LoadedMotion
from burmester.loads.spring_clearance import SpringClearance
from burmester.loads.spring_laws import NOMINAL, SpringLaw
from burmester.numerics.arrays import FloatArray
from burmester.requirements.loads import CLOSES_FROM, HAND_FORCE, STAYS_AT
from burmester.tasks.load_table import SpringKind
from burmester.tasks.loads import BODY, GROUND, End, Spring
from burmester.tasks.motion_task import Task
from burmester.verdicts.judged_linkage import LinkageAtPoses

PLACES: Final = 61  # along the motion, at which a grid is looked at
GRID: Final = 12  # points along each side of a region
FORCES: Final = 50.0  # N between two forces to which a gas spring is filled
TRIED: Final = 4  # places of each spring of a list that the grid keeps, the best first
STARTS: Final = 16  # springs of each kind of a grid that are improved
HALVINGS: Final = 8  # of the steps of the improvement
# What the ends do in a step.  The cost is a greatest force, with kinks from which only steps of
# several coordinates at once lead down.
MOVES: Final = np.array([each for each in product((0, 1, -1), repeat=4) if any(each)])
APART: Final = 2.0  # grid steps; the ends of springs that are told differ by more
EVERY: Final = 5  # of those places springs of the grid are held clear at one


class Offer(NamedTuple):
    """A spring of a list: its name, and its numbers as in `Spring`; lengths in the task's unit.

    many: how many of them.  diameter: how wide it is, 0 where that is not known.
    """

    name: str
    kind: SpringKind
    numbers: dict[str, float]
    many: int = 1
    diameter: float = 0.0

    def between(self, ground: FloatArray, body: FloatArray) -> Spring:
        """The spring between two points (2,), in the task's unit."""
        one, two = (tuple(map(float, each)) for each in (ground, body))
        ends = End(GROUND, (one[0], one[1])), End(BODY, (two[0], two[1]))
        return Spring(self.kind, ends, self.numbers, self.many)


@final
@dataclass(frozen=True, slots=True, eq=False)
class Balanced:
    """A linkage with a spring: which one, where, and what it bears then.

    worst: the greatest force of the hand with the friction of the spring, N, or the torque of the
    driver where there is no hand;
    before: without the spring.  keeps: whether all that is asked of its loads is kept.
    cost: what is made least: `worst`, or how far a hand with a corridor is from its middle, at
    most.  reserve: how far it stays inside, N, below zero outside; None without a corridor.
    unmoved: the best with the pivots where they were, if they were moved for the spring.
    """

    found: LinkageAtPoses
    offer: Offer
    spring: Spring
    figures: LoadFigures
    worst: float
    before: float
    keeps: bool
    cost: float
    reserve: float | None = None
    unmoved: Balanced | None = None

    @property
    def order(self) -> tuple[bool, float]:
        """Those that keep all that is asked are first, then those with less cost."""
        return not self.keeps, self.cost


class _Course(NamedTuple):
    """A linkage at places (n,) without the spring: what a spring changes is added to it.

    effort, lever: (n,), the driver's effort and what a unit of it is at the hand; origin (n, 2),
    cos, sin (n,): of the body, in metres; motion: (n, 3), its rates.
    stays: the places of poses at which it has to stay; closes: (n,), where it has to close.
    corridor: of the hand.
    """

    loaded: LoadedMotion
    clearance: SpringClearance
    effort: FloatArray
    lever: FloatArray
    origin: FloatArray
    angle: FloatArray
    motion: FloatArray
    stays: NDArray[np.intp]
    closes: NDArray[np.bool_]
    corridor: tuple[float, float] | None

    def spans(self, ground: FloatArray, body: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Lengths (n, m) of springs between points (m, 2), metres, and their rates."""
        c, s = np.cos(self.angle)[:, None], np.sin(self.angle)[:, None]
        arm = np.stack([c * body[:, 0] - s * body[:, 1], s * body[:, 0] + c * body[:, 1]], -1)
        apart = self.origin[:, None] + arm - ground
        across = np.stack([-arm[..., 1], arm[..., 0]], axis=-1)
        speed = self.motion[:, None, :2] + self.motion[:, None, 2:] * across
        length = np.hypot(apart[..., 0], apart[..., 1])
        return length, (speed * apart).sum(axis=-1) / np.maximum(length, 1e-12)

    def cost(self, law: SpringLaw, friction: float, length: FloatArray, rate: FloatArray
             ) -> FloatArray:  # fmt: skip
        """How much springs (m,) leave to the hand: N, and more for what they do not keep."""
        effort = self.effort[:, None] + law.tension(length) * rate
        held = friction * np.abs(rate)
        if self.corridor is None:
            force = np.abs(effort) + held
            out = (force * self.lever[:, None]).max(axis=0)
        else:
            onwards = (self.loaded.sense * effort + held) * self.lever[:, None]
            out = np.abs(onwards - sum(self.corridor) / 2).max(axis=0)
        if len(self.stays):
            slips = np.maximum(np.abs(effort) - held, 0.0) * self.lever[:, None]
            out = out + 2 * slips[self.stays].max(axis=0)
        if self.closes.any():
            opens = np.maximum(held - self.loaded.sense * effort, 0.0) * self.lever[:, None]
            out = out + 2 * opens[self.closes].max(axis=0)
        return np.asarray(out)


class _Start(NamedTuple):
    """A spring of a grid: its cost, which offer, and its ends (4,) in metres."""

    cost: float
    offer: int
    ends: FloatArray


def balanced(
    found: LinkageAtPoses, offers: Sequence[Offer], ground: FloatArray, body: FloatArray, most: int
) -> list[Balanced]:
    """The springs with which a hand moves a linkage best, at most so many, the best first.

    ground, body: (2, 2), the corners of the boxes in which the ends may be, in F and in M.
    """
    linkage = LoadedLinkage.of(found)
    course, metre = _course_of(linkage), linkage.metre
    low, high = np.concatenate([ground, body], axis=1) * metre
    axes = [np.linspace(a, b, GRID) for a, b in zip(low, high, strict=True)]
    ends = np.stack([each.ravel() for each in np.meshgrid(*axes[:2], indexing="ij")], axis=-1)
    tips = np.stack([each.ravel() for each in np.meshgrid(*axes[2:], indexing="ij")], axis=-1)
    pairs = np.concatenate([np.repeat(ends, len(tips), axis=0), np.tile(tips, (len(ends), 1))], 1)
    clearance = course.clearance.at(EVERY)
    thin = min((each.diameter for each in offers), default=0.0)
    pairs = pairs[clearance.keeps(pairs / metre, thin)]
    length, rate = course.spans(pairs[:, :2], pairs[:, 2:])
    reach = np.stack([length.min(axis=0), length.max(axis=0)])
    starts = list[_Start]()
    for number, offer in enumerate(offers):
        spring = offer.between(np.zeros(2), np.zeros(2))
        least, greatest = _span(spring, metre)
        fits = np.flatnonzero((reach[0] >= least) & (reach[1] <= greatest))
        if not len(fits):
            continue
        law = SpringLaw.of(spring, metre, linkage.loads.celsius)
        cost = course.cost(law, spring.count * spring["friction_N"], length[:, fits], rate[:, fits])
        first = np.argsort(cost, kind="stable")[:TRIED]
        starts += [_Start(float(cost[k]), number, pairs[fits[k]]) for k in first]
    starts.sort(key=lambda start: start.cost)
    step = (high - low) / (GRID - 1)
    chosen = list[_Start]()
    for kind in dict.fromkeys(offer.kind for offer in offers):
        own = list[_Start]()
        for start in starts:
            if len(own) == STARTS:
                break
            offer = offers[start.offer]
            if offer.kind != kind or any(
                start.offer == each.offer and _alike(start, each, step) for each in own
            ):
                continue
            if clearance.keeps(start.ends[None] / metre, offer.diameter)[0]:
                own.append(start)
        chosen += own
    better = [_improved(start, offers, course, (low, high), step) for start in chosen]
    better.sort(key=lambda start: start.cost)
    out, told = list[Balanced](), list[_Start]()
    for start in better:
        if any(_alike(start, each, step) for each in told):
            continue
        one = _verified(found, offers[start.offer], start.ends / metre, course)
        if one is not None:
            out.append(one)
            told.append(start)
        if sum(each.keeps for each in out) == most:
            break
    return sorted(out, key=lambda each: each.order)[:most]


def _span(spring: Spring, metre: float) -> tuple[float, float]:
    """The lengths in metres to which a spring is put: a gas spring between its nominal forces."""
    least, greatest = (each * metre for each in spring.span)
    reserve = NOMINAL if spring.kind == "gas" else 0.0
    return least + reserve, greatest - reserve


def _alike(one: _Start, other: _Start, step: FloatArray) -> bool:
    """Whether both have their ends at about the same places; step: (4,), of the grid."""
    return bool((np.abs(one.ends - other.ends) < APART * step + 1e-12).all())


def _course_of(linkage: LoadedLinkage) -> _Course:
    asked = linkage.found.task.requirements.bounds
    shares = np.linspace(0.0, 1.0, PLACES)
    names = linkage.found.task.names or ("",) * len(linkage.pose_shares)
    stays = [
        share
        for k, share in enumerate(linkage.pose_shares)
        if {str(k + 1), names[k]} & asked.get(STAYS_AT, frozenset()) and np.isfinite(share)
    ]
    loaded = linkage.at(np.unique([*shares, *stays]))
    at = loaded.places[loaded.bodies.body]
    turned = np.abs(at.angle - at.angle[0])
    lever = np.ones(len(loaded.drive))
    if linkage.loads.hand is not None:
        lever = 1 / np.maximum(np.linalg.norm(loaded.hand_path, axis=-1), 1e-12)
    return _Course(
        loaded,
        SpringClearance.of(loaded, linkage.found.task),
        loaded.effort,
        lever,
        at.translation,
        at.angle,
        loaded.rates.of_body(loaded.bodies.body)[0],
        np.searchsorted(np.unique([*shares, *stays]), stays),
        turned < np.radians(asked.get(CLOSES_FROM, 0.0)),
        _corridor(linkage.found.task),
    )


def _corridor(task: Task) -> tuple[float, float] | None:
    """The least and the greatest push of a hand that a task asks for, if it asks for both."""
    bound = task.requirements.bounds.get(HAND_FORCE)
    return bound if isinstance(bound, tuple) else None


def _improved(
    start: _Start,
    offers: Sequence[Offer],
    course: _Course,
    bounds: tuple[FloatArray, FloatArray],
    step: FloatArray,
) -> _Start:
    """A spring whose ends no small step of any of their coordinates together makes better."""
    offer = offers[start.offer]
    metre = course.loaded.of.metre
    spring = offer.between(np.zeros(2), np.zeros(2))
    law = SpringLaw.of(spring, metre, course.loaded.loads.celsius)
    least, greatest = _span(spring, metre)
    clearance = course.clearance.at(EVERY)
    for _ in range(HALVINGS):
        step = step / 2
        for _ in range(GRID):
            moved = start.ends + MOVES * step
            moved = np.clip(moved, *bounds)
            length, rate = course.spans(moved[:, :2], moved[:, 2:])
            cost = course.cost(law, spring.count * spring["friction_N"], length, rate)
            fits = (length.min(axis=0) >= least) & (length.max(axis=0) <= greatest)
            fits[fits] = clearance.keeps(moved[fits] / metre, offer.diameter)
            cost = np.where(fits, cost, np.inf)
            k = int(cost.argmin())
            if not cost[k] < start.cost:
                break
            start = _Start(float(cost[k]), start.offer, moved[k])
    return start


def _verified(
    found: LinkageAtPoses, offer: Offer, ends: FloatArray, course: _Course
) -> Balanced | None:
    """The linkage with a spring between ends (4,) in the task's unit, loaded anew.

    None where the spring is in the way of something, or off its stroke.
    """
    spring = offer.between(*np.round(ends, 4).reshape(2, 2))
    if not course.clearance.keeps(ends[None], offer.diameter)[0]:
        return None
    loads = course.loaded.loads
    try:
        task = replace(found.task, loads=replace(loads, springs=(*loads.springs, spring)))
    except InputError as error:  # the linkage is off its first pose, at which no such spring fits
        if error.code != "E179":
            raise
        return None
    loaded = replace(found, task=task)
    figures = load_figures(loaded)
    if figures is None or figures.findings:
        return None
    worst = figures.effort.magnitude
    if figures.hand is not None:
        worst = float(figures.measures["hand_force"])
    before = float((np.abs(course.effort) * course.lever).max())
    cost, reserve = worst, None
    if (corridor := course.corridor) is not None:
        least, most = (float(figures.measures[f"hand_{each}"]) for each in ("least", "greatest"))
        reserve = min(least - corridor[0], corridor[1] - most)
        cost = (corridor[1] - corridor[0]) / 2 - reserve
    keeps = not missed(loaded, figures)
    return Balanced(loaded, offer, spring, figures, worst, before, keeps, cost, reserve)


def filled(offer: Offer, least: float, greatest: float, rise: float) -> Iterator[Offer]:
    """A gas spring of a size, filled to each force that it takes; rise: of the compressed one."""
    for force in np.arange(least, greatest + 1, FORCES):
        numbers = {
            **offer.numbers,
            "force_N": float(force),
            "compressed_force_N": float(round(force * rise)),
        }
        yield offer._replace(name=f"{offer.name}, {force:g} N", numbers=numbers)
