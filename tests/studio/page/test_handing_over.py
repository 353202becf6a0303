"""Tasks in and out of the page: templates, files, rows pasted, and the command on the task."""

import base64
import json
import re
import zlib

import pytest

from burmester.cli import main
from burmester.io.reading.link import LinkedTask, read_link, write_link
from tests.oracles.studio_page import choose, drag, drop, field, has_poses, paste, pose, solved

BOMB = (
    "t1=" + base64.urlsafe_b64encode(zlib.compress(b"[" + b" " * 5_000_000, wbits=-15)).decode()
).rstrip("=")


def rows(page):
    return page.locator(".bs-pose-row").count()


@pytest.fixture
def page(same_page):
    return same_page


def test_what_was_dragged_is_what_the_command_finds_in_the_saved_task(page, tmp_path, capsys):
    drag(page, '.bs-origin[data-pose="8"]', 6, 4)
    solved(page)
    with page.expect_download() as saved:
        page.keyboard.press("Control+s")
    file = tmp_path / saved.value.suggested_filename
    saved.value.save_as(file)
    assert file.suffix == ".toml"
    with pytest.raises(SystemExit):
        main(["synthesize", "--all", "--json", str(file)])
    found = json.loads(capsys.readouterr().out)
    x, y, _ = pose(page, 8)
    assert found["task"]["poses"][7]["x"] == x
    assert found["task"]["poses"][7]["y"] == y
    linkages = found["linkages"]
    usable = sum(each["usable"] for each in linkages)
    assert page.inner_text(".bs-status") == f"{len(linkages)} linkages, {usable} usable"
    with page.expect_download() as exported:
        choose(page, "export", "data-export=result")
    result = json.loads(exported.value.path().read_text(encoding="utf-8"))
    assert result["linkages"] == linkages
    assert result["dyads"] == found["dyads"]


def test_a_template_is_opened_and_undone(page):
    before = pose(page, 8)
    choose(page, "task", "data-template=gripper")
    has_poses(page, 7)
    assert page.locator(".bs-task-name").input_value() == "gripper"
    assert pose(page, 3) == (-3.45, -27.3, -15)
    page.keyboard.press("Control+z")
    assert rows(page) == 8
    assert pose(page, 8) == before
    assert page.locator(".bs-task-name").input_value() == "lid-hinge"


def test_rows_of_a_spreadsheet_are_pasted_anywhere(page):
    field(page, 2, "x").focus()
    text = "x [mm]\ty [mm]\tangle [deg]\n0\t0\t0\n12,5\t3\t20\n20\t10\t45\n"
    paste(page, text)
    has_poses(page, 3)
    assert [pose(page, k) for k in (1, 2, 3)] == [(0, 0, 0), (12.5, 3, 20), (20, 10, 45)]
    assert "3 poses were pasted" in page.locator("[data-banner=note]").inner_text()
    page.locator("[data-banner=note]").get_by_role("button", name="Undo").click()
    assert rows(page) == 8


def test_a_file_is_dropped_anywhere_and_a_wrong_one_is_told(page):
    drop(page, "lid.csv", "x,y,angle_deg\n0,0,0\n5,1,10\n9,4,30\n11,9,50\n")
    has_poses(page, 4)
    assert pose(page, 4) == (11, 9, 50)
    assert page.locator(".bs-task-name").input_value() == "lid"
    drop(page, "bad.csv", "x,y,angle_deg\n0,0,zero\n")
    banner = page.locator("[data-banner=refused]")
    banner.wait_for()
    assert "zero" in banner.inner_text()
    assert "bad.csv" in banner.inner_text()
    assert rows(page) == 4  # what was open stays
    (said,) = page.wrong
    assert "422" in said  # the browser tells of the refusal
    page.wrong.clear()


