"""Which dyad drives."""

from __future__ import annotations

from typing import Final, Literal, TypeAlias, get_args

from burmester.requirements.requirement import Looser, Requirement
from burmester.requirements.types import unknown

__all__ = ["DRIVER", "DRIVERS", "Driver"]

Driver: TypeAlias = Literal["any", "first", "second", "crank"]
DRIVERS: Final[tuple[Driver, ...]] = get_args(Driver)


def _checked(value: object) -> Driver:
    if not isinstance(value, str) or value not in DRIVERS:
        raise unknown("driver", value, DRIVERS)
    return value


DRIVER: Final = Requirement(
    name="driver",
    kind="driver",
    excess=lambda figures, bound: figures.none + (1 - figures.turns) * (bound == "crank"),
    said=lambda _figures, _bound, _unit: "its driver does not turn fully",
    form="choice",
    default="any",
    option="--driver",
    choices=DRIVERS,
    help="The driver: the dyad of the first or of the second limits, or (crank) a dyad that "
    "turns fully.",
    subject="the driver is",
    such="driver is one of " + ", ".join(f'"{name}"' for name in DRIVERS),
    checked=_checked,
    looser=lambda _bound, _figures, _share: Looser("any", "any driver", 1.0),
    written=str,
)
