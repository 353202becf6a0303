# cython: language_level=3, infer_types=True
# cython: boundscheck=False, wraparound=False, cdivision=True, initializedcheck=False
# cython: auto_pickle=False
"""Linkages carried from one Alt-Burmester problem to another, one after the other; compiled.

The equations are those of `alt_burmester`.  On a straight way in points, turns of poses and pivots
a linkage is carried by Runge and Kutta's prediction of fourth order and Newton's correction, in
steps of its own.  A pose is two rows of the linear system, one a dyad; a point is one, from which
its turn is eliminated.
"""

import cython

if not cython.compiled:
    raise ImportError("burmester's kernels are not compiled: install it again, by scripts/setup")

from cython.cimports.libc.math import INFINITY, fabs, isfinite, sqrt

# Numbers that follow are part of the declarations below, which take no names: 8 unknowns, 8
# positions at most beside the base, 9 columns of a system with its right side, in rows of 10.
UNKNOWNS = cython.declare(cython.int, 8)

FIRST_STEP = cython.declare(cython.double, 0.02)  # of the way
SETTLED = cython.declare(cython.double, 1e-9)  # relative; Newton's last step on a point of a path
# The same where rounding keeps a near-singular point from settling.
ROUNDED = cython.declare(cython.double, 1e-6)
NEWTON_STEPS = cython.declare(cython.int, 3)  # that correct a prediction, at most
LAST_NEWTON_STEPS = cython.declare(cython.int, 6)  # at the end
MOST_STEPS = cython.declare(cython.int, 3000)  # of a path
# Of the way; a path that needs shorter steps is lost.
LEAST_STEP = cython.declare(cython.double, 1e-13)
GROWTH = cython.declare(cython.double, 2.0)  # of a step to the next, at most
CUT = cython.declare(cython.double, 0.2)  # the same, at least
SAFETY = cython.declare(cython.double, 0.8)  # of the step that accuracy allows
ORDER = cython.declare(cython.double, 5.0)  # of the error of one step


