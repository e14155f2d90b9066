"""Joints that a file states: by animations of its nodes, physics extensions, and bones."""
