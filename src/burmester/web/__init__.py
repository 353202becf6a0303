"""What the page, and later the studio and notebooks, share."""
