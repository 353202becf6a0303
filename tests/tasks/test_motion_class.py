"""What a motion is, before any fit: special ones named with true numbers, general ones never."""

import re

import numpy as np
import pytest
from benchmarks.two_slider_motions import recognised
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import least_squares

from burmester import synthesize
from burmester.dyads.five_poses import dyads_of_five
from burmester.fourbar.dyad import PP, PR, RP, RR
from burmester.geometry.displacement import Displacement
from burmester.tasks.motion_class import classify_motion
from burmester.tasks.motion_kinds import (
    CircularTranslation,
    FewPoses,
    FreeTranslation,
    General,
    Rest,
    Rotation,
    StraightTranslation,
    TwoOrientations,
    TwoSliders,
    Undetermined,
)
from burmester.tasks.motion_task import Task
from tests.oracles.strange_poses import STRANGE
from tests.oracles.two_slider_motions import best_pair, planted
from tests.oracles.two_slider_motions import printed as rounded
from tests.oracles.witness import misses, places, random_four_bar, random_poses, span
from tests.samples import samples

PRINTED = (5e-5, np.radians(5e-5))  # half of the last digit of rows with four decimals


def task_of(rows, resolution=(0.0, 0.0), **more):
    return Task(Displacement.from_poses(np.asarray(rows, float)), resolution=resolution, **more)


def kind_of(rows, resolution=(0.0, 0.0)):
    return classify_motion(task_of(rows, resolution)).kind


def printed(rows, digits=4):
    rows = np.asarray(rows)
    return np.column_stack(
        [rows[:, :2].round(digits), np.radians(np.degrees(rows[:, 2]).round(digits))]
    )


def moved(rows, fixed, moving, unit=1.0):
    poses = fixed @ Displacement.from_poses(rows) @ moving.inverse()
    return np.column_stack([poses.translation * unit, poses.angle])


def anywhere(rng, offset=10.0):
    return Displacement(offset * rng.normal(size=2), np.array(rng.uniform(-9, 9)))


# --- motions made by driving something


def straight(rng, n):
    way = np.exp(1j * rng.uniform(-np.pi, np.pi))
    z = rng.normal(size=2) @ [1, 1j] + way * rng.normal(size=n)
    return np.column_stack([z.real, z.imag, np.full(n, rng.uniform(-np.pi, np.pi))])


def on_arc(rng, n):
    radius, arc = 10 ** rng.uniform(-1, 1), rng.uniform(0.5, 6)
    z = rng.normal(size=2) @ [1, 1j] + radius * np.exp(1j * (3 + arc * rng.uniform(size=n)))
    return np.column_stack([z.real, z.imag, np.full(n, rng.uniform(-np.pi, np.pi))])


def on_curve(rng, n):
    t = np.sort(rng.uniform(-1, 1, n))
    z = np.polyval(rng.normal(size=(4, 2)) @ [1, 1j], t)
    return np.column_stack([z.real, z.imag, np.full(n, rng.uniform(-np.pi, np.pi))])


def about_point(rng, n):
    angle = rng.uniform(0.3, 3) * rng.uniform(-1, 1, n)
    return moved(np.column_stack([np.zeros((n, 2)), angle]), anywhere(rng), anywhere(rng))


def trammel(rng, n, kind=PR):
    """Two points of a bar on two lines that cross somewhere, the first pushed along."""
    while True:
        a, b = rng.normal(size=(2, 2))
        make = {PR: lambda t, m: PR(t, rng.normal(), m), RP: lambda t, c: RP(c, t, rng.normal())}
        pair = [make[kind](rng.uniform(-np.pi, np.pi), point) for point in (a, b)]
        where, phi = places(*pair, rng.uniform(-2, 2, 40 * n))
        z, phi = np.concatenate(where), np.concatenate(phi)
        sound = np.flatnonzero(np.isfinite(z))[:n]
        crossing = np.sin(pair[0].normal_angle - pair[1].normal_angle)
        if len(sound) == n and abs(crossing) > 0.3 and np.linalg.norm(a - b) > 0.3:
            return np.column_stack([z.real, z.imag, phi])[sound], pair


# --- translations


