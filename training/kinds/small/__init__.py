"""Pocket things, trinkets and ornaments."""
