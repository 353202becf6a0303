"""A synthesis in words: sentences and notes as plain strings, for any screen."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Final

from burmester.describe import quality_words, six_bar_words
from burmester.describe.decimals import decimals_of_dyad
from burmester.describe.dimensions import certain, decimals_of, degrees, sides_of, worst_errors
from burmester.numerics.arrays import ROUNDING
from burmester.synthesis.result import JUDGED, Synthesis
from burmester.tasks import notation
from burmester.verdicts import explanation
from burmester.verdicts.built_linkages import DRAWS
from burmester.verdicts.explanation import most_used
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.verdicts.limit_check import clearance_in_words
from burmester.verdicts.quality import enough_transmission, rule
from burmester.verdicts.ranking import (
    TRADE_GAIN,
    closest_usable,
    digits_leave_open,
    is_trade,
    states_tolerance,
)
from burmester.verdicts.tracing import Tracing, price_list
from burmester.verdicts.uncertainty import pose_sigma
from burmester.wording import figure, in_unit, least_angle, listed, spans, with_article

NOT_DETERMINED = (
    "Not determined: first order need not hold so far, with regions over 5 % of the motion's size "
    "or of the link, or 2.9°."
)


EXACT_TURN = 1e-9  # radians; a crank that is off by less is at its angle
MAX_NAMED_TYPES = 3  # other types that a sentence names; there are four


def best_sentences(synthesis: Synthesis) -> list[str]:
    """What the best usable linkage does, and why it is not another one; none without it.

    Of a six-bar that was given what it is, whether it works or not.
    """
    if synthesis.six_bars is not None:
        return [f"{six_bar_words.headline(each)}." for each in synthesis.six_bars.found[:1]]
    if not synthesis.usable:
        return []
    return [headline(synthesis), *alternatives(synthesis)]


def headline(synthesis: Synthesis) -> str:
    """The best usable linkage in one sentence: what it is, and how well it does."""
    best = synthesis.usable[0]
    kind = best.type.replace("change-point", "change-point linkage")
    doubt = type_doubt(synthesis, best)
    kind = with_article(kind) + (f" ({doubt})" if doubt else "")
    least = least_angle(best.driven.least_over_range)
    return (
        f"{best.id}, {kind} driven by {best.dyads_driver_first[0].id}, "
        f"{_passes(synthesis, best)}, transmission angle {least} or more."
    )


def alternatives(synthesis: Synthesis) -> Iterator[str]:
    """Why the best usable linkage is not another one, and what others would cost."""
    best, task, size = synthesis.usable[0], synthesis.task, synthesis.length
    outcome = synthesis.outcome
    for text in (outcome.why, outcome.help) if outcome.code == "R305" else ():
        assert text is not None
        yield f"{text[0].upper()}{text[1:]}."
    nearest = explanation.by_nearness(synthesis.linkages, size)[0]
    if not nearest.usable and _nearer(nearest, best, size):
        yield (
            f"This one works and {explanation.nearness(best, task, size)}; "
            f"the closest one, {nearest.id}, "
            f"{explanation.in_short(nearest, task, size)}."
        )
    if synthesis.family is not None:
        yield from _members(synthesis, best)
        return
    yield from _prices_of_path(synthesis) if task.path is not None else _prices(synthesis, best)
    if not best.determined:
        better = next((each for each in synthesis.usable if each.determined), None)
        if better is not None:
            yield (
                f"The poses leave its pivots open; those of {better.id} they do not, and it "
                f"{explanation.nearness(better, task, size)}."
            )


def _members(synthesis: Synthesis, best: FoundLinkage) -> Iterator[str]:
    """The smallest and the least sensitive linkage of a family, where it is not the best one."""
    pinned = best.linkage.links is not None
    alike = [each for each in synthesis.usable if (each.linkage.links is not None) == pinned]
    rated = [(each, each.quality) for each in alike if each.quality is not None]
    if not rated:
        return
    smallest = min(rated, key=lambda each: float(each[1].extent))
    surest = min(rated, key=lambda each: float(each[1].sensitivity))
    told = {"Smallest": smallest, "Least sensitive to errors": surest}
    if smallest[0] is surest[0]:
        told = {"Smallest and least sensitive to errors": smallest}
    for text, (each, quality) in told.items():
        if each is not best:
            yield (
                f"{text}: {each.id}, {spans(float(quality.extent))} of the motion, errors "
                f"up to {figure(float(quality.sensitivity))} times as large at a pose, "
                f"transmission angle {least_angle(float(quality.transmission))} or more."
            )


def _passes(synthesis: Synthesis, best: FoundLinkage) -> str:
    asked = explanation.asked_for(synthesis.task)
    if synthesis.task.gives_room:
        return f"stays inside the tolerance of every {asked}"
    if explanation.meets_exactly(best, synthesis.length):
        return f"passes every {asked} exactly, up to rounding"
    return f"passes every {asked} within {explanation.worst_miss(best, synthesis.task)}"


def _nearer(one: FoundLinkage, other: FoundLinkage, size: float) -> bool:
    return one.combined_error < other.combined_error - ROUNDING * size


def _prices_of_path(synthesis: Synthesis) -> Iterator[str]:
    """What each linkage of the price list costs and gives, where there is a choice."""
    task, size = synthesis.task, synthesis.length
    prices = price_list(synthesis.linkages, task)
    if len(prices) < 2:
        return
    yield "What better motion costs, from the nearest on:"
    for each in prices:
        text = f"{each.found.id} {explanation.nearness(each.found, task, size)}"
        if each.times is not None and each is not prices[0]:
            text += f", {figure(each.times)} times as far"
        least = least_angle(math.radians(each.transmission_deg))
        longest = f"longest link {figure(each.link_ratio)} times the shortest"
        yield f"{text}: transmission angle {least} or more, {longest}."


def _prices(synthesis: Synthesis, best: FoundLinkage) -> Iterator[str]:
    """What the closest usable linkage, and others that trade one error for the other, cost."""
    task, size = synthesis.task, synthesis.length
    closest = closest_usable(synthesis.linkages)
    assert closest is not None
    stated, sounder = states_tolerance(task), closest.shortcomings and not best.shortcomings
    told: set[str | None] = set()
    if (stated or sounder) and _nearer(closest, best, size):
        near = explanation.nearness(closest, task, size)
        least = least_angle(closest.driven.least_over_range)
        what = f"transmission angle {least} or more"
        if closest.shortcomings:
            what = f"but {' and '.join(closest.shortcomings)}"
        yield f"Closest that works: {closest.id}, which {near}, {what}."
        told.add(closest.id)
    if stated or best.combined_error <= digits_leave_open(synthesis.problem):
        return
    others = [each for each in synthesis.usable if is_trade(each, best)]
    for text, error in (
        ("nearer in position", lambda each: each.error.worst),
        ("truer in angle", lambda each: float(each.error.angle.max())),
    ):
        gains = [each for each in others if error(each) <= TRADE_GAIN * error(best)]
        if gains:
            other = min(gains, key=lambda each: each.combined_error)
            if other.id in told:
                continue
            told.add(other.id)
            short = f", but {' and '.join(other.shortcomings)}" if other.shortcomings else ""
            near = explanation.nearness(other, task, size)
            yield f"{text[0].upper()}{text[1:]}: {other.id}, which {near}{short}."


def type_doubt(synthesis: Synthesis, found: FoundLinkage) -> str | None:
    """The other types that the poses leave possible: "could be a crank-rocker within ±"."""
    if not found.other_types:
        return None
    within = "rounding" if certain(synthesis, found) else "±"
    if len(found.other_types) > MAX_NAMED_TYPES:
        return f"could be of any type within {within}"
    others = listed([with_article(each) for each in found.other_types], "or")
    return f"could be {others} within {within}"


def type_note(synthesis: Synthesis, found: FoundLinkage) -> str | None:
    """How certain Grashof's type is, where it is not."""
    doubt = type_doubt(synthesis, found)
    return None if doubt is None else f"{found.id} is {with_article(found.type)}, and {doubt}."


