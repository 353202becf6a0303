"""Springs and the hand in pictures: where their ends are, and which way the hand pushes."""

from dataclasses import replace

import numpy as np
import pytest

import burmester
from burmester import End, Loads, Mass, Spring
from burmester.scene.linkage_scene import scene_at
from burmester.scene.load_marks import spring_line

ROWS = {
    "four-bar": [(0, 0, 0), (-20, -10, 25), (-60, -5, 60)],
    "six-bar": [(0, 0, 0), (1, 0.3, 8), (2.1, 0.5, 17), (3, 0.9, 25), (4.2, 1.1, 36)],
}
ENDS = (End("ground", (0.0, -80.0)), End("body", (60.0, 4.0)))
LOADS = Loads(
    body=Mass(4.0, [30.0, 0.0], 0.01),
    hand=[70.0, 5.0],
    springs=(
        Spring("extension", ENDS, {"rate_N_per_mm": 0.5, "free_length": 10.0}),
        Spring("constant", ENDS, {"force_N": 5.0}),
        Spring("torsion", ENDS, {"rate_Nm_per_deg": 0.1}),
    ),
)


@pytest.fixture(scope="module", params=ROWS)
def best(request):
    task = burmester.Task.from_rows(
        ROWS[request.param], angle_unit="deg", length_unit="mm", loads=LOADS
    )
    if request.param == "four-bar":
        return burmester.synthesize(task).best
    return burmester.synthesize_six_bars(task, kind="Watt I", chains=500).best


def test_springs_are_between_their_ends_at_every_pose(best):
    for pose in range(len(best.task.poses.angle)):
        scene = scene_at(best, pose)
        own = best.error.places[pose].act(np.array(ENDS[1].point))
        coil, straight, *_ = scene.of("spring")
        for line in (coil, straight):
            assert line[0] == pytest.approx(ENDS[0].point)
            assert line[-1] == pytest.approx(own, abs=1e-6)
        assert (len(coil), len(straight)) == (17, 2)


def test_the_hand_pushes_onwards(best):
    moved = best.motion(20001).body.act(LOADS.hand)
    places = best.error.places.act(LOADS.hand)
    for pose, at in enumerate(places):
        (arrow,) = scene_at(best, pose).of("hand")
        assert arrow[0] == pytest.approx(at, abs=1e-6)
        near = int(np.hypot(*(moved - at).T).argmin())
        onwards = moved[min(near + 1, 20000)] - moved[max(near - 1, 0)]
        ahead = arrow[1] - arrow[0]
        cosine = ahead @ onwards / np.linalg.norm(ahead) / np.linalg.norm(onwards)
        assert cosine > 0.99


def test_pictures_have_them(best, tmp_path):
    drawing = best._repr_mimebundle_()["image/svg+xml"]
    bare = replace(best, loads=None)
    lines = bare._repr_mimebundle_()["image/svg+xml"].count("<polyline")
    assert (
        drawing.count("<polyline") == lines + 3
    )  # two springs and the hand; the body is on no pin of the ground
    with_loads, without = (len(each.plot().axes[0].lines) for each in (best, bare))
    assert with_loads == without + 3
    best.export(tmp_path / "picture.gif", seconds=0.4, frames_per_second=10, width_px=240)


@pytest.mark.parametrize("kind", ["extension", "compression", "gas", "constant"])
def test_a_spring_goes_from_end_to_end_and_keeps_its_width(kind):
    one, other = np.array([1.0, 2.0]), np.array([4.0, 6.0])
    line = spring_line(kind, one, other, 0.3)
    across = (line - one) @ np.array([-0.8, 0.6])
    assert np.abs(across).max() <= 0.3 + 1e-12
    along = (line - one) @ np.array([0.6, 0.8])
    assert along.min() == pytest.approx(0)
    assert along.max() == pytest.approx(5)


def test_a_counterweight_is_about_its_point_and_a_torsion_spring_about_its_joint():
    """On the driver and at its pivot, wherever the linkage is."""
    springs = (
        Spring("torsion", (End("ground", (0, 0)), End("driver", (0, 0))), {"rate_Nm_per_deg": 0.1}),
        Spring("counterweight", (End("ground", (0, 0)), End("body", (-9.0, 4.0))), {"mass_kg": 1}),
    )
    loads = replace(LOADS, springs=springs)
    rows = ROWS["four-bar"]
    task = burmester.Task.from_rows(rows, angle_unit="deg", length_unit="mm", loads=loads)
    best = burmester.synthesize(task).best
    for pose, place in enumerate(best.error.places):
        spiral, disc = scene_at(best, pose).of("spring")
        assert spiral[0] == pytest.approx(best.driver_first.first.fixed_pivot, abs=1e-9)
        assert disc[:36].mean(axis=0) == pytest.approx(place.act(np.array([-9.0, 4.0])), abs=1e-9)
