"""Places in JSON and TOML: what stands at a path, cut out, is what the parsers found there.

`python -m tests.io.test_places 5000` tries as many documents of each language.
"""

import json
import re
import sys
import tomllib

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from burmester.io.reading.trees.locations import span_of
from tests.samples import share

# Trees, and one of the ways to write each ------------------------------------------------------

KEYS = st.sampled_from(
    ["x", "y", "poses", "limits", "box", "a-b", "", "a b", "ä.ö", '"', "'", "1", "#", "a\nb", "=["]
)
TEXTS = st.text(
    st.sampled_from("ab \"'\\[]{}#=,.:\n\t0é\u2028\x85\U0001f600") | st.characters(codec="utf-8"),
    max_size=8,
)
NUMBERS = st.integers(-(10**20), 10**20) | st.floats(allow_nan=False, allow_infinity=False)
SCALARS = NUMBERS | TEXTS | st.booleans()
TREES = st.recursive(
    SCALARS,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(KEYS, inner, max_size=4),
    max_leaves=20,
)
TABLES = st.dictionaries(
    KEYS,
    TREES | st.lists(st.dictionaries(KEYS, TREES, max_size=3), min_size=1, max_size=3),
    max_size=4,
)


def leaves(tree, path=()):
    """Every path of a tree, and what is there."""
    yield path, tree
    if isinstance(tree, dict):
        for key, value in tree.items():
            yield from leaves(value, (*path, key))
    elif isinstance(tree, list):
        for i, value in enumerate(tree):
            yield from leaves(value, (*path, i))


class JsonWriter:
    """Blanks and escapes as the draws have them."""

    def __init__(self, draw):
        self.draw = draw

    def gap(self):
        return self.draw(st.sampled_from(["", "", " ", "\n", "\t ", "\n\n  "]))

    def value(self, tree):
        gap = self.gap
        if isinstance(tree, dict):
            members = (
                f"{gap()}{self.text(k)}{gap()}:{gap()}{self.value(v)}{gap()}"
                for k, v in tree.items()
            )
            return "{" + (",".join(members) or gap()) + "}"
        if isinstance(tree, list):
            return "[" + (",".join(gap() + self.value(v) + gap() for v in tree) or gap()) + "]"
        return self.text(tree) if isinstance(tree, str) else json.dumps(tree)

    def text(self, text):
        return json.dumps(text, ensure_ascii=self.draw(st.booleans()))


class TomlWriter:
    """Tables under heads, arrays of tables, dotted keys and inline tables as the draws have it."""

    def __init__(self, draw):
        self.draw = draw

    def pick(self, *choices):
        return self.draw(st.sampled_from(choices))

    def gap(self):
        return self.pick("", "", " ", "\t")

    def lines(self):
        """What may stand between the values of an array."""
        return self.pick("", " ", "\n", " # ], \" ''' [\n", "\n  # x = 1\n\t")

    def key(self, key):
        kinds = ["basic"]
        if re.fullmatch(r"[A-Za-z0-9_-]+", key):
            kinds.append("bare")
        if re.fullmatch(r"[^'\x00-\x08\n-\x1f\x7f]*", key):
            kinds.append("literal")
        match self.pick(*kinds):
            case "bare":
                return key
            case "literal":
                return f"'{key}'"
        return self.basic(key)

    def basic(self, text):
        out = ""
        for c in text:
            if c in '"\\':
                out += "\\" + c
            elif c in "\n\r\b\f" or not (c == "\t" or c >= " ") or c == "\x7f":
                out += f"\\u{ord(c):04x}"
            else:
                out += c if self.draw(st.integers(0, 5)) else f"\\U{ord(c):08X}"
        return f'"{out}"'

    def text(self, text):
        plain = not re.search(r"[\x00-\x08\x0b-\x1f\x7f]", text)
        kinds = ["basic"]
        if plain and "'" not in text and "\n" not in text:
            kinds.append("literal")
        if plain and "'''" not in text and not text.endswith("'") and not text.startswith("\n"):
            kinds.append("long literal")
        if plain:
            kinds.append("long basic")
        match self.pick(*kinds):
            case "literal":
                return f"'{text}'"
            case "long literal":
                return f"'''{self.pick('', chr(10))}{text}'''"
            case "long basic":
                inside = text.replace("\\", "\\\\").replace('"""', '""\\"')
                if inside.startswith("\n"):
                    inside = "\n" + inside
                return f'"""{inside}{self.pick("", chr(92) + chr(10) + "  ")}"""'
        return self.basic(text)

    def value(self, tree):
        gap = self.gap
        if isinstance(tree, dict):
            members = (
                f"{gap()}{k}{gap()}={gap()}{self.value(v)}{gap()}" for k, v in self.flat(tree)
            )
            return "{" + ",".join(members) + "}"
        if isinstance(tree, list):
            items = [self.lines() + self.value(v) + self.lines() for v in tree]
            return "[" + ",".join(items) + (self.pick("", ",") if items else "") + "]"
        if isinstance(tree, bool):
            return str(tree).lower()
        if isinstance(tree, int):
            return self.pick(f"{tree}", f"{tree:_}", f"{tree:+}")
        return repr(tree) if isinstance(tree, float) else self.text(tree)

    def flat(self, tree, before=""):
        """The keys of a table, some of them dotted, and their values."""
        for key, value in tree.items():
            name = before + self.key(key)
            if isinstance(value, dict) and value and self.draw(st.booleans()):
                dot = f"{self.gap()}.{self.gap()}"
                yield from self.flat(value, name + dot)
            else:
                yield name, value

    def document(self, tree, path=()):
        below, out = [], ""
        for key, value in tree.items():
            tables = isinstance(value, list) and value and all(isinstance(v, dict) for v in value)
            if (tables or isinstance(value, dict)) and self.draw(st.booleans()):
                below.append((key, value))
            else:
                for name, each in self.flat({key: value}):
                    gaps = [self.gap() for _ in range(4)]
                    out += f"{gaps[0]}{name}{gaps[1]}={gaps[2]}{self.value(each)}{gaps[3]}"
                    out += self.pick("\n", "# \"'[ \n", "\n\n# [x]\n")
        for key, value in below:
            names = (*path, self.key(key))
            dot = f"{self.gap()}.{self.gap()}"
            inside = f"{self.gap()}{dot.join(names)}{self.gap()}"
            if isinstance(value, list):
                for table in value:
                    out += f"[[{inside}]]{self.pick('', ' # ]')}\n" + self.document(table, names)
            else:
                body = self.document(value, names)
                # a table whose tables say all of it needs no head
                needed = not value or not body.lstrip().startswith("[") or self.draw(st.booleans())
                out += (f"[{inside}]{self.pick('', ' # ]')}\n" if needed else "") + body
        return out


