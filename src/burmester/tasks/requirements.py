"""Requirements on the whole linkage, beside the limits on each of its dyads."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Set
from dataclasses import dataclass
from numbers import Real
from typing import Final, Literal, TypeAlias, final, get_args

import numpy as np

from burmester.errors import InputError
from burmester.geometry.regions import Line, Polygon, Region, require_searchable
from burmester.tasks.limits import Kind, Limits
from burmester.values import shown
from burmester.wording import listed, with_article

__all__ = ["DRIVERS", "GROUPS", "TYPES", "Driver", "Requirements", "require_possible"]

Driver: TypeAlias = Literal["any", "first", "second", "crank"]
DRIVERS: Final[tuple[Driver, ...]] = get_args(Driver)

# The types as `Linkage.type` names them, and the kinds of their two dyads.
TYPES: Final[Mapping[str, tuple[Kind, Kind]]] = {
    "crank-rocker": ("RR", "RR"),
    "rocker-crank": ("RR", "RR"),
    "double-crank": ("RR", "RR"),
    "double-rocker": ("RR", "RR"),
    "triple-rocker": ("RR", "RR"),
    "change-point": ("RR", "RR"),
    "slider-crank": ("RR", "PR"),
    "inverted slider-crank": ("RR", "RP"),
    "double slider": ("PR", "PR"),
    "Oldham linkage": ("RP", "RP"),
    "Rapson slide": ("PR", "RP"),
}
# A change point is in neither group: it is the border between the two.
GROUPS: Final[Mapping[str, frozenset[str]]] = {
    "grashof": frozenset({"crank-rocker", "rocker-crank", "double-crank", "double-rocker"}),
    "non-grashof": frozenset({"triple-rocker"}),
}

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
        angle = _number(self.transmission_deg, "the least transmission angle")
        if not 0 <= angle < 90:
            raise InputError(
                "E134",
                f"a least transmission angle of {angle:g}° is impossible",
                why="a transmission angle is between 0° and 90°",
                help="give an angle from 0° to below 90°",
            )
        object.__setattr__(self, "transmission_deg", angle)
        if self.types is not None:
            object.__setattr__(self, "types", frozenset(_type_names(self.types)))
        if not isinstance(self.driver, str) or self.driver not in DRIVERS:
            raise _unknown("driver", self.driver, DRIVERS)
        if self.footprint is not None and not isinstance(self.footprint, Polygon):
            what = type(self.footprint).__name__.lower()
            raise InputError(
                "E134",
                f"a footprint is a box or a polygon, not a {what}",
                why="the pivots must have room in it",
                help="give a box by two corners, or a polygon by three or more",
            )
        if self.footprint is not None:
            require_searchable(self.footprint)
        ratio = _number(self.link_ratio, "the greatest link ratio", infinite=True)
        if ratio < 1:
            raise InputError(
                "E134",
                f"a link ratio of at most {ratio:g} is impossible",
                why="the longest of the four links is never shorter than the shortest",
                help="give a ratio of 1 or more, such as 5",
            )
        object.__setattr__(self, "link_ratio", ratio)
        for name, what, of, such in (
            ("within", "the greatest acceptable error", "", "a length"),
            ("within_deg", "the greatest acceptable angle error", "°", "an angle"),
        ):
            if (value := getattr(self, name)) is None:
                continue
            bound = _number(value, what)
            if bound <= 0:
                raise InputError(
                    "E134",
                    f"an error of at most {bound:g}{of} is impossible",
                    why="no pose is met better than rounding allows",
                    help=f"give {such} above zero, and mark poses that must be met exactly",
                )
            object.__setattr__(self, name, bound)
        if not isinstance(self.any_order, bool | np.bool_):
            raise InputError(
                "E134",
                f"any_order is {shown(self.any_order)}, neither true nor false",
                help="give True where the poses need not be met in their order, else False",
            )
        object.__setattr__(self, "any_order", bool(self.any_order))
        allowed = self.allowed_types
        if self.driver == "crank" and allowed is not None and allowed <= TYPES_WITHOUT_CRANK:
            turning = [name for name in TYPES if name not in TYPES_WITHOUT_CRANK]
            raise InputError(
                "E132",
                "the requirements contradict each other: a driver that turns fully, and "
                f"linkages of type {_types_in_words(self.types)} only",
                why=f"no driver of a {_types_in_words(allowed)} turns fully",
                help=f"allow another type as well, such as {turning[0]}, or any driver",
            )

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

    @property
    def has_any(self) -> bool:
        """Whether there is any requirement at all."""
        return self != _NO_REQUIREMENTS

    @property
    def allowed_types(self) -> frozenset[str] | None:
        """The types allowed, words for groups replaced by their types; None for all."""
        if self.types is None:
            return None
        return frozenset().union(*(GROUPS.get(name, {name}) for name in self.types))

    def allows(self, name: str) -> bool:
        """Whether linkages of a type, named as `Linkage.type` does, are allowed."""
        allowed = self.allowed_types
        return allowed is None or name in allowed


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
    others = f"require {_types_in_words(possible)}" if possible else "require no type"
    raise InputError(
        "E132",
        "the limits and the requirements contradict each other: "
        f"{_kinds_in_words(kinds)}, and linkages of type "
        f"{_types_in_words(requirements.types)} only{crank}",
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


def _number(value: object, what: str, *, infinite: bool = False) -> float:
    """A finite number (or infinity, where that is one), or E134."""
    if not isinstance(value, Real) or isinstance(value, bool):
        raise InputError(
            "E134", f"{what} is {shown(value)}, not a number", help="give a number, such as 0.5"
        )
    try:
        number = float(value)
    except OverflowError:
        number = math.nan
    if not math.isfinite(number) and not (infinite and number == math.inf):
        raise InputError(
            "E134", f"{what} is {shown(value)}, not a finite number", help="give a finite number"
        )
    return number


def _type_names(given: Iterable[str]) -> Iterator[str]:
    """The names as `TYPES` and `GROUPS` spell them."""
    known = {_normalized(name): name for name in (*TYPES, *GROUPS)}
    names = list(given) if isinstance(given, Set | list | tuple) else None
    if not names:
        raise InputError(
            "E134",
            "no linkage type is left"
            if names == []
            else f"types is {shown(given)}, not a set of names",
            help=f"name one type or more: {', '.join(known.values())}; or leave types out",
        )
    for name in names:
        if not isinstance(name, str) or _normalized(name) not in known:
            raise _unknown("linkage type", name, tuple(known.values()))
        yield known[_normalized(name)]


def _normalized(name: str) -> str:
    return " ".join(name.lower().replace("-", " ").split())


def _unknown(what: str, name: object, known: tuple[str, ...]) -> InputError:
    """E134 for a name that is none of the known ones, with the likeliest of them."""
    from difflib import get_close_matches  # noqa: PLC0415  for an error only

    plain = {_normalized(each): each for each in known}
    near = get_close_matches(_normalized(str(name)), plain, n=1)
    guess = f"did you mean {plain[near[0]]}? " if near else ""
    help = f"{guess}choose among {', '.join(known)}"
    return InputError("E134", f"there is no {what} {shown(name)}", help=help)


def _types_in_words(types: Iterable[str] | None) -> str:
    """Names of types in one phrase, in the order of `TYPES`."""
    return listed(sorted(types or (), key=[*TYPES, *GROUPS].index), "or")


def _kinds_in_words(kinds: tuple[frozenset[Kind], frozenset[Kind]]) -> str:
    """The kinds of two dyads that their limits allow, in words."""
    one, other = (", ".join(sorted(each)) for each in kinds)
    if one == other:
        return f"dyads of kind {one} only"
    return f"one dyad of kind {one} and one of kind {other} only"


def _pair_in_words(pair: tuple[Kind, Kind]) -> str:
    return f"two {pair[0]} dyads" if pair[0] == pair[1] else f"dyads {pair[0]} and {pair[1]}"


_NO_REQUIREMENTS = Requirements()
