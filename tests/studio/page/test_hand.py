"""Jobs of a hand on the plane: it snaps, moves the whole task, and clicks poses on a picture."""

import base64
import math

import pytest

from burmester.studio.opening import opening
from tests.oracles.browser import at_rest
from tests.oracles.drawings import dxf
from tests.oracles.studio_page import (
    choose,
    drag,
    drawn,
    kept,
    on_screen,
    pose,
    see_all,
    solved,
    view,
)

SCRIPTED = b"""<svg xmlns="http://www.w3.org/2000/svg" width="400" height="300">
<script>window.top.hacked = true</script>
<image href="http://example.com/a.png" width="9" height="9"/>
<rect width="400" height="300" fill="#ffd"/><circle cx="100" cy="200" r="8"/></svg>"""


@pytest.fixture
def page(same_page):
    return same_page


def test_a_hand_snaps_holds_an_axis_and_is_freed(page):
    page.locator("[data-do=snap]").click()
    see_all(page)
    scale, first = view(page)["scale"], pose(page, 1)
    x, y = on_screen(page, *pose(page, 5)[:2])
    near = on_screen(page, first[0] + 4 / scale, first[1] - 3 / scale)
    mark = page.locator(".bs-snap-name")
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(*near, steps=3)
    assert drawn(page, 5)[:2] == pytest.approx(first[:2], abs=0.01)
    assert mark.text_content() == "pose closed"
    page.keyboard.down("Alt")
    page.mouse.move(near[0] + 1, near[1])
    away = math.dist(drawn(page, 5)[:2], first[:2])
    assert away == pytest.approx(math.hypot(5, 3) / scale, rel=0.2)
    assert mark.count() == 0
    page.keyboard.up("Alt")
    page.keyboard.down("Shift")
    page.mouse.move(x + 60, y - 9)
    assert drawn(page, 5)[1] == pytest.approx(-37.39, abs=0.01)  # as before the drag: it is held
    assert mark.text_content() == "horizontal"
    page.keyboard.up("Shift")
    page.mouse.up()
    # A digit goes into the number beside the handle, with a unit.
    page.keyboard.type("1 cm")
    page.keyboard.press("Enter")
    assert pose(page, 5) == (10, -37.39, 55)
    page.locator("[data-do=snap]").click()


def test_several_poses_move_as_one_and_the_whole_task_is_mirrored(page):
    see_all(page)
    before = [pose(page, k) for k in range(1, 9)]
    x, y = on_screen(page, 20, -45)
    page.keyboard.down("Shift")
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(*on_screen(page, 85, -90), steps=3)
    page.mouse.up()
    page.keyboard.up("Shift")
    assert page.locator(".bs-pose-row.bs-selected").count() == 3  # 6, 7 and 8
    drag(page, '.bs-origin[data-pose="7"]', 0, -20)
    right, up = (pose(page, 7)[axis] - before[6][axis] for axis in (0, 1))
    assert up == pytest.approx(20 / view(page)["scale"], rel=0.1)
    for k in (6, 8):
        x, y, angle = before[k - 1]
        assert pose(page, k) == pytest.approx((x + right, y + up, angle))
    assert pose(page, 5) == before[4]
    page.keyboard.press("Control+z")
    # What is mirrored left to right about the origin has the answer mirrored.
    solved(page)
    card = page.locator(".bs-card").first
    told = card.inner_text()
    page.locator("[data-section=transform] > summary").click()
    page.locator("[data-do=mirror-x]").click()
    solved(page)
    document = kept(page)
    assert document["limits"][0]["fixed_pivot"]["box"] == [[-150, -100], [-5, -10]]
    assert [(each["x"], each["y"]) for each in document["poses"]] == [(-x, y) for x, y, _ in before]
    worst = "misses by", "transmits"
    lines, again = told.splitlines(), card.inner_text().splitlines()
    for each in worst:
        assert again[again.index(each) + 1] == lines[lines.index(each) + 1]


