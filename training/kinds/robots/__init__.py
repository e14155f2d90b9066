"""Robots and science fiction."""
