"""The verdict on one pair of RR dyads, by driving the linkage over a fine sweep of its input.

Shares no code with the closed forms: on which stretch of the input the linkage can be assembled is
seen, not computed, and so are the circuits, the branches, the order and the transmission angle.
"""

import numpy as np

from tests.oracles import witness

SWEEP = 14401  # input angles of one turn
NEAR = (
    1.5e-3  # radians of the input, or of the transmission angle; nearer, a verdict is not certain
)
NEAR_BOUND = 1e-3  # relative; a bound missed or met by less is not certain
NEAR_CHANGE = 1e-4  # of all links together; as near to a change point nothing is certain
CLASSES = ("works", "farther", "below", "order", "branch", "circuit")


def verdict(pair, poses, span, areas=None):
    """The class of a pair by its better driver, and the least transmission angle in degrees.

    The standard is that of a task that asks for nothing.  areas: two corners each of the boxes in
    which fixed and moving pivots are assumed.  None where it is too close to call.
    """
    sides = [driven(*way, poses) for way in (pair, pair[::-1])]
    if any(side is None for side in sides):
        return None
    sound = _proportions(pair, span)
    if sound is None:
        return None
    told = []
    for name, angle in sides:
        if abs(angle - 30) < 0.1 or angle < np.degrees(NEAR):
            return None
        if name != "works":
            own = name
        elif not (sound and angle > 30):
            own = "below"
        else:
            own = "works" if areas is None or _inside(pair, areas) else "farther"
        told.append((CLASSES.index(own), -np.nan_to_num(angle), angle))
    best = min(told)
    return CLASSES[best[0]], best[2]


def _inside(pair, areas):
    """Whether both fixed and both moving pivots are in their boxes."""
    return all(
        low[k] <= point[k] <= high[k]
        for dyad in pair
        for point, (low, high) in zip((dyad.fixed_pivot, dyad.moving_pivot), areas, strict=True)
        for k in range(2)
    )


def driven(first, second, poses):
    """The class with one driver, and the angle; None where it is too close to call."""
    d = poses.translation[:, 0] + 1j * poses.translation[:, 1]
    pin = d + np.exp(1j * poses.angle) * complex(*first.moving_pivot)
    drive = np.angle(pin - complex(*first.fixed_pivot))
    side = _assembly(first, second, drive, d, poses.angle)
    sweep = np.linspace(-np.pi, np.pi, SWEEP)
    closed = sweep[~np.isfinite(witness.places(first, second, sweep)[1][0])]
    circuit = side
    if len(closed):
        # Each pose lies between two inputs at which nothing can be assembled.
        circuit = np.searchsorted(closed, drive) % len(closed)
        ahead = np.mod(closed[circuit] - drive, 2 * np.pi)
        behind = np.mod(drive - closed[circuit - 1], 2 * np.pi)
        if min(ahead.min(), behind.min()) < NEAR:
            return None
    for name, numbers in (("circuit", circuit), ("branch", side)):
        if len(set(numbers.tolist())) > 1:
            return name, np.nan
    ways = [closed[circuit[0]] - ahead] if len(closed) else _round(drive)
    ways = sorted((way for way in ways if _monotonic(way)), key=np.ptp)
    extents = [np.ptp(way) for way in ways]
    steps = np.abs([np.diff(way) for way in ways])
    if (steps < NEAR).any() or (np.abs(np.diff(extents)) < NEAR).any():
        return None
    if not ways:
        return "order", np.nan
    inputs = np.append(np.linspace(ways[0].min(), ways[0].max(), SWEEP), drive)
    return "works", _least_angle(first, second, inputs, side[0])


def _least_angle(first, second, inputs, side):
    """The least angle in degrees between coupler and second link over inputs."""
    where, phi = (each[side] for each in witness.places(first, second, inputs))
    hands = [where + np.exp(1j * phi) * complex(*dyad.moving_pivot) for dyad in (first, second)]
    force, lever = hands[1] - hands[0], hands[1] - complex(*second.fixed_pivot)
    sine = np.abs((np.conj(force) * lever).imag) / (np.abs(force) * np.abs(lever))
    return float(np.degrees(np.arcsin(np.clip(np.nanmin(sine), 0, 1))))


def _assembly(first, second, drive, d, angle):
    """On which of the two assemblies (0 or 1) the linkage is at each pose."""
    where, phi = witness.places(first, second, drive)
    far = np.abs(where - d) + np.abs(np.exp(1j * phi) - np.exp(1j * angle))
    return np.argmin(np.where(np.isfinite(far), far, np.inf), axis=0)


def _round(drive):
    """The inputs once round the circle in either sense; in both they may take more than a turn."""
    for sense in (1, -1):
        step = np.mod(sense * np.diff(drive), 2 * np.pi)
        way = np.append(0.0, np.cumsum(step))
        if way[-1] <= 2 * np.pi:
            yield drive[0] + sense * way


def _monotonic(way):
    """Whether inputs rise throughout, or fall throughout."""
    step = np.diff(way)
    return (step > 0).all() or (step < 0).all()


def _proportions(pair, span):
    """Whether the four links are as a task that asks for nothing wants them; None if unclear."""
    (a, b), (c, m) = pair, zip(*((x.fixed_pivot, x.moving_pivot) for x in pair), strict=True)
    links = [np.hypot(*(c[1] - c[0])), np.hypot(*(m[1] - m[0])), float(a.radius), float(b.radius)]
    low, high = min(links), max(links)
    ordered = np.sort(links)
    # Grashof's sum and the two others with the shortest link in them; all vanish at change points.
    sums = [abs(ordered[0] + ordered[k] - (ordered[1:].sum() - ordered[k])) for k in (1, 2, 3)]
    if min(sums) < NEAR_CHANGE * sum(links):
        return None  # two stretches of the input may be nearer to each other than two samples
    bounds = [
        (10 * low, high),
        (low, 0.05 * span),
        (10 * span, high),
        (min(sums), 1e-3 * sum(links)),
    ]
    if any(abs(x / y - 1) < NEAR_BOUND for x, y in bounds):
        return None
    return all(x >= y for x, y in bounds)