def test_poses_are_clicked_on_a_picture_to_scale_and_undo_survives_a_reload(page):
    page.locator("[data-section=picture] > summary").click()
    file = {"name": "a.svg", "mimeType": "image/svg+xml", "buffer": SCRIPTED}
    page.locator("[data-file=picture]").set_input_files(file)
    page.locator("[data-do=picture-scale]").click()
    box = at_rest(page.locator("img.bs-backdrop"))

    def there(u, v):
        return box["x"] + u / 400 * box["width"], box["y"] + v / 300 * box["height"]

    page.mouse.click(*there(100, 200))
    page.mouse.click(*there(300, 200))
    page.keyboard.type("10 cm")
    page.keyboard.press("Enter")
    box = at_rest(page.locator("img.bs-backdrop"))
    assert box["width"] == pytest.approx(200 * view(page)["scale"], abs=2)
    page.locator("[data-do=add-poses]").click()
    for u in (50, 200, 350):
        page.mouse.click(*there(u, 100))
        page.mouse.click(*there(u, 60))
    page.keyboard.press("Escape")
    (x9, y9, angle), (x11, y11, _) = pose(page, 9), pose(page, 11)
    assert (x11 - x9, y11 - y9) == pytest.approx((150, 0), abs=2 / view(page)["scale"])
    assert angle == pytest.approx(90, abs=1)
    solved(page)
    page.locator(".bs-card-main").nth(1).click()
    chosen = page.locator(".bs-card.bs-chosen").get_attribute("data-linkage")
    kept(page)
    data = page.evaluate("JSON.parse(sessionStorage.getItem('burmester.studio')).picture.data")
    assert base64.b64decode(data.partition(",")[2]).startswith(b"\xff\xd8\xff")  # and no SVG
    page.reload()
    page.wait_for_selector("html[data-ready]")
    page.locator("img.bs-backdrop").wait_for()
    solved(page)
    assert page.evaluate("window.hacked") is None
    assert not [each for each in page.asked if "example.com" in each]
    assert page.locator(".bs-card.bs-chosen").get_attribute("data-linkage") == chosen
    page.locator("[data-do=undo]").click()  # the card, then the pose
    assert page.locator(".bs-card.bs-chosen").get_attribute("data-linkage") != chosen
    assert page.locator(".bs-pose-row").count() == 11
    page.locator("[data-do=undo]").click()
    assert page.locator(".bs-pose-row").count() == 10
    page.locator("[data-do=redo]").click()
    assert page.locator(".bs-pose-row").count() == 11


def test_a_dxf_lies_to_scale_and_the_saved_task_brings_it_back(page, tmp_path):
    plan = dxf(
        lambda _, space: space.add_lwpolyline([(10, 0), (12, 0), (12, 1), (10, 1)], close=True), 6
    )
    page.locator("[data-section=picture]").evaluate("node => (node.open = true)")
    page.locator("[data-file=picture]").set_input_files(
        {"name": "plan.dxf", "mimeType": "image/vnd.dxf", "buffer": plan}
    )
    image = page.locator("img.bs-backdrop")
    image.wait_for()
    before, scene = at_rest(image), page.locator(".bs-scene").bounding_box()
    scale, left, top = (view(page)[each] for each in ("scale", "left", "top"))
    corner = scene["x"] + left + 10_000 * scale, scene["y"] + top - 1000 * scale  # metres in mm
    edge = 20 * scale  # a hundredth of the drawing is around it
    assert (before["x"] + edge, before["y"] + edge) == pytest.approx(corner, abs=1)
    assert before["width"] - 2 * edge == pytest.approx(2000 * scale, abs=1)
    with page.expect_download() as saved:
        page.keyboard.press("Control+s")
    file = tmp_path / "lid.toml"
    saved.value.save_as(file)
    opened = opening({"path": str(file)}, b"")
    assert opened["picture"]["file"] == "plan.dxf"
    assert len(opened["document"]["poses"]) == 8
    choose(page, "task", "data-do=new")
    image.wait_for(state="hidden")
    page.locator("[data-file=open]").set_input_files(file)
    image.wait_for()
    solved(page)
    place = page.evaluate("JSON.parse(sessionStorage.getItem('burmester.studio')).picture.place")
    assert place == pytest.approx(opened["picture"]["place"])
    assert (place["x"], place["y"]) == pytest.approx((9980, -20), abs=1e-6)
    odd = file.read_text(encoding="utf-8").replace("data:image/jpeg", "data:text/html")
    page.locator("[data-file=open]").set_input_files(
        {"name": "odd.toml", "mimeType": "text/plain", "buffer": odd.encode()}
    )
    image.wait_for(state="hidden")  # it is none that a page made
