"""Random systems of every shape, and their Lagrangian written out.

It is quadratic along every axis, so that differences with a step of one are its derivatives,
exactly.
"""

import numpy as np

from burmester.polynomials.bilinear_fit import Parameters, circle_shape, line_shape

SHAPES = [
    circle_shape(i, j, k, kind)
    for i in range(3)
    for j in range(3)
    for kind, most in (("none", i + j + 1), ("soft", 1), ("hard", i + j))
    for k in range(most)
    if i + j
]
SHAPES += [line_shape(j, k) for j in range(3) for k in range(j + 2)]


def lagrangian(shape, x, p):
    """The Lagrangian (*,) at x (*, size), of one system p."""
    kind, size, *_ = shape.name.split("-")
    k, n = shape.conditions, shape.unknowns
    if kind == "circle":
        i, j = int(size[0]), int(size[1])
        u, v = x[..., :i], x[..., i : i + j]
        if i == j == 2:
            (a, b), (c, d) = np.moveaxis(u, -1, 0), np.moveaxis(v, -1, 0)
            products = [a * c + b * d, b * c - a * d]
        else:
            products = [u[..., s] * v[..., t] for s in range(i) for t in range(j)]
        parts = [np.ones_like(x[..., 0]), *np.moveaxis(x[..., :n], -1, 0), *products]
        square = (x[..., :n] ** 2).sum(axis=-1)
    else:
        normal, v = x[..., :2], x[..., 2:n]
        (a, b) = np.moveaxis(normal, -1, 0)
        if n == 4:
            c, d = v[..., 0], v[..., 1]
            products = [a * c + b * d, b * c - a * d]
        else:
            products = [a * v[..., 0], b * v[..., 0]] if n == 3 else []
        parts = [a, b, *products]
        square = a * a + b * b
    w = np.stack(parts, axis=-1)
    value = np.einsum("...i,ij,...j->...", w, p.gram, w) / 2
    value = value + np.einsum("...k,ki,...i->...", x[..., n : n + k], p.rows, w)
    if shape.quadratic != "none":
        t = x[..., -1]
        value = value + t * (square + w @ p.linear - p.square)
        if shape.quadratic == "soft":
            value = value - t * t / 2
    return value


def gradient(shape, x, p):
    """Its derivatives (*, size)."""
    step = np.eye(shape.size)
    at = x[..., None, :]
    return (lagrangian(shape, at + step, p) - lagrangian(shape, at - step, p)) / 2


def hessian(shape, x, p):
    """Its second derivatives (*, size, size)."""
    step = np.eye(shape.size)
    at = x[..., None, :]
    return (gradient(shape, at + step, p) - gradient(shape, at - step, p)) / 2


def draw(shape, rng, *, real=True):
    """Random parameters of a shape, those of a task (real, G of squares) or any complex ones."""
    f, k = len(shape.constant), shape.conditions

    def normal(*size):
        return rng.normal(size=size) + (0 if real else 1j * rng.normal(size=size))

    gram = normal(f + 2, f)
    linear = 0 * normal(f) if shape.name.startswith("line") else normal(f)
    square = np.array(4 * rng.uniform(0.5, 1)) if real else normal()
    return Parameters(gram.T @ gram, normal(k, f), linear, square)


def turned(angle):
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def of_poses(shape, rng, *, count=8, rows=None):
    """Parameters of a shape as random poses make them, on random lines and at random points.

    rows: poses x, y, angle.  The first of them are exact, as many as the shape has conditions for.
    """
    kind, size, *_ = shape.name.split("-")
    if rows is None:
        rows = np.column_stack([rng.normal(size=(count, 2)), rng.uniform(-2, 2, count)])
    frees = [int(free) for free in size]
    maps = []  # of each pivot: origin (2,) + basis (2, free)
    for free in frees:
        along = turned(rng.uniform(0, 2 * np.pi))
        origin = (0, rng.normal(), 0)[free] * along[:, 1] + (free == 0) * rng.normal(size=2)
        maps.append((origin, np.eye(2) if free == 2 else along[:, :free]))

    def values(x):
        """What each pose demands to be the same, at x."""
        if kind == "circle":
            (c, a), (m, b) = maps
            c, m = c + a @ x[: frees[0]], m + b @ x[frees[0] :]
            return [((turned(t) @ m + (dx, dy) - c) ** 2).sum() for dx, dy, t in rows]
        (m, b), n = maps[0], x[:2]
        return [n @ (turned(t) @ (m + b @ x[2:]) + (dx, dy)) for dx, dy, t in rows]

    # Those values are squares + a · w, and so many points determine the rows a.
    n, f = shape.unknowns, len(shape.constant)
    at = rng.normal(size=(3 * f, n))
    squares = (at[:, :n] ** 2 * shape.squares).sum(axis=1) if kind == "circle" else np.zeros(3 * f)
    demanded = np.array([values(x) for x in at]) - squares[:, None]
    a = np.linalg.lstsq(shape.features(at), demanded, rcond=None)[0].T
    k = shape.conditions
    exact = k + 1 if k else int(shape.quadratic == "hard" and kind == "circle")
    base = a[0] if exact else a.mean(axis=0)
    loose = (a[exact:] - base) / np.sqrt(len(a))
    linear = base if kind == "circle" else np.zeros(f)
    square = np.array(rng.uniform(0.3, 3) ** 2 if kind == "circle" else 1.0)
    return Parameters(loose.T @ loose, (a[1 : k + 1] - base).reshape(k, f), linear, square)


def one(p):
    return Parameters(*(np.asarray(part)[None] for part in p))


def stacked(systems):
    return Parameters(*(np.stack(part) for part in zip(*systems, strict=True)))


def with_twins(shape, points):
    """Solutions (k, size), and of a line those with the other normal as well."""
    if not shape.name.startswith("line"):
        return points
    mirror = np.ones(shape.size)
    mirror[:2] = mirror[shape.unknowns : -1] = -1
    return np.concatenate([points, points * mirror])
