"""A linkage that exists, judged in one call."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, TypeAlias, cast

from numpy.typing import ArrayLike

from burmester.api.python_words import in_python_words
from burmester.api.result import Result
from burmester.api.synthesize import require_callable, task_of
from burmester.errors import InputError
from burmester.fourbar.dyad import PP, PR, RP, RR, Dyad
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.io.linkage_file import read_linkage
from burmester.mechanisms.contract import Mechanism
from burmester.progress import Listener
from burmester.progress import shown as told
from burmester.sixbar.found import FoundSixBar
from burmester.sixbar.watt import WattLinkage
from burmester.synthesis.given_linkage import GivenDyad, OpenLink
from burmester.synthesis.judgement import judge_linkage
from burmester.synthesis.six_bars import SixBar, judge_six_bar
from burmester.tasks.motion_task import AngleUnit, Task
from burmester.tasks.option_table import Norm
from burmester.tasks.options import SynthesisOptions
from burmester.values import real_numbers, shown
from burmester.verdicts.found_linkage import FoundLinkage

Pivots: TypeAlias = tuple[ArrayLike, ArrayLike]
Given: TypeAlias = Linkage | FoundLinkage | Sequence[Dyad | Pivots] | SixBar | FoundSixBar


def judge(
    poses: Task | Displacement | ArrayLike,
    linkage: Given | str | os.PathLike[str],
    *,
    improve: bool = False,
    id: str | None = None,
    angle_unit: AngleUnit | None = None,
    length_unit: str | None = None,
    norm: Norm = "rms",
    length_per_radian: float | None = None,
    manufacturing_tolerance: float | None = None,
    time_limit: float | None = None,
    progress: Listener | None = None,
) -> Result[Any]:
    """One linkage that exists, judged as `synthesize` judges its own.

    Parameters
    ----------
    poses : Task, Displacement, (N, 3) or (N, 3, 3) array_like
        The motion, with limits and requirements if it is a `Task`; see `synthesize`.
    linkage : Linkage, WattLinkage, a linkage or six-bar of a result, two dyads, or a file
        A dyad is an RR, PR or RP, or its two pivots ((X, Y) in F, (x, y) in M) alone: then the
        length of its link follows from the poses.  A file is a result, an export to JSON, or a file
        of two dyads or of a six-bar's joints (see "Judge a linkage that exists" and "Six bars" in
        the manual).
    improve : bool
        Whether the nearest better linkages are looked for, too; of four-bars only.
    id : str, optional
        The linkage of a file that holds a result, such as "L2"; its first one if not given.
    angle_unit, length_unit, norm, length_per_radian, manufacturing_tolerance, time_limit, progress
        As in `synthesize`.

    Returns
    -------
    Result
        The given linkage as L1, with its errors and its verdict, then the better ones.  Of a
        six-bar it alone, as S1.

    Raises
    ------
    InputError
        E112 (numbers too large), E125 and E153 (no linkage), E154 (two dyads that make none), E155
        (lengths that can be assembled nowhere), E158 (pivots alone at points), E159 (better ones at
        points that the crank times), E195 to E197 (what does not go with six-bars), of files
        E101, E109, E150, E151 and E156, and what `Task` raises.

    Examples
    --------
    >>> import burmester
    >>> task = burmester.read_task("case:motiongen-shoulder")
    >>> pivots = [((16.53, -5.91), (21.72, -6.41)), ((24.2, -8.7), (23.3, -18.7))]
    >>> judged = burmester.judge(task, pivots)
    >>> print(judged.outcome.message)
    the linkage works
    """
    options = SynthesisOptions(
        norm=norm,
        length_per_radian=length_per_radian,
        manufacturing_tolerance=manufacturing_tolerance,
        time_limit=time_limit,
    )
    require_callable(progress)
    task = task_of(poses, angle_unit, length_unit)
    with in_python_words(), told(progress):
        given = _linkage(linkage, id, task.length_unit)
        if isinstance(given, Mechanism):
            _require_none(improve=improve, norm=norm != "rms", tolerance=manufacturing_tolerance)
            return Result.of(judge_six_bar(task, given, options))
        return Result.of(judge_linkage(task, given, options, improve=improve))


def _linkage(
    given: object, id: str | None, unit: str | None
) -> Linkage | SixBar | Sequence[GivenDyad]:
    """What `judge_linkage` or `judge_six_bar` takes, or E153."""
    if isinstance(given, str | os.PathLike):
        return read_linkage(given, id, unit)
    if isinstance(given, FoundLinkage):
        return given.linkage
    if isinstance(given, FoundSixBar | Mechanism):
        return _one_six_bar(given.linkage if isinstance(given, FoundSixBar) else given)
    if isinstance(given, Linkage):
        return given
    if not isinstance(given, list | tuple) or len(given) != 2:
        raise InputError(
            "E153",
            "this is no linkage",
            why=f"it is {shown(given)}",
            help="give a Linkage, a WattLinkage, a linkage of a result, a file, or two dyads such "
            "as ((100, -68), (53, -47)) and ((12, -17), (80, -17))",
        )
    first, second = given
    return [_dyad(first, 1), _dyad(second, 2)]


def _one_six_bar(given: object) -> SixBar:
    """The same with arrays as dimensions; E153 where it is not one."""
    if not isinstance(given, WattLinkage):
        return cast("SixBar", given)
    points = ("fixed_first", "fixed_second", "coupler_joint", "crank_joint", "body_joint")
    values = {}
    for name in WattLinkage.__match_args__:
        shape = (2,) if name in (*points, "link_joint") else ()
        what = f"the {name.replace('_', ' ')} of the six-bar"
        values[name] = real_numbers(getattr(given, name), shape, what, code="E153")
    return WattLinkage(**values)


def _require_none(**given: object) -> None:
    """Refuse what has no meaning for six-bars: E197."""
    for name, value in given.items():
        if value:
            word = {"tolerance": "manufacturing_tolerance"}.get(name, name)
            raise InputError(
                "E197",
                f"{word} has no meaning for six-bars",
                help=f"leave {word} out, or give a four-bar",
            )


def _dyad(given: Dyad | Pivots, number: int) -> GivenDyad:
    if isinstance(given, RR | PR | RP | PP):
        return given
    pivots = real_numbers(given, (2, 2), f"the pivots of D{number}", code="E153")
    return OpenLink(pivots[0], pivots[1])
