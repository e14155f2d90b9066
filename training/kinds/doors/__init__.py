"""Doors, gates, barriers and locks."""
