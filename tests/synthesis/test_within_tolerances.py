"""Linkages inside the tolerances of poses, held against linkages that are driven finely."""

import functools

import numpy as np
import pytest

from burmester.fourbar.dyad import RR
from burmester.synthesis.motion_generation import synthesize
from burmester.tasks.motion_task import Task
from burmester.tasks.pose_tolerances import PoseTolerances
from burmester.tasks.requirements import Requirements
from tests.oracles import witness
from tests.oracles.tolerance_boxes import least_shares, share
from tests.samples import some_of

INF = np.inf
DYADS = RR([0, 0], [10, 20], 30.0), RR([70, 5], [45, 25], 50.0)
SIZE = 70.0


def poses(count, noise=(0.0, 0.0, 0.0), seed=1):
    """Rows (x, y, degrees) of a known four-bar on its way, moved at random by up to `noise`."""
    where, phi = witness.places(*DYADS, np.linspace(0.6, 1.8, count))
    rows = np.column_stack([where[0].real, where[0].imag, np.degrees(phi[0])])
    rng = np.random.default_rng(seed)
    return rows + rng.uniform(-1, 1, rows.shape) * np.array(noise)


def bounds_of(count, x, y, degrees):
    return np.tile([x, y, np.radians(degrees)], (count, 1)).astype(float)


def made(rows, bounds, axes="fixed", **more):
    """The task; components that are free have no number."""
    rows = np.where(np.isinf(bounds), np.nan, rows)
    tolerances = PoseTolerances(bounds[:, :2], bounds[:, 2], axes)
    return Task.from_rows(rows, angle_unit="deg", tolerances=tolerances, **more)


def ends_exact():
    bounds = bounds_of(7, 0.2, 0.2, 0.4)
    bounds[[0, 6]] = 0
    return made(poses(7, (0.1, 0.1, 0.1)), bounds)


def parts_free():
    bounds = bounds_of(7, 0.15, 0.15, 0.3)
    bounds[[1, 3, 5], 2] = INF
    bounds[2, 0] = INF
    return made(poses(7), bounds)


TASKS = {
    "noise inside": lambda: made(poses(7, (0.3, 0.3, 0.5)), bounds_of(7, 0.31, 0.31, 0.51)),
    "along the body": lambda: made(poses(6, (0.1, 0.1, 0.3)), bounds_of(6, 0.05, 1.2, 0.6), "body"),
    "ends exact": ends_exact,
    "parts free": parts_free,
    "five, wide": lambda: made(poses(5, (1, 1, 3), seed=4), bounds_of(5, 2, 1, 6)),
    "too tight": lambda: made(poses(7, (2, 2, 4), seed=5), bounds_of(7, 0.05, 0.05, 0.1)),
}


@functools.cache
def solved(name):
    task = TASKS[name]()
    return task, synthesize(task)


@pytest.mark.parametrize("name", TASKS)
def test_what_is_said_of_the_tolerances_is_what_a_driven_linkage_does(name):
    task, synthesis = solved(name)
    tolerances = task.tolerances
    rows = np.column_stack([task.poses.translation, task.poses.angle])
    size = float(np.ptp(task.poses.translation, axis=0).max())
    rounding = 1e-7 * size
    bounds = np.maximum(tolerances.bounds, [rounding, rounding, 1e-7])
    assert synthesis.linkages
    for found in some_of(synthesis.linkages, 3):
        least = least_shares(found.linkage, rows, bounds, tolerances.axes, SIZE)
        said = found.within_tolerance.max(axis=1)
        outside = any(each.kind == "assembly" for each in found.defects)
        # What is said is said of a place on the linkage.
        places = found.error.places
        for dyad in (found.linkage.first, found.linkage.second):
            assert np.abs(dyad.residual(places)).max() < 1e-7 * SIZE, found.id
        for k, row in enumerate(rows):
            if tolerances.exact[k].any():  # measured by rounding
                continue
            where = complex(*places.translation[k])
            used = share(where, places.angle[k], row, bounds[k], tolerances.axes[k])
            assert said[k] == pytest.approx(used, rel=1e-6, abs=1e-9), found.id
        assert outside == bool((said > 1 + 1e-8).any()), found.id
        if not outside:
            assert (least <= 1 + 1e-6).all(), found.id
        elif all(each.kind == "assembly" for each in found.defects):
            assert (least > 1 - 1e-6).any(), found.id
        assert (found.within_tolerance[tolerances.free] == 0).all()
        if found.usable:
            assert not outside


@pytest.mark.parametrize("name", sorted(set(TASKS) - {"too tight"}))
def test_a_linkage_that_stays_inside_is_found(name):
    task, synthesis = solved(name)
    assert synthesis.outcome.code in ("R300", "R305", "R307")
    best = synthesis.usable[0]
    assert (best.within_tolerance <= 1 + 1e-8).all()
    exact = task.tolerances.exact
    assert best.error.position[exact[:, :2].all(axis=1)] == pytest.approx(0, abs=1e-5)
    # What is free counts for nothing.
    assert (best.error.angle[task.tolerances.free[:, 2]] == 0).all()


def test_the_outcome_says_which_tolerance_is_exceeded():
    _, synthesis = solved("too tight")
    assert synthesis.outcome.code == "R304"
    assert not synthesis.usable
    nearest = min(synthesis.linkages, key=lambda each: each.within_tolerance.max())
    shares = np.round(nearest.within_tolerance, 6)  # of equal ones the first is named
    pose, component = np.unravel_index(shares.argmax(), (7, 3))
    said = f"tolerance of pose {pose + 1} ({('x', 'y', 'angle')[component]} is off"
    assert said in synthesis.outcome.why
    assert nearest.id in synthesis.outcome.why


def test_tolerances_as_wide_as_the_outcome_says_are_kept():
    task, synthesis = solved("too tight")
    times = float(synthesis.outcome.help.split("with all tolerances ")[1].split(" ")[0])
    wider = PoseTolerances(times * task.tolerances.position, times * task.tolerances.angle)
    again = synthesize(Task(task.poses, tolerances=wider))
    assert not all(any(d.kind == "assembly" for d in e.defects) for e in again.linkages)


def test_a_bound_on_the_error_holds_beside_the_tolerances():
    task, synthesis = solved("five, wide")
    within = 0.3 * max(each.error.worst for each in synthesis.usable)
    asked = Requirements(within=within)
    again = synthesize(Task(task.poses, tolerances=task.tolerances, requirements=asked))
    for found in again.usable:
        assert found.error.worst <= within * (1 + 1e-9)


def test_quality_decides_among_linkages_inside():
    _, synthesis = solved("five, wide")
    best = synthesis.usable[0]
    closest = min(synthesis.usable, key=lambda each: each.combined_error)
    assert closest is not best
    angles = [each.driven.least_over_range for each in synthesis.usable if not each.shortcomings]
    most = min(max(angles), np.radians(60))  # more than 60 degrees count as 60
    assert best.driven.least_over_range > most - np.radians(0.5) - 1e-9
    alike = [
        max(each.quality.extent, 1.0) * each.quality.sensitivity
        for each in synthesis.usable
        if not each.shortcomings and each.driven.least_over_range >= most - np.radians(0.5)
    ]
    assert max(best.quality.extent, 1.0) * best.quality.sensitivity == min(alike)
    assert best.driven.least_over_range > closest.driven.least_over_range + np.radians(5)
