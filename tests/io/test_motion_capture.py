"""Recordings of markers: every format gives the planted motion, and what is assumed is said."""

from __future__ import annotations

import json
import math
import re
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import openpyxl
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from benchmarks import recordings as campaign
from scipy.spatial import procrustes
from scipy.spatial.transform import Rotation

from burmester import cli
from burmester.api.result import Result
from burmester.api.synthesize import synthesize
from burmester.diagnosis.odd_pose import odd_pose
from burmester.errors import InputError
from burmester.io.reading.markers.tracked_points import fit_rigid_body
from burmester.io.reading.poses import read_task
from burmester.tasks.motion_task import Task
from tests.oracles import recordings
from tests.oracles.recordings import GROUND, LINKS, crank_rocker, recording
from tests.oracles.refusals import refusal
from tests.oracles.simulation import driven_either_way
from tests.samples import samples

Read = Callable[..., Task]


def note(task: Task) -> str:
    (only,) = [each for each in task.notes if each.code == "W213"]
    return f"{only.message}; {only.why}"


def poses_of(places: Any, scale: float = 1.0) -> tuple[Any, Any]:
    """Origin and angle by the first two markers, in the plane of X and Y."""
    p, q = places[:, 0, :2] * scale, places[:, 1, :2] * scale
    return p, np.arctan2(*(q - p).T[::-1])


def require_close(task: Task, places: Any, digits: float, scale: float = 1.0) -> None:
    origin, angle = poses_of(places, scale)
    assert task.poses.translation == pytest.approx(origin, abs=digits)
    off = np.angle(np.exp(1j * (task.poses.angle - angle)))
    assert np.abs(off).max() < 4 * digits / (80 * scale)


# --- formats


def deeplabcut(names: Any, places: Any) -> str:
    return recordings.deeplabcut(names, places, np.ones(places.shape[:2]))


FORMATS = {
    "nexus": (recordings.nexus, "mm", 1.0, 0.005),
    "motive": (recordings.motive, "m", 1e-3, 5e-7),
    "trc": (recordings.trc, "mm", 1.0, 5e-4),
    "deeplabcut": (deeplabcut, "px", 1.0, 5e-6),
    "tracker": (recordings.tracker, None, 1.0, 5e-3),
    "one line": (recordings.one_line, None, 1.0, 5e-4),
}


@pytest.mark.parametrize("suffix", [".csv", ".trc", ""])
@pytest.mark.parametrize("form", FORMATS)
def test_every_format_gives_the_markers_as_they_were_recorded(
    read: Read, form: str, suffix: str
) -> None:
    write, unit, scale, digits = FORMATS[form]
    names, places = recording(30)
    task = read(write(names, places), suffix, points="M1,M3")
    require_close(task, places[:, [0, 2]], 1.01 * digits, scale)
    assert task.length_unit == unit
    assert ("Z is passed over" in note(task)) == (form not in ("deeplabcut", "tracker"))
    back = read(write(names, places), suffix, points="M3,M1")
    require_close(back, places[:, [2, 0]], 1.01 * digits, scale)


@pytest.mark.parametrize(
    "form", ["{name}:{axis}", "{name} {axis}", "{name}_{axis}", "{name}.{axis}", "{axis}_{name}"]
)
@pytest.mark.parametrize("separator", [",", ";", "\t"])
def test_names_and_axes_in_one_line(read: Read, form: str, separator: str) -> None:
    names, places = recording(12)
    task = read(recordings.one_line(names, places, form, separator), points="M1,M2")
    require_close(task, places, 5e-4)
    shown = read(recordings.one_line(("tip", "heel"), places[:, :2], form.lower(), separator))
    require_close(shown, places, 5e-4)
    assert "tip and heel, the only two" in note(shown)


