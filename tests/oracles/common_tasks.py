"""Random tasks of the shapes that are built most: lids, folds, gear, tailgates, hinges, lifts.

Each is led by a random linkage, drawn in its trade's boxes, that transmits well; then the poses are
bent smoothly, blurred and printed with two decimals.  The body starts at x = y = angle = 0, as in
the templates.  Nothing here comes from the package.
"""

from dataclasses import dataclass

import numpy as np

TRANSMISSION = np.radians(35.0)  # what every task asks for
MADE_WITH = np.radians(38.0)  # what the linkage has that makes the poses
SAMPLES = 120  # of the crank's way
QUARTER = 0.25  # share of the travel per radian that a radian counts as


@dataclass(frozen=True)
class CommonTask:
    """Poses with what is asked of their linkage.

    rows: (N, 3), x, y, angle (radians).
    boxes: for each of the dyads, or for both, the corners (2, 2) of the boxes of its fixed and its
        moving pivot; empty where they may lie anywhere.
    ratio: of the longest link to the shortest, at most.
    length: what a radian counts as.
    """

    family: str
    rows: np.ndarray
    boxes: tuple
    ratio: float
    length: float


# Boxes of the fixed and the moving pivots, turns of the body in degrees, whether the boxes are
# asked for ("both", "each" dyad its own, or not), link ratio.  A box is ((x, y), (x, y)).
FAMILIES = {
    "lid": (((5, -100), (150, -10)), ((5, -60), (150, -8)), (85, 115), "both", np.inf),
    "fold": (((-60, -80), (80, 40)), ((-60, -60), (60, 60)), (165, 180), "both", np.inf),
    "landing gear": (((90, -160), (400, 30)), ((-80, -60), (160, 200)), (80, 100), "each", np.inf),
    "tailgate": (((-320, -260), (-40, -40)), ((-120, -400), (0, -40)), (70, 100), "both", 5.0),
    "hinge": (((-40, -60), (60, 40)), ((-60, -60), (60, 60)), (60, 110), "no", np.inf),
    "lift": (((-300, -200), (300, 0)), ((-200, 50), (300, 250)), (8, 30), "both", np.inf),
    "pick and place": (((-200, -200), (300, 200)), ((-150, -150), (150, 150)), (40, 90), "no", 8.0),
    "gripper": (((-80, -80), (80, 80)), ((-60, -60), (60, 60)), (60, 90), "no", 5.0),
    "random boxes": (
        ((-100, -100), (100, 100)),
        ((-100, -100), (100, 100)),
        (30, 150),
        "own",
        10.0,
    ),
}
SPREAD = 0.2  # share of a box's sides by which its corners are moved
MARGIN = (-0.03, 0.4)  # shares of a box's size: how far a box of one's own goes beyond its pivot
DEVIATION = (0.005, 0.1)  # of the travel: how much poses are bent, and blurred a third as much


def common_task(seed):
    """One task; the families take turns."""
    rng = np.random.default_rng([13, seed])
    name = list(FAMILIES)[seed % len(FAMILIES)]
    while True:
        task = _drawn(rng, name)
        if task is not None:
            return task


def in_line(turns, digits, crank=30.0, rod=90.0):
    """Rows of the pin of an in-line slider-crank's rod, at turns of its crank, as printed."""
    turns = np.asarray(turns, dtype=float)
    y = crank * np.sin(np.radians(turns))
    rows = crank * np.cos(np.radians(turns)), y, -np.degrees(np.arcsin(y / rod))
    return np.column_stack(rows).round(digits).tolist()


def _drawn(rng, name):
    fixed, moving, (least, most), limited, ratio = FAMILIES[name]
    size = rng.uniform(0.7, 1.4)
    fixed, moving = (_shaken(rng, size * np.array(corners, float)) for corners in (fixed, moving))
    if np.ptp(fixed, axis=0).min() <= 0 or np.ptp(moving, axis=0).min() <= 0:
        return None
    turn = np.radians(rng.uniform(least, most)) * rng.choice([-1, 1])
    count = int(rng.integers(5, 10))
    found = _linkage_and_poses(rng, (fixed, moving), turn, count, ratio)
    if found is None:
        return None
    rows, pivots = found
    travel = np.abs(np.diff(rows[:, 0] + 1j * rows[:, 1])).sum()
    length = QUARTER * travel / np.abs(np.diff(rows[:, 2])).sum()
    length = min(length, float(np.hypot(*np.ptp(rows[:, :2], axis=0))))
    rows = rows + _deviation(rng, count, travel) / [1.0, 1.0, 4 * length]
    rows -= rows[0]
    rows = np.column_stack([rows[:, :2].round(2), np.radians(np.degrees(rows[:, 2]).round(2))])
    boxes = ()
    if limited == "both":
        boxes = ((fixed, moving),)
    elif limited == "each":
        tight = 0.04 * np.ptp(fixed, axis=0)
        boxes = ((np.array([pivots[0] - tight, pivots[0] + tight]), moving), (fixed, moving))
    elif limited == "own":
        boxes = tuple(
            tuple(_around(rng, pivot) for pivot in pivots[list(at)]) for at in ((0, 2), (1, 3))
        )
    return CommonTask(name, rows, boxes, ratio, float(length))


