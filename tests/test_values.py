"""Values from callers: what is taken is an own copy, and what is refused says why."""

import itertools
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

from burmester.errors import InputError
from burmester.geometry.regions import Line, Point, Polygon, Segment, box
from burmester.tasks.limits import Limits
from burmester.tasks.motion_task import Task
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.requirements import Requirements
from burmester.tasks.surroundings import KeepOut
from burmester.values import real_numbers, require_instance, shown


class Columns:
    """A table that gives its numbers as an array, as those of pandas do."""

    def __array__(self, dtype=None, copy=None):
        return np.array([[1, 2], [3, 4]], dtype=dtype)


TAKEN = {
    "lists": [[1, 2], [3, 4]],
    "tuples of arrays": (np.array([1.0, 2.0]), np.array([3, 4])),
    "single precision": np.array([[1, 2], [3, 4]], dtype=np.float32),
    "small integers": np.array([[1, 2], [3, 4]], dtype=np.int8),
    "columns first": np.asfortranarray([[1.0, 2.0], [3.0, 4.0]]),
    "a table": Columns(),
    "numbers of NumPy": [[np.float32(1), np.int64(2)], [np.float64(3), 4]],
    "fractions": [[Fraction(1), Decimal(2)], [Fraction(6, 2), 4.0]],
    "objects": np.array([[1, 2], [3, 4]], dtype=object),
}


@pytest.mark.parametrize("name", TAKEN)
def test_real_numbers_of_every_make_are_taken(name):
    taken = real_numbers(TAKEN[name], (None, 2), "rows")
    assert taken.dtype == np.float64
    assert taken.tolist() == [[1.0, 2.0], [3.0, 4.0]]


