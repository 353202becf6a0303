"""Loads on a linkage: weights, forces, a hand, springs, and how its driver moves in time.

Masses are in kg, forces in N, moments in N m, times in s; points and lengths of springs in the
task's unit of lengths.

E177 loads are malformed    E178 no known unit of lengths    E179 a spring does not fit
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Final, Literal, final, get_args

import numpy as np

from burmester.errors import InputError
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.tasks.length_units import MILLIMETRES
from burmester.tasks.load_table import (
    DENSITIES,
    NEEDED,
    POSSIBLE,
    PROFILES,
    SIGNED,
    Profile,
    SpringKind,
)
from burmester.values import real_numbers, shown
from burmester.wording import listed

STANDARD_GRAVITY: Final = 9.80665  # m/s²
MOST_TIMES: Final = 2000  # rows of a table of times
ROOM_CELSIUS: Final = 20.0  # at which makers measure gas springs
SLACK: Final = 1e-9  # relative; lengths that differ by less are the same
GROUND: Final = "ground"
BODY: Final = "body"  # whatever link carries the body


def malformed(message: str, why: str | None = None, help: str | None = None) -> InputError:
    """The error E177."""
    return InputError("E177", message, why=why, help=help)


def _number(value: object, what: str, *, least: float = -math.inf, above: bool = False) -> float:
    out = float(real_numbers(value, (), what, code="E177"))
    if out < least or (above and out == least):
        help = f"give a number above {least:g}" if above else f"give {least:g} or more"
        raise malformed(f"{what} is {out:g}", help=help)
    return out


def _point(value: object, what: str) -> FloatArray:
    return real_numbers(value, (2,), what, code="E177")


@final
@dataclass(frozen=True, slots=True, eq=False)
class Mass:
    """A mass in kg with its centre (2,), in the frame of what has it.

    center: None for that of the body's outline.
    inertia_kgm2: about the centre; None for that of the outline, or of a point where there is none.
    """

    mass_kg: float
    center: FloatArray | None = None
    inertia_kgm2: float | None = None

    def __post_init__(self) -> None:
        mass = _number(self.mass_kg, "the mass of the body", least=0.0)
        object.__setattr__(self, "mass_kg", mass)
        if self.center is not None:
            object.__setattr__(self, "center", _point(self.center, "the centre of mass"))
        if self.inertia_kgm2 is not None:
            inertia = _number(self.inertia_kgm2, "the moment of inertia", least=0.0)
            object.__setattr__(self, "inertia_kgm2", inertia)


@final
@dataclass(frozen=True, slots=True, eq=False)
class Plates:
    """The links as flat plates with round ends, of a material (a key of `DENSITIES`, or kg/m³).

    thickness, width: in the task's unit.
    """

    material: str | float
    thickness: float
    width: float

    def __post_init__(self) -> None:
        if isinstance(self.material, str) and self.material not in DENSITIES:
            help = f"choose among {listed([*DENSITIES])}, or give the density in kg/m³"
            raise malformed(f"there is no material {shown(self.material)}", help=help)
        if not isinstance(self.material, str):
            density = _number(self.material, "the density of plates", least=0.0, above=True)
            object.__setattr__(self, "material", density)
        for name in ("thickness", "width"):
            value = _number(getattr(self, name), f"the {name} of plates", least=0.0, above=True)
            object.__setattr__(self, name, value)

    @property
    def density(self) -> float:
        """In kg/m³."""
        return DENSITIES[self.material] if isinstance(self.material, str) else self.material


@final
@dataclass(frozen=True, slots=True, eq=False)
class Force:
    """A force (2,) in N at a point of the body, (2,) in M.

    frame: "F", where its direction stays; or "M", where it turns with the body.
    from_pose, to_pose: from 1, between which poses it acts; None for all.
    """

    at: FloatArray
    force: FloatArray
    frame: Literal["F", "M"] = "F"
    from_pose: int | None = None
    to_pose: int | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "at", _point(self.at, "the point of a force"))
        object.__setattr__(self, "force", _point(self.force, "a force"))
        if self.frame not in ("F", "M"):
            help = 'say "F" for a force whose direction stays, "M" for one that turns with the body'
            raise malformed(f"there is no frame {shown(self.frame)}", help=help)
        for pose in (self.from_pose, self.to_pose):
            if pose is not None and not isinstance(pose, int):
                raise malformed(
                    f"a force acts to or from pose {shown(pose)}", help="give 1 or more"
                )


@final
@dataclass(frozen=True, slots=True)
class End:
    """An end of a spring: a point (2,) of a link, in the frame of the link.

    link: "ground", "body", or another name of a link.
    """

    link: str
    point: tuple[float, float]


@final
@dataclass(frozen=True, slots=True, eq=False)
class Spring:
    """A spring between two links, or a mass on one.

    kind: "extension" pulls by rate_N_per_mm beyond its free length, and initial_N more;
        "compression" pushes below it; "gas" pushes by force_N 5 mm before the end of its extension
        and by compressed_force_N 5 mm before the end of its stroke, at 20 °C; "constant" pulls by
        force_N; "torsion" turns the second link against the first by rate_Nm_per_deg for each
        degree from free_deg; "counterweight" is a mass at the second end.
    ends: of torsion springs and counterweights the points do not count, and the first end.
    numbers: by the names of `NEEDED` and `POSSIBLE`; lengths in the task's unit.
    count: how many of them.
    """

    kind: SpringKind
    ends: tuple[End, End]
    numbers: Mapping[str, float] = field(default_factory=dict)
    count: int = 1

    def __post_init__(self) -> None:
        if self.kind not in NEEDED:
            help = f"choose among {listed(get_args(SpringKind))}"
            raise malformed(f"there is no spring {shown(self.kind)}", help=help)
        needed, possible = NEEDED[self.kind], POSSIBLE[self.kind]
        what = f"a spring of kind {self.kind}"
        for name in needed:
            if name not in self.numbers:
                help = f"it needs {listed(needed)}"
                raise malformed(f"{what} states no {name}", help=help)
        numbers = dict[str, float]()
        for name, value in self.numbers.items():
            if name not in (*needed, *possible):
                help = f"it has {listed((*needed, *possible))}"
                raise malformed(f"{what} has no {name}", help=help)
            least = -math.inf if name in SIGNED else 0.0
            numbers[name] = _number(value, f"{name} of {what}", least=least)
        object.__setattr__(self, "numbers", numbers)
        if not isinstance(self.count, int) or not 1 <= self.count <= 1000:
            raise malformed(f"there are {shown(self.count)} of {what}", help="give 1 or more")
        if self.kind == "gas":
            stroke, length = numbers["stroke"], numbers["length"]
            if not 0 < stroke < length:
                why = f"its stroke is {stroke:g}, its length when extended {length:g}"
                help = "give the length between both ends when it is extended"
                raise malformed("a gas spring is shorter than its stroke", why, help)

    def __getitem__(self, name: str) -> float:
        """A number of it, 0 where it is not stated."""
        return self.numbers.get(name, 0.0)

    @property
    def span(self) -> tuple[float, float]:
        """The least and the greatest distance of its ends that it allows, in the task's unit."""
        if self.kind == "gas":
            return self["length"] - self["stroke"], self["length"]
        least = self["free_length"] if self.kind == "extension" else self["least_length"]
        return least, self.numbers.get("greatest_length", math.inf)


