"""The sentences of a page in Markdown, as a reader counts their words."""

import re

from tests.oracles.markdown import Document

CODE = re.compile(r"`[^`]*`")
LINK = re.compile(r"!?\[([^\]]*)\](?:\([^)]*\)|\{[^}]*\}|\[[^\]]*\])?")
ROLE = re.compile(r"\{[\w:]+\}(?=`)")
MATHS = re.compile(r"\$\$.*?\$\$|\$[^$\n]+\$", re.DOTALL)
ADDRESS = re.compile(r"\[[^\]]+\]: \S+$")  # of links that stand elsewhere by their name
BEGINS = re.compile(r"^\s*(?:[-*+] |\d+\. |> )")
ENDS = re.compile(
    r"(?<!\b[A-EG-LN-Z]\.)(?<!\be\.g\.)(?<!\bi\.e\.)(?<!\bNo\.)(?<=[.!?])[”\"')*_]*\s+(?=\S)"
)
WORD = re.compile(r"\w")


def texts_of(page, tables=True):
    """Paragraphs and items of lists, a line each; with tables, cells and headings, too."""
    prose = re.sub(r"(?ms)\A---\n.*?^---$", "", Document.of_text(page).prose)
    prose = re.sub(r"(?s)<!--.*?-->|<[^>]+>", " ", MATHS.sub(" formula ", prose))
    found = [""]
    for line in prose.splitlines():
        if line.lstrip().startswith(("|", "#")):
            found += re.split(r"(?<!\\)\|", line.strip().strip("|# ")) if tables else []
            found.append("")
        elif not line.strip() or ADDRESS.match(line):
            found.append("")
        elif BEGINS.match(line):
            found.append(BEGINS.sub("", line))
        else:
            found[-1] += " " + line.strip()
    return [each for each in found if WORD.search(each)]


def sentences(page, tables=True):
    """The sentences of a page; what is quoted as code counts as one word."""
    found = []
    for text in texts_of(page, tables):
        plain = LINK.sub(r"\1", CODE.sub("code", ROLE.sub("", text)))
        found += [each for each in ENDS.split(plain) if WORD.search(each)]
    return found


def words(sentence):
    """How many words a sentence has; a dash alone is none."""
    return sum(1 for each in sentence.split() if WORD.search(each))
