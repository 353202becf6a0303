"""The studio's page, open in the browser."""

import pytest

from tests.oracles.studio_page import as_opened, studio_page


@pytest.fixture
def page(browser, visitor):
    """The page as a visitor finds it; nothing went wrong in it when the test ends."""
    with studio_page(browser, visitor) as found:
        yield found
        assert found.wrong == []


@pytest.fixture(scope="module")
def module_page(browser, visitor):
    with studio_page(browser, visitor) as found:
        yield found


@pytest.fixture
def same_page(module_page):
    """The page of a module's tests, as it was opened; quicker than another one."""
    as_opened(module_page)
    yield module_page
    assert module_page.wrong == []
    module_page.wrong.clear()
