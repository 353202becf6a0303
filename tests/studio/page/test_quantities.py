"""Numbers as people type them into a field, with units; and the sentences for what is none."""

import math

import pytest

from tests.oracles.page_modules import value

MM = {"kind": "length", "unit": "mm"}
ANGLE = {"kind": "angle"}


def read(cases):
    return value("quantities.mjs", "return cases.map(([t, o]) => m.quantity(t, o));", cases=cases)


def test_a_length_is_taken_in_the_unit_of_the_task():
    cases = {
        "12 mm": 12,
        "0.5 in": 12.7,
        '0.5"': 12.7,
        "1.5cm": 15,
        "2 ft": 609.6,
        "250 µm": 0.25,
        "250 μm": 0.25,  # the other letter that looks like it
        "1,25": 1.25,
        "−3": -3,  # a minus sign of a text program
        "\u00a07.5\u202fmm ": 7.5,
        "1e-3": 0.001,
        ".5": 0.5,
        "+4 MM": 4,
    }
    found = read([[text, MM] for text in cases])
    assert [each.get("value") for each in found] == [
        pytest.approx(number, rel=1e-12) for number in cases.values()
    ]
    several = {**MM, "many": True}
    assert read([["40, 1.5 cm; 2in", several]]) == [{"value": "40,15,50.8"}]
    assert "“b” is not a number" in read([["40,b", several]])[0]["fault"]
    assert read([["12 mm", {"kind": "length", "unit": "in"}]])[0]["value"] == pytest.approx(
        12 / 25.4, rel=1e-11
    )


def test_an_angle_is_taken_in_degrees():
    cases = {
        "30": 30,
        "30°": 30,
        "30 deg": 30,
        "0.2 rad": math.degrees(0.2),
        "-5 mrad": -0.9 / math.pi,
    }
    found = read([[text, ANGLE] for text in cases])
    assert [each["value"] for each in found] == [
        pytest.approx(number, rel=1e-11) for number in cases.values()
    ]


@pytest.mark.parametrize(
    ("text", "options", "said"),
    [
        ("abc", MM, "“abc” is not a number"),
        ("1.2.3", MM, "not a unit"),
        ("12 kg", MM, "“kg” is not a unit of length"),
        ("12 mm", ANGLE, "“mm” is not a unit of angle"),
        ("12 in", {"kind": "length", "unit": ""}, "no unit of length"),
        ("", MM, "A number is missing"),
        ("1e400", MM, "too large"),
        ("inf", MM, "not a number"),
        ("NaN", MM, "not a number"),
        ("-1", {**MM, "least": 0}, "not be less than 0 mm"),
        ("0", {**MM, "above": 0}, "greater than 0 mm"),
        ("95", {**ANGLE, "below": 90}, "must be less than 90°"),
        ("90", {**ANGLE, "below": 90}, "must be less than 90°"),
        ("3 mm", {"kind": "number"}, "write the number alone"),
        ("constructor", MM, "not a number"),
        ("1 constructor", MM, "not a unit"),
    ],
)
def test_what_is_no_number_is_said_in_a_sentence(text, options, said):
    (found,) = read([[text, options]])
    assert said in found["fault"]
    assert "value" not in found


def test_nothing_is_a_value_only_where_it_may_be():
    options = {**MM, "optional": True}
    assert read([["", options], ["  ", options]]) == [{}, {}]
