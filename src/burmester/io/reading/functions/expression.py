"""Expressions in x, such as log10(x): what they may hold, and their values.

Python's own parser reads them, and what it makes of a text is walked: numbers, x, pi, e, the four
operations, powers, signs and the functions below.  Nothing is ever executed.  What does not fit
is E190, with a caret below the place.
"""

from __future__ import annotations

import ast
import math
import warnings
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any, Final, TypeAlias

import numpy as np

from burmester.errors import InputError
from burmester.io.reading.pose_table import Source, is_held
from burmester.numerics.arrays import FloatArray

MOST_CHARACTERS: Final = 500
MOST_DEPTH: Final = 60  # operations within operations
CONSTANTS: Final[Mapping[str, float]] = MappingProxyType({"pi": math.pi, "e": math.e})
FUNCTIONS: Final[Mapping[str, Callable[[FloatArray], FloatArray]]] = MappingProxyType(
    {
        "sin": np.sin,
        "cos": np.cos,
        "tan": np.tan,
        "asin": np.arcsin,
        "acos": np.arccos,
        "atan": np.arctan,
        "sqrt": np.sqrt,
        "exp": np.exp,
        "log": np.log,
        "log10": np.log10,
        "abs": np.abs,
    }
)
_OPERATIONS: Final[Mapping[type[ast.operator], Callable[[Any, Any], Any]]] = MappingProxyType(
    {
        ast.Add: np.add,
        ast.Sub: np.subtract,
        ast.Mult: np.multiply,
        ast.Div: np.divide,
        ast.Pow: np.power,
    }
)
KNOWN: Final = f"x, pi, e, + - * / **, and {', '.join(FUNCTIONS)}"
Values: TypeAlias = Callable[[FloatArray], FloatArray]


def read_expression(source: Source) -> Values:
    """The values y (*,) at x (*,) of an expression in x; nan or inf where there are none.

    Raises E190.
    """
    value = _compiled(_parsed(source), source, 0)

    def values(x: FloatArray) -> FloatArray:
        x = np.asarray(x, dtype=np.float64)
        with np.errstate(all="ignore"):
            return np.broadcast_to(np.asarray(value(x), dtype=np.float64), x.shape)

    return values


def read_number(source: Source, start: int, text: str) -> float:
    """A number that may be written as an expression without x, such as pi/2; raises E190.

    start: where the text begins in the source.
    """
    own = Source(source.label, text)
    try:
        value = float(read_expression(own)(np.array([np.nan]))[0])
    except InputError as error:
        error.where = source.where(start, len(text))
        raise
    if not math.isfinite(value):
        raise _fault(
            source, start, len(text), f"{_quoted(text)} is no number", "such as 0, 1.5 or pi/2"
        )
    return value


def _parsed(source: Source) -> ast.expr:
    text = source.text
    if not text.strip():
        raise _fault(source, 0, 1, "the expression is empty", "such as log10(x)")
    if len(text) > MOST_CHARACTERS:
        message = f"the expression has {len(text)} characters, and {MOST_CHARACTERS} are the most"
        raise _fault(source, 0, 1, message, "a shorter one, such as log10(x)")
    lead = len(text) - len(text.lstrip())
    if "\n" in text or "\r" in text or not text.isprintable():
        raise _fault(source, 0, 1, "the expression is not one line of text", "such as log10(x)")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # 1(x) is told below, not by Python
            return ast.parse(text.strip(), mode="eval").body
    except SyntaxError as error:
        at = min(max((error.offset or 1) - 1 + lead, 0), len(text) - 1)
        raise _fault(source, at, 1, "the expression cannot be read from here on") from None
    except (ValueError, RecursionError, MemoryError, OverflowError):
        raise _fault(source, 0, 1, "the expression cannot be read") from None


