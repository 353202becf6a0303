"""How the page is laid out: the plane first, at every size; what is asked and assumed; keys."""

import pytest

from tests.oracles.studio_page import choose, has_poses, kept, open_tab, paste, solved, studio_page

FOUR = "x\ty\tangle\n0\t0\t0\n30\t20\t30\n60\t25\t60\n90\t10\t100\n"
SHARES = """() => {
  const { width, height } = document.querySelector(".bs-plane").getBoundingClientRect();
  const root = document.documentElement;
  return [width / innerWidth, height / innerHeight,
    root.scrollWidth - innerWidth, root.scrollHeight - innerHeight];
}"""


def tabs_to(page, selector):
    """How often Tab is pressed from the top of the page until this has the focus."""
    page.locator(".bs-skip").focus()  # where the first Tab leads
    for count in range(2, 40):
        page.keyboard.press("Tab")
        if page.evaluate("(what) => document.activeElement.matches(what)", selector):
            return count
    raise AssertionError(f"{selector} is not reached")


@pytest.mark.parametrize(
    ("size", "least"),
    [((390, 844), (0.99, 0.3)), ((1024, 768), (0.65, 0.6)), ((1400, 900), (0.55, 0.7)),
     ((3840, 2160), (0.65, 0.8))],
)  # fmt: skip
def test_the_plane_has_the_window_and_the_drawer_is_remembered(browser, visitor, size, least):
    width, height = size
    with studio_page(browser, visitor, width=width, height=height) as page:
        *share, right, below = page.evaluate(SHARES)
        assert share >= list(least)
        assert share[1] >= least[1]
        assert max(right, below) <= 0
        assert tabs_to(page, ".bs-origin") <= 6
        assert tabs_to(page, ".bm-play") <= 8
        if width < 760:
            return
        open_tab(page, "space")
        grip = page.locator(".bs-grip")
        before = int(grip.get_attribute("aria-valuenow"))
        grip.press("ArrowUp")
        page.reload()
        page.wait_for_selector("html[data-ready]")
        assert page.locator("[data-panel=space]").is_visible()
        assert int(grip.get_attribute("aria-valuenow")) == before + 24
        assert page.wrong == []


def test_what_is_assumed_is_changed_by_its_chip_and_the_answer_follows(page):
    choose(page, "task", "data-do=new")
    paste(page, FOUR)
    has_poses(page, 4)
    page.wait_for_selector("[data-linkage]")
    solved(page)
    page.locator('[data-chip="assumed transmission_deg"]').click()
    field = page.locator(".bs-chip-editor input")
    assert field.input_value() == "30"
    field.fill("60")
    field.press("Enter")
    solved(page)
    asked = page.locator(".bs-chip:has([data-chip=transmission_deg])")
    assert asked.inner_text().startswith("✕ transmission angle at least 60°")
    assert "0 usable" in page.inner_text(".bs-status")
    page.locator("[data-cure=transmission_deg]").click()
    solved(page)
    assert asked.inner_text().startswith("✓ ")
    assert 30 < kept(page)["requirements"]["transmission_deg"] < 60
    assert "0 usable" not in page.inner_text(".bs-status")
    asked.locator(".bs-chip-remove").click()
    solved(page)
    assert "requirements" not in kept(page)
    assert page.locator('[data-chip="assumed transmission_deg"]').count() == 1
