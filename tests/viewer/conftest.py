"""Fixtures of the tests that look at pages."""

from browser import chromium, tab  # noqa: F401, pytest finds fixtures here
from moved import cabinet_page, opened  # noqa: F401
