"""Tasks: poses, limits, requirements, and the class of motion of the poses."""
