"""Points of the body, paths, pairs and markers: the same from every kind of grid."""

import numpy as np
import pytest

from burmester.io.reading.functions.function_file import read_function
from burmester.io.reading.poses import read_task
from tests.oracles.grids import KINDS, grid
from tests.oracles.recordings import recording

CELLS = [kind for kind in KINDS if kind != "blanks"]  # those whose cells may be blank
POINTS = [[1.5, 2.0], [3.0, 5.0], [7.0, 1.0]]


@pytest.mark.parametrize("kind", KINDS)
def test_a_grid_without_an_angle_is_points(kind):
    task = read_task("points", data=grid(kind, ["x_mm", "y_mm"], POINTS))
    assert task.tolerances.free.tolist() == [[False, False, True]] * 3
    assert task.tolerances.exact[:, :2].all()
    assert task.poses.translation.tolist() == POINTS
    assert task.length_unit == "mm"
    weighted = [[2.0, y, x] for x, y in POINTS]
    task = read_task("points", data=grid(kind, ["weight", "y", "x"], weighted))
    assert task.poses.translation.tolist() == POINTS


@pytest.mark.parametrize("kind", KINDS)
def test_many_points_are_a_path_that_may_be_closed_and_timed(kind):
    turns = np.arange(12) * 0.5
    rows = np.column_stack([np.cos(turns), np.sin(turns), turns]).round(4).tolist()
    path = read_task("path", data=grid(kind, ["x", "y", "crank_rad"], rows)).path
    assert (path.closed, path.crank_angles.tolist()) == (False, turns.tolist())
    closed = [row[:2] for row in [*rows, rows[0]]]
    task = read_task("path", data=grid(kind, ["x", "y"], closed))
    assert task.path.closed
    assert task.poses.translation.tolist() == closed[:-1]


@pytest.mark.parametrize("kind", CELLS)
def test_pairs_of_a_function(kind):
    pairs = [[0.0, 1.0, 0.5], [1.0, 30.5, 20.0], [4.0, 45.0, 60.25]]
    names = ["weight", "output_deg", "Input_deg"]
    task = read_function(grid(kind, names, pairs), "pairs")
    assert task.weights.tolist() == [0.0, 1.0, 4.0]
    np.testing.assert_allclose(np.degrees(task.inputs), [0.5, 20, 60.25])
    np.testing.assert_allclose(np.degrees(task.outputs), [1, 30.5, 45])


@pytest.mark.parametrize("kind", CELLS)
def test_markers_and_rows_by_time(kind):
    names, places = recording(12)
    header = ["time", *(f"{name}_{axis}" for name in names for axis in "xyz")]
    times = np.arange(12)[:, None] / 10
    places = places.round(2)
    rows = np.column_stack([times, places.reshape(12, -1)]).tolist()
    task = read_task("take", data=grid(kind, header, rows), points="M1,M2", first="0.25s")
    assert task.names == tuple(str(k) for k in range(4, 13))
    np.testing.assert_array_equal(task.poses.translation, places[3:, 0, :2])


@pytest.mark.parametrize("kind", CELLS)
def test_a_blank_angle_is_a_point(kind):
    rows = [[1.5, 2.0, 30.0, 0.5], [3.0, 5.0, np.nan, np.nan], [7.0, 1.0, 90.0, 0.5]]
    task = read_task("mixed", data=grid(kind, ["x", "y", "angle_deg", "tol_angle"], rows))
    assert task.tolerances.free[:, 2].tolist() == [False, True, False]
    assert np.degrees(task.poses.angle[[0, 2]]).round(9).tolist() == [30, 90]


def test_blank_angles_far_down_a_long_file(monkeypatch):
    """Blocks with points and blocks without are joined."""
    monkeypatch.setattr("burmester.io.reading.tables.pose_rows.BLOCK", 20)
    rows = [f"{k},{k * k},{k}" for k in range(5)] + ["9,9,", "8,8,1"]
    task = read_task("-", data="\n".join(["x,y,angle_deg", *rows]).encode())
    assert task.free_angles.tolist() == 5 * [False] + [True, False]
    few = ["1,2,3", "4,4,4", "9,9,", "8,8,"]
    task = read_task("-", data="\n".join(["x,y,angle_deg", *few]).encode())
    assert task.tolerances.free[:, 2].tolist() == [False, False, True, True]
