"""What stands out among the poses: one that does not agree, a unit, an exchange."""
