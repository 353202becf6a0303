"""burmester: the planar four-bar linkages that guide a body through given poses."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from burmester.critical import critical_dyads as critical_dyads
    from burmester.curve import dyad_curve as dyad_curve
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
    from burmester.linkage import Linkage as Linkage
    from burmester.optimal import best_dyads as best_dyads
    from burmester.pencil import fit_pencil as fit_pencil
    from burmester.quadric import fit_quadric as fit_quadric
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
    "Displacement",
    "Dyad",
    "InputError",
    "Linkage",
    "Synthesis",
    "Task",
    "__version__",
    "best_dyads",
    "critical_dyads",
    "dyad_curve",
    "dyad_with_fixed_pivot",
    "dyad_with_moving_pivot",
    "dyads_of_five",
    "fit_pencil",
    "fit_quadric",
    "synthesize",
]

# Loaded when first asked for, so that `burmester --help` needs no NumPy.
_ROOMS = {
    "critical": ("critical_dyads",),
    "curve": ("dyad_curve",),
    "displacement": ("Displacement",),
    "dyad": ("PP", "PR", "RP", "RR", "Dyad"),
    "errors": ("BurmesterError", "InputError"),
    "exact": ("dyad_with_fixed_pivot", "dyad_with_moving_pivot", "dyads_of_five"),
    "linkage": ("Linkage",),
    "optimal": ("best_dyads",),
    "pencil": ("fit_pencil",),
    "quadric": ("fit_quadric",),
    "synthesis": ("Synthesis", "synthesize"),
    "task": ("Task",),
}


def __getattr__(name: str) -> Any:
    for room, names in _ROOMS.items():
        if name in names:
            return getattr(import_module(f"burmester.{room}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
