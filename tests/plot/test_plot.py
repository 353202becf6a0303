"""Figures: what is drawn is where a witness has it, and looks as it did when it was looked at.

`python -m tests.plot.test_plot` draws the pictures in tests/figures again, to be looked at.
"""

import subprocess
import sys
from dataclasses import replace
from itertools import combinations, pairwise
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.contour import QuadContourSet
from matplotlib.testing.compare import compare_images
from PIL import Image

from burmester import (
    PR,
    RP,
    RR,
    Displacement,
    InputError,
    Linkage,
    Polygon,
    Task,
    dyad_curve,
    synthesize,
)
from burmester.dyads.three_poses import dyad_with_fixed_pivot
from burmester.families.family_map import curve_map, plane_map
from burmester.families.pair_verdicts import PairBounds, PairClass
from burmester.fourbar.pose_error import PoseError
from burmester.io.cases import load
from burmester.plot import (
    Box,
    Camera,
    achieved,
    centre_point_curve,
    centrodes,
    circle_point_curve,
    common_curve,
    coupler_curve,
    family_figure,
    family_map,
    figure,
    finish,
    house_style,
    image_space,
    legend,
    linkage,
    paper,
    partner_curve,
    pivot_map,
    pose_errors,
    poses,
    steps,
    transmission,
    walk,
    write_figures,
    write_gif,
)
from burmester.plot.raycast import Extent, Scene, Surface, cast, render
from burmester.plot.space import covered
from burmester.plot.style import BLUE, GREEN, ORANGE, VERMILION, label, settle_labels
from tests.oracles import witness
from tests.oracles.tracer import walks

BASELINES = Path(__file__).parent / "figures"
DPI, TOLERANCE = 50, 2.5

CRANK = Linkage(
    RR(np.array([-2.2, 0.1]), np.array([1.24, 0.1]), np.array(1.2377)),
    RR(np.array([1.15, 0.38]), np.array([4.59, 1.34]), np.array(4.6712)),
)
ROCKER = Linkage(  # two branches on one circuit: the first dyad rocks
    RR(np.array([0.0, 0.0]), np.array([0.0, 0.0]), np.array(3.0)),
    RR(np.array([4.0, 0.0]), np.array([4.0, 0.5]), np.array(1.0)),
)
SLIDER = Linkage(
    RR(np.array([0.2, -0.1]), np.array([0.3, 0.4]), np.array(1.1)),
    PR(np.array(1.2), np.array(0.4), np.array([3.5, -0.2])),
)
SLOT = Linkage(
    RR(np.array([0.0, 0.3]), np.array([0.5, 0.1]), np.array(1.0)),
    RP(np.array([2.5, 0.6]), np.array(1.4), np.array(0.3)),
)
CARDAN = Linkage(
    PR(np.array(0.3), np.array(0.2), np.array([1.0, 0.0])),
    PR(np.array(1.9), np.array(-0.1), np.array([-1.0, 0.4])),
)
TABLE2 = Task.from_rows(load("ge2012-exact")["poses"], angle_unit="deg")


@pytest.fixture(autouse=True)
def in_house_style():
    with house_style():
        yield


@pytest.fixture
def ax():
    return figure(4, 4, 80).add_subplot()


def points_of(line):
    rows = np.asarray(line.get_xydata(), dtype=float)
    return rows[np.isfinite(rows).all(axis=1)] @ [1, 1j]


def place(x, y, angle):
    return Displacement(np.array([x, y]), np.array(angle))


def at_drive(given, drive):
    """Where the coupler is when the first link stands at an angle."""
    d, phi = witness.places(given.first, given.second, np.array([drive]))
    return place(d[0, 0].real, d[0, 0].imag, phi[0, 0])


def image_of(rows):
    """Image points of rows (n, 3) in the chart Z4 = 1."""
    x, y, tangent = rows[:, 0], rows[:, 1], np.tan(rows[:, 2] / 2)
    return np.column_stack([(x * tangent - y) / 2, (x + y * tangent) / 2, tangent])


def away(points, line):
    """The distance of each of points (n, k) from a polyline (m, k)."""
    a, d = line[:-1], np.diff(line, axis=0)
    gap = points[:, None] - a
    size = (d * d).sum(-1)
    share = np.clip((gap * d).sum(-1) / np.where(size > 0, size, 1), 0, 1)
    return np.linalg.norm(gap - share[..., None] * d, axis=-1).min(axis=1)


# Rays and quadrics


def some_scene(seed):
    """Two quadrics, a box and a camera, and the quadrics' own form at points that the eye sees."""
    rng = np.random.default_rng(seed)
    matrices = rng.normal(size=(2, 4, 4))
    matrices += np.swapaxes(matrices, -1, -2)
    low = rng.normal(size=3) - 1
    box = Box(low, low + rng.uniform(1, 3, 3), 1.5)
    camera = Camera.at(*rng.uniform(-1, 1, 2) * [np.pi, 1.2], 6.0)

    def value(seen):
        p = seen / box.scale + (box.low + box.high) / 2
        h = np.append(p, np.ones((*p.shape[:-1], 1)), axis=-1)
        return np.einsum("...i,kij,...j->k...", h, matrices, h)

    return matrices, box, camera, value