@pytest.mark.parametrize("seed", range(67))
@pytest.mark.parametrize(
    ("motion", "kind"),
    [(straight, StraightTranslation), (on_arc, CircularTranslation), (on_curve, FreeTranslation)],
)
def test_200_translations_are_named_and_only_sliders_offered(motion, kind, seed):
    rng = np.random.default_rng(seed)
    rows = motion(rng, int(rng.integers(4, 20)))
    found = classify_motion(task_of(rows))
    assert type(found.kind) is kind
    assert not found.determined
    turn = rows[0, 2] - found.kind.angle
    assert abs(np.angle(np.exp(1j * turn))) < 1e-12
    *links, guide = found.kind.dyads
    assert isinstance(guide, PP)
    assert len(links) == (2 if kind is CircularTranslation else 0)
    if kind is StraightTranslation:
        along = np.diff(rows[:, :2], axis=0) @ [
            -np.sin(found.kind.direction),
            np.cos(found.kind.direction),
        ]
        assert np.abs(along).max() < 1e-9 * span(rows)


def drive_parallelogram(first, second, theta):
    """The body's places where both links stand at the angles theta, and how far they are apart."""
    c = [complex(*dyad.fixed_pivot) for dyad in (first, second)]
    m = [complex(*dyad.moving_pivot) for dyad in (first, second)]
    pins = [c[k] + dyad.radius * np.exp(1j * theta) for k, dyad in enumerate((first, second))]
    turn = (pins[1] - pins[0]) / (m[1] - m[0])
    strain = np.abs(np.abs(turn) - 1).max()
    return pins[0] - turn * m[0], np.angle(turn), strain


@pytest.mark.parametrize("seed", range(60))
def test_the_parallelogram_offered_meets_all_poses(seed):
    rng = np.random.default_rng(seed)
    rows = on_arc(rng, int(rng.integers(3, 20)))
    motion = kind_of(rows)
    first, second, _ = motion.dyads
    d = rows[:, 0] + 1j * rows[:, 1]
    pin = d + complex(*first.moving_pivot) * np.exp(1j * rows[:, 2])
    theta = np.angle(pin - complex(*first.fixed_pivot))
    z, phi, strain = drive_parallelogram(first, second, theta)
    assert strain < 1e-9
    assert np.abs(z - d).max() < 1e-9 * span(rows)
    assert np.abs(np.exp(1j * phi) - np.exp(1j * rows[:, 2])).max() < 1e-9
    # It stands square at mid-arc, and any other point of the body has such a link as well.
    ground = np.subtract(second.fixed_pivot, first.fixed_pivot)
    folded = np.sin(np.angle(complex(*ground)) - theta)
    if np.ptp(np.unwrap(np.sort(theta))) < 2:
        assert np.abs(folded).min() > 0.2
    other = motion.link(rng.normal(size=(5, 2)))
    assert np.abs(other[:, None].residual(Displacement.from_poses(rows))).max() < 1e-9 * span(rows)


@pytest.mark.parametrize("radius", [1e3, 1e4, 1e5])
def test_a_flat_arc_is_an_arc(radius):
    rng = np.random.default_rng(0)
    for _ in range(20):
        theta = rng.uniform(-3, 3) + rng.uniform(-1, 1, 9) / radius
        z = radius * (np.exp(1j * theta) - np.exp(1j * theta[0]))
        motion = kind_of(np.column_stack([z.real, z.imag, np.full(9, 0.3)]))
        assert isinstance(motion, CircularTranslation)
        assert np.isclose(motion.radius, radius, rtol=1e-3)


def test_help_for_a_parallelogram_can_be_followed_literally():
    rng = np.random.default_rng(1)
    rows = on_arc(rng, 9)
    numbers = [float(x) for x in re.findall(r"-?\d+\.?\d*(?:e-?\d+)?", kind_of(rows).help)]
    radius, *ends = numbers
    pivots = np.reshape(ends, (2, 2, 2))
    poses = Displacement.from_poses(rows)
    for fixed, moving in pivots:
        miss = RR(fixed, moving, np.array(radius)).residual(poses)
        assert np.abs(miss).max() < 1e-4 * span(rows)


# --- a turn about one point


