"""Six-bars of Stephenson's chain: two links of three joints that no joint of the two connects."""
