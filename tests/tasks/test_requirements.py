"""What is asked of the whole linkage: from Python, from files, from the command line."""

import itertools
import json
import math
import re
import tomllib
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from burmester import cli
from burmester.errors import InputError
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Line, Point, Polygon, Segment, box
from burmester.io.reading.limits_text import limits_from_options
from burmester.io.reading.poses import read_task
from burmester.io.reading.requirements_text import requirements_from_options
from burmester.io.reading.stated_requirements import combined_requirements, requirements_data
from burmester.tasks.limits import KINDS, Limits
from burmester.tasks.motion_task import Task
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.requirements import DRIVERS, GROUPS, TYPES, Requirements
from tests.oracles.marked import carets, marked

POSES = 'angle_unit = "deg"\nposes = [[0, 0, 0], [1, 2.5, 30], [3, 1, 60.25]]\n'
CSV = "x,y,angle_deg\n0,0,0\n1,2.5,30\n3,1,60.25\n"
THREE = Displacement(np.array([[0.0, 0], [1, 2.5], [3, 1]]), np.array([0, 0.5, 1]))
INF = float("inf")


def refused(attempt, code="E134", where=True):
    with pytest.raises(InputError) as caught:
        attempt()
    error = caught.value
    assert error.code == code, str(error)
    assert error.help
    assert bool(error.where) == where
    return error


def refused_task(limits, asked_for, code="E132"):
    return refused(lambda: Task(THREE, limits=limits, requirements=asked_for), code, where=False)


def values(found):
    """Requirements as plain data, so that two of them can be compared."""
    area = found.footprint
    return {
        "transmission": found.transmission,
        "types": found.types,
        "driver": found.driver,
        "footprint": None if area is None else area.vertices.tolist(),
        "link_ratio": found.link_ratio,
        "within": found.within,
        "any_order": found.any_order,
    }


NOTHING = values(Requirements())


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
        "transmission": 0.1,
        "types": frozenset({"grashof"}),
        "driver": "crank",
        "footprint": box([0, 0], [1, 1]),
        "link_ratio": 3,
        "within": 0.5,
        "any_order": True,
    }
    assert set(one_each) == set(NOTHING)
    for field, value in one_each.items():
        assert Requirements(**{field: value}).has_any, field
        assert Task(THREE, requirements=Requirements(**{field: value})).requirements.has_any


