# cython: language_level=3, infer_types=True
# cython: boundscheck=False, wraparound=False, cdivision=True, initializedcheck=False
"""Crank-driven linkages beside the points of a path, one after the other; compiled.

The formulas are those of `crank_linkages`, and a linkage is its nine dimensions and its assembly.
What becomes of it depends on itself and the path alone, to the last bit.
"""

import cython

if not cython.compiled:
    raise ImportError("burmester's kernels are not compiled: install it again, by scripts/setup")

from cython.cimports.libc.math import INFINITY, cos, isfinite, sin, sqrt

SIZE = cython.declare(cython.int, 9)  # dimensions of a linkage


@cython.cclass
class Coupler:
    """The coupler point of a linkage, and what moves it, at the crank angle looked at last.

    x, y; v_x, v_y: dp/dt; crank, turn: unit numbers; pull: e, the follower's; gain: k.
    """

    z: cython.double[9]
    side: cython.double
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
    def look(self, t: cython.double) -> cython.bint:
        """Set the place at a crank angle; whether the linkage assembles there."""
        z = self.z
        a, b, r, c_x, c_y = z[4], z[5], z[6], z[7], z[8]
        self.crank_x, self.crank_y = cos(t), sin(t)
        pin_x: cython.double = z[0] + a * self.crank_x
        pin_y: cython.double = z[1] + a * self.crank_y
        to_x: cython.double = z[2] - pin_x
        to_y: cython.double = z[3] - pin_y
        squared: cython.double = to_x * to_x + to_y * to_y
        away: cython.double = sqrt(squared)
        cosine: cython.double = (b * b + squared - r * r) / (2 * b * away)
        sine: cython.double = self.side * sqrt(1 - cosine * cosine)
        turn_x: cython.double = (to_x * cosine - to_y * sine) / away
        turn_y: cython.double = (to_y * cosine + to_x * sine) / away
        pull_x: cython.double = (b * turn_x - to_x) / r
        pull_y: cython.double = (b * turn_y - to_y) / r
        swing: cython.double = b * (pull_y * turn_x - pull_x * turn_y)
        arm_x: cython.double = c_x * turn_x - c_y * turn_y
        arm_y: cython.double = c_x * turn_y + c_y * turn_x
        self.gain_x, self.gain_y = -arm_y / swing, arm_x / swing
        drive: cython.double = a * (pull_y * self.crank_x - pull_x * self.crank_y)
        self.v_x = -a * self.crank_y - self.gain_x * drive
        self.v_y = a * self.crank_x - self.gain_y * drive
        self.x, self.y = pin_x + arm_x, pin_y + arm_y
        self.turn_x, self.turn_y, self.pull_x, self.pull_y = turn_x, turn_y, pull_x, pull_y
        return isfinite(self.v_x) and isfinite(self.v_y)


def normal_equations(
    dimensions: cython.const[cython.double][:, :],
    assembly: cython.const[cython.double][:],
    points: cython.const[cython.double][:, :],
    t: cython.double[:, :],
    foot_steps: cython.int,
    longest_turn: cython.double,
    cost: cython.double[:],
    gradient: cython.double[:, :],
    normal: cython.double[:, :, :],
) -> None:
    """Move crank angles t (k, n) towards the feet of points (n, 3), and sum over these.

    points: x, y and the square root of the weight; foot_steps: of Newton's, each of at most
    `longest_turn` radians.  Set are the sums of squared distances (k,), half their derivatives
    (k, 9), and the normal equations (k, 9, 9); infinite and zeros where a place does not assemble.
    """
    coupler: Coupler = Coupler()
    row = cython.declare(cython.double[9])
    for k in range(dimensions.shape[0]):
        for i in range(SIZE):
            coupler.z[i] = dimensions[k, i]
            gradient[k, i] = 0.0
            for j in range(SIZE):
                normal[k, i, j] = 0.0
        coupler.side = assembly[k]
        total: cython.double = 0.0
        for n in range(points.shape[0]):
            x: cython.double = points[n, 0]
            y: cython.double = points[n, 1]
            share: cython.double = points[n, 2]
            angle: cython.double = t[k, n]
            for _ in range(foot_steps):
                if coupler.look(angle):
                    speed: cython.double = coupler.v_x * coupler.v_x + coupler.v_y * coupler.v_y
                    ahead: cython.double = coupler.v_x * (x - coupler.x)
                    ahead += coupler.v_y * (y - coupler.y)
                    if speed > 0:
                        angle += max(-longest_turn, min(longest_turn, ahead / speed))
            t[k, n] = angle
            if not coupler.look(angle):
                total = INFINITY
                continue
            gap_x: cython.double = coupler.x - x
            gap_y: cython.double = coupler.y - y
            total += share * share * (gap_x * gap_x + gap_y * gap_y)
            speed = sqrt(coupler.v_x * coupler.v_x + coupler.v_y * coupler.v_y)
            if not speed > 0:
                continue
            # The unit normal of the curve, times the square root of the weight.
            u_x: cython.double = -share * coupler.v_y / speed
            u_y: cython.double = share * coupler.v_x / speed
            miss: cython.double = u_x * gap_x + u_y * gap_y
            g: cython.double = u_x * coupler.gain_x + u_y * coupler.gain_y
            row[2], row[3] = g * coupler.pull_x, g * coupler.pull_y
            row[0], row[1] = u_x - row[2], u_y - row[3]
            row[4] = u_x * coupler.crank_x + u_y * coupler.crank_y
            row[4] -= g * (coupler.pull_x * coupler.crank_x + coupler.pull_y * coupler.crank_y)
            row[5] = -g * (coupler.pull_x * coupler.turn_x + coupler.pull_y * coupler.turn_y)
            row[6] = g
            row[7] = u_x * coupler.turn_x + u_y * coupler.turn_y
            row[8] = u_y * coupler.turn_x - u_x * coupler.turn_y
            for i in range(SIZE):
                gradient[k, i] += miss * row[i]
                for j in range(i + 1):
                    normal[k, i, j] += row[i] * row[j]
        if not isfinite(total):
            total = INFINITY
            for i in range(SIZE):
                gradient[k, i] = 0.0
                for j in range(i + 1):
                    normal[k, i, j] = 0.0
        cost[k] = total
        for i in range(SIZE):
            for j in range(i):
                normal[k, j, i] = normal[k, i, j]
