"""What is proved of the dyads found, in ball arithmetic."""
