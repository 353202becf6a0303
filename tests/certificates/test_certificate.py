"""Certificates: what they call proved is so, and what is not so they do not call proved."""

import json
import math
import re
import sys
from dataclasses import replace
from itertools import product

import mpmath
import numpy as np
import pytest

from burmester.certificates import ball_arithmetic as balls
from burmester.certificates.certificate import certify, certify_five
from burmester.certificates.proofs import infinity_takes_eight
from burmester.dyads.critical_points import critical_dyads
from burmester.dyads.five_poses import dyads_of_five
from burmester.dyads.local_minima import best_dyads
from burmester.dyads.sliders import fixed_lines, moving_lines
from burmester.errors import InputError
from burmester.fourbar.dyad import PP, PR, RP, RR
from burmester.geometry.displacement import Displacement
from burmester.io.result import synthesis_data
from burmester.synthesis.motion_generation import synthesize
from burmester.tasks.motion_task import Task
from burmester.tasks.options import SynthesisOptions
from tests.oracles.cases import poses_of
from tests.oracles.witness import random_four_bar, random_poses

flint = pytest.importorskip("flint", reason="certificates need python-flint")

NO_OTHERS = "there are no others"
TINY = 1e-40  # what 50 digits leave open


def noisy_task(seed, count=None, noise=1e-3):
    rng = np.random.default_rng(seed)
    rows = random_poses(random_four_bar(rng), rng, count or int(rng.integers(6, 14)))
    return Displacement.from_poses(rows + noise * rng.normal(size=rows.shape))


def reported(poses, weights=None):
    """What a synthesis would report: the critical points, and the dyads that come of them."""
    best = best_dyads(poses, weights)
    circles = [best.dyads[k] for k in range(len(best.rms_error))]
    lines = [fixed_lines(poses, weights)[0][0], moving_lines(poses, weights)[0][0]]
    return best.search, [*circles, *lines]


def said(certificate, pattern):
    return [text for text in certificate.proved if re.search(pattern, text)]


# --- a second opinion: Newton's method with 50 digits in the task's own frames


def cis(angle):
    return mpmath.mpc(mpmath.cos(angle), mpmath.sin(angle))


def exact_poses(poses):
    """Places and turns as complex numbers, from the very doubles."""
    d = [mpmath.mpc(float(x), float(y)) for x, y in poses.translation]
    return d, [cis(mpmath.mpf(float(angle))) for angle in poses.angle]


def true_circle(poses, weights, dyad):
    """The nearest stationary circle by true distance, and half its Hessian."""
    d, turn = exact_poses(poses)
    w = [mpmath.mpf(float(v)) for v in (np.ones(len(d)) if weights is None else weights)]

    def gradient(c1, c2, m1, m2, r):
        by_c, by_m, by_r = mpmath.mpc(0), mpmath.mpc(0), mpmath.mpf(0)
        for share, place, e in zip(w, d, turn, strict=True):
            arm = mpmath.mpc(m1, m2) * e + place - mpmath.mpc(c1, c2)
            miss = share * (abs(arm) - r)
            by_c -= miss * arm / abs(arm)
            by_m += miss * arm / abs(arm) * mpmath.conj(e)
            by_r -= miss
        return [by_c.real, by_c.imag, by_m.real, by_m.imag, by_r]

    start = [float(v) for v in (*dyad.fixed_pivot, *dyad.moving_pivot, dyad.radius)]
    x = mpmath.findroot(gradient, start, tol=1e-60, maxsteps=30)
    steps = [mpmath.matrix([mpmath.mpf(10) ** -15 * (j == k) for j in range(5)]) for k in range(5)]
    columns = [
        [
            (a - b) / mpmath.mpf(2e-15)
            for a, b in zip(gradient(*(x + s)), gradient(*(x - s)), strict=True)
        ]
        for s in steps
    ]
    hessian = np.array([[float(v) for v in column] for column in columns])
    return list(x), np.linalg.eigvalsh((hessian + hessian.T) / 2)[0]


