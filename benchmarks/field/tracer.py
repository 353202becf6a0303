"""Drives a four-bar joint by joint and says how near it comes to poses, on one branch and in order.

It belongs to none of the tools and shares no code with them.  One ground joint drives, in small
steps; where the other dyad then holds the body is the intersection of two circles, of a circle and
a line, or of two lines.  A branch is a range of the drive over which that intersection neither
ends nor turns over.  Near each pose the drive is searched further, by sections.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np

from benchmarks.field.linkage import Dyad, FourBar
from benchmarks.field.task import FieldTask

STEPS = 1440  # of a turn, or of the way that a slider is followed
SLIDE = 2.0  # spans that a sliding drive is followed beyond the poses
EDGE = 12  # steps more towards each end of a branch, closer and closer
SECTIONS = 34  # of the search for the nearest place; each shortens it to 0.62
CUTS = 64  # at most, of a full turn into "first to last"
SHUT = 1e-10  # of the gate: below it two places are one, and rounding decides
LOOSE = 1e-9  # of a link's square: nearer to each other two links are one, and hold nothing
BETWEEN = 21  # places from one crank angle to the next, both included
GOLDEN = (np.sqrt(5) - 1) / 2
BULGE = 0.5  # of the spacing of points: a curve that leaves their path by less follows it


def held(
    driver: Dyad, follower: Dyad, at: np.ndarray, sheet: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Places d (*,), angles phi (*,) and the gate (*,), negative where it cannot be put together.

    `at` is the drive's coordinate: a link's angle, a slider's way, a slot's angle in M.  The two
    sheets are the two intersections.
    """
    if driver.kind == "RP":
        return _slot_drives(driver, follower, at, sheet)
    if driver.kind == "RR":
        pin = driver.fixed + driver.size * np.exp(1j * at)
    else:
        pin = (driver.size + 1j * at) * np.exp(1j * driver.normal)
    # The body turns about the pin: Re(z exp(i phi)) = e.
    normal = np.exp(1j * follower.normal)
    if follower.kind == "RR":
        to, arm = pin - follower.fixed, follower.moving - driver.moving
        z, e = np.conj(to) * arm, (follower.size**2 - abs(to) ** 2 - abs(arm) ** 2) / 2
        z = np.where(abs(z) > LOOSE * follower.size**2, z, 0)
    elif follower.kind == "PR":
        z = np.conj(normal) * (follower.moving - driver.moving) + 0 * pin
        e = follower.size - (np.conj(normal) * pin).real
    else:
        z = np.conj(follower.fixed - pin) * normal
        e = follower.size - (np.conj(normal) * driver.moving).real + 0 * pin.real
    with np.errstate(divide="ignore", invalid="ignore"):
        cosine = np.where(abs(z) > 0, e / abs(z), np.inf)
    opening = np.arccos(np.clip(cosine, -1, 1))
    phi = -np.angle(z) + (opening if sheet == 0 else -opening)
    return pin - np.exp(1j * phi) * driver.moving, phi, 1 - abs(cosine)