@cython.cclass
class Way:
    """A straight way between two problems, a place on it, and the linear system there.

    count, poses, pivots: of positions beside the base, of those that are poses, of pivots given.
    start, change: rows P, Pb, T, G, Gb.  P, Pb, T, G, Gb: at the place looked at last.
    dx, dt: the step that was solved for last.
    """

    count: cython.int
    poses: cython.int
    pivots: cython.int
    start: cython.doublecomplex[8][5]
    change: cython.doublecomplex[8][5]
    here: cython.doublecomplex[8][5]
    rows: cython.doublecomplex[4][8][2]
    by_turn: cython.doublecomplex[8][2]
    right: cython.doublecomplex[8][2]
    real: cython.double[10][8]
    imag: cython.double[10][8]
    dx: cython.doublecomplex[8]
    dt: cython.doublecomplex[8]

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def look(self, s: cython.double) -> cython.void:
        """Set the problem at a place s of the way, from 0 to 1."""
        for row in range(5):
            for j in range(UNKNOWNS):
                self.here[row][j] = self.start[row][j] + s * self.change[row][j]

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def solve(
        self,
        x: cython.pointer[cython.doublecomplex],
        t: cython.pointer[cython.doublecomplex],
        along: cython.bint,
    ) -> cython.bint:
        """Set the step of a linkage x with turns t; whether its system is regular.

        along: how both move with the problem (Davidenko's equation); else Newton's step.
        """
        one: cython.doublecomplex = 1.0
        m: cython.int = self.poses
        free: cython.int = self.count - m
        row: cython.int
        i: cython.int
        j: cython.int
        k: cython.int
        for row in range(UNKNOWNS):
            for k in range(10):
                self.real[row][k] = 0.0
                self.imag[row][k] = 0.0
        for j in range(self.count):
            P: cython.doublecomplex = self.here[0][j]
            Pb: cython.doublecomplex = self.here[1][j]
            g: cython.doublecomplex = t[j] - one
            inverse: cython.doublecomplex = one / t[j]
            c: cython.doublecomplex = -(g * inverse)
            for i in range(2):
                u: cython.doublecomplex = x[4 * i]
                ub: cython.doublecomplex = x[4 * i + 1]
                z: cython.doublecomplex = x[4 * i + 2]
                zb: cython.doublecomplex = x[4 * i + 3]
                v: cython.doublecomplex = P + g * z
                w: cython.doublecomplex = Pb + c * zb
                fv: cython.doublecomplex = w - ub
                fw: cython.doublecomplex = v - u
                by_turn: cython.doublecomplex = z * fv - zb * inverse * inverse * fw
                right: cython.doublecomplex
                if along:
                    right = -(fv * self.change[0][j] + fw * self.change[1][j])
                    if j < m:
                        right = right - by_turn * self.change[2][j]
                else:
                    right = w * u - v * fv
                self.rows[i][j][0] = -w
                self.rows[i][j][1] = -v
                self.rows[i][j][2] = g * fv
                self.rows[i][j][3] = c * fw
                self.by_turn[i][j] = by_turn
                self.right[i][j] = right
            if j < m:
                for i in range(2):
                    self.put(i * m + j, 4 * i, self.rows[i][j], one)
                    self.put_right(i * m + j, self.right[i][j])
            else:
                row = m + j
                first: cython.doublecomplex = self.by_turn[1][j]
                second: cython.doublecomplex = -self.by_turn[0][j]
                self.put(row, 0, self.rows[0][j], first)
                self.put(row, 4, self.rows[1][j], second)
                self.put_right(row, first * self.right[0][j] + second * self.right[1][j])
        for i in range(self.pivots):  # u + z = G, and conjugates
            for k in range(2):
                row = 2 * m + free + 2 * i + k
                self.real[row][4 * i + k] = 1.0
                self.real[row][4 * i + 2 + k] = 1.0
                if along:
                    self.put_right(row, self.change[3 + k][i])
                else:
                    gap: cython.doublecomplex = x[4 * i + k] + x[4 * i + 2 + k]
                    self.put_right(row, self.here[3 + k][i] - gap)
        if not self.eliminate():
            return False
        for j in range(self.count):
            if j < m:
                self.dt[j] = self.change[2][j] if along else 0 * one
                continue
            # The turn of a point by least squares from both dyads.
            above: cython.doublecomplex = 0.0
            below: cython.double = 0.0
            for i in range(2):
                rest: cython.doublecomplex = self.right[i][j]
                for k in range(4):
                    rest = rest - self.rows[i][j][k] * self.dx[4 * i + k]
                h: cython.doublecomplex = self.by_turn[i][j]
                above = above + h.conjugate() * rest
                below += h.real * h.real + h.imag * h.imag
            self.dt[j].real = above.real / below
            self.dt[j].imag = above.imag / below
        return True

    @cython.cfunc
    @cython.nogil
    @cython.inline
    @cython.exceptval(check=False)
    def put(
        self,
        row: cython.int,
        column: cython.int,
        values: cython.pointer[cython.doublecomplex],
        factor: cython.doublecomplex,
    ) -> cython.void:
        """Put four values, times a factor, into a row of the system."""
        for k in range(4):
            value: cython.doublecomplex = factor * values[k]
            self.real[row][column + k] = value.real
            self.imag[row][column + k] = value.imag

    @cython.cfunc
    @cython.nogil
    @cython.inline
    @cython.exceptval(check=False)
    def put_right(self, row: cython.int, value: cython.doublecomplex) -> cython.void:
        """Put the right side of a row."""
        self.real[row][UNKNOWNS] = value.real
        self.imag[row][UNKNOWNS] = value.imag

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def eliminate(self) -> cython.bint:
        """Solve the system for dx by Gauss's elimination with column pivots; whether it is regular.

        Real and imaginary parts stand apart, so that a row is worked off in few instructions.
        """
        i: cython.int
        j: cython.int
        k: cython.int
        for k in range(UNKNOWNS):
            best: cython.int = k
            most: cython.double = fabs(self.real[k][k]) + fabs(self.imag[k][k])
            for i in range(k + 1, UNKNOWNS):
                size: cython.double = fabs(self.real[i][k]) + fabs(self.imag[i][k])
                if size > most:
                    best, most = i, size
            if not (most > 0 and isfinite(most)):
                return False
            if best != k:
                for j in range(10):
                    self.real[k][j], self.real[best][j] = self.real[best][j], self.real[k][j]
                    self.imag[k][j], self.imag[best][j] = self.imag[best][j], self.imag[k][j]
            re: cython.double = self.real[k][k]
            im: cython.double = self.imag[k][k]
            size = re * re + im * im
            re, im = re / size, -im / size  # the inverse of the pivot
            self.real[k][k], self.imag[k][k] = re, im
            for i in range(k + 1, UNKNOWNS):
                a: cython.double = self.real[i][k] * re - self.imag[i][k] * im
                b: cython.double = self.real[i][k] * im + self.imag[i][k] * re
                for j in range(k + 1, 9):
                    self.real[i][j] -= a * self.real[k][j] - b * self.imag[k][j]
                    self.imag[i][j] -= a * self.imag[k][j] + b * self.real[k][j]
        for k in range(UNKNOWNS - 1, -1, -1):
            left_re: cython.double = self.real[k][UNKNOWNS]
            left_im: cython.double = self.imag[k][UNKNOWNS]
            for j in range(k + 1, UNKNOWNS):
                left_re -= self.real[k][j] * self.dx[j].real - self.imag[k][j] * self.dx[j].imag
                left_im -= self.real[k][j] * self.dx[j].imag + self.imag[k][j] * self.dx[j].real
            self.dx[k].real = left_re * self.real[k][k] - left_im * self.imag[k][k]
            self.dx[k].imag = left_re * self.imag[k][k] + left_im * self.real[k][k]
        return True

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def newton(
        self,
        x: cython.pointer[cython.doublecomplex],
        t: cython.pointer[cython.doublecomplex],
    ) -> cython.double:
        """Make Newton's step; its length, relative to each dyad and each turn, infinite if none."""
        if not self.solve(x, t, False):
            return INFINITY
        i: cython.int
        k: cython.int
        longest: cython.double = 0.0
        for i in range(2):
            size: cython.double = 0.0
            far: cython.double = 0.0
            for k in range(4 * i, 4 * i + 4):
                size = max(size, x[k].real * x[k].real + x[k].imag * x[k].imag)
                far = max(far, self.dx[k].real ** 2 + self.dx[k].imag ** 2)
            longest = max(longest, sqrt(far) / (1 + sqrt(size)))
        total: cython.double = 0.0  # which is finite where all of the step is
        for k in range(UNKNOWNS):
            total += fabs(self.dx[k].real) + fabs(self.dx[k].imag)
            x[k] = x[k] + self.dx[k]
        for k in range(self.count):
            total += fabs(self.dt[k].real) + fabs(self.dt[k].imag)
            far = self.dt[k].real ** 2 + self.dt[k].imag ** 2
            size = t[k].real * t[k].real + t[k].imag * t[k].imag
            longest = max(longest, sqrt(far / size))
            t[k] = t[k] + self.dt[k]
        return longest if isfinite(total) else INFINITY

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def predict(
        self,
        x: cython.pointer[cython.doublecomplex],
        t: cython.pointer[cython.doublecomplex],
        s: cython.double,
        h: cython.double,
        guess: cython.pointer[cython.doublecomplex],
        guess_t: cython.pointer[cython.doublecomplex],
    ) -> cython.bint:
        """Set Runge and Kutta's prediction at s + h; whether all its systems are regular."""
        there = cython.declare(cython.doublecomplex[8])
        there_t = cython.declare(cython.doublecomplex[8])
        stage: cython.int
        k: cython.int
        for k in range(UNKNOWNS):
            there[k], there_t[k] = x[k], t[k]
            guess[k], guess_t[k] = x[k], t[k]
        for stage in range(4):
            ahead: cython.double = 0.0 if stage == 0 else (h if stage == 3 else h / 2)
            if stage != 2:
                self.look(s + ahead)
            if not self.solve(there, there_t, True):
                return False
            share: cython.double = h / 6 if stage in (0, 3) else h / 3
            ahead = h if stage == 2 else h / 2
            for k in range(UNKNOWNS):
                guess[k] = guess[k] + share * self.dx[k]
                there[k] = x[k] + ahead * self.dx[k]
            for k in range(self.count):
                guess_t[k] = guess_t[k] + share * self.dt[k]
                there_t[k] = t[k] + ahead * self.dt[k]
        for k in range(self.poses):
            guess_t[k] = self.here[2][k]
        return True

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def correct(
        self,
        x: cython.pointer[cython.doublecomplex],
        t: cython.pointer[cython.doublecomplex],
        accuracy: cython.double,
        good: cython.pointer[cython.bint],
    ) -> cython.double:
        """Correct a prediction; how far it was off, and whether it came to a point of the path."""
        first: cython.double = INFINITY
        last: cython.double = INFINITY
        good[0] = False
        for number in range(NEWTON_STEPS):
            before: cython.double = last
            last = self.newton(x, t)
            if number == 0:
                first = last
                if not first < accuracy:
                    break
            # Settled, or so small that the next step would be (Newton's steps square); or steps
            # that no longer shrink, at the floor that rounding sets near a singular point.
            if (
                last < SETTLED
                or (last < 1e-3 * first and last * last < SETTLED * first)
                or (last > 0.1 * before and last < ROUNDED)
            ):
                good[0] = True
                break
        return first

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def follow(
        self,
        x: cython.pointer[cython.doublecomplex],
        t: cython.pointer[cython.doublecomplex],
        accuracy: cython.double,
        steps: cython.pointer[cython.longlong],
    ) -> cython.bint:
        """Carry one linkage to the end of the way; whether it arrived."""
        guess = cython.declare(cython.doublecomplex[8])
        guess_t = cython.declare(cython.doublecomplex[8])
        s: cython.double = 0.0
        step: cython.double = FIRST_STEP
        good: cython.bint = False
        steps[0] = 0
        for _ in range(MOST_STEPS):
            steps[0] += 1
            h: cython.double = min(step, 1 - s)
            factor: cython.double = CUT
            good = False
            if self.predict(x, t, s, h, guess, guess_t):
                miss: cython.double = self.correct(guess, guess_t, accuracy, cython.address(good))
                if isfinite(miss):
                    factor = SAFETY * (accuracy / max(miss, 1e-300)) ** (1 / ORDER)
                    factor = max(CUT, min(GROWTH, factor))
            if good:
                for k in range(UNKNOWNS):
                    x[k], t[k] = guess[k], guess_t[k]
                if h >= 1 - s:
                    return True
                s += h
            else:
                factor = min(factor, 0.5)
            step = h * factor
            if step < LEAST_STEP:
                break
        return False