def gap_of_circle(dyad, x):
    c = mpmath.hypot(float(dyad.fixed_pivot[0]) - x[0], float(dyad.fixed_pivot[1]) - x[1])
    m = mpmath.hypot(float(dyad.moving_pivot[0]) - x[2], float(dyad.moving_pivot[1]) - x[3])
    return max(c, m, abs(float(dyad.radius) - x[4]))


def gap_of_line(poses, weights, line):
    """How far a line is from the best one: (offset and pivot, angle), by another route.

    The eigenvector by Newton on n · n = 1 and a multiplier, all unknowns at once.
    """
    if isinstance(line, RP):
        d, turn = exact_poses(poses)
        d = [-place * mpmath.conj(e) for place, e in zip(d, turn, strict=True)]
        turn = [mpmath.conj(e) for e in turn]
        pivot = line.fixed_pivot
    else:
        d, turn = exact_poses(poses)
        pivot = line.moving_pivot
    w = [mpmath.mpf(float(v)) for v in (np.ones(len(d)) if weights is None else weights)]

    def equations(angle, h, m1, m2):
        n, m = cis(angle), mpmath.mpc(m1, m2)
        total = [mpmath.mpf(0)] * 4
        for share, place, e in zip(w, d, turn, strict=True):
            point = m * e + place
            miss = share * ((mpmath.conj(n) * point).real - h)
            pull = n * mpmath.conj(e)
            slope = [(mpmath.conj(1j * n) * point).real, -1, pull.real, pull.imag]
            total = [t + miss * s for t, s in zip(total, slope, strict=True)]
        return total

    start = [float(v) for v in (line.normal_angle, line.offset, *pivot)]
    angle, h, m1, m2 = mpmath.findroot(equations, start, tol=1e-60, maxsteps=30)
    away = mpmath.hypot(start[2] - m1, start[3] - m2)
    return max(abs(start[1] - h), away), angle


def check_dyads(poses, weights, certificate, dyads):
    with mpmath.workdps(50):
        for item, dyad in zip(certificate.dyads, dyads, strict=True):
            if not item.proved:
                continue
            if isinstance(dyad, RR):
                x, least = true_circle(poses, weights, dyad)
                assert gap_of_circle(dyad, x) <= item.radius + TINY
                assert (least > 0) == item.minimum
            else:
                gap, angle = gap_of_line(poses, weights, dyad)
                assert gap <= item.radius + TINY
                radians = mpmath.mpf(float(dyad.normal_angle))
                written = mpmath.radians(math.degrees(float(dyad.normal_angle)))
                assert max(abs(radians - angle), abs(written - angle)) <= item.angle_radius + TINY


@pytest.mark.parametrize("seed", range(4))
def test_degrees_of_a_line_in_a_file_are_as_near_as_is_said(seed):
    poses = noisy_task(seed)
    synthesis = synthesize(Task(poses), SynthesisOptions(method="complete", certify=True))
    data = json.loads(json.dumps(synthesis_data(synthesis)))
    bounds = {each["id"]: each for each in data["certificate"]["dyads"]}
    lines = [each for each in synthesis.dyads if isinstance(each.dyad, PR | RP)]
    assert len(lines) == 2
    with mpmath.workdps(50):
        for found in lines:
            (told,) = (each["line"] for each in data["dyads"] if each["id"] == found.id)
            _, angle = gap_of_line(poses, None, found.dyad)
            off = abs(mpmath.mpf(told["normal_deg"]) - mpmath.degrees(angle))
            assert bounds[found.id]["proved"]
            assert off <= bounds[found.id]["angle_radius_deg"] + TINY


# --- the test for a zero


@pytest.mark.parametrize("start", [0.0, 1e-9, 1.1 * 2.0**-75])
def test_a_box_with_two_zeros_or_none_is_refused(start):
    def parabola(level):
        def system(x):
            kind, (x,) = type(x), x.entries()
            return kind([[x * x - level]]), kind([[2 * x]])

        return system

    with flint.ctx.workprec(128):
        tiny = flint.arb(2) ** -150
        for kind, level in product((flint.arb_mat, flint.acb_mat), (tiny, -tiny, 0)):
            assert balls.zero_near(parabola(level), kind([[start]])) is None
        box = balls.zero_near(parabola(flint.arb(2) ** -20), flint.arb_mat([[1e-3]]))
        assert abs(box[0, 0] - flint.arb(2) ** -10) < 1e-15
        assert balls.zero_near(parabola(-1), flint.arb_mat([[0.3]])) is None
        assert balls.zero_near(parabola(-1), flint.acb_mat([[0.3 + 0.8j]]))[0, 0].imag > 0.99


