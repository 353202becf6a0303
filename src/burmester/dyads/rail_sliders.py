"""The best sliders on a rail: its direction, what it passes through, the travel of the pin.

At a given direction of the line the distances are linear in the pin and the line's offset, and so
are all conditions: a small quadratic program.  The direction is tried at every degree that the rail
allows, and from each local minimum among these Gauss-Newton steps, each such a program, lead on.
"""

from __future__ import annotations

from typing import Final, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.dyad import PR, RP
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Point, Polygon, Region, half_planes
from burmester.numerics.arrays import FloatArray, unique_rows
from burmester.numerics.quadratic_program import SoftProgram
from burmester.tasks.limits import Limits
from burmester.tasks.rails import Rail

SPACING: Final = np.radians(1.0)  # radians; directions are tried at most so far apart
STEPS: Final = 40  # number of Gauss-Newton steps
STIFFNESS: Final = (
    1e5  # what a violated condition costs, per length; a program's multipliers are below
)
RIDGE: Final = 1e-7  # keeps what no pose determines small
KEPT: Final = 1e-7  # lengths or radians; a condition violated by less is kept
SAME: Final = 1e-6  # lengths or radians; sliders that differ by less are one
DIRECTIONS: Final = 7  # number of directions of lines all over a rail
MAX_PLACES: Final = 9  # number of points that such lines pass through
ROUNDS: Final = 12  # how often poses whose pins leave the travel join those that are looked at


