# cython: language_level=3, infer_types=True
# cython: boundscheck=False, wraparound=False, cdivision=True, initializedcheck=False
"""Crank-driven linkages descend to the points of a path, one after the other; compiled.

By Levenberg and Marquardt's method, see `curve_descent`.  The formulas are those of
`crank_linkages`, and a linkage is its nine dimensions and its assembly.  What becomes of it depends
on itself and the path alone, to the last bit.
"""

import cython
import numpy as np

if not cython.compiled:
    raise ImportError("burmester's kernels are not compiled: install it again, by scripts/setup")

from cython.cimports.libc.math import (
    INFINITY,
    atan2,
    ceil,
    cos,
    fabs,
    hypot,
    isfinite,
    log,
    sin,
    sqrt,
)

SIZE = cython.declare(cython.int, 9)  # dimensions of a linkage
PHASE = cython.declare(cython.int, 9)  # the number of the unknown that follows them, timed
MOST = cython.declare(cython.int, 10)  # unknowns
FOOT_TURN = cython.declare(cython.double, 0.3)  # radians; the most that a foot goes in one step
# Length along the curve to the foot of the normal, in radii of gyration of the points.  From nearer
# the distance along the normal is that of the foot, in third order.
NEAR_FOOT = cython.declare(cython.double, 1e-2)
AT_FOOT = cython.declare(cython.double, 1e-7)  # the same; nearer is there
FOOT_STEPS = cython.declare(cython.int, 3)  # of Newton's in each step of a linkage, at most
LAST_FOOT_STEPS = cython.declare(cython.int, 20)  # of them at its end
TURN = cython.declare(cython.double, 6.283185307179586)
START_DAMPING = cython.declare(cython.double, 1e-2)  # in units of the squared columns
MIN_DAMPING = cython.declare(cython.double, 1e-12)
MAX_DAMPING = cython.declare(cython.double, 1e8)
OLDER_SCALE = cython.declare(cython.double, 0.7)  # share of a column's unit kept from step to step
LEAST_SCALE = cython.declare(cython.double, 1e-9)  # of the greatest column; a unit is no less
TINY = cython.declare(cython.double, 2.3e-308)  # keeps what may be 0 from dividing by 0
# Radians of the crank between two looks at an arc, and the number of looks in one at most.
ARC_TURN = cython.declare(cython.double, 0.12)
ARC_LOOKS = cython.declare(cython.int, 16)
STRAY_WEIGHT = cython.declare(cython.double, 8.0)  # of what an arc leaves its chord by too much
BUILT_WEIGHT = cython.declare(cython.double, 10.0)  # of squared cosines and logarithms, per point
FULLNESS = cython.declare(cython.double, 1e-4)  # least margin of a full turn, in sums of lengths
FULLNESS_STEPS = cython.declare(cython.int, 3)
# Bounds of links and of fixed pivots from the task's middle, in radii of gyration of its points.
LONGEST = cython.declare(cython.double, 40.0)
SHORTEST = cython.declare(cython.double, 0.01)
FARTHEST = cython.declare(cython.double, 80.0)


