"""Dimensions and notes in words, of usable and unusable linkages alike, against their numbers."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from burmester.describe.dimensions import dimensions
from burmester.describe.sentences import notes
from burmester.fourbar.dyad import PR, RP, RR
from burmester.io.reading.poses import read_task
from burmester.synthesis.motion_generation import synthesize
from burmester.tasks.options import SynthesisOptions
from burmester.verdicts.uncertainty import DyadUncertainty, LineRegion, PivotRegion

NUMBER = re.compile(r"-?\d+(?:\.(\d+))?")
FIGURE = 0.051  # relative error of a figure of two digits, at most
CASES = ["ge2012-approximate", "motiongen-rrpr"]  # both have usable and unusable linkages


@pytest.fixture(scope="module", params=CASES)
def synthesis(request):
    options = SynthesisOptions(manufacturing_tolerance=0.002)
    found = synthesize(read_task(f"case:{request.param}"), options)
    assert {each.usable for each in found.linkages} == {True, False}
    return found


def numbers_of(dyad, places):
    """All dimensions of a dyad, in the order in which people read them; places: x + iy and turn."""
    if isinstance(dyad, RR):
        return [*dyad.fixed_pivot, *dyad.moving_pivot, dyad.radius]
    d, turn = places.translation @ [1, 1j], np.exp(1j * places.angle)
    if isinstance(dyad, PR):
        pivot, point = dyad.moving_pivot, d + turn * complex(*dyad.moving_pivot)
    else:
        pivot, point = dyad.fixed_pivot, (complex(*dyad.fixed_pivot) - d) / turn
    normal = np.exp(1j * float(dyad.normal_angle))
    ahead = 1j * normal if (1j * normal).real > 0 else -1j * normal
    along = (point * np.conj(ahead)).real
    along = along[np.isfinite(along)]
    middle = dyad.offset * normal + (along.min() + along.max()) / 2 * ahead
    return [*pivot, middle.real, middle.imag, math.degrees(np.angle(ahead))]


def test_every_dimension_is_its_number_rounded(synthesis):
    kinds = set()
    for found in synthesis.linkages:
        rows = dimensions(synthesis, found)
        assert {row.dyad for row in rows} == {dyad.id for dyad in found.dyads}
        for dyad in found.dyads:
            kinds.add(type(dyad.dyad))
            shown = [m for row in rows if row.dyad == dyad.id for m in NUMBER.finditer(row.value)]
            for match, value in zip(shown, numbers_of(dyad.dyad, found.error.places), strict=True):
                last = 10.0 ** -len(match[1] or "")
                assert abs(float(match[0]) - float(value)) <= 0.5001 * last, (found.id, match[0])
    assert kinds == {RR, PR, RP}


def test_half_widths_are_those_of_the_regions(synthesis):
    for found in synthesis.linkages:
        given = {(row.dyad, row.what): row.give for row in dimensions(synthesis, found)}
        for dyad, region in zip(found.dyads, found.uncertainty, strict=True):
            for what, pivot in (("fixed pivot", region.fixed), ("moving pivot", region.moving)):
                if pivot is None:
                    assert (dyad.id, what) not in given
                    continue
                text, width = given[dyad.id, what], pivot.half_width
                if not pivot.determined:
                    assert text.startswith("not determined")
                    continue
                if not math.isfinite(width):
                    assert text == "-"
                    continue
                match = NUMBER.search(text)
                last = 10.0 ** -len(match[1] or "")
                if text.startswith("± under "):
                    assert width < float(match[0])
                else:
                    assert float(match[0]) == pytest.approx(width, abs=0.5001 * last), found.id


def test_what_is_not_determined_has_no_half_width(synthesis):
    """Regions of made-up sizes: words where first order is not trusted, and the direction."""
    wide, narrow = PivotRegion(0.5, 0.3, 0.6, 0.1), PivotRegion(0.5, 1e-3, 0.6, 0.1)
    small = PivotRegion(0.05, 1e-3, 0.6, 0.1)
    for found in synthesis.linkages:
        for fixed, moving, words in (
            (wide, narrow, ["not determined", "not determined along 34°"]),
            (small, wide, ["± ", "not determined"]),
        ):
            for length, offset, angle in ((0.5, 0.05, 0.2), (0.05, 0.5, 0.02)):
                line = LineRegion(angle, offset, 0.1)
                region = DyadUncertainty(fixed, moving, line, length, 0.1)
                made = replace(found, uncertainty=(region, region))
                rows = dimensions(synthesis, made)
                for row in rows:
                    open_length = length > 0.1 if row.what == "length" else offset > 0.1
                    match row.what:
                        case "fixed pivot":
                            assert row.give.startswith(words[0])
                        case "moving pivot":
                            assert row.give == words[1]
                        case "length" | "line in F, through" | "line in M, through":
                            assert (row.give == "not determined") == open_length
                        case _:
                            assert (row.give == "not determined") == (angle > 0.05)
                    assert ("±" in row.give) == ("determined" not in row.give)
                assert any("Not determined: " in note for note in notes(synthesis, made))
    sure = DyadUncertainty(small, small, LineRegion(0.01, 0.01, 0.1), 0.01, 0.1)
    made = replace(synthesis.linkages[0], uncertainty=(sure, sure))
    assert not any("Not determined: " in note for note in notes(synthesis, made))


def test_unusable_linkages_have_notes_of_their_own(synthesis):
    for found in synthesis.linkages:
        every = notes(synthesis, found)
        uncertainty, built = (text for text in every if text.startswith(("±", "Built to")))
        assert uncertainty.startswith("±: 95 % regions")
        pattern = (
            r"Built to ±0\.002: of 1000 linkages built at random, (?:\S+ % of them cannot be "
            r"assembled, )?position errors of up to (\S+) \(95 % of (?:linkages|the others)\), "
            r"(\S+) for the worst one found\."
            if found.spread.monte_carlo
            else r"Built to ±0\.002: position errors of up to (\S+) \(95 % of linkages\), "
            r"at most (\S+), to first order\."
        )
        unit = synthesis.task.length_unit
        errors = re.fullmatch(pattern, built.replace(f" {unit}", "") if unit else built)
        expected = [float(found.spread.greatest_95), float(found.spread.bound)]
        assert [float(each) for each in errors.groups()] == pytest.approx(expected, rel=FIGURE)


def test_rounded_dimensions_have_no_half_widths():
    task = read_task("case:motiongen-rrpr")
    synthesis = synthesize(task, SynthesisOptions(rounding_step=0.1))
    rounded = [each for each in synthesis.linkages if each.error_before_rounding is not None]
    assert {each.usable for each in rounded} == {True, False}
    for found in rounded:
        assert {row.give for row in dimensions(synthesis, found)} == {""}
        (note,) = (each for each in notes(synthesis, found) if not each.startswith("It works, but"))
        errors = re.fullmatch(
            rf"Rounded to 0\.1: {found.id} misses by ([^ ]+), instead of by ([^ ]+)\.",
            note.replace(f" {task.length_unit}", ""),
        )
        expected = [found.error.worst, found.error_before_rounding.worst]
        assert [float(each) for each in errors.groups()] == pytest.approx(expected, rel=FIGURE)
