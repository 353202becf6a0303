"""Requirements on the whole linkage, beside the limits on each of its dyads."""

from __future__ import annotations

import math
from dataclasses import dataclass, make_dataclass, replace
from typing import Any, final

import numpy as np

from burmester.errors import InputError
from burmester.geometry.regions import Line, Polygon, Region
from burmester.requirements.loads import HAND_FORCE, NEEDS, OF_LOADS, STAYS_AT
from burmester.requirements.requirement import Requirement
from burmester.requirements.table import ASKED, NOT_ASKED, standard
from burmester.requirements.types import TYPES, Driver, allowed_types, types_in_words
from burmester.tasks.limits import Kind, Limits
from burmester.tasks.loads import Loads
from burmester.wording import with_article

TYPES_WITHOUT_CRANK = frozenset({"double-rocker", "triple-rocker", "double slider"})
TURNING_KINDS: frozenset[Kind] = frozenset({"RR", "RP"})  # a PR dyad slides on the ground
FOOTPRINT_MARGIN = 1e-9  # share of a footprint's diagonal; rounding may put a point as far outside


@final
@dataclass(frozen=True, slots=True)
class Requirements:
    """What a linkage must be to be usable, beyond meeting the poses in one piece and in order.

    Parameters
    ----------
    transmission_deg : float
        The least transmission angle over the range that the poses use, in degrees, from 0 to
        below 90.
    types : set of str or None
        The types allowed, by the names in `TYPES` (in any case, with hyphens or spaces), or the
        words in `GROUPS` for some 4R types together; None allows all.
    driver : {"any", "first", "second", "crank"}
        Which dyad drives: that of the task's first or second limits, one that turns fully, or
        any.
    footprint : Polygon or None
        An area, in F, that holds the fixed pivots, and the moving pivots wherever they come
        between the poses.
    link_ratio : float
        The longest of the four links is at most this many times the shortest; linkages with
        sliders have no four links, and pass.
    within : float or None
        The greatest acceptable position error at any pose, in the task's unit.
    within_deg : float or None
        The greatest acceptable angle error at any pose, in degrees; without it the angle that
        counts as much as `within` (see `length_per_radian`).
    any_order : bool
        Whether the poses may be met in another order than that of the task.

    Raises
    ------
    InputError
        E134 (malformed), E132 (requirements that contradict each other).

    Examples
    --------
    >>> wanted = Requirements(transmission_deg=40, types={"Crank Rocker"})
    >>> wanted.types
    frozenset({'crank-rocker'})
    >>> Requirements(link_ratio=0.5)
    Traceback (most recent call last):
        ...
    burmester.errors.InputError: error[E134]: a link ratio of at most 0.5 is impossible
      why: the longest of the four links is never shorter than the shortest
      help: give a ratio of 1 or more, such as 5
    """

    transmission_deg: float = 0.0
    types: frozenset[str] | None = None
    driver: Driver = "any"
    footprint: Polygon | None = None
    link_ratio: float = math.inf
    within: float | None = None
    within_deg: float | None = None
    any_order: bool = False

    def __post_init__(self) -> None:
        for each in ASKED:
            if (value := getattr(self, each.name)) is not None or each.default is not None:
                object.__setattr__(self, each.name, each.checked(value))
        allowed = self.allowed_types
        if self.driver == "crank" and allowed is not None and allowed <= TYPES_WITHOUT_CRANK:
            turning = [name for name in TYPES if name not in TYPES_WITHOUT_CRANK]
            raise InputError(
                "E132",
                "the requirements contradict each other: a driver that turns fully, and "
                f"linkages of type {types_in_words(self.types or ())} only",
                why=f"no driver of a {types_in_words(allowed)} turns fully",
                help=f"allow another type as well, such as {turning[0]}, or any driver",
            )

    @property
    def bounds(self) -> dict[Requirement, Any]:
        """What is asked, each with its bound."""
        values = ((each, getattr(self, each.name)) for each in ASKED)
        return {each: value for each, value in values if value != each.default}

    @property
    def transmission(self) -> float:
        """The least transmission angle in radians."""
        return math.radians(self.transmission_deg)

    def reach(self, usual: float, length: float) -> tuple[float, float]:
        """The greatest acceptable position error, and the length that a radian counts as by it.

        usual, length: both, in the same unit, where nothing is asked for.
        """
        reach = self.within or usual
        if self.within_deg is not None:
            length = reach / math.radians(self.within_deg)
        return reach, length

    def with_standard(self) -> Requirements:
        """What is asked, and the bounds of the standard that could be asked."""
        bounds = standard(self.bounds, 0.0, NOT_ASKED)
        return replace(self, **{each.name: bound for each, bound in bounds.items()})

    @property
    def has_any(self) -> bool:
        """Whether there is any requirement at all."""
        return bool(self.bounds)

    @property
    def allowed_types(self) -> frozenset[str] | None:
        """The types allowed, words for groups replaced by their types; None for all."""
        return None if self.types is None else allowed_types(self.types)

    def allows(self, name: str) -> bool:
        """Whether linkages of a type, named as `Linkage.type` does, are allowed."""
        allowed = self.allowed_types
        return allowed is None or name in allowed


# What can be asked beside that follows, by its own module.
if _BESIDE := [each for each in ASKED if each.name not in Requirements.__match_args__]:
    Requirements = make_dataclass(  # type: ignore[misc, assignment]
        "Requirements",
        [(each.name, Any, each.default) for each in _BESIDE],
        bases=(Requirements,),
        namespace={"__module__": __name__, "__doc__": Requirements.__doc__},
        frozen=True,
        slots=True,
    )