@pytest.mark.parametrize("form", FORMATS)
def test_a_recording_in_a_workbook(read: Read, tmp_path: Path, form: str) -> None:
    write, unit, *_ = FORMATS[form]
    text = write(*recording(12))
    book = openpyxl.Workbook()
    for line in text.splitlines():
        cells = line.split("\t" if form in ("trc", "tracker") else ",")
        book.active.append([_cell(cell) for cell in cells])
    book.save(tmp_path / "take.xlsx")
    sheet = read_task(tmp_path / "take.xlsx", points="M1,M2")
    task = read(text, points="M1,M2")
    assert sheet.poses.translation.tolist() == task.poses.translation.tolist()
    assert sheet.poses.angle.tolist() == task.poses.angle.tolist()
    assert sheet.length_unit == unit
    assert sheet.names == task.names


def _cell(text: str) -> Any:
    try:
        return float(text) if "." in text or "E" in text else int(text)
    except ValueError:
        return text or None


def test_poses_are_not_taken_for_markers(read: Read) -> None:
    rows = "".join(f"{k},{k * k},{9 * k},{k},{-k},{k},{k}\n" for k in range(4))
    text = f"x,y,angle_deg,v_x,v_y,a_x,a_y\n{rows}"
    assert refusal(lambda: read(text)).code == "E107"
    assert read(re.sub("([va]_.)", r"#\1", text)).poses.shape == (4,)
    assert refusal(lambda: read(text, points="v,a")).code == "E114"
    assert refusal(lambda: read(text, points="v,a", columns="x,y,angle_deg")).code == "E108"
    assert refusal(lambda: read(re.sub("([va]_.)", r"#\1", text), plane="XY")).code == "E108"


# --- which markers


def test_the_markers_that_a_refusal_offers_are_on_one_body(read: Read) -> None:
    names, places = recording(60)
    rng = np.random.default_rng(2)
    loose = places[:, :1] + np.cumsum(rng.normal(size=(60, 1, 3)), axis=0) + [60, 0, 0]
    still = np.tile([200.0, 30.0, 880.0], (60, 1, 1))  # two at rest keep their distance, too
    text = recordings.nexus(("L1", *names, "WALL"), np.concatenate([loose, places, still], axis=1))
    error = refusal(lambda: read(text))
    assert error.code == "E114"
    command = re.findall(r"`burmester synthesize \S+ --points (\S+)`", str(error.help))
    first, second = command[0].replace("Arm:", "").split(",")
    assert {first, second} <= {"M1", "M2", "M3"}
    assert read(text, points=command[0]).poses.shape == (60,)


@pytest.mark.parametrize("points", ["M1", "M1,M1", "M1,M9", "M1,", "", "x,y"])
def test_markers_that_are_none(read: Read, points: str) -> None:
    error = refusal(lambda: read(recordings.trc(*recording(12)), ".trc", points=points))
    assert error.code == "E114"
    assert "M1, M2, M3 and BASE" in str(error.why)
    again = re.findall(r"--points (\S+)", str(error.help))[0]
    assert read(recordings.trc(*recording(12)), ".trc", points=again).poses.shape == (12,)


def test_markers_of_two_bodies_are_refused_and_slow_slips_are_told(read: Read) -> None:
    names, places = recording(100, noise=0.05)
    error = refusal(lambda: read(recordings.nexus(names, places), points="M1,BASE"))
    assert (error.code, "--points" in str(error.help)) == ("E111", True)
    swapped = places.copy()
    swapped[40, [0, 1]] = swapped[40, [1, 0]]
    task = read(recordings.nexus(names, swapped), points="M1,M2,M3", drop=["141"])
    assert task.poses.shape == (99,)
    error = refusal(lambda: read(recordings.nexus(names, swapped), points="M1,M2,M3"))
    assert (error.code, "--drop 141" in str(error.help)) == ("E111", True)
    for slip, codes in ((0.5, ["W213"]), (6.0, ["W213", "W214"])):
        moved = places.copy()
        moved[:, 1, 0] += slip * np.sin(np.linspace(0, 3, 100))
        task = read(recordings.nexus(names, moved), points="M1,M2", every=4)
        assert [each.code for each in task.notes] == codes
    loud = recordings.nexus(*recording(100, noise=1.0))  # noise alone is no slip
    assert [each.code for each in read(loud, points="M1,M2").notes] == ["W213"]


