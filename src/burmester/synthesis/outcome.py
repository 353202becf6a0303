"""What came of a task, in words: the outcome and the warnings."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

from burmester.cures import Cure, Help
from burmester.dyads.critical_points import CriticalDyads
from burmester.dyads.critical_search import COUNT
from burmester.dyads.five_poses import FivePoseDyads
from burmester.dyads.local_minima import BestDyads
from burmester.dyads.selection import Found, GivenPoses, within_digits
from burmester.dyads.sliders import nearly_sliders, swing
from burmester.errors import Advice
from burmester.fourbar.dyad import RR
from burmester.linkages.from_dyads import MAX_POSES_REFINED, sample_refined
from burmester.requirements.transmission import TRANSMISSION
from burmester.synthesis.dyad_search import DyadSearch, exact_dyads
from burmester.synthesis.point_conditions import point_conditions
from burmester.synthesis.result import Outcome
from burmester.tasks.motion_task import CONDITIONS, Task, characteristic_length
from burmester.tasks.notation import length_of, span
from burmester.tasks.problem import SynthesisProblem
from burmester.tasks.repeated_poses import rotation_range
from burmester.verdicts.explanation import by_nearness, hints, in_short, nearness
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.verdicts.ranking import only_too_far
from burmester.wording import count, figure, least_angle, listed

BETTER = 1.2  # ratio of two least transmission angles; from it on the better linkage is named
LITTLE = math.radians(30)  # rotation of the body below which the outcome says "only"
USUAL_TRANSMISSION = 40.0  # degrees; the least angle over the range that designers ask for
NEAR_DIGITS = 10.0  # times what the digits leave; a dyad that misses by less may be the exact one
SHOWN_ANGLE = 1e-6  # degrees; an angle lower by less is as good


def dyad_advice(
    problem: SynthesisProblem, found: DyadSearch, linkages: Sequence[FoundLinkage] = ()
) -> Iterator[Advice]:
    """What a user should know about the dyads; linkages: those that are listed, of these dyads."""
    if problem.leaves_linkages_open:  # start values: their poses are partly made up
        yield from _thin_regions(problem)
        return
    yield from _nearly_sliders(problem, found, linkages)
    for fit in found.fits:
        if isinstance(fit, FivePoseDyads):
            yield from _off_poses(problem, found)
        elif not isinstance(fit, BestDyads):
            continue
        elif isinstance(fit.search, CriticalDyads):
            yield from _unaccounted(problem, found, fit, fit.search)
        elif fit.search.lost or fit.search.unsettled:
            yield Advice(
                "W207",
                f"{count(fit.search.lost, 'path')} of the search and "
                f"{count(fit.search.unsettled, 'way')} down from it were lost: a locally best "
                "dyad may be missing",
                "move a limit a little and compare",
            )
    yield from _thin_regions(problem)
    if found.left_out:
        yield Advice(
            "W206",
            f"{count(found.left_out, 'solution')} left out as no dyad: an endless link with no "
            "slider in its place, poses with two different angles only, or all digits lost",
            "give poses that differ more, above all in their angles",
        )


def _nearly_sliders(
    problem: SynthesisProblem, found: DyadSearch, linkages: Sequence[FoundLinkage]
) -> list[Advice]:
    """W204 of long links as built: of each dyad in its first linkage, or else by itself."""
    poses, size = problem.task.poses, max(span(problem.given), problem.length)  # as the page shows
    known = {each.id: (each.id, each.dyad) for each in found.dyads}
    for linkage in sorted(linkages, key=lambda each: (each.usable, -each.rank)):
        for each in linkage.dyads:
            known[each.id] = (f"{each.id} of {linkage.id}", each.dyad)
    return [
        Advice(
            "W204",
            f"{name} has a link of {dyad.radius / size:.0f} times the span of the "
            f"poses, and it swings by {figure(math.degrees(swing(dyad, poses)))}°: nearly a slider",
            Help.of(
                "if a link that long cannot be built, say how long it may be with {}",
                Cure("length", option="--length :MAX"),
            ),
        )
        for name, dyad in known.values()
        if isinstance(dyad, RR) and nearly_sliders(dyad, poses, size)
    ]


def _off_poses(problem: SynthesisProblem, found: DyadSearch) -> Iterator[Advice]:
    """What is said of dyads that should meet all five poses and do not."""
    some = found.dyads[: found.meeting]
    within = within_digits(Found.of(some), GivenPoses.of(problem.task, problem.length))
    off = [each.id for each, met in zip(some, within, strict=True) if not met]
    if off:
        yield Advice(
            "W207",
            f"rounding took digits of {listed(off)}, which should meet all poses and "
            f"{'does' if len(off) == 1 else 'do'} not: a dyad may be missing",
            "give poses with more rotation between them, or origins nearer to them",
        )


def _unaccounted(
    problem: SynthesisProblem, found: DyadSearch, fit: BestDyads, search: CriticalDyads
) -> Iterator[Advice]:
    """What is not accounted for of a task without limits, if anything."""
    help = Help.of(
        "compare with {}; poses that turn little, or of a special motion, are the usual reason",
        Cure("method", "pencil"),
    )
    known, nullity = _accounted(search), 0 if problem.motion is None else problem.motion.nullity
    exact = int(exact_dyads(nullity, problem.task.poses.shape[0]))
    # Where all points are accounted for, no dyad is missing for a rank that is near its border.
    times = NEAR_DIGITS if known == COUNT else 1.0
    given = GivenPoses.of(problem.task, problem.length)
    meeting = int(within_digits(Found.of(found.dyads), given, times).sum())
    lent = bool(problem.given.free_angles.any())  # angles from a linkage agree with its dyads
    if meeting < exact and not lent:
        message = (
            f"{exact} independent quadrics hold the poses within their digits, so that as many "
            f"dyads should meet them, and {meeting or 'none'} of those listed "
            f"{'does' if meeting < 2 else 'do'}: a dyad is missing, or the digits do not "
            "determine it"
        )
    elif known < COUNT:
        message = f"{known} of {COUNT} critical points were told apart: a locally best dyad may be "
        message += "missing"
    elif fit.unfinished:
        message = f"{count(fit.unfinished, 'way')} down to a nearer dyad had to be given up: a "
        message += "locally best dyad may be missing"
    else:
        return
    yield Advice("W207", message, help)


def _thin_regions(problem: SynthesisProblem) -> list[Advice]:
    """Regions thinner than rounding, and what they were taken for."""
    said: dict[str, Advice] = {}
    for limits, searched in zip(problem.given.limits, problem.task.limits, strict=True):
        pairs = {
            "fixed": (limits.fixed_pivot, searched.fixed_pivot),
            "moving": (limits.moving_pivot, searched.moving_pivot),
        }
        for name, (given, taken) in pairs.items():
            if given is not taken:
                kind = type(taken).__name__.lower()
                message = f"the {name} pivot's region is thinner than rounding: taken for a {kind}"
                help = f"give it as a {kind}, or give it more room"
                said[message] = Advice("W212", message, help, f"this dyad's pivot is {taken}")
    return list(said.values())


def family(problem: SynthesisProblem) -> tuple[Outcome, Advice]:
    """What to say of a task with too few conditions."""
    task, whole = problem.task, problem.given.poses.shape[0]
    distinct, missing = task.poses.shape[0], problem.missing_conditions
    free = max(missing)
    poses = count(whole, "pose") + (f", {distinct} of them different," if distinct < whole else "")
    on_pivots = CONDITIONS - free - distinct
    given = poses + (f" and {count(on_pivots, 'condition')} on a pivot" if on_pivots else "")
    which = "the other dyad: " if free > min(missing) <= 0 else ""
    parameter = {1: "one", 2: "two", 3: "three"}.get(free, str(free))
    help = (
        f"add {count(free, 'more pose')} to get all that pass exactly, or put pivots on lines "
        "(one condition each) or at points (two)"
    )
    calls = {3: "dyad_with_moving_pivot", 4: "dyad_curve"}.get(distinct)
    if calls and not task.limits:
        help += f", or choose from the family in Python: burmester.{calls}"
    return (
        Outcome(
            "R303",
            f"{given} leave infinitely many linkages: {which}a {parameter}-parameter family of "
            "dyads passes through all of them",
            help,
        ),
        Advice("W203", f"{given} do not determine a linkage", help),
    )


def summary(
    problem: SynthesisProblem, search: DyadSearch, linkages: Sequence[FoundLinkage]
) -> Outcome:
    """What came of a task, in one sentence."""
    dyads, aside = _dyads(problem, search)
    if not linkages:
        return _none(problem.given, search, dyads + aside)
    usable = [each for each in linkages if each.usable]
    if problem.leaves_linkages_open and usable:
        asked = point_conditions(problem.given)
        what = f"{asked} leave" if asked else "the poses, free as they are, leave"
        some = (
            f"of {len(linkages)} found, {len(usable)} {'is' if len(usable) == 1 else 'are'} usable"
        )
        return Outcome("R308", f"{what} infinitely many linkages; {some}")
    if len(search.dyads) < 2:
        dyads = f"links of low error beside {dyads}"
    all_of_them = f"{count(len(linkages), 'four-bar')} from {dyads}"
    if not usable:
        return _none_usable(problem, linkages, all_of_them, aside)
    if len(usable) < len(linkages):
        share = f"{len(usable)} of them usable"
    else:
        share = "usable" if len(usable) == 1 else "all of them usable"
    message = f"{all_of_them}, {share}{aside}"
    if not any(each.determined for each in usable):
        return _undetermined(problem, usable, message)
    approximate = isinstance(search.fits[0], FivePoseDyads) and search.meeting < 2
    return Outcome("R307" if approximate else "R300", message)


def offering_six_bars(problem: SynthesisProblem, outcome: Outcome) -> Outcome:
    """An outcome without a usable four-bar, with what is left to do where six-bars may do it."""
    task = problem.given
    asked = task.requirements
    keeps = task.tolerances is None and task.surroundings is None and asked.footprint is None
    keeps &= asked.types is None and asked.driver in ("any", "crank")
    keeps &= all("RR" in each.allowed for each in task.limits)
    five = task.poses.shape[0] == problem.task.poses.shape[0] == CONDITIONS
    if outcome.code not in ("R301", "R302", "R306") or not (five and keeps):
        return outcome
    also = "; or look for six bars that do it: --six-bars"
    return replace(outcome, help=Help(outcome.help or "", also))


def _dyads(problem: SynthesisProblem, search: DyadSearch) -> tuple[str, str]:
    """The dyads with the reach of the search, in words; and a remark that ends the sentence."""
    first, found, task = search.fits[0], search.dyads, problem.given
    if isinstance(first, FivePoseDyads):
        aside = ""
        if search.meeting < len(found):
            error = length_of(found[search.meeting].rms_error, task)
            aside = f"; the nearest other one misses the poses by {error} rms"
        return count(search.meeting, "real dyad") + " (of the 4 that five poses have)", aside
    if isinstance(first, BestDyads) and isinstance(first.search, CriticalDyads):
        known = _accounted(first.search)
        how = f"{known} of {COUNT} critical points accounted for"
        if known < COUNT:
            how = f"{known} of {COUNT} critical points found, {COUNT - known} not accounted for"
        return f"{count(len(found), 'locally best dyad')} ({how})", ""
    if isinstance(first, BestDyads):
        faces = sum(
            fit.search.systems
            for fit in search.fits
            if isinstance(fit, BestDyads) and not isinstance(fit.search, CriticalDyads)
        )
        exact = problem.options.method == "exact"
        dyads = count(len(found), "dyad" if exact else "locally best dyad")
        if task.limits:
            searched = f" ({count(faces, 'face')} of these searched)" if faces else ""
            dyads += f" within the limits{searched}"
        return dyads, ""
    return count(len(found), "dyad"), ""


def _none(task: Task, search: DyadSearch, dyads: str) -> Outcome:
    """No linkage at all."""
    wider = "widen a limit, or allow another kind of dyad"
    if task.limits and not search.dyads:
        return Outcome("R306", f"no four-bar: {dyads}", wider)
    message = f"no four-bar: {dyads}, and a four-bar needs two different ones"
    return Outcome("R302", message, wider if task.limits else "change a pose, or drop one")


def _none_usable(
    problem: SynthesisProblem, linkages: Sequence[FoundLinkage], all_of_them: str, aside: str
) -> Outcome:
    """Linkages, and none that works."""
    task, size = problem.given, problem.length
    nearest = by_nearness(linkages, size)[0]
    works = "works within the requirements" if task.requirements.has_any else "works"
    if task.tolerances is not None and all(map(_is_outside, linkages)):
        return _outside_tolerances(problem, linkages, all_of_them + aside)
    if len(linkages) == 1:
        none = f"which does not {works.replace('works', 'work')}"
        why = "it"
    else:
        none = f"none of which {works}"
        why = f"the closest one, {nearest.id},"
    return Outcome(
        "R301",
        f"no usable linkage: {all_of_them}, {none}{aside}",
        hints(linkages, problem),
        f"{why} {in_short(nearest, task, size)}",
    )


def _is_outside(found: FoundLinkage) -> bool:
    share = found.within_tolerance
    inside = share is not None and bool((share <= 1).all())
    return not inside and any(each.kind == "assembly" for each in found.defects)


def _outside_tolerances(
    problem: SynthesisProblem, linkages: Sequence[FoundLinkage], message: str
) -> Outcome:
    """Linkages, and none of them inside the tolerances of all poses."""

    def worst(each: FoundLinkage) -> float:
        return math.inf if each.within_tolerance is None else float(each.within_tolerance.max())

    task, nearest = problem.given, min(linkages, key=worst)
    why = f"the one that exceeds them least, {nearest.id}, is "
    why += "; ".join(each.message for each in nearest.defects if each.kind == "assembly")
    help = "widen that tolerance, free a component that does not count, or leave a pose out"
    works = min(filter(only_too_far, linkages), key=worst, default=None)
    fixed = task.requirements.within is not None or task.requirements.within_deg is not None
    fixed |= task.tolerances is not None and bool(task.tolerances.exact.any())
    if works is not None and math.isfinite(worst(works)) and not fixed:
        times = math.ceil(100 * worst(works)) / 100
        help += f"; with all tolerances {times:g} times as wide {works.id} would be inside"
    return Outcome("R304", f"no linkage stays inside all tolerances: {message}", help, why)


def undetermined(
    problem: SynthesisProblem, search: DyadSearch, linkages: Sequence[FoundLinkage]
) -> Outcome:
    """What came of poses that determine no dyads, and of linkages that pass within their digits."""
    usable = [each for each in linkages if each.usable]
    message = f"{count(len(usable), 'four-bar')} within what the digits of the poses allow, from "
    message += f"{_dyads(problem, search)[0]} and links of low error"
    return _undetermined(problem, usable, message)


def _undetermined(
    problem: SynthesisProblem, usable: Sequence[FoundLinkage], message: str
) -> Outcome:
    """Linkages that work, and pivots that may be elsewhere as well."""
    task = problem.given
    rotation = rotation_range(task.poses.angle)
    only = "only " if rotation < LITTLE else ""
    turns = f"the body turns {only}{figure(math.degrees(rotation))}°"
    return Outcome(
        "R305",
        message,
        "to determine the pivots, add poses with more rotation, or give the poses with more digits",
        f"{usable[0].id} works, and {_pivot_freedom(usable[0], task)}: {turns}",
    )


def _pivot_freedom(found: FoundLinkage, task: Task) -> str:
    """How far its pivots may be moved, all together, within what is known of the poses."""
    assert found.uncertainty is not None
    widest = max(each.half_width for each in found.uncertainty)
    extent = f"the poses span {length_of(span(task), task)}"
    if widest > 100 * max(span(task), characteristic_length(task)):
        return f"its pivots may be moved by far more than the motion's own size ({extent})"
    for dyad, each in zip(found.dyads, found.uncertainty, strict=True):
        for which, frame, pivot in (("fixed", "F", each.fixed), ("moving", "M", each.moving)):
            if pivot is not None and pivot.half_width == widest:
                way = f"along {math.degrees(pivot.direction):.0f}° in {frame}"
                return (
                    f"the {which} pivot of {dyad.id} may be moved by about "
                    f"±{length_of(widest, task)} {way}, the others with it ({extent})"
                )
    return f"its lines may be moved by about ±{length_of(widest, task)} ({extent})"


def sample_advice(problem: SynthesisProblem, found: Sequence[FoundLinkage]) -> Iterator[Advice]:
    """W220: the linkages were looked for on a sample of many poses."""
    sample = sample_refined(problem)
    if sample is None or not found:
        return
    some, of_all = len(sample.index), sample.of_all
    worst = " and those that they miss by most" if problem.options.norm == "worst" else ""
    message = f"linkages were looked for on {some} of the {of_all} poses{worst}, and judged at all"
    each = math.ceil(of_all / MAX_POSES_REFINED)
    yield Advice(
        "W220",
        message,
        f"take one pose in {each}, with --every {each}, and all of them are taken alike",
        "a linkage has nine dimensions, and more poses hardly change them; where nothing "
        "limits the closest ones, their last steps count all poses",
    )


def linkage_advice(task: Task, linkages: Sequence[FoundLinkage], code: str) -> Iterator[Advice]:
    """What a user should know about the linkages that are usable; code: of the outcome."""
    usable = [each for each in linkages if each.usable]
    loose = [each for each in usable if not each.determined]
    # Of special motions the outcome itself says how free the pivots are.
    if loose and code != "R305" and not code.startswith("R31"):
        ids = [each.id for each in loose]
        yield Advice(
            "W209",
            f"the poses leave pivots of {listed(ids)} open; of {ids[0]}, "
            f"{_pivot_freedom(loose[0], task)}",
            "give more digits, or poses with more rotation between them",
        )
    if usable and not task.requirements.transmission_deg:
        best = usable[0]
        least = best.driven.least_over_range
        if math.degrees(least) < TRANSMISSION.standard - SHOWN_ANGLE:
            help = "move a pose, or leave one out"
            if code == "R316":
                help = "let the body turn less: no other pair of the family transmits better"
            other = max(usable, key=lambda each: each.driven.least_over_range)
            reached = other.driven.least_over_range
            if reached > BETTER * least:
                near = nearness(other, task, characteristic_length(task))
                help = f"take {other.id}, which has {least_angle(reached)} or more and {near}"
            if math.degrees(reached) >= USUAL_TRANSMISSION:  # so there is one for sure
                more = TRANSMISSION.given(USUAL_TRANSMISSION)
                help = Help.of("{}; or ask for more with {}", help, more)
            yield Advice(
                "W210",
                f"{best.id} transmits badly: its transmission angle falls to "
                f"{least_angle(least)} between the poses, and "
                f"{USUAL_TRANSMISSION:.0f}° is a usual limit",
                help,
            )


def _accounted(search: CriticalDyads) -> int:
    """How many critical points were found, those at infinity included."""
    return int(search.found + search.at_infinity)
