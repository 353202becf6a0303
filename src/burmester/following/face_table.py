"""The faces of limits as rows of equations, for many dyads at once.

A dyad that is best within limits lies on a face of each of them: inside a region, on an edge or at
a corner (`face_descent`).  While a task changes a little it stays on these faces, wherever they go.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.limited_block import Block
from burmester.numerics.arrays import FloatArray


class Held(NamedTuple):
    """Linear conditions on dyads z (k, n): rows (k, m, n) · z = at (k, m), where active (k, m).

    inward: (k, w, n), directions from the faces into their regions; zero where there is none.
    """

    rows: FloatArray
    at: FloatArray
    active: NDArray[np.bool_]
    inward: FloatArray

    def gap(self, z: FloatArray) -> FloatArray:
        """By how much (k, m) active conditions are missed."""
        return np.where(self.active, (self.rows @ z[..., None])[..., 0] - self.at, 0.0)


class FaceTable(NamedTuple):
    """The faces (f,) of one block of coordinates, the smallest first, as the fields of `Held`.

    The last one is the inside, or all that there is: it has the number -1, too.
    """

    block: Block
    rows: FloatArray
    at: FloatArray
    active: NDArray[np.bool_]
    inward: FloatArray

    @classmethod
    def of(cls, block: Block, size: int) -> Self:
        """The faces of a block of dyads with `size` coordinates."""
        faces = sorted(block.faces(), key=lambda face: face.basis.shape[1])
        width = block.at.stop - block.at.start
        ways = max(len(face.inward) for face in faces)
        rows, at = np.zeros((len(faces), width, size)), np.zeros((len(faces), width))
        active = np.zeros((len(faces), width), dtype=bool)
        inward = np.zeros((len(faces), ways, size))
        for k, face in enumerate(faces):
            across = _complement(face.basis)
            rows[k, : len(across), block.at] = across
            at[k, : len(across)] = across @ face.origin
            active[k, : len(across)] = True
            inward[k, : len(face.inward), block.at] = face.inward
        return cls(block, rows, at, active, inward)


def _complement(basis: FloatArray) -> FloatArray:
    """Orthonormal rows (w - d, w) across a basis (w, d) of at most two dimensions."""
    width, free = basis.shape
    if free == 0:
        return np.eye(width)
    if free == width:
        return np.empty((0, width))
    return np.array([[-basis[1, 0], basis[0, 0]]])


def held(tables: Sequence[FaceTable], numbers: NDArray[np.intp]) -> Held:
    """The conditions of dyads (k,) on the faces of these numbers (k, blocks)."""
    parts = [
        [part[number] for part in table[1:]]
        for table, number in zip(tables, numbers.T, strict=True)
    ]
    return Held(*(np.concatenate(part, axis=1) for part in zip(*parts, strict=True)))


def face_numbers(z: FloatArray, tables: Sequence[FaceTable]) -> NDArray[np.intp]:
    """The numbers (k, blocks) of the smallest faces on which dyads z (k, n) lie."""
    return np.stack([table.block.lying_on(z) for table in tables], axis=-1)


def nearest_face(z: FloatArray, table: FaceTable) -> tuple[int, FloatArray]:
    """The face of a region that is nearest to a dyad (n,), and the dyad moved there."""
    number, best, nearest = 0, z, np.inf
    for k, (rows, at, active) in enumerate(zip(table.rows, table.at, table.active, strict=True)):
        on = z - rows[active].T @ (rows[active] @ z - at[active])
        away = float(np.linalg.norm(on - z))
        if away < nearest and not table.block.outside(on):
            number, best, nearest = k, on, away
    return number, best