MALFORMED = [  # a field, its value, and what the message holds
    ("transmission", -0.1, "-5.7"),
    ("transmission", math.pi / 2, "90°"),
    ("transmission", 40, "2291.83°"),
    ("transmission", math.nan, "not a finite number"),
    ("transmission", "40", "'40', not a number"),
    ("transmission", True, "True, not a number"),
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
        ("transmission", 0),
        ("transmission", np.float64(1.57)),
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


# In files -------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def read(tmp_path_factory):
    """Read text as if it were the file `poses.SUFFIX`."""
    folder = tmp_path_factory.mktemp("requirements")

    def read(content, suffix=".toml", **options):
        path = folder / f"poses{suffix}"
        path.write_text(content)
        return read_task(path, **options)

    return read


SQUARE = [[0, 0], [4, 0], [4, 2.5], [0, 2.5]]
SAID = {  # TOML, options, a field and its value
    "transmission": (
        "transmission_deg = 37.5",
        ["--min-transmission", "37.5"],
        "transmission",
        math.radians(37.5),
    ),
    "no transmission": ("transmission_deg = 0", ["--min-transmission", "0"], "transmission", 0),
    "types": (
        'types = ["crank-rocker", "Double Slider"]',
        ["--type", "crank-rocker, Double Slider"],
        "types",
        {"crank-rocker", "double slider"},
    ),
    "types, apart": (
        'types = ["grashof", "slider-crank"]',
        ["--type", "slider-crank", "--type", "grashof"],
        "types",
        {"grashof", "slider-crank"},
    ),
    **{
        name: (f'driver = "{name}"', ["--driver", name], "driver", name)
        for name in ("any", "crank")
    },
    "box": (
        "footprint = { box = [[0, 0], [4, 2.5]] }",
        ["--footprint", "box:0,0:4,2.5"],
        "footprint",
        SQUARE,
    ),
    "polygon": (
        "footprint.polygon = [[0, 0], [-1, 0.5], [-1e1, -2]]",
        ["--footprint", "polygon:0,0:-1,0.5:-1e1,-2"],
        "footprint",
        [[0, 0], [-1, 0.5], [-10, -2]],
    ),
    "no footprint": ("", ["--footprint", "any"], "footprint", None),
    "ratio": ("link_ratio = 4.25", ["--link-ratio", "4.25"], "link_ratio", 4.25),
    "within": ("within = 3e-3", ["--within", "3e-3"], "within", 0.003),
    "any order": ("any_order = true", ["--any-order"], "any_order", True),
    "in order": ("any_order = false", [], "any_order", False),
}


@pytest.mark.parametrize("name", SAID)
def test_every_key_reaches_the_task(read, name):
    text, _, field, value = SAID[name]
    content = f"{POSES}[requirements]\n{text}\n"
    for source, suffix in ((content, ".toml"), (json.dumps(tomllib.loads(content)), ".json")):
        task = read(source, suffix)
        assert values(task.requirements) == NOTHING | {field: value}
        assert task.limits == ()
    document = {"task": tomllib.loads(content)}
    assert values(read(json.dumps(document), ".json").requirements)[field] == value


@pytest.mark.parametrize("driver", ["first", "second"])
def test_a_driver_by_its_limits(read, driver):
    text = f'{POSES}[requirements]\ndriver = "{driver}"\n[[limits]]\nkinds = ["RR"]\n'
    assert read(f"{text}[[limits]]\n").requirements.driver == driver
    error = refused(lambda: read(text))
    first, second = error.where.split(", and ")
    assert first.endswith("poses.toml:6:1"), "the kinds"
    assert second.endswith("poses.toml:4:1"), "the driver"


def test_without_the_table_nothing_is_asked(read):
    for content in (POSES, f"{POSES}[requirements]\n"):
        assert read(content).requirements == Requirements()
    document = tomllib.loads(POSES) | {"requirements": {"within": None, "types": None}}
    assert read(json.dumps(document), ".json").requirements == Requirements()
    document["requirements"] = None
    assert read(json.dumps(document), ".json").requirements == Requirements()
    assert read(CSV, ".csv").requirements == Requirements()


FAULTS = [  # TOML below [requirements], code, the path that is named, what the message holds
    ("transmission_deg = «inf»", "E103", ".transmission_deg", "finite"),
    ('transmission_deg = «"40"»', "E104", ".transmission_deg", "'40', not a number"),
    ("transmission_deg = «90»", "E134", ".transmission_deg", "90°"),
    ("transmission_deg = «-1e-3»", "E134", ".transmission_deg", "-0.001°"),
    ("«transmission» = 1", "E107", ".transmission", "not known"),
    ('types = «"grashof"»', "E104", ".types", "'grashof'"),
    ("types = [«3»]", "E104", ".types[0]", "3, not a name of a type in quotes"),
    ("types = «[]»", "E134", ".types", "no linkage type is left"),
    ('types = ["grashof", «"crank"»]', "E134", ".types[1]", "no linkage type 'crank'"),
    ("driver = «1»", "E104", ".driver", "1, not one of its names in quotes"),
    ('driver = «"motor"»', "E134", ".driver", "no driver 'motor'"),
    ("footprint = «[[0, 0], [1, 1]]»", "E104", ".footprint", "does not fit"),
    ("footprint = «{}»", "E105", ".footprint", "no shape"),
    ("footprint.box = «[[0, 0]]»", "E106", ".footprint.box", "1 of 2"),
    ("footprint.polygon = «[[0, 0], [1, 2]]»", "E106", ".footprint.polygon", "2 of 3"),
    ("footprint.polygon = [[0, 0], [1, 2], «[3]»]", "E106", ".footprint.polygon[2]", "1 of 2"),
    ("footprint.«line» = [[0, 0], [1, 1]]", "E107", ".footprint.line", "not known"),
    (
        "footprint = «{ box = [[0, 0], [1, 1]], polygon = [[0, 0], [1, 0], [0, 1]] }»",
        "E108",
        ".footprint",
        "box and polygon",
    ),
    ("footprint.polygon = «[[0, 0], [1, 1], [2, 2]]»", "E131", ".footprint.polygon", "no inside"),
    ("footprint.box = «[[0, 5], [1, 4]]»", "E132", ".footprint.box", "y from 5 to 4"),
    ("link_ratio = «0.5»", "E134", ".link_ratio", "0.5"),
    ("link_ratio = «true»", "E104", ".link_ratio", "true, not a number"),
    ("within = «0»", "E134", ".within", "at most 0"),
    ('any_order = «"yes"»', "E104", ".any_order", "'yes', neither true nor false"),
    ("any_order = «1»", "E104", ".any_order", "1, neither true nor false"),
    ("«kinds» = ['RR']", "E107", ".kinds", "not known"),
    ("«poses» = []", "E107", ".poses", "not known"),
    ("«grashof» = true", "E107", ".grashof", "not known"),
]


@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: fault[0])
def test_what_is_no_requirement_is_refused_with_its_path_and_place(read, fault):
    text, code, path, holds = fault
    text, *place = marked(f"{POSES}[requirements]\n{text}\n")
    error = refused(lambda: read(text), code)
    assert error.message.startswith(f"requirements{path}")
    assert holds in error.message
    name, *found = carets(error.where)
    assert name.endswith("poses.toml")
    assert found == place


