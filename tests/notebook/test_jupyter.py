"""The widget in JupyterLab, in a real browser, under real pointer and key events."""

from importlib.util import find_spec
from pathlib import Path

import pytest

from burmester.io import templates
from tests.oracles import browser as browsers
from tests.oracles import jupyter

pytestmark = pytest.mark.skipif(
    find_spec("jupyterlab") is None, reason="no JupyterLab for this machine"
)

CODE = """import burmester
from burmester.notebook import Studio
widget, seen = Studio(burmester.read_task("case:motiongen-shoulder")), []
widget.observe(lambda change: seen.append(change["name"]))
widget"""
VIEW = ("scale", "left", "top")
MOVED = (9, -6)  # pixels
LID = Path(templates.__file__).parents[1] / "templates" / "chest-lid.toml"


@pytest.fixture(scope="module")
def lab(browser, tmp_path_factory):
    folder = tmp_path_factory.mktemp("lab")
    with jupyter.notebook(browser, folder, CODE, before=jupyter.CLOCK) as notebook:
        notebook.page.wait_for_selector(".bn [data-linkage=L3]")
        yield notebook


def place(lab, pose):
    """Where Python has a pose."""
    return lab.value(f"widget.task.poses.translation[{pose - 1}].tolist()")


def label(lab, pose):
    """What the handle of a pose says of it."""
    return lab.page.locator(f'.bn .bs-origin[data-pose="{pose}"]').get_attribute("aria-label")


def is_solved(lab):
    """Wait until both sides have the whole answer: a choice before may be of the one before."""
    lab.until("widget.result.task is widget.task")
    lab.page.wait_for_selector(".bn .bs-results:not(.bs-stale)")


def test_a_drag_in_the_cell_changes_the_task_in_python(lab):
    before, scale = (
        place(lab, 2),
        float(lab.page.locator(".bn .bs-scene").get_attribute("data-scale")),
    )
    path = [(MOVED[0] * k / 30, MOVED[1] * k / 30) for k in range(1, 31)]
    lab.page.keyboard.down("Alt")  # frees the hand from what it would snap to
    jupyter.drag(lab.page, 2, path, 1 / 120)
    lab.page.keyboard.up("Alt")
    lab.until("'result' in seen")
    is_solved(lab)
    x, y = place(lab, 2)
    assert x - before[0] == pytest.approx(MOVED[0] / scale, abs=1 / scale)
    assert y - before[1] == pytest.approx(-MOVED[1] / scale, abs=1 / scale)
    assert lab.value("widget.result.to_json() == burmester.synthesize(widget.task).to_json()")
    assert lab.value("seen.count('task')") > lab.value("seen.count('result')")  # it followed
    clock = lab.page.evaluate("clock")
    assert clock["pictures"]
    assert 1 < clock["most"] <= 4
    assert lab.page.wrong == []


def test_keys_move_a_pose_and_are_not_the_notebooks(lab):
    cells, before = lab.page.locator(".jp-Cell").count(), place(lab, 3)
    lab.page.locator('.bn .bs-origin[data-pose="3"]').focus()
    for key in ("ArrowRight", "a", "b"):  # the last two add cells where a notebook hears them
        lab.page.keyboard.press(key)
    lab.until(f"widget.task.poses.translation[2, 0] > {before[0]!r}")
    is_solved(lab)
    assert lab.page.locator(".jp-Cell").count() == cells


def test_a_card_that_is_picked_is_selected_in_python_and_back(lab):
    lab.page.locator('.bn [data-linkage="L2"] .bs-card-main').click()
    lab.until("widget.selected == 'L2'")
    lab.run("widget.selected = 'L1'")
    lab.page.wait_for_selector('.bn [data-linkage="L1"].bs-chosen')
    # The linkage that is shown goes on, and both sides know it by the same id.
    lab.page.locator('.bn .bs-origin[data-pose="2"]').focus()
    lab.page.keyboard.press("ArrowUp")
    is_solved(lab)
    lab.page.wait_for_selector(f'.bn [data-linkage="{lab.value("widget.selected")}"].bs-chosen')
    assert lab.page.wrong == []


def test_a_task_that_python_sets_moves_the_handles(lab):
    lab.run("widget.task = burmester.read_task('case:ge2012-exact')")
    lab.page.wait_for_selector('.bn .bs-origin[data-pose="10"]')
    x, y = place(lab, 10)
    assert f"x {x:g}" in label(lab, 10)
    assert f"y {y:g}" in label(lab, 10)
    count = lab.value("len(widget.result)")
    lab.page.wait_for_selector(f'.bn [data-linkage="L{count}"]')


def test_a_limit_that_is_dragged_is_the_tasks_in_python(lab):
    """Its box goes as far as the hand, the answers are those within it, and nothing else moves."""
    lab.run(f"widget.task = burmester.read_task({str(LID)!r})")
    limit, region = '.bn [data-limit="0"]', '.bn [data-region="1"]'
    lab.page.wait_for_selector(limit)
    assert lab.page.locator(region).count() == 1
    is_solved(lab)
    box = "widget.task.limits[0].fixed_pivot.vertices.tolist()"
    before, others = lab.value(box), lab.value("widget.task.poses.translation.tolist()")
    (low, down), (high, _), *_ = before

    def lower_edge():
        """Its middle in the window, below pivots and links, and pixels per unit."""
        plane = lab.page.locator(".bn .bs-scene")
        corner = browsers.at_rest(plane)
        scale, left, top = (float(plane.get_attribute(f"data-{key}")) for key in VIEW)
        x = corner["x"] + left + scale * (low + high) / 2
        return x, corner["y"] + top - scale * down, scale

    x, y, scale = browsers.settled(lab.page, lower_edge)
    browsers.press(lab.page, lab.page.locator(limit), x, y)
    for step in range(1, 9):
        lab.page.mouse.move(x + step, y + step / 2)
    lab.page.mouse.up()
    lab.until(f"{box} != {before!r}")
    is_solved(lab)
    pixels = 2 / scale  # either end of a drag may be rounded to a whole pixel
    for (x, y), (old_x, old_y) in zip(lab.value(box), before, strict=True):
        assert x - old_x == pytest.approx(8 / scale, abs=pixels)
        assert y - old_y == pytest.approx(-4 / scale, abs=pixels)
    assert lab.value("widget.task.poses.translation.tolist()") == others
    assert lab.value("widget.result.to_json() == burmester.synthesize(widget.task).to_json()")
    assert lab.page.wrong == []


def test_no_style_leaks(lab):
    styles = """[...document.styleSheets, ...document.adoptedStyleSheets].map(
        (sheet) => [...sheet.cssRules].map((each) => each.cssText).join()).join()"""
    assert "--bm-" not in lab.page.evaluate(styles)
    assert lab.page.locator(".bn").evaluate("node => getComputedStyle(node).fontSize") == "14px"
