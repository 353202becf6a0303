"""Exact pairs: what is found is exact, and brute force finds nothing more."""

import numpy as np
import pytest
from scipy.optimize import least_squares

from burmester.dyads.five_poses import dyads_of_five
from burmester.errors import InputError
from burmester.functions.exact_pairs import exact_generators
from burmester.functions.phase_family import best_of_phases
from burmester.geometry.displacement import Displacement
from burmester.synthesis.function_generation import generate_function
from burmester.tasks.function_task import FunctionTask
from tests.oracles import function_loops
from tests.oracles.generators import drawn


def task_of(seed, count, known):
    """Pairs that a generator makes, with the phases of it that are given."""
    one, inputs, outputs = drawn(seed, count=count)
    phases = {name: float(getattr(one, name)[0]) for name in known}
    return one, FunctionTask(inputs, outputs, **phases)


CASES = [
    (5, ()),
    (4, ("input_phase",)),
    (4, ("output_phase",)),
    (3, ("input_phase", "output_phase")),
]


@pytest.mark.parametrize(("count", "known"), CASES)
@pytest.mark.parametrize("seed", range(4))
def test_the_generator_of_the_pairs_is_among_the_solutions(seed, count, known):
    one, task = task_of(seed, count, known)
    every = exact_generators(task)
    assert every.determined
    assert len(every.generators) + every.sliders <= task.solutions
    assert np.abs(every.generators.sizes - one.sizes).max(axis=1).min() < 1e-7
    for k in range(len(every.generators)):
        g = every.generators[k]
        parameters = g.input_link, g.coupler, g.output_link, g.input_phase, g.output_phase
        miss = function_loops.residual(parameters, task.inputs, task.outputs)
        assert np.abs(miss).max() < 1e-7 * g.sizes.max()


@pytest.mark.parametrize("seed", range(2))
def test_brute_force_finds_no_more_than_five_pairs_have(seed):
    """Random starts end at what is found, or at the ground link that is always a solution."""
    _, task = task_of(seed, 5, ())
    every = exact_generators(task).generators
    rng, met = np.random.default_rng(seed), 0
    for _ in range(30):
        start = [*np.exp(rng.uniform(-1.5, 1.5, 3)), *rng.uniform(-np.pi, np.pi, 2)]
        end = least_squares(
            function_loops.residual, start, args=(task.inputs, task.outputs), xtol=1e-14, ftol=1e-14
        )
        sizes = np.abs(end.x[:3])
        if end.cost > 1e-22 or sizes.max() > 50 or min(sizes[0], sizes[2]) < 1e-3:
            continue
        met += 1
        assert np.abs(every.sizes[:, 1:] - sizes).max(axis=1).min() < 1e-4
    assert met > 1


@pytest.mark.parametrize("seed", range(8))
def test_the_cubic_has_the_dyads_of_five_poses(seed):
    """The input link held still, the pairs are poses of the output link; one dyad is the ground."""
    rng = np.random.default_rng(seed)
    _, task = task_of(seed, 5, ())
    if seed % 2:  # pairs of no linkage in particular
        task = FunctionTask(task.inputs, task.outputs + 0.3 * rng.normal(size=5))
    turn = np.exp(-1j * task.inputs)
    poses = np.stack([turn.real, turn.imag, task.outputs - task.inputs], axis=-1)
    four = dyads_of_five(Displacement.from_poses(poses))
    dyads = four.dyads[four.real]
    lengths = np.stack(
        [np.hypot(*dyads.fixed_pivot.T), dyads.radius, np.hypot(*dyads.moving_pivot.T)], axis=-1
    )
    lengths = lengths[np.abs(lengths - [0, 1, 0]).max(axis=-1) > 1e-6]
    own = exact_generators(task).generators.sizes[:, 1:]
    assert np.allclose(np.sort(own, axis=0), np.sort(lengths, axis=0), rtol=1e-6)


def test_a_parallelogram_is_not_one_linkage():
    inputs = np.linspace(0, 1, 9)
    for count in (3, 5, 9):
        with pytest.raises(InputError, match="infinitely many linkages meet these pairs"):
            generate_function(FunctionTask(inputs[:count], inputs[:count] + 0.3))


@pytest.mark.parametrize(("count", "known"), [(3, ()), (4, ()), (3, ("input_phase",))])
def test_a_grid_of_phases_has_generators_that_meet_the_pairs(count, known):
    _, task = task_of(1, count, known)
    family = best_of_phases(task)
    assert 0 < len(family.generators) <= family.working <= family.tried
    low, high = task.input_ends
    for k in range(len(family.generators)):
        one = family.generators[k]
        driven = function_loops.outputs(one, task.inputs)
        assert np.abs(np.angle(np.exp(1j * (driven - task.outputs)))).max() < 1e-6
        if known:
            turn = (float(one.input_phase) - task.input_phase) / np.pi
            assert turn == pytest.approx(round(turn))
    least = family.generators.least_transmission(low, high)
    assert (np.diff(least) <= 1e-12).all()
