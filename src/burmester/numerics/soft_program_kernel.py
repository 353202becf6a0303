# cython: language_level=3, infer_types=True
# cython: boundscheck=False, wraparound=False, cdivision=True, initializedcheck=False
"""The inner loops of `quadratic_program`: one program after the other, number by number; compiled.

The programs are small, and their steps depend on each other: loops over numbers beat operations on
stacks of arrays many times over.  What is solved, and by which methods: see `quadratic_program`.
"""

import cython
import numpy as np

if not cython.compiled:
    raise ImportError("burmester's kernels are not compiled: install it again, by scripts/setup")

from cython.cimports.libc.math import fabs, sqrt

STEPS_FROM_START = cython.declare(cython.int, 4)  # of projected Newton, from multipliers far off
STEPS_FROM_INSIDE = cython.declare(cython.int, 2)  # of it from where the interior point led
INTERIOR_STEPS = cython.declare(cython.int, 25)  # at most; it takes about twelve
INSIDE = cython.declare(cython.double, 0.995)  # share of the way to the nearest bound
NEAR_BOUND = cython.declare(cython.double, 1e-9)  # of the way between bounds; nearer is held
SETTLED_GAP = cython.declare(cython.double, 1e-9)  # of the height; less is no gap to the best
SETTLED = cython.declare(cython.double, 1e-11)  # of the terms of w; a free one off by less is met
HEIGHT_ROUNDING = cython.declare(cython.double, 1e-13)  # relative; a smaller decrease is none
ROUNDING = cython.declare(cython.double, 1e-12)  # added to A's diagonal, for dependent constraints
SMALLEST = cython.declare(cython.double, 1e-6)  # relative; a shorter row of the root counts as that
TINY = cython.declare(cython.double, 1e-300)  # keeps what may be 0 from dividing by 0
DOWNHILL_TRIALS = cython.declare(cython.int, 3)  # shares of the gradient, beside Newton's step


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def factorise(matrix: cython.double[:, ::1], count: cython.Py_ssize_t) -> cython.void:
    """Put the Cholesky factor in the place of a matrix's lower triangle."""
    for i in range(count):
        for j in range(i + 1):
            rest: cython.double = matrix[i, j]
            for k in range(j):
                rest -= matrix[i, k] * matrix[j, k]
            matrix[i, j] = sqrt(rest) if i == j else rest / matrix[j, j]


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def solve_lower(
    factor: cython.double[:, ::1], x: cython.double[::1], count: cython.Py_ssize_t
) -> cython.void:
    """Put the x' with factor x' = x in the place of x."""
    for i in range(count):
        rest: cython.double = x[i]
        for k in range(i):
            rest -= factor[i, k] * x[k]
        x[i] = rest / factor[i, i]


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def solve_upper(
    factor: cython.double[:, ::1], x: cython.double[::1], count: cython.Py_ssize_t
) -> cython.void:
    """Put the x' with factorᵀ x' = x in the place of x."""
    for i in range(count - 1, -1, -1):
        rest: cython.double = x[i]
        for k in range(i + 1, count):
            rest -= factor[k, i] * x[k]
        x[i] = rest / factor[i, i]


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
@cython.inline
def between(x: cython.double, low: cython.double, high: cython.double) -> cython.double:
    """The nearest number to x that is between two others."""
    return low if x < low else (high if x > high else x)


