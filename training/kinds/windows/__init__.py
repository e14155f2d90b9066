"""Windows, hatches and shutters."""
