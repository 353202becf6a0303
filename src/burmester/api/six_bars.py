"""From poses to six-bars in one call."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

from numpy.typing import ArrayLike

from burmester.api.linkage import ResultSixBar
from burmester.api.python_words import in_python_words
from burmester.api.result import Result
from burmester.api.synthesize import require_callable, task_of
from burmester.geometry.displacement import Displacement
from burmester.progress import Listener, shown
from burmester.sixbar.six_bars import CHAINS, SixBarOptions
from burmester.synthesis import six_bars as road
from burmester.tasks.motion_task import AngleUnit, Task
from burmester.tasks.options import SynthesisOptions

if TYPE_CHECKING:
    SixBarResult: TypeAlias = Result[ResultSixBar]
else:
    SixBarResult = Result  # as it was called


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