# --- six poses and more


@pytest.mark.parametrize("name", ["ge2012-approximate", "ge2012-exact"])
def test_the_papers_poses_are_proved_throughout(name):
    _, poses = poses_of(name)
    critical, dyads = reported(poses)
    certificate = certify(poses, None, critical, dyads)
    assert certificate.complete
    assert said(certificate, "^25 critical points.* 5 are real, 20 are not")
    assert said(certificate, NO_OTHERS)
    assert said(certificate, "has 3 local minima")
    assert said(certificate, "global minimum")
    assert all(item.proved and item.minimum for item in certificate.dyads)
    assert max(item.radius for item in certificate.dyads) < 1e-8
    assert certificate.numerical[0].startswith("the sum of squared true distances may have")
    for item in certificate.dyads:
        (sentence,) = said(certificate, rf"^dyad {item.index + 1} \({item.kind}\)")
        assert 1 <= float(sentence.split()[4]) / item.radius < 1.1
    check_dyads(poses, None, certificate, dyads)


@pytest.mark.parametrize("seed", range(12))
def test_radii_hold_the_true_dyads(seed):
    poses = noisy_task(seed)
    weights = None if seed % 2 else np.random.default_rng(seed).uniform(0.5, 2, poses.shape)
    critical, dyads = reported(poses, weights)
    certificate = certify(poses, weights, critical, dyads)
    assert certificate.complete
    assert [item.kind for item in certificate.dyads[-2:]] == ["PR", "RP"]
    assert all(item.proved and item.minimum for item in certificate.dyads[-2:])
    assert sum(item.proved for item in certificate.dyads) >= 3
    check_dyads(poses, weights, certificate, dyads)


@pytest.mark.parametrize("seed", range(4))
def test_critical_points_lie_where_they_are_said_to(seed):
    poses = noisy_task(seed, noise=0.05)
    critical = critical_dyads(poses)
    certificate = certify(poses, None, critical, [])
    radius = float(
        re.search(r"within (\S+) of the computed one", said(certificate, "25 critical")[0])[1]
    )
    frames = critical.frames
    origin = [*frames.fixed_origin, *frames.moving_origin]
    with mpmath.workdps(50):
        d, turn = exact_poses(poses)

        def gradient(c1, c2, m1, m2):
            # Of the sum of (f - mean f)², f = |m e + d - c|² continued to complex unknowns.
            rows = []
            for place, e in zip(d, turn, strict=True):
                x = m1 * e.real - m2 * e.imag + place.real - c1
                y = m1 * e.imag + m2 * e.real + place.imag - c2
                f = x * x + y * y
                rows.append([f, -x, -y, x * e.real + y * e.imag, y * e.real - x * e.imag])
            mean = [sum(column) / len(d) for column in zip(*rows, strict=True)]
            return [
                sum((row[0] - mean[0]) * (row[k] - mean[k]) for row in rows) for k in range(1, 5)
            ]

        for point in critical.points[:25]:
            start = [
                mpmath.mpf(float(frames.length)) * mpmath.mpmathify(complex(p)) + float(o)
                for p, o in zip(point, origin, strict=True)
            ]
            x = mpmath.findroot(gradient, start, tol=1e-60, maxsteps=30)
            for a, b in zip(x, start, strict=True):
                assert max(abs((a - b).real), abs((a - b).imag)) <= radius


@pytest.mark.parametrize("seed", range(3))
def test_far_origins_and_small_units_change_nothing(seed):
    poses = noisy_task(seed)
    far = Displacement(1e-3 * poses.translation + [1e3, -2e3], poses.angle)
    critical, dyads = reported(far)
    certificate = certify(far, None, critical, dyads)
    assert certificate.complete
    check_dyads(far, None, certificate, dyads)


