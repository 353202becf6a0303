"""The page of six-bars in a browser: joints are where bars driven by Newton's method put them."""

import re
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest

import burmester
from burmester import Polygon, Requirements
from burmester.errors import InputError
from tests.command import run
from tests.oracles import browser as browsers
from tests.oracles.six_bars import LIST, dimensions, driven
from tests.report.drawn_six_bars import DRAWN, SCRUB, points
from tests.sixbar.tasks import BENT, TURNING, task

START = (*BENT[0][:2], np.radians(BENT[0][2]))
PLATE = np.array([(-0.6, -0.4), (1.4, -0.4), (1.4, 0.5), (0.2, 1.1)])
# What is drawn in each frame, from the press on, until it has been at both ends and back.
PLAYED = f"""() => new Promise((done) => {{
  const drawn = {DRAWN}, slider = document.querySelector(".bm-slider"), seen = [];
  document.querySelector(".bm-play").click();
  const look = () => {{
    seen.push([+slider.value, drawn().joints]);
    if (seen.length > 75) done([+slider.min, +slider.max, seen]);
    else requestAnimationFrame(look);
  }};
  look();
}})"""


def angle(tip, one, other):
    p, q = one - tip, other - tip
    turned = abs(np.degrees(np.angle(p / q)))
    return min(turned, 180 - turned)


def require_bars(joints, bars, close):
    for bar in LIST:
        assert abs(abs(joints[bar[0]] - joints[bar[1]]) - bars[bar]) < close, bar


def driver_of(found, joints):
    pivot, end = "AC" if found.driver == "first" else "BD"
    return np.angle(joints[end] - joints[pivot])


def require_dimensions(page, found):
    """What the page says of a six-bar builds it."""
    text = page.locator(".bm-numbers .bm-joints").inner_text()
    number = r"(-?[\d.e-]+)"
    at = {
        (line.group(1), k): complex(float(line.group(2)), float(line.group(3)))
        for k, line in enumerate(re.finditer(rf"([A-H]) \({number}, {number}\)", text))
    }
    a, b, d, e, bd, g, body, link = at.values()
    assert "".join(name for name, _ in at) == "ABDEDGEH"
    bars = {
        "AC": float(re.search(rf"first crank, AC\s+{number}", text)[1]),
        "GH": float(re.search(rf"floating link, GH\s+{number}", text)[1]),
        "BD": abs(bd), "CD": abs(d), "CE": abs(e), "DE": abs(e - d),
        "BG": abs(g), "DG": abs(g - bd), "EH": abs(link - body),
    }  # fmt: skip
    assert bars == pytest.approx(dimensions(found.linkage), rel=1e-6)
    page.locator(".bm-numbers summary").click()
    facts = page.locator(".bm-numbers details tbody tr").all_inner_texts()
    told = {name: float(value) for name, value in map(str.split, facts)}
    assert told == pytest.approx({"AB": abs(b - a), **bars}, rel=1e-5)


@pytest.fixture(scope="module")
def result():
    given = replace(task(BENT, length_unit="cm"), body=Polygon(PLATE))
    return burmester.synthesize_six_bars(given, kind="Watt I", chains=600, seed=2)


def of_each_driver(result):
    """The best six-bar that the first crank drives, and the best that the second one does."""
    return [next(each for each in result if each.driver == name) for name in ("second", "first")]


@pytest.fixture(scope="module")
def file(result, tmp_path_factory):
    return result.report(tmp_path_factory.mktemp("six") / "bent.html")


def test_joints_are_where_the_bars_put_them(browser, file, result):
    with browsers.opened(browser, file, width=390) as (page, said, asked):
        for found in of_each_driver(result):
            page.click(f"[data-linkage={found.id}]")
            bars = dimensions(found.linkage)
            drives, drawn = [], []
            for k in range(len(BENT)):  # it stands at the first pose
                drives.append(found.drive[k])
                drawn.append(page.evaluate(DRAWN))
                here = page.locator(".bm-now").inner_text()
                assert here.endswith(f"at pose {k + 1}, exact")
                assert f"{np.degrees(found.drive[k]):.1f}°" in here
                page.click(".bm-next")
            for share in (0.13, 0.5, 0.86):
                page.evaluate(SCRUB, share)
                drawn.append(page.evaluate(DRAWN))
                near = driver_of(found, points(drawn[-1]))
                middle = np.mean(found.drive_range)
                drives.append(near + 2 * np.pi * round((middle - near) / (2 * np.pi)))
            drives = np.array(drives)
            path = np.unique(np.concatenate([found.along(200), drives]))
            if found.drive[-1] < found.drive[0]:
                path = path[::-1]
            run = driven(found.linkage, START, found.driver, path)
            for drive, each in zip(drives, drawn, strict=True):
                joints, at = points(each), int(np.abs(path - drive).argmin())
                close = 3e-5 / each["scale"]
                for name, place in zip("CDEGH", run.joints[at], strict=True):
                    assert abs(joints[name] - place) < close
                assert np.abs(run.places[at, :2] - each["body"][:2]).max() < close
                off = np.exp(1j * (run.places[at, 2] - each["body"][2])) - 1
                assert abs(off) < 1e-6
                require_bars(joints, bars, close)
                for link, ends in each["links"].items():
                    corners = [joints[name] for name in link]
                    assert [complex(*end) for end in ends][: len(link)] == pytest.approx(corners)
            told = page.locator(".bm-pose-table tbody tr").all_inner_texts()
            tip = ("D", "C", "B") if found.driver == "first" else ("C", "D", "A")
            for text, each in zip(told, drawn, strict=False):
                joints = points(each)
                both = [float(one) for one in re.findall(r"([\d.]+)°", text)[-2:]]
                loops = angle(*(joints[name] for name in tip)), angle(*map(joints.get, "HGE"))
                assert both == pytest.approx(loops, abs=0.051)
            require_dimensions(page, found)
            assert page.locator(".bm-ghosts .bm-ghost").count() == len(BENT)
        assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
        assert said == []
        assert asked == [file.as_uri()]


