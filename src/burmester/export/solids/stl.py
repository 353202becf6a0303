"""Binary STL read back: its triangles, the closed shells that they make, and their volumes."""

from __future__ import annotations

from pathlib import Path
from typing import Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

Triangles: TypeAlias = NDArray[np.float64]

SAME: Final = 1e-6  # of the greatest coordinate: distance below which two corners are one


def read_stl(path: Path) -> Triangles:
    """The triangles (n, 3, 3) of a binary STL; raises ValueError where it is none."""
    data = path.read_bytes()
    count = int.from_bytes(data[80:84], "little")
    if len(data) != 84 + 50 * count or count == 0:
        raise ValueError(f"{len(data)} bytes are not {count} triangles")
    rows = np.frombuffer(data, dtype=np.uint8, offset=84).reshape(count, 50)
    numbers = np.ascontiguousarray(rows[:, 12:48]).view("<f4")
    return numbers.astype(np.float64).reshape(count, 3, 3)


def shells_of(triangles: Triangles) -> list[Triangles] | None:
    """The triangles (n, 3, 3) by shells, written one after the other; None unless all are closed.

    In a closed shell each edge is run through once in each sense.  Corners that are nearer than
    `SAME` are one: near zero, numbers of 32 bits have more digits than those they were made of.
    """
    corners = np.round(triangles.reshape(-1, 3) / (SAME * np.abs(triangles).max()))
    names = np.unique(corners, axis=0, return_inverse=True)[1].reshape(-1, 3)
    shells, first, open_ = list[Triangles](), 0, set[tuple[int, int]]()
    for number, (a, b, c) in enumerate(names.tolist()):
        for start, end in ((a, b), (b, c), (c, a)):
            if start == end or (start, end) in open_:
                return None
            if (end, start) in open_:
                open_.remove((end, start))
            else:
                open_.add((start, end))
        if not open_:
            shells.append(triangles[first : number + 1])
            first = number + 1
    return None if open_ else shells


def volume_of(shell: Triangles) -> float:
    """The volume within a closed shell, outward normals by the right hand."""
    shell = shell - shell.mean(axis=(0, 1))
    return float(np.einsum("ij,ij", np.cross(shell[:, 0], shell[:, 1]), shell[:, 2]) / 6)