def test_requirements_are_one_table(read):
    for text, column in (("requirements = 5\n", 16), ("[[requirements]]\nwithin = 1\n", 3)):
        error = refused(lambda: read(POSES + text), "E104")  # noqa: B023
        assert error.message.startswith("requirements does not fit")
        assert carets(error.where)[1:3] == (3, column)
        for key in ("transmission_deg", "types", "driver", "footprint", "any_order"):
            assert key in error.help


def test_help_says_where_a_key_belongs(read):
    error = refused(lambda: read(f"{POSES}[limits]\ndriver = 'crank'\n"), "E107")
    assert error.help.startswith("write driver under requirements")
    error = refused(lambda: read(f"{POSES}[requirements]\nkinds = ['RR']\n"), "E107")
    assert error.help.startswith("write kinds under limits")
    error = refused(lambda: read(f"[requirements]\nwithin = 1\n{POSES}"), "E107")
    assert error.help.startswith("write poses above the head of requirements") or (
        error.help.startswith("write angle_unit above the head of requirements")
    )
    for key, value in (("within", 1), ("types", ["grashof"]), ("requirement", {"within": 1})):
        document = tomllib.loads(POSES) | {key: value}
        error = refused(lambda: read(json.dumps(document), ".json"), "E107")  # noqa: B023
        assert error.message.startswith(f"{key} stands beside")
        column = json.dumps(document).index(f'"{key}"') + 1
        assert carets(error.where)[1:] == (1, column, len(key) + 2)
        assert "has no effect" in error.message
        document = tomllib.loads(POSES)
        document["requirements"] = value if key == "requirement" else {key: value}
        assert read(json.dumps(document), ".json").requirements.has_any