@cython.cclass
class Coupler:
    """The coupler point of a linkage, and what moves it, at the crank angle looked at last.

    difference: b² - r²; x, y; v_x, v_y: dp/dt; crank, turn: unit numbers; pull: e, the follower's;
    gain: k.
    """

    z: cython.double[9]
    side: cython.double
    difference: cython.double
    half_per_b: cython.double
    per_r: cython.double
    x: cython.double
    y: cython.double
    v_x: cython.double
    v_y: cython.double
    crank_x: cython.double
    crank_y: cython.double
    turn_x: cython.double
    turn_y: cython.double
    pull_x: cython.double
    pull_y: cython.double
    gain_x: cython.double
    gain_y: cython.double

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def prepare(self) -> cython.void:
        """Set what depends on the dimensions alone."""
        b, r = self.z[5], self.z[6]
        self.difference, self.half_per_b, self.per_r = b * b - r * r, 0.5 / b, 1 / r

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def look(self, t: cython.double) -> cython.bint:
        """Set the place at a crank angle; whether the linkage assembles there."""
        z = self.z
        a, b, c_x, c_y = z[4], z[5], z[7], z[8]
        self.crank_x, self.crank_y = cos(t), sin(t)
        pin_x: cython.double = z[0] + a * self.crank_x
        pin_y: cython.double = z[1] + a * self.crank_y
        to_x: cython.double = z[2] - pin_x
        to_y: cython.double = z[3] - pin_y
        squared: cython.double = to_x * to_x + to_y * to_y
        near: cython.double = 1 / sqrt(squared)
        cosine: cython.double = (self.difference + squared) * near * self.half_per_b
        sine: cython.double = self.side * sqrt(1 - cosine * cosine)
        turn_x: cython.double = (to_x * cosine - to_y * sine) * near
        turn_y: cython.double = (to_y * cosine + to_x * sine) * near
        pull_x: cython.double = (b * turn_x - to_x) * self.per_r
        pull_y: cython.double = (b * turn_y - to_y) * self.per_r
        per_swing: cython.double = 1 / (b * (pull_y * turn_x - pull_x * turn_y))
        arm_x: cython.double = c_x * turn_x - c_y * turn_y
        arm_y: cython.double = c_x * turn_y + c_y * turn_x
        self.gain_x, self.gain_y = -arm_y * per_swing, arm_x * per_swing
        drive: cython.double = a * (pull_y * self.crank_x - pull_x * self.crank_y)
        self.v_x = -a * self.crank_y - self.gain_x * drive
        self.v_y = a * self.crank_x - self.gain_y * drive
        self.x, self.y = pin_x + arm_x, pin_y + arm_y
        self.turn_x, self.turn_y, self.pull_x, self.pull_y = turn_x, turn_y, pull_x, pull_y
        return isfinite(self.v_x) and isfinite(self.v_y)


