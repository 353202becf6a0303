"""Tasks with a rail or a slot: what is found keeps it, as the witness drives it."""

import functools
import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from burmester import Displacement, follow
from burmester.errors import InputError
from burmester.fourbar.dyad import PR, RP
from burmester.geometry.regions import Polygon, box
from burmester.io import templates
from burmester.io.reading.poses import read_task
from burmester.synthesis.judgement import judge_linkage
from burmester.synthesis.motion_generation import synthesize
from burmester.tasks.limits import Limits
from burmester.tasks.notation import span
from burmester.tasks.rails import Rail
from tests.oracles import witness
from tests.oracles.rail_tasks import planted
from tests.samples import samples

# A casement window's stay, seen from above: the rail was at 75° across the frame.
STAY = """
length_unit = "mm"
angle_unit = "deg"
poses = [[0, 0, 0], [60, 8, 30], [130, 18, 60], [190, 35, 88]]
body = [[0, 0], [600, 0], [600, 50], [0, 50]]
[[limits]]
rail = { direction_deg = 0, tolerance_deg = 2, through = { segment = [[0, -20], [0, 20]] }, travel = { box = [[-20, -40], [400, 40]] } }
moving_pivot = { box = [[0, -20], [500, 50]] }
[[limits]]
kinds = ["RR"]
fixed_pivot = { box = [[0, -40], [500, 60]] }
moving_pivot = { box = [[0, -20], [500, 50]] }
"""  # noqa: E501  a table of TOML stands in one line


def from_text(text):
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "task.toml")
        path.write_text(text, encoding="utf-8")
        return read_task(path)


@functools.cache
def solved(name):
    """The task of a template, and what comes of it."""
    task = from_text(templates.text(name))
    return task, synthesize(task)


def require_kept(rail, slider, places, size):
    """Direction and place of the line, and its pins at places, by points of the line itself."""
    slack = 2e-6 * size
    normal = float(slider.normal_angle)
    along = np.array([-np.sin(normal), np.cos(normal)])
    at = float(slider.offset) * np.array([np.cos(normal), np.sin(normal)])
    if rail.direction_deg is not None:
        off = (np.degrees(np.arctan2(along[1], along[0])) - rail.direction_deg + 90) % 180 - 90
        assert abs(off) <= rail.tolerance_deg + 1e-4
    if rail.through is not None:
        sides = (rail.through.corners() - at) @ [-along[1], along[0]]
        assert sides.min() <= slack
        assert sides.max() >= -slack
    turn, origin = np.exp(1j * places.angle), places.translation @ [1, 1j]
    if isinstance(slider, PR):
        pin = origin + turn * complex(*slider.moving_pivot)
    else:
        pin = (complex(*slider.fixed_pivot) - origin) / turn
    if rail.travel is not None:
        assert rail.travel.distance(np.stack([pin.real, pin.imag], axis=-1)).max() <= slack


def require_all_kept(task, found):
    for limits, dyad in zip(task.limits, (found.linkage.first, found.linkage.second), strict=True):
        if limits.line is not None:
            assert isinstance(dyad, RP if limits.rail is None else PR)
            require_kept(limits.line, dyad, found.error.places, span(task))


@pytest.mark.parametrize("number", samples(60, 1))
def test_a_linkage_is_found_where_one_was_planted(number):
    """`benchmarks/rails` runs more of them."""
    task, _ = planted(np.random.default_rng([0, number]))
    found = [each for each in synthesize(task).linkages if each.usable]
    nearest = min(found, key=lambda each: each.combined_error)
    assert nearest.combined_error < 1e-3 * span(task)
    assert witness.misses(nearest.linkage, task.poses, span(task)).max() < 1e-2 * span(task)
    for each in found:
        require_all_kept(task, each)


def test_a_window_stay_runs_along_its_frame():
    """Four poses and this rail leave no exact linkage: the nearest one, with a warning."""
    task = from_text(STAY)
    synthesis = synthesize(task)
    best = next(each for each in synthesis.linkages if each.usable)
    require_all_kept(task, best)
    assert best.error.position.max() < 10
    assert "W256" in [each.code for each in synthesis.warnings]


@pytest.mark.parametrize("name", ["drawer", "garage-door", "window-stay"])
def test_a_template_is_solved_exactly(name):
    task, synthesis = solved(name)
    best = synthesis.linkages[0]
    assert best.usable
    assert synthesis.outcome.code == "R308"
    assert witness.misses(best.linkage, task.poses, span(task)).max() < 1e-6 * span(task)
    require_all_kept(task, best)


def test_pins_keep_their_travel_between_the_poses():
    """The travel ends between two poses: the linkage is refused for it, with and without a pose."""
    task, synthesis = solved("window-stay")
    best = synthesis.linkages[0].linkage
    swing = Displacement(task.poses.translation[[0, 2]], task.poses.angle[[0, 2]])
    pins = task.poses.act(best.first.moving_pivot)[:, 0]
    for most, kept in ((pins.max() + 1, True), (pins.max() - 1, False)):
        rail = Rail(travel=box((pins.min() - 1, -50), (most, 50)))
        judged = judge_linkage(replace(task, limits=(Limits(rail=rail), Limits())), best)
        unmet = [each.message for each in judged.linkages[0].violations]
        assert kept == (not unmet), unmet
        if not kept:
            assert "beyond its travel" in unmet[0]
    hole = pins[0] + (pins[1] - pins[0]) / 2
    notch = [(-99, -99), (hole - 2, -99), (hole - 2, 50), (hole + 2, 50), (hole + 2, -99)]
    middle = Polygon([*notch, (600, -99), (600, 99), (-99, 99)])
    rail = Rail(travel=middle)
    assert middle.distance(task.poses.act(best.first.moving_pivot)).max() == 0
    between = replace(task, poses=swing, names=None, limits=(Limits(rail=rail), Limits()))
    assert judge_linkage(between, best).linkages[0].violations


def test_a_task_with_a_rail_is_not_followed():
    task, synthesis = solved("window-stay")
    with pytest.raises(InputError, match="rail or a slot") as caught:
        follow(synthesis, task)
    assert caught.value.code == "E157"
