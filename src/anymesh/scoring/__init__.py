"""Scores of candidates, used by both stages: learned ones, and those set by hand."""
