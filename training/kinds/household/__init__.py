"""Bathroom, laundry, cleaning and fans."""
