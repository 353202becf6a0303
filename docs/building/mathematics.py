"""Formulas as MathML, which browsers set themselves: no script, no network.

The font is STIX Two Math (SIL Open Font License), which ziamath carries; only the characters
that mathematics needs are kept.
"""

import html
import re
from pathlib import Path

import ziamath
from fontTools import subset
from latex2mathml.converter import convert

FONT = Path(ziamath.__file__).parent / "fonts" / "STIXTwoMath-Regular.ttf"
THIN = '<mspace width="0.14em" />'
RANGES = (
    (0x20, 0x17F), (0x2B0, 0x3FF), (0x2010, 0x20FF), (0x2100, 0x22FF), (0x2308, 0x230B),
    (0x23B0, 0x23E1), (0x239B, 0x23AE), (0x27C0, 0x27FF), (0x2A00, 0x2A0F), (0x1D400, 0x1D7FF),
)  # fmt: skip


def mathml(text: str, display: str) -> str:
    """LaTeX as MathML, display "inline" or "block"."""
    text = re.sub(r"\\(begin|end)\{(aligned|gathered)\}", r"\\\1{align*}", text.strip())
    text = text.replace(r"\lvert", r"\left\vert ").replace(r"\rvert", r"\right\vert ")
    made = str(convert(text, display=display))
    return re.sub(r"<mi>(sin|cos|tan|det|min)</mi>", rf"{THIN}<mi>\1</mi>{THIN}", made)


def inline(translator, node):
    """What stands in a line of text."""
    translator.body.append(mathml(node.astext(), "inline"))
    raise_skip()


def block(translator, node):
    """A formula on lines of its own, with the place that links lead to."""
    ids = "".join(f'<span id="{html.escape(each)}"></span>' for each in node["ids"])
    translator.body.append(f'<div class="formula">{ids}{mathml(node.astext(), "block")}</div>\n')
    raise_skip()


def raise_skip():
    """Sphinx goes on behind the formula."""
    from docutils.nodes import SkipNode  # noqa: PLC0415

    raise SkipNode


def write_font(app, _error):
    """The font's part that mathematics needs, among the pages."""
    options = subset.Options(flavor="woff", layout_features=["*"], name_IDs=[0, 13, 14])
    font = subset.load_font(str(FONT), options)
    cut = subset.Subsetter(options)
    cut.populate(unicodes=[code for low, high in RANGES for code in range(low, high + 1)])
    cut.subset(font)
    subset.save_font(font, str(Path(app.outdir, "_static", "STIXTwoMath.woff")), options)


def setup(app):
    """Sphinx calls this."""
    app.add_html_math_renderer(
        "mathml", inline_renderers=(inline, None), block_renderers=(block, None)
    )
    app.config.html_math_renderer = "mathml"
    app.connect("build-finished", write_font)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