def test_rotations_are_no_markers_and_digits_give_the_resolution(read: Read) -> None:
    names, places = recording(40, noise=0.0)
    error = refusal(lambda: read(recordings.motive(names, places)))
    assert error.why == "its markers are Arm, M1, M2, M3 and BASE"
    for points in ("M1,M2", "M1,M2,M3"):
        task = read(recordings.nexus(names, places), points=points)
        assert task.resolution[0] == 0.005
        assert task.resolution[1] == pytest.approx(0.01 / 94.9, rel=0.01)


# --- the rigid body


def test_the_rigid_body_is_that_of_scipy() -> None:
    rng = np.random.default_rng(3)
    for count in (2, 3, 5, 9):
        shape = rng.normal(scale=50, size=(count, 2))
        turns = rng.uniform(-math.pi, math.pi, 40)
        shifts = rng.normal(scale=300, size=(40, 2))
        turned = Rotation.from_euler("z", turns[:, None]).as_matrix()[:, :2, :2] @ shape.T
        points = turned.transpose(0, 2, 1) + shifts[:, None]
        points += rng.normal(scale=0.4, size=points.shape)
        fit = fit_rigid_body(points)
        assert fit.shape[0].tolist() == [0, 0]
        assert fit.shape[1, 1] == pytest.approx(0, abs=1e-12)
        centred = fit.shape - fit.shape.mean(axis=0)
        for k in range(40):
            place = points[k] - points[k].mean(axis=0)
            upright = [[0, 0, 1]]  # the turn is one in the plane
            solid = [np.r_[np.c_[each, 0 * each[:, :1]], upright] for each in (place, centred)]
            rotation, _ = Rotation.align_vectors(*solid)
            angle = rotation.as_euler("xyz")[2]
            assert abs(np.angle(np.exp(1j * (angle - fit.poses.angle[k])))) < 1e-9
            origin = points[k].mean(axis=0) - rotation.as_matrix()[:2, :2] @ fit.shape.mean(axis=0)
            assert fit.poses.translation[k] == pytest.approx(origin, abs=1e-9)
        # no other shape leaves less: that of scipy, fitted place by place, is the same but for size
        assert procrustes(fit.shape, shape)[2] < 1e-3
        assert fit.noise == pytest.approx(0.4, rel=0.25)


def test_no_other_shape_leaves_less() -> None:
    rng = np.random.default_rng(4)
    _, places = recording(30, noise=1.0)
    points = places[:, :3, :2]
    fit = fit_rigid_body(points)
    least = float((fit.residuals**2).sum())
    assert fit.rms == pytest.approx(math.sqrt(least / 90))

    def left(shape: Any) -> float:
        total, centred = 0.0, shape - shape.mean(axis=0)
        for row in points:
            own = row - row.mean(axis=0)
            u, values, v = np.linalg.svd(centred.T @ own)
            values[-1] *= np.sign(np.linalg.det(u @ v))
            total += (own**2).sum() + (centred**2).sum() - 2 * values.sum()
        return total

    assert left(fit.shape) == pytest.approx(least, rel=1e-9)
    for _ in range(50):
        assert left(fit.shape + 1e-2 * rng.normal(size=(3, 2))) > least


def test_three_markers_are_nearer_to_the_truth_than_two(read: Read) -> None:
    names, places = recording(2000, noise=0.5)
    _, true = recording(2000, noise=0.0)
    text = recordings.nexus(names, places)
    two, three = (read(text, points=points) for points in ("M1,M2", "M1,M2,M3"))
    _, angle = poses_of(true)
    off = [np.angle(np.exp(1j * (task.poses.angle - angle))).std() for task in (two, three)]
    assert off[1] < 0.95 * off[0]
    for task, spread in zip((two, three), off, strict=True):
        assert task.resolution[1] / math.sqrt(3) == pytest.approx(spread, rel=0.05)
        origin = task.poses.translation - true[:, 0, :2]
        assert task.resolution[0] / math.sqrt(3) == pytest.approx(origin.std(), rel=0.05)
    assert re.search(r"off by 0\.(49|5)", note(three))
    assert re.search(r"apart, give or take 0\.(69|7)", note(two))


# --- the plane


