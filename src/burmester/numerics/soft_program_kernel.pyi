from burmester.numerics.arrays import FloatArray

def solve_programs(
    hessian: FloatArray,
    gradient: FloatArray,
    value: FloatArray,
    jacobian: FloatArray,
    low: FloatArray,
    high: FloatArray,
    multipliers: FloatArray,
    step: FloatArray,
) -> None: ...