@pytest.mark.parametrize("offset", [0.0, 1.0, 1e3])
@pytest.mark.parametrize("seed", range(34))
def test_100_centres_of_rotation(seed, offset):
    rng = np.random.default_rng(seed)
    n = int(rng.integers(3, 20))
    centre, body = offset * rng.normal(size=2), offset * rng.normal(size=2) + rng.normal(size=2)
    angle = rng.uniform(-np.pi, np.pi) + rng.uniform(0.5, 3) * rng.uniform(-1, 1, n)
    c, s = np.cos(angle), np.sin(angle)
    x = centre[0] - c * body[0] + s * body[1]
    y = centre[1] - s * body[0] - c * body[1]
    rows = np.column_stack([x, y, angle])
    motion = kind_of(rows)
    assert isinstance(motion, Rotation)
    assert np.abs(motion.fixed_centre - centre).max() < 1e-9 * span(rows)
    assert np.abs(motion.moving_centre - body).max() < 1e-9 * span(rows)
    numbers = [float(x) for x in re.findall(r"-?\d+\.?\d*(?:e[-+]?\d+)?", motion.message)[:2]]
    assert np.abs(numbers - centre).max() < 1e-4 * (span(rows) + offset)


def test_a_turn_about_the_bodys_own_origin_has_no_size_but_a_centre():
    rows = np.column_stack([np.full((7, 2), 3.3), np.linspace(0, 2, 7)])
    motion = kind_of(rows)
    assert isinstance(motion, Rotation)
    assert "(3.3, 3.3)" in motion.message
    assert np.abs(motion.moving_centre).max() < 1e-12


@pytest.mark.parametrize("seed", range(20))
def test_the_centre_of_printed_poses_is_as_uncertain_as_said(seed):
    rng = np.random.default_rng(seed)
    rows = about_point(rng, 8)
    true = kind_of(rows)
    motion = kind_of(printed(rows), PRINTED)
    assert isinstance(motion, Rotation)
    miss = np.linalg.norm(motion.fixed_centre - true.fixed_centre)
    assert miss < 2 * motion.uncertainty < 1e-2


def test_few_digits_of_the_angle_move_a_far_body():
    # A thousandth of a degree, ten units from the centre, is more than the digits of x and y.
    rng = np.random.default_rng(0)
    coarse = (5e-7, np.radians(5e-4))
    for make in (about_point, lambda rng, n: trammel(rng, n)[0]):
        for _ in range(20):
            rows = moved(make(rng, 9), anywhere(rng), anywhere(rng))
            rows[:, :2] = rows[:, :2].round(6)
            rows[:, 2] = np.radians(np.degrees(rows[:, 2]).round(3))
            found = classify_motion(task_of(rows, coarse))
            if found.rotation > 0.7:  # less of it does not tell two sliders from the rest
                assert isinstance(found.kind, Rotation | TwoSliders)


@pytest.mark.parametrize("noise", [1e-15, 1e-14, 1e-13, 3e-12])
def test_a_turn_computed_with_rounding_is_a_turn(noise):
    rng = np.random.default_rng(0)
    for _ in range(20):
        rows = about_point(rng, 9)
        rows[:, :2] += noise * span(rows) * rng.uniform(-1, 1, size=(9, 2))
        assert isinstance(kind_of(rows), Rotation)


# --- two sliders


@pytest.mark.parametrize("kind", [PR, RP])
@pytest.mark.parametrize("seed", range(40))
def test_a_driven_trammel_is_a_two_slider_motion(kind, seed):
    rng = np.random.default_rng(seed)
    rows, pair = trammel(rng, int(rng.integers(4, 20)), kind)
    found = classify_motion(task_of(rows))
    motion = found.kind
    assert isinstance(motion, TwoSliders)
    assert motion.inverse == (kind is RP)
    assert found.nullity == max(3, 8 - len(rows))
    poses = Displacement.from_poses(rows)
    own = motion.fixed_centre if motion.inverse else motion.moving_centre
    for dyad in pair:  # the sliders that made it are members of the family
        arm = (dyad.fixed_pivot if motion.inverse else dyad.moving_pivot) - own
        assert np.isclose(np.hypot(*arm), motion.radius, rtol=1e-8)
        member = motion.slider(np.arctan2(arm[1], arm[0]))
        turn = member.normal_angle - dyad.normal_angle
        assert abs(np.sin(turn)) < 1e-8
        assert np.isclose(member.offset * np.sign(np.cos(turn)), dyad.offset, atol=1e-8)
    family = motion.slider(np.linspace(-np.pi, np.pi, 13))
    assert isinstance(family, kind)
    assert np.abs(family[:, None].residual(poses)).max() < 1e-9 * span(rows)
    first, second, crank = motion.dyads
    assert np.abs(crank.residual(poses)).max() < 1e-9 * span(rows)
    assert abs(np.cos(first.normal_angle - second.normal_angle)) < 1e-12
    for k, pose in enumerate(rows):  # and the two offered, driven, come to every pose
        on = poses[k].act(first.moving_pivot) if kind is PR else None
        on = poses[k].inverse().act(first.fixed_pivot) if on is None else on
        n = float(first.normal_angle)
        z, phi = places(first, second, np.array([on @ [-np.sin(n), np.cos(n)]]))
        gap = abs(z - complex(*pose[:2])) + abs(np.exp(1j * phi) - np.exp(1j * pose[2]))
        assert np.nanmin(gap) < 1e-6 * (1 + span(rows))  # dead points cost half the digits


