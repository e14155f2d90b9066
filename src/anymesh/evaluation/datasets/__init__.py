"""Data sets of objects with known joints, as a mesh file and its ground truth."""
