"""Six-bars in the studio: looked for, stopped, chosen, moved and exported."""

from pathlib import Path

import pytest

from burmester.io import templates
from burmester.io.saved import read_result
from burmester.live.document import read_file
from burmester.sixbar.six_bars import SixBarOptions
from burmester.synthesis.six_bars import synthesize_six_bars
from tests.oracles.studio_page import choose, drop, has_poses, solved

CHAINS = 2000


def test_a_six_bar_is_found_where_no_four_bar_works(page):
    text = templates.text("window-opener")
    drop(page, "opener.toml", text)
    has_poses(page, 5)
    solved(page)
    look, place = page.locator("[data-do=six-bars]"), page.locator(".bs-six-bars")
    look.click()
    page.locator("[data-do=stop-six_bars]").click()
    place.get_by_text("Stopped.").wait_for()
    page.locator("[data-key=chains]").select_option(str(CHAINS))
    look.click()
    first = place.locator("[data-linkage]").first
    first.wait_for()
    task = read_file("opener.toml", text.encode())
    expected = synthesize_six_bars(task, SixBarOptions(chains=CHAINS)).six_bars.found
    assert [each.get_attribute("data-linkage") for each in place.locator("[data-linkage]").all()] \
        == [each.id for each in expected]  # fmt: skip
    # The chosen one is drawn and moves: its body is at each pose in turn.
    assert first.get_attribute("aria-pressed") == "true"
    assert page.locator(".bs-mechanism [data-joint]").count() == len(expected[0].skeleton.joints)
    page.get_by_role("button", name="Next pose").click()
    assert "at pose 2" in page.locator(".bs-player").inner_text()
    with page.expect_download() as file:
        choose(page, "export", "data-export=result")
    saved = read_result(Path(file.value.path())).choose("S1")
    assert saved.transmission == pytest.approx(expected[0].transmission, abs=1e-9)
    assert page.locator("[data-tab=space]").is_hidden()  # a six-bar has no two dyads
    page.locator('[data-row="2"] [data-key=x]').fill("40")
    page.keyboard.press("Enter")
    assert place.locator("[data-linkage]").count() == 0
