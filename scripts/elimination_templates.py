"""Make `FILE`: the rows and columns of the Macaulay matrix of each shape of task.

Pure monomials are sums of supports (of the features, of one pivot, of the squares) of some sizes,
smallest first.  Columns are these and what the equations times monomials bring in besides; rows all
multiples of equations that fit.  Taken is the first choice whose null space, for random poses, has
as many dimensions as there are solutions, on columns where monomials with all products by some
unknowns still tell the solutions apart.  Then columns are left out, many at once, while that stays
so, and independent rows are picked.

    PYTHONPATH=. .venv/bin/python scripts/elimination_templates.py [SHAPE ...]

Some minutes for the shapes whose pivots are both free in the plane.  Only the shapes named are made
anew, all if none is.
"""

import sys
from itertools import product

import numpy as np
from tests.oracles.bilinear_systems import SHAPES, of_poses, one

from burmester.numerics.arrays import unique_rows
from burmester.polynomials.elimination import (
    Chart,
    in_chart,
    isotropic,
    lagrangian,
    matrix_terms,
    monomials_by_parts,
)
from burmester.polynomials.parameter_homotopy import ARRIVED, tracked_points

FILE = "src/burmester/polynomials/elimination_templates.npz"
MAX_PURE = 330  # monomials without multipliers that are tried
RANK_ROUNDING = 1e-8  # relative; lower singular values are zero
AT_ONCE = 16  # columns that are left out together, then by halves


def add(*exponents):
    return tuple(map(sum, zip(*exponents, strict=True)))


