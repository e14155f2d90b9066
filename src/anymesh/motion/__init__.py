"""The geometry of one movable part relative to the rest of the object, used by stages A and B."""
