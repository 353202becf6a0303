"""Matrices times vectors and linear systems, many at once."""

from __future__ import annotations

from contextlib import AbstractContextManager
from functools import cache
from threading import Lock
from typing import Any

import numpy as np
from numpy.typing import NDArray


def matvec(matrix: NDArray[Any], vector: NDArray[Any]) -> NDArray[Any]:
    """Matrices (*, m, n) times vectors (*, n): (*, m)."""
    return np.asarray((matrix @ vector[..., None])[..., 0])


def solve(matrix: NDArray[Any], right: NDArray[Any]) -> NDArray[Any]:
    """The solutions (*, n) of systems with matrices (*, n, n) and right sides (*, n)."""
    return np.asarray(np.linalg.solve(matrix, right[..., None])[..., 0])


def solve_or_shortest(matrix: NDArray[Any], right: NDArray[Any]) -> NDArray[Any]:
    """The same; where one of the matrices is exactly singular, the shortest least-squares ones."""
    try:
        return solve(matrix, right)
    except np.linalg.LinAlgError:
        return matvec(np.linalg.pinv(matrix), right)


def solve_where_regular(
    matrix: NDArray[Any], right: NDArray[Any]
) -> tuple[NDArray[Any], NDArray[np.bool_]]:
    """The solutions, and which of the systems (*,) have one; zeros where a matrix is singular.

    A matrix is singular where elimination meets a pivot of zero exactly.
    """
    try:
        return solve(matrix, right), np.ones(matrix.shape[:-2], dtype=bool)
    except np.linalg.LinAlgError:
        size = matrix.shape[-1]
        regular = _regular(matrix.reshape(-1, size, size)).reshape(matrix.shape[:-2])
    safe = np.where(regular[..., None, None], matrix, np.eye(size))
    return np.where(regular[..., None], solve(safe, right), 0.0), regular


def _regular(matrices: NDArray[Any]) -> NDArray[np.bool_]:
    """Which of matrices (k, n, n) are not singular, by halves until all are or one is left."""
    try:
        np.linalg.solve(matrices, np.zeros((len(matrices), matrices.shape[-1], 1)))
    except np.linalg.LinAlgError:
        half = len(matrices) // 2
        if not half:
            return np.zeros(len(matrices), dtype=bool)
        return np.concatenate([_regular(matrices[:half]), _regular(matrices[half:])])
    return np.ones(len(matrices), dtype=bool)


def unit_vectors(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Vectors (*, n) divided by their lengths."""
    return np.asarray(vectors / np.linalg.norm(vectors, axis=-1, keepdims=True))


class _OneThread:
    """Uses of `one_thread` that overlap: the first sets the limit, the last one lifts it.

    The number of BLAS's threads belongs to the process. If each use restored what it met, a use
    that began inside another and ended after it would leave one thread behind.
    """

    def __init__(self) -> None:
        self._turn = Lock()
        self._uses = 0
        self._limit: Any = None

    def __enter__(self) -> None:
        with self._turn:
            if not self._uses:
                _let_any_thread_set()
                self._limit = _blas().limit(limits=1, user_api="blas")
                _let_any_thread_set()
            self._uses += 1

    def __exit__(self, *_: object) -> None:
        with self._turn:
            self._uses -= 1
            if not self._uses:
                _let_any_thread_set()
                self._limit.restore_original_limits()
                _let_any_thread_set()


def _let_any_thread_set() -> None:
    """Let the last use lift the limit, which may be in another thread than the first.

    threadpoolctl 3.7 and later take OpenBLAS's limits from one thread of Python only and ignore
    the others, which take no turns; ours do.
    """
    for library in _blas().lib_controllers:
        if (clear := getattr(library, "clear_controlling_thread", None)) is not None:
            clear(force=True)


_ONE_THREAD = _OneThread()


def one_thread() -> AbstractContextManager[None]:
    """A time in which BLAS keeps to one thread; such times may overlap, in any threads.

    On matrices of some hundred columns several threads mostly wait for each other, much so on a
    busy machine.
    """
    return _ONE_THREAD


@cache
def _blas() -> Any:
    """The hold on NumPy's BLAS; looked for once, when first needed."""
    from threadpoolctl import ThreadpoolController  # noqa: PLC0415

    return ThreadpoolController()
