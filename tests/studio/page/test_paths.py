"""Points and paths in the page: drawn, dragged, typed, pasted; their cognates, and what leaves."""

import json
import math
import shlex
import subprocess
import sys

import numpy as np
import pytest

from burmester import read_task
from burmester.io import templates
from tests.oracles.page_modules import value
from tests.oracles.studio_page import (
    choose,
    drag,
    drop,
    field,
    has_poses,
    kept,
    on_screen,
    open_tab,
    paste,
    place_of,
    solved,
)

PATH = templates.text("walking-leg")


def rested(page):
    """Wait until the answer is one to the task as it is."""
    page.wait_for_function("() => !document.querySelector('.bs-results.bs-stale')")
    solved(page)


def stroke(page, points):
    """Press at the first of some points of F, draw through the others, and let go."""
    first, *others = np.stack(on_screen(page, *np.transpose(points)), axis=-1).tolist()
    page.mouse.move(*first)
    page.mouse.down()
    for each in others:
        page.mouse.move(*each)
    page.mouse.up()


def oval(a, b, whole=1.0, count=60):
    turns = [2 * math.pi * whole * k / count for k in range(count + 1)]
    return [(a * math.cos(t), b * math.sin(t)) for t in turns]


def test_a_path_is_drawn_by_hand_closed_and_open(same_page):
    page = same_page
    choose(page, "task", "data-do=new")
    page.locator("[data-do=draw-path]").click()
    ring = oval(30, 20)
    stroke(page, ring)
    page.wait_for_selector("[data-path=closed]", state="attached")
    document = kept(page)
    assert document["path"] == {"closed": True}
    assert document["tolerance"] == {"x": 0, "y": 0, "angle_deg": 0}
    assert all(set(each) == {"x", "y", "free"} for each in document["poses"])
    points = np.array([(each["x"], each["y"]) for each in document["poses"]])
    assert 12 <= len(points) <= 40
    off = np.abs(np.hypot(points[:, 0] / 30, points[:, 1] / 20) - 1)
    assert off.max() < 0.08  # on the curve, but for what is averaged of a hand's trembling
    steps = np.linalg.norm(np.diff(points, axis=0, append=points[:1]), axis=1)
    assert steps.max() < 1.3 * steps.min()  # evenly, also from the last back to the first
    assert field(page, 1, "angle").input_value() == ""
    assert field(page, 1, "angle").get_attribute("placeholder") == "free"
    assert page.locator(".bs-turn:visible").count() == 0
    assert page.locator("[data-key=path-closed]").is_checked()
    page.locator("[data-do=draw-path]").click()
    stroke(page, oval(30, 20, whole=0.5))
    page.wait_for_selector("[data-path=open]", state="attached")
    page.keyboard.press("Control+z")
    assert kept(page) == document
    page.locator("[data-do=draw-path]").click()
    page.keyboard.press("Enter")  # by keys
    page.wait_for_selector("[data-path=closed]", state="attached")
    assert kept(page)["path"] == {"closed": True}
    assert kept(page) != document


