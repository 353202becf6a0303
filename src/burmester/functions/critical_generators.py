"""All critical points of the squared residual of Freudenstein's equation, for any number of pairs.

With R3 gone by centring, the residual is linear in

    w = (R1 X, R1 / X, R2 Y, R2 / Y, Y / X, X / Y),   X = e^(i output phase), Y = e^(i input phase),

so its sum of squares is w' G w / 4 with a symmetric G that the pairs give (no conjugates: R1, R2, X
and Y may be any complex numbers).  In the logarithms v of (R1, X, R2, Y) w = exp(E v), and

    gradient  E' (w o G w),   Hessian  E' (diag(w) G diag(w) + diag(w o G w)) E.

Of generic pairs there are 56 critical w with both phases free, 28 linkages, for w and -w are one;
12, or 6 linkages, with one phase given.  They are reached by path following from a generic G
of which all are stored (`start_points.npz`, made by scripts/function_start_points.py), and counted.
"""

from __future__ import annotations

from functools import cache
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import ComplexArray, FloatArray, unique_index
from burmester.numerics.linear_algebra import solve_or_shortest
from burmester.tasks.function_task import FunctionTask

REAL_TOLERANCE = 1e-6  # relative; a point whose w differs less from its mirror image is real
SAME_POINT = 1e-6  # relative, of w w'; ends nearer than this are one
PREDICTION_TOLERANCE = 1e-2  # of a logarithm; a step whose prediction is farther off is shortened
CORRECTION_TOLERANCE = 1e-7  # Newton's last step on a point of a path, of a logarithm
LAST_TOLERANCE = 1e-6  # the same at its end, where rounding is greater
NEWTON_STEPS = 3
FIRST_STEP, MIN_STEP, MAX_STEPS = 0.05, 1e-6, 800  # of the way; of what is left of it; steps
STEP_GROWTH, STEP_CUT = 1.7, 3.0
LARGEST = 30.0  # of the logarithm of a ratio; a greater one is infinite
RUNNING, LOST, ARRIVED = -1, 0, 1  # states of a path
DETOURS = 2  # other ways tried where paths were lost

# The powers of (R1, X, R2, Y) in each of the six terms.
ENDS: Final = np.array(
    [[1, 1, 0, 0], [1, -1, 0, 0], [0, 0, 1, 1], [0, 0, 1, -1], [0, -1, 0, 1], [0, 1, 0, -1]],
    dtype=float,
)
# The residual in cosines and sines of output, input and their difference, in the six terms.
OF_COSINES: Final = np.concatenate(
    [np.kron(np.diag([1, -1, -1]), [1, 1]), np.kron(np.diag([1j, -1j, -1j]), [1, -1])]
)
MIRROR: Final = np.array([1, 0, 3, 2, 5, 4])  # the term that is a real term's conjugate


class CriticalGenerators(NamedTuple):
    """The critical points of a task.

    ratios: (k, 2), R1 and R2; input_phase, output_phase: (k,), radians.  Of points that are not
        real these are the nearest real ones.  Behind those that were reached stand the places at
        which paths were lost, to start from as well.
    real: (k,); found: how many different points were reached.
    """

    ratios: FloatArray
    input_phase: FloatArray
    output_phase: FloatArray
    real: NDArray[np.bool_]
    found: int


