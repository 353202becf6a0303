"""What a linkage does with the tolerances of poses, in words."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.defects import Verdict
from burmester.numerics.arrays import FloatArray
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import pose_labels
from burmester.tasks.pose_tolerances import COMPONENTS
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.wording import figure, listed

SHARE_DIGITS = 6  # decimals by which shares are compared: of equal ones the first is named
MAX_NAMED = 3  # number of poses that a reason names; more are counted


def in_words_of_tolerances(verdict: Verdict, shares: FloatArray, names: Sequence[str]) -> Verdict:
    """The verdict, its assembly defects said by the tolerances that are exceeded.

    shares: (N, 3), of the tolerances that are used; names: of the poses.
    """
    defects = tuple(
        replace(each, message=outside(each.poses, shares, names))
        if each.kind == "assembly" and np.isfinite(shares[list(each.poses)]).all()
        else each
        for each in verdict.defects
    )
    return Verdict(defects, verdict.first, verdict.second)


def outside(poses: Sequence[int], shares: FloatArray, names: Sequence[str]) -> str:
    """Of which poses tolerances are exceeded, the most exceeded one by how much.

    shares: (N, 3), of the tolerances that are used; names: of all poses.
    """
    shares = np.round(shares, SHARE_DIGITS)
    poses = sorted(poses, key=lambda pose: -shares[pose].max())
    worst, component = poses[0], int(shares[poses[0]].argmax())
    text = f"outside the tolerance of pose {names[worst]} ({COMPONENTS[component]} is off by "
    text += f"{figure(float(shares[worst, component]))} times its tolerance)"
    if not (others := [names[pose] for pose in sorted(poses[1:])]):
        return text
    if len(others) > MAX_NAMED:
        return f"{text}, and of {len(others)} more"
    return f"{text}, and of pose{'s' * (len(others) > 1)} {listed(others)}"


def most_used(found: FoundLinkage, task: Task) -> str:
    """How much of the tolerances a linkage uses: "at most 83 % (x at pose 3)"."""
    assert found.within_tolerance is not None
    shares = np.where(_exact(task), 0.0, found.within_tolerance)
    most = int(np.round(shares, SHARE_DIGITS).argmax())
    pose, component = np.unravel_index(most, shares.shape)
    noun = "point" if task.free_angles[pose] else "pose"
    at = f"{noun} {pose_labels(task, [int(pose)])[0]}"
    return f"at most {percent(float(shares.max()))} ({COMPONENTS[component]} at {at})"


def share_texts(found: FoundLinkage, task: Task) -> list[tuple[str, str, str]]:
    """What each pose uses of its tolerances, x, y and angle: "83 %", "exact", "free"."""
    assert found.within_tolerance is not None
    assert task.tolerances is not None
    free, exact = task.tolerances.free, _exact(task)
    out = []
    for k, shares in enumerate(found.within_tolerance.tolist()):
        x, y, angle = (
            "free" if free[k, c] else "exact" if exact[k, c] and share <= 1 else percent(share)
            for c, share in enumerate(shares)
        )
        out.append((x, y, angle))
    return out


def percent(share: float) -> str:
    """A share in per cent, rounded up, so that 100 % is inside and 101 % is not."""
    if not math.isfinite(share):
        return "-"
    whole = math.ceil(100 * share - 1e-6)
    return f"{whole} %" if whole < 1000 else f"{figure(share)} times"


def _exact(task: Task) -> NDArray[np.bool_]:
    assert task.tolerances is not None
    return task.tolerances.exact