@cython.cclass
class BoxProgram:
    """The least |y root|² / 2 - b · y for m multipliers y between bounds.

    root: (m, n), its rows of unit length; b, low, high, y: (m,); off: (m,), the way downhill at y:
    w; sum: (n,), y root.  All other arrays are room to work in.
    """

    m: cython.Py_ssize_t
    n: cython.Py_ssize_t
    most: cython.Py_ssize_t  # number of multipliers that may be free in a step
    root: cython.double[:, ::1]
    b: cython.double[::1]
    low: cython.double[::1]
    high: cython.double[::1]
    y: cython.double[::1]
    off: cython.double[::1]
    sum: cython.double[::1]
    free: cython.Py_ssize_t[::1]  # the numbers of those that are free
    step: cython.double[::1]  # of these
    trial: cython.double[::1]
    best: cython.double[::1]
    whole: cython.double[::1]
    system: cython.double[:, ::1]
    inner: cython.double[:, ::1]
    along: cython.double[::1]
    gap: cython.double[:, ::1]
    price: cython.double[:, ::1]
    aim: cython.double[:, ::1]
    narrowed: cython.double[::1]
    cheaper: cython.double[:, ::1]
    weight: cython.double[::1]

    def __init__(self, m: cython.Py_ssize_t, n: cython.Py_ssize_t) -> None:
        self.m, self.n, self.most = m, n, min(m, 2 * n)
        self.root, self.inner = np.empty((m, n)), np.empty((n, n))
        self.b, self.low, self.high, self.y, self.off = np.empty((5, m))
        self.step, self.trial, self.best, self.whole, self.weight = np.empty((5, m))
        self.narrowed = np.empty(m)
        self.sum, self.along = np.empty((2, n))
        self.free = np.empty(m, dtype=np.intp)
        self.system = np.empty((self.most, self.most))
        self.gap, self.price, self.aim, self.cheaper = np.empty((4, 2, m))

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def look(self) -> cython.void:
        """Set `off` and `sum` at y."""
        for j in range(self.n):
            self.sum[j] = 0.0
        for i in range(self.m):
            if self.y[i] != 0.0:
                for j in range(self.n):
                    self.sum[j] += self.y[i] * self.root[i, j]
        for i in range(self.m):
            rest: cython.double = self.b[i]
            for j in range(self.n):
                rest -= self.root[i, j] * self.sum[j]
            self.off[i] = rest

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def descended(self, steps: cython.int, most: cython.Py_ssize_t) -> cython.bint:
        """Whether y is settled after so many projected Newton steps, at most.

        With more than `most` free multipliers there is no further step.
        """
        for taken in range(steps + 1):
            self.look()
            count: cython.Py_ssize_t = 0
            worst: cython.double = 0.0
            terms: cython.double = 0.0
            for i in range(self.m):
                y: cython.double = self.y[i]
                off: cython.double = self.off[i]
                if (y <= self.low[i] and off < 0) or (y >= self.high[i] and off > 0):
                    terms = max(terms, fabs(y))
                else:
                    terms = max(terms, fabs(self.b[i]))
                    worst = max(worst, fabs(off))
                    self.free[count] = i
                    count += 1
            if worst <= SETTLED * terms:
                return True
            if taken == steps or count > most:
                return False
            better: cython.int = self.stepped(count)
            if better != 1:
                return better == 2
        return False

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def newton_step(self, count: cython.Py_ssize_t) -> cython.void:
        """Set `step` to Newton's step of the free multipliers, those that it holds keeping still.

        Held are those with a `whole` of 0.
        """
        for a in range(count):
            i = self.free[a]
            held: cython.bint = self.whole[a] == 0.0
            self.step[a] = 0.0 if held else self.off[i]
            for c in range(a + 1):
                j = self.free[c]
                total: cython.double = 0.0
                if not held and self.whole[c] != 0.0:
                    for k in range(self.n):
                        total += self.root[i, k] * self.root[j, k]
                self.system[a, c] = total
            self.system[a, a] += 1.0 if held else ROUNDING
        factorise(self.system, count)
        solve_lower(self.system, self.step, count)
        solve_upper(self.system, self.step, count)

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def rise(self, count: cython.Py_ssize_t, share: cython.double, by: cython.int) -> cython.double:
        """Set `trial` to the bent end of a share of the step (by 1: of the gradient).

        Returns how much higher it is.
        """
        for k in range(self.n):
            self.along[k] = 0.0
        linear: cython.double = 0.0
        for a in range(count):
            i = self.free[a]
            way: cython.double = share * (self.off[i] if by == 1 else self.step[a])
            self.trial[a] = between(self.y[i] + way, self.low[i], self.high[i])
            way = self.trial[a] - self.y[i]
            if way != 0.0:
                linear += way * self.off[i]
                for k in range(self.n):
                    self.along[k] += way * self.root[i, k]
        square: cython.double = 0.0
        for k in range(self.n):
            square += self.along[k] * self.along[k]
        return square / 2 - linear

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def keep_trial(self, count: cython.Py_ssize_t) -> cython.void:
        """What was tried is the best so far."""
        for a in range(count):
            self.best[a] = self.trial[a]

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def stepped(self, count: cython.Py_ssize_t) -> cython.int:
        """One step of the free multipliers: 0 if it is not better, 1 if it is, 2 at the end.

        The end is the least height but for rounding: Newton's step promises no more, and is taken
        for its w.
        """
        for a in range(count):
            self.whole[a] = 1.0
        self.newton_step(count)
        promise: cython.double = 0.0
        height: cython.double = 0.0
        for i in range(self.m):
            height += (self.b[i] + self.off[i]) * self.y[i] / 2  # off = b - A y
        hidden: cython.double = HEIGHT_ROUNDING * fabs(height)
        for a in range(count):
            promise += self.step[a] * self.off[self.free[a]] / 2
        if promise <= hidden:
            for a in range(count):
                i = self.free[a]
                self.y[i] = between(self.y[i] + self.step[a], self.low[i], self.high[i])
            return 2
        held: cython.bint = False
        for a in range(count):
            i = self.free[a]
            step: cython.double = self.step[a]
            y: cython.double = self.y[i]
            if (y <= self.low[i] and step < 0) or (y >= self.high[i] and step > 0):
                self.whole[a] = 0.0
                held = True
        if held:
            self.newton_step(count)
        # Along the step bent at the bounds: at its end, at each bend, and a little downhill.
        least: cython.double = self.rise(count, 1.0, 0)
        self.keep_trial(count)
        for a in range(count):
            i = self.free[a]
            step: cython.double = self.step[a]
            if step != 0.0:
                share: cython.double = (
                    (self.high[i] if step > 0 else self.low[i]) - self.y[i]
                ) / step
                if share < 1.0:
                    now: cython.double = self.rise(count, share, 0)
                    if now < least:
                        least = now
                        self.keep_trial(count)
        share = 1.0
        for _ in range(DOWNHILL_TRIALS):
            now = self.rise(count, share, 1)
            if now < least:
                least = now
                self.keep_trial(count)
            share *= 0.3
        if not -least > hidden:
            return 0
        for a in range(count):
            self.y[self.free[a]] = self.best[a]
        return 1

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def interior_step(self) -> cython.double:
        """Set `narrowed` and `cheaper`: Newton's step to where gaps times prices are `aim`.

        `inner` is factorised.  Returns the greatest share of it, at most 1, that leaves all gaps
        and prices above 0.
        """
        for k in range(self.n):
            self.along[k] = 0.0
        for i in range(self.m):
            right: cython.double = (
                self.off[i] - self.aim[0, i] / self.gap[0, i] + self.aim[1, i] / self.gap[1, i]
            )
            right *= self.weight[i]
            self.step[i] = right
            for k in range(self.n):
                self.along[k] += right * self.root[i, k]
        solve_lower(self.inner, self.along, self.n)
        solve_upper(self.inner, self.along, self.n)
        fall: cython.double = 1.0
        for i in range(self.m):
            total: cython.double = 0.0
            for k in range(self.n):
                total += self.root[i, k] * self.along[k]
            self.step[i] -= self.weight[i] * total
            for side in range(2):
                narrowed: cython.double = (
                    self.step[i] if side == 1 else -self.step[i]
                )  # the gap above, or below
                gap: cython.double = self.gap[side, i]
                price: cython.double = self.price[side, i]
                cheaper: cython.double = (self.aim[side, i] - price * narrowed) / gap - price
                self.cheaper[side, i] = cheaper
                fall = max(fall, -narrowed / gap, -cheaper / price)
        return 1 / fall

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def interior(self) -> cython.void:
        """Set y by the interior-point method from the middle, those near a bound put on it."""
        spread: cython.double = 0.0
        for i in range(self.m):
            self.y[i] = (self.low[i] + self.high[i]) / 2
        self.look()
        for i in range(self.m):
            spread += fabs(self.off[i]) / self.m
        for i in range(self.m):
            self.price[0, i] = max(self.off[i], 0.0) + spread + TINY
            self.price[1, i] = max(-self.off[i], 0.0) + spread + TINY
        for _ in range(INTERIOR_STEPS):
            self.look()
            rest: cython.double = 0.0
            for i in range(self.m):
                least: cython.double = 2.2e-16 * (self.high[i] - self.low[i])
                self.gap[0, i] = max(self.high[i] - self.y[i], least)
                self.gap[1, i] = max(self.y[i] - self.low[i], least)
                stiff: cython.double = ROUNDING
                for side in range(2):
                    rest += self.gap[side, i] * self.price[side, i]
                    stiff += self.price[side, i] / self.gap[side, i]
                    self.aim[side, i] = 0.0
                self.weight[i] = 1 / stiff
            for j in range(self.n):
                for k in range(j + 1):
                    self.inner[j, k] = 1.0 if j == k else 0.0
            for i in range(self.m):
                for j in range(self.n):
                    part: cython.double = self.weight[i] * self.root[i, j]
                    for k in range(j + 1):
                        self.inner[j, k] += part * self.root[i, k]
            factorise(self.inner, self.n)
            # Mehrotra's step: aimed as far ahead as the plain one leads, and bent as that bends.
            share: cython.double = self.interior_step()
            ahead: cython.double = 0.0
            for i in range(self.m):
                for side in range(2):
                    narrowed: cython.double = self.step[i] if side == 1 else -self.step[i]
                    gap: cython.double = self.gap[side, i] + share * narrowed
                    ahead += gap * (self.price[side, i] + share * self.cheaper[side, i])
            ahead = between(ahead / rest, 0.0, 1.0)
            ahead = rest / (2 * self.m) * ahead * ahead * ahead
            for i in range(self.m):
                for side in range(2):
                    narrowed = self.step[i] if side == 1 else -self.step[i]
                    self.aim[side, i] = ahead - narrowed * self.cheaper[side, i]
            share = INSIDE * self.interior_step()
            height: cython.double = TINY
            for i in range(self.m):
                self.y[i] += share * self.step[i]
                height += fabs(self.b[i] * self.y[i])
                for side in range(2):
                    self.price[side, i] += share * self.cheaper[side, i]
            if not rest > SETTLED_GAP * height:
                break
        for i in range(self.m):
            near: cython.double = NEAR_BOUND * (self.high[i] - self.low[i])
            if self.y[i] - self.low[i] < near:
                self.y[i] = self.low[i]
            if self.high[i] - self.y[i] < near:
                self.y[i] = self.high[i]