@cython.cclass
class Descent:
    """A linkage on its way, and where a step from it would lead.

    points: (n, 3), x, y and the square root of the weight; t: (n,), the crank angles of the feet;
    missed: (n,), how far the points are from there; timing: (n,), the crank angles but for one
    phase, or (0,); allowed, turns and others: see `descend`.
    last: whether crank angles go all the way to the feet; size: number of unknowns; cost: sum of
    squares; gradient, normal: half its derivatives, and the normal equations, their lower triangle.
    """

    coupler: Coupler
    points: cython.double[:, ::1]
    timing: cython.double[::1]
    allowed: cython.double[:, ::1]
    turns: cython.bint
    unbroken: cython.bint
    cosine: cython.double
    ratio: cython.double
    last: cython.bint
    size: cython.int
    t: cython.double[::1]
    missed: cython.double[::1]
    cost: cython.double
    row: cython.double[10]
    gradient: cython.double[10]
    normal: cython.double[100]

    def __init__(
        self,
        points: cython.double[:, ::1],
        timing: cython.double[::1],
        allowed: cython.double[:, ::1],
        turns: cython.bint,
        unbroken: cython.bint,
        cosine: cython.double,
        ratio: cython.double,
    ) -> None:
        self.coupler = Coupler()
        self.points, self.timing, self.turns, self.unbroken = points, timing, turns, unbroken
        self.allowed = allowed
        self.cosine, self.ratio, self.last = cosine, ratio, False
        self.size = SIZE + (timing.shape[0] > 0)
        self.t, self.missed = np.empty((2, points.shape[0]))

    @cython.cfunc
    @cython.exceptval(check=False)
    def measure(self) -> cython.void:
        """Set cost, gradient and normal equations of the coupler's linkage; move t to the feet."""
        self.cost = 0.0
        for i in range(self.size):
            self.gradient[i] = 0.0
            for j in range(MOST):
                self.normal[MOST * i + j] = 0.0
        if self.turns and not self.fullness(0) >= FULLNESS / 2:
            self.cost = INFINITY
            return
        coupler = self.coupler
        coupler.prepare()
        for n in range(self.points.shape[0]):
            if not self.go_to(n):
                self.cost = INFINITY
                return
            share: cython.double = self.points[n, 2]
            x: cython.double = share * (coupler.x - self.points[n, 0])
            y: cython.double = share * (coupler.y - self.points[n, 1])
            self.missed[n] = hypot(coupler.x - self.points[n, 0], coupler.y - self.points[n, 1])
            if self.timing.shape[0]:
                self.cost += x * x + y * y
                self.add_along(x, share, 0.0)
                self.add_along(y, 0.0, share)
                continue
            speed: cython.double = sqrt(coupler.v_x * coupler.v_x + coupler.v_y * coupler.v_y)
            if not speed > 0:
                self.cost += x * x + y * y
                continue
            u_x: cython.double = -coupler.v_y / speed
            u_y: cython.double = coupler.v_x / speed
            miss: cython.double = u_x * x + u_y * y
            ahead: cython.double = u_x * y - u_y * x
            self.cost += miss * miss
            if fabs(ahead) > share * NEAR_FOOT:
                self.cost += ahead * ahead
            self.add_along(miss, share * u_x, share * u_y)
        if self.unbroken and not self.passes():
            self.cost = INFINITY
            return
        for n in range(self.allowed.shape[0]):
            self.add_strays(n)
        if self.cosine < 1:
            self.add_transmission()
        if self.ratio < INFINITY:
            self.add_ratio()
        if not isfinite(self.cost):
            self.cost = INFINITY

    @cython.cfunc
    @cython.exceptval(check=False)
    def add_strays(self, n: cython.Py_ssize_t) -> cython.void:
        """Add by what the arc of a gap leaves its chord farther than is allowed, at a few angles.

        A curve that misses the points beside the gap may leave the chord by as much more, up to a
        bound.
        The angles are followed as shares of the arc: where it is farthest from the chord, moving
        along it changes nothing.
        """
        count: cython.Py_ssize_t = self.points.shape[0]
        after: cython.Py_ssize_t = n + 1 if n + 1 < count else 0
        turn: cython.double = self.t[after] - self.t[n]
        if not after and self.turns:
            turn += TURN if self.t[n] > self.t[0] else -TURN
        looks: cython.int = int(min(fabs(turn) / ARC_TURN, ARC_LOOKS))
        missed: cython.double = max(self.missed[n], self.missed[after])
        if not looks and missed > self.allowed[n, 0]:
            looks = 1
        coupler = self.coupler
        x: cython.double = self.points[n, 0]
        y: cython.double = self.points[n, 1]
        chord_x: cython.double = self.points[after, 0] - x
        chord_y: cython.double = self.points[after, 1] - y
        squared: cython.double = chord_x * chord_x + chord_y * chord_y + TINY
        allowed: cython.double = min(self.allowed[n, 0] + missed, self.allowed[n, 1])
        for k in range(looks):
            if not coupler.look(self.t[n] + turn * (k + 1) / (looks + 1)):
                self.cost = INFINITY
                return
            to_x: cython.double = coupler.x - x
            to_y: cython.double = coupler.y - y
            share: cython.double = (chord_x * to_x + chord_y * to_y) / squared
            share = max(0.0, min(1.0, share))
            to_x -= share * chord_x
            to_y -= share * chord_y
            away: cython.double = hypot(to_x, to_y)
            lack: cython.double = STRAY_WEIGHT * (away - allowed)
            if lack > 0:
                self.cost += lack * lack
                self.add_along(lack, STRAY_WEIGHT * to_x / away, STRAY_WEIGHT * to_y / away)

    @cython.cfunc
    @cython.exceptval(check=False)
    def passes(self) -> cython.bint:
        """Whether the linkage assembles all the way between the crank angles, too.

        Its diagonal is shortest and longest where the crank points along the ground link.
        """
        z = self.coupler.z
        ground: cython.double = hypot(z[2] - z[0], z[3] - z[1])
        along: cython.double = atan2(z[3] - z[1], z[2] - z[0])
        low: cython.double = self.t[0]
        high: cython.double = self.t[0]
        for n in range(1, self.t.shape[0]):
            low, high = min(low, self.t[n]), max(high, self.t[n])
        near: cython.double = along + TURN * ceil((low - along) / TURN)
        far: cython.double = along + TURN * (ceil((low - along) / TURN - 0.5) + 0.5)
        if near <= high and fabs(ground - z[4]) < fabs(z[5] - z[6]):
            return False
        return not (far <= high and ground + z[4] > z[5] + z[6])

    @cython.cfunc
    @cython.exceptval(check=False)
    def go_to(self, n: cython.Py_ssize_t) -> cython.bint:
        """Look at the place of a point, at the foot or nearer to it; whether there is one."""
        coupler = self.coupler
        if not coupler.look(self.t[n]):
            return False
        if self.timing.shape[0]:
            return True
        for number in range(LAST_FOOT_STEPS if self.last else FOOT_STEPS):
            speed: cython.double = coupler.v_x * coupler.v_x + coupler.v_y * coupler.v_y
            ahead: cython.double = coupler.v_x * (self.points[n, 0] - coupler.x)
            ahead += coupler.v_y * (self.points[n, 1] - coupler.y)
            near: cython.double = AT_FOOT if self.last or not number else NEAR_FOOT
            if fabs(ahead) <= near * sqrt(speed):
                break
            self.t[n] += max(-FOOT_TURN, min(FOOT_TURN, ahead / speed))
            if not coupler.look(self.t[n]):
                return False
        return True

    @cython.cfunc
    @cython.exceptval(check=False)
    def add_along(self, miss: cython.double, u_x: cython.double, u_y: cython.double) -> cython.void:
        """Add a residual whose derivative by the coupler point is u."""
        at = self.coupler
        g: cython.double = u_x * at.gain_x + u_y * at.gain_y
        self.row[2], self.row[3] = g * at.pull_x, g * at.pull_y
        self.row[0], self.row[1] = u_x - self.row[2], u_y - self.row[3]
        self.row[4] = u_x * at.crank_x + u_y * at.crank_y
        self.row[4] -= g * (at.pull_x * at.crank_x + at.pull_y * at.crank_y)
        self.row[5] = -g * (at.pull_x * at.turn_x + at.pull_y * at.turn_y)
        self.row[6] = g
        self.row[7] = u_x * at.turn_x + u_y * at.turn_y
        self.row[8] = u_y * at.turn_x - u_x * at.turn_y
        self.row[PHASE] = u_x * at.v_x + u_y * at.v_y
        self.add(miss)

    @cython.cfunc
    @cython.exceptval(check=False)
    @cython.inline
    def add(self, miss: cython.double) -> cython.void:
        """Add a residual whose derivatives are `row` to the normal equations."""
        for i in range(self.size):
            self.gradient[i] += miss * self.row[i]
            for j in range(10):  # all of them: so the compiler takes several at once
                self.normal[MOST * i + j] += self.row[i] * self.row[j]

    @cython.cfunc
    @cython.exceptval(check=False)
    def add_transmission(self) -> cython.void:
        """Add by what cosines of the angle between coupler and follower are too great.

        At the feet, or where the pin of the crank is nearest to G2 and farthest from it.
        """
        z = self.coupler.z
        ground: cython.double = hypot(z[2] - z[0], z[3] - z[1])
        if not self.turns:
            for n in range(self.points.shape[0]):
                self.add_cosine(cos(self.t[n]), sin(self.t[n]))
        elif ground > 0:
            self.add_cosine((z[2] - z[0]) / ground, (z[3] - z[1]) / ground)
            self.add_cosine((z[0] - z[2]) / ground, (z[1] - z[3]) / ground)

    @cython.cfunc
    @cython.exceptval(check=False)
    def add_cosine(self, crank_x: cython.double, crank_y: cython.double) -> cython.void:
        """The same with the crank along a unit vector: (b² + r² - |D|²) / (2 b r)."""
        z = self.coupler.z
        b, r = z[5], z[6]
        to_x: cython.double = z[2] - z[0] - z[4] * crank_x
        to_y: cython.double = z[3] - z[1] - z[4] * crank_y
        cosine: cython.double = (b * b + r * r - to_x * to_x - to_y * to_y) / (2 * b * r)
        lack: cython.double = fabs(cosine) - self.cosine
        if not lack > 0:
            return
        weight: cython.double = sqrt(BUILT_WEIGHT * self.points.shape[0])
        sign: cython.double = weight if cosine > 0 else -weight
        self.row[0], self.row[1] = sign * to_x / (b * r), sign * to_y / (b * r)
        self.row[2], self.row[3] = -self.row[0], -self.row[1]
        self.row[4] = sign * (to_x * crank_x + to_y * crank_y) / (b * r)
        self.row[5], self.row[6] = sign * (1 / r - cosine / b), sign * (1 / b - cosine / r)
        self.row[7] = self.row[8] = self.row[PHASE] = 0.0
        self.cost += weight * weight * lack * lack
        self.add(weight * lack)

    @cython.cfunc
    @cython.exceptval(check=False)
    def add_ratio(self) -> cython.void:
        """Add by what the logarithm of the longest link over the shortest is too great."""
        z = self.coupler.z
        to_x: cython.double = z[2] - z[0]
        to_y: cython.double = z[3] - z[1]
        ground: cython.double = hypot(to_x, to_y)
        longest: cython.int = 3  # the numbers of crank, coupler and follower are theirs; 3: ground
        shortest: cython.int = 3
        most: cython.double = ground
        least: cython.double = ground
        for i in range(4, 7):
            if z[i] > most:
                longest, most = i, z[i]
            if z[i] < least:
                shortest, least = i, z[i]
        lack: cython.double = log(most / least / self.ratio)
        if not lack > 0:
            return
        weight: cython.double = sqrt(BUILT_WEIGHT * self.points.shape[0])
        for i in range(MOST):
            self.row[i] = 0.0
        for end in range(2):
            link: cython.int = shortest if end else longest
            sign: cython.double = -weight if end else weight
            if link > 3:
                self.row[link] += sign / z[link]
            else:
                self.row[0] -= sign * to_x / (ground * ground)
                self.row[1] -= sign * to_y / (ground * ground)
                self.row[2] += sign * to_x / (ground * ground)
                self.row[3] += sign * to_y / (ground * ground)
        self.cost += weight * weight * lack * lack
        self.add(weight * lack)

    @cython.cfunc
    @cython.exceptval(check=False)
    def fullness(self, mended: cython.bint) -> cython.double:
        """The least of three sums of the lengths over their total; the crank turns fully above 0.

        mended: each sum is linear in the lengths, and changes by one per unit of each, so that to
        make it what it should be at least a quarter of what lacks goes to each.
        """
        z = self.coupler.z
        to_x: cython.double = z[2] - z[0]
        to_y: cython.double = z[3] - z[1]
        g: cython.double = hypot(to_x, to_y)
        a, b, r = z[4], z[5], z[6]
        total: cython.double = g + a + b + r
        side: cython.double = 1.0 if g > a else -1.0
        # Of ground, crank, coupler, follower: the signs in the least sum.
        s_g: cython.double = -1.0
        s_a: cython.double = -1.0
        s_b: cython.double = 1.0
        s_r: cython.double = 1.0
        least: cython.double = b + r - g - a
        if side * (g - a) - b + r < least:
            least = side * (g - a) - b + r
            s_g, s_a, s_b = side, -side, -1.0
        if side * (g - a) + b - r < least:
            least = side * (g - a) + b - r
            s_g, s_a, s_b, s_r = side, -side, 1.0, -1.0
        lack: cython.double = FULLNESS * total - least
        if mended and lack > 0:
            stretch: cython.double = lack * s_g / 8 / max(g, SHORTEST)
            z[0] -= stretch * to_x
            z[1] -= stretch * to_y
            z[2] += stretch * to_x
            z[3] += stretch * to_y
            z[4] = max(a + lack * s_a / 4, SHORTEST)
            z[5] = max(b + lack * s_b / 4, SHORTEST)
            z[6] = max(r + lack * s_r / 4, SHORTEST)
        return least / total

    @cython.cfunc
    @cython.exceptval(check=False)
    def bound(self) -> cython.void:
        """Bring the dimensions within the bounds, the crank turning fully where asked."""
        z = self.coupler.z
        for i in range(0, SIZE, 2):
            first: cython.int = i if i < 4 else 7
            far: cython.double = hypot(z[first], z[first + 1])
            if far > FARTHEST:
                z[first] *= FARTHEST / far
                z[first + 1] *= FARTHEST / far
            if first == 7:
                break
        for i in range(4, 7):
            z[i] = max(SHORTEST, min(LONGEST, z[i]))
        if self.turns:
            for _ in range(FULLNESS_STEPS):
                if self.fullness(1) >= FULLNESS:
                    break


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def solve(matrix: cython.p_double, x: cython.p_double, count: cython.int) -> cython.bint:
    """Put the x' with matrix x' = x in the place of x; False where it is not positive definite.

    By Cholesky's factor in the place of the matrix's lower triangle, of which a row is MOST long.
    """
    for i in range(count):
        for j in range(i + 1):
            rest: cython.double = matrix[MOST * i + j]
            for k in range(j):
                rest -= matrix[MOST * i + k] * matrix[MOST * j + k]
            if i > j:
                matrix[MOST * i + j] = rest / matrix[MOST * j + j]
            elif rest > 0:
                matrix[MOST * i + i] = sqrt(rest)
            else:
                return False
    for i in range(count):
        for k in range(i):
            x[i] -= matrix[MOST * i + k] * x[k]
        x[i] /= matrix[MOST * i + i]
    for i in range(count - 1, -1, -1):
        for k in range(i + 1, count):
            x[i] -= matrix[MOST * k + i] * x[k]
        x[i] /= matrix[MOST * i + i]
    return True


