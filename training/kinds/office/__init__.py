"""Office machines, drafting and sewing."""
