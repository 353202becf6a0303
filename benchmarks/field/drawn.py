"""Tasks drawn by hand: shapes to trace, a stroke timed by the crank, and functions.

A shape is its outline, by corners and arcs; the points that a tool gets are even along it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from benchmarks.field.generated import CLOSED, FUNCTIONS, OPEN, TIMED
from benchmarks.field.task import FUNCTION, NO_LINKAGE, FieldTask

CLOSED_POINTS, OPEN_POINTS = 36, 24
PAIRS = 61  # of a function
HAND = "drawn by hand"


def _arc(middle: complex, radius: float, begin: float, end: float) -> np.ndarray:
    """Points of an arc from one angle to another, degrees."""
    return middle + radius * np.exp(1j * np.radians(np.linspace(begin, end, 61)))


def _heart() -> np.ndarray:
    """Two round lobes and a tip below."""
    t = np.linspace(0, 2 * np.pi, 200, endpoint=False)
    return 16 * np.sin(t) ** 3 + 1j * (
        13 * np.cos(t) - 5 * np.cos(2 * t) - 2 * np.cos(3 * t) - np.cos(4 * t)
    )


def _airfoil() -> np.ndarray:
    """The symmetric section NACA 0018, its trailing edge shut."""
    x = (1 - np.cos(np.linspace(0, np.pi, 80))) / 2
    half = 0.9 * (0.2969 * np.sqrt(x) - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
    return np.concatenate([(x + 1j * half)[::-1], (x - 1j * half)[1:-1]])


def _eight() -> np.ndarray:
    t = np.linspace(0, 2 * np.pi, 200, endpoint=False)
    return np.sin(t) + 0.6j * np.sin(2 * t)


def _crescent() -> np.ndarray:
    """A half moon: a half circle outside, a flatter arc inside."""
    outside = _arc(0, 1, -90, 90)
    inside = _arc(-0.75, 1.25, 53.13, -53.13)
    return np.concatenate([outside, inside[1:-1]])


CORNER = [_arc(x + 1j * y, 0.3, turn, turn + 90) for x, y, turn in
          ((0.7, 0.3, 0), (-0.7, 0.3, 90), (-0.7, -0.3, 180), (0.7, -0.3, 270))]  # fmt: skip
CLOSED_SHAPES = {
    "heart": _heart(),
    "drop": np.append(_arc(0, 1, -30, 210), -2j),
    "rounded rectangle": np.concatenate(CORNER),
    "airfoil": _airfoil(),
    "straight and back in an arc": np.append(_arc(-0.6j, 1.1662, 30.96, 149.04), [-1, 1]),
    "half moon": _crescent(),
    "letter D": np.append(_arc(0, 1, -90, 90), [-0.6 + 1j, -0.6 - 1j]),
    "figure eight": _eight(),
}
OPEN_SHAPES = {
    "letter C": _arc(0, 1, 45, 315),
    "letter S": np.concatenate([_arc(1j, 1, 30, 270), _arc(-1j, 1, 90, -150)]),
    "letter L": np.array([2j, 0, 1.2]),
    "letter U": np.concatenate([[-1 + 2j], _arc(0, 1, 180, 360), [1 + 2j]]),
    "hook": np.concatenate([[1 + 2j], _arc(0.4, 0.6, 0, -200)]),
    "zigzag": np.array([0, 1 + 0.8j, 2, 3 + 0.8j, 4]),
}
# Function, range of x, degrees of the input and of the output, and where it is from.
TABLE = "`benchmarks/function_requirements.py`"
PAGE = "[the page of functions](functions.md)"
Values = Callable[[np.ndarray], np.ndarray]
FUNCTION_TASKS: dict[str, tuple[Values, float, float, int, int, str]] = {
    "log10(x), 1 to 2": (np.log10, 1, 2, 60, 60, PAGE),
    "log(x), 1 to 2": (np.log, 1, 2, 90, 90, PAGE),
    "log10(x), 1 to 10": (np.log10, 1, 10, 90, 90, TABLE),
    "sin(x), 0 to 90°": (np.sin, 0, np.pi / 2, 90, 90, PAGE),
    "cos(x), 0 to 90°": (np.cos, 0, np.pi / 2, 90, 90, TABLE),
    "tan(x), 0 to 45°": (np.tan, 0, np.pi / 4, 90, 90, TABLE),
    "sqrt(x), 1 to 4": (np.sqrt, 1, 4, 80, 80, TABLE),
    "1/x, 1 to 2": (np.reciprocal, 1, 2, 90, 90, TABLE),
    "x^2, 1 to 6": (np.square, 1, 6, 60, 70, "brockeng.com/mechanism/FuncGen.htm"),
    "x^1.6, 1 to 4": (lambda x: x**1.6, 1, 4, 90, 90, "an exercise, mathix.co"),
    "x^3, 0 to 1": (lambda x: x**3, 0, 1, 60, 75, "an exercise (6 x^3), transtutors.com"),
    "exp(x), 0 to 1": (np.exp, 0, 1, 60, 60, "chosen by hand"),
}  # fmt: skip


def drawn() -> Iterator[FieldTask]:
    """Shapes, closed and open, a timed stroke, and functions."""
    for name, outline in CLOSED_SHAPES.items():
        rows = _even(np.append(outline, outline[:1]), CLOSED_POINTS + 1)[:-1]
        yield FieldTask(name, CLOSED, HAND, rows, NO_LINKAGE, closed=True)
    for name, outline in OPEN_SHAPES.items():
        yield FieldTask(name, OPEN, HAND, _even(outline, OPEN_POINTS), NO_LINKAGE)
    yield stroke()
    for name, (values, low, high, turn, swing, source) in FUNCTION_TASKS.items():
        share = np.linspace(0, 1, PAIRS)
        y = values(low + (high - low) * share)
        out = np.radians(swing) * (y - y[0]) / np.ptp(y)
        rows = np.column_stack([np.radians(turn) * share, out])
        yield FieldTask(name, FUNCTIONS, source, rows, FUNCTION, is_function=True)


def stroke() -> FieldTask:
    """Forth at an even speed while the crank turns half round, and back above it: ten points."""
    x = np.append(np.linspace(0, 100, 6), [92, 50, 8, 0])
    y = np.append(np.zeros(6), [20, 34, 20, 0])
    turned = np.radians(np.append(np.linspace(0, 180, 6), [225, 270, 315, 360]))
    rows = np.column_stack([x, y])
    return FieldTask("stroke", TIMED, HAND, rows, NO_LINKAGE, crank=turned)


def _even(outline: np.ndarray, count: int) -> np.ndarray:
    """So many points (count, 2) at even steps along an outline."""
    at = np.concatenate([[0], np.abs(np.diff(outline)).cumsum()])
    z = np.interp(np.linspace(0, at[-1], count), at, outline)
    return np.column_stack([z.real, z.imag])
