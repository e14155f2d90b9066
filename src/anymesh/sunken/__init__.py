"""What is sunk into other bodies, as both stages see it."""