@pytest.mark.parametrize("seed", range(3))
def test_a_dyad_that_is_off_is_not_proved(seed):
    poses = noisy_task(seed)
    critical, dyads = reported(poses)
    proved = [item.proved for item in certify(poses, None, critical, dyads).dyads]
    for k, dyad in enumerate(dyads):
        if isinstance(dyad, RR):
            c, m, r = dyad.fixed_pivot, dyad.moving_pivot, dyad.radius
            size = 1 + np.abs(c).max() + np.abs(m).max() + r

            def moved(by, c=c, m=m, r=r):
                return [
                    RR(c + np.array([by, 0]), m, r),
                    RR(c, m + np.array([0, by]), r),
                    RR(c, m, r + by),
                ]
        else:
            pivot = dyad.moving_pivot if isinstance(dyad, PR) else dyad.fixed_pivot
            size = 1 + np.abs(pivot).max() + abs(dyad.offset)

            def moved(by, dyad=dyad, pivot=pivot):
                name = "moving_pivot" if isinstance(dyad, PR) else "fixed_pivot"
                return [
                    replace(dyad, offset=dyad.offset + by),
                    replace(dyad, normal_angle=dyad.normal_angle - by),
                    replace(dyad, **{name: pivot + np.array([by, 0])}),
                ]

        wrong = certify(poses, None, critical, moved(1e-6 * size))
        assert not any(item.proved or item.minimum for item in wrong.dyads)
        near = certify(poses, None, critical, moved(1e-10))
        assert [item.proved for item in near.dyads] == [proved[k]] * 3
        assert all(max(i.radius, i.angle_radius) > 0.9e-10 for i in near.dyads)


def test_a_circle_that_is_no_minimum_and_a_line_that_is_not_the_best():
    poses = noisy_task(1)
    critical = critical_dyads(poses)
    other = critical.real & ~critical.minimum
    saddle = critical.dyads[np.flatnonzero(other)[0]]
    with mpmath.workdps(50):
        x, least = true_circle(poses, None, saddle)
    assert least < 0
    saddle = RR(np.array(x[:2], float), np.array(x[2:4], float), np.array(float(x[4])))
    second = fixed_lines(poses)[0][1]
    certificate = certify(poses, None, critical, [saddle, second, PP(np.array(0.1))])
    assert [item.proved for item in certificate.dyads] == [False, True, False]
    assert not any(item.minimum for item in certificate.dyads)
    assert said(certificate, r"dyad 2 \(PR\).*stationary, and not the best")


def tampered(critical):
    """Lists of critical points that are wrong, each in one way."""
    k = int(np.flatnonzero(~critical.real)[0])
    points = critical.points.copy()
    points[k] += 1e-6 * (1 + np.abs(points[k]).max())
    yield replace(critical, points=points)
    points = critical.points.copy()
    points[k + 1] = points[k]
    yield replace(critical, points=points)
    yield replace(critical, found=critical.found - 1)
    for at in np.flatnonzero(critical.real):
        flags = critical.minimum.copy()
        flags[at] = ~flags[at]
        yield replace(critical, minimum=flags)
    real = critical.real.copy()
    real[k] = True
    yield replace(critical, real=real)
    real = critical.real.copy()
    real[0] = False
    yield replace(critical, real=real)


@pytest.mark.parametrize("seed", range(2))
def test_a_list_with_a_fault_is_not_complete(seed):
    poses = noisy_task(seed)
    critical = critical_dyads(poses)
    assert certify(poses, None, critical, []).complete
    for wrong in tampered(critical):
        certificate = certify(poses, None, wrong, [])
        assert not certificate.complete
        assert not said(certificate, "local minima|global")
        assert len(certificate.numerical) > 1
    moved, double, *_ = (certify(poses, None, each, []) for each in tampered(critical))
    lost = "critical points are computed, not proved"
    assert any(lost in text for text in (*moved.numerical, *double.numerical))


