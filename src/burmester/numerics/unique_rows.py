"""Each row of several once."""

from __future__ import annotations

from typing import Any, Literal, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

Rows = TypeVar("Rows", bound=NDArray[Any])


def unique_rows(rows: Rows, tolerance: float, norm: Literal["euclidean", "maximum"]) -> Rows:
    """Rows (k, n), real or complex, without those that repeat an earlier one.

    A row repeats an earlier one if their difference is smaller than `tolerance` times 1 + the
    earlier one's norm.
    """
    unique: Any = rows[unique_index(rows, tolerance, norm)]
    return cast(Rows, unique)


def unique_index(
    rows: NDArray[Any], tolerance: float, norm: Literal["euclidean", "maximum"]
) -> NDArray[np.bool_]:
    """Which of rows (*, k, n) repeat no earlier one: (*, k)."""
    order = 2 if norm == "euclidean" else np.inf
    size = 1 + np.linalg.norm(rows, order, axis=-1)
    apart = np.linalg.norm(rows[..., :, None, :] - rows[..., None, :, :], order, axis=-1)
    return ~np.asarray(np.tril(apart < tolerance * size[..., None, :], -1).any(axis=-1))