REFUSED = {  # a value for two rows of two numbers, and what the message says of it
    "text": ([["1", "2"], ["3", "4"]], "the entry '1'"),
    "one text": ([[1, 2], [3, "4"]], "the entry '4'"),
    "an array of text": (np.array([["1", "2"], ["3", "4"]]), "the entry '1'"),
    "complex": (np.array([[1, 2], [3, 4j]]), "the complex number (1+0j)"),
    "one complex": ([[1, 2], [3, 4j]], "the complex number 4j"),
    "booleans": (np.array([[True, False], [True, True]]), "the entry True"),
    "one boolean": ([[1, 2], [3.5, True]], "the entry True"),
    "one boolean of NumPy": ([[1, 2], [3.5, np.False_]], "the entry False"),
    "none": ([[1, 2], [None, 4]], "the entry None"),
    "masked": (np.ma.masked_invalid([[1, 2], [3, np.nan]]), "masked array"),
    "masked rows": ([np.ma.array([1, 2], mask=[True, False]), [3, 4]], "masked array"),
    "ragged": ([[1, 2], [3]], "different lengths"),
    "ragged and deep": ([[1, [2]], [3, 4]], "different lengths"),
    "dates": (np.zeros((2, 2), dtype="datetime64[D]"), "the entry datetime.date(1970, 1, 1)"),
    "a set": ({1, 2}, "it is {1, 2}"),
    "a dictionary": ({"x": 1}, "it is {'x': 1}"),
    "nothing": (None, "it is None"),
    "one number": (3.0, "one number"),
    "one row": ([1, 2], "(2,)"),
    "three columns": ([[1, 2, 3], [4, 5, 6]], "(2, 3)"),
    "three axes": ([[[1, 2]]], "(1, 1, 2)"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_numpy_would_convert_is_refused(name):
    value, said = REFUSED[name]
    with pytest.raises(InputError) as caught:
        real_numbers(value, (None, 2), "rows")
    error = caught.value
    assert (error.code, error.message) == ("E125", "rows: not real numbers of shape (N, 2)")
    assert said in error.why
    assert error.help
    with pytest.raises(InputError) as caught:
        real_numbers(value, (None, 2), "rows", code="E131")
    assert caught.value.code == "E131"


@pytest.mark.parametrize(
    ("value", "said"),
    [
        ([[1, 2], [np.inf, 4]], "entry (1, 0) is inf"),
        (np.array([[1, np.nan], [3, 4]]), "entry (0, 1) is nan"),
        ([[1, 2], [3, -(10**400)]], "entry (1, 1) is -100"),
    ],
)
def test_numbers_that_are_not_finite_are_refused_where_they_make_no_sense(value, said):
    with pytest.raises(InputError) as caught:
        real_numbers(value, (None, 2), "rows")
    assert caught.value.code == "E103"
    assert said in caught.value.why
    assert real_numbers(value, (None, 2), "rows", finite=False).shape == (2, 2)


SHAPES = [(), (1,), (2,), (3, 2), (2, 3), (4, 3, 2), (0, 2)]


@pytest.mark.parametrize(
    ("shape", "fits"),
    [
        ((), [()]),
        ((2,), [(2,)]),
        ((None,), [(1,), (2,)]),
        ((None, 2), [(3, 2), (0, 2)]),
        ((..., 2), [(2,), (3, 2), (4, 3, 2), (0, 2)]),
        ((..., 3, None), [(3, 2), (4, 3, 2)]),
        ((...,), SHAPES),
    ],
)
def test_a_shape_with_free_axes(shape, fits):
    for each in SHAPES:
        if each in fits:
            assert real_numbers(np.ones(each), shape, "it").shape == each
        else:
            with pytest.raises(InputError):
                real_numbers(np.ones(each), shape, "it")


def test_a_value_keeps_its_own_numbers():
    corners = np.array([[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]])
    turned = corners[::-1].copy()
    at, start, end = np.array([1.0, 2.0]), np.array([0.0, 0.0]), np.array([1.0, 1.0])
    kept = [
        (Point(at), "at", [1, 2]),
        (Line(start, end), "end", [1, 1]),
        (Segment(start, end), "start", [0, 0]),
        (Polygon(corners), "vertices", corners.tolist()),
        (Polygon(turned), "vertices", corners.tolist()),
    ]
    for array in (corners, turned, at, start, end):
        array[:] = 7.0
    for region, name, numbers in kept:
        own = getattr(region, name)
        assert own.tolist() == numbers
        with pytest.raises(ValueError, match="read-only"):
            own[...] = 0.0


BAD_POINTS = {
    "text": "12",
    "texts": ["1", "2"],
    "complex": [1, 2j],
    "booleans": [True, False],
    "masked": np.ma.array([1.0, 2.0], mask=[False, True]),
    "three": [1, 2, 3],
    "a row": [[1, 2]],
    "none": None,
    "nan": [np.nan, 1],
    "infinite": [1, -np.inf],
}


@pytest.mark.parametrize("name", BAD_POINTS)
def test_no_region_takes_points_that_are_none(name):
    bad, good = BAD_POINTS[name], [5, 6]
    for make in (
        lambda: Point(bad),
        lambda: Line(bad, good),
        lambda: Line(good, bad),
        lambda: Segment(bad, good),
        lambda: Segment(good, bad),
        lambda: Polygon([good, bad, [0, 1]]),
        lambda: Polygon(bad),
        lambda: box(bad, good),
        lambda: box(good, bad),
    ):
        with pytest.raises(InputError) as caught:
            make()
        assert caught.value.code == "E131"
        assert caught.value.help


def test_points_that_cannot_be_computed_with_are_refused():
    for make in (
        lambda: Point([1e61, 0]),
        lambda: Segment([0, 0], [0, -1e200]),
        lambda: Polygon([(0, 0), (1e70, 0), (0, 1)]),
        lambda: Line([0, 0], [1e-200, 0]),
    ):
        with pytest.raises(InputError) as caught:
            make()
        assert caught.value.code == "E112"


BAD_LIMITS = {
    "fixed_pivot": ([1, 2], "point", np.zeros(2), True, Point),
    "moving_pivot": ([1, 2], 3),
    "length": (5, "ab", ("1", "2"), (1, 2, 3), (1 + 0j, 2), (True, 2), None, {1, 2}, (1, None)),
    "kinds": ("RR", 3, None, {4}, [["RR"]], [np.array(["RR", "PR"])], {"rr"}, (None,), Point),
}


@pytest.mark.parametrize(
    ("field", "value"), [(f, v) for f, values in BAD_LIMITS.items() for v in values]
)
def test_limits_of_the_wrong_type_are_refused(field, value):
    with pytest.raises(InputError) as caught:
        Limits(**{field: value})
    assert caught.value.code == "E131"
    assert caught.value.help


BAD_REQUIREMENTS = {
    "transmission_deg": (1j, None, [0.5], np.array([0.1, 0.2]), 10**400, np.ma.masked),
    "types": (b"crank-rocker", {"crank-rocker": 1}, [["crank-rocker"]], [None], np.array(["a"])),
    "driver": (["first"], np.array(["first", "second"]), 1, True),
    "footprint": ("box", (0, 1), [[0, 0], [1, 1]], True),
    "link_ratio": (np.array([2.0, 3.0]), "5", 2j, True, np.ma.masked, [3]),
    "within": (1j, [1], True, np.array([1.0]), 10**400),
    "any_order": (0, "yes", None, np.array([True, False])),
}


@pytest.mark.parametrize(
    ("field", "value"), [(f, v) for f, values in BAD_REQUIREMENTS.items() for v in values]
)
def test_requirements_of_the_wrong_type_are_refused(field, value):
    with pytest.raises(InputError) as caught:
        Requirements(**{field: value})
    assert caught.value.code == "E134"
    assert caught.value.help
    assert len(caught.value.message) < 200


BAD_OPTIONS = {
    "time_limit": (0, -1.0, True, "2", np.inf),
    "rounding_step": (0, -1.0, True, "2", np.nan),
    "stock_lengths": ([0], "10", [10, -1]),
    "method": ("best", None),
    "certify": (1, "yes"),
}


@pytest.mark.parametrize(
    ("field", "value"), [(f, v) for f, values in BAD_OPTIONS.items() for v in values]
)
def test_options_that_cannot_be_are_refused(field, value):
    with pytest.raises(InputError) as caught:
        SynthesisOptions(**{field: value})
    assert caught.value.code == "E134"
    assert field in caught.value.message
    assert caught.value.help


def test_long_names_are_refused():
    rows = [[0, 0, 0], [1, 0, 10]]
    long = "x" * 1000
    poses = Task.from_rows(rows, angle_unit="deg").poses
    for make, code, what in (
        (lambda: Task.from_rows(rows, angle_unit="deg", length_unit=long), "E122", "length unit"),
        (lambda: Task(poses, names=("short", long)), "E122", "name of pose 2"),
        (lambda: KeepOut(box([0, 0], [1, 1]), long), "E176", "keep-out region"),
    ):
        with pytest.raises(InputError, match="too long") as caught:
            make()
        assert caught.value.code == code
        assert what in caught.value.message


def test_limits_take_their_numbers_in_any_make():
    bounds = np.array([1.0, 2.0])
    limits = Limits(length=bounds, kinds=["PR", "RR", "RR"])
    bounds[:] = 7.0
    assert limits.length == (1.0, 2.0)
    assert limits.kinds == {"RR", "PR"}
    assert Limits(length=[Fraction(1, 2), np.inf]).length == (0.5, float("inf"))


def test_an_instance_of_another_class_is_refused():
    require_instance(True, (int, str), "it", "give one")
    for value, types in itertools.product((2.5, None, [1]), (int, (int, str))):
        with pytest.raises(InputError) as caught:
            require_instance(value, types, "it", "give one")
        assert caught.value.code == "E125"
        assert repr(value) in caught.value.why


def test_long_values_are_shown_short_and_on_one_line():
    assert shown(np.float64(0.5)) == "0.5"
    assert shown("abc") == "'abc'"
    long = shown(np.arange(10_000.0).reshape(100, 100))
    assert "\n" not in long
    assert len(long) < 60
