"""Make the pictures of pages and of image space in docs.

report.png is the page of the example, few-poses.png that of a template with three poses,
loads.png that of a lid with its gas spring, six-bars-report.png that of the window opener's
six-bars, studio.png the studio as it opens, notebook.png the widget in JupyterLab, and
image-space.png the paper's Fig. 4.

Needs a browser, Playwright, the studio, JupyterLab and Matplotlib, as the tests do.  Run it from
the project's root:

    .venv/bin/python -m docs.screens
"""

import tempfile
from io import BytesIO
from pathlib import Path

from PIL import Image
from tests.oracles import browser as browsers
from tests.oracles import jupyter
from tests.oracles.studio import served
from tests.oracles.studio_page import studio_page

from burmester import read_task, synthesize
from burmester.plot.paper import paper_figure
from burmester.plot.style import house_style
from burmester.report.page import page as page_of
from burmester.synthesis.six_bars import synthesize_six_bars

SIZE = (1400, 1060)  # pixels of the screen
STUDIO_HEIGHT = 940
FIGURE_DPI = 125
COLOURS = 256  # of a picture: more show no difference, and fill the file


def screen(poses="examples/poses.csv", solve=synthesize, steps=0):
    """The first screen of the page for these poses, some poses on, where nobody asks for motion."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "report.html"
        file.write_text(page_of(solve(read_task(poses)), Path(poses).name), encoding="utf-8")
        width, height = SIZE
        with (
            browsers.launched() as browser,
            browsers.opened(browser, file, width=width, height=height) as (page, said, _),
        ):
            for _ in range(steps):
                page.get_by_role("button", name="Next pose").click()
            assert said == []
            return page.screenshot()


def studio():
    """The studio as it opens, its linkage at the middle of its poses."""
    with (
        tempfile.TemporaryDirectory() as home,
        served(home=home) as visitor,
        browsers.launched() as browser,
        studio_page(browser, visitor, width=SIZE[0], height=STUDIO_HEIGHT) as page,
    ):
        for _ in range(3):
            page.get_by_role("button", name="Next pose").click()
        page.wait_for_timeout(300)  # names stand where they stay when the picture has come to rest
        assert page.wrong == []
        return page.screenshot()


def notebook():
    """A cell of JupyterLab that shows the widget, its linkage at the middle of its poses."""
    code = (
        "import burmester\nfrom burmester.notebook import Studio\n\n"
        'widget = Studio(burmester.read_task("case:motiongen-shoulder"))\nwidget'
    )
    with (
        tempfile.TemporaryDirectory() as folder,
        browsers.launched() as browser,
        jupyter.notebook(browser, folder, code, width=1040, height=800) as lab,
    ):
        lab.page.wait_for_selector(".bn [data-linkage]")
        for _ in range(2):
            lab.page.get_by_role("button", name="Next pose").click()
        assert lab.page.wrong == []
        return lab.page.locator(".jp-Notebook .jp-Cell").screenshot()


def figure():
    """Two constraint manifolds in image space: the paper's Fig. 4."""
    held = BytesIO()
    with house_style():
        paper_figure("figure-4").savefig(held, dpi=FIGURE_DPI)
    return held.getvalue()


def main():
    pictures = {
        "report.png": screen(),
        "few-poses.png": screen("src/burmester/templates/chest-lid.toml"),
        "loads.png": screen("examples/sprung-lid.toml"),
        "six-bars-report.png": screen(
            "src/burmester/templates/window-opener.toml", synthesize_six_bars, 2
        ),
        "studio.png": studio(),
        "notebook.png": notebook(),
        "image-space.png": figure(),
    }
    for name, drawn in pictures.items():
        picture = Image.open(BytesIO(drawn)).convert("RGB").quantize(COLOURS)
        picture.save(Path("docs", name), optimize=True)


if __name__ == "__main__":
    main()
