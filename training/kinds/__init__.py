"""Kinds of objects with known joints, made to vary: a folder of modules a subject, and what they share beside them."""
