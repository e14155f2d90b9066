"""Buildings, rooms and garden houses."""
