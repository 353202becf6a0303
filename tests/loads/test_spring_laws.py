"""The force of each kind of spring by its length, by hand, and its energy."""

import numpy as np
import pytest

from burmester.errors import InputError
from burmester.loads.spring_laws import SpringLaw
from burmester.tasks.load_table import NEEDED, POSSIBLE, SpringKind
from burmester.tasks.loads import End, Mass, Plates, Spring

ENDS = (End("ground", (0, 0)), End("body", (0, 0)))


def law(kind, numbers, count=1, celsius=20.0, metre=1e-3):
    return SpringLaw.of(Spring(kind, ENDS, numbers, count), metre, celsius)


# kind, numbers (millimetres), lengths in millimetres, pulls in N by hand
CASES = {
    "extension": ({"rate_N_per_mm": 2, "free_length": 50}, {50: 0, 60: 20, 55: 10, 40: 0}),
    "initial tension": (
        {"rate_N_per_mm": 2, "free_length": 50, "initial_N": 6},
        {50: 6, 60: 26, 49: 4, 47: 0, 40: 0},
    ),
    "no free length": ({"rate_N_per_mm": 2, "free_length": 0}, {0: 0, 30: 60}),
    "compression": ({"rate_N_per_mm": 3, "free_length": 80}, {80: 0, 70: -30, 90: 0, 40: -120}),
    "gas": (
        {"force_N": 350, "compressed_force_N": 480, "stroke": 250, "length": 605},
        {600: -350, 360: -480, 480: -415, 605: -350 + 5 * 130 / 240},
    ),
    "even gas": (
        {"force_N": 350, "compressed_force_N": 350, "stroke": 250, "length": 605},
        {600: -350, 360: -350},
    ),
    "constant": ({"force_N": 12}, {10: 12, 1000: 12}),
}
KIND = {"initial tension": "extension", "no free length": "extension", "even gas": "gas"}


@pytest.mark.parametrize("name", CASES)
def test_pulls_by_hand(name):
    numbers, pulls = CASES[name]
    for count in (1, 3):
        own = law(KIND.get(name, name), numbers, count)
        told = own.tension(np.array([*pulls]) / 1000)
        assert told == pytest.approx(count * np.array([*pulls.values()]), abs=1e-9)
    inches = {key: value / 25.4 if key in ("free_length", "stroke", "length") else value
              for key, value in numbers.items()}  # fmt: skip
    own = law(KIND.get(name, name), inches, metre=0.0254)
    assert own.tension(np.array([*pulls]) / 1000) == pytest.approx([*pulls.values()], abs=1e-9)


@pytest.mark.parametrize("name", CASES)
def test_energy_is_the_work_of_the_pull(name):
    numbers, _ = CASES[name]
    own = law(KIND.get(name, name), numbers, 2, 45.0)
    lengths = np.linspace(0.03, 0.7, 200_001)
    middle = own.tension((lengths[1:] + lengths[:-1]) / 2)
    work = np.concatenate([[0], np.cumsum(middle * np.diff(lengths))])
    energy = own.energy(lengths)
    assert np.abs(energy - energy[0] - work).max() <= 1e-8 * np.abs(work).max() + 1e-9


def test_gas_springs_grow_with_the_absolute_temperature():
    numbers, _ = CASES["gas"]
    at = np.array([0.4, 0.6])
    warm, cold = law("gas", numbers, celsius=60.0), law("gas", numbers, celsius=-30.0)
    assert warm.tension(at) / cold.tension(at) == pytest.approx([333.15 / 243.15] * 2)
    assert law("gas", numbers).tension(at)[1] == pytest.approx(-350)


def test_the_energy_of_a_nearly_even_gas_spring_keeps_its_digits():
    own = law("gas", CASES["gas"][0] | {"compressed_force_N": 350.0000001})
    steps = np.diff(own.energy(np.array([0.5, 0.5 + 1e-6])))
    assert steps == pytest.approx([-350e-6], rel=1e-6)


def test_what_a_spring_allows():
    gas = Spring("gas", ENDS, CASES["gas"][0])
    assert gas.span == (355, 605)
    own = law("gas", CASES["gas"][0])
    off = own.off(np.array([0.354, 0.355, 0.4, 0.605, 0.606]), (0.355, 0.605))
    assert off.tolist() == [True, False, False, False, True]
    numbers = {"rate_N_per_mm": 1, "free_length": 30, "greatest_length": 90}
    assert Spring("extension", ENDS, numbers).span == (30, 90)
    numbers = {"rate_N_per_mm": 1, "free_length": 30, "least_length": 12}
    assert Spring("compression", ENDS, numbers).span == (12, np.inf)
    assert Spring("constant", ENDS, {"force_N": 1}).span == (0, np.inf)


NUMBERS = {kind: dict.fromkeys(needed, 10.0) for kind, needed in NEEDED.items()}
NUMBERS["gas"] |= {"length": 30.0}


@pytest.mark.parametrize("kind", NEEDED)
def test_each_number_is_needed_and_none_is_below_zero(kind):
    good = Spring(kind, ENDS, NUMBERS[kind] | dict.fromkeys(POSSIBLE[kind], 20.0))
    assert good["nothing of that name"] == 0
    for name in NEEDED[kind]:
        some = {key: value for key, value in NUMBERS[kind].items() if key != name}
        refused(kind, some, f"states no {name}")
    for name in (*NEEDED[kind], *POSSIBLE[kind]):
        if name != "free_deg":
            refused(kind, NUMBERS[kind] | {name: -1.0}, name)
        for wrong in (np.nan, np.inf, "1", None):
            refused(kind, NUMBERS[kind] | {name: wrong}, name)
    refused(kind, NUMBERS[kind] | {"colour": 1.0}, "has no colour")
    for count in (0, -1, 1.5, 1001, "2"):
        with pytest.raises(InputError) as caught:
            Spring(kind, ENDS, NUMBERS[kind], count)
        assert caught.value.code == "E177"


def refused(kind, numbers, says):
    with pytest.raises(InputError, match=says) as caught:
        Spring(kind, ENDS, numbers)
    assert caught.value.code == "E177"


def test_what_else_is_refused():
    refused("gas", NUMBERS["gas"] | {"length": 10.0}, "shorter than its stroke")
    refused("gas", NUMBERS["gas"] | {"stroke": 0.0}, "shorter than its stroke")
    refused("rubber", {}, "no spring 'rubber'")
    for make in (
        lambda: Plates("cheese", 3, 20),
        lambda: Plates(-1.0, 3, 20),
        lambda: Plates(np.nan, 3, 20),
        lambda: Plates("steel", 0, 20),
        lambda: Plates("steel", 3, np.nan),
        lambda: Mass(-1.0),
        lambda: Mass(1.0, [1.0]),
        lambda: Mass(1.0, None, -1.0),
    ):
        with pytest.raises(InputError) as caught:
            make()
        assert caught.value.code == "E177"
    assert set(NEEDED) == set(SpringKind.__args__)
