"""A result that was saved, as a person holds it again."""

from __future__ import annotations

import os
from typing import Any

from burmester.api.function import FunctionGenerators
from burmester.api.result import Result
from burmester.io import saved
from burmester.synthesis.result import Synthesis


def read_result(source: str | os.PathLike[str]) -> Result[Any] | FunctionGenerators:
    """What `Result.save` or `burmester synthesize -o` wrote.

    Parameters
    ----------
    source : str or path
        The file, "-" for standard input.

    Returns
    -------
    Result or FunctionGenerators
        What wrote the file, with all that it gave but what concerns the search alone: `fits`,
        `points` and `causes` are empty.  The task and the dimensions of its linkages are read, and
        the linkages judged anew.  Where the file says something else of one, or one cannot be used,
        a warning W244 says so.

    Raises
    ------
    InputError
        E101 (not readable), E109 (not JSON), E150 (not of a synthesis, or no part of it that is
        needed), and what `read_task` raises of its poses.

    Examples
    --------
    >>> import burmester, tempfile
    >>> result = burmester.synthesize(burmester.read_task("case:motiongen-shoulder"))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     again = burmester.read_result(result.save(f"{folder}/shoulder.json"))
    >>> [linkage.id for linkage in again.usable]
    ['L1', 'L2', 'L3']
    """
    synthesis = saved.read_result(source).synthesis
    if isinstance(synthesis, Synthesis):
        return Result.of(synthesis)
    return FunctionGenerators.of(synthesis)
