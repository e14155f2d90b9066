"""Fixtures of the tests of the command line."""

from called import mesh  # noqa: F401, pytest finds fixtures here
