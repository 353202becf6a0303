"""All solutions of the polynomial systems of dyads: linear algebra, paths where that fails."""
