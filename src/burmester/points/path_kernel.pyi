import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import ComplexArray, FloatArray

def follow(
    start: ComplexArray,
    change: ComplexArray,
    count: int,
    poses: int,
    pivots: int,
    accuracy: float,
    x: ComplexArray,
    t: ComplexArray,
    arrived: NDArray[np.uint8],
    steps: NDArray[np.int64],
) -> None: ...
def polish(
    problem: ComplexArray,
    count: int,
    poses: int,
    pivots: int,
    x: ComplexArray,
    t: ComplexArray,
    miss: FloatArray,
) -> None: ...
