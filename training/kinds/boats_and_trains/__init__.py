"""Boats, ship parts, trains, and vehicles for snow and water."""