@pytest.mark.parametrize("kind", [PR, RP])
def test_the_first_slider_offered_is_in_mid_stroke_in_the_middle_of_the_range(kind):
    rng = np.random.default_rng(0)
    for _ in range(10):
        rows, _ = trammel(rng, 9, kind)
        motion = kind_of(rows)
        first, second, _ = motion.dyads
        z, phi = drive_pair(first, second, motion.middle)
        place = Displacement(np.array([z.real, z.imag]), phi)
        if kind is PR:
            at = [place.act(d.moving_pivot) - motion.fixed_centre for d in (first, second)]
        else:
            back = place.inverse()
            at = [back.act(d.fixed_pivot) - motion.moving_centre for d in (first, second)]
        away = np.linalg.norm(at, axis=1)
        assert np.allclose(away, [0, 2 * motion.radius], atol=1e-9 * motion.radius)
        # No angle is farther from the middle than half of the rotation.
        far = np.abs(np.angle(np.exp(1j * (rows[:, 2] - motion.middle)))).max()
        assert np.isclose(2 * far, motion.rotation)


@pytest.mark.parametrize("inverted", [False, True])
@pytest.mark.parametrize("decimals", [4, 6, 16])
@pytest.mark.parametrize("degrees", [40, 110, 160])
def test_the_pair_offered_works_and_none_transmits_better(inverted, decimals, degrees):
    """Against every pair of a grid of the family, moved by the bare definition of the motion."""
    turn = np.radians(degrees)
    rng = np.random.default_rng([degrees, decimals, inverted])
    exact = planted(rng, 10, turn, inverted)
    rows, resolution = rounded(exact, decimals) if decimals < 16 else (exact, (0.0, 0.0))
    result = synthesize(task_of(rows, resolution))
    assert result.outcome.code == "R316"
    sliders = [
        each for each in result.usable if not any(isinstance(d.dyad, RR) for d in each.dyads)
    ]
    best = max(each.driven.least_over_range for each in sliders)
    assert best > (np.pi / 2 if inverted else best_pair(turn)) - np.radians(0.2)
    # What is offered comes to the poses that were printed, driven by the witness.
    reach = np.abs(rows[:, :2]).max()
    for each in result.usable:
        gap = misses(each.linkage, Displacement.from_poses(exact), reach)
        assert gap.max() < max(40 * resolution[0], 1e-6) * (1 + reach)
    # No better pair is promised where there is none.
    weak = [each for each in result.warnings if each.code == "W210"]
    assert len(weak) == (not inverted and best_pair(turn) < np.radians(30))
    assert all("no other pair of the family transmits better" in each.help for each in weak)


def test_half_a_turn_has_no_pair_without_a_dead_point():
    rng = np.random.default_rng(2)
    assert best_pair(np.radians(182)) == 0
    result = synthesize(task_of(planted(rng, 12, np.radians(200), False)))
    assert result.outcome.code == "R316"
    assert not result.usable
    assert "without a dead point" in result.outcome.help
    turned = synthesize(task_of(planted(rng, 12, np.radians(200), True)))
    assert turned.usable  # slots turn on


def test_ten_poses_of_four_decimals_over_40_degrees_are_two_sliders_within_their_digits():
    """A sample of `python -m benchmarks.two_slider_motions`."""
    shares = recognised(3, 40, 4, 60)
    assert min(shares[:2]) > 0.9
    assert shares[2] < 0.03  # double-cranks with a short ground link nearly are such motions
    rng = np.random.default_rng(4)
    rows, resolution = rounded(planted(rng, 10, np.radians(40), True), 4)
    few = kind_of(rows, resolution)
    assert few.within_digits
    assert few.message.startswith("within the digits given, a two-slider motion (inverted)")
    assert "more digits" in few.help
    full = kind_of(planted(rng, 10, np.radians(40), True))
    assert not full.within_digits
    assert "digits" not in full.message + full.help


