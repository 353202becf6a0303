"""The values of the surroundings, and polygons that cross themselves."""

from __future__ import annotations

import numpy as np
import pytest

from burmester import (
    InputError,
    KeepOut,
    Limits,
    Polygon,
    Requirements,
    Surroundings,
    Task,
)
from burmester.tasks.pose_tolerances import PoseTolerances

SQUARE = Polygon([(0, 0), (4, 0), (4, 4), (0, 4)])
ROWS = [(0, 0, 0), (10, 2, 20), (15, 9, 45)]


def test_regions_have_names_or_numbers() -> None:
    around = Surroundings((SQUARE, KeepOut(SQUARE, " bum\x1bper ")), link_width=3)
    assert around.names[0] == "region 1"
    assert "\x1b" not in around.names[1]
    assert around.keep_out[0].polygon is SQUARE
    assert Surroundings(SQUARE).names == ("region 1",)


def test_a_task_has_surroundings() -> None:
    around = Surroundings(KeepOut(SQUARE), margin=1.5)
    task = Task.from_rows(ROWS, angle_unit="deg", surroundings=around)
    assert task.surroundings is around
    with pytest.raises(InputError, match="Surroundings") as caught:
        Task.from_rows(ROWS, angle_unit="deg", surroundings=(SQUARE,))
    assert caught.value.code == "E125"


@pytest.mark.parametrize(
    ("given", "code", "said"),
    [
        ({"link_width": -1}, "E176", "width of the links is negative"),
        ({"margin": -0.5}, "E176", "margin is negative"),
        ({"margin": np.nan}, "E103", "margin"),
        ({"keep_out": "wall"}, "E176", "'wall', not regions"),
        ({"keep_out": ([0, 0],)}, "E176", "keep-out region"),
        ({"keep_out": (SQUARE,) * 101}, "E176", "101 keep-out regions"),
        ({"body_in_plane": 1}, "E176", "neither true nor false"),
    ],
)
def test_malformed_surroundings_are_refused(given: dict, code: str, said: str) -> None:
    with pytest.raises(InputError, match=said) as caught:
        Surroundings(**given)
    assert caught.value.code == code


def test_a_body_is_clear_at_its_poses_or_refused() -> None:
    body = Polygon([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    wall = Polygon([(12, 0), (14, 0), (14, 4), (12, 4)])  # beside the second pose

    def task(
        region: Polygon, margin: float = 0.0, tolerances: PoseTolerances | None = None
    ) -> Task:
        around = Surroundings(KeepOut(region, "wall"), margin=margin)
        return Task.from_rows(
            ROWS, angle_unit="deg", body=body, surroundings=around, tolerances=tolerances
        )

    near = 12 - 10 - np.cos(np.radians(20)) - np.sin(np.radians(20))  # of a corner of the body
    assert task(wall, near - 1e-9).surroundings is not None
    with pytest.raises(
        InputError, match=r"is only 0\.718 from keep-out 'wall' at pose 2"
    ) as caught:
        task(wall, near + 1e-9)
    assert caught.value.code == "E175"
    over = Polygon(wall.vertices - [2, 0])
    with pytest.raises(InputError, match="touches keep-out 'wall' at pose 2"):
        task(over)
    with pytest.raises(InputError, match="touches keep-out 'wall' at pose 2"):
        task(Polygon(wall.vertices - [near, 0]))
    loose = PoseTolerances([[0, 0], [1, 0], [0, 0]], [0, 0, 0])
    assert task(over, tolerances=loose).tolerances is loose  # it may be met beside the wall


def test_links_clear_of_a_body_without_an_outline_are_refused() -> None:
    with pytest.raises(InputError, match="no outline") as caught:
        Task.from_rows(ROWS, angle_unit="deg", surroundings=Surroundings(body_in_plane=True))
    assert caught.value.code == "E176"


@pytest.mark.parametrize("name", [3, "x" * 101])
def test_names_that_no_message_can_repeat_are_refused(name: object) -> None:
    with pytest.raises(InputError) as caught:
        KeepOut(SQUARE, name)
    assert caught.value.code == "E176"


@pytest.mark.parametrize(
    ("corners", "near", "edges"),
    [
        ([(0, 0), (4, 0), (0, 4), (4, 4)], "(2, 2)", "2 and 4"),  # a bow tie
        ([(0, 0), (4, 0), (4, 4), (2, 0), (0, 4)], "(2, 0)", "1 and 3"),  # a corner on an edge
        ([(0, 0), (6, 0), (3, 0), (3, 3)], "(6, 0)", "1 and 2"),  # a spike
    ],
)
def test_it_is_said_where_a_polygon_crosses_itself(
    corners: list[tuple[int, int]], near: str, edges: str
) -> None:
    for turned in (corners, corners[::-1]):
        with pytest.raises(InputError) as caught:
            Polygon(turned)
        assert caught.value.code == "E131"
        assert near in caught.value.message
    with pytest.raises(InputError) as caught:
        Polygon(corners)
    assert f"corners {edges} meet" in caught.value.why


def test_outlines_may_have_more_corners_than_regions_for_pivots() -> None:
    angle = np.linspace(0, 2 * np.pi, 500, endpoint=False)
    disc = Polygon(np.stack([np.cos(angle), np.sin(angle)], axis=-1))
    for make in (lambda: Limits(fixed_pivot=disc), lambda: Requirements(footprint=disc)):
        with pytest.raises(InputError, match="500 corners for pivots"):
            make()
    angle = np.linspace(0, 2 * np.pi, 2001, endpoint=False)
    with pytest.raises(InputError, match="2001 corners"):
        Polygon(np.stack([np.cos(angle), np.sin(angle)], axis=-1))
