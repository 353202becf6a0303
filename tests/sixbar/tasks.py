"""Tasks of five poses for six-bars."""

import numpy as np

from burmester.tasks.motion_task import Task

REACH = [(0, 0, 0), (2, 1, 20), (4, 1.5, 45), (6, 1, 60), (7.5, -0.5, 95)]
BENT = [(3, 3.5, 35), (4.1, 3.9, 51), (5.4, 4.4, 80), (6.2, 5.8, 92), (8, 6.1, 118)]
TURNING = [(0, 0, 0), (1, 0.3, 8), (2.1, 0.5, 17), (3, 0.9, 25), (4.2, 1.1, 36)]


def task(rows, **further):
    return Task.from_rows(rows, angle_unit="deg", **further)


def wandering(seed):
    """Five random poses along a way that bends."""
    random = np.random.default_rng(seed)
    steps = random.normal([2.0, 0.5], 1.0, (5, 2)).cumsum(axis=0)
    angles = random.uniform(5, 35, 5).cumsum()
    return task(np.column_stack([steps, angles]))
