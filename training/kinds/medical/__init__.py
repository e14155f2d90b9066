"""Hospital and laboratory equipment."""
