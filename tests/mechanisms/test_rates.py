"""Velocities and accelerations: against differences of places, closed forms, and at dead points."""

import warnings

import numpy as np
import pytest

from burmester.fourbar.bodies import bodies_of_four_bar, places_of_bodies
from burmester.fourbar.dyad import PR, RR
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.mechanisms.bodies import GROUND
from burmester.mechanisms.rates import rates
from tests.oracles.handed_over import pr, rr
from tests.oracles.loaded_linkages import (
    KINDS,
    PAIRS,
    SIX_BARS,
    WATT,
    Model,
    differences,
    four_bar,
    six_bar,
    turned_by,
)
from tests.oracles.relabelled import renamed

STEP = 2e-3


def linkage_at_places(kind, rng):
    """A linkage of a kind, its driver at 11 places between its poses, and the bodies' places."""
    made = None
    while made is None:
        made = six_bar(kind, rng) if kind in SIX_BARS else four_bar(PAIRS[KINDS.index(kind)], rng)
    motion = made.travel()(np.linspace(0.05, 0.95, 11))
    return made, motion.drive, motion.places


def require_rates(own, model, drive, body):
    """The rates of all bodies are the differences of the model's places."""
    near = body.translation @ [1, 1j], turned_by(body.angle)
    for k, name in enumerate(own.bodies):
        at = differences(lambda h, name=name: model.at(drive + h, near)[name][0], STEP)
        here = model.at(drive, near)[name][1]
        turn = differences(
            lambda h, name=name, here=here: np.angle(model.at(drive + h, near)[name][1] / here),
            STEP,
        )
        told = (own.velocity[:, k], own.acceleration[:, k])
        for value, origin, angle in zip(told, at, turn, strict=True):
            size = 1 + np.abs(value).max()
            assert np.abs(value[:, :2] @ [1, 1j] - origin).max() < 1e-6 * size, name
            assert np.abs(value[:, 2] - angle).max() < 1e-6 * size, name


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("kind", KINDS)
def test_rates_are_differences_of_places(kind, seed):
    made, drive, body = linkage_at_places(kind, np.random.default_rng([seed, KINDS.index(kind)]))
    own = rates(made.bodies, made.bodies_at(drive, body))
    require_rates(own, Model.of(made), drive, body)
    assert own.turns == (not kind.startswith("PR"))


@pytest.mark.parametrize("seed", range(8))
def test_a_made_up_class_has_the_rates_of_its_places(seed):
    """Another link is the ground's neighbour and the body, and all names are others."""
    rng, other = np.random.default_rng(seed), None
    while other is None:
        made, *_ = linkage_at_places(WATT, rng)
        try:
            other = renamed(made)
            drive = other.along(13)[1:-1]
            there = other.links(drive + 3 * STEP), other.links(drive - 3 * STEP)
            if not all(np.isfinite(each["lever"].angle).all() for each in there):
                other = None
        except AssertionError:  # its driver turns back where that of the six-bar itself does not
            other = None
    body = other.body(drive)
    own = rates(other.bodies, other.bodies_at(drive, body))
    for k, name in enumerate(own.bodies):

        def place(h, name=name):
            at = other.bodies_at(drive + h, body)[name]
            return np.column_stack([at.translation, np.unwrap(at.angle)])

        first, second = differences(place, STEP)
        size = 1 + np.abs(own.acceleration[:, k]).max()
        assert np.abs(own.velocity[:, k] - first).max() < 1e-7 * size
        assert np.abs(own.acceleration[:, k] - second).max() < 1e-5 * size


def closed(first, second, places):
    """The rates of a four-bar at places of its coupler."""
    linkage = Linkage(first, second)
    return rates(bodies_of_four_bar(linkage), places_of_bodies(linkage, places))


def test_a_slider_crank_by_its_closed_form():
    """Its piston is at r cos q + (l² - r² sin² q)^(1/2), and q is the angle of its crank."""
    r, length = 1.3, 3.1
    q = np.linspace(-3, 3, 25)
    root = np.sqrt(length**2 - (r * np.sin(q)) ** 2)
    x = r * np.cos(q) + root
    angle = np.arcsin(-r * np.sin(q) / length)
    crank = np.column_stack([r * np.cos(q), r * np.sin(q)])
    own = closed(rr([0, 0], [0, 0], r), pr(90, 0, [length, 0]), Displacement(crank, angle))
    velocity, acceleration = own.of_body("follower")
    sine, cosine = np.sin(q), np.cos(q)
    speed = -r * sine - r**2 * sine * cosine / root
    bent = -r * cosine - r**2 * (cosine**2 - sine**2) / root - (r**2 * sine * cosine) ** 2 / root**3
    assert velocity == pytest.approx(np.column_stack([speed, 0 * q, 0 * q]), abs=1e-13)
    assert acceleration == pytest.approx(np.column_stack([bent, 0 * q, 0 * q]), abs=1e-12)
    # The same piston drives the crank: q' = 1 / x', q'' = -x'' / x'³.
    moving = np.abs(speed) > 0.1
    places = Displacement(crank[moving], angle[moving])
    pushed = closed(pr(90, 0, [length, 0]), rr([0, 0], [0, 0], r), places)
    assert not pushed.turns
    one, two = pushed.of_body("follower")
    way = 1.0 if np.isclose(pushed.of_body("driver")[0][:, 0], 1.0).all() else -1.0
    assert one[:, 2] == pytest.approx(way / speed[moving], rel=1e-11)
    assert two[:, 2] == pytest.approx(-bent[moving] / speed[moving] ** 3, rel=1e-10, abs=1e-10)
    assert x[moving] == pytest.approx(places.act(np.array([length, 0]))[:, 0], abs=1e-13)