def require_possible(requirements: Requirements, limits: tuple[Limits, ...]) -> None:
    """Refuse requirements that no dyads within limits (none, one for both, or two) meet.

    What it lets pass may be impossible nevertheless.  Raises InputError E132, which quotes both,
    and E134 where the driver is that of the first or second limits, and there are no two.
    """
    if requirements.driver in ("first", "second") and len(limits) != 2:
        given = "no limits" if not limits else "one set of limits for both dyads"
        raise InputError(
            "E134",
            f"driver {requirements.driver!r} needs two sets of limits",
            why=f"there is {given}" if limits else f"there are {given}",
            help="give limits for each dyad (an option such as --kinds twice, or two [[limits]] "
            "tables in a file), or let any dyad drive",
        )
    both = (limits * 2)[:2] if limits else (Limits(), Limits())
    _require_a_type(requirements, *both)
    for each in limits:
        if each.fixed_pivot is None or requirements.footprint is None:
            continue
        if _is_outside(requirements.footprint, each.fixed_pivot):
            raise InputError(
                "E132",
                "the limits and the requirements contradict each other: fixed pivot "
                f"{each.fixed_pivot}, and all pivots {requirements.footprint}",
                why="the two have no point in common",
                help="move one of them, enlarge the footprint, or leave it out",
            )


def require_loads(
    requirements: Requirements, loads: Loads | None, names: tuple[str, ...] | None, count: int
) -> None:
    """Refuse bounds on what a task does not load, or poses that it does not have: E134."""
    asked = [each for each in requirements.bounds if each in OF_LOADS]
    for each in asked:
        needs = NEEDS.get(each, lambda _: True)
        if loads is None or not needs(loads):
            what = "hand in its loads" if each is HAND_FORCE else "drive"
            raise InputError(
                "E134",
                f"{each.name} is asked for, and the task has no "
                f"{'loads' if loads is None else what}",
                help=f"state the loads beside the poses, or leave {each.name} out",
            )
    known = {*(names or ()), *(str(k + 1) for k in range(count))}
    for name in sorted(requirements.bounds.get(STAYS_AT, ())):
        if name not in known:
            help = f"name a pose of the task, or give its number from 1 to {count}"
            raise InputError("E134", f"stays_at names no pose: {name!r}", help=help)


def _require_a_type(requirements: Requirements, first: Limits, second: Limits) -> None:
    """Refuse types, or a crank, that two dyads within these limits never make."""
    kinds = first.allowed, second.allowed
    allowed = requirements.allowed_types
    possible = [name for name, pair in TYPES.items() if _makes_pair(pair, kinds)]
    if requirements.driver == "crank":
        if not (kinds[0] | kinds[1]) & TURNING_KINDS:
            raise InputError(
                "E132",
                "the limits and the requirements contradict each other: "
                f"{_kinds_in_words(kinds)}, and a driver that turns fully",
                why="a dyad of this kind slides on the ground and does not turn",
                help="allow RR as well, or let any dyad drive",
            )
        possible = [name for name in possible if name not in TYPES_WITHOUT_CRANK]
    if allowed is None or not allowed.isdisjoint(possible):
        return
    name = min(allowed, key=list(TYPES).index)
    crank = " with a driver that turns fully" if requirements.driver == "crank" else ""
    why = f"{with_article(name)} is made of {_pair_in_words(TYPES[name])}"
    if kinds != (first.kinds, second.kinds):
        why += "; where a fixed pivot is limited there is no PR, and where a moving one is no RP"
    others = f"require {types_in_words(possible)}" if possible else "require no type"
    raise InputError(
        "E132",
        "the limits and the requirements contradict each other: "
        f"{_kinds_in_words(kinds)}, and linkages of type "
        f"{types_in_words(requirements.types or ())} only{crank}",
        why=why,
        help=f"{others}, or let the limits allow other dyads",
    )


def _makes_pair(pair: tuple[Kind, Kind], kinds: tuple[frozenset[Kind], frozenset[Kind]]) -> bool:
    """Whether two dyads of these kinds can be the pair, in either order."""
    (a, b), (one, other) = pair, kinds
    return (a in one and b in other) or (b in one and a in other)


def _is_outside(footprint: Polygon, region: Region) -> bool:
    """Whether a region surely lies outside the footprint."""
    corners, edge = region.corners(), footprint.corners()
    low, high = edge.min(axis=0), edge.max(axis=0)
    slack = FOOTPRINT_MARGIN * float(np.linalg.norm(high - low))
    if isinstance(region, Line):
        ((offset, *normal),) = region.equations()
        sides = edge @ np.array(normal) + offset
        return bool((sides > slack).all() or (sides < -slack).all())
    assert corners is not None
    if len(corners) == 1:
        return bool(footprint.distance(corners[0]) > slack)
    beyond = (corners.min(axis=0) > high + slack) | (corners.max(axis=0) < low - slack)
    return bool(beyond.any())


def _kinds_in_words(kinds: tuple[frozenset[Kind], frozenset[Kind]]) -> str:
    """The kinds of two dyads that their limits allow, in words."""
    one, other = (", ".join(sorted(each)) for each in kinds)
    if one == other:
        return f"dyads of kind {one} only"
    return f"one dyad of kind {one} and one of kind {other} only"


def _pair_in_words(pair: tuple[Kind, Kind]) -> str:
    return f"two {pair[0]} dyads" if pair[0] == pair[1] else f"dyads {pair[0]} and {pair[1]}"
