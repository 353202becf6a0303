"""Drawings with outlines: DXF as ezdxf writes it, SVG by hand."""

from __future__ import annotations

import io

import ezdxf

__all__ = ["SVG", "dxf", "svg"]

SVG = '<svg xmlns="http://www.w3.org/2000/svg" '


def dxf(draw, units=4):
    """The bytes of a DXF file; draw(document, model space) draws it."""
    document = ezdxf.new()
    document.units = units
    draw(document, document.modelspace())
    text = io.StringIO()
    document.write(text)
    return text.getvalue().encode()


def svg(inside, size='width="100mm" height="80mm" viewBox="0 0 100 80"'):
    """The bytes of an SVG file."""
    return f"{SVG}{size}>{inside}</svg>".encode()