def test_a_path_is_solved_and_its_cognates_are_chosen_and_exported(page, visitor, tmp_path):
    drop(page, "leg.toml", PATH)
    has_poses(page, 13)
    rested(page)
    document = kept(page)
    given = {"document": document, "options": {}, "name": "leg"}
    result = visitor.http.post("/result", json=given)
    linkage = result.json()["linkages"][0]
    error = page.locator('[data-linkage="L1"] [data-figure=worst]').inner_text()
    assert error.startswith(f"{linkage['position_error']['rms']:.2g} rms, ")
    (tmp_path / "leg.toml").write_bytes(visitor.http.post("/task", json=given).content)
    assert read_task(tmp_path / "leg.toml").path.closed
    # Panels that tell of angles are away; the cognates are those of the result, with its error.
    assert not page.locator("[data-tab=pivots]").is_visible()
    open_tab(page, "cognates")
    page.wait_for_selector('[data-cognate="2"]')
    told = linkage["cognates"]
    for number, cognate in enumerate(told, start=1):
        card = page.locator(f'[data-cognate="{number}"]')
        type_ = card.locator(".bm-type").inner_text()  # as it is driven, which may be the other way
        assert sorted(type_.split("-")) == sorted(cognate["type"].split("-"))
        for dyad in cognate["dyads"]:
            x, y = dyad["fixed_pivot"]
            assert f"({x:.1f}, {y:.1f})".replace("-0.0", "0.0") in card.inner_text()
    page.locator('[data-cognate="2"] button').click()
    chosen = page.locator("[data-linkage=placed]")
    chosen.wait_for()
    assert "Cognate of L1" in chosen.inner_text()
    assert chosen.locator("[data-figure=worst]").inner_text() == error
    with page.expect_download() as download:
        choose(page, "export", "data-export=dxf")
    ours = download.value.path().read_bytes()
    choose(page, "task", "data-do=command")
    page.wait_for_selector(".bs-command")
    commands = page.locator(".bs-command pre").all_inner_texts()
    page.locator("[data-do=close]").click()
    judge, export = (
        next(each for each in commands if each.startswith(f"burmester {name} ") and more in each)
        for name, more in (("judge", "--dyad"), ("export", "by-hand"))
    )
    for command in (judge, export):
        words = [sys.executable, "-m", *shlex.split(command)]
        done = subprocess.run(words, check=False, cwd=tmp_path, capture_output=True)
        assert done.returncode in (0, 1), done  # 1: this cognate's pivots lie outside the box
    (drawn,) = tmp_path.glob("*.dxf")
    assert ours == drawn.read_bytes()
    judged = json.loads((tmp_path / "leg-by-hand.json").read_text(encoding="utf-8"))
    for one in judged["linkages"][0]["dyads"]:
        pins = [each["fixed_pivot"] for each in told[1]["dyads"]]
        assert min(math.dist(one["fixed_pivot"], pin) for pin in pins) < 1e-9
    # A change of the task puts the cognate away.
    x, y = place_of(page, '.bs-pose:has(.bs-origin[data-pose="8"])')
    drag(page, '.bs-origin[data-pose="8"]', 12, 0)
    assert chosen.count() == 0
    moved = place_of(page, '.bs-pose:has(.bs-origin[data-pose="8"])')
    assert moved[0] > x + 1
    assert moved[1] == pytest.approx(y, abs=0.5)


def test_a_blank_angle_is_free(same_page):
    page = same_page
    drop(page, "few.csv", "x,y,angle_deg\n0,0,0\n5,1,10\n9,4,30\n")
    has_poses(page, 3)
    cell = field(page, 2, "angle")
    cell.fill("")
    cell.press("Enter")
    document = kept(page)
    assert document["poses"][1] == {"x": 5, "y": 1, "free": ["angle"]}
    assert document["tolerance"] == {"x": 0, "y": 0, "angle_deg": 0}
    assert page.locator('.bs-turn[data-turn="2"]').is_hidden()
    assert page.locator('.bs-turn[data-turn="1"]').is_visible()
    assert "angle free" in page.locator('.bs-origin[data-pose="2"]').get_attribute("aria-label")
    cell.fill("12")
    cell.press("Enter")
    document = kept(page)
    assert document["poses"][1] == {"x": 5, "y": 1, "angle": 12}
    assert "tolerance" not in document
    page.locator("[data-do=add-points]").click()
    page.mouse.click(*on_screen(page, 4, 3))
    page.keyboard.press("Escape")
    has_poses(page, 4)
    assert kept(page)["poses"][3]["free"] == ["angle"]


