"""The map of a family as plain data, thinned to what a page draws."""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from burmester.errors import InputError
from burmester.families.family_map import FamilyMap
from burmester.families.pair_verdicts import CLASS_WORDS, PairClass
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage import Linkage
from burmester.numerics.arrays import FloatArray
from burmester.requirements.transmission import TRANSMISSION
from burmester.synthesis.family_map import family_map_of
from burmester.synthesis.result import Synthesis
from burmester.verdicts.found_linkage import FoundLinkage

SAMPLES: Final = 120  # dyads along the curve of four poses
COLUMNS, ROWS = 96, 72  # fixed pivots of the plane of three
SCALE_STEP: Final = 5.0  # degrees; the scale of colours ends at a multiple of it
DIGITS: Final = 6  # of pivots and lengths; a screen shows fewer


def family_map(synthesis: Synthesis) -> dict[str, Any] | None:
    """What the page needs of the map; None where the task has none."""
    try:
        found = family_map_of(synthesis, samples=SAMPLES, columns=COLUMNS, rows=ROWS)
    except InputError:
        return None
    if found is None:
        return None
    low = float(found.bounds.asked[TRANSMISSION])
    works = found.verdicts.classes <= PairClass.FARTHER
    best = float(np.degrees(np.where(works, found.verdicts.transmission, 0.0).max()))
    high = max(float(np.ceil(best / SCALE_STEP)) * SCALE_STEP, low + SCALE_STEP)
    data = {
        "kind": found.kind,
        "words": list(CLASS_WORDS.values()),
        "scale": [low, high],
        "cells": _cells(found),
    }
    if found.kind == "curve":
        return data | _curve(found, [each.linkage for each in synthesis.linkages])
    return data | _plane(found, synthesis.linkages[0])


def _cells(found: FamilyMap) -> list[int]:
    """Each pair as one number: class + 6 (driver + 2 whole degrees of the transmission angle).

    Of a curve the pairs above the diagonal, row by row; of a plane row by row from below.
    """
    degrees = np.floor(np.degrees(np.nan_to_num(found.verdicts.transmission)) + 1e-6)
    driver = found.verdicts.driver.astype(np.intp)
    codes = found.verdicts.classes + len(PairClass) * (driver + 2 * degrees.astype(np.intp))
    if found.kind == "curve":
        codes = codes[np.triu_indices(len(codes), 1)]
    return [int(code) for code in codes.ravel()]


def _curve(found: FamilyMap, linkages: list[Linkage]) -> dict[str, Any]:
    """The dyads along the curve, and where linkages are on it."""
    assert isinstance(found.first, RR)
    return {
        "loops": np.bincount(found.loop).tolist(),
        "fixed": _short(found.first.fixed_pivot),
        "moving": _short(found.first.moving_pivot),
        "length": _short(found.first.radius),
        "places": [found.places_of(each) for each in linkages],
    }


def _plane(found: FamilyMap, of: FoundLinkage) -> dict[str, Any]:
    """The corners of the rectangle, and the two dyads of the linkage that the map is of."""
    at = found.second.fixed_pivot
    chosen, other = of.dyads
    if chosen.dyad is not found.first:
        chosen, other = other, chosen
    first, second = chosen.dyad, other.dyad
    return {
        "columns": at.shape[1],
        "rows": at.shape[0],
        "low": _short(at[0, 0]),
        "high": _short(at[-1, -1]),
        "poles": [_short(pole) for pole in found.poles if np.isfinite(pole).all()],
        "chosen": {
            "id": chosen.id,
            "fixed": _short(first.fixed_pivot) if isinstance(first, RR | RP) else None,
            "moving": _short(first.moving_pivot) if isinstance(first, RR | PR) else None,
        },
        "other": {
            "id": other.id,
            "fixed": _short(second.fixed_pivot) if isinstance(second, RR) else None,
        },
    }


def _short(values: FloatArray) -> Any:
    """Nested lists of an array, with the digits that are drawn; 0 where a pivot is infinite."""
    finite = np.where(np.isfinite(values), values, 0.0)
    size = 10.0 ** (DIGITS - 1 - np.floor(np.log10(np.maximum(np.abs(finite), 1e-300))))
    return np.where(finite == 0, 0.0, np.round(finite * size) / size).tolist()