@pytest.mark.parametrize(("degrees", "decimals"), [(20, 5), (90, 3), (120, 3), (60, 16)])
def test_two_sliders_are_told_from_general_motions_both_ways(degrees, decimals):
    """A sample of `python -m benchmarks.two_slider_motions`."""
    shares = recognised(3, degrees, decimals, 30)
    assert min(shares[:2]) > 0.85
    assert shares[2] < 0.03


def drive_pair(first, second, angle):
    """The body's place at an angle: both residuals of two sliders vanish, two linear equations."""
    turned = [Displacement(p, np.array(angle)) for p in ([0.0, 0], [1.0, 0], [0.0, 1])]
    rows = [[float(dyad.residual(place)) for place in turned] for dyad in (first, second)]
    r = np.array(rows)
    x, y = np.linalg.solve(r[:, 1:] - r[:, :1], -r[:, 0])
    return complex(x, y), np.array(angle)


def test_an_isosceles_slider_crank_is_the_same_motion():
    # Crank and rod of one length: one branch is Cardan's motion.
    angle = np.linspace(0.2, 1.3, 9)
    rows = np.column_stack([np.cos(angle), np.sin(angle), -angle])
    motion = kind_of(rows)
    assert isinstance(motion, TwoSliders)
    assert not motion.inverse
    assert np.isclose(motion.radius, 1)
    assert np.abs([motion.fixed_centre, motion.moving_centre]).max() < 1e-12


def test_the_family_of_two_sliders_has_one_circle_dyad_only():
    rng = np.random.default_rng(3)
    rows, _ = trammel(rng, 12)
    motion = kind_of(rows)

    def miss(v):
        poses = Displacement.from_poses(rows)
        arm = np.linalg.norm(poses.act(v[2:]) - v[:2], axis=1)
        return arm - arm.mean()

    met = 0
    for _ in range(40):
        fit = least_squares(miss, 3 * rng.normal(size=4), method="lm")
        if np.abs(fit.fun).max() < 1e-10 and np.abs(fit.x).max() < 30:
            met += 1
            assert np.abs(fit.x[:2] - motion.crank.fixed_pivot).max() < 1e-6
            assert np.abs(fit.x[2:] - motion.crank.moving_pivot).max() < 1e-6
    assert met > 0


# --- poses given more than once


@pytest.mark.parametrize("seed", range(20))
def test_exact_repeats_are_merged_whole_turns_too(seed):
    rng = np.random.default_rng(seed)
    n = int(rng.integers(5, 12))
    degrees = rng.normal(size=(n, 3)).round(3) * [1, 1, 90] + [1e3 * rng.normal(), 0, 0]
    which = np.concatenate([np.arange(n), rng.integers(0, n, 7)])
    again = degrees[which] + 360 * np.array([0, 0, 1]) * rng.integers(-3, 4, len(which))[:, None]
    order = rng.permutation(len(which))
    found = classify_motion(Task.from_rows(again[order], angle_unit="deg"))
    assert found.distinct == n
    for i, j in enumerate(found.group):
        assert which[order][found.first[j]] == which[order][i]
    assert (np.diff(found.first) > 0).all()


@pytest.mark.parametrize("apart", [1e-12, 1e-10, 1e-8, 1e-6])
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_near_repeats_are_different_poses(apart, axis):
    rng = np.random.default_rng(4)
    rows = rng.normal(size=(6, 3))
    rows[5] = rows[0]
    rows[5, axis] += apart * span(rows)
    found = classify_motion(task_of(rows))
    assert found.distinct == 6
    if apart < 1e-11:  # less than what counts as rounding of computed poses
        assert isinstance(found.kind, FewPoses)
        kept = rows[list(found.kind.representatives)]
        assert isinstance(kind_of(kept), General)
        assert synthesize(task_of(kept)).method == "exact"
    else:
        assert isinstance(found.kind, General)


def test_turned_either_way_is_different():
    rows = np.array(
        [[1, 2, 0.3], [1, 2, -0.3], [1, 2, np.pi], [1, 2, 2.8], [1, 2, 0.3 + 4 * np.pi]]
    )
    found = classify_motion(task_of(rows))
    assert found.distinct == 4
    assert found.group.tolist() == [0, 1, 2, 3, 0]


