"""burmester: the planar four-bar linkages that guide a body through given poses."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from burmester.accuracy import PoseError as PoseError
    from burmester.agreement import odd_pose as odd_pose
    from burmester.certificate import certify as certify
    from burmester.certificate import certify_five as certify_five
    from burmester.critical import critical_dyads as critical_dyads
    from burmester.curve import dyad_curve as dyad_curve
    from burmester.diagnosis import Diagnosis as Diagnosis
    from burmester.diagnosis import diagnose as diagnose
    from burmester.displacement import Displacement as Displacement
    from burmester.dyad import PP as PP
    from burmester.dyad import PR as PR
    from burmester.dyad import RP as RP
    from burmester.dyad import RR as RR
    from burmester.dyad import Dyad as Dyad
    from burmester.errors import BurmesterError as BurmesterError
    from burmester.errors import InputError as InputError
    from burmester.exact import dyad_with_fixed_pivot as dyad_with_fixed_pivot
    from burmester.exact import dyad_with_moving_pivot as dyad_with_moving_pivot
    from burmester.exact import dyads_of_five as dyads_of_five
    from burmester.io.reading.poses import read_task as read_task
    from burmester.limits import Limits as Limits
    from burmester.limits import Line as Line
    from burmester.limits import Point as Point
    from burmester.limits import Polygon as Polygon
    from burmester.limits import Segment as Segment
    from burmester.limits import box as box
    from burmester.linkage import Linkage as Linkage
    from burmester.normal_distance import algebraic_fit as algebraic_fit
    from burmester.normal_distance import larochelle as larochelle
    from burmester.normal_distance import ravani_roth as ravani_roth
    from burmester.optimal import best_dyads as best_dyads
    from burmester.pencil import fit_pencil as fit_pencil
    from burmester.pivot_map import fixed_pivot_map as fixed_pivot_map
    from burmester.pivot_map import moving_pivot_map as moving_pivot_map
    from burmester.quadric import fit_quadric as fit_quadric
    from burmester.requirements import Requirements as Requirements
    from burmester.synthesis import FoundLinkage as FoundLinkage
    from burmester.synthesis import Synthesis as Synthesis
    from burmester.synthesis import synthesize as synthesize
    from burmester.task import Task as Task

__version__ = "0.1.0"

__all__ = [
    "PP",
    "PR",
    "RP",
    "RR",
    "BurmesterError",
    "Diagnosis",
    "Displacement",
    "Dyad",
    "FoundLinkage",
    "InputError",
    "Limits",
    "Line",
    "Linkage",
    "Point",
    "Polygon",
    "PoseError",
    "Requirements",
    "Segment",
    "Synthesis",
    "Task",
    "__version__",
    "algebraic_fit",
    "best_dyads",
    "box",
    "certify",
    "certify_five",
    "critical_dyads",
    "diagnose",
    "dyad_curve",
    "dyad_with_fixed_pivot",
    "dyad_with_moving_pivot",
    "dyads_of_five",
    "fit_pencil",
    "fit_quadric",
    "fixed_pivot_map",
    "larochelle",
    "moving_pivot_map",
    "odd_pose",
    "ravani_roth",
    "read_task",
    "synthesize",
]

# Loaded when first asked for, so that `burmester --help` needs no NumPy.
_ROOMS = {
    "accuracy": ("PoseError",),
    "agreement": ("odd_pose",),
    "certificate": ("certify", "certify_five"),
    "critical": ("critical_dyads",),
    "curve": ("dyad_curve",),
    "diagnosis": ("Diagnosis", "diagnose"),
    "displacement": ("Displacement",),
    "dyad": ("PP", "PR", "RP", "RR", "Dyad"),
    "errors": ("BurmesterError", "InputError"),
    "exact": ("dyad_with_fixed_pivot", "dyad_with_moving_pivot", "dyads_of_five"),
    "io.reading.poses": ("read_task",),
    "limits": ("Limits", "Line", "Point", "Polygon", "Segment", "box"),
    "linkage": ("Linkage",),
    "normal_distance": ("algebraic_fit", "larochelle", "ravani_roth"),
    "optimal": ("best_dyads",),
    "pencil": ("fit_pencil",),
    "pivot_map": ("fixed_pivot_map", "moving_pivot_map"),
    "quadric": ("fit_quadric",),
    "requirements": ("Requirements",),
    "synthesis": ("FoundLinkage", "Synthesis", "synthesize"),
    "task": ("Task",),
}


def __getattr__(name: str) -> Any:
    for room, names in _ROOMS.items():
        if name in names:
            return getattr(import_module(f"burmester.{room}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
