"""Seats, tables, beds and desks."""
