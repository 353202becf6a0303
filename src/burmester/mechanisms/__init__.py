"""What is said of a mechanism of any kind: its joints, its links and where they are."""
