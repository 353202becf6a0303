"""Degenerate linkages are not usable, whoever judges them."""

import json
from importlib import resources

import jsonschema
import numpy as np
import pytest

import burmester
from burmester import RR, Displacement, Limits, Linkage, Point, Task, box
from burmester.fourbar.dyad import PR
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.io.result import synthesis_data
from burmester.synthesis.judgement import judge_linkage
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.requirement_check import degenerate_defects

# Boxes and a tolerance; the closest linkages had links of 0.05 and 0.1 mm, and were called usable.
CONVEYOR = [
    (0, 0, 0),
    (-120, 90, 0),
    (-230, 170, 2),
    (-320, 230, 8),
    (-400, 260, 20),
    (-460, 262, 35),
    (-500, 240, 50),
]
SCHEMA = json.loads(resources.files("burmester").joinpath("io/synthesis.schema.json").read_text())
SPAN = float(np.hypot(500, 262))


def conveyor(**limits):
    return Task(
        Displacement.from_poses([(x, y, np.radians(angle)) for x, y, angle in CONVEYOR]),
        limits=(Limits(**limits),) if limits else (),
        requirements=burmester.Requirements(transmission_deg=30, within=15, within_deg=3),
        length_unit="mm",
    )


def pins(linkage):
    """The lengths of all four links of a linkage with pins."""
    one, two = linkage.first, linkage.second
    ground = np.linalg.norm(one.fixed_pivot - two.fixed_pivot)
    coupler = np.linalg.norm(one.moving_pivot - two.moving_pivot)
    return np.array([one.radius, two.radius, ground, coupler])


def reasons(linkage, task, sensitivity=1.0):
    problem = SynthesisProblem.of(task, None, SynthesisOptions())
    (told,) = degenerate_defects(
        LinkageBatch.of([linkage]), np.array([float(sensitivity)]), problem
    )
    assert {each.kind for each in told} <= {"degenerate"}
    return [each.message for each in told]


def test_no_usable_linkage_has_a_link_shorter_than_the_play_of_a_pin():
    task = conveyor(
        fixed_pivot=box([-900, -300], [900, 0]), moving_pivot=box([-600, -150], [1500, 200])
    )
    result = burmester.synthesize(task)
    assert result.usable
    seen = 0
    for found in result.linkages:
        lengths, worst = pins(found.linkage), float(found.quality.sensitivity)
        degenerate = lengths.min() < SPAN / 200 or worst > 100
        assert degenerate == any(each.kind == "degenerate" for each in found.defects)
        assert not (degenerate and found.usable)
        seen += degenerate
    assert seen


def four_bar(short=60.0, *, ground=100.0, coupler=120.0):
    return Linkage(RR([0, 0], [0, 0], short), RR([ground, 0], [coupler, 0], 110.0))


@pytest.mark.parametrize(
    ("linkage", "short"),
    [
        (four_bar(), None),
        (four_bar(2.9), None),
        (four_bar(2.7), "2.7"),
        (four_bar(ground=0.05), "0.05"),
        (four_bar(coupler=1.1), "1.1"),
        (Linkage(RR([0, 0], [0, 0], 1.5), PR(0.3, 2.0, [90, 0])), "1.5"),
        (Linkage(RR([0, 0], [0, 0], 60), PR(0.3, 2.0, [0.7, 0])), "0.7"),
    ],
)
def test_a_link_below_a_two_hundredth_of_the_span(linkage, short):
    assert pytest.approx(2.822, abs=1e-3) == SPAN / 200
    told = reasons(linkage, conveyor())
    if short is None:
        assert told == []
    else:
        (message,) = told
        assert message.startswith(f"has a link of {short} mm, shorter than 1/200 of the motion's")
        assert "(2.8 mm)" in message


def test_a_sensitivity_above_a_hundred():
    assert reasons(four_bar(), conveyor(), 99.9) == []
    assert reasons(four_bar(), conveyor(), np.nan) == []
    (message,) = reasons(four_bar(), conveyor(), 49109)
    assert message == "magnifies errors of its pivots and lengths up to 49109 times at a pose"


def test_lengths_that_the_task_states_replace_the_bound():
    tiny = four_bar(0.4)
    assert reasons(tiny, conveyor())
    assert reasons(tiny, conveyor(length=(0.5, 900)))
    assert not reasons(tiny, conveyor(length=(0.3, 900)))
    assert not reasons(tiny, conveyor(length=(0, 1)))
    assert reasons(tiny, conveyor(length=(0, 900)))  # says nothing of short links
    assert reasons(tiny, conveyor(length=(5, 900)))  # a limit that asks for more asks it itself
    near = four_bar(ground=1.0)
    at = [Limits(fixed_pivot=Point([0, 0])), Limits(fixed_pivot=Point([1, 0]))]
    task = conveyor()
    assert reasons(near, task)
    stated = Task(task.poses, limits=tuple(at), requirements=task.requirements)
    assert not reasons(near, stated)


def test_judge_and_the_json_tell_it():
    """Long links side by side, their pins 1 mm apart: exact at the poses, and nothing to build."""
    linkage = Linkage(RR([0, -400], [0, 0], 400), RR([1, -400], [1, 0], 400))
    poses = [(400 * np.sin(a), 400 * np.cos(a) - 400, 0.0) for a in (-0.4, -0.1, 0.2, 0.5, 0.9)]
    task = Task(Displacement.from_poses(poses))
    judged = judge_linkage(task, linkage)
    (own,) = judged.linkages
    assert own.error.worst < 1e-6
    assert not own.usable
    assert "degenerate" in [each.kind for each in own.defects]
    data = json.loads(json.dumps(synthesis_data(judged)))
    jsonschema.validate(data, SCHEMA)
    kinds = [each["kind"] for each in data["linkages"][0]["defects"]]
    assert "degenerate" in kinds
    wide = Linkage(RR([0, -400], [0, 0], 400), RR([90, -400], [90, 0], 400))
    assert judge_linkage(task, wide).linkages[0].usable
