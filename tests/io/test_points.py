"""Points of the body in files: rows without an angle."""

import io

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from burmester.io.reading.poses import read_task


def read(tmp_path, name, text):
    (tmp_path / name).write_bytes(text if isinstance(text, bytes) else text.encode())
    return read_task(tmp_path / name)


ALONE = {
    "commas": "x,y\n1,2\n3,5\n7,1\n",
    "units": "x_mm;y_mm;name\n1,5;2;a\n3;5;b\n7;1;c\n",
    "tabs": "x\ty\n1\t2\n3\t5\n7\t1\n",
    "in another order, with weights": "weight,y,x\n1,2,1\n2,5,3\n1,1,7\n",
}


@pytest.mark.parametrize("form", ALONE)
def test_a_file_without_an_angle_is_points(form, tmp_path):
    task = read(tmp_path, "points.csv", ALONE[form])
    assert task.tolerances.free.tolist() == [[False, False, True]] * 3
    assert task.tolerances.exact[:, :2].all()
    assert task.poses.translation[1:].tolist() == [[3, 5], [7, 1]]


def test_a_blank_angle_is_a_point(tmp_path):
    task = read(tmp_path, "mixed.csv", "x,y,angle_deg\n1,2,30\n3,5,\n7,1,90\n")
    assert task.tolerances.free[:, 2].tolist() == [False, True, False]
    assert np.degrees(task.poses.angle[[0, 2]]).round(9).tolist() == [30, 90]


def test_blank_angles_far_down_a_long_file(tmp_path, monkeypatch):
    """Blocks with points and blocks without are joined."""
    monkeypatch.setattr("burmester.io.reading.tables.csv_poses.BLOCK", 20)
    rows = [f"{k},{k * k},{k}" for k in range(5)] + ["9,9,", "8,8,1"]
    task = read(tmp_path, "long.csv", "\n".join(["x,y,angle_deg", *rows]))
    assert task.free_angles.tolist() == 5 * [False] + [True, False]
    few = ["1,2,3", "4,4,4", "9,9,", "8,8,"]
    task = read(tmp_path, "few.csv", "\n".join(["x,y,angle_deg", *few]))
    assert task.tolerances.free[:, 2].tolist() == [False, False, True, True]


def test_points_in_parquet(tmp_path):
    sink = io.BytesIO()
    pq.write_table(pa.table({"x": [1.0, 3.0], "y": [2.0, 5.0]}), sink)
    task = read(tmp_path, "points.parquet", sink.getvalue())
    assert task.tolerances.free[:, 2].all()
    assert task.poses.translation.tolist() == [[1, 2], [3, 5]]
