"""What SciPy's solvers are given: closure equations of dyads, and the way from poses to a linkage.

Lengths are in spans, about the middle of the poses; angles count by the task's disc.  Shared by
`scipy_starts` and `evolution`.
"""

from __future__ import annotations

import numpy as np

from benchmarks.field.linkage import Dyad, FourBar, Kind
from benchmarks.field.task import DISC, FieldTask, Pivots

SIZE: dict[Kind, int] = {"RR": 5, "PR": 4, "RP": 4}
ROUNDS = 4  # of Newton's method from a pose to the linkage's nearest place


class Scaled:
    """A task in spans about the middle of its positions."""

    def __init__(self, task: FieldTask) -> None:
        self.middle, self.span = task.places.mean(), task.span
        self.places = (task.places - self.middle) / self.span
        self.angles = np.zeros(len(task.rows)) if task.is_path else task.angles
        self.turn = np.exp(1j * self.angles)
        self.pivots: Pivots | None = None
        if task.pivots is not None:
            a, b = ((place - self.middle) / self.span for place in task.pivots.places)
            self.pivots = Pivots(task.pivots.kind, (complex(a), complex(b)))

    def dyad(self, kind: Kind, x: np.ndarray) -> Dyad:
        """Parameters of a dyad in the units of the task."""
        s, m = self.span, self.middle
        if kind == "RR":
            fixed, moving = m + s * complex(x[0], x[1]), s * complex(x[2], x[3])
            return Dyad("RR", complex(fixed), moving, float(s * abs(x[4])))
        if kind == "PR":
            offset = s * x[1] + (np.exp(-1j * x[0]) * m).real
            return Dyad("PR", 0j, s * complex(x[2], x[3]), float(offset), float(x[0]))
        return Dyad("RP", complex(m + s * complex(x[2], x[3])), 0j, float(s * x[1]), float(x[0]))

    def four_bar(self, kinds: tuple[Kind, Kind], x: np.ndarray) -> FourBar:
        cut = SIZE[kinds[0]]
        return FourBar(self.dyad(kinds[0], x[:cut]), self.dyad(kinds[1], x[cut:]))