def _compiled(  # noqa: PLR0912  a case each
    node: ast.expr, source: Source, depth: int
) -> Callable[[FloatArray], Any]:
    """The value at x; refuses all but the operations, names and functions that are known."""
    at, width = _place(node, source)
    if depth > MOST_DEPTH:
        message = f"the expression has more than {MOST_DEPTH} operations within each other"
        raise _fault(source, at, width, message, "a simpler one, such as log10(x)")
    match node:
        case ast.Constant(value=value) if type(value) in (int, float):
            if not math.isfinite(number := _number(value)):
                raise _fault(source, at, width, "this number is too large", "one below 1e308")
            written = source.text[at : at + width].replace("_", "")
            if value == 0 and isinstance(value, float) and not is_held(written):
                raise _fault(source, at, width, "this number is too small", "0 if that is meant")
            return lambda _: number
        case ast.Name(id="x"):
            return lambda x: x
        case ast.Name(id=name) if name in CONSTANTS:
            return lambda _: CONSTANTS[name]
        case ast.Name(id=name):
            hint = f"write {name}(x)" if name in FUNCTIONS else f"known are {KNOWN}"
            message = (
                f"{_quoted(name)} needs brackets"
                if name in FUNCTIONS
                else f"there is no {_quoted(name)}"
            )
            raise InputError("E190", message, where=source.where(at, width), help=hint)
        case ast.UnaryOp(op=ast.UAdd() | ast.USub() as sign, operand=operand):
            inner = _compiled(operand, source, depth + 1)
            return (lambda x: -inner(x)) if isinstance(sign, ast.USub) else inner
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _OPERATIONS:
            one, two = (_compiled(each, source, depth + 1) for each in (left, right))
            return lambda x: _OPERATIONS[type(op)](np.float64(1) * one(x), two(x))
        case ast.BinOp(op=ast.BitXor()):
            raise _fault(source, at, width, "^ is no operation here", "** for a power, as in x**2")
        case ast.Call(func=ast.Name(id=name), args=[argument], keywords=[]) if name in FUNCTIONS:
            inner = _compiled(argument, source, depth + 1)
            return lambda x: FUNCTIONS[name](np.float64(1) * inner(x))
        case ast.Call(func=ast.Name(id=name)) if name in FUNCTIONS:
            raise _fault(source, at, width, f"{name} takes one number", f"{name}(x)")
        case ast.Call(func=ast.Name(id=name)):
            hint = f"known are {KNOWN}" + (
                ": write log for the natural one" if name == "ln" else ""
            )
            message = f"there is no function {_quoted(name)}"
            raise InputError("E190", message, where=source.where(at, width), help=hint)
        case ast.Call():
            raise _fault(source, at, width, "a * is missing here", "2*(x + 1), say")
        case _:
            message = (
                f"{_quoted(source.text[at : at + width])} is nothing that an expression may hold"
            )
            raise InputError(
                "E190", message, where=source.where(at, width), help=f"known are {KNOWN}"
            )


def _number(value: Any) -> float:
    try:
        return float(value)
    except OverflowError:
        return math.inf


def _place(node: ast.expr, source: Source) -> tuple[int, int]:
    """Where a node begins in the text, and how long it is; Python counts bytes of UTF-8."""
    text = source.text
    lead = len(text) - len(text.lstrip())
    coded = text.strip().encode()
    start = len(coded[: node.col_offset].decode(errors="ignore"))
    end = len(coded[: node.end_col_offset or node.col_offset + 1].decode(errors="ignore"))
    return lead + start, max(1, end - start)


def _quoted(text: str) -> str:
    return f'"{text}"' if len(text) <= 30 else f'"{text[:27]}..."'


def _fault(
    source: Source, at: int, width: int, message: str, write: str | None = None
) -> InputError:
    help = (
        f"write {write}"
        if write
        else f"write an expression in x, such as log10(x); known are {KNOWN}"
    )
    return InputError("E190", message, where=source.where(at, width), help=help)
