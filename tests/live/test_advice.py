"""What is assumed and advised, as data: stated in the task, it gives the same answer."""

from burmester import synthesize
from burmester.live.advice import advice_data
from burmester.live.document import document_of, task_of

POSES = [[0, 0, 0], [30, 20, 30], [60, 25, 60], [90, 10, 100]]


def document(**more):
    poses = [dict(zip(("x", "y", "angle"), each, strict=True)) for each in POSES]
    return {"length_unit": "mm", "angle_unit": "deg", "poses": poses, **more}


def stated(task, part, key, value):
    """A document that says what was assumed, or what is proposed."""
    own = {**task.get(part, {}), key: value}
    return {**task, part: own}


def test_what_is_assumed_is_no_longer_assumed_when_it_is_stated():
    task = document()
    said = advice_data(synthesize(task_of(task)))
    (assumed,) = [each["assumed"] for each in said if each["code"] == "W215"]
    assert [each["key"] for each in assumed] == [
        "fixed_pivot",
        "moving_pivot",
        "transmission_deg",
        "link_ratio",
    ]
    for each in assumed:
        task = stated(task, each["part"], each["key"], each["value"])
    again = synthesize(task_of(task))
    assert "W215" not in [each["code"] for each in advice_data(again)]
    assert document_of(again.task)["requirements"] == {"transmission_deg": 30, "link_ratio": 5}
    ((x, y), (u, v)) = task["limits"]["fixed_pivot"]["box"]
    assert (x < 0, u > 90) == (True, True)
    assert (y < 0, v > 25) == (True, True)


def test_what_is_proposed_makes_a_linkage_usable():
    asked = document(requirements={"transmission_deg": 60})
    first = synthesize(task_of(asked))
    assert not any(each.usable for each in first.linkages)
    outcome, *_ = advice_data(first)
    ((cure,),) = outcome["cures"]
    assert cure["words"] in outcome["help"]
    assert "--" not in outcome["help"]
    changed = task_of(stated(asked, cure["part"], cure["key"], cure["value"]))
    assert any(each.usable for each in synthesize(changed).linkages)
