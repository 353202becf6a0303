"""A six-bar driven through the poses of a task by Newton's method."""

import numpy as np
import pytest

from tests.oracles.six_bars import dimensions, driven


def rows_of(task):
    return np.column_stack([task.poses.translation, task.poses.angle])


def require_driven(found, given, in_order=True):
    """Drive a six-bar through its range: it meets every pose, in order, and never locks."""
    rows, size = rows_of(given), np.ptp(given.poses.translation, axis=0).max()
    if in_order:
        steps = np.diff(found.drive)
        assert (steps > 0).all() or (steps < 0).all()
    path = [np.linspace(p, q, 50)[:-1] for p, q in zip(found.drive, found.drive[1:], strict=False)]
    drives = np.concatenate([*path, found.drive[-1:]])
    run = driven(found.linkage, rows[0], found.driver, drives)
    assert run.gap < 1e-11
    assert (run.signs == run.signs[0]).all()
    at = 49 * np.arange(len(rows))
    assert np.abs(run.places[at, :2] - rows[:, :2]).max() < 1e-8 * size
    turns = np.exp(1j * run.places[at, 2]) / np.exp(1j * rows[:, 2])
    assert np.abs(turns - 1).max() < 1e-8
    assert run.angles.min() >= found.transmission - 1e-9
    if in_order:
        assert run.angles.min() <= found.transmission + 1e-2
    # The figures it tells are those of the joints that Newton's method finds.
    told = found.joints(drives)
    for k, name in enumerate("CDEGH"):
        assert np.abs(told[name] @ [1, 1j] - run.joints[:, k]).max() < 1e-8 * size
    for bar, length in dimensions(found.linkage).items():
        assert found.lengths[bar] == pytest.approx(length, rel=1e-12)
