import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import FloatArray

def walk(
    kinds: NDArray[np.int8],
    dimensions: FloatArray,
    rows: FloatArray,
    target: FloatArray,
    length: float,
    ahead: bool,
    steps: int,
    close: float,
    size: FloatArray,
) -> None: ...
def constraint_jacobians(
    kinds: NDArray[np.int8],
    dimensions: FloatArray,
    places: FloatArray,
    miss: FloatArray,
    force: FloatArray,
    by_dimension: FloatArray,
) -> None: ...
def normal_parts(
    kinds: NDArray[np.int8],
    dimensions: FloatArray,
    rows: FloatArray,
    wanted: FloatArray,
    length: float,
    off: float,
    residual: FloatArray,
    jacobian: FloatArray,
    place_jacobian: FloatArray,
    ways: bool,
) -> None: ...
def transmissions(
    kinds: NDArray[np.int8],
    dimensions: FloatArray,
    rows: FloatArray,
    length: float,
    driver: NDArray[np.intp],
    sine: FloatArray,
    drive: FloatArray,
) -> None: ...
def transmission_slopes(
    kinds: NDArray[np.int8],
    dimensions: FloatArray,
    rows: FloatArray,
    place_jacobian: FloatArray,
    length: float,
    driver: NDArray[np.intp],
    sine: FloatArray,
    drive: FloatArray,
    sine_slope: FloatArray,
    drive_slope: FloatArray,
) -> None: ...
def least_transmissions(
    kinds: NDArray[np.int8],
    dimensions: FloatArray,
    driver: NDArray[np.intp],
    at: FloatArray,
    cosine: FloatArray,
    slope: FloatArray,
) -> None: ...
