from burmester.numerics.arrays import FloatArray

def nearest(
    ones: FloatArray, others: FloatArray, enough: float, square: FloatArray, points: FloatArray
) -> None: ...