def test_a_four_bar_by_its_closed_form():
    """The angular speeds and accelerations of coupler and rocker, as the books have them."""
    a, b, c, d = 1.0, 2.7, 2.2, 3.0  # crank, coupler, rocker, ground
    q = np.linspace(0, 2 * np.pi, 41)
    pin = a * np.exp(1j * q)
    diagonal = d - pin
    inner = np.arccos((b**2 + np.abs(diagonal) ** 2 - c**2) / (2 * b * np.abs(diagonal)))
    coupler = np.angle(diagonal) + inner
    rocker = np.angle(pin + b * np.exp(1j * coupler) - d)
    own = closed(
        rr([0, 0], [0, 0], a),
        rr([d, 0], [b, 0], c),
        Displacement(np.column_stack([pin.real, pin.imag]), coupler),
    )
    w3 = a * np.sin(rocker - q) / (b * np.sin(coupler - rocker))
    w4 = a * np.sin(q - coupler) / (c * np.sin(rocker - coupler))
    e3 = (-a * np.cos(q - rocker) - b * w3**2 * np.cos(coupler - rocker) + c * w4**2) / (
        b * np.sin(coupler - rocker)
    )
    e4 = (a * np.cos(q - coupler) + b * w3**2 - c * w4**2 * np.cos(rocker - coupler)) / (
        c * np.sin(rocker - coupler)
    )
    for name, speed, bent in (("coupler", w3, e3), ("follower", w4, e4)):
        velocity, acceleration = own.of_body(name)
        assert velocity[:, 2] == pytest.approx(speed, abs=1e-12)
        assert acceleration[:, 2] == pytest.approx(bent, abs=1e-11)
    velocity, acceleration = own.of_body("driver")
    assert velocity == pytest.approx(np.tile([0, 0, 1.0], (41, 1)), abs=1e-13)
    assert acceleration == pytest.approx(np.zeros((41, 3)), abs=1e-12)
    assert not any(each.any() for each in own.of_body(GROUND))


def stretched():
    """A rocker of 1 whose coupler of 2 and follower of 2.5 are in one line: it goes no further."""
    a, b, c, d = 1.0, 2.0, 2.5, 4.0
    cosine = (a * a + d * d - (b + c) ** 2) / (2 * a * d)
    q = np.arccos(cosine)
    pin = a * np.exp(1j * q)
    return (
        rr([0, 0], [0, 0], a),
        rr([d, 0], [b, 0], c),
        Displacement(np.array([[pin.real, pin.imag]]), np.array([np.angle(d - pin)])),
    )


def test_at_a_dead_point_nothing_is_told_and_nothing_is_divided():
    first, second, dead = stretched()
    beside = np.exp(1j * np.linspace(0.6, 0.9, 2))
    # Two other places of the same linkage come with it, and keep their rates.
    a, b, c, d = 1.0, 2.0, 2.5, 4.0
    diagonal = d - a * beside
    inner = np.arccos((b**2 + np.abs(diagonal) ** 2 - c**2) / (2 * b * np.abs(diagonal)))
    at = np.column_stack([beside.real, beside.imag])
    places = Displacement(
        np.concatenate([dead.translation, at]),
        np.concatenate([dead.angle, np.angle(diagonal) + inner]),
    )
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        own = closed(first, second, places)
        effort = own.effort(np.ones_like(own.velocity))
        forces = own.pin_forces(np.ones_like(own.velocity))
    for values in (own.velocity, own.acceleration, effort, forces):
        assert np.isnan(values[0]).all()
        assert np.isfinite(values[1:]).all()


def test_a_rail_across_which_the_crank_pulls_is_a_dead_point_of_its_slider():
    crank = Displacement(np.array([[1.0, 0.0]]), np.array([0.0]))
    own = closed(PR(np.pi / 2, 0.0, np.array([3.0, 0])), RR(np.zeros(2), np.zeros(2), 1.0), crank)
    assert np.isnan(own.velocity).all()


def test_a_unit_changes_lengths_alone():
    rng = np.random.default_rng(4)
    made, drive, body = linkage_at_places("RR-RP", rng)
    places = made.bodies_at(drive, body)
    plain, large = (
        rates(made.bodies.scaled(scale), places.scaled(scale)) for scale in (1.0, 1000.0)
    )
    lengths = np.array([1000.0, 1000.0, 1.0])
    assert large.velocity == pytest.approx(plain.velocity * lengths, rel=1e-11, abs=1e-9)
    assert large.acceleration == pytest.approx(plain.acceleration * lengths, rel=1e-11, abs=1e-8)
