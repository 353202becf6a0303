"""What is said of a linkage: quality, uncertainty, requirements, standard, rank, words."""
