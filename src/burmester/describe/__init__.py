"""Words and digits, for any screen: plain strings, no library of a terminal or a page."""