def test_contradictions_in_a_file_say_where(read):
    text = '[requirements]\nwithin = 1\ndriver = "crank"\ntypes = ["triple-rocker"]\n'
    error = refused(lambda: read(POSES + text), "E132")
    name = error.where.split(":")[0]
    assert error.where == f"{name}:6:1, and {name}:5:1"
    text = '[requirements]\nwithin = 1\ntypes = ["grashof"]\n[limits]\nkinds = ["PR"]\n'
    error = refused(lambda: read(POSES + text), "E132")
    assert error.where == f"{name}:7:1, and {name}:5:1"


def test_what_is_written_for_a_file_is_read_again(read):
    rng = np.random.default_rng(5)
    for _ in range(100):
        given = Requirements(
            transmission=rng.choice([0.0, rng.uniform(0, 1.5)]),
            types=None if rng.random() < 0.3 else rng.choice([*TYPES, *GROUPS], 3).tolist(),
            driver=str(rng.choice(["any", "first", "second", "crank"])),
            footprint=None if rng.random() < 0.3 else Polygon(rng.normal(size=(3, 2))),
            link_ratio=rng.choice([INF, rng.uniform(1, 20)]),
            within=None if rng.random() < 0.3 else rng.uniform(1e-9, 1e3),
            any_order=bool(rng.integers(2)),
        )
        document = tomllib.loads(POSES) | {"limits": [{"length": {"least": 0.1}}, {}]}
        document["requirements"] = requirements_data(given)
        found = values(read(json.dumps(document), ".json").requirements)
        expected = values(given)
        assert found.pop("transmission") == pytest.approx(expected.pop("transmission"), rel=1e-15)
        assert found == expected
    assert requirements_data(Requirements()) == {}


# On the command line --------------------------------------------------------------------------


@pytest.fixture
def run(monkeypatch, tmp_path):
    """What `burmester synthesize FILE ...` hands to the synthesis, and its exit code."""
    calls = []

    def synthesize(*positional, **options):
        calls.append((positional, options))
        return run.found

    monkeypatch.setattr("burmester.synthesis.motion_generation.synthesize", synthesize)
    monkeypatch.setattr("burmester.io.terminal.show_synthesis", lambda *_: None)

    def run(*arguments, text=CSV, suffix=".csv"):
        calls.clear()
        file = tmp_path / f"poses{suffix}"
        file.write_text(text)
        with pytest.raises(SystemExit) as stop:
            cli.main(["synthesize", str(file), *map(str, arguments)])
        if not calls:
            return SimpleNamespace(code=stop.value.code, task=None, options=None)
        (((task, options), rest),) = calls
        assert not rest
        return SimpleNamespace(code=stop.value.code, task=task, options=options)

    run.found = SimpleNamespace(usable=(1,), determined=True)
    return run


OPTIONS = SynthesisOptions(method="auto", normalise=True, norm="rms", certify=False)


@pytest.mark.parametrize("name", SAID)
def test_every_option_reaches_the_task(run, name):
    _, arguments, field, value = SAID[name]
    done = run(*arguments)
    assert done.code == 0
    assert values(done.task.requirements) == NOTHING | {field: value}
    assert done.options == OPTIONS
    assert done.task.limits == ()


def test_the_driver_may_be_that_of_either_limits(run):
    for driver in ("first", "second"):
        done = run("--driver", driver, "--fixed-pivot", "0,0")
        assert done.task.requirements.driver == driver
        assert done.task.limits[0].fixed_pivot.at.tolist() == [0, 0]
    assert run("--driver", "third").code == 2