@final
@dataclass(frozen=True, slots=True, eq=False)
class Drive:
    """How the driver goes from the first pose to the last.

    profile: "constant" speed; at rest at both ends by the polynomial "3-4-5"; or a "trapezoid" of
    speed, a third of the time each; "table" where times are stated.
    times: rows of a time in s, the first 0, and of where the driver is then: the name or the number
    of a pose, as a text, or by how many degrees it has turned from the first pose on its way to the
    last.  Between them the motion is smooth, and at rest at both ends.

    Examples
    --------
    >>> Drive.through([(0, "closed"), (2, "open"), (3, "open")]).duration_s
    3.0
    """

    duration_s: float
    profile: Profile = "3-4-5"
    times: tuple[tuple[float, str | float], ...] = ()

    @classmethod
    def through(cls, times: Sequence[tuple[float, str | float]]) -> Drive:
        """A drive by a table of times; raises E177."""
        rows = tuple(times)
        if not 2 <= len(rows) <= MOST_TIMES or any(len(row) != 2 for row in rows):
            help = 'give rows of a time in s and a pose, such as [0, "closed"] and [2, "open"]'
            raise malformed(f"a table of times has 2 to {MOST_TIMES:,} rows of two", help=help)
        return cls(rows[-1][0], "table", rows)

    def __post_init__(self) -> None:
        duration = _number(self.duration_s, "the duration of the motion", least=0.0, above=True)
        object.__setattr__(self, "duration_s", duration)
        if self.profile not in get_args(Profile) or (self.profile == "table") != bool(self.times):
            help = f"choose among {listed(PROFILES)}, or state times"
            raise malformed(f"there is no profile {shown(self.profile)}", help=help)
        rows = tuple(
            (
                _number(time, "a time of the table", least=0.0),
                place if isinstance(place, str) else _number(place, "an angle of the driver"),
            )
            for time, place in self.times
        )
        object.__setattr__(self, "times", rows)
        last = -1.0
        for time, _ in rows:
            if not time > last:
                why = f"{time:g} s follows {last:g} s"
                raise malformed("times do not grow", why, "write the rows in their order of time")
            last = time
        if rows and rows[0][0] != 0:
            help = "count times from the beginning of the motion"
            raise malformed(f"the first time is {rows[0][0]:g} s, not 0", help=help)


