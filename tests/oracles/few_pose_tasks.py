"""Random tasks of two, three and four poses with boxes for their pivots, as designers have them.

In three of five a random four-bar that transmits well makes the poses, and the boxes hold its
pivots somewhere; the others are poses along a bent path, with boxes near the body, and nothing says
that there is a linkage.  Lengths in mm, written to 0.01 mm and 0.01 degrees.  No code of the
package.
"""

from dataclasses import dataclass

import numpy as np

SPAN = (50.0, 500.0)  # of the motion, mm
TURN = (10.0, 150.0)  # of the body, degrees
MADE_WITH = np.cos(np.radians(35.0))  # greatest |cos| of the transmission angle of a known linkage
WIDE = (3.0, 300.0)  # spans of the motion: regions of `wide_task`
RATIO = 4.5  # of the links of a known linkage


@dataclass(frozen=True)
class FewPoseTask:
    """rows: (N, 3), x, y, angle (radians); boxes as `few_poses.FewPoses` takes them.

    family: "led" by a known linkage, or "free"; known: the least transmission angle of that
    linkage, degrees, 0 where there is none.
    """

    family: str
    rows: np.ndarray
    boxes: tuple
    known: float


def few_pose_task(seed):
    """One task: two, three, four poses in turns; one pair of boxes for both dyads, or two."""
    rng = np.random.default_rng([15, seed])
    count, family = 2 + seed % 3, ("led", "free")[seed // 3 % 5 > 2]
    own = bool(seed // 6 % 2)
    while True:
        task = _led(rng, count, own) if family == "led" else _free(rng, count, own)
        if task is not None:
            return task


@dataclass(frozen=True)
class WideTask:
    """A task with regions of 3 to 300 spans.

    rows: (N, 3), x, y, angle (radians).
    regions: of the fixed and of the moving pivots, as corners (n, 2) of a polygon, (2, 2) the ends
        of a segment, or None where nothing is asked.
    boxes: (2, 2, 2), boxes within those regions; where nothing is asked, one span around the
        poses and around the origin of M.
    width: of the regions, in spans.
    """

    rows: np.ndarray
    regions: tuple
    boxes: np.ndarray
    width: float


def wide_task(seed):
    """Two, three, four poses in turns; regions around the motion for both pivots, or for one."""
    rng = np.random.default_rng([18, seed])
    rows = few_pose_task(seed).rows
    low, high = rows[:, :2].min(axis=0), rows[:, :2].max(axis=0)
    span, spans = float(np.hypot(*(high - low))), float(np.exp(rng.uniform(*np.log(WIDE))))
    which = rng.choice(4, p=[0.15, 0.15, 0.35, 0.35])  # fixed, moving, both
    regions, boxes = [], []
    origin = np.zeros(2)
    for near, far, asked in ((low, high, which != 1), (origin, origin, which > 0)):
        if not asked:
            regions.append(None)
            boxes.append(np.array([near - span, far + span]))
            continue
        middle, half = (near + far) / 2, spans * span / 2 * rng.uniform(0.7, 1.0, 2)
        at = middle + rng.uniform(-0.8, 0.8, 2) * half
        sort = rng.choice(["box", "segment", "L", "eight"], p=[0.55, 0.15, 0.15, 0.15])
        if sort == "segment":
            axis = rng.integers(2)
            half[axis] = 0.0
            at[axis] = middle[axis] + rng.uniform(-1, 1) * span
        corners = np.round([at - half, at + half], 2)
        regions.append(_region(sort, corners))
        boxes.append(corners)
    return WideTask(rows, tuple(regions), np.array(boxes), spans)


def _region(sort, corners):
    """A region that holds a box (2, 2): itself, with an arm, or with a tip on each side."""
    (x0, y0), (x1, y1) = corners
    if sort == "segment":
        return corners
    if sort == "L":
        x2, y2 = 2 * x1 - x0, (y0 + y1) / 2
        return np.array([(x0, y0), (x2, y0), (x2, y2), (x1, y2), (x1, y1), (x0, y1)])
    box = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    if sort == "box":
        return np.array(box)
    middle, half = (corners[0] + corners[1]) / 2, (corners[1] - corners[0]) / 2
    tips = middle + 1.3 * half * np.array([(0, -1), (1, 0), (0, 1), (-1, 0)])
    return np.stack([box, tips], axis=1).reshape(8, 2)


def _rows(at, angle):
    """Poses from places (N,), complex, and angles; the first is 0, 0, 0; rounded."""
    at, angle = (at - at[0]) * np.exp(-1j * angle[0]), angle - angle[0]
    degrees = np.degrees(angle).round(2)
    return np.column_stack([at.real.round(2), at.imag.round(2), np.radians(degrees)])


def _box(rng, centre, size):
    half = size * rng.uniform(0.6, 1.4, 2) / 2
    corner = np.array([centre.real, centre.imag])
    return np.round([corner - half, corner + half], 1)


def _shares(rng, count):
    """Where along the motion the poses are: the ends, and others apart from each other."""
    while True:
        inside = np.sort(rng.uniform(0.15, 0.85, count - 2))
        shares = np.concatenate([[0.0], inside, [1.0]])
        if np.diff(shares).min() > 0.12:
            return shares


def _free(rng, count, own):
    span, turn = rng.uniform(*SPAN), np.radians(rng.uniform(*TURN)) * rng.choice([-1, 1])
    fine = np.linspace(0, 1, 401)
    path = np.cumsum(np.exp(1j * (rng.uniform(-np.pi, np.pi) + rng.uniform(-2.5, 2.5) * fine)))
    shares = _shares(rng, count)
    at = path[(400 * shares).astype(int)]
    at = at * span / np.hypot(np.ptp(at.real), np.ptp(at.imag))
    rows = _rows(at, turn * shares ** rng.uniform(0.6, 1.6))
    middle = complex(*rows[:, :2].mean(axis=0))

    def boxes():
        way = [np.exp(1j * rng.uniform(-np.pi, np.pi)) for _ in range(2)]
        fixed = _box(
            rng, middle + rng.uniform(0, 1.0) * span * way[0], span * rng.uniform(0.5, 2.5)
        )
        moving = _box(rng, rng.uniform(0, 0.7) * span * way[1], span * rng.uniform(0.4, 1.6))
        return fixed, moving

    return FewPoseTask("free", rows, tuple(boxes() for _ in range(1 + own)), 0.0)


def _led(rng, count, own):
    """Poses of a random four-bar, driven from its first link; None if it is no good."""
    c1, c2, p1, p2 = rng.normal(size=(4, 2)) @ [1, 1j]
    r1, r2, arm, ground = abs(p1 - c1), abs(p2 - c2), abs(p2 - p1), abs(c2 - c1)
    links = np.array([r1, r2, arm, ground])
    if links.max() > RATIO * links.min():
        return None
    crank = np.angle(p1 - c1) + rng.choice([-1, 1]) * np.linspace(0, rng.uniform(0.3, 2.8), 300)
    pin = c1 + r1 * np.exp(1j * crank)
    away = c2 - pin
    cosine = (arm**2 + r2**2 - abs(away) ** 2) / (2 * arm * r2)
    if abs(cosine).max() > MADE_WITH:
        return None
    along = (arm**2 - r2**2 + abs(away) ** 2) / (2 * abs(away))
    across = np.sqrt(arm**2 - along**2) * np.sign((np.conj(away[0]) * (p2 - pin[0])).imag)
    hand = np.unwrap(np.angle((along + 1j * across) * away / abs(away)))
    turn = hand - hand[0]
    if not (np.diff(turn) * np.sign(turn[-1]) > 0).all() or not (
        np.radians(TURN[0]) < abs(turn[-1]) < np.radians(TURN[1])
    ):
        return None
    origin = pin[0] + rng.normal(size=2) @ [0.6, 0.6j]  # of M, beside the coupler
    at = pin + (origin - pin[0]) * np.exp(1j * turn)
    index = (299 * _shares(rng, count)).astype(int)
    travel = np.hypot(np.ptp(at[index].real), np.ptp(at[index].imag))
    if travel < 0.3 * links.mean():
        return None
    scale = rng.uniform(*SPAN) / travel
    rows = _rows(at[index] * scale, turn[index])
    pivots = np.array([c1 - at[0], p1 - at[0], c2 - at[0], p2 - at[0]]) * scale
    size = travel * scale

    def around(*points):
        """A box that holds the points, somewhere inside."""
        corners = np.array([[p.real, p.imag] for p in points])
        low, high = corners.min(axis=0), corners.max(axis=0)
        margin = size * rng.uniform(0.05, 0.5, (2, 2))
        return np.round([low - margin[0], high + margin[1]], 1)

    c1, m1, c2, m2 = pivots
    boxes = (
        ((around(c1), around(m1)), (around(c2), around(m2)))
        if own
        else ((around(c1, c2), around(m1, m2)),)
    )
    return FewPoseTask("led", rows, boxes, float(np.degrees(np.arccos(abs(cosine).max()))))
