"""Limits and regions met or broken by a linkage: by Node, against distances by hand."""

import math

import pytest

from tests.oracles.page_modules import value

SHAPES = [
    ("point", [[3, 4]], 5),
    ("segment", [[1, -1], [1, 2]], 1),
    ("segment", [[1, 1], [5, 1]], math.sqrt(2)),
    ("line", [[1, 1], [5, 1]], 1),
    ("box", [[2, -1], [4, 1]], 2),
    ("box", [[-1, -1], [1, 1]], 0),
    ("polygon", [[1, 0], [2, 1], [2, -1]], 1),
    ("polygon", [[-3, -1], [3, -1], [0, 5]], 0),
]


@pytest.mark.parametrize(("shape", "points", "away"), SHAPES)
def test_the_distance_of_the_origin_from_a_region(shape, points, away):
    script = "return m.distanceTo([0, 0], shape, points);"
    found = value("region_geometry.mjs", script, shape=shape, points=points)
    assert found == pytest.approx(away, abs=1e-12)


def linkage(**second):
    first = {"id": "D1", "kind": "RR", "fixed_pivot": [0, 0], "moving_pivot": [1, 1], "radius": 5}
    other = {"id": "D2", "kind": "RR", "fixed_pivot": [10, 0], "moving_pivot": [2, 2], "radius": 7}
    return {"led": [first, {**other, **second}]}


def missed(limits, given):
    script = "return m.limitsMissed({ limits }, given, 10);"
    return value("conditions.mjs", script, limits=limits, given=given)


def test_one_table_holds_for_both_dyads():
    box = {"fixed_pivot": {"box": [[-1, -1], [4, 1]]}}
    assert missed(box, linkage()) == [[{"key": "fixed_pivot", "dyad": "D2", "away": 6}]]
    assert missed({"fixed_pivot": {"box": [[-1, -1], [11, 1]]}}, linkage()) == [[]]


def test_of_two_tables_each_is_for_one_dyad_whichever():
    near, far = {"fixed_pivot": {"point": [10, 0]}}, {"length": {"least": 4, "most": 6}}
    assert missed([near, far], linkage()) == [[], []]
    assert missed([far, near], linkage()) == [[], []]
    short = {"length": {"most": 4}}
    assert missed([near, short], linkage()) == [[], [{"key": "length", "dyad": "D1", "away": 1}]]


def test_kinds_and_pivots_that_are_not_there():
    slider = linkage(kind="PR", fixed_pivot=None)
    (found,) = missed({"kinds": ["RR"], "fixed_pivot": {"box": [[-1, -1], [1, 1]]}}, slider)
    assert [(each["key"], each["dyad"]) for each in found] == [
        ("fixed_pivot", "D2"),
        ("kinds", "D2"),
    ]


def test_a_body_and_a_link_that_touch_a_region():
    # The body is a square of 2 that slides from x = 0 to x = 10; the link of D1 hangs from (0, 8).
    way = {"x": [0, 5, 10], "y": [0, 0, 0], "angle": [0, 0, 0]}
    rows = [{"way": 0, "frame": 0}, {"way": 0, "frame": 2}]
    first = {"id": "D1", "kind": "RR", "fixed_pivot": [0, 8], "moving_pivot": [0, 0]}
    moving = {"led": [first, {"id": "D2", "kind": "PP"}], "ways": [way], "pose_errors": rows}
    task = {
        "poses": [{"x": 0, "y": 0, "angle": 0}, {"x": 10, "y": 0, "angle": 0}],
        "keep_out": [
            {"box": [[4.5, 0.5], [5.5, 3]]},  # in the way of the body
            {"box": [[-1, 6], [-0.6, 7]]},  # 0.6 beside the link at the first pose
            {"box": [[20, 20], [21, 21]]},
            {"box": [[9, 0], [9.5, 0.5]]},  # where the body is at the second pose
            {"box": [[2.5, 3], [3.5, 4]]},  # in the way of the link
        ],
    }
    body = [[-1, -1], [1, -1], [1, 1], [-1, 1]]
    script = "return m.regionsTouched(task, moving, body);"

    def said(width, margin):
        around = {"link_width": width, "margin": margin}
        full = {**task, "surroundings": around}
        return value("conditions.mjs", script, task=full, moving=moving, body=body)

    assert said(0, 0)[0] == "The body touches it."
    assert said(0, 0)[2] == ""
    assert said(0, 0)[3] == "The body touches it at pose 2."
    assert said(0, 0)[4] == "The link of D1 touches it."
    assert said(0, 0)[1] == ""
    assert "margin" in said(0, 0.7)[1]
    assert said(1.4, 0)[1] == "The link of D1 touches it."