@cython.cfunc
def way_of(
    start: cython.const[cython.doublecomplex][:, :],
    change: cython.const[cython.doublecomplex][:, :],
    count: cython.int,
    poses: cython.int,
    pivots: cython.int,
) -> Way:
    """A way from a problem (5, 8), rows P, Pb, T, G, Gb, by a change of it."""
    way: Way = Way()
    way.count, way.poses, way.pivots = count, poses, pivots
    for row in range(5):
        for j in range(UNKNOWNS):
            way.start[row][j] = start[row, j]
            way.change[row][j] = change[row, j]
    return way


def follow(
    start: cython.const[cython.doublecomplex][:, :],
    change: cython.const[cython.doublecomplex][:, :],
    count: cython.int,
    poses: cython.int,
    pivots: cython.int,
    accuracy: cython.double,
    x: cython.doublecomplex[:, ::1],
    t: cython.doublecomplex[:, ::1],
    arrived: cython.uchar[:],
    steps: cython.longlong[:],
) -> None:
    """Carry linkages x (n, 8) with turns t (n, 8) over to another problem.

    start, change: (5, 8), rows P, Pb, T, G, Gb of the problem, filled up with zeros; count, poses,
    pivots: how many positions it has beside the base, how many of them have an angle, and how many
    pivots are given.  accuracy: relative; where Newton's first step on a prediction is longer, the
    prediction's step was too long.
    Set are x and t, and arrived (n,) and steps (n,): whether each came to the end, in how many
    steps.
    """
    way: Way = way_of(start, change, count, poses, pivots)
    number: cython.longlong = 0
    for n in range(x.shape[0]):
        arrived[n] = way.follow(
            cython.address(x[n, 0]), cython.address(t[n, 0]), accuracy, cython.address(number)
        )
        steps[n] = number


def polish(
    problem: cython.const[cython.doublecomplex][:, :],
    count: cython.int,
    poses: cython.int,
    pivots: cython.int,
    x: cython.doublecomplex[:, ::1],
    t: cython.doublecomplex[:, ::1],
    miss: cython.double[:],
) -> None:
    """Make Newton's steps from linkages x (n, 8) with turns t (n, 8) of a problem (5, 8).

    Set are x and t as they are behind the shortest step, and miss (n,), its relative length.
    """
    way: Way = way_of(problem, problem, count, poses, pivots)
    way.look(0.0)
    here = cython.declare(cython.doublecomplex[8])
    here_t = cython.declare(cython.doublecomplex[8])
    for n in range(x.shape[0]):
        best: cython.double = INFINITY
        for k in range(UNKNOWNS):
            here[k], here_t[k] = x[n, k], t[n, k]
        for _ in range(LAST_NEWTON_STEPS):
            length: cython.double = way.newton(here, here_t)
            if length < best:
                best = length
                for k in range(UNKNOWNS):
                    x[n, k], t[n, k] = here[k], here_t[k]
        miss[n] = best
