from burmester.numerics.arrays import FloatArray

def normal_equations(
    dimensions: FloatArray,
    assembly: FloatArray,
    points: FloatArray,
    t: FloatArray,
    foot_steps: int,
    longest_turn: float,
    cost: FloatArray,
    gradient: FloatArray,
    normal: FloatArray,
) -> None: ...
