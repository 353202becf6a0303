"""Six-bars of a batch: the numbers of a row build a six-bar that Newton's method drives."""

import numpy as np
import pyarrow.parquet as pq
import pytest

from burmester import InputError
from burmester.batch import run
from burmester.batch.options import BatchOptions
from burmester.sixbar.watt import WattLinkage
from tests.oracles.six_bars import driven
from tests.sixbar.tasks import BENT, REACH

MANY = [(k, k * k / 9, 5 * k) for k in range(7)]
POINTS = (
    "fixed_first", "fixed_second", "coupler_joint", "crank_joint", "body_joint", "link_joint",
)  # fmt: skip


def built(row):
    """The six-bar of a row, from its numbers alone."""
    numbers = {name: np.array([row[f"{name}_x"], row[f"{name}_y"]]) for name in POINTS}
    for name in ("first_crank", "coupler_arm", "second_crank", "floating_link"):
        numbers[name] = np.array(row[name])
    return WattLinkage(**numbers)


def test_a_row_builds_six_bars_that_carry_the_body_through_its_poses(tmp_path):
    tasks = {"reach": REACH, "bent": BENT, "many": MANY}
    lines = [f"{name},{x},{y},{angle}" for name, rows in tasks.items() for x, y, angle in rows]
    (tmp_path / "tasks.csv").write_text("\n".join(["task,x,y,angle_deg", *lines, ""]))
    (tmp_path / "options.toml").write_text(
        '[six_bars]\nchains = 300\nseed = 2\nmost = 2\nkind = "Watt I"\n'
    )
    summary = run(
        tmp_path / "tasks.csv",
        tmp_path / "out",
        options=tmp_path / "options.toml",
        part_tasks=3,
        workers=1,
    )
    assert summary.outcomes == {"solved": 2, "refused": 1}
    *found, refused = pq.read_table(tmp_path / "out" / "part-000000.parquet").to_pylist()
    assert (refused["code"], refused["six_bars"]) == ("E195", None)
    for row in found:
        poses = np.array(tasks[row["task"]], dtype=float)
        assert row["code"] == "R370"
        assert row["linkages"] is None
        assert 1 <= len(row["six_bars"]) <= 2
        for each in row["six_bars"]:
            drive = np.radians(each["drive_deg"])
            path = np.concatenate([np.linspace(*drive[[k, k + 1]], 60)[:-1] for k in range(4)])
            start = (*poses[0, :2], np.radians(poses[0, 2]))
            once = driven(built(each), start, each["driver"], np.append(path, drive[-1]))
            assert (once.signs == once.signs[0]).all()
            places = once.places[::59]
            assert places[:, :2] == pytest.approx(poses[:, :2], abs=1e-7)
            assert np.abs(np.exp(1j * (places[:, 2] - np.radians(poses[:, 2]))) - 1).max() < 1e-7
            assert np.degrees(once.angles.min()) == pytest.approx(each["transmission_deg"], abs=0.2)


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("[six_bars]\nchain = 5\n", "E107"),
        ("six_bars = 3\n", "E107"),
        ('norm = "worst"\n[six_bars]\n', "E108"),
        ("[six_bars]\nchains = 0\n", "E197"),
    ],
)
def test_options_that_six_bars_do_not_have_are_refused(text, code):
    with pytest.raises(InputError) as refused:
        BatchOptions(text)
    assert refused.value.code == code


def test_six_bars_need_the_depth_full():
    with pytest.raises(InputError) as refused:
        BatchOptions("[six_bars]\n").require_depth("dyads")
    assert refused.value.code == "E108"