def test_an_outline_is_dropped(page):
    drawing = (
        '<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="50mm" viewBox="0 0 100 50">'
        '<path d="M0 0H100V50H0Z"/></svg>'
    )
    drop(page, "plate.svg", drawing)
    page.locator("[data-banner=note]").wait_for()
    page.locator("[data-section=body] > summary").click()
    page.locator("[data-section=body] details > summary").click()
    numbers = page.locator("[data-section=body] .bs-number")
    assert numbers.count() == 8
    spans = [float(numbers.nth(k).input_value().replace("−", "-")) for k in range(8)]
    assert max(spans[::2]) - min(spans[::2]) == pytest.approx(100)
    assert max(spans[1::2]) - min(spans[1::2]) == pytest.approx(50)


def test_the_same_is_told_as_a_command(page):
    choose(page, "task", "data-do=command")
    dialog = page.locator("dialog[open]")
    dialog.wait_for()
    assert "burmester synthesize lid-hinge.toml" in dialog.inner_text()
    dialog.locator("[data-do=close]").click()
    assert dialog.count() == 0


def typed(page, name, text):
    """Fill in a setting as a person does."""
    box = page.locator(f"[data-setting={name}]")
    box.fill(text)
    box.press("Enter")


def test_what_is_exported_with_settings_is_what_the_command_exports_with_them(page, tmp_path):
    """Each setting is in the command that the page shows; that command writes the same bytes."""
    page.locator("[data-menu=export] > summary").click()
    page.locator("[data-section=export] > summary").click()
    for name, text in (("hole", "5"), ("width", "1,8 cm"), ("pose", "3"), ("gap", "0.2"),
                       ("thickness", "4 mm"), ("pin", "4.9")):  # fmt: skip
        typed(page, name, text)
    page.locator("[data-setting=dimensions]").uncheck()
    typed(page, "density", "heavy")  # is no number, and stays out
    assert "not a number" in page.locator("[data-section=export] .bs-fault:visible").inner_text()
    typed(page, "density", "7850")
    choose(page, "task", "data-do=command")
    page.locator("dialog[open]").wait_for()
    shown = page.locator("dialog[open] pre").all_inner_texts()
    page.locator("dialog[open] [data-do=close]").click()
    (command,) = [each for each in shown if "burmester export" in each]
    words = command.split()
    assert {"--hole=5", "--width=18", "--pose=3", "--gap=0.2", "--thickness=4", "--pin=4.9",
            "--density=7850", "--no-dimensions"} <= set(words)  # fmt: skip
    with page.expect_download() as result:
        choose(page, "export", "data-export=result")
    result.value.save_as(tmp_path / "lid-hinge.json")
    with page.expect_download() as exported:
        choose(page, "export", "data-export=dxf")
    assert exported.value.suggested_filename == words[-1]
    words[2] = str(tmp_path / words[2])
    words[-1] = str(tmp_path / words[-1])
    with pytest.raises(SystemExit) as ended:
        main(words[1:])
    assert not ended.value.code
    assert exported.value.path().read_bytes() == (tmp_path / words[-1]).read_bytes()
    # One entry of history each, and no new search.
    page.keyboard.press("Control+z")
    assert page.locator("[data-setting=density]").input_value() == ""
    assert page.locator(".bs-status").get_attribute("data-state") == "resting"


def test_how_well_the_poses_are_known_is_part_of_the_task(page, tmp_path, capsys):
    page.locator("[data-section=sigma] > summary").click()
    position, angle = (page.locator(f"[data-key=sigma-{key}]") for key in ("position", "angle_deg"))
    position.fill("0.02")
    position.press("Enter")
    assert "Give both" in page.locator("[data-section=sigma]").inner_text()
    angle.fill("0.05")
    angle.press("Enter")
    assert "Give both" not in page.locator("[data-section=sigma]").inner_text()
    solved(page)
    with page.expect_download() as saved:
        page.keyboard.press("Control+s")
    saved.value.save_as(tmp_path / "task.toml")
    with pytest.raises(SystemExit):
        main(["synthesize", "--json", str(tmp_path / "task.toml")])
    sigma = json.loads(capsys.readouterr().out)["task"]["pose_sigma"]
    assert sigma == {"position": pytest.approx(0.02), "angle_deg": pytest.approx(0.05)}


