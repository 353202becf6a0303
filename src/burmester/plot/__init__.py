"""Figures: drawings in the plane, maps, charts, and the image space in 3D.

Functions draw on Matplotlib axes that they are given and return the artists that they made.

E130 Matplotlib is missing
"""

from __future__ import annotations

from importlib.util import find_spec

from burmester.errors import InputError

if find_spec("matplotlib") is None:
    raise InputError(
        "E130",
        "figures need Matplotlib",
        why="it is not installed with burmester, which does without it for everything else",
        help='pip install "burmester[plot]"',
    )

from burmester.plot.camera import Box, Camera
from burmester.plot.charts import (
    pose_errors,
    structural_error,
    structural_error_figure,
    transmission,
)
from burmester.plot.common_curve import common_curve
from burmester.plot.family_map import family_figure, family_map
from burmester.plot.maps import centre_point_curve, circle_point_curve, pivot_map
from burmester.plot.mechanism import draw, linkage, linkage_figure, path
from burmester.plot.outlines import body, keep_out
from burmester.plot.paper import write_figures
from burmester.plot.partner_curve import partner_curve
from burmester.plot.plane import achieved, centrodes, coupler_curve, poses
from burmester.plot.space import image_space
from burmester.plot.style import figure, finish, house_style, legend
from burmester.plot.walk import steps, walk, write_gif

__all__ = [
    "Box",
    "Camera",
    "achieved",
    "body",
    "centre_point_curve",
    "centrodes",
    "circle_point_curve",
    "common_curve",
    "coupler_curve",
    "draw",
    "family_figure",
    "family_map",
    "figure",
    "finish",
    "house_style",
    "image_space",
    "keep_out",
    "legend",
    "linkage",
    "linkage_figure",
    "partner_curve",
    "path",
    "pivot_map",
    "pose_errors",
    "poses",
    "steps",
    "structural_error",
    "structural_error_figure",
    "transmission",
    "walk",
    "write_figures",
    "write_gif",
]
