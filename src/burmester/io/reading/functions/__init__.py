"""Function tasks: expressions, and pairs of angles from files."""