def standard_note(synthesis: Synthesis, found: FoundLinkage) -> str | None:
    """Why nobody would build it as it is, though it works."""
    if not (found.usable and found.shortcomings):
        return None
    return f"It works, but {' and '.join(found.shortcomings)}."


def digits_note(synthesis: Synthesis, found: FoundLinkage) -> str | None:
    """What the printed dimensions miss by, where "exact" is said of the linkage."""
    if "exact" not in worst_errors(synthesis, found):
        return None
    position, angle = decimals_of(synthesis, found).error
    if not math.isfinite(position):
        return None
    away = notation.length_of(position, synthesis.task)
    turned = "" if synthesis.task.angles_are_free else f" and {degrees(angle)}"
    return f"Built from the digits above, {found.id} misses by {away}{turned} at most."


def clearance_note(synthesis: Synthesis, found: FoundLinkage) -> str | None:
    """How far it stays from its surroundings, and where it comes nearest."""
    if found.clearance is None or found.clearance.touches:
        return None
    return f"Clearance: {clearance_in_words(found.clearance, synthesis.problem)}."


def tracing_note(synthesis: Synthesis, found: FoundLinkage) -> str | None:
    """How near points and curve are to each other, both ways, where points are traced."""
    traced = Tracing.of(found, synthesis.task)
    if traced is None:
        return None
    rms, most, path_rms, path_most = (
        notation.length_of(each, synthesis.task) for each in (*traced.to_curve, *traced.to_path)
    )
    points = f"misses the points by {rms} rms and {most} at most"
    if explanation.meets_exactly(found, synthesis.length):
        points = "passes the points exactly"
    return (
        f"The curve of {found.id} {points}; between them it leaves the path by {path_rms} rms and "
        f"{path_most} at most."
    )


