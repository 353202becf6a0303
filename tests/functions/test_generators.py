"""Generators against a loop closure that is driven step by step, and against Chase and Mirth's."""

import numpy as np
import pytest

from burmester.fourbar.defects import judge
from burmester.functions.found_generator import found_generators
from burmester.functions.generator import Generator
from burmester.geometry.displacement import Displacement
from burmester.synthesis.function_generation import coupler_synthesis
from burmester.tasks.function_task import FunctionTask
from burmester.tasks.requirements import Requirements
from burmester.verdicts.judged_linkage import JudgedLinkage
from tests.oracles import function_loops, witness
from tests.oracles.generators import drawn


@pytest.mark.parametrize("seed", range(12))
def test_outputs_are_those_of_the_driven_loop(seed):
    one, inputs, outputs = drawn(seed)
    driven = function_loops.outputs(one[0], inputs)
    assert np.allclose(np.angle(np.exp(1j * (outputs - driven))), 0, atol=1e-9)


def test_a_range_without_a_dead_point_is_that_of_the_general_verdict():
    """`runs_through` and the least transmission are those of circuits and branches."""
    rng = np.random.default_rng(3)
    seen = []
    inputs = np.linspace(0, 2.0, 41)
    for _ in range(400):
        lengths, phases = np.exp(rng.uniform(-1, 1, (3, 1))), rng.uniform(-np.pi, np.pi, (2, 1))
        one = Generator(*lengths, *phases, rng.choice([-1.0, 1.0], 1))
        rows = one.coupler_poses(inputs)[0]
        if not np.isfinite(rows).all():
            assert not one.runs_through(0, 2.0)[0]
            continue
        places = Displacement(rows[None, :, :2], rows[None, :, 2])
        linkage = one.linkage()
        (verdict,) = judge(
            linkage,
            places,
            missed=np.zeros((1, 41)),
            reach=1e-6,
        )
        works = not verdict.defects and not verdict.first.defects
        assert works == one.runs_through(0, 2.0)[0]
        seen.append(works)
        if works:
            least = verdict.first.least_over_range
            assert least == pytest.approx(one.least_transmission(0, 2.0)[0], abs=1e-9)
    assert sum(seen) > 20


def test_a_linkage_that_locks_within_the_range_says_where():
    """Input link 2, coupler 1, output link 1.5: coupler and output link are in line at 2.5."""
    one = Generator(*np.array([[2.0], [1.0], [1.5], [0.5], [0.0], [1.0]]))
    inputs = np.linspace(0, 3, 4)
    task = FunctionTask(inputs, inputs**2)
    (found,) = found_generators(one, task, exact=False)
    assert not found.usable
    assert [each.code for each in found.defects] == ["assembly", "dead-point"]
    # |1 - 2 e^(i theta)| = 2.5 where the linkage is stretched: cos theta = (5 - 6.25) / 4.
    theta = np.degrees(np.arccos(-1.25 / 4) - 0.5)
    assert f"{theta:.1f} deg" in found.defects[1].message
    assert np.isfinite(function_loops.pins(2, 1, 1.5, np.radians(theta) + 0.5 - 1e-6)[0])
    assert np.isnan(function_loops.pins(2, 1, 1.5, np.radians(theta) + 0.5 + 1e-6)[0])


def test_pairs_on_two_branches_are_told():
    one, inputs, outputs = drawn(2)
    other = Generator(*(getattr(one, n) for n in Generator.__match_args__[:-1]), -one.side)
    outputs = outputs.copy()
    outputs[2] = other.outputs(inputs)[0, 2]
    (found,) = found_generators(one, FunctionTask(inputs, outputs), exact=True)
    assert [each.message for each in found.defects] == ["meets pair 3 on another branch"]


def test_what_a_generator_does_not_keep_stands_beside_its_defects():
    """As of every linkage that is judged: it has none of its own where it does what is wanted."""
    one, inputs, outputs = drawn(1)
    asked = Requirements(transmission_deg=89.9, types=frozenset({"change-point", "double-crank"}))
    (free,) = found_generators(one, FunctionTask(inputs, outputs), exact=True)
    (found,) = found_generators(one, FunctionTask(inputs, outputs, requirements=asked), exact=True)
    assert isinstance(found, JudgedLinkage)
    assert free.usable
    assert (found.usable, found.defects) == (False, ())
    assert [each.kind for each in found.faults] == ["transmission", "type"]
    assert found.type in found.violations[1].message
    assert found.faults == found.violations


@pytest.mark.parametrize("seed", range(3))
def test_the_coupler_passes_its_places_as_the_input_link_drives(seed):
    """What report and export get: judged by the general code, driven joint by joint."""
    one, inputs, outputs = drawn(seed)
    task = FunctionTask(inputs, outputs, ground=40.0)
    (found,) = found_generators(one, task, exact=True)
    judged = coupler_synthesis(found)
    best = judged.linkages[0]
    assert best.usable
    assert best.driver == "first"
    assert best.driven.least_over_range == pytest.approx(found.least_transmission, abs=1e-6)
    assert witness.misses(best.linkage, judged.task.poses, 40.0).max() < 1e-5


@pytest.mark.parametrize("phases_only", [True, False])
def test_generators_that_lie_apart_are_those_that_one_by_one_are_near_no_earlier_one(phases_only):
    rng = np.random.default_rng(3)
    sizes = np.exp(rng.uniform(-0.4, 0.4, (3, 60)))
    phases = rng.choice([0.0, 0.2, 3.1, -3.1], (2, 60)) + rng.uniform(0, 0.1, (2, 60))
    every = Generator(*sizes, *phases, rng.choice([1.0, -1.0], 60))
    kept = []
    for k in range(60):
        for j in kept:
            near = [abs(np.angle(np.exp(1j * (p[k] - p[j])))) <= 0.25 for p in phases]
            if not phases_only:
                near += [abs(np.log(s[k] / s[j])) <= 0.25 for s in sizes]
                near.append(every.side[k] == every.side[j])
            if all(near):
                break
        else:
            kept.append(k)
    assert 3 < len(kept) < 60
    for most in (60, 3):
        found = every.first_apart(0.25, most, phases_only=phases_only)
        assert found.tolist() == kept[:most]
