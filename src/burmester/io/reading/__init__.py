"""Tasks from files and from options: `poses` reads them, the other modules are its parts.

Tables: `file_content` (bytes and text), `workbook` and `parquet` (as text), `grid` (cells with
their places), `header`, `columns` (by `column_words`), `cell_numbers`, `pose_rows`, `cad_rows`,
`pose_table` (numbers as printed), `tracked_points`.
JSON and TOML: `documents`, `node` (a value with its place), `pose_tree`, `surroundings_tree` and
`specification_tree` (which reads each kind of value from options, too), `locations` (in the text).
Limits and requirements: `specification`, as text `specification_text`.
"""
