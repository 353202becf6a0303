"""Pages are read easily: short sentences, short pages, and a picture where one says more."""

from pathlib import Path
from statistics import mean

import pytest
from docs.building.generated import message_pages

from tests.oracles.sentences import sentences, texts_of, words

ROOT = Path(__file__).parents[2]
FILES = [
    *ROOT.glob("*.md"),
    *(ROOT / "docs").rglob("*.md"),
    ROOT / "benchmarks" / "README.md",
    *(ROOT / "benchmarks" / "measured").glob("*.md"),
    ROOT / "src" / "burmester" / "io" / "messages.md",
]
PAGES = {str(page.relative_to(ROOT)): page.read_text(encoding="utf-8") for page in sorted(FILES)}
MOST_WORDS = 25  # of a sentence
MEAN_WORDS = 15  # of the sentences of a page
PAGE_WORDS = 3000

# Pages with longer sentences.  This list only shrinks.
EXEMPT: set[str] = {
    "docs/choices.md",
    "docs/mathematics/dyads.md",
    "docs/mathematics/families.md",
    "docs/mathematics/linkages.md",
}


def too_long(page):
    """Sentences with too many words."""
    return [each.strip() for each in sentences(page) if words(each) > MOST_WORDS]


def mean_words(page):
    """Words of a sentence, in the mean over paragraphs and lists."""
    return mean(map(words, sentences(page, tables=False)))


@pytest.mark.parametrize("name", sorted(set(PAGES) - EXEMPT))
def test_sentences_are_short(name):
    assert too_long(PAGES[name]) == []
    assert mean_words(PAGES[name]) <= MEAN_WORDS


def test_pages_are_exempt_only_while_they_need_to_be():
    assert set(PAGES) >= EXEMPT
    assert [
        name
        for name in sorted(EXEMPT)
        if not too_long(PAGES[name]) and mean_words(PAGES[name]) <= MEAN_WORDS
    ] == []


@pytest.mark.parametrize("name", sorted(name for name in PAGES if not name.startswith("src")))
def test_pages_are_short(name):
    assert len(PAGES[name].split()) <= PAGE_WORDS


def test_pages_of_messages_are_short():
    lengths = {name: len(text.split()) for name, text in message_pages().items()}
    assert max(lengths.values()) <= PAGE_WORDS, lengths


PAGE = """---
a: head
---
# A title

One two three. Four `five six` seven!
Eight [nine
ten](x.md#a.b) e.g. this.

- item one
- item
  two

| a cell. Another | $x + y$ |
|---|---|

```text
No sentence.
```
"""


def test_sentences_are_read_as_a_reader_reads_them():
    assert [words(each) for each in sentences(PAGE)] == [2, 3, 3, 5, 2, 2, 2, 1, 1]
    assert len(texts_of(PAGE)) == 6
    assert len(sentences(PAGE, tables=False)) == 5
    assert too_long("word " * 26) != []
    assert too_long("word " * 25) == []
