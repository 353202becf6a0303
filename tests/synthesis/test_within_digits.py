"""Motions that determine hardly any pivots: the best linkages within what the digits allow."""

import math

import numpy as np

from burmester.fourbar.dyad import RR
from burmester.geometry.displacement import Displacement
from burmester.synthesis.motion_generation import synthesize, tolerances_of_digits
from burmester.tasks.motion_task import Task
from tests.oracles import witness
from tests.oracles.tolerance_boxes import least_shares

HALF = 0.05, math.radians(0.05)  # of the last digit


def arm():
    """Poses of an arm that stays nearly level, to one digit."""
    dyads = RR([0, 0], [0, 0], 300.0), RR([10, 60], [11, 59.5], 300.5)
    where, phi = witness.places(*dyads, np.linspace(0.2, 1.2, 7))
    side = int(np.ptp(phi[0]) > np.ptp(phi[1]))
    rows = np.column_stack([where[side].real, where[side].imag, np.degrees(phi[side])]).round(1)
    return Task(Displacement(rows[:, :2], np.radians(rows[:, 2])), resolution=HALF)


def test_the_best_linkage_passes_within_the_digits():
    task = arm()
    synthesis = synthesize(task)
    assert synthesis.outcome.code == "R305"
    best, rows = synthesis.usable[0], np.column_stack([task.poses.translation, task.poses.angle])
    bounds = np.tile([HALF[0], *HALF], (7, 1))
    used = least_shares(best.linkage, rows, bounds, ["fixed"] * 7, 300.0)
    assert used.max() < 2.5  # it may be three times as far as the closest one
    within = [
        each
        for each in synthesis.usable
        if least_shares(each.linkage, rows, bounds, ["fixed"] * 7, 300.0).max() <= 1 + 1e-6
    ]
    assert len(within) >= 2
    assert best.driven.least_over_range > math.radians(20)
    assert [each.id for each in synthesis.linkages] == [
        f"L{k + 1}" for k in range(len(synthesis.linkages))
    ]


def test_digits_are_tolerances_where_nothing_else_is_said():
    task = arm()
    assert tolerances_of_digits(task).bounds[3].tolist() == [HALF[0], HALF[0], HALF[1]]
    assert tolerances_of_digits(Task(task.poses)) is None
    stated = Task(task.poses, resolution=HALF, tolerances=tolerances_of_digits(task))
    assert tolerances_of_digits(stated) is None
