"""Cabinets, drawers and shelves."""