@pytest.mark.parametrize("seed", range(6))
def test_rays_meet_quadrics_where_brute_force_has_them(seed):
    matrices, box, camera, value = some_scene(seed)
    x, y = np.random.default_rng(seed).uniform(-0.8, 0.8, (2, 60))
    t = cast(camera, box.forms(matrices), box.half, x, y)
    assert (t[::2] <= t[1::2]).all() or np.isinf(t).any()
    ray = camera.ahead + x[:, None] * camera.right + y[:, None] * camera.up
    hits = camera.eye + np.where(np.isfinite(t), t, 0.0)[..., None] * ray
    miss = np.abs(value(hits))[[0, 0, 1, 1], range(4)]
    assert miss[np.isfinite(t)].max() < 1e-9 * np.abs(matrices).max()
    # Brute force: steps along the ray, and every change of sign in the box.
    steps_ = np.linspace(0.5, 1.5, 20_001)
    fine = camera.eye + steps_[:, None, None] * ray
    inside = (np.abs(fine) <= box.half).all(axis=-1)
    sign = value(fine) > 0
    change = (sign[:, 1:] != sign[:, :-1]) & inside[1:] & inside[:-1]
    for k in (0, 1):
        for j in range(len(x)):
            found = steps_[1:][change[k, :, j]]
            own = np.sort(t[2 * k : 2 * k + 2, j][np.isfinite(t[2 * k : 2 * k + 2, j])])
            edge = np.abs(np.abs(camera.eye + own[:, None] * ray[j]) - box.half).min(initial=1)
            twins = np.diff(own).min(initial=1) < 2e-4
            if edge > 1e-3 and not twins:
                assert len(own) == len(found)
                assert np.abs(own - found).max(initial=0) < 1e-4
    assert np.isfinite(t).sum() > 5


@pytest.mark.parametrize("seed", range(3))
def test_the_nearer_surface_is_seen_in_front(seed):
    matrices, box, camera, value = some_scene(seed)
    pure = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    forms = box.forms(matrices)
    surfaces = tuple(Surface(f, c, 1.0) for f, c in zip(forms, pure, strict=True))
    extent, size = Extent(-0.8, 0.8, -0.6, 0.6), (64, 48)
    picture = render(Scene(camera, box.half, surfaces), extent, size)
    steps_ = np.linspace(0.5, 1.5, 4001)
    seen = 0
    for row, column in np.random.default_rng(seed).integers(0, (48, 64), (150, 2)):
        x, y = -0.8 + (column + 0.5) * 0.025, 0.6 - (row + 0.5) * 0.025
        fine = camera.eye + steps_[:, None] * (camera.ahead + x * camera.right + y * camera.up)
        inside = (np.abs(fine) <= box.half).all(axis=-1)
        sign = value(fine) > 0
        change = (sign[:, 1:] != sign[:, :-1]) & inside[1:]
        first = [np.flatnonzero(c)[:1] for c in change]
        beside = picture[max(row - 1, 0) : row + 2, max(column - 1, 0) : column + 2]
        if (np.ptp(beside.reshape(-1, 4).astype(int), axis=0) > 60).any():
            continue  # an edge
        if not any(len(f) for f in first):
            assert picture[row, column, 3] == 0
            continue
        nearer = int(np.argmin([f[0] if len(f) else 9999 for f in first]))
        red, _, blue, alpha = picture[row, column].astype(int)
        assert alpha == 255
        assert (red > blue) == (nearer == 0)
        seen += 1
    assert seen > 10


def test_a_clear_surface_lets_through_what_is_behind_it():
    sphere = np.diag([1.0, 1.0, 1.0, -0.25])
    box = Box(-np.ones(3), np.ones(3))
    scene = Scene(Camera.at(0.3, 0.2), box.half, (Surface(box.forms(sphere), np.ones(3), 0.3),))
    picture = render(scene, Extent(-1, 1, -1, 1), (201, 201))
    # Two walls of a sphere, met head on in its middle.
    assert picture[100, 100, 3] / 255 == pytest.approx(1 - 0.7**2, abs=0.01)
    # Its outline, from the eye: sin = r / distance.
    radius = 9.0 * np.tan(np.arcsin(0.5 / 9.0))
    area = (picture[..., 3] > 0).sum() * (2 / 201) ** 2
    assert area == pytest.approx(np.pi * radius**2, rel=0.03)


def test_points_are_covered_where_a_surface_is_before_them():
    sphere = np.diag([1.0, 1.0, 1.0, -0.25])
    box = Box(-np.ones(3), np.ones(3))
    camera = Camera.at(0.0, 0.0)  # the eye is on the first axis
    scene = Scene(camera, box.half, (Surface(box.forms(sphere), np.ones(3)),))
    points = np.array([[0.9, 0, 0], [0, 0, 0], [-0.9, 0, 0], [-0.9, 0.9, 0], [0.5, 0, 0]])
    assert covered(scene, points).tolist() == [0, 1, 2, 0, 0]


# The curve that quadrics share


@pytest.mark.parametrize("given", [CRANK, ROCKER, SLIDER, SLOT, CARDAN])
def test_the_common_curve_is_the_image_of_the_coupler_motion(given):
    p, q = given.first.coefficients(), given.second.coefficients()
    loops = common_curve(p, q, 2000)
    for loop in loops:
        for dyad in (given.first, given.second):
            fine = loop[np.abs(loop[:, 2:]).max(axis=1) > 0.05]
            places = witness_rows(fine)
            assert np.abs(constraint_of(dyad, places)).max() < 1e-9 * np.abs(places).max()
    if given is CARDAN:
        return
    # And nothing is missing: wherever the tracer goes, there is a loop.
    drive = np.linspace(0, 2 * np.pi, 40)
    found, angles = witness.places(given.first, given.second, drive)
    start = np.column_stack([found.real.ravel(), found.imag.ravel(), angles.ravel()])
    start = start[np.isfinite(start).all(axis=1)][[0, -1]]
    for begin in start:
        (rows,), _ = walks(
            Linkage(given.first[None], given.second[None]), begin[None], np.array([1.0])
        )
        near = np.abs(np.tan(rows[:, 2] / 2)) < 3
        image = image_of(rows[near])
        charts = [loop[:, :3] / loop[:, 3:] for loop in loops]
        gaps = [away(image, c[np.abs(c[:, 2]) < 4]) for c in charts if (abs(c[:, 2]) < 4).any()]
        assert np.min(gaps, axis=0).max() < 2e-3


def witness_rows(z):
    """Rows x + iy and turn e^(i phi) of image points (n, 4), by complex numbers."""
    half = z[:, 3] + 1j * z[:, 2]
    turn = half**2 / np.abs(half) ** 2
    d = 2 * (z[:, 1] - 1j * z[:, 0]) / np.conj(half)
    return np.column_stack([d, turn])


