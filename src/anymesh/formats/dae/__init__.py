"""COLLADA 1.4 and 1.5: its document, geometry, materials, and transforms with their animations."""
