"""Notebooks to take home, with what their cells showed when the site was built.

A page's code runs once, in the build.  What it showed is kept by myst-nb in `jupyter_execute`; here
it comes into the notebook that the page offers, whose words are plain Markdown.
"""

from pathlib import Path

import nbformat

SHOWN = ("text/plain", "text/html", "image/png", "image/gif")  # SVG stands in the HTML, too
RUN = "jupyter_execute"  # beside the pages: where myst-nb leaves the notebooks that it ran


def own_settings(folder: Path):
    """The folder of settings for the kernels: nobody's own, and words of warning are left out."""
    profile = folder / "ipython" / "profile_default"
    profile.mkdir(parents=True)
    profile.joinpath("ipython_kernel_config.py").write_text("c.IPKernelApp.log_level = 40\n")
    return profile.parent


def give_outputs(folder: Path):
    """Put outputs into all notebooks under `_downloads`; how many there are."""
    run = {path.name: path for path in (folder.parent / RUN).rglob("*.ipynb")}
    given = sorted((folder / "_downloads").rglob("*.ipynb"))
    for path in given:
        notebook = nbformat.read(path, as_version=4)
        copy_outputs(nbformat.read(run[path.name], as_version=4), notebook)
        nbformat.write(notebook, path)
    return len(given)


def copy_outputs(source, target):
    """Outputs of the cells of one notebook into another with the same code."""
    theirs = [cell for cell in source.cells if cell.cell_type == "code"]
    ours = [cell for cell in target.cells if cell.cell_type == "code"]
    for number, (one, other) in enumerate(zip(theirs, ours, strict=True), start=1):
        assert one.source.strip() == other.source.strip(), other.source
        other.execution_count = number
        other.outputs = [kept(output, number) for output in one.outputs]


def kept(output, number):
    """An output without what a notebook can do without."""
    if "data" in output:
        data = {kind: output.data[kind] for kind in SHOWN if kind in output.data}
        output = nbformat.from_dict({**output, "data": data, "metadata": {}})
    if output.output_type == "execute_result":
        output.execution_count = number
    return output
