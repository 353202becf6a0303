"""From the answers of a task to those of one that differs a little, each with its name."""
