"""Headless Chromium for the tests of pages, driven through playwright.

    from browser import Tab                     # fixtures `chromium` and `tab` come from conftest.py
    def test_page(tab: Tab): tab.open(url); tab.page.click("#x"); tab.pixels("canvas"); assert not tab.errors

Needs the package playwright and a Chromium: `chromium`, `chromium-browser` or `google-chrome` on the path, or the file that
$ANYMESH_CHROMIUM names. Where one is missing, tests that use these fixtures are skipped and say so.
"""

from __future__ import annotations

import io
import os
import shutil
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from PIL import Image

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

NAMES = ("chromium", "chromium-browser", "google-chrome")
FLAGS = ("--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-dev-shm-usage")
LAPTOP = {"width": 1280, "height": 720}
HERE = ("file:", "data:", "blob:", "about:", "http://127.0.0.1", "http://localhost", "ws://127.0.0.1", "ws://localhost")


@dataclass
class Tab:
    """A tab of its own (own storage), 1280 x 720. errors: of the console and of scripts; requests that left the machine."""

    page: Page
    errors: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.page.on("console", lambda m: self.errors.append(f"console: {m.text}") if m.type == "error" else None)
        self.page.on("pageerror", lambda e: self.errors.append(f"script: {e}"))
        self.page.on("request", lambda r: None if r.url.startswith(HERE) else self.errors.append(f"request: {r.url[:200]}"))

    def open(self, target: str | Path) -> None:
        """A URL, or a file of this machine by its file URL."""
        self.page.goto(target.resolve().as_uri() if isinstance(target, Path) else target)

    def pixels(self, selector: str | None = None, path: Path | None = None) -> np.ndarray:
        """(H, W, 3) of an element, or of the window; written as PNG too when `path` is given."""
        taken = self.page.screenshot() if selector is None else self.page.locator(selector).first.screenshot()
        if path is not None:
            path.write_bytes(taken)
        with Image.open(io.BytesIO(taken)) as image:
            return np.asarray(image.convert("RGB"))

    def until(self, condition: str, seconds: float = 60) -> None:
        """Waits until a JavaScript expression is true; asked from outside, as a page's policy may forbid `eval` in it."""
        end = time.monotonic() + seconds
        while not self.page.evaluate(condition):
            assert time.monotonic() < end, f"not within {seconds} s: {condition}; errors: {self.errors}"
            self.page.wait_for_timeout(30)

    def value(self, expression: str) -> Any:
        """What a JavaScript expression gives."""
        return self.page.evaluate(expression)


def executable() -> str | None:
    """The Chromium to use, None when there is none."""
    return os.environ.get("ANYMESH_CHROMIUM") or next((p for p in map(shutil.which, NAMES) if p), None)


@pytest.fixture(scope="session")
def chromium() -> Iterator[Browser]:
    """One Chromium for all tests of a session."""
    driver = pytest.importorskip("playwright.sync_api", reason="needs the package playwright")
    path = executable()
    if path is None:
        pytest.skip("needs a Chromium on the path, or $ANYMESH_CHROMIUM")
    with driver.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=list(FLAGS), headless=True)
        yield browser
        browser.close()


@pytest.fixture
def tab(chromium: Browser) -> Iterator[Tab]:
    """A fresh tab. For two tabs that share their storage: `chromium.new_context()` and `Tab(context.new_page())` twice."""
    context = chromium.new_context(viewport=LAPTOP)
    yield Tab(context.new_page())
    context.close()
