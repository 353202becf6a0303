"""What is said of linkages beside their errors: ties, drivers, uncertainty, sizes."""

import numpy as np
import pytest

from burmester import synthesize
from burmester.fourbar.circuits import Circuits
from burmester.fourbar.dyad import PR, RR
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.fourbar.pose_error import error_frames
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import box
from burmester.tasks.limits import Limits
from burmester.tasks.motion_task import Task
from burmester.tasks.requirements import Requirements
from burmester.verdicts.uncertainty import covariance, pose_sigma, uncertainties
from tests.oracles.witness import misses, random_four_bar, random_poses, span
from tests.samples import samples

FREE = Requirements(any_order=True)


def four_bar(ground, crank, coupler, follower):
    return Linkage(RR([0, 0], [0, 0], crank), RR([ground, 0], [coupler, 0], follower))


def told(linkage, decimals, first=0.4, last=2.2, count=9):
    """The linkage that comes nearest to poses of another, given with so many decimals."""
    place = Circuits.of(linkage, as_given=True)[0].couplers(np.linspace(first, last, count))
    rows = np.column_stack([place.translation, place.angle]).round(decimals)
    resolution = (0.5 * 10.0**-decimals,) * 2
    result = synthesize(Task(Displacement.from_poses(rows), resolution=resolution))
    return min(result.linkages, key=lambda each: each.error.worst)


def test_the_type_is_that_of_the_dimensions_and_the_digits_leave_others_open():
    # Shortest and longest link exceed the others by 1e-3.
    lengths = np.array([3.0, 1.0, 2.3, 1.7 - 1e-3])
    sharp = told(four_bar(*lengths), 9)
    assert (sharp.type, sharp.other_types) == ("triple-rocker", ())
    blunt = told(four_bar(*lengths), 3)
    assert blunt.type == blunt.driver_first.type != "change-point"
    assert {blunt.type, *blunt.other_types} == {"triple-rocker", "crank-rocker"}
    clear = told(four_bar(3.0, 1.0, 2.3, 1.9), 5)
    assert (clear.type, clear.other_types) == ("crank-rocker", ())


@pytest.mark.parametrize("unit", [1e-3, 1.0, 1e3])
def test_the_other_types_do_not_depend_on_the_unit(unit):
    linkage = four_bar(3.0, 1.0, 2.3, 1.7 - 5e-3)
    place = Circuits.of(linkage, as_given=True)[0].couplers(np.linspace(0.4, 2.2, 9))
    rows = np.column_stack([place.translation, place.angle]).round(4) * [unit, unit, 1]
    for digit, others in ((5e-5, ()), (2e-3, ("crank-rocker",))):
        task = Task(Displacement.from_poses(rows), resolution=(digit * unit, digit))
        best = min(synthesize(task).linkages, key=lambda each: each.error.worst)
        assert (best.type, best.other_types) == ("triple-rocker", others)


def test_a_change_point_is_an_exact_equality():
    tied = told(four_bar(3.0, 1.0, 2.3, 1.7), 15, count=7)
    assert (tied.type, tied.other_types) == ("change-point", ())


def test_the_other_types_are_named_from_the_driver_that_is_preferred():
    """Whichever of two limits the short link has; it is the better driver."""
    linkage = four_bar(3.0, 1.0, 2.3, 1.7 - 1e-3)
    place = Circuits.of(linkage, as_given=True)[0].couplers(np.linspace(0.4, 2.2, 9))
    rows = np.column_stack([place.translation, place.angle]).round(3)
    near = [
        Limits(moving_pivot=box((-0.5, -1), (0.5, 1))),
        Limits(moving_pivot=box((1.5, -1), (3, 1))),
    ]
    drivers = set()
    for limits in (near, near[::-1]):
        task = Task(Displacement.from_poses(rows), resolution=(5e-4, 5e-4), limits=tuple(limits))
        found = synthesize(task).linkages[0]
        drivers.add(found.preferred_driver)
        assert found.driver_first.links.driver == min(found.linkage.links)
        assert {found.type, *found.other_types} == {"triple-rocker", "crank-rocker"}
    assert drivers == {"first", "second"}


def test_a_type_that_is_required_is_that_of_the_dimensions():
    linkage = four_bar(3.0, 1.0, 2.3, 1.7 - 1e-3)
    place = Circuits.of(linkage, as_given=True)[0].couplers(np.linspace(0.4, 2.2, 9))
    rows = np.column_stack([place.translation, place.angle]).round(3)
    every = {"triple-rocker", "crank-rocker"}
    for allowed in every:
        task = Task(
            Displacement.from_poses(rows),
            resolution=(5e-4, 5e-4),
            requirements=Requirements(types=frozenset({allowed})),
        )
        for found in synthesize(task).linkages:
            wrong = [each for each in found.violations if each.kind == "type"]
            assert bool(wrong) == (found.driver_first.type != allowed)
            assert all(found.driver_first.type in each.message for each in wrong)


