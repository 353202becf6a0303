"""Errors that a Python caller meets name arguments, not options of the command."""

import pytest

import burmester
from burmester.errors import InputError


@pytest.fixture(scope="module")
def result():
    return burmester.synthesize(burmester.read_task("case:motiongen-shoulder"))


def helped(call, *arguments, **options):
    with pytest.raises(InputError) as caught:
        call(*arguments, **options)
    assert "--" not in caught.value.help
    return caught.value.help


def test_a_file_that_is_there(result, tmp_path):
    for call, name in (
        (result.save, "a.json"),
        (result.report, "a.html"),
        (result.export, "a.svg"),
    ):
        path = tmp_path / name
        call(path)
        help = helped(call, path)
        assert help == "give another name, or add force=True to replace it"
        call(path, force=True)


def test_a_format_that_is_not_known(result, tmp_path):
    help = helped(result.export, tmp_path / "a.doc")
    assert help == 'give to="dxf", or another of these'
    result.export(tmp_path / "a.doc", to="dxf")


def test_dimensions_and_units(result, tmp_path):
    path = tmp_path / "a.svg"
    assert helped(result.export, path, unit="furlong") == 'give unit="mm"'
    assert helped(result.export, path, pose=99).startswith("give pose=1, or another up to ")
    help = helped(result.export, path, hole=1e6)
    assert help.startswith("give hole=")
    value = float(help.removeprefix("give hole=").split(",")[0])
    result.export(path, hole=value)