def test_an_empty_task_is_filled_by_hand(page):
    choose(page, "task", "data-do=new")
    assert rows(page) == 0
    assert "add poses or points here" in page.locator(".bs-line").inner_text()
    page.locator("[data-do=add-poses]").click()
    box = page.locator(".bs-scene").bounding_box()
    for x, y, toward in ((150, 350, (230, 350)), (260, 300, (330, 250)), (340, 210, (360, 120))):
        page.mouse.click(box["x"] + x, box["y"] + y)
        page.mouse.click(box["x"] + toward[0], box["y"] + toward[1])
    page.keyboard.press("Escape")
    assert rows(page) == 3
    solved(page)
    assert page.locator("[data-banner=refused]").count() == 0
    assert re.fullmatch(r"\d+ linkages?, \d+ usable", page.inner_text(".bs-status"))


def test_a_link_carries_the_task_to_python_and_back_and_a_bad_one_changes_nothing(page):
    drag(page, '.bs-origin[data-pose="8"]', 6, 4)
    solved(page)
    moved = pose(page, 8)
    page.locator("[data-linkage=L2] .bs-card-main").click()
    choose(page, "task", "data-do=link")
    page.locator("[data-do=close]").wait_for()
    _, _, link = page.locator(".bs-dialog pre").all_inner_texts()
    page.locator("[data-do=close]").click()
    linked = read_link(link)  # as Python reads what the page wrote
    assert (linked.name, linked.choice) == ("lid-hinge", "L2")
    assert [linked.document["poses"][7][key] for key in ("x", "y", "angle")] == [*moved]
    follow(page, f"#{write_link(linked._replace(name='<b>lid</b>'))}")
    page.locator("[data-banner=note]", has_text="The task of the link is open.").wait_for()
    solved(page)
    assert pose(page, 8) == moved
    assert page.locator(".bs-task-name").input_value() == "<b>lid</b>"
    page.locator("[data-linkage=L2].bs-chosen").wait_for()
    assert "#" not in page.url
    banner = page.locator("[data-banner=refused]")
    for bad, sentence in (
        ("t1=" + link.split("t1=")[1][:-9], "The link is damaged."),
        ("t1=" + "A" * 20_001, "20000 are the most"),
        (BOMB, "more than 200 kB"),
        ("t2=abc", "The link has version 2, and 1 is read."),
        (write_link(LinkedTask({"poses": [[0, 0, "zero"]]})), "zero"),
    ):
        follow(page, f"#{bad}")
        banner.filter(has_text=sentence).wait_for()
        assert pose(page, 8) == moved
    page.wrong.clear()  # the browser tells of the last refusal


def test_a_film_says_how_far_it_is_and_is_called_off(page):
    page.locator("[data-menu=export] > summary").click()
    page.locator("[data-menu=export] [data-section=export]").evaluate("node => (node.open = true)")
    page.locator("[data-setting=seconds]").fill("7")
    page.locator("[data-setting=seconds]").press("Enter")
    page.locator("[data-export=gif]").click()
    said = page.locator("[data-banner=exporting]", has_text="drawing picture")
    said.wait_for()
    page.locator("[data-do=cancel-export]").click()
    said.wait_for(state="hidden")
    assert not page.locator("[data-banner=refused]").count()
    with page.expect_download() as exported:  # by the same workers
        choose(page, "export", "data-export=svg")
    assert exported.value.suggested_filename == "lid-hinge-L1.svg"


def follow(page, fragment):
    """Go to this page with another fragment, as a link that is opened in its tab does."""
    page.evaluate("fragment => void (location.hash = fragment)", fragment)
