"""What is asked: poses, limits, requirements, and what kind of motion the poses are."""