def test_the_range_of_rotation_is_the_least_arc():
    rows = np.column_stack([np.eye(4)[:, :2], np.radians([350, 5, 1090, -2])])
    assert np.isclose(np.degrees(classify_motion(task_of(rows)).rotation), 20)


def test_five_poses_and_repeats_are_a_five_pose_task():
    rng = np.random.default_rng(1)
    rows = random_poses(random_four_bar(rng), rng, 5)
    found = classify_motion(task_of(np.vstack([rows, rows[::-1], rows[:2]])))
    assert found.distinct == 5
    assert isinstance(found.kind, General)
    assert found.nullity == 3
    assert (found.five == np.arange(5)).all()
    doubled = np.repeat(rows, 2, axis=0)
    found = classify_motion(task_of(doubled))
    assert found.first.tolist() == [0, 2, 4, 6, 8]
    assert (doubled[found.first[found.five]] == rows).all()


@pytest.mark.parametrize(("different", "kind"), [(1, Rest), (2, General), (3, General)])
def test_few_different_poses(different, kind):
    rng = np.random.default_rng(2)
    rows = rng.normal(size=(different, 3))[rng.permutation(np.arange(9) % different)]
    found = classify_motion(task_of(rows))
    assert isinstance(found.kind, kind)
    assert found.distinct == different


# --- general motions are never called special


def random_general(rng, how):
    """A four-bar's poses: all around or on an arc, exact, printed with four decimals, or noisy."""
    while True:
        dyads = random_four_bar(rng, [RR, RR, PR, RP][rng.integers(4)])
        n = int(rng.integers(5, 31))
        if rng.random() < 0.5:
            rows = random_poses(dyads, rng, n)
        else:
            drive = rng.uniform(-3, 3) + 10 ** rng.uniform(-1.5, 0.8) * rng.uniform(0, 1, n)
            z, phi = (x[rng.integers(2)] for x in places(*dyads, drive))
            rows = np.column_stack([z.real, z.imag, phi])
        if not np.isfinite(rows).all() or np.ptp(np.unwrap(np.sort(rows[:, 2]))) < 1e-2:
            continue
        if how == "printed":
            return printed(rows), PRINTED
        return rows + (1e-3 * rng.normal(size=rows.shape) if how == "noisy" else 0), (0.0, 0.0)


@pytest.mark.parametrize("how", ["exact", "printed", "noisy"])
@pytest.mark.parametrize("offset", [0.0, 1e6])
def test_no_general_motion_is_called_special(how, offset):
    rng = np.random.default_rng(7)
    undetermined = 0
    for _ in samples(340, 60):
        rows, (position, angle) = random_general(rng, how)
        turn = np.degrees(np.ptp(np.unwrap(np.sort(rows[:, 2]))))
        unit = 10 ** rng.uniform(-6, 6)
        fixed, moving = anywhere(rng, offset), anywhere(rng, 0.0 if how == "printed" else offset)
        rows = moved(rows, fixed, moving, unit)
        motion = kind_of(rows, (position * unit, angle))
        assert isinstance(motion, General | Undetermined), motion.message
        if isinstance(motion, Undetermined):  # four decimals cannot tell so little motion
            undetermined += 1
            assert how == "printed" or (offset and turn < 2)
            assert turn < 5 or len(rows) == 5
    assert undetermined < 50


@pytest.mark.parametrize("name", ["kite", "antiparallelogram"])
def test_special_four_bars_have_three_quadrics_and_their_dyads_are_those_of_five_poses(name):
    crank, rod, follower = {"kite": (2, 1, 1), "antiparallelogram": (1, 2, 1)}[name]
    dyads = [RR([0, 0], [0, 0], crank), RR([2, 0], [rod, 0], follower)]
    drive = np.concatenate([0.5 + 1e-6 * np.arange(6), np.linspace(0.3, 2.6, 40)])
    z, phi = (x[0] for x in places(*dyads, drive))
    rows = np.column_stack([z.real, z.imag, phi])[np.isfinite(z)]
    found = classify_motion(task_of(rows))
    assert isinstance(found.kind, General)
    assert found.nullity == 3
    five = dyads_of_five(Displacement.from_poses(rows[found.first[found.five]]))
    for dyad in dyads:
        gap = np.abs(five.dyads.fixed_pivot - dyad.fixed_pivot).max(axis=1)
        gap = gap + np.abs(five.dyads.moving_pivot - dyad.moving_pivot).max(axis=1)
        assert np.nanmin(gap) < 1e-8


