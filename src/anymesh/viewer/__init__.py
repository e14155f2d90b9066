"""What people look at: the interactive viewer, the report, pictures."""
