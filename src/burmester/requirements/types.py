"""The types of linkage allowed, and which dyad drives."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Set
from typing import TYPE_CHECKING, Final, Literal, TypeAlias, get_args

from burmester.errors import InputError
from burmester.requirements.requirement import Looser, Requirement, shown
from burmester.wording import listed, with_article

if TYPE_CHECKING:
    from burmester.requirements.figures import Figures

Driver: TypeAlias = Literal["any", "first", "second", "crank"]
DRIVERS: Final[tuple[Driver, ...]] = get_args(Driver)
DRIVERS_IN_WORDS: Final[Mapping[str, str]] = {
    "any": "either dyad",
    "first": "the first of two limits",
    "second": "the second of two limits",
    "crank": "one that turns fully",
}
DyadKind: TypeAlias = Literal["RR", "PR", "RP"]

# The types as `Linkage.type` names them, and the kinds of their two dyads.
TYPES: Final[Mapping[str, tuple[DyadKind, DyadKind]]] = {
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


def allowed_types(types: Iterable[str]) -> frozenset[str]:
    """The types allowed, words for groups replaced by their types."""
    return frozenset().union(*(GROUPS.get(name, {name}) for name in types))


def types_in_words(types: Iterable[str]) -> str:
    """Names of types in one phrase, in the order of `TYPES`."""
    return listed(_in_order(types), "or")


def _in_order(types: Iterable[str]) -> list[str]:
    return sorted(types, key=[*TYPES, *GROUPS].index)


def _type_names(given: object) -> Iterator[str]:
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


def _looser(types: frozenset[str], figures: Figures, _share: float) -> Looser | None:
    kind = figures.type_name
    if kind in allowed_types(types):
        return None
    return Looser(types | {kind}, f"type {kind} as well", 1.0)


def _written(types: frozenset[str]) -> str:
    names = ",".join(_in_order(types))
    return f'"{names}"' if " " in names else names


TYPE: Final = Requirement(
    name="types",
    kind="type",
    excess=lambda figures, types: figures.is_not(allowed_types(types)),
    said=lambda figures, _bound, _unit: f"it is {with_article(figures.type_name)}",
    short=lambda figures, _length: f"is {with_article(figures.type_name)}",
    form="names",
    known=(*GROUPS, *TYPES),
    option="--type",
    label="Types",
    metavar="NAME[,NAME]",
    help="Types of linkage allowed; see NAME below.",
    subject="the types are",
    words=lambda types: f"the type {types_in_words(types)}",
    such='types is a list of names, such as ["crank-rocker", "double-crank"]',
    checked=lambda given: frozenset(_type_names(given)),
    looser=_looser,
    written=_written,
    plain=_in_order,
)


def _driver(value: object) -> Driver:
    if not isinstance(value, str) or value not in DRIVERS:
        raise _unknown("driver", value, DRIVERS)
    return value


DRIVER: Final = Requirement(
    name="driver",
    kind="driver",
    excess=lambda figures, bound: figures.none + (1 - figures.turns) * (bound == "crank"),
    said=lambda _figures, _bound, _unit: "its driver does not turn fully",
    form="choice",
    default="any",
    option="--driver",
    label="driver",
    choices=DRIVERS_IN_WORDS,
    help="The driver: the dyad of the first or of the second limits, or (crank) a dyad that "
    "turns fully.",
    subject="the driver is",
    such="driver is one of " + ", ".join(f'"{name}"' for name in DRIVERS),
    checked=_driver,
    looser=lambda _bound, _figures, _share: Looser("any", "any driver", 1.0),
    written=str,
    words="{} driver".format,
)
