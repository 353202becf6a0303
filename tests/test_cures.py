"""What helps, in the words of the command, of Python and of pages."""

import copy
import math
import pickle

import pytest

from burmester.cures import Cure, Help, for_command, for_page, for_python, said
from burmester.geometry.regions import box
from burmester.requirements.table import ASKED
from burmester.tasks.pose_tolerances import tolerance_cure

# Bounds of everything that can be asked, and how each face asks for them.
BOUNDS = {
    "transmission_deg": 8.3,
    "types": frozenset({"slider-crank"}),
    "driver": "any",
    "link_ratio": 8.0,
    "within": 0.1,
    "within_deg": 2.0,
    "any_order": True,
}
FACES = {
    "transmission_deg": (
        "--min-transmission 8.3",
        "transmission_deg=8.3",
        "a transmission angle of 8.3° or more",
    ),
    "types": ("--type slider-crank", 'types={"slider-crank"}', "the type slider-crank"),
    "driver": ("--driver any", 'driver="any"', "any driver"),
    "link_ratio": (
        "--link-ratio 8",
        "link_ratio=8",
        "a longest link of at most 8 times the shortest",
    ),
    "within": ("--within 0.1", "within=0.1", "a position error of at most 0.1"),
    "within_deg": ("--within-angle 2", "within_deg=2", "an angle error of at most 2°"),
    "any_order": ("--any-order", "any_order=True", "any order of the poses"),
}


@pytest.mark.parametrize("requirement", ASKED, ids=lambda each: each.name)
def test_what_is_asked_is_said_by_every_face(requirement):
    if requirement.name in BOUNDS:
        cure = [requirement.given(BOUNDS[requirement.name])]
        said_by = for_command(cure), for_python(cure), for_page(cure)
        assert said_by == FACES[requirement.name]
    left_open = [requirement.given()]
    assert for_command(left_open) == requirement.option
    assert for_python(left_open) == requirement.name
    assert "-" not in for_page(left_open)


def test_cures_that_belong_together_are_one_phrase():
    asked = {each.name: each for each in ASKED}
    cures = [asked["within"].given(0.1), asked["any_order"].given(True)]
    text = Help("with ", cures, " L1 would do")
    assert text == "with --within 0.1 --any-order L1 would do"
    assert said(text, for_python) == "with within=0.1, any_order=True L1 would do"
    page = "with a position error of at most 0.1 and any order of the poses L1 would do"
    assert said(text, for_page) == page
    assert text.cures == cures


def test_values_of_every_kind():
    room = tolerance_cure(0.5, 0.5, math.inf)
    assert for_command([room]) == "--pose-tolerance 0.5,0.5,free"
    assert for_python([room]) == "tolerances=(0.5, 0.5, inf)"
    assert for_page([room]) == "tolerances 0.5,0.5,free"
    area = Cure("footprint", box((0, 0), (3, 4)), text="box:0,0:3,4")
    assert for_command([area]) == "--footprint box:0,0:3,4"
    assert for_python([area]) == for_page([area]) == "footprint in the box from (0, 0) to (3, 4)"
    assert for_python([Cure("unit", "mm")]) == 'unit="mm"'
    assert for_page([Cure("every", 3)]) == "every 3"
    for one in (1, 1.0):  # which are equal to True
        assert for_command([Cure("pose", one)]) == "--pose 1"
        assert for_python([Cure("pose", one)]) == "pose=1"
        assert for_page([Cure("pose", one)]) == "pose 1"
    assert for_command([Cure("force", True)]) == "--force"
    assert for_python([Cure("force", True)]) == "force=True"


def test_texts_keep_their_cures_when_joined_copied_and_sent():
    first = Help.of("give {}, or leave {} out", Cure("hole", 2.5), Cure("pin"))
    text = Help.joined("; or ", [first, "move a pose", Help.listed([Cure("x"), Cure("y")], "or")])
    assert text == "give --hole 2.5, or leave --pin out; or move a pose; or --x or --y"
    for again in (text, copy.deepcopy(text), pickle.loads(pickle.dumps(text))):
        assert type(again) is Help
        plain = "give hole=2.5, or leave pin out; or move a pose; or x or y"
        assert again.said(for_python) == plain
    assert not Help.joined("; or ", [])
    assert said("move a pose", for_page) == "move a pose"
