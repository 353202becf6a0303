"""Pages of several tasks, each made once."""

from functools import cache

import pytest

from burmester import synthesize
from burmester.report.page import page as page_of
from tests.report.tasks import TASKS


@pytest.fixture(scope="session")
def report(tmp_path_factory):
    """By the name of a task its synthesis, and the file with its page."""
    folder = tmp_path_factory.mktemp("pages")

    @cache
    def made(name):
        result = synthesize(TASKS[name]())
        path = folder / f"{name.replace(' ', '-')}.html"
        path.write_text(page_of(result, name), encoding="utf-8")
        return result, path

    return made