def test_all_of_them_at_once(run):
    arguments = [
        each for name in ("transmission", "types", "crank", "box") for each in SAID[name][1]
    ]
    arguments += ["--link-ratio", "7", "--within", "2", "--any-order", "--kinds", "RR"]
    found = run(*arguments).task
    assert values(found.requirements) == {
        "transmission": math.radians(37.5),
        "types": {"crank-rocker", "double slider"},
        "driver": "crank",
        "footprint": SQUARE,
        "link_ratio": 7,
        "within": 2,
        "any_order": True,
    }
    assert [limits.kinds for limits in found.limits] == [{"RR"}]


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        ((), {}),
        (("--angle-weight", "12.5"), {"length_per_radian": 12.5}),
        (("--tolerance", "0.05"), {"manufacturing_tolerance": 0.05}),
        (("--round", "1e-1"), {"rounding_step": 0.1}),
        (("--stock", "30, 10,20.5"), {"stock_lengths": (30, 10, 20.5)}),
        (("--stock", "30", "--stock", "10,5"), {"stock_lengths": (30, 10, 5)}),
        (("--accept-uncertain",), {}),
        (
            ("--round", "2", "--stock", "4", "--tolerance", ".5"),
            {"rounding_step": 2, "stock_lengths": (4,), "manufacturing_tolerance": 0.5},
        ),
    ],
)
def test_what_is_made_of_it_reaches_the_synthesis(run, arguments, expected):
    done = run(*arguments)
    assert done.code == 0
    assert done.options == replace(OPTIONS, **expected)
    assert done.task.requirements == Requirements()


def test_a_standard_deviation_replaces_what_the_digits_say(run, read):
    """By the variance of an even spread, which is a third of its half-width squared."""
    assert run().task.resolution == (0.05, math.radians(0.005))
    position, angle = run("--pose-sigma", "0.02,0.3").task.resolution
    rng = np.random.default_rng(1)
    spread = rng.uniform(-1, 1, 200_000).std()
    assert position * spread == pytest.approx(0.02, rel=5e-3)
    assert math.degrees(angle) * spread == pytest.approx(0.3, rel=5e-3)
    assert run("--pose-sigma", "0,1").task.resolution[0] == 0
    task = read(CSV, ".csv", pose_sigma=(1.0, 2.0))
    assert task.resolution == pytest.approx((math.sqrt(3), 2 * math.sqrt(3)))
    radians = CSV.replace("deg", "rad")
    assert read(radians, ".csv", pose_sigma=(1.0, 2.0)).resolution == task.resolution


TEXT_FAULTS = [  # option, text, code, column and width of the caret, what is said
    ("--min-transmission", "40deg", "E134", 1, 5, "'40deg' is not a finite number"),
    ("--min-transmission", "-5", "E134", 1, 2, "-5°"),
    ("--min-transmission", "90", "E134", 1, 2, "90°"),
    ("--min-transmission", "nan", "E134", 1, 3, "not a finite number"),
    ("--type", "grashof, crank-roker", "E134", 10, 11, "no linkage type 'crank-roker'"),
    ("--type", "", "E134", 1, 1, "no linkage type ''"),
    ("--type", "grashof,", "E134", 9, 1, "no linkage type ''"),
    ("--footprint", "3,4", "E134", 1, 3, "not a point"),
    ("--footprint", "line:0,0:1,1", "E134", 1, 12, "not a line"),
    ("--footprint", "segment:0,0:1,1", "E134", 1, 15, "not a segment"),
    ("--footprint", "circle:0,0", "E131", 1, 6, "no region 'circle'"),
    ("--footprint", "box:0,0:a,1", "E131", 9, 1, "'a' is not a finite number"),
    ("--footprint", "box:0,0:1", "E131", 9, 1, "not a point"),
    ("--footprint", "box:0,0:0,1", "E132", 1, 11, "x from 0 to 0"),
    ("--footprint", "polygon:0,0:1,1:2,2", "E131", 1, 19, "no inside"),
    ("--link-ratio", "0.5", "E134", 1, 3, "0.5"),
    ("--link-ratio", "5:1", "E134", 1, 3, "'5:1' is not a finite number"),
    ("--within", "0", "E134", 1, 1, "at most 0"),
    ("--within", " 1,5", "E134", 2, 3, "'1,5' is not a finite number"),
    ("--pose-sigma", "0.1", "E134", 1, 3, "'0.1' is not LENGTH,DEG"),
    ("--pose-sigma", "0.1,1,2", "E134", 1, 7, "not LENGTH,DEG"),
    ("--pose-sigma", "0.1,x", "E134", 5, 1, "'x' is not a finite number"),
    ("--pose-sigma", "1,-2", "E134", 3, 2, "'-2' is below zero"),
    ("--angle-weight", "0", "E134", 1, 1, "'0' is not above zero"),
    ("--angle-weight", "1,2", "E134", 1, 3, "'1,2' is not a finite number"),
    ("--tolerance", "-0.1", "E134", 1, 4, "'-0.1' is not above zero"),
    ("--tolerance", "inf", "E134", 1, 3, "not a finite number"),
    ("--round", "0.1mm", "E134", 1, 5, "'0.1mm' is not a finite number"),
    ("--stock", "10,0,20", "E134", 4, 1, "'0' is not above zero"),
    ("--stock", "10;20", "E134", 1, 5, "'10;20' is not a finite number"),
    ("--stock", "10,", "E134", 4, 1, "'' is not a finite number"),
]