def timing_note(synthesis: Synthesis, found: FoundLinkage) -> str | None:
    """How near the driver is to the angles at which the crank times the poses."""
    if found.timing_error is None:
        return None
    away = [abs(each) for each in found.timing_error.tolist()]
    most = max((each for each in away if math.isfinite(each)), default=0.0)
    if most <= EXACT_TURN:
        return f"The crank of {found.id} is at its stated angles."
    at = notation.poses_in_words(synthesis.task, [away.index(most)])
    return f"The crank of {found.id} misses its stated angles by up to {degrees(most)}, at {at}."


def dyads_title(synthesis: Synthesis) -> str:
    """The title of the table of dyads, which may have other numbers than the linkages have."""
    fitted = {each.id: each.dyad for each in synthesis.dyads}
    for dyad in (each for found in synthesis.linkages for each in found.dyads):
        if dyad.id not in fitted:
            continue
        own = fitted[dyad.id]
        decimals = decimals_of_dyad(own, synthesis.task.poses, synthesis.length or 1.0)
        if sides_of(own, decimals) != sides_of(dyad.dyad, decimals):
            return "Dyads as fitted, before the linkages are refined"
    return "Dyads"


def uncertainty_note(synthesis: Synthesis, found: FoundLinkage) -> str | None:
    """What the half-widths of the dimensions are."""
    if certain(synthesis, found) or found.uncertainty is None:
        return None
    task = synthesis.task
    position, angle = pose_sigma(task)
    sure = all(each.determined for each in found.uncertainty)
    given, turned = notation.length_of(position, task), degrees(angle)
    if not task.resolution[0]:
        err = f"the angles of the poses err by {turned} and their positions are exact"
    elif not task.resolution[1]:
        err = f"the positions of the poses err by {given} and their angles are exact"
    else:
        err = f"the poses err by {given} and {turned}"
    return (
        f"±: 95 % regions, of a pivot in its worst direction, if {err} "
        "(standard deviations: from their digits, or --pose-sigma)."
        + ("" if sure else f" {NOT_DETERMINED}")
    )


def pose_tolerance_note(synthesis: Synthesis, found: FoundLinkage) -> str | None:
    """How much of the poses' tolerances a linkage uses that stays inside them."""
    if found.within_tolerance is None or not (found.usable and synthesis.task.gives_room):
        return None
    whose = "points'" if synthesis.task.angles_are_free else "poses'"
    return f"Of the {whose} tolerances {found.id} uses {most_used(found, synthesis.task)}."


