"""Rails: what is refused, and how far lines and pins miss them."""

import numpy as np
import pytest

from burmester.errors import InputError
from burmester.geometry.regions import Line, Point, Polygon, Segment, box
from burmester.tasks.limits import Limits
from burmester.tasks.rails import Rail

SQUARE = Polygon([(0, 0), (4, 0), (4, 2), (0, 2)])


@pytest.mark.parametrize(
    ("stated", "message"),
    [
        ({}, "neither direction nor a place"),
        ({"tolerance_deg": 2, "travel": SQUARE}, "2° of no direction"),
        ({"direction_deg": 0, "tolerance_deg": 90}, "tolerance is 90°"),
        ({"direction_deg": 0, "tolerance_deg": -1}, "tolerance is -1°"),
        ({"direction_deg": float("nan")}, "direction_deg"),
        ({"through": Line([0, 0], [1, 0])}, "no region that a line passes through"),
        ({"travel": Point([0, 0])}, "no region that a pin travels along"),
        ({"direction_deg": 0, "travel": Segment([0, 0], [1, 0])}, "given twice"),
        ({"through": Point([0, 0]), "travel": Line([0, 0], [1, 0])}, "given twice"),
    ],
)
def test_a_rail_that_is_malformed(stated, message):
    with pytest.raises(InputError, match=message) as caught:
        Rail(**stated)
    assert caught.value.code == "E137"


def test_a_line_that_misses_the_travel():
    """A square two units beside the line through the origin: within 45° it is met."""
    far = box((2, 2), (3, 3))
    with pytest.raises(InputError, match="misses the travel of its pin by 2") as caught:
        Rail(0, through=Point([0, 0]), travel=far)
    assert caught.value.code == "E138"
    with pytest.raises(InputError, match="misses"):
        Rail(0, 33, Point([0, 0]), far)
    Rail(0, 34, Point([0, 0]), far)  # atan(2 / 3) is 33.69°
    Rail(0, through=Segment([0, -9], [0, 9]), travel=far)
    Rail(through=Point([0, 0]), travel=far)


@pytest.mark.parametrize(
    "limits",
    [
        {"rail": Rail(0), "slot": Rail(0)},
        {"rail": Rail(0), "fixed_pivot": Point([0, 0])},
        {"slot": Rail(0), "moving_pivot": SQUARE},
        {"rail": Rail(0), "kinds": {"RR", "RP"}},
        {"rail": Rail(0), "length": (1, 2)},
    ],
)
def test_limits_that_a_dyad_with_a_line_cannot_have(limits):
    with pytest.raises(InputError) as caught:
        Limits(**limits)
    assert caught.value.code == "E132"


def test_kinds_and_conditions():
    exact = Rail(0, through=Point([1, 2]))
    assert Limits(rail=exact).allowed == {"PR"}
    assert Limits(slot=exact).allowed == {"RP"}
    assert Limits(rail=exact).conditions == 3
    assert Limits(rail=Rail(0, 1), moving_pivot=Line([0, 0], [1, 0])).conditions == 2
    assert Limits(slot=Rail(travel=Segment([0, 0], [1, 0]))).conditions == 3
    assert Limits(slot=Rail(travel=SQUARE)).conditions == 1


def test_lines_miss_a_rail_by_what_two_points_of_them_say():
    """Against lines of two points: their direction by atan2, the sides on which corners lie."""
    rng = np.random.default_rng(3)
    for _ in range(200):
        direction, tolerance = rng.uniform(-360, 360), rng.uniform(0, 60)
        corners = rng.normal(size=(rng.integers(1, 3), 2))
        through = Point(corners[0]) if len(corners) == 1 else Segment(*corners)
        one, other = rng.normal(size=(2, 2))
        way = other - one
        normal = np.array([-way[1], way[0]]) / np.hypot(*way)
        flip = rng.choice([1, -1])
        angle, offset = np.arctan2(*(flip * normal)[::-1]), flip * (normal @ one)
        rail = Rail(direction, tolerance, through)
        value, equal = rail.line_excess(angle, offset)
        off = abs((np.degrees(np.arctan2(way[1], way[0])) - direction + 90) % 180 - 90)
        assert max(value[:2]) == pytest.approx(np.radians(off - tolerance))
        sides = (corners - one) @ normal
        beside = 0.0 if min(sides) < 0 < max(sides) else abs(sides).min()
        assert rail.passed(angle, offset) == pytest.approx(beside)
        kept = np.where(equal, abs(value), value)[2:].max() <= 1e-12
        assert kept == (beside <= 1e-12)


def test_pins_beyond_the_travel():
    rail = Rail(travel=Segment([0, 0], [3, 4]))
    along = np.array([0.6, 0.8])
    for share, beyond in ((-2, 2), (1, -1), (5, 0), (7, 2)):
        assert rail.travel_excess(share * along) == pytest.approx(beyond)
    assert Rail(travel=SQUARE).travel_excess(np.array([6.0, 1.0])) == pytest.approx(2)
    assert Rail(0).travel_excess(np.zeros(2)) == -np.inf


def test_a_rail_in_another_frame_misses_by_as_much():
    rng = np.random.default_rng(4)
    rail = Rail(20, 3, Segment([0, 1], [1, 3]), box((-1, -2), (5, 2)))
    origin, unit = rng.normal(size=2), 2.5
    moved = rail.moved(origin, unit)
    angle, offset, pin = 1.9, 0.7, rng.normal(size=2)
    normal = np.array([np.cos(angle), np.sin(angle)])
    there, _ = moved.line_excess(angle, (offset - normal @ origin) / unit)
    here, _ = rail.line_excess(angle, offset)
    assert there * [1, 1, unit, unit] == pytest.approx(here)
    assert moved.travel_excess((pin - origin) / unit) * unit == pytest.approx(
        rail.travel_excess(pin)
    )