def solve_programs(
    hessian: cython.const[cython.double][:, :, :],
    gradient: cython.const[cython.double][:, :],
    value: cython.const[cython.double][:, :],
    jacobian: cython.const[cython.double][:, :, :],
    low: cython.const[cython.double][:, :],
    high: cython.const[cython.double][:, :],
    multipliers: cython.double[:, ::1],
    step: cython.double[:, ::1],
) -> None:
    """Put the solutions into `step` (k, n) and `multipliers` (k, m), started from these."""
    m, n = value.shape[1], gradient.shape[1]
    box: BoxProgram = BoxProgram(m, n)
    factor: cython.double[:, ::1] = np.empty((n, n))
    size: cython.double[::1] = np.empty(m)
    for r in range(value.shape[0]):
        for i in range(n):
            for j in range(i + 1):
                factor[i, j] = hessian[r, i, j]
        factorise(factor, n)
        down = step[r]
        for j in range(n):
            down[j] = gradient[r, j]
        solve_lower(factor, down, n)
        greatest: cython.double = 0.0
        for i in range(m):
            row = box.root[i]
            for j in range(n):
                row[j] = jacobian[r, i, j]
            solve_lower(factor, row, n)
            length: cython.double = 0.0
            box.b[i] = value[r, i]
            for j in range(n):
                length += row[j] * row[j]
                box.b[i] -= row[j] * down[j]
            size[i] = sqrt(length)
            greatest = max(greatest, size[i])
        for i in range(m):
            size[i] = max(size[i], SMALLEST * greatest + TINY)
            for j in range(n):
                box.root[i, j] /= size[i]
            box.b[i] /= size[i]
            box.low[i], box.high[i] = low[r, i] * size[i], high[r, i] * size[i]
            box.y[i] = between(multipliers[r, i] * size[i], box.low[i], box.high[i])
        # Where more are free than there are unknowns the start is far off.
        if not box.descended(STEPS_FROM_START, min(n, box.most)):
            box.interior()
            box.descended(STEPS_FROM_INSIDE, box.most)
        for i in range(m):
            multipliers[r, i] = between(box.y[i] / size[i], low[r, i], high[r, i])
            for j in range(n):
                down[j] += box.y[i] * box.root[i, j]
        solve_upper(factor, down, n)
        for j in range(n):
            down[j] = -down[j]
