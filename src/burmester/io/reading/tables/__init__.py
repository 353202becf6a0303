"""Tables of poses: CSV, workbooks, Parquet, and rows pasted from CAD."""