def test_bars_keep_their_lengths_while_it_plays_and_where_it_locks(browser, file, result):
    found = result.best
    bars = dimensions(found.linkage)
    with browsers.opened(browser, file, before=browsers.QUICK) as (page, said, _):
        page.locator(".bm-whole input").check()
        low, high, seen = page.evaluate(PLAYED)
        at = np.array([u for u, _ in seen])
        assert [at.min(), at.max()] == pytest.approx([low, high])
        for _, joints in seen:
            require_bars(points({"joints": joints}), bars, 1e-5)
        angles = []
        for end, room in ((0.0, -found.room[0]), (1.0, found.room[1])):
            page.evaluate(SCRUB, end)
            drawn = page.evaluate(DRAWN)
            joints = points(drawn)
            require_bars(joints, bars, 1e-4)
            drive = found.drive_range[int(end)] + room
            assert abs(np.exp(1j * (driver_of(found, joints) - drive)) - 1) < 1e-5
            told = page.locator(".bm-now").inner_text()
            angles.append(float(re.search(r"transmission ([\d.]+)°", told)[1]))
        assert angles == [0.0, 0.0]
        assert said == []


def test_a_driver_that_turns_fully_is_played_all_round_by_keyboard(browser, tmp_path):
    given = replace(task(TURNING), requirements=Requirements(driver="crank"))
    result = burmester.synthesize_six_bars(given, kind="Watt I", chains=1500, most=1)
    found = result.best
    with browsers.opened(browser, result.report(tmp_path / "turning.html")) as (page, said, _):
        page.locator(".bm-whole input").check()
        assert page.locator(".bm-whole").inner_text() == "Whole turn"
        places = []
        for share in np.linspace(0, 1, 25):
            page.evaluate(SCRUB, share)
            places.append(points(page.evaluate(DRAWN)))
        first, last = places[0], places[-1]
        assert all(abs(first[name] - last[name]) < 1e-5 for name in first)
        turned = np.unwrap([driver_of(found, joints) for joints in places])
        assert turned[-1] - turned[0] == pytest.approx(2 * np.pi)
        for joints in places:
            require_bars(joints, dimensions(found.linkage), 1e-5)
        page.locator(".bm-plane").focus()
        page.keyboard.press("ArrowLeft")
        before = driver_of(found, points(page.evaluate(DRAWN)))
        page.keyboard.press("Shift+ArrowRight")
        after = driver_of(found, points(page.evaluate(DRAWN)))
        assert np.degrees(after - before) % 360 == pytest.approx(10, abs=1e-3)
        page.keyboard.press("Space")
        assert page.locator(".bm-play").get_attribute("aria-label") == "Pause"
        assert said == []


def test_the_drawing_in_a_notebook_has_the_joints_of_the_middle_pose(result):
    found = result.best
    text = result._repr_html_()
    svg = ElementTree.fromstring(text[text.index("<svg") : text.index("</svg>") + 6])
    circles = [each for each in svg.iter() if each.tag.endswith("circle")]
    drawn = np.array([complex(float(c.get("cx")), -float(c.get("cy"))) for c in circles])
    path = np.concatenate([np.linspace(*found.drive[[k, k + 1]], 50) for k in (0, 1)])
    there = driven(found.linkage, START, found.driver, path).joints[-1]
    ground = [complex(*found.linkage.fixed_first), complex(*found.linkage.fixed_second)]
    joints = np.array([*ground, *there])
    scale = abs(drawn[1] - drawn[0]) / abs(joints[1] - joints[0])
    assert np.abs((drawn - drawn[0]) / scale - (joints - joints[0])).max() < 0.3 / scale
    assert text[: text.index("<svg")].count("<tr>") == 1 + len(result)


def test_the_command_writes_the_page_or_says_why_not(tmp_path):
    def table(name, rows):
        path = tmp_path / name
        path.write_text("x,y,angle_deg\n" + "".join(f"{x},{y},{a}\n" for x, y, a in rows))
        return path

    file, easy = tmp_path / "page.html", table("easy.csv", TURNING)
    hard = table("hard.csv", [(0, 0, 0), (4, 9, 70), (9, 2, 95), (1, 6, 20), (7, 7, 150)])
    code, out, _ = run(
        "report",
        easy,
        "--six-bars",
        "--six-bar-kind",
        "Watt I",
        "--chains",
        300,
        "-o",
        file,
    )
    assert code == 0
    assert out.startswith("S1 is a Watt I six-bar, driven at ")
    assert '"linkages":[{"id":"S1"' in file.read_text()
    code, out, _ = run("report", hard, "-o", tmp_path / "four.html")
    assert code == 1
    assert "What helps: " in out
    assert "--six-bars" in out
    assert "--six-bars" in (tmp_path / "four.html").read_text()
    code, out, _ = run("report", hard, "--six-bars", "--chains", 5, "-o", tmp_path / "none.html")
    assert code == 1
    assert out.startswith("no six-bar that works: none of ")
    for words in (["--chains", 5], ["--six-bars", "--certify"]):
        code, _, err = run("report", easy, *words, "-o", tmp_path / "never.html")
        assert code == 2
        assert "E197" in err
    assert not (tmp_path / "never.html").exists()


def test_a_page_is_not_written_over(result, file):
    with pytest.raises(InputError) as refused:
        result.report(file)
    assert refused.value.code == "E140"
