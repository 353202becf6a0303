"""What holds a linkage under its loads: free bodies, energies, and sums of all forces."""

from dataclasses import replace

import numpy as np
import pytest

from burmester.loads.load_figures import load_figures
from burmester.loads.loaded_motion import LoadedLinkage
from tests.oracles.loaded_linkages import (
    KINDS,
    balanced,
    differences,
    loaded_linkage,
    masses_of,
    moved,
    potential,
    turned_by,
    wrenches,
)

NEAR = 1e-10
PLACES = np.linspace(0, 1, 7)
SEEDS = range(80)  # of 13 kinds: 1,040 linkages


def size_of(acting, loaded):
    """A size (n,) of efforts: of all forces, each where it may act at most."""
    return 1e-12 + sum(
        np.abs(force) * (loaded.of.metre if loaded.rates.turns else 1.0) + np.abs(moment)
        for own in acting.values()
        for force, _, moment in own
    )


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("kind", KINDS)
def test_virtual_work_is_the_balance_of_free_bodies(kind, seed):
    model, linkage = loaded_linkage(kind, seed)
    loaded = linkage.at(PLACES)
    places = moved(model, loaded)(0.0)
    for name in model.names:
        gap = places[name][0] - loaded.places[name].translation @ [1, 1j]
        assert np.abs(gap).max() < 1e-11 * linkage.metre
    acting = wrenches(model, places, linkage.loads, linkage.metre)
    effort, pins = balanced(model, places, acting, linkage.metre)
    assert np.abs(effort - loaded.effort).max() <= NEAR * size_of(acting, loaded).max()
    told = loaded.pin_forces(-loaded.applied)
    greatest = max(np.abs(each).max() for each in pins.values())
    assert told.keys() == pins.keys()
    for name, force in pins.items():
        assert np.abs(told[name] @ [1, 1j] - force).max() <= NEAR * greatest


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("kind", KINDS)
def test_effort_is_the_slope_of_the_potential(kind, seed):
    """Of forces that have one; of others the power of the force, by differences."""
    model, linkage = loaded_linkage(kind, seed)
    frame_f = tuple(each for each in linkage.loads.forces if each.frame == "F")
    turning = tuple(each for each in linkage.loads.forces if each.frame == "M")
    loaded, metre = linkage.at(PLACES[1:-1]), linkage.metre
    place = moved(model, loaded)
    h = 1e-3 * (1.0 if loaded.rates.turns else metre)
    kept = replace(linkage.loads, forces=frame_f, springs=(), torque=0.0)
    slope, _ = differences(lambda step: potential(model, place(step), kept, metre), h)
    turned, _ = differences(
        lambda step: np.angle(place(step)[model.body][1] / place(0.0)[model.body][1]), h
    )
    slope = slope - linkage.loads.torque * turned
    for spring in linkage.loads.springs:
        # Turns of a torsion spring count from the beginning of the motion.
        if spring.kind != "torsion":
            one = replace(kept, springs=(spring,), gravity=np.zeros(2), body=None, links={},
                          forces=(), torque=0.0)  # fmt: skip
            if spring.kind == "counterweight":
                one = replace(one, gravity=linkage.loads.gravity)
            slope = (
                slope
                + differences(lambda step, one=one: potential(model, place(step), one, metre), h)[0]
            )
    here = place(0.0)[model.body][1]
    for force in turning:
        arm = complex(*force.at) * metre
        speed, _ = differences(lambda step, arm=arm: _point(place(step), model.body, arm), h)
        slope = slope - (np.conj(here * complex(*force.force)) * speed).real
    torsion = tuple(each for each in linkage.loads.springs if each.kind == "torsion")
    held = loaded.effort.copy()
    for course in loaded.springs:
        if course.spring in torsion:
            held -= course.tension * course.rate
    acting = wrenches(model, place(0.0), linkage.loads, metre)
    assert np.abs(slope - held).max() <= 1e-5 * size_of(acting, loaded).max()


