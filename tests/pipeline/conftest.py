"""Fixtures of the tests of output folders."""

from run_folders import source  # noqa: F401, pytest finds fixtures here
