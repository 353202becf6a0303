"""What commands print and write, kept as fingerprints: a change of the inside changes none."""
