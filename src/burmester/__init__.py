"""burmester: the planar four-bar linkages that guide a body through given poses."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from burmester.certificates.certificate import certify as certify
    from burmester.certificates.certificate import certify_five as certify_five
    from burmester.diagnosis.checks import Diagnosis as Diagnosis
    from burmester.diagnosis.checks import diagnose as diagnose
    from burmester.diagnosis.odd_pose import odd_pose as odd_pose
    from burmester.dyads.burmester_curve import dyad_curve as dyad_curve
    from burmester.dyads.critical_points import critical_dyads as critical_dyads
    from burmester.dyads.five_poses import dyads_of_five as dyads_of_five
    from burmester.dyads.image_space_fits import algebraic_fit as algebraic_fit
    from burmester.dyads.image_space_fits import larochelle as larochelle
    from burmester.dyads.image_space_fits import ravani_roth as ravani_roth
    from burmester.dyads.local_minima import best_dyads as best_dyads
    from burmester.dyads.pencil import fit_pencil as fit_pencil
    from burmester.dyads.pivot_map import fixed_pivot_map as fixed_pivot_map
    from burmester.dyads.pivot_map import moving_pivot_map as moving_pivot_map
    from burmester.dyads.three_poses import dyad_with_fixed_pivot as dyad_with_fixed_pivot
    from burmester.dyads.three_poses import dyad_with_moving_pivot as dyad_with_moving_pivot
    from burmester.errors import BurmesterError as BurmesterError
    from burmester.errors import InputError as InputError
    from burmester.fourbar.dyad import PP as PP
    from burmester.fourbar.dyad import PR as PR
    from burmester.fourbar.dyad import RP as RP
    from burmester.fourbar.dyad import RR as RR
    from burmester.fourbar.dyad import Dyad as Dyad
    from burmester.fourbar.linkage import Linkage as Linkage
    from burmester.fourbar.pose_error import PoseError as PoseError
    from burmester.geometry.displacement import Displacement as Displacement
    from burmester.geometry.quadric import fit_quadric as fit_quadric
    from burmester.geometry.regions import Line as Line
    from burmester.geometry.regions import Point as Point
    from burmester.geometry.regions import Polygon as Polygon
    from burmester.geometry.regions import Segment as Segment
    from burmester.geometry.regions import box as box
    from burmester.io.reading.poses import read_task as read_task
    from burmester.linkages.found_linkage import FoundLinkage as FoundLinkage
    from burmester.synthesis.motion_generation import synthesize as synthesize
    from burmester.synthesis.result import Synthesis as Synthesis
    from burmester.tasks.limits import Limits as Limits
    from burmester.tasks.motion_task import Task as Task
    from burmester.tasks.requirements import Requirements as Requirements

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
    "certificates.certificate": (
        "certify",
        "certify_five",
    ),
    "diagnosis.checks": (
        "Diagnosis",
        "diagnose",
    ),
    "diagnosis.odd_pose": ("odd_pose",),
    "dyads.burmester_curve": ("dyad_curve",),
    "dyads.critical_points": ("critical_dyads",),
    "dyads.five_poses": ("dyads_of_five",),
    "dyads.image_space_fits": (
        "algebraic_fit",
        "larochelle",
        "ravani_roth",
    ),
    "dyads.local_minima": ("best_dyads",),
    "dyads.pencil": ("fit_pencil",),
    "dyads.pivot_map": (
        "fixed_pivot_map",
        "moving_pivot_map",
    ),
    "dyads.three_poses": (
        "dyad_with_fixed_pivot",
        "dyad_with_moving_pivot",
    ),
    "errors": (
        "BurmesterError",
        "InputError",
    ),
    "fourbar.dyad": (
        "Dyad",
        "PP",
        "PR",
        "RP",
        "RR",
    ),
    "fourbar.linkage": ("Linkage",),
    "fourbar.pose_error": ("PoseError",),
    "geometry.displacement": ("Displacement",),
    "geometry.quadric": ("fit_quadric",),
    "geometry.regions": (
        "Line",
        "Point",
        "Polygon",
        "Segment",
        "box",
    ),
    "io.reading.poses": ("read_task",),
    "linkages.found_linkage": ("FoundLinkage",),
    "synthesis.motion_generation": ("synthesize",),
    "synthesis.result": ("Synthesis",),
    "tasks.limits": ("Limits",),
    "tasks.motion_task": ("Task",),
    "tasks.requirements": ("Requirements",),
}


def __getattr__(name: str) -> Any:
    for room, names in _ROOMS.items():
        if name in names:
            return getattr(import_module(f"burmester.{room}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
