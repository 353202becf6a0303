"""OpenSCAD as tokens, by its grammar: comments, strings, numbers, names, signs, files."""

import re

TOKEN = re.compile(
    r"""
    (?P<comment> //[^\n]* | /\*.*?\*/ )
  | (?P<file> (?:include|use)\s*<[^>\n]*> )
  | (?P<string> "(?:\\.|[^"\\])*" )
  | (?P<number> (?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)? )
  | (?P<name> \$?[A-Za-z_]\w* )
  | (?P<sign> <=|>=|==|!=|&&|\|\||[-+*/%^<>=!?:;,.()\[\]{}\#] )
  | (?P<blank> [ \t\r\n]+ )
    """,
    re.VERBOSE | re.DOTALL,
)


def tokens(text):
    """The kinds and texts of all tokens but blanks; of comments the kind only."""
    at, found = 0, []
    while at < len(text):
        match = TOKEN.match(text, at)
        assert match, f"no OpenSCAD: {text[at : at + 40]!r}"
        at = match.end()
        if match.lastgroup == "comment":
            found.append(("comment", match[0][:2]))
        elif match.lastgroup != "blank":
            found.append((match.lastgroup, match[0]))
    return found
