"""Tasks from files and from options: `poses` reads them, the other rooms are its parts.

Tables: `fetched` (bytes and text), `csv_poses`, `columns` (headers), `table` (numbers as printed),
`wrong_numbers`, `points` (two tracked points), `parquet`.  JSON and TOML: `documents`, `pose_tree`,
`pose_model`, `places` (where a value stands), `slips` (what is wrong with the language).  What is
wanted: `wanted` and `asked`, as text (`limits_text`, `requirements_text`) and in files
(`limits_tree`, `requirements_tree`).
"""
