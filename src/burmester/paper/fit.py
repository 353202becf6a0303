"""The paper's fit to one of its tables, and to copies within the rounding of the print."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final, final

import numpy as np
from numpy.typing import ArrayLike

from burmester.dyads.pencil import fit_pencil
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.paper.comparison import MISPRINTS

LAST_DIGIT: Final = np.array([1e-4, 1e-4, 1e-2])  # of x, y and the angle in degrees
VECTORS: Final = [f"v{i} p{j}" for i in (1, 2) for j in range(1, 9)]


@final
@dataclass(frozen=True, slots=True, eq=False)
class PaperFit:
    """The paper's fit to a case and, after it on the first axis, to its rounding samples.

    vectors: (2, 8), the printed v1, v2, known misprints put right; v1 and v2 of `plane`
    (k, 2, 8) point along them.  p: (k, 2, 8) with p1 = 1, and e = sqrt(E): (k, 2), of the two
    dyads; the one nearer to the printed C1 comes first.
    """

    case: dict[str, Any]
    printed: dict[str, Any]
    poses: Displacement
    values: FloatArray
    vectors: FloatArray
    plane: FloatArray
    p: FloatArray
    e: FloatArray

    @classmethod
    def of(cls, case: dict[str, Any], where: str, key: str, samples: int, seed: int) -> PaperFit:
        printed, poses = case["printed"], rounded(case["poses"], samples, seed)
        fit = fit_pencil(poses, normalise=False)
        vectors = np.array(printed[key])
        for index, name in enumerate(VECTORS):
            wrong, meant, _ = MISPRINTS.get(f"{where}, {name}", (None, 0.0, ""))
            if vectors.flat[index] == wrong:
                vectors.flat[index] = meant
        plane = fit.vectors[:, :2]
        plane = plane * np.where((plane * vectors).sum(axis=-1) < 0, -1, 1)[..., None]
        p = fit.at(fit.theta[:, :2])
        p /= p[..., :1]
        order = np.argsort(np.abs(p[..., 2] / 2 - printed["C1"][0][2]), axis=1)
        p = np.take_along_axis(p, order[..., None], axis=1)
        e = np.take_along_axis(np.sqrt(fit.error[:, :2]), order, axis=1)
        return cls(case, printed, poses, fit.singular_values, vectors, plane, p, e)


def rounded(poses: ArrayLike, samples: int, seed: int) -> Displacement:
    """The poses (N, 3), then copies within the rounding of their last digits: (1 + samples, N)."""
    rows = np.asarray(poses, dtype=np.float64)
    noise = np.random.default_rng(seed).uniform(-0.5, 0.5, (1 + samples, *rows.shape))
    noise[0] = 0
    rows = rows + noise * LAST_DIGIT
    return Displacement(rows[..., :2], np.radians(rows[..., 2]))
