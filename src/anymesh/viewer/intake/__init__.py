"""Meshes that a person hands to the live page: their files, the work on them, and the page before there is an asset."""
