"""The cognates of a linkage in words: the other linkages that trace the same curve."""

from __future__ import annotations

import numpy as np

from burmester.describe.dimensions import decimals_of, fixed
from burmester.fourbar.cognates import cognates
from burmester.fourbar.dyad import RR
from burmester.fourbar.linkage import Linkage
from burmester.synthesis.result import Synthesis
from burmester.tasks.motion_task import Task
from burmester.verdicts.found_linkage import FoundLinkage


def cognates_of(found: FoundLinkage, task: Task) -> tuple[Linkage, ...]:
    """The other linkages whose coupler point traces the same curve, the driver's first.

    None where some pose has an angle that counts: a cognate's body turns in another way.  None,
    either, where a link would have no length.
    """
    if task.tolerances is None or not task.tolerances.free[:, 2].all():
        return ()
    return tuple(
        each
        for each in cognates(found.driver_first)
        if isinstance(each.first, RR)
        and np.isfinite(each.first.radius)
        and float(each.first.radius) > 0
    )


def cognate_lines(synthesis: Synthesis, found: FoundLinkage) -> list[str]:
    """Each cognate in a line, with all that it is built from."""
    digits = decimals_of(synthesis, found).lengths

    def link(dyad: RR) -> str:
        x, y = (fixed(float(each), digits) for each in dyad.fixed_pivot)
        arm = fixed(float(np.linalg.norm(dyad.moving_pivot)), digits)
        length = fixed(float(dyad.radius), digits)
        return f"fixed pivot ({x}, {y}), link {length}, its pin {arm} from the coupler point"

    lines = []
    for each in cognates_of(found, synthesis.task):
        links = each.links
        if not (isinstance(each.first, RR) and isinstance(each.second, RR)) or links is None:
            continue
        lines.append(
            f"a {each.type}: {link(each.first)}; {link(each.second)}; coupler "
            f"{fixed(float(links.coupler), digits)}"
        )
    return lines