def test_another_plane_gives_the_same_poses(read: Read) -> None:
    names, places = recording(40)
    task = read(recordings.trc(names, places), ".trc", points="M1,M2")
    for order, plane in (((2, 0, 1), "YZ"), ((0, 2, 1), "XZ"), ((1, 0, 2), "YX")):
        turned = recordings.trc(names, places[..., order])
        seen = read(turned, ".trc", points="M1,M2", plane=plane)
        assert seen.poses.translation.tolist() == task.poses.translation.tolist()
        assert seen.poses.angle.tolist() == task.poses.angle.tolist()
        if plane != "YX":
            unasked = read(turned, ".trc", points="M1,M2")
            assert unasked.poses.angle.tolist() == task.poses.angle.tolist()
    assert refusal(lambda: read(recordings.trc(names, places), points="M1,M2", plane="XQ")).code
    assert refusal(lambda: read(recordings.tracker(names, places), points="M1,M2", plane="fit"))


@pytest.mark.parametrize("degrees", [10, 30, 60])
def test_a_plane_askew_is_refused_and_found(read: Read, degrees: float) -> None:
    names, places = recording(60, noise=0.05)
    turn = Rotation.from_euler("x", degrees, degrees=True).as_matrix()
    text = recordings.trc(names, places @ turn.T)
    error = refusal(lambda: read(text, ".trc", points="M1,M2"))
    assert (error.code, "--plane fit" in str(error.help)) == ("E113", True)
    task = read(text, ".trc", points="M1,M2", plane="fit")
    # the plane keeps distances: poses are those of the recording but for one shift, seen from
    # the same side
    origin, angle = poses_of(places)
    steps, true = (np.diff(each, axis=0) for each in (task.poses.translation, origin))
    assert np.hypot(*steps.T) == pytest.approx(np.hypot(*true.T), abs=0.3)
    turns = np.diff(np.unwrap(task.poses.angle)), np.diff(np.unwrap(angle))
    assert turns[0] == pytest.approx(turns[1], abs=0.01)
    assert re.search(r"they leave it by 0\.0[45]", note(task))


# --- missing markers


def test_frames_without_a_marker_are_left_out_and_counted(read: Read) -> None:
    rng = np.random.default_rng(5)
    for _ in range(20):
        names, places = recording(60)
        lost = rng.random(60) < 0.2
        which = rng.integers(0, 2, 60)
        places[lost, which[lost]] = np.nan
        text = recordings.nexus(names, places)
        head, rows = text[: text.index("101,")], text[text.index("101,") :]
        rows = rows.replace(",,,,", ",NaN,,NaN,") if rng.random() < 0.5 else rows
        task = read(head + rows, points="M1,M2")
        kept = np.flatnonzero(~lost)
        require_close(task, places[kept], 0.0051)
        assert task.names == tuple(str(101 + k) for k in kept)
        assert f"{lost.sum()} frame" in note(task)
        every = read(text, points="M1,M2", every=3, first="105", last="150")
        some = [k for k in range(4, 50, 3) if not lost[k]]
        require_close(every, places[some], 0.0051)
        assert every.names == tuple(str(101 + k) for k in some)


def test_a_marker_at_the_origin_is_lost_unless_it_belongs_there(read: Read) -> None:
    names, places = recording(20)
    places[7, 1] = 0
    task = read(recordings.trc(names, places), ".trc", points="M1,M2")
    assert task.poses.shape == (19,)
    assert "8" in note(task)
    assert "0,0,0" in note(task)
    names, places = recording(20, noise=0.0, height=0.0)
    places[:, :, :2] -= places[3, 0, :2]  # the plane Z = 0, and the origin on the way of M1
    assert read(recordings.trc(names, places), ".trc", points="M1,M2").poses.shape == (20,)


def test_an_unlikely_place_is_a_missing_one(read: Read) -> None:
    names, places = recording(30)
    sure = np.ones((30, 4))
    sure[5, 0], sure[9, 1], sure[12, 3] = 0.1, 0.59, 0.0  # the last one is not asked for
    text = recordings.deeplabcut(names, places, sure)
    task = read(text, points="M1,M2")
    assert set(map(str, range(30))) - set(task.names or ()) == {"5", "9"}
    assert "likelihood" in note(task)


# --- rows


