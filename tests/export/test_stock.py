"""Sizes that shops have: the lists against printed tables, and what is chosen of them."""

from dataclasses import fields, replace
from itertools import pairwise

import pytest

from burmester.export import Options
from burmester.export.parts.plates import assembly_of
from burmester.export.parts.stock import INCHES, METRIC, nearest, stock_for
from tests.oracles.handed_over import NAMES, saved

# ISO 273, fine series, as tables of suppliers print it: thread and hole in mm.
ISO_273 = {1: 1.1, 1.2: 1.3, 1.4: 1.5, 1.6: 1.7, 2: 2.2, 2.5: 2.7, 3: 3.2, 3.5: 3.7, 4: 4.3, 5: 5.3}
ISO_273 |= {6: 6.4, 7: 7.4, 8: 8.4, 10: 10.5, 12: 13, 14: 15, 16: 17, 18: 19, 20: 21, 22: 23}
ISO_273 |= {24: 25, 27: 28, 30: 31, 33: 34, 36: 37, 39: 40, 42: 43, 45: 46, 48: 50, 56: 58, 64: 66}
# ASME B18.2.8, close fit: the size in 1/16 in, and the metric drill that Machinery's Handbook
# names for it, mm.  Such a drill is within a fifth of a millimetre of the inch drill.
ASME_CLOSE = {4: 6.7, 5: 8.3, 6: 9.9, 7: 11.5, 8: 13.5, 10: 16.75, 12: 20, 14: 23, 16: 26}
ASME_CLOSE |= {20: 32.5, 24: 39.5}
# Links of about these lengths have sizes in stock; those of micrometres have none.
IN_STOCK = [name for name in NAMES if not name.endswith(("um", "no unit"))]


def test_metric_holes_are_those_of_the_fine_series():
    assert dict(METRIC.joints).items() <= ISO_273.items()


def test_inch_holes_are_fractional_drills_of_the_close_fit():
    for pin, hole in INCHES.joints:
        for size in (pin, hole):
            assert size / 25.4 * 64 == pytest.approx(round(size / 25.4 * 64), abs=1e-9)
        sixteenths = pin / 25.4 * 16
        if sixteenths >= 4:
            assert hole == pytest.approx(ASME_CLOSE[round(sixteenths)], abs=0.2)
        else:
            assert hole - pin == pytest.approx(25.4 / 64)


@pytest.mark.parametrize("stock", [METRIC, INCHES])
def test_lists_rise_and_have_no_wide_gaps(stock):
    for sizes in (stock.holes, stock.widths, stock.sheets, stock.shims):
        ratios = [two / one for one, two in pairwise(sizes)]
        assert min(ratios) > 1
        assert max(ratios) <= 2.01
    assert all(pin < hole for pin, hole in stock.joints)


@pytest.mark.parametrize("name", IN_STOCK)
def test_what_is_chosen_is_in_stock_and_near_what_the_size_asks_for(name):
    chosen = saved(name)
    made = assembly_of(chosen, Options()).dimensions
    stock = INCHES if chosen.unit in ("in", "ft") else METRIC
    assert (made.pin, made.hole) in stock.joints
    assert made.width in stock.widths
    assert made.thickness in stock.sheets
    assert made.gap in stock.shims
    # Lengths of the same figures without a unit follow the linkage's size.
    bare = replace(chosen, task=replace(chosen.task, length_unit=None))
    free = assembly_of(bare, Options()).dimensions
    scale = {"mm": 1, "cm": 10, "m": 1000, "in": 25.4, "ft": 304.8}[chosen.unit]
    # Each follows the one before: hole and thickness the width, the gap the thickness.
    for what, most in (("width", 1.5), ("hole", 2.3), ("thickness", 2.3), ("gap", 3.5)):
        ratio = getattr(made, what) / (getattr(free, what) * scale)
        assert 1 / most < ratio < most, what


@pytest.mark.parametrize("name", ["slider-crank, no unit", "slot drives, um"])
def test_without_a_unit_and_where_nothing_is_near_sizes_follow_the_linkage(name):
    made = assembly_of(saved(name), Options()).dimensions
    assert made.hole / made.width == pytest.approx(0.4, rel=0.06)
    assert made.thickness / made.width == pytest.approx(0.4, rel=0.06)
    assert made.gap / made.thickness == pytest.approx(0.1, rel=0.06)
    assert made.pin / made.hole == pytest.approx(0.98)


def test_a_unit_that_is_stated_gives_sizes_in_stock():
    chosen = saved("double-rocker, in")
    bare = replace(chosen, task=replace(chosen.task, length_unit=None))
    assert assembly_of(bare, Options(unit="cm")).dimensions.hole in METRIC.holes
    assert assembly_of(bare, Options(unit="in")).dimensions.hole in INCHES.holes


def test_options_win():
    chosen = saved("trammel, mm")
    own = {"hole": 3.3, "width": 7.7, "thickness": 2.2, "gap": 0.0, "pin": 3.1}
    made = assembly_of(chosen, Options(**own)).dimensions
    assert {each.name: getattr(made, each.name) for each in fields(made)} == own
    # What is left out follows what is given.
    assert assembly_of(chosen, Options(pin=5.0)).dimensions.hole == 5.3
    assert assembly_of(chosen, Options(hole=3.2)).dimensions.pin == 3.0
    assert assembly_of(chosen, Options(hole=3.0)).dimensions.pin == pytest.approx(2.94)
    assert assembly_of(chosen, Options(hole=3.2)).dimensions.width == 8.0


def test_nearest():
    assert nearest((1, 2, 3, 4), 2.5, 10) == 3  # by ratio
    assert nearest((1, 2, 3, 4), 2.5, 2.9) == 2
    assert nearest((1, 2), 0.5, 10) is None
    assert nearest((1, 2), 3.1, 10) is None


@pytest.mark.parametrize(
    ("unit", "size", "name"),
    [
        ("mm", 5.3, "5.3 mm"),
        ("ft", 25.4 * 13 / 64, "13/64 in"),
        ("in", 25.4 * 1.5, "1 1/2 in"),
        ("in", 50.8, "2 in"),
        ("in", 25.4 * 0.0598, "16 gauge (0.0598 in)"),
        ("in", 25.4 * 0.02, "0.02 in"),
    ],
)
def test_sizes_are_called_as_a_shop_calls_them(unit, size, name):
    assert stock_for(unit).name(size) == name
