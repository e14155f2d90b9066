"""Playgrounds, games and sports equipment."""
