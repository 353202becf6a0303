"""Outlines in figures: the body where complex numbers have it, names as they are."""

import numpy as np
import pytest
from matplotlib.colors import to_rgba

from burmester import Displacement, synthesize
from burmester.plot import body, figure, finish, keep_out
from tests.oracles import witness
from tests.oracles.bodies import BODY, REGIONS, bodied, carried, same_ring


@pytest.fixture(scope="module")
def best():
    """The first linkage for a body amid regions, and its task."""
    found = synthesize(bodied())
    return found.best, found.task


@pytest.fixture
def ax():
    return figure(4, 4, 80).add_subplot()


def corners_of(polygon):
    return np.asarray(polygon.get_xy())[:-1]  # Matplotlib repeats the first one


def test_the_body_is_where_its_places_have_it(ax):
    x, y, angle = np.array([[0.3, -1.0, 4.0], [2.0, 0.5, -0.1], [0.2, 2.0, -3.0]])
    places = Displacement(np.column_stack([x, y]), np.append(angle[:2], np.nan))
    drawn = body(ax, BODY, places, at=1, along=places[:2])
    assert len(drawn.places) == 2  # a place that is not finite is left out
    wanted = carried(BODY, x, y, angle)
    for polygon, corners in zip(drawn.places, wanted, strict=False):
        assert same_ring(corners_of(polygon), corners) < 1e-12
    for line, corners in zip(drawn.swept.get_segments(), wanted, strict=False):
        assert same_ring(line[:-1], corners) < 1e-12
        assert (line[0] == line[-1]).all()
    pale, strong = drawn.places
    assert strong.get_linewidth() > pale.get_linewidth()
    assert to_rgba(strong.get_facecolor())[3] > 2 * to_rgba(pale.get_facecolor())[3]


def test_later_poses_are_drawn_stronger(ax):
    places = Displacement(np.zeros((5, 2)), np.linspace(0, 1, 5))
    alphas = [each.get_edgecolor()[3] for each in body(ax, BODY, places).places]
    assert (np.diff(alphas) > 0).all()


def test_the_figure_of_a_linkage_holds_the_body_all_along_and_the_regions(best):
    chosen, task = best
    ax = chosen.plot().axes[0]
    (low, high), (below, above) = ax.get_xlim(), ax.get_ylim()
    rings = [corners_of(each) for each in ax.patches]
    for corners in carried(BODY, *task.poses.translation.T, task.poses.angle):
        assert min(same_ring(ring, corners) for ring in rings) < 1e-3
        assert ((corners > [low, below]) & (corners < [high, above])).all()
    for corners, _ in REGIONS:
        assert min(same_ring(ring, corners) for ring in rings) < 1e-12
        assert ((np.array(corners) > [low, below]) & (np.array(corners) < [high, above])).all()
    texts = {each.get_text() for each in ax.texts}
    assert "bumper" in texts
    (hostile,) = (each for each in texts if "script" in each)
    assert r"\$x\$" in hostile  # no formula
    # Along the motion its first corner goes where the witness drives it.
    swept = next(each for each in ax.collections if len(each.get_segments()) > 30)
    driver, follower = chosen.driver_first.first, chosen.driver_first.second
    d, phi = witness.places(driver, follower, np.linspace(-np.pi, np.pi, 20_001))
    corner = complex(*task.body.vertices[0])
    path = (d + corner * np.exp(1j * phi)).ravel()
    path = path[np.isfinite(path)]
    for line in swept.get_segments():
        assert np.abs(path - complex(*line[0])).min() < 2e-3


def test_a_region_is_hatched_and_its_name_stands_inside(ax):
    drawn = keep_out(ax, bodied().surroundings.keep_out)
    finish(ax)
    assert [bool(each.get_hatch()) for each in drawn.regions] == [True] * 3
    assert len(drawn.labels) == 2
    for text, (corners, _) in zip(drawn.labels, REGIONS, strict=False):
        z = np.array(corners) @ [1, 1j] - complex(*text.get_position())
        assert abs(np.angle(np.roll(z, -1) / z).sum()) == pytest.approx(2 * np.pi)