def test_three_quadrics_for_want_of_digits_are_no_five_poses():
    rows = little_turn(np.random.default_rng(0), 0.5)
    found = classify_motion(task_of(printed(rows), PRINTED))
    assert isinstance(found.kind, General)
    assert found.nullity == 3
    assert found.five is None


def test_collinear_origins_are_no_special_case():
    rng = np.random.default_rng(0)
    rows = rng.normal(size=(9, 3)) * [1, 0, 1]
    found = classify_motion(task_of(rows))
    assert isinstance(found.kind, General)
    assert found.nullity == 1  # the line itself: a PR dyad


@pytest.mark.parametrize("angles", [(0.0, np.pi), (0.1, 0.7), (-np.pi, 1.0)])
def test_two_orientations(angles):
    rng = np.random.default_rng(0)
    rows = rng.normal(size=(9, 3))
    rows[:, 2] = np.array(angles)[np.arange(9) % 2] + 2 * np.pi * rng.integers(-2, 3, 9)
    found = classify_motion(task_of(rows))
    assert isinstance(found.kind, TwoOrientations)
    assert found.determined
    assert found.nullity == 1
    gaps = np.exp(1j * np.array(found.kind.angles))[:, None] - np.exp(1j * np.array(angles))
    assert np.abs(gaps).min(axis=0).max() < 1e-12


def test_half_turns_are_a_translation_like_any_other():
    rng = np.random.default_rng(0)
    for noise in (0.0, 1e-13):
        rows = rng.normal(size=(8, 3))
        rows[:, 2] = np.pi * (-1.0) ** np.arange(8) + noise * rng.normal(size=8)
        found = classify_motion(task_of(rows))
        assert isinstance(found.kind, FreeTranslation)
        assert found.nullity == 4
        assert "180 deg" in found.kind.message


def test_the_angle_of_a_translation_is_the_middle_of_those_printed():
    rng = np.random.default_rng(0)
    rows = on_curve(rng, 9)
    rows[:, 2] = np.radians(179.99996) + np.radians(5e-5) * rng.uniform(-1, 1, 9)
    motion = kind_of(rows, PRINTED)
    assert isinstance(motion, FreeTranslation)
    assert abs(np.angle(np.exp(1j * (motion.angle - rows[:, 2])))).max() < PRINTED[1]


# --- the kind goes along with frames, units, order and digits

MOTIONS = {
    "straight": (straight, StraightTranslation),
    "arc": (on_arc, CircularTranslation),
    "curve": (on_curve, FreeTranslation),
    "turn": (about_point, Rotation),
    "trammel": (lambda rng, n: trammel(rng, n)[0], TwoSliders),
    "Oldham": (lambda rng, n: trammel(rng, n, RP)[0], TwoSliders),
    "general": (lambda rng, n: random_poses(random_four_bar(rng), rng, n), General),
    "anything": (lambda rng, n: rng.normal(size=(n, 3)), General),
    "rest": (lambda rng, n: np.tile(rng.normal(size=3), (n, 1)), Rest),
}


@pytest.mark.parametrize("name", MOTIONS)
@given(st.integers(0, 2**32 - 1), st.sampled_from([1e-6, 1.0, 1e6]), st.sampled_from([1.0, 1e6]))
def test_the_kind_does_not_depend_on_frames_units_order(name, seed, unit, offset):
    rng = np.random.default_rng(seed)
    motion, kind = MOTIONS[name]
    n = int(rng.integers(6, 15))
    rows = motion(rng, n)
    one = classify_motion(task_of(rows))
    assert isinstance(one.kind, kind)
    seen = moved(rows, anywhere(rng, offset), anywhere(rng, offset), unit)
    seen[:, 2] += 2 * np.pi * rng.integers(-2, 3, n)
    other = classify_motion(task_of(rng.permutation(seen)))
    assert isinstance(other.kind, kind)
    assert other.nullity == one.nullity
    assert np.isclose(other.rotation, one.rotation, atol=1e-9)
    assert np.allclose(one.singular_values, other.singular_values, rtol=1e-6, atol=1e-9 * offset)


@pytest.mark.parametrize("name", [name for name, (_, kind) in MOTIONS.items() if kind is not Rest])
@pytest.mark.parametrize("seed", range(20))
def test_four_decimals_do_not_hide_a_special_motion_nor_make_one(name, seed):
    rng = np.random.default_rng(seed)
    motion, kind = MOTIONS[name]
    rows = motion(rng, 9)
    assert isinstance(kind_of(printed(rows), PRINTED), kind)
    # Errors a thousand times the last digit are seen to be no digits.
    off = printed(rows + 0.1 * rng.normal(size=rows.shape))
    assert isinstance(kind_of(off, PRINTED), General)


