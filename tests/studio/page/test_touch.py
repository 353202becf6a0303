"""Fingers on the plane: one drags a pose or the plane, two zoom."""

import pytest

from tests.oracles.studio_page import on_screen, pose, studio_page, view


@pytest.fixture
def fingers(browser, visitor):
    """A narrow page that is touched, and what puts fingers on it."""
    with studio_page(browser, visitor, width=390, height=844, has_touch=True) as page:
        devtools = page.context.new_cdp_session(page)

        def touch(kind, *points):
            at = [{"x": x, "y": y, "id": k} for k, (x, y) in enumerate(points)]
            devtools.send("Input.dispatchTouchEvent", {"type": f"touch{kind}", "touchPoints": at})

        yield page, touch
        assert page.wrong == []


def test_a_finger_drags_a_pose(fingers):
    page, touch = fingers
    page.locator(".bs-scene").scroll_into_view_if_needed()
    before, scale = pose(page, 8), view(page)["scale"]
    x, y = map(round, on_screen(page, *before[:2]))  # as a finger is
    touch("Start", (x, y))
    for k in range(1, 6):
        touch("Move", (x + 6 * k, y - 4 * k))
    touch("End")
    after = pose(page, 8)
    assert after[0] - before[0] == pytest.approx(30 / scale, abs=1 / scale)
    assert after[1] - before[1] == pytest.approx(20 / scale, abs=1 / scale)


def test_two_fingers_zoom_about_what_is_between_them(fingers):
    page, touch = fingers
    box = page.locator(".bs-scene").bounding_box()
    x, y = box["x"] + 0.75 * box["width"], box["y"] + 0.2 * box["height"]
    first = view(page)
    touch("Start", (x - 20, y))
    touch("Start", (x - 20, y), (x + 20, y))
    for k in range(1, 9):
        touch("Move", (x - 20 - 2.5 * k, y), (x + 20 + 2.5 * k, y))
    touch("End")
    last = view(page)
    assert last["scale"] / first["scale"] == pytest.approx(2, rel=0.02)
    under = [(x - box["x"] - at["left"]) / at["scale"] for at in (first, last)]
    assert under[1] == pytest.approx(under[0], abs=3 / first["scale"])
    assert pose(page, 8) == (73.93, -78.07, 100)
