"""A sample of `benchmarks/search_witness.py`: tasks in which an independent search was nearer once.

What went wrong in them before: there were two starts within the limits (11), the closest linkage of
pairs of dyads was taken though others are closer (23), a descent ended at a corner of a box (30),
only one locally best dyad lies within the limits (50).  In five poses of a slider-crank with noise
the points that stay closest together are far away, and so was all that a search started from.
"""

from dataclasses import replace

import numpy as np
import pytest
from benchmarks.planted_limits import planted
from benchmarks.search_witness import WORSE, compared, ratio_of, task_of

from burmester import PR, RR, Displacement, Task, judge
from burmester.geometry.regions import box
from burmester.linkages.from_dyads import linkages_from_dyads
from burmester.synthesis.dyad_search import search_dyads, with_method
from burmester.synthesis.motion_generation import synthesize
from burmester.synthesis.outcome import summary
from burmester.tasks.limits import Limits
from burmester.tasks.motion_class import classify_motion
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.problem import SynthesisProblem
from burmester.tasks.requirements import Requirements
from tests.oracles import multi_start
from tests.oracles.common_tasks import TRANSMISSION, common_task
from tests.oracles.hard_tasks import comes_by
from tests.samples import samples, some_of


@pytest.mark.parametrize("seed", some_of([11, 23, 30, 50], 2))
def test_an_independent_search_is_not_nearer(seed, monkeypatch):
    monkeypatch.setattr(multi_start, "FIRST", (30, 40))
    monkeypatch.setattr(multi_start, "SECOND", (6, 200))
    _, ours, theirs, _, wrong = compared(seed)
    assert not wrong
    assert np.isfinite(theirs)
    assert ratio_of(ours, theirs) < WORSE


def test_one_dyad_within_the_limits_does_not_mean_that_there_is_no_linkage():
    """All but the best dyad of a task taken away, there are linkages nevertheless."""
    task = task_of(common_task(50))
    problem = SynthesisProblem.of(task, classify_motion(task), SynthesisOptions())
    problem = with_method(problem)
    search = search_dyads(problem)
    alone = replace(search, dyads=search.dyads[:1])
    assert alone.pairs(problem.length) == ([], [])
    found = linkages_from_dyads(problem, [])
    assert found[0].usable
    assert all(dyad.id.startswith("M") for each in found for dyad in each.dyads)
    assert comes_by(found[0], TRANSMISSION)
    told = summary(problem, alone, found)
    assert told.code == "R300"
    assert "from links of low error beside 1 locally best dyad within the limits" in told.message
    assert linkages_from_dyads(problem, [], refine=False) == ()


@pytest.mark.parametrize("seed", [0, 25])
def test_what_works_is_as_near_as_the_slider_crank_behind_the_poses(seed):
    rng = np.random.default_rng([77, seed])
    length, height = rng.uniform(2.2, 3.5), rng.uniform(-0.4, 0.4)
    crank = np.exp(1j * np.sort(rng.uniform(0.2, 2.6, 5)))
    rod = np.sqrt(length**2 - (crank.imag - height) ** 2) + 1j * (height - crank.imag)
    pin = complex(*rng.normal(size=2))
    at = crank - rod / abs(rod) * pin
    rows = np.column_stack([at.real, at.imag, np.angle(rod)])
    rows += rng.normal(size=rows.shape) * [2e-3, 2e-3, 1e-3]
    task = Task(Displacement.from_poses(rows))
    behind = (
        RR([0, 0], [pin.real, pin.imag], 1),
        PR(np.pi / 2, height, [pin.real + length, pin.imag]),
    )
    known = judge(task, list(behind)).linkages[0]
    best = min(synthesize(task).usable, key=lambda each: each.combined_error)
    assert known.usable
    assert comes_by(best)
    assert best.combined_error < {0: 0.25, 25: 1.0}[seed] * known.combined_error


# Fewer than two locally best dyads keep to these boxes, far away from the motion.
FAR_BOXES = [
    (1351.752253849, 117.837819638, 51.557690805),
    (1390.998776673, 173.963309951, 41.635598247),
    (1428.147361426, 200.228629693, 34.476387853),
    (1520.737074753, 211.153926570, 20.870816686),
    (1604.569499625, 178.224640299, 369.876304638),
    (1660.855279346, 143.809884032, 363.231329948),
]


def test_linkages_are_found_in_boxes_far_from_the_motion():
    """A linkage with links of 4.9 m and 4.7 m is known, within 2.67 mm and with 55.3 degrees."""
    limits = Limits(
        fixed_pivot=box((-1743.034670691, 2170.684992127), (458.262814256, 3901.696091747)),
        moving_pivot=box((-333.997406547, -1116.941547304), (199.091754857, -949.701787508)),
        length=(2820.178309225, 7382.534017065),
        kinds=frozenset({"RR"}),
    )
    asked = Requirements(transmission_deg=52.075597, within=9.315579232)
    task = Task.from_rows(FAR_BOXES, angle_unit="deg", length_unit="mm")
    exact = np.array([False, True, False, True, False, False])
    task = replace(task, exact=exact, limits=(limits,), requirements=asked)
    problem = SynthesisProblem.of(task, classify_motion(task), SynthesisOptions())
    best = linkages_from_dyads(with_method(problem), [])[0]
    assert best.usable
    assert best.error.worst < 2.67
    assert best.error.position[exact].max() < 1e-6
    assert comes_by(best, np.radians(asked.transmission_deg) - 1e-6)
    for dyad in (best.linkage.first, best.linkage.second):
        x, y = dyad.fixed_pivot
        u, v = dyad.moving_pivot
        assert -1743.1 < x < 458.3
        assert 2170.6 < y < 3901.7
        assert -334 < u < 199.1
        assert -1117 < v < -949.7
        assert 2820.1 < dyad.radius < 7382.6


@pytest.mark.parametrize("number", [22, *samples(30, 0)])
def test_a_planted_linkage_means_that_one_is_found(number):
    """A sample of `python -m benchmarks.planted_limits`, without the dyads: the search alone."""
    if (one := planted(0, number)) is None or not one[0].limits:
        pytest.skip("the linkage drawn does not keep to what was drawn around it")
    problem = SynthesisProblem.of(one[0], classify_motion(one[0]), SynthesisOptions())
    best = linkages_from_dyads(with_method(problem), [])[0]
    assert best.usable
    assert comes_by(best, one[0].requirements.transmission - 1e-6)
