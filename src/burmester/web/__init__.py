"""A page's data, shared by the report and by every other face in a browser, and its script.

`data` makes the data; `widget/` holds the modules of the script, which `scripts/bundle` joins to
`assets/widget.mjs`; `assets/` is all that a page reads.
"""
