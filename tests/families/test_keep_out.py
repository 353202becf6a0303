"""Linkages of a family that stay clear of a post on the best one's way."""

from __future__ import annotations

import numpy as np
import pytest

from burmester import KeepOut, Surroundings, Task, box, synthesize
from burmester.verdicts.found_linkage import FoundLinkage
from tests.oracles.clearance_sweep import Moved, sweep

ROWS = [(0, 0, 0), (160, 60, 60)]
BODY = box([-20, -15], [60, 15])
WIDTH, MARGIN = 12.0, 3.0


def swept(found: FoundLinkage, region: np.ndarray) -> float:
    """The least distance from a region between the poses, driven by the witness."""
    led, inputs = found.driver_first, found.driven.inputs
    drive = np.linspace(inputs.min(), inputs.max(), 4001)
    start = found.error.places[int(inputs.argmin())]
    both = [Moved(led.first, led.second, drive, side) for side in (0, 1)]
    moved = min(
        both,
        key=lambda each: abs(np.exp(1j * each.phi[0]) - np.exp(1j * float(start.angle))),
    )
    assert abs(moved.d[0] - complex(*start.translation)) < 1e-3
    return float(sweep(moved, BODY.vertices, [region], WIDTH).min())


def test_all_that_is_usable_stays_clear_of_a_post_that_the_best_one_hits() -> None:
    free = synthesize(Task.from_rows(ROWS, angle_unit="deg", body=BODY))
    best = free.linkages[0]
    at = np.array([105.0, 20.0])
    post = box(at - 8, at + 8)
    assert swept(best, post.vertices) == 0
    around = Surroundings(KeepOut(post, "post"), link_width=WIDTH, margin=MARGIN)
    task = Task.from_rows(ROWS, angle_unit="deg", body=BODY, surroundings=around)
    found = synthesize(task)
    usable = [each for each in found.linkages if each.usable]
    assert len(usable) > 3
    for each in usable:
        assert each.clearance is not None
        least = swept(each, post.vertices)
        assert least >= MARGIN - 1e-3
        assert each.clearance.least == pytest.approx(least, abs=0.02)
