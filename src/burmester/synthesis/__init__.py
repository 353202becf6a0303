"""From a task to its linkages, everything kept and ranked."""