def test_rows_are_those_of_the_file_by_number_name_and_time(read: Read) -> None:
    text = "x,y,angle_deg\n" + "".join(f"{k},{k * k},{5 * k}\n" for k in range(1, 13))
    for options, wanted in (
        ({"every": 5}, [1, 6, 11]),
        ({"first": "4", "every": 4}, [4, 8, 12]),
        ({"first": "4", "last": "9", "every": 2}, [4, 6, 8]),
        ({"last": "4"}, [1, 2, 3, 4]),
        ({"first": "3", "last": "6", "drop": ["4", "9"]}, [3, 5, 6]),
        ({"every": 2, "drop": ["2,3"]}, [1, 5, 7, 9, 11]),
    ):
        task = read(text, **options)
        assert task.poses.translation[:, 0].tolist() == wanted
        assert task.names == tuple(map(str, wanted))
    assert read(text, every=1).names is None
    marked = read(text, first="4", exact=["6"])
    assert marked.exact is not None
    assert marked.exact.tolist() == [k == 6 for k in range(4, 13)]
    for options in ({"every": 2, "exact": ["2"]}, {"drop": ["3"], "exact": ["3"]}):
        error = refusal_without_place(lambda options=options: read(text, **options))
        assert error.code == "E108"
    trc = recordings.trc(*recording(30))
    task = read(trc, ".trc", points="M1,M2", first="0.05s", last="120ms")
    assert task.names == tuple(map(str, range(6, 14)))


@pytest.mark.parametrize(
    ("head", "factor"), [("time", 1), ("time_ms", 1000), ("Zeit [s]", 1), ("t (min)", 1 / 60)]
)
def test_rows_of_poses_by_time(read: Read, head: str, factor: float) -> None:
    rows = "".join(f"{k},{k * k},{k / 10 * factor!r},{5 * k}\n" for k in range(12))
    task = read(f"x,y,{head},angle_deg\n{rows}", first="0.25s", last="700ms", every=2)
    assert task.names == ("4", "6", "8")
    text = f"x;y;{head};angle_deg\n{rows.replace(',', ';').replace('.', ',')}"
    assert read(text, first="0.3s", last="0.7s").names == ("4", "5", "6", "7", "8")
    error = refusal(lambda: read(f"x,y,{head},angle_deg\n{rows}", first="2s"))
    assert error.code == "E122"


@pytest.mark.parametrize("suffix", [".json", ".toml", ".parquet"])
def test_rows_of_every_format(tmp_path: Path, suffix: str) -> None:
    listed = [[k, k * k, 5 * k] for k in range(1, 13)]
    path = tmp_path / f"poses{suffix}"
    if suffix == ".json":
        path.write_text(json.dumps({"angle_unit": "deg", "poses": listed}))
    elif suffix == ".toml":
        path.write_text(f'angle_unit = "deg"\nposes = {listed}\n')
    else:
        columns = dict(zip(("x", "y", "angle_deg"), zip(*listed, strict=True), strict=True))
        pq.write_table(pa.table({name: list(values) for name, values in columns.items()}), path)
    task = read_task(path, every=3, first="2", last="11", drop=["8"])
    assert task.poses.translation[:, 0].tolist() == [2, 5, 11]
    assert task.names == ("2", "5", "11")
    with pytest.raises(InputError, match="1 pose:") as caught:
        read_task(path, every=12)
    assert caught.value.code == "E120"
    assert "11 of 12" in str(caught.value.why)
    assert "--every" in str(caught.value.help)


def refusal_without_place(attempt: Callable[[], object]) -> InputError:
    with pytest.raises(InputError) as caught:
        attempt()
    return caught.value


@pytest.mark.parametrize(
    "options",
    [
        {"first": "0"},
        {"first": "13"},
        {"last": "x"},
        {"first": "9", "last": "4"},
        {"first": "1.5s"},
    ],
)
def test_rows_that_are_not_there(read: Read, options: dict[str, str]) -> None:
    text = "x,y,angle_deg\n" + "".join(f"{k},{k * k},{5 * k}\n" for k in range(1, 13))
    assert refusal(lambda: read(text, **options)).code == "E122"


