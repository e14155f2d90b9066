"""Hand tools and machine tools."""