def constraint_of(dyad, rows):
    d, turn = rows.T
    if isinstance(dyad, RP):
        inside = (dyad.fixed_pivot @ [1, 1j] - d) / turn
        return (inside * np.exp(-1j * dyad.normal_angle)).real - dyad.offset
    pin = d + turn * (dyad.moving_pivot @ [1, 1j])
    if isinstance(dyad, RR):
        return np.abs(pin - dyad.fixed_pivot @ [1, 1j]) - dyad.radius
    return (pin * np.exp(-1j * dyad.normal_angle)).real - dyad.offset


@pytest.mark.parametrize("given", [CRANK, SLIDER, CARDAN])
def test_the_unit_of_length_changes_no_curve(given):
    plain = common_curve(given.first.coefficients(), given.second.coefficients(), 60)
    for unit in (1e-6, 1e6):
        p, q = (
            dyad.coefficients() * np.array([1, unit**2, *[unit] * 4, unit**2, unit**2])
            for dyad in (given.first, given.second)
        )
        loops = common_curve(p, q, 60)
        assert len(loops) == len(plain)
        for one, two in zip(loops, plain, strict=True):
            scaled = one / [unit, unit, 1, 1]
            sign = np.sign((scaled * two).sum(axis=1, keepdims=True))
            size = np.linalg.norm(scaled, axis=1, keepdims=True)
            own = np.linalg.norm(two, axis=1, keepdims=True)
            assert np.abs(sign * scaled / size - two / own).max() < 1e-6


def test_quadrics_without_a_common_point_share_no_curve():
    small = RR(np.array([0.0, 0.0]), np.array([0.0, 0.0]), np.array(1.0))
    large = RR(np.array([0.0, 0.0]), np.array([0.0, 0.0]), np.array(3.0))
    far = RR(np.array([9.0, 0.0]), np.array([0.0, 0.0]), np.array(1.0))
    assert common_curve(small.coefficients(), far.coefficients()) == []
    assert common_curve(small.coefficients(), large.coefficients() * -2) == []


def test_image_space_draws_curve_and_points_where_they_are(ax):
    p = np.stack([CRANK.first.coefficients(), CRANK.second.coefficients()])
    box = paper.EXACT_BOX
    drawn = image_space(ax, p, poses=TABLE2.poses, box=box, pixels=60)
    rows = np.column_stack([TABLE2.poses.translation, TABLE2.poses.angle])
    seen = (image_of(rows) - (box.low + box.high) / 2) * box.scale
    # A camera of one's own: similar triangles.
    a, e = np.radians(-145.0), np.radians(22.0)
    forward = -np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
    right = np.cross(forward, [0, 0, 1])
    right /= np.linalg.norm(right)
    flat = np.stack([seen @ right, seen @ np.cross(right, forward)], -1)
    flat *= 9 / (9 + seen @ forward)[:, None]
    marks = np.concatenate([m.get_xydata() for m in drawn.points])
    assert np.abs(np.sort(marks, axis=0) - np.sort(flat, axis=0)).max() < 1e-9
    # Hollow where a surface is met on the way there: brute force.
    share = np.linspace(0, 1 - 0.02 / 9, 20_001)[:, None, None]
    at = (9 * -forward) + share * (seen - 9 * -forward)
    h = at / box.scale + (box.low + box.high) / 2
    z = np.concatenate([h, np.ones((*h.shape[:-1], 1))], -1)
    rows_ = witness_rows(z.reshape(-1, 4))
    signs = [constraint_of(d, rows_).reshape(z.shape[:-1]) > 0 for d in (CRANK.first, CRANK.second)]
    inside = (np.abs(at) <= box.half).all(-1)[1:]
    hidden = sum(((s[1:] != s[:-1]) & inside).sum(0) for s in signs) > 0
    assert 0 < hidden.sum() < 10
    for want, line, face in zip((~hidden, hidden), drawn.points, ("white", "none"), strict=True):
        assert line.get_xydata() == pytest.approx(flat[want])
        assert line.get_markerfacecolor() == face
    line = np.concatenate([c.get_xydata() for c in drawn.curve])
    assert np.linalg.norm(line[:, None] - flat, axis=-1).min(axis=0).max() < 0.02
    texts = {t.get_text() for t in ax.texts}
    assert {"1", "10", "$Z_1\\,/\\,Z_4$", "$Z_3\\,/\\,Z_4$"} <= texts


# The plane


def test_poses_are_frames_at_their_places(ax):
    drawn = poses(ax, TABLE2.poses, size=0.5)
    rows = np.array(load("ge2012-exact")["poses"])
    turn = np.exp(1j * np.radians(rows[:, 2]))
    d = rows[:, 0] + 1j * rows[:, 1]
    assert np.abs(points_of(drawn.origins) - d).max() < 1e-12
    along = points_of(drawn.x_axes).reshape(-1, 2)
    assert np.abs(along - np.stack([d, d + 0.5 * turn], -1)).max() < 1e-12
    up = points_of(drawn.y_axes).reshape(-1, 2)
    assert np.abs((up[:, 1] - d) / (0.3j * turn) - 1).max() < 1e-12
    assert [t.get_text() for t in drawn.labels] == [str(k) for k in range(1, 11)]


def test_a_pose_whose_angle_is_free_has_a_dot_and_no_axes(ax):
    rows = TABLE2.poses[np.arange(4)]
    drawn = poses(ax, rows, size=0.5, free=[False, True, True, False])
    d = rows.translation @ [1, 1j]
    assert np.abs(points_of(drawn.origins) - d).max() < 1e-12
    for axes in (drawn.x_axes, drawn.y_axes):
        feet = points_of(axes).reshape(-1, 2)[:, 0]
        assert np.abs(feet - d[[0, 3]]).max() < 1e-12
    assert [t.get_text() for t in drawn.labels] == ["1", "2", "3", "4"]


