"""Fixtures of the tests that look at pages."""

from browser import chromium, tab  # noqa: F401, pytest finds fixtures here
from live_page import live  # noqa: F401
from moved import cabinet_page, opened  # noqa: F401
