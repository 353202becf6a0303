"""The fields of the studio's page are those of the tables, with their bounds and choices."""

import json
import re
import subprocess
import sys
from pathlib import Path

import click
import pytest

from burmester.cli import COMMANDS
from burmester.errors import InputError
from burmester.live.document import options_of
from burmester.requirements.loads import OF_LOADS, STAYS_AT
from burmester.requirements.table import ASKED
from burmester.studio.form import form_data
from burmester.tasks.limits import KINDS, Limits
from burmester.tasks.option_table import OPTIONS, STUDIO_OPTIONS
from burmester.tasks.requirements import Requirements

FORM = json.loads(json.dumps(form_data()))
FIELDS = {each["key"]: each for each in FORM["requirements"]}


def test_every_requirement_has_a_field():
    """But for the poses at which it stays; those of loads are marked."""
    assert [*FIELDS] == [each.name for each in ASKED if each is not STAYS_AT]
    assert {key for key, each in FIELDS.items() if each["loads"]} == {
        each.name for each in OF_LOADS if each is not STAYS_AT
    }
    assert all(each["label"] for each in FIELDS.values())
    angle = FIELDS["transmission_deg"]
    assert (angle["kind"], angle["least"], angle["below"]) == ("angle", 0, 90)
    assert (FIELDS["within"]["kind"], FIELDS["within"]["above"]) == ("length", 0)


@pytest.mark.parametrize(
    ("key", "value"), [(k, name) for k, each in FIELDS.items() for name, _ in each["choices"]]
)
def test_choices_can_be_asked(key, value):
    made = Requirements(**{key: [value] if key == "types" else value})
    assert value in (getattr(made, key) if key == "types" else [made.driver])


@pytest.mark.parametrize("each", FORM["requirements"], ids=lambda each: each["key"])
def test_bounds_are_those_of_the_check(each):
    for name, inside in (("least", True), ("above", False), ("below", False)):
        if name not in each:
            continue
        if inside:
            Requirements(**{each["key"]: each[name]})
        else:
            with pytest.raises(InputError):
                Requirements(**{each["key"]: each[name]})


def test_options_and_limits_are_those_of_the_tables():
    assert [each["key"] for each in FORM["options"]] == [*STUDIO_OPTIONS]
    for each in FORM["options"]:
        for value, words in each["choices"]:
            assert words
            options_of({each["key"]: value})
    usual = {each.name: each.known[0] for each in OPTIONS if each.known}
    assert {e["key"]: e["choices"][0][0] for e in FORM["options"] if e["choices"]} == usual
    limits = {each["key"]: each for each in FORM["limits"]}
    assert {*limits} <= {*Limits.__match_args__}
    assert [kind for kind, _ in limits["kinds"]["choices"]] == [*KINDS]


def test_the_server_needs_no_numpy_for_it():
    code = "import sys, burmester.studio.form as f; f.form_data(); print('numpy' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"


def test_every_option_of_every_command_has_its_row_in_the_docs():
    table = Path("docs/studio-and-command.md").read_text(encoding="utf-8")
    told = set()
    for row in re.findall(r"^\| (`.*)\|$", table, re.M):
        commands, options, where = row.split(" | ")
        names = re.findall(r"`(\w+)`", commands)
        told |= {(name, option) for name in names for option in re.findall(r"`(-.*?)`", options)}
        told |= {(name, "") for name in names}
        assert where.strip()
    there = {(each.name, "") for each in COMMANDS}
    for command in COMMANDS:
        given = [each for each in command.params if isinstance(each, click.Option)]
        longs = [next((o for o in each.opts if o[:2] == "--"), each.opts[0]) for each in given]
        there |= {(command.name, option) for option in longs if option != "--help"}
    assert there - told == set()
    assert {option for _, option in told} <= {option for _, option in there}