def critical_generators(task: FunctionTask) -> CriticalGenerators:
    """All critical points of the squared residual, with one phase or both free.

    Formula `freudenstein-critical` of the theory.
    """
    swapped = task.input_phase is None and task.output_phase is not None
    root = residual_root(task, swapped=swapped)
    both = task.free_phases == 2
    start, points = _start("both" if both else "one")
    ends, lost = _tracked(points, start, root, exponents(both))
    v = np.concatenate([ends, lost])
    w = terms(v, exponents(both))
    real = np.abs(w - w[:, MIRROR].conj()).max(axis=-1) < REAL_TOLERANCE * np.abs(w).max(axis=-1)
    ratio = np.exp(v[:, [0, 2]].real) * np.where(np.cos(v[:, [0, 2]].imag) < 0, -1.0, 1.0)
    output_phase = v[:, 1].imag + (task.output_phase or 0.0)
    input_phase = np.full(len(v), task.input_phase or 0.0)
    if both:
        input_phase = v[:, 3].imag
    if swapped:  # the equation is the same with input and output exchanged, but for signs
        ratio = -ratio[:, ::-1]
        input_phase = v[:, 1].imag
        output_phase = np.full(len(v), task.output_phase or 0.0)
    real &= np.arange(len(v)) < len(ends)
    return CriticalGenerators(ratio, input_phase, output_phase, real, len(ends))


def residual_root(task: FunctionTask, *, swapped: bool = False) -> ComplexArray:
    """A root (6, 6) of the matrix G of a task, of unit norm; given phases are part of it.

    swapped: whether input and output exchange their roles.
    """
    theta, phi = task.inputs, task.outputs
    theta = theta + (task.input_phase or 0.0)
    phi = phi + (task.output_phase or 0.0)
    if swapped:
        theta, phi = phi, theta
    angles = np.stack([phi, theta, theta - phi], axis=-1)
    rows = np.concatenate([np.cos(angles), np.sin(angles)], axis=-1)
    share = np.ones(len(theta)) if task.weights is None else task.weights
    share = share / share.sum()
    rows = (rows - share @ rows) * np.sqrt(share)[:, None]
    if len(rows) < len(OF_COSINES):
        rows = np.concatenate([rows, np.zeros((len(OF_COSINES) - len(rows), len(OF_COSINES)))])
    root = np.linalg.qr(rows, mode="r") @ OF_COSINES
    return np.asarray(root / np.sqrt(np.linalg.norm(root.T @ root)))


def exponents(both: bool) -> FloatArray:
    """E: (6, 4) with both phases free; (6, 3) with the input phase given and its part in G."""
    return ENDS if both else ENDS[:, :3]


def terms(v: ComplexArray, e: FloatArray) -> ComplexArray:
    """The six terms (*, 6) at logarithms v (*, n)."""
    return np.exp(v @ e.T)


def gradient(
    v: ComplexArray, root: ComplexArray, e: FloatArray
) -> tuple[ComplexArray, ComplexArray]:
    """Half the gradient (*, n) and the Hessian (*, n, n) at logarithms v (*, n).

    root: (m, 6) or (*, m, 6), with G = root' root: the residuals of smooth functions nearly vanish,
    and G itself would have lost them to rounding.
    """
    w = terms(v, e)
    parts = root * w[..., None, :]
    residual = parts.sum(axis=-1)
    each = (np.swapaxes(parts, -1, -2) @ residual[..., None])[..., 0]
    slopes = parts @ e
    hessian = np.swapaxes(slopes, -1, -2) @ slopes + (e.T * each[..., None, :]) @ e
    return each @ e, hessian


# --- path following


@cache
def _start(name: str) -> tuple[ComplexArray, ComplexArray]:
    """A root of a generic matrix G, and all its critical points as logarithms (k, n)."""
    from importlib import resources  # noqa: PLC0415  exact pairs do without it

    with (
        resources.files("burmester.functions").joinpath("start_points.npz").open("rb") as file,
        np.load(file, allow_pickle=False) as table,
    ):
        root, points = (np.asarray(table[f"{name}/{part}"]) for part in ("root", "points"))
    return root, points


