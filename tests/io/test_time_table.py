"""Tables of times as CSV: what they hold, and what is none."""

import pytest

from burmester.errors import InputError
from burmester.io.reading.trees.loads_tree import times_of_file
from tests.oracles.stated_requirements import reader

POSES = "length_unit = 'mm'\nangle_unit = 'deg'\nposes = [[0, 0, 0], [10, 5, 20], [30, 8, 50]]\n"


def test_a_task_names_its_table(tmp_path):
    (tmp_path / "times.csv").write_text("pose , note, time_s\n1,,0\n 3 ,open,2\n3,held,2.5\n")
    task = reader(tmp_path)(POSES + "[drive]\ntimes = 'times.csv'\n")
    assert task.loads.drive.times == ((0, "1"), (2, "3"), (2.5, "3"))
    (tmp_path / "times.csv").write_text("\ufefftime_s,driver_deg\n0,0\n\n1,-0.5\n")
    assert times_of_file(tmp_path / "times.csv") == [(0, 0), (1, -0.5)]


@pytest.mark.parametrize(
    ("text", "code", "holds"),
    [
        (None, "E101", "cannot be read"),
        ("", "E177", "no table of times"),
        ("time,pose\n0,1\n1,2\n", "E177", "no table of times"),
        ("time_s,pose\n0,1\nsoon,2\n", "E177", "row 3: 'soon,2'"),
        ("time_s,driver_deg\n0\n1,2\n", "E177", "row 2: '0'"),
    ],
)
def test_what_is_no_table_is_refused(tmp_path, text, code, holds):
    path = tmp_path / "times.csv"
    if text is not None:
        path.write_text(text)
    with pytest.raises(InputError) as caught:
        times_of_file(path)
    assert caught.value.code == code
    assert holds in caught.value.message
