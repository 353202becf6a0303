"""What surrounds the package: locks, set-up, what is handed out.  It mirrors no room."""
