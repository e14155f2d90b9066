"""Aircraft and spacecraft."""
