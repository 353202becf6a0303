from burmester.numerics.arrays import FloatArray

def descend(
    dimensions: FloatArray,
    assembly: FloatArray,
    t: FloatArray,
    cost: FloatArray,
    points: FloatArray,
    timing: FloatArray,
    allowed: FloatArray,
    turns: bool,
    unbroken: bool,
    cosine: float,
    ratio: float,
    steps: int,
    settled: float,
) -> None: ...
