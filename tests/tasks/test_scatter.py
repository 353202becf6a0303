"""A pin recorded at itself is a pin: no verdict depends on the origin of M."""

import re

import numpy as np
import pytest
from benchmarks.two_origins import pair_of_tasks, same

from burmester import read_task, synthesize
from burmester.geometry.displacement import Displacement
from burmester.tasks.motion_class import classify_motion
from burmester.tasks.motion_kinds import General, Rotation, TwoSliders
from burmester.tasks.motion_task import Task
from burmester.tasks.plain_motions import plain_motions
from burmester.tasks.scatter import is_scatter, last_digit
from tests.oracles.recordings import trc
from tests.oracles.two_slider_motions import general, planted
from tests.samples import samples

# A door of 90 degrees, recorded at its pin and 240 mm away from it.
AT_PIN = "0.02,-0.01,0 -0.01,0.03,18 0.01,0.02,36 -0.03,0.01,54 0.00,-0.02,72 0.02,0.01,90"
AWAY = (
    "240.02,-0.01,0 228.24,74.19,18 194.17,141.09,36 141.04,194.17,54 74.16,228.23,72 "
    "0.02,240.01,90"
)
# The same with errors of 0.1 mm, printed to 0.001 mm.
NOISY_AT_PIN = (
    "-0.164,0.006,0 -0.096,0.076,10 -0.203,-0.091,20 0.071,0.116,30 -0.216,-0.050,40 "
    "0.033,-0.061,50 0.159,-0.119,60 0.035,-0.105,70 0.141,-0.002,80 -0.037,-0.172,90"
)
NOISY_AWAY = (
    "239.836,0.006,0 236.257,41.751,10 225.323,81.993,20 207.917,120.116,30 183.635,154.219,40 "
    "154.302,183.790,50 120.159,207.727,60 82.120,225.421,70 41.816,236.352,80 -0.037,239.828,90"
)


def read(path, rows, **given):
    path.write_text("x_mm,y_mm,angle_deg\n" + rows.replace(" ", "\n") + "\n")
    return read_task(path, **given)


def about(rows, centre):
    """The centre of a turn in F, and the greatest miss of the pin, from the angles by hand."""
    x, y, degrees = np.array([row.split(",") for row in rows.split()], float).T
    turn = np.exp(1j * np.radians(degrees))
    terms = np.column_stack([np.ones_like(turn), turn])
    fit = np.linalg.lstsq(terms, x + 1j * y, rcond=None)[0]
    return abs(fit[0] - centre), np.abs(x + 1j * y - terms @ fit).max()


@pytest.mark.parametrize(
    ("rows", "within"), [(AT_PIN, 0.03), (AWAY, 0.03), (NOISY_AT_PIN, 0.2), (NOISY_AWAY, 0.2)]
)
def test_a_door_is_one_pin_wherever_it_is_recorded(tmp_path, rows, within):
    task = read(tmp_path / "door.csv", rows)
    outcome = synthesize(task).outcome
    assert outcome.code == "R315"
    numbers = [float(x) for x in re.findall(r"-?\d+\.?\d*", outcome.message)]
    x, y, scatter = numbers[:3]
    assert np.hypot(x, y) < within
    off, miss = about(rows, complex(x, y))
    assert off < 0.1 * miss  # rounded to fewer digits than the scatter has
    assert scatter == pytest.approx(miss, rel=0.05)


@pytest.mark.parametrize("sigma", [(0.02, 0.0), (0.02, 1e-4), (0.1, 2e-3)])
def test_stated_errors_name_the_pin_from_both_origins(tmp_path, sigma):
    # Five poses: too few to see scatter.
    for name, rows in (("at.csv", AT_PIN), ("away.csv", AWAY)):
        fewer = " ".join(rows.split()[:5])
        assert isinstance(classify_motion(read(tmp_path / name, fewer)).kind, General)
        stated = read(tmp_path / name, fewer, pose_sigma=sigma)
        assert isinstance(classify_motion(stated).kind, Rotation)


@pytest.mark.parametrize(("column", "by"), [("x", 6.0), ("angle", 12.0)])
def test_a_bad_row_among_poses_that_scatter_is_named(tmp_path, column, by):
    rows = np.array([row.split(",") for row in NOISY_AWAY.split()], float)
    rows[4, 0 if column == "x" else 2] += by
    text = " ".join(",".join(f"{value:.3f}" for value in row) for row in rows)
    outcome = synthesize(read(tmp_path / "door.csv", text)).outcome
    assert outcome.code == "R315"
    off = by if column == "x" else 2 * 239.84 * np.sin(np.radians(by / 2))
    x, y, _, _, stated = map(float, re.findall(r"-?\d+\.?\d*", outcome.message)[:5])
    assert np.hypot(x, y) < 0.2
    assert stated == pytest.approx(off, rel=0.1)
    assert "at every pose but pose 5" in outcome.message
    assert outcome.help.startswith("correct pose 5 or leave it out")
    left = " ".join(row for number, row in enumerate(text.split()) if number != 4)
    assert classify_motion(read(tmp_path / "door.csv", left)).kind.odd is None


def test_scatter_that_is_meant_is_marked_as_exact(tmp_path):
    task = read(tmp_path / "door.csv", AT_PIN)
    kind = classify_motion(task).kind
    assert "mark one pose as exact" in kind.help
    marked = Task(task.poses, exact=np.arange(6) == 0)
    assert isinstance(classify_motion(marked).kind, General)


