"""The benchmark of this field: published and generated tasks, tools that install, one judge.

`python -m benchmarks.field` runs it; `docs/field.md` is what came of it.
"""