def _slot_drives(
    driver: Dyad, follower: Dyad, at: np.ndarray, sheet: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The same where a slot drives: it turns the body, which slides along until it is held."""
    turn, along = np.exp(1j * at), np.exp(1j * (at + driver.normal))
    start = driver.fixed - along * driver.size  # d = start - i t along
    normal = np.exp(1j * follower.normal)
    if follower.kind == "RR":
        to = start + turn * follower.moving - follower.fixed
        half = (np.conj(to) * 1j * along).real
        room = half**2 - abs(to) ** 2 + follower.size**2
        root = np.sqrt(np.maximum(room, 0))
        slid = half + (root if sheet == 0 else -root)
        gate = room / follower.size**2
    else:
        if follower.kind == "PR":
            slope = (np.conj(normal) * 1j * along).real
            rest = (np.conj(normal) * (start + turn * follower.moving)).real - follower.size
        else:
            back = np.conj(normal * turn)
            slope = (back * 1j * along).real
            rest = follower.size - (back * (follower.fixed - start)).real
        with np.errstate(divide="ignore", invalid="ignore"):
            slid = np.where(slope != 0, rest / slope, 0.0)
        gate = slope if sheet == 0 else -slope  # where it changes sign the body is out of reach
    return start - 1j * slid * along, at + 0 * slid, gate


@dataclass(frozen=True, slots=True)
class Branch:
    """A range of the drive that is travelled without a dead point.

    at: (K,) the drive's coordinate, ascending.  closed: it is a full turn.
    """

    driver: Dyad
    follower: Dyad
    sheet: int
    at: np.ndarray
    closed: bool

    def body(self, at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        d, phi, _ = held(self.driver, self.follower, at, self.sheet)
        return d, phi


def branches(driver: Dyad, follower: Dyad, task: FieldTask) -> Iterator[Branch]:
    """Every branch of a four-bar that one of its ground joints drives."""
    turning = driver.kind != "PR"
    if turning:
        at = np.linspace(0, 2 * np.pi, STEPS + 1)
    else:
        along = task.places * np.exp(-1j * driver.normal)
        reach = abs(driver.moving) + SLIDE * task.span
        at = np.linspace(along.imag.min() - reach, along.imag.max() + reach, STEPS + 1)
    for sheet in (0, 1):

        def gate(where: np.ndarray, sheet: int = sheet) -> np.ndarray:
            return held(driver, follower, where, sheet)[2] - SHUT

        fine = _with_narrow_places(gate, at)
        is_open = gate(fine) > 0
        if is_open.all() and turning:
            yield Branch(driver, follower, sheet, fine[:-1], True)
            continue
        if turning and is_open[0]:  # begin where it is shut
            shut = int(np.argmin(is_open))
            fine = np.concatenate([fine[shut:-1], fine[: shut + 1] + 2 * np.pi])
            is_open = gate(fine) > 0
        edges = np.flatnonzero(np.diff(np.concatenate([[False], is_open, [False]]).astype(int)))
        for begin, end in edges.reshape(-1, 2):
            inside = fine[begin:end]
            near = [inside]
            if begin > 0:
                near.append(_towards(gate, inside[0], fine[begin - 1]))
            if end < len(fine):
                near.append(_towards(gate, inside[-1], fine[end]))
            yield Branch(driver, follower, sheet, np.unique(np.concatenate(near)), False)


def _with_narrow_places(gate, at: np.ndarray) -> np.ndarray:
    """The steps, and the least and greatest values of the gate between them where they decide."""
    value = gate(at)
    middle = value[1:-1]
    least = (middle < value[:-2]) & (middle <= value[2:]) & (middle > 0)
    most = (middle > value[:-2]) & (middle >= value[2:]) & (middle < 0)
    more = []
    for chosen, sign in ((least, 1.0), (most, -1.0)):
        where = np.flatnonzero(chosen) + 1
        if len(where):
            more.append(_least(lambda x, s=sign: s * gate(x), at[where - 1], at[where + 1]))
    return np.unique(np.concatenate([at, *more]))


def _towards(gate, inside: float, outside: float) -> np.ndarray:
    """Steps from an open place towards the last one before a shut place, found by bisection."""
    begin = inside
    for _ in range(50):
        middle = (inside + outside) / 2
        if gate(np.array([middle]))[0] > 0:
            inside = middle
        else:
            outside = middle
    return begin + (inside - begin) * (1 - np.linspace(1, 0, EDGE) ** 2)


def _least(value, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Where functions are least between bounds (*,), by golden sections."""
    a, b = low.astype(float).copy(), high.astype(float).copy()
    c, d = b - GOLDEN * (b - a), a + GOLDEN * (b - a)
    at_c, at_d = value(c), value(d)
    for _ in range(SECTIONS):
        left = at_c < at_d
        a, b = np.where(left, a, c), np.where(left, d, b)
        c, d = b - GOLDEN * (b - a), a + GOLDEN * (b - a)
        at_c, at_d = value(c), value(d)
    return np.where(at_c < at_d, c, d)


def missed(task: FieldTask, pose: np.ndarray, d: np.ndarray, phi: np.ndarray) -> np.ndarray:
    """How far poses are missed, in spans: the most that a point of the task's disc is off.

    pose, d, phi: broadcast together; the index of the pose, and places of the body.
    """
    out = abs(d - task.places[pose])
    if not task.is_path:
        out = out + task.disc * abs(np.exp(1j * phi) - np.exp(1j * task.angles[pose]))
    return out / task.span


@dataclass(frozen=True, slots=True)
class Trace:
    """The greatest error over the poses, in spans, inf if it never comes near.

    anywhere: each pose wherever the linkage can be put together.
    one_branch: all poses on one branch of one drive.
    in_order: and one after the other, by a drive that never turns back.
    follows: for a path, whether they are met so within the tolerance and the curve between
    neighbouring points stays near their chord, as `strays` has it.
    A closed path takes a full turn of the drive; a path with crank angles is met at these; of a
    function the three errors are one.
    """

    anywhere: float
    one_branch: float
    in_order: float
    follows: bool = False


def trace(four_bar: FourBar, task: FieldTask) -> Trace:
    """How near a four-bar comes to the poses, the points or the angles of a task."""
    if task.is_function:
        return Trace(*3 * (_function_error(four_bar, task),))
    if task.crank is not None:
        return _timed(four_bar, task)
    count = len(task.rows)
    anywhere = np.full(count, np.inf)
    one_branch = in_order = np.inf
    follows = False
    pair = (four_bar.first, four_bar.second)
    for driver, follower in (pair, pair[::-1]):
        for branch in branches(driver, follower, task):
            refined, errors, nearest = _errors(branch, task)
            anywhere = np.minimum(anywhere, errors.min(axis=1))
            bound = errors.min(axis=1).max()
            one_branch = min(one_branch, bound)
            if task.closed and not branch.closed:
                continue
            away = strays(task, branch.body(refined)[0]) if task.is_path else errors
            turns = "and returns" if task.closed else "once" if branch.closed else "no"
            for part, gaps in _senses(refined, errors, away, nearest, turns):
                if bound < in_order:
                    in_order = min(in_order, _ascending(part))
                if task.is_path and not follows and bound <= task.tolerance:
                    follows = _reaches(part <= task.tolerance, gaps)
    return Trace(float(anywhere.max()), float(one_branch), float(in_order), follows)


def strays(task: FieldTask, curve: np.ndarray) -> np.ndarray:
    """Which places (K,) of a curve are too far from the chord of each gap of a path: (gaps, K).

    Too far is half the spacing of the points there (the longest of a gap's chord and its
    neighbours) and the tolerance.
    """
    begin, chord = task.way[:-1, None], np.diff(task.way)[:, None]
    size = abs(chord)
    along = (np.conj(chord) * (curve - begin)).real / np.maximum(size, 1e-300) ** 2
    away = abs(curve - begin - np.clip(along, 0, 1) * chord)
    beside = np.pad(size[:, 0], 1, mode="wrap" if task.closed else "edge")
    spacing = np.maximum(size[:, 0], np.maximum(beside[:-2], beside[2:]))
    return away > (BULGE * spacing + task.tolerance * task.span)[:, None]


def _errors(branch: Branch, task: FieldTask) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Drives (K,), errors (N, K) of every pose there, and drives where a pose is nearest."""
    at, poses = branch.at, np.arange(len(task.rows))[:, None]
    errors = missed(task, poses, *branch.body(at))
    if branch.closed:
        before, after = np.roll(errors, 1, axis=1), np.roll(errors, -1, axis=1)
        low = np.concatenate([[at[-1] - 2 * np.pi], at[:-1]])
        high = np.concatenate([at[1:], [at[0] + 2 * np.pi]])
    else:
        wall = np.full((len(errors), 1), np.inf)
        before = np.concatenate([wall, errors[:, :-1]], axis=1)
        after = np.concatenate([errors[:, 1:], wall], axis=1)
        low = np.concatenate([at[:1], at[:-1]])
        high = np.concatenate([at[1:], at[-1:]])
    pose, step = np.nonzero((errors <= before) & (errors <= after))
    nearest = _least(lambda x: missed(task, pose, *branch.body(x)), low[step], high[step])
    if branch.closed:
        nearest = nearest % (2 * np.pi)
    refined = np.unique(np.concatenate([at, nearest]))
    return refined, missed(task, poses, *branch.body(refined)), np.unique(nearest)


def _senses(
    at: np.ndarray,
    errors: np.ndarray,
    others: np.ndarray,
    nearest: np.ndarray,
    turns: Literal["no", "once", "and returns"],
) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Errors (N, K) and other rows (·, K) along the drive, in both senses, from every cut.

    turns: whether the drive turns fully, and if it has to come back to the first row, which is the
    last one then as well.
    """
    shifts = [0]
    returns = turns == "and returns"
    if returns:
        first = errors[0]
        low = (first <= np.roll(first, 1)) & (first <= np.roll(first, -1))
        starts = np.flatnonzero(low)
        shifts = [-int(k) for k in starts[np.argsort(first[starts], kind="stable")][:CUTS]]
        errors = np.concatenate([errors, errors[:1]])
    elif turns == "once":
        # A turn has no beginning: it is cut between places where poses are nearest, wide gaps
        # first.
        gaps = np.diff(np.concatenate([nearest, nearest[:1] + 2 * np.pi]))
        chosen = np.argsort(-gaps, kind="stable")[:CUTS]
        cuts = (nearest + gaps / 2)[chosen] % (2 * np.pi)
        shifts = [-int(np.searchsorted(at, cut)) for cut in cuts]
    for shift in shifts:
        a, b = np.roll(errors, shift, axis=1), np.roll(others, shift, axis=1)
        if returns:
            a, b = (np.concatenate([rows, rows[:, :1]], axis=1) for rows in (a, b))
        yield a, b
        yield a[:, ::-1], b[:, ::-1]


def _reaches(near: np.ndarray, away: np.ndarray) -> bool:
    """Whether places k1 <= k2 <= ... are near, one for each row (N, K), and none between is away.

    away: (N - 1, K), a row for the places from one k to the next.
    """
    number = np.arange(near.shape[1])
    here = near[0]
    for row, gap in zip(near[1:], away, strict=True):
        last = np.maximum.accumulate(np.where(here & ~gap, number, -1))
        barred = np.maximum.accumulate(np.where(gap, number, -1))
        here = row & (last > barred)
    return bool(here.any())


def _ascending(errors: np.ndarray) -> float:
    """The least greatest error of places k1 <= k2 <= ..., one for each row of errors (N, K)."""
    best = errors[0]
    for row in errors[1:]:
        best = np.maximum(np.minimum.accumulate(best), row)
    return float(best.min())


def _timed(four_bar: FourBar, task: FieldTask) -> Trace:
    """How near the points of a path are at their crank angles, the best begin of the crank taken.

    The curve follows the path if it does at places between neighbouring crank angles as well.
    """
    assert task.crank is not None
    turned, best, follows = task.crank, np.inf, False
    parts = np.linspace(turned[:-1], turned[1:], BETWEEN, axis=1)
    gap = np.arange(len(parts))
    pair = (four_bar.first, four_bar.second)
    for driver, follower in (pair, pair[::-1]):
        if driver.kind == "PR":
            continue  # it does not turn
        for branch in branches(driver, follower, task):

            def worst(begin: np.ndarray, branch: Branch = branch) -> np.ndarray:
                body = branch.body(begin[:, None] + turned)
                return missed(task, np.arange(len(turned)), *body).max(axis=1)

            begins, errors = _begins(branch, turned, worst)
            best = min(best, float(errors.min(initial=np.inf)))
            for begin in begins[errors <= task.tolerance]:
                away = strays(task, branch.body((begin + parts).ravel())[0])
                follows = follows or not away.reshape(len(away), *parts.shape)[gap, gap].any()
    return Trace(best, best, best, bool(follows))


def _function_error(four_bar: FourBar, task: FieldTask) -> float:
    """The greatest error of the output link, the first dyad's link the input, in output ranges.

    The zeros of both links are the best ones.  On the way the linkage stays on one branch.
    """
    first, second = four_bar.first, four_bar.second
    if first.kind != "RR" or second.kind != "RR":
        return np.inf
    inputs, outputs = task.rows.T
    best = np.inf
    for branch in branches(first, second, task):

        def worst(begin: np.ndarray, branch: Branch = branch) -> np.ndarray:
            d, phi = branch.body(begin[:, None] + inputs)
            made = np.angle(d + np.exp(1j * phi) * second.moving - second.fixed)
            return np.ptp(np.unwrap(made - outputs, axis=1), axis=1) / 2 / task.span

        best = min(best, float(_begins(branch, inputs, worst)[1].min(initial=np.inf)))
    return best


def _begins(
    branch: Branch, turned: np.ndarray, worst: Callable[[np.ndarray], np.ndarray]
) -> tuple[np.ndarray, np.ndarray]:
    """Begins (*,) of a drive that turns by given angles, and errors there, locally least."""
    low, high = branch.at[0] - turned.min(), branch.at[-1] - turned.max()
    if branch.closed:
        low, high = 0.0, 2 * np.pi
    if low >= high:
        return np.empty(0), np.empty(0)
    begins = np.linspace(low, high, STEPS + 1)
    wide = np.pad(worst(begins), 1, constant_values=np.inf)
    (least,) = np.nonzero(wide[1:-1] <= np.minimum(wide[:-2], wide[2:]))
    beside = begins[np.maximum(least - 1, 0)], begins[np.minimum(least + 1, STEPS)]
    refined = _least(worst, *beside)
    return refined, worst(refined)
