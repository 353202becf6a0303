"""Make src/burmester/functions/start_points.npz: all critical points of generic matrices G.

Monodromy: for one point matrices can be chosen of which it is critical.  Carried around loops in
the space of matrices it turns into others; when ten loops bring no new one, they are taken to be
all.  Three tries with different seeds have to agree on the count.

    .venv/bin/python scripts/function_start_points.py
"""

import numpy as np

from burmester.functions.critical_generators import exponents, follow, gradient, terms
from burmester.numerics.arrays import unique_index

SAME_POINT = 1e-6  # relative, of the products of the terms
QUIET = 10  # loops without a new point


def generic(rng):
    """A root of a generic matrix of unit norm."""
    a = rng.normal(size=(6, 6)) + 1j * rng.normal(size=(6, 6))
    return a / np.sqrt(np.linalg.norm(a.T @ a))


def root_of(gram):
    """A root r of a symmetric matrix: r' r."""
    values, vectors = np.linalg.eig(gram)
    root = (vectors * np.sqrt(values.astype(complex))) @ np.linalg.inv(vectors)
    return (root + root.T) / 2


def solved(rng, e):
    """One point, and a root of a matrix of which it is critical."""
    v = 0.5 * (rng.normal(size=e.shape[1]) + 1j * rng.normal(size=e.shape[1]))
    w, root = terms(v, e), generic(rng)
    # E' (w o G w) = 0 by the shortest change of G w along w
    wanted = np.linalg.pinv(e.T * w) @ gradient(v, root, e)[0]
    square = w @ w
    change = (np.outer(wanted, w) + np.outer(w, wanted)) / square
    root = root_of(root.T @ root - change + np.outer(w, w) * (w @ wanted) / square**2)
    assert np.abs(gradient(v, root, e)[0]).max() < 1e-12
    return v, root


def different(v, e):
    """One of the points that are one linkage: w and -w."""
    w = terms(v, e)
    products = w[:, :, None] * w[:, None, :]
    products = products.reshape(len(w), -1) / np.abs(products).max(axis=(1, 2))[:, None]
    rows = np.concatenate([products.real, products.imag], axis=1)
    return v[unique_index(rows, SAME_POINT, "maximum")]


def all_points(e, seed):
    """A root of a generic matrix, and its critical points (k, n)."""
    rng = np.random.default_rng(seed)
    v, root = solved(rng, e)
    found, quiet = v[None], 0
    while quiet < QUIET:
        ends, at = found, root
        for target in (generic(rng), generic(rng), root):
            ends, state = follow(ends, at, target, e)
            ends, at = ends[state == 1], target
        before = len(found)
        found = different(np.concatenate([found, ends]), e)
        quiet = quiet + 1 if len(found) == before else 0
    return root, found


if __name__ == "__main__":
    table = {}
    for name, count in (("both", 28), ("one", 6)):
        tries = [all_points(exponents(name == "both"), seed) for seed in range(3)]
        counts = [len(points) for _, points in tries]
        print(name, counts)
        if set(counts) != {count}:
            raise SystemExit(f"{name}: {count} points are expected")
        table[f"{name}/root"], table[f"{name}/points"] = tries[0]
    np.savez_compressed("src/burmester/functions/start_points.npz", **table)
