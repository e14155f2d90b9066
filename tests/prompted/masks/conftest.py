"""Fixtures of the tests against segment-anything."""

from sam_reference import reference  # noqa: F401, pytest finds fixtures here
