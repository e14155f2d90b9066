"""Physical properties that a mesh does not state: collision shapes, density, inertia."""