NULLITIES = {
    "rest": (lambda a: (np.ones((9, 2)), 0 * a + 1), 7),
    "line": (lambda a: (np.column_stack([a, 2 * a]), 0 * a + 1), 5),
    "parallelogram": (lambda a: (np.column_stack([np.cos(a), np.sin(a)]), 0 * a), 5),
    "turn": (lambda a: (np.full((9, 2), 3.5), a), 5),
    "curve": (lambda a: (np.column_stack([np.exp(a), a**3]), 0 * a), 4),
    "half turns": (lambda a: (np.column_stack([np.exp(a), a**3]), 0 * a + np.pi), 4),
    "two sliders": (lambda a: (np.column_stack([-2 * np.cos(a), 0 * a]), a), 3),
    "steady turn along a line": (lambda a: (np.column_stack([a, 0 * a]), a), 1),
}


@pytest.mark.parametrize("name", NULLITIES)
def test_the_table_of_nullities(name):
    motion, nullity = NULLITIES[name]
    translation, angle = motion(np.linspace(0.1, 2.5, 9))
    assert classify_motion(Task(Displacement(translation, angle))).nullity == nullity


# --- too little motion


def little_turn(rng, turn):
    """Poses of a four-bar whose coupler covers about so many radians, or fewer."""
    dyads = [RR([0, 0], [0, 0], 1.0), RR([3, 0], [2.5, 0], 1.7)]
    z, phi = (x[0] for x in places(*dyads, 1 + turn * np.sort(rng.uniform(0, 1, 12))))
    return np.column_stack([z.real, z.imag, phi])


@pytest.mark.parametrize("seed", range(10))
def test_too_little_motion_is_said_with_degrees_and_more_of_it_helps(seed):
    rng = np.random.default_rng(seed)
    motion = kind_of(printed(little_turn(rng, 1e-2)), PRINTED)
    assert isinstance(motion, Undetermined)
    assert motion.as_given <= 3 < motion.nullity
    assert "within the digits given" in motion.message
    degrees = float(re.search(r"rotation covers ([\d.e-]+) deg", motion.message)[1])
    assert np.isclose(degrees, np.degrees(motion.rotation), rtol=1e-2)
    assert isinstance(kind_of(printed(little_turn(rng, 3.0)), PRINTED), General)  # more rotation
    ten = (5e-11, np.radians(5e-11))
    assert isinstance(kind_of(printed(little_turn(rng, 1e-2), 10), ten), General)  # more digits


def test_a_little_turn_is_one_about_a_point_only_if_the_digits_can_tell():
    rng = np.random.default_rng(2)
    angle = 0.03 * rng.uniform(-1, 1, 9)
    rows = np.column_stack([5 + 3 * np.cos(angle), 7 + 3 * np.sin(angle), angle])
    assert isinstance(kind_of(rows), Rotation)
    assert isinstance(kind_of(printed(rows, 7), (5e-8, np.radians(5e-8))), Rotation)
    assert isinstance(kind_of(printed(rows), PRINTED), Undetermined)


def test_a_turn_and_one_pose_off_it_is_too_special():
    rng = np.random.default_rng(5)
    rows = np.vstack([about_point(rng, 8), rng.normal(size=3)])
    motion = kind_of(rows)
    assert isinstance(motion, Undetermined)
    assert motion.as_given == motion.nullity == 4
    assert "digits" not in motion.message
    more = np.vstack([rows, rng.normal(size=(4, 3))])
    assert isinstance(kind_of(more), General)


@pytest.mark.parametrize("name", STRANGE)
def test_strange_poses_have_a_kind_with_finite_words(name):
    rng = np.random.default_rng(list(STRANGE).index(name))
    for _ in range(60):
        rows = rng.normal(size=(int(rng.integers(3, 13)), 3)) * [10, 10, 1]
        motion = kind_of(STRANGE[name](rows, rng), PRINTED if rng.random() < 0.3 else (0.0, 0.0))
        for words in (motion.message, motion.help):
            assert not re.search(r"nan|inf\b|\d{16}", words)
        for dyad in motion.dyads:
            assert np.isfinite(dyad.coefficients()).all()
