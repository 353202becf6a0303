"""What a person holds in Python: poses in, a result with its linkages out, and where they go."""
