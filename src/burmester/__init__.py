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
    from burmester.api.balance import balance as balance
    from burmester.api.function import synthesize_function as synthesize_function
    from burmester.api.judge import judge as judge
    from burmester.api.linkage import ResultLinkage as ResultLinkage
    from burmester.api.linkage import ResultSixBar as ResultSixBar
    from burmester.api.result import Result as Result
    from burmester.api.saved import read_result as read_result
    from burmester.api.synthesize import SixBarResult as SixBarResult
    from burmester.api.synthesize import synthesize as synthesize
    from burmester.api.synthesize import synthesize_six_bars as synthesize_six_bars
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
    from burmester.tasks.loads import Drive as Drive
    from burmester.tasks.loads import End as End
    from burmester.tasks.loads import Force as Force
    from burmester.tasks.loads import Loads as Loads
    from burmester.tasks.loads import Mass as Mass
    from burmester.tasks.loads import Plates as Plates
    from burmester.tasks.loads import Spring as Spring
    from burmester.tasks.motion_task import Task as Task
    from burmester.tasks.rails import Rail as Rail
    from burmester.tasks.requirements import Requirements as Requirements
    from burmester.tasks.surroundings import KeepOut as KeepOut
    from burmester.tasks.surroundings import Surroundings as Surroundings
    from burmester.verdicts.found_linkage import FoundLinkage as FoundLinkage
if TYPE_CHECKING:
    from typing import Any

__version__ = "0.1.0"

# Names by their rooms: loaded when first asked for, so that `burmester --help` needs no NumPy.
_OF_ROOMS = {
    "api.balance": "balance",
    "api.function": "synthesize_function",
    "api.judge": "judge",
    "api.linkage": "ResultLinkage ResultSixBar",
    "api.result": "Result",
    "api.saved": "read_result",
    "api.synthesize": "SixBarResult synthesize synthesize_six_bars",
    "diagnosis.checks": "Diagnosis diagnose",
    "dyads.local_minima": "best_dyads",
    "errors": "BurmesterError InputError",
    "following.follow": "follow",
    "following.followed": "Change Followed",
    "fourbar.dyad": "PP PR RP RR",
    "fourbar.linkage": "Linkage",
    "fourbar.pose_error": "PoseError",
    "geometry.displacement": "Displacement",
    "geometry.regions": "Line Point Polygon Segment box",
    "io.reading.poses": "read_task",
    "progress": "Progress",
    "tasks.crank_timing": "CrankTiming",
    "tasks.limits": "Limits",
    "tasks.loads": "Drive End Force Loads Mass Plates Spring",
    "tasks.motion_task": "Task",
    "tasks.rails": "Rail",
    "tasks.requirements": "Requirements",
    "tasks.surroundings": "KeepOut Surroundings",
}
# Solvers and parts of results, reachable by their names alone as well.
_BESIDE = {
    "certificates.certificate": "certify certify_five",
    "diagnosis.odd_pose": "odd_pose",
    "dyads.burmester_curve": "dyad_curve",
    "dyads.critical_points": "critical_dyads",
    "dyads.five_poses": "dyads_of_five",
    "dyads.image_space_fits": "algebraic_fit larochelle ravani_roth",
    "dyads.pencil": "fit_pencil",
    "dyads.pivot_map": "fixed_pivot_map moving_pivot_map",
    "dyads.three_poses": "dyad_with_fixed_pivot dyad_with_moving_pivot",
    "fourbar.dyad": "Dyad",
    "geometry.quadric": "fit_quadric",
    "sixbar.found": "FoundSixBar",
    "sixbar.watt": "WattLinkage",
    "synthesis.result": "Synthesis",
    "verdicts.found_linkage": "FoundLinkage",
}
_PACKAGES = ("batch", "export", "notebook", "plot", "report")

_ROOMS, _ROOMS_BESIDE = (
    {name: room for room, names in rooms.items() for name in names.split()}
    for rooms in (_OF_ROOMS, _BESIDE)
)

__all__ = ["__version__", *_ROOMS]  # noqa: PLE0604


def __getattr__(name: str) -> Any:
    from importlib import import_module  # noqa: PLC0415  it is seldom needed

    if name in _PACKAGES:
        return import_module(f"burmester.{name}")
    if (room := {**_ROOMS, **_ROOMS_BESIDE}.get(name)) is not None:
        return getattr(import_module(f"burmester.{room}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted([*__all__, *_PACKAGES])
