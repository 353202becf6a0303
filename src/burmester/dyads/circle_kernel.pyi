import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import FloatArray

def distances(z: FloatArray, poses: FloatArray, distance: FloatArray) -> None: ...
def distance_terms(
    z: FloatArray,
    poses: FloatArray,
    distance: FloatArray,
    jacobian: FloatArray,
    tangent: FloatArray,
    arm: FloatArray,
) -> None: ...
def sums_of_squares(
    z: FloatArray, task: NDArray[np.intp], poses: FloatArray, cost: FloatArray
) -> None: ...
def steps_down(
    run: NDArray[np.intp],
    z: FloatArray,
    cost: FloatArray,
    task: NDArray[np.intp],
    poses: FloatArray,
    longest: FloatArray,
    settled: NDArray[np.uint8],
    ended: NDArray[np.uint8],
) -> None: ...
