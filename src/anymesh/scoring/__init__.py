"""Learned scores of candidates, used by both stages."""