@pytest.mark.parametrize("every", [0, -1, True])
def test_every_needs_a_number(read: Read, every: int) -> None:
    error = refusal_without_place(lambda: read("x,y,angle_deg\n1,2,3\n4,5,6\n7,9,8\n", every=every))
    assert error.code == "E125"


def test_the_odd_pose_is_told_by_its_number_in_the_file(read: Read) -> None:
    names, places = recording(120, noise=0.02)
    clean = read(recordings.nexus(names, places), points="M1,M2", every=10)
    assert odd_pose(clean) is None
    places[40, :, :2] += [3.0, -2.0]  # both markers: the distance stays
    task = read(recordings.nexus(names, places), points="M1,M2", every=10)
    odd = odd_pose(task)
    assert odd is not None
    assert "5 (141)" in odd.message
    assert odd.help.endswith("leave it out with --drop 141")
    again = read(recordings.nexus(names, places), points="M1,M2", every=10, drop=["141"])
    assert odd_pose(again) is None


# --- the whole way


def test_a_recorded_four_bar_is_found_again_and_driven_through_its_motion(read: Read) -> None:
    names, places = recording(200, noise=0.3)
    _, true = recording(200, noise=0.0)
    task = read(recordings.nexus(names, places), points="M1,M2", every=10)
    assert task.poses.shape == (20,)
    assert task.resolution[0] / math.sqrt(3) == pytest.approx(0.3, rel=0.15)
    result: Result = synthesize(task)
    best = result.best
    assert best is not None
    linkage, places_met = best.driver_first, best.error.places
    rows = np.column_stack([places_met.translation, np.unwrap(places_met.angle)])
    run = driven_either_way(linkage, rows)
    assert run.meets
    # between the poses, too, the coupler is where the noise-free body was, up to the last pose
    origin, angle = poses_of(true)
    for point, direction in zip(origin[:191], angle[:191], strict=True):
        turn = np.angle(np.exp(1j * (run.path[:, 2] - direction)))
        off = np.hypot(*(run.path[:, :2] - point).T) + 50 * np.abs(turn)
        assert off.min() < 1.5
    # and it is the linkage that was planted, as far as 20 poses with this noise say
    # (the closest one: within the noise others may transmit better, and come first)
    linkage = min(result.usable, key=lambda each: each.error.rms).driver_first
    pivots = np.array([linkage.first.fixed_pivot, linkage.second.fixed_pivot])
    assert np.abs(pivots - GROUND).max() < 12
    lengths = [float(linkage.first.radius), float(linkage.second.radius)]
    assert lengths == pytest.approx([LINKS[0], LINKS[2]], abs=6)
    assert crank_rocker(np.array([0.3]))[0] == pytest.approx(true_pin(linkage, task), abs=3)


def test_recorded_four_bars_are_found_again() -> None:
    with tempfile.TemporaryDirectory() as folder:
        outcomes = list(campaign.campaign(len(samples(2, 1)), 5, folder))
    assert {name for name, _ in outcomes} == {"driven"}
    # the whole campaign: 100 of 100 driven, 1.3 times the noise in the median, 9 at the worst
    worst = [distance / campaign.NOISE for _, distance in outcomes]
    assert np.median(worst) < 3
    assert max(worst) < 10


def true_pin(linkage: Any, task: Task) -> Any:
    """Where the crank's pin is in the first pose."""
    pin, turn = linkage.first.moving_pivot, float(task.poses.angle[0])
    spin = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
    return (spin @ pin + task.poses.translation[0])[None]


def test_the_command_says_what_it_assumes(tmp_path: Path, capsys: Any) -> None:
    path = tmp_path / "take.csv"
    names, places = recording(200)
    places[30:42, 1] = np.nan
    path.write_text(recordings.nexus(names, places))
    with pytest.raises(SystemExit) as caught:
        cli.main(["check", str(path), "--points", "M1,M2", "--every", "10"])
    out = " ".join(capsys.readouterr().out.split())
    assert caught.value.code == 0
    assert "warning[W213]: 18 poses are those of the markers Arm:M1 and Arm:M2" in out
    assert "2 frames are left out, where a marker has no value: 131 and 141" in out
    assert out.endswith("--points M1,M2 --every 10")
