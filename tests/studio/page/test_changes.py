"""Changes of a document, and what was before them: pure functions of the page, by Node."""

from tests.oracles.page_modules import value

TASK = {
    "length_unit": "mm",
    "poses": [{"x": 0, "y": 1, "angle": 2, "name": "a"}, {"x": 3, "y": 4, "angle": 5}],
    "limits": {"fixed_pivot": {"box": [[0, 0], [1, 2]]}},
}


def changed(script, task=TASK):
    """The document after a script; it is what it was before, which is asserted."""
    script = f"const d = (() => {{ {script} }})(); return [d, task];"
    after, before = value("document.mjs", script, task=task)
    assert before == task
    return after


def test_poses_are_set_added_copied_moved_and_removed():
    a, b = TASK["poses"]
    assert changed("return m.setPose(task, 1, { x: 9, name: 'b' });")["poses"] == [
        a,
        {**b, "x": 9, "name": "b"},
    ]
    assert changed("return m.setPose(task, 0, { name: undefined });")["poses"][0] == {
        "x": 0,
        "y": 1,
        "angle": 2,
    }
    new = {"x": 7, "y": 8, "angle": 9}
    assert changed("return m.addPose(task, {x: 7, y: 8, angle: 9});")["poses"] == [a, b, new]
    copy = {"x": 0, "y": 1, "angle": 2}  # a name is one pose's alone
    assert changed("return m.duplicatePose(task, 0);")["poses"] == [a, copy, b]
    assert changed("return m.movePose(task, 0, 1);")["poses"] == [b, a]
    assert changed("return m.removePose(task, 0);")["poses"] == [b]


def test_a_component_that_is_free_has_no_tolerance():
    task = {**TASK, "poses": [{"x": 0, "y": 1, "angle": 2, "tolerance": {"x": 1, "y": 2}}]}
    (pose,) = changed("return m.setFree(task, 0, 'x', true);", task)["poses"]
    assert (pose["free"], pose["tolerance"]) == (["x"], {"y": 2})
    (pose,) = changed("return m.setFree(m.setFree(task, 0, 'x', true), 0, 'x', false);", task)[
        "poses"
    ]
    assert "free" not in pose
    (pose,) = changed("return m.setTolerance(m.setTolerance(task, 0, 'x'), 0, 'y');", task)["poses"]
    assert "tolerance" not in pose


def test_limits_are_one_table_or_two():
    box, line = {"box": [[0, 0], [1, 2]]}, {"line": [[0, 0], [1, 0]]}
    one = changed("return m.setLimit(task, 0, { moving_pivot: {line: [[0, 0], [1, 0]]} });")
    assert one["limits"] == {"fixed_pivot": box, "moving_pivot": line}
    two = changed("return m.setLimit(m.splitLimits(task, true), 1, { fixed_pivot: undefined });")
    assert two["limits"] == [{"fixed_pivot": box}, {}]
    assert changed("return m.splitLimits(m.splitLimits(task, true), false);") == TASK
    assert "limits" not in changed("return m.setLimit(task, 0, { fixed_pivot: undefined });")
    found = value("document.mjs", "return m.limitRegions(task);", task=TASK)
    assert found == [{"table": 0, "key": "fixed_pivot", "shape": "box", "points": [[0, 0], [1, 2]]}]


def test_empty_tables_leave_no_key():
    task = {**TASK, "keep_out": {"box": [[0, 0], [1, 1]]}, "body": [[0, 0], [1, 0], [0, 1]]}
    assert "keep_out" not in changed("return m.removeRegion(task, 0);", task)
    assert "body" not in changed("return m.setBody(task, []);", task)
    asked = "m.setRequirement(task, 'within', 0.5)"
    assert changed(f"return {asked};")["requirements"] == {"within": 0.5}
    assert "requirements" not in changed(f"return m.setRequirement({asked}, 'within', undefined);")
    two = changed("return m.addRegion(task, { box: [[5, 5], [6, 6]] });", task)["keep_out"]
    assert two == [{"box": [[0, 0], [1, 1]]}, {"box": [[5, 5], [6, 6]]}]


def test_a_free_component_is_drawn_between_its_neighbours():
    poses = [{"x": 0, "y": 0, "angle": 10}, {"y": 5, "free": ["x", "angle"]}, {"x": 3, "y": 9}]
    task = {"poses": [*poses, {"x": 6, "y": 9, "angle": 40}]}
    seen = value("document.mjs", "return task.poses.map((_, k) => m.standing(task, k));", task=task)
    assert [(each["x"], each["angle"]) for each in seen] == [(0, 10), (1.5, 20), (3, 30), (6, 40)]


def test_history_has_one_entry_a_gesture():
    script = """
      const history = new m.History(), drag = Symbol("drag"), seen = [];
      let now = 0;
      const edit = (next, gesture) => { history.record(now, gesture); now = next; };
      const go = (next) => { if (next !== null) now = next; seen.push(now); };
      edit(1, drag); edit(2, drag); edit(3, drag); edit(4, null); edit(5, null);
      go(history.undo(now)); go(history.undo(now)); go(history.undo(now)); go(history.undo(now));
      go(history.redo(now)); go(history.redo(now));
      edit(9, null);
      go(history.redo(now)); go(history.undo(now));
      const other = Symbol("other");
      edit(10, other); edit(11, other);
      go(history.abandon(other)); go(history.abandon(other));
      return seen;
    """
    assert value("history.mjs", script) == [4, 3, 0, 0, 3, 4, 9, 4, 4, 4]
