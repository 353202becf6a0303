"""From poses to linkages in one call."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from burmester.api.linkage import ResultSixBar
from burmester.api.python_words import in_python_words
from burmester.api.result import Result
from burmester.errors import InputError
from burmester.geometry.displacement import Displacement
from burmester.progress import Listener, shown
from burmester.sixbar.six_bars import CHAINS, SixBarOptions
from burmester.synthesis import motion_generation
from burmester.synthesis import six_bars as road
from burmester.tasks.crank_timing import CrankTiming
from burmester.tasks.motion_task import AngleUnit, Task
from burmester.tasks.option_table import Method, Norm, Preference
from burmester.tasks.options import SynthesisOptions
from burmester.values import real_numbers
from burmester.values import shown as shortly

if TYPE_CHECKING:
    SixBarResult: TypeAlias = Result[ResultSixBar]
else:
    SixBarResult = Result  # as it was called


def synthesize(
    poses: Task | Displacement | ArrayLike,
    method: Method = "auto",
    *,
    angle_unit: AngleUnit | None = None,
    length_unit: str | None = None,
    crank: ArrayLike | None = None,
    norm: Norm = "rms",
    normalise: bool = True,
    certify: bool = False,
    length_per_radian: float | None = None,
    manufacturing_tolerance: float | None = None,
    rounding_step: float | None = None,
    stock_lengths: Sequence[float] = (),
    prefer: Preference = "transmission",
    time_limit: float | None = None,
    nine_point_starts: bool = False,
    progress: Listener | None = None,
) -> Result:
    """Every four-bar that guides a body through or near poses, judged and ranked.

    Parameters
    ----------
    poses : Task, Displacement, (N, 3) or (N, 3, 3) array_like
        The motion.  Rows are x, y and angle of the body's frame M, seen in F.  Limits,
        requirements, weights and exact poses are parts of a `Task`.
    method : {"auto", "complete", "exact", "pencil"}
        "complete" finds every locally best dyad of six poses or more; "exact" all dyads through
        five; "pencil" is the paper's, for six or more; "auto" is exact for five conditions and
        complete for more.
    angle_unit : {"deg", "rad"}
        The unit of the angles of rows; it is never guessed.  A `Displacement` has radians.
    length_unit : str, optional
        The unit of x and y, such as "mm".  It is shown, and decides the scale of drawings.
    crank : (N,) array_like, optional
        The angle of the driver at each pose, in the unit of the angles of rows, or in radians;
        nan where there is none.  They count from the first one, but for whole turns; a `Task` with
        a `CrankTiming` says more.
    norm : {"rms", "worst"}
        What is least: the sum of squared distances, or the greatest distance.
    normalise : bool
        False lets the pencil fit the numbers as they come, as the paper does.
    certify : bool
        Whether the completeness of the answer is proved, in ball arithmetic.
    length_per_radian : float, optional
        The length, in the task's unit, that counts as much as one radian of angle error; the
        characteristic length of the task if not given.
    manufacturing_tolerance : float, optional
        How exactly links and pivots are built, a length: the spread of the errors is reported.
    rounding_step : float, optional
        Lengths and pivots are rounded to multiples of this length.
    stock_lengths : sequence of float
        The link lengths that are available.
    prefer : {"transmission", "size", "accuracy"}
        What the recommended linkage of two to four poses is best at.
    time_limit : float, optional
        Seconds after which nothing more is looked for or refined.  Where that ends something, a
        warning W221 says what.  What every answer needs may take longer.
    nine_point_starts : bool
        Near the points of an open path linkages are looked for from those through nine of them as
        well, which takes some seconds more.
    progress : callable, optional
        Called with a `Progress` where something begins and at every step of it; what it raises
        ends the computation, and comes through.

    Returns
    -------
    Result
        Linkages by rank, with drawings, files and everything learnt on the way.

    Raises
    ------
    InputError
        E103 (not finite), E110 (rows without an angle unit), E112 (too large), E120 (too few
        poses), E121 and E123 (the method does not take this task), E125 (no numbers, or of a
        wrong shape), E130 (a library is missing), E132 (limits that no link can meet), E134 (an
        option that makes no sense).

    Examples
    --------
    >>> import burmester
    >>> rows = [(-3.9696, -2.6338, 37.23), (-0.2223, -0.3211, 27.48), (3.3279, 3.9568, 8.17),
    ...         (7.7225, 10.0149, -14.86), (5.7615, 18.8535, -25.64)]
    >>> result = burmester.synthesize(rows, angle_unit="deg")
    >>> print(result.outcome.message)
    6 four-bars from 4 real dyads (of the 4 that five poses have), 3 of them usable
    >>> [(linkage.id, linkage.type) for linkage in result.usable]
    [('L1', 'crank-rocker'), ('L2', 'crank-rocker'), ('L3', 'crank-rocker')]
    """
    options = SynthesisOptions(
        method,
        norm,
        normalise=normalise,
        certify=certify,
        length_per_radian=length_per_radian,
        manufacturing_tolerance=manufacturing_tolerance,
        rounding_step=rounding_step,
        stock_lengths=stock_lengths,
        prefer=prefer,
        time_limit=time_limit,
        nine_point_starts=nine_point_starts,
    )
    require_callable(progress)
    task = task_of(poses, angle_unit, length_unit)
    if crank is not None:
        task = replace(task, timing=_timing(crank, task, angle_unit))
    with in_python_words(), shown(progress):
        return Result.of(motion_generation.synthesize(task, options))


def _timing(crank: ArrayLike, task: Task, angle_unit: AngleUnit | None) -> CrankTiming:
    """The timing of a task by angles of its driver; E108 where it has one already."""
    if task.timing is not None:
        help = "leave crank out, or make the task without its timing"
        raise InputError("E108", "a Task that is timed has its crank angles already", help=help)
    angles = real_numbers(crank, (None,), "the crank angles", code="E186", finite=False)
    return CrankTiming(np.radians(angles) if angle_unit == "deg" else angles)


def require_callable(progress: object) -> None:
    """Refuse what cannot be called with a `Progress`; raises E134."""
    if progress is not None and not callable(progress):
        raise InputError(
            "E134",
            f"progress is {shortly(progress)}, nothing that can be called",
            help="give a function of one argument, such as progress=print, or leave it out",
        )


def task_of(
    poses: Task | Displacement | ArrayLike, angle_unit: AngleUnit | None, length_unit: str | None
) -> Task:
    """The task that poses make; E110 where the unit of angles is open or stated twice."""
    if not isinstance(poses, Task | Displacement):
        return Task.from_rows(poses, angle_unit=angle_unit, length_unit=length_unit)
    if angle_unit is not None:
        raise InputError(
            "E110",
            f"the angles of a {type(poses).__name__} are radians, and need no angle_unit",
            help="leave angle_unit out, or give rows of x, y and angle",
        )
    if isinstance(poses, Displacement):
        return Task(poses, length_unit=length_unit)
    if length_unit is not None:
        raise InputError(
            "E125",
            "a Task has its length unit already",
            help="leave length_unit out, or make the task with it",
        )
    return poses


def synthesize_six_bars(
    poses: Task | Displacement | ArrayLike,
    *,
    angle_unit: AngleUnit | None = None,
    length_unit: str | None = None,
    chains: int = CHAINS,
    seed: int = 0,
    most: int = 8,
    kind: str = "all",
    time_limit: float | None = None,
    progress: Listener | None = None,
) -> Result[ResultSixBar]:
    """Six-bars that carry a body through two to five poses, by random search.

    Of Watt's first kind, and of Stephenson's first and third.

    Parameters
    ----------
    poses : Task, Displacement, (N, 3) or (N, 3, 3) array_like
        The motion.  Rows are x, y and angle of the body's frame M, seen in F.  Regions of pivots,
        lengths of cranks, the least transmission angle, the link ratio, a driver that turns fully
        and the order of the poses are parts of a `Task`.
    angle_unit : {"deg", "rad"}
        The unit of the angles of rows; it is never guessed.
    length_unit : str, optional
        The unit of x and y, such as "mm".
    chains : int
        How many 3R chains are drawn at random and made six-bars of each kind.
    seed : int
        Of the random numbers; the same one gives the same answer.
    most : int
        How many six-bars the answer has at most.
    kind : {"all", "Watt I", "Stephenson I", "Stephenson III"}
        Whether six-bars of one kind only are looked for.
    time_limit : float, optional
        Seconds after which no further chains are looked at.
    progress : callable, optional
        Called with a `Progress` at every step.

    Returns
    -------
    Result
        The six-bars by rank; each has its lengths, `joints` and `body` for any angle of the driver.

    Raises
    ------
    InputError
        E195 (poses that do not fit), E196 (limits or requirements that six-bars do not keep), E197
        (options that make no sense), and what rows of poses raise.

    Examples
    --------
    >>> import burmester
    >>> rows = [(0, 0, 0), (1, 0.3, 8), (2.1, 0.5, 17), (3, 0.9, 25), (4.2, 1.1, 36)]
    >>> result = burmester.synthesize_six_bars(rows, angle_unit="deg", chains=500)
    >>> best = result.best
    >>> bool(best.error.position.max() < 1e-9)
    True
    >>> best.body(best.drive).translation.round(6).tolist()[4]
    [4.2, 1.1]
    """
    require_callable(progress)
    task = task_of(poses, angle_unit, length_unit)
    options = SixBarOptions(chains, seed, most, kind)
    with in_python_words(), shown(progress):
        how = SynthesisOptions(time_limit=time_limit)
        return Result.of(road.synthesize_six_bars(task, options, how))
