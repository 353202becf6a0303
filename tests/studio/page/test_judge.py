"""A linkage of a file, judged in the studio: its pivots are dragged, and better ones taken."""

from pathlib import Path

import pytest

from burmester.io.linkage_file import read_linkage
from burmester.live.document import read_file
from burmester.synthesis.judgement import judge_linkage
from tests.oracles.studio_page import (
    LID_OF_FIVE,
    answered,
    choose,
    drag,
    drop,
    has_poses,
    open_tab,
    solved,
    view,
)

BUILT = """[[dyads]]
fixed_pivot = [35, -153]
moving_pivot = [33, -45]
[[dyads]]
fixed_pivot = [104, -31]
moving_pivot = [61, -14]
"""


def worst(page):
    """The worst miss of the linkage by hand, as its card says it."""
    card = page.locator("[data-linkage=placed]")
    card.wait_for()
    answered(page)
    return card.locator("[data-figure=worst]").inner_text()


def test_a_linkage_of_a_file_is_judged_and_its_pivots_dragged(page):
    task = read_file("lid.toml", LID_OF_FIVE.encode())
    drop(page, "lid.toml", LID_OF_FIVE)
    has_poses(page, 5)
    solved(page)
    open_tab(page, "judge")
    built = {"name": "built.toml", "mimeType": "text/plain", "buffer": BUILT.encode()}
    page.locator("[data-file=linkage]").set_input_files(built)
    given = judge_linkage(task, read_linkage("built.toml", data=BUILT.encode())).linkages[0]
    assert float(worst(page).split()[0]) == pytest.approx(given.error.worst, rel=0.1)
    # A pivot alone is dragged: the others stay, and the verdict is that of the new linkage.
    drag(page, '.bs-pivot-fixed[data-pivot="P2"]', 40, 0)
    shown = float(worst(page).split()[0])
    with page.expect_download() as file:
        choose(page, "export", "data-export=result")
    moved = read_linkage(Path(file.value.path()))
    assert moved.first.fixed_pivot == pytest.approx([35, -153], abs=1e-9)
    assert moved.second.moving_pivot == pytest.approx([61, -14], abs=1e-9)
    assert moved.second.fixed_pivot[0] == pytest.approx(104 + 40 / view(page)["scale"], abs=2)
    judged = judge_linkage(task, moved).linkages[0]
    assert shown == pytest.approx(judged.error.worst, rel=0.1)
    assert judged.error.worst > 2 * given.error.worst
    page.locator("[data-do=improve-judged]").click()
    page.locator("[data-better]").first.click()
    page.wait_for_function(
        "(old) => document.querySelector('[data-linkage=placed] [data-figure=worst]')"
        ".textContent !== old",
        arg=page.locator("[data-linkage=placed] [data-figure=worst]").inner_text(),
    )
    better = worst(page)
    assert better == "exact" or float(better.split()[0]) < shown
