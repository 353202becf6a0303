# cython: language_level=3, infer_types=True
# cython: boundscheck=False, wraparound=False, cdivision=True, initializedcheck=False
"""Newton's steps of circles down to their distance from the poses, one after the other; compiled.

A circle is c1, c2, m1, m2, r.  What becomes of it depends on its own task alone, to the last bit,
whatever circles it is computed with.
"""

import cython

if not cython.compiled:
    raise ImportError("burmester's kernels are not compiled: install it again, by scripts/setup")

from cython.cimports.libc.math import INFINITY, fabs, hypot, isfinite, sqrt

SIZE = cython.declare(cython.int, 5)  # of a circle
SETTLED_STEP = cython.declare(cython.double, 1e-9)  # relative; a shorter step is the last one
NEGLIGIBLE_GAIN = cython.declare(cython.double, 1e-10)  # share of the sum; less is not checked
DIVISOR_FLOOR = cython.declare(cython.double, 1e-300)  # lengths; a pivot may meet its centre
FLAT_EIGENVALUE = cython.declare(cython.double, 1e-14)  # of the greatest; smaller ones count as it
LEAST_PIVOT = cython.declare(cython.double, 1e-12)  # of its diagonal; below it see eigenvalues
ROUNDING = cython.declare(cython.double, 2.2e-16)  # of a circle's size; a smaller distance is zero
QUARTERINGS = cython.declare(cython.int, 20)  # trials of a step before it is given up
SWEEPS = cython.declare(cython.int, 30)  # of Jacobi's method; it takes about six
ROTATED = cython.declare(cython.double, 1e-18)  # share of the trace; what is left beside it is 0