def same(a, b):
    return json.dumps(a, sort_keys=True) == json.dumps(
        b, sort_keys=True
    )  # 1 is neither 1.0 nor true


def parsed(text, language):
    return json.loads(text) if language == "JSON" else tomllib.loads(f"v = {text}")["v"]


def parsed_key(text, language):
    return json.loads(text) if language == "JSON" else tomllib.loads(f"{text} = 0").popitem()[0]


def head_words(piece):
    """The keys of a head of TOML, [a.b] or [[a.b]]; None if it is none."""
    try:
        node = tomllib.loads(piece)
    except tomllib.TOMLDecodeError:
        return None
    words = []
    while node:
        word, node = node.popitem()
        words.append(word)
        node = node[0] if isinstance(node, list) else node
    return words


def check(text, language, tree):
    for path, value in leaves(tree):
        if not path and language == "TOML":
            continue
        found = span_of(text, language, path)
        assert found, path
        piece = text[slice(*found)]
        words = [key for key in path if isinstance(key, str)]
        if isinstance(value, dict | list) and language == "TOML" and not same_value(piece, value):
            assert (head_words(piece) or [parsed_key(piece, language)])[-1] == words[-1]
            assert (head_words(piece) or words) == words
        else:
            assert same(parsed(piece, language), value)
        if path and isinstance(path[-1], str):
            start, end = span_of(text, language, path, key=True)
            assert parsed_key(text[start:end], language) == path[-1]
            if not isinstance(value, dict | list):
                assert re.fullmatch(r"\s*[=:]\s*", text[end : found[0]])
        assert span_of(text, language, (*path, "nowhere")) is None
        assert span_of(text, language, (*path, 99)) is None


def same_value(piece, value):
    try:
        return same(parsed(piece, "TOML"), value)
    except tomllib.TOMLDecodeError:
        return False


@given(tree=TREES, data=st.data())
@settings(max_examples=share(120), deadline=None)
def test_every_value_of_a_json_text_is_found(tree, data):
    text = JsonWriter(data.draw).value(tree)
    assert same(json.loads(text), tree)
    check(text, "JSON", tree)


@given(tree=TABLES, data=st.data())
@settings(max_examples=share(150), deadline=None)
def test_every_value_of_a_toml_text_is_found(tree, data):
    text = TomlWriter(data.draw).document(tree)
    assert same(tomllib.loads(text), tree)
    check(text, "TOML", tree)


@pytest.mark.parametrize("quote", ["'", '"'])
@pytest.mark.parametrize("inside", ["", "a", "Q", "QQ", "aQQ", "Qa", "aQbQQ", "\n[", "]Q\n#"])
def test_quotes_at_the_ends_of_long_texts(quote, inside):
    text = f"a = [{3 * quote}{inside.replace('Q', quote)}{3 * quote}, 1]\nb = 2\n"
    check(text, "TOML", tomllib.loads(text))


if __name__ == "__main__":
    for law in (test_every_value_of_a_json_text_is_found, test_every_value_of_a_toml_text_is_found):
        settings(max_examples=int(sys.argv[1]), deadline=None)(law)()
