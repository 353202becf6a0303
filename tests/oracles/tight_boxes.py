"""Tasks of two, three and four poses whose box of fixed pivots was made too small.

Each has a known linkage; the box is cut down to a corner far from the fixed pivots of that
linkage, so that nobody knows whether another one is left.  No code of the package.
"""

import numpy as np

from tests.oracles.few_pose_tasks import few_pose_task
from tests.oracles.few_poses import Bounds, FewPoses

SHARE = 0.35  # of the sides of the box that are left
RATIO = 10.0  # of the links of a linkage to build


def tight_task(seed, known):
    """The poses (N, 3) and the boxes of a task, and the box number that was cut down.

    known: pivots c1, m1, c2, m2 (4,) of a linkage that keeps the boxes as they were, complex.
    """
    given, number = few_pose_task(seed), 0
    rng = np.random.default_rng([33, seed])
    boxes = [[np.asarray(part, float) for part in pair] for pair in given.boxes]
    pivots = np.array([[known[0].real, known[0].imag], [known[2].real, known[2].imag]])
    held = pivots if len(boxes) == 1 else pivots[:1]
    low, high = boxes[number][0]
    middle = held.mean(axis=0)
    size = SHARE * (high - low)
    corner = np.where(middle > (low + high) / 2, low, high - size)
    corner = corner + rng.uniform(-0.1, 0.1, 2) * size
    boxes[number][0] = np.round([corner, corner + size], 1)
    return given.rows, tuple(tuple(pair) for pair in boxes), number


def grown(boxes, number, by):
    """The boxes, one of fixed pivots wider by a length on all sides."""
    out = [list(pair) for pair in boxes]
    low, high = out[number][0]
    out[number][0] = np.array([low - by, high + by])
    return tuple(tuple(pair) for pair in out)


def has_linkage(rows, boxes, seed, least=30.0, *, starts=10, rounds=1):
    """Whether brute force finds a linkage that transmits at `least` degrees within boxes."""
    search = FewPoses(rows, boxes, Bounds(ratio=RATIO))
    best = search.best(np.random.default_rng([34, seed]), rounds, starts, 40)
    return best is not None and best.angle >= least


def outside(boxes, number, pivots):
    """How far fixed pivots (k, 2) lie outside a box, sideways: the growth that lets them in."""
    low, high = boxes[number][0]
    return float(max(0.0, (low - pivots).max(), (pivots - high).max()))