@pytest.mark.parametrize("number", samples(200, 60))
def test_the_verdict_is_the_same_from_both_origins(number):
    kind, _, stated, near, far = pair_of_tasks(1, number)
    one, other = (classify_motion(task).kind for task in (near, far))
    if kind == "four-bar":
        assert isinstance(one, General)
        assert isinstance(other, General)
    elif stated:
        assert same(one, other)
        assert kind != "turn" or isinstance(one, Rotation)


def test_of_200_motions_from_two_origins_hardly_one_differs():
    pairs = [pair_of_tasks(2, number)[3:] for number in samples(200, 100)]
    differ = [
        number
        for number, pair in enumerate(pairs)
        if not same(*(classify_motion(task).kind for task in pair))
    ]
    assert len(differ) <= 0.04 * len(pairs)


def test_no_exact_motion_of_a_four_bar_is_taken_for_scatter():
    rng = np.random.default_rng(7)
    for _ in samples(1500, 200):
        rows = general(rng, int(rng.integers(6, 13)), np.radians(rng.uniform(30, 180)))
        task = Task.from_rows([tuple(row) for row in rows], angle_unit="rad")
        assert not isinstance(classify_motion(task).kind, Rotation | TwoSliders)


def test_two_sliders_that_scatter_are_told_with_their_scatter():
    rng = np.random.default_rng(3)
    hits = 0
    for _ in range(40):
        rows = planted(rng, 24, np.radians(120), inverted=False)
        rows[:, :2] += 2e-3 * rng.normal(size=(24, 2))
        kind = classify_motion(Task.from_rows([tuple(row) for row in rows], angle_unit="rad")).kind
        if isinstance(kind, TwoSliders):
            hits += 1
            assert 2e-3 < kind.scatter < 2e-2
            assert f"within {kind.scatter:.2g}" in kind.message
    assert hits >= 32


def test_what_scatters_about_a_special_motion_is_no_plain_task_of_a_stack():
    rng = np.random.default_rng(11)
    stack = []
    for _ in range(40):
        angle = np.linspace(0, 1.5, 9)
        stack.append(np.column_stack([0.03 * rng.normal(size=(9, 2)), angle]))
        rows = planted(rng, 9, np.radians(110), inverted=bool(rng.integers(2)))
        stack.append(rows + 2e-3 * rng.normal(size=(9, 3)) * [1, 1, 0])
    plain, _ = plain_motions(Displacement.from_poses(np.array(stack)), (0.0, 0.0))
    alone = [
        classify_motion(Task.from_rows([tuple(row) for row in rows], angle_unit="rad")).kind
        for rows in stack
    ]
    special = np.array([isinstance(kind, Rotation | TwoSliders) for kind in alone])
    assert special.sum() > 60
    assert not (plain & special).any()


@pytest.mark.parametrize(
    ("values", "step"), [([0.02, -1.5], 0.01), ([3.0, 40.0], 1.0), ([np.pi, 1.0], 0.0)]
)
def test_the_last_digit(values, step):
    assert last_digit(np.array(values)) == pytest.approx(step)


def elbow(rng, frames, noise):
    """Two markers in space: one on the axis of a joint, one 240 mm away; there and back."""
    bend = np.radians(10 + 110 * np.sin(np.linspace(0, np.pi, frames)) ** 2)
    along, across = np.array([0.96, 0.0, 0.28]), np.array([0.0, 1.0, 0.0])
    axis = np.tile([300.0, 900.0, 50.0], (frames, 1))
    wrist = axis + 240 * (np.cos(bend)[:, None] * along + np.sin(bend)[:, None] * across)
    places = np.stack([axis, wrist], axis=1)
    return places + noise * rng.normal(size=places.shape)


@pytest.mark.parametrize("noise", [0.1, 0.5, 1.5])
@pytest.mark.parametrize("frames", [20, 200])
def test_an_elbow_is_one_pin_whichever_marker_comes_first(tmp_path, frames, noise):
    path = tmp_path / "elbow.trc"
    path.write_text(trc(("ELBOW", "WRIST"), elbow(np.random.default_rng(frames), frames, noise)))
    kinds = [
        classify_motion(read_task(path, points=points, plane="fit")).kind
        for points in ("ELBOW,WRIST", "WRIST,ELBOW")
    ]
    assert all(isinstance(kind, Rotation) for kind in kinds)
    assert np.linalg.norm(kinds[0].fixed_centre - kinds[1].fixed_centre) < noise
    assert np.linalg.norm(kinds[0].moving_centre) < noise
    assert np.linalg.norm(kinds[1].moving_centre) == pytest.approx(240, abs=4 * noise)


def test_poses_that_somebody_sketched_are_no_scatter():
    """Whole numbers about a wide arc: no pin comes nearer than a tenth of the travel."""
    rows = [(0, 0, 0), (3, 1, 20), (5, 4, 50), (4, 8, 70), (1, 9, 95), (0, 12, 110)]
    task = Task.from_rows(np.array(rows, dtype=float), angle_unit="deg")
    assert isinstance(classify_motion(task).kind, General)


def test_what_the_next_powers_of_the_turn_explain_is_no_scatter_however_rough():
    """Six poses: of all that the powers 0, 1, -1 and 2 make, the last jumps to and fro."""
    turn = np.exp(0.1j * np.arange(6))
    every, _ = np.linalg.qr(np.stack([turn**power for power in (0, 1, -1, 2, 3, -2)], axis=-1))
    assert not is_scatter(every[:, 3], turn)
    assert is_scatter(every[:, 5], turn)
    assert is_scatter(every[:, 5] + 0.5 * every[:, 3], turn)
    assert not is_scatter(0.4 * every[:, 5] + every[:, 3], turn)