def _tracked(
    points: ComplexArray, start: ComplexArray, root: ComplexArray, e: FloatArray
) -> tuple[ComplexArray, ComplexArray]:
    """The different ends (k, n) of all paths, and where lost ones (l, n) were lost."""
    ends, state = follow(points, start, root, e)
    found, lost = _different(ends[state == ARRIVED], e), ends[state == LOST]
    rng = np.random.default_rng(0)
    for _ in range(DETOURS):
        if len(found) >= len(points):
            break
        real, imaginary = rng.normal(size=(2, 6, 6))
        between = real + 1j * imaginary
        between = between / np.sqrt(np.linalg.norm(between.T @ between))
        way, state = follow(points, start, between, e)
        more, reached = follow(way[state == ARRIVED], between, root, e)
        before, found = (
            len(found),
            _different(np.concatenate([found, more[reached == ARRIVED]]), e),
        )
        if len(found) == before:
            break
    return found, lost if len(found) < len(points) else lost[:0]


def follow(
    points: ComplexArray, start: ComplexArray, end: ComplexArray, e: FloatArray
) -> tuple[ComplexArray, NDArray[np.int_]]:
    """Critical points (k, n) of one matrix G, carried over to another: the ends, and their states.

    A root of G runs straight from the first to the second.  The share `left` of the first one is
    what is counted: a nearly singular G shows only as that becomes as small as the least of its
    residuals.  Runge and Kutta's prediction, Newton's correction, steps that adapt.
    """
    x, left = points.copy(), np.ones(len(points))
    step, state = np.full(len(x), FIRST_STEP), np.full(len(x), RUNNING)

    def between(left: FloatArray) -> ComplexArray:
        return end + left[:, None, None] * (start - end)

    def velocity(v: ComplexArray, left: FloatArray) -> ComplexArray:
        root, change = between(left), start - end
        _, hessian = gradient(v, root, e)
        w = terms(v, e)
        here, moved = root * w[:, None, :], change * w[:, None, :]
        both = (here * moved.sum(axis=-1)[..., None]).sum(axis=1)
        both = both + (moved * here.sum(axis=-1)[..., None]).sum(axis=1)
        return np.asarray(-solve_or_shortest(hessian, both @ e))

    for _ in range(MAX_STEPS):
        run = np.flatnonzero(state == RUNNING)
        if not len(run):
            break
        u, v = left[run], x[run]
        there = np.where(step[run] >= u, 0.0, u - step[run])
        h = there - u
        with np.errstate(all="ignore"):
            half = h[:, None] / 2
            k1 = velocity(v, u)
            k2 = velocity(v + half * k1, u + h / 2)
            k3 = velocity(v + half * k2, u + h / 2)
            k4 = velocity(v + 2 * half * k3, there)
            guess = v + half / 3 * (k1 + 2 * k2 + 2 * k3 + k4)
            corrected, root = guess, between(there)
            for _ in range(NEWTON_STEPS):
                value, hessian = gradient(corrected, root, e)
                last = solve_or_shortest(hessian, value)
                corrected = corrected - last
            last_size, moved = np.abs(last).max(axis=1), np.abs(corrected - guess).max(axis=1)
            within = np.where(there == 0, LAST_TOLERANCE, CORRECTION_TOLERANCE)
            good = (last_size < within) & (moved < PREDICTION_TOLERANCE)
        advanced = run[good]
        x[advanced], left[advanced] = corrected[good], there[good]
        step[run] = np.where(good, -STEP_GROWTH * h, -h / STEP_CUT)
        far = np.abs(x[run].real).max(axis=1) > LARGEST
        state[run[(step[run] < MIN_STEP * left[run]) | far]] = LOST
        state[advanced[left[advanced] == 0]] = ARRIVED
    state[state == RUNNING] = LOST
    return x, state


def _different(v: ComplexArray, e: FloatArray) -> ComplexArray:
    """Those of points (k, n) that repeat no earlier one; w and -w are one."""
    w = terms(v, e)
    first, second = np.triu_indices(6)
    products = w[:, first] * w[:, second]
    products = products / np.abs(products).max(axis=1, keepdims=True)
    rows = np.concatenate([products.real, products.imag], axis=1)
    return v[unique_index(rows, SAME_POINT, "maximum")]
