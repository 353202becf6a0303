"""The pages of the documentation: laid out, built by Sphinx, checked.

    python -m docs.building [FOLDER]

builds them into FOLDER, `build/docs` if none is given.
"""

# Pages of the reference that are made when the others are laid out: no file of the project.
GENERATED = ("asked", "command", "functions", "modules", "paper-tables", "schema")
