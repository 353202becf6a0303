"""`burmester explain`: a page for every code, whatever the width, without computing anything."""

import io
import re
import subprocess
import sys
from pathlib import Path

import pytest
from rich.cells import cell_len
from rich.console import Console

import burmester
from burmester import cli
from burmester.errors import InputError
from burmester.io.explain import page, pages, show_all, show_page

ROOT = Path(burmester.__file__).parent
TOLD_BY_THE_BEST = ("R300", "R305", "R307", "R308", "R340", "R360", "R370")  # without their code
CODE = re.compile(r"[EWR][0-9]{3}")


def emitted():
    """Every code in the source, found without importing it."""
    found = set()
    for file in ROOT.rglob("*.py"):
        found |= set(re.findall(r"[\"']([EWR][0-9]{3})[\"']", file.read_text("utf-8")))
    return found


def shown(show, width):
    console = Console(file=io.StringIO(), width=width, highlight=False)
    show(console)
    return console.file.getvalue()


def test_every_code_has_a_page_and_every_page_a_code():
    assert set(pages()) == emitted()
    assert len(pages()) > 40


def test_pages_are_in_order_and_in_their_family():
    codes = list(pages())
    families = {each.family: [] for each in pages().values()}
    for code, each in pages().items():
        families[each.family].append(code)
    assert [code for family in families.values() for code in family] == codes
    for family in families.values():
        assert family == sorted(family)
        assert len({code[0] for code in family}) == 1
    assert codes == [*sorted(codes, key=lambda code: ("ERW".index(code[0]), code))]


@pytest.mark.parametrize("code", pages())
def test_a_page_says_what_why_an_example_and_what_to_do(code):
    each = pages()[code]
    said = [text for kind, text in each.blocks() if kind == "text"]
    assert not said[0].startswith("**")
    assert [text.partition("** ")[0] for text in said if text.startswith("**")] == [
        "**Why it happens.",
        "**What to do.",
    ]
    assert len(set(said)) == len(said) >= 3
    assert each.title[0].isupper() or each.title.startswith("burmester")
    assert not each.title.endswith(".")
    example = each.example()
    if code not in ("R320", "R321"):  # which are told in JSON only
        assert example
        head = example.partition("\n")[0]
        assert f"[{code}]: " in head or code in TOLD_BY_THE_BEST
    # Other codes that it names exist.
    assert set(CODE.findall(each.text)) <= set(pages())


@pytest.mark.parametrize("code", pages())
def test_a_page_fits_and_says_all_of_it(code):
    each, width = page(code), 60
    text = shown(lambda console: show_page(each, console), width)
    assert text.startswith(f"{code}  ")
    for line in text.splitlines():
        assert cell_len(line) <= width or " " not in line.strip()
    words = " ".join(text.split())
    for kind, said in each.blocks():
        if kind != "block":
            assert " ".join(said.replace("**", "").split()) in words
        elif "...\n" not in text:  # a line of a file may be cut
            assert " ".join(said.split()) in words
    assert "**" not in text.replace("/ **,", "")  # a power, in an expression
    assert "```" not in text


@pytest.mark.parametrize("code", ["E103", "W210"])
def test_a_page_as_it_looks(code, snapshot):
    assert shown(lambda console: show_page(page(code), console), 60) == snapshot


@pytest.mark.parametrize("width", [40, 200])
def test_the_list_has_every_code_once_under_its_family(width):
    text = shown(show_all, width)
    assert re.findall(r"(?m)^  ([EWR][0-9]{3})  ", text) == list(pages())
    words = " ".join(text.split())
    for each in pages().values():
        assert f"{each.code} {each.title}" in words
        assert text.index(f"{each.family}\n") < text.index(each.code)
    assert max(map(cell_len, text.splitlines())) <= width


@pytest.mark.parametrize("given", ["E103", "e103", " E103 ", "error[E103]", "error[e103]: row 3"])
def test_a_code_may_be_given_as_it_is_printed(given):
    assert page(given).code == "E103"


@pytest.mark.parametrize(
    ("given", "near"),
    [("E1O3", "E103"), ("W2O9", "W209"), ("103", "E103"), ("E13", "E13"), ("E119", "E117")],
)
def test_an_unknown_code_is_told_the_nearest(given, near):
    with pytest.raises(InputError) as caught:
        page(given)
    assert caught.value.code == "E100"
    assert caught.value.help.startswith(f"try `burmester explain {near}")
    named = re.findall(r"`burmester explain (\w+)`", caught.value.help)
    assert named
    assert all(page(code).code == code for code in named)


@pytest.mark.parametrize("given", ["", "everything", "[]", "E103 E104"])
def test_no_code_at_all_is_told_where_they_are_listed(given):
    with pytest.raises(InputError) as caught:
        page(given)
    assert "`burmester explain`" in caught.value.help


@pytest.mark.parametrize("arguments", [[], ["E103"], ["w210"]])
def test_the_command_prints_it(arguments, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    with pytest.raises(SystemExit) as stop:
        cli.main(["explain", *arguments])
    assert stop.value.code == 0
    out = capsys.readouterr().out
    for word in arguments or pages():
        assert word.upper() in out
    assert max(map(len, out.splitlines())) <= 80


def test_an_explanation_loads_no_numpy():
    program = (
        "import sys\nfrom burmester import cli\n"
        "try:\n    cli.main(['explain', 'E103'])\nexcept SystemExit:\n    pass\n"
        "rooms = {'numpy', 'scipy', 'burmester.synthesis.motion_generation'}\n"
        "print(sorted(rooms & set(sys.modules)))"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True, timeout=60
    )
    assert done.stdout.splitlines()[-1] == "[]"
    assert done.stdout.startswith("E103")


def test_messages_md_reads_by_itself():
    text = (ROOT / "io" / "messages.md").read_text("utf-8")
    assert re.findall(r"(?m)^## ([A-Z]\d{3}) \S", text) == list(pages())
    outside = text.split("\n```")[::2]
    assert not re.search(r"(?m)^(error|warning|result)\[", "".join(outside))
    assert all(
        line.startswith(("#", "- ")) or line[0] != " "
        for line in "".join(outside).splitlines()
        if line
    )