def test_without_the_points_at_infinity_nothing_is_complete(monkeypatch):
    poses = noisy_task(0)
    monkeypatch.setattr(
        "burmester.certificates.certificate.infinity_takes_eight", lambda gram: False
    )
    certificate = certify(poses, None, critical_dyads(poses), [])
    assert not certificate.complete
    assert not said(certificate, f"{NO_OTHERS}|global")


def test_the_global_minimum_is_claimed_of_the_least_only():
    poses = noisy_task(0)
    critical = critical_dyads(poses)
    assert said(certify(poses, None, critical, []), "global minimum")
    assert critical.minimum[:2].all()
    points = critical.points.copy()
    points[:2] = points[1::-1]
    certificate = certify(poses, None, replace(critical, points=points), [])
    assert certificate.complete
    assert not said(certificate, "global minimum")
    rows = random_poses(random_four_bar(np.random.default_rng(0)), np.random.default_rng(1), 5)
    five = Displacement.from_poses(rows)  # several minima of residual zero
    certificate = certify(five, None, critical_dyads(five), [])
    assert certificate.complete
    assert not said(certificate, "global minimum")


def test_poses_that_differ_from_those_computed_are_found_out():
    poses = noisy_task(3)
    critical, dyads = reported(poses)
    other = Displacement(
        poses.translation, poses.angle + 1e-5 * np.sin(np.arange(len(poses.angle)))
    )
    certificate = certify(other, None, critical, dyads)
    assert not certificate.complete
    assert not any(item.proved for item in certificate.dyads)


def special_motions():
    """Motions whose dyads are infinitely many, or that repeat themselves."""
    rng = np.random.default_rng(5)
    t = np.sort(rng.uniform(0, 5, 9))
    one, zero = np.ones(9), np.zeros(9)
    yield "translation", np.column_stack([t, t**2, 0.3 * one])
    yield "parallelogram", np.column_stack([np.cos(t), np.sin(t), zero])
    yield "turn", np.column_stack([zero, zero, t])
    yield "turn about a point", np.column_stack([np.cos(t), np.sin(t), t])
    yield "two sliders", np.column_stack([np.cos(t), zero, t])
    yield "two angles", np.column_stack([t, np.cos(7 * t), np.arange(9) % 2])
    yield "repeated", np.repeat(rng.normal(size=(3, 3)), 3, axis=0)
    yield "six of nine", rng.normal(size=(6, 3))[[0, 1, 2, 3, 4, 5, 0, 1, 2]]
    yield "identical", np.ones((9, 3))


@pytest.mark.parametrize(("name", "rows"), list(special_motions()))
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_special_motions_are_never_overstated(name, rows):
    poses = Displacement.from_poses(rows)
    critical, dyads = reported(poses)
    certificate = certify(poses, None, critical, dyads)
    check_dyads(poses, None, certificate, dyads)
    if name == "six of nine":  # a sound task with weights
        assert certificate.complete
    elif name != "turn about a point":  # that one's doubles turn about it nearly, no more
        assert not certificate.complete
        assert not said(certificate, NO_OTHERS)


# --- why there are no others: the points at infinity


PRIME = 10**9 + 9  # has a square root of -1
ROOT = 430477711


def isotropic(gram):
    """The same form on (1, g, g*, h, h*, g h*, g* h), modulo the prime."""
    half = pow(2, -1, PRIME)
    change = np.zeros((7, 7), dtype=object)
    change[0, 0] = 1
    for k in (1, 3, 5):
        change[k : k + 2, k : k + 2] = [[half, half], [-ROOT * half, ROOT * half]]
    return (change.T @ gram.astype(object) @ change) % PRIME


