"""One linkage of an answer: dimensions, error at the poses, verdict, uncertainty."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final, Literal, Self, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from burmester.clearance.least_clearance import Clearance
from burmester.dyads.selection import FoundDyad
from burmester.errors import Finding, InputError
from burmester.fourbar.bodies import bodies_of_four_bar, places_of_bodies, scaled_linkage
from burmester.fourbar.circuits import Circuits, circuit_of
from burmester.fourbar.defects import Driven, Verdict, judge
from burmester.fourbar.dyad import PP, PR, RP, RR
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.pose_error import PoseError
from burmester.geometry.displacement import Displacement
from burmester.mechanisms.bodies import Bodies, LinkPlaces
from burmester.mechanisms.pose_order import smallest_arc
from burmester.numerics.arrays import TURN, FloatArray, wrapped_angle
from burmester.requirements.figures import Figures
from burmester.tasks.motion_task import characteristic_length
from burmester.values import real_numbers
from burmester.verdicts.judged_linkage import LinkageAtPoses
from burmester.verdicts.motion import Configuration, Motion, Way
from burmester.verdicts.quality import Quality
from burmester.verdicts.requirement_check import four_bar_figures
from burmester.verdicts.tolerances import Spread
from burmester.verdicts.uncertainty import DyadUncertainty

Pair: TypeAlias = tuple[FoundDyad, FoundDyad]
Side: TypeAlias = Literal["first", "second"]


SAME_PLACE: Final = 1e-9  # characteristic lengths; places that differ by less are one
ANGLE_SAMPLES: Final = 721  # places between which the coupler's angle is unwrapped


def numbered_pair(linkage: Linkage, number: int) -> Pair:
    """The dyads of a linkage, numbered from `number`; an evaluation tells their errors."""
    return (
        FoundDyad(f"D{number}", linkage.first, 0.0, 0.0),
        FoundDyad(f"D{number + 1}", linkage.second, 0.0, 0.0),
    )


def with_driver_first(linkage: Linkage, driver: Side) -> Linkage:
    """The linkage with the dyad that drives first."""
    return Linkage(linkage.second, linkage.first) if driver == "second" else linkage


@dataclass(frozen=True, slots=True, eq=False)
class FoundLinkage(LinkageAtPoses):
    """A linkage made of two dyads, refined as a whole, with all that is known of it.

    Attributes
    ----------
    rank : int
        From 1; see `ranking`.
    dyads : tuple of two FoundDyad
        With their dimensions in this linkage, the preferred driver first, unless the task has two
        limits, whose order they keep.  The ids name the dyads from which they come.
    linkage : Linkage
        The same dimensions.
    combined_error : float
        What was made least: the weighted root mean square (with the norm "worst" the greatest)
        over the poses of position and angle error in one, `PoseError.combined`; infinite where
        some pose is out of reach.  Along a path the greatest distance of a point from the curve:
        what "nearest" means there.
    verdict : Verdict
        The defects, and the motion with either driver.
    preferred_driver : "first" or "second"
        The better driver, or the only one allowed.
    usable : bool
        Whether the linkage, with that driver, leads through all poses and meets all requirements.
    quality : Quality, optional
        What a designer pays for, with the preferred driver; None where the error is infinite.
    from_search : bool
        Whether it comes from the search for defect-free linkages.
    uncertainty : tuple of two DyadUncertainty, optional
        The 95 % regions of both dyads that errors of the poses leave.
    determined : bool
        Whether these regions are small compared with the motion.
    other_types : tuple of str
        The other types of Grashof that errors of the poses leave possible (`possible_types`).
    spread : Spread, optional
        Of the error, for links and pivots built within a tolerance.
    error_before_rounding : PoseError, optional
        The error before the dimensions were rounded.
    clearance : Clearance, optional
        The least clearance from the surroundings between the poses; None without surroundings,
        and where it does not come from pose to pose.
    timing_error : (N,) array, optional
        How far the driver is from the stated crank angles at the poses, signed, in radians, where
        the task has some; nan at poses that are not timed.
    id, error, violations, shortcomings, within_tolerance, task
        As in `LinkageAtPoses`.

    Examples
    --------
    >>> from burmester import read_task, synthesize
    >>> best = synthesize(read_task("case:motiongen-shoulder")).linkages[0]
    >>> best.id, best.type, best.usable
    ('L1', 'crank-rocker', True)
    """

    rank: int
    dyads: Pair
    linkage: Linkage
    combined_error: float
    verdict: Verdict
    preferred_driver: Side
    usable: bool
    quality: Quality | None = None
    from_search: bool = False
    uncertainty: tuple[DyadUncertainty, DyadUncertainty] | None = None
    determined: bool = True
    other_types: tuple[str, ...] = ()
    spread: Spread | None = None
    error_before_rounding: PoseError | None = None
    clearance: Clearance | None = None
    timing_error: FloatArray | None = None

    @property
    def type(self) -> str:
        """Grashof's type of the dimensions, or the slider linkage's name; see `other_types`.

        With the preferred driver.
        """
        return self.driver_first.type

    @property
    def driver(self) -> Side | None:
        """The dyad that drives; None where the linkage is not usable."""
        return self.preferred_driver if self.usable else None

    @property
    def driven(self) -> Driven:
        """The motion with the preferred driver."""
        return self.verdict.first if self.preferred_driver == "first" else self.verdict.second

    @property
    def defects(self) -> tuple[Finding, ...]:
        """The defects of the linkage and of its preferred driver."""
        return self.verdict.defects + self.driven.defects

    @property
    def figures(self) -> Figures:
        """What it measures and does with the preferred driver, but for the footprint."""
        return self.with_loads(four_bar_figures(self.driver_first, self.driven))

    @property
    def dyads_driver_first(self) -> Pair:
        """The dyads, the preferred driver first."""
        return self.dyads if self.preferred_driver == "first" else (self.dyads[1], self.dyads[0])

    @property
    def ids(self) -> tuple[str, str]:
        """The names of the dyads, the preferred driver first."""
        one, two = self.dyads_driver_first
        return one.id, two.id

    @property
    def least_transmission(self) -> float:
        """The least transmission angle between the poses with the preferred driver, in radians."""
        return self.driven.least_over_range

    @property
    def driver_first(self) -> Linkage:
        """The linkage with the preferred driver first."""
        return with_driver_first(self.linkage, self.preferred_driver)

    @property
    def bodies(self) -> Bodies:
        """Its bodies and joints, the preferred driver driving; raises E163 for PP dyads."""
        return bodies_of_four_bar(scaled_linkage(self.driver_first, 1.0))

    def bodies_at(self, drive: FloatArray, body: Displacement) -> LinkPlaces:
        """Where its bodies are when the driver is at (*,) and M at places (*,)."""
        return places_of_bodies(self.driver_first, body)

    def at(self, driver: ArrayLike) -> Configuration:
        """Where body and joints are for the driver's angle, or for an array of angles.

        Parameters
        ----------
        driver : float or array_like
            Angles of the driving link in degrees in F, or lengths along its line where a slider
            drives: the range is `driven.input_range`.  The linkage stays on the branch of the
            poses.

        Returns
        -------
        Configuration
            The driver's values, the poses of the body, and its joints: "driver_fixed",
            "driver_moving", "follower_fixed" and "follower_moving", as far as there are pins.  Not
            a number where the driver cannot go.

        Raises
        ------
        InputError
            E125 (no real numbers) and E163 (a linkage that goes from no pose to another).

        Examples
        --------
        >>> import burmester
        >>> best = burmester.synthesize(burmester.read_task("case:motiongen-shoulder")).best
        >>> here = best.at(best.motion(3).driver)
        >>> here.body.translation.shape, here.joints["follower_moving"].shape
        ((3, 2), (3, 2))
        """
        given = real_numbers(driver, (...,), "the driver")
        middle = circuit_of(self.driver_first, Motion.of(self, 3).places[1], as_given=True)
        own = Circuits.of(self.driver_first, as_given=True)[int(middle.circuit)]
        inputs = np.radians(given) if own.turns else given
        places = own.reached_at(np.ravel(inputs), int(middle.branch))
        shaped = Displacement(
            places.translation.reshape(*given.shape, 2), places.angle.reshape(given.shape)
        )
        return Configuration(given, shaped, self.joints_at(inputs, shaped))

    def joints_at(self, drive: FloatArray, body: Displacement) -> dict[str, FloatArray]:
        """Its joints (*, 2) by name when M is at places (*,)."""
        joints = dict[str, FloatArray]()
        dyads = self.driver_first.first, self.driver_first.second
        for name, dyad in zip(("driver", "follower"), dyads, strict=True):
            if isinstance(dyad, RR | RP):
                shape = body.translation.shape
                joints[f"{name}_fixed"] = np.broadcast_to(dyad.fixed_pivot, shape)
            if isinstance(dyad, RR | PR):
                joints[f"{name}_moving"] = body.act(dyad.moving_pivot)
        return joints

    def scaled(self, scale: float) -> Self:
        """The same in another unit of length; raises E163 for PP dyads."""
        linkage = scaled_linkage(self.linkage, scale)
        return replace(self, linkage=linkage, error=self.error.scaled(scale))

    def at_poses(self) -> LinkPlaces:
        """Where its bodies are for the poses (N,)."""
        return places_of_bodies(self.driver_first, self.error.places)

    def all_places(self, count: int) -> LinkPlaces:
        """Where its bodies are along all branches that have poses, and for these."""
        places = places_on_branches(self.driver_first, self.error.places, count)
        return places_of_bodies(self.driver_first, places)

    def travel(self, whole: bool = False) -> Way:
        """Its motion, at whatever shares of it; see `Motion.of`."""
        return way_of_four_bar(self, whole)


def way_of_four_bar(chosen: FoundLinkage, whole: bool) -> Way:
    """The motion of a four-bar; see `Motion.of`."""
    driven = _driven(chosen)
    reached = np.flatnonzero(np.isfinite(driven.parameter))
    if len(reached) < 2 or driven.circuit < 0:
        name = f"linkage {chosen.id}"
        raise InputError(
            "E163",
            f"{name} does not move from one pose to another",
            why=f"its driver reaches {_poses(len(reached))} of {len(driven.parameter)} "
            "without being taken apart or passing a dead point",
            help="choose a linkage that `burmester synthesize` calls usable",
        )
    s = driven.parameter
    first, last = s[reached[0]], s[reached[-1]]
    sense = -1.0 if last < first else 1.0
    start = sense * np.nanmin(sense * s)
    length = TURN if whole and driven.turns_fully else float(np.ptp(s[reached]))
    if length <= 0:
        raise InputError(
            "E163",
            f"linkage {chosen.id} does not move from one pose to another",
            why="all poses that its driver reaches are the same place",
            help="give poses that differ",
        )
    own = Circuits.of(chosen.driver_first, as_given=True)[driven.circuit]
    # Angles are followed in small steps, and come by whole turns as the first pose has its own.
    steps = np.linspace(0.0, 1.0, ANGLE_SAMPLES)
    followed = np.unwrap(own.couplers(start + sense * length * steps).angle)
    there = np.interp(sense * (first - start) / length, steps, followed)
    turns = np.round((chosen.error.places.angle[reached[0]] - there) / TURN)
    before = TURN * _turns(own, start)

    def at(share: FloatArray) -> Motion:
        parameter = start + sense * length * share
        places = own.couplers(parameter)
        angle = np.interp(share, steps, followed) + TURN * turns
        angle = places.angle + TURN * np.round((angle - places.angle) / TURN)
        return Motion(
            Displacement(places.translation, angle),
            own.inputs(parameter, places) - before,
            sense * (s - start) / length,
            bool(own.loop.turns),
            driven.turns_fully,
            bool(whole and driven.turns_fully),
        )

    return at


def _driven(chosen: FoundLinkage) -> Driven:
    """The linkage with its driver, judged by the poses that lie together on one branch."""
    first, second = chosen.driver_first.first, chosen.driver_first.second
    if isinstance(first, PP) or isinstance(second, PP):
        raise InputError(
            "E163",
            f"linkage {chosen.id} has no motion with one driver",
            why="a body that only translates has a PP dyad, which has no single joint to drive",
            help="choose a linkage of RR, PR and RP dyads",
        )
    places, task = chosen.error.places, chosen.task
    length = characteristic_length(task)
    missed = np.hypot(chosen.error.position, length * chosen.error.angle)

    def judged(places: Displacement) -> tuple[Driven, bool]:
        (verdict,) = judge(
            Linkage(first[None], second[None]),
            places[None],
            missed=missed[None],
            reach=np.inf,
            length=length,
            any_order=task.requirements.any_order,
        )
        locks = any(each.kind == "branch" and each.certain for each in verdict.first.defects)
        return verdict.first, locks

    if _is_of(chosen.driven, chosen.driver_first, places, length):
        return chosen.driven
    driven, locks = judged(places)
    if locks:
        here = circuit_of(chosen.driver_first, places, as_given=True)
        on = np.isfinite(driven.parameter)
        more = int((on & (here.branch == 1)).sum()) > int((on & (here.branch == 0)).sum())
        keep = on & (here.branch == int(more))
        driven, _ = judged(replace(places, angle=np.where(keep, places.angle, np.nan)))
    return driven


def _is_of(driven: Driven, linkage: Linkage, places: Displacement, length: float) -> bool:
    """Whether a linkage was judged at just these places, and takes them all on one branch."""
    if driven.circuit < 0 or any(each.kind == "branch" for each in driven.defects):
        return False
    own = Circuits.of(linkage, as_given=True)[driven.circuit]
    there = own.couplers(driven.parameter)
    away = np.hypot(*(there.translation - places.translation).T)
    turned = length * np.abs(wrapped_angle(there.angle - places.angle))
    return bool(((away + turned) <= SAME_PLACE * length).all())


def places_on_branches(linkage: Linkage, places: Displacement, count: int) -> Displacement:
    """Coupler places (n,) along each branch of a circuit from its first to its last of places (N,).

    The places themselves are among them, in their order along the way.
    """
    circuits = Circuits.of(linkage, as_given=True)
    here = circuits.locate(places)
    rows: list[FloatArray] = []
    on = np.isfinite(here.parameter) & (here.circuit >= 0)
    for circuit, branch in sorted(set(zip(here.circuit[on], here.branch[on], strict=True))):
        own = circuits[int(circuit)]
        s = here.parameter[on & (here.circuit == circuit) & (here.branch == branch)]
        if own.turns_fully:
            s = smallest_arc(s[None])[0]
        s = np.unique(np.concatenate([np.linspace(s.min(), s.max(), count), s]))
        with np.errstate(invalid="ignore", divide="ignore"):
            along = own.couplers(s)
        rows.append(np.column_stack([along.translation, along.angle]))
    table = np.concatenate(rows or [np.column_stack([places.translation, places.angle])])
    return Displacement.from_poses(table[np.isfinite(table).all(axis=1)])


def _turns(own: Circuits, start: float) -> float:
    """The whole turns of the driver at a parameter."""
    if not own.loop.turns:
        return 0.0
    at = np.array([start])
    return float(np.floor(own.inputs(at, own.couplers(at))[0] / TURN))


def _poses(count: int) -> str:
    return ("no pose", "one pose")[count] if count < 2 else f"{count} poses"