def tolerance_note(synthesis: Synthesis, found: FoundLinkage) -> str | None:
    """What a tolerance of the dimensions does to the error."""
    if found.spread is None:
        return None
    assert synthesis.options.manufacturing_tolerance is not None
    task, spread = synthesis.task, found.spread
    built = f"Built to ±{notation.length_of(synthesis.options.manufacturing_tolerance, task)}"
    most, worst = (
        notation.length_of(float(each), task) for each in (spread.greatest_95, spread.bound)
    )
    if not spread.monte_carlo:
        return (
            f"{built}: position errors of up to {most} (95 % of linkages), at most {worst}, "
            "to first order."
        )
    if not math.isfinite(spread.greatest_95):
        return f"{built}: none of {DRAWS} linkages built at random can be assembled."
    who, lost = "95 % of linkages", ""
    if spread.lost > 0:
        who = "95 % of the others"
        lost = f"{figure(100 * float(spread.lost))} % of them cannot be assembled, "
    return (
        f"{built}: of {DRAWS} linkages built at random, {lost}"
        f"position errors of up to {most} ({who}), {worst} for the worst one found."
    )


def rounding_note(synthesis: Synthesis, found: FoundLinkage) -> str | None:
    """What rounding does to the error."""
    if found.error_before_rounding is None:
        return None
    task, options = synthesis.task, synthesis.options
    how = []
    if options.rounding_step is not None:
        how.append(f"rounded to {notation.length_of(options.rounding_step, task)}")
    if options.stock_lengths:
        how.append("with links from stock")
    text = " and ".join(how) or "rounded"
    before, after = (
        "by nothing but rounding errors"
        if each.worst < ROUNDING * synthesis.length
        else f"by {notation.length_of(each.worst, task)}"
        for each in (found.error_before_rounding, found.error)
    )
    return f"{text[0].upper()}{text[1:]}: {found.id} misses {after}, instead of {before}."


# What stands under the dimensions: of soundness, digits, uncertainty and how it is made.
NOTES: Final = (
    standard_note,
    digits_note,
    uncertainty_note,
    type_note,
    clearance_note,
    pose_tolerance_note,
    tolerance_note,
    tracing_note,
    timing_note,
    rounding_note,
)


def notes(synthesis: Synthesis, found: FoundLinkage) -> list[str]:
    """What stands under the dimensions of a linkage."""
    return [text for note in NOTES if (text := note(synthesis, found)) is not None]


def footnotes(synthesis: Synthesis) -> str:
    """What the columns of the tables are, and the order of their rows."""
    task = synthesis.task
    unit = in_unit(task.length_unit or "the unit of the poses")
    text = f"Lengths{unit}; F is the ground, M the body."
    if synthesis.linkages:
        counts = notation.length_of(math.radians(synthesis.length_per_radian), task)
        counted = "" if task.angles_are_free else f" 1° counts as {counts}."
        if synthesis.outcome.code not in JUDGED:
            order = "the ones with good transmission and proportions, then the nearest"
            if states_tolerance(task):
                enough = enough_transmission(task.requirements.transmission)
                order = f"the ones with sane proportions; recommended is {rule(enough)}"
            text += f" Usable linkages come first, of these {order}{';' if counted else '.'}"
        text += counted
    if not any(task.resolution):
        text += " The poses are taken as exact; --pose-sigma says otherwise."
    if any(dyad.id[0] == "M" for found in synthesis.linkages for dyad in found.dyads):
        text += " Dyads M come from the pivot map."
    if len(synthesis.usable) > 1 and synthesis.outcome.code not in JUDGED:
        text += (
            " The first of two dyads drives; worst and angle: the greatest misses at a pose; "
            f"transm.: the least transmission angle between the poses; {quality_words.COLUMNS}."
        )
    if task.surroundings is not None and len(synthesis.usable) > 1:
        text += " clear: the least clearance from the surroundings between the poses."
    if any(found.other_types for found in synthesis.usable):
        text += " A type with ± could be another within the uncertainty of the links; see --json."
    return text
