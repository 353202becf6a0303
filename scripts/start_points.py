"""Make polynomials/start_points.npz: all solutions of each shape, for generic parameters.

Monodromy: one solution is easy, for parameters can be chosen to fit it.  Carried around loops in
the space of parameters it turns into others; when ten loops bring no new one, they are taken to be
all.  Three tries from different parameters; two of them have to agree on the count, and none to
exceed it.  The counts agree with those known otherwise (see
tests/dyads/test_parameter_homotopy.py).

    .venv/bin/python scripts/start_points.py
"""

from itertools import pairwise

import numpy as np

from burmester.numerics.arrays import unique_rows
from burmester.polynomials.bilinear_fit import Parameters, circle_shape, equations, line_shape
from burmester.polynomials.parameter_homotopy import ARRIVED, follow

SAME_POINT = 1e-6  # relative; solutions nearer than this are one
QUIET = 10  # loops without a new solution


def generic(shape, rng):
    """Complex parameters of a shape; a line's quadratic condition is |n|² = R."""

    def draw(*size):
        return rng.normal(size=size) + 1j * rng.normal(size=size)

    f = len(shape.constant)
    gram, linear = draw(f, f), draw(f)
    if shape.name.startswith("line"):
        linear = 0 * linear
    return Parameters(gram + gram.T, draw(shape.conditions, f), linear, draw())


def solved(shape, rng):
    """One point, and parameters of which it is a solution."""
    p, n = generic(shape, rng), shape.unknowns
    x = rng.normal(size=shape.size) + 1j * rng.normal(size=shape.size)
    w = shape.features(x[:n])
    p = p._replace(rows=p.rows - np.outer(p.rows @ w, w.conj()) / (w @ w.conj()))
    if shape.quadratic != "none":
        p = p._replace(square=p.square + equations(shape, x, p)[-1])
    z = -np.linalg.pinv(shape.gradients(x[:n])) @ equations(shape, x, p)[:n]
    square = w @ w
    more = (np.outer(z, w) + np.outer(w, z)) / square - np.outer(w, w) * (z @ w) / square**2
    return x, p._replace(gram=p.gram + more)


def mirrored(shape, points):
    """A line's two normals are one line: (n, multipliers of A) and their negatives."""
    sign = np.ones(shape.size)
    sign[:2] = sign[shape.unknowns : shape.unknowns + shape.conditions] = -1
    return points * sign


def all_solutions(shape, seed):
    """Generic parameters, and the solutions (k, size), of a line one of each two."""
    rng = np.random.default_rng(seed)
    x, p = solved(shape, rng)
    found, quiet = x[None], 0
    line = shape.name.startswith("line")
    while quiet < QUIET:
        ends = found
        for a, b in pairwise([p, generic(shape, rng), generic(shape, rng), p]):
            ends, state = follow(
                shape, ends, Parameters(*(v[None] for v in a)), Parameters(*(v[None] for v in b))
            )
            ends = ends[state == ARRIVED]
        before = len(found)
        found = unique_rows(np.concatenate([found, ends]), SAME_POINT, "maximum")
        if line:
            both = np.concatenate([found, mirrored(shape, found)])
            found = unique_rows(both, SAME_POINT, "maximum")
        quiet = quiet + 1 if len(found) == before else 0
    if line:
        first = []
        for one in found:
            twin = mirrored(shape, one)
            if not any(np.abs(other - twin).max() < 1e-6 for other in first):
                first.append(one)
        found = np.array(first)
    return p, found


def shapes():
    """Every shape that a task with limits can have."""
    for fixed in range(3):
        for moving in range(3):
            if free := fixed + moving:
                yield from (circle_shape(fixed, moving, k, "none") for k in range(free + 1))
                yield circle_shape(fixed, moving, 0, "soft")
                yield from (circle_shape(fixed, moving, k, "hard") for k in range(free))
    for moving in range(3):
        yield from (line_shape(moving, k) for k in range(moving + 2))


if __name__ == "__main__":
    table = {}
    for number, shape in enumerate(shapes()):
        tries = [all_solutions(shape, seed) for seed in range(3 * number, 3 * number + 3)]
        counts = sorted(len(points) for _, points in tries)
        print(f"{shape.name:16} {counts}", flush=True)
        if counts[1] < counts[2]:
            raise SystemExit(f"{shape.name}: the tries do not agree")
        parameters, points = max(tries, key=lambda found: len(found[1]))
        for part, value in zip(Parameters._fields, parameters, strict=True):
            table[f"{shape.name}/{part}"] = value
        table[f"{shape.name}/points"] = points
    np.savez_compressed("src/burmester/polynomials/start_points.npz", **table)