def test_a_linkage_is_drawn_with_its_pivots_links_and_guides(ax):
    (d, _), (phi, _) = witness.places(SLIDER.first, SLIDER.second, np.array([0.7]))
    at = place(d[0].real, d[0].imag, phi[0])
    drawn = linkage(ax, SLIDER, at)
    link, rail = (points_of(line) for line in drawn.links)
    assert abs(link[1] - link[0]) == pytest.approx(1.1)
    pin = d[0] + (3.5 - 0.2j) * np.exp(1j * phi[0])
    assert np.abs((rail * np.exp(-1.2j)).real - 0.4).max() < 1e-12
    between = (pin - rail[0]) / (rail[1] - rail[0])
    assert abs(between.imag) < 1e-12
    assert 0.1 < between.real < 0.9
    assert np.abs(points_of(drawn.fixed_pivots) - (0.2 - 0.1j)).max() < 1e-12
    assert np.abs(points_of(drawn.moving_pivots) - [link[1], pin]).max() < 1e-12
    corners = drawn.coupler.get_xy() @ [1, 1j]
    assert np.abs(corners[0] - d[0]) < 1e-12


def test_a_slot_is_carried_by_the_body_over_its_fixed_pivot(ax):
    drive = np.linspace(0, 2 * np.pi, 25)
    found, angles = witness.places(SLOT.first, SLOT.second, drive)
    good = np.isfinite(found[0])
    many = Displacement(np.stack([found[0].real, found[0].imag], -1)[good], angles[0][good])
    ends = []
    for k in (0, 7):
        drawn = linkage(ax, SLOT, many[k], travel=(many,))
        slot = points_of(drawn.links[1])
        d, turn = many.translation[k] @ [1, 1j], np.exp(1j * many.angle[k])
        share = ((2.5 + 0.6j) - slot[0]) / (slot[1] - slot[0])
        assert abs(share.imag) < 1e-9
        assert 0 < share.real < 1
        ends.append((slot - d) / turn)
    assert ends[0] == pytest.approx(ends[1])  # the slot is one and the same in the body


@pytest.mark.parametrize("given", [CRANK, ROCKER, SLIDER, SLOT])
def test_coupler_curves_are_those_of_the_witness(ax, given):
    point = np.array([0.7, -0.4])
    drawn = coupler_curve(ax, given, point)
    d, phi = witness.places(given.first, given.second, np.linspace(0, 2 * np.pi, 4001))
    want = (d + (point @ [1, 1j]) * np.exp(1j * phi)).ravel()
    want = want[np.isfinite(want)]
    lines = [points_of(line) for circuit in drawn.circuits for line in circuit]
    got = np.concatenate(lines)
    size = np.ptp(want.real) + np.ptp(want.imag)
    for one, other in ((got, want), (want[::40], got)):
        assert np.abs(one[:, None] - other).min(axis=1).max() < 0.01 * size
    styles = {circuit[0].get_linestyle() for circuit in drawn.circuits}
    assert len(styles) == len(drawn.circuits)


def test_a_curve_in_other_units_is_not_cut(ax):
    large = Linkage(
        *(
            RR(1e6 * d.fixed_pivot, 1e6 * d.moving_pivot, 1e6 * d.radius)
            for d in (CRANK.first, CRANK.second)
        )
    )
    for one, two in zip(
        coupler_curve(ax, CRANK).circuits, coupler_curve(ax, large).circuits, strict=True
    ):
        assert np.abs(points_of(two[0]) / 1e6 - points_of(one[0])).max() < 1e-8


def test_dead_points_are_where_coupler_and_follower_are_in_line(ax):
    drawn = coupler_curve(ax, ROCKER)
    assert drawn.dead_points
    for marks in drawn.dead_points:
        # The body's origin is the driving pin here.
        for pin in points_of(marks):
            reach = abs(pin - 4.0)
            coupler = abs(4.0 + 0.5j)
            assert min(abs(reach - coupler - 1), abs(reach - abs(coupler - 1))) < 1e-6


def test_errors_are_drawn_as_long_as_the_note_says(ax):
    task = Task.from_rows(load("ge2012-approximate")["poses"], angle_unit="deg")
    shift = np.array([0.004, -0.003])
    moved = Displacement(task.poses.translation + shift, task.poses.angle + 0.01)
    drawn = achieved(ax, moved, task.poses)
    for (start, end), pose in zip(drawn.errors.get_segments(), task.poses.translation, strict=True):
        assert np.abs(start - pose).max() < 1e-12
        assert np.abs(end - start - drawn.scale * shift).max() < 1e-12
    assert drawn.scale > 1
    assert f"errors drawn {drawn.scale:g} times as large" in drawn.achieved.x_axes.get_label()
    turn = points_of(drawn.achieved.x_axes).reshape(-1, 2)
    wanted = points_of(drawn.prescribed.x_axes).reshape(-1, 2)
    turned = np.angle(np.diff(turn)[:, 0] / np.diff(wanted)[:, 0])
    assert turned == pytest.approx(drawn.scale * 0.01)
    assert "times" not in achieved(ax, moved, task.poses, scale=1).achieved.x_axes.get_label()


def test_centrodes_are_the_points_that_stand_still(ax):
    at = np.linspace(0, 2 * np.pi, 60)
    h = 1e-5
    first, second = CRANK.first, CRANK.second
    (d, phi), (d1, phi1) = (witness.places(first, second, at + k) for k in (-h, h))
    centre = (d + d1) / 2 + 1j * (d1 - d) / (phi1 - phi)
    place_ = place(d[0, 0].real, d[0, 0].imag, phi[0, 0])
    got = [points_of(centrodes(ax, CRANK, place_, circuit=k, samples=4001).fixed) for k in (0, 1)]
    near = np.abs(centre - d[0, 0]) < 6
    assert near.sum() > 20
    both = np.concatenate(got)
    assert np.abs(centre[near][:, None] - both).min(axis=1).max() < 0.03
    # The moving centrode touches the fixed one at the place where it is drawn.
    touching = []
    for k in (0, 1):
        drawn = centrodes(ax, CRANK, place_, circuit=k, samples=4001)
        gap = np.abs(points_of(drawn.moving) - centre[0, 0]).min()
        touching.append(max(gap, np.abs(points_of(drawn.fixed) - centre[0, 0]).min()))
    assert min(touching) < 0.01