def _point(places, name, arm):
    at, turn = places[name]
    return at + turn * arm


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("kind", KINDS)
def test_effort_is_the_slope_of_the_energy_told(kind, seed):
    """Of weights and springs alone: differences of `energy` along the driver's way."""
    _, linkage = loaded_linkage(kind, seed)
    loads = replace(linkage.loads, forces=(), torque=0.0)
    linkage = LoadedLinkage.of(replace(linkage.found, task=replace(linkage.found.task,
                                                                   loads=loads)))  # fmt: skip
    inside = np.linspace(0.05, 0.95, 7)
    ends = linkage.at(2).drive
    h = 1e-3
    slope, _ = differences(lambda step: linkage.at_driver(inside + step).energy, h)
    slope /= ends[1] - ends[0]
    loaded = linkage.at_driver(inside)
    assert loaded.drive == pytest.approx(ends[0] + (ends[1] - ends[0]) * inside, rel=1e-12)
    near = 1e-6 * (np.abs(loaded.gross).max() + np.ptp(loaded.energy))
    near += 1e-12 * np.abs(loaded.energy).max() / (h * abs(ends[1] - ends[0]))  # rounding
    # A spring that goes slack between two places has no smooth energy: a few kinks are passed.
    assert np.median(np.abs(slope - loaded.effort)) <= near
    assert (np.abs(slope - loaded.effort) > near).sum() <= 2 * len(loads.springs)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("kind", KINDS)
def test_with_masses_that_resist_the_bodies_are_in_balance_too(kind, seed):
    """Newton and Euler: each mass resists by what differences tell of its acceleration."""
    model, linkage = loaded_linkage(kind, seed)
    loaded, metre = linkage.at(PLACES), linkage.metre
    rng = np.random.default_rng(seed)
    place = moved(model, loaded)
    unit = 1.0 if loaded.rates.turns else metre
    speed, push = (rng.normal(size=len(PLACES)) * unit * size for size in (2.0, 4.0))
    acting = wrenches(model, place(0.0), linkage.loads, metre)
    reduced, slope = 0 * speed, 0 * speed
    h = 1e-3 * unit
    for name, parts in masses_of(model, linkage.loads).items():
        here = place(0.0)[name][1]
        v_turn, a_turn = differences(
            lambda step, name=name, here=here: np.angle(place(step)[name][1] / here), h
        )
        for mass, centre, inertia in parts:
            v, a = differences(
                lambda step, name=name, arm=centre * metre: _point(place(step), name, arm), h
            )
            carried = mass * (a * speed**2 + v * push)
            turned = inertia * (a_turn * speed**2 + v_turn * push)
            at = _point(place(0.0), name, centre * metre)
            acting[name].append((-carried, at, -turned))
            reduced += mass * np.abs(v) ** 2 + inertia * v_turn**2
            slope += 2 * mass * (np.conj(v) * a).real + 2 * inertia * v_turn * a_turn
    effort, pins = balanced(model, place(0.0), acting, metre)
    resisted = loaded.carried(speed, push) - loaded.applied
    size = size_of(acting, loaded).max()
    assert np.abs(effort - loaded.rates.effort(resisted)).max() <= 1e-6 * size
    greatest = max(np.abs(each).max() for each in pins.values())
    for name, force in loaded.pin_forces(resisted).items():
        assert np.abs(force @ [1, 1j] - pins[name]).max() <= 1e-6 * greatest
    told, told_slope = loaded.inertia
    assert np.abs(told - reduced).max() <= 1e-7 * np.abs(reduced).max()
    assert np.abs(told_slope - slope).max() <= 1e-5 * (np.abs(slope).max() + reduced.max() / unit)
    # Eksergian's equation is the same effort.
    by_energy = told * push + told_slope * speed**2 / 2 + loaded.effort
    assert np.abs(by_energy - loaded.rates.effort(resisted)).max() <= 1e-11 * size


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("kind", [each for each in KINDS if "P" not in each])
def test_all_that_acts_from_the_ground_balances_all_that_acts_on_the_bodies(kind, seed):
    """The forces of the pins on the ground, and of springs that are fixed there, sum up to all."""
    model, linkage = loaded_linkage(kind, seed)
    loaded = linkage.at(PLACES)
    told = loaded.pin_forces(-loaded.applied)
    places = moved(model, loaded)(0.0)
    acting = wrenches(model, places, linkage.loads, linkage.metre)
    total = sum(force for name in model.names for force, _, _ in acting[name])
    greatest = max(np.abs(each).max() for each in told.values()) + np.abs(total).max()
    for one, other, _, _, letter in model.pins:
        force = told[letter] @ [1, 1j]
        if one == "ground":
            total = total - force
        elif other == "ground":
            total = total + force
    assert np.abs(total).max() <= 1e-10 * greatest


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("kind", KINDS)
def test_figures_are_those_of_a_dense_scan(kind, seed):
    """The least and the greatest are those of 20,000 places, to a thousandth of the greatest."""
    model, linkage = loaded_linkage(kind, seed)
    figures, dense = load_figures(linkage.found), linkage.at(20_000)
    assert model.names == linkage.bodies.moving
    near = 1e-3 * (np.abs(dense.effort).max() + 1e-9)
    assert figures.effort.least == pytest.approx(dense.effort.min(), abs=near)
    assert figures.effort.greatest == pytest.approx(dense.effort.max(), abs=near)
    if figures.hand is not None:
        push = dense.hand_force(dense.effort)
        near = 1e-3 * np.nanmax(np.abs(push))
        assert figures.hand.least == pytest.approx(np.nanmin(push), abs=near)
        assert figures.hand.greatest == pytest.approx(np.nanmax(push), abs=near)
    for name, force in dense.pins.items():
        assert figures.pins[name] == pytest.approx(np.hypot(*force.T).max(), rel=1e-3)
    for told, course in zip(figures.springs, dense.springs, strict=True):
        assert told.spring is course.spring
        scale = np.degrees(1) if course.spring.kind == "torsion" else 1 / linkage.metre
        found = scale * course.length.min(), scale * course.length.max()
        assert told.length == pytest.approx(found, abs=2e-3 * (np.ptp(found) + 1e-9))
        assert told.tension == pytest.approx(
            (course.tension.min(), course.tension.max()),
            abs=2e-3 * (np.ptp(course.tension) + 1e-9),
        )


