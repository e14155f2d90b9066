"""Kinds of objects: usual sizes and masses, and what they are made of."""