@final
@dataclass(frozen=True, slots=True, eq=False)
class Loads:
    """All that loads a linkage.

    gravity: (2,), m/s² in F; zero for a plane across it.
    body: the mass of the body.  links: the masses of links in kg, by name, each at the middle of
        its joints, or their plates.
    forces: on the body; torque: on the body as well, in N m.
    hand: (2,), the point of the body, in M, at which a hand moves it along its path.
    springs: any number.  celsius: the temperature of gas springs.
    drive: the motion in time; None where there is no hurry.
    where: of each name of a link, where it stands in a file.
    """

    gravity: FloatArray = field(default_factory=lambda: np.array([0.0, -STANDARD_GRAVITY]))
    body: Mass | None = None
    links: Mapping[str, float] | Plates = field(default_factory=dict)
    forces: tuple[Force, ...] = ()
    torque: float = 0.0
    hand: FloatArray | None = None
    springs: tuple[Spring, ...] = ()
    celsius: float = ROOM_CELSIUS
    drive: Drive | None = None
    where: Mapping[str, str] = field(default_factory=dict, repr=False)

    def __post_init__(self) -> None:
        given: Any = self.gravity
        if isinstance(given, str):
            if given not in ("down", "none"):
                help = 'write "down", "none", or two numbers in m/s²'
                raise malformed(f"there is no gravity {shown(given)}", help=help)
            given = [0.0, -STANDARD_GRAVITY if given == "down" else 0.0]
        object.__setattr__(self, "gravity", _point(given, "gravity"))
        if isinstance(self.links, Mapping):
            masses = {
                name: _number(mass, f"the mass of {name}", least=0.0)
                for name, mass in self.links.items()
            }
            object.__setattr__(self, "links", masses)
        object.__setattr__(self, "torque", _number(self.torque, "the torque on the body"))
        if self.hand is not None:
            object.__setattr__(self, "hand", _point(self.hand, "the point of the hand"))
        warm = _number(self.celsius, "the temperature", least=-273.0)
        object.__setattr__(self, "celsius", warm)


def require_possible_loads(
    loads: Loads, poses: Displacement, unit: str | None, outlined: bool
) -> None:
    """Refuse loads that do not fit a task, whatever its linkage.

    E177 (a force between poses that are not there, a mass without a centre), E178 (lengths in no
    known unit), E179 (a spring between ground and body that is off its stroke at the first pose).
    """
    if unit not in MILLIMETRES:
        known = listed([*MILLIMETRES])
        raise InputError(
            "E178",
            "loads need the unit of lengths",
            why=f"the unit of lengths is {shown(unit)}, and moments are forces times lengths"
            if unit
            else "the task states no unit of lengths, and moments are forces times lengths",
            help=f'write length_unit = "mm" beside the poses; known are {known}',
        )
    (count,) = poses.shape
    for force in loads.forces:
        for pose in (force.from_pose, force.to_pose):
            if pose is not None and not 1 <= pose <= count:
                help = f"give a number from 1 to {count}"
                raise malformed(f"a force acts to or from pose {pose} of {count}", help=help)
    if loads.body is not None and loads.body.center is None and not outlined:
        raise malformed(
            "the body has a mass, and nothing says where its centre is",
            "the task has no outline of the body",
            "write center = [x, y], in the frame of the body, or give the body an outline",
        )
    for number, spring in enumerate(loads.springs, start=1):
        links = [each.link for each in spring.ends]
        if spring.kind in ("torsion", "counterweight") or {*links} - {GROUND, BODY}:
            continue
        at = [
            np.array(each.point) if each.link == GROUND else poses.act(np.array(each.point))[0]
            for each in spring.ends
        ]
        length, (least, most) = float(np.linalg.norm(at[1] - at[0])), spring.span
        if not least * (1 - SLACK) <= length <= most * (1 + SLACK):
            raise InputError(
                "E179",
                f"spring {number} does not fit between its ends at the first pose",
                why=f"they are {length:.4g} {unit} apart, and it is {least:.4g} to {most:.4g} long",
                help="move an end, or take a spring with another length or stroke",
            )