@cython.cclass
class Circle:
    """A circle of a task, on its way down.

    z, its gradient, the lower triangles of its Hessian and of the part of that without curvature,
    and the step that is tried; values, axes: eigenvalues and their vectors, in columns.
    """

    count: cython.Py_ssize_t
    cos: cython.const[cython.double][:]
    sin: cython.const[cython.double][:]
    x: cython.const[cython.double][:]
    y: cython.const[cython.double][:]
    share: cython.const[cython.double][:]
    z: cython.double[5]
    gradient: cython.double[5]
    hessian: cython.double[25]
    flat: cython.double[25]
    step: cython.double[5]
    left: cython.double[25]
    axes: cython.double[25]
    convex: cython.bint

    @cython.cfunc
    def take(self, z: cython.double[:], seen: cython.const[cython.double][:, :]) -> cython.void:
        """Be a circle of a task, whose poses (5, N) are cosine, sine, x, y, share."""
        self.count = seen.shape[1]
        self.cos, self.sin, self.x, self.y, self.share = seen[0], seen[1], seen[2], seen[3], seen[4]
        for i in range(SIZE):
            self.z[i] = z[i]

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def sum(self, share: cython.double) -> cython.double:
        """The sum of squared distances after a share of the step."""
        z = cython.declare(cython.double[5])
        total: cython.double = 0.0
        for i in range(SIZE):
            z[i] = self.z[i] + share * self.step[i]
        for n in range(self.count):
            x: cython.double = self.cos[n] * z[2] - self.sin[n] * z[3] + self.x[n] - z[0]
            y: cython.double = self.sin[n] * z[2] + self.cos[n] * z[3] + self.y[n] - z[1]
            distance: cython.double = sqrt(x * x + y * y) - z[4]
            total += self.share[n] * distance * distance
        return total

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def differentiate(self) -> cython.void:
        """Set the gradient and both Hessians."""
        one = cython.declare(cython.double[5])
        bent = cython.declare(cython.double[5])
        one[4], bent[4] = -1.0, 0.0
        for i in range(SIZE):
            self.gradient[i] = 0.0
            for j in range(i + 1):
                self.flat[5 * i + j] = self.hessian[5 * i + j] = 0.0
        for n in range(self.count):
            cos, sin, z, share = self.cos[n], self.sin[n], self.z, self.share[n]
            x: cython.double = cos * z[2] - sin * z[3] + self.x[n] - z[0]
            y: cython.double = sin * z[2] + cos * z[3] + self.y[n] - z[1]
            arm: cython.double = max(sqrt(x * x + y * y), DIVISOR_FLOOR)
            pull: cython.double = share * (arm - z[4])
            turn: cython.double = pull / arm
            one[0], one[1] = -x / arm, -y / arm
            one[2], one[3] = (cos * x + sin * y) / arm, (cos * y - sin * x) / arm
            bent[0], bent[1], bent[2], bent[3] = -one[1], one[0], -one[3], one[2]
            for i in range(SIZE):
                self.gradient[i] += pull * one[i]
                for j in range(i + 1):
                    self.flat[5 * i + j] += share * one[i] * one[j]
                    self.hessian[5 * i + j] += turn * bent[i] * bent[j]
        for i in range(SIZE):
            for j in range(i + 1):
                self.hessian[5 * i + j] += self.flat[5 * i + j]

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def solved(self, lower: cython.pointer[cython.double]) -> cython.int:
        """Set the step that takes the gradient away, by L D Lᵀ of a lower triangle.

        Returns 1 where the matrix is positive definite, 0 where it is not, -1 where a pivot is near
        zero, so that this is not sure.
        """
        pivots = cython.declare(cython.double[5])
        definite: cython.int = 1
        sure: cython.bint = True
        left, x = self.left, self.step
        for i in range(SIZE):
            x[i] = -self.gradient[i]
            for j in range(i + 1):
                left[5 * i + j] = lower[5 * i + j]
        for j in range(SIZE):
            pivot: cython.double = left[6 * j]
            pivots[j] = pivot
            if not pivot > 0:
                definite = 0
            if not fabs(pivot) > LEAST_PIVOT * fabs(lower[6 * j]):
                sure = False
            for i in range(j + 1, SIZE):
                factor: cython.double = left[5 * i + j] / pivot
                for k in range(j + 1, i + 1):
                    left[5 * i + k] -= factor * left[5 * k + j]
                x[i] -= factor * x[j]
            for i in range(j + 1, SIZE):
                left[5 * i + j] /= pivot
        for i in range(SIZE - 1, -1, -1):
            x[i] /= pivots[i]
            for k in range(i + 1, SIZE):
                x[i] -= left[5 * k + i] * x[k]
        return definite if sure else -1

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def diagonalised(self, lower: cython.pointer[cython.double]) -> cython.bint:
        """Set `left` to a diagonal of eigenvalues and `axes`, by Jacobi's rotations.

        Returns whether all of them are above 0; they are infinite where something is not finite.
        """
        a, v = self.left, self.axes
        trace: cython.double = 0.0
        whole: cython.double = 0.0
        for i in range(SIZE):
            for j in range(SIZE):
                a[5 * i + j] = lower[5 * max(i, j) + min(i, j)]
                v[5 * i + j] = 1.0 if i == j else 0.0
                whole += fabs(a[5 * i + j])
            trace += fabs(a[6 * i])
        if not isfinite(whole):  # beyond all measure no step is made
            for i in range(SIZE):
                a[6 * i] = INFINITY
            return False
        for _ in range(SWEEPS):
            beside: cython.double = 0.0
            for i in range(SIZE):
                for j in range(i):
                    off: cython.double = a[5 * i + j]
                    beside = max(beside, fabs(off))
                    if off == 0.0:
                        continue
                    ratio: cython.double = (a[6 * j] - a[6 * i]) / (2 * off)
                    t: cython.double = 1 / (fabs(ratio) + sqrt(ratio * ratio + 1))
                    if ratio < 0:
                        t = -t
                    c: cython.double = 1 / sqrt(t * t + 1)
                    s: cython.double = t * c
                    for k in range(SIZE):  # columns i and j, then rows i and j
                        p: cython.double = a[5 * k + i]
                        q: cython.double = a[5 * k + j]
                        a[5 * k + i], a[5 * k + j] = c * p - s * q, s * p + c * q
                        p, q = v[5 * k + i], v[5 * k + j]
                        v[5 * k + i], v[5 * k + j] = c * p - s * q, s * p + c * q
                    for k in range(SIZE):
                        p: cython.double = a[5 * i + k]
                        q: cython.double = a[5 * j + k]
                        a[5 * i + k], a[5 * j + k] = c * p - s * q, s * p + c * q
            if beside <= ROTATED * trace:
                break
        positive: cython.bint = True
        for i in range(SIZE):
            positive = positive and a[6 * i] > 0
        return positive

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def along_axes(self) -> cython.void:
        """Set the step by the eigenvalues and axes; none where something is not finite."""
        greatest: cython.double = 0.0
        for i in range(SIZE):
            greatest = max(greatest, self.left[6 * i])
        for j in range(SIZE):
            self.step[j] = 0.0
            if not isfinite(self.gradient[j]):
                return
        for i in range(SIZE):
            along: cython.double = 0.0
            for j in range(SIZE):
                along += self.axes[5 * j + i] * self.gradient[j]
            along /= max(self.left[6 * i], FLAT_EIGENVALUE * greatest)
            if not isfinite(along):
                along = 0.0
            for j in range(SIZE):
                self.step[j] -= along * self.axes[5 * j + i]

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def newton_step(self) -> cython.double:
        """Set Newton's step, or Gauss and Newton's where the sum is not convex.

        Returns what it gains.
        """
        self.differentiate()
        definite: cython.int = self.solved(self.hessian)
        if definite == -1:
            self.convex = self.diagonalised(self.hessian)
            if not self.convex:
                self.diagonalised(self.flat)
            self.along_axes()
        elif definite == 0:
            self.convex = False
            if self.solved(self.flat) == -1:
                self.diagonalised(self.flat)
                self.along_axes()
        else:
            self.convex = True
        gain: cython.double = 0.0
        for i in range(SIZE):
            gain -= self.gradient[i] * self.step[i]
        return gain


