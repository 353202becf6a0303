"""A linkage that is let go: energy, Lagrange's equation by SciPy, and the simulator MuJoCo."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from burmester.errors import InputError
from burmester.loads.loaded_motion import LoadedLinkage
from burmester.loads.swing import swing
from burmester.tasks.loads import STANDARD_GRAVITY as G
from burmester.tasks.loads import End, Loads, Mass, Spring
from tests.oracles.handed_over import rr
from tests.oracles.loaded_linkages import (
    KINDS,
    driven_at,
    linkage_of,
    loaded_linkage,
    random_loads,
)

CRANK = (rr([0, 0], [0, 0], 100), rr([300, 0], [280, 0], 200))
WIDE = np.radians([-150, -100, -60, 30])
MASSES = Loads(
    body=Mass(2.0, [150, 40], 0.03),
    links={"driver": 0.5, "follower": 0.8},
    springs=(
        Spring(
            "extension",
            (End("ground", (-50, 200)), End("body", (60, 10))),
            {"rate_N_per_mm": 0.05, "free_length": 0},
        ),
    ),
)


def conservative(rng, names, metre):
    """Loads that have an energy; some springs go slack on the way."""
    return replace(random_loads(rng, names, metre), forces=(), torque=0.0)


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("kind", KINDS)
def test_a_swing_keeps_its_energy(kind, seed):
    _, linkage = loaded_linkage(kind, seed, conservative, unit="m")
    start = float(np.random.default_rng(seed).uniform(0.1, 0.9))
    told = swing(linkage, start, 2.0)
    assert told.share[0] == pytest.approx(start, abs=1e-12)
    size = np.abs(told.energy[0]) + np.ptp(linkage.at(101).energy)
    assert np.ptp(told.energy) <= 1e-9 * size
    assert told.time == pytest.approx(np.linspace(0, 2, 201)[: len(told.time)])
    assert told.ended == (len(told.time) < 201)
    here = linkage.at_driver(told.share)
    own = here.energy + here.inertia[0] * told.speed**2 / 2
    assert np.ptp(own) <= 1e-9 * size
    if len(told.time) > 4:
        speed = np.gradient(told.drive, told.time, edge_order=2)[1:-1]
        assert np.abs(speed - told.speed[1:-1]).max() <= 0.1 * np.abs(told.speed).max()


def lagrange(loads, metre=1e-3):
    """State' of the four-bar, from its two angles and their rates by the loop's closed form.

    The crank's angle q is the coordinate; T = I(q) q'²/2, and V(q).  I' and V' come from
    differences of formulas that are exact, in steps of the complex kind: f'(q) = Im f(q + ih)/h.
    """
    a, b, c, d = 0.1, 0.28, 0.2, 0.3
    crank, rocker = loads.links["driver"], loads.links["follower"]
    body, (x, y) = loads.body, np.array(loads.body.center) * metre
    (spring,) = loads.springs
    stiff = 1000 * spring["rate_N_per_mm"]
    fixed, held = (np.array(end.point) * metre for end in spring.ends)

    def angles(q):
        """Coupler and rocker, of q that may be complex; by the half angle of Freudenstein."""
        px, py = a * np.cos(q), a * np.sin(q)
        ux, uy = d - px, -py
        # |(px, py) + b e^(i t) - (d, 0)| = c: b (ux cos t + uy sin t) = (b² + u² - c²) / 2
        e = (b * b + ux * ux + uy * uy - c * c) / (2 * b)
        far = np.sqrt(ux * ux + uy * uy)
        t = arctan2(uy, ux) - np.arccos(e / far)
        rx, ry = px + b * np.cos(t) - d, py + b * np.sin(t)
        return t, arctan2(ry, rx)

    def points(q):
        t, r = angles(q)
        px, py = a * np.cos(q), a * np.sin(q)

        def of_body(at):
            return (
                px + at[0] * np.cos(t) - at[1] * np.sin(t),
                py + at[0] * np.sin(t) + at[1] * np.cos(t),
            )

        middle = d + c / 2 * np.cos(r), c / 2 * np.sin(r)
        return t, (px / 2, py / 2), of_body((x, y)), middle, of_body(held)

    def potential(q):
        _, one, two, three, end = points(q)
        heights = crank * one[1] + body.mass_kg * two[1] + rocker * three[1]
        away = (end[0] - fixed[0]) ** 2 + (end[1] - fixed[1]) ** 2
        return G * heights + stiff * away / 2

    h = 1e-30

    def inertia(q):
        """By rates from complex steps: of real q alone."""
        t, one, two, three, _ = points(q + 1j * h)
        total = body.inertia_kgm2 * (t.imag / h) ** 2
        for mass, at in ((crank, one), (body.mass_kg, two), (rocker, three)):
            total += mass * ((at[0].imag / h) ** 2 + (at[1].imag / h) ** 2)
        return total

    def rates(_, state):
        q, speed = state
        slope = (inertia(q + 1e-5) - inertia(q - 1e-5)) / 2e-5
        bent = (inertia(q + 2e-5) - inertia(q - 2e-5)) / 4e-5
        slope = slope + (slope - bent) / 3
        push = potential(q + 1j * h).imag / h
        return [speed, -(slope * speed**2 / 2 + push) / inertia(q)]

    return rates


def arctan2(y, x):
    """Of complex numbers near real ones."""
    real = np.arctan2(np.real(y), np.real(x))
    turn = (x + 1j * y) * np.exp(-1j * real) if np.isrealobj(x + 0 * y) else None
    if turn is not None:
        return real
    # The rest is small: tan of the difference.
    c, s = np.cos(real), np.sin(real)
    return real + (y * c - x * s) / (x * c + y * s)


@pytest.mark.parametrize("start", [0.15, 0.4, 0.7])
def test_a_four_bar_swings_as_lagranges_equation_has_it(start):
    chosen = driven_at(CRANK, WIDE, MASSES)
    told = swing(LoadedLinkage.of(chosen), start, 2.0)
    # The witness and the formula close the loop on the same side.
    solved = solve_ivp(
        lagrange(MASSES), (0, told.time[-1]), [told.drive[0], 0.0], rtol=1e-10, atol=1e-12,
        t_eval=told.time, method="DOP853",
    )  # fmt: skip
    assert len(told.time) > 20
    assert np.abs(np.angle(np.exp(1j * (solved.y[0] - told.drive)))).max() < 1e-7
    assert np.abs(solved.y[1] - told.speed).max() < 1e-6


def test_a_pendulum_has_its_period():
    """All mass at the end of the crank: its period by the mean of Gauss."""
    loads = Loads(springs=(Spring("counterweight", (End("ground", (0, 0)), End("driver", (100, 0))),
                                  {"mass_kg": 2}),))  # fmt: skip
    chosen = driven_at(CRANK, np.radians([-150, -120, -60, -40]), loads)
    amplitude = np.radians(40)
    start = 20 / 110  # 130 degrees below
    told = swing(LoadedLinkage.of(chosen), start, 2.0, 2001)
    assert not told.ended
    one, other = 1.0, np.cos(amplitude / 2)
    for _ in range(20):
        one, other = (one + other) / 2, np.sqrt(one * other)
    period = 2 * np.pi / one * np.sqrt(0.1 / G)
    bottom = told.drive - 1.5 * np.pi
    crossed = np.flatnonzero(bottom[:-1] * bottom[1:] < 0)
    times = told.time[crossed] - bottom[crossed] * np.diff(told.time)[0] / np.diff(bottom)[crossed]
    assert np.diff(times) == pytest.approx(np.full(len(times) - 1, period / 2), rel=1e-5)
    assert np.abs(bottom).max() == pytest.approx(amplitude, rel=1e-9)


def test_at_rest_in_balance_it_stays():
    loads = Loads(gravity="none", body=Mass(1.0, [0, 0]))
    told = swing(LoadedLinkage.of(driven_at(CRANK, WIDE, loads)), 0.3, 1.0, 11)
    assert told.share == pytest.approx(np.full(11, 0.3), abs=1e-14)
    assert not told.ended


def test_it_ends_where_the_motion_does():
    loads = Loads(body=Mass(1.0, [0, 0]))
    told = swing(LoadedLinkage.of(driven_at(CRANK, np.radians([80, 60, 40]), loads)), 0.5, 2.0)
    assert told.ended
    assert told.share[-1] <= 1
    assert (np.diff(told.share) > 0).all()


def test_what_weighs_nothing_does_not_swing():
    spring = Spring("constant", (End("ground", (0, 300)), End("body", (0, 0))), {"force_N": 3})
    chosen = driven_at(CRANK, WIDE, Loads(springs=(spring,)))
    with pytest.raises(InputError, match="has a mass") as caught:
        swing(LoadedLinkage.of(chosen), 0.5, 1.0)
    assert caught.value.code == "E177"


@pytest.mark.parametrize("seed", range(25))
def test_springs_that_go_slack_keep_energy_nearly(seed):
    """Their force has a kink, which polynomials round off."""

    def loads(rng, names, metre):
        return replace(random_loads(rng, names, metre), forces=(), torque=0.0)

    rng = np.random.default_rng([7, seed])
    linkage = LoadedLinkage.of(linkage_of("RR-RR", rng, loads, "m"))
    told = swing(linkage, 0.5, 2.0)
    here = linkage.at_driver(told.share)
    own = here.energy + here.inertia[0] * told.speed**2 / 2
    assert np.ptp(own) <= 1e-5 * (np.abs(own[0]) + np.ptp(linkage.at(101).energy))
