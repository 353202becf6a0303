"""How Sphinx builds the pages, of the sources that `docs.building` lays out; see `scripts/docs`."""

from pathlib import Path

from burmester import __version__

project = "burmester"
author = "The burmester authors"
release = version = __version__
html_show_copyright = False

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "numpydoc",
    "docs.building.mathematics",
    "docs.building.formulas",
]
nitpicky = False
default_role = "py:obj"
exclude_patterns = ["jupyter_execute", "**.ipynb"]

# Markdown
myst_enable_extensions = ["dollarmath", "html_image", "attrs_block"]
myst_heading_anchors = 4
myst_dmath_double_inline = True
suppress_warnings = ["misc.highlighting_failure"]  # what a command prints is no language

# Notebooks: run anew in every build, and nothing of theirs from elsewhere.
nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 120
nb_ipywidgets_js = {}
nb_merge_streams = True

# The reference of the API
autodoc_member_order = "bysource"
autodoc_typehints = "none"
autodoc_class_signature = "mixed"
numpydoc_show_class_members = False
numpydoc_class_members_toctree = False

# Pages
html_theme = "furo"
html_title = "burmester"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_copy_source = False
html_search_scorer = str(Path(__file__).parent / "building" / "scorer.js")
html_show_sourcelink = False
html_show_sphinx = False
html_theme_options = {"source_repository": "", "top_of_page_buttons": []}
pygments_style = "tango"
pygments_dark_style = "monokai"