def equation(
    kind: Kind, x: np.ndarray, d: np.ndarray, turn: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """A dyad's equation at places (N,), a length, and its gradient (N, 3) by x, y and angle.

    Parameters: RR both pivots and the length; PR normal, offset, moving pivot; RP normal, offset,
    fixed pivot.
    """
    if kind == "RR":
        arm = turn * complex(x[2], x[3])
        to = d + arm - complex(x[0], x[1])
        away = np.maximum(abs(to), 1e-12)
        force, value = to / away, away - abs(x[4])
        return value, np.stack([force.real, force.imag, (np.conj(force) * 1j * arm).real], axis=-1)
    if kind == "PR":
        force, arm = np.exp(1j * x[0]), turn * complex(x[2], x[3])
        value = (np.conj(force) * (d + arm)).real - x[1]
        by_angle = (np.conj(force) * 1j * arm).real
        ones = np.ones(len(d))
        return value, np.stack([force.real * ones, force.imag * ones, by_angle], axis=-1)
    force, to = turn * np.exp(1j * x[0]), complex(x[2], x[3]) - d
    value = (np.conj(force) * to).real - x[1]
    return value, np.stack([-force.real, -force.imag, (np.conj(1j * force) * to).real], axis=-1)


def by_parameters(kind: Kind, x: np.ndarray, d: np.ndarray, turn: np.ndarray) -> np.ndarray:
    """The derivatives (N, 5) or (N, 4) of that equation by the dyad's parameters."""
    if kind == "RR":
        to = d + turn * complex(x[2], x[3]) - complex(x[0], x[1])
        force = to / np.maximum(abs(to), 1e-12)
        by = np.conj(force) * turn
        sign = np.full(len(d), -np.sign(x[4]) if x[4] else -1.0)
        return np.stack([-force.real, -force.imag, by.real, -by.imag, sign], axis=-1)
    ones = np.ones(len(d))
    if kind == "PR":
        normal = np.exp(1j * x[0])
        at = d + turn * complex(x[2], x[3])
        by = np.conj(normal) * turn
        return np.stack([(np.conj(1j * normal) * at).real, -ones, by.real, -by.imag], axis=-1)
    force = turn * np.exp(1j * x[0])
    to = complex(x[2], x[3]) - d
    return np.stack([(np.conj(1j * force) * to).real, -ones, force.real, force.imag], axis=-1)


def nearest_places(
    kinds: tuple[Kind, Kind], x: np.ndarray, scaled: Scaled
) -> tuple[np.ndarray, np.ndarray]:
    """Places d and angles (N,) of a linkage near the poses: the shortest steps from them."""
    cut = SIZE[kinds[0]]
    d, angle = scaled.places, scaled.angles
    weight = np.array([1.0, 1.0, 1 / DISC])  # an angle is a length on the disc
    for _ in range(ROUNDS):
        turn = np.exp(1j * angle)
        value, rows = zip(
            equation(kinds[0], x[:cut], d, turn),
            equation(kinds[1], x[cut:], d, turn),
            strict=True,
        )
        a, b = rows[0] * weight, rows[1] * weight
        aa, ab, bb = (a * a).sum(1), (a * b).sum(1), (b * b).sum(1)
        room = np.maximum(aa * bb - ab * ab, 1e-9 * aa * bb + 1e-300)
        p = (value[0] * bb - value[1] * ab) / room
        q = (value[1] * aa - value[0] * ab) / room
        step = (a * p[:, None] + b * q[:, None]) * weight
        size = np.maximum(1.0, np.abs(step).max(axis=1, keepdims=True))
        step = step / size
        d, angle = d - (step[:, 0] + 1j * step[:, 1]), angle - step[:, 2]
    return d, angle


def pose_errors(kinds: tuple[Kind, Kind], x: np.ndarray, scaled: Scaled) -> np.ndarray:
    """(3 N,) by how much the places of a linkage miss the poses, and the poses the linkage."""
    d, angle = nearest_places(kinds, x, scaled)
    away = d - scaled.places
    return np.concatenate([away.real, away.imag, DISC * (angle - scaled.angles)])


def runs_well(kinds: tuple[Kind, Kind], x: np.ndarray, scaled: Scaled) -> bool:
    """Whether one of the ground joints turns one way and never locks at the places by the poses."""
    cut = SIZE[kinds[0]]
    d, angle = nearest_places(kinds, x, scaled)
    turn = np.exp(1j * angle)
    parts = ((kinds[0], x[:cut]), (kinds[1], x[cut:]))
    for drive, held in (parts, parts[::-1]):
        _, by_drive = equation(*drive, d, turn)
        _, by_held = equation(*held, d, turn)
        drives, lever = _drive(*drive, d, turn)
        locks = np.linalg.det(np.stack([by_drive, by_held, lever], axis=1))
        steps = np.diff(np.unwrap(drives) if drive[0] != "PR" else drives)
        same = (locks > 0).all() or (locks < 0).all()
        if same and ((steps > 0).all() or (steps < 0).all()) and abs(steps.sum()) < 2 * np.pi:
            return True
    return False


def _drive(
    kind: Kind, x: np.ndarray, d: np.ndarray, turn: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """The coordinate of a dyad's ground joint at places, and its gradient (N, 3)."""
    if kind == "RP":
        return np.angle(turn), np.tile([0.0, 0.0, 1.0], (len(d), 1))
    arm = turn * complex(x[2], x[3])
    if kind == "PR":
        along = 1j * np.exp(1j * x[0]) * np.ones(len(d))
        coordinate = (np.conj(along) * (d + arm)).real
    else:
        to = d + arm - complex(x[0], x[1])
        along = 1j * to / np.maximum(abs(to), 1e-12)
        coordinate = np.angle(to)
    lever = np.stack([along.real, along.imag, (np.conj(along) * 1j * arm).real], axis=-1)
    return coordinate, lever


class Free:
    """Which parameters of a dyad are free: x = base + free values @ ways, between bounds.

    A limit on the ground pivot of a link or a slot is a bound (a box), one coordinate along a line,
    or no coordinate at all.
    """

    def __init__(self, kind: Kind, pivots: Pivots | None, which: int = 0) -> None:
        size, at = SIZE[kind], 2 if kind == "RP" else 0
        self.base, self.ways = np.zeros(size), np.eye(size)
        self.low, self.high = np.full(size, -np.inf), np.full(size, np.inf)
        if pivots is None:
            return
        a, b = pivots.places
        if pivots.kind == "box":
            self.low[at : at + 2], self.high[at : at + 2] = (a.real, a.imag), (b.real, b.imag)
            return
        here = (a, b)[which] if pivots.kind == "points" else a
        self.base[at : at + 2] = here.real, here.imag
        keep = [k for k in range(size) if k not in (at, at + 1)]
        ways = np.eye(size)[keep]
        if pivots.kind == "line":
            along = np.zeros((1, size))
            along[0, at : at + 2] = (b - a).real, (b - a).imag
            ways = np.concatenate([along, ways])
        self.ways = ways
        self.low, self.high = np.full(len(ways), -np.inf), np.full(len(ways), np.inf)

    @property
    def bounded(self) -> bool:
        return bool(np.isfinite(self.low).any())

    def full(self, u: np.ndarray) -> np.ndarray:
        return self.base + u @ self.ways

    def inside(self, x: np.ndarray) -> np.ndarray:
        """The free values of parameters, moved into the bounds."""
        u = np.linalg.lstsq(self.ways.T, x - self.base, rcond=None)[0]
        room = np.where(np.isfinite(self.high - self.low), 1e-9 * (self.high - self.low), 0.0)
        return np.clip(u, self.low + room, self.high - room)


def point_errors(x: np.ndarray, angles: np.ndarray, scaled: Scaled) -> np.ndarray:
    """(2 N,) from the points of a path to where two links hold the body, turned by given angles."""
    turn, d = np.exp(1j * angles), scaled.places
    for _ in range(ROUNDS):
        f, a = equation("RR", x[:5], d, turn)
        g, b = equation("RR", x[5:], d, turn)
        det = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
        det = np.where(abs(det) < 1e-3, 1e-3 * np.where(det < 0, -1, 1), det)
        step = (f * b[:, 1] - g * a[:, 1]) / det + 1j * (g * a[:, 0] - f * b[:, 0]) / det
        d = d - step / np.maximum(1.0, abs(step))
    away = d - scaled.places
    return np.concatenate([away.real, away.imag])