def test_the_pivot_map_has_the_colours_of_the_least_errors(ax):
    task = Task.from_rows(load("ge2012-approximate")["poses"], angle_unit="deg")
    drawn = pivot_map(ax, task.poses, (-4, -3), (2, 2), columns=13, rows=11)
    rows = np.array(load("ge2012-approximate")["poses"])
    d, turn = rows[:, 0] + 1j * rows[:, 1], np.exp(1j * np.radians(rows[:, 2]))
    values = np.asarray(drawn.mesh.get_array()).reshape(11, 13)
    for j, i in ((0, 0), (7, 4), (10, 12), (3, 9)):
        c = -4 + 0.5 * i + 1j * (-3 + 0.5 * j)
        back = (d - c) * np.conj(turn)
        design = np.column_stack([2 * back.real, 2 * back.imag, np.ones(10)])
        x, y, _ = np.linalg.lstsq(design, -(np.abs(back) ** 2), rcond=None)[0]
        arm = np.abs(x + 1j * y + back)
        radius = np.sqrt((arm**2).mean())
        assert values[j, i] == pytest.approx(np.sqrt(((arm - radius) ** 2).mean()), rel=1e-6)
    assert drawn.mesh.norm.vmin <= values.min() * 1.0001


def shown(degrees, top):
    """The colour of a pair that works, on a scale from 30° to `top`."""
    return mpl.colormaps["cividis"]((degrees - 30) / (top - 30))[:3]


def test_the_square_of_four_poses_has_the_colours_of_its_pairs(ax):
    found = curve_map(Task(TABLE2.poses[[0, 1, 2, 3]]), samples=60)
    works = np.argwhere(found.verdicts.classes == PairClass.WORKS)
    angle = np.degrees(found.verdicts.transmission)
    i, j = works[np.argmax(angle[tuple(works.T)])]
    drawn = family_map(ax, found, Linkage(found.first[i], found.first[j]))
    picture = np.asarray(drawn.image.get_array())
    top = 5 * np.ceil(angle[i, j] / 5)
    for a, b in works[::40]:  # the first dyad to the right, the second one up
        assert picture[b, a] == pytest.approx(shown(angle[a, b], top))
    others = {k: set() for k in PairClass if k > PairClass.FARTHER}
    for (a, b), kind in np.ndenumerate(found.verdicts.classes):
        if kind > PairClass.FARTHER:
            others[PairClass(kind)].add(tuple(picture[b, a].tolist()))
    assert all(len(tints) == 1 for tints in others.values())
    # Without hue: each two tints are told apart by their lightness.
    light = sorted(np.dot(next(iter(tints)), [0.2126, 0.7152, 0.0722]) for tints in others.values())
    assert np.diff(light).min() > 0.02
    (ring,) = drawn.recommended
    assert ring.get_xydata().tolist() == [[i + 0.5, j + 0.5], [j + 0.5, i + 0.5]]


def test_the_centre_point_curve_has_the_colours_of_the_best_partners(ax):
    found = curve_map(Task(TABLE2.poses[[0, 1, 2, 3]]), samples=60)
    drawn = partner_curve(ax, found, within=1e6)
    (line,) = drawn.loops
    middles = np.array([piece[1] for piece in line.get_segments()])
    assert middles == pytest.approx(found.first.fixed_pivot)
    classes, angle = found.verdicts.classes, np.degrees(found.verdicts.transmission)
    top = 5 * np.ceil(np.nanmax(np.where(classes == PairClass.WORKS, angle, np.nan)) / 5)
    for k in np.flatnonzero((classes == PairClass.WORKS).any(axis=1)):
        best = angle[k][classes[k] == PairClass.WORKS].max()
        assert line.get_colors()[k][:3] == pytest.approx(shown(best, top))