@pytest.mark.parametrize("fault", TEXT_FAULTS, ids=lambda fault: f"{fault[0]} {fault[1]}")
def test_text_that_is_no_requirement_is_refused_with_a_caret(run, capsys, fault):
    option, text, code, column, width, said = fault
    done = run(option, text)
    assert done.code == 2
    assert done.task is None
    first, *lines = capsys.readouterr().err.splitlines()
    assert first.startswith(f"error[{code}]: ")
    assert said in first
    assert lines[0] == f"  --> {option}:1:{column}"
    assert lines[1].endswith(f"| {text}")
    assert lines[2].count("^") == width
    if code == "E134" and "finite" in said:
        assert "such as -" not in " ".join(" ".join(lines).split()), "all of them are positive"
    assert lines[2].index("^") == lines[1].index("| ") + 1 + column
    assert any(line.startswith("  help: ") for line in lines)


HELP = {  # what is refused, and what its help says to do, done
    "transmission": (["--min-transmission", "90"], [["--min-transmission", "89.9"]]),
    "ratio": (["--link-ratio", "0"], [["--link-ratio", "5"], ["--link-ratio", "1"]]),
    "within": (["--within", "0"], [["--within", "1e-3"], ["--within", "12.5"]]),
    "number": (["--within", "x"], [["--within", "12.5"], ["--within", "3e-4"]]),
    "sigma": (["--pose-sigma", "1"], [["--pose-sigma", "0.05,0.1"], ["--pose-sigma", "0,0"]]),
    "stock": (["--stock", "0"], [["--stock", "3"], []]),
    "footprint": (
        ["--footprint", "1,2"],
        [["--footprint", "box:0,0:1,1"], ["--footprint", "polygon:0,0:1,0:0,1"]],
    ),
    "driver": (
        ["--driver", "first"],
        [["--driver", "first", "--kinds", "RR", "--kinds", "RR"], ["--driver", "any"]],
    ),
    "crank": (
        ["--driver", "crank", "--kinds", "PR"],
        [["--driver", "crank", "--kinds", "PR,RR"], ["--kinds", "PR"]],
    ),
    "no crank": (
        ["--driver", "crank", "--type", "triple-rocker"],
        [["--driver", "crank", "--type", "triple-rocker,crank-rocker"], ["--type", "non-grashof"]],
    ),
    "kinds": (
        ["--type", "slider-crank", "--kinds", "RR"],
        [["--type", "crank-rocker", "--kinds", "RR"], ["--type", "slider-crank"]],
    ),
    "outside": (
        ["--footprint", "box:0,0:1,1", "--fixed-pivot", "2,0"],
        [
            ["--footprint", "box:0,0:1,1", "--fixed-pivot", "1,0"],
            ["--footprint", "box:0,0:2,1", "--fixed-pivot", "2,0"],
            ["--fixed-pivot", "2,0"],
        ],
    ),
}