def test_places_alone_have_the_loads_of_places_in_a_row():
    """Whatever else is looked at beside a place, its effort and its springs are the same."""
    for seed in range(12):
        _, linkage = loaded_linkage("RR-RR", seed)
        row = linkage.at(41)
        for k in (0, 13, 40):
            alone = linkage.at(np.linspace(0, 1, 41)[[k]])
            assert alone.effort[0] == pytest.approx(row.effort[k], rel=1e-12, abs=1e-12)
            for one, other in zip(alone.springs, row.springs, strict=True):
                assert one.tension[0] == pytest.approx(other.tension[k], rel=1e-12)


def test_moments_of_pins_about_the_drivers_pivot_are_its_torque():
    """By the balance of the crank alone, which bears no loads of its own."""
    checked = 0
    for seed in range(40):
        _, linkage = loaded_linkage("RR-RR", seed)
        ends = {end.link for spring in linkage.loads.springs for end in spring.ends}
        if "driver" in ends or "driver" in linkage.loads.links:
            continue
        loaded = linkage.at(PLACES)
        force = loaded.pin_forces(-loaded.applied)["B"] @ [1, 1j]  # on the coupler
        arm = turned_by(loaded.drive) * float(linkage.found.linkage.first.radius) * linkage.metre
        torque = (np.conj(arm) * force).imag
        assert torque == pytest.approx(loaded.effort, rel=1e-10, abs=1e-12)
        checked += 1
    assert checked >= 5
