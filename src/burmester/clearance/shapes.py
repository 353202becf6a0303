"""Polygons, outlines and bars as Shapely's geometries, many at once."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
import shapely
from numpy.typing import NDArray

from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Polygon
from burmester.numerics.arrays import FloatArray

__all__ = ["Geometries", "area", "distances", "moved", "segments"]

Geometries: TypeAlias = NDArray[np.object_]


def area(polygon: Polygon) -> shapely.Polygon:
    """The inside and the edge of a polygon."""
    return shapely.Polygon(polygon.vertices)


def moved(polygon: Polygon, places: Displacement) -> Geometries:
    """A polygon of M in F, at places (n,); all of its places are finite."""
    return np.asarray(shapely.polygons(places[:, None].act(polygon.vertices)))


def segments(ends: FloatArray) -> Geometries:
    """Segments between ends (n, 2, 2), points where both ends are one."""
    return np.asarray(shapely.linestrings(ends))


def distances(ones: Geometries, others: Geometries | shapely.Geometry) -> FloatArray:
    """How far shapes are apart, (n,); 0 where they touch or overlap."""
    return np.asarray(shapely.distance(ones, others), dtype=np.float64)