def distances(
    z: cython.const[cython.double][:, ::1],
    poses: cython.const[cython.double][:, ::1],
    distance: cython.double[:, ::1],
) -> None:
    """Set the distances (k, N) of circles z (k, 5) from poses (4, N): cosine, sine, x, y."""
    for k in range(z.shape[0]):
        for n in range(poses.shape[1]):
            cos, sin = poses[0, n], poses[1, n]
            x: cython.double = cos * z[k, 2] - sin * z[k, 3] + poses[2, n] - z[k, 0]
            y: cython.double = sin * z[k, 2] + cos * z[k, 3] + poses[3, n] - z[k, 1]
            distance[k, n] = hypot(x, y) - z[k, 4]


def distance_terms(
    z: cython.const[cython.double][:, ::1],
    poses: cython.const[cython.double][:, ::1],
    distance: cython.double[:, ::1],
    jacobian: cython.double[:, :, ::1],
    tangent: cython.double[:, :, ::1],
    arm: cython.double[:, ::1],
) -> None:
    """Set the same, their Jacobians (k, N, 5), and what second derivatives are made of.

    These are tangent tangentᵀ / arm, of vectors (k, N, 5) and numbers (k, N).
    """
    for k in range(z.shape[0]):
        for n in range(poses.shape[1]):
            cos, sin = poses[0, n], poses[1, n]
            x: cython.double = cos * z[k, 2] - sin * z[k, 3] + poses[2, n] - z[k, 0]
            y: cython.double = sin * z[k, 2] + cos * z[k, 3] + poses[3, n] - z[k, 1]
            length: cython.double = max(hypot(x, y), DIVISOR_FLOOR)  # what is no number stays so
            x /= length
            y /= length
            along: cython.double = cos * x + sin * y
            across: cython.double = cos * y - sin * x
            distance[k, n], arm[k, n] = length - z[k, 4], length
            jacobian[k, n, 0], jacobian[k, n, 1] = -x, -y
            jacobian[k, n, 2], jacobian[k, n, 3], jacobian[k, n, 4] = along, across, -1.0
            tangent[k, n, 0], tangent[k, n, 1] = y, -x
            tangent[k, n, 2], tangent[k, n, 3], tangent[k, n, 4] = -across, along, 0.0


def sums_of_squares(
    z: cython.double[:, ::1],
    task: cython.const[cython.Py_ssize_t][:],
    poses: cython.const[cython.double][:, :, :],
    cost: cython.double[:],
) -> None:
    """Set the sums (k,) of squared distances of circles z (k, 5) from the poses of their tasks.

    poses: (T, 5, N), of tasks (T,): cosine, sine, x, y, share.
    """
    circle: Circle = Circle()
    for i in range(SIZE):
        circle.step[i] = 0.0
    for k in range(z.shape[0]):
        circle.take(z[k], poses[task[k]])
        cost[k] = circle.sum(0.0)


def steps_down(
    run: cython.const[cython.Py_ssize_t][:],
    z: cython.double[:, ::1],
    cost: cython.double[:],
    task: cython.const[cython.Py_ssize_t][:],
    poses: cython.const[cython.double][:, :, :],
    longest: cython.const[cython.double][:],
    settled: cython.uchar[:],
    ended: cython.uchar[:],
) -> None:
    """Let those circles (r,) of z (k, 5), with sums `cost` (k,), make one step that `run` counts.

    A step is divided by four until it makes nothing worse.  poses: (T, 5, N), of tasks (T,):
    cosine, sine, x, y, share; longest: (T,), the greatest coordinate of a circle, one that is
    greater has left.  settled, ended: (k,), set: whether it came to rest at a minimum, and whether
    this was its last step.
    """
    circle: Circle = Circle()
    for number in range(run.shape[0]):
        k = run[number]
        circle.take(z[k], poses[task[k]])
        gain: cython.double = circle.newton_step()
        # Newton's last steps gain so little that the sum would tell by its rounding only.
        checked: cython.bint = not (circle.convex and gain < NEGLIGIBLE_GAIN * cost[k])
        share: cython.double = 1.0
        after: cython.double = circle.sum(share)
        tried: cython.int = 1
        while checked and after > cost[k] and tried < QUARTERINGS:
            share /= 4
            tried += 1
            after = circle.sum(share)
        stuck: cython.bint = checked and after > cost[k]
        if stuck:
            share, after = 0.0, cost[k]
        size: cython.double = 1.0
        moved: cython.double = 0.0
        for i in range(SIZE):
            z[k, i] += share * circle.step[i]
            size = max(size, 1 + fabs(z[k, i]))
            moved = max(moved, fabs(z[k, i] - circle.z[i]))
        left: cython.bint = size > longest[task[k]]
        rest: cython.bint = moved < SETTLED_STEP * size
        rest = rest or cost[k] < ROUNDING * size * (ROUNDING * size)
        settled[k] = rest and circle.convex and not left
        ended[k] = settled[k] or (stuck and not circle.convex) or left
        cost[k] = after
