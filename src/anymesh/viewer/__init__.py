"""Interactive viewer, reports and pictures."""