def test_the_rectangle_of_three_poses_shows_pairs_where_their_pivots_are(ax):
    task = Task(TABLE2.poses[[0, 4, 9]])
    chosen = dyad_with_fixed_pivot(task.poses, [-2.0, -1.0])
    found = plane_map(task, chosen, [-6, -4], [2, 5], columns=33, rows=37)
    works = np.argwhere(found.verdicts.classes == PairClass.WORKS)
    row, column = works[len(works) // 2]
    drawn = family_map(ax, found, Linkage(chosen, found.second[row, column]))
    x0, x1, y0, y1 = drawn.image.get_extent()
    at = [x0 + (column + 0.5) * (x1 - x0) / 33, y0 + (row + 0.5) * (y1 - y0) / 37]
    assert at == pytest.approx([-6 + column * 8 / 32, -4 + row * 9 / 36])
    assert drawn.recommended[0].get_xydata()[1] == pytest.approx(at)
    # A pole stays where it is when the body goes from one of its poses to the other.
    for (a, b), pole in zip(combinations(range(3), 2), found.poles, strict=True):
        point = task.poses[a].inverse().act(pole)
        assert task.poses[b].act(point) == pytest.approx(pole)


def test_the_figure_of_a_family_says_its_tints_in_words():
    found = curve_map(Task(TABLE2.poses[[0, 1, 2, 3]]), samples=30)
    drawing = family_figure(found, Linkage(found.first[3], found.first[17]))
    (words,) = drawing.legends
    assert [text.get_text() for text in words.get_texts()] == [
        "outside limits or standard",
        "order defect",
        "branch defect",
        "circuit defect",
        "recommended",
    ]
    assert "transmission angle" in drawing.axes[2].get_ylabel()


@pytest.mark.parametrize(
    ("names", "shown"),
    [
        (("$\\frac$", "", "open"), [r"\$\frac\$", "2", "open"]),
        (("shut", "half way to where it rests", "open"), ["1", "2", "3"]),
    ],
)
def test_names_of_poses_in_a_map_are_no_formulas_and_not_long(ax, names, shown):
    task = Task(TABLE2.poses[[0, 4, 9]], names=names)
    chosen = dyad_with_fixed_pivot(task.poses, [-2.0, -1.0])
    found = plane_map(task, chosen, [-6, -4], [2, 5], columns=5, rows=5)
    family_map(ax, found)
    assert [text.get_text() for text in ax.texts][:3] == shown
    ax.figure.canvas.draw()


def test_pairs_that_work_with_pivots_where_they_are_assumed_are_outlined(ax):
    task = Task(TABLE2.poses[[0, 1, 2, 3]])
    corners = np.array([(-4.0, -5.0), (2.5, -5.0), (2.5, 6.0), (-4.0, 6.0)])
    found = curve_map(task, replace(PairBounds.of(task), fixed=Polygon(corners)), samples=60)
    family_map(ax, found)
    lines = [each for each in ax.collections if isinstance(each, QuadContourSet)]
    assert len(lines) == 2  # and a lighter one under it
    edges = np.concatenate([path.vertices for path in lines[1].get_paths()])
    works = found.verdicts.classes == PairClass.WORKS
    at = np.argwhere(works) + 0.5
    away = np.linalg.norm(edges[:, None] - at, axis=-1).min(axis=1)
    assert away.max() < 1.01  # beside such a pair
    (words,) = family_figure(found).legends
    assert "works, pivots where assumed" in [text.get_text() for text in words.get_texts()]


def test_burmester_curves_are_circles_through_four_poses(ax):
    four = TABLE2.poses[[0, 3, 6, 8]]
    curve = dyad_curve(four, 120)
    centre = centre_point_curve(ax, curve, within=1e9)
    circle = circle_point_curve(ax, curve, within=1e9)
    rows = np.column_stack([four.translation @ [1, 1j], np.exp(1j * four.angle)])
    for one, two in zip(centre, circle, strict=True):
        c, m = (line.get_xydata() @ [1, 1j] for line in (one, two))
        good = np.isfinite(c) & np.isfinite(m)
        arm = np.abs(rows[:, :1] + rows[:, 1:] * m[good] - c[good])
        assert (np.ptp(arm, axis=0) < 1e-6 * (1 + arm.max(axis=0))).all()
        assert good.sum() > 100
    assert centre[0].get_linestyle() != circle[0].get_linestyle()
    moved = circle_point_curve(ax, curve, place=four[0], within=1e9)
    m, seen = (line[0].get_xydata() @ [1, 1j] for line in (circle, moved))
    assert np.nanmax(np.abs(seen - rows[0, 0] - rows[0, 1] * m) / (1 + np.abs(m))) < 1e-9


# Charts


@pytest.fixture(scope="module")
def found():
    return synthesize(
        Task.from_rows(load("ge2012-approximate")["poses"], angle_unit="deg")
    ).linkages[0]


def test_the_transmission_angle_is_that_between_coupler_and_follower(ax, found):
    drawn = transmission(ax, found.driver_first, driven=found.driven)
    first, second = found.driver_first.first, found.driver_first.second
    for line in (*drawn.branches, drawn.used, drawn.poses):
        drive, got = np.asarray(line.get_xydata(), dtype=float).T
        d, phi = witness.places(first, second, np.radians(drive))
        a, b = (d + (x.moving_pivot @ [1, 1j]) * np.exp(1j * phi) for x in (first, second))
        angle = np.angle((b - a) / (b - second.fixed_pivot @ [1, 1j]))
        angle = np.degrees(np.arcsin(np.abs(np.sin(angle))))
        assert np.abs(angle - got).min(axis=0).max() < 1e-6
    marked = points_of(drawn.poses).imag
    assert marked == pytest.approx(np.degrees(found.driven.transmission), abs=1e-6)
    assert drawn.used.get_ydata().min() == pytest.approx(
        np.degrees(found.driven.least_over_range), abs=0.02
    )
    drive = points_of(drawn.poses).real
    assert 0 <= drive.min() < 360
    assert ax.get_xlabel() == "drive (deg)"


def test_a_slider_drives_along_its_rail(ax):
    driven_by_slider = Linkage(SLIDER.second, SLIDER.first)
    drawn = transmission(ax, driven_by_slider, unit="mm")
    assert ax.get_xlabel() == "drive (mm)"
    for branch in drawn.branches:
        along = np.asarray(branch.get_xdata(), dtype=float)
        d, phi = witness.places(SLIDER.first, SLIDER.second, np.linspace(0, 2 * np.pi, 2001))
        pin = d + (3.5 - 0.2j) * np.exp(1j * phi)
        s = (pin * np.exp(-1.2j)).imag
        # The rail is used from one dead point to the other, on one side or the other.
        sides = [(np.nanmin(v), np.nanmax(v)) for v in s]
        close = [np.abs(np.subtract((along.min(), along.max()), v)).max() for v in sides]
        assert min(close) < 1e-3


def test_errors_are_shown_with_their_numbers_and_units(ax, found):
    drawn = pose_errors(ax, found.error, "mm")
    rows = np.array(load("ge2012-approximate")["poses"])
    places = found.error.places
    gap = np.abs(places.translation @ [1, 1j] - rows[:, :2] @ [1, 1j])
    turn = np.abs(np.degrees(np.angle(np.exp(1j * (places.angle - np.radians(rows[:, 2]))))))
    assert drawn.position.get_ydata() == pytest.approx(gap)
    assert drawn.angle.get_ydata() == pytest.approx(turn, abs=1e-9)
    assert ax.get_yscale() == drawn.angle_axes.get_yscale() == "log"
    assert ax.get_ylabel() == "position error (mm)"
    low, high = ax.get_ylim()
    assert low < gap.min() < gap.max() < high
    zero = PoseError(places, np.zeros(10), np.zeros(10))
    assert (np.asarray(pose_errors(ax, zero).position.get_ydata()) > 0).all()


# How it looks


def lightness(color):
    r, g, b = mpl.colors.to_rgb(color)
    return 0.2126 * r + 0.7152 * g + 0.0722 * b


def test_colours_and_styles_survive_a_black_and_white_printer(ax):
    assert abs(lightness(BLUE) - lightness(ORANGE)) > 0.2
    drawn = coupler_curve(ax, CRANK)
    (one,), (two,) = drawn.circuits
    assert (one.get_color(), two.get_color()) == (BLUE, GREEN)
    assert one.get_linestyle() != two.get_linestyle()
    assert len({BLUE, GREEN, VERMILION}) == 3


def test_axes_are_equal_and_everything_is_inside_them(found):
    for given, at in (
        (found.driver_first, found.error.places[2]),
        (SLIDER, at_drive(SLIDER, 0.7)),
        (SLOT, at_drive(SLOT, 0.7)),
    ):
        ax = figure(4, 3, 80).add_subplot()
        drawn = linkage(ax, given, at, names=True)
        coupler_curve(ax, given)
        finish(ax, "mm")
        ax.figure.canvas.draw()
        (x0, x1), (y0, y1) = ax.get_xlim(), ax.get_ylim()
        window = ax.get_window_extent()
        assert window.width / (x1 - x0) == pytest.approx(window.height / (y1 - y0), rel=1e-6)
        every = [line.get_xydata() for line in ax.lines]
        every += [p.get_xy() for p in ax.patches]
        every += [s for c in ax.collections for s in c.get_segments()]
        rows = np.concatenate([np.asarray(e, dtype=float) for e in every])
        rows = rows[np.isfinite(rows).all(axis=1)]
        assert (rows > [x0, y0]).all()
        assert (rows < [x1, y1]).all()
        assert (ax.get_xlabel(), ax.get_ylabel()) == ("X (mm)", "Y (mm)")
        assert len(drawn.labels) >= 2


def overlaps(drawing):
    """Pairs of texts of a figure whose boxes cover each other."""
    drawing.canvas.draw()
    renderer = drawing.canvas.get_renderer()
    texts = []
    for ax in drawing.axes:
        texts += [*ax.texts, ax.title]
        if ax.get_legend() is not None:
            texts += ax.get_legend().get_texts()
        for axis in (ax.xaxis, ax.yaxis):
            if not (ax.axison and axis.get_visible()):
                continue
            texts += [axis.label, axis.offsetText]
            low, high = sorted(axis.get_view_interval())
            ticks = [*axis.get_major_ticks(), *axis.get_minor_ticks()]
            ticks = [tick for tick in ticks if low <= tick.get_loc() <= high]
            texts += [t for tick in ticks for t in (tick.label1, tick.label2)]
    texts = [t for t in texts if t.get_visible() and t.get_text().strip()]
    boxes = [(t.get_text(), rectangle(t, renderer)) for t in texts]
    return [(a, b) for (a, one), (b, two) in combinations(boxes, 2) if meet(one, two)]


def rectangle(text, renderer):
    """The corners (4, 2) of a text as it is turned, in pixels."""
    middle = text.get_window_extent(renderer).get_points().mean(axis=0)
    turn = text.get_rotation()
    text.set_rotation(0)
    own = text.get_window_extent(renderer)
    text.set_rotation(turn)
    half = np.array([own.width, own.height]) / 2 - 0.25
    a = np.radians(turn)
    way = np.array([[np.cos(a), np.sin(a)], [-np.sin(a), np.cos(a)]])
    return middle + (half * [[-1, -1], [1, -1], [1, 1], [-1, 1]]) @ way


def meet(one, two):
    """Whether two rectangles overlap: no line along a side parts them."""
    for a in (one, two):
        for side in (a[1] - a[0], a[3] - a[0]):
            p, q = one @ side, two @ side
            if p.max() <= q.min() or q.max() <= p.min():
                return False
    return True


def test_labels_that_would_cover_each_other_are_moved_apart(ax):
    ax.set_xlim(0, 1)
    ax.set_ylim(0, 1)
    ax.set_axis_off()
    for k in range(6):
        label(ax, f"pose {k}", (0.5 + 0.01 * k, 0.5), (0.0, 1.0))
    assert overlaps(ax.figure)
    settle_labels(ax)
    assert not overlaps(ax.figure)


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """All figures of the paper, small."""
    folder = tmp_path_factory.mktemp("figures")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(paper, "figure", lambda w, h, dpi: figure(w, h, DPI))
        drawn = {}
        make = paper.paper_figure
        patch.setattr(paper, "paper_figure", lambda name: drawn.setdefault(name, make(name)))
        with house_style():
            paths = write_figures(folder / "new", ("png",))
        with pytest.raises(InputError) as second:
            write_figures(folder / "new", ("png", "svg"))
    return paths, drawn, second.value


def test_the_figures_of_the_paper_are_written_once(written):
    paths, _, second = written
    assert [p.name for p in paths] == [f"{name}.png" for name in paper.NAMES]
    assert second.code == "E140"
    assert sorted(p.name for p in paths[0].parent.iterdir()) == sorted(p.name for p in paths)


@pytest.mark.parametrize("name", paper.NAMES)
def test_figures_look_as_they_did(written, name):
    paths, _, _ = written
    path = next(p for p in paths if p.stem == name)
    assert compare_images(str(BASELINES / path.name), str(path), TOLERANCE) is None


@pytest.mark.parametrize("name", paper.NAMES)
def test_no_two_labels_of_a_figure_overlap(written, name):
    with house_style():
        assert overlaps(written[1][name]) == []


@pytest.mark.parametrize("kind", ["svg", "pdf"])
def test_the_same_figure_is_written_with_the_same_bytes(tmp_path, monkeypatch, kind):
    monkeypatch.setattr(paper, "NAMES", ("figure-1", "figure-2"))
    one, two = ([p.read_bytes() for p in write_figures(tmp_path / name, (kind,))] for name in "ab")
    assert one == two
    assert all(mark not in file for file in one for mark in (b"CreationDate", b"dc:date"))


def test_other_drawings_look_as_they_did(tmp_path, found):
    path = tmp_path / "plane.png"
    others(found).savefig(path)
    assert compare_images(str(BASELINES / "plane.png"), str(path), TOLERANCE) is None


@pytest.mark.parametrize("name", ["family-curve", "family-plane"])
def test_maps_of_families_look_as_they_did(tmp_path, name):
    path = tmp_path / f"{name}.png"
    drawing = families()[name]
    drawing.savefig(path, dpi=DPI)
    assert compare_images(str(BASELINES / path.name), str(path), TOLERANCE) is None
    assert overlaps(drawing) == []


def families():
    """Maps of MotionGen's four and three poses, with the best of their pairs."""
    four, three = (
        Task.from_rows(load(f"motiongen-{name}")["poses"], angle_unit="deg")
        for name in ("four-line", "three-pivots")
    )
    curve = curve_map(four, samples=120)
    chosen = dyad_with_fixed_pivot(three.poses, [-7.34106, 1.17668])
    areas = Polygon([[-12, -4], [-2, -4], [-2, 8], [-12, 8]])
    bounds = replace(PairBounds.of(three), fixed=areas)
    plane = plane_map(three, chosen, [-11, -4], [3, 6.5], columns=120, rows=90, bounds=bounds)
    out = {}
    for name, found in (("family-curve", curve), ("family-plane", plane)):
        works = found.verdicts.classes == PairClass.WORKS
        angle = np.where(works, found.verdicts.transmission, 0)
        i, j = np.unravel_index(angle.argmax(), angle.shape)
        pair = (found.first[i], found.second[j]) if found is curve else (chosen, plane.second[i, j])
        out[name] = family_figure(found, Linkage(*pair))
    return out


def others(found):
    """What the paper's figures do not show."""
    drawing = figure(11, 8, DPI)
    axes = drawing.subplots(2, 3)
    drawing.subplots_adjust(0.07, 0.07, 0.97, 0.92, 0.3, 0.3)
    task = Task.from_rows(load("ge2012-approximate")["poses"], angle_unit="deg")
    for ax, given, drive in zip(axes[0], (SLIDER, SLOT, ROCKER), (0.7, 0.7, 1.2), strict=True):
        coupler_curve(ax, given, (0.5, 0.8))
        linkage(ax, given, at_drive(given, drive), names=True)
        legend(ax)
        finish(ax, "mm")
    transmission(axes[1, 0], found.driver_first, driven=found.driven)
    legend(axes[1, 0])
    pivot_map(axes[1, 1], task.poses, (-5, -4), (3, 6), columns=60)
    linkage(axes[1, 1], found.driver_first, found.error.places[2])
    finish(axes[1, 1], room=0)
    curve = dyad_curve(task.poses[[0, 3, 6, 9]])
    centre_point_curve(axes[1, 2], curve)
    circle_point_curve(axes[1, 2], curve, place=task.poses[0])
    legend(axes[1, 2], 1)
    finish(axes[1, 2])
    return drawing


# Animation, and what is missing


def test_the_walk_goes_from_the_eigen_quadrics_to_the_manifolds(tmp_path):
    theta = steps([0.0, np.pi / 2], [-0.75, 0.78], 5, 2)
    assert theta[0] == pytest.approx([0, np.pi / 2])
    assert theta[-1] == pytest.approx([-0.75, 0.78])
    assert (np.diff(theta[:, 0]) <= 0).all()
    basis = np.stack([CRANK.first.coefficients(), CRANK.second.coefficients()])
    basis = np.linalg.qr(basis.T)[0].T
    pictures = list(walk(basis, theta, box=paper.EXACT_BOX, size=(120, 100)))
    assert len(pictures) == len(theta)
    changed = [not np.array_equal(a, b) for a, b in pairwise(pictures)]
    moved = [not np.allclose(a, b) for a, b in pairwise(theta)]
    assert changed == moved
    write_gif(tmp_path / "walk.gif", pictures, seconds=0.1)
    with Image.open(tmp_path / "walk.gif") as gif:
        assert gif.size == (120, 100)
        assert gif.n_frames == 1 + sum(moved)
        total, last = 0, None
        for k in range(gif.n_frames):
            gif.seek(k)
            total += gif.info["duration"]
            last = np.asarray(gif.convert("RGB")).astype(int)
    assert total == 100 * len(theta)
    assert np.abs(last - pictures[-1]).mean() < 6
    assert (last[0, 0] == 255).all()


def test_without_matplotlib_the_error_says_what_to_install():
    code = (
        "import sys; sys.modules['matplotlib'] = None\n"
        "import burmester\n"
        "try:\n    import burmester.plot\n"
        "except burmester.InputError as error:\n    print(error)\n"
    )
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert out.stdout.startswith("error[E130]: figures need Matplotlib")
    assert 'pip install "burmester[plot]"' in out.stdout


def test_a_box_around_points_holds_them_and_little_more():
    points = np.random.default_rng(3).normal([5.0, -7.0, 0.3], [0.4, 0.1, 0.2], (40, 3))
    box = Box.around([*points, [np.nan, 0, 0]], room=0.1)
    low, high = points.min(axis=0), points.max(axis=0)
    assert (box.low + box.high) / 2 == pytest.approx((low + high) / 2)
    wide, deep = (high - low)[:2].max(), (high - low)[2]  # equally wide in Z1 and Z2
    assert box.high - box.low == pytest.approx(1.2 * np.array([wide, wide, deep]))


if __name__ == "__main__":
    paper.figure = lambda w, h, dpi: figure(w, h, DPI)
    BASELINES.mkdir(exist_ok=True)
    with house_style():
        write_figures(BASELINES, ("png",), force=True)
        task_ = Task.from_rows(load("ge2012-approximate")["poses"], angle_unit="deg")
        others(synthesize(task_).linkages[0]).savefig(BASELINES / "plane.png")
        for name_, drawing_ in families().items():
            drawing_.savefig(BASELINES / f"{name_}.png", dpi=DPI)
