"""Requirements from Python: types, malformed values, and what limits rule out."""

import itertools
import math
import re

import numpy as np
import pytest

from burmester.errors import InputError
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage import Linkage
from burmester.geometry.regions import Line, Point, Polygon, Segment, box
from burmester.io.reading.specification import combined_requirements
from burmester.io.reading.specification_text import requirements_from_options
from burmester.requirements.types import DRIVERS, GROUPS, TYPES
from burmester.tasks.limits import KINDS, Limits
from burmester.tasks.motion_task import Task
from burmester.tasks.requirements import Requirements
from tests.oracles.stated_requirements import (
    INF,
    NOTHING,
    THREE,
    refused,
    refused_task,
)

# The types ------------------------------------------------------------------------------------


def some_dyad(kind, rng):
    if kind == "RR":
        return RR(rng.normal(size=2), rng.normal(size=2), np.array(rng.uniform(0.2, 3)))
    make = {"PR": PR, "RP": RP}[kind]
    pivot = "moving_pivot" if kind == "PR" else "fixed_pivot"
    line = {"normal_angle": np.array(rng.uniform(0, 6)), "offset": np.array(rng.normal())}
    return make(**{pivot: rng.normal(size=2)}, **line)


def change_point():
    square = [RR(np.array([x, 0.0]), np.array([x, 0.0]), np.array(1.0)) for x in (0.0, 1.0)]
    return Linkage(*square)


@pytest.fixture(scope="module")
def made_of():
    """For every type that linkages turn out to have, the ordered pairs of kinds that make it."""
    rng = np.random.default_rng(3)
    found = {}
    for pair in itertools.product(("RR", "PR", "RP"), repeat=2):
        for _ in range(300 if pair == ("RR", "RR") else 3):
            name = Linkage(*(some_dyad(kind, rng) for kind in pair)).type
            found.setdefault(name, set()).add(pair)
    found[change_point().type] = {("RR", "RR")}
    return found


def test_the_types_are_those_that_linkages_have(made_of):
    assert set(TYPES) == set(made_of)
    for name, pair in TYPES.items():
        assert made_of[name] == {pair, pair[::-1]}


def test_words_stand_for_groups_of_types_by_the_link_lengths():
    rng = np.random.default_rng(4)
    seen = set()
    for _ in range(300):
        linkage = Linkage(some_dyad("RR", rng), some_dyad("RR", rng))
        shortest, p, q, longest = sorted(float(length) for length in linkage.links)
        one = "grashof" if shortest + longest < p + q else "non-grashof"
        for group in GROUPS:
            asked_for = Requirements(types=frozenset({group}))
            assert asked_for.allows(linkage.type) == (group == one)
        seen.add(linkage.type)
    assert len(seen) == 5
    for group in GROUPS:
        assert not Requirements(types=frozenset({group})).allows(change_point().type)
        assert not Requirements(types=frozenset({group})).allows("slider-crank")
    both = Requirements(types=frozenset({"grashof", "slider-crank"}))
    assert both.allows("double-rocker")
    assert both.allows("slider-crank")
    assert not both.allows("triple-rocker")
    assert Requirements().allows("translating linkage")


@pytest.mark.parametrize(
    ("said", "name"),
    [
        ("Crank-Rocker", "crank-rocker"),
        (" crank rocker ", "crank-rocker"),
        ("inverted-slider-crank", "inverted slider-crank"),
        ("DOUBLE-SLIDER", "double slider"),
        ("oldham linkage", "Oldham linkage"),
        ("rapson  slide", "Rapson slide"),
        ("Non-Grashof", "non-grashof"),
    ],
)
def test_names_in_any_case_with_hyphens_or_spaces(said, name):
    assert Requirements(types=frozenset({said})).types == {name}
    assert combined_requirements(requirements_from_options(types=[said])).types == {name}


# From Python ----------------------------------------------------------------------------------


def test_nothing_is_asked_by_default():
    assert not Requirements().has_any
    assert Task(THREE).requirements == Requirements()
    one_each = {
        "transmission_deg": 0.1,
        "types": frozenset({"grashof"}),
        "driver": "crank",
        "footprint": box([0, 0], [1, 1]),
        "link_ratio": 3,
        "within": 0.5,
        "within_deg": 2,
        "any_order": True,
    }
    assert set(one_each) == set(NOTHING)
    for field, value in one_each.items():
        assert Requirements(**{field: value}).has_any, field
        assert Task(THREE, requirements=Requirements(**{field: value})).requirements.has_any


