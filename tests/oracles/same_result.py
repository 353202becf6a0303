"""Whether two results are the same, attribute by attribute: whatever is public is looked at."""

from collections.abc import Mapping

import numpy as np

# What concerns the search alone, which reading a result does not repeat; and how the file of its
# poses was read, which a result does not say.
OF_THE_SEARCH = {"fits", "points", "causes", "search", "time_limit"}
OF_THE_POSES = {"notes", "read_as"}
PERIODS = {"input_phase": 2 * np.pi, "output_phase": 2 * np.pi}
RELATIVE = 1e-5
ABSOLUTE = 1e-6  # of a size


def differences(one, other, size, path="", seen=None):
    """Each public attribute, at any depth, that is not the same in both: [(path, one, other)].

    size: of which a length may differ by a millionth.
    """
    seen = set() if seen is None else seen
    if one is other or (id(one), id(other)) in seen:
        return []
    name = path.rpartition(".")[2]
    if isinstance(one, str | bool | np.bool_ | int | float | np.number | np.ndarray | None):
        return [] if alike(one, other, size, PERIODS.get(name)) else [(path, one, other)]
    seen.add((id(one), id(other)))
    parts, others = parts_of(one), parts_of(other)
    if type(one) is not type(other) or parts.keys() != others.keys():
        return [(path, one, other)]
    return [
        each
        for key in parts
        for each in differences(parts[key], others[key], size, f"{path}{key}", seen)
    ]


def parts_of(thing):
    """The items of a collection, or the public attributes of another object, methods left out."""
    if isinstance(thing, Mapping):
        return {f"[{key!r}]": each for key, each in thing.items()}
    if isinstance(thing, set | frozenset):
        thing = sorted(thing)
    if isinstance(thing, tuple | list | range) and not hasattr(thing, "_fields"):
        return {f"[{k}]": each for k, each in enumerate(thing)}
    names = [each for each in dir(thing) if not each.startswith("_")]
    values = {f".{each}": value_of(thing, each) for each in names}
    left_out = {f".{each}" for each in OF_THE_SEARCH | OF_THE_POSES}
    if {".major", ".minor", ".direction"} <= values.keys():  # an ellipse, round or not
        turn = np.exp(1j * values.pop(".direction"))
        axes = np.array([[turn.real, -turn.imag], [turn.imag, turn.real]])
        values[".shape"] = axes @ np.diag([values[".major"], values[".minor"]]) @ axes.T
    return {k: each for k, each in values.items() if k not in left_out and not callable(each)}


def value_of(thing, name):
    """An attribute, or the error that asking for it raises, as text."""
    try:
        return getattr(thing, name)
    except Exception as error:
        return f"{type(error).__name__}: {error}"


def alike(one, other, size, period=None):
    """Whether two values, or arrays of them, are the same up to rounding."""
    one, other = np.asarray(one), np.asarray(other)
    if one.dtype.kind not in "fc" or other.dtype.kind not in "fc":
        return one.shape == other.shape and bool((one == other).all())
    if period is not None:
        other = other + period * np.round((one - other) / period)
    return one.shape == other.shape and np.allclose(
        one, other, rtol=RELATIVE, atol=ABSOLUTE * size, equal_nan=True
    )