def local_multiplicities(gram, prime=PRIME):
    """Dimensions of the local ring at the point at infinity, to rising order, in whole numbers.

    gram: symmetric, on (1, g, g*, h, h*, g h*, g* h).  Macaulay's matrices of the derivatives
    in g, h, c0, m0, as worked out by hand; once the dimension repeats it is the multiplicity.
    """

    def add(*polys):
        total = {}
        for p in polys:
            for e, value in p.items():
                total[e] = (total.get(e, 0) + value) % prime
        return total

    def times(p, q):
        terms = product(p.items(), q.items())
        return add(
            *({tuple(a + b for a, b in zip(e, f, strict=True)): v * w} for (e, v), (f, w) in terms)
        )

    g, h, c0, m0 = ({tuple(int(j == k) for j in range(4)): 1} for k in range(4))
    v = [times(c0, m0), times(g, m0), m0, times(c0, h), c0, g, h]
    big = [
        add(*({e: int(f) * n for e, n in p.items()} for f, p in zip(row, v, strict=True)))
        for row in gram
    ]
    equations = [
        add(times(m0, big[1]), big[5]),
        add(times(m0, big[2]), times(h, big[6])),
        add(times(c0, big[3]), big[6]),
        add(times(c0, big[4]), times(g, big[5])),
    ]
    sizes = []
    for order in range(5):
        monomials = [e for e in product(range(order + 1), repeat=4) if sum(e) <= order]
        rows = []
        for e in monomials:
            for p in equations:
                q = times(p, {e: 1})
                rows.append([q.get(f, 0) for f in monomials])
        sizes.append(len(monomials) - rank(rows, prime))
    return sizes


def rank(rows, prime):
    found = 0
    for column in range(len(rows[0])):
        pivot = next((r for r in rows if r[column]), None)
        if pivot is None:
            continue
        found += 1
        scale = pow(pivot[column], -1, prime)
        rows = [
            [(a - r[column] * scale * b) % prime for a, b in zip(r, pivot, strict=True)]
            if r[column]
            else r
            for r in rows
            if r is not pivot
        ]
    return found


def test_a_point_at_infinity_counts_four_in_whole_numbers():
    rows = np.random.default_rng(4).integers(-9, 10, size=(6, 7))
    assert local_multiplicities(isotropic(rows.T @ rows)) == [1, 3, 4, 4, 4]


def test_conditions_at_infinity_agree_with_whole_numbers():
    assert ROOT * ROOT % PRIME == PRIME - 1
    rng = np.random.default_rng(6)
    seen = []
    for _ in range(40):
        gram = np.triu(rng.integers(-1, 2, size=(7, 7)) * (rng.random((7, 7)) < 0.35))
        gram = gram + gram.T
        ball = flint.arb_mat([[int(v) for v in row] for row in gram])
        seen.append(local_multiplicities(isotropic(gram))[-2:] == [4, 4])
        assert infinity_takes_eight(ball) == seen[-1]
    assert 5 < sum(seen) < 35


@pytest.mark.parametrize(
    ("squares", "eight"),
    [
        ([1, 1, 2, 1, 3, 1, 1], True),
        ([1, 1, 1, 1, 3, 1, 1], False),  # c1² + c2² = g g* leaves (g*)² out
        ([1, 1, 2, 1, 1, 1, 1], False),  # m1² + m2² = h h* leaves (h*)² out
        ([1, 1, 2, 1, 3, 1, 0], False),  # (g h* + g* h)² tells no g from h
        ([0, [0, 1, 0, 1, 0, 0, 0], 0, 0, 0, 1, 1], False),  # (c1 + m1)²: g* + h* may vanish
        # (c1 + m1)² + 4 (c2 + m2)²: on (g*, h*) a square too, on (g*, h) it is none
        ([0, [0, 1, 0, 1, 0, 0, 0], [0, 0, 2, 0, 2, 0, 0], 0, 0, 1, 1], False),
    ],
)
def test_conditions_at_infinity_by_hand(squares, eight):
    gram = np.zeros((7, 7))
    for k, square in enumerate(squares):
        form = np.array(square if isinstance(square, list) else np.sqrt(square) * np.eye(7)[k])
        gram += np.outer(form, form)
    ball = flint.arb_mat([[float(v) for v in np.round(row, 9)] for row in gram])
    assert infinity_takes_eight(ball) == eight


# --- five poses