MALFORMED = [  # a field, its value, and what the message holds
    ("transmission_deg", -0.1, "-0.1"),
    ("transmission_deg", 90, "90°"),
    ("transmission_deg", 2291.83, "2291.83°"),
    ("transmission_deg", math.nan, "not a finite number"),
    ("transmission_deg", "40", "'40', not a number"),
    ("transmission_deg", True, "True, not a number"),
    ("types", frozenset(), "no linkage type is left"),
    ("types", "crank-rocker", "not a set of names"),
    ("types", 3, "not a set of names"),
    ("types", frozenset({"crank-roker"}), "no linkage type 'crank-roker'"),
    ("types", frozenset({4}), "no linkage type 4"),
    ("driver", "motor", "no driver 'motor'"),
    ("driver", None, "no driver None"),
    ("footprint", Point([0, 0]), "not a point"),
    ("footprint", Line([0, 0], [1, 0]), "not a line"),
    ("footprint", Segment([0, 0], [1, 0]), "not a segment"),
    ("link_ratio", 0.99, "0.99"),
    ("link_ratio", -INF, "not a finite number"),
    ("link_ratio", math.nan, "not a finite number"),
    ("link_ratio", None, "None, not a number"),
    ("within", 0, "at most 0"),
    ("within_deg", 0, "at most 0°"),
    ("within_deg", -3, "at most -3°"),
    ("within_deg", INF, "not a finite number"),
    ("within", -1.5, "at most -1.5"),
    ("within", INF, "not a finite number"),
    ("within", "1", "'1', not a number"),
    ("any_order", 1, "1, neither true nor false"),
]


@pytest.mark.parametrize("fault", MALFORMED, ids=lambda fault: f"{fault[0]}-{fault[1]}")
def test_malformed_requirements_are_refused(fault):
    field, value, said = fault
    error = refused(lambda: Requirements(**{field: value}), where=False)
    assert said in error.message


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("transmission_deg", 0),
        ("transmission_deg", np.float64(89.99)),
        ("link_ratio", 1),
        ("link_ratio", INF),
        ("within", 1e-12),
        ("any_order", np.True_),
        *(("driver", driver) for driver in DRIVERS),
        *(("types", {name}) for name in (*TYPES, *GROUPS)),
        ("types", ["crank-rocker", "double-crank"]),
    ],
)
def test_what_is_just_sound_is_taken(field, value):
    found = getattr(Requirements(**{field: value}), field)
    assert found == (frozenset(value) if field == "types" else value)


@pytest.mark.parametrize(
    ("said", "meant"),
    [
        ("crank-roker", "crank-rocker"),
        ("oldham", "Oldham linkage"),
        ("slidercrank", "slider-crank"),
        ("grasshof", "grashof"),
        ("drag", None),
    ],
)
def test_a_name_that_is_nearly_one_is_guessed_and_the_guess_works(said, meant):
    error = refused(lambda: Requirements(types=frozenset({said})), where=False)
    guess = re.match(r"did you mean (.*)\? choose among", error.help)
    assert (guess[1] if guess else None) == meant
    for name in error.help.split("choose among ")[1].split(", "):
        assert Requirements(types=frozenset({name})).types == {name}
    assert "did you mean crank?" in refused(lambda: Requirements(driver="krank"), where=False).help


def test_a_crank_and_types_without_one_contradict_each_other():
    without = {"double-rocker", "triple-rocker", "non-grashof", "double slider"}
    for name in (*TYPES, *GROUPS):
        types = frozenset({name})
        if name not in without:
            assert Requirements(types=types, driver="crank").has_any
            continue
        error = refused(lambda: Requirements(types=types, driver="crank"), "E132", where=False)  # noqa: B023
        assert name in error.message
        more = re.search(r"such as ([-\w]+)", error.help)[1]
        assert Requirements(types=types | {more}, driver="crank").driver == "crank"
        assert Requirements(types=types, driver="any").types == types


# Requirements and limits ----------------------------------------------------------------------


def test_types_that_no_dyads_within_the_limits_make_are_refused(made_of):
    """Against every choice of kinds for both dyads, and what linkages of them turn out to be."""
    choices = [frozenset(each) for n in range(1, 5) for each in itertools.combinations(KINDS, n)]
    for one, other in itertools.combinations_with_replacement(choices, 2):
        both = Limits(kinds=one), Limits(kinds=other)
        limits = both[:1] if one == other else both
        pairs = {(a, b) for a in one for b in other}
        for name in TYPES:
            asked_for = Requirements(types=frozenset({name}))
            if made_of[name] & (pairs | {pair[::-1] for pair in pairs}):
                Task(THREE, limits=limits, requirements=asked_for)
                continue
            error = refused_task(limits, asked_for)
            assert name in error.message
            assert all(kind in error.message for kind in one | other)
            if match := re.search(r"require (.*), or let", error.help):
                names = re.split(", | or ", match[1])
                for offered in names if names != ["no type"] else ():
                    Task(THREE, limits=limits, requirements=Requirements(types={offered}))


def test_a_limited_pivot_leaves_some_types_out():
    here = (Limits(fixed_pivot=box([0, 0], [1, 1])),)
    slider = Requirements(types={"slider-crank"})
    error = refused_task(here, slider)
    assert "where a fixed pivot is limited there is no PR" in error.why
    Task(THREE, limits=(*here, Limits()), requirements=slider)
    Task(THREE, limits=here, requirements=Requirements(types={"inverted slider-crank"}))


