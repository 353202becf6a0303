"""Tolerances of poses: what a box is, along which axes, and what contradicts itself."""

import numpy as np
import pytest

from burmester.errors import InputError
from burmester.geometry.displacement import Displacement
from burmester.tasks.motion_task import Task
from burmester.tasks.pose_tolerances import COMPONENTS, PoseTolerances, nominal_values

INF = np.inf
ROWS = [(0, 0, 0), (4, 1, 30), (7, 3, 55), (9, 6, 90)]


def refused(*parts, **named):
    with pytest.raises(InputError) as caught:
        PoseTolerances(*parts, **named)
    return caught.value


def refused_task(tolerances, rows=ROWS, **named):
    poses = Displacement.from_poses([(x, y, np.radians(a)) for x, y, a in rows])
    with pytest.raises(InputError) as caught:
        Task(poses, tolerances=tolerances, **named)
    return caught.value


def inside(box, axes, place, pose):
    """Whether a place is in the box of a pose, by rotating the gap with complex numbers."""
    gap = complex(place[0] - pose[0], place[1] - pose[1])
    if axes == "body":
        gap *= np.exp(-1j * pose[2])
    turn = abs(np.angle(np.exp(1j * (place[2] - pose[2]))))
    return abs(gap.real) <= box[0] and abs(gap.imag) <= box[1] and turn <= box[2]


@pytest.mark.parametrize("seed", range(4))
def test_shares_say_what_is_inside_along_either_axes(seed):
    rng = np.random.default_rng(seed)
    count = 60
    bounds = rng.choice([0.2, 1.0, 3.0, INF], size=(count, 3))
    bounds[:, 0] = rng.choice([0.2, 1.0], size=count)  # never free in all
    axes = rng.choice(["fixed", "body"], size=count)
    axes[np.isinf(bounds[:, 2])] = "fixed"
    poses = np.column_stack([rng.normal(size=(count, 2)), rng.uniform(-9, 9, size=count)])
    places = poses + rng.normal(size=(count, 3)) * [0.7, 0.7, 1.5]
    tolerances = PoseTolerances(bounds[:, :2], bounds[:, 2], tuple(axes.tolist()))
    share = tolerances.share(
        Displacement.from_poses(places), Displacement.from_poses(poses), [1e-9, 1e-9, 1e-9]
    )
    expected = [inside(b, a, p, q) for b, a, p, q in zip(bounds, axes, places, poses, strict=True)]
    assert (share <= 1).all(axis=1).tolist() == expected
    assert 5 < sum(expected) < count - 5
    assert (share[np.isinf(bounds)] == 0).all()


def test_exact_components_are_measured_by_rounding():
    tolerances = PoseTolerances([[0, 2]], [0.1])
    pose, place = Displacement.from_poses([(0, 0, 0)]), Displacement.from_poses([(1e-6, 1, 0.05)])
    assert tolerances.share(place, pose, [1e-5, 1e-5, 1e-5])[0] == pytest.approx([0.1, 0.5, 0.5])


def test_half_a_turn_is_free_and_next_to_nothing_is_exact():
    tolerances = PoseTolerances([[1, 1e-80], [1, 1]], [np.pi, 3.14])
    assert tolerances.free.tolist() == [[False, False, True], [False] * 3]
    assert tolerances.exact.tolist() == [[False, True, False], [False] * 3]


def test_conditions_are_those_that_a_place_on_the_way_cannot_meet():
    bounds = [([0, 0], 0), ([0, 0], INF), ([0, 1], 2), ([1, 1], 1), ([INF, INF], 0)]
    tolerances = PoseTolerances([p for p, _ in bounds], [a for _, a in bounds])
    assert tolerances.conditions == 2 + 1 + 0 + 0 + 0


MALFORMED = {
    "negative": (([[0, -1], [0, 0]], [0, 0]), {}, "E135", "pose 1: a tolerance of -1 for y"),
    "nan": (([[0, 0], [0, 0]], [0, np.nan]), {}, "E135", "pose 2: a tolerance of nan for angle"),
    "lengths": (([[0, 0]], [0, 0]), {}, "E135", "1 positions and 2 angles"),
    "shape": (([[0, 0, 0]], [0]), {}, "E135", "(N, 2)"),
    "text": (([["a", 0]], [0]), {}, "E135", "not real numbers"),
    "axes": (([[1, 1]], [1]), {"axes": "F"}, "E135", "no axes 'F'"),
    "axes of another kind": (([[1, 1]], [1]), {"axes": 3}, "E135", "not of type Iterable"),
    "axes count": (([[1, 1]], [1]), {"axes": ("body", "body")}, "E135", "axes of 2 tolerances"),
    "free in all": (([[1, 1], [INF, INF]], [1, INF]), {}, "E136", "pose 2 is free in x, y and"),
    "no direction": (([[1, 2]], [INF]), {"axes": "body"}, "E136", "along the body's axes"),
}


@pytest.mark.parametrize("name", MALFORMED)
def test_malformed_tolerances_are_refused(name):
    parts, named, code, said = MALFORMED[name]
    error = refused(*parts, **named)
    assert error.code == code
    assert said in error.message
    assert error.help


def test_a_pose_marked_exact_has_no_tolerance():
    loose = PoseTolerances([[0, 0], [0, 0.1], [1, 1], [0, 0]], [0, 0, 0, 0])
    exact = np.array([True, True, False, False])
    error = refused_task(loose, exact=exact)
    assert (error.code, error.message[:30]) == ("E136", "pose 2 is marked exact, and it")
    assert "its y has" in error.message
    exact[1] = False
    rows = np.array(ROWS, dtype=float)
    Task(Displacement.from_poses(rows * [1, 1, 0.01]), tolerances=loose, exact=exact)


def test_tolerances_fit_the_poses_and_leave_a_linkage_a_choice():
    assert refused_task(PoseTolerances.uniform(3, 1, 1, 1)).code == "E135"
    six = [(i, i * i, 10 * i) for i in range(6)]
    error = refused_task(PoseTolerances.uniform(6, 0, 0, 0), six)
    assert (error.code, error.message[:2]) == ("E133", "12")
    assert refused_task("1 mm").code == "E125"
    poses = Displacement.from_poses(six)
    assert Task(poses, tolerances=PoseTolerances.uniform(6, 0, 0, INF)).tolerances is not None


def test_a_free_component_gets_a_value_between_its_neighbours():
    rows = [(0, 0, 350), (1, np.nan, np.nan), (2, 8, 10), (3, 9, np.nan)]
    free = PoseTolerances([[0, 0], [0, INF], [0, 0], [0, 0]], [0, INF, 0, INF])
    task = Task.from_rows(rows, angle_unit="deg", tolerances=free)
    assert task.poses.translation[:, 1].tolist() == [0, 4, 8, 9]
    turned = np.degrees(task.poses.angle)
    assert turned % 360 == pytest.approx([350, 0, 10, 10])
    with pytest.raises(InputError) as caught:
        Task.from_rows(rows, angle_unit="deg", tolerances=PoseTolerances.uniform(4, 1, 1, 0))
    assert caught.value.code == "E103"
    assert nominal_values(np.full(3, np.nan), np.ones(3, dtype=bool)).tolist() == [0, 0, 0]


def test_components_have_their_order():
    for number, name in enumerate(COMPONENTS):
        bounds = [0.0, 0.0, 0.0]
        bounds[number] = -1.0
        assert f"for {name} is" in refused([bounds[:2]], [bounds[2]]).message
