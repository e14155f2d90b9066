"""Objects with known joints, as a mesh file and the truth about it."""
