"""burmester: the planar four-bar linkages that guide a body through given poses.

>>> import burmester
>>> rows = [(-3.9696, -2.6338, 37.23), (-0.2223, -0.3211, 27.48), (3.3279, 3.9568, 8.17),
...         (7.7225, 10.0149, -14.86), (5.7615, 18.8535, -25.64)]
>>> result = burmester.synthesize(rows, angle_unit="deg")
>>> result.best.type
'crank-rocker'

`burmester.plot`, `burmester.report`, `burmester.export`, `burmester.batch` and
`burmester.notebook` are loaded when they are first used.
The classical methods and the solvers live in their rooms, such as `burmester.dyads.pencil`.
"""

from __future__ import annotations

TYPE_CHECKING = False  # as type checkers take it; `typing` would be a third of the way to --help
if TYPE_CHECKING:
    from burmester import batch as batch
    from burmester import export as export
    from burmester import notebook as notebook
    from burmester import plot as plot
    from burmester import report as report
    from burmester.api.function import synthesize_function as synthesize_function
    from burmester.api.judge import judge as judge
    from burmester.api.linkage import ResultLinkage as ResultLinkage
    from burmester.api.linkage import ResultSixBar as ResultSixBar
    from burmester.api.result import Result as Result
    from burmester.api.saved import read_result as read_result
    from burmester.api.six_bars import SixBarResult as SixBarResult
    from burmester.api.six_bars import synthesize_six_bars as synthesize_six_bars
    from burmester.api.synthesize import synthesize as synthesize
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
    from burmester.following.follow import follow as follow
    from burmester.following.followed import Change as Change
    from burmester.following.followed import Followed as Followed
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
    from burmester.progress import Progress as Progress
    from burmester.sixbar.found import FoundSixBar as FoundSixBar
    from burmester.sixbar.watt import WattLinkage as WattLinkage
    from burmester.synthesis.result import Synthesis as Synthesis
    from burmester.tasks.crank_timing import CrankTiming as CrankTiming
    from burmester.tasks.limits import Limits as Limits
    from burmester.tasks.motion_task import Task as Task
    from burmester.tasks.rails import Rail as Rail
    from burmester.tasks.requirements import Requirements as Requirements
    from burmester.tasks.surroundings import KeepOut as KeepOut
    from burmester.tasks.surroundings import Surroundings as Surroundings
    from burmester.verdicts.found_linkage import FoundLinkage as FoundLinkage
if TYPE_CHECKING:
    from typing import Any

__version__ = "0.1.0"

# Each name with its room: loaded when first asked for, so that `burmester --help` needs no NumPy.
_ROOMS = {
    "PP": "fourbar.dyad",
    "PR": "fourbar.dyad",
    "RP": "fourbar.dyad",
    "RR": "fourbar.dyad",
    "BurmesterError": "errors",
    "Change": "following.followed",
    "CrankTiming": "tasks.crank_timing",
    "Diagnosis": "diagnosis.checks",
    "Displacement": "geometry.displacement",
    "Followed": "following.followed",
    "InputError": "errors",
    "KeepOut": "tasks.surroundings",
    "Limits": "tasks.limits",
    "Rail": "tasks.rails",
    "Line": "geometry.regions",
    "Linkage": "fourbar.linkage",
    "Point": "geometry.regions",
    "Polygon": "geometry.regions",
    "PoseError": "fourbar.pose_error",
    "Progress": "progress",
    "Requirements": "tasks.requirements",
    "Result": "api.result",
    "ResultLinkage": "api.linkage",
    "ResultSixBar": "api.linkage",
    "Segment": "geometry.regions",
    "SixBarResult": "api.six_bars",
    "Surroundings": "tasks.surroundings",
    "Task": "tasks.motion_task",
    "best_dyads": "dyads.local_minima",
    "box": "geometry.regions",
    "diagnose": "diagnosis.checks",
    "follow": "following.follow",
    "judge": "api.judge",
    "read_result": "api.saved",
    "read_task": "io.reading.poses",
    "synthesize": "api.synthesize",
    "synthesize_function": "api.function",
    "synthesize_six_bars": "api.six_bars",
}
# Solvers and parts of results, reachable by their names alone as well.
_ROOMS_BESIDE = {
    "FoundLinkage": "verdicts.found_linkage",
    "FoundSixBar": "sixbar.found",
    "Synthesis": "synthesis.result",
    "WattLinkage": "sixbar.watt",
    "algebraic_fit": "dyads.image_space_fits",
    "certify": "certificates.certificate",
    "certify_five": "certificates.certificate",
    "critical_dyads": "dyads.critical_points",
    "dyad_curve": "dyads.burmester_curve",
    "dyad_with_fixed_pivot": "dyads.three_poses",
    "dyad_with_moving_pivot": "dyads.three_poses",
    "dyads_of_five": "dyads.five_poses",
    "Dyad": "fourbar.dyad",
    "fit_pencil": "dyads.pencil",
    "fit_quadric": "geometry.quadric",
    "fixed_pivot_map": "dyads.pivot_map",
    "larochelle": "dyads.image_space_fits",
    "moving_pivot_map": "dyads.pivot_map",
    "odd_pose": "diagnosis.odd_pose",
    "ravani_roth": "dyads.image_space_fits",
}
_PACKAGES = ("batch", "export", "notebook", "plot", "report")

__all__ = [
    "PP",
    "PR",
    "RP",
    "RR",
    "BurmesterError",
    "Change",
    "CrankTiming",
    "Diagnosis",
    "Displacement",
    "Followed",
    "InputError",
    "KeepOut",
    "Limits",
    "Line",
    "Linkage",
    "Point",
    "Polygon",
    "PoseError",
    "Progress",
    "Rail",
    "Requirements",
    "Result",
    "ResultLinkage",
    "ResultSixBar",
    "Segment",
    "SixBarResult",
    "Surroundings",
    "Task",
    "__version__",
    "best_dyads",
    "box",
    "diagnose",
    "follow",
    "judge",
    "read_result",
    "read_task",
    "synthesize",
    "synthesize_function",
    "synthesize_six_bars",
]


def __getattr__(name: str) -> Any:
    from importlib import import_module  # noqa: PLC0415  it is seldom needed

    if name in _PACKAGES:
        return import_module(f"burmester.{name}")
    if (room := {**_ROOMS, **_ROOMS_BESIDE}.get(name)) is not None:
        return getattr(import_module(f"burmester.{room}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted([*__all__, *_PACKAGES])
