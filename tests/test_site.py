"""The site of the documentation builds offline without warnings. Slow; needs the extra `docs`."""

import os
import re
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path

import pytest

pytest.importorskip("furo", reason="the extra 'docs' is not installed")
pytestmark = pytest.mark.slow
ROOT = Path(__file__).parents[1]
LOADED = {"script": "src", "link": "href", "img": "src", "iframe": "src", "source": "src", "video": "src", "object": "data"}


class Resources(HTMLParser):
    """The addresses that a browser loads by itself, the links that it offers, and the anchors of a page."""

    def __init__(self) -> None:
        super().__init__()
        self.loaded: list[str] = []
        self.links: list[str] = []
        self.anchors: set[str] = set()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        values = dict(attrs)
        if tag in LOADED and values.get(LOADED[tag]):
            self.loaded.append(str(values[LOADED[tag]]))
        if tag == "a" and values.get("href"):
            self.links.append(str(values["href"]))
        if values.get("id"):
            self.anchors.add(str(values["id"]))


def read(path: Path) -> Resources:
    found = Resources()
    found.feed(path.read_text(encoding="utf-8"))
    return found


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("site")
    offline = dict.fromkeys(("http_proxy", "https_proxy", "HTTP_PROXY", "HTTPS_PROXY"), "http://127.0.0.1:9")
    ran = subprocess.run(
        [
            sys.executable,
            "-m",
            "sphinx",
            "-q",
            "-W",
            "--keep-going",
            "-c",
            "docs",
            "-d",
            str(out / "doctrees"),
            ".",
            str(out / "html"),
        ],
        cwd=ROOT,
        capture_output=True,
        text=True,
        env={**os.environ, **offline},
    )
    assert ran.returncode == 0, ran.stderr
    return out / "html"


def test_pages_load_nothing_from_elsewhere(site: Path) -> None:
    pages = sorted(site.rglob("*.html"))
    assert len(pages) > 60
    for page in pages:
        for address in read(page).loaded:
            assert not re.match(r"(?:[a-z]+:)?//", address), f"{page.name} loads {address}"
    for sheet in site.rglob("*.css"):
        assert not re.search(r"(?:url\(|@import)\s*['\"]?(?:https?:)?//", sheet.read_text(encoding="utf-8")), sheet.name


def test_links_within_the_site_lead_somewhere(site: Path) -> None:
    pages = {page.resolve(): read(page) for page in site.rglob("*.html")}
    for page, found in pages.items():
        for link in (*found.links, *found.loaded):
            if re.match(r"[a-z]+:", link):
                continue
            place, _, anchor = link.partition("#")
            file = (page.parent / place.split("?")[0]).resolve() if place else page
            assert file.exists(), f"{page.name}: {link}"
            if anchor and file in pages and file.name not in ("search.html", "genindex.html"):
                assert anchor in pages[file].anchors, f"{page.name}: {link}"


def test_the_first_page_and_the_search_are_there(site: Path) -> None:
    assert "docs/index.html" in (site / "index.html").read_text(encoding="utf-8")
    assert (site / "searchindex.js").stat().st_size > 10_000
    text = (site / "docs" / "api" / "index.html").read_text(encoding="utf-8")
    assert "anymesh.articulate" in text
    assert "anymesh-annotate" in (site / "docs" / "api" / "commands.html").read_text(encoding="utf-8")
