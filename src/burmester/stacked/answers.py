"""The answers of many tasks as flat columns: a row for each dyad and for each linkage."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import ClassVar, Literal, TypeAlias, final, get_args

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.linkage import TYPES
from burmester.numerics.arrays import FloatArray, concatenate

Codes = NDArray[np.int8]
Indices = NDArray[np.intp]

Depth: TypeAlias = Literal["pencil", "dyads", "linkages"]
# "exact" dyads meet five poses; "locally best" ones are minima of the distance, those of the
# "pencil" minima in it; "nearest" ones stand beside exact ones that are too few; those "of the
# motion" are told by a special motion without a fit.
Status: TypeAlias = Literal["pencil", "exact", "locally best", "nearest", "of the motion"]
# A task is "solved" where two dyads were found, at linkages where one of them is usable.
Outcome: TypeAlias = Literal[
    "solved",
    "none usable",
    "too few dyads",
    "infinitely many",
    "special motion",
    "not determined",
    "not at this depth",
    "refused",
]


@final
@dataclass(frozen=True, slots=True, eq=False)
class DyadRows:
    """Dyads (D,) of many tasks, those of one task together, in the order of `Synthesis.dyads`.

    Numbers are in the task's own frames and unit; angles of the table are in degrees, as in the
    JSON of a synthesis.  What a kind of dyad does not have is nan.

    Attributes
    ----------
    task : (D,) array of int
        The index of the task in its stack.
    kind, status : (D,) arrays of int
        In `KINDS` and `STATUSES`.
    fixed, moving : (D, 2) arrays of float
        The pivots: in F, and in M.
    length : (D,) array of float
        Of the link of an RR dyad.
    point : (D, 2) array of float
        A slider's line by the middle of the stretch that the poses use: in F for PR, in M for RP.
    direction_deg, normal_deg, offset : (D,) arrays of float
        The direction of that line, the direction of its normal, and its distance from the origin.
    angle_deg : (D,) array of float
        The constant angle of a PP dyad.
    rms, worst : (D,) arrays of float
        The distance from the poses; radians for PP.
    """

    KINDS: ClassVar[tuple[str, ...]] = ("RR", "PR", "RP", "PP")
    STATUSES: ClassVar[tuple[Status, ...]] = get_args(Status)

    task: Indices
    kind: Codes
    fixed: FloatArray
    moving: FloatArray
    length: FloatArray
    point: FloatArray
    direction_deg: FloatArray
    normal_deg: FloatArray
    offset: FloatArray
    angle_deg: FloatArray
    rms: FloatArray
    worst: FloatArray
    status: Codes

    @classmethod
    def blank(cls, count: int) -> DyadRows:
        """Rows with every number nan."""
        index, code = np.zeros(count, dtype=np.intp), np.zeros(count, dtype=np.int8)
        one, two = np.full(count, np.nan), np.full((count, 2), np.nan)
        fixed, moving, point = (two.copy() for _ in range(3))
        direction, normal, offset, angle, rms, worst = (one.copy() for _ in range(6))
        line = point, direction, normal, offset
        return cls(index, code, fixed, moving, one, *line, angle, rms, worst, code.copy())

    def __len__(self) -> int:
        return len(self.task)


@final
@dataclass(frozen=True, slots=True, eq=False)
class LinkageRows:
    """Linkages (L,) of many tasks: pairs of their dyads, not refined, in the order of `ranking`.

    Attributes
    ----------
    task : (L,) array of int
        The index of the task in its stack.
    first, second : (L,) arrays of int
        Their dyads, by the place (from 0) among those of the task; the first one drives.
    rms, worst : (L,) arrays of float
        The position error at the poses; infinite where a pose is out of reach.
    angle_rms_deg, angle_worst_deg : (L,) arrays of float
        The angle error, likewise.
    combined : (L,) array of float
        Both in one, as `FoundLinkage.combined_error`.
    verdict, type : (L,) arrays of int
        In `VERDICTS` (a linkage that is not usable has the kind of its first defect) and `TYPES`.
    transmission_deg, extent, sensitivity : (L,) arrays of float
        As `Quality` has them; nan where the error is infinite.
    """

    VERDICTS: ClassVar[tuple[str, ...]] = (
        *("usable", "assembly", "circuit", "branch", "order", "degenerate"),
    )
    TYPES: ClassVar[tuple[str, ...]] = TYPES

    task: Indices
    first: Indices
    second: Indices
    rms: FloatArray
    worst: FloatArray
    angle_rms_deg: FloatArray
    angle_worst_deg: FloatArray
    combined: FloatArray
    verdict: Codes
    type: Codes
    transmission_deg: FloatArray
    extent: FloatArray
    sensitivity: FloatArray

    @classmethod
    def blank(cls, count: int) -> LinkageRows:
        """Rows with every number nan."""
        task, first, second = (np.zeros(count, dtype=np.intp) for _ in range(3))
        verdict, kind = (np.zeros(count, dtype=np.int8) for _ in range(2))
        rms, worst, turn, turned, both = (np.full(count, np.nan) for _ in range(5))
        quality = (np.full(count, np.nan) for _ in range(3))
        return cls(task, first, second, rms, worst, turn, turned, both, verdict, kind, *quality)

    def __len__(self) -> int:
        return len(self.task)


@final
@dataclass(frozen=True, slots=True, eq=False)
class StackedAnswers:
    """What came of the tasks (T,) of a stack.

    Attributes
    ----------
    dyads : DyadRows
        Of all tasks, rows by rising task.
    linkages : LinkageRows or None
        The same of linkages, where the depth goes to them.
    outcome : (T,) array of int
        In `OUTCOMES`.
    code : (T,) array of str
        The code of the page that says more (`burmester explain`): of the outcome as the road of
        one task has it, or of the error where the task was refused.
    warnings : tuple of (int, str)
        A task and the code of a warning, by rising task.
    """

    OUTCOMES: ClassVar[tuple[Outcome, ...]] = get_args(Outcome)

    dyads: DyadRows
    linkages: LinkageRows | None
    outcome: Codes
    code: NDArray[np.str_]
    warnings: tuple[tuple[int, str], ...] = ()


def joined(answers: Sequence[StackedAnswers]) -> StackedAnswers:
    """The answers of stacks one after the other as those of one stack."""
    counts = [len(each.outcome) for each in answers]
    starts = np.cumsum([0, *counts[:-1]]).tolist()
    moved = [
        replace(
            each,
            dyads=replace(each.dyads, task=each.dyads.task + start),
            linkages=None
            if each.linkages is None
            else replace(each.linkages, task=each.linkages.task + start),
            warnings=(),
        )
        for each, start in zip(answers, starts, strict=True)
    ]
    warnings = tuple(
        (task + start, code)
        for each, start in zip(answers, starts, strict=True)
        for task, code in each.warnings
    )
    return replace(concatenate(moved), warnings=warnings)