def _shaken(rng, corners):
    return corners + SPREAD * np.ptp(corners, axis=0) * rng.uniform(-1, 1, (2, 2)) / 2


def _around(rng, pivot):
    """A box of a random size around a pivot."""
    size = 200 * rng.uniform(*MARGIN, (2, 2)) * [[-1], [1]] / 2
    return pivot + size


def _deviation(rng, count, travel):
    """Deviations (count, 3), smooth ones and noise."""
    s = np.linspace(-1, 1, count)[:, None]
    bent = (rng.normal(size=(3, 3)) / 2 * np.array([[1.0], [0.7], [0.4]]))[:, None]
    smooth = bent[0] * s**2 + bent[1] * s**3 + bent[2] * np.cos(np.pi * s)
    amount = travel * np.exp(rng.uniform(*np.log(DEVIATION)))
    return amount * (smooth + rng.normal(size=(count, 3)) / 3) / 2


def _linkage_and_poses(rng, boxes, turn, count, ratio):
    """Poses (count, 3) of a random linkage that turns its body by so much, and its four pivots.

    The first of the poses is 0, 0, 0.
    """
    draws = 400
    fixed, moving = boxes
    c1, c2 = (_points(rng, fixed, draws) for _ in range(2))
    m1, m2 = (_points(rng, moving, draws) for _ in range(2))
    r1, r2, arm, ground = abs(m1 - c1), abs(m2 - c2), abs(m2 - m1), abs(c2 - c1)
    links = np.stack([r1, r2, arm, ground])
    sine = (np.conj(m2 - m1) * (m2 - c2)).imag / arm / r2
    sound = (links.max(axis=0) < min(ratio, 8.0) * 0.95 * links.min(axis=0)) & (
        abs(sine) > np.sin(MADE_WITH)
    )
    for k in np.flatnonzero(sound):
        for sense in rng.permutation([-1, 1]):
            crank = np.angle(m1[k] - c1[k]) + sense * np.linspace(0, 1.9 * np.pi, 6 * SAMPLES)
            pin = c1[k] + r1[k] * np.exp(1j * crank)
            away = abs(c2[k] - pin)
            cosine = (arm[k] ** 2 + r2[k] ** 2 - away**2) / (2 * arm[k] * r2[k])
            bad = np.flatnonzero(~(abs(cosine) < np.cos(MADE_WITH)))
            end = bad[0] if len(bad) else len(crank)
            pin, away = pin[:end], away[:end]
            along = (arm[k] ** 2 - r2[k] ** 2 + away**2) / (2 * away)
            across = np.sqrt(np.maximum(arm[k] ** 2 - along**2, 0.0))
            toward = (c2[k] - pin) / away
            both = np.stack([pin + toward * (along + s * 1j * across) for s in (1, -1)])
            side = int(abs(both[0, 0] - m2[k]) > abs(both[1, 0] - m2[k]))
            phi = np.unwrap(np.angle((both[side] - pin) / (m2[k] - m1[k])))
            there = np.flatnonzero(phi * np.sign(turn) > abs(turn))
            if not len(there) or there[0] < SAMPLES // 4:
                continue
            at = np.linspace(0, there[0], count).round().astype(int)
            place = pin[at] - m1[k] * np.exp(1j * phi[at])
            travel = abs(np.diff(place)).sum()
            if travel < 0.3 * links[:, k].mean() * abs(turn):
                continue
            rows = np.column_stack([place.real, place.imag, phi[at]])
            pivots = np.array([[p.real, p.imag] for p in (c1[k], c2[k], m1[k], m2[k])])
            return rows, pivots
    return None


def _points(rng, corners, count):
    x, y = rng.uniform(corners[0], corners[1], (count, 2)).T
    return x + 1j * y