@pytest.mark.parametrize("seed", range(12))
def test_all_dyads_of_five_poses_are_proved(seed):
    rng = np.random.default_rng(seed)
    rows = random_poses(random_four_bar(rng), rng, 5) if seed % 2 else rng.normal(size=(5, 3))
    poses = Displacement.from_poses(rows)
    five = dyads_of_five(poses)
    dyads = [five.dyads[k] for k in np.flatnonzero(five.real)]
    certificate = certify_five(poses, five, dyads)
    assert certificate.complete
    assert said(certificate, NO_OTHERS)
    assert said(certificate, f"; {five.real.sum()} are real, {4 - five.real.sum()} are not")
    assert all(item.proved and item.minimum for item in certificate.dyads)
    with mpmath.workdps(50):
        d, turn = exact_poses(poses)

        def circles(c1, c2, m1, m2, r):
            m, c = mpmath.mpc(m1, m2), mpmath.mpc(c1, c2)
            arms = [m * e + place - c for place, e in zip(d, turn, strict=True)]
            return [a.real**2 + a.imag**2 - r * r for a in arms]

        for item, dyad in zip(certificate.dyads, dyads, strict=True):
            start = [float(v) for v in (*dyad.fixed_pivot, *dyad.moving_pivot, dyad.radius)]
            x = mpmath.findroot(circles, start, tol=1e-70, maxsteps=30)
            assert gap_of_circle(dyad, x) <= item.radius + TINY
            assert item.radius < 1e-8 * (1 + abs(x[4]))
    size = 1 + max((float(d.radius) for d in dyads), default=0.0)
    wrong = [RR(d.fixed_pivot + 1e-5 * size, d.moving_pivot, d.radius) for d in dyads]
    assert not any(item.proved for item in certify_five(poses, five, wrong).dyads)


def test_a_root_with_a_fault_is_not_counted():
    rng = np.random.default_rng(1)
    poses = Displacement.from_poses(random_poses(random_four_bar(rng), rng, 5))
    five = dyads_of_five(poses)
    assert certify_five(poses, five, []).complete
    twice = five.roots.copy()
    twice[3] = twice[2]
    off = five.roots.copy()
    off[1] += 1e-5
    for roots in (twice, off):
        certificate = certify_five(poses, replace(five, roots=roots), [])
        assert not certificate.complete
        assert not said(certificate, NO_OTHERS)
    certificate = certify_five(poses, replace(five, real=~five.real), [])
    assert not certificate.complete


@pytest.mark.parametrize("seed", range(3))
def test_sliders_of_five_poses_are_not_claimed(seed):
    rng = np.random.default_rng(seed)
    dyads = random_four_bar(rng, second=PR)
    poses = Displacement.from_poses(random_poses(dyads, rng, 5))
    five = dyads_of_five(poses)
    certificate = certify_five(poses, five, dyads)
    assert certificate.complete
    assert [item.proved for item in certificate.dyads] == [True, False]
    assert certificate.numerical[-1].startswith("dyad 2 (PR): only computed")


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_five_poses_of_special_motions_are_never_overstated():
    t = np.array([0.1, 0.5, 1.3, 2.0, 2.9])
    for rows in (
        np.column_stack([np.cos(t), np.sin(t), 0 * t]),
        np.column_stack([np.cos(t), 0 * t, t]),
        np.column_stack([0 * t, 0 * t, t]),
        np.column_stack([t, np.cos(9 * t), [0, 0, 0, 1, 1]]),
        np.column_stack([t, t**2, t])[[0, 1, 2, 3, 3]],
        np.ones((5, 3)),
    ):
        poses = Displacement.from_poses(rows)
        certificate = certify_five(poses, dyads_of_five(poses), [])
        assert not certificate.complete
        assert not said(certificate, NO_OTHERS)


def test_without_python_flint_the_way_to_get_it_is_told(monkeypatch):
    poses = noisy_task(0)
    critical = critical_dyads(poses)
    monkeypatch.setitem(sys.modules, "flint", None)
    balls.flint.cache_clear()
    with pytest.raises(InputError) as caught:
        certify(poses, None, critical, [])
    assert caught.value.code == "E130"
    assert "burmester[certify]" in caught.value.help
