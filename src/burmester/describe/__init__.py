"""Words and digits, for any screen."""