def test_uncertainty_stands_with_the_dyad_that_it_is_of():
    """Whichever dyad comes first: against the covariance of the linkage as it is listed."""
    rng = np.random.default_rng(5)
    swapped = 0
    for second in (RR, RR, PR, PR):
        rows = random_poses(random_four_bar(rng, second), rng, 9, ordered=True)
        rows = rows + rng.normal(scale=1e-4, size=rows.shape)
        task = Task(Displacement.from_poses(rows), resolution=(1e-4, 1e-4))
        result = synthesize(task)
        frames = error_frames(task.poses, result.length_per_radian)
        unit = float(frames.length)
        for found in result.linkages[:4]:
            batch = LinkageBatch.of([found.linkage]).to_canonical(frames)
            places = frames.to_canonical(found.error.places)[None]
            position, angle = pose_sigma(task)
            length = result.length_per_radian / unit
            spread = covariance(batch, places, length, (position / unit, angle))
            for mine, wanted in zip(
                found.uncertainty, uncertainties(spread, batch, places, unit)[0], strict=True
            ):
                assert mine.half_width == pytest.approx(wanted.half_width, rel=1e-3)
                assert (mine.fixed is None) == (wanted.fixed is None)
            ids = [dyad.id for dyad in found.dyads]
            swapped += ids != sorted(ids)
    assert swapped


def test_a_pose_beyond_reach_is_no_pose_met():
    """By a tenth of the motion's size, or by what is asked."""
    place = Circuits.of(four_bar(3.0, 1.0, 2.5, 2.2))[0].couplers(np.linspace(0.5, 2.5, 8))
    rows = np.column_stack([place.translation, place.angle])
    rows[3, :2] += [0.35, -0.3]
    wild = Task(Displacement.from_poses(rows), requirements=FREE)
    result = synthesize(wild)
    length = result.length_per_radian
    size = error_frames(wild.poses, length).length
    for found in result.linkages:
        missed = np.maximum(found.error.position, length * found.error.angle)
        far = {k for k in range(8) if missed[k] > 0.1 * size}
        said = {k for each in found.verdict.defects if each.kind == "assembly" for k in each.poses}
        assert said == far
        # The witness comes no nearer than is said.
        assert (misses(found.linkage, wild.poses, length) > missed * (1 - 0.06) - 1e-9).all()
    near = min(found.error.worst for found in result.linkages)
    asked = Requirements(any_order=True, within=near / 2)
    strict = synthesize(Task(wild.poses, requirements=asked))
    for found in strict.linkages:
        assert found.usable == (found.error.worst <= near / 2 and not found.defects)


@pytest.mark.parametrize("share", [0.5, 0.99, 1.01])
def test_a_pose_is_met_where_both_errors_are_within_their_bounds(share):
    place = Circuits.of(four_bar(3.0, 1.0, 2.5, 2.2))[0].couplers(np.linspace(0.5, 2.5, 8))
    noise = np.random.default_rng(8).normal(scale=0.02, size=(8, 3))
    rows = np.column_stack([place.translation, place.angle]) + noise
    poses = Displacement.from_poses(rows)

    def usable(**bounds):
        """The first two dyads' linkage, under other bounds: whether it works."""
        asked = Requirements(any_order=True, **bounds)
        every = synthesize(Task(poses, requirements=asked)).linkages
        # Of failing linkages of a pair the closest is kept, which may be one of the search.
        return any(e.usable for e in every if not e.from_search and same_pair(e, plain))

    free = synthesize(Task(poses, requirements=Requirements(any_order=True)))
    plain = next(e for e in free.usable if not e.from_search)
    far, turned = plain.error.worst, float(plain.error.angle.max())
    length = free.length_per_radian
    assert usable(within=share * far, within_deg=179) == (share > 1)
    assert usable(within=100 * far, within_deg=share * np.degrees(turned)) == (share > 1)
    # An angle that is not bounded may err by as much as counts the same.
    least = max(far, length * turned)
    assert usable(within=share * least) == (share > 1)


def same_pair(one, other):
    return {dyad.id for dyad in one.dyads} == {dyad.id for dyad in other.dyads}


def test_the_driver_of_the_second_limits_drives():
    """Two limits keep their order in the linkage; which dyad drives is said beside."""
    crank_rocker = four_bar(3.0, 1.0, 2.5, 2.2)
    rocker = Circuits.of(Linkage(crank_rocker.second, crank_rocker.first))
    place = rocker[0].couplers(np.linspace(0.5, 2.5, 8))
    limits = Limits(box((2, -1), (4, 1))), Limits(box((-1, -1), (1, 1)))
    for driver, turns in (("first", False), ("second", True)):
        asked = Requirements(driver=driver)
        result = synthesize(Task(place, limits=limits, requirements=asked))
        best = result.linkages[0]
        assert [dyad.limits for dyad in best.dyads] == [1, 2]
        assert best.usable
        assert best.driver == driver
        assert best.driven.turns_fully == turns
        lead = best.driver_first.first
        assert np.allclose(lead.fixed_pivot, [0, 0] if turns else [3, 0], atol=1e-6)


@pytest.mark.parametrize("seed", samples(25, 10))
def test_no_link_is_a_point_and_no_linkage_comes_twice(seed):
    rng = np.random.default_rng([seed, 77])
    rows = random_poses(random_four_bar(rng), rng, int(rng.integers(5, 9)))
    if seed % 2:
        rows = rows + rng.normal(scale=0.1, size=rows.shape)
    result = synthesize(Task(Displacement.from_poses(rows), requirements=FREE))
    seen = []
    for found in result.linkages:
        links = found.linkage.links
        if links is not None:
            assert min(float(links.ground), float(links.coupler)) > 1e-6 * span(rows)
            key = np.sort([float(length) for length in links])
            assert not any(np.allclose(key, other, rtol=1e-7) for other in seen)
            seen.append(key)