class Search:
    """The search for the template of one shape."""

    def __init__(self, shape):
        """The supports of its equations, and parameters as random poses make them."""
        self.shape, self.n, self.size = shape, shape.unknowns, shape.size
        exponents = lagrangian(shape)[0]
        self.unit = [tuple(e) for e in np.eye(self.size, dtype=int).tolist()]
        self.supports = []
        for i in range(self.size):
            derived = exponents[exponents[:, i] > 0] - np.eye(self.size, dtype=int)[i]
            self.supports.append(sorted({tuple(e) for e in derived.tolist()}))
        conjugate = [*isotropic(shape).conjugate, *range(self.n, self.size)]
        self.conjugate = lambda e: tuple(e[k] for k in conjugate)
        p = one(of_poses(shape, np.random.default_rng(1)))
        f, still = isotropic(shape).features, (np.eye(self.n), np.zeros(self.n))
        values = in_chart(shape, p, Chart(*[None] * 5, *still, f, f))[1][0]
        self.values = np.concatenate([values.real, values.imag])
        ends, state = tracked_points(shape, p)
        self.finite = len(unique_rows(ends[state == ARRIVED], 1e-6, "maximum"))
        both = 2 if shape.name.startswith("line") else 1  # a line has two normals
        self.counts = sorted({both * self.finite, both * ends.shape[1]})
        planes = [[k, k + 1] for k in shape.planes]
        single = [[k] for k in range(self.n) if not any(k in plane for plane in planes)]
        self.forms = [*planes, *single, list(range(self.n))]

    def rows(self, columns):
        """All products of equations and monomials whose terms are among the columns."""
        found = []
        for i, support in enumerate(self.supports):
            for column in columns:
                shift = tuple(a - b for a, b in zip(column, support[0], strict=True))
                if min(shift) >= 0 and all(add(shift, e) in columns for e in support):
                    found.append((i, *shift))
        return sorted(found)

    def matrix(self, columns, rows):
        """The real parts of rows, then the imaginary ones, by real columns; each of length one."""
        columns, twice = np.array(columns), np.array(rows + rows)
        imaginary = np.arange(len(twice)) >= len(rows)
        row, column, source, factor = matrix_terms(self.shape, columns, twice, imaginary)
        flat = np.bincount(
            row * len(columns) + column,
            self.values[source] * factor,
            len(twice) * len(columns),
        ).reshape(len(twice), -1)
        length = np.linalg.norm(flat, axis=1, keepdims=True)
        return flat / np.where(length > 1e-10, length, np.inf)

    def null_space(self, columns, rows):
        """Monomials (columns, k) that rows leave open."""
        matrix = np.linalg.qr(self.matrix(columns, rows), mode="r")
        _, values, v = np.linalg.svd(matrix, full_matrices=True)
        rank = int((values > RANK_ROUNDING * values[0]).sum())
        return monomials_by_parts(self.shape, np.array(columns)) @ v[rank:].T

    def with_products(self, columns, unknowns):
        """The columns whose products with each of some unknowns are columns too."""
        return [e for e in columns if all(add(e, self.unit[i]) in columns for i in unknowns)]

    def tells_apart(self, columns, null, trusted, count):
        """Forms by which the trusted columns tell so many solutions apart, or None."""
        at = {e: k for k, e in enumerate(columns)}

        def rank(some):
            return np.linalg.matrix_rank(null[[at[e] for e in some]], tol=1e-7) if some else 0

        if any(not self.with_products(trusted, [i]) for i in range(self.n)):
            return None
        if rank(trusted) != count:
            return None
        fit = (f for f in self.forms if rank(self.with_products(trusted, f)) == count)
        return next(fit, None)

    def families(self):
        """Sets of pure monomials, small ones first."""
        zero = (0,) * self.n
        w = [tuple(e) for e in isotropic(self.shape).exponents.tolist()]
        squares = [tuple(e) for e in isotropic(self.shape).squares[0].tolist()]
        single = [tuple(e) for e in np.eye(self.n, dtype=int).tolist()]
        split = 2 if self.shape.name.startswith("line") else int(self.shape.name[7])
        supports = [{zero, *w}, {zero, *single[:split]}, {zero, *single[split:]}]
        supports.append({zero, *w, *squares})
        found = set()
        for times in product(range(5), range(4), range(4), range(4)):
            if not 1 <= sum(times) <= 8 or (times[3] and self.shape.quadratic == "none"):
                continue
            pure = {zero}
            for support, time in zip(supports, times, strict=True):
                for _ in range(time):
                    pure = {add(a, b) for a, b in product(pure, support)}
            if len(pure) <= MAX_PURE:
                found.add(frozenset(e + (0,) * (self.size - self.n) for e in pure))
        return sorted(found, key=lambda pure: (len(pure), sorted(pure)))

    def columns_of(self, pure):
        """Pure monomials and those with multipliers that come with them."""
        columns = set(pure)
        for i in range(self.n):
            without = [e for e in self.supports[i] if not any(e[self.n :])]
            for column in pure:
                shift = tuple(a - b for a, b in zip(column, without[0], strict=True))
                if min(shift) >= 0 and all(add(shift, e) in pure for e in without):
                    columns |= {add(shift, e) for e in self.supports[i]}
        if self.shape.quadratic == "soft":  # t is the mean of the residual, times any monomial
            own = self.unit[-1]
            for column in pure:
                if all(add(column, e) in pure for e in self.supports[-1] if e != own):
                    columns.add(add(column, own))
        return columns

    def first(self):
        """The first columns that do, trusted ones, and how many solutions they have."""
        families = self.families()
        for pure in families:
            columns = self.columns_of(pure)
            rows = self.rows(columns)
            if not rows:
                continue
            order = sorted(columns)
            null = self.null_space(order, rows)
            inner = [set(self.with_products(columns, forms)) for forms in self.forms]
            smaller = [each for each in reversed(families) if each <= pure]
            smaller += [self.columns_of(each) & columns for each in smaller]
            for count, trusted in product(self.counts, [columns, *inner, *smaller]):
                if null.shape[1] >= count and self.tells_apart(order, null, trusted, count):
                    return columns, set(trusted), count
        raise SystemExit(f"{self.shape.name}: nothing found")

    def trimmed(self, columns, trusted, count):
        """Fewer columns that do."""
        state = [columns, trusted]

        def without(some):
            some = [e for e in some if e in state[0]]
            if not some:
                return
            left = state[0] - {*some, *map(self.conjugate, some)}
            rows = self.rows(left)
            left = {add(row[1:], e) for row in rows for e in self.supports[row[0]]}
            kept = state[1] & left
            if len(kept) >= count:
                null = self.null_space(sorted(left), rows)
                if null.shape[1] >= count and self.tells_apart(sorted(left), null, kept, count):
                    state[:] = left, kept
                    return
            if len(some) > 1:
                half = len(some) // 2
                without(some[:half])
                without(some[half:])

        order = sorted({min(e, self.conjugate(e)) for e in columns}, key=lambda e: (-sum(e), e))
        for step in (AT_ONCE, 1):
            for k in range(0, len(order), step):
                without(order[k : k + step])
        return state

    def made(self):
        """What the file holds of the shape."""
        columns, trusted, count = self.first()
        columns, trusted = self.trimmed(columns, trusted, count)
        rows = self.rows(columns)
        null = self.null_space(sorted(columns), rows)
        if null.shape[1] == count:
            trusted = columns
        forms = self.tells_apart(sorted(columns), null, trusted, count)
        order = [*sorted(trusted), *sorted(columns - trusted)]
        matrix = self.matrix(order, rows)
        kept = independent_rows(matrix, len(order) - null.shape[1])
        twice = np.array(rows + rows)
        print(f"{self.shape.name:18} {self.finite:3} of {len(order)} columns", flush=True)
        return {
            "columns": np.array(order, dtype=np.uint8),
            "rows": np.column_stack([kept >= len(rows), twice[kept]]).astype(np.uint8),
            "forms": np.array(forms, dtype=np.uint8),
            "numbers": np.array([self.finite, count, len(trusted)], dtype=np.uint16),
        }


def independent_rows(matrix, rank):
    """The rows that Gram-Schmidt with pivoting takes first."""
    rest, kept = matrix.copy(), []
    for _ in range(rank):
        kept.append(int(np.einsum("ij,ij->i", rest, rest).argmax()))
        axis = rest[kept[-1]] / np.linalg.norm(rest[kept[-1]])
        rest -= np.outer(rest @ axis, axis)
    return np.sort(np.array(kept))


if __name__ == "__main__":
    table = {}
    if sys.argv[1:]:
        with np.load(FILE, allow_pickle=False) as kept:
            table = {name: kept[name] for name in kept.files}
    for shape in SHAPES:
        mirror = shape.name.startswith("circle") and shape.name[7] < shape.name[8]
        if not mirror and (not sys.argv[1:] or shape.name in sys.argv[1:]):
            for part, value in Search(shape).made().items():
                table[f"{shape.name}/{part}"] = value
    np.savez_compressed(FILE, **table)