def descend(
    dimensions: cython.double[:, ::1],
    assembly: cython.const[cython.double][:],
    t: cython.double[:, ::1],
    cost: cython.double[:],
    points: cython.double[:, ::1],
    timing: cython.double[::1],
    allowed: cython.double[:, ::1],
    turns: cython.bint,
    unbroken: cython.bint,
    cosine: cython.double,
    ratio: cython.double,
    steps: cython.int,
    settled: cython.double,
) -> None:
    """Move linkages (k, 9) with crank angles t (k, n) towards points (n, 3), and set costs (k,).

    points: x, y and the square root of the weight; timing: (n,), the crank angles but for one
    phase, or (0,); allowed: (g, 2), how far the arcs of the gaps between neighbours may leave their
    chords where the points are met, and at most, or (0, 2); turns: whether cranks go all the way
    round; unbroken: whether linkages assemble between the points too; cosine, ratio: of the
    transmission angle, and of the longest link over the shortest, at most; steps: at most;
    settled: relative gain of the cost below which a step is the last.
    """
    way: Descent = Descent(points, timing, allowed, turns, unbroken, cosine, ratio)
    here = cython.declare(cython.double[10])
    scale = cython.declare(cython.double[10])
    gradient = cython.declare(cython.double[10])
    normal = cython.declare(cython.double[100])
    step = cython.declare(cython.double[10])
    matrix = cython.declare(cython.double[100])
    size: cython.int = way.size
    for k in range(dimensions.shape[0]):
        way.coupler.side = assembly[k]
        for i in range(SIZE):
            way.coupler.z[i] = dimensions[k, i]
            here[i] = dimensions[k, i]
        for n in range(points.shape[0]):
            way.t[n] = t[k, n]
        way.measure()
        for i in range(size):
            scale[i] = 0.0
        best: cython.double = INFINITY
        damping: cython.double = START_DAMPING
        ended: cython.bint = False
        for number in range(steps + 1):
            if way.cost < best or not number:
                ended = number > 0 and best - way.cost <= settled * best
                damping = max(damping / 5, MIN_DAMPING) if number else damping
                best = way.cost
                for i in range(SIZE):
                    here[i] = way.coupler.z[i]
                for n in range(points.shape[0]):
                    t[k, n] = way.t[n]
                greatest: cython.double = 0.0
                for i in range(size):
                    greatest = max(greatest, sqrt(way.normal[MOST * i + i]))
                for i in range(size):
                    unit: cython.double = sqrt(way.normal[MOST * i + i])
                    unit = max(unit, LEAST_SCALE * greatest + TINY)
                    scale[i] = max(OLDER_SCALE * scale[i], unit)
                for i in range(size):
                    gradient[i] = way.gradient[i] / scale[i]
                    for j in range(i + 1):
                        normal[MOST * i + j] = way.normal[MOST * i + j] / scale[i] / scale[j]
            else:
                damping *= 4
                ended = damping > MAX_DAMPING
            if ended or number == steps or not isfinite(best):
                break
            for i in range(size):
                step[i] = -gradient[i]
                for j in range(i + 1):
                    matrix[MOST * i + j] = normal[MOST * i + j]
                matrix[MOST * i + i] += damping
            way.cost = INFINITY
            if solve(matrix, step, size):
                for i in range(SIZE):
                    way.coupler.z[i] = here[i] + step[i] / scale[i]
                for n in range(points.shape[0]):
                    way.t[n] = t[k, n]
                    if size > PHASE:
                        way.t[n] += step[PHASE] / scale[PHASE]
                way.bound()
                way.measure()
        for i in range(SIZE):
            dimensions[k, i] = way.coupler.z[i] = here[i]
        way.last = True
        for n in range(points.shape[0]):
            way.t[n] = t[k, n]
        way.measure()
        way.last = False
        if way.cost < INFINITY:
            best = way.cost
            for n in range(points.shape[0]):
                t[k, n] = way.t[n]
        cost[k] = best