@pytest.mark.parametrize("name", HELP)
def test_following_the_help_works(run, capsys, name):
    wrong, right = HELP[name]
    done = run(*wrong)
    assert done.code == 2
    assert "  help: " in capsys.readouterr().err
    for arguments in right:
        assert run(*arguments).code == 0


@pytest.mark.parametrize(
    ("text", "meant"),
    [("1,5", 1.5), ("40deg", 40), ("40 °", 40), ("2.5mm", 2.5), ("1_0", 10), ("1_234.5", None)],
)
def test_a_slip_in_a_number_is_told_the_number_meant(run, capsys, text, meant):
    assert run("--within", text).code == 2
    help = capsys.readouterr().err.partition("  help: write ")[2].strip()
    if meant is None:
        assert help.startswith("digits")
    else:
        assert run("--within", help).task.requirements.within == meant


def test_where_of_contradictions_on_the_command_line(run, capsys):
    run("--within", "1", "--footprint", "box:0,0:1,1", "--fixed-pivot", "2,0")
    assert "  --> --fixed-pivot 2,0, and --footprint box:0,0:1,1\n" in capsys.readouterr().err
    run("--within", "1", "--driver", "crank", "--type", "non-grashof")
    assert "  --> --type non-grashof, and --driver crank\n" in capsys.readouterr().err
    run("--driver", "second", "--any-order")
    assert "  --> --driver second\n" in capsys.readouterr().err


TWICE = [
    ("transmission_deg = 30", ["--min-transmission", "30"], "transmission_deg"),
    ('types = ["grashof"]', ["--type", "grashof"], "types"),
    ('driver = "crank"', ["--driver", "any"], "driver"),
    ("footprint.box = [[0, 0], [1, 1]]", ["--footprint", "any"], "footprint"),
    ("link_ratio = 5", ["--link-ratio", "6"], "link_ratio"),
    ("within = 5", ["--within", "6"], "within"),
    ("any_order = false", ["--any-order"], "any_order"),
]


@pytest.mark.parametrize(("text", "arguments", "key"), TWICE)
def test_what_is_said_in_the_file_is_not_said_again(run, capsys, text, arguments, key):
    content = f"{POSES}[requirements]\n{text}\n"
    done = run(*arguments, text=content, suffix=".toml")
    assert done.code == 2
    error = " ".join(capsys.readouterr().err.split())
    assert error.startswith("error[E108]: ")
    assert f"poses.toml:4:1, and {' '.join(arguments)} help: " in error
    assert content.splitlines()[3].startswith(key)
    # following the help: either of the two alone
    assert run(text=content, suffix=".toml").code == 0
    assert run(*arguments, text=POSES, suffix=".toml").code == 0
    # the other keys are no repetition
    other = ["--any-order"] if key != "any_order" else ["--within", "1"]
    both = run(*other, text=content, suffix=".toml").task.requirements
    assert both.any_order == (key != "any_order")


def test_limits_and_requirements_of_file_and_command_line_add_up(run):
    content = f"{POSES}[limits]\nlength.most = 3\n[requirements]\nwithin = 5\n"
    done = run("--fixed-pivot", "0,1", "--driver", "first", text=content, suffix=".toml").task
    assert done.requirements == Requirements(within=5, driver="first")
    assert [limits.length for limits in done.limits] == [(0, 3), (0, 3)]
    assert limits_from_options(length=["1:2"]).requirements == ()


@pytest.mark.parametrize(
    ("usable", "determined", "codes"),
    [((), False, (1, 1)), ((1,), False, (1, 0)), ((1,), True, (0, 0))],
)
def test_exit_code_0_means_a_usable_linkage_that_is_known(run, usable, determined, codes):
    run.found = SimpleNamespace(usable=usable, determined=determined)
    assert (run().code, run("--accept-uncertain").code) == codes
