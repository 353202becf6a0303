"""Three, four and five pairs of angles: all function generators that meet them exactly.

As many phases may be chosen as there are pairs beyond three.  With both phases given, three pairs
make Freudenstein's equation linear.  With one, four pairs leave a quadratic equation in the cosine
and sine of the other.  With none, the equations of five pairs are linear in the links as complex
numbers and in the product of two of them; that it is their product leaves one cubic.

Freudenstein's equation is linear in three ratios of the links,

    R1 cos(phi) - R2 cos(theta) + R3 = cos(theta - phi),
    R1 = 1 / a,  R2 = 1 / b,  R3 = (1 + a² + b² - r²) / (2 a b)

with the input link a at the angle theta, the output link b at phi, the coupler r, and the ground
link as unit (Transactions of the ASME 77 (1955), 853-861).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.functions.generator import Generator
from burmester.numerics.arrays import ComplexArray, FloatArray
from burmester.tasks.function_task import FunctionTask

SINGULAR = 1e-9  # singular value of unit columns; below, infinitely many ratios fit the pairs
REAL = 1e-7  # relative; a root of the cubic with less imaginary part is real
LONGEST = 1e6  # ground links; a longer link is a slider up to rounding


class ExactGenerators(NamedTuple):
    """All generators of exact pairs.

    generators: (k,), those of finite size.
    sliders: how many of the real ones have a link without end, or beyond LONGEST ground links.
    determined: False where there are infinitely many; then these are some of them at best.
    """

    generators: Generator
    sliders: int
    determined: bool


def exact_generators(task: FunctionTask) -> ExactGenerators:
    """All generators of a task with as many pairs as `exact_count` says.

    On the side of the diagonal where the errors are less: pairs on both sides are on two branches.
    """
    if task.input_phase is None and task.output_phase is None:
        return _five(task)
    if task.input_phase is not None and task.output_phase is not None:
        given, other = np.array([task.input_phase]), np.array([task.output_phase])
        found, determined = generators_of_phases(task, given, other)
        return _all(task, found, determined=bool(determined.all()))
    known = "input" if task.input_phase is not None else "output"
    given = np.array([task.input_phase if known == "input" else task.output_phase], dtype=float)
    other, determined = other_phases(task, given, known)
    some = np.isfinite(other).ravel()
    known_phase = np.broadcast_to(given[:, None], other.shape)
    phases = known_phase, np.nan_to_num(other)  # an SVD takes no nan
    found, regular = generators_of_phases(task, *(phases if known == "input" else phases[::-1]))
    sure = bool(determined.all() and regular.ravel()[some].all())
    some_found = found[np.nonzero(some[None])] if some.any() else found[:, :0][0]
    return _all(task, some_found, determined=sure)


def generators_of_phases(
    task: FunctionTask, input_phase: FloatArray, output_phase: FloatArray
) -> tuple[Generator, NDArray[np.bool_]]:
    """The generators (*,) with phases (*,), of the least residual, and whether they are determined.

    nan where the ratios have no linkage.
    """
    theta = input_phase[..., None] + task.inputs
    phi = output_phase[..., None] + task.outputs
    found, least = ratios(theta, phi, task.weights)
    return generators_of_ratios(found, input_phase, output_phase), least > SINGULAR


def other_phases(
    task: FunctionTask, given: FloatArray, known: str
) -> tuple[FloatArray, NDArray[np.bool_]]:
    """The other phases (*, 2) with which four pairs fit a given phase (*,), within half a turn.

    The four equations have a solution where their determinant vanishes; two of its columns are
    linear in the cosine and sine of the phase.
    known: "input" or "output", the phase that is given.
    Returns nan where there are none, and whether the determinant is not zero throughout, (*,).
    """
    x, y = task.inputs, task.outputs
    columns = []
    for turn in (0.0, np.pi / 2):  # the phase's cosine is 1, its sine is 1
        if known == "input":
            columns.append(rows(given[..., None] + x, np.asarray(turn) + y))
        else:
            columns.append(rows(np.asarray(turn) + x, given[..., None] + y))
    moving = 0 if known == "input" else 1

    def determinant(first: int, second: int) -> FloatArray:
        matrix = columns[0].copy()
        matrix[..., moving] = columns[first][..., moving]
        matrix[..., 3] = columns[second][..., 3]
        return np.asarray(np.linalg.det(matrix))

    a, c = determinant(0, 0), determinant(1, 1)
    b = determinant(0, 1) + determinant(1, 0)
    # a cos² + b cos sin + c sin² = 0, in the double angle
    size = np.hypot(a - c, b)
    with np.errstate(invalid="ignore", divide="ignore"):
        half = np.arccos(-(a + c) / size)
    middle = np.arctan2(b, a - c)
    phases = np.stack([middle + half, middle - half], axis=-1) / 2
    return phases, size + np.abs(a + c) > SINGULAR**2


def _five(task: FunctionTask) -> ExactGenerators:
    """By the cubic of five pairs.

    With the links as complex numbers, A = a e^(ip) at inputs x and B = b e^(iq) at outputs y, the
    coupler's length is the same at all pairs where

        c + Re(B e^(iy)) - Re(A e^(ix)) - Re(A B* e^(i(x - y))) = 0,

    five equations in seven numbers c, B, A, D, up to a factor k.  On the line of their solutions
    k A . k B* = k . k D with a real k: the imaginary part of A B* D* is zero.
    """
    turns = np.exp(1j * np.stack([task.outputs, task.inputs, task.inputs - task.outputs], axis=-1))
    columns = np.stack([turns.real, -turns.imag], axis=-1) * np.array([1.0, -1.0, -1.0])[:, None]
    rows_of_pairs = np.column_stack([np.ones(5), columns.reshape(5, 6)])
    _, values, rest = np.linalg.svd(rows_of_pairs)
    line = rest[5:, 1::2] + 1j * rest[5:, 2::2]  # (2, 3): B, A, D of two points of the line
    along, cubic = _cubic(line)
    determined = bool(values[-1] > SINGULAR and np.abs(cubic).max() > SINGULAR)
    share = np.roots(cubic) if determined else np.empty(0)
    share = share.real[np.abs(share.imag) < REAL * (1 + np.abs(share))]
    B, A, D = (along[0] + share[:, None] * along[1]).T
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        factor = (A * np.conj(B * D)).real / (D.real**2 + D.imag**2)
        A, B = A / factor, B / factor
        ends = 1 + B[:, None] * turns[:, 0] - A[:, None] * turns[:, 1]
        found = Generator(
            np.abs(A),
            np.abs(ends).mean(axis=-1),
            np.abs(B),
            np.angle(A),
            np.angle(B),
            np.ones(len(A)),
        )
    return _all(task, found, determined=determined)


def _cubic(line: ComplexArray) -> tuple[ComplexArray, FloatArray]:
    """Points u, v (2, 3) of a line, and the imaginary part of A B* D* at u + s v as a cubic in s.

    v is, of some, the point where it is greatest, so that no root is at infinity.
    """
    angle = np.pi * np.arange(8) / 8
    points = np.cos(angle)[:, None] * line[0] + np.sin(angle)[:, None] * line[1]
    value = (points[:, 1] * np.conj(points[:, 0] * points[:, 2])).imag
    turn = angle[np.abs(value).argmax()]
    v = np.cos(turn) * line[0] + np.sin(turn) * line[1]
    u = -np.sin(turn) * line[0] + np.cos(turn) * line[1]
    (b0, a0, d0), (b1, a1, d1) = np.conj(u), np.conj(v)
    a0, a1 = np.conj(a0), np.conj(a1)
    product = np.array([a1 * b1, a1 * b0 + a0 * b1, a0 * b0])
    cubic = np.append(product * d1, 0) + np.append(0, product * d0)
    return np.stack([u, v]), np.asarray(cubic.imag)


def _all(task: FunctionTask, found: Generator, *, determined: bool) -> ExactGenerators:
    found = found[np.isfinite(found.coupler) & np.isfinite(found.output_link)]
    finite = (found.sizes < LONGEST).all(axis=-1) & (found.sizes > 1 / LONGEST).all(axis=-1)
    sliders = int((~finite).sum())
    found = found[finite].with_better_side(task.inputs, task.outputs)
    return ExactGenerators(found, sliders, determined)


def rows(theta: FloatArray, phi: FloatArray) -> FloatArray:
    """The equation's terms (*, N, 4) at link angles (*, N): of R1, R2 and R3, and the right side.

    Formula `freudenstein` of the theory.
    """
    theta, phi = np.broadcast_arrays(theta, phi)
    terms = [np.cos(phi), -np.cos(theta), np.ones_like(phi), np.cos(theta - phi)]
    return np.stack(terms, axis=-1)


def ratios(
    theta: FloatArray, phi: FloatArray, weights: FloatArray | None = None
) -> tuple[FloatArray, FloatArray]:
    """The ratios (*, 3) of the least squared residual at angles (*, N), and the rank's measure.

    The second is the least singular value (*,) of the equations, of unit columns: as it vanishes,
    infinitely many ratios do.
    """
    every = rows(theta, phi)
    if weights is not None:
        every = every * np.sqrt(weights)[:, None]
    left, right = every[..., :3], every[..., 3]
    columns = np.linalg.norm(left, axis=-2, keepdims=True)
    columns = np.where(columns > 0, columns, 1.0)
    u, s, vt = np.linalg.svd(left / columns, full_matrices=False)
    with np.errstate(divide="ignore", invalid="ignore"):
        solved = (np.swapaxes(u, -1, -2) @ right[..., None])[..., 0] / s
    x = (np.swapaxes(vt, -1, -2) @ solved[..., None])[..., 0] / columns[..., 0, :]
    return x, s[..., -1]


def generators_of_ratios(
    ratio: FloatArray, input_phase: FloatArray, output_phase: FloatArray
) -> Generator:
    """The linkages (*,) of ratios (*, 3); nan where a length is infinite or not real.

    A negative length is the link drawn the other way: its phase changes by half a turn.
    """
    input_phase, output_phase, _ = np.broadcast_arrays(input_phase, output_phase, ratio[..., 0])
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        a, b = 1 / ratio[..., 0], 1 / ratio[..., 1]
        coupler = np.sqrt(1 + a * a + b * b - 2 * a * b * ratio[..., 2])
    fine = np.isfinite(a) & np.isfinite(b) & np.isfinite(coupler)
    a, b, coupler = (np.where(fine, each, np.nan) for each in (a, b, coupler))
    return Generator(
        np.abs(a),
        coupler,
        np.abs(b),
        input_phase + np.pi * (a < 0),
        output_phase + np.pi * (b < 0),
        np.ones_like(a),
    )