def test_pasted_rows_are_a_task_of_their_own(same_page):
    page = same_page
    rows = "0\t0\t0\n12\t3\t20\n20\t10\t45\n"
    paste(page, rows)  # without a header nothing is guessed
    page.locator("[data-do=read-columns]").click()
    has_poses(page, 3)
    assert set(kept(page)) == {"length_unit", "angle_unit", "poses"}  # no limits of the lid
    rested(page)
    assert "Not in the new answer" not in page.locator("#bs-results").inner_text()
    page.locator("[data-do=keep-rest]").click()
    assert "limits" in kept(page)
    page.wrong.clear()  # the refusal


def test_a_long_help_is_folded(same_page):
    page = same_page
    paste(page, "a,b,c\n1,2,3\n4,5,6\n")
    banner = page.locator("[data-banner=refused]")
    banner.wait_for()
    assert banner.locator("details").count() == 1
    assert len(banner.inner_text()) < 700
    page.wrong.clear()


# A page without a server: what is sent is kept, answers are handed in.
STORE = """
const sent = [], heard = {};
let last = 0;
const send = (each) => (sent.push(each), (last += 1));
const connection = { send, on: (name, fn) => (heard[name] = fn) };
const point = (x) => ({ x, y: 0, free: ["angle"] });
const task = (x) => ({ poses: [point(0), point(1), point(x)] });
const store = new m.Store({ connection, document: task(2) });
const result = { linkages: [{ id: "L1" }], space: {} };
const answer = (n, seconds) => heard.message({ n, kind: "solved", seconds, was: {}, result });
const did = () => sent.splice(0).map((each) => [each.do, each.document.poses[2].x]);
const refuse = (n) => heard.message({ n, kind: "refused", solve: true, whole: true });
const drag = (x) => store.edit(() => task(x), { gesture: 1 });
clearTimeout(store.resting);
"""


@pytest.mark.parametrize(("seconds", "meanwhile"), [(0.4, True), (5, False)])
def test_what_cannot_be_followed_is_solved_while_dragged_where_that_is_quick(seconds, meanwhile):
    script = f"""{STORE}
    store.solve();
    answer(last, {seconds});
    const first = did();
    drag(3); refuse(last);            // the follow is refused, and nothing else is asked for yet
    const second = did();
    drag(4); drag(5); drag(6);        // one search at a time
    const third = did();
    if (third.length) answer(last, {seconds});
    const shown = [store.solvedFor.poses[2].x, did()];
    clearTimeout(store.resting);
    return [first, second, third, shown];
    """
    first, second, third, shown = value("store.mjs", script)
    assert first == [["solve", 2]]
    assert second == [["follow", 3]]
    if meanwhile:
        assert third == [["solve", 4]]
        assert shown == [4, [["follow", 6]]]  # the answer is shown, and the newest task asked for
    else:
        assert third == []
        assert shown == [2, []]


def test_changes_keep_points_paths_and_crank_angles_together():
    point = {"x": 0, "y": 0, "free": ["angle"]}
    task = {
        "poses": [{**point, "x": k} for k in range(5)],
        "path": {"closed": False, "crank_deg": [0, 10, 20, 30, 40]},
        "tolerance": {"x": 0, "y": 0, "angle_deg": 0},
    }

    def crank(script):
        return value("document.mjs", f"return {script};", task=task)["path"]["crank_deg"]

    assert crank("m.removePose(task, 1)") == [0, 20, 30, 40]
    assert crank("m.movePose(task, 4, 0)") == [40, 0, 10, 20, 30]
    assert crank("m.duplicatePose(task, 1)") == [0, 10, 15, 20, 30, 40]
    assert crank("m.addPose(task, task.poses[0])") == [0, 10, 20, 30, 40, 50]
    assert crank("m.setCrank(task, 2, 25)") == [0, 10, 25, 30, 40]
    posed = value("document.mjs", "return m.setAngle(task, 2, 7);", task=task)
    assert "path" not in posed  # a path has no angles
    assert posed["poses"][2] == {"x": 2, "y": 0, "angle": 7}
    back = value("document.mjs", "return m.setAngle(task, 2, undefined);", task=posed)
    assert json.dumps(back["poses"]) == json.dumps(task["poses"])