class _RailFit(NamedTuple):
    """What is fitted: poses (N,), weights (N,), exact poses (N,), and conditions as rows.

    travel, pivot: (m, 3), products with (1, X, Y) are at most 0; the first `equations` of pivot
    are 0.  watched: the poses at which the travel is looked at.
    """

    poses: Displacement
    weights: FloatArray
    exact: NDArray[np.bool_]
    rail: Rail
    travel: FloatArray
    pivot: FloatArray
    equations: int
    watched: NDArray[np.intp]

    @classmethod
    def of(
        cls,
        poses: Displacement,
        rail: Rail,
        region: Region | None,
        share: FloatArray,
        exact: NDArray[np.bool_],
    ) -> Self:
        travel = _rows(rail.travel)[len(rail.travel.equations()) :] if rail.travel else _rows(None)
        number = 0 if region is None else len(region.equations())
        loose = np.where(exact, 0.0, share)
        some = np.flatnonzero(exact)[:4] if exact.any() else np.arange(min(2, len(share)))
        return cls(poses, loose, exact, rail, travel, _rows(region), number, some)

    def steps(
        self,
        z: FloatArray,
        turn: tuple[FloatArray, FloatArray] | None,
        damping: FloatArray | float = 0.0,
    ) -> FloatArray:
        """Gauss-Newton steps (k, 4) of sliders z (k, 4) within linearised conditions.

        turn: the least and the greatest turn (k,) of the normal; None leaves the direction.
        """
        normal, across = _directions(z[:, 0])
        pins = self.poses.act(z[:, None, 2:])
        in_body = self.poses.inverse().rotate(normal[:, None])  # (k, N, 2)
        distance = (pins * normal[:, None]).sum(axis=-1) - z[:, 1:2]
        slope = (pins * across[:, None]).sum(axis=-1)
        jacobian = np.concatenate([slope[..., None], -np.ones((*slope.shape, 1)), in_body], axis=-1)
        value, rows, equal = [distance[:, self.exact]], [jacobian[:, self.exact]], []
        equal += [True] * int(self.exact.sum())

        def add(number: FloatArray, row: FloatArray, *, is_equation: bool = False) -> None:
            value.append(number[:, None])
            rows.append(row[:, None])
            equal.append(is_equation)

        def row_of(angle: FloatArray | float, offset: float, point: FloatArray) -> FloatArray:
            out = np.zeros((len(z), 4))
            out[:, 0], out[:, 1], out[:, 2:] = angle, offset, point
            return out

        if (anchors := self.rail.anchors) is not None:
            off, along = z[:, 1:2] - normal @ anchors.T, across @ anchors.T
            if len(anchors) == 1:
                add(off[:, 0], row_of(-along[:, 0], 1.0, np.zeros(2)), is_equation=True)
            else:
                for sign, end in ((1.0, off.argmin(axis=1)), (-1.0, off.argmax(axis=1))):
                    at = np.arange(len(z)), end
                    add(sign * off[at], sign * row_of(-along[at], 1.0, np.zeros(2)))
        for n in self.watched:
            for row in self.travel:
                pull = self.poses[n].inverse().rotate(row[1:])
                add(row[0] + pins[:, n] @ row[1:], row_of(0.0, 0.0, pull))
        for number, row in enumerate(self.pivot):
            at = row[0] + z[:, 2:] @ row[1:]
            add(at, row_of(0.0, 0.0, row[1:]), is_equation=number < self.equations)
        if turn is not None:
            add(turn[0], row_of(-1.0, 0.0, np.zeros(2)))
            add(-turn[1], row_of(1.0, 0.0, np.zeros(2)))
        weighted = jacobian * self.weights[:, None]
        hessian = np.swapaxes(weighted, 1, 2) @ jacobian
        damped = RIDGE + np.broadcast_to(np.asarray(damping), (len(z),))
        hessian += damped[:, None, None] * np.eye(4)
        gradient = (distance[:, None] @ weighted)[:, 0]
        values, slopes = np.concatenate(value, axis=1), np.concatenate(rows, axis=1)
        if turn is None:
            hessian, gradient, slopes = hessian[:, 1:, 1:], gradient[:, 1:], slopes[..., 1:]
        size = np.maximum(np.linalg.norm(slopes, axis=-1), 1e-300)  # all conditions alike
        low = np.where(equal, -STIFFNESS, 0.0) + np.zeros_like(values)
        high = np.full_like(values, STIFFNESS)
        parts = hessian, gradient, values / size, slopes / size[..., None], low, high
        step = SoftProgram(*map(np.ascontiguousarray, parts)).solved()[0]
        return np.pad(step, ((0, 0), (1, 0))) if turn is None else step

    def at_direction(self, z: FloatArray) -> FloatArray:
        """The best sliders (k, 4) with the directions of sliders z (k, 4)."""
        for _ in range(4):  # those after the first mend what the ridge has bent
            z = z + self.steps(z, None)
        return z

    def assessed(self, z: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Weighted sums of squared distances (k,) and greatest violations (k,) of sliders."""
        normal, _ = _directions(z[:, 0])
        pins = self.poses.act(z[:, None, 2:])
        distance = (pins * normal[:, None]).sum(axis=-1) - z[:, 1:2]
        line, equal = self.rail.line_excess(z[:, 0], z[:, 1])
        parts = [np.where(equal, np.abs(line), line), np.abs(distance[:, self.exact])]
        parts += [row[0] + pins[:, self.watched] @ row[1:] for row in self.travel]
        pivot = self.pivot[:, 0] + z[:, 2:] @ self.pivot[:, 1:].T
        parts.append(np.where(np.arange(len(self.pivot)) < self.equations, np.abs(pivot), pivot))
        violation = np.concatenate(parts, axis=1).max(axis=1, initial=0.0)
        return distance**2 @ self.weights, violation

    def leaving(self, z: FloatArray) -> NDArray[np.intp]:
        """The poses, not looked at so far, at which pins leave the travel by most."""
        if not len(self.travel) or not len(z):
            return np.empty(0, dtype=np.intp)
        pins = self.poses.act(z[:, None, 2:])
        beyond = (self.travel[:, 0] + pins @ self.travel[:, 1:].T).max(axis=-1)
        beyond[:, self.watched] = -np.inf
        worst = beyond.argmax(axis=1)
        return np.unique(worst[beyond.max(axis=1) > KEPT])


def sliders_on_rail(
    poses: Displacement,
    rail: Rail,
    region: Region | None,
    share: FloatArray,
    exact: NDArray[np.bool_],
) -> FloatArray:
    """The locally best sliders z (k, 4) on a rail: normal angle, offset, pin; the best first.

    poses: (N,); share: (N,), the weights; exact: (N,), the poses that are met exactly.  region: of
    the pin, in M.  Least are the squared distances, whatever the norm.  Of regions that are not
    convex the box around is taken; sliders that leave them are left out.
    """
    fit = _RailFit.of(poses, rail, region, share, exact)
    z, spacing = _over_directions(rail)
    free = spacing > 0
    found = z
    for _ in range(ROUNDS):
        start = fit.at_direction(z)
        found = _descended(fit, _least(fit, start), spacing) if free else start
        more = fit.leaving(found)
        if not len(more):
            break
        fit = fit._replace(watched=np.union1d(fit.watched, more))
    error, violation = fit.assessed(found)
    kept = violation < KEPT
    pins = found[:, None, 2:]
    for each, points in ((rail.travel, poses.act(pins)), (region, pins)):
        if isinstance(each, Polygon):
            kept &= (each.signed_distance(points) < KEPT).all(axis=-1)
    found = found[kept][np.argsort(error[kept], kind="stable")]
    return unique_rows(found, SAME, "maximum")


def sliders_along_rail(poses: Displacement, limits: Limits, share: FloatArray) -> list[PR | RP]:
    """The best sliders on lines all over the rail or slot of limits, in the frames of poses (N,).

    Where these meet the poses badly, they may yet make good linkages.
    """
    if (line := limits.line) is None:
        return []
    on_ground = limits.rail is not None
    seen = poses if on_ground else poses.inverse()
    region = limits.moving_pivot if on_ground else limits.fixed_pivot
    loose = np.zeros(poses.shape, dtype=bool)
    middle, within = line.heading or (0.0, np.pi / 2)
    headings = [middle] if not within else np.linspace(middle - within, middle + within, DIRECTIONS)
    places = [line.through]
    if line.anchors is not None and len(line.anchors) > 1:
        first, *others = line.anchors
        places = [Point(first + part * (to - first)) for to in others for part in (0.0, 0.5, 1.0)]
        places = places[:MAX_PLACES]
    rails = [line]
    if not line.is_thin:
        rails += [Rail(float(np.degrees(a)), 0, at, line.travel) for a in headings for at in places]
    found = [sliders_on_rail(seen, each, region, share, loose) for each in rails]
    z = unique_rows(np.concatenate(found), SAME, "maximum")
    if on_ground:
        return [PR(each[0], each[1], each[2:]) for each in z]
    return [RP(each[2:], each[0], each[1]) for each in z]


def _rows(region: Region | None) -> FloatArray:
    """The conditions (m, 3) of a region; of one that is not convex, those of the box around it."""
    if region is None:
        return np.empty((0, 3))
    rows = half_planes(region)
    if rows is None:
        assert isinstance(region, Polygon)
        (left, low), (right, high) = region.vertices.min(axis=0), region.vertices.max(axis=0)
        rows = np.array([[left, -1, 0], [-right, 1, 0], [low, 0, -1], [-high, 0, 1]])
    return rows


def _over_directions(rail: Rail) -> tuple[FloatArray, float]:
    """Sliders (k, 4) in all directions that a rail allows, and how far apart these are."""
    if rail.heading is None:
        middle, within = np.pi / 2, np.pi / 2
    else:
        middle, within = rail.heading[0] + np.pi / 2, rail.heading[1]
    count = 1 + 2 * int(np.ceil(within / SPACING))
    z = np.zeros((count, 4))
    z[:, 0] = np.linspace(middle - within, middle + within, count)
    return z, 0.0 if count == 1 else 2 * within / (count - 1)


def _least(fit: _RailFit, z: FloatArray) -> FloatArray:
    """The sliders z (k, 4) that are better than those beside them."""
    error, violation = fit.assessed(z)
    merit = error + STIFFNESS * violation
    before, after = np.roll(merit, 1), np.roll(merit, -1)
    if fit.rail.heading is not None:  # not all around
        before[0] = after[-1] = np.inf
    return z[(merit <= before) & (merit <= after)]


def _descended(fit: _RailFit, z: FloatArray, spacing: float) -> FloatArray:
    """The minima (k, 4) to which the least of sliders in directions `spacing` apart lead."""
    damping = np.full(len(z), 1e-9)
    error, violation = fit.assessed(z)
    merit = error + STIFFNESS * violation
    for _ in range(STEPS):
        low, high = np.full(len(z), -spacing), np.full(len(z), spacing)
        if fit.rail.heading is not None:
            off, within = fit.rail.turned(z[:, 0]), fit.rail.heading[1]
            low, high = np.maximum(low, -within - off), np.minimum(high, within - off)
        to = fit.at_direction(z + fit.steps(z, (low, high), damping))
        new_error, new_violation = fit.assessed(to)
        new = new_error + STIFFNESS * new_violation
        better = new < merit
        z, merit = np.where(better[:, None], to, z), np.where(better, new, merit)
        damping = np.where(better, damping / 10, np.maximum(damping, 1e-9) * 10)
        if not better.any() and (damping > 1).all():
            break
    return z


def _directions(angle: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Unit vectors (k, 2) at angles (k,), and those a quarter turn ahead."""
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c, s], axis=-1), np.stack([-s, c], axis=-1)
