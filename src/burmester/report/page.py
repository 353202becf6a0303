"""The report as one HTML file that asks no network for anything."""

from __future__ import annotations

import base64
import hashlib
import html
import json
from importlib import resources
from typing import Any

from burmester.synthesis.function_generation import AnySynthesis, FunctionSynthesis
from burmester.web.data import report_data
from burmester.web.function_data import function_report
from burmester.web.six_bar_data import six_bar_report


def page(synthesis: AnySynthesis, title: str) -> str:
    """The report of a synthesis: a whole HTML document, scripts, styles and data within.

    It shows the function generators, or the six-bars where these were looked for, else four-bars.
    """
    if isinstance(synthesis, FunctionSynthesis):
        return page_of(function_report(synthesis), title)
    report = report_data if synthesis.six_bars is None else six_bar_report
    return page_of(report(synthesis), title)


def page_of(report: dict[str, Any], title: str) -> str:
    """The same of what `report_data` said.

    Its content security policy allows its own script and style, by their hashes, and nothing else.
    """
    data = {**report, "title": title}
    # The widget's module exports itself to no one here, and is called by its own name.
    script = _text("widget.mjs") + _text("start.mjs")
    style = _text("widget.css") + _text("page.css")
    policy = "; ".join(
        [
            "default-src 'none'",
            f"script-src '{_hash(script)}'",
            f"style-src '{_hash(style)}'",
            "base-uri 'none'",
            "form-action 'none'",
        ]
    )
    parts = {
        "policy": html.escape(policy, quote=False),
        "title": html.escape(title),
        "style": style,
        "outcome": html.escape(data["outcome"]["message"]),
        "data": as_script(data),
        "script": script,
    }
    text = _text("page.html")
    for name, part in parts.items():
        before, mark, after = text.partition(f"<!--{name}-->")
        assert mark
        # What is put in is never looked through for more marks.
        parts[name] = before + part
        text = after
    return "".join(parts.values()) + text


def as_script(data: object) -> str:
    """JSON that can stand in a script element, whatever its strings hold."""
    text = json.dumps(data, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    # In JSON these characters stand in strings only, where an escape is as good.
    for character in "<>&\u2028\u2029":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return text


def _text(name: str) -> str:
    return (resources.files("burmester.web") / "assets" / name).read_text(encoding="utf-8")


def _hash(text: str) -> str:
    digest = hashlib.sha256(text.encode()).digest()
    return f"sha256-{base64.b64encode(digest).decode()}"
