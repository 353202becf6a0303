"""The living report: a synthesis as one self-contained HTML file."""

from burmester.report.page import page

__all__ = ["page"]