def test_a_crank_needs_a_dyad_that_turns():
    crank = Requirements(driver="crank")
    rail, slot, link = (Limits(kinds={kind}) for kind in ("PR", "RP", "RR"))
    error = refused_task((rail,), crank)
    assert "kind PR only, and a driver that turns fully" in error.message
    for limits in ((), (slot,), (rail, link), (rail, slot), (Limits(kinds={"PR", "RR"}),)):
        assert Task(THREE, limits=limits, requirements=crank).requirements.driver == "crank"
    sliding = Requirements(types={"double slider", "slider-crank"}, driver="crank")
    error = refused_task((rail, rail), sliding)
    Task(THREE, limits=(rail, link), requirements=sliding)
    both = Limits(kinds={"PR", "RP"})
    mixed = Requirements(types={"double slider", "crank-rocker"}, driver="crank")
    error = refused_task((both,), mixed)
    assert "with a driver that turns fully" in error.message
    assert "Oldham linkage" in error.help
    assert "double slider" not in error.help


@pytest.mark.parametrize("driver", ["first", "second"])
def test_the_first_and_the_second_dyad_are_those_of_two_limits(driver):
    asked_for = Requirements(driver=driver)
    for limits, said in (((), "no limits"), ((Limits(),), "one set of limits for both")):
        error = refused_task(limits, asked_for, "E134")
        assert driver in error.message
        assert said in error.why
    assert Task(THREE, limits=(Limits(), Limits()), requirements=asked_for)


def samples(region, rng):
    """Points (k, 2) of a region, its ends or corners among them."""
    match region:
        case Point():
            return region.at[None]
        case Line() | Segment():
            share = np.linspace(0, 1, 401) if isinstance(region, Segment) else np.linspace(-50, 50)
            return region.start + share[:, None] * (region.end - region.start)
        case Polygon():
            share = rng.dirichlet(np.full(len(region.vertices), 0.3), 400)
            return np.concatenate([region.vertices, share @ region.vertices])


def inside_triangle(points, corners):
    """Whether points (k, 2) lie in a triangle, by barycentric coordinates."""
    a, b, c = corners
    share = np.linalg.solve(np.column_stack([b - a, c - a]), (points - a).T)
    return (share >= 0).all(axis=0) & (share.sum(axis=0) <= 1)


def test_a_fixed_pivot_outside_the_footprint_is_refused_and_no_other():
    """Triangles hold convex hulls of random points, so a sample inside both is a witness."""
    rng = np.random.default_rng(8)
    count = {True: 0, False: 0}
    for _ in range(400):
        footprint = Polygon(rng.normal(size=(3, 2)))
        at = 2 * rng.normal(size=(3, 2))
        region = (Point(at[0]), Line(*at[:2]), Segment(*at[:2]), Polygon(at))[rng.integers(4)]
        limits, area = (Limits(), Limits(fixed_pivot=region)), Requirements(footprint=footprint)
        meets = inside_triangle(samples(region, rng), footprint.vertices).any()
        try:
            Task(THREE, limits=limits, requirements=area)
            accepted = True
        except InputError:
            error = refused_task(limits, area)
            assert error.message.endswith(f"fixed pivot {region}, and all pivots {footprint}")
            accepted = False
        assert accepted or not meets
        if isinstance(region, Point):
            assert accepted == meets
        count[accepted] += 1
    assert min(count.values()) > 50


def test_a_fixed_pivot_on_the_edge_of_the_footprint_is_inside():
    area = Requirements(footprint=box([0.1, 0.1], [0.7, 0.3]))
    for at in ([0.1, 0.2], [0.7, 0.3], [0.1 + 0.2, 0.3], [0.4, 0.1]):
        assert Task(THREE, limits=(Limits(fixed_pivot=Point(at)),), requirements=area)
    for line in (Line([0, 0.3], [9, 0.3]), Line([0.7, 0], [0.7, 1]), Line([0, 0], [0.7, 0.3])):
        assert Task(THREE, limits=(Limits(fixed_pivot=line),), requirements=area)
    for line in (Line([0, 0.31], [9, 0.31]), Line([0.71, 1], [0.71, 0]), Line([0, 1], [1, 0.5])):
        limits = (Limits(fixed_pivot=line),)
        refused_task(limits, area)


def test_rounding_puts_no_pivot_outside_the_footprint():
    rng = np.random.default_rng(6)
    for _ in range(100):
        corners = rng.normal(size=(3, 2))
        at = Point(corners[0] + rng.random() * (corners[1] - corners[0]))
        area = Requirements(footprint=Polygon(corners))
        assert Task(THREE, limits=(Limits(fixed_pivot=at),), requirements=area)


@pytest.mark.parametrize("way", [(1, 0), (-1, 0), (0, 1), (0, -1)])
def test_regions_beside_the_footprint_are_outside(way):
    area = Requirements(footprint=Polygon([[0, 0], [2, 0.5], [1, 2]]))
    for moved, outside in ((2.1, True), (1.9, False)):
        shift = moved * np.array(way)
        corners = np.array([[0, 0], [2, 0], [2, 2], [0, 2]]) + shift
        for region in (Polygon(corners), Segment(corners[0], corners[2])):
            limits = (Limits(fixed_pivot=region),)
            if outside:
                refused_task(limits, area)
            else:
                assert Task(THREE, limits=limits, requirements=area).limits == limits
